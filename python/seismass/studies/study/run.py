"""Running a parametric study: scaling, design, one batch of all models, the tables and what they were made from."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from itertools import chain, count
from typing import Any, ClassVar, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.arguments import ProgressLike
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.folders import ReadFolder
from seismass.base.stored_results import NOTHING_STORED, StoredResults, inputs_digest, metadata_head, motion_contents
from seismass.base.values import FieldValue, FloatArray, as_flag, as_one_of, brief, printable, refusal
from seismass.base.views import view
from seismass.design.scaling import ScalingResult, scale_asce7_10
from seismass.media.result import StoredResult, StoredTable
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene
from seismass.motions.motion import Motion, scaled_motions
from seismass.motions.records import Record, Suite
from seismass.motions.spectra import TargetSpectrum, mean_spectrum, response_spectrum
from seismass.motions.spectra.target import target_remarks
from seismass.runs.batch import solve_many
from seismass.studies.study.parameters import MODELS, StudyBuilding, StudyParameters, code_fractions, study_buildings
from seismass.studies.study.tables import (
    TABLES,
    designs_table,
    effective_fractions,
    findings,
    fractions_table,
    responses_table,
    summary_table,
)

SCHEMA_VERSION: Final = 5
"""Version of the tables and of the metadata that a study gives back; see docs/study_schema.md."""

SPECTRUM_RANGE: Final = (0.05, 3.0)
SPECTRUM_POINTS: Final = 200
"""Periods (s) at which the spectra are tabulated for the figure, and those of the scaling; nothing is interpolated."""


_METHODS: Final = {"ASCE 7-10": "ASCE/SEI 7-10, 16.1.3.1, two-step factors in the logarithm"}
"""Methods of scaling as the metadata name them; others by their own name."""


OWN_TABLES: Final = ("responses", "summary", "fractions", "designs", "spectrum", "scaling")
"""Tables that every study has; sensitivity, claims and validations are there where they were asked for."""


@dataclass(frozen=True, eq=False, repr=False)
class StudyResult(FieldValue, StoredResult):
    """Tables of a study; their columns are described in docs/study_schema.md.

    Its tables are attributes by their names: `responses`, `summary`, `fractions`, `designs`, `spectrum`, and, without
    rows where they were not asked for, `sensitivity` and `claims`.

    Attributes
    ----------
    metadata : dict
        Versions, digest of the inputs, parameters, motions, counts, remarks.
    frames : dict of str to polars.DataFrame
        What `tables` gives: responses, summary, fractions, designs, spectrum, scaling, and others that were made.
    scaling : ScalingResult or None
        Factors of the motions; None where the study was read from its folder, whose table `scaling` has them.
    validation : dict or None
        Motions of the validations of the paper, where they were made.
    animation : dict or None
        What the animation of a page shows, where it was made.
    """

    document: ClassVar[str] = "study"
    schema_version: ClassVar[int] = SCHEMA_VERSION

    metadata: dict[str, Any] = field(repr=False)
    frames: dict[str, pl.DataFrame]
    scaling: ScalingResult | None = None
    validation: dict[str, Any] | None = None
    animation: dict[str, Any] | None = None

    responses = StoredTable()
    summary = StoredTable()
    fractions = StoredTable()
    designs = StoredTable()
    spectrum = StoredTable()
    sensitivity = StoredTable()
    claims = StoredTable()

    @classmethod
    def _without(cls, document: dict[str, Any], files: ReadFolder) -> Collection[str]:
        return [name for name in TABLES if name not in OWN_TABLES and f"{name}.parquet" not in files]

    @classmethod
    def _stored(
        cls, document: dict[str, Any], frames: dict[str, pl.DataFrame], animation: dict[str, Any] | None
    ) -> StudyResult:
        metadata = {key: value for key, value in document.items() if key not in ("findings", "validation")}
        return cls(metadata, frames, validation=document.get("validation"), animation=animation)

    def to_dict(self) -> dict[str, Any]:
        """Return the metadata and the findings as plain values."""
        sentences = findings(self.summary, self.fractions, self.metadata["code"]["name"])
        validation = {} if self.validation is None else {"validation": self.validation}
        return {**self.metadata, "findings": sentences, **validation}

    @property
    @view
    def figure_names(self) -> tuple[str, ...]:
        """spectrum; underestimation, heat, slip and drift_R... for each R and friction; effective, where computed."""
        raise NotImplementedError


def run_study(
    suite: Suite,
    target: TargetSpectrum,
    parameters: StudyParameters | None = None,
    *,
    scaling: ScalingResult | None = None,
    effective: bool = False,
    threads: int | None = None,
    progress: ProgressLike = None,
    store: StoredResults = NOTHING_STORED,
) -> StudyResult:
    """Run the parametric study.

    Parameters
    ----------
    suite : Suite
        Motions, unscaled.
    target : TargetSpectrum
        Design spectrum.
    parameters : StudyParameters, optional
        The grid; default the paper's.
    scaling : ScalingResult, optional
        Factors of the motions, by whatever method; default those of `scale_asce7_10` towards the target.
    effective : bool, default False
        Compute the effective fraction of each building too, with its interval: a hundred times as many runs.
    threads : int, optional
        Number of threads; default all cores. The tables do not depend on it.
    progress : callable, optional
        Called with (analyses done, distinct analyses), then, with `effective`, with (buildings done, distinct ones).
    store : StoredResults, optional
        What an interrupted study of the same inputs has left, and where this one leaves what is done.

    Raises
    ------
    InvalidOption, InvalidMotion
        A parameter is out of its range, or the suite cannot be scaled.
    KeyboardInterrupt
        Ctrl-C was pressed.
    """
    settings = checked_study(suite, target, parameters, store)
    as_flag(effective, "effective", "study", InvalidOption)
    is_stated = scaling is not None
    if scaling is None:
        scaling = scale_asce7_10(
            suite, target, settings.scaling_period, damping=settings.damping, between=False, threads=threads
        )
    else:
        _check_scaling(scaling, len(suite))
    factors = scaling.factors

    def design_spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(suite, factors, periods, settings.damping, threads=threads)

    spectrum = _spectrum(suite, target, scaling, settings.damping, threads)
    buildings = list(study_buildings(settings, design_spectrum))
    records = scaled_motions(suite, factors)
    motions = [record.motion for record in records]
    distinct, run_of, table = _solve(buildings, motions, threads, progress, store)
    names = display_names(suite)
    responses = responses_table(buildings, names, table, run_of)
    fractions = (
        effective_fractions(buildings, records, settings, threads=threads, progress=progress, store=store)
        if effective
        else None
    )
    status = table["status"].value_counts()
    counts = dict(zip(status["status"], status["count"], strict=True))
    return StudyResult(
        frames={
            "responses": responses,
            "summary": summary_table(buildings, responses, names, settings),
            "fractions": fractions_table(buildings, table, run_of, fractions, target),
            "designs": designs_table(buildings, settings),
            "spectrum": spectrum,
            "scaling": scaling.table(),
        },
        scaling=scaling,
        metadata={
            **metadata_head(SCHEMA_VERSION),
            "inputs_sha256": study_digest(suite, target, settings, factors if is_stated else None),
            "parameters": settings.content(),
            "code": _code_metadata(settings),
            "target": {"label": target.label, **target.parameters},
            "suite": _suite_metadata(suite, names, scaling),
            "scaling": _scaling_metadata(scaling),
            "remarks": _remarks(buildings, motions, target, scaling),
            "counts": {
                "buildings": len(buildings),
                "analyses": len(run_of),
                "distinct": distinct,
                "completed": counts.get("completed", 0),
                "collapsed": counts.get("collapsed", 0),
                "failed": counts.get("failed", 0),
            },
        },
    )


def _check_scaling(scaling: Any, motions: int) -> None:
    known = isinstance(scaling, ScalingResult)
    if not known or len(scaling.factors) != motions:
        got = f"one of {len(scaling.factors)}" if known else brief(scaling)
        raise refusal(InvalidOption, "scaling", "study", f"a ScalingResult of {motions} motions", got)


def _solve(
    buildings: list[StudyBuilding],
    motions: list[Motion],
    threads: int | None,
    progress: ProgressLike,
    store: StoredResults,
) -> tuple[int, NDArray[np.int64], pl.DataFrame]:
    """Number of distinct runs, the row of each analysis among them, and the rows."""
    scenes = [building.scenes[model] for building in buildings for model in MODELS]
    scene_numbers = {scene: number for number, scene in enumerate(dict.fromkeys(scenes))}
    motion_numbers = {motion: number for number, motion in enumerate(dict.fromkeys(motions))}
    of_motion = np.array([motion_numbers[motion] for motion in motions])
    of_scene = np.array([scene_numbers[scene] for scene in scenes])
    table = store.of(
        "runs", lambda: solve_many(list(scene_numbers), list(motion_numbers), threads=threads, progress=progress)
    )
    run_of = (of_scene[:, None] * len(motion_numbers) + of_motion[None, :]).ravel()
    return len(table), run_of, table


def _remarks(
    buildings: list[StudyBuilding], motions: list[Motion], target: TargetSpectrum, scaling: ScalingResult
) -> list[str]:
    """What is unlikely about the inputs, each remark once."""
    scenes = dict.fromkeys(building.scenes["real"] for building in buildings)
    remarks = [*target_remarks(target), *scaling.doubts, *motion_remarks(motions)]
    return list(dict.fromkeys([*remarks, *(remark for scene in scenes for remark in scene.remarks)]))


def _code_metadata(settings: StudyParameters) -> dict[str, Any]:
    """Code with its fractions; no code where the occupancies have fractions of their own."""
    if not settings.follows_code:
        return {"id": None, "name": "code", "fractions": {}}
    rows = code_fractions(settings.code)
    return {
        "id": settings.code,
        "name": rows["storage"].code,
        "fractions": {
            name: {"fraction": row.fraction, "clause": row.clause, "status": row.status} for name, row in rows.items()
        },
    }


def _suite_metadata(suite: Suite, names: list[str], scaling: ScalingResult) -> dict[str, Any]:
    return {
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
            for number, (record, name, factor) in enumerate(zip(suite, names, scaling.factors, strict=True), start=1)
        ],
    }


def _scaling_metadata(scaling: ScalingResult) -> dict[str, Any]:
    return {
        "method": _METHODS.get(scaling.method, scaling.method),
        "common_factor": float(scaling.common),
        "periods": [float(scaling.periods[0]), float(scaling.periods[-1]), len(scaling.periods)],
        "governing_period": float(scaling.governing_period),
    }


def checked_study(
    suite: Suite, target: TargetSpectrum, parameters: StudyParameters | None, store: StoredResults
) -> StudyParameters:
    """Return the parameters of a study, by default the paper's, where all four are what they must be."""
    as_one_of(store, StoredResults, "store", "study", InvalidOption)
    as_one_of(suite, Suite, "suite", "study", InvalidMotion)
    as_one_of(target, TargetSpectrum, "target", "study", InvalidOption)
    return as_one_of(
        StudyParameters() if parameters is None else parameters, StudyParameters, "parameters", "study", InvalidOption
    )


def motions_text(suite: dict[str, Any]) -> str:
    """Return how many motions a study has, and of which kind, from the `suite` of its metadata."""
    motions, synthetic = len(suite["motions"]), suite["synthetic"]
    if synthetic == motions:
        return f"{motions} synthetic motions"
    kinds = f", {synthetic} synthetic and {motions - synthetic} recorded" if synthetic else ""
    return f"{motions} motions{kinds}"


def display_names(suite: Suite) -> list[str]:
    """Return event and station of each recording where known, else its name; unique, repeats numbered from 2."""
    names: list[str] = []
    for number, record in enumerate(suite, start=1):
        place = [] if record.synthetic else [part for part in (record.event, record.station) if part]
        name = ", ".join(place) or record.name or f"motion {number}"
        if name in names and place and record.name:
            name = f"{name} ({record.name})"
        numbered = (f"{name} ({repeat})" for repeat in count(2))
        names.append(next(unused for unused in chain([name], numbered) if unused not in names))
    return names


def _spectrum(
    suite: Suite, target: TargetSpectrum, scaling: ScalingResult, damping: float, threads: int | None
) -> pl.DataFrame:
    """Spectra over the usual periods and those of the scaling, as far as target and motions have them."""
    shortest_of_motions = _kernel.SHORTEST_PERIOD_OVER_STEP * max(record.dt for record in suite)
    shortest = max(min(SPECTRUM_RANGE[0], scaling.periods[0]), target.shortest, shortest_of_motions)
    longest = min(max(SPECTRUM_RANGE[1], scaling.periods[-1]), target.longest)
    periods = np.geomspace(shortest, longest, SPECTRUM_POINTS)
    scaled = scaling.factors[:, None] * response_spectrum(suite, periods, damping, threads=threads)
    motions = {f"motion_{number}": row for number, row in enumerate(scaled, start=1)}
    return pl.DataFrame({"period": periods, "target": target(periods), "mean": scaled.mean(axis=0), **motions})


def study_digest(
    suite: Suite, target: TargetSpectrum, parameters: StudyParameters, factors: FloatArray | None = None
) -> str:
    """Return the digest of all that the numbers depend on: samples, target, parameters, factors where given."""
    return inputs_digest(SCHEMA_VERSION, motion_contents(suite), target.parameters, parameters.content(), factors)


SLIDES: Final = 0.01
"""Mean peak slip (m) of goods that are seen to slide."""


@dataclass(frozen=True, eq=False)
class Example:
    """A building of a study with its sliding goods under one of its motions: key columns, scaled record, and the name
    of the motion in the study.
    """

    labels: dict[str, Any]
    scene: Scene
    record: Record
    name: str


def study_example(suite: Suite, parameters: StudyParameters, result: StudyResult) -> Example | None:
    """Return the building of largest first-storey underestimation whose first-floor goods slide by `SLIDES` on average
    (or of all), and the motion closest to that of the means; None where no run has a result.
    """
    first = result.summary.filter(storey=1).drop_nulls("underestimation_percent")
    slides = first.filter((pl.col("mean_peak_slip") >= SLIDES) & (pl.col("R") > 1.0))
    ranked = (slides if slides.height else first).sort("underestimation_percent", descending=True)
    if not ranked.height:
        return None
    row = ranked.row(0, named=True)
    runs = result.responses.filter(building=row["building"], storey=1).sort("motion")
    sliding, code = (runs.filter(model=model)["peak_drift"].to_numpy() for model in ("real", "code"))
    motion = int(np.argmin(np.abs(np.log(sliding / code) - np.log(row["ratio"]))))
    factors = result.tables["scaling"]["factor"].to_numpy()

    def spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(suite, factors, periods, parameters.damping)

    building = list(study_buildings(parameters, spectrum))[row["building"] - 1]
    name = result.metadata["suite"]["motions"][motion]["record"]
    return Example(building.labels, building.scenes["real"], suite[motion].scaled(float(factors[motion])), name)
