"""Files of matched records: .AT2 as PEER has it, and two-column CSV, both read back by `read_record`."""

from __future__ import annotations

import os
from pathlib import Path

from seismass.base.errors import InvalidOption
from seismass.base.files import written_whole
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import as_path, brief, is_one_of, refusal
from seismass.records.record import Record

SUFFIXES = (".at2", ".csv")


def write_record(record: Record, path: str | os.PathLike[str]) -> None:
    """Write a record as .AT2, in g to eleven digits, or .csv, time (s) and acceleration (m/s2) to the last bit, by the
    suffix of `path`. A vertical component is left out.
    """
    target = as_path(path, "matched record", InvalidOption)
    kind = target.suffix.lower()
    if not is_one_of(kind, SUFFIXES):
        raise refusal(InvalidOption, "path", "matched record", "a name that ends in .AT2 or .csv", brief(target.name))
    text = _at2(record) if kind == ".at2" else _csv(record)
    with written_whole(Path(target)) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def _at2(record: Record) -> str:
    values = record.acceleration / STANDARD_GRAVITY
    step = f"{record.dt:.10f}".rstrip("0")
    head = (
        "SPECTRALLY MATCHED MOTION, NOT AS RECORDED (seismass)",
        _one_line(", ".join((record.event, record.station, record.component))),
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {record.samples:6d}, DT= {step} SEC",
    )
    lines = ("".join(f"{value:18.10E}" for value in values[row : row + 5]) for row in range(0, len(values), 5))
    return "\n".join((*head, *lines)) + "\n"


def _csv(record: Record) -> str:
    said = [f"# {_one_line(sentence)}" for sentence in (*record.history, *record.remarks)]
    rows = (f"{number * record.dt:.10g},{value!r}" for number, value in enumerate(record.acceleration.tolist()))
    return "\n".join((*said, "time (s),acceleration (m/s2)", *rows)) + "\n"


def _one_line(text: str) -> str:
    return " ".join(text.split())
