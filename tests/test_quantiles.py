"""Quantiles of rows that may hold infinity: NumPy's where all is finite, infinite beside an infinite value."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import seismass
from seismass.base.statistics import QUANTILES, interval_of, quantile, statistics_of

ROWS = np.random.default_rng(7).lognormal(size=(4, 11))


@pytest.mark.parametrize("share", [0.0, 0.16, 0.37, 0.5, 0.84, 1.0])
def test_finite_rows_have_the_linear_quantile_of_numpy(share: float) -> None:
    np.testing.assert_allclose(quantile(ROWS, share), np.quantile(ROWS, share, axis=1), rtol=1e-14)


def test_a_quantile_beside_an_infinite_value_is_infinite_and_one_below_is_not() -> None:
    """Places of five values, from 0: 0.25 lies at 1, 0.5 at 2, 0.6 between 2 and 3; 3 and 4 are infinite."""
    row = np.array([[3.0, np.inf, 1.0, np.inf, 2.0]])
    assert [quantile(row, share)[0] for share in (0.25, 0.375, 0.5, 0.6, 0.75, 0.9)] == [2.0, 2.5, 3.0, *[np.inf] * 3]
    assert np.isnan(quantile(np.array([[1.0, np.nan, 2.0]]), 0.5)).all()


@pytest.mark.parametrize("confidence", [0.5, 0.73, 0.9])
def test_an_interval_leaves_out_nan_and_is_that_of_numpy(confidence: float) -> None:
    """Each tail has half of what the confidence leaves."""
    values = ROWS.T.copy()
    values[3, 1] = values[5, 1] = values[0, 2] = np.nan
    low, high = interval_of(values, confidence)
    expected = np.nanquantile(values, [0.5 * (1.0 - confidence), 0.5 * (1.0 + confidence)], axis=0)
    np.testing.assert_allclose([low, high], expected, rtol=1e-14)


def test_an_end_of_an_interval_beside_an_infinite_value_is_infinite() -> None:
    """Of three values 25 % lies half way from the first to the second, 75 % half way from the second to the third."""
    low, high = interval_of(np.array([[np.inf, 4.0], [1.0, 1.0], [2.0, np.inf], [np.nan, 2.0]]), 0.5)
    assert low.tolist() == [1.5, 1.75]
    assert high.tolist() == [np.inf, np.inf]


def test_shares_are_those_one_standard_deviation_away() -> None:
    """0.16 and 0.84 of the normal distribution to two digits; what infinity decides is null."""
    assert QUANTILES == {"p16": 0.16, "median": 0.5, "p84": 0.84}
    known = statistics_of(np.arange(1.0, 102.0))
    assert known == pytest.approx({"mean": 51.0, "p16": 17.0, "median": 51.0, "p84": 85.0, "max": 101.0}, rel=1e-14)
    # Places 0.8, 2.5 and 4.2 of six values lie between two.
    fallen = statistics_of(np.array([5.0, 3.0, np.inf, 1.0, 4.0, 2.0]))
    assert fallen == {"mean": None, "p16": pytest.approx(1.8), "median": 3.5, "p84": None, "max": None}


def test_other_quantiles_than_these_are_taken_of_finite_values_alone() -> None:
    """Spectra over angles, ratios of fits and of factors, and drifts of a choice of statistics are never infinite."""
    package = Path(seismass.__file__).parent
    found = {
        file.relative_to(package).as_posix()
        for file in package.rglob("*.py")
        if re.search(r"np\.(nan)?(quantile|percentile|median)\b", file.read_text(encoding="utf-8"))
    }
    assert found == {
        "base/statistics.py",
        "design/pushover_fit.py",
        "design/scaling/pushover.py",
        "motions/pulses/result.py",
        "motions/records/rotd.py",
        "studies/fragility/hunt.py",
        "studies/study/sensitivity.py",
    }
