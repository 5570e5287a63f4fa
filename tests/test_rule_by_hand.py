"""The rule by hand against numbers worked out on paper, its limits, and the words that state it."""

from __future__ import annotations

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.effective_mass.rule import (
    RULE,
    by_hand,
    by_period,
    compared,
    exceptions,
    floor_coefficient,
    share_by_hand,
    yield_reduction,
)
from seismass.motions.spectra import corner_period
from seismass.runs.peaks import named_motions

TARGET = sm.TargetSpectrum.asce7(1.0, 0.6)


def scene_of(mu: float = 0.2, ratio: float = 1.0, **shape: float) -> sm.Scene:
    """Two storeys of 0.3 s with V_y/W of 0.5, loaded on both floors."""
    building = sm.Building.uniform(2, 0.3, mass=1e4, yield_shear_over_weight=[0.5, 0.3], **shape)
    return sm.Scene(building, sm.blocks_on_floors([ratio, ratio], mu=mu))


def test_the_rule_on_paper() -> None:
    """S_a = 1 g. V_y/W_g = 1/8: R_y = 8, C1 = 1/4; above S_a, and without yield: R_y = 1, C1 = S_a.

    mu = 0.1 over C1 = 0.25: 1.35 x 0.4 - 0.15 = 0.39.
    """
    np.testing.assert_allclose(yield_reduction(1.0, [0.125, 1.3, np.inf]), [8.0, 1.0, 1.0], rtol=1e-15)
    np.testing.assert_allclose(floor_coefficient(1.0, [0.125, 1.3, np.inf]), [0.25, 1.0, 1.0], rtol=1e-15)
    np.testing.assert_allclose(share_by_hand([0.1, 0.01, 0.9], 0.25), [0.39, 0.0, 1.0], rtol=1e-14)
    assert share_by_hand(0.1, 0.25, 0.10) == pytest.approx(0.44, rel=1e-14)


def test_the_rule_of_a_scene() -> None:
    """W_g is twice W, V_y/W_g = 0.25, S_a = 1 g on the plateau: R_y = 4, C1 = 4^(-2/3) = 0.3969."""
    found = by_hand(scene_of(), None, TARGET)
    assert found.period == pytest.approx(0.3, rel=1e-12)
    assert found.spectral_acceleration_g == pytest.approx(1.0, rel=1e-12)
    assert found.weight == pytest.approx(4e4 * 9.80665, rel=1e-14)
    assert found.yield_shear == pytest.approx(1e4 * 9.80665, rel=1e-12)
    assert found.yield_reduction == pytest.approx(4.0, rel=1e-12)
    assert found.coefficient == pytest.approx(4.0 ** (-2.0 / 3.0), rel=1e-12)
    assert found.estimate == pytest.approx(1.35 * 0.2 * 4.0 ** (2.0 / 3.0) - 0.15, rel=1e-12)
    assert found.exceptions == ()
    assert found.words == (
        f"{RULE} = 0.53; mu = (mu_s + mu_k)/2 = 0.2, C1 = S_a/R_y^(2/3) = 0.397, S_a = 1.000 g at 0.300 s (target "
        "spectrum), R_y = S_a W_g/V_y = 4.00, W_g = 392.2660 kN, V_y = 98.0665 kN"
    )


def test_the_spectrum_is_that_of_the_motions_where_no_target_is_given() -> None:
    motions = sm.builtin_suite("seven")
    found = by_hand(scene_of(), named_motions(list(motions), "test"), None)
    spectra = [sm.response_spectrum(record, [0.3])[0][0] for record in motions]
    assert found.spectral_acceleration_g == pytest.approx(np.mean(spectra) / 9.80665, rel=1e-9)
    assert "(mean spectrum of the motions)" in found.words


@pytest.mark.parametrize(
    ("shape", "ratio", "said"),
    [
        ({"overstrength": 1.49}, 1.0, ("Omega below 1.5",)),
        ({"second_slope": 0.0}, 1.0, ("no second slope",)),
        ({"second_slope": 0.11}, 1.0, ("r2 above 0.1",)),
        ({}, 2.1, ("goods above 2 times their floor",)),
        ({"overstrength": 1.5, "second_slope": 0.1}, 2.0, ()),
    ],
)
def test_where_less_is_taken_off(shape: dict[str, float], ratio: float, said: tuple[str, ...]) -> None:
    """At the limits themselves 0.15 stands; beyond them 0.10, so that the share is larger by 0.05."""
    found = by_hand(scene_of(0.1, ratio, **shape), None, TARGET)
    assert found.exceptions == said
    assert found.offset == (0.10 if said else 0.15)
    assert found.estimate == pytest.approx(1.35 * 0.1 / found.coefficient - found.offset, rel=1e-12)
    elastic = sm.Building.uniform(2, 0.3, **shape)
    assert exceptions(elastic, ratio) == (said if ratio > 2.0 else ())


def test_rule_of_unequal_goods_and_storeys(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]) -> None:
    """What the rule takes, worked out here: V_y of storey 1, all masses, friction averaged over the goods."""
    mass, goods = np.array([44.1, 35.7, 22.4]), np.array([30.4, 13.7, 7.8])
    rule = sm.effective_mass(unequal_scene, unequal_motions, fractions=[0.0, 1.0], target=TARGET, resamples=1).by_hand
    acceleration, weight = TARGET([rule.period])[0] / 9.80665, 9.80665e3 * (mass + goods).sum()
    reduction = acceleration * weight / 283e3
    assert rule.yield_reduction == pytest.approx(reduction, rel=1e-12)
    # Means of static and kinetic friction: (0.298 + 0.214)/2, (0.253 + 0.154)/2, (0.349 + 0.184)/2, (0.291 + 0.24)/2.
    mu = (18.9 * 0.256 + 11.5 * 0.2035 + 13.7 * 0.2665 + 7.8 * 0.2655) / 51.9
    assert rule.friction == pytest.approx(mu, rel=1e-12)
    share = 1.35 * mu * reduction ** (2.0 / 3.0) / acceleration - 0.15
    assert rule.estimate == pytest.approx(min(1.0, max(0.0, share)), rel=1e-12)


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
