"""The findings of a study as lines to read."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from seismass.media.roles import EFFECTIVE
from seismass.media.text_table import change_text, number_text, text_line


def findings_text(entries: list[dict[str, Any]]) -> str:
    """Return the findings as a few lines to read."""
    lines = []
    several = len({entry["mu"] for entry in entries}) > 1
    for entry in entries:
        design, analysis = (100.0 * entry[f"lambda_{use}"] for use in ("design", "analysis"))
        shares = f"{design:g} % of the live load"
        if design != analysis:
            shares += f" in the design, {analysis:g} % in the analysis"
        friction = f", mu = {entry['mu']:g}" if several else ""
        lines.append(f"{entry['occupancy']}{friction} ({entry['code']}: {shares})")
        if any(entry["collapses"].values()):
            counts = ", ".join(f"{model} {count}" for model, count in entry["collapses"].items())
            lines.append(f"  collapsed runs            {counts}")
        if entry["largest"] is None:
            lines.append("  no storey has a result")
            continue
        count, more, top = (entry[key] for key in ("storeys_compared", "code_gives_more", "code_gives_more_top"))
        growth = entry["growth"]
        lines += [
            f"  largest underestimation   {_place(entry['largest'])}",
            *_scatter(entry["largest"]),
            f"  smallest                  {_place(entry['smallest'])}",
            f"  code model gives more     in {more} of {count} storeys, {top} of them top storeys",
            f"  grows with alpha          {_growth_text(growth, 'alpha')}",
            f"  grows with R              {_growth_text(growth, 'R')}",
            *_first_storey_tables(entry["first_storey"]),
        ]
        if entry["storeys_without_result"]:
            lines.append(
                f"  without a mean            {entry['storeys_without_result']} storeys: a run collapsed or failed"
            )
    return "\n".join(lines)


def _place(row: dict[str, Any]) -> str:
    return (
        f"{change_text(row['underestimation_percent'])} (storey {row['storey']} of {row['storeys']}, R = {row['R']:g}, "
        f"alpha = {row['alpha']:g})"
    )


def _scatter(row: dict[str, Any]) -> list[str]:
    """What the largest is made of, and how it scatters."""
    median, low, high = (row[f"{name}_underestimation_percent"] for name in ("median", "p16", "p84"))
    lines = [
        f"    by mass, by sliding     {change_text(row['mass_percent'])} (all attached over code), "
        f"{change_text(row['sliding_percent'])} (goods slide over all attached)",
        f"    motion by motion        median {change_text(median)}, 16 to 84 %: {change_text(low)} to "
        f"{change_text(high)}",
    ]
    if row["leave_one_out_record"] is not None:
        lines.append(
            f"    without one motion      {change_text(row['leave_one_out_percent'])} ({row['leave_one_out_record']})"
        )
    return lines


def _growth_text(growth: dict[str, dict[str, int]], varied: str) -> str:
    every, first = growth[varied], growth[f"{varied}_first_storey"]
    return f"in {every['grows']} of {every['pairs']} steps, first storeys {first['grows']} of {first['pairs']}"


def _first_storey_tables(rows: list[dict[str, Any]]) -> list[str]:
    """Underestimation, what sliding does, and estimate of lambda side by side, a row for each R."""
    alphas = sorted({row["alpha"] for row in rows})
    at = {(row["R"], row["alpha"]): row for row in rows}
    effective = any(row["effective"] is not None for row in rows)
    shown: list[tuple[str, str, Callable[[float | None], str]]] = [
        ("goods slide / code", "underestimation_percent", change_text),
        ("goods slide / all", "sliding_percent", change_text),
        ("lambda, estimate", "estimate", number_text),
        *([(EFFECTIVE, "effective", number_text)] if effective else []),
    ]
    widths = (-20, *(max(7 * len(alphas), 19) + 2 for _ in shown))
    lines = [
        text_line(["first storeys, mean", *(title for title, *_ in shown)], widths),
        text_line(["  alpha", *("".join(f"{alpha:>7g}" for alpha in alphas) for _ in shown)], widths),
    ]
    for factor in sorted({row["R"] for row in rows}):
        cells = []
        for _, name, form in shown:
            values = [at.get((factor, alpha), {}).get(name) for alpha in alphas]
            cells.append("".join(f"{form(value):>7}" for value in values))
        lines.append(text_line([f"  R = {factor:g}", *cells], widths))
    return lines
