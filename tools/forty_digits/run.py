"""A run of a plane scene from the first sample to the last, with its events."""

from __future__ import annotations

from decimal import Decimal, localcontext
from operator import mul
from typing import Any

from forty_digits.model import FORTY, Block, Peaks, Precision, Vector, angle, blocks, length, number, storeys
from forty_digits.polynomials import ZERO, Series, at, derivative, product, roots
from forty_digits.series import Motion

NEAR = Decimal("0.1")
"""A velocity that turns before it vanishes, below this part of the block's largest, has nearly missed a stop."""


def _drifts(floors: list[Series]) -> list[Series]:
    """Drifts of the storeys by the displacements of the floors."""
    below = [[ZERO] * len(floors[0]), *floors]
    return [[c - d for c, d in zip(*pair, strict=True)] for pair in zip(floors, below, strict=False)]


class _Run:
    """One run of a scene: the keys of a scene file that the kept scenes use."""

    def __init__(self, scene: dict[str, Any], precision: Precision) -> None:
        self.precision = precision
        building = scene["building"]
        both = [building, building | scene["other_direction"]]
        self.mass = [number(m) for m in building["mass"]]
        self.storeys = [storeys(b) for b in both]
        self.damping = [[[number(c) for c in row] for row in b["damping"]["matrix"]] for b in both]
        self.blocks = blocks(scene)
        self.u, self.v = ([[ZERO for _ in self.mass] for _ in range(2)] for _ in range(2))
        self.dt = number(scene["motion"]["dt"])
        self.ground = [[number(a) for a in scene[key]["acceleration"]] for key in ("motion", "other_motion")]
        still = {"acceleration": [0.0] * len(self.ground[0])}
        vertical = scene.get("vertical_motion", still)["acceleration"]
        self.contact = [number(9.80665) + number(a) for a in vertical]
        self.sample, self.tau = 0, ZERO
        self.fastest, self.steps = ZERO, 0
        self.starts = [0, 0]
        self.events: list[list[Any]] = []
        self.drift, self.acceleration = ([Peaks() for _ in self.mass] for _ in range(2))
        self.slip = [Peaks() for _ in self.blocks]

    def solve(self) -> dict[str, Any]:
        """Run to the last sample."""
        for node in range(len(self.mass) + 1):
            self._decide(node, [], {})
        for sample in range(len(self.contact) - 1):
            self.sample, self.tau = sample, ZERO
            while self.tau < self.dt:
                self._step()
        return self._result()

    def _line(self, samples: list[Decimal]) -> Series:
        """Samples as a straight line in the time from now on."""
        first, second = samples[self.sample : self.sample + 2]
        slope = (second - first) / self.dt
        return [first + slope * self.tau, slope]

    def _step(self) -> None:
        self.steps += 1
        ground, contact = [self._line(samples) for samples in self.ground], self._line(self.contact)
        motion = Motion(
            self.u, self.v, self.blocks, self.storeys, self.damping, self.mass, ground, contact, self.precision
        )
        for block, speed in zip(motion.moving, motion.speed, strict=True):
            power = next(k for k, c in enumerate(speed) if c)
            if speed[power] < 0:
                raise ValueError(f"block {block.number} grazes its limit in interval {self.sample}")
            if block.start is not None:
                self.starts[power - 1] += 1
        rest = self.dt - self.tau
        h = motion.end(rest)
        event = self._first(motion, h)
        if event is not None:
            h = event[0]
        slowing = self._advance(motion, h)
        self.tau = self.dt if h == rest else self.tau + h
        if event is not None:
            self._carry_out(*event[1])
        self._stop(slowing)

    def _first(self, motion: Motion, h: Decimal) -> tuple[Decimal, tuple[Any, ...]] | None:
        """The first event within a step, with its time from the start of the step."""
        found: list[tuple[Decimal, tuple[Any, ...]]] = []

        def consider(p: Series, size: Decimal, *event: Any) -> None:
            shifted = [p[0] + self.precision.tolerance * size, *p[1:]]
            found.extend((t, event) for t in roots(shifted, h, first=True))

        for node in range(len(self.mass) + 1):
            stuck = [b for b in self.blocks if b.node == node and not b.moves]
            if stuck:
                mu = min(b.mu_s for b in stuck)
                x, y = (product(motion.a[a][node], motion.a[a][node]) for a in range(2))
                left = [-one - other for one, other in zip(x, y, strict=True)]
                for k, c in enumerate(product(motion.contact, motion.contact)):
                    left[k] += mu * mu * c
                consider(left, (mu * motion.contact[0]) ** 2, "slip", node, mu)
        for a, of_direction in enumerate(self.storeys):
            for p, (storey, drift) in enumerate(zip(of_direction, _drifts(motion.u[a]), strict=True)):
                for e, part in enumerate(storey.parts, start=1):
                    if part.plastic:
                        rate = [part.plastic * c for c in derivative(drift)]
                        consider(rate, self.fastest, "unload", a, p, part.plastic)
                        continue
                    for sign in (1, -1):
                        force = [-sign * part.stiffness * c for c in drift]
                        force[0] += part.strength + sign * part.stiffness * part.offset
                        consider(force, part.strength, "yield", a, p, sign, e)
        for block, speed in zip(motion.moving, motion.speed, strict=True):
            if block.worn < len(block.wear):
                limit = block.wear[block.worn][0]
                consider([limit - block.path, *(-c / k for k, c in enumerate(speed, start=1))], limit, "wear", block)
        return min(found, key=lambda entry: entry[0], default=None)

    def _advance(self, motion: Motion, h: Decimal) -> list[Block]:
        """Go to the end of a step; returns the blocks that become slower there."""
        x, y = (_drifts(floors) for floors in motion.u)
        for p in range(len(self.mass)):
            self.drift[p].take([x[p], y[p]], h)
            self.acceleration[p].take([motion.a[0][p + 1], motion.a[1][p + 1]], h)
        for a in range(2):
            self.u[a] = [at(series, h) for series in motion.u[a]]
            self.v[a] = [at(derivative(series), h) for series in motion.u[a]]
        slowing = []
        for block, r, speed in zip(motion.moving, motion.r, motion.speed, strict=True):
            slips = [[s, *(c / k for k, c in enumerate(p, start=1))] for s, p in zip(block.slip, r, strict=True)]
            self.slip[block.number - 1].take(slips, h)
            block.slip = [at(p, h) for p in slips]
            block.r = [at(p, h) for p in r]
            block.path += at([ZERO, *(c / k for k, c in enumerate(speed, start=1))], h)
            block.start = None
            block.fastest = max(block.fastest, length(block.r))
            rate = derivative(speed)
            block.turns += [at(speed, t) for t in roots(rate, h) if at(derivative(rate), t) > 0]
            if at(rate, h) < 0:
                slowing.append(block)
        floors = [length([one, other]) for one, other in zip(*self.v, strict=True)]
        self.fastest = max([self.fastest, *floors, *(b.fastest for b in self.blocks)])
        return slowing

    def _log(
        self, kind: str, count: int, sign: int = 0, element: int = 0, axis: str = "", of: float | None = None
    ) -> None:
        time = self.sample * self.dt + self.tau
        self.events.append([f"{time:.24f}", kind, count, sign, element, axis, of])

    def _carry_out(self, kind: str, *what: Any) -> None:
        if kind == "slip":
            node, mu = what
            self._decide(node, [b for b in self.blocks if b.node == node and not b.moves and b.mu_s == mu], {})
        elif kind == "wear":
            block: Block = what[0]
            _, block.mu_s, block.mu_k = block.wear[block.worn]
            block.worn += 1
            self._log("wear", block.number, element=block.worn, of=angle(block.r))
        else:
            a, p, sign, *element = what
            storey = self.storeys[a][p]
            if kind == "yield":
                storey.parts[element[0] - 1].plastic = sign
            else:
                for part in storey.parts:
                    part.unload(self.u[a][p] - (self.u[a][p - 1] if p else ZERO))
            self._log(kind, p + 1, sign, *(element or [0]), "xy"[a])

    def _stop(self, slowing: list[Block]) -> None:
        """Stop the blocks that come to rest, with those of the node that are nearly as slow."""
        slow = self.precision.rest * self.fastest
        for node in range(len(self.mass) + 1):
            arriving = [b for b in slowing if b.node == node and length(b.r) < 4 * slow]
            if any(length(b.r) < slow for b in arriving):
                headings = {b.number: angle(b.r) for b in arriving}
                for b in arriving:
                    b.r = [ZERO, ZERO]
                self._decide(node, [], headings)

    def _decide(self, node: int, fired: list[Block], arrived: dict[int, float]) -> None:
        """Release the blocks at rest that exceed their limits: A is parallel to the force, in whatever order."""
        on_node = [b for b in self.blocks if b.node == node]
        contact = self._line(self.contact)[0]
        force = [self._line(samples)[0] for samples in self.ground] if node == 0 else self._force(node - 1)
        for b in on_node:
            if node and not b.rests:
                push = b.mu_k * b.mass * contact / length(b.r)
                force = [f + push * c for f, c in zip(force, b.r, strict=True)]
        size = length(force)
        resting = [b for b in on_node if b.rests]
        released = [b for b in resting if b in fired or b.start is not None]
        while True:
            held = [b for b in resting if b not in released]
            a = size
            if node:
                friction = sum((b.mu_k * b.mass * contact for b in released), ZERO)
                a = (size - friction) / (self.mass[node - 1] + sum((b.mass for b in held), ZERO))
            more = [b for b in held if a > b.mu_s * contact * (1 + self.precision.tolerance)]
            if not more:
                break
            released += more
        for b in resting:
            if b in released:
                is_new = b.start is None
                b.start = [-c / size for c in force]
                if is_new:
                    self._log("reverse" if b.number in arrived else "slip", b.number, of=angle(b.start))
            elif b.number in arrived:
                self._log("stick", b.number, of=arrived[b.number])

    def _force(self, p: int) -> Vector:
        """Force of springs and dampers on a floor now."""
        found = []
        for a in range(2):
            drifts = [one - other for one, other in zip(self.u[a], [ZERO, *self.u[a]], strict=False)]
            shear = [s.tangent() * d + s.constant() for s, d in zip(self.storeys[a], drifts, strict=True)]
            shear.append(ZERO)
            found.append(shear[p + 1] - shear[p] - sum(map(mul, self.damping[a][p], self.v[a]), ZERO))
        return found

    def _result(self) -> dict[str, Any]:
        def text(values: list[Decimal]) -> list[str]:
            return [f"{value:.24e}" for value in values]

        drift = [[self.u[a][p] - (self.u[a][p - 1] if p else ZERO) for a in range(2)] for p in range(len(self.mass))]
        return {
            "peak_drift": [text(peak.values) for peak in self.drift],
            "peak_acceleration": [text(peak.values) for peak in self.acceleration],
            "peak_slip": [text(peak.values) for peak in self.slip],
            "path": text([b.path for b in self.blocks]),
            "residual_drift": [text(pair) for pair in drift],
            "residual_slip": [text(b.slip) for b in self.blocks],
            "near_misses": sum(turn < NEAR * b.fastest for b in self.blocks for turn in b.turns),
            "starts": {"with an acceleration": self.starts[0], "without": self.starts[1]},
            "steps": self.steps,
            "events": self.events,
        }


def solve(scene: dict[str, Any], precision: Precision = FORTY) -> dict[str, Any]:
    """Solve a scene: peaks, path, what remains, and events."""
    with localcontext() as context:
        context.prec = precision.digits
        return _Run(scene, precision).solve()
