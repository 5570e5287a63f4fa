"""The figure of a scaling (paper, Fig. 1): scaled spectra with their mean and scatter beside the target."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.media.result import named_figure
from seismass.media.roles import BLUE, GREEN, GREY, VERMILION
from seismass.media.style import PERIOD_TICKS, plain
from seismass.scaling.result import ScalingResult
from seismass.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum

_DASHED = (0, (5, 2))
_DOTTED = (0, (1.2, 1.6))
_WIDER = (0.05, 4.0)
"""Periods (s) of a figure that has the suite and the target."""


def scaling_figure(
    scaling: ScalingResult,
    name: str | None = None,
    *,
    records: Iterable[GroundMotion] | None = None,
    target: TargetSpectrum | None = None,
) -> Figure:
    """Return spectra, and below them the mean over the target; arguments as in `ScalingResult.plot`."""
    named_figure(scaling, name)
    periods, spectra, wanted = _drawn(scaling, records, target)
    mean, middle = spectra.mean(axis=0), np.exp(np.log(spectra).mean(axis=0))
    spread = np.exp(np.log(spectra).std(axis=0, ddof=1)) if len(spectra) > 1 else np.ones(len(periods))
    figure = Figure(figsize=(7.0, 6.2), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1.2))
    for row in spectra:
        upper.plot(periods, row / STANDARD_GRAVITY, color=GREY, linewidth=0.7, alpha=0.8)
    for edge in (middle / spread, middle * spread):
        upper.plot(periods, edge / STANDARD_GRAVITY, color=GREEN, linewidth=1.2, linestyle=_DOTTED)
    upper.plot(periods, mean / STANDARD_GRAVITY, color=BLUE, linewidth=2.0)
    upper.plot(periods, wanted / STANDARD_GRAVITY, color=VERMILION, linewidth=1.8, linestyle=_DASHED)
    lower.plot(periods, mean / wanted, color=BLUE, linewidth=2.0)
    lower.axhline(1.0, color=VERMILION, linewidth=1.2, linestyle=_DASHED)
    lower.plot(scaling.governing_period, scaling.least_ratio, "o", color=BLUE, markersize=5.0)
    first, last = float(scaling.periods[0]), float(scaling.periods[-1])
    for axes in (upper, lower):
        axes.axvline(scaling.period, color=GREY, linewidth=0.8, linestyle=_DASHED)
        axes.axvspan(first, last, color=BLUE, alpha=0.07, linewidth=0.0)
        axes.set_xscale("log")
        axes.set_xlim(periods[0], periods[-1])
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    upper.set_ylim(0.0, None)
    lower.set_ylim(0.0, 1.1 * max(1.0, float(np.max(mean / wanted))))
    ticks = [tick for tick in PERIOD_TICKS if periods[0] * 0.9999 <= tick <= periods[-1] * 1.0001]
    if len(ticks) < 2:
        ticks = [float(f"{tick:.2g}") for tick in np.geomspace(periods[0], periods[-1], 3)]
    lower.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    lower.minorticks_off()
    lower.set_xlabel("period (s)")
    upper.set_ylabel(f"pseudo-acceleration, {100.0 * scaling.damping:g} % damping (g)")
    lower.set_ylabel("mean over target")
    handles = [
        Line2D([], [], color=BLUE, linewidth=2.0, label=f"mean of {len(spectra)} scaled"),
        Line2D([], [], color=VERMILION, linewidth=1.8, linestyle=_DASHED, label="target"),
        Line2D([], [], color=GREY, linewidth=0.7, label="each motion, scaled"),
        Line2D([], [], color=GREEN, linewidth=1.2, linestyle=_DOTTED, label="16 and 84 %, lognormal"),
        Line2D([], [], color=GREY, linewidth=0.8, linestyle=_DASHED, label=f"T = {scaling.period:.3g} s"),
        Line2D([], [], color=BLUE, marker="o", linewidth=0.0, label=f"least ratio, {scaling.least_ratio:.3f}"),
        Line2D([], [], color=BLUE, alpha=0.12, linewidth=8.0, label=f"compared, {first:.3g} to {last:.3g} s"),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=3, frameon=False)
    text = f"Method: {scaling.method}. Target: {plain(scaling.target_label)}"
    figure.supxlabel(textwrap.fill(text, 95), fontsize=7.5)
    return figure


def _drawn(
    scaling: ScalingResult, records: Iterable[GroundMotion] | None, target: TargetSpectrum | None
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Periods (s), scaled spectra and target (m/s2) that are drawn."""
    if records is None or target is None:
        return scaling.periods, scaling.spectra, scaling.target
    suite = as_motions(records, "figure")
    shortest = max(min(_WIDER[0], float(scaling.periods[0])), target.shortest)
    longest = min(max(_WIDER[1], float(scaling.periods[-1])), target.longest)
    periods: FloatArray = np.geomspace(shortest, longest, 200)
    spectra = scaling.factors[:, None] * response_spectrum(suite, periods, scaling.damping)
    return periods, spectra, target(periods)
