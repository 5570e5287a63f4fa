"""How numbers, tables and texts are put into a page: the words around them stay, and what has no place is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from pages.parts import FIGURES, NoRecordings, Page, made, names, table, with_block

TEXT = """# Title

It drifts 1.05 to 2.50 mm, which is
more than 3 of the 4 others. An angle (of 5 degrees) ends 0.75.

| a | b |
| --- | --- |
| 1 | 2 |

Below are remarks:

- one
- two

## First

old

| a | b |
| --- | --- |
| 3 | 4 |

## Second

<!-- key -->
old
<!-- end of key -->
"""


@pytest.fixture
def page(tmp_path: Path) -> Page:
    file = tmp_path / "page.md"
    file.write_text(TEXT, encoding="utf-8")
    return Page(file, ["dear"])


def test_numbers_stand_where_their_words_are(page: Page) -> None:
    """Line breaks within words and within values do not matter; a number at the end is whole with its decimals."""
    page.words("drifts {} to {} mm, which is more than {} of the {} others.", "1.05", "2.50", 3, 4)
    page.words("ends {}.", "0.75")
    page.words("It drifts {} more than", "1.05 to 2.50 mm, which is")
    assert page.text == TEXT
    page.words("drifts {} to {} mm", "11.5", 0)
    page.words("(of {} degrees) ends {}.", "-6", "0.8")
    assert page.text == TEXT.replace("1.05 to 2.50", "11.5 to 0").replace(
        "5 degrees) ends 0.75", "-6 degrees) ends 0.8"
    )


def test_tables_with_the_same_heads_are_filled_in_order(page: Page) -> None:
    page.tables(table("a | b", [[5, 6], [7, 8]]), table(["a", "b"], [["x", ""]]))
    page.wants("dear")
    page.finish()
    old = ("| 1 | 2 |", "| 3 | 4 |")
    assert page.text == TEXT.replace(old[0], "| 5 | 6 |\n| 7 | 8 |").replace(old[1], "| x |  |")
    assert table("a | b | c", [], left=1) == "| a | b | c |\n| --- | ---: | ---: |"


def test_paragraphs_sections_and_marks(page: Page) -> None:
    page.after("Below are remarks", "- three")
    page.section("## First", "new")
    page.block("key", ["new"])
    first, second = TEXT.index("old\n\n|"), TEXT.index("\n\n## Second")
    changed = (TEXT[:first] + "new" + TEXT[second:]).replace("- one\n- two", "- three")
    assert page.text == with_block(changed, "key", ["new"])
    page.section("## Second", "end")
    assert page.text.endswith("\n\n## Second\n\nend\n")


@pytest.mark.parametrize(
    ("put", "message"),
    [
        (lambda page: page.words("drifts {} metres", 1), "must say once, .*: drifts {} metres; got 0 times"),
        (lambda page: page.words("old{}", ""), "got 0 times"),
        (lambda page: page.words("| {} |", 1), r"got \d times"),
        (lambda page: page.words("one {} First", 1), "got 0 times"),  # in two paragraphs
        (lambda page: page.tables("| c |\n| --- |"), r"must have 1 tables \| c \|; got 0"),
        (
            lambda page: (page.wants("dear"), page.tables(table("a | b", [])), page.finish()),
            "must have 1 tables .*; got 2",
        ),
        (lambda page: page.after("Above", ""), "a paragraph that begins: Above; got none"),
        (lambda page: page.section("## Third", ""), "a heading: ## Third; got none"),
        (lambda page: page.marked("other", ""), "no marks <!-- other -->"),
        (lambda page: (page.wants("seldom"), page.finish()), r"has no part dear; it has \['seldom'\]"),
    ],
)
def test_what_has_no_place_is_refused(page: Page, put: Callable[[Page], object], message: str) -> None:
    with pytest.raises(SystemExit, match=message):
        put(page)


def test_the_number_of_values_is_that_of_their_places(page: Page) -> None:
    with pytest.raises(ValueError, match="zip"):
        page.words("drifts {} to {} mm", 1)


def test_figures_that_are_missing_and_changed_pages_are_faults(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pages.parts.ROOT", page.file.parent)
    page.figure("none", lambda: pytest.fail("a check draws nothing"))
    page.figure(next(FIGURES.glob("*.png")).stem, lambda: pytest.fail("a check draws nothing"))
    assert page.faults() == ["figures/none.png"]
    page.text += "\n"
    assert page.faults() == ["figures/none.png", "page.md"]


def test_a_page_without_its_recordings_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SEISMASS_SHARED", raising=False)
    with pytest.raises(NoRecordings, match=r"section4\.md needs recordings: SEISMASS_SHARED must name"):
        made("section4")
    assert "section4" in names()
