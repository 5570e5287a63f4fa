"""Two threads beside one, two processes of one thread each, and two copies of pure arithmetic on the same cores."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import partial
from typing import Any, Final

import numpy as np

from scenes import FloatArray
from targets.base import Repeated, Section, Target, four_storeys, repeated, strong_motions, table, turns
from targets.batches import Batch, random_batch, study_batch
from targets.program import timings

TEXT: Final = """\
The same batch on one thread and on two, alternating; the kernel alone, without tables. A shared machine, or one that
lowers its clock when both cores work, gives no program a speed-up of two. What the two cores give is measured in two
ways: by two processes that each solve the whole batch on one thread at the same time, and by a loop of arithmetic in
registers on one thread and on two. Speed-ups are medians over the repetitions, with their quartiles.

{table}"""
PROCESSES: Final = 2
SECONDS: Final = 10.0
"""How long the turns of a batch go on."""


def make_batch(what: str, size: int) -> Batch:
    """Return the study's batch, every so-manieth run of it, or so many random runs."""
    return study_batch(size) if what == "study" else random_batch(size)


def serve(what: str, size: int) -> None:
    """Solve the batch on one thread for each line of standard input, and answer with a line."""
    work = make_batch(what, size).on(1)
    for _ in sys.stdin:
        work()
        print(flush=True)


class Processes:
    """Processes that solve a batch on one thread each, at the same time."""

    def __init__(self, what: str, size: int) -> None:
        """Start them."""
        code = f"from targets.threads import serve; serve({what!r}, {size})"
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
        start = partial(
            subprocess.Popen[str],
            [sys.executable, "-c", code],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._processes = [start() for _ in range(PROCESSES)]

    def solve(self) -> None:
        """Let each of them solve the batch once."""
        for process in self._processes:
            assert process.stdin is not None
            process.stdin.write("\n")
            process.stdin.flush()
        for process in self._processes:
            assert process.stdout is not None
            if not process.stdout.readline():
                raise RuntimeError(f"the process that solves a batch ended with status {process.wait()}")

    def __enter__(self) -> Processes:
        return self

    def __exit__(self, *_: Any) -> None:
        for process in self._processes:
            process.communicate()


def section(*, quick: bool) -> Section:
    """Measure the study's batch, a random one and the arithmetic."""
    name, motion = strong_motions()[0]
    arithmetic = timings("threads", four_storeys(motion, name), 1.0 if quick else 5.0, native=True)
    limit = repeated(2.0 * arithmetic["one"] / arithmetic["two"])
    targets, rows = [], []

    def add(what: str, runs: str, one: FloatArray, two: FloatArray, speed_up: Repeated) -> None:
        low, high = speed_up.quartiles
        times = [f"{np.median(time):.3f}" for time in (one, two)]
        told = [f"{speed_up.median:.3f}", f"{low:.3f} to {high:.3f}", f"{100.0 * speed_up.median / limit.median:.0f} %"]
        rows.append([what, runs, *times, *told])

    for what, kind, size in (
        ("the study's batch", "study", 10 if quick else 1),
        ("a random batch", "random", 100 if quick else 2000),
    ):
        batch = make_batch(kind, size)
        with Processes(kind, size) as processes:
            works = [batch.on(1), batch.on(2), processes.solve]
            one, two, both = np.array(turns(works, 0.0 if quick else SECONDS, least=1 if quick else 7))
        threads, apart = repeated(one / two), repeated(2.0 * one / both)
        title = f"1 thread / 2 threads, {what}"
        targets.append(Target(title, threads.median, 1.95, at_most=False, scatter=threads.quartiles))
        add(what, str(len(batch.pairs)), one, two, threads)
        add(f"{what}, once in each of two processes", str(2 * len(batch.pairs)), one, both, apart)
    add("arithmetic, twice as much on 2", "", arithmetic["one"], arithmetic["two"], limit)
    header = ("", "runs", "1 thread (s)", "2 threads (s)", "speed-up", "quartiles", "of what arithmetic gets")
    return Section("Threads", targets, TEXT.format(table=table(header, rows)))
