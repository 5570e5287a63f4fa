"""`seismass study`: the paper's parametric study, its tables and figures, and what they say about the paper's claim."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from seismass.commands.options import (
    add_motion_options,
    left_out,
    read_motions,
    read_target,
    threads_option,
    warn_left_out,
)

_EPILOG = """examples:
  seismass study
  seismass study --records my_records/ --target uniform_hazard.csv --out results
  seismass study --records suite.csv --second-slope 0.1 --no-figures --json > study.json

exit codes: 0 done, 1 a run failed (its rows say why), 2 bad input"""


def add_parser(subparsers: Any) -> None:
    """Add the subcommand to those of the `seismass` command."""
    parser = subparsers.add_parser(
        "study",
        help="the parametric study: drift with sliding live load against the ASCE 7 rule",
        description="Run the parametric study of the paper: 72 buildings, each with sliding blocks and by the ASCE 7 "
        "rule, under a suite of motions scaled to a target spectrum. Writes tables and figures.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--out", type=Path, default=Path("study"), metavar="DIR", help="folder to write to (study)")
    add_motion_options(parser)
    building = parser.add_argument_group("buildings")
    building.add_argument("--mu", type=float, default=0.4, help="friction coefficient (0.4)")
    building.add_argument("--overstrength", type=float, default=2.0, help="Omega (2)")
    building.add_argument("--second-slope", type=float, default=0.05, help="r2, an inference, not the paper's (0.05)")
    building.add_argument("--third-slope", type=float, default=0.0, help="r3, an inference, not the paper's (0)")
    building.add_argument(
        "--yield-at-R1", action="store_true", help="let R = 1 yield at V_e instead of staying elastic"
    )
    building.add_argument(
        "--combination", choices=("srss", "cqc"), default="srss", help="modal combination of the design (srss)"
    )
    output = parser.add_argument_group("running and output")
    output.add_argument("--jobs", type=threads_option, metavar="N", help="threads (all cores); changes no digit")
    output.add_argument("--json", action="store_true", help="print the metadata and findings as JSON")
    output.add_argument("--no-figures", action="store_true", help="write tables only")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the study, write its files and print what it says; return the exit code."""
    from seismass.report.findings import findings_text
    from seismass.report.write import check_out, study_metadata, write_study
    from seismass.study import StudyParameters, motions_text, run_study

    started = time.perf_counter()
    check_out(args.out)
    parameters = StudyParameters(
        mu=args.mu,
        overstrength=args.overstrength,
        second_slope=args.second_slope,
        third_slope=args.third_slope,
        scaling_period=args.period,
        combination=args.combination,
        yield_at_r1=args.yield_at_R1,
    )
    target = read_target(args)
    suite = read_motions(args)
    result = run_study(suite, target, parameters, threads=args.jobs, progress=progress_bar())
    files = write_study(result, args.out, figures=not args.no_figures)
    metadata = study_metadata(result)
    if args.json:
        warn_left_out(suite)
        print(json.dumps(metadata, indent=2))
    else:
        counts = metadata["counts"]
        none_recorded = ", none recorded" * (metadata["suite"]["synthetic"] == len(suite))
        print(f"suite    {metadata['suite']['name']}: {motions_text(metadata['suite'])}{none_recorded}")
        for line in left_out(suite):
            print(f"         {line}")
        for motion in metadata["suite"]["motions"]:
            print(f"         {motion['motion']:>2}  x {motion['factor']:<7.4f} {motion['record']}")
            for remark in motion["remarks"]:
                print(f"{'':25}{remark}")
        print(f"target   {target.label}")
        print(
            f"runs     {counts['buildings']} buildings, {counts['analyses']} analyses, {counts['distinct']} distinct: "
            f"{counts['completed']} completed, {counts['collapsed']} collapsed, {counts['failed']} failed"
        )
        print(
            f"springs  Omega = {parameters.overstrength:g}, r2 = {parameters.second_slope:g}, "
            f"r3 = {parameters.third_slope:g} (r2, r3: not the paper's numbers)\n"
        )
        print("Underestimation of mean peak drift, (real - ASCE) / ASCE")
        print(findings_text(metadata["findings"]))
        print(f"\n{len(files)} files in {args.out}, {time.perf_counter() - started:.1f} s")
    return 1 if metadata["counts"]["failed"] else 0


def progress_bar(width: int = 30) -> Callable[[int, int], None] | None:
    """Return a callable that draws a bar on standard error, or None where that is no terminal."""
    if not sys.stderr.isatty():
        return None

    def draw(done: int, total: int) -> None:
        filled = width * done // max(total, 1)
        end = "\r\033[K" if done == total else ""
        sys.stderr.write(f"\r[{'#' * filled}{'.' * (width - filled)}] {done} of {total} runs{end}")
        sys.stderr.flush()

    return draw
