"""Names in any script: on pages they stand in their place, in pictures what the font lacks is left out."""

from __future__ import annotations

import warnings

import pytest
from matplotlib.figure import Figure

from seismass.media.roles import apart, isolated, sentence_html
from seismass.media.style import STYLE, plain, shortened

ARABIC, CHINESE = "\u0645\u0633\u062a\u0648\u062f\u0639", "\u5009\u5eab"
DOTS = "\N{HORIZONTAL ELLIPSIS}"


def test_a_name_that_runs_leftwards_is_isolated() -> None:
    assert str(isolated(ARABIC)) == f"<bdi>{ARABIC}</bdi>"
    assert str(isolated(CHINESE)) == CHINESE
    assert str(isolated("<b>")) == "&lt;b&gt;"
    assert apart("roof") == "roof"
    assert apart(ARABIC) == f"\u2068{ARABIC}\u2069"


def test_a_sentence_keeps_names_and_spells_symbols() -> None:
    names = [ARABIC, "mu", "roof", ""]
    said = sentence_html(f"storey 4 {ARABIC}: 7 motions & eta = 0.5 in mu", names)
    assert str(said) == f"storey 4 <bdi>{ARABIC}</bdi>: 7 motions &amp; \u03b7 = 0.5 in mu"
    assert str(sentence_html("mu = 0.2")) == "\u03bc = 0.2"


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("plain $5", r"plain \$5"),
        (f"2 {CHINESE}", f"2 {DOTS}"),
        (f"{CHINESE} {CHINESE} with a roof", f"{DOTS} with a roof"),
        (f"{ARABIC} {ARABIC}", DOTS),
        ("Dach \u00fcber S\u00e4ulen, \u03b1 = 1", "Dach \u00fcber S\u00e4ulen, \u03b1 = 1"),
    ],
)
def test_a_picture_shows_what_its_font_has(text: str, shown: str) -> None:
    assert plain(text) == shown
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figure = Figure()
        figure.text(0.5, 0.5, plain(text), fontfamily=STYLE["font.family"])
        figure.draw_without_rendering()


def test_long_names_are_cut_at_their_end() -> None:
    assert shortened("roof", 4) == "roof"
    assert shortened("a storey with a long name", 12) == f"a storey wi{DOTS}"
    assert len(shortened("a storey with a long name", 12)) == 12
