"""Sizes of the package and of its docstrings stay within ceilings; the top of the repository has known names."""

from __future__ import annotations

import ast
import subprocess
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "python" / "seismass"
RAISE = "raise the number in the same commit and say in CHANGELOG.md which feature it serves"

# Ceilings are the present numbers: lower them where less is left. "top" holds the files beside the folders.
LINES = """
assessment 7255   base 2601   commands 4201   design 3764   design/scaling 1101   effective_mass 2834   media 1757
model 3232   motions 377   motions/matching 1469   motions/pulses 1048   motions/records 3840
motions/records/formats 3886   motions/records/synthetic 1101   motions/scaling 783   motions/spectra 1815   runs 3570
runs/grid 1668   show 3502   show/animation 1542   show/assessment 2051   show/explore 314   show/plots 1833
show/study 1824   studies 8   studies/campaign 1577   studies/evidence 1264   studies/fragility 3039
studies/risk 1623   studies/slip 1557   studies/study 1446   studies/validation 1214   top 97
"""
FILES, SMALL_FILES, SMALL, LONGEST = 259, 5, 60, 600  # small: fewer than 60 lines, without __init__.py
DOCSTRING = 3  # lines of what no user can reach
KERNEL_RUNS = """
motions/spectra/inelastic.py runs/batch.py runs/simulate.py
"""
TOP = """
.ci .github .gitignore CHANGELOG.md CITATION.cff CONTRIBUTING.md Cargo.lock Cargo.toml LICENSE-APACHE LICENSE-MIT
Makefile README.md THIRD-PARTY-LICENCES.txt benchmarks clippy.toml crates data deny.toml docs packaging pyproject.toml
python rustfmt.toml tests tools
"""

SOURCES = [file for file in sorted(PACKAGE.rglob("*.py")) if file.relative_to(PACKAGE).parts[0] != "data"]
TEXTS = {file.relative_to(PACKAGE).as_posix(): file.read_text(encoding="utf-8") for file in SOURCES}
Definition = ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
parsed = cache(lambda place: ast.parse(TEXTS.get(place) or (PACKAGE / place).read_text(encoding="utf-8")))


@cache
def place_of(module: str) -> str | None:
    """The file that says which names a module has: a stub where names are imported when they are first used."""
    place = "/".join([".", *module.split(".")[1:]])
    files = (f"{place}/__init__.pyi", f"{place}/__init__.py", f"{place}.py")
    return next((file[2:] for file in files if (PACKAGE / file).is_file()), None)


@cache
def names_of(module: str) -> tuple[dict[str, Definition], dict[str, tuple[str, str]], list[str]]:
    """What a module defines, what it imports from the package, for types too, and its `__all__`."""
    tree = parsed(place_of(module)).body
    body = [inner for node in tree for inner in (node.body if isinstance(node, ast.If) else [node])]
    imported, public = {}, []
    for node in body:
        if isinstance(node, ast.ImportFrom):
            source = ".".join([*[module] * node.level, *filter(None, [node.module])])  # stubs alone have levels
            imported |= {alias.asname or alias.name: (source, alias.name) for alias in node.names}
        elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            public = ast.literal_eval(node.value)
    return {node.name: node for node in body if isinstance(node, Definition)}, imported, public


def is_open(name: str) -> bool:
    return not name.startswith("_") or name.startswith("__")


def hints(node: Definition) -> Iterator[ast.expr | None]:
    """What leads on from a definition: bases and open fields of a class, and what functions and open methods return."""
    yield from node.bases if isinstance(node, ast.ClassDef) else [node.returns]
    for inner in node.body if isinstance(node, ast.ClassDef) else []:
        if isinstance(inner, ast.AnnAssign) and is_open(ast.unparse(inner.target)):
            yield inner.annotation
        elif isinstance(inner, Definition) and is_open(inner.name):
            yield from hints(inner)


@cache
def reached() -> set[tuple[str, str]]:
    """The files and names of classes and functions that a user can reach by public names, fields and results."""
    todo = [(module, name) for module in ("seismass", "seismass.assessment") for name in names_of(module)[2]]
    found = set()
    while todo:
        module, name = todo.pop()
        defined, imported, _ = names_of(module)
        source, original = imported.get(name, ("", ""))
        if name in defined and (place_of(module), name) not in found:
            found.add((place_of(module), name))
            words = (word for hint in hints(defined[name]) if hint for word in ast.walk(hint))
            todo += [(module, word.id) for word in words if isinstance(word, ast.Name)]
        elif source.startswith("seismass") and place_of(f"{source}.{original}"):
            todo += [(f"{source}.{original}", public) for public in names_of(f"{source}.{original}")[2]]
        elif source.startswith("seismass") and place_of(source):
            todo.append((source, original))
    return found


def too_long(node: ast.AST, of_user: bool) -> Iterator[str]:
    """Names with long docstrings that no user can reach, in a definition that a user can reach or not."""
    if isinstance(node, Definition):
        of_user = of_user and is_open(node.name)
        if not of_user and (ast.get_docstring(node, clean=False) or "").count("\n") >= DOCSTRING:
            yield node.name
        of_user = of_user and isinstance(node, ast.ClassDef)
    for inner in ast.iter_child_nodes(node):
        yield from too_long(inner, of_user)


def test_what_no_user_can_reach_has_at_most_three_lines_of_docstring() -> None:
    found = []
    for place, text in TEXTS.items():
        if any(part.count("\n") >= DOCSTRING for part in text.split('"""')[3::2]):
            for node in parsed(place).body:
                found += [
                    f"{place}: {name}" for name in too_long(node, (place, getattr(node, "name", "")) in reached())
                ]
    assert found == [], "say it in one or two sentences: no sections of parameters or errors"


def test_public_names_are_reached_and_private_ones_are_not() -> None:
    """A name at the top and the class of a field are; a module below all and the makers of views are not."""
    assert {("model/building.py", "Building"), ("assessment/floors.py", "FloorGoods")} <= reached()
    assert not {place for place, _ in reached()} & {"base/files.py", "show/cards.py"}


def test_lines_of_folders_and_numbers_of_files_and_of_small_ones() -> None:
    lines: Counter[str] = Counter()
    for place, text in TEXTS.items():
        lines[place.rpartition("/")[0] or "top"] += text.count("\n")
    ceilings = dict(zip(LINES.split()[::2], map(int, LINES.split()[1::2]), strict=True))
    assert {name: count for name, count in lines.items() if count > ceilings.get(name, 0)} == {}, RAISE
    assert set(ceilings) == set(lines), "remove the ceiling of a folder that is gone"
    assert len(TEXTS) <= FILES, RAISE
    assert [p for p, text in TEXTS.items() if text.count("\n") > LONGEST] == []
    small = [p for p, text in TEXTS.items() if text.count("\n") < SMALL and not p.endswith("__init__.py")]
    assert len(small) <= SMALL_FILES, f"join the new file with one of its idea, or {RAISE}"


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="not a git tree")
def test_names_at_the_top_of_the_repository() -> None:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    found = {name.split("/")[0] for name in listed.splitlines()}
    assert found == set(TOP.split()), "remove what a run left behind, or add the name to the list"


def test_runs_of_the_kernel_are_asked_in_few_places() -> None:
    found = {place for place, text in TEXTS.items() if "_kernel.simulate" in text}
    assert found <= set(KERNEL_RUNS.split()), "call runs.batch or runs.simulate, or name the file here"


def test_every_line_of_slow_tests_names_one(unused_lines: list[str]) -> None:
    assert unused_lines == [], "remove the lines from tests/slow.txt"
