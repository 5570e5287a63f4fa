"""What an assessment checks, with the clause of each limit, and the input as it was understood."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np
import polars as pl

from seismass.assessment.models import ADVISED, BARE, REALS
from seismass.assessment.own_building import DEFAULT_DRIFT_LIMIT, DEFAULT_THETA_LIMIT, OwnBuilding
from seismass.base.units import STANDARD_GRAVITY
from seismass.design import THETA_THRESHOLD, drift_limit
from seismass.model.codes import NOT_CHECKED, VERIFIED
from seismass.spectra import TargetSpectrum


def checks_table(building: OwnBuilding, storeys: pl.DataFrame, collapses: dict[str, int]) -> pl.DataFrame:
    """Return one row per check and model: the storey with the largest value, value, limit, whether it is met (null
    where collapses leave no value), and the clause of the limit. `collapses` counts collapsed runs by model.
    """
    models = [model for model in (*REALS, ADVISED, BARE) if model in collapses]
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
    of = storeys.filter(model=model)
    row: dict[str, Any] = {"check": check, "model": model, "limit": limit, "source": source}
    if of[column].null_count():
        return {**row, "storey": None, "value": None}
    place = int(np.argmax(of[column].to_numpy()))
    return {**row, "storey": int(of["storey"][place]), "value": float(of[column][place])}


def _judged(row: dict[str, Any]) -> dict[str, Any]:
    value = row["value"]
    return {"storey": None, "met": None if value is None else value <= row["limit"], **row}


def drift_source(building: OwnBuilding) -> str:
    """Return where the limit of the drift ratio is from, what it limits there, and how it was checked."""
    row = building.drift_limit_rule
    if row is None:
        if building.drift_limit != DEFAULT_DRIFT_LIMIT:
            return "as stated"
        row, of = drift_limit("asce7-10"), "risk category I or II"
    else:
        of = f"{row.structure}, risk category or importance class {row.risk_category}"
    checked = row.status if row.status == VERIFIED else f"{row.status}; {NOT_CHECKED}"
    note = f"; {row.note}" if row.note and building.drift_limit_rule is not None else ""
    return f"{row.code}, {row.clause}, {of} ({checked}); it limits {row.of}, here nonlinear drift{note}"


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
        "period_attached": building.period(building.goods),
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
        "goods": building.goods.tolist(),
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
        "weight_of_goods": STANDARD_GRAVITY * float(building.goods.sum()),
        "period_stated": building.stated_period,
        "period_mass": building.period_mass if building.stated_period is not None else None,
        "period_rule": None if building.period_rule is None else asdict(building.period_rule),
        "period_bare": building.period(),
        "period_attached": building.period(building.goods),
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
