"""The address of a case of the live page, as `caseOf` of case.js reads it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

MOST_STOREYS: Final = 4
"""Storeys that the page solves."""
PAGE: Final = "explorer.html"
"""File that `seismass explore` writes."""
RECORD: Final = "synthetic-1"
LIMITS: Final = {
    "T": (0.05, 5.0),
    "z": (0.0, 0.5),
    "O": (1.0, 10.0),
    "r2": (0.0, 1.0),
    "h": (0.5, 20.0),
    "V": (0.001, 20.0),
    "a": (0.0, 10.0),
    "s": (0.0, 5.0),
    "k": (0.0, 5.0),
    "c": (0.0, 1.0),
}
"""Range of each number, by its letters in the address: `LIMITS` of case.js."""


@dataclass(frozen=True)
class LiveCase:
    """A building as the live page has it: equal floor masses and stiffnesses, heights and springs.

    Attributes
    ----------
    period, damping, overstrength, second_slope, height : float
        First period without goods (s), damping ratio, Omega, r2 and storey height (m).
    strength : sequence of float
        V_y of each storey over the weight without goods; empty where the building stays elastic.
    mass_ratio, mu_s, mu_k : sequence of float
        Goods over floor mass, and their friction, floor by floor.
    counted : float
        Share of the goods that the model of the code has attached.
    """

    period: float
    damping: float
    overstrength: float
    second_slope: float
    height: float
    strength: Sequence[float]
    mass_ratio: Sequence[float]
    mu_s: Sequence[float]
    mu_k: Sequence[float]
    counted: float

    @property
    def numbers(self) -> dict[str, Sequence[float]]:
        """What the address says, by its letters."""
        alone = {"T": self.period, "z": self.damping, "O": self.overstrength, "r2": self.second_slope, "h": self.height}
        lists = {"a": self.mass_ratio, "s": self.mu_s, "k": self.mu_k}
        lists |= {"V": self.strength} if self.strength else {}
        return {**{key: [value] for key, value in alone.items()}, "c": [self.counted], **lists}

    @property
    def beyond(self) -> tuple[str, ...]:
        """Letters of the numbers that the page does not take."""
        found = self.numbers.items()
        return tuple(key for key, values in found if not all(LIMITS[key][0] <= one <= LIMITS[key][1] for one in values))

    @property
    def address(self) -> str:
        """What follows the # of the address."""
        by = "hand" if self.strength else "elastic"
        parts = ["v=1", f"by={by}", f"m={RECORD}", "d=code", f"n={len(self.mass_ratio)}", "x=1"]
        parts += [f"{key}={','.join(f'{value:.10g}' for value in values)}" for key, values in self.numbers.items()]
        return "&".join(parts)
