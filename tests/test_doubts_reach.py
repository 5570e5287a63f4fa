"""What is unlikely about an input reaches who asks: batches, effective mass, fragility, risk, slip, commands."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main
from seismass.model.plausibility import limit_remarks
from seismass.runs.scene_file import example_scene

TWO_STOREYS = Path(__file__).with_name("data") / "two_storeys.json"
WORD = "mu_s of block 1 is 20, above 1.5: friction coefficients are ratios, not per cent"


@pytest.fixture(scope="module")
def scene() -> sm.Scene:
    """Friction in per cent."""
    building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
    return sm.Scene(building, [sm.Block(1, mass_ratio=1.0, mu=20.0)])


@pytest.fixture(scope="module")
def suite() -> list[sm.Record]:
    return list(sm.builtin_suite("seven"))


def test_a_batch_warns(scene: sm.Scene, suite: list[sm.Record], tmp_path: Path) -> None:
    with pytest.warns(sm.errors.DoubtfulInput, match="scene 1: mu_s of block 1 is 20"):
        table = sm.simulate_many([scene, scene], suite[:1])
    assert table.height == 2
    with pytest.warns(sm.errors.DoubtfulInput, match=r"\(and 1 more scenes\)"):
        sm.write_many(tmp_path / "runs.parquet", [scene, scene], suite[:1])
    strong = [record.scaled(40.0) for record in suite[:2]]
    usual = sm.Scene(scene.building, [sm.Block(1, mass_ratio=1.0, mu=0.2)])
    with pytest.warns(sm.errors.DoubtfulInput, match=r"motion 1, .* has a PGA of .*\(and 1 more motions\)"):
        sm.simulate_many(usual, strong)
    assert scene.building is not None
    grid = sm.Grid.product(scene.building, mass_ratio=1.0, mu=[20.0, 30.0])
    with pytest.warns(sm.errors.DoubtfulInput, match="scene 1: mu_s of block"):
        sm.simulate_many(grid, suite[:1])


def test_one_run_says_it(scene: sm.Scene, suite: list[sm.Record]) -> None:
    response = sm.simulate(scene, suite[0])
    assert WORD in response.remarks
    assert WORD in response.text


def test_effective_mass_says_it(scene: sm.Scene, suite: list[sm.Record]) -> None:
    result = sm.effective_mass(scene, [record.scaled(40.0) for record in suite], fractions=[0.0, 1.0], resamples=2)
    assert result.remarks[0] == WORD
    assert f"remark              {WORD}" in result.text
    assert "has a PGA of" in result.text
    assert sum("has a PGA of" in remark for remark in result.remarks) == 1


def test_a_collapse_is_no_nan(suite: list[sm.Record]) -> None:
    """Every drift is above a collapse drift of 0.1 mm: no share, and no number in its place."""
    building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
    falling = sm.Scene(building, [sm.Block(1, mass_ratio=1.0, mu=0.1)], collapse_drift=1e-4)
    result = sm.effective_mass(falling, suite, fractions=[0.0, 1.0], resamples=2)
    assert result.kind == "collapsed"
    assert "effective fraction  no value (no interval)" in result.text
    assert "with sliding goods the building collapses under more than a tenth of the motions" in result.text
    assert "nan" not in result.text


def test_fragility_risk_and_slip_say_it(scene: sm.Scene, suite: list[sm.Record]) -> None:
    limit = sm.fragility.LimitState("drift_ratio", 2.0)
    with_heights = sm.Scene(scene.building.replace(heights=4.0), scene.blocks) if scene.building is not None else scene
    found = sm.fragility.cloud_analysis(with_heights, suite, limit, resamples=0)
    assert found.remarks[0] == WORD
    assert found.remarks[1] == "the limit of drift_ratio is 2 of the height, above 0.2: limits are ratios, not per cent"
    slip = sm.slip.slip_demand(with_heights, suite, clearance=300.0)
    assert slip.remarks[:2] == (WORD, "the limit of clearance is 300 m, above 10: is it in m, not mm?")


def test_usual_limits_have_no_remark() -> None:
    usual = [("drift_ratio", 0.2), ("drift", 0.3), ("slip", 0.5), ("floor_acceleration_g", 2.0), ("collapse", 0.0)]
    assert limit_remarks(usual) == ()
    assert len(limit_remarks([("drift", 30.0), ("floor_acceleration_g", 9.81), ("residual_slip", 100.0)])) == 3


@pytest.mark.usefixtures("few_motions")
@pytest.mark.parametrize("words", [("fragility", "--method", "cloud"), ("slip",), ("risk", "--share", "0,1")])
def test_commands_say_it_before_their_answer(
    words: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A drift limit in per cent and goods in psf, as `seismass building` doubts them; 2 m of limit in a scene file."""
    text = example_file().read_text(encoding="utf-8")
    file = tmp_path / "b.toml"
    file.write_text(
        text.replace("live_load_kpa = 7.2", "live_load_kpa = 30").replace("# drift_limit = 0.020", "drift_limit = 0.3")
    )
    hazard = tmp_path / "hazard.csv"
    levels = np.geomspace(0.01, 100.0, 40)
    hazard.write_text("\n".join(["Sa,rate", *(f"{x:g},{0.01 * (x / 0.1) ** -2.5:.6g}" for x in levels), ""]))
    further = ["--hazard", str(hazard)] if words[0] == "risk" else []
    assert main([words[0], str(file), *words[1:], *further]) == 0
    out = capsys.readouterr().out
    first, second = out.splitlines()[:2]
    assert first.startswith("DOUBTFUL INPUT: design live load of floor 1 is 30 kPa, above 25 kPa")
    assert second.startswith("DOUBTFUL INPUT: the drift limit is 0.3 of the height: limits are ratios, not per cent")
    assert main([words[0], str(file), *words[1:], *further, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["remarks"][0].startswith("design live load of floor 1 is 30 kPa")


def test_a_scene_file_with_a_limit_in_per_cent(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["fragility", str(example_scene()), "--method", "cloud", "--suite", "seven", "--limit", "drift_ratio=2"]
    assert main(words) == 0
    assert capsys.readouterr().out.startswith("DOUBTFUL INPUT: the limit of drift_ratio is 2 of the height, above 0.2")


def test_without_goods_few_collapses_are_in_the_headline() -> None:
    """The headline says how many."""
    tables = json.loads(TWO_STOREYS.read_text(encoding="utf-8"))
    tables = {name: tables[name] for name in ("site", "building")} | {"storeys": [{}, {}]}
    largest = sm.assess(tables).runs.group_by("motion").agg(pl.col("peak_drift_ratio").max())
    second, first = sorted(largest["peak_drift_ratio"].to_list())[-2:]
    tables["building"] = {**tables["building"], "collapse_drift_ratio": 0.5 * (first + second)}
    result = sm.assess(tables)
    assert result.collapses == {"bare": 1}
    assert result.answer.statement.startswith("No answer, because there are no goods")
    assert result.answer.statement.endswith(" Of 40 runs each some collapse: the building under 1.")


@pytest.mark.parametrize(
    ("fit", "kind", "said"),
    [
        (lambda f: f.fit_counts([0.1, 0.2, 0.4], [3, 3, 3], 10), "falling", "not exceeded more often"),
        (lambda f: f.fit_counts([0.1, 0.1, 0.1], [3, 4, 5], 10), "none", "intensities that differ, are too few"),
        (lambda f: f.fit_counts([0.1], [3], 10), "none", "too few"),
        (lambda f: f.fit_counts([0.1, 0.2], [0, 0], 10), "never", "never exceeded"),
        (lambda f: f.fit_capacities([0.5, 0.5, 0.5]), "step", "dispersion is not known"),
        (lambda f: f.fit_cloud([0.2] * 4, [0.01, 0.02, 0.03, 0.04], 0.02), "none", "intensities that differ"),
        (lambda f: f.fit_cloud([0.1, 0.2, 0.3], [0.02] * 3, 0.03), "falling", "not exceeded more often"),
        (lambda f: f.fit_cloud([0.1, 0.2, 0.4], [0.01, 0.02, 0.04], 0.015), "step", "dispersion is not known"),
    ],
)
def test_degenerate_fits_are_none_and_say_why(fit: object, kind: str, said: str) -> None:
    """Equal counts, one intensity, runs on one line: no dispersion can be told from them."""
    found = fit(sm.fragility)  # type: ignore[operator]
    assert found.kind == kind
    assert not found.dispersion > 0.0
    assert said in found.text
    assert "nan" not in found.text
