"""Tables of batches."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.errors import InvalidMotion
from seismass.base.values import FloatArray, brief, refusal
from seismass.model.scene import Scene
from seismass.motions.motion import Motion
from seismass.runs.grid.columns import IndexArray
from seismass.runs.plane import PlaneMotion

_COLUMNS: Final = (
    "scene",
    "motion",
    "record",
    "status",
    "reason",
    "end_time",
    "collapsed_storey",
    "peak_drift",
    "peak_drift_time",
    "peak_drift_ratio",
    "residual_drift",
    "peak_floor_acceleration",
    "peak_storey_shear",
    "peak_base_shear",
    "peak_slip",
    "peak_slip_time",
    "residual_slip",
    "slip_path",
    "events",
    "yields",
    "slips",
)


def batch_table(
    batch: _kernel.Batch, scene: IndexArray, motion: IndexArray, names: list[str], heights: FloatArray
) -> pl.DataFrame:
    """The flat columns of a batch as a frame, without a Python object per run; `heights` as `peak_drift`."""
    failed = pl.Series(batch.status == _kernel.Batch.status_names().index("failed"))
    storeys, blocks = batch.storeys, batch.blocks
    per_storey = {
        "peak_drift": batch.peak_drift,
        "peak_drift_time": batch.peak_drift_time,
        "peak_drift_ratio": batch.peak_drift / heights,
        "residual_drift": batch.residual_drift,
        "peak_floor_acceleration": batch.peak_floor_acceleration,
        "peak_storey_shear": batch.peak_storey_shear,
    }
    per_block = {
        "peak_slip": batch.peak_slip,
        "peak_slip_time": batch.peak_slip_time,
        "residual_slip": batch.residual_slip,
        "slip_path": batch.slip_path,
    }
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
    return table.select(_COLUMNS)


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


Progress: TypeAlias = Callable[[int, int], object]
"""Called with (runs done, runs in all)."""


@dataclass(frozen=True, slots=True)
class SceneRuns:
    """Scenes, motions (two each for a scene in two directions) with their names, and whether tables have the columns of
    racks, stops and bases (`racks`) and those of directions (`plane`): any scene has them.
    """

    scenes: tuple[Scene, ...]
    motions: tuple[Motion | PlaneMotion, ...]
    names: tuple[str, ...]
    racks: bool
    plane: bool

    @classmethod
    def of(cls, scenes: Sequence[Scene], motions: Sequence[Motion | PlaneMotion], names: Sequence[str]) -> SceneRuns:
        """Return the runs of these scenes under these motions."""
        racks = any("general" in scene._engine_names for scene in scenes)
        plane = any(scene.engine == "plane" for scene in scenes)
        return cls(tuple(scenes), tuple(motions), tuple(names), racks, plane)

    def check(self, rows: IndexArray) -> None:
        """Refuse runs of scenes in two directions under one motion, and of others under two."""
        is_plane = np.array([scene.engine == "plane" for scene in self.scenes], dtype=np.bool_)[rows[:, 0]]
        are_two = np.array([isinstance(motion, tuple) for motion in self.motions], dtype=np.bool_)[rows[:, 1]]
        wrong = np.flatnonzero(is_plane != are_two)
        if len(wrong):
            scene, motion = (int(number) for number in rows[wrong[0]])
            requirement = (
                f"a Pair, or two motions, as scene {scene + 1} has two directions"
                if is_plane[wrong[0]]
                else f"a Motion or a Record, as scene {scene + 1} has one direction"
            )
            raise refusal(InvalidMotion, f"motion {motion + 1}", "batch", requirement, brief(self.motions[motion]))

    def table(
        self, rows: IndexArray, *, peaks_only: bool, threads: int | None, progress: Progress | None
    ) -> pl.DataFrame:
        """Return the table of runs, rows of scene and motion (runs, 2); other arguments as in `simulate_many`."""
        engine = np.array([scene.engine for scene in self.scenes], dtype=object)[rows[:, 0]]
        solve: dict[str, Callable[..., pl.DataFrame]] = {
            "chain": self._solve_chain,
            "general": self._solve_general,
            "plane": self._solve_plane,
        }
        parts, numbers, done = [], [], 0
        for name, solver in solve.items():
            of_engine = np.flatnonzero(engine == name)
            if len(of_engine) or (name == "chain" and not len(rows)):
                options: dict[str, Any] = {"threads": threads, "progress": _part(progress, done, len(rows))}
                if name == "chain":
                    options["peaks_only"] = peaks_only
                parts.append(solver(rows[of_engine], options))
                numbers.append(of_engine)
                done += len(of_engine)
        return parts[0] if len(parts) == 1 else pl.concat(parts)[np.argsort(np.concatenate(numbers))]

    def _solve_chain(self, rows: IndexArray, options: dict[str, Any]) -> pl.DataFrame:
        scenes, runs = self._scenes_of(rows)
        batch = _kernel.simulate_many([each._kernel for each in scenes], self._motions(), runs, **options)
        table = self._named(batch, rows, scenes, runs[:, 0])
        table = rack_columns(table, batch, None) if self.racks else table
        return without_directions(table) if self.plane else table

    def _solve_general(self, rows: IndexArray, options: dict[str, Any]) -> pl.DataFrame:
        scenes, runs = self._scenes_of(rows)
        general = [each._general_scene for each in scenes if each._general_scene is not None]
        batch, racks = _kernel.simulate_many_general(general, self._motions(), runs, **options)
        table = rack_columns(self._named(batch, rows, scenes, runs[:, 0]), batch, racks)
        return without_directions(table) if self.plane else table

    def _solve_plane(self, rows: IndexArray, options: dict[str, Any]) -> pl.DataFrame:
        scenes, runs = self._scenes_of(rows)
        used, motion = np.unique(rows[:, 1], return_inverse=True)
        pairs: list[Any] = [self.motions[number] for number in used]
        batches = _kernel.simulate_many_plane(
            [each._plane_scene for each in scenes if each._plane_scene is not None],
            [x._kernel for x, _ in pairs],
            [y.acceleration for _, y in pairs],
            np.stack([runs[:, 0], motion], axis=1),
            **options,
        )
        vector, *directions = (self._of_vector(batch, rows, scenes, runs[:, 0]) for batch in batches)
        return with_directions(vector, directions)

    def _of_vector(
        self,
        solved: tuple[_kernel.Batch, _kernel.RackColumns],
        rows: IndexArray,
        scenes: list[Scene],
        scene: IndexArray,
    ) -> pl.DataFrame:
        """The table of the vectors, or of one direction; the base shear has the share of matrices."""
        batch, racks = solved
        table = rack_columns(self._named(batch, rows, scenes, scene), batch, racks)
        return table if self.racks else table.drop(*OF_RACKS, *OF_BASES)

    def _named(self, batch: _kernel.Batch, rows: IndexArray, scenes: list[Scene], scene: IndexArray) -> pl.DataFrame:
        heights = heights_of_runs([heights_of(each) for each in scenes], scene, batch.storeys)
        return batch_table(batch, rows[:, 0], rows[:, 1], list(self.names), heights)

    def _motions(self) -> list[_kernel.Motion]:
        """The motions in one direction; of two the first, which no run has."""
        return [(each[0] if isinstance(each, tuple) else each)._kernel for each in self.motions]

    def _scenes_of(self, rows: IndexArray) -> tuple[list[Scene], IndexArray]:
        """Scenes that runs use, and rows of the index among them and of the motion."""
        used, scene = np.unique(rows[:, 0], return_inverse=True)
        return [self.scenes[number] for number in used], np.stack([scene, rows[:, 1]], axis=1)


def _part(progress: Progress | None, first: int, total: int) -> Progress | None:
    """Progress of one engine's runs as that of all."""
    return None if progress is None else lambda done, _: progress(first + done, total)
