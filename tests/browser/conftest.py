"""A Chromium that opens pages, and what is asked of every page: no error, no request, nothing hidden, legible.

Skipped with a word where there is no Chromium on the path or no Playwright. Pictures of all pages are left in
out/screenshots, for people to look at.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

SCREENSHOTS = Path(__file__).parents[2] / "out" / "screenshots"
CHECKS = (Path(__file__).parent / "checks.js").read_text(encoding="utf-8")
WIDTHS = (360, 1280)
"""A small phone and a laptop (CSS pixels)."""
PRINTED = 680
"""Width of the text on A4 with margins of 15 mm, the narrower of the two sizes (CSS pixels)."""
SCHEMES = ("light", "dark")
AXE_RUN = """() => axe.run(document).then((found) => found.violations.flatMap((rule) =>
    rule.nodes.map((node) => `${rule.id}: ${node.target} ${node.html.slice(0, 120)}`)))"""
"""What axe-core finds wrong, a line for each place."""


@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    """Debian's Chromium, or another one on the path, driven by Playwright."""
    api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed: no page is opened")
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        pytest.skip("no Chromium on the path (Debian, Ubuntu: apt-get install chromium): no page is opened")
    with api.sync_playwright() as playwright:
        # The sandbox of Chromium refuses to run as root, as in a container; pages are this project's own.
        started = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield started
        started.close()


@pytest.fixture
def open_page(browser: Browser, tmp_path: Path) -> Callable[..., Any]:
    """Return what opens a page: `with open_page(html, name, width=360, color_scheme="dark") as page`.

    What is folded on a phone is opened but with `folded=True`. When it is left, there was nothing on the console and no
    request but that for the page; what a page made itself, such as the script of a worker, is none.
    """

    @contextmanager
    def opened(html: str, name: str, *, width: int = 1280, folded: bool = False, **options: Any) -> Iterator[Page]:
        file = tmp_path / f"{name}.html"
        file.write_text(html, encoding="utf-8")
        context = browser.new_context(viewport={"width": width, "height": 900}, offline=True, **options)
        page = context.new_page()
        said: list[str] = []
        asked: list[str] = []
        page.on("console", lambda message: said.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: said.append(f"error: {error}"))
        page.on("request", lambda request: None if request.url.startswith("blob:") else asked.append(request.url))
        page.goto(file.as_uri())
        if not folded:
            page.evaluate("document.querySelectorAll('.fold[aria-expanded=false]').forEach((button) => button.click())")
        yield page
        context.close()
        assert said == []
        assert asked == [file.as_uri()]

    return opened


@pytest.fixture(scope="package")
def violations() -> Callable[[Page], list[str]]:
    """Return what asks axe-core, the rules of accessibility by Deque, about a page."""
    package = pytest.importorskip("axe_playwright_python", reason="axe-playwright-python is not installed")
    source = (Path(package.__file__).parent / "axe.min.js").read_text(encoding="utf-8")

    def found(page: Page) -> list[str]:
        page.evaluate(source)
        listed: list[str] = page.evaluate(AXE_RUN)
        return listed

    return found


@pytest.fixture
def look(open_page: Callable[..., Any], violations: Callable[[Page], list[str]]) -> Callable[..., None]:
    """Return what looks at a page as every page is looked at: `look(html, name)`, at all widths and in both schemes.

    `prepare` is called with the page before it is looked at.
    """

    def looked(html: str, name: str, prepare: Callable[[Page], None] = lambda page: None) -> None:
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        for width in WIDTHS:
            for scheme in SCHEMES:
                options = {"width": width, "color_scheme": scheme, "reduced_motion": "reduce"}
                with open_page(html, name, **options) as page:
                    prepare(page)
                    page.screenshot(path=SCREENSHOTS / f"{name}-{width}-{scheme}.png", full_page=True)
                    found = page.evaluate(CHECKS)
                    broken = violations(page)
                where = f"{name} at {width} px, {scheme}"
                assert found["problems"] == [], where
                assert found["texts"] > 10, where  # the checks had something to look at
                assert broken == [], where
        with open_page(html, name, width=PRINTED) as page:
            prepare(page)
            page.emulate_media(media="print", color_scheme="light")
            assert page.evaluate(CHECKS)["problems"] == [], f"{name}, printed"
            for size in ("A4", "Letter"):
                page.pdf(path=SCREENSHOTS / f"{name}-{size}.pdf", format=size)

    return looked
