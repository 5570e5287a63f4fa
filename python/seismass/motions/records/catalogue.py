"""The seven records of the paper's Table 1 as data, what is odd about them, and how to get them.

No sample of a recording is here: counts, steps and peaks say what a file is, as its publisher's headers and lists do.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Literal

import polars as pl

from seismass.base.files import stored_rows
from seismass.base.values import printable, short_repr
from seismass.base.views import Card

DATABASE: Final = "https://ngawest2.berkeley.edu"
TERMS: Final = (
    "PEER NGA-West2 gives records to holders of a free account, for their own work: they may not be passed on "
    "(Ancheta et al., 2014, Earthquake Spectra 30:989)"
)


@dataclass(frozen=True)
class Component:
    """One component of a recording, as NGA-West2 has it.

    Attributes
    ----------
    file : str
        Name of its file.
    azimuth : float, optional
        Direction (degrees from north); None for the vertical component.
    samples : int, optional
        Number of points; None where the file was not at hand.
    dt : float, optional
        Time step (s).
    peak_g : float, optional
        Largest acceleration (g), with its sign.
    peak_sample : int, optional
        Number of its sample, from 1.
    opposite : float, optional
        Largest acceleration of the other sign over the peak: a mark of the record in any unit.
    """

    file: str
    azimuth: float | None
    samples: int | None = None
    dt: float | None = None
    peak_g: float | None = None
    peak_sample: int | None = None
    opposite: float | None = None

    @property
    def direction(self) -> str:
        """Either "horizontal" or "vertical"."""
        return "vertical" if self.azimuth is None else "horizontal"


@dataclass(frozen=True)
class Recording:
    """One recording of Table 1, or a substitute for one, and how to know its files.

    Attributes
    ----------
    number : int
        Row of Table 1; for a substitute that of the record it stands in for.
    rsn : int
        Record sequence number of NGA-West2.
    event, station : str
        As NGA-West2 writes them.
    year : int
        Year of the event.
    event_pattern, station_pattern : Pattern
        What headers call the two, in upper case.
    components : tuple of Component
        Two horizontals, then the vertical.
    substitute : bool
        Whether it is not the record of the table.
    """

    number: int
    rsn: int
    event: str
    station: str
    year: int
    event_pattern: re.Pattern[str]
    station_pattern: re.Pattern[str]
    components: tuple[Component, ...]
    substitute: bool = False


_NUMBERS: Final[dict[str, type]] = {
    **dict.fromkeys(("samples", "peak_sample"), int),
    **dict.fromkeys(("azimuth", "dt", "peak_g", "opposite", "magnitude", "distance_km", "pulse_period"), float),
    **dict.fromkeys(("nga_magnitude", "nga_distance_km", "nga_vs30"), float),
}


def _row(row: dict[str, str]) -> dict[str, Any]:
    """A row of a table with its numbers; what is not known is None."""
    return {name: (_NUMBERS[name](text) if text else None) if name in _NUMBERS else text for name, text in row.items()}


# Components: points, steps and peaks of the NGA-West2 files, where those were at hand. Recordings: how headers call
# them; event to pulse period are Table 1 as printed, and `nga_` the flatfile's magnitude, closest distance and Vs30.
_COMPONENTS: Final = [_row(row) for row in stored_rows("components")]
_ROWS: Final = [_row(row) for row in stored_rows("recordings")]


def _recording(row: dict[str, Any]) -> Recording:
    parts = [{name: part[name] for name in part if name != "rsn"} for part in _COMPONENTS if part["rsn"] == row["rsn"]]
    patterns = re.compile(row["event_pattern"]), re.compile(row["station_pattern"])
    names = row["nga_event"], row["nga_station"], int(row["year"])
    components = tuple(Component(**part) for part in parts)
    return Recording(int(row["number"]), int(row["rsn"]), *names, *patterns, components, not row["event"])


RECORDINGS: Final = tuple(_recording(row) for row in _ROWS if row["event"])
SUBSTITUTES: Final = tuple(_recording(row) for row in _ROWS if not row["event"])


def how_to_get(recording: Recording) -> str:
    """Return how to get a recording, in one sentence."""
    files = ", ".join(one.file for one in recording.components)
    return f"{DATABASE}: search for RSN {recording.rsn}, unscaled, and download {files}"


_SCHEMA: Final[dict[str, Any]] = {
    "number": pl.UInt32,
    "event": pl.String,
    "station": pl.String,
    "year": pl.UInt32,
    "magnitude": pl.Float64,
    "distance_km": pl.Float64,
    "pulse_period": pl.Float64,
    "rsn": pl.UInt32,
    "nga_event": pl.String,
    "nga_station": pl.String,
    "nga_magnitude": pl.Float64,
    "nga_distance_km": pl.Float64,
    "nga_vs30": pl.Float64,
    "files": pl.List(pl.String),
    "remark": pl.String,
    "how_to_get": pl.String,
}


def catalogue() -> pl.DataFrame:
    """Return the seven records of the paper's Table 1.

    Returns
    -------
    polars.DataFrame
        One row per record: `number` (1 to 7), `event`, `station`, `year`, `magnitude`, `distance_km` and
        `pulse_period` (s; null for no pulse) as the paper prints them; `rsn`, `nga_event` and `nga_station` as
        NGA-West2 has them; `nga_magnitude`, `nga_distance_km` (closest distance to the rupture) and `nga_vs30` (m/s)
        from its flatfile, null where that row was not at hand; `files` (list of str, horizontals first); `remark`, what
        is odd about the row; `how_to_get`.

    Notes
    -----
    The recordings are PEER's and are not part of this package; `find_catalogue` says which of them a folder holds.

    Examples
    --------
    >>> from seismass.motions.records import catalogue
    >>> catalogue().select("number", "rsn", "event", "pulse_period").row(2)
    (3, 161, '1979 Imperial Valley', 4.2)
    """
    rows = [
        {name: value for name, value in row.items() if name in _SCHEMA}
        | {"number": recording.number, "year": recording.year, "rsn": recording.rsn}
        | {"files": [one.file for one in recording.components], "how_to_get": how_to_get(recording)}
        for row, recording in zip(_ROWS, RECORDINGS, strict=False)
    ]
    return pl.DataFrame(rows, schema=_SCHEMA)


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
            files = [
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
                    "substitutes": "; ".join(files),
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
        words = f"component {one.label or '?'}, {one.direction}"
        yield f"   {printable(str(name))}: {words}, {size}; by {one.judged}"
        for remark in one.remarks:
            yield f"      {remark}"


def _horizontals(count: int) -> str:
    return {0: "no horizontal", 1: "one horizontal", 2: "both horizontals"}.get(count, f"{count} horizontals")
