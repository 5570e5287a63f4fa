"""What an assessment says of racks, walls and stops: what was assumed of them, and that the rule by period fails."""

from __future__ import annotations

import math
from typing import Final

from seismass.assessment.own_building import OwnBuilding
from seismass.assessment.racks import CONTACT_PERIOD
from seismass.effective_mass import EffectiveMass

NOT_APPLIED: Final = "The rule by period is not applied"
"""How the advice on the rule begins."""


def beyond_rule(building: OwnBuilding) -> tuple[str, ...]:
    """Return what a building has that the rule by period does not know."""
    parts = {
        "racks": any(kind.rack is not None for kind in building.present),
        "walls": building.walls is not None,
        "stops": any(kind.stops is not None for kind in building.present),
    }
    return tuple(name for name, has in parts.items() if has)


def rule_advice(building: OwnBuilding, effective: EffectiveMass | None) -> tuple[str, ...]:
    """Return that the rule by period is not applied, beside what the runs give at the stated friction; or nothing."""
    unknown = beyond_rule(building)
    if not unknown or effective is None or math.isnan(effective.value):
        return ()
    value, low, high = effective.value, effective.estimate, effective.conservative
    found = "more than it says" if value > high + 0.005 else "less than it says" if value < low - 0.005 else "within it"
    return (
        f"{NOT_APPLIED}, since it does not know {' and '.join(unknown)}: it would give {low:.2f} at best and "
        f"{high:.2f} to be safe of the goods present, and the runs with them give {value:.2f}, {found}.",
    )


def about_support(building: OwnBuilding) -> list[str]:
    """Return what is assumed of racks, walls and stops, sentence by sentence."""
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
                else f"{1e-3 * kind.stops.stiffness:g} kN/m"
            )
            lines.append(f"Stops: {what} meet them after {1e3 * kind.stops.clearance:g} mm of slip, {how}.")
    if building.walls is not None:
        lines.append(
            f"Walls: {building.walls_stated}; elastic, and in the damping of every mode. Beside them storeys have no "
            "stability coefficient of their own."
        )
    return lines
