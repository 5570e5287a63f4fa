"""The words of docs/questions.md are true of what it prints."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from pages.questions import command

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def page() -> str:
    return (ROOT / "docs" / "questions.md").read_text(encoding="utf-8")


def test_every_block_that_prints_shows_it(page: str) -> None:
    blocks = re.findall(r"^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    shown = [language for language, _ in blocks]
    for place, (language, code) in enumerate(blocks):
        if language in ("sh", "python"):
            assert shown[place + 1] == "text", code
        if language == "text":
            assert code.strip()


def test_table_names_every_question(page: str) -> None:
    asked = re.findall(r"^\| \[([^]]+)\]\(#", page, re.MULTILINE)
    assert asked == re.findall(r"^## (.+)$", page, re.MULTILINE)


def test_words_of_the_page_are_true_of_what_it_prints(page: str) -> None:
    assert "asce7-10, floor 2: 0.00 of the live load, storage (at most 5 % of the weight of the level)" in page
    slips = re.findall(r"^slip ([\d.]+) mm, closed form ([\d.]+) mm$", page, re.MULTILINE)
    assert [slip for slip, _ in slips] == [form for _, form in slips] == ["0.000", "0.000", "44.483"]
    assert len(re.findall(r"^[\d.]+ s reverse$", page, re.MULTILINE)) == 3  # "turns three times"
    errors = [abs(float(error)) for error in re.findall(r"mm, ([+-][\d.]+) %$", page, re.MULTILINE)]
    assert errors[0] > 5.0
    assert errors[-1] < 0.1
    assert "slides first: mu_s = 0.3, b/(2 h_c) = 0.333" in page  # 0.6/1.8
    assert "runs     38 of 70, 0 failed" in page  # parts 1, 3, 5, 7 of eight runs, and part 9 of six
    assert "runs     70 of 70, 0 failed" in page  # 2 masses x 5 frictions x 7 motions


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("ls", "must end with code 0; got 2: ls"),
        ("seismass building missing.toml", "must end with code 0; got 2"),
        ("seismass building --codes | tail -n 1", "piped to head -n COUNT alone; got tail -n 1"),
    ],
)
def test_lines_that_are_no_commands_of_a_page_are_refused(line: str, message: str) -> None:
    with pytest.raises(SystemExit, match=message):
        command(line)
