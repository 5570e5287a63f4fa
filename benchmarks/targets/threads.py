"""Two threads beside one, and beside what two copies of pure arithmetic reach on the same cores."""

from __future__ import annotations

from targets.base import Section, Target, alternating, four_storeys, strong_motions, table
from targets.batches import random_batch, study_batch
from targets.program import timings

TEXT = """\
The same batch on one thread and on two, taking turns; the kernel alone, no table made. A machine that is shared, or
lowers its clock when both cores work, gives less than two to anybody: a loop of pure arithmetic in registers and its
two copies on two threads show what these two cores give.

{table}"""


def section(*, quick: bool) -> Section:
    """Measure the study's batch, a random one and the arithmetic."""
    name, motion = strong_motions()[0]
    arithmetic = timings("threads", four_storeys(motion, name), 1.0 if quick else 5.0)
    limit = 2.0 * arithmetic["one"] / arithmetic["two"]
    targets, rows = [], []
    batches = {
        "the study's batch": study_batch(10 if quick else 1),
        "a random batch": random_batch(100 if quick else 2000),
    }
    for what, batch in batches.items():
        one, two = alternating([batch.on(1), batch.on(2)], 0.0, least=1 if quick else 7)
        targets.append(Target(f"1 thread / 2 threads, {what}", one / two, 1.95, at_most=False))
        share = f"{100.0 * one / two / limit:.0f} %"
        rows.append([what, str(len(batch.pairs)), f"{one:.3f}", f"{two:.3f}", f"{one / two:.3f}", share])
    one, two = arithmetic["one"], arithmetic["two"]
    rows.append(["arithmetic, twice as much on 2", "", f"{one:.3f}", f"{two:.3f}", f"{limit:.3f}", "100 %"])
    header = ("", "runs", "1 thread (s)", "2 threads (s)", "speed-up", "of what two cores give")
    return Section("Threads", targets, TEXT.format(table=table(header, rows)))
