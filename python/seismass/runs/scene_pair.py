"""The pair of motions of a scene file: of two files, of a folder by name, or built in; turned and scaled."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from seismass.base.errors import InvalidOption
from seismass.base.input_table import FINITE, POSITIVE, Table
from seismass.base.values import brief
from seismass.model.scene import Scene
from seismass.records import Pair, builtin_pairs, find_pairs, read_pair

PAIR_KEYS: Final = ("first", "second", "vertical", "folder", "name", "builtin", "rotation", "strike", "scale")


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
    """Return the pair that a table with `PAIR_KEYS` names; paths are relative to `folder`."""
    table.known(PAIR_KEYS)
    table.needed("first", "folder", "builtin")
    table.one_of("first", "folder", "builtin")
    if "first" in table.values:
        table.needed("second")
        up = folder / table.text("vertical") if "vertical" in table.values else None
        pair = read_pair(folder / table.text("first"), folder / table.text("second"), up)
    elif "folder" in table.values:
        table.needed("name")
        pair = _named(table, "name", list(find_pairs(folder / table.text("folder"))))
    else:
        pair = _named(table, "builtin", list(builtin_pairs()))
    if "rotation" in table.values:
        table.excluded("rotation", "strike")
        pair = pair.rotated(table.number("rotation", need=FINITE))
    if "strike" in table.values:
        try:
            pair = pair.fault_normal_parallel(table.number("strike", need=FINITE))
        except InvalidOption as error:
            table.refuse_as("strike", error)
    return pair.scaled(table.number("scale", 1.0, POSITIVE))


def _named(table: Table, key: str, pairs: list[Pair]) -> Pair:
    """The pair of that name."""
    name = table.text(key)
    found = [pair for pair in pairs if pair.name == name]
    if len(found) != 1:
        known = ", ".join(pair.name for pair in pairs[:3])
        table.refuse(key, f"the name of one of {len(pairs)} pairs, as {known}", brief(name))
    return found[0]
