"""GeoNet V1A and V2A (GNS Science, New Zealand): components one after another, in mm/s2.

Source: GNS Science, "Accelerogram data filenames and formats" (2012): 16 lines of text, 4 of ten integers, 6 of ten
reals, then accelerations as ten numbers of eight characters a line and, in V2A, velocities and displacements.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS
from seismass.base.values import printable
from seismass.records.formats.common import (
    LINE_WIDTH,
    Arguments,
    Channel,
    Format,
    agreed_step,
    agreed_unit,
    channels_of,
    refuse_skip,
)
from seismass.records.formats.directions import azimuth_of
from seismass.records.formats.fixed import Layout, header_values, read_block
from seismass.records.formats.peaks import StatedPeak, check_peak, digit_of_peak
from seismass.records.record import Record

_TEXT: Final = 16
_HEADER: Final = 26
_NUMBERS: Final = Layout(10, 8)
_FIRST = re.compile(r"\s*(?P<un>un)?corrected accelerogram\b.*GNS Science", re.IGNORECASE)
_PEAK = re.compile(r"Acceleration:\s*Peak\s+(?P<value>\S+)\s+mm/s/s\s+at\s+(?P<time>\S+)\s*s", re.IGNORECASE)
_SITE = re.compile(r"Site\s+(\S+)", re.IGNORECASE)
_COMPONENT = re.compile(r"Component\s+(\S+)", re.IGNORECASE)

_COUNTS: Final = slice(33, 36)
"""Samples of acceleration, velocity and displacement: integers 4 to 6 of the fourth line."""
_FACTOR: Final = 47
_STEP: Final = 65
"""Factor to mm/s2 and step, eighth real of the first line and sixth of the third, counted from the integers on."""


def _recognises(head: str) -> bool:
    return _FIRST.match(head[:LINE_WIDTH]) is not None


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    refuse_skip(arguments, GEONET.title, source.name)
    lines = text.splitlines()
    return channels_of(lines, lambda at, number: _channel(lines, at, number, source, arguments))


def _channel(lines: list[str], at: int, number: int, source: Path, arguments: Arguments) -> tuple[Channel, int]:
    file = source.name
    first = _FIRST.match(lines[at][:LINE_WIDTH])
    if first is None or len(lines) <= at + _HEADER:
        raise RecordFormatError(
            f"line {at + 1} of {file} must begin a component, as 'Corrected accelerogram' with {_HEADER} lines; "
            f"got {lines[at].strip()[:40]!r}"
        )
    titles = [line[:LINE_WIDTH] for line in lines[at : at + _TEXT]]
    numbers = header_values(lines, at + _TEXT, _HEADER - _TEXT, _NUMBERS)
    counts = [int(count) if count is not None else 0 for count in numbers[_COUNTS]]
    step, factor = numbers[_STEP] or 0.0, numbers[_FACTOR] or 1.0
    if not 1e-5 <= step <= 1.0 or not 0.0 < factor < math.inf:
        raise RecordFormatError(f"step of {file} must be between 1e-05 and 1 s; got {step:g} s")
    block = read_block(lines, at + _HEADER, counts[0], _NUMBERS, file)
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
        stated = StatedPeak(peak["value"], peak["time"], 1.0 / factor)
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


GEONET: Final = Format("geonet", "GeoNet V1A, V2A", _recognises, _parse)
