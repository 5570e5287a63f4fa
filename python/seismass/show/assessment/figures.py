"""Figures of an assessment: real over model drift against lambda, drift by storey and model, slip by floor."""

from __future__ import annotations

import textwrap
from typing import Any, Final

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.assessment.models import ADVISED, ATTACHED, BARE, CODE, NAMES, REAL, REAL_HIGH, REAL_LOW
from seismass.assessment.result import Assessment, shown_figures
from seismass.base.values import FloatArray
from seismass.media.result import named_figure
from seismass.media.style import BLUE, GREEN, GREY, INK, STYLE, VERMILION
from seismass.model.codes import AS_STATED, MARK, NOT_CHECKED, VERIFIED
from seismass.show.assessment.tables import AssessmentTables, Fraction, assessment_tables
from seismass.show.effective_mass.figures import STORAGE_CODES, marked_legend

PURPLE: Final = "#CC79A7"
DASH: Final = (0, (5, 2))
DOT: Final = (0, (1, 1.5))
DASH_DOT: Final = (0, (6, 1.5, 1, 1.5))

FRICTION_LOOKS: Final[dict[str, tuple[str, Any, str, str]]] = {
    REAL: (BLUE, "-", "o", "as stated"),
    REAL_HIGH: (VERMILION, DASH, "^", "upper bound"),
    REAL_LOW: (GREEN, DASH_DOT, "v", "lower bound"),
}
"""Colour, line, marker and name of each friction."""
MODEL_LOOKS: Final[dict[str, tuple[str, Any, str]]] = {
    REAL: (BLUE, "-", "o"),
    ADVISED: (VERMILION, DASH, "s"),
    CODE: (PURPLE, DASH_DOT, "D"),
    ATTACHED: (INK, DOT, "^"),
    BARE: (GREY, (0, (8, 2)), "v"),
}
"""Colour, line and marker of each model."""


def assessment_figures(result: AssessmentTables) -> dict[str, Figure]:
    """Return the figures of an assessment that have something to show, by name."""
    fractions = any(np.isfinite(one.value) for one in result.effective.values())
    return {name: _drawn(result, name) for name in shown_figures(fractions, result.storeys, result.slip)}


def assessment_figure(result: Assessment, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    return _drawn(assessment_tables(result), named_figure(result, name))


def _drawn(result: AssessmentTables, name: str) -> Figure:
    draw = {"effective_fraction": fraction_figure, "drift": drift_figure, "slip": slip_figure}
    with mpl.rc_context(STYLE):
        figure = draw[name](result)
        # Lay out once, not again for every file.
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
    return figure


def fraction_figure(result: AssessmentTables) -> Figure:
    """Mean largest drift with sliding goods over that of the model, against the share attached."""
    figure = Figure(figsize=(6.8, 5.9), layout="constrained")
    axes = figure.add_subplot()
    low, high = result.mu_factors
    factors = {REAL: "", REAL_HIGH: rf", {high:g} $\mu$", REAL_LOW: rf", {low:g} $\mu$"}
    for model, effective in result.effective.items():
        if not np.isfinite(effective.value):
            continue
        colour, line, marker, name = FRICTION_LOOKS[model]
        curve = effective.curve.filter(pl.col("storey") == 0).sort("fraction")
        share = curve["fraction"].to_numpy()
        # A model that collapses drifts without limit, of which there is no ratio to draw.
        ratio, lowest, highest = (
            np.where(curve["ratio"].to_numpy() > 0.0, curve[name].to_numpy(), np.nan)
            for name in ("ratio", "ratio_low", "ratio_high")
        )
        if model == REAL and curve["ratio_low"].null_count() == 0:
            label = f"{100.0 * effective.confidence:g} % interval over the motions, friction as stated"
            axes.fill_between(share, lowest, highest, color=colour, alpha=0.15, linewidth=0.0, label=label)
        label = rf"friction {name}{factors[model]}: $\lambda_{{eff}}$ = {_value(effective)}"
        axes.plot(share, ratio, color=colour, linestyle=line, linewidth=1.7, label=label, marker=marker, markevery=[])
        at = effective.real / effective.model
        axes.plot([effective.value], [at], color=colour, marker=marker, markersize=7.5, clip_on=False, zorder=5)
    axes.axhline(1.0, color=INK, linewidth=0.9)
    axes.set_xlim(0.0, 1.0)
    _mark_shares(axes, result)
    axes.set_xlabel(r"share $\lambda$ of the goods present that is attached as mass")
    axes.set_ylabel("largest storey drift, mean over the motions:\ngoods slide / model (above 1: the model is unsafe)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(loc="outside upper center", ncols=1, frameon=False)
    shown = STORAGE_CODES if result.code["use"] == "storage" else {}
    figure.supxlabel(f"{_caption(result)}{marked_legend(shown)}", fontsize=7.5)
    return figure


def _value(effective: Fraction) -> str:
    if effective.interval is None or not np.isfinite(effective.interval).all():
        return f"{effective.value:.2f}"
    return f"{effective.value:.2f} [{effective.interval[0]:.2f}, {effective.interval[1]:.2f}]"


def _mark_shares(axes: Axes, result: AssessmentTables) -> None:
    """Mark the advised share and the code's, and name those of other codes at the upper edge."""
    code, present = result.code, result.present_share
    if result.advised is not None:
        label = f"advised: {result.advised:.2f} of the goods present"
        axes.axvline(result.advised, color=INK, linestyle=DASH, linewidth=1.2, label=label)
    if code["share_of_design_live_load"] <= present:
        label = (
            f"{_plain(code['code'])}: {code['share_of_design_live_load']:.3g} of the design live load{_unchecked(code)}"
        )
        axes.axvline(
            code["share_of_design_live_load"] / present, color=PURPLE, linestyle=DASH_DOT, linewidth=1.4, label=label
        )
    if code["use"] != "storage":
        return
    marks = {name: share / present for name, share in STORAGE_CODES.items() if share <= present}
    upper = axes.secondary_xaxis("top")
    names = [f"{name} {STORAGE_CODES[name]:g}" for name in marks]
    upper.set_xticks(list(marks.values()), names, rotation=35.0, ha="left", fontsize=7.0)


def drift_figure(result: AssessmentTables) -> Figure:
    """Mean peak drift of each storey by model, with 16 and 84 % over the motions, beside the limit."""
    storeys, limit, names = result.storeys, result.drift_limit, result.storey_names
    scale = 1e3 if limit is None else 1e2
    models = [model for model in MODEL_LOOKS if model in set(storeys.drop_nulls("mean")["model"])]
    figure = Figure(figsize=(6.8, 2.2 + 0.85 * len(names)), layout="constrained")
    axes = figure.add_subplot()
    spacing = 0.15
    handles = []
    for number, model in enumerate(models):
        colour, line, marker = MODEL_LOOKS[model]
        rows = storeys.filter(pl.col("model") == model).sort("storey")
        mean, low, high = (scale * rows[name].cast(pl.Float64).to_numpy() for name in ("mean", "p16", "p84"))
        height = rows["storey"].to_numpy() + spacing * (0.5 * (len(models) - 1) - number)
        axes.hlines(height, low, high, color=colour, linewidth=1.3, alpha=0.85)
        for end in (low, high):
            axes.plot(end, height, color=colour, linestyle="", marker="|", markersize=5.0)
        axes.plot(mean, height, color=colour, linestyle=line, linewidth=1.2)
        axes.plot(
            mean,
            height,
            color=colour,
            linestyle="",
            marker=marker,
            markersize=5.5,
            markeredgecolor="white",
            markeredgewidth=0.5,
        )
        handles.append(
            Line2D(
                [],
                [],
                color=colour,
                linestyle=line,
                linewidth=1.2,
                marker=marker,
                markersize=5.5,
                label=_model_label(result, model),
            )
        )
    if limit is not None:
        axes.axvline(scale * limit, color=INK, linewidth=1.4)
        handles.append(Line2D([], [], color=INK, linewidth=1.4, label=f"limit, {scale * limit:g} %"))
    axes.set_xlim(0.0, None)
    axes.set_ylim(0.5, len(names) + 0.5)
    labels = [f"{number} {name}".strip() for number, name in enumerate(names, start=1)]
    axes.set_yticks(range(1, len(names) + 1), [_plain(label) for label in labels])
    axes.set_ylabel("storey")
    unit = "mm" if limit is None else "% of the height"
    axes.set_xlabel(f"peak storey drift, {unit}: mean over the motions, and from 16 to 84 % of them")
    axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
    for edge in np.arange(1.5, len(names)):
        axes.axhline(edge, color=GREY, alpha=0.35, linewidth=0.6)
    figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False)
    figure.supxlabel(_caption(result), fontsize=7.5)
    return figure


def slip_figure(result: AssessmentTables) -> Figure:
    """Peak and residual slip of the goods of each floor, by friction, with their scatter over the motions."""
    slip = result.slip
    kinds = list(dict.fromkeys(slip.sort("floor", maintain_order=True).select("floor", "goods").iter_rows()))
    models = [model for model in FRICTION_LOOKS if model in set(slip["model"])]
    figure = Figure(figsize=(6.8, 2.1 + 0.75 * len(kinds)), layout="constrained")
    axes = figure.add_subplot()
    places = {kind: number for number, kind in enumerate(kinds, start=1)}
    handles = []
    for number, model in enumerate(models):
        colour, _, marker, name = FRICTION_LOOKS[model]
        rows = slip.filter(pl.col("model") == model).sort("floor", maintain_order=True)
        offset = 0.22 * (0.5 * (len(models) - 1) - number)
        height = np.array([places[kind] + offset for kind in rows.select("floor", "goods").iter_rows()])

        def column(of: str, table: pl.DataFrame = rows) -> FloatArray:
            values: FloatArray = 1e3 * table[of].cast(pl.Float64).to_numpy()
            return values

        axes.hlines(height, column("peak_p16"), column("peak_p84"), color=colour, linewidth=1.5)
        for end in ("peak_p16", "peak_p84"):
            axes.plot(column(end), height, color=colour, linestyle="", marker="|", markersize=6.0)
        axes.plot(column("peak_mean"), height, color=colour, linestyle="", marker=marker, markersize=6.0)
        axes.plot(column("peak_max"), height, color=colour, linestyle="", marker="x", markersize=4.5)
        axes.plot(
            column("residual_mean"),
            height,
            color=colour,
            linestyle="",
            marker=marker,
            markersize=6.0,
            markerfacecolor="white",
        )
        mu = rows["mu_s"].unique().to_list()
        value = rf", $\mu_s$ = {mu[0]:.3g}" if len(mu) == 1 else ""
        handles.append(Line2D([], [], color=colour, linewidth=1.5, marker=marker, label=f"friction {name}{value}"))
    handles += [
        Line2D([], [], color=GREY, linewidth=1.5, marker="o", label="peak: mean, and 16 to 84 % of the motions"),
        Line2D([], [], color=GREY, linestyle="", marker="x", markersize=4.5, label="peak: largest"),
        Line2D([], [], color=GREY, linestyle="", marker="o", markerfacecolor="white", label="residual: mean"),
    ]
    names = result.storey_names
    labels = [" ".join(part for part in (str(floor), names[floor - 1], goods) if part) for floor, goods in kinds]
    axes.set_yticks(range(1, len(kinds) + 1), [_plain(label) for label in labels])
    axes.set_ylim(0.5, len(kinds) + 0.5)
    axes.set_xlim(left=0.0)
    if not slip["peak_max"].max():
        axes.set_xlim(0.0, 1.0)
        axes.text(0.5, 0.5, "no goods slide", transform=axes.transAxes, ha="center", va="center")
    axes.margins(x=0.05)
    axes.set_ylabel("floor")
    axes.set_xlabel("slip of the goods (mm)")
    axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
    for edge in np.arange(1.5, len(kinds)):
        axes.axhline(edge, color=GREY, alpha=0.35, linewidth=0.6)
    figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False)
    figure.supxlabel(_caption(result), fontsize=7.5)
    return figure


def _unchecked(code: dict[str, Any]) -> str:
    """Mark and words of a code whose fraction was not read in its text."""
    return "" if code["status"] in (VERIFIED, AS_STATED) else f" {MARK} {NOT_CHECKED}"


def _model_label(result: AssessmentTables, model: str) -> str:
    if model == ADVISED and result.advised is not None:
        return rf"advised, $\lambda$ = {result.advised:.2f} of the goods"
    if model == CODE:
        code = result.code
        return f"{_plain(code['code'])}, {code['share_of_design_live_load']:.3g} of the live load{_unchecked(code)}"
    return {REAL: "goods slide, friction as stated", ATTACHED: "all goods attached", BARE: "no goods attached"}.get(
        model, NAMES[model]
    )


def _caption(result: AssessmentTables) -> str:
    document = result.document
    suite = document["suite"]
    kind = " (synthetic, none recorded)" if suite["synthetic"] == len(suite["motions"]) else ""
    lines = [f"{document['name']};  {len(suite['motions'])} motions{kind}"]
    if document["target"] is not None and result.scaling is not None:
        lines.append(f"scaled to {document['target']['label']}")
    return _plain("\n".join(textwrap.fill(line, 110) for line in lines))


def _plain(text: str) -> str:
    """Return a text of the user's in which matplotlib finds no formula."""
    return text.replace("$", r"\$")
