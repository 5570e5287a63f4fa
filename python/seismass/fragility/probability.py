"""Curves of probability over intensity: a lognormal part, and beside it collapse with a logistic curve.

A curve is a row of four numbers: median and dispersion of the lognormal part, and centre (as an intensity) and width
(of its logarithm) of the logistic part, whose centre is infinite where there is no collapse.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.values import FloatArray

NO_COLLAPSE: Final = (np.inf, 0.0)
"""Logistic part of a curve without collapse."""
_BISECTIONS: Final = 60
"""Halvings of a bracket of a logarithm, to below its rounding."""


def probabilities(curves: FloatArray, at: FloatArray) -> FloatArray:
    """Return P = P_l + P_c (1 - P_l) of each curve (rows of median, dispersion, centre and width) at each intensity, of
    the lognormal part P_l and the logistic P_c; 0 at intensity 0. A NaN median has NaN.
    """
    columns = [column.reshape(-1, *(1,) * at.ndim) for column in curves.T]
    return _probability(columns[0], columns[1], columns[2], columns[3], at)


def _probability(
    median: FloatArray, dispersion: FloatArray, centre: FloatArray, width: FloatArray, at: FloatArray
) -> FloatArray:
    """Probability of curves at intensities that fit them in shape."""
    from scipy.special import expit, ndtr  # slow to import

    with np.errstate(divide="ignore", invalid="ignore"):
        log = np.log(at)
        over, beyond = log - np.log(median), log - np.log(centre)
        lognormal = np.where(dispersion > 0.0, ndtr(over / dispersion), (over >= 0.0).astype(np.float64))
        logistic = np.where(width > 0.0, expit(beyond / width), (beyond >= 0.0).astype(np.float64))
    lognormal = np.where(np.isnan(median), np.nan, lognormal)
    logistic = np.where(np.isnan(centre), np.nan, logistic)
    both = lognormal + logistic * (1.0 - lognormal)
    return np.where(at == 0.0, 0.0 * both, both)


def quantiles(curves: FloatArray, share: float) -> FloatArray:
    """Return the intensity at which each curve, see `probabilities`, reaches a probability between 0 and 1; infinite, 0
    or NaN where its median is.
    """
    high = _parts_reach(curves, share)
    # Together the parts are at most the sum of both.
    low = _parts_reach(curves, 0.5 * share)
    both = np.flatnonzero(np.isfinite(curves[:, 2]) & np.isfinite(high) & (low > 0.0))
    if len(both):
        columns = [curves[both, place] for place in range(4)]
        ends = np.log(low[both]), np.log(high[both])
        for _ in range(_BISECTIONS):
            middle = 0.5 * (ends[0] + ends[1])
            reached = _probability(columns[0], columns[1], columns[2], columns[3], np.exp(middle)) >= share
            ends = np.where(reached, ends[0], middle), np.where(reached, middle, ends[1])
        high[both] = np.exp(ends[1])
    return high


def _parts_reach(curves: FloatArray, share: float) -> FloatArray:
    """Intensity at which the first of the two parts of each curve reaches a probability."""
    from scipy.special import logit, ndtri  # slow to import

    median, dispersion, centre, width = curves.T
    inside = np.isfinite(median) & (median > 0.0)
    lognormal = np.where(inside, median * np.exp(np.where(inside, dispersion, 0.0) * ndtri(share)), median)
    with np.errstate(over="ignore"):
        logistic = centre * np.exp(width * logit(share))
    return np.asarray(np.minimum(lognormal, logistic))


def medians_and_dispersions(curves: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the intensity at one half of each curve, and half of ln of the ratio of the intensities at 84 and 16 %;
    those of the lognormal part where there is no collapse.
    """
    from scipy.special import ndtr  # slow to import

    low, middle, high = (quantiles(curves, float(ndtr(level))) for level in (-1.0, 0.0, 1.0))
    alone = ~np.isfinite(curves[:, 2])
    with np.errstate(divide="ignore", invalid="ignore"):
        dispersion = 0.5 * (np.log(high) - np.log(low))
    return middle, np.where(alone, curves[:, 1], dispersion)
