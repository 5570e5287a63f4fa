"""Growth in storeys: time per sample for taller and taller buildings, and what a full cache of regimes costs."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

import seismass as sm
from scenes import FloatArray
from seismass import _kernel
from targets.base import RUNS, Section, Target, alternating, exponent, median_time, strong_motions, table

STOREYS: Final = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 100, 150, 200)
FROM: Final = 8
"""Storeys from which exponents are fitted."""
SAMPLES: Final = 2000
CALM: Final = 0.01
"""Factor of a motion under which nothing yields and nothing slides."""
SECONDS: Final = 0.5
STIFF: Final = (4, 16, 64)
"""Storeys of buildings on a stiff storey."""
CONTRASTS: Final = (1.0, 1e2, 1e3, 1e4)
"""How many times as stiff as the others it is."""
UNEVEN: Final = ((4, 1), (24, 1), (24, 4))
"""Scenes for the cache of regimes, which the last fills: storeys, and how often the record is played, ever weaker."""

TEXT: Final = """\
Uniform buildings of 1 to {most} storeys with a first period of 0.1 s per storey, strengths that fall linearly to the
roof, and a block on each floor; {samples} samples at {dt:g} s. Calm: scaled down until nothing yields or slides, which
gives the cost of a time step. Strong: {peak} g, with events, whose number also grows with the storeys. Time per sample
(us), single runs, peaks only.

{table}
Exponents of time per sample, fitted from {start} storeys: {exponents}.

![Time per sample against storeys](figures/performance_storeys.png)

The same buildings under the strong motion, on a lowest storey that is many times as stiff as the others and stays
elastic, such as a basement. The bound that proves a step free of events grows with the fourth power of its length in
radians of the stiffest mode, so sample intervals longer than 4 radians are solved in substeps. Time per sample (us),
with the number of substeps in brackets:

{stiff}
The cache of regimes is bounded in memory; a run that fills it discards all regimes and forms them again. A batch of a
run and its mirror image, which enters the same regimes, shows the cost: while the cache suffices, the mirror image
saves the time of forming them; once it overflows, it does not. Strengths, blocks and friction differ from floor to
floor, with full damping; memory is what Linux reports.

{cache}"""


def _scene(storeys: int, *, rayleigh: bool) -> sm.Scene:
    strength = 0.15 * np.linspace(1.0, 1.0 / storeys, storeys)
    modes = (1, min(3, storeys))
    damping: Any = sm.Rayleigh(0.05, modes) if rayleigh and storeys > 1 else 0.05
    building = sm.Building.uniform(storeys, 0.1 * storeys, yield_shear_over_weight=strength, damping=damping)
    return sm.Scene(building, sm.blocks_on_floors([1.0] * storeys, mu=0.2))


def _motion(samples: FloatArray, dt: float, factor: float = 1.0) -> sm.Motion:
    return sm.Motion(factor * samples, dt)


def _strongest(motion: sm.Motion) -> FloatArray:
    """The stretch of samples around the peak."""
    start = max(0, int(np.abs(motion.acceleration).argmax()) - SAMPLES // 4)
    return np.array(motion.acceleration[start : start + SAMPLES])


def growth(storeys: tuple[int, ...], seconds: float) -> dict[str, list[float]]:
    """Return time per sample (s) by damping and motion, a value per number of storeys, and the events."""
    whole = strong_motions()[0][1]
    samples = _strongest(whole)
    calm, strong = _motion(samples, whole.dt, CALM), _motion(samples, whole.dt)
    found: dict[str, list[float]] = {"storeys": [float(n) for n in storeys]}
    for damping in ("Rayleigh", "modal"):
        for name, motion in (("calm", calm), ("strong", strong)):
            times, events = [], []
            for n in storeys:
                scene = _scene(n, rayleigh=damping == "Rayleigh")
                spent = median_time(partial(sm.simulate, scene, motion, **RUNS), seconds, least=1)
                times.append(spent / motion.samples)
                events.append(float(sum(sm.simulate(scene, motion, **RUNS).counts.values())))
            found[f"{damping}, {name}"] = times
            found[f"{damping}, {name}, events"] = events
    return found


def _stiff(seconds: float, storeys: tuple[int, ...]) -> str:
    whole = strong_motions()[0][1]
    motion = _motion(_strongest(whole), whole.dt)
    rows = []
    for n in storeys:
        for damping in ("Rayleigh", "modal"):
            scene = _scene(n, rayleigh=damping == "Rayleigh")
            building = scene.building
            assert building is not None
            row = [str(n), damping]
            for contrast in CONTRASTS:
                stiffness, strength = np.array(building.stiffness), np.array(building.yield_shear)
                stiffness[0], strength[0] = contrast * stiffness[0], np.inf
                stiff = sm.Scene(building.replace(stiffness=stiffness, yield_shear=strength), scene.blocks)
                spent = median_time(partial(sm.simulate, stiff, motion, **RUNS), seconds, least=1)
                substeps = sm.simulate(stiff, motion, **RUNS).statistics["substeps"]
                row.append(f"{1e6 * spent / motion.samples:.3g} ({substeps})")
            rows.append(row)
    return table(("storeys", "damping", *(f"{contrast:g} times as stiff" for contrast in CONTRASTS)), rows)


def _cache(quick: bool) -> str:
    rows = []
    for storeys, plays in UNEVEN[: 1 if quick else None]:
        ran = subprocess.run(
            [sys.executable, "-m", "targets.storeys", str(storeys), str(plays), "0.2" if quick else "5.0"],
            env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
            check=True,
            capture_output=True,
            text=True,
        )
        regimes, hits, events, one, two, memory = (float(word) for word in ran.stdout.split())
        rows.append(
            [
                f"{storeys} storeys, record x {plays}",
                f"{events:.0f}",
                f"{regimes:.0f}",
                f"{hits:.0f}",
                f"{1e3 * one:.2f}",
                f"{1e6 * one / events:.1f}",
                f"{1e3 * (two - one):.2f}",
                f"{100.0 * (two - one) / one:.0f} %",
                f"{memory:.0f}",
            ]
        )
    header = (
        "scene",
        "events",
        "regimes formed",
        "found again",
        "run (ms)",
        "us per event",
        "mirror image after it (ms)",
    )
    return table((*header, "mirror image / run", "memory added (MB)"), rows)


def _uneven(storeys: int) -> sm.Scene:
    random = np.random.default_rng(1)
    strength = 0.15 * np.linspace(1.0, 1.0 / storeys, storeys) * random.uniform(0.6, 1.4, storeys)
    building = sm.Building.uniform(storeys, 0.1 * storeys, yield_shear_over_weight=strength)
    ratios, friction = random.uniform(0.3, 1.5, storeys), random.uniform(0.05, 0.4, storeys)
    return sm.Scene(building, sm.blocks_on_floors(ratios, mu=friction))


def _peak_memory() -> float:
    """Return the largest resident memory of this process, its parent's not counted (MB); NaN where it is not known."""
    status = Path("/proc/self/status")
    found = re.search(r"VmHWM:\s*(\d+) kB", status.read_text()) if status.exists() else None
    return int(found.group(1)) / 1024.0 if found else math.nan


def _child(storeys: int, plays: int, seconds: float) -> None:
    """Print regimes, hits and events of a run, times of it and of the batch of two (s), memory added (MB)."""
    whole, scene = strong_motions()[0][1], _uneven(storeys)
    samples = np.concatenate([0.98**play * np.array(whole.acceleration) for play in range(plays)])
    motions = [_motion(samples, whole.dt, sign) for sign in (1.0, -1.0)]

    def batch(count: int) -> _kernel.Batch:
        pairs = np.array([[0, number] for number in range(count)], dtype=np.int64)
        return _kernel.simulate_many([scene._kernel], [m._kernel for m in motions[:count]], pairs, threads=1)

    before = _peak_memory()
    batch(1)
    memory = _peak_memory() - before
    run = sm.simulate(scene, motions[0], **RUNS)
    one, two = alternating([lambda: batch(1), lambda: batch(2)], seconds, least=1)
    done = run.statistics
    print(done["regimes"], done["regime_hits"], sum(run.counts.values()), one, two, memory)


def section(*, quick: bool) -> Section:
    """Measure growth, and the cache."""
    storeys = (1, 4, 8, 12, 16) if quick else STOREYS
    found = growth(storeys, 0.0 if quick else SECONDS)
    tall = [place for place, n in enumerate(storeys) if n >= FROM]
    curves = [name for name in found if name != "storeys" and not name.endswith("events")]
    fitted = {
        name: exponent([storeys[place] for place in tall], [found[name][place] for place in tall]) for name in curves
    }
    targets = [
        Target(
            f"exponent of time per sample from {FROM} storeys, Rayleigh damping, without events",
            fitted["Rayleigh, calm"],
            1.15,
        )
    ]
    rows = [
        [
            str(n),
            *(f"{1e6 * found[name][place]:.3g}" for name in curves),
            *(f"{found[f'{damping}, strong, events'][place]:.0f}" for damping in ("Rayleigh", "modal")),
        ]
        for place, n in enumerate(storeys)
    ]
    motion = strong_motions()[0][1]
    text = TEXT.format(
        most=storeys[-1],
        samples=SAMPLES,
        dt=motion.dt,
        peak=f"{motion.pga_g:.1f}",
        table=table(("storeys", *curves, "events, Rayleigh", "events, modal"), rows),
        start=FROM,
        exponents="; ".join(f"{name} {value:.2f}" for name, value in fitted.items()),
        stiff=_stiff(0.0 if quick else SECONDS, STIFF[:1] if quick else STIFF),
        cache=_cache(quick),
    )
    return Section("Growth in storeys", targets, text, {"storeys": found, "exponents": fitted})


if __name__ == "__main__":
    _child(int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]))
