"""Occupancy, R and random samples of a grid: against scenes made by hand, the study's designs and known moments."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import polars as pl
import pytest
from polars.testing import assert_frame_equal
from scipy import stats

import seismass as sm
from seismass.motions.spectra.target import target_of_parameters
from seismass.runs.grid.sample import METHODS, points
from seismass.studies.study import StudyParameters
from seismass.studies.study.parameters import study_buildings

BUILDING = sm.Building.uniform(2, 0.3, mass=1000.0, yield_shear_over_weight=[0.2, 0.12], heights=[3.4, 2.7])
HEAVY = sm.Building.uniform(2, 0.3, mass=1000.0, yield_shear_over_weight=0.2, heights=[3.4, 2.7], gravity_load=9806.65)
TARGET = sm.TargetSpectrum.asce7(1.0, 0.6)
MOTION = sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1)


def test_occupancy_is_a_factor_of_what_slides() -> None:
    grid = sm.Grid(BUILDING, mass_ratio=[0.8, 1.6, 0.8], occupancy=[1.0, 0.5, 0.0], mu=0.2)
    assert grid.scene(1) == grid.scene(2) == sm.Scene(BUILDING, sm.blocks_on_floors([0.8, 0.8], mu=0.2))
    assert grid.scene(3).blocks == ()
    assert grid.table()["occupancy"].to_list() == [1.0, 0.5, 0.0]
    rows = sm.simulate_many(grid, MOTION)
    assert rows["peak_slip"][0].to_list() == rows["peak_slip"][1].to_list()


@pytest.mark.parametrize(("of", "mass"), [("present", 1000.0 * (1.0 + 0.25 * 0.5)), ("design", 1000.0 * 1.25)])
def test_a_share_is_attached_of_what_is_present_or_of_the_design(of: Any, mass: float) -> None:
    grid = sm.Grid(HEAVY, mass_ratio=1.0, occupancy=0.5, attached=0.25, sliding=0.0, attached_of=of, mu=0.2)
    building = grid.scene(1).building
    assert building is not None
    assert building.mass.tolist() == [mass, mass]
    # The weight is that of what is present: half the design live load, all of it still.
    assert building.gravity_load is not None
    weight = HEAVY.gravity_load[0] + 0.5 * 1000.0 * sm.STANDARD_GRAVITY  # type: ignore[index]
    np.testing.assert_allclose(building.gravity_load, weight, rtol=1e-15)


def test_what_slides_is_a_share_of_what_is_present() -> None:
    grid = sm.Grid(HEAVY, mass_ratio=1.0, occupancy=0.5, attached=0.25, attached_of="present", mu=0.2)
    scene = grid.scene(1)
    assert scene.building is not None
    carried = [block.mass_ratio * mass for block, mass in zip(scene.blocks, scene.building.mass, strict=True)]  # type: ignore[operator]
    np.testing.assert_allclose(carried, 0.75 * 0.5 * 1000.0, rtol=1e-15)
    # A block carries its weight itself.
    still = scene.building.gravity_load - HEAVY.gravity_load  # type: ignore[operator]
    np.testing.assert_allclose(still, 0.25 * 0.5 * 1000.0 * sm.STANDARD_GRAVITY, rtol=1e-12)


def test_strengths_by_r_are_those_of_the_study() -> None:
    parameters = StudyParameters(occupancies=(("storage", 0.25),))
    design = sm.runs.StrengthDesign(TARGET, share=0.25)
    grid = sm.Grid.product(
        storeys=[2, 3, 4],
        period=[0.38, 0.47, 0.57],
        R=[1.0, 2.0, 4.0, 6.0],
        design=design,
        mass_ratio=[0.5, 1.0, 1.5],
        occupancy=[0.3, 1.0],
        roof="bare",
        mu=0.4,
    )
    table = grid.table()
    found = {}
    for number, storeys, reduction, ratio, occupancy in table.select(
        "scene", "storeys", "R", "mass_ratio", "occupancy"
    ).iter_rows():
        building = grid.scene(number).building
        assert building is not None
        found[storeys, reduction, ratio, occupancy] = building.yield_shear
    for each in study_buildings(parameters, TARGET):
        labels = each.labels
        for occupancy in (0.3, 1.0):
            own = found[labels["storeys"], labels["R"], labels["alpha"], occupancy]
            np.testing.assert_allclose(own, each.yield_shear, rtol=1e-14)


def test_r_of_one_may_yield() -> None:
    design = sm.runs.StrengthDesign(TARGET, share=0.0, elastic_at_one=False)
    yields = sm.Grid(storeys=2, period=0.3, R=[1.0, 2.0], design=design)
    first, second = (yields.scene(number).building for number in (1, 2))
    assert first is not None
    assert second is not None
    np.testing.assert_allclose(first.yield_shear, 2.0 * second.yield_shear, rtol=1e-15)
    bare = sm.Building.uniform(2, 0.3)
    np.testing.assert_allclose(first.yield_shear, design.elastic_shear(bare, [0.0, 0.0]), rtol=1e-15)


@pytest.mark.parametrize(
    ("arguments", "kind", "said"),
    [
        ({"R": 2.0}, sm.errors.InvalidScene, "design of grid must be given where R is; got none"),
        (
            {"design": sm.runs.StrengthDesign(TARGET)},
            sm.errors.InvalidScene,
            "design of grid must be left out where R is",
        ),
        ({"R": 2.0, "design": TARGET}, sm.errors.InvalidScene, "design of grid must be a StrengthDesign"),
        (
            {"R": 2.0, "design": sm.runs.StrengthDesign(TARGET), "strength": 2.0},
            sm.errors.InvalidScene,
            "R of grid must be left out where strength is given",
        ),
        (
            {"R": 0.0, "design": sm.runs.StrengthDesign(TARGET)},
            sm.errors.InvalidScene,
            "R of grid must be a positive number",
        ),
        ({"occupancy": 0.5}, sm.errors.InvalidScene, "occupancy of grid must be left out where mass_ratio is"),
        (
            {"mass_ratio": 1.0, "mu": 0.2, "occupancy": -0.1},
            sm.errors.InvalidScene,
            "occupancy of grid must be a number",
        ),
        (
            {"mass_ratio": 1.0, "mu": 0.2, "attached_of": "all"},
            sm.errors.InvalidScene,
            "attached_of of grid must be present",
        ),
    ],
)
def test_arguments_are_judged(arguments: dict[str, Any], kind: type[Exception], said: str) -> None:
    with pytest.raises(kind, match=said):
        sm.Grid(BUILDING, **arguments)
    with pytest.raises(kind, match=said):
        sm.Grid.product(BUILDING, **arguments)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"target": 1.0}, "target of strength design must be a TargetSpectrum"),
        ({"target": TARGET, "share": 1.5}, "share of strength design must be between 0 and 1; got 1.5"),
        ({"target": TARGET, "elastic_at_one": 1}, "elastic_at_one of strength design must be true or false"),
        ({"target": TARGET, "combination": "sum"}, "combination of strength design must be"),
    ],
)
def test_designs_are_judged(arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=said):
        sm.runs.StrengthDesign(**arguments)


@pytest.mark.parametrize(
    "target",
    [
        TARGET,
        TARGET.tilted(-0.2),
        sm.TargetSpectrum.asce7_multi_period([0.0, 0.1, 1.0, 10.0], [0.5, 1.0, 0.6, 0.03]),
        sm.TargetSpectrum.eurocode8(2, "D", agr_g=0.2, importance=1.2, damping=0.03),
        sm.TargetSpectrum.nzs1170("C", z=0.4, r=1.3, fault_distance_km=5.0),
    ],
)
def test_a_spectrum_is_made_again_from_its_parameters(target: sm.TargetSpectrum) -> None:
    again = target_of_parameters(target.parameters)
    assert again == target
    periods = np.array([0.11, 0.5, 1.7])
    assert again(periods).tolist() == target(periods).tolist()
    assert again.label == target.label


def test_a_csv_is_made_again_and_a_mean_is_refused(tmp_path: Any) -> None:
    path = tmp_path / "site.csv"
    path.write_text("period,sa (g)\n0.01,0.4\n0.3,1.1\n3,0.2\n")
    target = sm.TargetSpectrum.from_csv(path)
    again = target_of_parameters(target.parameters)
    assert again == target
    assert again([0.2, 1.0]).tolist() == target([0.2, 1.0]).tolist()
    mean = sm.TargetSpectrum.mean_of(MOTION)
    with pytest.raises(sm.errors.InvalidOption, match="target of stored spectrum must be made of numbers"):
        target_of_parameters(mean.parameters)
    with pytest.raises(
        sm.errors.InvalidOption, match="target of stored spectrum must be of a kind that is known; got 'x'"
    ):
        target_of_parameters({"shape": "x"})


def sample(**changes: Any) -> sm.Grid:
    axes = {
        "mass_ratio": 1.0,
        "occupancy": sm.distributions.beta(0.7, 0.15),
        "mu": sm.distributions.lognormal(0.4, 0.25),
        "scale": [0.5, 1.0, 2.0],
    }
    return sm.Grid.sample(BUILDING, **({"samples": 1024, "seed": 5} | axes | changes))


@pytest.mark.parametrize("method", METHODS)
def test_samples_have_the_distributions_that_were_asked_for(method: Any) -> None:
    table = sample(method=method).table()
    for name, distribution in (
        ("mu_s", sm.distributions.lognormal(0.4, 0.25)),
        ("occupancy", sm.distributions.beta(0.7, 0.15)),
    ):
        # The distance of Kolmogorov of 1024 independent points is below 0.051 in 99 % of samples.
        distance = stats.kstest(table[name].to_numpy(), distribution.cdf).statistic  # type: ignore[attr-defined]
        assert distance < (0.051 if method == "random" else 0.006)
    counts = table["scale"].value_counts()["count"].to_numpy()
    assert len(counts) == 3
    # Each with probability 1/3: four standard deviations of the binomial, or the balance of the points.
    assert np.abs(counts - 1024 / 3).max() < (61 if method == "random" else 10)
    # Axes are independent.
    correlation = stats.spearmanr(table["mu_s"].to_numpy(), table["occupancy"].to_numpy()).statistic
    assert abs(correlation) < 0.1


def test_the_same_seed_gives_the_same_sample_and_another_one_another() -> None:
    assert_frame_equal(sample().table(), sample().table(), check_exact=True)
    assert not sample().table()["mu_s"].equals(sample(seed=6).table()["mu_s"])
    again = pickle.loads(pickle.dumps(sample(samples=8)))
    assert_frame_equal(again.table(), sample(samples=8).table(), check_exact=True)


@pytest.mark.parametrize("samples", [1, 2, 3, 100, 256])
def test_sobol_takes_any_number_of_samples_without_a_warning(samples: int) -> None:
    found = points(samples, 3, "sobol", 1)
    assert found.shape == (samples, 3)
    assert np.array_equal(found, points(256, 3, "sobol", 1)[:samples]) == (samples in (1, 2, 3, 100, 256))


def test_sobol_is_balanced_at_powers_of_two() -> None:
    # A digital net in base 2: every one of 64 equal intervals of each coordinate holds one of 64 points.
    found = points(64, 4, "sobol", 9)
    for column in found.T:
        assert sorted((column * 64).astype(int)) == list(range(64))


def test_blocks_may_have_distributions_of_their_own() -> None:
    grid = sample(
        mass_ratio=[sm.distributions.lognormal(1.0, 0.2), 0.5],
        mu=[sm.distributions.lognormal(0.4, 0.25), sm.distributions.lognormal(0.3, 0.1)],
    )
    table = grid.table()
    ratio, mu = (np.array(table[name].to_list()) for name in ("mass_ratio", "mu_s"))
    assert (ratio[:, 1] == 0.5).all()
    # Points of Sobol part every coordinate evenly: medians are off by a spacing of 1/1024 of the probability, 6e-4.
    np.testing.assert_allclose(np.median(ratio[:, 0]), 1.0, rtol=1e-3)
    np.testing.assert_allclose(np.median(mu, axis=0), [0.4, 0.3], rtol=1e-3)
    assert abs(stats.spearmanr(mu[:, 0], mu[:, 1]).statistic) < 0.1


def test_kinetic_friction_may_be_drawn_over_static() -> None:
    table = sample(
        mu=None, mu_s=sm.distributions.lognormal(0.4, 0.25), mu_k_over_mu_s=sm.distributions.beta(0.75, 0.1)
    ).table()
    ratio = (table["mu_k"] / table["mu_s"]).to_numpy()
    assert ratio.max() <= 1.0
    np.testing.assert_allclose(ratio.mean(), 0.75, atol=5e-4)
    half = sample(mu=[sm.distributions.lognormal(0.4, 0.25), 0.3], mu_k_over_mu_s=0.5).table()
    assert np.array_equal(np.array(half["mu_k"].to_list()), 0.5 * np.array(half["mu_s"].to_list()))


def test_storeys_and_periods_of_one_length_are_drawn_together_and_buildings_equally() -> None:
    grid = sm.Grid.sample(samples=64, storeys=[2, 3], period=[0.3, 0.45], mass_ratio=1.0, mu=0.3, seed=2)
    assert sorted(grid.table().select("storeys", "period").unique().rows()) == [(2, 0.3), (3, 0.45)]
    several = sm.Grid.sample([BUILDING, HEAVY], samples=64, scale=stats.uniform(0.5, 1.0))
    assert several.table()["building"].value_counts()["count"].to_list() == [32, 32]


def test_one_motion_for_each_sample() -> None:
    grid = sample(samples=300, motions=3)
    table = sm.simulate_many(grid, [MOTION] * 3)
    assert len(table) == 300
    assert set(table["motion"].unique()) == {1, 2, 3}
    assert table["motion"].to_list() == grid.table()["motion"].to_list()


def test_constants_alone_are_equal_scenes() -> None:
    grid = sm.Grid.sample(BUILDING, samples=3, mass_ratio=1.0, mu=0.2)
    assert len(grid) == 3
    assert grid.scene(1) == grid.scene(3)


@pytest.mark.parametrize(
    ("changes", "kind", "said"),
    [
        ({"samples": 0}, sm.errors.InvalidOption, "samples of sample must be a whole number of at least 1"),
        ({"samples": 2**31}, sm.errors.InvalidOption, "samples of sample must be at most"),
        (
            {"method": "halton"},
            sm.errors.InvalidOption,
            "method of sample must be one of sobol, latin_hypercube, random",
        ),
        ({"seed": -1}, sm.errors.InvalidOption, "seed of sample must be a whole number"),
        ({"motions": 0}, sm.errors.InvalidOption, "motions of sample must be a whole number of at least 1"),
        ({"mu": "high"}, sm.errors.InvalidScene, "mu of sample must be a number, a distribution or a list of values"),
        (
            {"scale": [sm.distributions.beta(0.5, 0.1), 1.0]},
            sm.errors.InvalidScene,
            "scale of sample must be one distribution",
        ),
        ({"mu": stats.norm(0.1, 0.2)}, sm.errors.InvalidScene, "mu_s of block 1 of scene 2 must be finite"),
        (
            {"mu_k": 0.1, "mu": None, "mu_s": 0.3, "mu_k_over_mu_s": 0.5},
            sm.errors.InvalidScene,
            "left out where mu_k is given",
        ),
        ({"mu": None, "mu_k_over_mu_s": 0.5}, sm.errors.InvalidScene, "mu of grid must be given, or mu_s"),
    ],
)
def test_samples_are_judged(changes: dict[str, Any], kind: type[Exception], said: str) -> None:
    with pytest.raises(kind, match=said):
        sample(**changes)


def test_an_unknown_axis_is_an_unexpected_argument() -> None:
    with pytest.raises(TypeError, match=r"Grid\.sample\(\) got an unexpected keyword argument 'friction'"):
        sample(friction=0.3)


def test_axes_say_what_varies() -> None:
    grid = sm.Grid.product(BUILDING, mass_ratio=[0.5, 1.0], occupancy=[0.5, 1.0], mu=[0.1, 0.2, 0.3])
    table = grid.table()
    scene = np.arange(len(grid))
    for axis in grid.axes():
        for name, values in axis.columns.items():
            assert np.array_equal(values[scene // axis.each % axis.length], table[name].to_numpy()), name
    assert [(axis.name, axis.each, axis.length) for axis in grid.axes()] == [
        ("constant", 1, 1),
        ("mass_ratio", 6, 2),
        ("occupancy", 3, 2),
        ("friction", 1, 3),
    ]


def test_a_product_of_more_than_2_to_33_scenes() -> None:
    many = np.linspace(0.1, 0.5, 2**17)
    grid = sm.Grid.product(BUILDING, mass_ratio=1.0, mu=many, scale=np.linspace(0.5, 2.0, 2**17))
    assert len(grid) == 2**34
    runs = range(2**33 + 1, 2**33 + 4)
    rows = sm.simulate_many(grid, MOTION, runs=runs)
    assert rows["scene"].to_list() == list(runs)
    factors = grid.table(runs[0], runs[-1])["scale"].to_list()
    for row, number, factor in zip(rows.iter_rows(named=True), runs, factors, strict=True):
        assert row["peak_drift"] == sm.simulate(grid.scene(number), MOTION.scaled(factor)).peak_drift.tolist()


def test_one_table_has_at_most_32_bits_of_rows_and_scenes_may_be_far_apart() -> None:
    many = np.linspace(0.1, 0.5, 2**17)
    grid = sm.Grid.product(BUILDING, mass_ratio=1.0, mu=many, scale=np.linspace(0.5, 2.0, 2**17))
    for solve in (sm.simulate_many, lambda *given: sm.write_many("rows.parquet", *given)):
        with pytest.raises(sm.errors.InvalidOption, match=r"runs of batch must be at most 4294967295 for one table"):
            solve(grid, MOTION)
    ends = [sm.simulate_many(grid, MOTION, runs=range(number, number + 1)) for number in (1, 2**34)]
    long = sm.long_table(pl.concat(ends), grid)
    assert long["scene"].unique().to_list() == [1, 2**34]
    assert long["mu_s"].unique().sort().to_list() == [0.1, 0.5]
