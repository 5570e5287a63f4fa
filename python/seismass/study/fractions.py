"""How much of the live load each building of a study should count: eta, its two estimates, and lambda_eff itself."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, Final, Literal, NamedTuple

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.kept import NOTHING_KEPT, KeptResults
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.effective_mass import effective_mass
from seismass.effective_mass.estimate import best_estimate, conservative_estimate, exponent, height_ratio
from seismass.effective_mass.models import building_of, goods_mass
from seismass.model.scene import Scene
from seismass.records import Record
from seismass.study.buildings import MODELS, StudyBuilding
from seismass.study.columns import FRACTION_COLUMNS
from seismass.study.parameters import StudyParameters
from seismass.study.tables import key_columns, typed

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
    corner: float,
) -> pl.DataFrame:
    """One row per building: C1, eta, both estimates, and lambda_eff where computed. C1 is the mean peak base shear of
    the fully attached model over the full weight; null where a run of it collapsed or failed.
    """
    runs = run_of.reshape(len(buildings), len(MODELS), -1)[:, MODELS.index("attached")]
    completed = (table["status"] == "completed").to_numpy()[runs].all(axis=1)
    shear = table["peak_base_shear"].to_numpy()[runs].mean(axis=1)
    weight = STANDARD_GRAVITY * np.array([_attached_mass(building.scenes["attached"]) for building in buildings])
    coefficient = np.where(completed, shear / weight, np.nan)
    mu = np.array([building.labels["mu"] for building in buildings])
    with np.errstate(divide="ignore"):
        eta: FloatArray = mu / coefficient
    ratios, powers = (np.array(values) for values in zip(*_of_rule(buildings, table, runs, corner), strict=True))
    columns: dict[str, Any] = {
        **key_columns(buildings),
        "base_shear_coefficient": coefficient,
        "eta": eta,
        "height_ratio": ratios,
        "exponent": powers,
        "estimate": best_estimate(eta, powers, ratios),
        "conservative": conservative_estimate(eta, ratios),
    }
    found = [None if effective is None else effective[building.scenes["real"]] for building in buildings]
    columns |= {
        "effective": [np.nan if one is None else one.value for one in found],
        "kind": [None if one is None else one.kind for one in found],
        "low": [None if one is None else one.low for one in found],
        "high": [None if one is None else one.high for one in found],
        "excess": [None if one is None or one.kind != "one" else one.excess for one in found],
    }
    return typed(columns, list(FRACTION_COLUMNS))


def _of_rule(
    buildings: list[StudyBuilding], table: pl.DataFrame, runs: NDArray[np.int64], corner: float
) -> Iterator[tuple[float, float]]:
    """Yield h_g/h_m and the exponent of each building; it yields where its mean peak drift is above that of V_y."""
    drifts = table["peak_drift"]
    for building, own in zip(buildings, runs, strict=True):
        bare = building_of(building.scenes["real"])
        mean = np.mean([drifts[int(run)].to_numpy() for run in own], axis=0)
        yields = bool((mean > bare.yield_shear / bare.stiffness).any())
        ratio = height_ratio(goods_mass(building.scenes["real"]), bare.mass, bare.heights)
        yield ratio, float(exponent(float(bare.periods[0]), corner, yields))


def _attached_mass(scene: Scene) -> float:
    return 0.0 if scene.building is None else float(scene.building.mass.sum())


def effective_fractions(
    buildings: list[StudyBuilding],
    records: list[Record],
    parameters: StudyParameters,
    *,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    kept: KeptResults = NOTHING_KEPT,
) -> dict[Scene, Fraction]:
    """Return the effective fraction of each distinct building with its goods. Damping is that of the study: the real
    building's matrix, or with `damping_base="own"` the ratio in the modes of each model.
    """
    scenes = list(dict.fromkeys(building.scenes["real"] for building in buildings))
    damping: Literal["same", "ratio"] = "ratio" if parameters.damping_base == "own" else "same"
    found = {}
    for number, scene in enumerate(scenes, start=1):
        solve = partial(_solved, scene, records, damping, threads)
        found[scene] = Fraction(*kept.of(f"effective-{number}", solve).row(0))
        if progress is not None:
            progress(number, len(scenes))
    return found


def _solved(
    scene: Scene, records: list[Record], damping: Literal["same", "ratio"], threads: int | None
) -> pl.DataFrame:
    """A `Fraction` as a table of one row."""
    one = effective_mass(scene, records, damping=damping, fractions=SHARES, threads=threads)
    low, high = one.interval or (None, None)
    types = {"value": pl.Float64, "kind": pl.String, "low": pl.Float64, "high": pl.Float64, "excess": pl.Float64}
    return pl.DataFrame([Fraction(one.value, one.kind, low, high, one.excess)], schema=types, orient="row")
