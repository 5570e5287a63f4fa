"""Pictures of pages in headless Chromium, for the tools that write figures of the documentation.

A tool loads it with `runpy.run_path`. Playwright drives the Chromium that is on the path, as the tests of pages do.
"""

from __future__ import annotations

import io
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from PIL import Image
from playwright.sync_api import sync_playwright

SCHEMES: Final = {"light": "", "dark": "_dark"}
"""Colour schemes, and how the names of their pictures end."""


def screen(
    html: str, size: tuple[int, int], prepare: Callable[[Any], None] = lambda page: None, scheme: str = "light"
) -> Image.Image:
    """Return what a screen shows of a page, without motion.

    Parameters
    ----------
    html : str
        The page, which needs no other file.
    size : tuple of int
        Width and height of the screen (CSS pixels).
    prepare : callable, optional
        Called with the page of Playwright before the picture is taken.
    scheme : {"light", "dark"}
        Colour scheme of the screen.

    Raises
    ------
    SystemExit
        There is no Chromium on the path.
    """
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        raise SystemExit("a picture needs Chromium on the path (Debian, Ubuntu: apt-get install chromium)")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = Path(folder, "page.html")
        file.write_text(html, encoding="utf-8")
        # The sandbox of Chromium refuses to run as root, as in a container; pages are this project's own.
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        width, height = size
        page = browser.new_page(
            viewport={"width": width, "height": height}, color_scheme=scheme, reduced_motion="reduce"
        )
        page.goto(file.as_uri())
        prepare(page)
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        browser.close()
    return picture


def keep_both(html: str, size: tuple[int, int], file: Path, prepare: Callable[[Any], None] = lambda page: None) -> None:
    """Write what screens of both colour schemes show of a page: `file`, and its dark twin beside it."""
    for scheme, end in SCHEMES.items():
        keep(screen(html, size, prepare, scheme), file.with_stem(file.stem + end))


def keep(picture: Image.Image, file: Path, colours: int = 64) -> None:
    """Write a picture with few colours as PNG, and say how large it is."""
    picture.quantize(colours, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(file, optimize=True)
    print(f"{file.name}: {file.stat().st_size / 1e3:.0f} kB")
