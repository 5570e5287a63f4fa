"""docs/codes.md: the table of fractions, and the legend of its marks."""

from __future__ import annotations

import seismass as sm
from pages.parts import Page, table
from seismass.commands.listings import fraction_text
from seismass.model.codes import MARK

HEADS = "id | code | edition | use | fraction | clause | status | note"


def fill(page: Page) -> None:
    """Put in one row per code and use."""
    rows = []
    for row in sm.codes.code_table().iter_rows(named=True):
        fraction = "" if row["fraction"] is None else fraction_text(row["low"], row["high"])
        code = row["code"] + MARK * (not row["checked"])
        rows.append([f"`{row['code_id']}`", code, row["edition"], row["use"], fraction])
        rows[-1] += [row["clause"], row["status"], row["note"]]
    page.tables(table(HEADS, rows))
