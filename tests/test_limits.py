"""Limits of everything that is read are met before the memory is used; one table has them."""

from __future__ import annotations

import ast
import re
import runpy
from pathlib import Path
from typing import Any

import pytest

import seismass as sm
from seismass.base import limits

ROOT = Path(__file__).parents[1]
PROGRAM: dict[str, Any] = runpy.run_path(str(ROOT / "tools" / "hostile_files.py"))


@pytest.mark.parametrize("name", PROGRAM["FILES"])
def test_a_file_that_asks_for_memory_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    """Within a gigabyte and half a minute, or read within them."""
    _, _, _, outcome = PROGRAM["tried"](name, tmp_path)
    assert not outcome.startswith("defect"), outcome
    assert re.search("must be|larger than", outcome) or name in ("record, 2 000 000 rows", READ), outcome
    assert list(tmp_path.glob("*.zip")) == []


READ = "record, 24 MB of rows of a hundred"


def test_the_page_has_the_table_of_limits() -> None:
    text = (ROOT / "docs" / "reliability.md").read_text(encoding="utf-8")
    for row in limits.LIMITS:
        assert f"| {' | '.join(row)} |" in text


def test_limits_of_what_is_read_stand_in_their_module_alone() -> None:
    """Sizes in bytes elsewhere are of what is written, or of pieces."""
    package = Path(sm.__file__).parent
    found = []
    for path in sorted(package.rglob("*.py")):
        place = path.relative_to(package).as_posix()
        if place.startswith("data/") or place == "base/limits.py":
            continue
        for node in ast.parse(path.read_text("utf-8")).body:
            target = node.target if isinstance(node, ast.AnnAssign) else None
            if isinstance(target, ast.Name) and re.search(
                "MOST.*BYTES|LARGEST.*BYTES|UNPACKED|MOST_MEMBERS", target.id
            ):
                found.append(f"{place}: {target.id}")
    assert found == ["base/stored_results.py: _MOST_BYTES", "motions/records/catalogue_search.py: _LARGEST_BYTES"]
