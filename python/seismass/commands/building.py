"""`seismass building FILE`: how much of your building's live load to count as mass, its drifts and slips."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seismass.base.errors import InvalidOption, MissingPackage
from seismass.base.files import write_file
from seismass.commands.frame import Command, print_answer, progress, show
from seismass.commands.options import (
    add_answer_options,
    add_code_options,
    add_drift_cap_option,
    add_opensees_option,
    add_output_option,
    add_period_option,
    add_records_options,
    add_target_options,
    arguments,
    numbers_option,
    read_code,
    read_motions,
    read_pairs,
    read_site,
    refuse_options,
)

if TYPE_CHECKING:
    from seismass.assessment import Assessment


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("file", type=Path, nargs="?", metavar="FILE", help="building file, .toml or .json")
    what.add_argument("--example", action="store_true", help="print a building file to start from, and stop")
    what.add_argument("--codes", action="store_true", help="print the codes and their fractions, and stop")
    what.add_argument("--frictions", action="store_true", help="print the contacts and their friction, and stop")
    what.add_argument(
        "--occupancies", action="store_true", help="print what surveys find on floors, over design loads, and stop"
    )
    motions = parser.add_argument_group("motions and site, in place of the file's")
    add_records_options(motions)
    add_target_options(motions, stand_in=False)
    period = "motions are scaled from 0.2 T to 1.5 T (first period with the goods attached)"
    add_period_option(motions, None, period)
    choices = parser.add_argument_group("code, friction and drift cap, in place of the file's")
    add_code_options(choices)
    choices.add_argument(
        "--mu-factors",
        type=numbers_option(2, above=0.0),
        metavar="LOW,HIGH",
        help="bounds of friction as factors (0.67,1.5); 1,1 leaves them out",
    )
    add_drift_cap_option(choices)
    # A folder of its own for each building, so that a second never replaces the first.
    add_answer_options(
        parser, "the name of FILE", lambda args: Path(args.file.stem) if args.file and args.file.stem else None
    )
    show_help = "units of page, figures, text and analysis.csv (those of FILE)"
    parser.add_argument("--show", choices=("si", "us"), help=show_help)
    add_opensees_option(parser, "the building, with goods that slide and of both analyses")
    back = parser.add_argument_group("into another program")
    lines = "write the mass sources of both analyses as lines of ETABS (.e2k) or SAP2000 (.s2k)"
    add_output_option(back, "FILE", lines, flag="--mass-source", suffixes=(".e2k", ".s2k"))
    back.add_argument("--live-pattern", metavar="NAME", help="load pattern of the design live load there (Live)")


def run(args: argparse.Namespace) -> int:
    """Assess the building, write its files and print the page; return the exit code."""
    if args.example or args.codes or args.frictions or args.occupancies:
        if args.example:
            print(_listing(args), end="")
        else:
            show(_listing(args).removesuffix("\n"))
        return 0
    from seismass.assessment import assess
    from seismass.assessment.building_file import read_building
    from seismass.assessment.mass_source import mass_source_lines
    from seismass.assessment.run import write_models
    from seismass.show.assessment.text import write_with

    if args.mass_source is None:
        refuse_options(args, ("live_pattern",), "building", "where --mass-source is not given")
    building = read_building(args.file)
    building = replace(building, units=args.show or building.units)
    code, target = read_code(args, "building"), read_site(args, "building")
    in_plane = building.other is not None
    if in_plane and args.opensees is not None:
        raise InvalidOption(f"--opensees of building must be left out in two directions; got {args.opensees}")
    suite: Any = read_pairs(args) if in_plane else read_motions(args)
    with progress() as tell:
        result = assess(
            building,
            suite,
            target,
            code=code,
            progress=tell,
            **arguments(args, "mu_factors", "drift_cap", scaling_period="period", threads="jobs"),
        )
    if args.opensees is not None:
        write_models(args.opensees, result, suite)
    if args.mass_source is not None:
        suffix = args.mass_source.suffix.lower()
        lines = mass_source_lines(result.answer, building, suffix, args.live_pattern or "Live")
        write_file(args.mass_source, lines)
    files = write_with(result, args.out, {} if args.no_figures else _live_page(result), figures=not args.no_figures)
    print_answer(args, result, suite, files, answer=r"ANSWER| {10}[12]  ")
    return 0


def _live_page(result: Assessment) -> dict[str, str]:
    """The live page, to which the page links, where it can show the building and the package has its kernel."""
    from seismass.media.page import PAGE
    from seismass.show.assessment.page_input import live_case
    from seismass.show.explore import explorer_html

    if live_case(result).case is None:
        return {}
    try:
        return {PAGE: explorer_html()}
    except MissingPackage:
        return {}


def _listing(args: argparse.Namespace) -> str:
    """Return the example file, or the requested table."""
    if args.example:
        from seismass.assessment.building_file import example_file

        return example_file().read_text(encoding="utf-8")
    from seismass.commands.listings import codes_listing, frictions_listing, occupancies_listing

    if args.codes:
        return codes_listing()
    return occupancies_listing() if args.occupancies else frictions_listing()


COMMAND = Command(
    description=(
        "Assess the building of a file (TOML or JSON): the share of its live load that acts as mass, with "
        "goods that slide, the code's share attached, all attached and none. Prints the answer and writes tables, "
        "figures and a page for the calculation folder."
    ),
    examples="""
building --example > warehouse.toml
building warehouse.toml
building warehouse.toml --records my_records/ --out warehouse
building warehouse.toml --opensees warehouse_models
building warehouse.toml --mass-source warehouse.e2k --live-pattern Storage
building warehouse.toml --sds 0.8 --sd1 0.5
building warehouse.toml --show us
building warehouse.toml --target ec8:1:C:0.3 --code ec8
building warehouse.toml --mu-factors 1,1 --json > answer.json
building --codes
building --frictions
building --occupancies
""",
    options=options,
    run=run,
    note="""
docs/building_file.md explains every key of a building file. analysis.csv, beside the page and the OpenSees models, has
what is typed into another program: floor masses and weights of both analyses, and multipliers of the live load.
""",
    codes={0: "done (a collapse is a result)", 1: "a run failed"},
)
