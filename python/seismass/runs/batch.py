"""Many runs: their peaks as one frame, as a stream of frames of bounded size, or as a Parquet file."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, BinaryIO, Final, Protocol, TypeAlias, TypedDict

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.arguments import Progress, ProgressLike, as_progress, as_threads
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.files import check_files, polars_writing, write_file
from seismass.base.fork_check import require_polars
from seismass.base.stored_results import inputs_digest, result_store
from seismass.base.values import as_count, as_flag, as_list, as_path, brief, printable, refusal
from seismass.model.scene import Scene
from seismass.motions.motion import HasMotion, Motion, MotionLike, as_motion, motion_names
from seismass.motions.records.pair import Pair
from seismass.runs.batch_tables import (
    OF_BASES,
    OF_RACKS,
    batch_table,
    heights_of,
    heights_of_runs,
    listed_scenes,
    rack_columns,
    with_directions,
    without_directions,
)
from seismass.runs.grid.columns import IndexArray
from seismass.runs.grid.grid import Grid
from seismass.runs.plane import MotionPair, PlaneMotion, is_motion_pair, motions_in_plane
from seismass.runs.quantities import of_chains_alone
from seismass.runs.simulate import instruction_set, warn_of_doubts

DEFAULT_CHUNK: Final = 8192
"""Runs solved at once: enough to share propagators and to keep threads busy, in some tens of megabytes."""
MAX_RUNS: Final = 2**53
"""Most runs of a batch: beyond, doubles in which numbers of runs may be read skip some."""
MAX_ROWS: Final = 2**32 - 1
"""Most rows of one table: Polars counts them by 32 bits."""
MAX_THREADS: Final = _kernel.MAX_THREADS
"""Most threads of a batch, as the kernel has it: more than any machine has cores for."""

MotionsLike: TypeAlias = "MotionLike | Pair | Iterable[MotionLike | MotionPair]"
"""Motions of a batch: one or many; pairs, or tuples of two motions, are those of scenes in two directions."""


def simulate_many(
    scenes: Scene | Sequence[Scene] | Grid,
    motions: MotionsLike,
    *,
    pairs: ArrayLike | None = None,
    runs: range | None = None,
    peaks_only: bool = False,
    floor_force: bool = False,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> pl.DataFrame:
    """Solve many scenes under many motions, in parallel; the result does not depend on the number of threads.

    Parameters
    ----------
    scenes : Scene, sequence of Scene, or Grid
        The scenes, as objects or described by columns.
    motions : Motion, Record, Pair or iterable of them
        The motions. A scene in two directions takes pairs, or tuples of two motions, as `simulate` does.
    pairs : array_like of int, shape (runs, 2), optional
        Rows of (number of scene, number of motion), both counted from 1, as the table counts them. By default every
        scene under every motion, the motion changing fastest. Equal runs of shear buildings are solved once. A grid has
        a column of motions instead.
    runs : range, optional
        Numbers of the runs to solve, counted from 1 in the order of the whole table, as `range(1001, 2001)`; by default
        all. The rows are those of the whole table. A stretch of a grid costs no more than its runs.
    peaks_only : bool, default False
        A run may end once no peak can be beaten any more, with the same peaks; residuals are then null. Scenes with
        racks, stops or a stiffness matrix run to the end.
    floor_force : bool, default False
        The column `peak_floor_force` too: of shear buildings in one direction, without a sliding base, alone.
    threads : int, optional
        Number of threads, up to 1024; by default all cores.
    progress : callable, optional
        Called with (runs done, runs to solve) about twenty times a second, and at the end.

    Returns
    -------
    polars.DataFrame
        One row per run, in the order asked for: `scene`, `motion` (numbers, counted from 1 as given); `record` (name of
        the motion, "motion 3" where it has none); `status` ("completed", "collapsed", "failed"), `reason` (of a
        failure, else null), `end_time` (s), `collapsed_storey` (from 1, or null); lists per storey `peak_drift`,
        `peak_drift_time`, `peak_drift_ratio` (null without heights), `residual_drift`, `peak_floor_acceleration`,
        `peak_storey_shear`; `peak_base_shear`; if asked for, lists per floor `peak_floor_force`; lists per block
        `peak_slip`, `peak_slip_time`, `residual_slip`, `slip_path`; numbers of `events`, `yields`, `slips`. SI units.
        Where a scene has racks, stops, a stiffness matrix or a sliding base, lists per level of all racks, one rack
        after the other, `peak_rack_drift`,
        `peak_rack_acceleration`, `peak_rack_shear`, `residual_rack_drift`, lists per block `peak_contact_force`,
        `peak_contact_velocity`, and `peak_base_slip`, `peak_base_acceleration`, `residual_base_slip`, `base_slip_path`
        (null without a base); blocks are the goods on floors, then those of racks that may slide; a level that
        collapses counts on from the storeys; the base shear includes the matrix's share. Where a scene has two
        directions, these are lengths of vectors in its rows, and the larger of both directions for contacts; lists and
        numbers in x and in y, with the sign that residuals have, stand in columns such as `peak_drift_x`, which are
        null for scenes in one direction.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be. A run that fails raises nothing: it is a row with a reason.
    SimulationError
        The process was forked from one in which Polars had been used: its tables cannot be made there.
    KeyboardInterrupt
        Ctrl-C was pressed; the batch stops at once.

    Warns
    -----
    DoubtfulInput
        One of the first hundred scenes or motions is so unlikely that a wrong unit is the usual cause.

    See Also
    --------
    long_table : One row per run and storey.
    stream_many : The same rows in frames of bounded size.
    write_many : The same rows as a Parquet file.

    Examples
    --------
    >>> import seismass as sm
    >>> scenes = [sm.Scene(None, [sm.Block(0, mass=100.0, mu=mu)]) for mu in (0.1, 0.3)]
    >>> table = sm.simulate_many(scenes, sm.Motion([2.0, 2.0, 0.0, 0.0], dt=0.1))
    >>> table["slips"].to_list()
    [1, 0]
    """
    warn_of_doubts(scenes, motions)
    how: dict[str, Any] = {"peaks_only": peaks_only, "floor_force": floor_force, "threads": threads}
    return solve_many(scenes, motions, pairs=pairs, runs=runs, progress=progress, **how)


def solve_many(
    scenes: Scene | Sequence[Scene] | Grid,
    motions: MotionsLike,
    *,
    pairs: ArrayLike | None = None,
    runs: range | None = None,
    peaks_only: bool = False,
    floor_force: bool = False,
    threads: int | None = None,
    progress: ProgressLike = None,
    known: EngineRuns | None = None,
) -> pl.DataFrame:
    """Return what `simulate_many` does without its warnings. The first runs, all of one engine, may be `known`."""
    batch, options = _batch(scenes, motions, pairs, known), _options(peaks_only, floor_force, threads)
    # Objects are there already, so that all runs may look for equal ones; those of a grid exist a chunk at a time.
    stretch = _one_table(_stretch(runs, batch.total))
    chunk = DEFAULT_CHUNK if isinstance(scenes, Grid) else max(len(stretch), 1)
    return pl.concat(list(_frames(batch, stretch, chunk, options, as_progress(progress, "batch"))))


def stream_many(
    scenes: Scene | Sequence[Scene] | Grid,
    motions: MotionsLike,
    *,
    pairs: ArrayLike | None = None,
    runs: range | None = None,
    chunk: int = DEFAULT_CHUNK,
    peaks_only: bool = False,
    floor_force: bool = False,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> Iterator[pl.DataFrame]:
    """Solve many scenes under many motions and give the rows of `simulate_many` in frames of bounded size, in order.

    Beside the arguments no more than one chunk of runs is held, however many there are. The values do not depend on the
    size of chunks. Arguments are judged at once; runs are solved when their frame is asked for.

    Parameters
    ----------
    scenes, motions, pairs, runs, peaks_only, floor_force, threads
        As for `simulate_many`.
    chunk : int, default 8192
        Runs per frame. Equal runs of a chunk are solved once, and those of equal structure share propagators.
    progress : callable, optional
        Called with (runs done, runs to solve) about twenty times a second while a chunk is solved, and at its end.

    Yields
    ------
    polars.DataFrame
        At least one, with the columns of `simulate_many`; empty where there are no runs.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be.
    SimulationError
        As for `simulate_many`.
    KeyboardInterrupt
        Ctrl-C was pressed; the chunk stops at once.

    Examples
    --------
    >>> import numpy as np
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
    >>> grid = sm.Grid.product(building, mass_ratio=[0.5, 1.0], mu=np.linspace(0.1, 0.5, 50))
    >>> motion = sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1)
    >>> [len(frame) for frame in sm.stream_many(grid, motion, chunk=40)]
    [40, 40, 20]
    """
    size = as_count(chunk, "chunk", "batch", InvalidOption, least=1)
    batch, options = _batch(scenes, motions, pairs), _options(peaks_only, floor_force, threads)
    return _frames(batch, _stretch(runs, batch.total), size, options, as_progress(progress, "batch"))


def write_many(
    path: str | os.PathLike[str],
    scenes: Scene | Sequence[Scene] | Grid,
    motions: MotionsLike,
    *,
    pairs: ArrayLike | None = None,
    runs: range | None = None,
    chunk: int = DEFAULT_CHUNK,
    peaks_only: bool = False,
    floor_force: bool = False,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> None:
    """Solve many scenes under many motions and write the rows of `simulate_many` to a Parquet file as they come.

    The file appears whole or not at all; chunks are kept in a hidden folder beside it until then. The same call after
    an interruption takes those that are there; other inputs, another version or another size of chunks start again. The
    metadata of the file name the version of seismass and the instruction set.

    Parameters
    ----------
    path : path-like
        The file to write, with the suffix .parquet; its folder must exist.
    scenes, motions, pairs, runs, chunk, peaks_only, floor_force, threads, progress
        As for `stream_many`.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError, KeyboardInterrupt
        As for `stream_many`; InvalidOption also where the path has another suffix.
    OSError
        The file cannot be written: its folder is missing or closed to this user, or the disk is full.
    """
    target = as_path(path, "batch", InvalidOption)
    absolute = str(target.absolute())
    if printable(absolute) != absolute:
        raise refusal(InvalidOption, "path", "batch", "in UTF-8, as Polars writes no other", brief(absolute))
    if target.name and not target.is_dir() and target.suffix.lower() != ".parquet":
        requirement = "one with the suffix .parquet, as lists per storey fit no CSV (see long_table)"
        raise refusal(InvalidOption, "path", "batch", requirement, brief(str(target)))
    size = as_count(chunk, "chunk", "batch", InvalidOption, least=1)
    warn_of_doubts(scenes, motions)
    batch, options = _batch(scenes, motions, pairs), _options(peaks_only, floor_force, threads)
    stretch = _one_table(_stretch(runs, batch.total))
    whole = Progress(progress, len(stretch), "batch")
    solved_by = (_kernel.VERSION, instruction_set(), size, options["peaks_only"], options["floor_force"], stretch)
    check_files(target)
    with result_store(target.parent, target.name, inputs_digest(batch, solved_by)) as store:
        parts = []
        for done in range(0, max(len(stretch), 1), size):
            part = stretch[done : done + size]
            solve = partial(batch.solve, part, options, whole.part(len(part)))
            parts.append(store.file(str(done // size), solve))

        def write(file: BinaryIO) -> None:
            with polars_writing():
                pl.scan_parquet(parts, glob=False).sink_parquet(
                    file,
                    row_group_size=DEFAULT_CHUNK,  # small, as each group is held while it is copied
                    metadata={"seismass": _kernel.VERSION, "instructions": instruction_set()},
                )

        write_file(target, write)


class _Options(TypedDict):
    peaks_only: bool
    floor_force: bool
    threads: int | None


def _options(peaks_only: Any, floor_force: Any, threads: Any) -> _Options:
    return {
        "peaks_only": as_flag(peaks_only, "peaks_only", "batch", InvalidOption),
        "floor_force": as_flag(floor_force, "floor_force", "batch", InvalidOption),
        "threads": as_threads(threads, "batch"),
    }


class _Batch(Protocol):
    """Runs in an order, of which any stretch can be solved."""

    @property
    def total(self) -> int: ...

    def solve(self, runs: range, options: _Options, progress: ProgressLike) -> pl.DataFrame: ...


def _frames(
    batch: _Batch, stretch: range, chunk: int, options: _Options, progress: ProgressLike
) -> Iterator[pl.DataFrame]:
    whole = Progress(progress, len(stretch), "batch")
    for done in range(0, max(len(stretch), 1), chunk):
        runs = stretch[done : done + chunk]
        yield batch.solve(runs, options, whole.part(len(runs)))


def _stretch(runs: Any, total: int) -> range:
    """Runs as indices from 0, all by default."""
    if runs is None:
        return range(total)
    limits = f"a range of numbers of runs, from 1 to {total}, without steps"
    is_stretch = isinstance(runs, range) and (len(runs) < 2 or runs.step == 1)
    if not is_stretch or (len(runs) and not 1 <= runs[0] <= runs[-1] <= total):
        raise refusal(InvalidOption, "runs", "batch", limits, brief(runs))
    return range(runs[0] - 1, runs[-1]) if len(runs) else range(0)


def _one_table(stretch: range) -> range:
    """Refuse more runs than one table holds."""
    if len(stretch) > MAX_ROWS:
        requirement = f"at most {MAX_ROWS} for one table (stream_many and Campaign take more)"
        raise refusal(InvalidOption, "runs", "batch", requirement, str(len(stretch)))
    return stretch


def checked_motions(motions: Any) -> tuple[list[Any], list[Motion], list[str]]:
    """Return motions in one direction as they were given, as the kernel takes them, and their names."""
    items = _listed_motions(motions)
    listed = [as_motion(motion, f"motion {number}", "batch") for number, motion in enumerate(items, start=1)]
    return items, listed, motion_names(items)


def _listed_motions(motions: Any) -> list[Any]:
    if isinstance(motions, Motion | HasMotion | Pair):
        return [motions]
    return as_list(motions, "motions", "batch", InvalidMotion, "a list of Motions or Records")


def _in_any_plane(motions: list[Any]) -> list[Motion | PlaneMotion]:
    """Motions as they are solved: pairs as their two motions."""
    return [
        motions_in_plane(motion, f"motion {number}", "batch")
        if is_motion_pair(motion)
        else as_motion(motion, f"motion {number}", "batch")
        for number, motion in enumerate(motions, start=1)
    ]


def _batch(scenes: Any, motions: Any, pairs: ArrayLike | None, known: EngineRuns | None = None) -> _Batch:
    require_polars("simulate")
    if isinstance(scenes, Grid):
        if pairs is not None:
            requirement = "left out with a Grid, which has a column of motions"
            raise refusal(InvalidOption, "pairs", "batch", requirement, brief(pairs))
        _, checked, names = checked_motions(motions)
        batch: _Batch = _GridBatch(scenes, checked, names)
        scenes._check_motions(len(checked))
    else:
        listed, listed_motions = listed_scenes(scenes, "batch"), _listed_motions(motions)
        wanted = None if pairs is None else _pairs(pairs, len(listed), len(listed_motions))
        scene_runs = SceneRuns.of(listed, _in_any_plane(listed_motions), motion_names(listed_motions))
        batch = _SceneBatch(scene_runs, wanted, known)
        batch.check()
    if batch.total > MAX_RUNS:
        raise refusal(InvalidOption, "runs", "batch", f"at most {MAX_RUNS}", str(batch.total))
    return batch


EngineRuns: TypeAlias = list[tuple[_kernel.Batch, _kernel.RackColumns | None]]


def solve_engine(
    scenes: Sequence[Scene],
    motions: Sequence[Motion | PlaneMotion],
    rows: IndexArray,
    *,
    peaks_only: bool,
    threads: int | None,
    progress: ProgressLike,
    floor_force: bool = False,
) -> EngineRuns:
    """What the kernel gives back of runs, rows of scene and motion, of scenes of one engine: one batch, or in two
    directions those of the vectors, of x and of y; each with columns of racks and bases, but that of the chain.
    """
    listed, shaken, runs = _used(scenes, motions, rows)
    engine = listed[0].engine if listed else "chain"
    if floor_force and engine != "chain":
        raise of_chains_alone("batch")
    how: dict[str, Any] = {"threads": threads, "progress": progress}
    if engine == "plane":
        x, y = zip(*shaken, strict=True)
        kernels, others = [each._kernel for each in x], [each.acceleration for each in y]
        in_plane = [each._plane_scene for each in listed]
        return [*_kernel.simulate_many_plane(in_plane, kernels, others, runs, **how)]
    kernels = [each._kernel for each in shaken]
    if engine == "general":
        return [_kernel.simulate_many_general([each._general_scene for each in listed], kernels, runs, **how)]
    how |= {"peaks_only": peaks_only, "floor_force": floor_force}
    return [(_kernel.simulate_many([each._kernel for each in listed], kernels, runs, **how), None)]


def _used(
    scenes: Sequence[Scene], motions: Sequence[Motion | PlaneMotion], rows: IndexArray
) -> tuple[list[Any], list[Any], IndexArray]:
    """Scenes and motions that runs use, and the rows of their numbers among them."""
    used = [np.unique(column, return_inverse=True) for column in rows.T]
    listed, shaken = (
        [items[number] for number in numbers] for items, (numbers, _) in zip((scenes, motions), used, strict=True)
    )
    return listed, shaken, np.stack([places for _, places in used], axis=1)


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

    def table(self, rows: IndexArray, *, progress: ProgressLike, known: EngineRuns | None, **how: Any) -> pl.DataFrame:
        """Return the table of runs, rows of scene and motion, the first ones `known`; options as in `simulate_many`."""
        engine = np.array([scene.engine for scene in self.scenes], dtype=object)[rows[:, 0]]
        parts, numbers, whole = [], [], Progress(progress, len(rows), "batch")
        if known is not None:
            first = np.arange(len(known[0][0].status))
            parts, numbers = [self._engine_table(engine[0], rows[first], known)], [first]
            engine[first] = ""
            whole.tell(len(first))
        for name in ("chain", "general", "plane"):
            of_engine = np.flatnonzero(engine == name)
            if len(of_engine) or (name == "chain" and not len(rows)):
                tell = whole.part(len(of_engine))
                solved = solve_engine(self.scenes, self.motions, rows[of_engine], **how, progress=tell)
                parts.append(self._engine_table(name, rows[of_engine], solved))
                numbers.append(of_engine)
        return parts[0] if len(parts) == 1 else pl.concat(parts)[np.argsort(np.concatenate(numbers))]

    def _engine_table(self, engine: str, rows: IndexArray, solved: EngineRuns) -> pl.DataFrame:
        """The table of the runs of one engine, with the columns that those of others have; the base shear has the
        share of matrices.
        """
        names, known = list(self.names), [heights_of(scene) for scene in self.scenes]
        tables = []
        for batch, racks in solved:
            table = batch_table(batch, rows[:, 0], rows[:, 1], names, heights_of_runs(known, rows[:, 0], batch.storeys))
            if self.racks or racks is not None:
                table = rack_columns(table, batch, racks)
            tables.append(table if self.racks or engine != "plane" else table.drop(*OF_RACKS, *OF_BASES))
        if engine == "plane":
            return with_directions(tables[0], tables[1:])
        return without_directions(tables[0]) if self.plane else tables[0]


@dataclass(frozen=True, slots=True)
class _SceneBatch:
    """Runs of scenes that exist as objects: those of `pairs`, or every scene under every motion."""

    scene_runs: SceneRuns
    pairs: IndexArray | None
    known: EngineRuns | None

    @property
    def total(self) -> int:
        return len(self.scene_runs.scenes) * len(self.scene_runs.motions) if self.pairs is None else len(self.pairs)

    def check(self) -> None:
        """Refuse motions that do not suit their scenes; every scene is solved under every motion, or those of pairs."""
        if self.scene_runs.plane or any(isinstance(motion, tuple) for motion in self.scene_runs.motions):
            self.scene_runs.check(self._rows(range(self.total)))

    def _rows(self, runs: range) -> IndexArray:
        """Scene and motion of each run."""
        if self.pairs is not None:
            return self.pairs[runs.start : runs.stop]
        return np.stack(np.divmod(np.arange(runs.start, runs.stop), max(len(self.scene_runs.motions), 1)), axis=1)

    def solve(self, runs: range, options: _Options, progress: ProgressLike) -> pl.DataFrame:
        return self.scene_runs.table(self._rows(runs), **options, progress=progress, known=self.known)


@dataclass(frozen=True, slots=True)
class _GridBatch:
    """Runs of scenes that columns describe."""

    grid: Grid
    motions: list[Motion]
    names: list[str]

    @property
    def total(self) -> int:
        return self.grid._runs_under(len(self.motions))

    def solve(self, runs: range, options: _Options, progress: ProgressLike) -> pl.DataFrame:
        scene, motion = self.grid._scene_and_motion(np.arange(runs.start, runs.stop), len(self.motions))
        first, last = (int(scene[0]), int(scene[-1]) + 1) if len(scene) else (0, 0)
        batch = _kernel.simulate_columns(
            self.grid._kernel_columns(np.arange(first, last)),
            [each._kernel for each in self.motions],
            np.stack([scene - first, motion], axis=1),
            self.grid._factor_of(scene),
            **options,
            progress=progress,
        )
        heights = [building.heights for building in self.grid.buildings]
        of_scene = heights_of_runs(heights, self.grid._building_of(scene), batch.storeys)
        return batch_table(batch, scene, motion, self.names, of_scene)


def _pairs(pairs: ArrayLike, scenes: int, motions: int) -> IndexArray:
    """Runs as rows of (index of scene, index of motion), from rows that count from 1."""
    requirement = "rows of (number of scene, number of motion)"
    try:
        rows = np.asarray(pairs)
    except ValueError:
        raise refusal(InvalidOption, "pairs", "batch", requirement, brief(pairs)) from None
    if rows.size == 0:
        return np.empty((0, 2), dtype=np.int64)
    if rows.dtype.kind not in "iu" or rows.ndim != 2 or rows.shape[1] != 2:
        raise refusal(InvalidOption, "pairs", "batch", requirement, brief(pairs))
    for column, (name, size) in enumerate((("scene", scenes), ("motion", motions))):
        wrong = np.flatnonzero((rows[:, column] < 1) | (rows[:, column] > size))
        if len(wrong):
            limits = f"the number of a {name}, counted from 1 to {size}"
            got = f"{rows[wrong[0], column]} in pair {wrong[0] + 1}"
            raise refusal(InvalidOption, "pairs", "batch", limits, got)
    return np.ascontiguousarray(rows, dtype=np.int64) - 1
