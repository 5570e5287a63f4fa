"""`seismass study`: the paper's parametric study, its tables and figures, and what they say about the paper's claim."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seismass._kernel import VERSION
from seismass.commands.options import (
    SPRING_OPTIONS,
    add_motion_options,
    add_spring_options,
    left_out,
    positive_option,
    read_motions,
    read_target,
    threads_option,
    warn_left_out,
)

if TYPE_CHECKING:
    from seismass.records import Suite

_EPILOG = """examples:
  seismass study
  seismass study --records my_records/ --target uniform_hazard.csv --out results
  seismass study --records suite.csv --second-slope 0.1 --no-figures --json > study.json
  seismass study --code ec8 --mu 0.2,0.4 --effective
  seismass study --occupancy archive:0.25:1.0 --p-delta --collapse-drift-ratio 0.1 --sensitivity

exit codes: 0 done, 1 a run failed (its rows say why), 2 bad input"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "study",
        help=help,
        description="Run the parametric study of the paper: 72 buildings, each with sliding blocks, by a code's rule "
        "and with all of the blocks attached, under motions scaled to a target spectrum. Writes tables, figures and "
        "a page.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--out", type=Path, default=Path("study"), metavar="DIR", help="folder to write to (study)")
    add_motion_options(parser)
    building = parser.add_argument_group("buildings and their models")
    building.add_argument(
        "--code", default="asce7-10", metavar="ID", help="code whose fractions are compared: asce7-10, ec8, nbc, ..."
    )
    building.add_argument(
        "--occupancy",
        action="append",
        type=occupancy_option,
        metavar="NAME:LAMBDA[:ANALYSIS]",
        help="occupancy with its fraction of the live load in the design, and in the analysis where that differs; "
        "repeat it for several (those of the code)",
    )
    building.add_argument(
        "--mu", type=numbers_option, default=(0.4,), metavar="MU[,MU...]", help="friction coefficients (0.4)"
    )
    add_spring_options(building)
    building.add_argument(
        "--damping-base",
        choices=("bare", "loaded", "own"),
        default="bare",
        help="modes that are damped by 5 %%: of the bare building or of the building with all its goods, one matrix C "
        "for all models, or each model's own (bare)",
    )
    building.add_argument(
        "--yield-at-R1", action="store_true", help="let R = 1 yield at V_e instead of staying elastic"
    )
    building.add_argument(
        "--combination", choices=("srss", "cqc"), default="srss", help="modal combination of the design (srss)"
    )
    building.add_argument("--height", type=positive_option, default=3.5, metavar="M", help="storey height, m (3.5)")
    building.add_argument(
        "--p-delta", action="store_true", help="second-order effect of the weight of building and goods"
    )
    building.add_argument(
        "--collapse-drift-ratio", type=positive_option, metavar="RATIO", help="drift over height that is a collapse"
    )
    output = parser.add_argument_group("running and output")
    output.add_argument(
        "--effective", action="store_true", help="compute the effective fraction of each building too: some seconds"
    )
    output.add_argument(
        "--sensitivity", action="store_true", help="run the study again with each choice changed alone: some seconds"
    )
    output.add_argument("--jobs", type=threads_option, metavar="N", help="threads (all cores); changes no digit")
    output.add_argument("--json", action="store_true", help="print the metadata and findings as JSON")
    output.add_argument("--no-figures", action="store_true", help="write tables only, no figures and no page")
    output.add_argument("--png", action="store_true", help="write the figures as PNG, too")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the study, write its files and print what it says; return the exit code."""
    from seismass.base.kept import kept_folder
    from seismass.media.folder import PAGE, check_out, folder_for
    from seismass.runs.simulate import instruction_set
    from seismass.show.study.findings import findings_text
    from seismass.show.study.sensitivity import sensitivity_text
    from seismass.show.study.tables import study_tables
    from seismass.show.study.write import write_study
    from seismass.study import StudyParameters, run_study, study_sensitivity
    from seismass.study.example import study_example
    from seismass.study.run import inputs_digest
    from seismass.validation import paper_scenes, validate
    from seismass.validation.three_storeys import SPRINGS

    started = time.perf_counter()
    check_out(args.out, "study")
    parameters = StudyParameters(
        code=args.code,
        occupancies=None if args.occupancy is None else tuple(args.occupancy),
        mu=args.mu,
        **{name: getattr(args, name) for name in SPRING_OPTIONS if getattr(args, name) is not None},
        damping_base=args.damping_base,
        scaling_period=args.period,
        combination=args.combination,
        yield_at_r1=args.yield_at_R1,
        height=args.height,
        p_delta=args.p_delta,
        collapse_drift_ratio=args.collapse_drift_ratio,
    )
    target = read_target(args)
    suite = read_motions(args)
    # The scenes of section 4 keep one core busy, and what is solved meanwhile the others. The stiffest friction springs
    # are left to `seismass validate`: they take four times as long as all others.
    inputs = f"{inputs_digest(suite, target, parameters)} {VERSION} {instruction_set()}"
    with folder_for(args.out), kept_folder(args.out, "study", inputs) as kept, ThreadPoolExecutor(1) as pool:
        scenes = pool.submit(paper_scenes, suite, springs=SPRINGS[:-1])
        result = run_study(
            suite, target, parameters, effective=args.effective, threads=args.jobs, progress=progress_bar(), kept=kept
        )
        sensitivity = (
            study_sensitivity(
                suite,
                target,
                parameters,
                as_is=result,
                threads=args.jobs,
                progress=progress_bar(unit="studies"),
                kept=kept,
            )
            if args.sensitivity
            else None
        )
        validation = validate(suite, study=result, sensitivity=sensitivity, scenes=scenes.result())
        tables = study_tables(
            result,
            sensitivity=sensitivity,
            validation=validation,
            example=study_example(suite, parameters, result),
        )
        files = write_study(tables, args.out, figures=not args.no_figures, png=args.png)
    metadata = tables.metadata
    page = "" if args.no_figures else f", the page is {args.out / PAGE}"
    if args.json:
        warn_left_out(suite)
        for remark in metadata["remarks"]:
            print(f"seismass: {remark}", file=sys.stderr)
        print(json.dumps(metadata, indent=2))
    else:
        _print_inputs(suite, metadata)
        print(f"Underestimation of mean peak drift, (real - code) / code, code: {metadata['code']['name']}")
        print(findings_text(metadata["findings"]))
        if sensitivity is not None:
            print(f"\nOne choice changed at a time\n{sensitivity_text(sensitivity.table)}")
        print(f"\n{len(files)} files in {args.out}{page}, {time.perf_counter() - started:.1f} s")
    return 1 if metadata["counts"]["failed"] else 0


def _print_inputs(suite: Suite, metadata: dict[str, Any]) -> None:
    """Print the motions and what the numbers depend on."""
    from seismass.show.study.words import DAMPING_TEXTS
    from seismass.study import motions_text

    counts, chosen = metadata["counts"], metadata["parameters"]
    none_recorded = ", none recorded" * (metadata["suite"]["synthetic"] == len(suite))
    print(f"suite    {metadata['suite']['name']}: {motions_text(metadata['suite'])}{none_recorded}")
    for line in left_out(suite):
        print(f"         {line}")
    for motion in metadata["suite"]["motions"]:
        print(f"         {motion['motion']:>2}  x {motion['factor']:<7.4f} {motion['record']}")
        for remark in motion["remarks"]:
            print(f"{'':25}{remark}")
    print(f"target   {metadata['target']['label']}")
    print(
        f"runs     {counts['buildings']} buildings, {counts['analyses']} analyses, {counts['distinct']} distinct: "
        f"{counts['completed']} completed, {counts['collapsed']} collapsed, {counts['failed']} failed"
    )
    print(
        f"springs  Omega = {chosen['overstrength']:g}, r2 = {chosen['second_slope']:g}, "
        f"r3 = {chosen['third_slope']:g} (r2, r3: not the paper's numbers)"
    )
    print(f"damping  {100.0 * chosen['damping']:g} %, {DAMPING_TEXTS[chosen['damping_base']]}")
    for name, row in metadata["code"]["fractions"].items():
        print(
            f"code     {metadata['code']['name']}, {name}: {row['fraction']:g} of the live load "
            f"({', '.join(part for part in (row['clause'], row['status']) if part)})"
        )
    for remark in metadata["remarks"]:
        print(f"remark   {remark}")
    print()


def occupancy_option(text: str) -> tuple[str, float, float]:
    """Return the name of an occupancy with the fractions of design and analysis."""
    name, *fractions = text.split(":")
    try:
        numbers = [float(fraction) for fraction in fractions]
    except ValueError:
        numbers = []
    if not name or len(numbers) not in (1, 2):
        raise argparse.ArgumentTypeError(f"must be NAME:LAMBDA or NAME:LAMBDA:LAMBDA; got {text!r}")
    return name, numbers[0], numbers[-1]


def numbers_option(text: str) -> tuple[float, ...]:
    """Return numbers separated by commas."""
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be numbers separated by commas; got {text!r}") from None


def progress_bar(width: int = 30, unit: str = "runs") -> Callable[[int, int], None] | None:
    """Return a callable that draws a bar on standard error, or None where that is no terminal."""
    if not sys.stderr.isatty():
        return None

    def draw(done: int, total: int) -> None:
        filled = width * done // max(total, 1)
        end = "\r\033[K" if done == total else ""
        sys.stderr.write(f"\r[{'#' * filled}{'.' * (width - filled)}] {done} of {total} {unit}{end}")
        sys.stderr.flush()

    return draw
