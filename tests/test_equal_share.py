"""The share with which a statistic of models is that of real buildings: against values by hand and closed forms."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import quad

import seismass as sm
from seismass.studies.risk import run_rates, stripe_rates

SHARES = [0.0, 0.25, 0.8, 1.0]
MODEL = np.array([[1.0, 2.0, 6.0], [2.0, 3.0, 7.0], [3.0, 5.0, 10.0], [4.0, 6.0, 11.0]])
"""Of three motions; means 3, 4, 6, 7."""


def test_mean_by_hand() -> None:
    """Mean 4.5 lies a quarter of the way from 4 to 6."""
    found = sm.evidence.equal_share(SHARES, MODEL, [3.5, 4.0, 6.0])
    assert found.value == pytest.approx(0.25 + 0.25 * 0.55, rel=1e-14)
    assert (found.kind, found.sliding) == ("root", 4.5)
    assert found.over_model(0.25)[0] == pytest.approx(4.5 / 4.0, rel=1e-14)


def test_samples_behind_the_motions_may_be_others() -> None:
    """Four draws of goods a motion against one model each: their mean is that of the case before."""
    real = np.array([[3.0, 4.0], [2.0, 6.0], [5.0, 7.0]])
    assert sm.evidence.equal_share(SHARES, MODEL, real).value == pytest.approx(0.3875, rel=1e-14)


def test_ln_mean_by_hand() -> None:
    """Geometric means of models 12^(1/3), 42^(1/3), 150^(1/3), 264^(1/3); the real one is 70^(1/3)."""
    curve = np.array([12.0, 42.0, 150.0, 264.0]) ** (1.0 / 3.0)
    expected = np.interp(70.0 ** (1.0 / 3.0), curve, SHARES)
    assert sm.evidence.equal_share(SHARES, MODEL, [1.0, 7.0, 10.0], statistic="ln mean").value == pytest.approx(
        expected, rel=1e-12
    )


def test_quantile_by_hand() -> None:
    """Two of three motions are at or below the quantile of 0.6: models have 2, 3, 5, 6, the real buildings 4."""
    found = sm.evidence.equal_share(SHARES, MODEL, [1.0, 4.0, 30.0], statistic="quantile", probability=0.6)
    assert (found.sliding, found.model.tolist()) == (4.0, [2.0, 3.0, 5.0, 6.0])
    assert found.value == pytest.approx(0.525, rel=1e-14)


@pytest.mark.parametrize(
    ("real", "least", "kind", "value"),
    [
        ([9.0, 9.0, 9.0], -np.inf, "one", 1.0),
        ([1.0, 1.0, 1.0], -np.inf, "zero", 0.0),
        ([0.0, 0.0, 0.03], 0.02, "rare", np.nan),
    ],
)
def test_kinds(real: list[float], least: float, kind: str, value: float) -> None:
    found = sm.evidence.equal_share(SHARES, MODEL, real, least=least)
    assert found.kind == kind
    np.testing.assert_equal(found.value, value)
    assert (found.interval is None) == (kind == "rare")


def test_shares_above_one_and_a_largest_one_that_is_not_enough() -> None:
    shares = [0.0, 0.5, 1.5]
    assert sm.evidence.equal_share(shares, MODEL[:3], [3.0, 4.0, 9.0]).value == pytest.approx(7.0 / 6.0, rel=1e-12)
    assert sm.evidence.equal_share(shares, MODEL[:3], [9.0, 9.0, 9.0]).value == 1.5


def test_a_curve_that_rises_by_less_than_three_percent_or_falls_is_flat() -> None:
    for last in (1.02, 0.7):
        model = np.array([[1.0, 1.0], [1.005, 1.005], [last, last]])
        assert sm.evidence.equal_share([0.0, 0.5, 1.0], model, [1.002, 1.002]).kind == "flat"


def test_several_crossings_count_the_largest() -> None:
    model = np.array([[1.0], [3.0], [1.5], [4.0]])
    found = sm.evidence.equal_share([0.0, 0.4, 0.6, 1.0], model, [2.0])
    assert (found.kind, found.interval) == ("multiple", None)
    assert found.value == pytest.approx(0.6 + 0.4 * 0.2, rel=1e-12)


def test_interval_of_a_ratio_that_is_known() -> None:
    """Real = model at 0.5 in every motion: each resample gives 0.5; motions of one station are drawn together."""
    drift = np.linspace(1.0, 9.0, 12)
    model = np.array([drift, 2.0 * drift, 3.0 * drift])
    found = sm.evidence.equal_share(
        [0.0, 0.5, 1.0], model, 2.0 * drift, cluster_of=np.repeat(np.arange(6), 2), resamples=50
    )
    assert found.interval == pytest.approx((0.5, 0.5), rel=1e-12)
    assert found.over_model(1.0) == pytest.approx((2.0 / 3.0,) * 3, rel=1e-12)
    noisy = drift * np.random.default_rng(3).lognormal(0.6, 0.4, 12)
    both = [
        sm.evidence.equal_share([0.0, 0.5, 1.0], model, noisy, cluster_of=c).interval
        for c in (np.arange(12), np.arange(12) // 6)
    ]
    assert both[0] != both[1]
    alone = sm.evidence.equal_share([0.0, 0.5, 1.0], model, noisy, cluster_of=np.zeros(12, dtype=np.int64))
    assert alone.interval is None


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"statistic": "mode"}, "statistic of equal share must be one of mean, ln mean, quantile; got 'mode'"),
        ({"sliding": [1.0, 2.0]}, "model of equal share must be of shape"),
        ({"shares": [0.0, 0.5, 0.5, 1.0]}, "model of equal share must be of shape"),
    ],
)
def test_wrong_arguments(arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=said):
        sm.evidence.equal_share(**{"shares": SHARES, "model": MODEL, "sliding": [1.0, 2.0, 3.0]} | arguments)


CURVE = sm.risk.HazardCurve([0.05, 0.3, 1.1, 9.0], [2e-2, 1.3e-3, 6e-5, 2e-7])


def test_rates_of_stripes_against_quadrature() -> None:
    """Probabilities linear in ln x between stripes, 0 at half the lowest, constant above the highest."""
    levels, p = np.array([0.2, 0.7, 1.9, 4.0]), np.array([0.05, 0.3, 0.85, 0.9])

    def at(x: float) -> float:
        return float(np.interp(np.log(x), np.log([0.1, *levels]), [0.0, *p]))

    def density(x: float) -> float:
        return at(x) * CURVE.slope(x) * CURVE.rate(x, extrapolate=True) / x

    edges = [0.1, 0.2, 0.3, 0.7, 1.1, 1.9, 4.0]
    within = sum(quad(density, a, b, epsabs=0.0, epsrel=1e-11)[0] for a, b in pairwise(edges))
    expected = within + p[-1] * CURVE.rate(4.0)
    assert stripe_rates(levels, p, CURVE) == pytest.approx(expected, rel=1e-9)
    both = stripe_rates(levels, np.stack([p, 0.5 * p], axis=1), CURVE)
    np.testing.assert_allclose(both, [expected, 0.5 * expected], rtol=1e-9)


def test_rates_of_many_stripes_are_those_of_a_lognormal_fragility() -> None:
    """A median of 1.6, dispersion 0.4, one power law: rate(median) exp((k dispersion)^2/2)."""
    curve = sm.risk.HazardCurve([0.05, 9.0], [1e-2 * 0.05**-2.5, 1e-2 * 9.0**-2.5])
    levels = np.geomspace(0.2, 12.0, 600)
    found = stripe_rates(levels, stats.norm.cdf(np.log(levels / 1.6) / 0.4), curve)
    assert found == pytest.approx(1e-2 * 1.6**-2.5 * np.exp(0.5), rel=2e-4)  # by the distance of the stripes


def test_rates_of_runs_against_sums_over_fine_intensities() -> None:
    """Demand of each run linear in logarithms between levels, in proportion below them, constant above."""
    levels, limit = np.array([0.2, 0.7, 1.9, 4.0]), 0.02
    demand = np.random.default_rng(3).lognormal(np.log(limit), 1.0, (4, 60))
    fine = np.geomspace(1e-4, 40.0, 400_001)
    hazard = CURVE.rates(fine)
    for run, found in zip(demand.T, run_rates(levels, demand, limit, CURVE), strict=True):
        at = np.exp(np.interp(np.log(fine), np.log(levels), np.log(run)))
        at = np.where(fine < levels[0], run[0] * fine / levels[0], at)
        expected = np.sum(np.where(at[:-1] > limit, hazard[:-1] - hazard[1:], 0.0)) + hazard[-1] * (run[-1] > limit)
        assert found == pytest.approx(expected, rel=1e-3, abs=1e-9)  # by their distance


def test_rates_of_runs_in_closed_form() -> None:
    """A demand that is a power of the intensity exceeds the limit from one intensity on."""
    for power in (0.5, 1.0, 2.0):
        demand = 0.013 * np.array([0.2, 0.7, 1.9]) ** power
        assert run_rates([0.2, 0.7, 1.9], demand, 0.01, CURVE) == pytest.approx(
            CURVE.rate((0.01 / 0.013) ** (1.0 / power)), rel=1e-12
        )


def test_stripes_are_judged() -> None:
    with pytest.raises(sm.errors.InvalidOption, match="levels of annual rate must be positive and increasing"):
        stripe_rates([1.0, 0.5], [0.1, 0.2], CURVE)
    with pytest.raises(sm.errors.InvalidOption, match="probability of annual rate must be 2 rows of numbers"):
        stripe_rates([0.5, 1.0], [0.1], CURVE)
