"""Modes and response spectrum analysis against dense matrices written out here, closed forms, and a published table."""

import re

import numpy as np
import pytest
from scipy.linalg import eigh, eigh_tridiagonal

import seismass as sm
from seismass.design import modal_correlation, response_spectrum_analysis, vibration_modes


def dense(mass, stiffness):
    m, k = np.diag(mass), np.zeros((len(mass), len(mass)))
    for i, stiff in enumerate(stiffness):
        k[i, i] += stiff
        if i:
            k[i - 1, i - 1] += stiff
            k[i, i - 1] -= stiff
            k[i - 1, i] -= stiff
    return m, k


# verification numbers: first period with a share of the live load attached to all floors but the roof.
SHARES = (0.125, 0.25, 0.375, 0.5, 1.0, 1.5)
PERIODS = {
    (2, 0.38): (0.3866, 0.3933, 0.4000, 0.4068, 0.4340, 0.4609),
    (3, 0.47): (0.4833, 0.4965, 0.5095, 0.5223, 0.5715, 0.6176),
    (4, 0.57): (0.5900, 0.6096, 0.6286, 0.6472, 0.7175, 0.7821),
}


@pytest.mark.parametrize(("building", "periods"), PERIODS.items())
def test_periods_with_a_share_of_the_live_load(building, periods) -> None:
    storeys, period = building
    bare = sm.Building.uniform(storeys, period)
    for share, expected in zip(SHARES, periods, strict=True):
        mass = bare.mass + share * np.append(np.ones(storeys - 1), 0.0)
        # The table has four decimals.
        assert vibration_modes(mass, bare.stiffness).periods[0] == pytest.approx(expected, abs=0.5001e-4)
        assert bare.replace(mass=mass).periods == pytest.approx(vibration_modes(mass, bare.stiffness).periods)


def test_two_equal_storeys_have_golden_modes() -> None:
    modes = vibration_modes([2.0, 2.0], [50.0, 50.0])
    golden = 0.5 * (1.0 + np.sqrt(5.0))
    w = 5.0 * np.array([1.0 / golden, golden])  # w^2 = (3 -+ sqrt(5))/2 k/m
    np.testing.assert_allclose(modes.periods, 2.0 * np.pi / w, rtol=1e-14)
    np.testing.assert_allclose(modes.shapes[1] / modes.shapes[0], [golden, -1.0 / golden], rtol=1e-14)


def test_modes_are_orthonormal_and_carry_the_whole_mass() -> None:
    rng = np.random.default_rng(3)
    mass, stiffness = rng.uniform(0.5, 2.0, 6), rng.uniform(100.0, 900.0, 6)
    modes = vibration_modes(mass, stiffness)
    m, k = dense(mass, stiffness)
    np.testing.assert_allclose(modes.shapes.T @ m @ modes.shapes, np.eye(6), atol=1e-14)
    np.testing.assert_allclose(
        modes.shapes.T @ k @ modes.shapes, np.diag((2.0 * np.pi / modes.periods) ** 2), atol=1e-11
    )
    assert modes.effective_mass.sum() == pytest.approx(mass.sum(), rel=1e-14)
    assert (modes.shapes[-1] > 0.0).all()


@pytest.mark.parametrize("combination", ["srss", "cqc"])
def test_storey_shears_are_those_of_dense_matrices(combination) -> None:
    mass, stiffness, damping = np.array([1.25, 1.25, 1.25, 1.0]), np.array([900.0, 800.0, 700.0, 600.0]), 0.05

    def spectrum(periods):
        return 9.0 / (0.3 + periods)

    got = response_spectrum_analysis(mass, stiffness, spectrum, combination=combination, damping=damping)
    m, k = dense(mass, stiffness)
    squares, shapes = eigh(k, m)
    w = np.sqrt(squares)
    shears = np.empty((4, 4))
    for n in range(4):
        phi = shapes[:, n]
        gamma = (phi @ m @ np.ones(4)) / (phi @ m @ phi)
        displacement = gamma * phi * spectrum(2.0 * np.pi / w[n]) / squares[n]
        drift = np.diff(displacement, prepend=0.0)
        shears[n] = stiffness * drift
    expected = np.zeros(4)
    for i in range(4):
        total = 0.0
        for n in range(4):
            for p in range(4):
                b = w[p] / w[n]
                coupling = 8 * damping**2 * (1 + b) * b**1.5 / ((1 - b**2) ** 2 + 4 * damping**2 * b * (1 + b) ** 2)
                total += (coupling if combination == "cqc" else float(n == p)) * shears[n, i] * shears[p, i]
        expected[i] = np.sqrt(total)
    np.testing.assert_allclose(got.storey_shear, expected, rtol=1e-12)
    np.testing.assert_allclose(got.modal_shear, shears, rtol=1e-10, atol=1e-12)


def test_one_storey_is_mass_times_ordinate() -> None:
    got = response_spectrum_analysis([3.0], [300.0], lambda t: 2.0 / t)
    assert got.storey_shear[0] == pytest.approx(3.0 * 2.0 / (2.0 * np.pi / 10.0), rel=1e-14)


def test_correlation_is_one_on_the_diagonal_and_fades() -> None:
    correlation = modal_correlation([1.0, 0.9, 0.3], 0.05)
    np.testing.assert_allclose(np.diag(correlation), 1.0)
    np.testing.assert_allclose(correlation, correlation.T, rtol=1e-12)
    assert correlation[0, 1] > 0.4 > 0.01 > correlation[0, 2] > 0.0


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"mass": []}, sm.errors.InvalidScene, "mass of building must be a list of at least one value; got none"),
        ({"mass": [1.0, -1.0]}, sm.errors.InvalidScene, "mass of storey 2 must be a positive number; got -1"),
        ({"mass": [1.0, np.nan]}, sm.errors.InvalidScene, "mass of storey 2 must be a positive number; got nan"),
        (
            {"stiffness": [1.0, np.inf]},
            sm.errors.InvalidScene,
            "stiffness of storey 2 must be a positive number; got inf",
        ),
        (
            {"stiffness": [1.0]},
            sm.errors.InvalidScene,
            "stiffness of building must be a list of 2 values, one per storey",
        ),
        ({"stiffness": [[1.0], [1.0]]}, sm.errors.InvalidScene, "stiffness of building must be a list of numbers"),
        ({"combination": "abs"}, sm.errors.InvalidOption, "must be srss or cqc; got 'abs'"),
        (
            {"damping": 0.0},
            sm.errors.InvalidOption,
            "damping of response spectrum analysis must be above 0 and below 1; got 0",
        ),
        (
            {"spectrum": lambda t: -t},
            sm.errors.InvalidOption,
            "spectrum of response spectrum analysis must be 2 values of at",
        ),
        (
            {"spectrum": lambda t: t[:1]},
            sm.errors.InvalidOption,
            "spectrum of response spectrum analysis must be 2 values",
        ),
    ],
)
def test_bad_arguments_are_refused(arguments: dict, error: type[sm.SeismassError], message: str) -> None:
    given = {"mass": [1.0, 1.0], "stiffness": [1.0, 1.0], "spectrum": lambda t: t} | arguments
    with pytest.raises(error, match=re.escape(message)):
        response_spectrum_analysis(**given)


@pytest.mark.parametrize("storeys", [1, 2, 3, 4, 7, 12, 25, 26, 40])
def test_modes_have_the_bits_of_the_solver_of_tridiagonal_matrices(storeys):
    random = np.random.default_rng(storeys)
    for _ in range(20):
        mass, stiffness = random.uniform(0.3, 3.0, (2, storeys)) * 10.0 ** random.uniform(2.0, 9.0, (2, 1))
        beside = -stiffness[1:] / (np.sqrt(mass[1:]) * np.sqrt(mass[:-1]))
        squares, _ = eigh_tridiagonal((stiffness + np.append(stiffness[1:], 0.0)) / mass, beside)
        assert np.array_equal(vibration_modes(mass, stiffness).periods, 2.0 * np.pi / np.sqrt(squares))
