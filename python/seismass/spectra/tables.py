"""A target spectrum from a table of the user's: a CSV of period (s) and Sa (g)."""

from __future__ import annotations

import csv
import io
import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from seismass.base.elementary import exp, log
from seismass.base.errors import RecordFormatError
from seismass.base.files import read_utf8
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_path, brief, frozen, printable, refusal, short
from seismass.spectra.checks import OWNER
from seismass.spectra.period_table import PeriodTable


@dataclass(frozen=True, eq=False)
class CsvTable(PeriodTable):
    """Sa (g) at periods (s) from a file, linear in logarithms between them."""

    label: str
    file: str

    @property
    def parameters(self) -> dict[str, Any]:
        """The file's name and its points."""
        return {"shape": "csv", "file": self.file, **self.points}

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return Sa (m/s2)."""
        log_ordinates = np.interp(log(periods), log(self.periods), log(self.sa_g))
        return STANDARD_GRAVITY * exp(log_ordinates)


def csv_shape(path: str | os.PathLike[str]) -> CsvTable:
    """Return the shape of a CSV, of which `TargetSpectrum.from_csv` says what it must be."""
    source = as_path(path, OWNER, RecordFormatError)
    periods, ordinates = read_table(path)
    return CsvTable(periods, ordinates, printable(source.stem), printable(source.name))


def read_table(path: str | os.PathLike[str], *, zero: bool = False) -> tuple[FloatArray, FloatArray]:
    """Return the periods (s) and Sa (g) of a CSV; with `zero` the first period may be 0."""
    source = as_path(path, OWNER, RecordFormatError)
    try:
        text = read_utf8(source)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not text"
        requirement = "a file of text that can be read"
        raise refusal(RecordFormatError, "path", OWNER, requirement, f"{source} ({reason})") from None
    return _parse_csv(text, source.name, zero)


def _parse_csv(text: str, file: str, zero: bool) -> tuple[FloatArray, FloatArray]:
    text, separator = _with_points(text)
    try:
        rows = [
            [cell.strip() for cell in row]
            for row in csv.reader(io.StringIO(text), delimiter=separator)
            if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")
        ]
    except csv.Error as error:
        raise refusal(RecordFormatError, "content", file, "a table in CSV", str(error)) from error
    columns = (0, 1)
    if rows and not _is_number(rows[0][0]):
        columns = _named_columns(rows.pop(0), file)
    points = []
    for number, row in enumerate(rows, start=1):
        for name, column in zip(("period", "Sa"), columns, strict=True):
            cell = row[column] if column < len(row) else ""
            at_zero = zero and number == 1 and name == "period" and _is_number(cell) and float(cell) == 0.0
            if not (at_zero or (_is_number(cell) and 0.0 < float(cell) < np.inf)):
                raise refusal(RecordFormatError, name, f"{file}, point {number},", "a positive number", brief(cell))
        points.append([float(row[column]) for column in columns])
    if len(points) < 2:
        raise refusal(RecordFormatError, "points", file, "at least two rows of period and Sa", str(len(points)))
    periods, ordinates = (frozen(column) for column in zip(*points, strict=True))
    falling = np.flatnonzero(np.diff(periods) <= 0.0)
    if len(falling):
        number = int(falling[0]) + 2
        got = f"{periods[number - 1]:g} after {periods[number - 2]:g}"
        raise refusal(RecordFormatError, "period", f"{file}, point {number},", "longer than the one before", got)
    return periods, ordinates


def _with_points(text: str) -> tuple[str, str]:
    """Return a text with points for decimal commas, and what separates its cells: where there are semicolons, those."""
    if ";" not in text:
        return text, ","
    rows = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    cells = [cell for line in rows[-1:] for cell in line.split(";")]
    decimal = any("," in cell for cell in cells) and not any("." in cell for cell in cells)
    return text.replace(",", ".") if decimal else text, ";"


def _named_columns(header: list[str], file: str) -> tuple[int, int]:
    words = [cell.lower().replace("(", " ").replace("_", " ").split() for cell in header]
    found = []
    for names in (("period", "t"), ("sa",)):
        columns = [index for index, cell in enumerate(words) if cell and cell[0] in names]
        if len(columns) != 1:
            requirement = "one period or T and one Sa"
            raise refusal(RecordFormatError, "columns", file, requirement, short(", ".join(header)))
        found.append(columns[0])
    of_period = [word.strip("()[]") for word in words[found[0]][1:]]
    if of_period and of_period[0] not in ("s", "sec", "seconds", ""):
        raise refusal(RecordFormatError, "unit of period", file, "s", " ".join(of_period))
    unit = [word.strip("()[]") for word in words[found[1]][1:]]
    if unit and unit != ["g"]:
        raise refusal(RecordFormatError, "unit of Sa", file, "g", short(" ".join(unit)))
    return found[0], found[1]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
