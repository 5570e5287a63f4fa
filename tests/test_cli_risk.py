"""`seismass risk`: scene and building files, what it writes, and how it ends."""

from __future__ import annotations

import json
from pathlib import Path

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
mu = 0.15
[motion]
acceleration = [0.0, 1.0, 0.0]
dt = 0.01
"""
COARSE = ("--share", "0,0.5,1", "--suite", "seven")


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    scene, hazard = tmp_path / "scene.toml", tmp_path / "hazard.csv"
    scene.write_text(SCENE)
    hazard.write_text("Sa (g),annual rate\n0.05,0.04\n0.3,2e-3\n1,1e-4\n4,4e-7\n")
    return scene, hazard


def command(*arguments: object) -> int:
    return main(["risk", *map(str, arguments)])


def test_prints_what_the_function_finds(
    files: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene, hazard = files
    options = ("--limit", "drift_ratio=0.01", "--other-limit", "0.02", "--code-share", "0.5", "--hazard-period", "0.5")
    arguments = (scene, "--hazard", hazard, *options, *COARSE)
    assert command(*arguments, "--out", tmp_path / "out") == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert all(len(line) <= 120 for line in printed.out.splitlines())
    found = sm.risk.risk_targeted_share(
        sm.read_scene(scene).scene,
        sm.builtin_suite("seven"),
        sm.risk.HazardCurve.from_csv(hazard, period=0.5),
        0.01,
        shares=[0.0, 0.5, 1.0],
        other_limits=[0.02],
        code_share=0.5,
    )
    assert found.text in printed.out
    assert "scaling              each motion to each intensity\n" in printed.out
    assert "Sa(0.5 s)" in printed.out
    written = json.loads((tmp_path / "out" / "risk.json").read_text(encoding="utf-8"))
    assert written["value"] == found.value
    assert command(*arguments, "--json") == 0
    assert json.loads(capsys.readouterr().out) == written


def test_building_file_gives_limit_and_share(files: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    arguments = (example_file(), "--hazard", files[1], "--other-limit", "0.01", *COARSE, "--json")
    assert command(*arguments) == 0
    document = json.loads(capsys.readouterr().out)
    building = sm.read_building(example_file())
    assert document["limit"]["value"] == building.drift_limit
    # The code counts a fraction of the design live load, the share is one of the goods present.
    assert document["code_share"] == pytest.approx(building.code.fraction / building.present_share, rel=1e-14)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            ("--limit", "slip=0.1"),
            "limit of risk-targeted share must be a number, or a LimitState of drift or drift_ratio",
        ),
        (
            ("--hazard-period", "0.5", "--measure-period", "0.4"),
            "must be the period of the hazard curve, 0.5 s; got 0.4 s",
        ),
        (("--share", "0.2,1"), "fractions of risk-targeted share must be a list in increasing order"),
    ],
)
def test_bad_input(
    files: tuple[Path, Path], capsys: pytest.CaptureFixture[str], options: tuple[str, ...], message: str
) -> None:
    assert command(files[0], "--hazard", files[1], *options) == 2
    assert message in capsys.readouterr().err


def test_hazard_files_that_cannot_be_read(files: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert command(files[0], "--hazard", files[0].with_name("missing.csv")) == 2
    assert "path of hazard curve must be a file of text that can be read" in capsys.readouterr().err
    files[1].write_text("0.1,1e-2\n0.2,2e-2\n")
    assert command(files[0], "--hazard", files[1]) == 2
    assert "annual rate of hazard.csv, line 2, must be below that of the point before" in capsys.readouterr().err
