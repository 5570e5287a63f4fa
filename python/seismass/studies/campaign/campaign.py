"""A campaign: scenes, motions, columns and values of its runs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any, Final

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.base.arguments import ProgressLike, is_one_of
from seismass.base.distributions import beta, lognormal
from seismass.base.errors import InvalidCampaignFile, InvalidOption
from seismass.base.input_table import Table
from seismass.base.stored_results import inputs_digest
from seismass.base.values import FieldValue, as_count, as_flag, as_list, as_name, as_number, brief, printable, refusal
from seismass.motions.motion import Motion, MotionLike
from seismass.runs.batch import checked_motions, stream_many
from seismass.runs.batch_tables import PER_BLOCK, PER_STOREY
from seismass.runs.grid.content import axes_table, grid_document
from seismass.runs.grid.grid import Grid
from seismass.runs.quantities import unit_of

KEYS: Final = ("scene", "motion", "status")
"""Columns that every part has: the numbers of scene and motion, from 1, and how the run ended."""

_COLUMNS: Final = (
    *KEYS,
    *("reason", "end_time", "collapsed_storey", *PER_STOREY, "peak_base_shear"),
    *(*PER_BLOCK, "events", "yields", "slips"),
)
UNITS: Final[Mapping[str, str]] = MappingProxyType({name: unit_of(name) for name in _COLUMNS})
"""Unit of each column that a part may have; empty for what has none. Lists are per storey or per block."""

RESIDUALS: Final = ("residual_drift", "residual_slip")
"""Columns that runs of peaks only do not have."""


def stored_columns(columns: Iterable[str] | None, peaks_only: bool) -> tuple[str, ...]:
    """Return the columns of parts, in order; unknown ones are refused, and those that runs of peaks alone lack."""
    known = [name for name in UNITS if not (peaks_only and name in RESIDUALS)]
    if columns is None:
        return tuple(known)
    wanted = as_list(columns, "columns", "campaign", InvalidOption, "a list of names")
    for name in wanted:
        if not is_one_of(name, known):
            note = " (left out where peaks_only is chosen)" if is_one_of(name, RESIDUALS) else ""
            raise refusal(InvalidOption, "columns", "campaign", f"some of {', '.join(known)}{note}", brief(name))
    return tuple(name for name in known if name in wanted or name in KEYS)


def stored(frame: pl.DataFrame, columns: tuple[str, ...], single: bool) -> pl.DataFrame:
    """Return the columns of rows of `simulate_many`, in single precision where that is chosen."""
    rows = frame.select(columns)
    if not single:
        return rows
    shorter: dict[pl.DataType, Any] = {pl.Float64(): pl.Float32, pl.List(pl.Float64): pl.List(pl.Float32)}
    return rows.cast({name: shorter[dtype] for name, dtype in rows.schema.items() if dtype in shorter})


@dataclass(frozen=True)
class NamedMotion:
    """A motion with a name and its origin.

    Attributes
    ----------
    name : str
        Its name in tables.
    motion : Motion
        The samples.
    file : str or None
        File that it was read from.
    synthetic : bool or None
        Whether it was computed and not recorded; None where that is not known.
    """

    name: str
    motion: Motion
    file: str | None = None
    synthetic: bool | None = None

    @property
    def sha256(self) -> str:
        """Digest of the time step and the samples."""
        return inputs_digest(self.motion)


def named_motions(items: list[Any], motions: list[Motion], names: list[str]) -> tuple[NamedMotion, ...]:
    """Return motions with the names and the origin that what was given has."""
    named = []
    for item, motion, name in zip(items, motions, names, strict=True):
        if isinstance(item, NamedMotion):
            named.append(item)
            continue
        source = getattr(item, "source", None)
        file = None if source is None else printable(source.name)
        named.append(NamedMotion(name, motion, file, getattr(item, "synthetic", None)))
    return tuple(named)


def motions_table(motions: tuple[NamedMotion, ...]) -> pl.DataFrame:
    """Return one row per motion: number, name, origin, time step, peak, digest, samples (m/s2)."""
    samples = pl.List(pl.Float64)
    return pl.DataFrame(
        {
            "motion": pl.Series(range(1, len(motions) + 1), dtype=pl.UInt32),
            "record": pl.Series([item.name for item in motions], dtype=pl.String),
            "file": pl.Series([item.file for item in motions], dtype=pl.String),
            "synthetic": pl.Series([item.synthetic for item in motions], dtype=pl.Boolean),
            "samples": pl.Series([item.motion.samples for item in motions], dtype=pl.UInt32),
            "dt": pl.Series([item.motion.dt for item in motions], dtype=pl.Float64),
            "pga_g": pl.Series([item.motion.pga_g for item in motions], dtype=pl.Float64),
            "sha256": pl.Series([item.sha256 for item in motions], dtype=pl.String),
            "acceleration": pl.Series([item.motion.acceleration.tolist() for item in motions], dtype=samples),
            "vertical": pl.Series(
                [None if (up := item.motion.vertical) is None else up.tolist() for item in motions], dtype=samples
            ),
        }
    )


def motions_of(table: pl.DataFrame) -> tuple[NamedMotion, ...]:
    """Return the motions of a table."""
    motions = []
    for row in table.iter_rows(named=True):
        vertical = None if row["vertical"] is None else np.array(row["vertical"])
        motion = Motion(np.array(row["acceleration"]), row["dt"], vertical)
        motions.append(NamedMotion(row["record"], motion, row["file"], row["synthetic"]))
    return tuple(motions)


SCHEMA_VERSION: Final = 3
"""Version of the folder of a campaign; see docs/campaign.md."""
DEFAULT_PART_RUNS: Final = 65536
"""Runs of a part: some seconds of one core, and some megabytes."""
MOST_PART_RUNS: Final = 2**24
"""Most runs of a part, whose rows are held in memory."""


@dataclass(frozen=True, eq=False, repr=False)
class CampaignRuns(FieldValue):
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
        items, checked, names = checked_motions(motions)
        if not checked:
            raise refusal(InvalidOption, "motions", "campaign", "at least one", "none")
        grid._check_motions(len(checked))
        flags = {
            name: as_flag(value, name, "campaign", InvalidOption)
            for name, value in (("peaks_only", peaks_only), ("single", single))
        }
        values = {
            "grid": grid,
            "motions": named_motions(items, checked, names),
            "name": as_name(name, "name", "campaign", InvalidOption),
            "part_runs": size,
            "columns": stored_columns(columns, flags["peaks_only"]),
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

    def solve(self, part: int, *, threads: int | None = None, progress: ProgressLike = None) -> pl.DataFrame:
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

    def solve_runs(self, runs: range, *, threads: int | None = None, progress: ProgressLike = None) -> pl.DataFrame:
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


MOST_VALUES: Final = 2**24
"""Most values of a range, which are in memory."""
_RANGE: Final = ("from", "to", "count", "spacing")


def axis_values(table: Table, key: str, *, sampled: bool) -> Any:
    """Return what a key of the table `grid` says: numbers, those of a range, or, where `sampled`, a distribution."""
    value = table.values[key]
    if isinstance(value, dict):
        return _of_table(table.table(key), sampled)
    if isinstance(value, list) and any(isinstance(item, dict) for item in value):
        return [_of_table(item, sampled) for item in table.tables(key)]
    return value


def _of_table(table: Table, sampled: bool) -> Any:
    if "distribution" not in table.values:
        return _range(table)
    if not sampled:
        table.refuse("distribution", "left out where there is no table `sample`", brief(table.values["distribution"]))
    return _distribution(table)


def _range(table: Table) -> Any:
    """Numbers from one to another, both included."""
    table.known(_RANGE)
    for key in _RANGE[:3]:
        table.needed(key)
    first, last = (table.number(key, 0.0) for key in _RANGE[:2])
    count = table.count("count", least=1)
    if count > MOST_VALUES:
        table.refuse("count", f"at most {MOST_VALUES}", str(count))
    spacing = table.choice("spacing", ("linear", "log"), "linear", requirement="linear or log")
    if spacing == "linear":
        return np.linspace(first, last, count)
    for key, end in (("from", first), ("to", last)):
        if not end > 0.0:
            table.refuse(key, "positive where the spacing is log", f"{end:g}")
    return np.geomspace(first, last, count)


def _distribution(table: Table) -> Any:
    """A frozen distribution, by the parameters that people state or by those of scipy.stats."""
    from scipy import stats  # slow to import

    name = table.text("distribution")
    numbers = {key: table.number(key, 0.0) for key in table.values if key != "distribution"}
    stated: dict[str, tuple[str, str]] = {
        "lognormal": ("median", "sigma"),
        "normal": ("mean", "deviation"),
        "beta": ("mean", "deviation"),
        "uniform": ("low", "high"),
    }
    if name in stated and set(numbers) == set(stated[name]):
        first, second = (numbers[key] for key in stated[name])
        try:
            if name == "lognormal":
                return lognormal(first, second)
            if name == "beta":
                return beta(first, second)
        except InvalidOption as error:
            table.refuse("distribution", "one that exists", str(error))
        if name == "normal":
            _positive(table, "deviation", second)
            return stats.norm(loc=first, scale=second)
        _positive(table, "high - low", second - first)
        return stats.uniform(loc=first, scale=second - first)
    family = getattr(stats, name, None)
    if not isinstance(family, stats.rv_continuous):
        words = ", ".join(f"{known} ({', '.join(keys)})" for known, keys in stated.items())
        table.refuse("distribution", f"{words}, or a continuous one of scipy.stats by its own parameters", brief(name))
    try:
        frozen = family(**numbers)
        usable = bool(np.isfinite(frozen.ppf(0.5)))
    except TypeError as error:
        table.refuse("distribution", f"given with the parameters of scipy.stats.{name}", str(error))
    if not usable:
        table.refuse("distribution", f"given with parameters that scipy.stats.{name} allows", brief(numbers))
    return frozen


def _positive(table: Table, what: str, value: float) -> None:
    if not value > 0.0:
        table.refuse(what, "positive", f"{as_number(value, what, table.file, InvalidCampaignFile):g}")
