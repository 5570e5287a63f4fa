"""Layers of the Python package: what a module may import, and how results show themselves.

Imports of every kind count: at the top of a module, late in a function, and for types alone. The layers are those of
the contract in pyproject.toml, which `make lint` checks with import-linter; this test reads the sources by itself.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import seismass
from seismass.base.views import Views, maker_of
from seismass.media.result import Result, StoredResult
from seismass.show import VIEWS

ROOT = Path(__file__).parents[1]
SOURCES = ROOT / "python"
Edges = dict[str, set[str]]


def layers() -> dict[str, int]:
    """Height of each module and package directly below `seismass`; those of one layer have the same."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (contract,) = (each for each in project["tool"]["importlinter"]["contracts"] if each["type"] == "layers")
    rows = [row.split(" : ") for row in contract["layers"]]
    return {name: height for height, row in enumerate(reversed(rows)) for name in row}


def modules() -> dict[str, str]:
    """Source of every module, by its dotted name."""
    return {
        ".".join(path.relative_to(SOURCES).with_suffix("").parts).removesuffix(".__init__"): path.read_text("utf-8")
        for path in SOURCES.glob("seismass/**/*.py")
        if "data" not in path.relative_to(SOURCES).parts  # a copy of data/, whose programs are for others
    }


def imports(sources: dict[str, str]) -> Edges:
    """What each module imports of the others, whatever the kind of import."""
    found: Edges = {name: set() for name in sources}
    for name, source in sources.items():
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.Import):
                asked = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                assert not node.level, f"{name} has a relative import"
                parts = [f"{node.module}.{alias.name}" for alias in node.names]
                asked = [part if part in sources else str(node.module) for part in parts]
            else:
                continue
            found[name].update(each for each in asked if each in sources and each != name)
        found[name].discard("seismass")  # `from seismass import _kernel`
    return found


def upward(edges: Edges) -> list[str]:
    """Imports of a module that stands in a higher layer."""
    height = layers()

    def layer(name: str) -> int:
        return height[name.split(".")[1]]

    return sorted(
        f"{name} imports {other}"
        for name, asked in edges.items()
        for other in asked
        if name != "seismass" and layer(other) > layer(name)
    )


def circles(edges: Edges) -> list[list[str]]:
    """Groups of modules that import each other in a circle, by Tarjan's algorithm."""
    number: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(name: str) -> None:
        number[name] = lowest[name] = len(number)
        stack.append(name)
        for other in edges[name]:
            if other not in number:
                visit(other)
                lowest[name] = min(lowest[name], lowest[other])
            elif other in stack:
                lowest[name] = min(lowest[name], number[other])
        if lowest[name] == number[name]:
            group = stack[stack.index(name) :]
            del stack[stack.index(name) :]
            if len(group) > 1:
                found.append(sorted(group))

    for name in edges:
        if name not in number:
            visit(name)
    return found


def test_every_place_has_a_layer() -> None:
    found = {module.name for module in pkgutil.iter_modules(seismass.__path__)} - {"_kernel"}
    assert found == set(layers())


def test_no_import_runs_upward_and_none_forms_a_circle() -> None:
    edges = imports(modules())
    assert upward(edges) == []
    assert circles(edges) == []


@pytest.mark.parametrize(
    "planted",
    [
        "def late() -> None:\n    from seismass.show.risk import risk_text\n",
        "if TYPE_CHECKING:\n    from seismass.show.risk import risk_text\n",
    ],
    ids=["late", "type-only"],
)
def test_an_import_upward_is_found_wherever_it_stands(planted: str) -> None:
    sources = modules()
    sources["seismass.studies.risk.targeted_share"] += f"\n{planted}"
    edges = imports(sources)
    assert upward(edges) == ["seismass.studies.risk.targeted_share imports seismass.show.risk"]
    assert any({"seismass.studies.risk.targeted_share", "seismass.show.risk"} <= set(group) for group in circles(edges))


def declared() -> Iterator[tuple[type, str, Callable[..., Any]]]:
    """Every view that a class has, its own or that of a base: class, name and declaration."""
    for name in modules():
        if name == "seismass.__main__":
            continue
        module = importlib.import_module(name)
        for _, kind in inspect.getmembers(module, inspect.isclass):
            if kind.__module__ != name or kind in (Result, StoredResult, Views):
                continue
            for member in dir(kind):
                found = inspect.getattr_static(kind, member)
                function = found.fget if isinstance(found, property) else found
                if getattr(function, "declares_view", False):
                    yield kind, member, function


def test_every_view_has_a_maker_that_takes_the_same_arguments() -> None:
    used = set()
    for kind, name, declaration in declared():
        used.add(next(key for base in kind.__mro__ if (key := f"{base.__name__}.{name}") in VIEWS))
        wanted = list(inspect.signature(declaration).parameters.values())[1:]
        given = list(inspect.signature(maker_of(kind, name)).parameters.values())[1:]
        assert [(p.name, p.kind, p.default) for p in wanted] == [(p.name, p.kind, p.default) for p in given], name
    assert used == set(VIEWS)


def test_places_that_the_guide_names_are_there() -> None:
    guide = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    places = re.findall(r"^\| where [^|]*\| `([\w/.]+)` \|$", guide, re.MULTILINE)
    assert len(places) == 13
    for place in places:
        assert (SOURCES / "seismass" / place).is_file(), place
