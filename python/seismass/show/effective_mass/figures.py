"""Figures of an effective fraction: real over model drift against the share attached, and by storey."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

from seismass.effective_mass.estimate import RULE, SAFE_RULE
from seismass.effective_mass.result import EffectiveMass
from seismass.media.result import named_figure
from seismass.media.roles import (
    ADVISED,
    ATTACHED,
    BARE,
    EFFECTIVE,
    ETA,
    GREY,
    INK,
    OMEGA,
    OVER_MODEL,
    SHARE,
    SLIDE,
    lettered,
)
from seismass.media.style import STYLE
from seismass.model.codes import MARK, NOT_CHECKED, code_fraction

_MARKED: Final = {
    "asce7-10": "ASCE 7",
    "nsr-10": "NSR-10",
    "is1893": "IS 1893",
    "nch2369": "NCh2369",
    "nbc": "NBC",
    "nzs1170.5": "NZS 1170.5",
    "ec8": "Eurocode 8",
    "e030": "E.030",
}


def _storage_codes() -> Iterator[tuple[str, float]]:
    rows = {code_id: code_fraction(code_id, "storage") for code_id in _MARKED}
    for share in dict.fromkeys(row.fraction for row in rows.values()):
        named = [f"{name}{rows[code_id].mark}" for code_id, name in _MARKED.items() if rows[code_id].fraction == share]
        yield ", ".join(named), share


STORAGE_CODES: Final[Mapping[str, float]] = dict(_storage_codes())
"""Shares of codes for storage that figures mark, by the names of those that have them; see `seismass.model.codes`."""
CODES_LEGEND: Final = f"{MARK} {NOT_CHECKED}"
"""What stands below a figure that marks them."""
_RATIO_TICKS: Final = (0.25, 0.33, 0.5, 0.67, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0, 4.0)


def effective_mass_figure(
    result: EffectiveMass, name: str | None = None, *, codes: Mapping[str, float] | None = None
) -> Figure:
    """Return a figure by its name."""
    return curve_figure(result, codes) if named_figure(result, name) == "curve" else storeys_figure(result)


def curve_figure(result: EffectiveMass, codes: Mapping[str, float] | None = None) -> Figure:
    """Drift with goods that slide over the model's, against the share attached, with its band, the answer and codes."""
    marks = STORAGE_CODES if codes is None else codes
    largest = result.curve.filter(pl.col("storey") == 0)
    share, ratio = largest["fraction"].to_numpy(), largest["ratio"].to_numpy()
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 4.6), layout="constrained")
        axes = figure.add_subplot()
        if largest["ratio_low"].null_count() == 0:
            low, high = largest["ratio_low"].to_numpy(), largest["ratio_high"].to_numpy()
            label = f"{100.0 * result.confidence:g} % interval over the records"
            axes.fill_between(share, low, high, color=SLIDE.colour, alpha=0.18, linewidth=0.0, label=label)
        label = f"{OVER_MODEL}, {result.statistic} of the largest drift"
        axes.plot(share, ratio, color=SLIDE.colour, linewidth=2.0, label=label)
        for name, (value, style) in {
            RULE: (result.estimate, (0, (1, 1))),
            SAFE_RULE: (result.conservative, (0, (5, 2, 1, 2))),
        }.items():
            axes.axvline(value, color=GREY, linewidth=1.3, linestyle=style, label=f"{lettered(name)} = {value:.2f}")
        if np.isfinite(result.value):
            _mark_answer(axes, result)
        axes.axhline(1.0, color=INK, linewidth=0.8)
        _ratio_axis(axes)
        axes.set_xlim(-0.01, 1.01)
        axes.set_xlabel(SHARE)
        axes.set_ylabel(f"{OVER_MODEL}, largest drift\n(above 1: the model is unsafe)")
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
        mark_codes(axes, marks)
        figure.legend(loc="outside upper center", ncols=2, frameon=False)
        figure.supxlabel(f"{_caption(result)}{marked_legend(marks)}", fontsize=7.5)
    return figure


def _mark_answer(axes: Axes, result: EffectiveMass) -> None:
    text = f"{EFFECTIVE} {result.value:.2f}"
    if result.interval is not None:
        text += f" [{result.interval[0]:.2f}, {result.interval[1]:.2f}]"
        axes.plot(result.interval, [1.0, 1.0], color=ADVISED.colour, linewidth=3.0, solid_capstyle="butt", zorder=4)
    ratio = result.real / result.model
    axes.plot([result.value], [ratio], **ADVISED.mark, markersize=7.0, label=text, zorder=5)


def marked_legend(marks: Mapping[str, float]) -> str:
    """Return the legend of codes that were not checked, on a line of its own; empty where none is marked."""
    return f"\n{CODES_LEGEND}" if any(MARK in name for name in marks) else ""


def mark_codes(axes: Axes, marks: Mapping[str, float]) -> None:
    """Codes as short ticks at the upper edge, named there."""
    for name, share in marks.items():
        axes.axvline(share, ymin=0.93, ymax=1.0, color=INK, linewidth=1.4)
        right = share > 0.9
        axes.annotate(
            f"{name} ",
            (share, 0.93),
            xycoords=("data", "axes fraction"),
            xytext=(0.0, -2.0),
            textcoords="offset points",
            rotation=90.0,
            ha="right" if right else "center",
            va="top",
            fontsize=7.0,
            color=INK,
        )


def _ratio_axis(axes: Axes) -> None:
    low, high = axes.get_ylim()
    axes.set_yscale("log")
    axes.set_ylim(min(low, 0.8), max(high, 1.25))
    axes.yaxis.set_major_locator(FixedLocator(list(_RATIO_TICKS)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())


def storeys_figure(result: EffectiveMass) -> Figure:
    """Drift with goods that slide over models' by storey: none, the effective fraction, all, and the envelope."""
    storeys = result.storeys
    level = storeys["storey"].to_numpy()
    rows = [
        ("ratio_at_0", BARE.name, BARE, BARE.line),
        ("ratio", f"{EFFECTIVE} {result.value:.2f}", ADVISED, ADVISED.line),
        ("ratio_at_1", ATTACHED.name, ATTACHED, ATTACHED.line),
        ("envelope_ratio", f"larger of {EFFECTIVE} and none", SLIDE, "-"),
    ]
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 1.9 + 0.55 * len(level)), layout="constrained")
        axes = figure.add_subplot()
        axes.axvline(1.0, color=INK, linewidth=0.8)
        for column, label, role, style in rows:
            axes.plot(
                storeys[column].to_numpy(),
                level,
                color=role.colour,
                marker=role.marker,
                linestyle=style,
                linewidth=1.4,
                markersize=5.0,
                markerfacecolor="white" if role in (BARE, ATTACHED) else role.colour,
                label=label,
            )
        low, high = axes.get_xlim()
        axes.axvspan(1.0, max(high, 1.1), color=GREY, alpha=0.12, linewidth=0.0)
        axes.set_xlim(min(low, 0.9), max(high, 1.1))
        axes.set_ylim(0.5, len(level) + 0.5)
        axes.set_yticks(level)
        axes.set_ylabel("storey")
        axes.set_xlabel(f"{OVER_MODEL} drift, {result.statistic} over the motions (shaded: the model is unsafe)")
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
        figure.legend(loc="outside upper center", ncols=2, frameon=False, title="what the model has attached")
        figure.supxlabel(_caption(result), fontsize=7.5)
    return figure


def _caption(result: EffectiveMass) -> str:
    """One line on what the numbers depend on."""
    chosen = result.metadata

    def listed(name: str) -> str:
        values = sorted(set(chosen[name]))
        return f"{values[0]:g}" if len(values) == 1 else f"{values[0]:g} to {values[-1]:g}"

    damping = "C of the building" if chosen["damping"] == "same" else "ratio in the model's own modes"
    return (
        f"{chosen['motions']} motions;  {ETA} = {result.eta:.2f};  {OMEGA} = {listed('overstrength')}, r2 = "
        f"{listed('second_slope')}, r3 = {listed('third_slope')};  damping of the models: {damping};  "
        f"P-Delta {'on' if chosen['p_delta'] else 'off'}"
    )
