"""The benchmark of campaigns: runs into a folder beside runs streamed, and workers beside threads.

Usage: python benchmarks/campaign.py [--runs N] [--rounds N] [--workers N] [--write PAGE]. The scene is that of
million.py: two storeys, peaks only, four seconds of a built-in motion. First, rounds of the same runs, streamed and
into a folder, one after the other, whose medians give the ratio. Then the runs of `--runs` into a folder, in a process
of its own, whose peak of resident memory is kept. Last, rounds of threads in one process and of local dask workers, at
parts of at least two seconds, and once with a worker killed on the way.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any, Final, NamedTuple

import million
import seismass as sm
from environment import summary
from scale_page import page

LARGE: Final = 10_000_000
SMALL: Final = 1_000_000
ROUNDS: Final = 5
WORKERS: Final = 2
PART_SECONDS: Final = 2.0
"""Least time of a part of one worker in the comparison of engines."""
KINDS: Final[dict[str, dict[str, Any]]] = {
    "all columns": {},
    "all columns, single": {"single": True},
    "peak drift, slip": {"columns": ["peak_drift", "peak_slip"]},
    "peak drift, slip, single": {"columns": ["peak_drift", "peak_slip"], "single": True},
}
"""What may be kept, for the bytes of a run."""


def campaign(runs: int, **options: Any) -> sm.campaign.Campaign:
    """Return the campaign of so many runs, or of the next cube above."""
    return sm.campaign.Campaign(million.grid(runs), million.motion(), peaks_only=True, **options)


class Measured(NamedTuple):
    """Wall time, processor time of all threads of this process (s), and bytes of the parts."""

    wall: float
    processor: float
    size: int = 0


def streamed(runs: int, threads: int) -> Measured:
    """Measure runs that are streamed and dropped."""
    scenes, shaking = million.grid(runs), million.motion()
    began = time.perf_counter(), time.process_time()
    million.stream(scenes, shaking, threads)
    return Measured(time.perf_counter() - began[0], time.process_time() - began[1])


def into_folder(made: sm.campaign.Campaign, **engine: Any) -> Measured:
    """Measure a campaign into a new folder."""
    place = Path(tempfile.mkdtemp(prefix="campaign-", dir="."))
    try:
        began = time.perf_counter(), time.process_time()
        folder = made.run(place, **engine)
        return Measured(time.perf_counter() - began[0], time.process_time() - began[1], folder.bytes)
    finally:
        shutil.rmtree(place)


def compared(before: list[Measured], after: list[Measured]) -> dict[str, float]:
    """Return medians of ratios, round by round, of wall and of processor times, with least and most of the former."""
    walls = [b.wall / a.wall for a, b in zip(before, after, strict=True)]
    processors = [b.processor / a.processor for a, b in zip(before, after, strict=True)]
    return {
        "ratio": statistics.median(walls),
        "least": min(walls),
        "most": max(walls),
        "processor_ratio": statistics.median(processors),
    }


def files_beside_stream(rounds: int, threads: int) -> dict[str, Any]:
    """Return medians of both, round by round, and of their ratio."""
    made = campaign(SMALL)
    million.stream(million.grid(SMALL // 10), million.motion(), threads)  # warm-up
    pairs = [(streamed(SMALL, threads), into_folder(made, threads=threads)) for _ in range(rounds)]
    before, after = ([pair[place] for pair in pairs] for place in (0, 1))
    return {
        "runs": made.total,
        "streamed_s": statistics.median(each.wall for each in before),
        "folder_s": statistics.median(each.wall for each in after),
        **compared(before, after),
    }


def large_here(runs: int, threads: int) -> dict[str, Any]:
    """Return the measurements of a large campaign; peak memory is that of this process."""
    import resource  # where the system has it

    made = campaign(runs)
    seconds, _, size = into_folder(made, threads=threads)
    unit = 1 if sys.platform == "darwin" else 1024
    return {
        "runs": made.total,
        "parts": made.parts,
        "wall_s": seconds,
        "bytes": size,
        "peak_mib": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / million.MIB,
    }


def in_own_process(mode: str, options: argparse.Namespace) -> Any:
    """Return what this program prints in another process."""
    command = [sys.executable, __file__, "--here", mode, "--runs", str(options.runs)]
    child = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(child.stdout)


def sizes(runs: int) -> dict[str, float]:
    """Return bytes a run by what is kept."""
    found = {}
    for name, kept in KINDS.items():
        made = campaign(runs, **kept)
        found[name] = into_folder(made).size / made.total
    return found


def engines(rounds: int, workers: int, rate: float) -> dict[str, Any]:
    """Return medians of threads and of workers that are there already, and of workers of which one is killed."""
    from distributed import Client, LocalCluster

    # A worker has one thread: parts of at least two seconds of it, an even share for each, eight parts a worker.
    part_runs = round(1.25 * PART_SECONDS * rate / million.THREADS)
    made = campaign(8 * workers * part_runs, part_runs=part_runs)
    before: list[Measured] = []
    after: list[Measured] = []
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        executor = client.get_executor(retries=3)
        into_folder(campaign(20 * part_runs // 8, part_runs=part_runs // 8), executor=executor)  # warm-up
        for _ in range(rounds):
            before.append(into_folder(made, threads=workers))
            spent = sum(client.run(time.process_time).values())
            own = into_folder(made, executor=executor)
            spent = sum(client.run(time.process_time).values()) - spent
            after.append(own._replace(processor=own.processor + spent))
        usual = statistics.median(each.wall for each in after)
        pids = list(client.run(os.getpid).values())
        timer = threading.Timer(usual / 2.0, os.kill, (pids[0], signal.SIGKILL))
        timer.start()
        killed = into_folder(made, executor=executor).wall
        timer.join()
    return {
        "workers": workers,
        "runs": made.total,
        "parts": made.parts,
        "part_s": usual * workers / made.parts,
        "threads_s": statistics.median(each.wall for each in before),
        "workers_s": usual,
        "killed_s": killed,
        **compared(before, after),
    }


def measure(options: argparse.Namespace) -> dict[str, Any]:
    """Return all measurements."""
    found: dict[str, Any] = {"machine": summary(("numpy", "polars", "distributed")), "threads": million.THREADS}
    found["files"] = files_beside_stream(options.rounds, million.THREADS)
    found["large"] = in_own_process("large", options)
    found["sizes"] = sizes(SMALL // 5)
    found["engines"] = engines(options.rounds, options.workers, found["large"]["runs"] / found["large"]["wall_s"])
    return found


def main() -> int:
    """Print the measurements; write the page of scale with them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=LARGE, help="runs of the large campaign (default: %(default)s)")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help="default: %(default)s")
    parser.add_argument("--workers", type=int, default=WORKERS, help="default: %(default)s")
    parser.add_argument("--write", type=Path, metavar="PAGE", help="write the page of scale, docs/scale.md")
    parser.add_argument("--here", choices=("large",), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.here:
        print(json.dumps(large_here(options.runs, million.THREADS)))
        return 0
    text = page(measure(options))
    print(text, end="")
    if options.write is not None:
        options.write.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
