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
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import polars as pl
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from seismass.base.errors import InvalidOption
from seismass.base.values import refusal, signed
from seismass.media.result import Format, described
from seismass.media.roles import SLIDE, css, isolated, lettered
from seismass.media.svg import figure_html

__all__ = ["Format", "Section", "facts_html", "figure_html", "page_html", "table_html", "templates", "text_html"]

MISSING: Final = "\N{EN DASH}"
"""What stands for a null; such rows are last in either order."""
LONGEST_WHOLE: Final = 24
"""Characters of a name that is not broken at its hyphen."""
LEAST_ROWS_TO_FILTER: Final = 8
"""A table of fewer rows is neither sorted nor filtered."""


def described_html(tables: str, frame: pl.DataFrame, caption: str, **options: Any) -> Markup:
    """Return rows of tables of a result as `described` has them."""
    shown, heads, forms = described(tables, frame, **options)
    return table_html(shown, caption, headers={name: lettered(head) for name, head in heads.items()}, formats=forms)


def table_html(
    frame: pl.DataFrame,
    caption: str,
    *,
    headers: Mapping[str, str] | None = None,
    formats: Mapping[str, Format] | None = None,
    folds: bool = False,
) -> Markup:
    """Return a table; a long one is sorted by its headers and filtered by a field above it; one that folds has a block
    for each row on narrow screens. Headers are plain text: on paper Chromium repeats no heads with buttons.
    """
    headers, formats = headers or {}, formats or {}
    for owner, names in (("headers", headers), ("formats", formats)):
        for name in names:
            if name not in frame.columns:
                raise refusal(InvalidOption, owner, "table", f"of its columns ({', '.join(frame.columns)})", name)
    numeric = [dtype.is_numeric() or dtype == pl.Boolean for dtype in frame.dtypes]
    head = Markup("").join(
        Markup('<th scope="col"{}>{}</th>').format(Markup(' class="number"') if number else "", headers.get(name, name))
        for name, number in zip(frame.columns, numeric, strict=True)
    )
    headings = [place == 0 and dtype == pl.String for place, dtype in enumerate(frame.dtypes)]
    columns = [
        [
            _cell(value, formats.get(name), number, heading, headers.get(name, name) if folds else "")
            for value in frame[name]
        ]
        for name, number, heading in zip(frame.columns, numeric, headings, strict=True)
    ]
    rows = Markup("\n").join(
        Markup("<tr>{}</tr>").format(Markup("").join(cells)) for cells in zip(*columns, strict=True)
    )
    field, kind = "", "table folds" if folds else "table"
    if frame.height >= LEAST_ROWS_TO_FILTER:
        kind += " long-table"
        field = Markup(
            '<p class="filter"><label>Filter rows <input type="search" autocomplete="off" spellcheck="false"></label> '
            '<output aria-live="polite"></output></p>'
        )
    return Markup(
        '<div class="{kind}">{field}<div class="scroll" tabindex="0" role="region" aria-label="{caption}">'
        "<table><caption>{caption}</caption><thead><tr>{head}</tr></thead>\n<tbody>{rows}</tbody></table></div></div>"
    ).format(kind=kind, field=field, caption=caption, head=head, rows=rows)


def _cell(value: Any, form: Format | None, number: bool, heading: bool, head: str) -> Markup:
    text: str = MISSING if value is None else _text(value, form)
    whole = ' class="whole"' if not number and "-" in text and len(text) <= LONGEST_WHOLE else ""
    if not isinstance(text, Markup):
        text = isolated(text)
    start, end = ('<th scope="row"', "</th>") if heading else ("<td", "</td>")
    labelled = Markup(' data-head="{}"').format(head) if head and not heading else ""
    if not number:
        return Markup(start + whole + "{}>{}" + end).format(labelled, text)
    # What sorts; a value that is missing has none.
    missing = value is None or (isinstance(value, float) and math.isnan(value))
    held = "" if missing else Markup(' data-value="{}"').format(f"{float(value):.9g}")
    return Markup(start + ' class="number"{}{}>{}' + end).format(held, labelled, text)


def _text(value: Any, form: Format | None) -> str:
    if callable(form):
        return form(value)
    if isinstance(value, pl.Series | list):
        return ", ".join(_text(item, form) for item in value)
    if form is not None:
        return lettered(signed(value, form)) if _is_number(value) else format(value, form)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return lettered(signed(value, ".4g"))
    return str(value)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


_SCRIPT: Final = re.compile(r"<script\b[^>]*>(.*?)</script>", re.DOTALL)
_NOT_PLAIN: Final = re.compile(r"[^\w ,.;:-]")
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
    running: Mapping[str, str] | None = None,
) -> str:
    """Return a whole page that makes no request and runs its own scripts alone; `runs_kernel` adds WebAssembly, also in
    a worker. `lead` stands before the contents, `running` in the margins of printed sheets by their place ("top-left").
    """
    placed = _placed(sections, 2, set())
    page: str = (
        templates()
        .get_template("base.html.jinja")
        .render(
            title=title,
            subtitle=subtitle,
            description=description,
            lead=lead,
            sections=placed,
            icon=_icon(),
            margins=_margins(running or {}),
        )
    )
    digests = (hashlib.sha256(script.encode()).digest() for script in _SCRIPT.findall(page))
    allowed = dict.fromkeys(f"'sha256-{base64.b64encode(digest).decode()}'" for digest in digests)
    sources = [*allowed, *(("'wasm-unsafe-eval'", "; worker-src", "blob:") if runs_kernel else ())]
    # The template leaves one place for it, ahead of anything that a caller gave.
    return page.replace("SCRIPT-DIGESTS", " ".join(sources).replace(" ;", ";"), 1)


def _margins(running: Mapping[str, str]) -> Markup:
    """Margin boxes of sheets; every letter of a text is an escape of CSS unless it is plain."""
    boxes = "".join(
        f'@{place} {{ content: "{_NOT_PLAIN.sub(lambda letter: chr(92) + format(ord(letter[0]), "06x"), text)}"; }} '
        for place, text in running.items()
    )
    return Markup('{}@bottom-right {{ content: counter(page) " / " counter(pages); }}').format(Markup(boxes))


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


def bullets_html(lines: Iterable[str]) -> Markup:
    """Return sentences as a list; Markup is taken as it is."""
    return Markup("<ul>{}</ul>").format(Markup("").join(Markup("<li>{}</li>").format(line) for line in lines))


def whole_html(names: Iterable[str]) -> Markup:
    """Return names with commas between, none of which is broken at a hyphen."""
    return Markup(", ").join(Markup('<span class="whole">{}</span>').format(name) for name in names)


def long_html(text: str) -> Markup:
    """Return a text that keeps some width in a table, on a narrow screen too."""
    return Markup('<span class="long">{}</span>').format(isolated(text))


MOST_STOREYS: Final = 4
"""Storeys that the page solves."""
PAGE: Final = "explorer.html"
"""File that `seismass explore` writes."""
RECORD: Final = "synthetic-1"
LIMITS: Final = {
    "T": (0.05, 5.0),
    "z": (0.0, 0.5),
    "O": (1.0, 10.0),
    "r2": (0.0, 1.0),
    "h": (0.5, 20.0),
    "V": (0.001, 20.0),
    "a": (0.0, 10.0),
    "s": (0.0, 5.0),
    "k": (0.0, 5.0),
    "c": (0.0, 1.0),
    "r3": (0.0, 1.0),
    "M": (0.01, 4.0),
    "K": (0.001, 1000.0),
    "o": (0.01, 100.0),
}
"""Range of each number, by its letters in the address: `LIMITS` of case.js."""


DIFFERENCES: Final = {
    "motions": "motions are the seven built-in ones, scaled to the site of the file",
    "scale": "motions are the seven built-in ones, scaled to their own target",
    "kinds": "kinds of goods on a floor are one, with their mean friction",
    "bolted": "bolted goods are part of their floors, in damping too",
    "height": "storeys are 3.5 m high, since heights are not known here",
    "gravity": "P-Delta has the loads of the floor masses",
    "capped": "large drifts are not capped",
    "median": "drifts are means over the motions, not medians",
    "collapse": "no storey counts as collapsed at a drift of its own",
    "counted": "the model of the code has all goods present attached, no more",
}
"""What is different in the live page of a building of a file, by the word that its address has."""


@dataclass(frozen=True)
class LiveCase:
    """A building as the live page has it: forces over its weight, masses over the mean floor, stiffnesses over the
    first; `answer` has share, interval and number of motions of the file, `differs` keys of `DIFFERENCES`.
    """

    period: float
    damping: float
    p_delta: bool
    overstrength: Sequence[float]
    second_slope: Sequence[float]
    third_slope: Sequence[float]
    height: Sequence[float]
    strength: Sequence[float]
    mass_ratio: Sequence[float]
    mu_s: Sequence[float]
    mu_k: Sequence[float]
    mass: Sequence[float]
    stiffness: Sequence[float]
    counted: float
    present: float
    factors: Sequence[float] = ()
    answer: Sequence[float] = ()
    differs: Sequence[str] = ()

    @property
    def numbers(self) -> dict[str, Sequence[float]]:
        """What the address says, by its letters."""
        alone = {"T": self.period, "z": self.damping, "c": self.counted, "o": self.present}
        lists = {"h": self.height, "O": self.overstrength, "r2": self.second_slope, "r3": self.third_slope}
        lists |= {"M": self.mass, "K": self.stiffness, "a": self.mass_ratio, "s": self.mu_s, "k": self.mu_k}
        lists |= {"V": self.strength} if self.strength else {}
        return {**{key: [value] for key, value in alone.items()}, **lists}

    @property
    def out_of_range(self) -> tuple[str, ...]:
        """Letters of the numbers that the page does not take."""
        items = self.numbers.items()
        return tuple(key for key, values in items if not all(LIMITS[key][0] <= one <= LIMITS[key][1] for one in values))

    @property
    def address(self) -> str:
        """What follows the # of the address."""
        design = "hand" if self.strength else "elastic"
        parts = ["v=1", f"by={design}", f"m={RECORD}", "d=code", f"n={len(self.mass_ratio)}", "x=1"]
        lists = {**self.numbers, "P": [self.p_delta], "g": self.factors, "F": self.answer}
        parts += [f"{key}={','.join(f'{value:.12g}' for value in values)}" for key, values in lists.items() if values]
        return "&".join(parts + ([f"W={','.join(self.differs)}"] if self.differs else []))
