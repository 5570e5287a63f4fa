"""The study as a user runs it, and the share of the kernel."""

from __future__ import annotations

from functools import partial

from scenes import suite
from study import REPEATS, TOTAL, distinct_runs, phases, simulate_all
from targets.base import Section, Target, median_time, table

TEXT = """\
Section 5 of the paper: 1008 analyses, of which {distinct} are distinct and solved; motions: {suite}. Wall time on two
threads, from a warm import.

{table}
The runs alone take {kernel:.3f} s on one thread.
"""


def section(*, quick: bool) -> Section:
    """Measure the study by phase."""
    motions = suite()
    runs = distinct_runs(motions)
    found = phases(motions, runs, 1 if quick else 2 * REPEATS, figures=not quick)
    kernel = median_time(partial(simulate_all, runs, 1), 0.0, least=1 if quick else REPEATS)
    targets = [
        Target("study, 1008 analyses, without figures, 2 cores", found[TOTAL], 0.6, "s"),
        Target("the study's runs, 1 core", kernel, 0.5, "s"),
    ]
    shown = table(("phase", "s"), [[name, f"{spent:.3f}"] for name, spent in found.items()])
    text = TEXT.format(distinct=len(runs), suite=motions.name.replace("_", r"\_"), table=shown, kernel=kernel)
    return Section("The study", targets, text)
