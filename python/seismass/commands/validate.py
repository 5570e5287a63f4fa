"""`seismass validate`: the paper's section 4 by several programs, its shaking table, and its claims one by one."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

from seismass.commands.options import (
    add_records_options,
    add_target_options,
    read_motions,
    read_target,
    threads_option,
    warn_left_out,
)

_EPILOG = """examples:
  seismass validate
  seismass validate --records paper_seven.csv --out validation
  seismass validate --records records/ --sensitivity --json > validation.json

Recordings of Brawley Airport and Erzincan (RSN161 and RSN821) are found in --records by their station, and other
components of them in the same folder. Built-in motions stand in where there are none, and the output says so.
exit codes: 0 done, 2 bad input"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "validate",
        help=help,
        description="Solve the paper's section 4 with the exact kernel, with friction springs and, from kept results, "
        "with OpenSees; its shaking table over ranges of what is not published; and the parametric study. Print each "
        "claim of the paper with its verdict.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    motions = parser.add_argument_group("motions")
    add_records_options(motions)
    add_target_options(motions)
    output = parser.add_argument_group("running and output")
    output.add_argument("--out", type=Path, metavar="DIR", help="folder for tables and figures (none)")
    output.add_argument(
        "--sensitivity", action="store_true", help="add what each choice of the study changes: some seconds"
    )
    output.add_argument("--jobs", type=threads_option, metavar="N", help="threads (all cores); changes no digit")
    output.add_argument("--json", action="store_true", help="print claims and numbers as JSON")
    output.add_argument("--no-figures", action="store_true", help="write tables only")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the validations, write their files and print what they say; return the exit code."""
    from seismass.commands.study import progress_bar
    from seismass.media.folder import check_out
    from seismass.study import study_sensitivity
    from seismass.validation import validate

    started = time.perf_counter()
    if args.out is not None:
        check_out(args.out, "validation")
    target = read_target(args)
    suite = read_motions(args, "seven")
    warn_left_out(suite)
    sensitivity = (
        study_sensitivity(suite, target, threads=args.jobs, progress=progress_bar(unit="studies"))
        if args.sensitivity
        else None
    )
    result = validate(suite, target, sensitivity=sensitivity, threads=args.jobs, progress=progress_bar())
    files = [] if args.out is None else result.write(args.out, figures=not args.no_figures)
    if args.json:
        print(result.to_json())
    else:
        print(result.text)
        if files:
            print(f"\n{len(files)} files in {args.out}, {time.perf_counter() - started:.1f} s")
    return 0
