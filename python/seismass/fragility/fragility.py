"""Fragility: the probability that a limit is exceeded, by intensity, fitted to counts, to capacities or to a cloud."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.quantiles import interval_of
from seismass.base.values import (
    FloatArray,
    as_count,
    as_number,
    brief,
    content_hash,
    counted,
    refusal,
    same_content,
)
from seismass.base.views import Card
from seismass.fragility.likelihood import Fits
from seismass.fragility.probability import NO_COLLAPSE, medians_and_dispersions, probabilities, quantiles

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
class Fragility(Card):
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

    __eq__ = same_content
    __hash__ = content_hash

    def probability(self, intensity: ArrayLike) -> FloatArray:
        """Return the probability that the limit is exceeded, in the shape of `intensity`.

        Where the limit was never (always) exceeded it is 0 (1) up to the highest (down to the lowest) intensity, and
        NaN beyond it, where nothing is known.

        Raises
        ------
        InvalidOption
            An intensity is negative or no number.
        """
        at = _intensities(intensity)
        found = probabilities(self.curve[None], at)[0]
        if self.kind == "never":
            found = np.where(at <= self.highest, 0.0, np.nan)
        elif self.kind == "always":
            found = np.where(at >= self.lowest, 1.0, np.nan)
        return np.asarray(found)

    def band(self, intensity: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the ends of the bootstrap interval of the probability at intensities; NaN without resamples.

        Resamples without a curve are left out.
        """
        at = _intensities(intensity)
        if not len(self.samples):
            return np.full(at.shape, np.nan), np.full(at.shape, np.nan)
        return interval_of(probabilities(self.samples, at), self.confidence)

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
    at: FloatArray,
    remarks: list[str] | None = None,
) -> Fragility:
    """Return a fragility of its curve, those of its resamples, the number of its kind, and what it was fitted to."""
    name = KINDS[kind]
    said = [_KIND_TEXTS[name]] if name != "fitted" else []
    own_median, own_dispersion = (float(value[0]) for value in medians_and_dispersions(curve[None]))
    lowest, highest = float(at.min(initial=np.inf)), float(at.max(initial=0.0))
    if name == "fitted" and not lowest <= own_median <= highest:
        said.append(f"the median is extrapolated: intensities were from {lowest:.3g} to {highest:.3g}")
    intervals: list[tuple[float, float] | None] = [None, None]
    if len(samples) and name == "fitted":
        both = medians_and_dispersions(samples)
        for place, values in enumerate(both):
            low, high = interval_of(values, confidence)
            intervals[place] = (float(low), float(high))
        lost = int(np.isnan(both[0]).sum())
        if lost:
            said.append(f"{lost} of {len(samples)} resamples have no curve and are left out of the intervals")
    return Fragility(
        median=own_median,
        dispersion=own_dispersion,
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
        remarks=(*said, *(remarks or ())),
    )


@dataclass(frozen=True, slots=True)
class BootstrapOptions:
    """Probability of intervals, resamples and seed."""

    confidence: float
    resamples: int
    seed: int


def bootstrap_options(confidence: Any, resamples: Any, seed: Any, owner: str) -> BootstrapOptions:
    """Return checked options of a bootstrap."""
    share = as_number(confidence, "confidence", owner, InvalidOption)
    if not 0.0 < share < 1.0:
        raise refusal(InvalidOption, "confidence", owner, "between 0 and 1", f"{share:g}")
    count = as_count(resamples, "resamples", owner, InvalidOption)
    return BootstrapOptions(share, count, as_count(seed, "seed", owner, InvalidOption))


def _intensities(given: ArrayLike) -> FloatArray:
    at = np.asarray(given, dtype=np.float64)
    if not (at >= 0.0).all():
        raise refusal(InvalidOption, "intensity", "fragility", "zero or positive", brief(given))
    return at
