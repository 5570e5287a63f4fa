"""The state machine as coefficients of one system of equations and guards, for integrators compiled once per scene.

Every guard is a factor times its quantity (drift of a storey, drift rate, absolute acceleration of a floor without
friction's change, relative velocity of a block) plus a limit.
"""

from __future__ import annotations

import numpy as np

from contestants.base import Failed, FloatArray
from contestants.state_machine import GRAVITY, ROUNDING, Guard, Machine
from scenes import System

Slot = tuple[str, int, int, float]
"""Kind, floor, element and sign of a guard; no sign where a regime has one of both signs."""


def slots(plain: System) -> tuple[Slot, ...]:
    """Return the guards that a scene can have: an integrator has no others to watch."""
    found: list[Slot] = []
    for i, elements in enumerate(plain.elements):
        yielding = [e for e, (stiffness, strength) in enumerate(elements) if stiffness > 0.0 and np.isfinite(strength)]
        found += [("yield", i, e, sign) for e in yielding for sign in (1.0, -1.0)]
        if yielding:
            found.append(("unload", i, 0, 0.0))
        if plain.block_mass[i] > 0.0:
            found += [("slip", i, 0, 1.0), ("slip", i, 0, -1.0), ("arrive", i, 0, 0.0)]
    return tuple(found)


def _slot(guard: Guard) -> Slot:
    return guard.kind, guard.floor, guard.element, guard.sign if guard.kind in ("yield", "slip") else 0.0


def _factor(guard: Guard) -> float:
    """Return the factor of a guard on its quantity: drift, its rate, relative velocity, or floor acceleration."""
    if guard.kind == "yield":
        return float(guard.row[guard.floor])
    return -guard.sign if guard.kind == "slip" else guard.sign


class Watched:
    """State machine of a scene from rest, and its regime as numbers.

    Attributes
    ----------
    coefficients : ndarray
        Per floor the row of its absolute acceleration on drifts and velocities, and the constant; per block the factor
        on its floor's acceleration and the constant of its relative acceleration; then the factors of all guards.
    limits : ndarray
        Limits of all guards; one that the regime does not have is 1 with the factor 0.
    """

    def __init__(self, plain: System, tolerance: float) -> None:
        self.numbers = {slot: number for number, slot in enumerate(slots(plain))}
        self.machine = Machine(plain, tolerance)
        self._enter()

    def _enter(self) -> None:
        n, machine, count = self.machine.n, self.machine, len(self.numbers)
        floors = np.column_stack((machine.matrix[n : 2 * n, : 2 * n], machine.constant[n : 2 * n]))
        blocks = np.column_stack((-np.abs(machine.slides), -GRAVITY * machine.plain.mu * machine.slides))
        self.guards = {self.numbers[_slot(guard)]: guard for guard in machine.guards}
        factors, self.limits, self.offsets = np.zeros(count), np.ones(count), np.ones(count)
        self.rows = np.zeros((count, 4 * n))
        for number, guard in self.guards.items():
            factors[number], self.rows[number] = _factor(guard) / guard.scale, guard.row / guard.scale
            self.offsets[number] = guard.offset / guard.scale
            self.limits[number] = 1.0 if guard.kind == "slip" else self.offsets[number]
        self.coefficients: FloatArray = np.concatenate((floors.ravel(), blocks.ravel(), factors))

    def values(self, x: FloatArray) -> FloatArray:
        """Return the guards over their scales."""
        values: FloatArray = self.rows @ x + self.offsets
        return values

    def lifted(self, x: FloatArray, instant: float) -> FloatArray:
        """Return the limits from a state on, until the next event or sample: no guard starts below `ROUNDING`.

        Raises
        ------
        Failed
            If a guard is so far below zero that its event must have been missed before this instant.
        """
        values = self.values(x)
        if values.min(initial=1.0) < -self.machine.zero:
            raise Failed(f"an event was missed before t = {instant:.3f} s")
        limits: FloatArray = self.limits + np.maximum(ROUNDING - values, 0.0)
        return limits

    def fire(self, number: int, x: FloatArray, acceleration: float) -> None:
        """Carry out the event of a guard in a state, and those of the same instant."""
        self.machine.x = x
        self.machine.fire(self.guards[number], acceleration)
        self._enter()
