"""Kinds of files beside records and unusual ways to write them: read rightly, or refused for their cause."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest

from seismass.base.errors import RecordFormatError
from seismass.motions.records import read_records

ROOT = Path(__file__).parents[1]
TOOL = runpy.run_path(str(ROOT / "tools" / "kinds_of_files.py"))
KINDS = TOOL["kinds"]()


def check(path: Path, name: str, *, made: bool) -> None:
    """Hold what is read against what the kind says; peaks to the last digit of the fewest decimals, 1e-4 g."""
    kind = KINDS[name]
    if kind.refused:
        with pytest.raises(RecordFormatError, match=kind.refused):
            read_records(path, **kind.arguments)
        return
    records = read_records(path, **kind.arguments)
    first = records[0]
    assert len(records) == kind.channels
    assert any(re.search(kind.remark, remark) for remark in first.remarks) or not kind.remark
    if made or kind.points == TOOL["POINTS"]:
        assert first.samples == kind.points
        assert first.dt == pytest.approx(kind.dt, rel=1e-9)
        assert first.pga_g == pytest.approx(kind.peak_g, abs=1e-4 if made else 2.2e-3)


@pytest.mark.parametrize("name", sorted(KINDS))
def test_a_kind_is_read_rightly_or_refused_for_its_cause(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_bytes(KINDS[name].content)
    check(path, name, made=True)


def test_files_of_others_of_the_same_kinds(shared: Path) -> None:
    """Their motion has its peak, 0.3 g, to 2.1e-3 g in those whose times or digits are rounded."""
    folder = shared / "findings" / "motions" / "inputs"
    if not folder.is_dir():
        pytest.skip(f"no folder {folder}: motions of others are not read")
    files = [path for path in folder.iterdir() if path.name in KINDS]
    assert len(files) >= 40
    for path in files:
        check(path, path.name, made=False)
