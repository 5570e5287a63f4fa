"""The page of racks, walls and stops is what its tool makes of the stored cases, and its words are true of them."""

import runpy
from pathlib import Path

import polars as pl

ROOT = Path(__file__).parents[1]


def test_the_page_is_current() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "racks_page.py"))
    rows = tool["solved"]()
    assert (ROOT / "docs" / "racks.md").read_text(encoding="utf-8") == tool["page"](rows)
    assert "{" not in tool["page"](rows)


def test_words_of_the_page() -> None:
    rows = runpy.run_path(str(ROOT / "tools" / "racks_page.py"))["solved"]()
    racks = rows.filter(study="racks")
    pairs = racks.filter(goods="sliding").join(racks.filter(goods="yielding"), on=["R", "rack_period"], suffix="_weak")
    assert (pairs["value_weak"] <= pairs["value"]).all()  # a rack that yields acts less
    assert racks.filter(R=1.0)["value"].max() < 1.0
    walls = rows.filter(study="walls")
    half = walls.filter(pl.col("eta").is_between(0.49, 0.51))
    assert (half.filter(R=4.0)["value"] > half.filter(R=4.0)["estimate"]).all()
    assert (half["value"] < half["conservative"]).all()
    stops = rows.filter(study="stops")
    free = stops.filter(pl.col("clearance").is_null()).select("R", "mu", free="value")
    rough = stops.filter(clearance=0.05, mu=0.3).join(free, on=["R", "mu"])
    assert ((rough["value"] - rough["free"]).abs() < 0.1).all()
