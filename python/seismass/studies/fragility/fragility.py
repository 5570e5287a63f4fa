"""Fragility: the probability that a limit is exceeded, by intensity, fitted to counts, to capacities or to a cloud."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.arguments import as_bootstrap
from seismass.base.errors import InvalidOption
from seismass.base.statistics import interval_of
from seismass.base.values import FieldValue, FloatArray, as_array, as_number, as_positive, brief, counted, refusal
from seismass.base.views import Card
from seismass.studies.fragility.likelihood import Fits, capacity_fits, cloud_fits, probit_fits

NO_COLLAPSE: Final = (np.inf, 0.0)
"""Logistic part of a curve without collapse."""
_BISECTIONS: Final = 60
"""Halvings of a bracket of a logarithm, to below its rounding."""


def probabilities(curves: FloatArray, intensity: FloatArray) -> FloatArray:
    """Return P = P_l + P_c (1 - P_l) of each curve (rows of median, dispersion, centre and width) at each intensity, of
    the lognormal part P_l and the logistic P_c; 0 at intensity 0. A NaN median has NaN.
    """
    columns = [column.reshape(-1, *(1,) * intensity.ndim) for column in curves.T]
    return _probability(columns[0], columns[1], columns[2], columns[3], intensity)


def _probability(
    median: FloatArray, dispersion: FloatArray, centre: FloatArray, width: FloatArray, intensity: FloatArray
) -> FloatArray:
    """Probability of curves at intensities that fit them in shape."""
    from scipy.special import expit, ndtr  # slow to import

    with np.errstate(divide="ignore", invalid="ignore"):
        log = np.log(intensity)
        from_median, from_centre = log - np.log(median), log - np.log(centre)
        lognormal = np.where(dispersion > 0.0, ndtr(from_median / dispersion), (from_median >= 0.0).astype(np.float64))
        logistic = np.where(width > 0.0, expit(from_centre / width), (from_centre >= 0.0).astype(np.float64))
    lognormal = np.where(np.isnan(median), np.nan, lognormal)
    logistic = np.where(np.isnan(centre), np.nan, logistic)
    both = lognormal + logistic * (1.0 - lognormal)
    return np.where(intensity == 0.0, 0.0 * both, both)


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


FragilityKind: TypeAlias = Literal["fitted", "step", "never", "always", "falling", "none"]
"""How a fit ended; see `Fragility`."""
FragilityMethod: TypeAlias = Literal["counts", "capacities", "cloud"]
"""What a fragility was fitted to."""

KINDS: Final[tuple[FragilityKind, ...]] = ("fitted", "step", "never", "always", "falling", "none")
"""Kinds in the order of the numbers that `likelihood` has for them."""
CONFIDENCE: Final = 0.90
"""Default probability of intervals."""
RESAMPLES: Final = 1000
"""Default bootstrap resamples."""

_KIND_TEXTS: Final[dict[FragilityKind, str]] = {
    "fitted": "",
    "step": "an intensity parts the runs that exceed the limit from the others: the dispersion is not known",
    "never": "the limit is never exceeded: the median lies above the highest intensity",
    "always": "the limit is always exceeded: the median lies below the lowest intensity",
    "falling": "the limit is not exceeded more often at higher intensities: no lognormal curve fits",
    "none": "the runs, or the intensities that differ, are too few for a curve",
}


@dataclass(frozen=True, eq=False)
class Fragility(FieldValue, Card):
    """Probability that a limit is exceeded, by intensity: Phi(ln(x / median) / dispersion).

    Attributes
    ----------
    median : float
        Intensity at which the probability is one half. Infinite where the limit is never exceeded, 0 where always,
        NaN where there is no curve.
    dispersion : float
        Standard deviation of the logarithm of the capacity: half of ln of the intensities at 84 and 16 %. 0 for a
        step, NaN where it is not known.
    kind : {"fitted", "step", "never", "always", "falling", "none"}
        "fitted": the likelihood has a maximum. "step": an intensity parts the runs that exceed the limit from the
        others, or all capacities are equal. "never", "always": in all runs the same. "falling": the limit is not
        exceeded more often at higher intensities. "none": too few runs.
    method : {"counts", "capacities", "cloud"}
        What it was fitted to.
    median_interval, dispersion_interval : tuple of float or None
        Percentile bootstrap intervals; None without resamples.
    confidence : float
        Probability of the intervals.
    runs, exceeding : int
        Number of runs (or motions, for capacities), and of those that exceed the limit.
    lowest, highest : float
        Range of the intensities that it was fitted to; beyond it the curve is extrapolated.
    curve : ndarray, shape (4,)
        Median and dispersion of the lognormal part, centre and width of the logistic curve of collapse that a cloud may
        have (infinity and 0: none); see `probability`.
    samples : ndarray, shape (resamples, 4)
        `curve` of each bootstrap resample.
    remarks : tuple of str
        What a user must know beside the numbers.
    """

    median: float
    dispersion: float
    kind: FragilityKind
    method: FragilityMethod
    median_interval: tuple[float, float] | None
    dispersion_interval: tuple[float, float] | None
    confidence: float
    runs: int
    exceeding: int
    lowest: float
    highest: float
    curve: FloatArray = field(repr=False)
    samples: FloatArray = field(repr=False)
    remarks: tuple[str, ...] = field(repr=False)

    def probability(self, intensity: ArrayLike) -> FloatArray:
        """Return the probability that the limit is exceeded, in the shape of `intensity`.

        Where the limit was never (always) exceeded it is 0 (1) up to the highest (down to the lowest) intensity, and
        NaN beyond it, where nothing is known.

        Raises
        ------
        InvalidOption
            An intensity is negative or no number.
        """
        values_of_intensity = _intensities(intensity)
        values = probabilities(self.curve[None], values_of_intensity)[0]
        if self.kind == "never":
            values = np.where(values_of_intensity <= self.highest, 0.0, np.nan)
        elif self.kind == "always":
            values = np.where(values_of_intensity >= self.lowest, 1.0, np.nan)
        return np.asarray(values)

    def band(self, intensity: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the ends of the bootstrap interval of the probability at intensities; NaN without resamples.

        Resamples without a curve are left out.
        """
        values_of_intensity = _intensities(intensity)
        if not len(self.samples):
            return np.full(values_of_intensity.shape, np.nan), np.full(values_of_intensity.shape, np.nan)
        return interval_of(probabilities(self.samples, values_of_intensity), self.confidence)

    def quantile(self, probability: float) -> float:
        """Return the intensity at which the limit is exceeded with a probability.

        Raises
        ------
        InvalidOption
            The probability is not between 0 and 1.
        """
        share = as_number(probability, "probability", "fragility", InvalidOption)
        if not 0.0 < share < 1.0:
            raise refusal(InvalidOption, "probability", "fragility", "between 0 and 1", f"{share:g}")
        return float(quantiles(self.curve[None], share)[0])

    @property
    def text(self) -> str:
        """The curve in one line, and its remarks."""

        def of(value: float, interval: tuple[float, float] | None) -> str:
            return f"{value:.3g}" + ("" if interval is None else f" [{interval[0]:.3g}, {interval[1]:.3g}]")

        if math.isnan(self.median):
            line = f"no curve; {self.exceeding} of {counted(self.runs, 'run')} exceed"
            return "\n".join([line, *(f"remark: {remark}" for remark in self.remarks)])
        scatter = "unknown" if math.isnan(self.dispersion) else of(self.dispersion, self.dispersion_interval)
        line = (
            f"median {of(self.median, self.median_interval)}, dispersion {scatter}; "
            f"{self.exceeding} of {counted(self.runs, 'run')} exceed"
        )
        return "\n".join([line, *(f"remark: {remark}" for remark in self.remarks)])

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the resamples as plain values."""
        names = ["median", "dispersion", "kind", "method", "median_interval", "dispersion_interval", "confidence"]
        names += ["runs", "exceeding", "lowest", "highest", "remarks"]
        return {**{name: getattr(self, name) for name in names}, "curve": self.curve.tolist()}


def as_curves(fits: Fits) -> FloatArray:
    """Return lognormal fits as curves without collapse, shape (samples, 4)."""
    return np.column_stack([fits.median, fits.dispersion, np.tile(NO_COLLAPSE, (len(fits.median), 1))])


def fragility_of(
    curve: FloatArray,
    samples: FloatArray,
    kind: int,
    method: FragilityMethod,
    confidence: float,
    *,
    runs: int,
    exceeding: int,
    intensities: FloatArray,
    remarks: list[str] | None = None,
) -> Fragility:
    """Return a fragility of its curve, those of its resamples, the number of its kind, and what it was fitted to."""
    name = KINDS[kind]
    texts = [_KIND_TEXTS[name]] if name != "fitted" else []
    fitted_median, fitted_dispersion = (float(value[0]) for value in medians_and_dispersions(curve[None]))
    lowest, highest = float(intensities.min(initial=np.inf)), float(intensities.max(initial=0.0))
    if name == "fitted" and not lowest <= fitted_median <= highest:
        texts.append(f"the median is extrapolated: intensities were from {lowest:.3g} to {highest:.3g}")
    intervals: list[tuple[float, float] | None] = [None, None]
    if len(samples) and name == "fitted":
        both = medians_and_dispersions(samples)
        for place, values in enumerate(both):
            low, high = interval_of(values, confidence)
            intervals[place] = (float(low), float(high))
        lost = int(np.isnan(both[0]).sum())
        if lost:
            texts.append(f"{lost} of {len(samples)} resamples have no curve and are left out of the intervals")
    return Fragility(
        median=fitted_median,
        dispersion=fitted_dispersion,
        kind=name,
        method=method,
        median_interval=intervals[0],
        dispersion_interval=intervals[1],
        confidence=confidence,
        runs=runs,
        exceeding=exceeding,
        lowest=lowest,
        highest=highest,
        curve=curve,
        samples=samples,
        remarks=(*texts, *(remarks or ())),
    )


@dataclass(frozen=True, slots=True)
class BootstrapOptions:
    """Probability of intervals, resamples and seed."""

    confidence: float
    resamples: int
    seed: int


def bootstrap_options(confidence: Any, resamples: Any, seed: Any, owner: str) -> BootstrapOptions:
    """Return checked options of a bootstrap."""
    return BootstrapOptions(*as_bootstrap(confidence, resamples, seed, owner, least=0))


def _intensities(value: ArrayLike) -> FloatArray:
    array = np.asarray(value, dtype=np.float64)
    if not (array >= 0.0).all():
        raise refusal(InvalidOption, "intensity", "fragility", "zero or positive", brief(value))
    return array


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
    options = bootstrap_options(confidence, resamples, seed, owner)
    fits = probit_fits(intensities, hit[None], runs[None])
    whole = bool((hit == np.rint(hit)).all() and (runs == np.rint(runs)).all())
    drawn = None
    share = np.divide(hit, runs, out=np.zeros(len(intensities)), where=runs > 0.0)
    # Levels at which all runs or none exceed, one run at each among them, have no scatter to draw from.
    if options.resamples and whole and ((share > 0.0) & (share < 1.0)).any():
        number = runs.astype(np.int64)
        counts = np.random.default_rng(options.seed).binomial(number, share, size=(options.resamples, len(intensities)))
        drawn = probit_fits(intensities, counts.astype(np.float64), np.broadcast_to(runs, counts.shape))
    return fragility_of(
        as_curves(fits)[0],
        np.empty((0, 4)) if drawn is None else as_curves(drawn),
        fits.kind[0],
        "counts",
        options.confidence,
        runs=int(runs.sum()),
        exceeding=int(hit.sum()),
        intensities=intensities[runs > 0.0],
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
    options = bootstrap_options(confidence, resamples, seed, owner)
    count = len(known)
    fits = capacity_fits(known, exceeded, np.ones((1, count)))
    drawn = None
    if options.resamples and count > 1:
        equal = np.full(count, 1.0 / count)
        weights = np.random.default_rng(options.seed).multinomial(count, equal, size=options.resamples)
        drawn = capacity_fits(known, exceeded, weights.astype(np.float64))
    return fragility_of(
        as_curves(fits)[0],
        np.empty((0, 4)) if drawn is None else as_curves(drawn),
        fits.kind[0],
        "capacities",
        options.confidence,
        runs=count,
        exceeding=int(exceeded.sum()),
        intensities=known,
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
    options = bootstrap_options(confidence, resamples, seed, owner)
    curves, kinds = cloud_fits(intensities, values, fell, bound, np.ones((1, len(intensities))))
    samples = np.empty((0, 4))
    if options.resamples and len(intensities) > 1:
        equal = np.full(len(intensities), 1.0 / len(intensities))
        weights = np.random.default_rng(options.seed).multinomial(len(intensities), equal, size=options.resamples)
        samples, _ = cloud_fits(intensities, values, fell, bound, weights.astype(np.float64))
    return fragility_of(
        curves[0],
        samples,
        kinds[0],
        "cloud",
        options.confidence,
        runs=len(intensities),
        exceeding=int((fell | (values > bound)).sum()),
        intensities=intensities,
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


def _positive(value: Any, name: str, owner: str) -> FloatArray:
    values = as_array(value, name, owner, InvalidOption)
    if not len(values):
        raise refusal(InvalidOption, name, owner, "at least one", "none")
    if not ((values > 0.0) & np.isfinite(values)).all():
        raise refusal(InvalidOption, name, owner, "positive and finite", brief(values.tolist()))
    return values
