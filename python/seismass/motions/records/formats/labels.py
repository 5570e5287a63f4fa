"""Labels of columns: directions, units, times."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.base.units import is_plain, unit_by_name
from seismass.motions.records.formats.common import LINE_WIDTH, LONGEST_STEP, SHORTEST_STEP, last_digits
from seismass.motions.records.formats.table import uniform_step

_WORDS_DIRECTIONS: Final = {
    **dict.fromkeys(("N", "NS", "KG", "NORTH", "NORTE", "NORD", "KUZEY"), 0.0),
    **dict.fromkeys(("E", "EW", "EO", "OW", "DB", "EAST", "ESTE", "LESTE", "EST", "OST", "DOĞU"), 90.0),
    **dict.fromkeys(("S", "SN", "GK", "SOUTH", "SUR", "SUL", "SUD", "SÜD", "GÜNEY"), 180.0),
    **dict.fromkeys(("W", "WE", "OE", "WO", "BD", "WEST", "OESTE", "OUEST", "OVEST", "BATI"), 270.0),
}
_DEGREES = re.compile(r"(\d{1,3})(?:\.0*)?\s*(?:DEG(?:REES?)?)?(?:\s*\(.*)?", re.IGNORECASE)
_QUADRANT = re.compile(r"([NS])\s*(\d{1,2})\s*([EW])", re.IGNORECASE)
_SEED = re.compile(r"[A-Z][HNGLP]([NEZ])\d{0,2}")
_UP: Final = frozenset({"UP", "U", "V", "Z", "UD", "VER", "DOWN", "DWN", "SENKRECHT", "DÜŞEY", "DUSEY"})


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
    words = re.findall(r"[^\W\d_]+", text)
    known = [_WORDS_DIRECTIONS[word] for word in words if word in _WORDS_DIRECTIONS]
    if len(words) == len(known) == 2 and abs(known[0] - known[1]) == 180.0:  # Norte-Sur
        return known[0]
    return _WORDS_DIRECTIONS.get("".join(words))


def direction_remark(component: str, number: float | None, vertical_codes: tuple[int, ...]) -> str | None:
    """Return a remark where text and integer (degrees or a code) of a header disagree on the direction."""
    azimuth = azimuth_of(component)
    if number is None or (azimuth is None and not is_vertical(component)):
        return None
    agrees = number in vertical_codes if azimuth is None else 0.0 <= number <= 360.0 and number % 360.0 == azimuth
    return None if agrees else f"direction is {component} in the text of the header and {number:g} in its integers"


def is_vertical(component: str) -> bool:
    """Whether a component is one of the vertical direction: UP, V, U-D, UD2, HNZ, "VERTICAL COMP"."""
    words = re.findall(r"[^\W_]+", component.upper())
    if not words:
        return False
    if words[0] in {"V", "Z", "U"} or re.fullmatch(r"[A-Z][HNGLP]Z\d{0,2}|UD[12]", words[0]):
        return True
    return any((word in _UP and len(word) > 1) or word.startswith(("VERT", "上下")) for word in words)


PER_SECOND: Final = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds", "seg"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisec", "millisecond", "milliseconds"), 1e3),
    **dict.fromkeys(("us", "usec", "µs", "μs", "microsec", "microsecond", "microseconds"), 1e6),
    **dict.fromkeys(("min", "mins", "minute", "minutes"), 1.0 / 60.0),
    **dict.fromkeys(("h", "hr", "hrs", "hour", "hours"), 1.0 / 3600.0),
}
"""How many of a unit of time make one second."""

_WORDS: Final[tuple[tuple[str, re.Pattern[str]], ...]] = tuple(
    (kind, re.compile(rf"(?<![^\W_])(?:{words})(?![^\W_])", re.IGNORECASE))
    for kind, words in (
        # A spectrum, a hazard curve, a list or soil properties: what stands beside motions and looks like them.
        (
            "no motion",
            r"p?-?s[ ]?[aev]\d*|sae|sde|s[ ]d|sd|cs|fas|psd|sas|rotd\d+|gm?rotd?i?\d+|fourier"
            r"|spectr(?:um|a|al)|response|ordinates?"
            r"|frequency|frequencies|freq|hz|periods?|periodo|hazard|probabilit\w*|exceedance|poe|annual|iml|imt|pga|pgv"
            r"|factors?|scale|ratio|damping|depth|strain|stress|force|moment|drift|power|gain|amplification|transfer"
            r"|phase|magnitude|distance|rsn|vs30|target|design|mean|median|sigma|husid|arias|rotation|temperature"
            r"|pressure|latitude|longitude|lat|lon",
        ),
        (
            "acceleration",
            r"acc\w*|acel\w*|accél\w*|ac|beschl\w*|ivme\w*|ускорени\w*|加速度|a[gc]?[ ]?[xyz]|ag|a|ug|xg|u\"g|ga",
        ),
        ("velocity", r"(?<!wave )(?<!wave-)vel\w*|geschwindigkeit|vitesse|h\u0131z\w*|vgx?"),
        ("displacement", r"disp\w*|desp\w*|desloc\w*|dis|verschiebung|d[eé]placement|spostament\w*|yerdeğ\w*"),
        ("index", r"samples?|no|nr|num(?:ber)?|index|idx|points?|counts?|rows?|steps?|item|nº"),
    )
)
_TIMES: Final = re.compile(
    r"times?|t|tiempos?|zeit|temps|tempo|zaman|relativetime|tijd|secs?|seconds?|sekunden|segundos|elapsed|ms|время|時間|时间"
)
_OF_TIMES: Final = re.compile(r"s|relative|of|the|since|start|from|trigger|in|record|axis|vector|de|du|del")
"""What a column of times is called, and what may stand beside it; T1, tau or a rise time is none."""
_BARE: Final = {
    **dict.fromkeys(("i", "n", "id", "#"), "index"),
    **dict.fromkeys(("f", "s"), "no motion"),
    "v": "velocity",
    "d": "displacement",
}
"""Letters that say a quantity where they are the whole label."""
SHORT_LABEL: Final = 3
"""A title has more words than a label."""

_PROSE = re.compile(r"[=:]|\d\.\d|\d{4}")
_DATE = re.compile(r"(?<![a-z])(?:date|datetime|utc|fecha|timestamp|hour|clock)(?![a-z])", re.IGNORECASE)
_BRACKET = re.compile(r"[(\[]\s*([^)\]]*?)\s*[)\]]")
_BRACKETED = re.compile(r"[^(\[)\]]+[(\[][^)\]]*[)\]]")
_NO_NUMBERS = re.compile(r"^\s*(?:#|%|//|!|\*)\s*")
_LETTER: Final = r"[^\W\d_]"
_DIRECTION = re.compile(
    rf"(?<!{_LETTER})([NS]-?[NS]|[EWO]-?[EWO]|U-?[DP]|K-?G|D-?B|[NSEWZUVXYHLT]|north|south|east|west|up|down|vert\w*"
    r"|nor(?:te|d)|s[uü]d|su[rl]|l?este?|ost|ou?[ev]s?st|oeste|kuzey|güney|doğu|bat\u0131|düşey|senkrecht|上下"
    r"|[BEHLS][HNGL][NEZ12]|long(?:itudinal)?|trans(?:vers\w*)?|h[12xy]|[NS]\d{1,2}[EW]|(?:comp\w*|ch\w*)[ ._-]?\d+"
    r")(?![^\W_])",
    re.IGNORECASE,
)
_DEGREE: Final = r"deg\w*|°|º|grad(?:os?|i)|graus|degrés|derece"
_AZIMUTHS: Final = tuple(
    re.compile(pattern, re.IGNORECASE)
    for pattern in (
        rf"(?<![^\W_])(\d{{1,3}})[ ]?(?:{_DEGREE})",
        r"(?<![^\W_])(?:azi\w*|az|acimut|rumbo)[^\w\d]*(\d{1,3})(?![^\W_])",
        r"(?<![^\W_])(\d{3})(?![^\W_])",
        r"(?<![^\W_])(\d{1,3})(?![^\W_])",
    )
)
"""Numbers that are azimuths: with degrees, behind the word, of three digits, and one of a pair 90 degrees apart. The
last two count only where no word of the label says that it counts something: a floor, a node, a run."""
_CHANNEL_WORDS = re.compile(r"(?<![^\W_])(?:ch\w*|column\w*|sensor|station|samples?)", re.IGNORECASE)
_AXIS = re.compile(r"a[gc]?[ ]?([xyz])", re.IGNORECASE)
_VELOCITIES: Final = re.compile(r"(?:[cm]?m|in(?:ch)?|ft|km)\s*/\s*s(?:ec)?|kine|cm s-1|m s-1", re.IGNORECASE)
_DISPLACEMENTS: Final = frozenset({"m", "cm", "mm", "in", "inch", "inches", "ft", "feet"})
_UNITS_OF_NO_MOTION: Final = re.compile(
    r"hz|rad(?:/s\d?)?|deg\w*|kn|n|kpa|mpa|kips?|g[ .*-]?s(?:ec)?|counts?|volts?|m?v|1/y\w*|cm2?/s3|.*\*\*.*|db",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Label:
    """One label: its text, what it is of, its unit as written, and the direction that it names. `kind` is "times",
    "index", "date", "acceleration", "velocity", "displacement", "no motion" or "".
    """

    text: str
    kind: str
    unit: str = ""
    direction: str = ""
    words: str = ""


RAW: Final = re.compile(
    r"(?:raw|un(?:corrected|filtered|processed)|crud\w*|brut\w*|roh|grezz\w*|original|ham)", re.IGNORECASE
)
CORRECTED: Final = re.compile(
    r"(?:corrected|filtered|processed|filtr\w*|corr[ei]g\w*|corrett\w*|gefiltert|korrig\w*|processad\w*|bandpass|baseline)",
    re.IGNORECASE,
)


def uncorrected_beside(labels: list[Label]) -> dict[int, str]:
    """Return which labels are of motions that stand corrected in another column, and that column's label."""
    words = [re.findall(r"[^\W_]+", one.words.lower()) for one in labels]
    rest = [[word for word in one if not RAW.fullmatch(word) and not CORRECTED.fullmatch(word)] for one in words]
    done = [any(map(CORRECTED.fullmatch, one)) and not any(map(RAW.fullmatch, one)) for one in words]
    return {
        index: labels[other].text
        for index, of_one in enumerate(rest)
        for other, of_other in enumerate(rest)
        if of_one == of_other and done[other] and not done[index]
    }


def place_of(label: Label) -> str:
    """Return what a label of accelerations says beside them, their direction and processing: where they are from."""
    clauses = re.split(r"[,;:]", label.words)
    clause = next((one for one in clauses if _kind(one, "") == "acceleration"), label.words)
    return "" if is_plain(clause) or len(clause.split()) > 2 * SHORT_LABEL else clause.strip()


def label_of(text: str) -> Label:
    """Return what one label says."""
    text = text.strip().strip('"').strip()
    match = _BRACKET.search(text)
    unit = match[1].strip() if match else ""
    words = _BRACKET.sub(" ", text).replace("_", " ").strip()
    if not match:  # a unit may stand without a bracket: "NS gal", "Acc g"
        last = words.split()[-1:] if len(words.split()) > 1 else []
        if last and (unit_by_name(last[0]) or last[0].lower() in PER_SECOND):
            unit, words = last[0], " ".join(words.split()[:-1])
    kind = _kind(words, unit)
    direction = _direction(words) if kind in ("acceleration", "") else ""
    if words.strip().lower() in ("s", "f"):  # a spectrum over T, a frequency
        return Label(text, "no motion", unit)
    if kind == "" and direction and _is_all_direction(words, direction):
        kind = "acceleration" if not unit or _is_acceleration(unit) else kind
    if kind == "" and not words and unit:
        kind = _kind(unit, unit)
    return Label(text, kind, unit, direction, words)


def _kind(words: str, unit: str) -> str:
    word = next((kind for kind, pattern in _WORDS if pattern.search(words)), "")
    tokens = re.findall(r"[^\W_]+", words.lower())
    others = [token for token in tokens if not _TIMES.fullmatch(token)]
    if word in ("", "index") and len(others) < len(tokens) and all(map(_OF_TIMES.fullmatch, others)):
        word = "times"
    if _DATE.search(words) and not re.search("relative|elapsed", words, re.IGNORECASE):
        return "date"
    if word == "no motion":
        return word
    if _is_acceleration(unit):
        return word if word in ("velocity", "displacement") else "acceleration"
    bare = unit.lower()
    if _VELOCITIES.fullmatch(bare):
        return "velocity"
    if bare in _DISPLACEMENTS and word != "times":
        return "displacement"
    if bare and bare not in PER_SECOND and _UNITS_OF_NO_MOTION.fullmatch(bare):
        return "no motion"
    return word or _BARE.get(words.strip().lower(), "")


def _is_acceleration(unit: str) -> bool:
    return unit_by_name(unit) is not None


def _direction(words: str) -> str:
    """Return the direction that a label names, as it writes it."""
    axis = _AXIS.fullmatch(words.strip())
    if axis:
        return axis[1]
    degrees = _azimuth_in(words, paired=False)
    if degrees:
        return degrees
    directions: list[str] = _DIRECTION.findall(words)
    known = [one for one in directions if azimuth_of(one) is not None or is_vertical(one)]
    return next(iter([*known, *directions]), "")


def _is_all_direction(words: str, direction: str) -> bool:
    """Whether a label has nothing beside its direction."""
    tokens = re.findall(r"[^\W_]+", words)
    known = all(azimuth_of(token) is not None or is_vertical(token) for token in tokens)
    return known or direction.strip() == words.strip() or direction == _azimuth_in(words, paired=False)


def _azimuth_in(words: str, *, paired: bool) -> str:
    """Return the number of a label that is an azimuth, or could be one of a pair, as it is written."""
    counted = not is_plain(words) or _CHANNEL_WORDS.search(words) is not None
    for pattern in _AZIMUTHS[:2] if counted else _AZIMUTHS[: 4 if paired else 3]:
        number = pattern.search(words)
        if number and int(number[1]) <= 360:
            return number[1]
    return ""


def labels_of(header: list[str], columns: int) -> list[Label] | None:
    """Return the labels of that many columns, from the last line of the header that has as many; None without one."""
    for line in reversed(header[-4:]):
        if len(line) > LINE_WIDTH or _PROSE.search(line):
            continue
        for parts, separated in _splits(_NO_NUMBERS.sub("", line), columns):
            labels = _beside_each_other([label_of(part) for part in parts])
            named = sum(1 for label in labels if label.kind)
            if named == columns or (columns > 1 and _short(labels) and _are_labels(labels, separated)):
                units = _units_below(header, line, columns)
                return [
                    one if one.unit or not unit else label_of(f"{one.text} ({unit})")
                    for one, unit in zip(labels, units, strict=True)
                ]
    return None


def _beside_each_other(labels: list[Label]) -> list[Label]:
    """Return labels of one or two letters by what is beside them: V and N beside compass directions are vertical and
    north; X without the others' unit, or X and Y alone, are axes of a plot.
    """
    texts = [one.text.strip().lower() for one in labels]
    if len(labels) > 1 and all(text in PER_SECOND or unit_by_name(text) for text in texts):
        return [
            replace(one, kind="times" if text in PER_SECOND else "acceleration", unit=one.text, words="")
            for one, text in zip(labels, texts, strict=True)
        ]
    units = any(label.kind == "acceleration" and label.unit for label in labels)
    if texts == ["x", "y"] or units:
        labels = [Label(one.text, "") if one.text.lower() in ("x", "y") and not one.unit else one for one in labels]
    numbers = [_azimuth_in(_BRACKET.sub(" ", one.text), paired=True) for one in labels if one.kind == "acceleration"]
    if len(numbers) == 2 and all(numbers) and abs(int(numbers[0]) - int(numbers[1])) in (90, 270):
        pair = iter(numbers)
        labels = [replace(one, direction=next(pair)) if one.kind == "acceleration" else one for one in labels]
    if not any(azimuth_of(one.direction) is not None for one in labels if one.direction):
        return labels
    return [
        replace(one, kind="acceleration", direction=one.text) if text in ("v", "n") else one
        for one, text in zip(labels, texts, strict=True)
    ]


def _units_below(header: list[str], line: str, columns: int) -> list[str]:
    """Return the units of a line of units alone under that of the labels, or of none."""
    row = header.index(line) + 1
    if row < len(header):
        for parts, _ in _splits(_NO_NUMBERS.sub("", header[row]), columns):
            bare = [part.strip(" ()[]") for part in parts]
            if all(one.lower() in PER_SECOND or unit_by_name(one) for one in bare):
                return bare
    return [""] * columns


_OF_A_TITLE: Final = {"ground", "horizontal", "vertical", "strong", "input", "corrected", "uncorrected", "recorded"}
"""What stands before "acceleration" in a title."""


def _are_labels(labels: list[Label], separated: bool) -> bool:
    """Whether parts of a line of which not all are known are labels: by a separator, or beside one of accelerations."""
    if separated:
        return [one.text.lower() for one in labels] != ["x", "y"]
    unknown = {one.text.lower() for one in labels if not one.kind}
    return any(one.kind == "acceleration" for one in labels) and not unknown & _OF_A_TITLE


def _short(labels: list[Label]) -> bool:
    return all(len(label.text) <= 40 for label in labels)


def _splits(line: str, columns: int) -> list[tuple[list[str], bool]]:
    """Return the ways to take a line apart into so many: by a separator, as the second says, or by blanks."""
    ways: list[tuple[list[str], bool]] = []
    for separator in (";", "\t", ","):
        if separator in line:
            parts = next(csv.reader([line], delimiter=separator)) if '"' in line else line.split(separator)
            ways.append((parts, columns > 1))
    if columns == 1:
        ways.append(([line], False))
    ways.append((re.split(r"\s{2,}", line.strip()), columns > 1))
    ways.append((_BRACKETED.findall(line), False))
    joined: list[str] = []
    for word in line.split():
        opened = bool(joined) and re.search(r"[(\[][^)\]]*$", joined[-1]) is not None
        if joined and (opened or word[0] in "(["):
            joined[-1] += f" {word}"
        else:
            joined.append(word)
    ways.append((joined, False))
    return [way for way in ways if len(way[0]) == columns]


def no_motion(labels: list[Label]) -> str | None:
    """Return the labels where they are not those of a motion: a spectrum, a hazard curve, a list. The line above one
    column may be any title; it counts only where it is a short label.
    """
    named = [label for label in labels if label.kind == "no motion"]
    if not named or (len(labels) == 1 and len(_BRACKET.sub(" ", labels[0].text).split()) > SHORT_LABEL):
        return None
    return ", ".join(label.text for label in labels)[:60]


_SPECTRUM = re.compile(
    r"(?:response|fourier|design|target|hazard|elastic|power|amplitude)[ \t]+(?:amplitude[ \t]+)?spectr(?:um|a)"
    r"|spectral[ \t]+(?:acceleration|velocit|displacement|ordinate)|hazard[ \t]+curve|uniform[ \t]+hazard"
    r"|pseudo[- ]?(?:spectral|acceleration)|\bFAS\b|\bPSA\b|exceedance",
    re.IGNORECASE,
)
_MOTION = re.compile(
    r"time[ -]?(?:series|histor)|accelerogram|acceleration[ \t]+(?:record|data)|ground[ \t]+motion|matched",
    re.IGNORECASE,
)


def spectrum_named(header: str) -> str | None:
    """Return what a header calls a spectrum or a hazard curve, where it speaks of no motion; else None."""
    match = _SPECTRUM.search(header)
    return match.group().lower() if match and not _MOTION.search(header) else None


FIRST_TIME: Final = 1.5
"""A first time is 0 or one step, or there was something before it."""

_PLAIN_UNITS: Final = {1000.0: "ms", 60.0: "minutes", 1e6: "us"}


@dataclass(frozen=True)
class Times:
    """A column of times: values and as written, its label where it has one, and where it stands."""

    values: NDArray[np.float64]
    written: Sequence[str]
    label: Label | None
    file: str
    line_number: Callable[[int], int]


def step_of_times(times: Times, dt: float | None, remarks: list[str]) -> float | None:
    """Return the step (s) of a column of times, which must be uniform or those of `dt` rounded; None where it only
    counts the samples and no `dt` is given. `remarks` gets what was interpreted.
    """
    unit = times.label.unit.strip().lower() if times.label and times.label.kind == "times" else ""
    if unit and unit not in PER_SECOND:
        raise RecordFormatError(f"unit of the times of {times.file} must be s, ms, us, min or h; got {unit!r}")
    scaled = times.values / PER_SECOND.get(unit, 1.0)
    counts = _is_index(times, unit)
    if counts:
        remarks.append("the first column counts the samples" if dt else "the first column counts the samples: no times")
        return None
    try:
        step = uniform_step(times.values, times.written, times.file, times.line_number, rounding=False)
        step = step / PER_SECOND.get(unit, 1.0)
    except RecordFormatError as error:
        return _step_of_rounded(times, PER_SECOND.get(unit, 1.0), dt, error, remarks)
    if abs(scaled[0]) > FIRST_TIME * step:
        remarks.append(f"the first time is {scaled[0]:g} s: a beginning may be missing; it is taken as zero")
    if dt is not None and not unit and not np.isclose(step, dt, rtol=1e-3):
        factor = next((per for per in _PLAIN_UNITS if np.isclose(step / dt, per, rtol=1e-6)), None)
        if factor is None and np.isclose(step * 60.0, dt, rtol=1e-4):
            factor = 1.0 / 60.0
        if factor is not None:
            remarks.append(f"the times are {_PLAIN_UNITS.get(factor, 'minutes')} by the step that was given")
            return dt
    if not SHORTEST_STEP <= step <= LONGEST_STEP:
        words = f"in {unit}" if unit else "whose unit no label states"
        raise RecordFormatError(
            f"step of {times.file} must be between {SHORTEST_STEP:g} and {LONGEST_STEP:g} s; got {step:g} s from times "
            f"{words}: ms, minutes or a count of samples? Say dt"
        )
    return step


def _is_index(times: Times, unit: str) -> bool:
    """Whether a column counts the samples: by its label, or by whole numbers one apart without a unit."""
    differences = np.diff(times.values)
    ones = len(differences) > 0 and bool(np.all(differences == 1.0))
    if times.label is not None and times.label.kind == "index":
        if not ones:
            raise RecordFormatError(f"index of {times.file} must count by ones; got {times.label.text}")
        return True
    return ones and not unit and not any("." in token for token in times.written)


def _step_of_rounded(
    times: Times, per_second: float, dt: float | None, error: RecordFormatError, remarks: list[str]
) -> float:
    """Return the step that is given where the times are its multiples, rounded to their last digit."""
    half = 0.5 * last_digits([token.strip() for token in times.written])
    half[0] = half.min()
    count = np.arange(len(times.values))
    if dt is not None:
        off = np.abs(times.values - times.values[0] - dt * per_second * count)
        if np.all(off <= (half + half[0]) * (1.0 + 1e-6)):
            remarks.append(f"times are rounded; they agree with the step that was given, {dt!r} s")
            return dt
        raise error
    digit = 2.0 * float(half.max())
    span = float(times.values[-1] - times.values[0])
    rising = len(times.values) > 1 and bool(np.all(np.diff(times.values) >= 0.0)) and span > 0.0
    mean = span / max(len(times.values) - 1, 1)
    allowed = digit if mean < 0.9 * digit else 0.75 * digit
    near = np.abs(times.values - times.values[0] - mean * count) <= allowed * (1.0 + 1e-9)
    if rising and mean < 10.0 * digit and np.all(near):
        least, most = (span - digit) / (len(count) - 1), (span + digit) / (len(count) - 1)
        raise RecordFormatError(
            f"times of {times.file} must be uniform; got times rounded to {digit / per_second:g} s: give dt, which is "
            f"between {least / per_second:.7g} and {most / per_second:.7g} s"
        ) from error
    raise error
