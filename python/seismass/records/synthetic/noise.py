"""Normal numbers that are the same in every version of Python, as the stream of `random` is; times of samples."""

from __future__ import annotations

import random

import numpy as np
from numpy.typing import NDArray


def sample_times(count: int, dt: float) -> NDArray[np.float64]:
    """Return the times (s) of samples from zero on, shape (count,)."""
    return np.arange(count).astype(np.float64) * dt


def normals(source: random.Random, count: int) -> NDArray[np.float64]:
    """Return standard normal numbers by Box and Muller's formula, shape (count,)."""
    pairs = [(source.random(), source.random()) for _ in range((count + 1) // 2)]
    radius = np.sqrt(-2.0 * np.log(1.0 - np.array([p for p, _ in pairs])))
    angle = 2.0 * np.pi * np.array([q for _, q in pairs])
    return np.stack((radius * np.cos(angle), radius * np.sin(angle)), axis=1).ravel()[:count]
