"""The effective fraction of live load: closed form, limits, invariances, an independent search, scatter, errors."""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from scipy.optimize import brentq

import seismass as sm
from seismass.base.units import STANDARD_GRAVITY
from seismass.design import response_spectrum_analysis
from seismass.effective_mass.search import without_friction
from seismass.effective_mass.share import TOLERANCE, interpolated, refined_root
from seismass.motions.spectra import mean_spectrum

SUITE = sm.builtin_suite("seven")
FACTORS = sm.scaling.scale_asce7_10(SUITE, sm.TargetSpectrum.asce7(), between=False).factors
MOTIONS = [record.scaled(factor) for record, factor in zip(SUITE, FACTORS, strict=True)]


def spectrum(periods: Any) -> Any:
    return mean_spectrum(SUITE, FACTORS, periods)


def designed(storeys: int, period: float, alpha: float, reduction: float) -> Callable[[float], sm.Building]:
    """The design of the study: V_y = V_e/R with a share of the live load, a bare roof, R = 1 elastic."""
    bare = sm.Building.uniform(storeys, period, mass=1.0)
    goods = np.append(np.full(storeys - 1, alpha), 0.0)

    def building(share: float) -> sm.Building:
        if reduction == 1.0:
            return bare
        shear = response_spectrum_analysis(bare.mass + share * goods, bare.stiffness, spectrum).storey_shear
        return bare.replace(yield_shear=shear / reduction)

    return building


def case(storeys: int, period: float, alpha: float, reduction: float, mu: float) -> sm.Scene:
    building = designed(storeys, period, alpha, reduction)(0.25)
    return sm.Scene(building, sm.blocks_on_floors([alpha] * (storeys - 1) + [0.0], mu))


def largest_drifts(scene: sm.Scene, motions: Any = MOTIONS) -> Any:
    """Largest drift of each run, one by one; infinite in a run that collapses."""
    runs = [sm.simulate(scene, motion) for motion in motions]
    return np.array([np.inf if run.status == "collapsed" else run.peak_drift.max() for run in runs])


def largest_ratios(scene: sm.Scene) -> Any:
    """As `largest_drifts`, over the heights."""
    runs = [sm.simulate(scene, motion) for motion in MOTIONS]
    return np.array([np.inf if run.status == "collapsed" else run.peak_drift_ratio.max() for run in runs])


# Values of an independent run of the definition, agreed with a leapfrog of its own order.
REFERENCE = [
    ((3, 0.47, 1.0, 4.0, 0.1), 47.624282, 0.193232213),
    ((3, 0.47, 1.0, 4.0, 0.2), 63.465647, 0.664895716),
    ((3, 0.47, 1.0, 4.0, 0.3), 69.438652, 0.983646645),
    ((3, 0.47, 1.0, 2.0, 0.3), 55.553337, 0.48928519),
    ((3, 0.47, 1.0, 1.0, 0.6), 51.034094, 0.41652234),
    ((2, 0.38, 0.5, 4.0, 0.2), 53.643474, 0.62443536),
    ((4, 0.57, 1.5, 6.0, 0.15), 88.271574, 0.86275896),
]


@pytest.mark.parametrize(("arguments", "real_mm", "value"), REFERENCE)
def test_reference_values(arguments: tuple[Any, ...], real_mm: float, value: float) -> None:
    found = sm.effective_mass(case(*arguments), MOTIONS)
    assert found.kind == "root"
    assert found.value == pytest.approx(value, abs=1e-7)
    # Given to 1e-6 mm, so to half of that.
    assert 1e3 * found.real == pytest.approx(real_mm, abs=6e-7)
    assert found.model == pytest.approx(found.real, rel=1e-9)
    assert found.interval is not None
    assert found.interval[0] < found.value < found.interval[1]


def test_reference_strengths_coefficient_and_storeys() -> None:
    scene = case(3, 0.47, 1.0, 4.0, 0.2)
    assert scene.building is not None
    np.testing.assert_allclose(scene.building.yield_shear, [10.035177664, 7.808040775, 3.940393306], rtol=1e-9)
    found = sm.effective_mass(scene, MOTIONS)
    assert found.base_shear_coefficient == pytest.approx(0.258687, abs=1e-6)
    assert found.eta == pytest.approx(0.773134, abs=1e-6)
    np.testing.assert_allclose(found.storeys["ratio"].to_numpy(), [1.0, 0.881463, 0.849328], atol=1e-6)


def test_all_attached_is_not_enough() -> None:
    found = sm.effective_mass(case(3, 0.47, 1.0, 4.0, 0.4), MOTIONS)
    assert (found.value, found.kind) == (1.0, "one")
    assert 1e3 * found.real == pytest.approx(69.855967, abs=6e-7)
    assert 0.0 < found.excess < 0.01
    # The root is beyond 1, at 1.000876277: a model made here has the real drift there.
    scene = case(3, 0.47, 1.0, 4.0, 0.4)
    assert scene.building is not None
    heavier = scene.building.mass + 1.000876277 * np.array([1.0, 1.0, 0.0])
    model = sm.Scene(scene.building.replace(mass=heavier, damping=scene.building.damping_matrix))
    assert largest_drifts(model).mean() == pytest.approx(found.real, rel=1e-8)
    assert "more than with all attached" in found.text


def test_top_storey_needs_the_envelope() -> None:
    found = sm.effective_mass(case(4, 0.57, 1.5, 6.0, 0.15), MOTIONS)
    top = found.storeys.row(-1, named=True)
    assert top["ratio"] == pytest.approx(1.244, abs=5e-4)  # of the same independent run, to three decimals
    assert top["envelope_ratio"] < 1.0
    assert any("storey 4 drifts 1.24 times the model" in remark for remark in found.remarks)


@pytest.mark.parametrize(
    ("reduction", "mu", "value"), [(2.0, 0.3, 0.44106857), (2.0, 0.4, 0.66834738), (4.0, 0.2, 0.53042739)]
)
def test_question_of_a_code(reduction: float, mu: float, value: float) -> None:
    goods = sm.blocks_on_floors([1.0, 1.0, 0.0], mu)
    found = sm.effective_mass_of_design(designed(3, 0.47, 1.0, reduction), goods, MOTIONS)
    assert found.kind == "root"
    assert found.value == pytest.approx(value, abs=1e-7)
    assert found.metadata["question"] == "design rule"


@pytest.mark.parametrize("alpha", [0.5, 1.0, 1.5])
@pytest.mark.parametrize("eta", [0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0])
def test_step_input(alpha: float, eta: float) -> None:
    """Closed form of an undamped oscillator with a block under a step of 0.4 g."""
    building = sm.Building.uniform(1, 0.5, damping=0.0)
    scene = sm.Scene(building, [sm.Block(1, mass_ratio=alpha, mu=0.4 * eta)])
    step = sm.Motion(np.full(401, 0.4 * STANDARD_GRAVITY), 0.005)
    expected = ((1.0 + alpha * eta + np.sqrt(1.0 + alpha * (2.0 * eta - eta**2))) / 2.0 - 1.0) / alpha
    found = sm.effective_mass(scene, step)
    assert found.value == pytest.approx(expected, abs=1e-12)
    assert found.interval is None


def test_goods_that_never_slide() -> None:
    found = sm.effective_mass(case(3, 0.47, 1.0, 4.0, 50.0), MOTIONS)
    assert (found.value, found.kind, found.roots) == (1.0, "stuck", ())
    assert found.real == pytest.approx(found.model, rel=1e-14)
    assert found.interval == (1.0, 1.0)


def test_goods_without_friction() -> None:
    found = sm.effective_mass(case(3, 0.47, 1.0, 4.0, 0.0), MOTIONS)
    assert (found.value, found.kind) == (0.0, "zero")
    assert found.real == pytest.approx(found.model, rel=1e-14)
    assert found.interval == (0.0, 0.0)


def test_little_friction() -> None:
    """As mu goes to 0 the root goes to 0 from below: the model never drifts less."""
    found = sm.effective_mass(case(3, 0.47, 1.0, 4.0, 1e-6), MOTIONS)
    assert (found.value, found.kind, found.roots) == (0.0, "zero", ())


def scaled_scene(scene: sm.Scene, *, mass: float = 1.0, force: float = 1.0, mu: float = 1.0, time: float = 1.0) -> Any:
    building = scene.building
    assert building is not None
    other = building.replace(
        mass=building.mass * mass,
        stiffness=building.stiffness * mass / time**2,
        yield_shear=building.yield_shear * force * mass,
    )
    return sm.Scene(other, [block.replace(mu_s=block.mu_s * mu, mu_k=block.mu_k * mu) for block in scene.blocks])


def test_invariances() -> None:
    scene = case(3, 0.47, 1.0, 4.0, 0.2)
    plain = sm.effective_mass(scene, MOTIONS)
    others = {
        "motions, strengths and friction times three": (
            scaled_scene(scene, force=3.0, mu=3.0),
            [record.scaled(3.0) for record in MOTIONS],
            3.0,
        ),
        "mirror image": (scene, [record.scaled(-1.0) for record in MOTIONS], 1.0),
        "masses, stiffnesses and strengths times 1e5": (scaled_scene(scene, mass=1e5), MOTIONS, 1.0),
        "time times two": (scaled_scene(scene, time=2.0), [record.time_scaled(2.0) for record in MOTIONS], 4.0),
    }
    for name, (other, motions, drift) in others.items():
        found = sm.effective_mass(other, motions)
        assert found.value == pytest.approx(plain.value, abs=1e-10), name
        assert found.real == pytest.approx(drift * plain.real, rel=1e-10), name
        assert found.eta == pytest.approx(plain.eta, rel=1e-10), name


def test_bisection_on_single_runs() -> None:
    """The same root by halving, with nothing shared but `simulate` and a model made here."""
    scene = case(2, 0.38, 0.5, 4.0, 0.2)
    building = scene.building
    assert building is not None

    def mean(one: sm.Scene) -> float:
        return float(np.mean([sm.simulate(one, motion).peak_drift.max() for motion in MOTIONS]))

    def model(share: float) -> float:
        mass = building.mass + share * np.array([0.5, 0.0])
        return mean(sm.Scene(building.replace(mass=mass, damping=building.damping_matrix)))

    real = mean(scene)
    low, high = 0.5, 0.75
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if model(middle) < real else (low, middle)
    assert sm.effective_mass(scene, MOTIONS).value == pytest.approx(low, abs=1e-8)


SHARES = np.linspace(0.0, 1.0, 101)


@pytest.fixture(scope="module")
def drifts() -> tuple[Any, Any]:
    """Largest drifts of the models, shape (shares, motions), and of the real building, of the case R = 2, mu = 0.3."""
    scene = case(3, 0.47, 1.0, 2.0, 0.3)
    return np.array([largest_drifts(sm.attached_scene(scene, share)) for share in SHARES]), largest_drifts(scene)


def share_by_hand(model: Any, real: float) -> float:
    """The last crossing of one curve, with the rule for curves without one."""
    for k in range(len(SHARES) - 1, -1, -1):
        if model[k] < real:
            if k == len(SHARES) - 1:
                return 1.0
            if np.isinf(model[k + 1]):  # collapses there: the share before it
                return float(SHARES[k])
            return float(SHARES[k] + 0.01 * (real - model[k]) / (model[k + 1] - model[k]))
    return 0.0


@pytest.mark.parametrize("statistic", ["mean", "median"])
@pytest.mark.parametrize("events", [None, ["a", "a", "b", "c", "b", "b", "d"]], ids=["records", "events"])
def test_interval_is_the_paired_bootstrap(drifts: tuple[Any, Any], statistic: Any, events: list[str] | None) -> None:
    """Every resample as a list of records, whole events at a time, real and model from the same list."""
    model, real = drifts
    recorded: list[Any] = list(MOTIONS)
    if events is not None:
        recorded = [record.replace(synthetic=False, event=event) for record, event in zip(MOTIONS, events, strict=True)]
    clusters = [[k] for k in range(7)] if events is None else [[0, 1], [2, 4, 5], [3], [6]]
    count = len(clusters)
    take = np.mean if statistic == "mean" else np.median
    values, ratios = [], []
    for draw in np.random.default_rng(3).multinomial(count, np.full(count, 1.0 / count), size=200):
        records = [k for cluster, times in zip(clusters, draw, strict=True) for k in cluster * int(times)]
        curve, drift = take(model[:, records], axis=1), float(take(real[records]))
        values.append(share_by_hand(curve, drift))
        ratios.append(drift / curve)
    found = sm.effective_mass(
        case(3, 0.47, 1.0, 2.0, 0.3),
        recorded,
        statistic=statistic,
        fractions=SHARES,
        confidence=0.8,
        resamples=200,
        seed=3,
    )
    # The last bits of the sums differ; interpolation multiplies them by the inverse slope of the curve.
    assert found.interval == pytest.approx(np.percentile(values, [10.0, 90.0]), abs=1e-9)
    assert (found.confidence, found.metadata["clusters"]) == (0.8, count)
    largest = found.curve.filter(found.curve["storey"] == 0)
    low, high = np.percentile(ratios, [10.0, 90.0], axis=0)
    np.testing.assert_allclose(largest["ratio_low"], low, rtol=1e-12)
    np.testing.assert_allclose(largest["ratio_high"], high, rtol=1e-12)
    assert found.curve.filter(found.curve["storey"] > 0)["ratio_low"].null_count() == 3 * 101


@pytest.mark.parametrize("case_of", [(3, 0.47, 1.0, 2.0, 0.3), (2, 1.0, 1.5, 2.0, 0.2), (2, 0.38, 0.5, 4.0, 0.2)])
def test_shares_by_default_give_the_value_of_five_times_as_many(case_of: tuple[Any, ...]) -> None:
    """Roots are refined on exact models; the interval alone is interpolated between shares."""
    few, many = (sm.effective_mass(case(*case_of), MOTIONS, fractions=shares) for shares in (None, SHARES))
    assert few.kind == many.kind
    np.testing.assert_allclose(few.roots, many.roots, rtol=1e-11)
    assert few.interval == pytest.approx(many.interval, abs=0.005)


def test_seed_draws_other_resamples() -> None:
    scene = case(3, 0.47, 1.0, 2.0, 0.3)
    first, again, other = (sm.effective_mass(scene, MOTIONS, resamples=100, seed=seed) for seed in (0, 0, 1))
    assert first.interval == again.interval
    assert first.interval != other.interval
    assert first.value == other.value
    assert first.metadata["inputs_sha256"] != other.metadata["inputs_sha256"]


def test_several_roots() -> None:
    """Three shares give the real drift; the largest counts. Each root by single runs of its model."""
    scene = case(2, 1.0, 1.5, 2.0, 0.2)
    found = sm.effective_mass(scene, MOTIONS)
    assert found.kind == "multiple"
    assert len(found.roots) == 3
    assert found.value == found.roots[-1]
    assert f"3 shares from {found.roots[0]:.2f} to {found.value:.2f} give the same drift" in found.text
    real = largest_drifts(scene).mean()
    for root in found.roots:
        assert largest_drifts(sm.attached_scene(scene, root)).mean() == pytest.approx(real, rel=1e-9)
    places = [0.0, *found.roots, 1.0]
    middles = [0.5 * (low + high) for low, high in itertools.pairwise(places)]
    above = [largest_drifts(sm.attached_scene(scene, share)).mean() > real for share in middles]
    assert above == [False, True, False, True]


def test_records_of_one_earthquake_give_no_interval() -> None:
    recorded = [record.replace(synthetic=False, event="1940") for record in MOTIONS]
    one = sm.effective_mass(case(3, 0.47, 1.0, 2.0, 0.3), recorded)
    assert one.interval is None
    assert "one earthquake" in one.text
    assert one.curve["ratio_low"].null_count() == one.curve.height
    # Synthetic motions are of no earthquake, whatever they are called.
    assert sm.effective_mass(case(2, 0.38, 0.5, 4.0, 0.2), MOTIONS).metadata["clusters"] == 7


def test_kinetic_friction_alone_is_zero() -> None:
    """Goods that stick before they slide without friction are not absent: the bare model drifts less."""
    scene = case(3, 0.47, 1.0, 4.0, 0.3)
    scene = scene.replace(blocks=[block.replace(mu_s=0.3, mu_k=0.0) for block in scene.blocks])
    real, bare = largest_drifts(scene).mean(), largest_drifts(sm.attached_scene(scene, 0.0)).mean()
    assert bare < 0.9 * real
    found = sm.effective_mass(scene, MOTIONS)
    assert found.kind == "root"
    assert found.value > 0.0
    assert found.model == pytest.approx(real, rel=1e-9)


def test_damping_of_the_models() -> None:
    """With the ratio kept, stuck goods still count as all, and `excess` says that their model drifts less."""
    scene = case(3, 0.47, 1.0, 4.0, 50.0)
    building = scene.building
    assert building is not None
    found = sm.effective_mass(scene, MOTIONS, damping="ratio")
    model = largest_drifts(sm.Scene(building.replace(mass=building.mass + np.array([1.0, 1.0, 0.0])))).mean()
    assert (found.value, found.kind) == (1.0, "stuck")
    assert found.model == pytest.approx(model, rel=1e-12)
    assert found.excess == pytest.approx(largest_drifts(scene).mean() / model - 1.0, rel=1e-9)
    assert found.excess > 0.01
    assert found.metadata["damping"] == "ratio"


def test_interpolation_by_hand() -> None:
    shares = np.array([0.0, 0.5, 1.0])
    model = np.array([[1.0, 2.0, 3.0], [1.0, 3.0, 1.5], [5.0, 4.0, 3.0], [0.5, 1.0, 1.5], [2.5, 1.0, np.inf]])
    real = np.full((5, 3), 2.0)
    real[3] = 1.5
    # Rows: on the grid, crossing back below, never below, reached at 1, a model that collapses at 1.
    assert interpolated(shares, model, real).tolist() == [0.5, 1.0, 0.0, 1.0, 0.5]


def test_threads_and_progress() -> None:
    scene = case(2, 0.38, 0.5, 4.0, 0.2)
    seen: list[tuple[int, int]] = []
    one = sm.effective_mass(scene, MOTIONS, threads=1, progress=lambda done, total: seen.append((done, total)))
    two = sm.effective_mass(scene, MOTIONS, threads=2)
    assert one.to_json() == two.to_json()
    assert seen[-1] == (22 * 7, 22 * 7)


def test_drift_ratios_and_p_delta() -> None:
    scene = case(3, 0.47, 1.0, 4.0, 0.2)
    assert scene.building is not None
    tall = scene.replace(building=scene.building.replace(heights=3.0))
    plain, ratio = sm.effective_mass(scene, MOTIONS), sm.effective_mass(tall, MOTIONS)
    assert (plain.unit, ratio.unit) == ("m", "ratio")
    assert ratio.real == pytest.approx(plain.real / 3.0, rel=1e-14)
    assert ratio.value == pytest.approx(plain.value, abs=1e-10)
    heavy = tall.replace(building=tall.building.replace(gravity_load=STANDARD_GRAVITY))
    for share in (0.0, 0.5, 1.0):
        model = sm.attached_scene(heavy, share)
        np.testing.assert_array_equal(model.geometric_stiffness, heavy.geometric_stiffness)
        assert not model.blocks


def test_collapse() -> None:
    """P-Delta and a limit of drift that two of seven motions reach."""
    building = sm.Building.uniform(
        2,
        0.6,
        mass=1.0,
        yield_shear_over_weight=[0.4, 0.3],
        heights=3.0,
        gravity_load=STANDARD_GRAVITY,
        second_slope=0.02,
    )
    scene = sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], 0.3), collapse_drift=0.17)
    peaks = [sm.simulate(scene, motion) for motion in MOTIONS]
    collapsed = sum(peak.status == "collapsed" for peak in peaks)
    assert collapsed == 2
    mean = sm.effective_mass(scene, MOTIONS)
    assert mean.kind == "collapsed"
    assert np.isnan(mean.value)
    assert mean.interval is None
    assert mean.collapses["real"] == collapsed
    assert json.loads(mean.to_json())["value"] is None
    median = sm.effective_mass(scene, MOTIONS, statistic="median")
    assert 0.0 <= median.value <= 1.0
    real = np.minimum([peak.peak_drift_ratio.max() for peak in peaks], 0.10)
    assert median.real == pytest.approx(np.median(real), rel=1e-12)
    # Resamples by hand, and the median of all motions but one.
    runs = [[sm.simulate(sm.attached_scene(scene, share), motion) for motion in MOTIONS] for share in SHARES]
    models = np.minimum([[run.peak_drift_ratio.max() for run in of] for of in runs], 0.10)

    def by_hand(records: np.ndarray) -> float:
        return share_by_hand(np.median(models[:, records], axis=1), float(np.median(real[records])))

    draws = np.random.default_rng(0).multinomial(7, np.full(7, 1.0 / 7.0), size=300)
    values = [by_hand(np.repeat(np.arange(7), draw)) for draw in draws]
    drawn = sm.effective_mass(scene, MOTIONS, statistic="median", fractions=SHARES, resamples=300)
    assert drawn.interval == pytest.approx(np.percentile(values, [5.0, 95.0]), abs=1e-9)
    others = [by_hand(np.delete(np.arange(7), motion)) for motion in range(7)]
    np.testing.assert_allclose(drawn.records["value_without"], others, atol=1e-9)


def test_tables_json_and_files(tmp_path: Path) -> None:
    found = sm.effective_mass(case(2, 0.38, 0.5, 4.0, 0.2), MOTIONS)
    assert found.curve.columns[:5] == ["fraction", "storey", "model_drift", "real_drift", "ratio"]
    assert found.curve.height == 21 * 3
    assert found.records["record"].to_list() == [record.name for record in MOTIONS]
    assert found.records["motion"].to_list() == list(range(1, 8))
    single = sm.effective_mass(case(2, 0.38, 0.5, 4.0, 0.2), MOTIONS[2])
    row = found.records.row(2, named=True)
    assert row["kind"] == single.kind
    assert row["real_drift"] == pytest.approx(single.real, rel=1e-12)
    if single.roots:
        assert row["last_root"] == pytest.approx(single.roots[-1], abs=1e-3)
    assert found.curve.columns[5:] == ["ratio_low", "ratio_high"]
    assert found.storeys.columns == [
        *("storey", "real", "model", "model_at_0", "model_at_1"),
        *("ratio", "ratio_at_0", "ratio_at_1", "envelope_ratio"),
    ]
    assert found.records.columns == [
        *("motion", "record", "event", "slips", "collapsed", "real_drift", "kind", "first_root", "last_root"),
        "value_without",
    ]
    assert json.loads(found.to_json()) == json.loads(json.dumps(found.to_dict()))
    document = json.loads(found.to_json())
    assert document["value"] == found.value
    assert document["interval"] == list(found.interval or ())
    assert document["storeys"] == found.storeys.to_dicts()
    assert document["records"] == found.records.to_dicts()
    assert document["metadata"]["second_slope"] == [0.05, 0.05]
    names = {file.name for file in found.write(tmp_path)}
    assert names == {file.name for file in tmp_path.iterdir()}
    assert names == {
        *("effective_mass.json", "files.json"),
        *(f"{table}.{form}" for table in ("curve", "storeys", "records") for form in ("parquet", "csv")),
        *(f"{figure}.{form}" for figure in ("curve", "storeys") for form in ("png", "svg")),
    }
    assert (tmp_path / "curve.png").read_bytes().startswith(b"\x89PNG")
    assert pl.read_parquet(tmp_path / "curve.parquet").equals(found.curve)


def scene() -> sm.Scene:
    return case(2, 0.38, 0.5, 4.0, 0.2)


WRONG: list[tuple[Callable[[], object], type[Exception], str]] = [
    (lambda: sm.effective_mass("scene", MOTIONS), sm.errors.InvalidScene, "scene of effective mass must be a Scene"),
    (
        lambda: sm.effective_mass(sm.Scene(sm.Building.uniform(2, 0.4)), MOTIONS),
        sm.errors.InvalidScene,
        "blocks of effective mass must be at least one on a floor",
    ),
    (
        lambda: sm.effective_mass(sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]), MOTIONS),
        sm.errors.InvalidScene,
        "building of effective mass must be given",
    ),
    (lambda: sm.effective_mass(scene(), []), sm.errors.InvalidMotion, "motions of effective mass must be at least one"),
    (lambda: sm.effective_mass(scene(), 3), sm.errors.InvalidMotion, "motions of effective mass must be a list"),
    (lambda: sm.effective_mass(scene(), ["a"]), sm.errors.InvalidMotion, "motion 1 of effective mass must be a Motion"),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, statistic="mode"),
        sm.errors.InvalidOption,
        "statistic of effective mass must be mean or median",
    ),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, damping="own"),
        sm.errors.InvalidOption,
        "damping of effective mass must be same or ratio",
    ),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, fractions=[0.0, 0.5]),
        sm.errors.InvalidOption,
        "fractions of effective mass must be a list in increasing order",
    ),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, confidence=90),
        sm.errors.InvalidOption,
        "confidence of effective mass must be above 0 and below 1",
    ),
    (lambda: sm.effective_mass(scene(), MOTIONS, resamples=0), sm.errors.InvalidOption, "resamples of effective mass"),
    (lambda: sm.effective_mass(scene(), MOTIONS, threads=0), sm.errors.InvalidOption, "threads of effective mass"),
    (lambda: sm.effective_mass(scene(), MOTIONS, progress=1), sm.errors.InvalidOption, "progress of effective mass"),
    *[
        (
            lambda fractions=fractions: sm.effective_mass(scene(), MOTIONS, fractions=fractions),
            sm.errors.InvalidOption,
            f"fractions of effective mass must be {requirement}",
        )
        for fractions, requirement in (
            ([0.1, 1.0], r"a list in increasing order that begins with 0 .*got \[0.1, 1.0\]"),
            ([0.0, 0.5, 0.5, 1.0], r"a list in increasing order .*got \[0.0, 0.5, 0.5, 1.0\]"),
            ([0.0, float("nan"), 1.0], ".*nan"),
            ("all", ".*'all'"),
        )
    ],
    *[
        (
            lambda confidence=confidence: sm.effective_mass(scene(), MOTIONS, confidence=confidence),
            sm.errors.InvalidOption,
            f"confidence of effective mass must be .*got {confidence!r}",
        )
        for confidence in (0, 1, -0.5, "high", None, float("nan"))
    ],
    (lambda: sm.effective_mass(scene(), MOTIONS, resamples=1.5), sm.errors.InvalidOption, "resamples of .*got 1.5"),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, seed=-1),
        sm.errors.InvalidOption,
        "seed of effective mass must be .*got -1",
    ),
    (lambda: sm.effective_mass(scene(), MOTIONS, threads="two"), sm.errors.InvalidOption, "threads of .*got 'two'"),
    (
        lambda: sm.attached_scene(scene(), 0.5, "own"),
        sm.errors.InvalidOption,
        "damping of attached scene must be same or",
    ),
    (
        lambda: sm.effective_mass_of_design(
            lambda share: sm.Building.uniform(2 if share < 0.5 else 3, 0.4), sm.blocks_on_floors([1.0], 0.2), MOTIONS
        ),
        sm.errors.InvalidScene,
        "design of effective mass must be a Building of the same number of storeys",
    ),
    (
        lambda: sm.attached_scene(scene(), 1.5),
        sm.errors.InvalidOption,
        "fraction of attached scene must be between 0 and 1",
    ),
    (
        lambda: sm.effective_mass_of_design(3, [], MOTIONS),
        sm.errors.InvalidOption,
        "design of effective mass must be a",
    ),
    (
        lambda: sm.effective_mass_of_design(lambda share: share, sm.blocks_on_floors([1.0], 0.2), MOTIONS),
        sm.errors.InvalidScene,
        "design of effective mass must be a Building",
    ),
]


@pytest.mark.parametrize(("make", "kind", "message"), WRONG, ids=[message for *_, message in WRONG])
def test_wrong_input(make: Callable[[], object], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=f"^{message}"):
        make()


def test_motions_of_zeros_are_refused() -> None:
    still = sm.Motion(np.zeros(100), 0.01)
    with pytest.raises(sm.errors.InvalidMotion, match=r"^motions of effective mass must be other than zero somewhere"):
        sm.effective_mass(scene(), still)


def test_interval_over_suites_is_wider_at_each_end() -> None:
    found = sm.effective_mass(case(3, 0.47, 1.0, 4.0, 0.2), MOTIONS, resamples=200)
    assert found.interval is not None
    # 0.05 at each end, SUITE_SCATTER, measured between suites.
    expected = (found.interval[0] - 0.05, found.interval[1] + 0.05)
    assert found.suite_interval == pytest.approx((max(0.0, expected[0]), min(1.0, expected[1])))
    assert f"over suites too {found.suite_interval[0]:.2f}" in found.text
    stuck = sm.effective_mass(case(3, 0.47, 1.0, 4.0, 50.0), MOTIONS, resamples=2)
    assert stuck.suite_interval == stuck.interval == (1.0, 1.0)


SHAPES: dict[str, Callable[[float, float, float, float], float]] = {
    "smooth": lambda x, root, slope, bend: slope * (x - root) + bend * (x - root) ** 3,
    "steep": lambda x, root, slope, _: (x - root) / abs(1e-3 * slope),
    "kinked": lambda x, root, slope, bend: abs(x - root) * slope - 0.1 * bend,
    "with a jump": lambda x, root, slope, bend: slope * (x - root) + bend * (x > root),
    "wavy": lambda x, root, slope, _: float(np.tanh(5.0 * slope * (x - root)) + 0.02 * np.sin(40.0 * x)),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_roots_are_those_of_scipy_bit_for_bit_by_the_same_steps(shape: str) -> None:
    """`brentq` with the same tolerances asks for the same shares, in any bracket of any function."""
    random = np.random.default_rng(1)
    asked: list[float] = []

    def function(x: float) -> float:
        asked.append(x)
        return min(max(SHAPES[shape](x, *numbers), -1.0), 10.0)

    compared = 0
    while compared < 200:
        numbers = (random.uniform(-0.5, 1.5), *random.normal(size=2))
        low, high = sorted(random.uniform(0.0, 1.0, 2))
        if function(low) * function(high) >= 0.0 or min(abs(function(low)), abs(function(high))) <= 1e-9:
            continue
        asked.clear()
        expected = brentq(function, low, high, xtol=TOLERANCE, rtol=1e-14)
        steps = asked.copy()
        asked.clear()
        assert refined_root(function, (low, high)) == expected
        assert asked[2:] == steps  # the first two tell whether an end is the root
        compared += 1


def test_a_drift_that_is_no_number_is_an_error_and_no_root() -> None:
    with pytest.raises(sm.errors.SimulationError, match=r"drift of building at share 0\.5\d* must be finite"):
        refined_root(lambda x: -1.0 if x == 0.0 else 1.0 if x == 1.0 else float("nan"), (0.0, 1.0))


def test_goods_on_the_ground_do_not_hold_those_on_the_floors() -> None:
    """Floors whose goods have no friction are bare, whatever the friction of goods on the ground."""
    building = sm.Building.uniform(2, 0.3, mass=1e5)
    motions = [sm.builtin_record("synthetic-1"), sm.builtin_record("synthetic-2")]
    loose = [sm.Block(1, mass=4e4, mu=0.0), sm.Block(2, mass=3e4, mu=0.0)]
    alone, beside = (
        sm.effective_mass(sm.Scene(building, blocks), motions, resamples=2)
        for blocks in (loose, [sm.Block(0, mass=5e4, mu=0.4), *loose])
    )
    assert (beside.value, beside.kind) == (alone.value, alone.kind) == (0.0, "zero")
    held = sm.effective_mass(sm.Scene(building, [loose[0], sm.Block(2, mass=3e4, mu=0.3)]), motions, resamples=2)
    assert held.kind != "zero"


@pytest.mark.parametrize(
    ("blocks", "held"),
    [
        ([], False),
        ([sm.Block(1, mass=1e3, mu=0.0)], False),
        ([sm.Block(0, mass=1e3, mu=0.4)], False),
        ([sm.Block(0, mass=1e3, mu=0.4), sm.Block(2, mass=1e3, mu=0.0)], False),
        ([sm.Block(1, mass=1e3, mu=0.0), sm.Block(2, mass=1e3, mu=0.1)], True),
        ([sm.Block(1, mass=1e3, mu_s=0.1, mu_k=0.0)], True),
        ([sm.Block(1, mass=1e3, mu=0.0, wear=[(0.1, 0.2, 0.2)])], True),
    ],
)
def test_goods_are_held_by_any_friction_on_a_floor(blocks: list[sm.Block], held: bool) -> None:
    """Static friction alone, or after wear, holds them too; goods on the ground are no matter of the building."""
    scene = sm.Scene(sm.Building.uniform(2, 0.3, mass=1e5), blocks)
    assert without_friction(scene) is not held
