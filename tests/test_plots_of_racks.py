"""Figures of scenes with racks, walls and stops: what they draw is what the response holds."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from matplotlib.axes import Axes

import seismass as sm

G = sm.STANDARD_GRAVITY


@pytest.fixture(scope="module")
def response() -> sm.Response:
    """Storeys, a wall, two racks on two floors, and stops on a floor and on a rack; everything happens."""
    frame = sm.Building([2e4] * 2, 2e7, yield_shear=[1.2e5, 6e4], heights=3.5)
    building = sm.design.Wall.of_alpha_h(frame, 4.0).beside(frame)
    goods = [sm.RackBlock(level, mass=2000.0, mu=0.2) for level in (1, 2)]
    rail = sm.Stops(0.03, stiffness=2e6, damping=2e3)
    railed = [sm.RackBlock(1, mass=3000.0, mu=0.15, stops=rail), sm.RackBlock(2, mass=3000.0, fixed=True)]
    racks = [
        sm.Rack(2, levels=2, level_mass=300.0, period=0.5, yield_shear=8e3, blocks=goods),
        sm.Rack(1, levels=3, level_mass=300.0, period=0.3, blocks=railed),
    ]
    blocks = [sm.Block(1, mass=8000.0, mu=0.1, stops=sm.Stops([0.05, 0.02], stiffness=5e6))]
    scene = sm.Scene(building, blocks, racks=racks, name="racks")
    found = sm.simulate(scene, sm.builtin_record("synthetic-1").scaled(1.3), histories=True, energy=True)
    assert found.counts["touch_stop"] > 0
    assert found.counts["yield"] > 0
    return found


def peaks(axes: Axes) -> list[float]:
    return [float(abs(line.get_ydata()[0])) for line in axes.lines if line.get_gid() == "peak"]


def test_rack_drift(response: sm.Response) -> None:
    """Racks of 2 and 3 levels: five panels, the lowest level of the first rack below; peaks in continuous time."""
    figure = response.plot.rack_drift()
    panels = figure.axes[::-1]
    titles = [axes.get_title(loc="left") for axes in panels]
    expected = ["rack 1 level 1", "rack 1 level 2", "rack 2 level 1", "rack 2 level 2", "rack 2 level 3"]
    assert [title.partition(":")[0] for title in titles] == expected
    histories = np.hstack(response.rack_drift)
    of_kernel = np.concatenate(response.peak_rack_drift)
    for number, axes in enumerate(panels):
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), 1e3 * histories[:, number])
        assert peaks(axes) == [pytest.approx(1e3 * of_kernel[number])]
    # The log numbers levels on from the two storeys: level 1 of rack 1 yields, which is 3.
    log = response.event_log
    yields = log["time"][(log["kind"] == "yield") & (log["number"] == 3)]
    assert len(yields) > 0
    drawn = [line for line in panels[0].lines if line.get_marker() == "^"]
    np.testing.assert_array_equal(drawn[0].get_xdata(), yields)
    assert len(response.plot.rack_drift(racks=2).axes) == 3
    with pytest.raises(sm.errors.InvalidOption, match="racks of rack drift figure must be numbers counted from 1 to 2"):
        response.plot.rack_drift(racks=3)


def test_rack_profile(response: sm.Response) -> None:
    figure = response.plot.rack_profile()
    drift, acceleration, force, slip = figure.axes
    for rack in (0, 1):
        levels = np.arange(1, len(response.peak_rack_drift[rack]) + 1)
        for axes, values in (
            (drift, 1e3 * response.peak_rack_drift[rack]),
            (acceleration, response.peak_rack_acceleration[rack] / G),
            (force, 1e-3 * response.peak_rack_shear[rack]),
        ):
            np.testing.assert_allclose(axes.lines[rack].get_xdata(), values, rtol=1e-15)
            np.testing.assert_array_equal(axes.lines[rack].get_ydata(), levels)
    # Blocks 2 and 3 stand on the levels of rack 1, block 4 on level 1 of rack 2; the fixed one is not numbered.
    np.testing.assert_allclose(slip.lines[0].get_xdata(), 1e3 * response.peak_slip[1:3])
    np.testing.assert_array_equal(slip.lines[0].get_ydata(), [1, 2])
    np.testing.assert_allclose(slip.lines[1].get_xdata(), [1e3 * response.peak_slip[3]])


def test_contacts(response: sm.Response) -> None:
    """Blocks 1 and 4 have stops; the largest velocity drawn is the peak that the kernel keeps."""
    figure = response.plot.contacts()
    panels = figure.axes[::-1]
    log = response.events.filter(kind="touch_stop")
    for number, axes in zip((1, 4), panels, strict=True):
        own = log.filter(number=number)
        drawn = next(line for line in axes.lines if line.get_marker() == "p")
        np.testing.assert_array_equal(drawn.get_xdata(), own["time"])
        np.testing.assert_allclose(drawn.get_ydata(), own["sign"] * own["velocity"].abs())
        fastest = response.peak_contact_velocity[number - 1]
        assert np.abs(drawn.get_ydata()).max() == pytest.approx(fastest, rel=1e-12)
        force = 1e-3 * response.peak_contact_force[number - 1]
        said = f"{own.height} contacts, at most {fastest:.3g} m/s and {force:.3g} kN"
        assert said in axes.get_title(loc="left")
    with pytest.raises(sm.errors.InvalidOption, match="blocks of figure of contacts must be some of 1, 4; got 2"):
        response.plot.contacts(blocks=[1, 2])
    without = sm.simulate(sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.2)]), sm.builtin_record("synthetic-1"))
    with pytest.raises(sm.errors.InvalidOption, match="must be that of a scene in which a block has stops"):
        without.plot.contacts()


def test_slip_shows_places_and_stops(response: sm.Response) -> None:
    figure = response.plot.slip()
    panels = figure.axes[::-1]
    titles = [axes.get_title(loc="left").partition(":")[0] for axes in panels]
    expected = ["floor 1", "rack 1 level 1", "rack 1 level 2", "rack 2 level 1"]
    assert titles == [f"block {number}, {place}" for number, place in enumerate(expected, start=1)]
    stops = [[line.get_ydata()[0] for line in axes.lines if line.get_gid() == "stop"] for axes in panels]
    np.testing.assert_allclose(stops[0], [-50.0, 20.0])  # mm, towards minus and plus
    np.testing.assert_allclose(stops[3], [-30.0, 30.0])
    assert not stops[1]
    assert not stops[2]
    alone = response.plot.slip(blocks=4).axes[0]
    assert sum(line.get_gid() == "stop" for line in alone.lines) == 2


def test_timeline_has_a_row_for_each_level(response: sm.Response) -> None:
    axes = response.plot.events().axes[0]
    rows = [label.get_text() for label in axes.get_yticklabels()]
    levels = ["rack 1 level 1", "rack 1 level 2", "rack 2 level 1", "rack 2 level 2", "rack 2 level 3"]
    assert rows[:7] == ["storey 1", "storey 2", *levels]
    assert rows[7:] == [f"block {n + 1}, {place}" for n, place in enumerate(["floor 1", *levels[:3]])]
    touches = next(line for line in axes.lines if line.get_gid() == "touch_stop")
    assert set(np.asarray(touches.get_ydata())) == {7.0, 10.0}


def test_what_chain_scenes_have(response: sm.Response) -> None:
    """Drift, acceleration, loops, spectra, profile, paths and energy of a general scene."""
    for name in ("drift", "acceleration", "loops", "floor_spectra"):
        assert len(getattr(response.plot, name)().axes) >= 1
    profile = response.plot.profile()
    np.testing.assert_allclose(profile.axes[3].lines[0].get_xdata(), [1e3 * response.peak_slip[0]])
    paths = response.plot.slip_path(points=3).axes[0]
    assert [line.get_label() for line in paths.lines][3] == "block 4, rack 2 level 1"
    assert paths.lines[3].get_ydata()[-1] == pytest.approx(1e3 * response.slip_path[3])
    energy = response.plot.energy(points=3).axes[0]
    assert energy.lines[0].get_ydata()[-1] == pytest.approx(1e-3 * response.energy["input"])
    # Bands are stacked, and their top is what came in.
    tops = [band.get_paths()[0].get_extents().y1 for band in energy.collections]
    assert max(tops) == pytest.approx(max(energy.lines[0].get_ydata()), rel=1e-6)
    assert "contact" in {band.get_gid() for band in energy.collections}


def test_the_card_of_a_notebook(response: sm.Response) -> None:
    card = response._repr_html_()
    for said in ("rack 1, floor 2", "rack 2, floor 1", "rack 1 level 2", "touch_stop"):
        assert said in card


def test_text_and_document(response: sm.Response) -> None:
    """Peaks of racks and slip by level, contacts with their velocity, and where everything is."""
    text = response.text
    velocity, force = response.peak_contact_velocity, 1e-3 * response.peak_contact_force
    touches = response.events.filter(kind="touch_stop")["number"].to_list()
    for number, place, clearance in ((1, "floor 1", "50 / 20"), (4, "rack 2 level 1", "30")):
        said = f"{place} +{clearance} +{touches.count(number)} +{velocity[number - 1]:.4g} +{force[number - 1]:.4g}"
        assert re.search(rf"^ +{number} +{said}$", text, re.MULTILINE)
    assert f"peak base shear {1e-3 * response.peak_base_shear:.4g} kN, springs and walls together" in text
    assert re.search(rf"^ +2 +1 +3 +{1e3 * response.peak_rack_drift[1][2]:.3f} ", text, re.MULTILINE)
    assert re.search(r"^ +3 +rack 1 level 2 +2000 ", text, re.MULTILINE)
    document = json.loads(response.to_json())
    assert document["goods"] == ["floor 1", "rack 1 level 1", "rack 1 level 2", "rack 2 level 1"]
    assert document["peak_rack_drift"] == [levels.tolist() for levels in response.peak_rack_drift]
    assert document["peak_rack_drift_time"] == [levels.tolist() for levels in response.peak_rack_drift_time]
    assert document["peak_slip"] == response.peak_slip.tolist()
    events = [event for event in document["events"] if event["kind"] == "touch_stop"]
    assert max(abs(event["velocity"]) for event in events) == pytest.approx(velocity.max(), rel=1e-12)
    assert all("velocity" not in event for event in document["events"] if event["kind"] == "slip")


def test_a_text_without_stops_has_no_contacts() -> None:
    rack = sm.Rack(0, levels=2, level_mass=100.0, period=0.6)
    response = sm.simulate(sm.Scene(None, racks=[rack]), sm.builtin_record("synthetic-1"), events=False)
    assert response.status == "completed"
    assert "contacts" not in response.text


def test_the_card_has_the_largest_peak_of_each_rack(response: sm.Response) -> None:
    """Of all levels, the drift in mm with its level, and the acceleration over g."""
    card = response._repr_html_()
    for number, floor in ((1, 2), (2, 1)):
        drift, acceleration = response.peak_rack_drift[number - 1], response.peak_rack_acceleration[number - 1]
        row = next(
            row for row in re.findall(r"<tr>.*?</tr>", card, re.DOTALL) if f"rack {number}, floor {floor}" in row
        )
        words = re.sub(r"<[^>]*>", " ", row)
        found = re.search(rf"rack {number}, floor {floor}\s+([\d.]+) mm\s+(\d)\s+([\d.]+) g", words)
        assert found is not None, words
        assert float(found[1]) == pytest.approx(1e3 * drift.max(), rel=1e-2)
        assert int(found[2]) == np.argmax(drift) + 1
        assert float(found[3]) == pytest.approx(acceleration.max() / G, rel=1e-2)
