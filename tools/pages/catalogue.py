"""The seven records of the paper's Table 1, from the catalogue of the package."""

from __future__ import annotations

from pages.parts import Page, table
from seismass.motions.records.catalogue import DATABASE, SUBSTITUTES, TERMS, catalogue


def fill(page: Page) -> None:
    """Put in both tables, remarks, substitutes and terms."""
    rows, odd, files = [], [], []
    for row in catalogue().iter_rows(named=True):
        pulse = "none" if row["pulse_period"] is None else f"{row['pulse_period']:g}"
        flatfile = "not at hand"
        if row["nga_magnitude"] is not None:
            flatfile = f"{row['nga_magnitude']:g}, {row['nga_distance_km']:g} km, {row['nga_vs30']:g} m/s"
        numbers = (f"{row['magnitude']:g}", f"{row['distance_km']:g}", pulse, row["rsn"], flatfile)
        rows.append((row["number"], f"{row['event']}, {row['station']}", *numbers))
        if row["remark"]:
            odd.append(f"* {row['number']}, {row['station']}: {row['remark']}.")
        files.append((row["number"], ", ".join(f"`{name}`" for name in row["files"])))
    heads = "no. | record | M | D (km) | pulse (s) | RSN | NGA-West2 flatfile: M, closest distance, Vs30"
    page.tables(table(heads, rows), table("no. | files", files))
    page.after("Names, magnitude M, distance D", "\n".join(odd))
    others = " and ".join(f"{one.station} (RSN{one.rsn})" for one in SUBSTITUTES)
    page.words("of the same event: {}. ## How to get them {}. Sign in at <{}>,", others, TERMS, DATABASE)
