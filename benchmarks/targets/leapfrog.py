"""One exact run beside one pass of the half-explicit leapfrog at the record's own step."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

import seismass as sm
from scenes import BenchmarkScene, at_half_step
from targets.base import Section, Target, repeated, section4_scenes, table
from targets.program import FLAGS, PROCESSES, timings

OUTPUTS = {
    "peaks": "peaks only",
    "displacements": "with histories of drift and slip",
    "histories": "with all six histories",
}
"""What the exact run gives back: name in the timings, and in words."""
SAMPLES: Final = 6000
"""Motions of fewer samples are taken at half their step too."""
EVENTS: Final = 480
"""Most events of the runs that the target is meant for."""
TEXT = """\
One exact run is to cost less than one pass of the leapfrog, which does not locate events; its errors are given in
[error against run time](work_precision.md). Both are compiled as in a wheel, with the same target features, the widest
of this machine, and alternate in one process; {processes} processes follow each other. The leapfrog stores drift and
slip at every sample in all comparisons. The exact run stores nothing ("peaks"), the same two, or six histories. The
target assumes motions of 8000 samples and up to {events} events. A motion of fewer samples is used at its own step
and, interpolated linearly, at half of it; where a run then has more events, it is repeated with the motion scaled down
until it has not. Times are in ms, ratios those of the exact run over the leapfrog; all are medians over the processes.

{table}
The last columns are for peaks alone. "native": the leapfrog's time and the ratio where both are compiled for this
processor (`{flags}`), which shows whether the path is a disadvantage for the leapfrog. "any x86-64": the ratio on the
baseline path.
"""


def _events(bench: BenchmarkScene) -> int:
    return len(sm.simulate(bench.scene, bench.motion, events=True).events)


def milder(bench: BenchmarkScene) -> BenchmarkScene:
    """Return the scene under as many per cent of its motion, below 100, as leave at most the target's events."""
    parts = (
        replace(bench, motion=bench.motion.scaled(0.01 * part), motion_name=f"{bench.motion_name}, {part} % of it")
        for part in range(99, 0, -1)
    )
    return next(part for part in parts if _events(part) <= EVENTS)


def scenes() -> list[tuple[BenchmarkScene, bool]]:
    """Return those of section 4, and what makes of them what the target is meant for: True for these."""
    own = section4_scenes()
    halved = [at_half_step(bench) for bench in own if bench.motion.samples < SAMPLES]
    long = [*(bench for bench in own if bench.motion.samples >= SAMPLES), *halved]
    fewer = [milder(bench) for bench in long if _events(bench) > EVENTS]
    return [(bench, False) for bench in own] + [(bench, True) for bench in (*halved, *fewer)]


def section(*, quick: bool) -> Section:
    """Measure both on the building of section 4."""
    seconds = 0.3 if quick else 3.0
    targets, rows = [], []
    for bench, halved in scenes():
        found = timings("runs", bench, seconds)
        native = timings("runs", bench, seconds, native=True)
        portable = timings("runs", bench, seconds, baseline=True)
        ratios = {name: repeated(found[name] / found["leapfrog"]) for name in OUTPUTS}
        for name, words in OUTPUTS.items():
            what = f"exact run / leapfrog pass: {bench.title}, {bench.motion_name}, {words}"
            ratio = ratios[name]
            targets.append(Target(what, ratio.median, 1.0, scatter=ratio.quartiles, later=halved))
        rows.append(
            [
                f"{bench.title}, {bench.motion_name}".replace("_", r"\_"),
                f"{found['samples'][0]:.0f}",
                f"{found['events'][0]:.0f}",
                *(f"{1e3 * np.median(found[name]):.3f}" for name in (*OUTPUTS, "leapfrog")),
                *(f"{ratio.median:.2f}" for ratio in ratios.values()),
                f"{1e3 * np.median(native['leapfrog']):.3f}",
                *(f"{np.median(other['peaks'] / other['leapfrog']):.2f}" for other in (native, portable)),
            ]
        )
    times = ("peaks", "drift, slip", "six", "leapfrog")
    shares = ("ratio, peaks", "ratio, drift, slip", "ratio, six")
    others = ("leapfrog, native", "ratio, native", "ratio, any x86-64")
    shown = table(("scene", "samples", "events", *times, *shares, *others), rows)
    text = TEXT.format(table=shown, flags=FLAGS, processes=PROCESSES, events=EVENTS)
    return Section("One exact run and one pass of the leapfrog", targets, text)
