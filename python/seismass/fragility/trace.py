"""One motion under one model: demand by intensity, where it crosses a limit, and what it is in between."""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from seismass.base.values import FloatArray
from seismass.fragility.limits import LimitState

CapacityRule: TypeAlias = Literal["first", "last"]
"""Which crossing of a limit is the capacity, where there are several: the lowest intensity or the highest."""


class Crossing(NamedTuple):
    """The capacity of a motion for a limit: interpolated intensity and its bracket (both infinite where the limit is
    not exceeded), and how often the demand rises above the limit along the curve.
    """

    lower: float
    upper: float
    value: float
    crossings: int


def crossing_of(at: FloatArray, demand: FloatArray, limit: LimitState, rule: CapacityRule) -> Crossing:
    """Return where a curve crosses a limit, by the first or the last crossing. Intensities increase, from no demand at
    zero; a demand is infinite where the run collapsed.
    """
    exceeds = np.append(False, demand > limit.value)
    rises = np.flatnonzero(exceeds[1:] & ~exceeds[:-1])
    if not len(rises):
        return Crossing(float(at[-1]) if len(at) else 0.0, np.inf, np.inf, 0)
    k = int(rises[0 if rule == "first" else -1])
    lower, below = (float(at[k - 1]), float(demand[k - 1])) if k else (0.0, 0.0)
    upper, above = float(at[k]), float(demand[k])
    if np.isfinite(above) and limit.quantity != "collapse":
        value = lower + (limit.value - below) / (above - below) * (upper - lower)
    else:
        value = 0.5 * (lower + upper)
    return Crossing(lower, upper, value, len(rises))


def demand_at(at: FloatArray, demand: FloatArray, levels: FloatArray, largest: float) -> FloatArray:
    """Return the demand of a curve at intensities, linear between points. Before a collapse it is infinite from the
    middle on; past the end infinite if the curve ends above `largest` (limit), NaN (unknown) if below.
    """
    points, values = np.append(0.0, at), np.append(0.0, demand)
    place = np.searchsorted(points, levels, side="left")
    inside = place < len(points)
    above = np.minimum(place, len(points) - 1)
    below = np.maximum(above - 1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = np.where(above > below, (levels - points[below]) / (points[above] - points[below]), 1.0)
        between = values[below] + weight * (values[above] - values[below])
    nearer = np.where(weight > 0.5, values[above], values[below])
    finite = np.isfinite(values[below]) & np.isfinite(values[above])
    found = np.where(weight == 1.0, values[above], np.where(finite, between, nearer))
    return np.where(inside, found, np.inf if values[-1] > largest else np.nan)


def intensity_at(at: FloatArray, demand: FloatArray, levels: FloatArray) -> FloatArray:
    """Return the intensity at which a curve first reaches each demand, linear between its points; infinite where it
    does not. Towards a collapse it is the middle of the two points.
    """
    points, values = np.append(0.0, at), np.append(0.0, demand)
    reached = np.maximum.accumulate(values)
    k = np.searchsorted(reached, levels, side="left")
    inside = k < len(points)
    above = np.minimum(k, len(points) - 1)
    below = np.maximum(above - 1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = (levels - values[below]) / (values[above] - values[below])
    weight = np.where(np.isfinite(values[above]), weight, 0.5)
    found = points[below] + np.where(above > below, weight, 0.0) * (points[above] - points[below])
    return np.where(inside, found, np.inf)
