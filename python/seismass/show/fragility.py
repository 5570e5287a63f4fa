"""Figures and text of fragility."""

from __future__ import annotations

import math
import textwrap
from itertools import cycle
from typing import Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from seismass.base.values import FloatArray, counted
from seismass.media.result import named_figure
from seismass.media.roles import GREY, INK, LIMIT, MODELS, PAPER, SLIDE, model_name
from seismass.media.style import SERIES, drawing, grid_lines, plain, say
from seismass.media.text_table import ends_text, number_text
from seismass.studies.fragility.limits import LimitState
from seismass.studies.fragility.result import FragilityAnalysis

_MARKERS: Final = ("o", "s", "^", "D", "v", "P")
NEARLY_ONE: Final = 0.97
"""Probability at which the axis of a curve may end."""
_FRACTILE_LOOKS: Final[dict[str, Any]] = {"p16": (0, (1.2, 1.2)), "p50": "-", "p84": (0, (5, 2))}
_FRACTILE_NAMES: Final = {"p16": "16 %", "p50": "median", "p84": "84 %"}


def analysis_figure(result: FragilityAnalysis, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    figure_name = named_figure(result, name)
    if figure_name == "fragility":
        return fragility_figure(result)
    return demand_figure(result, result.demands[figure_name.removeprefix("demand_")])


@drawing()
def fragility_figure(result: FragilityAnalysis) -> Figure:
    """Return fragility curves of all models, one panel per limit, with bootstrap bands over the motions. Points are the
    share of motions that exceed the limit, at each stripe or by their capacities.
    """
    count = len(result.limits)
    columns = min(count, 2)
    rows = -(-count // columns)
    figure = Figure(figsize=(max(4.4 * columns, 6.4), 0.9 + 3.3 * rows), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, limit in zip(panels, result.limits, strict=False):
        for model, (look, marker) in _looks(result).items():
            if (model, limit.name) in result.fits:
                _curve(axes, result, limit, model, look, marker)
        axes.set_title(plain(limit.text))
        axes.set_ylim(-0.02, 1.02)
        axes.set_xlim(0.0, _highest_drawn(result, limit))
        axes.set_xlabel(_intensity_label(result))
        axes.set_ylabel("probability of exceedance")
        grid_lines(axes)
        fits = [fit for (_, name), fit in result.fits.items() if name == limit.name]
        if all(fit.kind == "never" for fit in fits):
            say(axes, "never exceeded")
    for axes in panels[count:]:
        axes.set_axis_off()
    handles: list[Any] = [
        Line2D([], [], **look, marker=marker, markersize=4.0, label=plain(model_name(model)))
        for model, (look, marker) in _looks(result).items()
    ]
    if any(len(fit.samples) for fit in result.fits.values()):
        share = f"{100.0 * result.metadata['confidence']:g} % interval"
        handles.append(Patch(facecolor=GREY, alpha=0.3, label=share))
    if count < len(panels):
        panels[count].legend(handles=handles, loc="center", frameon=False)
    else:
        figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
    figure.supxlabel(_caption(result), fontsize=7.5)
    return figure


def _highest_drawn(result: FragilityAnalysis, limit: LimitState) -> float | None:
    """Intensity up to which curves are drawn: to where the last of them is nearly one, or all motions are beyond it."""
    curves = result.curves.filter(pl.col("limit") == limit.name)
    if curves.is_empty():
        return None
    known = [
        rows.filter(pl.col("probability") >= NEARLY_ONE)["intensity"].min()
        for _, rows in curves.group_by("model", maintain_order=True)
    ]
    ends = [float(end) for end in known if isinstance(end, float)]
    seen = [observed(result, limit, str(model))[0] for model in curves["model"].unique(maintain_order=True)]
    points = np.concatenate([intensities[np.isfinite(intensities)] for intensities in seen])
    nearly = [1.15 * max(ends)] if ends else []
    nearly += [1.25 * float(points.max())] if points.size else []
    return min(nearly) if nearly else None


def _looks(result: FragilityAnalysis) -> dict[str, tuple[dict[str, Any], str]]:
    """Line and marker of each model: those of its role, or the next of the series for a scene of the user's."""
    looks = {}
    for model, look, marker in zip(result.models, cycle(SERIES), cycle(_MARKERS), strict=False):
        role = MODELS.get(model)
        looks[model] = (look, marker) if role is None else (role.look, role.marker)
    return looks


def _curve(
    axes: Axes, result: FragilityAnalysis, limit: LimitState, model: str, look: dict[str, Any], marker: str
) -> None:
    curve = result.curves.filter(limit=limit.name, model=model)
    x = curve["intensity"].to_numpy()
    y, low, high = (
        curve[name].cast(pl.Float64).fill_null(np.nan).to_numpy()
        for name in ("probability", "probability_low", "probability_high")
    )
    axes.fill_between(x, low, high, color=look["color"], alpha=0.15, linewidth=0.0)
    axes.plot(x, y, **look, linewidth=1.8, gid=f"{limit.name}:{model}")
    intensities, share = observed(result, limit, model)
    seen = intensities <= x[-1]
    axes.plot(
        intensities[seen],
        share[seen],
        color=look["color"],
        linestyle="",
        marker=marker,
        markersize=3.6,
        markerfacecolor=PAPER,
        gid=f"points:{limit.name}:{model}",
    )


def observed(result: FragilityAnalysis, limit: LimitState, model: str) -> tuple[FloatArray, FloatArray]:
    """Return intensities and the share of motions that exceed a limit there, without any fit: at stripes, or for a hunt
    (i - 0.5)/n at the i-th of n capacities. A cloud has none.
    """
    if result.method == "hunt_fill":
        capacities = result.capacities.filter(limit=limit.name, model=model)
        intensities = np.sort(capacities["capacity"].drop_nulls().to_numpy())
        return intensities, (np.arange(1, len(intensities) + 1) - 0.5) / max(capacities.height, 1)
    if result.method == "cloud":
        return np.empty(0), np.empty(0)
    level = "stripe" if "stripe" in result.runs.columns else "intensity"
    shares = (
        result.runs.filter(model=model)
        .group_by(level)
        .agg(share=(pl.col(limit.column) > limit.value).mean())
        .sort(level)
    )
    return shares[level].to_numpy(), shares["share"].to_numpy()


@drawing()
def demand_figure(result: FragilityAnalysis, limit: LimitState) -> Figure:
    """Return demand by intensity, a panel per model with the quantity: lines and 16, 50 and 84 % fractiles given
    intensity where motions are scaled, else points. A cross is the last point before a collapse.
    """
    column, scale = limit.column, limit.shown_scale
    models = [model for model in result.models if result.traces(model, column)]
    scaled = not result.capacities.is_empty()
    figure = Figure(figsize=(max(1.0 + 2.9 * len(models), 6.4), 4.0), layout="constrained")
    panels = figure.subplots(1, len(models), squeeze=False, sharex=True, sharey=True)[0]
    fractiles = result.fractiles().filter(demand_column=column) if scaled else None
    for axes, model in zip(panels, models, strict=True):
        for x, y in result.traces(model, column):
            finite = np.isfinite(y)
            if fractiles is None:
                axes.loglog(scale * y[finite], x[finite], color=INK, linestyle="", marker="o", markersize=3.0)
                continue
            points, values = np.append(0.0, x), np.append(0.0, np.where(finite, y, np.nan))
            axes.plot(scale * values, points, color=GREY, linewidth=0.7, alpha=0.8, gid="motion")
            fell = np.flatnonzero(~finite)
            if len(fell):
                axes.plot(scale * values[fell[0]], points[fell[0]], color=INK, marker="x", markersize=4.5)
        if fractiles is not None:
            rows = fractiles.filter(model=model)
            for name, style in _FRACTILE_LOOKS.items():
                value = rows[name].fill_null(np.nan).to_numpy()
                shown = np.where(np.isfinite(value), scale * value, np.nan)
                levels = np.append(0.0, rows["level"].to_numpy())
                axes.plot(np.append(0.0, shown), levels, color=SLIDE.colour, linestyle=style, linewidth=1.8)
        fallen = result.runs.filter(model=model, status="collapsed").height
        name = plain(model_name(model))
        axes.set_title(name if scaled or not fallen else f"{name}, {fallen} collapsed")
        axes.set_xlabel(limit.label)
        grid_lines(axes)
    if limit.quantity != "collapse":
        bounds = [each.value for each in result.limits if each.column == column]
        for axes in panels:
            for bound in bounds:
                axes.axvline(scale * bound, color=LIMIT.colour, linestyle=LIMIT.line, linewidth=1.1)
        if scaled:
            panels[0].set_xlim(0.0, 2.0 * scale * max(bounds) if max(bounds) > 0.0 else None)
            panels[0].set_ylim(0.0, _highest_shown(result, column, 2.0 * max(bounds)))
    panels[0].set_ylabel(_intensity_label(result))
    handles = [Line2D([], [], color=LIMIT.colour, linestyle=LIMIT.line, label=LIMIT.name)]
    if not scaled:
        handles.append(Line2D([], [], color=INK, linestyle="", marker="o", markersize=3.0, label="each motion"))
    else:
        handles.append(Line2D([], [], color=GREY, linewidth=0.8, label="each motion"))
        handles += [
            Line2D([], [], color=SLIDE.colour, linestyle=style, label=_FRACTILE_NAMES[name])
            for name, style in _FRACTILE_LOOKS.items()
        ]
        handles.append(Line2D([], [], color=INK, linestyle="", marker="x", markersize=4.5, label="before collapse"))
    figure.legend(handles=handles, loc="outside upper center", ncols=3, frameon=False)
    figure.supxlabel(_caption(result), fontsize=7.5)
    return figure


def _highest_shown(result: FragilityAnalysis, column: str, demand: float) -> float | None:
    """Intensity at which nearly all motions are beyond the demands that are shown."""
    seen = [
        float(x[np.flatnonzero(y <= demand)[-1]])
        for model in result.models
        for x, y in result.traces(model, column)
        if (y <= demand).any()
    ]
    return 1.05 * max(seen) if seen else None


def _intensity_label(result: FragilityAnalysis) -> str:
    unit = f" ({result.measure.unit})" if result.measure.unit else ""
    return f"{result.measure.label}{unit}"


def _caption(result: FragilityAnalysis) -> str:
    """One line on what the curves depend on."""
    method = {"hunt_fill": "incremental dynamic analysis", "stripes": "stripes", "cloud": "cloud"}[result.method]
    share = result.metadata.get("code_share")
    rule = "" if share is None else f";  code: {100.0 * share:g} % of the goods attached"
    return f"{method}, {result.motions.height} motions, whose scatter alone is shown{rule}"


_WIDTH: Final = 120
_METHODS: Final = {
    "hunt_fill": "incremental dynamic analysis",
    "stripes": "stripes",
    "cloud": "cloud",
}


def analysis_text(result: FragilityAnalysis) -> str:
    """Return the text of an analysis."""
    unit = f" ({result.measure.unit})" if result.measure.unit else ""
    motions = counted(result.motions.height, "motion")
    lines = [f"{_METHODS[result.method]}: {motions}, {result.runs.height} runs; intensity {result.measure.label}{unit}"]
    share = f"{100.0 * result.metadata['confidence']:g} %"
    for limit in result.limits:
        lines += ["", f"limit     {limit.text}"]
        fragilities = result.fragilities.filter(limit=limit.name)
        names = {name: model_name(name) for name in result.models}
        width = max(map(len, names.values())) + 2
        lines.append(f"  {'':{width}}{'median capacity':24}dispersion [{share} interval over the motions]")
        for row in fragilities.iter_rows(named=True):
            lines.append(f"  {names[row['model']]:{width}}{_fitted(row)}")
        missing = [name for name in result.models if name not in fragilities["model"].to_list()]
        lines += [f"  {names[name]:{width}}has no such quantity" for name in missing]
        lines += [
            _ratio(row, result.reference) for row in result.comparison.filter(limit=limit.name).iter_rows(named=True)
        ]
        rows = result.exceedance.filter(limit=limit.name)
        lines += [_exceedance(row, result.reference) for row in rows.iter_rows(named=True)]
    if result.remarks:
        lines.append("")
    for remark in result.remarks:
        lines += textwrap.wrap(remark, _WIDTH, initial_indent="remark    ", subsequent_indent=10 * " ")
    return "\n".join(lines)


def _fitted(row: dict[str, Any]) -> str:
    if row["kind"] in ("never", "always", "falling", "none"):
        words = {
            "never": f"never exceeded up to {row['highest']:.3g}",
            "always": f"always exceeded from {row['lowest']:.3g} on",
            "falling": "not exceeded more often at higher intensities: no curve",
            "none": "too few runs for a curve",
        }
        return words[row["kind"]]
    median = _known(row, "median", ".3g")
    if row["kind"] == "step":
        return f"{median:23} unknown, a step"
    return f"{median:23} {_known(row, 'dispersion', '.2f')}"


def _known(row: dict[str, Any], name: str, form: str) -> str:
    """A number with its interval; "none" where it is infinite."""
    ends = ends_text(row[f"{name}_low"], row[f"{name}_high"], form, infinite="none")
    return number_text(row[name], form, missing="unknown", infinite="none") + ends


def _ratio(row: dict[str, Any], reference: str) -> str:
    if row["median_ratio"] is None or not math.isfinite(row["median_ratio"]):
        return f"  capacity of {model_name(row['model'])} over {model_name(reference)}: not known"
    interval = ends_text(row["median_ratio_low"], row["median_ratio_high"], infinite="none")
    words = f"{model_name(row['model'])} over {model_name(reference)}"
    return f"  capacity of {words}: {row['median_ratio']:.2f}{interval}"


def _exceedance(row: dict[str, Any], reference: str) -> str:
    def percent(name: str) -> str:
        if row[name] is None:
            return "unknown"
        ends = ends_text(row[f"{name}_low"], row[f"{name}_high"], ".1f", scale=100.0, infinite="none")
        return f"{100.0 * row[name]:.1f} %{ends}"

    if row["model"] == reference:
        return f"  at intensity {row['intensity']:.3g}: {model_name(reference)} {percent('reference')}"
    difference = ""
    if row["difference"] is not None:
        points = f"{number_text(row['difference'], '+.1f', scale=100.0)} points"
        ends = ends_text(row["difference_low"], row["difference_high"], "+.1f", scale=100.0, infinite="none")
        difference = f"; {points}{ends}"
    share = "unknown" if row["probability"] is None else f"{100.0 * row['probability']:.1f} %"
    model = f"at {row['intensity']:.3g}: {model_name(row['model'])} {share}"
    return f"  {model}, {model_name(reference)} {percent('reference')}{difference}"
