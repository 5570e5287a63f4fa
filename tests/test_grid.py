"""Scenes described by columns: the same bits as objects run one by one, in frames of any size, and refused by name."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import textwrap
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass.runs.batch import MAX_RUNS

BUILDING = sm.Building.uniform(2, 0.3, mass=1000.0, yield_shear_over_weight=[0.2, 0.12], heights=[3.4, 2.7])
LOADED = sm.Building.uniform(
    3, 0.6, mass=1000.0, yield_shear_over_weight=0.15, heights=[3.7, 3.1, 2.9], gravity_load=9806.65
)
QUIET = sm.Motion([0.0, 0.0], 0.01)

PER_RUN = (
    "peak_drift", "peak_drift_time", "residual_drift", "peak_floor_acceleration", "peak_storey_shear", "peak_slip",
    "peak_slip_time", "residual_slip", "slip_path",
)  # fmt: skip


def shaking(seed: int = 1, samples: int = 600, vertical: bool = False) -> sm.Motion:
    """Filtered noise: only that it makes storeys yield and blocks slide matters."""
    noise = np.random.default_rng(seed).standard_normal((2, samples))
    smooth = np.array([np.convolve(row, np.hanning(15), mode="same") for row in noise])
    smooth /= np.abs(smooth).max()
    return sm.Motion(5.0 * smooth[0], 0.01, 2.0 * smooth[1] if vertical else None)


def aligned() -> sm.Grid:
    """Rows that differ in everything a column can hold, some of them equal."""
    draw = np.random.default_rng(7)
    rows = 60
    ratio = draw.choice([0.0, 0.5, 1.2], (rows, 4))
    floors = [1, 2, 2, 3]
    building = draw.integers(1, 3, rows)
    ratio[building == 1, 3] = 0.0
    static = draw.uniform(0.1, 0.5, (rows, 4))
    kinetic = static * draw.uniform(0.5, 1.0, (rows, 1))
    scale, motion = draw.choice([0.5, 1.0, -1.7], rows), draw.integers(1, 3, rows)
    for column in (ratio, building, static, kinetic, scale, motion):
        column[40:50] = column[:10]
    return sm.Grid(
        [BUILDING, LOADED],
        building_index=building,
        floors=floors,
        mass_ratio=ratio,
        mu_s=static,
        mu_k=kinetic,
        scale=scale,
        motion=motion,
        collapse_drift=0.2,
    )


MOTIONS = [shaking(1), shaking(2, vertical=True)]


def assert_row_is_the_run(row: dict[str, object], alone: sm.Response) -> None:
    for name in PER_RUN:
        assert row[name] == getattr(alone, name).tolist(), name
    assert (row["status"], row["end_time"]) == (alone.status, alone.end_time)
    assert (row["yields"], row["slips"]) == (alone.counts["yield"], alone.counts["slip"])
    assert row["events"] == len(alone.events)
    ratio = alone.peak_drift_ratio
    assert row["peak_drift_ratio"] == (None if ratio is None else ratio.tolist())


def test_rows_are_the_runs_of_their_scenes_to_the_bit() -> None:
    grid = aligned()
    columns = grid.table()
    assert sum(column.null_count() for column in columns) == 0
    slid = 0
    for row, given in zip(
        sm.simulate_many(grid, MOTIONS).iter_rows(named=True), columns.iter_rows(named=True), strict=True
    ):
        assert (row["scene"], row["motion"]) == (given["scene"], given["motion"])
        motion = MOTIONS[given["motion"] - 1].scaled(given["scale"])
        assert_row_is_the_run(row, sm.simulate(grid.scene(given["scene"]), motion))
        slid += row["slips"]
    assert slid > 100


def test_threads_and_chunks_change_no_bit() -> None:
    grid = aligned()
    whole = sm.simulate_many(grid, MOTIONS, threads=1)
    for threads, chunk in product((1, 2, 3), (1, 7, 59, 60, 1000)):
        frames = list(sm.stream_many(grid, MOTIONS, threads=threads, chunk=chunk))
        assert [len(frame) for frame in frames] == [min(chunk, 60 - first) for first in range(0, 60, chunk)]
        assert_frame_equal(pl.concat(frames), whole, check_exact=True)


def test_scenes_that_are_objects_stream_too() -> None:
    scenes, pairs = [aligned().scene(number) for number in range(1, 6)], [(5, 1), (2, 2), (5, 2), (5, 1)]
    whole = sm.simulate_many(scenes, MOTIONS, pairs=pairs)
    assert_frame_equal(pl.concat(sm.stream_many(scenes, MOTIONS, pairs=pairs, chunk=3)), whole, check_exact=True)
    assert_frame_equal(
        pl.concat(sm.stream_many(scenes, MOTIONS, chunk=3)), sm.simulate_many(scenes, MOTIONS), check_exact=True
    )


def test_a_product_is_every_combination_the_last_axis_changing_fastest() -> None:
    ratios, friction, scales = [0.5, 1.0], [0.1, 0.2, 0.3], [0.5, 1.0]
    grid = sm.Grid.product([BUILDING, LOADED], mass_ratio=ratios, mu=friction, scale=scales)
    combinations = list(product((1, 2), ratios, friction, scales))
    assert len(grid) == len(combinations) == 24
    table = grid.table()
    assert table.select("building", "mass_ratio", "mu_s", "scale").rows() == combinations
    assert table["mu_k"].to_list() == table["mu_s"].to_list()
    assert_frame_equal(grid.table(6, 9), table[5:9])
    assert grid.table(24)["scene"].to_list() == [24]
    assert len(grid.table(25)) == len(grid.table(9, 8)) == 0
    # Common values stand for a block on every floor that the building has.
    assert grid.scene(1) == sm.Scene(BUILDING, sm.blocks_on_floors([0.5, 0.5], 0.1))
    assert grid.scene(24) == sm.Scene(LOADED, sm.blocks_on_floors([1.0, 1.0, 1.0], 0.3))
    results = sm.simulate_many(grid, MOTIONS)
    assert results.select("scene", "motion").rows() == list(product(range(1, 25), (1, 2)))
    for number in (0, 17, 47):
        building, ratio, mu, scale = combinations[number // 2]
        buildings = (BUILDING, LOADED)
        chosen = buildings[building - 1]
        scene = sm.Scene(chosen, sm.blocks_on_floors([ratio] * chosen.storeys, mu))
        assert_row_is_the_run(results.row(number, named=True), sm.simulate(scene, MOTIONS[number % 2].scaled(scale)))


def test_values_per_block_and_static_with_kinetic_friction_are_one_axis() -> None:
    grid = sm.Grid.product(BUILDING, mass_ratio=[[1.0, 0.5], [0.0, 1.0]], mu_s=[0.3, 0.4], mu_k=[0.2, 0.3])
    assert len(grid) == 4
    assert grid.scene(2).blocks == (
        sm.Block(1, mass_ratio=1.0, mu_s=0.4, mu_k=0.3),
        sm.Block(2, mass_ratio=0.5, mu_s=0.4, mu_k=0.3),
    )
    assert grid.scene(3).blocks == (sm.Block(2, mass_ratio=1.0, mu_s=0.3, mu_k=0.2),)
    assert grid.table()["mass_ratio"].to_list() == [[1.0, 0.5], [1.0, 0.5], [0.0, 1.0], [0.0, 1.0]]
    results = sm.simulate_many(grid, shaking())
    assert [len(slips) for slips in results["peak_slip"]] == [2, 2, 1, 1]


def test_a_grid_of_bare_buildings_is_intensities_alone() -> None:
    grid = sm.Grid.product(BUILDING, scale=np.linspace(0.1, 1.0, 5))
    assert grid.floors == ()
    results = sm.simulate_many(grid, shaking(), peaks_only=True)
    assert_row_is_the_run(
        sm.simulate_many(grid, shaking()).row(4, named=True), sm.simulate(sm.Scene(BUILDING), shaking())
    )
    assert results["peak_slip"].to_list() == [[]] * 5
    assert results["residual_drift"].to_list() == [[None, None]] * 5


def test_scaling_beyond_the_range_of_numbers_is_a_failed_row() -> None:
    grid = sm.Grid(BUILDING, scale=[1.0, 1e308])
    results = sm.simulate_many(grid, shaking())
    assert_frame_equal(pl.concat(sm.stream_many(grid, shaking(), chunk=1)), results, check_exact=True)
    assert results["status"].to_list() == ["completed", "failed"]
    assert results["reason"][1].startswith("acceleration of motion must be finite at every sample; got ")
    assert results["peak_drift"][1] is None


def test_no_runs_are_one_empty_frame() -> None:
    frames = list(sm.stream_many(sm.Grid(BUILDING), []))
    assert [len(frame) for frame in frames] == [0]
    assert frames[0].schema == sm.simulate_many(sm.Grid(BUILDING), QUIET).schema


def test_parquet_holds_the_same_rows_and_names_the_instructions(tmp_path: Path) -> None:
    grid, path = aligned(), tmp_path / "rows.parquet"
    sm.write_many(path, grid, MOTIONS, chunk=7)
    assert_frame_equal(pl.read_parquet(path), sm.simulate_many(grid, MOTIONS), check_exact=True)
    metadata = pl.read_parquet_metadata(path)
    assert (metadata["seismass"], metadata["instructions"]) == (sm.__version__, sm.runs.instruction_set())
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("path", ["", ".", "/", "folder"])
def test_a_folder_is_no_file_to_write_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str) -> None:
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    started: list[int] = []
    with pytest.raises(IsADirectoryError):
        sm.write_many(path, aligned(), MOTIONS, progress=lambda done, _: started.append(done))
    assert not started
    assert [file.name for file in tmp_path.iterdir()] == ["folder"]


def test_a_file_may_have_a_name_as_long_as_the_system_allows(tmp_path: Path) -> None:
    path = tmp_path / f"{'x' * 242}.parquet"
    sm.write_many(path, aligned(), MOTIONS)
    assert list(tmp_path.iterdir()) == [path]


def test_a_file_that_is_not_finished_does_not_appear(tmp_path: Path) -> None:
    def fail(done: int, total: int) -> None:
        if done > 20:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        sm.write_many(tmp_path / "rows.parquet", aligned(), MOTIONS, chunk=7, progress=fail)
    (kept,) = tmp_path.iterdir()
    assert {file.name for file in kept.iterdir()} == {"inputs", "part-0.parquet", "part-1.parquet"}


def interrupted(path: Path, chunk: int) -> list[int]:
    """Numbers of runs at which a call that is interrupted in its fourth chunk says how far it is."""
    seen: list[int] = []

    def interrupt(done: int, total: int) -> None:
        seen.append(done)
        if done >= 3 * chunk:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sm.write_many(path, aligned(), MOTIONS, chunk=chunk, progress=interrupt)
    return seen


def test_the_same_call_goes_on_with_the_chunks_that_are_there(tmp_path: Path) -> None:
    path, other, seen = tmp_path / "rows.parquet", tmp_path / "other.parquet", list[int]()
    sm.write_many(other, aligned(), MOTIONS, chunk=7)
    assert interrupted(path, 7)[0] <= 7
    sm.write_many(path, aligned(), MOTIONS, chunk=7, progress=lambda done, _: seen.append(done))
    assert seen[0] > 14  # two chunks were there
    assert path.read_bytes() == other.read_bytes()
    assert sorted(tmp_path.iterdir()) == [other, path]


@pytest.mark.parametrize("changes", [{"chunk": 6}, {"peaks_only": True}, {"runs": range(1, 40)}])
def test_other_inputs_start_anew(tmp_path: Path, changes: dict[str, Any]) -> None:
    path, seen = tmp_path / "rows.parquet", list[int]()
    interrupted(path, 7)
    options = {"chunk": 7} | changes
    sm.write_many(path, aligned(), MOTIONS, progress=lambda done, _: seen.append(done), **options)
    assert seen[0] <= 7
    chosen = {name: value for name, value in changes.items() if name != "chunk"}
    assert_frame_equal(pl.read_parquet(path), sm.simulate_many(aligned(), MOTIONS, **chosen), check_exact=True)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("scenes", [aligned, lambda: [aligned().scene(number) for number in range(1, 25)]])
def test_a_stretch_of_runs_has_the_rows_of_the_whole(scenes: Callable[[], Any]) -> None:
    whole = sm.simulate_many(scenes(), MOTIONS)
    for runs in (range(1, 2), range(3, 20), range(len(whole), len(whole) + 1), range(5, 5)):
        found = sm.simulate_many(scenes(), MOTIONS, runs=runs)
        assert_frame_equal(found, whole[runs.start - 1 : runs.stop - 1], check_exact=True)
        frames = list(sm.stream_many(scenes(), MOTIONS, runs=runs, chunk=4))
        assert_frame_equal(pl.concat(frames), found, check_exact=True)


@pytest.mark.parametrize("runs", [range(3), range(1, 10**6), range(1, 9, 2), 3, (1, 4), range(5, 1, -1)])
def test_a_stretch_is_a_range_of_runs(runs: Any) -> None:
    with pytest.raises(sm.errors.InvalidOption, match="runs of batch must be a range of numbers of runs, from 1 to"):
        sm.simulate_many(aligned(), MOTIONS, runs=runs)


def test_progress_counts_over_all_chunks() -> None:
    seen: list[tuple[int, int]] = []
    for _ in sm.stream_many(aligned(), MOTIONS, chunk=25, progress=lambda done, total: seen.append((done, total))):
        pass
    assert seen == sorted(seen)
    assert {(25, 60), (50, 60), (60, 60)} <= set(seen)


def test_a_grid_pickles_and_keeps_nothing_of_the_callers_arrays() -> None:
    mu = np.array([0.1, 0.2])
    grid = sm.Grid(BUILDING, mass_ratio=1.0, mu=mu)
    mu[0] = 0.9
    assert grid.table()["mu_s"].to_list() == [0.1, 0.2]
    assert_frame_equal(pickle.loads(pickle.dumps(grid)).table(), grid.table())
    assert repr(grid) == "Grid(2 scenes, 1 building, 2 blocks each, columns mass_ratio, mu_s)"


def test_a_scaled_motion_is_its_samples_times_the_factor() -> None:
    motion = shaking(vertical=True)
    scaled = motion.scaled(-0.3)
    assert np.array_equal(scaled.acceleration, motion.acceleration * -0.3)
    assert np.array_equal(scaled.vertical, motion.vertical * -0.3)


def test_statistics_name_the_instructions() -> None:
    assert sm.simulate(sm.Scene(BUILDING), QUIET).statistics["instructions"] == sm.runs.instruction_set()
    code = """
import seismass as sm
print(sm.simulate(sm.Scene(sm.Building(1.0, 1.0)), sm.Motion([0.0], 0.1)).statistics["instructions"])
"""
    child = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env=os.environ | {"SEISMASS_INSTRUCTIONS": "baseline"},
        timeout=60,
    )
    assert child.stdout == "baseline\n"


INTERRUPTED = """
    import os, signal, threading, time
    import numpy as np
    import seismass as sm
    building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
    grid = sm.Grid.product(building, mass_ratio=1.0, mu=np.linspace(0.1, 0.5, 1000), scale=np.linspace(0.5, 2.0, 1000))
    motion = sm.builtin_suite("seven")[0]
    sent = []
    def interrupt():
        time.sleep(0.5)
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)
    threading.Thread(target=interrupt).start()
    try:
        for frame in sm.stream_many(grid, motion, chunk={chunk}):
            pass
    except KeyboardInterrupt:
        # Polars, interrupted within a query of its own, lets Python hear the same signal again.
        try:
            time.sleep(0.1)
        except KeyboardInterrupt:
            pass
        print(time.perf_counter() - sent[0])
    else:
        print("ran to its end")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="sends SIGINT to itself")
@pytest.mark.parametrize("chunk", [20, 1_000_000], ids=["between chunks", "within a chunk"])
def test_ctrl_c_stops_a_stream(chunk: int) -> None:
    code = textwrap.dedent(INTERRUPTED).format(chunk=chunk)
    child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    assert child.returncode == 0, child.stderr
    # Hours of work are left; the bound tells stopping from running to the end, on a busy machine too.
    assert float(child.stdout) < 10.0


@pytest.mark.skipif(sys.platform != "linux", reason="reads the peak of resident memory in KiB")
def test_memory_does_not_grow_with_the_number_of_runs() -> None:
    code = textwrap.dedent("""
        import resource
        import numpy as np
        import seismass as sm
        building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
        friction, scale = np.linspace(0.1, 0.5, 400), np.linspace(0.5, 2.0, 500)
        grid = sm.Grid.product(building, mass_ratio=1.0, mu=friction, scale=scale)
        motion = sm.Motion([0.0, 1.0, 0.0], 0.01)
        for number, _ in enumerate(sm.stream_many(grid, motion, threads=2, chunk=10_000)):
            if number in (3, 19):
                print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
    """)
    child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=300)
    early, late = (int(line) for line in child.stdout.split())
    # 160 000 rows more would take over 100 MB as frames; the allocator is given a tenth of that to wander.
    assert late - early < 10 * 1024


Refused = tuple[str, Callable[[], object], type[Exception], str]
REFUSED: list[Refused] = [
    ("no building", lambda: sm.Grid([]), sm.errors.InvalidScene,
     r"building of grid must be a Building or a list of Buildings; got \[\]"),
    ("unequal columns", lambda: sm.Grid(BUILDING, mass_ratio=[1, 1], mu=[0.1, 0.2, 0.3]), sm.errors.InvalidScene,
     "mass_ratio of grid must be one value, or as many as the longest column has, 3; got 2 values"),
    ("unequal friction", lambda: sm.Grid(BUILDING, mass_ratio=[1, 1, 1], mu=[0.1, 0.2]), sm.errors.InvalidScene,
     "mu of grid must be one value, or as many as the longest column has, 3; got 2 values"),
    ("no friction", lambda: sm.Grid(BUILDING, mass_ratio=1.0), sm.errors.InvalidScene,
     "mu of grid must be given, or mu_s; got neither"),
    ("friction twice", lambda: sm.Grid(BUILDING, mass_ratio=1.0, mu=0.1, mu_s=0.2), sm.errors.InvalidScene,
     "mu of grid must be left out where mu_s or mu_k is given; got 0.1"),
    ("friction of no block", lambda: sm.Grid(BUILDING, mu=0.1), sm.errors.InvalidScene,
     "mu of grid must be left out where mass_ratio is; got 0.1"),
    ("floors of no block", lambda: sm.Grid(BUILDING, floors=[1]), sm.errors.InvalidScene,
     r"floors of grid must be left out where mass_ratio is; got \[1\]"),
    ("missing floor", lambda: sm.Grid(BUILDING, floors=[3], mass_ratio=1.0, mu=0.1), sm.errors.InvalidScene,
     "floor of block 1 of scene 1 must be a floor of the building, 1 to 2, or 0 for the ground; got 3"),
    ("ground", lambda: sm.Grid(BUILDING, floors=[0], mass_ratio=1.0, mu=0.1), sm.errors.InvalidScene,
     "floors of grid must be a whole number counted from 1, or a list of them; got 0 as value 1"),
    ("half a floor", lambda: sm.Grid(BUILDING, floors=[0.5], mass_ratio=1.0, mu=0.1), sm.errors.InvalidScene,
     r"floors of grid must be a whole number counted from 1, or a list of them; got \[0.5\]"),
    ("negative ratio", lambda: sm.Grid(BUILDING, mass_ratio=[1, 1, -1], mu=0.1), sm.errors.InvalidScene,
     "mass_ratio of block 1 of scene 3 must be a positive number, or 0 for no block; got -1"),
    ("ratio of text", lambda: sm.Grid(BUILDING, mass_ratio="heavy", mu=0.1), sm.errors.InvalidScene,
     "mass_ratio of grid must be a number or a list of numbers; got 'heavy'"),
    ("no values", lambda: sm.Grid(BUILDING, mass_ratio=[], mu=0.1), sm.errors.InvalidScene,
     "mass_ratio of grid must be at least one value; got none"),
    ("ragged", lambda: sm.Grid(BUILDING, mass_ratio=[[1, 1], [1]], mu=0.1), sm.errors.InvalidScene,
     r"mass_ratio of grid must be a number or a list of numbers; got \[\[1, 1\], \[1\]\]"),
    ("three per two blocks", lambda: sm.Grid(BUILDING, mass_ratio=[[1, 1, 1]], mu=0.1), sm.errors.InvalidScene,
     "mass_ratio of grid must be a list with one value per scene, or a table with one column per block, 2; got"),
    ("kinetic above static", lambda: sm.Grid.product(BUILDING, mass_ratio=[0.5, 1], mu_s=[0.2, 0.3], mu_k=[0.1, 0.4]),
     sm.errors.InvalidScene, "mu_k of block 1 of scene 2 must be at most mu_s = 0.3; got 0.4"),
    ("unequal friction axis", lambda: sm.Grid.product(BUILDING, mass_ratio=1, mu_s=[0.2, 0.3], mu_k=[0.1] * 3),
     sm.errors.InvalidScene, "mu_k of grid must be one value, or as many as mu_s has, 2; got 3 values"),
    ("too heavy", lambda: sm.Grid.product(LOADED, mass_ratio=[1, 1e6], mu=[0.1, 0.2], scale=[1, 2]),
     sm.errors.InvalidScene,
     "geometric stiffness P/h of storey 1 of scene 5 must be below its stiffness .*; got"),
    ("too many", lambda: sm.Grid.product(BUILDING, mass_ratio=[1] * 2**18, mu=[0.1] * 2**18, scale=[1] * 2**18),
     sm.errors.InvalidOption, f"scenes of grid must be at most {MAX_RUNS}; got {2**54}"),
    ("which building", lambda: sm.Grid([BUILDING, LOADED], scale=[1, 2]), sm.errors.InvalidScene,
     "building_index of grid must be given where there are several buildings; got none"),
    ("missing building", lambda: sm.Grid([BUILDING, LOADED], building_index=[1, 3]), sm.errors.InvalidScene,
     "building_index of grid must be the number of a building, counted from 1 to 2; got 3 as value 2"),
    ("infinite factor", lambda: sm.Grid(BUILDING, scale=[1, np.inf]), sm.errors.InvalidMotion,
     "scale of grid must be a finite number; got inf as value 2"),
    ("motion zero", lambda: sm.Grid(BUILDING, motion=[1, 0]), sm.errors.InvalidOption,
     "motion of grid must be a whole number counted from 1, or a list of them; got 0 as value 2"),
    ("missing motion", lambda: sm.stream_many(sm.Grid(BUILDING, motion=[1, 2]), QUIET), sm.errors.InvalidOption,
     "motion of grid must be the number of a motion, counted from 1 to 1; got 2 as value 2"),
    ("collapse at no drift", lambda: sm.Grid(BUILDING, collapse_drift=0.0), sm.errors.InvalidScene,
     "collapse_drift of storey 1 of scene 1 must be a positive number; got 0"),
    ("missing scene", lambda: sm.Grid(BUILDING).scene(2), sm.errors.InvalidOption,
     "number of grid must be that of a scene, counted from 1 to 1; got 2"),
    ("scene zero", lambda: sm.Grid(BUILDING).scene(0), sm.errors.InvalidOption,
     "number of grid must be a whole number of at least 1; got 0"),
    ("pair zero", lambda: sm.simulate_many(sm.Scene(BUILDING), QUIET, pairs=[(1, 1), (0, 1)]), sm.errors.InvalidOption,
     "pairs of batch must be the number of a scene, counted from 1 to 1; got 0 in pair 2"),
    ("building of two", lambda: sm.Grid(BUILDING, storeys=2, period=0.3), sm.errors.InvalidScene,
     "building of grid must be given either as building or as storeys; got both"),
    ("pairs of a grid", lambda: sm.simulate_many(sm.Grid(BUILDING), QUIET, pairs=[(0, 0)]), sm.errors.InvalidOption,
     r"pairs of batch must be left out with a Grid, which has a column of motions; got \[\(0, 0\)\]"),
    ("chunks of nothing", lambda: sm.stream_many(sm.Grid(BUILDING), QUIET, chunk=0), sm.errors.InvalidOption,
     "chunk of batch must be a whole number of at least 1; got 0"),
    ("motion scaled by nothing", lambda: shaking().scaled(float("nan")), sm.errors.InvalidMotion,
     "factor of scaled motion must be a finite number; got NaN"),
]  # fmt: skip


@pytest.mark.parametrize(("make", "kind", "message"), [case[1:] for case in REFUSED], ids=[case[0] for case in REFUSED])
def test_wrong_columns_are_refused_by_name(make: Callable[[], object], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=f"^{message}"):
        make()
