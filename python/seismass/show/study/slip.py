"""Slip demand of a study: how far goods slide on the floors of each building, over its motions."""

from __future__ import annotations

import numpy as np
import polars as pl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.media.roles import ALPHA, GREY
from seismass.media.style import plain
from seismass.show.study.captions import LEAST_WIDTH, StudyFrames, labels_of, suite_caption
from seismass.show.study.underestimation import ALPHA_SPACING, looks_of


def slip_demand(responses: pl.DataFrame) -> pl.DataFrame:
    """Return one row per building with sliding goods, of `StudyResult.responses`: statistics (m) over the motions of
    the largest peak slip of any floor, and mean residual slip there; null where a run failed.
    """
    keys = ["building", "occupancy", "storeys", "period", "R", "alpha", "mu"]
    # Of equal slips, such as none at all, the lowest floor counts.
    worst = (
        responses.filter(model="real")
        .drop_nulls("peak_slip")
        .sort("building", "motion", "storey")
        .group_by(*keys, "motion", maintain_order=True)
        .agg(
            pl.col("peak_slip").max(),
            pl.col("residual_slip").abs().get(pl.col("peak_slip").arg_max()),
        )
    )
    slip = pl.col("peak_slip")
    return worst.group_by(keys, maintain_order=True).agg(
        mean=slip.mean(),
        p16=slip.quantile(0.16, "linear"),
        p84=slip.quantile(0.84, "linear"),
        largest=slip.max(),
        residual=pl.col("residual_slip").mean(),
        slides=(slip > 0.0).sum(),
    )


def slip_figure(result: StudyFrames, mu: float) -> Figure:
    """Return mean peak slip against R by alpha, with 16 to 84 % of the motions; occupancies down, buildings across."""
    demand = slip_demand(result.responses.filter(mu=mu))
    occupancies = demand["occupancy"].unique(maintain_order=True).to_list()
    buildings = demand.select("storeys", "period").unique(maintain_order=True).rows()
    factors, alphas = labels_of(demand["R"]), labels_of(demand["alpha"])
    looks = looks_of(len(alphas))
    width = max(1.2 + 2.6 * len(buildings), LEAST_WIDTH)
    figure = Figure(figsize=(width, 1.2 + 2.1 * len(occupancies)), layout="constrained")
    grid = figure.subplots(len(occupancies), len(buildings), squeeze=False, sharex=True, sharey=True)
    offsets = min(ALPHA_SPACING, 0.8 / len(alphas)) * (np.arange(len(alphas)) - 0.5 * (len(alphas) - 1))
    for row, occupancy in zip(grid, occupancies, strict=True):
        for axes, (storeys, period) in zip(row, buildings, strict=True):
            same = demand.filter(occupancy=occupancy, storeys=storeys, period=period)
            for alpha, offset, (colour, marker) in zip(alphas, offsets, looks, strict=True):
                here = same.filter(alpha=alpha).sort("R")
                place = np.array([list(factors).index(factor) for factor in here["R"]]) + offset
                mean, low, high = (1e3 * here[name].to_numpy() for name in ("mean", "p16", "p84"))
                axes.vlines(place, low, high, color=colour, linewidth=1.2)
                axes.plot(place, mean, color=colour, marker=marker, markersize=5.0, linewidth=0.8)
            axes.set_xticks(range(len(factors)), list(factors.values()))
            axes.grid(axis="y", color=GREY, alpha=0.25, linewidth=0.5)
        row[0].set_ylabel(f"{plain(occupancy)}\npeak slip (mm)")
    grid[0][0].set_ylim(0.0, None)
    for axes, (storeys, period) in zip(grid[0], buildings, strict=True):
        axes.set_title(f"{storeys} storeys, {period:g} s")
    for axes in grid[-1]:
        axes.set_xlabel("R")
    handles = [
        Line2D([], [], color=colour, marker=marker, markersize=5.0, linewidth=0.8, label=f"{ALPHA} = {label}")
        for (colour, marker), label in zip(looks, alphas.values(), strict=True)
    ]
    handles.append(Line2D([], [], color=GREY, linewidth=1.2, label="16 to 84 % of the motions"))
    figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure
