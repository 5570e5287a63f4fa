"""UNAM's standard file of accelerations (Mexico): a header of words in Spanish, then a column for each channel.

Source: Instituto de Ingenieria, UNAM, "Archivo estandar de aceleracion", version 2.0, whose header says of each value
what it is: lists of channels as /a/b/c, the Fortran format of a line, and the labels of the columns.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

import numpy as np

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, stated_unit, unit_by_name
from seismass.base.values import printable
from seismass.records.formats.common import (
    LINE_WIDTH,
    Arguments,
    Channel,
    Format,
    agreed_step,
    agreed_unit,
    refuse_skip,
)
from seismass.records.formats.directions import azimuth_of
from seismass.records.formats.fixed import layout_of, read_block
from seismass.records.formats.headers import LONGEST_STEP, SHORTEST_STEP
from seismass.records.formats.numbers import is_number, last_digit, to_float
from seismass.records.formats.peaks import StatedPeak, check_peak, digit_of_peak
from seismass.records.record import Record

_KNOWN = re.compile(r"\*{20,}\s+INSTITUTO DE INGENIERIA|(?s:.{0,800}?ARCHIVO ESTANDAR DE ACELERACION)")
_DATA = re.compile(r"\s*DATOS DE ACELERACION\b")
_RULE = re.compile(r"\s*-{5,}\+-")
_ENTRY = re.compile(r"(?P<key>[^:]{3,60}?)\s*:(?P<value>.*)")

_POINTS: Final = "NUM. TOTAL DE MUESTRAS, C1-C6"
_STEP: Final = "INTERVALO DE MUESTREO, C1-C6 (S)"
_LENGTH: Final = "DURACION DEL REGISTRO (S), C1-C6"
_DIRECTION: Final = "ORIENTACION C1-C6 (RUMBO;ORIENTACION)"
_PEAK: Final = "ACEL. MAX.(GAL), C1-C6"
_PEAK_AT: Final = "ACEL. MAX., C1-C6, EN LA MUESTRA"
_UNIT: Final = "UNIDADES DE LOS DATOS"
_LAYOUT: Final = "FORMATO DATOS (FORTRAN,10 CAMPOS/DATO)"
_DECIMATION: Final = "FACTOR DE DECIMACION"


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    refuse_skip(arguments, UNAM.title, file)
    lines = text.splitlines()
    start = next((at for at, line in enumerate(lines) if _DATA.match(line)), None)
    rules = [] if start is None else [at for at in range(start, min(start + 8, len(lines))) if _RULE.match(lines[at])]
    if start is None or len(rules) != 2:
        raise RecordFormatError(f"content of {file} must have DATOS DE ACELERACION and two rules; got none")
    header = _header(lines[:start])
    components = _list(header, _DIRECTION, file)
    counts = [_whole(said, file) for said in _list(header, _POINTS, file)]
    steps = _list(header, _STEP, file)
    channels = len(components)
    for name, others in ((_POINTS, counts), (_STEP, steps)):
        if len(others) != channels or len(set(others)) != 1:
            raise RecordFormatError(f"{name} of {file} must be one for each of {channels} channels; got {others}")
    dt = _step(steps[0], arguments.dt, file)
    layout = layout_of(header.get(_LAYOUT, ""), file)
    if layout.columns != channels:
        raise RecordFormatError(f"format of the numbers of {file} must be {channels} a line; got {header[_LAYOUT]}")
    rows = len(lines) - rules[1] - 1
    if rows != counts[0]:
        raise RecordFormatError(f"points of {file} must be {counts[0]}, as its header says; got {rows}")
    block = read_block(lines, rules[1] + 1, rows * channels, layout, file)
    unit = agreed_unit(_unit(header.get(_UNIT, ""), file), arguments.unit, file)
    samples = block.values.reshape(-1, channels)
    remarks: list[str] = []
    for said in _list(header, _LENGTH, file)[:1]:
        if is_number(said) and abs(to_float(said) - counts[0] * dt) > 1.5 * dt + 0.5 * last_digit(said):
            raise RecordFormatError(
                f"record length of {file} must be {said} s, as its header says; got {counts[0]} points of {dt:g} s"
            )
    if header.get(_DECIMATION, "1") not in ("", "1"):
        remarks.append(f"decimated by {printable(header[_DECIMATION])}, as its header says")
    peaks, places = header.get(_PEAK, "").split("/")[1:], header.get(_PEAK_AT, "").split("/")[1:]
    found = []
    for number, component in enumerate(components):
        own = list(remarks)
        values = np.ascontiguousarray(samples[:, number])
        if number < len(peaks):
            place = places[number].strip() if number < len(places) else ""
            time = f"{(int(place) - 1) * dt:.6f}" if place.isascii() and place.isdigit() else ""
            digit = digit_of_peak(values, block.fields[number::channels])
            check_peak(values, StatedPeak(peaks[number], time), dt, digit, file, own)
        record = Record(
            acceleration=values * ACCELERATION_UNITS[unit],
            dt=dt,
            name=f"{printable(source.stem)} channel {number + 1}",
            event=printable(header.get("FECHA DEL SISMO [GMT]", "")),
            station=printable(", ".join(filter(None, (header.get(f"{key} DE LA ESTACION", "") for key in _STATION)))),
            component=printable(component),
            azimuth=azimuth_of(component.split(";")[0]),
            network="UNAM",
            source=source,
            file_unit=unit,
            remarks=tuple(own),
        )
        found.append(Channel(str(number + 1), record))
    return tuple(found)


_STATION: Final = ("CLAVE", "NOMBRE")


def _header(lines: list[str]) -> dict[str, str]:
    """Return the text after each key, in upper case; of several lines the first."""
    found: dict[str, str] = {}
    for line in lines:
        entry = _ENTRY.match(line[:LINE_WIDTH].strip())
        if entry:
            found.setdefault(" ".join(entry["key"].upper().split()), entry["value"].strip())
    return found


def _list(header: dict[str, str], key: str, file: str) -> list[str]:
    """Return the values of a list as /a/b/c."""
    said = header.get(key, "")
    values = [value.strip() for value in said.split("/")[1:]]
    if not values or not all(values):
        raise RecordFormatError(f"{key} of {file} must be as /a/b/c; got {printable(said)[:40]!r}")
    return values


def _whole(said: str, file: str) -> int:
    if not (said.isascii() and said.isdigit() and len(said) < 10):
        raise RecordFormatError(f"{_POINTS} of {file} must be whole numbers; got {printable(said)[:20]!r}")
    return int(said)


def _step(said: str, dt: float | None, file: str) -> float:
    stated = to_float(said) if is_number(said) else 0.0
    if not SHORTEST_STEP <= stated <= LONGEST_STEP:
        raise RecordFormatError(
            f"step of {file} must be between {SHORTEST_STEP:g} and {LONGEST_STEP:g} s; got {printable(said)[:20]!r}"
        )
    return agreed_step(stated, dt, f"{said} s", file)


def _unit(said: str, file: str) -> str:
    unit = stated_unit(said) or unit_by_name(said.partition("(")[0].strip())
    if unit is None:
        raise RecordFormatError(
            f"unit of {file} must be one of {', '.join(ACCELERATION_UNITS)}; got {printable(said)[:30]!r}"
        )
    return unit


UNAM: Final = Format("unam", "UNAM", lambda head: _KNOWN.match(head) is not None, _parse)
