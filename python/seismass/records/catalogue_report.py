"""What a search for the paper's seven records found: each file, each record, and what is missing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import polars as pl

from seismass.base.values import printable, short_repr
from seismass.base.views import Card
from seismass.records.catalogue import RECORDINGS, SUBSTITUTES, TERMS, Component, Recording, catalogue, how_to_get

Judged = Literal["header and content", "header", "content", "name"]


@dataclass(frozen=True)
class FoundFile:
    """A file that is, or says it is, one of the seven records or a substitute.

    Attributes
    ----------
    file : Path
        The file.
    recording : Recording
        What it is.
    component : Component, optional
        Which component of it; None for a direction that was not recorded, such as fault-normal.
    label : str
        Component as the file calls it.
    direction : {"horizontal", "vertical", "unknown"}
        Of the component.
    samples, dt, pga_g : int, float, float, optional
        Points, step (s) and peak (g) as read; None where it cannot be read. The step is None where no file states it.
    judged : {"header and content", "header", "content", "name"}
        By what; a file judged by its name alone is not counted.
    usable : bool
        Whether it can be read and is not judged by its name alone.
    remarks : tuple of str
        What differs from the file of NGA-West2, what readers said, or why it cannot be read.
    """

    file: Path
    recording: Recording
    component: Component | None
    label: str
    direction: Literal["horizontal", "vertical", "unknown"]
    samples: int | None
    dt: float | None
    pga_g: float | None
    judged: Judged
    usable: bool
    remarks: tuple[str, ...]


@dataclass(frozen=True)
class CatalogueSearch(Card):
    """Which of the seven records a folder holds.

    Attributes
    ----------
    folder : Path
        What was searched, with all that is below.
    files : tuple of FoundFile
        Files of the seven and of substitutes, by record and then by path.
    looked_at : int
        Number of files that were looked at.
    """

    folder: Path
    files: tuple[FoundFile, ...]
    looked_at: int

    __repr__ = short_repr

    def table(self) -> pl.DataFrame:
        """Return one row per file found: what it is, points, dt (s), PGA (g), by what it was judged, and remarks."""
        schema: dict[str, Any] = {
            "number": pl.UInt32,
            "record": pl.String,
            "rsn": pl.UInt32,
            "substitute": pl.Boolean,
            "file": pl.String,
            "component": pl.String,
            "direction": pl.String,
            "samples": pl.UInt32,
            "dt": pl.Float64,
            "pga_g": pl.Float64,
            "judged": pl.String,
            "usable": pl.Boolean,
            "remarks": pl.String,
        }
        rows = [
            {
                "number": one.recording.number,
                "record": f"{one.recording.event}, {one.recording.station}",
                "rsn": one.recording.rsn,
                "substitute": one.recording.substitute,
                "file": printable(str(one.file)),
                "component": one.label,
                "direction": one.direction,
                "samples": one.samples,
                "dt": one.dt,
                "pga_g": one.pga_g,
                "judged": one.judged,
                "usable": one.usable,
                "remarks": "; ".join(one.remarks),
            }
            for one in self.files
        ]
        return pl.DataFrame(rows, schema=schema)

    def summary(self) -> pl.DataFrame:
        """Return one row per record of the table: horizontals and verticals found, substitutes, how to get it."""
        paper = catalogue()
        rows = []
        for recording, line in zip(RECORDINGS, paper.iter_rows(named=True), strict=True):
            horizontals, verticals = self._count(recording, "horizontal"), self._count(recording, "vertical")
            stand_ins = [one for one in SUBSTITUTES if one.number == recording.number]
            found = [
                f"{one.station} (RSN{one.rsn}): {_horizontals(self._count(one, 'horizontal'))}"
                for one in stand_ins
                if self._count(one, "horizontal")
            ]
            rows.append(
                {
                    "number": recording.number,
                    "event": line["event"],
                    "station": line["station"],
                    "rsn": recording.rsn,
                    "horizontals": horizontals,
                    "verticals": verticals,
                    "complete": horizontals >= 2,
                    "substitutes": "; ".join(found),
                    "how_to_get": "" if horizontals >= 2 else how_to_get(recording),
                }
            )
        schema: dict[str, Any] = {
            "number": pl.UInt32,
            "event": pl.String,
            "station": pl.String,
            "rsn": pl.UInt32,
            "horizontals": pl.UInt32,
            "verticals": pl.UInt32,
            "complete": pl.Boolean,
            "substitutes": pl.String,
            "how_to_get": pl.String,
        }
        return pl.DataFrame(rows, schema=schema)

    @property
    def complete(self) -> tuple[int, ...]:
        """Numbers of the records of which both horizontals are there."""
        return tuple(self.summary().filter("complete")["number"].to_list())

    @property
    def missing(self) -> tuple[int, ...]:
        """Numbers of the records of which no horizontal is there."""
        return tuple(self.summary().filter(pl.col("horizontals") == 0)["number"].to_list())

    def _count(self, recording: Recording, direction: str) -> int:
        """Components of one direction that can be used; copies of one count once."""
        return len(
            {
                one.label if one.component is None else one.component.file
                for one in self.files
                if one.recording is recording and one.direction == direction and one.usable
            }
        )

    @property
    def text(self) -> str:
        """The report in lines, for a terminal."""
        lines = [
            f"{printable(str(self.folder))}: {len(self.complete)} of {len(RECORDINGS)} records with both horizontals, "
            f"{len(self.files)} of {self.looked_at} files are of them or of substitutes",
            "",
        ]
        for row, recording in zip(self.summary().iter_rows(named=True), RECORDINGS, strict=True):
            vertical = " and the vertical" if row["verticals"] else ""
            there = _horizontals(row["horizontals"]) if row["horizontals"] else "not here"
            lines.append(f"{row['number']}  {row['event']}, {row['station']} (RSN{row['rsn']}): {there}{vertical}")
            lines += [line for one in self.files if one.recording is recording for line in self._lines(one)]
            for stand_in in (one for one in SUBSTITUTES if one.number == recording.number):
                files = [one for one in self.files if one.recording is stand_in]
                if files:
                    count = _horizontals(self._count(stand_in, "horizontal"))
                    lines.append(f"   substitute: {stand_in.station} (RSN{stand_in.rsn}), {count}")
                    lines += [line for one in files for line in self._lines(one)]
            if row["how_to_get"]:
                lines.append(f"   to get it: {row['how_to_get']}")
        if len(self.complete) < len(RECORDINGS):
            lines += ["", TERMS]
        return "\n".join(lines)

    def _lines(self, one: FoundFile) -> Iterator[str]:
        name = one.file.relative_to(self.folder) if one.file.is_relative_to(self.folder) else one.file
        size = "cannot be read"
        if one.samples is not None:
            step = "step not stated" if one.dt is None else f"dt {one.dt:g} s"
            size = f"{one.samples} points, {step}, PGA {one.pga_g:.5f} g"
        said = f"component {one.label or '?'}, {one.direction}"
        yield f"   {printable(str(name))}: {said}, {size}; by {one.judged}"
        for remark in one.remarks:
            yield f"      {remark}"


def _horizontals(count: int) -> str:
    return {0: "no horizontal", 1: "one horizontal", 2: "both horizontals"}.get(count, f"{count} horizontals")
