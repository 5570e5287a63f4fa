"""Analyses of fragility: closed forms of elastic buildings, brute force, pairs of models, and what cannot be told."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.base.units import STANDARD_GRAVITY
from seismass.studies.fragility import (
    FragilityAnalysis,
    HuntAndFill,
    IntensityMeasure,
    LimitState,
    cloud_analysis,
    compared_models,
    fit_capacities,
    fit_counts,
    incremental_dynamic_analysis,
    intensity_of,
    multiple_stripes,
    solve_grid,
)

SUITE = list(sm.builtin_suite("eleven"))
DRIFT = LimitState("drift_ratio", 0.02)
SLIP = LimitState("slip", 0.1)


def warehouse(**changes: object) -> sm.Scene:
    building = sm.Building.uniform(
        3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13], heights=3.5, gravity_load=9.8, **changes
    )
    return sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))


@pytest.fixture(scope="module")
def analysis() -> FragilityAnalysis:
    """Three models, eleven motions, five limits."""
    limits = [DRIFT, SLIP, LimitState("collapse"), LimitState("floor_acceleration_g", 0.6, storey=3)]
    return incremental_dynamic_analysis(warehouse(), SUITE, limits, at=[1.0], resamples=200)


# Measures


def test_measures_are_what_they_are_defined_as() -> None:
    record = SUITE[0]
    assert intensity_of(record, "scale") == 1.0
    assert intensity_of(record, "pga") == pytest.approx(np.abs(record.acceleration).max() / STANDARD_GRAVITY, rel=1e-15)
    sa = sm.response_spectrum(record, [0.5])[0, 0] / STANDARD_GRAVITY
    assert intensity_of(record, "sa_t1", period=0.5) == pytest.approx(sa, rel=1e-15)
    periods = np.linspace(0.1, 1.5, 100)
    every = sm.response_spectrum(record, periods)[0] / STANDARD_GRAVITY
    assert intensity_of(record, "sa_avg", period=0.5) == pytest.approx(
        float(np.prod(every ** (1.0 / 100.0))), rel=1e-12
    )
    few = IntensityMeasure("sa_avg", 0.5, low=0.5, high=1.5, points=3)
    three = sm.response_spectrum(record, [0.25, 0.5, 0.75])[0] / STANDARD_GRAVITY
    assert few.of([record])[0] == pytest.approx(float(np.cbrt(np.prod(three))), rel=1e-12)
    for name in ("pga", "sa_t1", "sa_avg"):
        one, three_times = (intensity_of(motion, name, period=0.5) for motion in (record, record.scaled(3.0)))
        assert three_times == pytest.approx(3.0 * one, rel=1e-12)


# Closed forms


@pytest.mark.parametrize("measure", ["scale", "pga", "sa_t1", "sa_avg"])
def test_an_elastic_storey_has_capacities_in_proportion(measure: str) -> None:
    """Demand is intensity times a constant, so that the capacity is the limit over it; of Sa(T1) it is the same.

    Of one storey with 5 % damping, drift is Sa(T1) (T/2 pi)^2: g 0.5^2/(4 pi^2) = 0.0621 m a g.
    """
    scene = sm.Scene(sm.Building.uniform(1, 0.5, heights=3.0))
    limit = LimitState("drift", 0.05)
    found = incremental_dynamic_analysis(scene, SUITE, limit, measure=measure)
    at_one = np.array([table[0] for table in sm.simulate_many(scene, SUITE)["peak_drift"]])
    unit = found.motions[found.measure.column].to_numpy()
    np.testing.assert_allclose(found.capacities["capacity"].to_numpy(), unit * 0.05 / at_one, rtol=1e-9)
    assert (found.capacities["crossings"] == 1).all()
    demand = (found.runs["drift"] / found.runs["intensity"]).to_numpy()
    np.testing.assert_allclose(demand, (at_one / unit)[found.runs["motion"].to_numpy() - 1], rtol=1e-9)
    if measure == "sa_t1":
        same = 0.05 / (STANDARD_GRAVITY * (0.5 / (2.0 * np.pi)) ** 2)
        np.testing.assert_allclose(found.capacities["capacity"].to_numpy(), same, rtol=1e-9)
        fit = found.fragility(limit)
        assert fit.median == pytest.approx(same, rel=1e-9)
        assert fit.dispersion == pytest.approx(0.0, abs=1e-8)
    else:
        assert found.fragility(limit).median == pytest.approx(float(np.exp(np.mean(np.log(unit * 0.05 / at_one)))))
    fractiles = found.fractiles("demand", [0.01, 0.02])
    median = np.median(unit / at_one)
    np.testing.assert_allclose(fractiles["p50"].to_numpy(), [0.01 * median, 0.02 * median], rtol=1e-9)


def test_a_stripe_of_an_elastic_storey_parts_all_motions() -> None:
    """All motions exceed the limit from Sa = 0.8047 g on: a step between the stripes, and no comparison made of it."""
    building = sm.Building.uniform(1, 0.5, heights=3.0)
    models = {"real": sm.Scene(building), "code": sm.Scene(building)}
    limit = LimitState("drift", 0.05)
    found = incremental_dynamic_analysis(models, SUITE, limit, method="stripes", intensities=[0.5, 0.8, 0.81, 1.0])
    fit = found.fragility(limit)
    assert fit.kind == "step"
    assert fit.median == pytest.approx(np.sqrt(0.8 * 0.81))
    assert found.comparison["median_ratio"].null_count() == 1
    assert any("the dispersion is not known" in remark for remark in found.remarks)
    assert "unknown, a step" in found.text


# Hunt and fill


def test_capacities_are_those_of_brute_force() -> None:
    """A thousand stripes: the first at which a motion exceeds the limit, to the width between them."""
    scene = warehouse()
    limits = [DRIFT, SLIP]
    found = incremental_dynamic_analysis(scene, SUITE[:4], limits, hunt=HuntAndFill(tolerance=1e-6), resamples=0)
    levels = np.arange(1, 1001) * 0.003
    runs = solve_grid({"real": scene}, SUITE[:4], limits, levels)
    for limit in limits:
        for motion in range(1, 5):
            demand = runs.filter(motion=motion)[limit.column].to_numpy()
            first = levels[np.flatnonzero(demand > limit.value)[0]]
            row = found.capacities.filter(limit=limit.name, model="real", motion=motion).row(0, named=True)
            assert first - 0.003 <= row["capacity"] <= first
            assert row["upper"] - row["lower"] <= 1e-6 * row["upper"]
            assert row["lower"] <= row["capacity"] <= row["upper"]


def test_the_hunt_has_the_same_answer_with_other_steps() -> None:
    """Where curves cross the limit once, they do so at the same place: brackets of 1e-3, linear within."""
    default = incremental_dynamic_analysis(warehouse(), SUITE, DRIFT, resamples=0)
    other = incremental_dynamic_analysis(
        warehouse(), SUITE, DRIFT, hunt=HuntAndFill(step=0.2, increment=0.0, fill=2, steps=40), resamples=0
    )
    once = (default.capacities["crossings"] == 1).to_numpy() & (other.capacities["crossings"] == 1).to_numpy()
    assert once.sum() > 25
    np.testing.assert_allclose(
        default.capacities["capacity"].to_numpy()[once], other.capacities["capacity"].to_numpy()[once], rtol=1e-4
    )
    # Runs are solved by rounds, so that what threads do changes nothing.
    again = incremental_dynamic_analysis(warehouse(), SUITE, DRIFT, resamples=0, threads=1)
    assert again.runs.equals(default.runs)


def test_motions_that_do_not_exceed_the_limit_are_censored_where_they_were_left() -> None:
    found = incremental_dynamic_analysis(warehouse(), SUITE, DRIFT, hunt=HuntAndFill(highest=1.1), resamples=100)
    assert found.runs["intensity"].max() == 1.1
    rows = found.capacities.filter(model="real")
    missing = rows.filter(pl.col("capacity").is_null())
    assert 0 < missing.height < rows.height
    assert (missing["highest"] == 1.1).all()
    expected = fit_capacities(rows["capacity"].fill_null(np.inf).to_numpy(), 1.1, resamples=0)
    assert found.fragility(DRIFT, "real").median == pytest.approx(expected.median, rel=1e-12)


def test_first_and_last_crossing_of_a_curve_that_falls_again() -> None:
    """Residual drifts are not monotone: the last crossing is never below the first, and several are counted."""
    limit = LimitState("residual_drift_ratio", 0.003)
    hunt = HuntAndFill(beyond=3.0, fill=8)
    first, last = (
        incremental_dynamic_analysis(warehouse(), SUITE, limit, capacity=rule, hunt=hunt, resamples=0)
        for rule in ("first", "last")
    )
    low, high = (each.capacities["capacity"].to_numpy() for each in (first, last))
    assert (low <= high * (1.0 + 1e-9)).all()
    several = (first.capacities["crossings"] > 1).to_numpy()
    assert several.any()
    assert (high[several] > 1.001 * low[several]).any()
    assert any("cross the limit more than once; the first crossing counts" in remark for remark in first.remarks)


def test_one_motion_has_a_capacity_and_no_interval() -> None:
    found = incremental_dynamic_analysis(warehouse(), SUITE[0], DRIFT)
    fit = found.fragility(DRIFT)
    assert (fit.kind, fit.runs, fit.median_interval) == ("step", 1, None)
    assert found.comparison["median_ratio"].null_count() == 2
    assert "1 motion: few" in found.text
    assert not found.plot().axes[0].texts
    found.plot(found.figure_names[1])


def test_a_limit_that_is_never_exceeded_has_no_median() -> None:
    """A building without P-Delta and collapse drift cannot collapse."""
    scene = sm.Scene(sm.Building.uniform(1, 0.5, heights=3.0), [sm.Block(1, mass_ratio=1.0, mu=0.3)])
    found = incremental_dynamic_analysis(scene, SUITE[:3], LimitState("collapse"), hunt=HuntAndFill(steps=5))
    assert set(found.fragilities["kind"]) == {"never"}
    assert found.fragilities["median"].is_infinite().all()
    assert "never exceeded up to" in found.text
    assert json.loads(found.to_json())["fragilities"][0]["median"] is None
    assert [text.get_text() for text in found.plot().axes[0].texts] == ["never exceeded"]


# Models side by side


def test_models_are_paired_in_the_bootstrap() -> None:
    """A model that is the real building scaled has a ratio of capacities without any scatter."""
    building = sm.Building.uniform(1, 0.5, heights=3.0)
    stiffer = building.replace(mass=0.5 * building.mass, stiffness=0.5 * building.stiffness)
    models = {"real": sm.Scene(building), "code": sm.Scene(stiffer)}  # the same period: the same drift
    limits = [LimitState("drift", 0.05)]
    found = incremental_dynamic_analysis(models, SUITE, limits, measure="pga", at=[1.0])
    row = found.comparison.row(0, named=True)
    # Stiffnesses differ in rounding, and so do events of the hunt.
    for name in ("median_ratio", "median_ratio_low", "median_ratio_high"):
        assert row[name] == pytest.approx(1.0, rel=1e-9)
    real = found.fragility(limits[0], "real")
    assert real.median_interval is not None
    assert real.median_interval[1] > 1.02 * real.median_interval[0]
    at = found.exceedance.filter(given="chosen").row(0, named=True)
    assert at["difference_low"] == pytest.approx(0.0, abs=1e-7)
    assert at["reference"] == pytest.approx(float(real.probability(1.0)))


def test_capacities_and_comparison_of_the_models(analysis: FragilityAnalysis) -> None:
    for model in ("real", "code", "attached"):
        rows = analysis.capacities.filter(limit=DRIFT.name, model=model)
        assert rows["motion"].to_list() == list(range(1, 12))
        log = np.log(rows["capacity"].to_numpy())
        fit = analysis.fragility(DRIFT, model)
        assert fit.median == pytest.approx(float(np.exp(log.mean())), rel=1e-12)
        assert fit.dispersion == pytest.approx(float(log.std()), rel=1e-12)
    ratio = analysis.comparison.filter(limit=DRIFT.name, model="code").row(0, named=True)
    assert ratio["median_ratio"] == pytest.approx(
        analysis.fragility(DRIFT, "code").median / analysis.fragility(DRIFT, "real").median
    )
    assert ratio["median_ratio_low"] < ratio["median_ratio"] < ratio["median_ratio_high"]
    rows = analysis.exceedance.filter(limit=DRIFT.name, model="code")
    assert rows["given"].to_list() == ["chosen", "code at 10 %", "code at 50 %"]
    assert rows["probability"][1] == pytest.approx(0.1, rel=1e-9)
    np.testing.assert_allclose(rows["difference"], rows["reference"] - rows["probability"], rtol=1e-12)
    assert (rows["difference_low"] <= rows["difference"]).all()
    assert (rows["difference"] <= rows["difference_high"]).all()
    assert analysis.fragilities.filter(limit=SLIP.name)["model"].to_list() == ["real"]
    assert "code and attached have no goods that slide" in analysis.text
    assert ": code 10.0 %" in analysis.text


def test_the_three_models_are_those_of_effective_mass() -> None:
    scene = warehouse()
    models = compared_models(scene, 0.3)
    assert models["real"] is scene
    assert models["code"] == sm.attached_scene(scene, 0.3)
    assert models["attached"] == sm.attached_scene(scene, 1.0)
    ratio = compared_models(scene, 0.3, damping="ratio")["code"]
    assert ratio == sm.attached_scene(scene, 0.3, "ratio")


def test_fractiles_of_demand_count_collapse_as_infinite(analysis: FragilityAnalysis) -> None:
    levels = [0.5, 1.0, 1.5]
    found = analysis.fractiles("intensity", levels).filter(model="real", demand_column="drift_ratio")
    exact = solve_grid({"real": warehouse()}, SUITE, DRIFT, levels)
    for row, level in zip(found.iter_rows(named=True), levels, strict=True):
        demand = exact.filter(intensity=level)["drift_ratio"].to_numpy()
        # Between points of the hunt, and from no demand at none, curves are taken as linear, which is off by 3 %.
        curves = analysis.runs.filter(model="real").sort("intensity").partition_by("motion")
        taken = [
            np.interp(level, np.append(0.0, curve["intensity"]), np.append(0.0, curve["drift_ratio"]))
            for curve in curves
        ]
        assert row["p50"] == pytest.approx(np.median(taken), rel=1e-12)
        assert row["p50"] == pytest.approx(np.median(demand), rel=0.04)
    capacity = analysis.fractiles("demand", [0.02]).filter(model="real", demand_column="drift_ratio")
    rows = analysis.capacities.filter(limit=DRIFT.name, model="real")["capacity"].to_numpy()
    assert capacity["p50"][0] == pytest.approx(np.median(rows), rel=1e-9)
    falls = analysis.fractiles("intensity", [30.0]).filter(model="real", demand_column="drift_ratio")
    assert falls["p50"].is_infinite().all()


# Stripes and clouds


def test_stripes_are_counted() -> None:
    levels = [0.6, 0.9, 1.2, 1.5, 1.8]
    found = incremental_dynamic_analysis(
        warehouse(), SUITE, [DRIFT, SLIP], method="stripes", intensities=levels, resamples=200
    )
    counts = [int((found.runs.filter(model="code", intensity=x)["drift_ratio"] > 0.02).sum()) for x in levels]
    expected = fit_counts(levels, counts, 11, resamples=0)
    fit = found.fragility(DRIFT, "code")
    assert (fit.median, fit.dispersion) == (expected.median, expected.dispersion)
    assert fit.runs == 55
    # The same motions at every level: one set of draws, so that no resample has a level without motions.
    assert found.runs.height == 3 * 11 * 5


def test_stripes_of_other_motions() -> None:
    stripes = {1.5: SUITE[5:], 0.9: SUITE[:6], 1.2: SUITE[3:9]}
    found = multiple_stripes(warehouse(), stripes, DRIFT, resamples=200)
    assert found.runs.height == 3 * 18
    assert found.runs["stripe"].unique().sort().to_list() == [0.9, 1.2, 1.5]
    counts, totals = [], []
    for level in (0.9, 1.2, 1.5):
        demand = sm.simulate_many(
            warehouse(), [each.scaled(level / intensity_of(each, "sa_t1", period=0.47)) for each in stripes[level]]
        )["peak_drift_ratio"]
        counts.append(sum(max(each) > 0.02 for each in demand))
        totals.append(len(stripes[level]))
    expected = fit_counts([0.9, 1.2, 1.5], counts, totals, resamples=0)
    fit = found.fragility(DRIFT)
    assert fit.kind == expected.kind
    assert fit.median == pytest.approx(expected.median)
    assert found.capacities.is_empty()
    with pytest.raises(sm.errors.InvalidOption, match="analysis of fractiles must be those of motions that are scaled"):
        found.fractiles()
    one_event = multiple_stripes(warehouse(), {0.9: SUITE[0], 1.2: SUITE[:6], 1.5: SUITE}, DRIFT)
    assert one_event.fragility(DRIFT).median_interval is None
    as_they_are = multiple_stripes(warehouse(), stripes, DRIFT, scaled=False, resamples=0)
    assert set(as_they_are.runs["scale"].round(12)) == {1.0}


def test_clouds_are_regressed() -> None:
    motions = [record.scaled(factor) for record, factor in zip(SUITE, np.linspace(1.0, 3.0, 11), strict=True)]
    limits = [DRIFT, LimitState("collapse")]
    found = cloud_analysis(warehouse(), motions, limits, measure="sa_avg", resamples=100)
    assert (found.runs["scale"].round(12) == 1.0).all()
    rows = found.runs.filter(model="real")
    expected = sm.fragility.fit_cloud(rows["intensity"], rows["drift_ratio"], 0.02, resamples=0)
    assert found.fragility(DRIFT).median == pytest.approx(expected.median, rel=1e-12)
    fell = (rows["status"] == "collapsed").to_numpy()
    by_run = fit_counts(rows["intensity"], fell.astype(float), np.ones(11), resamples=0)
    assert found.fragility("collapse").kind == by_run.kind
    with pytest.raises(sm.errors.InvalidOption, match="measure of cloud analysis must be other than scale"):
        cloud_analysis(warehouse(), motions, limits, measure="scale")


def test_motions_of_one_earthquake_have_no_interval() -> None:
    class Named:
        """A motion of a named earthquake."""

        def __init__(self, record: sm.Record) -> None:
            self.motion, self.name, self.event = record.motion, record.name, "1994 Northridge"

    found = incremental_dynamic_analysis(warehouse(), [Named(record) for record in SUITE[:4]], DRIFT)
    assert found.fragility(DRIFT).median_interval is None
    assert "there are no intervals, as all motions are of one earthquake" in found.remarks


# Limits


def test_demands_are_read_from_the_table() -> None:
    scene = warehouse()
    motions = [SUITE[0].scaled(2.0), SUITE[1].scaled(30.0)]
    table = sm.simulate_many(scene, motions)
    assert table["status"].to_list() == ["completed", "collapsed"]
    heights = np.full(3, 3.5)
    one = table.row(0, named=True)
    for limit, expected in (
        (LimitState("drift", 1.0), max(one["peak_drift"])),
        (LimitState("drift_ratio", 1.0, storey=2), one["peak_drift_ratio"][1]),
        (LimitState("residual_drift", 1.0), np.abs(one["residual_drift"]).max()),
        (LimitState("residual_drift_ratio", 1.0, storey=3), abs(one["residual_drift"][2]) / 3.5),
        (LimitState("slip", 1.0, block=2), one["peak_slip"][1]),
        (LimitState("residual_slip", 1.0), np.abs(one["residual_slip"]).max()),
        (LimitState("floor_acceleration_g", 1.0), max(one["peak_floor_acceleration"]) / STANDARD_GRAVITY),
        (LimitState("collapse"), 0.0),
    ):
        demand = limit.demand(table, heights)
        assert demand[0] == pytest.approx(expected, rel=1e-12)
        assert demand[1] == (1.0 if limit.quantity == "collapse" else np.inf)
    up_to = LimitState("slip", 1.0, collapsed="peak").demand(table)
    assert up_to[1] == max(table["peak_slip"][1])
    assert np.isnan(LimitState("slip", 1.0, block=3).demand(table)).all()
    failed = table.with_columns(status=pl.lit("failed"), peak_drift=pl.lit(None, dtype=pl.List(pl.Float64)))
    assert np.isnan(LimitState("drift", 1.0).demand(failed)).all()
    assert np.isnan(LimitState("collapse").demand(failed)).all()


def test_what_no_analysis_can_take_is_refused() -> None:
    scene = warehouse()
    for call, message in (
        (lambda: LimitState("speed", 1.0), "quantity of limit state must be one of drift_ratio"),
        (lambda: LimitState("drift", -1.0), "value of limit state must be zero or positive, and finite; got -1"),
        (lambda: LimitState("drift", 0.0), "value of limit state must be positive for what is no slip; got 0"),
        (lambda: LimitState("slip", 0.1, storey=1), "storey of limit state must be left out for a slip"),
        (lambda: LimitState("drift", 0.1, collapsed="peak"), "collapsed of limit state must be exceeds for drift"),
        (lambda: sm.fragility.parse_limit("drift"), "limit of limit state must be QUANTITY=VALUE"),
        (lambda: HuntAndFill(tolerance=0.0), "tolerance of hunt and fill must be from 1e-14 to below 1; got 0"),
        (lambda: IntensityMeasure("sa_t1"), "period of intensity measure must be given for sa_t1; got None"),
        (
            lambda: incremental_dynamic_analysis(scene, SUITE, LimitState("drift", 0.1, storey=4)),
            "storey of limit state must be from 1 to 3; got 4",
        ),
        (
            lambda: incremental_dynamic_analysis(scene, SUITE, DRIFT, method="stripes"),
            "intensities of incremental dynamic analysis must be given and hunt left out where method is stripes",
        ),
        (
            lambda: incremental_dynamic_analysis(scene, SUITE, [DRIFT, DRIFT]),
            "limits of incremental dynamic analysis must be different from each other",
        ),
        (
            lambda: incremental_dynamic_analysis(sm.Scene(scene.building), SUITE, SLIP),
            "limit of incremental dynamic analysis must be of a quantity that some model has; got slip=0.1",
        ),
        (lambda: multiple_stripes(scene, {}, DRIFT), "stripes of multiple stripes must be a mapping"),
    ):
        with pytest.raises(sm.errors.InvalidOption, match=message):
            call()
    without = sm.Scene(sm.Building.uniform(1, 0.5))
    with pytest.raises(
        sm.errors.InvalidScene, match="heights of building must be given for a limit of drift_ratio; got None"
    ):
        incremental_dynamic_analysis(without, SUITE, DRIFT)
    with pytest.raises(sm.errors.InvalidScene, match="model code of incremental dynamic analysis must be of 3 storeys"):
        incremental_dynamic_analysis({"real": scene, "code": without}, SUITE, SLIP)


# Results


def test_motions_have_their_event_and_their_intensity() -> None:
    """One row per motion; an earthquake that is not named is null."""
    first, second = (sm.builtin_record(f"synthetic-{number}") for number in (1, 2))
    named = sm.Record(second.acceleration, second.dt, name="other", event="Kobe")
    found = incremental_dynamic_analysis(warehouse(), [first, named], DRIFT, resamples=0)
    column = found.measure.column
    assert found.motions.columns == ["motion", "record", "event", column]
    assert found.motions["motion"].to_list() == [1, 2]
    assert found.motions["record"].to_list() == [first.name, "other"]
    assert found.motions["event"].to_list() == [None, "Kobe"]
    for record, value in zip((first, named), found.motions[column], strict=True):
        assert value == pytest.approx(found.measure.of(record), rel=1e-12)


def test_results_are_written_and_say_what_they_hold(analysis: FragilityAnalysis, tmp_path: Path) -> None:
    files = {path.name for path in analysis.write(tmp_path / "out")}
    assert {"runs.parquet", "fragilities.csv", "exceedance.csv", "fragility.json", "fragility.svg"} <= files
    assert {"demand_drift_ratio.png", "demand_slip.png", "fractiles_given_demand.csv"} <= files
    assert not any("collapse" in name for name in files)
    document = json.loads((tmp_path / "out" / "fragility.json").read_text())
    assert document["metadata"]["runs"] == analysis.runs.height
    assert document["limits"][0]["name"] == "drift_ratio=0.02"
    assert len(document["fragilities"]) == analysis.fragilities.height
    lines = {line.get_gid(): line for line in analysis.plot().axes[0].lines if line.get_gid()}
    drawn = lines["points:drift_ratio=0.02:real"].get_xdata()
    rows = analysis.capacities.filter(limit=DRIFT.name, model="real")["capacity"].sort()
    np.testing.assert_array_equal(drawn, rows)
    other = incremental_dynamic_analysis(warehouse(), SUITE, DRIFT, seed=1, resamples=0)
    assert other.metadata["inputs_sha256"] != analysis.metadata["inputs_sha256"]


def test_on_recordings(shared: Path) -> None:
    """The same capacities by brute force, on three components of the paper's records."""
    suite = list(sm.read_suite(shared / "records" / "paper_seven.csv"))[:3]
    found = incremental_dynamic_analysis(warehouse(), suite, DRIFT, hunt=HuntAndFill(tolerance=1e-6), resamples=0)
    levels = np.arange(1, int(100.0 * found.capacities["capacity"].max()) + 3) * 0.01  # type: ignore[operator, arg-type]
    models = compared_models(warehouse())
    runs = solve_grid(models, suite, DRIFT, levels)
    for row in found.capacities.iter_rows(named=True):
        demand = runs.filter(model=row["model"], motion=row["motion"])["drift_ratio"].to_numpy()
        first = levels[np.flatnonzero(demand > 0.02)[0]]
        assert first - 0.01 <= row["capacity"] <= first
