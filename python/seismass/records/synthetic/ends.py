"""The two ends of a synthetic motion: it rises from nothing, and comes to rest at the place where it started."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seismass.records.intensity import integrals

Array = NDArray[np.float64]


def ramp(values: Array, low: float, high: float) -> Array:
    """Rise smoothly from 0 at `low` to 1 at `high`."""
    return np.sin(0.5 * np.pi * np.clip((values - low) / (high - low), 0.0, 1.0)) ** 2


def tapered(motion: Array, time: Array) -> Array:
    """Let the motion rise within 1.5 s and end within the last three."""
    return motion * ramp(time, 0.0, 1.5) * ramp(time[-1] - time, 0.0, 3.0)


def end_state(acceleration: Array, dt: float) -> tuple[float, float]:
    """Return velocity and displacement at the last sample, exact for accelerations linear between samples."""
    velocity, displacement = integrals(acceleration, dt)
    return float(velocity[-1]), float(displacement[-1])


def at_rest_in_the_end(motion: Array, dt: float) -> Array:
    """Take off a smooth acceleration such that the final velocity and displacement vanish."""
    along = np.linspace(0.0, 1.0, len(motion))
    shapes = [np.sin(np.pi * along) ** 2, np.sin(np.pi * along) ** 2 * (along - 0.5)]
    ends = np.array([end_state(shape, dt) for shape in shapes]).T
    amounts = np.linalg.solve(ends, np.array(end_state(motion, dt)))
    corrected: Array = motion - amounts[0] * shapes[0] - amounts[1] * shapes[1]
    return corrected
