"""Writes docs/study.md and docs/sensitivity.md from studies of the recorded motions, and their figures.

Usage: SEISMASS_SHARED=... python tools/study_pages.py
The recordings are not part of this project: SEISMASS_SHARED names the folder that holds them.
"""

from __future__ import annotations

import os
import sys
import textwrap
from pathlib import Path
from typing import Any, Final

import polars as pl

from seismass.media.figure_file import save_figure
from seismass.records import Suite, builtin_suite, read_suite
from seismass.show.study.figures import study_figures
from seismass.show.study.findings import findings_text
from seismass.show.study.sensitivity import sensitivity_markdown
from seismass.spectra import TargetSpectrum
from seismass.study import StudyResult, motions_text, run_study, study_sensitivity
from seismass.study.findings import findings

ROOT: Final = Path(__file__).parents[1]
SUITE: Final = Path("records/paper_seven.csv")
FIGURES: Final = {
    "underestimation": "underestimation",
    "drift_R6": "study_drift_R6",
    "effective": "study_effective",
}
"""Figures of the page, and their files in docs/figures."""


def recorded(shared: Path) -> Suite:
    """The recordings of the paper that are at hand."""
    return read_suite(shared / SUITE)


def study_of(shared: Path) -> StudyResult:
    """The study of the pages, with its effective fractions."""
    return run_study(recorded(shared), TargetSpectrum.asce7(), effective=True)


def placed(summary: pl.DataFrame) -> pl.DataFrame:
    """The summary with the place of each storey (first, middle, top) and, in %, what is missed, by mass, by sliding."""
    first, top = pl.col("storey") == 1, pl.col("storey") == pl.col("storeys")
    return summary.with_columns(
        place=pl.when(first).then(pl.lit("first")).when(top).then(pl.lit("top")).otherwise(pl.lit("middle")),
        missed=pl.col("underestimation_percent"),
        mass=100.0 * (pl.col("ratio_mass") - 1.0),
        sliding=100.0 * (pl.col("ratio_sliding") - 1.0),
    )


def template(name: str) -> str:
    """The words of a page, with names in place of numbers."""
    return (ROOT / "tools" / "pages" / name).read_text(encoding="utf-8")


def study_page(result: StudyResult) -> str:
    """The page of what the study says."""
    rows = placed(result.summary)
    yielding, elastic = rows.filter(pl.col("R") > 1.0), rows.filter(R=1.0)
    entries = findings(result.summary, result.fractions, result.metadata["code"]["name"])
    values: dict[str, Any] = {"findings": findings_text(entries)}
    for place in ("first", "middle", "top"):
        values |= _of_place(place, yielding.filter(place=place))
    lower = yielding.filter(pl.col("place") != "top")
    for entry in entries:
        values |= _scatter(entry["occupancy"], entry["largest"])
        heavy = rows.filter(place="first", R=6.0, alpha=1.5, occupancy=entry["occupancy"])
        values[f"heavy_{entry['occupancy']}"] = f"{heavy['missed'].mean():+.0f}"
        if entry["occupancy"] == "storage":
            values["heavy_mass"] = f"{heavy['mass'].mean():.0f}"
            values["heavy_sliding"] = f"{heavy['sliding'].mean():+.1f}"
    values["sliding_most"] = f"{lower['sliding'].max():.1f}"
    values["sliding_least"] = f"{-lower['sliding'].min():.0f}"
    values |= _fractions(result.fractions) | _elastic(elastic)
    return reflowed(template("study.md").format_map(values))


def _of_place(place: str, rows: pl.DataFrame) -> dict[str, Any]:
    means = rows.group_by("occupancy", "R").agg(pl.col("missed").mean()).sort("missed").rows()
    least, most = (
        f"{name} buildings at R = {factor:g} ({missed:+.0f} %)" for name, factor, missed in means[:: len(means) - 1]
    )
    found = {
        f"{place}_count": rows.height,
        f"{place}_missed": int((rows["missed"] > 0.0).sum()),
        f"{place}_sliding_count": int((rows["sliding"] > 5.0).sum()),
        f"{place}_sliding_most": f"{rows['sliding'].max():.0f}",
    }
    sizes = rows["missed"].abs()
    if place == "middle":
        return found | {"middle_least": least, "middle_most": most}
    return found | {f"{place}_least": f"{sizes.min():.0f}", f"{place}_most": f"{sizes.max():.0f}"}


def _scatter(name: str, row: dict[str, Any]) -> dict[str, Any]:
    """The largest underestimation of an occupancy over the motions."""
    of = {"largest": "underestimation", "without": "leave_one_out"}
    of |= {share: f"{share}_underestimation" for share in ("median", "p16", "p84")}
    found = {f"{name}_{key}": f"{row[f'{column}_percent']:+.0f}" for key, column in of.items()}
    return found | {f"{name}_record": row["leave_one_out_record"]}


def _fractions(table: pl.DataFrame) -> dict[str, Any]:
    elastic, yielding = table.filter(R=1.0), table.filter(pl.col("R") > 1.0)
    between = yielding.filter(pl.col("eta").is_between(0.6, 0.9))
    found: dict[str, Any] = {"between_count": between.height}
    found |= {f"between_{name}": f"{between[name].mean():.2f}" for name in ("effective", "estimate", "conservative")}
    ranges = {
        "effective": yielding["effective"],
        "estimate": yielding["estimate"],
        "c1": yielding["base_shear_coefficient"],
        "elastic_eta": elastic["eta"],
    }
    for name, column in ranges.items():
        found |= {f"{name}_least": f"{column.min():.2f}", f"{name}_most": f"{column.max():.2f}"}
    return found


def _elastic(rows: pl.DataFrame) -> dict[str, Any]:
    means = rows.group_by("occupancy", "place").agg(pl.col("missed").mean().abs())
    less = -rows.filter(place="first")["sliding"]
    return {
        "elastic_least": f"{rows['missed'].min():+.0f}",
        "elastic_most": f"{rows['missed'].max():+.0f}",
        "elastic_bound": int(means["missed"].max()) + 1,
        "elastic_sliding_least": f"{less.min():.0f}",
        "elastic_sliding_most": f"{less.max():.0f}",
    }


def sensitivity_part(suite: Suite, as_is: StudyResult | None = None) -> str:
    """What the study's choices do under one suite."""
    found = study_sensitivity(suite, TargetSpectrum.asce7(), as_is=as_is)
    return f"{motions_text(found.metadata['suite'])} ({suite.name}).\n\n{sensitivity_markdown(found.table)}"


def sensitivity_page(of_recorded: str, of_builtin: str) -> str:
    """The page of what the study's choices do, from the parts of both suites."""
    return reflowed(template("sensitivity.md").format(recorded=of_recorded, builtin=of_builtin))


def reflowed(text: str) -> str:
    """A page with paragraphs of equal lines; headings, figures, tables and code stay."""
    kept = ("#", "!", "|", "```")
    parts = [
        part if part.startswith(kept) else textwrap.fill(part, 118, break_on_hyphens=False, break_long_words=False)
        for part in text.strip().split("\n\n")
    ]
    return "\n\n".join(parts) + "\n"


def write_figures(result: StudyResult) -> None:
    """Write the figures of the page of the study."""
    figures = study_figures(result)
    for name, file in FIGURES.items():
        save_figure(figures[name], "png", ROOT / "docs" / "figures" / f"{file}.png")


def main() -> int:
    """Writes pages and figures; 0 if the recordings were there."""
    shared = os.environ.get("SEISMASS_SHARED")
    if not shared:
        print("SEISMASS_SHARED is not set: it names the folder with the recordings", file=sys.stderr)
        return 2
    result = study_of(Path(shared))
    (ROOT / "docs" / "study.md").write_text(study_page(result), encoding="utf-8")
    parts = sensitivity_part(recorded(Path(shared)), result), sensitivity_part(builtin_suite("seven"))
    (ROOT / "docs" / "sensitivity.md").write_text(sensitivity_page(*parts), encoding="utf-8")
    write_figures(result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
