"""Writing files whole: under a temporary name beside the target, then renamed, so that no half file is ever seen."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

import polars as pl

from seismass.base.temporary import reported_as, temporary_name, temporary_path

_OS_ERROR = re.compile(r"\(os error (\d+)\)")
"""What Polars' own errors say of one of the system."""


@contextmanager
def written_whole(path: str | os.PathLike[str], *, durable: bool = False, tidy: bool = True) -> Iterator[Path]:
    """Give a temporary path to write to, which replaces `path` at the end, or is removed when an error is raised.

    Parameters
    ----------
    path : path-like
        The file to write; its folder must exist.
    durable : bool, default False
        Wait until the system has the file, and then its name, on the disk: neither is lost with the power.
    tidy : bool, default True
        Remove first what killed runs have left in the folder. Its files are listed for that, which one who writes many
        files to one folder does once, by `remove_left_behind`.

    Raises
    ------
    OSError
        The path is a folder, or its folder is missing or cannot be written to: before anything is written, and under
        the name that was given.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import mkdtemp
    >>> target = Path(mkdtemp(), "note.txt")
    >>> with written_whole(target) as temporary:
    ...     _ = temporary.write_text("whole")
    >>> target.read_text()
    'whole'
    """
    target = Path(path)
    if not target.name or target.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(target))
    # A name of its own, as one made of the target's could be too long.
    temporary = temporary_path(target.parent) if tidy else target.parent / temporary_name()
    # Fails here, with the system's reason, where the folder is missing or cannot be written.
    with reported_as(target):
        temporary.open("xb").close()
    try:
        yield temporary
        with reported_as(target):
            if durable:
                _synchronise(temporary)
            temporary.replace(target)
            if durable:
                _synchronise(target.parent)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _synchronise(path: Path) -> None:
    """Wait until a file, or the names in a folder, are on the disk. Windows opens no folders."""
    if path.is_dir() and os.name == "nt":
        return
    descriptor = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextmanager
def polars_writing(path: Path) -> Iterator[None]:
    """Raise what Polars says where the system writes no more, as on a full disk, as the error of the system.

    Raises
    ------
    OSError
        Under the name `path`, with the reason of the system where Polars passes it on, else as an error of input or
        output with what Polars says.
    """
    try:
        yield
    except pl.exceptions.PolarsError as error:
        known = _OS_ERROR.search(str(error))
        code = int(known[1]) if known else errno.EIO
        reason = os.strerror(code) if known else f"{os.strerror(code)}: {error}"
        raise OSError(code, reason, str(path)) from error


def write_table(
    frame: pl.DataFrame, kind: Literal["parquet", "csv"], path: Path, *, metadata: dict[str, str] | None = None
) -> None:
    """Write a frame to a file of any name; Polars itself opens none that is not UTF-8.

    Parameters
    ----------
    frame : polars.DataFrame
        The table.
    kind : {"parquet", "csv"}
        Format of the file.
    path : Path
        The file.
    metadata : dict of str to str, optional
        Key-value metadata of a Parquet file, for `polars.read_parquet_metadata`; a CSV has no place for it.

    Raises
    ------
    OSError
        The file cannot be written.
    """
    with path.open("wb") as file:
        if kind == "csv":
            frame.write_csv(file)
        else:
            frame.write_parquet(file, metadata=metadata)
