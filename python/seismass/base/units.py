"""Standard gravity and the units in which accelerations come from files."""

from __future__ import annotations

import re
from typing import Any, Final

from seismass import _kernel
from seismass.base.errors import SeismassError
from seismass.base.values import brief, refusal

STANDARD_GRAVITY: Final = _kernel.STANDARD_GRAVITY
"""Standard gravity (m/s2), 3rd CGPM 1901: the g of every number in this package."""

ACCELERATION_UNITS: Final = {"g": STANDARD_GRAVITY, "m/s2": 1.0, "cm/s2": 0.01, "gal": 0.01}
"""Accelerations of files in m/s2, by the name of the unit; records call gal cm/s2."""

_SPELLINGS: Final = {
    **dict.fromkeys(("g", "g's", "(g)"), "g"),
    **dict.fromkeys(("gal", "gals", "(gal)"), "cm/s2"),
}
_PER_SECOND_SQUARED = re.compile(
    r"(?<![a-z])([a-z]+)[ \t]*/[ \t]*s(?:ec)?"
    r"(?:[ \t]*/[ \t]*s(?:ec)?(?![a-z])|[ \t]*(?:\*\*|\^)?[ \t]*(?:2(?![\d.])|²))",
    re.IGNORECASE,
)
_GAL = re.compile(r"\bgals?\b", re.IGNORECASE)
_BRACKETED_G = re.compile(r"[(\[][ \t]*([%m]?g)(?:'s)?[ \t]*[)\]]", re.IGNORECASE)
_IN_G = re.compile(r"\bacc[a-z.]*[ \t]+in[ \t]+([%m]?g)(?:'s)?(?!\w)(?![ \t]*[/*^])", re.IGNORECASE)
_UNITS_OF = re.compile(r"\bunits?[ \t]*(?:of\b|[:=])[ \t]*([^\s].*)", re.IGNORECASE)
_G = re.compile(r"[(\[]?[ \t]*g(?:'s|ravity)?(?!\w)(?![ \t]*[/*^])", re.IGNORECASE)


def acceleration_factor(unit: Any, owner: str, kind: type[SeismassError]) -> float:
    """Return a unit of accelerations in m/s2, whatever its spelling; another one is refused.

    Parameters
    ----------
    unit : str
        "m/s2", "g", "cm/s2" or "gal", or another spelling of them.
    owner : str
        Whose unit it is, as errors name it.
    kind : type
        Class of the error.
    """
    name = unit_by_name(unit) if isinstance(unit, str) else None
    if name is None:
        raise refusal(kind, "unit", owner, f"one of {', '.join(ACCELERATION_UNITS)}", brief(unit))
    return ACCELERATION_UNITS[name]


def unit_by_name(name: str) -> str | None:
    """Return "g", "m/s2" or "cm/s2" for any spelling of it, gal included, or None for another unit.

    >>> [unit_by_name(name) for name in ("Gal", "cm/sec^2", "m/s/s", "G", "ft/s2")]
    ['cm/s2', 'cm/s2', 'm/s2', 'g', None]
    """
    text = name.strip().lower()
    return _SPELLINGS.get(text) or (stated_unit(text) if _PER_SECOND_SQUARED.fullmatch(text) else None)


def stated_unit(text: str) -> str | None:
    """Return the acceleration unit that a header states, or None where it states none, several or another."""
    found = _units(text)
    return found[0] if len(found) == 1 and found[0] in ACCELERATION_UNITS else None


def unknown_unit(text: str) -> str | None:
    """Return what a header states for a unit where it is none of `ACCELERATION_UNITS`, or several; else None."""
    return None if stated_unit(text) else " and ".join(_units(text)) or None


def _units(text: str) -> list[str]:
    """Every unit that a header states, by its name if it is a known one."""
    found = {f"{length.lower()}/s2" for length in _PER_SECOND_SQUARED.findall(text)}
    found |= {name.lower() for name in (*_BRACKETED_G.findall(text), *_IN_G.findall(text))}
    if _GAL.search(text):
        found.add("cm/s2")
    for said in _UNITS_OF.findall(text):
        if _G.match(said):
            found.add("g")
        elif said[0] in ".0123456789" or not found:
            found.add(said.strip()[:30])
    return sorted(found)
