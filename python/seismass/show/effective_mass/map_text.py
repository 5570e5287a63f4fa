"""A map of effective fractions in lines: its cases, how rules do, and the scatter by eta."""

from __future__ import annotations

from typing import Final

import polars as pl

from seismass.effective_mass.design_map import EffectiveMassMap
from seismass.effective_mass.estimate import RULE_IN_WORDS
from seismass.effective_mass.rules import CLOSED_FORMS
from seismass.media.text_table import text_line

_RULES: Final = (-30, 7, 13, 16, 7, 9)
_BINS: Final = (-14, 7, 8, 9, 8)


def map_text(result: EffectiveMassMap) -> str:
    """Return remarks, the number of cases and runs, how rules do, over all and by period, and the scatter by eta."""
    sliding = int(result.table["slides"].sum())
    lines = [f"remark   {remark}" for remark in result.metadata["remarks"]]
    lines.append(f"cases    {result.table.height}, goods slide in {sliding}; {result.metadata['runs']} runs")
    return "\n".join(
        [
            *lines,
            "",
            *rules_text(result.rules()),
            "",
            *by_period_text(result.rules_by_period()),
            "",
            *bins_text(result.by_eta()),
        ]
    )


def rules_text(rules: pl.DataFrame) -> list[str]:
    """Return the table of rules as lines."""
    where, exponents = RULE_IN_WORDS.split("; ")
    lines = [
        "Largest drift of the model with the share of a rule, over that with sliding goods",
        text_line(("rule", "mean", "log scatter", "5 to 95 %", "worst", "unsafe"), _RULES, indent=0),
    ]
    for row in rules.iter_rows(named=True):
        interval = f"{row['low']:.2f} to {row['high']:.2f}"
        numbers = (f"{row['bias']:.3f}", f"{row['log_scatter']:.3f}", interval, f"{row['worst']:.2f}")
        lines.append(text_line((row["rule"], *numbers, f"{100 * row['unsafe']:.0f} %"), _RULES, indent=0))
    return [
        *lines,
        "mean: geometric; unsafe: share of cases in which sliding goods drift more than 1.05 x the model",
        f"{where};",
        exponents,
    ]


def by_period_text(rules: pl.DataFrame) -> list[str]:
    """Return how the rules that depend on friction do in each class of period, as lines: mean, worst, unsafe."""
    classes = rules.select("period_from", "period_to").unique(maintain_order=True).rows()
    widths = (-30, *(18 for _ in classes))
    names = ["from 0" if not low else f"from {low:g}" for low, _ in classes]
    lines = [
        "By period of the bare building (s): mean, worst of model over goods-slide drift, unsafe cases",
        text_line(("rule", *names), widths, indent=0),
        text_line(("cases", *(str(rules.filter(period_from=low)["cases"][0]) for low, _ in classes)), widths, indent=0),
    ]
    for rule in CLOSED_FORMS:
        cells = []
        for low, _ in classes:
            row = rules.filter(rule=rule, period_from=low).row(0, named=True)
            cells.append(f"{row['bias']:.3f} {row['worst']:.2f} {100 * row['unsafe']:3.0f} %")
        lines.append(text_line((rule, *cells), widths, indent=0))
    return lines


def bins_text(bins: pl.DataFrame) -> list[str]:
    """Return the scatter of the fraction in bins of eta as lines."""
    head = text_line(("eta", "cases", "16 %", "median", "84 %"), _BINS, indent=0)
    lines = ["Effective fraction by eta = mu_k/C1", head]
    for row in bins.iter_rows(named=True):
        end = "and more" if row["eta_to"] is None else f"to {row['eta_to']:g}"
        numbers = (f"{row[name]:.2f}" for name in ("p16", "median", "p84"))
        lines.append(text_line((f"{row['eta_from']:<4g} {end}", str(row["cases"]), *numbers), _BINS, indent=0))
    return lines
