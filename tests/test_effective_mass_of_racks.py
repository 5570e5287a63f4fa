"""The effective fraction with racks, walls and stops: limits in which it is known, and shares above 1."""

import numpy as np
import pytest

import seismass as sm
from seismass.effective_mass.share import extended, first_bracket

SUITE = [record.scaled(2.0) for record in sm.builtin_suite("seven")[:3]]
STRENGTH = {"yield_shear_over_weight": [0.34, 0.27, 0.13]}
COARSE = {"fractions": np.linspace(0.0, 1.0, 21), "resamples": 200}


def building(**changes) -> sm.Building:
    return sm.Building.uniform(3, 0.47, **(STRENGTH | changes))


def rack(floor: int, period: float, **goods) -> sm.Rack:
    placed = [sm.RackBlock(level, mass_ratio=0.5, **goods) for level in (1, 2)]
    return sm.Rack(floor, levels=2, level_mass_ratio=0.02, period=period, blocks=placed)


def racked(period: float, **goods) -> sm.Scene:
    return sm.Scene(building(), racks=[rack(1, period, **goods), rack(2, period, **goods)])


def test_the_model_lumps_goods_and_frames() -> None:
    """Each floor has its mass, both frames' 0.04 and the share of the goods, 1.0 of its mass each."""
    model = sm.attached_scene(racked(0.5, mu=0.3), 0.25)
    assert model.engine == "chain"
    np.testing.assert_allclose(model.building.mass, [1.29, 1.29, 1.0], rtol=1e-14)
    assert sm.attached_scene(racked(0.5, mu=0.3), 1.5).building.mass[0] == pytest.approx(2.54, rel=1e-14)
    with pytest.raises(sm.errors.InvalidOption, match="must be between 0 and 2"):
        sm.attached_scene(racked(0.5, mu=0.3), 2.5)
    with pytest.raises(sm.errors.InvalidOption, match="must be between 0 and 1"):
        sm.attached_scene(sm.Scene(building(), sm.blocks_on_floors([1, 1, 0], mu=0.3)), 1.5)


def test_a_stiff_rack_is_its_floor() -> None:
    """As the period of a rack goes to 0 its fixed goods are attached: of order (T_rack/T)^2 = 0.005 away from 1."""
    result = sm.effective_mass(racked(0.033, fixed=True), SUITE, **COARSE)
    assert result.value == pytest.approx(1.0, abs=0.005)
    assert result.eta == np.inf
    assert result.to_dict()["eta"] is None


def test_sliding_goods_on_a_stiff_rack_are_those_of_the_floor() -> None:
    """The same limit with goods that slide, beside a building whose floors have the frames' mass."""
    bare = building()
    framed = bare.replace(mass=[1.04, 1.04, 1.0], damping=bare.damping_matrix)
    on_floor = sm.Scene(framed, [sm.Block(floor, mass=1.0, mu=0.2) for floor in (1, 2)])
    on_racks = sm.effective_mass(racked(0.02, mu=0.2), SUITE, **COARSE)
    assert on_racks.kind == "root"
    # (T_rack/T)^2 = 0.0018.
    assert on_racks.value == pytest.approx(sm.effective_mass(on_floor, SUITE, **COARSE).value, abs=2e-3)


def test_racks_may_act_more_than_their_mass() -> None:
    """A rack tuned to the building with fixed goods: the model at the share has the drift of the real building."""
    scene = racked(0.5, fixed=True)
    result = sm.effective_mass(scene, SUITE, **COARSE)
    assert result.kind == "beyond"
    assert result.value > 1.0
    assert result.interval is not None
    assert result.interval[0] <= result.value <= result.interval[1]
    real = np.mean([sm.simulate(scene, motion).peak_drift.max() for motion in SUITE])
    model = sm.attached_scene(scene, result.value)
    assert np.mean([sm.simulate(model, motion).peak_drift.max() for motion in SUITE]) == pytest.approx(real, rel=1e-9)
    assert result.real == pytest.approx(real, rel=1e-14)
    assert "racks or stops pass on more" in result.text
    assert "the rule by hand knows no racks" in result.text
    assert result.suite_interval is not None
    assert result.suite_interval[1] > 1.0


def test_flexible_racks_act_less() -> None:
    """A rack of four times the building's period is nearly isolated."""
    assert sm.effective_mass(racked(2.0, mu=0.37), SUITE, **COARSE).value < 0.3


def test_far_stops_are_none() -> None:
    """Stops beyond the largest slip touch nothing: equal but for rounding between the engines."""
    free = sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.1)
    stopped = [block.replace(stops=sm.Stops(100.0, 1e3)) for block in free]
    without, far = (sm.effective_mass(sm.Scene(building(), blocks), SUITE, **COARSE) for blocks in (free, stopped))
    assert far.value == pytest.approx(without.value, abs=1e-9)
    assert far.eta == pytest.approx(without.eta, rel=1e-12)


def test_near_stops_raise_the_share() -> None:
    """Stops 5 mm away stop goods that slide by centimetres."""
    free = sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.1)
    stopped = [block.replace(stops=sm.Stops(0.005, 3e3)) for block in free]
    without, near = (sm.effective_mass(sm.Scene(building(), blocks), SUITE, **COARSE) for blocks in (free, stopped))
    assert near.value > without.value + 0.1


def test_goods_without_friction_between_stops_count() -> None:
    """Without friction, and without stops, the share is 0 by definition; with stops the blocks push."""
    blocks = [sm.Block(floor, mass_ratio=1.0, mu=0.0, stops=sm.Stops(0.02, 3e3)) for floor in (1, 2)]
    assert sm.effective_mass(sm.Scene(building(), blocks), SUITE, **COARSE).kind != "zero"


def test_goods_on_racks_of_the_ground_are_no_live_load() -> None:
    with pytest.raises(sm.errors.InvalidScene, match="at least one on a floor of the building"):
        sm.effective_mass(sm.Scene(building(), racks=[sm.Rack(0, 1, level_mass=1.0, period=0.3)]), SUITE)


def test_what_takes_shear_buildings_alone_still_says_so() -> None:
    with pytest.raises(sm.errors.InvalidScene, match="racks of scene must be left out"):
        sm.live_load_uncertainty(racked(0.5, mu=0.3), SUITE, mu=sm.distributions.lognormal(0.3, 0.2), occupancy=1.0)


def test_crossings_beyond_one() -> None:
    """A drift that grows as the share: 1.25 of it is reached at 1.25; curves that reach nothing take the last share."""
    shares = np.linspace(1.0, 2.0, 11)
    assert first_bracket(shares, shares, 1.25) == pytest.approx((1.2, 1.3))
    assert first_bracket(shares, shares, 2.5) is None
    model = np.stack([shares, shares, shares])
    found = extended(np.array([0.4, 1.0, 1.0]), shares, model, np.array([0.9, 1.25, 2.5]))
    np.testing.assert_allclose(found, [0.4, 1.25, 2.0], rtol=1e-14)


def test_a_matrix_that_stands_for_springs() -> None:
    """The elastic second storey as a matrix in place of its spring: the same building, so the same fraction.

    Relative to the chain engine by rounding; eta is over the base shear of spring 1, as without the matrix.
    """
    mass, stiffness = [1000.0, 1000.0], [4e5, 3e5]
    strength = [2000.0, np.inf]
    blocks = [sm.Block(floor, mass_ratio=0.8, mu=0.1) for floor in (1, 2)]
    springs = sm.Building(mass, stiffness, yield_shear=strength)
    matrix = [[3e5, -3e5], [-3e5, 3e5]]
    walled = sm.Building(mass, [4e5, 0.0], yield_shear=strength, stiffness_matrix=matrix)
    chain, general = (sm.effective_mass(sm.Scene(each, blocks), SUITE, **COARSE) for each in (springs, walled))
    assert general.value == pytest.approx(chain.value, abs=1e-8)
    assert general.real == pytest.approx(chain.real, rel=1e-11)
    assert general.base_shear_coefficient == pytest.approx(chain.base_shear_coefficient, rel=1e-11)
    assert general.by_hand.period == pytest.approx(chain.by_hand.period, rel=1e-12)
    assert general.kind == "root"
    assert "the rule by hand knows no walls" in general.text


def test_the_base_shear_of_a_wall_counts() -> None:
    """A cantilever without a frame: C1 is the wall's shear at the ground, over the weight."""
    mass = [1e5, 1e5, 1e5]
    wall = sm.design.Wall.of_period(mass, 3.0, 0.5)
    building = sm.Building(mass, 0.0, heights=3.0, stiffness_matrix=wall.stiffness_matrix)
    scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.3))
    result = sm.effective_mass(scene, SUITE, **COARSE)
    model = sm.attached_scene(scene, 1.0)
    shear = np.mean([sm.simulate(model, motion).peak_base_shear for motion in SUITE])
    assert result.base_shear_coefficient == pytest.approx(shear / (5e5 * 9.80665), rel=1e-12)
