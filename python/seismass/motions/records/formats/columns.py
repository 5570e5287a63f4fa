"""Text of numbers: a column of accelerations, columns of times and components, or samples line after line.

Nothing is guessed that could be wrong by a factor: the unit comes from the file or from the caller, labels that name
another quantity or a spectrum refuse the file, and numbers before the data that are not data (a scale and the step, a
count and the step) are recognised or refused, never samples.
"""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.base.units import (
    ACCELERATION_UNITS,
    contradiction,
    stated_unit,
    unit_by_name,
    units_elsewhere,
    unknown_unit,
)
from seismass.base.values import as_count, printable
from seismass.motions.records.formats.common import (
    NO_COUNT,
    SCALED,
    Arguments,
    Channel,
    Format,
    NotRead,
    is_cut_off,
    other_quantity,
    rounded_step,
    same_step,
    stated_points,
    stated_step,
    to_float,
)
from seismass.motions.records.formats.labels import (
    Label,
    Times,
    azimuth_of,
    labels_of,
    no_motion,
    place_of,
    spectrum_named,
    step_of_times,
    uncorrected_beside,
)
from seismass.motions.records.formats.table import (
    Table,
    columns_of,
    numbers_of,
    pairs_in_lines,
    read_table,
    without_first_numbers,
)
from seismass.motions.records.record import Record

MOST_TWICE: Final = 0.25
"""Rows of times and samples of which more are those before are written twice."""
_READ_INSTEAD: Final = "a motion has times and accelerations"


@dataclass(frozen=True)
class _Column:
    """One column of accelerations, what its label says, and the number or word that it is asked for by."""

    values: NDArray[np.float64]
    label: Label | None
    key: str
    remarks: tuple[str, ...] = ()


def parse_columns(
    text: str, source: Path, *, dt: float | None = None, unit: str | None = None, skip: int | None = None
) -> Record:
    """Read the text of a file with one column of accelerations; see `parse_channels`."""
    channels = parse_channels(text, source, Arguments(dt, unit, skip))
    if len(channels) > 1:
        raise RecordFormatError(f"columns of {source.name} must be those of one motion; got {len(channels)}")
    return channels[0].record


def parse_channels(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    """Read the accelerations of header lines (no numbers, or marked #, %, // or !) and rows of numbers: one column,
    times and columns by their labels, or samples in three or more a line. Commas may be decimal points.
    """
    remarks: list[str] = []
    table = read_table(text, source.name, remarks)
    if any(not line.strip() for line in _body(table)):
        remarks.append("blank lines stand among the numbers: some may be missing or moved")
    width = len(table.row(-1)) if len(table.rows) > 1 else len(table.row(0))
    labels = labels_of(table.header, width)
    _refuse_no_motion(table, labels)
    header_step = stated_step(table.text, table.file, arguments.dt)
    step_of_file = arguments.dt if arguments.dt is not None else header_step
    if arguments.skip is None:
        table, step_before = without_first_numbers(table, step_of_file, remarks)
    else:
        left_out = as_count(arguments.skip, "skip", table.file, RecordFormatError)
        if left_out >= len(table.rows):
            raise RecordFormatError(f"skip of {table.file} must be between 0 and {len(table.rows) - 1}; got {left_out}")
        table, step_before = table.without(left_out), None
    tokens, values, counts = numbers_of(table)
    paired = pairs_in_lines(values, counts)
    columns = 2 if paired else columns_of(table, values, counts, labels is not None)
    if paired:
        labels = None
        remarks.append(f"times and samples are taken in turn, {counts[0] // 2} pairs in each line")
    scale = SCALED.search(table.text)
    if scale and to_float(scale[1]) != 1.0:
        remarks.append(f"its header says a scale factor of {scale[1]}: samples are taken as they stand")
    steps = {"dt": arguments.dt, "header": header_step, "first numbers": step_before}
    if columns == 1:
        if is_cut_off(tokens):
            raise _cut_off(table, tokens[-1])
        series = [_Column(values, replace(labels[0], unit="") if labels else None, "1")]  # a title may name any unit
        _check_points(table, len(values), remarks)
        if max(counts) > 1:
            remarks.append(f"samples are taken line after line, {max(counts)} in each")
    else:
        series = _of_columns(table, tokens, values.reshape(-1, columns), labels, steps, remarks)
    step = _step(table, steps, len(series[0].values), remarks)
    several = len(series) > 1
    return tuple(_channel(one, table, step, source, arguments.unit, several, tuple(remarks)) for one in series)


def _body(table: Table) -> list[str]:
    lines = table.lines[table.start :]
    while lines and not lines[-1].strip():
        lines.pop()
    return lines


def _refuse_no_motion(table: Table, labels: list[Label] | None) -> None:
    """Refuse what its labels or its header call a spectrum, a list, or another quantity than acceleration."""
    named = no_motion(labels) if labels else None
    accelerations = bool(labels) and any(label.kind == "acceleration" for label in labels or ())
    if named is None and not (accelerations and any(label.kind == "times" for label in labels or ())):
        named = spectrum_named(table.text)
    if named:
        raise NotRead(
            f"content of {table.file} must be a motion; got {printable(named)}: a spectrum, a curve or a list, "
            f"no motion; {_READ_INSTEAD}"
        )
    kinds = {label.kind for label in labels or ()}
    named = next((kind for kind in ("velocity", "displacement") if kind in kinds), None)
    other = None if accelerations else named or other_quantity(table.text)
    if other:
        raise NotRead(f"quantity of {table.file} must be acceleration; got {other}")


def _of_columns(
    table: Table,
    tokens: list[str],
    values: NDArray[np.float64],
    labels: list[Label] | None,
    steps: dict[str, float | None],
    remarks: list[str],
) -> list[_Column]:
    """Return the columns of accelerations, and put the step of the times among the others."""
    columns = values.shape[1]
    time, accelerations = _roles(table, values, labels, steps["dt"])
    for index in accelerations:
        if is_cut_off(tokens[index::columns]):
            raise _cut_off(table, tokens[index - columns])
    _check_points(table, len(values), remarks)
    twice = np.all(values[1:] == values[:-1], axis=1) & np.any(values[1:, accelerations] != 0.0, axis=1)
    rising = time is not None and values[-1, time] > values[0, time]
    if rising and np.count_nonzero(twice) > MOST_TWICE * len(values):
        line = table.line_number(int(np.argmax(twice)) + 1)
        raise RecordFormatError(f"line {line} of {table.file} must differ from the one before; got lines twice")
    if time is not None:
        times = Times(
            values[:, time], tokens[time::columns], labels[time] if labels else None, table.file, table.line_number
        )
        first_step = next((step for step in steps.values() if step is not None), None)
        step = step_of_times(times, first_step, remarks)
        if step is not None:
            steps["times"] = step
    passed = [label.text for index, label in enumerate(labels or ()) if index != time and index not in accelerations]
    if passed:
        remarks.append(f"columns that are not read: {printable(', '.join(passed))[:80]}")
    if labels is None and columns > 2:
        remarks.append("no label says what the columns are: the first is taken as times, the others as accelerations")
    corrected = uncorrected_beside([labels[index] for index in accelerations]) if labels else {}
    return [
        _Column(
            np.ascontiguousarray(values[:, index]),
            labels[index] if labels else None,
            "1" if len(accelerations) == 1 else str(index + 1),
            (f"uncorrected: column {printable(corrected[number])} has it corrected",) if number in corrected else (),
        )
        for number, index in enumerate(accelerations)
    ]


def _roles(
    table: Table, values: NDArray[np.float64], labels: list[Label] | None, dt: float | None
) -> tuple[int | None, list[int]]:
    """Return which column has the times, if one has, and which are accelerations."""
    columns = values.shape[1]
    if labels is None:
        return 0, list(range(1, columns))
    times = [index for index, label in enumerate(labels) if label.kind == "times"]
    index_columns = [index for index, label in enumerate(labels) if label.kind == "index"]
    time = next(iter([*times, *index_columns]), None)
    accelerations = [index for index, label in enumerate(labels) if label.kind == "acceleration"]
    unknown = [index for index, label in enumerate(labels) if label.kind == ""]
    if not accelerations and unknown[-1:] == [columns - 1] and len(unknown) <= 2:
        accelerations = [columns - 1]
    if time is None and unknown[:1] == [0] and accelerations == list(range(1, columns)):
        if dt is None:  # what is not called a time may be anything, such as T1 or a node
            raise RecordFormatError(
                f"dt of {table.file} must be given where its first column holds the times, or that be called time or "
                f"t; got {printable(labels[0].text)[:30]!r}"
            )
        time = 0
    if not accelerations or len(times) > 1:
        words = printable(", ".join(label.text for label in labels))[:80]
        raise RecordFormatError(
            f"labels of {table.file} must name one column of times and its accelerations; got {words}"
        )
    return time, accelerations


def _cut_off(table: Table, last: str) -> RecordFormatError:
    return RecordFormatError(
        f"last number of {table.file} must be written as the others are; got {last!r}: the file is cut off"
    )


def _check_points(table: Table, samples: int, remarks: list[str]) -> None:
    points = stated_points(table.text)
    if points is None and not any("number of points" in remark for remark in remarks):
        remarks.append(NO_COUNT)
    if points not in (None, samples):
        raise RecordFormatError(f"points of {table.file} must be {points}, as its header says; got {samples}")


def _channel(
    column: _Column,
    table: Table,
    step: float,
    source: Path,
    unit: str | None,
    several: bool,
    remarks: tuple[str, ...],
) -> Channel:
    name = _unit(table, unit, column.label)
    direction = column.label.direction if column.label else ""
    record = Record(
        acceleration=column.values * ACCELERATION_UNITS[name],
        dt=step,
        name=printable(source.stem) + (f" channel {column.key}" if several else ""),
        component=printable(direction),
        azimuth=azimuth_of(direction) if direction else None,
        source=source,
        file_unit=name,
        place=printable(place_of(column.label)) if column.label else "",
        remarks=(*remarks, *column.remarks),
    )
    return Channel(column.key, record)


def _parse(text: str, source: Path, arguments: Arguments) -> tuple[Channel, ...]:
    return parse_channels(text, source, arguments)


COLUMNS: Final = Format("columns", "text of columns", lambda _: True, _parse)


def _step(table: Table, steps: dict[str, float | None], samples: int, remarks: list[str]) -> float:
    stated = {name: step for name, step in steps.items() if step is not None}
    if not stated:
        raise RecordFormatError(f"dt of {table.file} must be given, the file has no times and states no step; got none")
    (name, step), *others = stated.items()
    if not 0.0 < step < np.inf:
        raise RecordFormatError(f"{name} of {table.file} must give a positive step; got {step:g} s")
    for other_name, other in others:
        if not same_step(step, other, samples, table.text if other_name == "header" else ""):
            raise RecordFormatError(
                f"{name} of {table.file} must agree with the step of its {other_name}, {other:g} s; got {step:g} s"
            )
    if name == "header":
        remarks.extend(rounded_step(table.text))
    return step


def _unit(table: Table, unit: str | None, label: Label | None) -> str:
    """Return the unit that the label of a column and the header state; of two, or of none, the given one decides."""
    of_label = unit_by_name(label.unit) if label and label.unit else None
    others = (line for line in table.header if label is None or label.text not in line)
    text = "\n".join((f"units: {of_label}", *others)) if of_label else table.text
    against = contradiction(text, unit) if unit else None
    if against:
        raise RecordFormatError(f"unit of {table.file} must be that of its header, {against}; got {unit}")
    stated = stated_unit(text)
    if not (unit or stated):
        unknown, other = unknown_unit(text), " and ".join(units_elsewhere(text))
        statement = (
            f"states {printable(unknown)}" if unknown else f"names {other}, and not of its samples" if other else ""
        )
        raise RecordFormatError(
            f"unit of {table.file} must be given ({', '.join(ACCELERATION_UNITS)}), the file "
            + (f"{statement}: unit= says which; got none" if statement else "states none; got none")
        )
    return unit or stated or ""


_CONVERT: Final = "convert it to text of one column (acceleration) or two (time, acceleration)"
_NETWORK: Final = f"read the PEER, COSMOS, CSMIP, ESM, K-NET or SMC file of the record, or {_CONVERT}"
_COUNTS: Final = "read it by seismass.motions.records.read_counts with the m/s2 of one count (needs ObsPy)"
_UNPACK: Final = "unpack it and read the files in it"

_MAGIC: Final[tuple[tuple[bytes, str, str], ...]] = (
    (b"\x89HDF\r\n\x1a\n", "HDF5 (ASDF, MATLAB 7.3)", _CONVERT),
    (b"MATLAB ", "MATLAB", _CONVERT),
    (b"\x93NUMPY", "NumPy", _CONVERT),
    (b"PAR1", "Parquet", _CONVERT),
    (b"ARROW1", "Arrow", _CONVERT),
    (b"SQLite format 3\0", "SQLite", _CONVERT),
    (b"CDF\x01", "NetCDF", _CONVERT),
    (b"CDF\x02", "NetCDF", _CONVERT),
    (b"MS\x03", "miniSEED 3", _CONVERT),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "Excel (.xls)", "save the sheet as CSV"),
    (b"\x1f\x8b", "gzip", _UNPACK),
    (b"BZh", "bzip2", _UNPACK),
    (b"\xfd7zXZ\0", "xz", _UNPACK),
    (b"\x28\xb5\x2f\xfd", "zstd", _UNPACK),
    (b"7z\xbc\xaf\x27\x1c", "7z", _UNPACK),
    (b"Rar!\x1a\x07", "RAR", _UNPACK),
    (b"\x1f\x9d", "compress (.Z)", _UNPACK),
    (b"%PDF-", "PDF", "read the data file, not its report"),
    (b"\x89PNG\r\n\x1a\n", "PNG", "read the data file, not a picture"),
    (b"\xff\xd8\xff", "JPEG", "read the data file, not a picture"),
    (b"GIF8", "GIF", "read the data file, not a picture"),
    (b"%!PS", "PostScript", "read the data file, not a plot"),
    (b"{\\rtf", "RTF", "save it as plain text"),
    (b"BEGIN GSE2", "GSE2", _CONVERT),
    (b"WID2 ", "GSE2", _CONVERT),
    (b"WID1 ", "GSE1", _CONVERT),
    (b"XW01 ", "GSE1", _CONVERT),
    (b"version https://git-lfs", "Git LFS pointer", "fetch the file that it points to"),
)
_MINISEED = re.compile(rb"\d{6}[DRQM][ \0]|[0-9 ]{6}[DRQM] [A-Za-z0-9 ]{5}")
_SEED = re.compile(rb"\d{6}[VAST] ")
_SAC_HEADER_BYTES: Final = 632
_SAC_VERSION_AT: Final = 304
_TAR_AT: Final = 257

_LINES: Final[tuple[tuple[re.Pattern[str], str, str], ...]] = tuple(
    (re.compile(pattern, re.IGNORECASE), name, instead)
    for pattern, name, instead in (
        (
            r"\s*(?:<!doctype html|<html|<head|<body)",
            "HTML page",
            "download the file itself, signed in where its site asks it",
        ),
        (r"\s*<\?xml|\s*<q:quakeml|\s*<FDSNStationXML", "XML", _NETWORK),
        (r"\s*[{\[]\s*(?:[\"{\[]|$)", "JSON", _NETWORK),
        (r"(?:CORRECTED ACCELEROGRAM.*CORRESPONDING|FILE\s+\d+ OF UNCORRECTED ACCELEROGRAM)", "USC volume", _NETWORK),
        (r"\s*RESPONSE AND FOURIER AMPLITUDE SPECTRA", "CSMIP V3 (spectra)", "read its V1 or V2 file"),
        (r"\s*(?:RESPONSE|FOURIER) SPECTR\w+.*\(Format v", "COSMOS V3 (spectra)", "read its V1 or V2 file"),
        (r"TIMESERIES \S+_\S*,.*samples.*sps", "ASCII time series of FDSN", _CONVERT),
        (r"\s*(?:-?\d*\.\d+\s+){4}-?\d*\.\d+\s*\n(?=(?:.*\n){0,24}?.*-12345(?:\.0+)?\b)", "alphanumeric SAC", _CONVERT),
        (r"(?s).{0,600}?UNITS=CM/SEC\*\*2, CM/SEC, AND CM", "USGS text of three quantities", _NETWORK),
        (r"(?s).{0,600}?EUROPEAN STRONG[- ]MOTION DATA", "ISESD", _NETWORK),
    )
)


def known_binary(head: bytes) -> tuple[str, str] | None:
    """Return name and advice of a binary file by its first bytes, or None."""
    for magic, name, instead in _MAGIC:
        if head.startswith(magic):
            return name, instead
    if head.startswith(b"PK\x03\x04"):
        if b"[Content_Types].xml" in head or b"xl/" in head:
            return "Excel (.xlsx)", "save the sheet as CSV"
        return "ZIP", "unpack it, or read it as a folder (read_suite, seismass records)"
    if head[_TAR_AT : _TAR_AT + 5] == b"ustar":
        return "tar", _UNPACK
    if _SEED.match(head):
        return "SEED", _CONVERT
    if _MINISEED.match(head) and (b"\0" in head or not head.isascii()):
        return "miniSEED", _COUNTS
    if len(head) >= _SAC_HEADER_BYTES:
        versions = [struct.unpack_from(order + "i", head, _SAC_VERSION_AT)[0] for order in "<>"]
        if any(version in (6, 7) for version in versions):
            return "SAC", _COUNTS
    return None


def known_text(head: str) -> tuple[str, str] | None:
    """Return name and advice of a text file by its first lines, or None."""
    for pattern, name, instead in _LINES:
        if pattern.match(head):
            return name, instead
    return None
