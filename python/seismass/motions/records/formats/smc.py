"""USGS SMC files: 11 lines of text, 6 of integers, 10 of reals, comments, then numbers in columns of ten, in cm/s2.

Source: USGS National Strong Motion Program, "SMC-format data files": numbers are 8F10.5 or 8(1PE10.4E1), which touch;
uncorrected records without a sampling rate are pairs of time and acceleration. What reals 33 and 35 are was
inferred from two public files and the parameters of the program BAP, which writes them (second-hand).
"""

from __future__ import annotations

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
    NotRead,
    StatedPeak,
    agreed_step,
    agreed_unit,
    check_peak,
    last_digit,
    refuse_skip,
)
from seismass.motions.records.formats.labels import azimuth_of, is_vertical
from seismass.motions.records.formats.table import Block, Layout, header_values, read_block, uniform_step
from seismass.motions.records.known import USABLE_OVER_CORNER
from seismass.motions.records.record import Record

_TEXT: Final = 11
_INTEGERS: Final = 6
_REALS: Final = 10
_DATA: Final = Layout(8, 10)
_KIND = re.compile(r"\d*\s*(?P<kind>[A-Z]+(?: [A-Z]+)*)", re.IGNORECASE)
_VOLUME = re.compile(r"\s*\d\s+[A-Z]", re.IGNORECASE)
_STATION = re.compile(r"station\s*=\s*(?P<name>.*?)\s*component\s*=\s*(?P<component>.*)", re.IGNORECASE)
_SOURCE = re.compile(r"data source\s*=\s*(.*)", re.IGNORECASE)

MISSING_NUMBER: Final = 1e30
"""Reals that are not known are 1.7E+38 or 1.7E+39."""


def _recognises(head: str) -> bool:
    lines = head.splitlines()
    if len(lines) > _TEXT and lines[5].startswith("station =") and lines[7].startswith("inst type"):
        return True
    # Programs that write the format leave its text blank: the volume above and integers below are left of it.
    whole = header_values(lines, _TEXT, _INTEGERS, Layout(8, 10, True))
    return (
        len(lines) > _TEXT + _INTEGERS
        and _VOLUME.match(lines[0]) is not None
        and len(whole) == 8 * _INTEGERS
        and not any(number is None or number % 1.0 for number in whole)
    )


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    refuse_skip(arguments, SMC.title, file)
    lines = text.splitlines()
    kind = _KIND.match(lines[0].strip()[:LINE_WIDTH])
    quantity = kind["kind"].lower() if kind else "a record of no volume"
    if "accelerogram" not in quantity:
        raise NotRead(
            f"quantity of {file} must be an uncorrected or corrected accelerogram; got {quantity}: "
            "read the SMC file of its acceleration"
        )
    whole, numbers = _numbers(lines, file)
    start, points = _data(lines, whole, file)
    block = read_block(lines, start, points, _DATA, file)
    remarks: list[str] = []
    rate = numbers[1]
    if rate is not None and 0.0 < rate < MISSING_NUMBER:
        if not 1.0 <= rate <= 1e5:
            raise RecordFormatError(f"sampling rate of {file} must be between 1 and 100000 Hz; got {rate:g}")
        dt = agreed_step(1.0 / rate, arguments.dt, f"{rate:g} samples a second", file)
    else:
        block, dt = _pairs(block, arguments.dt, file, remarks)
    if any(line.strip() for line in lines[block.end :]):
        raise RecordFormatError(
            f"points of {file} must be {points}, as its header says; got more in line {block.end + 1}"
        )
    agreed_unit("cm/s2", arguments.unit, file)
    _check_peaks(block, numbers, dt, lines, file, remarks)
    if quantity.startswith("un"):
        remarks.append("uncorrected accelerogram: neither filtered nor corrected for its baseline")
    if whole[17] == 1:
        remarks.append("the header flags a problem, which its comments describe")
    station = _STATION.match(lines[5].strip()[:LINE_WIDTH])
    component = station["component"].strip() if station else ""
    agency = _SOURCE.search(lines[7][:LINE_WIDTH])
    lowest, highest = (None, None) if quantity.startswith("un") else _band(numbers)
    record = Record(
        acceleration=block.values * ACCELERATION_UNITS["cm/s2"],
        dt=dt,
        name=printable(source.stem),
        lowest_hz=lowest,
        highest_hz=highest,
        event=" ".join(lines[3].split()),
        station=", ".join(part for part in (lines[2].strip("* "), station["name"] if station else "") if part),
        component=component,
        azimuth=_azimuth(component, whole),
        network=agency[1].strip() if agency else "",
        source=source,
        file_unit="cm/s2",
        remarks=tuple(remarks),
    )
    return (Channel(component or "1", record),)


def _numbers(lines: list[str], file: str) -> tuple[list[float | None], list[float | None]]:
    """Return the integers and the reals of the header."""
    whole = header_values(lines, _TEXT, _INTEGERS, Layout(8, 10, True))
    numbers = header_values(lines, _TEXT + _INTEGERS, _REALS, Layout(5, 15))
    sound = len(whole) == 8 * _INTEGERS and len(numbers) == 5 * _REALS
    if not sound or any(number is None or number % 1.0 for number in whole) or None in numbers:
        raise RecordFormatError(f"header of {file} must be {_INTEGERS} lines of integers and {_REALS} of reals")
    return whole, numbers


def _data(lines: list[str], whole: list[float | None], file: str) -> tuple[int, int]:
    """Return the index of the first line of data, after the comments, and the number of points."""
    comments, points = int(whole[15] or 0), int(whole[16] or 0)
    first = _TEXT + _INTEGERS + _REALS
    if not 0 <= comments < len(lines) - first or any(not line.startswith("|") for line in lines[first:][:comments]):
        raise RecordFormatError(f"comments of {file} must be {comments} lines that start with |, as its header says")
    if lines[first + comments].startswith("|"):
        raise RecordFormatError(f"comments of {file} must be {comments}, as its header says; got more")
    return first + comments, points


def _band(numbers: list[float | None]) -> tuple[float | None, float | None]:
    """Return the usable band (Hz): real 33 is the corner of the low-cut filter, real 35 where the high-cut begins."""
    corner, high = (number if 0.0 < (number or 0.0) < MISSING_NUMBER else None for number in (numbers[32], numbers[34]))
    if corner is not None and high is not None and high <= corner:
        return None, None
    return None if corner is None else USABLE_OVER_CORNER * corner, high


def _azimuth(component: str, whole: list[float | None]) -> float | None:
    """Return the direction that the component states, else integer 14 where 13 says that it is horizontal."""
    azimuth, horizontal = azimuth_of(component), whole[13]
    if azimuth is None and not is_vertical(component) and horizontal not in (whole[0], None) and whole[12] == 90:
        return float(horizontal or 0.0) % 360.0
    return azimuth


def _pairs(block: Block, dt: float | None, file: str, remarks: list[str]) -> tuple[Block, float]:
    """Split numbers into times and accelerations, where the header gives no sampling rate."""
    if len(block.values) % 2:
        raise RecordFormatError(f"points of {file} must be pairs of time and acceleration; got {len(block.values)}")
    times, samples = block.values[::2], block.values[1::2]
    try:
        step = uniform_step(times, block.fields[::2], file)
    except RecordFormatError as error:
        raise NotRead(f"{error}: read its corrected record (volume 2)") from error
    remarks.append(f"pairs of time and acceleration; the times give a step of {step:.7g} s")
    return Block(np.ascontiguousarray(samples), block.fields[1::2], block.end), agreed_step(
        step, dt, f"times {step:g} s apart", file
    )


def _check_peaks(
    block: Block, numbers: list[float | None], dt: float, lines: list[str], file: str, remarks: list[str]
) -> None:
    """Hold the largest and the smallest sample against reals 30 and 32, and their times against 29 and 31."""
    tokens = [
        line[edge : edge + 15].strip() for line in lines[_TEXT + _INTEGERS :][:_REALS] for edge in range(0, 75, 15)
    ]
    for sign, value, time in ((1.0, 29, 28), (-1.0, 31, 30)):
        stated, when = numbers[value], numbers[time]
        if stated is None or abs(stated) >= MISSING_NUMBER:
            continue
        side = np.maximum(block.values * sign, 0.0)
        if sign * stated < 0.0 or not side.any():
            continue
        written = tokens[value].lstrip("+-")
        time_text = tokens[time] if when is not None and abs(when) < MISSING_NUMBER else ""
        digit = last_digit(block.fields[int(np.argmax(side))].strip())
        check_peak(side, StatedPeak(written, time_text, signed=False), dt, digit, file, remarks)


SMC: Final = Format("smc", "SMC", _recognises, _parse)
