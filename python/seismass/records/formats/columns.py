"""Plain text records: one column of accelerations, or time and acceleration.

Nothing is guessed that could be wrong by a factor: the unit comes from the file or from the caller, and numbers before
the data that are not data (a scale and the step, a count and the step) are recognised or refused, never samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, stated_unit, unknown_unit
from seismass.base.values import as_count, printable
from seismass.records.formats.common import Arguments, Channel, Format, NotRead
from seismass.records.formats.headers import other_quantity, stated_points, stated_step
from seismass.records.formats.numbers import is_cut_off, is_number, to_float
from seismass.records.formats.pairs import uniform_step
from seismass.records.record import Record

SHORTEST_STEP: Final = 1e-4
LONGEST_STEP: Final = 0.1
"""Between these (s) a number before the data may be a step."""

OUTSTANDING: Final = 5.0
"""A first number larger than the early samples by this factor is no sample unless the caller says so."""

EARLY: Final = 22
"""Rows that are looked at to tell first numbers from samples."""

HEADER_CHARACTERS: Final = 10_000
"""A header says what it has to say in so much text."""

FIRST_TIME: Final = 1.5
"""A first time is 0 or one step, or there was something before it."""

NO_COUNT: Final = "the file states no number of points: a missing end would not show"

_COMMENT = ("#", "%", "//", "!")
_SEPARATORS: Final = str.maketrans(",;", "  ")
_CHARACTERS: Final = frozenset("+-.0123456789Ee")


@dataclass(frozen=True)
class _Table:
    """The rows of numbers of a file as lines, the text around them, and where they begin in the file."""

    file: str
    text: str
    rows: list[str]
    lines: list[str]
    start: int
    left_out: int = 0

    def row(self, index: int) -> list[str]:
        """Return the numbers of a row as written."""
        return _split(self.rows[index])

    def line_number(self, index: int) -> int:
        """Return the line of a row, as editors count them."""
        numbered = (number for number, line in enumerate(self.lines, start=1) if number > self.start and _is_row(line))
        return next(islice(numbered, index + self.left_out, None))

    def without(self, count: int) -> _Table:
        """Return the table without its first rows."""
        return _Table(self.file, self.text, self.rows[count:], self.lines, self.start, self.left_out + count)


def _split(line: str) -> list[str]:
    return line.translate(_SEPARATORS).split()


def _is_row(line: str) -> bool:
    return not line.lstrip().startswith(_COMMENT) and bool(line.translate(_SEPARATORS).strip())


def parse_columns(
    text: str, source: Path, *, dt: float | None = None, unit: str | None = None, skip: int | None = None
) -> Record:
    """Read the text of a one- or two-column file.

    Parameters
    ----------
    text : str
        The whole file: header lines (not numbers, or marked #, %, // or !), then one number a line, or two.
        Numbers are separated by blanks, commas or semicolons.
    source : Path
        Where it came from: gives the name, and is named in errors.
    dt : float, optional
        Step (s). Needed for one column unless the file states it; must agree with a file that does.
    unit : str, optional
        "g", "m/s2" or "cm/s2". Needed unless the header states it; must agree with a header that does.
    skip : int, optional
        How many rows of numbers before the data are not data. By default 0, except that a first row, or a first pair of
        rows, that gives the number of points (or a scale of 1) and the step is recognised as such.

    Raises
    ------
    RecordFormatError
        No step or no unit, times that are not uniform, rows of different length, something that is not a number,
        a file that is cut off, or first numbers that look like no samples but could be.
    """
    table = _read_table(text, source.name)
    other = other_quantity(table.text)
    if other:
        raise NotRead(f"quantity of {table.file} must be acceleration; got {other}")
    remarks: list[str] = []
    if any(not line.strip() for line in table.lines[table.start :]):
        remarks.append("blank lines stand among the numbers: some may be missing or moved")
    if skip is None:
        table, step_before = _without_first_numbers(table, dt, remarks)
    else:
        left_out = as_count(skip, "skip", table.file, RecordFormatError)
        if left_out >= len(table.rows):
            raise RecordFormatError(f"skip of {table.file} must be between 0 and {len(table.rows) - 1}; got {left_out}")
        table, step_before = table.without(left_out), None
    tokens, numbers = _numbers(table)
    columns = _column_count(table, len(tokens))
    values = numbers.reshape(-1, columns)
    wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if len(wrong):
        raise RecordFormatError(f"line {table.line_number(int(wrong[0]))} of {table.file} must be finite; got infinity")
    last = tokens[columns - 1 :: columns]
    if is_cut_off(last):
        raise RecordFormatError(
            f"last number of {table.file} must be written as the others are; got {last[-1]!r}: the file is cut off"
        )
    points = stated_points(table.text)
    if points is None and not any("number of points" in remark for remark in remarks):
        remarks.append(NO_COUNT)
    if points not in (None, len(values)):
        raise RecordFormatError(f"points of {table.file} must be {points}, as its header says; got {len(values)}")
    steps = {"dt": dt, "header": stated_step(table.text, table.file), "first numbers": step_before}
    if columns == 2:
        if abs(values[0, 0]) > FIRST_TIME * (values[-1, 0] - values[0, 0]) / max(len(values) - 1, 1):
            remarks.append(f"the first time is {values[0, 0]:g} s: a beginning may be missing; it is taken as zero")
        steps["times"] = uniform_step(values[:, 0], tokens[::2], table.file, table.line_number, rounding=False)
    return Record(
        acceleration=values[:, -1] * ACCELERATION_UNITS[_unit(table, unit)],
        dt=_step(table, steps, len(values)),
        name=printable(source.stem),
        source=source,
        file_unit=_unit(table, unit),
        remarks=tuple(remarks),
    )


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    record = parse_columns(text, source, dt=arguments.dt, unit=arguments.unit, skip=arguments.skip)
    return (Channel("1", record),)


COLUMNS: Final = Format("columns", "text of columns", lambda _: True, _parse)


def is_row_of_numbers(line: str) -> bool:
    """Whether a line is one of numbers alone, which ends a header."""
    return _is_row(line) and all(map(is_number, _split(line)))


def _read_table(text: str, file: str) -> _Table:
    lines = text.splitlines()
    header: list[str] = []
    start = len(lines)
    for index, line in enumerate(lines):
        if is_row_of_numbers(line):
            start = index
            break
        if line.strip():
            header.append(line.strip())
    body = lines[start:]
    if any(mark in line for line in body for mark in "#%/!"):
        rows = [line for line in body if _is_row(line)]
        header.extend(line.strip() for line in body if line.lstrip().startswith(_COMMENT))
    else:
        rows = [line for line in body if line and not line.isspace()]
    if not rows:
        got = f"{header[0][:60]!r}" if header else "an empty file"
        raise RecordFormatError(f"content of {file} must be lines of one or two numbers; got {got}")
    table = _Table(file, "\n".join(header)[:HEADER_CHARACTERS], rows, lines, start)
    for index in range(min(len(rows), EARLY)):
        _check_row(table, index)
    return table


def _check_row(table: _Table, index: int) -> None:
    wrong = next((token for token in table.row(index) if not is_number(token)), None)
    if wrong is not None:
        raise RecordFormatError(f"line {table.line_number(index)} of {table.file} must be numbers; got {wrong[:40]!r}")


def _numbers(table: _Table) -> tuple[list[str], NDArray[np.float64]]:
    """Return all numbers as written and as values; the first token that is none is refused with its line."""
    tokens = "\n".join(table.rows).translate(_SEPARATORS).split()
    if set("".join(tokens)) <= _CHARACTERS:
        try:
            return tokens, np.fromiter(map(float, tokens), np.float64, len(tokens))
        except ValueError:
            pass
    for index in range(len(table.rows)):
        _check_row(table, index)
    return tokens, np.fromiter(map(to_float, tokens), np.float64, len(tokens))


def _column_count(table: _Table, numbers: int) -> int:
    columns = len(table.row(-1))
    if columns == 1 and numbers == len(table.rows):
        return 1
    for index in range(len(table.rows)):
        found = len(table.row(index))
        if found not in (1, 2):
            where = table.line_number(index)
            raise RecordFormatError(f"line {where} of {table.file} must be one or two numbers; got {found}")
        if found != columns:
            raise RecordFormatError(
                f"line {table.line_number(index)} of {table.file} must be {columns} number{'s' * (columns > 1)}, "
                f"as the last line is; got {found}"
            )
    return columns


def _without_first_numbers(table: _Table, dt: float | None, remarks: list[str]) -> tuple[_Table, float | None]:
    """Take off a first row or pair of rows "count or scale, step"; return the rest and the step.

    They are taken for what they are where the second is of the size of a step and the first is the count of what
    follows or a scale of 1: no record starts at exactly 1 and goes on so. With another scale that stands out from the
    samples the file is refused, because nothing says whether they are to be multiplied by it.
    """
    rows = [table.row(index) for index in range(min(len(table.rows), EARLY))]
    if len(rows) > 2 and len(rows[0]) == 2:
        taken = 1
        first, second = rows[0]
    elif len(rows) > 3 and len(rows[0]) == len(rows[1]) == len(rows[2]) == 1:
        taken = 2
        first, second = rows[0][0], rows[1][0]
    else:
        return table, None
    scale, step = to_float(first), to_float(second)
    if not (SHORTEST_STEP <= step <= LONGEST_STEP and scale > 0.0):
        return table, None
    is_count = scale == len(table.rows) - taken
    if len(rows[0]) != len(rows[taken]):
        stands_out = True
    elif taken == 1:
        stands_out = scale >= to_float(rows[1][0])  # a time before the first time
    else:
        stands_out = is_count or scale == 1.0 or scale > OUTSTANDING * max(abs(to_float(row[0])) for row in rows[2:])
    if not stands_out:
        return table, None
    if not (is_count or scale == 1.0):
        raise RecordFormatError(
            f"first numbers of {table.file} must be samples, or the number of points or a scale of 1 and the step; "
            f"got {first} and {second} before {len(table.rows) - taken} rows: say skip={taken} to leave them out or "
            "skip=0 to take them as samples"
        )
    kind = "number of points" if is_count else "scale"
    remarks.append(f"first numbers {first} and {second} taken as {kind} and step, not as samples")
    return table.without(taken), step


def _step(table: _Table, steps: dict[str, float | None], samples: int) -> float:
    given = {name: step for name, step in steps.items() if step is not None}
    if not given:
        raise RecordFormatError(f"dt of {table.file} must be given, the file has no times and states no step; got none")
    (name, step), *others = given.items()
    if not 0.0 < step < np.inf:
        raise RecordFormatError(f"{name} of {table.file} must give a positive step; got {step:g} s")
    for other_name, other in others:
        # Agreement: the two put the last sample at the same place to a tenth of a step, or differ by rounding.
        if abs(other - step) * max(samples - 1, 1) > 0.1 * step and abs(other - step) > 1e-6 * step:
            raise RecordFormatError(
                f"{name} of {table.file} must agree with the step of its {other_name}, {other:g} s; got {step:g} s"
            )
    return step


def _unit(table: _Table, unit: str | None) -> str:
    stated = stated_unit(table.text)
    if stated and unit and stated != unit:
        raise RecordFormatError(f"unit of {table.file} must be that of its header, {stated}; got {unit}")
    if not (unit or stated):
        unknown = unknown_unit(table.text)
        raise RecordFormatError(
            f"unit of {table.file} must be given ({', '.join(ACCELERATION_UNITS)}), the file states "
            + (f"another; got {unknown!r}" if unknown else "none; got none")
        )
    return unit or stated or ""
