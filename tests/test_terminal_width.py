"""What commands print on a terminal of 80 columns fits it, and nothing is lost; elsewhere it stays as it is."""

from __future__ import annotations

import io
import re
import shlex
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from seismass.cli import main
from seismass.media.text_table import fit_text
from seismass.motions.records.builtin import data_directory

ROOT = Path(__file__).parents[1]
WIDTH = 80


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def printed_on_a_terminal(line: str, monkeypatch: pytest.MonkeyPatch) -> str:
    """What a command prints where standard output is a terminal whose width COLUMNS states."""
    screen = Terminal()
    with monkeypatch.context() as patched:
        patched.setattr(sys, "stdout", screen)
        patched.setenv("COLUMNS", str(WIDTH))
        patched.setenv("NO_COLOR", "1")
        assert main(line.split()) == 0
    return screen.getvalue()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made, data = tmp_path_factory.mktemp("terminal"), data_directory()
    shutil.copy(data / "examples" / "warehouse.toml", made)
    shutil.copy(data / "examples" / "storage.toml", made / "scene.toml")
    shutil.copy(data / "synthetic" / "synthetic-1.AT2", made / "record.AT2")
    drift = np.linspace(0.0, 200.0, 21)
    rows = [f"{x:g},{4e3 * np.tanh(x / 40.0):.6g}" for x in drift]
    (made / "push.csv").write_text("\n".join(["Roof Drift (mm),Base Shear (kN)", *rows, ""]))
    return made


COMMANDS = (
    "building warehouse.toml --suite seven --no-figures --out w",
    "building --codes",
    "building --frictions",
    "building --occupancies",
    "new own.toml --pushover push.csv --storeys 3 --height 3.5 --area 900 --dead-load 6 --sds 1 --sd1 0.6 "
    "--live-load 7.2 --friction 0.3",
    "slip scene.toml --suite seven",
    "run scene.toml",
    "records",
    "records record.AT2",
    "scale --sds 1.0 --sd1 0.6 --period 0.6 --suite seven",
    "target ec8:1:C:0.3 --out t.csv",
    "fragility scene.toml --suite seven --method cloud --measure pga --limit drift=0.05",
)
"""Lines that are quick; what the others print is in the pages of the documentation."""


@pytest.mark.parametrize("line", COMMANDS, ids=[" ".join(line.split()[:2]) for line in COMMANDS])
def test_what_commands_print_fits(line: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    printed = printed_on_a_terminal(line, monkeypatch)
    assert "\x1b" not in printed
    assert [text for text in printed.split("\n") if len(text) > WIDTH] == []
    assert printed.strip()


def blocks() -> Iterator[tuple[str, str]]:
    """Output of commands and texts of results in the documentation, by page and place."""
    for page in sorted((ROOT / "docs").glob("*.md")):
        for number, text in enumerate(re.findall(r"^```text\n(.*?)^```", page.read_text("utf-8"), re.M | re.S)):
            yield f"{page.stem}-{number}", text


def words(text: str) -> set[str]:
    return set(re.split(r"\s+", text))


def test_texts_of_the_documentation_fit_and_lose_nothing() -> None:
    found = dict(blocks())
    assert len(found) > 20
    for name, text in found.items():
        for width in (WIDTH, 100):
            fitted = fit_text(text, width)
            longest = max((len(word) for word in words(text)), default=0)
            assert max(map(len, fitted.split("\n"))) <= max(width, longest), (name, width)
            assert words(fitted) == words(text), (name, width)
        assert fit_text(text, 200) == text, name


def test_a_wide_table_goes_on_below_with_what_tells_its_rows_apart() -> None:
    table = "\n".join(
        [
            "  floor  mu      peak mean of all  largest of all",
            "  1      0.2                 10.1            20.2",
            "  1      0.3                  5.5             6.6",
        ]
    )
    assert fit_text(table, 40).split("\n") == [
        "  floor  mu   peak mean of all",
        "  1      0.2              10.1",
        "  1      0.3               5.5",
        "",
        "  floor  mu   largest of all",
        "  1      0.2            20.2",
        "  1      0.3             6.6",
    ]


def test_sentences_are_filled_again_and_keep_what_follows_them() -> None:
    """A line of 108 letters goes on in the next; a short one does not."""
    long = "why       " + "word " * 19 + "end"
    assert len(long) == 108
    text = f"{long}\n          and more of it\nthen      short\n          another sentence"
    assert fit_text(text, 60).split("\n") == [
        "why       word word word word word word word word word word",
        "          word word word word word word word word word end",
        "          and more of it",
        "then      short",
        "          another sentence",
    ]


def test_wide_letters_take_two_columns() -> None:
    assert fit_text("why  " + "\u5009\u5eab " * 12, 40).split("\n") == [
        "why  " + " ".join(["\u5009\u5eab"] * 7),
        "     " + " ".join(["\u5009\u5eab"] * 5),
    ]


def test_into_a_pipe_lines_are_as_long_as_they_are_or_as_columns_states(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(folder)
    for stated in ("", "0", "wide"):
        monkeypatch.setenv("COLUMNS", stated)
        assert main(["building", "--frictions"]) == 0
        assert max(map(len, capsys.readouterr().out.split("\n"))) > 150
    for width in (60, 80, 200):
        monkeypatch.setenv("COLUMNS", str(width))
        assert main(["building", "--frictions"]) == 0
        longest = max(map(len, capsys.readouterr().out.split("\n")))
        assert longest <= width
        assert longest > 0.6 * width


@pytest.mark.parametrize("width", [50, 80])
@pytest.mark.parametrize(
    "line",
    [
        "buildng w.toml",
        "building 'no such file here.toml'",
        "building warehouse.toml --code 'of a very long name'",
        "slip",
    ],
)
def test_errors_fit_and_keep_words_and_what_is_quoted_whole(
    line: str, width: int, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(folder)

    def said() -> str:
        try:
            assert main(shlex.split(line)) == 2
        except SystemExit as error:
            assert error.code == 2
        return capsys.readouterr().err.partition("seismass")[2].rpartition("error: ")[2]

    whole = said()
    monkeypatch.setenv("COLUMNS", str(width))
    fitted = said()
    assert whole.split() == fitted.split()
    assert set(re.findall("'[^']*'", whole)) == set(re.findall("'[^'\n]*'", fitted))
    assert max(map(len, fitted.split("\n"))) <= width
