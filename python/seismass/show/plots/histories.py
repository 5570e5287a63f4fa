"""Histories of one run: quantities over time, events, energies and slip paths."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from seismass.base.arguments import is_one_of
from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_count, as_list, as_one_of, brief, is_list, refusal
from seismass.media.roles import GREY, INK, KINDS, PAPER, SLIDE, YIELDS
from seismass.media.style import RING, SERIES, Panels, drawing, grid_lines, panels, ring, say, single, zero_line
from seismass.model.scene import goods_names, spring_names
from seismass.runs.response import DEFAULT_POINTS, EVENT_KINDS, Response
from seismass.runs.simulate import simulate

MARKS: Final[dict[str, dict[str, Any]]] = {
    "yield": {"marker": "^", "color": YIELDS.colour, "markersize": 4.5},
    "unload": {"marker": "v", "color": YIELDS.colour, "markerfacecolor": PAPER, "markersize": 4.0},
    "reload": {"marker": ">", "color": YIELDS.colour, "markerfacecolor": PAPER, "markersize": 4.0},
    "close": {"marker": "D", "color": INK, "markersize": 3.5},
    "open": {"marker": "D", "color": INK, "markerfacecolor": PAPER, "markersize": 3.5},
    "slip": {"marker": "o", "color": SLIDE.colour, "markerfacecolor": PAPER, "markersize": 3.8},
    "stick": {"marker": "s", "color": SLIDE.colour, "markersize": 3.2},
    "reverse": {"marker": "x", "color": SLIDE.colour, "markersize": 4.0},
    "touch": {"marker": "+", "color": SLIDE.colour, "markersize": 4.5},
    "lift": {"marker": "2", "color": KINDS[0], "markersize": 6.0},
    "land": {"marker": "1", "color": KINDS[0], "markersize": 6.0},
    "wear": {"marker": "d", "color": INK, "markersize": 4.5},
    "touch_stop": {"marker": "p", "color": KINDS[0], "markersize": 4.5},
    "leave_stop": {"marker": "p", "color": KINDS[0], "markerfacecolor": PAPER, "markersize": 4.5},
}
"""How each kind of event is drawn; they differ in marker as well as in colour."""

STOREY_KINDS: Final = ("yield", "unload", "reload", "close", "open")
"""Kinds whose number is that of a storey or of a rack's level; that of the others is a block."""
ALL_BLOCKS: Final = ("lift", "land")
"""Kinds that happen to all blocks at once."""


def event_kinds(kinds: bool | Sequence[str], usual: tuple[str, ...], owner: str) -> tuple[str, ...]:
    """Return kinds of events: the usual ones for True, none for False, or those of a list."""
    if isinstance(kinds, bool):
        return usual if kinds else ()
    requirement = f"True, False or some of {', '.join(EVENT_KINDS)}"
    listed = (kinds,) if isinstance(kinds, str) else tuple(as_list(kinds, "events", owner, InvalidOption, requirement))
    for kind in listed:
        if not is_one_of(kind, EVENT_KINDS):
            raise refusal(InvalidOption, "events", owner, requirement, brief(kind))
    return listed


def event_times(response: Response, kind: str, number: int) -> FloatArray:
    """Return when a kind of event happened to a storey or block counted from 1; of all blocks to any of them."""
    log = response.event_log
    rows = log["kind"] == kind
    if not is_one_of(kind, ALL_BLOCKS):
        rows &= log["number"] == number
    times: FloatArray = log["time"][rows]
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


@drawing()
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
    as_one_of(response, Response, "response", "figure", InvalidOption)
    log = response.event_log
    blocks, rows = goods_names(response.scene), list(spring_names(response.scene))
    springs = len(rows)
    rows += [f"block {number}, {place}" for number, place in enumerate(blocks, start=1)]
    place = single(ax, "event timeline", size=(7.0, 1.3 + 0.32 * max(len(rows), 1)))
    axes = place.axes[0]
    kinds = []
    for kind in EVENT_KINDS:
        times = log["time"][log["kind"] == kind]
        first = 0 if kind in STOREY_KINDS else springs
        level = log["number"][log["kind"] == kind].astype(float) - 1.0 + first
        if kind in ALL_BLOCKS:
            level = np.tile(np.arange(springs, len(rows), dtype=float), len(times))
            times = np.repeat(times, len(blocks))
        if len(times):
            axes.plot(times, level, **MARKS[kind], linestyle="", markeredgewidth=0.8, zorder=3, gid=kind)
            kinds.append(kind)
    for number in range(1, len(blocks) + 1):
        spans = sliding_spans(response, number)
        if len(spans):
            widths = [(start, end - start) for start, end in spans]
            axes.broken_barh(widths, (springs + number - 1.28, 0.56), facecolor=SLIDE.colour, alpha=0.25, linewidth=0.0)
    for row in range(len(rows)):
        if not any(np.any(line.get_ydata() == row) for line in axes.lines):
            say(axes, "does not yield" if row < springs else "does not slide", at=row)
    axes.set_yticks(range(len(rows)), rows)
    axes.set_ylim(-0.6, max(len(rows), 1) - 0.4)
    axes.set_xlim(0.0, response.end_time or 1.0)
    axes.set_xlabel("time (s)")
    grid_lines(axes)
    place.legend(mark_handles(kinds), columns=6)
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


@drawing()
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
    as_one_of(response, Response, "response", "figure", InvalidOption)
    numbers_drawn = numbers(storeys, response.scene.storeys, "storeys", "drift figure")
    place = panels(ax, len(numbers_drawn), "drift figure")
    histories(
        place,
        response,
        numbers_drawn,
        lambda number: 1e3 * response.drift[:, number - 1],
        lambda number: (response.peak_drift_time[number - 1], 1e3 * response.peak_drift[number - 1]),
        event_kinds(events, ("yield", "close"), "drift figure"),
        ("drift (mm)", "storey {}".format, "does not drift"),
    )
    return place.figure


@drawing()
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
    as_one_of(response, Response, "response", "figure", InvalidOption)
    places = goods_names(response.scene)
    numbers_drawn = numbers(blocks, len(places), "blocks", "slip figure")
    place = panels(ax, len(numbers_drawn), "slip figure")
    histories(
        place,
        response,
        numbers_drawn,
        lambda number: 1e3 * response.slip[:, number - 1],
        lambda number: (response.peak_slip_time[number - 1], 1e3 * response.peak_slip[number - 1]),
        event_kinds(events, ("slip", "stick", "touch_stop"), "slip figure"),
        ("slip (mm)", lambda number: f"block {number}, {places[number - 1]}", "does not slide"),
    )
    if len(numbers_drawn) == 1 or not place.shared:
        for number, axes in zip(numbers_drawn, place.axes, strict=True):
            _stops(axes, response, number)
    return place.figure


@drawing()
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
    as_one_of(response, Response, "response", "figure", InvalidOption)
    numbers_drawn = numbers(floors, response.scene.storeys, "floors", "acceleration figure")
    place = panels(ax, len(numbers_drawn), "acceleration figure")
    histories(
        place,
        response,
        numbers_drawn,
        lambda number: response.floor_acceleration[:, number - 1] / STANDARD_GRAVITY,
        lambda number: (
            response.peak_floor_acceleration_time[number - 1],
            response.peak_floor_acceleration[number - 1] / STANDARD_GRAVITY,
        ),
        event_kinds(events, ("yield", "close"), "acceleration figure"),
        ("acceleration (g)", "floor {}".format, "is not accelerated"),
    )
    return place.figure


def numbers(value: int | Sequence[int] | None, count: int, parameter: str, owner: str) -> list[int]:
    """Return numbers counted from 1, all of them by default."""
    if count == 0:
        raise refusal(InvalidOption, parameter, owner, "in a scene that has any", "a scene without")
    if value is None:
        return list(range(1, count + 1))
    values: Any = value
    listed = list(values) if is_list(values) else [values]
    counts = [as_count(one, parameter, owner, InvalidOption, least=1) for one in listed]
    if not counts or max(counts) > count:
        raise refusal(InvalidOption, parameter, owner, f"numbers counted from 1 to {count}", brief(value))
    return counts


def _stops(axes: Axes, response: Response, block: int) -> None:
    """Draw where the stops of a block stand, as far as they are in reach of what is drawn."""
    stops = response.scene.goods[block - 1].stops
    for side, clearance in zip((-1.0, 1.0), (np.inf, np.inf) if stops is None else stops.clearance, strict=True):
        if clearance <= 2.0 * response.peak_slip[block - 1]:
            axes.axhline(side * 1e3 * clearance, color=KINDS[0], linestyle=(0, (6, 2)), linewidth=0.8, gid="stop")


def histories(
    place: Panels,
    response: Response,
    numbers_drawn: list[int],
    values_of: Callable[[int], FloatArray],
    peak_of: Callable[[int], tuple[float, float]],
    kinds: tuple[str, ...],
    labels: tuple[str, Callable[[int], str], str],
) -> None:
    """Draw a history of each number into its panel. `labels` are the unit, the name of a number, and the text where
    there is nothing but zero.
    """
    unit, called, nothing = labels
    time, drawn_kinds = response.time, set[str]()
    overlaid = place.shared and len(numbers_drawn) > 1
    lines, peaked, still = [], False, 0
    for position, (number, axes) in enumerate(zip(numbers_drawn, place.axes, strict=True)):
        values = values_of(number)
        look = SERIES[position % len(SERIES)] if overlaid else {"color": SLIDE.colour}
        name = called(number)
        lines += axes.plot(time, values, **look, linewidth=0.9, label=name)
        if response.has_events:
            for kind in kinds:
                if mark_events(axes, event_times(response, kind, number), kind, (time, values)):
                    drawn_kinds.add(kind)
        time_of_peak, peak = peak_of(number)
        if peak > 0.0 and np.isfinite(time_of_peak):
            peaked = True
            height = np.copysign(peak, np.interp(time_of_peak, time, np.nan_to_num(values)))
            axes.plot(time_of_peak, height, **RING, linestyle="", zorder=4, gid="peak")
        still += not peak > 0.0
        if not overlaid:
            text = f"{name}: peak {peak:.3g} {unit.partition('(')[2].rstrip(')')} at {time_of_peak:.2f} s"
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
    if still == len(numbers_drawn):
        place.axes[0].set_ylim(-1.0, 1.0)
        if overlaid:
            say(place.axes[0], nothing)
    place.axes[0].set_xlabel("time (s)")
    if not place.is_new and not place.shared:
        for axes in place.axes:
            axes.set_xlabel("time (s)")
    called_lines = [Line2D([], [], **SERIES[n % len(SERIES)], label=line.get_label()) for n, line in enumerate(lines)]
    handles = [*(called_lines if overlaid else []), *([ring("peak")] if peaked else [])]
    place.legend([*handles, *mark_handles([kind for kind in kinds if kind in drawn_kinds])])


_BANDS: Final = (
    ("viscous", KINDS[2], "///"),
    ("hysteretic", YIELDS.colour, ""),
    ("friction", SLIDE.colour, "\\\\\\\\"),
    ("contact", KINDS[0], "xxx"),
    ("elastic", GREY, ""),
    ("kinetic", INK, "+++"),
)


@drawing()
def energy(response: Response, *, points: int = DEFAULT_POINTS, ax: Axes | None = None) -> Figure:
    """Draw the energies of a run over time, relative to the moving ground, stacked; their sum is what came in.

    The energy at each time is that at the end of the same run up to there: as exact as `Response.energy`.

    Parameters
    ----------
    response : Response
        A run; it is solved again.
    points : int, default 200
        Number of times.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        There are fewer than two points, or `ax` is not an Axes.
    """
    as_one_of(response, Response, "response", "figure", InvalidOption)
    times, runs = _shortened(response, points, "energy figure", energy=True)
    stated = response.scene.building is None or response.scene.building.mass_is_stated
    scale, unit = (1e-3, "kJ") if stated else (1.0, "J for floors of 1 kg")
    values = {name: scale * np.array([run.energy[name] for run in runs]) for name in runs[0].energy}
    place = single(ax, "energy figure", size=(7.0, 3.8))
    axes = place.axes[0]
    floor, handles = np.zeros(len(times)), []
    for name, colour, hatch in _BANDS:
        if name in values and np.any(values[name] != 0.0):
            top = floor + values[name]
            axes.fill_between(times, floor, top, facecolor=colour, alpha=0.3, linewidth=0.0, gid=name)
            if hatch:
                # Apart from the fill, whose transparency a hatch in SVG would not have.
                axes.fill_between(times, floor, top, **_hatched(colour, hatch))
            handles.append((name, colour, hatch))
            floor = top
    total = values["initial"] + values["input"]
    axes.plot(times, total, color=INK, linewidth=1.4, label="input", gid="input")
    axes.axhline(0.0, color=GREY, linewidth=0.6)
    if not handles:
        say(axes, "no energy")
    axes.set_xlim(0.0, times[-1] or 1.0)
    axes.set_xlabel("time (s)")
    axes.set_ylabel(f"energy ({unit})")
    grid_lines(axes)
    names = [name for name, _, _ in handles] + ["input"]
    patches = [(Patch(facecolor=colour, alpha=0.3), Patch(**_hatched(colour, hatch))) for _, colour, hatch in handles]
    place.legend([*patches, axes.lines[0]], columns=6, labels=names)
    return place.figure


def _hatched(colour: str, hatch: str) -> dict[str, Any]:
    return {"facecolor": "none", "edgecolor": colour, "hatch": hatch, "linewidth": 0.0}


@drawing()
def slip_path(
    response: Response,
    *,
    blocks: int | Sequence[int] | None = None,
    points: int = DEFAULT_POINTS,
    ax: Axes | None = None,
) -> Figure:
    """Draw the path that blocks have slipped over time, which only grows.

    Parameters
    ----------
    response : Response
        A run; it is solved again, up to each of the times.
    blocks : int or sequence of int, optional
        Numbers of blocks, from 1; all by default.
    points : int, default 200
        Number of times.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        There is no such block, there are fewer than two points, or `ax` is not an Axes.
    """
    as_one_of(response, Response, "response", "figure", InvalidOption)
    places = goods_names(response.scene)
    numbers_drawn = numbers(blocks, len(places), "blocks", "figure of slip paths")
    times, runs = _shortened(response, points, "figure of slip paths", energy=False)
    paths = 1e3 * np.array([run.slip_path for run in runs])
    place = single(ax, "figure of slip paths", size=(7.0, 3.2))
    axes = place.axes[0]
    for position, number in enumerate(numbers_drawn):
        label = f"block {number}, {places[number - 1]}"
        axes.plot(times, paths[:, number - 1], **SERIES[position % len(SERIES)], linewidth=1.4, label=label)
    axes.set_xlim(0.0, times[-1] or 1.0)
    axes.set_ylim(0.0, None if paths.any() else 1.0)
    if not paths[:, [number - 1 for number in numbers_drawn]].any():
        say(axes, "nothing slides")
    axes.set_xlabel("time (s)")
    axes.set_ylabel("path slipped (mm)")
    grid_lines(axes)
    place.legend(axes.get_legend_handles_labels()[0])
    return place.figure


def _shortened(response: Response, points: int, owner: str, *, energy: bool) -> tuple[FloatArray, list[Response]]:
    """Return times from 0 to the end of a run, and the same run up to each of them."""
    count = as_count(points, "points", owner, InvalidOption, least=2)
    motion = response.motion
    samples = np.unique(np.linspace(0, round(response.end_time / motion.dt), count).astype(int))
    runs = [
        simulate(response.scene, motion, duration=float(sample * motion.dt), events=False, energy=energy)
        for sample in samples
    ]
    return np.array([run.end_time for run in runs]), runs
