"""Writing files whole: under a temporary name beside the target, then renamed, so that no half file is ever seen."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal
from uuid import uuid4

import polars as pl


@contextmanager
def written_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a temporary path to write to, which replaces `path` at the end, or is removed when an error is raised.

    Parameters
    ----------
    path : path-like
        The file to write; its folder must exist.

    Raises
    ------
    OSError
        The path is a folder, or its folder is missing or cannot be written to; before anything is written.

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
    temporary = target.with_name(f".seismass-{uuid4().hex}.part")
    # Fails here, with the system's reason, where the folder is missing or cannot be written.
    temporary.open("xb").close()
    try:
        yield temporary
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


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
