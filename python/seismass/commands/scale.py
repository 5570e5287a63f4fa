"""`seismass scale`: factors of a suite by the amplitude scaling of ASCE/SEI 7-10."""

from __future__ import annotations

import argparse
import json
from typing import Any

from seismass.commands.options import add_motion_options, left_out, read_motions, read_target, warn_left_out

_EPILOG = """examples:
  seismass scale --records suite.csv --sds 1.0 --sd1 0.6 --period 0.6
  seismass scale --records records/ --target uniform_hazard.csv --json

exit codes: 0 done, 2 bad input"""


def add_parser(subparsers: Any) -> None:
    """Add the subcommand to those of the `seismass` command."""
    parser = subparsers.add_parser(
        "scale",
        help="scale a suite to a target spectrum (ASCE 7-10)",
        description="Factors by which the mean spectrum of a suite is not below the target at 100 periods from 0.2 T "
        "to 1.5 T.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_motion_options(parser)
    parser.add_argument("--json", action="store_true", help="print factors and spectra as JSON")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Print the factors; return the exit code."""
    from seismass.plausibility import motion_remarks, target_remarks
    from seismass.scaling import scale_asce7_10

    target = read_target(args)
    suite = read_motions(args)
    scaling = scale_asce7_10(suite, target, args.period)
    remarks = (*motion_remarks(suite), *target_remarks(target), *scaling.remarks)
    if args.json:
        warn_left_out(suite)
        rows = zip(scaling.table().to_dicts(), suite, strict=True)
        document = {
            "suite": suite.name,
            "target": target.label,
            "common_factor": scaling.common,
            "governing_period": scaling.governing_period,
            "remarks": [*suite.remarks, *remarks],
            "motions": [{**row, "remarks": list(record.remarks)} for row, record in rows],
            "spectrum": scaling.spectrum_table().to_dict(as_series=False),
        }
        print(json.dumps(document, indent=2))
        return 0
    print(f"suite   {suite.name}: {len(suite)} motions")
    for line in left_out(suite):
        print(f"        {line}")
    print(f"target  {target.label}")
    for remark in remarks:
        print(f"remark  {remark}")
    print(
        f"range   {len(scaling.periods)} periods from {scaling.periods[0]:g} to {scaling.periods[-1]:g} s; "
        f"the mean touches the target at {scaling.governing_period:.4g} s; SF2 = {scaling.common:.6f}\n"
    )
    print("     SF1       SF       record")
    for row, record in zip(scaling.table().iter_rows(named=True), suite, strict=True):
        print(f"{row['motion']:>3}  {row['individual_factor']:<8.5f}  {row['factor']:<8.5f} {row['record']}")
        for remark in record.remarks:
            print(f"{'':26}{remark}")
    return 0
