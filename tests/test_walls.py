"""Walls: cantilevers against closed forms, wall-frames against the continuum, and walls of scene files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import seismass as sm
from seismass.design import Wall, response_spectrum_analysis, vibration_modes

FRAME = sm.Building([2e5] * 5, 1.5e8, heights=3.5)


def first_period(mass: NDArray[np.float64], wall: Wall) -> float:
    found = vibration_modes(mass, np.zeros(len(mass)), stiffness_matrix=wall.stiffness_matrix).periods[0]
    return float(found)


def test_one_and_two_storeys_by_hand() -> None:
    """3 EI/h^3; and 6 EI/(7 h^3) [[16, -5], [-5, 2]], the inverse of h^3/EI [[1/3, 5/6], [5/6, 8/3]]."""
    np.testing.assert_allclose(Wall([3.0], 9.0).stiffness_matrix, [[1.0]], rtol=1e-15)
    by_hand = 6.0 * 5.0 / (7.0 * 2.0**3) * np.array([[16.0, -5.0], [-5.0, 2.0]])
    np.testing.assert_allclose(Wall([2.0, 2.0], 5.0).stiffness_matrix, by_hand, rtol=1e-14)


def test_deflections_under_a_load_at_the_head() -> None:
    """A cantilever of length L: P x^2 (3 L - x)/(6 EI), so P L^3/(3 EI) at its head."""
    heights = [3.0, 4.0, 2.5, 3.5]
    x, length = np.cumsum(heights), sum(heights)
    found = np.linalg.solve(Wall(heights, 7e9).stiffness_matrix, [0.0, 0.0, 0.0, 1e6])
    np.testing.assert_allclose(found, 1e6 * x**2 * (3.0 * length - x) / (6.0 * 7e9), rtol=1e-12)


def test_two_rigidities_by_the_area_of_moments() -> None:
    """P at the head, EI_1 over h_1 and EI_2 above: the integral of P (L - x)^2/EI, in closed form of each part."""
    found = np.linalg.solve(Wall([4.0, 3.0], [8.0, 2.0]).stiffness_matrix, [0.0, 1.0])[-1]
    assert found == pytest.approx((7.0**3 - 3.0**3) / (3.0 * 8.0) + 3.0**3 / (3.0 * 2.0), rel=1e-13)


def test_the_period_of_a_uniform_cantilever() -> None:
    """w_1 = 3.5160 sqrt(EI/(m L^4)), lambda_1 = 1.875104 (Chopra, Dynamics of Structures); masses at the floors."""
    errors = []
    for storeys in (10, 20, 40):
        mass = np.full(storeys, 1.0 / storeys)
        mass[-1] /= 2.0
        frequency = 2.0 * np.pi / first_period(mass, Wall(np.full(storeys, 1.0 / storeys), 1.0))
        errors.append(1.8751040687**2 / frequency - 1.0)
    assert 0.0 < errors[-1] < 3e-4
    # Masses in place of their distribution: an error of the second order, a quarter at half the step.
    np.testing.assert_allclose(np.divide(errors[:-1], errors[1:]), 4.0, rtol=0.01)


def wall_frame_deflection(z: NDArray[np.float64], alpha_h: float) -> NDArray[np.float64]:
    """Deflection over w H^4/EI at heights z = x/H under a uniform load w.

    Stafford Smith and Coull (1991), chapter 11: EI y'''' - GA y'' = w, y = y' = 0 at the foot, and no moment and no
    shear, y'' = 0 and EI y''' = GA y', at the head.
    """
    a = alpha_h
    bend = (a * np.sinh(a) + 1.0) / np.cosh(a) * (np.cosh(a * z) - 1.0) - a * np.sinh(a * z)
    return np.asarray((bend + a**2 * (z - 0.5 * z**2)) / a**4)


@pytest.mark.parametrize("alpha_h", [0.5, 2.0, 6.0])
def test_a_wall_frame_under_uniform_load(alpha_h: float) -> None:
    errors = []
    for storeys in (20, 40, 80):
        heights = np.full(storeys, 1.0 / storeys)
        load = np.full(storeys, 1.0 / storeys)
        load[-1] /= 2.0
        frame = sm.Building(np.ones(storeys), storeys * alpha_h**2, heights=heights)  # GA = alpha^2, EI = 1, H = 1
        wall = Wall.of_alpha_h(frame, alpha_h)
        assert wall.flexural_rigidity[0] == pytest.approx(1.0, rel=1e-12)
        together = wall.stiffness_matrix + frame_matrix(frame.stiffness)
        expected = wall_frame_deflection(np.cumsum(heights), alpha_h)
        found = np.linalg.solve(together, load)
        errors.append(np.abs(found - expected).max() / expected.max())
    assert errors[-1] < 1e-3
    np.testing.assert_allclose(np.divide(errors[:-1], errors[1:]), 4.0, rtol=0.05)


def frame_matrix(stiffness: NDArray[np.float64]) -> NDArray[np.float64]:
    """Stiffness of a chain of storeys over the floors."""
    down = np.eye(len(stiffness)) - np.eye(len(stiffness), k=-1)
    return np.asarray(down.T @ np.diag(stiffness) @ down)


def test_each_way_to_state_a_wall_gives_what_it_states() -> None:
    heights = np.full(5, 3.5)
    mass = np.full(5, 2e5)
    assert first_period(mass, Wall.of_period(mass, heights, 0.7)) == pytest.approx(0.7, rel=1e-12)
    assert Wall.of_alpha_h(FRAME, 2.5).alpha_h(FRAME) == pytest.approx(2.5, rel=1e-14)
    for share in (0.2, 0.6, 0.95):
        assert Wall.of_base_shear_share(FRAME, share).base_shear_share(FRAME) == pytest.approx(share, rel=1e-10)


def test_the_share_of_the_base_shear_by_the_response_spectrum_of_one_mode() -> None:
    """A spectrum that is zero at all periods but the first: the modal shears at the foot are in that share."""
    wall = Wall.of_base_shear_share(FRAME, 0.4)
    building = wall.beside(FRAME)
    found = response_spectrum_analysis(
        building.mass,
        building.stiffness,
        lambda periods: np.where(periods == periods.max(), 3.0, 0.0),
        stiffness_matrix=building.stiffness_matrix,
    )
    assert found.wall_shear[0] / found.base_shear == pytest.approx(0.4, rel=1e-9)
    assert found.spring_shear[0] / found.base_shear == pytest.approx(0.6, rel=1e-9)


def test_modes_are_those_of_the_kernel() -> None:
    building = Wall.of_alpha_h(FRAME, 2.0).beside(FRAME)
    modes = vibration_modes(building.mass, building.stiffness, stiffness_matrix=building.stiffness_matrix)
    np.testing.assert_allclose(modes.periods, building.periods, rtol=1e-10)
    assert modes.mass == pytest.approx(building.mass.sum(), rel=1e-12)
    # The damping matrix of the kernel has the ratio in every mode: phi^T C phi = 2 zeta w.
    ratios = np.diag(modes.shapes.T @ building.damping_matrix @ modes.shapes) * modes.periods / (4.0 * np.pi)
    np.testing.assert_allclose(ratios, 0.05, rtol=1e-9)


def test_a_matrix_of_storeys_is_a_frame() -> None:
    """Storeys given as a matrix have the modes, drifts and shears of storeys given as springs."""
    mass, stiffness = np.array([3e4, 2e4, 2e4]), np.array([5e7, 4e7, 2e7])
    target = sm.TargetSpectrum.asce7()
    by_springs = response_spectrum_analysis(mass, stiffness, target, heights=3.0)
    half = frame_matrix(0.5 * stiffness)
    mixed = response_spectrum_analysis(mass, 0.5 * stiffness, target, heights=3.0, stiffness_matrix=half)
    for name in ("storey_shear", "storey_drift", "displacement", "overturning"):
        np.testing.assert_allclose(getattr(mixed, name), getattr(by_springs, name), rtol=1e-11, err_msg=name)
    np.testing.assert_allclose(mixed.spring_shear, 0.5 * by_springs.storey_shear, rtol=1e-11)
    np.testing.assert_allclose(mixed.wall_shear, 0.5 * by_springs.storey_shear, rtol=1e-11)
    np.testing.assert_array_equal(by_springs.spring_shear, by_springs.storey_shear)
    assert not by_springs.wall_shear.any()
    assert "wall_shear" in mixed.table().columns
    assert "wall_shear" not in by_springs.table().columns


def test_a_wall_is_added_to_the_matrix_that_is_there() -> None:
    one, other = Wall.of_alpha_h(FRAME, 2.0), Wall.of_alpha_h(FRAME, 3.0)
    both = Wall(one.heights, one.flexural_rigidity + other.flexural_rigidity)
    added = other.beside(one.beside(FRAME)).stiffness_matrix
    np.testing.assert_allclose(added, both.stiffness_matrix, rtol=1e-12, atol=1e-6)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Wall([3.0, -1.0], 1.0), "heights of storey 2 must be a positive number; got -1"),
        (lambda: Wall([3.0, 3.0], [1.0]), "flexural_rigidity of building must be one number or a list of 2 values"),
        (lambda: Wall.of_alpha_h(FRAME, 0.0), "alpha_h of wall must be"),
        (lambda: Wall.of_alpha_h(FRAME.replace(heights=None), 1.0), "heights of building must be given for a wall"),
        (lambda: Wall.of_base_shear_share(FRAME, 1.0), "share of wall must be above 0 and below 1; got 1"),
        (lambda: Wall.of_period([1.0], 3.0, -1.0), "period of wall must be"),
        (lambda: Wall([3.0], 1.0).beside(FRAME), "building of wall must be of 1 storeys, as the wall has; got 5"),
        (
            lambda: vibration_modes([1.0, 1.0], [0.0, 0.0], stiffness_matrix=np.diag([1.0, 0.0])),
            "stiffness_matrix of building must be positive definite together with the storeys",
        ),
        (
            lambda: vibration_modes([1.0, 1.0], [1.0, 1.0], stiffness_matrix=[[1.0, 0.5], [0.0, 1.0]]),
            "stiffness_matrix of building must be finite and symmetric",
        ),
        (
            lambda: vibration_modes([1.0, 1.0], [1.0, 1.0], stiffness_matrix=[[1.0]]),
            "stiffness_matrix of building must be 2 lists of 2 values; got 1 by 1",
        ),
    ],
)
def test_wrong_walls_are_refused(make: object, message: str) -> None:
    with pytest.raises(sm.errors.InvalidScene, match=f"^{message}"):
        make()  # type: ignore[operator]


def scene_of(tmp_path: Path, content: str) -> sm.Scene:
    path = tmp_path / "scene.toml"
    path.write_text(f"{content}\n[motion]\nacceleration = [0.0, 1.0, 0.0]\ndt = 0.01\n")
    return sm.read_scene(path).scene


GIVEN = "[building]\nmass = 2e5\nstiffness = [1.5e8, 1.5e8, 1.5e8]\nheights = 3.5\n"


@pytest.mark.parametrize(
    ("walls", "wall"),
    [
        ("flexural_rigidity = 4e9", Wall([3.5] * 3, 4e9)),
        ("flexural_rigidity = [4e9, 3e9, 2e9]", Wall([3.5] * 3, [4e9, 3e9, 2e9])),
        ("period = 0.4", Wall.of_period([2e5] * 3, 3.5, 0.4)),
        ("alpha_h = 2.0", Wall.of_alpha_h(sm.Building([2e5] * 3, 1.5e8, heights=3.5), 2.0)),
        ("base_shear_share = 0.3", Wall.of_base_shear_share(sm.Building([2e5] * 3, 1.5e8, heights=3.5), 0.3)),
    ],
)
def test_walls_of_a_file(tmp_path: Path, walls: str, wall: Wall) -> None:
    building = scene_of(tmp_path, f"{GIVEN}[walls]\n{walls}\n").building
    assert building == wall.beside(sm.Building([2e5] * 3, 1.5e8, heights=3.5))


def test_walls_alone(tmp_path: Path) -> None:
    text = "[building]\nstoreys = 3\nmass = 2e5\nstiffness = 0.0\nheights = 3.5\n[walls]\nperiod = 0.4\n"
    building = scene_of(tmp_path, text).building
    assert building is not None
    assert building.periods[0] == pytest.approx(0.4, rel=1e-10)


@pytest.mark.parametrize("walls", ["alpha_h = 2.0", "base_shear_share = 0.3"])
def test_the_period_of_a_file_is_that_of_storeys_and_walls(tmp_path: Path, walls: str) -> None:
    text = "[building]\nstoreys = 4\nperiod = 0.6\nheights = 3.0\nyield_shear_over_weight = 0.2\n"
    building = scene_of(tmp_path, f"{text}[walls]\n{walls}\n").building
    assert building is not None
    assert building.stiffness_matrix is not None
    assert building.periods[0] == pytest.approx(0.6, rel=1e-10)
    assert building.yield_shear[0] == pytest.approx(0.2 * building.weight, rel=1e-14)
    assert not building.mass_is_stated
    frame = sm.Building(building.mass, building.stiffness, heights=3.0)
    alone = walls.startswith("alpha")
    wall = Wall.of_alpha_h(frame, 2.0) if alone else Wall.of_base_shear_share(frame, 0.3)
    largest = np.abs(building.stiffness_matrix).max()
    np.testing.assert_allclose(building.stiffness_matrix, wall.stiffness_matrix, rtol=0.0, atol=1e-9 * largest)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[walls]\nalpha_h = 2.0\n", "walls of scene.toml must be left out where there is no building; got a table"),
        (f"{GIVEN}[walls]\n", "walls.flexural_rigidity of scene.toml must be given, or walls.period, or walls.alpha_h"),
        (
            f"{GIVEN}[walls]\nalpha = 2.0\n",
            "walls.alpha of scene.toml must be one of the keys .*did you mean walls.a",
        ),
        (
            f"{GIVEN}[walls]\nalpha_h = 2.0\nperiod = 1.0\n",
            "walls.period of scene.toml must be left out where walls.alpha_h is given",
        ),
        (
            f"{GIVEN}stiffness_matrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n[walls]\nalpha_h = 2.0\n",
            "building.stiffness_matrix of scene.toml must be left out where walls are given; got both",
        ),
        (
            "[building]\nstoreys = 3\nperiod = 0.4\nheights = 3.0\n[walls]\nflexural_rigidity = 1e9\n",
            "walls.flexural_rigidity of scene.toml must be left out where building.period, that of storeys and walls",
        ),
        (
            "[building]\nstoreys = 3\nperiod = 0.4\n[walls]\nalpha_h = 2.0\n",
            "building.heights of scene.toml must be given; got nothing",
        ),
        (f"{GIVEN}[walls]\nalpha_h = -1.0\n", "walls.alpha_h of scene.toml must be a positive number; got -1"),
    ],
)
def test_wrong_walls_of_a_file_are_refused(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(sm.errors.InvalidSceneFile, match=f"^{message}"):
        scene_of(tmp_path, text)
