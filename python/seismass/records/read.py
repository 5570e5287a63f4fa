"""Reading one record file, whatever its format."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Literal

from seismass._values import as_number, as_path, brief
from seismass.errors import RecordFormatError
from seismass.records.at2 import looks_like_at2, parse_at2
from seismass.records.columns import parse_columns
from seismass.records.record import Record
from seismass.units import ACCELERATION_UNITS


def read_record(
    path: str | os.PathLike[str],
    *,
    dt: float | None = None,
    unit: str | None = None,
    format: Literal["at2", "columns"] | None = None,
    skip: int | None = None,
) -> Record:
    r"""Read a ground motion record; accelerations come back in m/s2.

    Parameters
    ----------
    path : path-like
        A PEER .AT2 file of any vintage, or text of one column (acceleration) or two (time, acceleration).
    dt : float, optional
        Time step (s). One column needs it unless the file states it. For .AT2 it refines a step that the header
        rounded to four decimals (.0039 for 1/256 s). It must agree with what the file says.
    unit : {"g", "m/s2", "cm/s2"}, optional
        Unit of the accelerations in the file. .AT2 files are in g unless their header states another. Text has no
        default, a wrong one being wrong by a factor of ten: it must be given unless the header states it. It must agree
        with what the file says, where that is one of the three.
    format : {"at2", "columns"}, optional
        By default .AT2 by suffix or by its header, else columns.
    skip : int, optional
        Columns only: how many rows of numbers before the data are not data (see `parse_columns`).

    Raises
    ------
    RecordFormatError
        The file is missing, empty, damaged, cut off, not in the format, or contradicts itself or the arguments.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import mkdtemp
    >>> file = Path(mkdtemp(), "ramp.txt")
    >>> _ = file.write_text("time (s), acceleration (m/s2)\n0.00, 0.0\n0.01, 0.5\n0.02, 1.0\n")
    >>> read_record(file)
    <Record ramp: 3 x 0.01 s, PGA 0.1020 g>
    """
    source = as_path(path, "record", RecordFormatError)
    if dt is not None:
        dt = as_number(dt, "dt", source.name, RecordFormatError)
        if not (math.isfinite(dt) and dt > 0.0):
            raise RecordFormatError(f"dt of {source.name} must be a positive number; got {dt}")
    units = tuple(ACCELERATION_UNITS)
    if unit is not None and unit not in units:
        raise RecordFormatError(f"unit of {source.name} must be one of {', '.join(units)}; got {brief(unit)}")
    if format not in (None, "at2", "columns"):
        raise RecordFormatError(f"format of {source.name} must be at2 or columns; got {brief(format)}")
    text = read_text(source)
    if format == "at2" or (format is None and (source.suffix.lower() == ".at2" or looks_like_at2(text))):
        if skip is not None:
            raise RecordFormatError(f"skip of {source.name} must be left out for an .AT2 file; got {brief(skip)}")
        return parse_at2(text, source, dt=dt, unit=unit)
    return parse_columns(text, source, dt=dt, unit=unit, skip=skip)


def read_text(source: Path) -> str:
    """Return the text of a record file, with any line ends and with UTF-8 or Latin-1 letters."""
    try:
        content = source.read_bytes()
    except OSError as error:
        raise RecordFormatError(
            f"record file must be a file that can be read; got {source} ({error.strerror or error})"
        ) from error
    if b"\0" in content:
        raise RecordFormatError(f"content of {source.name} must be text; got binary data")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("latin-1")
    text = text.rstrip("\x1a\r\n\t ")  # DOS ended files with a control character
    if not text:
        raise RecordFormatError(f"content of {source.name} must be a record; got an empty file")
    return text
