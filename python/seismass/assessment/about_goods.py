"""What an assessment says of the goods that are present, of those that are bolted, and of what a code counts."""

from __future__ import annotations

import numpy as np

from seismass.assessment.answer import presence_sentence
from seismass.assessment.floors import BY_RULE, LARGER, NOTHING_STATED, FloorGoods
from seismass.assessment.own_building import OwnBuilding
from seismass.base.units import STANDARD_GRAVITY
from seismass.media.text_table import numbers_text
from seismass.model.friction import BOUND_FACTORS, BOUNDS_SOURCE, friction_pair
from seismass.model.occupancy import STORAGE, USUAL, surveyed_load


def about_code_mass(building: OwnBuilding) -> list[str]:
    """Return remarks on floors that the code exempts, and those of ordinary use that are taken as full."""
    found = [
        f"floor {floor} is {one.exception} ({building.code.clause}): nothing of its live load counts for the code; "
        "exempt = false in its table counts it"
        for floor, one in enumerate(building.counted, start=1)
        if one.exception.startswith(BY_RULE)
    ]
    found += [
        f"floor {floor}: {one.fraction:g} of its live load is {one.exception}, more than the use that is stated has; "
        "fraction in its table states another"
        for floor, one in enumerate(building.counted, start=1)
        if one.exception.startswith(LARGER)
    ]
    code = building.code
    if code.low < code.high:
        found.append(
            f"{code.code} has {code.low:g} to {code.high:g} for the use {code.use}, and {code.fraction:g} is taken: "
            f"{code.note} (another use, or fraction)"
        )
    uses = [one.use or building.code.use for one in building.floor_codes]
    if any(
        kind.presence.endswith(NOTHING_STATED) and kind.mass and uses[kind.floor - 1] in ("storage", "archive")
        for kind in building.loose
    ):
        found.append(
            f"floors of storage are full, {NOTHING_STATED}: surveys find {surveyed_load(STORAGE).share:.2f} of "
            "the design live load in light storage, and how much is there moves the answer more than the mechanics "
            "do (occupied, or occupancy)"
        )
    full = [
        str(kind.floor)
        for kind in building.loose
        if uses[kind.floor - 1] == "ordinary" and kind.occupied == 1.0 and kind.mass
    ]
    if full:
        usual = surveyed_load(USUAL)
        found.append(
            f"all of the ordinary live load of floor {', '.join(dict.fromkeys(full))} is taken as rigid goods that are "
            f"there: surveys find {usual.share:.2f} of it in offices (occupied, or occupancy)"
        )
    return found


def about_goods(building: OwnBuilding) -> list[str]:
    """Return what is assumed of the goods, sentence by sentence."""
    there = [kind for kind in building.loose if kind.mass > 0.0]
    fixed = _about_bolted(building)
    if not there:
        return fixed
    low, high = building.mu_factors
    pairs = [friction_pair(name) for name in dict.fromkeys(kind.contact for kind in there) if name]
    contacts = ", ".join(f"{pair.pair_id} ({pair.source}; {pair.kind})" for pair in pairs) or "as stated"
    several = len({kind.floor for kind in there}) < len(there)
    lines = [
        *fixed,
        f"Goods: rigid blocks that slide by Coulomb friction, one per {'kind and ' * several}floor; they do not rock, "
        "topple or strike.",
        f"Friction: {contacts}; mu {numbers_text(np.array([kind.mu_s for kind in there]))} static, "
        f"{numbers_text(np.array([kind.mu_k for kind in there]))} kinetic.",
    ]
    if (low, high) != (1.0, 1.0):
        source = BOUNDS_SOURCE if (low, high) == BOUND_FACTORS else "as stated"
        lines.append(f"Bounds of friction: {low:g} and {high:g} times mu ({source}); high for mass, low for slip.")
    return [
        *lines,
        _about_presence(building, there),
        "Effective fraction: smallest share with a mean largest drift not below that with sliding goods, there and at "
        "every larger share; its interval resamples the motions, and is 0.05 wider at each end for another suite.",
    ]


def _about_bolted(building: OwnBuilding) -> list[str]:
    """Goods that are part of the mass of their floors."""
    found = [
        f"{kind.name or 'goods'} on floor {kind.floor}, {1e-3 * STANDARD_GRAVITY * kind.mass:.0f} kN"
        for kind in building.kinds
        if kind.attached and kind.mass > 0.0
    ]
    if not found:
        return []
    return [
        f"Bolted: {'; '.join(found)}. They are mass in every model, in both analyses and, as permanent equipment, for "
        "the code; shares are of the loose goods."
    ]


def _about_presence(building: OwnBuilding, there: list[FloorGoods]) -> str:
    """How much of the goods is present, and how that is known."""
    how = presence_sentence(building)
    surveyed = any("sustained" in kind.presence for kind in there)
    source = f" Surveys: {surveyed_load(USUAL).source}; +/- one standard deviation." if surveyed else ""
    return f"Goods present: {building.present_share:.3g} of the design live load of the whole building; {how}.{source}"


def about_code(building: OwnBuilding) -> str:
    """Return what the code counts, floor by floor where they differ."""
    code = building.code
    parts = [f"{code.code}, {code.use}" + " (none was stated)" * (not building.code_stated)]
    parts[0] += f", {code.fraction:g} of the design live load"
    if any(one != (code.fraction, "") for one in building.counted):
        parts[0] += (
            f" where a floor states no other; by floor {_by_floor(building)}, together {building.code_share:.3g}"
        )
    if code.low < code.high:
        parts[0] += f", the upper end of {code.low:g} to {code.high:g}"
    parts += [part for part in (code.clause, code.status, code.note) if part]
    return f"Code: {'; '.join(parts)}."


def _by_floor(building: OwnBuilding) -> str:
    """Fraction, use and exception of each floor."""
    found = []
    for floor, (one, of) in enumerate(zip(building.counted, building.floor_codes, strict=True), start=1):
        what = ", ".join(part for part in (of.use, one.exception) if part)
        found.append(f"{floor}: {one.fraction:g}{f' ({what})' * bool(what)}")
    return ", ".join(found)
