"""Texts of answers, one line a value, as the tests of kept answers compare them with tests/kept_answers."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from difflib import unified_diff
from functools import partial
from html.parser import HTMLParser
from importlib.metadata import version
from pathlib import Path
from types import ModuleType
from zlib import crc32

import numpy as np
import polars as pl
import pytest
from matplotlib.artist import Artist
from matplotlib.figure import Figure

from seismass.base.errors import SeismassError
from seismass.runs.simulate import instruction_set

KEPT = Path(__file__).parents[1] / "tests" / "kept_answers"
DIGITS = 5
VERSIONS = " ".join(
    [
        *(f"{name} {version(name).rpartition('.')[0]}" for name in ("matplotlib", "numpy", "polars", "rich", "scipy")),
        instruction_set(),
    ]
)
"""What else words and figures depend on, as racks do on last digits: elsewhere answers are not compared, which is
said.
"""
MINUS = "\N{MINUS SIGN}"
NUMBER = re.compile(rf"(?<![\w.])[-{MINUS}]?\d+\.\d+(?:e[-+]?\d+)?(?![\w.])", re.IGNORECASE)
CHANGING = re.compile(
    r"(?<![\w.])(?=(?:\d*[a-f]){3})[0-9a-f]{12,64}\b|\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d(?::\d\d)?)?"
    r"|\b\d+(?:\.\d+)? (?:ms|s|min)(?= (?:of|in|for|on)\b)|0\.1\.0\S*|(?<=\")\d\.\d+\.\d+(?=\")"
    r"|^time .*$|(?<=, )\d+\.\d s$|(?<=instructions: )\w+|(?<=instructions\]: )\w+|(?<=bits: )\w+"
    r"|(?<=residual )-?\d\S*e-1\d|(?<=shares_beside_the_grid\]: )\d+|^(?:baseline|avx2|avx512)(?=;)",
    re.MULTILINE,
)
"""Digests, dates, times of runs, versions and instructions of the processor."""


class Words(HTMLParser):
    """The text of a page, without scripts, styles and pictures."""

    def __init__(self) -> None:
        super().__init__()
        self.hidden = 0
        self.words: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        """Enter an element."""
        self.hidden += tag in ("script", "style", "svg")

    def handle_endtag(self, tag: str) -> None:
        """Leave an element."""
        self.hidden -= tag in ("script", "style", "svg")

    def handle_data(self, data: str) -> None:
        """Take what is read as words."""
        if not self.hidden and data.strip():
            self.words.append(" ".join(data.split()))


def steady(text: str) -> str:
    """Return a text with numbers of five digits, and without what changes from run to run."""
    text = CHANGING.sub("#", text)
    return NUMBER.sub(lambda found: f"{float(found[0].replace(MINUS, '-')):.{DIGITS}g}", text)


def table_lines(table: pl.DataFrame) -> Iterator[str]:
    """Yield a table by its columns: all of a short one, else sum, least and largest."""
    for name in table.columns:
        column = table[name]
        if table.height <= 12:
            yield f"{name}: {', '.join(map(_shown, column.to_list()))}"
        elif column.dtype.is_numeric():
            finite = column.cast(pl.Float64).filter(column.is_not_null())
            yield f"{name}: {table.height} rows, sum {finite.sum()}, from {finite.min()} to {finite.max()}"
        else:
            yield f"{name}: {table.height} rows, {column.n_unique()} values, {column[0]} to {column[-1]}"


def array_text(values: object) -> str:
    """Return numbers of a drawing: all of few, else their count, weighted sum, least and largest."""
    numbers = np.ma.filled(np.ma.asarray(values, dtype=float), np.nan).ravel()
    if numbers.size <= 8:
        return " ".join(f"{number:.4g}" for number in numbers)
    found = numbers[np.isfinite(numbers)]
    weight = np.arange(1, found.size + 1) @ found / max(found.size, 1)
    weight = 0.0 if abs(weight) < 1e-12 * np.abs(found).max(initial=0.0) else weight  # rounding alone
    return f"{numbers.size}: {weight:.4g} {found.min(initial=np.inf):.4g} {found.max(initial=-np.inf):.4g}"


def artist_text(artist: Artist) -> str:
    """Return the words, places, colours and widths of a part of a figure."""
    kind, words = type(artist).__name__, getattr(artist, "get_text", str)()
    if kind in ("Spine", "XAxis", "YAxis") or (kind == "Text" and not words):
        return ""
    drawn = [kind, words, re.sub("^_child.*", "", str(artist.get_label()))]
    names = ["get_xydata", "get_position", "get_bbox", "get_color", "get_facecolor", "get_linewidth", "get_zorder"]
    names += ["get_segments" if kind == "LineCollection" else "get_offsets"]
    values = (getattr(artist, name)() for name in names if hasattr(artist, name))
    return " | ".join([*drawn, *(_shown(getattr(value, "extents", value)) for value in values)])


def figure_lines(figure: Figure) -> Iterator[str]:
    """Yield what a figure holds: scales, limits and words of its axes, lines, marks, areas, with colours and widths."""
    yield f"figure {figure.get_figwidth():.3g} x {figure.get_figheight():.3g}"
    for axes in figure.axes:
        for scale, limits in ((axes.get_xscale(), axes.get_xlim()), (axes.get_yscale(), axes.get_ylim())):
            yield f"axis {scale} {array_text(limits)}"
        drawn = [artist for artist in axes.get_children() if artist.get_visible() and artist is not axes.patch]
        found = [text for artist in drawn if (text := artist_text(artist))]
        yield from found[:15]
        yield f"{len(found)} artists, {crc32(chr(10).join(found).encode())}"
        yield f"words {axes.get_xlabel()} | {axes.get_ylabel()} | {axes.get_title(loc='left')} | {axes.get_title()}"


def _shown(value: object) -> str:
    """Return numbers of an array or a list as `array_text`, other values as they are."""
    try:
        return array_text(value) if isinstance(value, list | tuple | np.ndarray) else str(value)
    except (TypeError, ValueError):
        return str(value)


def document_lines(value: object, path: str = "") -> Iterator[str]:
    """Yield the leaves of a JSON document by their paths; many numbers as those of a drawing."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from document_lines(inner, f"{path}.{key}")
    elif isinstance(value, list) and all(isinstance(one, int | float) for one in value) and value:
        yield f"{path[1:]}: {array_text(value)}"
    elif isinstance(value, list):
        for number, inner in enumerate(value[:4]):
            yield from document_lines(inner, f"{path}[{number}]")
        yield f"{path[1:]}: {len(value)}"
    else:
        yield f"{path[1:]}: {value}"


def lines_of(place: Path, before: set[Path]) -> Iterator[str]:
    """Yield what new files hold. The live page has tests of its own; a CSV beside a Parquet file holds the same."""
    for file in sorted(set(place.rglob("*")) - before):
        yield f"== {file.relative_to(place)}"
        twin = file.suffix == ".csv" and file.with_suffix(".parquet").exists()
        if twin or file.name in ("explorer.html", "files.json", "animation.json"):
            continue
        if file.suffix in (".csv", ".parquet"):
            read = partial(pl.read_csv, comment_prefix="#") if file.suffix == ".csv" else pl.read_parquet
            yield from table_lines(read(file))
        elif file.suffix == ".json":
            yield from document_lines(json.loads(file.read_text("utf-8")))
        elif file.suffix == ".html":
            parser = Words()
            parser.feed(file.read_text("utf-8"))
            yield from parser.words


def compare(name: str, text: str) -> None:
    """Hold a text against the one that is kept, or keep it."""
    kept, versions = KEPT / f"{name}.txt", KEPT / "versions"
    if os.environ.get("KEEP_ANSWERS"):
        kept.parent.mkdir(parents=True, exist_ok=True)
        versions.write_text(f"{VERSIONS}\n", encoding="utf-8")
        kept.write_text(text, encoding="utf-8")
    if versions.read_text("utf-8").strip() != VERSIONS:
        pytest.skip(f"kept with {versions.read_text('utf-8').strip()}; here are {VERSIONS}")
    found = unified_diff(kept.read_text("utf-8").splitlines(), text.splitlines(), "kept", "now", lineterm="", n=0)
    if changed := list(found):
        pytest.fail("\n".join(changed[:60]), pytrace=False)


def value_lines(value: object, path: str = "", depth: int = 3) -> Iterator[str]:
    """Yield what a result holds by the names of its parts: numbers, tables, figures, words, cards of notebooks."""
    if isinstance(value, Figure):
        yield from (f"{path} {line}" for line in figure_lines(value))
    elif isinstance(value, pl.DataFrame):
        yield from (f"{path} {line}" for line in table_lines(value))
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield from value_lines(inner, f"{path}[{key}]", depth - 1)
    elif isinstance(value, list | tuple) and not _is_numbers(value):
        for number, inner in enumerate(value[:3]):
            yield from value_lines(inner, f"{path}[{number}]", depth - 1)
        yield f"{path}: {len(value)}"
    elif isinstance(value, Iterator):
        yield from value_lines(list(value), path, depth)
    elif type(value).__module__.startswith("seismass"):
        yield f"{path}: {type(value).__name__}"
        yield from _parts(value, path, depth) if depth else ()
    elif isinstance(value, str):
        yield from (f"{path}: {line}" for line in _words(value).splitlines())
    elif not callable(value) and not isinstance(value, ModuleType):
        yield f"{path}: {re.sub(' at 0x[0-9a-f]+', '', _shown(_zeroed(value)))}"


def _parts(value: object, path: str, depth: int) -> Iterator[str]:
    """Yield the public attributes of an object, and its card; views that draw are functions, and called as such."""
    public = (name for name in dir(value) if not name.startswith("_") and name != "statistics")  # steps of the solver
    for name in [*public, "_repr_html_"]:
        try:
            part = getattr(value, name)
            part = part() if name == "_repr_html_" else part
        except AttributeError:
            continue
        except SeismassError as error:
            part = str(error)
        if not type(part).__name__.endswith("Plots"):
            yield from value_lines(part, f"{path}.{name}", depth - 1)


def _words(text: str) -> str:
    """Return the words of a page or a card, and other texts as they are."""
    if not text.lstrip().startswith("<"):
        return text
    parser = Words()
    parser.feed(text)
    return "\n".join(parser.words)


def _is_numbers(values: list | tuple) -> bool:
    return bool(values) and all(isinstance(one, int | float) for one in values)


def _zeroed(value: object) -> object:
    """Return a number or numbers; what is left of a sum that is zero has other digits on other machines."""
    numbers = isinstance(value, float) or (isinstance(value, np.ndarray) and value.dtype.kind == "f")
    return np.where(np.abs(value) < 1e-11, 0.0, value) if numbers else value


def short(lines: list[str], most: int) -> list[str]:
    """Return so many lines, and the check sum of all."""
    rest = [f"{len(lines)} lines, {crc32(chr(10).join(lines).encode())}"] if len(lines) > most else []
    return [*lines[:most], *rest]
