"""The `seismass` command with names and streams that are out of the ordinary: no traceback, and what the codes say."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import seismass as sm
from seismass import cli

MOTION = sm.builtin_suite("seven")[0].source
COMMAND = (sys.executable, "-c", "import sys; from seismass.cli import main; sys.exit(main(sys.argv[1:]))")


def with_name(folder: Path, name: bytes) -> Path:
    """The first synthetic motion under a name of any bytes."""
    assert MOTION is not None
    path = folder / os.fsdecode(name)
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(MOTION.read_bytes())
    return path


@pytest.mark.skipif(sys.platform != "linux", reason="other systems take no file names that are not UTF-8")
def test_names_that_are_not_utf_8_are_shown_with_escapes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for letter in (b"a", b"b", b"c"):
        path = with_name(tmp_path, b"suite\xe9/" + letter + b"\xe9.AT2")
    with_name(tmp_path, b"suite\xe9/d\xe9-UP.AT2")
    names = sm.read_suite(path.parent).table()["name"].to_list()
    assert names == [r"a\udce9", r"b\udce9", r"c\udce9", r"d\udce9-UP"]
    assert cli.main(["spectrum", str(path), "--period", "1"]) == 0
    assert r"c\udce9" in capsys.readouterr().out
    assert cli.main(["scale", "--records", str(path.parent)]) == 0
    assert r"suite\udce9: 3 motions" in capsys.readouterr().out
    target = path.with_suffix(".csv")
    target.write_text("period,sa (g)\n0.01,0.4\n3,0.2\n")
    assert cli.main(["scale", "--target", str(target)]) == 0
    assert r"target  c\udce9" in capsys.readouterr().out


@pytest.mark.skipif(sys.platform != "linux", reason="other systems take no file names that are not UTF-8")
def test_folders_that_are_not_utf_8_are_written_to(tmp_path: Path) -> None:
    folder = with_name(tmp_path, b"\xe9/a.AT2").parent
    (folder / "scene.toml").write_text("[[blocks]]\nfloor = 0\nmass = 1\nmu = 0.1\n[motion]\nfile = 'a.AT2'\n")
    for name in ("h.csv", "h.parquet"):
        assert cli.main(["run", str(folder / "scene.toml"), "--out", str(folder / name)]) == 0
        assert (folder / name).stat().st_size > 0
    assert cli.main(["study", "--out", str(folder / "study"), "--no-figures"]) == 0
    assert (folder / "study" / "summary.parquet").is_file()
    file = sm.read_scene(folder / "scene.toml")
    with pytest.raises(sm.errors.InvalidOption, match="path of batch must be in UTF-8, as Polars writes no other; got"):
        sm.write_many(folder / "rows.parquet", file.scene, file.motion)


def test_letters_that_the_terminal_lacks_are_escaped(tmp_path: Path) -> None:
    path = with_name(tmp_path, "Düzce.AT2".encode())
    done = subprocess.run(
        [*COMMAND, "spectrum", path, "--period", "1"],
        env=os.environ | {"PYTHONIOENCODING": "ascii"},
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert rb"D\xfczce" in done.stdout


@pytest.mark.skipif(os.name != "posix", reason="streams are closed by a shell")
@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-"])
def test_closed_streams_do_not_stop_a_command(tmp_path: Path, closed: str) -> None:
    path = with_name(tmp_path, b"a.AT2")
    line = ["sh", "-c", f'"$@" {closed}', "sh", *COMMAND, "spectrum", path, "--period", "1"]
    done = subprocess.run(line, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.parametrize("command", ["run", "animate", "building", "slip", "fragility"])
@pytest.mark.parametrize("folder", [".", "folder", "folder.toml"])
def test_a_folder_in_place_of_a_file_is_what_is_wrong(
    command: str, folder: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(folder).mkdir(exist_ok=True)
    assert cli.main([command, folder]) == 2
    assert f" file must be a file that can be read; got {folder} (" in capsys.readouterr().err
