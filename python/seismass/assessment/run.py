"""Runs an assessment: scaling, effective fractions at the bounds of friction, the models that are compared."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from seismass import _kernel
from seismass.assessment.advice import advice_of, assumptions_of, remarks_of
from seismass.assessment.answer import (
    ANALYSIS,
    SHARES,
    advised_share,
    analysis_table,
    answer_of,
    deciding,
    design_share,
    design_shares,
    fractions_by_friction,
)
from seismass.assessment.building import OwnBuilding
from seismass.assessment.building_file import read_building
from seismass.assessment.checks import collapses_of, governing_table, slip_table, storey_table
from seismass.assessment.doubts import doubts_of
from seismass.assessment.file_site import spectra_table
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
from seismass.assessment.result import SCHEMA_VERSION, Assessment
from seismass.base.digest import inputs_digest, motion_contents
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.files import without_formulas
from seismass.base.values import brief, refusal
from seismass.effective_mass.models import SHARES_BEYOND, goes_beyond
from seismass.model.codes import CodeFraction
from seismass.model.friction import bound_factors
from seismass.motions.motion import motion_names
from seismass.motions.records import Pair, Pairs, Suite, builtin_pairs, builtin_suite
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.simulate import instruction_set

FIXED_MODELS: Final = 4
"""Models that every assessment with goods solves beside those with goods that slide."""

Progress = Callable[[int, int], object]


def assess(
    building: OwnBuilding | str | os.PathLike[str] | Mapping[str, Any],
    motions: Suite | Pairs | Iterable[Any] | None = None,
    target: TargetSpectrum | None = None,
    *,
    code: CodeFraction | None = None,
    mu_factors: tuple[float, float] | None = None,
    scaling_period: float | None = None,
    scale: bool = True,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
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
        In place of the building's code, as `code_fraction` gives it.
    mu_factors : tuple of float, optional
        In place of the building's factors of friction for its lower and upper bound; (1, 1) leaves the bounds out.
    scaling_period : float, optional
        Period T (s) for which motions are scaled, from 0.2 T to 1.5 T; default that of the building file, else the
        first period of the building with the goods present attached.
    scale : bool, default True
        False takes the motions as they are. Pairs are scaled by one factor for both components, so that the geometric
        mean of their spectra is that of one component (`scale_asce7_10`); pairs scaled otherwise, as for the maximum
        direction of ASCE 7-16, are given with False.
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
    in_plane = stated.other is not None
    suite = _suite((builtin_pairs() if in_plane else builtin_suite("forty")) if motions is None else motions, in_plane)
    spectrum = stated.site_spectrum(target) if scale or stated.design is not None else None
    scaling = scaled_to_site(stated, suite, spectrum, scaling_period, threads=threads) if scale else None
    factors = np.ones(len(suite)) if scaling is None else scaling.factors
    scaled = [motion.scaled(float(factor)) for motion, factor in zip(suite, factors, strict=True)]
    loaded = bool((stated.goods_mass > 0.0).any())
    frictions = friction_factors(stated) if loaded else {}
    models = len(frictions) + FIXED_MODELS if loaded else 1
    fractions = len(frictions) + SHARES if loaded else 0
    designs = 2 * len(design_shares(stated)) if loaded and stated.design is not None else 0
    larger = len(SHARES_BEYOND) if loaded and goes_beyond(stated.scene(spectrum)) else 0
    stages = _Stages(progress, (models + fractions + larger + designs) * len(suite))
    bootstrap = {"confidence": confidence, "resamples": resamples, "seed": seed}
    effective = fractions_by_friction(
        stated, spectrum, frictions, scaled, bootstrap, threads, stages.next((fractions + larger) * len(suite))
    )
    advised = advised_share(effective)
    design = None
    if designs and advised is not None:
        factor = frictions[deciding(effective)]
        design = design_share(stated, spectrum, factor, scaled, threads, stages.next(designs * len(suite)))
    scenes = compared_models(stated, spectrum, advised)
    names = motion_names(suite)
    components = [record for motion in scaled for record in (tuple(motion) if in_plane else (motion,))]
    horizontal = [record for motion in scaled for record in (tuple(motion)[:2] if in_plane else (motion,))]
    runs, slips = solve_models(
        stated, scenes, scaled, names, threads=threads, progress=stages.next(models * len(suite))
    )
    sliding_scene = stated.scene(spectrum)
    storeys, slip, collapses = storey_table(stated, sliding_scene, runs), slip_table(stated, slips), collapses_of(runs)
    governing = governing_table(stated, storeys)
    place = motion_of_runs(runs)
    facts = {
        "name": suite.name if isinstance(suite, Suite | Pairs) else "motions",
        "motions": names,
        "pairs": in_plane,
        "synthetic": sum(_is_synthetic(motion) for motion in suite),
    }
    yields = effective[SLIDING].by_hand.yields if effective else None
    period = period_sentences(stated, spectrum, scaled, yields)
    doubts = doubts_of(stated, sliding_scene, scaled, spectrum, storeys)
    answer = answer_of(stated, advised, effective, design, storeys, governing, collapses, facts, scaling, doubts)
    return Assessment(
        building=stated,
        target=spectrum,
        answer=answer,
        effective=effective,
        design=None if design is None else design.effective,
        storeys=storeys,
        governing=governing,
        slip=slip,
        slips=slips,
        runs=runs,
        collapses=collapses,
        spectra=spectra_table(horizontal, spectrum, threads=threads),
        example=Shown(sliding_scene, scaled[place], place + 1, float(factors[place])),
        scaling=scaling,
        suite=facts,
        advice=advice_of(stated, answer, storeys, slip, collapses, len(suite), effective.get(SLIDING), runs),
        remarks=remarks_of(stated, doubts, scaling, effective, facts),
        assumptions=assumptions_of(stated, spectrum, scaling, facts, period),
        metadata={
            "schema_version": SCHEMA_VERSION,
            "package_version": _kernel.VERSION,
            "instructions": instruction_set(),
            "inputs_sha256": inputs_digest(
                scenes,
                stated,
                None if spectrum is None else spectrum.parameters,
                motion_contents(components),
                bootstrap,
            ),
            **bootstrap,
            "damping": "matrix of the building without goods, in every model",
            "p_delta": stated.gravity_load is not None,
            "motions": len(suite),
        },
    )


def _building(source: Any, code: CodeFraction | None, mu_factors: tuple[float, float] | None) -> OwnBuilding:
    building = source if isinstance(source, OwnBuilding) else read_building(source)
    if code is not None:
        if not isinstance(code, CodeFraction):
            raise refusal(InvalidOption, "code", "assessment", "a CodeFraction, as code_fraction gives it", brief(code))
        building = replace(building, code=code, code_stated=True)
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


def _is_synthetic(motion: Any) -> bool:
    return bool(getattr(motion.first if isinstance(motion, Pair) else motion, "synthetic", False))


class _Stages:
    """Progress of several batches as progress of the whole."""

    def __init__(self, progress: Progress | None, total: int) -> None:
        self._progress, self._total, self._done = progress, total, 0

    def next(self, runs: int) -> Progress | None:
        """Return what the next batch of so many runs calls."""
        progress, first, total = self._progress, self._done, self._total
        self._done += runs
        if progress is None:
            return None
        return lambda done, _: progress(min(first + done, total), total)


TITLES: Final = {SLIDING: "goods slide", ADVISED: "analysis 1", BARE: "analysis 2"}
"""Models that are written, and what the program calls them."""


def write_models(folder: str | os.PathLike[str], result: Assessment, suite: Suite) -> list[Path]:
    """Write OpenSeesPy models of an assessed building, with goods that slide and of both analyses, and analysis.csv.
    `suite` holds its motions, unscaled.
    """
    from seismass.runs.opensees_export import write_opensees

    share = next((one.share_of_goods_present for one in result.answer.analyses if one.model == ADVISED), None)
    scenes = compared_models(result.building, result.target, share)
    factors = np.ones(len(suite)) if result.scaling is None else result.scaling.factors
    motions = [record.scaled(float(factor)) for record, factor in zip(suite, factors, strict=True)]
    models = {title: scenes[name] for name, title in TITLES.items() if name in scenes}
    table = analysis_table(result.answer, result.building)
    return write_opensees(folder, models, motions, documents={f"{ANALYSIS}.csv": without_formulas(table).write_csv()})
