"""Finding which files of a folder are components of one recording, by name and by header."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Literal

import polars as pl

from seismass.base.errors import InvalidMotion, RecordFormatError
from seismass.base.values import as_path, printable
from seismass.base.views import Card
from seismass.records.folder import files_below
from seismass.records.formats.directions import azimuth_of
from seismass.records.pair import Pair
from seismass.records.place import vertical_reason
from seismass.records.record import Record
from seismass.records.rotation import between
from seismass.records.suite import Excluded, read_file

_SEQUENCE: Final = re.compile(r"^RSN(\d+)(?!\d)", re.IGNORECASE)
_DIRECTION: Final = re.compile(
    r"(?:[-_. ]*(?:(?:NS|EW|UD)(?P<level>[12]?)|UP|VERT?|LN|TR|LONG|TRAN|H[12]|[BH][NLH][NEZ123])|[-_. ]+[NSEWLTVZ]"
    r"|[-_. ]?(?P<degrees>\d{3}))$",
    re.IGNORECASE,
)
"""End of a name that says which component it is; KiK-net numbers the instruments in the borehole 1, those above 2."""


@dataclass(frozen=True)
class Pairs(Card):
    """Pairs found in a folder, in the order of their first files, and the files that are in none.

    Parameters
    ----------
    name : str
        Name of the folder.
    pairs : tuple of Pair
        What was found.
    excluded : tuple of Excluded
        Files that are not a component of a pair, with the reason.
    """

    name: str
    pairs: tuple[Pair, ...]
    excluded: tuple[Excluded, ...] = ()

    def __len__(self) -> int:
        return len(self.pairs)

    def __iter__(self) -> Iterator[Pair]:
        return iter(self.pairs)

    def __getitem__(self, index: int) -> Pair:
        return self.pairs[index]

    def table(self) -> pl.DataFrame:
        """Return one row per pair: labels, files, azimuths (degrees), samples, dt (s), PGA (g) and remarks."""
        rows = [
            {
                "pair": number,
                "name": pair.name,
                "event": pair.event,
                "station": pair.station,
                "first": _file(pair.first),
                "second": _file(pair.second),
                "vertical": None if pair.vertical is None else _file(pair.vertical),
                "azimuth_first": pair.first.azimuth,
                "azimuth_second": pair.second.azimuth,
                "samples": pair.samples,
                "dt": pair.dt,
                "pga_g_first": pair.first.pga_g,
                "pga_g_second": pair.second.pga_g,
                "remarks": "; ".join(pair.remarks),
            }
            for number, pair in enumerate(self.pairs, start=1)
        ]
        schema: dict[str, Any] = {"pair": pl.UInt32}
        schema |= dict.fromkeys(("name", "event", "station", "first", "second", "vertical"), pl.String)
        schema |= dict.fromkeys(("azimuth_first", "azimuth_second"), pl.Float64)
        schema |= {"samples": pl.UInt32, "dt": pl.Float64, "pga_g_first": pl.Float64, "pga_g_second": pl.Float64}
        return pl.DataFrame(rows, schema=schema | {"remarks": pl.String})


def find_pairs(folder: str | os.PathLike[str], *, lengths: Literal["shorter", "padded"] = "shorter") -> Pairs:
    """Return the pairs and triples of components among the record files of a folder and of those below.

    Files of one folder belong together that share the record sequence number of their names (``RSN161_...``), or else
    event and station of their headers, or else a name but for the direction it ends in. Of those the two horizontals
    make the pair, and one vertical component is added. Directions come from the header, or from names that end in two
    numbers 90 degrees apart.

    Parameters
    ----------
    folder : path-like
        The folder; hidden files are not looked at. What is read of it is what `read_suite` reads: every record format,
        each channel of files of several, and text of columns that states its step and unit.
    lengths : {"shorter", "padded"}
        See `Pair.from_records`.

    Raises
    ------
    RecordFormatError
        It is not a folder. A damaged file raises nothing: it stands in `excluded` with the reason, as does one that
        is not a record, or a component without a partner or with several.
    """
    directory = as_path(folder, "pairs", RecordFormatError)
    if not directory.is_dir():
        raise RecordFormatError(f"folder of pairs must be a directory; got {printable(str(directory))}")
    excluded: list[Excluded] = []
    groups: dict[tuple[str, ...], list[Record]] = {}
    for file in files_below(directory):
        try:
            read = read_file(file)
        except RecordFormatError as error:
            read = str(error)
        if isinstance(read, str):
            excluded.append(Excluded(file, read))
            continue
        for record in read:
            groups.setdefault(_group(file, record), []).append(record)
    pairs: list[Pair] = []
    for records in groups.values():
        for together in _sorted_out(records):
            pair, left = _pair(together, lengths)
            pairs.extend(pair)
            excluded.extend(left)
    excluded.sort(key=lambda item: item.file)
    return Pairs(printable(directory.resolve().name), tuple(pairs), tuple(excluded))


def _file(record: Record) -> str:
    return "" if record.source is None else printable(str(record.source))


def _group(file: Path, record: Record) -> tuple[str, ...]:
    """What components of one recording share."""
    sequence = _SEQUENCE.match(file.name)
    if sequence:
        return str(file.parent), "RSN", sequence[1]
    if record.event and record.station:
        return str(file.parent), "header", record.event.lower(), record.station.lower()
    return str(file.parent), "name", _stem(record.name)


def _stem(name: str) -> str:
    """A name without the direction it ends in."""
    return _DIRECTION.sub(lambda end: end["level"] or "", name).lower()


def _sorted_out(records: list[Record]) -> list[list[Record]]:
    """One group, or several by name where it has more than two horizontals: instruments of one station."""
    if sum(vertical_reason(record) is None for record in records) <= 2:
        return [records]
    groups: dict[str, list[Record]] = {}
    for record in records:
        groups.setdefault(_stem(record.name), []).append(record)
    return list(groups.values())


def _pair(records: list[Record], lengths: Literal["shorter", "padded"]) -> tuple[list[Pair], list[Excluded]]:
    """The pair that a group makes, and what is left of it."""
    horizontal = [record for record in records if vertical_reason(record) is None]
    vertical = [record for record in records if vertical_reason(record) is not None]
    if len(horizontal) != 2:
        alone = "no second horizontal component beside it"
        several = f"{len(horizontal)} horizontal components that belong together: read_pair takes two by name"
        none = "vertical component without horizontal ones"
        return [], _left(records, {0: none, 1: alone}.get(len(horizontal), several))
    first, second = _directed(horizontal)
    up = vertical[0] if len(vertical) == 1 else None
    try:
        pair = Pair.from_records(first, second, up, lengths=lengths)
    except InvalidMotion as error:
        return [], _left(records, str(error))
    return [pair], [] if up else _left(vertical, "more than one vertical component of its pair")


def _left(records: list[Record], reason: str) -> list[Excluded]:
    """Records that are in no pair; those of a file of several channels by name."""
    sources = [record.source for record in records]
    return [
        Excluded(record.source, reason if sources.count(record.source) == 1 else f"{record.name}: {reason}")
        for record in records
        if record.source is not None
    ]


def _directed(horizontal: list[Record]) -> list[Record]:
    """The two horizontals with the directions that their names end in, where nothing else states them."""
    if any(record.azimuth is not None or azimuth_of(record.component) is not None for record in horizontal):
        return horizontal
    ends = [_DIRECTION.search(record.name) for record in horizontal]
    degrees = [float(end["degrees"]) for end in ends if end and end["degrees"]]
    if len(degrees) != 2 or max(degrees) > 360.0 or abs(between(*degrees)) != 90.0:
        return horizontal
    return [record.replace(azimuth=azimuth % 360.0) for record, azimuth in zip(horizontal, degrees, strict=True)]
