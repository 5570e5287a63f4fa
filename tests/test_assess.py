"""Assessments: their numbers against single runs and closed forms, what they advise, and the command around them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from matplotlib.figure import Figure

import seismass as sm
from seismass.assessment.answer import rounded_up
from seismass.assessment.building_file import example_file
from seismass.assessment.checks import collapses_allowed, drift_statistics
from seismass.assessment.doubts import building_doubts
from seismass.assessment.models import with_mass
from seismass.assessment.structure import force_ratios
from seismass.cli import main
from seismass.media.result import stored_tables
from seismass.runs.batch import solve_engine
from seismass.show.assessment.page import building_page

TWO_STOREYS = Path(__file__).with_name("data") / "two_storeys.json"
"""A building file: two storeys with goods on the first, that slide under the built-in suite."""
G = 9.80665
FEW = list(sm.builtin_suite("forty"))[:3]
"""Three motions, where neither their number nor a number that they give is tested."""
MODELS = ["real", "real_mu_low", "real_mu_high", "advised", "code", "attached", "bare"]


def tables(**changes: dict[str, Any]) -> dict[str, Any]:
    """Two storeys with goods on the first, that slide under the built-in suite; tables changed as told."""
    building: dict[str, Any] = json.loads(TWO_STOREYS.read_text(encoding="utf-8"))
    for table, values in changes.items():
        merged = {**building.get(table, {}), **values}
        building[table] = {key: value for key, value in merged.items() if value is not None}
    return building


@pytest.fixture(scope="module")
def small() -> sm.Assessment:
    return sm.assess(tables(), resamples=200)


@pytest.fixture(scope="module")
def warehouse() -> sm.Assessment:
    return sm.assess(example_file(), resamples=200)


def test_every_column_of_every_table_is_described(small: sm.Assessment) -> None:
    """The page's heads and the table of docs/building_file.md are made of the rows of data/tables."""
    described = {name: list(columns) for name, (_, columns) in stored_tables("assessment").items()}
    assert described == {name: table.columns for name, table in (small.tables | {"tipping": small.tipping}).items()}


def mean_of(result: sm.Assessment, model: str, column: str = "mean") -> list[Any]:
    return result.storeys.filter(model=model)[column].to_list()


def test_drifts_and_slips_are_those_of_single_runs(small: sm.Assessment) -> None:
    """Each run again by `simulate`, with the models built here from the definition."""
    assert small.scaling is not None
    building = sm.read_building(tables())
    scene = building.scene()
    assert scene.building is not None
    motions = [r.scaled(f).motion for r, f in zip(sm.builtin_suite("forty"), small.scaling.factors, strict=True)]
    real = [sm.simulate(scene, motion) for motion in motions]
    ratios = np.array([response.peak_drift / 4.0 for response in real])
    np.testing.assert_allclose(mean_of(small, "real"), ratios.mean(axis=0), rtol=1e-12)
    np.testing.assert_allclose(mean_of(small, "real", "p84"), np.quantile(ratios, 0.84, axis=0), rtol=1e-12)
    slip = np.array([response.peak_slip[0] for response in real])
    row = small.slip.filter(model="real").row(0, named=True)
    assert row["peak_mean"] == pytest.approx(slip.mean(), rel=1e-12)
    assert row["peak_max"] == slip.max()
    # The code counts a quarter of the design live load, of which 0.8 is present.
    mass = scene.building.mass + 0.25 * np.array([3.0e6 / G, 0.0])
    code = sm.Building(
        mass,
        scene.building.stiffness,
        yield_shear=scene.building.yield_shear,
        damping=scene.building.damping_matrix,
        geometric_stiffness=scene.geometric_stiffness,
    )
    drifts = np.array([sm.simulate(sm.Scene(code), motion).peak_drift / 4.0 for motion in motions])
    np.testing.assert_allclose(mean_of(small, "code"), drifts.mean(axis=0), rtol=1e-12)


def test_the_effective_fraction_is_that_of_the_scene(small: sm.Assessment) -> None:
    assert small.scaling is not None
    motions = [r.scaled(f) for r, f in zip(sm.builtin_suite("forty"), small.scaling.factors, strict=True)]
    for model, factor in (("real", 1.0), ("real_mu_low", 0.67), ("real_mu_high", 1.5)):
        alone = sm.effective_mass(sm.read_building(tables()).scene(mu_factor=factor), motions, resamples=200)
        assert small.effective[model].value == alone.value
        assert small.effective[model].interval == alone.interval
    largest = small.runs.filter(model="attached").group_by("motion").agg(pl.col("peak_drift_ratio").max())
    curve = small.effective["real"].curve.filter(storey=0, fraction=1.0)
    mean = np.minimum(largest["peak_drift_ratio"].to_numpy(), 0.10).mean()
    assert mean == pytest.approx(curve["model_drift"].item(), rel=1e-12)


def test_attached_models_are_those_of_the_effective_fraction() -> None:
    scene = sm.read_building(tables()).scene()
    goods = np.array([0.8 * 3.0e6 / G, 0.0])
    ours, theirs = with_mass(scene, 0.4 * goods), sm.attached_scene(scene, 0.4)
    motion = sm.builtin_suite("forty")[0].motion
    np.testing.assert_allclose(sm.simulate(ours, motion).peak_drift, sm.simulate(theirs, motion).peak_drift, rtol=1e-12)


def test_motions_are_scaled_for_the_period_with_goods(small: sm.Assessment) -> None:
    building = sm.read_building(tables())
    scaling = sm.scaling.scale_asce7_10(
        sm.builtin_suite("forty"),
        sm.TargetSpectrum.asce7(1.0, 0.6),
        building.period(building.goods_mass),
        between=False,
    )
    assert small.scaling is not None
    np.testing.assert_array_equal(small.scaling.factors, scaling.factors)
    other = sm.assess(tables(), FEW, scaling_period=0.7, mu_factors=(1, 1), resamples=2)
    assert other.scaling is not None
    assert other.scaling.periods[0] == pytest.approx(0.14, rel=1e-12)
    assert list(other.effective) == ["real"]
    as_they_are = sm.assess(tables(), FEW, scale=False, mu_factors=(1, 1), resamples=2)
    assert as_they_are.scaling is None
    assert "Motions are taken as they are." in as_they_are.assumptions


def test_stability_coefficients_are_load_times_drift_over_shear_times_height(small: sm.Assessment) -> None:
    """P = 5000 kN of floors and 2400 kN of goods on storey 1, 2500 kN on storey 2; the elastic value is P/(k h)."""
    building = sm.read_building(tables())
    for storey, load in ((1, 7.4e6), (2, 2.5e6)):
        rows = small.runs.filter(model="real", storey=storey)
        drift, shear = rows["peak_drift"].to_numpy().mean(), rows["peak_storey_shear"].to_numpy().mean()
        row = small.storeys.filter(model="real", storey=storey).row(0, named=True)
        assert row["theta"] == pytest.approx(load * drift / (shear * 4.0), rel=1e-12)
        assert row["theta_elastic"] == pytest.approx(load / (building.stiffness[storey - 1] * 4.0), rel=1e-12)


def test_the_share_advised_covers_every_friction(warehouse: sm.Assessment) -> None:
    values = [result.value for result in warehouse.effective.values()]
    assert warehouse.advised is not None
    assert max(values) <= warehouse.advised < max(values) + 0.01
    assert warehouse.advised_of_live_load == pytest.approx(0.8 * warehouse.advised, rel=1e-12)
    # By the definition a larger share is never short: the largest drift of each friction is covered.
    curve = warehouse.effective["real_mu_high"].curve.filter(storey=0)
    assert curve.filter(pl.col("fraction") >= warehouse.advised)["ratio"].max() <= 1.0
    assert warehouse.storeys["model"].unique(maintain_order=True).to_list() == MODELS


@pytest.mark.parametrize(("value", "share"), [(0.5, 0.5), (0.5 + 1e-13, 0.5), (0.501, 0.51), (0.0, 0.0), (0.991, 1.0)])
def test_shares_are_rounded_up_to_a_hundredth(value: float, share: float) -> None:
    assert rounded_up(value) == share


def test_friction_that_holds_the_goods_gives_all_of_them() -> None:
    """mu = 50: nothing slides, real and attached are one, and the share is exactly 1."""
    result = sm.assess(tables(goods={"mu": 50.0}), FEW, resamples=20)
    assert {effective.kind for effective in result.effective.values()} == {"stuck"}
    assert result.advised == 1.0
    np.testing.assert_allclose(mean_of(result, "real"), mean_of(result, "attached"), rtol=1e-12)
    assert "No goods slide under any motion." in result.advice
    assert any("mu_s of block 1 is 50, above 1.5" in remark for remark in result.remarks)


def test_goods_without_friction_add_no_mass() -> None:
    result = sm.assess(tables(goods={"mu": 0.0}), FEW, resamples=20)
    assert result.advised == 0.0
    np.testing.assert_allclose(mean_of(result, "real"), mean_of(result, "bare"), rtol=1e-12)


def test_without_goods_the_answer_says_so(tmp_path: Path) -> None:
    result = sm.assess(tables(goods={"live_load_kpa": 0.0, "mu": None}), FEW)
    assert result.advised is None
    assert result.effective == {}
    assert result.storeys["model"].unique().to_list() == ["bare"]
    assert "ANSWER    No answer, because there are no goods on the floors, and no live load could act as mass." in (
        result.text
    )
    names = {path.name for path in result.write(tmp_path)}
    assert {"drift.png", "storeys.csv", "assessment.json"} <= names
    assert "effective_fraction.png" not in names
    document = json.loads(result.to_json())
    assert document["answer"] is None
    assert document["reason"] == "there are no goods on the floors, and no live load could act as mass"


def test_without_heights_drifts_are_in_millimetres() -> None:
    result = sm.assess(tables(building={"height_m": None}), FEW, resamples=20)
    assert result.storeys["unit"].unique().to_list() == ["m"]
    assert result.storeys["limit"].null_count() == result.storeys.height
    assert "Peak storey drift, mm" in result.text
    assert "stability coefficient" not in result.text.lower()
    assert any(line == "P-Delta: none (heights are not known)." for line in result.assumptions)


@pytest.fixture(scope="module")
def collapsing() -> sm.Assessment:
    """A collapse ratio below most drifts."""
    return sm.assess(tables(building={"collapse_drift_ratio": 0.009}), resamples=20)


def test_many_collapses_leave_a_capped_mean_and_no_answer(collapsing: sm.Assessment) -> None:
    """Runs that collapse count their peaks until then, in tables too; the answer says how many there are."""
    collapsed = collapsing.collapses["real"]
    assert collapsed > 4
    assert mean_of(collapsing, "real", "collapsed")[0] == collapsed
    drifts = collapsing.runs.filter(model="real", storey=1)["peak_drift_ratio"].to_numpy()
    assert mean_of(collapsing, "real")[0] == pytest.approx(drifts.mean(), rel=1e-12)
    assert drifts.max() == pytest.approx(0.009, rel=1e-12)
    assert mean_of(collapsing, "real", "theta")[0] > 0.0
    assert mean_of(collapsing, "real", "max")[0] is None
    assert f"goods slide {collapsed}" in collapsing.text
    assert collapsing.advised is None
    # The friction with most collapses is named; of several the stated one.
    reals = {name: count for name, count in collapsing.collapses.items() if name.startswith("real")}
    worst = max(reals.values())
    assert collapsing.answer.statement.startswith("No answer, because the building with goods that slide (")
    assert f") collapses under {worst} of 40 motions" in collapsing.answer.statement
    told = next(line for line in collapsing.advice if line.startswith("Of 40 runs each some collapse: "))
    assert f") under {worst}, analysis 2 under {collapsing.collapses['bare']}" in told
    assert "more than a tenth." in collapsing.answer.statement
    document = json.loads(collapsing.to_json())
    assert document["answer"] is None
    assert document["reason"] == collapsing.answer.reason


def test_without_an_answer_nothing_stands_as_if_there_were_one(collapsing: sm.Assessment, tmp_path: Path) -> None:
    """No nan, no share, no empty figure, no green bar; what has no value is told from what is not met."""
    assert "nan" not in collapsing.text
    assert "lambda = " not in collapsing.text
    assert not any("Attach" in line or "attach " in line for line in collapsing.advice)
    collapsing.write(tmp_path)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert '<div class="answer bad">' in page
    assert "nan" not in page.lower().replace("name", "")[: page.index("<h2")]
    # A fraction is no answer where there is none.
    assert {file.stem for file in tmp_path.glob("*.svg")} == set(collapsing.figure_names) == {"drift", "spectrum"}


def test_a_building_that_always_collapses_has_no_empty_figures(tmp_path: Path) -> None:
    """Every drift is above a collapse ratio of 0.001: no fraction has a value."""
    result = sm.assess(tables(building={"collapse_drift_ratio": 0.001}), FEW, resamples=20)
    assert result.answer.reason == (
        "the building with goods that slide (mu as stated) collapses under 3 of 3 motions, more than a tenth"
    )
    assert result.figure_names == ("drift", "spectrum")
    result.write(tmp_path)
    assert not (tmp_path / "effective_fraction.svg").exists()
    assert "nan" not in result.text
    assert main(["report", str(tmp_path)]) == 0


def test_statistics_of_drifts_beside_a_collapse() -> None:
    """By hand, of 1 to 10 and a collapse at 11, capped at 8; 1.2 times the median, or the mean of the others."""
    drifts, fallen = np.arange(1.0, 12.0), np.arange(11) == 10
    known = drift_statistics(drifts, fallen, 8.0)
    assert known["mean"] == pytest.approx((36.0 + 3.0 * 8.0) / 11.0)
    assert known["mean_by_code"] == pytest.approx(1.2 * 6.0)
    assert known["median"] == 6.0
    assert known["p84"] == pytest.approx(9.4)  # place 8.4
    assert known["max"] is None
    assert drift_statistics(drifts, ~fallen, 8.0)["mean_by_code"] is None
    skewed = drift_statistics(np.array([1.0] * 8 + [50.0, 50.0]), np.arange(10) == 9, 100.0)
    assert skewed["mean_by_code"] == pytest.approx(58.0 / 9.0)
    whole = drift_statistics(drifts, np.zeros(11, dtype=bool), np.inf)
    assert whole["mean"] == whole["mean_by_code"] == whole["median"] == 6.0


def test_collapses_that_the_code_allows() -> None:
    building = sm.read_building(tables())
    assert [collapses_allowed(building, motions) for motions in (7, 10, 11, 19, 20, 40)] == [0, 0, 1, 1, 2, 2]
    hospital = sm.read_building(tables(building={"risk_category": "IV"}, code={"id": "asce7-16"}))
    assert [collapses_allowed(hospital, motions) for motions in (7, 11, 20)] == [0, 0, 1]


def test_occupancy_that_differs_keeps_the_codes_mass() -> None:
    """The code counts design live load; that half of it is away on a floor changes the goods alone."""
    result = sm.assess(
        {**tables(), "storeys": [{"occupied": 0.5}, {"occupied": 1.0}]}, FEW, mu_factors=(1, 1), resamples=20
    )
    assert result.building.present_share == pytest.approx(0.75, rel=1e-12)
    assert result.advised is not None
    assert result.advised_of_live_load == pytest.approx(0.75 * result.advised, rel=1e-12)


def test_another_code_changes_the_design_too() -> None:
    one = sm.assess(tables(), FEW, mu_factors=(1, 1), resamples=2)
    other = sm.assess(tables(), FEW, code=sm.codes.code_fraction("nbc"), mu_factors=(1, 1), resamples=2)
    strengths = [result.building.structure().yield_shear[0] for result in (one, other)]
    assert strengths[1] > strengths[0]
    assert any("NBC of Canada, storage, 0.6 of the design live load" in line for line in other.assumptions)
    assert "the fraction of NBC of Canada was not checked against the code (second-hand)" in other.remarks


def test_results_do_not_depend_on_threads_and_progress_ends() -> None:
    calls: list[tuple[int, int]] = []
    one = sm.assess(tables(), FEW, resamples=20, threads=1, progress=lambda done, total: calls.append((done, total)))
    two = sm.assess(tables(), FEW, resamples=20, threads=2)
    assert one.to_dict() == two.to_dict()
    # Seven models, three frictions, 21 shares, two models at each of 21 shares of a design, and with full floors three
    # frictions and 21 shares, under three motions.
    assert calls[-1] == ((7 + 3 + 21 + 42 + 24) * 3, (7 + 3 + 21 + 42 + 24) * 3)
    assert [done for done, _ in calls] == sorted(done for done, _ in calls)


@pytest.mark.parametrize("limit", [0.004, 0.02, 0.025, 0.03, 0.04, None])
@pytest.mark.parametrize("category", ["II", "IV", None])
@pytest.mark.parametrize(
    ("code", "scaling"), [("asce7-10", None), ("asce7-16", None), ("asce7-22", None), ("ec8", "asce7-16")]
)
def test_a_limit_of_the_design_level_is_doubted_at_the_mce(
    limit: float | None, category: str | None, code: str, scaling: str | None
) -> None:
    """Table 12.12-1: 0.020 in categories I and II, 0.010 in IV, twice that at MCE_R by 16.4.1.2."""
    building = {"drift_limit": limit, "risk_category": category if code != "ec8" else None}
    own = sm.read_building(tables(building=building, code={"id": code, "scaling": scaling}))
    said = [text for text in building_doubts(own, own.scene(), own.target) if "is one of the design level" in text]
    most = 0.010 if building["risk_category"] == "IV" else 0.020
    at_mce = "asce7-10" not in (code, scaling)
    assert len(said) == (limit is not None and at_mce and limit <= most)
    if said:
        assert f"is {2 * limit:g} meant?" in said[0]


def test_what_is_unlikely_is_remarked_on() -> None:
    """Goods of 6 kPa on a floor of 0.05 kPa, and a limit in per cent."""
    wrong = tables(building={"dead_load_kpa": 0.05, "drift_limit": 2.0, "p_delta": False})
    remarks = sm.assess(wrong, FEW, mu_factors=(1, 1), resamples=2).remarks
    assert any("the goods present weigh 48 times the building" in remark for remark in remarks)
    assert "the drift limit is 2 of the height: limits are ratios, not per cent" in remarks
    assert len(set(remarks)) == len(remarks)


DOUBTS: list[tuple[dict[str, Any], str]] = [
    # S_DS in m/s2, and S_DS and S_D1 exchanged.
    ({"site": {"sds_g": 9.81, "sd1_g": 5.9}}, "S_DS of the target spectrum is 9.81 g, above 4 g"),
    ({"site": {"sds_g": 1.0, "sd1_g": 6.0}}, "S_D1 of the target spectrum is 6 g, above S_DS = 1 g"),
    # Loads in psf; a mass in place of a weight, and one in lb over an area in m2.
    ({"goods": {"live_load_kpa": 125.0}}, "design live load of floor 1 is 125 kPa, above 25 kPa: are loads in kPa"),
    ({"building": {"dead_load_kpa": 125.0}}, "dead load of floor 1 is 125 kPa, above 20 kPa (and 1 more)"),
    (
        {"building": {"dead_load_kpa": None, "mass_kg": 2500.0}},
        "weight over the area of floor 1 is 0.04903 kPa, outside",
    ),
    (
        {"building": {"dead_load_kpa": None, "mass_kg": 2.5e6}},
        "weight over the area of floor 1 is 49.03 kPa, outside 0.5",
    ),
    # Limits in per cent.
    ({"building": {"drift_limit": 2.0}}, "the drift limit is 2 of the height: limits are ratios"),
    ({"building": {"collapse_drift_ratio": 10.0}}, "the collapse drift ratio is 10 of the height"),
    ({"building": {"theta_limit": 25.0}}, "the limit of the stability coefficient is 25: limits are ratios"),
    # Storeys from the roof down, by their names and by their goods.
    ({"storeys": [{"name": "Roof", "live_load_kpa": 0.0}, {}]}, "floor 1 of 2 is named Roof: storeys are listed from"),
    ({"storeys": [{"live_load_kpa": 0.0}, {}, {}]}, "floor 1 is the only one without goods, the uppermost has some"),
    # Strength of a slider: damping in the modes carries what it cannot.
    (
        {
            "building": {"design": None, "R": None, "period_s": None, "stiffness_kn_per_m": 1e5, "second_slope": 1e-4},
            "storeys": [
                {"stiffness_kn_per_m": 1e7, "yield_shear_over_weight": 0.06},
                {"live_load_kpa": 0.0, "yield_shear_over_weight": 5.0},
            ],
        },
        "spring and damping of storey 1 carry ",
    ),
    # Strengths stated as a thousandth of what they are over the weight.
    (
        {"building": {"design": None, "R": None, "yield_shear_over_weight": 0.01, "p_delta": False}},
        "the yield shear of storey 1 is 0.01 of the weight",
    ),
]


@pytest.mark.parametrize(("changes", "doubt"), DOUBTS, ids=range(len(DOUBTS)))
def test_a_doubt_about_the_input_stands_in_the_headline(changes: dict[str, Any], doubt: str) -> None:
    given = tables(**{name: values for name, values in changes.items() if name != "storeys"})
    given["storeys"] = changes.get("storeys", given["storeys"])
    result = sm.assess(given, FEW, mu_factors=(1, 1), resamples=2)
    assert any(sentence.startswith(doubt) for sentence in result.answer.doubts), result.answer.doubts
    assert "ANSWER    DOUBTFUL INPUT: " in result.text
    assert any(sentence.startswith(doubt) for sentence in result.remarks)
    document = json.loads(result.to_json())
    assert document["doubts"] == list(result.answer.doubts)
    assert document["headline"].startswith(f"DOUBTFUL INPUT: {result.answer.doubts[0]}; ")
    page = building_page(result, {})
    assert '<div class="answer bad">' in page
    assert "DOUBTFUL INPUT: " in page


def test_ordinary_buildings_raise_no_doubt(small: sm.Assessment, warehouse: sm.Assessment) -> None:
    for result in (small, warehouse):  # of the building; motions are the suite's
        assert [doubt for doubt in result.answer.doubts if "scaled motions" not in doubt] == []
    assert "two analyses; the larger drift of each storey counts" in small.text
    # A wharf carries 48 kPa; its code says that it is one.
    wharf = tables(code={"id": "asce61-14"}, goods={"live_load_kpa": 48.0}, building={"dead_load_kpa": 15.0})
    assert not any(
        "live load" in doubt for doubt in sm.assess(wharf, FEW, mu_factors=(1, 1), resamples=2).answer.doubts
    )


@pytest.mark.parametrize("cap", [0.05, 0.1, np.inf])
def test_a_drift_cap_needs_heights(cap: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is a ratio: drifts in metres are not capped, by a file, an argument or an option."""
    without = tables(building={"height_m": None})
    with pytest.raises(
        sm.errors.InvalidOption, match="drift_cap of assessment must be left out without storey heights"
    ):
        sm.assess(without, FEW, drift_cap=cap, resamples=2)
    with pytest.raises(sm.errors.InvalidBuildingFile, match=r"height_m .* must be given where building\.drift_cap is"):
        sm.read_building(tables(building={"height_m": None, "drift_cap": 0.05}))
    file = tmp_path / "low.json"
    file.write_text(json.dumps(without), encoding="utf-8")
    assert main(["building", str(file), "--drift-cap", "0.05", "--no-figures", "--out", str(tmp_path / "out")]) == 2
    assert "must be left out without storey heights" in capsys.readouterr().err


def test_shares_and_drifts_without_each_motion() -> None:
    """By hand from the runs: the largest capped mean of the others over both analyses, frictions and storeys."""
    result = sm.assess(tables(building={"drift_cap": 0.02}), FEW, resamples=2)
    assert result.scaling is not None
    table = result.left_out
    assert table["factor"].to_list() == result.scaling.factors.tolist()
    for name in ("pgv", "pgd"):
        scaled = [getattr(record.scaled(factor), name) for record, factor in zip(FEW, table["factor"], strict=True)]
        assert table[name].to_list() == pytest.approx(scaled, rel=1e-12)
    for motion in (1, 2, 3):
        others = result.runs.filter(pl.col("model").is_in(["code", "attached"]).not_(), pl.col("motion") != motion)
        means = others.group_by("model", "storey").agg(pl.col("peak_drift_ratio").clip(upper_bound=0.02).mean())
        assert table["governing"][motion - 1] == pytest.approx(means["peak_drift_ratio"].max(), rel=1e-12)
        largest = max(one.records["value_without"][motion - 1] for one in result.effective.values())
        assert table["fraction"][motion - 1] == largest
    assert json.loads(result.to_json())["left_out"] == table.to_dicts()
    alone = sm.assess(tables(), FEW[:1], scale=False, mu_factors=(1, 1), resamples=2).left_out
    assert alone["fraction"].to_list() == alone["governing"].to_list() == [None]


def test_motions_like_no_recording_and_one_that_decides_are_doubts() -> None:
    """A factor above 4, a PGV above 2.5 m/s, and a share of three motions that hangs on one."""
    weak = [record.scaled(0.15) for record in FEW]
    doubts = sm.assess(tables(), weak, mu_factors=(1, 1), resamples=2).answer.doubts
    assert any(
        "3 of 3 scaled motions have a PGV above 2.5 m/s or a factor above 4: motion " in doubt for doubt in doubts
    )
    strong = [*FEW[:2], FEW[2].scaled(3.0 / FEW[2].pgv)]
    result = sm.assess(tables(), strong, scale=False, mu_factors=(1, 1), resamples=2)
    assert any(
        f"1 of 3 scaled motions has a PGV above 2.5 m/s or a factor above 4: motion 3, {FEW[2].name} (PGV 3.00" in d
        for d in result.answer.doubts
    )
    change = (result.left_out["fraction"] - result.effective["real"].value).abs()
    named = f"without motion {change.arg_max() + 1}, "
    assert any(named in doubt for doubt in result.answer.doubts) == (change.max() > 0.1)


def test_strong_motions_and_large_drifts_are_doubts() -> None:
    """Motions scaled by 20: a mean PGA above 3 g, and drifts above 10 % of the height."""
    motions = [record.scaled(20.0) for record in sm.builtin_suite("seven")]
    result = sm.assess(tables(building={"p_delta": False}), motions, scale=False, mu_factors=(1, 1), resamples=2)
    assert any(doubt.startswith("the mean PGA of the motions is ") for doubt in result.answer.doubts)
    assert any("above 10 %: no building stands this" in doubt for doubt in result.answer.doubts)
    assert sum("has a PGA of" in doubt for doubt in result.answer.doubts) == 1


def test_inertia_over_the_spring_force_is_that_of_the_run() -> None:
    """Mass times absolute acceleration above the storey, over its peak spring force; there are no goods."""
    building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.1, 0.1])
    scene, record = sm.Scene(building), sm.builtin_suite("seven")[0]
    run = sm.simulate(scene, record, histories=True)
    inertia = np.abs((building.mass * run.floor_acceleration).sum(axis=1)).max()
    expected = inertia / np.abs(run.storey_shear[:, 0]).max()
    assert force_ratios(scene, [record])[0] == pytest.approx(expected, rel=1e-9)


def test_mixed_use_counts_floor_by_floor() -> None:
    """The code's model has the mass of each floor; floors that a code exempts and full offices are remarked on."""
    given = tables(goods={"occupied": None})
    given["storeys"] = [{"use": "ordinary", "occupied": 1.0}, {}, {"live_load_kpa": 0.3}]
    result = sm.assess(given, FEW, mu_factors=(1, 1), resamples=2)
    # 0.25 of 0.3 kPa is below 5 % of the dead load of the floor: 12.7.2, exception a.
    assert result.building.code_share == pytest.approx(0.25 * 6.0 / 12.3, rel=1e-12)
    assert any(remark.startswith("floor 3 is exempt: at most 5 % of the weight") for remark in result.remarks)
    assert any("ordinary live load of floor 1 is taken as rigid goods" in remark for remark in result.remarks)
    by_floor = (
        "by floor 1: 0 (ordinary), 2: 0.25, 3: 0 (exempt: at most 5 % of the weight of the level), together 0.122"
    )
    assert any(by_floor in line for line in result.assumptions)
    storeys = json.loads(result.to_json())["input"]["storeys"]
    assert [row["code_fraction"] for row in storeys] == [0.0, 0.25, 0.0]
    given["storeys"][2]["exempt"] = False
    counted = sm.read_building(given)
    assert counted.code_share == pytest.approx((0.25 * 6.0 + 0.25 * 0.3) / 12.3, rel=1e-12)
    assert json.loads(result.to_json())["code"]["share_of_design_live_load"] == result.building.code_share


def test_a_slider_is_damped_above_alone_and_raises_no_doubt() -> None:
    """A weak, stiff first storey: with damping in all modes a doubt, with that of the building above it none."""
    given = tables(building={"design": None, "R": None, "period_s": None, "stiffness_kn_per_m": 1e5})
    given["storeys"] = [
        {"stiffness_kn_per_m": 1e7, "yield_shear_over_weight": 0.06, "live_load_kpa": 0.0, "second_slope": 1e-4},
        {"yield_shear_over_weight": 5.0},
    ]
    doubted = sm.assess(given, FEW, mu_factors=(1, 1), resamples=2).answer.doubts
    assert any(doubt.startswith("spring and damping of storey 1") for doubt in doubted)
    given["building"]["damping_from_storey"] = 2
    result = sm.assess(given, FEW, mu_factors=(1, 1), resamples=2)
    assert not any("spring and damping" in doubt for doubt in result.answer.doubts)
    assert any("above floor 1; the storeys below are not damped" in line for line in result.assumptions)


def test_wrong_arguments_are_refused() -> None:
    no_site = tables()
    del no_site["site"]
    with pytest.raises(sm.errors.InvalidOption, match=r"target of building building must be given: \[site\]"):
        sm.assess(no_site)
    with pytest.raises(
        sm.errors.InvalidMotion, match="motions of assessment must be a list of Records or Motions; got 3"
    ):
        sm.assess(tables(), 3)  # type: ignore[arg-type]
    with pytest.raises(sm.errors.InvalidMotion, match="motion 1 of assessment must be a Record or Motion; got 3"):
        sm.assess(tables(), [3])
    with pytest.raises(
        sm.errors.InvalidMotion, match="motions of assessment must be at least one Record or Motion; got none"
    ):
        sm.assess(tables(), [])
    with pytest.raises(sm.errors.InvalidOption, match="code of assessment must be a CodeFraction"):
        sm.assess(tables(), code="ec8")  # type: ignore[arg-type]
    with pytest.raises(sm.errors.InvalidOption, match="scaling_period of assessment must be a number"):
        sm.assess(tables(), scaling_period="1")  # type: ignore[arg-type]
    with pytest.raises(sm.errors.InvalidScene, match="P/h"):
        sm.assess(tables(building={"gravity_load_kn": 1e9}))
    target = sm.TargetSpectrum.asce7(1.0, 0.6)
    assert sm.assess(no_site, FEW, target=target, mu_factors=(1, 1), resamples=2).target is target


def test_files_are_written_whole_and_old_ones_removed(small: sm.Assessment, tmp_path: Path) -> None:
    files = small.write(tmp_path / "out")
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == sorted(path.name for path in files)
    assert pl.read_parquet(tmp_path / "out" / "runs.parquet").equals(small.runs)
    assert (tmp_path / "out" / "assessment.txt").read_text(encoding="utf-8") == small.text + "\n"
    small.write(tmp_path / "out", figures=False)
    assert not list((tmp_path / "out").glob("*.png"))
    (tmp_path / "file").write_text("")
    with pytest.raises(sm.errors.InvalidOption, match="must be a folder that can be written to"):
        small.write(tmp_path / "file")


def test_figures_have_what_they_should(warehouse: sm.Assessment) -> None:
    figures = warehouse.figures()
    assert list(figures) == ["drift", "effective_fraction", "spectrum"]
    for figure in figures.values():
        assert isinstance(figure, Figure)
    texts = [text.get_text() for text in figures["effective_fraction"].legends[0].get_texts()]
    assert any("0.25 of the design live load" in text for text in texts)
    assert any(text.startswith("advised") for text in texts)
    drifts, slips = figures["drift"].axes
    assert drifts.get_xlim()[1] > 100.0  # the limit is in sight
    largest = warehouse.slip["peak_p84"].max()
    assert slips.get_xlim()[1] == pytest.approx(1.3e3 * largest, rel=1e-9)
    row = warehouse.governing.sort("governing").row(-1, named=True)
    title = (
        f"Storey {row['storey']} uses {100.0 * row['governing'] / 0.02:.0f} % of its drift limit: {row['governed_by']}"
    )
    assert " ".join(drifts.get_title(loc="left").split()) == title
    assert " ".join(slips.get_title(loc="left").split()).startswith(
        f"Allow for {1e3 * largest:.0f} mm of slip on floor"
    )


def test_the_page_says_the_answer_first(warehouse: sm.Assessment) -> None:
    """Plain words, both analyses, the base of shares once, what governs, why, on which motions."""
    lines = warehouse.text.splitlines()
    first = next(number for number, line in enumerate(lines) if "two analyses; the larger drift" in line)
    assert warehouse.answer.statement in " ".join(" ".join(lines[3:first]).split())
    share, load = warehouse.advised, warehouse.advised_of_live_load
    assert lines[first + 1] == (
        f"          1  lambda = {share:.2f} of the goods present ({load:.2f} of the design live load) as mass: "
        f"dead + {load:.2f} live"
    )
    assert lines[first + 2] == "          2  no goods: dead load alone"
    box = " ".join(" ".join(lines[3:36]).split())
    value = max(effective.value for effective in warehouse.effective.values())
    assert f"why {share:.2f} since mu x 1.5 gives {value:.2f} [" in box
    assert "rounded up to a multiple of 0.01" in box
    assert "motions on 40 synthetic motions, none recorded, scaled by " in box
    assert all(len(line) <= 120 for line in lines)
    for heading in ("What each storey uses of its", "Peak storey drift", "In an analysis", "Assumptions"):
        assert any(line.startswith(heading) for line in lines)


def test_the_governing_drift_is_the_largest_of_its_row(warehouse: sm.Assessment, small: sm.Assessment) -> None:
    """Of both analyses and all frictions, as printed; sliding goods are named only where they drift more."""
    for result in (warehouse, small):
        for row in result.governing.iter_rows(named=True):
            models = ("advised", "bare", "real", "real_mu_low", "real_mu_high")
            means = {model: mean_of(result, model)[row["storey"] - 1] for model in models}
            assert [row[model] for model in models] == list(means.values())
            assert round(100.0 * row["governing"], 2) == round(100.0 * max(means.values()), 2)
            by = "analysis 1" if means["advised"] >= means["bare"] else "analysis 2"
            if round(100.0 * max(means["advised"], means["bare"]), 2) == round(100.0 * row["governing"], 2):
                assert row["governed_by"] == by
            else:
                assert row["governed_by"].startswith("goods slide, mu")
    document = json.loads(warehouse.to_json())
    governs = " ".join(document["answer"]["governs"])
    largest = max(row["governing"] for row in document["governing"])
    assert f"{100.0 * largest:.2f} % of 2 %" in governs


def test_masses_of_both_analyses_are_those_of_the_models(warehouse: sm.Assessment) -> None:
    masses, building = warehouse.tables["analysis"], warehouse.building
    np.testing.assert_allclose(
        1e3 * masses["mass_1_t"], building.mass + warehouse.advised * building.goods_mass, rtol=1e-14
    )
    np.testing.assert_allclose(1e3 * masses["mass_2_t"], building.mass, rtol=1e-14)
    np.testing.assert_allclose(masses["weight_1_kn"], G * masses["mass_1_t"].to_numpy(), rtol=1e-14)
    # Goods are 0.8 of the live load on floors 1 to 3, and the roof has none.
    np.testing.assert_allclose(masses["multiplier_1"], [*3 * [0.8 * warehouse.advised], 0.0], rtol=1e-14)


def test_the_share_for_strengths_is_that_of_the_design(small: sm.Assessment) -> None:
    """`effective_mass_of_design` at the friction that decides; stated strengths have none."""
    assert small.scaling is not None
    building = sm.read_building(tables())
    motions = [r.scaled(f) for r, f in zip(sm.builtin_suite("forty"), small.scaling.factors, strict=True)]
    alone = sm.effective_mass_of_design(
        lambda share: building.structure(None, share * building.goods_mass),
        building.scene(mu_factor=1.5).blocks,
        motions,
    )
    assert small.design is not None
    assert small.design.value == pytest.approx(alone.value, abs=1e-9)
    assert f"{rounded_up(alone.value):.2f} of the goods present" in small.answer.design
    stated = sm.assess(
        tables(building={"design": None, "R": None, "yield_shear_over_weight": 0.3}),
        FEW,
        mu_factors=(1, 1),
        resamples=2,
    )
    assert stated.design is None
    assert stated.answer.design == (
        f"Strengths are as stated. lambda = {stated.advised:.2f} is for the analysis, not for the weight W of a design."
    )


def test_a_share_that_changes_nothing_is_said_not_to_matter() -> None:
    """Goods of 0.15 % of the floor."""
    result = sm.assess(tables(goods={"live_load_kpa": 0.0075}), mu_factors=(1, 1), resamples=20)
    assert result.answer.matters is False
    assert result.answer.statement.startswith("The share does not matter: no storey's drift changes by more than 0.")
    assert json.loads(result.to_json())["answer"]["share_matters"] is False


@pytest.mark.usefixtures("few_motions")
def test_command_prints_page_and_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["building", "--example"]) == 0
    file = tmp_path / "warehouse.toml"
    file.write_text(capsys.readouterr().out, encoding="utf-8")
    assert file.read_text(encoding="utf-8") == example_file().read_text(encoding="utf-8")
    out = str(tmp_path / "out")
    assert main(["building", str(file), "--out", out, "--no-figures", "--mu-factors", "1", "1"]) == 0
    page = capsys.readouterr().out
    assert "two analyses; " in page
    assert page.rstrip().splitlines()[-1].startswith("27 files in ")
    options = ["--json", "--no-figures", "--sds", "0.8", "--sd1", "0.5", "--code", "nbc", "--period", "0.6"]
    assert main(["building", str(file), "--out", out, *options]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["code"]["fraction"] == 0.6
    assert document["target"]["sds_g"] == 0.8
    assert document["assumptions"]


def test_command_lists_codes_and_frictions(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["building", "--codes"]) == 0
    assert "from memory, unverified" in capsys.readouterr().out
    assert main(["building", "--frictions"]) == 0
    assert "timber-on-steel " in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["none.toml"], "building file must be a file that can be read"),
        ([str(example_file()), "--tl", "3"], "must be given by --sds and --sd1 together; got --tl alone"),
        ([str(example_file()), "--sds", "1"], "must be given by --sds and --sd1 together; got --sds alone"),
        ([str(example_file()), "--code", "ec9"], "did you mean ec8?"),
        ([str(example_file()), "--use", "storage"], "--use of building must be left out where --code is not given"),
        ([str(example_file()), "--mu-factors", "2", "3"], "mu_factors of assessment must be two factors"),
    ],
)
def test_command_refuses_bad_input(
    options: list[str], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["building", *options, "--out", str(tmp_path / "out")]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_command_takes_recordings(shared: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    records = shared / "records" / "fema_p695_far_field"
    options = ["--records", str(records), "--out", str(tmp_path), "--no-figures", "--json"]
    assert main(["building", str(example_file()), *options]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["suite"]["synthetic"] == 0
    assert not any("synthetic" in remark for remark in document["remarks"])
    assert 0.0 < document["effective"]["real"]["value"] < document["answer"]["advised_share_of_goods_present"] <= 1.0


@pytest.mark.parametrize("kind", ["racks", "base", "two directions"])
def test_what_takes_long_is_solved_once(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """No scene with goods that slide is solved twice under a motion, but those that say how many digits stand."""
    extra: dict[str, dict[str, Any]] = {
        "racks": {"goods": {"on_racks": {"period_s": 0.8}}},
        "base": {"base": {"mu": 0.05}},
        "two directions": {"other_direction": {"period_s": 0.5}},
    }
    stated = tables(**extra[kind])
    motions = list(sm.records.builtin_pairs() if kind == "two directions" else sm.builtin_suite("seven"))[:3]
    seen: list[tuple[sm.Scene, int]] = []

    def noted(scenes: Any, motions: Any, rows: Any, **how: Any) -> Any:
        seen.extend((scenes[scene], motion) for scene, motion in rows.tolist() if scenes[scene].goods)
        return solve_engine(scenes, motions, rows, **how)

    for module in ("runs.batch", "runs.peaks"):
        monkeypatch.setattr(f"seismass.{module}.solve_engine", noted)
    calls: list[tuple[int, int]] = []
    result = sm.assess(stated, motions, resamples=20, progress=lambda done, total: calls.append((done, total)))
    assert len(seen) >= 3 * len(motions)  # at three frictions
    assert not [one for place, one in enumerate(seen) if one in seen[:place]]
    assert calls[-1][0] == calls[-1][1]
    monkeypatch.undo()
    scene = sm.read_building(stated).scene()
    factors = [1.0] * len(motions) if result.scaling is None else result.scaling.factors
    peaks = sm.simulate_many(scene, [motion.scaled(float(f)) for motion, f in zip(motions, factors, strict=True)])
    real = result.runs.filter(model="real", storey=1)
    assert real["peak_floor_acceleration"].to_list() == [row[0] for row in peaks["peak_floor_acceleration"]]
    assert real["residual_drift"].to_list() == [row[0] for row in peaks["residual_drift"]]
