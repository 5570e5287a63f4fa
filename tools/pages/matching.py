"""Matching of the seven records, of the far-field components, and for other ranges and dampings.

The table of another program is written by benchmarks/matching.py and kept as it is.
"""

from __future__ import annotations

from typing import Final

import numpy as np

import seismass as sm
from pages.parts import Page, table

TARGETS: Final = (
    sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3),
    sm.TargetSpectrum.nzs1170("D", z=0.4),
)
OTHERS: Final = (
    ("0.05 to 5 s", {"periods": (0.05, 5.0)}),
    ("0.1 to 3 s", {"periods": (0.1, 3.0)}),
    ("0.3 to 1 s", {"periods": (0.3, 1.0)}),
    ("0.2 to 1.5 s, 2 % damping", {"damping": 0.02}),
    ("0.2 to 1.5 s, 10 % damping", {"damping": 0.10}),
    ("0.2 to 1.5 s, within 1 %", {"tolerance": 0.01}),
)


def fill(page: Page) -> None:
    """Put in the tables that are asked for."""
    suite, target = sm.read_suite(page.records / "paper_seven.csv"), sm.TargetSpectrum.asce7()
    if page.wants("seven"):
        matched = sm.matching.match_suite(suite, target)
        page.marked("seven", seven(matched))
        page.figure("matched", matched[1].plot)
    if page.wants("far_field"):
        page.marked("far_field", far_field(sm.read_suite(page.records / "fema_p695_far_field")))
    if page.wants("targets"):
        page.marked("targets", each(suite, [sm.matching.match_suite(suite, target) for target in TARGETS]))
    if page.wants("other"):
        page.marked("other", other([suite[1], suite[6]]))  # steps of 0.005 s and 0.02 s


def misfit_row(matched: sm.matching.MatchedRecord) -> tuple[str, ...]:
    """Return the row of a record in the table of misfits."""
    before, after = matched.misfit_before, matched.misfit
    return (
        matched.record.station,
        f"{matched.factor:.3f}",
        f"{100.0 * before.largest:.0f}",
        f"{100.0 * before.rms:.0f}",
        f"{100.0 * after.largest:.1f}",
        f"{100.0 * after.rms:.1f}",
        str(matched.iterations),
        f"{100.0 * (matched.outside['shorter'] - 1.0):+.0f}",
        f"{100.0 * (matched.outside['longer'] - 1.0):+.0f}",
    )


def motion_row(matched: sm.matching.MatchedRecord) -> tuple[str, ...]:
    """Return the row of a record in the table of what else changed."""
    before, after = matched.original, matched.record
    return (
        after.station,
        f"{before.pga_g:.3f} to {after.pga_g:.3f}",
        f"{before.pgv:.3f} to {after.pgv:.3f}",
        f"{before.pgd:.3f} to {after.pgd:.3f}",
        f"{before.arias:.2f} to {after.arias:.2f}",
        f"{before.d5_95:.1f} to {after.d5_95:.1f}",
        f"{100.0 * matched.husid_difference:.0f}",
        power(abs(after.velocity[-1] - before.velocity[-1])),
        power(abs(after.displacement[-1] - before.displacement[-1])),
    )


def power(value: float) -> str:
    """Return a difference that is rounding as the power of ten that it is below."""
    return f"< 1e{int(np.ceil(np.log10(value)))}" if value > 1e-12 else "< 1e-12"


def seven(matched: sm.matching.MatchedSuite) -> str:
    """Return both tables of the seven records."""
    misfits = "largest before (%) | rms before (%) | largest (%) | rms (%) | passes"
    misfits = f"record | factor | {misfits} | shorter periods (%) | longer periods (%)"
    motions = "record | PGA (g) | PGV (m/s) | PGD (m) | Arias (m/s) | D5-95 (s) | build-up apart (%)"
    motions = f"{motions} | end velocity apart (m/s) | end displacement apart (m)"
    tables = table(misfits, map(misfit_row, matched), 1), table(motions, map(motion_row, matched), 1)
    return "\n\n".join(tables)


def each(suite: sm.Suite, results: list[sm.matching.MatchedSuite]) -> str:
    """Return the table of each record towards each target, and how many are within the tolerance."""
    rows = []
    for number, record in enumerate(suite):
        cells = []
        for one in (result[number] for result in results):
            state = "" if one.converged else ", **missed**"
            cells.append(f"{100.0 * one.misfit.largest:.1f}, {100.0 * one.misfit.rms:.1f}, {one.iterations}{state}")
        rows.append((record.name, *cells))
    every = [one for result in results for one in result]
    missed = sum(not one.converged for one in every)
    header = ["largest (%), rms (%), passes", *(result[0].target for result in results)]
    return f"{table(header, rows, 1)}\n\n{len(every) - missed} of {len(every)} are within 3 %."


def far_field(suite: sm.Suite) -> str:
    """Return the tables of the far-field components: each of them, and the distribution over them."""
    matched = sm.matching.match_suite(suite, sm.TargetSpectrum.asce7())
    rows = []
    for name, values in (
        ("largest misfit before (%)", [100.0 * one.misfit_before.largest for one in matched]),
        ("largest misfit (%)", [100.0 * one.misfit.largest for one in matched]),
        ("rms misfit (%)", [100.0 * one.misfit.rms for one in matched]),
        ("passes", [float(one.iterations) for one in matched]),
        ("PGA over that before", [one.record.pga / one.original.pga for one in matched]),
        ("PGV over that before", [one.record.pgv / one.original.pgv for one in matched]),
        ("PGD over that before", [one.record.pgd / one.original.pgd for one in matched]),
        ("Arias intensity over that before", [one.record.arias / one.original.arias for one in matched]),
        ("build-up apart (%)", [100.0 * one.husid_difference for one in matched]),
    ):
        rows.append((name, *(f"{value:.2f}" for value in np.quantile(values, (0.0, 0.16, 0.5, 0.84, 1.0)))))
    ends = max(abs(one.record.displacement[-1] - one.original.displacement[-1]) for one in matched)
    return (
        f"{each(suite, [matched])}\n\n"
        f"{table('quantity | least | 16 % | median | 84 % | largest', rows, 1)}\n\n"
        f"Displacements at the end differ from those before by {power(ends)} m."
    )


def other(chosen: list[sm.Record]) -> str:
    """Return the table of other ranges, dampings and tolerances."""
    rows = []
    for name, options in OTHERS:
        cells = []
        for record in chosen:
            if options.get("periods", (0.2, 1.5))[0] < 4.0 * record.dt:
                cells.append("refused: below four steps")
                continue
            one = sm.matching.match_spectrum(record, sm.TargetSpectrum.asce7(), **options)
            state = "" if one.converged else ", not converged"
            cells.append(f"{100.0 * one.misfit.largest:.1f}, {100.0 * one.misfit.rms:.1f}, {one.iterations}{state}")
        rows.append((name, *cells))
    return table(["largest (%), rms (%), passes", *(record.station for record in chosen)], rows, 1)
