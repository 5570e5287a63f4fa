"""`seismass building FILE`: how much of one's own building's live load to count as mass, its drifts and slips."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seismass.commands.options import (
    add_records_options,
    left_out,
    positive_option,
    read_motions,
    read_target,
    threads_option,
    warn_left_out,
)
from seismass.commands.study import progress_bar

if TYPE_CHECKING:
    from seismass.model.codes import CodeFraction
    from seismass.spectra import TargetSpectrum

_EPILOG = """examples:
  seismass building --example > warehouse.toml
  seismass building warehouse.toml
  seismass building warehouse.toml --records my_records/ --out warehouse
  seismass building warehouse.toml --sds 0.8 --sd1 0.5 --code ec8
  seismass building warehouse.toml --mu-factors 1 1 --json > answer.json
  seismass building --codes
  seismass building --frictions

docs/building_file.md explains every key of a building file.

exit codes: 0 done (a collapse is a result), 1 a run failed, 2 bad input"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "building",
        help=help,
        description="Assess the building of a file (TOML or JSON): the share of its live load that acts as mass, with "
        "goods that slide, the code's share attached, all attached and none. Prints the answer and writes tables, "
        "figures and a page for the calculation folder.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("file", type=Path, nargs="?", metavar="FILE", help="building file, .toml or .json")
    what.add_argument("--example", action="store_true", help="print a building file to start from, and stop")
    what.add_argument("--codes", action="store_true", help="print the codes and their fractions, and stop")
    what.add_argument("--frictions", action="store_true", help="print the contacts and their friction, and stop")
    motions = parser.add_argument_group("motions and site, in place of the file's")
    add_records_options(motions)
    motions.add_argument("--target", type=Path, metavar="CSV", help="site spectrum: period (s), Sa (g)")
    motions.add_argument("--sds", type=positive_option, metavar="G", help="S_DS of the ASCE 7 shape, g")
    motions.add_argument("--sd1", type=positive_option, metavar="G", help="S_D1, g")
    motions.add_argument("--tl", type=positive_option, metavar="S", help="T_L, s (8)")
    motions.add_argument(
        "--period",
        type=positive_option,
        metavar="T",
        help="motions are scaled from 0.2 T to 1.5 T (first period with the goods attached)",
    )
    choices = parser.add_argument_group("code and friction, in place of the file's")
    choices.add_argument("--code", metavar="ID", help="code whose fraction is compared, as --codes lists them")
    choices.add_argument("--use", choices=("storage", "ordinary"), help="use of the floors for --code (storage)")
    choices.add_argument(
        "--mu-factors",
        type=positive_option,
        nargs=2,
        metavar=("LOW", "HIGH"),
        help="bounds of friction as factors (0.67 1.5); 1 1 leaves them out",
    )
    output = parser.add_argument_group("running and output")
    output.add_argument("--out", type=Path, metavar="DIR", help="folder to write to (the file's name without suffix)")
    output.add_argument("--jobs", type=threads_option, metavar="N", help="threads (all cores); changes no digit")
    output.add_argument("--json", action="store_true", help="print the assessment as JSON")
    output.add_argument("--no-figures", action="store_true", help="write tables only, no figures and no page")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Assess the building, write its files and print the page; return the exit code."""
    if args.example or args.codes or args.frictions:
        print(_listing(args), end="")
        return 0
    from seismass.assessment import assess
    from seismass.assessment.building_file import read_building
    from seismass.base.errors import SimulationError
    from seismass.media.folder import PAGE, check_out

    started = time.perf_counter()
    out = args.out or Path(args.file.stem)
    check_out(out, "assessment")
    building = read_building(args.file)
    code, target = _code(args), _target(args)
    suite = read_motions(args)
    try:
        result = assess(
            building,
            suite,
            target,
            code=code,
            mu_factors=None if args.mu_factors is None else (args.mu_factors[0], args.mu_factors[1]),
            scaling_period=args.period,
            threads=args.jobs,
            progress=progress_bar(),
        )
    except SimulationError as error:
        print(f"seismass: run failed: {error}", file=sys.stderr)
        return 1
    files = result.write(out, figures=not args.no_figures)
    if args.json:
        warn_left_out(suite)
        print(result.to_json())
        return 0
    print(result.text)
    for line in left_out(suite):
        print(f"\n{line}")
    page = "" if args.no_figures else f", the page is {out / PAGE}"
    print(f"\n{len(files)} files in {out}{page}, {time.perf_counter() - started:.1f} s")
    return 0


def _listing(args: argparse.Namespace) -> str:
    """Return the example file, or the requested table."""
    from seismass.media.text_table import text_table

    if args.example:
        from seismass.assessment.building_file import example_file

        return example_file().read_text(encoding="utf-8")
    if args.codes:
        from seismass.model.codes import MARK, code_legend, code_table

        rows = [["id", "use", "fraction", "clause", "status", "code"]]
        for row in code_table().iter_rows(named=True):
            fraction = f"{row['low']:g} to {row['high']:g}" if row["low"] < row["high"] else f"{row['fraction']:g}"
            rows.append(
                [
                    row["code_id"],
                    row["use"],
                    fraction,
                    row["clause"],
                    row["status"],
                    row["code"] + MARK * (not row["checked"]),
                ]
            )
    else:
        from seismass.model.friction import friction_table

        rows = [["id", "mu_s", "mu_k", "contact", "source"]]
        for row in friction_table().iter_rows(named=True):
            source = f"{row['source']} ({row['kind']})"
            rows.append([row["pair_id"], f"{row['mu_s']:g}", f"{row['mu_k']:.4g}", row["contact"], source])
    lines = text_table(rows, left=len(rows[0]), indent=0)
    return "\n".join([*lines, *([f"\n{code_legend()}"] if args.codes else [])]) + "\n"


def _code(args: argparse.Namespace) -> CodeFraction | None:
    """The code that the options name.

    Raises
    ------
    InvalidOption
        The code is not known, or a use is given without one.
    """
    from seismass.base.errors import InvalidOption
    from seismass.model.codes import code_fraction

    if args.code is None:
        if args.use is not None:
            raise InvalidOption(f"--use of building must be left out where --code is not given; got {args.use}")
        return None
    return code_fraction(args.code, args.use or "storage")


def _target(args: argparse.Namespace) -> TargetSpectrum | None:
    """The site spectrum that the options describe; None where they describe none.

    Raises
    ------
    InvalidOption
        One of S_DS and S_D1 is given without the other, or a CSV beside them.
    """
    from seismass.base.errors import InvalidOption

    if args.target is None:
        if args.sds is args.sd1 is args.tl is None:
            return None
        if args.sds is None or args.sd1 is None:
            given = (
                "--sds" if args.sd1 is None and args.sds is not None else "--sd1" if args.sd1 is not None else "--tl"
            )
            raise InvalidOption(
                f"site spectrum of building must be given by --sds and --sd1 together; got {given} alone"
            )
    return read_target(args)
