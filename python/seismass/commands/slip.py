"""`seismass slip FILE`: how far goods slide, whether they reach an edge or a wall, and whether they slide or rock."""

from __future__ import annotations

import argparse
from functools import partial
from typing import TYPE_CHECKING, Any

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, refusal
from seismass.commands.frame import Command, give_answer, progress
from seismass.commands.options import (
    add_answer_options,
    add_records_options,
    add_target_options,
    arguments,
    read_site,
    refuse_options,
)
from seismass.commands.scene_or_building import (
    add_file_argument,
    add_scaling_options,
    doubts_of_input,
    motions_of_file,
    read_scene_or_building,
    with_doubts,
)

if TYPE_CHECKING:
    from seismass.studies.slip import Clearance


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_file_argument(parser)
    asked = parser.add_argument_group("what is asked")
    asked.add_argument(
        "--clearance", action="append", default=[], metavar="[BLOCK=]M", help="distance to an edge or a wall, m"
    )
    asked.add_argument("--size", action="append", default=[], metavar="[BLOCK=]BxH", help="size of a block, m")
    asked.add_argument("--fragility", action="store_true", help="also fit the probability of reaching clearances")
    asked.add_argument(
        "--measure",
        choices=("scale", "pga", "sa_t1", "sa_avg"),
        help="intensity measure of --fragility (sa_t1; pga without a building)",
    )
    motions = parser.add_argument_group("motions: of a building file scaled to its site, of a scene file as they are")
    add_records_options(motions)
    add_target_options(motions, stand_in=False)
    add_scaling_options(motions)
    add_answer_options(parser, seed=True)


def run(args: argparse.Namespace) -> int:
    """Solve the runs, print the slip demand and write its files; return the exit code."""
    from seismass.studies.slip import parse_size, slip_demand

    if not args.fragility:
        refuse_options(args, ("measure",), "slip", "where --fragility is not given")
    target = read_site(args, "slip")
    scene, building = read_scene_or_building(args.file, target)
    stated = None
    if building is not None:
        sliding = building.with_tipping("slide")  # how far they would slide; which of them tip is said beside it
        scene, stated = sliding.scene(target), [sliding.loose[number].size for number, _ in sliding.sliding()]
    blocks = len(scene.goods)
    sizes = _per_block("size", args.size, blocks, parse_size, stated)
    plane = scene.other_direction is not False
    clearances = _per_block("clearance", args.clearance, blocks, partial(parse_clearance, plane=plane))
    file_motions = motions_of_file(args, "slip", scene, building, target)
    motions = file_motions.scaled
    with progress() as tell:
        result = slip_demand(
            scene,
            motions,
            sizes=sizes,
            clearance=clearances,
            measure=args.measure or ("pga" if scene.building is None else "sa_t1"),
            progress=tell,
            **arguments(args, "fragility", "seed", threads="jobs"),
        )
    sides = [side for each in clearances or [] if each is not None for side in each.distances]
    limits = [("clearance", side) for side in sides if side is not None]
    components = [component for pair in motions for component in (pair.first, pair.second)] if plane else motions
    result, doubtful = with_doubts(result, doubts_of_input(scene, building, target, limits, components))
    head = f"{doubtful}suite       {file_motions.suite.name}\nscaling     {file_motions.scaling}\n\n"
    give_answer(args, result, file_motions.suite, head=head, indent=12)
    return 0


def parse_clearance(text: str, *, plane: bool = False) -> Clearance:
    """Return a clearance from its text: a distance for both sides, or one for each, separated by a comma; in two
    directions four for the sides of x and y. A distance after @ is one in any direction.
    """
    from seismass.studies.slip import Clearance

    sides, sign, reach = text.partition("@")
    try:
        values = [float(side) if side.strip() else None for side in sides.split(",")]
        radius = float(reach) if sign else None
    except ValueError:
        values, radius = [], None
    if len(values) not in (1, 2, 4) or (radius is None and not any(value is not None for value in values)):
        requirement = "a distance, or PLUS,MINUS of which one may be empty (m)"
        if plane:
            requirement = "a distance, PLUS,MINUS or +X,-X,+Y,-Y (m), each but one empty at will, or @ and one for all"
        raise refusal(InvalidOption, "--clearance", "slip", requirement, brief(text))
    if len(values) < 3 and radius is None and not plane:
        return Clearance(values[0], values[-1])
    plus, minus, plus_y, minus_y = (values * 4)[:4]
    return Clearance(plus, minus, plus_y, minus_y, radius)


def _per_block(
    name: str, words: list[str], blocks: int, parse: Any, stated: list[Any] | None = None
) -> list[Any] | None:
    """Return one value per block from values for all blocks or for single ones, else those that the file has; None
    where nothing is given.
    """
    if not words:
        return stated
    values: dict[int, Any] = {}
    for text in words:
        number, equals, value = text.partition("=")
        block = int(number) if number.strip().isdecimal() and equals else 0
        if equals and not 1 <= block <= blocks:
            raise refusal(InvalidOption, f"--{name}", "slip", f"of a block from 1 to {blocks}", text)
        if block in values:
            raise refusal(InvalidOption, f"--{name}", "slip", "given once for a block", text)
        values[block] = parse(value if equals else text)
    others = stated or [None] * blocks
    return [values.get(number, values.get(0, others[number - 1])) for number in range(1, blocks + 1)]


COMMAND = Command(
    description=(
        "Slip of the goods of a scene file or a building file over a suite of motions, beside the same "
        "goods on the ground and published estimates."
    ),
    examples="""
slip scene.toml --records recordings/
slip scene.toml --clearance 0.3 --size 1.0x1.2
slip warehouse.toml
slip warehouse.toml --factor 1
slip warehouse.toml --sds 1.0 --sd1 0.6 --period 0.6 --clearance 1=0.2 --clearance 2=0.5,0.1
slip scene.toml --clearance 0.3 --fragility --measure pga --out slip
""",
    options=options,
    run=run,
    note="""
--clearance: DISTANCE for all sides, PLUS,MINUS for each (one may be left empty), +X,-X,+Y,-Y in two directions,
@DISTANCE for any direction, in m; --size: WIDTHxHEIGHT or
WIDTHxHEIGHT@CENTRE, in m, else as the building file has it. BLOCK= before either makes it that of one block, from 1.
""",
    codes={0: "done (a collapse is a result)", 1: "a run failed"},
)
