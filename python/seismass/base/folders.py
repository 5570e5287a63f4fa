"""Folders of results: written beside their place, swapped in whole, and read as their list of digests says."""

from __future__ import annotations

import contextlib
import ctypes
import errno
import hashlib
import json
import os
import stat
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final
from uuid import uuid4

from seismass.base.errors import InvalidOption, SeismassError
from seismass.base.files import (
    Content,
    Directory,
    open_regular,
    put,
    read_file,
    remove_left_behind,
    reported_as,
    table_of,
    temporary_name,
)
from seismass.base.limits import MOST_RESULT
from seismass.base.values import refusal, short

if TYPE_CHECKING:
    import polars as pl

FILES: Final = "files.json"
"""File with the names and SHA-256 of what was written, and that of the list: a later call knows its own by it."""


def check_out(out: Path, owner: str) -> None:
    """Refuse a folder that cannot be written and swapped as a whole, before anything is solved."""
    existing = next((path for path in (out, *out.parents) if path.exists()), None)
    place = Path(os.path.realpath(out))
    if existing is not None and not (existing.is_dir() and os.access(existing, os.W_OK)):
        raise refusal(InvalidOption, "out", owner, "a folder that can be written to", str(out))
    if existing is not None and not (existing != out or os.access(place.parent, os.W_OK)):
        raise refusal(InvalidOption, "out", owner, "in a folder that can be written to", str(out))
    here = Path(os.path.realpath(os.curdir))
    if os.path.ismount(place) or place in (here, *here.parents):
        requirement = "a folder that can be replaced as a whole, not the current one, one above it or a mount point"
        raise refusal(InvalidOption, "out", owner, requirement, str(out))


def write_folder(
    out: Path, files: Mapping[str, Content], *, earlier: Callable[[str], bool] | None = None, owner: str = "results"
) -> list[Path]:
    """Write files and their list of digests to a folder that appears as a whole; on an error nothing is changed. Files
    of others stay. Those of an earlier call that `earlier` accepts and nobody changed do not.
    """
    check_out(out, owner)
    place = Path(os.path.realpath(out))
    for name in files:
        if (place / name).is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(out / name))
    place.parent.mkdir(parents=True, exist_ok=True)
    with reported_as(out), Directory(place.parent) as parent:
        remove_left_behind(parent)
        name = temporary_name()
        try:
            with parent.new_folder(name) as fresh:
                listed = {each: _written(fresh, each, content) for each, content in files.items()}
                _lock(parent)
                _swap_in(parent, name, fresh, place.name, listed, earlier)
        finally:
            parent.remove(name)
    return [out / each for each in (*files, FILES)]


def _written(folder: Directory, name: str, content: Content) -> str:
    """Write a file of a folder that nobody sees yet; its SHA-256."""
    with folder.new_file(name) as file:
        put(content, file)
        file.seek(0)
        return hashlib.file_digest(file, "sha256").hexdigest()


def _swap_in(
    parent: Directory,
    name: str,
    fresh: Directory,
    target: str,
    listed: dict[str, str],
    earlier: Callable[[str], bool] | None,
) -> None:
    """Give the fresh folder the name of the target, with what others have in it; what was there takes its name."""
    carried: dict[str, str] = {}
    with contextlib.ExitStack() as stack:
        old = None
        with contextlib.suppress(FileNotFoundError):
            old = stack.enter_context(Directory(parent.path / target, parent))
        if old is not None:
            before = _whole_list(old) or {}
            intact = {each for each, sha256 in before.items() if _sha256(old, each) == sha256}
            seen = old.names()
            for each in seen:
                if each in (*listed, FILES) or (each in intact and earlier is not None and earlier(each)):
                    continue
                _link(old, fresh, each)
                carried |= {each: before[each]} if each in intact else {}
        digests = carried | listed
        _written(fresh, FILES, json.dumps({"sha256": digests, "sha256_of_list": list_sha256(digests)}, indent=1) + "\n")
        _check_entry(parent, name, fresh, target)
        if old is None:
            parent.rename(name, target)
            try:
                _check_entry(parent, target, fresh, target)
            except PermissionError:
                parent.unlink(target)  # a link that came in between: the next call would follow it
                raise
            return
        status, made = old.status(), fresh.status()
        if (status.st_uid, status.st_gid) != (made.st_uid, made.st_gid):
            os.chown(fresh.itself, status.st_uid, status.st_gid)
        os.chmod(fresh.itself, stat.S_IMODE(status.st_mode))  # noqa: PTH101
        _exchange(parent, name, target)
        try:
            _check_entry(parent, target, fresh, target)
        except PermissionError:
            _exchange(parent, name, target)
            raise
        for each in set(old.names()) - set(seen):  # saved there meanwhile
            os.rename(old.named(each), fresh.named(each), src_dir_fd=old.inside, dst_dir_fd=fresh.inside)


def _check_entry(parent: Directory, name: str, fresh: Directory, target: str) -> None:
    """Refuse a name that is not that of the fresh folder."""
    if not os.path.samestat(parent.status(name), fresh.status()):
        raise PermissionError(errno.EPERM, "replaced while it was written", str(parent.path / target))


def _link(old: Directory, fresh: Directory, name: str) -> None:
    """Have an entry of a folder, whole, in another one too."""
    if not stat.S_ISDIR(old.status(name).st_mode):
        os.link(
            old.named(name), fresh.named(name), src_dir_fd=old.inside, dst_dir_fd=fresh.inside, follow_symlinks=False
        )
        return
    with Directory(old.path / name, old) as inner, fresh.new_folder(name) as copy:
        for each in inner.names():
            _link(inner, copy, each)
        os.chmod(copy.itself, stat.S_IMODE(inner.status().st_mode))  # noqa: PTH101


def _exchange(parent: Directory, name: str, target: str) -> None:
    """Exchange two names: at once on Linux, elsewhere by three renames."""
    try:
        exchanged = ctypes.CDLL(None, use_errno=True).renameat2(
            parent.inside, os.fsencode(name), parent.inside, os.fsencode(target), 2
        )
    except (AttributeError, TypeError, OSError):
        exchanged = -1
    if exchanged == 0:
        return
    # A name that nobody removes: what was there would else be lost where the process ends between the two.
    aside = f"{target}.before-{uuid4().hex[:8]}"
    parent.rename(target, aside)
    try:
        parent.rename(name, target)
    except BaseException:
        parent.rename(aside, target)
        raise
    parent.rename(aside, name)


def _lock(folder: Directory) -> None:
    """Wait for another process that swaps a folder in this one, until this one is closed; not for one that never ends,
    nor where the system has no such locks.
    """
    with contextlib.suppress(ImportError, OSError):
        import fcntl

        for _ in range(100):
            with contextlib.suppress(BlockingIOError):
                fcntl.flock(folder.inside or -1, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return
            time.sleep(0.1)


@dataclass(frozen=True)
class ReadFolder:
    """What was read of a folder: contents by name, and which differ from its files.json, and how."""

    path: Path
    contents: Mapping[str, bytes]
    edited: tuple[str, ...] = ()

    def __contains__(self, name: str) -> bool:
        return name in self.contents

    def document(self, name: str) -> dict[str, Any]:
        """Return a JSON document; one that is missing or none is refused."""
        if name not in self.contents:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(self.path / name))
        try:
            content = json.loads(self.contents[name])
        except (ValueError, RecursionError) as error:
            raise refusal(InvalidOption, "content", name, "JSON as seismass writes it", short(f"{error}")) from None
        if not isinstance(content, dict):
            raise refusal(InvalidOption, "content", name, "a JSON object", type(content).__name__)
        return content

    def table(self, name: str) -> pl.DataFrame:
        """Return a table; one that is missing or none is refused."""
        from polars.exceptions import PolarsError

        file = f"{name}.parquet"
        if file not in self.contents:
            document = next(iter(self.contents), "")
            raise refusal(InvalidOption, file, f"folder {self.path}", f"there beside {document}", "none")
        try:
            return table_of(self.contents[file])
        except PolarsError as error:
            raise refusal(InvalidOption, "content", file, "a Parquet table", short(f"{error}")) from None


def read_folder(folder: Path, names: Sequence[str], *, force: bool = False) -> ReadFolder:
    """Return the files of a folder of those that may be read, by name; what differs from its files.json is refused
    without `force`. The file by which the folder is known stands first in `names`.
    """
    contents: dict[str, bytes] = {}
    with Directory(folder) as place:
        for name in names:
            with contextlib.suppress(FileNotFoundError), reported_as(folder / name):
                contents[name] = read_file(name, MOST_RESULT, follow=False, folder=place)
        listed, has_list = _whole_list(place), FILES in place.names()
        is_there = os.path.samestat(place.status(), folder.stat())
    if not is_there:  # a run that ended meanwhile has put another one in its place
        return read_folder(folder, names, force=force)
    if names[0] not in contents:
        return ReadFolder(folder, {})  # what is said of a folder of another kind says more
    if listed is None:
        changes = [(FILES, "other content" if has_list else "none")]
    else:
        changes = [(name, "none") for name in names if name in listed and name not in contents]
        changes += [(name, "a file that files.json does not list") for name in contents if name not in listed]
        digests = {name: hashlib.sha256(content).hexdigest() for name, content in contents.items() if name in listed}
        changes += [(name, "other content") for name, sha256 in digests.items() if sha256 != listed[name]]
    if changes and not force:
        need = "as it was written, by the digests of files.json, or --force be given"
        raise refusal(InvalidOption, changes[0][0], f"folder {folder}", need, changes[0][1])
    return ReadFolder(folder, contents, tuple(f"{name} ({how})" for name, how in changes))


@contextmanager
def as_written(folder: Path) -> Iterator[None]:
    """Refuse a folder whose documents and tables do not fit together, whatever error they cause."""
    from polars.exceptions import PolarsError

    try:
        yield
    except SeismassError:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, RecursionError, PolarsError) as error:
        got = f"{type(error).__name__}: {error}"
        requirement = "with documents and tables as seismass wrote them"
        raise refusal(InvalidOption, f"folder {folder}", "report", requirement, short(got)) from None


def _whole_list(folder: Directory) -> dict[str, str] | None:
    """Digests by name of files.json; None where it is missing or not as it was written."""
    try:
        document = json.loads(read_file(FILES, follow=False, folder=folder))
        listed: dict[str, str] = document["sha256"]
        return listed if document["sha256_of_list"] == list_sha256(listed) else None
    except (OSError, ValueError, RecursionError, LookupError, TypeError):
        return None


def list_sha256(listed: Mapping[str, str]) -> str:
    """Return the digest of a list of digests by name."""
    return hashlib.sha256(json.dumps(listed, sort_keys=True).encode()).hexdigest()


def _sha256(folder: Directory, name: str) -> str | None:
    """Digest of a regular file, and no link; None where there is none."""
    try:
        with open_regular(name, follow=False, folder=folder) as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return None
