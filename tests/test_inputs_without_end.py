"""Inputs that name devices or would cost hours: refused at once, in one sentence."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.base.files import read_file
from seismass.base.folders import read_folder
from seismass.base.limits import MOST_KEY_PARTS
from seismass.cli import main

SCENE = """
[[blocks]]
floor = 0
mass = 1.0
mu = 0.1
[motion]
acceleration = [0.2, 0.2]
unit = "g"
"""
CAMPAIGN = """
[motions]
builtin = "seven"
[building]
storeys = 2
period = 0.4
yield_shear_over_weight = [0.2, 0.1]
"""
READERS: dict[str, Callable[[Path], Any]] = {
    "scene.toml": sm.read_scene,
    "scene.json": sm.read_scene,
    "building.toml": sm.assess,
    "campaign.toml": sm.campaign.read_campaign,
    "record.AT2": sm.read_record,
    "suite.csv": sm.read_suite,
    "target.csv": sm.TargetSpectrum.from_csv,
    "hazard.csv": sm.risk.HazardCurve.from_csv,
    "manifest.json": lambda path: sm.campaign.CampaignFolder(path.parent),
    "study.json": lambda path: read_folder(path.parent, ["study.json"]),
    "assessment.json": lambda path: read_folder(path.parent, ["assessment.json"]),
}


@pytest.mark.skipif(sys.platform != "linux", reason="devices of Linux")
@pytest.mark.parametrize("device", ["/dev/zero", "/dev/urandom", "pipe"])
@pytest.mark.parametrize("name", READERS)
def test_no_reader_opens_a_device_or_a_pipe(tmp_path: Path, name: str, device: str) -> None:
    path = tmp_path / name
    if device == "pipe":
        os.mkfifo(path)
    else:
        path.symlink_to(device)
    with pytest.raises((sm.SeismassError, OSError), match="no regular file"):
        READERS[name](path)


def test_files_that_a_file_names_are_read_in_the_same_way(tmp_path: Path) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.replace('acceleration = [0.2, 0.2]\nunit = "g"', 'file = "/dev/zero"'))
    with pytest.raises(sm.errors.RecordFormatError, match="no regular file"):
        sm.read_scene(scene)
    file = tmp_path / "campaign.toml"
    for target in ("/dev/zero", "asce7-22:/dev/zero", "mean:/dev/zero"):
        scaled = f'builtin = "seven"\nscaling = "asce7-10"\ntarget = "{target}"'
        file.write_text(CAMPAIGN.replace('builtin = "seven"', scaled) + "[grid]\nmu = 0.1\nmass_ratio = 1.0\n")
        with pytest.raises(sm.SeismassError, match="no regular file"):
            sm.campaign.read_campaign(file)


def test_a_file_is_read_up_to_its_size(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"abc")
    assert read_file(path, 3) == b"abc"
    with pytest.raises(OSError, match="larger than 2 bytes"):
        read_file(path, 2)
    with pytest.raises(OSError, match=r"no regular file|Is a directory"):
        read_file(tmp_path)


def duplicated(count: int) -> str:
    return "{" + ",".join(f'"k{number}": 1' for number in (*range(count), count - 1)) + "}"


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.json", duplicated(200_000), "k199999 of a.json must be given once"),
        ("a.toml", ".".join("a" * 100_000) + " = 1", f"a key of more than {MOST_KEY_PARTS} parts"),
        ("a.toml", "[" + " . ".join(['"a"'] * 100_000) + "]", f"a key of more than {MOST_KEY_PARTS} parts"),
        ("a.toml", "a = {" + ".".join("b" * 100_000) + " = 1}", f"a key of more than {MOST_KEY_PARTS} parts"),
        ("a.toml", "a = [" + "1.0, " * 1_000_000 + "]", "larger than 4 MB"),
        ("a.toml", '"' * 4_000_000, "valid TOML"),
        ("a.toml", "a" * 4_000_000 + " = 1", "an unknown key"),
        ("a.json", "[" * 1_000_000, "valid JSON"),
    ],
)
def test_no_input_takes_the_square_of_its_length(tmp_path: Path, name: str, text: str, said: str) -> None:
    """Where its reader is quadratic, each takes minutes."""
    (tmp_path / name).write_text(text)
    with pytest.raises(sm.errors.InvalidSceneFile, match=said) as raised:
        sm.read_scene(tmp_path / name)
    assert len(str(raised.value)) < 1000


def test_keys_of_fifty_parts_are_read(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text(".".join("a" * MOST_KEY_PARTS) + " = 1")
    with pytest.raises(sm.errors.InvalidSceneFile, match=r"a of a\.toml must be one of the keys"):
        sm.read_scene(path)
    path.write_text(f'note = "{"word. " * 1000}"\n' + SCENE + "dt = 0.1\n")
    assert sm.read_scene(path).note.count("word") == 1000


def test_a_record_of_one_endless_line_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "record.txt"
    path.write_text("1.0 " * 1_100_000)
    with pytest.raises(sm.errors.RecordFormatError, match="must be at most 4194304 bytes; got more"):
        sm.read_record(path)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("dt = 999999", "dt of motion of scene.toml must be a step in seconds by which the motion ends before 10000 s"),
        ("dt = 20000", "got 20000 for 2 samples"),
        ("dt = 0.01\ndt_scale = 1e9", "a step in seconds"),
    ],
)
def test_a_motion_of_hours_is_refused(tmp_path: Path, lines: str, said: str) -> None:
    (tmp_path / "scene.toml").write_text(SCENE + lines)
    with pytest.raises(sm.errors.InvalidMotion, match=said):
        sm.read_scene(tmp_path / "scene.toml")


def test_a_duration_of_days_is_refused(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text("duration = 999999\n" + SCENE + "dt = 0.01")
    with pytest.raises(sm.errors.InvalidMotion, match="duration of motion must be at most 10000 s; got 999999 s at"):
        sm.read_scene(tmp_path / "scene.toml")
    motion = sm.Motion([0.0, 1.0], 1e-6)
    with pytest.raises(sm.errors.InvalidMotion, match="duration of motion must be at most 10 s"):  # 10^7 samples
        motion.with_duration(11.0)
    long = sm.Motion(np.ones(3), 1e4)
    assert long.with_duration(2e4) == long  # what is there is no matter of cost


@pytest.mark.parametrize(
    ("grid", "said"),
    [
        (
            "[grid]\nmu = { from = 0.1, to = 1.0, count = 1000000000000 }",
            "count of .* must be at most 16777216",
        ),
        (
            '[grid]\nmu = { distribution = "uniform", low = 0.1, high = 0.5 }\n'
            '[sample]\nsamples = 1000000000\nmethod = "random"',
            "samples of sample must be at most 67108864",
        ),
    ],
)
def test_axes_beyond_memory_are_refused(tmp_path: Path, grid: str, said: str) -> None:
    (tmp_path / "c.toml").write_text(CAMPAIGN + grid)
    with pytest.raises(sm.SeismassError, match=said):
        sm.campaign.read_campaign(tmp_path / "c.toml")


def test_a_campaign_of_months_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, out = tmp_path / "c.toml", tmp_path / "out"
    axis = "{ from = 0.1, to = 1.0, count = 50000 }"
    file.write_text(CAMPAIGN + f"[grid]\nmass_ratio = 1.0\nmu = {axis}\nscale = {axis}\n")
    assert main(["campaign", str(file), "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert "time of campaign must be at most a day unless --long is given; got about" in said
    assert "GB for 1.75e+10 runs" in said  # 50 000 x 50 000 scenes under seven motions
    assert not out.exists()
