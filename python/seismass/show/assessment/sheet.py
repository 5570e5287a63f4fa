"""The first sheet of an assessment's page: head, input, result, checks, method, check by hand, references."""

from __future__ import annotations

import math
from typing import Any, Final

import polars as pl
from markupsafe import Markup

from seismass.assessment.advice import SCALING, slip_ends
from seismass.assessment.answer import deciding
from seismass.assessment.checks import CAPPED_DRIFT, ONE_ANALYSIS, friction_words
from seismass.assessment.models import NAMES, SLIDING_ALL
from seismass.assessment.result import Assessment
from seismass.assessment.structure import slip_of_base
from seismass.base.statistics import quantile
from seismass.effective_mass.rule import RULE_UNKNOWN
from seismass.media.page import described_html, facts_html, table_html, text_html
from seismass.media.roles import apart, isolated, sentence_html
from seismass.model.codes import FROM_MEMORY, MARK, SECOND_HAND
from seismass.show.assessment.drawing import ROOM, building_drawing
from seismass.show.assessment.page_input import SPRINGS, facts
from seismass.show.assessment.tables import most_slip, quantity_text, short_words

HEAD: Final = {
    "name": "Project",
    "number": "Number",
    "client": "Client",
    "revision": "Revision",
    "date": "Date",
    "author": "Made by",
    "checker": "Checked by",
}
"""Entries of the head of the sheet; what the file does not say is left to be filled in by hand."""
TITLE: Final = "Live load that acts as seismic mass"
"""Title of the calculation."""
NOT_COVERED: Final = (
    "Not covered: part floors, mezzanines, and roofs and canopies on columns of their own, which need models of their "
    "own; torsion, flexible floors and foundations; goods that rock, topple or strike each other."
)
ON_SHEET: Final = ("W", "T_1", "T", "I", "C_s", "V", "V_y/(C_s W)", "V_y/W")
"""Quantities of the design on the sheet, beside V_y of each storey."""
GIVEN: Final = (
    *("Weight without loose goods", "Weight of the goods present", "First period", "Stiffness", SPRINGS, "Damping"),
    *("P-Delta", "Site spectrum"),
)
"""Facts of the input on the sheet."""
MOST_STOREYS: Final = 8
"""Storeys of the table of the sheet."""
DIGEST: Final = 16
"""Digits of the digest of the file that stand on every sheet."""
CHECKS: Final = {CAPPED_DRIFT: "storey drift", "stability coefficient": "stability P d/(V h)"}
"""Checks whose largest value stands on the sheet, with their words."""


def running(result: Assessment) -> dict[str, str]:
    """Return what stands in the margins of every sheet, by their place."""
    project, version = result.content["project"], result.metadata["package_version"]
    head = (project["name"] or result.name, project["number"], TITLE)
    return {
        "top-left": ", ".join(part for part in head if part),
        "top-right": f"Revision {project['revision'] or '____'}",
        "bottom-left": f"seismass {version}; {_file(result)}",
    }


def _file(result: Assessment) -> str:
    """The file and its digest; that of the inputs where there is none."""
    data = result.input
    if not data["file_sha256"]:
        return f"inputs SHA-256 {result.metadata['inputs_sha256'][:DIGEST]}"
    return f"{data['file']}, SHA-256 {data['file_sha256'][:DIGEST]}"


def sheet_html(result: Assessment, figure: str = "") -> Markup:
    """Return the sheet: one side of A4 on paper; `figure` is that of drifts and slips."""
    return Markup(
        '<div class="sheet">{head}<div class="sheet-body"><div><figure class="building">{drawing}<figcaption>{caption}'
        '</figcaption></figure>{quantities}{storeys}</div><div><div class="{kind}">{answer}</div>{figure}{checks}</div>'
        "</div>{notes}{signatures}</div>"
    ).format(
        head=_head(result),
        drawing=building_drawing(result),
        caption=_drawing_caption(result),
        quantities=facts_html({name: text for name, text in facts(result).items() if name in GIVEN})
        + text_html(_design(result)),
        kind=box_class(result),
        answer=text_html(*answer_lines(result)),
        figure=figure,
        storeys=Markup("").join(storeys_html(result, MOST_STOREYS) if result.answer.analyses else _collapses(result)),
        checks=_verdicts(result),
        notes=text_html(*_method(result), Markup('<small class="limits">{}</small>').format(NOT_COVERED)),
        signatures=_entries({f"{words}, date and signature": "" for words in ("Made", "Checked")}, " signatures"),
    )


def _head(result: Assessment) -> Markup:
    stated = {words: result.content["project"][key] for key, words in HEAD.items()}
    return _entries({**stated, "Calculation": TITLE, "File": _file(result)})


def _entries(rows: dict[str, str], kind: str = "") -> Markup:
    entry = Markup("<div><dt>{}</dt><dd>{}</dd></div>")
    cells = Markup("").join(entry.format(words, isolated(text)) for words, text in rows.items())
    return Markup('<dl class="head{}">{}</dl>').format(kind, cells)


def _drawing_caption(result: Assessment) -> str:
    data = result.input
    heights = {row["height"] for row in data["storeys"]} - {None}
    high = f"; storeys {result.units.text('height', heights.pop(), '.3g')} high" if len(heights) == 1 else ""
    springs = "; k and V_y of the storey below" * (len(data["storeys"]) <= ROOM)
    if not data["goods"]:
        return f"The building; there are no goods{springs}{high}."
    stays = any(kind["attached"] for kind in data["goods"]) or result.tipping.height
    grey = "; grey: mass of the floor, bolted or staying" if stays else ""
    return f"W of the floor, goods present of the design live load, friction (static/kinetic){springs}{high}{grey}."


def _design(result: Assessment) -> Markup:
    """W, T, C_s, V and V_y with their clauses."""
    inputs = result.input
    rows, sentences = inputs["code_design"], []
    for direction in dict.fromkeys(row["direction"] for row in rows):
        numbers = [row for row in rows if row["direction"] == direction]
        strengths = [row for row in numbers if row["quantity"] == "V_y"]
        shown = [row for row in numbers if row["quantity"] in ON_SHEET]
        texts = [quantity_text(row["value"], row["unit"], result.units) for row in shown]
        words = [f"{row['quantity']} = {text}{_clause(row)}" for row, text in zip(shown, texts, strict=True)]
        most = ", ".join(result.units.number("force", row["value"]) for row in strengths)
        words.append(f"V_y = {most} {result.units.unit('force')} from storey 1 up{_clause(strengths[0])}")
        sentences.append(f"{direction}: " * bool(direction) + ", ".join(words))
    rule = inputs["design"]
    title = "Strengths as stated" if rule is None else f"Design by {inputs['code_of_design']}, R = {rule['R']:g}"
    return Markup("<strong>{}.</strong> {}.").format(title, "; ".join(sentences))


def _clause(row: dict[str, Any]) -> str:
    mark = MARK if row["status"] in (SECOND_HAND, FROM_MEMORY) else ""
    return f" ({row['clause']}{mark})" if row["clause"] else ""


def _verdicts(result: Assessment) -> Markup:
    """Largest value of each check with its limit, and its use in per cent of the limit."""
    units, rows, references = result.units, [], _cited(result)
    motions = len(result.suite["motions"])
    most = result.checks.filter(check="collapsed runs").sort("value", descending=True).row(0, named=True)
    where = _model_words(result, most["model"]) if most["value"] else "all models"
    rows.append(("collapsed runs", f"{most['value']:.0f} of {motions}", "0", None, where, ""))
    for check, words in CHECKS.items():
        worst, why = worst_of(result, check)
        if worst is None:
            continue
        scale, form, unit = (1e2, ".2f", " %") if check == CAPPED_DRIFT else (1.0, ".3f", "")
        limit, clause = f"{scale * worst['limit']:g}{unit}", references[check]
        if why:
            rows.append((words, "no value", limit, None, why, clause))
            continue
        where = f"storey {worst['storey']}, {_model_words(result, worst['model'])}"
        use = worst["value"] / worst["limit"]
        rows.append((words, f"{scale * worst['value']:{form}}{unit}", limit, use, where, clause))
    clear = result.clearances
    slips = [row for row in most_slip(result.slip).values() if row["peak_max"]]
    for row in sorted(slips, key=lambda one: one["peak_p84"], reverse=True)[:1]:
        value = f"{units.number('slip', row['peak_p84'])}{slip_ends(row, units)} {units.unit('slip')}"
        limit = f"clearance {units.text('slip', clear[row['floor']], '.3g')}" if row["floor"] in clear else ""
        where = f"floor {row['floor']}, {NAMES[row['model']]}"
        rows.append(("slip, 84 % of the motions", value, limit, None, where, ""))
    base = slip_of_base(result.runs)
    if base is not None:
        where = f"largest {units.text('slip', base['most'])}, {NAMES[base['model']]}"
        rows.append(("slip of the base, 84 %", units.text("slip", base["p84"]), "", None, where, ""))
    return described_html(
        "assessment: checks",
        pl.DataFrame(rows, schema=["check", "value", "limit", "use", "where", "source"], orient="row"),
        "Largest value of the analyses and of goods that slide, at all frictions.",
        formats={"use": use_html, "where": sentence_html},
    )


def worst_of(result: Assessment, check: str) -> tuple[dict[str, Any] | None, str]:
    """Return the model with the largest value of a check, and why some model has none; None without such a check."""
    rows = result.checks.filter(check=check)
    missing, known = rows.filter(pl.col("value").is_null()), rows.drop_nulls("value").sort("value", descending=True)
    if missing.height:
        return missing.row(0, named=True), str(missing["reason"][0])
    return (known.row(0, named=True) if known.height else None), ""


def _references(result: Assessment) -> dict[str, str]:
    """Clauses by what they are of, in their order on the sheet."""
    code, rule = result.code, result.input["drift_limit_rule"]
    known = {"share": f"share of the code: {', '.join(part for part in (code.code, code.clause) if part)}"}
    if result.drift_limit is not None:
        limit = "limit as stated" if rule is None else f"{rule['code']}, {rule['clause']}"
        stable = str(result.checks.filter(check="stability coefficient")["source"][0]).partition(" (")[0]
        known |= dict(zip(CHECKS, (f"drift: {limit}", f"stability: {stable}"), strict=True))
    return known


def _cited(result: Assessment) -> dict[str, str]:
    """The references as their numbers are cited: "[1]"."""
    return {name: f"[{number}]" for number, name in enumerate(_references(result), start=1)}


def use_html(use: float) -> Markup:
    """Return a use of a limit in its colour."""
    return Markup('<span class="whole {}">{:.0f} %</span>').format("good" if use <= 1.0 else "warn", 100.0 * use)


def _governs(model: str) -> Markup:
    """What governs, in one line."""
    return Markup('<span class="whole">{}</span>').format(sentence_html(short_words(model) or model))


def _model_words(result: Assessment, model: str) -> str:
    return (ONE_ANALYSIS | result.called).get(model, NAMES[model])


def storeys_html(result: Assessment, most: int) -> list[Markup]:
    """Return what governs storeys and what they use of the limit, of a tall building those `most` that drift most."""
    table = result.governing
    scale, unit = result.units.drifts(ratio=result.drift_limit is not None)
    caption = "What governs each storey: capped mean drift"
    if table.height > most:
        table = table.sort("governing", descending=True).head(most).sort("storey")
        caption = f"The {most} storeys that drift most, the others behind: capped mean drift"
    table = table.sort("storey", descending=True)
    names = [f"{storey} {apart(name or '')}".rstrip() for storey, name in table.select("storey", "name").iter_rows()]
    return [
        described_html(
            "assessment: governing",
            table.select(pl.Series("storey", names), *result.called, "sliding", "governed_by", "governing_over_limit"),
            f"{caption}, {unit}.",
            units={"drift": ("", lambda drift: f"{scale * drift:.2f}")},
            headers=result.called,
            formats={"governed_by": _governs, "governing_over_limit": use_html},
        )
    ]


def _collapses(result: Assessment) -> list[Markup]:
    """Of each model that collapses the motions, the storey with the largest drift in them, and the median drift."""
    scale, unit = result.units.drifts(ratio=result.drift_limit is not None)
    column = "peak_drift" if result.drift_limit is None else "peak_drift_ratio"
    rows = []
    for (model,), runs in result.runs.group_by("model", maintain_order=True):
        fallen = runs.filter("collapsed").sort(column, descending=True)
        if not fallen.height:
            continue
        places = fallen.unique("motion", keep="first", maintain_order=True)["storey"]
        peak = pl.when(pl.col("collapsed").any()).then(math.inf).otherwise(pl.col(column).max())
        median = float(quantile(runs.group_by("motion").agg(peak.alias("peak"))["peak"].to_numpy(), 0.5))
        rows.append(
            {
                "model": NAMES.get(str(model), str(model)),
                "collapses under": f"{fallen['motion'].n_unique()} of {runs['motion'].n_unique()}",
                "motions": ", ".join(str(number) for number in sorted(set(fallen["motion"]))),
                "storey": ", ".join(str(storey) for storey in sorted(set(places))),
                f"median drift ({unit})": "collapse" if math.isinf(median) else f"{scale * median:.2f}",
            }
        )
    caption = "Which motions collapse, in which storey, and the median over the motions of the largest storey drift."
    return [table_html(pl.DataFrame(rows), caption)] if rows else []


def _method(result: Assessment) -> list[Markup]:
    """Method in four lines with formulas, the check by hand, and references."""
    data = result.input
    low, high = result.mu_factors
    cited = _cited(result)
    of_load = f"{result.code_share:.3g} of the design live load {cited['share']}"
    limits = "none, since heights are not known"
    if result.drift_limit is not None:
        drift, stable = (cited[check] for check in CHECKS)
        limits = f"d/h up to {result.drift_limit:g} {drift}, P d/(V h) up to {data['theta_limit']:g} {stable}"
    rules = [text for text in result.assumptions if text.startswith(SCALING)]
    scaled = rules[0].removeprefix(SCALING) if rules else "taken as they are."
    lines = [
        "1 Model: trilinear springs V of storeys; goods are blocks that stick up to mu_s m g and slide against mu_k m "
        f"g; runs go exactly from event to event. The model of the code has {of_load} attached.",
        f"2 Motions: {scaled}",
        "3 Share: lambda is the smallest share for which d of the model with lambda m attached is at least d with "
        f"goods that slide; d is the capped mean of the largest drift, at mu, {high:g} mu and {low:g} mu; the largest "
        "lambda counts.",
        f"4 Checks: {limits}.",
    ]
    made = [Markup("<strong>Method.</strong> {}").format(sentence_html(" ".join(lines)))]
    if result.effective:
        made.append(Markup("<strong>By hand.</strong> {}").format(sentence_html(_by_hand(result))))
    numbered = "; ".join(f"{cited[name]} {text}" for name, text in _references(result).items())
    return [*made, Markup("<strong>References.</strong> {}; strengths: clauses beside them.").format(numbered)]


def _by_hand(result: Assessment) -> str:
    """The rule by hand in numbers beside what the runs give, or why it is not applied."""
    unknown = [text for text in result.remarks if text.startswith(RULE_UNKNOWN)]
    if unknown:
        return f"Not applied: {'; '.join(unknown)}."
    decisive = deciding(result.effective)
    one, factors = result.effective[decisive], dict(zip(SLIDING_ALL, (1.0, *result.mu_factors), strict=True))
    runs = f" The runs give {one.value:.2f}." if result.answer.analyses else " The runs give no answer."
    by_hand = one.by_hand.words_in(result.units, factors[decisive])
    return f"At {friction_words(result.mu_factors)[decisive]} lambda = {by_hand}.{runs}"


def box_class(result: Assessment) -> str:
    """Return the class of the box: green only with an answer, without doubts, and with no check that fails."""
    failed = result.checks.filter(met=False).height
    return "answer" if result.answer.analyses and not failed and not result.answer.doubts else "answer bad"


def answer_lines(result: Assessment) -> list[Markup]:
    """Return the lines of the box."""
    answer, names = result.answer, result.storey_names
    lines = [Markup('<strong class="warn">{}</strong>').format(doubt) for doubt in answer.doubt_lines]
    lines.append(Markup("<strong>{}</strong>").format(sentence_html(answer.statement, names)))
    if answer.analyses:
        pair = zip(result.called.values(), answer.pair, strict=True)
        lines.append(sentence_html(_sentence(answer.opening)))
        lines += [
            Markup("<strong>{}</strong>").format(sentence_html(_sentence(f"{called}: {words}")))
            for called, words in pair
        ]
        present, *amounts = answer.goods
        parts = [f"Goods present: {present}.", *map(_sentence, amounts), f"Why: {answer.why}."]
        lines += [sentence_html(line, names) for line in parts]
    lines += [sentence_html(_sentence(answer.motions)), _checks_met(result)]
    return lines


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _checks_met(result: Assessment) -> Markup:
    """What drift and stability use of their limits, whether runs collapse, and what is not defined."""
    parts, good = [], True
    for check, words in CHECKS.items():
        worst, why = worst_of(result, check)
        if worst is None:
            continue
        if why:
            parts.append(f"{words} has no value: {why}")
            good = good and result.input["walls"]
            continue
        use = worst["value"] / worst["limit"]
        good = good and use <= 1.0
        parts.append(f"{words} uses {100.0 * use:.0f} % of its limit")
    fallen = int(result.checks.filter(check="collapsed runs")["value"].max() or 0)  # type: ignore[arg-type]
    motions = len(result.suite["motions"])
    parts.append(f"runs collapse under up to {fallen} of {motions} motions" if fallen else "no run collapses")
    above = result.storeys["motions_above_limit"].drop_nulls().to_numpy()
    if above.size and above.max():
        parts.append(f"under up to {above.max()} of {motions} a drift is above the limit")
    look = "good" if good and not fallen else "warn"
    return Markup('<span class="{}">{}</span>').format(look, _sentence("; ".join(parts)))
