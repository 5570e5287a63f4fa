"""Hysteresis loops of storeys over their backbones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, refusal
from seismass.media.axes import columns, grid_lines, say
from seismass.media.roles import BLUE, GREY, VERMILION
from seismass.media.style import STYLE
from seismass.model.building import Building
from seismass.plots.histories import numbers
from seismass.plots.timeline import chosen_kinds, event_times, mark_events, mark_handles
from seismass.runs.response import Response

BACKBONE_POINTS: Final = 121
"""Drifts to one side at which a backbone is computed, beside its corners."""

_ROW: Final = 4
"""Most storeys beside one another."""
_BACKBONE: Final[dict[str, Any]] = {"color": VERMILION, "linestyle": (0, (5, 2)), "linewidth": 1.3}


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
    owner = "figure of loops"
    chosen = numbers(storeys, response.scene.storeys, "storeys", owner)
    kinds = chosen_kinds(events, ("yield", "unload", "reload", "close", "open"), owner)
    building = response.scene.building
    assert building is not None
    scale, unit = (1e-3, "kN") if building.mass_is_stated else (1.0 / building.weight, "V/W")
    forces, found = scale * response.storey_force, set[str]()
    with mpl.rc_context(STYLE):
        place = columns(ax, len(chosen), owner, width=2.6, height=3.2, most=_ROW)
        for number, axes in zip(chosen, place.axes, strict=True):
            drift, force = 1e3 * response.drift[:, number - 1], forces[:, number - 1]
            if response.peak_drift[number - 1] > 0.0:
                way, strength = backbone(building, number, float(response.peak_drift[number - 1]))
                axes.plot(1e3 * way, scale * strength, **_BACKBONE, gid="backbone")
            else:
                say(axes, "does not drift")
            axes.plot(drift, force, color=BLUE, linewidth=0.7, gid="loop")
            if response.has_events:
                for kind in kinds:
                    times = event_times(response, kind, number)
                    if mark_events(axes, times, kind, (response.time, force), (response.time, drift)):
                        found.add(kind)
            for line in (axes.axhline, axes.axvline):
                line(0.0, color=GREY, linewidth=0.6)
            grid_lines(axes)
            axes.locator_params(axis="x", nbins=5)
            axes.set_title(f"storey {number}")
            axes.set_xlabel("drift (mm)")
        for axes in place.left:
            axes.set_ylabel(f"spring force ({unit})" if unit == "kN" else "spring force / weight")
        handles = [
            Line2D([], [], color=BLUE, linewidth=0.9, label="run"),
            Line2D([], [], **_BACKBONE, label="backbone"),
        ]
        place.legend([*handles, *mark_handles([kind for kind in kinds if kind in found])], columns=4)
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
