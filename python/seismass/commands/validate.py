"""`seismass validate`: the paper's section 4 by several programs, its shaking table, and its claims one by one."""

from __future__ import annotations

import argparse

from seismass.commands.frame import Command, give_answer, progress
from seismass.commands.options import (
    add_answer_options,
    add_records_options,
    add_target_options,
    read_motions,
    read_target,
)
from seismass.commands.parser import RUNS


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    motions = parser.add_argument_group("motions")
    add_records_options(motions)
    add_target_options(motions)
    output = add_answer_options(parser)
    output.add_argument(
        "--sensitivity", action="store_true", help="add what each choice of the study changes: some seconds"
    )


def run(args: argparse.Namespace) -> int:
    """Run the validations, write their files and print what they say; return the exit code."""
    from seismass.studies.study import study_sensitivity
    from seismass.studies.validation import validate

    target = read_target(args)
    suite = read_motions(args, "seven")
    sensitivity = None
    if args.sensitivity:
        with progress("studies") as tell:
            sensitivity = study_sensitivity(suite, target, threads=args.jobs, progress=tell)
    with progress() as tell:
        result = validate(suite, target, sensitivity=sensitivity, threads=args.jobs, progress=tell)
    give_answer(args, result, suite, answer=r" ?\d+  \S")
    return 0


COMMAND = Command(
    description=(
        "Solve the paper's section 4 with the exact kernel, with friction springs and, from kept results, "
        "with OpenSees; its shaking table over ranges of the unpublished parameters; and the parametric study. Print "
        "each claim of the paper with its verdict."
    ),
    examples="""
validate
validate --records paper_seven.csv --out validation
validate --records records/ --sensitivity --json > validation.json
""",
    options=options,
    run=run,
    note="""
Recordings of Brawley Airport and Erzincan (RSN161 and RSN821) are found in --records by their station, and other
components of them in the same folder. Built-in motions stand in where there are none, and the output says so.
""",
    codes=RUNS,
)
