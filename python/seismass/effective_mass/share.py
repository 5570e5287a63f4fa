"""The share of the live load with which a statistic of the model is that of the real buildings, whatever statistic."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.statistics import interval_of
from seismass.base.values import FloatArray, as_number, frozen, refusal, short_repr
from seismass.effective_mass.models import bootstrap_counts, interpolated, is_below, kind_of

ShareStatistic: TypeAlias = Literal["mean", "ln mean", "quantile"]
ShareKind: TypeAlias = Literal["root", "multiple", "zero", "one", "rare", "flat"]
FLAT: Final = 0.03
"""A statistic that rises by less from no live load to the whole design live load does not determine a share."""
RARE: Final = 0.02
"""Probability below which runs are too few for a share: one of fifty."""


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
    level = as_number(probability, "probability", owner, InvalidOption)
    grid, of_model, of_real = (np.asarray(values, dtype=np.float64) for values in (shares, model, sliding))
    if of_model.shape[:2] != (len(grid), len(of_real)) or not (np.diff(grid) > 0.0).all():
        requirement = "of shape (shares, motions, ...), with increasing shares and the motions of the real buildings"
        raise refusal(InvalidOption, "model", owner, requirement, f"{of_model.shape} beside {of_real.shape}")
    clusters = np.arange(len(of_real)) if cluster_of is None else np.asarray(cluster_of)
    counts = np.ones((1, len(of_real)))
    if clusters.max() > 0:
        counts = np.concatenate([counts, bootstrap_counts(clusters, resamples, seed)])
    curves = np.stack([_statistic(row, counts, statistic, level) for row in of_model], axis=1)
    targets = _statistic(of_real, counts, statistic, level)
    against = np.broadcast_to(targets[:, None], curves.shape)
    values = interpolated(grid, curves, against)
    values = np.where(values == 1.0, np.where(is_below(curves, against)[:, -1], grid[-1], values), values)
    kind = _kind(grid, curves[0], float(targets[0]), least)
    interval = None
    if len(values) > 1 and kind != "rare":
        low, high = interval_of(values[1:, None], confidence)
        interval = float(low[0]), float(high[0])
    value = float("nan") if kind == "rare" else float(values[0])
    answer = value, interval, kind, float(targets[0]), frozen(grid), frozen(curves[0])
    return EqualShare(*answer, confidence, frozen(targets[1:]), frozen(curves[1:]))


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


def _statistic(values: FloatArray, counts: FloatArray, statistic: str, probability: float) -> FloatArray:
    """Statistic of values, shape (motions, ...), with each row of whole weights of the motions (draws, motions)."""
    total = counts.sum(axis=1)
    by_motion = values.reshape(len(values), -1)
    if statistic == "quantile":
        order = np.argsort(by_motion, axis=None, kind="stable")
        ordered = by_motion.reshape(-1)[order]
        of_motion = order // by_motion.shape[1]
        reached = np.cumsum(counts[:, of_motion], axis=1)
        return np.asarray(ordered[(reached >= probability * reached[:, -1:]).argmax(axis=1)])
    taken = np.log(by_motion) if statistic == "ln mean" else by_motion
    mean = counts @ taken.mean(axis=1) / total
    return np.exp(mean) if statistic == "ln mean" else np.asarray(mean)
