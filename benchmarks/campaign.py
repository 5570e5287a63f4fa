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
from typing import Any, Final

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


def campaign(runs: int, **options: Any) -> sm.Campaign:
    """Return the campaign of so many runs, or of the next cube above."""
    return sm.Campaign(million.grid(runs), million.motion(), peaks_only=True, **options)


def streamed(runs: int, threads: int) -> float:
    """Return the wall time of runs that are streamed and dropped (s)."""
    scenes, shaking = million.grid(runs), million.motion()
    began = time.perf_counter()
    million.stream(scenes, shaking, threads)
    return time.perf_counter() - began


def into_folder(made: sm.Campaign, **engine: Any) -> tuple[float, int]:
    """Return the wall time of a campaign into a new folder (s), and the bytes of its parts."""
    place = Path(tempfile.mkdtemp(prefix="campaign-", dir="."))
    try:
        began = time.perf_counter()
        folder = made.run(place, **engine)
        return time.perf_counter() - began, folder.bytes
    finally:
        shutil.rmtree(place)


def files_beside_stream(rounds: int, threads: int) -> dict[str, Any]:
    """Return medians of both, round by round, and of their ratio."""
    made = campaign(SMALL)
    million.stream(million.grid(SMALL // 10), million.motion(), threads)  # warm-up
    pairs = [(streamed(SMALL, threads), into_folder(made, threads=threads)[0]) for _ in range(rounds)]
    return {
        "runs": made.total,
        "streamed_s": statistics.median(pair[0] for pair in pairs),
        "folder_s": statistics.median(pair[1] for pair in pairs),
        "ratio": statistics.median(pair[1] / pair[0] for pair in pairs),
        "least": min(pair[1] / pair[0] for pair in pairs),
        "most": max(pair[1] / pair[0] for pair in pairs),
    }


def large_here(runs: int, threads: int) -> dict[str, Any]:
    """Return the measurements of a large campaign; peak memory is that of this process."""
    import resource  # where the system has it

    made = campaign(runs)
    seconds, size = into_folder(made, threads=threads)
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
        found[name] = into_folder(made)[1] / made.total
    return found


def engines(rounds: int, workers: int, rate: float) -> dict[str, Any]:
    """Return medians of threads and of workers that are there already, and of workers of which one is killed."""
    from distributed import Client, LocalCluster

    # A worker has one thread: parts of at least two seconds of it, an even share for each, eight parts a worker.
    part_runs = round(1.25 * PART_SECONDS * rate / million.THREADS)
    made = campaign(8 * workers * part_runs, part_runs=part_runs)
    times: dict[str, list[float]] = {"threads": [], "workers": []}
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        executor = client.get_executor(retries=3)
        into_folder(campaign(20 * part_runs // 8, part_runs=part_runs // 8), executor=executor)  # warm-up
        for _ in range(rounds):
            times["threads"].append(into_folder(made, threads=workers)[0])
            times["workers"].append(into_folder(made, executor=executor)[0])
        pids = list(client.run(os.getpid).values())
        timer = threading.Timer(statistics.median(times["workers"]) / 2.0, os.kill, (pids[0], signal.SIGKILL))
        timer.start()
        killed = into_folder(made, executor=executor)[0]
        timer.join()
    ratios = [after / before for before, after in zip(times["threads"], times["workers"], strict=True)]
    return {
        "workers": workers,
        "runs": made.total,
        "parts": made.parts,
        "part_s": statistics.median(times["workers"]) * workers / made.parts,
        "threads_s": statistics.median(times["threads"]),
        "workers_s": statistics.median(times["workers"]),
        "ratio": statistics.median(ratios),
        "least": min(ratios),
        "most": max(ratios),
        "killed_s": killed,
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
