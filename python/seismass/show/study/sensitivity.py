"""The sensitivity of a study to its choices as a text to read and as a table of a page."""

from __future__ import annotations

import polars as pl

from seismass.media.text_table import change_text, text_table

_HEADS = ("choice", "setting", "largest", "smallest R", "largest R", "mass", "sliding")
_VALUES = ("largest_percent", "least_R_percent", "most_R_percent", "mass_percent", "sliding_percent")


def sensitivity_text(table: pl.DataFrame) -> str:
    """Return `Sensitivity.table` as lines, one block per occupancy and friction coefficient."""
    blocks = []
    for title, rows in _groups(table):
        lines = [
            f"{title}: first storeys, underestimation (goods slide - code) / code",
            *text_table([_HEADS, *rows], left=2),
        ]
        blocks.append("\n".join(lines))
    notes = (
        "largest: of all first storeys. smallest R, largest R: mean of those with the largest alpha, at that\n"
        "R. mass, sliding: what the last one is made of, all attached over code and goods slide over all."
    )
    if (table["collapses"] > 0).any():
        notes += "\n-: runs collapsed, and there is no mean."
    return "\n".join([*blocks, notes])


def sensitivity_markdown(table: pl.DataFrame) -> str:
    """Return the table in Markdown, one table per occupancy and friction coefficient."""
    parts = []
    for title, rows in _groups(table):
        lines = [f"| {' | '.join(_HEADS)} |", "| --- | --- | --: | --: | --: | --: | --: |"]
        lines += [f"| {' | '.join(row)} |" for row in rows]
        parts.append(f"{title}:\n\n" + "\n".join(lines))
    return "\n\n".join(parts)


def _groups(table: pl.DataFrame) -> list[tuple[str, list[list[str]]]]:
    """Title and rows of text of each occupancy and friction coefficient; a choice is named once."""
    groups = []
    several = table["mu"].n_unique() > 1
    for (occupancy, mu), rows in table.group_by("occupancy", "mu", maintain_order=True):
        title = f"{occupancy}, mu = {mu:g}" if several else str(occupancy)
        texts: list[list[str]] = []
        before = None
        for row in rows.iter_rows(named=True):
            name = "" if row["choice"] == before else row["choice"]
            before = row["choice"]
            collapsed = f" ({row['collapses']} runs collapse)" if row["collapses"] else ""
            texts.append([name, row["setting"] + collapsed, *(change_text(row[column]) for column in _VALUES)])
        groups.append((title, texts))
    return groups
