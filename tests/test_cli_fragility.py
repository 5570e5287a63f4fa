"""`seismass fragility`: scene files and building files, all methods, what it writes, and how it ends."""

from __future__ import annotations

import json
from pathlib import Path

import polars as pl
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main

SCENE = """
[building]
storeys = 2
period = 0.4
yield_shear_over_weight = [0.25, 0.15]
heights = 3.0
[[blocks]]
floor = 1
mass_ratio = 1.0
mu = 0.2
[motion]
acceleration = [0.0, 1.0, 0.0]
dt = 0.01
"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    return path


def command(*arguments: object) -> int:
    return main(["fragility", *map(str, arguments)])


def test_answer_of_a_scene_file(scene: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    limits = ("--limit", "drift_ratio@1=0.015", "--limit", "slip@1=0.05")
    assert command(scene, *limits, "--code-share", "0.5", "--at", "0.8", "--out", tmp_path / "out") == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert all(len(line) <= 120 for line in printed.out.splitlines())
    for part in (
        "50 % of the goods attached",
        "limit     drift ratio of storey 1 above 1.5 %",
        ": code 10.0 %",
    ):
        assert part in printed.out
    # What it prints is what the function finds.
    found = sm.fragility.incremental_dynamic_analysis(
        sm.read_scene(scene).scene,
        sm.builtin_suite("forty"),
        [sm.fragility.LimitState("drift_ratio", 0.015, storey=1), sm.fragility.LimitState("slip", 0.05, block=1)],
        code_share=0.5,
    )
    written = pl.read_parquet(tmp_path / "out" / "fragilities.parquet")
    assert written.equals(found.fragilities)
    assert (tmp_path / "out" / "fragility.svg").is_file()


def test_building_file_has_its_code_and_its_limit(capsys: pytest.CaptureFixture[str]) -> None:
    assert command(example_file(), "--json") == 0
    document = json.loads(capsys.readouterr().out)
    assert document["models"] == ["real", "code", "attached"]
    assert [limit["name"] for limit in document["limits"]] == ["drift_ratio=0.02"]
    building = sm.read_building(example_file())
    scene = building.scene()
    # Of goods that are present by the same share on every floor, the code's fraction is so much.
    share = building.code.fraction / building.present_share
    expected = sm.fragility.incremental_dynamic_analysis(
        scene, sm.builtin_suite("forty"), sm.fragility.LimitState("drift_ratio", 0.02), code_share=share, resamples=0
    )
    code = next(row for row in document["fragilities"] if row["model"] == "code")
    assert code["median"] == pytest.approx(expected.fragility(model="code").median, rel=1e-9)
    assert command(example_file(), "--limit", "collapse", "--highest", "2") == 0
    assert "storage: 25 % of the design live load" in capsys.readouterr().out


def test_stripes_and_clouds(scene: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    stripes = ("--method", "stripes", "--intensity", "0.4,0.8,1.2,1.6", "--measure", "sa_avg", "--suite", "seven")
    assert command(scene, *stripes, "--out", tmp_path / "out", "--no-figures") == 0
    assert "stripes: 7 motions, 84 runs; intensity Sa,avg(" in capsys.readouterr().out
    assert not list((tmp_path / "out").glob("*.png"))
    assert command(scene, "--method", "cloud", "--measure", "pga", "--json") == 0
    assert json.loads(capsys.readouterr().out)["method"] == "cloud"


def test_bad_input(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for arguments, message in (
        ((scene, "--limit", "drift"), "limit of limit state must be QUANTITY=VALUE"),
        ((scene, "--limit", "drift_ratio@3=0.02"), "storey of limit state must be from 1 to 2; got 3"),
        ((scene, "--method", "stripes"), "intensities of incremental dynamic analysis must be given"),
        ((scene, "--method", "cloud", "--intensity", "1"), "--intensity of fragility must be left out"),
        ((scene, "--method", "stripes", "--highest", "1"), "--highest of fragility must be left out"),
        ((scene, "--code-share", "1.5"), "code_share of compared models must be between 0 and 1; got 1.5"),
        ((scene.parent / "none.toml",), "scene or building file must be a file that can be read"),
        ((scene, "--out", scene), "out of fragility must be a folder that can be written to"),
    ):
        assert command(*arguments) == 2
        assert message in capsys.readouterr().err
