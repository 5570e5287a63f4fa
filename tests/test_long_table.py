"""Batches in the long format: every value is that of its run and storey, and motions join with their factors."""

from __future__ import annotations

import numpy as np
import polars as pl
import pytest

import seismass as sm

SUITE = sm.builtin_suite("seven")
BASE = sm.Building.uniform(3, 0.47, mass=1e5, yield_shear_over_weight=[0.3, 0.25, 0.12], heights=[4.0, 3.5, 3.0])
PER_STOREY = ("peak_drift", "peak_drift_time", "peak_drift_ratio", "residual_drift", "peak_storey_shear")
PER_BLOCK = ("peak_slip", "peak_slip_time", "residual_slip", "slip_path")


def test_motions_of_batches_join_with_their_factors() -> None:
    """One convention, from 1: the factor beside a row is that by which its motion was scaled."""
    scaling = sm.scaling.scale_asce7_10(SUITE, sm.TargetSpectrum.asce7(), between=False)
    motions = [record.scaled(factor) for record, factor in zip(SUITE, scaling.factors, strict=True)]
    table = sm.simulate_many(sm.Scene(BASE), motions)
    joined = table.join(scaling.table(), on="motion", suffix="_of_scaling", maintain_order="left")
    assert joined["record"].to_list() == joined["record_of_scaling"].to_list() == list(scaling.names)
    for row in joined.iter_rows(named=True):
        record = next(record for record in SUITE if record.name == row["record"])
        alone = sm.simulate(sm.Scene(BASE), record.scaled(row["factor"]))
        assert row["peak_drift"] == alone.peak_drift.tolist()
    # What the table shows can be passed back.
    pairs = table.select("scene", "motion").to_numpy()
    assert sm.simulate_many(sm.Scene(BASE), motions, pairs=pairs).equals(table)


def test_motions_without_a_name_are_called_by_their_number() -> None:
    motions = [SUITE[0], sm.Motion([0.0, 1.0], 0.01), SUITE[1].replace(name="")]
    expected = ["synthetic-1", "motion 2", "motion 3"]
    assert sm.simulate_many(sm.Scene(BASE), motions)["record"].to_list() == expected
    grid = sm.Grid(BASE, motion=[3, 1, 2])
    assert sm.simulate_many(grid, motions)["record"].to_list() == [expected[i] for i in (2, 0, 1)]


def test_each_row_is_a_storey_of_a_run() -> None:
    grid = sm.Grid.product([BASE, BASE.replace(heights=None)], roof="bare", mass_ratio=[0.5, 1.0], mu=[0.1, 0.3])
    batch = sm.simulate_many(grid, SUITE)
    table = sm.long_table(batch, grid)
    assert len(table) == 3 * len(batch)
    described = grid.table()
    for row in table.gather_every(5).iter_rows(named=True):
        run, i = batch.row(row["run"] - 1, named=True), row["storey"] - 1
        for name in ("scene", "motion", "record", "status", "peak_base_shear", "events", "yields", "slips"):
            assert row[name] == run[name]
        for name in PER_STOREY:
            assert row[name] == (None if run[name] is None else run[name][i]), name
        # The roof, floor 3, has no block.
        for name in PER_BLOCK:
            assert row[name] == (run[name][i] if i < 2 else None), name
        given = described.row(row["scene"] - 1, named=True)
        for name in ("building", "mass_ratio", "mu_s", "mu_k", "storeys"):
            assert row[name] == given[name]
        assert row["period"] == pytest.approx(0.47, rel=1e-14)


def test_any_rows_of_a_batch_in_any_order() -> None:
    grid = sm.Grid.product(BASE, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2, 0.3])
    batch = sm.simulate_many(grid, SUITE)
    whole = sm.long_table(batch, grid).drop("run")
    some = batch.filter(pl.col("scene") > 3).reverse()
    expected = whole.filter(pl.col("scene") > 3).sort("scene", "motion", "storey", descending=[True, True, False])
    assert sm.long_table(some, grid).drop("run").equals(expected)
    assert pl.concat(sm.long_table(frame, grid).drop("run") for frame in sm.stream_many(grid, SUITE, chunk=11)).equals(
        whole
    )


def test_values_per_block_and_per_storey_are_those_of_the_row() -> None:
    grid = sm.Grid(
        sm.Building.uniform(2, 0.3),
        yield_shear_over_weight=[[0.3, 0.2], [0.25, 0.15]],
        floors=[2, 1, 2],
        mass_ratio=[[0.5, 1.0, 0.0], [0.3, 0.0, 0.7]],
        mu=[[0.1, 0.2, 0.3], [0.4, 0.2, 0.05]],
    )
    batch = sm.simulate_many(grid, SUITE[0])
    table = sm.long_table(batch, grid)
    assert table["yield_shear_over_weight"].to_list() == [0.3, 0.2, 0.25, 0.15]
    # Scene 2 has two blocks on floor 2, of which the second, with mu = 0.05, slides farther; none on floor 1.
    assert batch["peak_slip"][1][1] > batch["peak_slip"][1][0]
    assert table["block"].to_list() == [2, 1, None, 2]
    assert table["mass_ratio"].to_list() == [1.0, 0.5, None, 0.7]
    assert table["mu_s"].to_list() == [0.2, 0.1, None, 0.05]
    slips = batch["peak_slip"].to_list()
    assert table["peak_slip"].to_list() == [slips[0][1], slips[0][0], None, slips[1][1]]


def test_unequal_storeys_and_goods_are_those_of_single_runs(
    unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]
) -> None:
    """A storey has its own height, and of two blocks on floor 1 the slip of the one that goes further."""
    batch = sm.simulate_many(unequal_scene, unequal_motions)
    table = sm.long_table(batch, [unequal_scene])
    heights, first_blocks = np.array([4.3, 3.7, 3.1]), []
    for number, motion in enumerate(unequal_motions, start=1):
        run, rows = sm.simulate(unequal_scene, motion), table.filter(motion=number)
        assert rows["storey"].to_list() == [1, 2, 3]
        np.testing.assert_allclose(rows["peak_drift_ratio"], run.peak_drift / heights, rtol=1e-15)
        for name in ("peak_drift", "peak_drift_time", "residual_drift", "peak_storey_shear", "peak_floor_acceleration"):
            np.testing.assert_array_equal(rows[name], getattr(run, name), err_msg=name)
        assert rows["peak_base_shear"].unique().to_list() == [run.peak_storey_shear[0]]
        chosen = [int(np.argmax(run.peak_slip[:2])), 2, 3]
        first_blocks.append(chosen[0])
        for name in PER_BLOCK:
            np.testing.assert_array_equal(rows[name], getattr(run, name)[chosen], err_msg=name)
        assert rows["block"].to_list() == [place + 1 for place in chosen]
        lists = batch.row(number - 1, named=True)
        np.testing.assert_allclose(lists["peak_drift_ratio"], run.peak_drift / heights, rtol=1e-15)


def test_scenes_that_are_objects_of_all_kinds() -> None:
    scenes = [
        sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]),
        sm.Scene(BASE, [sm.Block(0, mass=1.0, mu=0.1), *sm.blocks_on_floors([0.0, 1.0, 0.0], 0.2)]),
        sm.Scene(sm.Building.uniform(1, 0.2)),
    ]
    batch = sm.simulate_many(scenes, [SUITE[0], SUITE[0].scaled(1e200)])
    assert batch["status"].to_list() == ["completed", "completed", "completed", "failed", "completed", "completed"]
    table = sm.long_table(batch, scenes)
    assert table["run"].to_list() == [1, 2, 3, 3, 3, 4, 5, 6]
    assert table["storey"].to_list() == [None, None, 1, 2, 3, None, 1, 1]
    assert table["storeys"].to_list() == [0, 0, 3, 3, 3, 3, 1, 1]
    assert table["block"].to_list() == [None, None, None, 2, None, None, None, None]
    assert table["peak_slip"][3] == batch["peak_slip"][2][1]
    assert table["reason"][5] == batch["reason"][3]
    assert table["period"].to_list()[:2] == [None, None]
    assert "building" not in table.columns


def test_no_runs_are_no_rows() -> None:
    grid = sm.Grid(BASE, mass_ratio=1.0, mu=0.2)
    full = sm.long_table(sm.simulate_many(grid, SUITE), grid)
    empty = sm.long_table(sm.simulate_many(grid, []), grid)
    assert (len(empty), empty.schema) == (0, full.schema)


def test_wrong_tables_are_refused() -> None:
    grid = sm.Grid(BASE, mass_ratio=[1.0, 2.0], mu=0.2)
    batch = sm.simulate_many(grid, SUITE)
    with pytest.raises(
        sm.errors.InvalidOption, match="table of long_table must be rows of a batch; got none of slip_path"
    ):
        sm.long_table(batch.drop("slip_path"), grid)
    with pytest.raises(sm.errors.InvalidOption, match="table of long_table must be rows of a batch; got 3"):
        sm.long_table(3, grid)  # type: ignore[arg-type]
    message = "scene of long_table must be the number of a scene that is given, counted from 1 to 1; got 2"
    with pytest.raises(sm.errors.InvalidOption, match=message):
        sm.long_table(batch, grid.scene(1))
    with pytest.raises(sm.errors.InvalidScene, match="scene 1 of long_table must be a Scene; got 'a'"):
        sm.long_table(batch, ["a"])  # type: ignore[list-item]


def test_a_run_beyond_the_range_of_numbers_takes_no_other_with_it() -> None:
    """Squares of the response overflow near 1e154; before, an index was out of bounds, and the batch was lost."""
    scene = sm.Scene(BASE, sm.blocks_on_floors([1.0, 1.0, 0.0], 0.3))
    factors = [1.0, 1e155, 1e250, 0.5]
    batch = sm.simulate_many(scene, [SUITE[0].scaled(factor) for factor in factors])
    assert batch["status"].to_list() == ["completed", "failed", "failed", "completed"]
    for number in (0, 3):
        alone = sm.simulate(scene, SUITE[0].scaled(factors[number]))
        assert batch["peak_drift"][number].to_list() == alone.peak_drift.tolist()
    with pytest.raises(sm.errors.SimulationError, match="the response left the range of numbers at t = ") as raised:
        sm.simulate(scene, SUITE[0].scaled(1e155))
    assert str(raised.value) == batch["reason"][1]
    assert np.isfinite(batch["end_time"][0])


def test_histories_of_a_run_with_one_row_per_time_and_place() -> None:
    building = sm.Building.uniform(3, 0.4, yield_shear_over_weight=[0.3, 0.2, 0.1])
    rack = sm.Rack(1, 2, level_mass_ratio=0.02, period=0.3, blocks=[sm.RackBlock(1, mass_ratio=0.1, mu=0.2)])
    blocks = sm.blocks_on_floors([1.0, 0.5, 0.0], mu=0.1)
    for scene in (sm.Scene(building, blocks), sm.Scene(building, blocks, racks=[rack, rack])):
        response = sm.simulate(scene, SUITE[0], histories=10)
        rows = len(response.time)
        for places, names in (
            ("storeys", ("drift", "floor_displacement", "floor_velocity", "floor_acceleration", "storey_shear")),
            ("blocks", ("slip", "block_velocity")),
            ("levels", ("rack_drift", "rack_velocity", "rack_acceleration", "rack_shear") if scene.racks else ()),
            ("ground", ("ground_acceleration", "ground_velocity", "ground_displacement")),
        ):
            if not names:
                with pytest.raises(sm.errors.InvalidOption, match="places of history_table must be what the scene has"):
                    sm.runs.history_table(response, places)
                continue
            table = sm.runs.history_table(response, places)
            place = [] if places == "ground" else [places.removesuffix("s")]
            assert table.columns[: len(place) + 1] == ["time", *place]
            assert set(table.columns[len(place) + 1 :]) == set(names)
            for name in names:
                values = getattr(response, name)
                values = np.column_stack(values).reshape(rows, -1) if isinstance(values, tuple) else values
                np.testing.assert_array_equal(table[name].to_numpy().reshape(values.shape), values)
            np.testing.assert_array_equal(table["time"].to_numpy().reshape(rows, -1)[:, 0], response.time)
    with pytest.raises(sm.errors.InvalidOption, match="histories of simulate must be asked for"):
        sm.runs.history_table(sm.simulate(scene, SUITE[0]))
    alone = sm.simulate(scene, SUITE[0], histories=10, displacements_only=True)
    assert sm.runs.history_table(alone).columns == ["time", "storey", "drift", "floor_displacement"]
