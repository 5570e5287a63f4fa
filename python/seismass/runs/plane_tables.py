"""Columns of runs in two directions: what a table has of each direction beside what it has of the vectors."""

from __future__ import annotations

from typing import Any, Final

import polars as pl

from seismass.runs.batch_tables import OF_RACKS

_OF_DIRECTIONS: Final = (
    "peak_drift",
    "peak_drift_ratio",
    "residual_drift",
    "peak_floor_acceleration",
    "peak_storey_shear",
    "peak_base_shear",
    "peak_slip",
    "residual_slip",
)
_OF_RUN: Final = ("peak_base_shear",)
_AXES: Final = ("x", "y")


def with_directions(vector: pl.DataFrame, directions: list[pl.DataFrame]) -> pl.DataFrame:
    """Return the table of the vectors of runs with the columns of each direction, named as `peak_drift_x`; `directions`
    are the same rows in x and in y.
    """
    columns = [
        table[name].alias(f"{name}_{axis}")
        for name in _names(vector)
        for axis, table in zip(_AXES, directions, strict=True)
    ]
    return vector.with_columns(columns)


def without_directions(table: pl.DataFrame) -> pl.DataFrame:
    """Return the table of runs in one direction with the columns of directions, which are null."""
    kinds: dict[str, Any] = {
        f"{name}_{axis}": pl.Float64 if name in _OF_RUN else pl.List(pl.Float64)
        for name in _names(table)
        for axis in _AXES
    }
    return table.with_columns(pl.lit(None, dtype=kind).alias(name) for name, kind in kinds.items())


def _names(table: pl.DataFrame) -> tuple[str, ...]:
    """What has columns of directions: with racks those of levels and contacts too."""
    return (*_OF_DIRECTIONS, *OF_RACKS) if OF_RACKS[0] in table.columns else _OF_DIRECTIONS
