"""Figures of an assessment: what each storey uses of its limit, real over model drift against lambda, spectra."""

from __future__ import annotations

import textwrap
from typing import Any, Final, NamedTuple

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seismass.assessment.models import ATTACHED, CODE, SLIDING, SLIDING_HIGH, SLIDING_LOW
from seismass.assessment.result import Assessment
from seismass.assessment.structure import slip_of_base
from seismass.base.units import STANDARD_GRAVITY
from seismass.effective_mass import EffectiveMass
from seismass.media.result import named_figure
from seismass.media.roles import ADVISED as ADVISED_ROLE
from seismass.media.roles import BARE as BARE_ROLE
from seismass.media.roles import CODE as CODE_ROLE
from seismass.media.roles import (
    EFFECTIVE,
    GREY,
    INK,
    LIMIT,
    MODELS,
    MU,
    OVER_MODEL,
    PAPER,
    SHARE,
    SLIDE,
    SPECTRUM,
    TARGET,
    lettered,
)
from seismass.media.style import PERIOD_TICKS, drawing, plain
from seismass.media.text_table import ends_text
from seismass.model.codes import MARK, NOT_CHECKED
from seismass.show.assessment.tables import StoreyDrifts, most_slip, storey_drifts
from seismass.show.effective_mass import STORAGE_CODES, marked_legend

FRICTION_NAMES: Final = {SLIDING: "as stated", SLIDING_HIGH: "upper bound", SLIDING_LOW: "lower bound"}
"""What each friction is called, in the order of drawing."""


class Size(NamedTuple):
    """Width of a figure (inches), characters of a line of a label, of the caption, of the name of a storey and of a
    title, columns of the legend (panels stand side by side where there are two), and height of a row (inches).
    """

    width: float
    label: int
    caption: int
    name: int
    title: int
    columns: int
    row: float


PAPER_SIZE: Final = Size(7.6, 88, 110, 16, 60, 2, 0.5)
MOST_ROWS: Final = 10
"""Rows of the figure of the first sheet that are as high as asked for; twice as many elsewhere."""
PHONE_SIZE: Final = Size(3.4, 44, 54, 10, 34, 1, 0.5)
SHEET_SIZE: Final = Size(4.6, 60, 0, 0, 29, 2, 0.36)


def assessment_figures(result: Assessment, size: Size = PAPER_SIZE) -> dict[str, Figure]:
    """Return the figures of an assessment that have something to show, by name."""
    return {name: _drawn(result, name, size) for name in result.figure_names}


def sheet_figure(result: Assessment) -> Figure:
    """Return the figure of drifts and slips as the first sheet has it."""
    return _drawn(result, "drift", SHEET_SIZE)


def assessment_figure(result: Assessment, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    return _drawn(result, named_figure(result, name), PAPER_SIZE)


@drawing()
def _drawn(result: Assessment, name: str, size: Size) -> Figure:
    draw = {
        "drift": drift_figure,
        "effective_fraction": fraction_figure,
        "spectrum": spectrum_figure,
    }
    figure = draw[name](result, size)
    # Lay out once, not again for every file.
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    return figure


def fraction_figure(result: Assessment, size: Size) -> Figure:
    """Mean largest drift with sliding goods over that of the model, against the share attached."""
    figure = Figure(figsize=(size.width, 5.9), layout="constrained")
    axes = figure.add_subplot()
    low, high = result.mu_factors
    factors = {SLIDING: "", SLIDING_HIGH: f", {high:g} {MU}", SLIDING_LOW: f", {low:g} {MU}"}
    for model, effective in result.effective.items():
        if not np.isfinite(effective.value):
            continue
        role, friction = MODELS[model], FRICTION_NAMES[model]
        curve = effective.curve.filter(pl.col("storey") == 0).sort("fraction")
        share = curve["fraction"].to_numpy()
        ratio, lowest, highest = (curve[name].to_numpy() for name in ("ratio", "ratio_low", "ratio_high"))
        if model == SLIDING and curve["ratio_low"].null_count() == 0:
            label = f"{100.0 * effective.confidence:g} % interval over the motions, friction as stated"
            axes.fill_between(
                share, lowest, highest, color=role.colour, alpha=0.15, linewidth=0.0, label=_wrapped(label, size)
            )
        label = _wrapped(f"friction {friction}{factors[model]}: {EFFECTIVE} {_value(effective)}", size)
        axes.plot(share, ratio, **role.look, linewidth=1.7, label=label, marker=role.marker, markevery=[])
        level = effective.real / effective.model
        axes.plot(
            [effective.value], [level], color=role.colour, marker=role.marker, markersize=7.5, clip_on=False, zorder=5
        )
    axes.axhline(1.0, color=INK, linewidth=0.9)
    axes.set_xlim(0.0, 1.0)
    _mark_shares(axes, result, size)
    axes.set_xlabel(SHARE)
    words = f"{OVER_MODEL}, capped mean of the largest drift (above 1: the model is unsafe)"
    axes.set_ylabel(textwrap.fill(words, size.label // 2 + 6))
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(loc="outside upper center", ncols=1, frameon=False)
    shown = STORAGE_CODES if result.code.use == "storage" else {}
    figure.supxlabel(f"{_caption(result, size)}{marked_legend(shown)}", fontsize=7.5)
    return figure


def _value(effective: EffectiveMass) -> str:
    ends = effective.suite_interval
    known = ends is not None and np.isfinite(ends).all()
    return f"{effective.value:.2f}{ends_text(*ends) if ends is not None and known else ''}"


def _mark_shares(axes: Axes, result: Assessment, size: Size) -> None:
    """Mark the advised share and the code's, and name those of other codes at the upper edge."""
    code, present = result.code, result.present_share
    if result.advised is not None:
        label = f"advised: {result.advised:.2f} of the goods present"
        axes.axvline(result.advised, **ADVISED_ROLE.look, linewidth=1.2, label=label)
    if result.code_share <= present:
        place = result.code_share / present
        unchecked = "" if code.checked else f" {MARK} {NOT_CHECKED}"
        label = (
            f"{plain(code.code)}: {place:.2f} of the goods present "
            f"({result.code_share:.3g} of the design live load{unchecked})"
        )
        axes.axvline(place, **MODELS[CODE].look, linewidth=1.4, label=_wrapped(label, size))
    if code.use != "storage" or size.columns == 1:  # a phone has no room for names
        return
    marks = {name: share / present for name, share in STORAGE_CODES.items() if share <= present}
    upper = axes.secondary_xaxis("top")
    names = [f"{name} {share:.2f}" for name, share in marks.items()]
    upper.set_xticks(list(marks.values()), names, rotation=35.0, ha="left", fontsize=7.0)


def drift_figure(result: Assessment, size: Size) -> Figure:
    """What each storey uses of its drift limit, and beside it the slip of its floor, ground at the bottom."""
    rows, slips = storey_drifts(result.storeys, result.governing), most_slip(result.slip)
    tall = 0.6 + size.row * min(len(rows), MOST_ROWS * (1 if size.caption == 0 else 2))
    stacked, count = size.columns == 1, 2 if slips else 1
    figure = Figure(figsize=(size.width, (tall + 0.35) * (count if stacked else 1) + 0.65), layout="constrained")
    figure.set_layout_engine("constrained", rect=(0.0, 0.0, 0.98, 1.0))
    shape, widths = ((count, 1), None) if stacked else ((1, count), (1.5, 1.0)[:count])
    panels = list(figure.subplots(*shape, sharey=not stacked, squeeze=False, width_ratios=widths).flat)
    base = slip_of_base(result.runs)
    labels = {} if base is None else {0: "base"}
    labels |= {row.storey: f"{row.storey} {row.name * bool(size.name)}".rstrip() for row in rows}
    for axes in panels:
        axes.set_ylim(0.5 if base is None else -0.5, len(rows) + 0.5)
        axes.set_yticks(list(labels), [plain(textwrap.fill(label, size.name or 9)) for label in labels.values()])
        axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
        for edge in np.arange(1.5, len(rows)):
            axes.axhline(edge, color=GREY, alpha=0.35, linewidth=0.6)
    _drift_panel(panels[0], result, rows, size)
    if slips:
        _slip_panel(panels[1], result, slips, base, size)
    if size.caption:
        figure.supxlabel(_caption(result, size), fontsize=7.5)
    return figure


def _title(axes: Axes, text: str, characters: int) -> None:
    """What a panel says, above it."""
    words = plain(textwrap.fill(lettered(text), characters))
    axes.set_title(words, loc="left", fontsize=9.0, fontweight="bold", pad=15.0)


def _below(axes: Axes, text: str, characters: int) -> None:
    """What an axis is, below it."""
    axes.set_xlabel(textwrap.fill(text, characters), fontsize=7.5)


def _at_edge(axes: Axes, height: float, text: str, colour: str = INK) -> None:
    """A value of a row, at the right of its panel."""
    axes.text(1.02, height, text, transform=axes.get_yaxis_transform(), va="center", fontsize=7.5, color=colour)


def _drift_panel(axes: Axes, result: Assessment, rows: list[StoreyDrifts], size: Size) -> None:
    """Drifts over the limit: goods that slide as a band, analyses as their numbers, the code's model as a tick."""
    limit, answer = result.drift_limit, bool(result.answer.analyses)
    scale, unit = result.units.drifts(ratio=limit is not None)
    known = [value for row in rows for value in (row.largest, row.code or 0.0, *(row.scatter or ()))]
    right = 1.08 * scale * max(*known, 0.0 if limit is None else 1.0)
    axes.set_xlim(0.0, right)
    near = 0.16 * right / (size.width if size.columns == 1 else 0.55 * size.width)
    for row in rows:
        if row.sliding is not None:
            low, high = (scale * end for end in row.sliding)
            axes.barh(row.storey, max(high - low, 0.004 * right), left=low, height=0.3, **SLIDE.band)
        if row.scatter is not None:
            low, high = (scale * end for end in row.scatter)
            axes.hlines(row.storey, low, high, color=SLIDE.colour, linewidth=1.0)
        if row.code is not None:
            axes.vlines(scale * row.code, row.storey - 0.3, row.storey + 0.3, color=CODE_ROLE.colour, linewidth=2.2)
        places = [scale * value for value in row.analyses.values()]
        apart_by = 0.17 if len(places) > 1 and abs(places[0] - places[1]) < near else 0.0
        for number, (digit, place) in enumerate(zip(row.analyses, places, strict=True)):
            height, face = row.storey + (apart_by, -apart_by)[number], GREY if digit == "1" else PAPER
            axes.plot(place, height, "o", markersize=9.5, color=INK, markerfacecolor=face, zorder=4)
            axes.annotate(digit, (place, height), fontsize=7.0, ha="center", va="center_baseline", zorder=5)
        text = f"{scale * row.largest:.0f} %" if limit is not None else f"{scale * row.largest:.2f} {unit}"
        _at_edge(axes, row.storey, lettered("\n".join(part for part in (text, row.model if answer else "") if part)))
    if limit is not None:
        axes.axvline(scale, color=LIMIT.colour, linewidth=1.4)
        words = f"limit, {100.0 * limit:g} % of the height "
        at_left = scale < 0.5 * right
        axes.text(scale, len(rows) + 0.53, words, ha="left" if at_left else "right", va="bottom", fontsize=7.5)
    _label_marks(axes, rows, scale, near)
    axes.set_ylabel("storey")
    over = "of the limit, %" if limit is not None else unit
    _below(axes, f"capped mean drift, {over}; thin line: 16 to 84 % of the motions", size.title)
    row = max(rows, key=lambda one: one.largest)
    used = f"drifts most, {scale * row.largest:.2f} {unit}"
    if limit is not None:
        used = f"uses {scale * row.largest:.0f} % of its drift limit"
    why = f": {row.model or 'the analysis'}" if answer else "; no answer" if result.effective else ", without goods"
    _title(axes, f"Storey {row.storey} {used}{why}", size.title)


def _label_marks(axes: Axes, rows: list[StoreyDrifts], scale: float, near: float) -> None:
    """Name the band and the tick once, where they are widest and farthest from other marks; beside crowded marks."""
    slides = [row for row in rows if row.sliding is not None]
    if not slides:
        return
    free = [min((abs(value - (one.code or 0.0)) for value in one.analyses.values()), default=1.0) for one in slides]
    widths = [one.sliding[1] - one.sliding[0] if one.sliding else 0.0 for one in slides]
    names = (
        (slides[int(np.argmax(widths))], -0.2, "top", SLIDE, max(widths)),
        (slides[int(np.argmax(free))], 0.28, "bottom", CODE_ROLE, max(free)),
    )
    for row, shift, side, role, room in names:
        place, ends = row.code or 0.0, row.sliding or (0.0, 0.0)
        marks = (*row.analyses.values(), *ends, place, *(row.scatter or ()))
        middle = scale * (place if role is CODE_ROLE else 0.5 * sum(ends))
        crowded = scale * room < 2.0 * near
        edge, ha = scale * max(marks) + 0.6 * near, "left"
        if edge > axes.get_xlim()[1] - 2.5 * near:  # no room at the right
            edge, ha = scale * min(marks) - 0.6 * near, "right"
        axes.text(
            edge if crowded else max(middle, 0.5 * near),
            row.storey + (0.5 * shift if crowded else shift),
            role.name,
            va=("top" if shift < 0.0 else "bottom") if crowded else side,
            ha=ha if crowded else "center",
            color=role.text,
            fontsize=7.5,
        )


def _slip_panel(
    axes: Axes, result: Assessment, slips: dict[int, dict[str, Any]], base: dict[str, Any] | None, size: Size
) -> None:
    """Slip at 84 % of the motions as a bar, its median as a tick, the clearance as a line, the largest as a number."""
    units = result.units
    clear = result.clearances
    shown = dict(slips)
    if base is not None:
        shown[0] = {"peak_p84": base["p84"], "peak_median": base["median"], "peak_max": base["most"], "goods": ""}
    for floor, row in shown.items():
        allowed, median = (row[name] / units.of("slip")[1] for name in ("peak_p84", "peak_median"))
        axes.barh(floor, allowed, height=0.3, **SLIDE.band)
        axes.vlines(median, floor - 0.15, floor + 0.15, color=SLIDE.colour, linewidth=1.6)
        words = [units.text("slip", row["peak_p84"]), f"largest {units.number('slip', row['peak_max'])}"]
        _at_edge(axes, floor, "\n".join([words[0], words[1]] if allowed else ["none"]))
        if floor in clear:
            place = clear[floor] / units.of("slip")[1]
            axes.vlines(place, floor - 0.4, floor + 0.4, color=INK, linewidth=1.4)
            words_of = f" clearance {units.number('slip', clear[floor], '.4g')}"
            axes.text(place, floor + 0.4, words_of, fontsize=7.5, va="top")
    most = max([row["peak_p84"] for row in shown.values()] + list(clear.values())) / units.of("slip")[1]
    axes.set_xlim(0.0, 1.3 * most or 1.0)
    _below(axes, f"slip, {units.unit('slip')}: bar 84 % of the motions, tick median", int(0.7 * size.title))
    floor = max(slips, key=lambda one: slips[one]["peak_p84"])
    text = f"Allow for {units.text('slip', slips[floor]['peak_p84'])} of slip on floor {floor}"
    _title(axes, text if slips[floor]["peak_max"] else "No goods slide", int(0.7 * size.title))


def spectrum_figure(result: Assessment, size: Size) -> Figure:
    """Mean and scatter of the spectra of the scaled motions beside the site spectrum, with the range of scaling."""
    table = result.spectra
    period = table["period"].to_numpy()
    figure = Figure(figsize=(size.width, 4.4), layout="constrained")
    axes = figure.add_subplot()
    low, mean, high = (table[name].to_numpy() / STANDARD_GRAVITY for name in ("p16", "mean", "p84"))
    motions = len(result.suite["motions"])
    axes.fill_between(period, low, high, color=SPECTRUM.colour, alpha=0.2, linewidth=0.0, label="16 to 84 % of them")
    axes.plot(period, mean, **SPECTRUM.look, linewidth=2.0, label=f"mean of {motions} motions, scaled")
    if table["target"].null_count() < table.height:
        wanted = table["target"].cast(pl.Float64).fill_null(np.nan).to_numpy() / STANDARD_GRAVITY
        axes.plot(period, wanted, **TARGET.look, linewidth=1.8, label=_wrapped("site spectrum", size))
    data = result.input
    bare, attached = data["period_bare"], data["period_attached"]
    axes.axvline(bare, **BARE_ROLE.look, linewidth=1.1, label=f"first period {bare:.3g} s, {BARE_ROLE.name}")
    role = MODELS[ATTACHED]
    axes.axvline(attached, **role.look, linewidth=1.3, label=f"first period {attached:.3g} s, {role.name}")
    if result.content["scaling"] is not None:
        first, last = result.content["scaling"]["periods"]
        text = f"range of scaling, {first:.2g} to {last:.2g} s"
        axes.axvspan(first, last, color=GREY, alpha=0.12, linewidth=0.0, label=text)
    axes.set_xscale("log")
    axes.set_xlim(period[0], period[-1])
    axes.set_ylim(0.0, None)
    ticks = [tick for tick in PERIOD_TICKS if period[0] <= tick <= period[-1]]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("period (s)")
    axes.set_ylabel("pseudo-acceleration, 5 % damping (g)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(loc="outside upper center", ncols=size.columns, frameon=False)
    figure.supxlabel(_caption(result, size), fontsize=7.5)
    return figure


def _wrapped(text: str, size: Size) -> str:
    return textwrap.fill(text, size.label)


def _caption(result: Assessment, size: Size) -> str:
    suite, target = result.suite, result.content["target"]
    kind = " (synthetic, none recorded)" if suite["synthetic"] == len(suite["motions"]) else ""
    lines = [f"{result.name};  {len(suite['motions'])} motions{kind}"]
    if target is not None and "scaling" in result.tables:
        lines.append(f"scaled to {target['label']}")
    return plain("\n".join(textwrap.fill(line, size.caption) for line in lines))
