"""Head of a calculation page: project, number, author, checker and date, as the table [project] of a building file."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime
from typing import Final

from seismass.base.input_table import Table
from seismass.base.values import brief, printable

PROJECT: Final = ("name", "number", "author", "checker", "date")
"""Keys of the table."""


@dataclass(frozen=True)
class Project:
    """Head of a calculation page; texts are empty where the file does not state them.

    Attributes
    ----------
    name, number, author, checker : str
        Project, its number, who made the calculation and who checked it.
    date : str
        Date of the calculation, as 2026-11-25.
    """

    name: str = ""
    number: str = ""
    author: str = ""
    checker: str = ""
    date: str = ""


NO_PROJECT: Final = Project()
"""The project of a file that states none."""


def project_of(table: Table) -> Project:
    """Return what a table [project] says."""
    return Project(
        **{key: printable(table.text(key)) for key in PROJECT if key != "date"},
        date=_date(table),
    )


def _date(table: Table) -> str:
    """A date of TOML, or a text that is one."""
    value = table.values.get("date", "")
    if isinstance(value, date) and not isinstance(value, datetime):
        return value.isoformat()
    if value == "":
        return ""
    try:
        return date.fromisoformat(value).isoformat()
    except (TypeError, ValueError):
        table.refuse("date", "a date, such as 2026-11-25", brief(value))
