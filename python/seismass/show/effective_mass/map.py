"""Figures of a map of effective fractions: the collapse onto eta, how rules do, and the fraction against intensity."""

from __future__ import annotations

from typing import Final

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator

from seismass.effective_mass.design_map import EffectiveMassMap
from seismass.effective_mass.estimate import best_estimate, conservative_estimate
from seismass.media.result import named_figure
from seismass.media.roles import ALPHA, EFFECTIVE, GREY, INK, LAMBDA, MU, OMEGA, SKY, SLIDE, lettered
from seismass.media.style import STYLE
from seismass.show.effective_mass.figures import STORAGE_CODES, marked_legend

LONGEST_ETA: Final = 2.2
"""Largest eta that the figure shows; beyond it the fraction is 1."""
_GROUPS: Final = (
    ("p up to 1.8", 0.0, 1.8, SKY, "^"),
    ("p up to 2.6", 1.8, 2.6, SLIDE.colour, "s"),
    ("p above 2.6", 2.6, np.inf, GREY, "o"),
)
"""Label, largest exponent of the rule in the group before and in this one, colour, marker."""
_RATIOS: Final = (0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5)
_INTENSITY_LOOKS: Final = ("o", "s", "D", "^", "v", "P", "X", "<", ">", "*", "h")


def map_figure(result: EffectiveMassMap, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    draw = {"collapse": collapse_figure, "rules": rules_figure, "intensity": intensity_figure}
    with mpl.rc_context(STYLE):
        return draw[named_figure(result, name)](result)


def collapse_figure(result: EffectiveMassMap) -> Figure:
    """Effective fraction against eta_h, every case in which goods slide, in classes of the exponent, and the codes. A
    curve per class is the best estimate with the median exponent of its cases.
    """
    sliding = result.table.filter(pl.col("slides")).with_columns(eta_h=pl.col("eta") / pl.col("height_ratio").sqrt())
    eta = np.linspace(0.0, LONGEST_ETA, 400)
    with mpl.rc_context(STYLE):
        # Names of codes reach beyond the axes by more than the layout leaves them.
        figure = Figure(figsize=(7.2, 5.2), layout=ConstrainedLayoutEngine(rect=(0.0, 0.0, 0.98, 1.0)))
        axes = figure.add_subplot()
        for label, above, most, colour, marker in _GROUPS:
            here = sliding.filter((pl.col("exponent") > above) & (pl.col("exponent") <= most))
            if not here.height:
                continue
            power = float(np.median(here["exponent"].to_numpy()))
            axes.plot(eta, best_estimate(eta, power), color="white", linewidth=4.0, zorder=3)
            axes.plot(eta, best_estimate(eta, power), color=colour, linewidth=2.2, zorder=4)
            axes.plot(
                here["eta_h"].to_numpy(),
                here["value"].to_numpy(),
                linestyle="",
                marker=marker,
                markersize=2.2,
                markeredgewidth=0.0,
                color=colour,
                alpha=0.55,
                label=f"{label}; curve: p = {power:.1f}",
            )
        safe = conservative_estimate(eta)
        axes.plot(eta, safe, color=INK, linewidth=2.0, linestyle=(0, (5, 2)), zorder=4, label="conservative, p = 1")
        for name, share in {"none: ASCE 7 ordinary": 0.0, **STORAGE_CODES, "all": 1.0}.items():
            axes.plot([0.985, 1.0], [share, share], transform=axes.get_yaxis_transform(), color=INK, linewidth=1.6)
            axes.annotate(
                f"{name} {share:g}" if 0.0 < share < 1.0 else name,
                (1.01, share),
                xycoords=axes.get_yaxis_transform(),
                va="center",
                fontsize=7.5,
            )
        axes.set_xlim(0.0, LONGEST_ETA)
        axes.set_ylim(-0.03, 1.05)
        axes.set_xlabel(
            r"$\eta_h$ = $\mu_k$ / ($C_1$ ($h_g$/$h_m$)$^{1/2}$)   ($C_1$: mean peak base shear / full weight)"
        )
        axes.set_ylabel(EFFECTIVE)
        axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
        legend = figure.legend(loc="outside upper center", ncols=2, frameon=False)
        for handle in legend.get_lines()[:-1]:
            handle.set_alpha(1.0)
            handle.set_markersize(5.0)
        figure.supxlabel(f"{map_caption(result)}{marked_legend(STORAGE_CODES)}", fontsize=7.5)
    return figure


def rules_figure(result: EffectiveMassMap) -> Figure:
    """Model over real drift for every rule: mean, 5 to 95 %, and the share of cases in which it is unsafe."""
    rules = result.rules()
    level = np.arange(rules.height)[::-1]
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.2, 1.6 + 0.34 * rules.height), layout="constrained")
        axes = figure.add_subplot()
        axes.axvline(1.0, color=INK, linewidth=0.8)
        axes.axvspan(0.3, 1.0, color=GREY, alpha=0.12, linewidth=0.0)
        axes.hlines(level, rules["low"].to_numpy(), rules["high"].to_numpy(), color=SLIDE.colour, linewidth=2.0)
        axes.plot(
            rules["bias"].to_numpy(), level, color=SLIDE.colour, marker=SLIDE.marker, linestyle="", markersize=6.0
        )
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
        axes.set_yticks(level, [lettered(rule) for rule in rules["rule"]])
        axes.set_xlabel(
            "model / goods slide, mean of the largest drift: geometric mean and 5 to 95 % of the\n"
            "cases in which goods slide (shaded: the model drifts less;\n"
            "unsafe: with sliding goods the building drifts more than 1.05 times the model)"
        )
        axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
        figure.supxlabel(map_caption(result), fontsize=7.5)
    return figure


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
    with mpl.rc_context(STYLE):
        shades = mpl.colormaps["viridis"](np.linspace(0.0, 0.9, len(mus)))
        figure = Figure(figsize=(1.0 + 2.1 * columns, 1.5 + 2.1 * rows), layout="constrained")
        grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        for axes, factor in zip(grid.flat, factors, strict=False):
            for colour, marker, mu in zip(shades, _INTENSITY_LOOKS * len(mus), mus, strict=False):
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
    chosen, suite = result.metadata["parameters"], result.metadata["suite"]
    name = str(suite["name"]).replace("$", r"\$")
    damping = "C of the building" if chosen["model_damping"] == "same" else "that ratio in their own modes"
    target = str(result.metadata["target"]["label"]).split(" (")[0].replace("$", r"\$")
    return (
        f"{len(suite['motions'])} motions ({name}) scaled to {target}, for T = {chosen['scaling_period']:g} s;\n"
        f"V_y designed with {LAMBDA} = {chosen['design_fraction']:g}; {OMEGA} = {chosen['overstrength']:g}, "
        f"r2 = {chosen['second_slope']:g}, r3 = {chosen['third_slope']:g}; damping "
        f"{100.0 * chosen['damping']:g} %, models with {damping}"
    )
