"""The sensitivity of a study to its choices: largest underestimation of a first storey under each."""

from __future__ import annotations

from typing import Final

import polars as pl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.media.roles import BLOCK_COLOURS, GREY, INK, MU
from seismass.media.style import plain

_MARKERS: Final = ("o", "D", "^", "s")


def sensitivity_figure(table: pl.DataFrame) -> Figure:
    """Return a dot per choice and occupancy of `Sensitivity.table`, beside lines of the study as it is."""
    several = table["mu"].n_unique() > 1
    groups = table.select("occupancy", "mu").unique(maintain_order=True).rows()
    settings = table.select("choice", "setting").unique(maintain_order=True).rows()
    place = {setting: number for number, setting in enumerate(settings)}
    figure = Figure(figsize=(7.6, 1.3 + 0.2 * len(settings)), layout="constrained")
    axes = figure.add_subplot()
    handles = []
    for number, (occupancy, mu) in enumerate(groups):
        colour, marker = BLOCK_COLOURS[number % len(BLOCK_COLOURS)], _MARKERS[number % len(_MARKERS)]
        rows = table.filter(occupancy=occupancy, mu=mu).drop_nulls("largest_percent")
        heights = [place[key] for key in rows.select("choice", "setting").rows()]
        axes.plot(rows["largest_percent"], heights, color=colour, marker=marker, markersize=5.0, linestyle="")
        as_is = rows.filter(choice=settings[0][0])["largest_percent"]
        if as_is.len():
            axes.axvline(as_is[0], color=colour, linewidth=0.9, linestyle=(0, (4, 2)))
        name = f"{occupancy}, {MU} = {mu:g}" if several else occupancy
        handles.append(Line2D([], [], color=colour, marker=marker, markersize=5.0, linewidth=0.9, label=plain(name)))
    before = None
    for (choice, _), row in place.items():
        if before not in (None, choice):
            axes.axhline(row - 0.5, color=GREY, linewidth=0.4, alpha=0.6)
        before = choice
    axes.axvline(0.0, color=INK, linewidth=0.8)
    axes.set_yticks(range(len(settings)), [plain(": ".join(filter(None, setting))) for setting in settings])
    axes.set_ylim(len(settings) - 0.5, -0.5)
    axes.set_xlabel("largest underestimation of a first storey (%); lines: the study as it is")
    axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
    return figure
