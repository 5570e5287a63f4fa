"""Spring laws and wear of friction as they are solved: loops, free vibration and slip against closed forms by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import seismass as sm

K, V_Y = 1e6, 1e4
"""Stiffness (N/m) and yield shear (N) of the storeys: yield drift 0.01 m."""
POINTS = [(0.01, 60e3), (0.03, 90e3), (0.08, 100e3)]
PEAK: dict[str, Any] = {"yield_shear": V_Y, "overstrength": 1.0, "second_slope": 0.0, "hysteresis": "peak-oriented"}
AT_REST = sm.Motion(np.zeros(201), dt=0.01)


def storey(**arguments: Any) -> sm.Building:
    """A building of one storey."""
    return sm.Building(1e3, **({"stiffness": K} | arguments))


def forces(building: sm.Building, *drifts: float) -> list[float]:
    return sm.runs.spring_forces(building, 1, drifts).force.tolist()


def test_multilinear_loop_is_masing() -> None:
    building = storey(stiffness=None, backbone=POINTS)
    # Up to 0.05 m: 90 + (100 - 90)/(0.08 - 0.03) 0.02 kN; back along twice the backbone: 94 - 2 F(d/2), d the way back.
    found = forces(building, 0.005, 0.05, 0.03, -0.01, -0.05, 0.05)
    assert found == pytest.approx([30e3, 94e3, -26e3, -86e3, -94e3, 94e3], rel=1e-12)
    # Area of a closed Masing loop of amplitude A: 8 times that below the backbone, 3640 J to 0.05 m, less 4 A F(A).
    path = sm.runs.spring_forces(building, 1, [0.05, -0.05, 0.05])
    assert path.dissipated[2] - path.dissipated[0] == pytest.approx(8 * 3640.0 - 4 * 0.05 * 94e3, rel=1e-12)
    assert path.stored[0] + path.dissipated[0] == pytest.approx(3640.0, rel=1e-12)


def test_a_stop_acts_beyond_its_clearance_on_both_sides() -> None:
    building = storey(clearance=0.01, stop_stiffness=4e6)
    path = sm.runs.spring_forces(building, 1, [0.01, 0.02, 0.0, -0.02])
    assert path.force.tolist() == pytest.approx([1e4, 6e4, 0.0, -6e4], abs=1e-9)  # k d + k_s (|d| - c)
    assert path.events["kind"].to_list() == ["close", "open", "close"]
    assert path.events["sign"].to_list() == [1, 1, -1]
    assert path.events["drift_number"].to_list() == [2, 3, 4]
    assert path.dissipated.tolist() == pytest.approx([0.0] * 4, abs=1e-9)
    assert path.stored[1] == pytest.approx(0.5 * K * 0.02**2 + 0.5 * 4e6 * 0.01**2, rel=1e-12)


def test_free_vibration_between_stops_has_its_period() -> None:
    """Undamped, from rest at drift 0 with a velocity: arcs of two sines, joined where the stop touches."""
    mass, stop, clearance, velocity = 1e3, 4e6, 0.01, 1.0
    building = sm.Building(mass, K, clearance=clearance, stop_stiffness=stop, damping=0.0)
    w1, w2 = math.sqrt(K / mass), math.sqrt((K + stop) / mass)
    to_stop = math.asin(clearance * w1 / velocity) / w1
    at_stop = math.sqrt(velocity**2 - (w1 * clearance) ** 2)
    beside = K * clearance / (K + stop)  # drift at the stop from the equilibrium that spring and stop have together
    to_peak = math.atan2(at_stop, w2 * beside) / w2
    period = 4.0 * (to_stop + to_peak)
    response = sm.simulate(sm.Scene(building, initial_velocity=velocity), AT_REST, energy=True)
    closes = response.events.filter(kind="close")
    assert response.peak_drift_time[0] % (period / 2) == pytest.approx(to_stop + to_peak, rel=1e-9)
    assert closes["time"].to_numpy() == pytest.approx(to_stop + 0.5 * period * np.arange(len(closes)), rel=1e-9)
    assert len(closes) == 1 + int((AT_REST.duration - to_stop) // (0.5 * period))
    assert closes["sign"].to_list()[:3] == [1, -1, 1]
    assert response.counts["open"] in (len(closes), len(closes) - 1)
    # Energy of the peak is that of the start.
    peak = response.peak_drift[0]
    assert 0.5 * K * peak**2 + 0.5 * stop * (peak - clearance) ** 2 == pytest.approx(
        0.5 * mass * velocity**2, rel=1e-12
    )
    assert abs(response.energy["relative_residual"]) < 1e-12


def test_peak_oriented_loop_aims_at_the_largest_drifts() -> None:
    # Unloading with k from (0.03, 1e4) to zero at 0.02; to the virgin yield point (-0.01, -1e4); from -0.02 unloading
    # to zero at -0.01; to (0.03, 1e4).
    path = sm.runs.spring_forces(storey(**PEAK), 1, [0.03, 0.025, 0.0, -0.02, -0.01, 0.01, 0.03])
    assert path.force.tolist() == pytest.approx([1e4, 5e3, -2e4 / 3.0, -1e4, 0.0, 5e3, 1e4], abs=1e-8)
    assert path.events["kind"].to_list()[:4] == ["yield", "unload", "reload", "yield"]


def test_takeda_unloading_is_softer() -> None:
    # k (d_y/d_max)^a = 1e6 (0.01/0.04)^0.5 = 5e5 N/m from (0.04, 1e4): zero at 0.02.
    found = forces(storey(**PEAK, unloading_exponent=0.5), 0.04, 0.03, 0.02)
    assert found == pytest.approx([1e4, 5e3, 0.0], abs=1e-8)


def test_softening_ends_at_the_residual_strength() -> None:
    # Second yield at 15 kN and 0.01 + 5 kN/(0.1 k) = 0.06 m; then -0.2 k to half of V_y at 0.06 + 10 kN/(0.2 k) =
    # 0.11 m.
    softening = PEAK | {"overstrength": 1.5, "second_slope": 0.1, "third_slope": -0.2, "residual_strength": 0.5}
    found = forces(storey(**softening), 0.035, 0.06, 0.08, 0.11, 0.2)
    assert found == pytest.approx([12.5e3, 15e3, 11e3, 5e3, 5e3], rel=1e-12)


def test_strength_is_lost_by_the_energy_of_half_cycles() -> None:
    # The first half cycle dissipates 200 J of 10 V_y d_y = 1000 J: the next aims at V_y (1 - 200/(1000 - 200)), 7.5 kN.
    found = sm.runs.spring_forces(storey(**PEAK, energy_capacity=10.0), 1, [0.03, 0.02, 0.0])
    assert found.dissipated[1] == pytest.approx(200.0, rel=1e-12)
    assert found.force[2] == pytest.approx(-7.5e3 * 0.02 / 0.03, rel=1e-12)


def test_flag_shaped_loop_comes_back_to_the_origin() -> None:
    # Slopes k and 0.1 k; unloading falls by 0.6 V_y and 0.6 d_y to the line through (0.004, 4e3).
    building = storey(yield_shear=V_Y, second_slope=0.1, hysteresis="flag-shaped", flag_height=0.6)
    path = sm.runs.spring_forces(building, 1, [0.01, 0.03, 0.024, 0.014, 0.017, 0.024, 0.0, -0.03, 0.0])
    assert path.force.tolist() == pytest.approx([1e4, 12e3, 6e3, 5e3, 8e3, 11.4e3, 0.0, -12e3, 0.0], abs=1e-8)
    kinds = ["yield", "unload", "yield", "reload", "yield", "unload", "yield", "unload"]
    assert path.events["kind"].to_list() == [*kinds, "yield", "unload", "yield", "unload"]
    assert path.events["element"].to_list()[:8] == [1, None, 2, None, 1, None, 2, None]
    # The lines are beta (1 - r2) V_y apart: 5.4 kN over 0.02, 0.004 and 0.02 m of the upper ones.
    assert path.dissipated[-1] == pytest.approx(5.4e3 * 0.044, rel=1e-12)
    assert path.stored[-1] == pytest.approx(0.0, abs=1e-9)
    # With beta = 0 there is one line, and nothing is lost.
    line = sm.runs.spring_forces(building.replace(flag_height=0.0), 1, [0.03, 0.02, 0.03, -0.03])
    assert line.force.tolist() == pytest.approx([12e3, 11e3, 12e3, -12e3], rel=1e-12)
    assert line.dissipated[-1] == 0.0


def test_friction_changes_with_the_slip_path() -> None:
    """A block on ground of constant acceleration: its relative acceleration is constant in each stage."""
    acceleration, g = 5.0, sm.STANDARD_GRAVITY
    block = sm.Block(0, mass=10.0, mu_s=0.35, mu_k=0.3, wear=[(0.05, 0.25, 0.2)])
    response = sm.simulate(sm.Scene(None, [block]), sm.Motion(np.full(101, acceleration), dt=0.01))
    first, second = acceleration - 0.3 * g, acceleration - 0.2 * g
    at = math.sqrt(2.0 * 0.05 / first)
    (wear,) = response.events.filter(kind="wear").iter_rows(named=True)
    assert wear["time"] == pytest.approx(at, rel=1e-12)
    assert (wear["number"], wear["element"], wear["sign"]) == (1, 1, -1)  # the block falls behind the ground
    rest = 1.0 - at
    assert response.peak_slip[0] == pytest.approx(0.05 + first * at * rest + 0.5 * second * rest**2, rel=1e-12)
    assert response.counts["wear"] == 1


def test_spring_paths_are_refused_by_name() -> None:
    building = storey()
    for arguments, message in (
        ((None, 1, [0.0]), "building of spring path must be a Building; got None"),
        ((building, 2, [0.0]), "storey of spring path must be the number of a storey, counted from 1 to 1; got 2"),
        ((building, 0, [0.0]), "storey of spring path must be a whole number of at least 1; got 0"),
        ((building, 1, 0.0), "drifts of spring path must be a list of numbers; got 0.0"),
        ((building, 1, [0.0, math.nan]), "drift of entry 2 of the path must be a finite number; got NaN"),
    ):
        with pytest.raises(sm.errors.InvalidOption, match=f"^{message}"):
            sm.runs.spring_forces(*arguments)
