"""What was tried to lose, damage or misuse results, and what became of it.

Each row is a command of this project, which is run; a row whose command fails ends the program, and nothing is written.
It takes some ten minutes. Browser and workers are needed, so that nothing is skipped.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from typing import Final

from pages.parts import ROOT, Page
from seismass.base.limits import LIMITS

FILES: Final = 5000
"""Mutated files of each program."""
TESTS: Final = (
    ("a campaign killed (-9) at random times, 20 times, and again until whole; workers killed; a full disk",
     "test_campaign_killed.py", "the same bytes as undisturbed"),
    ("kept results of a study or a file: killed, damaged, of other inputs, in a folder of somebody else",
     "test_stored_results.py", "the same bytes, or solved again; nothing foreign is read"),
    ("folders that bring pickles, links, other parts, edited axes", "test_hostile_folders.py",
     "nothing is run, nothing of others deleted; refused in one line"),
    ("folders and files: writers killed in turn by -9, SIGTERM and SIGHUP, two at once, errors in the middle; links "
     "in place of what is written, and races for its name, in a plain and a sticky folder", "test_writing.py",
     "one run or the other, whole; nothing outside is written"),
    ("figures beside a matplotlibrc, style sheets, settings of a program", "test_figure_defaults.py", "the same bytes"),
    ("a campaign's folder, its bits flipped, parts exchanged, cut or missing", "test_campaign_folder.py",
     "each change is told by `--verify` and by `scan`"),
    ("a folder of a building or a study: bits flipped, files missing or added", "test_edited_folders.py",
     "refused by `report` with the name of the file; with `--force` said on the page"),
    ("files that are devices, pipes, endless, or ask for hours", "test_inputs_without_end.py", "refused at once"),
    ("names of control characters, marks and formulas", "test_hostile_names.py", "shown as escapes"),
    ("pages with 20 names of scripts, handlers and addresses, in Chromium", "browser/test_hostile_pages.py",
     "no script runs, nothing is asked for"),
    ("every public function, and every method of results and of plots, with None, text, arrays, NaN, huge numbers",
     "test_wrong_calls.py", "an error of the package"),
)  # fmt: skip
"""What is tried, the file of its tests, and what becomes of it."""


def fill(page: Page) -> None:
    """Run everything and put in the table, where it is asked for."""
    if page.wants("tried"):
        page.marked("tried", tried())
    page.marked("limits", limits())
    if page.wants("asked"):
        page.marked("asked", table_of("tools/hostile_files.py"))
    if page.wants("killed"):
        page.marked("killed", table_of("tools/killed_commands.py"))
    if page.wants("kinds"):
        page.marked("kinds", kinds())


def limits() -> str:
    """Return the table of limits, which stands in the package."""
    rows = [f"| {' | '.join(row)} |" for row in LIMITS]
    return "\n".join(["| what is read | limit of | at most |", "| --- | --- | ---: |", *rows])


def table_of(program: str) -> str:
    """Run a program, which fails where something is not as it should be, and return the table that it prints."""
    done = run(program)
    if done.returncode:
        sys.exit(f"{program}:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout.strip()


def kinds() -> str:
    """Mutate files of each kind and return what became of them."""
    done = run("tools/fuzz_inputs.py", "--count", str(FILES), "--seed", "2026")
    found = re.findall(r"^(\S.*?) *read +(\d+), refused +(\d+), defect +(\d+)$", done.stdout, re.MULTILINE)
    if done.returncode or not found:
        sys.exit(f"fuzz_inputs.py:\n{done.stdout[-3000:]}")
    rows = [f"| {name} | {sum(map(int, counts))} | {' | '.join(counts)} |" for name, *counts in found]
    head = ["| kind | files | read | refused in one line | defects |", "| --- | ---: | ---: | ---: | ---: |"]
    return "\n".join([*head, *rows])


def run(*command: str) -> subprocess.CompletedProcess[str]:
    """Run a program of Python with the package of this folder."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "python")}
    return subprocess.run([sys.executable, *command], cwd=ROOT, env=environment, capture_output=True, text=True)


def tested(file: str) -> str:
    """Run a file of tests and return how many there are."""
    done = run("-m", "pytest", "-q", "-n", "2", "-p", "no:cacheprovider", f"tests/{file}")
    passed = re.search(r"^(\d+) passed(.*) in ", done.stdout, re.MULTILINE)
    if done.returncode or passed is None or "skipped" in passed[2]:
        sys.exit(f"{file}:\n{done.stdout[-3000:]}")
    return f"{passed[1]} tests"


def mutated(program: str) -> str:
    """Run a program that mutates files, which fails where there is a defect, and return how many there were."""
    done = run(f"tools/{program}", "--count", str(FILES), "--seed", "2026")
    if done.returncode:
        sys.exit(f"{program}:\n{done.stdout[-3000:]}")
    return f"{FILES} files"


def tried() -> str:
    """Return the table of what was tried."""
    rows = [f"| {what} | {tested(file)} | {result} | `tests/{file}` |" for what, file, result in TESTS]
    whole = "read, or one line of error; no other exception, none slow or large"
    for what, program in (
        ("record files mutated, of every format that is read as text", "fuzz_records.py"),
        ("every other kind of input, folders of campaigns, assessments and studies, links of the live page mutated",
         "fuzz_inputs.py"),
    ):  # fmt: skip
        rows.append(f"| {what} | {mutated(program)} | {whole} | `tools/{program}` |")
    return "\n".join(["| tried | number | result | by |", "| --- | ---: | --- | --- |", *rows])
