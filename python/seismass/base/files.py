"""Files: read within limits, written whole by descriptor, temporary ones removed whatever happens."""

from __future__ import annotations

import contextlib
import csv
import errno
import hashlib
import io
import os
import platform
import re
import shutil
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Final, Literal, Self, TypeAlias
from uuid import uuid4

from seismass.base.errors import RecordFormatError
from seismass.base.limits import MOST_BYTES

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


_BY_DESCRIPTOR: Final = {os.open, os.mkdir, os.rename, os.stat, os.unlink} <= os.supports_dir_fd


class Directory:
    """A folder held by its descriptor: whoever renames it, or puts a link in its place, changes nothing of what is done
    in it. Windows has no such calls; there it is held by its path. `parent` is the folder in which it is opened.
    """

    def __init__(self, path: Path, parent: Directory | None = None) -> None:
        self.path = path
        self._descriptor: int | None = None
        if _BY_DESCRIPTOR:
            flags = os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC
            if parent is None:
                self._descriptor = os.open(path, flags)
            else:
                self._descriptor = os.open(path.name, flags | os.O_NOFOLLOW, dir_fd=parent.inside)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Give the descriptor back."""
        if self._descriptor is not None:
            os.close(self._descriptor)

    def named(self, name: str) -> Path | str:
        """Return the name for a call that is given `inside`."""
        return name if _BY_DESCRIPTOR else self.path / name

    @property
    def inside(self) -> int | None:
        """What a call of the system takes as `dir_fd`."""
        return self._descriptor

    @property
    def itself(self) -> int | Path:
        """What a call of the system takes as the folder itself."""
        return self.path if self._descriptor is None else self._descriptor

    def status(self, name: str = "") -> os.stat_result:
        """Return what the system knows of an entry, no link followed; by default of the folder."""
        if not name:
            return os.stat(self.itself)  # noqa: PTH116
        return os.stat(self.named(name), dir_fd=self._descriptor, follow_symlinks=False)

    def names(self) -> list[str]:
        """Return the names in the folder."""
        return sorted(os.listdir(self.itself))  # noqa: PTH208

    def new_file(self, name: str) -> io.BufferedRandom:
        """Make a file that must not be there yet, and open it for writing and reading."""
        flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
        return os.fdopen(os.open(self.named(name), flags, 0o666, dir_fd=self._descriptor), "w+b")

    def new_folder(self, name: str, mode: int = 0o777) -> Directory:
        """Make a folder that must not be there yet, and open it; one that somebody else put in its place is refused."""
        os.mkdir(self.named(name), mode, dir_fd=self._descriptor)
        made = Directory(self.path / name, self)
        if _is_own(made.status()) and not made.names():
            return made
        made.close()
        raise PermissionError(errno.EPERM, "replaced while it was made", str(self.path / name))

    def rename(self, old: str, new: str) -> None:
        """Give an entry another name; a file that has it is replaced."""
        os.replace(self.named(old), self.named(new), src_dir_fd=self._descriptor, dst_dir_fd=self._descriptor)

    def unlink(self, name: str) -> None:
        """Remove a file or a link, where the system lets."""
        with contextlib.suppress(OSError):
            os.unlink(self.named(name), dir_fd=self._descriptor)

    def remove(self, name: str) -> None:
        """Remove a file, a link or a folder with its content, as far as the system lets."""
        self.unlink(name)
        with contextlib.suppress(OSError):
            shutil.rmtree(self.named(name), ignore_errors=True, dir_fd=self._descriptor)

    def synchronise(self) -> None:
        """Wait until the names are on the disk."""
        if self._descriptor is not None:
            os.fsync(self._descriptor)


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
def temporary_folder(place: Path) -> Iterator[Directory]:
    """Give a folder in `place` that others cannot read, which is removed with its content at the end; what killed
    processes have left there goes first.
    """
    with contextlib.ExitStack() as stack:
        with reported_as(place):
            outer = stack.enter_context(Directory(place))
            remove_left_behind(outer)
            name = temporary_name()
            inner = stack.enter_context(outer.new_folder(name, 0o700))
        try:
            yield inner
        finally:
            outer.remove(name)


def remove_left_behind(folder: Directory) -> None:
    """Remove what ended processes of this machine and user have left in a folder; what cannot be removed stays. A link
    is removed and never followed.
    """
    for name in folder.names():
        if name.startswith(PREFIX) and is_left_behind(name) and _is_own(folder.status(name)):
            folder.remove(name)


@contextmanager
def reported_as(path: Path) -> Iterator[None]:
    """Raise what the system refuses for a temporary name under the name that the user knows."""
    try:
        yield
    except OSError as error:
        if error.errno is None:
            raise
        missing = error.errno == errno.ENOENT and not path.parent.exists()
        raise OSError(error.errno, error.strerror, str(path.parent if missing else path)) from None


def _is_own(status: os.stat_result) -> bool:
    """Whether this user has made what is there. Windows does not tell."""
    return not hasattr(os, "geteuid") or status.st_uid == os.geteuid()


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


def open_regular(
    path: str | os.PathLike[str], *, follow: bool = True, folder: Directory | None = None
) -> io.BufferedReader:
    """Open a regular file for reading; a folder, a device or a pipe is an error at once, and a link unless `follow`.
    A name in `folder` is opened there.
    """
    # Not blocking, as the opening of a pipe would wait for its writer.
    flags = os.O_RDONLY
    for name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY"):
        flags |= getattr(os, name, 0)
    if not follow:
        flags |= getattr(os, "O_NOFOLLOW", 0)
    try:
        if folder is None:
            descriptor = os.open(path, flags)
        else:
            descriptor = os.open(folder.named(os.fspath(path)), flags, dir_fd=folder.inside)
    except OSError as error:
        if error.errno != errno.ELOOP or follow:
            raise
        raise OSError(errno.EINVAL, "no regular file", os.fspath(path)) from None
    try:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise OSError(errno.EINVAL, "no regular file", os.fspath(path))
        return os.fdopen(descriptor, "rb")
    except BaseException:
        os.close(descriptor)
        raise


def read_file(
    path: str | os.PathLike[str],
    most: int = MOST_BYTES,
    *,
    follow: bool = True,
    folder: Directory | None = None,
) -> bytes:
    """Return the content of a regular file of at most `most` bytes."""
    with open_regular(path, follow=follow, folder=folder) as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise OSError(errno.EFBIG, f"larger than {_size_text(most)}", os.fspath(path))
    return content


def decoded(content: bytes) -> str:
    """Return the text of a table, with line ends of Unix: Unicode where it is that, else Windows' Western or Turkish.
    Damaged Unicode is a `UnicodeDecodeError`.
    """
    wide = content[:2] in (b"\xff\xfe", b"\xfe\xff") or 5 * content[:400].count(0) > len(content[:400])
    little = content[:2] == b"\xff\xfe" or (content[:2] != b"\xfe\xff" and content[1:2] == b"\0")
    try:
        text = content.decode(("utf-16-le" if little else "utf-16-be") if wide else "utf-8-sig")
    except UnicodeDecodeError:
        if wide or content.startswith(b"\xef\xbb\xbf"):
            raise
        text = content.decode("cp1252", "replace")
        if re.search("[\u00dd\u00de\u00d0\u00fd\u00fe\u00f0]", text):  # Icelandic there, Turkish in Windows-1254
            text = content.decode("cp1254", "replace")
    return text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")


def read_utf8(path: str | os.PathLike[str], most: int = MOST_BYTES) -> str:
    """Return the text of a regular UTF-8 file of at most `most` bytes, without a byte order mark and with line ends of
    Unix.
    """
    return read_file(path, most).decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")


def table_of(source: bytes | BinaryIO) -> pl.DataFrame:
    """Return the table of a Parquet file that is open or read; Polars itself opens none whose name is not UTF-8."""
    import polars as pl

    try:
        return pl.read_parquet(source)
    except pl.exceptions.PanicException as error:  # which is not an Exception
        raise pl.exceptions.ComputeError(f"a damaged Parquet file: {error}") from None


def _size_text(size: int) -> str:
    return f"{size // 2**20} MB" if size >= 2**20 else f"{size} bytes"


Content: TypeAlias = str | bytes | Callable[[BinaryIO], object]
"""What is written: a text, bytes, or a function that writes to an open file."""


def put(content: Content, file: BinaryIO) -> None:
    """Write what a file is to hold, a text in UTF-8."""
    if callable(content):
        content(file)
    else:
        file.write(content.encode() if isinstance(content, str) else content)
    file.flush()


def check_files(*paths: Path | None) -> None:
    """Refuse files that cannot be written, as they are folders or theirs is missing, before anything is computed."""
    for path in paths:
        if path is not None and (not path.name or path.is_dir()):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        if path is not None and not path.parent.is_dir():
            code, reason = (errno.ENOTDIR, "No folder") if path.parent.exists() else (errno.ENOENT, "No such folder")
            raise OSError(code, reason, str(path.parent))


def write_file(
    path: str | os.PathLike[str], content: Content, *, durable: bool = False, folder: Directory | None = None
) -> Path:
    """Write a file that appears under its name when it is whole, and return its path; on an error what was there stays.
    `durable` waits for the disk. In a `folder` that is open, what killed runs left there is not looked for.
    """
    target = Path(path) if folder is None else folder.path / path
    check_files(target)
    with contextlib.ExitStack() as stack:
        stack.enter_context(reported_as(target))
        place = folder or stack.enter_context(Directory(target.parent))
        if folder is None:
            remove_left_behind(place)
        name = temporary_name()
        try:
            with place.new_file(name) as file:
                put(content, file)
                if durable:
                    os.fsync(file.fileno())
                if not os.path.samestat(place.status(name), os.fstat(file.fileno())):
                    raise PermissionError(errno.EPERM, "replaced while it was written", str(target))
            place.rename(name, target.name)
        except BaseException:
            place.remove(name)
            raise
        if durable:
            place.synchronise()
    return target


@contextmanager
def polars_writing() -> Iterator[None]:
    """Raise an error of Polars while writing, as on a full disk, as an OSError, with the reason of the system where
    Polars passes it on.
    """
    from polars.exceptions import PolarsError

    try:
        yield
    except PolarsError as error:
        known = _OS_ERROR.search(str(error))
        code = int(known[1]) if known else errno.EIO
        raise OSError(code, os.strerror(code) if known else f"{os.strerror(code)}: {error}") from error


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


def table_content(
    frame: pl.DataFrame, kind: Literal["parquet", "csv"], metadata: dict[str, str] | None = None
) -> Content:
    """Return what writes a frame as Parquet or CSV, which has no metadata."""

    def write(file: BinaryIO) -> None:
        with polars_writing():
            if kind == "csv":
                without_formulas(frame).write_csv(file)
            else:
                frame.write_parquet(file, metadata=metadata)

    return write
