"""The underestimation of a study at once: against R by alpha, goods that slide and all attached over the code model."""

from __future__ import annotations

import textwrap
from itertools import cycle
from typing import Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from seismass.media.roles import ALPHA, ATTACHED, CODE, DEEP_BLUE, GREY, INK, MU, SKY, SLIDE
from seismass.media.style import plain
from seismass.show.study.captions import LEAST_WIDTH, StudyFrames, labels_of, occupancy_title, suite_caption

ALPHA_COLOURS: Final = (SKY, SLIDE.colour, DEEP_BLUE)
ALPHA_MARKERS: Final = ("o", "s", "D", "^", "v", "P", "X")
ALPHA_SPACING: Final = 0.24
"""Largest distance between the ranges of two alphas, as a fraction of that between two R."""


_PHONE: Final = 3.4
"""Width of a figure for a phone (inches)."""
RING: Final[Any] = {"marker": "o", "markersize": 9.0, "markerfacecolor": "none", "markeredgewidth": 0.9}
"""The fully attached model."""


def underestimation_figure(result: StudyFrames, mu: float, *, narrow: bool = False) -> Figure:
    """Underestimation (%) against R by alpha for one mu: the worst storey, and each building's range. A ring is the
    fully attached over the code model there; on the marker, mass causes all of it, sliding none.
    """
    summary = result.summary.filter(mu=mu)
    occupancies = summary.select("occupancy", "lambda_design", "lambda_analysis").unique(maintain_order=True).rows()
    buildings = summary.select("storeys", "period").unique(maintain_order=True).rows()
    factors, alphas = labels_of(summary["R"]), labels_of(summary["alpha"])
    looks = looks_of(len(alphas))
    # For a phone buildings stand below each other, and occupancies side by side.
    width = _PHONE if narrow else max(1.2 + 3.1 * len(buildings), LEAST_WIDTH)
    down, across = (len(buildings), len(occupancies)) if narrow else (len(occupancies), len(buildings))
    figure = Figure(figsize=(width, 1.7 + (1.9 if narrow else 2.6) * down), layout="constrained")
    grid = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
    if narrow:
        grid = grid.T
    offsets = min(ALPHA_SPACING, 0.8 / len(alphas)) * (np.arange(len(alphas)) - 0.5 * (len(alphas) - 1))
    for axes_row, (occupancy, design, analysis) in zip(grid, occupancies, strict=True):
        for axes, (storeys, period) in zip(axes_row, buildings, strict=True):
            same = (pl.col("occupancy") == occupancy) & (pl.col("storeys") == storeys) & (pl.col("period") == period)
            for alpha, offset, look in zip(alphas, offsets, looks, strict=True):
                here = summary.filter(same & (pl.col("alpha") == alpha))
                _ranges(axes, here, list(factors), offset, look)
            axes.axhline(0.0, color=INK, linewidth=0.9)
            axes.grid(axis="y", color=GREY, alpha=0.25, linewidth=0.5)
            axes.set_xticks(range(len(factors)), list(factors.values()))
        title = occupancy_title(occupancy, design, analysis)
        if narrow:
            axes_row[0].set_title(title)
        else:
            axes_row[0].set_ylabel(f"{title}\nunderestimation of drift (%)")
    bottom = grid[0][0].get_ylim()[0]
    for axes in grid.flat:
        axes.axhspan(bottom, 0.0, color=GREY, alpha=0.12, linewidth=0.0)
        axes.set_ylim(bottom, None)
    for axes, (storeys, period) in zip(grid[0], buildings, strict=True):
        if narrow:
            axes.set_ylabel(f"{storeys} storeys, {period:g} s\nunderestimation (%)")
        else:
            axes.set_title(f"{storeys} storeys, {period:g} s")
    elastic = 1.0 in factors and not result.metadata["parameters"]["yield_at_r1"]
    for axes in grid[:, -1] if narrow else grid[-1]:
        axes.set_xlabel("R (1: elastic)" if elastic else "R")
    handles: list[Line2D | Patch] = [
        _alpha_handle(look, label) for look, label in zip(looks, alphas.values(), strict=True)
    ]
    handles += [
        Line2D([], [], **RING, color=GREY, linestyle="", label=ATTACHED.name),
        Line2D([], [], color=GREY, marker="_", markersize=6.0, linewidth=1.2, label="other storeys"),
        Patch(color=GREY, alpha=0.12, linewidth=0.0, label="code gives more drift"),
    ]
    code = plain(result.metadata["code"]["name"])
    friction = f", {MU} = {mu:g}" if result.summary["mu"].n_unique() > 1 else ""
    title = f"({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name} of mean peak drift, code: {code}{friction}"
    figure.legend(
        handles=handles,
        loc="outside upper center",
        ncols=2 if narrow else 6 if width > 9.0 else 3,
        frameon=False,
        title=textwrap.fill(title, 46 if narrow else 200),
    )
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure


def _alpha_handle(look: tuple[str, str], label: str) -> Line2D:
    colour, marker = look
    return Line2D([], [], color=colour, marker=marker, markersize=5.0, linewidth=1.0, label=f"{ALPHA} = {label}")


def looks_of(count: int) -> list[tuple[str, str]]:
    """Return colour and marker of each alpha, no two the same: those of three, or shades from the first to the last."""
    shades = LinearSegmentedColormap.from_list("alpha", ALPHA_COLOURS)
    colours = (
        ALPHA_COLOURS if count <= len(ALPHA_COLOURS) else [to_hex(shades(x)) for x in np.linspace(0.0, 1.0, count)]
    )
    return list(zip(colours, cycle(ALPHA_MARKERS), strict=False))[:count]


def _ranges(axes: Axes, rows: pl.DataFrame, factors: list[float], offset: float, look: tuple[str, str]) -> None:
    colour, marker = look
    places, worst, rings = [], [], []
    for position, factor in enumerate(factors):
        known = rows.filter(pl.col("R") == factor).drop_nulls("underestimation_percent")
        if known.height == 0:
            continue
        values = known["underestimation_percent"].to_numpy()
        mass = known["ratio_mass"][int(values.argmax())]
        place = position + offset
        axes.plot([place, place], [values.min(), values.max()], color=colour, linewidth=1.2)
        axes.plot(np.full(len(values), place), values, color=colour, linestyle="", marker="_", markersize=6.0)
        places.append(place)
        worst.append(values.max())
        rings.append(np.nan if mass is None else 100.0 * (mass - 1.0))
    axes.plot(places, worst, color=colour, linewidth=0.8, alpha=0.6)
    axes.plot(places, worst, color=colour, linestyle="", marker=marker, markersize=5.0)
    axes.plot(places, rings, color=colour, linestyle="", **RING)
