"""Plain text records: one column of accelerations, or time and acceleration.

Nothing is guessed that could be wrong by a factor: the unit comes from the file or from the caller, and numbers before
the data that are not data (a scale and the step, a count and the step) are recognised or refused, never samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Final

import numpy as np

from seismass._values import as_count, printable
from seismass.errors import RecordFormatError
from seismass.records.formats.common import Arguments, Channel, Format, NotRead
from seismass.records.formats.headers import other_quantity, stated_points, stated_step
from seismass.records.formats.numbers import is_cut_off, is_number, to_float
from seismass.records.formats.pairs import uniform_step
from seismass.records.record import Record
from seismass.units import ACCELERATION_UNITS, stated_unit, unknown_unit

SHORTEST_STEP: Final = 1e-4
LONGEST_STEP: Final = 0.1
"""Between these (s) a number before the data may be a step."""

OUTSTANDING: Final = 5.0
"""A first number larger than the early samples by this factor is no sample unless the caller says so."""

FIRST_TIME: Final = 1.5
"""A first time is 0 or one step, or there was something before it."""

NO_COUNT: Final = "the file states no number of points: a missing end would not show"

_COMMENT = ("#", "%", "//", "!")
_SEPARATORS: Final = str.maketrans(",;", "  ")
_CHARACTERS: Final = frozenset("+-.0123456789Ee")


@dataclass(frozen=True)
class _Table:
    """The rows of numbers of a file, the text around them, and what was decided about the first rows."""

    file: str
    text: str
    rows: list[list[str]]
    line_numbers: list[int]


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
    if skip is None:
        table, step_before = _without_first_numbers(table, dt, remarks)
    else:
        left_out = as_count(skip, "skip", table.file, RecordFormatError)
        if left_out >= len(table.rows):
            raise RecordFormatError(f"skip of {table.file} must be between 0 and {len(table.rows) - 1}; got {left_out}")
        table = _Table(table.file, table.text, table.rows[left_out:], table.line_numbers[left_out:])
        step_before = None
    columns = _column_count(table)
    values = np.array([to_float(token) for row in table.rows for token in row], dtype=np.float64).reshape(-1, columns)
    wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if len(wrong):
        raise RecordFormatError(f"line {table.line_numbers[wrong[0]]} of {table.file} must be finite; got infinity")
    last = [row[-1] for row in table.rows]
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
        steps["times"] = uniform_step(
            values[:, 0], [row[0] for row in table.rows], table.file, table.line_numbers, rounding=False
        )
    return Record(
        acceleration=values[:, -1] * ACCELERATION_UNITS[_unit(table, unit)],
        dt=_step(table, steps, len(values)),
        name=printable(source.stem),
        source=source,
        unit=_unit(table, unit),
        remarks=tuple(remarks),
    )


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    record = parse_columns(text, source, dt=arguments.dt, unit=arguments.unit, skip=arguments.skip)
    return (Channel("1", record),)


COLUMNS: Final = Format("columns", "text of columns", lambda _: True, _parse)


def _read_table(text: str, file: str) -> _Table:
    lines = text.splitlines()
    header: list[str] = []
    start = len(lines)
    for index, line in enumerate(lines):
        tokens = line.translate(_SEPARATORS).split()
        if tokens and not line.lstrip().startswith(_COMMENT) and all(map(is_number, tokens)):
            start = index
            break
        if tokens:
            header.append(line.strip())
    rows: list[list[str]] = []
    line_numbers: list[int] = []
    for number, line in enumerate(lines[start:], start=start + 1):
        tokens = line.translate(_SEPARATORS).split()
        if line.lstrip().startswith(_COMMENT):
            header.append(line.strip())
        elif tokens:
            rows.append(tokens)
            line_numbers.append(number)
    _check_numbers(rows, line_numbers, file)
    if not rows:
        got = f"{header[0][:60]!r}" if header else "an empty file"
        raise RecordFormatError(f"content of {file} must be lines of one or two numbers; got {got}")
    return _Table(file, "\n".join(header), rows, line_numbers)


def _check_numbers(rows: list[list[str]], line_numbers: list[int], file: str) -> None:
    """Refuse the first token that is no number, with its line."""
    tokens = list(chain.from_iterable(rows))
    try:
        if set("".join(tokens)) <= _CHARACTERS:
            list(map(float, tokens))
            return
    except ValueError:
        pass
    for number, row in zip(line_numbers, rows, strict=True):
        wrong = next((token for token in row if not is_number(token)), None)
        if wrong is not None:
            raise RecordFormatError(f"line {number} of {file} must be numbers; got {wrong[:40]!r}")


def _column_count(table: _Table) -> int:
    columns = len(table.rows[-1]) if len(table.rows) > 1 else len(table.rows[0])
    for number, row in zip(table.line_numbers, table.rows, strict=True):
        if len(row) not in (1, 2):
            raise RecordFormatError(f"line {number} of {table.file} must be one or two numbers; got {len(row)}")
        if len(row) != columns:
            raise RecordFormatError(
                f"line {number} of {table.file} must be {columns} number{'s' * (columns > 1)}, as the last line is; "
                f"got {len(row)}"
            )
    return columns


def _without_first_numbers(table: _Table, dt: float | None, remarks: list[str]) -> tuple[_Table, float | None]:
    """Take off a first row or pair of rows "count or scale, step"; return the rest and the step.

    They are taken for what they are where the second is of the size of a step and the first is the count of what
    follows or a scale of 1: no record starts at exactly 1 and goes on so. With another scale that stands out from the
    samples the file is refused, because nothing says whether they are to be multiplied by it.
    """
    rows = table.rows
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
    is_count = scale == len(rows) - taken
    if len(rows[0]) != len(rows[taken]):
        stands_out = True
    elif taken == 1:
        stands_out = scale >= to_float(rows[1][0])  # a time before the first time
    else:
        stands_out = is_count or scale == 1.0 or scale > OUTSTANDING * max(abs(to_float(row[0])) for row in rows[2:22])
    if not stands_out:
        return table, None
    if not (is_count or scale == 1.0):
        raise RecordFormatError(
            f"first numbers of {table.file} must be samples, or the number of points or a scale of 1 and the step; "
            f"got {first} and {second} before {len(rows) - taken} rows: say skip={taken} to leave them out or skip=0 "
            "to take them as samples"
        )
    kind = "number of points" if is_count else "scale"
    remarks.append(f"first numbers {first} and {second} taken as {kind} and step, not as samples")
    return _Table(table.file, table.text, rows[taken:], table.line_numbers[taken:]), step


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
