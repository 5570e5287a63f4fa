"""Drifts that several answers have in common: models do not depend on friction, nor drifts on the statistic."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import FloatArray, brief, refusal
from seismass.effective_mass.beyond import SHARES_BEYOND, goes_beyond
from seismass.effective_mass.curve import Statistic
from seismass.effective_mass.models import attached, check_any_load
from seismass.effective_mass.result import EffectiveMass
from seismass.effective_mass.runs import NamedMotions, Peaks, Stages, solve
from seismass.effective_mass.search import OWNER, Options, Search
from seismass.model.block import Block
from seismass.model.building import Building
from seismass.model.rack import Rack
from seismass.model.scene import Scene
from seismass.model.sliding_base import SlidingBase

Designed: TypeAlias = Building | tuple[Building, Building]
"""What a design gives: a building, or the same one in x and in y."""


@dataclass(frozen=True, slots=True)
class Solved:
    """Peaks of a real building (one scene, or one per share) and of its models at every share of a grid; answers need
    few further runs.
    """

    search: Search
    real: Peaks
    model: Peaks
    question: str

    def answer(self, statistic: Statistic | None = None) -> EffectiveMass:
        """Return the effective fraction, by the statistic of the options where none is given."""
        search = self.search
        if statistic is not None:
            search = replace(search, options=replace(search.options, statistic=statistic))
        return search.answer(self.real, self.model, {"question": self.question})


def solved_frictions(scenes: Sequence[Scene], motions: NamedMotions, options: Options) -> list[Solved]:
    """Solve a building with its goods at several frictions; its models, which have none, are solved once. The scenes
    differ in friction alone and have goods on their floors.
    """
    checked = [check_any_load(scene) for scene in scenes]
    first, shares = checked[0], options.fractions
    how: dict[str, Any] = {"drift": options.drift, "threads": options.threads}
    for number, scene in enumerate(checked[1:], start=2):
        if attached(scene, 1.0, options.damping) != attached(first, 1.0, options.damping):
            requirement = "the building and goods of scene 1 but for friction"
            raise refusal(InvalidScene, f"scene {number}", OWNER, requirement, "others")
    larger = SHARES_BEYOND if any(goes_beyond(scene) for scene in checked) else SHARES_BEYOND[:0]
    stages = Stages(options.progress, (len(checked) + len(shares) + len(larger)) * len(motions))
    reals = solve(checked, motions, **how, progress=stages.next(len(checked) * len(motions)))
    models = [attached(first, share, options.damping) for share in shares]
    model = solve(models, motions, **how, progress=stages.next(len(models) * len(motions)))
    beyond = None
    if len(larger):
        models = [attached(first, share, options.damping) for share in larger]
        beyond = solve(models, motions, **how, progress=stages.next(len(models) * len(motions)))
    beside: dict[float, Peaks] = {}

    def model_at(share: float) -> Peaks:
        if share not in beside:
            beside[share] = solve([attached(first, share, options.damping)], motions, **how)
        return beside[share]

    def of(number: int, scene: Scene) -> Solved:
        real = reals.one(number)
        search = Search(motions, options, lambda share: (real, model_at(share)), lambda _: scene, beyond)
        return Solved(search, real, model, "given building")

    return [of(number, scene) for number, scene in enumerate(checked)]


def solved_designs(
    design: Callable[[float], Designed],
    blocks: Iterable[Block],
    motions: NamedMotions,
    options: Options,
    racks: Iterable[Rack] = (),
    collapse_drift: FloatArray | None = None,
    base: SlidingBase | None = None,
) -> Solved:
    """Solve the building that is designed with each share, with sliding goods and with that share attached; arguments
    as in `effective_mass_of_design`.
    """
    if not callable(design):
        requirement = "a callable that takes a share and returns a Building"
        raise refusal(InvalidOption, "design", OWNER, requirement, brief(design))
    goods, standing = tuple(blocks), tuple(racks)
    how: dict[str, Any] = {"drift": options.drift, "threads": options.threads}

    def designed(share: float) -> Scene:
        building: Any = design(share)
        other: Any = False
        if isinstance(building, tuple) and len(building) == 2:
            building, other = building
        if not isinstance(building, Building):
            raise refusal(InvalidScene, "design", OWNER, "a Building, or two in x and y", brief(building))
        scene = Scene(building, goods, racks=standing, base=base, other_direction=other, collapse_drift=collapse_drift)
        return check_any_load(scene)

    shares = [float(share) for share in options.fractions]
    stages = Stages(options.progress, 2 * len(shares) * len(motions))
    scenes = [designed(share) for share in shares]
    if len({scene.storeys for scene in scenes}) > 1:
        requirement = "a Building of the same number of storeys for every share"
        raise refusal(InvalidScene, "design", OWNER, requirement, "different ones")
    runs = len(scenes) * len(motions)
    real = solve(scenes, motions, **how, progress=stages.next(runs))
    models = [attached(scene, share, options.damping) for scene, share in zip(scenes, shares, strict=True)]
    model = solve(models, motions, **how, progress=stages.next(runs))

    def at(share: float) -> tuple[Peaks, Peaks]:
        scene = designed(share)
        both = (
            solve([scene], motions, **how),
            solve([attached(scene, share, options.damping)], motions, **how),
        )
        return both

    return Solved(Search(motions, options, at, designed), real, model, "design rule")
