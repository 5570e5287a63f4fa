"""The benchmark of the study: its phases, kernel time per run, per sample and per event, runs per second by threads.

Usage: python benchmarks/study.py. Motions are recordings where SEISMASS_SHARED names them, otherwise built in.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Final, TypeVar

import numpy as np

import seismass as sm
from environment import summary
from scenes import suite
from seismass.report.write import write_study
from seismass.study import MODELS, StudyParameters, StudyResult, run_study, study_buildings

REPEATS: Final = 5
TARGET: Final = sm.TargetSpectrum.asce7(1.07, 0.61, 8.0)
Run = tuple[sm.Scene, sm.Motion]
T = TypeVar("T")


def timed(work: Callable[[], T], repeats: int = REPEATS) -> tuple[float, T]:
    """Return the median time after a warm-up (s), and what the work gives."""
    result, times = work(), []
    for _ in range(repeats):
        began = time.perf_counter()
        work()
        times.append(time.perf_counter() - began)
    return statistics.median(times), result


def distinct_runs(motions: sm.records.Suite) -> list[Run]:
    """Return the distinct runs of the study."""
    scaling = sm.scale_asce7_10(motions, TARGET, 1.0)
    scaled = [record.scaled(factor).motion for record, factor in zip(motions, scaling.factors, strict=True)]

    def spectrum(periods: Any) -> Any:
        return np.asarray(sm.response_spectrum(scaled, periods)).mean(axis=0)

    buildings = study_buildings(StudyParameters(), spectrum)
    scenes = dict.fromkeys(building.scenes[model] for building in buildings for model in MODELS)
    return [(scene, motion) for scene in scenes for motion in scaled]


def phases(motions: sm.records.Suite, runs: list[Run]) -> None:
    """Print the wall time of the study by phase; figures apart."""
    threads = 2
    reading, _ = timed(suite)
    scaling, _ = timed(lambda: sm.scale_asce7_10(motions, TARGET, 1.0, threads=threads))
    whole, result = timed(lambda: run_study(motions, TARGET, threads=threads))
    batch, _ = timed(lambda: simulate_all(runs, threads))
    with tempfile.TemporaryDirectory() as folder:
        tables, _ = timed(lambda: _write(result, Path(folder), figures=False))
        figures, _ = timed(lambda: _write(result, Path(folder), figures=True), repeats=1)
    print(f"study on {threads} threads (s)")
    for name, spent in (
        ("reading the motions", reading),
        ("scaling", scaling),
        ("runs", batch),
        ("design, spectra, tables in memory", whole - scaling - batch),
        ("writing tables", tables),
        ("total without figures", reading + whole + tables),
        ("figures, apart", figures - tables),
    ):
        print(f"  {name:36} {spent:8.3f}")


def _write(result: StudyResult, folder: Path, *, figures: bool) -> None:
    for file in folder.iterdir():
        file.unlink()
    write_study(result, folder, figures=figures)


def simulate_all(runs: list[Run], threads: int) -> Any:
    """Run the batch as the study does."""
    scenes = {scene: number for number, scene in enumerate(dict.fromkeys(scene for scene, _ in runs))}
    motions = {motion: number for number, motion in enumerate(dict.fromkeys(motion for _, motion in runs))}
    pairs = [(scenes[scene], motions[motion]) for scene, motion in runs]
    return sm.simulate_many(list(scenes), list(motions), pairs=pairs, threads=threads)


def throughput(runs: list[Run]) -> None:
    """Print runs per second by number of threads."""
    print("batch, peaks only")
    samples = sum(motion.samples for _, motion in runs)
    for threads in (1, 2):
        spent, table = timed(partial(simulate_all, runs, threads))
        events = int(table["events"].sum())
        print(
            f"  {threads} thread{'s' if threads > 1 else ' '}: {spent:7.3f} s, {len(runs) / spent:7.0f} runs/s, "
            f"{1e6 * spent / len(runs):7.1f} us per run, {1e9 * spent / samples:6.1f} ns per sample "
            f"({len(runs)} runs, {samples} samples, {events} events)"
        )


def kernel_times(runs: list[Run]) -> None:
    """Print the time of single runs by size and model, and its split in samples and events by least squares."""
    print("single runs, peaks only, one thread (medians over the runs; a and b: time = a samples + b events)")
    print("  storeys  model   runs   us per run   events   a: ns per sample   b: us per event")
    groups: dict[tuple[int, str], list[tuple[float, int, int]]] = {}
    for scene, motion in runs:
        spent, response = timed(partial(sm.simulate, scene, motion, events=False, energy=False))
        storeys = 0 if scene.building is None else scene.building.storeys
        model = "real" if scene.blocks else "asce"
        groups.setdefault((storeys, model), []).append((spent, motion.samples, sum(response.counts.values())))
    for (storeys, model), rows in sorted(groups.items()):
        times, samples, events = np.array(rows).T
        weights = 1.0 / times
        columns = np.stack([samples, events], axis=1) * weights[:, None]
        (a, b), *_ = np.linalg.lstsq(columns, np.ones(len(times)), rcond=None)
        print(
            f"  {storeys:7}  {model:5} {len(rows):6} {1e6 * np.median(times):12.1f} {np.median(events):8.0f} "
            f"{1e9 * a:18.1f} {1e6 * b:17.2f}"
        )


def main() -> int:
    """Print all tables."""
    print(summary())
    motions = suite()
    print(f"suite: {motions.name}, {len(motions)} motions")
    runs = distinct_runs(motions)
    phases(motions, runs)
    throughput(runs)
    kernel_times(runs)
    return 0


if __name__ == "__main__":
    sys.exit(main())
