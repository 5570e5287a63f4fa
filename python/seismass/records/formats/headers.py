"""What the headers of record files state: the step with its unit, the number of points, the quantity."""

from __future__ import annotations

import re
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.records.formats.numbers import NUMBER, to_float

SHORTEST_STEP: Final = 1e-5
LONGEST_STEP: Final = 1.0
"""Steps (s) outside these are no sampling of a ground motion but a damaged header."""

_PER_SECOND: Final = {
    **dict.fromkeys(("", "s", "sec", "secs", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds"), 1000.0),
}
_STEP = re.compile(
    r"(?:\b(?:dt|delta[ \t]*t|time[ \t]*step)\b[ \t]*(?:[(\[](?P<before>[^)\]\n]{0,30})[)\]])?|\bSAMPLING_INTERVAL_S)"
    rf"[ \t]*[=:][ \t]*(?P<step>{NUMBER})"
    # What ends a step: the line, a separator, another key, or else its unit.
    r"[ \t]*(?:(?=$|[,;)\]](?!\d)|(?!ms|milli)\w+[ \t]*[=:])|(?P<after>[^\s,;)\]]*))",
    re.IGNORECASE | re.MULTILINE,
)
_POINTS = re.compile(
    r"\b(?:NDATA|NPTS|(?:number|no\.?)[ \t]+of[ \t]+(?:data[ \t]+)?(?:points|samples|data))[ \t]*[=:][ \t]*(\d{1,9})\b",
    re.IGNORECASE,
)
_ACCELERATION = re.compile(r"(?<![a-z])acc(?:el(?:erations?)?)?(?![a-z])", re.IGNORECASE)
# The velocity of shear waves is one of the site.
_OTHER_QUANTITY = re.compile(r"(?<![a-z])(?<!wave[ -])(?:velocity|velocities|displacements?)(?![a-z])", re.IGNORECASE)


def stated_step(text: str, file: str) -> float | None:
    """Return the step (s) that a header states, or None where it states none.

    Raises
    ------
    RecordFormatError
        It is stated in another unit than s or ms, or is no sampling of a ground motion.
    """
    match = _STEP.search(text)
    if match is None:
        return None
    return step_in_seconds(match["step"], match["after"] or match["before"] or "", file)


def step_in_seconds(number: str, unit: str, file: str) -> float:
    """Return a step as a header has it in s; without a unit it is in s already."""
    written = f"{number} {unit}".strip().replace(" /", "/")
    per_second = _PER_SECOND.get(unit.lower().strip(" \t.:([])"))
    if per_second is None:
        raise RecordFormatError(f"DT of {file} must be in s or ms; got {written}")
    step = to_float(number) / per_second
    if not SHORTEST_STEP <= step <= LONGEST_STEP:
        raise RecordFormatError(
            f"DT of {file} must be a step between {SHORTEST_STEP:g} and {LONGEST_STEP:g} s; got {written}"
        )
    return step


def stated_points(text: str) -> int | None:
    """Return the number of points that a header states, or None where it states none."""
    match = _POINTS.search(text)
    return int(match[1]) if match else None


def other_quantity(text: str) -> str | None:
    """Return what a header names where it speaks of velocity or displacement and of no acceleration, else None."""
    quantity = _OTHER_QUANTITY.search(text)
    return quantity.group().lower() if quantity and not _ACCELERATION.search(text) else None
