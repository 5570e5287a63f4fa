"""Figures of a page: SVG inside it, with a text for who cannot see it and identifiers that no other figure has."""

from __future__ import annotations

import hashlib
import re
from typing import Final

from markupsafe import Markup
from matplotlib.figure import Figure

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, refusal
from seismass.media.svg import short_svg

LEAST_SCALE: Final = 0.62
"""How far a figure shrinks before it is scrolled: text of 9 points is then one of 7.4 pixels high."""

_ROOT: Final = re.compile(r"<svg\b([^>]*)>")
_LENGTH: Final = re.compile(r"\b(width|height)\s*=\s*[\"']([\d.]+)(pt|px)?[\"']")
_METADATA: Final = re.compile(r"<metadata>.*?</metadata>\s*", re.DOTALL)
_ID: Final = re.compile(r"\sid=\"([^\"]*)\"")
_REFERENCE: Final = re.compile(r"(url\(#|href=\"#)([^)\"]+)")


def figure_html(figure: Figure | str, caption: str, alt: str) -> Markup:
    """Return a figure as inline SVG.

    It is as wide as the page lets it be, and no wider than it was made; on a narrow screen a large one is scrolled. In
    dark mode an SVG that uses `currentColor` has the colour of the text; the light and the dark of any other are
    exchanged, and its hues kept.

    Parameters
    ----------
    figure : matplotlib.figure.Figure or str
        The figure, or the text of an SVG.
    caption : str
        Text below it; Markup is taken as it is.
    alt : str
        What the figure shows, in words: its message rather than its looks.

    Raises
    ------
    InvalidOption
        The text is no SVG with a viewBox, or `alt` is empty.

    Examples
    --------
    >>> from seismass.media.page import figure_html
    >>> html = figure_html('<svg viewBox="0 0 4 2" width="4"><path d="M0 0h4"/></svg>', "A line.", "a level line")
    >>> '<title>a level line</title>' in html
    True
    """
    if not alt.strip():
        raise refusal(InvalidOption, "alt", "figure", "a description", brief(alt))
    svg = short_svg(figure) if isinstance(figure, Figure) else figure
    root = _ROOT.search(svg)
    if root is None or "viewBox=" not in root[1] or "</svg>" not in svg:
        raise refusal(InvalidOption, "figure", "page", "an SVG with a viewBox", brief(svg[:60]))
    body = _METADATA.sub("", svg[root.end() :])
    body = _with_own_ids(body[: body.rindex("</svg>")], f"{body}{caption}{alt}")
    style = ""
    for name, value, unit in _LENGTH.findall(root[1]):
        if name == "width":
            least = f"{LEAST_SCALE * float(value):g}"
            style = f"max-width:{value}{unit or 'px'};min-width:{least}{unit or 'px'}"
    attributes = re.sub(r"\b(id|style|role|version)\s*=\s*(\"[^\"]*\"|'[^']*')", "", _LENGTH.sub("", root[1]))
    return Markup(
        '<figure><div class="scroll" tabindex="0" role="group" aria-label="figure"><svg{attributes} class="{kind}" '
        'role="img" style="{style}"><title>{alt}</title>{body}</svg></div><figcaption>{caption}</figcaption></figure>'
    ).format(
        attributes=Markup(" ".join(["", *attributes.split()])),
        kind="adapts" if "currentColor" in svg else "inverts",
        style=style,
        alt=alt,
        body=Markup(body),
        caption=caption,
    )


def _with_own_ids(body: str, unique: str) -> str:
    """Drop identifiers that nothing refers to, and begin the others with a digest of what no other figure has."""
    digest = hashlib.sha256(unique.encode()).hexdigest()[:8]
    used = {match[2] for match in _REFERENCE.finditer(body)}
    body = _ID.sub(lambda match: f' id="f{digest}-{match[1]}"' if match[1] in used else "", body)
    return _REFERENCE.sub(rf"\g<1>f{digest}-\g<2>", body)
