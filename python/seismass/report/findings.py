"""What the summary of a study says about the paper's claim, computed from the table and from nothing else.

The claim (section 5): the standard underestimates drift, by more the larger alpha and R are, and by up to 100 %.
"""

from __future__ import annotations

from typing import Any, Final

import polars as pl

ROUNDING: Final = 1e-7
"""Underestimations (%) that differ by less are the same: drifts agree to 1e-9 of themselves."""

_STOREY = ["occupancy", "storeys", "period", "storey"]


def findings(summary: pl.DataFrame) -> list[dict[str, Any]]:
    """Return one entry per occupancy, in the order of the summary.

    Parameters
    ----------
    summary : polars.DataFrame
        `StudyResult.summary`; storeys of buildings with a failed run are left out and counted.

    Returns
    -------
    list of dict
        occupancy, lambda; `storeys_compared` and `storeys_without_result`; `asce_gives_more`, the number of storeys
        where the ASCE model drifts more, and `asce_gives_more_top`, how many of them are top storeys; `largest` and
        `smallest` underestimation (%), each with its storeys, R, alpha and storey; `growth` with alpha and with R: of
        all pairs of storeys with results that differ by one step of it alone, how many there are and in how many
        the underestimation grows, for all storeys and for first storeys; `first_storey`, the mean over the buildings of
        the first storey's underestimation (%) for each R and alpha.
    """
    entries = []
    for (occupancy,), rows in summary.group_by("occupancy", maintain_order=True):
        has_result = pl.col("underestimation_percent").is_finite()
        known = rows.filter(has_result)
        below = known.filter(pl.col("underestimation_percent") < -ROUNDING)
        ranked = known.sort("underestimation_percent", descending=True)
        place = ["underestimation_percent", "storeys", "R", "alpha", "storey"]
        first = rows.filter(pl.col("storey") == 1)
        entries.append(
            {
                "occupancy": occupancy,
                "lambda": rows["lambda"][0],
                "storeys_compared": known.height,
                "storeys_without_result": rows.height - known.height,
                "asce_gives_more": below.height,
                "asce_gives_more_top": below.filter(pl.col("storey") == pl.col("storeys")).height,
                "largest": ranked.select(place).row(0, named=True) if known.height else None,
                "smallest": ranked.select(place).row(-1, named=True) if known.height else None,
                "growth": {
                    "alpha": _growth(rows, "alpha", "R"),
                    "R": _growth(rows, "R", "alpha"),
                    "alpha_first_storey": _growth(first, "alpha", "R"),
                    "R_first_storey": _growth(first, "R", "alpha"),
                },
                "first_storey": first.filter(has_result)
                .group_by("R", "alpha")
                .agg(pl.col("underestimation_percent").mean())
                .sort("R", "alpha")
                .to_dicts(),
            }
        )
    return entries


def _growth(rows: pl.DataFrame, varied: str, fixed: str) -> dict[str, int]:
    # Rows without a result stay in their places: what lies on both sides of one is no single step.
    value = pl.col("underestimation_percent")
    known = pl.when(value.is_finite()).then(value)
    steps = rows.sort(varied).with_columns(known.diff().over([*_STOREY, fixed]).alias("step"))
    return {"pairs": steps["step"].count(), "grows": int((steps["step"] > ROUNDING).sum())}


def findings_text(entries: list[dict[str, Any]]) -> str:
    """Return the findings as a few lines to read."""
    lines = []
    for entry in entries:
        lines.append(f"{entry['occupancy']} (ASCE model with {100.0 * entry['lambda']:g} % of the live load)")
        if entry["largest"] is None:
            lines.append("  no storey has a result")
            continue
        count, more, top = (entry[key] for key in ("storeys_compared", "asce_gives_more", "asce_gives_more_top"))
        growth = entry["growth"]
        lines += [
            f"  largest underestimation   {_place(entry['largest'])}",
            f"  smallest                  {_place(entry['smallest'])}",
            f"  ASCE model gives more     in {more} of {count} storeys, {top} of them top storeys",
            f"  grows with alpha          {_growth_text(growth, 'alpha')}",
            f"  grows with R              {_growth_text(growth, 'R')}",
            *_first_storey_table(entry["first_storey"]),
        ]
        if entry["storeys_without_result"]:
            lines.append(f"  without a result          {entry['storeys_without_result']} storeys: a run failed")
    return "\n".join(lines)


def _place(row: dict[str, Any]) -> str:
    return (
        f"{row['underestimation_percent']:+.0f} % (storey {row['storey']} of {row['storeys']}, R = {row['R']:g}, "
        f"alpha = {row['alpha']:g})"
    )


def _growth_text(growth: dict[str, dict[str, int]], varied: str) -> str:
    every, first = growth[varied], growth[f"{varied}_first_storey"]
    return f"in {every['grows']} of {every['pairs']} steps, first storeys {first['grows']} of {first['pairs']}"


def _first_storey_table(rows: list[dict[str, Any]]) -> list[str]:
    alphas = sorted({row["alpha"] for row in rows})
    value = {(row["R"], row["alpha"]): row["underestimation_percent"] for row in rows}
    lines = ["  first storeys, mean       " + "".join(f"{f'alpha {alpha:g}':>11}" for alpha in alphas)]
    for factor in sorted({row["R"] for row in rows}):
        cells = [value.get((factor, alpha)) for alpha in alphas]
        texts = ["-" if cell is None else f"{cell:+.0f} %" for cell in cells]
        lines.append(f"    {f'R = {factor:g}':24}" + "".join(f"{text:>11}" for text in texts))
    return lines
