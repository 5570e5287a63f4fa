"""Amplitude scaling of ASCE/SEI 7: that of 7-10, and that of 7-16 and 7-22."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_flag, brief, frozen, refusal
from seismass.design.modes import Modes, vibration_modes
from seismass.design.rules import CodeRule, rule_of
from seismass.model.building import Building
from seismass.motions.motion import Motion
from seismass.motions.records.pair import Pair
from seismass.motions.scaling.suite import (
    ScalingResult,
    SuiteSpectra,
    as_target,
    positive_number,
    positive_period,
    suite_spectra,
)
from seismass.motions.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum
from seismass.motions.spectra.elastic import check_not_zero

MASS_7_16: Final = 0.9
"""Share of the mass that the modes down to the lower end of the range take part with, 16.2.3.1."""
REFINED: Final = 10
"""Periods between two at which motions are compared, at which the mean is held above the target."""
LOWEST: Final = 5
"""Periods around which it is looked at once more, as closely again."""
DIRECTIONS: Final = 180
"""Directions over half a turn in which the spectrum of a pair is taken."""
APART: Final = 10
"""Of these directions every so many are solved for every period, those between where they may have the largest."""


def scale_asce7_10(
    records: Iterable[GroundMotion | Pair],
    target: TargetSpectrum | str,
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
        The suite; at least three motions, as the standard asks. The spectrum of a pair is the root of the sum of the
        squares of those of its components; the factor is that of both.
    target : TargetSpectrum or str
        Design spectrum, or what `--target` reads, as "asce7:1:0.6".
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
    ASCE/SEI 7-10, 16.1.3.1 and for pairs 16.1.3.2: the mean of the 5 % damped spectra, of pairs their SRSS, is not less
    than the design spectrum from 0.2 T to 1.5 T. The standard leaves the factors open; these are the two-step ones of
    Reyes and Kalkan (2012), Earthquake Spectra 28:1205, in the logarithm: ln SF1_i = mean over T_j of ln A_t - ln A_i,
    then SF2 = max over T_j of A_t over the mean of SF1_i A_i.
    """
    listed = given_motions(records)
    options: dict[str, Any] = {"period_range": period_range, "damping": damping, "count": count, "threads": threads}
    refined = as_flag(between, "between", "scaling", InvalidOption)
    of_code = rule_of("asce7-10", "least motions")
    target = as_target(target)
    return scaled_suite(listed, target, period, "ASCE 7-10", "srss", 1.0, least=of_code, between=refined, **options)


def scaled_suite(
    items: list[Any],
    target: TargetSpectrum,
    period: float,
    method: str,
    pairs: str,
    share: float,
    *,
    least: CodeRule | None,
    between: bool,
    least_common: Callable[[SuiteSpectra, FloatArray], float] | None = None,
    notes: Iterable[str] = (),
    **options: Any,
) -> ScalingResult:
    """Return the factors of least squares in the logarithm times the common one by which the mean spectrum, of pairs
    their `pairs` spectrum, is nowhere below a share of the target; `least_common` may ask for a larger one.
    """
    wanted = (1, "") if least is None else (int(least.number), f"{least.code}, {least.clause}")
    suite = suite_spectra(first_components(items), target, period, least=wanted, **options)
    if any(map(is_pair, items)):
        names = tuple(item.name or name for item, name in zip(items, suite.names, strict=True))
        spectra = spectra_of(items, suite.periods, suite.damping, pairs, threads=options["threads"])
        suite = replace(suite, spectra=frozen(spectra), names=names)
    individual = suite.log_factors()
    common = suite.common_factor(individual, share)
    if between:
        common = max(common, share / _least_between(suite, items, target, individual, pairs, options["threads"]))
    if least_common is not None:
        common = max(common, least_common(suite, individual))
    return suite.result(method, individual, common, notes)


def given_motions(records: Any) -> list[Any]:
    """Return motions and pairs as a list."""
    several = isinstance(records, Iterable) and getattr(records, "shape", (0,)) != ()
    return list(records) if several and not hasattr(records, "acceleration") else as_motions(records, "scaling")


def is_pair(item: Any) -> bool:
    """Whether it is a pair of components."""
    return hasattr(item, "at_angles")


def first_components(items: list[Any]) -> list[Any]:
    """Return motions, and the first component of each pair."""
    return [item.first if is_pair(item) else item for item in items]


PAIRS: Final[dict[str, Callable[[FloatArray, FloatArray], FloatArray]]] = {
    "srss": np.hypot,
    "geometric mean": lambda first, second: np.sqrt(first * second),
    "mean": lambda first, second: 0.5 * (first + second),
}
"""Spectrum of a pair of those of its components, by name; "maximum direction" is the largest over all directions."""


def spectra_of(
    records: list[Any], periods: FloatArray, damping: float = 0.05, pairs: str = "srss", *, threads: int | None = None
) -> FloatArray:
    """Return spectra of motions (m/s2, motions x periods); `pairs` names what stands for a pair."""
    first: FloatArray = response_spectrum(first_components(records), periods, damping, threads=threads)
    there = np.array([is_pair(item) for item in records])
    if not there.any():
        return first
    spectra = first.copy()
    if pairs == "maximum direction":
        for index in np.flatnonzero(there):
            spectra[index] = _largest_of_directions(records[index], periods, damping, threads)
        return spectra
    second = response_spectrum([records[i].second for i in np.flatnonzero(there)], periods, damping, threads=threads)
    check_not_zero(second)
    spectra[there] = PAIRS[pairs](first[there], second)
    return spectra


def _largest_of_directions(pair: Any, periods: FloatArray, damping: float, threads: int | None) -> FloatArray:
    """Largest ordinate of a pair over all directions. Peaks over directions are a support function: between two of them
    they are below the sinusoid through both, and where that is below the largest one nothing is solved.
    """
    step = 180.0 / DIRECTIONS

    def ordinates(turns: Any, at_periods: FloatArray) -> FloatArray:
        rows = [Motion(row, pair.dt) for row in pair.at_angles(np.asarray(turns) * step)]
        solved: FloatArray = response_spectrum(rows, at_periods, damping, threads=threads)
        return solved

    coarse = np.arange(0, DIRECTIONS, APART)
    known = ordinates(coarse, periods)
    largest: FloatArray = known.max(axis=0)
    next_to, apart = np.roll(known, -1, axis=0), np.radians(APART * step)
    bounds = np.sqrt(known**2 + next_to**2 - 2.0 * known * next_to * np.cos(apart)) / np.sin(apart)
    for first, bound in zip(coarse, bounds, strict=True):
        open_ = np.flatnonzero(bound > largest)
        if len(open_):
            between = ordinates(np.arange(first + 1, first + APART), periods[open_])
            largest[open_] = np.maximum(largest[open_], between.max(axis=0))
    return largest


def _least_between(
    suite: SuiteSpectra,
    records: list[Any],
    target: TargetSpectrum,
    individual: FloatArray,
    pairs: str,
    threads: int | None,
) -> float:
    """Return the least ratio of the mean to the target over the range, of motions times their own factors."""

    def over(periods: FloatArray) -> FloatArray:
        ratios: FloatArray = np.mean(
            individual[:, None] * spectra_of(records, periods, suite.damping, pairs, threads=threads), axis=0
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
    target: TargetSpectrum | str,
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
    target : TargetSpectrum or str
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
        modes = vibration_modes(building.mass, building.stiffness, stiffness_matrix=building.stiffness_matrix)
        period, lowest_period = float(building.periods[0]), period_of_mass(modes)
    fundamental = positive_period(1.0 if period is None else period)
    upper = positive_number(longest, "longest")
    if upper < 1.5:
        raise refusal(InvalidOption, "longest", "scaling", "at least 1.5 (ASCE/SEI 7-16, 16.2.3.1)", f"{upper:g}")
    target = as_target(target)
    lowest = np.inf if lowest_period is None else positive_number(lowest_period, "lowest_period")
    listed = given_motions(records)
    number = sum(map(is_pair, listed))
    options: dict[str, Any] = {"damping": damping, "count": count, "threads": threads}
    within = (min(0.2, lowest / fundamental), upper)
    of_code, share = (rule_of("asce7-16", name) for name in ("least motions", "share of target"))
    assert share is not None
    return scaled_suite(
        listed,
        target,
        fundamental,
        "ASCE 7-16",
        "maximum direction",
        share.number,
        least=of_code,
        between=False,
        notes=notes_7_16(number, len(listed), lowest_period is None, target),
        period_range=within,
        **options,
    )


def notes_7_16(pairs: int, motions: int, without_modes: bool, target: TargetSpectrum) -> list[str]:
    """Return what a two-dimensional model cannot honour of the standard, and what is left to the user."""
    notes = []
    if pairs < motions:
        notes.append(
            f"{motions - pairs} of {motions} are single components: ASCE 7-16 scales the maximum-direction spectra of "
            "pairs, which are above those of a component as recorded, so these factors are larger than the standard's"
        )
    if target.factor == 1.0:
        notes.append(
            "the target of ASCE 7-16 is MCE_R in the maximum direction, 1.5 times the design spectrum; the one given "
            "is taken as it is"
        )
    notes.append(
        "near a fault the standard keeps fault-normal and fault-parallel components apart and asks for a fitting share "
        "of motions with a velocity pulse; a model in one plane takes one component and cannot honour that"
    )
    if without_modes:
        notes.append("the range begins at 0.2 T; the period of 90 % of the mass, if it is shorter, was not given")
    return notes


def period_of_mass(modes: Modes) -> float:
    """Return the period (s) of the mode with which the modes together have 90 % of the mass."""
    return float(modes.periods[modes.modes_needed(MASS_7_16) - 1])
