"""The page docs/work_precision.md: tables and every sentence with a number in it are computed from the points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import polars as pl

import seismass as sm
from front import LEVELS, envelope, points, time_at
from judge import Reference
from measure import ERRORS
from scenes import BenchmarkScene

OURS: Final = "seismass, exact"
PEAKS_ONLY: Final = "seismass, peaks only"
"""Does less than the others, who fill histories: shown, and compared with nobody."""
RATIO_LEVEL: Final = 1e-6
RIVALS: Final = (
    ("the leapfrog", ("leapfrog, Rust", "leapfrog, numba"), 20.0),
    (
        "OpenSees",
        ("OpenSees, friction spring", "OpenSees, CoulombDamper", "OpenSees, central difference"),
        500.0,
    ),
)
"""Rival, its families, the ratio of times that the exact kernel aims at."""
SAME_SPRINGS: Final = (("Newmark, friction spring", "100 k, dt / 5"), ("OpenSees, friction spring", "1e2 k, dt / 5"))
"""Family and setting of the same model and method, compiled and in OpenSees."""
MEASURES: Final = dict(zip(ERRORS, ("drift history", "peak drift", "slip history", "residual slip"), strict=True))

HEAD: Final = """# Error against run time

Every program solves the same scenes, from the scene to arrays of drifts and slips at every sample of the motion, in one
process and one thread. Runs of seismass for peaks only are shown but not compared. Times are processor times, medians
after a warm-up; runs longer than two seconds are not repeated. Errors are the largest absolute differences from the
second implementation of the model in double-double precision (crate `seismass-judge`, which shares the kernel's damping
matrix but not its solver), divided by the largest drift, or slip, of the scene. {recordings}

Written by `benchmarks/work_precision.py` (`make bench`); all points are in `benchmarks/results/work_precision.parquet`.

Measured on: {machine}.

![Time against error on the section-4 building](figures/work_precision.png)
"""

NOTES: Final = """## The programs

- **seismass, exact**: the kernel with histories of drifts and slips. **seismass, peaks only**: as used by the study; it
  computes no histories and is not compared.
- **leapfrog**: a half-explicit method with clipped friction impulses and return mapping, as an engineer would program
  it, in the kernel's `reference` module and in numba. Where a block reverses inside a step, its impulse is divided;
  without this the method is of order 1 where blocks slide much.
- **Gauss-Legendre 4, Newmark**: the state machines of the exact solution, advanced in fixed steps; *located*: events
  are found inside the step. Without location both are of order 1 on stick-slip scenes, whatever their order between
  events.
- **Newmark, friction spring**: the model of OpenSees' friction springs, compiled. A spring deforms elastically before
  it slides.
{same_springs}
- **OpenSees**: elastic-perfectly-plastic springs in parallel, dashpots between every pair of floors that reproduce the
  damping matrix; friction as stiff springs (1e2 to 4e5 times the stiffness k of the first storey) or as CoulombDamper.
  *retries*: other algorithms, then shorter steps, where a step does not converge; no unconverged step is accepted.
  *central difference* takes steps below its limit of stability, 2 / w for the highest frequency w, which stiff springs
  raise; its matrix is factored once. `modalDamping` damps the modes of the building coupled to its blocks, which is a
  different problem, as its row shows.
- **SciPy, events**: DOP853 on a state machine, restarted at events, or at events and samples; peaks by cubic
  interpolation between samples, which bounds their error near 1e-7. **SciPy, tanh friction**: friction smoothed over a
  relative velocity, which causes the error. These and OpenSees' finest implicit steps run on the first scene
  only.
- **heyoka**: Taylor integration with event detection on the same state machine, compiled for the guards that a scene
  has; peaks from its own dense output. Its steps end at the samples, where the slope of the ground motion changes. Such
  steps are so short that the error is far below the tolerance, and a larger tolerance saves little.
- **diffsol**: a Rust library, through its package pydiffsol: Tsit45 with stop conditions on the same state machine,
  restarted at the samples too; peaks of the cubics over its steps. Its other methods are implicit, of lower order, and
  not run.

Compilation: the kernel selects its widest path at run time, here {path}. The leapfrog in Rust, Gauss-Legendre and
Newmark come from the same wheel, for the x86-64 baseline. numba and heyoka compile for the processor of this machine.
OpenSees and pydiffsol are the wheels of their projects.

Peaks: the kernel finds them between samples. The leapfrogs, Gauss-Legendre, Newmark and OpenSees take them at the ends
of steps and at located events only, so errors of their peaks may be larger than those of their histories.
"""


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(row)} |" for row in lines) + "\n"


def _ms(time: float) -> str:
    return f"{1e3 * time:.3g}" if time < 1.0 else f"{1e3 * time:.0f}"


def _families(table: pl.DataFrame) -> list[str]:
    return table.filter(pl.col("family") != PEAKS_ONLY)["family"].unique(maintain_order=True).to_list()


def fastest(table: pl.DataFrame, scene: str, measure: str, level: float) -> list[tuple[float, str]]:
    """Return time and family of all that reach an error level on a scene, fastest first."""
    times = ((time_at(points(table, scene, measure, [family]), level), family) for family in _families(table))
    return sorted((time, family) for time, family in times if time is not None)


def _levels(table: pl.DataFrame, benches: list[BenchmarkScene]) -> str:
    """Fastest contestant by error of the drift history, and what the exact kernel takes."""
    rows = []
    for bench in benches:
        for level in LEVELS:
            found = fastest(table, bench.name, "drift_error", level)
            ours = next((time for time, family in found if family == OURS), None)
            others = [(time, family) for time, family in found if family != OURS]
            rival = others[0] if others else None
            rows.append(
                [
                    bench.name,
                    f"{level:.0e}",
                    found[0][1] if found else "none",
                    "-" if ours is None else _ms(ours),
                    "none gets there" if rival is None else f"{rival[1]}, {_ms(rival[0])}",
                    "-" if rival is None or ours is None else f"{rival[0] / ours:.2g}",
                ]
            )
    head = ("scene", "error", "fastest", "seismass (ms)", "best of the others (ms)", "their time / ours")
    return _table(head, rows)


def _losses(table: pl.DataFrame, benches: list[BenchmarkScene]) -> str:
    """Where the exact kernel is not the fastest, over all measures of error."""
    total, lost, lines = 0, 0, []
    for bench in benches:
        ranges, rivals, worst = [], [], 0.0
        for measure, name in MEASURES.items():
            compared = [(level, fastest(table, bench.name, measure, level)) for level in LEVELS]
            compared = [(level, found) for level, found in compared if found]
            behind = [(level, found) for level, found in compared if found[0][1] != OURS]
            total, lost = total + len(compared), lost + len(behind)
            for _, found in behind:
                rivals.append(found[0][1].removesuffix(", Rust").removesuffix(", numba"))
                ours = next((time for time, family in found if family == OURS), float("inf"))
                worst = max(worst, ours / found[0][0])
            if behind:
                ranges.append(f"{name} {behind[0][0]:.0e} to {behind[-1][0]:.0e}")
        if ranges:
            names = ", ".join(dict.fromkeys(rivals))
            lines.append(f"- {bench.name}, by {names}, by up to a factor of {worst:.2g}: {'; '.join(ranges)}")
    text = (
        f"Of {total} comparisons (scene, kind of error, error level from {LEVELS[0]:.0e} to {LEVELS[-1]:.0e}) the\n"
        f"exact kernel is the fastest in {total - lost}"
    )
    if not lost:
        return text + ": all of them.\n"
    reason = (
        "The leapfrog takes one inexpensive step per sample and does not locate events. This is sufficient where low\n"
        "accuracy is acceptable, but the method gives no estimate of its error. The cost of the exact kernel does not\n"
        "depend on the error level."
    )
    return f"{text}. It is beaten in the other {lost}:\n\n" + "\n".join(lines) + f"\n\n{reason}\n"


def _ratios(table: pl.DataFrame, benches: list[BenchmarkScene]) -> str:
    """Time of leapfrog and OpenSees at the ratio level over that of the exact kernel with histories."""
    rows, met = [], {rival: 0 for rival, *_ in RIVALS}
    for bench in benches:
        ours = time_at(points(table, bench.name, "drift_error", [OURS]), RATIO_LEVEL)
        if ours is None:
            continue
        row = [bench.name, _ms(ours)]
        for rival, families, aim in RIVALS:
            found = envelope(points(table, bench.name, "drift_error", families))
            time = time_at(found, RATIO_LEVEL)
            if time is None and found:
                error, last = found[-1]
                row += [f"not reached: {error:.1e} in {_ms(last)}", f"> {last / ours:.3g}"]
            elif time is None:
                row += ["no point", "-"]
            else:
                row += [_ms(time), f"{time / ours:.3g}"]
            reached = time if time is not None else found[-1][1] if found else None
            met[rival] += reached is not None and reached / ours >= aim
        rows.append(row)
    head = ["scene", "seismass (ms)"]
    for rival, _, aim in RIVALS:
        head += [f"{rival} (ms)", f"ratio (aim: {aim:g})"]
    shown = "; ".join(f"{rival}: on {count} of {len(rows)} scenes" for rival, count in met.items())
    verdict = f"The aim is met, {shown}. A bound (>) comes from the most accurate setting that was run."
    return _table(head, rows) + f"\n{verdict}\n"


def same_springs(table: pl.DataFrame) -> str:
    """Say by how much errors and times of the compiled friction springs and of OpenSees' differ."""
    compiled, theirs = (
        table.filter(family=family, setting=setting, status="ok").select("scene", "time", "drift_error")
        for family, setting in SAME_SPRINGS
    )
    both = compiled.join(theirs, on="scene", suffix="_theirs")
    if both.is_empty():
        return "  No scene was solved by both with the same springs and steps."
    errors, times = ((both[f"{name}_theirs"] / both[name]).to_numpy() for name in ("drift_error", "time"))
    apart = 100.0 * float(abs(errors - 1.0).max())
    return (
        f"  With {SAME_SPRINGS[0][1]} the errors of both histories of drift differ by at most {apart:.1g} % "
        f"on {len(both)} scenes:\n  they are due to model and step. OpenSees takes {times.min():.2g} to "
        f"{times.max():.2g} times as long."
    )


def _all_points(table: pl.DataFrame, bench: BenchmarkScene) -> str:
    rows = []
    for row in table.filter(pl.col("scene") == bench.name).iter_rows(named=True):
        time = "-" if row["time"] is None else _ms(row["time"])
        if row["status"] != "ok":
            told = [f"**{row['status']}**: {row['reason']}".replace("|", "/").replace("\n", " "), "", "", ""]
        else:
            told = ["-" if row[name] is None else f"{row[name]:.0e}" for name in ERRORS]
        rows.append([row["family"], row["setting"], time, *told])
    return _table(("contestant", "setting", "ms", *MEASURES.values()), rows)


def page(table: pl.DataFrame, benches: list[BenchmarkScene], references: dict[str, Reference], machine: str) -> str:
    """Return the page."""
    recorded = not any("synthetic" in bench.motion_name for bench in benches)
    recordings = (
        "Motions are recordings." if recorded else "Motions are the synthetic ones of the package, not recordings."
    )
    counts = {bench.name: references[bench.name].events for bench in benches}
    scene_rows = [
        [
            b.name,
            b.title,
            b.motion_name.replace("_", r"\_"),
            f"{b.motion.samples} x {b.motion.dt:g} s",
            str(counts[b.name]),
        ]
        for b in benches
    ]
    parts = [
        HEAD.format(machine=machine, recordings=recordings),
        "## Where the exact kernel is the fastest, and where not\n",
        _losses(table, benches),
        f"At an error of {RATIO_LEVEL:.0e} of the drift history (lower envelope of a contestant's points, straight in "
        "log-log between them):\n",
        _ratios(table, benches),
        "By error level of the drift history:\n",
        _levels(table, benches),
        NOTES.format(same_springs=same_springs(table), path=sm.runs.instruction_set()),
        "## Scenes\n",
        _table(("name", "scene", "motion", "samples", "events"), scene_rows),
        "![Time against error on all scenes](figures/work_precision_scenes.png)\n",
        "## All points\n",
        "Errors relative as above; failures and losses included.\n",
        *(f"### {bench.title}\n\n{_all_points(table, bench)}" for bench in benches),
    ]
    return "\n".join(parts)
