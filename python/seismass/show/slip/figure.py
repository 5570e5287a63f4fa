"""Figure of a slip demand: slip by block in the building and on the ground, against floor acceleration, fragilities."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.media.axes import grid_lines, say
from seismass.media.figure_file import CAPTION_CHARACTERS
from seismass.media.result import named_figure
from seismass.media.roles import GREY, INK, LIMIT, MU, SLIDE
from seismass.media.style import SERIES, STYLE, plain

if TYPE_CHECKING:
    from seismass.slip.result import SlipDemand

_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_HEIGHT = 4.6


def slip_demand_figure(result: SlipDemand, name: str | None = None) -> Figure:
    """Return `SlipDemand.plot`."""
    named_figure(result, name)
    rows = 2 if result.fragilities else 1
    width = 8.4
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(width, _HEIGHT * (0.85 * rows + 0.15)), layout="constrained")
        axes = figure.subplots(rows, 2, squeeze=False).ravel()
        _by_block(axes[0], result)
        _against_acceleration(axes[1], result)
        if result.fragilities:
            _fragilities(axes[2], result)
        handles = [
            Line2D(
                [],
                [],
                color=SLIDE.colour,
                marker=SLIDE.marker,
                linestyle="",
                markersize=5.0,
                label="in the building, each motion",
            ),
            Line2D(
                [],
                [],
                color=GREY,
                marker="o",
                markerfacecolor="white",
                linestyle="",
                markersize=5.0,
                label="the same block on the ground",
            ),
            Line2D(
                [], [], color=INK, marker="D", linewidth=1.6, markersize=5.0, label="mean, 16 to 84 % of the motions"
            ),
        ]
        if result.exceedance.height:
            handles.append(Line2D([], [], color=LIMIT.colour, linestyle=LIMIT.line, linewidth=1.2, label="clearance"))
        if result.fragilities:
            axes[3].set_axis_off()
            axes[3].legend(handles=handles, loc="center", frameon=False)
        else:
            figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False)
        figure.supxlabel(textwrap.fill(_caption(result), int(CAPTION_CHARACTERS * width)), fontsize=7.5)
    return figure


def _by_block(axes: Axes, result: SlipDemand) -> None:
    """Slip of every motion by block, in the building and beside it on the ground."""
    labels = []
    for place, row in enumerate(result.blocks.iter_rows(named=True)):
        own = result.runs.filter(block=row["block"], collapsed=False)
        lost = result.runs.filter(block=row["block"], collapsed=True).height
        for column, offset, colour, fill in (
            ("peak_slip", 0.14, SLIDE.colour, SLIDE.colour),
            ("ground_slip", -0.14, GREY, "white"),
        ):
            values = 1e3 * own[column].to_numpy()
            axes.plot(
                values,
                np.full(len(values), place + offset),
                color=colour,
                marker="o",
                markerfacecolor=fill,
                markersize=4.5,
                linestyle="",
                alpha=0.8,
            )
        for prefix, offset in (("", 0.14), ("ground_", -0.14)):
            low, mean, high = (row[prefix + name] for name in ("p16", "mean", "p84"))
            if np.isfinite([low, mean, high]).all():
                axes.hlines(place + offset, 1e3 * low, 1e3 * high, color=INK, linewidth=1.6)
                axes.plot([1e3 * mean], [place + offset], color=INK, marker="D", markersize=5.0)
        for limit in result.exceedance.filter(block=row["block"], side="any")["clearance"]:
            axes.vlines(1e3 * limit, place - 0.4, place + 0.4, color=LIMIT.colour, linestyle=LIMIT.line, linewidth=1.2)
        name = "ground" if row["floor"] == 0 else f"floor {row['floor']}"
        if row.get("rack"):
            name = f"rack {row['rack']}, level {row['level']}"
        collapses = f"\n{lost} collapsed" if lost else ""
        labels.append(f"block {row['block']}, {name}\n{MU} = {row['mu_s']:g}{collapses}")
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(-0.6, len(labels) - 0.4)
    slides = bool((result.runs["peak_slip"] > 0.0).any())
    axes.set_xlim(0.0, None if slides or axes.dataLim.x1 > 0.0 else 1.0)
    if not slides:
        say(axes, "nothing slides in the building")
    axes.set_xlabel("peak slip (mm)")
    grid_lines(axes)


def _against_acceleration(axes: Axes, result: SlipDemand) -> None:
    """Slip against friction over the peak acceleration of the floor with all goods attached."""
    handles = []
    for place, row in enumerate(result.blocks.iter_rows(named=True)):
        own = result.runs.filter(block=row["block"], collapsed=False).drop_nulls("mu_over_attached")
        look = {**SERIES[place % len(SERIES)], "linestyle": "", "marker": _MARKERS[place % len(_MARKERS)]}
        axes.plot(own["mu_over_attached"], 1e3 * own["peak_slip"].to_numpy(), **look, markersize=4.5, alpha=0.8)
        handles.append(Line2D([], [], **look, markersize=5.0, label=f"block {row['block']}"))
    axes.axvline(1.0, color=INK, linewidth=0.8)
    axes.set_xlim(0.0, max(1.1, axes.get_xlim()[1]))
    slides = bool((result.runs["peak_slip"] > 0.0).any())
    axes.set_ylim(0.0, None if slides else 1.0)
    if not slides:
        say(axes, "nothing slides")
    axes.set_xlabel(f"{MU} g / peak floor acceleration, all goods attached")
    axes.set_ylabel("peak slip (mm)")
    axes.legend(handles=handles, fontsize=8.0, frameon=False)
    grid_lines(axes)


def _fragilities(axes: Axes, result: SlipDemand) -> None:
    """Probability of reaching the clearance of each block by intensity, with its interval."""
    fits = result.fragilities.items()
    finite = [fit.median for _, fit in fits if np.isfinite(fit.median) and fit.median > 0.0]
    highest = 3.0 * max(finite, default=1.0)
    at = np.linspace(0.0, highest, 301)
    for place, (block, fit) in enumerate(fits):
        look = SERIES[place % len(SERIES)]
        low, high = fit.band(at)
        axes.fill_between(at, low, high, color=look["color"], alpha=0.15, linewidth=0.0)
        axes.plot(at, fit.probability(at), **look, linewidth=1.8, label=f"block {block}")
    axes.set_xlim(0.0, highest)
    axes.set_ylim(0.0, 1.0)
    measure = result.metadata["measure"]
    axes.set_xlabel(f"{measure['label']} (g)" if measure["name"] != "scale" else measure["label"])
    axes.set_ylabel("probability that the clearance is reached")
    axes.legend(fontsize=8.0, frameon=False)
    grid_lines(axes)


def _caption(result: SlipDemand) -> str:
    about = result.metadata
    rocking = result.squat.filter(result.squat["rocks_first"])["block"].to_list()
    notes = [f"{about['motions']} motions", "slip of rigid blocks that do not rock and meet no obstacle"]
    if rocking:
        notes.append(f"block {', '.join(map(str, rocking))} would rock before it slides")
    return plain("; ".join(notes))
