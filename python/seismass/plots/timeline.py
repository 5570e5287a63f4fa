"""Events of a run: how each kind is marked, where they lie on a history, and the timeline of all of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, brief, is_one_of, refusal
from seismass.media.axes import grid_lines, say, single
from seismass.media.roles import BLUE, GREEN, INK, PAPER, PURPLE, YIELDS
from seismass.media.style import STYLE
from seismass.model.places import goods_names, spring_names
from seismass.runs.response import EVENT_KINDS, Response

MARKS: Final[dict[str, dict[str, Any]]] = {
    "yield": {"marker": "^", "color": YIELDS.colour, "markersize": 4.5},
    "unload": {"marker": "v", "color": YIELDS.colour, "markerfacecolor": PAPER, "markersize": 4.0},
    "reload": {"marker": ">", "color": YIELDS.colour, "markerfacecolor": PAPER, "markersize": 4.0},
    "close": {"marker": "D", "color": INK, "markersize": 3.5},
    "open": {"marker": "D", "color": INK, "markerfacecolor": PAPER, "markersize": 3.5},
    "slip": {"marker": "o", "color": GREEN, "markerfacecolor": PAPER, "markersize": 3.8},
    "stick": {"marker": "s", "color": GREEN, "markersize": 3.2},
    "reverse": {"marker": "x", "color": BLUE, "markersize": 4.0},
    "touch": {"marker": "+", "color": BLUE, "markersize": 4.5},
    "lift": {"marker": "2", "color": PURPLE, "markersize": 6.0},
    "land": {"marker": "1", "color": PURPLE, "markersize": 6.0},
    "wear": {"marker": "d", "color": INK, "markersize": 4.5},
    "touch_stop": {"marker": "p", "color": PURPLE, "markersize": 4.5},
    "leave_stop": {"marker": "p", "color": PURPLE, "markerfacecolor": PAPER, "markersize": 4.5},
}
"""How each kind of event is drawn; they differ in marker as well as in colour."""

STOREY_KINDS: Final = ("yield", "unload", "reload", "close", "open")
"""Kinds whose number is that of a storey or of a rack's level; that of the others is a block."""
ALL_BLOCKS: Final = ("lift", "land")
"""Kinds that happen to all blocks at once."""


def chosen_kinds(kinds: bool | Sequence[str], usual: tuple[str, ...], owner: str) -> tuple[str, ...]:
    """Return kinds of events: the usual ones for True, none for False, or those of a list."""
    if isinstance(kinds, bool):
        return usual if kinds else ()
    listed = (kinds,) if isinstance(kinds, str) else tuple(kinds)
    for kind in listed:
        if not is_one_of(kind, EVENT_KINDS):
            raise refusal(
                InvalidOption, "events", owner, f"True, False or some of {', '.join(EVENT_KINDS)}", brief(kind)
            )
    return listed


def event_times(response: Response, kind: str, number: int) -> FloatArray:
    """Return when a kind of event happened to a storey or block counted from 1; of all blocks to any of them."""
    log = response.event_log
    chosen = log["kind"] == kind
    if not is_one_of(kind, ALL_BLOCKS):
        chosen &= log["number"] == number
    times: FloatArray = log["time"][chosen]
    return times


def mark_events(
    axes: Axes,
    times: FloatArray,
    kind: str,
    history: tuple[FloatArray, FloatArray],
    across: tuple[FloatArray, FloatArray] | None = None,
) -> bool:
    """Mark events on a history of times and values, against time or another history; return whether there are any."""
    if len(times):
        x = times if across is None else np.interp(times, *across)
        axes.plot(x, np.interp(times, *history), **MARKS[kind], linestyle="", markeredgewidth=0.8, zorder=3)
    return bool(len(times))


def mark_handles(kinds: Sequence[str]) -> list[Line2D]:
    """Return entries of a legend for kinds of events."""
    return [Line2D([], [], **MARKS[kind], linestyle="", markeredgewidth=0.8, label=kind) for kind in kinds]


def events(response: Response, *, ax: Axes | None = None) -> Figure:
    """Draw when each storey, level of a rack and block had its events: a row for each, a marker for each kind.

    Bars show how long blocks slid.

    Parameters
    ----------
    response : Response
        A run with its event log.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure.

    Raises
    ------
    InvalidOption
        The run has no event log, or `ax` is not an Axes.
    """
    log = response.event_log
    blocks, rows = goods_names(response.scene), list(spring_names(response.scene))
    springs = len(rows)
    rows += [f"block {number}, {place}" for number, place in enumerate(blocks, start=1)]
    with mpl.rc_context(STYLE):
        place = single(ax, "event timeline", size=(7.0, 1.3 + 0.32 * max(len(rows), 1)))
        axes = place.axes[0]
        found = []
        for kind in EVENT_KINDS:
            times = log["time"][log["kind"] == kind]
            first = 0 if kind in STOREY_KINDS else springs
            level = log["number"][log["kind"] == kind].astype(float) - 1.0 + first
            if kind in ALL_BLOCKS:
                level = np.tile(np.arange(springs, len(rows), dtype=float), len(times))
                times = np.repeat(times, len(blocks))
            if len(times):
                axes.plot(times, level, **MARKS[kind], linestyle="", markeredgewidth=0.8, zorder=3, gid=kind)
                found.append(kind)
        for number in range(1, len(blocks) + 1):
            spans = sliding_spans(response, number)
            if len(spans):
                widths = [(start, end - start) for start, end in spans]
                axes.broken_barh(widths, (springs + number - 1.28, 0.56), facecolor=GREEN, alpha=0.25, linewidth=0.0)
        for row in range(len(rows)):
            if not any(np.any(line.get_ydata() == row) for line in axes.lines):
                say(axes, "does not yield" if row < springs else "does not slide", at=row)
        axes.set_yticks(range(len(rows)), rows)
        axes.set_ylim(-0.6, max(len(rows), 1) - 0.4)
        axes.set_xlim(0.0, response.end_time or 1.0)
        axes.set_xlabel("time (s)")
        grid_lines(axes)
        place.legend(mark_handles(found), columns=6)
    return place.figure


def sliding_spans(response: Response, block: int) -> FloatArray:
    """Return from when to when (s) a block counted from 1 slid, by its events; shape (spans, 2). An airborne block
    counts as sliding from the slip before to the stick after.
    """
    starts, ends = event_times(response, "slip", block), event_times(response, "stick", block)
    if len(ends) and (not len(starts) or ends[0] < starts[0]):
        starts = np.append(0.0, starts)  # it slid at the start
    spans = [(start, next((end for end in ends if end >= start), response.end_time)) for start in starts]
    return np.array(spans).reshape(-1, 2)
