"""Writes docs/study_schema.md from the columns that the package knows.

Usage: python tools/study_schema.py
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

from seismass.study import SCHEMA_VERSION, TABLES
from seismass.study.columns import KEY_COLUMNS

PAGE: Final = Path(__file__).parents[1] / "docs" / "study_schema.md"

HEAD: Final = f"""# Files of a study

`seismass study --out DIR` writes tables, each as Parquet and as CSV, `tables.json`, `study.json`, `animation.json`,
figures as SVG (with `--png` as PNG too) and the page `report.html`, which [report.md](report.md) describes.
`files.json` lists the files with their SHA-256, and has that of the list. What a later study does not write again is
removed where that list names it and its bytes are the same; nothing else of the folder is.
`seismass report DIR` makes the page again from these files alone. Schema version {SCHEMA_VERSION}. SI units unless the
name says otherwise; storeys, floors, buildings, motions and runs count from 1. The same inputs give the same bytes,
whatever the number of threads, with the same instruction set; two instruction sets may differ in last digits. This
page is written by `tools/study_schema.py`.

Every Parquet file carries in its metadata (`polars.read_parquet_metadata`, keys `seismass.schema_version`,
`package_version`, `instructions`, `inputs_sha256`, `parameters`, `code`, `target`, `table`, `units`; each a JSON
text) the inputs and the unit of each column. `tables.json` contains the same for the CSV files, with the meaning of
each column. In unit columns, "1" is a ratio; an empty cell is a name or a count.

Floor masses are 1 kg: displacements do not depend on them, and forces are given over the weight W of the bare
building (g times the sum of its floor masses, without any live load).

Each building has three models:

- **real**: its goods are rigid blocks that may slide;
- **code**: the fraction `lambda_analysis` of their mass is attached to the floors, and there is no block;
- **attached**: all of their mass is attached.

Stiffness, strength, heights and P/h are the same in all three, as is the damping matrix C except with
`--damping-base own`. Attached over code is the effect of the remaining mass, real over attached that of sliding.

A failed run is a row with nulls and a reason; statistics of its model are null. A collapsed run is a row with its
peaks up to the collapse. Means of a model with a collapsed run, and quantities derived from them, are null; medians
and percentiles count its drift as infinite. Percentiles are linear between order statistics.

Every table that has buildings identifies them by the same columns:

"""

TAIL: Final = """## study.json

`schema_version`, `package_version`, `instructions` (the instruction set), `inputs_sha256` (samples, vertical ones
too, target and parameters), `parameters` (the grid, fractions, friction, Omega, r2, r3, damping and its base,
scaling period, modal combination, height, P-Delta, limit of collapse), `code` (its name, clauses, and how they were
checked), `target`, `suite` with every motion, `remarks` (what is unlikely about the inputs), `counts` (buildings,
analyses, distinct, completed, collapsed, failed), `scaling`, and `findings` per occupancy and friction coefficient:
the largest and the smallest underestimation with their place, their parts, their scatter over the motions and their
value without the most influential motion; the number of storeys in which the code model drifts more; the number of
single steps of alpha and of R, with a result at both ends, in which the underestimation grows by more than rounding;
and means over first storeys. `suite` has the number of synthetic motions and the remarks on each motion, `validation`
the motions of the validations. There is no date, so equal studies with the same instruction set give equal files.
`animation.json` has what the animation of the page shows.

## Figures

`drift_R1` ... `drift_R6` correspond to Figs. 6 to 9 of the paper, `spectrum` to Fig. 1; `underestimation` shows all
of them at once: the storey with the largest underestimation, what the attached model gives there, and the range
over the storeys of each building. With several friction coefficients there is one of each, with `_mu...` behind its
name. `heat` has the number of every storey, `slip` the slip of the goods. `effective` (with `--effective`) shows the
effective fractions against eta, `sensitivity` (with `--sensitivity`) the largest underestimation under each choice.
`section4_...` corresponds to Fig. 5 and `platform_...` to Fig. 4, each with the component of its record;
`section4_sliding` shows where goods slide most. Figures that an earlier study left in the folder and that are not
written again are removed.
"""


def page() -> str:
    """The page."""
    parts = [HEAD, _table(KEY_COLUMNS), "\n"]
    for name, (rows, columns) in TABLES.items():
        of_buildings = set(KEY_COLUMNS) <= set(columns)
        own = {column: text for column, text in columns.items() if not (of_buildings and column in KEY_COLUMNS)}
        parts += [f"## {name}: {rows}\n\n"]
        if of_buildings:
            parts += ["Beside the columns above:\n\n"]
        parts += [_table(own), "\n"]
    return "".join([*parts, TAIL])


def _table(columns: dict[str, tuple[str, str]]) -> str:
    rows = [f"| `{name}` | {unit} | {meaning} |" for name, (unit, meaning) in columns.items()]
    return "\n".join(["| column | unit | meaning |", "| --- | --- | --- |", *rows]) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    sys.exit(0)
