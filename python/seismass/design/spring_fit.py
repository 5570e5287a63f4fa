"""A storey spring fitted to a curve of shear over drift: straight lines whose slopes do not grow, by least squares."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.values import FloatArray

SpringShape: TypeAlias = Literal["bilinear", "trilinear", "capped"]
"""Two lines, three, or three whose last one falls."""
SPRING_SHAPES: Final[tuple[SpringShape, ...]] = get_args(SpringShape)
_CORNERS: Final = 40
"""Most samples that are tried as corners."""
_STARTS: Final = 3
"""Trials from which corners are searched further."""
_STRAIGHT: Final = 1e-6
"""Change of slope at the first corner, over the first slope, below which a curve is straight."""
_LEAST_SLOPE: Final = 1e-6
"""Least second slope of a spring with a falling branch, which a plateau has in its place."""


@dataclass(frozen=True)
class FittedSpring:
    """A spring as `Building` takes it (N/m, N); with two lines the overstrength is 1 and both slopes are the second."""

    stiffness: float
    yield_shear: float
    overstrength: float
    second_slope: float
    third_slope: float

    @property
    def corners(self) -> tuple[float, ...]:
        """Drifts (m) at which the slope changes."""
        first = self.yield_shear / self.stiffness
        if self.overstrength == 1.0:
            return (first,)
        return first, first * (1.0 + (self.overstrength - 1.0) / self.second_slope)

    def force(self, drift: FloatArray) -> FloatArray:
        """Return the shear (N) at drifts (m)."""
        slopes = [1.0, self.third_slope] if len(self.corners) == 1 else [1.0, self.second_slope, self.third_slope]
        ends = [*self.corners, np.inf]
        starts = [0.0, *self.corners]
        found = np.zeros(len(drift))
        for slope, start, end in zip(slopes, starts, ends, strict=True):
            found += slope * np.clip(drift - start, 0.0, end - start)
        return self.stiffness * found


def sample_weights(drift: FloatArray) -> FloatArray:
    """Return the drift (m) that each sample stands for, so that the fit is of the curve and not of its samples."""
    ends = np.concatenate((drift[:1], 0.5 * (drift[1:] + drift[:-1]), drift[-1:]))
    return np.diff(ends)


def fitted_spring(drift: FloatArray, shear: FloatArray, shape: SpringShape) -> FittedSpring | None:
    """Return the least-squares spring of a curve from the origin, drifts in m and shears in N; None where it does not
    bend. For given corners, slopes by non-negative least squares (Lawson and Hanson 1974) never grow.
    """
    from scipy.optimize import least_squares, nnls

    root = np.sqrt(sample_weights(drift))
    scale = float(np.abs(shear).max())
    known = root * shear / scale
    count = 1 if shape == "bilinear" else 2

    def solved(corners: FloatArray) -> tuple[FloatArray, float]:
        found, distance = nnls(root[:, None] * _basis(drift, np.sort(corners), shape), known)
        return found, float(distance)

    inner = np.unique(drift[(drift > 0.0) & (drift < drift[-1])])
    if len(inner) > _CORNERS:
        inner = inner[np.linspace(0, len(inner) - 1, _CORNERS).astype(int)]
    if len(inner) < count:
        return None
    first = np.arange(len(inner))
    pairs = first[:, None] if count == 1 else np.column_stack(np.triu_indices(len(inner), 1))
    trials = sorted((solved(inner[pair])[1], tuple(inner[pair])) for pair in pairs)
    best = np.array(trials[0][1])
    least = trials[0][0]
    for _, start in trials[:_STARTS]:

        def residual(corners: FloatArray) -> FloatArray:
            ordered = np.sort(corners)
            found, _ = nnls(root[:, None] * _basis(drift, ordered, shape), known)
            misfit: FloatArray = root * (_basis(drift, ordered, shape) @ found) - known
            return misfit

        near = least_squares(
            residual,
            start,
            bounds=(1e-9 * drift[-1], drift[-1]),
            x_scale=np.maximum(start, 1e-6 * drift[-1]),
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
        distance = solved(near.x)[1]
        if distance < least:
            best, least = np.sort(near.x), distance
    return _spring(best, scale * solved(best)[0], shape)


def _basis(drift: FloatArray, corners: FloatArray, shape: SpringShape) -> FloatArray:
    """Columns whose non-negative sums are the curves of a shape."""
    short = [np.minimum(drift, corner) for corner in corners]
    last = drift if shape != "capped" else short[-1] - drift
    return np.column_stack([*short, last])


def _spring(corners: FloatArray, found: FloatArray, shape: SpringShape) -> FittedSpring | None:
    """The spring of corners (m) and coefficients (N/m)."""
    falls = shape == "capped"
    slopes = [found[0] + found[1], found[1], -found[2]] if falls else list(np.cumsum(found[::-1])[::-1])
    stiffness = float(slopes[0])
    if len(corners) == 2 and slopes[0] - slopes[1] <= _STRAIGHT * stiffness:  # the first corner is none
        corners, slopes = corners[1:], [slopes[0], slopes[2]]
    if not stiffness > 0.0 or slopes[0] - slopes[1] <= _STRAIGHT * stiffness:
        return None
    ratios = [float(slope) / stiffness for slope in slopes]
    strength = stiffness * float(corners[0])
    if len(corners) == 2 and (falls or ratios[1] > 0.0):
        second = max(ratios[1], _LEAST_SLOPE) if falls else ratios[1]
        overstrength = 1.0 + second * (float(corners[1]) / float(corners[0]) - 1.0)
        return FittedSpring(stiffness, strength, overstrength, second, ratios[2])
    return FittedSpring(stiffness, strength, 1.0, max(ratios[-1], 0.0), ratios[-1])
