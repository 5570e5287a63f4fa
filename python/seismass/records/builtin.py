"""The built-in suites: synthetic motions stored with the package, so that a study runs without any recording."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Final, Literal

from seismass.base.errors import InvalidOption, RecordFormatError
from seismass.base.values import brief, is_one_of, refusal
from seismass.records.read import read_record
from seismass.records.record import Record
from seismass.records.suite import Suite, read_suite

BuiltinName = Literal["eleven", "seven"]

_SUITES: Final = {"eleven": ("built-in suite of eleven", "suite.csv"), "seven": ("built-in suite", "seven.csv")}
"""Name of each suite as results show it, and the list of its motions."""


def data_directory() -> Path:
    """Return the folder of the stored data: inside an installed package, or at the top of the source tree."""
    package = Path(__file__).parents[1]
    tree = package.parents[1]
    # In the source tree a development build leaves a copy in the package, which the files themselves outdate. The
    # folder above an installed package may be a project too, and not this one.
    place = (tree if (tree / "crates" / "seismass").is_dir() else package) / "data"
    if not (place / "synthetic" / "suite.csv").is_file():
        raise RecordFormatError(f"built-in suite must be in {place}, as it was installed; got no suite.csv there")
    return place


def builtin_suite(suite: BuiltinName = "eleven") -> Suite:
    """Return the synthetic motions that `seismass.records.synthetic` made; none is a recording.

    Parameters
    ----------
    suite : {"eleven", "seven"}
        "eleven": all of them, as many as ASCE 7-16 asks for. "seven": the first seven, as many as ASCE 7-10 asks for.
        The numbers that this project publishes, and the commands and `assess` by default, are with those.

    Raises
    ------
    InvalidOption
        Another name.
    """
    found = next((listed for key, listed in _SUITES.items() if is_one_of(suite, (key,))), None)
    if found is None:
        raise refusal(InvalidOption, "suite", "built-in motions", " or ".join(map(repr, _SUITES)), brief(suite))
    name, listed = found
    return Suite(name, read_suite(data_directory() / "synthetic" / listed).records)


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
