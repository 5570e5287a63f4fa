"""Wall time of the effective fraction: one call with 42 records and 101 shares, and the map of the built-in suite.

With recordings in SEISMASS_SHARED the records are the FEMA far-field components and six more, otherwise the built-in
suite six times over at different intensities. `--map` times the map too. Times are medians on all cores.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from pathlib import Path

import numpy as np

import seismass as sm
from environment import page_module

TARGET = 0.6
"""Seconds that one call may take on two cores."""
MAP_TARGET = 60.0
"""Seconds that the map of the built-in suite may take on two cores."""


def records() -> tuple[str, list[sm.Record]]:
    """Return 42 scaled records and what they are."""
    shared = os.environ.get("SEISMASS_SHARED")
    if shared:
        suite = page_module("effective_mass").far_field_components(Path(shared) / "records")
        factors = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7(), between=False).factors
    else:
        seven = list(sm.builtin_suite("seven"))
        suite = sm.Suite("built-in suite at six intensities", tuple(seven * 6))
        once = sm.scaling.scale_asce7_10(seven, sm.TargetSpectrum.asce7(), between=False).factors
        factors = np.concatenate([once * intensity for intensity in np.linspace(0.8, 1.2, 6)])
    return suite.name, [record.scaled(float(factor)) for record, factor in zip(suite, factors, strict=True)]


def main() -> None:
    """Print the medians."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--map", action="store_true")
    options = parser.parse_args()
    name, motions = records()
    building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13])
    scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
    answer = sm.effective_mass(scene, motions)
    times = []
    for _ in range(options.repeats):
        before = time.perf_counter()
        sm.effective_mass(scene, motions)
        times.append(time.perf_counter() - before)
    print(
        f"{len(motions)} records ({name}), {os.cpu_count()} cores, {sm.runs.instruction_set()}: "
        f"value {answer.value:.3f}"
    )
    print(
        f"effective_mass: median {statistics.median(times):.3f} s, {min(times):.3f} to {max(times):.3f} s "
        f"(target {TARGET} s on two cores)"
    )
    if options.map:
        before = time.perf_counter()
        found = sm.effective_mass_map(sm.builtin_suite("seven"), sm.TargetSpectrum.asce7())
        spent = time.perf_counter() - before
        print(f"map: {found.table.height} cases in {spent:.1f} s (target {MAP_TARGET:g} s on two cores)")


if __name__ == "__main__":
    main()
