"""Annual rate of exceeding a limit: a fragility, or the capacities of motions, integrated over a hazard curve.

A hazard curve is a power law on each of its segments, so that integrals of lognormal fragilities and of steps have
closed forms there. There is no error of quadrature; what lies beyond the ends of the curve is bounded.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Final, NamedTuple, Protocol, runtime_checkable

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.values import FieldValue, FloatArray, as_array, as_flag, as_number, as_positive, brief, refusal
from seismass.base.views import Card
from seismass.media.result import finite_values
from seismass.studies.risk.hazard import HazardCurve, check_hazard, check_years

OWNER: Final = "annual rate"
YEARS: Final = 50.0
"""Years for which texts give the probability that belongs to a rate."""
NOTABLE: Final = 0.01
"""A part beyond the curve that may exceed so much of the rate is named in the remarks."""


@runtime_checkable
class Lognormal(Protocol):
    """A lognormal fragility, as `seismass.fragility` fits it."""

    @property
    def median(self) -> float:
        """Intensity (g) at which the limit is exceeded with a probability of one half."""
        ...

    @property
    def dispersion(self) -> float:
        """Standard deviation of the logarithm of the capacity."""
        ...


class RateParts(NamedTuple):
    """Parts of annual rates, arrays of one shape: within the hazard curve, and beyond its ends with the slopes of the
    end segments. `above_least` is the probability at the last point times its rate; the most is that rate.
    """

    within: FloatArray
    below: FloatArray
    above: FloatArray
    above_least: FloatArray

    def total(self, extrapolate: bool) -> FloatArray:
        """Return the rates: over the range of the curve, or with the parts beyond its ends."""
        return self.within + self.below + self.above if extrapolate else self.within


def lognormal_rates(median: ArrayLike, dispersion: ArrayLike, hazard: HazardCurve) -> RateParts:
    """Annual rates of lognormal fragilities in closed form: by parts on segments rate = c x^-k. For one power law:
    rate(median) exp((k dispersion)^2/2), Kennedy and Short (1994) and Cornell (1996).
    """
    from scipy.special import log_ndtr, ndtr  # slow to import

    log_median = np.log(np.asarray(median, dtype=np.float64))
    spread = np.asarray(dispersion, dtype=np.float64)
    steps = spread <= 0.0
    safe = np.where(steps, 1.0, spread)
    x, rates, slopes = np.log(hazard.sa_g), hazard.annual_rate, hazard.slopes
    log_constants = np.log(rates[:-1]) + slopes * x[:-1]

    def second(segment: int, low: FloatArray | None, high: FloatArray | None) -> FloatArray:
        """Third term of the segment, from and to standardised intensities; None is minus or plus infinity."""
        k = slopes[segment]
        shift = k * safe
        to = np.zeros_like(safe) if high is None else np.asarray(log_ndtr(high + shift))
        if low is None:
            difference = to
        elif high is None:
            difference = np.asarray(log_ndtr(-(low + shift)))
        else:
            difference = _log_difference(low + shift, high + shift, log_ndtr)
        with np.errstate(over="ignore"):  # far beyond the lower end
            return np.asarray(np.exp(log_constants[segment] - k * log_median + 0.5 * shift**2 + difference))

    z = [(place - log_median) / safe for place in x]
    first, last = np.asarray(ndtr(z[0])), np.asarray(ndtr(z[-1]))
    inside = sum((second(i, z[i], z[i + 1]) for i in range(len(slopes))), np.zeros_like(safe))
    inner = first * rates[0] - last * rates[-1] + inside
    below = second(0, None, z[0]) - first * rates[0]
    above = last * rates[-1] + second(len(slopes) - 1, z[-1], None)
    above_least = last * rates[-1]
    if steps.any():  # a limit that is exceeded from the median on
        certain = _step_parts(np.exp(log_median), hazard)
        inner, below, above, above_least = (
            np.where(steps, other, value)
            for other, value in zip(certain, (inner, below, above, above_least), strict=True)
        )
    return RateParts(np.maximum(inner, 0.0), np.maximum(below, 0.0), above, above_least)


def capacity_rates(capacities: ArrayLike, hazard: HazardCurve) -> RateParts:
    """Return annual rates where a share of motions exceeds the limit from its capacity on (g, infinite: never): the
    mean over the motions of rate(capacity).
    """
    parts = _step_parts(np.asarray(capacities, dtype=np.float64), hazard)
    return RateParts(*(value.mean(axis=-1) for value in parts))


def stripe_weights(levels: ArrayLike, hazard: HazardCurve) -> FloatArray:
    """Return the weights of probabilities at stripes whose sum is an annual rate (1/year); see `stripe_rates`."""
    x = _levels(levels)
    curve = check_hazard(hazard, OWNER)
    ends = np.log(np.concatenate([[0.5 * x[0]], x]))
    inner = np.log(curve.sa_g)
    points = np.unique(np.concatenate([ends, inner[(inner > ends[0]) & (inner < ends[-1])]]))
    rates = curve.rates(np.exp(points))
    ratio = np.log(rates[:-1] / rates[1:])
    areas = np.concatenate([[0.0], np.cumsum(np.diff(points) * (rates[:-1] - rates[1:]) / ratio)])
    mean = np.diff(np.interp(ends, points, areas)) / np.diff(ends)
    return np.asarray(mean - np.append(mean[1:], 0.0))


def stripe_rates(levels: ArrayLike, probability: ArrayLike, hazard: HazardCurve) -> FloatArray:
    """Return annual rates (1/year) of probabilities at stripes, of the shape behind the stripes.

    Parameters
    ----------
    levels : array_like, shape (stripes,)
        Intensities, increasing, in the unit of the curve.
    probability : array_like, shape (stripes, ...)
        Probability of exceeding a limit at each of them.
    hazard : HazardCurve
        Annual rate of the intensity; it goes on by its end slopes.

    Raises
    ------
    InvalidOption
        An argument is not what it must be.

    Notes
    -----
    The probability is linear in the logarithm of the intensity between stripes, zero at half of the lowest and constant
    above the highest one: assumptions that matter where these stripes carry much. By parts the rate is the sum of the
    increases of the probability times the mean hazard over their interval, in closed form on the curve's power laws.

    Examples
    --------
    >>> import numpy as np
    >>> import seismass as sm
    >>> hazard = sm.risk.HazardCurve([0.1, 1.0], [1e-2, 1e-4])
    >>> [float(f"{rate:.3g}") for rate in sm.risk.stripe_rates([0.5, 1.0], [[0.0, 0.5], [1.0, 1.0]], hazard)]
    [0.000216, 0.000541]
    """
    weights = stripe_weights(levels, hazard)
    return np.asarray(np.tensordot(weights, _at_levels(probability, "probability", len(weights)), 1))


def run_rates(levels: ArrayLike, demand: ArrayLike, limit: float, hazard: HazardCurve) -> FloatArray:
    """Return annual rates (1/year) at which each of many runs exceeds a limit, of the shape behind the levels.

    Parameters
    ----------
    levels : array_like, shape (levels,)
        Intensities, increasing, in the unit of the curve.
    demand : array_like, shape (levels, ...)
        Positive demand of the same motion, building and goods at each of them.
    limit : float
        Demand that must not be exceeded.
    hazard : HazardCurve
        Annual rate of the intensity; it goes on by its end slopes.

    Raises
    ------
    InvalidOption
        An argument is not what it must be.

    Notes
    -----
    The logarithm of the demand is linear in that of the intensity between levels, the demand in proportion to the
    intensity below the lowest, and as at the highest above it. Where a run crosses the limit several times the rates of
    all intensities above it are added. The mean over runs has less scatter, and needs fewer levels, than `stripe_rates`
    of the probabilities, in which a run counts wholly or not at all at each level.

    Examples
    --------
    >>> import seismass as sm
    >>> hazard = sm.risk.HazardCurve([0.1, 1.0], [1e-2, 1e-4])
    >>> [float(f"{rate:.3g}") for rate in sm.risk.run_rates([0.2, 0.8], [[0.01, 0.03], [0.04, 0.12]], 0.02, hazard)]
    [0.000625, 0.00563]
    """
    x, curve = _levels(levels), check_hazard(hazard, OWNER)
    values = _at_levels(demand, "demand", len(x))
    if not (values > 0.0).all():
        raise refusal(InvalidOption, "demand", OWNER, "positive", brief(demand))
    excess = np.log(values / as_positive(limit, "limit", OWNER, InvalidOption))
    known, exceeds = curve.rates(x), excess > 0.0
    rates = np.where(exceeds[-1], known[-1], 0.0)
    rates += np.where(exceeds[0], curve.rates(x[0] * np.exp(-np.maximum(excess[0], 0.0))) - known[0], 0.0)
    for i in range(len(x) - 1):
        low, high = excess[i : i + 2]
        part = np.where(exceeds[i] != exceeds[i + 1], low / np.where(low == high, 1.0, low - high), 0.0)
        crossing = curve.rates(x[i] * (x[i + 1] / x[i]) ** part)
        rates += np.where(exceeds[i], known[i], crossing) - np.where(exceeds[i + 1], known[i + 1], crossing)
    return rates


def _levels(levels: ArrayLike) -> FloatArray:
    """Return intensities, positive and increasing."""
    x = as_array(levels, "levels", OWNER, InvalidOption)
    if not len(x) or not (x > 0.0).all() or not (np.diff(x) > 0.0).all():
        raise refusal(InvalidOption, "levels", OWNER, "positive and increasing", brief(x.tolist()))
    return x


def _at_levels(numbers: ArrayLike, name: str, levels: int) -> FloatArray:
    """Return numbers with a row for each level."""
    try:
        values = np.asarray(numbers, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        values = np.empty(0)
    if values.shape[:1] != (levels,):
        raise refusal(InvalidOption, name, OWNER, f"{levels} rows of numbers, one for each level", brief(numbers))
    return values


def _step_parts(capacity: FloatArray, hazard: HazardCurve) -> RateParts:
    """Parts of the rate of exceeding each of several capacities."""
    lowest, highest = hazard.annual_rate[0], hazard.annual_rate[-1]
    finite = np.isfinite(capacity)
    rates = np.where(finite, hazard.rates(np.where(finite, capacity, hazard.sa_g[-1])), 0.0)
    is_past_end = capacity > hazard.sa_g[-1]
    return RateParts(
        within=np.where(is_past_end, 0.0, np.minimum(rates, lowest) - highest),
        below=np.maximum(rates - lowest, 0.0),
        above=np.minimum(rates, highest),
        above_least=np.where(is_past_end, 0.0, highest),
    )


def _log_difference(low: FloatArray, high: FloatArray, log_ndtr: Any) -> FloatArray:
    """ln(Phi(high) - Phi(low)) for low < high, from the tail in which both are small."""
    flipped = low > 0.0
    smaller = np.asarray(log_ndtr(np.where(flipped, -high, low)))
    larger = np.asarray(log_ndtr(np.where(flipped, -low, high)))
    with np.errstate(divide="ignore"):
        return np.asarray(larger + np.log1p(-np.exp(smaller - larger)))


@dataclass(frozen=True, eq=False, repr=False)
class AnnualRate(FieldValue, Card):
    """Annual rate of exceeding a limit, with what the hazard curve leaves out.

    Attributes
    ----------
    value : float
        The rate (1/year): `within`, or with the parts beyond the curve where it was extrapolated.
    within : float
        Part of the intensities on the hazard curve.
    below, above : float
        Parts beyond its ends, if the end segments go on: estimates.
    bounds : tuple of float
        Between which the rate lies, whatever the curve does above its last point: `within` with the least and with
        the most that stronger motions contribute. Motions below the first point are left out.
    extrapolated : bool
        Whether `value` includes `below` and `above`.
    contributions : polars.DataFrame
        One row per segment of the curve: sa_g_from, sa_g_to, slope, rate (part of `within`), share (of `within`).
    hazard : HazardCurve
        The curve.
    remarks : tuple of str
        What a user must know beside the number.
    """

    value: float
    within: float
    below: float
    above: float
    bounds: tuple[float, float]
    extrapolated: bool
    contributions: pl.DataFrame = field(repr=False)
    hazard: HazardCurve = field(repr=False)
    remarks: tuple[str, ...] = field(repr=False)

    def probability(self, years: float = YEARS) -> float:
        """Return the probability of at least one exceedance in so many years, as a Poisson process."""
        return float(-np.expm1(-self.value * check_years(years, OWNER)))

    @property
    def text(self) -> str:
        """The rate in a few lines."""
        strongest = self.contributions.sort("rate", descending=True).row(0, named=True)
        lines = [
            f"annual rate      {self.value:.4g} a year, {100.0 * self.probability():.3g} % in {YEARS:g} years"
            f"{', extrapolated beyond the hazard curve' if self.extrapolated else ''}",
            f"bounds           {self.bounds[0]:.4g} to {self.bounds[1]:.4g}, whatever the hazard is above "
            f"{self.hazard.sa_g[-1]:g} g",
            f"most of it       {100.0 * strongest['share']:.0f} % from {strongest['sa_g_from']:.3g} to "
            f"{strongest['sa_g_to']:.3g} g",
        ]
        return "\n".join([*lines, *(f"remark           {remark}" for remark in self.remarks)])

    def tables(self) -> dict[str, pl.DataFrame]:
        """Return the tables by name: contributions, hazard."""
        return {"contributions": self.contributions, "hazard": self.hazard.table()}

    def to_json(self) -> str:
        """Return everything as JSON."""
        names = ("value", "within", "below", "above", "bounds", "extrapolated", "remarks")
        document: dict[str, Any] = {name: getattr(self, name) for name in names}
        document |= {"contributions": self.contributions.to_dicts(), "hazard": self.hazard.parameters}
        return json.dumps(finite_values(document), indent=2, allow_nan=False)


def annual_rate(fragility: Lognormal | ArrayLike, hazard: HazardCurve, *, extrapolate: bool = False) -> AnnualRate:
    """Return the annual rate of exceeding a limit: the integral of its probability over a hazard curve.

    Parameters
    ----------
    fragility : Fragility or array_like, shape (motions,)
        A lognormal fragility, as `fit_counts`, `fit_capacities` and `fit_cloud` return it (anything with a `median` in
        g and a `dispersion`), or the capacities (g) of motions that are equally likely, infinite where a motion never
        exceeds the limit.
    hazard : HazardCurve
        Annual rate of the intensity that the fragility depends on.
    extrapolate : bool, default False
        Continue the end segments of the curve beyond its ends, instead of leaving out what lies there.

    Raises
    ------
    InvalidOption
        An argument is not what it must be.

    Notes
    -----
    rate(F) = integral of P(F given x) (-d rate(x)), in closed form on every segment (see `lognormal_rates` and
    `capacity_rates`).

    Examples
    --------
    A power law through (0.1 g, 0.01/year) with k = 2, and a median of 0.5 g: rate(median) exp((k dispersion)^2/2).

    >>> import numpy as np
    >>> import seismass as sm
    >>> sa = np.geomspace(1e-4, 1e3, 8)
    >>> hazard = sm.risk.HazardCurve(sa, 0.01 * (sa / 0.1) ** -2.0)
    >>> fragility = sm.fragility.fit_capacities([0.5 * np.exp(-0.4), 0.5 * np.exp(0.4)])  # dispersion 0.4
    >>> closed_form = 0.01 * 5.0**-2.0 * np.exp(0.32)
    >>> bool(np.isclose(sm.risk.annual_rate(fragility, hazard, extrapolate=True).value, closed_form, rtol=1e-12))
    True
    """
    curve = check_hazard(hazard, OWNER)
    if isinstance(fragility, Lognormal):
        if np.isfinite(getattr(fragility, "parts", (0.0, 0.0, -np.inf))[2]):
            requirement = "lognormal, without a logistic part of collapse, or the capacities of motions"
            raise refusal(InvalidOption, "fragility", OWNER, requirement, "that of a cloud with collapses")
        median = as_number(fragility.median, "median", "fragility", InvalidOption)
        dispersion = as_number(fragility.dispersion, "dispersion", "fragility", InvalidOption)
        if not 0.0 < median < np.inf:
            raise refusal(InvalidOption, "median", "fragility", "a positive number", f"{median:g}")
        if not 0.0 <= dispersion < np.inf:
            raise refusal(InvalidOption, "dispersion", "fragility", "zero or positive", f"{dispersion:g}")
        parts = lognormal_rates(median, dispersion, curve)
        pieces = [float(lognormal_rates(median, dispersion, one).within) for one in _segments(curve)]
    else:
        capacities = as_array(fragility, "fragility", OWNER, InvalidOption)
        if len(capacities) == 0 or not (capacities > 0.0).all():
            requirement = "a Fragility, or the positive capacities of motions"
            raise refusal(InvalidOption, "fragility", OWNER, requirement, brief(fragility))
        parts = capacity_rates(capacities, curve)
        pieces = [float(capacity_rates(capacities, one).within) for one in _segments(curve)]
    inner, below, above, least = (float(part) for part in parts)
    rates = np.array(pieces)
    is_extrapolated = as_flag(extrapolate, "extrapolate", OWNER, InvalidOption)
    value = float(parts.total(is_extrapolated))
    return AnnualRate(
        value=value,
        within=inner,
        below=below,
        above=above,
        bounds=(inner + least, inner + float(curve.annual_rate[-1])),
        extrapolated=is_extrapolated,
        contributions=pl.DataFrame(
            {
                "sa_g_from": curve.sa_g[:-1],
                "sa_g_to": curve.sa_g[1:],
                "slope": curve.slopes,
                "rate": rates,
                "share": rates / inner if inner > 0.0 else np.zeros_like(rates),
            }
        ),
        hazard=curve,
        remarks=truncation_remarks(inner, below, above, curve),
    )


def truncation_remarks(inner: float, below: float, above: float, hazard: HazardCurve) -> tuple[str, ...]:
    """Return the remarks on the parts beyond the ends of a hazard curve: none where they are small."""
    remarks = []
    for part, end, motions in (
        (below, f"begins at {hazard.sa_g[0]:g} g", "weaker"),
        (above, f"ends at {hazard.sa_g[-1]:g} g", "stronger"),
    ):
        if part > NOTABLE * inner:
            amount = f"{100.0 * part / inner:.2g} % of the rate" if inner > 0.0 else f"a rate of {part:.2g} a year"
            remarks.append(f"the hazard curve {end}: {motions} motions would add {amount}, by its end slope")
    return tuple(remarks)


def _segments(hazard: HazardCurve) -> list[HazardCurve]:
    """Return each segment of a curve as a curve."""
    return [
        HazardCurve(hazard.sa_g[i : i + 2], hazard.annual_rate[i : i + 2]) for i in range(len(hazard.annual_rate) - 1)
    ]
