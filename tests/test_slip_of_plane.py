"""Slip demand in two directions, against a crate on ground that accelerates along a diagonal."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import seismass as sm
from seismass.cli import main
from seismass.commands.slip import parse_clearance
from seismass.studies.slip import Clearance

G = 9.80665
CRATE = sm.Scene(None, [sm.Block(0, mass=100.0, mu=0.1)], other_direction=True)


def constant(a: float, samples: int = 51) -> sm.Motion:
    return sm.Motion(np.full(samples, a), dt=0.01)


def test_a_crate_slides_as_a_vector() -> None:
    """Against an acceleration of 2.5 m/s2 along (-3, 4)/5 by (2.5 - mu g) t^2/2; in x alone by (1.5 - mu g) t^2/2."""
    result = sm.slip.slip_demand(CRATE, [(constant(1.5), constant(-2.0))], clearance=Clearance(0.1, 0.1, reach=0.18))
    length, half = 0.5 * (2.5 - 0.1 * G) * 0.5**2, 0.5 * 0.5**2
    run = result.runs.row(0, named=True)
    expected = {
        "peak_slip": length,
        "peak_slip_x": 0.6 * length,
        "peak_slip_y": 0.8 * length,
        "slip_plus": 0.0,
        "slip_minus": 0.6 * length,
        "slip_plus_y": 0.8 * length,
        "slip_minus_y": 0.0,
        "residual_slip": length,
        "residual_slip_x": -0.6 * length,
        "slip_path": length,
        "one_direction_x": (1.5 - 0.1 * G) * half,
        "one_direction_y": (2.0 - 0.1 * G) * half,
        "acceleration_over_weight": 2.5 / G,
    }
    assert {name: run[name] for name in expected} == pytest.approx(expected, rel=1e-12, abs=1e-15)
    row = result.blocks.row(0, named=True)
    alone = expected["one_direction_x"] + expected["one_direction_y"]
    assert row["over_one_direction"] == pytest.approx(1.4 * length / alone, rel=1e-12)
    assert row["length_over_one_direction"] == pytest.approx(2.0 * length / alone, rel=1e-12)
    # 0.190 m in all, 0.114 m against x: that side and the reach are passed, the other side of x is not.
    assert dict(result.exceedance.select("side", "exceeding").rows()) == {"+": 0, "-": 1, "reach": 1, "any": 1}
    assert "slide in the plane" in result.remarks[0]
    assert "Peak slip by direction" in result.text
    assert result.estimates.height == 0


def test_after_a_collapse_the_ground_alone_has_its_acceleration() -> None:
    """Its length, sqrt(1.5^2 + 2^2) m/s2, under the crate on the ground; under goods on floors nothing is known."""
    building = sm.Building.uniform(2, 0.4, mass=1e3, heights=3.0)
    goods = [sm.Block(0, mass=100.0, mu=0.1), sm.Block(1, mass=100.0, mu=0.1), sm.Block(2, mass=100.0, mu=0.1)]
    scene = sm.Scene(building, goods, other_direction=True, collapse_drift=1e-5)
    runs = sm.slip.slip_demand(scene, [(constant(1.5), constant(-2.0))]).runs
    assert runs["collapsed"].to_list() == [True] * 3
    for column in ("attached_acceleration_g", "alone_acceleration_g"):
        ground, *floors = runs[column].to_list()
        assert ground == pytest.approx(2.5 / G, rel=1e-12), column
        assert all(value is None or np.isnan(value) for value in floors), column


def test_goods_on_racks_and_floors_of_a_building() -> None:
    building = sm.Building.uniform(1, 0.4, mass=1e4)
    goods = [sm.RackBlock(1, mass=500.0, mu=0.15)]
    rack = sm.Rack(1, 1, period=0.3, level_mass=200.0, other_direction={"period": 0.5}, blocks=goods)
    scene = sm.Scene(building, [sm.Block(1, mass=1e3, mu=0.2)], racks=[rack], other_direction=True)
    pair = sm.records.builtin_pairs()[2].scaled(2.0)
    result = sm.slip.slip_demand(scene, [pair], sizes=sm.slip.BlockSize(0.8, 1.0))
    run = sm.simulate(scene, pair)
    assert result.runs["peak_slip"].to_list() == run.peak_slip[:, 2].tolist()
    of_nodes = [run.peak_floor_acceleration[0, 2], run.peak_rack_acceleration[0, 2]]
    np.testing.assert_allclose(result.runs["floor_acceleration_g"], np.array(of_nodes) / G, rtol=1e-14)
    # Slips are within the mutual bounds of a vector and its directions.
    plane = result.runs.select("peak_slip_x", "peak_slip_y").to_numpy()
    assert np.all(result.runs["peak_slip"].to_numpy() >= plane.max(axis=1))
    assert result.squat.height == 2


def test_distances_in_y_and_fragilities_are_of_their_scenes() -> None:
    alone = sm.Scene(None, [sm.Block(0, mass=100.0, mu=0.1)])
    with pytest.raises(sm.errors.InvalidOption, match="of plus and minus alone where there is one direction"):
        sm.slip.slip_demand(alone, constant(1.5), clearance=Clearance(0.1, reach=0.2))
    with pytest.raises(sm.errors.InvalidScene, match="slip_demand with a fragility"):
        sm.slip.slip_demand(CRATE, [(constant(1.5), constant(2.0))], clearance=0.1, fragility=True)
    assert parse_clearance("0.2", plane=True) == Clearance(0.2, 0.2, 0.2, 0.2)
    assert parse_clearance("0.2,0.1,,0.3@0.5") == Clearance(0.2, 0.1, None, 0.3, 0.5)
    assert parse_clearance("@0.5").reach == 0.5


def test_the_command_takes_pairs_of_a_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = tmp_path / "crate.toml"
    scene.write_text("[other_direction]\n[[blocks]]\nfloor = 0\nmass = 100.0\nmu = 0.1\n")
    (tmp_path / "records").mkdir()
    for name, a in (("RSN1_A_000", 0.15), ("RSN1_A_090", 0.2)):
        rows = " ".join(f"{a:.7f}" for _ in range(50))
        head = f"PEER\nA, B, {name[-3:]}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 50, DT= .0100 SEC\n"
        (tmp_path / "records" / f"{name}.AT2").write_text(f"{head}{rows}\n")
    assert main(["slip", str(scene), "--records", str(tmp_path / "records"), "--clearance", "@0.1"]) == 0
    printed = capsys.readouterr().out
    assert "side reach   100 mm   1 of 1" in printed
    assert main(["slip", str(scene), "--suite", "seven"]) == 2
    assert "suite of pairs must be forty" in capsys.readouterr().err
