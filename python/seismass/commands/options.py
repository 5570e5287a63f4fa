"""Options that several subcommands share: the motions and the target spectrum that they are scaled to."""

from __future__ import annotations

import argparse
import errno
import math
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Final

from seismass.base.units import ACCELERATION_UNITS
from seismass.model.springs import SHAPE_FIELDS
from seismass.scaling.target_text import TARGET_HELP, target_of

if TYPE_CHECKING:
    from seismass.records import Suite
    from seismass.records.builtin import BuiltinName
    from seismass.spectra import TargetSpectrum

SPRING_OPTIONS: Final = {
    "overstrength": "second yield over the first",
    "second_slope": "slope after the first yield, an inference",
    "third_slope": "slope after the second yield, an inference",
}
"""What shapes the springs of a command's buildings, with its help."""
_LISTED_SINGLY: Final = 8


def add_motion_options(parser: argparse.ArgumentParser) -> None:
    """Add --records, --suite, --target, --sds, --sd1, --tl and --period."""
    motions = parser.add_argument_group("motions")
    add_records_options(motions)
    add_target_options(motions)
    motions.add_argument(
        "--period", type=positive_option, default=1.0, metavar="T", help="motions are scaled from 0.2 T to 1.5 T (1 s)"
    )


def add_target_options(group: argparse._ActionsContainer) -> None:
    """Add --target, --sds, --sd1 and --tl, which `read_target` reads."""
    group.add_argument("--target", metavar="TARGET", help=TARGET_HELP)
    group.add_argument("--sds", type=positive_option, metavar="G", help="S_DS of the ASCE 7 shape, g (1.07)")
    group.add_argument("--sd1", type=positive_option, metavar="G", help="S_D1, g (0.61)")
    group.add_argument(
        "--tl",
        type=positive_option,
        metavar="S",
        help="T_L, s (8); the three defaults stand in for the Port of Long Beach and are not its published spectrum",
    )


def add_spring_options(group: argparse._ActionsContainer, names: Iterable[str] = SPRING_OPTIONS, of: str = "") -> None:
    """Add --overstrength, --second-slope and --third-slope, or those of them that are named; `of` precedes defaults."""
    for name in names:
        field = SHAPE_FIELDS[name]
        group.add_argument(
            f"--{name.replace('_', '-')}",
            type=float,
            metavar=field.symbol.upper(),
            help=f"{SPRING_OPTIONS[name]} ({of}{field.default:g})",
        )


def add_reading_options(parser: argparse.ArgumentParser) -> None:
    """Add --dt and --unit, for a record whose file does not state them."""
    parser.add_argument(
        "--dt", type=positive_option, metavar="S", help="time step of a record whose file does not state it, s"
    )
    parser.add_argument("--unit", choices=tuple(ACCELERATION_UNITS), help="unit of a record whose file states none")


def add_records_options(group: argparse._ArgumentGroup) -> None:
    """Add --records and --suite, which `read_motions` reads."""
    group.add_argument(
        "--records",
        type=Path,
        metavar="PATH",
        help="folder of record files, or a CSV with a column `file` (default: built-in synthetic motions)",
    )
    group.add_argument(
        "--suite",
        choices=("forty", "eleven", "seven"),
        help="built-in synthetic motions, where --records is left out: forty with the scatter of recordings (default "
        "of building, ida, risk and slip), seven as ASCE 7-10 asks for, with which published numbers are (default of "
        "study, map, validate and scale), or eleven as ASCE 7-16 does (default of scaling by it)",
    )


def read_motions(args: argparse.Namespace, default: BuiltinName = "forty") -> Suite:
    """Return the suite that the options name.

    Raises
    ------
    InvalidOption
        A built-in suite is named beside --records.
    RecordFormatError
        As for `read_suite`.
    """
    from seismass.base.errors import InvalidOption
    from seismass.records import builtin_suite, read_suite

    if args.records is None:
        return builtin_suite(args.suite or default)
    if args.suite is not None:
        raise InvalidOption(f"suite of motions must be left out where --records is given; got {args.suite}")
    return read_suite(args.records)


def check_files(*paths: Path | None) -> None:
    """Refuse files that cannot be written since their folder is missing, before anything is computed.

    Raises
    ------
    OSError
        A path is a folder, or its folder is none.
    """
    for path in paths:
        if path is None:
            continue
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        if not path.parent.is_dir():
            raise FileNotFoundError(errno.ENOENT, "No such folder", str(path.parent))


def warn_left_out(suite: Suite) -> None:
    """Print on standard error what the suite left out, where standard output is for machines."""
    for line in left_out(suite):
        print(f"seismass: {line}", file=sys.stderr)


def warn_remarks(suite: Suite) -> None:
    """Print on standard error what the records say of themselves, where standard output has no place for it."""
    for number, record in enumerate(suite, start=1):
        for remark in record.remarks:
            print(f"seismass: motion {number}, {record.name}: {remark}", file=sys.stderr)


def left_out(suite: Suite) -> list[str]:
    """Return a line for each file that the suite left out, with the reason, and for each of its remarks.

    More than a few files are counted by reason.
    """
    from seismass.base.values import printable

    if len(suite.excluded) <= _LISTED_SINGLY:
        lines = [f"left out {printable(item.file.name)}: {item.reason}" for item in suite.excluded]
    else:
        grouped: dict[str, list[str]] = {}
        for item in suite.excluded:
            # What a reason says of one file, behind a colon, would make every group one of its own.
            reason = item.reason.partition(": ")[0] if item.reason.startswith("vertical") else item.reason
            grouped.setdefault(reason, []).append(printable(item.file.name))
        lines = [
            f"left out {len(names)} {'file' if len(names) == 1 else 'files'}, {names[0]}"
            f"{' and others' if len(names) > 1 else ''}: {reason}"
            for reason, names in grouped.items()
        ]
    return [*lines, *suite.remarks]


def read_target(args: argparse.Namespace) -> TargetSpectrum:
    """Return the target spectrum that the options describe.

    Raises
    ------
    InvalidOption
        --target is given together with a number of the ASCE 7 shape, T_L is below T_S, or as `target_of` says.
    """
    from seismass.base.errors import InvalidOption
    from seismass.spectra import DEFAULT_SD1_G, DEFAULT_SDS_G, DEFAULT_TL, TargetSpectrum

    given = {"sds": args.sds, "sd1": args.sd1, "tl": args.tl}
    if args.target is not None:
        for name, value in given.items():
            if value is not None:
                raise InvalidOption(
                    f"{name} of target spectrum must be left out where --target is given; got {value:g}"
                )
        return target_of(str(args.target))
    defaults = {"sds": DEFAULT_SDS_G, "sd1": DEFAULT_SD1_G, "tl": DEFAULT_TL}
    sds, sd1, tl = (defaults[name] if value is None else value for name, value in given.items())
    return TargetSpectrum.asce7(sds, sd1, tl)


def positive_option(text: str) -> float:
    """Return a positive number."""
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not 0.0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"must be a positive number; got {text!r}")
    return number


def positive_count(text: str) -> int:
    """Return a whole number above zero."""
    number = int(text) if text.isdecimal() else 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number above zero; got {text!r}")
    return number


def threads_option(text: str) -> int:
    """Return a number of threads."""
    from seismass.runs.batch import MAX_THREADS

    number = int(text) if text.isdecimal() else 0
    if not 1 <= number <= MAX_THREADS:
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to {MAX_THREADS}; got {text!r}")
    return number
