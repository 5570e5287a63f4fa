"""What results have in common: tables, files in a folder, a card in notebooks."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import cache
from html import escape
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Final, Literal, Self, TypeAlias

import numpy as np

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.files import Content, stored_rows, table_content
from seismass.base.folders import ReadFolder, as_written, read_folder, write_folder
from seismass.base.values import FloatArray, as_path, brief, refusal
from seismass.base.views import view
from seismass.media.roles import CODE, SLIDE
from seismass.media.text_table import number_text, text_table

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure


PAGE: Final = "report.html"
"""File of the page of a folder."""
ANIMATION: Final = "animation.json"
"""File of what the animation of a page shows."""


Format: TypeAlias = str | Callable[[Any], str]
"""A format specification, such as ".3f", or a function from a value to its text or Markup."""


@cache
def stored_tables(name: str) -> dict[str, tuple[str, dict[str, dict[str, str]]]]:
    """Return what a row of each table of a result is, and its columns with unit, header, form and meaning, as
    data/tables has them: a column may be of several tables, and a row without one says what a row of the table is.
    """
    rows = [(row["tables"].split(), row["column"], row) for row in stored_rows(f"{name}_columns")]
    return {
        table: (of_table["meaning"], {column: row for tables, column, row in rows if column and table in tables})
        for (table, *_), nothing, of_table in rows
        if not nothing
    }


def table_schema(name: str, table: str) -> dict[str, pl.DataType | type[pl.DataType]]:
    """Return the types of the columns of a table of a result, in their order, as data/tables has them."""
    import polars as pl

    types = {"count": pl.UInt32, "text": pl.String, "flag": pl.Boolean, "number": pl.Float64}
    return {column: types[row["type"]] for column, row in stored_tables(name)[table][1].items()}


def described(
    tables: str,
    frame: pl.DataFrame,
    *,
    units: Mapping[str, tuple[str, Format]] = MappingProxyType({}),
    headers: Mapping[str, str] = MappingProxyType({}),
    formats: Mapping[str, Format] = MappingProxyType({}),
) -> tuple[pl.DataFrame, dict[str, str], dict[str, Format]]:
    """Return what is shown of tables of a result, as "study: summary": columns with a head in data/tables or unknown
    there, unless empty; heads; forms. `units` has for a unit that in which it is shown (empty: not in heads), and how.
    """
    name, _, parts = tables.partition(": ")
    rows = {column: row for part in parts.split() for column, row in stored_tables(name)[part][1].items()}
    heads, forms = {}, {}
    for column in frame.columns:
        row = rows.get(column, {"header": column, "unit": "", "form": ""})
        head = headers.get(column, row["header"])
        if not head or (frame.height and all(value is None or value == "" for value in frame[column])):
            continue
        unit, form = units.get(row["unit"], ("", row["form"]))
        heads[column] = f"{head} ({unit})" if unit else head
        forms[column] = formats.get(column, form)
    return frame.select(*heads), heads, {column: form for column, form in forms.items() if form}


def described_lines(tables: str, frame: pl.DataFrame, *, left: int = 1, **options: Any) -> list[str]:
    """Return rows of tables of a result as `described` has them, as lines; the first `left` columns are texts."""
    shown, heads, forms = described(tables, frame, **options)

    def text(value: Any, form: Format) -> str:
        if callable(form):
            return form(value)
        return number_text(value, form) if form else "" if value is None else str(value)

    columns = [[head, *(text(value, forms.get(name, "")) for value in shown[name])] for name, head in heads.items()]
    return text_table(list(zip(*columns, strict=True)), left=left)


def result_files(
    *,
    tables: Mapping[str, pl.DataFrame],
    documents: Mapping[str, str],
    figures: Mapping[str, Figure] | None = None,
    kinds: Sequence[Literal["png", "svg"]] = ("png", "svg"),
    metadata: Mapping[str, dict[str, str]] | None = None,
) -> dict[str, Content]:
    """Return the files of a result by name: tables (Parquet and CSV), documents and figures."""
    files: dict[str, Content] = {}
    for name, table in tables.items():
        files[f"{name}.parquet"] = table_content(table, "parquet", None if metadata is None else metadata.get(name))
        files[f"{name}.csv"] = table_content(table, "csv")
    files |= documents
    if figures:
        from seismass.media.svg import figure_content  # matplotlib, which tables do not need

        files |= {f"{name}.{kind}": figure_content(figures[name], kind) for name in figures for kind in kinds}
    return files


class StoredTable(property):
    """The table of a result by the name of the attribute; its docstring is what data/tables says of its rows. Where
    the result has none, it is one without rows.
    """

    def __init__(self) -> None:
        super().__init__(self._table)

    def _table(self, result: Any) -> pl.DataFrame:
        import polars as pl

        tables: dict[str, pl.DataFrame] = result.tables
        return tables[self.name] if self.name in tables else pl.DataFrame(schema=table_schema(self.owner, self.name))

    def __set_name__(self, owner: Any, name: str) -> None:
        self.name, self.owner = name, owner.document
        words = stored_tables(self.owner)[name][0]
        self.__doc__ = f"{words[0].upper()}{words[1:]}."

    if TYPE_CHECKING:

        def __get__(self, result: Any, owner: type | None = None) -> pl.DataFrame: ...  # type: ignore[override]


class Result:
    """The result of a study. A subclass has `tables`, `figure_names` and `to_dict`; its views are those of `VIEWS`."""

    __slots__ = ()

    document: ClassVar[str]
    """Stem of the file that `to_json` is written to; with spaces, what messages call the result."""

    @property
    @view
    def text(self) -> str:
        """The result as lines to read, the answer first."""
        raise NotImplementedError

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name."""
        raise NotImplementedError

    @property
    def figure_names(self) -> tuple[str, ...]:
        """Names of the figures that `plot` draws of this result; the first is drawn where none is named."""
        raise NotImplementedError

    @view
    def plot(self, name: str | None = None) -> Figure:
        """Return a figure of `figure_names`, by default the first.

        Parameters
        ----------
        name : str, optional
            Name of the figure.

        Raises
        ------
        InvalidOption
            There is no such figure.
        """
        raise NotImplementedError

    def figures(self) -> dict[str, Figure]:
        """Return all figures by name."""
        return {name: self.plot(name) for name in self.figure_names}

    def to_dict(self) -> dict[str, Any]:
        """Return the answer as plain values, null for non-finite values; long tables are left to `tables`."""
        raise NotImplementedError

    def to_json(self) -> str:
        """Return `to_dict` as JSON."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False)

    @view
    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        """Write tables (Parquet and CSV), the document (JSON) and figures (PNG and SVG) to a folder; of results that
        have a page also the page, with figures, and the text.

        Returns
        -------
        list of Path
            The files, in the order written.

        Raises
        ------
        InvalidOption
            The folder is not a path, or cannot be replaced as a whole: the current one, one above it, a mount point.
        OSError
            A file cannot be written; then nothing is changed.
        """
        raise NotImplementedError

    def _table_metadata(self) -> dict[str, str]:
        """Key-value metadata of the Parquet files of the tables."""
        return {}

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError


def write_result(result: Result, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
    """Write tables, document and figures of a result; see `Result.write`."""
    details = result._table_metadata()
    tables, owner = result.tables, result.document.replace("_", " ")
    files = result_files(
        tables=tables,
        metadata=dict.fromkeys(tables, details) if details else None,
        documents={f"{result.document}.json": result.to_json() + "\n"},
        figures=result.figures() if figures else None,
    )
    return write_folder(as_path(folder, owner, InvalidOption), files, owner=owner)


class StoredResult(Result):
    """A result that its folder holds whole, with the tables of data/tables. A subclass has a field `frames`."""

    __slots__ = ()

    schema_version: ClassVar[int]
    frames: dict[str, pl.DataFrame]

    @classmethod
    def read(cls, folder: str | os.PathLike[str], *, force: bool = False) -> Self:
        """Read a result from the folder that it was written to.

        It shows and writes the same. What only a run has is refused, or None.

        Parameters
        ----------
        folder : path-like
            The folder, of `write` or of a command.
        force : bool, default False
            Read files that were edited since they were written.

        Raises
        ------
        InvalidOption
            A file is not what was written, or of another version.
        OSError
            A file cannot be read.
        """
        path = as_path(folder, cls.document, InvalidOption)
        files = read_folder(path, cls.files_read(), force=force)
        with as_written(path):
            return cls.of_files(files)

    @classmethod
    def files_read(cls) -> tuple[str, ...]:
        """Return the names of the files of which a result is read, first that by which its folder is known."""
        return (f"{cls.document}.json", ANIMATION, *(f"{name}.parquet" for name in stored_tables(cls.document)))

    @classmethod
    def of_files(cls, files: ReadFolder) -> Self:
        """Return the result of the files of its folder."""
        file = f"{cls.document}.json"
        document = files.document(file)
        version = document.get("schema_version")
        if version != cls.schema_version:
            raise refusal(InvalidOption, "schema_version", file, f"{cls.schema_version}", brief(version))
        optional = cls._without(document, files)
        tables = {name: files.table(name) for name in stored_tables(cls.document) if name not in optional}
        return cls._stored(document, tables, files.document(ANIMATION) if ANIMATION in files else None)

    @classmethod
    def _without(cls, document: dict[str, Any], files: ReadFolder) -> Collection[str]:
        """Names of the tables that a result with that document has not."""
        raise NotImplementedError

    @classmethod
    def _stored(
        cls, document: dict[str, Any], frames: dict[str, pl.DataFrame], animation: dict[str, Any] | None
    ) -> Self:
        """The result of what was read."""
        raise NotImplementedError

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name, those of data/tables that the result has."""
        return self.frames


def named_figure(result: Result, name: str | None) -> str:
    """Return the name of the figure that is asked for."""
    known = result.figure_names
    if name is None:
        return known[0]
    as_word(name, known, "name", f"figure of {result.document}")
    return name


def finite_values(document: dict[str, Any]) -> dict[str, Any]:
    """Return nested values with null in place of infinities and NaN, which JSON does not have."""
    return {key: _finite(item) for key, item in document.items()}


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return finite_values(value)
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


COLOUR: Final = SLIDE.colour
"""The accent: legible on white and on dark grey."""
SECOND: Final = CODE.colour
"""The second accent, in the same form."""

_CELL: Final = "padding:0.1em 0.8em 0.1em 0;background:none;border:none;white-space:nowrap"


def card(
    title: str, subtitle: str, *content: str, facts: Sequence[tuple[str, str]] = (), notes: Iterable[str] = ()
) -> str:
    """Return a card: title and a few words, content that is HTML already, names with their values, notes."""
    cells = " ".join(
        f'<span style="margin-right:1.2em;white-space:nowrap">{escape(name)}&#160;<b>{escape(value)}</b></span>'
        for name, value in facts
    )
    listed = "".join(f"<li>{escape(note)}</li>" for note in notes)
    return (
        '<div style="max-width:640px;color:inherit;font-size:90%">'
        f"<div><b>{escape(title)}</b>{': ' if subtitle else ''}{escape(subtitle)}</div>"
        + "".join(content)
        + (f"<div>{cells}</div>" if cells else "")
        + (f'<ul style="margin:0.3em 0">{listed}</ul>' if listed else "")
        + "</div>"
    )


def pre(content: str, *, most: int = 24, more: str = "print(result.text)") -> str:
    """Return the first lines of a text as they stand; where there are more, a line says how they are seen."""
    lines = content.splitlines()
    rest = f"\n... and {len(lines) - most} more lines: {more}" if len(lines) > most + 2 else ""
    shown = "\n".join(lines[:most] if rest else lines) + rest
    return f'<pre style="margin:0.3em 0;overflow-x:auto;font-size:inherit">{escape(shown)}</pre>'


def line(text: str) -> str:
    """Return a line of text."""
    return f"<div>{escape(text)}</div>"


def rows(head: Sequence[str], body: Sequence[Sequence[str]], *, markup: Sequence[str] = ()) -> str:
    """Return a table of texts; `markup` is HTML that goes before the cells of each row."""
    right = f'style="{_CELL};text-align:right"'
    left = f'style="{_CELL};text-align:left"'
    first = f"<th {left}></th>" if markup else ""
    heads = "".join(f"<th {left if place == 0 else right}>{escape(name)}</th>" for place, name in enumerate(head))
    lines = []
    for number, cells in enumerate(body):
        before = f"<td {left}>{markup[number]}</td>" if markup else ""
        texts = "".join(f"<td {left if place == 0 else right}>{escape(cell)}</td>" for place, cell in enumerate(cells))
        lines.append(f"<tr>{before}{texts}</tr>")
    return (
        '<div style="overflow-x:auto"><table style="border-collapse:collapse;margin:0.3em 0;color:inherit;'
        'font-size:inherit;font-variant-numeric:tabular-nums">'
        f"<tr>{first}{heads}</tr>{''.join(lines)}</table></div>"
    )


def svg(width: float, height: float, label: str, *content: str, stretch: bool = True) -> str:
    """Return a drawing that a label says in words; it takes the width that it is given, up to its own."""
    size = f'width="100%" style="max-width:{width:g}px;display:block"' if stretch else f'width="{width:g}"'
    label_html = escape(label)
    return (
        f'<svg viewBox="0 0 {width:g} {height:g}" {size} role="img" aria-label="{label_html}">'
        f"<title>{label_html}</title>{''.join(content)}</svg>"
    )


def stroke(x1: float, y1: float, x2: float, y2: float, *, width: float = 1.0, opacity: float = 1.0) -> str:
    """Return a straight line in the colour of the text."""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="currentColor" '
        f'stroke-width="{width:g}" stroke-opacity="{opacity:g}"/>'
    )


def text(x: float, y: float, words: str, *, anchor: str = "start", size: float = 11.0) -> str:
    """Return a text in the colour of the text around the drawing."""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size:g}" fill="currentColor">'
        f"{escape(words)}</text>"
    )


def curve(x: FloatArray, y: FloatArray, *, colour: str = COLOUR, width: float = 1.2) -> str:
    """Return a line through points."""
    points = " ".join(f"{place:.1f},{height:.1f}" for place, height in zip(x, y, strict=True))
    return f'<polyline points="{points}" stroke="{colour}" stroke-width="{width:g}" fill="none"/>'


def history(y: FloatArray, width: int) -> str:
    """Return samples over a width in pixels: a line, or their range in each column of pixels where they are many."""
    if len(y) <= width:
        return curve((np.arange(len(y)) + 0.5) * width / len(y), y, width=1.0)
    starts = np.linspace(0, len(y), width, endpoint=False).astype(int)
    parts = [y[start:end] for start, end in zip(starts, np.append(starts[1:], len(y)), strict=True)]
    path = "L".join(f"{x} {part.min():.1f}V{part.max():.1f}" for x, part in enumerate(parts))
    return f'<path d="M{path}" transform="translate(0.5 0)" stroke="{COLOUR}" fill="none"/>'
