"""The page of scale: what campaigns of any size cost, from the measurements of campaign.py."""

from __future__ import annotations

import math
from typing import Any, Final

from seismass.studies.campaign.campaign import MOST_PART_RUNS
from seismass.studies.campaign.engine import duration_text

SIZES: Final = (10**6, 10**9, 10**12)
CORES: Final = (2, 64, 4096)
DISK_MB_PER_S: Final = 200.0
"""What a shared disk is assumed to write."""
TASKS_PER_S: Final = 1000.0
"""What one dask scheduler is assumed to hand out: its documentation says up to 1 ms of overhead a task."""
MOST_FILES: Final = 10**5
"""Parts that a folder is assumed to hold well."""
PART_SECONDS: Final = 10.0
"""Time of a part of one core in projections: long beside the overhead of a task, short beside a lost worker."""


def page(found: dict[str, Any]) -> str:
    """Return the page in Markdown."""
    return "\n".join([*_measured(found), *_law(found), *_ceiling(found)]) + "\n"


def _row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"


def _spread(values: dict[str, Any]) -> str:
    wall = f"{values['ratio']:.2f} ({values['least']:.2f} to {values['most']:.2f})"
    return f"{wall}, of processor times {values['processor_ratio']:.2f}"


def _measured(found: dict[str, Any]) -> list[str]:
    files, large, engine = found["files"], found["large"], found["engines"]
    size, workers = large["bytes"] / large["runs"], engine["workers"]
    of_large = f"{large['parts']} parts, {size:.1f} bytes a run, peak of resident memory {large['peak_mib']:.0f} MiB"
    of_parts = f"{engine['parts']} parts of {engine['part_s']:.1f} s of a core"
    head = f"""# What campaigns cost, to 10^12 runs

Measured by `python benchmarks/campaign.py --write docs/scale.md` on {found["machine"]}.

The scene is the one of the large batches of [performance.md](performance.md): two storeys with goods on both floors,
peaks only, four seconds of a built-in motion, {found["threads"]} threads. Longer motions and more events cost in
proportion; [performance.md](performance.md) has the cost of a sample and of an event.
"""
    rows = (
        ("streamed and dropped, without files", files["runs"], files["streamed_s"], ""),
        ("into a folder", files["runs"], files["folder_s"], f"time over that of streaming: {_spread(files)}"),
        ("into a folder, in a process of its own", large["runs"], large["wall_s"], of_large),
        (f"{workers} threads of one process", engine["runs"], engine["threads_s"], of_parts),
        (
            f"{workers} dask workers of one thread",
            engine["runs"],
            engine["workers_s"],
            f"time over that of threads: {_spread(engine)}",
        ),
        (
            "the same, a worker killed half-way",
            engine["runs"],
            engine["killed_s"],
            "its part is solved again, and another worker is started",
        ),
    )
    return [
        head,
        _row("measured", "runs", "time (s)", "runs a second", "beside"),
        _row(*["---"] * 5),
        *(_row(what, f"{runs:,}", f"{time:.1f}", f"{runs / time:,.0f}", more) for what, runs, time, more in rows),
        """
Medians of rounds in which both were run one after the other. Ratios are of the same round, with the least and the
most. Processor times, of client and workers together, are what a shared machine disturbs least.
""",
        _row("kept", "bytes a run"),
        _row("---", "---"),
        *(_row(name, f"{value:.1f}") for name, value in found["sizes"].items()),
        "",
    ]


def _law(found: dict[str, Any]) -> list[str]:
    large = found["large"]
    rate, size = _rate_of_core(found), large["bytes"] / large["runs"]
    small, overhead = min(found["sizes"].values()), max(found["engines"]["processor_ratio"], 1.0)
    head = f"""## The law used beyond

A run costs the same whatever the number of runs: nothing is kept from part to part but the inputs, and parts do not
wait for each other. Beyond the {large["runs"]:,} runs that were measured, the time is taken as runs over (cores x
{rate:,.0f} runs a second), at least the time of one part, times {overhead:.2f} for workers; the size as runs x bytes
a run. Parts take {PART_SECONDS:.0f} s of a core or more.

"""
    names = ("runs", "cores", "runs of a part", "parts", "time", "all columns", "fewest columns", "MB/s", "tasks/s")
    lines = [_row(*names), _row(*["---"] * len(names))]
    for runs in SIZES:
        part_runs = min(_part_runs(rate, runs), runs)
        parts = -(-runs // part_runs)
        for cores in CORES:
            seconds = max(runs / (cores * rate), part_runs / rate) * overhead
            cells = [
                f"10^{round(math.log10(runs))}",
                f"{cores}",
                f"{part_runs:,}",
                f"{parts:,}",
                duration_text(seconds),
            ]
            cells += [_bytes(runs * size), _bytes(runs * small)]
            cells += [f"{runs * size / seconds / 1e6:.2g}", f"{parts / seconds:.2g}"]
            lines.append(_row(*cells))
    tail = """
These are projections from one machine to others of equal cores. What is measured ends at two cores and at the runs
of the first table. Smaller parts let more cores share a small campaign.
"""
    return [head + "\n".join(lines), tail]


def _ceiling(found: dict[str, Any]) -> list[str]:
    large = found["large"]
    rate, size, small = _rate_of_core(found), large["bytes"] / large["runs"], min(found["sizes"].values())
    most_tasks = TASKS_PER_S * _part_runs(rate, 1) / rate
    all_disk, few_disk = (DISK_MB_PER_S * 1e6 / (each * rate) for each in (size, small))
    written, disk = f"{size * rate / 1e6:.2g}", f"{DISK_MB_PER_S:.0f}"
    files = f"{-(-(10**12) // MOST_PART_RUNS):,}"
    return [
        f"""## Where the ceiling is

- **Disk.** A core writes {written} MB/s with all columns. A shared disk of {disk} MB/s (assumed) serves some
  {all_disk:,.0f} cores, and {few_disk:,.0f} with the fewest columns. 10^12 runs are {_bytes(1e12 * size)} or
  {_bytes(1e12 * small)}: keep few columns, or reduce each part as it comes with `Campaign.solve`.
- **Scheduler.** A part is one task: a message of a name and two numbers, and one back. At {TASKS_PER_S:,.0f} tasks a
  second (assumed, the order that dask's documentation gives) one scheduler serves some {most_tasks:,.0f} cores with
  parts of {PART_SECONDS:.0f} s. Jobs of an array (`shard`) need none.
- **Client.** It holds no rows and at most 1024 tasks. The numbers of the parts that are there take some 100 bytes each.
- **Files.** Parts are in one folder. `part_runs` may be up to {MOST_PART_RUNS:,}, which is {files} files for 10^12
  runs; a worker then holds a part of that size in memory. Beyond some {MOST_FILES:,} files, use several campaigns.
- **Axes.** A product is described by the values of its axes, whatever its size. A sample holds 8 bytes for each column
  and scene, in each worker. Numbers of scenes and runs go to 2^53.
- **Polars.** Lazy frames of more than 2^32 rows need its 64-bit build (`pip install "polars[rt64]"`)."""
    ]


def _rate_of_core(found: dict[str, Any]) -> float:
    """Runs per second and core of the large campaign."""
    rate: float = found["large"]["runs"] / found["large"]["wall_s"] / found["threads"]
    return rate


def _part_runs(rate: float, runs: int) -> int:
    """Runs of a part in projections: some seconds of a core, or as many as keep the number of files low."""
    wanted = max(rate * PART_SECONDS, runs / MOST_FILES)
    return min(MOST_PART_RUNS, 1 << math.ceil(math.log2(wanted)))


def _bytes(size: float) -> str:
    """Return a size in the largest of its units."""
    for unit, scale in (("PB", 1e15), ("TB", 1e12), ("GB", 1e9), ("MB", 1e6)):
        if size >= scale:
            return f"{size / scale:.3g} {unit}"
    return f"{size / 1e3:.3g} kB"
