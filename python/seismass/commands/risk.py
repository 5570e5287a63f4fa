"""`seismass risk FILE`: annual rates of exceeding a drift limit, and the share of the live load that keeps them."""

from __future__ import annotations

import argparse
from pathlib import Path

from seismass.commands.frame import Command, give_answer, progress
from seismass.commands.options import (
    add_answer_options,
    add_code_share_option,
    add_measure_options,
    add_records_options,
    arguments,
    numbers_option,
    positive_option,
    read_motions,
    read_site,
)
from seismass.commands.parser import RUNS
from seismass.commands.scene_or_building import (
    DEFAULT_LIMIT,
    add_file_argument,
    add_site_options,
    doubts_of_input,
    read_scene_or_building,
    with_doubts,
)


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_file_argument(parser)
    asked = parser.add_argument_group("what is asked")
    asked.add_argument("--hazard", type=Path, required=True, metavar="CSV", help="intensity (g), annual rate")
    asked.add_argument("--hazard-period", type=positive_option, metavar="T", help="period of its Sa, s")
    asked.add_argument(
        "--limit",
        metavar="LIMIT",
        help="drift_ratio=VALUE or drift=VALUE (m), of a storey with @NUMBER (drift_ratio=0.02; of a building file its "
        "drift limit)",
    )
    asked.add_argument(
        "--other-limit", type=numbers_option(), metavar="LIST", help="limits beside (1/4, 1/2, 3/2 of it)"
    )
    add_measure_options(
        asked,
        "what the hazard is of (sa_t1)",
        "T1 of the measure, s (that of the hazard, or of the building without goods)",
        scale=False,
    )
    add_code_share_option(
        asked,
        "share of the goods in the code's model (0.25; of a building file the fraction of its code over the share "
        "present)",
    )
    method = parser.add_argument_group("method")
    method.add_argument("--share", type=numbers_option(), metavar="LIST", help="shares of models (0,0.05,...,1)")
    method.add_argument("--estimator", choices=("lognormal", "empirical"), default="lognormal", help="(lognormal)")
    method.add_argument("--extrapolate", action="store_true", help="continue the hazard curve beyond its ends")
    method.add_argument(
        "--design-rate", type=positive_option, metavar="R", help="annual rate of the design intensity (1/475)"
    )
    add_records_options(parser.add_argument_group("motions, each scaled to the intensities of the hazard"))
    add_site_options(parser)
    add_answer_options(parser, seed=True)


def run(args: argparse.Namespace) -> int:
    """Find the share, print the answer and write its files; return the exit code."""
    from seismass.studies.fragility import parse_limit
    from seismass.studies.risk.hazard import HazardCurve
    from seismass.studies.risk.targeted_share import risk_targeted_share

    hazard = HazardCurve.from_csv(args.hazard, period=args.hazard_period)
    drift_limit = DEFAULT_LIMIT
    target = read_site(args, "risk")
    scene, building = read_scene_or_building(args.file, target, only_site="risk")
    if building is not None:
        drift_limit = f"drift_ratio={building.drift_limit:g}"
        if args.code_share is None and building.present_share > 0.0:
            args.code_share = building.present_code_share
    suite = read_motions(args)
    limit = parse_limit(args.limit or drift_limit)
    doubts = doubts_of_input(scene, building, target, [(limit.quantity, limit.value)])
    with progress() as tell:
        result = risk_targeted_share(
            scene,
            suite,
            hazard,
            limit,
            progress=tell,
            **arguments(args, "measure", "estimator", "extrapolate", "seed", "code_share", "design_rate"),
            **arguments(args, period="measure_period", shares="share", other_limits="other_limit", threads="jobs"),
        )
    if building is not None and building.present_share > 0.0:  # shares of codes are of the design live load
        result.metadata["present_share"] = building.present_share
    result, doubtful = with_doubts(result, doubts)
    head = f"{doubtful}suite                {suite.name}\nscaling              each motion to each intensity\n"
    give_answer(args, result, suite, head=head, indent=21, answer="risk-targeted share")
    return 0


COMMAND = Command(
    description=(
        "With a hazard curve: annual rates of exceeding a drift limit for the building with sliding goods, "
        "for the model of a code and for all goods attached, and the share attached whose model has the rate with "
        "sliding goods."
    ),
    examples="""
risk scene.toml --hazard hazard.csv
risk scene.toml --hazard hazard.csv --hazard-period 0.5 --limit drift_ratio=0.02 --records recordings/
risk scene.toml --hazard hazard.csv --code-share 0.8 --other-limit 0.005,0.01,0.03 --out risk
risk warehouse.toml --hazard hazard.csv --target ec8:1:C:0.3
risk warehouse.toml --hazard hazard.csv --estimator empirical --extrapolate --json
""",
    options=options,
    run=run,
    note="""
hazard.csv: intensity (g) and annual rate of exceedance, with or without a header such as Sa,rate
""",
    codes=RUNS,
)
