"""Analyses of fragility: incremental dynamic analysis, multiple stripes, and clouds, of several models side by side."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias, get_args

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import ProgressLike, as_bootstrap, as_word
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, as_list, as_positive, brief, refusal
from seismass.effective_mass.models import SAME_DAMPING, ModelDamping
from seismass.model.scene import Scene
from seismass.motions.motion import HasMotion, Motion, MotionLike
from seismass.studies.fragility import estimate
from seismass.studies.fragility.estimate import CONFIDENCE, RESAMPLES
from seismass.studies.fragility.hunt import CapacityRule, HuntAndFill, crossing_of, hunt_and_fill
from seismass.studies.fragility.limits import IntensityMeasure, LimitState, MeasureName
from seismass.studies.fragility.result import Fits, FragilityAnalysis, result_of
from seismass.studies.fragility.run import (
    DEFAULT_CODE_SHARE,
    IndexArray,
    Setting,
    check_levels,
    compared_models,
    setting_of,
    solve_levels,
    solve_runs,
)

Motions: TypeAlias = MotionLike | Iterable[MotionLike]
Models: TypeAlias = Scene | Mapping[str, Scene]
Limits: TypeAlias = LimitState | str | Iterable[LimitState | str]


def incremental_dynamic_analysis(
    models: Models,
    motions: Motions,
    limits: Limits,
    *,
    measure: MeasureName | IntensityMeasure = "sa_t1",
    period: float | None = None,
    method: str = "hunt_fill",
    intensities: ArrayLike | None = None,
    hunt: HuntAndFill | None = None,
    capacity: CapacityRule = "first",
    code_share: float = DEFAULT_CODE_SHARE,
    damping: ModelDamping = SAME_DAMPING,
    at: ArrayLike = (),
    confidence: float = CONFIDENCE,
    resamples: int = RESAMPLES,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> FragilityAnalysis:
    """Scale motions up until limits are exceeded, for a building with sliding goods and for the models of it.

    Parameters
    ----------
    models : Scene or mapping of str to Scene
        A scene with goods on its floors stands for the three models of `compared_models`: goods that slide, the code's
        share of them attached, all attached. Or models by name, of which "real", or else the first, is the reference.
    motions : Motion, Record or iterable of them
        The suite.
    limits : LimitState or str, or iterable of them
        The limit states, or their names, as `parse_limit` reads them: "drift_ratio=0.02".
    measure : {"scale", "pga", "sa_t1", "sa_avg"} or IntensityMeasure, default "sa_t1"
        The intensity measure; see `IntensityMeasure`.
    period : float, optional
        T1 (s) of the measure; default the first period of the first model's building, for "real" that without live
        load. A motion has the same intensity for every model.
    method : {"hunt_fill", "stripes"}, default "hunt_fill"
        "hunt_fill": each motion is scaled up by itself until it exceeds the limits, and its capacity is located; the
        fragility is fitted to capacities. "stripes": all motions are scaled to `intensities`; it is fitted to counts.
    intensities : array_like, optional
        Positive intensities of the stripes.
    hunt : HuntAndFill, optional
        How intensities are chosen, for "hunt_fill".
    capacity : {"first", "last"}, default "first"
        Which crossing of a limit is the capacity of a motion whose demand falls again at higher intensities. Motions
        with several are counted in the remarks.
    code_share, damping
        As for `compared_models`, where a scene is given.
    at : array_like, optional
        Intensities at which probabilities are compared, beside those at which the models have 10 and 50 %.
    confidence, resamples, seed
        Of the bootstrap intervals over the motions: all models are drawn with the same motions, and motions of one
        earthquake together.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.
    progress : callable, optional
        Called with (runs done, runs in all); an estimate until the end of a hunt.

    Returns
    -------
    FragilityAnalysis
        Runs, capacities, fragilities with intervals, and the comparison of the models.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be.
    SimulationError
        A run could not be carried to its end.
    KeyboardInterrupt
        Ctrl-C was pressed.

    Notes
    -----
    Vamvatsikos and Cornell (2002), Earthquake Eng. Struct. Dyn. 31:491-514. The scatter is that of the motions alone:
    friction, occupancy, strength and stiffness are as given. Scaling changes amplitudes and not spectral shapes, so
    that large factors overstate or understate what rare motions do (Baker and Cornell 2006).

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.25, 0.15], heights=3.0)
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], mu=0.2))
    >>> limit = sm.fragility.LimitState("drift_ratio", 0.02)
    >>> found = sm.fragility.incremental_dynamic_analysis(scene, sm.builtin_suite("seven"), limit)
    >>> found.fragilities["model"].to_list()
    ['real', 'code', 'attached']
    """
    owner = "incremental dynamic analysis"
    as_word(method, ("hunt_fill", "stripes"), "method", owner)
    if method == "stripes":
        if intensities is None or hunt is not None:
            requirement = "given and hunt left out where method is stripes"
            raise refusal(InvalidOption, "intensities", owner, requirement, brief(intensities))
    elif intensities is not None:
        raise refusal(InvalidOption, "intensities", owner, "left out where method is hunt_fill", brief(intensities))
    options = as_bootstrap(confidence, resamples, seed, owner, least=0)
    rule: CapacityRule = as_word(capacity, get_args(CapacityRule), "capacity", owner)
    named, settings = _models(models, code_share, damping)
    setting = setting_of(named, motions, limits, measure, period, owner, threads=threads)
    settings |= {"capacity": rule}
    draws = estimate.draws_of(setting.motions.cluster_of, options)
    if method == "stripes":
        levels = check_levels(intensities, owner)
        runs = solve_levels(setting, levels, threads, progress)
        every = np.arange(len(setting.motions))
        fits = _stripe_fits(setting, runs, levels, [every] * len(levels), [draws] * len(levels))
        settings |= {"intensities": levels.tolist()}
        return result_of(setting, "stripes", runs, capacities_of(setting, runs, rule), fits, at, options, settings)
    wanted = HuntAndFill() if hunt is None else hunt
    if not isinstance(wanted, HuntAndFill):
        raise refusal(InvalidOption, "hunt", owner, "a HuntAndFill", brief(hunt))
    runs, steps = hunt_and_fill(setting, wanted, rule, threads=threads, progress=progress)
    capacities = capacities_of(setting, runs, rule)
    fits = {}
    for limit in setting.limits:
        for model in _with(setting, limit):
            rows = capacities.filter(limit=limit.name, model=model)
            exceeded = rows["capacity"].is_not_null().to_numpy()
            known = rows.select(pl.coalesce("capacity", "highest")).to_series().to_numpy()
            fits[model, limit.name] = estimate.of_capacities(known, exceeded, draws)
    settings |= {"hunt": {**wanted.to_dict(), **steps}}
    return result_of(setting, "hunt_fill", runs, capacities, fits, at, options, settings)


def multiple_stripes(
    models: Models,
    stripes: Mapping[float, Motions],
    limits: Limits,
    *,
    measure: MeasureName | IntensityMeasure = "sa_t1",
    period: float | None = None,
    scaled: bool = True,
    code_share: float = DEFAULT_CODE_SHARE,
    damping: ModelDamping = SAME_DAMPING,
    at: ArrayLike = (),
    confidence: float = CONFIDENCE,
    resamples: int = RESAMPLES,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> FragilityAnalysis:
    """Solve models under other motions at each of several intensities, as selected for the hazard there.

    Parameters
    ----------
    models : Scene or mapping of str to Scene
        As for `incremental_dynamic_analysis`.
    stripes : mapping of float to motions
        Motions of each intensity. For the same suite at all of them see `incremental_dynamic_analysis`.
    limits, measure, period
        As for `incremental_dynamic_analysis`.
    scaled : bool, default True
        Scale each motion to the intensity of its stripe; False takes motions as they are.
    code_share, damping, at, confidence, resamples, seed, threads, progress
        As for `incremental_dynamic_analysis`; motions are drawn within each stripe.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError, KeyboardInterrupt
        As for `incremental_dynamic_analysis`.

    Notes
    -----
    Jalayer (2003), dissertation, Stanford University; fits of counts as Baker (2015), Earthquake Spectra 31:579-599.

    Examples
    --------
    >>> import seismass as sm
    >>> scene = sm.Scene(sm.Building.uniform(2, 0.4, heights=3.0), sm.blocks_on_floors([1.0, 0.0], mu=0.2))
    >>> suite = list(sm.builtin_suite("eleven"))
    >>> limit = sm.fragility.LimitState("drift_ratio", 0.01)
    >>> found = sm.fragility.multiple_stripes(scene, {0.5: suite[:6], 1.0: suite[3:9], 1.5: suite[5:]}, limit)
    >>> found.runs.height
    54
    """
    owner = "multiple stripes"
    options = as_bootstrap(confidence, resamples, seed, owner, least=0)
    listed, indices, levels = _stripes(stripes, owner)
    named, settings = _models(models, code_share, damping)
    setting = setting_of(named, listed, limits, measure, period, owner, threads=threads)
    motion = np.concatenate(indices)
    level = np.repeat(levels, [len(each) for each in indices])
    at_solved = level if scaled else setting.unit[motion]
    count = len(setting.models)
    runs = solve_runs(
        setting,
        np.repeat(np.arange(count), len(motion)),
        np.tile(motion, count),
        np.tile(at_solved, count),
        threads=threads,
        progress=progress,
    ).with_columns(stripe=np.tile(level, count))
    clusters = setting.motions.cluster_of
    draws = [estimate.draws_of(clusters[each], options, number) for number, each in enumerate(indices)]
    fits = _stripe_fits(setting, runs, levels, indices, draws, column="stripe")
    settings |= {
        "stripes": levels.tolist(),
        "motions_of_stripes": [len(each) for each in indices],
        "scaled": bool(scaled),
    }
    return result_of(setting, "stripes", runs, None, fits, at, options, settings)


def cloud_analysis(
    models: Models,
    motions: Motions,
    limits: Limits,
    *,
    measure: MeasureName | IntensityMeasure = "sa_t1",
    period: float | None = None,
    scale: float = 1.0,
    code_share: float = DEFAULT_CODE_SHARE,
    damping: ModelDamping = SAME_DAMPING,
    at: ArrayLike = (),
    confidence: float = CONFIDENCE,
    resamples: int = RESAMPLES,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> FragilityAnalysis:
    """Solve models under motions as they are, and regress demand on intensity.

    Parameters
    ----------
    models, motions, limits, measure, period
        As for `incremental_dynamic_analysis`. The measure "scale" is the same for all motions and cannot be regressed
        on.
    scale : float, default 1
        Factor of all motions.
    code_share, damping, at, confidence, resamples, seed, threads, progress
        As for `incremental_dynamic_analysis`.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError, KeyboardInterrupt
        As for `incremental_dynamic_analysis`; or the measure is "scale".

    Notes
    -----
    See `fit_cloud`. For collapse itself as a limit, each run counts by itself, as in `fit_counts`. The line through the
    logarithms is assumed to hold over the whole cloud, with one scatter.

    Examples
    --------
    >>> import seismass as sm
    >>> scene = sm.Scene(sm.Building.uniform(2, 0.4, heights=3.0), sm.blocks_on_floors([1.0, 0.0], mu=0.2))
    >>> limit = sm.fragility.LimitState("drift_ratio", 0.01)
    >>> found = sm.fragility.cloud_analysis(scene, sm.builtin_suite("eleven"), limit, measure="pga")
    >>> found.fragility(limit, "attached").method
    'cloud'
    """
    owner = "cloud analysis"
    options = as_bootstrap(confidence, resamples, seed, owner, least=0)
    factor = as_positive(scale, "scale", owner, InvalidOption)
    named, settings = _models(models, code_share, damping)
    setting = setting_of(named, motions, limits, measure, period, owner, threads=threads)
    if setting.measure.name == "scale":
        raise refusal(InvalidOption, "measure", owner, "other than scale, which all motions share", "scale")
    count = len(setting.motions)
    model, motion = (part.ravel() for part in np.indices((len(setting.models), count)))
    runs = solve_runs(setting, model, motion, factor * setting.unit[motion], threads=threads, progress=progress)
    draws = estimate.draws_of(setting.motions.cluster_of, options)
    fits = {}
    for limit in setting.limits:
        for name in _with(setting, limit):
            rows = runs.filter(model=name)
            intensity, demand = rows["intensity"].to_numpy(), rows[limit.column].to_numpy()
            if limit.quantity == "collapse":
                fits[name, limit.name] = estimate.of_occurrences(intensity, demand > limit.value, draws)
            else:
                fits[name, limit.name] = estimate.of_cloud(intensity, demand, np.isinf(demand), limit.value, draws)
    settings |= {"scale": factor}
    return result_of(setting, "cloud", runs, None, fits, at, options, settings)


def capacities_of(setting: Setting, runs: pl.DataFrame, rule: CapacityRule) -> pl.DataFrame:
    """Return one row per limit, model and motion; see `FragilityAnalysis.capacities`."""
    rows = []
    for limit in setting.limits:
        for model in _with(setting, limit):
            runs_of_model = runs.filter(model=model)
            for part in runs_of_model.partition_by("motion", maintain_order=True):
                x = part["intensity"].to_numpy()
                crossing = crossing_of(x, part[limit.column].to_numpy(), limit, rule)
                rows.append(
                    {
                        "limit": limit.name,
                        "model": model,
                        "motion": part["motion"][0],
                        "record": part["record"][0],
                        "capacity": crossing.value if np.isfinite(crossing.value) else None,
                        "lower": crossing.lower,
                        "upper": crossing.upper if np.isfinite(crossing.upper) else None,
                        "highest": float(x[-1]),
                        "crossings": crossing.crossings,
                    }
                )
    schema = {"motion": pl.UInt32, "capacity": pl.Float64, "upper": pl.Float64, "crossings": pl.UInt32}
    return pl.DataFrame(rows, schema_overrides=schema)


def _models(models: Any, code_share: float, damping: ModelDamping) -> tuple[Any, dict[str, Any]]:
    """Models by name, and what was chosen for them."""
    if isinstance(models, Scene) and models.building is not None and any(floor > 0 for floor in models.block_floor):
        return compared_models(models, code_share, damping=damping), {"code_share": code_share, "damping": damping}
    return models, {}


def _with(setting: Setting, limit: LimitState) -> list[str]:
    """Names of the models that have the quantity of a limit."""
    return [name for name, scene in setting.models.items() if limit.applies(scene)]


def _stripes(stripes: Any, owner: str) -> tuple[list[Any], list[IndexArray], FloatArray]:
    """Motions of all stripes, each once, the numbers of those of each stripe, and the intensities in order."""
    if not isinstance(stripes, Mapping) or not stripes:
        raise refusal(InvalidOption, "stripes", owner, "a mapping of intensities to motions", brief(stripes))
    ordered = sorted((as_positive(level, "intensity", owner, InvalidOption), value) for level, value in stripes.items())
    number: dict[int, int] = {}
    listed: list[Any] = []
    indices = []
    for level, value in ordered:
        what, need = f"motions at {level:g}", "a list of Motions or Records"
        single = isinstance(value, Motion | HasMotion)
        listed_motions = [value] if single else as_list(value, what, owner, InvalidMotion, need)
        if not listed_motions:
            raise refusal(InvalidMotion, what, owner, need, brief(value))
        for motion in listed_motions:
            if id(motion) not in number:
                number[id(motion)] = len(listed)
                listed.append(motion)
        indices.append(np.array([number[id(motion)] for motion in listed_motions], dtype=np.int64))
    return listed, indices, np.array([level for level, _ in ordered])


def _stripe_fits(
    setting: Setting,
    runs: pl.DataFrame,
    levels: FloatArray,
    indices: list[IndexArray],
    draws: list[estimate.Draws],
    column: str = "intensity",
) -> Fits:
    """Fragilities of counts; the motions of each level are in the order of its indices."""
    fits = {}
    for limit in setting.limits:
        for model in _with(setting, limit):
            rows = runs.filter(model=model)
            exceeded = []
            for level, indices_of_level in zip(levels, indices, strict=True):
                here = rows.filter(pl.col(column) == level)
                assert here["motion"].to_list() == (indices_of_level + 1).tolist()
                exceeded.append(limit.exceeded(here[limit.column].to_numpy()))
            fits[model, limit.name] = estimate.of_stripes(levels, exceeded, draws)
    return fits
