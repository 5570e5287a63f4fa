"""Runs of scenes that exist as objects, of either engine, as rows of one table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.model.motion import Motion
from seismass.model.scene import Scene
from seismass.runs.batch_tables import batch_table, heights_of, heights_of_runs, rack_columns
from seismass.runs.grid.columns import IndexArray

Progress: TypeAlias = Callable[[int, int], object]
"""Called with (runs done, runs in all)."""


def have_racks(scenes: Sequence[Scene]) -> bool:
    """Whether tables of these scenes have the columns of racks, stops and bases: one is of the general engine."""
    return any(scene.engine == "general" for scene in scenes)


def scene_table(
    scenes: Sequence[Scene],
    motions: Sequence[Motion],
    names: list[str],
    rows: IndexArray,
    *,
    racks: bool,
    peaks_only: bool,
    threads: int | None,
    progress: Progress | None,
) -> pl.DataFrame:
    """Solve runs and return their table.

    Parameters
    ----------
    scenes, motions : sequence of Scene, of Motion
        What rows refer to.
    names : list of str
        What the motions are called.
    rows : ndarray of int, shape (runs, 2)
        Index of scene and of motion of each run.
    racks : bool
        Whether the table has the columns of racks, stops and bases, see `have_racks`.
    peaks_only, threads, progress
        As for `simulate_many`.
    """
    is_general = np.array([scene.engine == "general" for scene in scenes], dtype=np.bool_)[rows[:, 0]]
    of_chain, of_general = np.flatnonzero(~is_general), np.flatnonzero(is_general)
    parts = []
    if len(of_chain) or not len(of_general):
        chosen, scene = _chosen(scenes, rows[of_chain])
        batch = _kernel.simulate_many(
            [each._kernel for each in chosen],
            [each._kernel for each in motions],
            np.stack([scene, rows[of_chain, 1]], axis=1),
            peaks_only=peaks_only,
            threads=threads,
            progress=_part(progress, 0, len(rows)),
        )
        heights = heights_of_runs([heights_of(each) for each in chosen], scene, batch.storeys)
        table = batch_table(batch, rows[of_chain, 0], rows[of_chain, 1], names, heights)
        parts.append(rack_columns(table, batch, None) if racks else table)
    if len(of_general):
        chosen, scene = _chosen(scenes, rows[of_general])
        batch, of_racks = _kernel.simulate_many_general(
            [each._general for each in chosen if each._general is not None],
            [each._kernel for each in motions],
            np.stack([scene, rows[of_general, 1]], axis=1),
            threads=threads,
            progress=_part(progress, len(of_chain), len(rows)),
        )
        heights = heights_of_runs([heights_of(each) for each in chosen], scene, batch.storeys)
        table = batch_table(batch, rows[of_general, 0], rows[of_general, 1], names, heights)
        parts.append(rack_columns(table, batch, of_racks))
    if len(parts) == 1:
        return parts[0]
    return pl.concat(parts)[np.argsort(np.concatenate([of_chain, of_general]))]


def _chosen(scenes: Sequence[Scene], rows: IndexArray) -> tuple[list[Scene], IndexArray]:
    """Scenes that runs use, and the index among them of each run."""
    used, scene = np.unique(rows[:, 0], return_inverse=True)
    return [scenes[number] for number in used], scene


def _part(progress: Progress | None, first: int, total: int) -> Progress | None:
    """Progress of one engine's runs as that of all."""
    return None if progress is None else lambda done, _: progress(first + done, total)
