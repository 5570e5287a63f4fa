"""The path of a pushover: from corner to corner of the storey springs, in series or beside walls."""

from __future__ import annotations

from typing import Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.values import FloatArray
from seismass.design.storey_springs import StoreySpring, storey_spring
from seismass.model.building import Building

_TIE: Final = 1e-12
"""Relative difference of base shears up to which storeys reach a corner together."""
_FLAT: Final = 1e-13
"""Tangent over the initial stiffness up to which it counts as zero: rounding of a difference of two tangents."""
_MOST_TURNS: Final = 20
"""Turns of directions, per storey, after which they are taken not to be found."""


class Path:
    """The path while it is found: its storeys move to the next corner of a spring, again and again."""

    def __init__(self, building: Building, share: FloatArray, limits: FloatArray, p_delta: FloatArray) -> None:
        self.springs: list[StoreySpring] = [storey_spring(building, i) for i in range(building.storeys)]
        self.elastic = building.stiffness
        self.share, self.limits, self.p_delta = share, limits, p_delta
        self.base_shear = 0.0
        self.mechanism: int | None = None
        self.end = ""
        self.base_shears, self.drifts, self.forces = [0.0], [np.zeros(len(share))], [np.zeros(len(share))]
        self.events: list[tuple[int, int, str]] = []
        self._limited = False  # the base shear does not grow

    def run(self) -> None:
        """Find points until the path ends."""
        raise NotImplementedError

    def wall_shear(self, drift: FloatArray) -> FloatArray:
        """Return the shear (N) of the walls in each storey, shape of `drift`."""
        return np.zeros_like(drift)

    def _capacity(self, storey: int) -> None:
        """Note that a storey, from 0, lets the base shear grow no further."""
        if not self._limited:
            self._limited = True
            self.mechanism = self.mechanism or storey + 1
            self.events.append((len(self.base_shears) - 1, storey + 1, "capacity"))

    def _tangents(self, sign: int) -> FloatArray:
        found = np.array([spring.tangent(sign) for spring in self.springs]) - self.p_delta
        return np.where(np.abs(found) <= _FLAT * self.elastic, 0.0, found)

    def _step(self, rates: FloatArray, slope: float) -> None:
        """Move by the rates of drift, with the base shear at a slope, up to the next corner."""
        signs = np.where(rates < 0.0, -1, 1)
        moving = rates != 0.0
        rooms, left = np.full(len(rates), np.inf), np.full(len(rates), np.inf)
        for i in np.flatnonzero(moving):
            rooms[i] = self.springs[i].room(int(signs[i])) / abs(rates[i])
            if signs[i] > 0:
                left[i] = max(self.limits[i] - self.springs[i].drift, 0.0) / rates[i]
        empty = self.base_shear / -slope if slope < 0.0 else np.inf
        length = min(float(rooms.min()), float(left.min()), empty)
        point = len(self.base_shears)
        for i in np.flatnonzero(moving):
            reaches = rooms[i] - length <= _TIE * (length + abs(self.springs[i].drift / rates[i]))
            whole = self.springs[i].room(int(signs[i])) if reaches else float(abs(rates[i]) * length)
            kind = self.springs[i].move(int(signs[i]), whole)
            if kind is not None:
                self.events.append((point, int(i) + 1, kind))
        self.base_shear = 0.0 if empty <= length else self.base_shear + slope * length
        self.base_shears.append(self.base_shear)
        self.drifts.append(np.array([spring.drift for spring in self.springs]))
        self.forces.append(np.array([spring.force for spring in self.springs]))
        if empty <= length:
            self._finish(int(np.argmax(rates)), "no strength left")
        elif left.min() <= length:
            self._finish(int(np.argmin(left)), "drift limit")

    def _finish(self, storey: int, kind: str) -> None:
        self.events.append((len(self.base_shears) - 1, storey + 1, kind))
        self.end = kind

    def event_table(self) -> pl.DataFrame:
        """Return the events, in order."""
        at = [event[0] for event in self.events]
        return pl.DataFrame(
            {
                "point": pl.Series(at, dtype=pl.UInt32),
                "base_shear": [self.base_shears[point] for point in at],
                "roof_displacement": [float(self.drifts[point].sum()) for point in at],
                "storey": pl.Series([event[1] for event in self.events], dtype=pl.UInt32),
                "kind": [event[2] for event in self.events],
            }
        )


class SeriesPath(Path):
    """That of a shear building: all storeys in series."""

    def run(self) -> None:
        """Find points until the path ends."""
        while not self.end:
            up = self._tangents(1)
            if (up > 0.0).all():
                self._limited = False
                self._step(self.share / up, 1.0)
                continue
            limiting = np.flatnonzero(up <= 0.0)
            # Flat storeys of one plateau share the drift only where none of them softens.
            order = np.argsort(up[limiting] / self.share[limiting], kind="stable")
            active = int(limiting[order[0]])
            self._capacity(active)
            rates = np.zeros(len(up))
            if up[active] == 0.0:
                rates[limiting] = self.share[limiting] / self.elastic[limiting]
                self._step(rates, 0.0)
                continue
            down = self._tangents(-1)
            others = np.arange(len(up)) != active
            if (down[others] <= 0.0).any():
                self._finish(int(np.flatnonzero(others & (down <= 0.0))[0]), "unstable unloading")
                return
            slope = up[active] / self.share[active]
            rates[others] = self.share[others] * slope / down[others]
            rates[active] = 1.0
            self._step(rates, slope)


class WallPath(Path):
    """That of a building with a stiffness matrix: the drifts of all storeys at once."""

    def __init__(self, building: Building, share: FloatArray, limits: FloatArray, p_delta: FloatArray) -> None:
        super().__init__(building, share, limits, p_delta)
        floors = np.tri(building.storeys)  # displacements of the floors by the drifts
        self._walls: FloatArray = floors.T @ (0.0 if building.stiffness_matrix is None else building.stiffness_matrix)
        self._walls = self._walls @ floors
        self._before = share  # rates of the drifts up to the last point

    def wall_shear(self, drift: FloatArray) -> FloatArray:
        """Return the shear (N) of the walls in each storey, shape of `drift`."""
        return drift @ self._walls

    def run(self) -> None:
        """Find points until the path ends."""
        while not self.end:
            up, down = self._tangents(1), self._tangents(-1)
            signs = np.where(self._before < 0.0, -1.0, 1.0)
            values, vectors = np.linalg.eigh(self._walls + np.diag(np.where(signs > 0.0, up, down)))
            flat = abs(values[0]) <= _FLAT * values[-1]
            if values[0] > 0.0 and not flat:
                rates = self._rates(signs, (up, down), 1.0)
                if rates is not None:
                    self._limited = False
                    self._follow(rates, 1.0)
                    continue
            limiting = int(np.argmin(up / self.share))
            self._capacity(limiting)
            rates, slope = vectors[:, 0] * np.sign(vectors[:, 0] @ self._before), 0.0
            if not flat or len(self._wrong(rates, signs, (up, down))):
                rates, slope = self._rates(signs, (up, down), -1.0), -1.0
            if rates is None or rates @ self._before <= 0.0:
                self._finish(limiting, "unstable unloading")
                return
            self._follow(rates, slope)

    def _follow(self, rates: FloatArray, slope: float) -> None:
        self._before = rates
        largest = float(np.abs(rates).max())
        self._step(rates / largest, slope / largest)

    def _rates(self, start: FloatArray, tangents: tuple[FloatArray, FloatArray], slope: float) -> FloatArray | None:
        """Drifts for a base shear of plus or minus 1, each by the tangent of its direction; None where not found.
        Lowest first, directions are turned (Murty 1974, Linear Algebra Appl. 9:1); ends if positive definite in all.
        """
        signs = start.copy()
        for _ in range(_MOST_TURNS * len(signs)):
            stiffness = self._walls + np.diag(np.where(signs > 0.0, *tangents))
            try:
                rates: FloatArray = np.linalg.solve(stiffness, slope * self.share)
            except np.linalg.LinAlgError:
                return None
            wrong = self._wrong(rates, signs, tangents)
            if not len(wrong):
                return rates
            signs[wrong[0]] *= -1.0
        return None

    def _wrong(self, rates: FloatArray, signs: FloatArray, tangents: tuple[FloatArray, FloatArray]) -> NDArray[np.intp]:
        """Storeys that do not move in the direction whose tangent was taken for them."""
        least = _TIE * float(np.abs(rates).max())
        return np.flatnonzero((rates * signs < -least) & (tangents[0] != tangents[1]))
