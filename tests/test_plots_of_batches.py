"""Figures of many runs: what they draw is what the table holds."""

from __future__ import annotations

import numpy as np
import polars as pl
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.stats import norm

import seismass as sm


@pytest.fixture(scope="module")
def runs() -> tuple[pl.DataFrame, pl.DataFrame]:
    """Rows of a batch and of its long table: one building, four intensities, seven motions, some collapsed."""
    building = sm.Building.uniform(
        3, 0.6, mass=2e4, yield_shear_over_weight=[0.24, 0.20, 0.12], heights=[3.9, 3.5, 2.9], gravity_load=2e5
    )
    grid = sm.Grid.product(building, roof="bare", mass_ratio=[1.0], mu=[0.2], scale=[0.5, 1.0, 2.0, 3.0])
    table = sm.simulate_many(grid, sm.builtin_suite("seven"))
    assert set(table["status"]) == {"completed", "collapsed"}
    return table, sm.long_table(table, grid)


def of(axes: Axes, gid: str) -> list[np.ndarray]:
    return [np.column_stack(line.get_data()) for line in axes.lines if line.get_gid() == gid]


def test_ida_has_a_curve_per_motion_and_fractiles(runs: tuple[pl.DataFrame, pl.DataFrame]) -> None:
    table, long = runs
    axes = sm.plots.ida(long, limit=2.0).axes[0]
    curves = of(axes, "motion")
    assert len(curves) == 7
    largest = np.array([max(row) for row in table["peak_drift_ratio"]]).reshape(4, 7)
    fell = (table["status"] == "collapsed").to_numpy().reshape(4, 7)
    expected = 100.0 * np.where(fell, np.inf, largest)
    for motion, curve in enumerate(curves):
        np.testing.assert_array_equal(curve[1:, 0], expected[:, motion])
        np.testing.assert_array_equal(curve[:, 1], [0.0, 0.5, 1.0, 2.0, 3.0])
    # The median of seven is the fourth, a collapse being larger than all.
    np.testing.assert_array_equal(of(axes, "median")[0][1:, 0], np.sort(expected, axis=1)[:, 3])
    # 16 % of six intervals lie 0.96 from the first.
    ordered = np.sort(expected, axis=1)
    np.testing.assert_allclose(of(axes, "16 %")[0][1:, 0], 0.04 * ordered[:, 0] + 0.96 * ordered[:, 1], rtol=1e-12)
    assert axes.get_xlabel() == "peak drift / height (%)"
    same = Figure().add_subplot()
    assert sm.plots.ida(long, ax=same) is same.figure


def test_fragility_shares_and_curve(runs: tuple[pl.DataFrame, pl.DataFrame]) -> None:
    _, long = runs
    axes = sm.plots.fragility(long, 0.02).axes[0]
    fell = (pl.col("status") == "collapsed").any()
    worst = long.group_by("scale", "motion").agg(over=(pl.col("peak_drift_ratio").max() > 0.02) | fell)
    shares = worst.group_by("scale").agg(pl.col("over").mean()).sort("scale")
    np.testing.assert_array_equal(of(axes, "shares")[0], shares.to_numpy())
    assert axes.get_ylabel() == "probability that peak drift / height > 2 %"


def test_fragility_fit_is_the_maximum_of_the_likelihood() -> None:
    """Its gradient vanishes: the score of a probit in a + b ln(x) at the estimate, by central differences."""
    x, k, n = np.array([0.2, 0.4, 0.6, 0.8, 1.2]), np.array([0, 3, 8, 15, 19]), np.full(5, 20)
    fit = sm.plots.fragility_fit(x, k, n)
    assert fit is not None

    def likelihood(median: float, beta: float) -> float:
        p = norm.cdf(np.log(x / median) / beta)
        return float(np.sum(k * np.log(p) + (n - k) * np.log1p(-p)))

    median, beta = fit
    best = likelihood(median, beta)
    for step in (1e-3, -1e-3):
        # Quadratic at the maximum: a relative step of 1e-3 lowers it by the order of n 1e-6, not of n 1e-3.
        for other in (likelihood(median * (1.0 + step), beta), likelihood(median, beta * (1.0 + step))):
            assert 0.0 < best - other < 1e-3
    # Many motions with the exact shares of a lognormal of median 0.7 and dispersion 0.4 give it back.
    exact = 1e6 * norm.cdf(np.log(x / 0.7) / 0.4)
    assert sm.plots.fragility_fit(x, exact, np.full(5, 1e6)) == pytest.approx((0.7, 0.4), rel=1e-5)


@pytest.mark.parametrize("exceeded", [[0, 0, 0], [9, 9, 9], [0, 0, 9], [0, 4, 9], [9, 4, 0]])
def test_fragility_fit_is_none_where_the_likelihood_has_no_maximum(exceeded: list[int]) -> None:
    """Never, always, parted by an intensity, parted but for one level (the dispersion tends to 0), and falling."""
    assert sm.plots.fragility_fit([1.0, 2.0, 3.0], exceeded, [9, 9, 9]) is None


def test_scatter_has_the_rows_by_column(runs: tuple[pl.DataFrame, pl.DataFrame]) -> None:
    table, long = runs
    axes = sm.plots.scatter(long, "scale", "peak_slip", by="storey").axes[0]
    points = of(axes, "points")
    assert len(points) == 2  # the roof has no block
    for storey, drawn in enumerate(points, start=1):
        rows = long.filter(storey=storey)
        np.testing.assert_array_equal(drawn[:, 0], rows["scale"])
        np.testing.assert_array_equal(drawn[:, 1], 1e3 * rows["peak_slip"].to_numpy())
    assert len(of(axes, "collapse")[0]) == long.filter(pl.col("status") == "collapsed", pl.col("storey") < 3).height
    lists = sm.plots.scatter(table, "peak_base_shear", "peak_drift").axes[0]
    np.testing.assert_array_equal(of(lists, "points")[0][:, 1], [1e3 * max(row) for row in table["peak_drift"]])
    with pytest.raises(
        sm.errors.InvalidOption, match="by of scatter figure must be a column of at most 7 values; got 28"
    ):
        sm.plots.scatter(table.with_row_index("row"), "peak_base_shear", "peak_drift", by="row")
    with pytest.raises(sm.errors.InvalidOption, match="column of scatter figure must be one of scene, motion"):
        sm.plots.scatter(table, "speed", "peak_drift")


def test_drift_profiles_have_runs_and_fractiles(runs: tuple[pl.DataFrame, pl.DataFrame]) -> None:
    table, long = runs
    one = table.filter(scene=2)
    figure = sm.plots.drift_profiles(one)
    values = 1e3 * np.array(one["peak_drift"].to_list())
    for run, drawn in zip(values, of(figure.axes[0], "run"), strict=True):
        np.testing.assert_array_equal(drawn, np.column_stack([run, [1, 2, 3]]))
    np.testing.assert_array_equal(of(figure.axes[0], "median")[0][:, 0], np.median(values, axis=0))
    other = sm.plots.drift_profiles(long.filter(scene=2))
    np.testing.assert_array_equal(of(other.axes[0], "84 %")[0], of(figure.axes[0], "84 %")[0])
    with pytest.raises(
        sm.errors.InvalidOption, match=r"table of drift profiles must be runs of buildings with equally many"
    ):
        sm.plots.drift_profiles(one.with_columns(peak_drift=pl.col("peak_drift").list.head(pl.col("motion"))))


def test_profiles_count_a_collapse_as_larger_than_all(runs: tuple[pl.DataFrame, pl.DataFrame]) -> None:
    """Of seven runs the median is the fourth; 84 % lies between the sixth and the seventh, of which one fell."""
    table, long = runs
    for rows in (table.filter(scene=4), long.filter(scene=4)):
        axes = sm.plots.drift_profiles(rows).axes[0]
        listed = table.filter(scene=4)
        fell = (listed["status"] == "collapsed").to_numpy()
        assert 0 < fell.sum() < 4
        values = 1e3 * np.array(listed["peak_drift"].to_list())
        ordered = np.sort(np.where(fell[:, None], np.inf, values), axis=0)
        np.testing.assert_array_equal(of(axes, "median")[0][:, 0], ordered[3])
        assert np.isinf(of(axes, "84 %")[0][:, 0]).all()
        np.testing.assert_allclose(of(axes, "16 %")[0][:, 0], 0.04 * ordered[0] + 0.96 * ordered[1], rtol=1e-12)
        # Each run is drawn to where it came.
        for run, drawn in zip(values, of(axes, "run"), strict=True):
            np.testing.assert_array_equal(drawn[:, 0], run)


def test_figures_of_batches_refuse_what_they_cannot_draw(runs: tuple[pl.DataFrame, pl.DataFrame]) -> None:
    _, long = runs
    with pytest.raises(
        sm.errors.InvalidOption, match=r"table of IDA figure must be a polars\.DataFrame of runs; got None"
    ):
        sm.plots.ida(None)  # type: ignore[arg-type]
    with pytest.raises(
        sm.errors.InvalidOption, match="table of IDA figure must be one with every motion at every intensity"
    ):
        sm.plots.ida(long.filter((pl.col("scale") < 1.0) | (pl.col("motion") > 2)))
    failed = long.with_columns(status=pl.lit("failed"))
    with pytest.raises(sm.errors.InvalidOption, match="table of fragility must be one with runs that did not fail"):
        sm.plots.fragility(failed, 0.02)
