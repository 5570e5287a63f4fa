"""Where a sensor stands and points: on the ground, in a structure or below the surface; horizontal or vertical."""

from __future__ import annotations

import re
from typing import Final

from seismass.records.formats.directions import is_vertical
from seismass.records.record import Record

_VERTICAL_NAME = re.compile(
    r"[-_.](?:UP|VERT?|VERTICAL|DWN|UD)(?![A-Z0-9])"  # a word of the name: BRA-UP, ERZ-UP__copy
    r"|[-_.][VZ]$"  # a letter at its end: 1059-V
    r"|(?:UP|VERT?|DWN|[BH][NH]Z)\.?$",  # joined to a station code: HECVER, TCUUP.
    re.IGNORECASE,
)
_GROUND: Final = re.compile(r"\bfree[- ]?field\b|\bground\b(?![- ]+fl)|\bgrnd\b(?![- ]+fl)|\bat grade\b", re.IGNORECASE)
_STRUCTURE: Final = re.compile(
    r"\b(?:roof|penthouse|floor|flr|fl|level|lvl|stor(?:e?y|ies)|basement|bsmt|bldg|wall|column|col|beam|girder|slab"
    r"|deck|bent|abut(?:ment)?|abt|pier|cap|footing|ftg|pile|span|mid-?span|hinge|arch|cable|anchorage|tower|dam|crest"
    r"|gallery|galleries|parapet|mezzanine|atrium|diaphragm|truss|stack|tank|foundation|fdn|isolat(?:or|ors|ion))\b",
    re.IGNORECASE,
)
_BELOW: Final = re.compile(
    r"\bbore-?\s?hole\b|\bdown-?\s?hole\b|\bdepth\b(?!\s*[=:]?\s*0+(?:\.0*)?\s*m)|\b\d+(?:\.\d+)?\s*(?:m|meters|ft|feet)\s+"
    r"(?:deep|below|depth)",
    re.IGNORECASE,
)


def off_ground(record: Record) -> str | None:
    """Return why a record is not of the ground surface: its place in a structure or below the ground; None where it is,
    or where it states no place.
    """
    if not record.place:
        return None
    if _BELOW.search(record.place):
        return f"below the surface by its header: {record.place}"
    if _STRUCTURE.search(record.place) and not _GROUND.search(record.place):
        return f"in a structure by its header: {record.place}"
    return None


def reason_to_leave(record: Record) -> str | None:
    """Return why a record is not a horizontal motion of the ground: vertical, in a structure or below; else None."""
    return vertical_reason(record) or off_ground(record)


def vertical_reason(record: Record) -> str | None:
    """Return why a record is a vertical component, or None."""
    if is_vertical(record.component):
        return f"vertical component by its header: {record.component}"
    if has_vertical_name(record):
        return f"vertical component by its name: {record.name}"
    return None


def has_vertical_name(record: Record) -> bool:
    """Whether the name of a record is one of a vertical component: BRA-UP, HECVER."""
    return _VERTICAL_NAME.search(record.name) is not None
