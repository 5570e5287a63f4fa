"""Parts of small HTML: a card with its title, facts and notes, tables of a few rows, and elements of SVG.

Style is in place, text is escaped. There is no script, nothing from elsewhere, and no id, so that any number of cards
stand on one page. Everything but the accents has the colour of the text around it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Final

import numpy as np

from seismass.base.values import FloatArray
from seismass.media.roles import CODE, SLIDE

COLOUR: Final = SLIDE.colour
"""The accent: legible on white and on dark grey."""
SECOND: Final = CODE.colour
"""The second accent, in the same form."""

_CELL: Final = "padding:0.1em 0.8em 0.1em 0;background:none;border:none;white-space:nowrap"


def card(
    title: str, about: str, *content: str, facts: Sequence[tuple[str, str]] = (), notes: Iterable[str] = ()
) -> str:
    """Return a card: title and a few words, content that is HTML already, names with their values, notes."""
    cells = " ".join(
        f'<span style="margin-right:1.2em;white-space:nowrap">{escape(name)}&#160;<b>{escape(value)}</b></span>'
        for name, value in facts
    )
    listed = "".join(f"<li>{escape(note)}</li>" for note in notes)
    return (
        '<div style="max-width:640px;color:inherit;font-size:90%">'
        f"<div><b>{escape(title)}</b>{': ' if about else ''}{escape(about)}</div>"
        + "".join(content)
        + (f"<div>{cells}</div>" if cells else "")
        + (f'<ul style="margin:0.3em 0">{listed}</ul>' if listed else "")
        + "</div>"
    )


def pre(said: str, *, most: int = 24, more: str = "print(result.text)") -> str:
    """Return the first lines of a text as they stand; where there are more, a line says how they are seen."""
    lines = said.splitlines()
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
    said = escape(label)
    return (
        f'<svg viewBox="0 0 {width:g} {height:g}" {size} role="img" aria-label="{said}">'
        f"<title>{said}</title>{''.join(content)}</svg>"
    )


def stroke(x1: float, y1: float, x2: float, y2: float, *, width: float = 1.0, opacity: float = 1.0) -> str:
    """Return a straight line in the colour of the text."""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="currentColor" '
        f'stroke-width="{width:g}" stroke-opacity="{opacity:g}"/>'
    )


def text(x: float, y: float, said: str, *, anchor: str = "start", size: float = 11.0) -> str:
    """Return a text in the colour of the text around the drawing."""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size:g}" fill="currentColor">'
        f"{escape(said)}</text>"
    )


def curve(x: FloatArray, y: FloatArray, *, colour: str = COLOUR, width: float = 1.2) -> str:
    """Return a line through points."""
    points = " ".join(f"{at:.1f},{height:.1f}" for at, height in zip(x, y, strict=True))
    return f'<polyline points="{points}" stroke="{colour}" stroke-width="{width:g}" fill="none"/>'


def history(y: FloatArray, width: int) -> str:
    """Return samples over a width in pixels: a line, or their range in each column of pixels where they are many."""
    if len(y) <= width:
        return curve((np.arange(len(y)) + 0.5) * width / len(y), y, width=1.0)
    starts = np.linspace(0, len(y), width, endpoint=False).astype(int)
    parts = [y[start:end] for start, end in zip(starts, np.append(starts[1:], len(y)), strict=True)]
    path = "L".join(f"{x} {part.min():.1f}V{part.max():.1f}" for x, part in enumerate(parts))
    return f'<path d="M{path}" transform="translate(0.5 0)" stroke="{COLOUR}" fill="none"/>'
