"""Scene files: every key of TOML and JSON, and every refusal by its name and place."""

from __future__ import annotations

import inspect
import json
import math
import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass._kernel import MAX_STOREYS
from seismass.model.springs import SHAPE_FIELDS, SPRING_FIELDS
from seismass.runs.scene_file import scene_without_motion
from seismass.runs.scene_goods import KEYS

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "scene_file.md").read_text(encoding="utf-8")

Write = Callable[..., Path]

MOTION: dict[str, Any] = {"acceleration": [0.0, 0.1, -0.2, 0.0], "dt": 0.01, "unit": "g"}
BUILDING: dict[str, Any] = {"mass": [1e3, 2e3], "stiffness": [5e5, 4e5]}
BLOCK: dict[str, Any] = {"floor": 1, "mass": 1e3, "mu": 0.3}


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def write(**top: Any) -> Path:
        path = tmp_path / "scene.json"
        path.write_text(json.dumps({"building": BUILDING, "motion": MOTION} | top))
        return path

    return write


def test_keys_of_the_reference_results(write: Write) -> None:
    building = BUILDING | {
        "yield_shear": [7e3, None],
        "overstrength": 1.5,
        "second_slope": 0.4,
        "third_slope": 0.02,
        "damping": {"kind": "rayleigh", "ratio": 0.03, "modes": [1, 2]},
        "geometric_stiffness": [2e4, 1e4],
    }
    file = sm.read_scene(
        write(
            name="both",
            note="a note",
            building=building,
            blocks=[{"floor": 2, "mass": 300.0, "mu_s": 0.4, "mu_k": 0.3}],
            motion=MOTION | {"scale": 2.0, "dt_scale": 0.5},
            vertical_motion={"acceleration": [0.0, 1.0, 2.0], "dt": 0.005},
            duration=0.005,
            result={"anything": 1},
        )
    )
    assert file.scene == sm.Scene(
        sm.Building(
            [1e3, 2e3],
            [5e5, 4e5],
            yield_shear=[7e3, math.inf],
            overstrength=1.5,
            second_slope=0.4,
            third_slope=0.02,
            damping=sm.Rayleigh(0.03, (1, 2)),
            geometric_stiffness=[2e4, 1e4],
        ),
        [sm.Block(2, mass=300.0, mu_s=0.4, mu_k=0.3)],
    )
    assert (file.name, file.note, file.duration) == ("both", "a note", 0.005)
    assert file.scene.name == "both"
    # Both components end with the shorter, then with the duration.
    assert file.motion.dt == 0.005
    assert file.motion.acceleration == pytest.approx([0.0, 0.2 * 9.80665])
    assert file.motion.vertical is not None
    assert file.motion.vertical.tolist() == [0.0, 1.0]


def test_convenient_keys_in_toml(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(
        """
        collapse_drift = 0.3
        [building]
        storeys = 3
        period = 0.6
        mass = 2000
        yield_shear_over_weight = [0.24, 0.2, inf]
        heights = 3.5
        gravity_load = [3e3, 2e3, 1e3]
        damping = 0.03
        [[blocks]]
        floor = 1
        mass_ratio = 0.5
        mu = 0.3
        velocity = 0.1
        [[blocks]]
        floor = 0
        mass = 10.0
        mu_s = 0.3
        [initial]
        drift = [1e-3, 0, 0]
        velocity = 0.2
        [motion]
        acceleration = [0, 1, 0]
        dt = 0.01
        """
    )
    file = sm.read_scene(path)
    building = sm.Building.uniform(
        3,
        0.6,
        mass=2000.0,
        yield_shear_over_weight=[0.24, 0.2, math.inf],
        heights=3.5,
        gravity_load=[3e3, 2e3, 1e3],
        damping=0.03,
    )
    blocks = [sm.Block(1, mass_ratio=0.5, mu=0.3, velocity=0.1), sm.Block(0, mass=10.0, mu=0.3)]
    assert file.scene == sm.Scene(
        building, blocks, initial_drift=[1e-3, 0, 0], initial_velocity=0.2, collapse_drift=0.3
    )
    assert file.motion == sm.Motion([0.0, 1.0, 0.0], 0.01)


def test_defaults(write: Write) -> None:
    bare = sm.read_scene(write()).scene
    assert bare.building == sm.Building([1e3, 2e3], [5e5, 4e5], damping=0.05)
    assert bare.building is not None
    assert bare.building.second_slope.tolist() == [0.05, 0.05]


@pytest.mark.parametrize(
    ("given", "same"),
    [
        ({"mass": 1e3, "stiffness": 5e5, "storeys": 2}, {"mass": [1e3, 1e3], "stiffness": 5e5}),
        (
            {"mass": 1e3, "stiffness": 5e5, "yield_shear": [1.0, 2.0]},
            {"mass": [1e3] * 2, "stiffness": 5e5, "yield_shear": [1.0, 2.0]},
        ),
        (
            {"mass": 1e3, "stiffness": 5e5, "yield_shear_over_weight": [0.1, 0.2]},
            {"mass": 1e3, "stiffness": 5e5, "yield_shear": [1961.33, 3922.66]},
        ),
        (
            {"mass": 1e3, "stiffness": 5e5, "storeys": 3, "yield_shear_over_weight": [0.24, 0.20, 0.12]},
            {"mass": 1e3, "stiffness": 5e5, "yield_shear": [3e3 * 9.80665 * part for part in (0.24, 0.20, 0.12)]},
        ),
        ({**BUILDING, "yield_shear_over_weight": 0.1}, {**BUILDING, "yield_shear": 0.1 * 3e3 * 9.80665}),
        ({**BUILDING, "yield_shear": None}, BUILDING),
        ({**BUILDING, "damping": {"kind": "modal", "ratio": 0.02}}, {**BUILDING, "damping": 0.02}),
    ],
)
def test_one_building_said_in_two_ways(write: Write, given: dict[str, Any], same: dict[str, Any]) -> None:
    one, other = (sm.read_scene(write(building=building)).scene.building for building in (given, same))
    assert one is not None
    assert other is not None
    assert one.yield_shear == pytest.approx(other.yield_shear, rel=1e-15)
    assert one.replace(yield_shear=1.0) == other.replace(yield_shear=1.0)


def test_damping_matrix(write: Write) -> None:
    matrix = [[10.0, -4.0], [-4.0, 4.0]]
    building = sm.read_scene(
        write(building=BUILDING | {"damping": {"kind": "matrix", "matrix": matrix}})
    ).scene.building
    assert building is not None
    assert building.damping_matrix == pytest.approx(np.array(matrix))


def test_ground_blocks_need_no_building(tmp_path: Path) -> None:
    path = tmp_path / "crate.json"
    path.write_text(json.dumps({"blocks": [BLOCK | {"floor": 0}], "motion": MOTION}))
    assert sm.read_scene(path).scene.building is None


def test_accelerations_in_every_unit(write: Write) -> None:
    for unit, size in (("g", 9.80665), ("m/s2", 1.0), ("cm/s2", 0.01)):
        motion = sm.read_scene(write(motion=MOTION | {"unit": unit})).motion
        assert motion.acceleration == pytest.approx(np.array(MOTION["acceleration"]) * size)


def test_record_files_are_found_beside_the_scene(tmp_path: Path, write: Write) -> None:
    folder = tmp_path / "records"
    folder.mkdir()
    (folder / "one.txt").write_text("0.0\n0.1\n-0.2\n0.0\n0.05\n")
    motion = {"file": "records/one.txt", "unit": "g", "dt": 0.01, "scale": 2.0}
    file = sm.read_scene(write(motion=motion, vertical_motion=MOTION | {"unit": "m/s2"}))
    assert file.motion.acceleration == pytest.approx([0.0, 0.2 * 9.80665, -0.4 * 9.80665, 0.0])
    assert [record.name for record in file.records] == ["one"]
    longer = sm.read_scene(write(motion=motion, duration=0.06)).motion
    assert longer.samples == 7
    assert longer.acceleration[-1] == 0.0


def test_built_in_motions_by_name(write: Write) -> None:
    file = sm.read_scene(write(motion={"builtin": "synthetic-3", "scale": 0.5}))
    record = sm.builtin_record("synthetic-3")
    assert file.motion.acceleration.tolist() == (0.5 * record.acceleration).tolist()
    assert file.motion.dt == record.dt
    assert file.records == (record,)
    assert any("SYNTHETIC motion 3: not a recording" in remark for remark in file.remarks)


def test_scene_is_read_without_its_motion(write: Write) -> None:
    path = write(motion={"file": "missing.AT2"}, initial={"velocity": [0.1, 0.2]}, name="without")
    with pytest.raises(sm.errors.RecordFormatError, match=r"missing\.AT2"):
        sm.read_scene(path)
    scene = scene_without_motion(path)
    assert scene == sm.read_scene(write(motion=MOTION, initial={"velocity": [0.1, 0.2]}, name="without")).scene
    with pytest.raises(sm.errors.InvalidSceneFile, match="did you mean blocks"):
        scene_without_motion(write(motion={}, block=[]))


def changed(base: dict[str, Any], without: tuple[str, ...] = (), **changes: Any) -> dict[str, Any]:
    return {key: value for key, value in (base | changes).items() if key not in without}


REFUSED: list[tuple[dict[str, Any], type[Exception], str]] = [
    (
        {"bulding": {}},
        sm.errors.InvalidSceneFile,
        r"bulding of scene.json must be one of the keys .* \(did you mean building\?\); got an unknown key",
    ),
    (
        {"building": changed(BUILDING, stifness=1.0)},
        sm.errors.InvalidSceneFile,
        r"building.stifness of scene.json must be one of .* \(did you mean building.stiffness\?\); got an unknown key",
    ),
    (
        {"blocks": [BLOCK, changed(BLOCK, colour="red")]},
        sm.errors.InvalidSceneFile,
        r"blocks\[2\].colour of scene.json must be one of the keys floor, .*; got an unknown key",
    ),
    (
        {"motion": changed(MOTION, units="g")},
        sm.errors.InvalidSceneFile,
        r"motion.units of .* \(did you mean motion.unit\?\); got an unknown key",
    ),
    (
        {"motion": {"builtin": "synthetic-12"}},
        sm.errors.InvalidSceneFile,
        r"motion.builtin of .* from synthetic-1 to synthetic-11",
    ),
    (
        {"motion": {"builtin": "synthetic-1", "dt": 0.01}},
        sm.errors.InvalidSceneFile,
        r"motion.dt of .* left out where motion.bui",
    ),
    ({"motion": {"builtin": 1}}, sm.errors.InvalidSceneFile, r"motion.builtin of .* must be text; got 1"),
    (
        {"initial": {"drifts": [0, 0]}},
        sm.errors.InvalidSceneFile,
        r"initial.drifts of .* \(did you mean initial.drift\?\); got an unknown key",
    ),
    (
        {"building": changed(BUILDING, damping={"kind": "modal", "ratio": 0.05, "modes": [1, 2]})},
        sm.errors.InvalidSceneFile,
        r"building.damping.modes of .* must be one of the keys kind, ratio; got an unknown key",
    ),
    (
        {"building": changed(BUILDING, damping={"kind": "viscous", "ratio": 0.05})},
        sm.errors.InvalidSceneFile,
        r"building.damping.kind of .* must be one of modal, rayleigh, matrix; got 'viscous'",
    ),
    (
        {"building": changed(BUILDING, damping={"ratio": 0.05})},
        sm.errors.InvalidSceneFile,
        r"building.damping.kind of .* must be one of .*; got nothing",
    ),
    (
        {"building": changed(BUILDING, damping={"kind": "rayleigh", "ratio": 0.05})},
        sm.errors.InvalidSceneFile,
        r"building.damping.modes of .* must be given; got nothing",
    ),
    (
        {"building": changed(BUILDING, damping={"kind": "rayleigh", "ratio": 0.05, "modes": 1})},
        sm.errors.InvalidScene,
        r"modes of Rayleigh damping must be two mode numbers; got 1",
    ),
    (
        {"building": changed(BUILDING, damping="5 %")},
        sm.errors.InvalidScene,
        r"damping of building must be a number; got '5 %'",
    ),
    (
        {"building": changed(BUILDING, yield_shear=1.0, yield_shear_over_weight=0.1)},
        sm.errors.InvalidSceneFile,
        r"building.yield_shear_over_weight of .* must be left out where building.yield_shear is given; got both",
    ),
    (
        {"building": changed(BUILDING, heights=3.0, gravity_load=1.0, geometric_stiffness=1.0)},
        sm.errors.InvalidSceneFile,
        r"building.geometric_stiffness of .* must be left out where building.gravity_load is given; got both",
    ),
    (
        {"building": changed(BUILDING, gravity_load=1.0)},
        sm.errors.InvalidSceneFile,
        r"building.heights of .* must be given; got nothing",
    ),
    (
        {"building": changed(BUILDING, storeys=2)},
        sm.errors.InvalidSceneFile,
        r"building.storeys of .* must be left out where mass or stiffness is a list; got 2",
    ),
    (
        {"building": changed(BUILDING, storeys=2, period=0.5)},
        sm.errors.InvalidSceneFile,
        r"building.stiffness of .* must be left out where building.period is given; got both",
    ),
    (
        {"building": {"mass": [1.0, 1.0], "storeys": 2, "period": 0.5}},
        sm.errors.InvalidSceneFile,
        r"building.mass of .* must be one number where building.period is given; got \[1.0, 1.0\]",
    ),
    *(
        (
            {"building": {"mass": 1.0, "stiffness": 1.0, "storeys": storeys}},
            sm.errors.InvalidScene,
            f"storeys of building must be at most 1000; got {storeys}",
        )
        for storeys in (MAX_STOREYS + 1, 300_000_000_000)
    ),
    (
        {"building": {"mass": 1.0, "stiffness": 1.0, "storeys": 3, "yield_shear_over_weight": [0.2, 0.1]}},
        sm.errors.InvalidScene,
        r"yield_shear_over_weight of building must be .* a list of 3 values, one per storey; got 2 values",
    ),
    ({"building": {"period": 0.5}}, sm.errors.InvalidSceneFile, r"building.storeys of .* must be given; got nothing"),
    (
        {"building": {"mass": [1.0]}},
        sm.errors.InvalidSceneFile,
        r"building.stiffness of .* must be given, or building.period, or building.backbone; got nothing",
    ),
    ({"building": {"stiffness": [1.0]}}, sm.errors.InvalidSceneFile, r"building.mass of .* must be given; got nothing"),
    (
        {"building": {"storeys": "two", "period": 0.5}},
        sm.errors.InvalidScene,
        r"storeys of building must be a whole number of at least 1; got 'two'",
    ),
    ({"building": []}, sm.errors.InvalidSceneFile, r"building of .* must be a table of keys; got \[\]"),
    (
        {"building": changed(BUILDING, mass="heavy")},
        sm.errors.InvalidScene,
        r"mass of building must be a number or a list of numbers; got 'heavy'",
    ),
    (
        {"building": changed(BUILDING, mass=[1e3, None])},
        sm.errors.InvalidScene,
        r"mass of building must be a number or a list of numbers; got \[1000.0, None\]",
    ),
    ({"blocks": BLOCK}, sm.errors.InvalidSceneFile, r"blocks of .* must be a list of tables; got"),
    ({"blocks": [1]}, sm.errors.InvalidSceneFile, r"blocks\[1\] of .* must be a table of keys; got 1"),
    (
        {"blocks": [changed(BLOCK, ("floor",))]},
        sm.errors.InvalidSceneFile,
        r"blocks\[1\].floor of .* must be given; got nothing",
    ),
    (
        {"blocks": [changed(BLOCK, ("mass",))]},
        sm.errors.InvalidSceneFile,
        r"blocks\[1\].mass of .* must be given, or blocks\[1\].mass_ratio; got nothing",
    ),
    (
        {"blocks": [changed(BLOCK, mass_ratio=1.0)]},
        sm.errors.InvalidSceneFile,
        r"blocks\[1\].mass_ratio of .* must be left out where blocks\[1\].mass is given; got both",
    ),
    (
        {"blocks": [changed(BLOCK, mu_k=0.2)]},
        sm.errors.InvalidSceneFile,
        r"blocks\[1\].mu of .* must be left out where blocks\[1\].mu_k is given; got both",
    ),
    (
        {"blocks": [changed(BLOCK, ("mu",), mu_k=0.2)]},
        sm.errors.InvalidSceneFile,
        r"blocks\[1\].mu of .* must be given, or blocks\[1\].mu_s; got nothing",
    ),
    (
        {"blocks": [changed(BLOCK, floor=7)]},
        sm.errors.InvalidScene,
        r"floor of block 1 must be a floor of the building, 1 to 2, .*; got 7",
    ),
    (
        {"blocks": [BLOCK, changed(BLOCK, floor="two")]},
        sm.errors.InvalidScene,
        r"floor of block 2 must be a whole number of at least 0; got 'two'",
    ),
    (
        {"blocks": [BLOCK, changed(BLOCK, mass="heavy")]},
        sm.errors.InvalidScene,
        r"mass of block 2 must be a number; got 'heavy'",
    ),
    (
        {"blocks": [BLOCK, changed(BLOCK, mu=-0.3)]},
        sm.errors.InvalidScene,
        r"mu of block 2 must be finite and not negative; got -0.3",
    ),
    (
        {"initial": {"drift": "a"}, "building": BUILDING},
        sm.errors.InvalidScene,
        r"initial.drift of .* must be a number or a list of numbers; got 'a'",
    ),
    (
        {"motion": changed(MOTION, scale=1e308)},
        sm.errors.InvalidMotion,
        r"acceleration of motion must be finite at every sample; got -inf at sample 2",
    ),
    (
        {"blocks": [changed(BLOCK, ("mass",), floor=0, mass_ratio=1.0)]},
        sm.errors.InvalidScene,
        r"mass_ratio of block 1 must be left out on the ground; got 1",
    ),
    ({"motion": None}, sm.errors.InvalidSceneFile, r"motion of .* must be given; got nothing"),
    (
        {"motion": {"dt": 0.01}},
        sm.errors.InvalidSceneFile,
        r"motion.file of .* must be given, or motion.builtin, or motion.acceleration; got nothing",
    ),
    (
        {"motion": changed(MOTION, file="a.AT2")},
        sm.errors.InvalidSceneFile,
        r"motion.file of .* must be left out where motion.acceleration is given; got both",
    ),
    ({"motion": changed(MOTION, ("dt",))}, sm.errors.InvalidSceneFile, r"motion.dt of .* must be given; got nothing"),
    (
        {"motion": changed(MOTION, unit="furlong/s2")},
        sm.errors.InvalidSceneFile,
        r"motion.unit of .* must be one of g, m/s2, cm/s2, gal, mm/s2, mg, %g, ft/s2, in/s2; got 'furlong/s2'",
    ),
    (
        {"motion": changed(MOTION, unit=["g"])},
        sm.errors.InvalidSceneFile,
        r"motion.unit of .* must be one of g, m/s2, cm/s2, gal, mm/s2, mg, %g, ft/s2, in/s2; got \['g'\]",
    ),
    (
        {"building": changed(BUILDING, damping={"kind": ["modal"]})},
        sm.errors.InvalidSceneFile,
        r"building.damping.kind of .* must be one of .*; got \['modal'\]",
    ),
    (
        {"motion": changed(MOTION, scale="double")},
        sm.errors.InvalidSceneFile,
        r"motion.scale of .* must be a number; got 'double'",
    ),
    (
        {"motion": changed(MOTION, scale=math.inf)},
        sm.errors.InvalidSceneFile,
        r"motion.scale of .* must be a finite number; got inf",
    ),
    (
        {"motion": changed(MOTION, dt_scale=0)},
        sm.errors.InvalidSceneFile,
        r"motion.dt_scale of .* must be a positive number; got 0",
    ),
    ({"motion": changed(MOTION, dt=0)}, sm.errors.InvalidMotion, r"dt of motion must be a positive number; got 0"),
    (
        {"motion": changed(MOTION, acceleration=[])},
        sm.errors.InvalidMotion,
        r"acceleration of motion must be .* samples; got 0 samples",
    ),
    (
        {"motion": changed(MOTION, acceleration=[0.0, "x"])},
        sm.errors.InvalidMotion,
        r"acceleration of motion must be a list of numbers; got \[0.0, 'x'\]",
    ),
    (
        {"motion": {"file": "missing.AT2"}},
        sm.errors.RecordFormatError,
        r"record file must be a file that can be read; got .*missing.AT2",
    ),
    ({"motion": {"file": 3}}, sm.errors.InvalidSceneFile, r"motion.file of .* must be text; got 3"),
    (
        {"vertical_motion": changed(MOTION, dt=0.02)},
        sm.errors.InvalidSceneFile,
        r"vertical_motion of .* must be at the time step of the horizontal motion, 0.01 s; got 0.02 s",
    ),
    ({"duration": "long"}, sm.errors.InvalidSceneFile, r"duration of .* must be a number; got 'long'"),
    ({"duration": -1.0}, sm.errors.InvalidMotion, r"duration of motion must be .*; got -1"),
    (
        {"initial": {"drift": [0.0]}},
        sm.errors.InvalidScene,
        r"drift of initial state must be a list of 2 values, one per storey; got 1 values",
    ),
    (
        {"building": None, "initial": {"drift": 0.1}},
        sm.errors.InvalidSceneFile,
        r"initial.drift of .* must be left out where there is no building; got 0.1",
    ),
    (
        {"building": None, "collapse_drift": 0.3},
        sm.errors.InvalidScene,
        r"collapse_drift of scene must be left out where there is no building; got 0.3",
    ),
    *(
        (
            {"building": building | {"yield_shear_over_weight": strength}},
            sm.errors.InvalidScene,
            rf"yield_shear_over_weight of building must be {requirement}; got {got}",
        )
        for building in (BUILDING, {"storeys": 2, "period": 0.3})
        for strength, requirement, got in (
            (-0.2, "positive", "-0.2"),
            ([0.2, -0.1], "positive", r"\[0.2, -0.1\]"),
            ([0.2], "one number or a list of 2 values, one per storey", "1 values"),
            ([0.2] * 3, "one number or a list of 2 values, one per storey", "3 values"),
        )
    ),
    ({"name": 5}, sm.errors.InvalidSceneFile, r"name of .* must be text; got 5"),
    (
        {"collapse_drift": [0.1, 0.0]},
        sm.errors.InvalidScene,
        r"collapse_drift of storey 2 must be a positive number; got 0",
    ),
]


@pytest.mark.parametrize(("top", "kind", "message"), REFUSED)
def test_wrong_keys_are_refused_by_name(write: Write, top: dict[str, Any], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=f"^{message}"):
        sm.read_scene(write(**top))


ROW = r"^\| `([a-z_.]+)` \|[^|]*\|[^|]*\|([^|]*)\|[^|]*\|$"
DOCUMENTED: dict[str, str] = dict(re.findall(ROW, PAGE, re.MULTILINE))


def test_the_page_names_every_key_and_no_other() -> None:
    accepted = [f"{table}.{key}".lstrip(".") for table, keys in KEYS.items() for key in keys]
    assert sorted(DOCUMENTED) == sorted(accepted)


def test_the_page_has_the_units_of_springs() -> None:
    for name, field in SPRING_FIELDS.items():
        row = re.search(rf"^\| `building.{name}` \|[^|]*\| ([^|]*) \|", PAGE, re.MULTILINE)
        assert row is not None
        assert row[1] == (field.unit or "1")


def test_the_page_has_the_defaults() -> None:
    parameters = inspect.signature(sm.Building.uniform).parameters
    for key in (*SHAPE_FIELDS, "damping"):
        assert DOCUMENTED[f"building.{key}"].split()[0] == f"{parameters[key].default:g}", key


EXAMPLES = re.findall(r"^```toml\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


def test_the_backbone_of_the_page_is_that_of_both_storeys(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(f"{EXAMPLES[1]}\n[motion]\nacceleration = [0, 1]\ndt = 0.01\n")
    points = [(0.01, 60e3), (0.03, 90e3), (0.08, 100e3)]
    assert sm.read_scene(path).scene.building == sm.Building([20e3, 20e3], backbone=points)


def test_the_example_of_the_page_is_what_it_says(tmp_path: Path) -> None:
    example = EXAMPLES[0]
    path = tmp_path / "docs" / "scene.toml"
    path.parent.mkdir()
    path.write_text(example)
    shutil.copytree(ROOT / "data" / "synthetic", tmp_path / "data" / "synthetic")
    file = sm.read_scene(path)
    building = sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.24, 0.2, 0.12], heights=3.5)
    blocks = [sm.Block(1, mass_ratio=1.0, mu=0.3), sm.Block(2, mass_ratio=0.5, mu_s=0.35, mu_k=0.25)]
    assert file.scene == sm.Scene(building, blocks, collapse_drift=0.25)
    assert file.motion == sm.builtin_suite("seven")[0].scaled(1.5).motion
    response = sm.simulate(file.scene, file.motion)
    assert response.status == "completed"
    assert response.counts["yield"] > 0
    assert response.counts["slip"] > 0


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("scene.toml", b"[building\n", r"content of scene.toml must be valid TOML; got .*line 1"),
        ("scene.json", b'{"building": ', r"content of scene.json must be valid JSON; got .*line 1"),
        ("scene.json", b'{"name": "a", "name": "b"}', r"name of scene.json must be given once; got it twice"),
        ("scene.json", b"[1, 2]", r"content of scene.json must be a table of keys; got \[1, 2\]"),
        ("scene.json", b"\xff\xfe{}", r"content of scene.json must be valid JSON; got .*decode"),
        ("scene.yaml", b"", r"suffix of scene file scene.yaml must be .toml or .json; got '.yaml'"),
    ],
)
def test_files_that_are_not_scenes(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(sm.errors.InvalidSceneFile, match=f"^{message}"):
        sm.read_scene(path)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(
        sm.errors.InvalidSceneFile, match=r"scene file must be a file that can be read; got .*nowhere.toml"
    ):
        sm.read_scene(tmp_path / "nowhere.toml")
