"""Names that act on a terminal, a page or a spreadsheet: shown as escapes, and never a reason to fail at the end."""

from __future__ import annotations

import json
import os
import sys
import tomllib
from pathlib import Path

import polars as pl
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.base.files import table_content, write_file
from seismass.cli import main

NAMES = {
    "escape": ("a\x1b]0;title\x07\x1b[2J", r"a\x1b]0;title\x07\x1b[2J"),
    "form feed": ("a\x0c", r"a\x0c"),
    "line": ("a\nb\r", r"a\x0ab\x0d"),
    "C1": ("a\x9b2J\x7f", r"a\x9b2J\x7f"),
    "surrogate": ("a\ud800b", r"a\ud800b"),
    "override": ("a\u202egpj.exe\u2066", r"a\u202egpj.exe\u2066"),
    "separator": ("a\u2028b", r"a\u2028b"),
    "letters": ("Ärger, עברית, $x^$, <b>&", "Ärger, עברית, $x^$, <b>&"),
}
BLOCK = sm.Block(0, mass=1.0, mu=0.1)
MOTION = sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1)


@pytest.mark.parametrize(("name", "shown"), NAMES.values(), ids=NAMES)
def test_names_are_text_that_can_be_shown(name: str, shown: str) -> None:
    record = sm.Record([0.0, 1.0], 0.01, name=name, event=name, station=name, component=name, remarks=(name,))
    assert [record.name, record.event, record.station, record.component, *record.remarks] == [shown] * 5
    assert record.replace(dt=0.02).name == shown  # escapes are no more escaped
    assert sm.Suite(name, (record,)).name == shown
    assert sm.Scene(None, [BLOCK], name=name).name == shown
    assert (
        sm.campaign.Campaign(sm.Grid([sm.Building.uniform(1, 0.3)], mass_ratio=1.0, mu=0.1), MOTION, name=name).name
        == shown
    )


def test_a_note_keeps_its_lines() -> None:
    assert sm.Scene(None, [BLOCK], note="a\n\tb\x1b").note == "a\n\tb\\x1b"


def test_an_assessment_of_any_names_is_written(tmp_path: Path) -> None:
    """Text, tables, figures and the page of a building whose name has all of them, and each is that of a storey."""
    building = tomllib.loads(example_file().read_text(encoding="utf-8"))
    given, shown = zip(*NAMES.values(), strict=True)
    building["name"] = " ".join(given)
    building["storeys"] = [{**building["storeys"][0], "name": name} for name in given]
    file = tmp_path / "building.json"
    file.write_text(json.dumps(building), encoding="utf-8")
    motions = list(sm.builtin_suite("forty"))[:3]
    result = sm.assess(file, motions, mu_factors=(1.0, 1.0), resamples=2)
    result.write(tmp_path / "out")
    said = result.text
    written = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert " ".join(shown) in said
    for name, text in zip(given, shown, strict=True):
        assert text in said.replace(" ".join(shown), "")
        assert name == text or name not in said + written


def test_a_record_cannot_act_on_the_terminal(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "suite.csv"
    (tmp_path / "a.txt").write_text("time (s), acceleration (m/s2)\n0.00, 0.0\n0.01, 1.0\n0.02, -1.0\n0.03, 0.0\n")
    file.write_text("file,name\na.txt,\x1b]0;title\x07\x1b[2J\n")
    assert main(["records", str(file)]) == 0
    shown = capsys.readouterr()
    assert "\x1b" not in shown.out + shown.err
    assert r"\x1b]0;title\x07\x1b[2J" in shown.out


def test_an_error_cannot_act_on_the_terminal(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "a\x1b[2J.toml"
    file.write_text('"\\u001b[2J" = 1\n')
    assert main(["run", str(file)]) == 2
    assert main(["run", str(tmp_path / "\x1b[2J.toml")]) == 2
    shown = capsys.readouterr()
    assert "\x1b" not in shown.out + shown.err
    assert r"\x1b[2J of a\x1b[2J.toml must be one of the keys" in shown.err


@pytest.mark.parametrize("begin", ["=", "+", "-", "@"])
def test_a_csv_has_no_formulas(tmp_path: Path, begin: str) -> None:
    formula = f"{begin}cmd|'/C calc'!A0"
    table = pl.DataFrame({"record": [formula, "-2.5", "a=b", None], "drift": [-1.0, 2.0, 3.0, None]})
    write_file(tmp_path / "a.csv", table_content(table, "csv"))
    rows = pl.read_csv(tmp_path / "a.csv", schema={"record": pl.String, "drift": pl.Float64})
    assert rows["record"].to_list() == [f"'{formula}", "-2.5", "a=b", None]
    assert rows["drift"].to_list() == [-1.0, 2.0, 3.0, None]
    write_file(tmp_path / "a.parquet", table_content(table, "parquet"))
    assert pl.read_parquet(tmp_path / "a.parquet").equals(table)


@pytest.mark.parametrize(
    "read",
    [
        sm.read_record,
        sm.read_records,
        sm.read_scene,
        sm.read_suite,
        sm.TargetSpectrum.from_csv,
        sm.campaign.CampaignFolder,
    ],
)
def test_a_path_that_no_system_has_is_refused(read: object) -> None:
    with pytest.raises(sm.SeismassError, match="must be a path"):
        read("a\ud800b.csv")  # type: ignore[operator]


@pytest.mark.skipif(sys.platform != "linux", reason="names of other systems are UTF-8")
def test_a_path_that_is_not_utf_8_is_read(tmp_path: Path) -> None:
    path = tmp_path / os.fsdecode(b"\xff.txt")
    path.write_text("time (s), acceleration (m/s2)\n0.00, 0.0\n0.01, 1.0\n0.02, -1.0\n0.03, 0.0\n")
    assert sm.read_record(path).name == r"\udcff"
