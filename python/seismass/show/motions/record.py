"""A record drawn: acceleration, velocity, displacement, and the build-up of its Arias intensity with D5-95."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, brief, refusal
from seismass.media.figure_file import CAPTION_CHARACTERS
from seismass.media.roles import BLUE, GREY, INK, VERMILION
from seismass.media.style import STYLE, plain
from seismass.records.intensity import build_up, time_of_share
from seismass.records.measures import drift_remarks

if TYPE_CHECKING:
    from seismass.records.record import Record

PANELS: Final = 4


def record_figure(
    record: Record, *, figure: Figure | SubFigure | None = None, axes: Sequence[Axes] | None = None
) -> Figure:
    """Return the figure of a record; arguments as in `Record.plot`. Peaks are those in continuous time; circles mark
    the largest of the samples, which are what is drawn.
    """
    if axes is not None and figure is not None:
        raise refusal(InvalidOption, "axes", "plot", "left out where a figure is given", brief(axes))
    with mpl.rc_context(STYLE):
        if axes is None:
            figure = figure or Figure(figsize=(7.0, 6.4), layout="constrained")
            panels: list[Axes] = list(figure.subplots(PANELS, 1, sharex=True))
        else:
            panels = list(axes)
            if len(panels) != PANELS or not all(isinstance(one, Axes) for one in panels):
                raise refusal(InvalidOption, "axes", "plot", f"{PANELS} Axes", brief(axes))
        _draw(record, panels)
    return panels[0].figure.figure  # of a subfigure the whole one


def _draw(record: Record, panels: list[Axes]) -> None:
    time = record.time
    built = build_up(record.acceleration, record.dt)
    histories: tuple[tuple[str, FloatArray, str], ...] = (
        ("acceleration (g)", record.acceleration / STANDARD_GRAVITY, f"PGA = {record.pga_g:.3f} g"),
        ("velocity (m/s)", record.velocity, f"PGV = {record.pgv:.3f} m/s"),
        ("displacement (m)", record.displacement, f"PGD = {record.pgd:.3f} m"),
    )
    for axes, (label, values, peak) in zip(panels, histories, strict=False):
        axes.plot(time, values, color=BLUE, linewidth=0.7)
        axes.axhline(0.0, color=GREY, linewidth=0.6)
        where = int(np.argmax(np.abs(values)))
        axes.plot(time[where], values[where], "o", markerfacecolor="none", color=INK, markersize=5.0)
        reach = 1.12 * float(np.max(np.abs(values))) or 1.0
        axes.set_ylim(-reach, reach)
        axes.set_ylabel(label)
        _note(axes, peak)
    _arias(record, panels[-1], built)
    for axes in panels:
        axes.set_xlim(0.0, max(record.duration, record.dt))
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    panels[-1].set_xlabel("time (s)")
    panels[0].figure.align_ylabels(panels)
    said = ", ".join(part for part in (record.event, record.station, record.component) if part)
    title = (record.name or "(unnamed)") + (", synthetic" if record.synthetic else "") + (f"  ({said})" if said else "")
    whole = panels[0].figure
    width = int(CAPTION_CHARACTERS * panels[0].get_position().width * whole.bbox.width / whole.dpi)
    lines = [plain(textwrap.fill(text, max(width, 20))) for text in (title, *drift_remarks(record))]
    # The last line is left to the peak.
    panels[0].set_title("\n".join([*lines, " "]), loc="left", fontsize=8.0, pad=3.0)


def _arias(record: Record, axes: Axes, built: FloatArray) -> None:
    axes.plot(record.time, built, color=BLUE, linewidth=1.2)
    bounds = [time_of_share(record.acceleration, record.dt, share) for share in (0.05, 0.95)]
    look: Any = {"color": VERMILION, "linestyle": (0, (4, 2)), "linewidth": 1.0}
    for at in bounds:
        axes.axvline(at, **look)
    axes.axvspan(*bounds, color=VERMILION, alpha=0.08, linewidth=0.0)
    axes.set_ylim(0.0, 1.08 * record.arias or 1.0)
    axes.set_ylabel("Arias (m/s)")
    _note(axes, f"Arias = {record.arias:.3f} m/s, D5-95 = {bounds[1] - bounds[0]:.2f} s (dashed)")


def _note(axes: Axes, text: str) -> None:
    """A measure above the end of a panel, where nothing is drawn."""
    axes.set_title(text, loc="right", fontsize=8.0, pad=3.0)
