"""The buildings of a grid: those given, and what columns change in them, formed as scenes need them."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from seismass.base.errors import InvalidScene
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, brief, refusal
from seismass.model.building import Building, changed_building, of_storeys_alone
from seismass.model.springs import SHAPE_FIELDS
from seismass.runs.grid.columns import Column, IndexArray, index_values, number_values, strength_table
from seismass.runs.grid.design import StrengthDesign

AttachedDamping: TypeAlias = Literal["same", "ratio"]
"""Damping of a building to which live load is attached: the matrix that it has without, or its ratio in new modes."""
ATTACHED_DAMPING: Final = get_args(AttachedDamping)

AttachedOf: TypeAlias = Literal["present", "design"]
"""Live load of which a share is attached: what is present, or what the building was designed for."""
ATTACHED_OF: Final = get_args(AttachedOf)

CHANGING: Final = ("period", "strength", "R", "yield_shear_over_weight", *SHAPE_FIELDS)
"""Columns that change a building as it is given, beside the live load that is attached to it."""


class Formed(NamedTuple):
    """Buildings of some scenes, which of them each scene has, and block masses over the floor masses they have."""

    buildings: list[Building]
    which: IndexArray
    mass_ratio: FloatArray


@dataclass(frozen=True, slots=True)
class BuildingColumns:
    """What forms the building of a scene: buildings given with first periods (s), the floor of each block (from 1), the
    columns of `CHANGING`, `attached` and `sliding`; `design` gives V_y by the column R.
    """

    given: tuple[Building, ...]
    periods: FloatArray
    floors: tuple[int, ...]
    columns: dict[str, Column[np.float64]]
    damping: AttachedDamping
    attached_of: AttachedOf
    design: StrengthDesign | None

    def of(self, scenes: IndexArray, index: IndexArray, design_load: FloatArray) -> Formed:
        """Return the buildings of scenes (numbers from 0) from the index of each given one. `design_load` is the mass
        of the design live load over that of its floor, shape (scenes, blocks).
        """
        attached, sliding = self.shares_of(scenes)
        present = self.present_of(scenes, design_load)
        blocks = present if sliding is None else present * sliding[:, None]
        changing = [self.columns[name].of(scenes).reshape(len(scenes), -1) for name in CHANGING if name in self.columns]
        if attached is None and not changing:
            return Formed(list(self.given), index, blocks)
        loads = np.zeros((len(scenes), 2, len(self.floors)))
        if attached is not None and sliding is not None:
            loads[:, 0] = attached[:, None] * (present if self.attached_of == "present" else design_load)
            loads[:, 1] = (1.0 - sliding)[:, None] * present
            changing.append(loads.reshape(len(scenes), -1))
        if self.design is not None:
            changing.append(design_load)
        keys = np.nan_to_num(np.column_stack([index, *changing]), nan=-1.0, posinf=np.inf)
        _, first, which = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        which = which.reshape(-1)
        formed, added = [], []
        designed: dict[Hashable, FloatArray] = {}
        for place in first.tolist():
            scene = scenes[place : place + 1]
            try:
                changed = self._changed(scene, int(index[place]), design_load[place], designed)
                if attached is not None:
                    self._on_floors(design_load[place], changed.storeys)  # of floors that are there
                building, more = self._loaded(changed, *loads[place])
            except InvalidScene as error:
                message = str(error).replace(" must be ", f" of scene {scenes[place] + 1} must be ", 1)
                raise InvalidScene(message) from None
            formed.append(building)
            added.append(more)
        if attached is not None:
            blocks = blocks / np.array(added)[which]
        return Formed(formed, which, blocks)

    def shares_of(self, scenes: IndexArray) -> tuple[FloatArray | None, FloatArray | None]:
        """Return the shares of the live load that are attached and that slide, or None where all of it slides."""
        if not {"attached", "sliding"} & self.columns.keys():
            return None, None
        shares = {name: self.columns[name].of(scenes) for name in ("attached", "sliding") if name in self.columns}
        attached = shares.get("attached", np.zeros(len(scenes)))
        return attached, shares.get("sliding", 1.0 - attached)

    def present_of(self, scenes: IndexArray, design_load: FloatArray) -> FloatArray:
        """Return the live load that is present over floor mass, shape (scenes, blocks)."""
        if "occupancy" not in self.columns:
            return design_load
        return design_load * self.columns["occupancy"].of(scenes)[:, None]

    def _changed(
        self, scene: IndexArray, index: int, design_load: FloatArray, designed: dict[Hashable, FloatArray]
    ) -> Building:
        """The building of a scene without live load; V_e of each design is computed once."""
        building = self.given[index]
        value = {name: self.columns[name].of(scene)[0] for name in CHANGING if name in self.columns}
        changes: dict[str, Any] = {name: value[name] for name in SHAPE_FIELDS if name in value}
        if "period" in value:
            faster = float(building.periods[0]) / value["period"]
            changes["stiffness"] = building.stiffness * faster**2
            if isinstance(building.damping, np.ndarray):  # the same ratios in its modes
                changes["damping"] = building.damping * faster
        if "strength" in value:
            changes["yield_shear"] = building.yield_shear * value["strength"]
        elif "yield_shear_over_weight" in value:
            changes["yield_shear"] = _strengths(value["yield_shear_over_weight"], building.storeys) * building.weight
        elif "R" in value and self.design is not None:
            reduction = float(value["R"])
            if reduction == 1.0 and self.design.elastic_at_one:
                changes["yield_shear"] = np.full(building.storeys, np.inf)
            else:
                key = (index, value.get("period"), design_load.tobytes())
                if key not in designed:
                    stiffer = changed_building(building, **changes)
                    designed[key] = self.design.elastic_shear(stiffer, self._on_floors(design_load, building.storeys))
                changes["yield_shear"] = designed[key] / reduction
        return changed_building(building, **changes) if changes else building

    def _loaded(self, building: Building, attached: FloatArray, still: FloatArray) -> tuple[Building, FloatArray]:
        """A building with live load attached as mass and some whose weight does not slide, both over floor mass, and
        the mass of each block's floor over that without attached live load.
        """
        more = np.ones(len(self.floors))
        changes: dict[str, Any] = {}
        if attached.any():
            changes["mass"] = building.mass + self._on_floors(attached, building.storeys) * building.mass
            if self.damping == "same":
                changes["damping"] = building.damping_matrix
            for j, floor in enumerate(self.floors):
                if floor <= building.storeys:
                    more[j] = changes["mass"][floor - 1] / building.mass[floor - 1]
        if building.gravity_load is not None and still.any():
            # The weight of what does not slide is there, however much of it is counted as mass.
            weight = self._on_floors(still, building.storeys) * building.mass * STANDARD_GRAVITY
            changes["gravity_load"] = building.gravity_load + weight
        return (changed_building(building, **changes) if changes else building), more

    def _on_floors(self, load: FloatArray, storeys: int) -> FloatArray:
        """What blocks have, summed on their floors."""
        found = np.zeros(storeys)
        for floor, value in zip(self.floors, load.tolist(), strict=True):
            if value != 0.0:
                if floor > storeys:
                    requirement = f"a floor of the building, 1 to {storeys}"
                    raise refusal(InvalidScene, "floor", "live load", requirement, str(floor))
                found[floor - 1] += value
        return found


def _strengths(over_weight: FloatArray, storeys: int) -> FloatArray:
    """V_y over the weight of each storey, from a row that may be longer than the building is high."""
    values = np.full(storeys, over_weight[0]) if len(over_weight) == 1 else over_weight[:storeys]
    if len(values) < storeys or np.isnan(values).any():
        given = int((~np.isnan(over_weight)).sum())
        requirement = f"one number or {storeys} values, one per storey"
        raise refusal(InvalidScene, "yield_shear_over_weight", "building", requirement, f"{given} values")
    return values


def given_buildings(building: Any, storeys: Any, period: Any) -> tuple[tuple[Building, ...], IndexArray, FloatArray]:
    """Return the buildings of a grid, which of them each value of storeys and periods has, and their periods."""
    if (building is None) == (storeys is None):
        got = "neither" if building is None else "both"
        raise refusal(InvalidScene, "building", "grid", "given either as building or as storeys", got)
    if storeys is None:
        listed = (building,) if isinstance(building, Building) else building
        if not isinstance(listed, Sequence) or not listed or not all(isinstance(item, Building) for item in listed):
            raise refusal(InvalidScene, "building", "grid", "a Building or a list of Buildings", brief(building))
        for item in listed:
            of_storeys_alone(item, "grids")
        of_given = np.array([float(item.periods[0]) for item in listed])
        return tuple(listed), np.zeros(1, dtype=np.int64), of_given
    if period is None:
        raise refusal(InvalidScene, "period", "grid", "given where storeys is", "none")
    heights = index_values(storeys, "storeys", InvalidScene, of="a list of such numbers") + 1
    periods = number_values({"period": period})["period"]
    if len(heights) != len(periods) and 1 not in (len(heights), len(periods)):
        requirement = f"one value, or as many as storeys has, {len(heights)}"
        raise refusal(InvalidScene, "period", "grid", requirement, f"{len(periods)} values")
    pairs = np.column_stack(np.broadcast_arrays(heights, periods))
    distinct, first, which = np.unique(pairs, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)  # buildings are numbered as they are listed
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    buildings = tuple(Building.uniform(int(count), float(seconds)) for count, seconds in distinct[order])
    return buildings, place[which.reshape(-1)], distinct[order, 1]


def changing_values(
    buildings: Sequence[Building], *, yield_shear_over_weight: Any, **numbers: Any
) -> dict[str, FloatArray]:
    """Return what changes buildings."""
    values = number_values(numbers)
    if "R" in values and ("strength" in values or yield_shear_over_weight is not None):
        other = "strength" if "strength" in values else "yield_shear_over_weight"
        raise refusal(InvalidScene, "R", "grid", f"left out where {other} is given", "both")
    if yield_shear_over_weight is not None:
        if "strength" in values:
            raise refusal(InvalidScene, "strength", "grid", "left out where yield_shear_over_weight is given", "both")
        values["yield_shear_over_weight"] = strength_table(yield_shear_over_weight)
    if any(building.backbone is not None for building in buildings):
        for name, column in values.items():
            requirement = "left out where a building has a backbone"
            raise refusal(InvalidScene, name, "grid", requirement, brief(column.tolist()))
    if "strength" in values and all(np.isinf(building.yield_shear).all() for building in buildings):
        requirement = "left out where buildings are elastic (yield_shear_over_weight makes them yield)"
        raise refusal(InvalidScene, "strength", "grid", requirement, brief(numbers["strength"]))
    return values
