"""`seismass slip`: scene and building files, blocks one by one, scaling, what it writes, and how it ends."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main
from seismass.commands.slip import parse_clearance

SCENE = """
[building]
storeys = 2
period = 0.4
yield_shear_over_weight = [0.25, 0.15]
[[blocks]]
floor = 1
mass_ratio = 1.0
mu = 0.1
[[blocks]]
floor = 0
mass = 10.0
mu = 0.3
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
    return main(["slip", *map(str, arguments)])


def test_prints_what_the_function_finds(scene: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = ("--clearance", "1=0.05", "--clearance", "2=0.2,", "--size", "0.3x1.2", "--factor", "2")
    assert command(scene, *options, "--out", tmp_path / "out") == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert all(len(line) <= 120 for line in printed.out.splitlines())
    found = sm.slip.slip_demand(
        sm.read_scene(scene).scene,
        [record.scaled(2.0) for record in sm.builtin_suite("forty")],
        clearance=[0.05, sm.slip.Clearance(plus=0.2)],
        sizes=sm.slip.BlockSize(0.3, 1.2),
    )
    assert found.text in printed.out
    assert "motions x 2" in printed.out
    written = json.loads((tmp_path / "out" / "slip_demand.json").read_text(encoding="utf-8"))
    assert written["metadata"]["inputs_sha256"] == found.metadata["inputs_sha256"]
    assert command(scene, *options, "--json") == 0
    assert json.loads(capsys.readouterr().out) == written


def test_building_file_and_target(capsys: pytest.CaptureFixture[str]) -> None:
    options = ("--sds", "1.0", "--sd1", "0.6", "--period", "0.6", "--json")
    assert command(example_file(), *options) == 0
    document = json.loads(capsys.readouterr().out)
    suite = sm.builtin_suite("forty")
    factors = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7(1.0, 0.6), period=0.6, between=False).factors
    motions = [record.scaled(float(factor)) for record, factor in zip(suite, factors, strict=True)]
    expected = sm.slip.slip_demand(sm.read_building(example_file()).scene(), motions)
    assert document["metadata"]["inputs_sha256"] == expected.metadata["inputs_sha256"]


def test_clearances_from_text() -> None:
    assert parse_clearance("0.3") == sm.slip.Clearance(0.3, 0.3)
    assert parse_clearance("0.3,0.1") == sm.slip.Clearance(0.3, 0.1)
    assert parse_clearance(",0.1") == sm.slip.Clearance(None, 0.1)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            ("--clearance", "a"),
            "--clearance of slip must be a distance, or PLUS,MINUS of which one may be empty (m); got",
        ),
        (("--clearance", ","), "--clearance of slip must be a distance"),
        (("--clearance", "3=0.1"), "--clearance of slip must be of a block from 1 to 2; got 3=0.1"),
        (("--size", "1x1", "--size", "2x2"), "--size of slip must be given once for a block; got 2x2"),
        (("--fragility",), "clearance of slip demand must be given for a fragility"),
        (("--measure", "pga"), "--measure of slip must be left out where --fragility is not given; got pga"),
        (("--period", "1"), "--period of slip must be left out where motions are not scaled to a target; got 1"),
        (("--sds", "1"), "site spectrum of slip must be given by --sds and --sd1 together; got --sds alone"),
        (
            ("--factor", "2", "--sds", "1", "--sd1", "0.6"),
            "--factor of slip must be left out where a target is given; got 2",
        ),
    ],
)
def test_bad_input(scene: Path, capsys: pytest.CaptureFixture[str], options: tuple[str, ...], message: str) -> None:
    assert command(scene, *options) == 2
    assert message in capsys.readouterr().err
