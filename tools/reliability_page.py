"""Writes the table of docs/reliability.md: what was tried to lose, damage or misuse results, and what became of it.

Usage: tools/reliability_page.py [--files 5000]; some ten minutes. Each row is a command of this project, which is run;
a row whose command fails ends the program, and nothing is written. Browser and workers are needed, so that nothing is
skipped.
"""

from __future__ import annotations

import argparse
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "reliability.md"
PARTS: Final = runpy.run_path(str(ROOT / "tools" / "page_parts.py"))
TESTS: Final = (
    ("a campaign killed (-9) at random times, 20 times, and again until whole; workers killed; a full disk",
     "test_campaign_killed.py", "the same bytes as undisturbed"),
    ("kept results of a study or a file: killed, damaged, of other inputs, in a folder of somebody else",
     "test_kept.py", "the same bytes, or solved again; nothing foreign is read"),
    ("folders that bring pickles, links, other parts, edited axes", "test_hostile_folders.py",
     "nothing is run, nothing of others deleted; refused in one line"),
    ("a campaign's folder, its bits flipped, parts exchanged, cut or missing", "test_campaign_folder.py",
     "each change is told by `--verify`"),
    ("a folder of a building or a study: bits flipped, files missing or added", "test_edited_folders.py",
     "refused by `report` with the name of the file; with `--force` said on the page"),
    ("files that are devices, pipes, endless, or ask for hours", "test_inputs_without_end.py", "refused at once"),
    ("names of control characters, marks and formulas", "test_hostile_names.py", "shown as escapes"),
    ("pages with 20 names of scripts, handlers and addresses, in Chromium", "browser/test_hostile_pages.py",
     "no script runs, nothing is asked for"),
    ("every public call with None, text, arrays, NaN, huge numbers", "test_wrong_calls.py",
     "an error of the package"),
)  # fmt: skip
"""What is tried, the file of its tests, and what becomes of it."""


def environment() -> dict[str, str]:
    """Return the one at hand, with the package of this folder."""
    return {**os.environ, "PYTHONPATH": str(ROOT / "python")}


def tested(file: str) -> str:
    """Run a file of tests and return how many there are."""
    command = [sys.executable, "-m", "pytest", "-q", "-n", "2", "-p", "no:cacheprovider", str(ROOT / "tests" / file)]
    done = subprocess.run(command, cwd=ROOT, env=environment(), capture_output=True, text=True)
    passed = re.search(r"^(\d+) passed(.*) in ", done.stdout, re.MULTILINE)
    if done.returncode or passed is None or "skipped" in passed[2]:
        sys.exit(f"{file}:\n{done.stdout[-3000:]}")
    return f"{passed[1]} tests"


def mutated(program: str, files: int) -> str:
    """Run a program that mutates files, which fails where there is a defect, and return how many there were."""
    command = [sys.executable, str(ROOT / "tools" / program), "--count", str(files), "--seed", "2026"]
    done = subprocess.run(command, cwd=ROOT, env=environment(), capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{program}:\n{done.stdout[-3000:]}")
    return f"{files} files"


def table(files: int) -> str:
    """Return the table of what was tried."""
    rows = [f"| {tried} | {tested(file)} | {result} | `tests/{file}` |" for tried, file, result in TESTS]
    whole = "read, or one line of error; no other exception, none slow or large"
    for tried, program in (
        ("record files mutated, of every format that is read as text", "fuzz_records.py"),
        ("scenes, buildings, campaigns, spectra, hazard curves; folders of campaigns, assessments, studies mutated",
         "fuzz_inputs.py"),
    ):  # fmt: skip
        rows.append(f"| {tried} | {mutated(program, files)} | {whole} | `tools/{program}` |")
    return "\n".join(["| tried | number | result | by |", "| --- | ---: | --- | --- |", *rows])


def main() -> None:
    """Run everything, then write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--files", type=int, default=5000, help="mutated files of each program")
    made = table(parser.parse_args().files)
    PAGE.write_text(PARTS["with_text"](PAGE.read_text(encoding="utf-8"), "tried", made), encoding="utf-8")


if __name__ == "__main__":
    main()
