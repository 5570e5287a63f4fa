"""Storey springs pushed slowly: tangents in either direction and how far they hold, without the kernel.

A spring is moved in steps that end at the latest where its tangent changes.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from seismass.base.values import FloatArray
from seismass.model.building import Building

_SNAP = 1e-12
"""Rounding of a step, over the drift, up to which it reaches the end of a segment."""


class StoreySpring(Protocol):
    """A spring with its state; `sign` is 1 for more drift, -1 for less."""

    drift: float

    @property
    def force(self) -> float:
        """Force (N)."""
        ...

    def tangent(self, sign: int) -> float:
        """Return the tangent (N/m) in a direction."""

    def room(self, sign: int) -> float:
        """Return how far (m, positive) the tangent holds in a direction; infinite where it does so for ever."""

    def move(self, sign: int, length: float) -> str | None:
        """Move by a length (m), not beyond the room there is; return the kind of event at its end, or None."""


class MasingSpring:
    """Elastic-perfectly-plastic elements in parallel with a linear one (Iwan 1966), and a stop beyond a clearance."""

    def __init__(
        self, stiffness: list[float], yield_drift: list[float], linear: float, clearance: float, stop_stiffness: float
    ) -> None:
        self.drift = 0.0
        self._stiffness = np.array(stiffness)
        self._yield_drift = np.array(yield_drift)
        self._stretch = np.zeros(len(stiffness))  # elastic drift of each element
        self._yielded = np.zeros(len(stiffness), dtype=np.int64)  # sign of those that yield
        self._linear, self._clearance, self._stop = linear, clearance, stop_stiffness

    @property
    def force(self) -> float:
        """Force (N)."""
        elements = float(self._stiffness @ self._stretch)
        return elements + self._linear * self.drift + self._stop * max(self.drift - self._clearance, 0.0)

    def tangent(self, sign: int) -> float:
        """Return the tangent (N/m) in a direction."""
        touches = self.drift >= self._clearance if sign > 0 else self.drift > self._clearance
        stiffness = float(self._stiffness[self._yielded != sign].sum()) + self._linear
        return stiffness + self._stop if touches else stiffness

    def room(self, sign: int) -> float:
        """Return how far (m) the tangent holds in a direction."""
        return min(self._room_of_stop(sign), float(self._rooms(sign).min(initial=np.inf)))

    def move(self, sign: int, length: float) -> str | None:
        """Move by a length (m) and return "yield", "close" or "open" where that happens at its end."""
        rooms, stop = self._rooms(sign), self._room_of_stop(sign)
        slack = length + _SNAP * (abs(self.drift) + length)
        self._yielded[self._yielded == -sign] = 0
        moving = self._yielded != sign
        self._stretch[moving] += sign * length
        self.drift += sign * length
        ends = moving & (rooms <= slack)
        self._yielded[ends] = sign
        self._stretch[ends] = sign * self._yield_drift[ends]
        if stop <= slack:
            self.drift = self._clearance
            return "close" if sign > 0 else "open"
        return "yield" if ends.any() else None

    def _rooms(self, sign: int) -> FloatArray:
        return np.where(self._yielded == sign, np.inf, np.maximum(self._yield_drift - sign * self._stretch, 0.0))

    def _room_of_stop(self, sign: int) -> float:
        away = sign * (self._clearance - self.drift)
        return away if away > 0.0 and self._stop > 0.0 else np.inf


class PeakOrientedSpring:
    """A backbone that may soften, and unloading with Takeda's stiffness; the force stays positive."""

    def __init__(self, corners: list[float], slopes: list[float], *, exponent: float) -> None:
        self.drift, self.force = 0.0, 0.0
        self._corners, self._slopes, self._exponent = corners, slopes, exponent
        self._branch = 0
        self._peak = 0.0
        self._peak_force = 0.0

    def tangent(self, sign: int) -> float:
        """Return the tangent (N/m) in a direction."""
        return self._slopes[self._branch] if sign > 0 and self.drift >= self._peak else self._unloading()

    def room(self, sign: int) -> float:
        """Return how far (m) the tangent holds in a direction."""
        if sign < 0:
            return np.inf
        if self.drift < self._peak:
            return self._peak - self.drift
        return self._corners[self._branch] - self.drift if self._branch < len(self._corners) else np.inf

    def move(self, sign: int, length: float) -> str | None:
        """Move by a length (m) and return "yield" where a corner of the backbone is its end."""
        room, on_backbone = self.room(sign), self.drift >= self._peak
        reached = room <= length + _SNAP * (abs(self.drift) + length)
        self.force += self.tangent(sign) * sign * length
        self.drift += sign * length
        if sign < 0:
            return None
        if not on_backbone:
            if reached:
                self.drift = self._peak
            return None
        if reached:
            self.drift = self._corners[self._branch]
            self._branch += 1
        self._peak = self.drift
        self._peak_force = self.force
        return "yield" if reached else None

    def _unloading(self) -> float:
        initial = self._slopes[0]
        if self._branch == 0:
            return initial
        taken = initial * min((self._corners[0] / self._peak) ** self._exponent, 1.0)
        return float(max(taken, self._peak_force / self._peak))


def storey_spring(building: Building, storey: int) -> StoreySpring:
    """Return the virgin spring of a storey, numbered from 0."""
    springs = {name: float(values[storey]) for name, values in building.springs.items()}
    k, v_y, clearance = springs["stiffness"], springs["yield_shear"], springs["clearance"]
    points = None if building.backbone is None else building.backbone[storey]
    if points is not None:
        drifts, forces = np.array(points).T
        slopes = (np.diff(forces, prepend=0.0) / np.diff(drifts, prepend=0.0)).tolist()
        return _masing(drifts[:-1].tolist(), slopes, np.inf, 0.0)
    if np.isinf(v_y) or k == 0.0:
        return _masing([], [k], clearance, springs["stop_stiffness"])
    corners, slopes, force = [v_y / k], [k], v_y
    if springs["overstrength"] > 1.0:
        slopes.append(springs["second_slope"] * k)
        if slopes[-1] > 0.0:
            force *= springs["overstrength"]
            corners.append(corners[-1] + (force - v_y) / slopes[-1])
    if len(corners) == len(slopes):
        slopes.append(springs["third_slope"] * k)
    if building.hysteresis[storey] != "peak-oriented":
        return _masing(corners, slopes, clearance, springs["stop_stiffness"])
    if slopes[-1] < 0.0:
        corners.append(corners[-1] + (force - springs["residual_strength"] * v_y) / -slopes[-1])
        slopes.append(0.0)
    return PeakOrientedSpring(corners, slopes, exponent=springs["unloading_exponent"])


def _masing(corners: list[float], slopes: list[float], clearance: float, stop: float) -> MasingSpring:
    parts = [(first - second, drift) for drift, first, second in zip(corners, slopes, slopes[1:], strict=False)]
    elements = [part for part in parts if part[0] > 0.0]
    return MasingSpring([part[0] for part in elements], [part[1] for part in elements], slopes[-1], clearance, stop)
