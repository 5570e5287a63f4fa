"""Target spectra of codes, tables and suites: values of the standards, interpolation, identity, refusals."""

import json
import pickle
import re
from pathlib import Path

import numpy as np
import pytest

import seismass as sm
from seismass.base.errors import RecordFormatError
from seismass.motions.scaling.suite import target_of
from seismass.motions.spectra import MULTI_PERIODS
from seismass.motions.spectra.target import target_remarks

G = 9.80665
SUITE = sm.builtin_suite("seven")
STEP = sm.Motion(np.ones(300), 0.01)


def every_kind() -> list[sm.TargetSpectrum]:
    return [
        sm.TargetSpectrum.asce7(1.0, 0.6),
        sm.TargetSpectrum.asce7_multi_period(MULTI_PERIODS, np.linspace(1.0, 0.05, 22)),
        sm.TargetSpectrum.eurocode8(2, "D", agr_g=0.2, importance=1.2, damping=0.02),
        sm.TargetSpectrum.nzs1170("D", z=0.3, r=1.3, fault_distance_km=4.0),
        sm.TargetSpectrum.mean_of(SUITE, np.linspace(0.5, 2.0, len(SUITE))),
    ]


@pytest.mark.parametrize("target", every_kind(), ids=lambda target: target.parameters["shape"])
def test_every_kind_is_pickled_described_in_json_and_tilted(target: sm.TargetSpectrum) -> None:
    at = [0.2, 0.5, 1.0, 2.0]
    again = pickle.loads(pickle.dumps(target))
    assert again(at).tolist() == target(at).tolist()
    assert again.label == target.label
    assert json.loads(json.dumps(target.parameters)) == again.parameters
    tilted = target.tilted(0.5).tilted(0.25)
    np.testing.assert_allclose(tilted(at), target(at) * np.array(at) ** 0.75, rtol=1e-15)
    assert tilted.parameters == {**target.parameters, "tilt": 0.75}
    assert tilted.label == f"{target.label}, times (T/1 s)^0.75"
    assert target(1.0).shape == () and target([1.0]).shape == (1,)
    assert target_remarks(target) == ()


def test_targets_made_from_the_same_are_equal() -> None:
    one, other = every_kind(), every_kind()
    assert one == other
    assert [hash(target) for target in one] == [hash(target) for target in other]
    assert len(set(one) | set(other)) == len(one)
    for target in one:
        assert pickle.loads(pickle.dumps(target)) == target
        assert target.tilted(0.5) != target
        assert target.tilted(0.5).tilted(-0.5) == target
        assert target != "a target"


def test_two_targets_that_differ_have_other_parameters() -> None:
    one, other = sm.TargetSpectrum.mean_of(SUITE[0]), sm.TargetSpectrum.mean_of(SUITE[1].replace(name=SUITE[0].name))
    assert one.parameters["records"] == other.parameters["records"]
    assert one.parameters != other.parameters
    assert one != other


def test_multi_period_is_linear_in_period() -> None:
    table = np.linspace(0.4, 2.5, 22)
    target = sm.TargetSpectrum.asce7_multi_period(MULTI_PERIODS, table)
    np.testing.assert_allclose(target(list(MULTI_PERIODS)) / G, table, rtol=1e-15)
    # Halfway between 7.5 and 10 s, and between 0 and 0.01 s.
    np.testing.assert_allclose(target([8.75, 0.005]) / G, [table[-2:].mean(), table[:2].mean()], rtol=1e-15)
    assert target.label == "ASCE 7-22 multi-period spectrum, 22 periods to 10 s"
    with pytest.raises(sm.errors.InvalidOption, match="period of target spectrum must be from 0 s to 10 s"):
        target(10.1)
    other = sm.TargetSpectrum.asce7_multi_period([0.1, 1.0], [1.0, 0.5])
    assert other.label.endswith("2 periods from 0.1 to 1 s, not the standard's 22")


def test_the_standard_has_22_periods() -> None:
    assert len(MULTI_PERIODS) == 22
    assert MULTI_PERIODS[0] == 0.0 and MULTI_PERIODS[-1] == 10.0


# EN 1998-1:2004, tables 3.2 and 3.3: S, T_B, T_C, T_D.
EC8 = {
    (1, "A"): (1.0, 0.15, 0.4, 2.0),
    (1, "B"): (1.2, 0.15, 0.5, 2.0),
    (1, "C"): (1.15, 0.2, 0.6, 2.0),
    (1, "D"): (1.35, 0.2, 0.8, 2.0),
    (1, "E"): (1.4, 0.15, 0.5, 2.0),
    (2, "A"): (1.0, 0.05, 0.25, 1.2),
    (2, "B"): (1.35, 0.05, 0.25, 1.2),
    (2, "C"): (1.5, 0.1, 0.25, 1.2),
    (2, "D"): (1.8, 0.1, 0.3, 1.2),
    (2, "E"): (1.6, 0.05, 0.25, 1.2),
}


@pytest.mark.parametrize(("kind", "ground"), list(EC8))
def test_eurocode_8_follows_its_equations(kind: int, ground: str) -> None:
    s, tb, tc, td = EC8[kind, ground]
    target = sm.TargetSpectrum.eurocode8(kind, ground, agr_g=0.3, importance=1.2)
    # Equations (3.2) to (3.5) at 5 %: a_g S, 2.5 a_g S on the plateau, T_C/T, T_C T_D/T^2.
    ratio = target([0.0, 0.5 * tb, tb, tc, 0.5 * (tc + td), td, 4.0]) / (G * 0.36 * s)
    expected = [1.0, 1.75, 2.5, 2.5, 2.5 * tc / (0.5 * (tc + td)), 2.5 * tc / td, 2.5 * tc * td / 16.0]
    np.testing.assert_allclose(ratio, expected, rtol=1e-14)
    assert target.corner_period() == pytest.approx(tc, rel=1e-2)  # among 400 periods


def test_eurocode_8_damping_correction() -> None:
    def plateau(damping: float) -> float:
        return float(sm.TargetSpectrum.eurocode8(1, "A", agr_g=1.0, damping=damping)(0.3)) / G

    assert plateau(0.05) == pytest.approx(2.5, rel=1e-15)
    assert plateau(0.10) == pytest.approx(2.5 * np.sqrt(10.0 / 15.0), rel=1e-15)
    assert plateau(0.50) == pytest.approx(2.5 * 0.55, rel=1e-15)  # eta >= 0.55


# Table 3.1 of NZS 1170.5 from memory, C_h at 0.1, 0.5, 1, 1.5, 2, 3 and 4.5 s, to two decimals; the code has equations.
NZS = {
    "A": (2.35, 1.60, 0.95, 0.70, 0.53, 0.35, 0.16),
    "B": (2.35, 1.60, 0.95, 0.70, 0.53, 0.35, 0.16),
    "C": (2.93, 2.00, 1.19, 0.88, 0.66, 0.44, 0.20),
    "D": (3.00, 3.00, 1.93, 1.43, 1.07, 0.71, 0.32),
    "E": (3.00, 3.00, 3.00, 2.21, 1.66, 1.11, 0.49),
}


@pytest.mark.parametrize("site_class", list(NZS))
def test_nzs_1170_shape(site_class: str) -> None:
    target = sm.TargetSpectrum.nzs1170(site_class, z=0.4, r=1.3)
    at = [0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 4.5]
    np.testing.assert_allclose(target(at) / (G * 0.4 * 1.3), NZS[site_class], atol=0.0051)
    at_0 = {"A": 1.0, "B": 1.0, "C": 1.33, "D": 1.12, "E": 1.12}[site_class]
    assert float(target(0.0)) / (G * 0.52) == pytest.approx(at_0, rel=1e-15)
    # The branches meet within what their two or three decimals leave.
    edges = np.array([0.1, 0.3, 0.56, 1.0, 1.5, 3.0])
    np.testing.assert_allclose(target(edges * (1 - 1e-9)), target(edges * (1 + 1e-9)), rtol=5e-3)
    assert "second-hand" in target.label and "second-hand" in target.parameters["coefficients"]


def test_nzs_1170_near_fault_factor() -> None:
    far = sm.TargetSpectrum.nzs1170("C", z=0.4)
    periods = [1.0, 1.5, 2.0, 3.0, 3.5, 4.0, 5.0, 6.0]
    most = [1.0, 1.0, 1.12, 1.36, 1.48, 1.60, 1.72, 1.72]
    for distance, share in ((0.0, 1.0), (2.0, 1.0), (11.0, 0.5), (20.0, 0.0), (30.0, 0.0)):
        near = sm.TargetSpectrum.nzs1170("C", z=0.4, fault_distance_km=distance)
        np.testing.assert_allclose(near(periods) / far(periods), 1.0 + share * (np.array(most) - 1.0), rtol=1e-14)
    # N = 1 for return period factors up to that of 250 years.
    rare = sm.TargetSpectrum.nzs1170("C", z=0.4, r=0.75, fault_distance_km=1.0)
    np.testing.assert_allclose(rare(periods), 0.75 * far(periods), rtol=1e-14)


def test_nzs_1170_limits_the_product_of_z_and_r() -> None:
    # Clause 3.1.1 as a public program has it: Z R is not taken above 0.7.
    at = [0.0, 0.5, 3.0]
    limited, below = sm.TargetSpectrum.nzs1170("C", z=0.6, r=1.8), sm.TargetSpectrum.nzs1170("C", z=0.35, r=2.0)
    np.testing.assert_allclose(limited(at), below(at), rtol=1e-15)
    assert "Z R taken as 0.7" in limited.label and "taken as" not in below.label


def test_mean_of_a_suite_is_solved_for_at_each_period() -> None:
    factors = np.linspace(0.5, 2.0, len(SUITE))
    periods = np.array([0.1234, 0.777, 3.21])
    target = sm.TargetSpectrum.mean_of(SUITE, factors, damping=0.02)
    np.testing.assert_array_equal(target(periods), sm.spectra.mean_spectrum(SUITE, factors, periods, 0.02))
    assert target(0.777) == target(periods)[1]
    assert target.label == "mean spectrum of 7 motions, 2 % damping"
    assert sm.TargetSpectrum.mean_of(STEP, label="a step").label == "a step"
    # A suite is scaled to its own mean by factors whose common part is 1 over the mean of fitted shapes.
    own = sm.scaling.scale_asce7_10(SUITE, sm.TargetSpectrum.mean_of(SUITE), between=False)
    assert own.least_ratio == pytest.approx(1.0, abs=1e-12)


def test_remarks_look_at_every_kind() -> None:
    loud = sm.TargetSpectrum.eurocode8(1, "A", agr_g=30.0)
    assert target_remarks(loud)[0].startswith("largest Sa of the target spectrum is 75 g, above 4 g")


def test_corner_period_of_asce7_is_t_s() -> None:
    # The plateau of pseudo-velocity begins at T_S, so that the ratio of the largest values is exact.
    assert sm.TargetSpectrum.asce7(1.07, 0.61).corner_period() == pytest.approx(0.61 / 1.07, rel=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda t: t.eurocode8(3, "A", agr_g=0.3), "kind of target spectrum must be one of 1, 2; got 3"),
        (lambda t: t.eurocode8(1, "F", agr_g=0.3), "ground of target spectrum must be one of A, B, C, D, E; got 'F'"),
        (lambda t: t.eurocode8(1, "A", agr_g=0.0), "agr_g of target spectrum must be a positive number; got 0"),
        (lambda t: t.eurocode8(1, "A", agr_g=1.0, importance=-1), "importance of target spectrum must be a positive"),
        (lambda t: t.eurocode8(1, "A", agr_g=1.0, damping=1.0), "damping of target spectrum must be at least 0 and"),
        (lambda t: t.nzs1170("F", z=0.4), "site_class of target spectrum must be one of A, B, C, D, E; got 'F'"),
        (lambda t: t.nzs1170("C", z=np.nan), "z of target spectrum must be a positive number; got nan"),
        (lambda t: t.nzs1170("C", z=0.4, r=0), "r of target spectrum must be a positive number; got 0"),
        (lambda t: t.nzs1170("C", z=0.4, fault_distance_km=-1.0), "fault_distance_km of target spectrum must be at"),
        (lambda t: t.asce7_multi_period([1.0], [1.0]), "periods of target spectrum must be a list of at least two"),
        (lambda t: t.asce7_multi_period([1.0, 2.0], [1.0]), "sa_g of target spectrum must be a list of 2 values, one"),
        (lambda t: t.asce7_multi_period([1.0, 1.0], [1.0, 1.0]), "periods of target spectrum must be increasing from"),
        (lambda t: t.asce7_multi_period([-1.0, 1.0], [1.0, 1.0]), "periods of target spectrum must be increasing from"),
        (lambda t: t.asce7_multi_period([0.0, np.nan], [1.0, 1.0]), "periods of target spectrum must be increasing"),
        (lambda t: t.asce7_multi_period([0.0, 1.0], [1.0, 0.0]), "sa_g of target spectrum must be a positive number"),
        (lambda t: t.mean_of(SUITE, [1.0]), "factors of target spectrum must be a list of 7 values, one per motion"),
        (lambda t: t.mean_of(STEP, [0.0]), "factors of target spectrum must be positive numbers; got 0"),
        (lambda t: t.mean_of(STEP, damping=2), "damping of target spectrum must be at least 0 and below 1; got 2"),
        (
            lambda t: t.asce7().tilted(-0.5)([1.0, 0.0]),
            "period of target spectrum must be positive where the spectrum is tilted by a negative power; got 0",
        ),
        (lambda t: t.asce7().tilted(np.inf), "power of target spectrum must be a finite number; got inf"),
    ],
)
def test_bad_arguments_are_refused(make, message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=re.escape(message)):
        make(sm.TargetSpectrum)


def test_mean_of_nothing_is_refused() -> None:
    with pytest.raises(
        sm.errors.InvalidMotion, match="motions of target spectrum must be at least one Record or Motion"
    ):
        sm.TargetSpectrum.mean_of([])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("asce7:1.0:0.6", sm.TargetSpectrum.asce7(1.0, 0.6)),
        ("asce7:1.0:0.6:6", sm.TargetSpectrum.asce7(1.0, 0.6, 6.0)),
        ("ec8:1:c:0.3", sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3)),
        ("ec8:2:D:0.2:1.2:0.02", sm.TargetSpectrum.eurocode8(2, "D", agr_g=0.2, importance=1.2, damping=0.02)),
        ("nzs1170:C:0.4", sm.TargetSpectrum.nzs1170("C", z=0.4)),
        ("nzs1170:E:0.3:1.3:5", sm.TargetSpectrum.nzs1170("E", z=0.3, r=1.3, fault_distance_km=5.0)),
    ],
)
def test_an_option_names_a_code_with_its_numbers(text: str, expected: sm.TargetSpectrum) -> None:
    assert target_of(text).parameters == expected.parameters


def test_an_option_names_a_file(tmp_path) -> None:
    file = tmp_path / "site.csv"
    file.write_text("T,Sa (g)\n0,0.4\n0.1,1.0\n10,0.02\n")
    assert target_of(f"asce7-22:{file}").parameters["period"] == [0.0, 0.1, 10.0]
    # From the first period, 0, the spectrum is linear in the period: it has no logarithm.
    assert (target_of(str(file))([0.0, 0.05, 0.1]) / G).tolist() == pytest.approx([0.4, 0.7, 1.0], rel=1e-12)
    assert SUITE[0].source is not None
    assert target_of(f"mean:{SUITE[0].source}").parameters["records"] == [SUITE[0].name]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("ec8:1:C", "--target of command must be ec8:TYPE:GROUND:AGR[:IMPORTANCE[:DAMPING]]; got ec8:1:C"),
        ("ec8:1:C:strong", "--target of command must be ec8:TYPE:GROUND:AGR"),
        ("ec8:one:C:0.3", "kind of target spectrum must be one of 1, 2; got 0"),
        ("asce7:1:2:3:4", "--target of command must be asce7:SDS:SD1[:TL]; got asce7:1:2:3:4"),
        ("mean:", "--target of command must be mean:RECORDS; got mean:"),
        ("eurocode8:1:C:0.3", "must be a CSV that is there or one of asce7:SDS:SD1[:TL], asce7-22:CSV, ec8:"),
        ("asce7", "must be a CSV that is there or one of asce7:SDS:SD1[:TL]"),
        ("nzs1170::0.4", "--target of command must be nzs1170:CLASS:Z[:R[:KM]]; got nzs1170::0.4"),
    ],
)
def test_an_option_that_is_incomplete_is_refused(text: str, message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=re.escape(message)):
        target_of(text)


def test_a_table_with_semicolons_and_the_unit_of_its_periods(tmp_path: Path) -> None:
    """0.5 g at 1 s, twice; a period in ms is refused, as one in s would be wrong by a thousand."""
    file = tmp_path / "target.csv"
    file.write_text("T (s);Sa (g)\n0,5;1,0\n1,0;0,5\n", encoding="utf-8")
    assert sm.TargetSpectrum.from_csv(file)(1.0) == pytest.approx(0.5 * 9.80665, rel=1e-12)
    file.write_text("T (s);Sa (g)\n0.5;1.0\n1.0;0.5\n", encoding="utf-8")
    assert sm.TargetSpectrum.from_csv(file)(1.0) == pytest.approx(0.5 * 9.80665, rel=1e-12)
    file.write_text("Period (ms),Sa (g)\n500,1.0\n1000,0.5\n", encoding="utf-8")
    with pytest.raises(RecordFormatError, match=r"unit of period of target\.csv must be s; got ms"):
        sm.TargetSpectrum.from_csv(file)
