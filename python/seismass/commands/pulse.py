"""`seismass pulse`: whether a record, a pair or the pairs of a folder have a velocity pulse."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.commands.frame import Command, show, write_figure
from seismass.commands.options import (
    add_json_option,
    add_plot_option,
    add_reading_options,
    positive_count,
    reading,
    warn_left_out,
)
from seismass.commands.parser import tell

if TYPE_CHECKING:
    from seismass.motions.pulses import OrientationScan, PulseResult
    from seismass.motions.records import Pair, Record


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument(
        "first",
        type=Path,
        metavar="RECORD",
        help="a horizontal component, a file with both, or a folder, of which every pair is judged",
    )
    parser.add_argument("second", type=Path, nargs="?", metavar="RECORD2", help="the other horizontal component")
    parser.add_argument(
        "--method",
        choices=("baker2007", "shahi_baker2014"),
        help="baker2007 judges each component alone (default for one), shahi_baker2014 two together (for two)",
    )
    parser.add_argument(
        "--orientations",
        type=positive_count,
        metavar="N",
        help="judge N directions of two components by Baker (2007), evenly from 0 to 180 degrees",
    )
    add_plot_option(parser)
    add_reading_options(parser)
    add_json_option(parser)


def run(args: argparse.Namespace) -> int:
    """Print the classes; return the exit code."""
    if args.orientations is not None and args.method == "shahi_baker2014":
        raise InvalidOption("--method of pulse must be baker2007 with --orientations; got shahi_baker2014")
    groups = _groups(args)
    _warn_remarks(groups)
    results: list[PulseResult | OrientationScan] = [one for group in groups for one in _judged(group, args)]
    if args.plot is not None:
        if len(results) != 1:
            raise InvalidOption(f"--plot of pulse must be of one result; got {len(results)}")
        write_figure(results[0].plot(), args.plot)
    if args.json:
        print(json.dumps([_document(one) for one in results], indent=2))
    else:
        show("\n".join(one.text for one in results))
    return 0


def _groups(args: argparse.Namespace) -> list[Record | Pair]:
    """Return what is judged: a component, two, or every pair of a folder; report on standard error what has no pair."""
    from seismass.motions.records import Pair, Suite, find_pairs, read_record

    if args.first.is_dir():
        if args.second is not None:
            raise InvalidOption(f"RECORD2 of pulse must be left out for a folder; got {args.second}")
        reading(args).refuse(args.first, "a folder")
        pairs = find_pairs(args.first)
        if not len(pairs):
            raise InvalidMotion(f"pairs of {args.first} must be at least one; got none in {len(pairs.excluded)} files")
        warn_left_out(Suite(pairs.name, (), pairs.excluded))
        return list(pairs)
    options = reading(args).of_a_file()
    if args.channel is not None:
        options["channel"] = args.channel
    if args.second is not None:
        return [Pair.from_records(read_record(args.first, **options), read_record(args.second, **options))]
    return [_one_file(args.first, options)]


def _warn_remarks(groups: list[Record | Pair]) -> None:
    """Print on standard error what the horizontal components say of themselves, such as that they were matched."""
    from seismass.motions.records import Record

    for group in groups:
        for record in (group,) if isinstance(group, Record) else (group.first, group.second):
            for remark in record.remarks:
                tell(f"{record.name}: {remark}")


def _one_file(path: Path, options: dict[str, Any]) -> Record | Pair:
    """The one record of a file, or the pair of its two horizontal channels."""
    from seismass.motions.records import Pair, read_record, read_records
    from seismass.motions.records.formats.labels import is_vertical

    if "channel" in options:
        return read_record(path, **options)
    records = read_records(path, **options)
    if len(records) == 1:
        return records[0]
    level = [record for record in records if not is_vertical(record.component)]
    if len(level) != 2:
        there = ", ".join(record.component or "?" for record in records)
        raise InvalidOption(
            f"channels of {path.name} must be one, or two horizontal ones; got {len(records)} ({there}): "
            "--channel takes one"
        )
    return Pair.from_records(*level)


def _judged(motion: Record | Pair, args: argparse.Namespace) -> list[PulseResult | OrientationScan]:
    from seismass.motions.pulses import baker2007, baker2007_orientations, shahi_baker2014
    from seismass.motions.records import Record

    if isinstance(motion, Record):
        for name, asked in (
            ("--orientations", args.orientations is not None),
            ("--method shahi_baker2014", args.method == "shahi_baker2014"),
        ):
            if asked:
                raise InvalidOption(f"{name} of pulse must be given two components; got one")
        return [baker2007(motion)]
    if args.orientations is not None:
        return [baker2007_orientations(motion, orientations=args.orientations)]
    if args.method == "baker2007":
        return [baker2007(motion.first), baker2007(motion.second)]
    return [shahi_baker2014(motion)]


def _document(result: PulseResult | OrientationScan) -> dict[str, Any]:
    """A result as JSON has it: SI units, degrees; the histories are in Python's `history_table`."""
    from seismass.motions.pulses import PulseResult

    if isinstance(result, PulseResult):
        return {
            "method": result.method,
            "records": list(result.names),
            "is_pulse": result.is_pulse,
            "kind": result.primary.kind,
            "period": result.period,
            "candidate": result.primary.number,
            "candidates": result.table().to_dicts(),
            "remarks": list(result.remarks),
        }
    return {
        "method": result.results[0].method,
        "records": list(result.names),
        "pulses": result.pulses,
        "ambiguous": result.ambiguous,
        "orientations": result.table().to_dicts(),
        "remarks": list(result.remarks),
    }


COMMAND = Command(
    description=("Whether a record is pulse-like, with the indicator, the test of early arrival and the pulse period."),
    examples="""
pulse RSN767_LOMAP_G03000.AT2 RSN767_LOMAP_G03090.AT2 --plot pulse.png
pulse RSN767_LOMAP_G03000.AT2 RSN767_LOMAP_G03090.AT2 --orientations 36
pulse RSN1106_KOBE_KJM000.AT2 --json
pulse records/
""",
    options=options,
    run=run,
    note="""
Two components are judged by Shahi and Baker (2014), one by Baker (2007); --orientations judges every direction of two
by Baker (2007). Needs PyWavelets: pip install PyWavelets.
""",
)
