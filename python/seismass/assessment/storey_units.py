"""Units of storey tables: lengths, forces, masses and stiffnesses as programs of structural analysis write them."""

from __future__ import annotations

import re
from typing import Final, Literal

from seismass.base.errors import InvalidBuildingFile
from seismass.base.units import FOOT, INCH, KIP, POUND, STANDARD_GRAVITY
from seismass.base.values import brief, refusal

Quantity = Literal["length", "force", "mass", "stiffness"]

LENGTHS: Final = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "ft": FOOT, "in": INCH}
"""Metres."""
FORCES: Final = {
    "n": 1.0,
    "kn": 1e3,
    "mn": 1e6,
    "kgf": STANDARD_GRAVITY,
    "tonf": 1e3 * STANDARD_GRAVITY,
    **dict.fromkeys(("lb", "lbf"), 1e-3 * KIP),
    **dict.fromkeys(("kip", "kips"), KIP),
}
"""Newtons; tonf is the metric one, as these programs have it, and a kip 1000 lbf."""
MASSES: Final = {"kg": 1.0, "t": 1e3, "tonne": 1e3, "tonnes": 1e3, "lb": POUND, "lbm": POUND}
"""Kilograms."""

_MASS: Final = re.compile(r"([a-z]+)[-*.·]?s(?:ec)?\^?[2²]/([a-z]+)")
_STIFFNESS: Final = re.compile(r"([a-z]+)/([a-z]+)")


def unit_factor(unit: str, quantity: Quantity, what: str, owner: str) -> float:
    """Return the factor towards SI units of a unit such as "kN/m" or "kip-s2/in" for a length, force, mass or
    stiffness.
    """
    text = unit.strip().lower().replace(" ", "")
    if quantity == "length" and text in LENGTHS:
        return LENGTHS[text]
    if quantity == "force" and text in FORCES:
        return FORCES[text]
    if quantity == "mass" and text in MASSES:
        return MASSES[text]
    pattern = {"mass": _MASS, "stiffness": _STIFFNESS}.get(quantity)
    matched = pattern.fullmatch(text) if pattern is not None else None
    if matched and matched[1] in FORCES and matched[2] in LENGTHS:
        return FORCES[matched[1]] / LENGTHS[matched[2]]
    known = {
        "length": ", ".join(LENGTHS),
        "force": "N, kN, kgf, tonf, lb, kip",
        "mass": "kg, t, lb, or force-s2/length such as kip-s2/in",
        "stiffness": "force/length such as kN/m or kip/in",
    }[quantity]
    raise refusal(InvalidBuildingFile, what, owner, f"one of {known}", brief(unit))


def system_of(units: str, owner: str) -> tuple[float, float]:
    """Return the units of force (N) and of length (m) of a system such as "kN-m" or "kip-in"."""
    force, _, length = units.strip().lower().replace(" ", "").replace(",", "-").partition("-")
    length = length.partition("-")[0]  # a third word is that of temperatures
    if force not in FORCES or length not in LENGTHS:
        need = "a force and a length such as kN-m, N-mm, kip-in, kip-ft, lb-in, kgf-m or tonf-m"
        raise refusal(InvalidBuildingFile, "units", owner, need, brief(units))
    return FORCES[force], LENGTHS[length]
