"""Faults drawn at random over the sources, so that what tests see does not rest on faults that were chosen."""

from __future__ import annotations

import ast
import copy
import random
import re
from collections.abc import Iterator
from itertools import accumulate

SWAPPED = {ast.Lt: ast.LtE, ast.Gt: ast.GtE, ast.Add: ast.Sub, ast.Mult: ast.Div, ast.And: ast.Or}
SWAPPED |= {new: old for old, new in SWAPPED.items()}
NAMES = {"min": "max", "minimum": "maximum", "argmin": "argmax", "floor": "ceil", "any": "all"}
NAMES |= {new: old for old, new in NAMES.items()}
SYMMETRIC = {"min", "max", "minimum", "maximum", "hypot", "isinstance", "issubclass"}
"""Functions whose first two arguments are not exchanged: the result is the same, or an error in every call."""


def nodes(node: ast.AST) -> Iterator[ast.AST]:
    """All nodes of a tree outside types, and outside f-strings, whose places Python 3.11 does not tell."""
    yield node
    for name, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            typed = name in ("annotation", "returns") or isinstance(child, ast.JoinedStr)
            if isinstance(child, ast.AST) and not typed:
                yield from nodes(child)


def changed(node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    """The node with each fault that it can have, and the operator's name."""
    fits = isinstance(node, ast.Compare | ast.BinOp | ast.AugAssign | ast.BoolOp | ast.Constant | ast.Call)
    match new := copy.copy(node) if fits else None:
        case ast.Compare():
            for i, op in enumerate(node.ops):
                if type(op) in SWAPPED:
                    new.ops = [*node.ops[:i], SWAPPED[type(op)](), *node.ops[i + 1 :]]
                    yield "comparison", new
        case ast.BinOp() | ast.AugAssign() if type(new.op) in SWAPPED:
            parts = [part for name, part in ast.iter_fields(new) if name != "op"]
            texts = [isinstance(getattr(part, "value", None), str | bytes) for part in parts]
            if not any(isinstance(part, ast.JoinedStr | ast.List | ast.Tuple) for part in parts) and not any(texts):
                new.op = SWAPPED[type(new.op)]()
                yield "arithmetic", new
        case ast.BoolOp():
            new.op = SWAPPED[type(new.op)]()
            yield "and, or", new
        case ast.Constant(value=int() | float()) if not isinstance(new.value, bool) and new.value in (0, 1):
            new.value = type(new.value)(1 - new.value)
            yield "0, 1", new
        case ast.Call():
            name = new.func.attr if isinstance(new.func, ast.Attribute) else getattr(new.func, "id", "")
            first = node.args[:2]
            if len({ast.dump(arg) for arg in first}) == 2 and len({*map(type, first)}) == 1 and name not in SYMMETRIC:
                new.args = [*first[::-1], *node.args[2:]]
                yield "arguments", new
                new.args = node.args
            if name in NAMES:
                new.func = copy.copy(node.func)
                setattr(new.func, "attr" if isinstance(new.func, ast.Attribute) else "id", NAMES[name])
                yield "min, max", new


def python_faults(source: str) -> Iterator[tuple[str, str, str]]:
    """Operator, what is changed, and the text with the fault, for every fault that a Python file can have."""
    data = source.encode()
    lines = data.splitlines(keepends=True)
    starts = [0, *accumulate(map(len, lines))]
    for node in nodes(ast.parse(source)):
        for operator, new in changed(node):
            start, end = starts[node.lineno - 1] + node.col_offset, starts[node.end_lineno - 1] + node.end_col_offset
            text = f"({ast.unparse(new)})" if isinstance(new, ast.expr) else ast.unparse(new)
            old, line = (" ".join(part.decode().split()) for part in (data[start:end], lines[node.lineno - 1]))
            what = f"`{old}` becomes `{ast.unparse(new)}`" + (f" in `{line}`" if old != line else "")
            yield operator, what, (data[:start] + text.encode() + data[end:]).decode()


IF = r"^(\s*(?:\} else )?if )(?!.*\blet\b)"
RUST = {
    # A factor of the term at its left end: multiplying by 1 or -1 changes no precedence and rounds nothing.
    "sign": (r"^(.*[\w)\]] [+-] )(?=[a-z(])", r"\1crate::mutant::sign(MUT) * "),
    "off by one": (r"^(.* [+-] )1\b(?![.\w])", r"\1usize::from(!ON)"),
    "factor": (r"^(.*?)(?<![\w.])([2-9]\.0|0\.[25]5?)(?![\w.])", r"\1(if ON { 1.0 } else { \2 })"),
    "condition": (IF + r"([^{}]+)(?= \{$)", r"\1(\2) != ON"),
    "comparison": (
        IF + r"(?!.*(?:&&|\|\|))(([^{}]+ [<>])(=?) ([^{}<>]+))(?= \{$)",
        r"\1(if ON { \3SWAP \5 } else { \2 })",
    ),
    "and, or": (IF + r"(([^{}]+ )(&&|\|\|)( [^{}&|]+))(?= \{$)", r"\1(if ON { \3SWAP\5 } else { \2 })"),
}
"""Operators of lines of Rust: where they fit, and the line with the switch. What does not compile is left out."""
OTHER = {"": "=", "=": "", "&&": "||", "||": "&&"}


def rust_faults(source: str) -> Iterator[tuple[str, str, int, str]]:
    """Operator, what is changed, number of the line from 0, and the line with MUT for the fault's number."""
    for i, line in enumerate(source.partition("#[cfg(test)]")[0].splitlines()):
        if re.match(r"\s*(//|#|use |pub use |const |static |(debug_)?assert)|.*mutant::", line):
            continue
        for operator, (fits, new) in RUST.items():
            if found := re.match(fits, line.partition(" // ")[0]):
                swap = OTHER.get(found[4], "") if len(found.groups()) > 3 else ""
                text = found.expand(new.replace("ON", "crate::mutant::on(MUT)").replace("SWAP", swap))
                yield operator, f"{operator} in `{line.strip()}`", i, text + line[found.end() :]


def drawn(sites: dict[str, list], count: int, seed: int) -> list:
    """So many of the faults, each operator as often as the others as far as it has faults left."""
    chance, found = random.Random(seed), []
    while len(found) < count and any(sites.values()):
        for operator in sorted(sites):
            if sites[operator]:
                found.append(sites[operator].pop(chance.randrange(len(sites[operator]))))
    return found[:count]
