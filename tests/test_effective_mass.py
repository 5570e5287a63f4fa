"""The effective fraction of live load: closed form, limits, invariances, an independent search, scatter, errors."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.design import response_spectrum_analysis
from seismass.effective_mass.curve import interpolated
from seismass.spectra import mean_spectrum
from seismass.units import STANDARD_GRAVITY

SUITE = sm.builtin_suite()
FACTORS = sm.scale_asce7_10(SUITE, sm.TargetSpectrum.asce7()).factors
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
    # Given to 1e-6 mm.
    assert 1e3 * found.real == pytest.approx(real_mm, abs=1e-6)
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
    assert found.estimate == pytest.approx(found.eta**2)
    assert found.conservative == found.eta
    np.testing.assert_allclose(found.storeys["ratio"].to_numpy(), [1.0, 0.881463, 0.849328], atol=1e-6)


def test_all_attached_is_not_enough() -> None:
    found = sm.effective_mass(case(3, 0.47, 1.0, 4.0, 0.4), MOTIONS)
    assert (found.value, found.kind) == (1.0, "one")
    assert 1e3 * found.real == pytest.approx(69.855967, abs=1e-6)
    assert 0.0 < found.excess < 0.01
    assert "more than the model with all goods attached" in found.text


def test_top_storey_needs_the_envelope() -> None:
    found = sm.effective_mass(case(4, 0.57, 1.5, 6.0, 0.15), MOTIONS)
    top = found.storeys.row(-1, named=True)
    assert top["ratio"] == pytest.approx(1.244, abs=1e-3)
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
    assert sm.effective_mass(case(3, 0.47, 1.0, 4.0, 1e-6), MOTIONS).value == 0.0


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
    value = sm.effective_mass(scene, MOTIONS).value
    others = {
        "motions, strengths and friction times three": (
            scaled_scene(scene, force=3.0, mu=3.0),
            [record.scaled(3.0) for record in MOTIONS],
        ),
        "mirror image": (scene, [record.scaled(-1.0) for record in MOTIONS]),
        "masses, stiffnesses and strengths times 1e5": (scaled_scene(scene, mass=1e5), MOTIONS),
        "time times two": (scaled_scene(scene, time=2.0), [record.time_scaled(2.0) for record in MOTIONS]),
    }
    for name, (other, motions) in others.items():
        assert sm.effective_mass(other, motions).value == pytest.approx(value, abs=1e-10), name


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


def test_interval_is_the_paired_bootstrap() -> None:
    scene = case(3, 0.47, 1.0, 2.0, 0.3)
    found = sm.effective_mass(scene, MOTIONS, resamples=200, seed=3)
    shares = found.curve["fraction"].unique().sort().to_numpy()
    curves = np.array(
        [
            [sm.simulate(sm.attached_scene(scene, share), motion).peak_drift.max() for motion in MOTIONS]
            for share in shares
        ]
    )
    real = np.array([sm.simulate(scene, motion).peak_drift.max() for motion in MOTIONS])
    draws = np.random.default_rng(3).multinomial(7, np.full(7, 1.0 / 7.0), size=200)
    values = []
    for draw in draws:
        difference = (curves * draw).sum(axis=1) / 7.0 - (real * draw).sum() / 7.0
        below = np.flatnonzero(difference < 0.0)
        if not len(below):
            values.append(0.0)
        elif below[-1] == len(shares) - 1:
            values.append(1.0)
        else:
            k = below[-1]
            values.append(shares[k] + 0.01 * -difference[k] / (difference[k + 1] - difference[k]))
    assert found.interval == pytest.approx(np.percentile(values, [5.0, 95.0]), abs=1e-9)


def test_records_of_one_earthquake_are_drawn_together() -> None:
    scene = case(3, 0.47, 1.0, 2.0, 0.3)
    recorded = [record.replace(synthetic=False) for record in MOTIONS]
    one = sm.effective_mass(scene, [record.replace(event="1940") for record in recorded])
    assert one.interval is None
    assert "one earthquake" in one.text
    pairs = [record.replace(event=f"event {number // 2}") for number, record in enumerate(recorded)]
    assert sm.effective_mass(scene, pairs).metadata["clusters"] == 4
    assert sm.effective_mass(scene, MOTIONS).metadata["clusters"] == 7


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
    assert seen[-1] == (102 * 7, 102 * 7)


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
    drifts = [np.inf if peak.status == "collapsed" else peak.peak_drift_ratio.max() for peak in peaks]
    assert median.real == pytest.approx(np.median(drifts), rel=1e-12)
    assert median.interval is not None
    assert np.isfinite(median.interval).all()


def test_tables_json_and_files(tmp_path: Path) -> None:
    found = sm.effective_mass(case(2, 0.38, 0.5, 4.0, 0.2), MOTIONS)
    assert found.curve.columns[:5] == ["fraction", "storey", "model_drift", "real_drift", "ratio"]
    assert found.curve.height == 101 * 3
    assert found.records["record"].to_list() == [record.name for record in MOTIONS]
    assert found.records["motion"].to_list() == list(range(1, 8))
    single = sm.effective_mass(case(2, 0.38, 0.5, 4.0, 0.2), MOTIONS[2])
    row = found.records.row(2, named=True)
    assert row["kind"] == single.kind
    assert row["real_drift"] == pytest.approx(single.real, rel=1e-12)
    if single.roots:
        assert row["last_root"] == pytest.approx(single.roots[-1], abs=1e-3)
    document = json.loads(found.to_json())
    assert document["value"] == found.value
    assert document["metadata"]["second_slope"] == [0.05, 0.05]
    names = {file.name for file in found.write(tmp_path)}
    assert names == {file.name for file in tmp_path.iterdir()}
    assert {"curve.png", "storeys.svg", "records.csv", "curve.parquet", "effective_mass.json"} <= names


def scene() -> sm.Scene:
    return case(2, 0.38, 0.5, 4.0, 0.2)


WRONG: list[tuple[Callable[[], object], type[Exception], str]] = [
    (lambda: sm.effective_mass("scene", MOTIONS), sm.InvalidScene, "scene of effective mass must be a Scene"),
    (
        lambda: sm.effective_mass(sm.Scene(sm.Building.uniform(2, 0.4)), MOTIONS),
        sm.InvalidScene,
        "blocks of effective mass must be at least one on a floor",
    ),
    (
        lambda: sm.effective_mass(sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]), MOTIONS),
        sm.InvalidScene,
        "building of effective mass must be given",
    ),
    (lambda: sm.effective_mass(scene(), []), sm.InvalidMotion, "motions of effective mass must be at least one"),
    (lambda: sm.effective_mass(scene(), 3), sm.InvalidMotion, "motions of effective mass must be a list"),
    (lambda: sm.effective_mass(scene(), ["a"]), sm.InvalidMotion, "motion 1 of effective mass must be a Motion"),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, statistic="mode"),
        sm.InvalidOption,
        "statistic of effective mass must be mean or median",
    ),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, damping="own"),
        sm.InvalidOption,
        "damping of effective mass must be same or ratio",
    ),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, fractions=[0.0, 0.5]),
        sm.InvalidOption,
        "fractions of effective mass must be a list in increasing order",
    ),
    (
        lambda: sm.effective_mass(scene(), MOTIONS, confidence=90),
        sm.InvalidOption,
        "confidence of effective mass must be above 0 and below 1",
    ),
    (lambda: sm.effective_mass(scene(), MOTIONS, resamples=0), sm.InvalidOption, "resamples of effective mass"),
    (lambda: sm.effective_mass(scene(), MOTIONS, threads=0), sm.InvalidOption, "threads of effective mass"),
    (lambda: sm.effective_mass(scene(), MOTIONS, progress=1), sm.InvalidOption, "progress of effective mass"),
    (lambda: sm.attached_scene(scene(), 1.5), sm.InvalidOption, "fraction of attached scene must be between 0 and 1"),
    (lambda: sm.effective_mass_of_design(3, [], MOTIONS), sm.InvalidOption, "design of effective mass must be a"),
    (
        lambda: sm.effective_mass_of_design(lambda share: share, sm.blocks_on_floors([1.0], 0.2), MOTIONS),
        sm.InvalidScene,
        "design of effective mass must be a Building",
    ),
]


@pytest.mark.parametrize(("make", "kind", "message"), WRONG, ids=[message for *_, message in WRONG])
def test_wrong_input(make: Callable[[], object], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=f"^{message}"):
        make()
