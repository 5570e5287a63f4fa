"""Columns of tables of runs: what they are called on axes, in which unit, and one value of each per run."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, brief, refusal
from seismass.media.roles import ALPHA, MU
from seismass.media.style import plain

_LABELS: Final[dict[str, tuple[str, float]]] = {
    "peak_drift": ("peak drift (mm)", 1e3),
    "peak_drift_ratio": ("peak drift / height (%)", 1e2),
    "residual_drift": ("residual drift (mm)", 1e3),
    "residual_drift_ratio": ("residual drift / height (%)", 1e2),
    "peak_floor_acceleration": ("peak floor acceleration (g)", 1.0 / STANDARD_GRAVITY),
    "peak_storey_shear": ("peak storey shear (kN)", 1e-3),
    "peak_base_shear": ("peak base shear (kN)", 1e-3),
    "peak_slip": ("peak slip (mm)", 1e3),
    "residual_slip": ("residual slip (mm)", 1e3),
    "slip_path": ("path slipped (mm)", 1e3),
    "peak_drift_time": ("time of the peak drift (s)", 1.0),
    "peak_slip_time": ("time of the peak slip (s)", 1.0),
    "end_time": ("end (s)", 1.0),
    "period": ("period (s)", 1.0),
    "scale": ("scale factor of the motion", 1.0),
    "mass_ratio": (f"mass ratio {ALPHA}", 1.0),
    "mu": (f"friction coefficient {MU}", 1.0),
    "mu_s": (f"static friction coefficient {MU}", 1.0),
    "mu_k": (f"kinetic friction coefficient {MU}", 1.0),
}


def label_of(name: str) -> str:
    """Return what an axis calls a column: with its unit where it is known, else by its name."""
    return _LABELS[name][0] if name in _LABELS else plain(name)


def in_unit(name: str, values: NDArray[Any]) -> FloatArray:
    """Return values of a column in the unit of its label."""
    return np.asarray(_LABELS.get(name, ("", 1.0))[1] * np.asarray(values, dtype=np.float64))


def checked_table(table: Any, columns: tuple[str, ...], owner: str) -> pl.DataFrame:
    """Return a table of runs, which must have the columns needed, without those that failed."""
    if not isinstance(table, pl.DataFrame):
        raise refusal(InvalidOption, "table", owner, "a polars.DataFrame of runs", brief(table))
    for name in columns:
        if name not in table.columns:
            raise refusal(InvalidOption, "column", owner, f"one of {', '.join(table.columns)}", brief(name))
    kept = table.filter(pl.col("status") != "failed") if "status" in table.columns else table
    if kept.is_empty():
        raise refusal(InvalidOption, "table", owner, "one with runs that did not fail", f"{table.height} rows")
    return kept


def one_value(table: pl.DataFrame, name: str) -> pl.Expr:
    """Return a column with one value per row: of a list, such as that of storeys, the largest."""
    column = pl.col(name)
    return column.list.max() if isinstance(table.schema[name], pl.List | pl.Array) else column


def demand_of(table: pl.DataFrame, name: str) -> pl.Expr:
    """Return a demand with one value per row, infinite where the run collapsed."""
    value = one_value(table, name).cast(pl.Float64)
    if "status" not in table.columns:
        return value
    return pl.when(pl.col("status") == "collapsed").then(float("inf")).otherwise(value)
