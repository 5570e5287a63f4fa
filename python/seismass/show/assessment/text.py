"""The page that an assessment prints: the answer first, then drifts, stability, slip, advice and every assumption."""

from __future__ import annotations

import math
import textwrap
from typing import Any, Final

import polars as pl

from seismass.assessment.advice import NAMES, motions_in_words
from seismass.assessment.models import ADVISED, ATTACHED, BARE, CODE, REAL, REAL_HIGH, REAL_LOW
from seismass.assessment.result import Assessment
from seismass.effective_mass import ByHand, EffectiveMass
from seismass.effective_mass.estimate import RULE, SAFE_RULE
from seismass.effective_mass.result import KIND_TEXTS
from seismass.media.text_table import number_text, text_table

WIDTH: Final = 108
"""Columns of the page."""
_SHOWN: Final = (REAL, ADVISED, CODE, ATTACHED, BARE)
"""Models whose drifts the page shows; those at the bounds of friction stand in the tables."""


def assessment_text(result: Assessment) -> str:
    """Return the page as text."""
    building = result.building
    lines = [building.name]
    if building.note:
        lines.append(f"  {building.note}")
    lines += ["", *_answer(result), "", *_drifts(result)]
    if building.heights is not None:
        lines += ["", *_stability(result)]
    if result.slip.height:
        lines += ["", *_slips(result)]
    lines += ["", *_motions(result), "", "In an analysis", *_bullets(result.advice)]
    if result.remarks:
        lines += ["", "Remarks", *_bullets(result.remarks)]
    lines += ["", "Assumptions", *_bullets(result.assumptions)]
    return "\n".join(lines)


def _answer(result: Assessment) -> list[str]:
    building, code = result.building, result.building.code
    if result.advised is None or result.advised_of_live_load is None:
        return ["ANSWER    no goods on the floors: there is no live load whose fraction could act as mass"]
    share = building.present_share
    present = (
        "" if share == 1.0 else f" of the goods present, {result.advised_of_live_load:.2f} of the design live load"
    )
    lines = [f"ANSWER    use lambda = {result.advised:.2f}{present}"]
    for name, words in ((REAL, "mu as stated"), (REAL_HIGH, "mu x {high:g}"), (REAL_LOW, "mu x {low:g}")):
        if name in result.effective:
            low, high = building.mu_factors
            lines.append(f"          {words.format(low=low, high=high):14}{_fraction(result.effective[name])}")
    lines.append(f"          on {motions_in_words(result.suite)}")
    real = result.effective[REAL]
    lines.append(f"          {real.kind}: {KIND_TEXTS[real.kind]}")
    of_present = "" if share == 1.0 else f" ({code.fraction / share:.2f} of the goods present)"
    spread = f" (range {code.low:g} to {code.high:g})" if code.low < code.high else ""
    source = "".join(f"; {part}" for part in (code.clause, code.status) if part)
    told = f"{code.code}, {code.use}: {code.fraction:g}{spread} of the design live load{of_present}{source}"
    lines += textwrap.wrap(told, WIDTH, initial_indent="code      ", subsequent_indent=" " * 10)
    lines += [
        f"rule      eta = mu_k/C1 = {real.eta:.3f}, C1 = {real.base_shear_coefficient:.4f}, mean peak base shear of "
        f"the runs: {RULE} = {real.estimate:.2f} at best,",
        f"          {SAFE_RULE} = {real.conservative:.2f} to be safe",
        *_rule(real.by_hand),
    ]
    return lines


def _rule(rule: ByHand) -> list[str]:
    behaviour = "yields" if rule.yields else "elastic"
    return [
        f"by hand   eta = {rule.eta:.3f}, C1 = {rule.base_shear_coefficient:.4f} without a run: {RULE} = "
        f"{rule.estimate:.2f}",
        f"          p = {rule.exponent:.2f} ({behaviour}, T = {rule.period:.3g} s, T_c = {rule.corner_period:.3g} s), "
        f"h_g/h_m = {rule.height_ratio:.2f}",
    ]


def _fraction(result: EffectiveMass) -> str:
    if not math.isfinite(result.value):
        return "no value: the building collapses under too many motions"
    scatter = "no interval"
    if result.suite_interval is not None and all(math.isfinite(end) for end in result.suite_interval):
        low, high = result.suite_interval
        scatter = f"{100.0 * result.confidence:g} % interval {low:.2f} to {high:.2f}"
    kind = {"stuck": "no goods slide", "one": "all act, and a little more", "zero": "none needs to be attached"}
    of = "" if result.statistic == "mean" else f", by the {result.statistic}"
    return f"lambda_eff = {result.value:.2f} ({scatter}{of})" + (
        f"; {kind[result.kind]}" if result.kind in kind else ""
    )


def _label(result: Assessment, model: str) -> str:
    if model == ADVISED and result.advised is not None:
        return f"lambda {result.advised:.2f}"
    if model == CODE:
        return f"code {result.building.code.fraction:g}"
    return NAMES[model]


def _models(result: Assessment) -> list[str]:
    known = set(result.storeys["model"])
    return [model for model in _SHOWN if model in known]


def _storey_label(row: dict[str, Any]) -> str:
    return f"{row['storey']} {row['name']}".rstrip()[:18]


def _of(result: Assessment, storey: int, model: str) -> dict[str, Any]:
    return result.storeys.filter((pl.col("model") == model) & (pl.col("storey") == storey)).row(0, named=True)


def _drifts(result: Assessment) -> list[str]:
    building, models = result.building, _models(result)
    scale, unit = (1e3, "mm") if building.heights is None else (1e2, "% of the height")
    limit = "" if building.heights is None else f"; limit {100.0 * building.drift_limit:g} %"
    motions = len(result.suite["motions"])
    lines = [f"Peak storey drift, {unit}: mean of {motions} motions [16 %, 84 % of them]{limit}"]
    rows = [["storey", *(_label(result, model) for model in models)]]
    for storey in range(1, building.storeys + 1):
        cells = []
        for model in models:
            row = _of(result, storey, model)
            mean, low, high = (number_text(row[name], scale=scale) for name in ("mean", "p16", "p84"))
            above = (
                "*" if building.heights is not None and (row["mean"] is None or row["mean_over_limit"] > 1.0) else " "
            )
            cells.append(f"{mean}{above}[{low}, {high}]")
        rows.append([_storey_label(_of(result, storey, models[0])), *cells])
    if building.heights is not None:
        rows.append(["motions above limit", *(f"{_above(result, model)} of {motions}" for model in models)])
    lines += [*text_table(rows), *_at_bounds(result, scale)]
    if any("*" in line for line in lines):
        lines.append("  * mean above the limit, or no mean because runs collapsed")
    return lines


def _at_bounds(result: Assessment, scale: float) -> list[str]:
    """Mean of the worst storey with sliding goods, at the bounds of friction."""
    low, high = result.building.mu_factors
    words = {REAL: "mu as stated", REAL_HIGH: f"mu x {high:g}", REAL_LOW: f"mu x {low:g}"}
    found = []
    for model, word in words.items():
        means = result.storeys.filter(pl.col("model") == model)["mean"]
        if len(means):
            worst = None if means.null_count() else float(means.to_numpy().max())
            found.append(f"{word} {number_text(worst, scale=scale)}")
    return [f"  worst storey while goods slide: {', '.join(found)}"] if len(found) > 1 else []


def _above(result: Assessment, model: str) -> int:
    """Motions under which the drift of some storey is above the limit."""
    of = result.runs.filter(pl.col("model") == model)
    beyond = of.filter(pl.col("collapsed") | (pl.col("peak_drift_ratio") > result.building.drift_limit))
    return beyond["motion"].n_unique()


def _stability(result: Assessment) -> list[str]:
    models = _models(result)
    lines = [f"Stability coefficient P d/(V h) at mean peaks; limit {result.building.theta_limit:g}"]
    rows = [["storey", *(_label(result, model) for model in models), "elastic P/(k h)"]]
    for storey in range(1, result.building.storeys + 1):
        of = [_of(result, storey, model) for model in models]
        values = [*(row["theta"] for row in of), of[0]["theta_elastic"]]
        rows.append([_storey_label(of[0]), *(number_text(value, ".3f") for value in values)])
    return lines + text_table(rows)


def _slips(result: Assessment) -> list[str]:
    lines = ["Slip of the goods, mm: what aisles and edges must allow for"]
    rows = [["floor", "mu", "slides in", "peak mean", "median", "84 %", "largest", "residual mean", "residual 84 %"]]
    names = ("peak_mean", "peak_median", "peak_p84", "peak_max", "residual_mean", "residual_p84")
    motions = len(result.suite["motions"])
    for model in (REAL, REAL_LOW):
        for row in result.slip.filter(pl.col("model") == model).iter_rows(named=True):
            rows.append(
                [
                    f"{row['floor']} {row['name']}".rstrip()[:18],
                    f"{row['mu_s']:.3g}" + (f"/{row['mu_k']:.3g}" if row["mu_k"] != row["mu_s"] else ""),
                    f"{row['motions_that_slide']} of {motions}",
                    *(number_text(row[name], ".1f", scale=1e3) for name in names),
                ]
            )
    return lines + text_table(rows)


def _motions(result: Assessment) -> list[str]:
    suite, runs = result.suite, result.runs.filter(pl.col("storey") == 1).height
    collapsed = {NAMES[model]: count for model, count in result.collapses.items() if count}
    text = ", ".join(f"{name} {count}" for name, count in collapsed.items()) or "none"
    lines = [f"collapses {text} ({runs} runs of {len(result.collapses)} models)"]
    names = ", ".join(suite["motions"])
    if result.scaling is not None:
        pairs = zip(suite["motions"], result.scaling.factors, strict=True)
        names = ", ".join(f"{name} x {factor:.3f}" for name, factor in pairs)
    wrapped = textwrap.wrap(f"{suite['name']}: {names}", WIDTH - 10)
    return [*lines, *(f"{'motions' if number == 0 else '':10}{line}" for number, line in enumerate(wrapped))]


def _bullets(sentences: tuple[str, ...]) -> list[str]:
    lines: list[str] = []
    for sentence in sentences:
        lines += textwrap.wrap(sentence, WIDTH, initial_indent="  - ", subsequent_indent="    ")
    return lines
