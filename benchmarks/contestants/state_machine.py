"""The scene as a state machine over linear systems, for integrators that locate events: one block per floor, one mu.

Regime: each element elastic or plastic with a sign, each block stuck (0) or sliding with a sign. In a regime
x' = A x + b + a_g c with x = (drift, floor velocity, slip, relative velocity), and every guard is linear in x and a_g.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from contestants.base import Failed, FloatArray
from scenes import System

GRAVITY: Final = 9.80665
ROUNDING: Final = 1e-13
"""Guards of this size over their terms are zero, if the integrator is no coarser."""
SLOW: Final = 1e-9
"""And fall if they fall faster than this (1/s)."""


@dataclass(frozen=True)
class Guard:
    """row @ x + offset >= 0 holds in the regime; `scale` is the size of its terms."""

    kind: str
    floor: int
    element: int
    sign: float
    row: FloatArray
    offset: float
    scale: float


class Machine:
    """State and regime of a scene, from rest; `tolerance` is that of the integrator."""

    def __init__(self, plain: System, tolerance: float) -> None:
        n = self.n = plain.storeys
        self.plain = plain
        self.zero, self.slow = max(ROUNDING, 10.0 * tolerance), max(SLOW, 100.0 * tolerance)
        self.x = np.zeros(4 * n)
        self.plastic = np.zeros((n, 2))
        self.offset = np.zeros((n, 2))
        self.slides = np.zeros(n)
        self._enter()

    def _forces(self) -> tuple[FloatArray, FloatArray]:
        """Force on each floor without friction as rows on x and constants."""
        n, plain = self.n, self.plain
        storey, constant = np.zeros((n, 4 * n)), np.zeros(n)
        for i in range(n):
            storey[i, i] = plain.hardening[i]
            for e in range(2):
                stiffness, strength = plain.elements[i, e]
                if self.plastic[i, e]:
                    constant[i] += self.plastic[i, e] * strength
                else:
                    storey[i, i] += stiffness
                    constant[i] -= stiffness * self.offset[i, e]
        rows, constants = -storey, -constant
        rows[:-1] += storey[1:]
        constants[:-1] += constant[1:]
        rows[:, n : 2 * n] -= plain.damping
        return rows, constants

    def _enter(self) -> None:
        """Form the linear system and the guards of the regime."""
        n, plain = self.n, self.plain
        rows, constants = self._forces()
        self.matrix, self.constant, self.ground = np.zeros((4 * n, 4 * n)), np.zeros(4 * n), np.zeros(4 * n)
        for i in range(n):
            self.matrix[i, n + i] = 1.0
            if i:
                self.matrix[i, n + i - 1] = -1.0
            friction = plain.mu[i] * GRAVITY * self.slides[i]
            stuck = plain.block_mass[i] > 0.0 and not self.slides[i]
            moving = plain.mass[i] + (plain.block_mass[i] if stuck else 0.0)
            self.matrix[n + i] = rows[i] / moving
            self.constant[n + i] = (constants[i] + friction * plain.block_mass[i]) / moving
            if self.slides[i]:
                self.matrix[2 * n + i, 3 * n + i] = 1.0
                self.matrix[3 * n + i] = -self.matrix[n + i]
                self.constant[3 * n + i] = -friction - self.constant[n + i]
        self.ground[n : 2 * n] = -1.0
        self.guards = [guard for i in range(n) for guard in (*self._storey_guards(i), *self._block_guards(i))]

    def _storey_guards(self, i: int) -> list[Guard]:
        found = []
        for e, (stiffness, strength) in enumerate(self.plain.elements[i]):
            if self.plastic[i, e] or stiffness == 0.0 or not np.isfinite(strength):
                continue
            for sign in (1.0, -1.0):
                row = np.zeros(4 * self.n)
                row[i] = -sign * stiffness
                offset = strength + sign * stiffness * self.offset[i, e]
                found.append(Guard("yield", i, e, sign, row, offset, strength))
        sign = self.plastic[i, 0] or self.plastic[i, 1]
        if sign:
            found.append(Guard("unload", i, 0, sign, sign * self.matrix[i], 0.0, 1.0))
        return found

    def _block_guards(self, i: int) -> list[Guard]:
        n, plain = self.n, self.plain
        if plain.block_mass[i] == 0.0:
            return []
        if self.slides[i]:
            row = np.zeros(4 * n)
            row[3 * n + i] = self.slides[i]
            return [Guard("arrive", i, 0, self.slides[i], row, 0.0, 1.0)]
        limit = plain.mu[i] * GRAVITY
        return [
            Guard("slip", i, 0, s, -s * self.matrix[n + i], limit - s * self.constant[n + i], limit)
            for s in (1.0, -1.0)
        ]

    def rate(self, x: FloatArray, acceleration: float) -> FloatArray:
        """Time derivative of the state."""
        derivative: FloatArray = self.matrix @ x + self.constant + acceleration * self.ground
        return derivative

    def fire(self, guard: Guard, acceleration: float) -> None:
        """Carry out the event of a guard, and those of the same instant."""
        for _ in range(50):
            self._carry_out(guard)
            self._enter()
            change = self.rate(self.x, acceleration)
            fallen = [
                other
                for other in self.guards
                if other.row @ self.x + other.offset <= self.zero * other.scale
                and other.row @ change < -self.slow * other.scale
            ]
            if not fallen:
                return
            guard = fallen[0]
        raise Failed("the state machine does not come to rest")

    def _carry_out(self, guard: Guard) -> None:
        n, i, plain = self.n, guard.floor, self.plain
        if guard.kind == "yield":
            self.plastic[i, guard.element] = guard.sign
        elif guard.kind == "unload":
            for e, (stiffness, strength) in enumerate(plain.elements[i]):
                if self.plastic[i, e]:
                    self.offset[i, e] = self.x[i] - self.plastic[i, e] * strength / stiffness
                    self.plastic[i, e] = 0.0
            self.x[n + i : 2 * n] -= self.matrix[i] @ self.x
        elif guard.kind == "slip":
            self.slides[i] = -guard.sign
        else:
            self.x[3 * n + i] = 0.0
            rows, constants = self._forces()
            demand = (rows[i] @ self.x + constants[i]) / (plain.mass[i] + plain.block_mass[i])
            self.slides[i] = 0.0 if abs(demand) <= plain.mu[i] * GRAVITY else -np.sign(demand)
