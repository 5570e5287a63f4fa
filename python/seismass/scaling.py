"""Amplitude scaling of ground motions to a target spectrum."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import polars as pl

from seismass._values import FloatArray, as_count, as_number, brief, frozen, refusal
from seismass.errors import InvalidMotion, InvalidOption
from seismass.plausibility import scaling_remarks
from seismass.simulate import motion_names
from seismass.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum


@dataclass(frozen=True, eq=False)
class ScalingResult:
    """Factors of a suite, and the spectra that they follow from.

    Attributes
    ----------
    names : tuple of str
        Names of the records.
    individual : ndarray, shape (motions,)
        SF1: brings each motion as close to the target as one factor can, in the logarithm.
    common : float
        SF2: lifts the mean spectrum until it is not below the target at any of the periods.
    factors : ndarray, shape (motions,)
        SF1 SF2, by which accelerations are multiplied.
    periods : ndarray, shape (periods,)
        Periods (s) of the comparison.
    target, mean : ndarray, shape (periods,)
        Target and mean scaled pseudo-acceleration (m/s2) there.
    spectra : ndarray, shape (motions, periods)
        Scaled pseudo-acceleration of each motion (m/s2) there.
    governing_period : float
        Period (s) at which the mean touches the target.
    """

    names: tuple[str, ...]
    individual: FloatArray
    common: float
    factors: FloatArray
    periods: FloatArray
    target: FloatArray
    mean: FloatArray
    spectra: FloatArray
    governing_period: float

    def table(self) -> pl.DataFrame:
        """Return one row per motion: number, name, SF1, SF2 and their product."""
        return pl.DataFrame(
            {
                "motion": np.arange(1, len(self.names) + 1, dtype=np.uint32),
                "record": list(self.names),
                "individual_factor": self.individual,
                "common_factor": np.full(len(self.names), self.common),
                "factor": self.factors,
            }
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is unlikely about the factors and the mean spectrum, as sentences; empty as a rule."""
        return scaling_remarks(self)

    def spectrum_table(self) -> pl.DataFrame:
        """Return one row per period: target and mean scaled pseudo-acceleration (m/s2) and their ratio."""
        return pl.DataFrame(
            {"period": self.periods, "target": self.target, "mean": self.mean, "ratio": self.mean / self.target}
        )


def scale_asce7_10(
    records: Iterable[GroundMotion],
    target: TargetSpectrum,
    period: float = 1.0,
    *,
    damping: float = 0.05,
    period_range: tuple[float, float] = (0.2, 1.5),
    count: int = 100,
    threads: int | None = None,
) -> ScalingResult:
    """Return the unique factors by which the mean spectrum of a suite is not below the target at `count` periods.

    Parameters
    ----------
    records : iterable of Record or Motion
        The suite; at least three motions, as the standard asks.
    target : TargetSpectrum
        Design spectrum.
    period : float
        Fundamental period T (s) for which the suite is scaled.
    damping : float
        Ratio of critical damping of the spectra.
    period_range : tuple of float
        Range of the comparison as multiples of T.
    count : int
        Periods in the range, in geometric spacing, ends included, at which the mean is compared. The factors depend on
        it a little: between two of them the mean may be below the target by some tenths of a per cent.
    threads : int, optional
        Number of threads; default all cores.

    Raises
    ------
    InvalidOption
        An argument is out of its range, or the range of periods leaves that of the target.
    InvalidMotion
        Fewer than three motions, or one without any acceleration.

    Notes
    -----
    ASCE/SEI 7-10, 16.1.3.1: the mean of the 5 % damped spectra is not less than the design spectrum from 0.2 T to
    1.5 T. The standard leaves the factors open; these are the two-step ones of Reyes and Kalkan (2012), Earthquake
    Spectra 28:1205, in the logarithm: ln SF1_i = mean over T_j of ln A_t - ln A_i, then SF2 = max over T_j of A_t over
    the mean of SF1_i A_i.
    """
    suite = as_motions(records, "scaling")
    if len(suite) < 3:
        raise refusal(
            InvalidMotion, "records", "scaling", "at least three motions (ASCE/SEI 7-10, 16.1.3)", f"{len(suite)}"
        )
    if not isinstance(target, TargetSpectrum):
        raise refusal(InvalidOption, "target", "scaling", "a TargetSpectrum", brief(target))
    fundamental = as_number(period, "period", "scaling", InvalidOption)
    if not (np.isfinite(fundamental) and fundamental > 0.0):
        raise refusal(InvalidOption, "period", "scaling", "a positive number", f"{fundamental:g}")
    damping_ratio = as_number(damping, "damping", "scaling", InvalidOption)
    points = as_count(count, "count", "scaling", InvalidOption, least=2)
    shortest, longest = _range(period_range)
    periods = fundamental * np.geomspace(shortest, longest, points)
    ordinates = target(periods)
    spectra = response_spectrum(suite, periods, damping_ratio, threads=threads)
    for number, row in enumerate(spectra, start=1):
        if not (row > 0.0).all():
            raise refusal(
                InvalidMotion, "acceleration", f"motion {number}", "other than zero somewhere", "zero throughout"
            )
    individual = np.exp(np.mean(np.log(ordinates) - np.log(spectra), axis=1))
    ratio = ordinates / np.mean(individual[:, None] * spectra, axis=0)
    governing = int(np.argmax(ratio))
    common = float(ratio[governing])
    factors = individual * common
    scaled = factors[:, None] * spectra
    return ScalingResult(
        names=tuple(motion_names(suite)),
        individual=frozen(individual),
        common=common,
        factors=frozen(factors),
        periods=frozen(periods),
        target=frozen(ordinates),
        mean=frozen(np.mean(scaled, axis=0)),
        spectra=frozen(scaled),
        governing_period=float(periods[governing]),
    )


def _range(given: tuple[float, float]) -> tuple[float, float]:
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
