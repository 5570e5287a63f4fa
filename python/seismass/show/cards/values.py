"""Values that have no card of their own: their text, their table, the axes that vary, or their numbers."""

from __future__ import annotations

import numbers
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.values import FloatArray, brief, counted
from seismass.base.views import Card
from seismass.media.card import card, line, pre, rows
from seismass.media.text_table import column_texts

MOST_ROWS: Final = 12
"""Most rows of a table that are shown."""
MOST_COLUMNS: Final = 8
"""Most columns, likewise."""
MOST_VALUES: Final = 6
"""Longest list whose numbers are shown one by one."""
MOST_LETTERS: Final = 300
"""Most letters of what a value says of itself."""
LONGEST_TEXT: Final = 60
"""Longest text of a fact."""


def value_html(value: Any) -> str:
    """Return a card of a value."""
    kind = type(value)
    title, about = kind.__name__, _about(value)
    if isinstance(getattr(kind, "text", None), property):
        return card(title, about, pre(value.text, more=f"print(the {kind.__name__}.text)"))
    if callable(getattr(kind, "axes", None)):
        body = [(axis.name, str(axis.length), str(axis.each)) for axis in value.axes()]
        size = f"{len(value):,} scenes" if isinstance(value, Sequence) or hasattr(kind, "__len__") else ""
        return card(title, size, rows(("axis", "values", "numbers each"), body))
    table = getattr(value, "table", None)
    shown = table if isinstance(table, pl.DataFrame) else table() if callable(table) else None
    facts, notes = _facts(value, with_lists=shown is None)
    # A one-line repr says more than the fields, where it is not a list of them.
    listed = is_dataclass(value) and (shown is not None or len(facts) > 1)
    said = "" if listed else line(repr(value)[:MOST_LETTERS])
    facts = facts if is_dataclass(value) else []
    return card(title, about, said, "" if shown is None else frame_html(shown), facts=facts, notes=notes)


def frame_html(frame: pl.DataFrame) -> str:
    """Return the first rows of a table, numbers of a column with the same decimals, and how large it is."""
    names, columns = frame.columns[:MOST_COLUMNS], []
    for name in names:
        values = frame[name].head(MOST_ROWS).to_list()
        if frame[name].dtype.is_float():
            columns.append(column_texts(values, digits=4))
        else:
            columns.append(["" if one is None else _fact(one)[:LONGEST_TEXT] for one in values])
    whole = frame.height <= MOST_ROWS and frame.width <= MOST_COLUMNS
    size = f"of {counted(frame.height, 'row')} and {counted(frame.width, 'column')}"
    return rows(names, list(zip(*columns, strict=True))) + ("" if whole else line(size))


def _about(value: Any) -> str:
    found = [getattr(value, name, "") for name in ("name", "label")]
    return next((text[:LONGEST_TEXT] for text in found if isinstance(text, str) and text), "")


def _items(value: Any) -> Iterator[tuple[str, Any]]:
    """What the value is made of, by name."""
    if is_dataclass(value):
        for each in fields(value):
            if not each.name.startswith("_") and each.name not in ("name", "label", "table"):
                yield each.name, getattr(value, each.name)


def _facts(value: Any, *, with_lists: bool) -> tuple[list[tuple[str, str]], list[str]]:
    """Names with their values, and the remarks; lists and tables where a table does not show them."""
    facts, notes = [], []
    for name, item in _items(value):
        if name in ("remarks", "notes", "assumptions") and isinstance(item, tuple):
            notes += [str(one) for one in item]
        elif not _is_nothing(item) and (with_lists or not isinstance(item, np.ndarray | pl.DataFrame | tuple | list)):
            facts.append((name, _fact(item)))
    return facts, notes


def _is_nothing(item: Any) -> bool:
    """Whether there is nothing to be said."""
    return item is None or (isinstance(item, str | tuple | list) and not any(item))


def _fact(item: Any) -> str:
    """A value in a few words."""
    if isinstance(item, bool | np.bool_):
        return "yes" if item else "no"
    if isinstance(item, numbers.Integral):
        return str(int(item))
    if isinstance(item, numbers.Real):
        return f"{float(item):.4g}"
    if isinstance(item, str):
        return item if len(item) <= LONGEST_TEXT else item[: LONGEST_TEXT - 3] + "..."
    if isinstance(item, Path):
        return _fact(item.name)
    if isinstance(item, np.ndarray):
        return _array(item)
    if isinstance(item, pl.DataFrame):
        return f"table of {counted(item.height, 'row')}"
    if is_dataclass(item) or isinstance(item, Card):
        return type(item).__name__
    if isinstance(item, Mapping):
        return f"{counted(len(item), 'entry', 'entries')}: {', '.join(map(str, item))}"[:LONGEST_TEXT]
    if isinstance(item, tuple | list):
        if item and len(item) <= MOST_VALUES and all(isinstance(one, numbers.Real) for one in item):
            return ", ".join(f"{float(one):.4g}" for one in item)
        if item and len(item) <= MOST_VALUES and all(isinstance(one, str) for one in item):
            return _fact(", ".join(item))
        return f"{len(item)} {type(item[0]).__name__}" if item else "none"
    return brief(item)


def _array(item: FloatArray) -> str:
    """Numbers of an array: each of them where they are few, else their range."""
    if item.dtype.kind not in "fiu":
        return f"{item.size} values"
    if item.ndim <= 1 and item.size <= MOST_VALUES:
        return ", ".join(column_texts([float(one) for one in np.atleast_1d(item)], digits=4)) or "none"
    shape = " by ".join(map(str, item.shape))
    known = item[np.isfinite(item)]
    ends = f", {known.min():.4g} to {known.max():.4g}" if known.size else ""
    return f"{shape} values{ends}"
