"""Where a figure is drawn: into a new figure, or into axes that are given; and what all panels have."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, counted, refusal
from seismass.media.roles import GREY, INK, PAPER


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
