"""The keys of a scene file, as the package knows them."""

from __future__ import annotations

from itertools import groupby

from pages.parts import Page, table
from seismass.runs.scene_goods import ROWS

HEADS = "key | type | unit | default | meaning"


def fill(page: Page) -> None:
    """Put in a table for each section, in the order of the page."""
    for _, rows in groupby(ROWS, key=lambda row: row["section"]):
        cells = ([f"`{row['tables']}.{row['key']}`".replace("`.", "`"), *list(row.values())[3:]] for row in rows)
        page.tables(table(HEADS, cells))
