"""Puts what `seismass building` prints for the example, with the built-in suite, into the README.

Usage: python tools/readme_answer.py
"""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from typing import Final

from seismass.assessment import assess
from seismass.records.builtin import data_directory

ROOT: Final = Path(__file__).parents[1]
PARTS: Final = runpy.run_path(str(ROOT / "tools" / "page_parts.py"))
LAST: Final = "Stability coefficient"
"""The README ends before the line that begins so."""


def readme() -> str:
    """Return the README with the first part of the answer for the example."""
    text = assess(data_directory() / "examples" / "warehouse.toml").text.partition(LAST)[0].strip("\n")
    page = (ROOT / "README.md").read_text(encoding="utf-8")
    changed: str = PARTS["with_block"](page, "warehouse", [text])
    return changed


if __name__ == "__main__":
    (ROOT / "README.md").write_text(readme(), encoding="utf-8")
    sys.exit(0)
