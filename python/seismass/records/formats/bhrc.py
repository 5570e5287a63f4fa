"""BHRC's volume 1 (ISMN, Iran): uncorrected accelerations, each component with its headers, one after another.

Source: Building and Housing Research Center, Iran Strong Motion Network, "VOL1DS", a layout of CSMIP's kind: 13 lines
of text, 100 integers as 14I5, 38 reals as 6E13.6, accelerations as 10E13.6 in the unit that the text says, and a line
/&. The first integers of the second line and the seventh real repeat the points and the samples a second.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS
from seismass.base.values import printable
from seismass.records.formats.common import (
    LINE_WIDTH,
    SAME_STEP,
    Arguments,
    Channel,
    Format,
    NotRead,
    agreed_step,
    agreed_unit,
    channels_of,
    refuse_skip,
)
from seismass.records.formats.fixed import Layout, header_values, read_block
from seismass.records.formats.numbers import is_number, last_digit, to_float
from seismass.records.record import Record

_FIRST = re.compile(r"\* VOL(?P<volume>\d)\S*\s+FILE:\s*(?P<file>\S*)", re.IGNORECASE)
_NUMBER: Final = r"\d*\.?\d+"
_POINTS = re.compile(rf"NO\. OF POINTS\s*=\s*(?P<points>\d+)\s+DURATION\s*=\s*(?P<length>{_NUMBER})", re.IGNORECASE)
_UNIT = re.compile(r"UNITS ARE SECONDS AND (?P<unit>G/10|G)\s*$", re.IGNORECASE)
_AZIMUTHS = re.compile(r"Azimuth\s+L\s*(?P<L>\d+)\s+T\s*(?P<T>\d+)", re.IGNORECASE)
_COMPONENT = re.compile(r"COMP\s+(?P<component>\S+)", re.IGNORECASE)
_EVENT = re.compile(r"Origin Time\s*:\s*(.*)", re.IGNORECASE)

_TEXT: Final = 13
_INTEGERS: Final = 7
_HEADER: Final = 27
"""Lines of text, of integers, and all before the accelerations."""
_WHOLE: Final = Layout(14, 5, True)
_REALS: Final = Layout(6, 13)
_NUMBERS: Final = Layout(10, 13)
_END: Final = "/&"
"""Beginning of a line that ends a component."""
_POINTS_AT: Final = 25
_RATE_AT: Final = 6
"""Points among the integers, and samples a second among the reals."""


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    refuse_skip(arguments, BHRC.title, source.name)
    lines = text.splitlines()
    return channels_of(lines, lambda at, number: _channel(lines, at, number, source, arguments), between=_END)


def _channel(lines: list[str], at: int, number: int, source: Path, arguments: Arguments) -> tuple[Channel, int]:
    file = source.name
    first = _FIRST.match(lines[at][:LINE_WIDTH])
    if first is None or len(lines) <= at + _HEADER:
        raise RecordFormatError(
            f"line {at + 1} of {file} must begin a component, as '* VOL1DS', with {_HEADER} lines; "
            f"got {printable(lines[at].strip())[:40]!r}"
        )
    if first["volume"] != "1":
        raise NotRead(f"volume of {file} must be 1, uncorrected accelerations; got {first['volume']}")
    titles = [line[:LINE_WIDTH].strip() for line in lines[at : at + _TEXT]]
    component, counted, unit = (
        _of(pattern, titles[row], row, at, file) for pattern, row in ((_COMPONENT, 6), (_POINTS, 10), (_UNIT, 11))
    )
    points = int(counted["points"][:12])
    whole = header_values(lines, at + _TEXT, _INTEGERS, _WHOLE)[_POINTS_AT]
    if whole is not None and whole != points:
        raise RecordFormatError(f"points of {file} must be stated alike twice; got {points} and {whole:g}")
    dt = agreed_step(*_step(counted, points, lines, at, arguments, file), file)
    block = read_block(lines, at + _HEADER, points, _NUMBERS, file)
    agreed_unit("g", arguments.unit, file)
    azimuths = _AZIMUTHS.search(titles[7])
    axis = component["component"][:1].upper()  # L1, V2 and T3 of the instrument
    record = Record(
        acceleration=block.values * (0.1 if unit["unit"].upper() == "G/10" else 1.0) * ACCELERATION_UNITS["g"],
        dt=dt,
        name=f"{printable(source.stem)} channel {number}",
        event=printable(" ".join(match[1].split()) if (match := _EVENT.search(titles[2])) else ""),
        station=printable(re.split(r"\s+Station\b", titles[7])[0].strip() or first["file"]),
        component=printable(axis),
        azimuth=float(azimuths[axis]) % 360.0 if azimuths and axis in "LT" and int(azimuths[axis]) <= 360 else None,
        network="BHRC",
        source=source,
        file_unit="g",
        remarks=("uncorrected (volume 1): neither filtered nor corrected for its baseline",),
    )
    return Channel(str(number), record), block.end


def _of(pattern: re.Pattern[str], title: str, row: int, at: int, file: str) -> re.Match[str]:
    match = pattern.search(title)
    if match is None:
        wanted = {6: "the component", 10: "points and duration", 11: "UNITS ARE SECONDS AND G/10"}[row]
        raise RecordFormatError(f"line {at + row + 1} of {file} must be {wanted}; got {printable(title)[:40]!r}")
    return match


def _step(
    counted: re.Match[str], points: int, lines: list[str], at: int, arguments: Arguments, file: str
) -> tuple[float, float | None, str]:
    """Return the step by the samples a second of the reals, held against points and duration; the given one; words."""
    rate = header_values(lines, at + _TEXT + _INTEGERS, _HEADER - _TEXT - _INTEGERS, _REALS)[_RATE_AT] or 0.0
    said = counted["length"]
    length = to_float(said) if is_number(said) else 0.0
    if not 1.0 <= rate <= 1e5 or not length > 0.0:
        raise RecordFormatError(f"samples a second of {file} must be between 1 and 1e+05; got {rate:g}")
    if abs(length - points / rate) > 1.5 / rate + 0.5 * last_digit(said) + SAME_STEP * length:
        raise RecordFormatError(
            f"record length of {file} must be {said} s, as its header says; got {points} points of {1.0 / rate:g} s"
        )
    return 1.0 / rate, arguments.dt, f"{rate:g} samples a second"


BHRC: Final = Format("bhrc", "BHRC", lambda head: _FIRST.match(head[:LINE_WIDTH]) is not None, _parse)
