"""Fits of a fragility to counts, capacities or a cloud; an analysis draws the same motions for every model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.arguments import Bootstrap, as_bootstrap
from seismass.base.errors import InvalidOption
from seismass.base.statistics import bootstrap_counts
from seismass.base.values import FloatArray, as_array, as_positive, brief, counted, refusal
from seismass.studies.fragility.fragility import Fragility, FragilityMethod, as_curves, fragility_of
from seismass.studies.fragility.likelihood import Fits, capacity_fits, cloud_fits, probit_fits

CONFIDENCE: Final = 0.90
"""Default probability of intervals."""
RESAMPLES: Final = 1000
"""Default bootstrap resamples."""


@dataclass(frozen=True, slots=True)
class Draws:
    """How often each bootstrap resample has each motion, shape (resamples, motions); no rows where all motions are of
    one earthquake, as motions of one earthquake are drawn together.
    """

    weights: FloatArray
    confidence: float


def draws_of(cluster_of: NDArray[np.int64], options: Bootstrap, number: int = 0) -> Draws:
    """Return the draws of motions whose clusters are given; `number` distinguishes the draws of several levels."""
    _, which = np.unique(cluster_of, return_inverse=True)
    resamples = options.resamples if which.any() else 0
    return Draws(bootstrap_counts(which, resamples, [options.seed, number]), options.confidence)


def of_capacities(capacity: FloatArray, exceeded: NDArray[np.bool_], draws: Draws) -> Fragility:
    """Return the fragility of capacities, or of the intensities up to which motions did not exceed the limit."""
    fits = capacity_fits(capacity, exceeded, np.ones((1, len(capacity))))
    drawn = capacity_fits(capacity, exceeded, draws.weights)
    number, above = len(capacity), int(exceeded.sum())
    return _of_fits(fits, drawn, "capacities", draws.confidence, number, above, capacity)


def of_stripes(levels: FloatArray, exceeded: Sequence[FloatArray], draws: Sequence[Draws]) -> Fragility:
    """Return the fragility of counts by level: `exceeded` (levels,) is 1 where a motion exceeds, `draws` as many."""
    rows = min(len(draw.weights) for draw in draws)  # none where the motions of a level are of one earthquake
    hits, runs = (np.array([f(each) for each in exceeded], dtype=np.float64) for f in (np.sum, np.size))
    drawn_hits = np.stack([draw.weights[:rows] @ each for draw, each in zip(draws, exceeded, strict=True)], axis=1)
    drawn_runs = np.stack([draw.weights[:rows].sum(axis=1) for draw in draws], axis=1)
    return _of_counts(levels, hits, runs, drawn_hits, drawn_runs, draws[0].confidence)


def of_cloud(
    levels: FloatArray, demand: FloatArray, collapsed: NDArray[np.bool_], limit: float, draws: Draws
) -> Fragility:
    """Return the fragility of demands of motions as they are."""
    curves, kinds = cloud_fits(levels, demand, collapsed, limit, np.ones((1, len(levels))))
    samples, _ = cloud_fits(levels, demand, collapsed, limit, draws.weights)
    return fragility_of(
        curves[0],
        samples,
        kinds[0],
        "cloud",
        draws.confidence,
        runs=len(levels),
        exceeding=int((collapsed | (demand > limit)).sum()),
        intensities=levels,
        remarks=_cloud_remarks(demand, collapsed, curves[0]),
    )


def of_occurrences(levels: FloatArray, occurred: NDArray[np.bool_], draws: Draws) -> Fragility:
    """Return the fragility of what occurs or not in each run, each at its own intensity: a probit regression."""
    every = np.ones(len(levels))
    return _of_counts(levels, every * occurred, every, draws.weights * occurred, draws.weights, draws.confidence)


def _of_counts(
    levels: FloatArray,
    hits: FloatArray,
    runs: FloatArray,
    drawn_hits: FloatArray,
    drawn_runs: FloatArray,
    confidence: float,
) -> Fragility:
    """The fragility of counts, shape (levels,), with those of each resample, shape (resamples, levels)."""
    fits, drawn = probit_fits(levels, hits[None], runs[None]), probit_fits(levels, drawn_hits, drawn_runs)
    return _of_fits(fits, drawn, "counts", confidence, int(runs.sum()), int(hits.sum()), levels[runs > 0.0])


def _of_fits(
    fits: Fits, drawn: Fits, method: FragilityMethod, confidence: float, runs: int, exceeding: int, levels: FloatArray
) -> Fragility:
    """The fragility of one lognormal fit, with those of the resamples."""
    curve, samples, kind = as_curves(fits)[0], as_curves(drawn), fits.kind[0]
    return fragility_of(curve, samples, kind, method, confidence, runs=runs, exceeding=exceeding, intensities=levels)


def fit_counts(
    intensity: ArrayLike,
    exceeding: ArrayLike,
    total: ArrayLike,
    *,
    confidence: float = CONFIDENCE,
    resamples: int = RESAMPLES,
    seed: int = 0,
) -> Fragility:
    """Fit a lognormal fragility to the numbers of runs that exceed a limit at several intensities.

    Parameters
    ----------
    intensity : array_like, shape (levels,)
        Positive intensities.
    exceeding : array_like, shape (levels,)
        Runs that exceed the limit at each of them.
    total : array_like, shape (levels,), or int
        Runs there.
    confidence, resamples, seed
        Of the bootstrap intervals: runs of each level are drawn again by themselves, as for other motions at each
        level. Analyses that scale the same motions draw these instead. There are none where at every level all runs or
        none exceed, as with one run at each.

    Raises
    ------
    InvalidOption
        Lists differ in length, an intensity is not positive, or more runs exceed the limit than there are.

    Notes
    -----
    Maximum of the binomial likelihood: Baker (2015), Efficient analytical fragility function fitting using dynamic
    structural analysis, Earthquake Spectra 31:579-599, eq. 11.

    Examples
    --------
    >>> import seismass as sm
    >>> fit = sm.fragility.fit_counts(
    ...     [0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0], [0, 0, 0, 4, 6, 13, 12, 16], 40
    ... )
    >>> round(fit.median, 2), round(fit.dispersion, 2)
    (1.08, 0.43)
    """
    owner = "fragility fit"
    intensities = _positive(intensity, "intensity", owner)
    hit = as_array(exceeding, "exceeding", owner, InvalidOption)
    runs = as_array(total, "total", owner, InvalidOption, or_number=True)
    runs = np.broadcast_to(runs, intensities.shape) if runs.ndim == 0 else runs
    if not len(intensities) == len(hit) == len(runs):
        got = f"{len(hit)} and {len(runs)}"
        raise refusal(InvalidOption, "exceeding and total", owner, f"lists of {len(intensities)} values", got)
    if not ((hit >= 0.0) & (hit <= runs) & np.isfinite(runs)).all():
        raise refusal(InvalidOption, "exceeding", owner, "from 0 to total", brief(hit.tolist()))
    options = as_bootstrap(confidence, resamples, seed, owner, least=0)
    whole = bool((hit == np.rint(hit)).all() and (runs == np.rint(runs)).all())
    share = np.divide(hit, runs, out=np.zeros(len(intensities)), where=runs > 0.0)
    counts = np.empty((0, len(intensities)))
    # Levels at which all runs or none exceed, one run at each among them, have no scatter to draw from.
    if options.resamples and whole and ((share > 0.0) & (share < 1.0)).any():
        size = (options.resamples, len(intensities))
        counts = np.random.default_rng(options.seed).binomial(runs.astype(np.int64), share, size).astype(np.float64)
    return _of_counts(intensities, hit, runs, counts, np.broadcast_to(runs, counts.shape), options.confidence)


def fit_capacities(
    capacities: ArrayLike,
    censored_above: ArrayLike | None = None,
    *,
    confidence: float = CONFIDENCE,
    resamples: int = RESAMPLES,
    seed: int = 0,
) -> Fragility:
    """Fit a lognormal fragility to the intensities at which motions first exceed a limit.

    Parameters
    ----------
    capacities : array_like, shape (motions,)
        Capacity of each motion; infinite or NaN where it never exceeds the limit.
    censored_above : array_like, shape (motions,), or float, optional
        Highest intensity to which each motion was scaled: a capacity above it only counts as larger than it. Needed
        where a motion never exceeds the limit.
    confidence, resamples, seed
        Of the bootstrap intervals over the motions.

    Raises
    ------
    InvalidOption
        A capacity or limit is not positive, lists differ in length, or `censored_above` is missing.

    Notes
    -----
    Maximum likelihood, with the motions that never exceed the limit as in the truncated incremental dynamic analysis of
    Baker (2015), eq. 7. Without them the median is the geometric mean, and the dispersion the standard deviation of the
    logarithm with divisor n.

    Examples
    --------
    >>> import seismass as sm
    >>> fit = sm.fragility.fit_capacities([0.5, 1.0, 2.0])
    >>> round(fit.median, 12), round(fit.dispersion, 4)
    (1.0, 0.566)
    """
    owner = "fragility fit"
    array = as_array(capacities, "capacities", owner, InvalidOption)
    if not len(array):
        raise refusal(InvalidOption, "capacities", owner, "at least one", "none")
    if (array <= 0.0).any():
        raise refusal(InvalidOption, "capacities", owner, "positive", f"{array[array <= 0.0][0]:g}")
    finite = np.isfinite(array)
    if censored_above is None:
        if not finite.all():
            requirement = "given where a motion never exceeds the limit"
            raise refusal(InvalidOption, "censored_above", owner, requirement, "None")
        ceiling = np.full(len(array), np.inf)
    else:
        ceiling = as_array(censored_above, "censored_above", owner, InvalidOption, or_number=True)
        ceiling = np.broadcast_to(ceiling, array.shape) if ceiling.ndim == 0 else ceiling
        if len(ceiling) != len(array):
            raise refusal(InvalidOption, "censored_above", owner, f"a list of {len(array)} values", f"{len(ceiling)}")
        if not (ceiling > 0.0).all():
            raise refusal(InvalidOption, "censored_above", owner, "positive", brief(ceiling.tolist()))
    exceeded = finite & (array <= ceiling)
    known = np.where(exceeded, array, ceiling)
    if not np.isfinite(known).all():
        requirement = "finite where a motion never exceeds the limit"
        raise refusal(InvalidOption, "censored_above", owner, requirement, brief(ceiling.tolist()))
    options = as_bootstrap(confidence, resamples, seed, owner, least=0)
    return of_capacities(known, exceeded, draws_of(np.arange(len(known)), options))


def fit_cloud(
    intensity: ArrayLike,
    demand: ArrayLike,
    limit: float,
    *,
    collapsed: ArrayLike | None = None,
    confidence: float = CONFIDENCE,
    resamples: int = RESAMPLES,
    seed: int = 0,
) -> Fragility:
    """Fit a fragility to demands of motions as they are: a line through the logarithms, and a curve of collapse.

    Parameters
    ----------
    intensity : array_like, shape (runs,)
        Positive intensity of each run.
    demand : array_like, shape (runs,)
        Its demand. Runs without any (zero) count as below the limit by the line through the others.
    limit : float
        The limit, positive.
    collapsed : array_like of bool, shape (runs,), optional
        Runs that collapsed; by default those of infinite demand.
    confidence, resamples, seed
        Of the bootstrap intervals over the runs.

    Raises
    ------
    InvalidOption
        Lists differ in length, or a value is not what it must be.

    Notes
    -----
    ln(demand) = a + b ln(x) + a normal error of constant deviation s over the runs that do not collapse, so that the
    limit is exceeded with Phi((a + b ln(x) - ln(limit)) / s): Cornell, Jalayer, Hamburger and Foutch (2002), J. Struct.
    Eng. 128:526-533. A logistic regression on ln(x) adds collapse: P = P_nc (1 - P_c) + P_c, Jalayer, Ebrahimian,
    Miano, Manfredi and Sezen (2017), Earthquake Eng. Struct. Dyn. 46:2639-2663. s has divisor n - 2.

    Examples
    --------
    >>> import seismass as sm
    >>> fit = sm.fragility.fit_cloud([0.1, 0.2, 0.4, 0.8], [0.011, 0.019, 0.041, 0.079], 0.02)
    >>> round(fit.median, 1)
    0.2
    """
    owner = "cloud fit"
    intensities = _positive(intensity, "intensity", owner)
    values = as_array(demand, "demand", owner, InvalidOption)
    bound = as_positive(limit, "limit", owner, InvalidOption)
    if len(values) != len(intensities):
        raise refusal(InvalidOption, "demand", owner, f"a list of {len(intensities)} values", f"{len(values)}")
    fell = np.isinf(values) if collapsed is None else np.asarray(collapsed, dtype=np.bool_)
    if fell.shape != intensities.shape:
        raise refusal(InvalidOption, "collapsed", owner, f"a list of {len(intensities)} values", f"shape {fell.shape}")
    if not ((values >= 0.0) & (np.isfinite(values) | fell)).all():
        raise refusal(
            InvalidOption, "demand", owner, "zero or positive, and finite without collapse", brief(values.tolist())
        )
    options = as_bootstrap(confidence, resamples, seed, owner, least=0)
    return of_cloud(intensities, values, fell, bound, draws_of(np.arange(len(values)), options))


def _cloud_remarks(demand: FloatArray, collapsed: NDArray[np.bool_], curve: FloatArray) -> list[str]:
    """What a user of a cloud must know: runs without demand, and collapses that one intensity parts."""
    remarks = []
    zero = int(((demand == 0.0) & ~collapsed).sum())
    if zero:
        remarks.append(
            f"{counted(zero, 'run')} of {len(demand)} without any demand are no part of the line through the "
            "logarithms, so that the curve is too high where such runs are frequent"
        )
    if np.isfinite(curve[2]) and curve[3] == 0.0:
        remarks.append(
            f"all runs above intensity {curve[2]:.3g} collapse and none below it does: how collapse grows with the "
            "intensity cannot be told"
        )
    return remarks


def _positive(value: Any, name: str, owner: str) -> FloatArray:
    values = as_array(value, name, owner, InvalidOption)
    if not len(values):
        raise refusal(InvalidOption, name, owner, "at least one", "none")
    if not ((values > 0.0) & np.isfinite(values)).all():
        raise refusal(InvalidOption, name, owner, "positive and finite", brief(values.tolist()))
    return values
