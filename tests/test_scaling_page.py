"""docs/scaling.md is what tools/scaling_page.py writes today from the recordings."""

import runpy
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def test_page_is_current(shared: Path) -> None:
    module = runpy.run_path(str(ROOT / "tools" / "scaling_page.py"))
    assert module["PAGE"].read_text(encoding="utf-8") == module["page"](shared)
    assert module["FIGURE"].is_file()
