"""Scenes in two horizontal directions: Python face, scene files, refusals (the numbers are tested in the kernel)."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.cli import main

G = 9.80665


def crate(**other: object) -> sm.Scene:
    return sm.Scene(None, [sm.Block(0, mass=100.0, mu=0.1, **other)], other_direction=True)


def constant(a: float, samples: int = 51) -> sm.Motion:
    return sm.Motion(np.full(samples, a), dt=0.01)


def test_a_crate_slides_along_a_constant_acceleration() -> None:
    response = sm.simulate(crate(), (constant(1.5), constant(-2.0)), histories=True, energy=True)
    slip = 0.5 * (2.5 - 0.1 * G) * 0.5**2  # (|a| - mu g) t^2 / 2, against the ground
    np.testing.assert_allclose(response.residual_slip, [[-0.6 * slip, 0.8 * slip]], rtol=1e-14)
    np.testing.assert_allclose(response.peak_slip, [[0.6 * slip, 0.8 * slip, slip]], rtol=1e-14)
    np.testing.assert_allclose(response.slip_path, [slip], rtol=1e-14)
    assert response.slip.shape == (51, 1, 2)
    assert response.counts["slip"] == 1
    event = response.events.row(0, named=True)
    assert (event["kind"], event["direction"], event["sign"]) == ("slip", None, None)
    assert event["angle"] == pytest.approx(np.arctan2(0.8, -0.6), abs=1e-14)
    assert abs(response.energy["relative_residual"]) < 1e-12
    assert json.loads(response.to_json())["peak_slip"] == response.peak_slip.tolist()
    assert "peak slip (mm)" in response.text


def test_motions_are_brought_to_one_length() -> None:
    short = sm.simulate(crate(), (constant(1.5, 51), constant(2.0, 11)))
    assert short.motions[1].samples == 51
    assert short.motions[1].acceleration[11:].tolist() == [0.0] * 40
    with pytest.raises(sm.errors.InvalidMotion, match="two motions, for a scene in two directions"):
        sm.simulate(crate(), constant(1.0))  # type: ignore[call-overload]
    with pytest.raises(sm.errors.InvalidMotion, match="dt of motion in y"):
        sm.simulate(crate(), (constant(1.0), sm.Motion([0.0, 1.0], dt=0.02)))


def test_a_building_may_differ_in_y() -> None:
    building = sm.Building.uniform(2, 0.5)
    scene = sm.Scene(building, sm.blocks_on_floors([0.5, 0.5], mu=0.2), other_direction=sm.Building.uniform(2, 0.7))
    motions = (constant(2.0), constant(2.0))
    response = sm.simulate(scene, motions)
    assert response.peak_drift.shape == (2, 3)
    assert response.peak_drift[0, 0] != response.peak_drift[0, 1]
    assert np.all(response.peak_drift[:, 2] >= response.peak_drift[:, :2].max(axis=1))
    alike = sm.Scene(building, scene.blocks, other_direction=True)
    peaks = sm.simulate(alike, motions).peak_drift
    np.testing.assert_allclose(peaks[:, 0], peaks[:, 1], rtol=1e-13)  # a motion along the diagonal


def test_what_belongs_to_two_directions_is_refused_in_one() -> None:
    for other in ({"velocity": (0.1, 0.2)}, {"stops_y": sm.Stops(0.1, 1e5)}):
        with pytest.raises(sm.errors.InvalidScene, match="left out where there is one direction"):
            sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1, **other)])  # type: ignore[arg-type]
    with pytest.raises(sm.errors.InvalidScene, match="mass of scene in y"):
        sm.Scene(sm.Building([1.0], 100.0), other_direction=sm.Building([2.0], 100.0))


def test_a_motion_that_does_not_suit_its_scene_is_refused() -> None:
    with pytest.raises(sm.errors.InvalidMotion, match="motion 1 of batch must be a Pair"):
        sm.simulate_many([crate()], [constant(1.0)])
    with pytest.raises(sm.errors.InvalidMotion, match="motion 2 of batch must be a Motion"):
        sm.simulate_many([sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)])], [constant(1.0), (constant(1.0),) * 2])
    scene = sm.Scene(sm.Building.uniform(1, 0.5), sm.blocks_on_floors([0.5], mu=0.2), other_direction=True)
    with pytest.raises(sm.errors.InvalidMotion, match="motion 1 of effective mass must be a Pair"):
        sm.effective_mass(scene, [constant(1.0)])
    with pytest.raises(sm.errors.InvalidScene, match="left out where there are two directions"):
        sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)], base=sm.SlidingBase(mu=0.1, mass=1.0), other_direction=True)


FILE = """
[building]
mass = [1000.0, 1000.0]
stiffness = [5e5, 5e5]
[other_direction]
period = 0.7
[[blocks]]
floor = 1
mass = 300.0
mu = 0.2
velocity = [0.1, -0.1]
stops_y = {clearance = 0.05, stiffness = 1e5}
[initial]
velocity = [[0.1, 0.0], [0.2, 0.0]]
[motion]
acceleration = [0.0, 3.0, -3.0, 2.0, 0.0]
dt = 0.1
[other_motion]
acceleration = [0.0, 2.0, 2.0]
dt = 0.1
"""


def test_scene_files_and_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "plane.toml"
    path.write_text(FILE)
    file = sm.read_scene(path)
    assert file.other_motion is not None
    assert file.other_motion.samples == 5
    assert isinstance(file.scene.other_direction, sm.Building)
    assert file.scene.other_direction.periods[0] == pytest.approx(0.7, rel=1e-12)
    assert main(["run", str(path), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    response = sm.simulate(file.scene, (file.motion, file.other_motion), energy=True)
    assert printed["peak_drift"] == response.peak_drift.tolist()
    assert main(["run", str(path), "--out", str(tmp_path / "histories.csv")]) == 0
    assert (tmp_path / "histories.csv").read_text().startswith("time,drift_1_x,drift_1_y,")
    path.write_text(FILE.replace("[other_direction]\nperiod = 0.7\n", ""))
    with pytest.raises(sm.errors.InvalidScene, match=r"initial\.velocity"):
        sm.read_scene(path)


def test_pairs_of_scene_files(tmp_path: Path) -> None:
    path = tmp_path / "pair.toml"
    goods = "[other_direction]\n[[blocks]]\nfloor = 0\nmass = 100.0\nmu = 0.1\n"
    path.write_text(f'{goods}[pair]\nbuiltin = "scenario-3"\nrotation = 30.0\nscale = 2.0\n')
    file = sm.read_scene(path)
    expected = sm.records.builtin_pairs()[2].rotated(30.0).scaled(2.0)
    assert file.motion == expected.first.motion
    assert file.other_motion == expected.second.motion
    for table, message in (
        ('builtin = "none"', "pair.builtin of pair.toml must be the name of one of 40 pairs"),
        ('first = "a.AT2"', "pair.second"),
        ('builtin = "scenario-3"\nstrike = 10.0', "pair.strike of pair.toml must be left out where the pair has no az"),
        ('builtin = "scenario-3"\n[motion]\nbuiltin = "synthetic-1"', "motion of pair.toml must be left out"),
    ):
        path.write_text(f"{goods}[pair]\n{table}\n")
        with pytest.raises(sm.errors.InvalidSceneFile, match=message):
            sm.read_scene(path)
    path.write_text(f"{goods.replace('[other_direction]', '')}[pair]\nbuiltin = 'scenario-3'\n")
    with pytest.raises(sm.errors.InvalidSceneFile, match=r"pair of pair\.toml must be left out where"):
        sm.read_scene(path)


@pytest.mark.parametrize("name", ["25_plane", "33_plane_rack", "36_plane_stop"])
def test_reference_scenes_from_files(reference: Callable[[str], Path], name: str) -> None:
    file = sm.read_scene(reference(f"general/{name}.json"))
    assert file.other_motion is not None
    response = sm.simulate(file.scene, (file.motion, file.other_motion), energy=True)
    expected = json.loads(reference(f"general/results/{name}.json").read_text())
    for key, found in (
        ("peak_drift", response.peak_drift),
        ("peak_acceleration", response.peak_floor_acceleration),
        ("peak_slip", response.peak_slip),
        ("residual_slip", response.residual_slip),
    ):
        values = np.array(expected[key])
        np.testing.assert_allclose(found, values, rtol=0.0, atol=1e-12 * np.abs(values).max())
    assert len(response.events) == len(expected["events"])
    assert abs(response.energy["relative_residual"]) < 1e-11


def test_a_block_lands_wherever_the_floor_is() -> None:
    """N = g + a_v comes to zero at a time in closed form, at which rounding may leave it a little below zero."""
    building = sm.Building.uniform(1, 0.5, mass=1000.0)
    time = 0.01 * np.arange(61)
    for end in np.linspace(0.22, 0.34, 41):
        places = [0.0, 0.05, 0.15, 0.2, end, 1.0]
        vertical = np.interp(time, places, [0.0, 0.0, -2.0 * G, -2.0 * G, 0.0, 0.0])
        first = int(np.flatnonzero((vertical[:-1] < -G) & (vertical[1:] >= -G))[-1])
        land = time[first] + 0.01 * (-G - vertical[first]) / (vertical[first + 1] - vertical[first])
        motion = (sm.Motion(np.zeros(61), 0.01, vertical), sm.Motion(np.full(61, 1.13), 0.01))
        scene = sm.Scene(building, [sm.Block(1, mass=3000.0, mu=0.3)], other_direction=True)
        events = sm.simulate(scene, motion).events
        assert events.filter(pl.col("kind") == "land")["time"].to_list() == pytest.approx([land], abs=1e-12)


@pytest.mark.parametrize("form", ["first", "folder", "builtin"])
def test_a_pair_takes_no_key_of_another_form(form: str, tmp_path: Path) -> None:
    forms = {"first": {"second": "b.AT2"}, "folder": {"name": "x"}, "builtin": {}}
    stated: dict[str, Any] = {form: {"first": "a.AT2", "folder": ".", "builtin": "scenario-3"}[form], **forms[form]}
    others = {"first", "folder", "builtin", "second", "name", "vertical"} - set(stated)
    for key in others - ({"vertical"} if form == "first" else set()):
        table = stated | {key: "other"}
        path = tmp_path / "pair.json"
        blocks = [{"floor": 0, "mass": 100.0, "mu": 0.1}]
        path.write_text(json.dumps({"other_direction": {}, "blocks": blocks, "pair": table}))
        with pytest.raises(sm.errors.InvalidSceneFile, match=r"must be left out where pair\."):
            sm.read_scene(path)


def test_a_folder_without_pairs_is_what_is_wrong(tmp_path: Path) -> None:
    path = tmp_path / "pair.json"
    blocks = [{"floor": 0, "mass": 100.0, "mu": 0.1}]
    pair = {"folder": ".", "name": "x"}
    path.write_text(json.dumps({"other_direction": {}, "blocks": blocks, "pair": pair}))
    with pytest.raises(sm.errors.InvalidSceneFile, match=r"pair\.folder of pair\.json must be a folder with records"):
        sm.read_scene(path)


SAME: Any = [("stiffness", 6e5, "period", 0.3), ("yield_shear", 1e3, "yield_shear_over_weight", 0.2)]


@pytest.mark.parametrize(("one", "first", "other", "second"), SAME)
def test_keys_that_say_the_same_are_refused_in_y_too(
    one: str, first: float, other: str, second: float, tmp_path: Path
) -> None:
    """Beside each other in y, of a building by its stiffness or its period and of a rack."""
    path = tmp_path / "scene.json"
    motion = {"acceleration": [0.0, 1.0, 0.0], "dt": 0.1}
    both = {one: first, other: second}
    for building in ({"mass": [1000.0, 1000.0], "stiffness": 5e5}, {"storeys": 2, "period": 0.4, "mass": 1e3}):
        rack = {"floor": 1, "levels": 2, "level_mass": 10.0, "period": 0.4}
        for in_y, of_rack in ((both, {}), ({}, {"other_direction": both})):
            path.write_text(
                json.dumps(
                    {
                        "building": building,
                        "other_direction": in_y,
                        "racks": [rack | of_rack],
                        "motion": motion,
                        "other_motion": motion,
                    }
                )
            )
            with pytest.raises(sm.errors.SeismassError, match=f"{one}.* must be |{other}.* must be "):
                sm.read_scene(path)
            assert main(["run", str(path)]) == 2


def test_histories_of_racks_have_a_column_of_each_level_in_each_direction(tmp_path: Path) -> None:
    scene = {
        "building": {"mass": [1000.0], "stiffness": 5e5},
        "other_direction": {},
        "racks": [{"floor": 1, "levels": levels, "level_mass": 10.0, "period": 0.3} for levels in (2, 1)],
        "pair": {"builtin": "scenario-3"},
    }
    path, out = tmp_path / "scene.json", tmp_path / "out.csv"
    path.write_text(json.dumps(scene))
    assert main(["run", str(path), "--out", str(out)]) == 0
    header, *rows = out.read_text().splitlines()
    names = ["rack_1_drift_1", "rack_1_drift_2", "rack_2_drift_1"]
    assert header.split(",")[3:] == [f"{name}_{axis}" for name in names for axis in "xy"]
    file = sm.read_scene(path)
    response: Any = sm.simulate(file.scene, (file.motion, file.other_motion), histories=True)
    found = np.array([row.split(",") for row in rows], dtype=float)[:, 3:]
    np.testing.assert_allclose(found, response.rack_drift.reshape(len(rows), -1), rtol=1e-12)
    assert main(["run", str(path), "--opensees", str(tmp_path / "models")]) == 2
    assert not (tmp_path / "models").exists()
