"""Figures of one run: what they draw is what the response holds, into new figures and into given axes."""

from __future__ import annotations

import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.text import Text

import seismass as sm
from pages.parts import Page
from pages.plots import FIGURES
from seismass.base.files import write_file
from seismass.media.svg import figure_content
from seismass.runs.response import EVENT_KINDS, ResponsePlots
from seismass.show.plots.histories import MARKS
from seismass.show.study.figures import study_figures
from seismass.studies.study import StudyParameters, run_study

ROOT = Path(__file__).parents[1]
G = sm.STANDARD_GRAVITY


def scene() -> sm.Scene:
    building = sm.Building.uniform(
        3,
        0.6,
        mass=2e4,
        yield_shear_over_weight=[0.24, 0.20, 0.12],
        overstrength=[2.1, 1.7, 1.9],
        second_slope=[0.05, 0.07, 0.037],
        third_slope=[0.0, 0.013, 0.007],
        heights=[3.9, 3.5, 2.9],
    )
    blocks = [sm.Block(1, mass_ratio=1.0, mu_s=0.13, mu_k=0.1), sm.Block(2, mass_ratio=0.7, mu_s=0.12, mu_k=0.083)]
    return sm.Scene(building, blocks, name="three storeys")


@pytest.fixture(scope="module")
def record() -> sm.Record:
    return sm.builtin_record("synthetic-1")


@pytest.fixture(scope="module")
def response(record: sm.Record) -> sm.Response:
    """Storeys yield and both blocks slide."""
    found = sm.simulate(scene(), record, histories=True, energy=True)
    assert found.counts["yield"] > 0
    assert (found.peak_slip > 0.0).all()
    return found


def test_a_response_refers_to_its_scene_motion_and_record(record: sm.Record) -> None:
    solved, motion = scene(), record.motion
    response = sm.simulate(solved, record, duration=5.0)
    assert response.scene is solved
    assert response.record is record
    assert response.motion == motion.with_duration(5.0)
    assert response.motion.duration == response.end_time
    of_motion = sm.simulate(solved, motion, duration=5.0)
    assert of_motion.record is None
    assert of_motion == response
    assert sm.simulate(solved, motion).motion is motion
    again = pickle.loads(pickle.dumps(response))
    assert again == response
    assert again.scene == solved
    assert again.record == record
    assert again.motion == response.motion


@pytest.mark.parametrize(
    ("draw", "array", "in_unit"),
    [
        (sm.plots.drift, "drift", lambda metres: 1e3 * metres),
        (sm.plots.slip, "slip", lambda metres: 1e3 * metres),
        (sm.plots.acceleration, "floor_acceleration", lambda acceleration: acceleration / G),
    ],
)
def test_histories_are_those_of_the_response(
    response: sm.Response, draw: Callable[..., Figure], array: str, in_unit: Callable[[Any], Any]
) -> None:
    """One panel each, from the lowest; the ring is the peak in continuous time."""
    values = in_unit(getattr(response, array))
    figure = draw(response)
    panels = figure.axes[::-1]
    assert len(panels) == values.shape[1]
    for number, axes in enumerate(panels):
        curve = axes.lines[0]
        np.testing.assert_array_equal(curve.get_xdata(), response.time)
        np.testing.assert_array_equal(curve.get_ydata(), values[:, number])
        peak = next(line for line in axes.lines if line.get_gid() == "peak")
        of_run, at = (getattr(response, f"peak_{array}{end}")[number] for end in ("", "_time"))
        assert abs(peak.get_ydata()[0]) == in_unit(of_run)
        assert peak.get_xdata()[0] == at
        assert "(" in axes.get_ylabel()
    # The same by the accessor, into axes that are given: one for all, and one each.
    same = Figure().add_subplot()
    assert getattr(response.plot, draw.__name__)(ax=same) is same.figure
    several = Figure().subplots(values.shape[1])
    assert draw(response, ax=several) is several[0].figure
    for number, axes in enumerate(several):
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), values[:, number])
        assert [line for line in same.lines if np.array_equal(line.get_ydata(), values[:, number])]
        assert axes.get_xlabel() == "time (s)"
    assert same.get_legend() is not None


def test_events_are_marked_when_they_happened(response: sm.Response) -> None:
    log = response.event_log
    axes = sm.plots.drift(response, storeys=1).axes[0]
    chosen = log["time"][(log["kind"] == "yield") & (log["number"] == 1)]
    marks = next(line for line in axes.lines if line.get_marker() == "^")
    np.testing.assert_array_equal(marks.get_xdata(), chosen)
    axes = sm.plots.slip(response, blocks=2, events=["stick"]).axes[0]
    chosen = log["time"][(log["kind"] == "stick") & (log["number"] == 2)]
    marks = next(line for line in axes.lines if line.get_marker() == "s")
    np.testing.assert_array_equal(marks.get_xdata(), chosen)
    without = sm.plots.slip(response, blocks=2, events=False).axes[0]
    assert {line.get_marker() for line in without.lines} == {"None", "o"}


def test_timeline_has_every_event_in_its_row(response: sm.Response) -> None:
    axes = sm.plots.events(response).axes[0]
    rows = [label.get_text() for label in axes.get_yticklabels()]
    assert rows == ["storey 1", "storey 2", "storey 3", "block 1, floor 1", "block 2, floor 2"]
    log = response.event_log
    drawn = {line.get_gid(): line for line in axes.lines if line.get_gid()}
    assert set(drawn) == {kind for kind, count in response.counts.items() if count}
    for kind, line in drawn.items():
        here = log[log["kind"] == kind]
        np.testing.assert_array_equal(line.get_xdata(), here["time"])
        first = 0 if kind in ("yield", "unload") else 3
        np.testing.assert_array_equal(line.get_ydata(), here["number"] - 1.0 + first)


def test_time_of_sliding_is_what_the_events_say() -> None:
    """A block on the ground under 2 m/s2 for 0.1 s: it slides from the first sample (mu g < 2) until it sticks."""
    block = sm.Scene(None, [sm.Block(0, mass=100.0, mu=0.1)])
    response = sm.simulate(block, sm.Motion([2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0], dt=0.1))
    stick = response.event_log["time"][response.event_log["kind"] == "stick"][0]
    bars = sm.plots.events(response).axes[0].collections[0]
    spans = np.array([path.vertices[:, 0] for path in bars.get_paths()])
    assert spans.min() == pytest.approx(0.0, abs=1e-12)
    assert spans.max() == pytest.approx(stick, rel=1e-12)


@pytest.mark.parametrize("number", [0, -1, 4, 1.5, True])
def test_storeys_are_counted_from_1_to_their_number(response: sm.Response, number: float) -> None:
    for several in (number, [1, number]):
        with pytest.raises(sm.errors.InvalidOption, match="storeys of drift figure must be "):
            response.plot.drift(storeys=several)
    assert [len(response.plot.drift(storeys=some).axes) for some in (1, [3], [1, 3])] == [1, 1, 2]


def test_figures_refuse_what_is_not_there(response: sm.Response) -> None:
    with pytest.raises(
        sm.errors.InvalidOption, match=r"storeys of drift figure must be numbers counted from 1 to 3; got 4"
    ):
        response.plot.drift(storeys=4)
    with pytest.raises(sm.errors.InvalidOption, match="events of slip figure must be True, False or some of"):
        response.plot.slip(events=["jump"])
    with pytest.raises(sm.errors.InvalidOption, match="ax of drift figure must be one Axes, or a list of 3 Axes"):
        response.plot.drift(ax=Figure().subplots(2))
    with pytest.raises(sm.errors.InvalidOption, match="histories of simulate must be asked for"):
        sm.simulate(scene(), sm.Motion([0.0, 1.0], 0.1)).plot.drift()
    with pytest.raises(sm.errors.InvalidOption, match="storeys of drift figure must be in a scene that has any"):
        sm.simulate(sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.3)]), sm.Motion([0.0], 0.1)).plot.drift()


def test_accessor_has_the_functions_of_the_module(response: sm.Response) -> None:
    methods = {name for name in vars(ResponsePlots) if not name.startswith("_")}
    assert methods <= set(sm.plots.__all__)
    for name in methods:
        said = " ".join(getattr(sm.plots, name).__doc__.split())
        assert said.startswith(" ".join(getattr(response.plot, name).__doc__.split()))


def ids(text: str) -> list[str]:
    return re.findall(r'\bid="([^"]*)"', text)


def test_inline_figures_stand_beside_each_other(response: sm.Response) -> None:
    drift, slip = (draw(response) for draw in (sm.plots.drift, sm.plots.slip))
    texts = [
        sm.plots.inline_svg(drift, "Drift <of> storeys", "Three panels & more."),
        sm.plots.inline_svg(slip, "Slip"),
        sm.plots.inline_svg(slip, "Slip", name="second"),
        sm.plots.inline_svg(sm.plots.energy(response, points=20), "Energies"),
    ]
    assert "<pattern" in texts[3]
    every = [one for text in texts for one in ids(text)]
    assert len(every) == len(set(every)) > 10
    for text in texts:
        root = ET.fromstring(text)
        assert root.tag == "svg"
        assert root.attrib["role"] == "img"
        referred = set(re.findall(r'url\(#([^)]*)\)|href="#([^"]*)"', text))
        assert {one for pair in referred for one in pair if one} <= set(ids(text))
        assert root.attrib["aria-labelledby"].split() == [
            root[n].attrib["id"] for n in range(len(root)) if n < 2 and root[n].tag in ("title", "desc")
        ]
        assert not {"script", "style", "metadata"} & {element.tag for element in root.iter()}
        assert not re.search(r"https?://", text)
    assert ET.fromstring(texts[0])[0].text == "Drift <of> storeys"
    assert ET.fromstring(texts[0])[1].text == "Three panels & more."
    said = "".join(element.text or "" for element in ET.fromstring(texts[0]).iter("text"))
    assert "storey 1: peak" in said
    assert "drift (mm)" in said


def test_svg_of_a_figure_is_the_same_every_time(response: sm.Response) -> None:
    first, second = (sm.plots.figure_svg(sm.plots.drift(response)) for _ in range(2))
    assert first == second
    assert "<metadata" not in first or "<dc:date>" not in first
    once, again = (sm.plots.inline_svg(sm.plots.drift(response), "Drift") for _ in range(2))
    assert once == again == sm.plots.inline_svg(first, "Drift")
    assert len(once) < 0.75 * len(first)


def test_inline_figures_refuse_what_makes_no_element() -> None:
    figure = Figure()
    with pytest.raises(sm.errors.InvalidOption, match="title of inline figure must be a text; got ''"):
        sm.plots.inline_svg(figure, "")
    with pytest.raises(sm.errors.InvalidOption, match=r"name of inline figure must be a letter, then"):
        sm.plots.inline_svg(figure, "Empty", name="1 2")
    with pytest.raises(
        sm.errors.InvalidOption, match=r"figure of inline figure must be a Figure, or SVG text; got 'none'"
    ):
        sm.plots.inline_svg("none", "Empty")
    with pytest.raises(sm.errors.InvalidOption, match=r"figure of SVG must be a matplotlib Figure; got None"):
        sm.plots.figure_svg(None)  # type: ignore[arg-type]


def test_loops_are_those_of_the_run_within_their_backbone(response: sm.Response) -> None:
    figure = sm.plots.loops(response)
    assert len(figure.axes) == 3
    building = response.scene.building
    assert building is not None
    for number, axes in enumerate(figure.axes):
        drawn = {line.get_gid(): line for line in axes.lines}
        np.testing.assert_array_equal(drawn["loop"].get_xdata(), 1e3 * response.drift[:, number])
        np.testing.assert_array_equal(drawn["loop"].get_ydata(), 1e-3 * response.storey_shear[:, number])
        way, force = drawn["backbone"].get_xdata(), 1e3 * drawn["backbone"].get_ydata()
        assert way[-1] == -way[0] == 1e3 * response.peak_drift[number]
        np.testing.assert_array_equal(force, -force[::-1])
        # Trilinear (Building): k to V_y, second slope to Omega V_y, then the third.
        k, v_y, drift = building.stiffness[number], building.yield_shear[number], 1e-3 * np.abs(way)
        omega, r2, r3 = [(2.1, 0.05, 0.0), (1.7, 0.07, 0.013), (1.9, 0.037, 0.007)][number]
        second = v_y + r2 * k * (drift - v_y / k)
        last = v_y / k * (1.0 + (omega - 1.0) / r2)
        third = omega * v_y + r3 * k * (drift - last)
        expected = np.where(drift > last, third, np.minimum(k * drift, second))
        np.testing.assert_allclose(np.abs(force), expected, rtol=1e-9)


def test_profile_has_the_peaks_and_limits(response: sm.Response) -> None:
    figure = sm.plots.profile(response, limits={"drift": 2.0})
    drift, acceleration, shear, slip = figure.axes
    ratio = response.peak_drift_ratio
    assert ratio is not None
    np.testing.assert_array_equal(drift.patches[0].get_data().values, 100.0 * ratio)
    assert drift.lines[0].get_xdata()[0] == 2.0
    floors = np.append(response.motion.pga, response.peak_floor_acceleration) / G
    np.testing.assert_array_equal(acceleration.lines[0].get_xdata(), floors)
    np.testing.assert_array_equal(acceleration.lines[0].get_ydata(), [0, 1, 2, 3])
    np.testing.assert_array_equal(shear.patches[0].get_data().values, 1e-3 * response.peak_storey_shear)
    np.testing.assert_array_equal(slip.lines[0].get_xdata(), 1e3 * response.peak_slip)
    with pytest.raises(
        sm.errors.InvalidOption, match="limits of profile must be for some of drift, acceleration; got 'slip'"
    ):
        sm.plots.profile(response, quantities=("drift", "acceleration"), limits={"slip": 10.0})
    with pytest.raises(
        sm.errors.InvalidOption, match="quantities of profile must be some of drift, acceleration, shear, slip"
    ):
        sm.plots.profile(response, quantities="velocity")
    with pytest.raises(sm.errors.InvalidOption, match="ax of profile must be a list of 4 Axes; got one Axes"):
        sm.plots.profile(response, ax=Figure().add_subplot())


def test_floor_spectra_are_exact_spectra_of_the_histories(response: sm.Response) -> None:
    periods = [0.1, 0.5, 1.0]
    axes = sm.plots.floor_spectra(response, floors=3, periods=periods).axes[0]
    roof = sm.Motion(response.floor_acceleration[:, 2], response.motion.dt)
    for line, motion in zip(axes.lines, (response.motion, roof), strict=False):
        np.testing.assert_array_equal(line.get_ydata(), sm.response_spectrum(motion, periods)[0] / G)
    thinned = sm.simulate(scene(), response.motion, histories=2)
    with pytest.raises(
        sm.errors.InvalidOption, match="histories of floor spectra must be True, a row at every sample; got 2"
    ):
        thinned.plot.floor_spectra()


def test_energies_end_with_those_of_the_response(response: sm.Response) -> None:
    """The stack is the balance: its top is the input at each time, to the residual of the balance."""
    axes = sm.plots.energy(response, points=20).axes[0]
    total = next(line for line in axes.lines if line.get_gid() == "input")
    assert total.get_xdata()[-1] == response.end_time
    assert total.get_ydata()[-1] == 1e-3 * response.energy["input"]
    tops = {band.get_gid(): band.get_paths()[0].vertices for band in axes.collections if band.get_gid()}
    assert set(tops) == {"viscous", "hysteretic", "friction", "elastic", "kinetic"}
    ends = {name: path[path[:, 0] == response.end_time, 1].max() for name, path in tops.items()}
    assert ends["viscous"] == pytest.approx(1e-3 * response.energy["viscous"], rel=1e-12)
    assert ends["hysteretic"] - ends["viscous"] == pytest.approx(1e-3 * response.energy["hysteretic"], rel=1e-12)
    assert ends["kinetic"] == pytest.approx(1e-3 * response.energy["input"], rel=1e-9)


def test_slip_paths_grow_to_those_of_the_response(response: sm.Response) -> None:
    axes = sm.plots.slip_path(response, points=20).axes[0]
    for number, line in enumerate(axes.lines):
        path = line.get_ydata()
        assert (np.diff(path) >= 0.0).all()
        assert path[0] == 0.0
        assert path[-1] == 1e3 * response.slip_path[number]
    with pytest.raises(
        sm.errors.InvalidOption, match="points of figure of slip paths must be a whole number of at least 2"
    ):
        sm.plots.slip_path(response, points=1)


def test_a_collapsed_run_is_drawn_to_its_end(record: sm.Record) -> None:
    building = scene().building
    assert building is not None
    weak = sm.Scene(building, [], collapse_drift=0.03)
    fallen = sm.simulate(weak, record, histories=True)
    assert fallen.status == "collapsed"
    for draw in (sm.plots.drift, sm.plots.acceleration, sm.plots.events, sm.plots.energy):
        assert draw(fallen).axes[0].get_xlim()[1] == pytest.approx(fallen.end_time, abs=record.dt)
    with pytest.raises(sm.errors.InvalidOption, match="response of floor spectra must be that of a completed run"):
        fallen.plot.floor_spectra()


def test_code_of_the_page_runs_and_its_figures_are_there() -> None:
    names = Page(ROOT / "docs" / "plots.md").example()
    assert all(isinstance(names[name], Figure) for name in FIGURES)
    page = (ROOT / "docs" / "plots.md").read_text(encoding="utf-8")
    shown = set(re.findall(r"\(figures/(\w+)\.png\)", page))
    assert shown == set(FIGURES.values())
    assert all((ROOT / "docs" / "figures" / f"{file}.png").is_file() for file in shown)
    response = names["response"]
    assert f"Storey 1 drifts most, {1e3 * response.peak_drift.max():.0f} mm." in page
    assert response.peak_drift.argmax() == 0
    rows = re.findall(r"^\| (`.*?) \|", page, re.MULTILINE)
    listed = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
    assert listed == {name for name in vars(ResponsePlots) if not name.startswith("_")}


def test_figures_of_a_study_are_drawn_once_for_each_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Their cost is in drawing and in finding places: one drawing a file, and places once for all drift profiles."""
    few = StudyParameters(buildings=((2, 0.38), (3, 0.47)), mass_ratios=(1.0,))
    result = run_study(sm.builtin_suite("seven"), sm.TargetSpectrum.asce7(), few)
    calls: list[str] = []

    def counted(owner: type, name: str) -> None:
        inner = getattr(owner, name)

        def outer(*args: Any, **kwargs: Any) -> Any:
            calls.append(name)
            return inner(*args, **kwargs)

        monkeypatch.setattr(owner, name, outer)

    counted(Figure, "draw")
    counted(ConstrainedLayoutEngine, "execute")
    figures = study_figures(result)
    assert calls == ["execute"] * 5  # spectrum, underestimation, heat map, slip, drift profiles
    assert len(figures) == 8
    calls.clear()
    for name, figure in figures.items():
        for kind in ("png", "svg"):
            write_file(tmp_path / f"{name}.{kind}", figure_content(figure, kind))
    assert calls == ["draw"] * 16
    places = [[axes.get_position().bounds for axes in figures[f"drift_R{factor}"].axes] for factor in (1, 2, 4, 6)]
    assert places[0] == places[1] == places[2] == places[3]
    assert not any("$" in text.get_text() for figure in figures.values() for text in figure.findobj(Text))


def test_series_differ_in_grey(response: sm.Response) -> None:
    """Lines in one panel have dashes of their own, and kinds of events a marker or a filling of their own."""
    axes = sm.plots.floor_spectra(response).axes[0]
    dashes = [(line.get_linestyle(), line._dash_pattern) for line in axes.lines[1:4]]
    assert len({str(one) for one in dashes}) == 3
    looks = {(mark["marker"], mark.get("markerfacecolor")) for mark in MARKS.values()}
    assert len(looks) == len(MARKS) == len(EVENT_KINDS)
