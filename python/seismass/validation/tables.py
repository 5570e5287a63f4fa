"""Tables of the validations that figures are drawn from, and the validations of these tables again."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Final

import numpy as np
import polars as pl

from seismass.base.values import FloatArray
from seismass.validation.shaking_table import Band, Platform, robust_numbers
from seismass.validation.three_storeys import EXACT, FRICTION_SPRINGS, OPENSEES, STOREYS, Histories, Section4

MOST_INSTANTS: Final = 1000
"""Most instants that are kept of a history, for figures: a few dozen in a period."""
DRAWN_PROGRAMS: Final = (EXACT, OPENSEES, FRICTION_SPRINGS)
"""Programs whose histories are drawn, of a later one on top."""
_BAND: Final = ("low", "high", "central", "attached")
_LISTS: Final = ("yields", "peak_drift", "peak_slip")


def section4_tables(section4: Section4) -> dict[str, pl.DataFrame]:
    """Return `section4_runs`, `section4_differences` and `section4_histories`, without lists in their cells."""
    flat = [pl.col(name).list.get(i).alias(f"{name}_{i + 1}") for name in _LISTS for i in range(STOREYS)]
    histories = [_history_table(item) for item in stiffest(section4.histories)]
    return {
        "section4_runs": section4.runs.with_columns(flat).drop(_LISTS),
        "section4_differences": section4.differences,
        "section4_histories": pl.concat(histories),
    }


def section4_of(tables: Mapping[str, pl.DataFrame], *, synthetic: bool) -> Section4:
    """Return the comparison of programs of its tables; its histories are those that are drawn."""
    runs = tables["section4_runs"].with_columns(
        pl.concat_list([f"{name}_{i + 1}" for i in range(STOREYS)]).alias(name) for name in _LISTS
    )
    keys = ("program", "setting", "component", "second_slope", "every")
    histories = [
        Histories(
            program,
            setting,
            component,
            second_slope,
            every,
            rows["time"].to_numpy(),
            rows.select(f"drift_{i + 1}" for i in range(STOREYS)).to_numpy(),
            rows.select(f"slip_{i + 1}" for i in range(STOREYS)).to_numpy(),
        )
        for (program, setting, component, second_slope, every), rows in tables["section4_histories"].group_by(
            *keys, maintain_order=True
        )
    ]
    return Section4(runs, tables["section4_differences"], tuple(histories), synthetic)


def platform_tables(platform: Platform) -> dict[str, pl.DataFrame]:
    """Return `platform_runs`, and `platform_bands` at no more instants than figures need."""
    return {
        "platform_runs": platform.runs,
        "platform_bands": pl.concat([_band_table(band) for band in platform.bands]),
    }


def platform_of(tables: Mapping[str, pl.DataFrame], *, synthetic: bool) -> Platform:
    """Return the platform of its tables."""
    bands = [
        Band(component, ratio, rows["time"].to_numpy(), *(rows[name].to_numpy() for name in _BAND))
        for (component, ratio), rows in tables["platform_bands"].group_by(
            "component", "mass_ratio", maintain_order=True
        )
    ]
    runs = tables["platform_runs"]
    return Platform(runs, tuple(bands), robust_numbers(runs), synthetic)


def stiffest(histories: Iterable[Histories]) -> list[Histories]:
    """Return of each run the histories by the programs that are drawn, each with its last setting."""
    last = {(item.component, item.second_slope, item.program): item for item in histories if item.time.size}
    runs = dict.fromkeys(key[:2] for key in last)
    return [last[*run, program] for run in runs for program in DRAWN_PROGRAMS if (*run, program) in last]


def _history_table(item: Histories) -> pl.DataFrame:
    kept = slice(None, None, max(1, math.ceil(len(item.time) / MOST_INSTANTS)))
    values = {f"{name}_{i + 1}": getattr(item, name)[kept, i] for name in ("drift", "slip") for i in range(STOREYS)}
    frame = pl.DataFrame({"time": item.time[kept], **values})
    keys = {name: getattr(item, name) for name in ("component", "second_slope", "program", "setting", "every")}
    return frame.select(*(pl.lit(value).alias(name) for name, value in keys.items()), pl.all())


def _band_table(band: Band) -> pl.DataFrame:
    """The band with its least and largest drift over each window of instants."""
    every = max(1, math.ceil(len(band.time) / MOST_INSTANTS))
    starts = np.arange(0, len(band.time), every)
    ends: dict[str, FloatArray] = {
        "low": np.minimum.reduceat(band.low, starts),
        "high": np.maximum.reduceat(band.high, starts),
    }
    frame = pl.DataFrame(
        {"time": band.time[starts], **ends, **{name: getattr(band, name)[starts] for name in ("central", "attached")}}
    )
    return frame.select(
        pl.lit(band.component).alias("component"), pl.lit(band.mass_ratio).alias("mass_ratio"), pl.all()
    )
