"""`seismass new`: a building file from ten questions, from options, or from another program's tables and curves."""

from __future__ import annotations

import argparse
import sys
import tomllib
from pathlib import Path
from typing import Any, Literal

from seismass.commands.answer_output import write_figure
from seismass.commands.frame import Command, show
from seismass.commands.options import check_files

_OPTIONS = {
    "name": ("TEXT", "name of the building"),
    "storeys": ("N", "number of storeys"),
    "height": ("M", "storey height, m"),
    "area": ("M2", "floor area, m2"),
    "dead_load": ("KPA", "weight of a floor with its share of walls and frame, kPa"),
    "period": ("S", "first period without goods, s"),
    "sds": ("G", "S_DS of the site, g"),
    "sd1": ("G", "S_D1 of the site, g"),
    "reduction": ("R", "R by which strengths are designed"),
    "live_load": ("KPA", "design live load of the loaded floors, kPa; the roof has none"),
    "occupied": ("SHARE", "share of it that is present"),
    "friction": ("MU", "friction of the goods: a number, or a contact of `seismass building --frictions`"),
}


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument("out", type=Path, metavar="FILE", help="building file to write, .toml")
    answers = parser.add_argument_group("answers, asked for on a terminal where they are left out")
    for name, (metavar, text) in _OPTIONS.items():
        answers.add_argument(f"--{name.replace('_', '-')}", metavar=metavar, help=text)
    table = parser.add_argument_group("storeys of another program")
    table.add_argument(
        "--from", dest="table", type=Path, metavar="TABLE", help="storey table, .csv or .xlsx, as ETABS exports it"
    )
    table.add_argument("--units", metavar="F-L", help="force and length of its numbers without a unit: kN-m, kip-in")
    table.add_argument(
        "--order", choices=("roof-first", "ground-first"), help="order of its rows, where they do not say it"
    )
    table.add_argument("--direction", choices=("x", "y"), default="x", help="direction of its columns (x)")
    push = parser.add_argument_group("springs fitted to pushover curves; units and order as above")
    push.add_argument(
        "--pushover",
        type=Path,
        metavar="CURVES",
        help="shears over drifts, .csv or .xlsx: of the roof, or with a column of storeys; draws the fit beside FILE",
    )
    push.add_argument("--lines", type=int, choices=(2, 3), default=2, help="straight lines of a spring (2)")
    push.add_argument(
        "--forces",
        choices=("triangular", "uniform"),
        default="triangular",
        help="lateral forces of a curve of the roof: mass times height (triangular) or mass",
    )
    parser.add_argument("--force", action="store_true", help="replace FILE where it exists")


def run(args: argparse.Namespace) -> int:
    """Ask, write the file and say what comes next; return the exit code."""
    from seismass.assessment.building_file import read_building
    from seismass.assessment.new_file import building_text, fit_of_curves, questions_for, weight_per_area
    from seismass.assessment.pushover_file import read_pushover
    from seismass.assessment.storey_table import read_storey_table
    from seismass.base.errors import InvalidOption
    from seismass.base.files import written_whole
    from seismass.base.values import refusal

    if args.out.suffix.lower() != ".toml":
        raise refusal(InvalidOption, "file", "new", "one with the suffix .toml", str(args.out))
    if args.out.exists() and not args.force:
        raise refusal(InvalidOption, "file", "new", "one that does not exist, or --force be given", str(args.out))
    check_files(args.out)
    table = None
    if args.table is not None:
        table = read_storey_table(args.table, units=args.units, order=args.order, direction=args.direction)
        show(table.text)
    curves = None
    if args.pushover is not None:
        curves = read_pushover(args.pushover, units=args.units, order=args.order, direction=args.direction)
        show(curves.text)
    answers: dict[str, Any] = {}
    for question in questions_for(table, curves):
        value = getattr(args, question.name)
        if value is None and sys.stdin.isatty():
            answers[question.name] = _asked(question)
        elif value is not None or question.default:
            answers[question.name] = question.answer(question.default if value is None else value)
    fit = None
    if curves is not None:
        shape: Literal["bilinear", "trilinear"] = "bilinear" if args.lines == 2 else "trilinear"
        fit = fit_of_curves(curves, answers, table, shape=shape, pattern=args.forces)
    text = building_text(answers, table, curves, fit)
    read_building(tomllib.loads(text))  # refused before anything is written
    with written_whole(args.out) as place:
        place.write_text(text, encoding="utf-8")
    if table is not None and (loads := weight_per_area(table, answers["area"])) is not None:
        show(f"  floors weigh {min(loads):.3g} to {max(loads):.3g} kPa over {answers['area']:g} m2")
    if fit is not None:
        figure = args.out.with_name(f"{args.out.stem}_pushover.png")
        write_figure(fit.plot(), figure)
        show(f"{fit.text}\n{figure} is drawn")
    show(f"{args.out} is written: look at it, then run\n  seismass building {args.out}")
    return 0


def _asked(question: Any) -> Any:
    """Ask until there is an answer that can be read."""
    from seismass.base.errors import InvalidOption

    while True:
        default = f" [{question.default}]" if question.default else ""
        try:
            text = input(f"{question.words}{default} ").strip()
        except EOFError:
            raise KeyboardInterrupt from None
        try:
            return question.answer(text or question.default)
        except InvalidOption:
            print(f"  {question.must}, please")


COMMAND = Command(
    description=(
        "Write a building file: from questions on a terminal, from options, or from a storey table that ETABS, SAP2000 "
        "or another program exports, with the rest asked for or given by options. Pushover curves give the springs."
    ),
    examples="""
new warehouse.toml
new own.toml --from storeys.csv --units kN-m
new own.toml --from storeys.csv --area 1200 --sds 1.0 --sd1 0.6 --live-load 7.2 --friction 0.3
new shed.toml --from storeys.csv --pushover push.csv --area 1200 --sds 1 --sd1 0.6 --live-load 7.2 --friction 0.3
""",
    options=options,
    run=run,
    note="""
A storey table has a column for storeys and others among elevation, height, mass, weight, stiffness, yield shear, shear
and drift, with units in its head or in a row below, roof or ground first. What is read is printed. Pushover curves have
a column of drifts and one of shears; a curve of the roof is shared among storeys by assumptions that are printed.
""",
)
