"""Variables, parameters and functions of the package are nouns of what they hold, by the words of docs/glossary.md."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "python" / "seismass"
NO_NAMES = {"found", "given", "said", "chosen", "own", "about", "told"}
"""Participles and prepositions that say nothing of what a name holds."""
NO_VARIABLES = {"of", "at", "by", "beyond", "beside", "behind"}
"""Prepositions that may be functions, as in `at(share)`, and hold nothing."""
OLD_WORDS = {"real", "reals", "kept", "forks"}
"""Words for which the glossary has another: sliding, store."""
USERS_NAMES = {
    ("DriftLimit", "of"),
    ("EffectiveMass", "real"),
    ("Fraction", "real"),
    ("HuntAndFill", "beyond"),
    ("RiskTargetedShare", "real"),
    ("add_spring_options", "of"),
    ("cloud_analysis", "at"),
    ("incremental_dynamic_analysis", "at"),
    ("multiple_stripes", "at"),
    ("say", "at"),
    ("scatter", "by"),
}
"""Parameters and fields that users and files know, by the function or class that has them."""


def names(source: str) -> Iterator[tuple[str, str]]:
    """Names that a module gives, with the function or class in which each stands: no attributes of others."""

    def inside(node: ast.AST, scope: str) -> Iterator[tuple[str, str]]:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.FunctionDef | ast.ClassDef):
                yield scope, f"{child.name.strip('_')}()"
                yield from inside(child, child.name)
                continue
            if isinstance(child, ast.Name) and isinstance(child.ctx, ast.Store):
                yield scope, child.id.strip("_")
            elif isinstance(child, ast.arg):
                yield scope, child.arg.strip("_")
            elif isinstance(child, ast.alias):
                yield scope, (child.asname or child.name).split(".")[0].strip("_")
            yield from inside(child, scope)

    return inside(ast.parse(source), "")


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("found = 1", ("", "found")),
        ("def f(given): ...", ("f", "given")),
        ("def _chosen(x): ...", ("", "chosen()")),
        ("async_ = [own for own in ()]", ("", "own")),
        ("lambda about: 1", ("", "about")),
        ("with open('x') as said: ...", ("", "said")),
        ("def f():\n    if (of := 1): ...", ("f", "of")),
        ("class A:\n    at: int", ("A", "at")),
        ("from a import kept", ("", "kept")),
    ],
)
def test_every_way_to_give_a_name_is_seen(source: str, expected: tuple[str, str]) -> None:
    assert expected in list(names(source))


def test_no_name_is_a_participle_or_a_preposition() -> None:
    used = {
        (file.relative_to(PACKAGE).as_posix(), scope, name)
        for file in PACKAGE.rglob("*.py")
        if file.relative_to(PACKAGE).parts[0] != "data"
        for scope, name in names(file.read_text(encoding="utf-8"))
        if name in NO_VARIABLES or name.removesuffix("()") in NO_NAMES | OLD_WORDS
        if (scope, name) not in USERS_NAMES
    }
    assert used == set(), "name what it holds; docs/glossary.md has the words"


def silent(node: ast.FunctionDef) -> Iterator[str]:
    """Parameters with a default whose line in the docstring says neither "optional" nor "default"."""
    section = (ast.get_docstring(node) or "").partition("Parameters\n---")[2].partition("\n\nR")[0]
    lines = [line.split(" : ", 1) for line in section.splitlines() if line[:1].isalpha() and " : " in line]
    marked = {name: "optional" in kind or "default" in kind for names, kind in lines for name in names.split(", ")}
    places, keywords = [*node.args.posonlyargs, *node.args.args], node.args.kwonlyargs
    having = places[len(places) - len(node.args.defaults) :] + [
        word for word, value in zip(keywords, node.args.kw_defaults, strict=True) if value is not None
    ]
    yield from (f"{node.name}: {each.arg}" for each in having if not marked.get(each.arg, True))


def test_parameters_with_a_default_say_so() -> None:
    sources = [file.read_text(encoding="utf-8") for file in sorted(PACKAGE.rglob("*.py"))]
    functions = [node for text in sources for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
    assert [name for node in functions for name in silent(node)] == []
    wrong = 'def f(a, b=1, *, c=None):\n    """Do.\n\n    Parameters\n    ----------\n    a, b, c : int\n    """'
    (function,) = ast.parse(wrong).body
    assert isinstance(function, ast.FunctionDef)
    assert list(silent(function)) == ["f: b", "f: c"]
