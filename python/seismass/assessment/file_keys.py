"""The keys of a building file as data: which tables have a key, in which units, what a number must be, its default.

Each key has one row in `data/tables/building_keys.csv`. What is known, refused and proposed, the numbers with their
ranges and defaults, the sources of quantities and the tables of docs/building_file.md follow from it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple, NoReturn

from seismass.base.files import stored_rows
from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, SHARE, Need, Table
from seismass.base.units import FOOT, KIP, STANDARD_GRAVITY
from seismass.model.springs import SHAPE_FIELDS

SI: Final = "si"
US: Final = "us"
SYSTEMS: Final = (SI, US)
"""What `units` of a file may be."""
DEFAULT: Final = "default"
"""Source of a quantity that the file does not state."""
_US_UNITS: Final = {
    "m": FOOT,
    "m2": FOOT**2,
    "kPa": 1e-6 * KIP / FOOT**2,
    "kg": KIP / STANDARD_GRAVITY,
    "kN": 1e-3 * KIP,
    "kN/m": 1e-3 * KIP / (FOOT / 12.0),
}
"""The unit of a key in US units (ft, ft2, psf, kip of weight, kip, kip/in), in that of the key."""
NEEDS: Final = {
    "positive": POSITIVE,
    "not negative": NOT_NEGATIVE,
    "share": SHARE,
    "strong": Need("positive (inf: the storey stays elastic)", lambda number: number > 0.0),
    "reduction": Need("finite and at least 1", lambda number: 1.0 <= number < math.inf),
    **{
        name: Need(field.requirement, lambda number, field=field: bool(field.accepts(number)))  # type: ignore[misc]
        for name, field in SHAPE_FIELDS.items()
    },
}
"""What a number must be, by the word of a row."""


class Key(NamedTuple):
    """A row: the tables that have the key, the quantities that it states, its names without a unit by the `units` of a
    file and in US units (empty: none), the range and the default of a number (NaN: none), unit, default and meaning.
    """

    tables: tuple[str, ...]
    key: str
    quantities: tuple[str, ...]
    plain: Mapping[str, str]
    us: str
    need: Need | None
    number: float
    unit: str
    default: str
    meaning: str


def _key(row: dict[str, str]) -> Key:
    names = row["plain"].split()
    return Key(
        tuple(row["tables"].split(" ")),
        row["key"],
        tuple(row["quantity"].split()),
        dict(zip(SYSTEMS, (names[0], names[-1]), strict=True)) if names else {},
        row["us"],
        NEEDS.get(row["need"]),
        float(row["default"]) if re.fullmatch(r"[\d.]+", row["default"]) else math.nan,
        row["unit"],
        row["default"],
        row["meaning"],
    )


ROWS: Final = tuple(_key(row) for row in stored_rows("building_keys"))
KEYS: Final = {
    table: {row.key: row for row in ROWS if table in row.tables}
    for table in dict.fromkeys(table for row in ROWS for table in row.tables)
}
"""Keys of each table of a building file, the file itself first."""


def keys_of(quantity: str) -> tuple[str, ...]:
    """Return the keys that state a quantity."""
    return tuple(row.key for row in ROWS if quantity in row.quantities)


def spelled(keys: Sequence[str]) -> tuple[str, ...]:
    """Return keys with those in US units and without a unit that stand in their place."""
    rows = [row for row in ROWS if row.key in keys]
    return (*keys, *(row.us for row in rows if row.us), *(name for row in rows for name in row.plain.values()))


def _rows(table: Table) -> dict[str, Key]:
    """Keys of a table by its place, as storeys[2].goods[1] or goods.on_racks."""
    place = re.sub(r"\[\d+\]", "", table.place)
    return KEYS.get(place) or KEYS[place.rpartition(".")[2]]


def known(table: Table, units: str | None = "") -> None:
    """Refuse keys that are not known, and put those without a unit (`units` of the file: "", "si" or "us") and in US
    units into SI units, in place; with None they stay. A key stated in two units is refused.
    """
    rows = _rows(table)
    plain = {name: row for row in rows.values() for system, name in row.plain.items() if units in (system, None)}
    in_us = {row.us: row for row in rows.values() if row.us}
    table.known(tuple(rows), also=(*in_us, *plain))
    if units is None:
        return
    for name, row in plain.items():
        key = row.us if units == US else row.key
        if name in table.values:
            table.excluded(name, key)
            table.values[key] = table.values.pop(name)
    for name, row in in_us.items():
        if name in table.values:
            table.excluded(name, row.key)
            table.values[row.key] = _US_UNITS[row.unit] * table.number(name, need=row.need)
            del table.values[name]


def number(table: Table, key: str) -> float:
    """Return a number that its row admits; the row's default, or NaN, where the table does not have it."""
    row = _rows(table)[key]
    return table.number(key, need=row.need) if key in table.values else row.number


def optional(table: Table, key: str) -> float | None:
    """Return a number that its row admits; None where the table does not have it."""
    return number(table, key) if key in table.values else None


def held(tables: tuple[Table, ...], keys: tuple[str, ...]) -> tuple[Table, str] | None:
    """Return where a value stands: in the first of the tables that has it, a storey's own before the defaults."""
    return next(((table, key) for table in tables for key in keys if key in table.values), None)


def stated(storey: Table, default: Table, key: str) -> float:
    """Return a number of a storey or of the defaults; the row's default, or NaN, where neither has it."""
    return number(default if key not in storey.values else storey, key)


def needed(storey: Table, default: Table, key: str) -> float:
    """Return a number of a storey or of the defaults, of which one must have it."""
    if held((storey, default), (key,)) is None:
        storey.refuse(key, f"given, or {default.key(key)} for all storeys", "nothing")
    return stated(storey, default, key)


def missing(storey: Table, default: Table, keys: tuple[str, ...]) -> NoReturn:
    """Refuse a quantity that is stated nowhere."""
    others = "".join(f", or {key}" for key in keys[1:])
    storey.refuse(keys[0], f"given{others}, here or in {default.place}", "nothing")


def _quantities() -> Iterator[tuple[str, str, bool, frozenset[str]]]:
    """Quantities with the table of their defaults, whether storeys have them, and the keys that state them."""
    for of_storeys in (True, False):
        for place in ("building", "goods"):
            rows = [
                row
                for row in KEYS[place].values()
                if of_storeys == any(table.startswith("storeys") for table in row.tables)
            ]
            for name in dict.fromkeys(name for row in rows for name in row.quantities):
                yield name, place, of_storeys, frozenset(spelled([r.key for r in rows if name in r.quantities]))


def sources_of(file: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """Return each quantity with the keys that state it, as the file has them, or `DEFAULT`."""
    sources = {}
    for name, place, of_storeys, keys in _quantities():
        parts = [
            f"{place}.{key}" for key, value in (file.get(place) or {}).items() if key in keys and value is not None
        ]
        places: dict[str, list[str]] = {}
        for floor, storey in enumerate(file.get("storeys") or [] if of_storeys else [], start=1):
            kinds = (storey.get("goods") or []) if place == "goods" else []
            of_kinds = [(f"goods.{key}", value) for kind in kinds for key, value in kind.items()]
            for key, value in (*storey.items(), *of_kinds):
                if key.removeprefix("goods.") in keys and value is not None:
                    places.setdefault(key, []).append(str(floor))
        parts += [f"storeys[{', '.join(dict.fromkeys(numbers))}].{key}" for key, numbers in places.items()]
        sources[name] = ("; " if of_storeys else ", ").join(parts) or DEFAULT
    for name in ("site", "code"):
        stated = file.get(name) or {}
        sources[name] = ", ".join(f"{name}.{key}" for key in stated if stated[key] is not None) or DEFAULT
    return tuple(sources.items())
