"""The tables of a study from the rows of its batch: responses, summary with its scatter, and designs.

Unit and meaning of each column, as files carry them and the schema page lists them, are rows of data/tables.
"""

from __future__ import annotations

from functools import partial
from typing import Any, Final, Literal, NamedTuple, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.arguments import Progress, ProgressLike
from seismass.base.statistics import QUANTILES, capped, quantile
from seismass.base.stored_results import NOTHING_STORED, StoredResults
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.effective_mass import effective_mass
from seismass.effective_mass.models import building_of
from seismass.effective_mass.rule import by_hand
from seismass.media.result import finite_values, stored_tables, table_schema
from seismass.model.scene import Scene
from seismass.motions.records import Record
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.batch_tables import PER_BLOCK, PER_STOREY
from seismass.studies.study.parameters import KEYS, MODELS, Model, StudyBuilding, StudyParameters

TABLES: Final = {
    table: (words, {name: (row["unit"], row["meaning"]) for name, row in columns.items()})
    for table, (words, columns) in stored_tables("study").items()
}
"""What a row of each table is, and its columns with unit ("" where there is none, "1" for ratios) and meaning."""

Drifts: TypeAlias = dict[Model, FloatArray]
"""Capped peak drifts (m) by model, shape (rows, motions), until a collapse; NaN where a run failed."""

_PER_STOREY: Final = tuple(name for name in (*PER_STOREY, *PER_BLOCK) if name != "peak_slip_time")
"""Columns of a batch that are lists per storey, or per block."""


def typed(columns: dict[str, Any], table: str) -> pl.DataFrame:
    """Return columns as a frame, in the order of a table, with its types; NaN is null."""
    schema = table_schema("study", table)
    doubles = [name for name, kind in schema.items() if kind == pl.Float64]
    return pl.DataFrame({name: columns[name] for name in schema}, schema=schema).with_columns(
        pl.col(doubles).fill_nan(None)
    )


def key_columns(buildings: list[StudyBuilding], repeats: NDArray[np.int64] | int = 1) -> dict[str, pl.Series]:
    """Return the key columns, each building's as often as `repeats` says."""
    schema = {key: kind for key, kind in table_schema("study", "fractions").items() if key in KEYS}
    labels = pl.DataFrame([building.labels for building in buildings], schema=schema)
    which = np.repeat(np.arange(len(buildings), dtype=np.uint32), repeats)
    return labels[which].to_dict()


def responses_table(
    buildings: list[StudyBuilding], names: list[str], table: pl.DataFrame, run_of: NDArray[np.int64]
) -> pl.DataFrame:
    """One row per building, model, motion and storey; `run_of` is the row of `table` (one per distinct run) of each
    analysis, building by building, model by model, motion by motion.
    """
    motion = np.tile(np.arange(len(names)), len(buildings) * len(MODELS))
    model = np.tile(np.repeat(np.arange(len(MODELS)), len(names)), len(buildings))
    storey = pl.col("storey") - 1

    def per_storey(name: str) -> pl.Expr:
        return pl.col(name).list.get(storey, null_on_oob=True)

    frame = pl.DataFrame(
        {
            **key_columns(buildings, len(MODELS) * len(names)),
            "model": pl.Series(MODELS, dtype=pl.String).gather(model),
            "motion": motion + 1,
            "record": pl.Series(names, dtype=pl.String).gather(motion),
            "run": run_of + 1,
        }
    )
    frame = pl.concat([frame, table.select("status", "reason", *_PER_STOREY)[run_of]], how="horizontal")
    # Goods stand on every floor but the roof, so that blocks are numbered as the floors that carry them.
    return (
        frame.with_columns(pl.int_ranges(1, pl.col("storeys") + 1).alias("storey"))
        .explode("storey")
        .with_columns(per_storey(name) for name in _PER_STOREY)
        .with_columns(
            (pl.col("peak_storey_shear") / (STANDARD_GRAVITY * pl.col("storeys"))).alias("peak_shear_over_weight"),
        )
        .select(pl.col(name).cast(kind) for name, kind in table_schema("study", "responses").items())
    )


def drifts_of(responses: pl.DataFrame, motions: int, parameters: StudyParameters) -> Drifts:
    """Return the peak drifts of a table of responses, one row per building and storey, as the summary has them."""
    drifts = _by_model(responses, motions, pl.col("peak_drift").fill_null(np.nan))
    return {model: capped(values, parameters.drift_cap * parameters.height) for model, values in drifts.items()}


def collapsed_of(responses: pl.DataFrame, motions: int) -> dict[Model, NDArray[np.bool_]]:
    """Return which runs collapsed, in the order of `drifts_of`."""
    return _by_model(responses, motions, pl.col("status").fill_null("") == "collapsed")


def _by_model(responses: pl.DataFrame, motions: int, value: pl.Expr) -> dict[Model, Any]:
    """A value of each run by model, shape (rows, motions)."""
    ordered = responses.sort("building", "storey", "motion", maintain_order=True)
    return {
        model: ordered.filter(model=model).select(value.alias("value"))["value"].to_numpy().reshape(-1, motions)
        for model in MODELS
    }


def summary_table(
    buildings: list[StudyBuilding], responses: pl.DataFrame, names: list[str], parameters: StudyParameters
) -> pl.DataFrame:
    """One row per building and storey: capped means, scatter, and what one record carries. A failed run makes
    statistics of its model null.
    """
    drifts = drifts_of(responses, len(names), parameters)
    fallen = collapsed_of(responses, len(names))
    storeys = np.array([building.labels["storeys"] for building in buildings])
    columns: dict[str, Any] = {
        **key_columns(buildings, storeys),
        "storey": np.concatenate([np.arange(1, count + 1) for count in storeys]),
        "motions": np.full(storeys.sum(), len(names)),
    }
    for model, values in drifts.items():
        means = values.mean(axis=1)
        columns |= {
            f"mean_peak_drift_{model}": means,
            f"geometric_mean_peak_drift_{model}": geometric_mean(values),
            **{f"{name}_peak_drift_{model}": quantile(values, share) for name, share in QUANTILES.items()},
            f"mean_peak_drift_ratio_{model}": means / parameters.height,
            f"collapses_{model}": fallen[model].sum(axis=1),
        }
    slips = (
        responses.filter(model="real")
        .sort("building", "storey", "motion", maintain_order=True)["peak_slip"]
        .to_numpy()
        .reshape(-1, len(names))
    )
    columns["mean_peak_slip"] = slips.mean(axis=1)
    columns |= _comparison(drifts, names)
    return typed(columns, "summary")


def _comparison(drifts: Drifts, names: list[str]) -> dict[str, Any]:
    """The models against each other."""
    sliding, code = drifts["real"], drifts["code"]
    with np.errstate(divide="ignore", invalid="ignore"):
        means = {model: values.mean(axis=1) for model, values in drifts.items()}
        ratio = means["real"] / means["code"]
        each = 100.0 * (sliding / code - 1.0)
        columns: dict[str, Any] = {
            "ratio": ratio,
            "ratio_mass": means["attached"] / means["code"],
            "ratio_sliding": means["real"] / means["attached"],
            "underestimation_percent": 100.0 * (ratio - 1.0),
            "geometric_mean_underestimation_percent": 100.0 * (geometric_mean(sliding) / geometric_mean(code) - 1.0),
            "median_underestimation_percent": quantile(each, 0.5),
            "p16_underestimation_percent": quantile(each, 0.16),
            "p84_underestimation_percent": quantile(each, 0.84),
        }
        others = {model: values.sum(axis=1, keepdims=True) - values for model, values in drifts.items()}
        left_out = 100.0 * (others["real"] / others["code"] - 1.0)
    change = np.abs(left_out - columns["underestimation_percent"][:, None])
    known = np.isfinite(change).all(axis=1) & (len(names) > 1)
    most = np.argmax(np.where(known[:, None], change, 0.0), axis=1)
    columns |= {
        "leave_one_out_percent": np.where(known, left_out[np.arange(len(left_out)), most], np.nan),
        "leave_one_out_motion": [int(number) + 1 if there else None for number, there in zip(most, known, strict=True)],
        "leave_one_out_record": [names[number] if there else None for number, there in zip(most, known, strict=True)],
    }
    return columns


def geometric_mean(values: FloatArray, axis: int = 1) -> FloatArray:
    """Return the geometric mean over an axis; 0 where a value is."""
    with np.errstate(divide="ignore"):
        return np.asarray(np.exp(np.log(values).mean(axis=axis)))


def designs_table(buildings: list[StudyBuilding], parameters: StudyParameters) -> pl.DataFrame:
    """One row per building and storey: masses, V_e, V_y, periods, P-Delta."""
    storeys = np.array([building.labels["storeys"] for building in buildings])
    weight = np.repeat(STANDARD_GRAVITY * storeys, storeys)

    code = [building.scenes["code"] for building in buildings]
    sliding = [building.scenes["real"] for building in buildings]
    strength = np.concatenate([building.yield_shear for building in buildings]) / weight
    columns: dict[str, Any] = {
        **key_columns(buildings, storeys),
        "storey": np.concatenate([np.arange(1, count + 1) for count in storeys]),
        "design_mass_ratio": np.concatenate([building.design_mass for building in buildings]),
        "analysis_mass_ratio": np.concatenate([building_of(scene).mass for scene in code]),
        "height": np.full(storeys.sum(), parameters.height),
        "geometric_stiffness_ratio": np.concatenate(
            [scene.geometric_stiffness / building_of(scene).stiffness for scene in sliding]
        ),
        "design_period": np.concatenate([building.analysis.modes.periods for building in buildings]),
        "spectral_acceleration": np.concatenate([building.analysis.ordinates for building in buildings]),
        "elastic_shear_over_weight": np.concatenate([building.analysis.storey_shear for building in buildings])
        / weight,
        "yield_shear_over_weight": np.where(np.isfinite(strength), strength, np.nan),
    }
    return typed(columns, "designs")


SHARES: Final = np.linspace(0.0, 1.0, 41)
"""Shares at which models are solved before roots are refined: fewer than `effective_mass` takes by itself, as a study
has dozens of buildings. Refined roots are the same."""


class Fraction(NamedTuple):
    """What a study takes from an `EffectiveMass`; the ends of its interval are None where there is none."""

    value: float
    kind: str
    low: float | None
    high: float | None
    excess: float


def fractions_table(
    buildings: list[StudyBuilding],
    table: pl.DataFrame,
    run_of: NDArray[np.int64],
    effective: dict[Scene, Fraction] | None,
    target: TargetSpectrum,
) -> pl.DataFrame:
    """One row per building: mean peak base shear of the fully attached model over the full weight (null where a run
    of it failed), friction over it, C1 and share of the rule by hand, and the effective fraction where computed.
    """
    runs = run_of.reshape(len(buildings), len(MODELS), -1)[:, MODELS.index("attached")]
    completed = (table["status"] != "failed").to_numpy()[runs].all(axis=1)
    shear = table["peak_base_shear"].to_numpy()[runs].mean(axis=1)
    mass = [building_of(building.scenes["attached"]).mass.sum() for building in buildings]
    weight = STANDARD_GRAVITY * np.array(mass)
    coefficient = np.where(completed, shear / weight, np.nan)
    mu = np.array([building.labels["mu"] for building in buildings])
    with np.errstate(divide="ignore"):
        eta: FloatArray = mu / coefficient
    rules = [by_hand(building.scenes["real"], None, target) for building in buildings]
    columns: dict[str, Any] = {
        **key_columns(buildings),
        "base_shear_coefficient": coefficient,
        "eta": eta,
        "coefficient": [rule.coefficient for rule in rules],
        "estimate": [rule.estimate for rule in rules],
    }
    fractions = [None if effective is None else effective[building.scenes["real"]] for building in buildings]
    columns |= {
        "effective": [np.nan if one is None else one.value for one in fractions],
        "kind": [None if one is None else one.kind for one in fractions],
        "low": [None if one is None else one.low for one in fractions],
        "high": [None if one is None else one.high for one in fractions],
        "excess": [None if one is None or one.kind != "one" else one.excess for one in fractions],
    }
    return typed(columns, "fractions")


def effective_fractions(
    buildings: list[StudyBuilding],
    records: list[Record],
    parameters: StudyParameters,
    *,
    threads: int | None = None,
    progress: ProgressLike = None,
    store: StoredResults = NOTHING_STORED,
) -> dict[Scene, Fraction]:
    """Return the effective fraction of each distinct building with its goods. Damping is that of the study: the real
    building's matrix, or with `damping_base="own"` the ratio in the modes of each model.
    """
    scenes = list(dict.fromkeys(building.scenes["real"] for building in buildings))
    damping: Literal["same", "ratio"] = "ratio" if parameters.damping_base == "own" else "same"
    fractions, whole = {}, Progress(progress, len(scenes), "effective fractions")
    for number, scene in enumerate(scenes, start=1):
        solve = partial(_solved, scene, records, damping, parameters.drift_cap, threads)
        fractions[scene] = Fraction(*store.of(f"effective-{number}", solve).row(0))
        whole.tell()
    return fractions


def _solved(
    scene: Scene, records: list[Record], damping: Literal["same", "ratio"], drift_cap: float, threads: int | None
) -> pl.DataFrame:
    """A `Fraction` as a table of one row."""
    how: dict[str, Any] = {"damping": damping, "drift_cap": drift_cap, "fractions": SHARES, "threads": threads}
    one = effective_mass(scene, records, **how)
    low, high = one.interval or (None, None)
    types = {"value": pl.Float64, "kind": pl.String, "low": pl.Float64, "high": pl.Float64, "excess": pl.Float64}
    return pl.DataFrame([Fraction(one.value, one.kind, low, high, one.excess)], schema=types, orient="row")


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
    keys = ["building", "eta", "estimate", "effective"]
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
        # Null where one building has no number, so that no mean is of fewer buildings.
        of_all = (pl.when(pl.col(name).null_count() == 0).then(pl.col(name).mean()).alias(name) for name in compared)
        means = first.group_by("R", "alpha").agg(of_all).sort("R", "alpha")
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
                "largest": finite_values(ranked.select(place).row(0, named=True)) if known.height else None,
                "smallest": finite_values(ranked.select(place).row(-1, named=True)) if known.height else None,
                "growth": {
                    "alpha": _growth(rows, "alpha", "R"),
                    "R": _growth(rows, "R", "alpha"),
                    "alpha_first_storey": _growth(first, "alpha", "R"),
                    "R_first_storey": _growth(first, "R", "alpha"),
                },
                "first_storey": [finite_values(row) for row in means.to_dicts()],
            }
        )
    return entries


def _growth(rows: pl.DataFrame, varied: str, fixed: str) -> dict[str, int]:
    # Rows without a result stay in their places: rows on both sides of one are not a single step apart.
    value = pl.col("underestimation_percent")
    known = pl.when(value.is_finite()).then(value)
    steps = rows.sort(varied).with_columns(known.diff().over([*_STOREY, fixed]).alias("step"))
    return {"pairs": steps["step"].count(), "grows": int((steps["step"] > ROUNDING).sum())}
