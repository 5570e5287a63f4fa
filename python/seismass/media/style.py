"""Style of all figures: line looks and settings, in one place; colours and roles are those of `seismass.media.roles`.

Figures are made without pyplot, so that nothing global changes. Series differ in more than colour, so that a figure can
be read in grey.
"""

from __future__ import annotations

import gc
import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any, Final

from matplotlib.figure import Figure

from seismass.media.isolate import runs_leftwards
from seismass.media.roles import BLOCK_COLOURS, GREY, INK

PERIOD_TICKS: Final = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0)
"""Periods (s) that logarithmic axes name."""

SERIES: Final[tuple[dict[str, Any], ...]] = tuple(
    {"color": colour, "linestyle": line}
    for colour, line in zip(
        BLOCK_COLOURS,
        ("-", (0, (5, 2)), (0, (1.2, 1.2)), (0, (5, 1.5, 1, 1.5)), (0, (8, 2)), (0, (3, 1, 1, 1, 1, 1))),
        strict=True,
    )
)
"""Looks of lines in one panel, in their order; they differ in dashes too."""

STYLE: Final[Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 9.0,
    "text.color": INK,
    "hatch.linewidth": 0.5,
    "svg.fonttype": "none",  # text stays text: it can be selected, and takes less room than outlines
    "svg.hashsalt": "seismass",  # the same figure is the same file
    "figure.autolayout": False,
    "figure.constrained_layout.use": False,
}

_MISSING: Final = "\N{HORIZONTAL ELLIPSIS}"
_LEFT_OUT: Final = re.compile(f"{_MISSING}(?: ?{_MISSING})*")


def lay_out(figure: Figure, like: Figure | None = None) -> Figure:
    """Place the parts of a figure once and return it, so that each file is the same drawing. A figure of the same size
    and panels with texts as long may lend its places: `like`.
    """
    engine = figure.get_layout_engine()
    if engine is None:
        return figure
    if like is None:
        engine.execute(figure)
    else:
        for axes, model in zip(figure.axes, like.axes, strict=True):
            axes.set_position(model.get_position())
        for text, other in zip(figure.texts, like.texts, strict=True):
            text.set_position(other.get_position())
    figure.set_layout_engine(None)
    return figure


@contextmanager
def fewer_collections() -> Iterator[None]:
    """Suspend the collection of garbage while several figures are drawn: Matplotlib makes so many objects that repeated
    collections take a fifth of the time.
    """
    before = gc.get_threshold()
    gc.set_threshold(100_000, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)


def plain(text: str) -> str:
    """Return a text of the user's as a picture can show it: Matplotlib finds no formula in it, and words that its font
    lacks or that run from right to left become an ellipsis.
    """
    if text.isascii():
        return text.replace("$", r"\$")
    known = _letters_of_font()
    shown = "".join(
        letter if letter.isspace() or (ord(letter) in known and not runs_leftwards(letter)) else _MISSING
        for letter in text
    )
    # Marks that belong to a letter which is left out go with it.
    return _LEFT_OUT.sub(_MISSING, shown).replace("$", r"\$")


def shortened(text: str, most: int) -> str:
    """Return a text of at most so many characters, cut at its end."""
    return text if len(text) <= most else f"{text[: most - 1].rstrip()}{_MISSING}"


@cache
def _letters_of_font() -> frozenset[int]:
    """Code points that the font of figures has."""
    from matplotlib.font_manager import findfont, get_font

    return frozenset(get_font(findfont(STYLE["font.family"])).get_charmap())
