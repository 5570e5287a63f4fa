"""COSMOS strong-motion files, version 1.2: uncorrected (V1) and corrected (V2) acceleration, any number of channels.

Source: COSMOS Strong-Motion Programs Board (2001), "COSMOS Strong Motion Data Format" and its tables: blocks of text,
integers, reals, comments and data, each with its count and Fortran format in the line before it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, stated_unit
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
    refuse_skip,
)
from seismass.motions.records.formats.labels import azimuth_of, direction_remark, is_vertical
from seismass.motions.records.formats.table import Block, header_values, layout_of, read_block
from seismass.motions.records.record import Record

_FIRST = re.compile(
    r"(?P<kind>[A-Za-z][A-Za-z /-]*?)\s*\(Format v[\d.]+ with\s+(?P<lines>\d+) text lines\)", re.IGNORECASE
)
_BLOCK = re.compile(
    r"\s*(?P<count>\d+)\s+(?P<what>Integer|Real)-header values follow on\s+(?P<rows>\d+)\s+lines,\s*"
    r"Format\s*=\s*(?P<edit>\(.*?\))\s*$",
    re.IGNORECASE,
)
_COMMENTS = re.compile(r"\s*(?P<count>\d+)\s+Comment line\(?s?\)? follow", re.IGNORECASE)
_DATA = re.compile(
    r"\s*(?P<count>\d+)\s+(?P<what>[a-z][a-z. ]*?)\.?\s+pts\b.*?\bunits\s*=\s*(?P<unit>[^(]*)"
    r"(?:\((?P<code>\d+)\))?\s*,?\s*Format\s*=\s*(?P<edit>\(.*\))\s*$",
    re.IGNORECASE,
)
_APPROXIMATELY = re.compile(r"approx\w*\s+([\d.]+)\s+sec", re.IGNORECASE)
_LOCATION = re.compile(r"\blocation:[ \t]*(.*)", re.IGNORECASE)
_CHANNEL = re.compile(r"Cha\w*:?\s*(?P<number>[?\d]+)\s*:\s*(?P<component>[^(\n]*)", re.IGNORECASE)
_CODE = re.compile(r"Code:\s*(?P<network>\w+)-(?P<station>\S+)")
_SCNL = re.compile(r"<SCNL>\s*(?P<station>[^.\s]+)\.(?P<channel>[^.\s]+)\.(?P<network>[^.\s]+)")
_CHANNELS = re.compile(r"\(\s*\d+\s*Chns?\s+of\s+(\d+)", re.IGNORECASE)
_END = re.compile(r"\s*(?:/&.*|End-of-data\b.*)", re.IGNORECASE)

_UNITS: Final = {2: "g", 4: "cm/s2", 10: "cm/s2"}
_OTHER_UNITS: Final = {5: "cm/s", 6: "cm", 7: "in/s2", 8: "in/s", 9: "in", 11: "mg", 12: "micro g", 50: "counts"}
_SPECIAL_AZIMUTHS: Final = {400: "UP", 401: "DOWN", 402: "VERTICAL"}

_NEEDED: Final = {"integer": 76, "real": 65}
"""Values that are looked at; the format has 100 of each."""

MISSING: Final = -999.0


@dataclass(frozen=True)
class _Raw:
    """One channel, unconverted."""

    kind: str
    text: list[str]
    whole: list[float | None]
    numbers: list[float | None]
    comments: str
    data: re.Match[str]
    data_line: str
    block: Block
    ended: bool


def _recognises(head: str) -> bool:
    return _FIRST.match(head.lstrip()[:LINE_WIDTH]) is not None


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    refuse_skip(arguments, COSMOS.title, file)
    lines = text.splitlines()
    row = 0
    raws: list[_Raw] = []
    while row < len(lines):
        if not lines[row].strip():
            row += 1
            continue
        raw, row = _read_channel(lines, row, file)
        raws.append(raw)
    accelerations = [raw for raw in raws if _is_acceleration(raw)]
    if not accelerations:
        raise NotRead(
            f"quantity of {file} must be acceleration; got {raws[0].kind.lower()}: "
            "read the COSMOS file of its acceleration"
        )
    several = len(accelerations) > 1
    return tuple(_channel(raw, source, arguments, number, several) for number, raw in enumerate(accelerations, start=1))


def _is_acceleration(raw: _Raw) -> bool:
    words = f"{raw.kind} {raw.data['what']}".lower()
    return "accel" in words and "spectr" not in words and raw.whole[1] in (1.0, MISSING)


def _read_channel(lines: list[str], start: int, file: str) -> tuple[_Raw, int]:
    first = _FIRST.match(lines[start].lstrip()[:LINE_WIDTH])
    if first is None:
        raise RecordFormatError(
            f"line {start + 1} of {file} must begin a channel, as 'Corrected acceleration (Format v01.20 ...'; "
            f"got {lines[start].strip()[:40]!r}"
        )
    row = start + int(first["lines"])
    whole, row = _read_header(lines, row, "integer", file)
    numbers, row = _read_header(lines, row, "real", file)
    comments = _COMMENTS.match(lines[row][:LINE_WIDTH]) if row < len(lines) else None
    text = ""
    if comments is not None:
        count = int(comments["count"])
        text = "\n".join(line[:LINE_WIDTH] for line in lines[row + 1 : row + 1 + count])
        if any(not line.lstrip().startswith("|") for line in lines[row + 1 : row + 1 + count]):
            raise RecordFormatError(
                f"comments of {file} must be {count} lines that start with |, from line {row + 2} on"
            )
        row += 1 + count
    data = _DATA.match(lines[row][:LINE_WIDTH]) if row < len(lines) else None
    if data is None:
        got = lines[row].strip()[:60] if row < len(lines) else "the end of the file"
        raise RecordFormatError(
            f"line {row + 1} of {file} must give the points, unit and format of the data; got {got!r}"
        )
    block = read_block(lines, row + 1, int(data["count"]), layout_of(data["edit"], file), file)
    data_line = lines[row][:LINE_WIDTH]
    row = block.end
    ended = row < len(lines) and _END.fullmatch(lines[row]) is not None
    if row < len(lines) and not ended and lines[row].strip():
        raise RecordFormatError(
            f"line {row + 1} of {file} must end the data of {data['count']} points; got {lines[row].strip()[:40]!r}"
        )
    raw = _Raw(
        first["kind"].strip(),
        [line[:LINE_WIDTH] for line in lines[start : start + int(first["lines"])]],
        whole,
        numbers,
        text,
        data,
        data_line,
        block,
        ended,
    )
    return raw, row + ended


def _read_header(lines: list[str], row: int, what: str, file: str) -> tuple[list[float | None], int]:
    match = _BLOCK.match(lines[row][:LINE_WIDTH]) if row < len(lines) else None
    if match is None or match["what"].lower() != what:
        got = lines[row].strip()[:60] if row < len(lines) else "the end of the file"
        raise RecordFormatError(
            f"line {row + 1} of {file} must give the count and format of the {what} header; got {got!r}"
        )
    rows, count = int(match["rows"]), int(match["count"])
    layout = layout_of(match["edit"], file)
    numbers = header_values(lines, row + 1, rows, layout)[:count]
    if not _NEEDED[what] <= count <= rows * layout.columns or len(numbers) < count or row + rows >= len(lines):
        raise RecordFormatError(
            f"{what} header of {file} must be at least {_NEEDED[what]} values, {count} in {rows} lines; "
            f"got {len(numbers)}"
        )
    if any(number is None for number in numbers):
        wrong = numbers.index(None)
        raise RecordFormatError(f"value {wrong + 1} of the {what} header of {file} must be a number; got none")
    return numbers, row + 1 + rows


def _known(number: float | None) -> float | None:
    return None if number is None or number == MISSING else number


def _channel(raw: _Raw, source: Path, arguments: Arguments, number: int, several: bool) -> Channel:
    file = source.name
    unit = agreed_unit(_unit(raw, file), arguments.unit, file)
    points = len(raw.block.values)
    remarks: list[str] = []
    dt = _step(raw, arguments.dt, points, file)
    maximum = _known(raw.numbers[63])
    if maximum is not None:
        time = _known(raw.numbers[64])
        peak = StatedPeak(_written(raw, 63), "" if time is None else _written(raw, 64))
        digit = digit_of_peak(raw.block.values, raw.block.fields)
        check_peak(raw.block.values, peak, dt, digit, file, remarks)
    if not raw.ended:
        remarks.append("no line ends its data: that the file is whole cannot be checked")
    if raw.whole[0] == 1.0 or raw.kind.lower().startswith("uncorr"):
        remarks.append("uncorrected (V1): neither filtered nor corrected for its baseline")
    if _known(raw.whole[75]) == 2.0:
        remarks.append("the header flags a problem that is not mended")
    stated_channels = _CHANNELS.search("\n".join(raw.text))
    if stated_channels and not several and int(stated_channels[1]) > 1:
        remarks.append(f"the station has {stated_channels[1]} channels; this file has one")
    place = _CHANNEL.search("\n".join(raw.text[1:]))
    scnl = _SCNL.search(raw.comments)
    component, azimuth = _direction(raw, place, scnl)
    code = _known(raw.whole[53])
    contradiction = direction_remark(component, code or None, tuple(_SPECIAL_AZIMUTHS))
    if contradiction:
        remarks.append(contradiction)
    place_code = _CODE.search(raw.text[4]) if len(raw.text) > 4 else None
    names = raw.text[4][40:].strip() if len(raw.text) > 4 else ""
    station = (scnl or place_code or {"station": ""})["station"]
    label = place["number"] if place and place["number"].isdecimal() else str(number)
    event = raw.text[1].strip() if len(raw.text) > 1 else ""
    record = Record(
        acceleration=raw.block.values * ACCELERATION_UNITS[unit],
        dt=dt,
        name=printable(source.stem) + (f" channel {label}" if several else ""),
        event=" ".join(re.sub(r"^(?:Record|Rcrd) of\s+", "", event).split()),
        station=", ".join(part for part in (station, names) if part),
        component=component,
        azimuth=azimuth,
        network=(scnl or place_code or {"network": ""})["network"],
        source=source,
        file_unit=unit,
        place=_location(raw.text[1:]),
        remarks=tuple(remarks),
    )
    return Channel(label, record)


def _location(lines: list[str]) -> str:
    """Return where the sensor stands, as the line of the channel has it."""
    match = _LOCATION.search("\n".join(lines))
    return printable(" ".join(match[1].split())) if match else ""


def _written(raw: _Raw, index: int) -> str:
    """Return a real of the header to the digits that it has there at least."""
    number = raw.numbers[index] or 0.0
    return f"{number:.6f}" if abs(number) < 1e6 else f"{number:.0f}"


def _unit(raw: _Raw, file: str) -> str:
    """Return the unit that the line of the data and the integer header state."""
    words = raw.data["unit"].strip(" .")
    by_words = stated_unit(f"units: {words}")
    codes = {int(code) for code in (raw.data["code"], _known(raw.whole[2])) if code is not None}
    if len(codes) > 1:
        raise RecordFormatError(
            f"unit of {file} must be stated alike in its header and before its data; got codes {sorted(codes)}"
        )
    code = codes.pop() if codes else None
    if code == 50 or words.lower() == "counts":
        raise NotRead(f"unit of {file} must be that of an acceleration; got counts (V0): read its V1 or V2 file")
    by_code = _UNITS.get(code) if code is not None else None
    if code is not None and by_code is None:
        raise NotRead(f"unit of {file} must be g, cm/s2 or gal; got {_OTHER_UNITS.get(code, code)}")
    if by_code and by_words and by_code != by_words:
        raise RecordFormatError(f"unit of {file} must be stated alike by word and code; got {words} and {by_code}")
    if not (by_code or by_words):
        raise NotRead(f"unit of {file} must be g, cm/s2 or gal; got {words or 'none'!r}")
    return by_code or by_words or ""


def _step(raw: _Raw, dt: float | None, points: int, file: str) -> float:
    """Return the step, real 62 in ms, which must agree with the length of the series, real 63 in s."""
    milliseconds, length = _known(raw.numbers[61]), _known(raw.numbers[62])
    step = milliseconds / 1000.0 if milliseconds else None
    if step is None and length:
        step = float(f"{length / points:.9g}")
    if step is not None and not 1e-5 <= step <= 1.0:
        raise RecordFormatError(f"step of {file} must be between 0.01 and 1000 ms; got {step * 1000.0:g}")
    step = agreed_step(step, dt, f"{(step or 0.0) * 1000.0:g} ms", file)
    approximate = _APPROXIMATELY.search(raw.data_line)
    for stated, slack in ((length, 1.5 * step + 1e-3), (float(approximate[1]) if approximate else None, 1.0 + step)):
        if stated is not None and abs(stated - points * step) > slack:
            raise RecordFormatError(
                f"points of {file} must last {stated:g} s, as its header says; got {points} points of {step:g} s"
            )
    return step


def _direction(raw: _Raw, place: re.Match[str] | None, scnl: re.Match[str] | None) -> tuple[str, float | None]:
    """Return component and azimuth: of the line of the channel, else of its SEED code, else of integer 54."""
    component = " ".join(place["component"].split()) if place else ""
    number = _known(raw.whole[53])
    if component.lower() in ("", "?", "other", "oth"):
        component = scnl["channel"] if scnl else _SPECIAL_AZIMUTHS.get(int(number or 0), component)
    azimuth = azimuth_of(component)
    if azimuth is None and number is not None and 1.0 <= number <= 360.0 and not is_vertical(component):
        azimuth = number % 360.0
    return component, azimuth


COSMOS: Final = Format("cosmos", "COSMOS", _recognises, _parse)
