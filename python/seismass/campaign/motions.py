"""The motions of a campaign as a table, from which workers and later sessions take the same samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import polars as pl

from seismass.base.digest import inputs_digest
from seismass.base.values import printable
from seismass.model.motion import Motion


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


def named_motions(given: list[Any], motions: list[Motion], names: list[str]) -> tuple[NamedMotion, ...]:
    """Return motions with the names and the origin that what was given has."""
    found = []
    for item, motion, name in zip(given, motions, names, strict=True):
        if isinstance(item, NamedMotion):
            found.append(item)
            continue
        source = getattr(item, "source", None)
        file = None if source is None else printable(source.name)
        found.append(NamedMotion(name, motion, file, getattr(item, "synthetic", None)))
    return tuple(found)


def motions_table(motions: tuple[NamedMotion, ...]) -> pl.DataFrame:
    """Return one row per motion: number, name, origin, time step, peak, digest, samples (m/s2)."""
    return pl.DataFrame(
        {
            "motion": np.arange(1, len(motions) + 1, dtype=np.uint32),
            "record": [item.name for item in motions],
            "file": [item.file for item in motions],
            "synthetic": [item.synthetic for item in motions],
            "samples": [item.motion.samples for item in motions],
            "dt": [item.motion.dt for item in motions],
            "pga_g": [item.motion.pga_g for item in motions],
            "sha256": [item.sha256 for item in motions],
            "acceleration": [item.motion.acceleration.tolist() for item in motions],
            "vertical": [None if item.motion.vertical is None else item.motion.vertical.tolist() for item in motions],
        },
        schema={
            "motion": pl.UInt32,
            "record": pl.String,
            "file": pl.String,
            "synthetic": pl.Boolean,
            "samples": pl.UInt32,
            "dt": pl.Float64,
            "pga_g": pl.Float64,
            "sha256": pl.String,
            "acceleration": pl.List(pl.Float64),
            "vertical": pl.List(pl.Float64),
        },
    )


def motions_of(table: pl.DataFrame) -> tuple[NamedMotion, ...]:
    """Return the motions of a table."""
    found = []
    for row in table.iter_rows(named=True):
        vertical = None if row["vertical"] is None else np.array(row["vertical"])
        motion = Motion(np.array(row["acceleration"]), row["dt"], vertical)
        found.append(NamedMotion(row["record"], motion, row["file"], row["synthetic"]))
    return tuple(found)
