"""The words of the page of racks, walls and stops are true of the stored cases."""

import polars as pl

from pages import racks as page


def test_words_of_the_page() -> None:
    rows = page.solved()
    racks = rows.filter(study="racks")
    pairs = racks.filter(goods="sliding").join(racks.filter(goods="yielding"), on=["R", "rack_period"], suffix="_weak")
    assert (pairs["value_weak"] <= pairs["value"]).all()  # a rack that yields acts less
    assert racks.filter(R=1.0)["value"].max() < 1.0
    walls = rows.filter(study="walls")
    half = walls.filter(pl.col("eta").is_between(0.49, 0.51))
    assert (half.filter(R=4.0)["value"] > half.filter(R=4.0)["by_hand"]).all()
    stops = rows.filter(study="stops")
    free = stops.filter(pl.col("clearance").is_null()).select("R", "mu", free="value")
    rough = stops.filter(clearance=0.05, mu=0.3).join(free, on=["R", "mu"])
    assert ((rough["value"] - rough["free"]).abs() < 0.1).all()
