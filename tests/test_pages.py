"""Pages with numbers from recordings are what the kernel gives: the section-4 table and the findings in the README."""

from __future__ import annotations

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_section4_page_is_current(shared: Path) -> None:
    page = runpy.run_path(str(ROOT / "tools" / "section4_table.py"))["page"](shared)
    assert (ROOT / "docs" / "section4.md").read_text(encoding="utf-8") == page
    assert "All storeys yield in every run" in page


def test_readme_findings_are_current(shared: Path) -> None:
    readme = runpy.run_path(str(ROOT / "tools" / "readme_findings.py"))["readme"](shared)
    assert (ROOT / "README.md").read_text(encoding="utf-8") == readme
    assert "largest underestimation" in readme
