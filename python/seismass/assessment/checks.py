"""What an assessment checks, with the clause of each limit, and the input as it was understood."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any, Final, Literal

import numpy as np
import polars as pl

from seismass.assessment.building import DEFAULT_DRIFT_LIMIT, DEFAULT_THETA_LIMIT, OwnBuilding
from seismass.assessment.models import ADVISED, BARE, SLIDING, SLIDING_ALL, SLIDING_HIGH, SLIDING_LOW, friction_factors
from seismass.base.statistics import QUANTILES
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.design import THETA_THRESHOLD, drift_limit
from seismass.model.codes import NOT_CHECKED, VERIFIED
from seismass.model.scene import Scene
from seismass.motions.spectra import TargetSpectrum


def checks_table(building: OwnBuilding, storeys: pl.DataFrame, collapses: dict[str, int]) -> pl.DataFrame:
    """Return one row per check and model: the storey with the largest value, value, limit, whether it is met (null
    where collapses leave no value), and the clause of the limit. `collapses` counts collapsed runs by model.
    """
    models = [model for model in (*SLIDING_ALL, ADVISED, BARE) if model in collapses]
    rows: list[dict[str, Any]] = [
        {"check": "collapsed runs", "model": model, "value": float(collapses[model]), "limit": 0.0, "source": ""}
        for model in models
    ]
    if building.heights is not None:
        limits = {
            "mean drift ratio": ("mean", building.drift_limit, drift_source(building)),
            "stability coefficient": ("theta", building.theta_limit, _theta_source(building)),
        }
        for check, (column, limit, source) in limits.items():
            rows += [_largest(storeys, check, model, column, limit, source) for model in models]
        elastic = _largest(storeys, "elastic stability coefficient", models[0], "theta_elastic", THETA_THRESHOLD, "")
        elastic["source"] = "ASCE/SEI 7-10, 12.8.7 (verified): above it P-Delta must be considered"
        if building.gravity_load is not None:
            elastic["source"] += ", as it is here"
            elastic["met"] = True
        rows.append(elastic)
    return pl.DataFrame(
        [_judged(row) for row in rows],
        schema={
            "check": pl.String,
            "model": pl.String,
            "storey": pl.UInt32,
            "value": pl.Float64,
            "limit": pl.Float64,
            "met": pl.Boolean,
            "source": pl.String,
        },
    )


def _largest(storeys: pl.DataFrame, check: str, model: str, column: str, limit: float, source: str) -> dict[str, Any]:
    rows = storeys.filter(model=model)
    row: dict[str, Any] = {"check": check, "model": model, "limit": limit, "source": source}
    if rows[column].null_count():
        return {**row, "storey": None, "value": None}
    place = int(np.argmax(rows[column].to_numpy()))
    return {**row, "storey": int(rows["storey"][place]), "value": float(rows[column][place])}


def _judged(row: dict[str, Any]) -> dict[str, Any]:
    value = row["value"]
    return {"storey": None, "met": None if value is None else value <= row["limit"], **row}


def drift_source(building: OwnBuilding) -> str:
    """Return where the limit of the drift ratio is from, what it limits there, and how it was checked."""
    row = building.drift_limit_rule
    if row is None:
        if building.drift_limit != DEFAULT_DRIFT_LIMIT:
            return "as stated"
        row, categories = drift_limit("asce7-10"), "risk category I or II"
    else:
        categories = f"{row.structure}, risk category or importance class {row.risk_category}"
    checked = row.status if row.status == VERIFIED else f"{row.status}; {NOT_CHECKED}"
    note = f"; {row.note}" if row.note and building.drift_limit_rule is not None else ""
    return f"{row.code}, {row.clause}, {categories} ({checked}); it limits {row.of}, here nonlinear drift{note}"


def _theta_source(building: OwnBuilding) -> str:
    if building.theta_limit != DEFAULT_THETA_LIMIT:
        return "as stated"
    return "ASCE/SEI 7-10, equation 12.8-17 (verified): 0.5/(beta C_d), at most 0.25"


def _in_y(building: OwnBuilding, target: TargetSpectrum | None) -> dict[str, Any]:
    """What differs in the other direction: periods, design, and stiffness and strength of each storey."""
    strength = building.structure(target).yield_shear
    rule = building.design
    return {
        "period_bare": building.period(),
        "period_attached": building.period(building.goods_mass),
        "R": None if rule is None else rule.R,
        "damping": building.damping,
        "stiffness": building.stiffness.tolist(),
        "yield_shear": [float(value) if np.isfinite(value) else None for value in strength],
    }


def input_document(building: OwnBuilding, target: TargetSpectrum | None) -> dict[str, Any]:
    """Return the input as it was understood, in SI units: values of the building, and a list of its storeys."""
    structure = building.structure(target)
    strength = np.where(np.isfinite(structure.yield_shear), structure.yield_shear, np.nan)
    heights = [None] * building.storeys if building.heights is None else building.heights.tolist()
    columns: dict[str, list[Any]] = {
        "storey": list(range(1, building.storeys + 1)),
        "name": list(building.storey_names),
        "height": heights,
        "mass": building.mass.tolist(),
        "stiffness": building.stiffness.tolist(),
        "yield_shear": [None if np.isnan(value) else float(value) for value in strength],
        "overstrength": building.overstrength.tolist(),
        "second_slope": building.second_slope.tolist(),
        "third_slope": building.third_slope.tolist(),
        "area": [None if np.isnan(area) else float(area) for area in building.area],
        "live_load": building.live_load.tolist(),
        "bolted": building.bolted.tolist(),
        "goods": building.goods_mass.tolist(),
        "use": [one.use or building.code.use for one in building.floor_codes],
        "code_fraction": [one.fraction for one in building.counted],
        "code_exception": [one.exception for one in building.counted],
    }
    names = list(columns)
    rule, base = building.design, building.base
    return {
        "storeys": [dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)],
        "goods": [asdict(kind) | {"mass": kind.mass} for kind in building.kinds if kind.live_load > 0.0],
        "goods_present_over_design_live_load": building.present_share,
        "weight": building.weight,
        "weight_of_goods": STANDARD_GRAVITY * float(building.goods_mass.sum()),
        "period_stated": building.stated_period,
        "period_mass": building.period_mass if building.stated_period is not None else None,
        "period_rule": None if building.period_rule is None else asdict(building.period_rule),
        "period_bare": building.period(),
        "period_attached": building.period(building.goods_mass),
        "damping": building.damping,
        "p_delta": building.gravity_load is not None,
        "design": None
        if rule is None
        else {"R": rule.R, "fraction": building.design_fraction, "combination": rule.combination},
        "mu_factors": list(building.mu_factors),
        "drift_limit": building.drift_limit if building.heights is not None else None,
        "drift_limit_rule": None if building.drift_limit_rule is None else asdict(building.drift_limit_rule),
        "theta_limit": building.theta_limit if building.heights is not None else None,
        "collapse_drift_ratio": building.collapse_drift_ratio,
        "base": None if base is None else {"mu_s": base.mu_s, "mu_k": base.mu_k, "radius": base.radius},
        "other_direction": None if building.other is None else _in_y(building.other, target),
        "walls": building.walls is not None,
        "damping_from_storey": building.damping_from_storey,
        "scaling_period": building.scaling_period,
        "sources": dict(building.sources),
        "file": None if building.path is None else building.path.name,
    }


ANALYSES: Final = {ADVISED: "analysis 1", BARE: "analysis 2"}
"""The pair of analyses, by their models: with the share attached, and without goods."""
DIGITS: Final = 2
"""Decimals of a drift (%, or mm) that are printed; drifts with equal ones are one, as of goods that hardly slide."""


def friction_words(building: OwnBuilding) -> dict[str, str]:
    """Return the friction of each model with sliding goods in words, "mu as stated" first."""
    low, high = building.mu_factors
    return {SLIDING: "mu as stated", SLIDING_HIGH: f"mu x {high:g}", SLIDING_LOW: f"mu x {low:g}"}


def governing_table(building: OwnBuilding, storeys: pl.DataFrame) -> pl.DataFrame:
    """Return one row per storey: mean peak drifts of both analyses and of the goods that slide (null where a run
    collapses), which governs (null where a mean is missing), its limit and the ratio to it.
    """
    words = friction_words(building)
    known = storeys["model"].unique(maintain_order=True).to_list()
    models = (ADVISED, BARE, SLIDING, SLIDING_HIGH, SLIDING_LOW)
    columns = [name for name in models if name in known]
    rows: list[dict[str, Any]] = []
    for storey in range(1, building.storeys + 1):
        rows_of_storey = storeys.filter(pl.col("storey") == storey)
        means = dict(rows_of_storey.select("model", "mean").iter_rows())
        drifts = {name: means[name] for name in columns}
        first = rows_of_storey.row(0, named=True)
        row = {"storey": storey, "name": first["name"], "unit": first["unit"], "limit": first["limit"], **drifts}
        sliding = {name: drifts[name] for name in SLIDING_ALL if drifts.get(name) is not None}
        if sliding:
            worst = max(sliding, key=lambda name: sliding[name])
            row |= {"sliding": sliding[worst], "sliding_at": words[worst]}
        if all(value is not None for value in drifts.values()):
            row |= _governing(drifts, words, 1e2 if first["unit"] == "ratio" else 1e3)
            if first["limit"] is not None:
                row["governing_over_limit"] = row["governing"] / first["limit"]
        rows.append(row)
    texts = dict.fromkeys(("name", "unit", "governed_by", "sliding_at"), pl.String)
    numbers = (*models, "governing", "sliding", "limit", "governing_over_limit")
    return pl.DataFrame(rows, schema={"storey": pl.UInt32, **texts, **dict.fromkeys(numbers, pl.Float64)})


def _governing(drifts: dict[str, float], words: dict[str, str], scale: float) -> dict[str, Any]:
    """The largest drift and what has it; sliding goods only where they drift more than both analyses."""
    model = max((name for name in ANALYSES if name in drifts), key=lambda name: drifts[name])
    largest = max(drifts, key=lambda name: drifts[name])
    if round(scale * drifts[largest], DIGITS) == round(scale * drifts[model], DIGITS):
        return {"governing": drifts[model], "governed_by": ANALYSES[model]}
    return {"governing": drifts[largest], "governed_by": f"goods slide, {words[largest]}"}


def largest_change(storeys: pl.DataFrame, models: tuple[str, ...]) -> float | None:
    """Return the largest over the smallest mean drift of a storey among `models`, less one: the largest of any storey.
    None without means.
    """
    changes = []
    for _, rows in storeys.filter(pl.col("model").is_in(models)).group_by("storey"):
        means = rows["mean"].to_list()
        if any(value is None for value in means) or not means or min(means) <= 0.0:
            return None
        changes.append(max(means) / min(means) - 1.0)
    return max(changes) if changes else None


MOST_COLLAPSES: Final = 0.1
"""Share of the motions that may bring a collapse where drifts still have a mean: one of eleven, and four of forty."""
MEDIAN_FACTOR: Final = 1.2
"""The mean is then this times the median, and at least the mean of the others: ASCE/SEI 7-16, 16.4 (from memory)."""


def drift_statistics(drifts: FloatArray) -> dict[str, float | None]:
    """Return `statistics_of` drifts, with a mean where at most `MOST_COLLAPSES` of the runs collapsed (infinite)."""
    known, fallen = statistics_of(drifts), np.isinf(drifts)
    if fallen.any() and few_collapses(int(fallen.sum()), len(drifts)):
        known["mean"] = max(MEDIAN_FACTOR * float(np.median(drifts)), float(drifts[~fallen].mean()))
    return known


def few_collapses(collapsed: int, motions: int) -> bool:
    """Whether so few runs collapsed that drifts have a mean, and an assessment an answer."""
    return collapsed <= MOST_COLLAPSES * motions


def statistics_of(values: FloatArray) -> dict[str, float | None]:
    """Return mean, quantiles and largest value over the motions; what a collapsed run (infinite) decides is null."""
    collapsed = bool(np.isinf(values).any())
    # Between a number and infinity nothing can be interpolated; then a quantile is the next larger value.
    method: Literal["higher", "linear"] = "higher" if collapsed else "linear"
    statistics = {"mean": float(values.mean())}
    statistics |= {name: float(np.quantile(values, share, method=method)) for name, share in QUANTILES.items()}
    statistics["max"] = float(values.max())
    return {name: value if np.isfinite(value) else None for name, value in statistics.items()}


def gravity_of_storeys(building: OwnBuilding, scene: Scene) -> FloatArray:
    """Return the gravity load P above each storey (N), goods included, shape (storeys,)."""
    if building.heights is not None and scene.geometric_stiffness.any():
        return scene.geometric_stiffness * building.heights
    return np.cumsum((STANDARD_GRAVITY * (building.mass + building.frames + building.goods_mass))[::-1])[::-1]


def storey_table(building: OwnBuilding, sliding_scene: Scene, runs: pl.DataFrame) -> pl.DataFrame:
    """Return one row per model and storey: statistics of the peak drift (null where a collapsed run decides), its
    limit, and theta = P d/(V h) of mean peak drift and shear with its limit (null beside walls).
    """
    heights = building.heights
    gravity, rows = gravity_of_storeys(building, sliding_scene), []
    column = "peak_drift" if heights is None else "peak_drift_ratio"
    for model in runs["model"].unique(maintain_order=True):
        for storey in range(1, building.storeys + 1):
            rows_of_storey = runs.filter((pl.col("model") == model) & (pl.col("storey") == storey))
            collapsed = rows_of_storey["collapsed"].to_numpy()
            drift = np.where(collapsed, np.inf, rows_of_storey[column].to_numpy())
            known = drift_statistics(drift)
            shears = rows_of_storey["peak_storey_shear"].to_numpy()[~collapsed]
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
    words = dict(zip(SLIDING_ALL, ("as stated", "lower bound", "upper bound"), strict=True))
    rows = []
    for model, factor in friction_factors(building).items():
        for number, level in sorted(building.sliding):
            kind = building.loose[number]
            of_kind = slips.filter((pl.col("model") == model) & (pl.col("kind") == number) & (pl.col("level") == level))
            if of_kind.height == 0:
                continue
            peak, residual = of_kind["peak_slip"].to_numpy(), np.abs(of_kind["residual_slip"].to_numpy())
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
                    "collapsed": int(of_kind["collapsed"].sum()),
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
