"""The effective fraction in two directions, against cases that reduce to one."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm

RECORDS = [record.scaled(2.0) for record in sm.builtin_suite("seven")][:3]
BUILDING = sm.Building.uniform(2, 0.5, mass=1e4, yield_shear_over_weight=[0.3, 0.2])
SHARES = np.linspace(0.0, 1.0, 11)


def scene(mu: float, *, plane: bool = True) -> sm.Scene:
    return sm.Scene(BUILDING, sm.blocks_on_floors([0.5, 0.5], mu=mu), other_direction=plane)


def answer(of: sm.Scene, motions: list[object], **chosen: object) -> sm.EffectiveMass:
    return sm.effective_mass(of, motions, fractions=SHARES, resamples=10, **chosen)  # type: ignore[arg-type]


def test_without_motion_in_y_it_is_that_of_one_direction() -> None:
    still = [(record.motion, sm.Motion(np.zeros(record.samples), record.dt)) for record in RECORDS]
    expected = answer(scene(0.2, plane=False), list(RECORDS))
    for drift in ("x", "larger"):
        found = answer(scene(0.2), list(still), drift=drift)
        # Two engines that agree to 1e-12 of peaks; a root moves by that over the slope of the curve, about 0.3.
        assert found.value == pytest.approx(expected.value, abs=1e-10)
        assert (found.kind, found.collapses) == (expected.kind, expected.collapses)


def test_a_design_of_two_buildings_is_solved_in_both_directions() -> None:
    def design(share: float) -> sm.Building:
        return BUILDING.replace(yield_shear=(1.0 + 0.5 * share) * BUILDING.yield_shear)

    still = [(record.motion, sm.Motion(np.zeros(record.samples), record.dt)) for record in RECORDS]
    goods, chosen = sm.blocks_on_floors([0.5, 0.5], mu=0.2), {"fractions": SHARES, "resamples": 10}
    expected = sm.effective_mass_of_design(design, goods, list(RECORDS), **chosen)
    found = sm.effective_mass_of_design(lambda share: (design(share), design(share)), goods, list(still), **chosen)
    assert 0.0 < expected.value < 1.0
    assert found.value == pytest.approx(expected.value, abs=1e-10)


def test_along_the_diagonal_friction_is_shared_by_both_directions() -> None:
    """Equal motions and springs in x and y: in each the run of one direction with mu over the root of two.

    Friction points along the diagonal, so that its share in x is mu N / sqrt(2); springs act in x and y by themselves.
    """
    both = [(record.motion, record.motion) for record in RECORDS]
    expected = answer(scene(0.2 / np.sqrt(2.0), plane=False), list(RECORDS))
    for drift in ("x", "vector"):
        found = answer(scene(0.2), list(both), drift=drift)
        assert found.value == pytest.approx(expected.value, abs=1e-10)
    assert found.real == pytest.approx(np.sqrt(2.0) * expected.real, rel=1e-11)
    assert found.metadata["drift"] == "vector"


def test_the_direction_chosen_is_solved_with_its_own_building() -> None:
    stiff = sm.Building.uniform(2, 0.3, mass=1e4, yield_shear_over_weight=[0.3, 0.2])
    held = sm.Scene(BUILDING, sm.blocks_on_floors([0.5, 0.5], mu=9.0), other_direction=stiff)
    pairs = [(record.motion, record.motion) for record in RECORDS]
    x, y = (answer(held, list(pairs), drift=drift) for drift in ("x", "y"))
    alone = [answer(sm.Scene(one, held.blocks), list(RECORDS)) for one in (BUILDING, stiff)]
    # Goods that never slide: value 1, and the drift of each direction is that of its building.
    assert (x.value, y.value, x.kind) == (1.0, 1.0, "stuck")
    assert [x.real, y.real] == pytest.approx([one.real for one in alone], rel=1e-11)
    assert [x.by_hand.period, y.by_hand.period] == pytest.approx([0.5, 0.3], rel=1e-12)
    larger = answer(held, list(pairs))
    assert larger.real >= max(x.real, y.real) * (1.0 - 1e-12)
    with pytest.raises(sm.errors.InvalidOption, match="drift of effective mass must be one of larger, vector, x, y"):
        answer(held, list(pairs), drift="diagonal")
