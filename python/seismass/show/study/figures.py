"""Figures of the study."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from functools import partial
from itertools import cycle
from typing import Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from seismass.base.values import signed
from seismass.effective_mass.rule import RULE, share_by_hand
from seismass.media.roles import (
    ALPHA,
    ATTACHED,
    BLOCK_COLOURS,
    CODE,
    EFFECTIVE,
    GREY,
    INK,
    LAMBDA,
    MU,
    PAPER,
    SLIDE,
    SLIDE_HIGH,
    SLIDE_LOW,
    lettered,
)
from seismass.media.style import drawing, lay_out, plain
from seismass.show.study.answer import (
    LEAST_WIDTH,
    labels_of,
    occupancy_title,
    spectrum_figure,
    suite_caption,
)
from seismass.show.study.tables import validations
from seismass.show.validation import platform_figure, section4_figure, sliding_figure
from seismass.studies.study import Model
from seismass.studies.study.run import StudyResult
from seismass.studies.validation.three_storeys import COMPARED_SLOPES

ALPHA_COLOURS: Final = (SLIDE_LOW.colour, SLIDE.colour, SLIDE_HIGH.colour)
ALPHA_MARKERS: Final = ("o", "s", "D", "^", "v", "P", "X")
ALPHA_SPACING: Final = 0.24
"""Largest distance between the ranges of two alphas, as a fraction of that between two R."""


_PHONE: Final = 3.4
"""Width of a figure for a phone (inches)."""
RING: Final[Any] = {**ATTACHED.mark, "marker": "o", "markersize": 9.0, "markerfacecolor": "none"}
"""The fully attached model."""


def underestimation_figure(result: StudyResult, mu: float, *, narrow: bool = False) -> Figure:
    """Underestimation (%) against R by alpha for one mu: the worst storey, and each building's range. A ring is the
    fully attached over the code model there; on the marker, mass causes all of it, sliding none.
    """
    summary = result.summary.filter(mu=mu)
    occupancies = summary.select("occupancy", "lambda_design", "lambda_analysis").unique(maintain_order=True).rows()
    buildings = summary.select("storeys", "period").unique(maintain_order=True).rows()
    factors, alphas = labels_of(summary["R"]), labels_of(summary["alpha"])
    looks = looks_of(len(alphas))
    # For a phone buildings stand below each other, and occupancies side by side.
    width = _PHONE if narrow else max(1.2 + 3.1 * len(buildings), LEAST_WIDTH)
    down, across = (len(buildings), len(occupancies)) if narrow else (len(occupancies), len(buildings))
    figure = Figure(figsize=(width, 1.7 + (1.9 if narrow else 2.6) * down), layout="constrained")
    grid = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
    if narrow:
        grid = grid.T
    offsets = min(ALPHA_SPACING, 0.8 / len(alphas)) * (np.arange(len(alphas)) - 0.5 * (len(alphas) - 1))
    for axes_row, (occupancy, design, analysis) in zip(grid, occupancies, strict=True):
        for axes, (storeys, period) in zip(axes_row, buildings, strict=True):
            same = (pl.col("occupancy") == occupancy) & (pl.col("storeys") == storeys) & (pl.col("period") == period)
            for alpha, offset, look in zip(alphas, offsets, looks, strict=True):
                here = summary.filter(same & (pl.col("alpha") == alpha))
                _ranges(axes, here, list(factors), offset, look)
            axes.axhline(0.0, color=INK, linewidth=0.9)
            axes.grid(axis="y", color=GREY, alpha=0.25, linewidth=0.5)
            axes.set_xticks(range(len(factors)), list(factors.values()))
        title = occupancy_title(occupancy, design, analysis)
        if narrow:
            axes_row[0].set_title(title)
        else:
            axes_row[0].set_ylabel(f"{title}\nunderestimation of drift (%)")
    bottom = grid[0][0].get_ylim()[0]
    for axes in grid.flat:
        axes.axhspan(bottom, 0.0, color=GREY, alpha=0.12, linewidth=0.0)
        axes.set_ylim(bottom, None)
    for axes, (storeys, period) in zip(grid[0], buildings, strict=True):
        if narrow:
            axes.set_ylabel(f"{storeys} storeys, {period:g} s\nunderestimation (%)")
        else:
            axes.set_title(f"{storeys} storeys, {period:g} s")
    elastic = 1.0 in factors and not result.metadata["parameters"]["yield_at_r1"]
    for axes in grid[:, -1] if narrow else grid[-1]:
        axes.set_xlabel("R (1: elastic)" if elastic else "R")
    handles: list[Line2D | Patch] = [
        _alpha_handle(look, label) for look, label in zip(looks, alphas.values(), strict=True)
    ]
    handles += [
        Line2D([], [], **RING, label=ATTACHED.name),
        Line2D([], [], color=GREY, marker="_", markersize=6.0, linewidth=1.2, label="other storeys"),
        Patch(color=GREY, alpha=0.12, linewidth=0.0, label="code gives more drift"),
    ]
    code = plain(result.metadata["code"]["name"])
    friction = f", {MU} = {mu:g}" if result.summary["mu"].n_unique() > 1 else ""
    title = f"({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name} of capped mean drift, code: {code}{friction}"
    figure.legend(
        handles=handles,
        loc="outside upper center",
        ncols=2 if narrow else 6 if width > 9.0 else 3,
        frameon=False,
        title=textwrap.fill(title, 46 if narrow else 200),
    )
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure


def _alpha_handle(look: tuple[str, str], label: str) -> Line2D:
    colour, marker = look
    return Line2D([], [], color=colour, marker=marker, markersize=5.0, linewidth=1.0, label=f"{ALPHA} = {label}")


def looks_of(count: int) -> list[tuple[str, str]]:
    """Return colour and marker of each alpha, no two the same: those of three, or shades from the first to the last."""
    shades = LinearSegmentedColormap.from_list("alpha", ALPHA_COLOURS)
    colours = (
        ALPHA_COLOURS if count <= len(ALPHA_COLOURS) else [to_hex(shades(x)) for x in np.linspace(0.0, 1.0, count)]
    )
    return list(zip(colours, cycle(ALPHA_MARKERS), strict=False))[:count]


def _ranges(axes: Axes, rows: pl.DataFrame, factors: list[float], offset: float, look: tuple[str, str]) -> None:
    colour, marker = look
    places, worst, rings = [], [], []
    for position, factor in enumerate(factors):
        known = rows.filter(pl.col("R") == factor).drop_nulls("underestimation_percent")
        if known.height == 0:
            continue
        values = known["underestimation_percent"].to_numpy()
        mass = known["ratio_mass"][int(values.argmax())]
        place = position + offset
        axes.plot([place, place], [values.min(), values.max()], color=colour, linewidth=1.2)
        axes.plot(np.full(len(values), place), values, color=colour, linestyle="", marker="_", markersize=6.0)
        places.append(place)
        worst.append(values.max())
        rings.append(np.nan if mass is None else 100.0 * (mass - 1.0))
    axes.plot(places, worst, color=colour, linewidth=0.8, alpha=0.6)
    axes.plot(places, worst, color=colour, linestyle="", marker=marker, markersize=5.0)
    axes.plot(places, rings, **RING)


LARGEST: Final = 100.0
"""Underestimation (%) from which on colours are as strong as they get."""
LEAST_ROWS: Final = 3
"""Rows of the height that a figure has at least."""
_MAP: Final = LinearSegmentedColormap.from_list("underestimation", (SLIDE.colour, PAPER, CODE.colour))
_STRONGEST: Final = 0.7
"""Share of a full colour on which numbers are still legible."""


def heat_figure(result: StudyResult, mu: float) -> Figure:
    """Return a map per occupancy at friction mu: R and alpha downwards, buildings and their storeys across."""
    summary = result.summary.filter(mu=mu)
    occupancies = summary.select("occupancy", "lambda_design", "lambda_analysis").unique(maintain_order=True).rows()
    factors, alphas = labels_of(summary["R"]), labels_of(summary["alpha"])
    rows = [(factor, alpha) for factor in factors for alpha in alphas]
    columns = summary.select("storeys", "period", "storey").unique(maintain_order=True).sort("storeys", "period").rows()
    width = max(1.1 + len(occupancies) * (0.4 + 0.47 * len(columns)), LEAST_WIDTH)
    figure = Figure(figsize=(width, 1.7 + 0.26 * max(len(rows), LEAST_ROWS)), layout="constrained")
    panels = figure.subplots(1, len(occupancies), squeeze=False, sharey=True)[0]
    for axes, (occupancy, design, analysis) in zip(panels, occupancies, strict=True):
        cells = _cells(summary.filter(occupancy=occupancy), rows, columns)
        _draw(axes, cells)
        axes.set_title(occupancy_title(occupancy, design, analysis), pad=24.0)
        axes.set_xticks(range(len(columns)), [f"{storey}" for *_, storey in columns])
        axes.set_xlabel("storey")
        _name_buildings(axes, columns)
    every = len(alphas)
    panels[0].set_yticks(range(len(rows)), [f"R = {factors[f]}, {ALPHA} = {alphas[a]}" for f, a in rows])
    for axes in panels:
        for edge in range(every, len(rows), every):
            axes.axhline(edge - 0.5, color=INK, linewidth=0.8)
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure


def _cells(summary: pl.DataFrame, rows: list[Any], columns: list[Any]) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Underestimation (%), NaN where there is none."""
    cells = np.full((len(rows), len(columns)), np.nan)
    down = {row: place for place, row in enumerate(rows)}
    across = {column: place for place, column in enumerate(columns)}
    keys = ("R", "alpha", "storeys", "period", "storey", "underestimation_percent")
    for factor, alpha, storeys, period, storey, value in summary.select(keys).rows():
        if value is not None:
            cells[down[factor, alpha], across[storeys, period, storey]] = value
    return cells


def _draw(axes: Axes, cells: np.ndarray[Any, np.dtype[np.float64]]) -> None:
    norm = Normalize(-LARGEST / _STRONGEST, LARGEST / _STRONGEST)
    height, width = cells.shape
    # Rectangles, for a picture within an SVG would be blurred.
    axes.pcolormesh(
        np.arange(width + 1) - 0.5,
        np.arange(height + 1) - 0.5,
        cells.clip(-LARGEST, LARGEST),
        cmap=_MAP,
        norm=norm,
        edgecolors=PAPER,
        lw=0.6,
    )
    axes.set_ylim(height - 0.5, -0.5)
    for (row, column), value in np.ndenumerate(cells):
        if np.isnan(value):
            axes.text(column, row, "\N{EN DASH}", ha="center", va="center", fontsize=7.0, color=GREY)
            continue
        axes.text(column, row, lettered(signed(value)), ha="center", va="center", fontsize=7.0, color=INK)
    axes.tick_params(length=0.0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _name_buildings(axes: Axes, columns: list[Any]) -> None:
    """Name each building above its storeys, and part it from the next."""
    buildings = list(dict.fromkeys(column[:2] for column in columns))
    for storeys, period in buildings:
        places = [place for place, column in enumerate(columns) if column[:2] == (storeys, period)]
        middle = 0.5 * (places[0] + places[-1])
        axes.annotate(
            f"{storeys} storeys,\n{period:g} s",
            (middle, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0.0, 3.0),
            textcoords="offset points",
            ha="center",
            va="bottom",
            fontsize=7.5,
        )
        if places[0]:
            axes.axvline(places[0] - 0.5, color=INK, linewidth=0.8)


LOOKS: Final[dict[Model, dict[str, Any]]] = {
    "code": {**CODE.look, "linewidth": 1.5, "marker": CODE.marker, "markersize": 4.0, "markerfacecolor": PAPER},
    "attached": {
        **ATTACHED.look,
        "linewidth": 1.6,
        "marker": ATTACHED.marker,
        "markersize": 5.5,
        "markerfacecolor": PAPER,
    },
    "real": {**SLIDE.look, "linewidth": 1.8, "marker": SLIDE.marker, "markersize": 3.5},
}
"""How each model is drawn, in the order of drawing."""


def drift_figure(result: StudyResult, factor: float, mu: float) -> Figure:
    """Capped mean drift of each storey for one R and mu: occupancies and alpha in columns, buildings in rows."""
    label = labels_of(result.summary["R"])[factor]
    summary = result.summary.filter(R=factor, mu=mu)
    alphas = labels_of(summary["alpha"])
    columns = (
        summary.select("occupancy", "lambda_design", "lambda_analysis", "alpha").unique(maintain_order=True).rows()
    )
    rows = summary.select("storeys", "period").unique(maintain_order=True).rows()
    width = max(1.0 + 1.75 * len(columns), LEAST_WIDTH)
    figure = Figure(figsize=(width, 1.35 + 1.75 * len(rows)), layout="constrained")
    grid = figure.subplots(len(rows), len(columns), squeeze=False, sharex="row", sharey="row")
    for axes_row, (storeys, period) in zip(grid, rows, strict=True):
        same = (pl.col("storeys") == storeys) & (pl.col("period") == period)
        for axes, (occupancy, _, _, alpha) in zip(axes_row, columns, strict=True):
            here = summary.filter(same & (pl.col("occupancy") == occupancy) & (pl.col("alpha") == alpha))
            _drift_profile(axes, here.sort("storey"))
        largest = _largest(summary.filter(same))
        axes_row[0].set_xlim(0.0, 1.42e3 * largest)
        axes_row[0].set_ylim(0.5, storeys + 0.6)
        axes_row[0].set_yticks(range(1, storeys + 1))
        axes_row[0].set_ylabel(f"{storeys} storeys, {period:g} s\n\nstorey")
    for axes, (occupancy, design, analysis, alpha) in zip(grid[0], columns, strict=True):
        axes.set_title(f"{occupancy_title(occupancy, design, analysis)}\n" + f"{ALPHA} = {alphas[alpha]}")
    for axes in grid[-1]:
        axes.set_xlabel("capped mean drift (mm)")
    behaviour = " (elastic)" if factor == 1.0 and not result.metadata["parameters"]["yield_at_r1"] else ""
    code = plain(result.metadata["code"]["name"])
    texts: dict[Model, str] = {
        "real": SLIDE.name,
        "attached": f"{ATTACHED.name}: none slide",
        "code": f"{CODE.name}, {code}: {LAMBDA} of the goods attached",
    }
    handles = [Line2D([], [], label=text, **LOOKS[model]) for model, text in texts.items()]
    handles.append(
        Line2D([], [], color=SLIDE.colour, linewidth=4.5, alpha=0.25, label=f"{SLIDE.name}: 16 to 84 % of the motions")
    )
    handles.append(
        Line2D(
            [],
            [],
            linestyle="",
            label=f"numbers: underestimation ({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name}, %",
        )
    )
    friction = f", {MU} = {mu:g}" if result.summary["mu"].n_unique() > 1 else ""
    title = f"R = {label}{behaviour}{friction}"
    legend = figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False, title=title)
    legend.get_title().set_fontsize(11.0)
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure


def _largest(rows: pl.DataFrame) -> float:
    """Largest drift (m) that is drawn of these rows; 1 where there is none."""
    drawn = rows.select(r"^mean_peak_drift_(real|code|attached)$", "p84_peak_drift_real").to_numpy()
    finite = drawn[np.isfinite(drawn)]
    return float(finite.max()) if finite.size and finite.max() > 0.0 else 1.0


def _drift_profile(axes: Axes, storeys: pl.DataFrame) -> None:
    level = storeys["storey"].to_numpy()
    low, high = (1e3 * storeys[f"{name}_peak_drift_real"].cast(pl.Float64).to_numpy() for name in ("p16", "p84"))
    known = np.isfinite(low) & np.isfinite(high)
    axes.hlines(level[known], low[known], high[known], color=SLIDE.colour, linewidth=4.5, alpha=0.25)
    for model, look in LOOKS.items():
        axes.plot(1e3 * storeys[f"mean_peak_drift_{model}"].to_numpy(), level, **look)
    for height, percent in zip(level, storeys["underestimation_percent"], strict=True):
        text = "" if percent is None else lettered(signed(percent))
        axes.text(0.98, height, text, transform=axes.get_yaxis_transform(), ha="right", va="center", fontsize=7.5)
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    axes.locator_params(axis="x", nbins=4)


def slip_demand(responses: pl.DataFrame) -> pl.DataFrame:
    """Return one row per building with sliding goods, of `StudyResult.responses`: statistics (m) over the motions of
    the largest peak slip of any floor, and mean residual slip there; null where a run failed.
    """
    keys = ["building", "occupancy", "storeys", "period", "R", "alpha", "mu"]
    # Of equal slips, such as none at all, the lowest floor counts.
    worst = (
        responses.filter(model="real")
        .drop_nulls("peak_slip")
        .sort("building", "motion", "storey")
        .group_by(*keys, "motion", maintain_order=True)
        .agg(
            pl.col("peak_slip").max(),
            pl.col("residual_slip").abs().get(pl.col("peak_slip").arg_max()),
        )
    )
    slip = pl.col("peak_slip")
    return worst.group_by(keys, maintain_order=True).agg(
        mean=slip.mean(),
        p16=slip.quantile(0.16, "linear"),
        p84=slip.quantile(0.84, "linear"),
        largest=slip.max(),
        residual=pl.col("residual_slip").mean(),
        slides=(slip > 0.0).sum(),
    )


def slip_figure(result: StudyResult, mu: float) -> Figure:
    """Return mean peak slip against R by alpha, with 16 to 84 % of the motions; occupancies down, buildings across."""
    demand = slip_demand(result.responses.filter(mu=mu))
    occupancies = demand["occupancy"].unique(maintain_order=True).to_list()
    buildings = demand.select("storeys", "period").unique(maintain_order=True).rows()
    factors, alphas = labels_of(demand["R"]), labels_of(demand["alpha"])
    looks = looks_of(len(alphas))
    width = max(1.2 + 2.6 * len(buildings), LEAST_WIDTH)
    figure = Figure(figsize=(width, 1.2 + 2.1 * len(occupancies)), layout="constrained")
    grid = figure.subplots(len(occupancies), len(buildings), squeeze=False, sharex=True, sharey=True)
    offsets = min(ALPHA_SPACING, 0.8 / len(alphas)) * (np.arange(len(alphas)) - 0.5 * (len(alphas) - 1))
    for row, occupancy in zip(grid, occupancies, strict=True):
        for axes, (storeys, period) in zip(row, buildings, strict=True):
            same = demand.filter(occupancy=occupancy, storeys=storeys, period=period)
            for alpha, offset, (colour, marker) in zip(alphas, offsets, looks, strict=True):
                here = same.filter(alpha=alpha).sort("R")
                place = np.array([list(factors).index(factor) for factor in here["R"]]) + offset
                mean, low, high = (1e3 * here[name].to_numpy() for name in ("mean", "p16", "p84"))
                axes.vlines(place, low, high, color=colour, linewidth=1.2)
                axes.plot(place, mean, color=colour, marker=marker, markersize=5.0, linewidth=0.8)
            axes.set_xticks(range(len(factors)), list(factors.values()))
            axes.grid(axis="y", color=GREY, alpha=0.25, linewidth=0.5)
        row[0].set_ylabel(f"{plain(occupancy)}\npeak slip (mm)")
    grid[0][0].set_ylim(0.0, None)
    for axes, (storeys, period) in zip(grid[0], buildings, strict=True):
        axes.set_title(f"{storeys} storeys, {period:g} s")
    for axes in grid[-1]:
        axes.set_xlabel("R")
    handles = [
        Line2D([], [], color=colour, marker=marker, markersize=5.0, linewidth=0.8, label=f"{ALPHA} = {label}")
        for (colour, marker), label in zip(looks, alphas.values(), strict=True)
    ]
    handles.append(Line2D([], [], color=GREY, linewidth=1.2, label="16 to 84 % of the motions"))
    figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
    figure.supxlabel(suite_caption(result, mu, inches=width), fontsize=7.5)
    return figure


_MARKERS: Final = ("o", "D", "^", "s")


def sensitivity_figure(table: pl.DataFrame) -> Figure:
    """Return a dot per choice and occupancy of `Sensitivity.table`, beside lines of the study as it is."""
    several = table["mu"].n_unique() > 1
    groups = table.select("occupancy", "mu").unique(maintain_order=True).rows()
    settings = table.select("choice", "setting").unique(maintain_order=True).rows()
    place = {setting: number for number, setting in enumerate(settings)}
    figure = Figure(figsize=(7.6, 1.3 + 0.2 * len(settings)), layout="constrained")
    axes = figure.add_subplot()
    handles = []
    for number, (occupancy, mu) in enumerate(groups):
        colour, marker = BLOCK_COLOURS[number % len(BLOCK_COLOURS)], _MARKERS[number % len(_MARKERS)]
        rows = table.filter(occupancy=occupancy, mu=mu).drop_nulls("largest_percent")
        heights = [place[key] for key in rows.select("choice", "setting").rows()]
        axes.plot(rows["largest_percent"], heights, color=colour, marker=marker, markersize=5.0, linestyle="")
        as_is = rows.filter(choice=settings[0][0])["largest_percent"]
        if as_is.len():
            axes.axvline(as_is[0], color=colour, linewidth=0.9, linestyle=(0, (4, 2)))
        name = f"{occupancy}, {MU} = {mu:g}" if several else occupancy
        handles.append(Line2D([], [], color=colour, marker=marker, markersize=5.0, linewidth=0.9, label=plain(name)))
    before = None
    for (choice, _), row in place.items():
        if before not in (None, choice):
            axes.axhline(row - 0.5, color=GREY, linewidth=0.4, alpha=0.6)
        before = choice
    axes.axvline(0.0, color=INK, linewidth=0.8)
    axes.set_yticks(range(len(settings)), [plain(": ".join(filter(None, setting))) for setting in settings])
    axes.set_ylim(len(settings) - 0.5, -0.5)
    axes.set_xlabel("largest underestimation of a first storey (%); lines: the study as it is")
    axes.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(handles=handles, loc="outside upper center", ncols=4, frameon=False)
    return figure


MARKERS = ("o", "s", "D", "^", "v", "P", "X")


@drawing()
def study_figures(result: StudyResult) -> dict[str, Figure]:
    """Return the figures of a study by name; see `drawings`."""
    figures: dict[str, Figure] = {}
    for name, draw in drawings(result).items():
        # Those of all R have the same panels and texts of the same length.
        first = next((each for each in figures if each.startswith("drift_R") and name.startswith("drift_R")), None)
        figures[name] = lay_out(draw(), like=None if first is None else figures[first])
    return figures


def drawings(result: StudyResult) -> dict[str, Callable[[], Figure]]:
    """Return what draws each figure of a study, by its name: `spectrum`; for each R `underestimation`, `heat`, `slip`
    and `drift_R...`, with `_mu...` behind where there are several; `effective` if computed.
    """
    frictions, factors = labels_of(result.summary["mu"]), labels_of(result.summary["R"])
    draw: dict[str, Callable[[], Figure]] = {"spectrum": partial(spectrum_figure, result)}
    if result.fractions["effective"].null_count() < result.fractions.height:
        draw["effective"] = partial(effective_figure, result)
    for mu, name in frictions.items():
        suffix = f"_mu{name}" if len(frictions) > 1 else ""
        draw[f"underestimation{suffix}"] = partial(underestimation_figure, result, mu)
        draw[f"heat{suffix}"] = partial(heat_figure, result, mu)
        if _has_goods(result):
            draw[f"slip{suffix}"] = partial(slip_figure, result, mu)
        for factor, label in factors.items():
            draw[f"drift_R{label}{suffix}"] = partial(drift_figure, result, factor, mu)
    return draw


def _has_goods(result: StudyResult) -> bool:
    """Whether goods stand on a floor; a building of one storey has a bare roof alone."""
    return result.responses["peak_slip"].null_count() < result.responses.height


@drawing()
def phone_figures(result: StudyResult) -> dict[str, Figure]:
    """Return figures for narrow screens, by the name of that in whose place they stand."""
    frictions = labels_of(result.summary["mu"])
    mu, name = next(iter(frictions.items()))
    suffix = f"_mu{name}" if len(frictions) > 1 else ""
    return {f"underestimation{suffix}": lay_out(underestimation_figure(result, mu, narrow=True))}


@drawing()
def page_figures(result: StudyResult) -> dict[str, Figure]:
    """Return the figures of the page of a study by name: those of the study, its sensitivity and its validations."""
    figures = study_figures(result)
    if result.sensitivity.height:
        figures["sensitivity"] = sensitivity_figure(result.sensitivity)
    made = validations(result)
    if made is not None:
        section4, platform = made
        components = section4.runs["component"].unique(maintain_order=True)
        slope = COMPARED_SLOPES[0]
        figures |= {f"section4_{name}": section4_figure(section4, name, slope) for name in components}
        figures["section4_sliding"] = sliding_figure(section4)
        components = platform.runs["component"].unique(maintain_order=True)
        figures |= {f"platform_{name}": platform_figure(platform, name) for name in components}
    return figures


def effective_figure(result: StudyResult) -> Figure:
    """Effective fraction of each building against mu/C1, with its interval, the rule and the shares of the code."""
    table = result.fractions.drop_nulls("effective").with_columns(over=pl.col("mu") / pl.col("coefficient"))
    figure = Figure(figsize=(6.4, 4.6), layout="constrained")
    axes = figure.add_subplot()
    for position, (factor, label) in enumerate(labels_of(table["R"]).items()):
        here = table.filter(R=factor).unique(["over", "effective"], maintain_order=True)
        over, value = here["over"].to_numpy(), here["effective"].to_numpy()
        colour = BLOCK_COLOURS[position % len(BLOCK_COLOURS)]
        axes.vlines(over, here["low"].to_numpy(), here["high"].to_numpy(), color=colour, linewidth=0.7, alpha=0.5)
        axes.plot(
            over,
            value,
            color=colour,
            linestyle="",
            marker=MARKERS[position % len(MARKERS)],
            markersize=4.5,
            markerfacecolor=PAPER if position % 2 else colour,
            label=f"R = {label}",
        )
    end = 1.05 * max(1.2, float(table["over"].filter(table["over"].is_finite()).max() or 0.0))  # type: ignore[arg-type]
    over = np.linspace(0.0, end, 400)
    axes.plot(over, share_by_hand(over, 1.0), color=INK, linewidth=1.4, label=lettered(RULE))
    shares = result.summary.select("occupancy", "lambda_analysis").unique(maintain_order=True).rows()
    for occupancy, share in shares:
        axes.axhline(share, color=GREY, linewidth=1.0, linestyle=(0, (1, 2)))
        text = plain(f"{result.metadata['code']['name']}, {occupancy}")
        axes.annotate(text, (end, share), xytext=(-3, 3), textcoords="offset points", ha="right", fontsize=7.5)
    axes.set_xlim(0.0, end)
    axes.set_ylim(-0.03, 1.06)
    axes.set_xlabel(f"{MU}/C1, C1 = S$_a$/R$_y^{{2/3}}$, R$_y$ = S$_a$ W$_g$/V$_y$, at least 1")
    axes.set_ylabel(EFFECTIVE)
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(loc="outside upper center", ncols=3, frameon=False)
    figure.supxlabel(suite_caption(result, inches=6.4), fontsize=7.5)
    return figure
