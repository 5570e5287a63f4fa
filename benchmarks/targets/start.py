"""What it costs to begin: the import, a call on a short record, and whole programs that do one thing."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np

import seismass as sm
from targets.base import RUNS, Section, Target, four_storeys, median_time, strong_motions, table

SAMPLES: Final = 10
USED: Final = "seismass.simulate, seismass.simulate_many, seismass.effective_mass"
"""Names are imported when they are first used: a run, a batch and an effective fraction bring most of the package."""
IMPORT: Final = f"""
from time import perf_counter as now
start = now()
import numpy, polars
between = now()
import seismass
imported = now()
{USED}
print(between - start, imported - between, now() - between)
"""
RUN: Final = """
import seismass as sm
building = sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.24, 0.20, 0.12], heights=3.5)
scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
sm.simulate(scene, sm.builtin_record("synthetic-1").scaled(1.5))
"""
COMMAND: Final = ("-m", "seismass")
PROGRAMS: Final = {
    "`seismass --help`": (*COMMAND, "--help"),
    "`seismass building --help`": (*COMMAND, "building", "--help"),
    "import and one run": ("-c", RUN),
    "`seismass building FILE --no-figures`": (*COMMAND, "building", "warehouse.toml", "--no-figures"),
}
BOUNDS: Final = {"import and one run": 0.3, "`seismass building FILE --no-figures`": 2.0}
"""Processor time (s) that a program may take."""
TEXT: Final = """\
`import seismass` in fresh processes, after numpy and polars, on which it depends; medians of {starts} starts with warm
file caches. Names are imported when they are first used; the target is for the import together with
`{used}`.
One call of `sm.simulate` on {samples} samples of the building of 4 storeys with blocks measures the cost that does not
grow with the motion.

{table}
Processor time, user and system, of programs from their start to their end, NumPy included; medians of {programs}. FILE
is that of `seismass building --example`.

{whole}
Modules that take longest to import, by `python -X importtime`: {slowest}.
"""


def _slowest() -> str:
    """Modules below seismass by the time that they take themselves."""
    command = [sys.executable, "-X", "importtime", "-c", f"import numpy, polars, seismass; {USED}"]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stderr.splitlines()
    rows = [[part.strip() for part in line.removeprefix("import time:").split("|")] for line in lines if "|" in line]
    modules = [name for _, _, name in rows]
    ours = rows[modules.index("polars") + 1 :] if "polars" in modules else rows
    timed = sorted(((int(own), name) for own, _, name in ours if own.isdigit()), reverse=True)
    return ", ".join(f"`{name}` {own / 1000.0:.1f} ms" for own, name in timed[:6])


def _processor_time(arguments: Sequence[str], folder: str) -> float:
    """Processor time (s) of a program of Python."""
    before = os.times()
    subprocess.run([sys.executable, *arguments], cwd=folder, check=True, capture_output=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def _programs(times: int) -> dict[str, float]:
    """Median processor time (s) of each program."""
    with tempfile.TemporaryDirectory() as folder:
        example = subprocess.run([sys.executable, *COMMAND, "building", "--example"], check=True, capture_output=True)
        Path(folder, "warehouse.toml").write_bytes(example.stdout)
        return {
            name: statistics.median(_processor_time(words, folder) for _ in range(times))
            for name, words in PROGRAMS.items()
        }


def section(*, quick: bool) -> Section:
    """Measure both."""
    starts = 1 if quick else 25
    command = [sys.executable, "-c", IMPORT]
    times = [
        [float(word) for word in subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()]
        for _ in range(starts)
    ]
    below, alone, ours = (statistics.median(column) for column in zip(*times, strict=True))
    name, motion = strong_motions()[0]
    bench = four_storeys(motion, name)
    short = sm.Motion(np.array(motion.acceleration[:SAMPLES]), motion.dt)
    seconds = 0.05 if quick else 1.0
    call = median_time(lambda: sm.simulate(bench.scene, short, **RUNS), seconds)
    histories = median_time(lambda: sm.simulate(bench.scene, short, histories=True, energy=True), seconds)
    programs = 1 if quick else 5
    whole = _programs(programs)
    targets = [
        Target("import with what is used, beyond numpy and polars", 1e3 * ours, 150.0, "ms"),
        Target(f"one call on {SAMPLES} samples", 1e6 * call, 20.0, "us"),
        *(Target(f"processor time of {name}", whole[name], bound, "s", later=True) for name, bound in BOUNDS.items()),
    ]
    shown = table(
        ("", "time"),
        [
            ["import numpy, polars", f"{1e3 * below:.0f} ms"],
            ["import seismass after them", f"{1e3 * alone:.1f} ms"],
            ["the same with a run, a batch and an effective fraction", f"{1e3 * ours:.0f} ms"],
            [f"sm.simulate, {SAMPLES} samples, peaks only", f"{1e6 * call:.1f} us"],
            ["the same with histories, events and energies", f"{1e6 * histories:.1f} us"],
        ],
    )
    text = TEXT.format(
        starts=starts,
        samples=SAMPLES,
        used=USED,
        table=shown,
        programs=programs,
        whole=table(("program", "processor time"), [[name, f"{time:.2f} s"] for name, time in whole.items()]),
        slowest=_slowest(),
    )
    return Section("Starting", targets, text)
