"""Spring laws and wear of friction as users give them: forms, refusals, files and grids."""

from __future__ import annotations

import copy
import json
import math
import pickle
from pathlib import Path
from typing import Any

import pytest

import seismass as sm

K, V_Y = 1e6, 1e4
"""Stiffness (N/m) and yield shear (N) of the storeys: yield drift 0.01 m."""
POINTS = [(0.01, 60e3), (0.03, 90e3), (0.08, 100e3)]
PEAK: dict[str, Any] = {"yield_shear": V_Y, "overstrength": 1.0, "second_slope": 0.0, "hysteresis": "peak-oriented"}

FLAG: dict[str, Any] = {"yield_shear": V_Y, "second_slope": 0.1, "hysteresis": "flag-shaped"}


def storey(**arguments: Any) -> sm.Building:
    """A building of one storey."""
    return sm.Building(1e3, **({"stiffness": K} | arguments))


# Forms


def test_a_backbone_gives_stiffness_and_yield_shear_of_its_first_segment() -> None:
    both = sm.Building([1e3, 1e3], backbone=POINTS)
    assert both.stiffness.tolist() == [6e6, 6e6]
    assert both.yield_shear.tolist() == [60e3, 60e3]
    one = sm.Building(1e3, 5e5, yield_shear=4e3, backbone=[None, POINTS, [(0.02, 1e4)]])
    assert one.storeys == 3
    assert one.stiffness.tolist() == [5e5, 6e6, 5e5]
    assert one.yield_shear.tolist() == [4e3, 60e3, math.inf]  # a single segment does not yield
    assert one.backbone is not None
    assert one.backbone[0] is None
    assert one.backbone[1] == tuple(POINTS)


def test_a_list_of_stiffnesses_beside_backbones_has_their_values() -> None:
    near = 6e6 * (1.0 + 1e-12)  # as another division of the same numbers would give it
    building = sm.Building([1e3, 1e3], [5e5, near], backbone=[None, POINTS])
    assert building.stiffness.tolist() == [5e5, 6e6]
    with pytest.raises(sm.errors.InvalidScene, match=r"stiffness of storey 2 must be .* first segment; got 7000000"):
        sm.Building([1e3, 1e3], [5e5, 7e6], backbone=[None, POINTS])


def test_backbones_all_none_are_no_backbone() -> None:
    assert sm.Building([1e3, 1e3], K, backbone=[None, None]) == sm.Building([1e3, 1e3], K)


VALUES = [
    storey(stiffness=None, backbone=POINTS),
    storey(stiffness=None, backbone=POINTS[:2]),
    storey(**PEAK),
    storey(**PEAK, energy_capacity=20.0),
    storey(**FLAG, flag_height=0.5),
    storey(clearance=0.01, stop_stiffness=2e6),
    sm.Building([1e3, 1e3], K, yield_shear=V_Y, hysteresis=["masing", "peak-oriented"], residual_strength=0.1),
    sm.Block(1, mass=2.0, mu=0.3, wear=[(0.1, 0.25, 0.2)]),
    sm.Block(1, mass=2.0, mu=0.3),
]


@pytest.mark.parametrize("value", VALUES, ids=repr)
def test_values_pickle_copy_and_compare_by_content(value: object) -> None:
    again = pickle.loads(pickle.dumps(value))
    assert again == value
    assert hash(again) == hash(value)
    assert copy.deepcopy(value) == value
    assert sum(value == other for other in VALUES) == 1


def test_replace_takes_a_backbone_and_leaves_it_out() -> None:
    trilinear = sm.Building([1e3, 1e3], K, yield_shear=V_Y)
    changed = trilinear.replace(backbone=[None, POINTS])
    assert changed.stiffness.tolist() == [K, 6e6]
    assert changed.replace(backbone=[POINTS, POINTS]).yield_shear.tolist() == [60e3, 60e3]
    assert changed.replace(backbone=None).laws == ()
    assert changed.replace(damping=0.02).backbone == changed.backbone


def test_laws_are_named() -> None:
    assert storey(yield_shear=V_Y).laws == ()
    assert sm.Building(1e3, K, backbone=[None, POINTS], clearance=[0.1, math.inf], stop_stiffness=K).laws == (
        "backbone",
        "stop",
    )
    assert "peak-oriented" in repr(storey(**PEAK))
    assert ", stop" in repr(storey(clearance=0.01, stop_stiffness=K))


BUILDINGS: list[tuple[dict[str, Any], str]] = [
    ({"stiffness": None}, "stiffness of building must be given where a storey has no backbone; got none"),
    ({"stiffness": None, "backbone": [None]}, "stiffness of building must be given where a storey has no backbone"),
    (
        {"backbone": [POINTS, POINTS], "mass": [1.0] * 3},
        "backbone of building must be one list of points or a",
    ),
    ({"backbone": []}, "backbone of storey 1 must be a list of points, pairs of drift and force; got none"),
    ({"backbone": [(0.1, 1.0, 2.0)]}, "backbone of storey 1 must be a list of points, .*; got 3 numbers in each"),
    ({"backbone": "a"}, "backbone of storey 1 must be a table of numbers, rows by columns; got 'a'"),
    ({"backbone": [(0.1, "a")]}, "backbone of storey 1 must be a table of numbers"),
    ({"backbone": [(0.02, 1e4), (0.01, 2e4)]}, "drift of backbone point 2 of storey 1 must be finite and above 0.02 m"),
    (
        {"backbone": [(0.02, 1e4), (0.03, 3e4)]},
        "slope of the segment of backbone point 2 of storey 1 must be not",
    ),
    ({"backbone": POINTS, "overstrength": 3.0}, "overstrength of building must be left out where no storey has a tri"),
    (
        {"backbone": POINTS, "clearance": 0.1, "stop_stiffness": K},
        "clearance of building must be left out where",
    ),
    (
        {"backbone": POINTS, "hysteresis": "peak-oriented"},
        "hysteresis of building must be left out where",
    ),
    ({"hysteresis": "takeda"}, "hysteresis of building must be one of masing, peak-oriented, flag-shaped; got"),
    ({"hysteresis": ["masing"] * 2, "mass": [1.0] * 3}, "hysteresis of building must be one name or a list of 3"),
    ({"third_slope": -0.1}, "third_slope of storey 1 must be between 0 and the second slope 0.05; got -0.1"),
    ({**PEAK, "third_slope": -1.1}, "third_slope of storey 1 must be between -1 and the second slope 0; got -1.1"),
    ({**PEAK, "unloading_exponent": 1.0}, "unloading_exponent of storey 1 must be at least 0 and below 1; got 1"),
    ({**PEAK, "energy_capacity": 0.0}, "energy_capacity of storey 1 must be positive"),
    ({**PEAK, "residual_strength": 1.1}, "residual_strength of storey 1 must be between 0 and 1; got 1.1"),
    ({**PEAK, "clearance": 0.1, "stop_stiffness": K}, "clearance of building must be left out where storey 1 is peak-"),
    ({**FLAG, "flag_height": 1.1}, "flag_height of storey 1 must be between 0 and 1; got 1.1"),
    (
        {**FLAG, "backbone": POINTS},
        "hysteresis of building must be left out where storey 1 has a backbone; got f",
    ),
    (
        {**FLAG, "third_slope": 0.01},
        "third_slope of building must be left out where no storey has a tri",
    ),
    ({"flag_height": 0.5}, "flag_height of building must be left out where no storey has flag-shaped hysteresis"),
    ({"unloading_exponent": 0.5}, "unloading_exponent of building must be left out where no storey has peak-oriented"),
    ({"stop_stiffness": 1.0}, "stop_stiffness of building must be left out where no storey has a clearance"),
    ({"clearance": 0.1}, "stop_stiffness of storey 1 must be a positive number; got 0"),
    ({"clearance": -0.1, "stop_stiffness": K}, "clearance of storey 1 must be a positive number; got -0.1"),
]


@pytest.mark.parametrize(("arguments", "message"), BUILDINGS)
def test_wrong_laws_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidScene, match=f"^{message}"):
        sm.Building(**({"mass": 1e3, "stiffness": None if "backbone" in arguments else K} | arguments))


@pytest.mark.parametrize(
    ("wear", "message"),
    [
        (0.1, r"wear of block must be a list of \(path, mu_s, mu_k\); got 0.1"),
        ([(0.1, 0.2)], r"wear of block must be a list of \(path, mu_s, mu_k\); got 2 numbers in each"),
        ([(0.0, 0.2, 0.2)], "path of wear stage 1 of block 1 must be finite and above 0 m; got 0"),
        ([(0.2, 0.2, 0.2), (0.1, 0.2, 0.2)], "path of wear stage 2 of block 1 must be finite and above 0.2 m; got 0.1"),
        ([(0.1, 0.2, 0.3)], "mu_k of wear stage 1 of block 1 must be at most mu_s = 0.2; got 0.3"),
    ],
)
def test_wrong_wear_is_refused(wear: Any, message: str) -> None:
    with pytest.raises(sm.errors.InvalidScene, match=f"^{message}"):
        sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.3, wear=wear)])


def test_scene_files_have_laws_and_wear(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    motion = {"acceleration": [0.0, 1.0], "dt": 0.01}
    building = {
        "mass": 1e3,
        "stiffness": K,
        "yield_shear": V_Y,
        "backbone": [None, POINTS, None, None],
        "hysteresis": ["peak-oriented", "masing", "masing", "flag-shaped"],
        "third_slope": [-0.1, 0.0, 0.0, 0.0],
        "energy_capacity": [None, None, None, None],
        "clearance": [None, None, 0.05, None],
        "stop_stiffness": 2e6,
        "flag_height": 0.7,
    }
    blocks = [{"floor": 1, "mass": 10.0, "mu": 0.3, "wear": [[0.1, 0.25, 0.2]]}]
    path.write_text(json.dumps({"building": building, "blocks": blocks, "motion": motion}))
    expected = sm.Building(
        1e3,
        K,
        yield_shear=V_Y,
        backbone=[None, POINTS, None, None],
        hysteresis=["peak-oriented", "masing", "masing", "flag-shaped"],
        third_slope=[-0.1, 0.0, 0.0, 0.0],
        clearance=[math.inf, math.inf, 0.05, math.inf],
        stop_stiffness=2e6,
        flag_height=0.7,
    )
    block = sm.Block(1, mass=10.0, mu=0.3, wear=[(0.1, 0.25, 0.2)])
    assert sm.read_scene(path).scene == sm.Scene(expected, [block])
    with_period = {"storeys": 2, "period": 0.3, "backbone": POINTS}
    path.write_text(json.dumps({"building": with_period, "motion": motion}))
    with pytest.raises(
        sm.errors.InvalidSceneFile, match=r"building.backbone of .* left out where building.period is given"
    ):
        sm.read_scene(path)


# Grids and what is built on buildings


def test_a_grid_refuses_to_change_buildings_with_a_backbone() -> None:
    building = sm.Building([1e3, 1e3], backbone=POINTS)
    for name in ("period", "strength", "yield_shear_over_weight", "overstrength"):
        message = f"^{name} of grid must be left out where a building has a backbone"
        with pytest.raises(sm.errors.InvalidScene, match=message):
            sm.Grid(building, **{name: 2.0})  # type: ignore[arg-type]


def test_a_grid_carries_laws_and_varies_their_numbers() -> None:
    building = sm.Building([1e3, 1e3], K, **PEAK)
    motion = sm.builtin_suite("seven")[0]
    capacities = [20.0, math.inf]
    grid = sm.Grid.product(building, energy_capacity=capacities, mass_ratio=0.5, mu=0.3)
    scenes = [
        sm.Scene(building.replace(energy_capacity=value), sm.blocks_on_floors([0.5, 0.5], 0.3)) for value in capacities
    ]
    assert [grid.scene(n) for n in (1, 2)] == scenes
    found = [sm.simulate_many(batch, motion)["peak_drift"].to_list() for batch in (grid, scenes)]
    assert found[0] == found[1]
    with pytest.raises(sm.errors.InvalidScene, match="energy_capacity of building of scene 1 must be left out"):
        sm.Grid(sm.Building(1e3, K), energy_capacity=2.0)


def test_first_mode_oscillators_have_trilinear_springs() -> None:
    message = "building of scaling must be of trilinear springs .*; got peak-oriented"
    with pytest.raises(sm.errors.InvalidOption, match=message):
        sm.scaling.first_mode_oscillator(storey(**PEAK))
