"""Temporary files: named after their process, removed when that is gone, and never seen under their own name."""

from __future__ import annotations

import errno
import signal
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import BinaryIO

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.base.files import (
    PREFIX,
    Directory,
    polars_writing,
    remove_left_behind,
    temporary_folder,
    temporary_name,
    write_file,
)

GRID = sm.Grid.product(sm.Building.uniform(1, 0.3), mass_ratio=1.0, mu=np.linspace(0.1, 0.5, 50))
MOTION = sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1)

KILLED = """
    import os, signal, sys
    import numpy as np
    import seismass as sm
    grid = sm.Grid.product(sm.Building.uniform(1, 0.3), mass_ratio=1.0, mu=np.linspace(0.1, 0.5, 50))
    def kill(done, total):
        if done >= 20:
            os.kill(os.getpid(), signal.SIGKILL)
    sm.write_many(sys.argv[1], grid, sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1), chunk=10, progress=kill)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the start of a process is read from /proc")
def test_what_a_killed_run_leaves_is_removed_by_the_next(tmp_path: Path) -> None:
    path = tmp_path / "rows.parquet"
    command = [sys.executable, "-c", textwrap.dedent(KILLED), str(path)]
    child = subprocess.run(command, check=False, timeout=120)
    assert child.returncode == -signal.SIGKILL
    left = sorted(tmp_path.iterdir())
    assert [file.is_dir() for file in left] == [True], left  # the chunks
    sm.write_many(path, GRID, MOTION)
    assert list(tmp_path.iterdir()) == [path]


def named(path: Path, **changes: str) -> Path:
    """A temporary path, with parts of its name changed."""
    parts = dict(zip(("machine", "boot", "process", "started"), path.name[len(PREFIX) :].split("-"), strict=False))
    rest = path.name.rpartition("-")[2]
    return path.with_name(PREFIX + "-".join((parts | changes).values()) + "-" + rest)


@pytest.mark.skipif(sys.platform != "linux", reason="the start of a process is read from /proc")
def test_only_processes_of_this_machine_that_are_gone_are_judged(tmp_path: Path) -> None:
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    gone = [
        named(tmp_path / temporary_name(), process=str(ended.pid)),
        named(tmp_path / temporary_name(), started="1"),  # the number of the process was used again
        named(tmp_path / temporary_name(), boot="0123abcd"),  # the machine was started again
    ]
    kept = [
        tmp_path / temporary_name(),
        named(tmp_path / temporary_name(), process="1", started="0"),  # alive, its start not known
        named(tmp_path / temporary_name(), machine="0123456789ab", process=str(ended.pid)),
        tmp_path / f"{PREFIX}0123456789abcdef0123456789abcdef.part",
        tmp_path / f"{PREFIX}notes.txt",
    ]
    for path in (*gone, *kept):
        path.write_text("")
    with Directory(tmp_path) as folder:
        remove_left_behind(folder)
    assert sorted(tmp_path.iterdir()) == sorted(kept)


def test_two_runs_in_one_folder_do_not_disturb_each_other(tmp_path: Path) -> None:
    def write(file: BinaryIO) -> None:
        file.write(b"a")
        write_file(tmp_path / "c.txt", "c")
        file.write(b"b")

    with temporary_folder(tmp_path) as folder:
        write_file("part", "b", folder=folder)
        write_file(tmp_path / "a.txt", write)
        assert (folder.path / "part").read_text() == "b"
    assert {file.name: file.read_text() for file in tmp_path.iterdir()} == {"a.txt": "ab", "c.txt": "c"}


def test_a_missing_folder_is_reported_under_its_own_name(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError) as raised:
        sm.write_many(tmp_path / "missing" / "rows.parquet", GRID, MOTION)
    assert raised.value.filename == str(tmp_path / "missing")
    assert PREFIX not in str(raised.value)
    (tmp_path / "file").write_text("")
    with pytest.raises(NotADirectoryError) as refused:
        sm.write_many(tmp_path / "file" / "rows.parquet", GRID, MOTION)
    assert PREFIX not in str(refused.value)


def test_polars_says_that_a_disk_is_full_as_the_system_does(tmp_path: Path) -> None:
    path = tmp_path / "rows.parquet"
    for said, number in (("No space left on device (os error 28)", errno.ENOSPC), ("transport error", errno.EIO)):

        def write(file: BinaryIO, said: str = said) -> None:
            with polars_writing():
                raise pl.exceptions.ComputeError(said)

        with pytest.raises(OSError, match=r"rows\.parquet") as raised:
            write_file(path, write)
        assert raised.value.errno == number
        assert number != errno.EIO or said in str(raised.value)
    assert list(tmp_path.iterdir()) == []


REFUSED = """
    import resource, sys
    import numpy as np
    import seismass as sm
    grid = sm.Grid.product(sm.Building.uniform(1, 0.3), mass_ratio=1.0, mu=np.linspace(0.1, 0.5, 5000))
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
    try:
        sm.write_many(sys.argv[1], grid, sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1), chunk=int(sys.argv[2]))
    except OSError as error:
        print(error.errno)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the system refuses to write more, as a full disk does")
@pytest.mark.parametrize("chunk", [5000, 20], ids=["a chunk", "the whole"])
def test_what_the_system_does_not_write_is_its_own_error(tmp_path: Path, chunk: int) -> None:
    command = [sys.executable, "-c", textwrap.dedent(REFUSED), str(tmp_path / "rows.parquet"), str(chunk)]
    child = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    # Of the last words of a Parquet file Polars says only that they were not written.
    assert child.stdout in (f"{errno.EFBIG}\n", f"{errno.EIO}\n"), child.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["rows.csv", "rows", "rows.parquet.gz"])
def test_no_parquet_is_written_under_another_suffix(tmp_path: Path, name: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=r"path of batch must be one with the suffix \.parquet"):
        sm.write_many(tmp_path / name, GRID, MOTION)
    assert list(tmp_path.iterdir()) == []
