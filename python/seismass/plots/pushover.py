"""Pushover drawn: base shear over roof displacement, with the corners of the storeys and what ends the path."""

from __future__ import annotations

from typing import Any, Final

import matplotlib as mpl
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.values import FloatArray
from seismass.design import Pushover
from seismass.media.axes import grid_lines, single
from seismass.media.roles import BLUE, INK, LIMIT, VERMILION
from seismass.media.style import STYLE

_MARKS: Final[dict[str, dict[str, Any]]] = {
    "yield": {"marker": "o", "markersize": 5.5, "markerfacecolor": "white", "color": INK},
    "close": {"marker": "s", "markersize": 5.5, "markerfacecolor": "white", "color": INK},
    "open": {"marker": "s", "markersize": 5.5, "markerfacecolor": INK, "color": INK},
    "capacity": {"marker": "D", "markersize": 6.5, "markerfacecolor": VERMILION, "color": VERMILION},
    "drift limit": {"marker": LIMIT.marker, "markersize": 11.0, "color": LIMIT.colour},
    "no strength left": {"marker": "X", "markersize": 7.5, "color": VERMILION},
    "unstable unloading": {"marker": "X", "markersize": 7.5, "color": VERMILION},
}
_NAMES: Final = {"yield": "corner of a spring", "close": "stop closes", "open": "stop opens", "capacity": "mechanism"}


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
    with mpl.rc_context(STYLE):
        place = single(ax, "pushover figure")
        axes = place.axes[0]
        roof, shear = 1e3 * path.roof_displacement, path.base_shear / path.weight
        axes.plot(roof, shear, color=BLUE if place.own else None, linewidth=1.6)
        events = path.events
        for kind, mark in _MARKS.items():
            of = events.filter(kind=kind)
            axes.plot(1e3 * of["roof_displacement"], of["base_shear"] / path.weight, **mark, linestyle="", zorder=3)
        if labels:
            _label(axes, events, roof, shear)
        axes.set_xlabel("roof displacement (mm)")
        axes.set_ylabel("base shear over weight")
        grid_lines(axes)
        met = [kind for kind in _MARKS if kind in set(events["kind"])]
        handles = [Line2D([], [], **_MARKS[kind], linestyle="", label=_NAMES.get(kind, kind)) for kind in met]
        if place.own and labels:
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
