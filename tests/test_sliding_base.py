"""Sliding bases: `SlidingBase`, `[base]` of scene files, and what a response has of them."""

from __future__ import annotations

import os
import pickle
from pathlib import Path

import numpy as np
import pytest

import seismass as sm

SHARED = os.environ.get("SEISMASS_SHARED", "")
PULSE = sm.Motion(np.concatenate([np.full(40, 4.0), np.zeros(200)]), 0.01)


def building(**options) -> sm.Building:
    return sm.Building([1000.0, 1200.0], [4e5, 3e5], **options)


def test_a_slab_alone_is_a_block_on_the_ground() -> None:
    """Newmark's sliding block, whatever the mass."""
    slab = sm.simulate(sm.Scene(None, base=sm.SlidingBase(0.1, mass=500.0)), PULSE, histories=True)
    block = sm.simulate(sm.Scene(None, [sm.Block(0, mass=70.0, mu=0.1)]), PULSE, histories=True)
    assert slab.peak_base_slip == pytest.approx(block.peak_slip[0], rel=1e-13)
    assert slab.residual_base_slip == pytest.approx(block.residual_slip[0], rel=1e-13)
    assert slab.base_slip_path == pytest.approx(block.slip_path[0], rel=1e-13)
    assert np.allclose(slab.base_slip, block.slip[:, 0], rtol=1e-12, atol=1e-15)
    assert slab.events["kind"].to_list() == block.events["kind"].to_list()
    assert set(slab.events["number"]) == {0}
    assert len(slab.peak_drift) == len(slab.peak_slip) == 0


def with_spring_below(above: sm.Building, mu: float, slope: float) -> sm.Building:
    """A building of the chain engine whose storey 1 stands for the base: mu W at 1e-9 m, then a slope (N/m)."""
    first, sliding = 1e-9, mu * (300e3 + float(above.mass.sum())) * sm.STANDARD_GRAVITY
    springs = [[[first, sliding], [1.0, sliding + slope * (1.0 - first)]], *[[[0.1, 0.1 * k]] for k in above.stiffness]]
    relative = np.hstack([-np.ones((3, 1)), np.eye(3)])
    damping = relative.T @ above.damping_matrix @ relative
    return sm.Building([300e3, *above.mass], None, backbone=springs, damping=damping)


@pytest.mark.skipif(not SHARED, reason="SEISMASS_SHARED is not set: no recordings")
def test_a_mat_below_three_storeys() -> None:
    """A spring that yields at 1e-9 m in place of the base: its error goes with that length, 6.5e-6 here.

    An integrator of small steps has the same to its digits: 47.15 mm without damping; 37.67 mm and 3.43 mm of storey
    drift with 2 % in the modes of the structure fixed at its base.
    """
    record = sm.read_record(
        Path(SHARED) / "records/06_Imperial_Valley_1940_El_Centro_Array_9/RSN6_IMPVALL.I_I-ELC180-hor1.AT2"
    )
    for damping, slip in ((0.0, 47.15), (0.02, 37.67)):
        above = sm.Building([250e3] * 3, [4e8] * 3, damping=damping)
        exact = sm.simulate(sm.Scene(above, base=sm.SlidingBase(0.08, mass=300e3)), record)
        found = sm.simulate(sm.Scene(with_spring_below(above, 0.08, 0.0)), record)
        assert exact.peak_base_slip == pytest.approx(found.peak_drift[0], rel=1e-5)
        assert exact.peak_drift == pytest.approx(found.peak_drift[1:], rel=1e-5)
        assert 1e3 * exact.peak_base_slip == pytest.approx(slip, abs=5e-3)
    assert 1e3 * exact.peak_drift[0] == pytest.approx(3.43, abs=5e-3)


@pytest.mark.skipif(not SHARED, reason="SEISMASS_SHARED is not set: no recordings")
def test_a_friction_pendulum_below_three_storeys() -> None:
    """The same spring with the slope W/R; its drifts have an error that goes with the root of its length, 1.3e-4."""
    record = sm.read_record(Path(SHARED) / "records/02_Loma_Prieta_1989_Gilroy_Array_3/RSN767_LOMAP_G03000.AT2")
    above = sm.Building([250e3] * 3, [4e8] * 3, damping=0.02)
    base = sm.SlidingBase(0.06, radius=1.5, mass=300e3)
    exact = sm.simulate(sm.Scene(above, base=base), record)
    found = sm.simulate(sm.Scene(with_spring_below(above, 0.06, (300e3 + 750e3) * sm.STANDARD_GRAVITY / 1.5)), record)
    assert exact.peak_base_slip == pytest.approx(found.peak_drift[0], rel=5e-7)
    assert exact.peak_drift == pytest.approx(found.peak_drift[1:], rel=2e-4)


def test_goods_and_racks_on_floor_0_stand_on_the_slab() -> None:
    """Held by enough friction they are mass of the slab."""
    goods = [sm.Block(0, mass=400.0, mu=5.0)]
    carried = sm.simulate(sm.Scene(building(), goods, base=sm.SlidingBase(0.1, mass=600.0)), PULSE)
    heavier = sm.simulate(sm.Scene(building(), base=sm.SlidingBase(0.1, mass=1000.0)), PULSE)
    assert carried.peak_base_slip == pytest.approx(heavier.peak_base_slip, rel=1e-12)
    assert carried.peak_slip[0] == 0.0
    rack = sm.Rack(0, 2, period=0.3, level_mass=50.0)
    racked = sm.simulate(sm.Scene(building(), racks=[rack], base=sm.SlidingBase(0.1)), PULSE, energy=True)
    assert racked.peak_rack_drift[0][0] > 0.0
    assert abs(racked.energy["relative_residual"]) < 1e-12


def test_the_slab_has_the_mass_of_floor_1_by_default() -> None:
    default, stated = sm.SlidingBase(0.1), sm.SlidingBase(0.1, mass=1000.0)
    one, other = (sm.simulate(sm.Scene(building(), base=base), PULSE) for base in (default, stated))
    assert one.peak_base_slip == other.peak_base_slip > 0.0
    unstated = sm.Scene(sm.Building.uniform(2, 0.4), base=sm.SlidingBase(0.1, mass_ratio=0.5))
    assert sm.simulate(unstated, PULSE).peak_base_slip > 0.0


def test_values_are_copied_compared_and_pickled() -> None:
    base = sm.SlidingBase(mu_s=0.1, mu_k=0.08, radius=2.0)
    assert repr(base) == "SlidingBase(mu_s=0.1, mu_k=0.08, radius=2)"
    scene = sm.Scene(building(), base=base)
    assert scene.engine == "general"
    assert pickle.loads(pickle.dumps(scene)) == scene != scene.replace(base=None)
    assert scene.replace(base=None).engine == "chain"
    response = sm.simulate(scene, PULSE, histories=True, energy=True)
    assert pickle.loads(pickle.dumps(response)) == response


def test_a_scene_file_has_a_base(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    text = """
[building]
mass = [1000.0, 1200.0]
stiffness = [4e5, 3e5]
[base]
mu_s = 0.05
mu_k = 0.04
radius = 2.0
mass_ratio = 0.8
[motion]
builtin = "synthetic-1"
"""
    path.write_text(text)
    file = sm.read_scene(path)
    assert file.scene.base == sm.SlidingBase(mu_s=0.05, mu_k=0.04, radius=2.0, mass_ratio=0.8)
    response = sm.simulate(file.scene, file.motion)
    assert "base      mu 0.05/0.04, radius 2 m: peak slip" in response.text
    assert response.to_dict()["peak_base_slip"] == response.peak_base_slip > 0.0
    path.write_text(text.replace("mass_ratio = 0.8", "stiffness = 1.0"))
    with pytest.raises(sm.errors.InvalidSceneFile, match="stiffness"):
        sm.read_scene(path)


def test_what_is_no_base_is_refused() -> None:
    for options, message in (
        ({}, "mu of base must be given, or mu_s; got neither"),
        ({"mu": 0.1, "mu_k": 0.1}, "mu of base must be left out where mu_s or mu_k is given"),
        ({"mu": 0.1, "mass": 1.0, "mass_ratio": 1.0}, "mass of base must be given either as mass or as mass_ratio"),
    ):
        with pytest.raises(sm.errors.InvalidScene, match=message):
            sm.SlidingBase(**options)
    for base, message in (
        (sm.SlidingBase(-0.1), "mu_s of base must be finite and not negative; got -0.1"),
        (sm.SlidingBase(mu_s=0.1, mu_k=0.2), "mu_k of base must be at most mu_s = 0.1; got 0.2"),
        (sm.SlidingBase(0.1, radius=0.0), "radius of base must be a positive number"),
        (sm.SlidingBase(0.1, mass=-1.0), "mass of base must be a positive number; got -1"),
        (1.0, "base of scene must be a SlidingBase or None"),
    ):
        with pytest.raises(sm.errors.InvalidScene, match=message):
            sm.Scene(building(), base=base)
    with pytest.raises(sm.errors.InvalidScene, match="mass of base must be given in kg where there is no building"):
        sm.Scene(None, base=sm.SlidingBase(0.1))
    with pytest.raises(sm.errors.InvalidScene, match="base of scene must be given, if peak_base_slip is wanted"):
        _ = sm.simulate(sm.Scene(building()), PULSE).peak_base_slip


def test_what_takes_the_ground_alone_says_so() -> None:
    scene = sm.Scene(building(), [sm.Block(1, mass=500.0, mu=0.2)], base=sm.SlidingBase(0.1))
    for call in (
        lambda: sm.slip.slip_demand(scene, [PULSE], clearance=0.1),
        lambda: sm.animate(scene, PULSE),
    ):
        with pytest.raises(sm.errors.InvalidScene, match=r"base of scene must be left out in .*; simulate takes it"):
            call()
