"""Friction that is scaled: kinetic never above static, and equal to it where it was, whatever the numbers round to."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm
from seismass.assessment.floors import GoodsRack
from seismass.effective_mass.live_load import _with_goods
from seismass.effective_mass.models import base_of_model

BUILDING = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
RATIOS = (1.0, 1.0 - 2.0**-53, 0.75, 0.1, 0.0)
"""Kinetic over static friction; the second is the number below 1."""


def coefficients(seed: int) -> list[tuple[float, float, float]]:
    """Static and kinetic friction, of which many are equal, and another static friction."""
    generator = np.random.default_rng(seed)
    found = [(0.1, 0.1, 0.4184431991695276), (0.2, 0.2, 0.4184431991695276), (0.4, 0.4, 0.4184431991695276)]
    for number in range(500):
        static, other = np.exp(generator.uniform(np.log(1e-4), np.log(3.0), 2)).tolist()
        if number % 2:
            static = round(static, 2) or 0.01  # as people write them
        found.append((static, static * RATIOS[number % len(RATIOS)], other))
    return found


def in_order(before: tuple[float, float], after: tuple[float, float]) -> None:
    assert 0.0 <= after[1] <= after[0]
    assert after[0] != after[1] or before[1] >= before[0] * (1.0 - 2.0**-50)  # a ratio of an ulp or two may round to 1
    if before[0] == before[1]:
        assert after[0] == after[1]


def test_goods_of_a_sampled_friction() -> None:
    """What `live_load_uncertainty` solves, with stages of wear: the static coefficient is the sample exactly."""
    for static, kinetic, other in coefficients(1):
        wear = [(0.1, 0.9 * static, 0.9 * kinetic), (0.2, 1.3 * static, kinetic)]
        scene = sm.Scene(BUILDING, [sm.Block(1, mass_ratio=1.0, mu_s=static, mu_k=kinetic, wear=wear)])
        (block,) = _with_goods(scene, other, 0.7).blocks
        assert block.mu_s == other
        in_order((static, kinetic), (block.mu_s, block.mu_k))
        assert block.mu_k == pytest.approx(kinetic / static * other, rel=1e-15)  # three roundings
        for (_, *before), (_, *after) in zip(wear, block.wear, strict=True):
            in_order((before[0], before[1]), (after[0], after[1]))
            np.testing.assert_allclose(after, np.array(before) / static * other, rtol=1e-15)
    # Goods without friction take the sample for both.
    scene = sm.Scene(BUILDING, [sm.Block(1, mass_ratio=1.0, mu=0.0, wear=[(0.1, 0.0, 0.0)])])
    (block,) = _with_goods(scene, 0.3, 1.0).blocks
    assert (block.mu_s, block.mu_k, block.wear) == (0.3, 0.3, ((0.1, 0.0, 0.0),))


@pytest.mark.parametrize(("friction", "sample"), [(0.1, 0.914), (0.2, 0.429), (0.3, 0.359), (0.4, 0.834)])
def test_uncertainty_of_goods_with_one_coefficient(friction: float, sample: float) -> None:
    """Samples whose rounded ratio to the friction, times the friction, is above the sample."""
    assert sample / friction * friction > sample
    scene = sm.Scene(BUILDING, sm.blocks_on_floors([1.0, 0.0], mu=friction))
    motion = sm.builtin_record("synthetic-1")
    found = sm.live_load_uncertainty(scene, motion, mu=sample, occupancy=1.0, samples=2, fractions=[0, 1])
    assert found.samples["mu"].to_list() == [sample, sample]


def test_bounds_of_friction_of_buildings_and_of_goods_in_racks() -> None:
    """One factor of both coefficients."""
    tables = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.4, "area_m2": 500, "dead_load_kpa": 5, "yield_shear_kn": 900},
        "storeys": [{}],
    }
    rack = GoodsRack(0.5, "as stated", 2, 0.1, 0.05, None)
    for static, kinetic, other in coefficients(2)[::5]:
        goods = {"live_load_kpa": 6, "mu_s": static, "mu_k": kinetic}
        building = sm.read_building({**tables, "goods": goods})
        factor = max(other, 1e-3)
        (block,) = building.scene(mu_factor=factor).blocks
        in_order((static, kinetic), (block.mu_s, block.mu_k))
        for stood in rack.under(1, 1e5, (factor * static, factor * kinetic), None).blocks:
            in_order((static, kinetic), (stood.block.mu_s, stood.block.mu_k))


def test_sampled_grids() -> None:
    """`mu_k_over_mu_s` of a number times what is drawn."""
    for ratio in RATIOS:
        grid = sm.Grid.sample(
            BUILDING,
            samples=200,
            seed=3,
            mass_ratio=1.0,
            mu=sm.distributions.lognormal(0.3, 0.5),
            mu_k_over_mu_s=ratio,
        )
        for number in range(1, len(grid) + 1):
            for block in grid.scene(number).blocks:
                in_order((1.0, ratio), (block.mu_s, block.mu_k))


def test_bases_of_lighter_models() -> None:
    """The base of a model with fewer goods has the friction force of the whole building."""
    for static, kinetic, other in coefficients(4)[::5]:
        base = sm.SlidingBase(mu_s=static, mu_k=kinetic, mass_ratio=1.0)
        scene = sm.Scene(BUILDING, sm.blocks_on_floors([other, other], mu=0.4), base=base)
        found = base_of_model(scene, np.asarray(BUILDING.mass))
        assert found is not None
        in_order((static, kinetic), (found.mu_s, found.mu_k))
