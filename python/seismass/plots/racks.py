"""Racks of one run: drift of their levels over time, and peaks over their height with the slip of their goods."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.media.axes import columns, grid_lines, panels, say
from seismass.media.style import SERIES, STYLE
from seismass.model.places import floor_name, goods_levels, rack_levels, spring_names
from seismass.plots.histories import histories, numbers
from seismass.plots.timeline import chosen_kinds
from seismass.runs.response import Response


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
    owner, scene = "rack drift figure", response.scene
    wanted = numbers(racks, len(scene.racks), "racks", owner)
    places, names = rack_levels(scene), spring_names(scene)
    chosen = [scene.storeys + at for at, (rack, _) in enumerate(places, start=1) if rack in wanted]

    def place_of(number: int) -> tuple[int, int]:
        rack, level = places[number - scene.storeys - 1]
        return rack - 1, level - 1

    def history(number: int) -> FloatArray:
        rack, level = place_of(number)
        return 1e3 * response.rack_drift[rack][:, level]

    def peak(number: int) -> tuple[float, float]:
        rack, level = place_of(number)
        return response.peak_rack_drift_time[rack][level], 1e3 * response.peak_rack_drift[rack][level]

    kinds = chosen_kinds(events, ("yield", "close"), owner)
    with mpl.rc_context(STYLE):
        place = panels(ax, len(chosen), owner)
        labels = ("drift (mm)", lambda number: names[number - 1], "does not drift")
        histories(place, response, chosen, history, peak, kinds, labels)
    return place.figure


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
    owner, scene = "rack profile", response.scene
    chosen = numbers(racks, len(scene.racks), "racks", owner)
    building = scene.building
    stated = building is None or building.mass_is_stated
    force, unit = (1e3, "(kN)") if building is None or stated else (building.weight, "/ weight of the building")
    goods = [(place, slip) for place, slip in zip(goods_levels(scene), response.peak_slip, strict=True)]
    slides = any(rack in chosen for (rack, _), _ in goods)
    labels = ["peak drift (mm)", "peak acceleration (g)", f"peak spring force {unit}"]
    labels += ["peak slip (mm)"] if slides else []
    levels = max(scene.racks[rack - 1].levels for rack in chosen)
    with mpl.rc_context(STYLE):
        place = columns(ax, len(labels), owner, width=2.1, height=1.5 + 0.4 * min(max(levels, 3), 12))
        handles = []
        for position, rack in enumerate(chosen):
            look: dict[str, Any] = {**SERIES[position % len(SERIES)], "linewidth": 1.4}
            handles.append(Line2D([], [], **look, label=f"rack {rack}, {floor_name(scene.racks[rack - 1].floor)}"))
            at = np.arange(1, scene.racks[rack - 1].levels + 1)
            for axes, values in zip(
                place.axes,
                (
                    1e3 * response.peak_rack_drift[rack - 1],
                    response.peak_rack_acceleration[rack - 1] / STANDARD_GRAVITY,
                    response.peak_rack_shear[rack - 1] / force,
                ),
                strict=False,
            ):
                axes.plot(values, at, **look, marker="o", markersize=4.0)
            if slides:
                own = [(1e3 * slip, level) for (of, level), slip in goods if of == rack]
                unjoined = look | {"linestyle": "", "marker": "s", "markersize": 4.5}
                place.axes[3].plot([slip for slip, _ in own], [level for _, level in own], **unjoined)
        for axes, label in zip(place.axes, labels, strict=True):
            axes.set_xlim(0.0, 1.12 * max(axes.dataLim.x1, 0.0) or 1.0)
            if not axes.dataLim.x1 > 0.0:
                say(axes, "none")
            axes.set_ylim(0.5, levels + 0.5)
            axes.set_yticks(range(1, levels + 1) if levels <= 12 else range(1, levels + 1, levels // 6))
            axes.set_xlabel(label)
            axes.locator_params(axis="x", nbins=4)
            grid_lines(axes)
        for axes in place.axes if not place.own else place.axes[:1]:
            axes.set_ylabel("level")
        place.legend(handles)
    return place.figure
