"""Writes docs/scaling.md: factors of recordings by each method side by side, their misfit and scatter, and its figure.

Usage: tools/scaling_page.py SHARED, a folder with `records`; some ten seconds. The words are in tools/pages/scaling.md.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

import numpy as np

import seismass as sm
from seismass.media.figure_file import save_figure
from seismass.scaling.oscillator import deformation_ratio
from seismass.scaling.pushover import PushoverScaling
from seismass.spectra.oscillators import Oscillators

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "scaling.md"
FIGURE: Final = ROOT / "docs" / "figures" / "scaling.png"
REDUCTION: Final = 4.0
TARGET: Final = sm.TargetSpectrum.asce7()
METHODS: Final = (
    "ASCE 7-10",
    "least squares, log",
    "least squares, linear",
    "Sa(T1)",
    "pushover, C_R",
    "pushover, median",
)


def by_method(suite: sm.Suite) -> dict[str, sm.scaling.ScalingResult]:
    """Results of the methods that take any number of records."""
    results: tuple[sm.scaling.ScalingResult, ...] = (
        sm.scaling.scale_asce7_10(suite, TARGET),
        sm.scaling.scale_least_squares(suite, TARGET),
        sm.scaling.scale_least_squares(suite, TARGET, space="linear"),
        sm.scaling.scale_sa_t1(suite, TARGET),
        sm.scaling.scale_modal_pushover(suite, TARGET, reduction=REDUCTION),
        sm.scaling.scale_modal_pushover(suite, TARGET, reduction=REDUCTION, deformation="median"),
    )
    return dict(zip(METHODS, results, strict=True))


def markdown(header: list[str], rows: list[list[str]]) -> str:
    """A table of text."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def factors_table(suite: sm.Suite, results: dict[str, sm.scaling.ScalingResult]) -> str:
    """Factors of each record by each method."""
    rows = [
        [str(number + 1), record.name, *(f"{result.factors[number]:.3f}" for result in results.values())]
        for number, record in enumerate(suite)
    ]
    return markdown(["", "record", *results], rows)


def deformations(suite: sm.Suite, pushover: PushoverScaling, factors: np.ndarray) -> np.ndarray:
    """Peak deformation of the pushover's oscillator under scaled records (m)."""
    assert pushover.oscillator is not None
    runner = Oscillators([pushover.oscillator.building], list(suite), float(factors.max()), None)
    return runner.peaks(np.zeros(len(suite), dtype=np.int64), np.arange(len(suite)), factors)


def quality_table(suite: sm.Suite, results: dict[str, sm.scaling.ScalingResult]) -> str:
    """What each method makes of the suite."""
    pushover = results["pushover, C_R"]
    assert isinstance(pushover, PushoverScaling)
    rows = []
    for name, result in results.items():
        at = int(np.argmin(np.abs(np.log(result.periods / result.period))))
        peaks = deformations(suite, pushover, result.factors) / pushover.target_deformation
        rows.append(
            [
                name,
                f"{result.least_ratio:.3f}",
                f"{result.largest_ratio:.3f}",
                f"{result.misfit.mean():.3f}",
                f"{result.log_scatter.mean():.3f}",
                f"{result.log_scatter[at]:.3f}",
                f"{peaks.mean():.3f}",
                f"{np.log(peaks).std(ddof=1):.3f}",
            ]
        )
    header = ["method", "least", "largest", "misfit", "scatter", "at T", "deformation", "its scatter"]
    return markdown(header, rows)


def remarks(results: dict[str, sm.scaling.ScalingResult]) -> str:
    """Remarks of each method, those of several methods once."""
    found = dict.fromkeys(f"- {name}: {remark}." for name, result in results.items() for remark in result.remarks)
    return "Remarks that `seismass scale` prints:\n\n" + "\n".join(found)


def selected_table(folder: sm.Suite) -> str:
    """The selection of eleven, with the factors of ASCE 7-16."""
    chosen = sm.scaling.select_records(folder, TARGET, 11, period_range=(0.2, 2.0))
    scaling = sm.scaling.scale_asce7_16(chosen.suite, TARGET)
    steps = chosen.table.drop_nulls("step").sort("number")
    rows = [
        [
            str(row["step"]),
            row["record"],
            row["event"],
            f"{row['misfit']:.3f}",
            f"{row['mean_misfit']:.3f}",
            f"{sf:.3f}",
        ]
        for row, sf in zip(steps.iter_rows(named=True), scaling.factors, strict=True)
    ]
    header = ["step", "record", "event", "misfit", "misfit of the mean", "factor, ASCE 7-16"]
    says = (
        f"Mean over target from {scaling.periods[0]:g} to {scaling.periods[-1]:g} s: {scaling.least_ratio:.3f} to "
        f"{scaling.largest_ratio:.3f}; scatter {scaling.log_scatter.mean():.3f}. The misfit of the mean is that of its "
        "shape, after the choice of that step."
    )
    return f"{markdown(header, rows)}\n\n{says}"


def ambiguous_table(folder: sm.Suite) -> str:
    """Records with several factors, by period and R."""
    rows = []
    for period in (1.0, 2.0):
        for reduction in (2.0, 4.0, 6.0):
            result = sm.scaling.scale_modal_pushover(folder, TARGET, period=period, reduction=reduction)
            several = [number for number, roots in enumerate(result.roots) if len(roots) > 1]
            listed = [
                f"{result.names[number]}: {', '.join(f'{root:.3f}' for root in result.roots[number])}"
                for number in several[:2]
            ]
            rows.append([f"{period:g}", f"{reduction:g}", str(len(several)), "; ".join(listed)])
    return markdown(["T (s)", "R", "components with several", "the first of them"], rows)


def ratios_table(folder: sm.Suite) -> str:
    """Computed C_R beside the formula, elastoplastic."""
    periods, reductions = (0.2, 0.5, 1.0, 2.0), (1.5, 2.0, 4.0, 6.0)
    corner = TARGET.corner_period()
    rows = []
    for period in periods:
        elastic = sm.spectra.inelastic_spectrum(folder, [period], ductility=1.0, overstrength=1.0, second_slope=0.0)
        building = sm.Building.uniform(1, period, yield_shear_over_weight=1.0, overstrength=1.0, second_slope=0.0)
        strengths = elastic.elastic_strength[:, 0]
        runner = Oscillators([building], list(folder), float(max(reductions) / strengths.min()), None)
        cells = []
        for reduction in reductions:
            factor = reduction / strengths
            peaks = runner.peaks(np.zeros(len(folder), dtype=np.int64), np.arange(len(folder)), factor) / factor
            ratio = peaks / elastic.displacement[:, 0]
            formula = deformation_ratio(reduction, period / corner, 0.0)
            cells.append(f"{np.median(ratio):.2f} ± {np.log(ratio).std(ddof=1):.2f} ({formula:.2f})")
        rows.append([f"{period:g}", *cells])
    return markdown(["T (s)", *(f"R = {reduction:g} (C_R)" for reduction in reductions)], rows)


def ductility_table(suite: sm.Suite) -> str:
    """Strength for a ductility of 4."""
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
    return markdown(["T (s)", "C_e", "C_y, ductility 4", "scatter of ln C_y", "R"], rows)


def page(shared: Path) -> str:
    """The page."""
    seven = sm.read_suite(shared / "records" / "paper_seven.csv")
    far_field = sm.read_suite(shared / "records" / "fema_p695_far_field")
    results = by_method(seven)
    words = (ROOT / "tools" / "pages" / "scaling.md").read_text(encoding="utf-8")
    return words.format(
        target=TARGET.label,
        factors=factors_table(seven, results),
        quality=quality_table(seven, results),
        remarks=remarks(results),
        overshoot=f"{results['ASCE 7-10'].largest_ratio:.2f}",
        selected=selected_table(far_field),
        ambiguous=ambiguous_table(far_field),
        corner=f"{TARGET.corner_period():.2f}",
        ratios=ratios_table(far_field),
        ductility=ductility_table(seven),
    )


def write(shared: Path) -> None:
    """Write page and figure."""
    PAGE.write_text(page(shared), encoding="utf-8")
    seven = sm.read_suite(shared / "records" / "paper_seven.csv")
    save_figure(sm.scaling.scale_asce7_10(seven, TARGET).plot(records=seven, target=TARGET), "png", FIGURE)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write(Path(sys.argv[1]))
