"""The section-4 building of the paper: the table in the docs is what the kernel gives."""

from __future__ import annotations

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_section4_page_is_current(shared: Path) -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "section4_table.py"))
    page = tool["page"](shared)
    assert (ROOT / "docs" / "section4.md").read_text(encoding="utf-8") == page
    assert "All storeys yield in every run" in page
