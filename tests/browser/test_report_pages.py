"""The pages of a study and of a building in a browser."""

from __future__ import annotations

import re
import zlib
from pathlib import Path
from typing import Any

import polars as pl
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main
from seismass.media.page import Section, page_html, table_html


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The page of the study of the paper, with all that it may have but the sensitivity, which matches motions."""
    out = tmp_path_factory.mktemp("study")
    assert main(["study", "--effective", "--out", str(out)]) == 0
    return Path(out, "report.html").read_text(encoding="utf-8")


def test_page_of_a_study_is_as_every_page_must_be(study: str, look: Any) -> None:
    look(study, "study")


def test_claims_are_filtered_and_storeys_sorted(study: str, open_page: Any) -> None:
    with open_page(study, "study") as page:
        claims = page.locator(".table", has_text="Each claim")
        claims.locator("input").fill("section 4")
        shown = claims.locator("tbody tr:visible")
        assert 0 < shown.count() < claims.locator("tbody tr").count()
        storeys = page.locator(".table", has_text="Capped mean drift of every storey")
        header = storeys.locator("th button", has_text="under-estimation")
        header.click()
        header.click()
        first = storeys.locator("tbody tr").first.inner_text()
        # The largest underestimation of the built-in suite, as the page says first.
        assert "commercial" in first
        assert "+102" in first
        assert sm.__version__ in page.locator(".subtitle").inner_text()


@pytest.fixture(scope="module")
def building(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The page of the example."""
    out = tmp_path_factory.mktemp("building")
    assert main(["building", str(example_file()), "--out", str(out)]) == 0
    return Path(out, "report.html").read_text(encoding="utf-8")


WIDTHS = (320, 360, 390, 414, 480, 600, 680, 720, 768, 800, 810, 834, 960, 1280, 1440, 1920)
"""Screens of phones, tablets and computers (CSS pixels)."""
CUT = """() => Array.from(document.querySelectorAll(".table .scroll"))
  .filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.ariaLabel)"""
"""Captions of tables that are wider than their place."""
LETTERS = """() => Array.from(document.querySelectorAll("figure text"))
  .filter((one) => one.getClientRects().length && one.textContent.trim().length > 2)
  .map((one) => one.getBoundingClientRect()).map(({ width, height }) => Math.min(width, height))"""
"""Heights of the words in figures (px), as they are shown; of three letters or more, which are wider than high."""


def test_page_of_a_building_is_as_every_page_must_be(building: str, look: Any) -> None:
    look(building, "building")


@pytest.mark.parametrize("width", [1280, 1920])
def test_no_table_is_cut_on_a_laptop(building: str, study: str, open_page: Any, width: int) -> None:
    for name, page in (("building", building), ("study", study)):
        with open_page(page, name, width=width) as shown:
            assert shown.evaluate(CUT) == [], name


def test_on_a_phone_names_stand_above_values_and_words_of_figures_are_legible(building: str, open_page: Any) -> None:
    """Letters of 7 points, the smallest in figures, have a line of 10 px at their own size and of 8 px at the least."""
    with open_page(building, "building", width=360) as page:
        boxes = page.evaluate(
            """() => Array.from(document.querySelectorAll(".sections .facts > div"), (one) => {
              const [name, value] = [...one.children].map((child) => child.getBoundingClientRect());
              return [name.bottom, value.top, value.width];
            })"""
        )
        assert boxes
        assert all(above <= below + 1.0 and width > 300.0 for above, below, width in boxes)
        heights = page.evaluate(LETTERS)
        assert len(heights) > 50
        assert min(heights) >= 8.0
        assert page.evaluate("document.querySelectorAll('.on-wide svg, .on-narrow svg').length") == 2 * 4


def test_on_a_phone_a_page_is_twelve_screens_and_its_parts_open(building: str, open_page: Any, violations: Any) -> None:
    """By a heading, a link and printing; a screen is 900 px high."""
    opened = "document.querySelectorAll('.fold[aria-expanded=true]').length"
    with open_page(building, "building", width=360, folded=True) as page:
        assert page.evaluate("document.documentElement.scrollHeight") <= 12 * 900
        assert violations(page) == []
        drifts = page.get_by_role("heading", name="Drifts")
        assert page.evaluate(opened) == 0
        drifts.get_by_role("button").click()
        assert page.evaluate(opened) == 1
        drifts.get_by_role("button").click()
        assert page.evaluate(opened) == 0
        page.locator("nav a", has_text="Assumptions").click()
        page.wait_for_function(f"{opened} === 1")
        assert page.locator("section", has_text="Assumptions").last.locator("li").first.is_visible()
        page.pdf()
        assert page.evaluate(opened) == page.locator(".sections > section").count()


def test_the_sheet_for_the_file_is_one_side_of_a4(building: str, open_page: Any) -> None:
    """297 mm less margins of 16 mm at 96 px an inch; what follows begins on the next page."""
    with open_page(building, "building", width=680) as page:
        page.emulate_media(media="print")
        end = page.locator(".sheet").evaluate("one => one.getBoundingClientRect().bottom + scrollY")
        assert end < (297.0 - 2 * 16.0) / 25.4 * 96.0
        assert page.locator(".sheet").evaluate("one => getComputedStyle(one).breakAfter") == "page"
        for words in ("Project", "Checked by", "Analysis 1", "Analysis 2", "use", "Method.", "By hand.", "mezzanines"):
            assert words in page.locator(".sheet").inner_text()


def test_project_file_and_number_stand_on_every_sheet(building: str, open_page: Any) -> None:
    """A page without its margin boxes has fewer glyphs on every sheet; each has the number of the sheet."""
    rule = re.search(r"@top-left \{.*?\}.*?counter\(pages\); \}", building)
    assert rule is not None
    assert "warehouse of four storeys" in rule[0]
    assert "SHA-256" in rule[0].replace("\\00002d", "-")
    with open_page(building, "building", width=680) as page:
        sheets = page.pdf(format="A4")
    with open_page(building.replace(rule[0], ""), "bare", width=680) as page:
        bare = page.pdf(format="A4")
    pages = len(re.findall(rb"/Type\s*/Page\b", sheets))
    assert pages == len(re.findall(rb"/Type\s*/Page\b", bare)) >= 9
    assert len(sheets) > len(bare)


@pytest.mark.parametrize("width", WIDTHS)
def test_no_page_scrolls_sideways(building: str, study: str, open_page: Any, width: int) -> None:
    for name, page in (("building", building), ("study", study)):
        with open_page(page, name, width=width) as shown:
            assert shown.evaluate("document.documentElement.scrollWidth") <= width, name


def test_heads_of_tables_are_repeated_on_every_page(open_page: Any) -> None:
    """Pages behind the first have the one glyph of all cells and the three of the head, beside their number."""
    rows = pl.DataFrame({"QXZ": ["1"] * 300})
    html = page_html("T", [Section("S", [table_html(rows, "C", formats={"QXZ": str})])])
    with open_page(html, "heads", width=680) as page:
        assert page.locator("th button").count() == 1  # on the screen it sorts
        document = page.pdf(format="A4")
    streams = []
    for found in re.finditer(rb"stream\r?\n(.*?)endstream", document, re.DOTALL):
        try:
            text = zlib.decompress(found[1])
        except zlib.error:
            continue
        if b" Tj" in text:
            streams.append({*re.findall(rb"<([0-9A-F]+)> Tj", text)})
    assert len(streams) >= 3
    assert [{len(text) // 4 for text in texts} for texts in streams[1:]] == [{1, 3}] * (len(streams) - 1)


def test_the_study_opens_with_its_figure_and_validates_last(study: str, open_page: Any) -> None:
    with open_page(study, "study") as page:
        first = page.locator("main figure").first.evaluate("one => one.getBoundingClientRect().top")
        assert first < 400.0
        assert "underestimated by" in page.locator(".lead .answer").inner_text()
        titles = page.locator("h2").all_inner_texts()
        assert titles[-3:] == ["Validation", "Assumptions", "Provenance"]
