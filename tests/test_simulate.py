"""Runs: responses as arrays, batches as frames, interruption, and the interpreter that is free meanwhile."""

from __future__ import annotations

import os
import pickle
import platform
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import polars as pl
import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass.runs.response import EVENT_KINDS


def shaking(seed: int = 1, samples: int = 2000, pga: float = 6.0) -> sm.Motion:
    """Filtered noise: only that it makes storeys yield and blocks slide matters."""
    noise = np.random.default_rng(seed).standard_normal(samples)
    smooth = np.convolve(noise, np.hanning(25), mode="same")
    return sm.Motion(pga * smooth / np.abs(smooth).max(), 0.01)


def storeys(count: int, **changes: object) -> sm.Building:
    fractions = np.linspace(0.24, 0.12, count)
    return sm.Building.uniform(count, 0.15 * count, yield_shear_over_weight=fractions, **changes)  # type: ignore[arg-type]


def scene(count: int = 3, mu: float = 0.25, **changes: object) -> sm.Scene:
    return sm.Scene(storeys(count, **changes), sm.blocks_on_floors([1.0] * (count - 1) + [0.0], mu))


def test_response_arrays() -> None:
    response = sm.simulate(scene(), shaking(), histories=True, energy=True)
    assert response.status == "completed"
    assert response.end_time == pytest.approx(19.99)
    assert response.collapsed_storey is None
    for name in ("drift", "floor_velocity", "floor_acceleration", "storey_shear"):
        assert getattr(response, name).shape == (2000, 3), name
    for name in ("slip", "block_velocity"):
        assert getattr(response, name).shape == (2000, 2), name
    assert response.time[-1] == pytest.approx(19.99)
    assert (np.abs(response.drift).max(axis=0) <= response.peak_drift).all()
    # Peaks lie between samples of 0.01 s, by some w^2 (dt/2)^2/2 beyond them.
    assert np.abs(response.drift).max(axis=0) == pytest.approx(response.peak_drift, rel=1e-3)
    assert response.drift[-1] == pytest.approx(response.residual_drift)
    assert response.slip[-1] == pytest.approx(response.residual_slip)
    assert (response.slip_path >= response.peak_slip).all()
    assert response.peak_base_shear == response.peak_storey_shear[0]
    assert abs(response.energy["relative_residual"]) < 1e-11
    with pytest.raises(ValueError, match="read-only"):
        response.drift[0, 0] = 1.0


def test_histories_are_not_copied() -> None:
    run = sm.simulate(scene(), shaking(), histories=True)._run
    assert run is not None
    assert run.drift is run.drift
    assert run.block_velocity is run.block_velocity


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="glibc is made to keep memory; others decide themselves")
def test_memory_of_histories_is_kept_from_run_to_run() -> None:
    code = textwrap.dedent("""
        import resource
        import seismass as sm
        scene = sm.Scene(sm.Building.uniform(3, 0.5), sm.blocks_on_floors([1.0, 1.0, 1.0], 0.3))
        motion = sm.Motion([0.0, 1.0] * 4000, 0.005)
        faults = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_minflt
        runs = lambda count: [sm.simulate(scene, motion, histories=True).drift.size for _ in range(count)]
        runs(5)
        before = faults()
        runs(20)
        print(faults() - before)
    """)
    usual = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}
    child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=usual)
    # The histories of one run take 281 pages.
    assert int(child.stdout) < 20 * 28, child.stdout


def test_decimated_histories_are_rows_of_the_full_ones() -> None:
    full, tenth = (sm.simulate(scene(), shaking(), histories=every) for every in (True, 10))
    assert np.array_equal(tenth.drift, full.drift[::10])
    assert np.array_equal(tenth.time, full.time[::10])


def test_events_and_counts_agree() -> None:
    response = sm.simulate(scene(), shaking())
    log = response.events
    assert log.columns == ["time", "kind", "number", "sign", "element"]
    assert log["time"].is_sorted()
    assert {kind: log["kind"].to_list().count(kind) for kind in EVENT_KINDS} == response.counts
    assert response.counts["yield"] > 0
    assert response.counts["slip"] > 0
    assert log.filter(pl.col("kind") == "yield")["element"].null_count() == 0
    assert log.filter(pl.col("kind") != "yield")["element"].is_null().all()
    assert response.statistics["events"] == len(log)


def test_drift_ratios_where_heights_are_known() -> None:
    heights = [4.1, 3.3, 2.9]
    response = sm.simulate(scene(heights=heights), shaking(), histories=True)
    assert response.peak_drift_ratio == pytest.approx(response.peak_drift / heights)
    assert response.drift_ratio == pytest.approx(response.drift / heights)
    assert response.residual_drift_ratio == pytest.approx(response.residual_drift / heights)
    assert sm.simulate(scene(), shaking()).peak_drift_ratio is None


def test_responses_pickle_and_compare() -> None:
    response = sm.simulate(scene(), shaking(), histories=5, energy=True)
    back = pickle.loads(pickle.dumps(response))
    assert back == response
    assert back.events.equals(response.events)
    assert repr(back) == repr(response)
    assert response != sm.simulate(scene(mu=0.2), shaking(), histories=5, energy=True)
    # One of them has histories; heights decide drift ratios alone.
    assert response != sm.simulate(scene(), shaking(), energy=True)
    low, high, unknown = (sm.simulate(scene(heights=heights), shaking()) for heights in (3.0, 4.0, None))
    assert np.array_equal(low.peak_drift, high.peak_drift)
    assert low == sm.simulate(scene(heights=3.0), shaking())
    assert low != high
    assert low != unknown
    with pytest.raises(ValueError, match="read-only"):
        back.peak_drift[0] = 1.0


def test_a_record_is_as_good_as_its_motion() -> None:
    motion = shaking()
    record = sm.Record(motion.acceleration, motion.dt, name="noise")
    assert sm.simulate(scene(), record) == sm.simulate(scene(), motion)
    assert sm.simulate(scene(), record, duration=5.0).end_time == pytest.approx(5.0)


def test_collapse_is_a_result_and_history_after_it_is_nan() -> None:
    response = sm.simulate(sm.Scene(storeys(2), collapse_drift=0.01), shaking(pga=9.0), histories=True)
    assert response.status == "collapsed"
    assert response.collapsed_storey in (1, 2)
    assert response.peak_drift.max() == pytest.approx(0.01)
    assert len(response.drift) == 2000
    assert np.isnan(response.drift[response.time > response.end_time]).all()
    assert not np.isnan(response.drift[response.time < response.end_time]).any()


def test_ground_blocks_alone() -> None:
    response = sm.simulate(sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]), shaking(), histories=True)
    assert response.drift.shape == (2000, 0)
    assert response.slip.shape == (2000, 1)
    assert np.isnan(response.peak_base_shear)


def test_histories_of_displacements_alone_are_those_of_all() -> None:
    for every in (True, 7):
        everything = sm.simulate(scene(), shaking(), histories=every)
        displacements = sm.simulate(scene(), shaking(), histories=every, displacements_only=True)
        np.testing.assert_array_equal(displacements.drift, everything.drift)
        np.testing.assert_array_equal(displacements.slip, everything.slip)
        np.testing.assert_array_equal(displacements.time, everything.time)
        with pytest.raises(sm.errors.InvalidOption, match="displacements_only of simulate must be False"):
            displacements.storey_shear  # noqa: B018


def halved(samples: np.ndarray) -> np.ndarray:
    """The same motion at half the step."""
    return np.interp(np.arange(2 * len(samples) - 1) / 2.0, np.arange(len(samples)), samples)


def random_blocks(random: np.random.Generator, count: int) -> list[sm.Block]:
    """Blocks on the ground and on floors in any order: none on some floors, several on others, or one on each."""
    anywhere = random.integers(0, count + 1, int(random.choice([1, 2, count + 1, 2 * count + 1])))
    floors = random.permutation(count) + 1 if count and random.random() < 0.3 else anywhere
    static = random.uniform(0.02, 0.6, len(floors))
    return [
        sm.Block(floor, mass=float(random.choice([1e4, 1e5])), mu_s=mu, mu_k=mu * float(random.choice([1.0, 0.8])))
        for floor, mu in zip(floors.tolist(), static.tolist(), strict=True)
    ]


def test_histories_of_random_scenes_hold_together() -> None:
    """Rows wherever blocks lie: the same at half the step and for blocks in another order, no larger than the peaks."""
    names = ("drift", "slip", "floor_velocity", "block_velocity", "floor_acceleration", "storey_shear")
    events = collapsed = 0
    for seed in range(150):
        random = np.random.default_rng(seed)
        count = int(random.choice([0, 1, 2, 3, 4, 5, 8, 9, 13, 17]))
        blocks = random_blocks(random, count)
        building = storeys(count, mass=1.0) if count else None
        limit = float(random.uniform(0.005, 0.05)) if count and random.random() < 0.15 else None
        motion = shaking(seed, int(random.integers(3, 400)), float(random.uniform(0.5, 9.0)))
        if random.random() < 0.25:
            motion = sm.Motion(motion.acceleration, motion.dt, random.choice([2.0, 8.0]) * motion.acceleration[::-1])
        fine = [None if part is None else halved(part) for part in (motion.acceleration, motion.vertical)]
        order = random.permutation(len(blocks)).tolist()
        every = int(random.integers(2, 9))

        placed = sm.Scene(building, blocks, collapse_drift=limit)
        other = sm.Scene(building, [blocks[place] for place in order], collapse_drift=limit)
        run = sm.simulate(placed, motion, histories=True)
        decimated = sm.simulate(placed, motion, histories=every)
        permuted = sm.simulate(other, motion, histories=True)
        halves = sm.simulate(placed, sm.Motion(fine[0], motion.dt / 2.0, fine[1]), histories=2)
        events, collapsed = events + len(run.events), collapsed + (run.status == "collapsed")
        for name in names:
            rows, of_blocks = getattr(run, name), name in ("slip", "block_velocity")
            scale = np.nanmax(np.abs(rows), initial=1e-300)
            np.testing.assert_array_equal(getattr(decimated, name), rows[::every], f"seed {seed}, {name}")
            for found, wanted in ((halves, rows), (permuted, rows[:, order] if of_blocks else rows)):
                np.testing.assert_allclose(
                    getattr(found, name), wanted, rtol=0.0, atol=1e-8 * scale, err_msg=f"seed {seed}, {name}"
                )
        for name, peak in (("drift", run.peak_drift), ("slip", run.peak_slip)):
            assert (np.nanmax(np.abs(getattr(run, name)), axis=0, initial=0.0) <= peak * (1.0 + 1e-14)).all(), seed
    assert events > 2000
    assert collapsed > 5


def test_a_batch_is_one_row_per_run_in_the_order_asked_for() -> None:
    scenes = [scene(3), sm.Scene(storeys(2, heights=3.0)), scene(4), sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)])]
    motions = [shaking(seed) for seed in (1, 2)]
    table = sm.simulate_many(scenes, motions)
    assert table["scene"].to_list() == [1, 1, 2, 2, 3, 3, 4, 4]
    assert table["motion"].to_list() == [1, 2] * 4
    assert table["record"].to_list() == ["motion 1", "motion 2"] * 4
    for row in table.iter_rows(named=True):
        alone = sm.simulate(scenes[row["scene"] - 1], motions[row["motion"] - 1])
        for name in (
            "peak_drift", "peak_drift_time", "residual_drift", "peak_floor_acceleration", "peak_storey_shear",
            "peak_slip", "peak_slip_time", "residual_slip", "slip_path",
        ):  # fmt: skip
            assert row[name] == getattr(alone, name).tolist(), name
        assert row["status"] == "completed"
        assert row["reason"] is None
        assert row["end_time"] == alone.end_time
        assert row["yields"] == alone.counts["yield"]
        assert row["slips"] == alone.counts["slip"]
        assert row["events"] == len(alone.events)
        ratio = alone.peak_drift_ratio
        assert row["peak_drift_ratio"] == (None if ratio is None else ratio.tolist())
    assert table["peak_base_shear"][6] is None


def test_pairs_threads_and_equal_runs_change_no_bit() -> None:
    scenes, motions = [scene(3), scene(2)], [shaking(1), shaking(2)]
    pairs = [(2, 1), (1, 2), (2, 1), (1, 1)]
    one = sm.simulate_many(scenes, motions, pairs=pairs, threads=1)
    assert one.select("scene", "motion").rows() == pairs
    assert_frame_equal(one, sm.simulate_many(scenes, motions, pairs=np.array(pairs), threads=3), check_exact=True)
    by_product = sm.simulate_many(scenes, motions)
    assert one["peak_drift"].to_list() == [by_product["peak_drift"][2 * (s - 1) + m - 1].to_list() for s, m in pairs]


def test_collapse_in_a_batch() -> None:
    table = sm.simulate_many(sm.Scene(storeys(2), collapse_drift=0.01), shaking(pga=9.0))
    assert table["status"].to_list() == ["collapsed"]
    assert table["collapsed_storey"][0] in (1, 2)


def test_a_batch_of_nothing_has_the_same_columns() -> None:
    full, empty = sm.simulate_many(scene(), shaking()), sm.simulate_many([], [])
    assert empty.schema == full.schema
    assert len(empty) == 0
    assert len(sm.simulate_many(scene(), shaking(), pairs=[])) == 0


def test_peaks_only_keeps_every_peak() -> None:
    motion = shaking().with_duration(120.0)
    full, peaks = (sm.simulate_many(scene(), motion, peaks_only=only) for only in (False, True))
    assert full["peak_drift"].to_list() == peaks["peak_drift"].to_list()
    assert full["peak_slip"].to_list() == peaks["peak_slip"].to_list()


def test_progress_is_reported_to_the_end() -> None:
    seen: list[tuple[int, int]] = []
    sm.simulate_many(
        [scene(mu=mu) for mu in (0.1, 0.2)], shaking(), progress=lambda done, total: seen.append((done, total))
    )
    assert seen[-1] == (2, 2)
    assert seen == sorted(seen)


def test_an_error_in_progress_stops_the_batch() -> None:
    def fail(done: int, total: int) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        sm.simulate_many(scene(), shaking(), progress=fail)


def long_batch() -> tuple[list[sm.Scene], list[sm.Motion]]:
    return [scene(mu=0.1 + 1e-5 * i) for i in range(1000)], [shaking(seed, 4000) for seed in range(20)]


def test_other_threads_run_meanwhile() -> None:
    ticks = 0
    scenes, motions = long_batch()
    worker = threading.Thread(target=sm.simulate_many, args=(scenes[:100], motions[:5]))
    worker.start()
    while worker.is_alive():
        ticks += 1
        time.sleep(0.002)
    worker.join()
    assert ticks > 10


def test_other_threads_run_during_a_single_run() -> None:
    ticks = 0
    motion = shaking(1, 30_000)
    worker = threading.Thread(target=lambda: [sm.simulate(scene(), motion) for _ in range(20)])
    worker.start()
    while worker.is_alive():
        ticks += 1
        time.sleep(0.0005)
    worker.join()
    assert ticks > 10


INTERRUPTED = """
    import os, signal, sys, threading, time
    sys.path.insert(0, {tests!r})
    from test_simulate import long_batch, scene, shaking, sm
    sent = []
    def interrupt():
        time.sleep(0.4)
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)
    {preparation}
    threading.Thread(target=interrupt).start()
    try:
        {work}
    except KeyboardInterrupt:
        print(time.perf_counter() - sent[0])
    else:
        print("ran to its end")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="sends SIGINT to itself")
@pytest.mark.parametrize(
    ("preparation", "work"),
    [
        ("scenes, motions = long_batch()", "sm.simulate_many(scenes, motions)"),
        ("scenes, motions = [scene()], [shaking(1, 20_000_000)]", "sm.simulate(scenes[0], motions[0])"),
    ],
    ids=["batch", "one long run"],
)
def test_ctrl_c_stops_within_a_fifth_of_a_second(preparation: str, work: str, request: pytest.FixtureRequest) -> None:
    folder = str(request.path.parent)
    code = textwrap.dedent(INTERRUPTED).format(tests=folder, preparation=preparation, work=work)
    child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    assert child.returncode == 0, child.stderr
    # The watch wakes every 0.05 s; the rest is room for a busy machine.
    assert float(child.stdout) < 0.2 + 0.1, child.stdout
