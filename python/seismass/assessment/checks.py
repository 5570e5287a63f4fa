"""What an assessment checks, with the clause of each limit, the input as it was understood, and goods that tip."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.assessment.building import DEFAULT_THETA_LIMIT, OwnBuilding
from seismass.assessment.floors import FloorGoods
from seismass.assessment.models import ADVISED, BARE, SLIDING, SLIDING_ALL, SLIDING_HIGH, SLIDING_LOW, friction_factors
from seismass.assessment.structure import design_table
from seismass.base.statistics import CAPPED_MEAN, QUANTILES, capped, or_infinite, quantile_interval, statistics_of
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.design import THETA_THRESHOLD
from seismass.design.rules import rule_of
from seismass.effective_mass import EffectiveMass
from seismass.media.result import table_schema
from seismass.model.codes import CODE_NAMES, FROM_MEMORY, NOT_CHECKED, VERIFIED
from seismass.model.scene import Scene
from seismass.model.tipping import FALLS_BELOW, Tipping, demand_in_g, falls_of
from seismass.motions.records.intensity import integrals
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.plane import PlaneResponse
from seismass.runs.simulate import simulate

CAPPED_DRIFT: Final = "capped mean drift ratio"
"""The check of drifts."""
OF_CODE: Final = "by ASCE/SEI 7-16, 16.4"
"""What the checks are called that this clause makes of the same runs, from memory."""
MEDIAN_FACTOR: Final = 1.2
"""There the mean is this times the median, and at least the mean of the others, where a run collapses."""


def collapses_allowed(building: OwnBuilding, motions: int) -> int:
    """Return how many collapses that clause allows: one of eleven motions, two of twenty; in risk categories III and IV
    one less.
    """
    rule = building.drift_limit_rule
    return max(0, (motions >= 11) + (motions >= 20) - (rule is not None and rule.risk_category in ("III", "IV")))


def checks_table(building: OwnBuilding, storeys: pl.DataFrame, collapses: dict[str, int], motions: int) -> pl.DataFrame:
    """Return one row per check and model: the storey with the largest value, value, limit, whether it is met (null
    where there is no value), why there is no value, and the clause of the limit. `collapses` counts runs by model.
    """
    models = [model for model in (*SLIDING_ALL, ADVISED, BARE) if model in collapses]
    allowed = collapses_allowed(building, motions)
    rows: list[dict[str, Any]] = [
        {"check": check, "model": model, "value": float(collapses[model]), "limit": float(limit), "source": source}
        for check, limit, source in (("collapsed runs", 0, ""), (f"collapsed runs {OF_CODE}", allowed, FROM_MEMORY))
        for model in models
    ]
    if building.heights is not None:
        of_code = f"{MEDIAN_FACTOR:g} times the median where runs collapse ({FROM_MEMORY}), limit as above"
        limits = {
            CAPPED_DRIFT: ("mean", building.drift_limit, f"{drift_source(building)}; {CAPPED_MEAN}"),
            f"drift ratio {OF_CODE}": ("mean_by_code", building.drift_limit, of_code),
            "stability coefficient": ("theta", building.theta_limit, _theta_source(building)),
        }
        for check, (column, limit, source) in limits.items():
            why = _missing(building, column)
            rows += [_largest(storeys, check, model, column, limit, source, why) for model in models]
        why = _missing(building, "theta_elastic")
        elastic = _largest(
            storeys, "elastic stability coefficient", models[0], "theta_elastic", THETA_THRESHOLD, "", why
        )
        elastic["source"] = "ASCE/SEI 7-10, 12.8.7 (verified): above it P-Delta must be considered"
        if building.gravity_load is not None:
            elastic["source"] += ", as it is here"
            elastic["met"] = None if elastic["value"] is None else True
        rows.append(elastic)
    return pl.DataFrame([_judged(row) for row in rows], schema=table_schema("assessment", "checks"))


def _missing(building: OwnBuilding, column: str) -> str:
    """Why a value of a storey is missing where it is."""
    if column == "mean_by_code":
        return "half of the runs collapse, or more"
    return "no storey force" if building.walls is None else "not defined beside walls"


def _largest(
    storeys: pl.DataFrame, check: str, model: str, column: str, limit: float, source: str, why: str
) -> dict[str, Any]:
    rows = storeys.filter(model=model)
    row: dict[str, Any] = {"check": check, "model": model, "limit": limit, "source": source}
    if rows[column].null_count():
        return {**row, "storey": None, "value": None, "reason": why}
    place = int(np.argmax(rows[column].to_numpy()))
    return {**row, "storey": int(rows["storey"][place]), "value": float(rows[column][place])}


def _judged(row: dict[str, Any]) -> dict[str, Any]:
    value = row["value"]
    return {"storey": None, "met": None if value is None else value <= row["limit"], "reason": None, **row}


def drift_source(building: OwnBuilding) -> str:
    """Return where the limit of the drift ratio is from, what it limits there, and how it was checked."""
    row = building.drift_limit_rule
    if row is None:
        return "as stated"
    categories = f"{row.structure}, risk category or importance class {row.risk_category}"
    if not building.category_stated:
        categories += " (none was stated)"
    checked = row.status if row.status == VERIFIED else f"{row.status}; {NOT_CHECKED}"
    note = f"; {row.note}" if row.note else ""
    factor = rule_of(row.code_id, "drift factor")
    if factor is not None and building.drift_limit != row.ratio:
        note += f"; {factor.number:g} times it at MCE_R ({factor.clause}, {factor.status})"
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
        "drift_cap": building.drift_cap,
        "risk_category": building.risk_category,
        "code_of_design": CODE_NAMES[building.rules_code],
        "code_design": design_table(building, target).to_dicts(),
        "base": None if base is None else {"mu_s": base.mu_s, "mu_k": base.mu_k, "radius": base.radius},
        "other_direction": None if building.other is None else _in_y(building.other, target),
        "walls": building.walls is not None,
        "damping_from_storey": building.damping_from_storey,
        "scaling_period": building.scaling_period,
        "sources": dict(building.sources),
        "file": None if building.path is None else building.path.name,
        "file_sha256": building.file_sha256,
        "units": building.units,
    }


ANALYSES: Final = {ADVISED: "analysis 1", BARE: "analysis 2"}
"""The pair of analyses, by their models: with the share attached, and without goods."""
ONE_ANALYSIS: Final = {ADVISED: "the analysis", BARE: "the analysis"}
"""The same where the share is 0 and both are one."""
DIGITS: Final = 2
"""Decimals of a drift (%, or mm) that are printed; drifts with equal ones are one, as of goods that hardly slide."""


def friction_words(mu_factors: tuple[float, float]) -> dict[str, str]:
    """Return the friction of each model with sliding goods in words, "mu as stated" first."""
    low, high = mu_factors
    return {SLIDING: "mu as stated", SLIDING_HIGH: f"mu x {high:g}", SLIDING_LOW: f"mu x {low:g}"}


def governing_table(building: OwnBuilding, storeys: pl.DataFrame) -> pl.DataFrame:
    """Return one row per storey: capped mean drifts of both analyses and of the goods that slide, which governs, its
    limit and the ratio to it.
    """
    words = friction_words(building.mu_factors)
    known = storeys["model"].unique(maintain_order=True).to_list()
    both = [storeys.filter(model=name)["mean"].to_list() for name in ANALYSES]
    called = ONE_ANALYSIS if both[0] in (both[1], []) else ANALYSES
    models = (ADVISED, BARE, SLIDING, SLIDING_HIGH, SLIDING_LOW)
    columns = [name for name in models if name in known]
    rows: list[dict[str, Any]] = []
    for storey in range(1, building.storeys + 1):
        rows_of_storey = storeys.filter(pl.col("storey") == storey)
        means = dict(rows_of_storey.select("model", "mean").iter_rows())
        drifts = {name: means[name] for name in columns}
        first = rows_of_storey.row(0, named=True)
        row = {"storey": storey, "name": first["name"], "unit": first["unit"], "limit": first["limit"], **drifts}
        sliding = {name: drifts[name] for name in SLIDING_ALL if name in drifts}
        if sliding:
            worst = max(sliding, key=lambda name: sliding[name])
            row |= {"sliding": sliding[worst], "sliding_at": words[worst]}
        row |= _governing(drifts, words, called, 1e2 if first["unit"] == "ratio" else 1e3)
        if first["limit"] is not None:
            row["governing_over_limit"] = row["governing"] / first["limit"]
        rows.append(row)
    return pl.DataFrame(rows, schema=table_schema("assessment", "governing"))


def _governing(drifts: dict[str, float], words: dict[str, str], called: dict[str, str], scale: float) -> dict[str, Any]:
    """The largest drift and what has it; sliding goods only where they drift more than both analyses."""
    model = max((name for name in ANALYSES if name in drifts), key=lambda name: drifts[name])
    largest = max(drifts, key=lambda name: drifts[name])
    if round(scale * drifts[largest], DIGITS) == round(scale * drifts[model], DIGITS):
        return {"governing": drifts[largest], "governed_by": called[model]}
    return {"governing": drifts[largest], "governed_by": f"goods slide, {words[largest]}"}


def largest_change(storeys: pl.DataFrame, models: tuple[str, ...]) -> float | None:
    """Return the largest over the smallest mean drift of a storey among `models`, less one: the largest of any storey.
    None where nothing drifts.
    """
    changes = []
    for _, rows in storeys.filter(pl.col("model").is_in(models)).group_by("storey"):
        means = rows["mean"].to_list()
        if min(means) <= 0.0:
            return None
        changes.append(max(means) / min(means) - 1.0)
    return max(changes) if changes else None


def largest_excess(governing: pl.DataFrame) -> tuple[float, int, str]:
    """Return the largest drift with goods that slide over the larger analysis, its storey and its friction."""
    return max(
        (row["sliding"] / max(row[ADVISED], row[BARE]), row["storey"], row["sliding_at"])
        for row in governing.iter_rows(named=True)
    )


def drift_statistics(peaks: FloatArray, collapsed: NDArray[np.bool_], cap: float) -> dict[str, float | None]:
    """Return the statistics of a storey's peak drifts: the capped mean; quantiles, the largest, and the mean of
    ASCE/SEI 7-16, of drifts that a collapse makes infinite (null where that decides).
    """
    known = statistics_of(or_infinite(peaks, collapsed))
    if collapsed.any() and known["median"] is not None:
        known["mean"] = max(MEDIAN_FACTOR * known["median"], float(peaks[~collapsed].mean()))
    return known | {"mean": float(capped(peaks, cap).mean()), "mean_by_code": known["mean"]}


def drifts_of(building: OwnBuilding, runs: pl.DataFrame) -> FloatArray:
    """Return peak drifts of both analyses and of goods that slide, shape (models, motions, storeys)."""
    column = "peak_drift" if building.heights is None else "peak_drift_ratio"
    rows = runs.filter(pl.col("model").is_in([ADVISED, BARE, *SLIDING_ALL]))
    return rows[column].to_numpy().reshape(rows["model"].n_unique(), -1, building.storeys)


def left_out_table(
    building: OwnBuilding, runs: pl.DataFrame, effective: dict[str, EffectiveMass], labels: dict[str, Any]
) -> pl.DataFrame:
    """Return one row per motion: what it is (`labels`), and without it the largest effective fraction and the governing
    drift, the largest of any storey; null for a motion alone. Analysis 1 keeps its share.
    """
    drifts = capped(drifts_of(building, runs), building.drift_cap)
    others = drifts.shape[1] - 1
    without = (drifts.sum(axis=1, keepdims=True) - drifts) / (others or np.nan)
    columns = {"motion": pl.int_range(1, others + 2, dtype=pl.UInt32, eager=True), **labels}
    shares = {name: one.records["value_without"] for name, one in effective.items()}
    columns |= {"fraction": pl.DataFrame(shares).max_horizontal() if shares else None}
    columns |= {"governing": without.max(axis=(0, 2))}
    return pl.DataFrame(columns, schema_overrides={"fraction": pl.Float64}).fill_nan(None)


def gravity_of_storeys(building: OwnBuilding, scene: Scene) -> FloatArray:
    """Return the gravity load P above each storey (N), goods included, shape (storeys,)."""
    if building.heights is not None and scene.geometric_stiffness.any():
        return scene.geometric_stiffness * building.heights
    return np.cumsum((STANDARD_GRAVITY * (building.mass + building.frames + building.goods_mass))[::-1])[::-1]


def checked_storeys(building: OwnBuilding, sliding_scene: Scene, runs: pl.DataFrame) -> pl.DataFrame:
    """Return one row per model and storey: `drift_statistics`, limit, and theta = P d/(V h) of the capped mean drift
    and the mean peak shear with its limit (null beside walls).
    """
    heights = building.heights
    gravity, rows = gravity_of_storeys(building, sliding_scene), []
    column = "peak_drift" if heights is None else "peak_drift_ratio"
    for model in runs["model"].unique(maintain_order=True):
        for storey in range(1, building.storeys + 1):
            rows_of_storey = runs.filter((pl.col("model") == model) & (pl.col("storey") == storey))
            collapsed = rows_of_storey["collapsed"].to_numpy()
            drift = rows_of_storey[column].to_numpy()
            above_limit = collapsed | (drift > building.drift_limit)
            known = drift_statistics(drift, collapsed, building.drift_cap)
            shear = float(rows_of_storey["peak_storey_shear"].to_numpy().mean())
            mean, load = known["mean"], float(gravity[storey - 1])
            assert mean is not None
            alone = building.walls is None
            elastic = None
            if heights is not None and alone:
                elastic = load / float(building.stiffness[storey - 1] * heights[storey - 1])
            has_theta = heights is not None and alone and shear > 0.0
            rows.append(
                {
                    "model": model,
                    "storey": storey,
                    "name": building.storey_names[storey - 1],
                    "unit": "m" if heights is None else "ratio",
                    **known,
                    "limit": None if heights is None else building.drift_limit,
                    "mean_over_limit": None if heights is None else mean / building.drift_limit,
                    "motions_above_limit": None if heights is None else int(above_limit.sum()),
                    "collapsed": int(collapsed.sum()),
                    "mean_peak_shear": shear,
                    # With drift ratios the height is in the drift already.
                    "theta": load * mean / shear if has_theta else None,
                    "theta_elastic": elastic,
                    "theta_limit": None if heights is None else building.theta_limit,
                }
            )
    return pl.DataFrame(rows, schema_overrides=table_schema("assessment", "storeys"))


def slip_table(
    building: OwnBuilding, slips: pl.DataFrame, counts: FloatArray | None = None, confidence: float = 0.90
) -> pl.DataFrame:
    """Return one row per friction, kind of loose goods present and level of its rack: motions that slide, statistics of
    peak and residual slip (m) until a collapse, the interval of `peak_p84` by these `counts`, and collapsed runs.
    """
    words = dict(zip(SLIDING_ALL, ("as stated", "lower bound", "upper bound"), strict=True))
    rows = []
    for model, factor in friction_factors(building.mu_factors).items():
        for number, level in sorted(building.sliding(factor)):
            kind = building.loose[number]
            of_kind = slips.filter((pl.col("model") == model) & (pl.col("kind") == number) & (pl.col("level") == level))
            if of_kind.height == 0:
                continue
            peak, residual = of_kind["peak_slip"].to_numpy(), np.abs(of_kind["residual_slip"].to_numpy())
            left = statistics_of(residual)
            ends = (None, None) if counts is None else quantile_interval(peak, QUANTILES["p84"], counts, confidence)
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
                    "peak_p84_low": ends[0],
                    "peak_p84_high": ends[1],
                    **{f"residual_{name}": left[name] for name in ("mean", "median", "p84")},
                    "collapsed": int(of_kind["collapsed"].sum()),
                }
            )
    return pl.DataFrame(rows, schema=table_schema("assessment", "slip"))


def collapses_of(runs: pl.DataFrame) -> dict[str, int]:
    """Return the number of collapsed runs of each model."""
    first = runs.filter(pl.col("storey") == 1)
    counted = first.group_by("model", maintain_order=True).agg(pl.col("collapsed").sum())
    return dict(counted.iter_rows())


WORDS: Final[dict[Tipping, str]] = {
    "slide": "goods that slide with their mu",
    "split": "split",
    "attached": "attached",
}
"""What texts call the models of goods that tip."""
TAKEN: Final = "goods that tip taken as "
"""How the answer under another of them begins."""
BOUNDS: Final = (SLIDING_LOW, SLIDING_HIGH)
"""Columns of the models at the bounds of friction."""


def tipping_kinds(building: OwnBuilding) -> tuple[FloorGoods, ...]:
    """Return the kinds of goods present that tip before they slide at any of the frictions of an assessment."""
    factors = friction_factors(building.mu_factors).values()
    return tuple(kind for kind in building.present if any(kind.tips_first(factor) for factor in factors))


def other_models(building: OwnBuilding) -> dict[str, OwnBuilding]:
    """Return a building with the other models of goods that tip, by what they are called."""
    kinds, factors = tipping_kinds(building), friction_factors(building.mu_factors).values()
    models = {kind.model(factor) for kind in kinds for factor in factors if kind.tips_first(factor)}
    others = {model: words for model, words in WORDS.items() if models and models != {model}}
    return {f"{TAKEN}{words}": building.with_tipping(model) for model, words in others.items()}


def tipping_table(building: OwnBuilding, scene: Scene, motions: Sequence[Any]) -> pl.DataFrame:
    """Return one row per kind of goods that tips: size (m), b/h, its model at each friction, the part that stays, and
    under how many motions its floor exceeds b/h ("lifts"), and Ishiyama's limit of velocity too ("limits_exceeded").
    """
    kinds, factors = tipping_kinds(building), friction_factors(building.mu_factors)
    demand, velocity = _floor_peaks(scene, motions) if kinds else (np.empty((0, 0)), np.empty((0, 0)))
    rows = []
    for kind in kinds:
        size, floor = kind.size, kind.floor - 1
        assert size is not None
        lifts = demand[:, floor] > size.uplift_g
        models = {name: kind.model(factor) for name, factor in factors.items()}
        rows.append(
            {
                "floor": kind.floor,
                "name": building.storey_names[floor],
                "goods": kind.name,
                "width": size.width,
                "height": size.height,
                "ratio": size.uplift_g,
                "mu_s": kind.mu_s,
                "model": models.pop(SLIDING),
                "staying": kind.staying(),
                **{name: models.get(name) for name in BOUNDS},
                "motions": len(demand),
                "lifts": int(lifts.sum()),
                "limits_exceeded": int((lifts & (velocity[:, floor] > (size.overturning_velocity or 0.0))).sum()),
            }
        )
    return pl.DataFrame(rows, schema=table_schema("assessment", "tipping"))


def _floor_peaks(scene: Scene, motions: Sequence[Any]) -> tuple[FloatArray, FloatArray]:
    """Largest acceleration over g + a_v, and absolute velocity (m/s), of each floor, shape (motions, storeys)."""
    demands, velocities = [], []
    for motion in motions:
        response = simulate(scene, motion, histories=True, events=False)
        grounds = response.motions if isinstance(response, PlaneResponse) else (response.motion,)
        ground = np.stack([integrals(each.acceleration, each.dt)[0] for each in grounds], axis=-1)
        moving = response.floor_velocity.reshape(len(ground), scene.storeys, -1) + ground[:, None, :]
        shaking = response.floor_acceleration.reshape(moving.shape)
        lengths = np.linalg.norm(shaking, axis=-1)
        demands.append([demand_in_g(of_floor, grounds[0].vertical) for of_floor in lengths.T])
        velocities.append(np.nanmax(np.linalg.norm(moving, axis=-1), axis=0))
    return np.array(demands), np.array(velocities)


def tipping_sentences(building: OwnBuilding, table: pl.DataFrame) -> tuple[str, ...]:
    """Return what is said of goods that tip, a sentence for each b/h and model: what stands for them and why, how often
    they lift off and may fall, and how many of such blocks fall.
    """
    sentences = []
    words = friction_words(building.mu_factors)
    keys = ("ratio", "height", "mu_s", "model", *BOUNDS)
    for _, rows in table.group_by(keys, maintain_order=True):
        row = rows.row(0, named=True)
        floors = ", ".join(str(floor) for floor in dict.fromkeys(rows["floor"]))
        named = " and ".join(name for name in dict.fromkeys(rows["goods"]) if name) or "goods"
        first = row["model"] != "slide"
        models = [(words[name], row[name]) for name in BOUNDS if row[name]]
        where = "" if first else f" with {next((text for text, model in models if model != 'slide'), '')}"
        differing = [(text, model) for text, model in models if model != row["model"]]
        other = "; ".join(f"with {text} they are {_model(row, model)}" for text, model in differing)
        how = _model(row, row["model"]) if first else f"taken as goods that slide with {words[SLIDING]}"
        lifts, falls = (rows[name].to_numpy().max() for name in ("lifts", "limits_exceeded"))
        sentences.append(
            f"{named} on floor {floors} tip before they slide{where} (b/h = {row['ratio']:.3g}, mu = "
            f"{row['mu_s']:.3g}): they are {how}{f' ({other})' * bool(other)}; they lift off in up to {lifts} of "
            f"{row['motions']} motions and may fall in up to {falls}, in which both limits of Ishiyama are exceeded"
            f"{_falls(row)}"
        )
    return tuple(sentences)


def _model(row: dict[str, Any], model: Tipping) -> str:
    """What stands for goods, and why."""
    if model == "slide":
        return "taken as goods that slide"
    if model == "split":
        part = f"{row['staying']:.2f}" if row["model"] == "split" else "a part"
        return f"split, {part} of them staying with the floor and the rest sliding with mu = b/h"
    return f"taken as attached{f', as blocks of b/h below {FALLS_BELOW:g} may fall' * (row['ratio'] < FALLS_BELOW)}"


def _falls(row: dict[str, Any]) -> str:
    """How many of single blocks of such a size fall of those that lift off."""
    known = falls_of(row["ratio"], row["height"])
    if known is None:
        return ""
    return (
        f"; of blocks of {known.height} with b/h {known.ratio:g} that lift off at a design level of S_DS = 1 g, "
        f"{100.0 * known.share:.0f} % fall ({100.0 * known.low:.0f} to {100.0 * known.high:.0f} % by building)"
    )
