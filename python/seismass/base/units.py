"""Standard gravity and the units in which accelerations come from files."""

from __future__ import annotations

import re
from typing import Any, Final

from seismass import _kernel
from seismass.base.errors import SeismassError
from seismass.base.values import brief, refusal

STANDARD_GRAVITY: Final = _kernel.STANDARD_GRAVITY
"""Standard gravity (m/s2), 3rd CGPM 1901: the g of every number in this package."""

FOOT: Final = 0.3048
"""Foot (m), that of 1959, exact."""
INCH: Final = 0.0254
"""Inch (m), exact."""
POUND: Final = 0.45359237
"""Pound (kg), exact."""
KIP: Final = 1e3 * POUND * STANDARD_GRAVITY
"""Kip (N): the weight of 1000 lb."""

ACCELERATION_UNITS: Final = {
    "g": STANDARD_GRAVITY,
    "m/s2": 1.0,
    "cm/s2": 0.01,
    "gal": 0.01,
    "mm/s2": 0.001,
    "mg": STANDARD_GRAVITY / 1000.0,
    "%g": STANDARD_GRAVITY / 100.0,
    "ft/s2": FOOT,
    "in/s2": INCH,
}
"""Accelerations of files in m/s2, by the name of the unit; records call gal cm/s2."""

_LENGTHS: Final = {
    **dict.fromkeys(("m", "meter", "meters", "metre", "metres"), "m"),
    **dict.fromkeys(("ft", "foot", "feet"), "ft"),
    **dict.fromkeys(("in", "inch", "inches"), "in"),
}
_SPELLINGS: Final = {
    **dict.fromkeys(("g", "g's", "(g)"), "g"),
    **dict.fromkeys(("gal", "gals", "(gal)"), "cm/s2"),
    **dict.fromkeys(("mg", "milli-g", "milli g", "(mg)"), "mg"),
    **dict.fromkeys(("%g", "% g", "(%g)", "percent g", "percent of g", "% of g"), "%g"),
}
_SECOND: Final = r"s(?:e[cg])?"
_PER_SECOND_SQUARED = re.compile(
    rf"(?<![a-z])([a-z]+)[ \t]*/[ \t]*(?:"
    rf"{_SECOND}(?:[ \t]*/[ \t]*{_SECOND}(?![a-z])|[ \t]*(?:\*\*|\^)?[ \t]*(?:2(?![\d.])|²))"
    rf"|\({_SECOND}[ \t]*(?:/|\*|\.)[ \t]*{_SECOND}\))"
    r"|(?<![a-z])(mm|cm|m|in|ft)[ \t]*[.*]?[ \t]*s(?:ec)?[ \t]*(?:\*\*|\^)?[ \t]*(?:-2(?![\d.])|⁻²)",
    re.IGNORECASE,
)
_GAL = re.compile(r"\bgals?\b", re.IGNORECASE)
_PART_OF_G: Final = r"(?:%|percent)[ \t]*(?:of[ \t]+)?g|mg|milli-?[ \t]?g|g"
_BRACKETED_G = re.compile(rf"[(\[][ \t]*({_PART_OF_G})(?:'s)?[ \t]*[)\]]", re.IGNORECASE)
_IN_G = re.compile(rf"\bacc[a-z.]*[ \t]+in[ \t]+({_PART_OF_G})(?:'s)?(?!\w)(?![ \t]*[/*^])", re.IGNORECASE)
_UNITS_OF = re.compile(r"\bunits?[ \t]*(?:of\b|[:=])[ \t]*([^\s].*)", re.IGNORECASE)
_UNIT_LIKE = re.compile(r"[/%\d]|count|volt|digit", re.IGNORECASE)
_G = re.compile(rf"[(\[]?[ \t]*(?:g(?:'s|ravity)?|({_PART_OF_G}))(?!\w)(?![ \t]*[/*^])", re.IGNORECASE)


def acceleration_factor(unit: Any, owner: str, kind: type[SeismassError]) -> float:
    """Return a unit of accelerations in m/s2 whatever its spelling; another one is refused. `owner` is whose unit it is
    in errors of the class `kind`.
    """
    name = unit_by_name(unit) if isinstance(unit, str) else None
    if name is None:
        raise refusal(kind, "unit", owner, f"one of {', '.join(ACCELERATION_UNITS)}", brief(unit))
    return ACCELERATION_UNITS[name]


def unit_by_name(name: str) -> str | None:
    """Return the key of `ACCELERATION_UNITS` of a spelling ("cm/s2" of "Gal" or "cm/sec^2"); None of another unit."""
    text = name.strip().lower()
    return _SPELLINGS.get(text) or (stated_unit(text) if _PER_SECOND_SQUARED.fullmatch(text.strip("()[]")) else None)


def stated_unit(text: str) -> str | None:
    """Return the acceleration unit that a header states, or None where it states none, several or another."""
    units = stated_units(text)
    return units[0] if len(units) == 1 and units[0] in ACCELERATION_UNITS else None


def unknown_unit(text: str) -> str | None:
    """Return the units that a header states where it is not a single one of `ACCELERATION_UNITS`; else None."""
    return None if stated_unit(text) else " and ".join(stated_units(text)) or None


def stated_units(text: str) -> list[str]:
    """Return every unit that a header states, by its name in `ACCELERATION_UNITS` if it is there, in order."""
    units = {_per_second_squared(first or second) for first, second in _PER_SECOND_SQUARED.findall(text)}
    units |= {_part_of_g(name) for name in (*_BRACKETED_G.findall(text), *_IN_G.findall(text))}
    if _GAL.search(text):
        units.add("cm/s2")
    for unit in _UNITS_OF.findall(text):
        of_g = _G.match(unit)
        if of_g:
            units.add(_part_of_g(of_g[1] or "g"))
        elif unit[0] in ".0123456789" or not units:
            units.add(unit.strip()[:30])
    return sorted(units)


def _per_second_squared(length: str) -> str:
    name = length.lower()
    return f"{_LENGTHS.get(name, name)}/s2"


def _part_of_g(text: str) -> str:
    """Return g, mg or %g for a spelling of it."""
    name = text.lower()
    return "%g" if name[0] in "%p" else "mg" if name[0] == "m" else "g"


def contradiction(text: str, unit: str) -> str | None:
    """Return the unit that a header states where it is not `unit`, a key of `ACCELERATION_UNITS`; else None. Words
    behind "units:" that are no unit ("see below") contradict nothing.
    """
    units = [one for one in stated_units(text) if one in ACCELERATION_UNITS or _UNIT_LIKE.search(one)]
    same = ACCELERATION_UNITS[unit]
    if not units or any(ACCELERATION_UNITS.get(one) == same for one in units):
        return None
    return " and ".join(units)
