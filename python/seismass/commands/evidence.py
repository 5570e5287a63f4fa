"""`seismass evidence`: the table by which a code committee changes its fraction of the live load."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

from seismass._kernel import VERSION
from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.commands.frame import Command, give_answer, progress
from seismass.commands.options import (
    add_answer_options,
    add_records_options,
    arguments,
    numbers_option,
    positive_option,
    read_motions,
)
from seismass.commands.parser import RUNS


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument("--example", action="store_true", help="print the 29 archetypes as a file to change, and stop")
    what = parser.add_argument_group("archetypes")
    what.add_argument("--archetypes", type=Path, metavar="FILE", help="file of archetypes, .toml or .json (the 29)")
    what.add_argument("--occupancies", metavar="LIST", help="those of the file that are looked at (all)")
    what.add_argument("--site", type=_two, metavar="SDS:SD1", help="S_DS and S_D1 in g, in place of the file's")
    what.add_argument("--presence", choices=("jcss", "full"), help="as surveyed (jcss), or all floors full")
    what.add_argument("--first-yield", type=_two, metavar="M:SIGMA", help="real first yield over that of the design")
    add_records_options(parser.add_argument_group("motions, each at levels of the design spectrum at T"))
    asked = parser.add_argument_group("what is asked")
    asked.add_argument(
        "--hazard", type=Path, metavar="CSV", help="intensity (g), annual rate (illustrative, of no site)"
    )
    asked.add_argument("--hazard-period", type=positive_option, metavar="T", help="period of its Sa, s; needed with it")
    asked.add_argument(
        "--limit", type=positive_option, metavar="RATIO", help="drift ratio whose rate is asked for (0.02)"
    )
    asked.add_argument("--codes", metavar="LIST", help="codes that are compared (asce7-10,nbc,nzs1170.5,ec8)")
    asked.add_argument("--samples", type=_samples, metavar="BxG", help="buildings a motion, loads a building (8x8)")
    asked.add_argument("--quick", action="store_true", help="ten archetypes, five levels, 2x2 samples, one suite")
    asked.add_argument("--vary", action="store_true", help="change one input at a time, too: half an hour")
    output = add_answer_options(parser, "evidence", lambda args: None if args.example else Path("evidence"))
    output.add_argument("--seed", type=int, metavar="N", help="seed of the samples (1)")


def run(args: argparse.Namespace) -> int:
    """Make the table, write its files and print what it says; return the exit code."""
    from seismass.base.stored_results import result_store
    from seismass.motions.records import builtin_suite
    from seismass.runs.simulate import instruction_set
    from seismass.studies.evidence import evidence, example_file, read_archetypes
    from seismass.studies.evidence.table import CODES

    if args.example:
        print(example_file().read_text(encoding="utf-8"), end="")
        return 0
    archetypes, setting = read_archetypes(args.archetypes)
    if args.occupancies is not None:
        known = dict.fromkeys(each.occupancy.name for each in archetypes)
        wanted = [name.strip() for name in args.occupancies.split(",")]
        for name in wanted:
            if name not in known:
                raise InvalidOption(f"occupancy of evidence must be one of {', '.join(known)}; got {name}")
        archetypes = tuple(each for each in archetypes if each.occupancy.name in wanted)
    changes = arguments(args, "limit", "samples", "seed")
    if args.site is not None:
        changes |= {"sds": args.site[0], "sd1": args.site[1]}
    if args.first_yield is not None:
        changes |= {"first_yield": args.first_yield[0], "first_yield_sigma": args.first_yield[1]}
    if args.presence is not None:
        changes["full"] = args.presence == "full"
    setting = replace(setting, **changes)
    hazard = _hazard(args, setting)
    suite = read_motions(args)
    # Round numbers of recordings are judged on the synthetic motions, which had no part in them.
    other = None if args.quick or args.records is None else builtin_suite("forty")
    args.out.parent.mkdir(parents=True, exist_ok=True)
    with result_store(args.out.parent, args.out.name, f"{VERSION} {instruction_set()}") as store:
        with progress() as tell:
            result = evidence(
                archetypes,
                suite,
                setting=setting,
                hazard=hazard,
                codes=CODES if args.codes is None else [code.strip() for code in args.codes.split(",")],
                other=other,
                progress=tell,
                store=store,
                **arguments(args, "quick", "vary", threads="jobs"),
            )
        give_answer(args, result, suite)
    return 0


def _hazard(args: argparse.Namespace, setting: Any) -> Any:
    """The hazard over the design level; None where no curve is given."""
    from seismass.studies.risk.hazard import HazardCurve

    if args.hazard is None:
        if args.hazard_period is not None:
            raise InvalidOption("--hazard-period of evidence must be left out where --hazard is; got it alone")
        return None
    if args.hazard_period is None:
        raise InvalidOption("--hazard-period of evidence must be given with --hazard; got none")
    curve = HazardCurve.from_csv(args.hazard, period=args.hazard_period)
    unit = float(setting.target(args.hazard_period)) / STANDARD_GRAVITY
    return HazardCurve(curve.sa_g / unit, curve.annual_rate, label=f"{curve.label}, Sa({args.hazard_period:g} s)")


def _two(text: str) -> tuple[float, float]:
    """Read two positive numbers with a colon between."""
    return numbers_option(2, above=0.0)(text.replace(":", " "))  # type: ignore[return-value]


def _samples(text: str) -> tuple[int, int]:
    buildings, goods = numbers_option(2, least=1.0)(text.replace("x", " "))
    return int(buildings), int(goods)


COMMAND = Command(
    description=(
        "Design archetypes by a code, load them as surveys find floors, let the goods slide with the scatter of their "
        "friction, and find the share of the design live load that as mass gives the same drift, rate and base shear. "
        "Prints and writes the table of a committee with its sheet of archetypes; an interrupted run goes on."
    ),
    examples="""
evidence --quick
evidence --example > archetypes.toml
evidence --records recordings/ --out evidence
evidence --archetypes archetypes.toml --records recordings/ --site 0.8:0.45 --vary
evidence --occupancies retail,office --hazard hazard.csv --hazard-period 0.5 --codes asce7-10,ec8
""",
    options=options,
    run=run,
    note="""
docs/evidence.md explains the definitions, the tables and every key of a file of archetypes.
""",
    codes=RUNS,
)
