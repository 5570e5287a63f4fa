"""Peaks of many runs over the height: each run, their median, and the fractiles beside it."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.errors import InvalidOption
from seismass.base.quantiles import quantile
from seismass.base.values import FloatArray, refusal
from seismass.media.axes import grid_lines, single
from seismass.media.roles import GREY
from seismass.media.style import STYLE
from seismass.plots.batches import FRACTILES
from seismass.plots.columns import checked_table, in_unit, label_of


def drift_profiles(table: pl.DataFrame, demand: str = "peak_drift", *, ax: Axes | None = None) -> Figure:
    """Draw a demand of many runs over the storeys: each run, the median, 16 % and 84 %.

    Parameters
    ----------
    table : polars.DataFrame
        Rows of `simulate_many`, or of `long_table`; all of buildings with equally many storeys. Runs that failed are
        left out. A run that collapsed counts as infinite in the fractiles, and is drawn to where it came.
    demand : str, default "peak_drift"
        Column with a value per storey.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure.

    Raises
    ------
    InvalidOption
        The column is missing or has no value per storey, buildings differ in height, all runs failed, or `ax` is no
        Axes.
    """
    owner = "drift profiles"
    kept = checked_table(table, (demand,), owner)
    listed = isinstance(kept.schema[demand], pl.List)
    if not listed:
        kept = checked_table(kept, ("run", "storey", demand), owner).sort("run", "storey", maintain_order=True)
        kept = kept.group_by("run", maintain_order=True).agg(pl.col(demand), pl.col("status").first())
    heights = kept[demand].list.len().unique().to_list()
    if len(heights) != 1 or not heights[0]:
        raise refusal(InvalidOption, "table", owner, "runs of buildings with equally many storeys", f"{heights}")
    values = in_unit(demand, np.array(kept[demand].to_list(), dtype=float))
    if np.isnan(values).any():
        raise refusal(InvalidOption, "demand", owner, "known for every storey of every run", demand)
    fell = (kept["status"] == "collapsed").to_numpy()
    counted = np.where(fell[:, None], np.inf, values)
    level = np.arange(1, heights[0] + 1)
    with mpl.rc_context(STYLE):
        place = single(ax, owner, size=(4.6, 1.6 + 0.4 * min(max(heights[0], 5), 14)))
        axes = place.axes[0]
        for run in values:
            axes.plot(run, level, color=GREY, linewidth=0.7, alpha=0.7, gid="run")
        found: list[FloatArray] = []
        for share, name, look in FRACTILES:
            found.append(quantile(counted.T, share))
            axes.plot(found[-1], level, **look, marker="o", markersize=3.5, label=name, gid=name)
        finite = values[np.isfinite(values)]
        axes.set_xlim(0.0, 1.08 * float(np.max(finite, initial=0.0)) or 1.0)
        axes.set_ylim(0.6, heights[0] + 0.4)
        axes.set_yticks(level if heights[0] <= 14 else level[:: heights[0] // 7])
        axes.set_xlabel(label_of(demand))
        axes.set_ylabel("storey")
        grid_lines(axes)
        handles = [Line2D([], [], color=GREY, linewidth=0.7, label=f"each of {len(values)} runs")]
        handles += [Line2D([], [], **look, label=name) for _, name, look in FRACTILES]
        place.legend(handles, columns=2)
    return place.figure
