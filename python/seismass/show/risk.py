"""Figure and text of a risk-targeted share."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from seismass.base.values import FloatArray, counted
from seismass.effective_mass.result import KIND_TEXTS as EFFECTIVE_KINDS
from seismass.effective_mass.share import Kind
from seismass.media.result import named_figure
from seismass.media.roles import (
    ADVISED,
    ATTACHED,
    CODE,
    EFFECTIVE,
    GREY,
    HAZARD,
    INK,
    OVER_MODEL,
    SHARE,
    SLIDE,
    model_name,
)
from seismass.media.style import drawing, grid_lines, plain
from seismass.media.svg import CAPTION_CHARACTERS
from seismass.media.text_table import interval_text, number_text, text_line
from seismass.show.effective_mass import STORAGE_CODES, mark_codes, marked_legend
from seismass.show.slip import remark_lines

if TYPE_CHECKING:
    from seismass.studies.risk.targeted_share import RiskTargetedShare


_WIDTH = 10.5


@drawing()
def risk_figure(
    result: RiskTargetedShare, name: str | None = None, *, codes: Mapping[str, float] | None = None
) -> Figure:
    """Return `RiskTargetedShare.plot`."""
    named_figure(result, name)
    figure = Figure(figsize=(_WIDTH, 5.0), layout="constrained")
    panels = figure.subplot_mosaic([["hazard", "rates"], ["fragility", "rates"]])
    _hazard(panels["hazard"], panels["fragility"], result)
    present = result.metadata.get("present_share", 1.0)
    shares = {name: share / present for name, share in STORAGE_CODES.items()}
    marks = {name: share for name, share in shares.items() if share <= 1.0} if codes is None else codes
    _rates(panels["rates"], result, marks)
    caption = textwrap.fill(_caption(result), int(CAPTION_CHARACTERS * _WIDTH))
    figure.supxlabel(f"{caption}{marked_legend(marks)}", fontsize=7.5)
    return figure


def _hazard(axes: Axes, other: Axes, result: RiskTargetedShare) -> None:
    """Hazard, and below it the fragilities of the building and of the models, where they rise."""
    from scipy.special import ndtr  # slow to import

    hazard = result.hazard
    axes.plot(hazard.sa_g, hazard.annual_rate, color=HAZARD.colour, linewidth=1.6, marker=HAZARD.marker)
    axes.set_yscale("log")
    label = result.measure.label
    other.set_xlabel(f"{label} (g)")
    axes.set_ylabel("annual rate (1/year)")
    axes.set_title("Hazard", loc="left")
    for one in (axes, other):
        grid_lines(one)
        one.set_xscale("log")
        _name_values(one.xaxis)
    sa_g = np.geomspace(hazard.sa_g[0], hazard.sa_g[-1], 401)
    for model, share, role, name in (
        ("real", None, SLIDE, SLIDE.name),
        ("attached", result.code_share, CODE, f"{CODE.name}, {result.code_share:g}"),
        ("attached", 1.0, ATTACHED, ATTACHED.name),
    ):
        is_share = pl.col("share").is_null() if share is None else pl.col("share") == share
        fit = result.fragilities.filter(is_share, model=model).row(0, named=True)
        capacities = result.capacities.filter(is_share, model=model)["capacity"].sort().to_numpy()
        if fit["dispersion"] > 0.0:
            other.plot(
                sa_g, ndtr(np.log(sa_g / fit["median"]) / fit["dispersion"]), **role.look, linewidth=1.8, label=name
            )
        levels: FloatArray = (np.arange(len(capacities)) + 0.5) / len(capacities)
        other.plot(capacities, levels, color=role.colour, linestyle="", marker=role.marker, markersize=3.5)
    other.set_ylim(0.0, 1.0)
    known = result.capacities["capacity"].to_numpy()
    for panel in (axes, other):
        panel.xaxis.set_minor_formatter(NullFormatter())
        panel.set_xlim(max(hazard.sa_g[0], 0.5 * known.min()), min(hazard.sa_g[-1], 1.5 * known.max()))
    other.set_ylabel("probability")
    other.set_title(f"Probability of {result.limit.text}", loc="left")
    other.legend(frameon=False, fontsize=8.0)


def _rates(axes: Axes, result: RiskTargetedShare, codes: Mapping[str, float]) -> None:
    """Rate with goods that slide over that of models against the share, with its band, the answer and codes."""
    curve = result.curve.drop_nulls("real_over_model")
    share, ratio = curve["fraction"].to_numpy(), curve["real_over_model"].to_numpy()
    banded = curve.drop_nulls("real_over_model_low")
    percent = f"{100.0 * result.confidence:g} %"
    if banded.height:
        axes.fill_between(
            banded["fraction"],
            banded["real_over_model_low"],
            banded["real_over_model_high"],
            color=SLIDE.colour,
            alpha=0.18,
            linewidth=0.0,
            label=f"{percent} interval over the motions",
        )
    axes.plot(share, ratio, color=SLIDE.colour, linewidth=2.0, label=f"{OVER_MODEL}, annual rate")
    axes.axhline(1.0, color=INK, linewidth=0.8)
    text = f"risk-targeted share {result.value:.2f}"
    if result.interval is not None:
        text += f" [{result.interval[0]:.2f}, {result.interval[1]:.2f}]"
        axes.plot(result.interval, [1.0, 1.0], color=ADVISED.colour, linewidth=3.0, solid_capstyle="butt", zorder=4)
    place = result.real / result.model
    axes.plot([result.value], [place], **ADVISED.mark, markersize=7.0, label=text, zorder=5)
    effective = result.effective
    if effective is not None and np.isfinite(effective.value):
        label = f"{EFFECTIVE} at the design intensity {effective.value:.2f}"
        axes.axvline(effective.value, color=ADVISED.colour, linewidth=1.3, linestyle=(0, (1, 2)), label=label)
    axes.set_yscale("log")
    _name_values(axes.yaxis)
    axes.set_xlim(-0.01, 1.01)
    axes.set_xlabel(SHARE)
    axes.set_ylabel(f"{OVER_MODEL}, annual rate\n(above 1: the model is unsafe)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    mark_codes(axes, codes)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=1, frameon=False)
    axes.figure.suptitle(f"{result.value:.2f} of the goods attached: {KIND_TEXTS[result.kind]}", fontsize=9.5)


def _name_values(axis: Axis) -> None:
    """Name 1, 2 and 5 in each decade of a logarithmic axis."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def _caption(result: RiskTargetedShare) -> str:
    metadata = result.metadata
    hazard = result.hazard.label or "hazard as given"
    tail = "extrapolated beyond its ends" if metadata["extrapolate"] else "cut at its ends"
    damping = "C of the building" if metadata["damping"] == "same" else "ratio in the model's own modes"
    return plain(
        f"{metadata['motions']} motions, scaled to all intensities; {result.estimator} fragilities; {hazard}, {tail}; "
        f"damping of the models: {damping}"
    )


KIND_TEXTS: Final[dict[Kind, str]] = {
    "stuck": "no goods slide up to the limit, so that all of them act as mass",
    "root": "one share gives the annual rate with sliding goods",
    "multiple": "several shares give the annual rate with sliding goods, the largest counts",
    "zero": "no share gives a lower rate than sliding goods do, so that none needs to be attached",
    "one": "even with all goods attached the model exceeds the limit less often than with sliding goods",
}
"""What each kind means."""
_LABEL: Final = 21
_RATES: Final = (-22, 34, 13, 26)
_CHANGES: Final = (-30, 22, 10, 12, 16)


def risk_text(result: RiskTargetedShare) -> str:
    """Return `RiskTargetedShare.text`."""
    percent = f"{100.0 * result.confidence:g} %"
    metadata = result.metadata
    motions = counted(metadata["motions"], "motion")
    lines = [
        f"risk-targeted share  {result.value:.3f}{_interval(result.interval, percent)}",
        f"                     {KIND_TEXTS[result.kind]}",
        f"limit                {result.limit.text} under {motions}; {result.measure.label}, "
        f"{result.estimator} fragilities",
        f"hazard               {result.hazard.label or 'as given'}: {result.hazard.sa_g[0]:g} to "
        f"{result.hazard.sa_g[-1]:g} g{', extrapolated' if metadata['extrapolate'] else ''}",
    ]
    effective = result.effective
    if effective is not None:
        level = result.hazard.intensity(metadata["design_rate"])
        note = f"at {level:.3g} g, {1.0 / metadata['design_rate']:.0f} years"
        why = "" if math.isfinite(effective.value) else f": {EFFECTIVE_KINDS[effective.kind]}"
        lines.append(f"effective fraction   {effective.value_text}{_interval(effective.interval, percent)} {note}{why}")
    lines += [
        "",
        f"Annual rate of exceeding the limit, with its {percent} interval over the motions",
        text_line(("model", "rate (1/year)", "in 50 years", "slide / model"), _RATES),
    ]
    for row in result.rates.iter_rows(named=True):
        name = model_name(row["model"]) + (f", {row['share']:g}" if row["model"] == "code" else "")
        rate = interval_text(row["rate"], row["rate_low"], row["rate_high"], ".3g")
        ratio = interval_text(row["real_over_model"], row["real_over_model_low"], row["real_over_model_high"], ".2f")
        ratio = "" if row["model"] == "real" else ratio
        lines.append(text_line((name, rate, f"{100.0 * row['probability_50_years']:.2g} %", ratio), _RATES))
    lines += [
        "",
        "What the share depends on",
        text_line(("changed", "share", "kind", "slide rate", "slide / code"), _CHANGES),
    ]
    for row in result.sensitivity.iter_rows(named=True):
        name = f"{row['parameter']} {row['setting']}".strip()
        share = interval_text(row["value"], row["low"], row["high"], ".2f")
        cells = (name, share, row["kind"], f"{row['real_rate']:.2g}", number_text(row["real_over_code"]))
        lines.append(text_line(cells, _CHANGES))
    return "\n".join([*lines, "", *remark_lines(result.remarks, _LABEL)])


def _interval(ends: tuple[float, float] | None, percent: str) -> str:
    return "" if ends is None else f" ({percent} interval {ends[0]:.2f} to {ends[1]:.2f})"
