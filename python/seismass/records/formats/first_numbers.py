"""Numbers before the data that are not data: a count or a scale and the step, or the step alone."""

from __future__ import annotations

from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.records.formats.numbers import to_float
from seismass.records.formats.table import EARLY, Table

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
    is_count = scale == len(table.rows) - taken or (
        len(rows[0]) != len(rows[taken]) and scale == sum(len(table.row(at)) for at in range(taken, len(table.rows)))
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
