"""`seismass report` on folders that were edited: a change of what is read is refused by name, or said on the page."""

from __future__ import annotations

import html
import json
import random
import re
import shutil
from pathlib import Path

import polars as pl
import pytest

import seismass as sm
from seismass.base.folders import list_sha256
from seismass.cli import main
from seismass.show.study.write import write_study
from seismass.studies.study import StudyParameters, run_study

SUITE = sm.builtin_suite("seven")
KINDS = ("building", "study")
READ = {
    "building": [
        *("assessment.json", "animation.json", "storeys.parquet", "governing.parquet", "analysis.parquet"),
        *("slip.parquet", "runs.parquet", "checks.parquet", "spectra.parquet", "curve.parquet", "scaling.parquet"),
    ],
    "study": [
        *("study.json", "responses.parquet", "summary.parquet", "fractions.parquet", "designs.parquet"),
        *("spectrum.parquet", "scaling.parquet"),
    ],
}
"""Files that the page of each kind of folder is made of (docs/report.md)."""
FLIPS = 30


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    out = tmp_path_factory.mktemp("folders")
    given = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.4, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 4},
        "goods": {"live_load_kpa": 6, "friction": "timber-on-steel"},
        "storeys": [{}, {"live_load_kpa": 0}],
    }
    sm.assess(given, SUITE, mu_factors=(1, 1), resamples=2).write(out / "building")
    chosen = StudyParameters(buildings=((1, 0.3),), response_modification=(2.0,), mass_ratios=(1.0,))
    write_study(run_study(SUITE, sm.TargetSpectrum.asce7(), chosen), out / "study")
    return {kind: out / kind for kind in KINDS}


def refused(folder: Path, capsys: pytest.CaptureFixture[str], name: str, got: str) -> None:
    """The command ends with code 2 and one line that names the file, and the page stays as it was."""
    page = (folder / "report.html").read_bytes()
    assert main(["report", str(folder)]) == 2
    shown = capsys.readouterr()
    (line,) = shown.err.splitlines()
    assert f"{name} of folder {folder} must be as it was written" in line
    assert line.endswith(f"or --force be given; got {got}")
    assert shown.out == ""
    assert (folder / "report.html").read_bytes() == page


def flipped(content: bytes, chooser: random.Random) -> bytes:
    """The content with one bit of it changed."""
    changed = bytearray(content)
    changed[chooser.randrange(len(content))] ^= 1 << chooser.randrange(8)
    return bytes(changed)


def said(page: Path) -> str:
    """What the page says of files that were edited."""
    found = re.search(r'<p class="edited">(.*?)</p>', page.read_text(encoding="utf-8"))
    return "" if found is None else html.unescape(re.sub("<[^>]*>", "", found[1]))


@pytest.mark.parametrize("kind", KINDS)
def test_one_bit_or_a_cut_of_any_file_that_is_read_is_refused(
    kind: str, folders: dict[str, Path], capsys: pytest.CaptureFixture[str]
) -> None:
    """The list of digests among them; files.json has a digest for every other file of the folder."""
    folder, chooser = folders[kind], random.Random(kind)
    listed = json.loads((folder / "files.json").read_text())["sha256"]
    assert set(listed) == {file.name for file in folder.iterdir()} - {"files.json"}
    assert set(READ[kind]) <= set(listed)
    for name in (*READ[kind], "files.json"):
        file = folder / name
        content = file.read_bytes()
        for number in range(FLIPS):
            changed = flipped(content, chooser), content[: chooser.randrange(len(content))]
            file.write_bytes(changed[number % 5 == 0])
            refused(folder, capsys, name, "other content")
        file.write_bytes(content)
    assert main(["report", str(folder)]) == 0
    assert said(folder / "report.html") == ""


@pytest.mark.parametrize("kind", KINDS)
def test_missing_and_additional_files_are_refused(
    kind: str, folders: dict[str, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = shutil.copytree(folders[kind], tmp_path / kind)
    for name in (*READ[kind][1:], "files.json"):
        (folder / name).rename(tmp_path / name)
        refused(folder, capsys, name, "none")
        (tmp_path / name).rename(folder / name)
    (folder / READ[kind][0]).rename(tmp_path / READ[kind][0])  # then it is no such folder
    assert main(["report", str(folder)]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    (tmp_path / READ[kind][0]).rename(folder / READ[kind][0])
    # A list that is sound and lacks a file that is there and would be read.
    listed = json.loads((folder / "files.json").read_text())["sha256"]
    del listed["scaling.parquet"]
    (folder / "files.json").write_text(json.dumps({"sha256": listed, "sha256_of_list": list_sha256(listed)}))
    refused(folder, capsys, "scaling.parquet", "a file that files.json does not list")


@pytest.mark.parametrize("kind", KINDS)
def test_other_files_of_the_folder_may_change(kind: str, folders: dict[str, Path], tmp_path: Path) -> None:
    folder = shutil.copytree(folders[kind], tmp_path / kind)
    page = (folder / "report.html").read_bytes()
    (folder / "notes.txt").write_text("mine")
    (folder / "mine.parquet").write_text("mine")
    for file in folder.glob("*.csv"):
        file.unlink()
    (folder / "spectrum.svg").write_text("other")
    assert main(["report", str(folder)]) == 0
    assert (folder / "report.html").read_bytes() == page


@pytest.mark.parametrize("kind", KINDS)
def test_edited_files_are_read_where_it_is_asked_for_and_the_page_says_so(
    kind: str, folders: dict[str, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A value in the document and one in a table; then a table that can no longer be read."""
    folder = shutil.copytree(folders[kind], tmp_path / kind)
    document = folder / READ[kind][0]
    text = document.read_text(encoding="utf-8")
    document.write_text(re.sub(r'"package_version": "[^"]*"', '"package_version": "9.9.9"', text), encoding="utf-8")
    scaling = pl.read_parquet(folder / "scaling.parquet")
    scaling.with_columns(scaling["factor"] * 2.0).write_parquet(folder / "scaling.parquet")
    assert main(["report", str(folder), "--force"]) == 0
    changed = {document.name, "scaling.parquet"}
    words = said(folder / "report.html")
    assert words.startswith("Edited since seismass wrote them, so that this page may not be what was computed: ")
    for name in (*READ[kind], "files.json"):
        assert (f"{name} (other content)" in words) == (name in changed)
    assert "edited since they were written: " in capsys.readouterr().out
    assert "9.9.9" in (folder / "report.html").read_text(encoding="utf-8")
    (folder / "files.json").unlink()
    assert main(["report", str(folder), "--force"]) == 0
    assert "files.json (none)" in said(folder / "report.html")
    capsys.readouterr()
    (folder / "scaling.parquet").write_bytes(b"PAR1")
    page = (folder / "report.html").read_bytes()
    assert main(["report", str(folder), "--force"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert (folder / "report.html").read_bytes() == page
