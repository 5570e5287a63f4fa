"""The axes of a grid: what varies together over its scenes, each with its values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from seismass.grid_columns import AXES, Column

AXIS_OF: Final = {
    **{name: axis for axis, names in AXES.items() for name in names},
    **dict.fromkeys(("building", "storeys", "period"), "building"),
}
"""Axis of each column of a product."""


@dataclass(frozen=True, eq=False)
class GridAxis:
    """What varies together over the scenes of a grid.

    Attributes
    ----------
    name : str
        "constant" for what all scenes share, "scene" where each scene has a value of its own, else the axis of
        `Grid.product`.
    each, length : int
        Scene s, from 1, has row (s - 1) // each % length, from 0.
    columns : dict of str to ndarray
        Values by the names of `Grid.table`, one row each; shape (length, blocks) or (length, storeys) where blocks or
        storeys differ, filled up with NaN.
    """

    name: str
    each: int
    length: int
    columns: dict[str, np.ndarray[Any, Any]]


def axes_of(described: dict[str, Column[Any]], scenes: int) -> list[GridAxis]:
    """Return the axes of columns by their names in `Grid.table`; what all scenes share is the axis "constant"."""
    found: dict[tuple[int, int], GridAxis] = {}
    for name, column in described.items():
        length = len(column.values)
        key = (1, 1) if length == 1 else (column.each, length)
        if key not in found:
            own = "constant" if length == 1 else "scene" if key == (1, scenes) else AXIS_OF[name]
            found[key] = GridAxis(own, *key, {})
        found[key].columns[name] = column.values
    return sorted(found.values(), key=lambda axis: (axis.length > 1, -axis.each))
