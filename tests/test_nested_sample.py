"""Samples of grids that are nested, correlated and crossed, and distributions that are mixed or bounded."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

import seismass as sm
from seismass.runs.grid.content import axes_table, grid_document, grid_of

BUILDING = sm.Building.uniform(3, 0.47, mass=1000.0, yield_shear_over_weight=[0.34, 0.27, 0.13])
PRESENCE = sm.distributions.gamma(0.55, 0.4)
OPTIONS: dict[str, Any] = {
    "strength": sm.distributions.lognormal(1.5, 0.2),
    "second_slope": sm.distributions.lognormal(0.08, 0.5),
    "floors": [1, 2],
    "mass_ratio": [[0.9, 1.3]],
    "occupancy": [PRESENCE, PRESENCE],
    "mu": sm.distributions.mixture([0.2, sm.distributions.lognormal(0.45, 0.25)], [0.3, 0.7]),
    "mu_k_over_mu_s": 0.75,
}


def test_buildings_are_drawn_once_and_goods_every_time() -> None:
    table = sm.Grid.sample(BUILDING, samples=(5, 4, 3), seed=7, **OPTIONS).table()
    assert len(table) == 60
    assert table["motion"].to_list() == np.repeat(np.arange(1, 6), 12).tolist()
    for name in ("strength", "second_slope"):
        by_building = table[name].to_numpy().reshape(20, 3)
        assert (by_building == by_building[:, :1]).all()
        assert len(np.unique(by_building)) == 20
    assert table["mu_s"].n_unique() > 30  # a part of the mixture is one number
    np.testing.assert_allclose(table["mu_k"], 0.75 * table["mu_s"], rtol=1e-15)


def test_buildings_do_not_depend_on_the_goods() -> None:
    one, three = (
        sm.Grid.sample(BUILDING, samples=(5, 4, goods), seed=7, **OPTIONS).table()["strength"].to_numpy()
        for goods in (1, 3)
    )
    np.testing.assert_array_equal(one, three[::3])
    other = sm.Grid.sample(BUILDING, samples=(5, 4, 1), seed=8, **OPTIONS).table()["strength"].to_numpy()
    assert not (one == other).any()


def test_every_motion_has_strengths_from_every_part_of_the_distribution() -> None:
    """Points of Sobol's sequence in turn, shuffled within a motion: one in each quarter."""
    strength = sm.Grid.sample(BUILDING, samples=(64, 4, 1), seed=2, **OPTIONS).table()["strength"].to_numpy()
    quarters = np.floor(4.0 * stats.norm.cdf(np.log(strength / 1.5) / 0.2)).reshape(64, 4)
    np.testing.assert_array_equal(np.sort(quarters, axis=1), np.tile(np.arange(4.0), (64, 1)))
    assert len(np.unique(quarters, axis=0)) > 10  # in no fixed order


@pytest.mark.parametrize("correlation", [0.0, 0.5, 1.0])
def test_floors_are_correlated(correlation: float) -> None:
    """Normal scores of 4096 loads; their standard error is some 0.015."""
    options = OPTIONS | {"method": "random", "correlation": correlation, "seed": 3}
    loads = np.array(sm.Grid.sample(BUILDING, samples=4096, **options).table()["occupancy"].to_list())
    scores = stats.norm.ppf(stats.gamma((0.55 / 0.4) ** 2, scale=0.4**2 / 0.55).cdf(loads))
    assert np.corrcoef(scores.T)[0, 1] == pytest.approx(correlation, abs=0.05)
    np.testing.assert_allclose(scores.std(axis=0), 1.0, atol=0.05)


def test_crossed_values_come_with_every_sample() -> None:
    crossed = {"attached": [0.0, 0.3], "scale": [0.5, 1.0, 2.5]}
    options = OPTIONS | {"occupancy": 0.4, "sliding": 0.0, "attached_of": "design", "crossed": crossed}
    table = sm.Grid.sample(BUILDING, samples=(3, 2, 1), **options).table()
    assert len(table) == 36
    assert table["scale"].to_list() == [0.5, 1.0, 2.5] * 12
    assert table["attached"].to_list() == ([0.0] * 3 + [0.3] * 3) * 6
    assert table["strength"].n_unique() == 6


def test_presence_by_block_is_what_slides_and_weighs() -> None:
    heavy = BUILDING.replace(gravity_load=np.full(3, 9806.65), heights=[3.4, 2.7, 3.1])
    grid = sm.Grid(heavy, floors=[1, 2], mass_ratio=[[0.8, 0.5]], occupancy=[[0.5, 1.2], [1.0, 0.0]], mu=0.3)
    assert [block.mass_ratio for block in grid.scene(1).blocks] == pytest.approx([0.4, 0.6], rel=1e-15)
    assert [block.floor for block in grid.scene(2).blocks] == [1]
    fixed = sm.Grid(
        heavy, floors=[1, 2], mass_ratio=[[0.8, 0.5]], occupancy=[[0.5, 1.2]], mu=0.3, attached=1.0, sliding=0.0
    )
    building = fixed.scene(1).building
    assert building is not None
    np.testing.assert_allclose(building.mass, [1400.0, 1600.0, 1000.0], rtol=1e-14)
    assert grid_of(grid_document(grid), axes_table(grid.axes())) == grid


def test_more_than_the_design_load_is_attached_of_the_design_alone() -> None:
    options: dict[str, Any] = {"mass_ratio": 1.0, "mu": 0.3, "sliding": 0.0}
    building = sm.Grid(BUILDING, attached=1.5, attached_of="design", **options).scene(1).building
    assert building is not None
    assert building.mass.tolist() == [2500.0] * 3
    for attached, of in ((1.5, "present"), (2.1, "design")):
        with pytest.raises(sm.errors.InvalidScene, match="attached of grid must be between 0 and"):
            sm.Grid(BUILDING, attached=attached, attached_of=of, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"samples": (3, 2)}, "samples of sample must be a number, or three"),
        ({"samples": (3, 2, 0)}, "samples of sample must be"),
        ({"motions": 3}, "motions of sample must be left out where samples are nested"),
        ({"correlation": 1.5}, "correlation of sample must be between 0 and 1"),
        ({"crossed": {"strength": [1.0]}}, "strength of sample must be left out where it is crossed"),
        ({"occupancy": [[0.5, -0.1]]}, "occupancy of grid must be a number of at least 0"),
    ],
)
def test_wrong_samples(arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(sm.errors.SeismassError, match=said):
        sm.Grid.sample(BUILDING, **{"samples": (3, 2, 1)} | OPTIONS | arguments)


def test_a_mixture_has_the_quantiles_of_its_distribution() -> None:
    parts = [stats.norm(1.0, 0.2), stats.norm(3.0, 0.5), 2.0]
    found = sm.distributions.mixture(parts, [2.0, 1.0, 1.0])
    level = np.array([0.01, 0.3, 0.49, 0.6, 0.74, 0.9, 0.999])
    value = found.ppf(level)
    below = 0.5 * stats.norm.cdf(value, 1.0, 0.2) + 0.25 * stats.norm.cdf(value, 3.0, 0.5)
    smooth = value != 2.0
    np.testing.assert_allclose((below + 0.25 * (value > 2.0))[smooth], level[smooth], atol=1e-12)
    assert value[3] == pytest.approx(2.0, abs=1e-12)  # within the step at 2
    assert sm.distributions.bounded(stats.norm(1.0, 0.2), 1.1).ppf([0.5, 0.9]).tolist() == [1.0, 1.1]
    with pytest.raises(sm.errors.InvalidOption, match="weights of mixture must be 3 probabilities"):
        sm.distributions.mixture(parts, [0.5, 0.5])
    with pytest.raises(sm.errors.InvalidOption, match="parts of mixture must be frozen distributions"):
        sm.distributions.mixture(["a"], [1.0])


def test_surveyed_loads_have_their_mean_and_deviation() -> None:
    survey = sm.occupancy.surveyed_load("storage, sustained")
    load: Any = survey.distribution(1000.0, 1.0 / 6.0)
    assert load.mean() == pytest.approx(3.5 / 6.0, rel=1e-12)
    assert load.std() == pytest.approx(survey.deviation(1000.0) / 6.0, rel=1e-12)
