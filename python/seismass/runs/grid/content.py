"""A grid as data: a table of its axes and a document for JSON, from which an equal grid is made again.

The table has one row per value of an axis, so that a product of any size has a short one.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.values import FloatArray, read_only
from seismass.model.building import Building, Rayleigh
from seismass.model.springs import SPRING_FIELDS, is_default
from seismass.runs.grid.columns import Column, GridAxis
from seismass.runs.grid.grid import Grid
from seismass.runs.grid.sample import StrengthDesign

_TABLES: Final = ("mass_ratio", "occupancy", "mu_s", "mu_k", "yield_shear_over_weight")
"""Columns whose values are rows of numbers per block or storey."""


def axes_table(axes: list[GridAxis]) -> pl.DataFrame:
    """Return the values of all axes: columns `axis`, `number` (from 1 within the axis), and one per column of the grid,
    null for other axes. Values of blocks or storeys are lists.
    """
    frames = []
    for axis in axes:
        columns = {name: _series(values) for name, values in axis.columns.items()}
        number = pl.Series(np.arange(1, axis.length + 1, dtype=np.uint64))
        frames.append(pl.DataFrame({"axis": [axis.name] * axis.length, "number": number, **columns}))
    return pl.concat(frames, how="diagonal")


def _series(values: np.ndarray[Any, Any]) -> pl.Series:
    if values.dtype.kind in "iu":
        return pl.Series(values.astype(np.uint32))
    if values.ndim == 1:
        return pl.Series(values)
    return pl.Series(values, dtype=pl.Array(pl.Float64, values.shape[1])).arr.to_list()


def grid_document(grid: Grid) -> dict[str, Any]:
    """Return what the table of axes does not hold, for JSON: buildings, axes, and how columns are read."""
    return {
        "scenes": len(grid),
        "buildings": [building_document(building) for building in grid.buildings],
        "axes": [
            {"name": axis.name, "each": axis.each, "length": axis.length, "columns": list(axis.columns)}
            for axis in grid.axes()
        ],
        "held": list(grid._columns),
        "floors": list(grid.floors),
        "everywhere": grid._everywhere,
        "roof_is_bare": grid._roof_is_bare,
        "collapse_drift": grid.collapse_drift,
        "damping": grid._formed.damping,
        "attached_of": grid._formed.attached_of,
        "design": None if grid._formed.design is None else grid._formed.design.content(),
        "periods": grid._formed.periods.tolist(),
    }


def grid_of(document: dict[str, Any], axes: pl.DataFrame) -> Grid:
    """Return the grid that the document and the table of axes describe."""
    columns: dict[str, Column[Any]] = {}
    for axis in document["axes"]:
        rows = axes.filter(pl.col("axis") == axis["name"])
        for name in axis["columns"]:
            columns[name] = Column(_values(rows[name]), axis["each"])
    grid = Grid.__new__(Grid)
    grid.buildings = tuple(building_of(item) for item in document["buildings"])
    grid.floors = tuple(document["floors"])
    grid.collapse_drift = document["collapse_drift"]
    grid._everywhere, grid._roof_is_bare = document["everywhere"], document["roof_is_bare"]
    grid._length = document["scenes"]
    numbers = {name: columns[name] for name in ("building", "motion") if name in columns}
    grid._indices = {name: Column(column.values - 1, column.each) for name, column in numbers.items()}
    grid._columns = {name: _as_held(name, columns[name]) for name in document["held"]}
    design = None if document["design"] is None else StrengthDesign.of_content(document["design"])
    grid._set_formed(np.array(document["periods"]), document["damping"], document["attached_of"], design)
    return grid


def _as_held(name: str, column: Column[Any]) -> Column[Any]:
    """A column as a grid holds it: a table where blocks or storeys may differ."""
    if name in _TABLES and column.values.ndim == 1:
        return Column(column.values.reshape(-1, 1), column.each)
    return column


def _values(series: pl.Series) -> np.ndarray[Any, Any]:
    if isinstance(series.dtype, pl.List):
        values: np.ndarray[Any, Any] = np.ascontiguousarray(series.list.to_array(series.list.len()[0]).to_numpy())
    else:
        values = series.to_numpy().astype(np.int64 if series.dtype.is_integer() else np.float64)
    return read_only(values)


def building_document(building: Building) -> dict[str, Any]:
    """Return the arguments of a building for JSON; springs with the defaults are left out, infinity is "inf"."""
    arguments = building._arguments()
    backbone = arguments["backbone"]
    document: dict[str, Any] = {}
    for name, value in arguments.items():
        if value is None or is_default(value, name):
            continue
        if isinstance(value, Rayleigh):
            document[name] = {"ratio": value.ratio, "modes": list(value.modes)}
        elif name == "backbone":
            document[name] = [None if points is None else _listed(np.array(points)) for points in backbone]
        elif isinstance(value, np.ndarray):
            document[name] = _listed(value)
        else:
            document[name] = list(value) if isinstance(value, tuple) else value
    return document


def building_of(document: dict[str, Any]) -> Building:
    """Return the building of a document."""
    arguments: dict[str, Any] = dict(document)
    for name in ("mass", "stiffness", "heights", "gravity_load", "geometric_stiffness", *SPRING_FIELDS):
        if name in arguments:
            arguments[name] = _array(arguments[name])
    damping = arguments.get("damping")
    if isinstance(damping, dict):
        arguments["damping"] = Rayleigh(damping["ratio"], tuple(damping["modes"]))
    elif isinstance(damping, list):
        arguments["damping"] = _array(damping)
    return Building(**arguments)


def _listed(values: FloatArray) -> Any:
    """Numbers as nested lists whose infinities JSON can hold."""
    if np.isfinite(values).all():
        return values.tolist()
    return [_listed(row) if np.ndim(row) else (float(row) if np.isfinite(row) else str(float(row))) for row in values]


def _array(values: Any) -> FloatArray:
    return np.array(values, dtype=np.float64)
