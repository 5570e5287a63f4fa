"""`seismass records`: what record files hold, and which of the paper's seven records a folder has."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from seismass.base.errors import InvalidOption, RecordFormatError
from seismass.base.values import printable
from seismass.commands.frame import Command, show
from seismass.commands.options import add_json_option, add_reading_options, reading
from seismass.commands.parser import columns

if TYPE_CHECKING:
    from seismass.motions.records import Record, Suite
    from seismass.motions.records.builtin import Reading

_UNREADABLE_LISTED: Final = 20


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument(
        "path", type=Path, nargs="?", metavar="PATH", help="a record, a folder, or a CSV with a column `file`"
    )
    parser.add_argument("--find", type=Path, metavar="DIR", help="look there for the paper's seven records")
    add_reading_options(parser)
    add_json_option(parser)


def run(args: argparse.Namespace) -> int:
    """Print the table or the report; return the exit code."""
    if args.path is not None and args.find is not None:
        raise InvalidOption(f"PATH of records must be left out where --find is given; got {args.path}")
    if args.path is None:
        reading(args).refuse(Path("records"), "a look without PATH")
        return _find(args.find, args.json) if args.find is not None else _catalogue(args.json)
    suite = _read(args.path, reading(args))
    if args.json:
        unreadable = [{"file": str(one.file), "reason": one.reason} for one in suite.excluded]
        document = {"name": suite.name, "records": _rows(suite), "not_read": unreadable, "remarks": list(suite.remarks)}
        print(json.dumps(document, indent=2, allow_nan=False))
        return 0
    show("\n".join(_table(suite)))
    return 0


def _read(path: Path, reading: Reading) -> Suite:
    """Return the records of a path: every channel of a file, vertical ones too, or every file of a folder or archive.
    What cannot be read is listed as left out, since the command is there to look.
    """
    from seismass.motions.records import Suite
    from seismass.motions.records import read_records as read_channels
    from seismass.motions.records.builtin import is_list, records_named
    from seismass.motions.records.read import is_archive, unpacked
    from seismass.motions.records.suite import named_after

    if is_archive(path):
        reading.refuse(path, "an archive of records")
        with unpacked(path) as (folder, names):
            suite = named_after(_all_of(folder, path), path, names)
        return suite
    if path.is_dir():
        reading.refuse(path, "a folder of records")
        return _all_of(path, path)
    if is_list(path) or reading.channel is not None:
        return records_named(path, reading)
    return Suite(path.stem, read_channels(path, **reading.of_a_file()))


def _all_of(folder: Path, named: Path) -> Suite:
    """Every record below a folder, which messages call `named`, and the files that are not records."""
    from seismass.motions.records import Excluded, Suite
    from seismass.motions.records import read_records as read_channels
    from seismass.motions.records.known import with_tables
    from seismass.motions.records.read import files_below

    records: list[Record] = []
    excluded: list[Excluded] = []
    files = files_below(folder)
    for file in files:
        try:
            records += read_channels(file)
        except RecordFormatError as error:
            excluded.append(Excluded(file, str(error)))
    if not records:
        raise RecordFormatError(
            f"records of folder {printable(str(named))} must be at least one; got {len(excluded)} files that are none"
        )
    return Suite(printable(named.resolve().name), tuple(with_tables(records, files)), tuple(excluded))


def _rows(suite: Suite) -> list[dict[str, Any]]:
    """One document per record: labels and measures, with the remarks of its reader and those on its ends."""
    from seismass.motions.records import intensity_table
    from seismass.motions.records.known import KNOWN

    rows = []
    for row, record in zip(intensity_table(suite).iter_rows(named=True), suite, strict=True):
        numbers = {
            name: None if isinstance(value, float) and not math.isfinite(value) else value
            for name, value in row.items()
        }
        rows.append(
            numbers
            | {
                "azimuth": record.azimuth,
                "network": record.network,
                "synthetic": record.synthetic,
                "place": record.place,
                **{name: getattr(record, name) or None for name in KNOWN},
                "file": None if record.source is None else str(record.source),
                "sha256": record.sha256,
                "remarks": [*record.remarks, *row["remarks"]],
            }
        )
    return rows


def _table(suite: Suite) -> list[str]:
    from seismass.media.text_table import number_text, text_line
    from seismass.motions.records.known import known_words

    rows = _rows(suite)
    cells = []
    for row in rows:
        label = ", ".join(text for text in (row["event"], row["station"]) if text)
        cells.append(
            {
                "": str(row["motion"]),
                "record": printable(row["name"]),
                "comp.": _direction(row["component"]),
                "points": str(row["samples"]),
                "dt (s)": f"{row['dt']:g}",
                "PGA (g)": f"{row['pga_g']:.4f}",
                "PGV (cm/s)": f"{100.0 * row['pgv']:.2f}",
                "Arias (m/s)": f"{row['arias']:.3f}",
                "D5-95 (s)": number_text(row["d5_95"]),
                " event, station": f" {label}",
            }
        )
    widths = {name: max(9 if name == "D5-95 (s)" else len(name), 8 * (name == "comp.")) for name in cells[0]}
    longest = max(len("record"), *(len(row["record"]) for row in cells))
    widths |= {"": 3, "record": longest + 1, "dt (s)": 7, "PGA (g)": 8}
    lengths = widths | {" event, station": max(len(row[" event, station"]) for row in cells)}
    dropped = _left_out(lengths)
    shown = [name for name in widths if name not in dropped]
    left = ("record", "comp.")
    placed = [0 if name == " event, station" else -widths[name] if name in left else widths[name] for name in shown]
    lines = [f"{suite.name}: {len(suite)} {'record' if len(suite) == 1 else 'records'}", *suite.remarks, ""]
    lines.append(text_line(shown, placed, indent=0, gap=1))
    for row, texts, record in zip(rows, cells, suite, strict=True):
        lines.append(text_line([texts[name] for name in shown], placed, indent=0, gap=1))
        where = [f"stands at: {row['place']}"] if row["place"] else []
        where += [words] if (words := known_words(record)) else []
        lines += [f"{'':5}{remark}" for remark in (*where, *row["remarks"])]
    if dropped:
        names = ", ".join(name.strip() for name in dropped)
        lines += ["", f"left out: {names}; a wider terminal, --json or a pipe shows all"]
    if suite.excluded:
        lines += ["", f"not read: {len(suite.excluded)} {'file' if len(suite.excluded) == 1 else 'files'}"]
        lines += [f"  {printable(one.file.name)}: {one.reason}" for one in suite.excluded[:_UNREADABLE_LISTED]]
        if len(suite.excluded) > _UNREADABLE_LISTED:
            lines.append(f"  and {len(suite.excluded) - _UNREADABLE_LISTED} more")
    return lines


def _left_out(widths: Mapping[str, int]) -> list[str]:
    """Columns of the table that a terminal has no room for, the least needed first."""
    room, dropped = columns(), []
    for name in ("Arias (m/s)", "PGV (cm/s)", "points", "comp.", "D5-95 (s)", " event, station"):
        used = [width for other, width in widths.items() if other not in dropped]
        if room is None or sum(used) + len(used) <= room + 1:
            break
        dropped.append(name)
    return dropped


def _direction(component: str) -> str:
    """A component for its column: what stands before a bracket, cut to its width."""
    words = component.partition("(")[0].strip()
    return words if len(words) <= 8 else f"{words[:7].rstrip()}."


def _find(folder: Path, as_json: bool) -> int:
    from seismass.motions.records import find_catalogue

    search = find_catalogue(folder)
    if as_json:
        document = {
            "folder": str(search.folder),
            "looked_at": search.looked_at,
            "complete": list(search.complete),
            "missing": list(search.missing),
            "records": search.summary().to_dicts(),
            "files": search.table().to_dicts(),
        }
        print(json.dumps(document, indent=2))
    else:
        show(search.text)
    return 0


def _catalogue(as_json: bool) -> int:
    from seismass.motions.records.catalogue import TERMS, catalogue

    rows = catalogue().to_dicts()
    if as_json:
        print(json.dumps(rows, indent=2))
        return 0
    lines = ["The seven records of the paper's Table 1 (magnitude, distance and pulse period as printed there)", ""]
    for row in rows:
        pulse = "no pulse" if row["pulse_period"] is None else f"pulse of {row['pulse_period']:g} s"
        lines.append(
            f"{row['number']}  {row['event']}, {row['station']}: M {row['magnitude']:g}, {row['distance_km']:g} km, "
            f"{pulse}; RSN{row['rsn']}"
        )
        if row["nga_magnitude"] is not None:
            lines.append(
                f"   NGA-West2 flatfile: M {row['nga_magnitude']:g}, closest distance {row['nga_distance_km']:g} km, "
                f"Vs30 {row['nga_vs30']:g} m/s"
            )
        lines += [f"   {row['remark']}"] if row["remark"] else []
        lines.append(f"   {row['how_to_get']}")
    for line in [*lines, "", TERMS]:
        show(line)
    return 0


COMMAND = Command(
    description=(
        "A table of the records in a file, a folder or a list: labels, points, step, peaks, Arias "
        "intensity, duration and what is odd about them. With --find: which of the paper's seven records a folder "
        "holds, judged by header and content."
    ),
    examples="""
records RSN767_LOMAP_G03000.AT2
records records/ --json
records column.txt --dt 0.01 --unit cm/s2
records --find Downloads/
records
""",
    options=options,
    run=run,
    note="""
Without a path: the seven records of the paper's Table 1, and how to get them.
""",
)
