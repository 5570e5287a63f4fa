"""Runs of models under scaled motions, in batches, as one long table of demands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike, NDArray

from seismass.base.arguments import Progress, ProgressLike, as_share
from seismass.base.errors import InvalidOption, InvalidScene, SimulationError
from seismass.base.values import FloatArray, as_array, brief, refusal
from seismass.effective_mass.models import SAME_DAMPING, ModelDamping, attached, check_damping, check_loaded
from seismass.model.scene import Scene
from seismass.runs.batch import solve_many
from seismass.runs.peaks import NamedMotions, named_motions
from seismass.studies.fragility.limits import IntensityMeasure, LimitState, MeasureName, as_limits, measure_for

SLIDING: Final = "real"
"""The model with which others are compared: goods that slide."""
CODE: Final = "code"
ATTACHED: Final = "attached"
DEFAULT_CODE_SHARE: Final = 0.25
"""Share of the live load that ASCE 7 counts as mass for storage (12.7.2)."""


def compared_models(
    scene: Scene, code_share: float = DEFAULT_CODE_SHARE, *, damping: ModelDamping = SAME_DAMPING
) -> dict[str, Scene]:
    """Return a scene beside the models of it that have a share of the live load attached and no sliding goods.

    Parameters
    ----------
    scene : Scene
        Building and goods.
    code_share : float, default 0.25
        Share of the live load that the code's model has as mass: that of ASCE 7 for storage.
    damping : {"same", "ratio"}, default "same"
        As for `attached_scene`: the damping matrix of the real building, or its ratio in the model's own modes.

    Returns
    -------
    dict of str to Scene
        "real", "code" and "attached".

    Raises
    ------
    InvalidScene
        The scene has no building, or no block on one of its floors.
    InvalidOption
        The share is not between 0 and 1, or the damping is another word.

    Examples
    --------
    >>> import seismass as sm
    >>> scene = sm.Scene(sm.Building.uniform(2, 0.4), sm.blocks_on_floors([1.0, 0.0], mu=0.3))
    >>> {name: model.building.mass.tolist() for name, model in sm.fragility.compared_models(scene).items()}
    {'real': [1.0, 1.0], 'code': [1.25, 1.0], 'attached': [2.0, 1.0]}
    """
    owner = "compared models"
    loaded = check_loaded(scene, owner)
    share, convention = as_share(code_share, "code_share", owner), check_damping(damping, owner)
    return {SLIDING: loaded, CODE: attached(loaded, share, convention), ATTACHED: attached(loaded, 1.0, convention)}


def as_models(models: Any, owner: str) -> dict[str, Scene]:
    """Return models by name, all of one number of storeys; one scene alone is the real building."""
    listed = {SLIDING: models} if isinstance(models, Scene) else models
    if not isinstance(listed, Mapping) or not listed:
        raise refusal(InvalidScene, "models", owner, "a Scene, or a mapping of names to Scenes", brief(models))
    for name, scene in listed.items():
        if not isinstance(name, str) or not name:
            raise refusal(InvalidScene, "models", owner, "named by text", brief(name))
        if not isinstance(scene, Scene):
            raise refusal(InvalidScene, f"model {name}", owner, "a Scene", brief(scene))
        scene.require_chain(owner)
    scenes = dict(listed)
    first = next(iter(scenes.values()))
    for name, scene in scenes.items():
        if scene.storeys != first.storeys:
            requirement = f"of {first.storeys} storeys, as the first one"
            raise refusal(InvalidScene, f"model {name}", owner, requirement, str(scene.storeys))
        if not np.array_equal(_heights(scene), _heights(first)):
            requirement = f"those of the first one, {brief(_heights(first).tolist())}"
            got = brief(_heights(scene).tolist())
            raise refusal(InvalidScene, f"heights of model {name}", owner, requirement, got)
    return scenes


def _heights(scene: Scene) -> FloatArray:
    """Storey heights; none where they are not known."""
    known = None if scene.building is None else scene.building.heights
    return np.empty(0) if known is None else known


IndexArray: TypeAlias = NDArray[np.int64]

SAMPLES_AT_ONCE: Final = 2**22
"""Samples of scaled motions that a batch holds, in some 100 MB."""


@dataclass(frozen=True, slots=True)
class Setting:
    """Models, motions and limits of an analysis, checked; `unit` (motions,) is the intensity of each at scale 1."""

    models: dict[str, Scene]
    motions: NamedMotions
    limits: tuple[LimitState, ...]
    measure: IntensityMeasure
    unit: FloatArray

    @property
    def columns(self) -> tuple[str, ...]:
        """Demand columns, each once."""
        return tuple(dict.fromkeys(limit.column for limit in self.limits))

    @property
    def needs_residual(self) -> bool:
        """Whether runs must be carried to their end."""
        return any(limit.needs_residual for limit in self.limits)


def setting_of(
    models: Any,
    motions: Any,
    limits: Any,
    measure: MeasureName | IntensityMeasure,
    period: float | None,
    owner: str,
    *,
    threads: int | None = None,
) -> Setting:
    """Return the checked setting of an analysis."""
    named, states = as_models(models, owner), as_limits(limits, owner)
    for limit in states:
        for scene in named.values():
            limit.check(scene, owner)
        if not any(limit.applies(scene) for scene in named.values()):
            raise refusal(InvalidOption, "limit", owner, "of a quantity that some model has", limit.name)
    taken = named_motions(motions, owner)
    measure_used = measure_for(measure, next(iter(named.values())), period)
    return Setting(named, taken, states, measure_used, measure_used.of(taken.motions, threads=threads))


def solve_runs(
    setting: Setting,
    model: IndexArray,
    motion: IndexArray,
    intensity: FloatArray,
    *,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> pl.DataFrame:
    """Solve runs by the numbers (from 0) of model and motion and the intensity, which scales both components. Return a
    row per run in that order with the demand of each limit, null where a model has none.
    """
    names = list(setting.models)
    total, scale = len(model), intensity / setting.unit[motion]
    # Runs of one scaled motion follow each other, so that it is made once for all models.
    order = np.lexsort((model, scale, motion))
    frames, whole = [], Progress(progress, total, "intensity analysis")
    for part in _parts(setting, motion[order], scale[order]):
        ids = order[part]
        call = whole.part(len(ids))
        frames.append(_solve_part(setting, model[ids], motion[ids], scale[ids], threads, call))
    place = np.empty(total, dtype=np.int64)
    place[order] = np.arange(total)
    demands = pl.concat(frames)[place]
    return pl.DataFrame(
        {
            "model": pl.Series(names, dtype=pl.String).gather(model),
            "motion": (motion + 1).astype(np.uint32),
            "record": pl.Series(setting.motions.names, dtype=pl.String).gather(motion),
            "scale": scale,
            "intensity": intensity,
        }
    ).hstack(demands)


def solve_grid(
    models: Mapping[str, Scene] | Scene,
    motions: Any,
    limits: LimitState | str | Sequence[LimitState | str],
    intensities: ArrayLike,
    *,
    measure: MeasureName | IntensityMeasure = "sa_t1",
    period: float | None = None,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> pl.DataFrame:
    """Solve all models under all motions, each motion scaled to all intensities.

    Parameters
    ----------
    models : Scene or mapping of str to Scene
        Models by name; a scene alone is "real".
    motions : Motion, Record or iterable of them
        The suite.
    limits : LimitState or str, or sequence of them
        What is asked of the runs, or their names, as `parse_limit` reads them.
    intensities : array_like, shape (levels,)
        Positive intensities.
    measure, period
        As for `measure_for`.
    threads, progress
        As for `solve_runs`.

    Returns
    -------
    polars.DataFrame
        The table of `solve_runs`, sorted by model, motion and intensity.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError, KeyboardInterrupt
        As for `solve_runs`, or an argument is not what it must be.
    """
    owner = "runs at intensities"
    setting = setting_of(models, motions, limits, measure, period, owner, threads=threads)
    return solve_levels(setting, check_levels(intensities, owner), threads, progress)


def solve_levels(setting: Setting, levels: FloatArray, threads: int | None, progress: ProgressLike) -> pl.DataFrame:
    """Return the runs of all models under all motions at all levels, sorted so."""
    shape = (len(setting.models), len(setting.motions), len(levels))
    model, motion, level = (part.ravel() for part in np.indices(shape))
    return solve_runs(setting, model, motion, levels[level], threads=threads, progress=progress)


def check_levels(intensities: Any, owner: str, name: str = "intensities") -> FloatArray:
    """Return positive intensities in increasing order."""
    levels = as_array(intensities, name, owner, InvalidOption)
    if not len(levels) or not (np.isfinite(levels) & (levels > 0.0)).all() or not (np.diff(levels) > 0.0).all():
        raise refusal(InvalidOption, name, owner, "positive and increasing", str(levels.tolist()))
    return levels


def _solve_part(
    setting: Setting,
    model: IndexArray,
    motion: IndexArray,
    scale: FloatArray,
    threads: int | None,
    progress: ProgressLike,
) -> pl.DataFrame:
    """Status and demands of runs, of which each pair of motion and factor is scaled once."""
    pairs, which = np.unique(np.stack([motion.astype(np.float64), scale], axis=1), axis=0, return_inverse=True)
    scaled = [setting.motions.motions[int(number)].scaled(factor) for number, factor in pairs.tolist()]
    scenes = list(setting.models.values())
    runs = np.stack([model + 1, which.reshape(-1) + 1], axis=1)
    peaks_only = not setting.needs_residual
    table = solve_many(scenes, scaled, pairs=runs, peaks_only=peaks_only, threads=threads, progress=progress)
    failed = table.with_row_index("row").filter(pl.col("status") == "failed")
    if failed.height:
        row, reason = failed.row(0, named=True)["row"], failed.row(0, named=True)["reason"]
        record = setting.motions.names[motion[row]]
        name = list(setting.models)[model[row]]
        raise SimulationError(f"run of model {name} under {record} x {scale[row]:g} must reach its end; got: {reason}")
    building = scenes[0].building
    heights = None if building is None else building.heights
    columns: dict[str, pl.Series] = {"status": table["status"]}
    for limit in setting.limits:
        if limit.column not in columns:
            demand = limit.demand(table, heights)
            columns[limit.column] = pl.Series(limit.column, demand, dtype=pl.Float64, nan_to_null=True)
    return pl.DataFrame(columns)


def _parts(setting: Setting, motion: IndexArray, scale: FloatArray) -> list[slice]:
    """Stretches of ordered runs whose scaled motions fit into memory together."""
    samples = np.array([each.samples for each in setting.motions.motions])[motion]
    same = (np.diff(motion) == 0) & (np.diff(scale) == 0.0)
    samples[1:][same] = 0
    part = np.cumsum(samples) // SAMPLES_AT_ONCE
    starts = [0, *(np.flatnonzero(np.diff(part)) + 1).tolist()]
    return [slice(first, last) for first, last in zip(starts, [*starts[1:], len(motion)], strict=True)]
