"""One writer: files and folders appear as a whole or not at all, whatever happens and whoever shares their place."""

from __future__ import annotations

import ast
import contextlib
import json
import os
import random
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import pytest

import seismass as sm
from seismass.base.files import PREFIX, write_file
from seismass.base.folders import FILES, check_out, list_sha256, read_folder, write_folder

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="names are exchanged at once on Linux alone")

PACKAGE = Path(sm.__file__).parent
WRITER = ("base/files.py", "base/folders.py", "base/stored_results.py")
"""Where folders and files are made, renamed and removed."""
WRITES = "write_text write_bytes touch unlink rmdir symlink_to hardlink_to link symlink fdopen rmtree copyfile"
TO_A_FILE = "savefig write_parquet write_csv sink_parquet sink_csv save dump tofile imsave"
OPEN = ("file", "buffer", "written", "stream")
"""Names of what is open already, and thus may be written to."""


def opens_to_write(node: ast.Call) -> bool:
    """Whether a call makes, changes or removes a file by its name."""
    name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
    texts = [str(each.value) for each in [*node.args, *(each.value for each in node.keywords)] if is_text(each)]
    if name == "open":
        return any(re.fullmatch(r"[rbt]*[wax+][wabt+]*", text) for text in texts) or ast.unparse(node.func) == "os.open"
    if name in TO_A_FILE.split():
        return bool(node.args) and ast.unparse(node.args[0]) not in OPEN
    on_tempfile = ast.unparse(node.func).startswith("tempfile.") and name != "gettempdir"
    return name in WRITES.split() or on_tempfile or ast.unparse(node.func) in ("os.rename", "os.replace", "os.remove")


def is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def test_nothing_else_in_the_package_opens_a_file_for_writing() -> None:
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        place = path.relative_to(PACKAGE).as_posix()
        if place in WRITER or place.startswith("data/"):
            continue
        calls = (node for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call))
        found += [f"{place}: {ast.unparse(node)}" for node in calls if opens_to_write(node)]
    assert found == ["cli.py: os.open(os.devnull, os.O_WRONLY)"], "write_file and write_folder write"


@pytest.mark.parametrize(
    "planted",
    [
        *('open(path, "w")', 'path.open(mode="r+b")', "path.write_text(text)", "os.open(path, os.O_WRONLY)"),
        *("frame.write_csv(path)", "figure.savefig(path)", "tempfile.mkdtemp()", "os.replace(a, b)", "path.unlink()"),
    ],
)
def test_a_planted_writer_is_found(planted: str) -> None:
    assert opens_to_write(ast.parse(planted, mode="eval").body)  # type: ignore[arg-type]


def temporary(folder: Path) -> Path:
    """What is being written in a folder."""
    (path,) = (path for path in folder.iterdir() if path.name.startswith(PREFIX))
    return path


@pytest.fixture
def victim(tmp_path: Path) -> Path:
    """A file of mode 600 outside the share."""
    path = tmp_path / "outside" / "secret"
    path.parent.mkdir()
    path.write_text("secret")
    path.chmod(0o600)
    return path


@pytest.fixture
def share(tmp_path: Path) -> Path:
    """A folder that everybody may write to, without a sticky bit."""
    path = tmp_path / "share"
    path.mkdir()
    path.chmod(0o777)
    return path


def test_a_link_in_place_of_the_temporary_file_overwrites_nothing(share: Path, victim: Path) -> None:
    """As another user of the folder makes it while the file is written."""

    def write(file: BinaryIO) -> None:
        file.write(b"one")
        path = temporary(share)
        path.unlink()
        path.symlink_to(victim)
        file.write(b"two")

    with pytest.raises(PermissionError, match=r"replaced while it was written: .*x\.png"):
        write_file(share / "x.png", write)
    assert victim.read_text() == "secret"
    assert list(share.iterdir()) == []


def test_a_link_in_place_of_the_temporary_folder_leads_nowhere(share: Path, victim: Path) -> None:
    def replace(file: BinaryIO) -> None:
        path = temporary(share)
        path.rename(share / "taken")
        path.symlink_to(victim.parent)

    with pytest.raises(PermissionError, match="replaced while it was written"):
        write_folder(share / "out", {"a": replace, "secret": "b"})
    assert victim.read_text() == "secret"
    assert {path.name for path in victim.parent.iterdir()} == {"secret"}
    assert not (share / "out").exists()


@pytest.mark.parametrize("mode", [0o777, 0o1777])
def test_races_for_the_temporary_name_overwrite_nothing(mode: int, share: Path, victim: Path) -> None:
    """One who replaces every temporary entry by a link as soon as it is seen, in a plain and in a sticky folder."""
    share.chmod(mode)
    ended = threading.Event()
    replaced = 0

    def attack() -> None:
        nonlocal replaced
        while not ended.is_set():
            for path in share.iterdir():
                if path.name.startswith(PREFIX) and not path.is_symlink():
                    with contextlib.suppress(OSError):
                        path.rename(share / f"taken{replaced}")
                        path.symlink_to(victim if replaced % 2 else victim.parent)
                        replaced += 1

    def slowly(file: BinaryIO) -> None:
        file.write(b"one")
        time.sleep(random.uniform(0.0, 0.002))
        file.write(b"two")

    thread = threading.Thread(target=attack)
    thread.start()
    try:
        for _ in range(100):
            with contextlib.suppress(OSError):
                write_file(share / "x.csv", slowly)
            with contextlib.suppress(OSError, sm.errors.InvalidOption):  # a link to a file is no folder
                write_folder(share / "out", {"secret": slowly})
    finally:
        ended.set()
        thread.join()
    assert replaced > 20, "no race"
    assert victim.read_text() == "secret"
    assert [path.name for path in victim.parent.iterdir()] == ["secret"]


LOOP = """
    import sys
    from pathlib import Path
    from seismass.base.folders import write_folder
    out, first = Path(sys.argv[1]), int(sys.argv[2])
    print("ready", flush=True)
    for run in range(first, 10**9):
        write_folder(out, dict.fromkeys(("page", "table", "list"), f"{run:09d}" * 3000), earlier=lambda _: True)
"""


def runs_in(out: Path) -> set[str]:
    """The runs of which files of a folder are; each must be whole and as its list says."""
    read = read_folder(out, ("page", "table", "list"))
    contents = read.contents
    assert read.edited == ()
    assert set(contents) == {"page", "table", "list"}
    assert all(content == content[:9] * 3000 for content in contents.values())
    return {content[:9].decode() for content in contents.values()}


def looping(out: Path, first: int) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", textwrap.dedent(LOOP), str(out), str(first)]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    with child.stdout:
        assert child.stdout.readline() == "ready\n"
    return child


def test_a_killed_writer_leaves_one_run_or_the_other(tmp_path: Path) -> None:
    out, chooser = tmp_path / "out", random.Random(4)
    write_folder(out, dict.fromkeys(("page", "table", "list"), "0" * 27000))
    (out / "notes.txt").write_text("mine")
    for number in range(15):
        child = looping(out, number)
        time.sleep(chooser.uniform(0.0, 0.05))
        child.send_signal((signal.SIGKILL, signal.SIGTERM, signal.SIGHUP)[number % 3])
        child.wait()
        assert len(runs_in(out)) == 1
        assert (out / "notes.txt").read_text() == "mine"
    write_folder(out, {"page": "new"})
    assert {path.name for path in tmp_path.iterdir()} == {"out"}, "what killed ones have left is removed"


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_signal_that_ends_a_command_leaves_nothing(tmp_path: Path, number: signal.Signals) -> None:
    """While a study is solved; what it has solved is kept, hidden, for the next call."""
    program = "import sys; from seismass.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "study", "--effective", "--out", str(tmp_path / "out")]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    until = time.monotonic() + 120.0
    while not any(tmp_path.iterdir()) and time.monotonic() < until:
        time.sleep(0.05)
    child.send_signal(number)
    _, said = child.communicate(timeout=120)
    assert (child.returncode, said) == (130, "seismass: interrupted\n")
    assert not (tmp_path / "out").exists()
    assert all(path.name.startswith(f"{PREFIX}kept-") for path in tmp_path.iterdir())


def test_two_writers_of_one_folder_at_the_same_time(tmp_path: Path) -> None:
    out = tmp_path / "out"
    write_folder(out, dict.fromkeys(("page", "table", "list"), "0" * 27000))
    (out / "notes.txt").write_text("mine")
    children = [looping(out, first) for first in (0, 10**8)]
    until = time.monotonic() + 2.0
    seen: set[str] = set()
    while time.monotonic() < until:
        seen |= runs_in(out)
    assert len({run[:1] for run in seen}) == 2, "both have written"
    for child in children:
        assert child.poll() is None
        child.kill()
        child.wait()
    assert len(runs_in(out)) == 1
    assert (out / "notes.txt").read_text() == "mine"


def test_what_others_have_in_the_folder_stays(tmp_path: Path) -> None:
    out = tmp_path / "out"
    write_folder(out, {"page": "1", "figure": "1", "edited": "1", "other": "1"}, earlier=lambda name: name != "other")
    (out / "edited").write_text("mine")
    (out / "notes").mkdir(mode=0o750)
    (out / "notes" / "deep").mkdir()
    (out / "notes" / "deep" / "a").write_text("a")
    (out / "link").symlink_to("nowhere")
    out.chmod(0o2751)
    before = (out / "notes" / "deep" / "a").stat().st_ino
    write_folder(out, {"page": "2"}, earlier=lambda name: name != "other")
    names = {path.name for path in out.iterdir()}
    assert names == {"page", "edited", "other", "notes", "link", FILES}, "figure was of the earlier call"
    assert (out / "edited").read_text() == "mine"
    assert (out / "notes" / "deep" / "a").stat().st_ino == before
    assert (out / "link").readlink() == Path("nowhere")
    assert (out.stat().st_mode & 0o7777, (out / "notes").stat().st_mode & 0o777) == (0o2751, 0o750)
    listed = json.loads((out / FILES).read_text())
    assert set(listed["sha256"]) == {"page", "other"}, "intact files of an earlier call are listed further on"
    assert listed["sha256_of_list"] == list_sha256(listed["sha256"])
    assert {path.name for path in tmp_path.iterdir()} == {"out"}


def test_a_folder_behind_a_link_is_swapped_and_the_link_stays(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "out").symlink_to("real")
    write_folder(tmp_path / "out", {"page": "1"})
    assert (tmp_path / "out").is_symlink()
    assert (tmp_path / "real" / "page").read_text() == "1"


def test_folders_that_cannot_be_swapped_are_refused_before_anything_is_solved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for out in (Path(), Path(".."), tmp_path, Path("/proc")):
        with pytest.raises(sm.errors.InvalidOption, match=r"out of test must be a folder that .*; got"):
            check_out(out, "test")
        with pytest.raises(sm.errors.InvalidOption, match="out of results must be"):
            write_folder(out, {"page": "1"})
    check_out(Path("new/deep"), "test")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="another user is asked")
def test_a_file_of_another_user_in_a_sticky_folder_stops_the_whole(tmp_path: Path) -> None:
    """Its rename failed when everything else was in place; now nothing is changed and the file is named."""
    out = tmp_path / "out"
    write_folder(out, {"page": "1", "table": "1"})
    for path in (tmp_path, out):
        path.chmod(0o1777)
    path = tmp_path
    modes = []
    while path != path.parent:  # that the other user may come here
        modes.append((path, path.stat().st_mode))
        path.chmod(path.stat().st_mode | 0o011)
        path = path.parent
    os.seteuid(65534)
    try:
        with pytest.raises(OSError, match=re.escape(str(out))):
            write_folder(out, {"page": "2", "new": "2"})
    finally:
        os.seteuid(0)
        for path, mode in modes:
            path.chmod(mode)
    assert read_folder(out, ("page", "table")).contents == {"page": b"1", "table": b"1"}
    assert {path.name for path in tmp_path.iterdir()} == {"out"}


@pytest.mark.parametrize("stop", [OSError(28, "No space left on device"), KeyboardInterrupt(), RuntimeError()])
def test_an_error_in_the_middle_changes_nothing(tmp_path: Path, stop: BaseException) -> None:
    out = tmp_path / "out"
    write_folder(out, {"page": "1"})

    def fail(file: BinaryIO) -> None:
        file.write(b"half")
        raise stop

    writers: list[Callable[[], object]] = [
        lambda: write_folder(out, {"page": "2", "table": fail}),
        lambda: write_folder(tmp_path / "new", {"page": "2", "table": fail}),
        lambda: write_file(out / "page", fail),
    ]
    for write in writers:
        with pytest.raises(type(stop)) as raised:
            write()
        assert PREFIX not in str(raised.value)
    assert read_folder(out, ("page",)).contents == {"page": b"1"}
    assert {path.name for path in tmp_path.iterdir()} == {"out"}
    assert {path.name for path in out.iterdir()} == {"page", FILES}
