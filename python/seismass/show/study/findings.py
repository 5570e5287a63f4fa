"""The findings of a study as lines to read."""

from __future__ import annotations

from typing import Any


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
        f"{_percent(row['underestimation_percent'])} (storey {row['storey']} of {row['storeys']}, R = {row['R']:g}, "
        f"alpha = {row['alpha']:g})"
    )


def _percent(value: float | None) -> str:
    return "-" if value is None else f"{round(value):+d} %".replace("+0 %", "0 %")


def _share(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"


def _scatter(row: dict[str, Any]) -> list[str]:
    """What the largest is made of, and how it scatters."""
    median, low, high = (row[f"{name}_underestimation_percent"] for name in ("median", "p16", "p84"))
    lines = [
        f"    by mass, by sliding     {_percent(row['mass_percent'])} (attached over code), "
        f"{_percent(row['sliding_percent'])} (real over attached)",
        f"    motion by motion        median {_percent(median)}, 16 to 84 %: {_percent(low)} to {_percent(high)}",
    ]
    if row["leave_one_out_record"] is not None:
        lines.append(
            f"    without one motion      {_percent(row['leave_one_out_percent'])} ({row['leave_one_out_record']})"
        )
    return lines


def _growth_text(growth: dict[str, dict[str, int]], varied: str) -> str:
    every, first = growth[varied], growth[f"{varied}_first_storey"]
    return f"in {every['grows']} of {every['pairs']} steps, first storeys {first['grows']} of {first['pairs']}"


def _first_storey_tables(rows: list[dict[str, Any]]) -> list[str]:
    """Underestimation, real over attached, and estimate of lambda side by side, a row for each R."""
    alphas = sorted({row["alpha"] for row in rows})
    at = {(row["R"], row["alpha"]): row for row in rows}
    effective = any(row["effective"] is not None for row in rows)
    shown = [
        ("real over code", "underestimation_percent", _percent),
        ("real over attached", "sliding_percent", _percent),
        ("lambda, estimate", "estimate", _share),
        *([("lambda_eff", "effective", _share)] if effective else []),
    ]
    width = max(7 * len(alphas), 19) + 2
    lines = [
        "  first storeys, mean " + "".join(f"{title:>{width}}" for title, *_ in shown),
        "    alpha             " + "".join(f"{''.join(f'{a:>7g}' for a in alphas):>{width}}" for _ in shown),
    ]
    for factor in sorted({row["R"] for row in rows}):
        cells = []
        for _, name, form in shown:
            values = [at.get((factor, alpha), {}).get(name) for alpha in alphas]
            texts = [f"{form(value):>7}" for value in values]
            cells.append(f"{''.join(texts):>{width}}")
        lines.append(f"    {f'R = {factor:g}':18}" + "".join(cells))
    return lines
