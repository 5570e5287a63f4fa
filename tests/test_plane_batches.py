"""Batches of scenes in two directions: one table with what is of vectors and of each direction."""

from __future__ import annotations

import numpy as np
import polars as pl
import pytest

import seismass as sm

PAIRS = [pair.scaled(1.5) for pair in (sm.records.builtin_pairs()[2], sm.records.builtin_pairs()[5])]
BUILDING = sm.Building.uniform(2, 0.5, mass=1e4, heights=[3.4, 2.7], yield_shear_over_weight=[0.2, 0.12])
GOODS = sm.blocks_on_floors([0.5, 0.5], mu=0.3)
PLANE = sm.Scene(BUILDING, GOODS, other_direction=True)


def test_rows_are_those_of_single_runs() -> None:
    table = sm.simulate_many([PLANE], PAIRS, threads=2)
    for row, pair in zip(table.iter_rows(named=True), PAIRS, strict=True):
        run = sm.simulate(PLANE, pair)
        # Both come from the same call of the kernel: equal to the bit.
        for name in ("peak_drift", "peak_floor_acceleration", "peak_storey_shear", "peak_slip", "peak_base_shear"):
            values = getattr(run, name)
            assert [row[f"{name}_x"], row[f"{name}_y"], row[name]] == [values[..., axis].tolist() for axis in range(3)]
        for name in ("residual_drift", "residual_slip"):
            assert [row[f"{name}_x"], row[f"{name}_y"]] == getattr(run, name).T.tolist()
            np.testing.assert_allclose(row[name], np.hypot(*getattr(run, name).T), rtol=1e-15)
        assert row["slip_path"] == run.slip_path.tolist()
        assert row["events"] == sum(run.counts.values())
        np.testing.assert_allclose(row["peak_drift_ratio_x"], np.array(row["peak_drift_x"]) / [3.4, 2.7], rtol=1e-15)
    assert table.equals(sm.simulate_many([PLANE], PAIRS, threads=1))


def test_scenes_of_one_direction_and_of_two_stand_in_one_table() -> None:
    alone = sm.Scene(BUILDING, GOODS)
    motions = [PAIRS[0].first, PAIRS[0]]
    told: list[tuple[int, int]] = []
    table = sm.simulate_many(
        [PLANE, alone], motions, pairs=[(2, 1), (1, 2)], progress=lambda done, total: told.append((done, total))
    )
    assert told[-1] == (2, 2)
    assert table["peak_drift_x"].null_count() == 1
    ordinary = sm.simulate_many(alone, motions[0])
    assert table.head(1).select(ordinary.columns).drop("scene").equals(ordinary.drop("scene"))
    frames = list(sm.stream_many([PLANE, alone], motions, pairs=[(2, 1), (1, 2)], chunk=1))
    assert pl.concat(frames).equals(table)


def test_racks_and_stops_have_columns_of_directions() -> None:
    goods = [sm.RackBlock(1, mass=2e3, mu=0.1, stops=sm.Stops(0.002, 1e7))]
    racked = sm.Scene(BUILDING, racks=[sm.Rack(1, 1, period=0.3, level_mass=500.0, blocks=goods)], other_direction=True)
    row = sm.simulate_many([racked], PAIRS[:1]).row(0, named=True)
    run = sm.simulate(racked, PAIRS[0])
    assert [row[f"peak_rack_drift{axis}"] for axis in ("_x", "_y", "")] == run.peak_rack_drift.T.tolist()
    assert [row[f"peak_contact_force_{axis}"] for axis in "xy"] == run.peak_contact_force.T.tolist()
    assert row["peak_contact_force"] == [run.peak_contact_force.max()]


def test_a_pair_alone_is_one_motion() -> None:
    assert sm.simulate_many(PLANE, PAIRS[0]).height == 1
    with pytest.raises(sm.errors.InvalidMotion, match="dt of motion in y"):
        sm.simulate_many(PLANE, [(sm.Motion([0.0, 1.0], 0.01), sm.Motion([0.0, 1.0], 0.02))])
