"""Tables and numbers in plain text, and quantiles of rows with infinities."""

from __future__ import annotations

import numpy as np
import pytest

from seismass.base.statistics import quantile
from seismass.media.text_table import (
    change_text,
    ends_text,
    interval_text,
    number_text,
    numbers_text,
    text_line,
    text_table,
)


def test_columns_are_as_wide_as_their_widest_cell() -> None:
    rows = [["storey", "drift"], ["1", "10.25"], ["2", ""]]
    assert text_table(rows) == ["  storey  drift", "  1       10.25", "  2"]
    assert text_table(rows, left=2, indent=0) == ["storey  drift", "1       10.25", "2"]
    assert text_table(rows, left=0) == ["  storey  drift", "       1  10.25", "       2"]


def test_a_wide_cell_is_not_cut() -> None:
    assert text_line(["overturning", "1"], (-4, 3), indent=0) == "overturning  1"
    with pytest.raises(ValueError, match="shorter"):
        text_line(["a", "b"], (3,))


def test_numbers_that_are_missing_or_infinite_have_words() -> None:
    assert number_text(0.0123, ".1f", scale=1e3) == "12.3"
    assert number_text(None) == "-"
    assert number_text(None, missing="unknown") == "unknown"
    assert number_text(np.inf, infinite="none") == "none"
    assert number_text(np.inf) == "inf"
    assert ends_text(0.1, None) == ""
    assert ends_text(0.1, np.inf, infinite="none") == " [0.10, none]"
    assert interval_text(0.27, 0.21, 0.34) == "0.27 [0.21, 0.34]"
    assert interval_text(0.27, None, None) == "0.27"
    assert interval_text(None, 0.21, 0.34) == "-"
    assert [change_text(value) for value in (12.4, -0.2, 0.3, None)] == ["+12 %", "0 %", "0 %", "-"]
    assert numbers_text([0.25, 0.25]) == "0.25"
    assert numbers_text([0.25, 0.12345]) == "0.25 0.1235"


def test_quantiles_are_those_of_numpy_where_all_is_finite() -> None:
    values = np.random.default_rng(1).lognormal(size=(40, 7))
    for share in (0.0, 0.16, 0.5, 0.84, 1.0):
        np.testing.assert_allclose(quantile(values, share), np.quantile(values, share, axis=1), rtol=1e-15)


def test_an_infinite_value_is_larger_than_all_others() -> None:
    """By hand: of 1, 2, 3 and infinity the median lies between 2 and 3, the 84 % quantile between 3 and infinity."""
    row = np.array([[3.0, np.inf, 1.0, 2.0], [1.0, np.nan, 2.0, 3.0]])
    assert quantile(row, 0.5)[0] == 2.5
    assert quantile(row, 0.84)[0] == np.inf
    assert quantile(row, 2.0 / 3.0)[0] == 3.0
    assert np.isnan(quantile(row, 0.5)[1])
