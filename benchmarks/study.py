"""The benchmark of the study: its phases, kernel time per run, per sample and per event, runs per second by threads.

Usage: python benchmarks/study.py [--quick]; the quick one repeats nothing and draws no figures. Motions are recordings
where SEISMASS_SHARED names them, otherwise built in.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final, TypeVar

import numpy as np

import seismass as sm
from environment import summary
from scenes import FloatArray, suite
from seismass.show.study.write import write_study
from seismass.studies.study import MODELS, StudyParameters, StudyResult, run_study, study_buildings

REPEATS: Final = 5
TOTAL: Final = "total without figures"
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
    scaling = sm.scaling.scale_asce7_10(motions, TARGET, 1.0, between=False)
    scaled = [record.scaled(factor).motion for record, factor in zip(motions, scaling.factors, strict=True)]

    def spectrum(periods: Any) -> Any:
        return np.asarray(sm.response_spectrum(scaled, periods)).mean(axis=0)

    buildings = study_buildings(StudyParameters(), spectrum)
    scenes = dict.fromkeys(building.scenes[model] for building in buildings for model in MODELS)
    return [(scene, motion) for scene in scenes for motion in scaled]


def phases(
    motions: sm.records.Suite, runs: list[Run], repeats: int = REPEATS, *, figures: bool = True
) -> dict[str, float]:
    """Return the wall time of the study by phase (s), their sum, and the figures apart where they are wanted."""
    threads = 2
    reading, _ = timed(suite, repeats)
    scaling, _ = timed(lambda: sm.scaling.scale_asce7_10(motions, TARGET, 1.0, between=False, threads=threads), repeats)
    whole, result = timed(lambda: run_study(motions, TARGET, threads=threads), repeats)
    batch, _ = timed(lambda: simulate_all(runs, threads), repeats)
    with tempfile.TemporaryDirectory() as folder:
        tables, _ = timed(lambda: _write(result, Path(folder), figures=False), repeats)
        drawn = timed(lambda: _write(result, Path(folder), figures=True), repeats=1)[0] if figures else None
    found = {
        "reading the motions": reading,
        "scaling": scaling,
        "runs": batch,
        "design, spectra, tables in memory": whole - scaling - batch,
        "writing tables": tables,
        TOTAL: reading + whole + tables,
    }
    return found if drawn is None else found | {"figures, apart": drawn - tables}


def print_phases(motions: sm.records.Suite, runs: list[Run], repeats: int, *, figures: bool) -> None:
    """Print the wall time of the study by phase; figures apart."""
    print("study on 2 threads (s)")
    for name, spent in phases(motions, runs, repeats, figures=figures).items():
        print(f"  {name:36} {spent:8.3f}")


def _write(result: StudyResult, folder: Path, *, figures: bool) -> None:
    for file in folder.iterdir():
        file.unlink()
    write_study(result, folder, figures=figures)


def simulate_all(runs: list[Run], threads: int) -> Any:
    """Run the batch as the study does."""
    scenes = {scene: number for number, scene in enumerate(dict.fromkeys(scene for scene, _ in runs), start=1)}
    motions = {motion: number for number, motion in enumerate(dict.fromkeys(motion for _, motion in runs), start=1)}
    pairs = [(scenes[scene], motions[motion]) for scene, motion in runs]
    return sm.simulate_many(list(scenes), list(motions), pairs=pairs, threads=threads)


def throughput(runs: list[Run], repeats: int) -> None:
    """Print runs per second by number of threads."""
    print("batch, peaks only")
    samples = sum(motion.samples for _, motion in runs)
    for threads in (1, 2):
        spent, table = timed(partial(simulate_all, runs, threads), repeats)
        events = int(table["events"].sum())
        print(
            f"  {threads} thread{'s' if threads > 1 else ' '}: {spent:7.3f} s, {len(runs) / spent:7.0f} runs/s, "
            f"{1e6 * spent / len(runs):7.1f} us per run, {1e9 * spent / samples:6.1f} ns per sample "
            f"({len(runs)} runs, {samples} samples, {events} events)"
        )


@dataclass(frozen=True)
class RunTime:
    """Time of a single run, peaks only, on one thread (median, s), and the work it did."""

    storeys: int
    model: str
    time: float
    samples: int
    events: int
    regimes: int


def run_times(runs: list[Run], repeats: int = REPEATS) -> list[RunTime]:
    """Return the time of each run."""
    found = []
    for scene, motion in runs:
        spent, response = timed(partial(sm.simulate, scene, motion, events=False, energy=False), repeats)
        storeys = 0 if scene.building is None else scene.building.storeys
        model = "real" if scene.blocks else "glued"
        events = sum(response.counts.values())
        found.append(RunTime(storeys, model, spent, motion.samples, events, response.statistics["regimes"]))
    return found


def split(rows: list[RunTime], work: Sequence[str]) -> FloatArray:
    """Return the time of each kind of work (s) by least squares over runs, each weighted to count alike."""
    weights = 1.0 / np.array([row.time for row in rows])
    columns = np.array([[getattr(row, name) for name in work] for row in rows]) * weights[:, None]
    return np.asarray(np.linalg.lstsq(columns, np.ones(len(rows)), rcond=None)[0], dtype=np.float64)


def kernel_times(runs: list[Run], repeats: int) -> None:
    """Print the time of single runs by size and model, and its split in samples and events by least squares."""
    print("single runs, peaks only, one thread (medians over the runs; a and b: time = a samples + b events)")
    print("  storeys  model   runs   us per run   events   a: ns per sample   b: us per event")
    found = run_times(runs, repeats)
    for storeys, model in sorted({(row.storeys, row.model) for row in found}):
        rows = [row for row in found if (row.storeys, row.model) == (storeys, model)]
        a, b = split(rows, ("samples", "events"))
        print(
            f"  {storeys:7}  {model:5} {len(rows):6} {1e6 * statistics.median(row.time for row in rows):12.1f} "
            f"{statistics.median(row.events for row in rows):8.0f} {1e9 * a:18.1f} {1e6 * b:17.2f}"
        )


def main(arguments: Sequence[str] | None = None) -> int:
    """Print all tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--quick", action="store_true", help="nothing repeated, no figures")
    quick = parser.parse_args(arguments).quick
    repeats = 1 if quick else REPEATS
    print(summary())
    motions = suite()
    print(f"suite: {motions.name}, {len(motions)} motions")
    runs = distinct_runs(motions)
    print_phases(motions, runs, repeats, figures=not quick)
    throughput(runs, repeats)
    kernel_times(runs, repeats)
    return 0


if __name__ == "__main__":
    sys.exit(main())
