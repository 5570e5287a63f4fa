"""Histories of one run: drift of storeys, slip of blocks, acceleration of floors, with peaks and events."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_count, brief, refusal
from seismass.media.axes import RING, Panels, grid_lines, panels, ring, say, zero_line
from seismass.media.roles import BLUE, INK, PURPLE
from seismass.media.style import SERIES, STYLE
from seismass.model.places import goods_names
from seismass.plots.timeline import chosen_kinds, event_times, mark_events, mark_handles
from seismass.runs.response import Response


def drift(
    response: Response,
    *,
    storeys: int | Sequence[int] | None = None,
    events: bool | Sequence[str] = True,
    ax: Axes | Sequence[Axes] | None = None,
) -> Figure:
    """Draw the drift of storeys over time, with their peaks in continuous time and their events.

    Parameters
    ----------
    response : Response
        A run with histories.
    storeys : int or sequence of int, optional
        Numbers of storeys, from 1; all by default.
    events : bool or sequence of str, default True
        Kinds of events to mark, of storeys; True: yield and close. None are where the run has no event log.
    ax : Axes or sequence of Axes, optional
        One Axes for all storeys, or one for each. By default a new figure with a panel for each, storey 1 lowest.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no histories, there is no such storey or kind of events, or `ax` does not fit the panels.
    """
    chosen = numbers(storeys, response.scene.storeys, "storeys", "drift figure")
    with mpl.rc_context(STYLE):
        place = panels(ax, len(chosen), "drift figure")
        histories(
            place,
            response,
            chosen,
            lambda number: 1e3 * response.drift[:, number - 1],
            lambda number: (response.peak_drift_time[number - 1], 1e3 * response.peak_drift[number - 1]),
            chosen_kinds(events, ("yield", "close"), "drift figure"),
            ("drift (mm)", "storey {}".format, "does not drift"),
        )
    return place.figure


def slip(
    response: Response,
    *,
    blocks: int | Sequence[int] | None = None,
    events: bool | Sequence[str] = True,
    ax: Axes | Sequence[Axes] | None = None,
) -> Figure:
    """Draw the slip of blocks over time, with their peaks in continuous time, their events and their stops.

    Parameters
    ----------
    response : Response
        A run with histories.
    blocks : int or sequence of int, optional
        Numbers of blocks, from 1; all by default.
    events : bool or sequence of str, default True
        Kinds of events to mark, of blocks; True: slip, stick and touch_stop. None are where the run has no event log.
    ax : Axes or sequence of Axes, optional
        One Axes for all blocks, or one for each. By default a new figure with a panel for each, block 1 lowest.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no histories, there is no such block or kind of events, or `ax` does not fit the panels.
    """
    places = goods_names(response.scene)
    chosen = numbers(blocks, len(places), "blocks", "slip figure")
    with mpl.rc_context(STYLE):
        place = panels(ax, len(chosen), "slip figure")
        histories(
            place,
            response,
            chosen,
            lambda number: 1e3 * response.slip[:, number - 1],
            lambda number: (response.peak_slip_time[number - 1], 1e3 * response.peak_slip[number - 1]),
            chosen_kinds(events, ("slip", "stick", "touch_stop"), "slip figure"),
            ("slip (mm)", lambda number: f"block {number}, {places[number - 1]}", "does not slide"),
        )
        if len(chosen) == 1 or not place.shared:
            for number, axes in zip(chosen, place.axes, strict=True):
                _stops(axes, response, number)
    return place.figure


def acceleration(
    response: Response,
    *,
    floors: int | Sequence[int] | None = None,
    events: bool | Sequence[str] = True,
    ax: Axes | Sequence[Axes] | None = None,
) -> Figure:
    """Draw the absolute acceleration of floors over time, with their peaks and the yielding of the storey below.

    Parameters
    ----------
    response : Response
        A run with histories, not of displacements only.
    floors : int or sequence of int, optional
        Numbers of floors, from 1; all by default.
    events : bool or sequence of str, default True
        Kinds of events to mark, of the storey below the floor; True: yield and close. None are where the run has no
        event log.
    ax : Axes or sequence of Axes, optional
        One Axes for all floors, or one for each. By default a new figure with a panel for each, floor 1 lowest.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no such histories, there is no such floor or kind of events, or `ax` does not fit the panels.
    """
    chosen = numbers(floors, response.scene.storeys, "floors", "acceleration figure")
    with mpl.rc_context(STYLE):
        place = panels(ax, len(chosen), "acceleration figure")
        histories(
            place,
            response,
            chosen,
            lambda number: response.floor_acceleration[:, number - 1] / STANDARD_GRAVITY,
            lambda number: (
                response.peak_floor_acceleration_time[number - 1],
                response.peak_floor_acceleration[number - 1] / STANDARD_GRAVITY,
            ),
            chosen_kinds(events, ("yield", "close"), "acceleration figure"),
            ("acceleration (g)", "floor {}".format, "is not accelerated"),
        )
    return place.figure


def numbers(given: int | Sequence[int] | None, count: int, parameter: str, owner: str) -> list[int]:
    """Return numbers counted from 1, all of them by default."""
    if count == 0:
        raise refusal(InvalidOption, parameter, owner, "in a scene that has any", "a scene without")
    if given is None:
        return list(range(1, count + 1))
    listed = list(given) if isinstance(given, Sequence | np.ndarray) and not isinstance(given, str) else [given]
    chosen = [as_count(one, parameter, owner, InvalidOption, least=1) for one in listed]
    if not chosen or max(chosen) > count:
        raise refusal(InvalidOption, parameter, owner, f"numbers counted from 1 to {count}", brief(given))
    return chosen


def _stops(axes: Axes, response: Response, block: int) -> None:
    """Draw where the stops of a block stand, as far as they are in reach of what is drawn."""
    stops = response.scene.goods[block - 1].stops
    for side, clearance in zip((-1.0, 1.0), (np.inf, np.inf) if stops is None else stops.clearance, strict=True):
        if clearance <= 2.0 * response.peak_slip[block - 1]:
            axes.axhline(side * 1e3 * clearance, color=PURPLE, linestyle=(0, (6, 2)), linewidth=0.8, gid="stop")


def histories(
    place: Panels,
    response: Response,
    chosen: list[int],
    values_of: Callable[[int], FloatArray],
    peak_of: Callable[[int], tuple[float, float]],
    kinds: tuple[str, ...],
    labels: tuple[str, Callable[[int], str], str],
) -> None:
    """Draw a history of each number into its panel. `labels` are the unit, the name of a number, and the text where
    there is nothing but zero.
    """
    unit, called, nothing = labels
    time, found = response.time, set[str]()
    overlaid = place.shared and len(chosen) > 1
    lines, peaked, still = [], False, 0
    for position, (number, axes) in enumerate(zip(chosen, place.axes, strict=True)):
        values = values_of(number)
        look = SERIES[position % len(SERIES)] if overlaid else {"color": BLUE}
        name = called(number)
        lines += axes.plot(time, values, **look, linewidth=0.9, label=name)
        if response.has_events:
            for kind in kinds:
                if mark_events(axes, event_times(response, kind, number), kind, (time, values)):
                    found.add(kind)
        at, peak = peak_of(number)
        if peak > 0.0 and np.isfinite(at):
            peaked = True
            height = np.copysign(peak, np.interp(at, time, np.nan_to_num(values)))
            axes.plot(at, height, **RING, linestyle="", zorder=4, gid="peak")
        still += not peak > 0.0
        if not overlaid:
            text = f"{name}: peak {peak:.3g} {unit.partition('(')[2].rstrip(')')} at {at:.2f} s"
            if not peak > 0.0:
                text = name
                say(axes, nothing)
            axes.set_title(text, loc="left", fontsize=8.0, pad=3.0)
    for axes in dict.fromkeys(place.axes):
        zero_line(axes)
        grid_lines(axes)
        axes.set_ylabel(unit)
        axes.set_xlim(0.0, response.end_time or 1.0)
        if response.status == "collapsed":
            axes.axvline(response.end_time, color=INK, linewidth=1.2)
    if still == len(chosen):
        place.axes[0].set_ylim(-1.0, 1.0)
        if overlaid:
            say(place.axes[0], nothing)
    place.axes[0].set_xlabel("time (s)")
    if not place.own and not place.shared:
        for axes in place.axes:
            axes.set_xlabel("time (s)")
    called_lines = [Line2D([], [], **SERIES[n % len(SERIES)], label=line.get_label()) for n, line in enumerate(lines)]
    handles = [*(called_lines if overlaid else []), *([ring("peak")] if peaked else [])]
    place.legend([*handles, *mark_handles([kind for kind in kinds if kind in found])])
