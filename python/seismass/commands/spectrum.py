"""`seismass spectrum`: elastic response spectra of records as a table."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from seismass.commands.options import read_records, warn_left_out, warn_remarks
from seismass.units import ACCELERATION_UNITS

_KINDS = {"psa": "pseudo_acceleration", "psv": "pseudo_velocity", "sd": "displacement"}
_EPILOG = """examples:
  seismass spectrum record.AT2 --damping 0.02 0.05
  seismass spectrum column.txt --dt 0.01 --unit cm/s2
  seismass spectrum suite.csv --periods 0.2 1.0 --kind sd
  seismass spectrum records/ > spectra.csv

Columns: motion (number from 1), record, damping, period (s) and the ordinate: psa_g (g), psv (m/s) or sd (m).
exit codes: 0 done, 2 bad input"""


def add_parser(subparsers: Any) -> None:
    """Add the subcommand to those of the `seismass` command."""
    parser = subparsers.add_parser(
        "spectrum",
        help="response spectra of records, as CSV",
        description="Elastic response spectra, exact for acceleration that is linear between samples, printed as CSV.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "records",
        type=Path,
        metavar="PATH",
        help="a record (.AT2, or text of one or two columns), a folder of .AT2 files, or a CSV with a column `file`",
    )
    parser.add_argument("--dt", type=float, metavar="S", help="time step of a record whose file does not state it, s")
    parser.add_argument("--unit", choices=tuple(ACCELERATION_UNITS), help="unit of a record whose file states none")
    parser.add_argument(
        "--periods", type=float, nargs="+", metavar="T", help="periods, s (default: 100 from 0.01 to 10, geometric)"
    )
    parser.add_argument("--damping", type=float, nargs="+", default=[0.05], metavar="Z", help="ratios (0.05)")
    parser.add_argument("--kind", choices=tuple(_KINDS), default="psa", help="ordinate (psa)")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Print the table; return the exit code."""
    import numpy as np
    import polars as pl

    from seismass.spectra import response_spectrum
    from seismass.units import STANDARD_GRAVITY

    suite = read_records(args.records, dt=args.dt, unit=args.unit)
    warn_left_out(suite)
    warn_remarks(suite)
    periods = np.geomspace(0.01, 10.0, 100) if args.periods is None else np.array(args.periods)
    spectra = response_spectrum(suite, periods, args.damping, _KINDS[args.kind])  # type: ignore[arg-type]
    name, unit = ("psa_g", STANDARD_GRAVITY) if args.kind == "psa" else (args.kind, 1.0)
    shape = spectra.shape
    table = pl.DataFrame(
        {
            "motion": np.repeat(np.arange(1, len(suite) + 1), shape[1] * shape[2]),
            "record": np.repeat([record.name for record in suite], shape[1] * shape[2]),
            "damping": np.tile(np.repeat(args.damping, shape[2]), shape[0]),
            "period": np.tile(periods, shape[0] * shape[1]),
            name: spectra.ravel() / unit,
        }
    )
    sys.stdout.write(table.write_csv())
    return 0
