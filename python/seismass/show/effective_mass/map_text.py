"""A map of effective fractions in lines: its cases, how rules do, and the scatter by eta."""

from __future__ import annotations

import polars as pl

from seismass.effective_mass.design_map import EffectiveMassMap


def map_text(result: EffectiveMassMap) -> str:
    """Return remarks, the number of cases and runs, the table of rules and the scatter of the fraction by eta."""
    sliding = int(result.table["slides"].sum())
    lines = [f"remark   {remark}" for remark in result.metadata["remarks"]]
    lines.append(f"cases    {result.table.height}, goods slide in {sliding}; {result.metadata['runs']} runs")
    return "\n".join([*lines, "", *rules_text(result.rules()), "", *bins_text(result.by_eta())])


def rules_text(rules: pl.DataFrame) -> list[str]:
    """Return the table of rules as lines."""
    lines = [
        "Largest drift of the model with the share of a rule, over that of the real building",
        f"{'rule':30}{'mean':>7}{'log scatter':>13}{'5 to 95 %':>16}{'unsafe':>9}",
    ]
    for row in rules.iter_rows(named=True):
        interval = f"{row['low']:.2f} to {row['high']:.2f}"
        lines.append(
            f"{row['rule']:30}{row['bias']:>7.3f}{row['log_scatter']:>13.3f}{interval:>16}{100 * row['unsafe']:>7.0f} %"
        )
    return [
        *lines,
        "mean: geometric; unsafe: share of cases in which the real building drifts more than 1.05 x the model",
    ]


def bins_text(bins: pl.DataFrame) -> list[str]:
    """Return the scatter of the fraction in bins of eta as lines."""
    lines = ["Effective fraction by eta = mu_k/C1", f"{'eta':14}{'cases':>7}{'16 %':>8}{'median':>9}{'84 %':>8}"]
    for row in bins.iter_rows(named=True):
        end = "and more" if row["eta_to"] is None else f"to {row['eta_to']:g}"
        lines.append(
            f"{row['eta_from']:<4g} {end:9}{row['cases']:>7}{row['p16']:>8.2f}{row['median']:>9.2f}{row['p84']:>8.2f}"
        )
    return lines
