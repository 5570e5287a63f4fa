"""The figure of goods from above: what is drawn is the run, at scale."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm
from seismass.show.plots import FloorPlan, Footprint, floor_paths

G = 9.80665
CRATES = sm.Scene(None, [sm.Block(0, mass=100.0, mu=mu) for mu in (0.1, 0.15)], other_direction=True)


def run(scene: sm.Scene = CRATES) -> sm.runs.PlaneResponse:
    x, y = (sm.Motion(np.full(51, a), dt=0.01) for a in (1.5, -2.0))
    return sm.simulate(scene, (x, y), histories=True)


def test_paths_are_those_of_the_run_and_edges_are_judged() -> None:
    """A crate slides 0.114 m against x and 0.152 m along y, from (0, 0): its side passes an edge at -0.7 m."""
    response = run()
    plan = FloorPlan((-0.7, -2.0, 4.0, 2.0), {1: Footprint(0.0, 0.0), 2: Footprint(2.0, 1.0, 0.5, 0.5)})
    figure = floor_paths(response, floor=0, plan=plan)
    plane, _ = figure.axes
    first, _, second, _ = plane.lines
    np.testing.assert_array_equal(first.get_xydata(), response.slip[:, 0])
    np.testing.assert_array_equal(second.get_xydata(), response.slip[:, 1] + [2.0, 1.0])
    assert plane.get_aspect() == 1.0
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels[-1].endswith("(magenta: beyond an edge or in an aisle)")
    wide = FloorPlan((-0.8, -2.0, 4.0, 2.0), plan.goods)
    assert floor_paths(response, floor=0, plan=wide).legends[0].get_texts()[-1].get_text() == "room they take"


def test_the_orbit_is_the_floor_over_the_ground() -> None:
    building = sm.Building.uniform(2, 0.4, mass=1e3)
    response = run(sm.Scene(building, sm.blocks_on_floors([0.1, 0.1], mu=0.2), other_direction=True))
    orbit = floor_paths(response, floor=2).axes[1].lines[0]
    np.testing.assert_allclose(orbit.get_xydata(), 1e3 * response.drift.sum(axis=1), rtol=1e-14)


def test_what_cannot_be_drawn_is_refused() -> None:
    response = run()
    with pytest.raises(sm.errors.InvalidOption, match="floor of floor plan must be one with goods on it; got 3"):
        floor_paths(response, floor=3)
    with pytest.raises(sm.errors.InvalidOption, match="goods of floor plan must be blocks of floor 0; got block 5"):
        floor_paths(response, floor=0, plan=FloorPlan((0.0, 0.0, 1.0, 1.0), {5: Footprint(0.0, 0.0)}))
    with pytest.raises(sm.errors.InvalidOption, match="width of footprint"):
        Footprint(0.0, 0.0, width=0.0)
    with pytest.raises(sm.errors.InvalidOption, match="histories"):
        floor_paths(sm.simulate(CRATES, response.motions), floor=0)


def test_the_legend_shows_lines_as_they_are_drawn() -> None:
    figure = floor_paths(run(), floor=0)
    handles = {handle.get_label(): handle for handle in figure.legends[0].legend_handles}
    drawn, marked = figure.axes[0].lines[:2]
    path = handles["path, farthest point"]
    assert (path.get_linewidth(), path.get_color()) == (drawn.get_linewidth(), drawn.get_color())
    assert (path.get_marker(), path.get_markersize()) == (marked.get_marker(), marked.get_markersize())
    assert all(handle.get_visible() and handle.get_linewidth() > 0.0 for handle in handles.values())
