"""The map of effective fractions against single answers, its rules by hand, its axis of intensity, its command."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.cli import main
from seismass.design import response_spectrum_analysis
from seismass.effective_mass.rule import RULE, RULES
from seismass.motions.spectra import mean_spectrum

SUITE = sm.builtin_suite("seven")
TARGET = sm.TargetSpectrum.asce7()
SMALL = sm.EffectiveMassParameters(
    buildings=((2, 0.38, "bare"), (3, 0.6, "loaded")),
    mass_ratios=(0.5, 1.0),
    response_modification=(1.0, 4.0),
    mus=(0.0, 0.2, 50.0),
)


@pytest.fixture(scope="module")
def small() -> sm.EffectiveMassMap:
    return sm.effective_mass_map(SUITE, TARGET, SMALL)


def motions_of(result: sm.EffectiveMassMap, row: dict[str, Any]) -> tuple[list[sm.Record], np.ndarray[Any, Any]]:
    """The motions of a case, scaled, and their factors."""
    factors = result.scaling[row["building"], row["alpha"]].factors
    return [record.scaled(float(factor)) for record, factor in zip(SUITE, factors, strict=True)], factors


def test_motions_are_scaled_for_the_period_of_each_building_with_its_goods(small: sm.EffectiveMassMap) -> None:
    """Goods in proportion to the masses lengthen the period by sqrt(1 + alpha); factors are those of that period."""
    for (number, alpha), scaling in small.scaling.items():
        if number == 2:
            assert scaling.period == pytest.approx(0.6 * np.sqrt(1.0 + alpha), rel=1e-12)
        alone = sm.scaling.scale_asce7_10(SUITE, TARGET, scaling.period, between=False)
        np.testing.assert_array_equal(scaling.factors, alone.factors)
    assert list(small.scaling) == [(1, 0.5), (1, 1.0), (2, 0.5), (2, 1.0)]
    assert small.tables["scaling"].height == 4 * len(SUITE)
    chosen = replace(SMALL, response_modification=(4.0,), mus=(0.2,), shares=3, scaling_period=1.0)
    stated = sm.effective_mass_map(SUITE, TARGET, chosen)
    at_one = sm.scaling.scale_asce7_10(SUITE, TARGET, 1.0, between=False).factors
    assert all((scaling.factors == at_one).all() for scaling in stated.scaling.values())


def test_cases_are_single_answers(small: sm.EffectiveMassMap) -> None:
    assert small.table.height == 2 * 2 * 2 * 3
    for row in small.table.iter_rows(named=True):
        motions, factors = motions_of(small, row)
        storeys = row["storeys"]
        bare = sm.Building.uniform(storeys, row["period"], mass=1.0)
        goods = np.full(storeys, row["alpha"])
        if row["roof"] == "bare":
            goods[-1] = 0.0
        shear = response_spectrum_analysis(
            bare.mass + 0.25 * goods, bare.stiffness, partial(mean_spectrum, SUITE, factors)
        ).storey_shear
        building = bare if row["R"] == 1.0 else bare.replace(yield_shear=shear / row["R"])
        answer = sm.effective_mass(sm.Scene(building, sm.blocks_on_floors(goods, row["mu"])), motions, resamples=2)
        assert row["kind"] == answer.kind
        # Interpolated between shares 0.01 apart, not refined.
        assert row["value"] == pytest.approx(answer.value, abs=2e-4)
        assert row["real"] == pytest.approx(answer.real, rel=1e-12)
        assert row["eta"] == pytest.approx(answer.eta, rel=1e-12)
        assert row["slides"] == (answer.kind != "stuck")
        worst = answer.storeys["ratio"].max()
        assert row["worst_storey_ratio"] == pytest.approx(worst, rel=1e-4)


def test_intervals_are_those_of_single_answers(small: sm.EffectiveMassMap) -> None:
    """Same seed, same number of resamples: the same draws of the same curves."""
    for row in small.table.filter((pl.col("R") == 1.0) & (pl.col("mu") > 0.0)).iter_rows(named=True):
        goods = [row["alpha"]] * row["storeys"]
        if row["roof"] == "bare":
            goods[-1] = 0.0
        scene = sm.Scene(
            sm.Building.uniform(row["storeys"], row["period"], mass=1.0), sm.blocks_on_floors(goods, row["mu"])
        )
        motions, _ = motions_of(small, row)
        answer = sm.effective_mass(
            scene, motions, fractions=small.fractions, resamples=SMALL.resamples, seed=SMALL.seed
        )
        assert (row["low"], row["high"]) == pytest.approx(answer.interval, abs=1e-9)


def test_interval_of_goods_without_friction(small: sm.EffectiveMassMap) -> None:
    """`effective_mass` gives (0, 0): the real building is the bare one in every resample."""
    frictionless = small.table.filter(pl.col("mu") == 0.0)
    assert frictionless["value"].to_list() == [0.0] * frictionless.height
    assert frictionless["high"].to_list() == [0.0] * frictionless.height


def test_table(small: sm.EffectiveMassMap) -> None:
    assert small.table.columns == [
        *("building", "storeys", "period", "roof", "R", "alpha", "intensity", "mu", "eta", "base_shear_coefficient"),
        *(
            "coefficient",
            "by_hand",
            "slides",
            "value",
            "kind",
            "low",
            "high",
            "real",
            "ratio_at_0",
            "ratio_at_0_25",
            "ratio_at_1",
        ),
        *("worst_storey_ratio", "worst_storey_ratio_at_1", "worst_storey_envelope_ratio"),
    ]
    assert small.table["building"].unique().sort().to_list() == [1, 2]
    stuck = small.table.filter(pl.col("mu") == 50.0)
    assert stuck["kind"].to_list() == ["stuck"] * 8
    np.testing.assert_allclose(stuck["ratio_at_1"], 1.0, rtol=1e-14)
    np.testing.assert_allclose(small.table.filter(pl.col("mu") == 0.0)["ratio_at_0"], 1.0, rtol=1e-14)


def test_shears_and_rules_of_a_yielding_case_by_hand(small: sm.EffectiveMassMap) -> None:
    """V_y of the design, C1 = S_a/R_y^(2/3) with S_a of the target at the bare period, and ratios of runs."""
    g = sm.STANDARD_GRAVITY
    cases = small.table.filter(R=4.0, mu=0.2)
    assert cases.height == 4
    for row in cases.iter_rows(named=True):
        factors = small.scaling[row["building"], row["alpha"]].factors
        bare = sm.Building.uniform(row["storeys"], row["period"], mass=1.0)
        goods = np.full(row["storeys"], row["alpha"])
        if row["roof"] == "bare":
            goods[-1] = 0.0
        designed = response_spectrum_analysis(
            bare.mass + 0.25 * goods, bare.stiffness, lambda at, factors=factors: mean_spectrum(SUITE, factors, at)
        )
        weight = g * (bare.mass + goods).sum()
        acceleration = float(TARGET([row["period"]])[0]) / g
        reduction = acceleration * weight / (designed.storey_shear[0] / 4.0)
        assert reduction > 1.0
        assert row["coefficient"] == pytest.approx(acceleration / reduction ** (2.0 / 3.0), rel=1e-12)
        share = min(1.0, max(0.0, 1.35 * 0.2 * reduction ** (2.0 / 3.0) / acceleration - 0.15))
        assert row["by_hand"] == pytest.approx(share, rel=1e-12)
        building = bare.replace(yield_shear=designed.storey_shear / 4.0)
        runs = {
            share: [
                sm.simulate(
                    sm.Scene(building.replace(mass=bare.mass + share * goods, damping=building.damping_matrix)), motion
                )
                for motion in (record.scaled(factor) for record, factor in zip(SUITE, factors, strict=True))
            ]
            for share in (0.0, 1.0)
        }
        shears = [run.peak_storey_shear[0] for run in runs[1.0]]
        assert row["base_shear_coefficient"] == pytest.approx(np.mean(shears) / weight, rel=1e-9)
        drifts = {share: np.mean([run.peak_drift.max() for run in some]) for share, some in runs.items()}
        assert row["ratio_at_0"] == pytest.approx(row["real"] / drifts[0.0], rel=1e-9)
        assert row["ratio_at_1"] == pytest.approx(row["real"] / drifts[1.0], rel=1e-9)


def test_rules_are_those_of_every_sliding_case(small: sm.EffectiveMassMap) -> None:
    """By a loop: the model's curve at the share by hand, and at 0.25, over the real drift."""
    table = small.rules()
    for name, share_of in ((RULE, lambda row: row["by_hand"]), ("ASCE 7 storage, 0.25", lambda row: 0.25)):
        ratios = []
        for case, row in enumerate(small.table.iter_rows(named=True)):
            if row["slides"]:
                curve = small.curves[small.curve_of[case]]
                ratios.append(float(np.interp(share_of(row), np.linspace(0.0, 1.0, 101), curve)) / row["real"])
        found = table.row(by_predicate=pl.col("rule") == name, named=True)
        assert found["bias"] == pytest.approx(np.prod(ratios) ** (1.0 / len(ratios)), rel=1e-12)
        assert found["log_scatter"] == pytest.approx(np.std(np.log(ratios)), rel=1e-12)
        assert found["unsafe"] == pytest.approx(sum(1.05 * ratio < 1.0 for ratio in ratios) / len(ratios))
        assert found["low"] == pytest.approx(np.percentile(ratios, 5.0), rel=1e-12)
        assert found["high"] == pytest.approx(np.percentile(ratios, 95.0), rel=1e-12)
        assert found["worst"] == pytest.approx(min(ratios), rel=1e-12)


def test_the_rule_of_an_elastic_case_is_that_of_the_answer(small: sm.EffectiveMassMap) -> None:
    """R_y = 1, and S_a of the target where it is given."""
    shares = RULES[RULE](small.table)
    for row, share in zip(small.table.iter_rows(named=True), shares, strict=True):
        if row["R"] == 1.0:
            scaled, _ = motions_of(small, row)
            bare = sm.Building.uniform(row["storeys"], row["period"], mass=1.0)
            goods = [row["alpha"]] * (row["storeys"] - 1) + [row["alpha"] if row["roof"] == "loaded" else 0.0]
            scene = sm.Scene(bare, sm.blocks_on_floors(goods, row["mu"]))
            answer = sm.effective_mass(scene, scaled, fractions=[0.0, 1.0], target=TARGET, resamples=1)
            assert answer.by_hand.estimate == pytest.approx(share, rel=1e-12)
            assert answer.by_hand.coefficient == pytest.approx(float(TARGET([row["period"]])[0]) / 9.80665, rel=1e-12)


def test_rules_by_period_are_the_rules_of_their_cases(small: sm.EffectiveMassMap) -> None:
    """Periods of 0.38 and 0.6 s are in two classes; each class is the map of its cases alone."""
    whole, classes = small.rules(), small.rules_by_period()
    assert classes["period_from"].unique().to_list() == [0.225, 0.435]
    for rule in whole["rule"]:
        rows = classes.filter(rule=rule)
        assert rows["cases"].sum() == whole.filter(rule=rule)["cases"][0]
        assert rows["worst"].min() == whole.filter(rule=rule)["worst"][0]
        logarithm = (rows["bias"].log() * rows["cases"]).sum() / rows["cases"].sum()
        assert np.exp(logarithm) == pytest.approx(whole.filter(rule=rule)["bias"][0], rel=1e-12)


def test_threads_and_progress() -> None:
    one_case = sm.EffectiveMassParameters(
        buildings=((2, 0.38, "bare"),), mass_ratios=(1.0,), response_modification=(4.0,), mus=(0.1, 0.2)
    )
    seen: list[tuple[int, int]] = []
    one = sm.effective_mass_map(SUITE, TARGET, one_case, threads=1, progress=lambda *runs: seen.append(runs))
    two = sm.effective_mass_map(SUITE, TARGET, one_case, threads=2)
    assert one.table.equals(two.table)
    assert seen[-1] == ((101 + 2) * 7, (101 + 2) * 7)


def test_rules_by_hand(small: sm.EffectiveMassMap) -> None:
    sliding = small.table.filter(pl.col("slides"))
    none = small.rules().row(by_predicate=pl.col("rule") == "none, 0", named=True)
    ratio = 1.0 / sliding["ratio_at_0"].to_numpy()
    assert none["cases"] == sliding.height
    assert none["bias"] == pytest.approx(np.exp(np.log(ratio).mean()), rel=1e-12)
    assert none["log_scatter"] == pytest.approx(np.log(ratio).std(), rel=1e-12)
    assert none["unsafe"] == pytest.approx((1.0 / ratio > 1.05).mean())
    quarter = small.rules({"a quarter": lambda cases: np.full(cases.height, 0.25)}).row(0, named=True)
    assert quarter["bias"] == pytest.approx(np.exp(np.log(1.0 / sliding["ratio_at_0_25"].to_numpy()).mean()), rel=1e-12)
    bins = small.by_eta()
    assert bins["cases"].sum() == sliding.height


def test_intensity_is_strength_and_friction() -> None:
    """Intensity s with (V_y, mu) has the fraction of intensity 1 with (V_y/s, mu/s): R and mu here."""
    common: dict[str, Any] = {"buildings": ((2, 0.38, "bare"),), "mass_ratios": (1.0,)}
    strong = sm.EffectiveMassParameters(**common, response_modification=(2.0,), mus=(0.4, 0.3), intensities=(1.0, 2.0))
    weak = sm.EffectiveMassParameters(**common, response_modification=(4.0,), mus=(0.2, 0.15))
    one = sm.effective_mass_map(SUITE, TARGET, strong).table.filter(pl.col("intensity") == 2.0)
    other = sm.effective_mass_map(SUITE, TARGET, weak).table
    np.testing.assert_allclose(one["value"], other["value"], atol=1e-9)
    np.testing.assert_allclose(one["eta"], other["eta"], rtol=1e-9)
    np.testing.assert_allclose(one["low"], other["low"], atol=1e-9)


@pytest.mark.usefixtures("small_map")
def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["map", "--mu", "0.1,0.3", "--R", "2,4", "--alpha", "1", "--factor", "0.5,1"]
    assert main([*arguments, "--out", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert RULE in printed
    assert "By period of the bare building" in printed
    assert "Effective fraction by eta" in printed
    names = {file.name for file in tmp_path.iterdir()}
    assert {"map.parquet", "rules.csv", "map.json", "collapse.png", "rules.svg", "intensity.png"} <= names
    assert pl.read_parquet(tmp_path / "map.parquet").height == 2 * 2 * 2 * 2
    assert json.loads((tmp_path / "map.json").read_text())["rules"][0]["rule"] == RULE


def test_figures_of_one_intensity(small: sm.EffectiveMassMap) -> None:
    assert set(small.figures()) == {"collapse", "rules"}


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"buildings": ((1, 0.4, "bare"),)}, "roof of effective mass map must be loaded"),
    ({"buildings": ((2, 0.4),)}, "buildings of effective mass map must be a tuple of"),
    ({"buildings": ()}, "buildings of effective mass map must be a tuple of at least one"),
    ({"mus": (-0.1,)}, "mus of effective mass map must be at least 0"),
    ({"mus": (0.2, 0.2)}, "mus of effective mass map must be a tuple of values, none twice"),
    ({"mass_ratios": (0.0,)}, "mass_ratios of effective mass map must be above 0"),
    ({"response_modification": (0.5,)}, "response_modification of effective mass map must be at least 1"),
    ({"intensities": (0.0,)}, "intensities of effective mass map must be above 0"),
    ({"design_fraction": 25.0}, "design_fraction of effective mass map must be between 0 and 1"),
    ({"resamples": 0}, "resamples of effective mass map must be a whole number"),
    ({"buildings": ((0, 0.4, "loaded"),)}, "storeys of effective mass map must be"),
    ({"buildings": ((2, 0.0, "bare"),)}, "period of effective mass map must be above 0"),
    ({"buildings": ((2, 0.4, "half"),)}, "buildings of effective mass map must be a tuple of"),
    ({"mus": [0.2]}, "mus of effective mass map must be a tuple of at least one"),
    ({"mus": (float("nan"),)}, "mus of effective mass map must be at least 0; got nan"),
    ({"mass_ratios": ("all",)}, "mass_ratios of effective mass map must be a number"),
    ({"confidence": 90.0}, "confidence of effective mass map must be between 0 and 1"),
    ({"overstrength": -1.0}, "overstrength of effective mass map must be at least 0"),
    ({"seed": -1}, "seed of effective mass map must be"),
    ({"scaling_period": 0.0}, "scaling_period of effective mass map must be above 0"),
    ({"model_damping": "own"}, "damping of effective mass map must be same or ratio"),
]


@pytest.mark.parametrize(("arguments", "message"), WRONG, ids=[message for _, message in WRONG])
def test_wrong_parameters(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=f"^{message}"):
        sm.EffectiveMassParameters(**arguments)


def test_wrong_suite() -> None:
    with pytest.raises(sm.errors.InvalidMotion, match=r"^suite of effective mass map must be a Suite"):
        sm.effective_mass_map([1, 2, 3], TARGET, SMALL)  # type: ignore[arg-type]
