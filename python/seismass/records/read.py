"""Reading the records of one file, whatever its format."""

from __future__ import annotations

import codecs
import hashlib
import math
import os
import re
from pathlib import Path
from typing import Any, Final, Literal, TypeAlias

import numpy as np

from seismass.base.errors import InvalidMotion, RecordFormatError
from seismass.base.files import open_regular
from seismass.base.units import ACCELERATION_UNITS, unit_by_name
from seismass.base.values import as_number, as_path, brief
from seismass.records.checks import suspicions
from seismass.records.formats import BY_NAME, COLUMNS, Arguments, Channel, Format, NotRead, known_binary, recognise
from seismass.records.formats.table import is_row_of_numbers
from seismass.records.record import Record

FormatName: TypeAlias = Literal[
    "at2",
    "cosmos",
    "csmip",
    "esm",
    "geonet",
    "knet",
    "smc",
    "resorce",
    "csmnc",
    "jma",
    "nied_csv",
    "cwa",
    "afad",
    "unam",
    "bhrc",
    "columns",
]

HEAD_BYTES: Final = 8192
"""Bytes at the start of a file by which its format is recognised."""

FEWEST_WIDE: Final = 16
"""Fewest bytes from which an encoding is inferred."""

MOST_NULS: Final = 4
"""A text whose header is padded has no more zero bytes than this."""

_ALTERED: Final = "not as recorded"
"""Files of matched records say so in their header."""

LONGEST_LINE: Final = 2**22
"""Longest line of a record file (bytes): all samples of the longest records fit into one."""
_LONG_LINE: Final = re.compile(rb"[^\r\n]{%d}" % (LONGEST_LINE + 1))

LARGEST_BYTES: Final = 64 * 1024 * 1024
"""No record is larger: some five million samples as text, seven hours at 200 a second."""


def read_record(
    path: str | os.PathLike[str],
    *,
    dt: float | None = None,
    unit: str | None = None,
    format: FormatName | None = None,
    skip: int | None = None,
    channel: int | str | None = None,
) -> Record:
    r"""Read a ground motion record; accelerations come back in m/s2.

    Parameters
    ----------
    path : path-like
        A file of PEER (.AT2, any vintage), COSMOS (V1, V2), CSMIP (V1, V2), ESM, GeoNet (V1A, V2A), K-NET or KiK-net,
        USGS SMC, RESORCE, CSMNC, JMA, NIED's CSV, CWA, AFAD, UNAM, BHRC, or text of accelerations: one column, times
        and one or several components, or several samples a line. The format is found in the content.
    dt : float, optional
        Time step (s). One column needs it unless the file states it. It refines a step that a header rounded (.0039
        for 1/256 s), and times that are rounded. It must agree with what the file says.
    unit : {"g", "m/s2", "cm/s2", "gal", "mm/s2", "mg", "%g", "ft/s2", "in/s2"}, optional
        Unit of the accelerations in the file; spellings such as "cm/s^2", "cm/sec2" or "Gal" are understood. .AT2 files
        are in g unless their header states another. Text has no default, a wrong one being wrong by a factor of ten: it
        must be given unless the header states it. It must agree with what the file says.
    format : str, optional
        A key of the table in the documentation, such as "at2" or "columns". By default what the content shows, and
        else columns.
    skip : int, optional
        Columns only: how many rows of numbers before the data are not data (see `parse_columns`).
    channel : int or str, optional
        Which of several channels of a file: its number there (of a text of columns that of its column), or its
        component. Needed where there are several.

    Raises
    ------
    RecordFormatError
        The file is missing, empty, damaged, cut off, of a format that is known and not read, or contradicts itself or
        the arguments; or it has several channels and `channel` names none of them.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import mkdtemp
    >>> file = Path(mkdtemp(), "ramp.txt")
    >>> _ = file.write_text("time (s), acceleration (m/s2)\n0.00, 0.0\n0.01, 0.5\n0.02, 1.0\n")
    >>> read_record(file)
    <Record ramp: 3 x 0.01 s, PGA 0.1020 g>
    """
    channels = _read(path, dt, unit, format, skip)
    if channel is None and len(channels) == 1:
        return channels[0].record
    file = as_path(path, "record", RecordFormatError).name
    there = f"{len(channels)}: " + ", ".join(f"{one.label} ({one.record.component or '?'})" for one in channels)
    if channel is None:
        raise RecordFormatError(f"channel of {file} must be given, the file has {there}; got none")
    wanted = str(channel).strip().lower()
    found = [one for one in channels if one.label.lower() == wanted]
    found = found or [one for one in channels if one.record.component.lower() == wanted]
    if len(found) != 1:
        raise RecordFormatError(f"channel of {file} must be one of {there}; got {brief(channel)}")
    return found[0].record


def read_records(
    path: str | os.PathLike[str],
    *,
    dt: float | None = None,
    unit: str | None = None,
    format: FormatName | None = None,
    skip: int | None = None,
) -> tuple[Record, ...]:
    """Read every acceleration of a file, vertical ones included, in the order of the file.

    Parameters
    ----------
    path, dt, unit, format, skip
        As for `read_record`.

    Raises
    ------
    RecordFormatError
        As for `read_record`; one damaged channel is enough.
    """
    return tuple(one.record for one in _read(path, dt, unit, format, skip))


def _read(path: Any, dt: Any, unit: Any, format: Any, skip: Any) -> tuple[Channel, ...]:
    source = as_path(path, "record", RecordFormatError)
    if dt is not None:
        dt = as_number(dt, "dt", source.name, RecordFormatError)
        if not (math.isfinite(dt) and dt > 0.0):
            raise RecordFormatError(f"dt of {source.name} must be a positive number; got {dt}")
    name = unit_by_name(unit) if isinstance(unit, str) else None
    if unit is not None and name is None:
        raise RecordFormatError(
            f"unit of {source.name} must be one of {', '.join(ACCELERATION_UNITS)}; got {brief(unit)}"
        )
    if format is not None and (not isinstance(format, str) or format not in BY_NAME):
        raise RecordFormatError(f"format of {source.name} must be one of {', '.join(BY_NAME)}; got {brief(format)}")
    content = read_bytes(source)
    text = decoded(content, source)
    reader = BY_NAME[format] if format is not None else format_of(text[:HEAD_BYTES], source)
    try:
        with np.errstate(over="ignore"):  # a record refuses what overflows
            channels = reader.parse(text, source, Arguments(dt, name, skip))
    except InvalidMotion as error:
        raise RecordFormatError(f"samples of {source.name} must be those of a motion; got: {error}") from error
    digest = hashlib.sha256(content).hexdigest()
    altered = ("its header says that it is not as recorded",) if _ALTERED in text[:HEAD_BYTES].lower() else ()
    return tuple(
        Channel(
            one.label,
            one.record.replace(
                sha256=digest,
                remarks=one.record.remarks + altered + suspicions(one.record, unit_given=name is not None),
            ),
        )
        for one in channels
    )


def format_of(head: str, source: Path) -> Format:
    """Return the format that the head of a text shows; columns, or .AT2 by its suffix, where it shows none."""
    found = recognise(head)
    if isinstance(found, Format):
        return found
    if found is not None:
        name, instead = found
        raise NotRead(f"format of {source.name} must be one that is read; got {name}: {instead}")
    if source.suffix.lower() not in (".at2", ".vt2", ".dt2") or is_row_of_numbers(head.lstrip().partition("\n")[0]):
        return COLUMNS  # numbers from the first line on are no .AT2 file, whatever the suffix
    return BY_NAME["at2"]


def read_bytes(source: Path) -> bytes:
    """Return the bytes of a record file, which is neither binary nor too large."""
    try:
        with open_regular(source) as file:
            head = file.read(HEAD_BYTES)
            if wide_encoding(head) is None:
                refuse_binary(head, source)
            size = os.fstat(file.fileno()).st_size
            if size <= LARGEST_BYTES:  # else nothing more is read
                content = head + file.read(LARGEST_BYTES + 1)
                size = len(content)
        if size > LARGEST_BYTES:
            raise RecordFormatError(f"size of {source.name} must be at most {LARGEST_BYTES} bytes; got {size}")
        if _LONG_LINE.search(content):
            raise RecordFormatError(f"lines of {source.name} must be at most {LONGEST_LINE} bytes; got more")
    except OSError as error:
        raise RecordFormatError(
            f"record file must be a file that can be read; got {source} ({error.strerror or error})"
        ) from error
    return content


def refuse_binary(head: bytes, source: Path) -> None:
    """Refuse a file that its first bytes show to be binary, by its name where that is known."""
    known = known_binary(head)
    if known is not None:
        name, instead = known
        raise NotRead(f"content of {source.name} must be text; got {name}: {instead}")


def wide_encoding(head: bytes) -> str | None:
    """Return the encoding of two bytes a character by its mark, or by zeros in every other byte; None for others."""
    for mark, name in ((codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16")):
        if head.startswith(mark) and not head.startswith(codecs.BOM_UTF32_LE):
            return name
    pairs = head[: len(head) // 2 * 2]
    if len(pairs) >= FEWEST_WIDE:
        if not any(pairs[1::2]) and all(pairs[::2]):
            return "utf-16-le"
        if not any(pairs[::2]) and all(pairs[1::2]):
            return "utf-16-be"
    return None


def read_text(source: Path) -> str:
    """Return the text of a record file, with any line ends and with UTF-8 or Latin-1 letters."""
    return decoded(read_bytes(source), source)


def decoded(content: bytes, source: Path) -> str:
    """Return bytes as text without blank ends; there must be some text."""
    wide = wide_encoding(content[:HEAD_BYTES])
    if wide is not None:
        content = content.decode(wide, "replace").encode()
    if b"\0" in content and content[:HEAD_BYTES].isascii():  # some SMC files are padded, and so is their station code
        content = content.rstrip(b"\0\x1a\r\n\t ") or content
        if content.count(b"\0", 0, HEAD_BYTES) <= MOST_NULS:
            content = content[:HEAD_BYTES].replace(b"\0", b" ") + content[HEAD_BYTES:]
    if b"\0" in content:
        raise RecordFormatError(f"content of {source.name} must be text; got binary data")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("latin-1")
    text = text.rstrip("\x1a\r\n\t ")  # DOS ended files with a control character
    if not text:
        raise RecordFormatError(f"content of {source.name} must be a record; got an empty file")
    return text
