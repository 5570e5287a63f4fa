"""A map of effective fractions in lines: its cases, how rules do, and the scatter by eta."""

from __future__ import annotations

import polars as pl

from seismass.effective_mass.design_map import EffectiveMassMap
from seismass.effective_mass.estimate import RULE_IN_WORDS
from seismass.effective_mass.rules import CLOSED_FORMS


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
        "Largest drift of the model with the share of a rule, over that of the real building",
        f"{'rule':30}{'mean':>7}{'log scatter':>13}{'5 to 95 %':>16}{'worst':>7}{'unsafe':>9}",
    ]
    for row in rules.iter_rows(named=True):
        interval = f"{row['low']:.2f} to {row['high']:.2f}"
        lines.append(
            f"{row['rule']:30}{row['bias']:>7.3f}{row['log_scatter']:>13.3f}{interval:>16}{row['worst']:>7.2f}"
            f"{100 * row['unsafe']:>7.0f} %"
        )
    return [
        *lines,
        "mean: geometric; unsafe: share of cases in which the real building drifts more than 1.05 x the model",
        f"{where};",
        exponents,
    ]


def by_period_text(rules: pl.DataFrame) -> list[str]:
    """Return how the rules that depend on friction do in each class of period, as lines: mean, worst, unsafe."""
    classes = rules.select("period_from", "period_to").unique(maintain_order=True).rows()
    names = ["from 0" if not low else f"from {low:g}" for low, _ in classes]
    lines = [
        "By period of the bare building (s): mean, worst of model over real drift, unsafe cases",
        f"{'rule':30}" + "".join(f"{name:>18}" for name in names),
        f"{'cases':30}" + "".join(f"{rules.filter(period_from=low)['cases'][0]:>18}" for low, _ in classes),
    ]
    for rule in CLOSED_FORMS:
        cells = []
        for low, _ in classes:
            row = rules.filter(rule=rule, period_from=low).row(0, named=True)
            cells.append(f"{row['bias']:.3f} {row['worst']:.2f} {100 * row['unsafe']:3.0f} %")
        lines.append(f"{rule:30}" + "".join(f"{cell:>18}" for cell in cells))
    return lines


def bins_text(bins: pl.DataFrame) -> list[str]:
    """Return the scatter of the fraction in bins of eta as lines."""
    lines = ["Effective fraction by eta = mu_k/C1", f"{'eta':14}{'cases':>7}{'16 %':>8}{'median':>9}{'84 %':>8}"]
    for row in bins.iter_rows(named=True):
        end = "and more" if row["eta_to"] is None else f"to {row['eta_to']:g}"
        lines.append(
            f"{row['eta_from']:<4g} {end:9}{row['cases']:>7}{row['p16']:>8.2f}{row['median']:>9.2f}{row['p84']:>8.2f}"
        )
    return lines
