"""The animation in two directions: a floor from above beside the building from the side."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import seismass as sm
from seismass.cli import main
from seismass.show.animation.plane_picture import PlanePicture

BUILDING = sm.Building.uniform(2, 0.4, mass=1e3, heights=3.0)
SCENE = sm.Scene(BUILDING, sm.blocks_on_floors([0.2, 0.1], mu=[0.1, 0.3]), other_direction=True)
PAIR = tuple(sm.Motion(a * np.sin(12.0 * np.arange(0.0, 1.0, 0.02)), dt=0.02) for a in (3.0, 2.0))


def test_rows_are_those_of_the_run() -> None:
    animation = sm.animation.animate_plane(SCENE, PAIR)  # type: ignore[arg-type]
    run = sm.simulate(SCENE, PAIR, histories=2)  # type: ignore[call-overload]
    np.testing.assert_array_equal(animation.floor_displacement, np.cumsum(run.drift, axis=1))
    assert animation.floor == SCENE.block_floor[int(np.argmax(run.peak_slip[:, 2]))]
    block = int(np.argmax(run.peak_slip[:, 2]))
    assert f"largest slip {1e3 * run.peak_slip[block, 2]:.3g} mm of block {block + 1}" in animation.sentences[0]


def test_frames_and_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    animation = sm.animation.animate_plane(SCENE, PAIR, floor=2)  # type: ignore[arg-type]
    picture = PlanePicture(animation)
    first, later = (np.asarray(picture.frame(time)) for time in (0.0, 0.6))
    assert first.shape == (picture.size[1], picture.size[0], 3)
    assert np.any(first != later)
    animation.write(tmp_path / "two.gif", frames_per_second=4)
    with Image.open(tmp_path / "two.gif") as gif:
        assert gif.n_frames == 5  # at 0, 0.25, 0.5, 0.75 s and the last row, 0.96 s
    with pytest.raises(sm.errors.InvalidOption, match=r"one of \.gif, \.mp4 in two directions"):
        animation.write(tmp_path / "two.html")
    with pytest.raises(sm.errors.InvalidScene, match="animate takes one direction"):
        sm.animation.animate_plane(sm.Scene(BUILDING), PAIR)  # type: ignore[arg-type]
    scene = tmp_path / "crate.toml"
    motion = "acceleration = [2.0, 2.0, 0.0]\ndt = 0.1\n"
    goods = "[other_direction]\n[[blocks]]\nfloor = 0\nmass = 100.0\nmu = 0.1\n"
    scene.write_text(f"{goods}[motion]\n{motion}[other_motion]\n{motion}")
    assert main(["animate", str(scene), "--out", str(tmp_path / "crate.gif")]) == 0
    assert "of block 1 after a path of" in capsys.readouterr().out
