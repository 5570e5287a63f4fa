"""How figures look: colours and names of roles, sizes, fonts, and figures apart from pyplot."""

from __future__ import annotations

import gc
import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np
from markupsafe import Markup, escape
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, counted, refusal

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

BLOCK_COLOURS: Final = (BLUE, VERMILION, GREEN, INK, PURPLE, ORANGE)
"""Colours of block 1, 2, 3 and on, and of floors and storeys where each has its own."""
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
_WORD: Final = re.compile(rf"\b({'|'.join(_LETTERS)})(?=\b|_)")


def lettered(text: str) -> str:
    """Return a text of the package in which symbols that a terminal spells out are Greek letters."""
    return _WORD.sub(lambda found: _LETTERS[found[1]], text)


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


@dataclass(frozen=True)
class Panels:
    """Axes to draw into, one for each thing that is drawn; the same one several times where they share it. `own`: the
    figure was made for them.
    """

    axes: list[Axes]
    shared: bool
    own: bool

    @property
    def left(self) -> list[Axes]:
        """Those that need a label of their own: the leftmost of each row of an own figure; of others all."""
        if not self.own:
            return list(dict.fromkeys(self.axes))
        return [axes for axes in self.axes if axes.get_subplotspec().is_first_col()]  # type: ignore[union-attr]

    @property
    def figure(self) -> Figure:
        """The whole figure."""
        found = self.axes[0].figure.figure  # of a subfigure the whole one
        assert isinstance(found, Figure)
        return found

    def legend(self, handles: Sequence[Any], columns: int = 4, labels: Sequence[str] | None = None) -> None:
        """Say what markers and lines are: above a figure of its own, inside axes that were given."""
        if not handles:
            return
        named: dict[str, Any] = {} if labels is None else {"labels": labels}
        if self.own:
            self.figure.legend(handles=handles, **named, loc="outside upper center", ncols=columns, frameon=False)
        else:
            self.axes[0].legend(handles=handles, **named, fontsize=8.0, framealpha=0.8)


def panels(
    ax: Axes | Sequence[Axes] | None, count: int, owner: str, *, width: float = 7.0, height: float = 1.25
) -> Panels:
    """Return axes for a number of things, one above the other, the first the lowest. An `ax` that is given must be one
    Axes or one for each.
    """
    if ax is None:
        figure = Figure(figsize=(width, 1.0 + height * count), layout="constrained")
        grid = figure.subplots(count, 1, sharex=True, sharey=True, squeeze=False)[:, 0]
        return Panels(list(grid[::-1]), shared=count == 1, own=True)
    return given(ax, count, owner)


def columns(
    ax: Axes | Sequence[Axes] | None, count: int, owner: str, *, width: float, height: float, most: int = 12
) -> Panels:
    """Return axes for a number of things side by side, which need not have the same scale. Beyond `most` they go on in
    further rows, as even as can be.
    """
    if ax is None:
        rows = -(-count // most)
        across = -(-count // rows)
        figure = Figure(figsize=(0.8 + width * across, height * rows), layout="constrained")
        grid = list(figure.subplots(rows, across, squeeze=False).flat)
        for unused in grid[count:]:
            unused.remove()
        return Panels(grid[:count], shared=count == 1, own=True)
    found = given(ax, count, owner)
    if found.shared and count > 1:
        raise refusal(InvalidOption, "ax", owner, f"a list of {count} Axes", "one Axes")
    return found


def given(ax: Any, count: int, owner: str) -> Panels:
    """Return axes that a caller gave: one for all things, or one for each."""
    if isinstance(ax, Axes):
        return Panels([ax] * count, shared=True, own=False)
    listed = list(ax) if isinstance(ax, Sequence | np.ndarray) else []
    if len(listed) != count or not all(isinstance(one, Axes) for one in listed):
        raise refusal(InvalidOption, "ax", owner, f"one Axes, or a list of {counted(count, 'Axes', 'Axes')}", brief(ax))
    return Panels(listed, shared=count == 1, own=False)


def single(ax: Axes | None, owner: str, *, size: tuple[float, float] = (6.4, 4.2)) -> Panels:
    """Return one Axes: that which is given, or that of a new figure."""
    if ax is None:
        figure = Figure(figsize=size, layout="constrained")
        return Panels([figure.add_subplot()], shared=True, own=True)
    return given(ax, 1, owner)


def grid_lines(axes: Axes) -> None:
    """Draw the faint grid that all panels have."""
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)


def zero_line(axes: Axes) -> None:
    """Draw where a history is zero."""
    axes.axhline(0.0, color=GREY, linewidth=0.6)


def say(axes: Axes, words: str, *, at: float | None = None) -> None:
    """Say in words that there is nothing to show: in the middle of axes, or at a height of their y axis."""
    transform = axes.transAxes if at is None else axes.get_yaxis_transform()
    box = {"boxstyle": "square,pad=0.25", "facecolor": PAPER, "edgecolor": "none"}
    look: Any = {"ha": "center", "va": "center", "fontsize": 8.5, "style": "italic", "color": INK}
    axes.text(0.5, 0.5 if at is None else at, words, transform=transform, bbox=box, gid="nothing", **look)


def ring(label: str) -> Line2D:
    """Return the entry of a legend for peaks."""
    return Line2D([], [], **RING, linestyle="", label=label)


RING: dict[str, Any] = {"marker": "o", "markersize": 6.0, "markerfacecolor": "none", "color": INK}
"""How a peak is marked."""
