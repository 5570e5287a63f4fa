"""Amplitude scaling by the rule of a code, one name each: ASCE 7, Eurocode 8, NZS 1170.5, TBDY 2018, BNBC 2017."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any, Final

import numpy as np

from seismass.base.arguments import known_id
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, as_flag, as_positive, counted, refusal
from seismass.design.code_design import structural_performance
from seismass.design.rules import RULES, CodeRule, rule_of
from seismass.design.scaling.asce7 import first_components, given_motions, is_pair, notes_7_16, scaled_suite
from seismass.motions.records.pair import Pair
from seismass.motions.scaling.suite import ScalingResult, SuiteSpectra, as_target, positive_period, suite_spectra
from seismass.motions.spectra import GroundMotion, TargetSpectrum

GEOMETRIC_MEAN: Final = "geometric-mean"
"""Name of the rule of ASCE 7-10 with the geometric mean of a pair in place of its SRSS."""
SCALING_CODES: Final = (*dict.fromkeys(rule.code_id for rule in RULES if rule.rule == "range"), GEOMETRIC_MEAN)
"""Rules of scaling, by their codes."""
METHODS: Final = {
    "asce7-10": "ASCE 7-10",
    "asce7-16": "ASCE 7-16",
    "asce7-22": "ASCE 7-22",
    "ec8": "Eurocode 8",
    "nzs1170.5": "NZS 1170.5",
    "tbdy2018": "TBDY 2018",
    "bnbc2017": "BNBC 2017",
    GEOMETRIC_MEAN: "ASCE 7-10 with geometric means",
}
"""What the rules are called."""
DUCTILE: Final = 2.0
"""Ductility mu of NZS 1170.5 where none is stated: S_p is 0.7 from it on."""
MOST_MISFIT: Final = 1.5
"""Factor of misfit up to which NZS 1170.5 takes a record: D_1 below ln 1.5 (5.5.2, from memory)."""
MEAN_FROM: Final = 7
"""Motions from which a mean counts in Eurocode 8, 4.3.3.4.3(3), and BNBC 2017, 2.5.11; below, the largest value."""


def scale_by_code(
    records: Iterable[GroundMotion | Pair],
    target: TargetSpectrum | str,
    period: float = 1.0,
    *,
    code_id: str = "asce7-10",
    shortest_period: float | None = None,
    lowest_period: float | None = None,
    ductility: float | None = None,
    damping: float = 0.05,
    count: int = 100,
    between: bool = True,
    threads: int | None = None,
) -> ScalingResult:
    """Return the factors of a suite by the rule of a code.

    Parameters
    ----------
    records : iterable of Record or Motion, or of Pair
        The suite; at least as many motions as the code asks for.
    target : TargetSpectrum or str
        Spectrum of the level that the code scales to: that of design, or MCE_R in ASCE 7-16 and 7-22.
    period : float, default 1.0
        Fundamental period T (s).
    code_id : str, default "asce7-10"
        One of `SCALING_CODES`, in any case.
    shortest_period : float, optional
        First period (s) of the stiffer direction, with which the range begins; by default T.
    lowest_period : float, optional
        Period (s) of 90 % of the mass, with which the range of ASCE 7-16 and 7-22 begins where it is shorter.
    ductility : float, optional
        mu of NZS 1170.5, on which S_p depends; by default S_p = 0.7.
    damping, count, between, threads
        As for `scale_asce7_10`.

    Raises
    ------
    InvalidOption
        An argument is out of its range, or the range of periods leaves that of the target.
    InvalidMotion
        Fewer motions than the code asks for, one without any acceleration, or single motions among pairs where the code
        has a rule of its own for pairs.

    Notes
    -----
    `rules_table` has range, share, number and the spectrum of a pair with their clauses. But for NZS 1170.5 the mean
    spectrum is not below the share of the target over the range; individual factors are those of `scale_asce7_10`,
    which codes leave open. NZS 1170.5, 5.5.2: k_1 of each record by least squares of the logarithm over the period, of
    a pair the smaller one of its components; k_2, at least 1, by which at each period one record at least reaches
    (1 + S_p)/2 of the site spectrum.
    """
    code = known_id(code_id, SCALING_CODES, "scaling")
    base = "asce7-10" if code == GEOMETRIC_MEAN else code
    items, refined = given_motions(records), as_flag(between, "between", "scaling", InvalidOption)
    target = as_target(target)
    fundamental = positive_period(period)
    shortest = fundamental if shortest_period is None else positive_period(shortest_period)
    options: dict[str, Any] = {"damping": damping, "count": count, "threads": threads}
    if code == "nzs1170.5":
        return _nzs(items, target, fundamental, min(shortest, fundamental), ductility, options)
    low, high = _rule(base, "range").numbers
    lowest = low * shortest / fundamental
    if lowest_period is not None and _rule(base, "pairs").value == "maximum direction":
        lowest = min(lowest, positive_period(lowest_period) / fundamental)
    share, pairs = _rule(base, "share of target", "").number, sum(map(is_pair, items))
    of_pairs = rule_of(base, "share of target", "pairs")
    if of_pairs is not None and pairs:
        if pairs < len(items):
            got = f"{pairs} of {len(items)}"
            raise refusal(InvalidMotion, "records", "scaling", f"pairs, all or none ({of_pairs.clause})", got)
        share = of_pairs.number
    ground = rule_of(base, "zero period")
    return scaled_suite(
        items,
        target,
        fundamental,
        METHODS[code],
        "geometric mean" if code == GEOMETRIC_MEAN else _rule(base, "pairs").value,
        share,
        least=_rule(base, "least motions"),
        between=refined and _rule(base, "pairs").value != "maximum direction",
        least_common=None if ground is None else lambda suite, factors: _at_zero(items, target, factors),
        notes=_notes(base, pairs, len(items), lowest_period is None, target),
        period_range=(lowest, high),
        **options,
    )


def _rule(code: str, name: str, case: str | None = None) -> CodeRule:
    rule = rule_of(code, name, case)
    assert rule is not None
    return rule


def _notes(code: str, pairs: int, motions: int, without_modes: bool, target: TargetSpectrum) -> list[str]:
    """What a rule leaves open or cannot be honoured here."""
    if _rule(code, "pairs").value == "maximum direction":
        return notes_7_16(pairs, motions, without_modes, target)
    notes = []
    least = _rule(code, "least motions")
    if "seven" in least.note and motions < MEAN_FROM:
        notes.append(f"{counted(motions, 'motion')}: {least.note} ({least.clause}), and the largest value below")
    if rule_of(code, "zero period") is not None and target.shortest > 0.0:
        notes.append("the target has no ordinate at T = 0: mean peak accelerations are not compared with it")
    if code == "ec8" and pairs:
        notes.append(f"pairs: {_rule(code, 'pairs').note}")
    return notes


def _at_zero(items: list[Any], target: TargetSpectrum, factors: FloatArray) -> float:
    """Common factor by which the mean peak acceleration reaches the target at T = 0: Eurocode 8, 3.2.3.1.2(4)b."""
    if target.shortest > 0.0:
        return 0.0
    peaks = [
        np.mean([np.abs(each.acceleration).max() for each in ((item.first, item.second) if is_pair(item) else (item,))])
        for item in items
    ]
    return float(target(0.0)) / float(np.mean(factors * np.array(peaks)))


def _nzs(
    items: list[Any],
    target: TargetSpectrum,
    period: float,
    shortest: float,
    ductility: float | None,
    options: dict[str, Any],
) -> ScalingResult:
    """Factors k_1 k_2 of NZS 1170.5, 5.5.2."""
    mu = DUCTILE if ductility is None else as_positive(ductility, "ductility", "scaling", InvalidOption)
    s_p, least = structural_performance(mu), _rule("nzs1170.5", "least motions")
    (low, high), longest = _rule("nzs1170.5", "range").numbers, max(period, 0.4)
    level = target.times(0.5 * (1.0 + s_p))
    wanted = (int(least.number), f"{least.code}, {least.clause}")
    range_: dict[str, Any] = {"period_range": (low * max(shortest, 0.4) / longest, high), "least": wanted}
    first_spectra = suite_spectra(first_components(items), level, longest, **range_, **options)
    individual, spectra = _least_squares(first_spectra), first_spectra.spectra.copy()
    there = [index for index, item in enumerate(items) if is_pair(item)]
    if there:
        second = suite_spectra(
            [items[i].second for i in there], level, longest, period_range=range_["period_range"], **options
        )
        other = _least_squares(second)
        for index, k_1, row in zip(there, other, second.spectra, strict=True):
            if k_1 < individual[index]:
                individual[index], spectra[index] = k_1, row
    names = tuple(getattr(item, "name", "") or name for item, name in zip(items, first_spectra.names, strict=True))
    suite = replace(first_spectra, names=names, spectra=spectra)
    family = max(1.0, float(np.max(suite.target / np.max(individual[:, None] * spectra, axis=0))))
    stated = "" if ductility is not None else ", as no ductility is stated"
    notes = [f"S_p = {s_p:g}{stated}: the target is (1 + S_p)/2 = {0.5 * (1.0 + s_p):g} times the site spectrum"]
    few, many = _rule("nzs1170.5", "k1").numbers
    outside = int(np.sum((individual < few) | (individual > many)))
    if outside:
        notes.append(f"k_1 of {outside} of {len(items)} records is outside {few:g} to {many:g}")
    if family > _rule("nzs1170.5", "k2").numbers[1]:
        notes.append(f"k_2 = {family:.3g} is above {_rule('nzs1170.5', 'k2').numbers[1]:g}: choose other records")
    misfit = np.sqrt(_mean(suite.periods, np.log(individual[:, None] * spectra / suite.target) ** 2))
    poor = int(np.sum(misfit > np.log(MOST_MISFIT)))
    if poor:
        notes.append(f"D_1 of {poor} of {len(items)} records is above ln {MOST_MISFIT:g}: choose others")
    if len(items) == int(least.number):
        notes.append(least.note)
    return suite.result(METHODS["nzs1170.5"], individual, family, notes)


def _least_squares(suite: SuiteSpectra) -> FloatArray:
    """k_1 of each motion: least squares of the logarithm over the period."""
    factors: FloatArray = np.exp(_mean(suite.periods, np.log(suite.target) - np.log(suite.spectra)))
    return factors


def _mean(periods: FloatArray, values: FloatArray) -> FloatArray:
    """Mean over the periods, shape (motions,)."""
    mean: FloatArray = np.trapezoid(values, periods, axis=1) / (periods[-1] - periods[0])
    return mean
