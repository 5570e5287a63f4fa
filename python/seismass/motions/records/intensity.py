"""Measures of a ground motion whose acceleration is linear between samples, each exact for that motion.

Velocity is then quadratic and displacement cubic between samples, so that peaks, integrals and crossings have closed
forms within every step. The motion starts from rest at its first sample and ends at its last.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, brief, refusal

BRACKET_G: Final = 0.05
"""Threshold of the bracketed duration (g), Bolt (1973)."""


def integrals(acceleration: FloatArray, dt: float) -> tuple[FloatArray, FloatArray]:
    """Return velocity (m/s) and displacement (m) at the samples, from rest, of accelerations (m/s2) that are linear
    between samples, shape (..., samples).
    """
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    velocity = np.zeros(acceleration.shape)
    np.cumsum(0.5 * dt * (before + after), axis=-1, out=velocity[..., 1:])
    displacement = np.zeros(acceleration.shape)
    steps = dt * velocity[..., :-1] + dt * dt / 6.0 * (2.0 * before + after)
    np.cumsum(steps, axis=-1, out=displacement[..., 1:])
    return velocity, displacement


def peak_velocity(acceleration: FloatArray, dt: float, velocity: FloatArray) -> FloatArray:
    """Return the largest absolute velocity in continuous time (m/s): at a sample, or where acceleration is zero."""
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    crosses = before * after < 0.0
    first, last = before[crosses], after[crosses]
    turns = np.zeros(crosses.shape)
    turns[crosses] = velocity[..., :-1][crosses] + 0.5 * dt * first * (first / (first - last))
    return _largest(velocity, turns)


def peak_displacement(
    acceleration: FloatArray, dt: float, velocity: FloatArray, displacement: FloatArray
) -> FloatArray:
    """Return the largest absolute displacement in continuous time (m): at a sample, or where velocity is zero."""
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    # Velocity may be zero within a step if it changes sign or turns there.
    crosses = (velocity[..., :-1] * velocity[..., 1:] < 0.0) | (before * after < 0.0)
    start, slope = velocity[..., :-1][crosses], dt * before[crosses]
    bend = 0.5 * dt * (after[crosses] - before[crosses])
    # It is start + slope s + bend s^2 for s from 0 to 1; both roots without cancellation, 0 for those outside.
    discriminant = slope * slope - 4.0 * bend * start
    has_root = discriminant >= 0.0
    w = -0.5 * (slope + np.copysign(np.sqrt(np.where(has_root, discriminant, 0.0)), slope))
    turns = np.zeros((2, *crosses.shape))
    for turn, above, below in zip(turns, (w, start), (bend, w), strict=True):
        inside = has_root & (np.abs(above) < np.abs(below)) & ((above > 0.0) == (below > 0.0))
        s = np.divide(above, below, out=np.zeros(w.shape), where=inside)
        moved = dt * s * (start + s * (0.5 * slope + s * bend / 3.0))
        turn[crosses] = displacement[..., :-1][crosses] + moved
    return _largest(displacement, *turns)


def _largest(*values: FloatArray) -> FloatArray:
    """Largest absolute value over the last axes."""
    largest = [np.max(np.abs(part), axis=-1, initial=0.0) for part in values]
    return np.asarray(np.max(largest, axis=0), dtype=np.float64)


def build_up(acceleration: FloatArray, dt: float) -> FloatArray:
    """Return the Arias intensity up to each sample (m/s): pi/(2 g) times the integral of a^2, cubic within a step
    (Arias 1970, A measure of earthquake intensity).
    """
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    built = np.zeros(acceleration.shape)
    np.cumsum((before * before + before * after + after * after) * (dt / 3.0), axis=-1, out=built[..., 1:])
    return built * (math.pi / (2.0 * STANDARD_GRAVITY))


def time_of_share(acceleration: FloatArray, dt: float, share: float) -> float:
    """Return the first time (s) at which the Arias build-up reaches a share of its end; 0 for a motion of zeros."""
    built = build_up(acceleration, dt)
    level = min(share * float(built[-1]), float(built[-1]))
    last = int(np.searchsorted(built, level))  # the first sample at which it is reached
    if last == 0:
        return 0.0
    first, end = float(acceleration[last - 1]), float(acceleration[last])
    rest = (level - float(built[last - 1])) * (2.0 * STANDARD_GRAVITY / math.pi) / dt
    # The integral of a^2 from a = first to a = x is (x^3 - first^3) / (3 (end - first)) of a step.
    x = math.cbrt(first**3 + 3.0 * (end - first) * rest)
    below = x * x + x * first + first * first
    return dt * (last - 1 + min(3.0 * rest / below if below > 0.0 else 1.0, 1.0))


def significant_duration(acceleration: FloatArray, dt: float, start: float, end: float) -> float:
    """Return the time (s) between two shares of the Arias intensity; Trifunac and Brady (1975) take 0.05 and 0.95."""
    first = as_number(start, "start", "significant duration", InvalidOption)
    last = as_number(end, "end", "significant duration", InvalidOption)
    if not 0.0 <= first <= 1.0:
        raise refusal(InvalidOption, "start", "significant duration", "a share from 0 to 1", brief(start))
    if not first <= last <= 1.0:
        raise refusal(InvalidOption, "end", "significant duration", f"a share from {first:g} to 1", brief(end))
    return time_of_share(acceleration, dt, last) - time_of_share(acceleration, dt, first)


def cumulative_absolute_velocity(acceleration: FloatArray, dt: float) -> float:
    """Return the integral of abs(a) (m/s), with the changes of sign within steps; EPRI NP-5930 (1988), unfiltered."""
    size = np.abs(acceleration)
    before, after = size[:-1], size[1:]
    both = before + after
    crossing = acceleration[:-1] * acceleration[1:] < 0.0
    # Two triangles over a step where the sign changes, a trapezium elsewhere.
    triangles = np.divide(before * before + after * after, both, out=np.zeros(both.shape), where=crossing)
    return float(0.5 * dt * np.sum(np.where(crossing, triangles, both)))


def bracketed_duration(acceleration: FloatArray, dt: float, threshold_g: float) -> float:
    """Return the time (s) from the first to the last crossing of a threshold (above 0) of abs(a); 0 without one."""
    threshold = as_number(threshold_g, "threshold_g", "bracketed duration", InvalidOption)
    if not (math.isfinite(threshold) and threshold > 0.0):
        raise refusal(InvalidOption, "threshold_g", "bracketed duration", "a positive number", brief(threshold_g))
    size, level = np.abs(acceleration), threshold * STANDARD_GRAVITY
    above = np.flatnonzero(size >= level)
    if len(above) == 0:
        return 0.0

    def crossing(inside: int, outside: int) -> float:
        """Time from the sample at which the threshold is reached to its crossing towards the one beside it."""
        if not 0 <= outside < len(size):
            return 0.0
        value_outside = float(acceleration[outside]) * math.copysign(1.0, acceleration[inside])
        return dt * (float(size[inside]) - level) / (float(size[inside]) - value_outside)

    first, last = int(above[0]), int(above[-1])
    return (last - first) * dt + crossing(first, first - 1) + crossing(last, last + 1)
