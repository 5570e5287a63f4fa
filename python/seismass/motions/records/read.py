"""Reading the records of one file, whatever its format."""

from __future__ import annotations

import codecs
import hashlib
import io
import math
import os
import re
import tempfile
import unicodedata
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import IO, Any, Final, Literal, TypeAlias

import numpy as np

from seismass.base.errors import InvalidMotion, RecordFormatError
from seismass.base.files import open_regular, temporary_folder, write_file
from seismass.base.limits import LONGEST_LINE, MOST_DEEP, MOST_LINES, MOST_MEMBERS, MOST_RECORD, MOST_UNPACKED
from seismass.base.units import ACCELERATION_UNITS, unit_by_name
from seismass.base.values import as_number, as_path, brief, printable
from seismass.motions.records.formats import (
    BY_NAME,
    COLUMNS,
    Arguments,
    Channel,
    Format,
    NotRead,
    known_binary,
    recognise,
)
from seismass.motions.records.formats.labels import is_vertical
from seismass.motions.records.formats.table import is_row_of_numbers
from seismass.motions.records.known import known_of_header
from seismass.motions.records.record import Record

LARGEST_PGA_G: Final = 5.0
"""The largest ground acceleration recorded is about 4 g (KiK-net IWTH25, 2008, sum of the three components)."""

SMALLEST_PGA_G: Final = 5e-4
"""A smaller peak is of no engineering use; most such files are in another unit than said."""

LARGEST_MEAN: Final = 0.1
"""A mean above this part of the peak is an offset that was not removed."""

SLOWEST: Final = 1.0
"""Mean frequency (Hz, rms of the slope by rms) below which samples look like velocity or displacement.

The 57 horizontals of the NGA-West2 records tried have 2.3 to 8.0 Hz, their velocities 0.3 to 2.0 Hz and their
displacements 0.1 to 0.8 Hz. Accelerations on very soft sites can be below 1 Hz.
"""

SPIKE: Final = 5.0
"""A sample that stands out from its neighbours by so many times any other, and by half the peak, is a spike."""


FEWEST_OF_ONE_SIGN: Final = 50
"""So many samples of a motion have both signs: the ground comes to rest, so that its velocity returns to zero."""

UNUSUAL_STEP: Final = (0.0005, 0.1)
"""Steps (s) of strong-motion records: 2000 to 10 samples a second."""

LARGE_PGA_G: Final = 2.0
"""Few records are larger; one in m/s2 that is called g mostly is."""

LARGE_PGV: Final = 3.5
"""PGV (m/s) above which a unit is doubtful: TCU068 of Chi-Chi, among the largest recorded, has about 3 m/s."""


def no_motion(record: Record) -> str | None:
    """Return why samples are those of no motion: none of the other sign, as in a spectrum; else None."""
    samples = record.acceleration
    if record.samples < FEWEST_OF_ONE_SIGN or np.any(samples > 0.0) == np.any(samples < 0.0):
        return None
    return "its samples have one sign, as those of a spectrum or of absolute values, and no motion's have"


def suspicions(record: Record, *, unit_is_stated: bool) -> tuple[str, ...]:
    """Return remarks on samples that look wrong: the peak at the last sample, a doubtful unit (unless the caller stated
    it: `unit_given`), an offset, a spike.
    """
    samples = record.acceleration
    size = np.abs(samples)
    where = int(np.argmax(size))
    peak = float(size[where])
    remarks: list[str] = []
    if peak == 0.0:
        return ("every sample is zero",)
    if record.samples > 2 and where == record.samples - 1:
        remarks.append("the largest acceleration is the last sample: the file may be cut off")
    if record.pga_g > LARGEST_PGA_G:
        remarks.append(
            f"PGA {record.pga_g:.3g} g is above {LARGEST_PGA_G:g} g: the unit, {record.file_unit}, is doubtful"
        )
    elif record.pga_g > LARGE_PGA_G:
        remarks.append(
            f"PGA {record.pga_g:.3g} g is above {LARGE_PGA_G:g} g, as few records are: is the unit {record.file_unit}?"
        )
    elif record.samples >= FEWEST_OF_ONE_SIGN and record.pgv > LARGE_PGV:
        remarks.append(
            f"PGV {record.pgv:.3g} m/s is above {LARGE_PGV:g} m/s: the unit, {record.file_unit}, or the step, "
            f"{record.dt:g} s, is doubtful, or an offset was not removed"
        )
    elif record.pga_g < SMALLEST_PGA_G and unit_is_stated:
        remarks.append(f"PGA {record.pga_g:.2g} g is very small: the unit, {record.file_unit}, is doubtful")
    one_sign = no_motion(record)
    if one_sign:
        remarks.append(one_sign)
    usual = UNUSUAL_STEP[0] <= record.dt <= UNUSUAL_STEP[1]
    if not usual:
        remarks.append(
            f"step {record.dt:g} s is outside {UNUSUAL_STEP[0]:g} to {UNUSUAL_STEP[1]:g} s, those of strong-motion "
            "records: the unit of the times may be another"
        )
    if record.samples >= 100:
        mean = abs(float(np.mean(samples / peak)))
        if mean > LARGEST_MEAN:
            remarks.append(f"mean is {100.0 * mean:.0f} % of the peak: an offset was not removed")
        frequency = _mean_frequency(record)
        if frequency < SLOWEST and usual:
            remarks.append(
                f"mean frequency {frequency:.2g} Hz is low: velocity or displacement in place of acceleration, "
                "or a very soft site"
            )
        spike = _spike(record)
        if spike is not None:
            remarks.append(spike)
    return tuple(remarks)


def _mean_frequency(record: Record) -> float:
    """Return the rms slope over the rms of a record about its mean, by 2 pi (Hz); infinite for a constant one."""
    samples = record.acceleration / record.pga
    samples = samples - np.mean(samples)
    rms = float(np.sqrt(np.mean(np.square(samples))))
    slope = float(np.sqrt(np.mean(np.square(np.diff(samples))))) / record.dt
    return slope / (2.0 * np.pi * rms) if rms > 0.0 else float("inf")


def _spike(record: Record) -> str | None:
    """Return a remark on the one sample that stands out from its neighbours."""
    samples = record.acceleration / record.pga
    out = np.abs(samples[1:-1] - 0.5 * (samples[:-2] + samples[2:]))
    place = int(np.argmax(out))
    others = out.copy()
    others[max(place - 1, 0) : place + 2] = 0.0
    next_largest = float(np.max(others))
    if out[place] > SPIKE * next_largest and out[place] > 0.5:
        return (
            f"sample {place + 2} (t = {(place + 1) * record.dt:.6g} s) stands out from its neighbours as no other: "
            "a spike, or a damaged number"
        )
    return None


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

_LONG_LINE: Final = re.compile(rb"[^\r\n]{%d}" % (LONGEST_LINE + 1))


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
    matches = [one for one in channels if one.label.lower() == wanted]
    matches = matches or [one for one in channels if one.record.component.lower() == wanted]
    if len(matches) != 1:
        raise RecordFormatError(f"channel of {file} must be one of {there}; got {brief(channel)}")
    return matches[0].record


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
    known = known_of_header(_head_of(text))
    altered = ("its header says that it is not as recorded",) if _ALTERED in text[:HEAD_BYTES].lower() else ()
    return tuple(
        Channel(
            one.label,
            one.record.replace(
                sha256=digest,
                **known,
                remarks=one.record.remarks + altered + suspicions(one.record, unit_is_stated=name is not None),
            ),
        )
        for one in channels
    )


def _head_of(text: str) -> str:
    """Return the words of the beginning of a file, up to its numbers."""
    lines = text[:HEAD_BYTES].splitlines()
    return "\n".join(line for line in lines if re.search(r"[A-Za-z]{2}", line))


def format_of(head: str, source: Path) -> Format:
    """Return the format that the head of a text shows; columns, or .AT2 by its suffix, where it shows none."""
    result = recognise(head)
    if isinstance(result, Format):
        return result
    if result is not None:
        name, instead = result
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
            if size <= MOST_RECORD:  # else nothing more is read
                content = head + file.read(MOST_RECORD + 1)
                size = len(content)
        if size > MOST_RECORD:
            raise RecordFormatError(f"size of {source.name} must be at most {MOST_RECORD} bytes; got {size}")
        if _LONG_LINE.search(content):
            raise RecordFormatError(f"lines of {source.name} must be at most {LONGEST_LINE} bytes; got more")
        if content.count(b"\n") > MOST_LINES:
            raise RecordFormatError(f"lines of {source.name} must be at most {MOST_LINES}; got more")
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
    if not text.isascii():
        text = unicodedata.normalize("NFC", text)  # letters and their accents together, as patterns have them
    text = text.rstrip("\x1a\r\n\t ")  # DOS ended files with a control character
    if not text:
        raise RecordFormatError(f"content of {source.name} must be a record; got an empty file")
    return text


_VERTICAL_NAME = re.compile(
    r"[-_.](?:UP|VERT?|VERTICAL|DWN|UD)(?![A-Z0-9])"  # a word of the name: BRA-UP, ERZ-UP__copy
    r"|[-_.][VZ]$"  # a letter at its end: 1059-V
    r"|(?:UP|VERT?|DWN|[BH][NH]Z)\.?$",  # joined to a station code: HECVER, TCUUP.
    re.IGNORECASE,
)
_GROUND: Final = re.compile(
    r".*\bfree[- ]?field\b|(?:(?:at|on|the|site|array|geotech\w*|north|south|east|west|[nsew]{1,2})[\W_]+)*"
    r"(?:gr(?:ou)?nd\b(?![- ]+(?:fl|st(?:or|\b)))|grade\b|surface\b|(?:instrument |small )?shelter\b)",
    re.IGNORECASE,
)
_NO_PLACE: Final = re.compile(
    r"[\W_]*(?:unknown|other|none|n/?a|not (?:stated|known|given)|see co?mm?e?nts?)?[\W_]*", re.IGNORECASE
)
_BELOW: Final = re.compile(
    r"\bbore-?\s?hole\b|\bdown-?\s?hole\b|\bdepth\b(?!\s*[=:]?\s*0+(?:\.0*)?\s*m)|\b\d+(?:\.\d+)?\s*(?:m|meters|ft|feet)\s+"
    r"(?:deep|below|depth)",
    re.IGNORECASE,
)


def off_ground(record: Record) -> str | None:
    """Return why a record is not of the ground surface: its place in a structure or below the ground; None where it is,
    or where it states no place.
    """
    if _NO_PLACE.fullmatch(record.place):
        return None
    if _BELOW.search(record.place):
        return f"below the surface by its header: {record.place}"
    if not _GROUND.match(record.place):
        return f"in a structure, or not said to be of the ground, by its header: {record.place}"
    return None


def reason_to_leave(record: Record) -> str | None:
    """Return why a record is not a horizontal motion of the ground: vertical, in a structure or below; else None."""
    return vertical_reason(record) or off_ground(record)


def vertical_reason(record: Record) -> str | None:
    """Return why a record is a vertical component, or None."""
    if is_vertical(record.component):
        return f"vertical component by its header: {record.component}"
    if has_vertical_name(record):
        return f"vertical component by its name: {record.name}"
    return None


def has_vertical_name(record: Record) -> bool:
    """Whether the name of a record is one of a vertical component: BRA-UP, HECVER."""
    return _VERTICAL_NAME.search(record.name) is not None


_SIGNATURE: Final = b"PK\x03\x04"
_NO_RECORDS: Final = ("[Content_Types].xml", "xl/")


def is_archive(path: Path) -> bool:
    """Whether a path is a ZIP archive by its first bytes, and no sheet of Excel."""
    try:
        with open_regular(path) as file:
            if file.read(len(_SIGNATURE)) != _SIGNATURE:
                return False
            with zipfile.ZipFile(file) as archive:
                return not any(name.startswith(_NO_RECORDS) for name in archive.namelist())
    except (OSError, zipfile.BadZipFile, ValueError, NotImplementedError):
        return False


@contextmanager
def unpacked(path: Path) -> Iterator[tuple[Path, dict[Path, str]]]:
    """Yield a temporary folder with the files of an archive, and the name of each in the archive. Names of the archive
    are not paths: each file stands in a numbered folder, under the last part of its name.
    """
    with temporary_folder(Path(tempfile.gettempdir())) as place:
        folder = place.path
        names: dict[Path, str] = {}
        try:
            with open_regular(path) as file:
                inner: list[tuple[IO[bytes], str, int]] = [(file, "", 1)]
                left, number = MOST_UNPACKED, 0
                while inner:  # archives of archives: each is unpacked under its name
                    packed, prefix, depth = inner.pop()
                    archive = zipfile.ZipFile(packed)
                    members = [one for one in archive.infolist() if not one.is_dir() and not _is_hidden(one.filename)]
                    _refuse_large(path, members, number)
                    for member in sorted(members, key=lambda one: one.filename):
                        with archive.open(member) as opened:  # of a larger one as much as shows that it is
                            content = opened.read(min(left, MOST_RECORD) + 1)
                        left, number = left - len(content), number + 1
                        if left < 0:
                            raise RecordFormatError(
                                f"size of {path.name}, unpacked, must be at most {MOST_UNPACKED} bytes; got more"
                            )
                        kind = known_binary(content[:HEAD_BYTES])
                        if depth < MOST_DEEP and kind and kind[0] == "ZIP" and zipfile.is_zipfile(io.BytesIO(content)):
                            inner.append((io.BytesIO(content), f"{prefix}{member.filename}/", depth + 1))
                            continue
                        with place.new_folder(f"{number:05d}") as below:
                            target = write_file(_safe_name(member.filename), content, folder=below)
                        names[target] = prefix + member.filename
        except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, OSError) as error:
            raise RecordFormatError(f"content of {path.name} must be a sound ZIP archive; got: {error}") from error
        yield folder, names


def _is_hidden(name: str) -> bool:
    parts = PurePosixPath(name.replace("\\", "/")).parts
    return any(part.startswith((".", "__MACOSX")) and part != ".." for part in parts)


def _safe_name(name: str) -> str:
    """Return the last part of a name, without what a file system does not take."""
    last = printable(PurePosixPath(name.replace("\\", "/")).name)[-60:]  # of at most four bytes each
    safe = "".join(one if one.isalnum() or one in " -_.()+" else "_" for one in last)
    return safe if safe.strip(".") else "member"


def _refuse_large(path: Path, members: list[zipfile.ZipInfo], before: int) -> None:
    if before + len(members) > MOST_MEMBERS:
        raise RecordFormatError(f"files of {path.name} must be at most {MOST_MEMBERS}; got {before + len(members)}")
    size = sum(member.file_size for member in members)
    if size > MOST_UNPACKED:
        raise RecordFormatError(f"size of {path.name}, unpacked, must be at most {MOST_UNPACKED} bytes; got {size}")


def files_below(directory: Path) -> list[Path]:
    """Return the files in a directory and below, sorted by path, without hidden ones and those out of reach."""
    inside = ((file.relative_to(directory), file) for file in directory.rglob("*") if _is_file(file))
    seen = [(path.as_posix(), file) for path, file in inside if not any(part.startswith(".") for part in path.parts)]
    return [file for _, file in sorted(seen)]


def _is_file(path: Path) -> bool:
    """Whether a path is a file; not where a link leads to a place without access."""
    try:
        return path.is_file()
    except OSError:
        return False
