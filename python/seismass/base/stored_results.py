"""Results kept in a folder, read again only as they were written."""

from __future__ import annotations

import hashlib
import os
import re
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final

import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.files import (
    PREFIX,
    is_left_behind,
    is_temporary,
    open_regular,
    polars_writing,
    read_file,
    read_table,
    reported_as,
    temporary_folder,
    temporary_name,
    written_whole,
)
from seismass.base.values import refusal

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
    sha256 = hashlib.sha256()
    left = start
    while left and (chunk := file.read(min(_CHUNK, left))):
        sha256.update(chunk)
        left -= len(chunk)
    sha256.update(before + mark + _ZEROS + after[_DIGITS:])
    return sha256.hexdigest(), start + len(before) + len(mark), after[:_DIGITS].decode("ascii", "replace")


_INPUTS: Final = "inputs"
_OWNER: Final = "owner"
_PART: Final = re.compile(r"part-[a-z0-9-]+\.parquet")
_MOST_BYTES: Final = 4096
"""Size of the two small files, at most (bytes)."""


@dataclass(frozen=True)
class StoredResults:
    """Tables that are made once for the same inputs, however often the work is interrupted. `sha256` is the digest of
    the inputs, `folder` is hidden (None: nothing is kept), `place` is the one that errors name.
    """

    folder: Path | None = None
    sha256: str = ""
    place: Path | None = None

    def of(self, name: str, make: Callable[[], pl.DataFrame]) -> pl.DataFrame:
        """Return the table of this name as it was kept, or make and keep it."""
        if self.folder is None:
            return make()
        path = self._path(name)
        if self._is_kept(name):
            return read_checked(path)
        made = make()
        self._keep(name, made)
        return made

    def file(self, name: str, make: Callable[[], pl.DataFrame]) -> Path:
        """Return the path of the kept table of this name, which is made where it is missing or damaged."""
        if not self._is_kept(name):
            self._keep(name, make())
        return self._path(name)

    def _path(self, name: str) -> Path:
        assert self.folder is not None
        return self.folder / f"part-{name}.parquet"

    def _is_kept(self, name: str) -> bool:
        path = self._path(name)
        metadata = self._metadata(name)
        return damage(path) is None and metadata.items() <= metadata_of(path).items()

    def _keep(self, name: str, table: pl.DataFrame) -> None:
        path = self._path(name)
        with reported_as(self.place or path), written_whole(path, durable=True) as temporary:
            write_checked(table, temporary, self._metadata(name))

    def _metadata(self, name: str) -> dict[str, str]:
        return {"inputs": self.sha256, "part": name}


NOTHING_STORED: Final = StoredResults()
"""Results are computed each time, and none is stored."""


@contextmanager
def result_store(place: Path, name: str, sha256: str) -> Iterator[StoredResults]:
    """Give a folder for parts of a result, removed at the end of the work: a temporary one while another process may
    work on the same. Parts of other digests are removed, but never files of another origin.
    """
    folder = place / f"{PREFIX}kept-{hashlib.sha256(os.fsencode(name)).hexdigest()[:16]}"
    with reported_as(place), suppress(FileExistsError):
        folder.mkdir(mode=0o700)
    identity = _checked(folder)
    if not _claimed(folder):
        with temporary_folder(place) as private:
            yield StoredResults(private, sha256, place)
        return
    # A copy of a folder, as of an archive, has another number than the one that was made here.
    inputs = f"{sha256} {identity}"
    try:
        if _read(folder / _INPUTS) != inputs:
            _remove_ours(folder, identity, but=(_OWNER,))
            with written_whole(folder / _INPUTS) as temporary:
                temporary.write_text(inputs, encoding="ascii")
        yield StoredResults(folder, sha256, place)
    except BaseException:
        if {path.name for path in folder.iterdir()} <= {_INPUTS, _OWNER}:
            _remove_ours(folder, identity)
        else:
            _remove_ours(folder, identity, only=(_OWNER,))
        raise
    _remove_ours(folder, identity)


def _checked(folder: Path) -> int:
    """Return the number of a folder in its file system; refuse links, files, and folders that others may write to."""
    status = folder.lstat()
    is_link = stat.S_ISLNK(status.st_mode)
    # Windows has no such users and modes.
    users = hasattr(os, "geteuid")
    if is_link or not stat.S_ISDIR(status.st_mode):
        got = "a link" if is_link else "a file"
    elif users and status.st_uid != os.geteuid():
        got = f"one of user {status.st_uid}"
    elif users and status.st_mode & 0o022:
        got = f"one that others may write to (mode {stat.S_IMODE(status.st_mode):o})"
    else:
        return status.st_ino
    requirement = "a folder that this user made and others cannot write to (remove it, or write elsewhere)"
    raise refusal(InvalidOption, f"hidden folder {folder}", "kept parts", requirement, got)


def _read(path: Path) -> str:
    """Text of a small file of the folder; empty where there is none that can be read."""
    try:
        return read_file(path, _MOST_BYTES, follow=False).decode("ascii", "replace")
    except OSError:
        return ""


def _claimed(folder: Path) -> bool:
    """Take a folder for this process, unless another one has it."""
    owner = folder / _OWNER
    if os.path.lexists(owner):
        if not is_left_behind(_read(owner)):
            return False
        owner.unlink(missing_ok=True)
    try:
        with owner.open("x", encoding="ascii") as file:
            file.write(temporary_name())
    except FileExistsError:
        return False
    return True


def _remove_ours(
    folder: Path, identity: int, *, but: tuple[str, ...] = (), only: tuple[str, ...] | None = None
) -> None:
    """Remove files of this module from the folder that was checked, and the folder where it is empty then."""
    if os.unlink not in os.supports_dir_fd or os.scandir not in os.supports_fd:  # Windows
        for path in folder.iterdir():
            if _is_ours(path.name, but, only):
                with suppress(OSError):
                    path.unlink()
    else:
        # By its descriptor: another folder that takes the name meanwhile is not touched.
        with suppress(OSError):
            descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
            try:
                if os.fstat(descriptor).st_ino == identity:
                    with os.scandir(descriptor) as entries:
                        names = [entry.name for entry in entries if _is_ours(entry.name, but, only)]
                    for name in names:
                        with suppress(OSError):
                            os.unlink(name, dir_fd=descriptor)
            finally:
                os.close(descriptor)
    if not but and only is None:
        with suppress(OSError):
            folder.rmdir()


def _is_ours(name: str, but: tuple[str, ...], only: tuple[str, ...] | None) -> bool:
    if only is not None:
        return name in only
    known = name in (_INPUTS, _OWNER) or _PART.fullmatch(name) is not None or is_temporary(name)
    return known and name not in but
