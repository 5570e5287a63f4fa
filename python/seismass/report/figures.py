"""Figures of the parametric study: spectra (paper, Fig. 1), drift profiles (Figs. 6-9), and an overview of them all.

Figures are made without pyplot, so that nothing global changes; colours are those of Okabe and Ito.
"""

from __future__ import annotations

import textwrap
from itertools import cycle
from pathlib import Path
from typing import Any, Final, Literal

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.study import StudyResult, motions_text
from seismass.units import STANDARD_GRAVITY

BLUE: Final = "#0072B2"
VERMILION: Final = "#D55E00"
GREY: Final = "#8C8C8C"
INK: Final = "#222222"
ALPHA_COLOURS: Final = ("#56B4E9", "#0072B2", "#002B4D")
ALPHA_MARKERS: Final = ("o", "s", "D", "^", "v", "P", "X")
ALPHA_SPACING: Final = 0.24
"""Largest distance between the ranges of two alphas, as a fraction of that between two R."""
PERIOD_TICKS: Final = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0)

STYLE: Final[Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 9.0,
    "text.color": INK,
    "svg.hashsalt": "seismass",  # the same figure is the same file
}


def study_figures(result: StudyResult) -> dict[str, Figure]:
    """Return the figures of a study by name: spectrum, underestimation, and drift_R... for each R."""
    with mpl.rc_context(STYLE):
        figures = {"spectrum": spectrum_figure(result), "underestimation": underestimation_figure(result)}
        for factor, label in _labels(result.summary["R"]).items():
            figures[f"drift_R{label}"] = drift_figure(result, factor)
        for figure in figures.values():
            # Lay out once, not again for every file.
            figure.draw_without_rendering()
            figure.set_layout_engine("none")
    return figures


def save_figure(figure: Figure, kind: Literal["png", "svg"], path: Path) -> None:
    """Write a figure as PNG or SVG, without a date, so that equal figures are equal files."""
    with mpl.rc_context(STYLE):
        metadata = {"Software": None} if kind == "png" else {"Date": None, "Creator": None}
        figure.savefig(path, format=kind, dpi=160, metadata=metadata, facecolor="white")


def suite_caption(result: StudyResult) -> str:
    """Return one line on the motions and on the parameters that decide the result."""
    suite, chosen = result.metadata["suite"], result.metadata["parameters"]
    return (
        f"{motions_text(suite)} ({_plain(suite['name'])}), scaled for T = {chosen['scaling_period']:g} s;  "
        rf"$\mu$ = {chosen['mu']:g}, $\Omega$ = {chosen['overstrength']:g}, $r_2$ = {chosen['second_slope']:g}, "
        rf"$r_3$ = {chosen['third_slope']:g}, damping {100.0 * chosen['damping']:g} %"
    )


def _plain(text: str) -> str:
    """Return a text of the user's in which matplotlib finds no formula."""
    return text.replace("$", r"\$")


def _labels(values: pl.Series) -> dict[float, str]:
    """Return what each value is called, in order: as short as they differ."""
    ordered = values.unique().sort().to_list()
    labels = ([f"{value:.{digits}g}" for value in ordered] for digits in range(6, 18))
    return dict(zip(ordered, next(names for names in labels if len(set(names)) == len(names)), strict=True))


def spectrum_figure(result: StudyResult) -> Figure:
    """Target, mean scaled and scaled spectra, with the range in which the mean must not be below the target."""
    table, scaling = result.spectrum, result.scaling
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    axes = figure.add_subplot()
    periods = table["period"].to_numpy()
    motions = [name for name in table.columns if name.startswith("motion_")]
    for name in motions:
        axes.plot(periods, table[name] / STANDARD_GRAVITY, color=GREY, linewidth=0.7, alpha=0.7)
    axes.plot(periods, table["mean"] / STANDARD_GRAVITY, color=BLUE, linewidth=2.0)
    axes.plot(periods, table["target"] / STANDARD_GRAVITY, color=VERMILION, linewidth=1.8, linestyle=(0, (5, 2)))
    shortest, longest = scaling.periods[0], scaling.periods[-1]
    axes.axvspan(shortest, longest, color=BLUE, alpha=0.07, linewidth=0.0)
    axes.set_xscale("log")
    axes.set_xlim(periods[0], periods[-1])
    axes.set_ylim(0.0, None)
    ticks = [tick for tick in PERIOD_TICKS if periods[0] <= tick <= periods[-1] * 1.0001]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("period (s)")
    damping = 100.0 * result.metadata["parameters"]["damping"]
    axes.set_ylabel(f"pseudo-acceleration, {damping:g} % damping (g)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    handles = [
        Line2D([], [], color=BLUE, linewidth=2.0, label=f"mean of {motions_text(result.metadata['suite'])}, scaled"),
        Line2D([], [], color=VERMILION, linewidth=1.8, linestyle=(0, (5, 2)), label="target"),
        Line2D([], [], color=GREY, linewidth=0.7, label="each motion, scaled"),
        Line2D([], [], color=BLUE, alpha=0.12, linewidth=8.0, label=f"range of scaling, {shortest:g} to {longest:g} s"),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False)
    label = textwrap.fill(f"Target: {_plain(result.metadata['target']['label'])}", 90)
    figure.supxlabel(label, fontsize=7.5)
    return figure


def drift_figure(result: StudyResult, factor: float) -> Figure:
    """Mean peak drift of each storey for one R: occupancies and alpha in columns, buildings in rows (Figs. 6-9)."""
    label = _labels(result.summary["R"])[factor]
    summary = result.summary.filter(pl.col("R") == factor)
    alphas = _labels(summary["alpha"])
    columns = summary.select("occupancy", "lambda", "alpha").unique(maintain_order=True).rows()
    rows = summary.select("storeys", "period").unique(maintain_order=True).rows()
    figure = Figure(figsize=(1.0 + 1.75 * len(columns), 1.35 + 1.75 * len(rows)), layout="constrained")
    grid = figure.subplots(len(rows), len(columns), squeeze=False, sharex="row", sharey="row")
    for axes_row, (storeys, period) in zip(grid, rows, strict=True):
        same = (pl.col("storeys") == storeys) & (pl.col("period") == period)
        for axes, (occupancy, _, alpha) in zip(axes_row, columns, strict=True):
            here = summary.filter(same & (pl.col("occupancy") == occupancy) & (pl.col("alpha") == alpha))
            _drift_profile(axes, here.sort("storey"))
        largest = summary.filter(same).select(pl.max_horizontal("^mean_peak_drift_.*$").max()).item() or 1.0
        axes_row[0].set_xlim(0.0, 1.42e3 * largest)
        axes_row[0].set_ylim(0.5, storeys + 0.6)
        axes_row[0].set_yticks(range(1, storeys + 1))
        axes_row[0].set_ylabel(f"{storeys} storeys, {period:g} s\n\nstorey")
    for axes, (occupancy, fraction, alpha) in zip(grid[0], columns, strict=True):
        axes.set_title(rf"{_plain(occupancy)}, $\lambda$ = {fraction:g}" + "\n" + rf"$\alpha$ = {alphas[alpha]}")
    for axes in grid[-1]:
        axes.set_xlabel("mean peak drift (mm)")
    behaviour = " (elastic)" if factor == 1.0 and not result.metadata["parameters"]["yield_at_r1"] else ""
    handles = [
        Line2D([], [], color=BLUE, marker="o", markersize=4.0, linewidth=1.8, label="real: blocks may slide"),
        Line2D(
            [],
            [],
            color=VERMILION,
            marker="s",
            markersize=4.0,
            markerfacecolor="white",
            linewidth=1.5,
            linestyle=(0, (4, 2)),
            label=r"ASCE 7: $\lambda$ of the block mass attached",
        ),
        Line2D([], [], linestyle="", label="numbers: underestimation (real \N{EN DASH} ASCE) / ASCE, %"),
    ]
    legend = figure.legend(
        handles=handles, loc="outside upper center", ncols=3, frameon=False, title=f"R = {label}{behaviour}"
    )
    legend.get_title().set_fontsize(11.0)
    figure.supxlabel(suite_caption(result), fontsize=7.5)
    return figure


def _drift_profile(axes: Axes, storeys: pl.DataFrame) -> None:
    level = storeys["storey"].to_numpy()
    real, asce = (1e3 * storeys[f"mean_peak_drift_{model}"].to_numpy() for model in ("real", "asce"))
    axes.plot(
        asce,
        level,
        color=VERMILION,
        linestyle=(0, (4, 2)),
        linewidth=1.5,
        marker="s",
        markersize=4.0,
        markerfacecolor="white",
    )
    axes.plot(real, level, color=BLUE, linewidth=1.8, marker="o", markersize=4.0)
    for height, percent in zip(level, storeys["underestimation_percent"], strict=True):
        text = "" if percent is None else f"{round(percent):+d}".replace("-", "\N{MINUS SIGN}").replace("+0", "0")
        axes.text(0.98, height, text, transform=axes.get_yaxis_transform(), ha="right", va="center", fontsize=7.5)
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    axes.locator_params(axis="x", nbins=4)


def underestimation_figure(result: StudyResult) -> Figure:
    """Underestimation (%) against R by alpha: the worst storey, and the range over the storeys of each building."""
    summary = result.summary
    occupancies = summary.select("occupancy", "lambda").unique(maintain_order=True).rows()
    buildings = summary.select("storeys", "period").unique(maintain_order=True).rows()
    factors, alphas = _labels(summary["R"]), _labels(summary["alpha"])
    looks = _looks(len(alphas))
    figure = Figure(figsize=(1.2 + 3.1 * len(buildings), 1.5 + 2.6 * len(occupancies)), layout="constrained")
    grid = figure.subplots(len(occupancies), len(buildings), squeeze=False, sharex=True, sharey=True)
    offsets = min(ALPHA_SPACING, 0.8 / len(alphas)) * (np.arange(len(alphas)) - 0.5 * (len(alphas) - 1))
    for axes_row, (occupancy, fraction) in zip(grid, occupancies, strict=True):
        for axes, (storeys, period) in zip(axes_row, buildings, strict=True):
            same = (pl.col("occupancy") == occupancy) & (pl.col("storeys") == storeys) & (pl.col("period") == period)
            for alpha, offset, look in zip(alphas, offsets, looks, strict=True):
                here = summary.filter(same & (pl.col("alpha") == alpha))
                _ranges(axes, here, list(factors), offset, look)
            axes.axhline(0.0, color=INK, linewidth=0.9)
            axes.grid(axis="y", color=GREY, alpha=0.25, linewidth=0.5)
            axes.set_xticks(range(len(factors)), list(factors.values()))
        axes_row[0].set_ylabel(rf"{_plain(occupancy)}, $\lambda$ = {fraction:g}" + "\nunderestimation of drift (%)")
    bottom = grid[0][0].get_ylim()[0]
    for axes in grid.flat:
        axes.axhspan(bottom, 0.0, color=GREY, alpha=0.12, linewidth=0.0)
        axes.set_ylim(bottom, None)
    grid[0][0].text(
        0.03, 0.03, "ASCE model gives more drift", transform=grid[0][0].transAxes, fontsize=7.5, va="bottom"
    )
    for axes, (storeys, period) in zip(grid[0], buildings, strict=True):
        axes.set_title(f"{storeys} storeys, {period:g} s")
    elastic = 1.0 in factors and not result.metadata["parameters"]["yield_at_r1"]
    for axes in grid[-1]:
        axes.set_xlabel("R (1: elastic)" if elastic else "R")
    handles = [_alpha_handle(look, label) for look, label in zip(looks, alphas.values(), strict=True)]
    handles.append(Line2D([], [], color=GREY, marker="_", markersize=6.0, linewidth=1.2, label="other storeys, range"))
    figure.legend(
        handles=handles,
        loc="outside upper center",
        ncols=min(len(handles), 6),
        frameon=False,
        title="(real \N{EN DASH} ASCE) / ASCE of mean peak drift; marker: storey with the largest",
    )
    figure.supxlabel(suite_caption(result), fontsize=7.5)
    return figure


def _alpha_handle(look: tuple[str, str], label: str) -> Line2D:
    colour, marker = look
    return Line2D([], [], color=colour, marker=marker, markersize=5.0, linewidth=1.0, label=rf"$\alpha$ = {label}")


def _looks(count: int) -> list[tuple[str, str]]:
    """Return colour and marker of each alpha, no two the same: those of three, or shades from the first to the last."""
    shades = LinearSegmentedColormap.from_list("alpha", ALPHA_COLOURS)
    colours = (
        ALPHA_COLOURS if count <= len(ALPHA_COLOURS) else [to_hex(shades(x)) for x in np.linspace(0.0, 1.0, count)]
    )
    return list(zip(colours, cycle(ALPHA_MARKERS), strict=False))[:count]


def _ranges(axes: Axes, rows: pl.DataFrame, factors: list[float], offset: float, look: tuple[str, str]) -> None:
    colour, marker = look
    places, worst = [], []
    for position, factor in enumerate(factors):
        values = rows.filter(pl.col("R") == factor)["underestimation_percent"].drop_nulls().to_numpy()
        if len(values) == 0:
            continue
        place = position + offset
        axes.plot([place, place], [values.min(), values.max()], color=colour, linewidth=1.2)
        axes.plot(np.full(len(values), place), values, color=colour, linestyle="", marker="_", markersize=6.0)
        places.append(place)
        worst.append(values.max())
    axes.plot(places, worst, color=colour, linewidth=0.8, alpha=0.6)
    axes.plot(places, worst, color=colour, linestyle="", marker=marker, markersize=5.0)
