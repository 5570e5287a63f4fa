"""Blocks, stops, racks and base of a scene file: tables as values of `Block`, `Stops`, `Rack`, `SlidingBase`."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidScene
from seismass.base.input_table import Table
from seismass.base.values import as_count, as_number, brief, refusal
from seismass.model.block import Block
from seismass.model.rack import Rack, RackBlock
from seismass.model.sliding_base import SlidingBase
from seismass.model.springs import SHAPE_FIELDS, SPRING_FIELDS
from seismass.model.stops import Stops

_FRICTION: Final = ("mass", "mass_ratio", "mu", "mu_s", "mu_k", "velocity", "wear", "stops", "stops_y")
GOODS_KEYS: Final = {
    "blocks": ("floor", *_FRICTION),
    "blocks.stops_y": ("clearance", "stiffness", "damping"),
    "blocks.stops": ("clearance", "stiffness", "damping"),
    "racks": (
        "floor",
        "levels",
        "level_mass",
        "level_mass_ratio",
        "stiffness",
        "period",
        *SPRING_FIELDS,
        "yield_shear_over_weight",
        "hysteresis",
        "damping",
        "geometric_stiffness",
        "blocks",
        "other_direction",
    ),
    "racks.blocks": ("level", *_FRICTION, "fixed"),
    "base": ("mu", "mu_s", "mu_k", "radius", "mass", "mass_ratio"),
}
"""Keys of the tables of goods, racks and base; stops of racks' blocks have those of `blocks.stops`."""


def read_block(table: Table, number: int) -> Block:
    """Return a block of a scene file."""
    table.known(GOODS_KEYS["blocks"])
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
    table.known(GOODS_KEYS["blocks.stops"])
    table.needed("clearance")
    table.needed("stiffness")
    return Stops(**{key: table.values[key] for key in GOODS_KEYS["blocks.stops"] if key in table.values})


def read_base(table: Table) -> SlidingBase:
    """Return the sliding base of a scene file."""
    keys = GOODS_KEYS["base"]
    table.known(keys)
    table.needed("mu", "mu_s")
    table.excluded("mu", "mu_s", "mu_k")
    table.excluded("mass_ratio", "mass")
    return SlidingBase(
        **{key: as_number(table.values[key], key, "base", InvalidScene) for key in keys if key in table.values}
    )


def read_rack(table: Table, number: int) -> Rack:
    """Return a rack of a scene file."""
    table.known(GOODS_KEYS["racks"])
    table.needed("floor")
    table.needed("levels")
    table.needed("level_mass", "level_mass_ratio")
    table.needed("period", "stiffness")
    for key, other in (("level_mass_ratio", "level_mass"), ("period", "stiffness")):
        table.excluded(key, other)
    table.excluded("yield_shear_over_weight", "yield_shear")
    given = {key: table.values[key] for key in GOODS_KEYS["racks"] if key in table.values and key != "blocks"}
    for key in ("yield_shear", "yield_shear_over_weight", *SHAPE_FIELDS):
        infinite = key not in SHAPE_FIELDS or np.isinf(SHAPE_FIELDS[key].default)
        if infinite and isinstance(given.get(key), list):  # null: a level that stays elastic
            given[key] = [np.inf if item is None else item for item in given[key]]
    blocks = [_rack_block(each, place, number) for place, each in enumerate(table.tables("blocks"), start=1)]
    return Rack(**given, blocks=blocks)


def _rack_block(table: Table, number: int, rack: int) -> RackBlock:
    table.known(GOODS_KEYS["racks.blocks"])
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
