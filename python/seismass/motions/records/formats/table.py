"""The rows of numbers of a text and the words around them: where they begin, decimal commas, numbers and lines; and
blocks of columns of fixed width.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.motions.records.formats.common import is_number, last_digits, split_touching, to_float

EARLY: Final = 22
"""Rows that are looked at to tell first numbers from samples."""

HEADER_CHARACTERS: Final = 10_000
"""A header says what it has to say in so much text."""

DECIMAL_COMMAS: Final = "decimal commas are read as points"

_COMMENT = ("#", "%", "//", "!")
_SEPARATORS: Final = str.maketrans(",;", "  ")
_DECIMAL: Final = frozenset("+-.0123456789Ee")
_COMMA_NUMBER = re.compile(r"[+-]?(?:\d+(?:,\d*)?|,\d+)(?:[EeDd][+-]?\d+)?")
_BARE_EXPONENT = re.compile(r"([+-]?\d*\.\d+)([+-]\d{2,3})(?=[\s,;]|$)")
_END: Final = re.compile(r"[^\w\d]*(?:end|eof|fin)\b.*", re.IGNORECASE)


@dataclass(frozen=True)
class Table:
    """The rows of numbers of a file as lines, the text around them, and where they begin in the file."""

    file: str
    header: list[str]
    rows: list[str]
    lines: list[str]
    start: int
    left_out: int = 0

    @property
    def text(self) -> str:
        """The words of the header."""
        return "\n".join(self.header)[:HEADER_CHARACTERS]

    def row(self, index: int) -> list[str]:
        """Return the numbers of a row as written."""
        return split(self.rows[index])

    def line_number(self, index: int) -> int:
        """Return the line of a row, as editors count them."""
        numbered = (number for number, line in enumerate(self.lines, start=1) if number > self.start and _is_row(line))
        return next(islice(numbered, index + self.left_out, None))

    def without(self, count: int) -> Table:
        """Return the table without its first rows."""
        return Table(self.file, self.header, self.rows[count:], self.lines, self.start, self.left_out + count)


def split(line: str) -> list[str]:
    """Return what stands between blanks, commas and semicolons."""
    return line.translate(_SEPARATORS).split()


def _is_row(line: str) -> bool:
    return not line.lstrip().startswith(_COMMENT) and bool(line.translate(_SEPARATORS).strip())


def is_row_of_numbers(line: str) -> bool:
    """Whether a line is one of numbers alone, which ends a header; fields may touch."""
    return _is_row(line) and all(is_number(token) or split_touching(token) for token in split(line))


def read_table(text: str, file: str, remarks: list[str]) -> Table:
    """Return the table of a text: header lines (no numbers, or marked #, %, // or !), then rows of numbers. `remarks`
    gets what was interpreted: decimal commas, a line that marks the end.
    """
    lines = text.splitlines()
    if lines and '"' in lines[-1]:  # sheets may quote numbers
        lines = [bare if is_row_of_numbers(bare := line.replace('"', "")) else line for line in lines]
    if _has_bare_exponents(lines):
        remarks.append("exponents are written without their letter")
        lines = [_BARE_EXPONENT.sub(r"\1E\2", line) for line in lines]
    header: list[str] = []
    start = len(lines)
    for index, line in enumerate(lines):
        if is_row_of_numbers(line):
            start = index
            break
        if line.strip():
            header.append(line.strip())
    body = _first_block(lines[start:], start, file, remarks)
    if any(mark in line for line in body for mark in "#%/!"):
        rows = [line for line in body if _is_row(line)]
        header.extend(line.strip() for line in body if line.lstrip().startswith(_COMMENT))
    else:
        rows = [line for line in body if line and not line.isspace()]
    if not rows:
        got = f"{header[0][:60]!r}" if header else "an empty file"
        raise RecordFormatError(f"content of {file} must be lines of numbers behind a header; got {got}")
    if len(rows) > 1 and _END.fullmatch(rows[-1]):
        remarks.append(f"the last line, {rows[-1].strip()[:30]!r}, left out")
        rows = rows[:-1]
    if has_decimal_commas(rows):
        remarks.append(DECIMAL_COMMAS)
        rows = [line.replace(",", ".") for line in rows]
    table = Table(file, header, rows, lines, start)
    for index in range(min(len(rows), EARLY)):
        _check_row(table, index)
    return table


_OTHER_BLOCK: Final = re.compile(r"velocit|displac|velocid|desplaz|geschwind|verschieb|vitesse|spostam", re.IGNORECASE)
_SAME_BLOCK: Final = re.compile(r"acc\w*|acel\w*|beschl\w*|ivme", re.IGNORECASE)


def _first_block(body: list[str], start: int, file: str, remarks: list[str]) -> list[str]:
    """Return the lines up to a title of velocities or displacements; a second block of accelerations is refused."""
    for index, line in enumerate(body):
        if index > EARLY and _OTHER_BLOCK.search(line):
            remarks.append(f"what follows {line.strip()[:40]!r} is not read")
            return body[:index]
        if index > EARLY and _SAME_BLOCK.search(line) and not line.lstrip().startswith(_COMMENT):
            raise RecordFormatError(
                f"line {start + index + 1} of {file} must be numbers; got a second block, {line.strip()[:40]!r}: "
                "put each into a file of its own"
            )
    return body


def pairs_in_lines(values: NDArray[np.float64], counts: list[int]) -> bool:
    """Whether rows are several pairs of a time and a sample each, as ETABS and SAP2000 write functions."""
    if len(values) % 2 or counts[0] < 4 or any(count % 2 for count in counts):
        return False
    steps = np.diff(values[::2])
    mean = float(np.mean(steps))
    return mean > 0.0 and bool(np.all(np.abs(steps - mean) < 0.5 * mean))


def has_decimal_commas(rows: Sequence[str]) -> bool:
    """Whether commas in rows are decimal points: no point anywhere, and no number without them. "0,00413" alone may be
    time and sample; it is one number where a decimal part begins with 0 or times would not increase.
    """
    if "," not in rows[0] or any("." in line for line in rows):
        return False
    alone = True
    for line in rows:
        tokens = line.replace(";", " ").split()
        if not all(_COMMA_NUMBER.fullmatch(token) for token in tokens):
            return False
        alone = alone and len(tokens) == 1
    if not alone:
        # "0, 5" is two numbers, "0,1 0,5" are two as well, but with decimals.
        return not any(token.endswith(",") for token in rows[-1].split())
    parts = [line.strip().partition(",") for line in rows]
    if any(decimals.startswith("0") and len(decimals) > 1 for _, _, decimals in parts):
        return True
    return any(float(after or 0) <= float(before or 0) for (before, _, _), (after, _, _) in pairwise(parts))


def _has_bare_exponents(lines: Sequence[str]) -> bool:
    """Whether the last lines of a text are of numbers as 4.2-04, every one of them with an exponent."""
    tokens = [token for line in lines[-EARLY:] for token in split(line)]
    return bool(tokens) and all(_BARE_EXPONENT.fullmatch(token) for token in tokens)


def _check_row(table: Table, index: int) -> None:
    wrong = next((token for token in table.row(index) if not (is_number(token) or split_touching(token))), None)
    if wrong is not None:
        raise RecordFormatError(f"line {table.line_number(index)} of {table.file} must be numbers; got {wrong[:40]!r}")


def numbers_of(table: Table) -> tuple[list[str], NDArray[np.float64], list[int]]:
    """Return all numbers as written and as values, and how many each row has."""
    rows = [split(line) for line in table.rows]
    tokens = [token for row in rows for token in row]
    values: NDArray[np.float64] | None = None
    if set("".join(tokens)) <= _DECIMAL:
        try:
            values = np.fromiter(map(float, tokens), np.float64, len(tokens))
        except ValueError:
            values = None
    if values is None:
        for index, row in enumerate(rows):
            _check_row(table, index)
            if not all(map(is_number, row)):
                rows[index] = [field for token in row for field in (split_touching(token) or [token])]
        tokens = [token for row in rows for token in row]
        values = np.fromiter(map(to_float, tokens), np.float64, len(tokens))
    counts = [len(row) for row in rows]
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        number = int(np.searchsorted(np.cumsum(counts), wrong[0], side="right"))
        raise RecordFormatError(f"line {table.line_number(number)} of {table.file} must be finite; got infinity")
    return tokens, values, counts


SHORTEST_STEP: Final = 1e-4
LONGEST_STEP: Final = 0.1
"""Between these (s) a number before the data may be a step."""

OUTSTANDING: Final = 5.0
"""A first number larger than the early samples by this factor is not a sample unless the caller says so."""

_FIRST_SAMPLES: Final = 3
"""Records begin at rest: so many samples say what size the first has."""


def without_first_numbers(table: Table, dt: float | None, remarks: list[str]) -> tuple[Table, float | None]:
    """Remove first rows "count or scale, step" or "step"; return the step (s). The count must be that of what follows,
    or the scale 1; another scale that differs from the samples is refused, as it may be a factor.
    """
    rows = [table.row(index) for index in range(min(len(table.rows), EARLY))]
    if len(rows) > _FIRST_SAMPLES and len(rows[0]) == 1 and dt is not None and to_float(rows[0][0]) == dt:
        return _without_step(table, rows, remarks)
    if len(rows) > 2 and (len(rows[0]) == 2 or (len(rows[0]) == 3 != len(rows[1]))):
        taken = 1
        first, second = rows[0][:2]
    elif len(rows) > 3 and len(rows[0]) == len(rows[1]) == len(rows[2]) == 1:
        taken = 2
        first, second = rows[0][0], rows[1][0]
    else:
        return table, None
    scale, step = to_float(first), to_float(second)
    if not (SHORTEST_STEP <= step <= LONGEST_STEP and scale > 0.0):
        return table, None
    is_count = scale == len(table.rows) - taken or (
        len(rows[0]) != len(rows[taken]) and scale == sum(len(table.row(k)) for k in range(taken, len(table.rows)))
    )
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


def _without_step(table: Table, rows: list[list[str]], remarks: list[str]) -> tuple[Table, float | None]:
    """Take off a first number that equals the step, where it stands out from the first samples."""
    written = rows[0][0]
    step = to_float(written)
    if step > OUTSTANDING * max(abs(to_float(number)) for row in rows[1 : 1 + _FIRST_SAMPLES] for number in row):
        remarks.append(f"first number {written} taken as the step, not as a sample")
        return table.without(1), step
    remarks.append(f"the first number, {written}, is the step as well: skip=1 leaves it out if it is no sample")
    return table, None


SMOOTHER: Final = 0.8
"""A motion is smoother along its samples than across them: steps along it are smaller by at least this factor."""

FEWEST_IN_LINE: Final = 5
"""So many numbers a line are samples in Fortran's usual 5E15.7 or 8F10.4, where nothing says otherwise."""


def columns_of(table: Table, values: NDArray[np.float64], counts: list[int], labelled: bool) -> int:
    """Return how many columns the rows have; 1 also where samples go on from line to line. `labelled`: a header labels
    as many columns as the last row has.
    """
    columns = counts[-1]
    wide = max(counts[:-1], default=columns)
    different = [index for index, count in enumerate(counts) if count != columns]
    if not different:
        if columns <= 2 or labelled:
            return columns
        if _rises(values.reshape(-1, columns)):
            return columns
        if is_row_major(values.reshape(-1, columns)):
            return 1
        raise RecordFormatError(
            f"columns of {table.file} must have labels, times first, or be samples line after line; "
            f"got {columns} numbers a line, and nothing says which"
        )
    # A last line of a motion that is written line after line may be short.
    if wide >= 3 and columns < wide and all(count == wide for count in counts[:-1]):
        full = values[: wide * (len(counts) - 1)].reshape(-1, wide)
        if not _rises(full) and is_row_major(full):
            return 1
    for index, numbers in enumerate(counts):
        if numbers != columns:
            raise RecordFormatError(
                f"line {table.line_number(index)} of {table.file} must be {columns} number{'s' * (columns > 1)}, "
                f"as the last line is; got {numbers}"
            )
    return columns


def _rises(values: NDArray[np.float64]) -> bool:
    """Whether the first column increases throughout, as times do."""
    return len(values) > 2 and bool(np.all(np.diff(values[:, 0]) > 0.0))


def is_row_major(values: NDArray[np.float64]) -> bool:
    """Whether numbers go on from line to line: steps along lines are smaller than those from a line to the next. If
    that is not clear, five or more a line are samples, and fewer are not.
    """
    along = _rms(np.diff(values.ravel()))
    across = _rms(np.diff(values, axis=0))
    if along < SMOOTHER * across:
        return True
    return values.shape[1] >= FEWEST_IN_LINE and not across < SMOOTHER * along


def _rms(steps: NDArray[np.float64]) -> float:
    largest = float(np.max(np.abs(steps), initial=0.0))
    return largest * float(np.sqrt(np.mean(np.square(steps / largest)))) if 0.0 < largest < np.inf else 0.0


_EDIT = re.compile(
    r"\(?\s*(?:\d+P\s*,?\s*)?(?P<columns>\d*)\s*\(?\s*(?:\d+P\s*,?\s*)?(?P<kind>[IFEDG])\s*(?P<width>\d+)"
    r"(?:\.(?P<decimals>\d+))?(?:E\d+)?\s*\)*",
    re.IGNORECASE,
)
_FORTRAN: Final = frozenset(" +-.0123456789EeDd")

LARGEST_COUNT: Final = 100_000_000
"""No record has more samples: a larger count is a damaged one."""


@dataclass(frozen=True)
class Layout:
    """Numbers per line, characters per number, whether they are integers; digits from which one may lack its point."""

    columns: int
    width: int
    integers: bool = False
    whole_from: int = 99


@dataclass(frozen=True)
class Block:
    """Numbers of a block, how they are written, and the index of the line after it."""

    values: NDArray[np.float64]
    fields: list[str]
    end: int


def layout_of(edit: str, file: str) -> Layout:
    """Return the layout of a Fortran format (I, F, E, D or G) such as (8F10.3), (1E15.6) or 8(1pe10.4e1)."""
    match = _EDIT.fullmatch(edit.strip())
    columns = int(match["columns"] or 1) if match else 0
    width = int(match["width"]) if match else 0
    if match is None or not (1 <= columns <= 100 and 2 <= width <= 40):
        raise RecordFormatError(f"format of the numbers of {file} must be one as (8F10.3); got {edit[:30]!r}")
    return Layout(columns, width, match["kind"].upper() == "I")


def read_block(lines: Sequence[str], start: int, count: int, layout: Layout, file: str) -> Block:
    """Read `count` numbers from line index `start` on; each line must have its numbers in their columns."""
    if not 0 < count <= LARGEST_COUNT:
        raise RecordFormatError(f"points of {file} must be between 1 and {LARGEST_COUNT}; got {count}")
    columns, width = layout.columns, layout.width
    rows = math.ceil(count / columns)
    fields: list[str] = []
    full = columns * width
    edges = range(0, full, width)
    for index in range(start, start + rows):
        if index >= len(lines):
            raise RecordFormatError(
                f"points of {file} must be {count}, as its header says; got {len(fields)}: the file is cut off"
            )
        line = lines[index].rstrip()
        expected = full if index < start + rows - 1 else (count - columns * (rows - 1)) * width
        if len(line) != expected:
            raise RecordFormatError(
                f"line {index + 1} of {file} must be {expected // width} numbers of {width} characters; "
                f"got {len(line)} characters, {line[:40]!r}"
            )
        fields.extend(
            [line[edge : edge + width] for edge in (edges if expected == full else range(0, expected, width))]
        )
    return Block(_values(fields, start, layout, file), fields, start + rows)


def _values(fields: list[str], start: int, layout: Layout, file: str) -> NDArray[np.float64]:
    joined = "".join(fields)
    if set(joined) <= _FORTRAN:
        if "D" in joined or "d" in joined:
            fields = [field.replace("D", "E").replace("d", "e") for field in fields]
        try:
            values = np.array(list(map(float, fields)), dtype=np.float64)
        except ValueError:
            pass
        else:
            # A field without its point would be read by Fortran as if the point stood elsewhere.
            points = joined.count(".")
            sound = points == (0 if layout.integers else len(fields)) or all(_is_field(one, layout) for one in fields)
            if sound and np.isfinite(values).all():
                return values
    for number, field in enumerate(fields):
        if not _is_field(field, layout):
            line = start + number // layout.columns + 1
            kind = "whole numbers" if layout.integers else "numbers with a point"
            raise RecordFormatError(f"line {line} of {file} must be {kind}; got {field.strip()[:40]!r}")
    raise RecordFormatError(f"numbers of {file} must be finite; got infinity")  # an exponent above 308


def _is_field(field: str, layout: Layout) -> bool:
    pointless = "." not in field
    wide = layout.integers or sum(map(str.isdigit, field)) >= layout.whole_from
    if not set(field) <= _FORTRAN or (pointless and not wide) or (not pointless and layout.integers):
        return False
    try:
        float(field.replace("D", "E").replace("d", "e"))
    except ValueError:
        return False
    return True


def header_values(lines: Sequence[str], start: int, rows: int, layout: Layout) -> list[float | None]:
    """Return the numbers of a header block; a field that is blank or no number is None."""
    numbers: list[float | None] = []
    for line in lines[start : start + rows]:
        for edge in range(0, layout.columns * layout.width, layout.width):
            field = line[edge : edge + layout.width]
            try:
                number = float(field) if set(field) <= _FORTRAN else None
            except ValueError:
                number = None
            numbers.append(number if number is not None and math.isfinite(number) else None)
    return numbers


UNIFORMITY: Final = 0.05
"""Largest departure of a time from uniform sampling, in steps, beside the rounding of the times."""


def uniform_step(
    times: NDArray[np.float64],
    written: Sequence[str],
    file: str,
    line_number: Callable[[int], int] | None = None,
    *,
    rounding: bool = True,
) -> float:
    """Return the step (s) of times that are uniform; `written` are the times as in the file. With `rounding` half the
    last digit of a time is allowed beside `UNIFORMITY`, as for steps of 5 ms printed in ms.
    """
    if len(times) < 2:
        raise RecordFormatError(f"times of {file} must be at least two, to give a step; got {len(times)}")
    span = float(times[-1] - times[0])
    step = span / (len(times) - 1)
    if not step > 0.0:
        raise RecordFormatError(f"times of {file} must increase; got {times[0]:g} s first, {times[-1]:g} s last")
    half_digit = 0.5 * last_digits([token.strip() for token in written])
    half_digit[0] = half_digit.min()  # a first time of "0" is as exact as the others
    off = np.abs(times - (times[0] + step * np.arange(len(times))))
    excess = off - UNIFORMITY * step - (2.0 * half_digit if rounding else 0.0)
    worst = int(np.argmax(excess))
    if excess[worst] > 1e-9 * span:
        where = f"line {line_number(worst)}" if line_number is not None else f"sample {worst + 1}"
        raise RecordFormatError(
            f"times of {file} must be uniform, here {step:.6g} s apart; "
            f"got {times[worst]:g} s in {where}, {off[worst]:.3g} s off"
        )
    # The shortest step that gives every time back to its last printed digit: 0.01, not 0.010000000000000002.
    margin = half_digit + 1e-12 * span
    for digits in range(1, 17):
        short = float(f"{step:.{digits}g}")
        start = times - short * np.arange(len(times))
        if np.max(start - margin) <= np.min(start + margin):
            return short
    return step
