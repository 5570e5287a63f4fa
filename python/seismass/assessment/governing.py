"""What governs each storey: the larger drift of both analyses, beside the goods that slide at every friction."""

from __future__ import annotations

from typing import Any, Final

import polars as pl

from seismass.assessment.models import ADVISED, BARE, REAL, REAL_HIGH, REAL_LOW, REALS
from seismass.assessment.own_building import OwnBuilding

ANALYSES: Final = {ADVISED: "analysis 1", BARE: "analysis 2"}
"""The pair of analyses, by their models: with the share attached, and without goods."""
DIGITS: Final = 2
"""Decimals of a drift (%, or mm) that are printed; drifts with equal ones are one, as of goods that hardly slide."""


def friction_words(building: OwnBuilding) -> dict[str, str]:
    """Return the friction of each model with sliding goods in words, "mu as stated" first."""
    low, high = building.mu_factors
    return {REAL: "mu as stated", REAL_HIGH: f"mu x {high:g}", REAL_LOW: f"mu x {low:g}"}


def governing_table(building: OwnBuilding, storeys: pl.DataFrame) -> pl.DataFrame:
    """Return one row per storey: mean peak drifts of both analyses and of the goods that slide (null where a run
    collapses), which governs (null where a mean is missing), its limit and the ratio to it.
    """
    words = friction_words(building)
    known = storeys["model"].unique(maintain_order=True).to_list()
    columns = [name for name in (ADVISED, BARE, REAL, REAL_HIGH, REAL_LOW) if name in known]
    rows: list[dict[str, Any]] = []
    for storey in range(1, building.storeys + 1):
        of = storeys.filter(pl.col("storey") == storey)
        means = dict(of.select("model", "mean").iter_rows())
        drifts = {name: means[name] for name in columns}
        first = of.row(0, named=True)
        row = {"storey": storey, "name": first["name"], "unit": first["unit"], "limit": first["limit"], **drifts}
        sliding = {name: drifts[name] for name in REALS if drifts.get(name) is not None}
        if sliding:
            at = max(sliding, key=lambda name: sliding[name])
            row |= {"sliding": sliding[at], "sliding_at": words[at]}
        if all(value is not None for value in drifts.values()):
            row |= _governing(drifts, words, 1e2 if first["unit"] == "ratio" else 1e3)
            if first["limit"] is not None:
                row["governing_over_limit"] = row["governing"] / first["limit"]
        rows.append(row)
    texts = dict.fromkeys(("name", "unit", "governed_by", "sliding_at"), pl.String)
    numbers = (ADVISED, BARE, REAL, REAL_HIGH, REAL_LOW, "governing", "sliding", "limit", "governing_over_limit")
    return pl.DataFrame(rows, schema={"storey": pl.UInt32, **texts, **dict.fromkeys(numbers, pl.Float64)})


def _governing(drifts: dict[str, float], words: dict[str, str], scale: float) -> dict[str, Any]:
    """The largest drift and what has it; sliding goods only where they drift more than both analyses."""
    by = max((name for name in ANALYSES if name in drifts), key=lambda name: drifts[name])
    largest = max(drifts, key=lambda name: drifts[name])
    if round(scale * drifts[largest], DIGITS) == round(scale * drifts[by], DIGITS):
        return {"governing": drifts[by], "governed_by": ANALYSES[by]}
    return {"governing": drifts[largest], "governed_by": f"goods slide, {words[largest]}"}


def largest_change(storeys: pl.DataFrame, models: tuple[str, ...]) -> float | None:
    """Return the largest over the smallest mean drift of a storey among `models`, less one: the largest of any storey.
    None without means.
    """
    found = []
    for _, of in storeys.filter(pl.col("model").is_in(models)).group_by("storey"):
        means = of["mean"].to_list()
        if any(value is None for value in means) or not means or min(means) <= 0.0:
            return None
        found.append(max(means) / min(means) - 1.0)
    return max(found) if found else None
