"""Folders that another person has prepared: their code does not run, and their links lead to no deleted file."""

from __future__ import annotations

import hashlib
import os
import pickle
import shutil
import stat
import subprocess
import sys
from pathlib import Path
from typing import Any

import polars as pl
import pytest

import seismass as sm
from seismass.base.files import PREFIX, Directory, remove_left_behind, temporary_name
from seismass.base.stored_results import result_store
from seismass.cli import main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="links, users and modes of POSIX")

SCENE = sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)])
MOTION = sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1)
TABLE = pl.DataFrame({"a": [1.0]})


def hidden(place: Path, name: str) -> Path:
    """The hidden folder of a result: anybody can compute its name."""
    return place / f"{PREFIX}kept-{hashlib.sha256(name.encode()).hexdigest()[:16]}"


class Bait:
    """What runs where it is unpickled."""

    def __init__(self, trace: Path) -> None:
        self.trace = trace

    def __reduce__(self) -> tuple[Any, ...]:
        return Path.touch, (self.trace,)


def test_no_pickle_of_a_folder_is_read(tmp_path: Path) -> None:
    trace, out = tmp_path / "trace", tmp_path / "out"
    folder = hidden(out, "study")
    folder.mkdir(parents=True, mode=0o700)
    digest = "0" * 64
    (folder / "inputs").write_text(f"{digest} {folder.stat().st_ino}")
    names = [
        f"{stem}.{kind}" for stem in ("runs", "part-runs", "part-effective-1", "0") for kind in ("pickle", "parquet")
    ]
    for name in [*names, "owner"]:
        (folder / name).write_bytes(pickle.dumps(Bait(trace)))
    with result_store(out, "study", digest) as kept:  # the owner is read, and is no name of a process that has ended
        kept.of("runs", lambda: TABLE)
    (folder / "owner").unlink()
    with result_store(out, "study", digest) as kept:
        for name in ("runs", "effective-1"):
            assert kept.of(name, lambda: TABLE).equals(TABLE)
    assert not trace.exists()
    pickle.loads(pickle.dumps(Bait(trace)))
    assert trace.exists()  # the bait does what it is made for


def test_no_module_of_the_package_reads_a_format_that_executes() -> None:
    root = Path(sm.__file__).parent
    words = ("pickle.load", "Unpickler", "marshal", "shelve", "joblib", "allow_pickle", " eval(", " exec(", "yaml")
    for path in root.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        for word in words:
            assert word not in text, (path.name, word)


def files_of_the_victim(place: Path) -> dict[str, bytes]:
    place.mkdir()
    for name in ("thesis.docx", "id_key", "inputs", "owner", "part-0.parquet", "0.parquet", "spectrum.svg"):
        (place / name).write_bytes(name.encode())
    return {path.name: path.read_bytes() for path in place.iterdir()}


def content(place: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in place.iterdir()}


def test_a_link_in_place_of_the_hidden_folder_is_refused_and_empties_nothing(tmp_path: Path) -> None:
    before = files_of_the_victim(tmp_path / "victim")
    hidden(tmp_path, "rows.parquet").symlink_to(tmp_path / "victim")
    with pytest.raises(sm.errors.InvalidOption, match=r"must be a folder that this user made and .*; got a link"):
        sm.write_many(tmp_path / "rows.parquet", SCENE, MOTION)
    assert content(tmp_path / "victim") == before
    hidden(tmp_path, "study").symlink_to(tmp_path / "victim")
    assert main(["study", "--out", str(tmp_path / "study"), "--no-figures"]) == 2
    assert content(tmp_path / "victim") == before


@pytest.mark.parametrize("mode", [0o770, 0o707, 0o722])
def test_a_hidden_folder_that_others_may_write_to_is_refused(tmp_path: Path, mode: int) -> None:
    hidden(tmp_path, "rows.parquet").mkdir()
    hidden(tmp_path, "rows.parquet").chmod(mode)
    with pytest.raises(sm.errors.InvalidOption, match=r"got one that others may write to \(mode"):
        sm.write_many(tmp_path / "rows.parquet", SCENE, MOTION)


def test_a_hidden_folder_of_another_user_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = hidden(tmp_path, "rows.parquet")
    folder.mkdir(mode=0o700)
    monkeypatch.setattr(os, "geteuid", lambda: folder.stat().st_uid + 1)
    with pytest.raises(sm.errors.InvalidOption, match="got one of user"):
        sm.write_many(tmp_path / "rows.parquet", SCENE, MOTION)


def test_only_what_was_kept_is_removed(tmp_path: Path) -> None:
    """Also through links within the folder, and where its inputs are others."""
    before = files_of_the_victim(tmp_path / "victim")
    folder = hidden(tmp_path, "rows.parquet")
    folder.mkdir(mode=0o700)
    (folder / "thesis.docx").write_text("mine")
    (folder / "part-0.parquet").symlink_to(tmp_path / "victim" / "part-0.parquet")
    (folder / "inputs").symlink_to(tmp_path / "victim" / "inputs")
    (folder / "part-9.parquet").mkdir()
    sm.write_many(tmp_path / "rows.parquet", SCENE, MOTION)
    assert {path.name for path in folder.iterdir()} == {"thesis.docx", "part-9.parquet"}
    assert content(tmp_path / "victim") == before


def test_a_folder_that_takes_the_name_meanwhile_is_not_touched(tmp_path: Path) -> None:
    before = files_of_the_victim(tmp_path / "victim")
    with result_store(tmp_path, "rows", "a") as kept:
        kept.file("0", lambda: TABLE)
        assert kept.folder is not None
        kept.folder.path.rename(tmp_path / "moved")
        kept.folder.path.symlink_to(tmp_path / "victim")
    assert content(tmp_path / "victim") == before
    kept.folder.path.unlink()
    with result_store(tmp_path, "rows", "a"):
        kept.folder.path.rename(tmp_path / "moved too")
        shutil.copytree(tmp_path / "victim", kept.folder.path)
    assert content(kept.folder.path) == before


def test_a_copy_of_a_hidden_folder_counts_for_nothing(tmp_path: Path) -> None:
    """As an archive brings one: its parts may have any numbers, with digests that fit."""
    with pytest.raises(KeyboardInterrupt), result_store(tmp_path, "rows", "a") as kept:
        kept.file("0", lambda: pl.DataFrame({"a": [666.0]}))
        raise KeyboardInterrupt
    (tmp_path / "victim").mkdir()
    shutil.copytree(hidden(tmp_path, "rows"), hidden(tmp_path / "victim", "rows"))
    with result_store(tmp_path / "victim", "rows", "a") as kept:
        assert kept.of("0", lambda: TABLE).equals(TABLE)


def test_a_new_hidden_folder_is_closed_to_others(tmp_path: Path) -> None:
    with result_store(tmp_path, "rows", "a") as kept:
        assert kept.folder is not None
        assert stat.S_IMODE(kept.folder.path.stat().st_mode) == 0o700


def test_what_was_left_behind_is_removed_without_its_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A link with the name of a temporary folder, one within such a folder, and what another user has made."""
    before = files_of_the_victim(tmp_path / "victim")
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()

    def left() -> Path:
        head, _, rest = temporary_name().rpartition(f"-{os.getpid()}-")
        return tmp_path / f"{head}-{ended.pid}-{rest}"

    link, folder = left(), left()
    link.symlink_to(tmp_path / "victim")
    folder.mkdir()
    (folder / "link").symlink_to(tmp_path / "victim")
    place = Directory(tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr(os, "geteuid", lambda: tmp_path.stat().st_uid + 1)
        remove_left_behind(place)
        assert folder.exists()
    remove_left_behind(place)
    place.close()
    assert [path.name for path in tmp_path.iterdir()] == ["victim"]
    assert content(tmp_path / "victim") == before


def test_the_folder_of_a_study_loses_no_file_of_its_user(tmp_path: Path) -> None:
    """A link with the name of a figure, a figure of one's own, and a file that a foreign list names."""
    before = files_of_the_victim(tmp_path / "victim")
    out = tmp_path / "out"
    out.mkdir()
    (out / "slip_mu0.9.svg").symlink_to(tmp_path / "victim" / "spectrum.svg")
    (out / "drift_R9.png").write_bytes(b"my own")
    sha256 = {"slip_mu0.9.svg": hashlib.sha256(b"spectrum.svg").hexdigest()}
    (out / "files.json").write_text('{"sha256": ' + str(sha256).replace("'", '"') + "}")
    assert main(["study", "--out", str(out), "--no-figures"]) == 0
    assert (out / "slip_mu0.9.svg").is_symlink()
    assert (out / "drift_R9.png").read_bytes() == b"my own"
    assert content(tmp_path / "victim") == before
