"""Risk-targeted share: closed forms, limits of friction, capacities beside brute force, what it says and refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.studies.fragility import IntensityMeasure, solve_grid
from seismass.studies.fragility.hunt import STEP, exact_capacities
from seismass.studies.fragility.run import setting_of
from seismass.studies.risk.annual_rate import annual_rate
from seismass.studies.risk.tables import RateCurve, rate_parts

G = sm.STANDARD_GRAVITY
HAZARD = sm.risk.HazardCurve(
    [0.02, 0.05, 0.1, 0.3, 1.0, 2.0, 4.0], [0.1, 0.04, 0.015, 2e-3, 1e-4, 8e-6, 4e-7], label="test"
)
SHARES = [0.0, 0.25, 0.5, 0.75, 1.0]


def storage(mu: float, **options: object) -> sm.Scene:
    building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2], heights=3.0)
    return sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], mu=mu), **options)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def suite() -> list[sm.Record]:
    return list(sm.builtin_suite("seven"))


@pytest.fixture(scope="module")
def found(suite: list[sm.Record]) -> sm.risk.RiskTargetedShare:
    return sm.risk.risk_targeted_share(storage(0.15), suite, HAZARD, 0.01, resamples=400)


@pytest.mark.parametrize("eta", [0.5, 1.0, 1.5])
def test_step_motion_has_the_closed_form(eta: float) -> None:
    """A step of ground acceleration A on an elastic storey without damping.

    With goods |u|max = (A/w^2) (1 + alpha eta + sqrt(1 + alpha (2 eta - eta^2))) with eta = mu g/A, with a share
    attached 2 (A/w^2) (1 + share alpha). The limit is the drift at eta, so that the real capacity is A.
    """
    alpha, period, acceleration = 1.0, 0.5, 0.4 * G
    growth = 1.0 + alpha * eta + np.sqrt(1.0 + alpha * (2.0 * eta - eta**2))
    limit = acceleration * (period / (2.0 * np.pi)) ** 2 * growth
    share = (0.5 * growth - 1.0) / alpha
    building = sm.Building.uniform(1, period, damping=0.0)
    scene = sm.Scene(building, [sm.Block(1, mass_ratio=alpha, mu=eta * acceleration / G)])
    step = sm.Motion(np.full(401, 0.1 * G), 0.005)
    result = sm.risk.risk_targeted_share(scene, step, HAZARD, limit, measure="pga", shares=SHARES, extrapolate=True)
    assert result.kind == "root"
    assert result.value == pytest.approx(share, rel=1e-7)
    # One motion: the rate is that of the hazard curve at its capacity.
    assert result.real == pytest.approx(HAZARD.rate(0.4), rel=1e-7)
    code = 0.4 * growth / (2.0 * (1.0 + 0.25 * alpha))
    assert result.code == pytest.approx(HAZARD.rate(code), rel=1e-7)
    assert result.attached == pytest.approx(HAZARD.rate(0.4 * growth / (2.0 * (1.0 + alpha))), rel=1e-7)
    assert result.interval is None
    assert any("few for a fragility" in remark for remark in result.remarks)


def test_elastic_storey_has_capacities_of_its_spectrum(suite: list[sm.Record]) -> None:
    """Goods that stick on an elastic storey: the capacity is the limit over the spectral displacement per g of PGA."""
    alpha, period, damping, limit = 0.8, 0.5, 0.05, 0.02
    scene = sm.Scene(sm.Building.uniform(1, period, damping=damping), [sm.Block(1, mass_ratio=alpha, mu=90.0)])
    motions = [record.with_duration(record.duration + 3.0) for record in suite]
    result = sm.risk.risk_targeted_share(
        scene, motions, HAZARD, limit, measure="pga", shares=[0.0, 1.0], extrapolate=True
    )
    for name, rate, share in (
        ("code", result.code, 0.25),
        ("attached", result.attached, 1.0),
        ("real", result.real, 1.0),
    ):
        heavier = np.sqrt(1.0 + share * alpha)  # the same C: the ratio falls as the period grows
        ordinates = sm.response_spectrum(motions, [period * heavier], damping / heavier, "displacement")[:, 0]
        capacities = limit / ordinates * np.array([record.pga_g for record in motions])
        fit = sm.fragility.fit_capacities(capacities, resamples=0)
        assert rate == pytest.approx(annual_rate(fit, HAZARD, extrapolate=True).value, rel=1e-7), name
    assert (result.kind, result.value, result.interval) == ("stuck", 1.0, (1.0, 1.0))


def test_limits_of_friction(suite: list[sm.Record]) -> None:
    stuck = sm.risk.risk_targeted_share(
        storage(50.0), suite, HAZARD, 0.01, shares=SHARES, other_limits=[], resamples=100
    )
    assert (stuck.kind, stuck.value, stuck.interval) == ("stuck", 1.0, (1.0, 1.0))
    assert stuck.real == pytest.approx(stuck.attached, rel=1e-8)
    free = sm.risk.risk_targeted_share(storage(0.0), suite, HAZARD, 0.01, shares=SHARES, other_limits=[], resamples=100)
    assert (free.kind, free.value, free.interval) == ("zero", 0.0, (0.0, 0.0))
    assert free.real == pytest.approx(float(free.curve["rate"][0]), rel=1e-8)
    assert free.attached == pytest.approx(stuck.attached, rel=1e-12)


def test_capacities_are_first_crossings(suite: list[sm.Record]) -> None:
    """The demand passes the limit within 1e-7 of the capacity, and is below it on the ladder up to there."""
    limit = sm.fragility.LimitState("drift_ratio", 0.01)
    models = {"real": storage(0.15), "full": sm.attached_scene(storage(0.15), 1.0)}
    setting = setting_of(models, suite, [limit], "sa_t1", None, "test")
    capacities = exact_capacities(setting, limit)
    assert capacities.shape == (2, 7)
    for row, (name, scene) in zip(capacities, models.items(), strict=True):
        for number, capacity in enumerate(row):
            rungs = STEP ** np.arange(np.ceil(np.log(0.05) / np.log(STEP)), np.log(capacity) / np.log(STEP))
            below = rungs[rungs < capacity * (1.0 - 1e-7)]
            levels = [*below, capacity * (1.0 - 1e-7), capacity * (1.0 + 1e-7)]
            table = solve_grid({name: scene}, suite[number], limit, levels, measure=setting.measure)
            demand = table["drift_ratio"].to_numpy()
            assert (demand[:-1] <= 0.01).all()
            assert demand[-1] > 0.01


@pytest.mark.parametrize(
    ("rates", "kind", "value"),
    [
        ([1.2, 1.1, 1.05], "zero", 0.0),
        ([0.7, 0.75, 1.25], "root", 0.75),
        ([0.7, 1.25, 0.9], "one", 1.0),
        ([1.25, 0.75, 1.25], "multiple", 0.75),
    ],
)
def test_operator_on_rates(rates: list[float], kind: str, value: float) -> None:
    """Rates of models at shares 0, 1/2 and 1 where the real building has 1 a year; linear between them."""
    hazard = sm.risk.HazardCurve([1e-3, 1e3], [1e3, 1e-3])  # the rate is 1 over the capacity
    capacities = 1.0 / np.array(rates)[:, None]
    shares = np.array([0.0, 0.5, 1.0])
    model = rate_parts(capacities, hazard, "empirical", np.ones((1, 1))).total(True)
    curve = RateCurve(shares, 1.0, model[0], np.ones(1), model)
    np.testing.assert_allclose(curve.model, rates, rtol=1e-12)
    assert curve.kind == kind
    assert curve.value == pytest.approx(value, abs=1e-12)
    assert curve.value_draws[0] == pytest.approx(value, abs=1e-12)


def test_collapse_is_a_capacity(suite: list[sm.Record]) -> None:
    """A limit above the drift of collapse is reached where the building collapses, to the same digits."""
    collapsing = storage(0.15, collapse_drift=0.045)  # 0.015 of the height
    limits = [sm.fragility.LimitState("drift_ratio", 0.02), sm.fragility.LimitState("drift_ratio", 0.015)]
    setting = setting_of(collapsing, suite, limits, "pga", None, "test")
    above, at = (exact_capacities(setting, limit) for limit in limits)
    np.testing.assert_allclose(above, at, rtol=1e-7)


def test_root_has_the_rate_of_the_real_building(found: sm.risk.RiskTargetedShare, suite: list[sm.Record]) -> None:
    assert found.kind == "root"
    assert found.excess == pytest.approx(0.0, abs=1e-7)
    # The whole computation once more for that share, with capacities found by hunt and fill.
    scene = storage(0.15)
    models = {"real": scene, "model": sm.attached_scene(scene, found.value)}
    hunt = sm.fragility.HuntAndFill(tolerance=1e-7)
    limit = sm.fragility.LimitState("drift_ratio", 0.01)
    analysis = sm.fragility.incremental_dynamic_analysis(models, suite, limit, hunt=hunt, resamples=10)
    for name in models:
        fit = analysis.fragility(limit, name)
        assert annual_rate(fit, HAZARD).value == pytest.approx(found.real, rel=1e-5)
    low, high = found.interval or (np.nan, np.nan)
    assert low < found.value < high
    # Between the grid points around it the curve crosses once.
    shares, ratio = found.curve["fraction"].to_numpy(), found.curve["real_over_model"].to_numpy()
    k = int(np.searchsorted(shares, found.value))
    assert ratio[k - 1] > 1.0 > ratio[k]


def test_scaled_motions_change_nothing(found: sm.risk.RiskTargetedShare, suite: list[sm.Record]) -> None:
    factors = [0.5, 2.0, 3.0, 0.7, 1.1, 1.0, 5.0]
    scaled = [record.scaled(factor) for record, factor in zip(suite, factors, strict=True)]
    again = sm.risk.risk_targeted_share(storage(0.15), scaled, HAZARD, 0.01, resamples=400)
    assert again.value == pytest.approx(found.value, abs=1e-6)
    assert again.code == pytest.approx(found.code, rel=1e-7)
    assert again.interval == pytest.approx(found.interval, abs=1e-6)


def test_effective_fraction_at_the_design_intensity(found: sm.risk.RiskTargetedShare, suite: list[sm.Record]) -> None:
    level = HAZARD.intensity(1.0 / 475.0)
    measure = IntensityMeasure("sa_t1", storage(0.15).building.periods[0])  # type: ignore[union-attr]
    motions = [record.scaled(level / unit) for record, unit in zip(suite, measure.of(suite).tolist(), strict=True)]
    expected = sm.effective_mass(storage(0.15), motions, fractions=found.curve["fraction"].to_numpy(), resamples=400)
    assert found.effective is not None
    assert found.effective.value == pytest.approx(expected.value, abs=1e-12)
    beyond = sm.risk.risk_targeted_share(
        storage(0.15), suite, HAZARD, 0.01, shares=SHARES, other_limits=[], design_rate=1e-9, resamples=50
    )
    assert beyond.effective is None
    assert any("does not reach the design rate" in remark for remark in beyond.remarks)


def test_what_it_depends_on(found: sm.risk.RiskTargetedShare) -> None:
    rows = found.sensitivity
    assert rows["parameter"].to_list() == ["as asked for", *["limit"] * 3, *["hazard slope"] * 2, "fragility"]
    assert rows["setting"].to_list()[1:4] == ["0.25 %", "0.5 %", "1.5 %"]
    # By interpolation over a grid of 0.05.
    assert rows["value"][0] == pytest.approx(found.value, abs=0.02)
    assert rows.filter(parameter="limit")["real_rate"].is_sorted(descending=True)
    tilted = HAZARD.tilted(0.75)
    median, dispersion = found.fragilities.filter(model="real").select("median", "dispersion").row(0)
    fit = sm.fragility.fit_capacities([median * np.exp(-dispersion), median * np.exp(dispersion)], resamples=0)
    slope = rows.filter(parameter="hazard slope", setting="x 0.75")["real_rate"][0]
    assert slope == pytest.approx(annual_rate(fit, tilted).value, rel=1e-9)
    capacities = found.capacities.filter(model="real")["capacity"].to_numpy()
    empirical = rows.filter(parameter="fragility")["real_rate"][0]
    assert empirical == pytest.approx(annual_rate(capacities, HAZARD).value, rel=1e-12)


def test_empirical_estimator_is_the_mean_hazard_at_the_capacities(suite: list[sm.Record]) -> None:
    result = sm.risk.risk_targeted_share(
        storage(0.15), suite, HAZARD, 0.01, shares=SHARES, other_limits=[], estimator="empirical", resamples=50
    )
    capacities = result.capacities.filter(pl.col("share") == 0.25)["capacity"].to_numpy()
    by_hand = np.mean([HAZARD.rate(capacity) for capacity in capacities]) - HAZARD.annual_rate[-1]
    assert result.code == pytest.approx(by_hand, rel=1e-12)


def test_hazard_that_ends_early_is_said(suite: list[sm.Record]) -> None:
    short = sm.risk.HazardCurve([0.05, 0.1, 0.6], [0.04, 0.015, 4e-4])
    options = {"shares": SHARES, "other_limits": [], "design_rate": 2e-3, "resamples": 50}
    cut = sm.risk.risk_targeted_share(storage(0.15), suite, short, 0.01, **options)  # type: ignore[arg-type]
    longer = sm.risk.risk_targeted_share(storage(0.15), suite, short, 0.01, extrapolate=True, **options)  # type: ignore[arg-type]
    assert cut.real < longer.real
    assert any("the hazard curve ends at 0.6 g: stronger motions would add" in remark for remark in cut.remarks)
    assert not any("the hazard curve ends" in remark for remark in longer.remarks)


def test_text_tables_json_and_files(tmp_path: Path, found: sm.risk.RiskTargetedShare) -> None:
    for words in ("risk-targeted share", "in 50 years", "code, 0.25", "all attached", "hazard slope x 1.25", "remark"):
        assert words in found.text
    files = found.write(tmp_path / "out")
    assert {"risk.json", "risk.svg", "risk_curve.csv", "risk_rates.parquet"} <= {file.name for file in files}
    document = json.loads(found.to_json())
    assert document["limit"]["name"] == "drift_ratio=0.01"
    assert document["metadata"]["hazard"]["label"] == "test"
    assert document["rates"][0]["model"] == "real"
    assert found.rates["probability_50_years"][0] == pytest.approx(1.0 - np.exp(-50.0 * found.real), rel=1e-12)


def test_recordings_of_one_event_are_drawn_together(shared: Path) -> None:
    records = sm.read_suite(shared / "records" / "paper_seven.csv")
    seen: list[tuple[int, int]] = []
    result = sm.risk.risk_targeted_share(
        storage(0.15),
        records,
        HAZARD,
        sm.fragility.LimitState("drift_ratio", 0.01),
        shares=SHARES,
        other_limits=[],
        resamples=100,
        progress=lambda done, total: seen.append((done, total)),
    )
    assert 0.0 < result.value <= 1.0
    assert seen == [(1, 3), (2, 3), (3, 3)]
    assert result.metadata["clusters"] == len({record.event or number for number, record in enumerate(records)})


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"limit": sm.fragility.LimitState("slip", 0.1)},
            "limit of risk-targeted share must be a number, or a LimitState of drift",
        ),
        ({"measure": "scale"}, "measure of risk-targeted share must be an acceleration in g, as the hazard curve is"),
        ({"estimator": "normal"}, "estimator of risk-targeted share must be lognormal or empirical"),
        ({"code_share": 1.5}, "code_share of risk-targeted share must be between 0 and 1; got 1.5"),
        ({"shares": [0.1, 1.0]}, "fractions of risk-targeted share must be a list in increasing order"),
        ({"other_limits": [0.0]}, "other_limits of risk-targeted share must be positive"),
        ({"confidence": 0.0}, "confidence of risk-targeted share must be above 0 and below 1; got 0"),
        ({"hazard": [0.1]}, "hazard of risk-targeted share must be a HazardCurve; got [0.1]"),
        (
            {"hazard": HAZARD.replace(period=0.5), "period": 0.4},
            "period of risk-targeted share must be the period of the hazard curve, 0.5 s; got 0.4 s",
        ),
    ],
)
def test_what_is_refused(suite: list[sm.Record], options: dict[str, object], message: str) -> None:
    given: dict[str, object] = {"hazard": HAZARD, "limit": 0.01, **options}
    with pytest.raises(sm.errors.InvalidOption) as error:
        sm.risk.risk_targeted_share(storage(0.15), suite, **given)  # type: ignore[arg-type]
    assert message in str(error.value)


def test_scenes_that_do_not_start_at_rest_are_refused(suite: list[sm.Record]) -> None:
    with pytest.raises(sm.errors.InvalidScene, match="initial state of risk-targeted share must be at rest"):
        sm.risk.risk_targeted_share(storage(0.15, initial_drift=[0.001, 0.0]), suite, HAZARD, 0.01)
    pushed = sm.Block(1, mass_ratio=1.0, mu=0.1, velocity=0.1)
    with pytest.raises(sm.errors.InvalidScene, match="must be at rest"):
        sm.risk.risk_targeted_share(sm.Scene(storage(0.15).building, [pushed]), suite, HAZARD, 0.01)


def test_limit_beyond_the_hazard_curve_is_refused(suite: list[sm.Record]) -> None:
    weak = sm.risk.HazardCurve([1e-4, 2e-4], [0.1, 0.05])
    with pytest.raises(
        sm.errors.InvalidOption, match="must be exceeded within the hazard curve; got a rate of 0 a year"
    ):
        sm.risk.risk_targeted_share(
            storage(0.15), suite, weak, 0.01, shares=[0.0, 1.0], other_limits=[], estimator="empirical"
        )
