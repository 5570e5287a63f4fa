"""Walls of a building file: an elastic matrix over the floors, or a flexural cantilever by one of four numbers."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import numpy as np

from seismass.base.errors import InvalidBuildingFile, SeismassError
from seismass.base.input_table import POSITIVE, Table
from seismass.base.values import FloatArray, as_array
from seismass.design import Wall, vibration_modes
from seismass.model.building import Building

WALL_KEYS: Final = (
    "flexural_rigidity_kn_m2",
    "period_s",
    "alpha_h",
    "base_shear_share",
    "stiffness_matrix_kn_per_m",
)
"""Keys of the table; one of them is given."""
_BY_THEMSELVES: Final = ("flexural_rigidity_kn_m2", "period_s", "stiffness_matrix_kn_per_m")
"""Those that do not follow the stiffness of the storeys."""


class Walls(NamedTuple):
    """Walls beside the storeys: storey stiffnesses (N/m, scaled where the period stated is that of both together),
    stiffness matrix of the walls over the floors (N/m), and `how` they are stated.
    """

    stiffness: FloatArray
    matrix: FloatArray
    how: str


def walls_of(
    walls: Table, building: Table, mass: FloatArray, stiffness: FloatArray, heights: Any, period: float | None
) -> Walls | None:
    """Return the walls of a file; None where it has none. `mass` is that of the floors without goods (kg); where
    `period` (s) is stated for the building, `stiffness` (N/m) gives it without walls.
    """
    if not walls.values:
        return None
    walls.known(WALL_KEYS)
    walls.needed(*WALL_KEYS)
    walls.one_of(*WALL_KEYS)
    (key,) = walls.values
    by_period = period is not None
    if by_period and key in _BY_THEMSELVES:
        requirement = f"left out where {building.key('period_s')}, that of storeys and walls together, is known"
        walls.refuse(key, requirement, "both")
    if key != "stiffness_matrix_kn_per_m" and heights is None:
        building.refuse("height_m", f"given where {walls.key(key)} is", "nothing")
    try:
        matrix, how = _matrix(key, walls, mass, stiffness, heights)
        if not by_period:
            return Walls(stiffness, matrix, how)
        alone, both = (vibration_modes(mass, stiffness, stiffness_matrix=each).periods[0] for each in (None, matrix))
    except SeismassError as error:
        walls.refuse_as(key, error)
    scale = float(both / alone) ** 2  # changes neither alpha H nor the share
    return Walls(scale * stiffness, scale * matrix, how)


def _matrix(key: str, walls: Table, mass: FloatArray, stiffness: FloatArray, heights: Any) -> tuple[FloatArray, str]:
    if key == "stiffness_matrix_kn_per_m":
        stated: FloatArray = as_array(walls.values[key], key, "walls", InvalidBuildingFile, dimensions=2)
        return 1e3 * stated, "an elastic matrix over the floors, as stated"
    frame = Building(mass, stiffness, yield_shear=np.inf, heights=heights)
    if key == "flexural_rigidity_kn_m2":
        given = walls.per_storey(key)
        rigidity = np.full(len(mass), np.nan) if given is None else 1e3 * given * np.ones(len(mass))
        return Wall(heights, rigidity).stiffness_matrix, "flexural cantilever of the stated EI"
    number = walls.number(key, need=POSITIVE)
    if key == "period_s":
        return Wall.of_period(mass, heights, number).stiffness_matrix, f"flexural cantilever, alone {number:g} s"
    if key == "alpha_h":
        return Wall.of_alpha_h(frame, number).stiffness_matrix, f"flexural cantilever, alpha H = {number:g}"
    share = f"flexural cantilever with {number:g} of the base shear in the first mode"
    return Wall.of_base_shear_share(frame, number).stiffness_matrix, share
