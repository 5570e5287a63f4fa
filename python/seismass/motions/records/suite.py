"""Suites of records: a directory of record files or a CSV that lists them, with what was taken and what left out."""

from __future__ import annotations

import csv
import io
import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final, overload

import numpy as np

from seismass.base.errors import InvalidMotion, RecordFormatError
from seismass.base.files import open_regular
from seismass.base.limits import MOST_TEXT_COLUMNS, within_rows
from seismass.base.units import names_unit
from seismass.base.values import as_path, brief, printable, refusal
from seismass.base.views import view
from seismass.motions.records.formats import COLUMNS, NotRead
from seismass.motions.records.formats.common import names_acceleration, stated_step
from seismass.motions.records.formats.labels import is_vertical
from seismass.motions.records.formats.table import is_row_of_numbers
from seismass.motions.records.known import with_tables
from seismass.motions.records.read import (
    HEAD_BYTES,
    FormatName,
    decoded,
    files_below,
    format_of,
    has_vertical_name,
    is_archive,
    no_motion,
    read_record,
    read_records,
    read_text,
    reason_to_leave,
    refuse_binary,
    unpacked,
    vertical_reason,
    wide_encoding,
)
from seismass.motions.records.record import KNOWN, Record

if TYPE_CHECKING:
    import polars as pl

_SAID_BY_NAME = "files are read by name or from a list, where their units can be given"

_COLUMNS = ("number", "file", "channel", "name", "event", "station", "component", "dt", "unit", "scale", "note")


@dataclass(frozen=True)
class Excluded:
    """A file that is not part of a suite, and why."""

    file: Path
    reason: str


@dataclass(frozen=True)
class Suite:
    """Records in a fixed order, with the files that were left out.

    Parameters
    ----------
    name : str
        Name of the directory or list.
    records : tuple of Record
        What was taken, in order.
    excluded : tuple of Excluded, optional
        What was left out.
    remarks : tuple of str, optional
        What else a reader of the suite should know, such as columns of a list that were not used.

    Raises
    ------
    InvalidMotion
        The name is not a string, or records, files left out or remarks have another type.
    """

    name: str
    records: tuple[Record, ...]
    excluded: tuple[Excluded, ...] = ()
    remarks: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise refusal(InvalidMotion, "name", "suite", "a string", brief(self.name))
        object.__setattr__(self, "name", printable(self.name))
        what = f"suite {self.name}"
        for parameter, item, kind in (
            ("records", "record", Record),
            ("excluded", "excluded file", Excluded),
            ("remarks", "remark", str),
        ):
            values = getattr(self, parameter)
            if not isinstance(values, tuple | list):
                raise refusal(InvalidMotion, parameter, what, f"a tuple of {kind.__name__} objects", brief(values))
            for number, value in enumerate(values, start=1):
                if not isinstance(value, kind):
                    raise refusal(InvalidMotion, f"{item} {number}", what, f"of class {kind.__name__}", brief(value))
            object.__setattr__(self, parameter, tuple(values))

    def __len__(self) -> int:
        return len(self.records)

    def __iter__(self) -> Iterator[Record]:
        return iter(self.records)

    @overload
    def __getitem__(self, index: int) -> Record: ...

    @overload
    def __getitem__(self, index: slice) -> Suite: ...

    def __getitem__(self, index: int | slice) -> Record | Suite:
        """Return a record, counted from 0, or those of a slice as a suite."""
        return replace(self, records=self.records[index]) if isinstance(index, slice) else self.records[index]

    def scaled(self, factor: float) -> Suite:
        """Return the suite with every record multiplied by `factor`, a finite number.

        Raises
        ------
        InvalidMotion
            The factor is not a finite number.
        """
        return replace(self, records=tuple(record.scaled(factor) for record in self.records))

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError

    def table(self) -> pl.DataFrame:
        """Return one row per file, those taken first, in order, then those left out with the reason."""
        import polars as pl

        schema = {
            "taken": pl.Boolean,
            "name": pl.String,
            "event": pl.String,
            "station": pl.String,
            "component": pl.String,
            "synthetic": pl.Boolean,
            "samples": pl.UInt32,
            "dt": pl.Float64,
            "pga_g": pl.Float64,
            **{name: pl.String if name == "mechanism" else pl.Float64 for name in KNOWN},
            "file": pl.String,
            "remarks": pl.String,
        }
        taken = [
            {
                "taken": True,
                "name": record.name,
                "event": record.event,
                "station": record.station,
                "component": record.component,
                "synthetic": record.synthetic,
                "samples": record.samples,
                "dt": record.dt,
                "pga_g": record.pga_g,
                **{name: getattr(record, name) for name in KNOWN},
                "file": None if record.source is None else printable(str(record.source)),
                "remarks": "; ".join(record.remarks),
            }
            for record in self.records
        ]
        left_out = [
            {
                "taken": False,
                "name": printable(item.file.stem),
                "file": printable(str(item.file)),
                "remarks": item.reason,
            }
            for item in self.excluded
        ]
        return pl.DataFrame([*taken, *left_out], schema=schema)


def read_suite(path: str | os.PathLike[str]) -> Suite:
    """Read a suite of horizontal records.

    Parameters
    ----------
    path : path-like
        A directory, or a ZIP archive of one: every file in it and below that shows a record format (see `read_record`),
        and text of columns that states its unit and step, sorted by path, every horizontal channel of each. Vertical
        components are left out by header and by file name (-UP, VER, -V, ...), sensors in structures and below the
        surface by their header, files of other kinds with the reason; hidden ones are not looked at. Or a CSV with a
        column `file`, relative to the CSV, one row per record in the order to keep, and a column `channel` for files of
        several; its columns `name`, `event`, `station`, `component` replace what the files say, `dt` and `unit` are
        passed to `read_record`, the accelerations are multiplied by `scale`, `note` is added to the remarks; a `number`
        is for the reader. Other columns are not used, and named in the remarks of the suite. A vertical component in
        the list is an error: by header, by `component`, and by file name unless `component` is given. Sensors in
        structures are read where a list names them.

    Raises
    ------
    RecordFormatError
        A missing path, no record in it, a CSV without the column or that lists a file twice, a vertical component or a
        scale that is not finite, or any file of a record format that is damaged: none is dropped silently.
    """
    source = as_path(path, "suite", RecordFormatError)
    if source.is_dir():
        return _read_directory(source)
    if is_archive(source):
        with unpacked(source) as (folder, names):
            return named_after(_read_directory(folder, source), source, names)
    if source.suffix.lower() == ".csv":
        return _read_list(source)
    missing = "" if source.exists() else ", which does not exist"
    need = "a directory, a ZIP archive or a .csv file"
    raise RecordFormatError(f"suite of records must be {need}; got {source}{missing}")


def suite_of_file(
    path: Path,
    *,
    dt: float | None = None,
    unit: str | None = None,
    format: FormatName | None = None,
    skip: int | None = None,
) -> Suite:
    """Return the one record of a file, vertical or not, or the horizontal channels of a file of several."""
    records = read_records(path, dt=dt, unit=unit, format=format, skip=skip)
    if len(records) == 1:
        return Suite(records[0].name, records)
    once, twice = recorded_once([record for record in records if not reason_to_leave(record)])
    taken = tuple(once)
    if not taken:
        vertical = sum(vertical_reason(record) is not None for record in records)
        others = len(records) - vertical
        elsewhere = f" and {others} in a structure or below the surface: say which channel" if others else ""
        raise RecordFormatError(
            f"channels of {path.name} must be at least one horizontal; got {vertical} vertical{elsewhere}"
        )
    reasons = ((record.name, reason_to_leave(record)) for record in records)
    left_out = tuple(Excluded(path, f"{name}: {reason}") for name, reason in reasons if reason)
    return Suite(printable(path.stem), taken, (*left_out, *twice))


def _read_directory(directory: Path, archive: Path | None = None) -> Suite:
    """Return the suite of a folder, in which an archive may be unpacked."""
    records: list[Record] = []
    excluded: list[Excluded] = []
    for file in files_below(directory):
        read = read_file(file)
        if isinstance(read, str):
            excluded.append(Excluded(file, read))
            continue
        for record in read:
            reason = reason_to_leave(record)
            if reason:
                excluded.append(Excluded(file, reason if len(read) == 1 else f"{record.name}: {reason}"))
            else:
                records.append(record)
    records, twice = recorded_once(with_tables(records, files_below(directory)))
    offset = {number: is_uncorrected(record) and _offset(record) for number, record in enumerate(records)}
    excluded += [*twice, *(excluded_record(records[index], reason) for index, reason in offset.items() if reason)]
    taken = tuple(record for number, record in enumerate(records) if not offset[number])
    if not taken:
        place = f"archive {archive.name}" if archive else f"directory {directory}"
        raise RecordFormatError(f"records of {place} must be at least one horizontal record; got {_counted(excluded)}")
    return Suite(printable(directory.resolve().name), taken, tuple(sorted(excluded, key=lambda one: one.file)))


def named_after(suite: Suite, archive: Path, names: dict[Path, str]) -> Suite:
    """Return the suite of an unpacked archive, with its files named as they are in the archive."""
    records = tuple(
        record.replace(source=archive / names[record.source]) if record.source in names else record for record in suite
    )
    excluded = tuple(Excluded(archive / names.get(one.file, one.file.name), one.reason) for one in suite.excluded)
    return Suite(printable(archive.stem), records, excluded, suite.remarks)


def read_file(file: Path) -> tuple[Record, ...] | str:
    """Return the records of a file, or why it is left out. A damaged file of a known format is an error."""
    quantity = {".vt2": "velocities", ".dt2": "displacements"}.get(file.suffix.lower())
    if quantity:
        return f"not read: {printable(file.suffix)} files hold {quantity}"
    try:
        with open_regular(file) as opened:
            head = opened.read(HEAD_BYTES)
            size = os.fstat(opened.fileno()).st_size
        wide = wide_encoding(head) is not None
        if not wide:
            refuse_binary(head, file)
        if b"\0" in head and not wide:
            return "not read: binary data"
        if not head.strip():
            return read_records(file) if file.suffix.lower() == ".at2" else "not read: an empty file"
        text = decoded(head, file)
        reader = format_of(text, file)
        if reader is COLUMNS:
            return _read_columns(file, text, size)
        return read_records(file)
    except NotRead as error:
        return f"not read: {error}"
    except OSError as error:
        return f"not read: {error.strerror or error}"


def _read_columns(file: Path, head: str, size: int) -> tuple[Record, ...] | str:
    """Read text of columns whose head states a unit and has numbers; other text is not a record."""
    suffix = printable(file.suffix)
    kind = f"not read: {suffix} {_SAID_BY_NAME}" if suffix else f"not read: files without a suffix {_SAID_BY_NAME[6:]}"
    lines = head.splitlines()[:-1] if size > len(head) else head.splitlines()
    header: list[str] = []
    for line in lines:
        if is_row_of_numbers(line):
            break
        header.append(line)
    if len(header) == len(lines) or not names_unit("\n".join(header)) or size > MOST_TEXT_COLUMNS:
        return kind
    try:
        records = read_records(file)
        words = "\n".join(header)
        doubtful = next((reason for record in records if (reason := no_motion(record))), None)
        if doubtful is None and not names_acceleration(words) and stated_step(words, file.name) is None:
            labelled = any(record.component for record in records)
            doubtful = None if labelled else "its header does not say that it holds accelerations"
    except RecordFormatError as error:
        return f"not read: {error}"
    return f"not read: {doubtful}; read it by name or from a list if it is a motion" if doubtful else records


def excluded_record(record: Record, reason: str) -> Excluded:
    """Return the entry of a record that is left out, by its file, and by its name where the file has several."""
    several = " channel " in record.name
    return Excluded(record.source or Path(record.name), f"{record.name}: {reason}" if several else reason)


def is_uncorrected(record: Record) -> bool:
    """Whether its file says that a record is neither filtered nor corrected."""
    return any("uncorrected" in remark.lower().replace("its header says ", "")[:12] for remark in record.remarks)


def _offset(record: Record) -> str | None:
    sentence = next((remark for remark in record.remarks if remark.startswith("mean is ")), None)
    return f"uncorrected, and its {sentence}" if sentence else None


SAME_SAMPLES: Final = 2e-3
"""Samples of one recording in two formats agree to this part of the peak: headers and files round."""
SAME_MOTION: Final = 0.9
"""Least correlation, with the peaks at one instant, of a recording with its corrected one."""


def recorded_once(records: Sequence[Record]) -> tuple[list[Record], list[Excluded]]:
    """Return the records without those that stand there twice: uncorrected beside the corrected one, or the same
    samples in another format; and what is left out, with the reason. Copies of a file stay, with a remark.
    """
    reasons: dict[int, str] = {}
    uncorrected = [is_uncorrected(record) for record in records]
    for index, record in enumerate(records):
        if any(remark.startswith("uncorrected: column") for remark in record.remarks):
            reasons[index] = "uncorrected, beside its corrected column"
        for other_at, other in enumerate(records):
            if index in reasons or other_at == index or other_at in reasons:
                continue
            named = printable(other.source.name if other.source else other.name)
            if uncorrected[index] and not uncorrected[other_at] and _is_of_one_motion(record, other):
                reasons[index] = f"uncorrected; the corrected record of the same motion is taken, {named}"
            elif other_at < index and uncorrected[index] == uncorrected[other_at] and _has_same_samples(record, other):
                reasons[index] = f"the same recording as {named}, in another format"
    left = [excluded_record(records[index], reason) for index, reason in reasons.items()]
    return list(_with_copies([record for index, record in enumerate(records) if index not in reasons])), left


def _with_copies(records: list[Record]) -> Iterator[Record]:
    """Yield the records, those of files that are byte for byte the same as an earlier one with a remark."""
    first: dict[str, Record] = {}
    for record in records:
        original = first.setdefault(record.sha256, record)
        if original.source != record.source and original.source is not None:
            copy = f"the same file as {printable(original.source.name)}"
            record = record.replace(remarks=(*record.remarks, copy))
        yield record


def _has_same_samples(one: Record, other: Record) -> bool:
    formats = [(record.source.suffix.lower() if record.source else "", record.file_unit) for record in (one, other)]
    if one.samples != other.samples or not math.isclose(one.dt, other.dt, rel_tol=1e-6) or one.pga == 0.0:
        return False
    close = SAME_SAMPLES * one.pga
    if formats[0] == formats[1] or not _may_be_parallel(one, other) or abs(one.pga - other.pga) > close:
        return False
    return float(np.max(np.abs(one.acceleration - other.acceleration))) <= close


def _may_be_parallel(one: Record, other: Record) -> bool:
    """Whether nothing says that two records are of different directions."""
    if None in (one.azimuth, other.azimuth):
        names = {record.component.lower() for record in (one, other) if record.component}
        return len(names) < 2 or one.azimuth is not other.azimuth
    return one.azimuth == other.azimuth


def _is_of_one_motion(one: Record, other: Record) -> bool:
    """Whether two records are of one event, station and direction by their headers, or else of one motion."""
    if not _may_be_parallel(one, other):
        return False
    labels = [(record.event.lower(), record.station.lower()) for record in (one, other)]
    if all(labels[0]) and labels[0] == labels[1] and one.component:
        return True
    if not 0.5 < one.pga / max(other.pga, 1e-12) < 2.0:
        return False
    dt = max(one.dt, other.dt)
    peaks = [int(np.argmax(np.abs(record.acceleration))) * record.dt for record in (one, other)]
    before = min(int(peak / dt) for peak in peaks)
    after = min(int((record.duration - peak) / dt) for record, peak in zip((one, other), peaks, strict=True))
    times = dt * np.arange(-before, after + 1)
    first, second = (
        np.interp(times + peak, record.time, record.acceleration)
        for record, peak in zip((one, other), peaks, strict=True)
    )
    together = float(np.sqrt(np.dot(first, first) * np.dot(second, second)))
    return len(times) > 2 and together > 0.0 and float(np.dot(first, second)) > SAME_MOTION * together


def _counted(excluded: list[Excluded]) -> str:
    """What is in a directory without a record."""
    if not excluded:
        return "no file"
    others = [item for item in excluded if "vertical component" not in item.reason]
    ending = ""
    if others:
        ending = f" and {len(others)} other files, {printable(others[0].file.name)} {others[0].reason}"
    return f"{len(excluded) - len(others)} vertical components{ending}"


def _read_list(source: Path) -> Suite:
    text = within_rows(read_text(source), source.name, RecordFormatError)
    reader = csv.DictReader(io.StringIO(text), skipinitialspace=True, restkey="", restval="")
    try:
        rows = list(reader)
    except csv.Error as error:
        raise refusal(RecordFormatError, "content", source.name, "a table in CSV", str(error)) from error
    columns = list(rows[0]) if rows else []
    if "file" not in columns:
        raise RecordFormatError(
            f"columns of {source.name} must include `file`, with at least one row; got {', '.join(columns) or 'no row'}"
        )
    records: list[Record] = []
    seen: dict[tuple[Path, str], int] = {}
    for number, row in enumerate(rows, start=1):
        cells = {column: cell.strip() for column, cell in row.items() if column}
        if not cells["file"]:
            raise RecordFormatError(f"file of {source.name}, row {number}, must be a path; got an empty cell")
        file = source.parent / cells["file"]
        first = seen.setdefault((file.resolve(), cells.get("channel", "")), number)
        if first != number:
            raise RecordFormatError(
                f"file of {source.name}, row {number}, must be listed once; got {cells['file']}, also in row {first}"
            )
        record = read_record(
            file,
            dt=_cell_number(cells, "dt", source, number),
            unit=cells.get("unit") or None,
            channel=cells.get("channel") or None,
        )
        for component in (record.component, cells.get("component", "")):
            if is_vertical(component):
                raise RecordFormatError(
                    f"file of {source.name}, row {number}, must be a horizontal component; "
                    f"got {cells['file']}, component {component}"
                )
        if not cells.get("component") and has_vertical_name(record):
            raise RecordFormatError(
                f"file of {source.name}, row {number}, must be a horizontal component, or have its `component` given; "
                f"got {cells['file']}, vertical by its name"
            )
        labels = {key: cells[key] for key in ("name", "event", "station", "component") if cells.get(key)}
        remarks = (*record.remarks, cells["note"]) if cells.get("note") else record.remarks
        factor = _cell_number(cells, "scale", source, number)
        if factor is not None:
            if not math.isfinite(factor):
                raise RecordFormatError(f"scale of {source.name}, row {number}, must be a finite number; got {factor}")
            record = record.scaled(factor)
            remarks = (*remarks, f"scaled by {factor:g} as listed")
        records.append(record.replace(remarks=remarks, **labels))
    unknown = [printable(column) for column in columns if column and column not in _COLUMNS]
    named = f"columns of {printable(source.name)} that are not used: {', '.join(unknown)}"
    return Suite(printable(source.stem), tuple(records), remarks=(named,) if unknown else ())


def _cell_number(cells: dict[str, str], column: str, source: Path, row: int) -> float | None:
    cell = cells.get(column)
    if not cell:
        return None
    try:
        return float(cell)
    except ValueError as error:
        raise RecordFormatError(f"{column} of {source.name}, row {row}, must be a number; got {cell!r}") from error
