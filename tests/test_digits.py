"""Digits of a run that stand when the ground motion changes in its last one."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.cli import main
from seismass.runs.peak_digits import FEW, chaos_remarks, digits_remarks

RECORD = sm.builtin_record("synthetic-1")
BUILDING = sm.Building.uniform(1, 0.5, mass=1e4)


def between_stops(stiffness: float) -> sm.Scene:
    """Two blocks that are thrown to and fro between undamped stops."""
    stops = sm.Stops(clearance=0.05, stiffness=stiffness, damping=0.0)
    return sm.Scene(BUILDING, [sm.Block(1, mass=5e3, mu=0.01, stops=stops) for _ in range(2)])


CHAOTIC = between_stops(1e7)


def test_an_ordinary_run_keeps_its_digits() -> None:
    scene = sm.Scene(
        sm.Building.uniform(3, 0.5, yield_shear_over_weight=[0.3, 0.25, 0.15]),
        sm.blocks_on_floors([0.5, 0.5, 0.0], 0.2),
    )
    response = sm.simulate(scene, RECORD)
    assert sm.runs.digits(response) >= 12
    assert digits_remarks(response) == ()


def test_digits_are_those_of_the_largest_difference_of_the_changed_run() -> None:
    response = sm.simulate(CHAOTIC, RECORD)
    up = np.random.default_rng(5).random(len(response.motion.acceleration)) < 0.5
    ground = response.motion.acceleration
    moved = np.array(
        [np.nextafter(a, np.inf if rise else -np.inf) if a else 0.0 for a, rise in zip(ground, up, strict=True)]
    )
    other = sm.simulate(CHAOTIC, sm.Motion(moved, response.motion.dt))
    pairs = [
        (getattr(response, name), getattr(other, name))
        for name in ("peak_drift", "peak_slip", "peak_floor_acceleration", "peak_storey_shear")
    ]
    worst = max(float(np.abs(one - two).max() / np.abs(one).max()) for one, two in pairs)
    assert worst > 1e-8  # chaotic
    number = sm.runs.digits(response, seed=5)
    assert 10.0 ** -(number + 1) < worst <= 10.0**-number


def test_a_chaotic_run_is_remarked_on() -> None:
    (remark,) = digits_remarks(sm.simulate(CHAOTIC, RECORD))
    assert remark.startswith("this run is chaotic: 5 digits of its peaks stand")


def test_a_run_that_ends_otherwise_has_no_digit(monkeypatch: pytest.MonkeyPatch) -> None:
    response = sm.simulate(CHAOTIC, RECORD)
    fallen = sm.simulate(CHAOTIC.replace(collapse_drift=1e-3), RECORD)
    assert fallen.status == "collapsed"
    monkeypatch.setattr("seismass.runs.peak_digits.simulate", lambda *_, **__: fallen)
    assert sm.runs.digits(response) == 0
    assert "no digits" in digits_remarks(response)[0]


def test_two_directions() -> None:
    scene = sm.Scene(BUILDING, [sm.Block(1, mass=5e3, mu=0.2)], other_direction=BUILDING)
    assert sm.runs.digits(sm.simulate(scene, sm.records.builtin_pairs()[0])) >= 10


@pytest.mark.parametrize("as_grid", [False, True])
def test_one_run_in_so_many_of_a_batch(as_grid: bool) -> None:
    motions = [sm.builtin_record(f"synthetic-{number}") for number in (1, 3, 4)]
    scenes = sm.Grid.product(BUILDING, mass_ratio=[0.5, 0.4], mu=[0.1]) if as_grid else [CHAOTIC, between_stops(1e5)]
    table = sm.runs.digits_of_batch(scenes, motions, every=2)
    assert table.select("scene", "motion").rows() == [(1, 1), (1, 3), (2, 2)]
    first = scenes.scene(1) if isinstance(scenes, sm.Grid) else scenes[0]
    assert table["digits"][0] == sm.runs.digits(sm.simulate(first, motions[0]))
    assert (table["digits"][0] < FEW) != as_grid


def test_commands_say_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "scene.json"
    stops = {"clearance": 0.05, "stiffness": 1e7, "damping": 0.0}
    blocks = [{"floor": 1, "mass": 5e3, "mu": 0.01, "stops": stops}] * 2
    building = {"mass": [1e4], "stiffness": [float(BUILDING.stiffness[0])], "damping": 0.05}
    file.write_text(json.dumps({"building": building, "blocks": blocks, "motion": {"builtin": "synthetic-1"}}))
    assert main(["run", str(file)]) == 0
    assert "this run is chaotic" in " ".join(capsys.readouterr().out.split())
    assert main(["run", str(file), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["digits"] < FEW
    assert main(["animate", str(file), "--out", str(tmp_path / "a.html")]) == 0
    assert "this run is chaotic" in capsys.readouterr().err
    assert "this run is chaotic" in (tmp_path / "a.html").read_text(encoding="utf-8")


def test_chaotic_scenes_of_a_batch_are_remarked_on() -> None:
    motions = [sm.builtin_record(f"synthetic-{number}") for number in (1, 2, 3, 4, 5)]
    (remark,) = chaos_remarks([CHAOTIC, between_stops(1e5)], motions)
    table = sm.runs.digits_of_batch([CHAOTIC, between_stops(1e5)], motions[::2], every=1)
    assert 0 < (few := table.filter(pl.col("digits") < FEW).height) < 6
    assert remark.startswith(f"runs with goods that slide are chaotic: of 6 that were solved twice, {few} keep fewer")


def test_an_assessment_says_it(monkeypatch: pytest.MonkeyPatch) -> None:
    building = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.5, "height_m": 4, "mass_kg": 1e4, "area_m2": 30, "design": True, "R": 3},
        "goods": {"live_load_kpa": 12, "mu": 0.1, "mu_factors": [0.7, 1.3]},
        "storeys": [{}],
    }
    motions = [sm.builtin_record(f"synthetic-{number}") for number in (1, 2, 3, 4)]
    said = "runs with goods that slide are chaotic: of 6 that were solved twice, 6 keep fewer"
    assert not any("chaotic" in remark for remark in sm.assess(building, motions, resamples=10).remarks)
    monkeypatch.setattr("seismass.runs.peak_digits.FEW", 16)  # more than a double has
    assert any(remark.startswith(said) for remark in sm.assess(building, motions, resamples=10).remarks)
