"""The program that times the kernel in Rust, crates/seismass-judge/src/bin/timings.rs."""

from __future__ import annotations

import os
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import Final

import numpy as np

from judge import ROOT, scene_text
from scenes import BenchmarkScene, FloatArray

FLAGS: Final = "-C target-cpu=native"
"""With these, all of the program may use what this processor has; without, what has paths to choose from alone."""
BASELINE: Final = "baseline"
"""The path for processors that have no more than every x86-64 has."""
PROCESSES: Final = 5
"""Processes that share the time: quartiles are taken over them."""


@cache
def _built(*, native: bool) -> Path:
    """Compile it, as a wheel is or for this processor, and return where it is."""
    folder = ROOT / "target" / ("native" if native else "portable")
    command = ("build", "--release", "--locked", "--quiet", "-p", "seismass-judge", "--bin", "timings")
    environment = os.environ | {"RUSTFLAGS": FLAGS if native else "", "CARGO_TARGET_DIR": str(folder)}
    subprocess.run([os.environ.get("CARGO", "cargo"), *command], cwd=ROOT, env=environment, check=True)
    return folder / "release" / "timings"


def timings(
    work: str, bench: BenchmarkScene, seconds: float, *, native: bool = False, baseline: bool = False
) -> dict[str, FloatArray]:
    """Return what the program measures of a scene, in so many seconds: by name, a value of each of its processes.

    `native`: compiled for this processor, and not as a wheel is. `baseline`: on the path that every x86-64 has.
    """
    found = [_timings(work, bench, seconds / PROCESSES, native, baseline) for _ in range(PROCESSES)]
    return {name: np.array([one[name] for one in found]) for name in found[0]}


def _timings(work: str, bench: BenchmarkScene, seconds: float, native: bool, baseline: bool) -> dict[str, float]:
    environment = os.environ | ({"SEISMASS_INSTRUCTIONS": BASELINE} if baseline else {})
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene"
        file.write_text(scene_text(bench))
        command = [str(_built(native=native)), work, str(file), repr(seconds)]
        ran = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    found = dict(line.split() for line in ran.stdout.splitlines())
    used = found.pop("instructions")
    if baseline and used != BASELINE:
        raise RuntimeError(f"instructions of the timings must be {BASELINE}; got {used}")
    return {name: float(value) for name, value in found.items()}
