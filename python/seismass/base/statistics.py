"""Statistics over motions: the capped mean of drifts, and quantiles that hold with infinite values."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.values import FloatArray

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


def few_collapses(collapsed: int, motions: int, statistic: str = "mean") -> bool:
    """Whether so few runs collapsed that a statistic of drifts gives an answer."""
    return collapsed <= MOST_COLLAPSES[statistic] * motions


def statistics_of(values: FloatArray) -> dict[str, float | None]:
    """Return mean, quantiles and largest value over the motions; what an infinite value decides is null."""
    statistics = {"mean": float(values.mean())}
    statistics |= {name: float(quantile(values[None, :], share)[0]) for name, share in QUANTILES.items()}
    statistics["max"] = float(values.max())
    return {name: value if np.isfinite(value) else None for name, value in statistics.items()}


def quantile(values: FloatArray, share: float) -> FloatArray:
    """Return the quantile of each row, shape (rows, motions), linear between order statistics; infinity is the largest,
    and a row with NaN gives NaN. `numpy.quantile` gives NaN where the next order statistic is infinite.
    """
    quantiles = _at(np.sort(values.T, axis=0), np.full(len(values), share * (values.shape[1] - 1)))
    return np.where(np.isnan(values).any(axis=1), np.nan, quantiles)


def interval_of(values: FloatArray, confidence: float) -> tuple[FloatArray, FloatArray]:
    """Return the ends of the percentile interval over the first axis. NaN are left out; an end between a finite and an
    infinite value is infinite.
    """
    ordered = np.sort(values, axis=0)  # NaN last
    last = np.maximum(np.count_nonzero(~np.isnan(values), axis=0) - 1, 0)
    tail = 0.5 * (1.0 - confidence)
    return _at(ordered, tail * last), _at(ordered, (1.0 - tail) * last)


def _at(ordered: FloatArray, place: FloatArray) -> FloatArray:
    """Value at a place, from 0, between the rows of each column of ordered values, shape (rows, columns)."""
    low, high = np.floor(place).astype(np.int64), np.ceil(place).astype(np.int64)
    below, above = (np.take_along_axis(ordered, index[None], axis=0)[0] for index in (low, high))
    with np.errstate(invalid="ignore"):
        interpolated = below + (place - low) * (above - below)
    return np.asarray(np.where(below == above, below, np.where(np.isinf(above), above, interpolated)))
