"""`seismass study`: the paper's parametric study, its tables and figures, and what they say about the paper's claim."""

from __future__ import annotations

import argparse
import json
import os
from concurrent.futures import CancelledError, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING

from seismass._kernel import VERSION
from seismass.commands.frame import Command, print_answer, progress, write_answer
from seismass.commands.options import (
    CODE_HELP,
    SPRING_OPTIONS,
    add_answer_options,
    add_drift_cap_option,
    add_motion_options,
    add_spring_options,
    arguments,
    numbers_option,
    positive_option,
    read_motions,
    read_target,
)
from seismass.commands.parser import DONE, FAILED, tell

if TYPE_CHECKING:
    from seismass.base.stored_results import StoredResults
    from seismass.motions.records import Suite
    from seismass.motions.spectra import TargetSpectrum
    from seismass.studies.study import StudyParameters, StudyResult


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_motion_options(parser)
    building = parser.add_argument_group("buildings and their models")
    building.add_argument("--code", default="asce7-10", metavar="ID", help=f"{CODE_HELP} (asce7-10)")
    building.add_argument(
        "--occupancy",
        action="append",
        type=occupancy_option,
        metavar="NAME:LAMBDA[:ANALYSIS]",
        help="occupancy with its fraction of the live load in the design, and in the analysis where that differs; "
        "repeat it for several (those of the code)",
    )
    building.add_argument(
        "--mu", type=numbers_option(), default=(0.4,), metavar="LIST", help="friction coefficients (0.4)"
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
    add_drift_cap_option(building)
    output = add_answer_options(parser, "study", "study")
    output.add_argument(
        "--effective", action="store_true", help="compute the effective fraction of each building too: some seconds"
    )
    output.add_argument(
        "--sensitivity", action="store_true", help="run the study again with each choice changed alone: some seconds"
    )
    output.add_argument("--png", action="store_true", help="write the figures as PNG, too")


def run(args: argparse.Namespace) -> int:
    """Run the study, write its files and print what it says; return the exit code."""
    from seismass.base.stored_results import result_store
    from seismass.runs.simulate import instruction_set
    from seismass.studies.study import StudyParameters
    from seismass.studies.study.run import study_digest

    choices = ("code", "mu", "damping_base", "combination", "height", "p_delta", "collapse_drift_ratio", "drift_cap")
    renamed = {"scaling_period": "period", "yield_at_r1": "yield_at_R1"}
    parameters = StudyParameters(
        **arguments(args, *choices, *SPRING_OPTIONS, **renamed),
        occupancies=None if args.occupancy is None else tuple(args.occupancy),
    )
    target = read_target(args)
    suite = read_motions(args, "seven")
    inputs = f"{study_digest(suite, target, parameters)} {VERSION} {instruction_set()}"
    args.out.parent.mkdir(parents=True, exist_ok=True)
    with result_store(args.out.parent, args.out.name, inputs) as store:
        answer = _Answer(_solved(args, suite, target, parameters, store), args.png)
        files = write_answer(args, answer)
    metadata = answer.study.metadata
    if args.json:
        for remark in metadata["remarks"]:
            tell(remark)
    print_answer(args, answer, suite, files, indent=9, answer="  largest underestimation")
    return FAILED if metadata["counts"]["failed"] else DONE


def _solved(
    args: argparse.Namespace,
    suite: Suite,
    target: TargetSpectrum,
    parameters: StudyParameters,
    store: StoredResults,
) -> StudyResult:
    """Run the study, and what is asked for besides."""
    from seismass.show.study.tables import completed
    from seismass.studies.study import run_study, study_sensitivity
    from seismass.studies.study.run import study_example
    from seismass.studies.validation import paper_scenes, validate
    from seismass.studies.validation.three_storeys import SPRINGS

    stopped = Event()

    def refuse_run(done: int, total: int) -> None:
        if stopped.is_set():
            raise CancelledError

    # The scenes of section 4 keep one core busy, and what is solved meanwhile the others. The stiffest friction springs
    # are left to `seismass validate`: they take four times as long as all others.
    with ThreadPoolExecutor(1) as pool:
        try:
            scenes = pool.submit(paper_scenes, suite, springs=SPRINGS[:-1], progress=refuse_run)
            with progress() as tell:
                result = run_study(
                    suite, target, parameters, effective=args.effective, threads=args.jobs, progress=tell, store=store
                )
            sensitivity = None
            if args.sensitivity:
                with progress("studies") as tell:
                    sensitivity = study_sensitivity(
                        suite, target, parameters, as_is=result, threads=args.jobs, progress=tell, store=store
                    )
            validation = validate(suite, study=result, sensitivity=sensitivity, scenes=scenes.result())
        finally:
            stopped.set()
    example = study_example(suite, parameters, result)
    return completed(result, sensitivity=sensitivity, validation=validation, example=example)


@dataclass(frozen=True)
class _Answer:
    """A study with what was made of it besides, as it is printed and written."""

    study: StudyResult
    png: bool

    @property
    def text(self) -> str:
        from seismass.show.study.answer import findings_text
        from seismass.show.study.write import inputs_text, sensitivity_text

        study = self.study.to_dict()
        head = f"Underestimation of capped mean drift, (goods slide - code) / code, code: {study['code']['name']}"
        table = self.study.sensitivity
        changed = f"\n\nOne choice changed at a time\n{sensitivity_text(table)}" if table.height else ""
        return f"{inputs_text(study)}\n\n{head}\n{findings_text(study['findings'])}{changed}"

    def to_json(self) -> str:
        return json.dumps(self.study.to_dict(), indent=2)

    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        from seismass.show.study.write import write_study

        with progress("figures") as tell:
            return write_study(self.study, Path(folder), figures=figures, png=self.png, progress=tell)


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


COMMAND = Command(
    description=(
        "Run the parametric study of the paper: 72 buildings, each with sliding blocks, by a code's rule "
        "and with all of the blocks attached, under motions scaled to a target spectrum. Writes tables, figures and "
        "a page."
    ),
    examples="""
study
study --records my_records/ --target uniform_hazard.csv --out results
study --records suite.csv --second-slope 0.1 --no-figures --json > study.json
study --code ec8 --mu 0.2,0.4 --effective
study --occupancy archive:0.25:1.0 --p-delta --collapse-drift-ratio 0.1 --sensitivity
""",
    options=options,
    run=run,
    codes={1: "a run failed (its rows say why)"},
)
