"""Columns of the parts of a campaign: those of `simulate_many`, with their units, less what is joined from tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, Final

import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, is_one_of, refusal

KEYS: Final = ("scene", "motion", "status")
"""Columns that every part has: the numbers of scene and motion, from 1, and how the run ended."""

UNITS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "scene": "",
        "motion": "",
        "status": "",
        "reason": "",
        "end_time": "s",
        "collapsed_storey": "",
        "peak_drift": "m",
        "peak_drift_time": "s",
        "peak_drift_ratio": "",
        "residual_drift": "m",
        "peak_floor_acceleration": "m/s2",
        "peak_storey_shear": "N",
        "peak_base_shear": "N",
        "peak_slip": "m",
        "peak_slip_time": "s",
        "residual_slip": "m",
        "slip_path": "m",
        "events": "",
        "yields": "",
        "slips": "",
    }
)
"""Unit of each column that a part may have; empty for what has none. Lists are per storey or per block."""

RESIDUALS: Final = ("residual_drift", "residual_slip")
"""Columns that runs of peaks only do not have."""


def chosen_columns(columns: Iterable[str] | None, peaks_only: bool) -> tuple[str, ...]:
    """Return the columns that parts have, in their order; unknown ones are refused, and those that runs of peaks only
    lack.
    """
    known = [name for name in UNITS if not (peaks_only and name in RESIDUALS)]
    if columns is None:
        return tuple(known)
    if isinstance(columns, str) or not isinstance(columns, Iterable):
        raise refusal(InvalidOption, "columns", "campaign", "a list of names", brief(columns))
    wanted = list(columns)
    for name in wanted:
        if not is_one_of(name, known):
            beside = " (left out where peaks_only is chosen)" if is_one_of(name, RESIDUALS) else ""
            raise refusal(InvalidOption, "columns", "campaign", f"some of {', '.join(known)}{beside}", brief(name))
    return tuple(name for name in known if name in wanted or name in KEYS)


def stored(frame: pl.DataFrame, columns: tuple[str, ...], single: bool) -> pl.DataFrame:
    """Return the columns of rows of `simulate_many`, in single precision where that is chosen."""
    chosen = frame.select(columns)
    if not single:
        return chosen
    shorter: dict[pl.DataType, Any] = {pl.Float64(): pl.Float32, pl.List(pl.Float64): pl.List(pl.Float32)}
    return chosen.cast({name: shorter[dtype] for name, dtype in chosen.schema.items() if dtype in shorter})
