"""Roles of models in figures and pages: names, colours and marks; Greek letters, and text that runs either way."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

from markupsafe import Markup, escape

BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
GREEN: Final = "#009E73"
PURPLE: Final = "#CC79A7"
ORANGE: Final = "#E69F00"
SKY: Final = "#56B4E9"
GREY: Final = "#8C8C8C"
INK: Final = "#222222"
PAPER: Final = "#FFFFFF"
DEEP_BLUE: Final = "#002B4D"
MAGENTA: Final = "#A4276F"


@dataclass(frozen=True)
class Role:
    """Name, colours, dashes and marker of one thing in all figures. `text` is the hue for words and thin lines on
    white, contrast 4.5 at least (WCAG 2.2, 1.4.3), `dark` that on dark paper.
    """

    name: str
    colour: str
    text: str
    dark: str
    line: Any = "-"
    marker: str = "o"

    @property
    def look(self) -> dict[str, Any]:
        """Colour and dashes, for a line of matplotlib."""
        return {"color": self.colour, "linestyle": self.line}

    @property
    def mark(self) -> dict[str, Any]:
        """Colour and marker without a line, likewise."""
        return {"color": self.colour, "marker": self.marker, "linestyle": ""}

    @property
    def band(self) -> dict[str, Any]:
        """A paler area, for a bar of matplotlib."""
        return {"color": self.colour, "alpha": 0.3, "linewidth": 0.0}


SLIDE: Final = Role("goods slide", BLUE, "#0072b2", "#62b6f0")
CODE: Final = Role("code", VERMILION, "#b34700", "#ff9a5c", (0, (5, 2)), "s")
ATTACHED: Final = Role("all attached", GREEN, "#00765a", "#45cfa3", (0, (1.2, 1.2)), "^")
BARE: Final = Role("none attached", GREY, "#595959", "#ababab", (0, (8, 2)), "v")
ADVISED: Final = Role("advised", INK, "#1c1c1c", "#e6e6e6", (0, (6, 1.5, 1, 1.5)), "D")
"""The share that is found, and the model that has it."""
SLIDE_LOW: Final = Role("goods slide, low friction", SKY, "#1f6f9f", "#9ad2f7", (0, (3, 1.5)), "v")
SLIDE_HIGH: Final = Role("goods slide, high friction", DEEP_BLUE, "#002b4d", "#c6dcf0", (0, (5, 1.5, 1, 1.5)), "^")
HAZARD: Final = Role("hazard", INK, "#1c1c1c", "#e6e6e6", "-", ".")
LIMIT: Final = Role("limit", INK, "#1c1c1c", "#e6e6e6", (0, (8, 2)), "|")
SPECTRUM: Final = Role("mean of the motions", BLUE, "#0072b2", "#62b6f0")
TARGET: Final = Role("target", VERMILION, "#b34700", "#ff9a5c", (0, (5, 2)), "s")
YIELDS: Final = Role("yields", MAGENTA, "#a4276f", "#ff8ac6")

BLOCK_COLOURS: Final = (BLUE, "#6BB5E3", DEEP_BLUE, "#3489BF", "#94CDEF", "#00527F")
"""Colours of block 1, 2, 3 and on, of floors and of storeys where each has its own: shades of that of sliding goods."""
KINDS: Final = (PURPLE, ORANGE, SKY, DEEP_BLUE)
"""Colours of what is no model: another program is the first; methods, kinds of contact and of energy."""
DARK: Final = {
    "ink": (INK, ADVISED.dark),
    "paper": (PAPER, "#16181c"),
    "grey": (GREY, "#9a9a9a"),
    "blue": (BLUE, SLIDE.dark),
    "vermilion": (VERMILION, CODE.dark),
    "green": (GREEN, ATTACHED.dark),
    "purple": (PURPLE, "#e0a3c6"),
    "orange": (ORANGE, "#f0b440"),
    "sky": (SKY, SLIDE_LOW.dark),
    "deep-blue": (DEEP_BLUE, SLIDE_HIGH.dark),
    "magenta": (MAGENTA, YIELDS.dark),
}
"""Colours of figures by their name in CSS, on white and on dark paper."""
CSS_NAMES: Final = {
    "--slide": SLIDE,
    "--code": CODE,
    "--attached": ATTACHED,
    "--bare": BARE,
    "--yield": YIELDS,
}
"""Variables by which pages, animations and the live page name the colours of roles."""

MODELS: Final = {
    "real": SLIDE,
    "real_mu_low": SLIDE_LOW,
    "real_mu_high": SLIDE_HIGH,
    "advised": ADVISED,
    "code": CODE,
    "attached": ATTACHED,
    "bare": BARE,
    "none": BARE,
}
"""Roles of models by the names that tables give them."""

EFFECTIVE: Final = "effective fraction"
"""Name of the share with which a model drifts as the building whose goods slide."""
OVER_MODEL: Final = f"{SLIDE.name} / model"
"""Name of the ratio of a drift with goods that slide to that of a model."""

ALPHA: Final = "\N{GREEK SMALL LETTER ALPHA}"
ETA: Final = "\N{GREEK SMALL LETTER ETA}"
LAMBDA: Final = "\N{GREEK SMALL LETTER LAMDA}"
MU: Final = "\N{GREEK SMALL LETTER MU}"
OMEGA: Final = "\N{GREEK CAPITAL LETTER OMEGA}"
"""Symbols as letters: a formula takes as long to be set as a whole panel."""
SHARE: Final = f"share {LAMBDA} of the goods attached as mass"
"""Name of the axis of shares."""

_LETTERS: Final = {"alpha": ALPHA, "eta": ETA, "lambda": LAMBDA, "mu": MU, "Omega": OMEGA}
_MINUS: Final = re.compile(r"(?:(?<![\w.)\]-])|(?<=\de))-(?=\.?\d)|(?<=[A-Z]\d )-(?= \d)|(?<=\) )-(?= \d)")
_TIMES: Final = re.compile(r"(?<=\bmu) x(?= \d)")
_WORD: Final = re.compile(rf"\b({'|'.join(_LETTERS)})(?=\b|_)")


def lettered(text: str) -> str:
    """Return a text of the package in which symbols are letters: Greek ones, a true minus, a cross of times."""
    text = _MINUS.sub("\N{MINUS SIGN}", _TIMES.sub(" \N{MULTIPLICATION SIGN}", text))
    return _WORD.sub(lambda match: _LETTERS[match[1]], text)


def model_name(model: str) -> str:
    """Return what a figure or text calls a model of a table; a name of the user's is kept."""
    return MODELS[model].name if model in MODELS else model


def css(*, dark: bool) -> str:
    """Return the declarations of `CSS_NAMES`, for light or for dark paper."""
    return " ".join(f"{name}: {role.dark if dark else role.text};" for name, role in CSS_NAMES.items())


def runs_leftwards(character: str) -> bool:
    """Whether a character belongs to a script that is written from right to left."""
    return unicodedata.bidirectional(character) in ("R", "AL")


def isolated(text: str) -> Markup:
    """Return a name as HTML, isolated where it runs from right to left."""
    return Markup("<bdi>{}</bdi>").format(text) if any(map(runs_leftwards, text)) else escape(text)


def apart(text: str) -> str:
    """Return a name for a line of text, isolated by characters where it runs from right to left."""
    return f"\N{FIRST STRONG ISOLATE}{text}\N{POP DIRECTIONAL ISOLATE}" if any(map(runs_leftwards, text)) else text


def sentence_html(text: str, names: Iterable[str] = ()) -> Markup:
    """Return a sentence of the package as HTML: symbols as Greek letters, the user's `names` in it unchanged."""
    special = {name for name in names if name and (lettered(name) != name or any(map(runs_leftwards, name)))}
    if not special:
        return escape(lettered(text))
    pattern = "|".join(re.escape(name) for name in sorted(special, key=len, reverse=True))
    parts = re.split(f"({pattern})", text)
    return Markup("").join(isolated(part) if place % 2 else escape(lettered(part)) for place, part in enumerate(parts))
