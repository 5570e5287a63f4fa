"""Formats of networks that are a header of words, and then samples line after line or a column for each component.

A `Header` says how the words are found; `headed_kinds` has one for each network.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, unit_by_name, unit_named
from seismass.base.values import printable
from seismass.motions.records.formats.common import (
    LINE_WIDTH,
    LONGEST_STEP,
    NO_COUNT,
    SHORTEST_STEP,
    Arguments,
    Channel,
    Format,
    NotRead,
    StatedPeak,
    agreed_step,
    agreed_unit,
    check_peak,
    is_number,
    last_digit,
    other_quantity,
    refuse_skip,
    to_float,
)
from seismass.motions.records.formats.labels import azimuth_of
from seismass.motions.records.formats.table import Table, is_row_of_numbers, numbers_of, split, uniform_step
from seismass.motions.records.record import Record

MOST_LINES: Final = 200
"""A header is no longer."""

Pattern = re.Pattern[str]


@dataclass(frozen=True)
class Header:
    """How the words of a format are found: each pattern has one group, but `peaks`, one per component, with value and
    time. `columns` names components ("" for times), or none where samples go on from line to line.
    """

    known: Pattern
    step: Pattern | None = None
    rate: Pattern | None = None
    points: Pattern | None = None
    length: Pattern | None = None
    unit: Pattern | str = "cm/s2"
    columns: tuple[str, ...] = ()
    component: Pattern | None = None
    station: Pattern | None = None
    event: Pattern | None = None
    network: Pattern | str = ""
    peaks: Pattern | None = None
    remark: Pattern | None = None
    first_cells: int = 0


def headed_format(name: str, title: str, header: Header) -> Format:
    """Return the format that a header describes."""

    def parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
        refuse_skip(arguments, title, source.name)
        return _parse(header, text, source, arguments)

    return Format(name, title, lambda head: header.known.match(head) is not None, parse)


def _parse(header: Header, text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    file = source.name
    table = _table(header, text, file)
    words = table.text
    other = other_quantity(words)
    if other:
        raise NotRead(f"quantity of {file} must be acceleration; got {other}")
    tokens, values, counts = numbers_of(table)
    width = len(header.columns) or 1
    if header.columns:
        wrong = next((row for row, count in enumerate(counts) if count != width), None)
        if wrong is not None:
            raise RecordFormatError(
                f"line {table.line_number(wrong)} of {file} must be {width} numbers; got {counts[wrong]}"
            )
    matrix = values.reshape(-1, width)
    points = _whole(header.points, words)
    if points is not None and points != len(matrix):
        raise RecordFormatError(f"points of {file} must be {points}, as its header says; got {len(matrix)}")
    remarks: list[str] = []
    dt = _step(header, words, matrix, tokens, arguments.dt, file)
    _check_length(header, words, len(matrix), dt, file, remarks)
    unit = agreed_unit(_unit(header, words, file), arguments.unit, file)
    if points is None and not _text_of(header.length, words):
        remarks.append(NO_COUNT)
    stated = _text_of(header.remark, words)
    if stated:
        remarks.append(f"its header says {printable(stated)}")
    components = [(index, name) for index, name in enumerate(header.columns) if name] or [
        (0, _text_of(header.component, words))
    ]
    peaks = list(header.peaks.finditer(words)) if header.peaks else []
    channels = []
    for number, (index, component) in enumerate(components):
        samples = np.ascontiguousarray(matrix[:, index])
        notes = list(remarks)
        if number < len(peaks):
            _check(samples, peaks[number], dt, tokens[index::width], file, notes)
        channels.append(
            Channel(
                str(number + 1),
                Record(
                    acceleration=samples * ACCELERATION_UNITS[unit],
                    dt=dt,
                    name=printable(source.stem) + (f" channel {number + 1}" if len(components) > 1 else ""),
                    event=printable(_text_of(header.event, words)),
                    station=printable(_text_of(header.station, words)),
                    component=printable(component),
                    azimuth=azimuth_of(component),
                    network=header.network if isinstance(header.network, str) else _text_of(header.network, words),
                    source=source,
                    file_unit=unit,
                    remarks=tuple(notes),
                ),
            )
        )
    return tuple(channels)


def _table(header: Header, text: str, file: str) -> Table:
    lines = text.splitlines()
    cells = header.first_cells

    def numbers(line: str) -> str:
        return line.split(",", cells)[-1] if cells and line.count(",") >= cells else line

    width = len(header.columns)
    start = next(
        (
            index
            for index, line in enumerate(lines[:MOST_LINES])
            if is_row_of_numbers(numbers(line)) and (not width or len(split(numbers(line))) == width)
        ),
        None,
    )
    if start is None:
        raise RecordFormatError(f"content of {file} must be numbers behind its header; got none in {len(lines)} lines")
    rows = [numbers(line) for line in lines[start:] if line.strip()]
    head = [line.strip()[:LINE_WIDTH] for line in lines[:start] if line.strip()]
    return Table(file, head, rows, lines, start)


def _text_of(pattern: Pattern | None, words: str) -> str:
    match = pattern.search(words) if pattern else None
    return " ".join(match[1].split()) if match else ""


def _whole(pattern: Pattern | None, words: str) -> int | None:
    stated = _text_of(pattern, words)
    return int(stated) if stated.isascii() and stated.isdigit() and len(stated) < 10 else None


def _step(
    header: Header, words: str, matrix: NDArray[np.float64], tokens: list[str], dt: float | None, file: str
) -> float:
    """Return the step that the header, the times and the caller agree on."""
    text, rate = _text_of(header.step, words), _text_of(header.rate, words)
    stated: float | None = None
    written = ""
    if is_number(text) and to_float(text) > 0.0:
        stated, written = to_float(text), f"{text} s"
    elif is_number(rate) and to_float(rate) > 0.0:
        stated, written = 1.0 / to_float(rate), f"{rate} samples a second"
    if stated is not None and not SHORTEST_STEP <= stated <= LONGEST_STEP:
        raise RecordFormatError(
            f"step of {file} must be between {SHORTEST_STEP:g} and {LONGEST_STEP:g} s; got {written}"
        )
    if "" in header.columns:
        width = len(header.columns)
        column = header.columns.index("")
        times = uniform_step(matrix[:, column], tokens[column::width], file, rounding=False)
        if stated is not None and abs(times - stated) * max(len(matrix) - 1, 1) > 0.1 * stated + 0.5 * last_digit(
            tokens[-width + column]
        ):
            raise RecordFormatError(f"times of {file} must be {stated:g} s apart, as its header says; got {times:g} s")
        if stated is None:
            stated, written = times, f"times {times:g} s apart"
    return agreed_step(stated, dt, written, file)


def _check_length(header: Header, words: str, points: int, dt: float, file: str, remarks: list[str]) -> None:
    """Hold the duration of the header against the samples; a step less is remarked."""
    stated = _text_of(header.length, words)
    if not is_number(stated):
        return
    off, rounding = abs(to_float(stated) - points * dt), 0.5 * last_digit(stated) + 1e-9
    if 0.5 * dt + rounding < off <= 1.5 * dt + rounding:
        remarks.append(f"{points} points last {points * dt:g} s; the header gives {stated} s")
    if off > 1.5 * dt + rounding:
        raise RecordFormatError(
            f"record length of {file} must be {stated} s, as its header says; got {points} points of {dt:g} s"
        )


def _unit(header: Header, words: str, file: str) -> str:
    if isinstance(header.unit, str):
        return header.unit
    stated = _text_of(header.unit, words)
    unit = unit_by_name(stated.strip(" .()")) or unit_named(stated)
    if unit is None:
        raise RecordFormatError(f"unit of {file} must be one of {', '.join(ACCELERATION_UNITS)}; got {stated[:30]!r}")
    return unit


def _check(
    samples: NDArray[np.float64], peak: re.Match[str], dt: float, fields: list[str], file: str, remarks: list[str]
) -> None:
    largest = int(np.argmax(np.abs(samples)))
    others = peak.groupdict()
    value = max((peak["value"], others.get("least") or "0"), key=lambda written: abs(to_float(written)))
    one_side = to_float(peak["value"])
    close = 0.5 * last_digit(peak["value"]) + 0.5 * last_digit(fields[largest])
    if (
        "least" not in others
        and abs(abs(one_side) - abs(samples[largest])) > close
        and any(abs(side - one_side) <= close for side in (np.max(samples), np.min(samples)))
    ):
        remarks.append(f"the peak is {samples[largest]:.6g}; the header gives that of the other sign, {peak['value']}")
        return
    stated = StatedPeak(value, others.get("time") or "", signed=False)
    check_peak(samples, stated, dt, last_digit(fields[largest]), file, remarks)


_NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][+-]?\d+)?"


def _find(pattern: str) -> re.Pattern[str]:
    return re.compile(pattern, re.IGNORECASE | re.MULTILINE)


RESORCE: Final = headed_format(
    "resorce",
    "RESORCE",
    Header(
        known=_find(r"\s*Event Date & Time\s*:(?s:.{0,1500}?)Time Increment"),
        step=_find(rf"^Time Increment \(s\)\s*:\s*({_NUMBER})"),
        points=_find(r"^Number of Data\s*:\s*(\d+)"),
        unit=_find(r"^Acc?el[ae]ration time series in\s+(\S.*)"),
        component=_find(r"^Orientation\s*:\s*(.*)"),
        station=_find(r"^Station Code / Name\s*:\s*(.*)"),
        event=_find(r"^Event Date & Time\s*:\s*(.*)"),
        network=_find(r"^Network\s*:\s*(.*)"),
        peaks=_find(rf"^PGA \([^)]*\)\s*:\s*(?P<value>{_NUMBER})"),
    ),
)

CSMNC: Final = headed_format(
    "csmnc",
    "CSMNC",
    Header(
        known=_find(r"(?s:.{0,1200}?)^COMP\.\s(?s:.{0,300}?)EQUALLY SPACED INTERVALS OF"),
        step=_find(rf"EQUALLY SPACED INTERVALS OF\s*:\s*({_NUMBER})\s*SEC"),
        points=_find(r"NO\. OF POINTS\s*:\s*(\d+)"),
        unit=_find(r"\bUNIT\s*:\s*(\S+)"),
        component=_find(r"^COMP\.\s*(.*)"),
        station=_find(r"^STATION\s*:\s*(\S+)"),
        event=_find(r"^\d+\s+(\d{4}-\d\d-\d\d.*)"),
        network="CSMNC",
        peaks=_find(rf"^PEAK VALUE\s*:\s*(?P<value>{_NUMBER})\s*AT\s*(?P<time>{_NUMBER})"),
        remark=_find(r"^(UNCORRECTED ACCELERATION)"),
    ),
)

JMA: Final = headed_format(
    "jma",
    "JMA CSV",
    Header(
        known=_find(r"\s*SITE CODE\s*=(?s:.{0,400}?)SAMPLING RATE\s*="),
        rate=_find(rf"SAMPLING RATE\s*=\s*({_NUMBER})\s*Hz"),
        unit=_find(r"UNIT\s*=\s*([^,(\n]+)"),
        columns=("NS", "EW", "UD"),
        station=_find(r"SITE CODE\s*=\s*([^,\n]+)"),
        event=_find(r"INITIAL TIME\s*=\s*([^,\n]+)"),
        network="JMA",
    ),
)

NIED: Final = headed_format(
    "nied_csv",
    "NIED CSV",
    Header(
        known=_find(r"\s*OriginTime,(?s:.{0,800}?)RelativeTime\s*\(s\)\s*,\s*NS\b"),
        unit=_find(r",NS\s*\(([^)]*)\)"),
        columns=("", "NS", "EW", "UD"),
        station=_find(r"^Code,\s*([^,\n]+)"),
        event=_find(r"^OriginTime,\s*([^,\n]+)"),
        network="NIED",
        remark=_find(r"^(Offset,(?!\s*[-+]?0\.?0*\s*,\s*[-+]?0\.?0*\s*,\s*[-+]?0\.?0*\s*$).*)"),
        first_cells=1,
    ),
)

CWA: Final = headed_format(
    "cwa",
    "CWA",
    Header(
        known=_find(r"#\s*Earthquake Information|#?\s*StationCode\s*:(?s:.{0,800}?)AmplitudeUnit"),
        rate=_find(rf"^#?\s*SampleRate[^:\n]*:\s*({_NUMBER})"),
        length=_find(rf"^#?\s*RecordLength[^:\n]*:\s*({_NUMBER})"),
        unit=_find(r"^#?\s*AmplitudeUnit\s*:\s*(\S+)"),
        columns=("", "U", "N", "E"),
        station=_find(r"^#?\s*StationCode\s*:\s*(.*)"),
        event=_find(r"^#?\s*Origin Time[^:\n]*:\s*(.*)"),
        network="CWA",
        peaks=_find(rf"^#?\s*AmplitudeMAX\.\s*[UNE]\s*:\s*(?P<value>{_NUMBER})\s*~\s*(?P<least>{_NUMBER})"),
    ),
)

AFAD: Final = headed_format(
    "afad",
    "AFAD text",
    Header(
        known=_find(r"\s*STRONG GROUND MOTION RECORDS OF TURKIYE"),
        step=_find(rf"^SAMPLING INTERVAL[^:\n]*:\s*({_NUMBER})"),
        points=_find(r"^NUMBER OF DATA\s*:\s*(\d+)"),
        unit="cm/s2",
        columns=("N-S", "E-W", "U-D"),
        station=_find(r"^STATION ID\s*:\s*(.*)"),
        event=_find(r"^EARTHQUAKE DATE[^:\n]*:\s*(.*)"),
        network="AFAD",
        peaks=_find(rf"\([NEU]-[SWD]\)\s*(?P<value>{_NUMBER})"),
    ),
)

HEADED: Final[tuple[Format, ...]] = (RESORCE, CSMNC, JMA, NIED, CWA, AFAD)
