"""Puts the findings of the study on the recorded motions, and its figure, into the README.

Usage: SEISMASS_SHARED=... python tools/readme_findings.py
The recordings are not part of this project: SEISMASS_SHARED names the folder that holds them.
"""

from __future__ import annotations

import os
import runpy
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Final

from seismass.cli import main as seismass
from seismass.records import read_suite
from seismass.show.study.findings import findings_text
from seismass.spectra import TargetSpectrum
from seismass.study import run_study
from seismass.study.findings import findings

ROOT: Final = Path(__file__).parents[1]
PARTS: Final = runpy.run_path(str(ROOT / "tools" / "page_parts.py"))
SUITE: Final = Path("records/paper_seven.csv")


def readme(shared: Path) -> str:
    """The README with the findings of a study on the recordings in `shared`."""
    result = run_study(read_suite(shared / SUITE), TargetSpectrum.asce7())
    text = findings_text(findings(result.summary, result.fractions, result.metadata["code"]["name"])).strip("\n")
    page = (ROOT / "README.md").read_text(encoding="utf-8")
    changed: str = PARTS["with_block"](page, "findings", [text])
    return changed


def main() -> int:
    """Writes README and figure; 0 if the recordings were there."""
    shared = os.environ.get("SEISMASS_SHARED")
    if not shared:
        print("SEISMASS_SHARED is not set: it names the folder with the recordings", file=sys.stderr)
        return 2
    (ROOT / "README.md").write_text(readme(Path(shared)), encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        code = seismass(["study", "--records", str(Path(shared) / SUITE), "--out", folder])
        shutil.copy(Path(folder) / "underestimation.png", ROOT / "docs" / "figures" / "underestimation.png")
    return code


if __name__ == "__main__":
    sys.exit(main())
