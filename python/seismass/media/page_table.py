"""Tables of a page: rows of a frame as HTML, which the script of the page sorts and filters."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, Final, TypeAlias

import polars as pl
from markupsafe import Markup

from seismass.base.errors import InvalidOption
from seismass.base.values import refusal
from seismass.media.isolate import isolated

Format: TypeAlias = str | Callable[[Any], str]
"""A format specification, such as ".3f", or a function from a value to its text or Markup."""

MISSING: Final = "\N{EN DASH}"
"""What stands for a null; such rows are last in either order."""
LONGEST_WHOLE: Final = 24
"""Characters of a name that is not broken at its hyphen."""
LEAST_ROWS_TO_FILTER: Final = 8
"""A table of fewer rows is neither sorted nor filtered."""


def table_html(
    frame: pl.DataFrame,
    caption: str,
    *,
    headers: Mapping[str, str] | None = None,
    formats: Mapping[str, Format] | None = None,
) -> Markup:
    """Return a table; a long one is sorted by its headers and filtered by a field above it. Headers are plain text,
    from which the script makes buttons, as Chromium does not repeat heads with buttons on printed pages.
    """
    headers, formats = headers or {}, formats or {}
    for owner, given in (("headers", headers), ("formats", formats)):
        for name in given:
            if name not in frame.columns:
                raise refusal(InvalidOption, owner, "table", f"of its columns ({', '.join(frame.columns)})", name)
    numeric = [dtype.is_numeric() or dtype == pl.Boolean for dtype in frame.dtypes]
    head = Markup("").join(
        Markup('<th scope="col"{}>{}</th>').format(Markup(' class="number"') if number else "", headers.get(name, name))
        for name, number in zip(frame.columns, numeric, strict=True)
    )
    columns = [
        [
            _cell(value, formats.get(name), number, heading=place == 0 and frame[name].dtype == pl.String)
            for value in frame[name]
        ]
        for place, (name, number) in enumerate(zip(frame.columns, numeric, strict=True))
    ]
    rows = Markup("\n").join(
        Markup("<tr>{}</tr>").format(Markup("").join(cells)) for cells in zip(*columns, strict=True)
    )
    field, kind = "", "table"
    if frame.height >= LEAST_ROWS_TO_FILTER:
        kind = "table long-table"
        field = Markup(
            '<p class="filter"><label>Filter rows <input type="search" autocomplete="off" spellcheck="false"></label> '
            '<output aria-live="polite"></output></p>'
        )
    return Markup(
        '<div class="{kind}">{field}<div class="scroll" tabindex="0" role="region" aria-label="{caption}">'
        "<table><caption>{caption}</caption><thead><tr>{head}</tr></thead>\n<tbody>{rows}</tbody></table></div></div>"
    ).format(kind=kind, field=field, caption=caption, head=head, rows=rows)


def _cell(value: Any, form: Format | None, number: bool, *, heading: bool) -> Markup:
    text: str = MISSING if value is None else _text(value, form)
    whole = ' class="whole"' if not number and "-" in text and len(text) <= LONGEST_WHOLE else ""
    if not isinstance(text, Markup):
        text = isolated(text)
    start, end = ('<th scope="row"', "</th>") if heading else ("<td", "</td>")
    if not number:
        return Markup(start + whole + ">{}" + end).format(text)
    # What sorts; a value that is missing has none.
    missing = value is None or (isinstance(value, float) and math.isnan(value))
    held = "" if missing else Markup(' data-value="{}"').format(f"{float(value):.9g}")
    return Markup(start + ' class="number"{}>{}' + end).format(held, text)


def _text(value: Any, form: Format | None) -> str:
    if callable(form):
        return form(value)
    if isinstance(value, pl.Series | list):
        return ", ".join(_text(item, form) for item in value)
    if form is not None:
        return format(value, form).replace("-", "\N{MINUS SIGN}") if _is_number(value) else format(value, form)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}".replace("-", "\N{MINUS SIGN}")
    return str(value)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
