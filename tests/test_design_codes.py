"""Lateral forces, periods, system factors and limits of codes: numbers of their clauses and examples by hand."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass import design
from seismass.model.codes import FROM_MEMORY, SECOND_HAND, VERIFIED

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("code_id", design.DISTRIBUTION_CODES)
@pytest.mark.parametrize("period", [0.3, 0.9, 1.5, 4.0])
def test_forces_of_every_code_add_up_to_the_base_shear(code_id: str, period: float) -> None:
    weight, heights = np.array([3.0e6, 2.0e6, 2.5e6, 1.0e6]), np.array([4.5, 3.5, 3.5, 3.0])
    found = design.equivalent_lateral_forces(weight, heights, 1.2e6, period, code_id=code_id)
    assert found.force.sum() == pytest.approx(1.2e6, rel=1e-14)
    assert found.shear[0] == pytest.approx(1.2e6, rel=1e-14)
    # Overturning about the base is the moment of the forces about it.
    assert found.overturning[0] == pytest.approx(found.force @ np.cumsum(heights), rel=1e-13)
    assert (found.force > 0.0).all()
    assert found.table()["share"].sum() == pytest.approx(1.0, rel=1e-14)


def test_exponent_of_the_code() -> None:
    """ASCE/SEI 7-10, 12.8.3: 1 up to 0.5 s, 2 from 2.5 s, linear between: 1.25 at 1 s, 1.5 at 1.5 s."""
    assert [design.exponent_k(t) for t in (0.1, 0.5, 1.0, 1.5, 2.5, 6.0)] == [1.0, 1.0, 1.25, 1.5, 2.0, 2.0]


def test_distribution_by_hand() -> None:
    """w = 3, 2 at h = 3, 6; k = 2 from 2.5 s: shares 27 and 72 of 99; IS 1893 the same at any period; linear: 9, 12."""
    for code_id, period in (("asce7-10", 3.0), ("is1893", 0.4)):
        found = design.equivalent_lateral_forces([3.0, 2.0], 3.0, 99.0, period, code_id=code_id)
        np.testing.assert_allclose(found.force, [27.0, 72.0], rtol=1e-14)
        np.testing.assert_allclose(found.overturning, [27.0 * 3 + 72.0 * 6, 72.0 * 3], rtol=1e-14)
        np.testing.assert_allclose(found.drift([99.0, 36.0]), [1.0, 2.0], rtol=1e-14)
    linear = design.equivalent_lateral_forces([3.0, 2.0], 3.0, 21.0, 3.0, code_id="EC8")
    np.testing.assert_allclose(linear.force, [9.0, 12.0], rtol=1e-14)
    # UBC-97 at 1 s: F_t = 0.07 V; at 5 s at most 0.25 V; NZS 1170.5: 0.08 V at the top and 0.92 V by weight and height.
    top = design.equivalent_lateral_forces([3.0, 2.0], 3.0, 21.0, 1.0, code_id="ubc-97")
    np.testing.assert_allclose(top.force, [0.93 * 9.0, 0.93 * 12.0 + 0.07 * 21.0], rtol=1e-14)
    assert design.equivalent_lateral_forces([1.0], 3.0, 1.0, 5.0, code_id="nbc").top_force == 0.25
    nzs = design.equivalent_lateral_forces([3.0, 2.0], 3.0, 21.0, 1.0, code_id="nzs1170.5")
    np.testing.assert_allclose(nzs.force, [0.92 * 9.0, 0.92 * 12.0 + 0.08 * 21.0], rtol=1e-14)


def test_strengths_of_the_paper_are_a_triangle() -> None:
    """Section 4 of the paper: V_y = 0.24 W, 0.20 W, 0.12 W of three equal floors."""
    found = design.equivalent_lateral_forces([1.0, 1.0, 1.0], 3.5, 0.24 * 3.0, 0.5)
    np.testing.assert_allclose(found.shear / 3.0, [0.24, 0.20, 0.12], rtol=1e-14)


def test_response_coefficient_by_hand() -> None:
    """ASCE/SEI 7-10, 12.8-2 to 12.8-6, with S_DS = 1, S_D1 = 0.6, R = 8 and I_e = 1.25: R/I_e = 6.4."""
    c_s = design.seismic_response_coefficient
    assert c_s(1.0, 0.6, 0.3, 8.0, importance=1.25) == pytest.approx(1.0 / 6.4)
    assert c_s(1.0, 0.6, 1.2, 8.0, importance=1.25) == pytest.approx(0.6 / 1.2 / 6.4)
    assert c_s(1.0, 0.6, 4.0, 4.0, t_l=2.0) == pytest.approx(0.044)  # 0.6 x 2/16/4 = 0.019 is below 0.044 S_DS I_e
    assert c_s(1.0, 0.6, 4.0, 4.0, t_l=2.0, minimum=False) == pytest.approx(0.6 * 2.0 / 16.0 / 4.0)
    assert c_s(0.1, 0.05, 3.0, 8.0) == 0.01
    assert c_s(1.0, 0.6, 3.0, 8.0, s_1=0.7) == pytest.approx(max(0.6 / 3.0 / 8.0, 0.044, 0.5 * 0.7 / 8.0))
    # 12.8-6 holds where S_1 is equal to or greater than 0.6 g: 0.5 x 0.6/8 = 0.0375 is above 0.044 x 0.7 = 0.0308.
    assert c_s(0.7, 0.6, 4.0, 8.0, s_1=0.6) == pytest.approx(0.5 * 0.6 / 8.0, rel=1e-14)
    assert c_s(0.7, 0.6, 4.0, 8.0, s_1=0.5999) == pytest.approx(0.044 * 0.7, rel=1e-14)
    with pytest.raises(sm.errors.InvalidOption, match="period of lateral forces must be a positive number; got 0"):
        c_s(1.0, 0.6, 0.0, 8.0)


@pytest.mark.parametrize(
    ("code_id", "system", "height", "expected", "status"),
    [
        # C_t h^x of the tables named in docs/design.md, at 10 m and 20 m.
        ("asce7-10", "steel-moment-frame", 10.0, 0.0724 * 10**0.8, VERIFIED),
        ("asce7-10", "concrete-moment-frame", 20.0, 0.0466 * 20**0.9, VERIFIED),
        ("asce7-10", "other", 10.0, 0.0488 * 10**0.75, VERIFIED),
        ("asce7-22", "steel-buckling-restrained-frame", 10.0, 0.0731 * 10**0.75, FROM_MEMORY),
        ("bnbc2017", "steel-eccentrically-braced-frame", 10.0, 0.0731 * 10**0.75, VERIFIED),
        ("ec8", "concrete-moment-frame", 20.0, 0.075 * 20**0.75, FROM_MEMORY),
        ("nbc", "braced-frame", 20.0, 0.5, VERIFIED),
        ("as1170.4", "other", 16.0, 1.25 * 0.05 * 8.0, FROM_MEMORY),
    ],
)
def test_approximate_periods(code_id: str, system: str, height: float, expected: float, status: str) -> None:
    found = design.code_period(code_id, system, height=height)
    assert found.approximate == pytest.approx(expected, rel=1e-14)
    assert found.rule.status == status
    assert found.rule.clause


def test_metric_and_foot_coefficients_agree() -> None:
    """Table 12.8-2 has both: 0.028 h^0.8, 0.016 h^0.9, 0.03 h^0.75 and 0.02 h^0.75 in feet."""
    feet = {"steel-moment-frame": (0.028, 0.8), "concrete-moment-frame": (0.016, 0.9)}
    feet |= {"steel-eccentrically-braced-frame": (0.03, 0.75), "other": (0.02, 0.75)}
    for system, (c_t, x) in feet.items():
        found = design.code_period("asce7-10", system, height=30.48)
        assert found.approximate == pytest.approx(c_t * 100.0**x, rel=1e-3)  # metric values have three digits


def test_upper_limit_of_calculated_periods() -> None:
    """ASCE/SEI 7-10, table 12.8-1, linear between its rows."""
    points = {0.05: 1.7, 0.1: 1.7, 0.125: 1.65, 0.15: 1.6, 0.2: 1.5, 0.25: 1.45, 0.3: 1.4, 0.4: 1.4, 1.0: 1.4}
    for s_d1, expected in points.items():
        assert design.upper_limit_coefficient(s_d1) == pytest.approx(expected, rel=1e-14)
    found = design.code_period("asce7-22", "moment-frame-by-storeys", storeys=4, s_d1=0.2)
    assert (found.approximate, found.upper_factor, found.upper_status) == (0.4, 1.5, SECOND_HAND)
    assert found.limit == pytest.approx(0.6)
    assert [found.design_period(t) for t in (None, 0.5, 0.9)] == pytest.approx([0.4, 0.5, 0.6])
    unlimited = design.code_period("ec8", "other", height=10.0)
    assert unlimited.upper_factor is None
    assert unlimited.design_period(9.0) == 9.0
    assert design.code_period("nbc", "shear-wall", height=10.0).upper_factor == 2.0


def test_system_factors_of_well_known_lines() -> None:
    """ASCE/SEI 7-10, table 12.2-1."""
    lines = {"C1": (8, 3, 5.5), "c7": (3, 3, 2.5), "B2": (6, 2, 5), "A8": (3.5, 2.5, 2.25), "D7": (7.5, 2.5, 6)}
    lines |= {"F": (4.5, 2.5, 4), "G5": (1, 1.25, 1), "H": (3, 3, 3), "E3": (3, 3, 2.5)}
    for line, numbers in lines.items():
        row = design.system_factors(line)
        assert (row.R, row.omega_0, row.C_d) == numbers
        assert row.status == VERIFIED
    table = design.system_table()
    groups = table["system_id"].str.head(1).value_counts().sort("system_id")["count"].to_list()
    assert groups == [18, 26, 12, 13, 8, 1, 6, 1]  # lines of groups A to H
    assert table["omega_0"].is_between(1.25, 3.0).all()
    with pytest.raises(sm.errors.InvalidOption, match=r"id of system must be one of a1, .*; got 'Z9'"):
        design.system_factors("Z9")


def test_importance_and_drift_limits_by_risk_category() -> None:
    """ASCE/SEI 7-10, tables 1.5-2 and 12.12-1; Eurocode 8, 4.4.3.2: 0.005/0.5; NBC 4.1.8.13."""
    assert [design.importance_factor(name) for name in ("I", "ii", "III", "IV")] == [1.0, 1.0, 1.25, 1.5]
    ratios = [design.drift_limit("asce7-10", name).ratio for name in ("I", "II", "III", "IV")]
    assert ratios == [0.020, 0.020, 0.015, 0.010]
    soft = [design.drift_limit("bnbc2017", name, "low-rise-accommodating").ratio for name in ("I", "II", "III", "IV")]
    assert soft == [0.025, 0.025, 0.020, 0.015]
    assert design.drift_limit("asce7-10", "IV", "masonry-wall").ratio == 0.007
    assert design.drift_limit("ec8", "II", "brittle-partitions").ratio == 0.01
    assert design.drift_limit("ec8", "III").ratio == pytest.approx(0.025)
    assert design.drift_limit("nbc", "IV").ratio == 0.010
    with pytest.raises(
        sm.errors.InvalidOption, match=re.escape("risk_category of building must be one of I, II, III, IV")
    ):
        design.drift_limit("asce7-10", "V")
    with pytest.raises(sm.errors.InvalidOption, match="structure of code nbc must be one of other; got 'masonry-wall'"):
        design.drift_limit("nbc", "II", "masonry-wall")


def test_tables_say_how_each_row_was_checked() -> None:
    statuses = {VERIFIED, SECOND_HAND, FROM_MEMORY}
    for table in (
        design.period_table(),
        design.distribution_table(),
        design.drift_limit_table(),
        design.system_table(),
    ):
        assert set(table["status"]) <= statuses
        assert (table["clause"] != "").all()
    # Read in the text itself: ASCE 7-10 and BNBC 2017; NBC's periods in a copy of the article.
    for table, verified in (
        (design.period_table(), {"asce7-10", "bnbc2017", "nbc"}),
        (design.distribution_table(), {"asce7-10", "bnbc2017"}),
        (design.drift_limit_table(), {"asce7-10", "bnbc2017"}),
    ):
        assert set(table.filter(status=VERIFIED)["code_id"]) == verified
        assert set(table["code_id"]) <= set(sm.codes.code_table()["code_id"])


def test_stability_and_drift_of_storeys_by_hand() -> None:
    """theta = P d/(V h): 4e6 x 0.01/(5e5 x 4) = 0.02, 0.12 and 0.2; theta_max = 0.5/4 = 0.125; Delta = 4 d/1.25."""
    shear, drift, heights = [5.0e5, 5.0e5, 5.0e5], [0.01, 0.02, 0.02], 4.0
    load = [4.0e6, 1.2e7, 2.0e7]
    np.testing.assert_allclose(design.stability_coefficient(load, drift, shear, heights), [0.02, 0.12, 0.20])
    assert design.stability_limit(4.0) == 0.125
    assert design.stability_limit(4.0, beta=0.4) == 0.25
    assert design.stability_limit(1.5) == 0.25
    table = design.storey_checks(shear, drift, heights, c_d=4.0, importance=1.25, limit=0.015, load=load)
    assert table["p_delta"].to_list() == ["negligible", "to be considered", "unstable"]
    np.testing.assert_allclose(table["design_drift"], [0.032, 0.064, 0.064], rtol=1e-14)
    assert table["amplification"].to_list() == [1.0, 1.0 / (1.0 - 0.12), None]
    ratios = table["drift_ratio"].to_list()
    assert ratios[:2] == pytest.approx([0.008, 0.016 / 0.88], rel=1e-14)
    assert ratios[2] is None
    assert table["drift_ok"].to_list() == [True, False, False]
    # At its limit a storey is still within it: theta of 0.10 is negligible, of theta_max not unstable, the limit kept.
    at = design.storey_checks([1.0, 1.0], [1.0, 1.0], 4.0, c_d=2.0, limit=0.5, load=[0.4, 1.0])
    assert at["theta"].to_list() == [0.1, 0.25]
    assert at["p_delta"].to_list() == ["negligible", "to be considered"]
    assert at["drift_ok"].to_list() == [True, False]
    without = design.storey_checks(shear, drift, heights, c_d=4.0, limit=0.02)
    assert without["theta"].null_count() == 3
    assert without["drift_ok"].to_list() == [True, True, True]  # 0.04/4 and 0.08/4
    assert without.filter(pl.col("p_delta").is_not_null()).height == 0
