"""K-NET and KiK-net ASCII files (NIED, Japan): 17 lines of header, then counts, eight a line, to be scaled to gal.

Source: NIED, "K-NET ASCII format": acceleration = counts x scale factor, less the mean of the record. Directions of
KiK-net are numbers: 1 to 3 are N-S, E-W, U-D of the borehole sensor, 4 to 6 of the one at the surface.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Final

import numpy as np

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS
from seismass.base.values import printable
from seismass.motions.records.formats.common import (
    LINE_WIDTH,
    Arguments,
    Channel,
    Format,
    StatedPeak,
    agreed_step,
    agreed_unit,
    channels_of,
    check_peak,
    digit_of_peak,
    is_number,
    refuse_skip,
    to_float,
)
from seismass.motions.records.formats.labels import azimuth_of
from seismass.motions.records.formats.table import Layout, header_values, read_block
from seismass.motions.records.record import Record

_KEYS: Final = (
    "Origin Time",
    "Lat.",
    "Long.",
    "Depth. (km)",
    "Mag.",
    "Station Code",
    "Station Lat.",
    "Station Long.",
    "Station Height(m)",
    "Record Time",
    "Sampling Freq(Hz)",
    "Duration Time(s)",
    "Dir.",
    "Scale Factor",
    "Max. Acc. (gal)",
    "Last Correction",
    "Memo.",
)
_KEY_WIDTH: Final = 18
_PER_LINE: Final = 8
_DIRECTIONS: Final = {
    "N-S": ("N-S", 0.0),
    "E-W": ("E-W", 90.0),
    "U-D": ("U-D", None),
    "1": ("NS1", 0.0),
    "2": ("EW1", 90.0),
    "3": ("UD1", None),
    "4": ("NS2", 0.0),
    "5": ("EW2", 90.0),
    "6": ("UD2", None),
}
_SCALE = re.compile(r"([\d.]{1,20})\s*\(gal\)\s*/\s*(\d{1,18})", re.IGNORECASE)
_RATE = re.compile(r"([\d.]{1,20})\s*Hz", re.IGNORECASE)
_COUNTS: Final = frozenset(" \t\r\n-+0123456789")

PARTS_OF_A_SECOND: Final = 1.0
"""The header rounds the duration to whole seconds."""


def _recognises_knet(head: str) -> bool:
    return head.startswith("Origin Time") and "Scale Factor" in head


def _parse_knet(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    refuse_skip(arguments, KNET.title, file)
    lines = text.splitlines()
    header: dict[str, str] = {}
    for index, key in enumerate(_KEYS):
        line = lines[index] if index < len(lines) else ""
        if not line.startswith(key):
            raise RecordFormatError(f"line {index + 1} of {file} must be its {key!r}; got {line[:40]!r}")
        header[key] = line[_KEY_WIDTH:].strip()
    scale = _SCALE.fullmatch(header["Scale Factor"])
    if scale is None or not is_number(scale[1]) or not float(scale[1]) > 0.0 or int(scale[2]) == 0:
        raise RecordFormatError(
            f"Scale Factor of {file} must be as 3920(gal)/6182761; got {header['Scale Factor'][:40]!r}"
        )
    rate = _RATE.fullmatch(header["Sampling Freq(Hz)"])
    if rate is None or not is_number(rate[1]) or not 1.0 <= float(rate[1]) <= 10000.0:
        raise RecordFormatError(
            f"Sampling Freq(Hz) of {file} must be as 100Hz; got {header['Sampling Freq(Hz)'][:40]!r}"
        )
    dt = agreed_step(1.0 / float(rate[1]), arguments.dt, rate[0], file)
    agreed_unit("cm/s2", arguments.unit, file)
    direction = _DIRECTIONS.get(header["Dir."].upper())
    if direction is None:
        raise RecordFormatError(f"Dir. of {file} must be one of {', '.join(_DIRECTIONS)}; got {header['Dir.'][:20]!r}")
    counts = _read_counts(lines[len(_KEYS) :], file)
    remarks: list[str] = []
    _check_duration(header["Duration Time(s)"], len(counts), dt, file, remarks)

    per_count = float(scale[1]) / int(scale[2])
    mean = float(np.mean(counts))
    gal = (counts - mean) * per_count
    remarks.append(f"mean of {mean:.1f} counts ({mean * per_count:.4g} gal) removed, as the format asks")
    # The header rounds the peak, and its mean may be that of whole counts.
    check_peak(gal, StatedPeak(header["Max. Acc. (gal)"], signed=False), dt, 2.0 * per_count, file, remarks)
    component, azimuth = direction
    code = header["Station Code"]
    if header["Dir."] in ("1", "2", "3"):
        remarks.append(f"component {component} is that of the borehole sensor, not of the surface")
    record = Record(
        acceleration=gal * ACCELERATION_UNITS["cm/s2"],
        dt=dt,
        name=printable(source.name if len(source.suffix) == 3 or source.suffix[-1:].isdecimal() else source.stem),
        event=", ".join(part for part in (header["Origin Time"], f"M {header['Mag.']}") if part),
        station=code,
        component=component,
        azimuth=azimuth,
        network="KiK-net" if header["Dir."].isdecimal() else "K-NET",
        source=source,
        file_unit="cm/s2",
        place="borehole" if header["Dir."] in ("1", "2", "3") else "",
        remarks=tuple(remarks),
    )
    return (Channel(component, record),)


def _read_counts(lines: list[str], file: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Read lines of eight counts; only the last may hold fewer, and none may be cut."""
    rows = [line.split() for line in lines]
    for number, row in enumerate(rows, start=len(_KEYS) + 1):
        if len(row) != _PER_LINE and not (row and number == len(_KEYS) + len(rows)):
            raise RecordFormatError(f"line {number} of {file} must be {_PER_LINE} counts; got {len(row)}")
    if not rows:
        raise RecordFormatError(f"points of {file} must be at least 1; got 0")
    last = lines[-1].rstrip()
    if len(rows) > 1 and len(last) != len(lines[0].rstrip()) * len(rows[-1]) // _PER_LINE:
        raise RecordFormatError(f"last line of {file} must be whole counts in their columns; got {last[-20:]!r}")
    tokens = [token for row in rows for token in row]
    try:
        if not set("".join(tokens)) <= _COUNTS:
            raise ValueError
        return np.array(list(map(int, tokens)), dtype=np.float64)
    except (ValueError, OverflowError):
        wrong = next((token for token in tokens if re.fullmatch(r"[+-]?\d{1,15}", token) is None), tokens[-1])
        raise RecordFormatError(f"counts of {file} must be whole numbers; got {wrong[:40]!r}") from None


def _check_duration(written: str, points: int, dt: float, file: str, remarks: list[str]) -> None:
    """Refuse a duration that is a second off; remark one that is not the exact length, as all of NIED's are."""
    if not is_number(written):
        raise RecordFormatError(f"Duration Time(s) of {file} must be a number; got {written[:20]!r}")
    if abs(float(written) - points * dt) > 1e-6:
        remarks.append(f"{points} points last {points * dt:g} s; the header gives {written} s")
    if abs(float(written) - points * dt) >= PARTS_OF_A_SECOND:
        raise RecordFormatError(
            f"points of {file} must last {written} s, as its header says; got {points}, which last {points * dt:g} s"
        )


KNET: Final = Format("knet", "K-NET", _recognises_knet, _parse_knet)


_TEXT: Final = 16
_HEADER: Final = 26
_NUMBERS: Final = Layout(10, 8, whole_from=5)
"""From 10 000 mm/s2, about 1 g, GeoNet's files have no decimals: -11026 beside -9865.4."""
_FIRST = re.compile(r"\s*(?P<un>un)?corrected accelerogram\b.*GNS Science", re.IGNORECASE)
_PEAK = re.compile(r"Acceleration:\s*Peak\s+(?P<value>\S+)\s+mm/s/s\s+at\s+(?P<time>\S+)\s*s", re.IGNORECASE)
_SITE = re.compile(r"Site\s+(\S+)", re.IGNORECASE)
_COMPONENT = re.compile(r"Component\s+(\S+)", re.IGNORECASE)

_COUNTS_GEONET: Final = slice(33, 36)
"""Samples of acceleration, velocity and displacement: integers 4 to 6 of the fourth line."""
_FACTOR: Final = 47
_STEP: Final = 65
_LEAD: Final = 61
"""Seconds that the processing set before the record, from whose beginning the header counts its times."""
"""Factor to mm/s2 and step, eighth real of the first line and sixth of the third, counted from the integers on."""


def _recognises_geonet(head: str) -> bool:
    return _FIRST.match(head[:LINE_WIDTH]) is not None


def _parse_geonet(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    refuse_skip(arguments, GEONET.title, source.name)
    lines = text.splitlines()
    return channels_of(lines, lambda row, number: _channel(lines, row, number, source, arguments))


def _channel(lines: list[str], row: int, number: int, source: Path, arguments: Arguments) -> tuple[Channel, int]:
    file = source.name
    first = _FIRST.match(lines[row][:LINE_WIDTH])
    if first is None or len(lines) <= row + _HEADER:
        raise RecordFormatError(
            f"line {row + 1} of {file} must begin a component, as 'Corrected accelerogram' with {_HEADER} lines; "
            f"got {lines[row].strip()[:40]!r}"
        )
    titles = [line[:LINE_WIDTH] for line in lines[row : row + _TEXT]]
    numbers = header_values(lines, row + _TEXT, _HEADER - _TEXT, _NUMBERS)
    counts = [int(count) if count is not None else 0 for count in numbers[_COUNTS_GEONET]]
    step, factor = numbers[_STEP] or 0.0, numbers[_FACTOR] or 1.0
    if not 1e-5 <= step <= 1.0 or not 0.0 < factor < math.inf:
        raise RecordFormatError(f"step of {file} must be between 1e-05 and 1 s; got {step:g} s")
    block = read_block(lines, row + _HEADER, counts[0], _NUMBERS, file)
    end = block.end
    for count in counts[1:]:
        if count not in (0, counts[0]):
            raise RecordFormatError(f"points of {file} must be {counts[0]} of each quantity; got {count}")
        end = read_block(lines, end, count, _NUMBERS, file).end if count else end
    remarks: list[str] = []
    dt = agreed_step(step, arguments.dt, f"{step:g} s", file)
    agreed_unit("mm/s2", arguments.unit, file)
    peak = _PEAK.search("\n".join(titles))
    if peak:
        lead = 0.0 if first["un"] else numbers[_LEAD] or 0.0
        when = f"{to_float(peak['time']) + lead:.2f}" if is_number(peak["time"]) else ""
        stated = StatedPeak(peak["value"], when, 1.0 / factor)
        digit = digit_of_peak(block.values, block.fields)
        check_peak(block.values, stated, dt, digit, file, remarks)
    if first["un"]:
        remarks.append("uncorrected (V1A): neither filtered nor corrected for its baseline")
    component = _first_group(_COMPONENT, titles[12])
    record = Record(
        acceleration=block.values * factor * ACCELERATION_UNITS["mm/s2"],
        dt=dt,
        name=f"{printable(source.stem)} channel {number}",
        event=printable(" ".join(titles[7].split())),
        station=printable(", ".join(part for part in (_first_group(_SITE, titles[1]), titles[2].strip()) if part)),
        component=printable(component),
        azimuth=azimuth_of(component),
        network="GeoNet",
        source=source,
        file_unit="mm/s2",
        remarks=tuple(remarks),
    )
    return Channel(str(number), record), end


def _first_group(pattern: re.Pattern[str], line: str) -> str:
    match = pattern.search(line)
    return match[1] if match else ""


GEONET: Final = Format("geonet", "GeoNet V1A, V2A", _recognises_geonet, _parse_geonet)
