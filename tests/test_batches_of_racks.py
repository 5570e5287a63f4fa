"""Batches of scenes with racks, stops and matrices: every row is that of a single run."""

from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm

BUILDING = sm.Building([1000.0, 1200.0], [4e5, 3e5], yield_shear=[4000.0, 3000.0])
MOTIONS = [sm.builtin_record(f"synthetic-{number}").with_duration(12.0) for number in (1, 2, 3)]
OF_RACKS = ("peak_rack_drift", "peak_rack_acceleration", "peak_rack_shear", "residual_rack_drift")


def with_racks() -> sm.Scene:
    goods = [sm.RackBlock(1, mass=300.0, mu=0.2), sm.RackBlock(2, mass=100.0, fixed=True)]
    racks = [sm.Rack(floor, levels=2, level_mass=40.0, period=0.4, blocks=goods) for floor in (1, 2)]
    return sm.Scene(BUILDING, [sm.Block(1, mass=100.0, mu=0.1, stops=sm.Stops(0.01, 1e6))], racks=racks)


def with_matrix() -> sm.Scene:
    building = BUILDING.replace(stiffness_matrix=[[4e5, -1.5e5], [-1.5e5, 1e5]], heights=[3.0, 3.0])
    return sm.Scene(building, [sm.Block(2, mass=500.0, mu=0.3)])


def chain() -> sm.Scene:
    return sm.Scene(BUILDING, [sm.Block(1, mass=100.0, mu=0.1)])


def test_rows_are_single_runs() -> None:
    """The same engine with the same input: equal to the bit."""
    scenes = [with_racks(), chain(), with_matrix()]
    table = sm.simulate_many(scenes, MOTIONS)
    assert table["scene"].to_list() == [1, 1, 1, 2, 2, 2, 3, 3, 3]
    assert table["motion"].to_list() == [1, 2, 3] * 3
    for row in table.iter_rows(named=True):
        response = sm.simulate(scenes[row["scene"] - 1], MOTIONS[row["motion"] - 1])
        for name in ("peak_drift", "residual_drift", "peak_slip", "slip_path", "peak_floor_acceleration"):
            np.testing.assert_array_equal(row[name], getattr(response, name))
        assert row["peak_base_shear"] == response.peak_base_shear
        assert row["events"] == sum(response.counts.values())
        for name in OF_RACKS:
            np.testing.assert_array_equal(row[name], np.concatenate([*getattr(response, name), []]))
        np.testing.assert_array_equal(row["peak_contact_force"], response.peak_contact_force)
    assert table["peak_drift_ratio"].is_null().to_list() == [True] * 6 + [False] * 3


def test_the_number_of_threads_changes_nothing() -> None:
    scenes = [with_racks(), with_matrix()]
    assert sm.simulate_many(scenes, MOTIONS, threads=1).equals(sm.simulate_many(scenes, MOTIONS, threads=2))


def test_columns_follow_from_the_scenes() -> None:
    """Tables of shear buildings alone stay as they are; every frame of a stream has the columns of the whole."""
    alone = sm.simulate_many(chain(), MOTIONS)
    assert not set(OF_RACKS) & set(alone.columns)
    frames = list(sm.stream_many([chain(), with_racks()], MOTIONS, chunk=2))
    assert [frame.columns for frame in frames] == [[*alone.columns, *frames[0].columns[-10:]]] * 3
    assert pl.concat(frames).equals(sm.simulate_many([chain(), with_racks()], MOTIONS))
    assert frames[0]["peak_rack_drift"].to_list() == [[], []]
    assert frames[0]["peak_contact_force"].to_list() == [[0.0], [0.0]]


def test_progress_counts_both_engines() -> None:
    told: list[tuple[int, int]] = []
    sm.simulate_many([chain(), with_racks()], MOTIONS, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (6, 6)
    assert [done for done, _ in told] == sorted(done for done, _ in told)


def test_a_failed_run_is_a_row(monkeypatch: pytest.MonkeyPatch) -> None:
    """A spring of 1e12 rad/s is too stiff for any step of a hundredth of a second."""
    stiff = sm.Rack(0, levels=1, level_mass=1.0, stiffness=1e24)
    table = sm.simulate_many([sm.Scene(None, racks=[stiff]), with_racks()], MOTIONS[0])
    assert table["status"].to_list() == ["failed", "completed"]
    assert table["reason"][0] is not None
    assert table["peak_rack_drift"][0] is None
    assert table["peak_rack_drift"][1].len() == 4
    assert table["peak_base_shear"][0] is None


def test_written_and_long(tmp_path: Path) -> None:
    scenes = [with_racks(), chain()]
    sm.write_many(tmp_path / "runs.parquet", scenes, MOTIONS[0])
    table = pl.read_parquet(tmp_path / "runs.parquet")
    assert table.equals(sm.simulate_many(scenes, MOTIONS[0]))
    long = sm.long_table(table, scenes)
    # On floor 1 of the first scene stand a block and a rack, of which the one that slips most is taken.
    slips = table["peak_slip"][0].to_list()
    assert long["block"].to_list() == [1 + int(np.argmax(slips[:2])), 3, 1, None]
    assert long["peak_slip"].to_list() == [max(slips[:2]), slips[2], table["peak_slip"][1][0], None]
