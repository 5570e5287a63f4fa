"""`seismass run`: what it prints, what it writes, and how it ends."""

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

SCENE: dict[str, Any] = {
    "name": "two storeys",
    "building": {"storeys": 2, "period": 0.3, "yield_shear_over_weight": [0.2, 0.1], "heights": 3.0},
    "blocks": [{"floor": 1, "mass_ratio": 1.0, "mu": 0.2}],
    "motion": {
        "acceleration": [float(x) for x in np.sin(np.arange(400) * 0.2) * np.hanning(400)],
        "dt": 0.01,
        "unit": "g",
        "scale": 0.6,
    },
}


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(SCENE))
    return path


def command(*arguments: object) -> int:
    return main(["run", *map(str, arguments)])


def test_summary(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command(scene) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    for part in ("two storeys", "r2 0.05", "r3 0", "Omega 2", "PGA", "peak drift mm", "of height %", "slip path mm"):
        assert part in printed.out
    assert "completed at 3.99 s" in printed.out
    assert all(len(line) <= 120 for line in printed.out.splitlines())


def test_p_delta_is_shown_on_elastic_storeys(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    building = {"storeys": 2, "period": 0.3, "mass": 1000.0, "heights": 3.0, "gravity_load": 1e4}
    path = tmp_path / "elastic.json"
    path.write_text(json.dumps({**SCENE, "building": building}))
    assert command(path) == 0
    printed = capsys.readouterr().out
    assert "springs   elastic" in printed
    assert "P-Delta" in printed


def test_json_has_the_names_of_the_reference_results(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command(scene, "--json") == 0
    printed = json.loads(capsys.readouterr().out)
    file = sm.read_scene(scene)
    response = sm.simulate(file.scene, file.motion, energy=True)
    for name in ("peak_drift", "peak_drift_time", "peak_slip", "residual_drift", "residual_slip"):
        assert printed[name] == getattr(response, name).tolist()
    assert printed["energy"] == response.energy
    assert printed["counts"] == {kind: count for kind, count in response.counts.items() if count}
    assert len(printed["events"]) == sum(printed["counts"].values())
    first_yield = next(event for event in printed["events"] if event["kind"] == "yield")
    assert set(first_yield) == {"time", "kind", "number", "sign", "element"}
    first_slip = next(event for event in printed["events"] if event["kind"] == "slip")
    assert set(first_slip) == {"time", "kind", "number", "sign"}
    assert printed["dt"] == 0.01
    assert printed["status"] == "completed"


@pytest.mark.parametrize(("suffix", "read"), [(".parquet", pl.read_parquet), (".csv", pl.read_csv)])
def test_histories(scene: Path, tmp_path: Path, suffix: str, read: Callable[[Path], pl.DataFrame]) -> None:
    target = tmp_path / f"histories{suffix}"
    target.write_text("what was there before")
    assert command(scene, "--out", target) == 0
    frame = read(target)
    assert frame.columns == ["time", "drift_1", "drift_2", "slip_1"]
    file = sm.read_scene(scene)
    response = sm.simulate(file.scene, file.motion, histories=True, energy=True)
    assert np.array_equal(frame["drift_2"].to_numpy(), response.drift[:, 1])
    assert np.array_equal(frame["slip_1"].to_numpy(), response.slip[:, 0])
    assert np.array_equal(frame["time"].to_numpy(), response.time)
    assert sorted(path.name for path in tmp_path.iterdir()) == [target.name, "scene.json"]


def test_a_collapse_is_a_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(SCENE | {"collapse_drift": 0.01}))
    assert command(path) == 0
    assert "collapsed" in capsys.readouterr().out
    assert command(path, "--json", "--out", tmp_path / "h.csv") == 0
    assert json.loads(capsys.readouterr().out)["collapsed_storey"] in (1, 2)


def test_blocks_on_the_ground_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({"blocks": [{"floor": 0, "mass": 1.0, "mu": 0.1}], "motion": SCENE["motion"]}))
    assert command(path) == 0
    assert "ground" in capsys.readouterr().out
    assert command(path, "--json") == 0
    assert json.loads(capsys.readouterr().out)["peak_base_shear"] is None


def test_bad_input_ends_with_2_and_writes_nothing(
    scene: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "histories.csv"
    for arguments, message in (
        ((tmp_path / "nowhere.toml", "--out", target), "must be a file that can be read"),
        (
            (scene, "--out", tmp_path / "histories.xlsx"),
            "--out of run must be a file with the suffix .parquet or .csv; got",
        ),
        ((scene, "--out", tmp_path / "nowhere" / "h.csv"), "No such folder"),
    ):
        assert command(*arguments) == 2
        printed = capsys.readouterr()
        assert message in printed.err
        assert printed.out == ""
    assert [path.name for path in tmp_path.iterdir()] == ["scene.json"]


def test_a_run_that_fails_ends_with_1(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "scene.json"
    building = {"mass": 1.0, "stiffness": 1.0, "yield_shear": 1e-9, "second_slope": 0.0, "damping": 0.0}
    path.write_text(json.dumps({"building": building, "motion": {"acceleration": [1e308] * 50, "dt": 10.0}}))
    assert command(path) == 1
    assert "t = " in capsys.readouterr().err
