"""Where a model's drift meets the real one, as its share of the live load grows: roots, their kind, their scatter.

Everything here works on arrays of drifts; `runs` makes them. A drift counts as below the real one where it is so by
more than rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_array, brief, is_one_of, refusal

Statistic: TypeAlias = Literal["mean", "median"]
"""What is taken of the largest drifts over the records."""
Kind: TypeAlias = Literal["stuck", "root", "multiple", "zero", "one", "beyond", "collapsed"]
"""How an effective fraction came about; see `EffectiveMass`."""

ROUNDING: Final = 1e-12
"""Drifts that differ by less, relative to themselves, are the same."""
TOLERANCE: Final = 1e-12
"""To which roots are located."""
DEFAULT_FRACTIONS: Final = np.linspace(0.0, 1.0, 101)
"""Shares at which models are solved before roots are refined."""
FRACTIONS_OF_VECTORS: Final = np.linspace(0.0, 1.0, 21)
"""The same where drifts are lengths of vectors, for which a model takes a run in two directions."""


def check_statistic(statistic: Any, owner: str) -> Statistic:
    """Return the name of a statistic."""
    if not is_one_of(statistic, get_args(Statistic)):
        raise refusal(InvalidOption, "statistic", owner, "mean or median", brief(statistic))
    checked: Statistic = statistic
    return checked


def check_fractions(fractions: Any, owner: str, default: FloatArray = DEFAULT_FRACTIONS) -> FloatArray:
    """Return shares in increasing order from 0 to 1, those of a default where none are given."""
    if fractions is None:
        return default
    shares = as_array(fractions, "fractions", owner, InvalidOption)
    requirement = "a list in increasing order that begins with 0 and ends with 1"
    if len(shares) < 2 or shares[0] != 0.0 or shares[-1] != 1.0 or not (np.diff(shares) > 0.0).all():
        raise refusal(InvalidOption, "fractions", owner, requirement, brief(shares.tolist()))
    return shares


def over_records(values: FloatArray, statistic: Statistic) -> FloatArray:
    """Return the mean or the median over the last axis; infinite where collapsed runs decide it."""
    taken: FloatArray = np.asarray(values.mean(axis=-1) if statistic == "mean" else np.median(values, axis=-1))
    return taken


def is_below(model: FloatArray, real: FloatArray) -> NDArray[np.bool_]:
    """Whether the model drifts less than the real building, by more than rounding."""
    below: NDArray[np.bool_] = np.asarray(model < real * (1.0 - ROUNDING))
    return below


def kind_of(below: NDArray[np.bool_]) -> Kind:
    """Return how often the curve crosses the real drift, and on which side of it the curve ends."""
    if below[-1]:
        return "one"
    if not below.any():
        return "zero"
    return "root" if np.count_nonzero(below[1:] != below[:-1]) == 1 else "multiple"


def crossings(fractions: FloatArray, model: FloatArray, real: FloatArray) -> list[tuple[float, float]]:
    """Return the brackets of all sign changes of model - real on the grid, in increasing order."""
    below = is_below(model, np.broadcast_to(real, model.shape))
    return [(float(fractions[k]), float(fractions[k + 1])) for k in np.flatnonzero(below[1:] != below[:-1])]


def interpolated_roots(fractions: FloatArray, model: FloatArray, real: FloatArray) -> list[float]:
    """Return all crossings of one curve by linear interpolation; the middle of a bracket where a run collapses."""
    roots = []
    for low, high in crossings(fractions, model, real):
        k = int(np.searchsorted(fractions, low))
        with np.errstate(invalid="ignore"):  # where both collapse the difference is NaN
            ends = model[k : k + 2] - real[k : k + 2]
        weight = -ends[0] / (ends[1] - ends[0]) if np.isfinite(ends).all() else 0.5
        roots.append(low + float(weight) * (high - low))
    return roots


def refined_root(difference: Callable[[float], float], bracket: tuple[float, float]) -> float:
    """Return the root of a difference of drifts, relative to the real one, within a bracket. A model that collapses
    differs by infinity, which cannot be interpolated: then the bracket is halved.
    """
    from scipy.optimize import bisect, brentq  # slow to import

    low, high = bracket
    ends = difference(low), difference(high)
    for share, value in zip(bracket, ends, strict=True):
        if abs(value) <= ROUNDING:
            return share
    if not np.isfinite(ends).all():
        return float(bisect(lambda share: np.clip(difference(share), -1.0, 1.0), low, high, xtol=TOLERANCE))
    return float(brentq(lambda share: np.clip(difference(share), -1.0, 10.0), low, high, xtol=TOLERANCE, rtol=1e-14))


def interpolated(fractions: FloatArray, model: FloatArray, real: FloatArray) -> FloatArray:
    """Return the smallest share from which on the model never drifts less than the real building, by linear
    interpolation, for `model` and `real` of shape (curves, shares); 1 where it does at 1.
    """
    below = is_below(model, real)
    last = below.shape[1] - 1 - np.argmax(below[:, ::-1], axis=1)
    value = np.where(below.any(axis=1), 1.0, 0.0)
    inside = np.flatnonzero(below.any(axis=1) & (last < below.shape[1] - 1))
    k = last[inside]
    with np.errstate(invalid="ignore"):
        low = model[inside, k] - real[inside, k]
        high = model[inside, k + 1] - real[inside, k + 1]
        weight = np.where(np.isfinite(high) & np.isfinite(low), -low / (high - low), 0.0)
    value[inside] = fractions[k] + weight * (fractions[k + 1] - fractions[k])
    return value


def resampled(
    model: FloatArray,
    real: FloatArray,
    *,
    statistic: Statistic,
    cluster_of: NDArray[np.int64],
    resamples: int,
    seed: int,
) -> tuple[FloatArray, FloatArray]:
    """Return the statistic of model and real drifts, each of shape (resamples, shares), in bootstrap resamples of the
    records, both drawn together and the records of one cluster together.
    """
    weights = bootstrap_counts(cluster_of, resamples, seed)
    model_drift, real_drift = (_weighted(values, weights, statistic) for values in (model, real))
    return model_drift, np.broadcast_to(real_drift, model_drift.shape)


def bootstrap_counts(cluster_of: NDArray[np.int64], resamples: int, seed: int) -> FloatArray:
    """Return how often each resample has each record, shape (resamples, records); see `resampled`."""
    count = int(cluster_of.max()) + 1
    draws = np.random.default_rng(seed).multinomial(count, np.full(count, 1.0 / count), size=resamples)
    counts: FloatArray = draws[:, cluster_of].astype(np.float64)
    return counts


def _weighted(values: FloatArray, weights: FloatArray, statistic: Statistic) -> FloatArray:
    """Return mean or median of rows of `values` (rows, records) under each row of whole `weights` (draws, records)."""
    total = weights.sum(axis=1)
    if statistic == "mean":
        finite = np.where(np.isfinite(values), values, 0.0)
        mean = (weights @ finite.T) / total[:, None]
        infinite = (weights @ np.isinf(values).astype(np.float64).T) > 0.0
        return np.where(infinite, np.inf, mean)
    medians = np.empty((len(weights), len(values)))
    for row, own in enumerate(values):
        order = np.argsort(own, kind="stable")
        reached = np.cumsum(weights[:, order], axis=1)
        low, high = ((reached > (total[:, None] - shift) // 2).argmax(axis=1) for shift in (1, 0))
        medians[:, row] = 0.5 * (own[order[low]] + own[order[high]])
    return medians
