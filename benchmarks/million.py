"""The benchmark of large batches: a million runs of a two-storey scene beside a thousand, streamed, peaks only.

Usage: python benchmarks/million.py [--runs N] [--threads N]. Both batches are products of mass ratios, friction
coefficients and intensities over the same ranges, as columns; frames are read and dropped one after the other. Each
size has a process of its own, whose peak of resident memory is that of the size. The motion is the strong part of a
built-in one.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import time
from itertools import count
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

import seismass as sm
from environment import summary

SIZES: Final = (1_000, 1_000_000)
THREADS: Final = 2
MOTION: Final = 4
"""Number of the built-in motion, from 0."""
STRONG_PART: Final = (5.0, 9.0)
"""Seconds of it."""
MASS_RATIOS: Final = (0.2, 1.5)
FRICTION: Final = (0.1, 0.5)
SCALES: Final = (0.5, 2.5)
MIB: Final = 2**20
LEAST_TIME: Final = 3.0
"""Seconds over which a batch that takes less is repeated, after a warm-up; the median is kept."""


def motion() -> sm.Motion:
    """Return the strong part of a built-in motion."""
    whole = sm.builtin_suite("seven")[MOTION].motion
    first, last = (round(time / whole.dt) for time in STRONG_PART)
    return sm.Motion(whole.acceleration[first : last + 1], whole.dt)


def grid(runs: int) -> sm.Grid:
    """Return a product of as many scenes, or the next cube above."""
    side = next(side for side in count(1) if side**3 >= runs)
    building = sm.Building.uniform(2, 0.3, mass=1000.0, yield_shear_over_weight=[0.30, 0.18])
    # Midpoints of equal cells, so that a fine product is no milder than a coarse one.
    cells: NDArray[np.float64] = (np.arange(side) + 0.5) / side
    ratio, mu, scale = (low + (high - low) * cells for low, high in (MASS_RATIOS, FRICTION, SCALES))
    return sm.Grid.product(building, mass_ratio=ratio, mu=mu, scale=scale)


def stream(scenes: sm.Grid, shaking: sm.Motion, threads: int) -> dict[str, int]:
    """Solve a batch and read its frames; return the numbers of runs and events, and of runs that failed."""
    found = {"runs": 0, "events": 0, "failed": 0}
    for frame in sm.stream_many(scenes, shaking, peaks_only=True, threads=threads):
        found["runs"] += len(frame)
        found["events"] += int(frame["events"].sum())
        found["failed"] += int(frame["status"].eq("failed").sum())
    return found


def measured_here(runs: int, threads: int) -> dict[str, Any]:
    """Return the measurements of one size; peak memory is that of this process so far."""
    import resource  # where the system has it

    scenes, shaking = grid(runs), motion()
    times: list[tuple[float, float]] = []
    while True:
        began = (time.perf_counter(), time.process_time())
        found = stream(scenes, shaking, threads)
        times.append((time.perf_counter() - began[0], time.process_time() - began[1]))
        # The first of several is the warm-up.
        if sum(wall for wall, _ in times) >= LEAST_TIME and (len(times) == 1 or len(times) > 3):
            break
    wall, processor = (statistics.median(column) for column in zip(*(times[1:] or times), strict=True))
    # Linux counts in KiB, macOS in bytes.
    unit = 1 if sys.platform == "darwin" else 1024
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / MIB
    return {
        **found,
        "repeats": len(times),
        "wall_s": wall,
        "processor_s": processor,
        "runs_per_s": found["runs"] / wall,
        "peak_mib": peak,
    }


def measure(sizes: tuple[int, ...] = SIZES, threads: int = THREADS) -> dict[str, Any]:
    """Return what was run and, by size, the measurements of a process each.

    Keys: `motion`, `samples`, `dt`, `threads`, `instructions`; and `batches`, a list of `runs`, `events`, `failed`,
    `repeats`, `wall_s` and `processor_s` (of all threads; medians), `runs_per_s`, `peak_mib` (of resident memory).
    """
    batches = []
    for runs in sizes:
        command = [sys.executable, __file__, "--here", "--runs", str(runs), "--threads", str(threads)]
        child = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
        batches.append(json.loads(child.stdout))
    used = motion()
    name = f"{sm.builtin_suite('seven')[MOTION].name}, {STRONG_PART[0]:g} to {STRONG_PART[1]:g} s"
    return {
        "motion": name,
        "samples": used.samples,
        "dt": used.dt,
        "threads": threads,
        "instructions": sm.runs.instruction_set(),
        "batches": batches,
    }


def main() -> int:
    """Print the table of both sizes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=SIZES[-1], help="size of the large batch (default: %(default)s)")
    parser.add_argument("--threads", type=int, default=THREADS, help="default: %(default)s")
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.here:
        print(json.dumps(measured_here(options.runs, options.threads)))
        return 0
    print(summary())
    found = measure((SIZES[0], options.runs), options.threads)
    print(
        f"two storeys, peaks only, streamed: {found['motion']} ({found['samples']} samples x {found['dt']:g} s), "
        f"{found['threads']} threads, {found['instructions']}"
    )
    print("       runs   events per run   failed   wall (s)   runs/s   processor us per run   peak memory (MiB)")
    for batch in found["batches"]:
        print(
            f"  {batch['runs']:9} {batch['events'] / batch['runs']:16.1f} {batch['failed']:8} {batch['wall_s']:10.3f} "
            f"{batch['runs_per_s']:8.0f} {1e6 * batch['processor_s'] / batch['runs']:22.1f} {batch['peak_mib']:19.0f}"
        )
    small, large = found["batches"]
    throughput = large["runs_per_s"] / small["runs_per_s"]
    processor = large["processor_s"] / large["runs"] / (small["processor_s"] / small["runs"])
    print(f"large over small: throughput {throughput:.3f}, processor time per run {processor:.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
