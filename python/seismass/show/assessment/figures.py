"""Figures of an assessment: real over model drift against lambda, drift by storey and model, slip by floor."""

from __future__ import annotations

import textwrap
from typing import Any, Final, NamedTuple

import numpy as np
import polars as pl
from markupsafe import Markup, escape
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.assessment.answer import PAIR
from seismass.assessment.models import ADVISED, ATTACHED, BARE, CODE, NAMES, SLIDING, SLIDING_HIGH, SLIDING_LOW
from seismass.assessment.result import Assessment, shown_figures
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, counted
from seismass.media.result import named_figure
from seismass.media.roles import ADVISED as ADVISED_ROLE
from seismass.media.roles import BARE as BARE_ROLE
from seismass.media.roles import (
    EFFECTIVE,
    GREY,
    INK,
    LAMBDA,
    LIMIT,
    MODELS,
    MU,
    OVER_MODEL,
    SHARE,
    SLIDE,
    SPECTRUM,
    TARGET,
    apart,
    sentence_html,
)
from seismass.media.style import PERIOD_TICKS, drawing, plain, shortened
from seismass.model.codes import AS_STATED, MARK, NOT_CHECKED, VERIFIED
from seismass.show.assessment.tables import AssessmentTables, Fraction, assessment_tables
from seismass.show.effective_mass import STORAGE_CODES, marked_legend

FRICTION_NAMES: Final = {SLIDING: "as stated", SLIDING_HIGH: "upper bound", SLIDING_LOW: "lower bound"}
"""What each friction is called, in the order of drawing."""
DRAWN_MODELS: Final = (SLIDING, ADVISED, CODE, ATTACHED, BARE)
"""Models of the figure of drifts, in the order of drawing."""


class Size(NamedTuple):
    """Width of a figure (inches), and characters of a line of a label and of the caption and of the name of a storey;
    columns of the legend.
    """

    width: float
    label: int
    caption: int
    name: int
    columns: int


PAPER_SIZE: Final = Size(6.8, 88, 110, 24, 2)
PHONE_SIZE: Final = Size(3.4, 44, 54, 12, 1)


def assessment_figures(result: AssessmentTables, size: Size = PAPER_SIZE) -> dict[str, Figure]:
    """Return the figures of an assessment that have something to show, by name."""
    fractions = any(np.isfinite(one.value) for one in result.effective.values())
    return {name: _drawn(result, name, size) for name in shown_figures(fractions, result.storeys, result.slip)}


def assessment_figure(result: Assessment, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    return _drawn(assessment_tables(result), named_figure(result, name), PAPER_SIZE)


@drawing()
def _drawn(result: AssessmentTables, name: str, size: Size) -> Figure:
    draw = {
        "effective_fraction": fraction_figure,
        "drift": drift_figure,
        "slip": slip_figure,
        "spectrum": spectrum_figure,
    }
    figure = draw[name](result, size)
    # Lay out once, not again for every file.
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    return figure


def fraction_figure(result: AssessmentTables, size: Size) -> Figure:
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
    axes.set_ylabel(f"{OVER_MODEL}, capped mean of the largest drift\n(above 1: the model is unsafe)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(loc="outside upper center", ncols=1, frameon=False)
    shown = STORAGE_CODES if result.code["use"] == "storage" else {}
    figure.supxlabel(f"{_caption(result, size)}{marked_legend(shown)}", fontsize=7.5)
    return figure


def _value(effective: Fraction) -> str:
    if effective.interval is None or not np.isfinite(effective.interval).all():
        return f"{effective.value:.2f}"
    return f"{effective.value:.2f} [{effective.interval[0]:.2f}, {effective.interval[1]:.2f}]"


def _mark_shares(axes: Axes, result: AssessmentTables, size: Size) -> None:
    """Mark the advised share and the code's, and name those of other codes at the upper edge."""
    code, present = result.code, result.present_share
    if result.advised is not None:
        label = f"advised: {result.advised:.2f} of the goods present"
        axes.axvline(result.advised, **ADVISED_ROLE.look, linewidth=1.2, label=label)
    if code["share_of_design_live_load"] <= present:
        label = (
            f"{plain(code['code'])}: {code['share_of_design_live_load'] / present:.2f} of the goods present "
            f"({code['share_of_design_live_load']:.3g} of the design live load{_unchecked(code)})"
        )
        place = code["share_of_design_live_load"] / present
        axes.axvline(place, **MODELS[CODE].look, linewidth=1.4, label=_wrapped(label, size))
    if code["use"] != "storage":
        return
    marks = {name: share / present for name, share in STORAGE_CODES.items() if share <= present}
    upper = axes.secondary_xaxis("top")
    names = [f"{name} {share:.2f}" for name, share in marks.items()]
    upper.set_xticks(list(marks.values()), names, rotation=35.0, ha="left", fontsize=7.0)


def drift_figure(result: AssessmentTables, size: Size) -> Figure:
    """Capped mean drift of each storey by model, with 16 and 84 % over the motions, beside the limit."""
    storeys, limit, names = result.storeys, result.drift_limit, result.storey_names
    scale = 1e3 if limit is None else 1e2
    models = [model for model in DRAWN_MODELS if model in set(storeys["model"])]
    figure = Figure(figsize=(size.width, 2.2 + 0.85 * len(names)), layout="constrained")
    axes = figure.add_subplot()
    spacing = 0.15
    handles = []
    for number, model in enumerate(models):
        role = MODELS[model]
        colour, line, marker = role.colour, role.line, role.marker
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
                label=_wrapped(_model_label(result, model), size),
            )
        )
    if limit is not None:
        axes.axvline(scale * limit, **LIMIT.look, linewidth=1.4)
        handles.append(Line2D([], [], **LIMIT.look, linewidth=1.4, label=f"{LIMIT.name}, {scale * limit:g} %"))
    axes.set_xlim(0.0, None)
    axes.set_ylim(0.5, len(names) + 0.5)
    labels = [f"{number} {name}".strip() for number, name in enumerate(names, start=1)]
    axes.set_yticks(range(1, len(names) + 1), [shortened(plain(label), size.name) for label in labels])
    axes.set_ylabel("storey")
    unit = "mm" if limit is None else "% of the height"
    axes.set_xlabel(f"peak storey drift, {unit}\n(capped mean over the motions, and from 16 to 84 % of them)")
    axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
    for edge in np.arange(1.5, len(names)):
        axes.axhline(edge, color=GREY, alpha=0.35, linewidth=0.6)
    figure.legend(handles=handles, loc="outside upper center", ncols=size.columns, frameon=False)
    figure.supxlabel(_caption(result, size), fontsize=7.5)
    return figure


def slip_figure(result: AssessmentTables, size: Size) -> Figure:
    """Peak and residual slip of the goods of each floor, by friction, with their scatter over the motions."""
    slip = result.slip
    kinds = list(dict.fromkeys(slip.sort("floor", maintain_order=True).select("floor", "goods").iter_rows()))
    models = [model for model in FRICTION_NAMES if model in set(slip["model"])]
    figure = Figure(figsize=(size.width, 2.1 + 0.75 * len(kinds)), layout="constrained")
    axes = figure.add_subplot()
    places = {kind: number for number, kind in enumerate(kinds, start=1)}
    handles = []
    for number, model in enumerate(models):
        role, name = MODELS[model], FRICTION_NAMES[model]
        colour, marker = role.colour, role.marker
        rows = slip.filter(pl.col("model") == model).sort("floor", maintain_order=True)
        offset = 0.22 * (0.5 * (len(models) - 1) - number)
        height = np.array([places[kind] + offset for kind in rows.select("floor", "goods").iter_rows()])

        def column(key: str, table: pl.DataFrame = rows) -> FloatArray:
            values: FloatArray = 1e3 * table[key].cast(pl.Float64).to_numpy()
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
        value = f", {MU}_s = {mu[0]:.3g}" if len(mu) == 1 else ""
        handles.append(Line2D([], [], color=colour, linewidth=1.5, marker=marker, label=f"friction {name}{value}"))
    handles += [
        Line2D([], [], color=GREY, linewidth=1.5, marker="o", label="peak: mean, and 16 to 84 % of the motions"),
        Line2D([], [], color=GREY, linestyle="", marker="x", markersize=4.5, label="peak: largest"),
        Line2D([], [], color=GREY, linestyle="", marker="o", markerfacecolor="white", label="residual: mean"),
    ]
    names = result.storey_names
    labels = [" ".join(part for part in (str(floor), names[floor - 1], text) if part) for floor, text in kinds]
    axes.set_yticks(range(1, len(kinds) + 1), [shortened(plain(label), size.name) for label in labels])
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
    figure.legend(handles=handles, loc="outside upper center", ncols=size.columns, frameon=False)
    figure.supxlabel(_caption(result, size), fontsize=7.5)
    return figure


def spectrum_figure(result: AssessmentTables, size: Size) -> Figure:
    """Mean and scatter of the spectra of the scaled motions beside the site spectrum, with the range of scaling."""
    table = result.spectra
    period = table["period"].to_numpy()
    figure = Figure(figsize=(size.width, 4.4), layout="constrained")
    axes = figure.add_subplot()
    low, mean, high = (table[name].to_numpy() / STANDARD_GRAVITY for name in ("p16", "mean", "p84"))
    motions = len(result.document["suite"]["motions"])
    axes.fill_between(period, low, high, color=SPECTRUM.colour, alpha=0.2, linewidth=0.0, label="16 to 84 % of them")
    axes.plot(period, mean, **SPECTRUM.look, linewidth=2.0, label=f"mean of {motions} motions, scaled")
    if table["target"].null_count() < table.height:
        wanted = table["target"].cast(pl.Float64).fill_null(np.nan).to_numpy() / STANDARD_GRAVITY
        axes.plot(period, wanted, **TARGET.look, linewidth=1.8, label=_wrapped("site spectrum", size))
    data = result.document["input"]
    bare, attached = data["period_bare"], data["period_attached"]
    axes.axvline(bare, **BARE_ROLE.look, linewidth=1.1, label=f"first period {bare:.3g} s, {BARE_ROLE.name}")
    role = MODELS[ATTACHED]
    axes.axvline(attached, **role.look, linewidth=1.3, label=f"first period {attached:.3g} s, {role.name}")
    if result.document["scaling"] is not None:
        first, last = result.document["scaling"]["periods"]
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


def _unchecked(code: dict[str, Any]) -> str:
    """Mark and words of a code whose fraction was not read in its text."""
    return "" if code["status"] in (VERIFIED, AS_STATED) else f" {MARK} {NOT_CHECKED}"


def _model_label(result: AssessmentTables, model: str) -> str:
    if model == ADVISED and result.advised is not None:
        return f"{ADVISED_ROLE.name} (analysis 1): {LAMBDA} = {result.advised:.2f} of the goods"
    if model == CODE:
        code = result.code
        return f"{plain(code['code'])}, {code['share_of_design_live_load']:.3g} of the live load{_unchecked(code)}"
    added = {SLIDING: ", friction as stated", BARE: " (analysis 2)"}.get(model, "")
    return f"{NAMES[model]}{added}"


def _wrapped(text: str, size: Size) -> str:
    return textwrap.fill(text, size.label)


def _caption(result: AssessmentTables, size: Size) -> str:
    document = result.document
    suite = document["suite"]
    kind = " (synthetic, none recorded)" if suite["synthetic"] == len(suite["motions"]) else ""
    lines = [f"{document['name']};  {len(suite['motions'])} motions{kind}"]
    if document["target"] is not None and result.scaling is not None:
        lines.append(f"scaled to {document['target']['label']}")
    return plain("\n".join(textwrap.fill(line, size.caption) for line in lines))


WIDTH: Final = 430.0
LEFT: Final = 118.0
BAY: Final = 132.0
"""Left edge and width of the building (px)."""
LEAST_PITCH: Final = 15.0
"""Least distance between lines of words (px)."""
NAME: Final = 15
"""Characters of the name of a storey."""


def building_drawing(result: AssessmentTables) -> Markup:
    """Return the drawing as SVG in the colour of the text; goods are as large as their mass over that of a floor."""
    data = result.document["input"]
    storeys: list[dict[str, Any]] = data["storeys"]
    heights = np.array([1.0 if row["height"] is None else row["height"] for row in storeys])
    tall = float(np.clip(58.0 * len(storeys), 90.0, 330.0))
    levels = 34.0 + tall * (1.0 - np.append(0.0, np.cumsum(heights)) / heights.sum())
    every = max(1, int(np.ceil(LEAST_PITCH * len(storeys) / tall)))
    parts = [_line(LEFT - 22.0, levels[0], LEFT + BAY + 22.0, levels[0], 2.5)]
    hatching = np.arange(LEFT - 16.0, LEFT + BAY + 24.0, 10.0)
    parts += [_line(x, levels[0] + 5.0, x - 5.0, levels[0] + 10.0, 1.0) for x in hatching]
    for number, row in enumerate(storeys):
        bottom, top = levels[number], levels[number + 1]
        parts += [_line(x, bottom, x, top, 1.6) for x in (LEFT + 6.0, LEFT + BAY - 6.0)]
        parts.append(_line(LEFT, top, LEFT + BAY, top, min(4.0, 0.25 * (bottom - top))))
        if number % every:
            continue
        name = apart(shortened(row["name"], NAME))
        parts.append(_text(LEFT - 8.0, top + 4.0, f"{row['storey']} {name}".rstrip(), "end"))
        if row["height"] is not None and every == 1:
            parts.append(_text(LEFT + BAY + 10.0, 0.5 * (bottom + top) + 4.0, f"{row['height']:.3g} m", soft=True))
    parts += _goods(result, levels, every)
    if data["walls"]:
        x = LEFT + BAY - 20.0
        parts.append(
            Markup(
                '<rect x="{}" y="{:.1f}" width="7" height="{:.1f}" fill="currentColor" fill-opacity="0.35"/>'
            ).format(x, levels[-1], levels[0] - levels[-1])
        )
    text = f"{counted(len(storeys), 'storey')}; {_goods_text(result)}"
    return Markup(
        '<svg class="adapts" viewBox="0 0 {:g} {:.0f}" width="{:g}" role="img"><title>{}</title>{}</svg>'
    ).format(WIDTH, levels[0] + 14.0, WIDTH, text, Markup("").join(parts))


def floor_words(result: AssessmentTables) -> dict[int, str]:
    """Return the goods of each loaded floor in a few words: what is present of the design live load, and friction."""
    rows = {row["storey"]: row for row in result.document["input"]["storeys"]}
    kinds: dict[int, list[str]] = {}
    for kind in result.document["input"]["goods"]:
        area = rows[kind["floor"]]["area"]
        present, load = (STANDARD_GRAVITY * kind[name] for name in ("mass", "live_load"))
        amount = (
            f"{1e-3 * present:.0f} of {1e-3 * load:.0f} kN"
            if area is None
            else (f"{1e-3 * present / area:.3g} of {1e-3 * load / area:.3g} kPa")
        )
        friction = f"{kind['mu_s']:.3g}" + (f"/{kind['mu_k']:.3g}" if kind["mu_k"] != kind["mu_s"] else "")
        size = kind.get("size")
        ratio = np.inf if size is None else size["width"] / size["height"]
        contact = f"b/h {ratio:.3g}" if ratio < kind["mu_s"] else f"{MU} {friction}"
        how = "bolted" if kind["attached"] else contact if kind["mass"] > 0.0 else "none present"
        kinds.setdefault(kind["floor"], []).append(f"{amount}, {how}")
    return {floor: words[0] if len(words) == 1 else f"{words[0]} +{len(words) - 1}" for floor, words in kinds.items()}


def _goods_text(result: AssessmentTables) -> str:
    words = floor_words(result)
    return "; ".join(f"floor {floor}: goods {what}" for floor, what in words.items()) or "no goods"


def _goods(result: AssessmentTables, levels: np.ndarray[Any, np.dtype[np.float64]], every: int) -> list[Markup]:
    """Goods of each floor as boxes, and their words beside the floor."""
    data = result.document["input"]
    mass = {row["storey"]: row["mass"] for row in data["storeys"]}
    parts = []
    for floor in sorted({kind["floor"] for kind in data["goods"]}):
        kinds = [kind for kind in data["goods"] if kind["floor"] == floor and kind["mass"] > 0.0]
        above = levels[floor] - levels[floor + 1] if floor + 1 < len(levels) else 34.0
        room = BAY - 34.0
        for place, kind in enumerate(kinds):
            side = float(np.sqrt(min(kind["mass"] / mass[floor], 2.0) / 2.0))
            high, wide = max(0.7 * above * side, 2.0), max(room / len(kinds) * side - 5.0, 4.0)
            middle = LEFT + 17.0 + room * (place + 0.5) / len(kinds)
            role = BARE_ROLE if kind["attached"] else SLIDE
            parts.append(
                Markup(
                    '<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}" fill-opacity="0.5" '
                    'stroke="{}"/>'
                ).format(middle - 0.5 * wide, levels[floor] - high - 2.0, wide, high, role.colour, role.colour)
            )
    for floor, words in floor_words(result).items():
        if (floor - 1) % every == 0:
            parts.append(_text(LEFT + BAY + 10.0, levels[floor] + 4.0, words))
    return parts


def _line(x1: float, y1: float, x2: float, y2: float, width: float) -> Markup:
    return Markup('<path d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke="currentColor" stroke-width="{:.3g}"/>').format(
        x1, y1, x2, y2, width
    )


def _text(x: float, y: float, words: str, anchor: str = "start", *, soft: bool = False) -> Markup:
    return Markup(
        '<text x="{:.1f}" y="{:.1f}" text-anchor="{}" font-size="11.5" fill="currentColor"{}>{}</text>'
    ).format(x, y, anchor, Markup(' fill-opacity="0.75"') if soft else "", escape(words))


def box_class(result: AssessmentTables) -> str:
    """Return the class of the box: green only with an answer, without doubts, and with all checks met."""
    met = result.checks["met"].eq_missing(True).all()
    return "answer" if result.answer is not None and met and not result.document["doubts"] else "answer bad"


def answer_lines(result: AssessmentTables) -> list[Markup]:
    """Return the lines of the box."""
    document, answer = result.document, result.answer
    names = result.storey_names
    lines = [Markup('<strong class="warn">{}</strong>').format(doubt) for doubt in document["doubt_lines"]]
    lines.append(Markup("<strong>{}</strong>").format(sentence_html(document["statement"], names)))
    if answer is not None:
        lines.append(sentence_html(_sentence(PAIR)))
        pair = zip(answer["analyses"], answer["pair"], strict=True)
        lines += [
            Markup("<strong>{}</strong>").format(sentence_html(f"Analysis {one['number']}: {words}."))
            for one, words in pair
        ]
        present, *amounts = answer["goods"]
        parts = [f"Governs: {'; '.join(answer['governs'])}.", f"Goods present: {present}.", *map(_sentence, amounts)]
        parts += [f"Why: {answer['why']}.", *map(_sentence, answer["sensitivity"]), answer["design"]]
        lines += [sentence_html(line, names) for line in parts]
    lines.append(sentence_html(_sentence(document["on_motions"])))
    if result.effective:
        lines.append(sentence_html(_code_sentence(result)))
    lines.append(_verdicts(result))
    return lines


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _code_sentence(result: AssessmentTables) -> str:
    """The code's fraction on the base of the shares, with its own in brackets."""
    code = result.code
    unchecked = "" if code["status"] in (VERIFIED, AS_STATED) else f"; {NOT_CHECKED}"
    return (
        f"{code['code']}: {code['share_of_design_live_load'] / result.present_share:.2f} of the goods present "
        f"({code['share_of_design_live_load']:.3g} of the design live load{unchecked})."
    )


def _single_motions(result: AssessmentTables) -> str:
    """Under how many motions a drift is above the limit all the same."""
    above = result.storeys["motions_above_limit"].drop_nulls().to_numpy()
    motions = len(result.document["suite"]["motions"])
    return f"; under up to {above.max()} of {motions} a drift is above the limit" if above.size and above.max() else ""


def _verdicts(result: AssessmentTables) -> Markup:
    """How many checks are met; those without a value are counted apart."""
    count = result.checks.height
    failed = result.checks.filter(met=False).height
    missing = result.checks["met"].null_count()
    if not failed + missing:
        return Markup('<span class="good">All {} checks are met, in the capped mean over the motions{}.</span>').format(
            count, _single_motions(result)
        )
    sentences = [f"{failed} of {count} checks are not met"] * bool(failed)
    sentences += [f"{missing} of {count} have no value"] * bool(missing)
    return Markup('<span class="warn">{}.</span>').format("; ".join(sentences))
