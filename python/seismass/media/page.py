"""Self-contained HTML pages: a frame with a table of contents, sections, tables and figures.

A page needs no network and forbids it to the browser. It works without its script, which sorts and filters tables.

Examples
--------
>>> import polars as pl
>>> from seismass.media.page import Section, figure_html, page_html, table_html, text_html
>>> rows = pl.DataFrame({"storey": [1, 2], "drift": [0.0123, 0.0087]})
>>> headers, formats = {"drift": "peak drift (mm)"}, {"drift": lambda drift: f"{1e3 * drift:.1f}"}
>>> table = table_html(rows, "Peak drift.", headers=headers, formats=formats)
>>> sketch = '<svg viewBox="0 0 10 10"><circle cx="5" cy="5" r="4" fill="currentColor"/></svg>'
>>> figure = figure_html(sketch, "A floor.", "a disc that stands for a floor")
>>> page = page_html("Two storeys", [Section("Result", [text_html("Storey 1 drifts most."), table, figure])])
>>> page.startswith("<!doctype html>")
True
"""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from seismass.media.page_figure import figure_html
from seismass.media.page_table import Format, table_html
from seismass.media.roles import SLIDE, css

__all__ = ["Format", "Section", "facts_html", "figure_html", "page_html", "table_html", "templates", "text_html"]

_SCRIPT: Final = re.compile(r"<script\b[^>]*>(.*?)</script>", re.DOTALL)
_NOT_IN_ID: Final = re.compile(r"[^a-z0-9]+")


@dataclass(frozen=True)
class Section:
    """A part of a page with its entry in the table of contents. The title is what it is linked by; content that is not
    Markup is escaped; `sections` are one level lower.
    """

    title: str
    content: Sequence[str] = ()
    sections: Sequence[Section] = ()


@dataclass(frozen=True)
class _Placed:
    """A section with its identifier, as the template takes it."""

    title: str
    identifier: str
    level: int
    content: Sequence[str]
    sections: Sequence[_Placed]


def text_html(*paragraphs: str) -> Markup:
    """Return paragraphs; text is escaped, Markup is taken as it is."""
    return Markup("\n").join(Markup("<p>{}</p>").format(paragraph) for paragraph in paragraphs)


def facts_html(facts: Mapping[str, str]) -> Markup:
    """Return a list of names and what they are, such as inputs or versions."""
    rows = (Markup("<div><dt>{}</dt><dd>{}</dd></div>").format(name, value) for name, value in facts.items())
    return Markup('<dl class="facts">{}</dl>').format(Markup("").join(rows))


def edited_html(edited: Sequence[str]) -> list[Markup]:
    """What a page says of files that were edited since they were written; nothing where none was."""
    if not edited:
        return []
    words = "Edited since seismass wrote them, so that this page may not be what was computed: {}."
    return [Markup('<p class="edited"><strong>{}</strong></p>').format(words.format(", ".join(edited)))]


def page_html(
    title: str,
    sections: Iterable[Section],
    *,
    subtitle: str = "",
    description: str = "",
    lead: Iterable[str] = (),
    runs_kernel: bool = False,
) -> str:
    """Return a whole page. Its Content-Security-Policy allows no request and only the page's scripts, by their digests;
    `runs_kernel` adds WebAssembly, also in a worker. `lead` stands before the table of contents.
    """
    placed = _placed(sections, 2, set())
    page: str = (
        templates()
        .get_template("base.html.jinja")
        .render(title=title, subtitle=subtitle, description=description, lead=lead, sections=placed, icon=_icon())
    )
    digests = (hashlib.sha256(script.encode()).digest() for script in _SCRIPT.findall(page))
    allowed = dict.fromkeys(f"'sha256-{base64.b64encode(digest).decode()}'" for digest in digests)
    sources = [*allowed, *(("'wasm-unsafe-eval'", "; worker-src", "blob:") if runs_kernel else ())]
    # The template leaves one place for it, ahead of anything that a caller gave.
    return page.replace("SCRIPT-DIGESTS", " ".join(sources).replace(" ;", ";"), 1)


@cache
def templates() -> Environment:
    """Return the templates of the package; what they are given is escaped."""
    environment = Environment(
        loader=PackageLoader("seismass.media"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals |= {"role_colours": css(dark=False), "role_colours_dark": css(dark=True)}
    return environment


def _icon() -> str:
    """A storey with goods on its floor, as the address of an image."""
    colour = SLIDE.text.replace("#", "%23")
    return (
        "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E%3Cpath d='M2 15V8h12v7M5 7"
        f"V2h6v5' fill='none' stroke='{colour}' stroke-width='2'/%3E%3C/svg%3E"
    )


def _placed(sections: Iterable[Section], level: int, taken: set[str]) -> tuple[_Placed, ...]:
    """Sections with identifiers made of their titles, each once in a page."""
    placed = []
    for section in sections:
        stem = _NOT_IN_ID.sub("-", section.title.lower()).strip("-") or "section"
        identifier, number = stem, 1
        while identifier in taken:
            number += 1
            identifier = f"{stem}-{number}"
        taken.add(identifier)
        content = tuple(escape(part) for part in section.content)
        placed.append(
            _Placed(section.title, identifier, level, content, _placed(section.sections, level + 1, taken)),
        )
    return tuple(placed)
