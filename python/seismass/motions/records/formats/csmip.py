"""CSMIP files (CDMG, CGS, CESMD): V1, uncorrected, and V2, corrected; each channel with its headers, one after another.

Source: California Geological Survey, "CSMIP strong-motion data files, volumes 1 and 2": 13 or 25 lines of text, 100
integers as 16I5, 50 or 100 reals as 8F10, then accelerations and, in V2, velocities and displacements.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS
from seismass.base.values import printable
from seismass.motions.records.formats.common import (
    LINE_WIDTH,
    Arguments,
    Channel,
    Format,
    NotRead,
    StatedPeak,
    agreed_step,
    agreed_unit,
    check_peak,
    digit_of_peak,
    is_number,
    last_digit,
    refuse_skip,
    to_float,
)
from seismass.motions.records.formats.labels import azimuth_of, direction_remark
from seismass.motions.records.formats.table import Layout, header_values, layout_of, read_block, uniform_step
from seismass.motions.records.record import Record

_FIRST = re.compile(r"\s*(?P<un>UN)?CORRECTED ACCELEROGRAM\b", re.IGNORECASE)
_NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)"
_DATA = re.compile(
    r"\s*(?P<count>\d+)\s+(?:POINTS OF\s+(?P<what>ACCEL|VELOC|DISPL)\w*\s+DATA\s+EQUALLY SPACED AT\s*"
    rf"(?P<step>{_NUMBER})\s*SEC|(?P<points>ACCELEROGRAM POINTS) AT\s*(?P<rate>{_NUMBER})\s*PTS/SEC)(?P<rest>.*)",
    re.IGNORECASE,
)
_EDIT = re.compile(r"\(\s*\d+\s*[FE]\d+\.\d+\s*\)", re.IGNORECASE)
_PEAK_V2 = re.compile(
    rf"PEAK\s+ACCELERATION\s*=\s*(?P<value>{_NUMBER})\s*(?P<unit>\S+)\s+AT\s+(?P<time>{_NUMBER})", re.IGNORECASE
)
_PEAK_V1 = re.compile(
    rf"\bMAX\s*=\s*(?P<value>{_NUMBER})\s*(?P<unit>G\b)\s*,?\s*AT\s*(?P<time>{_NUMBER})", re.IGNORECASE
)
_COUNT_V2 = re.compile(r"^\s*(\d+)\s+POINTS OF INSTRUMENT-", re.IGNORECASE | re.MULTILINE)
_COUNT_V1 = re.compile(r"NO\. OF POINTS\s*=\s*(\d+)", re.IGNORECASE)
_LENGTH = re.compile(rf"RECORD LENGTH\s*=\s*({_NUMBER})\s*SEC", re.IGNORECASE)
_CHANNEL = re.compile(r"CHAN\s+(?P<number>\d+)\s*:\s*(?P<said>[^\n]*)", re.IGNORECASE)
_NUMBER_AT_STATION = re.compile(r"\(\s*STA[^)]*\)", re.IGNORECASE)
_STATION = re.compile(r"STATION\s+(?:NO\.|ID\.)\s*(?P<code>\w+)?", re.IGNORECASE)
_CLOCK = re.compile(r"\d{4}\s+(\d{1,2}):(\d\d):(\d\d(?:\.\d+)?)")
_WIDE_GAP = re.compile(r"\s{2,}|\s*(?=\blocation:)", re.IGNORECASE)
_AGENCY = re.compile(r"PROCESSED:\s*[\d/]*\s*,\s*([A-Z]+)", re.IGNORECASE)
_CHANNELS = re.compile(r"\(\s*\d+\s*CHNS?\s+OF\s+(\d+)", re.IGNORECASE)
_END = re.compile(r"\s*/&.*")
_UNITS_OF = re.compile(
    r"UNITS OF UNCOR\w*\s*(?:ACCEL|DATA)?\s*(?:ARE|IS)\s+(?:SEC AND\s+)?(?P<unit>G/10|G)\b", re.IGNORECASE
)

_HEADER_V1: Final = (13, 27)
_HEADER_V2: Final = (25, 45)
"""Lines of text, and all lines before the data."""

_INTEGERS: Final = Layout(16, 5, True)
_ANGLE: Final = 26
_NO_ANGLE: Final = (0.0, -1.0, -999.0)
_VERTICAL: Final = (500, 600)
"""Integer 27 is the direction: degrees, 500 for up, 600 for down; 0 or less where it is not given."""

_PAIRS: Final = Layout(10, 7)
_DEFAULT_V2: Final = Layout(8, 10)
_DEFAULT_V1: Final = Layout(8, 9)


@dataclass(frozen=True)
class _Data:
    """The samples of a channel in the unit of the file: values, as written, step, unit with its factor, next line."""

    values: NDArray[np.float64]
    fields: list[str]
    step: float
    written: str
    unit: str
    tenth: bool
    end: int


def _recognises(head: str) -> bool:
    return _FIRST.match(head[:LINE_WIDTH]) is not None and ("CHAN" in head.upper())


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    refuse_skip(arguments, CSMIP.title, file)
    lines = text.splitlines()
    row = 0
    starts: list[tuple[list[str], _Data, bool]] = []
    angles: list[float | None] = []
    while row < len(lines):
        if not lines[row].strip():
            row += 1
            continue
        first = _FIRST.match(lines[row][:LINE_WIDTH])
        if first is None:
            raise RecordFormatError(
                f"line {row + 1} of {file} must begin a channel, as 'CORRECTED ACCELEROGRAM'; "
                f"got {lines[row].strip()[:40]!r}"
            )
        corrected = first["un"] is None
        text_lines, header_lines = _HEADER_V2 if corrected else _HEADER_V1
        titles = [line[:LINE_WIDTH] for line in lines[row : row + text_lines]]
        if len(lines) <= row + header_lines:
            raise RecordFormatError(f"header of {file} must be {header_lines} lines; got {len(lines) - row}")
        whole = header_values(lines, row + text_lines, 2, _INTEGERS)
        angles.append(whole[_ANGLE] if len(whole) > _ANGLE and whole[_ANGLE] not in _NO_ANGLE else None)
        data = _read_data(lines, row + header_lines, titles, corrected, file)
        row = data.end
        if corrected:
            row = _pass_over(lines, row, len(data.values), file)
        ended = row < len(lines) and _END.fullmatch(lines[row]) is not None
        if row < len(lines) and lines[row].strip() and not ended and _FIRST.match(lines[row][:LINE_WIDTH]) is None:
            raise RecordFormatError(
                f"line {row + 1} of {file} must end its channel; got {lines[row].strip()[:40]!r}: more data than points"
            )
        row += ended
        starts.append((titles, data, ended))
    several = len(starts) > 1
    labels = [_label(titles, number) for number, (titles, _, _) in enumerate(starts, start=1)]
    if len(set(labels)) < len(labels):
        raise RecordFormatError(f"channels of {file} must have different numbers; got {', '.join(labels)}")
    return tuple(
        _channel(titles, data, ended, angle, source, arguments, label, several)
        for label, (titles, data, ended), angle in zip(labels, starts, angles, strict=True)
    )


def _label(titles: list[str], number: int) -> str:
    match = _CHANNEL.search("\n".join(titles[5:9]))
    return match["number"] if match else str(number)


def _read_data(lines: list[str], row: int, titles: list[str], corrected: bool, file: str) -> _Data:
    match = _DATA.match(lines[row][:LINE_WIDTH])
    header = "\n".join(titles)
    if match is None and not corrected:
        return _read_pairs(lines, row, header, file)
    if match is None or (match["what"] or "ACCEL").upper() != "ACCEL":
        raise RecordFormatError(
            f"line {row + 1} of {file} must give the points, step and unit of its accelerations; "
            f"got {lines[row].strip()[:40]!r}"
        )
    count = int(match["count"])
    stated = (_COUNT_V2 if corrected else _COUNT_V1).search(header)
    if stated and int(stated[1]) != count:
        raise RecordFormatError(
            f"points of {file} must be {stated[1]}, as its header says; got {count} before the data"
        )
    unit = _unit_of(match["rest"].upper())
    if unit is None:
        raise RecordFormatError(f"unit of {file} must be cm/s2 or g; got {match['rest'].strip()[:40]!r}")
    edit = _EDIT.search(match["rest"])
    layout = layout_of(edit[0], file) if edit else (_DEFAULT_V2 if corrected else _DEFAULT_V1)
    if match["step"]:
        step, written = float(match["step"]), f"{match['step']} s"
    else:
        rate = float(match["rate"])
        step, written = (1.0 / rate if rate > 0.0 else 0.0), f"{match['rate']} points a second"
    if not 1e-5 <= step <= 1.0:
        raise RecordFormatError(f"step of {file} must be between 1e-05 and 1 s; got {written}")
    block = read_block(lines, row + 1, count, layout, file)
    return _Data(block.values, block.fields, step, written, unit, False, block.end)


def _unit_of(words: str) -> str | None:
    """Return the unit of "in cm/sec2. (8f10.6)", "(UNITS: CM/SEC/SEC)" or "in units of g"."""
    if re.search(r"\bCM/SEC(?:2|/SEC)", words):
        return "cm/s2"
    return "g" if re.search(r"UNITS(?: OF|:)\s*G\b(?!/)", words) else None


def _read_pairs(lines: list[str], row: int, header: str, file: str) -> _Data:
    """Read times and accelerations, five pairs a line, as V1 files of digitised film have them."""
    count = _COUNT_V1.search(header)
    units = _UNITS_OF.search(header)
    if count is None or units is None:
        raise RecordFormatError(f"header of {file} must give NO. OF POINTS and the unit of its accelerations; got none")
    block = read_block(lines, row, 2 * int(count[1]), _PAIRS, file)
    try:
        step = uniform_step(block.values[::2], block.fields[::2], file)
    except RecordFormatError as error:
        raise NotRead(f"{error}: read its corrected file (V2)") from error
    tenth = units["unit"].upper() == "G/10"
    values = np.ascontiguousarray(block.values[1::2])
    return _Data(values, block.fields[1::2], step, f"times {step:g} s apart", "g", tenth, block.end)


def _pass_over(lines: list[str], row: int, points: int, file: str) -> int:
    """Return the index of the line after velocities and displacements, whose points must be as many."""
    for what in ("VELOC", "DISPL"):
        match = _DATA.match(lines[row][:LINE_WIDTH]) if row < len(lines) else None
        if match is None or (match["what"] or "").upper() != what:
            got = lines[row].strip()[:40] if row < len(lines) else "the end of the file"
            raise RecordFormatError(f"line {row + 1} of {file} must begin its {what} data; got {got!r}")
        edit = _EDIT.search(match["rest"])
        layout = layout_of(edit[0], file) if edit else _DEFAULT_V2
        count = int(match["count"])
        if count != points:
            raise RecordFormatError(f"points of {file} must be {points} of each quantity; got {count} of {what}")
        rows = math.ceil(count / layout.columns)
        last = (count - layout.columns * (rows - 1)) * layout.width
        if row + rows >= len(lines) or len(lines[row + rows].rstrip()) != last:
            raise RecordFormatError(f"{what} data of {file} must be {count} points; got fewer: the file is cut off")
        row += rows + 1
    return row


def _channel(
    titles: list[str],
    data: _Data,
    ended: bool,
    angle: float | None,
    source: Path,
    arguments: Arguments,
    label: str,
    several: bool,
) -> Channel:
    file = source.name
    corrected = len(titles) == _HEADER_V2[0]
    dt = agreed_step(data.step, arguments.dt, data.written, file)
    unit = agreed_unit(data.unit, arguments.unit, file)
    remarks: list[str] = []
    header = "\n".join(titles)
    peak = (_PEAK_V2 if corrected else _PEAK_V1).search(header)
    if peak:
        factor = 1.0 if corrected else 10.0 if data.tenth else 1.0
        lead = 0.0 if corrected else _before_trigger(header)
        when = f"{to_float(peak['time']) + lead:.3f}" if is_number(peak["time"]) else ""
        stated = StatedPeak(peak["value"], when, factor)
        check_peak(data.values, stated, dt, digit_of_peak(data.values, data.fields), file, remarks)
    length = _LENGTH.search(header)
    if length and is_number(length[1]):
        off = abs(float(length[1]) - len(data.values) * dt)
        if off > 1.5 * dt + 0.5 * last_digit(length[1]) + 1e-9:
            raise RecordFormatError(
                f"record length of {file} must be {length[1]} s, as its header says; "
                f"got {len(data.values)} points of {dt:g} s"
            )
    if not corrected:
        remarks.append("uncorrected (V1): neither filtered nor corrected for its baseline")
    if not ended:
        remarks.append("no line ends its channel: that the file is whole cannot be checked")
    channels = _CHANNELS.search(header)
    if channels and not several and int(channels[1]) > 1:
        remarks.append(f"the station has {channels[1]} channels; this file has one")
    place = _CHANNEL.search("\n".join(titles[5:9]))
    # The place in a building stands further right, with or without its word; a number at the station may be between.
    words = _NUMBER_AT_STATION.sub("   ", place["said"]).strip() if place else ""
    component, _, where = _WIDE_GAP.sub("\n", words).partition("\n")
    component = component.partition("(")[0].strip()
    where = re.sub(r"^Location:\s*", "", " ".join(where.split()), flags=re.IGNORECASE)
    contradiction = direction_remark(component, angle, _VERTICAL)
    if contradiction:
        remarks.append(contradiction)
    return Channel(
        label,
        Record(
            acceleration=data.values * (0.1 if data.tenth else 1.0) * ACCELERATION_UNITS[unit],
            dt=dt,
            name=printable(source.stem) + (f" channel {label}" if several else ""),
            event=_event(titles[8] if corrected else titles[7], titles[2] if corrected else titles[1]),
            station=_station(titles[5:7] if corrected else titles[4:6]),
            component=component,
            azimuth=azimuth_of(component),
            network=_network(header, titles[6] if corrected else titles[5]),
            source=source,
            file_unit=unit,
            place=printable(where),
            remarks=tuple(remarks),
        ),
    )


def _before_trigger(header: str) -> float:
    """Return the seconds from the start of a record of RENADIC to its trigger, from which it counts the peaks."""
    lines = header.splitlines()[2:4] if "RENADIC" in header else []
    clocks = [clock[-1] for line in lines if (clock := _CLOCK.findall(line))]
    seconds = [3600.0 * float(hours) + 60.0 * float(minutes) + float(rest) for hours, minutes, rest in clocks]
    return seconds[1] - seconds[0] if len(seconds) == 2 and 0.0 < seconds[1] - seconds[0] < 600.0 else 0.0


def _event(line: str, fallback: str) -> str:
    parts = [
        re.sub(r"^(?:RECORD|RCRD) OF\s+", "", part.strip(), flags=re.IGNORECASE) for part in re.split(r"\s{2,}", line)
    ]
    unique = list(dict.fromkeys(part for part in parts if part))
    return fallback.strip() if "RENADIC" in line or not unique else ", ".join(unique)


def _station(lines: list[str]) -> str:
    code = _STATION.match(lines[0].strip())
    name = re.split(r"\s{3,}", lines[1].strip())[0]
    number = code["code"] if code and code["code"] else ""
    return ", ".join(part for part in (number if number != "0" else "", name) if part)


def _network(header: str, station_line: str) -> str:
    if "RENADIC" in header:
        return "RENADIC"
    words = re.split(r"\s{3,}", station_line.strip())
    if len(words) > 1 and re.fullmatch(r"[A-Z]{2,6}", words[1]):
        return words[1]
    agency = _AGENCY.search(header)
    return agency[1] if agency else ""


CSMIP: Final = Format("csmip", "CSMIP", _recognises, _parse)
