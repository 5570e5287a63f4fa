"""The models that an assessment compares, and their runs as one table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.assessment.building import OwnBuilding
from seismass.assessment.file_parts import PERIOD_MASSES
from seismass.base.arguments import ProgressLike
from seismass.base.errors import InvalidOption, SimulationError
from seismass.base.statistics import or_infinite
from seismass.base.values import FloatArray, as_number
from seismass.design.scaling import ScalingResult, scale_by_code
from seismass.design.scaling.asce7 import period_of_mass
from seismass.effective_mass.models import base_of_model, frame_mass
from seismass.effective_mass.rule import by_hand
from seismass.effective_mass.search import OWNER
from seismass.media.result import table_schema
from seismass.media.roles import MODELS
from seismass.model.codes import NOT_CHECKED, VERIFIED
from seismass.model.scene import Scene
from seismass.motions.motion import MotionLike
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.batch import EngineRuns, solve_many
from seismass.runs.peaks import named_motions, solve
from seismass.runs.plane import MotionPair

SLIDING: Final = "real"
SLIDING_LOW: Final = "real_mu_low"
SLIDING_HIGH: Final = "real_mu_high"
SLIDING_ALL: Final = (SLIDING, SLIDING_LOW, SLIDING_HIGH)
"""Models with goods that slide, by their friction: as stated, its lower and its upper bound."""
ADVISED: Final = "advised"
CODE: Final = "code"
ATTACHED: Final = "attached"
BARE: Final = "bare"
_SLIPS: Final = ("peak_slip", "residual_slip", "slip_path")
NAMES: Final = {name: MODELS[name].name for name in (*SLIDING_ALL, ADVISED, CODE, ATTACHED, BARE)}
"""What texts and figures call the models."""


def friction_factors(mu_factors: tuple[float, float]) -> dict[str, float]:
    """Return the factor of friction of each model with goods that slide; equal ones once."""
    low, high = mu_factors
    factors = {SLIDING: 1.0, SLIDING_LOW: low, SLIDING_HIGH: high}
    return {name: factor for name, factor in factors.items() if name == SLIDING or factor != 1.0}


def with_mass(scene: Scene, attached: FloatArray) -> Scene:
    """Return a building with masses attached to its floors (kg) and no goods that slide. Stiffness, strength, damping
    matrix, P/h and the friction of a sliding base stay those of the real building.
    """
    if scene.other_direction is not False:
        x, y = (with_mass(each, attached) for each in scene._directions())
        other = y.building
        assert other is not None
        return Scene(x.building, other_direction=other, collapse_drift=scene.collapse_drift, name=scene.name)
    building = scene.building
    assert building is not None
    mass = building.mass + frame_mass(scene) + attached
    changes: dict[str, Any] = {"mass": mass, "damping": building.damping_matrix}
    if scene.geometric_stiffness.any():
        changes |= {"gravity_load": None, "geometric_stiffness": scene.geometric_stiffness}
    return Scene(
        building.replace(**changes),
        base=base_of_model(scene, mass),
        collapse_drift=scene.collapse_drift,
        name=scene.name,
    )


def compared_models(building: OwnBuilding, target: TargetSpectrum | None, advised: float | None) -> dict[str, Scene]:
    """Return the scenes that are compared, by name; without goods the bare building alone. `advised` is the share of
    the goods attached in the advised model; None leaves it out.
    """
    sliding_scene = building.scene(target)
    bare = with_mass(sliding_scene, np.zeros(building.storeys))
    if not (building.goods_mass > 0.0).any():
        return {BARE: bare}
    by_factor = {
        name: building.scene(target, mu_factor=factor) for name, factor in friction_factors(building.mu_factors).items()
    }
    attached = {} if advised is None else {ADVISED: with_mass(sliding_scene, advised * building.goods_mass)}
    return {
        **by_factor,
        **attached,
        CODE: with_mass(sliding_scene, building.code_mass),
        ATTACHED: with_mass(sliding_scene, building.goods_mass),
        BARE: bare,
    }


def solve_models(
    building: OwnBuilding,
    scenes: dict[str, Scene],
    motions: Sequence[MotionLike | MotionPair],
    names: Sequence[str],
    *,
    threads: int | None = None,
    progress: ProgressLike = None,
    known: EngineRuns | None = None,
) -> tuple[pl.DataFrame, pl.DataFrame]:
    """Solve all models, of which the first may be `known`, under all motions: a row per model, motion and storey, and
    one per model with goods that slide, motion and kind. In two directions drift and shear are the larger of both.
    """
    table = solve_many(list(scenes.values()), list(motions), threads=threads, progress=progress, known=known)
    runs, in_plane, factors = table.to_dicts(), "peak_drift_x" in table.columns, friction_factors(building.mu_factors)
    rows: list[dict[str, Any]] = []
    slides: list[dict[str, Any]] = []
    for index, run in enumerate(runs):
        model, motion = list(scenes)[index // len(motions)], index % len(motions)
        if run["status"] == "failed":
            raise SimulationError(f"run of model {model} under motion {motion + 1}, {names[motion]}: {run['reason']}")
        collapsed = run["status"] == "collapsed"
        labels = {"model": model, "motion": motion + 1, "collapsed": collapsed}
        factor = factors.get(model, 1.0)
        blocks = building.sliding(factor) if scenes[model].goods else ()
        slides += [
            {**labels, "kind": kind, "level": level, **{name: run[name][block] for name in _SLIPS}}
            for block, (kind, level) in enumerate(blocks)
            if building.loose[kind].model(factor) == "slide"
        ]
        for storey in range(1, building.storeys + 1):
            of_floor = [
                run["peak_slip"][block]
                for block, (kind, _) in enumerate(blocks)
                if building.loose[kind].floor == storey and building.loose[kind].model(factor) == "slide"
            ]
            of_directions = {}
            if in_plane:
                of_directions = {f"peak_drift_{axis}": run[f"peak_drift_{axis}"][storey - 1] for axis in "xy"}
            drift, shear = (_larger(run, name, storey - 1, in_plane) for name in ("peak_drift", "peak_storey_shear"))
            rows.append(
                {
                    "model": model,
                    "motion": motion + 1,
                    "record": names[motion],
                    "status": run["status"],
                    "collapsed": collapsed,
                    "storey": storey,
                    "peak_drift": drift,
                    "peak_drift_ratio": None if building.heights is None else drift / building.heights[storey - 1],
                    "residual_drift": run["residual_drift"][storey - 1],
                    "peak_storey_shear": shear,
                    "peak_floor_acceleration": run["peak_floor_acceleration"][storey - 1],
                    "peak_slip": max(of_floor, default=None),
                    "peak_base_slip": run.get("peak_base_slip"),
                    **of_directions,
                }
            )
    return (
        pl.DataFrame(rows, schema_overrides=table_schema("assessment", "runs")),
        pl.DataFrame(slides, schema=table_schema("assessment", "slips")),
    )


def _larger(run: dict[str, Any], name: str, place: int, in_plane: bool) -> float:
    """A peak of a storey; in two directions the larger of both."""
    values = [run[f"{name}_{axis}"][place] for axis in "xy"] if in_plane else [run[name][place]]
    return float(max(values))


WORDS: Final = {
    "bare": "no goods",
    "code share": "the code's share of the live load",
    "all": "all goods present",
}
"""What acts as mass in a period."""


def period_sentences(building: OwnBuilding, target: TargetSpectrum | None, motions: list[Any]) -> tuple[str, ...]:
    """Return which mass acts in the stated period, its source, and the share by hand for other masses; None where
    stiffnesses were stated.
    """
    if building.stated_period is None:
        return ()
    rule = building.period_rule
    source = "as stated"
    if rule is not None:
        checked = rule.status if rule.status == VERIFIED else f"{rule.status}; {NOT_CHECKED}"
        size = "storeys" if rule.variable == "storeys" else "height in m"
        source = (
            f"{rule.coefficient:g} h^{rule.exponent:g} with h the {size}, {rule.code}, {rule.clause}, {rule.system} "
            f"({checked})"
        )
    sentences = [
        f"Period: {building.stated_period:.3g} s, {source}, taken with {WORDS[building.period_mass]} as mass; "
        f"{building.period():.3g} s without goods, {building.period(building.goods_mass):.3g} s with all of them."
    ]
    if rule is not None:
        sentences.append(
            "Formulas of codes give short periods, for forces on the safe side: drifts are then on the unsafe side, "
            "and the share is that of a stiff building; state a calculated period (period_s) where there is one."
        )
    if (building.goods_mass > 0.0).any():
        shares = {mass: _by_hand(_with_period_of(building, mass), target, motions) for mass in PERIOD_MASSES}
        others = ", ".join(
            f"{share:.2f} were it that with {WORDS[mass]}"
            for mass, share in shares.items()
            if mass != building.period_mass
        )
        sentences.append(
            f"The rule by hand gives a share of {shares[building.period_mass]:.2f} for this period, {others}, under "
            "the same motions."
        )
    return tuple(sentences)


def _with_period_of(building: OwnBuilding, mass: str) -> OwnBuilding:
    """The building whose stated period is that with another mass."""
    counted: dict[str, FloatArray] = {
        "bare": 0.0 * building.mass,
        "code share": building.code_mass,
        "all": building.goods_mass,
    }
    assert building.stated_period is not None
    factor = (building.period(counted[mass]) / building.stated_period) ** 2
    return replace(building, stiffness=factor * building.stiffness, period_mass=mass)


def _by_hand(building: OwnBuilding, target: TargetSpectrum | None, motions: list[Any]) -> float:
    scene = building.scene(target)
    level = None if target is None else building.motion_target(target)
    return by_hand(scene, named_motions(motions, OWNER, scene), level).estimate


class Shown(NamedTuple):
    """What is shown of a building.

    Attributes
    ----------
    scene : Scene
        The building with its goods.
    motion : Record or Pair
        The motion, scaled.
    number : int
        Its number in the suite, from 1.
    factor : float
        By which it is scaled.
    slides : bool
        Whether goods slide under some motion.
    """

    scene: Scene
    motion: Any
    number: int
    factor: float
    slides: bool


def median_of(slides: bool) -> str:
    """Say which motion is shown; `slides` tells whether goods slide under some of them."""
    return f"median drift of {'those under which goods slide' if slides else 'all, as no goods slide under any'}"


def motion_of_runs(runs: pl.DataFrame) -> int:
    """Return the number (from 0) of the motion of median drift among those under which goods slide without a collapse,
    or among all where there are none, by the first model of the table of runs.
    """
    rows = runs.filter(pl.col("model") == runs["model"][0])
    by_motion = rows.group_by("motion", maintain_order=True).agg(
        pl.col("collapsed").any(), pl.col("peak_drift").max(), slides=(pl.col("peak_slip") > 0.0).any()
    )
    drift = or_infinite(by_motion["peak_drift"].to_numpy(), by_motion["collapsed"].to_numpy())
    slides = by_motion["slides"].fill_null(value=False).to_numpy() & np.isfinite(drift)
    return _median(drift, np.flatnonzero(slides) if slides.any() else np.arange(len(drift)))


def _median(drift: FloatArray, among: NDArray[np.int64]) -> int:
    """Place of the median drift among some."""
    ordered = among[np.argsort(drift[among], kind="stable")]
    return int(ordered[(len(ordered) - 1) // 2])


def shown_motion(scene: Scene, scaled: list[Any], factors: FloatArray) -> Shown:
    """Return the scaled motion of median largest drift among those under which goods slide, else among all."""
    peaks = solve([scene], named_motions(scaled, "animation", scene))
    among = np.flatnonzero(peaks.slides[0]) if peaks.slides.any() else np.arange(len(scaled))
    place = _median(peaks.largest[0], among)
    return Shown(scene, scaled[place], place + 1, float(factors[place]), bool(peaks.slides.any()))


def scaled_to_site(
    building: OwnBuilding,
    motions: Iterable[Any],
    target: TargetSpectrum | None = None,
    period: float | None = None,
    *,
    threads: int | None = None,
) -> ScalingResult:
    """Return the factors of the building's rule of scaling for the period T (s) that is given, else that of the file,
    else the first with the goods attached, in two directions over both of them. `target` replaces the site spectrum.
    """
    stated = building.scaling_period
    if period is not None:
        stated = as_number(period, "scaling_period", "assessment", InvalidOption)
    directions = [each for each in (building, building.other) if each is not None]
    modes = [each.modes(building.goods_mass) for each in directions] if stated is None else []
    periods = [float(each.periods[0]) for each in modes] if stated is None else [stated]
    return scale_by_code(
        motions,
        building.motion_target(target),
        max(periods),
        code_id=building.scaling_code,
        shortest_period=min(periods),
        lowest_period=min(map(period_of_mass, modes), default=None),
        ductility=None if building.design is None else building.design.R,
        between=False,
        threads=threads,
    )
