"""Figures of pulses: velocity, extracted pulse, residual and the test of arrival; the class by orientation."""

from __future__ import annotations

import textwrap

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.values import FloatArray
from seismass.media.roles import BLUE, GREEN, GREY, INK, VERMILION
from seismass.media.style import STYLE, plain
from seismass.pulses.extraction import CENTIMETRES, cumulative_share
from seismass.pulses.limits import ARRIVAL, LEAST_PGV, NO_PULSE_BELOW, PULSE_ABOVE
from seismass.pulses.result import BAKER, Candidate, OrientationScan, PulseResult

_PULSE_STYLE = (0, (5, 2))
_SHOWN = 0.999
"""Share of the squared velocity that the figure shows; what follows is quiet."""


def pulse_figure(result: PulseResult) -> Figure:
    """Velocity, extracted pulse, residual, and both cumulative squared velocities with the test of early arrival."""
    one = result.chosen
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 6.6), layout="constrained")
        panels = figure.subplots(4, 1, sharex=True, height_ratios=(1.0, 1.0, 1.0, 1.3))
        time = np.arange(len(one.velocity), dtype=np.float64) * one.dt
        last = int(np.argmax(cumulative_share(one.velocity) >= _SHOWN))
        end = max(time[last], one.centres.max() + one.period)
        most = 1.15 * CENTIMETRES * max(np.max(np.abs(shown)) for shown in (one.velocity, one.pulse, one.residual))
        rows = (
            ("velocity", one.velocity, INK, "-"),
            ("extracted pulse", one.pulse, VERMILION, _PULSE_STYLE),
            ("residual", one.residual, BLUE, "-"),
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
    axes.plot(time, 100.0 * cumulative_share(one.pulse), color=VERMILION, linewidth=1.6, linestyle=_PULSE_STYLE)
    of_pulse, limit = ARRIVAL[method]
    axes.axvline(one.arrival, color=GREEN, linewidth=1.0, linestyle=":")
    axes.axhline(100.0 * limit, color=GREEN, linewidth=1.0)
    axes.plot(one.arrival, 100.0 * one.energy_before, "o", color=GREEN, markeredgecolor=INK, clip_on=False, zorder=5)
    axes.set_ylim(0.0, 104.0)
    axes.set_ylabel("cumulative\nsquared velocity (%)")
    axes.set_xlabel("time (s)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    handles = [
        Line2D([], [], color=INK, linewidth=1.4, label="velocity"),
        Line2D([], [], color=VERMILION, linewidth=1.6, linestyle=_PULSE_STYLE, label="pulse"),
        Line2D([], [], color=GREEN, linewidth=1.0, linestyle=":", label=f"pulse at {100.0 * of_pulse:g} %"),
        Line2D(
            [],
            [],
            color=GREEN,
            linewidth=1.0,
            marker="o",
            markeredgecolor=INK,
            label=f"velocity there {100.0 * one.energy_before:.0f} %, "
            f"{'early: below' if one.early else 'late: not below'} {100.0 * limit:g} %",
        ),
    ]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.48, -0.3), fontsize=7.5, frameon=False, ncols=4)


def _title(result: PulseResult) -> str:
    one = result.chosen
    found = {
        "pulse": f"pulse-like, $T_p$ = {one.period:.2f} s",
        "ambiguous": "ambiguous",
        "no pulse": "no pulse",
    }[one.kind]
    names = " and ".join(name or "(unnamed)" for name in result.names)
    return f"{plain(names)}: {found}"


def _caption(result: PulseResult) -> str:
    one = result.chosen
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


def orientation_figure(scan: OrientationScan) -> Figure:
    """Indicator, peak velocity and period of the candidate over the orientation, with the limits of Baker (2007)."""
    table = scan.table()
    angles, kinds = scan.angles, np.array(table["kind"].to_list())
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 6.0), layout="constrained")
        panels = figure.subplots(3, 1, sharex=True)
        rows = (
            ("indicator", table["indicator"].to_numpy(), "pulse indicator"),
            ("pgv", CENTIMETRES * table["pgv"].to_numpy(), "peak velocity (cm/s)"),
            ("period", table["period"].to_numpy(), "period of wavelet (s)"),
        )
        markers = {"pulse": ("o", VERMILION), "ambiguous": ("s", "white"), "no pulse": ("x", GREY)}
        for axes, (name, values, label) in zip(panels, rows, strict=True):
            axes.plot(angles, values, color=GREY, linewidth=0.7, zorder=1)
            for kind, (marker, colour) in markers.items():
                at = kinds == kind
                edge = {} if marker == "x" else {"markeredgecolor": INK}
                axes.plot(angles[at], values[at], linestyle="none", marker=marker, color=colour, markersize=5.5, **edge)
            axes.set_ylabel(label)
            axes.set_ylim(0.0, 1.04 if name == "indicator" else 1.15 * values.max())
            axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
        for limit in (NO_PULSE_BELOW, PULSE_ABOVE):
            panels[0].axhline(limit, color=GREEN, linewidth=1.0, linestyle=_PULSE_STYLE)
        panels[1].axhline(CENTIMETRES * LEAST_PGV, color=GREEN, linewidth=1.0, linestyle=_PULSE_STYLE)
        panels[2].set_xlabel("orientation (degrees from the first component to the second)")
        panels[2].set_xlim(-3.0, 180.0)
        panels[2].set_xticks(range(0, 181, 30))
        handles = [
            Line2D([], [], linestyle="none", marker=marker, color=colour, markeredgecolor=INK, label=kind)
            if marker != "x"
            else Line2D([], [], linestyle="none", marker=marker, color=colour, label=kind)
            for kind, (marker, colour) in markers.items()
        ]
        handles.append(Line2D([], [], color=GREEN, linewidth=1.0, linestyle=_PULSE_STYLE, label="limits of the method"))
        figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
        names = " and ".join(name or "(unnamed)" for name in scan.names)
        caption = f"{names}, {BAKER}: pulse-like in {scan.pulses} of {len(scan.results)} orientations"
        figure.supxlabel(textwrap.fill(plain(caption), 108), fontsize=7.5)
    return figure
