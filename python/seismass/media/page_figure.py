"""Figures of a page: inline SVG with an alternative text and with identifiers that are unique in the page."""

from __future__ import annotations

import hashlib
import re
from typing import Final

from markupsafe import Markup
from matplotlib.figure import Figure

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, refusal
from seismass.media.svg import short_svg

LEAST_SCALE: Final = 0.8
"""How far a figure shrinks before it is scrolled: letters of 9 points are then 9.6 pixels, of 7.5 points 8 pixels."""

_ROOT: Final = re.compile(r"<svg\b([^>]*)>")
_LENGTH: Final = re.compile(r"\b(width|height)\s*=\s*[\"']([\d.]+)(pt|px)?[\"']")
_METADATA: Final = re.compile(r"<metadata>.*?</metadata>\s*", re.DOTALL)
_ID: Final = re.compile(r"\sid=\"([^\"]*)\"")
_REFERENCE: Final = re.compile(r"(url\(#|href=\"#)([^)\"]+)")


def figure_html(figure: Figure | str, caption: str, alt: str, *, narrow: Figure | str | None = None) -> Markup:
    """Return a figure as inline SVG, at most as wide as it was made, scrolled on narrow screens unless `narrow`
    replaces it. In dark mode light and dark are exchanged, or `currentColor` is that of the text.
    """
    if not alt.strip():
        raise refusal(InvalidOption, "alt", "figure", "a description", brief(alt))
    wide = _Drawing(figure)
    drawings = [wide.html(caption, alt, "" if narrow is None else " on-wide")]
    if narrow is not None:
        drawings.append(_Drawing(narrow).html(caption, alt, " on-narrow"))
    return Markup('<figure style="--own:{}">{}<figcaption>{}</figcaption></figure>').format(
        wide.width or "100%", Markup("").join(drawings), caption
    )


class _Drawing:
    """An SVG: its attributes, its content, and how wide it was made; empty where it does not say."""

    def __init__(self, figure: Figure | str) -> None:
        self._svg = short_svg(figure) if isinstance(figure, Figure) else figure
        root = _ROOT.search(self._svg)
        if root is None or "viewBox=" not in root[1] or "</svg>" not in self._svg:
            raise refusal(InvalidOption, "figure", "page", "an SVG with a viewBox", brief(self._svg[:60]))
        self._attributes = root[1]
        self._content = _METADATA.sub("", self._svg[root.end() :])
        lengths = {name: (float(value), unit or "px") for name, value, unit in _LENGTH.findall(root[1])}
        self._value, self._unit = lengths.get("width", (0.0, ""))

    @property
    def width(self) -> str:
        """Width as CSS has it."""
        return f"{self._value:g}{self._unit}" if self._unit else ""

    def html(self, caption: str, alt: str, kind: str) -> Markup:
        """Return the drawing in its frame, which scrolls where it is too narrow."""
        body = _with_own_ids(self._content[: self._content.rindex("</svg>")], f"{self._content}{caption}{alt}")
        least = f"{0.0 if 'on-narrow' in kind else LEAST_SCALE * self._value:g}{self._unit}"
        kept = re.sub(r"\b(id|style|role|version)\s*=\s*(\"[^\"]*\"|'[^']*')", "", _LENGTH.sub("", self._attributes))
        return Markup(
            '<div class="scroll{kind}" tabindex="0" role="group" aria-label="figure"><svg{attributes} class="{looks}" '
            'role="img" style="{style}"><title>{alt}</title>{body}</svg></div>'
        ).format(
            kind=kind,
            attributes=Markup(" ".join(["", *kept.split()])),
            looks="adapts" if "currentColor" in self._svg else "inverts",
            style=f"max-width:{self.width};min-width:{least}" if self._unit else "",
            alt=alt,
            body=Markup(body),
        )


def _with_own_ids(body: str, unique: str) -> str:
    """Drop identifiers that nothing refers to, and begin the others with a digest of what no other figure has."""
    digest = hashlib.sha256(unique.encode()).hexdigest()[:8]
    used = {match[2] for match in _REFERENCE.finditer(body)}
    body = _ID.sub(lambda match: f' id="f{digest}-{match[1]}"' if match[1] in used else "", body)
    return _REFERENCE.sub(rf"\g<1>f{digest}-\g<2>", body)
