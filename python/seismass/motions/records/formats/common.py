"""What readers of formats share: numbers, headers, peaks."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS
from seismass.motions.records.record import Record

LINE_WIDTH: Final = 400
"""Lines of headers have 80 characters, some a little more; what stands further right is not looked at."""

SAME_STEP: Final = 1e-6
"""Two steps that differ by less, relatively, are the same."""


class NotRead(RecordFormatError):
    """A sound file of a kind that is known and not read as acceleration: another format, velocity, raw counts."""


@dataclass(frozen=True)
class Arguments:
    """What a caller of `read_record` says of the file: step (s), unit by its name, rows to leave out."""

    dt: float | None = None
    unit: str | None = None
    skip: int | None = None


@dataclass(frozen=True)
class Channel:
    """One acceleration of a file, by the number or code that the file gives it."""

    label: str
    record: Record


def channels_of(
    lines: list[str], component: Callable[[int, int], tuple[Channel, int]], *, separator: str | None = None
) -> tuple[Channel, ...]:
    """Return the components of a file, one after the other, with blank lines or lines that begin with `between` in
    between. `component` takes the first line's index and the number (from 1), returns it and the next line.
    """
    channels: list[Channel] = []
    row = 0
    while row < len(lines):
        if not lines[row].strip() or (separator is not None and lines[row].startswith(separator)):
            row += 1
            continue
        channel, row = component(row, len(channels) + 1)
        channels.append(channel)
    return tuple(channels)


@dataclass(frozen=True)
class Format:
    """One format: its key, what it is called, how its head is known, and its reader."""

    name: str
    title: str
    recognises: Callable[[str], bool]
    parse: Callable[[str, Path, Arguments], tuple[Channel, ...]]


def agreed_step(stated: float | None, dt: float | None, written: str, file: str) -> float:
    """Return the step (s) of a header, which a given one must equal."""
    if stated is None:
        if dt is None:
            raise RecordFormatError(f"dt of {file} must be given, its header states no step; got none")
        return dt
    if dt is not None and abs(dt - stated) > SAME_STEP * stated:
        raise RecordFormatError(f"dt of {file} must agree with its header, {written}; got {dt:g} s")
    return stated


def agreed_unit(stated: str, unit: str | None, file: str) -> str:
    """Return the unit of a header, which a given one must equal."""
    if unit is not None and ACCELERATION_UNITS[unit] != ACCELERATION_UNITS[stated]:
        raise RecordFormatError(f"unit of {file} must be that of its header, {stated}; got {unit}")
    return stated


def refuse_skip(arguments: Arguments, format_title: str, file: str) -> None:
    """Refuse rows to leave out where the format says which lines are data."""
    if arguments.skip is not None:
        article = "an" if format_title[:1] in ".AEIOU" else "a"
        raise RecordFormatError(
            f"skip of {file} must be left out for {article} {format_title} file; got {arguments.skip!r}"
        )


NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][+-]?\d+)?"

SCALED: Final = re.compile(rf"\bscal(?:e|ing)[ -]?factor\s*[=:]?\s*({NUMBER})", re.IGNORECASE)

_FIELD = re.compile(r"[+-]?\d*\.\d+(?:[EeDd][+-]\d\d)?")
_PARTS = re.compile(r"[+-]?\d*\.?(?P<decimals>\d*)(?:[EeDd][+-]?(?P<exponent>\d*))?")
_NUMBER = re.compile(NUMBER)
_NO_EXPONENT: Final = frozenset("+-.0123456789")
_CHARACTERS: Final = frozenset("+-.0123456789Ee")

FEWEST_TO_JUDGE_BY: Final = 50
"""Below so many numbers the last one may be shorter than all others by chance."""


def is_number(token: str) -> bool:
    """Whether the token is one finite decimal number, Fortran's D exponent included."""
    return _NUMBER.fullmatch(token) is not None


def to_float(token: str) -> float:
    """Return the value of a token for which `is_number` holds."""
    return float(token.replace("D", "E").replace("d", "e"))


def last_digit(token: str) -> float:
    """Return the unit of the last digit of a number: 0.01 for 1.20, 1e-05 for 1.2E-04."""
    mantissa, _, exponent = token.upper().replace("D", "E").partition("E")
    return float(10.0 ** min(float(exponent or 0) - len(mantissa.partition(".")[2]), 300.0))


def last_digits(tokens: Sequence[str]) -> NDArray[np.float64]:
    """Return the unit of the last digit of each number, shape (len(tokens),)."""
    if set("".join(tokens)) <= _NO_EXPONENT:
        return 10.0 ** -np.array([len(token) - 1 - token.find(".") if "." in token else 0.0 for token in tokens])
    return np.array([last_digit(token) for token in tokens])


def split_touching(token: str) -> list[str] | None:
    """Return the fields of fixed width that touch in `token` ("-.24E-03-.23E-03"), or None. They are separated at a
    sign of the second or an exponent of the first (sign and two digits); all else is ambiguous.
    """
    fields: list[str] = []
    end = 0
    while end < len(token):
        match = _FIELD.match(token, end)
        if match is None or (end and token[end] not in "+-" and not re.search("[EeDd]", fields[-1])):
            return None
        fields.append(match.group())
        end = match.end()
    return fields


def parse_numbers(lines: Iterable[tuple[int, str]], file: str) -> tuple[list[str], NDArray[np.float64]]:
    """Read all numbers of numbered lines: as written, and as values."""
    numbered = list(lines)
    tokens: list[str] = []
    for _, line in numbered:
        tokens.extend(line.split())
    try:
        # The set of characters leaves out what float() takes beside numbers: nan, inf, 1_000.
        plain = set("".join(tokens)) <= _CHARACTERS
        values = np.array(list(map(float, tokens)) if plain else [], dtype=np.float64)
    except ValueError:
        plain = False
    if not plain:
        tokens = _split_fields(numbered, file)
        values = np.array([to_float(token) for token in tokens], dtype=np.float64)
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise RecordFormatError(f"numbers of {file} must be finite; got {tokens[wrong[0]]!r}")
    return tokens, values


def _split_fields(lines: Iterable[tuple[int, str]], file: str) -> list[str]:
    tokens: list[str] = []
    for number, line in lines:
        for token in line.split():
            if is_number(token):
                tokens.append(token)
                continue
            fields = split_touching(token)
            if not fields:
                raise RecordFormatError(f"line {number} of {file} must be numbers; got {token[:40]!r}")
            tokens.extend(fields)
    return tokens


def is_cut_off(tokens: Sequence[str], *, short_zero: bool = True) -> bool:
    """Whether the last number has fewer decimals or exponent digits than all others: of "0.4751E-01" the first half is
    a false peak. With an exponent decimals are complete; a last zero may be short if `short_zero`.
    """
    if len(tokens) <= FEWEST_TO_JUDGE_BY or (short_zero and to_float(tokens[-1]) == 0.0):
        return False
    (last_decimals, last_exponent) = _shape(tokens[-1])
    before = tokens[:-1]
    too_few_decimals = last_exponent == 0 and all(last_decimals < _shape(token)[0] for token in before)
    return too_few_decimals or all(last_exponent < _shape(token)[1] for token in before)


def _shape(token: str) -> tuple[int, int]:
    match = _PARTS.fullmatch(token)
    return (len(match["decimals"]), len(match["exponent"] or "")) if match else (0, 0)


RELATIVE: Final = 2e-6
"""Peaks agree to this beside the rounding of the header: networks compute in single precision."""

SAMPLES_OFF: Final = 1.5
"""The time of a peak agrees to so many steps: networks count the first sample as 0 or as one step."""


@dataclass(frozen=True)
class StatedPeak:
    """A peak as a header writes it: value and time (s) as text, in units of the samples times `factor`."""

    value: str
    time: str = ""
    factor: float = 1.0
    signed: bool = True


def check_peak(
    samples: NDArray[np.float64], peak: StatedPeak, dt: float, resolution: float, file: str, remarks: list[str]
) -> None:
    """Refuse samples whose peak is not the one that the header states; 0 and NaN are not compared. Remark where only
    its time differs (some networks count from another start), or the sign (some give the size).
    """
    written = peak.value.strip()
    if not is_number(written) or to_float(written) == 0.0:
        return
    stated = to_float(written) * peak.factor
    tolerance = 0.5 * last_digit(written) * peak.factor + 0.5 * resolution + RELATIVE * abs(stated)
    tolerance *= 1.0 + 1e-9
    where = int(np.argmax(np.abs(samples)))
    largest = float(samples[where])
    time = to_float(peak.time.strip()) if is_number(peak.time.strip()) else None
    text = f"{written}" + (f" at {time:g} s" if time is not None else "")
    if abs(abs(largest) - abs(stated)) > tolerance:
        raise RecordFormatError(
            f"peak of {file} must be {text}, as its header says; got {largest / peak.factor:.7g} at {where * dt:.6g} s"
        )
    near = np.abs(np.abs(samples) - abs(stated)) <= tolerance
    if peak.signed and not np.any(near & (np.sign(samples) == np.sign(stated))):
        if stated < 0.0:
            raise RecordFormatError(
                f"peak of {file} must be {text}, as its header says; got {largest / peak.factor:.7g}, of the other sign"
            )
        remarks.append(f"the peak is negative, {largest / peak.factor:.6g}; the header gives {written}")
    if time is not None and time > 0.0:
        allowed = SAMPLES_OFF * dt + 0.5 * last_digit(peak.time.strip())
        if np.min(np.abs(np.flatnonzero(near) * dt - time)) > allowed:
            remarks.append(f"the peak is at {where * dt:.6g} s; the header gives {time:g} s")


def digit_of_peak(samples: NDArray[np.float64], fields: Sequence[str]) -> float:
    """Return the unit of the last digit of the largest sample, as the file writes it."""
    return last_digit(fields[int(np.argmax(np.abs(samples)))].strip())


SHORTEST_STEP: Final = 1e-5
LONGEST_STEP: Final = 1.0
"""Range of the step (s) of a ground motion; a header outside it is damaged."""

NO_COUNT: Final = "the file states no number of points: a missing end would not show"

_PER_SECOND: Final = {
    **dict.fromkeys(
        ("", "s", "sec", "secs", "second", "seconds", "seg", "segundos", "secondi", "secondes", "saniye"), 1.0
    ),
    **dict.fromkeys(("sekunde", "sekunden", "seconde", "secondo", "segundo", "sn"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds"), 1000.0),
}
_DECIMAL: Final = rf"(?:\d+,\d+(?![\d,])|{NUMBER})"
_SAMPLING: Final = r"(?:muestreo|campionamento|amostragem|[eé]chantillonnage|d.[eé]chantillonnage)"
_SAMPLES: Final = r"(?:samples?|points?|pts|muestras|campioni|amostras|[eé]chantillons|abtastwerte|werte)"
_SECONDS: Final = r"(?:s|sec|secs|seconds?|segundos?|secondi|secondo|secondes?|sekunden?|saniye)"
_SAYS: Final = r"(?:\b(?:is|of|at|es|est|ist|de)\b|[=:])?"
_STEP = re.compile(
    r"(?:(?<![^\W_])(?:d[ _]?t|[δΔ][ ]?t|delta[ \t_]*t|time[ \t_-]*(?:step|increment|interval)|sample[ ]spacing"
    r"|step[ ]size|interval[ ]between[ ](?:samples|points)"
    r"|sampl(?:e|ing)[ \t_]+(?:interval|period|time|step)|zeitschritt\w*|zeitinkrement|abtast(?:intervall|schritt\w*)"
    rf"|(?:intervall?[oe]|paso?|passo|p[eé]r[ií]ode?o?)[ ](?:(?:de|di)[ ])?(?:{_SAMPLING}|tiempo|tempo|temps|temporale)"
    r"|(?:zaman|örnekleme)[ ](?:ad\u0131m|aral\u0131)\w*|equally[ -]spaced(?:[ ]intervals)?)(?:_s(?:ec)?)?(?![^\W_])"
    rf"[ \t]*(?:[(\[](?P<before>[^)\]\n]{{0,30}})[)\]])?|\bSAMPLING_INTERVAL_S)[ \t]*(?P<says>{_SAYS})[ \t]*"
    # What ends a step: the line, a separator, another key, or else its unit.
    rf"(?P<step>{_DECIMAL})[ \t]*(?:(?=$|[,;)\]](?!\d)|(?!ms|milli)\w+[ \t]*[=:])|(?P<after>[^\s,;)\]]*))"
    rf"|(?<![\w.,])(?P<ahead>{_DECIMAL})[ ]?(?P<unit>ms|msec|{_SECONDS})[ ]+"
    r"(?:time[ -]steps?|(?:sampling[ ]|time[ ])?intervals?)\b",
    re.IGNORECASE | re.MULTILINE,
)
_RATE = re.compile(
    r"(?<![^\W_])(?:sampl(?:e|ing)[ \t_-]*(?:rate|freq\w*)|samp_rate|sampling(?=[ ]*[:=][ ]*[\d.]+[ ]*hz)|sps|fs"
    r"|abtast(?:rate|frequenz)"
    rf"|(?:frecuencia|cadencia|velocidad|vel\.|tasa|frequ[eê]n[cz]\w*|fr[eé]quence|taxa)[ ](?:(?:de|di)[ ])?{_SAMPLING}"
    rf"|örnekleme[ ](?:h\u0131z|frekans)\w*|{_SAMPLES}[ ]?(?:/|per|por|par|al|pro)[ ]?{_SECONDS})"
    rf"[ \t]*(?:[(\[](?P<before>[^)\]\n]{{0,20}})[)\]])?[ \t]*{_SAYS}[ \t]*(?P<rate>{_DECIMAL})[ \t]*"
    rf"(?:(?P<kilo>k)?hz|sps|{_SAMPLES}[ ]?(?:/|per)[ ]?{_SECONDS})?(?![^\W_])"
    rf"|(?<![\w.,])(?P<ahead>{_DECIMAL})[ ]?"
    rf"(?:{_SAMPLES}[ ]?(?:/|per|por|al|par|pro|a)[ ]?{_SECONDS}|sps|(?P<k>k)?hz[ ]sampl\w*)(?![^\W_])"
    rf"|\bsampled[ ]at[ ](?P<at>{_DECIMAL})[ ]?(?P<at_kilo>k)?hz",
    re.IGNORECASE,
)
_POINTS = re.compile(
    r"\b(?:NDATA|NPTS|(?:number|no\.?)[ \t]+of[ \t]+(?:data[ \t]+)?(?:points|samples|data))[ \t]*[=:][ \t]*(\d{1,9})\b",
    re.IGNORECASE,
)
_ACCELERATION = re.compile(r"(?<![^\W\d_])(?:acc\w*|acel\w*|beschl\w*|ivme\w*|ускорени\w*|加速度)", re.IGNORECASE)
_SYMBOL = re.compile(r"(?<![a-z])(?:a|ag|ug|a[_ ]?[gxyz])[ \t]*[(\[]|\baccelerogram", re.IGNORECASE)
# The velocity of shear waves is one of the site.
_OTHER_QUANTITY = re.compile(r"(?<![a-z])(?<!wave[ -])(?:velocity|velocities|displacements?)(?![a-z])", re.IGNORECASE)


def stated_step(text: str, file: str, dt: float | None = None) -> float | None:
    """Return the step (s) that a header states, as a step or as a rate, or None where it states none; of several that
    differ `dt` decides.
    """
    steps = []
    for match in _steps(text):
        written = match["step"] or match["ahead"]
        steps.append(step_in_seconds(written.replace(",", "."), _unit_of(match), file))
    for match in _RATE.finditer(text):
        kilo = (
            1000.0
            if match["kilo"] or match["k"] or match["at_kilo"] or "khz" in (match["before"] or "").lower()
            else 1.0
        )
        rate = kilo * to_float((match["rate"] or match["ahead"] or match["at"]).replace(",", "."))
        steps.append(step_in_seconds(repr(1.0 / rate) if rate > 0.0 else "0", "s", file))
    others = [one for one in steps if abs(one - steps[0]) > COARSEST_ROUNDING and abs(one - steps[0]) > 0.01 * steps[0]]
    if others and dt is None:
        listed = " and ".join(f"{one:g}" for one in dict.fromkeys((steps[0], *others)))
        raise RecordFormatError(f"dt of {file} must be given, its header states {listed} s; got none")
    if others and dt is not None:
        return min(steps, key=lambda one: abs(one - dt))
    return steps[0] if steps else None


def _steps(text: str) -> list[re.Match[str]]:
    """Return where a header states a step; without "=" or the like a number is one where a unit or nothing follows."""
    return [
        match
        for match in _STEP.finditer(text)
        if match["ahead"] or match["says"] or (match["after"] or "").lower().strip(" .") in _PER_SECOND
    ]


def _unit_of(match: re.Match[str]) -> str:
    before = match["before"] or ""
    return match["unit"] or match["after"] or ("" if re.fullmatch(r"(?i)d ?t|[δΔ]t|in ?time", before) else before)


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
    match = next(iter(_steps(text)), None)
    if match is None or _unit_of(match).strip(" .").lower() not in ("", "s", "sec", "secs"):
        return []
    return rounding_remark((match["step"] or match["ahead"]).replace(",", "."))


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
    match = next(iter(_steps(header)), None)
    if match is None:
        return False
    written = (match["step"] or match["ahead"]).replace(",", ".")
    half = min(0.5 * last_digit(written) * other / to_float(written), COARSEST_ROUNDING)
    return -half * (1.0 + 1e-6) <= step - other < 2.0 * half * (1.0 - 1e-6)  # rounded, or cut
