"""What goods stand on: the ground, a floor, or the level of a rack; and the values of a response there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.values import FloatArray
from seismass.model.rack import Rack, RackBlock
from seismass.model.scene import Scene
from seismass.runs.response import Response


@dataclass(frozen=True, slots=True)
class Place:
    """Where a block stands: floor (0 is the ground; of a rack that under it), rack and level (from 1; 0: on the floor
    itself), and index `node` among the ground, the floors and the levels of all racks.
    """

    floor: int
    rack: int
    level: int
    node: int

    @property
    def columns(self) -> dict[str, int]:
        """The columns of tables of scenes with racks: floor, rack and level."""
        return {"floor": self.floor, "rack": self.rack, "level": self.level}


def places_of(scene: Scene) -> tuple[Place, ...]:
    """Return the place of each of `Scene.goods`."""
    places = [Place(floor, 0, 0, floor) for floor in scene.block_floor]
    first = scene.storeys
    for number, rack in enumerate(scene.racks, start=1):
        levels = (block.level for block in rack.blocks if not block.fixed)
        places += [Place(rack.floor, number, level, first + level) for level in levels]
        first += rack.levels
    return tuple(places)


def place_names(scene: Scene) -> tuple[str, ...]:
    """Return the columns that tell places apart: the floor, and with racks rack and level (0: on the floor itself)."""
    return ("floor", "rack", "level") if scene.racks else ("floor",)


def place_columns(scene: Scene, times: int) -> dict[str, Any]:
    """Return the columns of places of all goods, so many times over."""
    places = places_of(scene)
    return {
        name: pl.Series(np.tile([getattr(place, name) for place in places], times), dtype=pl.UInt32)
        for name in place_names(scene)
    }


def at_nodes(response: Response, of_floors: str, of_racks: str, ground: float) -> FloatArray:
    """Return peaks of the ground, the floors and the rack levels; `of_floors` and `of_racks` name what is peaked."""
    return np.concatenate([[ground], getattr(response, of_floors), *getattr(response, of_racks)])


def histories_at_nodes(response: Response, of_floors: str, of_racks: str, ground: FloatArray) -> FloatArray:
    """Return histories of the ground, the floors and the rack levels, shape (rows, nodes)."""
    return np.column_stack([ground, getattr(response, of_floors), *getattr(response, of_racks)])


def without_loose_goods(scene: Scene, *, attached: bool) -> Scene:
    """Return the building with its racks, without loose goods or with all of them attached for good. Springs of racks
    stay the same; their damping is the ratio in their modes with what is attached.
    """
    if scene.other_direction is not False:
        x, y = (without_loose_goods(each, attached=attached) for each in scene._directions())
        of_both = zip(x.racks, y.racks, scene.racks, strict=True)
        return Scene(
            x.building,
            racks=[_with_springs_in_y(*each) for each in of_both],
            other_direction=True if y.building is None else y.building,
            initial_drift=scene.initial_drift,
            initial_velocity=scene.initial_velocity,
            collapse_drift=scene.collapse_drift,
            name=scene.name,
        )
    building = scene.building
    scale = np.ones(scene.storeys + 1)
    if building is not None:
        mass = building.mass.copy()
        for floor, block in zip(scene.block_floor, scene.block_mass, strict=True):
            if floor and attached:
                mass[floor - 1] += block
        # Masses that are given over that of their floor stay what they are.
        scale[1:] = building.mass / mass
        changes: dict[str, Any] = {"mass": mass, "damping": building.damping_matrix}
        if scene.geometric_stiffness.any():
            changes |= {"gravity_load": None, "geometric_stiffness": scene.geometric_stiffness}
        racks = [_emptied(rack, building.mass, float(scale[rack.floor]), attached=attached) for rack in scene.racks]
        building = building.replace(**changes)
    else:
        racks = [_emptied(rack, np.empty(0), 1.0, attached=attached) for rack in scene.racks]
    return Scene(
        building,
        racks=racks,
        initial_drift=scene.initial_drift,
        initial_velocity=scene.initial_velocity,
        collapse_drift=scene.collapse_drift,
        name=scene.name,
    )


def _with_springs_in_y(rack: Rack, in_y: Rack, given: Rack) -> Rack:
    """A rack with the springs of another in y; what else differs there stays as it was given."""
    other = {key: value for key, value in (given.other_direction or {}).items() if key not in _MADE_ANEW}
    other["stiffness"] = in_y.stiffness
    if in_y.yield_shear is not None:
        other["yield_shear"] = in_y.yield_shear
    return rack.replace(other_direction=other)


_MADE_ANEW: Final = ("period", "stiffness", "yield_shear", "yield_shear_over_weight")
"""What a rack without goods has as numbers of its own."""


def _emptied(rack: Rack, floor_masses: FloatArray, scale: float, *, attached: bool) -> Rack:
    """Return a rack with its loose goods removed or fixed, and ratios of masses times `scale`; springs as they are."""
    alone = rack.alone(float(floor_masses[rack.floor - 1]) if rack.floor else np.nan)
    kept = []
    for each in rack.blocks:
        if each.fixed or attached:
            mass, ratio = each.block.mass, each.block.mass_ratio
            scaled = None if ratio is None else scale * ratio
            kept.append(RackBlock(each.level, mass=mass, mass_ratio=scaled, fixed=True))
    changes: dict[str, Any] = {"period": None, "stiffness": alone.stiffness, "blocks": kept}
    if rack.level_mass_ratio is not None:
        changes["level_mass_ratio"] = scale * rack.level_mass_ratio
    if rack.yield_shear_over_weight is not None:
        changes |= {"yield_shear_over_weight": None, "yield_shear": alone.yield_shear}
    return rack.replace(**changes)
