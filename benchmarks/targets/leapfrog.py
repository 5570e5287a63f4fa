"""One exact run beside one pass of the half-explicit leapfrog at the record's own step."""

from __future__ import annotations

from targets.base import Section, Target, section4_scenes, table
from targets.program import FLAGS, timings

OUTPUTS = {
    "peaks": "peaks only",
    "displacements": "with histories of drift and slip",
    "histories": "with all six histories",
}
"""What the exact run gives back: name in the timings, and in words."""
TEXT = """\
One exact run must cost less than one pass of the leapfrog, which knows no event and has errors near 1e-2. Both are
compiled for this processor (`{flags}`) and take turns in one process; the exact kernel uses its widest path. The
leapfrog stores drift and slip at every sample whatever is compared; the exact run nothing ("peaks"), the same two, or
six histories. Times in ms, ratios of the exact run over the leapfrog.

{table}
In the last column the kernel takes its path for instructions that every x86-64 has, the leapfrog is as before.
"""


def section(*, quick: bool) -> Section:
    """Measure both on the building of section 4."""
    seconds = 0.3 if quick else 3.0
    targets, rows = [], []
    for bench in section4_scenes():
        found = timings("runs", bench, seconds)
        baseline = timings("runs", bench, seconds, "baseline")
        ratios = {name: found[name] / found["leapfrog"] for name in OUTPUTS}
        for name, words in OUTPUTS.items():
            what = f"exact run / leapfrog pass: {bench.title}, {bench.motion_name}, {words}"
            targets.append(Target(what, ratios[name], 1.0))
        rows.append(
            [
                f"{bench.title}, {bench.motion_name}".replace("_", r"\_"),
                f"{found['samples']:.0f}",
                f"{found['events']:.0f}",
                *(f"{1e3 * found[name]:.3f}" for name in (*OUTPUTS, "leapfrog")),
                *(f"{ratio:.2f}" for ratio in ratios.values()),
                f"{baseline['peaks'] / baseline['leapfrog']:.2f}",
            ]
        )
    times = ("peaks", "drift, slip", "six", "leapfrog")
    shares = ("ratio, peaks", "ratio, drift, slip", "ratio, six", "ratio, peaks, baseline")
    shown = table(("scene", "samples", "events", *times, *shares), rows)
    return Section("One exact run and one pass of the leapfrog", targets, TEXT.format(table=shown, flags=FLAGS))
