"""How rows of numbers are to be read: as columns, or line after line as one motion."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.records.formats.table import Table

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
    for index, found in enumerate(counts):
        if found != columns:
            raise RecordFormatError(
                f"line {table.line_number(index)} of {table.file} must be {columns} number{'s' * (columns > 1)}, "
                f"as the last line is; got {found}"
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
