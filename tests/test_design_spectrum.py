"""Modal tables, modal combination and response spectrum analysis against closed forms and numbers by hand."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm
from seismass import design


@pytest.mark.parametrize("storeys", [1, 2, 3, 8])
def test_uniform_building_has_the_closed_form(storeys: int) -> None:
    """w_n = 2 sqrt(k/m) sin(b_n/2), phi_jn = sin(j b_n), b_n = (2n-1) pi/(2N+1): the difference equation's solution."""
    mass, stiffness = 2.0e5, 3.0e8
    modes = design.vibration_modes(np.full(storeys, mass), np.full(storeys, stiffness))
    b = (2.0 * np.arange(1, storeys + 1) - 1.0) * np.pi / (2.0 * storeys + 1.0)
    w = 2.0 * np.sqrt(stiffness / mass) * np.sin(b / 2.0)
    np.testing.assert_allclose(modes.periods, 2.0 * np.pi / w, rtol=1e-12)
    shapes = np.sin(np.arange(1, storeys + 1)[:, None] * b)
    np.testing.assert_allclose(modes.shapes / modes.shapes[-1], shapes / shapes[-1], rtol=0.0, atol=1e-11)
    # sum_j sin(j b) = cot(b/2)/2 and sum_j sin^2(j b) = (2N+1)/4 at these b: effective masses in closed form.
    effective = mass * (0.5 / np.tan(b / 2.0)) ** 2 / ((2.0 * storeys + 1.0) / 4.0)
    np.testing.assert_allclose(modes.effective_mass, effective, rtol=1e-10)
    assert modes.mass == pytest.approx(storeys * mass, rel=1e-13)


def test_modal_table_of_two_equal_storeys_by_hand() -> None:
    """phi = (1/g, 1) and (-g, 1) with the golden ratio g: Gamma phi_roof = (1 + 1/g)/(1 + 1/g^2), the rest -0.1708."""
    table = design.vibration_modes([1000.0, 1000.0], [4.0e5, 4.0e5]).table()
    golden = 0.5 * (1.0 + np.sqrt(5.0))
    first = (1.0 + 1.0 / golden) / (1.0 + 1.0 / golden**2)
    second = (1.0 - golden) / (1.0 + golden**2)
    np.testing.assert_allclose(table["participation"], [first, second], rtol=1e-12)
    assert first + second == pytest.approx(1.0, rel=1e-15)  # sum of Gamma_n phi_n is 1 on every floor
    shares = [(1.0 + 1.0 / golden) ** 2 / (1.0 + 1.0 / golden**2) / 2.0, (1.0 - golden) ** 2 / (1.0 + golden**2) / 2.0]
    np.testing.assert_allclose(table["effective_share"], shares, rtol=1e-12)
    np.testing.assert_allclose(table["cumulative_share"], [shares[0], 1.0], rtol=1e-12)
    np.testing.assert_allclose(table["floor_1"], [1.0 / golden, -golden], rtol=1e-12)
    np.testing.assert_allclose(table["frequency"], 1.0 / table["period"], rtol=1e-15)
    assert table["floor_2"].to_list() == [1.0, 1.0]
    assert table["mode"].to_list() == [1, 2]


def test_modes_needed_for_a_share_of_the_mass() -> None:
    """Three equal storeys have 91.41 %, 7.49 % and 1.10 %, from the closed form above."""
    modes = design.vibration_modes([1.0] * 3, [1.0] * 3)
    np.testing.assert_allclose(modes.table()["effective_share"], [0.9141, 0.0749, 0.0110], atol=5e-5)
    assert [modes.modes_needed(share) for share in (0.5, 0.9, 0.95, 0.99, 1.0)] == [1, 1, 2, 3, 3]
    with pytest.raises(sm.errors.InvalidOption, match=r"share of modes must be above 0 and up to 1; got 1\.2"):
        modes.modes_needed(1.2)


def test_cqc_is_srss_for_periods_far_apart_and_the_sum_for_equal_ones() -> None:
    modal = np.array([[3.0, 1.0], [4.0, -2.0]])
    srss = design.combined_modes(modal, [1.0, 0.001])
    np.testing.assert_allclose(srss, [5.0, np.sqrt(5.0)], rtol=1e-15)
    # rho of r = 1000 at 5 %: 8 z^2 r^2.5 (1 + 1/r) / r^4, 6.3e-7.
    np.testing.assert_allclose(design.combined_modes(modal, [1.0, 0.001], combination="cqc"), srss, rtol=2e-6)
    # With rho = 1 modes add up with their signs: 3 + 4, |1 - 2|.
    np.testing.assert_allclose(design.combined_modes(modal, [0.7, 0.7], combination="cqc"), [7.0, 1.0], rtol=1e-14)


def test_correlation_by_hand() -> None:
    """r = 2, z = 5 %: 8 z^2 3 2^1.5 / (9 + 4 z^2 2 9) = 0.16971/9.18 = 0.018486."""
    rho = design.modal_correlation([1.0, 0.5], 0.05)[0, 1]
    assert rho == pytest.approx(8 * 0.0025 * 3 * 2**1.5 / (9 + 4 * 0.0025 * 2 * 9), rel=1e-14)
    assert rho == pytest.approx(0.018486, abs=5e-7)
    combined = design.combined_modes([[3.0], [4.0]], [1.0, 0.5], combination="cqc")
    assert combined[0] == pytest.approx(np.sqrt(9.0 + 16.0 + 2.0 * 12.0 * rho), rel=1e-14)


@pytest.mark.parametrize("combination", ["srss", "cqc"])
def test_two_storeys_by_hand(combination: design.Combination) -> None:
    """Flat spectrum A: modal forces Gamma_n m phi_n A; shears, drifts, displacements and moments summed by hand."""
    mass, stiffness, height, a = 1000.0, 4.0e5, 3.0, 2.0
    found = design.response_spectrum_analysis(
        [mass] * 2, [stiffness] * 2, lambda t: np.full_like(t, a), combination=combination, heights=height
    )
    golden = 0.5 * (1.0 + np.sqrt(5.0))
    forces = []  # per mode: at floors 1 and 2
    for ratio in (1.0 / golden, -golden):
        gamma = (1.0 + ratio) / (1.0 + ratio**2)
        forces.append((gamma * ratio * mass * a, gamma * mass * a))
    rho = 0.0
    if combination == "cqc":
        rho = float(design.modal_correlation(found.modes.periods, 0.05)[0, 1])

    def combined(first: float, second: float) -> float:
        return float(np.sqrt(first**2 + second**2 + 2.0 * rho * first * second))

    shears = [(sum(pair), pair[1]) for pair in forces]
    by_storey = list(zip(*shears, strict=True))
    np.testing.assert_allclose(found.storey_shear, [combined(*pair) for pair in by_storey], rtol=1e-12)
    drifts = [[v / stiffness for v in pair] for pair in by_storey]
    np.testing.assert_allclose(found.storey_drift, [combined(*pair) for pair in drifts], rtol=1e-12)
    roof = [drifts[0][n] + drifts[1][n] for n in (0, 1)]
    np.testing.assert_allclose(found.displacement, [combined(*drifts[0]), combined(*roof)], rtol=1e-12)
    foot = [height * (shears[n][0] + shears[n][1]) for n in (0, 1)]
    assert found.overturning is not None
    np.testing.assert_allclose(found.overturning, [combined(*foot), height * found.storey_shear[1]], rtol=1e-12)
    table = found.table()
    np.testing.assert_allclose(table["drift_ratio"], found.storey_drift / height, rtol=1e-15)
    assert found.base_shear == found.storey_shear[0]
    np.testing.assert_allclose(found.mode_table()["base_shear"], found.modes.effective_mass * a, rtol=1e-12)


def test_without_heights_there_are_no_moments() -> None:
    found = design.response_spectrum_analysis([1.0, 1.0], [9.0, 9.0], lambda t: t)
    assert found.overturning is None
    assert found.table()["overturning"].null_count() == 2
    with pytest.raises(sm.errors.InvalidScene, match="heights of building must be one number or a list of 2 values"):
        design.response_spectrum_analysis([1.0, 1.0], [9.0, 9.0], lambda t: t, heights=[3.0])
    with pytest.raises(
        sm.errors.InvalidOption, match="periods of modal combination must be 2 values, one per mode; got 1"
    ):
        design.combined_modes([[1.0], [2.0]], [1.0])


def test_combinations_differ_as_little_as_the_page_says() -> None:
    """docs/design.md: shears of uniform buildings, at most 0.3 % for 2 to 4 storeys and 1.4 % for 8."""
    for storeys, period, percent in ((2, 0.38, 0.1), (3, 0.47, 0.2), (4, 0.57, 0.3), (8, 1.2, 1.4)):
        building, target = sm.Building.uniform(storeys, period), sm.TargetSpectrum.asce7(1.0, 0.6)
        srss, cqc = (
            design.response_spectrum_analysis(building.mass, building.stiffness, target, combination=name).storey_shear
            for name in ("srss", "cqc")
        )
        assert round(100.0 * float(np.abs(cqc / srss - 1.0).max()), 1) == percent


def test_demands_of_the_design_by_hand() -> None:
    """One storey of 1000 kg under 8 m/s2: 8 kN; R/I_e = 4: 2 kN; V = 3 kN: 0.85 V = 2.55 kN, drift that of 2 kN."""
    found = design.response_spectrum_analysis([1000.0], [4.0e5], lambda t: np.full_like(t, 8.0), heights=3.0)
    plain = found.for_design(5.0, importance=1.25)
    assert (plain.shear[0], plain.scale) == (pytest.approx(2000.0), 1.0)
    scaled = found.for_design(5.0, importance=1.25, base_shear=3000.0)
    assert scaled.shear[0] == pytest.approx(2550.0)
    assert scaled.drift[0] == pytest.approx(2000.0 / 4.0e5)
    assert scaled.overturning is not None
    assert scaled.overturning[0] == pytest.approx(3.0 * 2550.0)
    assert found.for_design(5.0, importance=1.25, base_shear=3000.0, share=1.0).shear[0] == pytest.approx(3000.0)
    assert found.for_design(5.0, importance=1.25, base_shear=2000.0).scale == 1.0
    with pytest.raises(sm.errors.InvalidOption, match="reduction of design must be a positive number; got 0"):
        found.for_design(0.0)
