"""PEER .AT2 files: four header lines of any vintage, then accelerations in any number per line.

Headers round the step to four decimals ("DT= .0039" may be 1/256 s); the caller may give the exact one.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Final

import numpy as np

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, contradiction, stated_unit, units_elsewhere, unknown_unit
from seismass.base.values import printable
from seismass.motions.records.formats.common import (
    LINE_WIDTH,
    SCALED,
    Arguments,
    Channel,
    Format,
    NotRead,
    is_cut_off,
    is_number,
    other_quantity,
    parse_numbers,
    refuse_skip,
    rounding_remark,
    step_in_seconds,
    to_float,
)
from seismass.motions.records.formats.labels import azimuth_of
from seismass.motions.records.record import Record

HEADER_LINES: Final = 10
"""The counts stand in line 4; a file may have blank or further lines before them."""

HEADER_ROUNDING: Final = 0.500001e-4
"""Half the fourth decimal (s), to which headers round the step however many decimals they write."""

LONGEST_COMPONENT: Final = 3
"""Words of a component, as in "90 DEG" or "LONGITUDINAL COMP"; prose has more."""

_COUNTS = (
    re.compile(
        r"NPTS\s*[=:]?\s*(?P<points>\d{1,9})[.,;\s]*DT\s*[=:]?\s*(?P<step>[\d.]+(?:E[+-]?\d+)?)"
        r"\s*(?P<unit>[A-Z/][^\s,;]*)?",
        re.IGNORECASE,
    ),
    re.compile(
        r"^\s*(?P<points>\d{1,9})[,\s]+(?P<step>[\d.]+(?:E[+-]?\d+)?)[,\s]+(?P<unit>)NPTS\s*,?\s*DT", re.IGNORECASE
    ),
)
_STATION_OF = re.compile(r"\(([A-Z]{2,8}) STATION \w+\)")
_ROTATED = re.compile(r"\brotat(?:ed|ion)\b|\bF[NP] component\b|\bfault[- ](?:normal|parallel)\b", re.IGNORECASE)
_SOURCE_OF_ROTATION = re.compile(r"\bH1\b.*rotat", re.IGNORECASE)
_AZIMUTH = re.compile(r"\bazimuth\s*[=:]?\s*(\d{1,3}(?:\.\d+)?)", re.IGNORECASE)
_WORDS = re.compile(r"[A-Za-z]{3}|\*{3}")
_SYNTHETIC = re.compile(r"\bSYNTHETIC\b", re.IGNORECASE)


def looks_like_at2(text: str) -> bool:
    """Whether a line with NPTS and DT stands where the header of an .AT2 file has it."""
    return _find_counts(text.splitlines()) is not None


def parse_at2(text: str, source: Path, *, dt: float | None = None, unit: str | None = None) -> Record:
    """Read the text of an .AT2 file. `dt` (s) is the exact step and must agree with the header to its last digit;
    `unit` must agree with the header, and is g where neither states one.
    """
    file = source.name
    lines = text.splitlines()
    counts = _find_counts(lines)
    if counts is None:
        got = "".join(lines[3:4] or lines[:1]).strip()[:60]
        raise RecordFormatError(
            f"header of {file} must give NPTS and DT in its first {HEADER_LINES} lines, as .AT2 files do; got {got!r}"
        )
    line_of_counts, points, step, step_unit = counts
    titles = [line.strip()[:LINE_WIDTH] for line in lines[:line_of_counts]]
    header = "\n".join(titles)
    _refuse_other_quantity(titles, source)
    remarks: list[str] = []
    seconds = step_in_seconds(step, step_unit, file)
    written = f"{step} s" if seconds == to_float(step) else f"{step} {step_unit}"
    exact_dt = _agreed_step(seconds, dt, written, file, remarks)
    unit = _agreed_unit(header, unit, file)
    rotated = _rotation(titles, remarks)
    if unit != "g":
        remarks.append(f"accelerations are in {unit}; those of the PEER database are in g")

    lines = _without_trailer(lines, points, remarks)
    numbered = enumerate(lines[line_of_counts + 1 :], start=line_of_counts + 2)
    tokens, values = parse_numbers(numbered, file)
    if len(values) < points:
        hint = f", and its last number {tokens[-1]!r} looks cut off" if tokens and is_cut_off(tokens) else ""
        raise RecordFormatError(
            f"points of {file} must be {points}, as its header says; got {len(values)}: the file is cut off{hint}"
        )
    if len(values) > points:
        if np.any(values[points:] != 0.0):
            raise RecordFormatError(f"points of {file} must be {points}, as its header says; got {len(values)}")
        remarks.append(f"{len(values) - points} zeros beyond the {points} points of the header left out")
        tokens, values = tokens[:points], values[:points]
    if points == 0:
        raise RecordFormatError(f"points of {file} must be at least 1; got 0")
    if is_cut_off(tokens):
        raise RecordFormatError(
            f"last number of {file} must be written as the others are; got {tokens[-1]!r}: the file is cut off"
        )
    uneven = _uneven_line(lines, line_of_counts + 1)
    if uneven:
        remarks.append(f"line {uneven} has another number of values than the others: lines may be missing or moved")
    event, station, component = _titles(titles) if rotated is None else rotated
    return Record(
        acceleration=values * ACCELERATION_UNITS[unit],
        dt=exact_dt,
        name=printable(source.stem),
        event=event,
        station=station,
        component=component,
        azimuth=azimuth_of(component),
        network=_network(header),
        source=source,
        file_unit=unit,
        synthetic=bool(_SYNTHETIC.search(header)),
        remarks=tuple(remarks),
    )


def _without_trailer(lines: list[str], points: int, remarks: list[str]) -> list[str]:
    """Return the lines without a last one of words, such as "*** End Data ***", where some follow the numbers."""
    end = len(lines)
    while end and (not lines[end - 1].strip() or not any(character.isdigit() for character in lines[end - 1])):
        end -= 1
    words = [line.strip() for line in lines[end:] if line.strip()]
    if points and words and all(_WORDS.search(line) for line in words):
        remarks.append(f"words behind the numbers left out: {printable(words[0])[:40]}")
        return lines[:end]
    return lines


def _rotation(titles: list[str], remarks: list[str]) -> tuple[str, str, str] | None:
    """Return event, station and component of a record that its header says to be rotated, with remarks; else None.
    Titles of such a file name both recorded components, neither of which is its direction.
    """
    header = "\n".join(titles)
    scale = SCALED.search(header)
    if scale and to_float(scale[1]) != 1.0:
        remarks.append(f"its header says that it is scaled by {scale[1]}")
    if not _ROTATED.search(header):
        return None
    azimuth = _AZIMUTH.search(header)
    component = azimuth[1] if azimuth else ""
    words = f"azimuth {component}" if component else "its azimuth is not stated"
    remarks.append(f"its header says that it is rotated: {words}")
    source = next((line.partition(":")[2] for line in titles if _SOURCE_OF_ROTATION.search(line)), "")
    parts = [part.strip() for part in source.split(",")]
    return (", ".join(parts[:-2]), parts[-2], component) if len(parts) > 2 else (source.strip(), "", component)


def _uneven_line(lines: list[str], start: int) -> int | None:
    """Return the first line (from 1), except the last two, whose number of values is not the most usual. Fields that
    touch are separated at their points; the last line may be short, and zeros may follow.
    """
    counts = [max(line.count("."), len(line.split())) for line in lines[start:]]
    while counts and not counts[-1]:
        counts.pop()
    usual = max(counts[:20], default=0)
    return next((start + index + 1 for index, count in enumerate(counts[:-2]) if count not in (0, usual)), None)


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    refuse_skip(arguments, AT2.title, source.name)
    return (Channel("1", parse_at2(text, source, dt=arguments.dt, unit=arguments.unit)),)


AT2: Final = Format("at2", ".AT2", looks_like_at2, _parse)


def _refuse_other_quantity(titles: list[str], source: Path) -> None:
    """Refuse the velocities and displacements that the PEER database gives beside the accelerations."""
    other = other_quantity(next((title for title in reversed(titles) if title), ""))
    instead = "read the .AT2 file beside it"
    if other:
        raise NotRead(f"quantity of {source.name} must be acceleration; got {other}: {instead}")
    by_suffix = {".vt2": "velocity", ".dt2": "displacement"}.get(source.suffix.lower())
    if by_suffix:
        raise NotRead(
            f"quantity of {source.name} must be acceleration; got a {source.suffix} file, which holds {by_suffix}: "
            + instead
        )


def _find_counts(lines: list[str]) -> tuple[int, int, str, str] | None:
    """Return the index of the line with the counts, the points, and the step as written with its unit."""
    for index, line in enumerate(lines[:HEADER_LINES]):
        for pattern in _COUNTS:
            match = pattern.search(line[:LINE_WIDTH])
            if match and is_number(match["step"]):
                return index, int(match["points"]), match["step"], match["unit"] or ""
    return None


def _agreed_step(step: float, dt: float | None, written: str, file: str, remarks: list[str]) -> float:
    if dt is None:
        figures = rounding_remark(written.split()[0]) if written.endswith(" s") else []
        binary = 2 ** round(-math.log2(step))  # digital recorders sampled 128, 200 or 256 times a second
        if 0.0 < abs(1.0 / binary - step) <= HEADER_ROUNDING:
            remarks.append(f"step {written} taken as written; it may be 1/{binary} s rounded, which dt= would give")
        else:
            remarks.extend(figures)
        return step
    if not -HEADER_ROUNDING <= dt - step < 2.0 * HEADER_ROUNDING - 1e-9:  # rounded, or cut: .0066 for 1/150
        raise RecordFormatError(f"dt of {file} must agree with its header, {written}; got {dt:g} s")
    if dt != step:
        remarks.append(f"step {dt!r} s given instead of the header's rounded {written}")
    return dt


def _agreed_unit(header: str, unit: str | None, file: str) -> str:
    stated = stated_unit(header)
    unknown = unknown_unit(header) or (None if stated else " and ".join(units_elsewhere(header)))
    against = contradiction(header, unit) if unit else None
    if against:
        raise RecordFormatError(f"unit of {file} must be that of its header, {against}; got {unit}")
    if unknown and not unit:
        raise RecordFormatError(
            f"unit of {file} must be one of {', '.join(ACCELERATION_UNITS)}, or be given; got {unknown!r} in its header"
        )
    return stated or unit or "g"


def _network(header: str) -> str:
    """Return the network of a title such as "... 360 (CDMG STATION 24461)"."""
    match = _STATION_OF.search(header)
    return match[1] if match else ""


def _titles(titles: list[str]) -> tuple[str, str, str]:
    """Return event, station and component of "event, date, station, component", or of the part that is there. A
    component is a direction or a short name, else a title; an operator may follow, "TST002, E, (CWB)".
    """
    title = titles[1] if len(titles) > 1 else ""
    parts = [part.strip() for part in title.split(",")]
    if len(parts) > 3 and parts[-1].startswith("(") and azimuth_of(parts[-2]) is not None:
        parts[-2:] = [f"{parts[-2]} {parts[-1]}"]
    if len(parts) < 3 or len(parts[-1].partition("(")[0].split()) > LONGEST_COMPONENT:
        return title, "", ""
    return ", ".join(parts[:-2]), parts[-2], parts[-1]
