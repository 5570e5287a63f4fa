"""Factors of recordings by each method side by side, their misfit and scatter."""

from __future__ import annotations

from typing import Final

import numpy as np

import seismass as sm
from pages.parts import Page, table
from seismass.design.scaling.oscillator import deformation_ratio
from seismass.design.scaling.pushover import PushoverScaling
from seismass.motions.spectra.inelastic import Oscillator, Oscillators

REDUCTION: Final = 4.0
TARGET: Final = sm.TargetSpectrum.asce7()


def fill(page: Page) -> None:
    """Put in the tables and what is said of them."""
    seven = sm.read_suite(page.records / "paper_seven.csv")
    far_field = sm.read_suite(page.records / "fema_p695_far_field")
    results = by_method(seven)
    chosen = sm.scaling.select_records(far_field, TARGET, 11, period_range=(0.2, 2.0))
    scaling = sm.scaling.scale_asce7_16(chosen.suite, TARGET)
    page.tables(
        factors_table(seven, results),
        quality_table(seven, results),
        selected_table(chosen, scaling),
        ambiguous_table(far_field),
        ratios_table(far_field),
        ductility_table(seven),
    )
    found = (f"- {name}: {remark}." for name, result in results.items() for remark in result.remarks)
    page.after("Remarks that `seismass scale` prints:", "\n".join(dict.fromkeys(found)))
    page.words("towards the default target: {}. |", TARGET.label)
    page.words("conservative by construction: up to {} times", f"{results['ASCE 7-10'].largest_ratio:.2f}")
    ratios = scaling.least_ratio, scaling.largest_ratio, scaling.log_scatter.mean()
    ends = (f"{period:g}" for period in scaling.periods[[0, -1]])
    said = "Mean over target from {} to {} s: {} to {}; scatter {}. The misfit"
    page.words(said, *ends, *(f"{ratio:.3f}" for ratio in ratios))
    page.words("with T_c = {} s of the default target.", f"{TARGET.corner_period():.2f}")
    page.figure("scaling", lambda: sm.scaling.scale_asce7_10(seven, TARGET).plot(records=seven, target=TARGET))


def by_method(suite: sm.Suite) -> dict[str, sm.scaling.ScalingResult]:
    """Return results of the methods that take any number of records."""
    pushover = sm.scaling.scale_modal_pushover
    return {
        "ASCE 7-10": sm.scaling.scale_asce7_10(suite, TARGET),
        "least squares, log": sm.scaling.scale_least_squares(suite, TARGET),
        "least squares, linear": sm.scaling.scale_least_squares(suite, TARGET, space="linear"),
        "Sa(T1)": sm.scaling.scale_sa_t1(suite, TARGET),
        "pushover, C_R": pushover(suite, TARGET, reduction=REDUCTION),
        "pushover, median": pushover(suite, TARGET, reduction=REDUCTION, deformation="median"),
    }


def factors_table(suite: sm.Suite, results: dict[str, sm.scaling.ScalingResult]) -> str:
    """Return factors of each record by each method."""
    rows = [
        [number + 1, record.name, *(f"{result.factors[number]:.3f}" for result in results.values())]
        for number, record in enumerate(suite)
    ]
    return table(["", "record", *results], rows)


def deformations(suite: sm.Suite, pushover: PushoverScaling, factors: np.ndarray) -> np.ndarray:
    """Return the peak deformation of the pushover's oscillator under scaled records (m)."""
    assert pushover.oscillator is not None
    runner = Oscillators([pushover.oscillator.of_spectrum()], list(suite), float(factors.max()), None)
    return runner.peaks(np.zeros(len(suite), dtype=np.int64), np.arange(len(suite)), factors)


def quality_table(suite: sm.Suite, results: dict[str, sm.scaling.ScalingResult]) -> str:
    """Return what each method makes of the suite."""
    pushover = results["pushover, C_R"]
    assert isinstance(pushover, PushoverScaling)
    rows = []
    for name, result in results.items():
        at = int(np.argmin(np.abs(np.log(result.periods / result.period))))
        peaks = deformations(suite, pushover, result.factors) / pushover.target_deformation
        ratios, scatter = (result.least_ratio, result.largest_ratio, result.misfit.mean()), result.log_scatter
        values = (*ratios, scatter.mean(), scatter[at], peaks.mean(), np.log(peaks).std(ddof=1))
        rows.append([name, *(f"{value:.3f}" for value in values)])
    return table("method | least | largest | misfit | scatter | at T | deformation | its scatter", rows)


def selected_table(chosen: sm.scaling.Selection, scaling: sm.scaling.ScalingResult) -> str:
    """Return the selection of eleven, with the factors of ASCE 7-16."""
    steps = chosen.table.drop_nulls("step").sort("number").iter_rows(named=True)
    rows = [
        [row["step"], row["record"], row["event"], *(f"{x:.3f}" for x in (row["misfit"], row["mean_misfit"], factor))]
        for row, factor in zip(steps, scaling.factors, strict=True)
    ]
    return table("step | record | event | misfit | misfit of the mean | factor, ASCE 7-16", rows)


def ambiguous_table(folder: sm.Suite) -> str:
    """Return records with several factors, by period and R."""
    rows = []
    for period in (1.0, 2.0):
        for reduction in (2.0, 4.0, 6.0):
            result = sm.scaling.scale_modal_pushover(folder, TARGET, period=period, reduction=reduction)
            several = [number for number, roots in enumerate(result.roots) if len(roots) > 1]
            listed = [
                f"{result.names[number]}: {', '.join(f'{root:.3f}' for root in result.roots[number])}"
                for number in several[:2]
            ]
            rows.append([f"{period:g}", f"{reduction:g}", len(several), "; ".join(listed)])
    return table("T (s) | R | components with several | the first of them", rows)


def ratios_table(folder: sm.Suite) -> str:
    """Return computed C_R beside the formula, elastoplastic."""
    periods, reductions = (0.2, 0.5, 1.0, 2.0), (1.5, 2.0, 4.0, 6.0)
    corner = TARGET.corner_period()
    rows = []
    for period in periods:
        elastic = sm.spectra.inelastic_spectrum(folder, [period], ductility=1.0, overstrength=1.0, second_slope=0.0)
        oscillator = Oscillator(period, sm.STANDARD_GRAVITY, 0.05, 1.0, 0.0, 0.0)
        strengths = elastic.elastic_strength[:, 0]
        runner = Oscillators([oscillator], list(folder), float(max(reductions) / strengths.min()), None)
        cells = []
        for reduction in reductions:
            factor = reduction / strengths
            peaks = runner.peaks(np.zeros(len(folder), dtype=np.int64), np.arange(len(folder)), factor) / factor
            ratio = peaks / elastic.displacement[:, 0]
            formula = deformation_ratio(reduction, period / corner, 0.0)
            cells.append(f"{np.median(ratio):.2f} ± {np.log(ratio).std(ddof=1):.2f} ({formula:.2f})")
        rows.append([f"{period:g}", *cells])
    return table(["T (s)", *(f"R = {reduction:g} (C_R)" for reduction in reductions)], rows)


def ductility_table(suite: sm.Suite) -> str:
    """Return strengths for a ductility of 4."""
    periods = [0.2, 0.5, 1.0, 2.0]
    found = sm.spectra.inelastic_spectrum(suite, periods, ductility=4.0, overstrength=1.0, second_slope=0.0)
    rows = [
        [
            f"{period:g}",
            f"{np.median(found.elastic_strength[:, index]):.4f}",
            f"{np.median(found.strength[:, index]):.4f}",
            f"{np.log(found.strength[:, index]).std(ddof=1):.2f}",
            f"{np.median(found.reduction[:, index]):.2f}",
        ]
        for index, period in enumerate(periods)
    ]
    return table("T (s) | C_e | C_y, ductility 4 | scatter of ln C_y | R", rows)
