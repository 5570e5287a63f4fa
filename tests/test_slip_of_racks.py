"""Slip demand with racks, stops and walls: by level, beside the same goods on the ground; contacts with stops."""

import numpy as np
import pytest

import seismass as sm
from seismass.studies.slip.clearance import places_of, without_loose_goods

BUILDING = sm.Building([1000.0, 1000.0], [4e5, 3e5], yield_shear=[4000.0, 3000.0], heights=[3.4, 2.7])
MOTIONS = [sm.builtin_record(f"synthetic-{number}").with_duration(15.0).scaled(1.5) for number in (1, 2, 3)]


def rack(floor: int, **changes) -> sm.Rack:
    blocks = [
        sm.RackBlock(1, mass_ratio=0.2, mu=0.2),
        sm.RackBlock(2, mass_ratio=0.1, fixed=True),
        sm.RackBlock(2, mass_ratio=0.2, mu=0.15),
    ]
    given = {"level_mass_ratio": 0.03, "period": 0.3, "blocks": blocks}
    return sm.Rack(floor, levels=2, **(given | changes))


def scene() -> sm.Scene:
    blocks = [sm.Block(1, mass_ratio=0.3, mu=0.1), sm.Block(0, mass=10.0, mu=0.1)]
    return sm.Scene(BUILDING, blocks, racks=[rack(2), rack(1, yield_shear_over_weight=0.4)])


def test_places_of_goods() -> None:
    """Ground 0, floors 1 and 2, levels 3 and 4 of the first rack, 5 and 6 of the second; fixed goods have none."""
    found = [(place.floor, place.rack, place.level, place.node) for place in places_of(scene())]
    assert found == [(1, 0, 0, 1), (0, 0, 0, 0), (2, 1, 1, 3), (2, 1, 2, 4), (1, 2, 1, 5), (1, 2, 2, 6)]


def test_models_without_loose_goods() -> None:
    """Springs of the racks stay, whatever their mass; ratios stay the same masses on floors that became heavier."""
    real = scene()
    full, empty = (without_loose_goods(real, attached=attached) for attached in (True, False))
    assert not full.goods
    assert full.building is not None
    assert full.building.mass.tolist() == [1300.0, 1000.0]
    for before, of_full, of_empty in zip(real.racks, full.racks, empty.racks, strict=True):
        floor_mass = real.building.mass[before.floor - 1]
        alone = before.alone(floor_mass)
        with_goods = of_full.alone(full.building.mass[before.floor - 1])
        np.testing.assert_allclose(with_goods.mass, alone.mass, rtol=1e-14)
        for other in (with_goods, of_empty.alone(floor_mass)):
            np.testing.assert_array_equal(other.stiffness, alone.stiffness)
            np.testing.assert_array_equal(other.yield_shear, alone.yield_shear)
        # The frame's 30 kg on each level, and the fixed goods on the second.
        np.testing.assert_allclose(of_empty.alone(floor_mass).mass, [30.0, 130.0], rtol=1e-14)


def test_slip_by_level() -> None:
    """Numbers of the runs, and of the blocks on the ground, each solved by itself."""
    real = scene()
    result = sm.slip.slip_demand(real, MOTIONS, clearance=0.05, sizes=sm.slip.BlockSize(1.0, 0.8), resamples=50)
    assert result.blocks.select("floor", "rack", "level").rows()[2:4] == [(2, 1, 1), (2, 1, 2)]
    assert result.blocks["rack"].to_list() == [0, 0, 1, 1, 2, 2]
    responses = [sm.simulate(real, motion) for motion in MOTIONS]
    np.testing.assert_array_equal(
        result.runs["peak_slip"].to_numpy().reshape(3, 6), np.array([each.peak_slip for each in responses])
    )
    on_ground = sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.15)])
    slip = sm.simulate(on_ground, MOTIONS[1]).peak_slip[0]
    assert result.runs.filter(motion=2, block=4)["ground_slip"].item() == pytest.approx(slip, rel=1e-12)
    of_level = [each.peak_rack_acceleration[0][1] / 9.80665 for each in responses]
    found = result.runs.filter(block=4)["floor_acceleration_g"].to_numpy()
    np.testing.assert_allclose(found, of_level, rtol=1e-14)
    largest = np.maximum(result.runs["slip_plus"].to_numpy(), result.runs["slip_minus"].to_numpy())
    np.testing.assert_array_equal(largest, result.runs["peak_slip"].to_numpy())
    assert result.exceedance.filter(side="any").height == 6
    assert "rack 1.2" in result.text
    assert any("goods on racks slide on their level" in remark for remark in result.remarks)
    assert result.plot() is not None


@pytest.mark.parametrize("mu", [0.5, 0.7, 0.9])
def test_no_slip_below_the_acceleration_of_the_fixed_goods(mu: float) -> None:
    """Some goods slide if and only if mu_s g of some is below the peak of their level with all goods attached."""
    blocks = [sm.RackBlock(level, mass_ratio=0.2, mu=mu) for level in (1, 2)]
    real = sm.Scene(BUILDING, racks=[rack(2, blocks=blocks)])
    runs = sm.slip.slip_demand(real, MOTIONS, resamples=2).runs
    for number in (1, 2, 3):
        of = runs.filter(motion=number)
        assert (of["mu_over_attached"].min() < 1.0) == (of["peak_slip"].max() > 0.0)


def test_contacts_with_stops() -> None:
    """Touches, velocity and force are those of the runs; on the ground goods are free."""
    stops = sm.Stops(0.02, 1e6)
    free = sm.Scene(BUILDING, [sm.Block(2, mass_ratio=0.3, mu=0.1)])
    stopped = sm.Scene(BUILDING, [sm.Block(2, mass_ratio=0.3, mu=0.1, stops=stops)])
    result = sm.slip.slip_demand(stopped, MOTIONS, resamples=50)
    responses = [sm.simulate(stopped, motion) for motion in MOTIONS]
    np.testing.assert_array_equal(result.runs["contact_force"], [each.peak_contact_force[0] for each in responses])
    row = result.blocks.row(0, named=True)
    assert row["touches"] == np.mean([each.counts["touch_stop"] > 0 for each in responses])
    assert row["contact_velocity_largest"] == max(each.peak_contact_velocity[0] for each in responses)
    without = sm.slip.slip_demand(free, MOTIONS, resamples=50)
    assert result.blocks["ground_mean"].item() == without.blocks["ground_mean"].item()
    assert "touches" not in without.blocks.columns
    assert "Stops" in result.text


def test_racks_on_the_ground_alone() -> None:
    """A rack without a building: the motion of its levels is that of a chain of the same springs."""
    blocks = [sm.RackBlock(level, mass=100.0, mu=0.2) for level in (1, 2)]
    alone = sm.Rack(0, levels=2, level_mass=20.0, stiffness=2e4, blocks=blocks)
    result = sm.slip.slip_demand(sm.Scene(None, racks=[alone]), MOTIONS, resamples=2)
    # The ratio of a rack is in its modes with all goods attached.
    damping = sm.Building([120.0, 120.0], 2e4, damping=0.03).damping_matrix
    building = sm.Building([20.0, 20.0], 2e4, damping=damping)
    chain = sm.Scene(building, [sm.Block(floor, mass=100.0, mu=0.2) for floor in (1, 2)])
    assert result.blocks["level"].to_list() == [1, 2]
    # By two engines, exact but for rounding.
    assert result.blocks["mean"].to_numpy() == pytest.approx(
        sm.slip.slip_demand(chain, MOTIONS, resamples=2).blocks["mean"].to_numpy(), rel=1e-9
    )


def test_fragilities_are_refused_by_name() -> None:
    with pytest.raises(sm.errors.InvalidScene, match="racks of scene must be left out"):
        sm.slip.slip_demand(scene(), MOTIONS, clearance=0.05, fragility=True)
    with pytest.raises(sm.errors.InvalidScene, match="blocks of slip demand must be at least one"):
        sm.slip.slip_demand(sm.Scene(BUILDING, racks=[rack(1, blocks=[])]), MOTIONS)
