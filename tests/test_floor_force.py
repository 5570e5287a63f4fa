"""Peaks of floor forces: against the equilibrium of floors over fine samples, stuck goods, batches, and refusals."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm

SEEDS = range(24)


def random_run(seed: int) -> tuple[sm.Scene, sm.Motion]:
    """A scene of one to twenty storeys with goods on floors, and noise, in every third case with a vertical part."""
    rng = np.random.default_rng(seed)
    storeys = int(rng.choice([1, 2, 3, 4, 6, 12, 20]))
    building = sm.Building(
        rng.uniform(0.8, 1.2, storeys) * 1e5,
        (2.0 * np.pi / (0.1 * storeys + 0.1)) ** 2 * 1e5 * storeys**2 * 0.4,
        yield_shear=rng.uniform(0.05, 0.6) * 1e6 * np.linspace(storeys, 1.0, storeys),
        damping=0.05
        if seed % 2
        else sm.Rayleigh(0.05, (1, min(storeys, 2) if storeys > 1 else 1))
        if storeys > 1
        else 0.03,
        geometric_stiffness=rng.uniform(0.0, 2e5, storeys),
    )
    floors = np.flatnonzero(rng.random(storeys) < 0.8) + 1
    blocks = [sm.Block(int(i), mass_ratio=rng.uniform(0.1, 1.5), mu=rng.uniform(0.02, 0.6)) for i in floors]
    blocks += [sm.Block(1, mass_ratio=0.3, mu_s=0.3, mu_k=0.1)]
    time = np.linspace(0.0, 1.0, 400)
    noise = rng.normal(0.0, 1.0, 400) * np.sin(np.pi * time) * rng.choice([1.0, 4.0, 9.0])
    vertical = rng.normal(0.0, 2.0, 400) if seed % 3 == 0 else None
    return sm.Scene(building, blocks), sm.Motion(noise, 0.02, vertical)


def finer(motion: sm.Motion, parts: int) -> sm.Motion:
    """The same motion, which is linear between samples, at steps that are parts of its own."""
    places = np.arange((motion.samples - 1) * parts + 1) / parts
    samples = np.arange(motion.samples)
    parts_of = [
        np.interp(places, samples, values) for values in (motion.acceleration, motion.vertical) if values is not None
    ]
    return sm.Motion(parts_of[0], motion.dt / parts, *parts_of[1:])


def forces(scene: sm.Scene, motion: sm.Motion) -> np.ndarray:
    """Forces on floors by springs, P-Delta and dampers over time: what mass and goods of a floor pass on."""
    response = sm.simulate(scene, motion, histories=True)
    below = response.storey_shear - scene.building.geometric_stiffness * response.drift
    above = np.hstack([below[:, 1:], np.zeros((len(below), 1))])
    return above - below - response.floor_velocity @ scene.building.damping_matrix.T


@pytest.mark.parametrize("seed", SEEDS)
def test_peaks_are_those_of_the_equilibrium_of_floors(seed: int) -> None:
    scene, motion = random_run(seed)
    response = sm.simulate(scene, motion, floor_force=True)
    sampled = np.abs(forces(scene, finer(motion, 200))).max(axis=0)
    assert (sampled <= response.peak_floor_force * (1.0 + 1e-8)).all()
    np.testing.assert_allclose(sampled, response.peak_floor_force, rtol=1e-3)
    assert (response.peak_floor_force_time <= response.end_time).all()
    without = sm.simulate(scene, motion)
    for name in ("peak_drift", "peak_floor_acceleration", "peak_storey_shear", "peak_slip", "residual_drift"):
        np.testing.assert_allclose(getattr(response, name), getattr(without, name), rtol=1e-8, atol=1e-12)


def test_goods_that_stay_move_with_their_floor() -> None:
    building = sm.Building.uniform(3, 0.4, mass=1e5)
    scene = sm.Scene(building, sm.blocks_on_floors([0.5, 0.2, 0.0], mu=5.0))
    response = sm.simulate(scene, random_run(1)[1], floor_force=True)
    expected = building.mass * [1.5, 1.2, 1.0] * response.peak_floor_acceleration
    np.testing.assert_allclose(response.peak_floor_force, expected, rtol=1e-12)
    np.testing.assert_allclose(response.peak_floor_force_time, response.peak_floor_acceleration_time, rtol=1e-12)


def test_batches_have_them_where_they_are_asked_for() -> None:
    building = sm.Building.uniform(2, 0.3, mass=1e5, yield_shear_over_weight=[0.2, 0.12])
    grid = sm.Grid.product(building, roof="bare", mass_ratio=[0.5, 1.0], mu=[0.1, 0.4])
    motion = random_run(1)[1]
    assert "peak_floor_force" not in sm.simulate_many(grid, motion).columns
    for peaks_only in (False, True):
        table = sm.simulate_many(grid, motion, floor_force=True, peaks_only=peaks_only)
        for number, forces_of_run in enumerate(table["peak_floor_force"].to_list(), start=1):
            alone = sm.simulate(grid.scene(number), motion, floor_force=True)
            np.testing.assert_allclose(forces_of_run, alone.peak_floor_force, rtol=1e-10)


def test_they_are_refused_where_no_chain_is_solved() -> None:
    building = sm.Building.uniform(2, 0.3)
    motion = random_run(1)[1]
    plane = sm.Scene(building, other_direction=True)
    for call in (
        lambda: sm.simulate(plane, (motion, motion), floor_force=True),
        lambda: sm.simulate_many([plane], [(motion, motion)], floor_force=True),
    ):
        with pytest.raises(sm.errors.InvalidOption, match=r"floor_force of (simulate|batch) must be left out"):
            call()
    with pytest.raises(sm.errors.InvalidOption, match="floor_force of simulate must be asked for"):
        _ = sm.simulate(sm.Scene(building), motion).peak_floor_force
