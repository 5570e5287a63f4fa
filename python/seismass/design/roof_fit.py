"""Storey springs fitted to one curve of base shear over roof displacement, from relative stiffnesses and strengths."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.values import FloatArray
from seismass.design.spring_fit import FittedSpring, SpringShape, fitted_spring, sample_weights

_FLAT: Final = 1e-12
"""Slope over the first one that a plateau has, so that base shears have a displacement."""
_FAR: Final = 100.0
"""Force beyond the last corner, over that at it, up to which a curve is known."""
_MOST_OVERSTRENGTH: Final = 50.0
_STARTS: Final = (1.0, 0.8, 1.25)
"""Factors of the strength from which the search begins."""


def roof_shear(springs: list[FittedSpring], share: FloatArray, roof: FloatArray) -> FloatArray:
    """Return the base shear (N) at roof displacements (m) of storeys in series whose slopes do not fall; `share` is
    that of the base shear in each storey.
    """
    knots = []
    for spring, part in zip(springs, share, strict=True):
        slopes = [max(spring.second_slope, _FLAT)] if len(spring.corners) == 2 else []
        slopes.append(max(spring.third_slope, _FLAT))
        drifts, forces = [0.0, *spring.corners], [0.0, spring.yield_shear]
        if len(spring.corners) == 2:
            forces.append(spring.overstrength * spring.yield_shear)
        drifts.append(drifts[-1] + _FAR * forces[-1] / (slopes[-1] * spring.stiffness))
        knots.append((np.array([*forces, (1.0 + _FAR) * forces[-1]]) / part, np.array(drifts)))
    top = min(float(levels[-1]) for levels, _ in knots)
    shears = np.unique(np.concatenate([levels[levels <= top] for levels, _ in knots]))
    displacements = np.sum([np.interp(shears, levels, drifts) for levels, drifts in knots], axis=0)
    found: FloatArray = np.interp(roof, displacements, shears)
    return found


def fitted_storeys(
    roof: FloatArray,
    shear: FloatArray,
    share: FloatArray,
    stiffness: FloatArray,
    strength: FloatArray,
    shape: SpringShape,
) -> list[FittedSpring] | None:
    """Return the least-squares springs for a curve of roof displacement (m) and base shear (N); None where it does not
    bend. Slopes and overstrength are alike in all storeys; stiffness and strength are relative.
    """
    from scipy.optimize import least_squares

    whole = fitted_spring(roof, shear, shape)
    if whole is None:
        return None
    root, scale = np.sqrt(sample_weights(roof)), float(shear.max())
    stiffness_unit = whole.stiffness * float(np.sum(share / stiffness))
    strength_unit = whole.yield_shear * float(np.median(share / strength))
    lines = 1 if len(whole.corners) == 1 else 2

    def springs(x: FloatArray) -> list[FittedSpring]:
        k, v_y = stiffness_unit * x[0] * stiffness, strength_unit * x[1] * strength
        if lines == 1:
            return [
                FittedSpring(float(a), float(b), 1.0, float(x[2]), float(x[2])) for a, b in zip(k, v_y, strict=True)
            ]
        second = max(float(x[2]), _FLAT)
        third = float(x[4]) * second
        return [FittedSpring(float(a), float(b), 1.0 + float(x[3]), second, third) for a, b in zip(k, v_y, strict=True)]

    def residual(x: FloatArray) -> FloatArray:
        misfit: FloatArray = root * (roof_shear(springs(x), share, roof) - shear) / scale
        return misfit

    slopes = [whole.third_slope]
    low, high = [1e-3, 1e-3, 0.0], [1e3, 1e3, 1.0]
    if lines == 2:
        slopes = [whole.second_slope, whole.overstrength - 1.0, whole.third_slope / whole.second_slope]
        low, high = [*low, 1e-9, 0.0], [*high, _MOST_OVERSTRENGTH, 1.0]
    best = np.array([1.0, 1.0, *slopes])
    for factor in _STARTS:
        start = np.clip(np.array([1.0, factor, *slopes]), np.array(low), np.array(high))
        near = least_squares(residual, start, bounds=(low, high), xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=400)
        if np.linalg.norm(residual(near.x)) < np.linalg.norm(residual(best)):
            best = near.x
    return springs(best)
