"""ESM ASCII files (Engineering Strong-Motion database; AFAD too): 64 keys of header DYNA 1.x, then a number a line.

Source of the keys: esm-db.eu, "ESM data format"; units are cm/s2, peaks in PGA_CM/S^2 at TIME_PGA_S.
"""

from __future__ import annotations

import re
import unicodedata
from pathlib import Path
from typing import Final

import numpy as np

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, stated_unit, unit_named
from seismass.base.values import printable
from seismass.motions.records.formats.common import (
    LINE_WIDTH,
    LONGEST_STEP,
    SAME_STEP,
    SHORTEST_STEP,
    Arguments,
    Channel,
    Format,
    NotRead,
    StatedPeak,
    agreed_step,
    agreed_unit,
    channels_of,
    check_peak,
    digit_of_peak,
    is_cut_off,
    is_number,
    last_digit,
    parse_numbers,
    refuse_skip,
    step_in_seconds,
    to_float,
)
from seismass.motions.records.formats.labels import azimuth_of
from seismass.motions.records.formats.table import Layout, header_values, layout_of, read_block
from seismass.motions.records.record import Record

_KEY = re.compile(r"[A-Z][A-Z0-9_/^-]*(?=:)")
_LINES_OF_HEADER: Final = 64
_NEEDED: Final = ("STATION_CODE", "SAMPLING_INTERVAL_S", "NDATA", "UNITS")


def _recognises_esm(head: str) -> bool:
    return head.startswith("EVENT_NAME:") and "STATION_CODE:" in head


def _parse_esm(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
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
    if "NOT REMOVED" in header.get("BASELINE_CORRECTION", "").upper():
        remarks.append("uncorrected: its baseline is not removed")
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


ESM: Final = Format("esm", "ESM", _recognises_esm, _parse_esm)


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


def _parse_bhrc(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    refuse_skip(arguments, BHRC.title, source.name)
    lines = text.splitlines()
    return channels_of(lines, lambda line, number: _channel(lines, line, number, source, arguments), separator=_END)


def _channel(lines: list[str], start: int, number: int, source: Path, arguments: Arguments) -> tuple[Channel, int]:
    file = source.name
    first = _FIRST.match(lines[start][:LINE_WIDTH])
    if first is None or len(lines) <= start + _HEADER:
        raise RecordFormatError(
            f"line {start + 1} of {file} must begin a component, as '* VOL1DS', with {_HEADER} lines; "
            f"got {printable(lines[start].strip())[:40]!r}"
        )
    if first["volume"] != "1":
        raise NotRead(f"volume of {file} must be 1, uncorrected accelerations; got {first['volume']}")
    titles = [line[:LINE_WIDTH].strip() for line in lines[start : start + _TEXT]]
    component, counted, unit = (
        _of(pattern, titles[row], row, start, file) for pattern, row in ((_COMPONENT, 6), (_POINTS, 10), (_UNIT, 11))
    )
    points = int(counted["points"][:12])
    whole = header_values(lines, start + _TEXT, _INTEGERS, _WHOLE)[_POINTS_AT]
    if whole is not None and whole != points:
        raise RecordFormatError(f"points of {file} must be stated alike twice; got {points} and {whole:g}")
    dt = agreed_step(*_step(counted, points, lines, start, arguments, file), file)
    block = read_block(lines, start + _HEADER, points, _NUMBERS, file)
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


def _of(pattern: re.Pattern[str], title: str, row: int, start: int, file: str) -> re.Match[str]:
    match = pattern.search(title)
    if match is None:
        wanted = {6: "the component", 10: "points and duration", 11: "UNITS ARE SECONDS AND G/10"}[row]
        raise RecordFormatError(f"line {start + row + 1} of {file} must be {wanted}; got {printable(title)[:40]!r}")
    return match


def _step(
    counted: re.Match[str], points: int, lines: list[str], start: int, arguments: Arguments, file: str
) -> tuple[float, float | None, str]:
    """Return the step by the samples a second of the reals, held against points and duration; the given one; words."""
    rate = header_values(lines, start + _TEXT + _INTEGERS, _HEADER - _TEXT - _INTEGERS, _REALS)[_RATE_AT] or 0.0
    word = counted["length"]
    length = to_float(word) if is_number(word) else 0.0
    if not 1.0 <= rate <= 1e5 or not length > 0.0:
        raise RecordFormatError(f"samples a second of {file} must be between 1 and 1e+05; got {rate:g}")
    if abs(length - points / rate) > 1.5 / rate + 0.5 * last_digit(word) + SAME_STEP * length:
        raise RecordFormatError(
            f"record length of {file} must be {word} s, as its header says; got {points} points of {1.0 / rate:g} s"
        )
    return 1.0 / rate, arguments.dt, f"{rate:g} samples a second"


BHRC: Final = Format("bhrc", "BHRC", lambda head: _FIRST.match(head[:LINE_WIDTH]) is not None, _parse_bhrc)


_KNOWN = re.compile(r"\*{20,}\s+INSTITUTO DE INGENIERIA|(?s:.{0,800}?ARCHIVO ESTANDAR DE ACELERACION)")
_DATA = re.compile(r"\s*DATOS DE ACELERACION\b")
_RULE = re.compile(r"\s*-{5,}\+-")
_ENTRY = re.compile(r"(?P<key>[^:]{3,60}?)\s*:(?P<value>.*)")

_POINTS_UNAM: Final = "NUM. TOTAL DE MUESTRAS, C1-C6"
_STEP: Final = "INTERVALO DE MUESTREO, C1-C6 (S)"
_RATE: Final = "VEL. DE MUESTREO, C1-C6 (MUESTRAS/S)"
_LENGTH: Final = "DURACION DEL REGISTRO (S), C1-C6"
_DIRECTION: Final = "ORIENTACION C1-C6 (RUMBO;ORIENTACION)"
_PEAK: Final = "ACEL. MAX.(GAL), C1-C6"
_PEAK_AT: Final = "ACEL. MAX., C1-C6, EN LA MUESTRA"
_UNIT_UNAM: Final = "UNIDADES DE LOS DATOS"
_LAYOUT: Final = "FORMATO DATOS (FORTRAN,10 CAMPOS/DATO)"
_DECIMATION: Final = "FACTOR DE DECIMACION"
_AGENCY: Final = "INSTITUCION RESPONSABLE"


class _Entries(dict[str, str]):
    """The head of a file by its keys, of which the words count: institutions differ in signs and in their order."""

    def entry(self, key: str) -> str:
        """Return what stands behind a key, or nothing."""
        return self.get(_words(key), "")


def _words(key: str) -> str:
    """Return the words of a key in upper case without accents, in alphabetic order."""
    return " ".join(
        sorted(re.findall(r"[A-Z0-9]+", unicodedata.normalize("NFKD", key).encode("ascii", "ignore").decode().upper()))
    )


def _parse_unam(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    refuse_skip(arguments, UNAM.title, file)
    lines = text.splitlines()
    start = next((k for k, line in enumerate(lines) if _DATA.match(line)), None)
    rules = [] if start is None else [k for k in range(start, min(start + 8, len(lines))) if _RULE.match(lines[k])]
    if start is None or len(rules) != 2:
        raise RecordFormatError(f"content of {file} must have DATOS DE ACELERACION and two rules; got none")
    header = _header(lines[:start])
    components = _list(header, _DIRECTION, file)
    counts = [_whole(word, file) for word in _list(header, _POINTS_UNAM, file)]
    steps = _steps(header, file)
    channels = len(components)
    for name, others in ((_POINTS_UNAM, counts), (_STEP, steps)):
        if len(others) != channels or len(set(others)) != 1:
            raise RecordFormatError(f"{name} of {file} must be one for each of {channels} channels; got {others}")
    dt = _step_unam(steps[0], arguments.dt, file)
    layout = layout_of(header.entry(_LAYOUT), file)
    if layout.columns != channels:
        raise RecordFormatError(
            f"format of the numbers of {file} must be {channels} a line; got {header.entry(_LAYOUT)}"
        )
    rows = len(lines) - rules[1] - 1
    repeated = rows - counts[0]
    if 0 < repeated * dt < 1.0 and len({line.rstrip() for line in lines[-repeated - 1 :]}) == 1:
        rows = counts[0]  # 17502 for 17500: the last row is repeated
    if rows != counts[0]:
        raise RecordFormatError(f"points of {file} must be {counts[0]}, as its header says; got {rows}")
    block = read_block(lines, rules[1] + 1, rows * channels, layout, file)
    unit = agreed_unit(_unit(header.entry(_UNIT_UNAM), file), arguments.unit, file)
    samples = block.values.reshape(-1, channels)
    remarks = [f"{repeated} repetitions of the last row left out"] if repeated > 0 else []
    for word in _list(header, _LENGTH, file)[:1]:
        if is_number(word) and abs(to_float(word) - counts[0] * dt) > 1.5 * dt + 0.5 * last_digit(word):
            raise RecordFormatError(
                f"record length of {file} must be {word} s, as its header says; got {counts[0]} points of {dt:g} s"
            )
    if header.entry(_DECIMATION) not in ("", "1"):
        remarks.append(f"decimated by {printable(header.entry(_DECIMATION))}, as its header says")
    peaks, places = header.entry(_PEAK).split("/")[1:], header.entry(_PEAK_AT).split("/")[1:]
    parsed = []
    for number, component in enumerate(components):
        notes = list(remarks)
        values = np.ascontiguousarray(samples[:, number])
        if number < len(peaks):
            place = places[number].strip() if number < len(places) else ""
            time = f"{(int(place) - 1) * dt:.6f}" if place.isascii() and place.isdigit() else ""
            digit = digit_of_peak(values, block.fields[number::channels])
            check_peak(values, StatedPeak(peaks[number], time), dt, digit, file, notes)
        record = Record(
            acceleration=values * ACCELERATION_UNITS[unit],
            dt=dt,
            name=f"{printable(source.stem)} channel {number + 1}",
            event=printable(header.entry("FECHA DEL SISMO [GMT]")),
            station=printable(", ".join(filter(None, (header.entry(f"{key} DE LA ESTACION") for key in _STATION)))),
            component=printable(component),
            azimuth=azimuth_of(component.split(";")[0]),
            network=printable(header.entry(_AGENCY)) or "UNAM",
            source=source,
            file_unit=unit,
            remarks=tuple(notes),
        )
        parsed.append(Channel(str(number + 1), record))
    return tuple(parsed)


_STATION: Final = ("CLAVE", "NOMBRE")


def _header(lines: list[str]) -> _Entries:
    """Return the text after each key; of several lines the first."""
    entries = _Entries()
    for line in lines:
        entry = _ENTRY.match(line[:LINE_WIDTH].strip())
        if entry:
            entries.setdefault(_words(entry["key"]), entry["value"].strip())
    return entries


def _list(header: _Entries, key: str, file: str) -> list[str]:
    """Return the values of a list as /a/b/c."""
    text = header.entry(key)
    values = [value.strip() for value in text.rstrip("/ ").split("/")[1:]]
    if not values or not all(values):
        raise RecordFormatError(f"{key} of {file} must be as /a/b/c; got {printable(text)[:40]!r}")
    return values


def _steps(header: _Entries, file: str) -> list[str]:
    """Return the steps (s), or those of the samples a second where no step is stated."""
    if header.entry(_STEP) or not header.entry(_RATE):
        return _list(header, _STEP, file)
    rates = _list(header, _RATE, file)
    return [f"{1.0 / float(one):.9g}" if is_number(one) and float(one) > 0.0 else one for one in rates]


def _whole(word: str, file: str) -> int:
    if not (word.isascii() and word.isdigit() and len(word) < 10):
        raise RecordFormatError(f"{_POINTS_UNAM} of {file} must be whole numbers; got {printable(word)[:20]!r}")
    return int(word)


def _step_unam(word: str, dt: float | None, file: str) -> float:
    stated = to_float(word) if is_number(word) else 0.0
    if not SHORTEST_STEP <= stated <= LONGEST_STEP:
        raise RecordFormatError(
            f"step of {file} must be between {SHORTEST_STEP:g} and {LONGEST_STEP:g} s; got {printable(word)[:20]!r}"
        )
    return agreed_step(stated, dt, f"{word} s", file)


def _unit(word: str, file: str) -> str:
    unit = unit_named(word)
    if unit is None:
        raise RecordFormatError(
            f"unit of {file} must be one of {', '.join(ACCELERATION_UNITS)}; got {printable(word)[:30]!r}"
        )
    return unit


UNAM: Final = Format("unam", "UNAM", lambda head: _KNOWN.match(head) is not None, _parse_unam)
