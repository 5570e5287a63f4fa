"""Tables of an assessment: drifts and stability by storey and model, slip by floor, collapses by model."""

from __future__ import annotations

from typing import Any, Final, Literal

import numpy as np
import polars as pl

from seismass.assessment.models import REALS, friction_factors
from seismass.assessment.own_building import OwnBuilding
from seismass.base.quantiles import QUANTILES
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.model.scene import Scene

MOST_COLLAPSES: Final = 0.1
"""Share of the motions that may bring a collapse where drifts still have a mean: one of eleven, and four of forty."""
MEDIAN_FACTOR: Final = 1.2
"""The mean is then this times the median, and at least the mean of the others: ASCE/SEI 7-16, 16.4 (from memory)."""


def drift_statistics(drifts: FloatArray) -> dict[str, float | None]:
    """Return `statistics_of` drifts, with a mean where no more than `MOST_COLLAPSES` of the runs collapsed (infinite
    drifts).
    """
    known, fallen = statistics_of(drifts), np.isinf(drifts)
    if fallen.any() and few_collapses(int(fallen.sum()), len(drifts)):
        known["mean"] = max(MEDIAN_FACTOR * float(np.median(drifts)), float(drifts[~fallen].mean()))
    return known


def few_collapses(collapsed: int, motions: int) -> bool:
    """Whether so few runs collapsed that drifts have a mean, and an assessment an answer."""
    return collapsed <= MOST_COLLAPSES * motions


def statistics_of(values: FloatArray) -> dict[str, float | None]:
    """Return mean, quantiles and largest value over the motions; what a collapsed run (an infinite value) decides is
    null.
    """
    collapsed = bool(np.isinf(values).any())
    # Between a number and infinity nothing can be interpolated; then a quantile is the next larger value.
    method: Literal["higher", "linear"] = "higher" if collapsed else "linear"
    found = {"mean": float(values.mean())}
    found |= {name: float(np.quantile(values, share, method=method)) for name, share in QUANTILES.items()}
    found["max"] = float(values.max())
    return {name: value if np.isfinite(value) else None for name, value in found.items()}


def gravity_of_storeys(building: OwnBuilding, scene: Scene) -> FloatArray:
    """Return the gravity load P above each storey (N), goods included, shape (storeys,)."""
    if building.heights is not None and scene.geometric_stiffness.any():
        return scene.geometric_stiffness * building.heights
    return np.cumsum((STANDARD_GRAVITY * (building.mass + building.frames + building.goods))[::-1])[::-1]


def storey_table(building: OwnBuilding, real: Scene, runs: pl.DataFrame) -> pl.DataFrame:
    """Return one row per model and storey: statistics of the peak drift (null where a collapsed run decides), its
    limit, and theta = P d/(V h) of mean peak drift and shear with its limit (null beside walls).
    """
    heights = building.heights
    gravity, rows = gravity_of_storeys(building, real), []
    column = "peak_drift" if heights is None else "peak_drift_ratio"
    for model in runs["model"].unique(maintain_order=True):
        for storey in range(1, building.storeys + 1):
            of = runs.filter((pl.col("model") == model) & (pl.col("storey") == storey))
            collapsed = of["collapsed"].to_numpy()
            drift = np.where(collapsed, np.inf, of[column].to_numpy())
            known = drift_statistics(drift)
            shears = of["peak_storey_shear"].to_numpy()[~collapsed]
            shear = float(shears.mean()) if known["mean"] is not None else None
            mean, load = known["mean"], float(gravity[storey - 1])
            alone = building.walls is None
            elastic = None
            if heights is not None and alone:
                elastic = load / float(building.stiffness[storey - 1] * heights[storey - 1])
            has_theta = heights is not None and alone and mean is not None and bool(shear)
            rows.append(
                {
                    "model": model,
                    "storey": storey,
                    "name": building.storey_names[storey - 1],
                    "unit": "m" if heights is None else "ratio",
                    **known,
                    "limit": None if heights is None else building.drift_limit,
                    "mean_over_limit": None if heights is None or mean is None else mean / building.drift_limit,
                    "motions_above_limit": None if heights is None else int((drift > building.drift_limit).sum()),
                    "collapsed": int(collapsed.sum()),
                    "mean_peak_shear": shear,
                    # With drift ratios the height is in the drift already.
                    "theta": load * mean / shear if has_theta and mean is not None and shear else None,
                    "theta_elastic": elastic,
                    "theta_limit": None if heights is None else building.theta_limit,
                }
            )
    numbers = ("mean", *QUANTILES, "max", "limit", "mean_over_limit", "mean_peak_shear", "theta", "theta_elastic")
    schema: dict[str, Any] = {"storey": pl.UInt32, "motions_above_limit": pl.UInt32, "collapsed": pl.UInt32}
    schema |= dict.fromkeys((*numbers, "theta_limit"), pl.Float64)
    return pl.DataFrame(rows, schema_overrides=schema)


def slip_table(building: OwnBuilding, slips: pl.DataFrame) -> pl.DataFrame:
    """Return one row per friction, kind of loose goods present and level of its rack: motions that slide, statistics of
    peak and residual slip (m), and collapsed runs, whose slips are those until the collapse.
    """
    words = dict(zip(REALS, ("as stated", "lower bound", "upper bound"), strict=True))
    rows = []
    for model, factor in friction_factors(building).items():
        for number, level in sorted(building.sliding):
            kind = building.loose[number]
            of = slips.filter((pl.col("model") == model) & (pl.col("kind") == number) & (pl.col("level") == level))
            if of.height == 0:
                continue
            peak, residual = of["peak_slip"].to_numpy(), np.abs(of["residual_slip"].to_numpy())
            left = statistics_of(residual)
            rows.append(
                {
                    "model": model,
                    "friction": words[model],
                    "floor": kind.floor,
                    "name": building.storey_names[kind.floor - 1],
                    "goods": ", ".join(part for part in (kind.name, f"level {level}" * (level > 0)) if part),
                    "contact": kind.contact,
                    "mu_s": factor * kind.mu_s,
                    "mu_k": factor * kind.mu_k,
                    "motions_that_slide": int((peak > 0.0).sum()),
                    **{f"peak_{name}": value for name, value in statistics_of(peak).items()},
                    **{f"residual_{name}": left[name] for name in ("mean", "median", "p84")},
                    "collapsed": int(of["collapsed"].sum()),
                }
            )
    numbers = [f"peak_{name}" for name in ("mean", *QUANTILES, "max")]
    numbers += [f"residual_{name}" for name in ("mean", "median", "p84")]
    texts = ("model", "friction", "name", "goods", "contact")
    schema: dict[str, Any] = {
        **dict.fromkeys(texts[:2], pl.String),
        "floor": pl.UInt32,
        **dict.fromkeys(texts[2:], pl.String),
        **dict.fromkeys(("mu_s", "mu_k"), pl.Float64),
        "motions_that_slide": pl.UInt32,
        **dict.fromkeys(numbers, pl.Float64),
        "collapsed": pl.UInt32,
    }
    return pl.DataFrame(rows, schema=schema)


def collapses_of(runs: pl.DataFrame) -> dict[str, int]:
    """Return the number of collapsed runs of each model."""
    first = runs.filter(pl.col("storey") == 1)
    counted = first.group_by("model", maintain_order=True).agg(pl.col("collapsed").sum())
    return dict(counted.iter_rows())
