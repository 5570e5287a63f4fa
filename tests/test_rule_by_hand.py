"""The rule by hand against numbers worked out on paper, its limits, and the base shear against runs."""

from __future__ import annotations

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.effective_mass.estimate import (
    base_shear_by_hand,
    best_estimate,
    by_period,
    compared,
    conservative_estimate,
    exponent,
    height_ratio,
    yield_drift,
)
from seismass.motions.spectra import corner_period

MOTIONS = [record.scaled(1.2) for record in sm.builtin_suite("seven")]


def test_exponents() -> None:
    """1.2 (1 + 0.25/0.5) = 1.8; 1 + 0.25/1.0 = 1.25; least at no period, 1.2 x 2.5 and 1 + 0.75 from 1.5 T_c on."""
    np.testing.assert_allclose(exponent(0.25, 0.5, [True, False]), [1.8, 1.25], rtol=1e-15)
    np.testing.assert_allclose(exponent(0.0, 0.5, [True, False]), [1.2, 1.0], rtol=1e-15)
    np.testing.assert_allclose(exponent(4.0, 0.5, [True, False]), [3.0, 1.75], rtol=1e-15)


def test_heights() -> None:
    """Goods of 2 at 4 m and 1 at 7 m: 5 m; with floors of 1 at 4, 7 and 10 m: (15 + 21)/6 = 6 m."""
    assert height_ratio([2.0, 1.0, 0.0], [1.0, 1.0, 1.0], [4.0, 3.0, 3.0]) == pytest.approx(5.0 / 6.0, rel=1e-15)
    assert height_ratio([0.5, 0.5], [1.0, 1.0]) == 1.0
    assert height_ratio([0.0, 0.0], [1.0, 1.0]) == 1.0


def test_estimates() -> None:
    """(0.5/sqrt(0.64))^2 = 0.390625; goods that would need more than their weight act in full."""
    assert best_estimate(0.5, 2.0, 0.64) == pytest.approx(0.390625, rel=1e-14)
    assert conservative_estimate(0.5, 0.64) == pytest.approx(0.625, rel=1e-14)
    assert best_estimate(1.3, 2.0) == conservative_estimate(1.3) == 1.0
    assert best_estimate(0.0, 1.7) == 0.0


def test_base_shear_of_elastic_yielding_and_capped_buildings() -> None:
    """V_e/W = 0.8, T = T_c, r2 = 0.05.

    V_y/W = 0.2: m - 1 = 3 x 1.6 = 4.8, 0.2 x 1.24 = 0.248. 0.02: m - 1 = 62.4, capped at Omega: 0.04. Elastic, and
    at V_y/W above 1.07 x 0.8: 0.856.
    """
    found = base_shear_by_hand([0.2, 0.02, np.inf, 0.9], 0.8, 0.5, 0.5, 0.05, 2.0)
    np.testing.assert_allclose(found, [0.248, 0.04, 0.856, 0.856], rtol=1e-14)


def test_base_shear_by_hand_is_near_that_of_runs() -> None:
    """Within 15 %, four times the scatter over the buildings of a map; elastic and yielding."""
    for storeys, period, strength in (
        (1, 0.2, None),
        (1, 0.3, [0.3]),
        (2, 0.4, [0.3, 0.2]),
        (3, 0.6, [0.2, 0.16, 0.1]),
    ):
        building = sm.Building.uniform(storeys, period, yield_shear_over_weight=strength)
        scene = sm.Scene(building, sm.blocks_on_floors([1.0] * storeys, mu=0.2))
        found = sm.effective_mass(scene, MOTIONS, fractions=[0.0, 1.0], resamples=1)
        assert found.by_hand.yields == (strength is not None)
        assert found.by_hand.base_shear_coefficient == pytest.approx(found.base_shear_coefficient, rel=0.15)
        assert found.by_hand.eta == pytest.approx(0.2 / found.by_hand.base_shear_coefficient, rel=1e-14)


def test_rule_of_unequal_goods_and_storeys(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]) -> None:
    """What the rule takes, worked out here: levels of 4.3, 8.0 and 11.1 m, and the spring of storey 1 alone."""
    building = unequal_scene.building
    assert building is not None
    mass, goods, levels = np.array([44.1, 35.7, 22.4]), np.array([30.4, 13.7, 7.8]), np.array([4.3, 8.0, 11.1])
    found = sm.effective_mass(unequal_scene, unequal_motions, fractions=[0.0, 1.0], resamples=1)
    rule = found.by_hand
    heights = (goods @ levels / goods.sum()) / ((mass + goods) @ levels / (mass + goods).sum())
    assert rule.height_ratio == pytest.approx(heights, rel=1e-12)
    assert rule.period == building.periods[0]
    assert rule.yields
    ratio = min(rule.period / rule.corner_period, 1.5)
    assert rule.exponent == pytest.approx(1.2 * (1.0 + ratio), rel=1e-14)
    # C1 by hand, of the period and the elastic base shear with all goods attached.
    motions = [motion.motion for motion in unequal_motions]

    def spectrum(periods: np.ndarray) -> np.ndarray:
        return np.mean([sm.response_spectrum(motion, periods)[0] for motion in motions], axis=0)

    elastic = sm.design.response_spectrum_analysis(1e3 * (mass + goods), [29.3e6, 23.1e6, 16.1e6], spectrum)
    weight = 9.80665e3 * (mass + goods).sum()
    strength, demand = 283e3 / weight, elastic.storey_shear[0] / weight
    ductility = (demand / strength - 1.0) * (1.0 + 0.6 * rule.corner_period / elastic.modes.periods[0])
    expected = min(1.07 * demand, strength * min(1.87, 1.0 + 0.067 * ductility))
    assert rule.base_shear_coefficient == pytest.approx(expected, rel=1e-9)
    mu_k = (18.9 * 0.214 + 11.5 * 0.154 + 13.7 * 0.184 + 7.8 * 0.24) / 51.9
    assert rule.eta == pytest.approx(mu_k / expected, rel=1e-9)
    assert rule.estimate == pytest.approx(min(1.0, (rule.eta / heights**0.5) ** rule.exponent), rel=1e-12)
    assert found.conservative == pytest.approx(min(1.0, found.eta / heights**0.5), rel=1e-12)


def test_drift_at_yield_is_over_the_height_of_the_storey(unequal_scene: sm.Scene) -> None:
    assert unequal_scene.building is not None
    drifts = np.array([283e3 / 29.3e6, 227e3 / 23.1e6, 139e3 / 16.1e6])
    np.testing.assert_allclose(yield_drift(unequal_scene.building), drifts / [4.3, 3.7, 3.1], rtol=1e-14)
    np.testing.assert_allclose(yield_drift(unequal_scene.building.replace(heights=None, gravity_load=None)), drifts)


def test_corner_period_follows_time_and_not_amplitude() -> None:
    """A motion slowed down by a factor has its corner later by the same; amplitudes do not matter."""

    def spectrum(periods: np.ndarray) -> np.ndarray:
        return np.minimum(1.0, 0.4 / periods)

    assert corner_period(spectrum) == pytest.approx(0.4, rel=1e-12)
    assert corner_period(lambda periods: 7.0 * spectrum(periods)) == pytest.approx(0.4, rel=1e-12)
    assert corner_period(lambda periods: spectrum(periods / 2.0)) == pytest.approx(0.8, rel=1e-12)


def test_classes_of_period() -> None:
    """Two cases at 0.2 s, of which 0.9 is unsafe as 1/0.9 is above 1.05; one at 0.8 s; none between."""
    rows = pl.DataFrame(by_period("rule", np.array([0.9, 1.0, 2.0]), np.array([0.2, 0.2, 0.8])))
    assert rows["period_from"].to_list() == [0.0, 0.7]
    assert rows["unsafe"].to_list() == [0.5, 0.0]
    assert rows["worst"].to_list() == [0.9, 2.0]
    assert rows["bias"][0] == pytest.approx(0.9**0.5, rel=1e-14)
    assert compared(np.array([0.96]))["unsafe"] == 0.0
