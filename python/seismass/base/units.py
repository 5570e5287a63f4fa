"""Standard gravity, the systems of units in which results are shown, and the units of accelerations in files."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Final

from seismass import _kernel
from seismass.base.errors import SeismassError
from seismass.base.values import brief, refusal, signed

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

_QUANTITIES: Final = {
    "height": ("m", 1.0, ".4g", "ft", FOOT, ".4g"),
    "area": ("m\N{SUPERSCRIPT TWO}", 1.0, ".6g", "ft\N{SUPERSCRIPT TWO}", FOOT**2, ".6g"),
    "load": ("kPa", 1e3, ".3g", "psf", 1e-3 * KIP / FOOT**2, ".3g"),
    "force": ("kN", 1e3, ".0f", "kip", KIP, ".0f"),
    "stiffness": ("kN/mm", 1e6, ".1f", "kip/in", KIP / INCH, ".0f"),
    "mass": ("t", 1e3, ".1f", "kip s\N{SUPERSCRIPT TWO}/ft", KIP / FOOT, ".2f"),
    "slip": ("mm", 1e-3, ".0f", "in", INCH, ".1f"),
    "drift": ("mm", 1e-3, ".2f", "in", INCH, ".3f"),
    "velocity": ("m/s", 1.0, ".2f", "in/s", INCH, ".1f"),
    "displacement": ("m", 1.0, ".2f", "in", INCH, ".1f"),
}
"""Of each quantity its unit, that in SI units, and the form of a number, in SI and in US units."""


@dataclass(frozen=True)
class Units:
    """A system of units in which results are shown: "si" or "us"."""

    name: str

    def of(self, quantity: str) -> tuple[str, float, str]:
        """Return the unit of a quantity, that in SI units, and the form of a number."""
        row = _QUANTITIES[quantity]
        return row[:3] if self.name == "si" else row[3:]

    def unit(self, quantity: str) -> str:
        """Return the unit of a quantity."""
        return self.of(quantity)[0]

    def number(self, quantity: str, value: float, form: str = "") -> str:
        """Return a value in SI units as a number; with its own digits where no form is asked for."""
        _, size, usual = self.of(quantity)
        return signed(value / size, form or usual)

    def text(self, quantity: str, value: float, form: str = "") -> str:
        """Return a value in SI units as a number with its unit."""
        return f"{self.number(quantity, value, form)} {self.unit(quantity)}"

    def drifts(self, *, ratio: bool) -> tuple[float, str]:
        """Return by what a drift is multiplied and the unit that it then has: per cent of a ratio, or a length."""
        unit, size, _ = self.of("drift")
        return (1e2, "%") if ratio else (1.0 / size, unit)

    def both(self, quantity: str, value: float) -> str:
        """Return a value in SI units in this system, and in brackets in the other."""
        other = UNITS["si" if self.name == "us" else "us"]
        return f"{self.text(quantity, value)} ({other.text(quantity, value)})"


UNITS: Final = {name: Units(name) for name in ("si", "us")}
"""The systems that `units` of a building file names."""

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
_PER_SECOND_SQUARED: Final = (
    rf"(?:(?P<length>[a-z]+)[ \t]*/[ \t]*(?:"
    rf"{_SECOND}(?:[ \t]*/[ \t]*{_SECOND}(?![a-z])|[ \t]*(?:\*\*|\^)?[ \t]*(?:2(?![\d.])|²))"
    rf"|\({_SECOND}[ \t]*(?:/|\*|\.)[ \t]*{_SECOND}\))"
    r"|(?P<short>mm|cm|m|in|ft)[ \t]*[.*·]?[ \t]*s(?:ec)?[ \t]*(?:\*\*|\^)?[ \t]*(?:-2(?![\d.])|⁻²))"
)
_MENTION = re.compile(
    rf"(?<![^\W\d_]|[/%]){_PER_SECOND_SQUARED}|(?<![^\W\d]|[/%])(?P<gal>gals?\b(?!\.))"
    r"|(?<![^\W\d]|[/%.*])(?P<g>(?:%|percent|per cent)[ \t]*(?:of[ \t]+)?g|mg|milli-?[ \t]?g|g)(?:'s)?(?![^\W_])"
    r"(?![ \t]*[/*^])",
    re.IGNORECASE,
)
_UNIT_WORD: Final = r"(?:units?|unidad(?:es)?|unidades?|unità|unita|unités?|unites?|einheit(?:en)?|birim\w*)"
_HEADS: Final = (
    rf"{_UNIT_WORD}|acc\w*|acel\w*|accél\w*|beschl\w*|ivme(?:si|leri)?|ускорени\w*|加速度|единиц\w*|単位|单位"
    r"|a[gc]?|a[gc]?[xyz]|[ux]g|data|datos|dati|dados|données|donnees|daten|samples?|muestras|campioni|amostras"
    r"|values?|valores|valori|valeurs|werte|amplitudes?|amplitud|ordinates?"
)
_NEUTRAL: Final = (
    r"in|of|is|are|the|all|each|both|and|to|time|series|serie|history|histories|record|records|recorded|registro"
    r"|ground|motion|strong|accelerogram\w*|trace|input|component\w*|comp|channels?|chan|ch|columns?|horizontal"
    r"|vertical|corrected|uncorrected|processed|unprocessed|unscaled|scaled|raw|filtered|baseline|bandpass|given"
    r"|expressed|measured|stored|written|measurement|misura|si|en|de|del|della|delle|dei|di|da|das|do|dos|la|las|los|el|le|les"
    r"|des|du|em|im|der|die|den|von|y|e|et|und|expresad\w*|espress\w*|exprim\w*|station|sensor|instrument|corregid\w*"
    r"|unfiltered|filtr\w*|gefiltert|roh|crud\w*|brut\w*|grezz\w*|original|ham|korrig\w*|corrig\w*|corrett\w*|processad\w*|deg|degrees|azimuth?|az|dir|direction|fault|normal|parallel|radial|tangential"
)
_COMPASS: Final = (
    r"[nsewouvzhltxydpkgb]|[ns][sn]|[ewo][ewo]|ud|up|down|north|south|east|west|norte|sur|sul|sud|nord|süd|este|leste|oeste"
    r"|est|ovest|ouest|ost|kuzey|güney|doğu|bat\u0131|düşey|vert\w*|kg|db|hn[nez12]|[behls][hngl][nez12]|long\w*|trans\w*|fn|fp"
)
_HEAD = re.compile(_HEADS)
_WORD = re.compile(rf"{_HEADS}|{_NEUTRAL}|{_COMPASS}")
_DIRECTION = re.compile(_COMPASS)
_VALUE_BEFORE = re.compile(r"\d[\d.,]*(?:[ed][+-]?\d+)?[ \t]*$", re.IGNORECASE)
_VALUE_AFTER = re.compile(r"[ \t'\")\]]*(?:[:=][ \t]*[+-]?\.?\d|[ \t][+-]?\d*\.\d)")
_JOINED = re.compile(
    r"(?:[\s:=,&(\[{'\"]+|(?<=[\s:=(\[,])(?:s|secs?|seconds?)(?=[\s,&])|(?<=[\s,])(?:and|y|et|und)(?=\s))+$",
    re.IGNORECASE,
)
_OR = re.compile(r"[\s)\]]*(?:or|and|=|,|/)?[\s(\[]*", re.IGNORECASE)
_ALONE = re.compile(r"[\s)\]]*(?:[,;]|$|or\b)", re.IGNORECASE)
_CLAUSES = re.compile(r"[,;:|\t=)\]]|\s{2,}|(?<!acc)(?<!accel)(?<!acel)(?<!comp)\.\s", re.IGNORECASE)
_PLURAL = re.compile(rf"\b({_UNIT_WORD})\((?:s|es|en)\)", re.IGNORECASE)
_BARE = re.compile(r"(?:[\W_]|\b(?:s|ms|secs?|seconds?|or|and)\b)*", re.IGNORECASE)
_UNITS_OF = re.compile(
    rf"\b{_UNIT_WORD}[ \t]*(?:of[ \t]+(?=[\d.]*[^:=.,;]*(?:[.,;]|$))|[:=][ \t]*)([^\s].*)", re.IGNORECASE
)
_UNIT_LIKE = re.compile(r"[/%\d]|count|volt|digit", re.IGNORECASE)


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
    whole = re.fullmatch(_PER_SECOND_SQUARED, text.strip("()[]"), re.IGNORECASE)
    key = _name_of(whole) if whole else _SPELLINGS.get(text)
    return key if key in ACCELERATION_UNITS else None


def unit_named(text: str) -> str | None:
    """Return the acceleration unit that a text names which is about nothing else, such as "gal (cm/s/s)"."""
    units = {_name_of(mention) for mention in _MENTION.finditer(text)}
    return units.pop() if len(units) == 1 and units <= set(ACCELERATION_UNITS) else None


def units_elsewhere(text: str) -> list[str]:
    """Return the units that a header names without a number before them, whatever it says them of, but g."""
    units = {_name_of(one) for one in _MENTION.finditer(text) if not _VALUE_BEFORE.search(text[: one.start()])}
    return sorted(units & set(ACCELERATION_UNITS) - {"g"})


def stated_unit(text: str) -> str | None:
    """Return the acceleration unit that a header states of its samples, or None: none, several or another."""
    units = stated_units(text)
    return units[0] if len(units) == 1 and units[0] in ACCELERATION_UNITS else None


def unknown_unit(text: str) -> str | None:
    """Return the units that a header states where it is not a single one of `ACCELERATION_UNITS`; else None."""
    return None if stated_unit(text) else " and ".join(stated_units(text)) or None


def stated_units(text: str) -> list[str]:
    """Return every unit that a header states of its samples, by its name in `ACCELERATION_UNITS` if it is there: behind
    words of a short list that say so, or alone in its line. Behind a number or other words it is of something else.
    """
    units: set[str] = set()
    for line in _PLURAL.sub(r"\1", text).splitlines():
        bare = _BARE.fullmatch(_MENTION.sub("", line)) is not None
        units |= {_name_of(one) for one in _MENTION.finditer(line) if bare or _is_of_samples(line, one)}
        for statement in _UNITS_OF.finditer(line):
            time = re.search(r"(?i)\btime\s*$", line[: statement.start()])
            if not time and _allowed(line[: statement.start(1)]) and (statement[1][0] in ".0123456789" or not units):
                units.add(_multiple(statement[1]) or statement[1].strip()[:30])
    return sorted(units)


def _multiple(text: str) -> str | None:
    """Return the unit that "0.01 m/s2" is, or None."""
    mention = _MENTION.search(text)
    number = re.fullmatch(r"(\d*\.?\d+)[ \t]*", text[: mention.start()]) if mention else None
    size = float(number[1]) * ACCELERATION_UNITS.get(_name_of(mention), 0.0) if mention and number else 0.0
    return next((name for name, unit in ACCELERATION_UNITS.items() if abs(unit - size) < 1e-9 * unit), None)


def _is_of_samples(line: str, mention: re.Match[str]) -> bool:
    before = line[: mention.start()]
    earlier = list(_MENTION.finditer(before))
    if earlier and _OR.fullmatch(before, earlier[-1].end()):
        return _is_of_samples(line, earlier[-1])
    if _VALUE_BEFORE.search(before) or _VALUE_AFTER.match(line, mention.end()):
        return False
    words = _allowed(before)
    bracket = before.rstrip()[-1:] in ("(", "[") or not line[mention.end() :].strip()
    if not re.search(r"\w", before) and _ALONE.match(line, mention.end()):
        return True
    return any(_HEAD.fullmatch(word) for word in words) or (bracket and any(map(_DIRECTION.fullmatch, words)))


def is_plain(label: str) -> bool:
    """Whether a label has no words but those of accelerations of the ground, their directions and processing."""
    words = re.findall(r"[^\W\d_]+", label.casefold().replace("\u0307", ""))
    return all(map(_WORD.fullmatch, words))


def names_unit(text: str) -> bool:
    """Whether a text names an acceleration unit, of whatever."""
    return _MENTION.search(text) is not None


def _allowed(before: str) -> list[str]:
    """Return the words of the clause that ends a text, where all of them may stand between a unit and the samples."""
    clause = _CLAUSES.split(_JOINED.sub("", before))[-1]
    words = re.findall(r"[^\W\d_]+", re.sub(r"(?<=[a-z])(?=[A-Z])", " ", clause).casefold().replace("\u0307", ""))
    return words if all(map(_WORD.fullmatch, words)) else []


def _name_of(mention: re.Match[str]) -> str:
    """Return the name of the unit that was found in a text."""
    parts = mention.groupdict()
    length = (parts["length"] or parts["short"] or "").lower()
    if length:
        return f"{_LENGTHS.get(length, length)}/s2"
    part = (parts.get("g") or "").lower()
    return "cm/s2" if not part else "%g" if part[0] in "%p" else "mg" if part[0] == "m" else "g"


def contradiction(text: str, unit: str) -> str | None:
    """Return the unit that a header states where it is not `unit`, a key of `ACCELERATION_UNITS`; else None. Words
    behind "units:" that are no unit ("see below") contradict nothing.
    """
    units = [one for one in stated_units(text) if one in ACCELERATION_UNITS or _UNIT_LIKE.search(one)]
    same = ACCELERATION_UNITS[unit]
    if not units or any(ACCELERATION_UNITS.get(one) == same for one in units):
        return None
    return " and ".join(units)
