"""A record before and after spectral matching, drawn: spectra with the target, histories, Arias build-up."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, counted
from seismass.media.figure_file import CAPTION_CHARACTERS
from seismass.media.roles import BLUE, GREY, INK, ORANGE, VERMILION
from seismass.media.style import PERIOD_TICKS, STYLE, plain

if TYPE_CHECKING:
    from seismass.matching.result import MatchedRecord

BAND: Final = 0.05
"""Half-width of the band about the target."""
BEFORE: Final[dict[str, Any]] = {"color": ORANGE, "linewidth": 1.6}
AFTER: Final[dict[str, Any]] = {"color": BLUE, "linewidth": 0.9}
_WIDTH: Final = 9.6


def matching_figure(matched: MatchedRecord) -> Figure:
    """Return the figure of a matched record; the scaled record is orange, the matched one blue and thinner."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(_WIDTH, 7.4), layout="constrained")
        grid = figure.add_gridspec(4, 2, width_ratios=(1.0, 1.15))
        _spectra(matched, figure.add_subplot(grid[:2, 0]))
        _ratios(matched, figure.add_subplot(grid[2, 0]))
        _husid(matched, figure.add_subplot(grid[3, 0]))
        _histories(matched, [figure.add_subplot(grid[row, 1]) for row in range(3)], figure.add_subplot(grid[3, 1]))
        handles = [
            Line2D([], [], **BEFORE, label=f"scaled by {matched.factor:.4g}"),
            Line2D([], [], **AFTER, label="matched"),
            Line2D([], [], color=VERMILION, linewidth=1.4, linestyle=(0, (1, 1)), label="target"),
            Patch(color=VERMILION, alpha=0.18, linewidth=0.0, label=f"target \N{PLUS-MINUS SIGN} {100.0 * BAND:g} %"),
        ]
        figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
        misfit = matched.misfit
        state = "" if matched.converged else ": not converged"
        caption = (
            f"{plain(matched.record.name or '(unnamed)')}. Target: {plain(matched.target)}; matched from "
            f"{matched.matched_periods[0]:g} to {matched.matched_periods[-1]:g} s, misfit up to "
            f"{100.0 * misfit.largest:.1f} %, rms {100.0 * misfit.rms:.1f} %, "
            f"{counted(matched.iterations, 'pass', 'passes')}{state}"
        )
        figure.supxlabel(textwrap.fill(caption, int(CAPTION_CHARACTERS * _WIDTH)), fontsize=7.5)
    return figure


def _spectra(matched: MatchedRecord, axes: Axes) -> None:
    at = matched.wide_periods
    axes.axvspan(matched.matched_periods[0], matched.matched_periods[-1], color=BLUE, alpha=0.07, linewidth=0.0)
    axes.plot(at, matched.wide_before / STANDARD_GRAVITY, **BEFORE)
    # Within the range every period that was judged, outside the few that are at hand.
    outside = (at < matched.periods[0]) | (at > matched.periods[-1])
    periods = np.concatenate([at[outside], matched.periods])
    order = np.argsort(periods)
    after = np.concatenate([matched.wide_after[outside], matched.ordinates * matched.ratio_after])
    axes.plot(periods[order], after[order] / STANDARD_GRAVITY, **AFTER)
    target = matched.ordinates / STANDARD_GRAVITY
    axes.fill_between(
        matched.periods, target * (1.0 - BAND), target * (1.0 + BAND), color=VERMILION, alpha=0.18, linewidth=0.0
    )
    axes.plot(matched.periods, target, color=VERMILION, linewidth=1.4, linestyle=(0, (1, 1)))
    _period_axis(axes, at[0], at[-1])
    axes.set_ylim(0.0, None)
    axes.set_xlabel("period (s)")
    axes.set_ylabel(f"pseudo-acceleration, {100.0 * matched.damping:g} % (g)")


def _ratios(matched: MatchedRecord, axes: Axes) -> None:
    axes.axhspan(1.0 - BAND, 1.0 + BAND, color=VERMILION, alpha=0.18, linewidth=0.0)
    axes.plot(matched.periods, matched.ratio_before, **BEFORE)
    axes.plot(matched.periods, matched.ratio_after, **AFTER)
    reach = max(0.12, 1.3 * matched.misfit.largest)
    axes.set_ylim(1.0 - reach, 1.0 + reach)
    _period_axis(axes, matched.periods[0], matched.periods[-1])
    axes.set_xlabel("period (s)")
    axes.set_ylabel("over the target")


def _one_above_the_other(axes: Axes, time: FloatArray, histories: tuple[FloatArray, FloatArray], reach: float) -> None:
    """The history before above the one after, each about its own zero, on one scale."""
    tick = float(f"{0.8 * reach:.1g}")
    places, labels = [], []
    for history, zero, look in zip(histories, (2.2 * reach, 0.0), (BEFORE, AFTER), strict=True):
        axes.plot(time, zero + history, **look | {"linewidth": 0.8, "linestyle": "-"})
        axes.axhline(zero, color=INK, linewidth=0.5)
        places += [zero - tick, zero, zero + tick]
        labels += [f"{-tick:g}", "0", f"{tick:g}"]
    axes.set_yticks(places, labels)
    axes.set_ylim(-1.1 * reach, 3.6 * reach)


def _period_axis(axes: Axes, first: float, last: float) -> None:
    axes.set_xscale("log")
    axes.set_xlim(first, last)
    ticks = [tick for tick in PERIOD_TICKS if first * 0.9999 <= tick <= last * 1.0001]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)


def _husid(matched: MatchedRecord, axes: Axes) -> None:
    time = matched.record.time
    for built, style in zip(matched.build_up, (BEFORE, AFTER), strict=True):
        axes.plot(time, 100.0 * built, **style)
    axes.set_xlim(0.0, time[-1])
    axes.set_ylim(0.0, 100.0)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("Arias intensity (%)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    said = f"{matched.original.arias:.2f} to {matched.record.arias:.2f} m/s,\napart by {matched.husid_difference:.0%}"
    axes.text(0.97, 0.08, said, transform=axes.transAxes, ha="right", va="bottom", fontsize=7.5, color=INK)


def _histories(matched: MatchedRecord, panels: list[Axes], last: Axes) -> None:
    before, after = matched.original, matched.record
    time = after.time
    rows: tuple[tuple[str, FloatArray, FloatArray, str], ...] = (
        (
            "acceleration (g)",
            before.acceleration / STANDARD_GRAVITY,
            after.acceleration / STANDARD_GRAVITY,
            f"PGA {before.pga_g:.3f} to {after.pga_g:.3f} g",
        ),
        ("velocity (m/s)", before.velocity, after.velocity, f"PGV {before.pgv:.3f} to {after.pgv:.3f} m/s"),
        ("displacement (m)", before.displacement, after.displacement, f"PGD {before.pgd:.3f} to {after.pgd:.3f} m"),
    )
    for axes, (label, first, second, peaks) in zip(panels, rows, strict=True):
        reach = 1.1 * max(float(np.max(np.abs(first))), float(np.max(np.abs(second)))) or 1.0
        if axes is panels[0]:  # too dense to lie on one another
            _one_above_the_other(axes, time, (first, second), reach)
        else:
            axes.plot(time, first, **BEFORE | {"linewidth": 2.4})
            axes.plot(time, second, **AFTER | {"linewidth": 0.9, "linestyle": "-"})
            axes.set_ylim(-1.25 * reach, 1.25 * reach)
        axes.set_ylabel(label)
        axes.set_xlim(0.0, time[-1])
        axes.tick_params(labelbottom=False)
        axes.text(0.99, 0.96, peaks, transform=axes.transAxes, ha="right", va="top", fontsize=7.5, color=INK)
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    added = (after.acceleration - before.acceleration) / STANDARD_GRAVITY
    last.plot(time, added, color=INK, linewidth=0.8)
    last.set_xlim(0.0, time[-1])
    last.set_xlabel("time (s)")
    last.set_ylabel("wavelets (g)")
    last.grid(color=GREY, alpha=0.25, linewidth=0.5)
