"""Pages whose names are scripts, handlers and addresses: in a browser nothing runs, and nothing is asked for."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main

HOSTILE = (
    "<script>window.ran=1</script>",
    "</script><script>window.ran=1</script>",
    "<img src=x onerror=window.ran=1>",
    "<img src=https://example.org/a.png>",
    "<svg onload=window.ran=1>",
    "<svg><script>window.ran=1</script></svg>",
    '" onmouseover="window.ran=1" autofocus onfocus="window.ran=1" x="',
    "' onclick='window.ran=1' x='",
    "<iframe src=javascript:parent.ran=1></iframe>",
    "<a href=javascript:window.ran=1>a</a>",
    "<style>@import url(https://example.org/a.css);</style>",
    "<link rel=stylesheet href=https://example.org/a.css>",
    "<meta http-equiv=refresh content=0;url=https://example.org>",
    "<base href=https://example.org/>",
    "<!--<script>window.ran=1</script>-->",
    "]]><script>window.ran=1</script>",
    "${window.ran=1}{{window.ran=1}}",
    "\\u003cscript\\u003ewindow.ran=1\\u003c/script\\u003e",
    "&lt;script&gt;window.ran=1&lt;/script&gt;",
    "</title></style></textarea><script>window.ran=1</script>",
)
"""Twenty ways in which a name may end its place and begin to act."""
BUILDING = sm.Building.uniform(2, 0.3)
MOTION = sm.Motion([2.0, -2.0, 2.0, 0.0, 0.0], dt=0.1)


STAY = """() => addEventListener('click', event => {
  const link = event.target.closest('a[href]');
  if (link && /^[\\w./-]+\\.html/.test(link.getAttribute('href'))) event.preventDefault();
}, true)"""
"""Links to other pages of the program, such as the live page, are clicked without leaving."""


def harmless(page: Any, name: str) -> None:
    """Hold a page against what a hostile name may do; `open_page` sees requests and what the console says."""
    page.evaluate(STAY)
    for locator in page.locator("a, button, summary").all()[:40]:
        locator.dispatch_event("click")
        locator.dispatch_event("mouseover")
        locator.dispatch_event("focus")
    assert page.evaluate("window.ran") is None, name
    assert page.locator("iframe, base, link[rel=stylesheet][href^=http], img[src^=http]").count() == 0, name
    handlers = "[...document.querySelectorAll('*')].filter(e => e.getAttributeNames().some(n => n.startsWith('on')))"
    assert page.evaluate(f"{handlers}.length") == 0, name


def test_what_is_asked_sees_a_name_that_acts(open_page: Any) -> None:
    with open_page(f"<!doctype html><title>raw</title><p>{HOSTILE[0]}", "raw") as page:
        assert page.evaluate("window.ran") == 1


@pytest.mark.parametrize("name", HOSTILE, ids=range(len(HOSTILE)))
def test_no_name_acts_in_an_animation_and_in_notebooks(name: str, open_page: Any) -> None:
    scene = sm.Scene(BUILDING, sm.blocks_on_floors([1.0, 0.0], mu=0.2), name=name)
    record = sm.Record(MOTION.acceleration, MOTION.dt, name=name, event=name, station=name, remarks=(name,))
    response = sm.simulate(scene, record)
    with open_page(response.animate(title=name).html(), "animation") as page:
        harmless(page, name)
    shown = [value._repr_html_() for value in (scene, record, sm.Suite(name, (record, record)), response)]
    with open_page(f"<!doctype html><title>shown</title>{''.join(shown)}", "shown") as page:
        harmless(page, name)


@pytest.mark.parametrize("first", range(0, len(HOSTILE), 5))
def test_no_name_acts_in_the_report_of_a_building(first: int, tmp_path: Path, open_page: Any) -> None:
    """The building and each of its storeys have a name of their own."""
    building = tomllib.loads(Path(example_file()).read_text(encoding="utf-8"))
    names = [HOSTILE[(first + at) % len(HOSTILE)] for at in range(5)]
    building["name"] = names[0]
    for at, storey in enumerate(building["storeys"]):
        storey["name"] = names[1 + at % 4]
    file = tmp_path / "building.json"
    file.write_text(json.dumps(building), encoding="utf-8")
    sm.assess(file, mu_factors=(1.0, 1.0), resamples=2).write(tmp_path / "out")
    written = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    with open_page(written, "report") as page:
        harmless(page, str(names))
    assert main(["report", str(tmp_path / "out")]) == 0
    with open_page((tmp_path / "out" / "report.html").read_text(encoding="utf-8"), "again") as page:
        harmless(page, str(names))
