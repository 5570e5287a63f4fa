"""Wall time of the effective fraction: one call with 42 records and 101 shares, and the map of the built-in suite; and
how often its intervals hold what another suite gives.

    benchmarks/effective_mass.py [--map] [--coverage [--splits 4] [--write]]

With recordings in SEISMASS_SHARED the records are the FEMA far-field components and six more, otherwise the built-in
suite six times over at different intensities. `--map` times the map too. Times are medians on all cores.

`--coverage` takes all horizontal recordings of SEISMASS_SHARED, splits their earthquakes at random into two halves and
solves `CASES` under both, each half scaled for the period of the building with its goods, or for 1 s. It counts how
often the 90 % interval of one half holds the fraction, and the slip at 84 % of the motions, of the other half; then the
same from the forty built-in motions to all recordings. No constant of the package was chosen on these cases or splits.
`--write` puts the table into docs/effective_mass.md.
"""

from __future__ import annotations

import argparse
import math
import os
import statistics
import time
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import seismass as sm
from environment import page_module
from seismass.assessment.models import scaled_to_site
from seismass.base.statistics import bootstrap_counts, quantile_interval
from seismass.media.text_table import text_table
from seismass.runs.batch import solve_many
from seismass.runs.peaks import named_motions

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


FRAMES = ((1, 0.2), (1, 0.5), (2, 0.3), (2, 0.6), (3, 0.45), (4, 0.8))
"""Storeys and first period without goods (s)."""
STRENGTHS = ((1.5, 0.1), (3.0, 0.2), (3.0, 0.4), (6.0, 0.15))
"""R and friction."""
CASES = tuple(product(FRAMES, STRENGTHS))
"""Buildings of which the coverage is taken; all but single storeys have a bare roof."""
MIDDLE = (0.05, 0.97)
"""Fractions that are neither 0 nor 1."""


class Found(NamedTuple):
    """What a suite gives for a case: fraction, its interval over the records and over suites, slip at 84 % (m), its
    interval.
    """

    value: float
    records: tuple[float, float]
    suites: tuple[float, float]
    slip: float
    slips: tuple[float, float]


def building_of(case: tuple[tuple[int, float], tuple[float, float]]) -> Any:
    """Return the building of a case, as a building file states it."""
    (storeys, period), (reduction, mu) = case
    floors: list[dict[str, Any]] = [{} for _ in range(storeys)]
    if storeys > 1:
        floors[-1] = {"live_load_kpa": 0.0}
    return sm.read_building(
        {
            "site": {"sds_g": 1.0, "sd1_g": 0.6},
            "building": {
                "period_s": period,
                "height_m": 4.0,
                "area_m2": 500.0,
                "dead_load_kpa": 6.0,
                "design": True,
                "R": reduction,
            },
            "goods": {"live_load_kpa": 7.2, "occupied": 0.8, "mu": mu},
            "storeys": floors,
        }
    )


def found_of(case: Any, suite: Any, period: float | None) -> Found | None:
    """Return what a suite gives; None where the building collapses under too many motions."""
    building = building_of(case)
    factors = scaled_to_site(building, suite, None, period).factors
    motions = [record.scaled(float(factor)) for record, factor in zip(suite, factors, strict=True)]
    scene = building.scene()
    answer = sm.effective_mass(scene, motions, fractions=np.linspace(0.0, 1.0, 41), resamples=500)
    if answer.interval is None or answer.suite_interval is None or math.isnan(answer.value):
        return None
    slips = np.array([max(slip) for slip in solve_many([scene], motions)["peak_slip"].to_list()])
    counts = bootstrap_counts(named_motions(motions, "coverage", scene).cluster_of, 500, 0)
    low, high = quantile_interval(slips, 0.84, counts, 0.9)
    return Found(answer.value, answer.interval, answer.suite_interval, float(np.quantile(slips, 0.84)), (low, high))


def halves(splits: int) -> Iterator[tuple[list[Any], list[Any]]]:
    """Yield halves of the recordings, those of one earthquake together."""
    folder = Path(os.environ["SEISMASS_SHARED"]) / "records"
    files = [file for file in sorted(folder.rglob("*.AT2")) if "reference" not in file.parts]
    up = ("VER", "UP", "-V.", "-UP")
    records = [sm.read_record(file) for file in files if not any(word in file.name.upper() for word in up)]
    events = sorted({record.event for record in records})
    for seed in range(splits):
        first = set(np.random.default_rng(seed).permutation(events)[: len(events) // 2])
        yield [one for one in records if one.event in first], [one for one in records if one.event not in first]


def row_of(name: str, pairs: list[tuple[Found, Found]]) -> list[str]:
    """Return how often the intervals of the first of each pair hold what the second gives."""

    def share(held: list[bool]) -> str:
        return f"{100.0 * float(np.mean(held)):.0f} % of {len(held)}" if held else "-"

    def holds(ends: tuple[float, float], value: float) -> bool:
        return ends[0] - 1e-9 <= value <= ends[1] + 1e-9

    middle = [(one, other) for one, other in pairs if MIDDLE[0] < other.value < MIDDLE[1]]
    sliding = [(one, other) for one, other in pairs if max(one.slip, other.slip) > 1e-3]
    return [
        name,
        share([holds(one.records, other.value) for one, other in pairs]),
        share([holds(one.suites, other.value) for one, other in pairs]),
        share([holds(one.suites, other.value) for one, other in middle]),
        share([holds(one.slips, other.slip) for one, other in sliding]),
    ]


def coverage(splits: int) -> list[str]:
    """Return the table of coverage, by use."""
    parts = list(halves(splits))
    every = [*parts[0][0], *parts[0][1]]
    forty = list(sm.builtin_suite("forty"))
    rows = [["motions scaled for", "fraction: records", "0.05 wider", "0.05 to 0.97, 0.05 wider", "slip at 84 %"]]
    for use, period in (("the building's period", None), ("1 s", 1.0)):
        pairs = []
        for case, (first, second) in product(CASES, parts):
            one, other = found_of(case, first, period), found_of(case, second, period)
            if one is not None and other is not None:
                pairs += [(one, other), (other, one)]
        rows.append(row_of(f"{use}, half to half", pairs))
        print(text_table(rows)[-1], flush=True)
        both = [(found_of(case, forty, period), found_of(case, every, period)) for case in CASES]
        known = [(one, other) for one, other in both if one is not None and other is not None]
        rows.append(row_of(f"{use}, forty to recordings", known))
        print(text_table(rows)[-1], flush=True)
    count = f"{len(every)} recordings of {len({record.event for record in every})} earthquakes"
    return [f"{count}, {splits} splits, {len(CASES)} buildings", *text_table(rows, indent=0)]


def main() -> None:
    """Print the medians, or the coverage."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--map", action="store_true")
    parser.add_argument("--coverage", action="store_true")
    parser.add_argument("--splits", type=int, default=4)
    parser.add_argument("--write", action="store_true", help="write docs/effective_mass.md")
    options = parser.parse_args()
    if options.coverage:
        lines = coverage(options.splits)
        print("\n".join(lines))
        if options.write:
            page = page_module("parts").Page(Path(__file__).parents[1] / "docs" / "effective_mass.md")
            page.block("coverage", lines)
            page.write()
        return
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
