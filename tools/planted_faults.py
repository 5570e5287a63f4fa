"""Faults that tools/mutants.py plants: those of tests/mutants, and those drawn at random in the Python package."""

from __future__ import annotations

import ast
import re
import runpy
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import random_faults

ROOT: Final = Path(__file__).parents[1]
PACKAGE: Final = Path("python/seismass")
KERNEL: Final = Path("crates/seismass/src")
LISTED: Final = ("Python, listed", "Rust, listed")
DRAWN: Final = ("Python, drawn at random", "Rust, drawn at random")
COMMON: Final = 12
"""A name that more test files than these mention does not say whose tests they are."""


@dataclass
class Fault:
    """One fault, and what became of it."""

    group: str
    number: int
    what: str
    path: Path
    """From the root of the tree."""
    text: str = ""
    """Its file with the fault, of Python."""
    tests: tuple[str, ...] = ()
    """Test files that are asked first."""
    reason: str = ""
    """Why it is no fault, where that was shown: no test is asked."""
    caught: str = ""
    """The tier that saw it, or nothing."""
    killer: str = ""

    @property
    def layer(self) -> str:
        """Folder of the package, or module of the kernel."""
        for root in (PACKAGE, KERNEL):
            if self.path.is_relative_to(root):
                return self.path.relative_to(root).with_suffix("").parts[0]
        return self.path.parts[1]


def listed(language: str, name: str = "FAULTS") -> list | dict:
    """The list of faults of a language, or the reasons why some that may be drawn are none."""
    return runpy.run_path(str(ROOT / f"tests/mutants/{language}_faults.py")).get(name, {})


def python_faults() -> tuple[list[Fault], list[str]]:
    """Faults of the list, and what is wrong with it."""
    faults, wrong = [], []
    for number, what, file, old, new, tests, reason in listed("python"):
        text = (ROOT / PACKAGE / file).read_text(encoding="utf-8")
        if text.count(old) != 1:
            wrong.append(f"Python fault {number}: its text must occur once in {file}; got {text.count(old)} times")
        path = PACKAGE / file
        faults.append(Fault(LISTED[0], number, what, path, text.replace(old, new), tuple(tests.split()), reason))
    return faults, wrong


def rust_faults() -> tuple[list[Fault], dict[Path, str], list[str]]:
    """Faults of the list, the files with all of them behind their switches, and what is wrong with the list."""
    faults, files, wrong = [], {}, []
    for number, what, file, old, new, reason in listed("rust"):
        path = Path("crates") / file
        text = files.setdefault(path, (ROOT / path).read_text(encoding="utf-8"))
        if text.count(old) != 1:
            wrong.append(f"Rust fault {number}: its text must occur once in {file}; got {text.count(old)} times")
        crate = "crate" if path.is_relative_to(KERNEL) else "seismass"
        files[path] = text.replace(old, re.sub(r"M!\((\d+)\)", rf"{crate}::mutant::on(\1)", new))
        faults.append(Fault(LISTED[1], number, what, path, reason=reason))
    return faults, files, wrong


def tests_of(module: Path, text: str, tests: dict[str, str]) -> tuple[str, ...]:
    """Test files that name the module, or what it defines, in code, and those whose names have a word of its path.

    Where there are none, those that draw figures.
    """
    parts = ("seismass", *module.relative_to(PACKAGE).with_suffix("").parts)
    folder, name = re.escape(".".join(parts[:-1])), re.escape(parts[-1])
    definitions = [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef | ast.ClassDef)]
    # A word of prose is no name: it is called, an attribute, or imported.
    words = [
        rf"\b{node.name}\(|\.{node.name}\b|import .*\b{node.name}\b|^ +{node.name},$"
        for node in definitions
        if not node.name.startswith("_")
    ]
    # Six letters, so that `assessment` is the folder of test_assess.
    near = [word[:6] for part in parts[1:] for word in part.split("_") if len(word) > 3]
    found = [rf"\b{folder}\.{name}\b", rf"from {folder} import .*\b{name}\b", *words]
    sets = [{test for test, source in tests.items() if re.search(pattern, source, re.M)} for pattern in found]
    sets += [{test for test in tests if word in test} for word in near]
    drawing = {test for test, source in tests.items() if "plot(" in source}
    return tuple(sorted(set().union(*(files for files in sets if len(files) <= COMMON)) or drawing))


KEPT: Final = ("test_kept_calls", "test_kept_answers")
"""The tests of public calls and of whole commands, which are asked about every fault."""


def generated_python(count: int, seed: int) -> list[Fault]:
    """Faults drawn over the package."""
    tests = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "tests").glob("test_*.py")}
    sites, reasons = defaultdict(list), listed("python", "REASONS")
    for path in sorted((ROOT / PACKAGE).rglob("*.py")):
        if path.relative_to(ROOT / PACKAGE).parts[0] != "data":
            source = path.read_text(encoding="utf-8")
            for operator, what, text in random_faults.python_faults(source):
                sites[operator].append((path.relative_to(ROOT), what, source, text))
    faults = []
    for number, (path, what, source, text) in enumerate(random_faults.drawn(sites, count, seed), 1):
        what = f"{path.relative_to(PACKAGE)}: {what}"
        asked = tuple(dict.fromkeys((*tests_of(path, source, tests), *KEPT)))
        faults.append(Fault(DRAWN[0], number, what, path, text, asked, reasons.get(what, "")))
    return faults
