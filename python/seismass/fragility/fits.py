"""Fragilities fitted to counts at intensities, to capacities of motions, and to a cloud of runs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.errors import InvalidOption
from seismass.base.values import (
    FloatArray,
    as_array,
    as_positive,
    brief,
    counted,
    refusal,
)
from seismass.fragility.fragility import CONFIDENCE, RESAMPLES, Fragility, as_curves, bootstrap_options, fragility_of
from seismass.fragility.likelihood import capacity_fits, cloud_fits, probit_fits


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
    at = _positive(intensity, "intensity", owner)
    hit = as_array(exceeding, "exceeding", owner, InvalidOption)
    runs = as_array(total, "total", owner, InvalidOption, or_number=True)
    runs = np.broadcast_to(runs, at.shape) if runs.ndim == 0 else runs
    if not len(at) == len(hit) == len(runs):
        got = f"{len(hit)} and {len(runs)}"
        raise refusal(InvalidOption, "exceeding and total", owner, f"lists of {len(at)} values", got)
    if not ((hit >= 0.0) & (hit <= runs) & np.isfinite(runs)).all():
        raise refusal(InvalidOption, "exceeding", owner, "from 0 to total", brief(hit.tolist()))
    chosen = bootstrap_options(confidence, resamples, seed, owner)
    fits = probit_fits(at, hit[None], runs[None])
    whole = bool((hit == np.rint(hit)).all() and (runs == np.rint(runs)).all())
    drawn = None
    share = np.divide(hit, runs, out=np.zeros(len(at)), where=runs > 0.0)
    # Levels at which all runs or none exceed, one run at each among them, have no scatter to draw from.
    if chosen.resamples and whole and ((share > 0.0) & (share < 1.0)).any():
        number = runs.astype(np.int64)
        counts = np.random.default_rng(chosen.seed).binomial(number, share, size=(chosen.resamples, len(at)))
        drawn = probit_fits(at, counts.astype(np.float64), np.broadcast_to(runs, counts.shape))
    return fragility_of(
        as_curves(fits)[0],
        np.empty((0, 4)) if drawn is None else as_curves(drawn),
        fits.kind[0],
        "counts",
        chosen.confidence,
        runs=int(runs.sum()),
        exceeding=int(hit.sum()),
        at=at[runs > 0.0],
    )


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
    given = as_array(capacities, "capacities", owner, InvalidOption)
    if not len(given):
        raise refusal(InvalidOption, "capacities", owner, "at least one", "none")
    if (given <= 0.0).any():
        raise refusal(InvalidOption, "capacities", owner, "positive", f"{given[given <= 0.0][0]:g}")
    finite = np.isfinite(given)
    if censored_above is None:
        if not finite.all():
            requirement = "given where a motion never exceeds the limit"
            raise refusal(InvalidOption, "censored_above", owner, requirement, "None")
        ceiling = np.full(len(given), np.inf)
    else:
        ceiling = as_array(censored_above, "censored_above", owner, InvalidOption, or_number=True)
        ceiling = np.broadcast_to(ceiling, given.shape) if ceiling.ndim == 0 else ceiling
        if len(ceiling) != len(given):
            raise refusal(InvalidOption, "censored_above", owner, f"a list of {len(given)} values", f"{len(ceiling)}")
        if not (ceiling > 0.0).all():
            raise refusal(InvalidOption, "censored_above", owner, "positive", brief(ceiling.tolist()))
    exceeded = finite & (given <= ceiling)
    known = np.where(exceeded, given, ceiling)
    if not np.isfinite(known).all():
        requirement = "finite where a motion never exceeds the limit"
        raise refusal(InvalidOption, "censored_above", owner, requirement, brief(ceiling.tolist()))
    chosen = bootstrap_options(confidence, resamples, seed, owner)
    count = len(known)
    fits = capacity_fits(known, exceeded, np.ones((1, count)))
    drawn = None
    if chosen.resamples and count > 1:
        equal = np.full(count, 1.0 / count)
        weights = np.random.default_rng(chosen.seed).multinomial(count, equal, size=chosen.resamples)
        drawn = capacity_fits(known, exceeded, weights.astype(np.float64))
    return fragility_of(
        as_curves(fits)[0],
        np.empty((0, 4)) if drawn is None else as_curves(drawn),
        fits.kind[0],
        "capacities",
        chosen.confidence,
        runs=count,
        exceeding=int(exceeded.sum()),
        at=known,
    )


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
    at = _positive(intensity, "intensity", owner)
    values = as_array(demand, "demand", owner, InvalidOption)
    bound = as_positive(limit, "limit", owner, InvalidOption)
    if len(values) != len(at):
        raise refusal(InvalidOption, "demand", owner, f"a list of {len(at)} values", f"{len(values)}")
    fell = np.isinf(values) if collapsed is None else np.asarray(collapsed, dtype=np.bool_)
    if fell.shape != at.shape:
        raise refusal(InvalidOption, "collapsed", owner, f"a list of {len(at)} values", f"shape {fell.shape}")
    if not ((values >= 0.0) & (np.isfinite(values) | fell)).all():
        raise refusal(
            InvalidOption, "demand", owner, "zero or positive, and finite without collapse", brief(values.tolist())
        )
    chosen = bootstrap_options(confidence, resamples, seed, owner)
    curves, kinds = cloud_fits(at, values, fell, bound, np.ones((1, len(at))))
    samples = np.empty((0, 4))
    if chosen.resamples and len(at) > 1:
        equal = np.full(len(at), 1.0 / len(at))
        weights = np.random.default_rng(chosen.seed).multinomial(len(at), equal, size=chosen.resamples)
        samples, _ = cloud_fits(at, values, fell, bound, weights.astype(np.float64))
    return fragility_of(
        curves[0],
        samples,
        kinds[0],
        "cloud",
        chosen.confidence,
        runs=len(at),
        exceeding=int((fell | (values > bound)).sum()),
        at=at,
        remarks=cloud_remarks(values, fell, curves[0]),
    )


def cloud_remarks(demand: FloatArray, collapsed: NDArray[np.bool_], curve: FloatArray) -> list[str]:
    """Return what a user of a cloud must know: runs without demand, and collapses that one intensity parts."""
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


def _positive(given: Any, name: str, owner: str) -> FloatArray:
    values = as_array(given, name, owner, InvalidOption)
    if not len(values):
        raise refusal(InvalidOption, name, owner, "at least one", "none")
    if not ((values > 0.0) & np.isfinite(values)).all():
        raise refusal(InvalidOption, name, owner, "positive and finite", brief(values.tolist()))
    return values
