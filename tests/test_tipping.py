"""Goods that tip before they slide: a reference of rocking blocks, the split, keys of a building file, the answer."""

from __future__ import annotations

import itertools
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.assessment.checks import TAKEN, WORDS, other_models
from seismass.assessment.doubts import building_doubts
from seismass.base.errors import InvalidBuildingFile, InvalidScene
from seismass.cli import main
from seismass.effective_mass.models import goods_mass
from seismass.model.tipping import FALLS, FALLS_BELOW, BlockSize, falls_of, staying_part, tipping_of

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
GRAVITY = 9.80665


@pytest.fixture
def rocking(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The benchmark with the reference of a rocking block."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    yield import_module("rocking")
    sys.modules.pop("rocking", None)


def single(rocking: Any, ratio: float, radius: float = 1.0, period: float = 1.0, lanes: int = 1) -> Any:
    """Return blocks without mass on elastic storeys."""
    stiffness = np.full(lanes, (2.0 * np.pi / period) ** 2)
    one = np.ones(lanes)
    return rocking.Blocks(ratio * one, radius * one, 0.0 * one, stiffness, np.inf * one, 0.1 * np.sqrt(stiffness))


def test_restitution_is_that_of_housner_on_fixed_ground(rocking: Any) -> None:
    """And conserves both momenta on a floor that recoils, by hand: b = 2, h = 4, block and floor of 1 kg."""
    angle = np.arctan([0.1, 0.5])
    assert rocking.restitution(angle, np.zeros(2)) == pytest.approx(1.0 - 1.5 * np.sin(angle) ** 2, rel=1e-14)
    ratio = float(rocking.restitution(np.arctan([0.5]), np.array([0.5]))[0])
    before, after, floor = 1.0, ratio, -0.5 * 2.0 * (ratio - 1.0)  # half of the change of h/2 times the rate
    inertia, half_width, half_height = (4.0 + 16.0) / 12.0, 1.0, 2.0
    turning = [
        inertia * rate + half_height * (moved + half_height * rate) - sign * half_width**2 * rate
        for rate, moved, sign in ((before, 0.0, 1.0), (after, floor, -1.0))
    ]
    assert turning[0] == pytest.approx(turning[1], rel=1e-12)


@pytest.mark.parametrize("start", [0.2, 0.5, 0.9])
def test_free_rocking_has_the_quarter_period_of_housner(rocking: Any, start: float) -> None:
    """T/4 = acosh(1/(1 - theta/alpha))/p for slender blocks, and amplitudes after impacts by the restitution."""
    ratio, step = 0.02, 2e-4
    blocks, angle = single(rocking, ratio), float(np.arctan(ratio))
    frequency = np.sqrt(0.75 * GRAVITY)
    quarter = np.arccosh(1.0 / (1.0 - start)) / frequency

    def angle_at(end: float) -> float:
        return float(rocking.stepped(blocks, np.zeros((round(end / step), 1)), step, start * angle).angle[0])

    assert angle_at(0.98 * quarter) > 0.0  # still on its first edge
    assert angle_at(1.02 * quarter) < 0.0
    # After the impact the energy is r^2 of that before: 1 - (1 - x)^2 scales by r^2, x the angle over alpha.
    factor = float(rocking.restitution(np.array([angle]), np.zeros(1))[0]) ** 2
    energy = 1.0 - (1.0 - start) ** 2
    once = 1.0 - np.sqrt(1.0 - factor * energy)
    half = quarter + np.arccosh(1.0 / (1.0 - once)) / frequency
    assert -angle_at(half) / angle == pytest.approx(once, rel=5e-3)


@pytest.mark.parametrize("beta", [1.5, 3.0])
def test_a_rectangular_pulse_overturns_from_its_duration_on(rocking: Any, beta: float) -> None:
    """p t = -ln(1 - 1/beta) for slender blocks, beta the acceleration over g b/h; the floor is stiff."""
    ratio, step = 0.02, 1e-4
    duration = -np.log(1.0 - 1.0 / beta) / np.sqrt(0.75 * GRAVITY)
    fallen = []
    for part in (0.96, 1.04):
        ground = np.zeros((40_000, 1))
        ground[: round(part * duration / step)] = beta * ratio * GRAVITY
        fallen.append(bool(rocking.stepped(single(rocking, ratio, period=0.01), ground, step).fallen[0]))
    assert fallen == [False, True]


def test_sliding_stands_for_no_rocking_goods_and_the_split_does(rocking: Any) -> None:
    """A dozen motions, four buildings, two sizes: the split is unbiased, sliding with b/h drifts too little."""
    records = [rocking.scaled(record) for record in rocking.suite(12)]
    rows = rocking.compared(rocking.cases((0.3, 0.5), (1.0, 2.0), (1.0,), (0.4, 0.5), (2.0,)), records, 1e-3)
    known = rows.filter(pl.col("lifted") >= 4)
    assert known.height >= 6
    means = {name: float(np.exp(np.log(known[name].to_numpy()).mean())) for name in ("split", "slide", "attached")}
    assert 0.93 < means["split"] < 1.07
    assert means["slide"] > means["split"]
    assert means["attached"] < 0.95


def test_the_part_that_stays_is_that_of_the_equation_at_uplift() -> None:
    assert [round(staying_part(ratio), 2) for ratio in (0.1, 0.4)] == [0.26, 0.35]
    assert staying_part(0.0) == 0.25


def test_what_stands_for_goods_follows_size_and_friction() -> None:
    assert tipping_of(None, 0.9) == "slide"
    for ratio, mu in itertools.product((0.1, 0.29, 0.3, 0.6), (0.05, 0.2, 0.29, 0.31, 0.9)):
        size = BlockSize(2.0 * ratio, 2.0)
        expected = "slide" if mu <= size.uplift_g else "attached" if size.uplift_g < FALLS_BELOW else "split"
        assert tipping_of(size, mu) == expected, (ratio, mu)


def test_falls_are_those_of_the_next_smaller_ratio_and_of_the_height() -> None:
    assert falls_of(0.05, 1.0) is None
    assert falls_of(0.25, 20.0) is None
    for row in FALLS:
        found = falls_of(row.ratio + 1e-6, 0.9 * row.highest)
        assert found == row
        assert 0.0 <= row.low <= row.share <= row.high <= 1.0


BUILDING = sm.Building(
    [1.1e5, 0.9e5, 0.7e5], stiffness=[9e7, 8e7, 6e7], yield_shear=[3.1e5, 2.3e5, 1.3e5], heights=3.2, gravity_load=1e6
)


@pytest.mark.parametrize(
    "changes", [{}, {"stiffness_matrix": 2e6 * np.eye(3)}, {"gravity_load": None, "geometric_stiffness": 3e5}]
)
@pytest.mark.parametrize("plane", [False, True])
def test_fixed_goods_are_goods_that_never_slide(changes: dict[str, Any], *, plane: bool) -> None:
    building = BUILDING.replace(**changes)
    motions = [record.scaled(0.6) for record in sm.builtin_suite("forty")[:2]]
    motion: Any = (motions[0].motion, sm.Motion(motions[1].acceleration, motions[0].dt)) if plane else motions[0]
    block = sm.Block(1, mass=3e4, mu=0.1)
    fixed = sm.Scene(building, [block], fixed_goods=[5e4, 2e4, 0.0], other_direction=plane)
    rough = [sm.Block(1, mass=5e4, mu=1.4), sm.Block(2, mass=2e4, mu=1.4)]
    stuck = sm.Scene(building, [block, *rough], other_direction=plane)
    one, other = (sm.simulate(scene, motion) for scene in (fixed, stuck))
    assert one.counts["slip"] > 0
    assert one.peak_drift == pytest.approx(other.peak_drift, rel=1e-9)
    assert fixed.geometric_stiffness == pytest.approx(stuck.geometric_stiffness, rel=1e-12)
    assert goods_mass(fixed).tolist() == goods_mass(stuck).tolist()


def test_goods_that_are_all_fixed_count_whole() -> None:
    scene = sm.Scene(BUILDING.replace(gravity_load=None), fixed_goods=[5e4, 2e4, 0.0])
    assert sm.effective_mass(scene, sm.builtin_suite("forty")[:3]).value == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("wrong", [[1.0], [1.0, -1.0, 0.0], [1.0, np.nan, 0.0], "much"])
def test_fixed_goods_are_masses_on_floors(wrong: Any) -> None:
    with pytest.raises(InvalidScene, match="fixed_goods"):
        sm.Scene(BUILDING, fixed_goods=wrong)


def test_fixed_goods_need_a_building_of_stated_mass(tmp_path: Path) -> None:
    for building in (None, sm.Building.uniform(2, 0.5)):
        with pytest.raises(InvalidScene, match="fixed_goods"):
            sm.Scene(building, fixed_goods=1.0)
    file = tmp_path / "scene.toml"
    building_lines = "[building]\nstoreys = 2\nmass = 1e5\nstiffness = 1e8\n"
    motion_lines = "[motion]\nacceleration = [0.1, 0.0]\ndt = 0.01\n"
    file.write_text(f"fixed_goods = [1e4, 0.0]\n{building_lines}{motion_lines}", encoding="utf-8")
    fixed = sm.read_scene(file).scene.fixed_goods
    assert fixed is not None
    assert fixed.tolist() == [1e4, 0.0]


def tables(goods: dict[str, Any], kinds: list[dict[str, Any]] | None = None, units: str = "") -> dict[str, Any]:
    """Return a building of two storeys with goods on the first floor."""
    first: dict[str, Any] = {} if kinds is None else {"goods": kinds}
    return {
        **({"units": units} if units else {}),
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.5, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 3},
        "goods": {"live_load_kpa": 6, **goods},
        "storeys": [first, {"live_load_kpa": 0}],
    }


@pytest.mark.parametrize(
    ("size", "units"),
    [
        ({"width_m": 0.3048, "height_m": 1.524}, ""),
        ({"width_ft": 1.0, "height_ft": 5.0}, ""),
        ({"width": 1.0, "height": 5.0}, "us"),
        ({"width": 0.3048, "height": 1.524}, "si"),
        ({"width_m": 0.3048, "height_ft": 5.0}, ""),
    ],
)
@pytest.mark.parametrize("kind", [False, True])
def test_sizes_are_read_in_both_systems_and_by_kind(size: dict[str, float], units: str, *, kind: bool) -> None:
    goods = {"mu": 0.5} if kind else {"mu": 0.5, **size}
    kinds = [{"share": 1.0, **size}] if kind else None
    (read, _) = sm.read_building(tables(goods, kinds, units)).loose
    assert read.size is not None
    assert (read.size.width, read.size.height) == pytest.approx((0.3048, 1.524), rel=1e-12)
    assert read.model() == "attached"


@pytest.mark.parametrize(
    ("goods", "named"),
    [
        ({"width_m": 1.0}, "height_m"),
        ({"height_m": 1.0}, "width_m"),
        ({"width_m": 0.0, "height_m": 1.0}, "width_m"),
        ({"width_m": 1.0, "height_m": -1.0}, "height_m"),
        ({"width_m": 1.0, "height_m": "tall"}, "height_m"),
        ({"width_m": 1.0, "width_ft": 3.0, "height_m": 1.0}, "width_ft"),
        ({"tipping": "split"}, "tipping"),
        ({"width_m": 1.0, "height_m": 1.0, "tipping": "rock"}, "tipping"),
    ],
)
def test_a_wrong_size_is_refused_by_its_key(goods: dict[str, Any], named: str) -> None:
    with pytest.raises(InvalidBuildingFile, match=named):
        sm.read_building(tables({"mu": 0.5, **goods}))


def test_bolted_goods_and_storeys_have_no_size() -> None:
    kinds = [{"share": 1.0, "attached": True, "width_m": 1.0, "height_m": 1.0}]
    with pytest.raises(InvalidBuildingFile, match="width_m"):
        sm.read_building(tables({"mu": 0.5}, kinds))
    wrong = tables({"mu": 0.5})
    wrong["storeys"][0]["width_m"] = 1.0
    with pytest.raises(InvalidBuildingFile, match="width_m"):
        sm.read_building(wrong)


@pytest.mark.parametrize("tipping", [None, "slide", "split", "attached"])
@pytest.mark.parametrize("factor", [0.5, 1.0, 1.5])
def test_weight_strength_and_periods_are_those_without_a_size(tipping: str | None, factor: float) -> None:
    """The part that stays is live load still; the scene has it on its floor, and all goods in P-Delta."""
    stated = {} if tipping is None else {"tipping": tipping}
    plain, sized = (
        sm.read_building(tables({"mu": 0.4, **more})) for more in ({}, {"width_m": 0.6, "height_m": 2.0, **stated})
    )
    assert sized.period() == plain.period()
    assert sized.code_design().yield_shear.tolist() == plain.code_design().yield_shear.tolist()
    assert sized.present_share == plain.present_share
    scene, other = (building.scene(mu_factor=factor) for building in (sized, plain))
    assert goods_mass(scene) == pytest.approx(goods_mass(other), rel=1e-15)
    assert scene.geometric_stiffness == pytest.approx(other.geometric_stiffness, rel=1e-12)
    model = "slide" if 0.4 * factor <= 0.3 else tipping or "split"
    (kind, _) = sized.loose
    assert kind.model(factor) == model
    assert len(scene.blocks) == (model != "attached")
    if model == "split":
        assert scene.blocks[0].mu_s == scene.blocks[0].mu_k == pytest.approx(0.3)
        assert scene.blocks[0].mass == pytest.approx((1.0 - staying_part(0.3)) * kind.mass)
    assert sized.with_tipping("slide").scene(mu_factor=factor) == other


def test_goods_on_racks_are_split_on_their_levels() -> None:
    goods = {"mu": 0.5, "width_m": 0.8, "height_m": 2.0, "on_racks": {"period_s": 0.8, "levels": 2}}
    building = sm.read_building(tables(goods))
    (rack,) = building.scene().racks
    assert sum(block.fixed for block in rack.blocks) == 2
    assert rack.goods_mass(building.structure()) == pytest.approx(building.present[0].mass, rel=1e-12)
    attached = sm.read_building(tables(goods | {"tipping": "attached"})).scene()
    assert not attached.goods
    assert attached.engine == "general"


@pytest.mark.parametrize(
    ("goods", "words"),
    [
        ({"mu": 0.4, "width_m": 0.8, "height_m": 2.0}, "mu of the goods on floor 1 is b/h = 0.4"),
        ({"mu": 0.4, "width_m": 1.0, "height_m": 30.0}, "1 x 30 m"),
        ({"mu": 0.4, "width_m": 100.0, "height_m": 2.0}, "100 x 2 m"),
        ({"mu": 0.4, "width_m": 1.0, "height_m": 4.5}, "more than the 4 m"),
        ({"mu": 0.5, "width_m": 0.8, "height_m": 2.0}, ""),
    ],
)
def test_sizes_are_doubted(goods: dict[str, float], words: str) -> None:
    building = sm.read_building(tables(goods))
    doubts = building_doubts(building, building.scene(), building.target)
    assert [words in doubt for doubt in doubts] == [True] * bool(words), doubts


def assessed(goods: dict[str, Any]) -> sm.Assessment:
    return sm.assess(tables(goods), sm.builtin_suite("forty")[:8], resamples=20)


def test_the_answer_takes_the_model_of_each_size_and_shows_the_others() -> None:
    sizes = {"attached": {"width_m": 0.4, "height_m": 2.0}, "split": {"width_m": 0.8, "height_m": 2.0}}
    shares = {}
    for model, size in sizes.items():
        result = assessed({"mu": 0.5, **size})
        row = result.tipping.row(0, named=True)
        assert (row["floor"], row["model"], row["motions"]) == (1, model, 8)
        assert 0 < row["limits_exceeded"] <= row["lifts"] <= 8
        assert "real" not in result.slip["model"].to_list()
        assert (model == "split") == (result.slip.height == 1)  # with mu x 0.67 they slide first
        assert "tipping" in result.tables
        sentence = next(line for line in result.answer.goods if "tip before they slide" in line)
        assert f"b/h = {row['ratio']:.3g}" in sentence
        assert {"attached": "may fall", "split": "split, 0.35"}[model] in sentence
        others = {one.floors: one.advised for one in result.answer.tipping}
        assert list(others) == [f"{TAKEN}{words}" for name, words in WORDS.items() if name != model]
        shares[model] = {"here": result.advised, **others}
        for name, building in other_models(result.building).items():
            alone = sm.assess(building, sm.builtin_suite("forty")[:8], resamples=20)
            assert alone.advised == pytest.approx(others[name], abs=0.011)
        assert sentence[:40] in " ".join(result.text.split())
    assert shares["attached"]["here"] == 1.0


def test_goods_of_two_kinds_slide_and_rock_side_by_side() -> None:
    kinds = [
        {"name": "cartons", "share": 0.5, "mu": 0.5, "width_m": 0.8, "height_m": 2.0},
        {"name": "pallets", "share": 0.5, "mu": 0.15},
    ]
    result = sm.assess(tables({}, kinds), sm.builtin_suite("forty")[:6], resamples=20)
    assert result.tipping["goods"].to_list() == ["cartons"]
    assert set(result.slip.filter(model="real")["goods"]) == {"pallets"}
    assert result.answer.statement.startswith("Sliding and rocking")


def test_a_file_without_sizes_has_no_word_of_tipping() -> None:
    result = assessed({"mu": 0.5})
    assert result.tipping.height == 0
    assert result.answer.tipping == ()
    assert "tipping" not in result.tables
    assert "tip before" not in result.text


@pytest.mark.usefixtures("few_motions")
def test_commands_take_the_size_of_a_building_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "b.toml"
    text = example_file().read_text(encoding="utf-8")
    file.write_text(text.replace("[goods]\n", "[goods]\nwidth_m = 0.2\nheight_m = 2.0\n"), encoding="utf-8")
    assert main(["slip", str(file)]) == 0
    assert "rocks first: mu_s = 0.2, b/(2 h_c) = 0.1" in capsys.readouterr().out
    assert main(["slip", str(file), "--size", "1=1.0x1.0"]) == 0
    page = capsys.readouterr().out
    assert "block 1, 1 x 1 m: slides" in page
    assert "block 2, 0.2 x 2 m: rocks first" in page
    assert main(["building", str(file), "--out", str(tmp_path / "out")]) == 0
    assert "tip before they slide" in " ".join(capsys.readouterr().out.split())
    (page_file,) = (tmp_path / "out").glob("*.html")
    written = page_file.read_text(encoding="utf-8")
    assert "b/h 0.1" in written
    assert "tip before they slide" in written
    assert "some of its goods tip before they slide" in written


def test_new_asks_for_the_size(tmp_path: Path) -> None:
    answers = {"storeys": 2, "height": 4, "area": 500, "dead-load": 5, "period": 0.5, "sds": 1, "sd1": 0.6}
    answers |= {"live-load": 6, "friction": 0.5}
    words = [word for name, value in answers.items() for word in (f"--{name}", str(value))]
    for number, (size, expected) in enumerate((([], None), (["--goods-size", "0.8x2.0"], (0.8, 2.0)))):
        file = tmp_path / f"{number}.toml"
        assert main(["new", str(file), *words, *size]) == 0
        read = sm.read_building(file).loose[0].size
        assert (None if read is None else (read.width, read.height)) == expected
    assert main(["new", str(tmp_path / "x.toml"), *words, "--goods-size", "0.8"]) == 2
