"""Directions of components as headers write them: degrees, compass letters, SEED channel codes, up and down."""

from __future__ import annotations

import re
from typing import Final

_WORDS: Final = {
    **dict.fromkeys(("N", "NS", "NORTH"), 0.0),
    **dict.fromkeys(("E", "EW", "EAST"), 90.0),
    **dict.fromkeys(("S", "SN", "SOUTH"), 180.0),
    **dict.fromkeys(("W", "WE", "WEST"), 270.0),
}
_DEGREES = re.compile(r"(\d{1,3})(?:\.0*)?\s*(?:DEG(?:REES?)?)?(?:\s*\(.*)?", re.IGNORECASE)
_QUADRANT = re.compile(r"([NS])\s*(\d{1,2})\s*([EW])", re.IGNORECASE)
_SEED = re.compile(r"[A-Z][HNGLP]([NEZ])")
_UP: Final = frozenset({"UP", "U", "V", "Z", "UD", "VER", "VERT", "VERTICAL", "DOWN", "DWN"})


def azimuth_of(component: str) -> float | None:
    """Return the direction of positive acceleration in degrees clockwise from north, or None.

    "90", "090", "90 DEG", "360" (0), "E", "EAST", "N36E" and the SEED code "HNE" give one; NS and EW are taken as
    positive to north and east. "UP", "H1", "LONGITUDINAL" and what is not understood give None.
    """
    text = component.strip().upper()
    degrees = _DEGREES.fullmatch(text)
    if degrees:
        return float(degrees[1]) % 360.0 if int(degrees[1]) <= 360 else None
    quadrant = _QUADRANT.fullmatch(text)
    if quadrant:
        off = float(quadrant[2])
        north, east = quadrant[1] == "N", quadrant[3] == "E"
        angle = (off if east else -off) if north else (180.0 - off if east else 180.0 + off)
        return angle % 360.0 if off <= 90.0 else None
    seed = _SEED.fullmatch(text)
    if seed:
        return {"N": 0.0, "E": 90.0}.get(seed[1])
    return _WORDS.get(re.sub(r"[^A-Z]", "", text))


def is_vertical(component: str) -> bool:
    """Whether a component is one of the vertical direction: UP, V, U-D, UD2, HNZ, "VERTICAL COMP"."""
    words = re.findall(r"[A-Z0-9]+", component.upper())
    if not words:
        return False
    if words[0] in {"V", "Z", "U"} or re.fullmatch(r"[A-Z][HNGL]Z|UD[12]", words[0]):
        return True
    return any(word in _UP and len(word) > 1 for word in words)
