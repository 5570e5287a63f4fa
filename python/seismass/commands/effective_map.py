"""`seismass map`: the effective fraction over a grid of buildings, the chart against eta, and how rules do on it."""

from __future__ import annotations

import argparse

from seismass.commands.frame import Command, give_answer, progress
from seismass.commands.options import (
    add_answer_options,
    add_motion_options,
    add_spring_options,
    arguments,
    numbers_option,
    read_motions,
    read_target,
)
from seismass.commands.parser import RUNS


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_motion_options(parser, None, "first period of each building with its goods attached")
    grid = parser.add_argument_group("grid")
    grid.add_argument("--mu", type=numbers_option(), metavar="LIST", help="friction coefficients (0.05 to 1.2)")
    grid.add_argument("--R", type=numbers_option(), metavar="LIST", help="response modification factors (1 to 8)")
    grid.add_argument(
        "--alpha", type=numbers_option(), metavar="LIST", help="mass of goods over floor mass (0.25 to 1.5)"
    )
    grid.add_argument("--factor", type=numbers_option(), metavar="LIST", help="factors of the scaled motions (1)")
    grid.add_argument("--design-share", type=float, metavar="L", help="share of the live load in the design (0.25)")
    add_spring_options(grid, ("overstrength", "second_slope"))
    add_answer_options(parser, "map", "map")


def run(args: argparse.Namespace) -> int:
    """Make the map, write its files and print how rules do; return the exit code."""
    from seismass.effective_mass import EffectiveMassParameters, effective_mass_map

    grid = arguments(args, mus="mu", response_modification="R", mass_ratios="alpha", intensities="factor")
    buildings = arguments(args, "overstrength", "second_slope", design_fraction="design_share", scaling_period="period")
    parameters = EffectiveMassParameters(**grid, **buildings)
    target = read_target(args)
    suite = read_motions(args, "seven")
    with progress() as tell:
        result = effective_mass_map(suite, target, parameters, threads=args.jobs, progress=tell)
    head = f"suite    {suite.name}: {len(suite)} motions\ntarget   {target.label}\n"
    give_answer(args, result, suite, head=head, indent=9)
    return 0


COMMAND = Command(
    description=(
        "Solve 16 buildings x 4 loads x 7 strengths x 11 friction coefficients under a suite of motions, "
        "find the effective fraction of live load of each, draw it against eta = mu_k/C1, and compare simple rules "
        "and codes with it."
    ),
    examples="""
map
map --records my_records/ --target uniform_hazard.csv --out chart
map --mu 0.2,0.4,0.6 --R 2,4,6 --alpha 1 --factor 0.5,1,1.5,2
""",
    options=options,
    run=run,
    codes=RUNS,
)
