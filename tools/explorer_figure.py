"""Writes docs/figures/explorer.png: the live page in Chromium with the case it opens with, at its largest drift, and
its dark twin.

Usage: python tools/explorer_figure.py, with Playwright and a Chromium on the path, after make explorer
"""

from __future__ import annotations

import runpy
import time
from pathlib import Path
from typing import Any, Final

from seismass.show.explore import explorer_html

ROOT: Final = Path(__file__).parents[1]
SCREENS: Final = runpy.run_path(str(ROOT / "tools" / "screens.py"))
FIGURE: Final = ROOT / "docs" / "figures" / "explorer.png"
SIZE: Final = (1280, 860)


def sliding(page: Any) -> None:
    """Wait for the effective fraction; without motion the page shows the time of the largest drift.

    Raises
    ------
    TimeoutError
        The page has none within a minute.
    """
    end = time.monotonic() + 60.0
    while not page.evaluate("'found' in document.querySelector('.explorer').dataset"):
        if time.monotonic() > end:
            raise TimeoutError("effective fraction of the page must be there within 60 s; got none")
        page.wait_for_timeout(20)


if __name__ == "__main__":
    SCREENS["keep_both"](explorer_html(), SIZE, FIGURE, sliding)
