"""The quantities of a response: their docstrings, displacements of floors and the motion of the ground."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm
from seismass.runs.plane import PlaneResponse
from seismass.runs.quantities import QUANTITIES, Values
from seismass.runs.response import Response

DT = 0.005
TIME = np.arange(800) * DT
MOTION = sm.Motion(3.0 * np.sin(9.0 * TIME) * np.sin(0.7 * TIME), DT)
OTHER = sm.Motion(2.0 * np.sin(7.0 * TIME) * np.sin(0.9 * TIME), DT)
BUILDING = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
GOODS = sm.blocks_on_floors([1.0, 0.5], mu=0.2)


def integral(rate: np.ndarray) -> np.ndarray:
    """Trapezoidal integral from the first row; a jump of the acceleration between samples counts dt^2/8 of it."""
    return np.concatenate([np.zeros((1, *rate.shape[1:])), np.cumsum(0.5 * DT * (rate[1:] + rate[:-1]), axis=0)])


@pytest.mark.parametrize("base", [None, sm.SlidingBase(mass_ratio=1.0, mu=0.15)], ids=["fixed", "sliding"])
def test_displacement_of_floors_is_the_integral_of_their_velocity(base: sm.SlidingBase | None) -> None:
    response = sm.simulate(sm.Scene(BUILDING, GOODS, base=base), MOTION, histories=True)
    moved = response.floor_displacement
    np.testing.assert_allclose(moved, integral(response.floor_velocity), atol=1e-3 * np.abs(moved).max())
    if base is None:
        np.testing.assert_array_equal(moved[:, 0], response.drift[:, 0])


def test_displacement_of_floors_in_two_directions() -> None:
    scene = sm.Scene(BUILDING, GOODS, other_direction=True)
    response = sm.simulate(scene, (MOTION, OTHER), histories=True)
    moved = response.floor_displacement
    np.testing.assert_allclose(moved, integral(response.floor_velocity), atol=1e-3 * np.abs(moved).max())
    np.testing.assert_array_equal(response.ground_acceleration, np.stack([MOTION.acceleration, OTHER.acceleration], 1))


def test_motion_of_the_ground_stands_at_the_rows_of_the_histories() -> None:
    """Every third sample; velocity and displacement of an acceleration that is linear between samples."""
    response = sm.simulate(sm.Scene(BUILDING, GOODS), MOTION, histories=3)
    np.testing.assert_array_equal(response.ground_acceleration, MOTION.acceleration[::3])
    assert len(response.ground_acceleration) == len(response.time)
    np.testing.assert_allclose(response.ground_velocity, integral(MOTION.acceleration)[::3], rtol=1e-12, atol=1e-15)
    expected = integral(integral(MOTION.acceleration))[::3]
    np.testing.assert_allclose(response.ground_displacement, expected, atol=1e-3 * np.abs(expected).max())


def test_what_was_not_kept_is_refused() -> None:
    response = sm.simulate(sm.Scene(BUILDING, GOODS), MOTION)
    for name in ("floor_displacement", "ground_velocity", "storey_shear"):
        with pytest.raises(sm.errors.InvalidOption, match="histories of simulate must be asked for"):
            getattr(response, name)


def test_docstrings_are_made_from_the_table() -> None:
    assert Response.peak_drift.__doc__ == "Largest absolute drift of each storey (m), shape (storeys,)."
    assert Response.rack_shear.__doc__.endswith("without damping (N), shape (rows, levels).")
    assert PlaneResponse.peak_floor_acceleration.__doc__.endswith("of each floor (m/s2), shape (storeys, 3).")
    assert PlaneResponse.ground_velocity.__doc__ == "Velocity of the ground (m/s), shape (rows, 2)."


def test_every_quantity_is_a_property_of_a_response() -> None:
    names = {
        name for kind in (Response, PlaneResponse) for name, each in vars(kind).items() if isinstance(each, Values)
    }
    plain = {name.removeprefix("peak_").removeprefix("residual_").removesuffix("_time") for name in names}
    assert plain | {"base_shear"} == set(QUANTITIES)
