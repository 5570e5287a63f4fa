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


def test_a_frame_is_drawn_to_scale() -> None:
    """Between two rows, enlarged: floors from the side, and the floor, goods and path from above."""
    animation = sm.animation.animate_plane(SCENE, PAIR, floor=2)  # type: ignore[arg-type]
    factor = animation.factor
    assert factor != 1.0
    picture, boxes, lines = PlanePicture(animation), [], []
    picture._box = lambda draw, box, *colours: boxes.append(tuple(map(float, box)))  # type: ignore[method-assign]
    picture._line = lambda draw, points, *style: lines.append(np.array(points))  # type: ignore[method-assign]
    place = 20.3
    picture.frame(place * animation.step)
    rows = animation.floor_displacement, animation.response.slip
    sway, slip = (0.7 * each[20] + 0.3 * each[21] for each in rows)
    # From the side: the ground at the foot of the lowest columns, two floors 3 m and 6 m above it, then two goods.
    columns = [line for line in lines if line.shape == (2, 2)][1:5]
    ground = columns[0][0, 1]
    middle = 0.5 * (columns[0][0, 0] + columns[1][0, 0])
    floors, goods = boxes[:2], boxes[2:4]
    scale = (ground - floors[1][1]) / 6.0
    assert ground - floors[0][1] == pytest.approx(3.0 * scale)
    for number, (left, _, right, _) in enumerate(floors):
        assert 0.5 * (left + right) - middle == pytest.approx(factor * scale * sway[number, 0], rel=1e-9, abs=1e-9)
        x0, y0, x1, y1 = goods[number]
        assert y1 == pytest.approx(floors[number][1])
        assert y1 - y0 == pytest.approx(x1 - x0)
        moved = factor * scale * (sway[number, 0] + slip[number, 0])
        assert 0.5 * (x0 + x1) - middle == pytest.approx(moved, rel=1e-9, abs=1e-9)
    # From above: the floor at rest, the floor, and its goods; y is upward.
    rest, floor, crate = (np.array(box).reshape(2, 2) for box in boxes[4:7])
    per_metre = (rest[1, 0] - rest[0, 0]) / 6.0
    assert rest[1, 1] - rest[0, 1] == pytest.approx(rest[1, 0] - rest[0, 0])
    up = np.array([1.0, -1.0])
    np.testing.assert_allclose(floor - rest, np.tile(factor * per_metre * sway[1] * up, (2, 1)), atol=1e-9)
    np.testing.assert_allclose(crate.mean(axis=0) - floor.mean(axis=0), factor * per_metre * slip[1] * up, atol=1e-9)
    path = next(line for line in lines if len(line) == 22)
    walked = np.vstack([animation.response.slip[:21, 1], slip[1]])
    np.testing.assert_allclose(path, floor.mean(axis=0) + factor * per_metre * walked * up, atol=1e-9)


@pytest.mark.parametrize("count", [1, 2, 3, 5, 13, 30])
def test_goods_of_a_floor_are_drawn_on_it_beside_each_other(count: int) -> None:
    """From above, at rest: no piece reaches over the edge of its floor or over another; rows are as many as needed."""
    goods = [sm.Block(1, mass=9.0, mu=0.2)] * count
    scene = sm.Scene(BUILDING, [*goods, sm.Block(2, mass=9.0, mu=0.2)], other_direction=True)
    animation = sm.animation.animate_plane(scene, PAIR, floor=1, end=0.1)  # type: ignore[arg-type]
    picture, boxes = PlanePicture(animation), []
    picture._box = lambda draw, box, *colours: boxes.append(np.array(box, dtype=float))  # type: ignore[method-assign]
    picture._line = picture._text = lambda *given, **options: None  # type: ignore[method-assign]
    picture._from_above(None, np.zeros((2, 2)), np.zeros((count + 1, 2)), 0)  # type: ignore[arg-type]
    _, floor, *pieces = boxes
    assert len(pieces) == count
    for number, piece in enumerate(pieces):
        assert (piece[:2] >= floor[:2]).all()
        assert (piece[2:] <= floor[2:]).all()
        for other in pieces[:number]:
            assert (piece[:2] >= other[2:]).any() or (other[:2] >= piece[2:]).any()
    sides = {round(float(piece[2] - piece[0]), 9) for piece in pieces}
    assert len(sides) == 1
    centres = np.array(pieces)[:, :2]
    across, along = (len(np.unique(centres[:, axis].round(9))) for axis in (0, 1))
    assert (across - 1) ** 2 < count <= across**2
    assert (along - 1) * across < count <= along * across


def test_histories_stand_in_their_panels() -> None:
    """Below the scenes, each in 84 pixels, the axis of time in the last 26: curves from zero to the largest length."""
    scene = sm.Scene(BUILDING, [sm.Block(1, mass=90.0, mu=0.1)] * 5, other_direction=True)
    animation = sm.animation.animate_plane(scene, PAIR)  # type: ignore[arg-type]
    picture, lines, words = PlanePicture(animation), [], {}
    assert picture.size == (720, 330 + 2 * 84 + 26)
    picture._line = lambda draw, points, colour, width: lines.append(np.array(points))  # type: ignore[method-assign]
    picture._text = lambda draw, place, text, *style: words.setdefault(text, []).append(place)  # type: ignore[method-assign]
    picture._histories()
    run = animation.response
    curves = [line for line in lines if len(line) == animation.rows]
    assert (len(curves), len(lines)) == (2 + 4, 2 + 4 + 2 * 2)  # four of five blocks, and two lines across each panel
    for place, (values, title) in enumerate(((run.drift, "length of drift (mm)"), (run.slip, "length of slip (mm)"))):
        top, low = 330 + 84 * place + 18, 330 + 84 * (place + 1) - 6
        lengths = np.hypot(values[..., 0], values[..., 1])[: animation.rows, :4]
        zero, highest = [line for line in lines if len(line) == 2][2 * place : 2 * place + 2]
        assert (zero[:, 1].tolist(), highest[:, 1].tolist()) == ([low] * 2, [top] * 2)
        assert words[title] == [(52, top - 14)]
        assert (46, top) in words[f"{1e3 * lengths.max():.3g}"]
        for number, curve in enumerate(curves[2 * place :][: lengths.shape[1]]):
            np.testing.assert_allclose(curve[:, 0], np.linspace(52, 708, animation.rows), rtol=1e-12)
            np.testing.assert_allclose(low - curve[:, 1], (low - top) * lengths[:, number] / lengths.max(), atol=1e-9)
    assert words["0"][:2] == [(46, 330 + 84 - 6), (46, 330 + 168 - 6)]
    assert [words[f"block {number}"] for number in (1, 2, 3, 4)] == [[(190 + 80 * n, 418)] for n in range(4)]
    assert "block 5" not in words
