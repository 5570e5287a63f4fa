"""ZIP archives of records, as CESMD and PEER give them: unpacked into a temporary folder and read as one."""

from __future__ import annotations

import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.base.files import open_regular
from seismass.base.values import printable

MOST_MEMBERS: Final = 5000
"""Files of an archive; those of networks have some hundreds."""

LARGEST_UNPACKED: Final = 1024 * 1024 * 1024
"""Bytes of an archive, unpacked: five hundred records of 2 MB."""

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
    with tempfile.TemporaryDirectory(prefix="seismass-") as name:
        folder = Path(name)
        names: dict[Path, str] = {}
        try:
            with open_regular(path) as file, zipfile.ZipFile(file) as archive:
                members = [one for one in archive.infolist() if not one.is_dir() and not _is_hidden(one.filename)]
                _refuse_large(path, members)
                left = LARGEST_UNPACKED
                for number, member in enumerate(sorted(members, key=lambda one: one.filename)):
                    target = folder / f"{number:05d}" / _safe_name(member.filename)
                    target.parent.mkdir()
                    with archive.open(member) as packed:
                        content = packed.read(left + 1)
                    left -= len(content)
                    if left < 0:
                        raise RecordFormatError(
                            f"size of {path.name}, unpacked, must be at most {LARGEST_UNPACKED} bytes; got more"
                        )
                    target.write_bytes(content)
                    names[target] = member.filename
        except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, OSError) as error:
            raise RecordFormatError(f"content of {path.name} must be a sound ZIP archive; got: {error}") from error
        yield folder, names


def _is_hidden(name: str) -> bool:
    parts = PurePosixPath(name.replace("\\", "/")).parts
    return any(part.startswith((".", "__MACOSX")) and part != ".." for part in parts)


def _safe_name(name: str) -> str:
    """Return the last part of a name, without what a file system does not take."""
    last = printable(PurePosixPath(name.replace("\\", "/")).name)[-100:]
    return "".join(one if one.isalnum() or one in " -_.()+" else "_" for one in last) or "member"


def _refuse_large(path: Path, members: list[zipfile.ZipInfo]) -> None:
    if len(members) > MOST_MEMBERS:
        raise RecordFormatError(f"files of {path.name} must be at most {MOST_MEMBERS}; got {len(members)}")
    size = sum(member.file_size for member in members)
    if size > LARGEST_UNPACKED:
        raise RecordFormatError(f"size of {path.name}, unpacked, must be at most {LARGEST_UNPACKED} bytes; got {size}")
