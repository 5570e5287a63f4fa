"""Scenes over axes of one's own: order, tables, batches, refusals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.runs import SceneProduct

BUILDING = sm.Building.uniform(2, 0.4, mass=1.0e5, yield_shear_over_weight=[0.3, 0.2])
MOTION = sm.builtin_suite("seven")[0].scaled(2.0)


def racked(period: float, levels: int, clearance: float) -> sm.Scene:
    goods = [sm.RackBlock(level, mass=2.0e4, mu=0.37) for level in range(1, levels + 1)]
    rack = sm.Rack(1, levels, period=period, level_mass=1.0e3, blocks=goods)
    loose = sm.Block(1, mass=2.0e4, mu=0.1, stops=sm.Stops(clearance=clearance, stiffness=2.0e6))
    return sm.Scene(BUILDING, [loose], racks=[rack])


def test_rows_of_a_batch_are_those_of_single_runs() -> None:
    """Rack period, levels and clearance: the last axis changes fastest, and each row is its scene's own run."""
    scenes = SceneProduct(racked, period=np.array([0.3, 0.8]), levels=[1, 2], clearance=[0.02, 0.05])
    assert len(scenes) == 8
    assert scenes.values_of(4) == {"period": 0.3, "levels": 2, "clearance": 0.05}
    table = sm.simulate_many(scenes, MOTION).join(scenes.table(), on="scene")
    assert table["clearance"].to_list() == [0.02, 0.05] * 4
    assert table["period"].to_list() == [0.3] * 4 + [0.8] * 4
    for number, row in enumerate(table.iter_rows(named=True), start=1):
        own = sm.simulate(racked(**scenes.values_of(number)), MOTION)
        assert row["peak_drift"] == own.peak_drift.tolist()
        assert row["peak_rack_drift"] == np.concatenate(own.peak_rack_drift).tolist()
    assert [frame.height for frame in sm.stream_many(scenes, MOTION, chunk=5)] == [5, 3]


def test_it_is_a_sequence() -> None:
    scenes = SceneProduct(racked, period=[0.3, 0.8], levels=[1], clearance=[0.02])
    assert scenes[-1] is scenes[1]
    assert scenes[:1] == [scenes[0]]
    assert list(scenes) == [scenes[0], scenes[1]]
    with pytest.raises(IndexError):
        scenes[2]


def test_values_of_other_kinds_stand_as_text() -> None:
    scenes = SceneProduct(lambda building: sm.Scene(building), building=[BUILDING, BUILDING.replace(damping=0.02)])
    assert scenes.table()["building"].to_list() == [repr(BUILDING), repr(BUILDING.replace(damping=0.02))]


@pytest.mark.parametrize(
    ("make", "axes", "message"),
    [
        (racked, {}, "axes of scene product must be given by name"),
        (3, {"period": [1.0]}, "make of scene product must be a callable"),
        (racked, {"period": "ab"}, "axis period of scene product must be a list of values"),
        (racked, {"period": 0.3}, "axis period of scene product must be a list of values; got 0.3"),
        (racked, {"period": []}, "axis period of scene product must be at least one value"),
        (racked, {"a": range(2000), "b": range(2000)}, "scenes of scene product must be at most 1000000; got 4000000"),
    ],
)
def test_what_is_no_product_is_refused(make: Any, axes: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption) as raised:
        SceneProduct(make, **axes)
    assert message in str(raised.value)


def test_what_is_no_scene_is_named() -> None:
    scenes = SceneProduct(lambda mu: mu, mu=[0.1, 0.2])
    with pytest.raises(sm.errors.InvalidScene, match=r"scene 2 \(mu = 0\.2\) of scene product must be a Scene"):
        scenes[1]
