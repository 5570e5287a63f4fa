"""What the labels of columns say: times, accelerations, another quantity, or a spectrum, which is not a motion."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from typing import Final

from seismass.base.units import stated_units, unit_by_name
from seismass.records.formats.common import LINE_WIDTH
from seismass.records.formats.directions import azimuth_of, is_vertical

PER_SECOND: Final = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds", "seg"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisec", "millisecond", "milliseconds"), 1e3),
    **dict.fromkeys(("us", "usec", "µs", "μs", "microsec", "microsecond", "microseconds"), 1e6),
    **dict.fromkeys(("min", "mins", "minute", "minutes"), 1.0 / 60.0),
    **dict.fromkeys(("h", "hr", "hrs", "hour", "hours"), 1.0 / 3600.0),
}
"""How many of a unit of time make one second."""

_WORDS: Final[tuple[tuple[str, re.Pattern[str]], ...]] = tuple(
    (kind, re.compile(rf"(?<![a-z0-9])(?:{words})(?![a-z0-9])", re.IGNORECASE))
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
        ("acceleration", r"acc\w*|acel\w*|ac|beschl\w*|a[gc]?[ ]?[xyz]|ag|a|ug|xg|u\"g|ga"),
        ("velocity", r"(?<!wave )(?<!wave-)vel\w*|geschwindigkeit|vitesse|vgx?"),
        ("displacement", r"disp\w*|desp\w*|dis|verschiebung|d[eé]placement"),
        ("times", r"time\w*|t|tiempo|zeit|temps|tempo|relativetime|elapsed|sec(?:onds?)?|zaman"),
        ("index", r"samples?|no|nr|num(?:ber)?|index|idx|points?|counts?|rows?|steps?|item|nº"),
    )
)
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
_DIRECTION = re.compile(
    r"(?<![A-Za-z])([NS]-?[NS]|[EWO]-?[EWO]|U-?[DP]|[NSEWZUVXYHLT]|north|south|east|west|up|down|vert(?:ical)?"
    r"|[BEHLS][HNGL][NEZ12]|long(?:itudinal)?|trans(?:verse)?|h[12xy]|[NS]\d{1,2}[EW]|(?:comp\w*|ch\w*)[ ._-]?\d+"
    r"|\d{1,3})(?![A-Za-z\d])",
    re.IGNORECASE,
)
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


def label_of(text: str) -> Label:
    """Return what one label says."""
    text = text.strip().strip('"').strip()
    found = _BRACKET.search(text)
    unit = found[1].strip() if found else ""
    words = _BRACKET.sub(" ", text).replace("_", " ").strip()
    if not found:  # a unit may stand without a bracket: "NS gal", "Acc g"
        last = words.split()[-1:] if len(words.split()) > 1 else []
        if last and (unit_by_name(last[0]) or last[0].lower() in PER_SECOND):
            unit, words = last[0], " ".join(words.split()[:-1])
    kind = _kind(words, unit)
    direction = _direction(words) if kind in ("acceleration", "") else ""
    if words.strip().lower() in ("s", "f"):  # a spectrum over T, a frequency
        return Label(text, "no motion", unit)
    if kind == "" and direction:
        kind = "acceleration" if not unit or _is_acceleration(unit) else kind
    if kind == "" and not words and unit:
        kind = _kind(unit, unit)
    return Label(text, kind, unit, direction)


def _kind(words: str, unit: str) -> str:
    said = next((kind for kind, pattern in _WORDS if pattern.search(words)), "")
    if _DATE.search(words) and not re.search("relative|elapsed", words, re.IGNORECASE):
        return "date"
    if said == "no motion":
        return said
    if _is_acceleration(unit):
        return said if said in ("velocity", "displacement", "no motion") else "acceleration"
    bare = unit.lower()
    if _VELOCITIES.fullmatch(bare):
        return "velocity"
    if bare in _DISPLACEMENTS and said != "times":
        return "displacement"
    if bare and bare not in PER_SECOND and _UNITS_OF_NO_MOTION.fullmatch(bare):
        return "no motion"
    if said == "" and bare in PER_SECOND:
        return "times"
    return said or _BARE.get(words.strip().lower(), "")


def _is_acceleration(unit: str) -> bool:
    return unit_by_name(unit) is not None or unit_by_name(f"({unit})") is not None


def _direction(words: str) -> str:
    """Return the direction that a label names, as it writes it."""
    axis = _AXIS.fullmatch(words.strip())
    if axis:
        return axis[1]
    found: list[str] = _DIRECTION.findall(words)
    known = [one for one in found if azimuth_of(one) is not None or is_vertical(one)]
    return next(iter([*known, *found]), "")


def labels_of(header: list[str], columns: int) -> list[Label] | None:
    """Return the labels of so many columns, from the last of the non-blank header lines that has as many; None where
    none has.
    """
    for line in reversed(header[-4:]):
        if len(line) > LINE_WIDTH or _PROSE.search(line):
            continue
        for parts, separated in _splits(_NO_NUMBERS.sub("", line), columns):
            found = _beside_each_other([label_of(part) for part in parts])
            named = sum(1 for label in found if label.kind)
            if named == columns or (separated and named and _short(found)):
                units = _units_below(header, line, columns)
                return [
                    one if one.unit or not unit else label_of(f"{one.text} ({unit})")
                    for one, unit in zip(found, units, strict=True)
                ]
    return None


def _beside_each_other(labels: list[Label]) -> list[Label]:
    """Return labels of one or two letters by what is beside them: V and N beside compass directions are vertical and
    north; X without the others' unit, or X and Y alone, are axes of a plot.
    """
    texts = [one.text.strip().lower() for one in labels]
    if len(labels) > 1 and all(text in PER_SECOND or unit_by_name(text) for text in texts):
        return [
            Label(one.text, "times" if text in PER_SECOND else "acceleration", one.text)
            for one, text in zip(labels, texts, strict=True)
        ]
    units = any(label.kind == "acceleration" and label.unit for label in labels)
    if texts == ["x", "y"] or units:
        labels = [Label(one.text, "") if one.text.lower() in ("x", "y") and not one.unit else one for one in labels]
    if not any(azimuth_of(one.direction) is not None for one in labels if one.direction):
        return labels
    return [
        Label(one.text, "acceleration", one.unit, one.text) if text in ("v", "n") else one
        for one, text in zip(labels, texts, strict=True)
    ]


def _units_below(header: list[str], line: str, columns: int) -> list[str]:
    """Return the units of a line of units alone under that of the labels, or of none."""
    at = header.index(line) + 1
    if at < len(header):
        for parts, _ in _splits(_NO_NUMBERS.sub("", header[at]), columns):
            bare = [part.strip(" ()[]") for part in parts]
            if all(one.lower() in PER_SECOND or unit_by_name(one) for one in bare):
                return bare
    return [""] * columns


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
    ways.append((re.split(r"\s{2,}", line.strip()), False))
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
    found = _SPECTRUM.search(header)
    return found.group().lower() if found and not _MOTION.search(header) else None


def units_of(labels: list[Label]) -> list[str]:
    """Return the acceleration units that labels state, without doubles."""
    found: list[str] = []
    for label in labels:
        unit = unit_by_name(label.unit) or next(iter(stated_units(f"({label.unit})")), None)
        if unit and unit not in found:
            found.append(unit)
    return found
