"""Contacts of goods with their stops over a run: when, on which side, and how fast, which is what damages them."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, refusal
from seismass.media.axes import grid_lines, panels, zero_line
from seismass.media.roles import INK, PURPLE
from seismass.media.style import STYLE
from seismass.model.places import goods_names
from seismass.plots.histories import numbers
from seismass.plots.timeline import MARKS
from seismass.runs.response import Response


def contacts(
    response: Response, *, blocks: int | Sequence[int] | None = None, ax: Axes | Sequence[Axes] | None = None
) -> Figure:
    """Draw the velocity with which blocks come to their stops, up where the stop is on the side of plus.

    Titles say how often a block came to its stops, how fast, and its largest contact force.

    Parameters
    ----------
    response : Response
        A run with its event log.
    blocks : int or sequence of int, optional
        Numbers of blocks with stops, from 1; all of them by default.
    ax : Axes or sequence of Axes, optional
        One Axes for each block. By default a new figure with a panel for each, the first lowest.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no event log, no block has stops or one that is named has none, or `ax` does not fit the panels.
    """
    owner, goods = "figure of contacts", response.scene.goods
    stopped = [number for number, block in enumerate(goods, start=1) if block.stops is not None]
    if not stopped:
        raise refusal(InvalidOption, "response", owner, "that of a scene in which a block has stops", "one without")
    chosen = stopped if blocks is None else numbers(blocks, len(goods), "blocks", owner)
    for number in chosen:
        if number not in stopped:
            raise refusal(InvalidOption, "blocks", owner, f"some of {', '.join(map(str, stopped))}", brief(number))
    log, places = response.event_log, goods_names(response.scene)
    velocities = response.events["velocity"].to_numpy()
    with mpl.rc_context(STYLE):
        place = panels(ax, len(chosen), owner)
        for number, axes in zip(chosen, place.axes, strict=True):
            of = (log["kind"] == "touch_stop") & (log["number"] == number)
            signed = log["sign"][of] * np.abs(velocities[of])
            axes.vlines(log["time"][of], 0.0, signed, color=PURPLE, linewidth=1.0, gid="contacts")
            axes.plot(log["time"][of], signed, **MARKS["touch_stop"], linestyle="")
            count = int(of.sum())
            said = f"block {number}, {places[number - 1]}: "
            if count:
                force = response.peak_contact_force[number - 1]
                said += f"{count} contacts, at most {response.peak_contact_velocity[number - 1]:.3g} m/s and "
                said += f"{1e-3 * force:.3g} kN"
            else:
                said += "no contact"
            axes.set_title(said, loc="left", fontsize=8.0, pad=3.0)
        for axes in dict.fromkeys(place.axes):
            zero_line(axes)
            grid_lines(axes)
            axes.set_ylabel("velocity (m/s)")
            axes.set_xlim(0.0, response.end_time or 1.0)
            reach = 1.15 * max(abs(axes.dataLim.y0), abs(axes.dataLim.y1)) if np.isfinite(axes.dataLim.y0) else 0.0
            axes.set_ylim(-(reach or 1.0), reach or 1.0)
            if response.status == "collapsed":
                axes.axvline(response.end_time, color=INK, linewidth=1.2)
        for axes in place.axes[:1] if place.own else place.axes:
            axes.set_xlabel("time (s)")
    return place.figure
