"""ESM ASCII files (Engineering Strong-Motion database; AFAD too): 64 keys of header DYNA 1.x, then a number a line.

Source of the keys: esm-db.eu, "ESM data format"; units are cm/s2, peaks in PGA_CM/S^2 at TIME_PGA_S.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, stated_unit
from seismass.base.values import printable
from seismass.records.formats.common import (
    Arguments,
    Channel,
    Format,
    NotRead,
    agreed_step,
    agreed_unit,
    refuse_skip,
)
from seismass.records.formats.directions import azimuth_of
from seismass.records.formats.headers import step_in_seconds
from seismass.records.formats.numbers import is_cut_off, is_number, parse_numbers
from seismass.records.formats.peaks import StatedPeak, check_peak, digit_of_peak
from seismass.records.record import Record

_KEY = re.compile(r"[A-Z][A-Z0-9_/^-]*(?=:)")
_LINES_OF_HEADER: Final = 64
_NEEDED: Final = ("STATION_CODE", "SAMPLING_INTERVAL_S", "NDATA", "UNITS")


def _recognises(head: str) -> bool:
    return head.startswith("EVENT_NAME:") and "STATION_CODE:" in head


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    refuse_skip(arguments, ESM.title, file)
    lines = text.splitlines()
    header: dict[str, str] = {}
    start = 0
    for start, line in enumerate(lines):
        match = _KEY.match(line)
        if match is None:
            break
        if match[0] in header:
            raise RecordFormatError(f"{match[0]} of {file} must be stated once; got it again in line {start + 1}")
        header[match[0]] = line[match.end() + 1 :].strip()
    missing = [key for key in _NEEDED if key not in header]
    if missing:
        raise RecordFormatError(f"header of {file} must have {', '.join(_NEEDED)}; got none of {', '.join(missing)}")
    remarks: list[str] = []
    if len(header) != _LINES_OF_HEADER:
        remarks.append(f"header has {len(header)} keys, where DYNA 1.x has {_LINES_OF_HEADER}")
    kind = header.get("DATA_TYPE", "").upper()
    if kind not in ("ACCELERATION", ""):
        raise NotRead(f"quantity of {file} must be acceleration; got {kind.lower()}: read the .ACC.ASC file beside it")
    unit = stated_unit(f"units: {header.get('UNITS', '')[:40]}")
    if unit is None:
        raise RecordFormatError(
            f"UNITS of {file} must be an acceleration in cm/s^2; got {header.get('UNITS', 'none')[:40]!r}"
        )
    unit = agreed_unit(unit, arguments.unit, file)
    written = header.get("SAMPLING_INTERVAL_S", "")
    if not is_number(written):
        raise RecordFormatError(f"SAMPLING_INTERVAL_S of {file} must be a number; got {written!r}")
    dt = agreed_step(step_in_seconds(written, "s", file), arguments.dt, f"{written} s", file)
    count = header.get("NDATA", "")
    if not re.fullmatch(r"\d{1,9}", count):
        raise RecordFormatError(f"NDATA of {file} must be a whole number; got {count!r}")
    tokens, values = parse_numbers(enumerate(lines[start:], start=start + 1), file)
    if len(values) != int(count) or not len(values):
        raise RecordFormatError(f"points of {file} must be {count}, as its header says; got {len(values)}")
    if is_cut_off(tokens, short_zero=False):
        raise RecordFormatError(
            f"last number of {file} must be written as the others are; got {tokens[-1]!r}: the file is cut off"
        )
    _check_duration(header.get("DURATION_S", ""), len(values), dt, file)
    peak = StatedPeak(header.get("PGA_CM/S^2", ""), header.get("TIME_PGA_S", ""), 0.01 / ACCELERATION_UNITS[unit])
    check_peak(values, peak, dt, digit_of_peak(values, tokens), file, remarks)
    stream, code, name = header.get("STREAM", ""), header.get("STATION_CODE", ""), header.get("STATION_NAME", "")
    when = f"{header.get('EVENT_DATE_YYYYMMDD', '')} {header.get('EVENT_TIME_HHMMSS', '')}".strip()
    record = Record(
        acceleration=values * ACCELERATION_UNITS[unit],
        dt=dt,
        name=printable(source.stem),
        event=", ".join(part for part in (header.get("EVENT_NAME", ""), when) if part),
        station=", ".join(part for part in (code, name) if part),
        component=stream,
        azimuth=azimuth_of(stream),
        network=header.get("NETWORK", ""),
        source=source,
        file_unit=unit,
        remarks=tuple(remarks),
    )
    return (Channel(stream or "1", record),)


def _check_duration(written: str, points: int, dt: float, file: str) -> None:
    """Some headers count the duration to the last sample, some one step further."""
    if is_number(written) and abs(float(written) - points * dt) > 1.5 * dt + 0.005:
        raise RecordFormatError(
            f"duration of {file} must be {written} s, as its header says; got {points} points of {dt:g} s"
        )


ESM: Final = Format("esm", "ESM", _recognises, _parse)
