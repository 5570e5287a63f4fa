"""Style of all figures: colours, line looks and settings, in one place.

Figures are made without pyplot, so that nothing global changes. Colours are those of Okabe and Ito. Series differ in
more than colour, so that a figure can be read in grey.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final

from matplotlib.figure import Figure

BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
GREEN: Final = "#009E73"
PURPLE: Final = "#CC79A7"
ORANGE: Final = "#E69F00"
SKY: Final = "#56B4E9"
GREY: Final = "#8C8C8C"
INK: Final = "#222222"
PAPER: Final = "#FFFFFF"

PERIOD_TICKS: Final = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0)
"""Periods (s) that logarithmic axes name."""

SERIES: Final[tuple[dict[str, Any], ...]] = (
    {"color": BLUE, "linestyle": "-"},
    {"color": VERMILION, "linestyle": (0, (5, 2))},
    {"color": GREEN, "linestyle": (0, (1.2, 1.2))},
    {"color": INK, "linestyle": (0, (5, 1.5, 1, 1.5))},
    {"color": PURPLE, "linestyle": (0, (8, 2))},
    {"color": ORANGE, "linestyle": (0, (3, 1, 1, 1, 1, 1))},
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

ALPHA: Final = "\N{GREEK SMALL LETTER ALPHA}"
ETA: Final = "\N{GREEK SMALL LETTER ETA}"
LAMBDA: Final = "\N{GREEK SMALL LETTER LAMDA}"
MU: Final = "\N{GREEK SMALL LETTER MU}"
"""Symbols as letters: a formula takes as long to be set as a whole panel."""


def lay_out(figure: Figure, like: Figure | None = None) -> Figure:
    """Place what a figure has, once and for all, and return it: each file is then a single drawing.

    A figure of the same size with the same panels, whose texts are as long, may lend its places: `like`.
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
    """Let garbage with cycles lie while several figures are drawn.

    Matplotlib makes so many objects that looking through them again and again takes a fifth of the time.
    """
    before = gc.get_threshold()
    gc.set_threshold(100_000, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)


def plain(text: str) -> str:
    """Return a text of the user's in which matplotlib finds no formula."""
    return text.replace("$", r"\$")
