"""Pages in a browser: seen at every width, tables sorted and filtered, nothing asked of the network."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import polars as pl
import pytest
from markupsafe import Markup
from matplotlib.figure import Figure

import seismass as sm
from seismass.media.page import Section, facts_html, figure_html, page_html, table_html, text_html
from seismass.media.roles import CODE, SLIDE

CLAIMS = pl.DataFrame(
    {
        "claim": [f"claim {number}" for number in (10, 2, 1, 3, 5, 4, 7, 6, 9, 8)],
        "ratio": [0.5, None, -1.5, 10.0, 9.0, 0.25, 1e-9, 2.0, 3.0, None],
        "yields": [True, False] * 5,
    }
)
WIDE = pl.DataFrame({f"quantity {number}": [1.0 / number, 2.0, 3.0] for number in range(1, 13)})

CHECKS = (Path(__file__).parent / "checks.js").read_text(encoding="utf-8")
MINUS, NONE = "\N{MINUS SIGN}", "\N{EN DASH}"


def figure() -> Figure:
    drawn = Figure(figsize=(6.4, 3.6), layout="constrained")
    for axes in drawn.subplots(1, 2):
        axes.plot([0.0, 1.0, 2.0], [0.0, 2.0, 1.0], color=SLIDE.colour, label="real")
        axes.plot([0.0, 1.0, 2.0], [0.0, 1.0, 1.5], color=CODE.colour, label="model")
        axes.set_xlabel("time (s)")
        axes.legend()
    return drawn


@pytest.fixture(scope="module")
def page() -> str:
    sketch = sm.builtin_record("synthetic-1")._repr_html_()
    animation = sm.animate(
        sm.Scene(sm.Building.uniform(2, 0.4, yield_shear_over_weight=0.2), sm.blocks_on_floors([1.0, 1.0], mu=0.2)),
        sm.builtin_record("synthetic-1"),
    )
    return page_html(
        "What a page may hold",
        [
            Section(
                "Tables",
                [
                    text_html("A paragraph that is long enough to be broken on any screen. " * 4),
                    table_html(CLAIMS, "The claims, one by one.", headers={"ratio": "real over model"}),
                    table_html(WIDE, "A table that is wider than a phone."),
                ],
            ),
            Section(
                "Figures",
                [figure_html(figure(), "Two panels.", "Drift over time: the model is below the real building.")],
                [Section("A record", [Markup(sketch)]), Section("An animation", [animation.fragment()])],
            ),
            Section("Inputs", [facts_html({"period": "0.57 s", "code": "ASCE/SEI 7-10, 12.7.2, item 1"})]),
        ],
        subtitle="with a line below its heading",
        lead=[
            Markup('<p class="answer">Use <b>0.90</b>: <span class="good">so</span>, <span class="warn">no</span></p>')
        ],
    )


def column(page: Any, table: int, number: int) -> list[str]:
    rows = page.locator("table").nth(table).locator("tbody tr")
    return [
        cells[number].strip()
        for cells in rows.evaluate_all("rows => rows.map(r => [...r.cells].map(c => c.innerText))")
    ]


def test_page_is_as_every_page_must_be(page: str, look: Any) -> None:
    look(page, "page")


def test_checks_find_what_is_wrong(open_page: Any) -> None:
    wrong = [
        '<p style="color:#999">too pale</p>',
        '<p style="opacity:0.4">thinned</p>',
        '<div style="width:2000px">wide</div>',
        '<svg viewBox="0 0 9 9" width="90" height="90"><path d="M0 0h9"/></svg>',
        '<canvas role="img" aria-label="small" width="9" height="9"></canvas>',
        '<a href="#nowhere">away</a><p id="content">twice</p><h4>deep</h4><input>',
    ]
    html = page_html("Wrong", [Section("All of it", [Markup(part) for part in wrong])])
    with open_page(html, "wrong") as shown:
        problems = "\n".join(shown.evaluate(CHECKS)["problems"])
    for problem in (
        '<p "too pale"> has a contrast of 2.85',  # (1 + 0.05) / (0.3185 + 0.05): #999 on white, WCAG 2.2
        '<p "thinned"> has a contrast of',
        "px wide in a window of 1280 px",
        '<div "wide"> ends at',
        '<svg ""> has no alternative text',
        '<svg ""> has no role',
        '<canvas ""> is not seen',
        '<a "away"> leads nowhere',
        "#content is not unique",
        '<h4 "deep"> skips a level',
        '<input ""> has no label',
    ):
        assert problem in problems


def test_table_is_sorted_by_value_with_what_is_missing_last(page: str, open_page: Any) -> None:
    given = ["0.5", NONE, f"{MINUS}1.5", "10", "9", "0.25", f"1e{MINUS}09", "2", "3", NONE]
    down = ["10", "9", "3", "2", "0.5", "0.25", f"1e{MINUS}09", f"{MINUS}1.5", NONE, NONE]
    up = [*down[-3::-1], NONE, NONE]
    with open_page(page, "page") as shown:
        head = shown.locator("th", has_text="real over model")
        assert column(shown, 0, 1) == given
        assert head.get_attribute("aria-sort") is None
        for order, direction in ((up, "ascending"), (down, "descending"), (given, None)):
            head.get_by_role("button").click()
            assert column(shown, 0, 1) == order
            assert head.get_attribute("aria-sort") == direction


def test_table_is_sorted_from_the_keyboard_and_numbers_in_texts_count(page: str, open_page: Any) -> None:
    with open_page(page, "page") as shown:
        button = shown.locator("th", has_text="claim").first.get_by_role("button")
        button.focus()
        shown.keyboard.press("Enter")
        assert column(shown, 0, 0) == [f"claim {number}" for number in range(1, 11)]
        shown.locator("th", has_text="yields").get_by_role("button").press("Enter")
        assert column(shown, 0, 2) == ["no"] * 5 + ["yes"] * 5
        # Of equal ones the order is that given; only one column is marked.
        assert column(shown, 0, 0)[:3] == ["claim 2", "claim 3", "claim 4"]
        assert shown.locator("[aria-sort]").count() == 1


def test_table_is_filtered_by_words_and_sorted_as_well(page: str, open_page: Any) -> None:
    with open_page(page, "page") as shown:
        field = shown.get_by_label("Filter rows")
        visible = shown.locator("table").first.locator("tbody tr:visible")
        names = "rows => rows.map(r => r.cells[0].innerText)"
        field.fill("YES claim")  # each word anywhere in the row, in any case
        assert visible.evaluate_all(names) == [f"claim {number}" for number in (10, 1, 5, 7, 9)]
        assert shown.locator(".filter output").inner_text() == "5 of 10 rows"
        shown.locator("th", has_text="real over model").get_by_role("button").click()
        assert visible.evaluate_all(names) == [f"claim {number}" for number in (1, 7, 10, 9, 5)]
        field.fill("yes 10")
        assert visible.evaluate_all(names) == ["claim 10"]
        field.fill("")
        assert visible.count() == 10
        assert shown.locator(".filter output").inner_text() == ""
        assert shown.locator(".filter").count() == 1  # the other table has three rows


def test_page_without_script_shows_everything(page: str, open_page: Any) -> None:
    with open_page(page, "page", java_script_enabled=False) as shown:
        assert shown.locator("tbody tr:visible").count() == 13
        assert not shown.locator(".filter").is_visible()
        assert shown.locator("figure svg").first.is_visible()
        assert shown.locator("noscript").inner_text() != ""


def test_print_has_all_rows_and_no_controls(page: str, open_page: Any) -> None:
    with open_page(page, "page", width=680) as shown:
        shown.emulate_media(media="print")
        assert shown.locator("tbody tr:visible").count() == 13
        for hidden in (".filter", ".player", ".skip"):
            assert not shown.locator(hidden).first.is_visible()


def test_page_refuses_what_is_not_its_own(page: str, open_page: Any) -> None:
    """A request, an image and a script that were put into the page after the policy was read: none gets through."""
    attempt = """async () => {
      const refused = [];
      document.addEventListener("securitypolicyviolation", (event) => refused.push(event.effectiveDirective));
      const image = document.createElement("img");
      image.src = "https://example.org/picture.png";
      const script = document.createElement("script");
      script.textContent = "window.intruder = true";
      document.body.append(image, script);
      const fetched = await fetch("https://example.org/").then(() => true, () => false);
      await new Promise((done) => setTimeout(done, 100));
      return [refused.sort(), fetched, window.intruder === undefined];
    }"""
    with pytest.raises(AssertionError, match="Content Security Policy"), open_page(page, "page") as shown:
        refused, fetched, kept_out = shown.evaluate(attempt)
        assert refused == ["connect-src", "img-src", "script-src-elem"]
        assert not fetched
        assert kept_out
