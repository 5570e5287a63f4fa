"""The keys of a building file, and the columns of the tables of an assessment, as the package knows them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Final

from pages.parts import Page, table
from seismass.assessment.file_keys import ROWS, SI, US, Key
from seismass.media.result import stored_tables

US_UNITS: Final = {"m": "ft", "m2": "ft2", "kPa": "psf", "kg": "kip", "kN": "kip", "kN/m": "kip/in"}
SECTIONS: Final[tuple[Callable[[set[str]], bool], ...]] = (
    lambda tables: tables == {""},
    lambda tables: tables == {"project"},
    lambda tables: tables == {"site"},
    lambda tables: tables == {"code"},
    lambda tables: "building" in tables and "storeys" not in tables,
    lambda tables: tables == {"storeys"} or tables >= {"building", "storeys"},
    lambda tables: "goods" in tables,
    lambda tables: tables <= {"on_racks", "stops", "walls", "base"},
    lambda tables: tables == {"storeys.goods"},
)
"""Whether a row with these tables stands in each table of the page, in the order of the page."""


def fill(page: Page) -> None:
    """Put in the tables of keys, of those without a unit and of those in US units, and the columns of all tables."""
    page.tables(*(key_table(row for row in ROWS if belongs(set(row.tables))) for belongs in SECTIONS))
    plain = {name: row for row in ROWS for name in row.plain.values()}
    page.tables(table("key | `si` | `us`", ([f"`{name}`", *systems(name, row)] for name, row in plain.items())))
    in_us = {row.us: row.key for row in ROWS if row.us}
    page.tables(table("key | in place of", ([f"`{name}`", f"`{key}`"] for name, key in in_us.items())))
    columns: list[list[str]] = []
    for name, (words, rows) in stored_tables("assessment").items():
        columns.append([f"`{name}`", "", "", words])
        columns += (
            ["", f"`{column}`", row["unit"].replace("drift", "1 or m"), row["meaning"]] for column, row in rows.items()
        )
    page.tables(table("table | column | unit | meaning", columns))


def systems(name: str, row: Key) -> list[str]:
    """Return the unit of a key without one in both systems, or what it is called in the other."""
    units = {SI: row.unit, US: US_UNITS[row.unit]}
    return [units[system] if row.plain[system] == name else f"none: `{row.plain[system]}`" for system in units]


def key_table(rows: Iterable[Key]) -> str:
    """Return a table of keys; one without a meaning of its own stands in the line of the one before it."""
    lines: list[list[Key]] = []
    for row in rows:
        if row.meaning:
            lines.append([])
        lines[-1].append(row)
    return table("key | unit | default | meaning", map(cells_of, lines))


def cells_of(rows: list[Key]) -> list[str]:
    """Return the cells of a line; keys of one quantity, or of walls and a base, are alternatives."""
    first = rows[0]
    place = first.tables[0]
    if place in ("", "storeys.goods") or "storeys" in first.tables:
        place = ""
    names = [f"`{place}.{row.key}`" if place else f"`{row.key}`" for row in rows]
    alternatives = place in ("walls", "base") or (not place and first.quantities)
    units, defaults = ([row.unit for row in rows], [row.default for row in rows])
    cells = [", ".join(dict.fromkeys(filter(None, texts))) for texts in (units, defaults)]
    return [(", or " if alternatives else ", ").join(names), *cells, first.meaning]
