"""Standard gravity and the units in which accelerations come from files."""

from __future__ import annotations

import re
from typing import Final

STANDARD_GRAVITY: Final = 9.80665
"""Standard gravity (m/s2), 3rd CGPM 1901: the g of every number in this package."""

ACCELERATION_UNITS: Final = {"g": STANDARD_GRAVITY, "m/s2": 1.0, "cm/s2": 0.01}
"""Accelerations of files in m/s2, by the name of the unit."""

_SPELLINGS: Final = (
    ("cm/s2", r"cm\s*/\s*s(?:ec)?\s*(?:\*\*|\^)?\s*2|cm\s*/\s*s(?:ec)?\s*/\s*s(?:ec)?|\bgals?\b"),
    ("m/s2", r"(?<![a-z])m\s*/\s*s(?:ec)?\s*(?:\*\*|\^)?\s*2|(?<![a-z])m\s*/\s*s(?:ec)?\s*/\s*s(?:ec)?"),
    ("g", r"[(\[]\s*g(?:'s)?\s*[)\]]|\bunits?(?:\s+of|\s*[:=])\s*\(?g(?:'s)?\b"),
)


def stated_unit(text: str) -> str | None:
    """Return the acceleration unit that a header states, or None where it states none or several."""
    found = {unit for unit, spelling in _SPELLINGS if re.search(spelling, text, re.IGNORECASE)}
    return found.pop() if len(found) == 1 else None
