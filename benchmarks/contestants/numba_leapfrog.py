"""The method a good engineer writes by hand: half-explicit leapfrog in numba.

Friction is an impulse clipped to its limit, and divided where a block reverses within the step; storey springs follow
by return mapping; viscous forces take the velocity extrapolated to the end of the step.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from contestants.base import EVERYWHERE, Absent, FloatArray, Outcome, Setting
from scenes import BenchmarkScene, system

try:
    from numba import njit
except ImportError:
    njit = None


def _leapfrog(
    mass: FloatArray,
    damping: FloatArray,
    elements: FloatArray,
    hardening: FloatArray,
    block_mass: FloatArray,
    mu: FloatArray,
    ground: FloatArray,
    dt: float,
    substeps: int,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    n, samples = len(mass), len(ground)
    h = dt / substeps
    drift, slip = np.zeros((samples, n)), np.zeros((samples, n))
    peak_drift, peak_slip = np.zeros(n), np.zeros(n)
    d, p, s = np.zeros(n), np.zeros((n, 2)), np.zeros(n)
    v, before, w, force, end = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n + 1), np.zeros(n)
    relative = np.zeros(n)
    length = 0.5 * h
    for i in range(samples - 1):
        for step in range(substeps):
            a = ground[i] + (ground[i + 1] - ground[i]) * (step / substeps)
            for j in range(n):
                end[j] = 1.5 * v[j] - 0.5 * before[j]
            for j in range(n):
                q = force[j + 1] - force[j]
                for k in range(n):
                    q -= damping[j, k] * end[k]
                before[j] = v[j]
                v[j] += length * (q / mass[j] - a)
                if block_mass[j] > 0.0:
                    w[j] -= length * a
                    limit = mu[j] * block_mass[j] * 9.80665 * length
                    reduced = 1.0 / (1.0 / block_mass[j] + 1.0 / mass[j])
                    present, impulse = reduced * relative[j], reduced * (w[j] - v[j])
                    push = impulse - present
                    arrives = present * (impulse - np.copysign(limit, present)) <= 0.0
                    if not arrives:
                        impulse = np.copysign(limit, present)
                    elif abs(push) > limit:  # braked up to zero relative velocity, pushed from there on
                        impulse = np.copysign(limit, push) * (1.0 - 2.0 * abs(present) / (abs(push) + limit))
                    v[j] += impulse / mass[j]
                    w[j] -= impulse / block_mass[j]
                    relative[j] = 0.0 if arrives and abs(push) <= limit else w[j] - v[j]
            if length < h:  # from rest: the velocity before t = 0 mirrors that after
                length = h
                for j in range(n):
                    before[j] = -v[j]
            below = 0.0
            for j in range(n):
                d[j] += h * (v[j] - below)
                below = v[j]
                total = hardening[j] * d[j]
                for e in range(2):
                    trial = elements[j, e, 0] * (d[j] - p[j, e])
                    strength = elements[j, e, 1]
                    if abs(trial) > strength:
                        trial = strength if trial > 0.0 else -strength
                        p[j, e] = d[j] - trial / elements[j, e, 0]
                    total += trial
                force[j] = total
                peak_drift[j] = max(peak_drift[j], abs(d[j]))
                if block_mass[j] > 0.0:
                    s[j] += h * (w[j] - v[j])
                    peak_slip[j] = max(peak_slip[j], abs(s[j]))
        drift[i + 1] = d
        slip[i + 1] = s
    return drift, slip, peak_drift, peak_slip


_compiled: Any = None if njit is None else njit(_leapfrog)


def leapfrog(bench: BenchmarkScene, substeps: int) -> Outcome:
    """Run with so many steps per sample interval."""
    if _compiled is None:
        raise Absent("numba")
    plain = system(bench)
    drift, slip, peak_drift, peak_slip = _compiled(
        plain.mass,
        plain.damping,
        plain.elements,
        plain.hardening,
        plain.block_mass,
        plain.mu,
        plain.acceleration,
        plain.dt,
        substeps,
    )
    floors = list(plain.floors)
    return Outcome(drift, slip[:, floors], peak_drift, peak_slip[floors], slip[-1, floors])


def settings() -> list[Setting]:
    """Return the leapfrog with shorter and shorter steps, compiled."""
    if _compiled is not None:
        one, none = np.ones(1), np.zeros(1)
        _compiled(one, np.ones((1, 1)), np.ones((1, 2, 2)), none, one, one, np.zeros(2), 1e-3, 1)
    return [
        Setting(
            "leapfrog, numba",
            f"dt / {substeps}",
            partial(leapfrog, substeps=substeps),
            scenes=EVERYWHERE,
            quick=substeps <= 200,
        )
        for substeps in (1, 2, 5, 20, 50, 200, 500, 2000)
    ]
