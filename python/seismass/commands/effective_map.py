"""`seismass map`: the effective fraction over a grid of buildings, the chart against eta, and how rules do on it."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seismass.commands.options import (
    add_motion_options,
    add_spring_options,
    left_out,
    read_motions,
    read_target,
    threads_option,
    warn_left_out,
)
from seismass.commands.study import progress_bar

if TYPE_CHECKING:
    pass

_EPILOG = """examples:
  seismass map
  seismass map --records my_records/ --target uniform_hazard.csv --out chart
  seismass map --mu 0.2,0.4,0.6 --R 2,4,6 --alpha 1 --intensity 0.5,1,1.5,2

exit codes: 0 done, 2 bad input"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "map",
        help=help,
        description="Solve 16 buildings x 4 loads x 7 strengths x 11 friction coefficients under a suite of motions, "
        "find the effective fraction of live load of each, draw it against eta = mu_k/C1, and compare simple rules "
        "and codes with it.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--out", type=Path, default=Path("map"), metavar="DIR", help="folder to write to (map)")
    add_motion_options(parser)
    grid = parser.add_argument_group("grid; lists are separated by commas")
    grid.add_argument("--mu", type=numbers_option, metavar="LIST", help="friction coefficients (0.05 to 1.2)")
    grid.add_argument("--R", type=numbers_option, metavar="LIST", help="response modification factors (1 to 8)")
    grid.add_argument(
        "--alpha", type=numbers_option, metavar="LIST", help="mass of goods over floor mass (0.25 to 1.5)"
    )
    grid.add_argument("--intensity", type=numbers_option, metavar="LIST", help="factors of the scaled motions (1)")
    grid.add_argument("--design-fraction", type=float, metavar="L", help="share of live load in the design (0.25)")
    add_spring_options(grid, ("overstrength", "second_slope"))
    output = parser.add_argument_group("running and output")
    output.add_argument("--jobs", type=threads_option, metavar="N", help="threads (all cores); changes no digit")
    output.add_argument("--json", action="store_true", help="print metadata, rules and scatter as JSON")
    output.add_argument("--no-figures", action="store_true", help="write tables only")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Make the map, write its files and print how rules do; return the exit code."""
    from seismass.effective_mass import EffectiveMassParameters, effective_mass_map
    from seismass.media.folder import check_out

    started = time.perf_counter()
    check_out(args.out, "map")
    given = {
        "mus": args.mu,
        "response_modification": args.R,
        "mass_ratios": args.alpha,
        "intensities": args.intensity,
        "design_fraction": args.design_fraction,
        "overstrength": args.overstrength,
        "second_slope": args.second_slope,
        "scaling_period": args.period,
    }
    parameters = EffectiveMassParameters(**{name: value for name, value in given.items() if value is not None})
    target = read_target(args)
    suite = read_motions(args, "seven")
    result = effective_mass_map(suite, target, parameters, threads=args.jobs, progress=progress_bar())
    files = result.write(args.out, figures=not args.no_figures)
    if args.json:
        warn_left_out(suite)
        print(result.to_json())
        return 0
    print(f"suite    {suite.name}: {len(suite)} motions")
    for line in left_out(suite):
        print(f"         {line}")
    print(f"target   {target.label}\n{result.text}")
    print(f"\n{len(files)} files in {args.out}, {time.perf_counter() - started:.1f} s")
    return 0


def numbers_option(text: str) -> tuple[float, ...]:
    """Return numbers separated by commas."""
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be numbers separated by commas; got {text!r}") from None
