"""The effective fraction of many buildings in one table: a list of scenes, a product or a grid of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import groupby
from typing import Any, Final

import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import Progress, ProgressLike, as_bootstrap, as_threads
from seismass.base.errors import InvalidOption
from seismass.base.statistics import DRIFT_CAP, few_collapses
from seismass.base.stored_results import NOTHING_STORED, StoredResults
from seismass.base.values import FloatArray, as_one_of, brief, is_list, refusal
from seismass.effective_mass.models import (
    SAME_DAMPING,
    ModelDamping,
    attached,
    check_cap,
    check_damping,
    check_fractions,
    check_loaded,
)
from seismass.effective_mass.search import without_friction
from seismass.effective_mass.share import equal_share
from seismass.model.scene import Scene
from seismass.motions.motion import MotionLike
from seismass.runs.grid.grid import Grid
from seismass.runs.peaks import NamedMotions, Peaks, named_motions, solve

OWNER: Final = "effective mass table"
_AT_ONCE: Final = 64


def effective_mass_table(
    scenes: Grid | Sequence[Scene],
    motions: MotionLike | Sequence[MotionLike],
    *,
    fractions: ArrayLike | None = None,
    damping: ModelDamping = SAME_DAMPING,
    drift_cap: float = DRIFT_CAP,
    resamples: int = 200,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
    store: StoredResults = NOTHING_STORED,
) -> pl.DataFrame:
    """Return the effective fraction of many buildings with goods, as `effective_mass` defines it.

    Parameters
    ----------
    scenes : Grid or sequence of Scene
        Scenes with a building and goods on its floors: a list, a `runs.SceneProduct`, or a grid without columns of
        motions and scales.
    motions : Motion, Record or sequence of them
        The suite.
    fractions : array_like, optional
        Shares of the models, from 0 to 1; by default 21. The fraction is linear between them, where `effective_mass`
        refines it: a few thousandths.
    damping, drift_cap, threads
        As for `effective_mass`.
    resamples, seed
        Of the bootstrap of 90 % intervals over events.
    progress, store : optional
        Called with (runs done, runs in all); where an interrupted call of the same inputs has left its parts.

    Returns
    -------
    polars.DataFrame
        One row per scene: scene, value, low, high, kind (as `EffectiveMass` has it), real (mean drift), model_0 and
        model_1 (of models with none and all attached), slides and collapsed (share of the motions).

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError
        As for `effective_mass`.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
    >>> grid = sm.Grid.product(building, roof="bare", mass_ratio=[0.5, 1.0], mu=[0.1, 50.0])
    >>> sm.evidence.effective_mass_table(grid, sm.builtin_suite("seven"))["kind"].to_list()
    ['root', 'stuck', 'root', 'stuck']
    """
    named, shares = named_motions(motions, OWNER), check_fractions(fractions, OWNER)
    convention, cap = check_damping(damping, OWNER), check_cap(drift_cap, OWNER)
    as_one_of(store, StoredResults, "store", OWNER, InvalidOption)
    if not (isinstance(scenes, Grid) or is_list(scenes)) or not len(scenes):
        raise refusal(InvalidOption, "scenes", OWNER, "a Grid or a list of Scenes", brief(scenes))
    if isinstance(scenes, Grid) and {"scale", "motion"} & set(scenes.table(1, 1).columns):
        raise refusal(InvalidOption, "scenes", OWNER, "a grid without scale and motion", brief(scenes))
    stages = Progress(progress, len(scenes) * (1 + len(shares)) * len(named), OWNER)
    how: dict[str, Any] = {"drift_cap": cap, "threads": as_threads(threads, OWNER)}
    _, count, start = as_bootstrap(0.9, resamples, seed, OWNER)
    bootstrap: dict[str, Any] = {"cluster_of": named.cluster_of, "resamples": count, "seed": start}

    def part(first: int) -> pl.DataFrame:
        numbers = range(first, min(first + _AT_ONCE, len(scenes)))
        listed = [check_loaded(scenes.scene(i + 1) if isinstance(scenes, Grid) else scenes[i]) for i in numbers]
        rows: list[dict[str, Any]] = []
        for _, group in groupby(listed, key=lambda scene: scene.storeys):
            alike = list(group)
            sliding = solve(alike, named, **how, progress=stages.part(len(alike) * len(named)))
            attached_scenes = [attached(scene, float(share), convention) for scene in alike for share in shares]
            model = solve(attached_scenes, named, **how, progress=stages.part(len(attached_scenes) * len(named)))
            rows += _rows(alike, shares, sliding, model, named, bootstrap)
        return pl.DataFrame(rows, infer_schema_length=None).insert_column(
            0, pl.Series("scene", [i + 1 for i in numbers])
        )

    parts = [store.of(f"shares-{first}", partial(part, first)) for first in range(0, len(scenes), _AT_ONCE)]
    return pl.concat(parts, how="vertical_relaxed")


def _rows(
    scenes: list[Scene],
    shares: FloatArray,
    sliding: Peaks,
    model: Peaks,
    motions: NamedMotions,
    bootstrap: dict[str, Any],
) -> Iterator[dict[str, Any]]:
    """Yield what the table has of each scene, from peaks of the scenes and of their models."""
    for number, scene in enumerate(scenes):
        of_models, collapsed = model.part(number * len(shares), len(shares)), int(sliding.collapsed[number].sum())
        equal = equal_share(shares, of_models.largest, sliding.largest[number], **bootstrap)
        kind, value, (low, high) = str(equal.kind), equal.value, equal.interval or (None, None)
        if not few_collapses(collapsed, len(motions)):
            kind, value, low, high = "collapsed", None, None, None  # type: ignore[assignment]
        elif not sliding.slides[number].any() or without_friction(scene):
            kind = "zero" if without_friction(scene) else "stuck"
            value = low = high = float(kind == "stuck")
        row = {"value": value, "low": low, "high": high, "kind": kind, "real": equal.sliding}
        row |= {"model_0": float(equal.model[0]), "model_1": float(equal.model[-1])}
        yield row | {"slides": float(sliding.slides[number].mean()), "collapsed": collapsed / len(motions)}
