"""Checks the links of a built site: every file and every anchor inside it exists. Addresses elsewhere are not asked.

Usage: python tools/check_links.py FOLDER. Pages of rustdoc, which cargo checks, are targets alone.
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Final
from urllib.parse import unquote, urlsplit

NOT_PAGES: Final = ("rust", "_static")
"""Folders of rustdoc, and of files of the theme."""


class Page(HTMLParser):
    """Links and anchors of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Collect what an element has."""
        for name, value in attrs:
            if value is None:
                continue
            if name in ("id", "name"):
                self.anchors.add(value)
            elif (name == "href" and tag in ("a", "link")) or (name == "src" and tag in ("img", "script", "iframe")):
                self.links.append(value)


def broken(folder: Path) -> list[str]:
    """Return the links of the pages of a folder that lead nowhere, or that would fetch something from elsewhere."""
    sources = [path for path in sorted(folder.rglob("*.html")) if path.relative_to(folder).parts[0] not in NOT_PAGES]
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sources}
    found = []
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = path if not parts.path else (path.parent / unquote(parts.path)).resolve()
            target = target / "index.html" if target.is_dir() else target
            place = f"{path.relative_to(folder)}: {link}"
            if not target.exists():
                found.append(f"{place} (no such file)")
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                found.append(f"{place} (no such anchor)")
    return found


if __name__ == "__main__":
    wrong = broken(Path(sys.argv[1]).resolve())
    print("\n".join(wrong))
    sys.exit(bool(wrong))
