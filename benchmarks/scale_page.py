"""The page of scale: what campaigns of any size cost, from the measurements of campaign.py."""

from __future__ import annotations

import math
from typing import Any, Final

from seismass.campaign.progress import duration_text

SIZES: Final = (10**6, 10**9, 10**12)
CORES: Final = (2, 64, 4096)
DISK_MB_PER_S: Final = 200.0
"""What a shared disk is assumed to write."""
TASKS_PER_S: Final = 1000.0
"""What one dask scheduler is assumed to hand out; its documentation says 200 microseconds to 1 ms of overhead a task."""
PART_SECONDS: Final = 10.0
"""Time of a part of one core that projections assume: long beside the overhead of a task, short beside a lost worker."""


def page(found: dict[str, Any]) -> str:
    """Return the page in Markdown."""
    files, large, engine = found["files"], found["large"], found["engines"]
    rate = large["runs"] / large["wall_s"] / found["threads"]
    size = large["bytes"] / large["runs"]
    small = min(found["sizes"].values())
    head = f"""# What campaigns cost, to 10^12 runs

Measured by `python benchmarks/campaign.py --write docs/scale.md` on {found["machine"]}.

The scene is the one of the large batches of [performance.md](performance.md): two storeys with goods on both floors,
peaks only, four seconds of a built-in motion, {found["threads"]} threads. Longer motions and more events cost in
proportion: [performance.md](performance.md) has the cost of a sample and of an event.

| measured | runs | time | runs a second | |
| --- | --- | --- | --- | --- |
| streamed and dropped, without files | {files["runs"]:,} | {files["streamed_s"]:.1f} s | {files["runs"] / files["streamed_s"]:,.0f} | |
| into a folder | {files["runs"]:,} | {files["folder_s"]:.1f} s | {files["runs"] / files["folder_s"]:,.0f} | {files["ratio"]:.2f} times the time of streaming ({files["least"]:.2f} to {files["most"]:.2f}) |
| into a folder, in its own process | {large["runs"]:,} | {large["wall_s"]:.0f} s | {large["runs"] / large["wall_s"]:,.0f} | {large["parts"]} parts, {size:.1f} bytes a run, peak of resident memory {large["peak_mib"]:.0f} MiB |
| {engine["workers"]} threads of one process | {engine["runs"]:,} | {engine["threads_s"]:.1f} s | {engine["runs"] / engine["threads_s"]:,.0f} | {engine["parts"]} parts of {engine["part_s"]:.1f} s |
| {engine["workers"]} dask workers of one thread | {engine["runs"]:,} | {engine["workers_s"]:.1f} s | {engine["runs"] / engine["workers_s"]:,.0f} | {engine["ratio"]:.2f} times the time of threads ({engine["least"]:.2f} to {engine["most"]:.2f}) |
| the same, a worker killed half-way | {engine["runs"]:,} | {engine["killed_s"]:.1f} s | | its parts are solved again |

Medians of rounds in which both were run one after the other; ratios are of the same round, with least and most.

| kept | bytes a run |
| --- | --- |
"""
    rows = "".join(f"| {name} | {value:.1f} |\n" for name, value in found["sizes"].items())
    return head + rows + _projection(rate, size, small, engine["ratio"])


def _projection(rate: float, size: float, small: float, overhead: float) -> str:
    part_runs = min(2**24, 2 ** round(math.log2(rate * PART_SECONDS)))
    lines = [
        f"""
## The law used beyond

A run costs the same whatever the number of runs: nothing is kept from part to part but the inputs, and parts do not
wait for each other. The cost of 10^6 runs and of the {10**7:,} that were measured is proportional. Beyond, the time is runs /
(cores x {rate:,.0f} runs a second), times {max(overhead, 1.0):.2f} for the workers. The size is runs x bytes a run. Parts have
{part_runs:,} runs here, some {part_runs / rate:.0f} s of a core.

| runs | cores | time | all columns | smallest of the table | parts | written, MB/s | tasks, 1/s |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""
    ]
    for runs in SIZES:
        for cores in CORES:
            seconds = runs / (cores * rate) * max(overhead, 1.0)
            parts = -(-runs // part_runs)
            lines.append(
                f"| 10^{round(math.log10(runs))} | {cores} | {duration_text(seconds)} | {_bytes(runs * size)} | {_bytes(runs * small)} | "
                f"{parts:,} | {runs * size / seconds / 1e6:.2g} | {parts / seconds:.2g} |\n"
            )
    most_disk = DISK_MB_PER_S * 1e6 / (size * rate)
    most_tasks = TASKS_PER_S * part_runs / rate
    lines.append(f"""
Projections, not measurements, from one machine to others of equal cores. What is measured ends at two cores and
{10**7:,} runs.

## Where the ceiling is

- **Disk.** A core writes {size * rate / 1e6:.2g} MB/s with all columns. A shared disk of {DISK_MB_PER_S:.0f} MB/s (assumed) serves some
  {most_disk:,.0f} cores; with the smallest of the table {DISK_MB_PER_S * 1e6 / (small * rate):,.0f}. 10^12 runs are {_bytes(1e12 * size)}, or {_bytes(1e12 * small)}: keep few columns,
  or reduce each part as it comes with `Campaign.solve`.
- **Scheduler.** A part is one task, a message of a name and two numbers. At {TASKS_PER_S:,.0f} tasks a second (assumed, the order
  that dask's documentation gives) one scheduler serves some {most_tasks:,.0f} cores. Jobs of an array (`shard`) need none.
- **Client.** It holds at most 1024 tasks and no rows. With the names of the parts that are there, memory is some 100 bytes a
  part.
- **Files.** Parts are in one folder. Choose `part_runs` so that there are fewer than some 10^5 of them, up to 2^24 runs a
  part (a worker holds one part: {2**24 * 250 / 1e9:.1f} GB with all columns). Above that, use several campaigns.
- **Axes.** A product is described by the values of its axes, whatever its size. A sample holds every value: 8 bytes for each
  column and scene, in each worker. Numbers of scenes and runs go to 2^53.
- **Polars.** Lazy frames of more than 2^32 rows need its 64-bit build (`pip install "polars[rt64]"`).
""")
    return "".join(lines)


def _bytes(size: float) -> str:
    """Return a size in the largest of its units."""
    for unit, scale in (("PB", 1e15), ("TB", 1e12), ("GB", 1e9), ("MB", 1e6)):
        if size >= scale:
            return f"{size / scale:.3g} {unit}"
    return f"{size / 1e3:.3g} kB"
