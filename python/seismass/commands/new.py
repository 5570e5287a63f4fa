"""`seismass new`: a building file from ten questions, from options, or from another program's tables and curves."""

from __future__ import annotations

import argparse
import signal
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from seismass.base.errors import InvalidBuildingFile, InvalidOption
from seismass.base.files import check_files, write_file
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import refusal
from seismass.commands.frame import Command, show, write_figure
from seismass.commands.options import refuse_options

if TYPE_CHECKING:
    from seismass.assessment.storey_table import StoreyTable

_OPTIONS = {
    "name": ("TEXT", "name of the building"),
    "storeys": ("N", "number of storeys"),
    "height": ("M", "storey height, m"),
    "area": ("M2", "floor area, m2"),
    "dead_load": ("KPA", "weight of a floor with its share of walls and frame, kPa"),
    "period": ("S", "first period without goods, s"),
    "sds": ("G", "S_DS of the site, g"),
    "sd1": ("G", "S_D1 of the site, g"),
    "reduction": ("R", "R (or q) by which strengths are designed"),
    "live_load": ("KPA", "design live load of the loaded floors, kPa; the roof has none"),
    "occupied": ("SHARE", "share of the design live load that is present, 0 to 1"),
    "friction": ("MU", "friction of the goods: a number, or a contact of `seismass building --frictions`"),
    "goods_size": ("BxH", "width and height of one of them, m; left out: they slide and do not tip"),
}


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument("out", type=Path, metavar="FILE", help="building file to write, .toml")
    answers = parser.add_argument_group("answers, asked for on a terminal where they are left out")
    for name, (metavar, text) in _OPTIONS.items():
        answers.add_argument(f"--{name.replace('_', '-')}", metavar=metavar, help=text)
    table = parser.add_argument_group("storeys of another program")
    table.add_argument(
        "--from",
        dest="table",
        type=Path,
        action="append",
        metavar="TABLE",
        help="storey table as ETABS exports it: text or .xlsx, all sheets; given several times, joined by storey",
    )
    table.add_argument("--case", metavar="NAME", help="load case of its stiffnesses, where there are several")
    table.add_argument(
        "--mass-includes",
        metavar="SHARE",
        help="share of the live load in the masses of TABLE, taken off them: 0.25, or the mass source '1.0 D + 0.25 L'",
    )
    table.add_argument(
        "--base-level", metavar="LEVEL", help="elevation (m) or floor at which the building is held; or lowest"
    )
    table.add_argument(
        "--loaded", action="append", metavar="NAME", help="roof or penthouse that carries goods; several times for more"
    )
    table.add_argument("--units", metavar="F-L", help="force and length of its numbers without a unit: kN-m, kip-in")
    table.add_argument("--decimal", choices=("comma", "point"), help="decimal mark, where no number shows it (1,204)")
    table.add_argument(
        "--order", choices=("roof-first", "ground-first"), help="order of its rows, where they do not say it"
    )
    table.add_argument(
        "--direction", choices=("x", "y"), default="x", help="which of Stiff X and Y, UX and UY is read (x)"
    )
    push = parser.add_argument_group("springs fitted to pushover curves; units and order as above")
    push.add_argument(
        "--pushover",
        type=Path,
        metavar="CURVES",
        help="shears over drifts, text or .xlsx: of the roof, or with a column of storeys; draws the fit beside FILE",
    )
    push.add_argument("--pushover-case", metavar="NAME", help="load case of the curves, where there are several")
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
    from seismass.assessment.answer import doubt_lines
    from seismass.assessment.building_file import read_building
    from seismass.assessment.doubts import building_doubts
    from seismass.assessment.new_file import MASS_INCLUDES, QUESTIONS, building_text, fit_of_curves, questions_for
    from seismass.assessment.pushover_file import read_pushover
    from seismass.assessment.storey_table import read_storey_table

    if args.out.suffix.lower() != ".toml":
        raise refusal(InvalidOption, "file", "new", "one with the suffix .toml", str(args.out))
    if args.out.exists() and not args.force:
        raise refusal(InvalidOption, "file", "new", "one that does not exist, or --force be given", str(args.out))
    check_files(args.out)
    if args.table is None:
        refuse_options(args, ("mass_includes", "base_level", "loaded", "case"), "new", "where --from is not given")
    if args.pushover is None:
        refuse_options(args, ("pushover_case",), "new", "where --pushover is not given")
        if args.table is None:
            neither = "where neither --from nor --pushover is given"
            refuse_options(args, ("units", "order", "decimal"), "new", neither)
    reading = {name: getattr(args, name) for name in ("units", "order", "direction", "decimal")}
    table = curves = None
    try:
        if args.table is not None:
            table = read_storey_table(args.table, case=args.case, base_level=args.base_level, **reading)
            show(table.text)
        if args.pushover is not None:
            curves = read_pushover(args.pushover, case=args.pushover_case, **reading)
            show(curves.text)
    except (InvalidBuildingFile, InvalidOption) as error:
        raise type(error)(f"{error}{_lacking(args)}") from error
    answers: dict[str, Any] = {}
    questions = questions_for(table, curves)
    known = [one.name for one in QUESTIONS if one not in questions and one is not MASS_INCLUDES]
    refuse_options(args, known, "new", "where the tables or curves have it")
    for question in questions:
        value = getattr(args, question.name)
        if value is None and sys.stdin.isatty():
            answers[question.name] = _asked(question)
        elif value is not None or question.default:
            answers[question.name] = question.answer(question.default if value is None else value)
    if table is not None and args.mass_includes is not None and "mass_includes" not in answers:
        if table.mass is None:
            raise refusal(
                InvalidOption, "mass_includes", "new", "left out: the tables have no masses", args.mass_includes
            )
        answers["mass_includes"] = MASS_INCLUDES.answer(args.mass_includes)
    fit = None
    if curves is not None:
        shape: Literal["bilinear", "trilinear"] = "bilinear" if args.lines == 2 else "trilinear"
        fit = fit_of_curves(curves, answers, table, shape=shape, pattern=args.forces)
    text = building_text(answers, table, curves, fit, args.loaded or ())
    building = read_building(tomllib.loads(text))  # refused before anything is written
    doubts = building_doubts(building, building.scene(building.target), building.target)
    for line in (*_table_lines(table, answers, args.loaded or ()), *doubt_lines(doubts)):
        show(line)
    write_file(args.out, text)
    if fit is not None:
        figure = args.out.with_name(f"{args.out.stem}_pushover.png")
        write_figure(fit.plot(), figure)
        show(f"{fit.text}\n{figure} is drawn")
    show(f"{args.out} is written: look at it, then run\n  seismass building {args.out}")
    return 0


def _lacking(args: argparse.Namespace) -> str:
    """Return which answers that no table gives are left out, so that they are said with what is wrong in a file."""
    from seismass.assessment.new_file import NEVER_IN_TABLES, QUESTIONS

    asked = () if sys.stdin.isatty() else tuple(one for one in QUESTIONS if getattr(args, one.name) is None)
    options = [one.option for one in asked if one.name in NEVER_IN_TABLES]
    masses = args.table is not None and any(one.name == "mass_includes" for one in asked)
    missing = [", ".join(options)] * bool(options) + ["--mass-includes where there are masses"] * masses
    return f"; to be given too: {', and '.join(missing)}" if missing else ""


def _table_lines(table: StoreyTable | None, answers: dict[str, Any], loaded: Sequence[str]) -> list[str]:
    """What is made of a table: weights over the area, the live load in its masses, and floors without goods."""
    from seismass.assessment.new_file import bare_floors, bare_mass

    if table is None:
        return []
    lines, bare = [], bare_floors(table.names, loaded)
    mass = bare_mass(table, answers, bare)
    if mass is not None:
        loads = 1e-3 * STANDARD_GRAVITY * mass / answers["area"]
        included = answers.get("mass_includes", 0.0)
        off = 0.0 if table.mass is None else float((table.mass - mass).max())
        lines.append(
            f"  {included:g} of the live load, {1e-3 * off:.4g} t, is taken off the masses of each loaded floor"
            if included > 0.0
            else "  masses are taken as those without live load; --mass-includes takes off a share of it"
        )
        written = ", ".join(f"{name} {1e-3 * each:.6g}" for name, each in zip(table.names, mass, strict=True))
        lines.append(f"  masses written (t): {written}")
        lines.append(f"  floors then weigh {min(loads):.3g} to {max(loads):.3g} kPa over {answers['area']:g} m2")
    without = [name for name, each in zip(table.names, bare, strict=True) if each]
    if without:
        lines.append(f"  no goods on {', '.join(without)}: roofs and penthouses; --loaded NAME puts goods there")
    return lines


def _asked(question: Any) -> Any:
    """Ask until there is an answer that can be read. With the handler of polars alone Ctrl-C would wait for Enter."""
    if hasattr(signal, "siginterrupt"):
        signal.siginterrupt(signal.SIGINT, True)
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
new own.toml --from definitions.csv --from masses.csv --from stiffnesses.csv --case EQX --mass-includes 0.25
new own.toml --from storeys.csv --area 1200 --sds 1.0 --sd1 0.6 --live-load 7.2 --friction 0.3
new shed.toml --from storeys.csv --pushover push.csv --area 1200 --sds 1 --sd1 0.6 --live-load 7.2 --friction 0.3
""",
    options=options,
    run=run,
    note="""
A storey table has a column for storeys and others among elevation, height, mass, weight, stiffness, yield shear, shear
and drift, with units in its head or in a row below, roof or ground first: text, s2k and e2k, or all sheets of a
workbook. Several are joined by the names of storeys. What is read and what is left out is printed. Pushover curves have
a column of drifts and one of shears; a curve of the roof is shared among storeys by assumptions that are printed.
""",
)
