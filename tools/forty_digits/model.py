"""What moves in a plane scene: storeys of parallel springs, blocks, and the largest values of vectors."""

from __future__ import annotations

from dataclasses import dataclass, field
from decimal import Decimal
from math import atan2
from typing import Any

from forty_digits.polynomials import ZERO, Series, at, derivative, product, roots

Vector = list[Decimal]


@dataclass(frozen=True)
class Precision:
    """Digits of the arithmetic, highest order of a series, and limits.

    `last` is what the last terms of a series may be, `rest` the velocity over the largest so far that counts as none,
    `tolerance` what a guard and a decision take as equal.
    """

    digits: int = 40
    order: int = 40
    last: Decimal = Decimal("1e-27")
    rest: Decimal = Decimal("1e-24")
    tolerance: Decimal = Decimal("1e-30")


FORTY = Precision()


def number(value: float) -> Decimal:
    """Return the number that a double is."""
    return Decimal(float(value))


def length(a: Vector) -> Decimal:
    """Return the length of a vector."""
    return (a[0] * a[0] + a[1] * a[1]).sqrt()


def angle(a: Vector) -> float:
    """Return the angle of a vector from x towards y (rad)."""
    return atan2(float(a[1]), float(a[0]))


@dataclass
class Part:
    """One of the parallel springs of a storey: elastic up to a strength, with the drift at which it has no force."""

    stiffness: Decimal
    strength: Decimal
    offset: Decimal = ZERO
    plastic: int = 0

    def unload(self, drift: Decimal) -> None:
        """Become elastic again at a drift."""
        if self.plastic:
            self.offset = drift - self.plastic * self.strength / self.stiffness
            self.plastic = 0


@dataclass
class Storey:
    """An elastic spring, with P-Delta in it, and the parts beside it."""

    elastic: Decimal
    parts: list[Part]

    def tangent(self) -> Decimal:
        """Stiffness now (N/m)."""
        return self.elastic + sum((part.stiffness for part in self.parts if not part.plastic), ZERO)

    def constant(self) -> Decimal:
        """Force at zero drift on the present tangent (N)."""
        terms = (p.plastic * p.strength if p.plastic else -p.stiffness * p.offset for p in self.parts)
        return sum(terms, ZERO)


def storeys(building: dict[str, Any]) -> list[Storey]:
    """Return the storeys of a building: trilinear with Masing unloading, as parallel springs."""
    found = []
    for p in range(len(building["mass"])):
        keys = ("stiffness", "yield_shear", "overstrength", "second_slope", "third_slope", "geometric_stiffness")
        values = {
            key: building[key][p] if isinstance(building[key], list) else building[key]
            for key in keys
            if key in building
        }
        given = {key: number(value) for key, value in values.items()}
        k, less = given["stiffness"], given.get("geometric_stiffness", ZERO)
        if "yield_shear" not in given:
            found.append(Storey(k - less, []))
            continue
        v, omega, r2, r3 = (given[key] for key in keys[1:5])
        second = v / k + (omega - 1) * v / (r2 * k)
        parts = [Part((1 - r2) * k, (1 - r2) * v), Part((r2 - r3) * k, (r2 - r3) * k * second)]
        found.append(Storey(r3 * k - less, parts))
    return found


@dataclass(eq=False)
class Block:
    """A block: what it is made of, how it moves, and what it has seen."""

    number: int
    node: int
    mass: Decimal
    mu_s: Decimal
    mu_k: Decimal
    wear: list[tuple[Decimal, Decimal, Decimal]]
    slip: Vector = field(default_factory=lambda: [ZERO, ZERO])
    r: Vector = field(default_factory=lambda: [ZERO, ZERO])
    start: Vector | None = None
    path: Decimal = ZERO
    fastest: Decimal = ZERO
    turns: list[Decimal] = field(default_factory=list)
    worn: int = 0

    @property
    def rests(self) -> bool:
        """Whether its relative velocity is zero: it sticks, or starts now."""
        return self.r == [ZERO, ZERO]

    @property
    def moves(self) -> bool:
        """Whether it slides, or starts now."""
        return self.start is not None or not self.rests


def blocks(scene: dict[str, Any]) -> list[Block]:
    """Return the blocks of a scene."""
    return [
        Block(
            i,
            b["floor"],
            number(b["mass"]),
            number(b["mu_s"]),
            number(b["mu_k"]),
            [(number(path), number(s), number(k)) for path, s, k in b.get("wear", [])],
        )
        for i, b in enumerate(scene["blocks"], start=1)
    ]


class Peaks:
    """Largest sizes of a vector's parts in x and y, and of its length."""

    def __init__(self) -> None:
        self.values = [ZERO, ZERO, ZERO]

    def take(self, series: list[Series], h: Decimal) -> None:
        """Take a vector over a step."""
        sizes = []
        for a, p in enumerate(series):
            ends = [abs(p[0]), abs(at(p, h))]
            sizes.append(at([abs(c) for c in p], h))
            if sizes[a] > self.values[a]:
                ends += [abs(at(p, t)) for t in roots(derivative(p), h)]
            self.values[a] = max(self.values[a], *ends)
        times = [ZERO, h]
        if length(sizes) > self.values[2]:
            x, y = (product(p, derivative(p)) for p in series)
            times += roots([one + other for one, other in zip(x, y, strict=True)], h)
        self.values[2] = max(self.values[2], *(length([at(p, t) for p in series]) for t in times))
