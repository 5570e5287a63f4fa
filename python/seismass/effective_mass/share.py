"""The share of the live load with which a statistic of the model is that of the real buildings, whatever statistic."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.arguments import as_bootstrap, as_share, as_word
from seismass.base.errors import InvalidOption, SimulationError
from seismass.base.statistics import ShareStatistic, bootstrap_counts, interval_of, weighted
from seismass.base.values import FloatArray, as_array, as_number, brief, frozen, refusal, short_repr

ShareKind: TypeAlias = Literal["root", "multiple", "zero", "one", "rare", "flat"]
Kind: TypeAlias = Literal["stuck", "root", "multiple", "zero", "one", "beyond", "collapsed"]
"""How an effective fraction came about; see `EffectiveMass`."""

ROUNDING: Final = 1e-12
"""Drifts that differ by less, relative to themselves, are the same."""
TOLERANCE: Final = 1e-12
"""To which roots are located."""
FLAT: Final = 0.03
"""A statistic that rises by less from no live load to the whole design live load does not determine a share."""
RARE: Final = 0.02
"""Probability below which runs are too few for a share: one of fifty."""


def is_below(model: FloatArray, sliding: FloatArray) -> NDArray[np.bool_]:
    """Whether the model drifts less than the real building, by more than rounding."""
    below: NDArray[np.bool_] = np.asarray(model < sliding * (1.0 - ROUNDING))
    return below


def kind_of(below: NDArray[np.bool_]) -> Kind:
    """Return how often the curve crosses the real drift, and on which side of it the curve ends."""
    if below[-1]:
        return "one"
    if not below.any():
        return "zero"
    return "root" if np.count_nonzero(below[1:] != below[:-1]) == 1 else "multiple"


def crossings(fractions: FloatArray, model: FloatArray, sliding: FloatArray) -> list[tuple[float, float]]:
    """Return the brackets of all sign changes of model - real on the grid, in increasing order."""
    below = is_below(model, np.broadcast_to(sliding, model.shape))
    return [(float(fractions[k]), float(fractions[k + 1])) for k in np.flatnonzero(below[1:] != below[:-1])]


def interpolated_roots(fractions: FloatArray, model: FloatArray, sliding: FloatArray) -> list[float]:
    """Return all crossings of one curve by linear interpolation."""
    roots = []
    for low, high in crossings(fractions, model, sliding):
        k = int(np.searchsorted(fractions, low))
        ends = model[k : k + 2] - sliding[k : k + 2]
        roots.append(low - float(ends[0] / (ends[1] - ends[0])) * (high - low))
    return roots


def refined_root(difference: Callable[[float], float], bracket: tuple[float, float]) -> float:
    """Return the root of a difference of drifts, relative to the real one, within a bracket."""
    for share in bracket:
        if abs(difference(share)) <= ROUNDING:
            return share

    def checked(share: float) -> float:
        value = difference(share)
        if math.isnan(value):
            raise refusal(SimulationError, "drift", f"building at share {share:g}", "finite", "a collapse")
        return value

    return _brent_root(checked, *bracket)


def _brent_root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the root in a bracket by Brent's method, with the bits of `scipy.optimize.brentq`: the import of SciPy
    takes a tenth of the time of an assessment.
    """
    before, now, f_before, f_now = low, high, function(low), function(high)
    other, f_other, step_before, step = before, f_before, 0.0, 0.0
    while True:
        if f_before != 0.0 != f_now and (f_before < 0.0) != (f_now < 0.0):
            other, f_other = before, f_before
            step_before = step = now - before
        if abs(f_other) < abs(f_now):
            before, now, other = now, other, now
            f_before, f_now, f_other = f_now, f_other, f_now
        least, half = (TOLERANCE + 1e-14 * abs(now)) / 2.0, (other - now) / 2.0
        if f_now == 0.0 or abs(half) < least:
            return now
        trial = math.inf
        if abs(step_before) > least and abs(f_now) < abs(f_before):
            if before == other:
                trial = -f_now * (now - before) / (f_now - f_before)
            else:
                slope_before = (f_before - f_now) / (before - now)
                slope_other = (f_other - f_now) / (other - now)
                rise = f_other * slope_other - f_before * slope_before
                trial = -f_now * rise / (slope_other * slope_before * (f_other - f_before))
        # A step of the interpolation is taken where it is shorter than half the one before, and inside the bracket.
        if 2.0 * abs(trial) < min(abs(step_before), 3.0 * abs(half) - least):
            step_before, step = step, trial
        else:
            step_before = step = half
        before, f_before = now, f_now
        now += step if abs(step) > least else least if half > 0.0 else -least
        f_now = function(now)


def interpolated(fractions: FloatArray, model: FloatArray, sliding: FloatArray) -> FloatArray:
    """Return the smallest share from which on the model never drifts less than the real building, by linear
    interpolation, for `model` and `real` of shape (curves, shares); 1 where it does at 1.
    """
    below = is_below(model, sliding)
    last = below.shape[1] - 1 - np.argmax(below[:, ::-1], axis=1)
    value = np.where(below.any(axis=1), 1.0, 0.0)
    inside = np.flatnonzero(below.any(axis=1) & (last < below.shape[1] - 1))
    k = last[inside]
    low = model[inside, k] - sliding[inside, k]
    high = model[inside, k + 1] - sliding[inside, k + 1]
    value[inside] = fractions[k] - low / (high - low) * (fractions[k + 1] - fractions[k])
    return value


def first_bracket(shares: FloatArray, model: FloatArray, sliding: float) -> tuple[float, float] | None:
    """Return the shares, from 1 on, between which the model first reaches the real drift; None where it does not."""
    below = is_below(model, np.full(model.shape, sliding))
    reached = np.flatnonzero(~below)
    if not len(reached):
        return None
    index = int(reached[0])
    return float(shares[max(index - 1, 0)]), float(shares[index])


def extended(values: FloatArray, shares: FloatArray, model: FloatArray, sliding: FloatArray) -> FloatArray:
    """Return the smallest share above 1 at which the model has the real drift, by linear interpolation, for curves
    whose model drifts less at 1; the largest share where there is none. `model` has shape (curves, beyond).
    """
    below = is_below(model, np.broadcast_to(sliding[:, None], model.shape))
    crossing = values.copy()
    short = np.flatnonzero(below[:, 0])
    never = below[short].all(axis=1)
    crossing[short[never]] = shares[-1]
    for curve in short[~never]:
        k = int(np.argmin(below[curve])) - 1
        low, high = model[curve, k] - sliding[curve], model[curve, k + 1] - sliding[curve]
        crossing[curve] = shares[k] - low / (high - low) * (shares[k + 1] - shares[k])
    return crossing


@dataclass(frozen=True, eq=False)
class EqualShare:
    """A share of the live load with which a model has a statistic of the real buildings.

    Attributes
    ----------
    value : float
        The smallest share from which on the model's statistic is not below the real one, linear between shares; NaN
        where it is rare.
    interval : tuple of float or None
        Percentile interval of a bootstrap over clusters of motions; None with one cluster or where it is rare.
    kind : {"root", "multiple", "zero", "one", "rare", "flat"}
        One crossing; several, the largest counts; the model is above, or below, at all shares; the real statistic is
        below what the runs can tell; it rises by less than 3 % from no load to the whole design live load.
    sliding, shares, model
        Statistic of the real buildings; shares, and the statistic of the models, shape (shares,).
    """

    value: float
    interval: tuple[float, float] | None
    kind: ShareKind
    sliding: float
    shares: FloatArray
    model: FloatArray
    confidence: float = field(repr=False)
    sliding_draws: FloatArray = field(repr=False)
    model_draws: FloatArray = field(repr=False)

    __repr__ = short_repr

    def over_model(self, share: float) -> tuple[float, float, float]:
        """Return real over model at a share, with its interval (NaN without one); infinite where the model has zero."""
        models = np.array([np.interp(share, self.shares, row) for row in (self.model, *self.model_draws)])
        with np.errstate(divide="ignore", invalid="ignore"):
            ratios = np.append(self.sliding, self.sliding_draws) / models
        ends = interval_of(ratios[1:, None], self.confidence) if len(ratios) > 1 else np.full((2, 1), np.nan)
        return float(ratios[0]), float(ends[0][0]), float(ends[1][0])


def equal_share(
    shares: ArrayLike,
    model: ArrayLike,
    sliding: ArrayLike,
    *,
    statistic: ShareStatistic = "mean",
    probability: float = 0.84,
    cluster_of: NDArray[np.int64] | None = None,
    least: float = -np.inf,
    confidence: float = 0.90,
    resamples: int = 500,
    seed: int = 0,
) -> EqualShare:
    """Return the share with which models have a statistic of real buildings.

    Parameters
    ----------
    shares : array_like, shape (shares,)
        Shares of the models in increasing order.
    model, sliding : array_like, shapes (shares, motions, ...) and (motions, ...)
        What is looked at, of every run: capped drifts, forces, 0 or 1 for a limit that is exceeded (a probability), or
        these times their part of an annual rate (`risk.stripe_weights`). Samples of both may differ.
    statistic, probability
        "mean", "ln mean" or "quantile" over motions and samples; the probability of the quantile.
    cluster_of : ndarray of int, shape (motions,), optional
        Number of the station or earthquake of each motion, from 0, by which motions are resampled; default each alone.
    least : float, optional
        A statistic of the real buildings below it is "rare".
    confidence, resamples, seed
        Of the bootstrap, real buildings and models drawn together.

    Raises
    ------
    InvalidOption
        An argument is not what it must be.

    Examples
    --------
    >>> import seismass as sm
    >>> found = sm.evidence.equal_share([0.0, 0.5, 1.0], [[1.0, 3.0], [2.0, 4.0], [4.0, 6.0]], [2.4, 4.0])
    >>> round(found.value, 3), found.kind
    (0.55, 'root')
    """
    owner = "equal share"
    as_word(statistic, get_args(ShareStatistic), "statistic", owner)
    level = as_share(probability, "probability", owner)
    within, count, first = as_bootstrap(confidence, resamples, seed, owner, least=0)
    grid = as_array(shares, "shares", owner, InvalidOption)
    of_model, of_real = _numbers(model, "model", owner, 2), _numbers(sliding, "sliding", owner, 1)
    if of_model.shape[:2] != (len(grid), len(of_real)) or not (np.diff(grid) > 0.0).all():
        requirement = "of shape (shares, motions, ...), with increasing shares and the motions of the real buildings"
        raise refusal(InvalidOption, "model", owner, requirement, f"{of_model.shape} beside {of_real.shape}")
    clusters = np.arange(len(of_real)) if cluster_of is None else np.asarray(cluster_of)
    if clusters.shape != (len(of_real),) or clusters.dtype.kind not in "iu" or clusters.min() < 0:
        raise refusal(InvalidOption, "cluster_of", owner, "a whole number from 0 for each motion", brief(cluster_of))
    counts = np.ones((1, len(of_real)))
    if clusters.max() > 0:
        counts = np.concatenate([counts, bootstrap_counts(clusters, count, first)])
    curves = weighted(of_model, counts, statistic, level)
    targets = weighted(of_real[None], counts, statistic, level)[:, 0]
    against = np.broadcast_to(targets[:, None], curves.shape)
    values = interpolated(grid, curves, against)
    values = np.where(values == 1.0, np.where(is_below(curves, against)[:, -1], grid[-1], values), values)
    kind = _kind(grid, curves[0], float(targets[0]), as_number(least, "least", owner, InvalidOption))
    interval = None
    if len(values) > 1 and kind != "rare":
        low, high = interval_of(values[1:, None], within)
        interval = float(low[0]), float(high[0])
    value = float("nan") if kind == "rare" else float(values[0])
    answer = value, interval, kind, float(targets[0]), frozen(grid), frozen(curves[0])
    return EqualShare(*answer, within, frozen(targets[1:]), frozen(curves[1:]))


def _numbers(values: ArrayLike, name: str, owner: str, least: int) -> FloatArray:
    """Return an array of numbers with at least so many axes, none of them empty."""
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.ndim < least or not array.size:
        raise refusal(InvalidOption, name, owner, f"an array of numbers with at least {least} axes", brief(values))
    return array


def _kind(shares: FloatArray, curve: FloatArray, target: float, least: float) -> ShareKind:
    if target < least:
        return "rare"
    below = is_below(curve, np.full(curve.shape, target))
    whole = float(np.interp(1.0, shares, curve))
    if whole - curve[0] < FLAT * abs(curve[0]):
        return "flat"
    kind: Any = kind_of(below)  # one of four of them
    checked: ShareKind = kind
    return checked
