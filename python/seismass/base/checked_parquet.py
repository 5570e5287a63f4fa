"""Parquet files that carry a digest of themselves: a change of a single bit is found.

The metadata have a SHA-256 of the file's bytes, taken with zeros where the digest itself stands. Any reader of Parquet
reads such a file; only `damage` compares the digest.
"""

from __future__ import annotations

import hashlib
import os
import stat
from pathlib import Path
from typing import BinaryIO, Final

import polars as pl

from seismass.base.files import open_regular, polars_writing, read_table

_KEY: Final = "seismass.sha256"
_MARK: Final = b"sha256-of-this-file-with-zeros-here:"
_DIGITS: Final = 64
_ZEROS: Final = b"0" * _DIGITS
_TAIL: Final = 8
"""Bytes after the footer: its length, and PAR1."""
_CHUNK: Final = 2**20
MOST_FOOTER: Final = 2**26
"""Largest footer that is read (bytes); one of a part has some kilobytes."""


def write_checked(frame: pl.DataFrame, path: Path, metadata: dict[str, str]) -> None:
    """Write a frame to a Parquet file that carries a digest of itself, and further metadata."""
    with polars_writing(path), path.open("wb") as file:
        frame.write_parquet(file, compression="zstd", metadata={**metadata, _KEY: (_MARK + _ZEROS).decode()})
    with path.open("r+b") as file:
        digest, place, _ = _digest(file)
        file.seek(place)
        file.write(digest.encode())


def damage(path: Path) -> str | None:
    """Return what is wrong with a file of `write_checked`; None where every byte is as written. A link, a folder and a
    device are never read.
    """
    try:
        mode = path.lstat().st_mode
        for kind, name in ((stat.S_ISLNK, "a link"), (stat.S_ISDIR, "a folder")):
            if kind(mode):
                return f"is {name} and no file"
        with open_regular(path, follow=False) as file:
            digest, _, stated = _digest(file)
    except OSError as error:
        return f"cannot be read: {error.strerror or error}"
    except ValueError as error:
        return str(error)
    return None if stated == digest else "is damaged: its bytes are not those of its digest"


def read_checked(path: Path) -> pl.DataFrame:
    """Return the table of a file that `damage` finds nothing wrong with."""
    return read_table(path, follow=False)


def metadata_of(path: Path) -> dict[str, str]:
    """Return the metadata of a Parquet file; none where they cannot be read."""
    try:
        with open_regular(path, follow=False) as file:
            return pl.read_parquet_metadata(file)
    except (pl.exceptions.PolarsError, OSError):
        return {}


def _digest(file: BinaryIO) -> tuple[str, int, str]:
    """Digest of a file, where in it the digest stands, and what stands there."""
    size = file.seek(0, os.SEEK_END)
    if size < _TAIL:
        raise ValueError("is damaged: it is cut off")
    file.seek(size - _TAIL)
    length = int.from_bytes(file.read(4), "little")
    start = size - _TAIL - length
    if start < 0 or length > MOST_FOOTER:
        raise ValueError("is damaged: its end is not that of a Parquet file")
    file.seek(start)
    footer = file.read()
    before, mark, after = footer.partition(_MARK)
    if not mark or len(after) < _DIGITS:
        raise ValueError("has no digest of itself")
    file.seek(0)
    found = hashlib.sha256()
    left = start
    while left and (chunk := file.read(min(_CHUNK, left))):
        found.update(chunk)
        left -= len(chunk)
    found.update(before + mark + _ZEROS + after[_DIGITS:])
    return found.hexdigest(), start + len(before) + len(mark), after[:_DIGITS].decode("ascii", "replace")
