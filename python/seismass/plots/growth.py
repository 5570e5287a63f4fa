"""What grows over a run: its energies, and the paths that its blocks slip."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_count
from seismass.media.axes import grid_lines, say, single
from seismass.media.roles import BLUE, GREEN, GREY, INK, PURPLE, VERMILION
from seismass.media.style import SERIES, STYLE
from seismass.model.places import goods_names
from seismass.plots.histories import numbers
from seismass.runs.response import Response
from seismass.runs.response_views import DEFAULT_POINTS
from seismass.runs.simulate import simulate

_BANDS: Final = (
    ("viscous", BLUE, "///"),
    ("hysteretic", VERMILION, ""),
    ("friction", GREEN, "\\\\\\\\"),
    ("contact", PURPLE, "xxx"),
    ("elastic", GREY, ""),
    ("kinetic", INK, "+++"),
)


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
    times, runs = _shortened(response, points, "energy figure", energy=True)
    stated = response.scene.building is None or response.scene.building.mass_is_stated
    scale, unit = (1e-3, "kJ") if stated else (1.0, "J for floors of 1 kg")
    values = {name: scale * np.array([run.energy[name] for run in runs]) for name in runs[0].energy}
    with mpl.rc_context(STYLE):
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
        patches = [
            (Patch(facecolor=colour, alpha=0.3), Patch(**_hatched(colour, hatch))) for _, colour, hatch in handles
        ]
        place.legend([*patches, axes.lines[0]], columns=6, labels=names)
    return place.figure


def _hatched(colour: str, hatch: str) -> dict[str, Any]:
    return {"facecolor": "none", "edgecolor": colour, "hatch": hatch, "linewidth": 0.0}


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
    places = goods_names(response.scene)
    chosen = numbers(blocks, len(places), "blocks", "figure of slip paths")
    times, runs = _shortened(response, points, "figure of slip paths", energy=False)
    paths = 1e3 * np.array([run.slip_path for run in runs])
    with mpl.rc_context(STYLE):
        place = single(ax, "figure of slip paths", size=(7.0, 3.2))
        axes = place.axes[0]
        for position, number in enumerate(chosen):
            label = f"block {number}, {places[number - 1]}"
            axes.plot(times, paths[:, number - 1], **SERIES[position % len(SERIES)], linewidth=1.4, label=label)
        axes.set_xlim(0.0, times[-1] or 1.0)
        axes.set_ylim(0.0, None if paths.any() else 1.0)
        if not paths[:, [number - 1 for number in chosen]].any():
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
