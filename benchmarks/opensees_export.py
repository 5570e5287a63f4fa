"""The OpenSeesPy models that `seismass building --opensees` writes, run and compared with the exact peaks.

    benchmarks/opensees_export.py [--write]

needs openseespy. `--write` puts the table into docs/opensees.md. The building is the example file with one friction of
0.25, so that nothing is left out of the models, and once more with its own contact, whose static friction is above the
kinetic one.
"""

from __future__ import annotations

import argparse
import csv
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

import seismass as sm
from environment import page_module
from seismass.assessment.building_file import example_file
from seismass.assessment.run import write_models

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "opensees.md"
MOTIONS: Final = 3


def compared(folder: Path, text: str) -> list[dict[str, str]]:
    """Assess a building file, write its models, run them under the first motions, and return the rows."""
    file = folder / "building.toml"
    file.write_text(text, encoding="utf-8")
    suite = sm.builtin_suite("seven")
    write_models(folder / "models", sm.assess(file, suite, resamples=100), suite)
    numbers = [str(number) for number in range(1, MOTIONS + 1)]
    command = [sys.executable, str(folder / "models" / "model.py"), "--motion", *numbers]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with (folder / "models" / "comparison.csv").open(encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def lines_of(title: str, rows: list[dict[str, str]]) -> list[str]:
    """Return the smallest and the largest ratio of drifts and of slips by model."""
    lines = [title, f"{'model':14}{'drift: OpenSees/exact':>26}{'slip: OpenSees/exact':>26}"]
    for model in dict.fromkeys(row["model"] for row in rows):
        cells = []
        for quantity in ("drift", "slip"):
            ratios = [
                float(row["ratio"])
                for row in rows
                if row["model"] == model and row["quantity"].startswith(quantity) and row["ratio"] != "-"
            ]
            cells.append(f"{min(ratios):.4f} to {max(ratios):.4f}" if ratios else "-")
        lines.append(f"{model:14}{cells[0]:>26}{cells[1]:>26}")
    return lines


def main() -> None:
    """Compare, print, and write as the option says."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    own = example_file().read_text(encoding="utf-8")
    contact = next(line for line in own.splitlines() if line.startswith("friction = "))
    lines: list[str] = []
    for title, text in (
        ("friction 0.25, static and kinetic", own.replace(contact, "mu = 0.25")),
        (f"{contact.split('#')[0].strip()}, static friction left out", own),
    ):
        with tempfile.TemporaryDirectory() as folder:
            lines += [*([""] if lines else []), *lines_of(title, compared(Path(folder), text))]
    print("\n".join(lines))
    if options.write:
        page = page_module("parts").Page(PAGE)
        page.block("comparison", lines)
        page.write()


if __name__ == "__main__":
    main()
