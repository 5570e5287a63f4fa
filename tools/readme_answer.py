"""Puts what `seismass building` prints for the example, with the built-in suite, into the README.

Usage: python tools/readme_answer.py
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Final

from seismass.assessment import assess
from seismass.records.builtin import data_directory

ROOT: Final = Path(__file__).parents[1]
BLOCK: Final = re.compile(r"(<!-- warehouse -->\n```text\n).*?(```\n<!-- end of warehouse -->)", re.DOTALL)
LAST: Final = "Stability coefficient"
"""The README ends before the line that begins so."""


def readme() -> str:
    """Return the README with the first part of the answer for the example."""
    text = assess(data_directory() / "examples" / "warehouse.toml").text().partition(LAST)[0].strip("\n")
    page = (ROOT / "README.md").read_text(encoding="utf-8")
    return BLOCK.sub(lambda match: f"{match[1]}{text}\n{match[2]}", page)


if __name__ == "__main__":
    (ROOT / "README.md").write_text(readme(), encoding="utf-8")
    sys.exit(0)
