"""What an assessment says of the structure: the design of its strengths; racks, walls, stops and a sliding base."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.assessment.building import OwnBuilding
from seismass.assessment.floors import CONTACT_PERIOD
from seismass.assessment.models import NAMES, SLIDING_ALL
from seismass.base.units import STANDARD_GRAVITY, Units
from seismass.base.values import FloatArray
from seismass.effective_mass import EffectiveMass
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.simulate import simulate

NOT_APPLIED: Final = "The rule by hand is not applied"
"""How the advice on the rule begins."""


def beyond_rule(building: OwnBuilding) -> tuple[str, ...]:
    """Return what a building has that the rule by hand does not know."""
    parts = {
        "racks": any(kind.rack is not None for kind in building.present),
        "walls": building.walls is not None,
        "stops": any(kind.stops is not None for kind in building.present),
        "a sliding base": building.base is not None,
    }
    return tuple(name for name, has in parts.items() if has)


def rule_advice(building: OwnBuilding, effective: EffectiveMass | None) -> tuple[str, ...]:
    """Return that the rule by hand is not applied, beside what the runs give at the stated friction; or nothing."""
    unknown = beyond_rule(building)
    if not unknown or effective is None or math.isnan(effective.value):
        return ()
    value, share = effective.value, effective.by_hand.estimate
    words = "more than it says" if value > share + 0.005 else "at most what it says"
    return (
        f"{NOT_APPLIED}, since it does not know {' and '.join(unknown)}: it would give {share:.2f} "
        f"of the goods present, and the runs with them give {value:.2f}, {words}.",
    )


def slip_of_base(runs: pl.DataFrame) -> dict[str, Any] | None:
    """Return mean, median, 84 % and largest slip of a sliding base (m) over the motions without a collapse, at the
    friction of goods at which it slips most; None on firm ground.
    """
    of_base = runs.filter((pl.col("storey") == 1) & ~pl.col("collapsed")).drop_nulls("peak_base_slip")
    drifts = (
        of_base.filter(pl.col("model").is_in(SLIDING_ALL))
        .group_by("model", maintain_order=True)
        .agg(
            mean=pl.col("peak_base_slip").mean(),
            median=pl.col("peak_base_slip").median(),
            p84=pl.col("peak_base_slip").quantile(0.84, "linear"),
            most=pl.col("peak_base_slip").max(),
            motions=pl.len(),
        )
        .sort("p84", descending=True)
    )
    return drifts.row(0, named=True) if drifts.height else None


def base_advice(runs: pl.DataFrame, units: Units) -> list[str]:
    """Return how far a sliding base slips, or nothing."""
    row = slip_of_base(runs)
    if row is None:
        return []
    mean, p84, most = (units.text("slip", row[name]) for name in ("mean", "p84", "most"))
    return [
        f"The base slips {mean} in the mean of {row['motions']} motions, up to {p84} under 84 % of them and {most} at "
        f"most ({NAMES[row['model']]}): what crosses the joint must follow."
    ]


def support_remarks(building: OwnBuilding) -> list[str]:
    """Return what is assumed of racks, walls, stops and a sliding base, sentence by sentence."""
    lines = []
    for kind in building.present:
        rack, what = kind.rack, f"{kind.name or 'goods'} on floor {kind.floor}"
        if rack is not None:
            strength = "elastic" if rack.strength is None else f"V_y = {rack.strength:g} of its weight"
            lines.append(
                f"Racks: {what} evenly on {rack.levels} levels, T = {rack.period:g} s with frame and goods "
                f"({rack.how}), frame of {100.0 * rack.frame:g} % of the goods, {100.0 * rack.damping:g} % damping, "
                f"{strength}; they do not uplift, and goods do not fall off."
            )
        if kind.stops is not None:
            how = (
                f"elastic with a period of {CONTACT_PERIOD:g} s (none was stated)"
                if kind.stops.stiffness is None
                else building.shown.text("stiffness", kind.stops.stiffness, ".4g")
            )
            lines.append(
                f"Stops: {what} meet them after {building.shown.text('slip', kind.stops.clearance, '.4g')} of "
                f"slip, {how}."
            )
    if building.walls is not None:
        lines.append(
            f"Walls: {building.walls_stated}; elastic, and in the damping of every mode. Beside them storeys have no "
            "stability coefficient of their own."
        )
    if building.base is not None:
        base = building.base
        slab = base.slab_mass(Building(building.mass, building.stiffness, yield_shear=np.inf))
        surface = "flat" if base.radius is None else f"a pendulum of R = {building.shown.text('height', base.radius)}"
        lines.append(
            f"Base: slides on the ground with mu_s = {base.mu_s:g} and mu_k = {base.mu_k:g} as stated, without bounds, "
            f"{surface}, slab of {building.shown.text('mass', slab, '.3g')}; it sticks exactly, and damping is that of "
            "the building fixed at it. Its friction is that of the whole weight in every model. Period and scaling are "
            "of the building fixed at its base unless stated."
        )
    return lines


MAX_RATIO: Final = 1.5
"""Peak of spring and damping force of a storey over that of its spring force: 1.15 to 1.2 in ordinary frames."""


def force_ratios(scene: Scene, motions: list[Any]) -> FloatArray:
    """Return the mean over the motions of each storey's peak of spring plus damping force (the inertia force of all
    above) over the peak of its spring force, shape (storeys,); 1 for a storey without a force.
    """
    building = scene.building
    assert building is not None
    matrix = building.damping_matrix
    ratios = []
    for motion in motions:
        response = simulate(scene, getattr(motion, "motion", motion), histories=True, events=False)
        forces = response.floor_velocity @ matrix.T
        damping = np.cumsum(forces[:, ::-1], axis=1)[:, ::-1]
        springs = response.storey_shear
        spring = np.abs(springs).max(axis=0)
        both = np.abs(springs + damping).max(axis=0)
        ratios.append(np.divide(both, spring, out=np.ones(len(spring)), where=spring > 0.0))
    mean: FloatArray = np.mean(ratios, axis=0)
    return mean


def damping_doubts(scene: Scene, motions: list[Any]) -> tuple[str, ...]:
    """Return a sentence about the storey whose damping carries most, where it carries too much."""
    ratios = force_ratios(scene, motions)
    storey = int(np.argmax(ratios))
    if ratios[storey] <= MAX_RATIO:
        return ()
    return (
        f"spring and damping of storey {storey + 1} carry {ratios[storey]:.2g} times the peak force of its spring (1.2 "
        "in ordinary frames): damping carries what the yielding storey cannot; is it a slider, a mat or far stiffer "
        "than the others?",
    )


def design_table(building: OwnBuilding, target: TargetSpectrum | None) -> pl.DataFrame:
    """Return one row per quantity of the design of the strengths, as `DesignEntry` has them; of stated strengths W, T
    and V_y. Two directions stand below each other, with their `direction`.
    """
    if building.other is None:
        return _design_of_direction(building, target).with_columns(direction=pl.lit(""))
    both = {"x": _design_of_direction(building, target), "y": _design_of_direction(building.other, target)}
    return pl.concat([table.with_columns(direction=pl.lit(name)) for name, table in both.items()])


def _design_of_direction(building: OwnBuilding, target: TargetSpectrum | None) -> pl.DataFrame:
    """The table of one direction; W has the clause of the code's fraction."""
    designed = building.design is not None
    table = building.code_design(target).table() if designed else _stated(building, target)
    stated = building.design is not None and building.design.fraction is not None
    words = f"floors and {building.design_fraction:.3g} of the design live load" + ", as stated" * stated
    code, of_weight = building.code, pl.col("quantity") == "W"
    columns = {
        "clause": "" if stated else code.clause,
        "status": "" if stated else code.status,
        "note": words,
    }
    return table.with_columns(
        pl.when(of_weight).then(pl.lit(value)).otherwise(name).alias(name) for name, value in columns.items()
    )


def _stated(building: OwnBuilding, target: TargetSpectrum | None) -> pl.DataFrame:
    """The table of strengths that are stated."""
    weight = STANDARD_GRAVITY * float((building.mass + building.frames + building.code_mass).sum())
    strength = building.structure(target).yield_shear
    storeys = range(1, len(strength) + 1)
    return pl.DataFrame(
        {
            "quantity": ["W", "T_1", *("V_y" for _ in storeys), "V_y/W"],
            "storey": pl.Series([None, None, *storeys, None], dtype=pl.UInt32),
            "value": [weight, building.period(building.code_mass), *strength, float(strength[0]) / weight],
            "unit": ["N", "s", *("N" for _ in storeys), ""],
            "clause": "",
            "status": "",
            "note": ["", "first period with W", *("as stated" for _ in storeys), "storey 1"],
        }
    )
