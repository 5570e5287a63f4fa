"""Pages: well-formed, escaped, closed to the network, their tables and figures as asked for."""

from __future__ import annotations

import base64
import hashlib
import re
from html.parser import HTMLParser

import polars as pl
import pytest
from markupsafe import Markup
from matplotlib.figure import Figure

from seismass.base.errors import InvalidOption
from seismass.base.values import signed
from seismass.media.page import Section, facts_html, figure_html, page_html, table_html, text_html
from seismass.media.roles import INK, lettered
from seismass.media.text_table import ends_text, interval_text

VOID = {"meta", "link", "input", "br", "hr", "img"}


class Reader(HTMLParser):
    """Tags of a page: that each is closed in order, identifiers, links within it, and addresses."""

    def __init__(self, page: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.identifiers: list[str] = []
        self.links: list[str] = []
        self.addresses: list[str] = []
        self.texts: list[str] = []
        self.feed(page)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attrs:
            if name == "id":
                self.identifiers.append(value or "")
            if name in ("href", "src", "xlink:href"):
                (self.links if (value or "").startswith("#") else self.addresses).append(value or "")

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


def drawn() -> Figure:
    figure = Figure(figsize=(4.0, 3.0))
    axes = figure.add_subplot()
    axes.plot([0.0, 1.0], [1.0, 3.0], marker="o", color=INK, label="drift")
    axes.legend()
    return figure


def whole_page() -> str:
    rows = pl.DataFrame({"place": ["first", "top"], "ratio": [0.5, 1.25]})
    figures = [figure_html(drawn(), "One.", "a rising line"), figure_html(drawn(), "The same again.", "a rising line")]
    return page_html(
        "Drift <of> a building",
        [
            Section("Result", [table_html(rows, "Ratios & places.")], [Section("Result", figures)]),
            Section("???", ["<i>plain</i>", facts_html({"R": "6"})]),
        ],
        lead=[text_html("Use 0.9.")],
        subtitle="seismass",
    )


def test_page_is_well_formed_and_links_to_what_is_there() -> None:
    read = Reader(whole_page())
    assert len(set(read.identifiers)) == len(read.identifiers)
    assert {link[1:] for link in read.links} <= set(read.identifiers)
    assert {"result", "result-2", "section"} <= set(read.identifiers)
    (icon,) = read.addresses
    assert icon.startswith("data:image/svg+xml,")
    assert "Drift <of> a building" in read.texts
    assert "<i>plain</i>" in "".join(read.texts)


def test_page_allows_no_request_and_only_its_own_scripts() -> None:
    page = whole_page()
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', page)
    parts = dict(part.strip().split(" ", 1) for part in policy.split(";"))
    assert parts["default-src"] == "'none'"
    assert set(parts) == {"default-src", "style-src", "script-src", "img-src", "base-uri", "form-action"}
    scripts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    digests = [base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts]
    assert len(scripts) == 1
    assert parts["script-src"] == f"'sha256-{digests[0]}'"


def test_page_names_the_script_of_a_fragment_too() -> None:
    script = Markup("<script>let drift = 1;</script>")
    page = page_html("Two scripts", [Section("One", [script, script])])
    digest = base64.b64encode(hashlib.sha256(b"let drift = 1;").digest()).decode()
    assert page.count(f"'sha256-{digest}'") == 1


def test_table_holds_values_to_sort_by_and_texts_to_read() -> None:
    rows = pl.DataFrame(
        {
            "claim": ["a < b", "c"],
            "drift": [-0.0125, None],
            "count": [3, 12],
            "yields": [True, False],
            "storeys": [[0.5, 1.0], []],
        }
    )
    table = table_html(rows, "Claims.", headers={"drift": "peak drift (mm)"}, formats={"count": "03d"})
    assert '<th scope="row">a &lt; b</th>' in table
    assert '<td class="number" data-value="-0.0125">\N{MINUS SIGN}0.0125</td>' in table
    assert '<td class="number">\N{EN DASH}</td>' in table
    assert '<td class="number" data-value="12">012</td>' in table
    assert '<td class="number" data-value="1">yes</td>' in table
    assert "<td>0.5, 1</td>" in table
    assert '<th scope="col" class="number">peak drift (mm)</th>' in table
    assert "<caption>Claims.</caption>" in table
    assert "<input" not in table


def test_table_of_many_rows_has_a_field_to_filter_by() -> None:
    assert "<input" in table_html(pl.DataFrame({"R": range(8)}), "Eight rows.")
    assert "<tbody></tbody>" in table_html(pl.DataFrame({"R": pl.Series([], dtype=pl.Float64)}), "None.")


def test_table_takes_markup_of_a_format_as_it_is() -> None:
    rows = pl.DataFrame({"claim": ["x"], "found": [1.0]})
    good = table_html(rows, "Claims.", formats={"found": lambda value: Markup("<b>{:g}</b>").format(value)})
    assert '<td class="number" data-value="1"><b>1</b></td>' in good
    plain = table_html(rows, "Claims.", formats={"found": lambda value: "<b>"})
    assert "&lt;b&gt;" in plain


def test_table_refuses_columns_that_it_does_not_have() -> None:
    rows = pl.DataFrame({"R": [1.0]})
    with pytest.raises(InvalidOption, match="headers of table must be of its columns"):
        table_html(rows, "", headers={"mu": "friction"})
    with pytest.raises(InvalidOption, match="formats of table must be of its columns"):
        table_html(rows, "", formats={"mu": ".2f"})


def test_figure_is_svg_with_a_title_and_identifiers_of_its_own() -> None:
    one = figure_html(drawn(), "Drift.", 'a "rising" line')
    assert one == figure_html(drawn(), "Drift.", 'a "rising" line')
    assert one.count("<svg") == 1
    assert 'role="img"' in one
    assert "<title>a &#34;rising&#34; line</title>" in one
    assert "<?xml" not in one
    assert "<metadata" not in one
    assert "<style" not in one  # that of matplotlib is of all elements of the page
    assert 'class="inverts"' in one
    assert "max-width:288pt" in one  # 4 inches of 72 points
    assert ">drift</text>" in one
    identifiers = re.findall(r' id="([^"]*)"', one)
    assert identifiers
    assert {name.partition("-")[0] for name in identifiers} == {identifiers[0].partition("-")[0]}
    assert set(re.findall(r'(?:url\(|href=")#([^)"]+)', one)) == set(identifiers)


def test_figure_that_takes_the_colour_of_text_is_not_inverted() -> None:
    svg = (
        '<svg width="40" height="20" viewBox="0 0 4 2" style="color:red"><path d="M0 0h4" stroke="currentColor"/></svg>'
    )
    figure = figure_html(svg, "A line.", "a level line")
    assert 'class="adapts"' in figure
    assert "max-width:40px" in figure
    assert "color:red" not in figure
    assert figure_html(svg.replace('width="40"', ""), "", "a line").count("max-width") == 0


@pytest.mark.parametrize("figure", ["<p>none</p>", "<svg><path/></svg>"])
def test_figure_that_is_none_is_refused(figure: str) -> None:
    with pytest.raises(InvalidOption, match="figure of page must be an SVG with a viewBox"):
        figure_html(figure, "", "a line")


def test_figure_without_a_description_is_refused() -> None:
    with pytest.raises(InvalidOption, match="alt of figure must be a description"):
        figure_html(drawn(), "Drift.", " ")


@pytest.mark.parametrize("words", ["falls by -3 %", "a change of \N{MINUS SIGN}0.0 %", "+0.00 mm", "3e-05 a year"])
def test_a_page_with_a_hyphen_or_a_signed_zero_is_seen(words: str) -> None:
    """Every test that renders a page asks it: `numbers_of_pages_have_one_sign`; as code it may stand."""
    with pytest.raises(pytest.fail.Exception):
        page_html("Signs", [Section("Result", [text_html(words)])])
    page_html("Signs", [Section("Result", [Markup("<code>{}</code>").format(words)])])


@pytest.mark.parametrize(
    ("value", "form", "text"),
    [
        (-0.04, "+.1f", "0.0"),
        (0.04, "+.1f", "0.0"),
        (-0.0, ".3g", "0"),
        (-3e-5, ".3g", "\N{MINUS SIGN}3e\N{MINUS SIGN}05"),
    ],
)
def test_signs_of_numbers(value: float, form: str, text: str) -> None:
    assert lettered(signed(value, form)) == text
    assert ">" + text + "<" in table_html(pl.DataFrame({"a": [value]}), "Numbers.", formats={"a": form})
    assert lettered("ASCE 7-10, 2-1, 2026-11-25, RSN-5, (-2 to -1)") == (
        "ASCE 7-10, 2-1, 2026-11-25, RSN-5, (\N{MINUS SIGN}2 to \N{MINUS SIGN}1)"
    )


def test_digits_of_intervals_are_equal() -> None:
    assert interval_text(4.731e-5, 3.19e-5, 7e-5, ".3g") == "4.73e-05 [3.19e-05, 7.00e-05]"
    assert interval_text(120.0, 99.96, 140.0, ".3g") == "120 [100, 140]"
    assert ends_text(-0.001, 0.2, "+.1f") == " [0.0, +0.2]"
