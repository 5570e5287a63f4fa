"""Scenes of the general engine: racks, a stiffness matrix, stops; what takes them and what refuses them.

The reference results are those of an independent solver in 80-bit arithmetic; the kernel's own tests compare more.
"""

import json
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.commands.run import as_json
from seismass.model.springs import SHAPE_FIELDS

FIELDS = ("yield_shear", "yield_shear_over_weight", "stiffness", "level_mass", *SHAPE_FIELDS)
SCENES = ("01_rack", "04_rack", "08_rack", "11_wall", "14_wall", "18_stop", "21_stop", "41_opposite_stops")
PULSE = sm.Motion(np.sin(np.linspace(0.0, 12.0, 300)) * 3.0, dt=0.01)


def building(**changes) -> sm.Building:
    return sm.Building([1000.0, 1200.0], [4e5, 3e5], **changes)


def rack(**changes) -> sm.Rack:
    goods = [sm.RackBlock(1, mass=300.0, mu=0.2), sm.RackBlock(2, mass=100.0, fixed=True)]
    return sm.Rack(2, levels=2, level_mass=40.0, period=0.4, blocks=goods, **changes)


@pytest.mark.parametrize("name", SCENES)
def test_reference_scenes(reference: Callable[[str], Path], name: str) -> None:
    """Peaks to 1e-12 of the largest, the same events at the same times to 1e-11 s."""
    file = sm.read_scene(reference(f"general/{name}.json"))
    result = json.loads(reference(f"general/results/{name}.json").read_text())
    response = sm.simulate(file.scene, file.motion, energy=True)
    assert file.scene.engine == "general"

    def same(found: np.ndarray, key: str) -> None:
        expected = np.array(result[key], dtype=float).reshape(-1)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * max(abs(expected).max(), 1e-300))

    same(response.peak_drift, "peak_drift")
    same(response.peak_storey_shear, "peak_shear")
    same(response.peak_floor_acceleration, "peak_acceleration")
    same(np.array([response.peak_base_shear]), "peak_base_shear")
    same(response.peak_slip, "peak_slip")
    same(response.slip_path, "path")
    if file.scene.racks:
        same(np.concatenate(response.peak_rack_drift), "peak_rack_drift")
        same(np.concatenate(response.peak_rack_shear), "peak_rack_shear")
        same(np.concatenate(response.peak_rack_acceleration), "peak_rack_acceleration")
    if "peak_contact_force" in result:
        same(response.peak_contact_force, "peak_contact_force")
    log = response.event_log
    kinds = {"touch_stop": "contact", "leave_stop": "leave"}
    found = sorted((round(float(e["time"]), 9), kinds.get(e["kind"], e["kind"]), int(e["number"])) for e in log)
    expected = sorted((round(e["time"], 9), e["kind"], e["number"]) for e in result["events"])
    assert found == expected
    assert abs(response.energy["relative_residual"]) < 1e-11


def test_a_rack_on_the_ground_is_a_chain() -> None:
    """The levels of a rack that stands on the ground are the storeys of a building with the same masses and springs."""
    chain = sm.simulate(sm.Scene(sm.Building([100.0, 80.0], [2e4, 3e4], damping=0.03)), PULSE)
    alone = sm.Rack(0, levels=2, level_mass=[100.0, 80.0], stiffness=[2e4, 3e4])
    response = sm.simulate(sm.Scene(None, racks=[alone]), PULSE, histories=True)
    np.testing.assert_allclose(response.peak_rack_drift[0], chain.peak_drift, rtol=1e-13)
    assert response.rack_drift[0].shape == (300, 2)
    assert len(response.peak_drift) == 0


def test_the_period_of_a_rack_is_that_with_its_goods() -> None:
    alone = rack().alone()
    assert alone.mass.tolist() == [340.0, 140.0]
    assert alone.periods[0] == pytest.approx(0.4, rel=1e-12)


def test_a_matrix_stands_for_springs() -> None:
    """The stiffness matrix of the second storey in place of its spring: the same building, damping included."""
    motion = sm.builtin_record("synthetic-1")
    chain = sm.simulate(sm.Scene(building()), motion)
    matrix = 3e5 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    walled = sm.Building([1000.0, 1200.0], [4e5, 0.0], stiffness_matrix=matrix)
    response = sm.simulate(sm.Scene(walled), motion)
    np.testing.assert_allclose(walled.periods, building().periods, rtol=1e-13)
    np.testing.assert_allclose(walled.damping_matrix, building().damping_matrix, rtol=1e-12)
    np.testing.assert_allclose(response.peak_drift, chain.peak_drift, rtol=1e-12)
    assert response.peak_base_shear == pytest.approx(chain.peak_base_shear, rel=1e-12)


def test_a_block_comes_back_from_an_elastic_stop() -> None:
    """Without friction: largest force v sqrt(k m), contact for pi sqrt(m/k), and back as fast as it came."""
    block = sm.Block(0, mass=4.0, mu=0.0, velocity=0.5, stops=sm.Stops([0.3, 0.1], stiffness=900.0))
    response = sm.simulate(sm.Scene(None, [block]), sm.Motion(np.zeros(101), dt=0.01))
    touch, leave = response.events.filter(response.events["kind"].is_in(["touch_stop", "leave_stop"])).rows(named=True)[
        :2
    ]
    assert touch["time"] == pytest.approx(0.2, rel=1e-13)
    assert leave["time"] - touch["time"] == pytest.approx(np.pi * np.sqrt(4.0 / 900.0), rel=1e-12)
    assert (touch["velocity"], leave["velocity"]) == pytest.approx((0.5, -0.5), rel=1e-12)
    assert response.peak_contact_force[0] == pytest.approx(0.5 * np.sqrt(900.0 * 4.0), rel=1e-12)
    assert response.peak_contact_velocity[0] == pytest.approx(0.5, rel=1e-12)


def test_values_are_copied_compared_and_pickled() -> None:
    stopped = sm.Block(1, mass=200.0, mu=0.1, stops=sm.Stops(0.02, 1e5, damping=30.0))
    scene = sm.Scene(building(), [stopped], racks=[rack()])
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert scene != scene.replace(racks=[])
    assert rack().replace(period=0.5) != rack() == rack()
    assert repr(rack()) == "Rack(floor=2, 2 levels, period = 0.4 s, 2 blocks)"
    response = sm.simulate(scene, PULSE, histories=True, energy=True)
    assert pickle.loads(pickle.dumps(response)) == response
    assert len(scene.goods) == len(response.peak_slip) == 2
    assert response.counts["touch_stop"] >= response.counts["leave_stop"]


def test_run_prints_racks_and_their_goods(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(
        """
[building]
mass = [1000.0, 1200.0]
stiffness = [4e5, 3e5]
[[blocks]]
floor = 1
mass = 200.0
mu = 0.1
stops = {clearance = 0.001, stiffness = 1e5}
[[racks]]
floor = 2
levels = 2
level_mass_ratio = 0.05
period = 0.4
blocks = [{level = 2, mass_ratio = 0.3, mu = 0.2}, {level = 1, mass = 50.0, fixed = true}]
[motion]
builtin = "synthetic-1"
"""
    )
    file = sm.read_scene(path)
    response = sm.simulate(file.scene, file.motion, energy=True)
    text = response.text
    assert "rack 1 level 2" in text and "rack  floor  level" in text
    result = as_json(file, response)
    assert len(result["peak_rack_drift"][0]) == 2
    assert len(result["peak_contact_force"]) == 2


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"period": 0.5, "stiffness": 1e5}, "period of rack must be given either as period or as stiffness; got both"),
        (
            {"level_mass": None},
            "level_mass of rack must be given either as level_mass or as level_mass_ratio; got neither",
        ),
        ({"levels": 1}, "level of block 2 of rack must be between 1 and 1; got 2"),
        ({"second_slope": [0.1]}, "second_slope of rack must be one number or a list of 2 values, one per level"),
    ],
)
def test_racks_that_are_none_are_refused(change: dict, message: str) -> None:
    with pytest.raises(sm.errors.InvalidScene, match=message):
        rack().replace(**change)


@pytest.mark.parametrize("key", ["damping", "hysteresis", "geometric_stiffness", *FIELDS])
@pytest.mark.parametrize("value", [-1.0, np.nan, [], "x", [3.0, -1.0]])
def test_what_a_rack_is_refused_for_is_said_of_it(key: str, value: Any) -> None:
    """No wrong value of a key of a rack is refused as the building's."""
    try:
        sm.Scene(building(), racks=[rack(), rack().replace(**{key: value})])
    except sm.errors.SeismassError as error:
        told = str(error)
        assert "rack" in told
        assert "building" not in told and "storey" not in told


def test_scenes_refuse_what_does_not_stand(tmp_path: Path) -> None:
    with pytest.raises(sm.errors.InvalidScene, match="floor of rack 1 must be"):
        sm.Scene(building(), racks=[rack().replace(floor=3)])
    with pytest.raises(sm.errors.InvalidScene, match="stiffness of stops of block 1 must be a positive number; got -1"):
        sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1, stops=sm.Stops(0.1, -1.0))])
    with pytest.raises(sm.errors.InvalidScene, match="stiffness_matrix of building must be positive semi-definite"):
        building(stiffness_matrix=[[1.0, 2.0], [2.0, 1.0]])
    with pytest.raises(sm.errors.InvalidScene, match="masses of rack 1 must be given as ratios"):
        sm.Scene(sm.Building.uniform(2, 0.4), racks=[rack()])


def test_what_takes_shear_buildings_alone_says_so() -> None:
    """Each refuses what it does not take by its name."""
    motion, blocks = sm.builtin_record("synthetic-1"), [sm.Block(1, mass=500.0, mu=0.2)]
    racked = sm.Scene(building(), blocks, racks=[rack()])
    stopped = sm.Scene(building(), [blocks[0].replace(stops=sm.Stops(0.1, 1e5))])
    walled = sm.Scene(building(stiffness_matrix=np.diag([1e4, 1e4])), blocks)
    hazard = sm.risk.HazardCurve([0.05, 0.5, 5.0], [1e-2, 4e-4, 4e-6])
    for scene, named in (
        (racked, "racks of scene"),
        (stopped, "stops of block 1"),
        (walled, "stiffness_matrix of building"),
    ):
        for owner, call in (
            ("compared models", lambda scene: sm.fragility.incremental_dynamic_analysis(scene, [motion], 0.02)),
            ("risk-targeted share", lambda scene: sm.risk.risk_targeted_share(scene, [motion], hazard, 0.02)),
        ):
            with pytest.raises(sm.errors.InvalidScene, match=f"{named} must be left out in {owner}; simulate takes it"):
                call(scene)
    with pytest.raises(sm.errors.InvalidScene, match="stiffness_matrix of building must be left out in grids"):
        sm.Grid(building=walled.building, mass_ratio=0.5, mu=0.3)
    with pytest.raises(
        sm.errors.InvalidScene, match="stiffness_matrix of building must be left out in scaling by push"
    ):
        sm.scaling.first_mode_oscillator(walled.building)


@pytest.mark.parametrize(
    "table", ("blocks.stops", "blocks.stops_y", "racks", "racks.other_direction", "racks.blocks.stops")
)
def test_null_in_a_list_of_a_scene_file_is_infinite(tmp_path: Path, table: str) -> None:
    """Of everything that may be infinite in a list: the same scene as with a number beyond the range."""
    stops, strengths = {"clearance": [None, 0.02], "stiffness": 1e5}, {"yield_shear": [None, 900.0]}
    goods = {"level": 1, "mass": 90.0, "mu": 0.2}
    on_rack = {"floor": 1, "levels": 2, "level_mass": 40.0, "stiffness": [3e4, 2e4], "blocks": [goods]}
    block = {"floor": 1, "mass": 300.0, "mu": 0.1}
    tables = {"blocks": block, "racks.blocks": goods}
    owner, _, key = table.rpartition(".")
    if key.startswith("stops"):
        tables[owner][key] = stops
    elif owner:
        on_rack[key] = strengths
    else:
        on_rack |= strengths
    motion = {"dt": 0.01, "unit": "m/s2", "acceleration": [0.0, 2.0, -2.0, 0.0]}
    structure = {"mass": [1000.0, 1200.0], "stiffness": [4e5, 3e5]}
    scene = {"building": structure, "blocks": [block], "racks": [on_rack], "motion": motion}
    scene |= {"other_direction": {}, "other_motion": motion}
    path = tmp_path / "scene.json"
    text = json.dumps(scene)
    path.write_text(text)
    found = sm.read_scene(path).scene
    path.write_text(text.replace("null", "1e999"))
    assert found == sm.read_scene(path).scene
