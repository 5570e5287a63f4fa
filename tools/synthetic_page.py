"""Writes docs/synthetic.md: the built-in synthetic motions, their measures and spectra, and two figures.

Usage: python tools/synthetic_page.py
"""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterable
from pathlib import Path
from typing import Final

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

import seismass as sm
from seismass.media.figure_file import save_figure
from seismass.media.roles import BLUE, GREY, INK, VERMILION
from seismass.media.style import STYLE
from seismass.records.synthetic.files import ALL_RECIPES
from seismass.records.synthetic.seven import Recipe
from seismass.records.synthetic.site import SITE_RECIPES
from seismass.study import run_study
from seismass.study.findings import findings

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "synthetic.md"
COMPARED: Final = np.geomspace(0.2, 1.5, 100)
SHOWN: Final = (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0)


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table in Markdown."""
    titles = list(head)
    lines = [titles, ["---"] * len(titles), *(list(row) for row in rows)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def motions_table(suite: sm.Suite, target: sm.TargetSpectrum) -> str:
    """Return the measures of each motion, its pulse and its distance from the target."""
    ratios = sm.response_spectrum(suite, COMPARED) / target(COMPARED)
    rows = []
    for record, recipe, ratio in zip(suite, ALL_RECIPES, ratios, strict=True):
        if isinstance(recipe, Recipe):
            made = recipe.pulse_period
        else:
            made = None if recipe.parameters.pulse is None else recipe.parameters.pulse.period
        found = sm.pulses.baker2007(record)
        judged = "ambiguous" if found.ambiguous else f"{found.period:.2f} s" if found.is_pulse else "none"
        rows.append(
            (
                f"{recipe.number}",
                f"{recipe.seed}",
                f"{record.dt:g}",
                f"{record.duration:.0f}",
                f"{record.pga_g:.3f}",
                f"{record.pgv:.2f}",
                f"{record.pgd:.2f}",
                f"{record.arias:.2f}",
                f"{record.d5_95:.1f}",
                "none" if made is None else f"{made:g} s",
                judged,
                f"{np.exp(np.log(ratio).mean()):.2f}",
                f"{ratio.min():.2f} to {ratio.max():.2f}",
            )
        )
    head = "motion|seed|dt (s)|length (s)|PGA (g)|PGV (m/s)|PGD (m)|Arias (m/s)|D5-95 (s)|pulse made|found"
    return table([*head.split("|"), "Sa over target", "range"], rows)


def target_table(target: sm.TargetSpectrum) -> tuple[str, str]:
    """Return the mean over the target and the scatter of both suites by period, and the same in words."""
    periods = np.array(SHOWN)
    columns, words = [], []
    for name in ("seven", "eleven"):
        suite = sm.builtin_suite(name)
        spectra = sm.response_spectrum(suite, periods)
        columns += [spectra.mean(axis=0) / target(periods), np.log(spectra).std(axis=0, ddof=1)]
        range_of = sm.response_spectrum(suite, COMPARED)
        mean = range_of.mean(axis=0) / target(COMPARED)
        scatter = float(np.log(range_of).std(axis=0, ddof=1).mean())
        words.append(
            f"the mean of the {name} is {mean.min():.2f} to {mean.max():.2f} of the target, with a scatter of "
            f"{scatter:.2f} in ln Sa on average"
        )
    rows = [[f"{period:g}", *(f"{column[i]:.2f}" for column in columns)] for i, period in enumerate(periods)]
    head = ("T (s)", "seven: mean over target", "scatter, ln Sa", "eleven: mean over target", "scatter, ln Sa")
    return table(head, rows), f"From 0.2 to 1.5 s {words[0]}; {words[1]}."


def study_table(target: sm.TargetSpectrum) -> tuple[str, str]:
    """Return what the study says with the seven and with the eleven, and what it shows in words."""
    rows, largest = [], []
    for name in ("seven", "eleven"):
        result = run_study(sm.builtin_suite(name), target)
        for entry in findings(result.summary, result.fractions, result.metadata["code"]["name"]):
            found = entry["largest"]
            shares = [found[f"{key}_percent"] for key in _SHARES]
            rows.append(
                (
                    entry["occupancy"],
                    name,
                    f"{found['underestimation_percent']:+.0f} %",
                    f"storey {found['storey']} of {found['storeys']}, R = {found['R']:g}, alpha = {found['alpha']:g}",
                    f"{shares[0]:+.0f} %",
                    f"{shares[1]:+.0f} to {shares[2]:+.0f} %",
                    f"{shares[3]:+.0f} % ({found['leave_one_out_record']})",
                )
            )
            largest.append(found["underestimation_percent"])
    rows.sort(key=lambda row: row[0], reverse=True)
    moved = max(abs(largest[2] - largest[0]), abs(largest[3] - largest[1]))
    head = ("occupancy", "suite", "largest underestimation", "where", "median", "16 to 84 %", "without one motion")
    words = (
        "What eleven in place of seven do to the study (`seismass study --suite eleven`): its largest underestimation "
        f"of drift moves by {moved:.0f} percentage points at most. Each is the largest of 108 storeys, and the motion "
        "by motion scatter beside it is wider than that."
    )
    return table(head, rows), words


_SHARES: Final = (
    "median_underestimation",
    "p16_underestimation",
    "p84_underestimation",
    "leave_one_out",
)


def parameters_table() -> str:
    """Return the parameters of the motions by the site-based model."""
    rows = []
    for recipe in SITE_RECIPES:
        chosen, pulse = recipe.parameters, recipe.parameters.pulse
        numbers = (chosen.arias, chosen.d5_95, chosen.t_mid, chosen.frequency, chosen.frequency_rate, chosen.damping)
        said = "none" if pulse is None else f"{pulse.period:g} s, {pulse.velocity:g} m/s at {pulse.centre:g} s"
        rows.append(
            [f"{recipe.number}", f"{recipe.seed}", *(f"{value:g}" for value in (*numbers, chosen.corner)), said]
        )
    head = "motion|seed|I_a (m/s)|D5-95 (s)|t_mid (s)|frequency (Hz)|rate (Hz/s)|damping|corner (Hz)|pulse"
    return table(head.split("|"), rows)


def page() -> str:
    """Return the page."""
    target, suite = sm.TargetSpectrum.asce7(), sm.builtin_suite()
    values = {"motions": motions_table(suite, target), "parameters": parameters_table()}
    values["target"], values["target_words"] = target_table(target)
    values["study"], values["study_words"] = study_table(target)
    text = (ROOT / "tools" / "pages" / "synthetic.md").read_text(encoding="utf-8")
    for name in ("target_words", "study_words"):
        values[name] = textwrap.fill(values[name], 118, break_on_hyphens=False)
    return re.sub(r"\{(\w+)\}", lambda match: values[match[1]], text)


def histories_figure(suite: sm.Suite) -> Figure:
    """Accelerations and velocities of the motions, each column to one scale."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.4, 8.4), layout="constrained")
        axes = figure.subplots(len(suite), 2, sharex=True, sharey="col")
        longest = max(record.duration for record in suite)
        for (left, right), record, recipe in zip(axes, suite, ALL_RECIPES, strict=True):
            left.plot(record.time, record.acceleration / sm.STANDARD_GRAVITY, color=INK, linewidth=0.35)
            right.plot(record.time, record.velocity, color=BLUE, linewidth=0.8)
            for one in (left, right):
                one.axhline(0.0, color=GREY, linewidth=0.4)
                one.set_xlim(0.0, longest)
                one.spines[["top", "right"]].set_visible(False)
            left.set_ylim(-0.62, 0.62)
            right.set_ylim(-0.85, 0.85)
            left.set_ylabel(f"{recipe.number}", rotation=0, labelpad=10.0, va="center")
            note = {"horizontalalignment": "right", "verticalalignment": "top", "fontsize": 7.0}
            left.text(longest, 0.62, f"PGA {record.pga_g:.2f} g", **note)
            pulse = re.search(r"pulse of ([\d.]+ s)", record.remarks[0])
            said = f", pulse {pulse[1]}" if pulse else ""
            right.text(longest, 0.85, f"PGV {record.pgv:.2f} m/s{said}", **note)
        axes[0, 0].set_title("acceleration (g)", loc="left")
        axes[0, 1].set_title("velocity (m/s)", loc="left")
        for one in axes[-1]:
            one.set_xlabel("time (s)")
    return figure


def spectra_figure(suite: sm.Suite, target: sm.TargetSpectrum) -> Figure:
    """Spectra of the motions, their mean with one standard deviation of ln Sa, and the target."""
    periods = np.geomspace(0.05, 5.0, 160)
    spectra = sm.response_spectrum(suite, periods) / sm.STANDARD_GRAVITY
    middle, scatter = np.exp(np.log(spectra).mean(axis=0)), np.log(spectra).std(axis=0, ddof=1)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.0, 4.2), layout="constrained")
        axes = figure.add_subplot()
        for number, spectrum in enumerate(spectra, start=1):
            style = (0, (1.2, 1.2)) if number > 7 else "-"
            label = {1: "motions 1 to 7", 8: "motions 8 to 11"}.get(number)
            axes.plot(periods, spectrum, color=GREY, linewidth=0.8, linestyle=style, label=label)
        bounds = (middle * np.exp(-scatter), middle * np.exp(scatter))
        axes.fill_between(periods, *bounds, color=BLUE, alpha=0.15, linewidth=0.0, label="one deviation of ln Sa")
        axes.plot(periods, spectra.mean(axis=0), color=BLUE, linewidth=2.0, label="mean of eleven")
        goal = target(periods) / sm.STANDARD_GRAVITY
        axes.plot(periods, goal, color=VERMILION, linewidth=1.8, linestyle=(0, (5, 2)), label="default target")
        axes.set_xscale("log")
        axes.set_xlim(periods[0], periods[-1])
        axes.set_ylim(0.0, 1.08 * float(spectra.max()))
        axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0], ["0.05", "0.1", "0.2", "0.5", "1", "2", "5"])
        axes.minorticks_off()
        axes.set_xlabel("period (s)")
        axes.set_ylabel("Sa (g), 5 % damping, unscaled")
        axes.legend(frameon=False, loc="upper right")
    return figure


def main() -> int:
    """Write page and figures."""
    PAGE.write_text(page(), encoding="utf-8")
    suite = sm.builtin_suite()
    folder = ROOT / "docs" / "figures"
    save_figure(histories_figure(suite), "png", folder / "synthetic_histories.png")
    save_figure(spectra_figure(suite, sm.TargetSpectrum.asce7()), "png", folder / "synthetic_spectra.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
