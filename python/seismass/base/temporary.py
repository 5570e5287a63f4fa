"""Temporary files and folders whose names tell which process they belong to, so that those of killed runs are removed.

A name holds the machine, its boot, the process and when that started. What another machine has made on a shared file
system, or what was named in another way, is never judged.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import platform
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Final
from uuid import uuid4

PREFIX: Final = ".seismass-"
"""Beginning of every temporary name."""

_NAME = re.compile(
    re.escape(PREFIX)
    + r"(?P<machine>[0-9a-f]{12})-(?P<boot>[0-9a-f]{8})-(?P<process>\d+)-(?P<started>\d+)-[0-9a-f]{32}\.part"
)


def temporary_path(folder: Path) -> Path:
    """Return an unused path in a folder, named after this process; what killed processes have left there is removed."""
    remove_left_behind(folder)
    return folder / temporary_name()


def temporary_name() -> str:
    """Return an unused name that tells which process it belongs to: this one."""
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
