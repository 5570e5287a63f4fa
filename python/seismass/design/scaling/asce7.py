"""Amplitude scaling of ASCE/SEI 7: that of 7-10 for two-dimensional analysis, and the preset of 7-16 and 7-22."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_flag, brief, frozen, refusal
from seismass.design.modes import vibration_modes
from seismass.model.building import Building
from seismass.motions.motion import Motion
from seismass.motions.records.pair import Pair
from seismass.motions.scaling.result import ScalingResult
from seismass.motions.scaling.suite import SuiteSpectra, positive_number, positive_period, suite_spectra
from seismass.motions.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum
from seismass.motions.spectra.elastic import check_not_zero

SHARE_7_16: Final = 0.9
"""Least mean over target, ASCE/SEI 7-16, 16.2.3.2."""
MOTIONS_7_16: Final = 11
"""Least number of motions, 16.2.2."""
MASS_7_16: Final = 0.9
"""Share of the mass that the modes down to the lower end of the range take part with, 16.2.3.1."""
REFINED: Final = 10
"""Periods between two at which motions are compared, at which the mean is held above the target."""
LOWEST: Final = 5
"""Periods around which it is looked at once more, as closely again."""
DIRECTIONS: Final = 180
"""Directions over half a turn in which the spectrum of a pair is taken."""


def scale_asce7_10(
    records: Iterable[GroundMotion | Pair],
    target: TargetSpectrum,
    period: float = 1.0,
    *,
    damping: float = 0.05,
    period_range: tuple[float, float] = (0.2, 1.5),
    count: int = 100,
    between: bool = True,
    threads: int | None = None,
) -> ScalingResult:
    """Return the unique factors by which the mean spectrum of a suite is nowhere below the target over a range.

    Parameters
    ----------
    records : iterable of Record or Motion, or of Pair
        The suite; at least three motions, as the standard asks. The spectrum of a pair is the geometric mean of those
        of its components as they are; the factor is that of both.
    target : TargetSpectrum
        Design spectrum.
    period : float, default 1.0
        Fundamental period T (s) for which the suite is scaled.
    damping : float, default 0.05
        Ratio of critical damping of the spectra.
    period_range : tuple of float, optional
        Range of the comparison as multiples of T.
    count : int, default 100
        Periods in the range, in geometric spacing, ends included, at which motions are fitted and the result is shown.
    between : bool, default True
        Whether the mean is held above the target between these periods, too: at ten times as many, and around the
        lowest of those. False, at these periods alone, where it may be lower between two by some tenths of a per
        cent: so the study, the assessment, the maps and the live page scale, as the paper does.
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
    listed = _listed_records(records)
    suite = suite_spectra(
        _first_components(listed),
        target,
        period,
        damping=damping,
        period_range=period_range,
        count=count,
        threads=threads,
        least=(3, "ASCE/SEI 7-10, 16.1.3"),
    )
    if any(_is_pair(item) for item in listed):
        names = tuple(item.name or name for item, name in zip(listed, suite.names, strict=True))
        suite = replace(
            suite, spectra=frozen(spectra_of(listed, suite.periods, suite.damping, threads=threads)), names=names
        )
    individual = suite.log_factors()
    common = suite.common_factor(individual, 1.0)
    if as_flag(between, "between", "scaling", InvalidOption):
        common = max(common, 1.0 / _least_between(suite, listed, target, individual, threads))
    return suite.result("ASCE 7-10", individual, common)


def _listed_records(records: Any) -> list[Any]:
    """Motions and pairs as a list."""
    single = hasattr(records, "acceleration") or not isinstance(records, Iterable)
    return as_motions(records, "scaling") if single else list(records)


def _is_pair(item: Any) -> bool:
    return hasattr(item, "at_angles")


def _first_components(records: list[Any]) -> list[Any]:
    """Motions, and the first component of each pair."""
    return [item.first if _is_pair(item) else item for item in records]


def spectra_of(
    records: list[Any], periods: FloatArray, damping: float = 0.05, *, threads: int | None = None
) -> FloatArray:
    """Return spectra of motions (m/s2, motions x periods); of a pair the geometric mean of its components'."""
    if not any(_is_pair(item) for item in records):
        alone: FloatArray = response_spectrum(records, periods, damping, threads=threads)
        return alone
    both = [_first_components(records), [item.second if _is_pair(item) else item for item in records]]
    first, second = (response_spectrum(each, periods, damping, threads=threads) for each in both)
    check_not_zero(second)
    mean: FloatArray = np.sqrt(first * second)
    return mean


def _least_between(
    suite: SuiteSpectra,
    records: list[Any],
    target: TargetSpectrum,
    individual: FloatArray,
    threads: int | None,
) -> float:
    """Return the least ratio of the mean to the target over the range, of motions times their own factors."""

    def over(periods: FloatArray) -> FloatArray:
        ratios: FloatArray = np.mean(
            individual[:, None] * spectra_of(records, periods, suite.damping, threads=threads), axis=0
        )
        ratios /= target(periods)
        return ratios

    first, last = suite.periods[0], suite.periods[-1]
    grid = np.geomspace(first, last, REFINED * (len(suite.periods) - 1) + 1)
    ratios = over(grid)
    step = grid[1] / grid[0]
    lowest = grid[np.argsort(ratios)[:LOWEST]]
    near = np.clip((lowest[:, None] * np.geomspace(1.0 / step, step, 2 * REFINED + 1)).ravel(), first, last)
    return min(float(ratios.min()), float(over(np.unique(near)).min()))


def scale_asce7_16(
    records: Iterable[Any],
    target: TargetSpectrum,
    period: float | None = None,
    *,
    building: Building | None = None,
    lowest_period: float | None = None,
    damping: float = 0.05,
    longest: float = 2.0,
    count: int = 100,
    threads: int | None = None,
) -> ScalingResult:
    """Return the factors by which the mean spectrum of a suite is nowhere below 90 % of the target, as ASCE 7-16 asks.

    Parameters
    ----------
    records : iterable of Record or Motion, or of Pair
        At least eleven. The spectrum of a pair is its largest over 180 directions in plan (maximum direction); the
        factor is that of both its components. A motion has its own spectrum.
    target : TargetSpectrum
        The standard's is MCE_R in the maximum direction.
    period : float, optional
        First period T (s); by default that of the building, and 1 s without one.
    building : Building, optional
        Its modes say which period takes part with 90 % of the mass.
    lowest_period : float, optional
        That period (s), where no building is given. The range begins at it where it is below 0.2 T, else at 0.2 T.
    damping : float, default 0.05
        Ratio of critical damping of the spectra.
    longest : float, default 2.0
        Upper end of the range as a multiple of T; the standard permits a lower one, down to 1.5, where it is justified.
    count : int, default 100
        Periods in the range, in geometric spacing, ends included.
    threads : int, optional
        Number of threads; default all cores.

    Raises
    ------
    InvalidOption
        An argument is out of its range, the range leaves that of the target, or a period is given beside a building.
    InvalidMotion
        Fewer than eleven motions, or one without any acceleration.

    Notes
    -----
    ASCE/SEI 7-16, 16.2.3, which 7-22 keeps. The individual factors are those of `scale_asce7_10`, the standard leaves
    them open. What the result cannot honour is in its `notes`.
    """
    if building is not None and not isinstance(building, Building):
        raise refusal(InvalidOption, "building", "scaling", "a Building", brief(building))
    if building is not None and (period is not None or lowest_period is not None):
        name = "period" if period is not None else "lowest_period"
        value = period if period is not None else lowest_period
        raise refusal(InvalidOption, name, "scaling", "left out where a building is given", brief(value))
    if building is not None:
        period, lowest_period = float(building.periods[0]), _period_of_mass(building)
    fundamental = positive_period(1.0 if period is None else period)
    upper = positive_number(longest, "longest")
    if upper < 1.5:
        raise refusal(InvalidOption, "longest", "scaling", "at least 1.5 (ASCE/SEI 7-16, 16.2.3.1)", f"{upper:g}")
    lowest = np.inf if lowest_period is None else positive_number(lowest_period, "lowest_period")
    listed = _listed_records(records)
    pairs = [item for item in listed if _is_pair(item)]
    motions = _first_components(listed)
    suite = suite_spectra(
        motions,
        target,
        fundamental,
        damping=damping,
        period_range=(min(0.2, lowest / fundamental), upper),
        count=count,
        threads=threads,
        least=(MOTIONS_7_16, "ASCE/SEI 7-16, 16.2.2"),
    )
    if pairs:
        suite = _of_pairs(suite, listed, threads)
    individual = suite.log_factors()
    common = suite.common_factor(individual, SHARE_7_16)
    return suite.result("ASCE 7-16", individual, common, _notes(len(pairs), len(motions), lowest_period is None))


def _notes(pairs: int, motions: int, without_modes: bool) -> list[str]:
    """What a two-dimensional model cannot honour of the standard, and what is left to the user."""
    notes = []
    if pairs < motions:
        notes.append(
            f"{motions - pairs} of {motions} are single components: ASCE 7-16 scales the maximum-direction spectra of "
            "pairs, which are above those of a component as recorded, so these factors are larger than the standard's"
        )
    notes.append(
        "the target of ASCE 7-16 is MCE_R in the maximum direction, 1.5 times the design spectrum; the one given is "
        "taken as it is"
    )
    notes.append(
        "near a fault the standard keeps fault-normal and fault-parallel components apart and asks for a fitting share "
        "of motions with a velocity pulse; a model in one plane takes one component and cannot honour that"
    )
    if without_modes:
        notes.append("the range begins at 0.2 T; the period of 90 % of the mass, if it is shorter, was not given")
    return notes


def _of_pairs(suite: SuiteSpectra, pairs: list[Any], threads: int | None) -> SuiteSpectra:
    """The suite with the maximum-direction spectra and the names of pairs."""
    spectra, names = suite.spectra.copy(), list(suite.names)
    turns = np.arange(DIRECTIONS) * (180.0 / DIRECTIONS)
    for index, item in enumerate(pairs):
        if _is_pair(item):
            directions = [Motion(row, item.dt) for row in item.at_angles(turns)]
            ordinates = response_spectrum(directions, suite.periods, suite.damping, threads=threads)
            spectra[index] = ordinates.max(axis=0)
            names[index] = item.name or names[index]
    return replace(suite, spectra=frozen(spectra), names=tuple(names))


def _period_of_mass(building: Building) -> float:
    """Period (s) of the mode with which the modes together have 90 % of the mass."""
    modes = vibration_modes(building.mass, building.stiffness, stiffness_matrix=building.stiffness_matrix)
    total: FloatArray = np.cumsum(modes.effective_mass) / building.mass.sum()
    return float(modes.periods[int(np.searchsorted(total, MASS_7_16 * (1.0 - 1e-12)))])
