"""What values show of themselves in a notebook: well-formed, without script and ids, escaped, saying what they hold."""

from __future__ import annotations

import re
import subprocess
import sys
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import seismass as sm

G = sm.STANDARD_GRAVITY
BUILDING = sm.Building.uniform(3, 0.6, mass=2e4, yield_shear_over_weight=[0.24, 0.20, 0.12], heights=[3.7, 3.1, 2.9])
SCENE = sm.Scene(
    BUILDING,
    [
        sm.Block(1, mass_ratio=0.5, mu=0.3),
        sm.Block(1, mass=3e4, mu_s=0.4, mu_k=0.3),
        sm.Block(3, mass_ratio=2.0, mu=0.2),
        sm.Block(0, mass=10.0, mu=0.3),
    ],
    name="<script>alert(1)</script>",
    note='a "note" & more',
)
TALL = sm.Building.uniform(30, 3.0, yield_shear_over_weight=np.linspace(0.2, 0.05, 30))
RECORD = sm.builtin_record("synthetic-1")
VALUES: dict[str, Any] = {
    "building": BUILDING,
    "elastic": sm.Building.uniform(2, 0.5),
    "scene": SCENE,
    "tall": sm.Scene(TALL, sm.blocks_on_floors([1.0] * 30, 0.3)),
    "ground": sm.Scene(None, [sm.Block(0, mass=10.0, mu=0.1)]),
    "record": RECORD,
    "suite": sm.builtin_suite(),
    "response": sm.simulate(SCENE, RECORD, histories=True),
    "peaks": sm.simulate(SCENE, RECORD.motion),
    "block": sm.simulate(sm.Scene(None, [sm.Block(0, mass=10.0, mu=0.1)]), RECORD, histories=True),
    "storeys": sm.simulate(sm.Scene(TALL, sm.blocks_on_floors([1.0] * 30, 0.3)), RECORD),
    "target": sm.TargetSpectrum.asce7(),
    "mean": sm.TargetSpectrum.mean_of(sm.builtin_suite("seven")),
}


def analysis_text(name: str) -> str:
    return "".join(ET.fromstring(VALUES[name]._repr_html_()).itertext()).replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize("name", list(VALUES))
def test_html_is_small_well_formed_and_stands_beside_others(name: str) -> None:
    html = VALUES[name]._repr_html_()
    root = ET.fromstring(html)
    assert root.tag == "div"
    assert not {"script", "style", "link", "img"} & {element.tag for element in root.iter()}
    assert not any(key in element.attrib for element in root.iter() for key in ("id", "href", "src", "onclick"))
    assert not re.search(r"https?:|url\(", html)
    drawings = list(root.iter("svg"))
    assert all(drawing.attrib["role"] == "img" and drawing.attrib["aria-label"] for drawing in drawings)
    assert len(drawings) >= (0 if name in ("peaks", "storeys") else 1)
    # Colours are that of the text around, or one of two accents, so that both backgrounds do.
    colours = {value for element in root.iter() for key in ("fill", "stroke") if (value := element.attrib.get(key))}
    assert colours <= {"currentColor", "none", "#0072B2", "#D55E00"}
    assert len(html) < 32_000


def test_coordinates_are_inside_their_drawing() -> None:
    for name in ("building", "scene", "tall", "ground", "response", "target"):
        for drawing in ET.fromstring(VALUES[name]._repr_html_()).iter("svg"):
            _, _, width, height = map(float, drawing.attrib["viewBox"].split())
            for rect in drawing.iter("rect"):
                x, y, w, h = (float(rect.attrib[key]) for key in ("x", "y", "width", "height"))
                assert x >= 0.0
                assert y >= 0.0
                assert x + w <= width
                assert y + h <= height
            for points in drawing.iter("polyline"):
                at = np.array([pair.split(",") for pair in points.attrib["points"].split()], dtype=float)
                assert (at >= 0.0).all()
                assert (at <= [width, height]).all()


def test_scene_says_what_it_is_made_of() -> None:
    text = analysis_text("scene")
    assert "<script>alert(1)</script>: 3 storeys, T1 = 0.6 s, 4 blocks" in text
    assert 'a "note" & more' in text
    for part in ("0.5 of the floor's", "30000 kg", "0.4, kinetic 0.3", "ground", "V_y/W = 0.24", "mass 60 t"):
        assert part in text
    heights = [text.index(f"{height} m, V_y/W") for height in ("3.7", "3.1", "2.9")]
    assert heights == sorted(heights)
    assert len(list(ET.fromstring(SCENE._repr_html_()).iter("rect"))) == 4
    assert "and 18 more" in analysis_text("tall")
    assert "springs elastic" in analysis_text("elastic")


def test_areas_of_goods_are_as_their_mass() -> None:
    """Blocks 1 and 2 stand on one floor, with 0.5 and 3e4 / 2e4 = 1.5 of its mass."""
    first, second = list(ET.fromstring(SCENE._repr_html_()).iter("rect"))[1:3]
    areas = [float(rect.attrib["width"]) * float(rect.attrib["height"]) for rect in (first, second)]
    assert areas[1] / areas[0] == pytest.approx(3.0, rel=0.01)  # coordinates have 0.1 px


def test_response_says_its_peaks() -> None:
    response, text = VALUES["response"], analysis_text("response")
    assert text.startswith("Response, completed at 36 s: <script>alert(1)</script>, synthetic-1")
    for number in range(3):
        assert f"storey {number + 1}{1e3 * response.peak_drift[number]:.4g} mm" in text
    for number in range(4):
        # The largest of the column is 1.709 mm: four digits, and the same decimals for the others.
        assert f"{1e3 * response.peak_slip[number]:.3f} mm" in text
    assert f"drift of storey 1 over 36 s, peak {1e3 * response.peak_drift[0]:.3g} mm" in text
    assert "slip of block 1 over 36 s" in analysis_text("block")
    assert "the 12 that drift most of 30" in analysis_text("storeys")


def test_suite_has_a_row_and_a_curve_for_each_record() -> None:
    root = ET.fromstring(VALUES["suite"]._repr_html_())
    assert len(list(root.iter("svg"))) == len(VALUES["suite"]) == 11
    for record in VALUES["suite"]:
        assert record.name in analysis_text("suite")
        assert f"{record.pga_g:.3f} g" in analysis_text("suite")


def test_target_says_its_ordinates() -> None:
    target = VALUES["target"]
    assert f"Sa(1 s) {target([1.0])[0] / G:.3g} g" in analysis_text("target")
    assert target.label in analysis_text("target")


def test_effective_mass_shows_its_answer_on_a_line() -> None:
    result = sm.effective_mass(
        sm.Scene(BUILDING, sm.blocks_on_floors([1.0, 1.0, 0.0], 0.12)), sm.builtin_suite("seven")
    )
    root = ET.fromstring(result._repr_html_())
    dot = next(root.iter("circle"))
    assert float(dot.attrib["cx"]) == pytest.approx(20.0 + 540.0 * result.value, abs=0.06)
    assert result.interval is not None
    bar = next(root.iter("rect"))
    low, width = float(bar.attrib["x"]), float(bar.attrib["width"])
    assert (low - 20.0) / 540.0 == pytest.approx(result.interval[0], abs=2e-4)
    assert (low + width - 20.0) / 540.0 == pytest.approx(result.interval[1], abs=3e-4)
    assert f"Effective fraction {result.value:.3f}" in "".join(root.itertext())


def test_sketches_need_no_matplotlib() -> None:
    program = """
import sys, seismass as sm
scene = sm.Scene(sm.Building.uniform(2, 0.5), [sm.Block(1, mass_ratio=1, mu=0.3)])
response = sm.simulate(scene, sm.builtin_record("synthetic-1"), histories=True)
for value in (scene, scene.building, response, sm.builtin_suite(), sm.TargetSpectrum.asce7()):
    value._repr_html_()
print("matplotlib" in sys.modules)
"""
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert found.strip() == "False"


def test_the_card_of_a_record_marks_its_peak() -> None:
    """The largest absolute sample, here a negative one: its value in g, its time, and a mark below the middle."""
    samples = np.zeros(40)
    samples[[5, 11, 30]] = 1.0, -3.0, 2.0
    record = sm.Record(samples, 0.02, name="three peaks")
    html = record._repr_html_()
    assert f"accelerations, peak {3.0 / sm.STANDARD_GRAVITY:.4f} g at 0.22 s" in html
    circle, line = (
        re.search(r'<circle cx="([\d.]+)" cy="([\d.]+)"', html),
        re.search(r'viewBox="0 0 (\d+) (\d+)"', html),
    )
    assert circle is not None
    assert line is not None
    width, height = float(line[1]), float(line[2])
    assert float(circle[1]) == pytest.approx(11.5 / 40.0 * width, abs=0.1)
    assert float(circle[2]) > 0.5 * height
