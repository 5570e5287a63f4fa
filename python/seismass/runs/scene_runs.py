"""Runs of scenes that exist as objects, of any engine, as rows of one table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.base.errors import InvalidMotion
from seismass.base.values import brief, refusal
from seismass.model.motion import Motion
from seismass.model.scene import Scene
from seismass.runs.batch_tables import OF_BASES, OF_RACKS, batch_table, heights_of, heights_of_runs, rack_columns
from seismass.runs.grid.columns import IndexArray
from seismass.runs.plane_motion import PlaneMotion
from seismass.runs.plane_tables import with_directions, without_directions

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
        racks = any("general" in scene._engines for scene in scenes)
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
        """Solve runs, rows of scene and motion (runs, 2), and return their table; other arguments as in
        `simulate_many`.
        """
        engine = np.array([scene.engine for scene in self.scenes], dtype=object)[rows[:, 0]]
        solve: dict[str, Callable[..., pl.DataFrame]] = {
            "chain": self._chain,
            "general": self._general,
            "plane": self._plane,
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

    def _chain(self, rows: IndexArray, options: dict[str, Any]) -> pl.DataFrame:
        chosen, runs = self._chosen(rows)
        batch = _kernel.simulate_many([each._kernel for each in chosen], self._motions(), runs, **options)
        table = self._named(batch, rows, chosen, runs[:, 0])
        table = rack_columns(table, batch, None) if self.racks else table
        return without_directions(table) if self.plane else table

    def _general(self, rows: IndexArray, options: dict[str, Any]) -> pl.DataFrame:
        chosen, runs = self._chosen(rows)
        general = [each._general for each in chosen if each._general is not None]
        batch, racks = _kernel.simulate_many_general(general, self._motions(), runs, **options)
        table = rack_columns(self._named(batch, rows, chosen, runs[:, 0]), batch, racks)
        return without_directions(table) if self.plane else table

    def _plane(self, rows: IndexArray, options: dict[str, Any]) -> pl.DataFrame:
        chosen, runs = self._chosen(rows)
        used, motion = np.unique(rows[:, 1], return_inverse=True)
        pairs: list[Any] = [self.motions[number] for number in used]
        batches = _kernel.simulate_many_plane(
            [each._plane for each in chosen if each._plane is not None],
            [x._kernel for x, _ in pairs],
            [y.acceleration for _, y in pairs],
            np.stack([runs[:, 0], motion], axis=1),
            **options,
        )
        vector, *directions = (self._of_vector(batch, rows, chosen, runs[:, 0]) for batch in batches)
        return with_directions(vector, directions)

    def _of_vector(
        self,
        solved: tuple[_kernel.Batch, _kernel.RackColumns],
        rows: IndexArray,
        chosen: list[Scene],
        scene: IndexArray,
    ) -> pl.DataFrame:
        """The table of the vectors, or of one direction; the base shear has the share of matrices."""
        batch, racks = solved
        table = rack_columns(self._named(batch, rows, chosen, scene), batch, racks)
        return table if self.racks else table.drop(*OF_RACKS, *OF_BASES)

    def _named(self, batch: _kernel.Batch, rows: IndexArray, chosen: list[Scene], scene: IndexArray) -> pl.DataFrame:
        heights = heights_of_runs([heights_of(each) for each in chosen], scene, batch.storeys)
        return batch_table(batch, rows[:, 0], rows[:, 1], list(self.names), heights)

    def _motions(self) -> list[_kernel.Motion]:
        """The motions in one direction; of two the first, which no run has."""
        return [(each[0] if isinstance(each, tuple) else each)._kernel for each in self.motions]

    def _chosen(self, rows: IndexArray) -> tuple[list[Scene], IndexArray]:
        """Scenes that runs use, and rows of the index among them and of the motion."""
        used, scene = np.unique(rows[:, 0], return_inverse=True)
        return [self.scenes[number] for number in used], np.stack([scene, rows[:, 1]], axis=1)


def _part(progress: Progress | None, first: int, total: int) -> Progress | None:
    """Progress of one engine's runs as that of all."""
    return None if progress is None else lambda done, _: progress(first + done, total)
