"""Loops of springs, pushover curves, contacts and racks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_one_of, brief, refusal
from seismass.design import Pushover
from seismass.media.roles import GREY, INK, KINDS, LIMIT, PAPER, SLIDE, YIELDS
from seismass.media.style import SERIES, columns, drawing, grid_lines, panels, say, single, zero_line
from seismass.model.building import Building
from seismass.model.scene import floor_name, goods_levels, goods_names, rack_levels, spring_names
from seismass.runs.response import Response
from seismass.show.plots.histories import MARKS, event_kinds, event_times, histories, mark_events, mark_handles, numbers

BACKBONE_POINTS: Final = 121
"""Drifts to one side at which a backbone is computed, beside its corners."""

_ROW: Final = 4
"""Most storeys beside one another."""
_BACKBONE: Final[dict[str, Any]] = {**LIMIT.look, "linewidth": 1.3}


@drawing()
def loops(
    response: Response,
    *,
    storeys: int | Sequence[int] | None = None,
    events: bool | Sequence[str] = False,
    ax: Axes | Sequence[Axes] | None = None,
) -> Figure:
    """Draw spring force against drift of storeys, over the backbone of each.

    The backbone is the force of the virgin spring that is pushed slowly one way, to the largest drift drawn. Forces are
    in kN where the mass of the building is stated, otherwise over its weight.

    Parameters
    ----------
    response : Response
        A run with histories, not of displacements only.
    storeys : int or sequence of int, optional
        Numbers of storeys, from 1; all by default.
    events : bool or sequence of str, default False
        Kinds of events to mark, of storeys; True: yield, unload, reload, close and open.
    ax : Axes or sequence of Axes, optional
        One Axes for each storey.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no such histories, there is no such storey or kind of events, or `ax` does not fit the panels.
    """
    as_one_of(response, Response, "response", "figure", InvalidOption)
    owner = "figure of loops"
    numbers_drawn = numbers(storeys, response.scene.storeys, "storeys", owner)
    kinds = event_kinds(events, ("yield", "unload", "reload", "close", "open"), owner)
    building = response.scene.building
    assert building is not None
    scale, unit = (1e-3, "kN") if building.mass_is_stated else (1.0 / building.weight, "V/W")
    forces, drawn_kinds = scale * response.storey_shear, set[str]()
    place = columns(ax, len(numbers_drawn), owner, width=2.6, height=3.2, most=_ROW)
    for number, axes in zip(numbers_drawn, place.axes, strict=True):
        drift, force = 1e3 * response.drift[:, number - 1], forces[:, number - 1]
        if response.peak_drift[number - 1] > 0.0:
            way, strength = backbone(building, number, float(response.peak_drift[number - 1]))
            axes.plot(1e3 * way, scale * strength, **_BACKBONE, gid="backbone")
        else:
            say(axes, "does not drift")
        axes.plot(drift, force, color=SLIDE.colour, linewidth=0.7, gid="loop")
        if response.has_events:
            for kind in kinds:
                times = event_times(response, kind, number)
                if mark_events(axes, times, kind, (response.time, force), (response.time, drift)):
                    drawn_kinds.add(kind)
        for line in (axes.axhline, axes.axvline):
            line(0.0, color=GREY, linewidth=0.6)
        grid_lines(axes)
        axes.locator_params(axis="x", nbins=5)
        axes.set_title(f"storey {number}")
        axes.set_xlabel("drift (mm)")
    for axes in place.left:
        axes.set_ylabel(f"spring force ({unit})" if unit == "kN" else "spring force / weight")
    handles = [
        Line2D([], [], color=SLIDE.colour, linewidth=0.9, label="run"),
        Line2D([], [], **_BACKBONE, label="backbone"),
    ]
    place.legend([*handles, *mark_handles([kind for kind in kinds if kind in drawn_kinds])], columns=4)
    return place.figure


def backbone(building: Building, storey: int, reach: float) -> tuple[FloatArray, FloatArray]:
    """Return drifts (m) from -reach to reach and the forces (N) of the virgin spring that is pushed to each."""
    if not reach > 0.0:
        raise refusal(InvalidOption, "drift", "backbone", "positive: the storey has to move", f"{reach:g}")
    kernel = building._kernel
    corners = np.abs(kernel.spring_path(storey - 1, np.array([reach])).event_drift)
    way = np.unique(np.concatenate([np.linspace(0.0, reach, BACKBONE_POINTS), corners]))
    back, forth = (kernel.spring_path(storey - 1, sign * way).force for sign in (-1.0, 1.0))
    return np.concatenate([-way[:0:-1], way]), np.concatenate([back[:0:-1], forth])


_MARKS: Final[dict[str, dict[str, Any]]] = {
    "yield": {"marker": "o", "markersize": 5.5, "markerfacecolor": PAPER, "color": INK},
    "close": {"marker": "s", "markersize": 5.5, "markerfacecolor": PAPER, "color": INK},
    "open": {"marker": "s", "markersize": 5.5, "markerfacecolor": INK, "color": INK},
    "capacity": {"marker": "D", "markersize": 6.5, "markerfacecolor": YIELDS.colour, "color": YIELDS.colour},
    "drift limit": {"marker": LIMIT.marker, "markersize": 11.0, "color": LIMIT.colour},
    "no strength left": {"marker": "X", "markersize": 7.5, "color": YIELDS.colour},
    "unstable unloading": {"marker": "X", "markersize": 7.5, "color": YIELDS.colour},
}
_NAMES: Final = {"yield": "corner of a spring", "close": "stop closes", "open": "stop opens", "capacity": "mechanism"}


@drawing()
def pushover(path: Pushover, *, labels: bool = True, ax: Axes | None = None) -> Figure:
    """Draw the base shear over the weight against the roof displacement, with events by their storey.

    Parameters
    ----------
    path : Pushover
        The path.
    labels : bool, default True
        Number the storeys beside their events.
    ax : Axes, optional
        Axes to draw into; by default a new figure. Several paths may share one.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        `ax` is not an Axes.
    """
    as_one_of(path, Pushover, "path", "pushover figure", InvalidOption)
    place = single(ax, "pushover figure")
    axes = place.axes[0]
    roof, shear = 1e3 * path.roof_displacement, path.base_shear / path.weight
    axes.plot(roof, shear, color=SLIDE.colour if place.is_new else None, linewidth=1.6)
    events = path.events
    for kind, mark in _MARKS.items():
        rows = events.filter(kind=kind)
        axes.plot(1e3 * rows["roof_displacement"], rows["base_shear"] / path.weight, **mark, linestyle="", zorder=3)
    if labels:
        _label(axes, events, roof, shear)
    axes.set_xlabel("roof displacement (mm)")
    axes.set_ylabel("base shear over weight")
    grid_lines(axes)
    met = [kind for kind in _MARKS if kind in set(events["kind"])]
    handles = [Line2D([], [], **_MARKS[kind], linestyle="", label=_NAMES.get(kind, kind)) for kind in met]
    if place.is_new and labels:
        axes.set_title("numbers: storeys", loc="right", fontsize=7.5, color=INK)
    place.legend(handles, columns=min(len(handles), 4))
    return place.figure


def _label(axes: Axes, events: pl.DataFrame, roof: FloatArray, shear: FloatArray) -> None:
    """Number the storeys of events; those of points that are close together have one label, in their order."""
    reach = (0.08 * float(roof.max()), 0.06 * float(shear.max()))
    groups: list[tuple[int, list[int]]] = []
    for point, storey in events.select("point", "storey").iter_rows():
        if groups:
            last, storeys = groups[-1]
            if abs(roof[point] - roof[last]) < reach[0] and abs(shear[point] - shear[last]) < reach[1]:
                groups[-1] = (point, storeys if storey in storeys else [*storeys, storey])
                continue
        groups.append((point, [storey]))
    for point, storeys in groups:
        falls = point + 1 < len(shear) and shear[point + 1] <= shear[point]
        axes.annotate(
            ", ".join(map(str, storeys)),
            (float(roof[point]), float(shear[point])),
            xytext=(5.0, 5.0 if falls else -12.0),
            textcoords="offset points",
            fontsize=7.5,
            color=INK,
        )


@drawing()
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
    as_one_of(response, Response, "response", "figure", InvalidOption)
    owner, goods = "figure of contacts", response.scene.goods
    stopped = [number for number, block in enumerate(goods, start=1) if block.stops is not None]
    if not stopped:
        raise refusal(InvalidOption, "response", owner, "that of a scene in which a block has stops", "one without")
    numbers_drawn = stopped if blocks is None else numbers(blocks, len(goods), "blocks", owner)
    for number in numbers_drawn:
        if number not in stopped:
            raise refusal(InvalidOption, "blocks", owner, f"some of {', '.join(map(str, stopped))}", brief(number))
    log, places = response.event_log, goods_names(response.scene)
    velocities = response.events["velocity"].to_numpy()
    place = panels(ax, len(numbers_drawn), owner)
    for number, axes in zip(numbers_drawn, place.axes, strict=True):
        is_contact = (log["kind"] == "touch_stop") & (log["number"] == number)
        signed = log["sign"][is_contact] * np.abs(velocities[is_contact])
        axes.vlines(log["time"][is_contact], 0.0, signed, color=KINDS[0], linewidth=1.0, gid="contacts")
        axes.plot(log["time"][is_contact], signed, **MARKS["touch_stop"], linestyle="")
        count = int(is_contact.sum())
        caption = f"block {number}, {places[number - 1]}: "
        if count:
            force = response.peak_contact_force[number - 1]
            caption += f"{count} contacts, at most {response.peak_contact_velocity[number - 1]:.3g} m/s and "
            caption += f"{1e-3 * force:.3g} kN"
        else:
            caption += "no contact"
        axes.set_title(caption, loc="left", fontsize=8.0, pad=3.0)
    for axes in dict.fromkeys(place.axes):
        zero_line(axes)
        grid_lines(axes)
        axes.set_ylabel("velocity (m/s)")
        axes.set_xlim(0.0, response.end_time or 1.0)
        reach = 1.15 * max(abs(axes.dataLim.y0), abs(axes.dataLim.y1)) if np.isfinite(axes.dataLim.y0) else 0.0
        axes.set_ylim(-(reach or 1.0), reach or 1.0)
        if response.status == "collapsed":
            axes.axvline(response.end_time, color=INK, linewidth=1.2)
    for axes in place.axes[:1] if place.is_new else place.axes:
        axes.set_xlabel("time (s)")
    return place.figure


@drawing()
def rack_drift(
    response: Response,
    *,
    racks: int | Sequence[int] | None = None,
    events: bool | Sequence[str] = True,
    ax: Axes | Sequence[Axes] | None = None,
) -> Figure:
    """Draw the drift of the levels of racks over time, with their peaks in continuous time and their events.

    The drift of a level is that relative to the level below, of the lowest one relative to the rack's floor.

    Parameters
    ----------
    response : Response
        A run with histories.
    racks : int or sequence of int, optional
        Numbers of racks, from 1; all by default.
    events : bool or sequence of str, default True
        Kinds of events to mark, of levels; True: yield and close. None are where the run has no event log.
    ax : Axes or sequence of Axes, optional
        One Axes for all levels, or one for each. By default a new figure with a panel for each, the lowest below.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no histories, there is no such rack or kind of events, or `ax` does not fit the panels.
    """
    as_one_of(response, Response, "response", "figure", InvalidOption)
    owner, scene = "rack drift figure", response.scene
    wanted = numbers(racks, len(scene.racks), "racks", owner)
    places, names = rack_levels(scene), spring_names(scene)
    numbers_drawn = [scene.storeys + position for position, (rack, _) in enumerate(places, start=1) if rack in wanted]

    def place_of(number: int) -> tuple[int, int]:
        rack, level = places[number - scene.storeys - 1]
        return rack - 1, level - 1

    def history(number: int) -> FloatArray:
        rack, level = place_of(number)
        return 1e3 * response.rack_drift[rack][:, level]

    def peak(number: int) -> tuple[float, float]:
        rack, level = place_of(number)
        return response.peak_rack_drift_time[rack][level], 1e3 * response.peak_rack_drift[rack][level]

    kinds = event_kinds(events, ("yield", "close"), owner)
    place = panels(ax, len(numbers_drawn), owner)
    labels = ("drift (mm)", lambda number: names[number - 1], "does not drift")
    histories(place, response, numbers_drawn, history, peak, kinds, labels)
    return place.figure


@drawing()
def rack_profile(
    response: Response, *, racks: int | Sequence[int] | None = None, ax: Sequence[Axes] | None = None
) -> Figure:
    """Draw the peaks of racks over their levels: drift, acceleration, spring force, and slip of their goods.

    Parameters
    ----------
    response : Response
        A run.
    racks : int or sequence of int, optional
        Numbers of racks, from 1; all by default.
    ax : sequence of Axes, optional
        Four Axes, or three where the racks have no goods that may slide.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        There is no such rack, or `ax` does not fit the panels.
    """
    as_one_of(response, Response, "response", "figure", InvalidOption)
    owner, scene = "rack profile", response.scene
    numbers_drawn = numbers(racks, len(scene.racks), "racks", owner)
    building = scene.building
    stated = building is None or building.mass_is_stated
    force, unit = (1e3, "(kN)") if building is None or stated else (building.weight, "/ weight of the building")
    slips = [(place, slip) for place, slip in zip(goods_levels(scene), response.peak_slip, strict=True)]
    slides = any(rack in numbers_drawn for (rack, _), _ in slips)
    labels = ["peak drift (mm)", "peak acceleration (g)", f"peak spring force {unit}"]
    labels += ["peak slip (mm)"] if slides else []
    levels = max(scene.racks[rack - 1].levels for rack in numbers_drawn)
    place = columns(ax, len(labels), owner, width=2.1, height=1.5 + 0.4 * min(max(levels, 3), 12))
    handles = []
    for position, rack in enumerate(numbers_drawn):
        look: dict[str, Any] = {**SERIES[position % len(SERIES)], "linewidth": 1.4}
        handles.append(Line2D([], [], **look, label=f"rack {rack}, {floor_name(scene.racks[rack - 1].floor)}"))
        level_numbers = np.arange(1, scene.racks[rack - 1].levels + 1)
        for axes, values in zip(
            place.axes,
            (
                1e3 * response.peak_rack_drift[rack - 1],
                response.peak_rack_acceleration[rack - 1] / STANDARD_GRAVITY,
                response.peak_rack_shear[rack - 1] / force,
            ),
            strict=False,
        ):
            axes.plot(values, level_numbers, **look, marker="o", markersize=4.0)
        if slides:
            points = [(1e3 * slip, level) for (rack_of_level, level), slip in slips if rack_of_level == rack]
            unjoined = look | {"linestyle": "", "marker": "s", "markersize": 4.5}
            place.axes[3].plot([slip for slip, _ in points], [level for _, level in points], **unjoined)
    for axes, label in zip(place.axes, labels, strict=True):
        axes.set_xlim(0.0, 1.12 * max(axes.dataLim.x1, 0.0) or 1.0)
        if not axes.dataLim.x1 > 0.0:
            say(axes, "none")
        axes.set_ylim(0.5, levels + 0.5)
        axes.set_yticks(range(1, levels + 1) if levels <= 12 else range(1, levels + 1, levels // 6))
        axes.set_xlabel(label)
        axes.locator_params(axis="x", nbins=4)
        grid_lines(axes)
    for axes in place.axes if not place.is_new else place.axes[:1]:
        axes.set_ylabel("level")
    place.legend(handles)
    return place.figure
