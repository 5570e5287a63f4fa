"""A campaign: the runs of a grid under motions, cut into parts of fixed content."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.base.errors import InvalidOption
from seismass.base.values import as_count, as_path, brief, printable, refusal
from seismass.campaign.columns import chosen_columns, stored
from seismass.campaign.motions import NamedMotion, named_motions
from seismass.model.motion import MotionLike
from seismass.runs.batch import checked_motions
from seismass.runs.grid.content import axes_table, grid_document
from seismass.runs.grid.grid import Grid

if TYPE_CHECKING:
    from seismass.campaign.folder import CampaignFolder
    from seismass.campaign.progress import Report
    from seismass.runs.batch import Progress

SCHEMA_VERSION: Final = 1
"""Version of the folder of a campaign; see docs/campaign.md."""
DEFAULT_PART_RUNS: Final = 65536
"""Runs of a part: some seconds of one core, and some megabytes."""
MOST_PART_RUNS: Final = 2**24
"""Most runs of a part, whose rows are held in memory."""


@dataclass(frozen=True, eq=False)
class Campaign:
    """The runs of a grid under motions, which become a folder of Parquet files.

    Runs are numbered as in the table of `simulate_many`: every scene under every motion, the motion changing fastest,
    or one run per scene where the grid has a column of motions. Part p holds runs (p - 1) part_runs + 1 to p part_runs,
    whatever solves it.

    Parameters
    ----------
    grid : Grid
        The scenes.
    motions : Motion, Record or iterable of them
        The motions.
    name : str
        What it is called; changes no result.
    part_runs : int, default 65536
        Runs of a part, at most 2^24. A worker holds one part in memory, and a lost worker loses one.
    peaks_only : bool, default False
        A run may end once no peak can be beaten any more; there are no residuals then.
    columns : list of str, optional
        Columns of `simulate_many` that are kept, beside `scene`, `motion` and `status`; default all.
    single : bool, default False
        Store numbers in single precision: half the size, seven digits.

    Attributes
    ----------
    total : int
        Number of runs.
    parts : int
        Number of parts.
    sha256 : str
        Digest of all that the numbers in the parts depend on, and of their cut.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be.

    Examples
    --------
    >>> from tempfile import mkdtemp
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
    >>> grid = sm.Grid.product(building, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2, 0.3, 0.4, 0.5])
    >>> campaign = sm.campaign.Campaign(grid, sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1), part_runs=4)
    >>> campaign.total, campaign.parts
    (10, 3)
    >>> folder = campaign.run(mkdtemp())
    >>> folder.scan().filter(mass_ratio=1.0).select("mu_s", "slips").collect().height
    5
    """

    grid: Grid
    motions: tuple[NamedMotion, ...]
    name: str
    part_runs: int
    peaks_only: bool
    columns: tuple[str, ...]
    single: bool

    def __init__(
        self,
        grid: Grid,
        motions: MotionLike | Iterable[MotionLike],
        *,
        name: str = "",
        part_runs: int = DEFAULT_PART_RUNS,
        peaks_only: bool = False,
        columns: Iterable[str] | None = None,
        single: bool = False,
    ) -> None:
        if not isinstance(grid, Grid):
            raise refusal(InvalidOption, "grid", "campaign", "a Grid", brief(grid))
        if not isinstance(name, str):
            raise refusal(InvalidOption, "name", "campaign", "text", brief(name))
        size = as_count(part_runs, "part_runs", "campaign", InvalidOption, least=1)
        if size > MOST_PART_RUNS:
            raise refusal(InvalidOption, "part_runs", "campaign", f"at most {MOST_PART_RUNS}", str(size))
        given, found, names = checked_motions(motions)
        if not found:
            raise refusal(InvalidOption, "motions", "campaign", "at least one", "none")
        grid._check_motions(len(found))
        values = {
            "grid": grid,
            "motions": named_motions(given, found, names),
            "name": printable(name),
            "part_runs": size,
            "peaks_only": bool(peaks_only),
            "columns": chosen_columns(columns, bool(peaks_only)),
            "single": bool(single),
        }
        for key, value in values.items():
            object.__setattr__(self, key, value)

    @cached_property
    def total(self) -> int:
        """Number of runs."""
        return self.grid._runs_under(len(self.motions))

    @property
    def parts(self) -> int:
        """Number of parts."""
        return -(-self.total // self.part_runs)

    def runs_of(self, part: int) -> range:
        """Return the numbers of the runs of a part, both counted from 1.

        Raises
        ------
        InvalidOption
            There is no such part.
        """
        number = as_count(part, "part", "campaign", InvalidOption, least=1)
        if number > self.parts:
            raise refusal(InvalidOption, "part", "campaign", f"from 1 to {self.parts}", str(number))
        first = (number - 1) * self.part_runs + 1
        return range(first, min(first + self.part_runs, self.total + 1))

    def solve(self, part: int, *, threads: int | None = None, progress: Progress | None = None) -> pl.DataFrame:
        """Return the rows of a part.

        Parameters
        ----------
        part : int
            Number of the part, from 1.
        threads, progress
            As for `simulate_many`; the progress is that of the part.

        Raises
        ------
        InvalidOption
            There is no such part.
        KeyboardInterrupt
            Ctrl-C was pressed.
        """
        from seismass.runs.batch import stream_many

        frames = stream_many(
            self.grid,
            self.motions,
            runs=self.runs_of(part),
            peaks_only=self.peaks_only,
            threads=threads,
            progress=progress,
        )
        # Rows of a chunk are cut to the columns before the next one is solved.
        return pl.concat([stored(frame, self.columns, self.single) for frame in frames])

    @cached_property
    def document(self) -> dict[str, Any]:
        """Everything but the samples and the values of axes, for JSON."""
        return {
            "grid": grid_document(self.grid),
            "part_runs": self.part_runs,
            "peaks_only": self.peaks_only,
            "columns": list(self.columns),
            "single": self.single,
        }

    @cached_property
    def axes(self) -> pl.DataFrame:
        """The values of all axes of the grid: `axis`, `number` within it from 1, and a column for each that varies."""
        return axes_table(self.grid.axes())

    @cached_property
    def sha256(self) -> str:
        """Digest of all that the numbers in the parts depend on, and of their cut."""
        digest = hashlib.sha256(json.dumps([SCHEMA_VERSION, _kernel.VERSION, self.document], sort_keys=True).encode())
        for axis in self.grid.axes():
            for name, values in axis.columns.items():
                digest.update(f"{axis.name} {name} {values.shape}".encode())
                digest.update(np.ascontiguousarray(values).tobytes())
        for motion in self.motions:
            digest.update(motion.sha256.encode())
        return digest.hexdigest()

    def run(
        self,
        folder: str | os.PathLike[str],
        *,
        executor: Executor | None = None,
        workers: int | None = None,
        scheduler: str | None = None,
        shard: tuple[int, int] | None = None,
        threads: int | None = None,
        progress: Report | None = None,
    ) -> CampaignFolder:
        """Solve what is missing in a folder; a new one is made where there is none.

        Parameters
        ----------
        folder : path-like
            Folder of the campaign: a new or empty one, or one that this campaign has begun. On a cluster it must be
            reached by all workers under this name.
        executor : concurrent.futures.Executor, optional
            Where parts are solved, as `dask.distributed.Client.get_executor()` or a ProcessPoolExecutor of started
            ("spawn") processes; by default the threads of this process.
        workers : int, optional
            Instead: start so many worker processes on this machine, by dask.distributed (`pip install
            "seismass[cluster]"`).
        scheduler : str, optional
            Instead: address of a running dask scheduler.
        shard : tuple of int, optional
            (i, n): solve part i, i + n, i + 2 n, ... alone, as one of n jobs of an array that share the folder.
        threads : int, optional
            Threads of the kernel: by default all cores in this process, and one in each task of an executor.
        progress : callable, optional
            Called with a `CampaignProgress`, at most some times a second.

        Returns
        -------
        CampaignFolder
            The folder.

        Raises
        ------
        InvalidOption
            The folder belongs to other inputs, another version or another instruction set, or has other files.
        MissingPackage
            dask.distributed is needed and not installed.
        SimulationError
            The executor lost its workers.
        OSError
            The folder cannot be written, or the disk is full. Parts that are there stay as they are.
        KeyboardInterrupt
            Ctrl-C was pressed. The same call goes on where it stopped.
        """
        from seismass.campaign.engine import run_campaign
        from seismass.campaign.prepare import prepared

        place = prepared(self, as_path(folder, "campaign", InvalidOption))
        run_campaign(
            self,
            place.path,
            executor=executor,
            workers=workers,
            scheduler=scheduler,
            shard=shard,
            threads=threads,
            progress=progress,
        )
        return place

    def __repr__(self) -> str:
        name = f"{self.name}: " if self.name else ""
        motions = f"{len(self.motions)} motion{'s' * (len(self.motions) != 1)}"
        return f"Campaign({name}{len(self.grid)} scenes, {motions}, {self.total} runs in {self.parts} parts)"
