"""How figures look: colours and names of roles, sizes, fonts, and figures apart from pyplot."""

from __future__ import annotations

import gc
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.rcsetup import cycler

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, counted, is_list, refusal
from seismass.media.roles import BLOCK_COLOURS, GREY, INK, PAPER, runs_leftwards

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
    "axes.prop_cycle": cycler(color=BLOCK_COLOURS),
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

_OF_PROGRAMS: Final = (
    *("backend", "date.epoch", "docstring", "figure.max_open", "figure.raise", "interactive", "savefig.directory"),
    *("timezone", "tk.", "toolbar", "webagg"),
)
"""Beginnings of the names of settings that are no look of a figure."""


@contextmanager
def drawing() -> Iterator[None]:
    """Draw under Matplotlib's own defaults and `STYLE`, whatever matplotlibrc, style sheets and programs say."""
    defaults = {name: value for name, value in mpl.rcParamsDefault.items() if not name.startswith(_OF_PROGRAMS)}
    with mpl.rc_context(defaults | STYLE):
        yield


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
    """Axes to draw into, one for each thing that is drawn; the same one several times where they share it. `is_new`:
    the figure was made for them.
    """

    axes: list[Axes]
    shared: bool
    is_new: bool

    @property
    def left(self) -> list[Axes]:
        """Those that need a label of their own: the leftmost of each row of an own figure; of others all."""
        if not self.is_new:
            return list(dict.fromkeys(self.axes))
        return [axes for axes in self.axes if axes.get_subplotspec().is_first_col()]  # type: ignore[union-attr]

    @property
    def figure(self) -> Figure:
        """The whole figure."""
        whole = self.axes[0].figure.figure  # of a subfigure the whole one
        assert isinstance(whole, Figure)
        return whole

    def legend(self, handles: Sequence[Any], columns: int = 4, labels: Sequence[str] | None = None) -> None:
        """Say what markers and lines are: above a figure of its own, inside axes that were given."""
        if not handles:
            return
        named: dict[str, Any] = {} if labels is None else {"labels": labels}
        if self.is_new:
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
        return Panels(list(grid[::-1]), shared=count == 1, is_new=True)
    return axes_of_caller(ax, count, owner)


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
        return Panels(grid[:count], shared=count == 1, is_new=True)
    place = axes_of_caller(ax, count, owner)
    if place.shared and count > 1:
        raise refusal(InvalidOption, "ax", owner, f"a list of {count} Axes", "one Axes")
    return place


def axes_of_caller(ax: Any, count: int, owner: str) -> Panels:
    """Return axes that a caller gave: one for all things, or one for each."""
    if isinstance(ax, Axes):
        return Panels([ax] * count, shared=True, is_new=False)
    listed = list(ax) if is_list(ax) else []
    if len(listed) != count or not all(isinstance(one, Axes) for one in listed):
        raise refusal(InvalidOption, "ax", owner, f"one Axes, or a list of {counted(count, 'Axes', 'Axes')}", brief(ax))
    return Panels(listed, shared=count == 1, is_new=False)


def single(ax: Axes | None, owner: str, *, size: tuple[float, float] = (6.4, 4.2)) -> Panels:
    """Return one Axes: the one that is given, or that of a new figure."""
    if ax is None:
        figure = Figure(figsize=size, layout="constrained")
        return Panels([figure.add_subplot()], shared=True, is_new=True)
    return axes_of_caller(ax, 1, owner)


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
