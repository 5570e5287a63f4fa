"""Pages with numbers from recordings are what the kernel gives: the section-4 page, findings and words of README.md."""

from __future__ import annotations

import runpy
from pathlib import Path

import polars as pl

from seismass.records import read_suite
from seismass.spectra import TargetSpectrum
from seismass.study import run_study

ROOT = Path(__file__).parents[1]


def test_section4_page_is_current(shared: Path) -> None:
    page = runpy.run_path(str(ROOT / "tools" / "section4_table.py"))["page"](shared)
    assert (ROOT / "docs" / "section4.md").read_text(encoding="utf-8") == page
    assert "All storeys yield in every run" in page


def test_readme_findings_are_current(shared: Path) -> None:
    readme = runpy.run_path(str(ROOT / "tools" / "readme_findings.py"))["readme"](shared)
    assert (ROOT / "README.md").read_text(encoding="utf-8") == readme
    assert "largest underestimation" in readme


def test_readme_says_of_top_middle_and_elastic_storeys_what_the_study_gives(shared: Path) -> None:
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    first, top = pl.col("storey") == 1, pl.col("storey") == pl.col("storeys")
    place = pl.when(first).then(pl.lit("first")).when(top).then(pl.lit("top")).otherwise(pl.lit("middle"))
    summary = run_study(read_suite(shared / "records/paper_seven.csv"), TargetSpectrum.asce7()).summary
    rows = summary.select("occupancy", "R", "storeys", "storey", "alpha", place=place, missed="underestimation_percent")
    yielding, elastic = rows.filter(pl.col("R") > 1.0), rows.filter(pl.col("R") == 1.0)

    assert (yielding.filter(place="top")["missed"] < 0.0).all()
    middle = yielding.filter(place="middle")
    assert f"underestimated too, {(middle['missed'] > 0.0).sum()} of {len(middle)}, on average" in readme
    means = middle.group_by("occupancy", "R").agg(pl.col("missed").mean()).sort("missed")
    storage, commercial = (
        means.filter(occupancy=name).select("R", "missed").rows() for name in ("storage", "commercial")
    )
    assert [storage[-1][0], commercial[-1][0], storage[0][0], commercial[0][0]] == [4.0, 4.0, 2.0, 6.0]
    assert f"most at R = 4 ({storage[-1][1]:+.0f} % for storage, {commercial[-1][1]:+.0f} % for commercial)" in readme
    assert f"least at R = 2 or 6 ({storage[0][1]:+.0f} % and {commercial[0][1]:+.0f} %)" in readme

    *_, (*where, largest) = elastic.sort("missed").select("occupancy", "storeys", "storey", "alpha", "missed").rows()
    assert where == ["commercial", 4, 1, 1.5]
    assert f"off by {elastic['missed'].min():+.0f} % to {largest:+.0f} % in single storeys" in readme
    assert (elastic.group_by("occupancy", "place").agg(pl.col("missed").mean().abs())["missed"] < 8.0).all()
