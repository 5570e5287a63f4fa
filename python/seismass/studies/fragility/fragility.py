"""Fragility: the probability that a limit is exceeded, by intensity."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.statistics import interval_of
from seismass.base.values import FieldValue, FloatArray, as_number, brief, counted, refusal
from seismass.base.views import Card
from seismass.studies.fragility.likelihood import Fits

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


def _intensities(value: ArrayLike) -> FloatArray:
    array = np.asarray(value, dtype=np.float64)
    if not (array >= 0.0).all():
        raise refusal(InvalidOption, "intensity", "fragility", "zero or positive", brief(value))
    return array
