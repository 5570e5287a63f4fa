"""What figures of a study share beside their style: captions, labels; and the spectra of a study (paper, Fig. 1)."""

from __future__ import annotations

import textwrap
from typing import Any, Final, Protocol

import polars as pl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.units import STANDARD_GRAVITY
from seismass.media.figure_file import CAPTION_CHARACTERS
from seismass.media.roles import BLUE, GREY, LAMBDA, MU, OMEGA, VERMILION
from seismass.media.style import PERIOD_TICKS, plain
from seismass.study import motions_text

LEAST_WIDTH: Final = 7.0
"""Least width of a figure with a legend of two columns (inches)."""


class StudyFrames(Protocol):
    """What figures of a study are drawn from: a `StudyResult`, or the tables of a folder."""

    @property
    def metadata(self) -> dict[str, Any]:
        """Metadata, as `StudyResult.metadata`."""

    @property
    def responses(self) -> pl.DataFrame:
        """One row per building, model, motion and storey."""

    @property
    def summary(self) -> pl.DataFrame:
        """One row per building and storey."""

    @property
    def fractions(self) -> pl.DataFrame:
        """One row per building."""

    @property
    def spectrum(self) -> pl.DataFrame:
        """One row per period."""


def suite_caption(result: StudyFrames, mu: float | None = None, *, inches: float = 9.0) -> str:
    """Return a few lines, for a figure so many inches wide, on the motions, the parameters that decide the result (all
    frictions unless `mu`), and the target spectrum.
    """
    suite, chosen = result.metadata["suite"], result.metadata["parameters"]
    frictions = chosen["mu"] if mu is None else [mu]
    damped = {
        "bare": "modes of the bare building, one C for all models",
        "loaded": "modes of the building with all its goods, one C for all models",
        "own": "modes of each model",
    }[chosen["damping_base"]]
    springs = (
        f"{OMEGA} = {chosen['overstrength']:g}, r2 = {chosen['second_slope']:g}, r3 = {chosen['third_slope']:g}, "
        f"{'P-Delta' if chosen['p_delta'] else 'no P-Delta'}"
    )
    text = (
        f"{motions_text(suite)} ({plain(suite['name'])}), scaled for T = {chosen['scaling_period']:g} s; "
        f"{MU} = {', '.join(f'{value:g}' for value in frictions)}; {springs}; "
        f"damping {100.0 * chosen['damping']:g} % in the {damped}; target: {plain(result.metadata['target']['label'])}"
    )
    return textwrap.fill(text, int(CAPTION_CHARACTERS * inches))


def labels_of(values: pl.Series) -> dict[float, str]:
    """Return what each value is called, in order: as short as they differ."""
    ordered = values.unique().sort().to_list()
    labels = ([f"{value:.{digits}g}" for value in ordered] for digits in range(6, 18))
    return dict(zip(ordered, next(names for names in labels if len(set(names)) == len(names)), strict=True))


def occupancy_title(occupancy: str, design: float, analysis: float) -> str:
    """Return what a figure calls an occupancy: its name with lambda, or with that of the design and of the analysis."""
    shares = f"{design:g}" if design == analysis else f"{design:g}, {analysis:g}"
    return f"{plain(occupancy)}, {LAMBDA} = {shares}"


def spectrum_figure(result: StudyFrames) -> Figure:
    """Target, mean scaled and scaled spectra, with the range in which the mean must not be below the target."""
    table = result.spectrum
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    axes = figure.add_subplot()
    periods = table["period"].to_numpy()
    motions = [name for name in table.columns if name.startswith("motion_")]
    for name in motions:
        axes.plot(periods, table[name] / STANDARD_GRAVITY, color=GREY, linewidth=0.7, alpha=0.7)
    axes.plot(periods, table["mean"] / STANDARD_GRAVITY, color=BLUE, linewidth=2.0)
    axes.plot(periods, table["target"] / STANDARD_GRAVITY, color=VERMILION, linewidth=1.8, linestyle=(0, (5, 2)))
    shortest, longest, _ = result.metadata["scaling"]["periods"]
    axes.axvspan(shortest, longest, color=BLUE, alpha=0.07, linewidth=0.0)
    axes.set_xscale("log")
    axes.set_xlim(periods[0], periods[-1])
    axes.set_ylim(0.0, None)
    ticks = [tick for tick in PERIOD_TICKS if periods[0] <= tick <= periods[-1] * 1.0001]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("period (s)")
    damping = 100.0 * result.metadata["parameters"]["damping"]
    axes.set_ylabel(f"pseudo-acceleration, {damping:g} % damping (g)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    handles = [
        Line2D([], [], color=BLUE, linewidth=2.0, label=f"mean of {motions_text(result.metadata['suite'])}, scaled"),
        Line2D([], [], color=VERMILION, linewidth=1.8, linestyle=(0, (5, 2)), label="target"),
        Line2D([], [], color=GREY, linewidth=0.7, label="each motion, scaled"),
        Line2D([], [], color=BLUE, alpha=0.12, linewidth=8.0, label=f"range of scaling, {shortest:g} to {longest:g} s"),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False)
    label = textwrap.fill(f"Target: {plain(result.metadata['target']['label'])}", 90)
    figure.supxlabel(label, fontsize=7.5)
    return figure
