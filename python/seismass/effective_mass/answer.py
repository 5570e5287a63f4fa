"""The effective fraction of a building's live load: for a given building, for a rule that designs it,
and for many buildings in one table.

Definition: the smallest share of the live load which, attached as mass to the building with its stiffness, strength,
damping matrix and gravity load unchanged, gives a mean over the motions of the largest storey drift not below that of
the building with sliding goods, there and at every larger share up to 1. Goods on racks, or that press on stops, may
load the building more than all of them attached: then the smallest share above 1 that gives the drift.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial
from itertools import groupby
from typing import Any, Final, TypeAlias

import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import Progress, ProgressLike, as_bootstrap, as_threads
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.statistics import DRIFT_CAP, Statistic, few_collapses
from seismass.base.stored_results import NOTHING_STORED, StoredResults
from seismass.base.values import FloatArray, as_one_of, brief, is_list, refusal
from seismass.effective_mass.models import (
    SAME_DAMPING,
    SHARES_BEYOND,
    ModelDamping,
    attached,
    check_any_load,
    check_cap,
    check_damping,
    check_fractions,
    check_loaded,
    goes_beyond,
)
from seismass.effective_mass.result import EffectiveMass
from seismass.effective_mass.search import OWNER, Options, Search, checked_options, without_friction
from seismass.effective_mass.share import equal_share
from seismass.model.block import Block, SlidingBase
from seismass.model.building import Building
from seismass.model.rack import Rack
from seismass.model.scene import Scene
from seismass.motions.motion import MotionLike
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.batch import EngineRuns, MotionsLike
from seismass.runs.grid.grid import Grid
from seismass.runs.peaks import LARGER, DriftMeasure, NamedMotions, Peaks, named_motions, solve

Designed: TypeAlias = Building | tuple[Building, Building]
"""What a design gives: a building, or the same one in x and in y."""


@dataclass(frozen=True, slots=True)
class Solved:
    """Peaks of the building with sliding goods (one scene, or one per share) and of its models at shares of a grid."""

    search: Search
    sliding: Peaks
    model: Peaks
    question: str

    def answer(self) -> EffectiveMass:
        """Return the effective fraction."""
        return self.search.answer(self.sliding, self.model, {"question": self.question})


def solved_frictions(
    scenes: Sequence[Scene], motions: NamedMotions, options: Options, keep: list[EngineRuns] | None = None
) -> list[Solved]:
    """Solve a building with its goods at several frictions; its models, which have none, are solved once. The scenes
    differ in friction alone and have goods on their floors. Whole runs of theirs are added to `keep`.
    """
    checked = [check_any_load(scene) for scene in scenes]
    first, shares = checked[0], options.fractions
    how: dict[str, Any] = {"drift": options.drift, "drift_cap": options.drift_cap, "threads": options.threads}
    for number, scene in enumerate(checked[1:], start=2):
        if attached(scene, 1.0, options.damping) != attached(first, 1.0, options.damping):
            requirement = "the building and goods of scene 1, with another friction"
            raise refusal(InvalidScene, f"scene {number}", OWNER, requirement, "others")
    larger = SHARES_BEYOND if any(goes_beyond(scene) for scene in checked) else SHARES_BEYOND[:0]
    stages = Progress(options.progress, (len(checked) + len(shares) + len(larger)) * len(motions), OWNER)
    sliding_models = solve(checked, motions, **how, progress=stages.part(len(checked) * len(motions)), keep=keep)
    models = [attached(first, share, options.damping) for share in shares]
    model = solve(models, motions, **how, progress=stages.part(len(models) * len(motions)))
    above_one = None
    if len(larger):
        models = [attached(first, share, options.damping) for share in larger]
        above_one = solve(models, motions, **how, progress=stages.part(len(models) * len(motions)))

    @cache
    def model_at(share: float) -> Peaks:
        return solve([attached(first, share, options.damping)], motions, **how)

    def of(number: int, scene: Scene) -> Solved:
        sliding = sliding_models.one(number)
        search = Search(motions, options, lambda share: (sliding, model_at(share)), lambda _: scene, above_one)
        return Solved(search, sliding, model, "given building")

    return [of(number, scene) for number, scene in enumerate(checked)]


def solved_designs(
    design: Callable[[float], Designed],
    blocks: Iterable[Block],
    motions: NamedMotions,
    options: Options,
    racks: Iterable[Rack] = (),
    collapse_drift: FloatArray | None = None,
    base: SlidingBase | None = None,
    fixed_goods: FloatArray | None = None,
) -> Solved:
    """Solve the building that is designed with each share, with sliding goods and with that share attached; arguments
    as in `effective_mass_of_design`.
    """
    if not callable(design):
        requirement = "a callable that takes a share and returns a Building"
        raise refusal(InvalidOption, "design", OWNER, requirement, brief(design))
    goods, standing = tuple(blocks), tuple(racks)
    how: dict[str, Any] = {"drift": options.drift, "drift_cap": options.drift_cap, "threads": options.threads}

    def designed(share: float) -> Scene:
        pair: Any = design(share)
        building, other = pair if isinstance(pair, tuple) and len(pair) == 2 else (pair, False)
        if not isinstance(building, Building):
            raise refusal(InvalidScene, "design", OWNER, "a Building, or two in x and y", brief(building))
        what: dict[str, Any] = {"base": base, "fixed_goods": fixed_goods, "collapse_drift": collapse_drift}
        return check_any_load(Scene(building, goods, racks=standing, other_direction=other, **what))

    shares = [float(share) for share in options.fractions]
    stages = Progress(options.progress, 2 * len(shares) * len(motions), OWNER)
    scenes = [designed(share) for share in shares]
    if len({scene.storeys for scene in scenes}) > 1:
        requirement = "a Building of the same number of storeys for every share"
        raise refusal(InvalidScene, "design", OWNER, requirement, "different ones")
    runs = len(scenes) * len(motions)
    sliding = solve(scenes, motions, **how, progress=stages.part(runs))
    models = [attached(scene, share, options.damping) for scene, share in zip(scenes, shares, strict=True)]
    model = solve(models, motions, **how, progress=stages.part(runs))

    @cache
    def at(share: float) -> tuple[Peaks, Peaks]:
        scene = designed(share)
        model = attached(scene, share, options.damping)
        return solve([scene], motions, **how), solve([model], motions, **how)

    return Solved(Search(motions, options, at, designed), sliding, model, "design rule")


def effective_mass(
    scene: Scene,
    motions: MotionsLike,
    *,
    statistic: Statistic = "mean",
    drift_cap: float = DRIFT_CAP,
    drift: DriftMeasure = LARGER,
    damping: ModelDamping = SAME_DAMPING,
    fractions: ArrayLike | None = None,
    target: TargetSpectrum | str | None = None,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> EffectiveMass:
    """Return the share of a building's live load that acts as mass under a suite of motions.

    Parameters
    ----------
    scene : Scene
        The building with its goods as blocks, on floors and on racks; walls, stops and a base are those of the real
        building.
    motions : Motion, Record, Pair or iterable of them
        The suite, scaled as it is to act; a `Suite` is one. Records of one event are resampled together. A scene in two
        directions takes pairs.
    statistic : {"mean", "median"}, default "mean"
        What is taken of the largest drifts over the motions. There is no value where the real building collapses under
        more than a tenth of the motions; with the median, under more than half.
    drift_cap : float, default 0.10
        Over the storey height: a drift above it counts as it, so that drift and share are continuous where a run begins
        to collapse. Peaks of a run that collapses count up to the collapse. An assumption; no run ends at it. There is
        none without heights, and an infinite one gives plain means.
    drift : {"larger", "vector", "x", "y"}, optional
        Of scenes in two directions, what is compared: the larger of a storey's peak drifts in x and in y; the peak
        length of its drift vector; the peak in one direction.
    damping : {"same", "ratio"}, default "same"
        Damping of the models, see `attached_scene`.
    fractions : array_like, optional
        Shares at which models are solved before roots are refined, from 0 to 1; by default 0, 0.05, ..., 1. Two roots
        between two of them are missed.
    target : TargetSpectrum or str, optional
        Spectrum from which the rule by hand takes S_a; by default the mean spectrum of the motions.
    confidence : float, default 0.90
        Probability of the bootstrap interval.
    resamples : int, default 2000
        Bootstrap resamples; they need no runs.
    seed : int, default 0
        Seed of the resamples.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.
    progress : callable, optional
        Called with (runs done, runs in all) while the models are solved.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be, or the building has no goods on its floors.
    SimulationError
        A run could not be carried to its end.
    KeyboardInterrupt
        Ctrl-C was pressed.

    Notes
    -----
    Largest storey drift: drift ratio where the building has heights, else drift. Model and real building are solved
    exactly at every share of the grid; each sign change is refined on the exact model. A drift falls with added mass
    where the longer period meets a valley of the spectra, so that there may be several roots: the largest counts.

    With racks the live load is all goods, those on racks too, fixed or not; the frames of the racks are attached to
    their floors in every model. Where there are racks or stops and the model drifts less even with all goods attached,
    models go on to share 2, and the first that reaches the real drift counts (`kind` "beyond"): a rack whose period is
    near that of the building passes on more than the inertia of its goods. The rule by hand is of goods on the floors
    of shear buildings, and a remark says so.

    In two directions the real building has friction on the circle, and models have the same share attached in both.
    Nothing couples the directions of a model, so that each is solved by itself; for the vector, as a run in two
    directions. The rule by hand takes the building in x, or in y where `drift` is that, and 0.8 times mu
    (docs/two_directions.md).

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
    >>> result = sm.effective_mass(scene, [record.scaled(2.0) for record in sm.builtin_suite("seven")])
    >>> result.kind
    'root'
    """
    checked = check_any_load(scene)
    named = named_motions(motions, OWNER, checked)
    parameters = (statistic, damping, fractions, confidence, resamples, seed, threads, progress)
    options = checked_options(*parameters, drift, drift_cap, target)
    return solved_frictions([checked], named, options)[0].answer()


def effective_mass_of_design(
    design: Callable[[float], Designed],
    blocks: Iterable[Block],
    motions: MotionsLike,
    *,
    racks: Iterable[Rack] = (),
    base: SlidingBase | None = None,
    statistic: Statistic = "mean",
    drift_cap: float = DRIFT_CAP,
    damping: ModelDamping = SAME_DAMPING,
    fractions: ArrayLike | None = None,
    target: TargetSpectrum | str | None = None,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> EffectiveMass:
    """Return the share that a code would have to prescribe, where it sets the strength of the building too.

    The consistent share solves real(V_y(share)) = model(share, V_y(share)): `design` is asked for the building at every
    share, which is solved with sliding goods and with that share attached.

    Parameters
    ----------
    design : callable
        Takes a share from 0 to 1, returns the Building designed with it, or two in x and y; floor masses without goods.
    blocks : iterable of Block
        The goods, the same for every design.
    racks : iterable of Rack, optional
        Racks with goods, the same for every design; shares above 1 are not sought.
    base : SlidingBase, optional
        Base that slides under every design.
    motions, statistic, drift_cap, damping, fractions, target, confidence, resamples, seed, threads, progress
        As for `effective_mass`.

    Returns
    -------
    EffectiveMass
        With the drifts of the real building in `curve` changing with the share. `kind` "stuck": no goods slide in the
        building designed with share 1.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError, KeyboardInterrupt
        As for `effective_mass`.

    Examples
    --------
    >>> import seismass as sm
    >>> def design(share):
    ...     strength = [0.2 + 0.13 * share, 0.16 + 0.11 * share, 0.1 + 0.04 * share]
    ...     return sm.Building.uniform(3, 0.47, yield_shear_over_weight=strength)
    >>> goods = sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2)
    >>> suite = [record.scaled(2.0) for record in sm.builtin_suite()]
    >>> 0.0 <= sm.effective_mass_of_design(design, goods, suite).value <= 1.0
    True
    """
    parameters = (statistic, damping, fractions, confidence, resamples, seed, threads, progress)
    options = checked_options(*parameters, LARGER, drift_cap, target)
    rule: Any = design
    if callable(rule):
        rule = cache(rule)
    first: Any = rule(0.0) if callable(rule) else None
    in_plane = isinstance(first, tuple) and len(first) == 2 and all(isinstance(each, Building) for each in first)
    named = named_motions(motions, OWNER, Scene(first[0], other_direction=first[1]) if in_plane else None)
    return solved_designs(rule, blocks, named, options, racks, base=base).answer()


TABLE_OWNER: Final = "effective mass table"
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
    named, shares = named_motions(motions, TABLE_OWNER), check_fractions(fractions, TABLE_OWNER)
    convention, cap = check_damping(damping, TABLE_OWNER), check_cap(drift_cap, TABLE_OWNER)
    as_one_of(store, StoredResults, "store", TABLE_OWNER, InvalidOption)
    if not (isinstance(scenes, Grid) or is_list(scenes)) or not len(scenes):
        raise refusal(InvalidOption, "scenes", TABLE_OWNER, "a Grid or a list of Scenes", brief(scenes))
    if isinstance(scenes, Grid) and {"scale", "motion"} & set(scenes.table(1, 1).columns):
        raise refusal(InvalidOption, "scenes", TABLE_OWNER, "a grid without scale and motion", brief(scenes))
    stages = Progress(progress, len(scenes) * (1 + len(shares)) * len(named), TABLE_OWNER)
    how: dict[str, Any] = {"drift_cap": cap, "threads": as_threads(threads, TABLE_OWNER)}
    _, count, start = as_bootstrap(0.9, resamples, seed, TABLE_OWNER)
    bootstrap: dict[str, Any] = {"cluster_of": named.cluster_of, "resamples": count, "seed": start}

    def part(first: int) -> pl.DataFrame:
        numbers = range(first, min(first + _AT_ONCE, len(scenes)))
        several = [scenes.scene(i + 1) if isinstance(scenes, Grid) else scenes[i] for i in numbers]
        listed = [check_loaded(scene, TABLE_OWNER) for scene in several]
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
