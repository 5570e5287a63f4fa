"""Growth in the size of a batch: what benchmarks/million.py measures, a million runs beside a thousand."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import Any, Final

import million
from targets.base import Section, table

QUICK: Final = (64, 512)
"""Sizes of the quick mode."""
TEXT: Final = """\
Runs of a building of two storeys described by columns (`sm.Grid`), peaks only, streamed in frames of bounded size that
are read and discarded; each size in its own process, {threads} threads, path {instructions}. Motion: {motion}
({samples} samples at {dt:g} s). A size that takes less than {least:g} s is repeated after a warm-up, and its times are
medians; a larger one runs once, without warm-up. Memory is the peak resident memory, with Python and its packages.

{table}
The large batch over the small one: throughput {throughput:.3f}, processor time per run {processor:.3f}, memory
{memory:.2f}.
"""


def _measured(sizes: tuple[int, ...]) -> dict[str, Any]:
    """Measure from a process that holds little: a child's peak of memory is no smaller than its parent's was."""
    code = f"import json, million; print(json.dumps(million.measure({sizes!r})))"
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    ran = subprocess.run([sys.executable, "-c", code], env=environment, check=True, stdout=subprocess.PIPE, text=True)
    found: dict[str, Any] = json.loads(ran.stdout)
    return found


def section(*, quick: bool) -> Section:
    """Measure both sizes."""
    found = _measured(QUICK if quick else million.SIZES)
    rows = [
        [
            f"{batch['runs']:,}",
            f"{batch['events'] / batch['runs']:.1f}",
            str(batch["failed"]),
            f"{batch['wall_s']:.3f}",
            f"{batch['runs_per_s']:,.0f}",
            f"{1e6 * batch['processor_s'] / batch['runs']:.1f}",
            f"{batch['peak_mib']:.0f}",
        ]
        for batch in found["batches"]
    ]
    small, large = found["batches"]
    text = TEXT.format(
        **{name: found[name] for name in ("threads", "instructions", "motion", "samples", "dt")},
        least=million.LEAST_TIME,
        table=table(
            ("runs", "events per run", "failed", "wall (s)", "runs/s", "processor us per run", "memory (MiB)"), rows
        ),
        throughput=large["runs_per_s"] / small["runs_per_s"],
        processor=large["processor_s"] / large["runs"] / (small["processor_s"] / small["runs"]),
        memory=large["peak_mib"] / small["peak_mib"],
    )
    return Section("Growth in the batch", [], text)
