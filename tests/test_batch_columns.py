"""Each column of a batch is the quantity of its name in the run alone, of scenes in which no two are equal."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import seismass as sm

BUILDING = sm.Building(
    [1130.0, 970.0, 711.0],
    [4.37e5, 3.61e5, 2.53e5],
    yield_shear=[2170.0, 1790.0, 1190.0],
    second_slope=[0.313, 0.173, 0.0871],
    damping=0.0413,
    heights=[4.3, 3.7, 3.1],
)
GOODS = [
    sm.Block(1, mass=431.0, mu=0.197),
    sm.Block(3, mass=617.0, mu=0.263, stops=sm.Stops(0.0019, 6.1e4, damping=443.0)),
]
RACK = sm.Rack(2, 2, period=0.293, level_mass=[47.0, 38.3], blocks=[sm.RackBlock(2, mass=83.0, mu=0.151)])
BASE = sm.SlidingBase(0.137, mass=1490.0, radius=1.93)
FREE = [sm.Block(1, mass=431.0, mu=0.197), sm.Block(3, mass=617.0, mu=0.263)]
MOTION = sm.builtin_record("synthetic-3").scaled(1.37).with_duration(8.3)
SCENES = {
    "chain": sm.Scene(BUILDING, FREE),
    "collapse": sm.Scene(BUILDING, FREE, collapse_drift=0.013),
    "racks and stops": sm.Scene(BUILDING, GOODS, racks=[RACK]),
    "base": sm.Scene(BUILDING, FREE, base=BASE),
}
OF_RUN: dict[str, Callable[[sm.Response], Any]] = {
    "scene": lambda run: 1,
    "motion": lambda run: 1,
    "record": lambda run: "synthetic-3",
    "reason": lambda run: None,
    "events": lambda run: sum(run.counts.values()),
    "yields": lambda run: run.counts["yield"],
    "slips": lambda run: run.counts["slip"],
}


@pytest.mark.parametrize("name", SCENES)
def test_columns_are_quantities_of_the_run_alone(name: str) -> None:
    table = sm.simulate_many(SCENES[name], MOTION)
    run = sm.simulate(SCENES[name], MOTION)
    assert (run.status == "collapsed") == (name == "collapse")
    row = table.row(0, named=True)
    seen: dict[str, str] = {}
    for column, found in row.items():
        if "_base_" in f"_{column}" and column != "peak_base_shear" and name != "base":
            expected = None
        else:
            expected = OF_RUN[column](run) if column in OF_RUN else getattr(run, column)
        if isinstance(expected, np.ndarray | tuple):
            expected = np.concatenate([*expected, []]).tolist() if isinstance(expected, tuple) else expected.tolist()
        assert found == expected, column
        # Of two columns that are equal here, one could hold the other: none are, but for storey 1 and numbers of runs.
        if column not in ("scene", "motion", "collapsed_storey") and found not in (None, []) and np.any(found):
            assert seen.setdefault(str(found), column) == column, f"{column} is {seen[str(found)]} in this scene"
    assert len(row) >= 21
