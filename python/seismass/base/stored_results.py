"""One digest of inputs, and results kept in a folder under it, read again only as they were written."""

from __future__ import annotations

import dataclasses
import hashlib
import os
import re
import stat
import struct
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.base.errors import InvalidOption
from seismass.base.files import (
    PREFIX,
    Content,
    Directory,
    is_left_behind,
    is_temporary,
    open_regular,
    polars_writing,
    read_file,
    reported_as,
    table_of,
    temporary_folder,
    temporary_name,
    write_file,
)
from seismass.base.limits import MOST_FOOTER
from seismass.base.values import Value, refusal

LABELS: Final = frozenset({"file_sha256", "name", "note", "path", "project", "sources", "units"})
"""Fields that no number depends on: what something is called, which file and keys state it, and how it is shown."""


def inputs_digest(*inputs: Any) -> str:
    """Return the SHA-256 of values: numbers by all their bits, objects by all their fields but labels. 0.0 and -0.0 are
    equal. An object that has no fields is a TypeError.
    """
    digest = hashlib.sha256()
    for part in _parts(inputs):
        digest.update(part)
    return digest.hexdigest()


def motion_contents(motions: Iterable[Any]) -> list[tuple[Any, ...]]:
    """Return what numbers depend on of records or motions: time step and samples, the vertical ones too."""
    return [(motion.dt, motion.acceleration, motion.vertical) for motion in motions]


def fields_of(value: Any) -> dict[str, Any] | None:
    """Return the fields of an object of the package, except labels and what a `Value` derives; None of others."""
    if isinstance(value, type):
        return None
    if dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value)]
    elif type(value).__module__.startswith("seismass."):
        names = [name for kind in type(value).__mro__ for name in getattr(kind, "__slots__", ())]
    else:
        return None
    if isinstance(value, Value):
        names = [name for name in names if name[0] != "_"]
    return {name: getattr(value, name) for name in names if name not in LABELS}


def _parts(value: Any) -> Iterator[bytes]:
    """Yield the bytes of a value behind its kind and size, so that no two different values give the same bytes."""
    if isinstance(value, bool | np.bool_):
        yield b"b1" if value else b"b0"
    elif value is None:
        yield b"none"
    elif isinstance(value, int | np.integer):
        yield f"i{int(value)};".encode()
    elif isinstance(value, float | np.floating):
        yield b"f" + struct.pack("<d", float(value) + 0.0)
    elif isinstance(value, str | bytes):
        content = value.encode("utf-8", "surrogatepass") if isinstance(value, str) else value
        yield f"{type(value).__name__}{len(content)};".encode() + content
    elif isinstance(value, np.ndarray):
        array = value + 0.0 if value.dtype.kind == "f" else value
        array = np.ascontiguousarray(array, dtype=value.dtype.newbyteorder("<"))
        yield f"a{array.dtype.str}{value.shape};".encode() + array.tobytes()
    elif isinstance(value, Mapping):
        yield f"m{len(value)};".encode()
        for name in sorted(value):
            yield from _parts(name)
            yield from _parts(value[name])
    elif (fields := fields_of(value)) is not None:
        yield f"{type(value).__name__};".encode()
        yield from _parts(fields)
    elif isinstance(value, Iterable):
        items = list(value)
        yield f"l{len(items)};".encode()
        for item in items:
            yield from _parts(item)
    else:
        raise TypeError(f"no digest of a {type(value).__name__}")


def metadata_head(schema: int, *inputs: Any) -> dict[str, Any]:
    """What the metadata of a result begins with: versions, the instruction set, and the digest of inputs if any."""
    head = {"schema_version": schema, "package_version": _kernel.VERSION, "instructions": _kernel.instruction_set()}
    return head | ({"inputs_sha256": inputs_digest(*inputs)} if inputs else {})


_KEY: Final = "seismass.sha256"
_MARK: Final = b"sha256-of-this-file-with-zeros-here:"
_DIGITS: Final = 64
_ZEROS: Final = b"0" * _DIGITS
_TAIL: Final = 8
"""Bytes after the footer: its length, and PAR1."""
_CHUNK: Final = 2**20


def checked_content(frame: pl.DataFrame, metadata: dict[str, str]) -> Content:
    """Return what writes a frame to a Parquet file that carries a digest of itself, and further metadata."""

    def write(file: BinaryIO) -> None:
        with polars_writing():
            frame.write_parquet(file, compression="zstd", metadata={**metadata, _KEY: (_MARK + _ZEROS).decode()})
        digest, place, _ = _digest(file)
        file.seek(place)
        file.write(digest.encode())

    return write


def damage(path: Path, folder: Directory | None = None) -> str | None:
    """Return what is wrong with a file of `checked_content`; None where every byte is as written. A link, a folder and
    a device are never read.
    """
    try:
        mode = path.lstat().st_mode if folder is None else folder.status(path.name).st_mode
        for kind, name in ((stat.S_ISLNK, "a link"), (stat.S_ISDIR, "a folder")):
            if kind(mode):
                return f"is {name} and no file"
        with open_regular(path.name if folder else path, follow=False, folder=folder) as file:
            digest, _, stated = _digest(file)
    except OSError as error:
        return f"cannot be read: {error.strerror or error}"
    except ValueError as error:
        return str(error)
    return None if stated == digest else "is damaged: its bytes are not those of its digest"


def read_checked(path: Path) -> pl.DataFrame:
    """Return the table of a file that `damage` finds nothing wrong with."""
    with open_regular(path, follow=False) as file:
        return table_of(file)


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

    folder: Directory | None = None
    sha256: str = ""
    place: Path | None = None

    def of(self, name: str, make: Callable[[], pl.DataFrame]) -> pl.DataFrame:
        """Return the table of this name as it was kept, or make and keep it."""
        if self.folder is None:
            return make()
        table = self._stored(name)
        if table is None:
            table = make()
            self._keep(name, table)
        return table

    def file(self, name: str, make: Callable[[], pl.DataFrame]) -> Path:
        """Return the path of the kept table of this name, which is made where it is missing or damaged."""
        assert self.folder is not None
        if self._stored(name) is None:
            self._keep(name, make())
        return self.folder.path / _part(name)

    def _stored(self, name: str) -> pl.DataFrame | None:
        """The table of a part with the digest of its bytes and of these inputs; None where there is none."""
        assert self.folder is not None
        with suppress(OSError, ValueError, pl.exceptions.PolarsError), self._open(name) as file:
            digest, _, stated = _digest(file)
            file.seek(0)
            metadata = pl.read_parquet_metadata(file)
            file.seek(0)
            if digest == stated and self._metadata(name).items() <= metadata.items():
                return table_of(file)
        return None

    def _open(self, name: str) -> BinaryIO:
        return open_regular(_part(name), follow=False, folder=self.folder)

    def _keep(self, name: str, table: pl.DataFrame) -> None:
        assert self.folder is not None
        with reported_as(self.place or self.folder.path):
            content = checked_content(table, self._metadata(name))
            write_file(_part(name), content, durable=True, folder=self.folder)

    def _metadata(self, name: str) -> dict[str, str]:
        return {"inputs": self.sha256, "part": name}


def _part(name: str) -> str:
    return f"part-{name}.parquet"


NOTHING_STORED: Final = StoredResults()
"""Results are computed each time, and none is stored."""


@contextmanager
def result_store(place: Path, name: str, sha256: str) -> Iterator[StoredResults]:
    """Give a folder for parts of a result, removed at the end of the work: a temporary one while another process may
    work on the same. Parts of other digests are removed, but never files of another origin.
    """
    hidden = f"{PREFIX}kept-{hashlib.sha256(os.fsencode(name)).hexdigest()[:16]}"
    with ExitStack() as stack:
        with reported_as(place):
            outer = stack.enter_context(Directory(place))
            with suppress(FileExistsError):
                os.mkdir(outer.named(hidden), 0o700, dir_fd=outer.inside)
        folder = stack.enter_context(_checked(outer, hidden))
        if not _claimed(folder):
            yield StoredResults(stack.enter_context(temporary_folder(place)), sha256, place)
            return
        # A copy of a folder, as of an archive, has another number than the one that was made here.
        inputs = f"{sha256} {folder.status().st_ino}"
        try:
            if _read(folder, _INPUTS) != inputs:
                _remove_ours(folder, but=_OWNER)
                write_file(_INPUTS, inputs, folder=folder)
            yield StoredResults(folder, sha256, place)
        except BaseException:
            if set(folder.names()) <= {_INPUTS, _OWNER}:
                _remove_ours(folder)
            else:
                folder.unlink(_OWNER)
            raise
        else:
            _remove_ours(folder)
        finally:
            with suppress(OSError):
                os.rmdir(outer.named(hidden), dir_fd=outer.inside)


def _checked(outer: Directory, name: str) -> Directory:
    """Open a folder; refuse links, files, and folders that others may write to."""
    try:
        folder = Directory(outer.path / name, outer)
    except OSError:
        mode = outer.status(name).st_mode
        if stat.S_ISDIR(mode):
            raise
        got = "a link" if stat.S_ISLNK(mode) else "a file"
    else:
        status = folder.status()
        # Windows has no such users and modes.
        is_own = not hasattr(os, "geteuid") or status.st_uid == os.geteuid()
        if is_own and not (hasattr(os, "geteuid") and status.st_mode & 0o022):
            return folder
        folder.close()
        open_one = f"one that others may write to (mode {stat.S_IMODE(status.st_mode):o})"
        got = open_one if is_own else f"one of user {status.st_uid}"
    requirement = "a folder that this user made and others cannot write to (remove it, or write elsewhere)"
    raise refusal(InvalidOption, f"hidden folder {outer.path / name}", "kept parts", requirement, got)


def _read(folder: Directory, name: str) -> str:
    """Text of a small file of the folder; empty where there is none that can be read."""
    try:
        return read_file(name, _MOST_BYTES, follow=False, folder=folder).decode("ascii", "replace")
    except OSError:
        return ""


def _claimed(folder: Directory) -> bool:
    """Take a folder for this process, unless another one has it."""
    if _OWNER in folder.names():
        if not is_left_behind(_read(folder, _OWNER)):
            return False
        folder.unlink(_OWNER)
    try:
        with folder.new_file(_OWNER) as file:
            file.write(temporary_name().encode())
    except FileExistsError:
        return False
    except BaseException:  # as on a full disk: an empty file would count as that of a process that lives
        folder.unlink(_OWNER)
        raise
    return True


def _remove_ours(folder: Directory, *, but: str = "") -> None:
    """Remove the files of this module from a folder."""
    for name in folder.names():
        if name != but and (name in (_INPUTS, _OWNER) or _PART.fullmatch(name) or is_temporary(name)):
            folder.unlink(name)
