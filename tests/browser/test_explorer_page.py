"""The live page in a browser: the numbers of `seismass run`, a case in its address, records of one's own, speed."""

from __future__ import annotations

import math
import re
import statistics
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.cli import main
from seismass.runs.scene_file import read_scene
from seismass.show.assessment.page_input import live_case
from seismass.show.explore import explorer_html
from seismass.show.explore import page as compiled

MINUS = "\N{MINUS SIGN}"
READY = "document.querySelector('.explorer').dataset.found !== undefined"
FOUND = "document.querySelector('.explorer').dataset.found === document.querySelector('.explorer').dataset.shown"
SHOWN = "Number(document.querySelector('.explorer').dataset.shown || 0)"
CASES = [
    "",
    "n=4&T=0.57&R=6&a=1.5,1.5,1.5,0&s=0.15,0.15,0.15,0.15&k=0.15,0.15,0.15,0.15&m=synthetic-3&x=1.4&h=3.2",
    "n=2&T=0.38&by=hand&V=0.31,0.17&a=0.5,1&s=0.4,0.3&k=0.3,0.15&m=synthetic-5&z=0.03&O=1.5&r2=0.1",
    "n=1&T=0.8&by=elastic&a=2&s=0.1&k=0.1&m=synthetic-7&c=0.6",
]


@pytest.fixture(scope="module")
def html() -> str:
    """The page; without a compiled kernel what opens it is skipped."""
    if not (Path(compiled.__file__).parent / compiled.NAME).is_file():
        pytest.skip("the kernel is not compiled to WebAssembly (make explorer): the live page is not opened")
    return explorer_html()


def until(page: Any, expression: str) -> None:
    """Wait until it is true; Playwright's own waiting makes code of text, which the policy of the page refuses."""
    end = time.monotonic() + 60.0
    while not page.evaluate(expression):
        assert time.monotonic() < end, expression
        page.wait_for_timeout(10)


def settled(page: Any, *, folded: bool = False) -> None:
    """Wait for the effective fraction of the case that was chosen last, which is solved at the next frame; unfold all
    quantities and numbers.
    """
    until(page, READY)
    if not folded:
        page.evaluate("document.querySelectorAll('details').forEach(each => { each.open = true; })")
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done())))")
    until(page, FOUND)


def visit(page: Any, address: str) -> None:
    """Open another case by the address of the page, as a link does."""
    before = page.evaluate(SHOWN)
    page.evaluate("address => { location.hash = address; }", address)
    until(page, f"{SHOWN} > {before}")
    settled(page)


def set_value(page: Any, label: str, value: float) -> None:
    field = page.get_by_label(label, exact=True)
    field.fill(str(value))
    field.press("Enter")


def rows(page: Any, table: str) -> list[list[str]]:
    """Cells of the body of a table, with plain signs."""
    expression = "rows => rows.map(row => Array.from(row.cells, cell => cell.textContent))"
    found = page.locator(f"table.{table} tbody tr").evaluate_all(expression)
    return [[cell.replace(MINUS, "-") for cell in row] for row in found]


def exported(page: Any, tmp_path: Path) -> Path:
    """The scene file that the page gives."""
    with page.expect_download() as download:
        page.get_by_role("button", name="Download scene file").click()
    file = tmp_path / download.value.suggested_filename
    download.value.save_as(file)
    return file


def is_rounded(shown: list[str], exact: list[str]) -> bool:
    """Whether numbers are other ones with fewer digits, to half of the last; other text is the same."""

    def places(text: str) -> int:
        return len(text.partition(".")[2])

    assert len(shown) == len(exact)
    for one, other in zip(shown, exact, strict=True):
        if not re.fullmatch(r"-?[\d.]+", one):
            assert one == other
        else:
            assert abs(float(one) - float(other)) <= 0.501 * (10.0 ** -places(one) + 10.0 ** -places(other))
            assert len(one) >= 3 or one == other
    return True


def printed(lines: list[str], first: str) -> list[list[str]]:
    """Rows of a table that `seismass run` printed, by the first word of its head."""
    start = next(i for i, line in enumerate(lines) if line.split()[:1] == [first])
    body = []
    for line in lines[start + 1 :]:
        if not line.strip():
            break
        body.append(line.split())
    return body


def test_the_link_of_a_calculation_page_opens_the_same_building(html: str, open_page: Any, tmp_path: Path) -> None:
    """Floors, heights and springs that differ, P-Delta, the site: the same scene, and the same share to its digits."""
    tables = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {
            "period_s": 0.5,
            "height_m": 4.0,
            "area_m2": 500.0,
            "dead_load_kpa": 5.0,
            "p_delta": True,
            "yield_shear_over_weight": 0.2,
        },
        "goods": {"live_load_kpa": 6.0, "mu_s": 0.3, "mu_k": 0.2},
        "storeys": [{"overstrength": 1.5}, {"live_load_kpa": 0.0, "dead_load_kpa": 4.0, "height_m": 3.5}],
    }
    result = sm.assess(tables, sm.builtin_suite("seven"), mu_factors=(1.0, 1.0))
    case, reasons, differences = live_case(result)
    assert case is not None
    assert reasons == ()
    assert differences == ()
    with open_page(html, "live") as page:
        settled(page)
        visit(page, case.address)
        fraction, remark = page.locator(".fraction").inner_text(), page.locator(".of-file").inner_text()
        ticks = page.locator(".ticks").inner_text()
        scene = read_scene(exported(page, tmp_path)).scene
        set_value(page, "Damping ratio", 0.04)
        settled(page)
        assert page.locator(".of-file").inner_text().endswith("The case was changed since.")
    own = result.building.scene()
    assert scene.building is not None
    assert own.building is not None
    found = result.effective["real"]
    assert fraction.startswith(f"Effective fraction {found.value:.3f} (90 % interval")
    assert f"says {100 * found.value:.0f} % (" in remark
    assert remark.endswith("under 7 motions. Here it is the same.")
    assert "this model" not in ticks
    np.testing.assert_allclose(scene.geometric_stiffness, own.geometric_stiffness / own.building.mass.mean(), rtol=1e-9)
    for name in ("period", "stiffness", "yield_shear", "overstrength"):
        # The live page has masses of 1 kg: forces and stiffnesses are over the mass.
        one, other = (
            np.array(building.periods[0])
            if name == "period"
            else getattr(building, name) / (1.0 if name == "overstrength" else building.mass.sum())
            for building in (scene.building, own.building)
        )
        np.testing.assert_allclose(one, other, rtol=1e-9)
    assert [block.floor for block in scene.blocks] == [block.floor for block in own.blocks]
    assert (scene.blocks[0].mu_s, scene.blocks[0].mu_k) == (0.3, 0.2)
    assert scene.blocks[0].mass == pytest.approx(own.blocks[0].mass / own.building.mass.mean(), rel=1e-9)


def test_page_is_as_every_page_must_be(html: str, look: Any) -> None:
    def prepare(page: Any) -> None:
        settled(page, folded=True)
        page.locator(".time").evaluate("e => { e.value = 8.5; e.dispatchEvent(new Event('input')); }")

    look(html, "explorer", prepare)


@pytest.mark.parametrize("address", CASES)
def test_numbers_are_those_of_seismass_run(
    html: str, open_page: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str], address: str
) -> None:
    """Each cell of the storeys and of the goods is what the command prints for the scene file, rounded."""
    with open_page(html, "explorer", accept_downloads=True) as page:
        settled(page)
        if address:
            visit(page, address)
        storeys, goods = rows(page, "storeys"), rows(page, "goods")
        events = page.locator(".events").inner_text()
        file = exported(page, tmp_path)
    assert main(["run", str(file)]) == 0
    lines = capsys.readouterr().out.splitlines()
    # storey, peak drift, of height, at, residual, peak shear / W, floor acceleration: the columns of the command.
    assert all(map(is_rounded, [row[:7] for row in storeys], printed(lines, "storey")))
    assert all(map(is_rounded, goods, [row[1:] for row in printed(lines, "block")]))
    counts = next(line for line in lines if line.split()[:1] == ["events"]).split(maxsplit=1)[1]
    assert events == f"Events where goods slide: {counts}."
    # The models' drifts are those of the package.
    scene = sm.read_scene(file)
    share = float(re.search(r"(?:^|&)c=([\d.]+)", address)[1]) if "c=" in address else 0.25
    for column, attached in ((7, share), (8, 1.0)):
        model = sm.simulate(sm.attached_scene(scene.scene, attached), scene.motion)
        assert is_rounded([row[column] for row in storeys], [f"{1e3 * drift:.6f}" for drift in model.peak_drift])


def test_fraction_is_that_of_the_package(html: str, open_page: Any, tmp_path: Path) -> None:
    """At another intensity than 1, in the words that `EffectiveMass.text` has."""
    suite = sm.builtin_suite("seven")
    factors = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7(), between=False).factors
    with open_page(html, "explorer", accept_downloads=True) as page:
        settled(page)
        visit(page, "x=0.8&n=2&T=0.4&a=1,0.5&s=0.25,0.25&k=0.2,0.2&R=3")
        words = page.locator(".fraction").inner_text()
        table = rows(page, "suite")
        file = exported(page, tmp_path)
    scene = sm.read_scene(file).scene
    expected = sm.effective_mass(
        scene, [record.scaled(factor * 0.8) for record, factor in zip(suite, factors, strict=True)]
    )
    assert expected.interval is not None
    low, high = expected.interval
    assert words.startswith(
        f"Effective fraction {expected.value:.3f} (90 % interval over the built-in motions {low:.2f} to {high:.2f}). "
    )
    assert expected.kind == "root"
    assert "One share gives the drift of the building whose goods slide." in words
    rule = expected.by_hand
    formula = rule.formula.replace(" - ", " \N{MINUS SIGN} ")
    assert (
        f"By hand: {formula} = {rule.estimate:.3f}; C1 = S_a/R_y^(2/3) = {rule.coefficient:.3f}, "
        f"S_a = {rule.spectral_acceleration_g:.3f} g, R_y = {rule.yield_reduction:.2f}" in words
    )
    # Drifts of the package are over the height.
    height = float(scene.building.heights[0])
    names = ("real", "model", "model_at_0", "model_at_1")
    for row, storey in zip(table, expected.storeys.iter_rows(named=True), strict=True):
        assert is_rounded(row[1:5], [f"{1e3 * height * storey[name]:.6f}" for name in names])
        ratios = ("ratio", "ratio_at_0", "ratio_at_1", "envelope_ratio")
        assert is_rounded(row[5:], [f"{storey[name]:.6f}" for name in ratios])


def test_link_opens_the_same_case(html: str, open_page: Any) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        page.get_by_label("4", exact=True).check()
        set_value(page, "Static friction mu_s", 0.37)
        set_value(page, "Goods of floor 4 over its mass", 0.5)
        set_value(page, "First period T (s, without goods)", 0.61)
        page.get_by_label("by hand").check()
        set_value(page, "Yield shear of storey 2 over the weight", 0.222)
        page.get_by_label("Record", exact=True).select_option("synthetic-4")
        settled(page)
        address = page.evaluate("location.hash")
        shown = [rows(page, table) for table in ("storeys", "goods", "suite", "motions")]
        words = page.locator(".answer").inner_text()
    assert "n=4" in address
    assert "0.222" in address
    with open_page(html, "explorer") as page:
        settled(page)
        assert rows(page, "storeys") != shown[0]
        visit(page, address)
        assert [rows(page, table) for table in ("storeys", "goods", "suite", "motions")] == shown
        assert page.locator(".answer").inner_text() == words
        assert page.get_by_label("First period T (s, without goods)").input_value() == "0.61"
        page.get_by_role("button", name="Start again").click()
        until(page, f"{SHOWN} >= 3")
        settled(page)
        assert len(rows(page, "storeys")) == 3


def problems(page: Any) -> list[str]:
    """The messages that are shown beside fields."""
    return [text for text in page.locator(".wrong").all_inner_texts() if text]


def test_what_is_out_of_range_is_said_beside_its_field_and_not_taken(html: str, open_page: Any) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        before = rows(page, "storeys")
        field = page.get_by_label("First period T (s, without goods)")
        set_value(page, "First period T (s, without goods)", -3)
        assert field.get_attribute("aria-invalid") == "true"
        assert problems(page) == ["first period must be from 0.05 to 5; got -3"]
        described = field.get_attribute("aria-describedby")
        assert page.locator(f"#{described}").inner_text() == problems(page)[0]
        gap = page.locator(f"#{described}").bounding_box()["y"] - field.bounding_box()["y"]
        assert 0 < gap < 80
        assert rows(page, "storeys") == before
        set_value(page, "First period T (s, without goods)", 0.5)
        until(page, f"{SHOWN} >= 2")
        assert field.get_attribute("aria-invalid") is None
        assert problems(page) == []
        field.fill("77")
        page.get_by_label("Damping ratio", exact=True).focus()
        assert problems(page) == []
        assert field.input_value() == "0.5"
        visit(page, "n=7&m=file:mine.AT2")
        said = page.locator(".problem").inner_text()
        assert said.startswith(
            "storeys in the address must be from 1 to 4; got 7. The record file:mine.AT2 of this link"
        )


def test_an_address_that_cannot_be_read_is_named(html: str, open_page: Any) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        visit(page, "m=%")
        assert page.locator(".problem").inner_text() == "the record in the address cannot be read: %."
        assert len(rows(page, "storeys")) == 3


def test_a_number_counts_when_it_is_complete(html: str, open_page: Any) -> None:
    """Each key stroke of 0.35 is a number; none but the last is solved, and kinetic friction keeps its ratio."""
    with open_page(html, "explorer") as page:
        settled(page)
        visit(page, "s=0.2&k=0.15")
        shown = page.evaluate(SHOWN)
        field = page.get_by_label("Static friction mu_s", exact=True)
        field.focus()
        page.keyboard.press("Control+A")
        page.keyboard.type("0.35", delay=20)
        assert page.evaluate(SHOWN) == shown
        page.keyboard.press("Enter")
        settled(page)
        assert [row[2] for row in rows(page, "goods")] == ["0.35/0.263", "0.35/0.263"]
        # Goods stay on the floors that had them, whatever is typed on the way.
        field = page.locator("#x-massRatio")
        field.fill("0")
        field.press("Enter")
        settled(page)
        assert not page.locator("table.goods").is_visible()
        field.fill("0.5")
        field.press("Enter")
        settled(page)
        assert [row[:2] for row in rows(page, "goods")] == [["1", "0.5"], ["2", "0.5"]]


def test_a_slider_that_comes_back_brings_its_case_back(html: str, open_page: Any) -> None:
    move = """value => {
      const slider = document.querySelector('.row[data-key=muS] input');
      slider.value = value;
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    }"""
    with open_page(html, "explorer") as page:
        settled(page)
        visit(page, "s=0.2&k=0.15")
        before = rows(page, "goods"), page.locator(".fraction").inner_text()
        for value in ("0.05", "0", "0.2"):
            page.evaluate(move, value)
            settled(page)
        assert (rows(page, "goods"), page.locator(".fraction").inner_text()) == before


def test_back_and_undo_return_to_the_case_before(html: str, open_page: Any) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        first = rows(page, "storeys")
        page.wait_for_timeout(1100)
        set_value(page, "R (V_y = V_e/R)", 2)
        settled(page)
        assert rows(page, "storeys") != first
        page.get_by_role("button", name="Undo").click()
        until(page, f"{SHOWN} >= 3")
        settled(page)
        assert rows(page, "storeys") == first
        page.wait_for_timeout(1100)
        page.get_by_label("Drawn beside it").select_option("full")
        settled(page)
        assert "d=full" in page.evaluate("location.hash")
        page.go_back()
        settled(page)
        until(page, "document.querySelector('#x-beside').value === 'code'")


def test_a_statement_belongs_to_one_file_and_its_header_goes_first(html: str, open_page: Any, tmp_path: Path) -> None:
    silent, headed, other = tmp_path / "silent.txt", tmp_path / "headed.txt", tmp_path / "csmip.v2"
    silent.write_text("0.1\n0.2\n-0.1\n0.05\n")
    headed.write_text("Units: cm/s2, dt = 0.005\n10\n200\n-100\n50\n")
    other.write_text("Corrected accelerogram data  CSMIP\nchan 1: 90 deg\n 1 2 3\n")
    with open_page(html, "explorer") as page:
        settled(page)
        upload = page.get_by_label("Your own")
        upload.set_input_files(silent)
        until(page, "!document.querySelector('.unstated').hidden")
        page.get_by_label("Unit of the file").select_option("g")
        page.get_by_label("Its step (s)").fill("0.01")
        page.get_by_label("Its step (s)").press("Enter")
        until(page, f"{SHOWN} >= 2")
        assert "at 0.01 s, PGA 0.200 g" in page.locator(".motion").inner_text()
        upload.set_input_files(headed)
        until(page, f"{SHOWN} >= 3")
        assert "at 0.005 s, PGA 0.204 g" in page.locator(".motion").inner_text()
        upload.set_input_files(other)
        until(page, "document.querySelector('.wrong:not([hidden])') !== null")
        assert problems(page)[0].startswith("csmip.v2 seems to be a file of CSMIP")
        assert "seismass records" in problems(page)[0]
        page.get_by_label("Record", exact=True).select_option("synthetic-2")
        settled(page)
        assert problems(page) == []


def test_the_answer_stands_first_and_its_numbers_can_be_dragged(html: str, open_page: Any) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        assert page.locator(".share").inner_text() == "66 %"
        bar = page.locator(".share-bar").get_attribute("aria-label")
        assert bar.startswith("Effective fraction 66 %, interval 56 % to 77 %; codes: ASCE 7-10 25 %")
        # Shares of codes are those of the goods present: of 0.8 of the design live load, and of those at most all.
        visit(page, "o=0.8&c=0.3125")
        ticks = page.locator(".ticks span").all_inner_texts()
        assert ticks == ["ASCE 7-10 31 %", "NBC\N{DAGGER} 75 %", "EC 8\N{DAGGER} 100 %"]
        assert page.locator("#x-code option:checked").inner_text().startswith("ASCE/SEI 7-10")
        assert page.locator(".unchecked").is_hidden()
        page.locator("#x-code").select_option("0.6")
        settled(page)
        assert page.locator(".unchecked").is_visible()
        visit(page, "")
        number = page.get_by_role("slider", name="Static friction", exact=True)
        assert number.inner_text() == "0.2"
        number.focus()
        page.keyboard.press("ArrowRight")
        settled(page)
        assert number.inner_text() == "0.21"
        box = number.bounding_box()
        page.mouse.move(box["x"] + 5, box["y"] + 5)
        page.mouse.down()
        page.mouse.move(box["x"] + 29, box["y"] + 5)  # 24 of 240 points: a tenth of the slider's range, 0.1
        page.mouse.up()
        settled(page)
        assert number.inner_text() == "0.31"
        assert [row[2] for row in rows(page, "goods")] == ["0.31", "0.31"]


@pytest.mark.parametrize("number", range(1, 7))
def test_a_story_says_what_its_case_shows(html: str, open_page: Any, number: int) -> None:
    """Its sentence against the tables and the headline, what is drawn beside, the storey counted, where it starts."""
    with open_page(html, "explorer", reduced_motion="no-preference") as page:
        settled(page)
        page.locator(".play").click()
        page.locator(".stories button").nth(number - 1).click()
        page.wait_for_timeout(100)
        settled(page)
        assert page.locator(".problem").is_hidden()
        share = page.locator(".share").inner_text()
        said, asks = page.locator(".story").inner_text(), page.locator(".asks").inner_text()
        assert asks.endswith("Not yet.")
        slid = [row[1] for row in rows(page, "motions")].count("yes")
        storeys, suite = rows(page, "storeys"), rows(page, "suite")
        if number <= 3:
            assert f"{share} of them act as mass" in said if slid else "all of them act as mass" in said
            words = {0: "under any of the 7 motions", 7: "under all 7 motions"}
            assert words.get(slid, f"under {slid} of the 7 motions") in said
            # Where the sentence says that goods slide, they slide under the motion that is shown.
            shows = page.locator(".answer").inner_text()
            assert ("Goods slide on" in shows) == (slid > 0)
            assert ("No goods slide" in shows) == (slid == 0)
        elif number <= 5:
            curve = page.locator(".curve").get_attribute("aria-label")
            at_code = float(re.search(r"([\d.]+) with the share of the code", curve)[1])
            apart = round(100 * (1 / at_code - 1))
            assert said.startswith(f"{share} of the goods act as mass and the code counts 25 %")
            found = re.search(r"drifts (\d+) % (more|less) than", said)
            assert abs(int(found[1]) * (1 if found[2] == "more" else -1) - apart) <= 1
        else:
            assert said.startswith(f"Storey 4, the highest, drifts {suite[3][5]} times the model with {share} of")
            assert f"{suite[3][8]} times the larger of the two" in said
            assert page.locator("#x-beside").input_value() == "share"
            assert page.locator("#x-counter").input_value() == "4"
        counted = int(page.locator("#x-counter").input_value())
        clock = float(page.locator(".clock").inner_text().split()[0])
        assert clock == pytest.approx(max(0.0, float(storeys[counted - 1][3]) - 3.0), abs=0.011)


WIDTHS = (320, 360, 390, 430, 480, 560, 640, 680, 720, 768, 810, 834, 900, 1024, 1280, 1920)
ROOM = """() => {
  const found = [];
  const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  if (wide > 0) found.push(`${wide} px to scroll sideways`);
  for (const frame of document.querySelectorAll("fieldset")) {
    const end = frame.getBoundingClientRect().right + 0.5;
    for (const part of frame.querySelectorAll("input, select, label, th, td")) {
      const name = part.ariaLabel || part.textContent;
      if (part.getBoundingClientRect().right > end) found.push(`${name} leaves its frame`);
    }
  }
  const words = Array.from(document.querySelectorAll(".ticks span, .handle span"), (part) => {
    const range = document.createRange();
    range.selectNodeContents(part);
    return [part.textContent, range.getBoundingClientRect()];
  });
  const before = (a, b) => a.right <= b.left || a.bottom <= b.top;
  const meet = (a, b) => a.width > 0 && b.width > 0 && !before(a, b) && !before(b, a);
  for (const [i, [one, a]] of words.entries()) {
    for (const [other, b] of words.slice(i + 1)) {
      if (meet(a, b)) found.push(`${one} lies on ${other}`);
    }
  }
  for (const part of document.querySelectorAll("button, input, select, summary, .handle")) {
    const box = part.getBoundingClientRect();
    const small = box.width > 0 && Math.min(box.width, box.height) < 23.9;
    if (small) found.push(`${part.ariaLabel || part.textContent} is ${box.width} x ${box.height}`);
  }
  return found;
}"""


@pytest.mark.parametrize("storeys", [1, 4])
def test_no_width_cuts_or_covers_anything(html: str, open_page: Any, storeys: int) -> None:
    """At 16 widths, unfolded, with the shares of codes and one of its own; on a phone it is at most twelve screens."""
    with open_page(html, "explorer", reduced_motion="reduce") as page:
        settled(page)
        visit(page, f"n={storeys}&a=1.5,0.2,2,0.7&c=0.3&s=0.15&k=0.1")
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 800})
            page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done())))")
            assert page.evaluate(ROOM) == [], width
            assert page.evaluate("document.documentElement.scrollHeight") <= 12 * 800, width


def test_on_a_phone_the_building_is_in_sight_while_a_slider_is_moved(html: str, open_page: Any) -> None:
    with open_page(html, "explorer", width=360, reduced_motion="reduce", has_touch=True) as page:
        page.set_viewport_size({"width": 360, "height": 800})
        settled(page)
        slider = page.get_by_label("Damping ratio, slider")
        slider.evaluate("e => e.scrollIntoView({ block: 'end' })")
        picture = page.locator(".picture").bounding_box()
        assert picture["y"] >= 0
        assert picture["height"] >= 200
        assert slider.bounding_box()["y"] > picture["y"] + picture["height"]
        before = page.evaluate("document.querySelector('.buildings').toDataURL()")
        slider.press("End")
        settled(page)
        assert page.evaluate("document.querySelector('.buildings').toDataURL()") != before


def drag(page: Any, place: Any, right: float, down: float) -> None:
    """Drag a handle by its upper edge."""
    box = place.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + 4
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right / 2, y + down / 2)
    page.mouse.move(x + right, y + down)
    page.mouse.up()


def test_the_building_is_changed_by_its_handles(html: str, open_page: Any) -> None:
    """By dragging and by keys: the height of a block, the grip beside it, goods on an empty floor; Ctrl+Z undoes."""
    with open_page(html, "explorer", reduced_motion="reduce") as page:
        settled(page)
        mass = page.get_by_role("slider", name="Mass of the goods on floor 1, over the floor mass")
        assert (mass.get_attribute("aria-valuenow"), mass.get_attribute("aria-valuemax")) == ("1", "2")
        high = page.evaluate("document.querySelector('figure.animation').places.blocks[0].high")
        page.wait_for_timeout(1100)
        drag(page, mass, 0, -30)  # 30 of 150 points for a range of 2
        settled(page)
        assert mass.get_attribute("aria-valuenow") == "1.4"
        assert page.evaluate("document.querySelector('figure.animation').places.blocks[0].high") > high
        assert [row[1] for row in rows(page, "goods")] == ["1.4", "1"]
        mass.press("ArrowDown")
        settled(page)
        assert [row[1] for row in rows(page, "goods")] == ["1.35", "1"]
        grip = page.get_by_role("slider", name="Friction of the goods")
        drag(page, grip, 20, 0)  # 20 of 200 points for a range of 1
        grip.press("ArrowRight")
        settled(page)
        assert [row[2] for row in rows(page, "goods")] == ["0.31", "0.31"]
        roof = page.get_by_role("slider", name="Mass of the goods on floor 3, over the floor mass")
        assert roof.inner_text() == "+"
        roof.press("PageUp")
        settled(page)
        assert [row[:2] for row in rows(page, "goods")] == [["1", "1.35"], ["2", "1"], ["3", "0.5"]]
        while not page.get_by_role("button", name="Undo").is_disabled():
            page.keyboard.press("Control+z")
            settled(page)
        assert [row[:3] for row in rows(page, "goods")] == [["1", "1", "0.2"], ["2", "1", "0.2"]]
        # A storey that is tapped is the one whose drift is counted.
        page.locator(".buildings").click(position={"x": 20, "y": 300})
        settled(page)
        assert "y=2" in page.evaluate("location.hash")


def test_the_ground_is_pushed_by_hand(html: str, open_page: Any) -> None:
    """What the pointer does is the record of a run that goes on while it is pushed and until it has come to rest."""
    with open_page(html, "explorer", reduced_motion="reduce") as page:
        settled(page)
        share = page.locator(".share").inner_text()
        ground = page.get_by_role("slider", name="The ground, cm to the side")
        box = ground.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        for number in range(16):
            page.mouse.move(x + (30 if number % 4 < 2 else -30), y)
            page.wait_for_timeout(60)
        places = "document.querySelector('figure.animation').places"
        moved = page.evaluate(f"{places}.middle - {places}.left - {places}.width / 2")
        assert 1.0 < abs(moved) < 60.0
        assert float(page.locator(".clock").inner_text().split()[0]) > 0.5
        page.mouse.up()
        ground.press("ArrowLeft")
        until(page, "document.querySelector('.answer').textContent.startsWith('Under your push')")
        settled(page)
        assert float(rows(page, "storeys")[0][1]) > 1.0  # mm
        assert page.locator(".share").inner_text() == share
        assert page.get_by_label("Record", exact=True).input_value() == "your push"


def test_the_race_names_the_nearest_and_is_saved_and_filmed(html: str, open_page: Any, tmp_path: Path) -> None:
    with open_page(html, "explorer", accept_downloads=True) as page:
        settled(page)
        page.wait_for_timeout(300)
        said = page.locator(".winner").inner_text()
        found = re.match(
            r"Under synthetic-1 the model with (\d+) % .*its storey 1 drifts (\d+) % (more|less) than", said
        )
        assert found is not None
        file = exported(page, tmp_path)
        scene = sm.read_scene(file)
        real = sm.simulate(scene.scene, scene.motion).peak_drift[0]
        shares = (0.0, 0.25, 0.6, 0.8, 1.0)
        ratios = [
            sm.simulate(sm.attached_scene(scene.scene, share), scene.motion).peak_drift[0] / real for share in shares
        ]
        nearest = min(range(5), key=lambda i: abs(ratios[i] - 1.0))
        assert int(found[1]) == round(100 * shares[nearest])
        assert int(found[2]) * (1 if found[3] == "more" else -1) == round(100 * (ratios[nearest] - 1.0))
        with page.expect_download() as download:
            page.get_by_role("button", name="Save as picture").click()
        download.value.save_as(tmp_path / "race.png")
        assert (tmp_path / "race.png").read_bytes().startswith(b"\x89PNG")
        with page.expect_download() as download:
            page.get_by_role("button", name="Film of 8 s").click()
        download.value.save_as(tmp_path / "race.webm")
        film = (tmp_path / "race.webm").read_bytes()
        assert film.startswith(b"\x1aE\xdf\xa3")  # EBML, as WebM has it
        assert 50_000 < len(film) < 5_000_000


def test_a_drift_beyond_belief_is_remarked_and_the_enlargement_stated(html: str, open_page: Any) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        assert page.locator(".belief").is_hidden()
        assert re.fullmatch(r"[\d.]+ \u00d7, to fit", page.locator(".factor option").first.inner_text())
        visit(page, "x=20")
        assert "% of the storey height is beyond what buildings survive" in page.locator(".belief").inner_text()


def test_a_building_that_collapses_has_no_share_and_no_nearest_model(html: str, open_page: Any, tmp_path: Path) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        visit(page, "n=3&by=hand&V=0.06,0.05,0.04&P=1&x=2.5&a=1,1,0.5&h=3")
        said = page.locator(".answer").inner_text()
        collapsed = re.match(r"Under synthetic-1 at intensity 2\.5: storey (\d) collapses at ([\d.]+) s, where", said)
        assert collapsed is not None
        scene = sm.read_scene(exported(page, tmp_path))
        own = sm.simulate(scene.scene, scene.motion)
        assert own.collapsed_storey == int(collapsed[1])
        assert own.end_time == pytest.approx(float(collapsed[2]), abs=0.0051)
        assert "got a collapse under 7 of 7 motions" in page.locator(".fraction").inner_text()
        assert page.locator(".share").inner_text() == "not solved"
        assert page.locator(".winner").inner_text().endswith("collapses: there are no drifts to compare.")
        assert page.locator(".belief").is_hidden()
        drawn = page.evaluate("document.querySelector('figure.animation').places.xs")
        assert len(drawn) == 4
        assert all(map(math.isfinite, drawn))
        visit(page, "")
        assert page.locator(".share").inner_text() == "66 %"


def test_without_a_script_there_is_a_picture_and_a_sentence(html: str, open_page: Any) -> None:
    with open_page(html, "explorer", java_script_enabled=False) as page:
        assert page.locator(".still svg").is_visible()
        assert "66 % of the goods act as mass" in page.locator(".still figcaption").inner_text()
        assert not page.locator(".controls").is_visible()
        assert not page.get_by_label("Player").is_visible()


def test_goods_by_keyboard_and_friction_at_most_static(html: str, open_page: Any) -> None:
    with open_page(html, "explorer") as page:
        settled(page)
        visit(page, "s=0.2&k=0.15")
        slider = page.get_by_label("Kinetic friction mu_k, slider")
        slider.focus()
        for _ in range(7):
            page.keyboard.press("ArrowRight")
        settled(page)
        # mu_k is at most mu_s, which stays.
        assert [row[2] for row in rows(page, "goods")] == ["0.2", "0.2"]
        set_value(page, "Kinetic friction mu_k", 0.3)
        assert problems(page) == ["kinetic friction must be at most static friction, 0.2; got 0.3"]
        set_value(page, "Goods of floor 1 over its mass", 0)
        set_value(page, "Goods of floor 2 over its mass", 0)
        settled(page)
        assert page.locator(".fraction").inner_text() == "There are no goods on the floors, and so no share of them."
        assert not page.locator("table.goods").is_visible()
        assert not page.locator("table.suite").is_visible()


def test_answer_is_said_once_in_words(html: str, open_page: Any) -> None:
    """The live region changes after the reader pauses, not with each step of a slider."""
    with open_page(html, "explorer") as page:
        settled(page)
        region = page.locator(".answer")
        assert region.get_attribute("role") == "status"
        page.evaluate("""() => {
          window.said = [];
          const observer = new MutationObserver(() => window.said.push(1));
          observer.observe(document.querySelector('.answer'), { childList: true });
        }""")
        slider = page.get_by_label("R, slider")
        slider.focus()
        for _ in range(8):
            page.keyboard.press("ArrowLeft")
        settled(page)
        assert 1 <= page.evaluate("window.said.length") <= 3
        assert re.match(
            r"Under synthetic-1 at intensity 1: largest drift [\d.]+ mm \([\d.]+ % of the height\) in storey 1\. S",
            region.inner_text(),
        )
        assert re.search(r"Over the built-in motions \d+ % of the goods act as mass", region.text_content())


@pytest.mark.parametrize("kind", ["at2", "columns"])
def test_own_record_is_taken_from_a_file(html: str, open_page: Any, tmp_path: Path, kind: str) -> None:
    record = sm.builtin_record("synthetic-9")
    file = tmp_path / ("own.AT2" if kind == "at2" else "own.txt")
    if kind == "at2":
        assert record.source is not None
        file.write_text(record.source.read_text())
    else:
        in_g = record.acceleration / sm.STANDARD_GRAVITY
        file.write_text("".join(f"{i * record.dt:.3f} {value:.9f}\n" for i, value in enumerate(in_g.tolist())))
    with open_page(html, "explorer", accept_downloads=True) as page:
        settled(page)
        page.get_by_label("Your own").set_input_files(file)
        if kind == "columns":
            until(page, "!document.querySelector('.unstated').hidden")
            assert problems(page)[0].startswith("unit of own.txt must be given")
            page.get_by_label("Unit of the file").select_option("g")
        until(page, f"{SHOWN} >= 2")
        settled(page)
        assert problems(page) == []
        assert page.get_by_label("Record", exact=True).input_value() == f"file:{file.name}"
        scene = sm.read_scene(exported(page, tmp_path))
        shown = rows(page, "storeys")
    read = sm.read_record(file, unit="g")
    assert scene.motion.acceleration.tolist() == read.acceleration.tolist()
    assert scene.motion.dt == read.dt
    peaks = sm.simulate(scene.scene, read).peak_drift
    assert is_rounded([row[1] for row in shown], [f"{1e3 * peak:.6f}" for peak in peaks])


def test_it_plays_when_it_is_opened_unless_less_motion_is_preferred(html: str, open_page: Any) -> None:
    """And goes on from where it is when another case is solved; the dots of the loops follow."""
    clock = "parseFloat(document.querySelector('.clock').textContent)"
    loops = "document.querySelector('.loops').toDataURL()"
    with open_page(html, "explorer") as page:
        settled(page)
        assert page.evaluate(clock) >= float(rows(page, "storeys")[0][3]) - 3.01  # s before the largest drift
        until(page, f"{clock} > 6")
        before, drawn = page.evaluate(clock), page.evaluate(loops)
        page.get_by_label("2", exact=True).check()
        until(page, f"{SHOWN} >= 2")
        assert page.evaluate(clock) >= before
        page.locator(".play").click()
        page.locator(".loops").scroll_into_view_if_needed()
        until(page, f"{loops} !== '{drawn}'")
    with open_page(html, "explorer", reduced_motion="reduce") as page:
        settled(page)
        still = page.evaluate(clock)
        page.wait_for_timeout(200)
        assert page.evaluate(clock) == still == pytest.approx(float(rows(page, "storeys")[0][3]), abs=0.006)
        page.locator(".loops").scroll_into_view_if_needed()
        page.wait_for_timeout(100)
        drawn = page.evaluate(loops)
        page.locator(".time").evaluate("e => { e.value = 9.5; e.dispatchEvent(new Event('input')); }")
        assert page.evaluate(loops) != drawn


@pytest.mark.parametrize("width", [1280, 360])
def test_page_is_fast(html: str, open_page: Any, width: int) -> None:
    """Printed and not asserted: time to the first picture, from opening the page to the first changed answer, and from
    moves of a slider to the picture (median).
    """
    with open_page(html, "explorer", width=width) as page:
        until(page, f"{SHOWN} >= 1")
        page.get_by_role("slider", name="Static friction", exact=True).press("ArrowRight")
        until(page, f"{SHOWN} >= 2")
        guessed = page.evaluate("performance.now()")
        until(page, FOUND)
        changed = page.evaluate("performance.now()")
        loaded = page.evaluate("performance.getEntriesByName('first picture')[0].startTime")
        measure = """async value => {
          const slider = document.querySelector('.row[data-key=period] input');
          const root = document.querySelector('.explorer');
          const before = root.dataset.shown;
          const start = performance.now();
          slider.value = value;
          slider.dispatchEvent(new Event('input', { bubbles: true }));
          while (root.dataset.shown === before) await new Promise((done) => requestAnimationFrame(done));
          return performance.now() - start;
        }"""
        taken = [page.evaluate(measure, f"{0.4 + 0.01 * step:.2f}") for step in range(21)]
    print(
        f"{width} px: first picture {loaded:.0f} ms after the page was asked for, a changed answer {changed:.0f} ms, "
        f"its first estimate {guessed:.0f} ms; a slider moved: {statistics.median(taken):.1f} ms"
    )
    assert len(taken) == 21
