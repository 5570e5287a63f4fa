"""`seismass target SPECTRUM`: a target spectrum of a code, of a suite or of a building file as a CSV."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from seismass.base.files import table_content, write_file
from seismass.commands.frame import Command, show
from seismass.commands.options import add_output_option, numbers_option
from seismass.commands.parser import RUNS, tell
from seismass.motions.scaling import TARGET_HELP


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("spectrum", nargs="?", metavar="TARGET", help=TARGET_HELP)
    what.add_argument("--building", type=Path, metavar="FILE", help="building file, whose [site] is written")
    parser.add_argument(
        "--period",
        type=numbers_option(above=0.0),
        metavar="LIST",
        help="periods, s (default: 200 from 0.01 to 10 s, and the corners)",
    )
    add_output_option(parser, "FILE", "CSV to write (printed otherwise)")


def run(args: argparse.Namespace) -> int:
    """Print or write the table; return the exit code."""
    from seismass.assessment.building_file import read_building
    from seismass.motions.scaling.suite import target_of
    from seismass.motions.spectra.target import target_remarks

    target = target_of(args.spectrum) if args.building is None else read_building(args.building).site_spectrum()
    for remark in target_remarks(target):
        tell(remark)
    table = target.table(args.period)
    if args.out is None:
        sys.stdout.write(table.write_csv())
        return 0
    write_file(args.out, table_content(table, "csv"))
    show(f"{args.out}: {table.height} periods of {target.label}")
    return 0


COMMAND = Command(
    description=(
        "Write a target spectrum as a CSV of period (s) and Sa (g): of ASCE 7, Eurocode 8 or NZS 1170.5, the mean of "
        "a suite, or the site of a building file. --target and spectrum_csv read it again."
    ),
    examples="""
target ec8:1:C:0.3
target nzs1170:C:0.4 --out site.csv
target asce7:1.0:0.6 --period 0.2,0.5,1,2
target --building warehouse.toml --out site.csv
""",
    options=options,
    run=run,
    codes=RUNS,
)
