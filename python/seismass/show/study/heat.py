"""The heat map of a study: underestimation of every storey of every building, as a number in a coloured cell."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure

from seismass.media.roles import ALPHA, CODE, GREY, INK, PAPER, SLIDE
from seismass.show.study.captions import LEAST_WIDTH, StudyFrames, labels_of, occupancy_title, suite_caption

LARGEST: Final = 100.0
"""Underestimation (%) from which on colours are as strong as they get."""
LEAST_ROWS: Final = 3
"""Rows of the height that a figure has at least."""
_MAP: Final = LinearSegmentedColormap.from_list("underestimation", (SLIDE.colour, PAPER, CODE.colour))
_STRONGEST: Final = 0.7
"""Share of a full colour on which numbers are still legible."""


def heat_figure(result: StudyFrames, mu: float) -> Figure:
    """Return a map per occupancy at friction mu: R and alpha downwards, buildings and their storeys across."""
    summary = result.summary.filter(mu=mu)
    occupancies = summary.select("occupancy", "lambda_design", "lambda_analysis").unique(maintain_order=True).rows()
    factors, alphas = labels_of(summary["R"]), labels_of(summary["alpha"])
    rows = [(factor, alpha) for factor in factors for alpha in alphas]
    columns = summary.select("storeys", "period", "storey").unique(maintain_order=True).sort("storeys", "period").rows()
    width = max(1.1 + len(occupancies) * (0.4 + 0.47 * len(columns)), LEAST_WIDTH)
    figure = Figure(figsize=(width, 1.7 + 0.26 * max(len(rows), LEAST_ROWS)), layout="constrained")
    panels = figure.subplots(1, len(occupancies), squeeze=False, sharey=True)[0]
    for axes, (occupancy, design, analysis) in zip(panels, occupancies, strict=True):
        cells = _cells(summary.filter(occupancy=occupancy), rows, columns)
        _draw(axes, cells)
        axes.set_title(occupancy_title(occupancy, design, analysis), pad=24.0)
        axes.set_xticks(range(len(columns)), [f"{storey}" for *_, storey in columns])
        axes.set_xlabel("storey")
        _name_buildings(axes, columns)
    every = len(alphas)
    panels[0].set_yticks(range(len(rows)), [f"R = {factors[f]}, {ALPHA} = {alphas[a]}" for f, a in rows])
    for axes in panels:
        for edge in range(every, len(rows), every):
            axes.axhline(edge - 0.5, color=INK, linewidth=0.8)
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure


def _cells(summary: pl.DataFrame, rows: list[Any], columns: list[Any]) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Underestimation (%), NaN where there is none."""
    cells = np.full((len(rows), len(columns)), np.nan)
    down = {row: place for place, row in enumerate(rows)}
    across = {column: place for place, column in enumerate(columns)}
    keys = ("R", "alpha", "storeys", "period", "storey", "underestimation_percent")
    for factor, alpha, storeys, period, storey, value in summary.select(keys).rows():
        if value is not None:
            cells[down[factor, alpha], across[storeys, period, storey]] = value
    return cells


def _draw(axes: Axes, cells: np.ndarray[Any, np.dtype[np.float64]]) -> None:
    norm = Normalize(-LARGEST / _STRONGEST, LARGEST / _STRONGEST)
    height, width = cells.shape
    # Rectangles, for a picture within an SVG would be blurred.
    axes.pcolormesh(
        np.arange(width + 1) - 0.5,
        np.arange(height + 1) - 0.5,
        cells.clip(-LARGEST, LARGEST),
        cmap=_MAP,
        norm=norm,
        edgecolors=PAPER,
        lw=0.6,
    )
    axes.set_ylim(height - 0.5, -0.5)
    for (row, column), value in np.ndenumerate(cells):
        if np.isnan(value):
            axes.text(column, row, "\N{EN DASH}", ha="center", va="center", fontsize=7.0, color=GREY)
            continue
        text = f"{round(value):+d}".replace("-", "\N{MINUS SIGN}").replace("+0", "0")
        axes.text(column, row, text, ha="center", va="center", fontsize=7.0, color=INK)
    axes.tick_params(length=0.0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _name_buildings(axes: Axes, columns: list[Any]) -> None:
    """Name each building above its storeys, and part it from the next."""
    buildings = list(dict.fromkeys(column[:2] for column in columns))
    for storeys, period in buildings:
        places = [place for place, column in enumerate(columns) if column[:2] == (storeys, period)]
        middle = 0.5 * (places[0] + places[-1])
        axes.annotate(
            f"{storeys} storeys,\n{period:g} s",
            (middle, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0.0, 3.0),
            textcoords="offset points",
            ha="center",
            va="bottom",
            fontsize=7.5,
        )
        if places[0]:
            axes.axvline(places[0] - 0.5, color=INK, linewidth=0.8)
