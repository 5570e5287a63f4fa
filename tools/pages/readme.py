"""What `seismass building` prints for the example, with the built-in suite, in the README."""

from __future__ import annotations

from pages.parts import Page
from seismass.assessment import assess
from seismass.motions.records.builtin import data_directory

FILE = "README.md"


def fill(page: Page) -> None:
    """Put in the first part of the answer."""
    text = assess(data_directory() / "examples" / "warehouse.toml").text
    page.block("warehouse", [text.partition("Peak storey drift")[0].strip("\n")])
