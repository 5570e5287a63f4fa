"""Writes docs/figures/building_page.png: the top of the page that `seismass building` writes for its example, and its
dark twin.

Usage: python tools/building_picture.py, with Playwright and a Chromium on the path
"""

from __future__ import annotations

import runpy
import tempfile
from pathlib import Path
from typing import Final

from seismass.assessment import assess
from seismass.assessment.building_file import example_file

ROOT: Final = Path(__file__).parents[1]
SCREENS: Final = runpy.run_path(str(ROOT / "tools" / "screens.py"))
FIGURE: Final = ROOT / "docs" / "figures" / "building_page.png"
SIZE: Final = (1040, 1212)
"""Of the screen (CSS pixels): what a reader sees first, down to what governs each storey."""


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        assess(example_file()).write(folder)
        page = Path(folder, "report.html").read_text(encoding="utf-8")
    SCREENS["keep_both"](page, SIZE, FIGURE)
