"""Time and error of one setting on one scene: a point of the figure, or the reason why there is none.

Time is processor time: all contestants compute in one thread, so it is the wall time of an idle machine, and what else
runs on a shared one disturbs it less.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from contestants.base import Absent, FloatArray, Outcome, Setting
from judge import Reference
from scenes import BenchmarkScene

ERRORS: Final = ("drift_error", "peak_drift_error", "slip_error", "residual_slip_error")


@dataclass(frozen=True)
class Budget:
    """How often a setting is repeated: at least `least` times, then until `seconds` are spent, at most `most` times.

    A setting whose warm-up takes longer than `long` seconds is not repeated: the warm-up is its time.
    """

    least: int
    most: int
    seconds: float
    long: float


QUICK: Final = Budget(least=3, most=20, seconds=0.2, long=1.0)
FULL: Final = Budget(least=3, most=50, seconds=1.0, long=2.0)


def _relative(value: FloatArray | None, exact: FloatArray, scale: float) -> float | None:
    if value is None or exact.size == 0 or scale == 0.0:
        return None
    return float(np.abs(value - exact).max()) / scale


def errors(outcome: Outcome, exact: Reference) -> dict[str, float | None]:
    """Return the largest absolute errors over the scene's largest drift, or slip."""
    peaks = exact.outcome
    drift, slip = float(peaks.peak_drift.max()), float(peaks.peak_slip.max(initial=0.0))
    return {
        "drift_error": _relative(outcome.drift, exact.drift, drift),
        "peak_drift_error": _relative(outcome.peak_drift, peaks.peak_drift, drift),
        "slip_error": _relative(outcome.slip, exact.slip, slip),
        "residual_slip_error": _relative(outcome.residual_slip, peaks.residual_slip, slip),
    }


def measure(setting: Setting, bench: BenchmarkScene, exact: Reference, budget: Budget) -> dict[str, Any]:
    """Return a row of the table: status ok, failed or absent; the median time over the repeats, and the errors."""
    row: dict[str, Any] = {
        "scene": bench.name,
        "family": setting.family,
        "setting": setting.label,
        "status": "ok",
        "reason": None,
        "time": None,
        "repeats": 0,
        **dict.fromkeys(ERRORS),
    }
    began = time.process_time()
    try:
        outcome = setting.work(bench)
        first = time.process_time() - began
        times = list(_repeat(setting, bench, budget, first))
    except Absent as absent:
        return row | {"status": "absent", "reason": f"{absent} is not installed"}
    except Exception as failure:  # a contestant's failure of any kind is a row of the table
        return row | {"status": "failed", "reason": str(failure) or repr(failure), "time": time.process_time() - began}
    median = statistics.median(times) if times else first
    return row | {"time": median, "repeats": len(times)} | errors(outcome, exact)


def _repeat(setting: Setting, bench: BenchmarkScene, budget: Budget, first: float) -> Iterator[float]:
    spent, count = 0.0, 0
    while first < budget.long and count < budget.most and (count < budget.least or spent < budget.seconds):
        with _timed() as taken:
            setting.work(bench)
        spent, count = spent + taken[0], count + 1
        yield taken[0]


@contextmanager
def _timed() -> Iterator[list[float]]:
    taken: list[float] = []
    began = time.process_time()
    yield taken
    taken.append(time.process_time() - began)
