"""What scaling methods share: the arguments as they judge them, the spectra of the suite, and the result."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, as_count, as_number, as_positive, brief, frozen, refusal
from seismass.model.motion import motion_names
from seismass.scaling.result import ScalingResult
from seismass.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum
from seismass.spectra.motions import check_not_zero


@dataclass(frozen=True, eq=False)
class SuiteSpectra:
    """A suite with its unscaled spectra (m/s2, motions x periods) beside the target at the periods of comparison."""

    names: tuple[str, ...]
    period: float
    damping: float
    periods: FloatArray
    target: FloatArray
    spectra: FloatArray
    target_label: str

    def result(
        self, method: str, individual: FloatArray, common: float = 1.0, notes: Iterable[str] = ()
    ) -> ScalingResult:
        """Return the result of these factors."""
        return ScalingResult(**self.content(method, individual, common, notes))

    def content(self, method: str, individual: FloatArray, common: float, notes: Iterable[str]) -> dict[str, Any]:
        """Return the attributes of a result of these factors."""
        factors = individual * common
        scaled = factors[:, None] * self.spectra
        mean = np.mean(scaled, axis=0)
        return {
            "names": self.names,
            "individual": frozen(individual),
            "common": common,
            "factors": frozen(factors),
            "periods": self.periods,
            "target": self.target,
            "mean": frozen(mean),
            "spectra": frozen(scaled),
            "governing_period": float(self.periods[int(np.argmin(mean / self.target))]),
            "method": method,
            "period": self.period,
            "damping": self.damping,
            "target_label": self.target_label,
            "notes": tuple(notes),
        }

    def log_factors(self) -> FloatArray:
        """Return the factors that bring each motion closest to the target, in the logarithm."""
        factors: FloatArray = np.exp(np.mean(np.log(self.target) - np.log(self.spectra), axis=1))
        return factors

    def common_factor(self, individual: FloatArray, share: float) -> float:
        """Return the factor that lifts the mean of the motions until it is nowhere below the share of the target."""
        mean = np.mean(individual[:, None] * self.spectra, axis=0)
        return float(np.max(share * self.target / mean))


def suite_spectra(
    records: Iterable[GroundMotion],
    target: TargetSpectrum,
    period: Any,
    *,
    damping: Any,
    period_range: Any,
    count: Any,
    threads: int | None,
    least: tuple[int, str] = (1, ""),
) -> SuiteSpectra:
    """Return the spectra of a suite at `count` periods over the range, in geometric spacing; `least` is the least
    number of motions, and what asks for it. Other arguments as in `scale_asce7_10`.
    """
    suite = as_motions(records, "scaling")
    number, clause = least
    if len(suite) < number:
        words = {3: "three", 11: "eleven"}.get(number, str(number))
        raise refusal(InvalidMotion, "records", "scaling", f"at least {words} motions ({clause})", f"{len(suite)}")
    checked_target(target)
    fundamental = positive_period(period)
    damping_ratio = as_number(damping, "damping", "scaling", InvalidOption)
    points = as_count(count, "count", "scaling", InvalidOption, least=2)
    shortest, longest = checked_range(period_range)
    periods = fundamental * np.geomspace(shortest, longest, points)
    ordinates = target(periods)
    spectra = response_spectrum(suite, periods, damping_ratio, threads=threads)
    check_not_zero(spectra)
    return SuiteSpectra(
        names=tuple(motion_names(suite)),
        period=fundamental,
        damping=damping_ratio,
        periods=frozen(periods),
        target=frozen(ordinates),
        spectra=frozen(spectra),
        target_label=target.label,
    )


def checked_target(target: Any) -> None:
    """Refuse what is not a target spectrum."""
    if not isinstance(target, TargetSpectrum):
        raise refusal(InvalidOption, "target", "scaling", "a TargetSpectrum", brief(target))


def positive_period(period: Any) -> float:
    """Return a positive period (s)."""
    return positive_number(period, "period")


def positive_number(value: Any, name: str) -> float:
    """Return a positive number."""
    return as_positive(value, name, "scaling", InvalidOption)


def checked_range(given: Any) -> tuple[float, float]:
    """Return two positive multiples of the period, the smaller first."""
    requirement = "two positive multiples of the period, the smaller first"
    try:
        shortest, longest = (as_number(value, "period_range", "scaling", InvalidOption) for value in given)
    except (TypeError, ValueError) as error:
        if isinstance(error, InvalidOption):
            raise
        raise refusal(InvalidOption, "period_range", "scaling", requirement, brief(given)) from None
    if not (0.0 < shortest < longest < np.inf):
        raise refusal(InvalidOption, "period_range", "scaling", requirement, brief(given))
    return shortest, longest
