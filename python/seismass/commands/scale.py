"""`seismass scale`: factors of a suite by one of six methods, and the choice of records before."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.files import table_content, write_file
from seismass.base.values import counted
from seismass.commands.frame import Command, show, write_figure
from seismass.commands.options import (
    SPRING_OPTIONS,
    add_json_option,
    add_motion_options,
    add_output_option,
    add_plot_option,
    add_spring_options,
    arguments,
    left_out,
    positive_count,
    positive_option,
    read_motions,
    read_site,
    read_target,
    refuse_options,
    warn_left_out,
)
from seismass.commands.parser import RUNS

if TYPE_CHECKING:
    from seismass.assessment.building import OwnBuilding
    from seismass.design.scaling import ScalingResult, Selection
    from seismass.model.building import Building
    from seismass.motions.records import Pairs, Suite
    from seismass.motions.spectra import TargetSpectrum

BY_CODE: Final = (
    "asce7-10",
    "asce7-16",
    "asce7-22",
    "ec8",
    "nzs1170.5",
    "tbdy2018",
    "bnbc2017",
    "geometric-mean",
)
"""Methods that are rules of codes, as `seismass.scaling.SCALING_CODES` has them."""
MAXIMUM_DIRECTION: Final = ("asce7-16", "asce7-22")
METHODS: Final = (*BY_CODE, "least-squares", "least-squares-linear", "sa-t1", "mps")
_PUSHOVER: Final = ("reduction", "yield_coefficient", *SPRING_OPTIONS, "deformation")


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_motion_options(parser)
    method = parser.add_argument_group("method")
    how = f"how to scale: {', '.join(METHODS)} (that of the code of --building, else asce7-10); see below"
    method.add_argument("--method", choices=METHODS, metavar="NAME", help=how)
    method.add_argument(
        "--building",
        type=Path,
        metavar="FILE",
        help="building file that gives T and modes (rules of codes) or pushover (mps) with its goods attached, and "
        "with its [site] the target, at the level of the rule",
    )
    method.add_argument(
        "--lowest-period", type=positive_option, metavar="S", help="period of 90 %% of the mass, s (asce7-16)"
    )
    method.add_argument("--pairs", action="store_true", help="pairs of horizontals of the folder (rules of codes)")
    method.add_argument(
        "--reduction", type=positive_option, metavar="R", help="A_t(T) over the yield acceleration (mps)"
    )
    method.add_argument("--yield-coefficient", type=positive_option, metavar="C", help="yield acceleration, g (mps)")
    add_spring_options(method, of="mps: ")
    method.add_argument(
        "--deformation", choices=("ratio", "median"), help="target deformation: C_R or the suite's median (mps: ratio)"
    )
    selection = parser.add_argument_group("selection")
    selection.add_argument(
        "--select",
        type=positive_count,
        metavar="N",
        help="records to take, whose mean shape is closest to the target",
    )
    selection.add_argument("--max-per-event", type=positive_count, metavar="K", help="most of one event (2)")
    selection.add_argument("--max-per-station", type=positive_count, metavar="K", help="most of one recording (1)")
    output = parser.add_argument_group("output")
    add_output_option(output, "FILE", "write the table of factors and misfits, .csv")
    add_plot_option(output)
    add_json_option(output)


def run(args: argparse.Namespace) -> int:
    """Print the factors; return the exit code."""
    from dataclasses import replace

    from seismass.assessment.building_file import read_building
    from seismass.assessment.models import scaled_to_site, with_mass
    from seismass.design.scaling import select_records
    from seismass.model.plausibility import motion_remarks
    from seismass.motions.spectra.target import target_remarks

    _check_options(args)
    assessed = None if args.building is None else read_building(args.building)
    args.method = args.method or (assessed.scaling_code if assessed is not None else "asce7-10")
    target = _target(args, assessed)
    suite, scaled = _motions(args)
    selection = None
    building = None if assessed is None else with_mass(assessed.scene(target), assessed.goods_mass).building
    period = args.period if building is None else float(building.periods[0])
    if args.select is not None:
        limits = arguments(args, "max_per_event", "max_per_station")
        longest = 2.0 if args.method in (*MAXIMUM_DIRECTION, "ec8") else 1.5
        selection = select_records(suite, target, args.select, period=period, period_range=(0.2, longest), **limits)
        suite = scaled = selection.suite
    if assessed is not None and args.method in BY_CODE:
        scaling = scaled_to_site(replace(assessed, scaling=args.method), scaled, target)
    else:
        scaling = _scaled(args, scaled, target, building)
    remarks = (*motion_remarks(suite), *target_remarks(target), *scaling.remarks)
    if args.out is not None:
        _write_table(args.out, scaling)
    if args.plot is not None:
        write_figure(scaling.plot() if args.pairs else scaling.plot(records=suite, target=target), args.plot)
    if args.json:
        warn_left_out(suite)
        print(json.dumps(_document(suite, target, scaling, selection, remarks), indent=2))
    else:
        _print(suite, target, scaling, selection, remarks)
    return 0


def _motions(args: argparse.Namespace) -> tuple[Suite, Suite | Pairs]:
    """The records as they are listed, and what is scaled; of a pair the first component stands for it."""
    if not args.pairs:
        suite = read_motions(args, "eleven" if args.method in (*MAXIMUM_DIRECTION, "tbdy2018") else "seven")
        return suite, suite
    from seismass.motions.records import Suite, find_pairs

    pairs = find_pairs(args.records)
    if not len(pairs):
        raise InvalidMotion(f"pairs of {args.records} must be at least one; got none in {len(pairs.excluded)} files")
    listed = tuple(pair.first.replace(name=pair.name, remarks=pair.remarks) for pair in pairs)
    return Suite(pairs.name, listed, pairs.excluded), pairs


def _check_options(args: argparse.Namespace) -> None:
    """Refuse options that the method, or a scaling without selection, does not use."""
    method = args.method or "asce7-10"
    by_code, used = args.method is None or method in BY_CODE, set[str]()
    if by_code:
        used = {"building", "lowest_period"} if method in MAXIMUM_DIRECTION else {"building"}
    elif method == "mps":
        used = {"building", *_PUSHOVER}
    unused = [name for name in ("building", "lowest_period", *_PUSHOVER) if name not in used]
    refuse_options(args, unused, "scale", f"with {method}")
    if args.building is not None:
        refuse_options(args, ("lowest_period", *_PUSHOVER[:-1]), "scale", "with --building")
    if args.method == "mps" and args.building is None:
        names = [name for name in ("reduction", "yield_coefficient") if getattr(args, name) is not None]
        if len(names) != 1:
            raise InvalidOption(
                "--reduction, --yield-coefficient or --building of scale must be given with mps, one of them; "
                f"got {'two' if names else 'none'}"
            )
    if args.select is None:
        refuse_options(args, ("max_per_event", "max_per_station"), "scale", "without --select")
    if args.pairs:
        if not by_code or args.records is None:
            got = method if args.records is not None else f"{method} without --records"
            raise InvalidOption(f"--pairs of scale must be given with a rule of a code and --records; got {got}")
        refuse_options(args, ("select",), "scale", "with --pairs")


def _target(args: argparse.Namespace, building: OwnBuilding | None) -> TargetSpectrum:
    """The target that options describe, else the site of the building file, else the stand-in."""
    stated = read_site(args, "scale") if building is not None else None
    if building is None or (stated is None and building.target is None):
        return read_target(args)
    return building.site_spectrum(stated)


def _scaled(args: argparse.Namespace, suite: Any, target: TargetSpectrum, building: Building | None) -> ScalingResult:
    """Scale a Suite, or Pairs by the method that takes them."""
    from seismass.design import scaling

    if args.method in BY_CODE:
        lowest = args.lowest_period
        return scaling.scale_by_code(suite, target, args.period, code_id=args.method, lowest_period=lowest)
    if args.method == "sa-t1":
        return scaling.scale_sa_t1(suite, target, args.period)
    if args.method == "mps":
        period = args.period if building is None else None
        return scaling.scale_modal_pushover(suite, target, building, period=period, **arguments(args, *_PUSHOVER))
    space: Any = "linear" if args.method.endswith("linear") else "log"
    return scaling.scale_least_squares(suite, target, args.period, space=space)


def _write_table(path: Path, scaling: ScalingResult) -> None:
    import polars as pl

    table = scaling.diagnostics()
    if "roots" in table.columns:
        roots = [" ".join(f"{root:.12g}" for root in several) for several in table["roots"]]
        table = table.with_columns(roots=pl.Series(roots))
    write_file(path, table_content(table, "csv"))


def _document(
    suite: Suite,
    target: TargetSpectrum,
    scaling: ScalingResult,
    selection: Selection | None,
    remarks: tuple[str, ...],
) -> dict[str, Any]:
    rows = zip(scaling.diagnostics().to_dicts(), suite, strict=True)
    return {
        "suite": suite.name,
        "target": target.label,
        "method": scaling.method,
        "period": scaling.period,
        "common_factor": scaling.common,
        "governing_period": scaling.governing_period,
        "least_ratio": scaling.least_ratio,
        "largest_ratio": scaling.largest_ratio,
        "mean_misfit": scaling.mean_misfit,
        "remarks": [*suite.remarks, *remarks],
        "motions": [{**row, "remarks": list(record.remarks)} for row, record in rows],
        "spectrum": scaling.spectrum_table().to_dict(as_series=False),
        **({} if selection is None else {"selection": selection.table.to_dicts()}),
    }


def _print(
    suite: Suite,
    target: TargetSpectrum,
    scaling: ScalingResult,
    selection: Selection | None,
    remarks: tuple[str, ...],
) -> None:
    from seismass.show.motions import factor_lines, scaling_lines

    show(f"suite   {suite.name}: {counted(len(suite), 'motion')}")
    for line in left_out(suite):
        show(f"        {line}")
    show("\n".join([*scaling_lines(scaling, remarks), "", *factor_lines(scaling, [one.remarks for one in suite])]))
    if selection is not None:
        show("\nnot chosen")
        for row in selection.table.filter(selection.table["step"].is_null()).iter_rows(named=True):
            show(f"{row['number']:>3}  misfit {row['misfit']:<6.3f} {row['record']}: {row['reason']}")


COMMAND = Command(
    description="Factors by which a suite is scaled to a target spectrum, with the misfit of each motion.",
    examples="""
scale --records suite.csv --sds 1.0 --sd1 0.6 --period 0.6
scale --records records/ --target uniform_hazard.csv --json
scale --records records/ --target ec8:1:C:0.3 --select 7 --plot scaling.png
scale --records records/ --method asce7-16 --select 11 --out factors.csv
scale --records records/ --method asce7-16 --pairs
scale --records records/ --building warehouse.toml
scale --method mps --reduction 4 --period 1.0
scale --method mps --building warehouse.toml
""",
    options=options,
    run=run,
    note="""
methods:
  asce7-10              mean not below the target from 0.2 T to 1.5 T; of pairs that of their SRSS
  asce7-16, asce7-22    mean not below 0.9 of it from 0.2 T (or the period of 90 % of the mass) to 2 T; 11 motions; of
                        pairs that of their maximum direction
  ec8                   mean not below 0.9 of it from 0.2 T to 2 T, nor at T = 0 below it
  nzs1170.5             k_1 of each record and k_2 of the family, to (1 + S_p)/2 of it from 0.4 T to 1.3 T
  tbdy2018, bnbc2017    mean not below it from 0.2 T to 1.5 T, SRSS of pairs 1.3 of it; tbdy2018: 11 motions
  geometric-mean        as asce7-10, of pairs that of their geometric mean
  least-squares         each motion closest to the target in the logarithm; -linear: in the ordinates
  sa-t1                 each motion at the target at T
  mps                   modal pushover: the inelastic first-mode oscillator reaches the target deformation
""",
    codes=RUNS,
)
