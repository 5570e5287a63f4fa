"""Figures and text of the effective fraction and its map."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from itertools import cycle
from typing import Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator

from seismass.base.errors import InvalidOption
from seismass.base.values import as_number, as_one_of
from seismass.effective_mass.design_map import EffectiveMassMap
from seismass.effective_mass.live_load import LiveLoadUncertainty
from seismass.effective_mass.result import EffectiveMass
from seismass.effective_mass.rule import RULE, RULE_IN_WORDS, share_by_hand
from seismass.media.result import named_figure
from seismass.media.roles import (
    ADVISED,
    ALPHA,
    ATTACHED,
    BARE,
    BLOCK_COLOURS,
    EFFECTIVE,
    ETA,
    GREY,
    INK,
    LAMBDA,
    MU,
    OMEGA,
    OVER_MODEL,
    PAPER,
    SHARE,
    SLIDE,
    SLIDE_HIGH,
    SLIDE_LOW,
    lettered,
)
from seismass.media.style import drawing
from seismass.media.text_table import text_line
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


@drawing()
def curve_figure(result: EffectiveMass, codes: Mapping[str, float] | None = None) -> Figure:
    """Drift with goods that slide over the model's, against the share attached, with its band, the answer and codes."""
    marks = STORAGE_CODES if codes is None else as_one_of(codes, Mapping, "codes", "figure", InvalidOption)
    marks = {name: as_number(share, "share of a code", "figure", InvalidOption) for name, share in marks.items()}
    largest = result.curve.filter(pl.col("storey") == 0)
    share, ratio = largest["fraction"].to_numpy(), largest["ratio"].to_numpy()
    figure = Figure(figsize=(6.4, 4.6), layout="constrained")
    axes = figure.add_subplot()
    if largest["ratio_low"].null_count() == 0:
        low, high = largest["ratio_low"].to_numpy(), largest["ratio_high"].to_numpy()
        label = f"{100.0 * result.confidence:g} % interval over the records"
        axes.fill_between(share, low, high, color=SLIDE.colour, alpha=0.18, linewidth=0.0, label=label)
    label = f"{OVER_MODEL}, {result.statistic} of the largest drift"
    axes.plot(share, ratio, color=SLIDE.colour, linewidth=2.0, label=label)
    rule = result.by_hand
    label = f"{lettered(rule.formula)} = {rule.estimate:.2f}"
    axes.axvline(rule.estimate, color=GREY, linewidth=1.3, linestyle=(0, (1, 1)), label=label)
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


@drawing()
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
            markerfacecolor=PAPER if role in (BARE, ATTACHED) else role.colour,
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
    metadata = result.metadata

    def listed(name: str) -> str:
        values = sorted(set(metadata[name]))
        return f"{values[0]:g}" if len(values) == 1 else f"{values[0]:g} to {values[-1]:g}"

    damping = "C of the building" if metadata["damping"] == "same" else "ratio in the model's own modes"
    return (
        f"{metadata['motions']} motions;  {ETA} = {result.eta:.2f};  {OMEGA} = {listed('overstrength')}, r2 = "
        f"{listed('second_slope')}, r3 = {listed('third_slope')};  damping of the models: {damping};  "
        f"P-Delta {'on' if metadata['p_delta'] else 'off'}"
    )


@drawing()
def uncertainty_figure(result: LiveLoadUncertainty, name: str | None = None) -> Figure:
    """Cumulative distribution of the share with codes' fractions, above the tornado of friction and occupancy."""
    named_figure(result, name)
    figure = Figure(figsize=(6.4, 5.6), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 1.2))
    share = np.sort(result.samples["share"].to_numpy())
    level = (np.arange(len(share)) + 0.5) / len(share)
    upper.plot(share, level, color=SLIDE.colour, linewidth=2.0, label="samples of friction and occupancy")
    upper.axvline(result.share, color=ADVISED.colour, linewidth=1.8, label=f"equal expected drift {result.share:.2f}")
    if result.interval is not None:
        label = f"its 90 % interval over the records, {result.interval[0]:.2f} to {result.interval[1]:.2f}"
        upper.axvspan(*result.interval, color=ADVISED.colour, alpha=0.15, linewidth=0.0, label=label)
    upper.axvline(
        result.share_84,
        color=SLIDE_HIGH.colour,
        linewidth=1.6,
        linestyle=(0, (5, 2)),
        label=f"84 % of samples {result.share_84:.2f}",
    )
    for name, fraction in STORAGE_CODES.items():
        upper.axvline(fraction, ymin=0.94, ymax=1.0, color=INK, linewidth=1.4)
        upper.annotate(
            f"{name} ",
            (fraction, 0.93),
            xycoords=("data", "axes fraction"),
            rotation=90.0,
            ha="center",
            va="top",
            fontsize=7.0,
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 1.0, "alpha": 0.85},
        )
    upper.set_ylim(0.0, 1.0)
    upper.set_xlim(-0.01, 1.01)
    upper.set_ylabel("probability of a smaller share")
    upper.grid(color=GREY, alpha=0.25, linewidth=0.5)
    rows = list(result.tornado.iter_rows(named=True))[::-1]
    for place, row in enumerate(rows):
        ends = (row["share_low"], row["share_high"])
        lower.barh(place, ends[1] - ends[0], left=ends[0], height=0.5, color=SLIDE.colour, alpha=0.5)
        for end, value, side in ((ends[0], row["low"], "right"), (ends[1], row["high"], "left")):
            outward = side if ends[0] <= ends[1] else {"right": "left", "left": "right"}[side]
            text = f" {value:.2g} "
            lower.annotate(text, (min(max(end, 0.04), 0.96), place), ha=outward, va="center", fontsize=8.0)
    lower.axvline(rows[0]["share_median"], color=INK, linewidth=0.9)
    lower.set_yticks(range(len(rows)), [lettered(row["variable"]) for row in rows])
    lower.set_ylim(-0.6, len(rows) - 0.4)
    lower.set_xlabel(
        "share of the design live load to attach as mass\n(bars: one variable at 5 and 95 %, the other at its median)"
    )
    lower.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(*upper.get_legend_handles_labels(), loc="outside upper center", ncols=2, frameon=False)
    metadata = result.metadata
    figure.supxlabel(
        f"{metadata['samples']} samples, {metadata['motions']} motions; "
        f"{MU} {metadata['mu']}, occupancy {metadata['occupancy']}"
        f"{marked_legend(STORAGE_CODES)}",
        fontsize=7.5,
    )
    return figure


LARGEST_SHOWN: Final = 1.2
"""Largest mu/C1 that the figure shows; beyond it the fraction is 1."""
NEAR: Final = 0.1
"""Difference of a fraction from the rule up to which it agrees."""
_GROUPS: Final = (
    ("elastic", 0.0, 1.0, SLIDE_LOW.colour, "^"),
    ("R up to 3", 1.0, 3.0, SLIDE.colour, "s"),
    ("R above 3", 3.0, np.inf, GREY, "o"),
)
"""Label, largest R in the group before and in this one, colour, marker."""
_RATIOS: Final = (0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5)
_INTENSITY_LOOKS: Final = ("o", "s", "D", "^", "v", "P", "X", "<", ">", "*", "h")


@drawing()
def map_figure(result: EffectiveMassMap, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    draw = {"collapse": collapse_figure, "rules": rules_figure, "intensity": intensity_figure}
    return draw[named_figure(result, name)](result)


@drawing()
def collapse_figure(result: EffectiveMassMap) -> Figure:
    """Effective fraction against mu/C1, every case in which goods slide, by R, with the rule and the codes."""
    sliding = result.table.filter(pl.col("slides"))
    # Names of codes reach beyond the axes by more than the layout leaves them.
    figure = Figure(figsize=(7.2, 5.2), layout=ConstrainedLayoutEngine(rect=(0.0, 0.0, 0.98, 1.0)))
    axes = figure.add_subplot()
    for label, above, most, colour, marker in _GROUPS:
        here = sliding.filter((pl.col("R") > above) & (pl.col("R") <= most))
        if not here.height:
            continue
        axes.plot(
            (here["mu"] / here["coefficient"]).to_numpy(),
            here["value"].to_numpy(),
            linestyle="",
            marker=marker,
            markersize=2.2,
            markeredgewidth=0.0,
            color=colour,
            alpha=0.55,
            label=label,
        )
    ends = np.linspace(0.0, LARGEST_SHOWN, 400)
    rule = share_by_hand(ends, 1.0)
    axes.plot(ends, rule, color=PAPER, linewidth=4.0, zorder=3)
    axes.plot(ends, rule, color=INK, linewidth=2.2, zorder=4, label=lettered(RULE))
    for name, share in {"none: ASCE 7 ordinary": 0.0, **STORAGE_CODES, "all": 1.0}.items():
        axes.plot([0.985, 1.0], [share, share], transform=axes.get_yaxis_transform(), color=INK, linewidth=1.6)
        axes.annotate(
            f"{name} {share:g}" if 0.0 < share < 1.0 else name,
            (1.01, share),
            xycoords=axes.get_yaxis_transform(),
            va="center",
            fontsize=7.5,
        )
    axes.set_xlim(0.0, LARGEST_SHOWN)
    axes.set_ylim(-0.03, 1.05)
    axes.set_xlabel(r"$\mu$ / $C_1$,   $C_1$ = $S_a$ / $R_y^{2/3}$,   $R_y$ = $S_a W_g$ / $V_y$ $\geq$ 1")
    axes.set_ylabel(EFFECTIVE)
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    error = np.abs(share_by_hand(sliding["mu"] / sliding["coefficient"], 1.0) - sliding["value"].to_numpy())
    share = 100.0 * float(np.mean(error <= NEAR)) if len(error) else 0.0
    axes.set_title(f"The rule by hand is within {NEAR:g} of the runs in {share:.0f} % of the cases", fontsize=9.5)
    legend = figure.legend(loc="outside upper center", ncols=2, frameon=False)
    for handle in legend.get_lines()[:-1]:
        handle.set_alpha(1.0)
        handle.set_markersize(5.0)
    figure.supxlabel(f"{map_caption(result)}{marked_legend(STORAGE_CODES)}", fontsize=7.5)
    return figure


@drawing()
def rules_figure(result: EffectiveMassMap) -> Figure:
    """Model over real drift for every rule: mean, 5 to 95 %, and the share of cases in which it is unsafe."""
    rules = result.rules()
    level = np.arange(rules.height)[::-1]
    figure = Figure(figsize=(7.2, 1.6 + 0.34 * rules.height), layout="constrained")
    axes = figure.add_subplot()
    axes.axvline(1.0, color=INK, linewidth=0.8)
    axes.axvspan(0.3, 1.0, color=GREY, alpha=0.12, linewidth=0.0)
    axes.hlines(level, rules["low"].to_numpy(), rules["high"].to_numpy(), color=SLIDE.colour, linewidth=2.0)
    axes.plot(rules["bias"].to_numpy(), level, color=SLIDE.colour, marker=SLIDE.marker, linestyle="", markersize=6.0)
    for height, unsafe in zip(level, rules["unsafe"], strict=True):
        axes.annotate(
            f"{100.0 * unsafe:.0f} %",
            (1.01, height),
            xycoords=axes.get_yaxis_transform(),
            va="center",
            fontsize=8.0,
        )
    axes.annotate("unsafe", (1.01, 1.0), xycoords="axes fraction", va="bottom", fontsize=8.0)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(list(_RATIOS)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlim(0.38, 2.6)
    axes.set_ylim(-0.6, rules.height - 0.4)
    names = [part for name in STORAGE_CODES for part in name.split(", ")]
    marked = [name.removesuffix(MARK) for name in names if name.endswith(MARK)]
    marks = [MARK * any(name in rule for name in marked) for rule in rules["rule"]]
    axes.set_yticks(level, [f"{lettered(rule)}{mark}" for rule, mark in zip(rules["rule"], marks, strict=True)])
    unsafe = {rule: 100.0 * part for rule, part in rules.select("rule", "unsafe").iter_rows()}
    quarter = next(rule for rule in unsafe if rule.startswith("ASCE 7 storage"))
    title = f"Unsafe: the rule by hand in {unsafe[RULE]:.0f} % of the cases, {quarter} in {unsafe[quarter]:.0f} %"
    axes.set_title(title, fontsize=9.5)
    axes.set_xlabel(
        "model / goods slide, mean of the largest drift: geometric mean and 5 to 95 % of the\n"
        "cases in which goods slide (shaded: the model drifts less;\n"
        "unsafe: with sliding goods the building drifts more than 1.05 times the model)"
    )
    axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
    figure.supxlabel(f"{map_caption(result)}{marked_legend(STORAGE_CODES)}", fontsize=7.5)
    return figure


@drawing()
def intensity_figure(result: EffectiveMassMap) -> Figure:
    """Effective fraction against intensity, a panel for each R, a line with a bootstrap band over the records for each
    friction: the middle building of the list, and the load nearest to alpha = 1.
    """
    numbers = result.table["building"].unique().sort().to_list()
    number = numbers[len(numbers) // 2]
    alphas = result.table["alpha"].unique().sort().to_list()
    load = min(alphas, key=lambda value: abs(value - 1.0))
    here = result.table.filter((pl.col("building") == number) & (pl.col("alpha") == load)).sort("intensity")
    factors = here["R"].unique().sort().to_list()
    mus = here["mu"].unique().sort().to_list()
    storeys, period, roof = here.row(0, named=True)["storeys"], here["period"][0], here["roof"][0]
    confidence = result.metadata["parameters"]["confidence"]
    columns = min(len(factors), 4)
    rows = -(-len(factors) // columns)
    figure = Figure(figsize=(1.0 + 2.1 * columns, 1.5 + 2.1 * rows), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    for axes, factor in zip(grid.flat, factors, strict=False):
        for colour, marker, mu in zip(cycle(BLOCK_COLOURS), cycle(_INTENSITY_LOOKS), mus, strict=False):
            line = here.filter((pl.col("R") == factor) & (pl.col("mu") == mu))
            if line["low"].null_count() == 0:
                ends = (line[name].to_numpy() for name in ("intensity", "low", "high"))
                axes.fill_between(*ends, color=colour, alpha=0.12, linewidth=0.0)
            axes.plot(
                line["intensity"].to_numpy(),
                line["value"].to_numpy(),
                color=colour,
                marker=marker,
                markersize=3.5,
                linewidth=1.1,
                label=f"{MU} = {mu:g}",
            )
        axes.set_title(f"R = {factor:g}")
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
        axes.set_ylim(-0.03, 1.05)
    for axes in list(grid.flat)[len(factors) :]:
        axes.set_axis_off()
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=min(len(mus), 6), frameon=False)
    figure.supylabel(EFFECTIVE, fontsize=9.0)
    figure.supxlabel(
        "intensity: factor of the scaled motions, strengths unchanged; "
        f"bands: {100.0 * confidence:g} % intervals over the records   ({storeys} storeys, {period:g} s, {roof} "
        f"roof, {ALPHA} = {load:g})" + "\n" + map_caption(result),
        fontsize=7.5,
    )
    return figure


def map_caption(result: EffectiveMassMap) -> str:
    """Return one line on the motions and the parameters that the map depends on."""
    parameters, suite = result.metadata["parameters"], result.metadata["suite"]
    name = str(suite["name"]).replace("$", r"\$")
    damping = "C of the building" if parameters["model_damping"] == "same" else "that ratio in their own modes"
    target = str(result.metadata["target"]["label"]).split(" (")[0].replace("$", r"\$")
    stated = parameters["scaling_period"]
    period = "the period of each building" if stated is None else f"T = {stated:g} s"
    return (
        f"{len(suite['motions'])} motions ({name}) scaled to {target}, for {period};\n"
        f"V_y designed with {LAMBDA} = {parameters['design_fraction']:g}; {OMEGA} = {parameters['overstrength']:g}, "
        f"r2 = {parameters['second_slope']:g}, r3 = {parameters['third_slope']:g}; damping "
        f"{100.0 * parameters['damping']:g} %, models with {damping}"
    )


_RULES: Final = (-30, 7, 13, 16, 7, 9)
_BINS: Final = (-14, 7, 8, 9, 8)


def map_text(result: EffectiveMassMap) -> str:
    """Return remarks, the number of cases and runs, how rules do, over all and by period, and the scatter by eta."""
    sliding = int(result.table["slides"].sum())
    lines = [f"remark   {remark}" for remark in result.metadata["remarks"]]
    lines.append(f"cases    {result.table.height}, goods slide in {sliding}; {result.metadata['runs']} runs")
    return "\n".join(
        [
            *lines,
            "",
            *rules_text(result.rules()),
            "",
            *by_period_text(result.rules_by_period()),
            "",
            *bins_text(result.by_eta()),
        ]
    )


def rules_text(rules: pl.DataFrame) -> list[str]:
    """Return the table of rules as lines."""
    lines = [
        "Largest drift of the model with the share of a rule, over that with sliding goods",
        text_line(("rule", "mean", "log scatter", "5 to 95 %", "worst", "unsafe"), _RULES, indent=0),
    ]
    for row in rules.iter_rows(named=True):
        interval = f"{row['low']:.2f} to {row['high']:.2f}"
        numbers = (f"{row['bias']:.3f}", f"{row['log_scatter']:.3f}", interval, f"{row['worst']:.2f}")
        lines.append(text_line((row["rule"], *numbers, f"{100 * row['unsafe']:.0f} %"), _RULES, indent=0))
    return [
        *lines,
        "mean: geometric; unsafe: share of cases in which sliding goods drift more than 1.05 x the model",
        *textwrap.wrap(RULE_IN_WORDS, 108),
    ]


def by_period_text(rules: pl.DataFrame) -> list[str]:
    """Return how the rule by hand and all of the goods do in each class of period, as lines: mean, worst, unsafe."""
    classes = rules.select("period_from", "period_to").unique(maintain_order=True).rows()
    widths = (-30, *(18 for _ in classes))
    names = ["from 0" if not low else f"from {low:g}" for low, _ in classes]
    lines = [
        "By period of the bare building (s): mean, worst of model over goods-slide drift, unsafe cases",
        text_line(("rule", *names), widths, indent=0),
        text_line(("cases", *(str(rules.filter(period_from=low)["cases"][0]) for low, _ in classes)), widths, indent=0),
    ]
    for rule in (RULE, "ASCE 7 storage, 0.25", "all, 1"):
        cells = []
        for low, _ in classes:
            row = rules.filter(rule=rule, period_from=low).row(0, named=True)
            cells.append(f"{row['bias']:.3f} {row['worst']:.2f} {100 * row['unsafe']:3.0f} %")
        lines.append(text_line((rule, *cells), widths, indent=0))
    return lines


def bins_text(bins: pl.DataFrame) -> list[str]:
    """Return the scatter of the fraction in bins of eta as lines."""
    head = text_line(("eta", "cases", "16 %", "median", "84 %"), _BINS, indent=0)
    lines = ["Effective fraction by eta, mu_k over the mean peak base shear of the runs over the weight", head]
    for row in bins.iter_rows(named=True):
        end = "and more" if row["eta_to"] is None else f"to {row['eta_to']:g}"
        numbers = (f"{row[name]:.2f}" for name in ("p16", "median", "p84"))
        lines.append(text_line((f"{row['eta_from']:<4g} {end}", str(row["cases"]), *numbers), _BINS, indent=0))
    return lines
