"""The records that a path names: a folder, a list of files, or one file."""

from __future__ import annotations

from pathlib import Path

from seismass.base.errors import InvalidOption
from seismass.records.read import read_text
from seismass.records.suite import Suite, read_suite, suite_of_file


def records_named(path: Path, *, dt: float | None = None, unit: str | None = None) -> Suite:
    """Return the records that a path names: a folder, a CSV with a column `file`, or else one file.

    Raises
    ------
    InvalidOption
        A step or a unit is given for more than one record: a list has columns for them.
    RecordFormatError
        As for `read_suite` and `read_records`.
    """
    if not (path.is_dir() or is_list(path)):
        return suite_of_file(path, dt=dt, unit=unit)
    for name, value in (("--dt", dt), ("--unit", unit)):
        if value is not None:
            raise InvalidOption(
                f"{name} of {path.name} must be left out for a folder or a list of records; got {value}"
            )
    return read_suite(path)


def is_list(path: Path) -> bool:
    """Whether a .csv file lists records; one that is a record has no column `file`."""
    if path.suffix.lower() != ".csv":
        return False
    header = read_text(path).partition("\n")[0]
    return "file" in (column.strip().strip('"') for column in header.split(","))
