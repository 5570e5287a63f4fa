"""The models that an assessment compares, and their runs as one table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.assessment.own_building import OwnBuilding
from seismass.base.errors import SimulationError
from seismass.base.values import FloatArray
from seismass.effective_mass.models import base_of_model, frame_mass
from seismass.media.roles import MODELS
from seismass.model.motion import MotionLike
from seismass.model.scene import Scene
from seismass.runs.batch import solve_many
from seismass.runs.plane_motion import MotionPair
from seismass.spectra import TargetSpectrum

REAL: Final = "real"
REAL_LOW: Final = "real_mu_low"
REAL_HIGH: Final = "real_mu_high"
REALS: Final = (REAL, REAL_LOW, REAL_HIGH)
"""Models with goods that slide, by their friction: as stated, its lower and its upper bound."""
ADVISED: Final = "advised"
CODE: Final = "code"
ATTACHED: Final = "attached"
BARE: Final = "bare"
_SLIPS: Final = ("peak_slip", "residual_slip", "slip_path")
NAMES: Final = {name: MODELS[name].name for name in (*REALS, ADVISED, CODE, ATTACHED, BARE)}
"""What texts and figures call the models."""


def friction_factors(building: OwnBuilding) -> dict[str, float]:
    """Return the factor of friction of each model with goods that slide; equal ones once."""
    low, high = building.mu_factors
    factors = {REAL: 1.0, REAL_LOW: low, REAL_HIGH: high}
    return {name: factor for name, factor in factors.items() if name == REAL or factor != 1.0}


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
    real = building.scene(target)
    bare = with_mass(real, np.zeros(building.storeys))
    if not (building.goods > 0.0).any():
        return {BARE: bare}
    reals = {name: building.scene(target, mu_factor=factor) for name, factor in friction_factors(building).items()}
    attached = {} if advised is None else {ADVISED: with_mass(real, advised * building.goods)}
    return {
        **reals,
        **attached,
        CODE: with_mass(real, building.code_mass),
        ATTACHED: with_mass(real, building.goods),
        BARE: bare,
    }


def solve_models(
    building: OwnBuilding,
    scenes: dict[str, Scene],
    motions: Sequence[MotionLike | MotionPair],
    names: Sequence[str],
    *,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> tuple[pl.DataFrame, pl.DataFrame]:
    """Solve all models under all motions. Return one row per model, motion and storey, and one per model with goods
    that slide, motion and kind of loose goods. In two directions drift and shear are the larger of both.
    """
    table = solve_many(list(scenes.values()), list(motions), threads=threads, progress=progress)
    runs, in_plane = table.to_dicts(), "peak_drift_x" in table.columns
    rows: list[dict[str, Any]] = []
    slides: list[dict[str, Any]] = []
    for index, run in enumerate(runs):
        model, motion = list(scenes)[index // len(motions)], index % len(motions)
        if run["status"] == "failed":
            raise SimulationError(f"run of model {model} under motion {motion + 1}, {names[motion]}: {run['reason']}")
        collapsed = run["status"] == "collapsed"
        about = {"model": model, "motion": motion + 1, "collapsed": collapsed}
        blocks = building.sliding if scenes[model].goods else ()
        slides += [
            {**about, "kind": kind, "level": level, **{name: run[name][block] for name in _SLIPS}}
            for block, (kind, level) in enumerate(blocks)
        ]
        for storey in range(1, building.storeys + 1):
            of_floor = [
                run["peak_slip"][i] for i, (kind, _) in enumerate(blocks) if building.loose[kind].floor == storey
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
    schema: dict[str, Any] = {"motion": pl.UInt32, "storey": pl.UInt32}
    schema |= dict.fromkeys(("peak_drift_ratio", "peak_slip", "peak_base_slip"), pl.Float64)
    of_kinds: dict[str, Any] = {"model": pl.String, "motion": pl.UInt32, "collapsed": pl.Boolean}
    of_kinds |= dict.fromkeys(("kind", "level"), pl.UInt32)
    return (
        pl.DataFrame(rows, schema_overrides=schema),
        pl.DataFrame(slides, schema=of_kinds | dict.fromkeys(_SLIPS, pl.Float64)),
    )


def _larger(run: dict[str, Any], name: str, place: int, in_plane: bool) -> float:
    """A peak of a storey; in two directions the larger of both."""
    values = [run[f"{name}_{axis}"][place] for axis in "xy"] if in_plane else [run[name][place]]
    return float(max(values))
