"""A campaign: the runs of a grid under motions, cut into parts of fixed content."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import polars as pl

from seismass import _kernel
from seismass.base.digest import inputs_digest
from seismass.base.errors import InvalidOption
from seismass.base.values import as_count, as_flag, as_name, brief, content_hash, refusal, same_content
from seismass.campaign.columns import chosen_columns, stored
from seismass.campaign.motions import NamedMotion, named_motions
from seismass.model.motion import MotionLike
from seismass.runs.batch import Progress, checked_motions, stream_many
from seismass.runs.grid.content import axes_table, grid_document
from seismass.runs.grid.grid import Grid

SCHEMA_VERSION: Final = 3
"""Version of the folder of a campaign; see docs/campaign.md."""
DEFAULT_PART_RUNS: Final = 65536
"""Runs of a part: some seconds of one core, and some megabytes."""
MOST_PART_RUNS: Final = 2**24
"""Most runs of a part, whose rows are held in memory."""


@dataclass(frozen=True, eq=False, repr=False)
class CampaignRuns:
    """The runs of a grid under motions, and what solves a part of them.

    Arguments and attributes are those of `Campaign`, which writes the parts to a folder.
    """

    grid: Grid
    motions: tuple[NamedMotion, ...]
    name: str
    part_runs: int
    peaks_only: bool
    columns: tuple[str, ...]
    single: bool

    __eq__ = same_content
    __hash__ = content_hash

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
        size = as_count(part_runs, "part_runs", "campaign", InvalidOption, least=1)
        if size > MOST_PART_RUNS:
            raise refusal(InvalidOption, "part_runs", "campaign", f"at most {MOST_PART_RUNS}", str(size))
        given, found, names = checked_motions(motions)
        if not found:
            raise refusal(InvalidOption, "motions", "campaign", "at least one", "none")
        grid._check_motions(len(found))
        flags = {
            name: as_flag(value, name, "campaign", InvalidOption)
            for name, value in (("peaks_only", peaks_only), ("single", single))
        }
        values = {
            "grid": grid,
            "motions": named_motions(given, found, names),
            "name": as_name(name, "name", "campaign", InvalidOption),
            "part_runs": size,
            "columns": chosen_columns(columns, flags["peaks_only"]),
            **flags,
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
        return self.solve_runs(self.runs_of(part), threads=threads, progress=progress)

    def solve_runs(self, runs: range, *, threads: int | None = None, progress: Progress | None = None) -> pl.DataFrame:
        """Return the rows of runs by their numbers, from 1; arguments and errors are those of `solve`."""
        frames = stream_many(
            self.grid,
            self.motions,
            runs=runs,
            peaks_only=self.peaks_only,
            threads=threads,
            progress=progress,
        )
        # Rows of a chunk are cut to the columns before the next one is solved.
        return pl.concat([stored(frame, self.columns, self.single) for frame in frames])

    @property
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
        axes = [(axis.name, axis.columns) for axis in self.grid.axes()]
        motions = [motion.motion for motion in self.motions]
        return inputs_digest(SCHEMA_VERSION, _kernel.VERSION, self.document, axes, motions)

    def __repr__(self) -> str:
        name = f"{self.name}: " if self.name else ""
        motions = f"{len(self.motions)} motion{'s' * (len(self.motions) != 1)}"
        return (
            f"{type(self).__name__}({name}{len(self.grid)} scenes, {motions}, {self.total} runs in {self.parts} parts)"
        )
