"""The figure of a scaling (paper, Fig. 1): scaled spectra, their mean and scatter, the target, and what was compared."""

from __future__ import annotations

import textwrap

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.report.figures import BLUE, GREEN, GREY, PERIOD_TICKS, VERMILION, plain
from seismass.scaling.result import ScalingResult
from seismass.units import STANDARD_GRAVITY

_DASHED = (0, (5, 2))
_DOTTED = (0, (1.2, 1.6))


def scaling_figure(scaling: ScalingResult) -> Figure:
    """Return spectra over the periods of comparison, and below them the mean over the target.

    Parameters
    ----------
    scaling : ScalingResult
        Result of any of the methods.
    """
    figure = Figure(figsize=(7.0, 6.2), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1.2))
    table = scaling.spectrum_table()
    periods = scaling.periods
    for row in scaling.spectra:
        upper.plot(periods, row / STANDARD_GRAVITY, color=GREY, linewidth=0.7, alpha=0.8)
    for name in ("p16", "p84"):
        upper.plot(periods, table[name] / STANDARD_GRAVITY, color=GREEN, linewidth=1.2, linestyle=_DOTTED)
    upper.plot(periods, scaling.mean / STANDARD_GRAVITY, color=BLUE, linewidth=2.0)
    upper.plot(periods, scaling.target / STANDARD_GRAVITY, color=VERMILION, linewidth=1.8, linestyle=_DASHED)
    lower.plot(periods, scaling.mean / scaling.target, color=BLUE, linewidth=2.0)
    lower.axhline(1.0, color=VERMILION, linewidth=1.2, linestyle=_DASHED)
    lower.plot(scaling.governing_period, scaling.least_ratio, "o", color=BLUE, markersize=5.0)
    for axes in (upper, lower):
        axes.axvline(scaling.period, color=GREY, linewidth=0.8, linestyle=_DASHED)
        axes.set_xscale("log")
        axes.set_xlim(periods[0], periods[-1])
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    upper.set_ylim(0.0, None)
    lower.set_ylim(min(0.0, 0.9 * scaling.least_ratio) if scaling.least_ratio < 0.5 else 0.5, None)
    ticks = [tick for tick in PERIOD_TICKS if periods[0] * 0.9999 <= tick <= periods[-1] * 1.0001]
    if len(ticks) < 2:
        ticks = [float(f"{tick:.2g}") for tick in np.geomspace(periods[0], periods[-1], 3)]
    lower.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    lower.minorticks_off()
    lower.set_xlabel(f"period (s); compared from {periods[0]:.3g} to {periods[-1]:.3g} s")
    upper.set_ylabel(f"pseudo-acceleration, {100.0 * scaling.damping:g} % damping (g)")
    lower.set_ylabel("mean over target")
    motions = len(scaling.names)
    handles = [
        Line2D([], [], color=BLUE, linewidth=2.0, label=f"mean of {motions} scaled motions"),
        Line2D([], [], color=VERMILION, linewidth=1.8, linestyle=_DASHED, label="target"),
        Line2D([], [], color=GREY, linewidth=0.7, label="each motion, scaled"),
        Line2D([], [], color=GREEN, linewidth=1.2, linestyle=_DOTTED, label="16 and 84 % (lognormal)"),
        Line2D([], [], color=GREY, linewidth=0.8, linestyle=_DASHED, label=f"T = {scaling.period:.3g} s"),
        Line2D([], [], color=BLUE, marker="o", linewidth=0.0, label=f"least ratio, {scaling.least_ratio:.3f}"),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=3, frameon=False)
    text = f"Method: {scaling.method}. Target: {plain(scaling.target_label)}"
    figure.supxlabel(textwrap.fill(text, 95), fontsize=7.5)
    return figure
