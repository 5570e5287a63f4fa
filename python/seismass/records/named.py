"""The records that a path names: a folder, a list of files, or one file."""

from __future__ import annotations

from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from seismass.base.errors import InvalidOption
from seismass.records.archive import is_archive
from seismass.records.read import FormatName, read_record, read_text
from seismass.records.suite import Suite, read_suite, suite_of_file


@dataclass(frozen=True)
class Reading:
    """What is typed of one file: step (s), unit, format, rows to leave out and channel; see `read_record`."""

    dt: float | None = None
    unit: str | None = None
    format: FormatName | None = None
    skip: int | None = None
    channel: str | None = None

    def refuse(self, path: Path, what: str) -> None:
        """Refuse every argument of a single file where there is none."""
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None:
                raise InvalidOption(f"--{field.name} of {path.name} must be left out for {what}; got {value}")

    def of_a_file(self) -> dict[str, Any]:
        """Return the arguments of `read_records`."""
        return {"dt": self.dt, "unit": self.unit, "format": self.format, "skip": self.skip}


def records_named(path: Path, reading: Reading = Reading()) -> Suite:
    """Return the records that a path names: a folder, a ZIP archive, a CSV with a column `file`, or else one file.
    Arguments of one file are refused for more than one record: a list has columns for them.
    """
    if path.is_dir() or is_archive(path) or is_list(path):
        reading.refuse(path, "a folder or a list of records")
        return read_suite(path)
    if reading.channel is not None:
        record = read_record(path, **reading.of_a_file(), channel=reading.channel)
        return Suite(record.name, (record,))
    return suite_of_file(path, **reading.of_a_file())


def is_list(path: Path) -> bool:
    """Whether a .csv file lists records; one that is a record has no column `file`."""
    if path.suffix.lower() != ".csv":
        return False
    header = read_text(path).partition("\n")[0]
    return "file" in (column.strip().strip('"') for column in header.split(","))
