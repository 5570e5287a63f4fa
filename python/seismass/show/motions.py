"""Figures and text of records, pulses, scaling and matching."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase, SubFigure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_list, as_one_of, brief, counted, refusal
from seismass.media.result import named_figure
from seismass.media.roles import GREY, INK, KINDS, PAPER, SPECTRUM, TARGET
from seismass.media.style import PERIOD_TICKS, drawing, plain
from seismass.media.svg import CAPTION_CHARACTERS
from seismass.media.text_table import text_line
from seismass.motions.pulses.extraction import (
    ARRIVAL,
    CENTIMETRES,
    LEAST_PGV,
    NO_PULSE_BELOW,
    PULSE_ABOVE,
    cumulative_share,
)
from seismass.motions.pulses.result import BAKER, Candidate, OrientationScan, PulseResult
from seismass.motions.records.intensity import build_up, time_of_share
from seismass.motions.records.rotd import drift_remarks
from seismass.motions.scaling.suite import ScalingResult
from seismass.motions.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum

if TYPE_CHECKING:
    from seismass.motions.matching.result import MatchedRecord
    from seismass.motions.records.record import Record


BAND: Final = 0.05
"""Half-width of the band about the target."""
BEFORE: Final[dict[str, Any]] = {"color": KINDS[1], "linewidth": 1.6}
AFTER: Final[dict[str, Any]] = {"color": SPECTRUM.colour, "linewidth": 0.9}
_BAND: Final[dict[str, Any]] = {"color": TARGET.colour, "alpha": 0.18, "linewidth": 0.0}
_WIDTH: Final = 9.6


@drawing()
def matching_figure(matched: MatchedRecord) -> Figure:
    """Return the figure of a matched record; the scaled record is orange, the matched one blue and thinner."""
    figure = Figure(figsize=(_WIDTH, 7.4), layout="constrained")
    grid = figure.add_gridspec(4, 2, width_ratios=(1.0, 1.15))
    _spectra(matched, figure.add_subplot(grid[:2, 0]))
    _ratios(matched, figure.add_subplot(grid[2, 0]))
    _husid(matched, figure.add_subplot(grid[3, 0]))
    _histories(matched, [figure.add_subplot(grid[row, 1]) for row in range(3)], figure.add_subplot(grid[3, 1]))
    handles = [
        Line2D([], [], **BEFORE, label=f"scaled by {matched.factor:.4g}"),
        Line2D([], [], **AFTER, label="matched"),
        Line2D([], [], color=TARGET.colour, linewidth=1.4, linestyle=(0, (1, 1)), label="target"),
        Patch(**_BAND, label=f"target \N{PLUS-MINUS SIGN} {100.0 * BAND:g} %"),
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
    wide_periods = matched.wide_periods
    axes.axvspan(*matched.matched_periods[[0, -1]], color=SPECTRUM.colour, alpha=0.07, linewidth=0.0)
    axes.plot(wide_periods, matched.wide_before / STANDARD_GRAVITY, **BEFORE)
    # Within the range every period that was judged, outside the few that are at hand.
    outside = (wide_periods < matched.periods[0]) | (wide_periods > matched.periods[-1])
    periods = np.concatenate([wide_periods[outside], matched.periods])
    order = np.argsort(periods)
    after = np.concatenate([matched.wide_after[outside], matched.ordinates * matched.ratio_after])
    axes.plot(periods[order], after[order] / STANDARD_GRAVITY, **AFTER)
    target = matched.ordinates / STANDARD_GRAVITY
    axes.fill_between(matched.periods, target * (1.0 - BAND), target * (1.0 + BAND), **_BAND)
    axes.plot(matched.periods, target, color=TARGET.colour, linewidth=1.4, linestyle=(0, (1, 1)))
    _period_axis(axes, wide_periods[0], wide_periods[-1])
    axes.set_ylim(0.0, None)
    axes.set_xlabel("period (s)")
    axes.set_ylabel(f"pseudo-acceleration, {100.0 * matched.damping:g} % (g)")


def _ratios(matched: MatchedRecord, axes: Axes) -> None:
    axes.axhspan(1.0 - BAND, 1.0 + BAND, **_BAND)
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
    words = f"{matched.original.arias:.2f} to {matched.record.arias:.2f} m/s,\napart by {matched.husid_difference:.0%}"
    axes.text(0.97, 0.08, words, transform=axes.transAxes, ha="right", va="bottom", fontsize=7.5, color=INK)


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


_PULSE_STYLE = (0, (5, 2))
_SHOWN = 0.999
"""Share of the squared velocity that the figure shows; what follows is quiet."""


@drawing()
def pulse_figure(result: PulseResult) -> Figure:
    """Velocity, extracted pulse, residual, and both cumulative squared velocities with the test of early arrival."""
    one = result.primary
    figure = Figure(figsize=(6.4, 6.6), layout="constrained")
    panels = figure.subplots(4, 1, sharex=True, height_ratios=(1.0, 1.0, 1.0, 1.3))
    time = np.arange(len(one.velocity), dtype=np.float64) * one.dt
    last = int(np.argmax(cumulative_share(one.velocity) >= _SHOWN))
    end = max(time[last], one.centres.max() + one.period)
    most = 1.15 * CENTIMETRES * max(np.max(np.abs(shown)) for shown in (one.velocity, one.pulse, one.residual))
    rows = (
        ("velocity", one.velocity, INK, "-"),
        ("extracted pulse", one.pulse, KINDS[0], _PULSE_STYLE),
        ("residual", one.residual, SPECTRUM.colour, "-"),
    )
    for axes, (name, history, colour, line) in zip(panels[:3], rows, strict=True):
        axes.axhline(0.0, color=GREY, linewidth=0.5)
        axes.plot(time, CENTIMETRES * history, color=colour, linewidth=1.1, linestyle=line)
        axes.set_ylim(-most, most)
        peak = f"{name}, peak {CENTIMETRES * np.max(np.abs(history)):.1f} cm/s"
        axes.set_title(peak, loc="right", fontsize=8.0, pad=3.0)
        axes.set_ylabel("cm/s")
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    _arrival(panels[3], result.method, one, time)
    panels[0].set_xlim(0.0, min(end, time[-1]))
    figure.suptitle(textwrap.fill(_title(result), 92), fontsize=9.0)
    figure.supxlabel(textwrap.fill(plain(_caption(result)), 108), fontsize=7.5)
    return figure


def _arrival(axes: Axes, method: str, one: Candidate, time: FloatArray) -> None:
    """Cumulative squared velocities of record and pulse, and where the method compares them."""
    axes.plot(time, 100.0 * cumulative_share(one.velocity), color=INK, linewidth=1.4)
    axes.plot(time, 100.0 * cumulative_share(one.pulse), color=KINDS[0], linewidth=1.6, linestyle=_PULSE_STYLE)
    of_pulse, limit = ARRIVAL[method]
    axes.axvline(one.arrival, color=INK, linewidth=1.0, linestyle=":")
    axes.axhline(100.0 * limit, color=INK, linewidth=1.0)
    axes.plot(one.arrival, 100.0 * one.energy_before, "o", color=INK, clip_on=False, zorder=5)
    axes.set_ylim(0.0, 104.0)
    axes.set_ylabel("cumulative\nsquared velocity (%)")
    axes.set_xlabel("time (s)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    handles = [
        Line2D([], [], color=INK, linewidth=1.4, label="velocity"),
        Line2D([], [], color=KINDS[0], linewidth=1.6, linestyle=_PULSE_STYLE, label="pulse"),
        Line2D([], [], color=INK, linewidth=1.0, linestyle=":", label=f"pulse at {100.0 * of_pulse:g} %"),
        Line2D(
            [],
            [],
            color=INK,
            linewidth=1.0,
            marker="o",
            label=f"velocity there {100.0 * one.energy_before:.0f} %, "
            f"{'early: below' if one.early else 'late: not below'} {100.0 * limit:g} %",
        ),
    ]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.48, -0.3), fontsize=7.5, frameon=False, ncols=4)


def _title(result: PulseResult) -> str:
    one = result.primary
    kind = {
        "pulse": f"pulse-like, $T_p$ = {one.period:.2f} s",
        "ambiguous": "ambiguous",
        "no pulse": "no pulse",
    }[one.kind]
    names = " and ".join(name or "(unnamed)" for name in result.names)
    return f"{plain(names)}: {kind}"


def _caption(result: PulseResult) -> str:
    one = result.primary
    where = ""
    if len(result.names) == 2:
        where = f" in the direction {one.angle:.0f}° from the first component to the second"
        where += "" if one.azimuth is None else f" ({one.azimuth:.0f}° from north)"
    judged = "" if one.is_pulse else "; ".join(("", *one.reasons))
    return (
        f"{result.method}, candidate {one.number} of {len(result.candidates)}{where}: ten db4 wavelets of period "
        f"{one.period:.2f} s; indicator {one.indicator:.3f}, {one.pgv_ratio:.2f} of the peak and "
        f"{one.energy_ratio:.2f} of the energy left in the residual{judged}"
    )


@drawing()
def orientation_figure(scan: OrientationScan) -> Figure:
    """Indicator, peak velocity and period of the candidate over the orientation, with the limits of Baker (2007)."""
    table = scan.table()
    angles, kinds = scan.angles, np.array(table["kind"].to_list())
    figure = Figure(figsize=(6.4, 6.0), layout="constrained")
    panels = figure.subplots(3, 1, sharex=True)
    rows = (
        ("indicator", table["indicator"].to_numpy(), "pulse indicator"),
        ("pgv", CENTIMETRES * table["pgv"].to_numpy(), "peak velocity (cm/s)"),
        ("period", table["period"].to_numpy(), "period of wavelet (s)"),
    )
    markers = {"pulse": ("o", KINDS[0]), "ambiguous": ("s", PAPER), "no pulse": ("x", GREY)}
    for axes, (name, values, label) in zip(panels, rows, strict=True):
        axes.plot(angles, values, color=GREY, linewidth=0.7, zorder=1)
        for kind, (marker, colour) in markers.items():
            mask = kinds == kind
            edge = {} if marker == "x" else {"markeredgecolor": INK}
            axes.plot(angles[mask], values[mask], linestyle="none", marker=marker, color=colour, markersize=5.5, **edge)
        axes.set_ylabel(label)
        axes.set_ylim(0.0, 1.04 if name == "indicator" else 1.15 * values.max())
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    for limit in (NO_PULSE_BELOW, PULSE_ABOVE):
        panels[0].axhline(limit, color=INK, linewidth=1.0, linestyle=_PULSE_STYLE)
    panels[1].axhline(CENTIMETRES * LEAST_PGV, color=INK, linewidth=1.0, linestyle=_PULSE_STYLE)
    panels[2].set_xlabel("orientation (degrees from the first component to the second)")
    panels[2].set_xlim(-3.0, 180.0)
    panels[2].set_xticks(range(0, 181, 30))
    handles = [
        Line2D([], [], linestyle="none", marker=marker, color=colour, markeredgecolor=INK, label=kind)
        if marker != "x"
        else Line2D([], [], linestyle="none", marker=marker, color=colour, label=kind)
        for kind, (marker, colour) in markers.items()
    ]
    handles.append(Line2D([], [], color=INK, linewidth=1.0, linestyle=_PULSE_STYLE, label="limits of the method"))
    figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
    names = " and ".join(name or "(unnamed)" for name in scan.names)
    caption = f"{names}, {BAKER}: pulse-like in {scan.pulses} of {len(scan.results)} orientations"
    figure.supxlabel(textwrap.fill(plain(caption), 108), fontsize=7.5)
    return figure


PANELS: Final = 4


@drawing()
def record_figure(
    record: Record, *, figure: Figure | SubFigure | None = None, axes: Sequence[Axes] | None = None
) -> Figure:
    """Return the figure of a record; arguments as in `Record.plot`. Peaks are those in continuous time; circles mark
    the largest of the samples, which are what is drawn.
    """
    if axes is not None and figure is not None:
        raise refusal(InvalidOption, "axes", "plot", "left out where a figure is given", brief(axes))
    if axes is None:
        figure = Figure(figsize=(7.0, 6.4), layout="constrained") if figure is None else figure
        as_one_of(figure, FigureBase, "figure", "plot", InvalidOption)
        panels: list[Axes] = list(figure.subplots(PANELS, 1, sharex=True))
    else:
        panels = as_list(axes, "axes", "plot", InvalidOption, f"{PANELS} Axes")
        if len(panels) != PANELS or not all(isinstance(one, Axes) for one in panels):
            raise refusal(InvalidOption, "axes", "plot", f"{PANELS} Axes", brief(axes))
    _draw(record, panels)
    return panels[0].figure.figure  # of a subfigure the whole one


def _draw(record: Record, panels: list[Axes]) -> None:
    time = record.time
    built = build_up(record.acceleration, record.dt)
    histories: tuple[tuple[str, FloatArray, str], ...] = (
        ("acceleration (g)", record.acceleration / STANDARD_GRAVITY, f"PGA = {record.pga_g:.3f} g"),
        ("velocity (m/s)", record.velocity, f"PGV = {record.pgv:.3f} m/s"),
        ("displacement (m)", record.displacement, f"PGD = {record.pgd:.3f} m"),
    )
    for axes, (label, values, peak) in zip(panels, histories, strict=False):
        axes.plot(time, values, color=SPECTRUM.colour, linewidth=0.7)
        axes.axhline(0.0, color=GREY, linewidth=0.6)
        where = int(np.argmax(np.abs(values)))
        axes.plot(time[where], values[where], "o", markerfacecolor="none", color=INK, markersize=5.0)
        reach = 1.12 * float(np.max(np.abs(values))) or 1.0
        axes.set_ylim(-reach, reach)
        axes.set_ylabel(label)
        _note(axes, peak)
    _arias(record, panels[-1], built)
    for axes in panels:
        axes.set_xlim(0.0, max(record.duration, record.dt))
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    panels[-1].set_xlabel("time (s)")
    panels[0].figure.align_ylabels(panels)
    note = ", ".join(part for part in (record.event, record.station, record.component) if part)
    title = (record.name or "(unnamed)") + (", synthetic" if record.synthetic else "") + (f"  ({note})" if note else "")
    whole = panels[0].figure
    width = int(CAPTION_CHARACTERS * panels[0].get_position().width * whole.bbox.width / whole.dpi)
    lines = [plain(textwrap.fill(text, max(width, 20))) for text in (title, *drift_remarks(record))]
    # The last line is left to the peak.
    panels[0].set_title("\n".join([*lines, " "]), loc="left", fontsize=8.0, pad=3.0)


def _arias(record: Record, axes: Axes, built: FloatArray) -> None:
    axes.plot(record.time, built, color=SPECTRUM.colour, linewidth=1.2)
    bounds = [time_of_share(record.acceleration, record.dt, share) for share in (0.05, 0.95)]
    look: Any = {"color": INK, "linestyle": (0, (4, 2)), "linewidth": 1.0}
    for bound in bounds:
        axes.axvline(bound, **look)
    axes.axvspan(*bounds, color=GREY, alpha=0.08, linewidth=0.0)
    axes.set_ylim(0.0, 1.08 * record.arias or 1.0)
    axes.set_ylabel("Arias (m/s)")
    _note(axes, f"Arias = {record.arias:.3f} m/s, D5-95 = {bounds[1] - bounds[0]:.2f} s (dashed)")


def _note(axes: Axes, text: str) -> None:
    """A measure above the end of a panel, where nothing is drawn."""
    axes.set_title(text, loc="right", fontsize=8.0, pad=3.0)


_DASHED = (0, (5, 2))
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
    first, last = float(scaling.periods[0]), float(scaling.periods[-1])
    upper.plot(periods, mean / STANDARD_GRAVITY, **SPECTRUM.look, linewidth=2.0, label=f"mean of {len(spectra)} scaled")
    upper.plot(periods, wanted / STANDARD_GRAVITY, **TARGET.look, linewidth=1.8, label=TARGET.name)
    lines = upper.plot(periods, spectra.T / STANDARD_GRAVITY, color=GREY, linewidth=0.7, alpha=0.8, zorder=1)
    lines[0].set_label("each motion, scaled")
    edges = np.transpose([middle / spread, middle * spread]) / STANDARD_GRAVITY
    upper.plot(periods, edges, ":", color=SPECTRUM.colour, linewidth=1.2)[0].set_label("16 and 84 %, lognormal")
    lower.plot(periods, mean / wanted, **SPECTRUM.look, linewidth=2.0)
    lower.axhline(1.0, **TARGET.look, linewidth=1.2)
    least = f"least ratio, {scaling.least_ratio:.3f}"
    lower.plot(scaling.governing_period, scaling.least_ratio, **SPECTRUM.mark, markersize=5.0, label=least)
    for axes, (period, compared) in (
        (upper, (f"T = {scaling.period:.3g} s", f"compared, {first:.3g} to {last:.3g} s")),
        (lower, ("", "")),
    ):
        axes.axvline(scaling.period, color=GREY, linewidth=0.8, linestyle=_DASHED, label=period)
        axes.axvspan(first, last, color=SPECTRUM.colour, alpha=0.07, linewidth=0.0, label=compared)
        axes.set_xscale("log")
        axes.set_xlim(periods[0], periods[-1])
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    upper.set_ylim(0.0, None)
    inside = (periods >= scaling.periods[0]) & (periods <= scaling.periods[-1])
    ends = (mean / wanted)[inside] if inside.any() else mean / wanted
    lower.set_ylim(0.9 * min(1.0, float(ends.min())), 1.1 * max(1.0, float(ends.max())))
    words = f"mean is at least {scaling.least_ratio:.2f} of the target, at {scaling.governing_period:.3g} s"
    upper.set_title(f"From {scaling.periods[0]:.3g} to {scaling.periods[-1]:.3g} s the {words}", fontsize=9.5)
    ticks = [tick for tick in PERIOD_TICKS if periods[0] * 0.9999 <= tick <= periods[-1] * 1.0001]
    if len(ticks) < 2:
        ticks = [float(f"{tick:.2g}") for tick in np.geomspace(periods[0], periods[-1], 3)]
    lower.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    lower.minorticks_off()
    lower.set_xlabel("period (s)")
    upper.set_ylabel(f"pseudo-acceleration, {100.0 * scaling.damping:g} % damping (g)")
    lower.set_ylabel("mean over target")
    figure.legend(loc="outside upper center", ncols=3, frameon=False)
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


def scaling_text(scaling: ScalingResult) -> str:
    """Return target, method, remarks, how the mean fits the target, the scatter, and the factor of each motion."""
    return "\n".join([*scaling_lines(scaling, scaling.remarks), "", *factor_lines(scaling)])


def scaling_lines(scaling: ScalingResult, remarks: Sequence[str]) -> list[str]:
    """Return target and method, remarks, the fit of the mean and the scatter."""
    touches = (
        "touches the target" if abs(scaling.least_ratio - 1.0) < 1e-9 else f"is {scaling.least_ratio:.4f} of the target"
    )
    lines = [f"target  {scaling.target_label}", f"method  {scaling.method}, T = {scaling.period:g} s"]
    for remark in remarks:
        lines += textwrap.wrap(remark, 120, initial_indent="remark  ", subsequent_indent=f"{'':8}")
    lines.append(
        f"range   {len(scaling.periods)} periods from {scaling.periods[0]:g} to {scaling.periods[-1]:g} s; "
        f"the mean {touches} at {scaling.governing_period:.4g} s, at most {scaling.largest_ratio:.3f} of it; "
        f"SF2 = {scaling.common:.6f}"
    )
    if len(scaling.names) > 1:
        scatter = float(np.interp(np.log(scaling.period), np.log(scaling.periods), scaling.log_scatter))
        lines.append(
            f"scatter {float(scaling.log_scatter.mean()):.3f} between the motions over the range, {scatter:.3f} at T "
            "(standard deviation of ln Sa)"
        )
    return lines


def factor_lines(scaling: ScalingResult, remarks: Sequence[Sequence[str]] = ()) -> list[str]:
    """Return the factor and misfit of each motion, with what its record says of itself below it."""
    longest = max(len(f"{factor:.5f}") for factor in (*scaling.individual, *scaling.factors))
    widths = (-5, -max(10, longest + 1), -max(10, longest + 1), -8, -8, 0)
    lines = [text_line(("", "SF1", "SF", "misfit", "largest", "record"), widths, indent=0)]
    for number, (row, largest) in enumerate(
        zip(scaling.diagnostics().iter_rows(named=True), scaling.largest_misfit, strict=True)
    ):
        factors = (f"{row[name]:.5f}" for name in ("individual_factor", "factor"))
        misfits = (f"{misfit:.3f}" for misfit in (row["misfit"], largest))
        lines.append(text_line((f"{row['motion']:>3}", *factors, *misfits, row["record"]), widths, indent=0))
        lines += [f"{'':42}{remark}" for remark in (remarks[number] if remarks else ())]
    return [
        *lines,
        "",
        "SF1: each motion by itself; SF = SF1 SF2: what its accelerations are multiplied by",
        "misfit: root mean square, and largest, of |ln(scaled/target)| over the range",
    ]
