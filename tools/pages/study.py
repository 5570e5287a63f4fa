"""What the paper's study says under the recorded motions."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import polars as pl

from pages.parts import Page, fenced
from seismass.motions.records import read_suite
from seismass.motions.spectra import TargetSpectrum
from seismass.show.study.answer import findings_text
from seismass.show.study.figures import study_figures
from seismass.studies.study import StudyResult, run_study
from seismass.studies.study.tables import findings

FIGURES: Final = {"underestimation": "underestimation", "drift_R6": "study_drift_R6", "effective": "study_effective"}
"""Figures of a study, and their files in docs/figures."""


def study_of(records: Path) -> StudyResult:
    """Return the study of the recordings of the paper that are at hand, with its effective fractions."""
    return run_study(read_suite(records / "paper_seven.csv"), TargetSpectrum.asce7(), effective=True)


def placed(summary: pl.DataFrame) -> pl.DataFrame:
    """Return the summary with the place of each storey and, in %, what is missed, by mass, by sliding."""
    first, top = pl.col("storey") == 1, pl.col("storey") == pl.col("storeys")
    return summary.with_columns(
        place=pl.when(first).then(pl.lit("first")).when(top).then(pl.lit("top")).otherwise(pl.lit("middle")),
        missed=pl.col("underestimation_percent"),
        mass=100.0 * (pl.col("ratio_mass") - 1.0),
        sliding=100.0 * (pl.col("ratio_sliding") - 1.0),
    )


def fill(page: Page) -> StudyResult:
    """Put in the findings and what is said of them, and return the study."""
    result = study_of(page.records)
    rows = placed(result.summary)
    yielding = rows.filter(pl.col("R") > 1.0)
    entries = findings(result.summary, result.fractions, result.metadata["code"]["name"])
    page.after("![Underestimation of capped mean drift", fenced([findings_text(entries).strip()]))
    of_places(page, yielding)
    heavy = {name: rows.filter(place="first", R=6.0, alpha=1.5, occupancy=name) for name in ("storage", "commercial")}
    said = "alpha = 1.5 it is {} % on average over the storage buildings and {} % over the commercial ones."
    page.words(said, *(f"{of['missed'].mean():+.0f}" for of in heavy.values()))
    mass, sliding = (heavy["storage"][name].mean() for name in ("mass", "sliding"))
    said = "the same storage buildings drift {} % more than the code model; sliding changes the drift by {} %."
    page.words(said, f"{mass:.0f}", f"{sliding:+.1f}")
    lower = yielding.filter(pl.col("place") != "top")["sliding"]
    page.words("sliding adds at most {} % and removes up to {} %.", f"{lower.max():.1f}", f"{-lower.min():.0f}")
    of_scatter(page, {entry["occupancy"]: entry["largest"] for entry in entries})
    of_fractions(page, result.fractions)
    of_elastic(page, rows.filter(R=1.0))
    for name, file in FIGURES.items():
        page.figure(file, lambda name=name: study_figures(result)[name])
    return result


def of_places(page: Page, rows: pl.DataFrame) -> None:
    """Put in how many first, middle and top storeys of yielding buildings are missed, and by how much."""
    first, middle, top = (rows.filter(place=place) for place in ("first", "middle", "top"))
    of_first, of_top = ([f"{of['missed'].abs().min():.0f}", f"{of['missed'].abs().max():.0f}"] for of in (first, top))
    page.words("all {} drift more than in the code model, by {} % to {} %. At R = 6", first.height, *of_first)
    said = "all {} of yielding buildings drift less than in the code model, by {} % to {} %. Heavy"
    page.words(said, top.height, *of_top)
    said = "the attached model, by more than 5 % in {} of {} storeys and by up to {} %."
    page.words(said, (top["sliding"] > 5.0).sum(), top.height, f"{top['sliding'].max():.0f}")
    means = middle.group_by("occupancy", "R").agg(pl.col("missed").mean()).sort("missed").rows()
    of = (f"{name} buildings at R = {factor:g} ({missed:+.0f} %)" for name, factor, missed in (means[-1], means[0]))
    said = "of yielding buildings are underestimated too, {} of {}, on average most for {} and least for {}."
    page.words(said, (middle["missed"] > 0.0).sum(), middle.height, *of)


def of_scatter(page: Page, largest: dict[str, dict[str, Any]]) -> None:
    """Put in the largest underestimation of each occupancy over the motions."""
    keys = ("underestimation", "leave_one_out", "median_underestimation", "p16_underestimation", "p84_underestimation")
    storage, commercial = ([f"{largest[name][f'{key}_percent']:+.0f}" for key in keys] for name in largest)
    left = [largest[name]["leave_one_out_record"] for name in largest]
    page.words("value for storage buildings, {} %, is {} % without {}. Over", *storage[:2], left[0])
    page.words("median is {} %, and 16 to 84 % of the motions lie between {} % and {} %. For", *storage[2:])
    page.words("commercial buildings it is {} %, and {} % without {}. ##", *commercial[:2], left[1])


def of_fractions(page: Page, table: pl.DataFrame) -> None:
    """Put in the effective fractions beside the rule."""
    yielding = table.filter(pl.col("R") > 1.0)
    between = yielding.filter(pl.col("eta").is_between(0.6, 0.9))
    page.words("well below 0.4, and here it is {} to {}.", *ends(yielding["base_shear_coefficient"]))
    page.words("In yielding buildings it lies between {} and {}, compared", *ends(yielding["effective"]))
    page.words("rule by hand, 1.35 mu/C1 - 0.15, gives {} to {}. In", *ends(yielding["estimate"]))
    means = (f"{between[name].mean():.2f}" for name in ("effective", "estimate"))
    said = "In the {} buildings with eta between 0.6 and 0.9 the fraction is {} on average, and the rule gives {}. !["
    page.words(said, between.height, *means)
    page.words("attached ones, and eta is {} to {}.", *ends(table.filter(R=1.0)["eta"]))


def of_elastic(page: Page, rows: pl.DataFrame) -> None:
    """Put in what is missed in elastic buildings."""
    means = rows.group_by("occupancy", "place").agg(pl.col("missed").mean().abs())
    less = -rows.filter(place="first")["sliding"]
    said = "At R = 1 the error of the rule is {} % to {} % in single storeys, and less than {} %"
    page.words(said, *ends(rows["missed"], "+.0f"), int(means["missed"].max()) + 1)
    page.words("first storeys drift {} % to {} % less with sliding goods", *ends(less, ".0f"))


def ends(values: pl.Series, form: str = ".2f") -> list[str]:
    """Return the least and the largest value."""
    return [f"{values.min():{form}}", f"{values.max():{form}}"]
