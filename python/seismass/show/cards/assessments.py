"""An assessment as a notebook shows it: the answer, both analyses, and the drift of each storey."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from seismass.assessment.models import REAL
from seismass.media.card import card, line, rows
from seismass.media.text_table import column_texts

if TYPE_CHECKING:
    from seismass.assessment.result import Assessment

MOST_ROWS: Final = 12
"""Most storeys that are listed, from the ground."""


def assessment_html(result: Assessment) -> str:
    """Return a card of an assessment."""
    answer = result.answer
    pair = [line(f"{one.number}  {words}") for one, words in zip(answer.analyses, answer.pair, strict=True)]
    facts = [("tables", ", ".join(result.tables)), ("figures", ", ".join(result.figure_names))]
    said = [answer.why and f"why: {answer.why}", answer.motions and f"motions: {answer.motions}"]
    return card(
        result.building.name or "Assessment",
        answer.headline,
        *pair,
        _drifts(result),
        facts=facts,
        notes=[*(sentence for sentence in said if sentence), *result.remarks],
    )


def _drifts(result: Assessment) -> str:
    """Mean peak drifts of each storey: of both analyses, of goods that slide, and the one that governs."""
    table = result.governing.head(MOST_ROWS)
    scale, unit = (1e3, " mm") if result.building.heights is None else (1e2, " %")
    names = {"advised": "analysis 1", "bare": "analysis 2", REAL: "goods slide", "governing": "governs"}
    shown = {name: title for name, title in names.items() if table[name].is_not_null().any()}
    # One quantity in all columns: the same decimals in all of them.
    texts = column_texts([value for name in shown for value in table[name].to_list()], scale=scale, unit=unit)
    drifts = [texts[place * table.height : (place + 1) * table.height] for place in range(len(shown))]
    labels = [f"storey {number} {name}".rstrip() for number, name in table.select("storey", "name").iter_rows()]
    left_out = result.building.storeys - table.height
    more = line(f"and {left_out} storeys above") if left_out > 0 else ""
    return rows(("mean peak drift", *shown.values()), list(zip(labels, *drifts, strict=True))) + more
