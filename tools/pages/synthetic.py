"""The built-in synthetic motions, their measures and spectra."""

from __future__ import annotations

import re
from typing import Final

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

import seismass as sm
from pages.parts import Page, table
from seismass.media.roles import GREY, INK, SPECTRUM, TARGET
from seismass.media.style import STYLE
from seismass.motions.records.synthetic.eleven import ALL_RECIPES, SITE_RECIPES, Recipe
from seismass.studies.study import run_study
from seismass.studies.study.tables import findings

COMPARED: Final = np.geomspace(0.2, 1.5, 100)
SHOWN: Final = (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0)
SHARES: Final = ("median_underestimation", "p16_underestimation", "p84_underestimation", "leave_one_out")


def fill(page: Page) -> None:
    """Put in the tables of motions, of spectra, of the study and of parameters."""
    target, suite = sm.TargetSpectrum.asce7(), sm.builtin_suite()
    of_target, scatter = target_table(target)
    of_study, moved = study_table(target)
    page.tables(motions_table(suite, target), of_target, of_study, parameters_table())
    said = "is {} to {} of the target, with a scatter of {} in ln Sa on average"
    page.words(f"0.2 to 1.5 s the mean of the seven {said}; the mean of the eleven {said}.", *scatter)
    page.words("its largest underestimation of drift moves by {} percentage points", moved)
    page.figure("synthetic_histories", histories_figure, suite)
    page.figure("synthetic_spectra", spectra_figure, suite, target)


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
        measures = f"{record.pga_g:.3f}", *(f"{one:.2f}" for one in (record.pgv, record.pgd, record.arias))
        of = recipe.number, recipe.seed, f"{record.dt:g}", f"{record.duration:.0f}", *measures, f"{record.d5_95:.1f}"
        spread = f"{np.exp(np.log(ratio).mean()):.2f}", f"{ratio.min():.2f} to {ratio.max():.2f}"
        rows.append((*of, "none" if made is None else f"{made:g} s", judged, *spread))
    heads = "motion | seed | dt (s) | length (s) | PGA (g) | PGV (m/s) | PGD (m) | Arias (m/s) | D5-95 (s)"
    return table(f"{heads} | pulse made | found | Sa over target | range", rows)


def target_table(target: sm.TargetSpectrum) -> tuple[str, tuple[str, ...]]:
    """Return mean over target and scatter of both suites by period; range of the mean and mean scatter of each."""
    periods = np.array(SHOWN)
    columns, words = [periods], []
    for suite in map(sm.builtin_suite, ("seven", "eleven")):
        spectra, compared = (sm.response_spectrum(suite, at) for at in (periods, COMPARED))
        columns += [spectra.mean(axis=0) / target(periods), np.log(spectra).std(axis=0, ddof=1)]
        mean = compared.mean(axis=0) / target(COMPARED)
        words += [mean.min(), mean.max(), np.log(compared).std(axis=0, ddof=1).mean()]
    rows = ([f"{row[0]:g}", *(f"{value:.2f}" for value in row[1:])] for row in zip(*columns, strict=True))
    heads = "T (s) | seven: mean over target | scatter, ln Sa | eleven: mean over target | scatter, ln Sa"
    return table(heads, rows), tuple(f"{value:.2f}" for value in words)


def study_table(target: sm.TargetSpectrum) -> tuple[str, str]:
    """Return what the study says with the seven and with the eleven, and by how much its largest numbers move."""
    rows, largest = [], []
    for name in ("seven", "eleven"):
        result = run_study(sm.builtin_suite(name), target)
        for entry in findings(result.summary, result.fractions, result.metadata["code"]["name"]):
            found = entry["largest"]
            median, low, high, without = (found[f"{key}_percent"] for key in SHARES)
            where = f"storey {found['storey']} of {found['storeys']}, R = {found['R']:g}, alpha = {found['alpha']:g}"
            shares = f"{median:+.0f} %", f"{low:+.0f} to {high:+.0f} %"
            most = f"{found['underestimation_percent']:+.0f} %"
            left = f"{without:+.0f} % ({found['leave_one_out_record']})"
            rows.append((entry["occupancy"], name, most, where, *shares, left))
            largest.append(found["underestimation_percent"])
    rows.sort(key=lambda row: row[0], reverse=True)
    moved = max(abs(largest[2] - largest[0]), abs(largest[3] - largest[1]))
    heads = "occupancy | suite | largest underestimation | where | median | 16 to 84 % | without one motion"
    return table(heads, rows), f"{moved:.0f}"


def parameters_table() -> str:
    """Return the parameters of the motions by the site-based model."""
    rows = []
    for recipe in SITE_RECIPES:
        chosen, pulse = recipe.parameters, recipe.parameters.pulse
        numbers = (chosen.arias, chosen.d5_95, chosen.t_mid, chosen.frequency, chosen.frequency_rate, chosen.damping)
        said = "none" if pulse is None else f"{pulse.period:g} s, {pulse.velocity:g} m/s at {pulse.centre:g} s"
        rows.append([recipe.number, recipe.seed, *(f"{value:g}" for value in (*numbers, chosen.corner)), said])
    heads = "motion | seed | I_a (m/s) | D5-95 (s) | t_mid (s) | frequency (Hz) | rate (Hz/s) | damping"
    return table(f"{heads} | corner (Hz) | pulse", rows)


def histories_figure(suite: sm.Suite) -> Figure:
    """Accelerations and velocities of the motions, each column to one scale."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.4, 8.4), layout="constrained")
        axes = figure.subplots(len(suite), 2, sharex=True, sharey="col")
        longest = max(record.duration for record in suite)
        for (left, right), record, recipe in zip(axes, suite, ALL_RECIPES, strict=True):
            left.plot(record.time, record.acceleration / sm.STANDARD_GRAVITY, color=INK, linewidth=0.35)
            right.plot(record.time, record.velocity, color=SPECTRUM.colour, linewidth=0.8)
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
        axes.fill_between(
            periods, *bounds, color=SPECTRUM.colour, alpha=0.15, linewidth=0.0, label="one deviation of ln Sa"
        )
        axes.plot(periods, spectra.mean(axis=0), color=SPECTRUM.colour, linewidth=2.0, label="mean of eleven")
        goal = target(periods) / sm.STANDARD_GRAVITY
        axes.plot(periods, goal, **TARGET.look, linewidth=1.8, label="default target")
        axes.set_xscale("log")
        axes.set_xlim(periods[0], periods[-1])
        axes.set_ylim(0.0, 1.08 * float(spectra.max()))
        axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0], ["0.05", "0.1", "0.2", "0.5", "1", "2", "5"])
        axes.minorticks_off()
        axes.set_xlabel("period (s)")
        axes.set_ylabel("Sa (g), 5 % damping, unscaled")
        axes.legend(frameon=False, loc="upper right")
    return figure
