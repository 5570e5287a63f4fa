"""Building, Block, Scene: broadcasting, derived quantities, immutability, comparison, pickling."""

from __future__ import annotations

import copy
import math
import pickle

import numpy as np
import pytest

import seismass as sm


def building(**changes: object) -> sm.Building:
    arguments: dict[str, object] = {"mass": [1000.0, 800.0, 600.0], "stiffness": 5e5, "yield_shear": [7e3, 5e3, 3e3]}
    return sm.Building(**(arguments | changes))  # type: ignore[arg-type]


def test_one_number_stands_for_all_storeys() -> None:
    one = building()
    assert one.storeys == 3
    assert one.stiffness.tolist() == [5e5] * 3
    assert one.overstrength.tolist() == [2.0] * 3
    assert one == building(stiffness=[5e5] * 3, overstrength=2, second_slope=[0.05] * 3)


def test_the_first_list_gives_the_number_of_storeys() -> None:
    assert sm.Building(1000.0, 5e5, yield_shear=[1e3, 2e3]).storeys == 2
    assert sm.Building(1000.0, 5e5).storeys == 1


def test_uniform_building_has_its_first_period() -> None:
    # T_j of a uniform shear building: w_j = 2 sqrt(k/m) sin((2j - 1) pi / (2 (2n + 1))).
    uniform = sm.Building.uniform(4, 0.57, mass=2000.0)
    j = np.arange(1, 5)
    sines = np.sin((2 * j - 1) * np.pi / 18)
    assert uniform.periods == pytest.approx(0.57 * sines[0] / sines, rel=1e-14)
    assert uniform.weight == pytest.approx(4 * 2000.0 * 9.80665, rel=1e-15)


def test_yield_shear_over_weight_is_of_the_bare_building() -> None:
    uniform = sm.Building.uniform(3, 0.6, mass=1000.0, yield_shear_over_weight=[0.24, 0.2, math.inf])
    assert uniform.yield_shear == pytest.approx([0.24 * 29419.95, 0.2 * 29419.95, math.inf])


def test_mass_matters_where_something_is_given_in_other_than_ratios() -> None:
    """Exactly as the docstring of Building.uniform says."""
    motion = sm.Motion(4.0 * np.sin(0.2 * np.arange(200)), 0.01)

    def peaks(mass: float, block: sm.Block | None = None, **given: object) -> np.ndarray:
        one = sm.Building.uniform(2, 0.3, mass=mass, **given)  # type: ignore[arg-type]
        response = sm.simulate(sm.Scene(one, [block or sm.Block(1, mass_ratio=1.0, mu=0.2)]), motion)
        return np.append(response.peak_drift, response.peak_slip)

    strong = {"yield_shear_over_weight": [0.2, 0.1]}
    # Rounding alone, amplified by yielding and sliding.
    assert peaks(1.0) == pytest.approx(peaks(2000.0), rel=1e-11)
    assert peaks(1.0, **strong) == pytest.approx(peaks(2000.0, **strong), rel=1e-11)
    rayleigh = strong | {"damping": sm.Rayleigh(0.03)}
    assert peaks(1.0, **rayleigh) == pytest.approx(peaks(2000.0, **rayleigh), rel=1e-11)
    for newtons in (
        {"yield_shear": 5000.0},
        strong | {"heights": 3.0, "gravity_load": 1e5},
        strong | {"geometric_stiffness": 1e5},
        strong | {"damping": [[500.0, -200.0], [-200.0, 300.0]]},
        strong | {"block": sm.Block(1, mass=1000.0, mu=0.2)},
    ):
        assert peaks(4000.0, **newtons) != pytest.approx(peaks(2000.0, **newtons), rel=1e-3), newtons  # type: ignore[arg-type]


def test_damping_forms() -> None:
    bare = building()
    # Rayleigh: zeta = (a / w + b w) / 2 in both modes, so the modal damping of mode 1 is the ratio.
    w = 2.0 * np.pi / bare.periods
    a, b = 2 * 0.04 * w[0] * w[2] / (w[0] + w[2]), 2 * 0.04 / (w[0] + w[2])
    k = np.array([[1e6, -5e5, 0.0], [-5e5, 1e6, -5e5], [0.0, -5e5, 5e5]])
    rayleigh = building(damping=sm.Rayleigh(0.04, (1, 3))).damping_matrix
    assert rayleigh == pytest.approx(a * np.diag(bare.mass) + b * k, rel=1e-12)
    assert building(damping=bare.damping_matrix).damping_matrix == pytest.approx(bare.damping_matrix, rel=1e-14)
    assert building(damping=0).damping_matrix == pytest.approx(np.zeros((3, 3)))


def test_p_delta_from_heights_and_loads_takes_the_blocks_in() -> None:
    high = building(heights=[4.0, 3.0, 3.0], gravity_load=[3e3, 2e3, 1e3])
    scene = sm.Scene(high, [sm.Block(2, mass=100.0, mu=0.3), sm.Block(0, mass=5e3, mu=0.3)])
    block = 100.0 * 9.80665
    assert scene.geometric_stiffness == pytest.approx([(6e3 + block) / 4.0, (3e3 + block) / 3.0, 1e3 / 3.0])
    heights_alone = sm.Scene(building(heights=3.0), [sm.Block(2, mass=100.0, mu=0.3)])
    assert not heights_alone.geometric_stiffness.any()
    assert sm.Scene(building(geometric_stiffness=50.0)).geometric_stiffness.tolist() == [50.0] * 3


def test_block_mass_ratio_is_of_its_floor() -> None:
    scene = sm.Scene(building(), sm.blocks_on_floors([0.5, 0.0, 2.0], mu=[0.3, 0.4, 0.5], mu_k=0.2))
    assert scene.block_floor == (1, 3)
    assert scene.block_mass.tolist() == [500.0, 1200.0]
    assert [(block.mu_s, block.mu_k) for block in scene.blocks] == [(0.3, 0.2), (0.5, 0.2)]


def test_inputs_are_copied_and_never_changed() -> None:
    mass = np.array([1000.0, 800.0, 600.0])
    made = building(mass=mass)
    mass[0] = 1.0
    assert made.mass[0] == 1000.0
    with pytest.raises(ValueError, match="read-only"):
        made.mass[0] = 1.0
    with pytest.raises(AttributeError, match="cannot be changed"):
        made.mass = mass
    samples = np.array([0.0, 1.0, 0.0])
    motion = sm.Motion(samples, 0.01)
    samples[1] = 5.0
    assert motion.acceleration.tolist() == [0.0, 1.0, 0.0]


def test_strided_and_integer_arrays_are_taken_as_they_read() -> None:
    table = np.arange(6).reshape(3, 2)
    assert sm.Motion(table[:, 1], 1).acceleration.tolist() == [1.0, 3.0, 5.0]
    assert sm.Motion(np.float32([0.5, 0.25]), 0.1).acceleration.tolist() == [0.5, 0.25]


VALUES = [
    building(),
    building(damping=sm.Rayleigh(0.05, (1, 2))),
    building(heights=[4.0, 3.0, 3.0], gravity_load=1e3),
    sm.Block(1, mass=2.0, mu=0.3),
    sm.Block(1, mass_ratio=2.0, mu_s=0.3, mu_k=0.2, velocity=0.1),
    sm.Scene(building(), [sm.Block(1, mass=2.0, mu=0.3)], initial_drift=[1e-3, 0, 0], collapse_drift=0.3, name="a"),
    sm.Scene(None, [sm.Block(0, mass=2.0, mu=0.3)]),
    sm.Motion([0.0, 1.0], 0.01, [0.0, 0.5]),
]


@pytest.mark.parametrize("value", VALUES, ids=repr)
def test_values_pickle_copy_and_compare_by_content(value: object) -> None:
    back = pickle.loads(pickle.dumps(value))
    assert back == value
    assert hash(back) == hash(value)
    assert copy.deepcopy(value) == value
    assert sum(value == other for other in VALUES) == 1
    assert value != "something else"


def test_names_do_not_take_part_in_comparison() -> None:
    assert sm.Scene(building(), name="a") == sm.Scene(building(), name="b", note="c")


def test_replace_changes_one_thing() -> None:
    changed = building().replace(second_slope=0.5)
    assert changed.second_slope.tolist() == [0.5] * 3
    assert changed.mass.tolist() == [1000.0, 800.0, 600.0]


def test_motion_with_duration() -> None:
    motion = sm.Motion([1.0, 2.0, 3.0], 0.1, [4.0, 5.0, 6.0])
    assert motion.with_duration(0.14).acceleration.tolist() == [1.0, 2.0]
    longer = motion.with_duration(0.4)
    assert longer.acceleration.tolist() == [1.0, 2.0, 3.0, 0.0, 0.0]
    assert longer.vertical is not None
    assert longer.vertical.tolist() == [4.0, 5.0, 6.0, 0.0, 0.0]
    assert longer.duration == pytest.approx(0.4)
