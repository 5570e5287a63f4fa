"""Animations: what they show is what was solved, to the digits that they keep; pages, GIFs and films are sound."""

from __future__ import annotations

import base64
import json
import pickle
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import seismass as sm
from seismass.cli import main
from seismass.runs.response import EVENT_KINDS
from seismass.runs.scene_file import example_scene
from seismass.show.animation.animation import MOST_VALUES
from seismass.show.animation.picture import Picture

BUILDING = sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.24, 0.20, 0.12], heights=[3.7, 3.1, 2.9])
SCENE = sm.Scene(BUILDING, sm.blocks_on_floors([1.0, 0.5, 0.0], mu=0.2), name="storage <1>")
RECORD = sm.builtin_record("synthetic-1").scaled(1.5)
PULSE = sm.Motion(9.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 101)), 0.02)
"""Two cycles in 2 s: short, so that its film is made in no time."""


@pytest.fixture(scope="module")
def animation() -> sm.Animation:
    return sm.animate(SCENE, RECORD)


def data_of(animation: sm.Animation) -> dict[str, Any]:
    (text,) = re.findall(r'<script type="application/json">(.*?)</script>', animation.html(), re.DOTALL)
    data: dict[str, Any] = json.loads(text)
    return data


def values_of(packed: str, peak: float, columns: int) -> np.ndarray[Any, Any]:
    return (np.frombuffer(base64.b64decode(packed), "<i2") * (peak / 32767.0)).reshape(-1, columns)


def test_page_holds_both_runs_to_half_a_step_of_16_bits(animation: sm.Animation) -> None:
    """The histories of `simulate` at the same rows; a value is kept as its peak over 32767."""
    data = data_of(animation)
    scenes = (SCENE, sm.attached_scene(SCENE, 0.25))  # ASCE 7-10, 12.7.2: a quarter of storage
    assert [run["attached"] for run in data["runs"]] == [None, 0.25]
    every = round(data["step"] / RECORD.dt)
    for run, scene in zip(data["runs"], scenes, strict=True):
        response = sm.simulate(scene, RECORD, histories=every)
        for name, columns in (("drift", 3), ("slip", len(scene.blocks))):
            if columns:
                given = values_of(run[name]["values"], run[name]["peak"], columns)
                true = getattr(response, name)
                assert np.abs(given - true).max() <= 0.5001 * np.abs(true).max() / 32767.0
        assert run["rows"] == len(response.drift)


def test_ground_is_kept_as_its_range_between_rows(animation: sm.Animation) -> None:
    data = data_of(animation)
    every = round(data["step"] / RECORD.dt)
    low, high = (values_of(data["ground"][end], data["ground"]["peak"], 1)[:, 0] for end in ("low", "high"))
    samples = RECORD.acceleration / sm.STANDARD_GRAVITY
    digit = data["ground"]["peak"] / 32767.0
    assert data["ground"]["peak"] == pytest.approx(RECORD.pga_g, rel=1e-12)
    for row in (0, 1, 200, data["rows"] - 1):
        window = samples[row * every : (row + 1) * every + 1]
        assert low[row] == pytest.approx(window.min(), abs=digit)
        assert high[row] == pytest.approx(window.max(), abs=digit)


def test_events_are_those_of_the_run_at_the_next_row(animation: sm.Animation) -> None:
    data = data_of(animation)
    log = sm.simulate(SCENE, RECORD).event_log
    packed = data["runs"][0]["events"]
    row, kind, number = (
        np.frombuffer(base64.b64decode(packed[name]), dtype).tolist()
        for name, dtype in (("row", "<u4"), ("kind", "u1"), ("number", "<u2"))
    )
    step, last = data["step"], data["runs"][0]["rows"] - 1
    true = [
        (min(int(np.ceil(time / step)), last), EVENT_KINDS.index(name), int(place))
        for time, name, place in zip(log["time"], log["kind"], log["number"], strict=True)
    ]
    assert set(zip(row, kind, number, strict=True)) == set(true)
    assert len(row) == len(set(true))
    assert row == sorted(row)


def test_page_is_small_escaped_and_asks_for_nothing(animation: sm.Animation) -> None:
    page = animation.html()
    assert len(page.encode()) < 150_000
    assert "storage &lt;1&gt;" in page
    assert not re.search(r"(?:src|href)=\"(?!#|data:)", page)
    # The icon is an SVG within the page; what it names is no address that is asked.
    assert page.replace("http://www.w3.org/2000/svg", "").count("http") == page.count("http-equiv")
    assert "largest drift" in animation.shown.sentences[0]


def test_long_motion_of_a_tall_building_stays_below_a_megabyte() -> None:
    storeys = 40
    building = sm.Building.uniform(storeys, 4.0, yield_shear_over_weight=[0.05] * storeys)
    scene = sm.Scene(building, sm.blocks_on_floors([1.0] * storeys, mu=0.02))
    animation = sm.animate(scene, RECORD.motion.with_duration(120.0))
    assert animation.shown.rows * (storeys + len(scene.blocks)) <= MOST_VALUES + 2 * storeys
    assert len(animation.html().encode()) < 900_000


def test_fragments_have_identifiers_and_styles_of_their_own(animation: sm.Animation) -> None:
    fragments = [animation.fragment(), sm.animate(SCENE, RECORD, fraction=0.5).fragment()]
    identifiers = [re.findall(r'<figure class="animation" id="([^"]*)"', fragment)[0] for fragment in fragments]
    assert len(set(identifiers)) == 2
    for identifier, fragment in zip(identifiers, fragments, strict=True):
        (style,) = re.findall(r"<style>(.*?)</style>", fragment, re.DOTALL)
        assert style.strip().startswith(f"#{identifier} {{")
        assert style.strip().endswith("}")
        assert "data-autoplay" not in fragment
    scripts = {re.findall(r"<script>(.*?)</script>", fragment, re.DOTALL)[0] for fragment in fragments}
    assert len(scripts) == 1
    assert "data-autoplay" in animation.html()


def test_model_is_that_of_the_code_or_of_the_share() -> None:
    for options, label, share in (
        ({}, "ASCE/SEI 7-10 model", 0.25),
        ({"code": "nbc"}, f"{sm.codes.code_fraction('nbc').code} model", 0.6),
        ({"use": "ordinary"}, "ASCE/SEI 7-10 model", 0.0),
        ({"fraction": 1.0}, "model", 1.0),
        ({"fraction": 0.3, "code_name": "NSR-10"}, "NSR-10 model", 0.3),
    ):
        run = sm.animate(SCENE, PULSE, **options).shown.runs[1]  # type: ignore[arg-type]
        assert (run.label, run.attached) == (label, share)


def test_scenes_without_goods_or_building_are_shown_alone() -> None:
    for scene in (sm.Scene(BUILDING), sm.Scene(None, [sm.Block(0, mass=10.0, mu=0.1)])):
        animation = sm.animate(scene, PULSE)
        assert len(animation.shown.runs) == 1
        assert "</html>" in animation.html()
        assert Picture(animation).frame(1.0).size == Picture(animation).size


def test_motion_that_moves_nothing_is_shown() -> None:
    animation = sm.animate(sm.Scene(None, [sm.Block(0, mass=10.0, mu=0.1)]), sm.Motion([0.0, 0.0], 0.1))
    assert animation.shown.factor == 1.0
    assert data_of(animation)["ground"]["peak"] == 0.0
    assert Picture(animation).frame(0.1).size == Picture(animation).size


def test_collapse_ends_the_rows_and_is_said() -> None:
    scene = sm.Scene(BUILDING, sm.blocks_on_floors([1.0, 1.0, 1.0], mu=0.2), collapse_drift=0.05)
    animation = sm.animate(scene, RECORD, fraction=0.0)
    real = animation.shown.runs[0]
    assert real.response.status == "collapsed"
    assert real.rows == int(real.response.end_time / animation.shown.step) + 1 < animation.shown.rows
    assert f"storey {real.response.collapsed_storey} collapses at" in animation.shown.sentences[0]
    assert Picture(animation).frame(30.0).size == Picture(animation).size
    assert data_of(animation)["runs"][0]["rows"] == real.rows


def test_enlarged_displacements_stay_in_the_picture(animation: sm.Animation) -> None:
    sway = max(float(np.abs(run.floor_displacement).max()) for run in animation.shown.runs)
    assert animation.shown.factor > 1.0
    assert animation.shown.factor * sway <= 0.15 * 3 * 3.5


def test_response_animates_what_was_solved() -> None:
    response = pickle.loads(pickle.dumps(sm.simulate(SCENE, RECORD, duration=5.0)))
    animation = response.animate(fraction=0.3)
    assert response.scene == SCENE
    assert animation.note == RECORD.name
    assert (animation.shown.rows - 1) * animation.shown.step == pytest.approx(5.0, abs=animation.shown.step)
    assert animation.shown.runs[1].attached == 0.3
    assert animation._repr_html_().startswith('<iframe srcdoc="&lt;!doctype html')


def test_picture_changes_with_time_and_marks_what_yields(animation: sm.Animation) -> None:
    picture = Picture(animation)
    log = animation.shown.runs[0].response.event_log
    first = float(log["time"][log["kind"] == "yield"][0])
    before, after = (np.asarray(picture.frame(first + shift)).astype(int) for shift in (-0.01, 0.01))
    marked = (np.abs(np.array([0xA4, 0x27, 0x6F]) - after[:330]).sum(axis=2) < 12).sum()
    unmarked = (np.abs(np.array([0xA4, 0x27, 0x6F]) - before[:330]).sum(axis=2) < 12).sum()
    assert marked > 100 > unmarked == 0
    assert np.array_equal(np.asarray(picture.frame(0.0))[-20:], np.asarray(picture.frame(1.0))[-20:])


def test_gif_has_a_frame_per_time_step(tmp_path: Path) -> None:
    path = tmp_path / "storage.gif"
    sm.animate(SCENE, PULSE).write(path, frames_per_second=10.0, speed=0.5)
    with Image.open(path) as image:
        assert image.n_frames == 41  # 2 s at half the speed and ten a second, both ends included
        assert image.info["duration"] == 100
        assert image.info["loop"] == 0
    assert [file.name for file in tmp_path.iterdir()] == ["storage.gif"]


def test_a_gif_is_cut_and_begins_shortly_before_the_ground_shakes(tmp_path: Path) -> None:
    """A page plays the same seconds, and shows all."""
    quiet = sm.Motion([0.0] * 200 + [3.0, -3.0] * 50 + [0.0] * 100, 0.02)  # it shakes from 4 to 6 s of 8
    for given, played in (
        ({}, (3.0, 7.98)),
        ({"start": 1.0, "end": 2.0}, (1.0, 2.0)),
        ({"end": 90.0}, (3.0, 7.98)),
        ({"end": 2.0}, (0.0, 2.0)),
    ):
        animation = sm.animate(SCENE, quiet, **given)  # type: ignore[arg-type]
        assert animation.shown.played == pytest.approx(played, abs=0.05)
        assert data_of(animation)["played"] == pytest.approx(played, abs=0.05)
        path = tmp_path / "cut.gif"
        animation.write(path, frames_per_second=10.0)
        with Image.open(path) as image:
            assert image.n_frames == pytest.approx(10.0 * (played[1] - played[0]) + 1.0, abs=1.0)
    for start, end in ((-1.0, None), (2.0, 1.0), (9.0, None)):
        with pytest.raises(sm.errors.InvalidOption, match="start of animation must be from 0 and before its end"):
            sm.animate(SCENE, quiet, start=start, end=end)


def test_drifts_of_a_picture_are_those_of_its_page() -> None:
    """Over the height where it is known, else in mm."""
    known, unknown = (sm.Building.uniform(1, 0.4, yield_shear_over_weight=0.2, heights=h) for h in (4.0, None))
    for building, title, factor in (
        (known, "drift of storey 1 (% of height)", 25.0),
        (unknown, "drift of storey 1 (mm)", 1e3),
    ):
        animation = sm.animate(sm.Scene(building, [sm.Block(1, mass_ratio=1.0, mu=0.2)]), PULSE)
        (found,) = [curves for words, curves in Picture(animation)._curves() if words == title]
        peak = animation.response.peak_drift[0]
        assert np.abs(found[0][0]).max() == pytest.approx(factor * peak, rel=0.02)


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="no ffmpeg on the path: no film is made")
def test_film_is_as_long_as_the_run(tmp_path: Path) -> None:
    path = tmp_path / "storage.mp4"
    sm.animate(SCENE, PULSE).write(path)
    said = subprocess.run(["ffmpeg", "-i", str(path)], capture_output=True, text=True).stderr
    (length,) = re.findall(r"Duration: 00:00:0(\d\.\d+)", said)
    assert float(length) == pytest.approx(2.0, abs=0.1)  # to two frames, of 1/25 s
    assert "720x" in said


def test_film_without_ffmpeg_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(sm.errors.MissingPackage, match="ffmpeg of a film must be on the path"):
        sm.animate(SCENE, PULSE).write(tmp_path / "storage.mp4")
    assert list(tmp_path.iterdir()) == []


def test_film_that_ffmpeg_cannot_write_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "bin" / "ffmpeg"
    program.parent.mkdir()
    program.write_text("#!/bin/sh\necho no such encoder >&2\nexit 3\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{program.parent}:/usr/bin:/bin")
    with pytest.raises(OSError, match="ffmpeg of a film must end well; got no such encoder"):
        sm.animate(SCENE, PULSE).write(tmp_path / "storage.mp4")
    assert [file.name for file in tmp_path.iterdir()] == ["bin"]


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("a.webm", {}, "suffix of animation must be one of .html, .gif, .mp4; got '.webm'"),
        ("a.html", {"speed": 2.0}, "must be left out for a page"),
        ("a.gif", {"speed": 0.0}, "speed of animation must be a positive number; got 0"),
        ("a.gif", {"frames_per_second": 80.0}, "frames_per_second of animation must be at most 50; got 80"),
    ],
)
def test_what_cannot_be_written_is_refused(tmp_path: Path, name: str, options: dict[str, float], message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=re.escape(message)):
        sm.animate(SCENE, PULSE).write(tmp_path / name, **options)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("fraction", [-0.1, 1.1, float("nan")])
def test_share_out_of_range_is_refused(fraction: float) -> None:
    with pytest.raises(sm.errors.InvalidOption, match="fraction of animation must be between 0 and 1"):
        sm.animate(SCENE, PULSE, fraction=fraction)


def test_command_writes_the_example(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["animate", "--example"]) == 0
    assert "<h1>Three storeys of storage</h1>" in Path("storage.html").read_text(encoding="utf-8")
    printed = capsys.readouterr().out
    file = sm.read_scene(example_scene())
    response = sm.simulate(file.scene, file.motion)
    assert f"largest drift {1e3 * response.peak_drift.max():.3g} mm in storey 1" in printed
    assert "storage.html: " in printed
    assert response.counts["yield"] > 0
    assert response.peak_slip.min() > 0.01  # both blocks slide more than a centimetre, so that there is a thing to see


def test_command_takes_a_scene_file_and_refuses_contradictions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    scene = {
        "building": {"storeys": 1, "period": 0.3, "yield_shear_over_weight": 0.2},
        "blocks": [{"floor": 1, "mass_ratio": 1.0, "mu": 0.1}],
        "motion": {"acceleration": [0.0, 5.0, -5.0, 0.0, 0.0], "dt": 0.1},
    }
    Path("one.json").write_text(json.dumps(scene))
    assert main(["animate", "one.json", "--code", "nbc", "--out", "one.gif", "--fps", "5"]) == 0
    assert "60 % of the goods attached" in capsys.readouterr().out
    assert Path("one.gif").read_bytes().startswith(b"GIF89a")
    assert main(["animate", "one.json", "--code", "nbc", "--code-share", "0.5"]) == 2
    assert main(["animate", "one.json", "--out", "none/one.html"]) == 2
    assert sorted(file.name for file in tmp_path.iterdir()) == ["one.gif", "one.json"]


def test_command_attaches_the_share_of_a_code_as_the_building_file_with_that_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A code counts a fraction of the design live load, of which 0.8 is there."""
    monkeypatch.chdir(tmp_path)
    code = '[code]\nid = "{}"\nuse = "storage"\n'
    building = """
[site]
sds_g = 1.0
sd1_g = 0.6
[building]
period_s = 0.4
height_m = 4
area_m2 = 500
dead_load_kpa = 5
design = true
R = 4
[goods]
live_load_kpa = 6
occupied = 0.8
mu = 0.2
[[storeys]]
"""
    Path("own.toml").write_text(building + code.format("asce7-10"))
    for name in ("asce7-10", "ec8", "nbc"):
        Path(f"{name}.toml").write_text(building + code.format(name))
        assert main(["animate", "own.toml", "--code", name, "--factor", "1"]) == 0
        by_option = capsys.readouterr().out.splitlines()
        assert main(["animate", f"{name}.toml", "--factor", "1"]) == 0
        by_file = capsys.readouterr().out.splitlines()
        assert "of the goods attached" in " ".join(by_option)
        assert by_option[:-1] == by_file[:-1], name


def racked() -> sm.Scene:
    """Two racks, one on the ground; a wall; stops on a floor and on a level; fixed goods."""
    frame = sm.Building([2e4] * 2, 2e7, yield_shear=[1e5, 6e4], heights=3.5)
    building = sm.design.Wall([3.5, 3.5], 2e8).beside(frame)
    rail = sm.Stops([0.03, np.inf], stiffness=2e6)
    goods = [
        sm.RackBlock(1, mass=2000.0, mu=0.2),
        sm.RackBlock(2, mass=500.0, fixed=True),
        sm.RackBlock(2, mass=500.0, mu=0.1, stops=rail),
    ]
    racks = [sm.Rack(floor, levels=2, level_mass=300.0, period=0.5, yield_shear=8e3, blocks=goods) for floor in (2, 0)]
    return sm.Scene(building, [sm.Block(1, mass=8000.0, mu=0.1, stops=rail)], racks=racks, name="racks")


def test_racks_levels_and_stops_are_on_the_page() -> None:
    """Each level's drift to half a step of 16 bits, goods by rack and level, stops, and the wall."""
    scene = racked()
    animation = sm.animate(scene, RECORD)
    data = data_of(animation)
    real, model = data["runs"]
    response = sm.simulate(scene, RECORD, histories=round(data["step"] / RECORD.dt))
    given = values_of(real["racks"]["values"], real["racks"]["peak"], 4)
    true = np.hstack(response.rack_drift)
    assert np.abs(given - true).max() <= 0.5001 * np.abs(true).max() / 32767.0
    assert values_of(model["racks"]["values"], model["racks"]["peak"], 1).size == 0
    size = pytest.approx(0.5)  # the root of 2000 over 8000 kg
    quarter = pytest.approx(0.25)
    assert data["blocks"] == [
        {"floor": 1, "size": 1.0, "stops": [0.03, None]},
        {"rack": 1, "level": 1, "size": size},
        {"rack": 1, "level": 2, "size": quarter, "stops": [0.03, None]},
        {"rack": 2, "level": 1, "size": size},
        {"rack": 2, "level": 2, "size": quarter, "stops": [0.03, None]},
    ]
    fixed = [{"level": 2, "size": quarter}]
    assert data["racks"] == [{"floor": 2, "levels": 2, "fixed": fixed}, {"floor": 0, "levels": 2, "fixed": fixed}]
    assert data["walls"]
    page = animation.html()
    for said in ("storey or level yields", "goods fixed to racks", "walls, elastic", "</svg>stops</li>"):
        assert said in page
    peak = max(levels.max() for levels in response.peak_rack_drift)
    assert f"largest rack drift {1e3 * peak:.3g} mm" in animation.shown.sentences[0]
    assert f"stops hit at up to {response.peak_contact_velocity.max():.3g} m/s" in animation.shown.sentences[0]
    assert not any(said in sm.animate(SCENE, RECORD).html() for said in ("level yields", "</svg>stops</li>"))
    # The model has the racks lumped on their floor, so its floor 2 has their frame and a quarter of their goods.
    attached = animation.shown.runs[1].response.scene
    assert not attached.racks
    assert attached.building.mass[1] == pytest.approx(2e4 + 600.0 + 0.25 * 3000.0)


def test_racks_enlarged_stay_in_the_picture() -> None:
    """No level goes farther than a floor may: 0.15 of the height of the building, with the factor of the page."""
    shown = sm.animate(racked(), RECORD).shown
    real = shown.runs[0]
    floors = np.hstack([np.zeros((real.rows, 1)), real.floor_displacement])
    over_ground = floors[:, [2]] + np.cumsum(real.response.rack_drift[0], axis=1)
    np.testing.assert_allclose(real.rack_displacement[:, :2], over_ground, rtol=1e-14)
    assert shown.factor * np.abs(real.rack_displacement).max() <= 0.15 * 7.0


def test_frames_show_racks_that_sway_and_yield() -> None:
    """A level that yields is drawn in the colour of yielding; here nothing else yields."""
    scene = racked()
    animation = sm.animate(scene.replace(building=scene.building.replace(yield_shear=np.inf)), RECORD)
    picture = Picture(animation)
    assert picture.size == (720, 330 + 4 * 84 + 26)  # ground, storeys, racks, blocks
    log = animation.shown.runs[0].response.event_log
    first = float(log["time"][(log["kind"] == "yield") & (log["number"] > 2)][0])
    quiet, moved = (np.asarray(picture.frame(at))[60:330, :360].astype(int) for at in (0.0, first + 1e-6))
    purple = (np.abs(moved - np.array([0xA4, 0x27, 0x6F])).max(axis=2) < 40).sum()
    assert purple > 20
    assert not (np.abs(quiet - np.array([0xA4, 0x27, 0x6F])).max(axis=2) < 40).any()
    alone = Picture(sm.animate(sm.Scene(None, racks=racked().racks[1:]), RECORD))
    assert alone.size == (720, 330 + 3 * 84 + 26)
    assert np.asarray(alone.frame(6.0)).std() > 0.0
