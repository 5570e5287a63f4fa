"""Directions in plan: angles between azimuths, and components of two recorded ones at any angle."""

from __future__ import annotations

import numpy as np

from seismass.base.values import FloatArray


def between(first: float, second: float) -> float:
    """Return the angle (degrees) from one azimuth to another, from -180 to below 180, clockwise positive."""
    return (second - first + 180.0) % 360.0 - 180.0


def at_angles(first: FloatArray, second: FloatArray, degrees: FloatArray, apart: float = 90.0) -> FloatArray:
    """Return components of a plane motion at angles (degrees) from its first towards its second component, shape
    (angles, samples). `apart` (degrees) is between these; at 90: first cos(angle) + second sin(angle).
    """
    from scipy.special import cosdg, sindg  # exact at quarter turns; slow to import

    across = second if apart == 90.0 else (second - cosdg(apart) * first) / sindg(apart)
    rotated: FloatArray = np.multiply.outer(cosdg(degrees), first)
    rotated += np.multiply.outer(sindg(degrees), across)
    return rotated
