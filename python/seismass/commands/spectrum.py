"""`seismass spectrum`: elastic and inelastic response spectra of records as a table."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from seismass.base.files import without_formulas
from seismass.base.units import STANDARD_GRAVITY
from seismass.commands.frame import Command
from seismass.commands.options import (
    SPRING_OPTIONS,
    add_reading_options,
    add_spring_options,
    arguments,
    numbers_option,
    reading,
    refuse_options,
    warn_left_out,
    warn_remarks,
)
from seismass.commands.parser import RUNS

if TYPE_CHECKING:
    import polars as pl

    from seismass.motions.records import Suite
    from seismass.motions.spectra import Kind

_KINDS: Final[dict[str, Kind]] = {
    "psa": "pseudo_acceleration",
    "psv": "pseudo_velocity",
    "sd": "displacement",
    "sa": "acceleration",
}
_IN_G: Final = ("psa", "sa")


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument(
        "records",
        type=Path,
        metavar="PATH",
        help="a record of any format that is read, a folder of records, or a CSV with a column `file`",
    )
    add_reading_options(parser)
    parser.add_argument(
        "--period", type=numbers_option(), metavar="LIST", help="periods, s (default: 100 from 0.01 to 10, geometric)"
    )
    parser.add_argument("--damping", type=numbers_option(), default=(0.05,), metavar="LIST", help="ratios (0.05)")
    parser.add_argument(
        "--kind", choices=tuple(_KINDS), help="ordinate (psa); sa is the true, absolute acceleration of the mass"
    )
    inelastic = parser.add_argument_group("inelastic spectra")
    level = inelastic.add_mutually_exclusive_group()
    level.add_argument("--strength", type=numbers_option(above=0.0), metavar="LIST", help="strengths V_y/W")
    level.add_argument("--ductility", type=numbers_option(above=0.0), metavar="LIST", help="ductility demands")
    add_spring_options(inelastic)


def run(args: argparse.Namespace) -> int:
    """Print the table; return the exit code."""
    import numpy as np

    from seismass.motions.records.builtin import records_named

    inelastic = args.strength is not None or args.ductility is not None
    unused = ("kind",) if inelastic else tuple(SPRING_OPTIONS)
    refuse_options(args, unused, "spectrum", f"{'with' if inelastic else 'without'} --strength or --ductility")
    suite = records_named(args.records, reading(args))
    warn_left_out(suite)
    warn_remarks(suite)
    periods = np.geomspace(0.01, 10.0, 100) if args.period is None else np.array(args.period)
    table = _inelastic(suite, periods, args) if inelastic else _elastic(suite, periods, args)
    sys.stdout.write(without_formulas(table).write_csv())
    return 0


def _elastic(suite: Suite, periods: Any, args: argparse.Namespace) -> pl.DataFrame:
    import numpy as np
    import polars as pl

    from seismass.motions.spectra import response_spectrum

    kind = args.kind or "psa"
    spectra = response_spectrum(suite, periods, args.damping, _KINDS[kind])
    name, unit = (f"{kind}_g", STANDARD_GRAVITY) if kind in _IN_G else (kind, 1.0)
    shape = spectra.shape
    return pl.DataFrame(
        {
            "motion": np.repeat(np.arange(1, len(suite) + 1), shape[1] * shape[2]),
            "record": np.repeat([record.name for record in suite], shape[1] * shape[2]),
            "damping": np.tile(np.repeat(args.damping, shape[2]), shape[0]),
            "period": np.tile(periods, shape[0] * shape[1]),
            name: spectra.ravel() / unit,
        }
    )


def _inelastic(suite: Suite, periods: Any, args: argparse.Namespace) -> pl.DataFrame:
    import polars as pl

    from seismass.motions.spectra import inelastic_spectrum

    how = arguments(args, "strength", "ductility", *SPRING_OPTIONS)
    tables = []
    for ratio in args.damping:
        spectrum = inelastic_spectrum(suite, periods, damping=ratio, **how)
        tables.append(spectrum.table().insert_column(2, pl.Series("damping", [ratio] * spectrum.strength.size)))
    return pl.concat(tables)


COMMAND = Command(
    description=(
        "Response spectra, exact for acceleration that is linear between samples, printed as CSV: elastic, "
        "or inelastic for given strengths or ductilities."
    ),
    examples="""
spectrum record.AT2 --damping 0.02,0.05
spectrum column.txt --dt 0.01 --unit cm/s2
spectrum suite.csv --period 0.2,1.0 --kind sd
spectrum records/ > spectra.csv
spectrum record.AT2 --strength 0.1,0.2
spectrum record.AT2 --ductility 2,4 --overstrength 1 --second-slope 0
""",
    options=options,
    run=run,
    note="""
Columns: motion (number from 1), record, damping, period (s) and the ordinate: psa_g, sa_g (g), psv (m/s) or sd (m).
Inelastic: strength (V_y/W), ductility, displacement (m), elastic_strength and reduction (R) instead.
""",
    codes=RUNS,
)
