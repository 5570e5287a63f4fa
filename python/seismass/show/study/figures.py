"""All figures of a study by name, and that of its effective fractions against eta."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from seismass.effective_mass.estimate import best_estimate, conservative_estimate
from seismass.media.roles import BLOCK_COLOURS, EFFECTIVE, ETA, GREY, INK
from seismass.media.style import STYLE, lay_out, plain
from seismass.show.study.captions import StudyFrames, labels_of, spectrum_figure, suite_caption
from seismass.show.study.drift import drift_figure
from seismass.show.study.heat import heat_figure
from seismass.show.study.sensitivity_figure import sensitivity_figure
from seismass.show.study.slip import slip_figure
from seismass.show.study.tables import StudyTables
from seismass.show.study.underestimation import underestimation_figure
from seismass.show.validation.figures import platform_figure, section4_figure, sliding_figure
from seismass.validation.three_storeys import COMPARED_SLOPES

MARKERS = ("o", "s", "D", "^", "v", "P", "X")


def study_figures(result: StudyFrames) -> dict[str, Figure]:
    """Return the figures of a study by name; see `drawings`."""
    figures: dict[str, Figure] = {}
    with mpl.rc_context(STYLE):
        for name, draw in drawings(result).items():
            # Those of all R have the same panels and texts of the same length.
            first = next((each for each in figures if each.startswith("drift_R") and name.startswith("drift_R")), None)
            figures[name] = lay_out(draw(), like=None if first is None else figures[first])
    return figures


def drawings(result: StudyFrames) -> dict[str, Callable[[], Figure]]:
    """Return what draws each figure of a study, by its name: `spectrum`; for each R `underestimation`, `heat`, `slip`
    and `drift_R...`, with `_mu...` behind where there are several; `effective` if computed.
    """
    frictions, factors = labels_of(result.summary["mu"]), labels_of(result.summary["R"])
    draw: dict[str, Callable[[], Figure]] = {"spectrum": partial(spectrum_figure, result)}
    if result.fractions["effective"].null_count() < result.fractions.height:
        draw["effective"] = partial(effective_figure, result)
    for mu, name in frictions.items():
        behind = f"_mu{name}" if len(frictions) > 1 else ""
        draw[f"underestimation{behind}"] = partial(underestimation_figure, result, mu)
        draw[f"heat{behind}"] = partial(heat_figure, result, mu)
        if _has_goods(result):
            draw[f"slip{behind}"] = partial(slip_figure, result, mu)
        for factor, label in factors.items():
            draw[f"drift_R{label}{behind}"] = partial(drift_figure, result, factor, mu)
    return draw


def _has_goods(result: StudyFrames) -> bool:
    """Whether goods stand on a floor; a building of one storey has a bare roof alone."""
    return result.responses["peak_slip"].null_count() < result.responses.height


def phone_figures(result: StudyFrames) -> dict[str, Figure]:
    """Return figures for narrow screens, by the name of that in whose place they stand."""
    frictions = labels_of(result.summary["mu"])
    mu, name = next(iter(frictions.items()))
    behind = f"_mu{name}" if len(frictions) > 1 else ""
    with mpl.rc_context(STYLE):
        return {f"underestimation{behind}": lay_out(underestimation_figure(result, mu, narrow=True))}


def page_figures(result: StudyTables) -> dict[str, Figure]:
    """Return the figures of the page of a study by name: those of the study, its sensitivity and its validations."""
    figures = study_figures(result)
    with mpl.rc_context(STYLE):
        if result.sensitivity is not None:
            figures["sensitivity"] = sensitivity_figure(result.sensitivity)
        if result.section4 is not None:
            components = result.section4.runs["component"].unique(maintain_order=True)
            slope = COMPARED_SLOPES[0]
            figures |= {f"section4_{name}": section4_figure(result.section4, name, slope) for name in components}
            figures["section4_sliding"] = sliding_figure(result.section4)
        if result.platform is not None:
            components = result.platform.runs["component"].unique(maintain_order=True)
            figures |= {f"platform_{name}": platform_figure(result.platform, name) for name in components}
    return figures


def effective_figure(result: StudyFrames) -> Figure:
    """Effective fraction of each building against eta, with its interval, both estimates and the shares of the code."""
    table = result.fractions.drop_nulls("effective")
    figure = Figure(figsize=(6.4, 4.6), layout="constrained")
    axes = figure.add_subplot()
    for position, (factor, label) in enumerate(labels_of(table["R"]).items()):
        here = table.filter(R=factor).unique(["eta", "effective"], maintain_order=True)
        eta, value = here["eta"].to_numpy() / np.sqrt(here["height_ratio"].to_numpy()), here["effective"].to_numpy()
        colour = BLOCK_COLOURS[position % len(BLOCK_COLOURS)]
        axes.vlines(eta, here["low"].to_numpy(), here["high"].to_numpy(), color=colour, linewidth=0.7, alpha=0.5)
        axes.plot(
            eta,
            value,
            color=colour,
            linestyle="",
            marker=MARKERS[position % len(MARKERS)],
            markersize=4.5,
            markerfacecolor="white" if position % 2 else colour,
            label=f"R = {label}",
        )
    end = 1.05 * max(1.2, float(table["eta"].filter(table["eta"].is_finite()).max() or 0.0))  # type: ignore[arg-type]
    eta = np.linspace(0.0, end, 400)
    if table.height:
        powers = table["exponent"].to_numpy()
        least, most = powers.min(), powers.max()
        label = f"best estimate, p = {least:.1f} to {most:.1f}"
        ends = best_estimate(eta, most), best_estimate(eta, least)
        axes.fill_between(eta, *ends, color=INK, alpha=0.15, linewidth=0.0, label=label)
    rule = conservative_estimate(eta)
    axes.plot(eta, rule, color=INK, linewidth=1.4, linestyle=(0, (5, 2)), label="p = 1, conservative")
    shares = result.summary.select("occupancy", "lambda_analysis").unique(maintain_order=True).rows()
    for occupancy, share in shares:
        axes.axhline(share, color=GREY, linewidth=1.0, linestyle=(0, (1, 2)))
        text = plain(f"{result.metadata['code']['name']}, {occupancy}")
        axes.annotate(text, (end, share), xytext=(-3, 3), textcoords="offset points", ha="right", fontsize=7.5)
    axes.set_xlim(0.0, end)
    axes.set_ylim(-0.03, 1.06)
    axes.set_xlabel(
        f"{ETA}$_h$ = friction over base shear coefficient of the model with all attached over (h$_g$/h$_m$)$^{{1/2}}$"
    )
    axes.set_ylabel(EFFECTIVE)
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(loc="outside upper center", ncols=3, frameon=False)
    figure.supxlabel(suite_caption(result, inches=6.4), fontsize=7.5)
    return figure
