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


# Points, steps and peaks are those of the NGA-West2 files; those of record 7 were not at hand.
RECORDINGS: Final = (
    Recording(
        1,
        1787,
        "Hector Mine",
        "Hector",
        1999,
        re.compile(r"HECTOR\s*MINE"),
        re.compile(r"^(HECTOR|HEC)\b"),
        (
            Component("RSN1787_HECTOR_HEC000.AT2", 0.0, 4531, 0.01, 0.265466, 600, -0.88433),
            Component("RSN1787_HECTOR_HEC090.AT2", 90.0, 4531, 0.01, 0.328187, 844, -0.96416),
            Component("RSN1787_HECTOR_HECVER.AT2", None, 4531, 0.01, -0.14873, 599, -0.90677),
        ),
    ),
    Recording(
        2,
        767,
        "Loma Prieta",
        "Gilroy Array #3",
        1989,
        re.compile(r"LOMA\s*PRIETA"),
        re.compile(r"\bGILROY\b.*(#|NO\.?|\s)\s*0?3\b"),
        (
            Component("RSN767_LOMAP_G03000.AT2", 0.0, 7997, 0.005, -0.559123, 1025, -0.96558),
            Component("RSN767_LOMAP_G03090.AT2", 90.0, 7998, 0.005, 0.368226, 1276, -0.77360),
            Component("RSN767_LOMAP_G03-UP.AT2", None, 7998, 0.005, -0.341692, 624, -0.84164),
        ),
    ),
    Recording(
        3,
        161,
        "Imperial Valley-06",
        "Brawley Airport",
        1979,
        re.compile(r"IMPERIAL\s*VALLEY"),
        re.compile(r"\bBRAWLEY\b"),
        (
            Component("RSN161_IMPVALL.H_H-BRA225.AT2", 225.0, 7576, 0.005, 0.162605, 1293, -0.80495),
            Component("RSN161_IMPVALL.H_H-BRA315.AT2", 315.0, 7575, 0.005, -0.219521, 1526, -0.86657),
            Component("RSN161_IMPVALL.H_H-BRA-UP.AT2", None, 7572, 0.005, 0.152812, 925, -0.97210),
        ),
    ),
    Recording(
        4,
        1612,
        "Duzce Turkey",
        "Lamont 1059",
        1999,
        re.compile(r"DUZCE"),
        re.compile(r"\b1059\b"),
        (
            Component("RSN1612_DUZCE_1059-N.AT2", 0.0, 4067, 0.01, -0.152353, 2496, -0.90683),
            Component("RSN1612_DUZCE_1059-E.AT2", 90.0, 4067, 0.01, -0.136654, 1725, -0.78488),
            Component("RSN1612_DUZCE_1059-V.AT2", None, 4067, 0.01, -0.100987, 1738, -0.84018),
        ),
    ),
    Recording(
        5,
        821,
        "Erzican Turkey",
        "Erzincan",
        1992,
        re.compile(r"ERZIN?[CK]AN"),
        re.compile(r"ERZIN?[CK]AN"),
        (
            Component("RSN821_ERZINCAN_ERZ-NS.AT2", 0.0, 4262, 0.005, 0.386713, 579, -0.63803),
            Component("RSN821_ERZINCAN_ERZ-EW.AT2", 90.0, 4156, 0.005, -0.496185, 693, -0.76138),
            Component("RSN821_ERZINCAN_ERZ-UP.AT2", None, 3977, 0.005, 0.234538, 600, -0.71609),
        ),
    ),
    Recording(
        6,
        6,
        "Imperial Valley-02",
        "El Centro Array #9",
        1940,
        re.compile(r"IMPERIAL\s*VALLEY|EL\s*CENTRO"),
        re.compile(r"\bEL\s*CENTRO\b.*(#|NO\.?|\s)\s*0?9\b"),
        (
            Component("RSN6_IMPVALL.I_I-ELC180.AT2", 180.0, 5372, 0.01, -0.280795, 219, -0.90490),
            Component("RSN6_IMPVALL.I_I-ELC270.AT2", 270.0, 5346, 0.01, -0.210743, 1152, -0.71289),
            Component("RSN6_IMPVALL.I_I-ELC-UP.AT2", None, 5378, 0.01, -0.178137, 338, -0.59494),
        ),
    ),
    Recording(
        7,
        1108,
        "Kobe Japan",
        "Kobe University",
        1995,
        re.compile(r"\bKOBE\b|HYOGO"),
        re.compile(r"\bKOBE\s*UNIV"),
        (
            Component("RSN1108_KOBE_KBU000.AT2", 0.0),
            Component("RSN1108_KOBE_KBU090.AT2", 90.0),
            Component("RSN1108_KOBE_KBU-UP.AT2", None),
        ),
    ),
)

SUBSTITUTES: Final = (
    Recording(
        7,
        1106,
        "Kobe Japan",
        "KJMA",
        1995,
        re.compile(r"\bKOBE\b|HYOGO"),
        re.compile(r"\bKJMA\b|\bKOBE\s*(JMA|J\.M\.A)"),
        (
            Component("RSN1106_KOBE_KJM000.AT2", 0.0, 7500, 0.02, -0.834229, 427, -0.70774),
            Component("RSN1106_KOBE_KJM090.AT2", 90.0),
            Component("RSN1106_KOBE_KJM-UP.AT2", None),
        ),
        substitute=True,
    ),
    Recording(
        7,
        1111,
        "Kobe Japan",
        "Nishi-Akashi",
        1995,
        re.compile(r"\bKOBE\b|HYOGO"),
        re.compile(r"\bNISHI-?\s*AKASHI\b"),
        (
            Component("RSN1111_KOBE_NIS000.AT2", 0.0, 4096, 0.01, -0.483225, 725, -0.99109),
            Component("RSN1111_KOBE_NIS090.AT2", 90.0, 4096, 0.01, -0.464318, 708, -0.63877),
            Component("RSN1111_KOBE_NIS-UP.AT2", None),
        ),
        substitute=True,
    ),
)

# Table 1 as printed: event, magnitude, distance (km), pulse period (s).
_PAPER: Final = (
    ("1999 Hector Mine", "Hector", 7.1, 12.0, None),
    ("1989 Loma Prieta", "Gilroy 03", 6.9, 13.0, 2.6),
    ("1979 Imperial Valley", "Brawley", 6.5, 10.0, 4.2),
    ("1999 Duzce", "Lamont 1059", 7.1, 4.0, None),
    ("1992 Erzinkan", "Erzinkan", 6.7, 4.0, None),
    ("1940 Imperial Valley", "El Centro", 7.0, 6.0, 2.6),
    ("1995 Kobe", "Kobe University", 6.9, 1.0, None),
)
# Flatfile of NGA-West2: magnitude, closest distance (km), Vs30 (m/s), for the rows that were at hand.
_FLATFILE: Final = {1787: (7.13, 11.66, 726.0), 767: (6.93, 12.82, 349.85), 161: (6.53, 10.42, 208.71)}
_ODD: Final = (
    "",
    "the two horizontals have 7997 and 7998 points",
    "the table's pulse period is that of the fault-normal component (4.22 s by Baker, 2007, at the flatfile's strike "
    "of 323 degrees); the pair has 4.40 s. The two horizontals have 7576 and 7575 points",
    "RSN1612; its neighbour RSN1611 is Lamont 1058",
    "the table has no pulse, but every component has one, of 2.66 s for the pair: the 2.6 s of the row below fits "
    "here. The table writes Erzinkan, NGA-West2 Erzican; the horizontals have 4262 and 4156 points",
    "the table's pulse of 2.6 s is in no component of the recording; it fits Erzincan, one row up. The horizontals "
    "have 5372 and 5346 points",
    "often not at hand: KJMA (RSN1106) and Nishi-Akashi (RSN1111), other stations of the event, are substitutes",
)


def how_to_get(recording: Recording) -> str:
    """Return how to get a recording, in one sentence."""
    files = ", ".join(one.file for one in recording.components)
    return f"{DATABASE}: search for RSN {recording.rsn}, unscaled, and download {files}"


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
    rows = []
    for recording, paper, odd in zip(RECORDINGS, _PAPER, _ODD, strict=True):
        event, station, magnitude, distance, period = paper
        nga_magnitude, nga_distance, vs30 = _FLATFILE.get(recording.rsn, (None, None, None))
        rows.append(
            {
                "number": recording.number,
                "event": event,
                "station": station,
                "year": recording.year,
                "magnitude": magnitude,
                "distance_km": distance,
                "pulse_period": period,
                "rsn": recording.rsn,
                "nga_event": recording.event,
                "nga_station": recording.station,
                "nga_magnitude": nga_magnitude,
                "nga_distance_km": nga_distance,
                "nga_vs30": vs30,
                "files": [one.file for one in recording.components],
                "remark": odd,
                "how_to_get": how_to_get(recording),
            }
        )
    schema: dict[str, Any] = {
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
    return pl.DataFrame(rows, schema=schema)


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
