"""The folder of a campaign: read by workers, by those who go on where it stopped, and by those who analyse it."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import as_path, refusal
from seismass.campaign.campaign import Campaign
from seismass.campaign.columns import KEYS
from seismass.campaign.manifest import check_same, manifest_of, read_manifest
from seismass.campaign.motions import motions_of
from seismass.runs.grid.content import grid_of

if TYPE_CHECKING:
    from seismass.campaign.progress import Report

AXES: Final = "axes.parquet"
MOTIONS: Final = "motions.parquet"
PARTS: Final = "parts"
_PART = re.compile(r"part-(\d{7,})\.parquet")
_JOINED: Final = ("record", "dt", "pga_g")
"""What `scan` takes from the table of motions."""


def part_path(folder: Path, part: int) -> Path:
    """Return the path of a part, by its number from 1."""
    return folder / PARTS / f"part-{part:07d}.parquet"


@dataclass(frozen=True)
class CampaignFolder:
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
        It is no folder of a campaign.
    """

    path: Path

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", as_path(self.path, "campaign", InvalidOption))
        _ = self.manifest

    @cached_property
    def manifest(self) -> dict[str, Any]:
        """What is in the folder."""
        return read_manifest(self.path)

    @property
    def parts(self) -> int:
        """Number of parts of the campaign."""
        return int(self.manifest["parts"])

    def present(self) -> set[int]:
        """Return the numbers of the parts that are there, from 1."""
        found = set()
        with os.scandir(self.path / PARTS) as entries:
            for entry in entries:
                named = _PART.fullmatch(entry.name)
                if named and 1 <= int(named[1]) <= self.parts:
                    found.add(int(named[1]))
        return found

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
        size, total = int(self.manifest["part_runs"]), int(self.manifest["runs"])
        present = self.present()
        last = self.parts in present
        return len(present) * size - (last * (self.parts * size - total))

    @property
    def bytes(self) -> int:
        """Size of the parts that are there."""
        with os.scandir(self.path / PARTS) as entries:
            return sum(entry.stat().st_size for entry in entries if _PART.fullmatch(entry.name))

    @cached_property
    def campaign(self) -> Campaign:
        """The campaign, made again from the folder.

        Raises
        ------
        InvalidOption
            The files of the folder do not belong together.
        """
        document, motions = self.manifest, motions_of(pl.read_parquet(self.path / MOTIONS, glob=False))
        found = Campaign(
            grid_of(document["grid"], self.axes),
            motions,
            name=document["name"],
            part_runs=document["part_runs"],
            peaks_only=document["peaks_only"],
            columns=document["columns"],
            single=document["single"],
        )
        check_same(document, manifest_of(found), self.path)
        return found

    @cached_property
    def axes(self) -> pl.DataFrame:
        """The values of the axes: `axis`, `number` within it from 1, and a column for each that varies."""
        return pl.read_parquet(self.path / AXES, glob=False)

    @cached_property
    def motions(self) -> pl.DataFrame:
        """One row per motion: number, name, file, time step, peak (g), digest of the samples."""
        return pl.read_parquet(self.path / MOTIONS, glob=False).drop("acceleration", "vertical")

    def scan_parts(self) -> pl.LazyFrame:
        """Return the rows of the parts that are there as they are stored, as a lazy frame.

        Raises
        ------
        InvalidOption
            No part is there.
        """
        present = sorted(self.present())
        if not present:
            raise refusal(InvalidOption, f"folder {self.path}", "campaign", "one with at least one part", "none")
        return pl.scan_parquet([part_path(self.path, part) for part in present], glob=False)

    def scan(self) -> pl.LazyFrame:
        """Return the rows of the parts that are there, with the axes and the motions joined to them, as a lazy frame.

        Returns
        -------
        polars.LazyFrame
            One row per run, in their order: `scene`, `motion`, `record`, `dt`, `pga_g` of the motion, what varies over
            the scenes, by the names of `Grid.table`, then the columns of `simulate_many` that were kept.

        Raises
        ------
        InvalidOption
            No part is there.
        """
        rows = self.scan_parts()
        results = [name for name in self.manifest["columns"] if name not in KEYS[:2]]
        joined: list[str] = []
        for axis in self.manifest["grid"]["axes"]:
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
        """Read every part that is there and compare it with what it must hold.

        Returns
        -------
        polars.DataFrame
            One row per part: `part`, `present`, `rows`, `bytes`, `problem` (null where there is none).
        """
        campaign = self.campaign
        rows: list[tuple[int, bool, int | None, int | None, str | None]] = []
        present = self.present()
        for part in range(1, self.parts + 1):
            path = part_path(self.path, part)
            if part not in present:
                rows.append((part, False, None, None, None))
                continue
            height, problem = _checked(path, campaign, part, self.manifest["inputs_sha256"])
            rows.append((part, True, height, path.stat().st_size, problem))
        schema = {"part": pl.UInt64, "present": pl.Boolean, "rows": pl.UInt64, "bytes": pl.UInt64, "problem": pl.String}
        return pl.DataFrame(rows, schema=schema, orient="row")

    def __repr__(self) -> str:
        return f"CampaignFolder({self.path}, {len(self.present())} of {self.parts} parts)"


def _checked(path: Path, campaign: Campaign, part: int, sha256: str) -> tuple[int | None, str | None]:
    """Number of rows of a part, and what is wrong with it."""
    runs = campaign.runs_of(part)
    try:
        frame = pl.read_parquet(path, glob=False)
        digest = pl.read_parquet_metadata(path).get("campaign")
    except (pl.exceptions.PolarsError, OSError) as error:
        return None, f"cannot be read: {error}"
    if digest != sha256:
        return frame.height, "of other inputs"
    if frame.height != len(runs) or frame.columns != list(campaign.columns):
        return frame.height, f"not the {len(runs)} rows of its runs"
    numbers = np.arange(runs.start - 1, runs.stop - 1)
    scene, motion = campaign.grid._scene_and_motion(numbers, len(campaign.motions))
    same = (frame["scene"].to_numpy() == scene + 1).all() and (frame["motion"].to_numpy() == motion + 1).all()
    return frame.height, None if same else "of other runs"
