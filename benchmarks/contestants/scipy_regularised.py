"""SciPy's adaptive integrators on smoothed friction: mu m g tanh(relative velocity / width).

Yielding is the rate law of an elastic-perfectly-plastic spring. The right-hand side is compiled with numba where that
is installed, and no step exceeds a sample interval, so that no part of the record is stepped over.
"""

from __future__ import annotations

from functools import partial
from typing import Any, Final

import numpy as np

from contestants.base import MAIN, Absent, Failed, FloatArray, Outcome, Setting, from_histories
from scenes import BenchmarkScene, system

try:
    from numba import njit
except ImportError:
    njit = None
try:
    from scipy.integrate import solve_ivp
except ImportError:
    solve_ivp = None

LENGTH: Final = 1e-3
"""Absolute tolerances are the relative one times this displacement (m), or what it means as velocity or force."""
VELOCITY: Final = 1e-2
MAX_EVALUATIONS: Final = 5_000_000
"""Evaluations of the right-hand side after which a run is given up: it chatters about a switch."""


def _right_hand_side(
    t: float,
    y: FloatArray,
    mass: FloatArray,
    damping: FloatArray,
    elements: FloatArray,
    hardening: FloatArray,
    block_mass: FloatArray,
    mu: FloatArray,
    ground: FloatArray,
    dt: float,
    width: float,
) -> FloatArray:
    """State: drift, floor velocity, forces of both elements, slip, block velocity; n of each."""
    n = len(mass)
    out = np.zeros(6 * n)
    place = min(int(t / dt), len(ground) - 2)
    a = ground[place] + (ground[place + 1] - ground[place]) * (t / dt - place)
    above = 0.0
    for j in range(n - 1, -1, -1):
        force = hardening[j] * y[j] + y[2 * n + j] + y[3 * n + j]
        q = above - force
        above = force
        for k in range(n):
            q -= damping[j, k] * y[n + k]
        rate = y[n + j] - (y[n + j - 1] if j > 0 else 0.0)
        out[j] = rate
        for e in range(2):
            f = y[(2 + e) * n + j]
            if abs(f) < elements[j, e, 1] or f * rate < 0.0:
                out[(2 + e) * n + j] = elements[j, e, 0] * rate
        if block_mass[j] > 0.0:
            relative = y[5 * n + j] - y[n + j]
            friction = mu[j] * block_mass[j] * 9.80665 * np.tanh(relative / width)
            q += friction
            out[4 * n + j] = relative
            out[5 * n + j] = -friction / block_mass[j] - a
        out[n + j] = q / mass[j] - a
    return out


_compiled: Any = _right_hand_side if njit is None else njit(_right_hand_side)


def _jacobian(t: float, y: FloatArray, *arguments: Any, scales: FloatArray) -> FloatArray:
    """Central differences; SciPy's own overflow where a variable, here the slip, does not enter."""
    columns = [
        (_compiled(t, y + step, *arguments) - _compiled(t, y - step, *arguments)) / (2.0 * step.max())
        for step in np.diag(1e-4 * scales)
    ]
    return np.stack(columns, axis=1)


class _Counted:
    """The right-hand side, for so many evaluations."""

    def __init__(self) -> None:
        self.evaluations = 0

    def __call__(self, t: float, y: FloatArray, *arguments: Any) -> FloatArray:
        self.evaluations += 1
        if self.evaluations > MAX_EVALUATIONS:
            raise Failed(f"{MAX_EVALUATIONS:.0e} evaluations at t = {t:.3f} s")
        derivative: FloatArray = _compiled(t, y, *arguments)
        return derivative


def integrate(bench: BenchmarkScene, method: str, width: float, tolerance: float) -> Outcome:
    """Integrate with one method, width (m/s) and relative tolerance."""
    if solve_ivp is None:
        raise Absent("scipy")
    plain = system(bench)
    n = plain.storeys
    times = np.arange(len(plain.acceleration)) * plain.dt
    force = float(plain.stiffness.max()) * LENGTH
    scales = np.repeat([LENGTH, VELOCITY, force, force, LENGTH, VELOCITY], n)
    newton = {"jac": partial(_jacobian, scales=scales)} if method == "Radau" else {}
    result = solve_ivp(
        _Counted(),
        (0.0, times[-1]),
        np.zeros(6 * n),
        method=method,
        t_eval=times,
        rtol=tolerance,
        atol=tolerance * scales,
        max_step=plain.dt,
        **newton,
        args=(
            plain.mass,
            plain.damping,
            plain.elements,
            plain.hardening,
            plain.block_mass,
            plain.mu,
            plain.acceleration,
            plain.dt,
            width,
        ),
    )
    if not result.success:
        raise Failed(result.message)
    floors = list(plain.floors)
    drift, velocity, _, _, slip, block = np.split(result.y.T, 6, axis=1)
    rate = np.diff(velocity, axis=1, prepend=0.0)
    return from_histories(drift, slip[:, floors], rate, (block - velocity)[:, floors], plain.dt)


def settings() -> list[Setting]:
    """Return three methods at several widths and tolerances; seconds each, so on one scene."""
    points = (
        ("DOP853", 1e-3, 1e-6, True),
        ("DOP853", 1e-4, 1e-8, False),
        ("Radau", 1e-3, 1e-6, False),
        ("LSODA", 1e-2, 1e-6, False),
        ("LSODA", 1e-3, 1e-6, True),
        ("LSODA", 1e-4, 1e-8, False),
    )
    return [
        Setting(
            f"SciPy {method}, tanh friction",
            f"{width:g} m/s, rtol {tolerance:g}",
            partial(integrate, method=method, width=width, tolerance=tolerance),
            scenes=MAIN,
            quick=quick,
        )
        for method, width, tolerance, quick in points
    ]
