"""Figures of runs in which nothing happens say so; those of many storeys, floors and series stay legible."""

from __future__ import annotations

import numpy as np
import polars as pl
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import seismass as sm

RECORD = sm.builtin_record("synthetic-1")
RIGID = sm.Scene(
    sm.Building.uniform(2, 0.3, mass=1e5, yield_shear_over_weight=9.0), sm.blocks_on_floors([0.5, 0.5], mu=0.9)
)


def words(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts if text.get_gid() == "nothing"]


def said(figure: Figure) -> list[str]:
    return [text for axes in figure.axes for text in words(axes)]


@pytest.fixture(scope="module")
def still() -> sm.Response:
    """A tenth of a motion under friction of 0.9 and a strength of nine times the weight: drift, and nothing else."""
    response = sm.simulate(RIGID, RECORD.scaled(0.1), histories=True)
    assert not response.peak_slip.any()
    return response


def test_what_does_not_slide_or_yield_is_said(still: sm.Response) -> None:
    assert said(still.plot.events()) == ["does not yield"] * 2 + ["does not slide"] * 2
    assert said(still.plot.slip()) == ["does not slide"] * 2
    assert [axes.get_title(loc="left") for axes in still.plot.slip().axes] == ["block 2, floor 2", "block 1, floor 1"]
    assert said(still.plot.slip(ax=Figure().add_subplot())) == ["does not slide"]  # once where lines share axes
    assert said(still.plot.slip_path(points=5)) == ["nothing slides"]
    assert [words(axes) for axes in still.plot.profile().axes] == [[], [], [], ["nothing slides"]]
    assert said(still.plot.drift()) == said(still.plot.loops()) == []


def test_a_run_at_rest_has_nothing_to_show() -> None:
    rest = sm.simulate(RIGID, sm.Motion([0.0] * 4, dt=0.1), histories=True)
    assert said(rest.plot.drift()) == ["does not drift"] * 2
    assert said(rest.plot.acceleration()) == ["is not accelerated"] * 2
    assert said(rest.plot.loops()) == ["does not drift"] * 2
    assert said(rest.plot.energy(points=3)) == ["no energy"]
    assert said(rest.plot.profile()) == ["no drift", "no acceleration", "no shear", "nothing slides"]


@pytest.fixture(scope="module")
def tall() -> sm.Response:
    building = sm.Building.uniform(12, 1.2, mass=1e5, yield_shear_over_weight=np.linspace(0.15, 0.06, 12))
    return sm.simulate(sm.Scene(building), RECORD, histories=True)


def test_loops_of_many_storeys_wrap(tall: sm.Response) -> None:
    figure = tall.plot.loops()
    rows, columns = figure.axes[0].get_gridspec().get_geometry()
    assert (rows, columns) == (3, 4)
    assert figure.get_size_inches()[0] < 12.0
    assert [axes.get_title() for axes in figure.axes] == [f"storey {number}" for number in range(1, 13)]
    labelled = [axes.get_title() for axes in figure.axes if axes.get_ylabel()]
    assert labelled == ["storey 1", "storey 5", "storey 9"]
    assert len(tall.plot.loops(storeys=[1, 2, 3, 4, 5]).axes) == 5  # three and two, none empty


def test_spectra_of_many_floors_can_be_told_apart(tall: sm.Response) -> None:
    """Panels of six floors, no look twice in one of them; in one Axes of a caller no look twice at all."""
    figure = tall.plot.floor_spectra(periods=np.linspace(0.1, 2.0, 20))
    panels = [[line.get_label() for line in axes.lines if str(line.get_label())[0] != "_"] for axes in figure.axes]
    assert panels == [
        ["ground", *(f"floor {number}" for number in range(7, 13))],
        ["ground", *(f"floor {number}" for number in range(1, 7))],
    ]
    own = Figure().add_subplot()
    tall.plot.floor_spectra(periods=[0.2, 0.5], ax=own)
    looks = [(line.get_color(), line.get_linestyle()) for line in own.lines if "floor" in str(line.get_label())]
    assert len(set(looks)) == 12
    assert len(tall.plot.floor_spectra(floors=[1, 2, 3], periods=[0.2, 0.5]).axes) == 1


def test_points_of_series_at_one_place_are_all_seen() -> None:
    """Open marks, each smaller than that below it."""
    table = pl.DataFrame(
        {"status": ["completed"] * 6, "x": [1.0, 2.0] * 3, "y": [3.0, 4.0] * 3, "of": [1, 1, 2, 2, 3, 3]}
    )
    lines = sm.plots.scatter(table, "x", "y", by="of").axes[0].lines
    sizes = [line.get_markersize() for line in lines]
    assert sizes == sorted(sizes, reverse=True)
    assert len(set(sizes)) == 3
    assert {line.get_markerfacecolor() for line in lines} == {"none"}


def test_the_figure_of_a_slip_demand_is_no_wider_than_a_page() -> None:
    """8.4 inches, whether or not there are fragilities; these stand below, over the whole width."""
    scene = sm.Scene(sm.Building.uniform(1, 0.4), sm.blocks_on_floors([0.5], mu=0.1))
    suite = sm.builtin_suite("seven")[:3]
    two = sm.slip.slip_demand(scene, suite).plot()
    three = sm.slip.slip_demand(scene, suite, clearance=0.05, fragility=True).plot()
    assert [figure.get_size_inches()[0] for figure in (two, three)] == [8.4, 8.4]
    assert [len(figure.axes) for figure in (two, three)] == [2, 3]
    for figure in (two, three):
        assert figure.legends
        assert "mm of slip at 84 % of the motions" in figure.axes[0].get_title(loc="left")


def test_demands_and_fragilities_of_nothing() -> None:
    suite = sm.builtin_suite("seven")[:2]
    rough = sm.Scene(sm.Building.uniform(1, 0.4), sm.blocks_on_floors([0.5], mu=50.0))
    assert said(sm.slip.slip_demand(rough, suite).plot()) == ["nothing slides in the building", "nothing slides"]
    table = pl.DataFrame(
        {"status": ["completed"] * 4, "motion": [1, 1, 2, 2], "scale": [1.0, 2.0] * 2, "peak_drift": [0.1, 0.2] * 2}
    )
    assert said(sm.plots.fragility(table, 0.5, "scale", "peak_drift")) == ["never exceeded"]
    assert said(sm.plots.fragility(table, 0.05, "scale", "peak_drift")) == ["always exceeded"]
