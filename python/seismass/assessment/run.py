"""Runs an assessment: scaling, effective fractions at the bounds of friction, the models that are compared."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from seismass.assessment.advice import advice_of, assumptions_of, remarks_of
from seismass.assessment.answer import (
    ANALYSIS,
    advised_share,
    analysis_table,
    answer_of,
    deciding,
    design_share,
    design_shares,
    fractions_by_friction,
)
from seismass.assessment.building import OwnBuilding, with_code
from seismass.assessment.building_file import read_building
from seismass.assessment.checks import (
    checked_storeys,
    collapses_of,
    governing_table,
    left_out_table,
    other_models,
    slip_table,
    tipping_table,
)
from seismass.assessment.doubts import doubts_of, motion_doubts
from seismass.assessment.file_parts import spectra_table
from seismass.assessment.models import (
    ADVISED,
    BARE,
    SLIDING,
    Shown,
    compared_models,
    friction_factors,
    motion_of_runs,
    period_sentences,
    scaled_to_site,
    solve_models,
)
from seismass.assessment.result import SCHEMA_VERSION, Assessment, Solved, assessment_of
from seismass.assessment.statement import PresentGoods, governing_drifts, other_amounts, present_goods
from seismass.base.arguments import Progress, ProgressLike
from seismass.base.errors import InvalidMotion, InvalidOption, InvalidScene
from seismass.base.files import without_formulas
from seismass.base.statistics import bootstrap_counts, few_collapses
from seismass.base.stored_results import metadata_head, motion_contents
from seismass.base.values import FloatArray, brief, refusal
from seismass.design.scaling import ScalingResult
from seismass.effective_mass.models import DEFAULT_FRACTIONS, SHARES_BEYOND, check_cap, goes_beyond
from seismass.model.codes import CodeFraction
from seismass.model.friction import bound_factors
from seismass.motions.motion import motion_names, scaled_motions
from seismass.motions.records import Pair, Pairs, Record, Suite, builtin_pairs, builtin_suite
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.batch import EngineRuns
from seismass.runs.peak_digits import chaos_remarks
from seismass.runs.peaks import named_motions

FIXED_MODELS: Final = 4
"""Models that every assessment with goods solves beside those with goods that slide."""


def assess(
    building: OwnBuilding | str | os.PathLike[str] | Mapping[str, Any],
    motions: Suite | Pairs | Iterable[Any] | None = None,
    target: TargetSpectrum | None = None,
    *,
    code: CodeFraction | None = None,
    mu_factors: tuple[float, float] | None = None,
    drift_cap: float | None = None,
    scaling_period: float | None = None,
    scale: bool = True,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> Assessment:
    """Assess a building with its goods: the share of the live load to count as mass, drifts and slips.

    Parameters
    ----------
    building : OwnBuilding, path-like or mapping
        The building, or its file or tables as `read_building` takes them.
    motions : Suite, Pairs or iterable of Record, Motion or Pair, optional
        Motions, unscaled; at least three. Default the forty built-in motions, of which none was recorded. A building
        with two directions takes pairs, by default the forty with their second components.
    target : TargetSpectrum, optional
        Site spectrum; default that of the building.
    code : CodeFraction, optional
        In place of the building's code with its rules, as `code_fraction` gives it.
    mu_factors : tuple of float, optional
        In place of the building's factors of friction for its lower and upper bound; (1, 1) leaves the bounds out.
    drift_cap : float, optional
        In place of the building's drift cap, over the storey height; see `effective_mass`.
    scaling_period : float, optional
        Period T (s) for which motions are scaled by the rule of the code (`scale_by_code`); default that of the
        building file, else the first period of the building with the goods present attached.
    scale : bool, default True
        False takes the motions as they are. Pairs are scaled by one factor for both components.
    confidence, resamples, seed
        Of the bootstrap interval, as for `effective_mass`.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.
    progress : callable, optional
        Called with (runs done, runs in all).

    Raises
    ------
    InvalidBuildingFile, InvalidScene, InvalidMotion, InvalidOption, RecordFormatError
        An argument is not what it must be; a building without a site spectrum among them.
    SimulationError
        A run could not be carried to its end.
    KeyboardInterrupt
        Ctrl-C was pressed.

    Notes
    -----
    Models: goods that slide ("real", and "real_mu_low" and "real_mu_high" at the bounds of friction), the advised share
    attached ("advised"), the code's fraction of the design live load attached ("code"), all goods present attached
    ("attached"), none ("bare"). All have the stiffness, strength, damping matrix and gravity load of the real building.

    Examples
    --------
    >>> import seismass as sm
    >>> result = sm.assess({
    ...     "site": {"sds_g": 1.0, "sd1_g": 0.6},
    ...     "building": {"period_s": 0.4, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 3},
    ...     "goods": {"live_load_kpa": 6, "friction": "timber-on-steel"},
    ...     "storeys": [{}, {"live_load_kpa": 0}],
    ... }, resamples=100)
    >>> result.storeys["model"].unique(maintain_order=True).to_list()
    ['real', 'real_mu_low', 'real_mu_high', 'advised', 'code', 'attached', 'bare']
    """
    stated = _building(building, code, mu_factors)
    if drift_cap is not None:
        if stated.heights is None:
            raise refusal(InvalidOption, "drift_cap", "assessment", "left out without storey heights", brief(drift_cap))
        stated = replace(stated, drift_cap=check_cap(drift_cap, "assessment"))
    in_plane = stated.other is not None
    suite = _suite((builtin_pairs() if in_plane else builtin_suite("forty")) if motions is None else motions, in_plane)
    spectrum = stated.site_spectrum(target) if scale or stated.design is not None else None
    scaling = scaled_to_site(stated, suite, spectrum, scaling_period, threads=threads) if scale else None
    factors = _factors(suite, scaling)
    scaled = scaled_motions(suite, factors)
    loaded = bool((stated.goods_mass > 0.0).any())
    frictions = friction_factors(stated.mu_factors) if loaded else {}
    models = len(frictions) + FIXED_MODELS if loaded else 1
    fractions = len(frictions) + len(DEFAULT_FRACTIONS) if loaded else 0
    designs = 2 * len(design_shares(stated)) if loaded and stated.design is not None else 0
    larger = len(SHARES_BEYOND) if loaded and goes_beyond(stated.scene(spectrum)) else 0
    floors, others = other_amounts(stated)
    models_of_tipping = other_models(stated)
    of_amount = len(frictions) + len(DEFAULT_FRACTIONS) + larger
    runs_of_motion = models + fractions + larger + designs + (len(others) + len(models_of_tipping)) * of_amount
    stages = Progress(progress, runs_of_motion * len(suite), "assessment")
    bootstrap = {"confidence": confidence, "resamples": resamples, "seed": seed}
    whole_runs: list[EngineRuns] = []
    tell = stages.part((fractions + larger) * len(suite))
    effective = fractions_by_friction(stated, spectrum, frictions, scaled, bootstrap, threads, tell, whole_runs)
    advised = advised_share(effective)
    design = None
    if designs and advised is not None:
        factor = frictions[deciding(effective)]
        design = design_share(stated, spectrum, factor, scaled, threads, stages.part(designs * len(suite)))
    scenes = compared_models(stated, spectrum, advised)

    def amount(floors: str, case: OwnBuilding) -> PresentGoods:
        """The answer for another amount of goods, with motions scaled for it."""
        tell = stages.part(of_amount * len(suite))
        try:
            own_scaling = scaled_to_site(case, suite, spectrum, scaling_period, threads=threads) if scale else None
            motions = scaled_motions(suite, _factors(suite, own_scaling))
            how = (motions, {**bootstrap, "resamples": 1}, threads, tell)
            effective = fractions_by_friction(case, spectrum, frictions, *how)
        except (InvalidScene, InvalidOption) as error:  # P-Delta or the site spectrum may not allow so much
            return PresentGoods(floors, case.present_share, reason=f"{error}")
        share = advised_share(effective)
        if share is not None:
            return present_goods(floors, case, share, governing_drifts(effective, share))
        worst = max(each.collapses["real"] for each in effective.values())
        why = f"the building with goods that slide collapses under {worst} of {len(suite)} motions"
        return PresentGoods(floors, case.present_share, reason=why)

    further = [] if advised is None else [amount(name, case) for name, case in others.items()]
    of_models = [] if advised is None else [amount(name, case) for name, case in models_of_tipping.items()]
    names = motion_names(suite)
    components = [record for motion in scaled for record in (tuple(motion) if in_plane else (motion,))]
    horizontal = [record for motion in scaled for record in (tuple(motion)[:2] if in_plane else (motion,))]
    known, tell = whole_runs[0] if whole_runs else None, stages.part(models * len(suite))
    runs, slips = solve_models(stated, scenes, scaled, names, threads=threads, progress=tell, known=known)
    sliding_scene = stated.scene(spectrum)
    drawn = named_motions(scaled, "assessment", sliding_scene)
    counts = bootstrap_counts(drawn.cluster_of, resamples, seed) if loaded and drawn.clusters > 1 else None
    slip = slip_table(stated, slips, counts, confidence)
    storeys, collapses = checked_storeys(stated, sliding_scene, runs), collapses_of(runs)
    governing = governing_table(stated, storeys)
    drifts = governing["governing"].to_numpy()  # null is NaN
    amounts = () if advised is None else (present_goods(floors, stated, advised, drifts), *further)
    place = motion_of_runs(runs)
    facts = {
        "name": suite.name if isinstance(suite, Suite | Pairs) else "motions",
        "motions": names,
        "pairs": in_plane,
        "synthetic": sum(_is_synthetic(motion) for motion in suite),
    }
    period = period_sentences(stated, spectrum, scaled)
    about_motions = {"record": names, "factor": factors}
    left_out = left_out_table(stated, runs, effective, {**about_motions, **ground_peaks(scaled)})
    doubts = (
        *doubts_of(stated, sliding_scene, scaled, spectrum, storeys),
        *motion_doubts(left_out, effective, stated.shown),
    )
    tables = (storeys, governing, runs, left_out, collapses, slip, amounts)
    tipping = tipping_table(stated, sliding_scene, scaled)

    def remedy() -> str:
        return "" if in_plane else _remedy(stated, spectrum, scaled, names, threads)

    cases = (tipping, tuple(of_models))
    answer = answer_of(stated, advised, effective, design, *tables, cases, facts, scaling, doubts, remedy)
    spectra = spectra_table(
        scaled if scaling is not None else horizontal,
        None if spectrum is None else stated.motion_target(spectrum),
        stated.pairs_as if scaling is not None else "geometric mean",
        threads=threads,
    )
    chaotic = chaos_remarks([scenes[name] for name in frictions], scaled) if loaded else ()
    slides = bool((runs["peak_slip"] > 0.0).any())
    example = Shown(sliding_scene, scaled[place], place + 1, float(factors[place]), slides)
    contents = (scenes, stated, None if spectrum is None else spectrum.parameters, motion_contents(components))
    return assessment_of(
        Solved(stated, spectrum, None if design is None else design.effective, scaling, example),
        answer,
        effective,
        {
            "storeys": storeys,
            "governing": governing,
            "slip": slip,
            "tipping": tipping,
            "slips": slips,
            "runs": runs,
            "left_out": left_out,
            "spectra": spectra,
        },
        collapses=collapses,
        suite=facts,
        advice=advice_of(stated, answer, storeys, slip, collapses, len(suite), effective.get(SLIDING), runs),
        remarks=(*remarks_of(stated, doubts, scaling, effective, facts), *chaotic),
        assumptions=assumptions_of(stated, spectrum, scaling, facts, period),
        metadata={
            **metadata_head(SCHEMA_VERSION, *contents, bootstrap),
            **bootstrap,
            "damping": "matrix of the building without goods, in every model",
            "p_delta": stated.gravity_load is not None,
            "motions": len(suite),
        },
    )


STRONGER: Final = (1.25, 1.5, 2.0, 3.0)
"""Factors of the strengths that are tried where runs collapse."""


def _remedy(
    building: OwnBuilding, target: TargetSpectrum | None, motions: list[Any], names: list[str], threads: int | None
) -> str:
    """The least of a few factors of the strengths with which few enough runs of every model collapse."""
    tried = [factor for factor in STRONGER if building.design is None or factor <= building.design.R]
    for factor in tried:
        changes: dict[str, Any] = {}
        if building.design is not None:
            changes["design"] = replace(building.design, R=building.design.R / factor)
        if building.yield_shear is not None:
            changes["yield_shear"] = factor * building.yield_shear
        stronger = replace(building, **changes)
        runs, _ = solve_models(stronger, compared_models(stronger, target, None), motions, names, threads=threads)
        worst = max(collapses_of(runs).values())
        if few_collapses(worst, len(motions)):
            how = "" if stronger.design is None else f", R = {stronger.design.R:.3g},"
            fallen = (
                f"models collapse under at most {worst} of {len(motions)} motions" if worst else "no model collapses"
            )
            return f"With strengths {factor:g} times as large{how} there is an answer: {fallen}"
    return f"Strengths {tried[-1]:g} times as large give no answer either" if tried else ""


def _building(source: Any, code: CodeFraction | None, mu_factors: tuple[float, float] | None) -> OwnBuilding:
    building = source if isinstance(source, OwnBuilding) else read_building(source)
    if code is not None:
        if not isinstance(code, CodeFraction):
            raise refusal(InvalidOption, "code", "assessment", "a CodeFraction, as code_fraction gives it", brief(code))
        building = with_code(building, code)
    if mu_factors is not None:
        building = replace(building, mu_factors=bound_factors(mu_factors, "assessment"))
    return building


def _suite(motions: Any, in_plane: bool) -> Any:
    """Motions as a sequence; each has samples and can be scaled."""
    suite: Any = motions
    kinds = "Pairs" if in_plane else "Records or Motions"
    if not isinstance(motions, Suite | Pairs):
        if hasattr(motions, "acceleration") or isinstance(motions, Pair):
            motions = [motions]
        try:
            suite = list(motions)
        except TypeError:
            raise refusal(InvalidMotion, "motions", "assessment", f"a list of {kinds}", brief(motions)) from None
    if not len(suite):
        least = "Pair" if in_plane else "Record or Motion"
        raise refusal(InvalidMotion, "motions", "assessment", f"at least one {least}", "none")
    for number, motion in enumerate(suite, start=1):
        if in_plane and not isinstance(motion, Pair):
            requirement = "a Pair, as the building has two directions"
            raise refusal(InvalidMotion, f"motion {number}", "assessment", requirement, brief(motion))
        if not in_plane and not (hasattr(motion, "acceleration") and hasattr(motion, "scaled")):
            raise refusal(InvalidMotion, f"motion {number}", "assessment", "a Record or Motion", brief(motion))
    return suite


def _factors(suite: Any, scaling: ScalingResult | None) -> FloatArray:
    return np.ones(len(suite)) if scaling is None else scaling.factors


def ground_peaks(motions: list[Any]) -> dict[str, list[float]]:
    """Return PGV (m/s) and PGD (m) of motions, of pairs the larger of both components."""
    both = [tuple(motion)[:2] if isinstance(motion, Pair) else (motion,) for motion in motions]
    records = [[Record(one.acceleration, one.dt) for one in components] for components in both]
    return {name: [max(getattr(one, name) for one in component) for component in records] for name in ("pgv", "pgd")}


def _is_synthetic(motion: Any) -> bool:
    return bool(getattr(motion.first if isinstance(motion, Pair) else motion, "synthetic", False))


TITLES: Final = {SLIDING: "goods slide", ADVISED: "analysis 1", BARE: "analysis 2"}
"""Models that are written, and what the program calls them."""


def write_models(folder: str | os.PathLike[str], result: Assessment, suite: Suite) -> list[Path]:
    """Write OpenSeesPy models of an assessed building, with goods that slide and of both analyses, and analysis.csv.
    `suite` holds its motions, unscaled.
    """
    from seismass.runs.opensees_export import write_opensees

    share = next((one.share_of_goods_present for one in result.answer.analyses if one.model == ADVISED), None)
    scenes = compared_models(result.building, result.target, share)
    motions = scaled_motions(suite, _factors(suite, result.scaling))
    models = {title: scenes[name] for name, title in TITLES.items() if name in scenes}
    table = analysis_table(result.answer, result.building)
    return write_opensees(folder, models, motions, documents={f"{ANALYSIS}.csv": without_formulas(table).write_csv()})
