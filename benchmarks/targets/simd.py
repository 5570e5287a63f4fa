"""The same wheel on each of its instruction paths: time, and by how much results differ."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Final

import numpy as np

from targets.base import Section, median_time, table
from targets.batches import study_batch

PATHS: Final = ("baseline", "avx2", "avx512")
RESULTS: Final = ("peak_drift", "peak_slip", "peak_floor_acceleration", "peak_storey_shear", "residual_drift")
TEXT: Final = """\
The study's batch on one thread in processes that differ in `SEISMASS_INSTRUCTIONS` alone; one wheel, paths chosen at
run time. A path that the processor lacks falls back to the baseline. Vectors have four numbers. Paths differ in the
order of additions and in fused multiply-add, that is by rounding, unless rounding decides a branch. Differences are
those of peaks and residual drifts in runs with the same number of events, relative to the value or to a millionth of
the batch's largest value, whichever is larger.

{table}
"""


def _in_child(path: str, every: int, repeats: int, folder: Path) -> dict[str, Any]:
    out = folder / f"{path}.npz"
    environment = os.environ | {
        "SEISMASS_INSTRUCTIONS": path,
        "PYTHONPATH": os.pathsep.join(sys.path),
    }
    subprocess.run(
        [sys.executable, "-m", "targets.simd", str(every), str(repeats), str(out)], env=environment, check=True
    )
    with np.load(out) as found:
        return dict(found)


def difference(one: dict[str, Any], other: dict[str, Any]) -> tuple[float, int]:
    """Return the largest relative difference over runs with as many events, and how many have more or fewer."""
    same = one["events"] == other["events"]
    largest = 0.0
    for name in RESULTS:
        owner = np.repeat(same, one["blocks" if "slip" in name else "storeys"])
        a, b = one[name][owner], other[name][owner]
        # A residual or slip that is nothing beside the batch's has no digits of its own.
        scale = np.maximum(np.abs(a), 1e-6 * np.abs(a).max(initial=0.0))
        largest = max(largest, float((np.abs(a - b) / np.where(scale > 0.0, scale, 1.0)).max(initial=0.0)))
    return largest, int((~same).sum())


def section(*, quick: bool) -> Section:
    """Measure each path."""
    with tempfile.TemporaryDirectory() as folder:
        found = {path: _in_child(path, *((10, 1) if quick else (1, 7)), Path(folder)) for path in PATHS}
    rows = []
    for path, result in found.items():
        largest, others = difference(found["baseline"], result)
        ratio = float(found["baseline"]["time"] / result["time"])
        rows.append([path, f"{float(result['time']):.3f}", f"{ratio:.2f}", f"{largest:.0e}", str(others)])
    header = ("path", "time (s)", "baseline / path", "largest relative difference", "runs with other events")
    return Section("Wide vectors", [], TEXT.format(table=table(header, rows)))


def _child(every: int, repeats: int, out: Path) -> None:
    work = study_batch(every).on(1)
    batch = work()
    spent = median_time(work, 0.0, least=repeats)
    names = (*RESULTS, "events", "storeys", "blocks")
    found: dict[str, Any] = {name: np.asarray(getattr(batch, name)) for name in names}
    np.savez(out, time=spent, **found)


if __name__ == "__main__":
    _child(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))
