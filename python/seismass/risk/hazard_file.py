"""A hazard curve of the user's: a CSV of intensity (g) and annual rate of exceedance, refused with its line."""

from __future__ import annotations

import csv
import io
import os
import re
from typing import Final

import numpy as np

from seismass.base.errors import RecordFormatError
from seismass.base.files import read_utf8
from seismass.base.values import FloatArray, as_path, brief, frozen, printable, refusal, short

RATE_WORDS: Final = frozenset({"rate", "rates", "lambda", "frequency", "afe", "mafe"})
"""Words of which one is in the name of the column of rates."""
INTENSITY_WORDS: Final = frozenset({"sa", "im", "iml", "pga", "intensity", "acceleration"})
"""Words with which the name of the column of intensities begins."""
_OTHER_UNITS: Final = frozenset({"m", "cm", "mm", "gal", "gals", "ms2", "cms2", "percent"})


def read_hazard(path: str | os.PathLike[str]) -> tuple[FloatArray, FloatArray, str]:
    """Return intensities (g), annual rates and the name of a CSV; see `HazardCurve.from_csv`."""
    source = as_path(path, "hazard curve", RecordFormatError)
    try:
        text = read_utf8(source)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not text"
        got = f"{source} ({reason})"
        raise refusal(RecordFormatError, "path", "hazard curve", "a file of text that can be read", got) from None
    return (*_parsed(text, printable(source.name)), printable(source.stem))


def _parsed(text: str, file: str) -> tuple[FloatArray, FloatArray]:
    rows = _rows(text, file)
    columns = (0, 1)
    if rows and not all(_number(cell) is not None for cell in rows[0][1][:2]):
        line, header = rows.pop(0)
        columns = _columns(header, f"{file}, line {line},")
    points: list[tuple[float, float]] = []
    for line, row in rows:
        place = f"{file}, line {line},"
        values = []
        for name, column in zip(("intensity", "annual rate"), columns, strict=True):
            cell = row[column] if column < len(row) else ""
            value = _number(cell)
            if value is None or not 0.0 < value < np.inf:
                raise refusal(RecordFormatError, name, place, "a positive number", brief(cell))
            values.append(value)
        if points:
            for name, now, before, larger in zip(
                ("intensity", "annual rate"), values, points[-1], (True, False), strict=True
            ):
                if not (now > before if larger else now < before):
                    requirement = f"{'above' if larger else 'below'} that of the point before"
                    raise refusal(RecordFormatError, name, place, requirement, f"{now:g} after {before:g}")
        points.append((values[0], values[1]))
    if len(points) < 2:
        requirement = "at least two rows of intensity and annual rate"
        raise refusal(RecordFormatError, "points", file, requirement, str(len(points)))
    intensities, rates = zip(*points, strict=True)
    return frozen(intensities), frozen(rates)


def _rows(text: str, file: str) -> list[tuple[int, list[str]]]:
    """Rows that are neither empty nor comments, each with its line, counted from 1."""
    reader = csv.reader(io.StringIO(text))
    rows = []
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            if any(cells) and not cells[0].startswith("#"):
                rows.append((reader.line_num, cells))
    except csv.Error as error:
        raise refusal(RecordFormatError, "content", file, "a table in CSV", str(error)) from error
    return rows


def _columns(header: list[str], place: str) -> tuple[int, int]:
    """Index of the intensity and of the rate, by the words of their names."""
    words = [re.findall(r"[a-z]+\d*", cell.lower()) for cell in header]
    rates = [index for index, cell in enumerate(words) if RATE_WORDS.intersection(cell)]
    intensities = [
        index for index, cell in enumerate(words) if index not in rates and cell and cell[0] in INTENSITY_WORDS
    ]
    if len(rates) != 1 or len(intensities) != 1:
        requirement = "one of an intensity (Sa, IM, PGA) and one of an annual rate (rate, lambda, MAFE)"
        raise refusal(RecordFormatError, "columns", place, requirement, short(", ".join(header)))
    unit = _OTHER_UNITS.intersection(words[intensities[0]][1:])
    if unit:
        raise refusal(RecordFormatError, "unit of the intensity", place, "g", short(header[intensities[0]]))
    return intensities[0], rates[0]


def _number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None
