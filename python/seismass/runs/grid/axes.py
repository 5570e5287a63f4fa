"""The axes of a grid: what varies together over its scenes, each with its values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.values import FloatArray, content_hash, same_content
from seismass.model.building import Building
from seismass.model.springs import SHAPE_FIELDS
from seismass.runs.grid.columns import AXES, Column, IndexArray

AXIS_OF: Final = {
    **{name: axis for axis, names in AXES.items() for name in names},
    **dict.fromkeys(("building", "storeys", "period"), "building"),
}
"""Axis of each column of a product."""
TABLE_COLUMNS: Final = (
    "building",
    "storeys",
    "period",
    "strength",
    "R",
    "yield_shear_over_weight",
    *SHAPE_FIELDS,
    "mass_ratio",
    "occupancy",
    "attached",
    "sliding",
    "mu_s",
    "mu_k",
    "scale",
    "motion",
)
"""Columns that the table of a grid may have beside `scene`, in their order."""
_NUMBERS: Final = ("building", "storeys", "motion")


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

    __eq__ = same_content
    __hash__ = content_hash


def described(
    buildings: tuple[Building, ...],
    periods: FloatArray,
    columns: dict[str, Column[np.float64]],
    indices: dict[str, Column[np.int64]],
) -> dict[str, Column[Any]]:
    """Return columns by the names of `Grid.table`: numbers from 1, and storeys and periods of buildings."""
    index = indices["building"]
    storeys = np.array([building.storeys for building in buildings])[index.values]
    found: dict[str, Column[Any]] = {
        "building": Column(index.values + 1, index.each),
        "storeys": Column(storeys, index.each),
        "period": Column(periods[index.values], index.each),
    }
    for name, column in columns.items():
        narrow = column.values.ndim == 2 and column.values.shape[1] == 1
        found[name] = Column(column.values.reshape(-1) if narrow else column.values, column.each)
    if "motion" in indices:
        found["motion"] = Column(indices["motion"].values + 1)
    return found


def axes_of(columns: dict[str, Column[Any]], scenes: int) -> list[GridAxis]:
    """Return the axes of columns by their names in `Grid.table`; what all scenes share is the axis "constant"."""
    found: dict[tuple[int, int], GridAxis] = {}
    for name, column in columns.items():
        length = len(column.values)
        key = (1, 1) if length == 1 else (column.each, length)
        if key not in found:
            own = "constant" if length == 1 else "scene" if key == (1, scenes) else AXIS_OF[name]
            found[key] = GridAxis(own, *key, {})
        found[key].columns[name] = column.values
    return sorted(found.values(), key=lambda axis: (axis.length > 1, -axis.each))


def table_of(columns: dict[str, Column[Any]], scenes: IndexArray) -> pl.DataFrame:
    """Return columns by their names in `Grid.table` as a frame, a row for each of these scenes, numbered from 0."""
    found: dict[str, pl.Series] = {"scene": pl.Series((scenes + 1).astype(np.uint64))}
    for name in TABLE_COLUMNS:
        if name not in columns:
            continue
        values = columns[name].of(scenes)
        if values.ndim == 1:
            found[name] = pl.Series(values.astype(np.uint32) if name in _NUMBERS else values)
        else:
            lists = pl.Series(values, dtype=pl.Array(pl.Float64, values.shape[1])).arr.to_list()
            unused = np.isnan(values).any()
            found[name] = lists.list.eval(pl.element().filter(pl.element().is_not_nan())) if unused else lists
    return pl.DataFrame(found)
