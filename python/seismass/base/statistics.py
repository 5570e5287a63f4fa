"""Statistics over motions: the capped mean of drifts, quantiles that hold with infinite values, and bootstraps.

Quantiles of runs are taken here, as numpy's give NaN beside infinite values. Elsewhere `numpy.median` and
`numpy.percentile` are taken of what is always finite: ratios of a fit, spectra over angles.
"""

from __future__ import annotations

from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from seismass.base.arguments import as_word
from seismass.base.values import FloatArray

Statistic: TypeAlias = Literal["mean", "median"]
"""What is taken of the largest drifts over the records."""
ShareStatistic: TypeAlias = Literal["mean", "ln mean", "quantile"]
"""What may be taken of runs of which a share is sought."""

QUANTILES: Final = {"p16": 0.16, "median": 0.50, "p84": 0.84}
"""Shares of the quantiles that tables have; 16 and 84 % are one standard deviation of a normal distribution away."""

DRIFT_CAP: Final = 0.10
"""Default drift cap, over the storey height. An assumption: few storeys stand a tenth of their height."""
CAPPED_MEAN: Final = "mean over the motions of min(peak drift, drift cap)"
"""What the drift of a storey is called, in every text."""
MOST_COLLAPSES: Final = {"mean": 0.1, "median": 0.5}
"""Largest share of the motions with a collapse where a statistic of drifts gives an answer: one of eleven, and four of
forty; the median has none where collapsed runs reach it."""


def capped(drift: FloatArray, cap: float) -> FloatArray:
    """Return min(drift, cap), whose mean over the motions is the capped mean. A run that collapses counts its peaks up
    to the collapse: the storey that collapses has its collapse drift there, at most the cap, and nothing jumps.
    """
    return np.minimum(drift, cap)


def or_infinite(values: FloatArray, collapsed: NDArray[np.bool_]) -> FloatArray:
    """Return values with infinity in runs that collapsed: goods of a fallen building are lost. Drifts are capped
    instead.
    """
    return np.where(collapsed, np.inf, values)


def few_collapses(collapsed: int, motions: int, statistic: str = "mean") -> bool:
    """Whether so few runs collapsed that a statistic of drifts gives an answer."""
    return collapsed <= MOST_COLLAPSES[statistic] * motions


def check_statistic(statistic: Any, owner: str) -> Statistic:
    """Return the name of a statistic."""
    checked: Statistic = as_word(statistic, get_args(Statistic), "statistic", owner)
    return checked


def over_records(values: FloatArray, statistic: Statistic) -> FloatArray:
    """Return the mean or the median over the last axis, of capped drifts."""
    taken: FloatArray = np.asarray(values.mean(axis=-1) if statistic == "mean" else np.median(values, axis=-1))
    return taken


def statistics_of(values: FloatArray) -> dict[str, float | None]:
    """Return mean, quantiles and largest value over the motions; what an infinite value decides is null."""
    statistics = {"mean": float(values.mean())}
    statistics |= {name: float(quantile(values, share)) for name, share in QUANTILES.items()}
    statistics["max"] = float(values.max())
    return {name: value if np.isfinite(value) else None for name, value in statistics.items()}


def quantile(values: FloatArray, share: float) -> FloatArray:
    """Return the quantile over the last axis, linear between order statistics; infinity is the largest, and a row with
    NaN gives NaN. `numpy.quantile` gives NaN where the next order statistic is infinite.
    """
    rows = values.reshape(-1, values.shape[-1])
    quantiles = _at(np.sort(rows.T, axis=0), np.full(len(rows), share * (rows.shape[1] - 1)))
    return np.where(np.isnan(values).any(axis=-1), np.nan, quantiles.reshape(values.shape[:-1]))


def interval_of(values: FloatArray, confidence: float) -> tuple[FloatArray, FloatArray]:
    """Return the ends of the percentile interval over the first axis. NaN are left out; an end between a finite and an
    infinite value is infinite.
    """
    ordered = np.sort(values, axis=0)  # NaN last
    last = np.maximum(np.count_nonzero(~np.isnan(values), axis=0) - 1, 0)
    tail = 0.5 * (1.0 - confidence)
    return _at(ordered, tail * last), _at(ordered, (1.0 - tail) * last)


def bootstrap_counts(cluster_of: NDArray[np.int64], resamples: int, seed: int | list[int]) -> FloatArray:
    """Return how often each resample has each record, shape (resamples, records); those of one cluster go together."""
    count = int(cluster_of.max()) + 1
    draws = np.random.default_rng(seed).multinomial(count, np.full(count, 1.0 / count), size=resamples)
    counts: FloatArray = draws[:, cluster_of].astype(np.float64)
    return counts


def quantile_interval(values: FloatArray, share: float, counts: FloatArray, confidence: float) -> list[float]:
    """Return the percentile interval of a quantile of finite values in resamples that have each value so often."""
    order = np.argsort(values, kind="stable")
    reached = np.cumsum(counts[:, order], axis=1)
    place = share * (reached[:, -1] - 1.0)
    low, high = (values[order][(reached > end[:, None]).argmax(axis=1)] for end in (np.floor(place), np.ceil(place)))
    return [float(end) for end in interval_of(low + (place - np.floor(place)) * (high - low), confidence)]


def weighted(
    values: FloatArray, weights: FloatArray, statistic: Statistic | ShareStatistic, probability: float = 0.5
) -> FloatArray:
    """Return a statistic of rows of `values` (rows, records) or (rows, records, samples) under each row of whole
    `weights` (draws, records). A quantile is the smallest value that the probability is reached with.
    """
    samples = values.reshape(*values.shape[:2], -1)
    if statistic in ("mean", "ln mean"):
        taken = np.log(samples) if statistic == "ln mean" else samples
        mean = (weights @ taken.mean(axis=2).T) / weights.sum(axis=1)[:, None]
        return np.asarray(np.exp(mean) if statistic == "ln mean" else mean)
    statistics = np.empty((len(weights), len(values)))
    for row, column in enumerate(samples.reshape(len(values), -1)):
        order = np.argsort(column, kind="stable")
        reached = np.cumsum(weights[:, order // samples.shape[2]], axis=1)
        total = reached[:, -1:]
        if statistic == "quantile":
            statistics[:, row] = column[order[(reached >= probability * total).argmax(axis=1)]]
        else:
            low, high = ((reached > (total - shift) // 2).argmax(axis=1) for shift in (1, 0))
            statistics[:, row] = 0.5 * (column[order[low]] + column[order[high]])
    return statistics


def _at(ordered: FloatArray, place: FloatArray) -> FloatArray:
    """Value at a place, from 0, between the rows of each column of ordered values, shape (rows, columns)."""
    low, high = np.floor(place).astype(np.int64), np.ceil(place).astype(np.int64)
    below, above = (np.take_along_axis(ordered, index[None], axis=0)[0] for index in (low, high))
    with np.errstate(invalid="ignore"):
        interpolated = below + (place - low) * (above - below)
    return np.asarray(np.where(below == above, below, np.where(np.isinf(above), above, interpolated)))
