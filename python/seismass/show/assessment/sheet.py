"""The first sheet of an assessment's page, for the file: head, drawing, answer, what was checked, motions, limits."""

from __future__ import annotations

from typing import Any, Final

import polars as pl
from markupsafe import Markup

from seismass.assessment.advice import slip_ends
from seismass.assessment.checks import CAPPED_DRIFT
from seismass.assessment.models import ADVISED, BARE, NAMES
from seismass.media.page import table_html, text_html, whole_html
from seismass.media.roles import apart, isolated, sentence_html
from seismass.model.codes import FROM_MEMORY, MARK, SECOND_HAND
from seismass.show.assessment.figures import answer_lines, box_class, building_drawing
from seismass.show.assessment.tables import AssessmentTables, quantity_text

HEAD: Final = {"name": "Project", "number": "Number", "author": "Author", "checker": "Checked by", "date": "Date"}
"""Entries of the head of the sheet; what the file does not say is left to be filled in by hand."""
NOT_COVERED: Final = (
    "Not covered: part floors, mezzanines, and roofs and canopies on columns of their own, which need models of their "
    "own; torsion, flexible floors and foundations; goods that rock, topple or strike each other."
)
ON_SHEET: Final = ("W", "T_1", "T", "I", "C_s", "V", "V_y/(C_s W)", "V_y/W")
"""Quantities of the design on the sheet, beside V_y of each storey."""
MOST_STOREYS: Final = 8
"""Storeys of the table of the sheet."""
MOST_MOTIONS: Final = 12
"""Motions that the sheet names; the others are in their table."""
CHECKS: Final = {CAPPED_DRIFT: "storey drift, capped mean", "stability coefficient": "stability coefficient P d/(V h)"}
"""Checks whose largest value stands on the sheet, with their words."""


def sheet_html(result: AssessmentTables) -> Markup:
    """Return the sheet: one side of A4 on paper."""
    return Markup(
        '<div class="sheet">{head}<div class="sheet-body"><figure class="building">{drawing}<figcaption>{caption}'
        '</figcaption></figure><div class="{kind}">{answer}</div></div><div class="sheet-tables">{tables}</div>'
        "{motions}</div>"
    ).format(
        head=_head(result.document["project"]),
        drawing=building_drawing(result),
        caption=_drawing_caption(result),
        kind=box_class(result),
        answer=text_html(*answer_lines(result)),
        tables=Markup("").join([_verdicts(result), *_storeys(result)]),
        motions=text_html(
            _design(result), _motions(result), Markup('<small class="limits">{}</small>').format(NOT_COVERED)
        ),
    )


def _head(project: dict[str, str]) -> Markup:
    rows = (
        Markup("<div><dt>{}</dt><dd>{}</dd></div>").format(words, isolated(project[key])) for key, words in HEAD.items()
    )
    return Markup('<dl class="head">{}</dl>').format(Markup("").join(rows))


def _drawing_caption(result: AssessmentTables) -> str:
    if not result.document["input"]["goods"]:
        return "The building; there are no goods."
    bolted = any(kind["attached"] for kind in result.document["input"]["goods"])
    racks = any(kind["rack"] is not None for kind in result.document["input"]["goods"])
    parts = {"b/h: they tip first": result.document.get("tipping"), "grey: bolted": bolted, "on racks": racks}
    return (
        "The building with its goods: what is present of the design live load, and friction, static/kinetic"
        f"{''.join(f'; {words}' for words, holds in parts.items() if holds)}{_support(result)}."
    )


def _support(result: AssessmentTables) -> str:
    data = result.document["input"]
    base = "; it stands on a sliding base" if data["base"] is not None else ""
    return base + ("; it moves in two directions" if data["other_direction"] is not None else "")


def _verdicts(result: AssessmentTables) -> Markup:
    """Largest value of each check with its limit and its margin."""
    rows: list[dict[str, Any]] = []
    runs = result.checks.filter(check="collapsed runs")
    motions = len(result.document["suite"]["motions"])
    worst = runs.sort("value", descending=True).row(0, named=True)
    rows.append(
        {
            "what": "collapsed runs",
            "value": f"{worst['value']:.0f} of {motions}",
            "limit": "0",
            "margin": "none" if worst["value"] else "\N{EN DASH}",
            "where": NAMES.get(worst["model"], worst["model"]) if worst["value"] else "all models",
        }
    )
    for check, words in CHECKS.items():
        rows_of_check = result.checks.filter(check=check)
        if not rows_of_check.height:
            continue
        known = rows_of_check.drop_nulls("value").sort("value", descending=True)
        scale, form, unit = (1e2, ".2f", " %") if check == CAPPED_DRIFT else (1.0, ".3f", "")
        row = known.row(0, named=True) if known.height else rows_of_check.row(0, named=True)
        limit = f"{scale * row['limit']:g}{unit}"
        if known.height < rows_of_check.height:
            rows.append({"what": words, "value": "no value", "limit": limit, "margin": "none", "where": "beside walls"})
            continue
        margin = 100.0 * (1.0 - row["value"] / row["limit"])
        rows.append(
            {
                "what": words,
                "value": f"{scale * row['value']:{form}}{unit}",
                "limit": limit,
                "margin": signed_percent(margin),
                "where": f"storey {row['storey']}, {_model_words(row['model'])}",
            }
        )
    slip = result.slip.drop_nulls("peak_p84").sort("peak_p84", descending=True)
    if slip.height and slip["peak_max"].max():
        row = slip.row(0, named=True)
        rows.append(
            {
                "what": "slip each way, 84 % of the motions",
                "value": f"{1e3 * row['peak_p84']:.0f}{slip_ends(row)} mm",
                "limit": "\N{EN DASH}",
                "margin": "\N{EN DASH}",
                "where": f"floor {row['floor']}, {NAMES[row['model']]}",
            }
        )
    return table_html(
        pl.DataFrame(rows),
        "Largest value of both analyses and of goods that slide, at all frictions, with its limit and its margin.",
        headers={"what": "check"},
        formats={"margin": _margin},
    )


def signed_percent(value: float) -> str:
    """Return a percentage with a true minus."""
    return f"{value:.0f} %".replace("-", "\N{MINUS SIGN}")


def _margin(text: str) -> Markup:
    bad = text == "none" or text.startswith("\N{MINUS SIGN}")
    good = text[:1].isdigit()
    return Markup('<span class="{}">{}</span>').format("warn" if bad else "good" if good else "", text)


def _model_words(model: str) -> str:
    return {ADVISED: "analysis 1", BARE: "analysis 2"}.get(model, NAMES[model])


def _storeys(result: AssessmentTables) -> list[Markup]:
    """What governs each storey, with its margin; of a tall building those with the least."""
    table = result.governing
    if result.answer is None or table["governing"].null_count():
        return []
    ratio = result.drift_limit is not None
    scale, unit = (1e2, "%") if ratio else (1e3, "mm")
    caption = "What governs each storey."
    if table.height > MOST_STOREYS:
        shown = table.sort("governing", descending=True).head(MOST_STOREYS).sort("storey")
        caption = f"What governs the {MOST_STOREYS} storeys that drift most; the others are in the table of drifts."
    else:
        shown = table
    shown = shown.sort("storey", descending=True)
    rows = []
    for row in shown.iter_rows(named=True):
        cells: dict[str, Any] = {"storey": f"{row['storey']} {apart(row['name'] or '')}".rstrip()}
        for name, words in ((ADVISED, "analysis 1"), (BARE, "analysis 2"), ("sliding", "goods slide, worst mu")):
            value = row.get(name)
            cells[f"{words} ({unit})"] = None if value is None else f"{scale * value:.2f}"
        cells["governs"] = row["governed_by"]
        if ratio:
            cells["margin"] = signed_percent(100.0 * (1.0 - row["governing_over_limit"]))
        rows.append(cells)
    formats = {"margin": _margin} if ratio else {}
    return [
        table_html(pl.DataFrame(rows), f"{caption} Capped mean drift.", formats={**formats, "governs": _model_name})
    ]


def _model_name(text: str) -> Markup:
    return sentence_html(text)


def _design(result: AssessmentTables) -> Markup:
    """W, T, C_s, V and V_y with their clauses."""
    inputs = result.document["input"]
    rows, sentences = inputs["code_design"], []
    for direction in dict.fromkeys(row["direction"] for row in rows):
        numbers = [row for row in rows if row["direction"] == direction]
        strengths = [row for row in numbers if row["quantity"] == "V_y"]
        shown = [row for row in numbers if row["quantity"] in ON_SHEET]
        words = [f"{row['quantity']} = {quantity_text(row['value'], row['unit'])}{_clause(row)}" for row in shown]
        most = ", ".join(quantity_text(row["value"], "N").removesuffix(" kN") for row in strengths)
        words.append(f"V_y = {most} kN from storey 1 up{_clause(strengths[0])}")
        sentences.append(f"{direction}: " * bool(direction) + ", ".join(words))
    title = "Strengths as stated" if inputs["design"] is None else f"Design by {inputs['code_of_design']}"
    return Markup("<strong>{}.</strong> {}.").format(title, "; ".join(sentences))


def _clause(row: dict[str, Any]) -> str:
    mark = MARK if row["status"] in (SECOND_HAND, FROM_MEMORY) else ""
    return f" ({row['clause']}{mark})" if row["clause"] else ""


def _motions(result: AssessmentTables) -> Markup:
    """Which motions, with their factors where they are few."""
    suite = result.document["suite"]
    names, factors = suite["motions"], result.document["factors"]
    shown = [isolated(name) for name in names[:MOST_MOTIONS]]
    if factors is not None:
        times = Markup("{} \N{MULTIPLICATION SIGN} {:.2f}")
        shown = [times.format(name, factor) for name, factor in zip(shown, factors, strict=False)]
    more = f" and {len(names) - len(shown)} more, in the table of motions" if len(names) > len(shown) else ""
    return Markup("<strong>Motions.</strong> {}: {}{}.").format(isolated(suite["name"]), whole_html(shown), more)
