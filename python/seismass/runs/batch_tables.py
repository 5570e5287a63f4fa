"""Tables of batches."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.errors import InvalidScene
from seismass.base.values import FloatArray, as_list, brief, refusal
from seismass.model.scene import Scene
from seismass.runs.grid.columns import IndexArray

PER_STOREY: Final = (
    *("peak_drift", "peak_drift_time", "peak_drift_ratio", "residual_drift"),
    *("peak_floor_acceleration", "peak_storey_shear"),
)
PER_BLOCK: Final = ("peak_slip", "peak_slip_time", "residual_slip", "slip_path")
"""Lists of a batch, one value per storey or per block."""
_COLUMNS: Final = (
    *("scene", "motion", "record", "status", "reason", "end_time", "collapsed_storey"),
    *(*PER_STOREY, "peak_base_shear", "peak_floor_force", *PER_BLOCK),
    *("events", "yields", "slips"),
)


def batch_table(
    batch: _kernel.Batch, scene: IndexArray, motion: IndexArray, names: list[str], heights: FloatArray
) -> pl.DataFrame:
    """The flat columns of a batch as a frame, without a Python object per run; `heights` as `peak_drift`."""
    failed = pl.Series(batch.status == _kernel.Batch.status_names().index("failed"))
    storeys, blocks = batch.storeys, batch.blocks
    per_storey = {name: getattr(batch, name) for name in PER_STOREY if name != "peak_drift_ratio"}
    per_storey["peak_drift_ratio"] = batch.peak_drift / heights
    if batch.peak_floor_force is not None:
        per_storey["peak_floor_force"] = batch.peak_floor_force
    per_block = {name: getattr(batch, name) for name in PER_BLOCK}
    reasons = pl.DataFrame(batch.failures, schema={"run": pl.UInt32, "reason": pl.String}, orient="row")
    unknown = pl.element().is_nan().all()
    table = (
        pl.DataFrame(
            {
                "run": np.arange(len(scene), dtype=np.uint32),
                "scene": (scene + 1).astype(np.uint64),
                "motion": (motion + 1).astype(np.uint32),
                "record": pl.Series(names, dtype=pl.String).gather(motion),
                "status": pl.Series(_kernel.Batch.status_names(), dtype=pl.String).gather(batch.status),
                "end_time": pl.Series(batch.end_time).fill_nan(None),
                "collapsed_storey": pl.Series(batch.collapsed_storey).replace(0, None),
                **_lists(per_storey, storeys, failed),
                **_lists(per_block, blocks, failed),
                "events": batch.events,
                "yields": batch.yields,
                "slips": batch.slips,
            }
        )
        .join(reasons, on="run", how="left", maintain_order="left")
        .with_columns(
            pl.col("peak_storey_shear").list.first().alias("peak_base_shear"),
            # A run that ended early has no residual.
            pl.col("residual_drift", "residual_slip").list.eval(pl.element().fill_nan(None)),
            pl.when(pl.col("peak_drift_ratio").list.eval(unknown).list.first().not_())
            .then("peak_drift_ratio")
            .alias("peak_drift_ratio"),
            pl.when(pl.col("status") != "failed").then(pl.col("events", "yields", "slips")),
        )
    )
    return table.select(name for name in _COLUMNS if name in table.columns)


OF_LEVELS: Final = ("peak_rack_drift", "peak_rack_acceleration", "peak_rack_shear", "residual_rack_drift")
OF_CONTACTS: Final = ("peak_contact_force", "peak_contact_velocity")
OF_BASES: Final = ("peak_base_slip", "peak_base_acceleration", "residual_base_slip", "base_slip_path")
OF_RACKS: Final = (*OF_LEVELS, *OF_CONTACTS)
"""Columns of racks and stops; those of bases have one number."""


def rack_columns(table: pl.DataFrame, batch: _kernel.Batch, racks: _kernel.RackColumns | None) -> pl.DataFrame:
    """Return the table of a batch with the columns of racks, stops and sliding bases: lists per level of all racks in
    turn and per block. Runs of the chain engine (None) have no levels, contacts of 0 and no base.
    """
    failed = pl.Series(batch.status == _kernel.Batch.status_names().index("failed"))
    if racks is None:
        levels = np.zeros(len(batch.status), dtype=np.uint32)
        of_levels = {name: np.zeros(0) for name in OF_LEVELS}
        of_contacts = {name: np.zeros(int(batch.blocks.sum())) for name in OF_CONTACTS}
        of_bases = {name: np.full(len(batch.status), np.nan) for name in OF_BASES}
    else:
        levels = racks.levels
        of_levels = {name: getattr(racks, name) for name in OF_LEVELS}
        of_contacts = {name: getattr(racks, name) for name in OF_CONTACTS}
        of_bases = {name: getattr(racks, name) for name in OF_BASES}
        shear = pl.Series(racks.peak_base_shear).fill_nan(None)
        table = table.with_columns(peak_base_shear=pl.when(pl.col("status") != "failed").then(shear))
    columns = {**_lists(of_levels, levels, failed), **_lists(of_contacts, batch.blocks, failed)}
    return table.with_columns(
        **columns, **{name: pl.Series(values).fill_nan(None) for name, values in of_bases.items()}
    )


def listed_scenes(scenes: Any, owner: str) -> list[Scene]:
    """Return scenes that are given as one or as a list of them."""
    single = isinstance(scenes, Scene)
    listed = [scenes] if single else as_list(scenes, "scenes", owner, InvalidScene, "a list of Scenes")
    for number, scene in enumerate(listed, start=1):
        if not isinstance(scene, Scene):
            raise refusal(InvalidScene, f"scene {number}", owner, "a Scene", brief(scene))
    return listed


def heights_of(scene: Scene) -> FloatArray | None:
    """Return the storey heights of a scene (m), None where they are not known."""
    return None if scene.building is None else scene.building.heights


def heights_of_runs(known: list[FloatArray | None], which: IndexArray, storeys: NDArray[np.uint32]) -> FloatArray:
    """Height of each storey of each run, flat; NaN where not known. Run i has `storeys[i]` of those of `which[i]`."""
    flat: FloatArray = np.full(int(storeys.sum()), np.nan)
    if all(heights is None for heights in known):
        return flat
    starts = np.cumsum([0, *(0 if heights is None else len(heights) for heights in known)])
    unknown = np.array([heights is None for heights in known])
    position = np.arange(len(flat)) - np.repeat(np.cumsum(storeys) - storeys, storeys)
    owner = np.repeat(which, storeys)
    has = ~unknown[owner]
    joined = np.concatenate([heights for heights in known if heights is not None])
    flat[has] = joined[(starts[owner] + position.astype(np.int64))[has]]
    return flat


def _lists(columns: dict[str, FloatArray], lengths: NDArray[np.uint32], failed: pl.Series) -> dict[str, pl.Series]:
    """Flat values as list columns, `lengths[i]` values in row i; null in failed rows."""
    rows = pl.DataFrame({"run": np.arange(len(lengths), dtype=np.uint32), "empty": lengths == 0, "failed": failed})
    owners = np.repeat(rows["run"].to_numpy(), lengths)
    lists = pl.DataFrame({"run": owners, **columns}).group_by("run", maintain_order=True).agg(pl.all())
    nothing = pl.lit([], dtype=pl.List(pl.Float64))
    filled = rows.join(lists, on="run", how="left", maintain_order="left").select(
        pl.when(pl.col("empty") & ~pl.col("failed")).then(nothing).otherwise(pl.col(name)).alias(name)
        for name in columns
    )
    return {name: filled[name] for name in columns}


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
