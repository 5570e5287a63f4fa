"""The columns of the tables of a study, as the package knows them."""

from __future__ import annotations

from pages.parts import Page, table
from seismass.studies.study import SCHEMA_VERSION, TABLES
from seismass.studies.study.parameters import KEYS


def fill(page: Page) -> None:
    """Put in the version, the columns of all tables and those of each, below its heading."""
    page.words("Schema version {}. SI units", SCHEMA_VERSION)
    page.tables(columns({key: TABLES["fractions"][1][key] for key in KEYS}))
    for name, (rows, found) in TABLES.items():
        of_buildings = set(KEYS) <= set(found)
        page.words(f"## {name}: {rows} {'Beside the columns above: ' if of_buildings else ''}| column")
        page.tables(columns({key: text for key, text in found.items() if not (of_buildings and key in KEYS)}))


def columns(found: dict[str, tuple[str, str]]) -> str:
    """Return the table of some columns."""
    return table("column | unit | meaning", ([f"`{name}`", *text] for name, text in found.items()))
