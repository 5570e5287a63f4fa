"""Files and folders: read within limits, written whole, temporary ones removed whatever happens."""

from __future__ import annotations

import contextlib
import csv
import errno
import hashlib
import os
import platform
import re
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from io import BufferedReader
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal
from uuid import uuid4

from seismass.base.errors import RecordFormatError

if TYPE_CHECKING:
    import polars as pl

PREFIX: Final = ".seismass-"
"""Beginning of every temporary name."""

_NAME = re.compile(
    re.escape(PREFIX)
    + r"(?P<machine>[0-9a-f]{12})-(?P<boot>[0-9a-f]{8})-(?P<process>\d+)-(?P<started>\d+)-[0-9a-f]{32}\.part"
)


def data_directory() -> Path:
    """Return the folder of the stored data: inside an installed package, or at the top of the source tree."""
    package = Path(__file__).parents[1]
    tree = package.parents[1]
    # In the source tree a development build leaves a copy in the package, which the files themselves outdate. The
    # folder above an installed package may be a project too, and not this one.
    place = (tree if (tree / "crates" / "seismass").is_dir() else package) / "data"
    if not (place / "synthetic" / "suite.csv").is_file():
        raise RecordFormatError(f"built-in suite must be in {place}, as it was installed; got no suite.csv there")
    return place


def stored_rows(name: str) -> list[dict[str, str]]:
    """Return the rows of a table in data/tables, as texts by column."""
    text = (data_directory() / "tables" / f"{name}.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()))


def temporary_path(folder: Path) -> Path:
    """Return an unused path in a folder, named after this process; what killed processes have left there is removed."""
    remove_left_behind(folder)
    return folder / temporary_name()


def temporary_name() -> str:
    """Return an unused name that contains the number of this process."""
    process = os.getpid()
    return f"{PREFIX}{_machine()}-{_boot()}-{process}-{_started(process) or 0}-{uuid4().hex}.part"


def is_temporary(name: str) -> bool:
    """Return whether a name is one of this module."""
    return _NAME.fullmatch(name) is not None


def is_left_behind(name: str) -> bool:
    """Return whether a temporary name belongs to a process of this machine that has ended."""
    named = _NAME.fullmatch(name)
    return named is not None and _is_gone(named["machine"], named["boot"], int(named["process"]), int(named["started"]))


@contextmanager
def temporary_folder(folder: Path) -> Iterator[Path]:
    """Give a folder in `folder`, which is removed with its content at the end."""
    path = temporary_path(folder)
    with reported_as(folder):
        path.mkdir(mode=0o700)
    try:
        yield path
    finally:
        shutil.rmtree(path, ignore_errors=True)


def remove_left_behind(folder: Path) -> None:
    """Remove what ended processes of this machine and user have left in a folder; what cannot be removed stays. A link
    is removed and never followed.
    """
    with contextlib.suppress(OSError):
        for path in [path for path in folder.iterdir() if path.name.startswith(PREFIX)]:
            if is_left_behind(path.name) and _is_own(path):
                if path.is_dir() and not path.is_symlink():
                    shutil.rmtree(path, ignore_errors=True)
                else:
                    with contextlib.suppress(OSError):
                        path.unlink()


@contextmanager
def reported_as(path: Path) -> Iterator[None]:
    """Raise what the system refuses for a temporary name under the name that the user knows."""
    try:
        yield
    except OSError as error:
        if error.errno is None:
            raise
        missing = error.errno == errno.ENOENT and not path.parent.exists()
        raise OSError(error.errno, os.strerror(error.errno), str(path.parent if missing else path)) from None


def _is_own(path: Path) -> bool:
    """Whether this user has made what is there. Windows does not tell."""
    return not hasattr(os, "geteuid") or path.lstat().st_uid == os.geteuid()


def _is_gone(machine: str, boot: str, process: int, started: int) -> bool:
    """Whether a process of this machine has ended. One that cannot be judged counts as alive."""
    if machine != _machine():
        return False
    if boot != _boot():
        return True
    now = _started(process)
    if now is not None and started:
        return now != started
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    except OSError:
        return False
    return False


@cache
def _machine() -> str:
    """A name of the machine, or of the container on it, whose processes have numbers of their own."""
    known = [platform.node()]
    with contextlib.suppress(OSError):
        known.append(Path("/etc/machine-id").read_text(encoding="ascii", errors="replace").strip())
    with contextlib.suppress(OSError):
        known.append(str(Path("/proc/self/ns/pid").readlink()))
    return hashlib.sha256("\n".join(known).encode()).hexdigest()[:12]


@cache
def _boot() -> str:
    """A name of the present run of the machine; zeros where the system does not tell."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii", errors="replace")
    except OSError:
        return "0" * 8
    return hashlib.sha256(boot.encode()).hexdigest()[:8]


def _started(process: int) -> int | None:
    """When a process started, in ticks since the boot; None where there is no such process or it cannot be seen."""
    try:
        stat = Path(f"/proc/{process}/stat").read_text(errors="replace")
        # The name of the program, in brackets, may hold anything; the start is the 22nd field.
        return int(stat.rpartition(")")[2].split()[19])
    except (OSError, ValueError, IndexError):
        return None


_OS_ERROR = re.compile(r"\(os error (\d+)\)")
"""What Polars' own errors say of one of the system."""


MOST_BYTES: Final = 2**26
"""Largest input file that is read, unless a reader states another size (64 MiB)."""


def open_regular(path: str | os.PathLike[str], *, follow: bool = True) -> BufferedReader:
    """Open a regular file for reading; a folder, a device or a pipe is an error at once, and a link unless `follow`."""
    # Not blocking, as the opening of a pipe would wait for its writer.
    flags = os.O_RDONLY
    for name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY"):
        flags |= getattr(os, name, 0)
    if not follow:
        flags |= getattr(os, "O_NOFOLLOW", 0)
    descriptor = os.open(path, flags)
    try:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise OSError(errno.EINVAL, "no regular file", os.fspath(path))
        return os.fdopen(descriptor, "rb")
    except BaseException:
        os.close(descriptor)
        raise


def read_file(path: str | os.PathLike[str], most: int = MOST_BYTES, *, follow: bool = True) -> bytes:
    """Return the content of a regular file of at most `most` bytes."""
    with open_regular(path, follow=follow) as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise OSError(errno.EFBIG, f"larger than {_size_text(most)}", os.fspath(path))
    return content


def read_utf8(path: str | os.PathLike[str], most: int = MOST_BYTES) -> str:
    """Return the text of a regular UTF-8 file of at most `most` bytes, without a byte order mark and with line ends of
    Unix.
    """
    return read_file(path, most).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")


def read_table(path: str | os.PathLike[str], *, follow: bool = True) -> pl.DataFrame:
    """Return the table of a Parquet file of any name; Polars itself opens none whose name is not UTF-8."""
    import polars as pl

    try:
        with open_regular(path, follow=follow) as file:
            return pl.read_parquet(file)
    except pl.exceptions.PanicException as error:  # which is not an Exception
        raise pl.exceptions.ComputeError(f"a damaged Parquet file: {error}") from None


def _size_text(size: int) -> str:
    return f"{size // 2**20} MB" if size >= 2**20 else f"{size} bytes"


@contextmanager
def written_whole(path: str | os.PathLike[str], *, durable: bool = False, tidy: bool = True) -> Iterator[Path]:
    """Give a temporary path that replaces `path` at the end, or is removed on an error. `durable` waits for the disk;
    `tidy` first removes what killed runs left in the folder, which takes a listing of it.
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
    """Raise an error of Polars while writing, as on a full disk, as an OSError that names `path`, with the reason of
    the system where Polars passes it on.
    """
    from polars.exceptions import PolarsError

    try:
        yield
    except PolarsError as error:
        known = _OS_ERROR.search(str(error))
        code = int(known[1]) if known else errno.EIO
        reason = os.strerror(code) if known else f"{os.strerror(code)}: {error}"
        raise OSError(code, reason, str(path)) from error


def without_formulas(frame: pl.DataFrame) -> pl.DataFrame:
    """Return a frame for a CSV: a text that spreadsheets would run as a formula (not a number, begins with =, +, -, @
    or a control character) has an apostrophe before it.
    """
    import polars as pl

    def guarded(name: str) -> pl.Expr:
        text = pl.col(name)
        formula = text.str.contains(r"^[=+\-@\t\r\n]") & text.cast(pl.Float64, strict=False).is_null()
        return pl.when(formula).then("'" + text).otherwise(text).alias(name)

    return frame.with_columns(guarded(name) for name, kind in frame.schema.items() if kind == pl.String)


def write_table(
    frame: pl.DataFrame, kind: Literal["parquet", "csv"], path: Path, *, metadata: dict[str, str] | None = None
) -> None:
    """Write a frame to Parquet or CSV, where Polars opens no name that is not UTF-8. A CSV has no metadata."""
    with path.open("wb") as file:
        if kind == "csv":
            without_formulas(frame).write_csv(file)
        else:
            frame.write_parquet(file, metadata=metadata)
