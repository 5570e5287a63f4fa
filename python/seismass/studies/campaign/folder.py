"""The folder of a campaign: read by workers, by those who go on where it stopped, and by those who analyse it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from copy import deepcopy
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import polars as pl

from seismass.base.errors import InvalidCampaignFile, InvalidOption
from seismass.base.files import data_directory
from seismass.base.input_table import CAMPAIGN_FILE, Table, load_table, refuse_other_kind
from seismass.base.values import as_flag, as_path, brief, refusal
from seismass.base.views import Card
from seismass.motions.motion import scaled_motions
from seismass.motions.records import Record, Suite, builtin_suite, read_suite
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.grid.grid import Grid
from seismass.runs.grid.sample import SAMPLED
from seismass.runs.scene_file import building_of_table
from seismass.studies.campaign.campaign import KEYS, CampaignRuns, axis_values
from seismass.studies.campaign.engine import Report, check_parts, prepare, rows_and_problem, run_campaign
from seismass.studies.campaign.manifest import (
    AXES,
    MOTIONS,
    Present,
    campaign_in,
    part_path,
    parts_present,
    read_manifest,
    read_table,
)

_JOINED: Final = ("record", "dt", "pga_g")
"""What `scan` takes from the table of motions."""


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Campaign(CampaignRuns, Card):
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
        place = as_path(folder, "campaign", InvalidOption)
        prepare(self, place)
        run_campaign(
            self,
            place,
            executor=executor,
            workers=workers,
            scheduler=scheduler,
            shard=shard,
            threads=threads,
            progress=progress,
        )
        return CampaignFolder(place)


@dataclass(frozen=True)
class CampaignFolder(Card):
    """The folder of a campaign, whole or begun.

    Parameters
    ----------
    path : path-like
        The folder.

    Attributes
    ----------
    manifest : dict
        What is in it: versions, digest of the inputs, counts, units, axes.
    parts : int
        Number of parts of the campaign.

    Raises
    ------
    InvalidOption
        It is not a folder of a campaign.
    """

    path: Path

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", as_path(self.path, "campaign", InvalidOption))
        _ = self._manifest

    @property
    def manifest(self) -> dict[str, Any]:
        """What is in the folder, as a copy that changes nothing."""
        return deepcopy(self._manifest)

    @cached_property
    def _manifest(self) -> dict[str, Any]:
        return read_manifest(self.path)

    @property
    def parts(self) -> int:
        """Number of parts of the campaign."""
        return int(self._manifest["parts"])

    def _there(self) -> Present:
        return parts_present(self.path, self.parts)

    def present(self) -> set[int]:
        """Return the numbers of the parts that are there as files, from 1."""
        return self._there().files

    def strange(self) -> set[int]:
        """Return the numbers of parts whose name a folder, a link or a pipe has."""
        return self._there().others

    def missing(self) -> Iterator[int]:
        """Yield the numbers of the parts that are not there."""
        present = self.present()
        return (part for part in range(1, self.parts + 1) if part not in present)

    @property
    def complete(self) -> bool:
        """Whether all parts are there."""
        return len(self.present()) == self.parts

    @property
    def runs_present(self) -> int:
        """Number of runs of the parts that are there."""
        size, total = int(self._manifest["part_runs"]), int(self._manifest["runs"])
        present = self.present()
        last = self.parts in present
        return len(present) * size - (last * (self.parts * size - total))

    @property
    def bytes(self) -> int:
        """Size of the parts that are there."""
        return self._there().bytes

    @cached_property
    def campaign(self) -> Campaign:
        """The campaign, made again from the folder.

        Raises
        ------
        InvalidOption
            The files of the folder do not belong together.
        """
        return campaign_in(self.path, Campaign)

    @cached_property
    def axes(self) -> pl.DataFrame:
        """The values of the axes: `axis`, `number` within it from 1, and a column for each that varies."""
        return read_table(self.path, AXES)

    @cached_property
    def motions(self) -> pl.DataFrame:
        """One row per motion: number, name, file, time step, peak (g), digest of the samples."""
        return read_table(self.path, MOTIONS).drop("acceleration", "vertical")

    @cached_property
    def _compared(self) -> dict[int, tuple[int, int, int]]:
        """Parts whose digests were compared, with number, size and time of their files."""
        return {}

    def scan_parts(self, *, force: bool = False) -> pl.LazyFrame:
        """Return the rows of the parts that are there as they are stored, as a lazy frame.

        Parameters
        ----------
        force : bool, optional
            Take parts as they are, without comparing them with their digests; by default each is read once for that.

        Raises
        ------
        InvalidOption
            No part is there, or one is not as it was written.
        """
        there = self._there()
        present = sorted(there.files)
        if not present:
            raise refusal(InvalidOption, f"folder {self.path}", "campaign", "one with at least one part", "none")
        if not as_flag(force, "force", "campaign", InvalidOption):
            status = {part: part_path(self.path, part).lstat() for part in present}
            states = {part: (each.st_ino, each.st_size, each.st_mtime_ns) for part, each in status.items()}
            new = [part for part in present if self._compared.get(part) != states[part]]
            check_parts(self.path, self._manifest["inputs_sha256"], sorted({*new, *there.others}))
            self._compared.update((part, states[part]) for part in new)
        return pl.scan_parquet([part_path(self.path, part) for part in present], glob=False)

    def scan(self, *, force: bool = False) -> pl.LazyFrame:
        """Return the rows of the parts that are there, with the axes and the motions joined to them, as a lazy frame.

        Parameters
        ----------
        force : bool, optional
            Take parts as they are, without comparing them with their digests; by default each is read once for that.

        Returns
        -------
        polars.LazyFrame
            One row per run, in their order: `scene`, `motion`, `record`, `dt`, `pga_g` of the motion, what varies over
            the scenes, by the names of `Grid.table`, then the columns of `simulate_many` that were kept.

        Raises
        ------
        InvalidOption
            No part is there, or one is not as it was written.
        """
        rows = self.scan_parts(force=force)
        results = [name for name in self._manifest["columns"] if name not in KEYS[:2]]
        joined: list[str] = []
        for axis in self._manifest["grid"]["axes"]:
            names = [name for name in axis["columns"] if name != "motion"]
            values = self.axes.lazy().filter(pl.col("axis") == axis["name"]).select("number", *names)
            joined += names
            if axis["length"] == 1:
                rows = rows.join(values.drop("number"), how="cross", maintain_order="left")
                continue
            number = (pl.col("scene") - 1) // axis["each"] % axis["length"] + 1
            rows = rows.with_columns(number.cast(pl.UInt64).alias("number")).join(
                values, on="number", how="left", maintain_order="left"
            )
        motions = self.motions.lazy().select("motion", *_JOINED)
        rows = rows.join(motions, on="motion", how="left", maintain_order="left")
        return rows.select("scene", "motion", *_JOINED, *joined, *results)

    def run(
        self,
        *,
        executor: Executor | None = None,
        workers: int | None = None,
        scheduler: str | None = None,
        shard: tuple[int, int] | None = None,
        threads: int | None = None,
        progress: Report | None = None,
    ) -> CampaignFolder:
        """Solve what is missing; the parameters and errors are those of `Campaign.run`."""
        return self.campaign.run(
            self.path,
            executor=executor,
            workers=workers,
            scheduler=scheduler,
            shard=shard,
            threads=threads,
            progress=progress,
        )

    def verify(self) -> pl.DataFrame:
        """Read every part that is there and compare it with its digest and with what it must hold.

        Returns
        -------
        polars.DataFrame
            One row per part: `part`, `present`, `rows`, `bytes`, `problem` (null where there is none).

        Raises
        ------
        InvalidOption
            Manifest, axes or motions are not as they were written.
        """
        campaign = self.campaign
        rows: list[tuple[int, bool, int | None, int | None, str | None]] = []
        there = self._there()
        for part in range(1, self.parts + 1):
            if part not in there.files and part not in there.others:
                rows.append((part, False, None, None, None))
                continue
            height, problem = rows_and_problem(self.path, campaign, part)
            rows.append((part, True, height, part_path(self.path, part).lstat().st_size, problem))
        schema = {"part": pl.UInt64, "present": pl.Boolean, "rows": pl.UInt64, "bytes": pl.UInt64, "problem": pl.String}
        return pl.DataFrame(rows, schema=schema, orient="row")

    def __repr__(self) -> str:
        return f"CampaignFolder({self.path}, {len(self.present())} of {self.parts} parts)"


SCALINGS: Final = ("none", "asce7-10", "asce7-16")
"""How a campaign file may scale its motions."""

_SETTINGS: Final = ("floors", "roof", "damping", "attached_of", "collapse_drift")
TABLES: Final = {
    "": ("name", "note", "part_runs", "peaks_only", "columns", "single", "motions", "building", "grid", "sample"),
    "motions": ("builtin", "records", "scaling", "target", "period"),
    "grid": (*SAMPLED, *_SETTINGS, "design"),
    "grid.design": ("target", "share", "elastic_at_one", "combination"),
    "sample": ("samples", "method", "seed", "one_motion"),
}
"""Keys of each table of a campaign file, the file itself first; `building` has those of a scene file."""


def example_description() -> Path:
    """Return the campaign file that ships with the package: friction, goods and intensity of a warehouse."""
    return data_directory() / "examples" / "campaign.toml"


def read_campaign(source: str | os.PathLike[str] | Mapping[str, Any]) -> Campaign:
    """Read a campaign file.

    Parameters
    ----------
    source : path-like or mapping
        A .toml or .json file with the keys of docs/campaign.md, or its tables as a dict. Paths in it are relative to
        its folder.

    Raises
    ------
    InvalidCampaignFile
        The file cannot be read, or has an unknown, missing or contradicting key.
    InvalidScene, InvalidMotion, InvalidOption
        A value is not what it must be.
    RecordFormatError
        Motions that it names cannot be read.

    Examples
    --------
    >>> import seismass as sm
    >>> campaign = sm.campaign.read_campaign({
    ...     "motions": {"builtin": "seven"},
    ...     "building": {"storeys": 2, "period": 0.3, "yield_shear_over_weight": [0.2, 0.12]},
    ...     "grid": {"mass_ratio": [0.5, 1.0], "mu": {"from": 0.1, "to": 0.5, "count": 5}, "scale": [0.5, 1.0]},
    ... })
    >>> campaign.total
    140
    """
    if isinstance(source, Mapping):
        folder, top = Path(), Table(dict(source), "", "campaign", InvalidCampaignFile)
    else:
        path = as_path(source, "campaign file", InvalidCampaignFile)
        folder, top = path.parent, load_table(path, "campaign file", InvalidCampaignFile)
    refuse_other_kind(top, CAMPAIGN_FILE)
    top.known(TABLES[""])
    top.text("note")
    top.needed("grid")
    suite = _suite(top.table("motions") if "motions" in top.values else None, folder, top)
    options: dict[str, Any] = {name: top.flag(name, False) for name in ("peaks_only", "single") if name in top.values}
    columns = top.values.get("columns")
    if columns is not None and not (isinstance(columns, list) and all(isinstance(name, str) for name in columns)):
        top.refuse("columns", "a list of names", brief(columns))
    if "part_runs" in top.values:
        options["part_runs"] = top.count("part_runs")
    grid = _grid(top, folder, len(suite))
    return Campaign(grid, suite, name=top.text("name"), columns=columns, **options)


def _suite(table: Table | None, folder: Path, top: Table) -> list[Record]:
    """The motions, scaled."""
    from seismass.design.scaling import scale_asce7_10, scale_asce7_16

    if table is None:
        top.refuse("motions", "given, with builtin or records", "nothing")
    table.known(TABLES["motions"])
    table.needed("builtin", "records")
    table.excluded("records", "builtin")
    suite: Suite
    if "builtin" in table.values:
        name = table.choice("builtin", ("seven", "eleven"), requirement="seven or eleven")
        suite = builtin_suite("seven" if name == "seven" else "eleven")
    else:
        suite = read_suite(folder / table.text("records"))
    scaling = table.choice("scaling", SCALINGS, SCALINGS[0])
    if scaling == "none":
        table.left_out(("target", "period"), f"{table.key('scaling')} is none")
        return list(suite)
    target = _target(table, folder) if "target" in table.values else TargetSpectrum.asce7()
    scale = scale_asce7_10 if scaling == "asce7-10" else scale_asce7_16
    factors = scale(suite, target, table.number("period", 1.0)).factors
    return scaled_motions(suite, factors)


def _target(table: Table, folder: Path) -> TargetSpectrum:
    from seismass.motions.scaling.suite import target_of
    from seismass.motions.spectra.tables import file_and_words

    text = table.text("target")
    file, words = file_and_words(text, folder)
    return TargetSpectrum.from_csv(file, **words) if file.is_file() else target_of(text)


def _grid(top: Table, folder: Path, motions: int) -> Grid:
    table = top.table("grid")
    table.known(TABLES["grid"])
    building = None
    if "building" in top.values:
        table.excluded("storeys", "building")
        if "storeys" in table.values:
            table.refuse("storeys", "left out where building is given", "both")
        building = building_of_table(top.table("building"))
    elif "storeys" not in table.values:
        table.refuse("storeys", "given, or building", "nothing")
    sampled = "sample" in top.values
    values: dict[str, Any] = {key: axis_values(table, key, sampled=sampled) for key in SAMPLED if key in table.values}
    values |= table.subset(*_SETTINGS)
    if "design" in table.values:
        values["design"] = _design(table.table("design"), folder)
    if not sampled:
        return Grid.product(building, **values)
    sample = top.table("sample")
    sample.known(TABLES["sample"])
    sample.needed("samples")
    options: dict[str, Any] = {"samples": sample.count("samples")}
    if "method" in sample.values:
        options["method"] = sample.text("method")
    if "seed" in sample.values:
        options["seed"] = sample.count("seed")
    if sample.flag("one_motion", False):
        options["motions"] = motions
    return Grid.sample(building, **options, **values)


def _design(table: Table, folder: Path) -> Any:
    from seismass.runs.grid.sample import StrengthDesign

    table.known(TABLES["grid.design"])
    table.needed("target")
    return StrengthDesign(_target(table, folder), **table.subset(*TABLES["grid.design"][1:]))
