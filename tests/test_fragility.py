"""Fits of fragility: against closed forms, an independent maximisation, and the example of Baker (2015)."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.special import expit, log_expit
from scipy.stats import binom, norm

import seismass as sm
from seismass.studies.fragility import fit_capacities, fit_cloud, fit_counts
from seismass.studies.fragility.fragility import probabilities
from seismass.studies.fragility.likelihood import FITTED, capacity_fits, cloud_fits, logistic_fits, probit_fits

# The example that is distributed with Baker (2015), Earthquake Spectra 31:579-599: 40 motions at each intensity.
LEVELS = np.array([0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0])
COLLAPSES = np.array([0, 0, 0, 4, 6, 13, 12, 16])
# Capacities of the other example distributed with it, an incremental dynamic analysis of 37 motions.
# fmt: off
CAPACITIES = np.array([
    0.49, 0.62, 0.63, 0.63, 0.65, 0.70, 0.71, 0.72, 0.77, 0.79, 0.80, 0.84, 0.91, 0.92, 0.93, 0.97, 1.04, 1.04, 1.05,
    1.08, 1.08, 1.09, 1.12, 1.13, 1.22, 1.32, 1.33, 1.34, 1.40, 1.40, 1.47, 1.72, 1.76, 2.15, 2.31, 2.42, 2.50,
])
# fmt: on
# The example of Dahal, Burton and Onyambu (2022), Structural Safety 96:102185: 45 motions.
DAHAL_LEVELS = np.array(
    [0.178, 0.274, 0.444, 0.56, 0.652, 0.79, 0.982, 1.246, 1.564, 2.014, 2.417, 3.021, 3.625, 4.028, 4.431, 5.035]
)
DAHAL_COLLAPSES = np.array([0, 0, 0, 0, 0, 4, 13, 23, 38, 41, 44, 45, 45, 45, 45, 45])


def maximised(loss, start: tuple[float, float]) -> tuple[float, float]:
    """The minimum of a loss by a simplex, to its rounding."""
    options = {"xatol": 1e-11, "fatol": 1e-14, "maxiter": 10_000, "maxfev": 10_000}
    found = minimize(loss, np.array(start), method="Nelder-Mead", options=options)
    assert found.success
    return float(np.exp(found.x[0])), float(found.x[1])


@pytest.mark.parametrize(("levels", "counts", "total"), [(LEVELS, COLLAPSES, 40), (DAHAL_LEVELS, DAHAL_COLLAPSES, 45)])
def test_counts_have_the_maximum_of_the_binomial_likelihood(levels: np.ndarray, counts: np.ndarray, total: int) -> None:
    """Equation 11 of Baker (2015), maximised in median and dispersion by a program that knows no probit."""
    fit = fit_counts(levels, counts, total, resamples=0)

    def loss(p: np.ndarray) -> float:
        if p[1] <= 0.0:
            return np.inf
        return -float(binom.logpmf(counts, total, norm.cdf((np.log(levels) - p[0]) / p[1])).sum())

    median, dispersion = maximised(loss, (0.1, 0.4))
    # A simplex finds a flat maximum to the root of the rounding of the loss.
    assert fit.median == pytest.approx(median, rel=1e-6)
    assert fit.dispersion == pytest.approx(dispersion, rel=1e-6)
    assert fit.kind == "fitted"


def test_baker_example_by_a_probit_regression_made_by_hand() -> None:
    """Fisher scoring on a + b ln(x), as textbooks have it: McCullagh and Nelder (1989), section 4.4."""
    x, design = np.log(LEVELS), np.column_stack([np.ones(8), np.log(LEVELS)])
    ab = np.array([0.0, 1.0])
    for _ in range(100):
        eta = ab[0] + ab[1] * x
        p, slope = norm.cdf(eta), norm.pdf(eta)
        weight = 40.0 * slope**2 / (p * (1.0 - p))
        working = eta + (COLLAPSES / 40.0 - p) / slope
        ab = np.linalg.solve(design.T @ (design * weight[:, None]), design.T @ (weight * working))
    fit = fit_counts(LEVELS, COLLAPSES, 40)
    assert fit.median == pytest.approx(float(np.exp(-ab[0] / ab[1])), rel=1e-9)
    assert fit.dispersion == pytest.approx(1.0 / float(ab[1]), rel=1e-9)
    assert (round(fit.median, 3), round(fit.dispersion, 3)) == (1.076, 0.429)
    assert (fit.runs, fit.exceeding, fit.lowest, fit.highest) == (320, 51, 0.2, 1.0)
    assert fit.median_interval is not None
    assert fit.median_interval[0] < fit.median < fit.median_interval[1]


@pytest.mark.parametrize(
    ("exceeding", "total", "drawn"),
    [([1, 5, 9], 10, True), ([1, 5, 8.5], 10, False), ([1, 5, 9], [10, 10, 10.5], False), ([0, 3, 7], 10, True)],
)
def test_counts_that_are_whole_have_an_interval(
    exceeding: list[float], total: float | list[float], drawn: bool
) -> None:
    """All of them must be whole to draw other counts of as many runs."""
    fit = fit_counts([0.2, 0.4, 0.8], exceeding, total, resamples=50)
    assert (fit.median_interval is not None) is drawn
    assert fit_counts([0.2, 0.4, 0.8], exceeding, total, resamples=0).median == fit.median


def test_two_levels_are_met_exactly() -> None:
    """By hand: shares of 16 and 84 % a factor e apart are one deviation from the median, sqrt(e): dispersion 1/2."""
    share = float(norm.cdf(-1.0))
    fit = fit_counts([1.0, np.e], [1e6 * share, 1e6 * (1.0 - share)], 1e6)
    assert fit.median == pytest.approx(np.exp(0.5), rel=1e-9)
    assert fit.dispersion == pytest.approx(0.5, rel=1e-9)
    assert fit.median_interval is None  # of what are no counts, nothing is drawn
    np.testing.assert_allclose(fit.probability([1.0, np.e]), [share, 1.0 - share], rtol=1e-9)
    assert fit.quantile(share) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize(
    ("exceeded", "kind", "median", "probabilities"),
    [
        ([0, 0, 0], "never", np.inf, [0.0, 0.0, np.nan]),
        ([9, 9, 9], "always", 0.0, [np.nan, 1.0, 1.0]),
        ([0, 0, 9], "step", np.sqrt(6.0), [0.0, 0.0, 1.0]),
        ([0, 4, 9], "step", 2.0, [0.0, 0.0, 1.0]),
        ([9, 4, 0], "falling", np.nan, [np.nan, np.nan, np.nan]),
        ([3, 3, 3], "falling", np.nan, [np.nan, np.nan, np.nan]),
    ],
)
def test_counts_without_a_maximum_say_so(
    exceeded: list[int], kind: str, median: float, probabilities: list[float]
) -> None:
    """Never, always, parted by an intensity, parted but for one level, falling, and level."""
    fit = fit_counts([1.0, 2.0, 3.0], exceeded, 9)
    assert fit.kind == kind
    assert fit.median == pytest.approx(median, nan_ok=True)
    assert len(fit.remarks) == 1
    np.testing.assert_array_equal(fit.probability([0.9, 2.0 if kind != "step" else 1.9, 3.1]), probabilities)
    assert fit_counts([1.0], [4], 9).kind == "none"
    assert fit_counts([1.0, 2.0], [0, 0], [0, 0]).kind == "none"


def test_levels_without_runs_change_nothing() -> None:
    with_empty = fit_counts([*LEVELS, 5.0], [*COLLAPSES, 0], [*[40] * 8, 0])
    plain = fit_counts(LEVELS, COLLAPSES, 40)
    assert with_empty.median == pytest.approx(plain.median, rel=1e-12)
    assert with_empty.highest == 1.0


def test_capacities_have_the_moments_of_their_logarithms() -> None:
    """By hand: ln 1/2, 0, ln 2 have mean 0 and, with divisor n, deviation ln 2 sqrt(2/3)."""
    fit = fit_capacities([0.5, 1.0, 2.0])
    assert fit.median == pytest.approx(1.0, rel=1e-12)
    assert fit.dispersion == pytest.approx(np.log(2.0) * np.sqrt(2.0 / 3.0), rel=1e-12)
    assert fit_capacities([0.7]).kind == "step"
    assert fit_capacities([0.7]).median == pytest.approx(0.7)
    assert fit_capacities([0.7, 0.7, 0.7]).dispersion == 0.0


def test_censored_capacities_have_the_maximum_of_their_likelihood() -> None:
    """Truncated incremental dynamic analysis: densities of what is seen, survival of the rest, by a simplex."""
    capacities = np.array([0.5, 0.8, 1.0, 1.3, np.inf, np.inf, np.inf])
    ceiling = np.array([2.0, 2.0, 2.0, 2.0, 1.5, 1.5, 1.2])
    fit = fit_capacities(capacities, ceiling)

    def loss(p: np.ndarray) -> float:
        if p[1] <= 0.0:
            return np.inf
        seen = norm.logpdf(np.log(capacities[:4]), p[0], p[1]).sum()
        return -float(seen + norm.logsf(np.log(ceiling[4:]), p[0], p[1]).sum())

    median, dispersion = maximised(loss, (0.0, 0.5))
    assert fit.median == pytest.approx(median, rel=1e-6)
    assert fit.dispersion == pytest.approx(dispersion, rel=1e-6)
    assert fit.exceeding == 4
    # A capacity above its ceiling counts as larger than it, as an infinite one.
    assert fit_capacities([0.5, 0.8, 1.0, 1.3, 9.0, 9.0, 9.0], ceiling).median == fit.median
    assert fit_capacities([np.inf, np.inf], 2.0).kind == "never"


def test_baker_example_of_truncated_incremental_dynamic_analysis() -> None:
    """Equation 7 of Baker (2015), motions being scaled up to 1.3; without that the moments of equations 2 and 3."""
    whole, truncated = fit_capacities(CAPACITIES), fit_capacities(CAPACITIES, 1.3)
    log = np.log(CAPACITIES)
    assert whole.median == pytest.approx(np.exp(log.mean()), rel=1e-12)
    # Equation 3 has divisor n - 1, the maximum of the likelihood n.
    assert whole.dispersion == pytest.approx(log.std(ddof=1) * np.sqrt(36.0 / 37.0), rel=1e-12)
    assert fit_capacities(CAPACITIES, 4.0).median == pytest.approx(whole.median, rel=1e-12)
    seen = log[CAPACITIES <= 1.3]

    def loss(p: np.ndarray) -> float:
        if p[1] <= 0.0:
            return np.inf
        above = (len(log) - len(seen)) * norm.logsf(np.log(1.3), p[0], p[1])
        return -float(norm.logpdf(seen, p[0], p[1]).sum() + above)

    median, dispersion = maximised(loss, (-0.2, 0.4))
    assert truncated.median == pytest.approx(median, rel=1e-6)
    assert truncated.dispersion == pytest.approx(dispersion, rel=1e-6)
    assert (truncated.runs, truncated.exceeding) == (37, 25)
    rounded = [round(value, 3) for fit in (whole, truncated) for value in (fit.median, fit.dispersion)]
    assert rounded == [1.069, 0.403, 1.058, 0.382]  # as the page has them


def test_cloud_is_the_line_through_the_logarithms() -> None:
    """A line by numpy.polyfit; its residuals with divisor n - 2."""
    generator = np.random.default_rng(5)
    x = np.exp(generator.normal(-1.0, 0.6, 40))
    y = 0.03 * x**1.2 * np.exp(0.35 * generator.normal(size=40))
    fit = fit_cloud(x, y, 0.02)
    slope, intercept = np.polyfit(np.log(x), np.log(y), 1)
    scatter = np.sqrt(np.sum((np.log(y) - intercept - slope * np.log(x)) ** 2) / 38.0)
    assert fit.median == pytest.approx(np.exp((np.log(0.02) - intercept) / slope), rel=1e-9)
    assert fit.dispersion == pytest.approx(scatter / slope, rel=1e-9)
    assert fit.exceeding == int((y > 0.02).sum())
    assert fit_cloud(x, y, 0.02).median_interval == fit.median_interval  # the seed is fixed


def test_cloud_with_collapse_adds_a_logistic_curve() -> None:
    """The logistic regression has zero score; the curve is that of Jalayer et al. (2017): P_nc (1 - P_c) + P_c."""
    generator = np.random.default_rng(7)
    x = np.exp(generator.normal(-0.5, 0.7, 200))
    falls = generator.random(200) < 1.0 / (1.0 + np.exp(-(np.log(x) - np.log(1.5)) / 0.3))
    y = np.where(falls, np.inf, 0.02 * x * np.exp(0.3 * generator.normal(size=200)))
    fit = fit_cloud(x, y, 0.02, resamples=200)
    _, _, centre, width = fit.curve
    p = 1.0 / (1.0 + np.exp(-(np.log(x) - np.log(centre)) / width))
    assert abs(np.sum(falls - p)) < 1e-7
    assert abs(np.sum((falls - p) * np.log(x))) < 1e-7
    without = fit_cloud(x[~falls], y[~falls], 0.02, resamples=0)
    at = np.array([0.3, 0.8, 1.4, 2.5])
    logistic = 1.0 / (1.0 + np.exp(-(np.log(at) - np.log(centre)) / width))
    expected = without.probability(at) * (1.0 - logistic) + logistic
    np.testing.assert_allclose(fit.probability(at), expected, rtol=1e-12)
    assert fit.probability(fit.median) == pytest.approx(0.5, rel=1e-12)
    low, high = fit.quantile(float(norm.cdf(-1.0))), fit.quantile(float(norm.cdf(1.0)))
    assert fit.dispersion == pytest.approx(0.5 * np.log(high / low), rel=1e-12)


def test_clouds_without_a_curve_say_so() -> None:
    assert fit_cloud([1.0, 2.0], [0.1, 0.2], 0.1).kind == "none"
    assert fit_cloud([1.0, 2.0, 3.0], [0.3, 0.2, 0.1], 0.1).kind == "falling"
    assert fit_cloud([1.0, 2.0, 3.0], [0.0, 0.0, 0.0], 0.1).kind == "never"
    assert fit_cloud([1.0, 2.0, 3.0], [np.inf] * 3, 0.1).kind == "always"
    some = fit_cloud([1.0, 2.0, 3.0, 4.0], [0.0, 0.1, 0.2, 0.25], 0.1)
    assert some.kind == "fitted"
    assert "1 run of 4 without any demand" in some.remarks[-1]
    parted = fit_cloud([1.0, 2.0, 3.0, 4.0], [0.1, 0.2, 0.29, np.inf], 1.0, resamples=0)
    assert "all runs above intensity 3.46 collapse" in parted.remarks[-1]
    assert parted.probability([3.4, 3.5])[1] == 1.0


def test_bootstrap_intervals_cover_the_truth_about_as_often_as_they_say() -> None:
    """200 samples of 40 capacities of a known lognormal: a 90 % interval of the median holds it in 83 to 96 %.

    Binomial scatter of 200 draws is 2 %; percentile intervals of 40 are a little narrow.
    """
    generator = np.random.default_rng(11)
    inside = 0
    for _ in range(200):
        fit = fit_capacities(np.exp(0.4 * generator.normal(size=40)), resamples=400)
        assert fit.median_interval is not None
        inside += fit.median_interval[0] <= 1.0 <= fit.median_interval[1]
    assert 0.83 <= inside / 200.0 <= 0.96


def test_bands_hold_the_curve_and_grow_with_confidence() -> None:
    at = np.linspace(0.3, 2.0, 9)
    narrow, wide = (fit_counts(LEVELS, COLLAPSES, 40, confidence=share) for share in (0.5, 0.95))
    low, high = wide.band(at)
    assert (low <= wide.probability(at)).all()
    assert (wide.probability(at) <= high).all()
    inner = narrow.band(at)
    assert (low <= inner[0]).all()
    assert (inner[1] <= high).all()
    without = fit_counts(LEVELS, COLLAPSES, 40, resamples=0).band(at)
    assert np.isnan(without).all()


def test_what_no_fit_can_take_is_refused() -> None:
    for arguments, message in (
        (([1.0, 2.0], [1], 3), "exceeding and total of fragility fit must be lists of 2 values; got 1 and 2"),
        (([0.0, 2.0], [1, 1], 3), "intensity of fragility fit must be positive and finite; got"),
        (([1.0, 2.0], [1, 4], 3), "exceeding of fragility fit must be from 0 to total; got"),
        (([], [], []), "intensity of fragility fit must be at least one; got none"),
    ):
        with pytest.raises(sm.errors.InvalidOption, match=message):
            fit_counts(*arguments)
    with pytest.raises(sm.errors.InvalidOption, match="censored_above of fragility fit must be given where"):
        fit_capacities([1.0, np.inf])
    with pytest.raises(sm.errors.InvalidOption, match="capacities of fragility fit must be positive; got 0"):
        fit_capacities([0.0])
    with pytest.raises(sm.errors.InvalidOption, match="confidence of fragility fit must be above 0 and below 1; got 1"):
        fit_capacities([1.0], confidence=1.0)
    with pytest.raises(sm.errors.InvalidOption, match="demand of cloud fit must be zero or positive, and finite"):
        fit_cloud([1.0, 2.0], [0.1, -0.1], 0.1)
    with pytest.raises(sm.errors.InvalidOption, match="probability of fragility must be between 0 and 1; got 0"):
        fit_capacities([0.5, 1.0]).quantile(0.0)
    with pytest.raises(sm.errors.InvalidOption, match="intensity of fragility must be zero or positive; got"):
        fit_capacities([0.5, 1.0]).probability(-1.0)


def test_an_extrapolated_median_is_remarked() -> None:
    """In the example of Baker fewer than half of the motions collapse at the highest intensity."""
    fit = fit_counts(LEVELS, COLLAPSES, 40)
    assert fit.remarks == ("the median is extrapolated: intensities were from 0.2 to 1",)
    assert fit_counts(DAHAL_LEVELS, DAHAL_COLLAPSES, 45).remarks == ()


@pytest.mark.parametrize(
    "levels", [[0.2, 0.4, 0.6, 0.8], [0.1, 0.2, 0.3], [0.15, 0.25], [0.1, 0.17, 0.31, 0.44, 0.56, 0.77]]
)
@pytest.mark.parametrize("runs", [7, 11, 20, 44])
def test_equal_counts_have_no_curve(levels: list[float], runs: int) -> None:
    """The maximum is at slope zero, where no lognormal curve is: rounding must not decide the sign of the slope."""
    for exceeding in range(1, runs):
        fit = fit_counts(levels, [exceeding] * len(levels), runs, resamples=20)
        assert fit.kind == "falling", exceeding
        assert np.isnan(fit.median)


def test_data_of_one_intensity_have_no_curve() -> None:
    assert fit_counts([0.2, 0.2, 0.2], [1, 2, 3], 20).kind == "none"
    assert fit_counts([0.2, 0.2, 0.2], [0, 0, 0], 20).kind == "never"
    assert fit_cloud([0.2, 0.2, 0.2, 0.2], [0.01, 0.02, 0.03, 0.02], 0.02).kind == "none"


def test_a_cloud_of_equal_demands_has_no_curve() -> None:
    """The slope of the regression is zero but for rounding."""
    fit = fit_cloud([0.1, 0.17, 0.31, 0.44, 0.56, 0.77], [0.011] * 6, 0.02)
    assert fit.kind == "falling"
    assert np.isnan(fit.median)


def test_capacities_that_are_equal_but_for_rounding_are_a_step() -> None:
    fit = fit_capacities([0.3, 0.1 + 0.2, 0.3])
    assert (fit.kind, fit.dispersion) == ("step", 0.0)


def test_a_step_is_reached_at_its_own_intensity() -> None:
    """A motion exceeds its limit from its capacity on, as annual rates have it: the share of capacities at most x."""
    capacity, at = 0.37, np.array([0.0, 0.36, 0.37, 0.38])
    lognormal, logistic = [capacity, 0.0, np.inf, 0.0], [np.inf, 0.0, capacity, 0.0]
    assert probabilities(np.array([lognormal, logistic]), at).tolist() == [[0.0, 0.0, 1.0, 1.0]] * 2
    # P_l + P_c (1 - P_l) of a lognormal part at its median and a step of collapse there.
    both = np.array([[capacity, 0.4, capacity, 0.0], [capacity, 0.4, np.inf, 0.0]])
    assert probabilities(both, np.array([capacity])).ravel().tolist() == [1.0, 0.5]


def test_levels_without_scatter_have_no_interval() -> None:
    """One run at each level exceeds or does not: drawing it again gives the same."""
    fit = fit_counts([0.2, 0.3, 0.4, 0.5, 0.6], [0, 1, 0, 1, 1], 1)
    assert fit.kind == "fitted"
    assert fit.median_interval is None
    assert fit_counts([0.2, 0.3, 0.4, 0.5], [0, 3, 2, 5], 5).median_interval is not None


def test_limits_may_be_names_as_in_commands() -> None:
    scene = sm.Scene(sm.Building.uniform(2, 0.3, heights=3.0, yield_shear_over_weight=[0.2, 0.12]))
    names, motions = ["drift_ratio=0.01", "drift@2=0.05"], sm.builtin_suite("seven")[:2]
    limits = [sm.fragility.parse_limit(name) for name in names]
    by_name, by_object = (
        sm.fragility.incremental_dynamic_analysis(scene, motions, each, measure="pga") for each in (names, limits)
    )
    assert by_name.limits == by_object.limits == tuple(limits)
    assert by_name.fragility().median == by_object.fragility().median


@pytest.mark.parametrize("spread", [0.02, 0.4, 3.0])
def test_no_neighbour_of_a_fit_is_more_likely(spread: float) -> None:
    """Many samples at once, of weights of their own: counts, capacities up to a ceiling, and a logistic curve."""
    generator = np.random.default_rng(3)
    log = spread * generator.normal(size=25)
    total, weight = (generator.integers(*bounds, (8, 25)).astype(float) for bounds in ((5, 12), (0, 4)))
    hits = generator.binomial(total.astype(int), norm.cdf(log / (0.7 * spread))).astype(float)
    seen, occurred = log < 0.5 * spread, generator.random(25) < expit(log / (0.3 * spread))
    capacity = np.minimum(log, 0.5 * spread)

    def of_counts(row: int, centre: float, width: float) -> float:
        z = (log - centre) / width
        return float(hits[row] @ norm.logcdf(z) + (total[row] - hits[row]) @ norm.logsf(z))

    def of_capacities(row: int, centre: float, width: float) -> float:
        whole, above = norm.logpdf(capacity, centre, width), norm.logsf(capacity, centre, width)
        return float(weight[row] @ np.where(seen, whole, above))

    def of_events(row: int, centre: float, width: float) -> float:
        return float(weight[row] @ log_expit(np.where(occurred, 1.0, -1.0) * (log - centre) / width))

    counted, capped = probit_fits(np.exp(log), hits, total), capacity_fits(np.exp(capacity), seen, weight)
    happened = logistic_fits(log, occurred, weight)
    for likelihood, centres, fits in (
        (of_counts, np.log(counted.median), counted),
        (of_capacities, np.log(capped.median), capped),
        (of_events, happened.median, happened),
    ):
        assert (fits.kind == FITTED).all()
        for row, (centre, width) in enumerate(zip(centres, fits.dispersion, strict=True)):
            step = 1e-4 * width
            most = likelihood(row, centre, width)
            for along, across in ((step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)):
                assert likelihood(row, centre + along, width + across) < most


def test_a_cloud_of_weights_is_the_line_of_its_runs_repeated() -> None:
    """A run of weight 3 stands for three, and one of weight 0 for none; lines by numpy.polyfit."""
    generator = np.random.default_rng(9)
    x, falls = np.exp(generator.normal(-0.5, 0.7, 30)), np.zeros(30, dtype=bool)
    y = 0.03 * x**1.2 * np.exp(0.35 * generator.normal(size=30))
    weight = generator.integers(0, 4, (6, 30))
    curves, kind = cloud_fits(x, y, falls, 0.02, weight.astype(float))
    assert (kind == FITTED).all()
    for row, times in zip(curves, weight, strict=True):
        log, demand = np.log(x).repeat(times), np.log(y).repeat(times)
        slope, intercept = np.polyfit(log, demand, 1)
        scatter = np.sqrt(np.sum((demand - intercept - slope * log) ** 2) / (times.sum() - 2))
        assert row[0] == pytest.approx(np.exp((np.log(0.02) - intercept) / slope), rel=1e-9)
        assert row[1] == pytest.approx(scatter / slope, rel=1e-9)
