"""Drift profiles of a study: mean peak drift by storey of the three models (paper, Figs. 6 to 9)."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.media.roles import ALPHA, ATTACHED, CODE, GREY, LAMBDA, MU, SLIDE
from seismass.media.style import plain
from seismass.show.study.captions import LEAST_WIDTH, StudyFrames, labels_of, occupancy_title, suite_caption
from seismass.study import Model

LOOKS: Final[dict[Model, dict[str, Any]]] = {
    "code": {**CODE.look, "linewidth": 1.5, "marker": CODE.marker, "markersize": 4.0, "markerfacecolor": "white"},
    "attached": {
        **ATTACHED.look,
        "linewidth": 1.6,
        "marker": ATTACHED.marker,
        "markersize": 5.5,
        "markerfacecolor": "white",
    },
    "real": {**SLIDE.look, "linewidth": 1.8, "marker": SLIDE.marker, "markersize": 3.5},
}
"""How each model is drawn, in the order of drawing."""


def drift_figure(result: StudyFrames, factor: float, mu: float) -> Figure:
    """Mean peak drift of each storey for one R and mu: occupancies and alpha in columns, buildings in rows."""
    label = labels_of(result.summary["R"])[factor]
    summary = result.summary.filter(R=factor, mu=mu)
    alphas = labels_of(summary["alpha"])
    columns = (
        summary.select("occupancy", "lambda_design", "lambda_analysis", "alpha").unique(maintain_order=True).rows()
    )
    rows = summary.select("storeys", "period").unique(maintain_order=True).rows()
    width = max(1.0 + 1.75 * len(columns), LEAST_WIDTH)
    figure = Figure(figsize=(width, 1.35 + 1.75 * len(rows)), layout="constrained")
    grid = figure.subplots(len(rows), len(columns), squeeze=False, sharex="row", sharey="row")
    for axes_row, (storeys, period) in zip(grid, rows, strict=True):
        same = (pl.col("storeys") == storeys) & (pl.col("period") == period)
        for axes, (occupancy, _, _, alpha) in zip(axes_row, columns, strict=True):
            here = summary.filter(same & (pl.col("occupancy") == occupancy) & (pl.col("alpha") == alpha))
            _drift_profile(axes, here.sort("storey"))
        largest = _largest(summary.filter(same))
        axes_row[0].set_xlim(0.0, 1.42e3 * largest)
        axes_row[0].set_ylim(0.5, storeys + 0.6)
        axes_row[0].set_yticks(range(1, storeys + 1))
        axes_row[0].set_ylabel(f"{storeys} storeys, {period:g} s\n\nstorey")
    for axes, (occupancy, design, analysis, alpha) in zip(grid[0], columns, strict=True):
        axes.set_title(f"{occupancy_title(occupancy, design, analysis)}\n" + f"{ALPHA} = {alphas[alpha]}")
    for axes in grid[-1]:
        axes.set_xlabel("mean peak drift (mm)")
    behaviour = " (elastic)" if factor == 1.0 and not result.metadata["parameters"]["yield_at_r1"] else ""
    code = plain(result.metadata["code"]["name"])
    texts: dict[Model, str] = {
        "real": SLIDE.name,
        "attached": f"{ATTACHED.name}: none slide",
        "code": f"{CODE.name}, {code}: {LAMBDA} of the goods attached",
    }
    handles = [Line2D([], [], label=text, **LOOKS[model]) for model, text in texts.items()]
    handles.append(
        Line2D([], [], color=SLIDE.colour, linewidth=4.5, alpha=0.25, label=f"{SLIDE.name}: 16 to 84 % of the motions")
    )
    handles.append(
        Line2D(
            [],
            [],
            linestyle="",
            label=f"numbers: underestimation ({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name}, %",
        )
    )
    friction = f", {MU} = {mu:g}" if result.summary["mu"].n_unique() > 1 else ""
    title = f"R = {label}{behaviour}{friction}"
    legend = figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False, title=title)
    legend.get_title().set_fontsize(11.0)
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure


def _largest(rows: pl.DataFrame) -> float:
    """Largest drift (m) that is drawn of these rows; 1 where there is none."""
    drawn = rows.select(r"^mean_peak_drift_(real|code|attached)$", "p84_peak_drift_real").to_numpy()
    finite = drawn[np.isfinite(drawn)]
    return float(finite.max()) if finite.size and finite.max() > 0.0 else 1.0


def _drift_profile(axes: Axes, storeys: pl.DataFrame) -> None:
    level = storeys["storey"].to_numpy()
    low, high = (1e3 * storeys[f"{name}_peak_drift_real"].cast(pl.Float64).to_numpy() for name in ("p16", "p84"))
    known = np.isfinite(low) & np.isfinite(high)
    axes.hlines(level[known], low[known], high[known], color=SLIDE.colour, linewidth=4.5, alpha=0.25)
    for model, look in LOOKS.items():
        axes.plot(1e3 * storeys[f"mean_peak_drift_{model}"].to_numpy(), level, **look)
    for height, percent in zip(level, storeys["underestimation_percent"], strict=True):
        text = "" if percent is None else f"{round(percent):+d}".replace("-", "\N{MINUS SIGN}").replace("+0", "0")
        axes.text(0.98, height, text, transform=axes.get_yaxis_transform(), ha="right", va="center", fontsize=7.5)
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    axes.locator_params(axis="x", nbins=4)
