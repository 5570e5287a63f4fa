"""What the headers of record files state: the step with its unit, the number of points, the quantity."""

from __future__ import annotations

import re
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.records.formats.numbers import NUMBER, last_digit, to_float

SHORTEST_STEP: Final = 1e-5
LONGEST_STEP: Final = 1.0
"""Range of the step (s) of a ground motion; a header outside it is damaged."""

NO_COUNT: Final = "the file states no number of points: a missing end would not show"

_PER_SECOND: Final = {
    **dict.fromkeys(("", "s", "sec", "secs", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds"), 1000.0),
}
_STEP = re.compile(
    r"(?:\b(?:dt|delta[ \t]*t|time[ \t]*(?:step|increment|interval)"
    r"|sampl(?:e|ing)[ \t]+(?:interval|period|time))\b[ \t]*"
    r"(?:[(\[](?P<before>[^)\]\n]{0,30})[)\]])?|\bSAMPLING_INTERVAL_S)"
    rf"[ \t]*[=:][ \t]*(?P<step>{NUMBER})"
    # What ends a step: the line, a separator, another key, or else its unit.
    r"[ \t]*(?:(?=$|[,;)\]](?!\d)|(?!ms|milli)\w+[ \t]*[=:])|(?P<after>[^\s,;)\]]*))",
    re.IGNORECASE | re.MULTILINE,
)
_RATE = re.compile(
    rf"\bsampl(?:e|ing)[ \t]*(?:rate|freq\w*)[ \t]*(?:\((?:hz|sps)\))?[ \t]*[=:][ \t]*(?P<rate>{NUMBER})"
    r"[ \t]*(?:hz|sps|samples?[ \t]*(?:/|per)[ \t]*s\w*)?[ \t]*(?:$|[,;)])",
    re.IGNORECASE | re.MULTILINE,
)
_POINTS = re.compile(
    r"\b(?:NDATA|NPTS|(?:number|no\.?)[ \t]+of[ \t]+(?:data[ \t]+)?(?:points|samples|data))[ \t]*[=:][ \t]*(\d{1,9})\b",
    re.IGNORECASE,
)
_ACCELERATION = re.compile(r"(?<![a-z])(?:acc(?:el[a-z]*)?|acel[a-z]*|beschl[a-z]*)(?![a-z])", re.IGNORECASE)
_SYMBOL = re.compile(r"(?<![a-z])(?:a|ag|ug|a[_ ]?[gxyz])[ \t]*[(\[]|\baccelerogram", re.IGNORECASE)
# The velocity of shear waves is one of the site.
_OTHER_QUANTITY = re.compile(r"(?<![a-z])(?<!wave[ -])(?:velocity|velocities|displacements?)(?![a-z])", re.IGNORECASE)


def stated_step(text: str, file: str) -> float | None:
    """Return the step (s) that a header states in s or ms, or None where it states none."""
    match = _STEP.search(text)
    if match is None:
        rate = _RATE.search(text)
        if rate is None:
            return None
        number = to_float(rate["rate"])
        return step_in_seconds(repr(1.0 / number) if number > 0.0 else "0", "s", file)
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


def names_acceleration(text: str) -> bool:
    """Whether a header speaks of accelerations, by a word or by a label such as "a (m/s2)"."""
    return _ACCELERATION.search(text) is not None or _SYMBOL.search(text) is not None


def other_quantity(text: str) -> str | None:
    """Return what a header names where it speaks of velocity or displacement and of no acceleration, else None."""
    quantity = _OTHER_QUANTITY.search(text)
    return quantity.group().lower() if quantity and not _ACCELERATION.search(text) else None


FEW_FIGURES: Final = 3
"""A step of more figures is as good as exact."""

WHOLE: Final = 1e-6
"""A rate within this part of a whole number of samples a second is one."""

COARSEST_ROUNDING: Final = 0.5e-4
"""Half the fourth decimal (s): a step rounded further in a header does not contradict a given one."""


def rounding_of(written: str) -> tuple[float, float]:
    """Return the bounds (in the unit of the number) between which a step lies that is rounded to its last digit."""
    value, half = to_float(written), 0.5 * last_digit(written)
    return value - half, value + half


def rounded_step(text: str) -> list[str]:
    """Return a remark on the step of a header that is of few figures and of no whole number of samples a second."""
    match = _STEP.search(text)
    if match is None or (match["after"] or match["before"] or "").strip(" .").lower() not in ("", "s", "sec", "secs"):
        return []
    return rounding_remark(match["step"])


def rounding_remark(written: str) -> list[str]:
    """Return a remark on a step (s) as written, where it may be another one rounded."""
    step = to_float(written)
    mantissa = written.upper().replace("D", "E").partition("E")[0].replace(".", "").lstrip("+-0").rstrip("0")
    if step <= 0.0 or len(mantissa) > FEW_FIGURES or abs(1.0 / step - round(1.0 / step)) <= WHOLE / step:
        return []
    least, most = rounding_of(written.upper().partition("E")[0].rstrip("0") if "E" not in written.upper() else written)
    return [
        f"step {written} s is no whole number of samples a second: it may be rounded and lie between {least:.6g} and "
        f"{most:.6g} s, {100.0 * (most - step) / step:.1g} % off; dt= gives the exact one"
    ]


def same_step(step: float, other: float, samples: int, header: str) -> bool:
    """Whether two steps (s) are equal: the last sample stays to a tenth of a step, or they differ by rounding of the
    last digit in `header`, the text that states the second.
    """
    if abs(other - step) * max(samples - 1, 1) <= 0.1 * step or abs(other - step) <= 1e-6 * step:
        return True
    match = _STEP.search(header) if header else None
    if match is None:
        return False
    half = 0.5 * last_digit(match["step"]) * other / to_float(match["step"])
    return abs(other - step) <= min(half, COARSEST_ROUNDING) * (1.0 + 1e-6)
