"""Walls of a scene file: a flexural cantilever beside the storeys, by one of four numbers."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.errors import InvalidScene
from seismass.base.input_table import POSITIVE, Table
from seismass.base.values import FloatArray, as_array, as_number
from seismass.design.modes import positive_of_length, vibration_modes
from seismass.design.walls import Wall
from seismass.model.building import Building, changed_building

WALL_KEYS: Final = ("flexural_rigidity", "period", "alpha_h", "base_shear_share")
"""Keys of the table; one of them is given."""


def check_walls(walls: Table, building: Table) -> None:
    """Refuse tables of walls and building that do not fit together, and unknown keys."""
    walls.known(WALL_KEYS)
    walls.needed(*WALL_KEYS)
    walls.one_of(*WALL_KEYS)
    if "stiffness_matrix" in building.values:
        building.refuse("stiffness_matrix", "left out where walls are given", "both")
    building.needed("heights")
    if "period" in building.values:
        for key in ("flexural_rigidity", "period"):
            if key in walls.values:
                requirement = f"left out where {building.key('period')}, that of storeys and walls together, is given"
                walls.refuse(key, requirement, "both")


def matrix_of_walls(walls: Table, building: Table) -> FloatArray | None:
    """Return the stiffness (N/m) of walls that are given by themselves; None where they follow the storeys."""
    by_itself = [key for key in ("flexural_rigidity", "period") if key in walls.values]
    if not by_itself:
        return None
    lists = [building.values.get(key) for key in ("mass", "stiffness", "heights")]
    count = next((len(each) for each in lists if isinstance(each, list)), 1)
    if "storeys" in building.values:
        count = building.count("storeys", least=1)
    heights = _per_storey(building, "heights", count)
    if by_itself == ["period"]:
        mass = _per_storey(building, "mass", count)
        return Wall.of_period(mass, heights, walls.number("period", np.nan, POSITIVE)).stiffness_matrix
    rigidity = walls.per_storey("flexural_rigidity")
    return Wall(heights, np.nan if rigidity is None else rigidity).stiffness_matrix


def with_walls(building: Building, walls: Table, *, scaled: bool) -> Building:
    """Return a building with walls that follow its storeys, by alpha H or their share of the base shear; `scaled`:
    storeys and walls alike, so that together they have the first period of the storeys as given.
    """
    if "alpha_h" in walls.values:
        wall = Wall.of_alpha_h(building, walls.number("alpha_h", np.nan, POSITIVE))
    else:
        wall = Wall.of_base_shear_share(building, walls.number("base_shear_share"))
    if not scaled:
        return wall.beside(building)
    matrix = wall.stiffness_matrix
    modes = vibration_modes(building.mass, building.stiffness, stiffness_matrix=matrix)
    scale = float(modes.periods[0] / building.periods[0]) ** 2  # changes neither alpha H nor the share
    return changed_building(building, stiffness=scale * building.stiffness, stiffness_matrix=scale * matrix)


def _per_storey(building: Table, key: str, count: int) -> FloatArray:
    value = building.values[key]
    if isinstance(value, list):
        return positive_of_length(as_array(value, key, "building", InvalidScene), key, count)
    return positive_of_length(as_number(value, key, "building", InvalidScene), key, count)
