"""Blocks of numbers in columns of fixed width, as Fortran formats state them: fields may touch, none may be short."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.motions.records.formats.common import last_digits

_EDIT = re.compile(
    r"\(?\s*(?:\d+P\s*,?\s*)?(?P<columns>\d*)\s*\(?\s*(?:\d+P\s*,?\s*)?(?P<kind>[IFEDG])\s*(?P<width>\d+)"
    r"(?:\.(?P<decimals>\d+))?(?:E\d+)?\s*\)*",
    re.IGNORECASE,
)
_CHARACTERS: Final = frozenset(" +-.0123456789EeDd")

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
    if set(joined) <= _CHARACTERS:
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
    if not set(field) <= _CHARACTERS or (pointless and not wide) or (not pointless and layout.integers):
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
                number = float(field) if set(field) <= _CHARACTERS else None
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
