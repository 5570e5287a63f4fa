"""Figures and text of the validation."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from functools import partial
from typing import Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seismass.media.result import named_figure
from seismass.media.roles import ALPHA, ATTACHED, BLOCK_COLOURS, GREY, INK, KINDS, MU, SLIDE
from seismass.media.style import drawing
from seismass.media.text_table import text_line
from seismass.studies.validation import Claim, Validation
from seismass.studies.validation.shaking_table import CENTRAL, DAMPINGS, FRICTIONS, MASS_RATIOS, Platform
from seismass.studies.validation.three_storeys import (
    COMPARED_SLOPES,
    EXACT,
    OPENSEES,
    PEAK_G,
    STOREYS,
    Section4,
    stiffest,
)

_LINES: Final = {
    EXACT: {"color": SLIDE.colour, "linewidth": 3.0, "alpha": 0.4},
    OPENSEES: {"color": KINDS[0], "linewidth": 1.3},
}
_SPRINGS: Final = {"color": INK, "linewidth": 0.7, "linestyle": (0, (4, 4))}
_STILL: Final = 0.02
"""Histories are drawn from where they reach this share of their largest value."""


@drawing()
def section4_figure(result: Section4, component: str, second_slope: float) -> Figure:
    """Return drift of the storeys and slip of the blocks by all programs for a component and a second slope of those
    compared, as in the paper's Fig. 5, and below each what programs differ by from the exact run.
    """
    drawn = stiffest(result.of(component, second_slope))
    exact = drawn[0]
    moving = np.flatnonzero((np.abs(exact.drift) > _STILL * np.abs(exact.drift).max()).any(axis=1))
    start = max(0.0, float(exact.time[moving[0]]) - 0.5) if moving.size else 0.0
    figure = Figure(figsize=(9.0, 8.4), layout="constrained")
    panels = figure.subplots(2 * STOREYS, 2, sharex=True, height_ratios=[2, 1] * STOREYS)
    for storey in range(STOREYS):
        row = 2 * (STOREYS - 1 - storey)
        for axes, below, name in zip(*panels[row : row + 2], ("drift", "slip"), strict=True):
            for item in drawn:
                line = _LINES.get(item.program, _SPRINGS)
                label = f"{item.program}, {item.setting}" if item.setting else item.program
                values, true = (getattr(one, name)[:, storey] for one in (item, exact))
                axes.plot(item.time, 1e3 * values, label=label, **line)
                if item is not exact:
                    below.plot(item.time, 1e6 * (values - np.interp(item.time, exact.time, true)), **line)
            axes.set_xlim(start, float(exact.time[-1]))
            for one in (axes, below):
                one.axhline(0.0, color=GREY, linewidth=0.5)
            below.set_ylabel("\N{MICRO SIGN}m")
            what = f"storey {storey + 1}" if name == "drift" else f"block of floor {storey + 1}"
            axes.set_title(f"{name}, {what}", fontsize=8.5, loc="left")
            axes.set_ylabel("mm")
            if np.abs(getattr(exact, name)[:, storey]).max() == 0.0:
                axes.set_ylim(-1.0, 1.0)
                words = "does not slide" if name == "slip" else "does not drift"
                axes.text(0.5, 0.62, words, transform=axes.transAxes, ha="center", fontsize=8.0)
    for axes in panels[-1]:
        axes.set_xlabel("time (s)")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)
    text = f"component {component}, peak {PEAK_G:g} g, r2 = {second_slope:g}; below each: what differs from exact"
    figure.supxlabel(text, fontsize=7.5)
    figure.align_ylabels(panels)
    return figure


@drawing()
def sliding_figure(result: Section4) -> Figure:
    """Return the peak slip of each block over the second slope, a panel per component and peak of the record."""
    runs = result.runs
    peaks = runs["peak_g"].unique().sort().to_list()[1::2]
    names = runs["component"].unique(maintain_order=True).to_list()
    slopes = runs["second_slope"].unique().sort().to_list()
    width = 0.26
    figure = Figure(figsize=(9.0, 2.3 * len(names) + 0.8), layout="constrained")
    panels = figure.subplots(len(names), len(peaks), squeeze=False, sharex=True)
    for (i, name), (j, peak) in ((a, b) for a in enumerate(names) for b in enumerate(peaks)):
        axes = panels[i, j]
        rows = runs.filter(component=name, peak_g=peak).sort("second_slope")
        for floor, color in enumerate(BLOCK_COLOURS[:STOREYS]):
            slip = 1e3 * rows["peak_slip"].list.get(floor).to_numpy()
            place = np.arange(len(slopes)) + width * (floor - 1)
            axes.bar(place, slip, width, color=color, label=f"floor {floor + 1}")
        axes.set_title(f"{name}, peak {peak:g} g", fontsize=8.5)
        axes.set_xticks(range(len(slopes)), [f"{slope:g}" for slope in slopes])
    for axes in panels[-1]:
        axes.set_xlabel("second slope r2")
    for axes in panels[:, 0]:
        axes.set_ylabel("peak slip (mm)")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)
    return figure


@drawing()
def platform_figure(result: Platform, component: str) -> Figure:
    """Return bands of drift histories for both mass ratios, as in the paper's Fig. 4, and peak drift over period."""
    bands = [band for band in result.bands if band.component == component]
    period, mu, damping, amplitude = CENTRAL
    every = f"{MU} {FRICTIONS[0]:g} to {FRICTIONS[-1]:g}, damping {DAMPINGS[0]:g} to {DAMPINGS[-1]:g}"
    figure = Figure(figsize=(9.0, 6.6), layout="constrained")
    panels = figure.subplot_mosaic([["first"] * 2, ["second"] * 2, ["drift", "ratio"]])
    central = f"{MU} = {mu:g}, damping {damping:g}"
    for name, band in zip(("first", "second"), bands, strict=True):
        axes, time = panels[name], band.time
        low, high, middle, attached = (1e3 * value for value in (band.low, band.high, band.central, band.attached))
        axes.fill_between(time, low, high, color=SLIDE.colour, alpha=0.25, linewidth=0.0, label=every)
        axes.plot(time, middle, color=SLIDE.colour, linewidth=1.1, label=central)
        axes.plot(time, attached, **ATTACHED.look, linewidth=0.9, label="block attached")
        axes.set_title(f"{ALPHA} = {band.mass_ratio:g}, platform of T = {period:g} s", fontsize=8.5, loc="left")
        axes.set_ylabel("drift (mm)")
        axes.set_xlim(0.0, float(band.time[-1]))
        axes.set_xlabel("time of the model (s)")
    _over_period(panels["drift"], result.runs.filter(component=component, amplitude=amplitude))
    _heavier_over_lighter(panels["ratio"], result.runs.filter(component=component, amplitude=amplitude))
    handles, labels = panels["first"].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False)
    return figure


def _over_period(axes: Axes, runs: pl.DataFrame) -> None:
    """Range of peak drifts over friction and damping at each period."""
    for ratio, color in zip(MASS_RATIOS, BLOCK_COLOURS[:2], strict=True):
        rows = (
            runs.filter(mass_ratio=ratio)
            .group_by("period")
            .agg(low=pl.col("peak_drift").min(), high=pl.col("peak_drift").max())
        )
        rows = rows.sort("period")
        low, high = (1e3 * rows[name].to_numpy() for name in ("low", "high"))
        axes.fill_between(
            rows["period"], low, high, color=color, alpha=0.3, linewidth=0.0, label=f"{ALPHA} = {ratio:g}"
        )
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_xlabel("period of the platform (s)")
    axes.set_ylabel("peak drift (mm)")
    axes.legend(frameon=False, fontsize=8.0, loc="upper left")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)


def _heavier_over_lighter(axes: Axes, runs: pl.DataFrame) -> None:
    """Drift with the heavier block over that with the lighter, and with sliding over that of the attached block."""
    keys = ["period", "mu", "damping"]
    lighter, heavier = (runs.filter(mass_ratio=ratio).select(*keys, "peak_drift") for ratio in MASS_RATIOS)
    both = lighter.join(heavier, on=keys, suffix="_heavier")
    ratios = both.select("period", ratio=pl.col("peak_drift_heavier") / pl.col("peak_drift"))
    sliding = runs.select("period", ratio=pl.col("peak_drift") / pl.col("attached_drift"))
    labels = (f"{ALPHA} = {MASS_RATIOS[1]:g} over {MASS_RATIOS[0]:g}", "sliding over attached")
    for table, color, label in zip((ratios, sliding), (INK, SLIDE.colour), labels, strict=True):
        rows = table.group_by("period").agg(low=pl.col("ratio").min(), high=pl.col("ratio").max()).sort("period")
        axes.fill_between(rows["period"], rows["low"], rows["high"], color=color, alpha=0.3, linewidth=0.0, label=label)
    axes.axhline(1.0, color=GREY, linewidth=0.6)
    axes.set_ylim(0.0, None)
    axes.set_xlabel("period of the platform (s)")
    axes.set_ylabel("ratio of peak drifts")
    axes.legend(frameon=False, fontsize=8.0, loc="lower right")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)


_WIDTH: Final = 100


def validation_text(result: Validation) -> str:
    """Return the validations as lines to read: the motions, the comparison of programs, the claims."""
    metadata = result.metadata()
    lines = [
        f"study      {metadata['suite']}",
        f"section 4  {metadata['section4_motion']}",
        f"platform   {metadata['platform_motion']}",
        "",
        "Section 4: largest difference from the exact kernel",
        *differences_text(result.section4),
        "",
        "Claims of the paper",
    ]
    for claim in result.claims:
        lines += claim_text(claim)
    return "\n".join(lines)


def differences_text(section4: Section4) -> list[str]:
    """Return a line per run and program, with the differences of drift and slip."""
    widths = (-12, 6, -20, -16, 22, 22)
    lines = [text_line(("component", "r2", "  program", "setting", "drift", "slip"), widths)]
    for row in section4.differences.rows(named=True):
        cells = []
        for name in ("drift", "slip"):
            size, share = row[f"{name}_mm"], row[f"{name}_percent"]
            text = "-" if size is None else f"{size:.2g} mm"
            cells.append(text if share is None else f"{text}, {share:.2g} %")
        run = (row["component"], f"{row['second_slope']:g}", f"  {row['program']}", row["setting"])
        lines.append(text_line((*run, *cells), widths))
    return lines


def claim_text(claim: Claim) -> list[str]:
    """Return a claim as a few lines."""
    depends = [f"depends on: {claim.depends_on}"] if claim.depends_on else []
    text = textwrap.wrap(f"{claim.number:>2}  {claim.verdict}: {claim.claim}", _WIDTH, subsequent_indent="    ")
    for part in (f"({claim.source}) {claim.numbers}", *depends):
        text += textwrap.wrap(part, _WIDTH, initial_indent="    ", subsequent_indent="    ")
    return text


def claims_markdown(claims: list[Claim]) -> str:
    """Return the claims as a table in Markdown."""
    rows = [
        f"| {claim.number} | {claim.claim} ({claim.source}) | **{claim.verdict}** | {claim.numbers} "
        f"| {claim.depends_on or '-'} |"
        for claim in claims
    ]
    return "\n".join(["| | claim | verdict | our numbers | depends on |", "| --- | --- | --- | --- | --- |", *rows])


def drawings(result: Validation) -> dict[str, Callable[[], Figure]]:
    """Return what draws each figure, by its name."""
    compared, platform = result.section4, result.platform
    components = compared.runs["component"].unique(maintain_order=True)
    return {
        **{
            f"section4_{component}_r{slope:g}": partial(section4_figure, compared, component, slope)
            for component in components
            for slope in COMPARED_SLOPES
        },
        "section4_sliding": partial(sliding_figure, compared),
        **{
            f"platform_{name}": partial(platform_figure, platform, name)
            for name in platform.runs["component"].unique(maintain_order=True)
        },
    }


def figure_names(result: Validation) -> tuple[str, ...]:
    """Return the names of the figures."""
    return tuple(drawings(result))


def validation_figure(result: Validation, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    return drawings(result)[named_figure(result, name)]()
