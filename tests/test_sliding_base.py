"""Sliding bases: `SlidingBase`, `[base]` of scene files, and what a response has of them."""

from __future__ import annotations

import base64
import os
import pickle
from pathlib import Path

import numpy as np
import pytest

import seismass as sm
from seismass.show.animation.html import element_content
from seismass.show.animation.picture import SCENES, SLAB, Picture

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


def test_histories_of_the_slab_belong_together() -> None:
    """Its velocity is the rate of its slip, its acceleration that of its velocity and the ground, between samples where
    nothing happens."""
    response = sm.simulate(ON_BASE, PULSE, histories=True)
    change = np.diff(response.base_slip)
    between = 0.5 * (response.base_velocity[1:] + response.base_velocity[:-1]) * PULSE.dt
    # The trapezoidal rule misses dt^2/12 of a change of acceleration, here by up to the peak of the ground.
    assert change == pytest.approx(between, abs=PULSE.dt**2 * PULSE.pga / 8.0)
    assert np.abs(response.base_velocity).max() > 0.1
    relative = response.base_acceleration - PULSE.acceleration
    of_rate = 0.5 * (relative[1:] + relative[:-1]) * PULSE.dt
    assert np.median(np.abs(np.diff(response.base_velocity) - of_rate)) < 1e-4
    assert 0.9 < np.abs(response.base_acceleration).max() / response.peak_base_acceleration <= 1.0
    with pytest.raises(sm.errors.InvalidOption, match="base_velocity is wanted"):
        _ = sm.simulate(ON_BASE, PULSE, histories=True, displacements_only=True).base_velocity


ON_BASE = sm.Scene(
    building(),
    [sm.Block(0, mass=300.0, mu=0.05), sm.Block(1, mass=500.0, mu=0.1), sm.Block(2, mass=400.0, mu=0.15)],
    base=sm.SlidingBase(0.12, mass=700.0),
)


def test_slip_on_a_base_that_never_slides_is_slip_on_the_ground() -> None:
    held, fixed = (
        sm.slip.slip_demand(ON_BASE.replace(base=base), [PULSE, PULSE.scaled(1.5)], clearance=0.1)
        for base in (sm.SlidingBase(50.0, mass=700.0), None)
    )
    for one, other in ((held.blocks, fixed.blocks), (held.runs, fixed.runs), (held.exceedance, fixed.exceedance)):
        assert one.columns == other.columns
        for name in one.columns:
            if one[name].dtype.is_float():
                assert one[name].to_numpy() == pytest.approx(other[name].to_numpy(), rel=1e-9, nan_ok=True), name
            else:
                assert one[name].to_list() == other[name].to_list(), name
    assert not any("slab" in remark for remark in fixed.remarks)
    assert any(remark.startswith("floor 0 is the slab of the sliding base") for remark in held.remarks)


def test_models_on_a_base_and_with_racks_have_the_damping_of_the_building() -> None:
    for scene in (ON_BASE, ON_BASE.replace(base=None, racks=[RACK])):
        with pytest.raises(
            sm.errors.InvalidOption, match="damping of slip demand must be 'same' with racks or a sliding base"
        ):
            sm.slip.slip_demand(scene, [PULSE], damping="ratio")


def test_slip_on_a_base_is_that_of_the_run() -> None:
    found = sm.slip.slip_demand(ON_BASE, [PULSE], clearance=0.1)
    run = sm.simulate(ON_BASE, PULSE, histories=True)
    assert found.runs["peak_slip"].to_list() == run.peak_slip.tolist()
    sides = found.runs.select("slip_plus", "slip_minus").to_numpy()
    assert sides.max(axis=1).tolist() == run.peak_slip.tolist()
    assert sides[:, 0] == pytest.approx(np.maximum(run.slip.max(axis=0), 0.0), abs=1e-4)
    assert sides[:, 1] == pytest.approx(np.maximum(-run.slip.min(axis=0), 0.0), abs=1e-4)
    assert "  1, slab " in found.text
    assert "  2, floor 1 " in found.text
    assert "1, ground " not in found.text
    on_slab = found.runs.row(0, named=True)
    assert on_slab["floor_acceleration_g"] * sm.STANDARD_GRAVITY == pytest.approx(run.peak_base_acceleration)
    assert on_slab["floor_velocity"] == pytest.approx(np.abs(run.base_velocity + run.ground_velocity).max())


RACK = sm.Rack(1, 2, period=0.3, level_mass=60.0, blocks=[sm.RackBlock(2, mass=90.0, mu=9.0)])


@pytest.mark.parametrize("racks", [(), (RACK,)])
@pytest.mark.parametrize("fixed", [None, [250.0, 100.0]])
@pytest.mark.parametrize("base", [ON_BASE.base, None])
def test_goods_slide_where_they_would_if_all_were_attached(
    racks: tuple[sm.Rack, ...], fixed: list[float] | None, base: sm.SlidingBase | None
) -> None:
    """Nothing slides just above the acceleration of the model with all goods attached; just below something does."""
    blocks = [block.replace(mu=9.0, mu_s=None, mu_k=None) for block in ON_BASE.blocks]
    bound = ON_BASE.replace(blocks=blocks, racks=racks, fixed_goods=fixed, base=base)
    attached = sm.slip.slip_demand(bound, [PULSE]).runs["attached_acceleration_g"].to_list()
    assert sm.simulate(bound, PULSE).peak_slip.max() == 0.0
    for number, block in enumerate(bound.blocks):
        for factor, slides in ((1.0 + 1e-6, False), (1.0 - 1e-6, True)):
            blocks = list(bound.blocks)
            blocks[number] = block.replace(mu=factor * attached[number], mu_s=None, mu_k=None)
            assert (sm.simulate(bound.replace(blocks=blocks), PULSE).peak_slip[number] > 0.0) == slides


def test_an_animation_shows_the_slab() -> None:
    animation = sm.animate(ON_BASE, PULSE, fraction=0.25)
    run, model = animation.shown.runs
    assert np.abs(run.base_slip).max() == pytest.approx(run.response.peak_base_slip, rel=0.02)
    assert np.abs(model.base_slip).max() > 0.0
    above = run.floor_displacement - np.cumsum(run.response.drift[: run.rows], axis=1)
    assert above == pytest.approx(np.column_stack([run.base_slip] * 2), abs=1e-15)
    assert f"the slab slides by up to {1e3 * run.response.peak_base_slip:.3g} mm" in animation.sentences[0]
    content = element_content(animation)["data"]
    events = content["runs"][0]["events"]
    kinds = [content["kinds"][kind] for kind in base64.b64decode(events["kind"])]
    numbers = np.frombuffer(base64.b64decode(events["number"]), dtype="<u2")
    assert "slip" in kinds
    assert 0 in run.response.event_log["number"]
    assert numbers.min() > 0
    assert '"base":{"peak":' in animation.html()
    firm = sm.animate(ON_BASE.replace(base=None), PULSE, fraction=0.25)
    assert '"base":{' not in firm.html()
    alone = sm.animate(sm.Scene(None, [sm.Block(0, mass=50.0, mu=0.2)], base=ON_BASE.base), PULSE)
    assert alone.sentences[0].startswith("Blocks on the slab (goods slide): ")


def test_frames_move_the_slab() -> None:
    """Its pixels, in the lowest row of slabs, where the base slips the farthest, and before anything moves."""
    animation = sm.animate(ON_BASE, PULSE, fraction=0.25)
    picture, run = Picture(animation), animation.shown.runs[0]
    places = []
    for row in (0, int(np.argmax(np.abs(run.base_slip)))):
        frame = np.asarray(picture.frame(row * animation.shown.step).convert("RGB"))[SCENES - 22, :360]
        columns = np.flatnonzero((frame == tuple(bytes.fromhex(SLAB[1:]))).all(axis=1))
        places.append(0.5 * (columns.min() + columns.max()))
    scale = (places[1] - places[0]) / run.base_slip[int(np.argmax(np.abs(run.base_slip)))]
    assert scale > 0.0
    assert abs(places[1] - places[0]) > 10.0
