"""Writes docs/figures/explorer.png: the live page in Chromium with the case it opens with, while goods slide.

Usage: python tools/explorer_figure.py, with Playwright and a Chromium on the path, after make explorer
"""

from __future__ import annotations

import io
import shutil
import tempfile
import time
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

from seismass.explore import explorer_html

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "explorer.png"
SIZE = {"width": 1280, "height": 1120}
TIME = 8.5
"""Time of the animation (s): near the largest drift."""


def main() -> None:
    """Open the page, wait for the effective fraction, go to the time, and keep what a screen shows."""
    program = shutil.which("chromium") or shutil.which("google-chrome")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = Path(folder, "explorer.html")
        file.write_text(explorer_html(), encoding="utf-8")
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page = browser.new_page(viewport=SIZE, color_scheme="light", reduced_motion="reduce")
        page.goto(file.as_uri())
        end = time.monotonic() + 60.0
        while not page.evaluate("'found' in document.querySelector('.explorer').dataset"):
            if time.monotonic() > end:
                raise TimeoutError("effective fraction of the page must be there within 60 s; got none")
            page.wait_for_timeout(20)
        page.locator(".time").evaluate("(e, t) => { e.value = t; e.dispatchEvent(new Event('input')); }", TIME)
        picture = Image.open(io.BytesIO(page.screenshot()))
        browser.close()
    picture.convert("RGB").quantize(64, dither=Image.Dither.NONE).save(FIGURE, optimize=True)
    print(f"{FIGURE.name}: {FIGURE.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
