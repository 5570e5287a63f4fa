"""Hazard curves and annual rates: closed forms, quadrature, a published example, files and what is refused."""

from __future__ import annotations

import pickle
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

import seismass as sm
from seismass.studies.risk.annual_rate import annual_rate, capacity_rates, lognormal_rates
from seismass.studies.risk.hazard import HazardCurve

BAKER = Path(__file__).parent / "data" / "hazard_baker.csv"
CURVE = HazardCurve([0.05, 0.1, 0.3, 1.0, 2.0], [0.02, 0.007, 8e-4, 4e-5, 3e-6], label="test")


@dataclass
class Lognormal:
    median: float
    dispersion: float


def quadrature(fragility: Lognormal, hazard: HazardCurve) -> float:
    """The integral over the range of a curve, by adaptive quadrature of the definition."""
    total = 0.0
    ends = np.log(hazard.sa_g)
    for i, k in enumerate(hazard.slopes):
        constant = np.log(hazard.annual_rate[i]) + k * ends[i]

        def integrand(u: float, k: float = k, constant: float = constant) -> float:
            z = (u - np.log(fragility.median)) / fragility.dispersion
            return float(norm.cdf(z) * k * np.exp(constant - k * u))

        within = [np.log(fragility.median)] if ends[i] < np.log(fragility.median) < ends[i + 1] else None
        total += quad(integrand, ends[i], ends[i + 1], epsabs=0.0, epsrel=1e-13, limit=500, points=within)[0]
    return total


def test_power_law_and_lognormal_fragility_have_the_closed_form() -> None:
    # rate(median) exp((k beta)^2/2): Cornell (1996); one slope over a range that holds all of both.
    sa = np.geomspace(1e-5, 1e4, 10)
    for k in (1.5, 2.0, 3.5):
        hazard = HazardCurve(sa, 0.01 * (sa / 0.1) ** -k)
        for median, beta in ((0.5, 0.4), (0.2, 0.7), (1.3, 0.05)):
            exact = 0.01 * (median / 0.1) ** -k * np.exp(0.5 * (k * beta) ** 2)
            found = annual_rate(Lognormal(median, beta), hazard, extrapolate=True)
            assert found.value == pytest.approx(exact, rel=1e-13)


@pytest.mark.parametrize(
    ("median", "beta"), [(0.5, 0.4), (0.02, 0.3), (5.0, 0.6), (0.3, 1.5), (0.3, 0.01), (0.05, 0.2)]
)
def test_segments_agree_with_quadrature(median: float, beta: float) -> None:
    fragility = Lognormal(median, beta)
    found = annual_rate(fragility, CURVE)
    assert found.value == pytest.approx(quadrature(fragility, CURVE), rel=1e-12)  # that of the quadrature is 1e-13
    assert found.contributions["rate"].sum() == pytest.approx(found.value, rel=1e-12)
    assert found.bounds[0] <= found.within + found.above <= found.bounds[1]


def test_published_failure_rate() -> None:
    """The notebook of the book prints 5.568464e-05 for median 0.5 g and dispersion 0.4.

    It sums P at the left ends of the steps, of which the last one goes from 2 g to a rate of 1e-9.
    """
    hazard = HazardCurve.from_csv(BAKER, period=1.0)
    probability = norm.cdf(np.log(hazard.sa_g), np.log(0.5), 0.4)
    steps = -np.diff(hazard.annual_rate)
    tail = float(probability[-1] * hazard.annual_rate[-1])
    left, right = float(probability[:-1] @ steps), float(probability[1:] @ steps)
    assert f"{left + tail - 1e-9 * probability[-1]:.6e}" == "5.568464e-05"
    found = annual_rate(Lognormal(0.5, 0.4), hazard)
    # The integral lies between the sums at left and right ends, and near their mean; the tail is its least.
    assert left < found.value < right
    assert found.value == pytest.approx(0.5 * (left + right), rel=5e-3)
    assert found.bounds[0] == pytest.approx(found.value + tail, rel=1e-12)
    assert found.value == pytest.approx(quadrature(Lognormal(0.5, 0.4), hazard), rel=1e-9)


@pytest.mark.parametrize("beta", [0.0, 0.37])
def test_parts_beyond_both_ends_make_the_whole(beta: float) -> None:
    """The closed form of one power law, of which the curve has a short piece: each part beyond is above a tenth."""
    hazard = HazardCurve([0.3, 0.7], [0.011, 0.011 * (0.7 / 0.3) ** -1.7])
    medians = [0.23, 0.43, 0.97] if beta == 0.0 else [0.31, 0.47]
    whole = [0.011 * (median / 0.3) ** -1.7 * np.exp(0.5 * (1.7 * beta) ** 2) for median in medians]
    parts = lognormal_rates(medians, np.full(len(medians), beta), hazard)
    np.testing.assert_allclose(parts.total(True), whole, rtol=1e-13)
    np.testing.assert_array_equal(parts.total(False), parts.within)
    for median, rate in zip(medians, whole, strict=True):
        found = annual_rate(Lognormal(median, beta), hazard, extrapolate=True)
        assert found.value == pytest.approx(rate, rel=1e-13) == found.within + found.below + found.above
    for part in (parts.within, parts.below, parts.above):
        assert (part / whole).max() > 0.1
    if beta == 0.0:
        of_motions = capacity_rates(medians, hazard)
        assert of_motions.total(True) == pytest.approx(np.mean(whole), rel=1e-13)
        assert of_motions.below > 0.1 * np.mean(whole)


def test_extreme_numbers_neither_overflow_nor_cancel() -> None:
    steep = HazardCurve([0.1, 0.2, 0.4], [1e-2, 1e-8, 1e-20])
    found = annual_rate(Lognormal(0.2, 2.0), steep)
    assert found.value == pytest.approx(quadrature(Lognormal(0.2, 2.0), steep), rel=1e-9)
    assert annual_rate(Lognormal(1e-6, 0.1), CURVE).value == pytest.approx(0.02 - 3e-6, rel=1e-14)
    assert annual_rate(Lognormal(1e6, 0.1), CURVE).value == 0.0


def test_certain_capacities_give_the_hazard_at_them() -> None:
    for capacity in (0.07, 0.3, 1.7):
        above = CURVE.rate(capacity) - CURVE.annual_rate[-1]
        assert annual_rate(Lognormal(capacity, 0.0), CURVE).value == pytest.approx(above, rel=1e-14)
        assert annual_rate([capacity], CURVE).value == pytest.approx(above, rel=1e-14)
        full = annual_rate([capacity], CURVE, extrapolate=True)
        assert full.value == pytest.approx(CURVE.rate(capacity), rel=1e-14)
    several = annual_rate([0.07, 0.3, 5.0, np.inf, 0.01], CURVE)
    last = CURVE.annual_rate[-1]
    by_hand = (CURVE.rate(0.07) - last + CURVE.rate(0.3) - last + 0.02 - last) / 5.0
    assert several.value == pytest.approx(by_hand, rel=1e-14)
    # Above 2 g three motions of five exceed the limit at least, and all at most.
    assert several.bounds == pytest.approx((by_hand + 0.6 * last, by_hand + last), rel=1e-14)
    assert any("begins at 0.05 g: weaker" in remark for remark in several.remarks)


def test_many_at_once_are_those_one_by_one() -> None:
    medians, betas = np.array([[0.1, 0.5], [1.0, 3.0]]), np.array([[0.3, 0.0], [0.5, 0.9]])
    parts = lognormal_rates(medians, betas, CURVE)
    for index in np.ndindex(2, 2):
        single = annual_rate(Lognormal(medians[index], betas[index]), CURVE)
        assert parts.within[index] == pytest.approx(single.within, rel=1e-14)
        assert parts.above[index] == pytest.approx(single.above, rel=1e-12)
    rows = capacity_rates([[0.1, 0.5], [1.0, 3.0]], CURVE)
    assert rows.within[1] == pytest.approx(annual_rate([1.0, 3.0], CURVE).within, rel=1e-14)


def test_curve_is_a_power_law_between_points() -> None:
    assert CURVE.rate(np.sqrt(0.05 * 0.1)) == pytest.approx(np.sqrt(0.02 * 0.007), rel=1e-14)
    for sa in (0.05, 0.061, 0.3, 1.9, 2.0):
        assert CURVE.intensity(CURVE.rate(sa)) == pytest.approx(sa, rel=1e-13)
    assert CURVE.slope(0.2) == pytest.approx(np.log(0.007 / 8e-4) / np.log(3.0), rel=1e-14)
    assert CURVE.rate(4.0, extrapolate=True) == pytest.approx(3e-6 * 2.0 ** -CURVE.slopes[-1], rel=1e-12)
    assert CURVE.probability(0.3, 50.0) == pytest.approx(1.0 - np.exp(-50.0 * 8e-4), rel=1e-13)
    tilted = CURVE.tilted(1.2, pivot=1e-3)
    assert tilted.intensity(1e-3) == pytest.approx(CURVE.intensity(1e-3), rel=1e-13)
    np.testing.assert_allclose(tilted.slopes, 1.2 * CURVE.slopes, rtol=1e-12)
    assert pickle.loads(pickle.dumps(CURVE)) == CURVE
    assert CURVE.table().columns == ["sa_g", "annual_rate", "return_period", "slope"]
    assert repr(CURVE) == "HazardCurve('test', 5 points, Sa 0.05 to 2 g, 0.02 to 3e-06 a year)"


@pytest.mark.parametrize(
    "text",
    [
        "0.1,1e-2\n0.5,1e-4\n",
        "Sa (g),rate\n0.1,1e-2\n0.5,1e-4\n",
        "site,IM,lambda_IM\nA,0.1,1e-2\nA,0.5,1e-4\n",
        "# a comment\n\nMAFE,PGA_g\n1e-2,0.1\n1e-4,0.5\n",
        "\ufeffannual rate of exceedance of Sa,Sa(0.5 s)\n1e-2,0.1\n\n1e-4,0.5\n",
    ],
)
def test_files_with_and_without_headers(tmp_path: Path, text: str) -> None:
    file = tmp_path / "site.csv"
    file.write_text(text, encoding="utf-8")
    curve = HazardCurve.from_csv(file)
    assert curve == HazardCurve([0.1, 0.5], [1e-2, 1e-4], label="site")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.1,1e-2\n0.5,0\n", "annual rate of site.csv, line 2, must be a positive number; got '0'"),
        ("Sa,rate\n0.1,1e-2\n0.5,2e-2\n", "annual rate of site.csv, line 3, must be below that of the point before"),
        ("# c\n0.5,1e-2\n0.1,1e-4\n", "intensity of site.csv, line 3, must be above that of the point before"),
        ("0.1,1e-2\n0.5\n", "annual rate of site.csv, line 2, must be a positive number; got ''"),
        ("0.1,1e-2\n0.5,nan\n", "annual rate of site.csv, line 2, must be a positive number; got 'nan'"),
        ("0.1,1e-2\n", "points of site.csv must be at least two rows"),
        ("Sa (m/s2),rate\n0.1,1e-2\n0.5,1e-4\n", "unit of the intensity of site.csv, line 1, must be g; got Sa (m/s2)"),
        ("PGA (%g),rate\n10,1e-2\n50,1e-4\n", "unit of the intensity of site.csv, line 1, must be g; got PGA (%g)"),
        ("Sa (mg),rate\n10,1e-2\n50,1e-4\n", "unit of the intensity of site.csv, line 1, must be g; got Sa (mg)"),
        ("Sa [ft/s2],rate\n1,1e-2\n5,1e-4\n", "unit of the intensity of site.csv, line 1, must be g"),
        ("Sa (g),rate in 50 years\n0.1,1e-2\n0.5,1e-4\n", "rate of site.csv, line 1, must be annual"),
        ("Sa (g),lambda_50yr\n0.1,1e-2\n0.5,1e-4\n", "rate of site.csv, line 1, must be annual"),
        ("period,rate\n0.1,1e-2\n", "columns of site.csv, line 1, must be one of an intensity"),
    ],
)
def test_files_that_are_refused_name_their_line(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "site.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(sm.errors.RecordFormatError) as error:
        HazardCurve.from_csv(file)
    assert message in str(error.value)


def test_what_is_refused() -> None:
    with pytest.raises(sm.errors.RecordFormatError, match="must be a file of text that can be read"):
        HazardCurve.from_csv("missing.csv")
    for sa, rate, message in (
        ([0.1], [0.1], "points of hazard curve must be at least two; got 1"),
        ([0.1, 0.2], [0.1], "must be as many intensities as rates; got 2 intensities and 1 rates"),
        ([0.1, 0.1], [0.1, 0.01], "sa_g of hazard curve must be strictly increasing; got 0.1 after 0.1 in point 2"),
        ([0.1, 0.2], [0.1, 0.1], "rate of hazard curve must be strictly decreasing"),
        ([0.0, 0.2], [0.1, 0.1], "sa_g of hazard curve must be positive numbers; got 0 in point 1"),
    ):
        with pytest.raises(sm.errors.InvalidOption) as error:
            HazardCurve(sa, rate)
        assert message in str(error.value)
    with pytest.raises(sm.errors.InvalidOption, match=r"within the curve, 0.05 to 2 g, or extrapolate=True; got 3"):
        CURVE.rate(3.0)
    with pytest.raises(sm.errors.InvalidOption, match="rate of hazard curve must be within the curve"):
        CURVE.intensity(1.0)
    with pytest.raises(sm.errors.InvalidOption, match="median of fragility must be a positive number; got inf"):
        annual_rate(Lognormal(np.inf, 0.4), CURVE)
    with pytest.raises(sm.errors.InvalidOption, match="must be a Fragility, or the positive capacities of motions"):
        annual_rate([], CURVE)
    with pytest.raises(sm.errors.InvalidOption, match="hazard of annual rate must be a HazardCurve; got 3"):
        annual_rate([0.1], 3)  # type: ignore[arg-type]
