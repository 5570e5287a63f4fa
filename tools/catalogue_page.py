"""Writes docs/catalogue.md: the seven records of the paper's Table 1, from the catalogue of the package.

Usage: python tools/catalogue_page.py
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

from seismass.records.catalogue import DATABASE, SUBSTITUTES, TERMS, catalogue

PAGE: Final = Path(__file__).parents[1] / "docs" / "catalogue.md"

TEXT: Final = """# The paper's seven records

The paper uses one component of each of seven recordings (its Table 1). They belong to PEER and are not part of this
project; `seismass.records.catalogue()` has the table as data, and

```sh
seismass records                    # the table with remarks, and how to obtain each record
seismass records --find Downloads/  # which of the seven a folder holds
```

A file is identified by its header (event, year, station, component) and by its content: number of points, place of
the peak, and ratio of its two largest accelerations of either sign. Renamed files and files without a header are
found, in any unit. Scaled, truncated and reprocessed files are reported as such. The name of a file alone is not
sufficient. Written by `tools/catalogue_page.py`.

| no. | record | M | D (km) | pulse (s) | RSN | NGA-West2 flatfile: M, closest distance, Vs30 |
| --- | --- | --- | --- | --- | --- | --- |
{rows}

Names, magnitude M, distance D and pulse period are those of the paper. Values of the flatfile are given where
available; both agree within the rounding of the paper.

{odd}

Substitutes for record 7, other stations of the same event: {substitutes}.

## How to get them

{terms}. Sign in at <{database}>, search by RSN, choose unscaled records, and download:

| no. | files |
| --- | --- |
{files}
"""


def page() -> str:
    """Return the page."""
    rows, odd, files = [], [], []
    for row in catalogue().iter_rows(named=True):
        pulse = "none" if row["pulse_period"] is None else f"{row['pulse_period']:g}"
        flatfile = "not at hand"
        if row["nga_magnitude"] is not None:
            flatfile = f"{row['nga_magnitude']:g}, {row['nga_distance_km']:g} km, {row['nga_vs30']:g} m/s"
        rows.append(
            f"| {row['number']} | {row['event']}, {row['station']} | {row['magnitude']:g} | {row['distance_km']:g} | "
            f"{pulse} | {row['rsn']} | {flatfile} |"
        )
        if row["remark"]:
            odd.append(f"* {row['number']}, {row['station']}: {row['remark']}.")
        files.append(f"| {row['number']} | {', '.join(f'`{name}`' for name in row['files'])} |")
    return TEXT.format(
        rows="\n".join(rows),
        odd="\n".join(odd),
        substitutes=" and ".join(f"{one.station} (RSN{one.rsn})" for one in SUBSTITUTES),
        terms=TERMS,
        database=DATABASE,
        files="\n".join(files),
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
