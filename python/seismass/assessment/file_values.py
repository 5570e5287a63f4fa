"""Values of a building file: a storey's own, or else the default of all storeys."""

from __future__ import annotations

import math
from typing import Final, NoReturn

from seismass.base.input_table import POSITIVE, Need, Table

STRONG: Final = Need("positive (inf: the storey stays elastic)", lambda number: number > 0.0)
"""What a strength must be."""
REDUCTION: Final = Need("finite and at least 1", lambda number: 1.0 <= number < math.inf)
"""What R must be."""


def held(tables: tuple[Table, ...], group: tuple[str, ...]) -> tuple[Table, str] | None:
    """Return where a value stands: in the first of the tables that has it, a storey's own before the defaults."""
    for table in tables:
        for key in group:
            if key in table.values:
                return table, key
    return None


def key_of(storey: Table, default: Table, group: tuple[str, ...]) -> str:
    """Return the key that states a value of a storey; empty where none does."""
    place = held((storey, default), group)
    return "" if place is None else place[1]


def number_of(place: tuple[Table, str], need: Need) -> float:
    """Return the number that stands at a place."""
    table, key = place
    return table.number(key, need=need)


def stated(storey: Table, default: Table, key: str, need: Need, value: float) -> float:
    """Return a number of a storey or of the defaults, or the value that stands for a missing one."""
    place = held((storey, default), (key,))
    return value if place is None else number_of(place, need)


def positive(storey: Table, default: Table, key: str, value: float | None = None) -> float:
    """Return a positive number of a storey or of the defaults; a missing one is refused where there is no value."""
    if value is not None:
        return stated(storey, default, key, POSITIVE, value)
    place = held((storey, default), (key,))
    if place is None:
        storey.refuse(key, f"given, or {default.key(key)} for all storeys", "nothing")
    return number_of(place, POSITIVE)


def missing(storey: Table, default: Table, group: tuple[str, ...]) -> NoReturn:
    """Refuse a quantity that is stated nowhere."""
    others = "".join(f", or {key}" for key in group[1:])
    storey.refuse(group[0], f"given{others}, here or in {default.place}", "nothing")
