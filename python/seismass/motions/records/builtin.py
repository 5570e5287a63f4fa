"""The built-in suites: synthetic motions stored with the package, so that a study runs without any recording."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

from seismass.base.arguments import is_one_of
from seismass.base.errors import InvalidOption
from seismass.base.files import data_directory
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import brief, refusal
from seismass.motions.records.read import FormatName, is_archive, read_record, read_text
from seismass.motions.records.record import Record

if TYPE_CHECKING:
    from seismass.motions.records.pair import Pairs
    from seismass.motions.records.suite import Suite

BuiltinName = Literal["forty", "eleven", "seven"]

_SUITES: Final = {
    "forty": ("built-in suite of forty synthetic motions", "forty.parquet"),
    "eleven": ("built-in suite of eleven synthetic motions", "suite.csv"),
    "seven": ("built-in suite", "seven.csv"),
}
"""Name of each suite as results show it, and the table or the list of its motions."""


MICRO: Final = 1e-6
"""Unit of the stored samples of the forty (g)."""


def builtin_suite(suite: BuiltinName = "eleven") -> Suite:
    """Return the synthetic motions that `seismass.motions.records.synthetic` made; none is a recording.

    Parameters
    ----------
    suite : {"eleven", "seven", "forty"}, default "eleven"
        "forty": those of `records.synthetic.scenarios`, whose scatter is that of recordings; what `assess` and
        the commands that give an answer take by default. "eleven": as many as ASCE 7-16 asks for. "seven": the first
        seven of those, as many as ASCE 7-10 asks for, with which the study of the paper is.

    Raises
    ------
    InvalidOption
        Another name.
    """
    entry = next((listed for key, listed in _SUITES.items() if is_one_of(suite, (key,))), None)
    if entry is None:
        raise refusal(InvalidOption, "suite", "built-in motions", " or ".join(map(repr, _SUITES)), brief(suite))
    from seismass.motions.records.suite import Suite, read_suite

    name, listed = entry
    if listed.endswith(".parquet"):
        return Suite(name, _forty())
    return Suite(name, read_suite(data_directory() / "synthetic" / listed).records)


def builtin_pairs() -> Pairs:
    """Return the forty synthetic motions with their second horizontal components, which none recorded either.

    The second ones are those of `records.synthetic.scenarios`: of the duration and content of the first, with a
    correlation and spectra that scatter as those of recorded pairs.
    """
    from seismass.motions.records.pair import Pair, Pairs

    name, _ = _SUITES["forty"]
    seconds = _stored("forty_second.parquet", "second horizontal")
    return Pairs(name, tuple(Pair(first, second) for first, second in zip(_forty(), seconds, strict=True)))


def _forty() -> tuple[Record, ...]:
    return _stored(_SUITES["forty"][1], "horizontal")


@cache
def _stored(table: str, component: str) -> tuple[Record, ...]:
    """The motions of a table, read once per process."""
    import polars as pl

    rows = pl.read_parquet(data_directory() / "synthetic" / table)
    return tuple(
        Record(
            acceleration=row["acceleration"] * (MICRO * STANDARD_GRAVITY),
            dt=row["dt"],
            name=row["name"],
            event="synthetic",
            station="none",
            component=component,
            synthetic=True,
            remarks=(row["note"], row["parameters"]),
        )
        for row in (
            {**one, "acceleration": samples.to_numpy()}
            for one, samples in zip(rows.drop("acceleration").iter_rows(named=True), rows["acceleration"], strict=True)
        )
    )


def builtin_record(name: str) -> Record:
    """Return one of the built-in synthetic motions by its name, "synthetic-1" to "synthetic-11".

    Raises
    ------
    InvalidOption
        No built-in motion has that name.
    """
    listed = _listed()
    row = next((row for key, row in listed.items() if is_one_of(name, (key,))), None)
    if row is None:
        first, *_, last = listed
        raise refusal(InvalidOption, "name", "built-in motion", f"one from {first} to {last}", brief(name))
    record = read_record(data_directory() / "synthetic" / row["file"])
    return record.replace(remarks=(*record.remarks, row["note"]))


def builtin_names() -> tuple[str, ...]:
    """Return the names of the built-in synthetic motions."""
    return tuple(_listed())


def _listed() -> dict[str, dict[str, str]]:
    """The rows of the list of the built-in motions by name."""
    text = (data_directory() / "synthetic" / "suite.csv").read_text(encoding="utf-8")
    return {Path(row["file"]).stem: row for row in csv.DictReader(io.StringIO(text))}


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
    from seismass.motions.records.suite import Suite, read_suite, suite_of_file

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
