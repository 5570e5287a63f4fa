"""A target spectrum from a file of the user's: a table of periods and ordinates, in any of the forms of programs."""

from __future__ import annotations

import csv
import json
import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.errors import InvalidMotion, InvalidOption, RecordFormatError
from seismass.base.files import decoded, read_file
from seismass.base.limits import MOST_TABLE, within_rows
from seismass.base.stored_results import inputs_digest
from seismass.base.units import ACCELERATION_UNITS, FOOT, INCH, STANDARD_GRAVITY, stated_unit, unit_by_name
from seismass.base.values import (
    FloatArray,
    as_array,
    as_number,
    as_path,
    brief,
    counted,
    frozen,
    printable,
    refusal,
    short,
)
from seismass.motions.elementary import exp, log
from seismass.motions.spectra.codes import PeriodTable
from seismass.motions.spectra.elastic import OWNER, GroundMotion, as_motions, mean_spectrum


@dataclass(frozen=True, eq=False)
class CsvTable(PeriodTable):
    """Sa (g) at periods (s) from a file, linear in logarithms between them."""

    label: str
    file: str

    @property
    def parameters(self) -> dict[str, Any]:
        """The file's name and its points."""
        return {"shape": "csv", "file": self.file, **self.points}

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return Sa (m/s2); linear in the period from 0 to the first positive one, which has no logarithm."""
        first = int(self.periods[0] == 0.0)
        start = self.periods[first]
        log_ordinates = np.interp(log(np.maximum(periods, start)), log(self.periods[first:]), log(self.sa_g[first:]))
        below = np.interp(periods, self.periods[: first + 1], self.sa_g[: first + 1])
        return STANDARD_GRAVITY * np.where(np.asarray(periods) < start, below, exp(log_ordinates))


def csv_shape(path: str | os.PathLike[str], unit: str | None = None, column: str | None = None) -> CsvTable:
    """Return the shape of a table, of which `TargetSpectrum.from_csv` says what it must be."""
    source = as_path(path, OWNER, RecordFormatError)
    periods, ordinates = read_table(path, unit, column)
    label = printable(source.stem) + (f", {printable(column)}" if column else "")
    return CsvTable(periods, ordinates, label, printable(source.name))


def file_and_words(text: str, folder: Path) -> tuple[Path, dict[str, str]]:
    """Return the file that a text names, and what stands behind it: FILE:UNIT, FILE:COLUMN or FILE:COLUMN:UNIT."""
    name, words = text, dict[str, str]()
    while ":" in name and not (folder / name).is_file():
        name, _, word = name.rpartition(":")
        words["unit" if unit_by_name(word) else "column"] = word
    return (folder / name, words) if (folder / name).is_file() else (folder / text, {})


@dataclass(frozen=True)
class _Spectrum:
    """One spectrum of a file: its name there, points as written, what its ordinates are of, and their unit."""

    name: str
    points: list[tuple[str, str]]
    unit: str = ""
    quantity: str = "Sa"


_PERIODS: Final = re.compile(
    r"(?:natural |structural |vibration )*(?:t|tn|(?:periods?|per[ií]odos?|p[ée]riodes?|perioden?|periodi|periyot|"
    r"schwingzeit|schwingungsdauer),?(?: tn?)?)"
)
_ORDINATES: Final = re.compile(
    r"(?<![^\W_])(?:p?sa[eh]?|se|sd|p?sv|acc?el\w*|ivme\w*|spe[ck]tral\w*|target|uhs|displacement|ordinates?|dbe|mce\w*|"
    r"values?|valor|valore|valeur|wert|de[gğ]er)(?![^\W_])"
)
_OF: Final = {
    "SD": re.compile(r"(?<![^\W_])(?:sd|displacement)(?![^\W_])"),
    "PSV": re.compile(r"(?<![^\W_])psv(?![^\W_])"),
}
_UNIT_OF: Final = {"Sa": "g", "SD": "m", "PSV": "m/s"}
_METRES: Final = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": INCH, "ft": FOOT}
_UNIFORM: Final = re.compile(r"(?:(?P<before>[^~]+)~)?(?:PGA|SA\((?P<period>[\d.]+)\))(?:[~-](?P<after>.+))?")
_PRINTED: Final = {"psv": "m/s", "sd": "m"}
_ROWS_OF: Final = ("motion", "record", "damping")
"""Columns that tell rows of several spectra apart, as `seismass spectrum` prints them."""


def read_table(
    path: str | os.PathLike[str], unit: str | None = None, column: str | None = None
) -> tuple[FloatArray, FloatArray]:
    """Return the periods (s) and Sa (g) of a file; see `TargetSpectrum.from_csv`."""
    source = as_path(path, OWNER, RecordFormatError)
    unit_name = unit_by_name(unit) if isinstance(unit, str) else None
    if unit is not None and unit_name is None:
        raise refusal(RecordFormatError, "unit", source.name, f"one of {', '.join(ACCELERATION_UNITS)}", brief(unit))
    if column is not None and not isinstance(column, str):
        raise refusal(RecordFormatError, "column", source.name, "a name", brief(column))
    try:
        text = decoded(read_file(source, MOST_TABLE))
    except (OSError, UnicodeDecodeError) as error:
        got = f"{source} ({getattr(error, 'strerror', None) or 'not text'})"
        raise refusal(RecordFormatError, "path", OWNER, "a file of text that can be read", got) from None
    if "\0" in text:
        got = f"{source} (not text)"
        raise refusal(RecordFormatError, "path", OWNER, "a file of text that can be read", got)
    within_rows(text, source.name, RecordFormatError)
    spectra = _json_spectra(text, source.name) if text.lstrip().startswith("{") else _table_spectra(text, source.name)
    return _one_of(spectra, unit_name, column, source.name)


def _one_of(spectra: list[_Spectrum], unit: str | None, column: str | None, file: str) -> tuple[FloatArray, FloatArray]:
    """Return the one spectrum of a file that is asked for, in g."""
    named = [one for one in spectra if column is not None and one.name.lower() == column.lower()]
    named = named or [one for one in spectra if column is not None and column.lower() in one.name.lower()]
    if column is None:
        named = [one for one in spectra if len(spectra) == 1 or "target" in one.name.lower()]
        of_sa = [one for one in spectra if unit_by_name(one.unit)]
        named = named or (of_sa if len(of_sa) == 1 else [])  # beside displacements and velocities
    if len(named) != 1:
        names = ", ".join(one.name for one in spectra)
        requirement = f"one, or named behind the file as {file}:{spectra[0].name}"
        raise refusal(RecordFormatError, "spectra", file, requirement, short(printable(names)) if names else "none")
    one = named[0]
    points = []
    for number, point in enumerate(one.points, start=1):
        for name, cell in zip(("period", one.quantity), point, strict=True):
            at_zero = number == 1 and name == "period" and _is_number(cell) and float(cell) == 0.0
            if not (at_zero or (_is_number(cell) and 0.0 < float(cell) < np.inf)):
                raise refusal(RecordFormatError, name, f"{file}, point {number},", "a positive number", brief(cell))
        points.append([float(cell) for cell in point])
    if len(points) < 2:
        raise refusal(RecordFormatError, "points", file, "at least two rows of period and Sa", str(len(points)))
    periods, ordinates = (frozen(column) for column in zip(*points, strict=True))
    falling = np.flatnonzero(np.diff(periods) <= 0.0)
    if len(falling):
        number = int(falling[0]) + 2
        got = f"{periods[number - 1]:g} after {periods[number - 2]:g}"
        raise refusal(RecordFormatError, "period", f"{file}, point {number},", "longer than the one before", got)
    return periods, frozen(_in_g(periods, ordinates, one, unit, file))


def _in_g(periods: FloatArray, ordinates: FloatArray, one: _Spectrum, unit: str | None, file: str) -> FloatArray:
    """Return ordinates as Sa (g): of displacements and pseudo-velocities by omega."""
    length = re.sub(r"/s(?:ec)?$", "", one.unit.lower())
    if one.quantity != "Sa" and length in _METRES and (one.unit.lower() != length) is (one.quantity == "PSV"):
        omega = 2.0 * np.pi / np.where(periods > 0.0, periods, np.nan)
        metres = ordinates * _METRES[length]
        if periods[0] == 0.0:
            raise refusal(RecordFormatError, "period", f"{file}, point 1,", f"positive beside {one.quantity}", "0")
        return metres * omega ** (1 if one.quantity == "PSV" else 2) / STANDARD_GRAVITY
    stated = unit_by_name(one.unit)
    if unit and stated and ACCELERATION_UNITS[unit] != ACCELERATION_UNITS[stated]:
        raise refusal(RecordFormatError, f"unit of {one.quantity}", file, f"that of its head, {stated}", unit)
    if not (unit or stated):
        otherwise = f"or behind the name as {file}:g or {file}:m/s2" if one.quantity == "Sa" else "a length or velocity"
        requirement = f"stated by the head as {one.quantity} ({_UNIT_OF[one.quantity]}), {otherwise}"
        raise refusal(
            RecordFormatError, f"unit of {one.quantity}", file, requirement, brief(one.unit) if one.unit else "none"
        )
    factor = ACCELERATION_UNITS[stated or unit or ""] / STANDARD_GRAVITY
    return ordinates if factor == 1.0 else ordinates * factor


def _json_spectra(text: str, file: str) -> list[_Spectrum]:
    """Return the spectra of an answer of the USGS design services, by their keys; Sa is in g there."""
    try:
        document = json.loads(text)
    except ValueError as error:
        raise refusal(RecordFormatError, "content", file, "sound JSON", str(error)) from None
    spectra: list[_Spectrum] = []

    def look(name: str, value: Any) -> None:
        if isinstance(value, dict):
            pairs = zip(value.get("periods", ()), value.get("ordinates", ()), strict=False)
            points = [(str(period), str(ordinate)) for period, ordinate in pairs]
            if points:
                spectra.append(_Spectrum(name, points, "g"))
            for key, inner in value.items():
                look(str(key), inner)
        elif isinstance(value, list) and "spectrum" in name.lower() and all(isinstance(one, list) for one in value):
            spectra.append(_Spectrum(name, [(str(one[0]), str(one[1])) for one in value if len(one) == 2], "g"))

    look(file, document)
    if not spectra:
        raise refusal(RecordFormatError, "content", file, "a spectrum of periods and ordinates", "none")
    return spectra


def _table_spectra(text: str, file: str) -> list[_Spectrum]:
    """Return the spectra of every table of a text: a column of periods and its others, or a row of uniform hazard."""
    marked = [line for line in text.splitlines() if line.strip(' ,;\t"')]
    lines = [line.strip() if "~" in line else line.strip().lstrip("#%!* ") for line in marked]
    plain = [line for line in marked if not line.lstrip().startswith("#")]
    separator = next((one for one in ("\t", ";", ",") if any(one in line for line in plain[-2:])), " ")
    cells = [_cells(line, separator, file) for line in lines]
    if separator != "," and (last := cells[-1:]) and any("," in one for one in last[0]) and "." not in "".join(last[0]):
        cells = [[one.replace(",", ".") for one in row] for row in cells]
    spectra: list[_Spectrum] = []
    for index, heads in enumerate(cells):
        uniform = [_UNIFORM.fullmatch(head.strip()) for head in heads]
        if sum(match is not None for match in uniform) > 1:
            return _uniform_hazard(uniform, cells[index + 1 :], file)
        period, ordinates = _columns_named(heads, file)
        if period is None or not ordinates:
            continue
        rows = [
            row for row, mark in zip(cells[index + 1 :], marked[index + 1 :], strict=True) if not mark.startswith("#")
        ]
        end = next((row for row, one in enumerate(rows) if row and not _is_number(one[0]) and len(one) < 2), len(rows))
        spectra += _of_columns(heads, period, ordinates, rows[:end], "\n".join(lines[:index]), file)
    if not spectra:
        rows = [row for row, mark in zip(cells, marked, strict=True) if not mark.lstrip().startswith("#")]
        if rows and not _is_number(rows[0][0]):
            got = short(", ".join(rows[0]))
            raise refusal(RecordFormatError, "columns", file, "one period or T and one Sa", got)
        unit = stated_unit("\n".join(lines)) or ""
        spectra = [_Spectrum("Sa", [(row[0], row[1] if len(row) > 1 else "") for row in rows], unit)]
    return spectra


def _cells(line: str, separator: str, file: str) -> list[str]:
    if separator == " ":
        wide = re.split(r"\s{2,}|\t", line)
        joined = re.sub(r"\s+(?=[(\[])", "\0", line).split()
        return [one.replace("\0", " ") for one in (wide if len(wide) > 1 else joined)]
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator, skipinitialspace=True))]
    except csv.Error as error:
        raise refusal(RecordFormatError, "content", file, "a table in CSV", str(error)) from error


def _name_and_unit(head: str) -> tuple[str, str]:
    """Return what a head calls its column, and the unit that it states: in brackets, or as its last word."""
    name = head.lower().replace("_", " ").strip()
    bracket = re.search(r"[(\[]\s*([^)\]]*?)\s*[)\]]\s*$", name)
    if bracket:
        return name[: bracket.start()].strip(" ,"), bracket[1]
    words = re.split(r"[\s,]+|/(?=g$)", name)
    for count in (2, 1):
        last = " ".join(words[-count:])
        last = last if unit_by_name(last) else last.replace(" s", "/s")  # as in sa_m_s2
        if len(words) > count and (unit_by_name(last) or last in ("s", "sec", "ms", *_METRES)):
            return " ".join(words[:-count]), last
    return name, ""


def _columns_named(heads: list[str], file: str) -> tuple[int | None, list[int]]:
    """Return the column of periods, and those of ordinates."""
    named = [_name_and_unit(head) for head in heads]
    periods = [index for index, (name, _) in enumerate(named) if _PERIODS.fullmatch(name)]
    if len(periods) != 1:
        return None, []
    unit = named[periods[0]][1]
    if unit not in ("", "s", "sec", "seconds", "second", "seg"):
        raise refusal(RecordFormatError, "unit of period", file, "s", unit)
    return periods[0], [
        index
        for index, (name, unit) in enumerate(named)
        if index != periods[0] and (_ORDINATES.search(name) or unit_by_name(unit))
    ]


def _of_columns(
    heads: list[str], period: int, ordinates: list[int], rows: list[list[str]], above: str, file: str
) -> list[_Spectrum]:
    """Return the spectra of one table; rows of several motions or dampings are several, by the name of the motion."""
    units = [""] * len(heads)
    if rows and len(rows[0]) == len(heads) and not any(map(_is_number, rows[0])):
        units, rows = [one.strip("()[]") for one in rows[0]], rows[1:]  # a line of units
    others = [index for index, head in enumerate(heads) if head.lower().strip() in _ROWS_OF]
    keys = list(dict.fromkeys(tuple(row[index] for index in others) for row in rows if len(row) > max([*others, -1])))
    spectra = []
    for key in keys or [()]:
        rows_of_key = [
            row for row in rows if not others or tuple(row[index] for index in others if index < len(row)) == key
        ]
        for index in ordinates:
            name, unit = _name_and_unit(heads[index])
            quantity = next(
                (kind for kind, pattern in _OF.items() if pattern.search(name) and not unit_by_name(unit)), "Sa"
            )
            points = [
                (row[period] if period < len(row) else "", row[index] if index < len(row) else "")
                for row in rows_of_key
            ]
            named = (
                ", ".join((*key[1:2], *(f"{100.0 * float(one):g} %" for one in key[2:])))
                if len(keys) > 1
                else heads[index]
            )
            printed = _PRINTED.get(name, "") if len(others) == len(_ROWS_OF) else ""
            spectra.append(
                _Spectrum(named, points, unit or units[index] or printed or stated_unit(above) or "", quantity)
            )
    return spectra


def _uniform_hazard(heads: list[re.Match[str] | None], rows: list[list[str]], file: str) -> list[_Spectrum]:
    """Return the spectra of a row of OpenQuake's uniform hazard spectra, one for each probability; they are in g."""
    if len(rows) != 1:
        raise refusal(RecordFormatError, "sites", file, "one: leave the row of yours in a copy", str(len(rows)))
    spectra: dict[str, list[tuple[str, str]]] = {}
    for index, head in enumerate(heads):
        if head is not None:
            probability = head["before"] or head["after"] or "hazard"
            spectra.setdefault(probability, []).append((head["period"] or "0", rows[0][index]))
    by_period = {name: sorted(points, key=lambda one: float(one[0])) for name, points in spectra.items()}
    return [_Spectrum(name, points, "g") for name, points in by_period.items()]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


CORNER_PERIODS: Final = np.geomspace(0.05, 4.0, 60)
"""Periods (s) among which `corner_period` looks for the peaks of a spectrum."""


def corner_period(spectrum: Callable[[FloatArray], ArrayLike]) -> float:
    """Return T_c, where constant acceleration and constant velocity at the peaks of a spectrum would meet.

    T_c = 2 pi max(Sv)/max(Sa) with Sv = Sa T/(2 pi), over periods from 0.05 to 4 s. Of the two-period shape of ASCE 7
    it is T_S = S_D1/S_DS.

    Parameters
    ----------
    spectrum : callable
        Takes periods (s), returns pseudo-accelerations; their unit does not matter. A `TargetSpectrum` is one, and
        `TargetSpectrum.mean_of` makes one of motions.

    Examples
    --------
    >>> import seismass as sm
    >>> from seismass.motions.spectra import corner_period
    >>> round(corner_period(sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.6)), 6)
    0.6
    """
    if not callable(spectrum):
        raise refusal(InvalidOption, "spectrum", "corner period", "a callable of periods", brief(spectrum))
    accelerations = np.asarray(spectrum(CORNER_PERIODS), dtype=np.float64)
    return float(np.max(accelerations * CORNER_PERIODS) / np.max(accelerations))


@dataclass(frozen=True, eq=False)
class HeldMotion:
    """Samples (m/s2) and time step (s) of a motion, without its labels."""

    acceleration: FloatArray
    dt: float


@dataclass(frozen=True, eq=False)
class SuiteMean:
    """Motions, their names and factors, and the damping ratio."""

    motions: tuple[HeldMotion, ...]
    names: tuple[str, ...]
    factors: FloatArray
    damping: float
    own_label: str
    longest: float = np.inf

    @property
    def label(self) -> str:
        """Name with the number of motions."""
        return (
            self.own_label
            or f"mean spectrum of {counted(len(self.motions), 'motion')}, {100.0 * self.damping:g} % damping"
        )

    @property
    def parameters(self) -> dict[str, Any]:
        """Names, factors, damping, and a digest of the samples."""
        return {
            "shape": "suite_mean",
            "records": list(self.names),
            "factors": self.factors.tolist(),
            "damping": self.damping,
            "samples_sha256": inputs_digest(self.motions),
        }

    @property
    def shortest(self) -> float:
        """A thousandth of the largest time step, as far as spectra of it go (s)."""
        return _kernel.SHORTEST_PERIOD_OVER_STEP * max(motion.dt for motion in self.motions)

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return the mean Sa (m/s2)."""
        flat = mean_spectrum(self.motions, self.factors, np.atleast_1d(periods), self.damping)
        return flat.reshape(np.shape(periods))


def mean_shape(
    records: GroundMotion | Iterable[GroundMotion], factors: ArrayLike | None, damping: float, label: str
) -> SuiteMean:
    """Return the shape; there is a finite factor for each motion."""
    suite = as_motions(records, OWNER)
    scale = frozen(np.ones(len(suite))) if factors is None else as_array(factors, "factors", OWNER, InvalidOption)
    if len(scale) != len(suite):
        requirement = f"a list of {len(suite)} values, one per motion"
        raise refusal(InvalidOption, "factors", OWNER, requirement, str(len(scale)))
    if not (np.isfinite(scale) & (scale > 0.0)).all():
        wrong = scale[~(np.isfinite(scale) & (scale > 0.0))][0]
        raise refusal(InvalidOption, "factors", OWNER, "positive numbers", f"{wrong:g}")
    ratio = as_number(damping, "damping", OWNER, InvalidOption)
    if not 0.0 <= ratio < 1.0:
        raise refusal(InvalidOption, "damping", OWNER, "at least 0 and below 1", f"{ratio:g}")
    motions = []
    for number, motion in enumerate(suite, start=1):
        owner = f"motion {number} of {OWNER}"
        samples = as_array(motion.acceleration, "acceleration", owner, InvalidMotion)
        motions.append(HeldMotion(samples, as_number(motion.dt, "dt", owner, InvalidMotion)))
    names = tuple(getattr(motion, "name", "") or f"motion {number}" for number, motion in enumerate(suite, start=1))
    return SuiteMean(tuple(motions), names, scale, ratio, label)
