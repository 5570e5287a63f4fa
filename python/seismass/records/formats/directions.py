"""Directions of components as headers write them: degrees, compass letters, SEED channel codes, up and down."""

from __future__ import annotations

import re
from typing import Final

_WORDS: Final = {
    **dict.fromkeys(("N", "NS", "NORTH"), 0.0),
    **dict.fromkeys(("E", "EW", "EO", "EAST"), 90.0),
    **dict.fromkeys(("S", "SN", "SOUTH"), 180.0),
    **dict.fromkeys(("W", "WE", "OE", "WEST"), 270.0),
}
_DEGREES = re.compile(r"(\d{1,3})(?:\.0*)?\s*(?:DEG(?:REES?)?)?(?:\s*\(.*)?", re.IGNORECASE)
_QUADRANT = re.compile(r"([NS])\s*(\d{1,2})\s*([EW])", re.IGNORECASE)
_SEED = re.compile(r"[A-Z][HNGLP]([NEZ])\d{0,2}")
_UP: Final = frozenset({"UP", "U", "V", "Z", "UD", "VER", "VERT", "VERTICAL", "DOWN", "DWN"})


def azimuth_of(component: str) -> float | None:
    """Return the direction of positive acceleration in degrees clockwise from north ("090", "90 DEG", "E", "N36E", the
    SEED code "HNE"; NS is north, EW east), or None ("UP", "H1", "LONGITUDINAL").
    """
    text = component.strip().upper()
    text = text.partition("(")[0].strip() or text  # "N (CWB)": what stands in brackets is the operator
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


def direction_remark(component: str, number: float | None, vertical_codes: tuple[int, ...]) -> str | None:
    """Return a remark where a header's text and its integer (degrees or a code; None: missing) disagree on the
    direction of a component.
    """
    azimuth = azimuth_of(component)
    if number is None or (azimuth is None and not is_vertical(component)):
        return None
    agrees = number in vertical_codes if azimuth is None else 0.0 <= number <= 360.0 and number % 360.0 == azimuth
    return None if agrees else f"direction is {component} in the text of the header and {number:g} in its integers"


def is_vertical(component: str) -> bool:
    """Whether a component is one of the vertical direction: UP, V, U-D, UD2, HNZ, "VERTICAL COMP"."""
    words = re.findall(r"[A-Z0-9]+", component.upper())
    if not words:
        return False
    if words[0] in {"V", "Z", "U"} or re.fullmatch(r"[A-Z][HNGLP]Z\d{0,2}|UD[12]", words[0]):
        return True
    return any(word in _UP and len(word) > 1 for word in words)
