"""The other direction of a building file: the tables of the building in y, from those in x and what differs."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any, Final

from seismass.assessment.file_site import PERIOD
from seismass.base.errors import InvalidBuildingFile
from seismass.base.input_table import Table

STIFFNESS: Final = ("stiffness_kn_per_m", "stiffness_n_per_m", "stiffness_kip_per_in", "stiffness")
STRENGTH: Final = ("yield_shear_kn", "yield_shear_n", "yield_shear_over_weight", "yield_shear_kip", "yield_shear")
DESIGN: Final = ("design", "R", "design_fraction", "combination")
OF_STOREYS: Final = (
    *STIFFNESS,
    "relative_stiffness",
    *STRENGTH,
    "overstrength",
    "second_slope",
    "third_slope",
)
"""Keys of a storey that may differ in y."""
OTHER_DIRECTION: Final = (*PERIOD, *DESIGN, "damping", "damping_from_storey", *OF_STOREYS, "storeys")
"""Keys of the other direction."""
_REPLACED: Final = ((*PERIOD, *STIFFNESS), STRENGTH)
"""Groups of keys of which one in y replaces all in x."""


def tables_in_y(tables: Mapping[str, Any], file: str) -> Table:
    """Return the tables of a building file as they are for the building in y, from `other_direction`; `tables` is not
    changed.
    """
    whole = copy.deepcopy(dict(tables))
    other = Table(whole.pop("other_direction"), "other_direction", file, InvalidBuildingFile)
    other.known(OTHER_DIRECTION)
    in_y = Table(whole, "", f"{file}, other_direction", InvalidBuildingFile)
    storeys = other.tables("storeys") if "storeys" in other.values else []
    for key, read in (("building", in_y.table), ("storeys", in_y.tables)):
        if key in whole:
            read(key)  # what is not a table is refused before it is changed
    of_building, own = whole.setdefault("building", {}), whole.get("storeys", [])
    if storeys and len(storeys) != len(own):
        other.refuse("storeys", f"as many tables as the building has storeys, {len(own)}", str(len(storeys)))
    _merge([of_building, *own], {key: value for key, value in other.values.items() if key != "storeys"})
    for number, storey in enumerate(storeys):
        storey.known(OF_STOREYS)
        _merge([own[number]], storey.values)
        if any(key in storey.values for key in (*STIFFNESS, *STRENGTH)):
            for group in _REPLACED:
                if any(key in storey.values for key in group):
                    _drop(of_building, group)
    return in_y


def _merge(tables: list[dict[str, Any]], given: dict[str, Any]) -> None:
    """Put what is given into the first table, in place of what all of them have of it."""
    for table in tables:
        for key in given:
            table.pop(key, None)
        for group in _REPLACED:
            if any(key in given for key in group):
                _drop(table, group)
        if any(key in given for key in STRENGTH):
            _drop(table, DESIGN)
        if given.get("design") is True:
            _drop(table, STRENGTH)
    tables[0].update(given)


def _drop(table: dict[str, Any], keys: tuple[str, ...]) -> None:
    for key in keys:
        table.pop(key, None)
