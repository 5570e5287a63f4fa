"""What the summary of a study says about the paper's claim, computed from its tables and from nothing else.

The claim (section 5): the standard underestimates drift, by more the larger alpha and R are, and by up to 100 %.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl

ROUNDING: Final = 1e-7
"""Underestimations (%) that differ by less are the same: drifts agree to 1e-9 of themselves."""

_STOREY = ["occupancy", "storeys", "period", "storey"]
_PLACE: Final = [
    "underestimation_percent",
    "storeys",
    "period",
    "R",
    "alpha",
    "storey",
    "median_underestimation_percent",
    "p16_underestimation_percent",
    "p84_underestimation_percent",
    "leave_one_out_percent",
    "leave_one_out_record",
]


def findings(summary: pl.DataFrame, fractions: pl.DataFrame, code: str = "code") -> list[dict[str, Any]]:
    """Return a dict per occupancy and friction in the order of the summary: counts and the extremes of underestimation
    (%), how it grows with alpha and R, first storeys by R and alpha. Storeys without a mean are left out.
    """
    entries = []
    keys = ["building", "eta", "estimate", "conservative", "effective"]
    joined = summary.join(fractions.select(keys), on="building", how="left", maintain_order="left").with_columns(
        mass_percent=100.0 * (pl.col("ratio_mass") - 1.0), sliding_percent=100.0 * (pl.col("ratio_sliding") - 1.0)
    )
    for (occupancy, mu), rows in joined.group_by("occupancy", "mu", maintain_order=True):
        has_result = pl.col("underestimation_percent").is_finite()
        known = rows.filter(has_result)
        below = known.filter(pl.col("underestimation_percent") < -ROUNDING)
        ranked = known.sort("underestimation_percent", descending=True)
        place = [*_PLACE, "mass_percent", "sliding_percent"]
        first = rows.filter(pl.col("storey") == 1)
        compared = ("underestimation_percent", "mass_percent", "sliding_percent", *keys[1:])
        means = first.group_by("R", "alpha").agg(_mean_of_all(name) for name in compared).sort("R", "alpha")
        entries.append(
            {
                "occupancy": occupancy,
                "mu": mu,
                "code": code,
                "lambda_design": rows["lambda_design"][0],
                "lambda_analysis": rows["lambda_analysis"][0],
                "storeys_compared": known.height,
                "storeys_without_result": rows.height - known.height,
                "collapses": {model: int(first[f"collapses_{model}"].sum()) for model in ("real", "code", "attached")},
                "code_gives_more": below.height,
                "code_gives_more_top": below.filter(pl.col("storey") == pl.col("storeys")).height,
                "largest": _finite(ranked.select(place).row(0, named=True)) if known.height else None,
                "smallest": _finite(ranked.select(place).row(-1, named=True)) if known.height else None,
                "growth": {
                    "alpha": _growth(rows, "alpha", "R"),
                    "R": _growth(rows, "R", "alpha"),
                    "alpha_first_storey": _growth(first, "alpha", "R"),
                    "R_first_storey": _growth(first, "R", "alpha"),
                },
                "first_storey": [_finite(row) for row in means.to_dicts()],
            }
        )
    return entries


def _finite(row: dict[str, Any]) -> dict[str, Any]:
    """The row with null for what is not finite, which JSON does not have."""
    return {name: None if isinstance(value, float) and not np.isfinite(value) else value for name, value in row.items()}


def _mean_of_all(name: str) -> pl.Expr:
    """Mean over the buildings; null where one of them has no number, so that no mean is of fewer buildings."""
    value = pl.col(name)
    return pl.when(value.null_count() == 0).then(value.mean()).alias(name)


def _growth(rows: pl.DataFrame, varied: str, fixed: str) -> dict[str, int]:
    # Rows without a result stay in their places: rows on both sides of one are not a single step apart.
    value = pl.col("underestimation_percent")
    known = pl.when(value.is_finite()).then(value)
    steps = rows.sort(varied).with_columns(known.diff().over([*_STOREY, fixed]).alias("step"))
    return {"pairs": steps["step"].count(), "grows": int((steps["step"] > ROUNDING).sum())}
