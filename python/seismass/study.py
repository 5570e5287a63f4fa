"""The parametric study of the 16WCEE paper, section 5: drift with sliding live load against drift by the ASCE 7 rule.

Each building is solved twice under each motion: as it is, with rigid blocks that may slide ("real"), and as the
standard models it, with the fraction lambda of the blocks' mass attached and no block ("asce").
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field
from itertools import chain, count, product
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl

from seismass import _kernel
from seismass._values import FloatArray, as_count, as_number, brief, printable, refusal
from seismass.batch import simulate_many
from seismass.design import Combination, SpectrumAnalysis, response_spectrum_analysis
from seismass.errors import InvalidMotion, InvalidOption
from seismass.records import Suite
from seismass.scaling import ScalingResult, scale_asce7_10
from seismass.scene import (
    DEFAULT_DAMPING,
    DEFAULT_OVERSTRENGTH,
    DEFAULT_SECOND_SLOPE,
    DEFAULT_THIRD_SLOPE,
    Building,
    Scene,
    blocks_on_floors,
)
from seismass.simulate import instruction_set
from seismass.spectra import TargetSpectrum, mean_spectrum, response_spectrum
from seismass.units import STANDARD_GRAVITY

SCHEMA_VERSION: Final = 1
"""Version of the tables and of the metadata that a study gives back; see docs/study_schema.md."""

Model: TypeAlias = Literal["real", "asce"]
MODELS: Final = get_args(Model)

SPECTRUM_RANGE: Final = (0.05, 3.0)
SPECTRUM_POINTS: Final = 200
"""Periods (s) at which the spectra are tabulated for the figure, and those of the scaling; nothing is interpolated."""

_LISTED: Final = "a tuple of at least one value, none twice"


@dataclass(frozen=True)
class StudyParameters:
    """What is varied and what is fixed; the defaults are the paper's, or inferred where it says nothing.

    Attributes
    ----------
    buildings : tuple of (int, float)
        Number of storeys and first period of the bare building (s).
    response_modification : tuple of float
        Factors R; V_y = V_e/R. R = 1 is elastic unless `yield_at_r1`.
    mass_ratios : tuple of float
        Block mass over floor mass, alpha, the same on every floor but the roof, which is bare.
    occupancies : tuple of (str, float)
        Name, no two the same, and fraction lambda of the block mass that the standard counts in design and analysis.
    mu : float
        Friction coefficient, static and kinetic.
    overstrength, second_slope, third_slope : float
        Omega, r2, r3 of the storeys. The paper states none of them for its study: Omega is that of its section 4,
        r2 = 0.05 and r3 = 0 are inferred.
    damping : float
        Ratio of critical in every mode: of the bare building in the real model, of the building with its share of the
        live load in the ASCE model. Also that of the spectra.
    scaling_period : float
        Fundamental period T (s) for which motions are scaled, from 0.2 T to 1.5 T.
    combination : {"srss", "cqc"}
        Modal combination of the response spectrum analysis.
    yield_at_r1 : bool
        Let R = 1 yield at V_e.

    Raises
    ------
    InvalidOption
        A parameter is out of its range or of another kind.
    """

    buildings: tuple[tuple[int, float], ...] = ((2, 0.38), (3, 0.47), (4, 0.57))
    response_modification: tuple[float, ...] = (1.0, 2.0, 4.0, 6.0)
    mass_ratios: tuple[float, ...] = (0.5, 1.0, 1.5)
    occupancies: tuple[tuple[str, float], ...] = (("storage", 0.25), ("commercial", 0.0))
    mu: float = 0.4
    overstrength: float = DEFAULT_OVERSTRENGTH
    second_slope: float = DEFAULT_SECOND_SLOPE
    third_slope: float = DEFAULT_THIRD_SLOPE
    damping: float = DEFAULT_DAMPING
    scaling_period: float = 1.0
    combination: Combination = "srss"
    yield_at_r1: bool = False

    def __post_init__(self) -> None:
        """Keep numbers as Python's own, so that equal parameters have the same digest."""
        tiny, huge = np.nextafter(0.0, 1.0), np.finfo(np.float64).max

        def within(name: str, value: Any, low: float, high: float, requirement: str) -> float:
            number = as_number(value, name, "study", InvalidOption)
            if not low <= number <= high:
                raise refusal(InvalidOption, name, "study", requirement, f"{number:g}")
            return number

        def listed(name: str) -> tuple[Any, ...]:
            values = getattr(self, name)
            if not isinstance(values, tuple) or not values:
                raise refusal(InvalidOption, name, "study", _LISTED, brief(values))
            return values

        def pairs(name: str, of: str) -> tuple[tuple[Any, Any], ...]:
            for pair in listed(name):
                if not isinstance(pair, tuple) or len(pair) != 2:
                    raise refusal(InvalidOption, name, "study", f"a tuple of pairs {of}", f"{brief(pair)} in it")
            return listed(name)

        def unique(name: str, keys: list[Any]) -> None:
            if len(set(keys)) != len(keys):
                raise refusal(InvalidOption, name, "study", _LISTED, brief(getattr(self, name)))

        buildings = [
            (
                as_count(storeys, "storeys", "study", InvalidOption, least=1),
                within("period", period, tiny, huge, "a positive number"),
            )
            for storeys, period in pairs("buildings", "(storeys, period)")
        ]
        factors = [
            within("response_modification", value, 1.0, huge, "at least 1") for value in listed("response_modification")
        ]
        ratios = [within("mass_ratios", value, tiny, huge, "positive") for value in listed("mass_ratios")]
        occupancies = []
        for name, fraction in pairs("occupancies", "(name, lambda)"):
            if not isinstance(name, str):
                raise refusal(InvalidOption, "occupancy name", "study", "a string", brief(name))
            occupancies.append((name, within("lambda", fraction, 0.0, 1.0, "between 0 and 1")))
        unique("buildings", buildings)
        unique("response_modification", factors)
        unique("mass_ratios", ratios)
        unique("occupancies", [name for name, _ in occupancies])
        second_slope = within("second_slope", self.second_slope, 0.0, 1.0, "between 0 and 1")
        checked = {
            "buildings": tuple(buildings),
            "response_modification": tuple(factors),
            "mass_ratios": tuple(ratios),
            "occupancies": tuple(occupancies),
            "mu": within("mu", self.mu, 0.0, huge, "zero or positive"),
            "overstrength": within("overstrength", self.overstrength, 1.0, huge, "a number of at least 1"),
            "second_slope": second_slope,
            "third_slope": within("third_slope", self.third_slope, 0.0, second_slope, "between 0 and the second slope"),
            "damping": within("damping", self.damping, tiny, np.nextafter(1.0, 0.0), "above 0 and below 1"),
            "scaling_period": within("scaling_period", self.scaling_period, tiny, huge, "a positive number"),
        }
        if self.combination not in get_args(Combination):
            raise refusal(InvalidOption, "combination", "study", "srss or cqc", brief(self.combination))
        if not isinstance(self.yield_at_r1, bool):
            raise refusal(InvalidOption, "yield_at_r1", "study", "True or False", brief(self.yield_at_r1))
        for name, value in checked.items():
            object.__setattr__(self, name, value)


@dataclass(frozen=True, eq=False)
class StudyBuilding:
    """One building of the grid with its two models.

    Attributes
    ----------
    labels : dict
        building (number from 1), occupancy, lambda, storeys, period, R, alpha: the key columns of the tables.
    analysis : SpectrumAnalysis
        Response spectrum analysis of the design model, with V_e.
    yield_shear : ndarray, shape (storeys,)
        V_y (N, for floor masses of 1 kg); infinite where the building stays elastic.
    scenes : dict of Model to Scene
        The real model and the ASCE model.
    """

    labels: dict[str, Any]
    analysis: SpectrumAnalysis
    yield_shear: FloatArray
    scenes: dict[Model, Scene]


@dataclass(frozen=True, eq=False)
class StudyResult:
    """Tables of a study; their columns are described in docs/study_schema.md.

    Attributes
    ----------
    responses : polars.DataFrame
        One row per building, model, motion and storey.
    summary : polars.DataFrame
        One row per building and storey: means over the motions, their ratio, the underestimation.
    designs : polars.DataFrame
        One row per building and storey: masses, V_e, V_y, periods.
    spectrum : polars.DataFrame
        Target, mean scaled and scaled spectra.
    scaling : ScalingResult
        Factors of the motions.
    metadata : dict
        Versions, digest of the inputs, parameters, motions, counts.
    """

    responses: pl.DataFrame
    summary: pl.DataFrame
    designs: pl.DataFrame
    spectrum: pl.DataFrame
    scaling: ScalingResult
    metadata: dict[str, Any] = field(repr=False)


def study_buildings(
    parameters: StudyParameters, spectrum: Callable[[FloatArray], FloatArray]
) -> Iterator[StudyBuilding]:
    """Yield the buildings of the grid, designed for a pseudo-acceleration spectrum (m/s2 at periods in s).

    Floor masses are 1 kg, stated so that strengths may be forces: drifts do not depend on them. Strengths come from the
    model that the standard prescribes, the building with the share lambda alpha of its floor mass attached to every
    floor but the roof.
    """
    analyses: dict[tuple[int, float, float], SpectrumAnalysis] = {}
    grid = product(
        parameters.occupancies, parameters.buildings, parameters.response_modification, parameters.mass_ratios
    )
    for number, ((occupancy, fraction), (storeys, period), reduction, ratio) in enumerate(grid, start=1):
        ratios = np.append(np.full(storeys - 1, ratio), 0.0)
        bare = Building.uniform(
            storeys,
            period,
            mass=1.0,
            overstrength=parameters.overstrength,
            second_slope=parameters.second_slope,
            third_slope=parameters.third_slope,
            damping=parameters.damping,
        )
        mass = bare.mass + fraction * ratios
        key = (storeys, period, fraction * ratio)
        if key not in analyses:
            analyses[key] = response_spectrum_analysis(
                mass, bare.stiffness, spectrum, combination=parameters.combination, damping=parameters.damping
            )
        analysis = analyses[key]
        elastic = reduction == 1.0 and not parameters.yield_at_r1
        yield_shear = np.full(storeys, np.inf) if elastic else analysis.storey_shear / reduction
        building: Building = bare.replace(yield_shear=yield_shear)
        yield StudyBuilding(
            labels={
                "building": number,
                "occupancy": occupancy,
                "lambda": fraction,
                "storeys": storeys,
                "period": period,
                "R": reduction,
                "alpha": ratio,
            },
            analysis=analysis,
            yield_shear=building.yield_shear,
            scenes={
                "real": Scene(building, blocks_on_floors(ratios, parameters.mu)),
                "asce": Scene(building.replace(mass=mass)),
            },
        )


def run_study(
    suite: Suite,
    target: TargetSpectrum,
    parameters: StudyParameters | None = None,
    *,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> StudyResult:
    """Run the parametric study.

    Parameters
    ----------
    suite : Suite
        Motions, unscaled; they are scaled to the target by `scale_asce7_10`.
    target : TargetSpectrum
        Design spectrum.
    parameters : StudyParameters, optional
        The grid; default the paper's.
    threads : int, optional
        Number of threads; default all cores. The tables do not depend on it.
    progress : callable, optional
        Called with (analyses done, distinct analyses).

    Raises
    ------
    InvalidOption, InvalidMotion
        A parameter is out of its range, or the suite cannot be scaled.
    KeyboardInterrupt
        Ctrl-C was pressed.
    """
    chosen = StudyParameters() if parameters is None else parameters
    if not isinstance(suite, Suite):
        raise refusal(InvalidMotion, "suite", "study", "a Suite of records", brief(suite))
    scaling = scale_asce7_10(suite, target, chosen.scaling_period, damping=chosen.damping, threads=threads)

    def design_spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(suite, scaling.factors, periods, chosen.damping, threads=threads)

    spectrum = _spectrum(suite, target, scaling, chosen.damping, threads)
    buildings = list(study_buildings(chosen, design_spectrum))
    motions = [record.scaled(factor).motion for record, factor in zip(suite, scaling.factors, strict=True)]
    runs = [(building.scenes[model], motion) for building in buildings for model in MODELS for motion in motions]
    scene_numbers = {scene: number for number, scene in enumerate(dict.fromkeys(scene for scene, _ in runs), start=1)}
    motion_numbers = {motion: number for number, motion in enumerate(dict.fromkeys(motions), start=1)}
    pairs = [(scene_numbers[scene], motion_numbers[motion]) for scene, motion in runs]
    distinct = {pair: number for number, pair in enumerate(dict.fromkeys(pairs))}
    table = simulate_many(
        list(scene_numbers), list(motion_numbers), pairs=list(distinct), threads=threads, progress=progress
    )
    names = _display_names(suite)
    responses = _responses(buildings, names, table, [distinct[pair] for pair in pairs])
    status = table["status"].value_counts()
    counts = dict(zip(status["status"], status["count"], strict=True))
    return StudyResult(
        responses=responses,
        summary=_summary(responses),
        designs=_designs(buildings),
        spectrum=spectrum,
        scaling=scaling,
        metadata={
            "schema_version": SCHEMA_VERSION,
            "package_version": _kernel.VERSION,
            "instructions": instruction_set(),
            "inputs_sha256": _digest(suite, target, chosen),
            "parameters": asdict(chosen),
            "target": {"label": target.label, **target.parameters},
            "suite": {
                "name": suite.name,
                "synthetic": sum(record.synthetic for record in suite),
                "motions": [
                    {
                        "motion": number,
                        "record": name,
                        "file": None if record.source is None else printable(record.source.name),
                        "synthetic": record.synthetic,
                        "samples": record.samples,
                        "dt": record.dt,
                        "pga_g": record.pga_g,
                        "factor": float(factor),
                        "remarks": list(record.remarks),
                    }
                    for number, (record, name, factor) in enumerate(
                        zip(suite, names, scaling.factors, strict=True), start=1
                    )
                ],
            },
            "counts": {
                "buildings": len(buildings),
                "analyses": len(pairs),
                "distinct": len(distinct),
                "completed": counts.get("completed", 0),
                "collapsed": counts.get("collapsed", 0),
                "failed": counts.get("failed", 0),
            },
        },
    )


def motions_text(suite: dict[str, Any]) -> str:
    """Return how many motions a study has, and of which kind, from the `suite` of its metadata."""
    motions, synthetic = len(suite["motions"]), suite["synthetic"]
    if synthetic == motions:
        return f"{motions} synthetic motions"
    kinds = f", {synthetic} synthetic and {motions - synthetic} recorded" if synthetic else ""
    return f"{motions} motions{kinds}"


def _display_names(suite: Suite) -> list[str]:
    """Event and station of a recording where known, else the name of the record; unique, repeats numbered from 2."""
    names: list[str] = []
    for number, record in enumerate(suite, start=1):
        place = [] if record.synthetic else [part for part in (record.event, record.station) if part]
        name = ", ".join(place) or record.name or f"motion {number}"
        if name in names and place and record.name:
            name = f"{name} ({record.name})"
        numbered = (f"{name} ({repeat})" for repeat in count(2))
        names.append(next(unused for unused in chain([name], numbered) if unused not in names))
    return names


_KEYS: Final = ("building", "occupancy", "lambda", "storeys", "period", "R", "alpha")
_RESPONSE_SCHEMA: Final = {
    "building": pl.UInt32,
    "occupancy": pl.String,
    "lambda": pl.Float64,
    "storeys": pl.UInt32,
    "period": pl.Float64,
    "R": pl.Float64,
    "alpha": pl.Float64,
    "model": pl.String,
    "motion": pl.UInt32,
    "record": pl.String,
    "storey": pl.UInt32,
    "status": pl.String,
    "reason": pl.String,
    "run": pl.UInt32,
    "peak_drift": pl.Float64,
    "peak_drift_time": pl.Float64,
    "residual_drift": pl.Float64,
    "peak_shear_over_weight": pl.Float64,
    "peak_floor_acceleration": pl.Float64,
    "peak_slip": pl.Float64,
    "residual_slip": pl.Float64,
    "slip_path": pl.Float64,
}


def _responses(
    buildings: list[StudyBuilding], names: list[str], table: pl.DataFrame, run_of: list[int]
) -> pl.DataFrame:
    """One row per building, model, motion and storey; `run_of` gives the row of `table` of each analysis."""
    results = table.to_dicts()
    runs = iter(run_of)
    rows = []
    for building in buildings:
        labels = [building.labels[key] for key in _KEYS]
        storeys = building.labels["storeys"]
        weight = STANDARD_GRAVITY * storeys
        for model in MODELS:
            block_of = {floor: index for index, floor in enumerate(building.scenes[model].block_floor)}
            for motion, name in enumerate(names, start=1):
                run = next(runs)
                result = results[run]
                for storey in range(1, storeys + 1):

                    def of(column: str, index: int | None, values: dict[str, Any] = result) -> float | None:
                        listed = values[column]
                        return None if listed is None or index is None else listed[index]

                    block = block_of.get(storey)
                    shear = of("peak_storey_shear", storey - 1)
                    rows.append(
                        (
                            *labels,
                            model,
                            motion,
                            name,
                            storey,
                            result["status"],
                            result["reason"],
                            run,
                            of("peak_drift", storey - 1),
                            of("peak_drift_time", storey - 1),
                            of("residual_drift", storey - 1),
                            None if shear is None else shear / weight,
                            of("peak_floor_acceleration", storey - 1),
                            of("peak_slip", block),
                            of("residual_slip", block),
                            of("slip_path", block),
                        )
                    )
    return pl.DataFrame(rows, schema=_RESPONSE_SCHEMA, orient="row")


def _summary(responses: pl.DataFrame) -> pl.DataFrame:
    """Means over the motions; null where a run of the building failed, so that no mean is of fewer motions."""

    def mean(model: Model, column: str) -> pl.Expr:
        values = pl.col(column).filter(pl.col("model") == model)
        return pl.when(values.null_count() == 0).then(values.mean())

    return (
        responses.group_by([*_KEYS, "storey"], maintain_order=True)
        .agg(
            pl.col("motion").n_unique().cast(pl.UInt32).alias("motions"),
            mean("real", "peak_drift").alias("mean_peak_drift_real"),
            mean("asce", "peak_drift").alias("mean_peak_drift_asce"),
            mean("real", "peak_slip").alias("mean_peak_slip"),
        )
        .with_columns((pl.col("mean_peak_drift_real") / pl.col("mean_peak_drift_asce")).alias("ratio"))
        .with_columns((100.0 * (pl.col("ratio") - 1.0)).alias("underestimation_percent"))
        .sort("building", "storey")
    )


def _designs(buildings: list[StudyBuilding]) -> pl.DataFrame:
    rows = []
    for building in buildings:
        weight = STANDARD_GRAVITY * building.labels["storeys"]
        asce = building.scenes["asce"].building
        design_mass = None if asce is None else asce.mass
        for index, elastic_shear in enumerate(building.analysis.storey_shear):
            strength = building.yield_shear[index]
            rows.append(
                {
                    **building.labels,
                    "storey": index + 1,
                    "design_mass_ratio": None if design_mass is None else design_mass[index],
                    "design_period": building.analysis.modes.periods[index],
                    "spectral_acceleration": building.analysis.ordinates[index],
                    "elastic_shear_over_weight": elastic_shear / weight,
                    "yield_shear_over_weight": strength / weight if np.isfinite(strength) else None,
                }
            )
    integers = {"building": pl.UInt32, "storeys": pl.UInt32, "storey": pl.UInt32}
    return pl.DataFrame(rows, schema_overrides={**integers, "yield_shear_over_weight": pl.Float64})


def _spectrum(
    suite: Suite, target: TargetSpectrum, scaling: ScalingResult, damping: float, threads: int | None
) -> pl.DataFrame:
    """Spectra over the usual periods and those of the scaling, as far as target and motions have them."""
    shortest = max(
        min(SPECTRUM_RANGE[0], scaling.periods[0]), target.shortest, 1e-3 * max(record.dt for record in suite)
    )
    longest = min(max(SPECTRUM_RANGE[1], scaling.periods[-1]), target.longest)
    periods = np.geomspace(shortest, longest, SPECTRUM_POINTS)
    scaled = scaling.factors[:, None] * response_spectrum(suite, periods, damping, threads=threads)
    motions = {f"motion_{number}": row for number, row in enumerate(scaled, start=1)}
    return pl.DataFrame({"period": periods, "target": target(periods), "mean": scaled.mean(axis=0), **motions})


def _digest(suite: Suite, target: TargetSpectrum, parameters: StudyParameters) -> str:
    """SHA-256 of everything that the numbers depend on: samples, target, parameters."""
    digest = hashlib.sha256()
    digest.update(json.dumps([SCHEMA_VERSION, target.parameters, asdict(parameters)], sort_keys=True).encode())
    for record in suite:
        digest.update(np.float64(record.dt).tobytes())
        digest.update(np.ascontiguousarray(record.acceleration, dtype="<f8").tobytes())
        if record.vertical is not None:
            digest.update(b"vertical")
            digest.update(np.ascontiguousarray(record.vertical, dtype="<f8").tobytes())
    return digest.hexdigest()
