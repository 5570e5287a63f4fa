"""Goods, walls, and pairs of motions of a scene file."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.files import stored_rows
from seismass.base.input_table import FINITE, POSITIVE, Table
from seismass.base.values import FloatArray, as_array, as_count, as_number, brief, refusal
from seismass.design.modes import positive_of_length, vibration_modes
from seismass.design.walls import Wall
from seismass.model.block import Block, SlidingBase, Stops
from seismass.model.building import Building, changed_building
from seismass.model.rack import Rack, RackBlock
from seismass.model.scene import Scene
from seismass.model.springs import SPRING_FIELDS
from seismass.motions.records import Pair, builtin_pairs, find_pairs, read_pair

ROWS: Final = stored_rows("scene_keys")
"""The keys of a scene file, from which the tables of docs/scene_file.md are made too."""
KEYS: Final = {
    table: tuple(row["key"] for row in ROWS if row["tables"] == table)
    for table in dict.fromkeys(row["tables"] for row in ROWS)
}
"""Keys of each table, the file first; `vertical_motion` and `other_motion` have those of `motion`, stops of goods
on racks those of `blocks.stops`, and `other_direction` those of `building` that may differ in y."""
_INFINITE: Final = {"yield_shear_over_weight", *(key for key, each in SPRING_FIELDS.items() if np.isinf(each.default))}


def read_block(table: Table, number: int) -> Block:
    """Return a block of a scene file."""
    table.known(KEYS["blocks"])
    table.needed("floor")
    owner = f"block {number}"
    return Block(as_count(table.values["floor"], "floor", owner, InvalidScene), **_friction(table, owner))


def _friction(table: Table, owner: str) -> dict[str, Any]:
    """What a block has beside its place."""
    table.needed("mass", "mass_ratio")
    table.needed("mu", "mu_s")
    table.excluded("mass_ratio", "mass")
    table.excluded("mu", "mu_s", "mu_k")
    names = ("mass", "mass_ratio", "mu", "mu_s", "mu_k")
    values: dict[str, Any] = {
        key: as_number(table.values[key], key, owner, InvalidScene) for key in names if key in table.values
    }
    if "mu" in values and not 0.0 <= values["mu"] < np.inf:  # the kernel would call it mu_s
        raise refusal(InvalidScene, "mu", owner, "finite and not negative", f"{values['mu']:g}")
    if "wear" in table.values:
        values["wear"] = table.values["wear"]
    if "velocity" in table.values:
        velocity = table.values["velocity"]
        is_pair = isinstance(velocity, list)
        values["velocity"] = velocity if is_pair else as_number(velocity, "velocity", owner, InvalidScene)
    for key in ("stops", "stops_y"):
        if key in table.values:
            values[key] = _stops(table.table(key))
    return values


def _stops(table: Table) -> Stops:
    table.known(KEYS["blocks.stops"])
    table.needed("clearance")
    table.needed("stiffness")
    return Stops(**infinite_where_null(table.subset(*KEYS["blocks.stops"])))


def read_base(table: Table) -> SlidingBase:
    """Return the sliding base of a scene file."""
    keys = KEYS["base"]
    table.known(keys)
    table.needed("mu", "mu_s")
    table.excluded("mu", "mu_s", "mu_k")
    table.excluded("mass_ratio", "mass")
    return SlidingBase(
        **{key: as_number(table.values[key], key, "base", InvalidScene) for key in keys if key in table.values}
    )


def read_rack(table: Table, number: int) -> Rack:
    """Return a rack of a scene file."""
    table.known(KEYS["racks"])
    table.needed("floor")
    table.needed("levels")
    table.needed("level_mass", "level_mass_ratio")
    table.needed("period", "stiffness")
    for key, other in (("level_mass_ratio", "level_mass"), ("period", "stiffness")):
        table.excluded(key, other)
    table.excluded("yield_shear_over_weight", "yield_shear")
    goods = infinite_where_null(table.subset(*(key for key in KEYS["racks"] if key != "blocks")))
    if isinstance(goods.get("other_direction"), dict):
        goods["other_direction"] = infinite_where_null(goods["other_direction"])
    blocks = [_rack_block(each, place, number) for place, each in enumerate(table.tables("blocks"), start=1)]
    return Rack(**goods, blocks=blocks)


def infinite_where_null(values: dict[str, Any]) -> dict[str, Any]:
    """The same keys; in lists of what may be infinite a null is, as JSON has no infinity: an elastic storey."""
    for key in _INFINITE & values.keys():
        if isinstance(values[key], list):
            values = values | {key: [np.inf if item is None else item for item in values[key]]}
    return values


def _rack_block(table: Table, number: int, rack: int) -> RackBlock:
    table.known(KEYS["racks.blocks"])
    table.needed("level")
    owner = f"block {number} of rack {rack}"
    level = as_count(table.values["level"], "level", owner, InvalidScene, least=1)
    fixed = table.values.get("fixed", False)
    if not isinstance(fixed, bool):
        table.refuse("fixed", "true or false", brief(fixed))
    if not fixed:
        return RackBlock(level, **_friction(table, owner))
    for key in ("mu", "mu_s", "mu_k", "velocity", "wear", "stops", "stops_y"):
        table.excluded(key, "fixed")
    table.needed("mass", "mass_ratio")
    table.excluded("mass_ratio", "mass")
    masses: dict[str, Any] = {key: table.number(key, np.nan) for key in ("mass", "mass_ratio") if key in table.values}
    return RackBlock(level, fixed=True, **masses)


def check_walls(walls: Table, building: Table) -> None:
    """Refuse tables of walls and building that do not fit together, and unknown keys."""
    walls.known(KEYS["walls"])
    walls.needed(*KEYS["walls"])
    walls.one_of(*KEYS["walls"])
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


def pair_of_scene(top: Table, scene: Scene, folder: Path) -> Pair | None:
    """Return the pair of a scene file, which stands in place of its motions; None where it has none."""
    if "pair" not in top.values:
        return None
    for key in ("motion", "other_motion", "vertical_motion"):
        top.excluded(key, "pair")
    if scene.engine != "plane":
        top.refuse("pair", "left out where there is no other_direction", "a table")
    return pair_of_table(top.table("pair"), folder)


def pair_of_table(table: Table, folder: Path) -> Pair:
    """Return the pair that a table `pair` names; paths are relative to `folder`."""
    table.known(KEYS["pair"])
    table.needed("first", "folder", "builtin")
    table.one_of("first", "folder", "builtin")
    for key, others in (
        ("second", ("folder", "builtin")),
        ("vertical", ("folder", "builtin")),
        ("name", ("first", "builtin")),
    ):
        table.excluded(key, *others)
    if "first" in table.values:
        table.needed("second")
        up = folder / table.text("vertical") if "vertical" in table.values else None
        pair = read_pair(folder / table.text("first"), folder / table.text("second"), up)
    elif "folder" in table.values:
        table.needed("name")
        pairs = list(find_pairs(folder / table.text("folder")))
        if not pairs:
            table.refuse("folder", "a folder with records that belong together", brief(table.values["folder"]))
        pair = _named(table, "name", pairs)
    else:
        pair = _named(table, "builtin", list(builtin_pairs()))
    if "rotation" in table.values:
        table.excluded("rotation", "strike")
        pair = pair.rotated(table.number("rotation", need=FINITE))
    if "strike" in table.values:
        if pair.azimuths is None:
            table.refuse("strike", "left out where the pair has no azimuths", brief(table.values["strike"]))
        try:
            pair = pair.fault_normal_parallel(table.number("strike", need=FINITE))
        except InvalidOption as error:
            table.refuse_as("strike", error)
    return pair.scaled(table.number("scale", 1.0, POSITIVE))


def _named(table: Table, key: str, pairs: list[Pair]) -> Pair:
    """The pair of that name."""
    name = table.text(key)
    matches = [pair for pair in pairs if pair.name == name]
    if len(matches) != 1:
        known = ", ".join(pair.name for pair in pairs[:3])
        table.refuse(key, f"the name of one of {len(pairs)} pairs, as {known}", brief(name))
    return matches[0]
