"""The page that an assessment prints: the answer first, then drifts, stability, slip, advice and every assumption; and
the folder that it writes.
"""

from __future__ import annotations

import json
import os
import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import polars as pl

from seismass.assessment.answer import deciding
from seismass.assessment.checks import friction_words
from seismass.assessment.models import ADVISED, BARE, CODE, NAMES, SLIDING, SLIDING_HIGH, SLIDING_LOW, friction_factors
from seismass.assessment.result import Assessment
from seismass.base.errors import InvalidOption
from seismass.base.folders import check_out, write_folder
from seismass.base.values import as_path
from seismass.effective_mass.rule import RULE_UNKNOWN
from seismass.media.result import ANIMATION, PAGE, described_lines, result_files, stored_tables
from seismass.media.text_table import text_table
from seismass.model.codes import FROM_MEMORY, MARK, NOT_CHECKED, SECOND_HAND
from seismass.show.assessment.tables import (
    analysis_table,
    animated,
    most_slip,
    quantity_text,
    short_words,
    slip_units,
    storey_drifts,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDTH: Final = 108
"""Columns of the page."""
BAR: Final = 36
"""Columns of a bar of drifts."""
LONGEST_NAME: Final = 28
"""Letters of a name in a table."""
FIGURES: Final = ("drift", "effective_fraction", "slip", "spectrum")
"""Names of all figures, those of earlier versions too; what is not written again is removed."""
_STABLE: Final = (ADVISED, BARE, SLIDING, SLIDING_HIGH, SLIDING_LOW, CODE)
"""Models whose drifts and stability coefficients are printed, in this order; that with all goods is in the tables."""


def assessment_text(result: Assessment) -> str:
    """Return the page as text."""
    lines = [result.name, *([f"  {note}"] if (note := result.content["note"]) else [])]
    lines += ["", *_answer(result), "", *storey_bars(result), "", *_drifts(result)]
    if result.slip.height and (result.slip.group_by("model", "floor").len()["len"] > 1).any():
        lines += ["", *_slips(result)]
    if result.answer.analyses:
        lines += ["", *_analysis(result)]
    lines += ["", *_design(result)]
    lines += ["", _collapses(result), "", "In an analysis", *_bullets(result.advice)]
    if result.remarks:
        lines += ["", "Remarks", *_bullets(result.remarks)]
    lines += ["", "Assumptions", *_bullets(result.assumptions)]
    return "\n".join(lines)


def _paragraph(label: str, text: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent=f"{label:10}", subsequent_indent=" " * 10)


def _answer(result: Assessment) -> list[str]:
    answer = result.answer
    doubts = enumerate(answer.doubt_lines)
    lines = [line for number, doubt in doubts for line in _paragraph("ANSWER" if number == 0 else "", doubt)]
    lines += _paragraph("" if lines else "ANSWER", answer.statement)
    if answer.analyses:
        lines += _paragraph("", answer.opening)
    for number, words in enumerate(answer.pair, start=1):
        lines += textwrap.wrap(f"{number}  {words}", WIDTH, initial_indent=" " * 10, subsequent_indent=" " * 13)
    for number, sentence in enumerate(answer.governs):
        lines += _paragraph("governs" if number == 0 else "", sentence)
    for number, sentence in enumerate(answer.goods):
        lines += _paragraph("goods" if number == 0 else "", f"present: {sentence}" if number == 0 else sentence)
    if answer.why:
        lines += _paragraph("why", answer.why)
    for number, sentence in enumerate(answer.sensitivity):
        lines += _paragraph("varies" if number == 0 else "", sentence)
    if answer.design:
        lines += _paragraph("strength", answer.design)
    lines += _paragraph("motions", answer.motions)
    if not result.effective:
        return lines
    lines += _paragraph("code", _code(result))
    if answer.analyses:
        share = result.effective[SLIDING]
        unknown = [remark for remark in share.remarks if remark.startswith(RULE_UNKNOWN)]
        if unknown:
            return [*lines, *_paragraph("by hand", f"not applied: {'; '.join(unknown)}")]
        lines += _paragraph("by hand", _by_hand(result))
    return lines


def _code(result: Assessment) -> str:
    """The code's fraction on the base of the shares, with its own in brackets."""
    code, share, of_load = result.code, result.present_share, result.code_share
    called = f"{code.code}{code.mark}, {result.content['code']['uses']}"
    spread = f", range {code.low:g} to {code.high:g}" if code.low < code.high else ""
    source = "".join(f"; {part}" for part in (code.clause, code.status, "" if code.checked else NOT_CHECKED) if part)
    return (
        f"{called}: {of_load / share:.2f} of the goods present ({of_load:.3g} of the design live load{spread}){source}"
    )


def _by_hand(result: Assessment) -> str:
    """The rule at the friction that decides, and at the others."""
    decisive, words = deciding(result.effective), friction_words(result.mu_factors)
    others = (f"{words[name]} {one.by_hand.estimate:.2f}" for name, one in result.effective.items() if name != decisive)
    rest, factor = ", ".join(others), friction_factors(result.mu_factors)[decisive]
    return (
        f"{words[decisive]}: {result.effective[decisive].by_hand.words_in(result.units, factor)}"
        + f"; with {rest}" * bool(rest)
    )


def _label(result: Assessment, model: str) -> str:
    """Heading of a model's column, short."""
    low, high = result.mu_factors
    return {
        ADVISED: "analysis 1",
        BARE: {0: "no goods", 1: "the analysis"}.get(len(result.answer.pair), "analysis 2"),
        CODE: f"code {result.code_share:.3g}{result.code.mark}",
        SLIDING: "slide, mu",
        SLIDING_HIGH: f"mu x {high:g}",
        SLIDING_LOW: f"mu x {low:g}",
    }[model]


def _models(result: Assessment) -> list[str]:
    known = set(result.storeys["model"]) - ({ADVISED} if len(result.answer.pair) == 1 else set())
    return [model for model in _STABLE if model in known]


def _named(*parts: Any) -> str:
    """A number with its names, cut between words where it is long."""
    return textwrap.shorten(" ".join(str(part) for part in parts if part), LONGEST_NAME, placeholder=" ...")


def storey_bars(result: Assessment) -> list[str]:
    """What each storey uses of its limit, as the figure draws it, and the slip to allow for on its floor."""
    rows, slips, units = storey_drifts(result.storeys, result.governing), most_slip(result.slip), result.units
    limit = result.drift_limit is not None
    scale, unit = units.drifts(ratio=limit)
    right = 1.05 * max([row.largest for row in rows] + [row.scatter[1] for row in rows if row.scatter] + [1.0] * limit)
    clear = result.clearances

    def place(value: float) -> int:
        return min(BAR - 1, int(value / right * BAR))

    table = []
    for row in reversed(rows):
        cells = ["."] * BAR
        for ends, sign in ((row.scatter, "-"), (row.sliding, "=")):
            for cell in range(place(ends[0]), place(ends[1]) + 1) if ends is not None else ():
                cells[cell] = sign
        marks = {"c": row.code, "|": 1.0 if limit else None, **row.analyses}
        for sign, value in marks.items():
            if value is not None:
                cells[place(value)] = sign
        used = f"{scale * row.largest:.{0 if limit else 2}f} {unit}"
        slip = slips.get(row.storey)
        allowed = "" if slip is None else f"slip {units.text('slip', slip['peak_p84'])}"
        allowed += f" of {units.text('slip', clear[row.storey], '.3g')}" if slip and row.storey in clear else ""
        model = row.model if result.answer.analyses else ""
        table.append([_named(row.storey, row.name), f"|{''.join(cells)}|", used, allowed, model])
    words = {"1": "1 the analysis", "0": "0 no goods", "12": "1 and 2 analyses"}
    parts = [words["".join(rows[0].analyses)]]
    parts += ["= goods that slide, over the frictions", "c the model of the code"] * (rows[0].sliding is not None)
    parts += ["- 16 to 84 % of the motions", *["| the limit"] * limit]
    shown = [index for index in range(5) if any(row[index] for row in table)]
    title = f"Drift of each storey, {unit}"
    if result.drift_limit is not None:
        title = f"What each storey uses of its drift limit, {100.0 * result.drift_limit:g} % of the height"
    return [
        title,
        *text_table([[row[index] for index in shown] for row in table], left=5),
        *(f"  {line}" for line in textwrap.wrap("; ".join(parts), WIDTH)),
    ]


def _of(result: Assessment, storey: int, model: str) -> dict[str, Any]:
    return result.storeys.filter((pl.col("model") == model) & (pl.col("storey") == storey)).row(0, named=True)


def _drifts(result: Assessment) -> list[str]:
    models, most = _models(result), result.drift_limit
    scale, unit = result.units.drifts(ratio=most is not None)
    unit += " of the height" * (most is not None)
    limit = "" if most is None else f"; limit {100.0 * most:g} %"
    motions = len(result.suite["motions"])
    governed = bool(result.answer.analyses)
    lines = [f"Peak storey drift, {unit}: capped mean of {motions} motions{limit}"]
    rows = []
    for row in result.governing.iter_rows(named=True):
        values = [_of(result, row["storey"], model) for model in models]
        cells = {one["model"]: _marked(one["mean"], one["mean_over_limit"], scale) for one in values}
        if governed:
            drift = _marked(row["governing"], row["governing_over_limit"], scale)
            cells["governed_by"] = f"{drift} {short_words(row['governed_by'])}".rstrip()
        rows.append({"storey": _named(row["storey"], row["name"]), **cells})
    marks = "".join("".join(list(row.values())[1:]) for row in rows)
    if most is not None:
        above = {model: f"{_above(result, model, most)} of {motions}" for model in models}
        rows.append({"storey": "motions above limit", **above})
    heads = {model: _label(result, model) for model in models}
    lines += described_lines("assessment: governing", pl.DataFrame(rows), headers=heads)
    notes = [f"  * mean above the limit{limit.removeprefix('; limit')}"] * ("*" in marks)
    return [*lines, *notes]


def _marked(mean: float, over_limit: float | None, scale: float) -> str:
    return f"{scale * mean:.2f}" + ("*" if over_limit is not None and over_limit > 1.0 else "")


def _slips(result: Assessment) -> list[str]:
    """Slip of each kind of goods, where a floor has several."""
    rows = result.slip.filter(pl.col("model").is_in([SLIDING, SLIDING_LOW]))
    shown = rows.select(
        pl.Series("floor", [_named(*row) for row in rows.select("floor", "name", "goods").iter_rows()]),
        *("mu_s", "mu_k", "motions_that_slide", "peak_median", "peak_p84", "peak_max"),
    )
    title = f"Slip of each kind of goods under {len(result.suite['motions'])} motions, friction as stated and at its"
    return [f"{title} lower bound", *described_lines("assessment: slip", shown, units=slip_units(result))]


def _analysis(result: Assessment) -> list[str]:
    """What to type into another program, floor by floor."""
    lines = [
        "For another program: mass of each floor, and multiplier of the design live load in the mass source",
        "  (--mass-source FILE.e2k or FILE.s2k writes both for ETABS or SAP2000)",
    ]
    table, options = analysis_table(result)
    floors = pl.Series("floor", [_named(*row) for row in table.select("floor", "name").iter_rows()])
    return lines + described_lines("assessment: analysis", table.drop("name").with_columns(floors), **options)


def _above(result: Assessment, model: str, limit: float) -> int:
    """Motions under which the drift of some storey is above the limit."""
    rows = result.runs.filter(pl.col("model") == model)
    above_limit = rows.filter(pl.col("collapsed") | (pl.col("peak_drift_ratio") > limit))
    return above_limit["motion"].n_unique()


def _design(result: Assessment) -> list[str]:
    """W, T, C_s, V and V_y of each storey, each with its clause."""
    stated = result.input["design"] is None
    title = "Strengths as stated" if stated else f"Design of the strengths by {result.input['code_of_design']}"
    rows = []
    for row in result.tables["design"].iter_rows(named=True):
        mark = MARK if row["status"] in (SECOND_HAND, FROM_MEMORY) else ""
        name = " ".join(
            str(part) for part in (row["direction"], row["quantity"], row["storey"]) if part not in ("", None)
        )
        note = textwrap.shorten(row["note"], WIDTH - 60, placeholder=" ...")
        value = quantity_text(row["value"], row["unit"], result.units)
        rows.append({"quantity": name, "value": value, "clause": row["clause"] + mark, "note": note})
    notes = [f"  {MARK} {NOT_CHECKED}"] * any(MARK in row["clause"] for row in rows)
    return [title, *described_lines("assessment: design", pl.DataFrame(rows), left=4), *notes]


def _collapses(result: Assessment) -> str:
    """Which models collapse, of how many runs."""
    runs = result.runs.filter(pl.col("storey") == 1).height
    collapsed = {NAMES[model]: count for model, count in result.collapses.items() if count}
    text = ", ".join(f"{name} {count}" for name, count in collapsed.items()) or "none"
    return f"collapses {text} ({runs} runs of {len(result.collapses)} models)"


def _bullets(sentences: tuple[str, ...]) -> list[str]:
    lines: list[str] = []
    for sentence in sentences:
        lines += textwrap.wrap(sentence, WIDTH, initial_indent="  - ", subsequent_indent="    ")
    return lines


def write_assessment(result: Assessment, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
    """Write the folder of an assessment; see `Assessment.write`."""
    return write_with(result, folder, {}, figures=figures)


def write_with(
    result: Assessment, folder: str | os.PathLike[str], others: Mapping[str, str], *, figures: bool = True
) -> list[Path]:
    """Write text, tables (Parquet and CSV), assessment.json, figures (PNG and SVG), the page and other documents to a
    folder; return the files. On an error nothing is changed.
    """
    out = as_path(folder, "assessment", InvalidOption)
    check_out(out, "assessment")
    documents = {"assessment.txt": result.text + "\n", f"{result.document}.json": result.to_json() + "\n"}
    drawn: dict[str, Figure] = {}
    if figures:
        from seismass.show.assessment.page import drawn_figures, page_with

        result = animated(result)
        if result.animation is not None:
            documents[ANIMATION] = json.dumps(result.animation) + "\n"
        drawn, drawings = drawn_figures(result)
        documents |= {f"{name}.svg": drawing for name, drawing in drawings.items()}
        documents[PAGE] = page_with(result, drawings)
    ours = {PAGE, ANIMATION} | {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")}
    ours |= {f"{name}.{kind}" for name in stored_tables("assessment") for kind in ("parquet", "csv")}
    files = result_files(tables=result.tables, documents=documents | dict(others), figures=drawn, kinds=("png",))
    return write_folder(out, files, earlier=ours.__contains__, owner="assessment")
