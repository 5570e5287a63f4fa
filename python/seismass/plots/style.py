"""Style of all figures: colours, line looks and settings, in one place.

Figures are made without pyplot, so that nothing global changes. Colours are those of Okabe and Ito. Series differ in
more than colour, so that a figure can be read in grey.
"""

from __future__ import annotations

from typing import Any, Final

BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
GREEN: Final = "#009E73"
PURPLE: Final = "#CC79A7"
ORANGE: Final = "#E69F00"
SKY: Final = "#56B4E9"
GREY: Final = "#8C8C8C"
INK: Final = "#222222"
PAPER: Final = "#FFFFFF"

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
    "svg.fonttype": "none",  # text stays text: it can be selected, and takes less room than outlines
    "svg.hashsalt": "seismass",  # the same figure is the same file
}


def plain(text: str) -> str:
    """Return a text of the user's in which matplotlib finds no formula."""
    return text.replace("$", r"\$")
