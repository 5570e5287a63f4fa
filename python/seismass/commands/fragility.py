"""`seismass fragility FILE`: what a code's model makes of the probability of exceeding a limit."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

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
    refuse_options,
)
from seismass.commands.parser import RUNS
from seismass.commands.scene_or_building import (
    DEFAULT_LIMIT,
    FileMotions,
    add_file_argument,
    add_scaling_options,
    add_site_options,
    doubts_of_input,
    motions_of_file,
    read_scene_or_building,
    with_doubts,
)

if TYPE_CHECKING:
    from seismass.assessment.building import OwnBuilding
    from seismass.model.scene import Scene
    from seismass.motions.spectra import TargetSpectrum


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_file_argument(parser)
    asked = parser.add_argument_group("what is asked")
    asked.add_argument(
        "--limit",
        action="append",
        metavar="LIMIT",
        help=f"limit state, several times if wanted ({DEFAULT_LIMIT}; of a building file its drift limit)",
    )
    add_measure_options(
        asked,
        "intensity measure (sa_t1: pseudo-acceleration at T1, in g); scale: factor of the motions, which of a building "
        "file are scaled to its site as `seismass building` does",
        "T1 of the measure, s (that of the building without goods)",
    )
    add_code_share_option(asked, "share of the goods in the code's model (0.25, or the file's code)")
    asked.add_argument("--at", type=numbers_option(), metavar="LIST", help="intensities at which models are compared")
    method = parser.add_argument_group("method")
    method.add_argument("--method", choices=("hunt_fill", "stripes", "cloud"), default="hunt_fill", help="(hunt_fill)")
    method.add_argument("--intensity", type=numbers_option(), metavar="LIST", help="intensities of stripes")
    method.add_argument("--highest", type=positive_option, metavar="X", help="largest intensity of a hunt")
    method.add_argument("--tolerance", type=positive_option, metavar="R", help="relative width of capacities (0.001)")
    motions = parser.add_argument_group("motions, each scaled to every intensity, of a cloud as they are")
    add_records_options(motions)
    add_scaling_options(parser.add_argument_group("scaling with --measure scale"))
    add_site_options(parser)
    add_answer_options(parser, seed=True)


def run(args: argparse.Namespace) -> int:
    """Run the analysis, print its answer and write its files; return the exit code."""
    from seismass.studies.fragility import HuntAndFill, cloud_analysis, incremental_dynamic_analysis, parse_limit

    if args.method != "hunt_fill":
        refuse_options(args, ("highest", "tolerance"), "fragility", f"where --method is {args.method}")
    if args.method == "cloud":
        refuse_options(args, ("intensity",), "fragility", "where --method is cloud")
    target = read_site(args, "fragility")
    read = read_scene_or_building(args.file, target, only_site="fragility")
    models, rule, drift_limit = models_of(*read, args.code_share)
    limits = [parse_limit(text) for text in args.limit or [drift_limit]]
    doubts = doubts_of_input(*read, target, ((limit.quantity, limit.value) for limit in limits))
    motions = _motions(args, *read, target)
    common = arguments(args, "measure", "at", "seed", period="measure_period", threads="jobs")
    with progress() as tell:
        if args.method == "cloud":
            result = cloud_analysis(models, motions.scaled, limits, **common, progress=tell)
        else:
            result = incremental_dynamic_analysis(
                models,
                motions.scaled,
                limits,
                method=args.method,
                intensities=args.intensity,
                hunt=HuntAndFill(**arguments(args, "highest", "tolerance")) if args.method == "hunt_fill" else None,
                **common,
                progress=tell,
            )
    result, doubtful = with_doubts(result, doubts)
    head = f"{doubtful}suite     {motions.suite.name}\nscaling   {motions.scaling}\ncode      {rule}\n"
    give_answer(args, result, motions.suite, head=head, indent=10, answer=r"  at \S+: code")
    return 0


def _motions(
    args: argparse.Namespace, scene: Scene, building: OwnBuilding | None, target: TargetSpectrum | None
) -> FileMotions:
    """The motions: a measure of intensity replaces their scaling, except where it is the factor itself."""
    import numpy as np

    if args.measure == "scale":
        motions = motions_of_file(args, "fragility", scene, building, target)
        return motions._replace(scaling=f"{motions.scaling}; then by each intensity")
    refuse_options(args, ("period", "factor"), "fragility", f"where --measure is {args.measure}")
    suite = read_motions(args)
    note = "motions as they are" if args.method == "cloud" else "each motion to each intensity"
    return FileMotions(suite, np.ones(len(suite)), note)


def models_of(
    scene: Scene, building: OwnBuilding | None, code_share: float | None
) -> tuple[dict[str, Scene], str, str]:
    """Return the models of a scene or a building, what the code's model has attached, and the default limit. The code's
    model has the code's fraction of the design live load, whatever is present.
    """
    from seismass.assessment.models import with_mass
    from seismass.studies.fragility import compared_models
    from seismass.studies.fragility.run import CODE, DEFAULT_CODE_SHARE, SLIDING

    share = DEFAULT_CODE_SHARE if code_share is None else code_share
    rule = f"{100.0 * share:g} % of the goods attached as mass"
    models = compared_models(scene, share)
    if building is None:
        return models, rule, DEFAULT_LIMIT
    if code_share is None:
        models[CODE] = with_mass(models[SLIDING], building.code_mass)
        code = building.code
        share = 100.0 * building.code_share
        rule = f"{code.code}, {building.uses}: {share:.3g} % of the design live load attached as mass"
    return models, rule, f"drift_ratio={building.drift_limit:g}"


COMMAND = Command(
    description=(
        "Scale motions until limits are exceeded, for the building with sliding goods, for the model of a "
        "code, and with all goods attached; fit fragilities and compare the probabilities of exceedance."
    ),
    examples="""
fragility warehouse.toml
fragility warehouse.toml --target ec8:1:C:0.3
fragility scene.toml --records my_records/ --limit drift_ratio=0.02 --limit slip=0.1 --limit collapse
fragility scene.toml --measure sa_avg --code-share 0.8 --at 0.5,1,1.5 --out fragility
fragility scene.toml --method stripes --intensity 0.2,0.4,0.6,0.8,1,1.2 --limit drift@1=0.05
fragility scene.toml --method cloud --measure pga --limit drift=0.05 --json
""",
    options=options,
    run=run,
    note="""
limits: drift_ratio, drift, residual_drift_ratio, residual_drift, slip, residual_slip, floor_acceleration_g (ratio, m
or g), of a storey, floor or block with @NUMBER; or collapse
""",
    codes=RUNS,
)
