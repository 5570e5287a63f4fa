"""The program that times the kernel in Rust, crates/seismass-judge/src/bin/timings.rs: for this processor or any."""

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
"""With these, everything in the program may use the same instructions: the leapfrog has no paths to choose from."""
BASELINE: Final = "baseline"
"""The kernel's path for processors that have no more than every x86-64 has."""
PROCESSES: Final = 5
"""Processes that share the time: quartiles are taken over them."""


@cache
def _built(*, portable: bool) -> Path:
    """Compile it, for this processor or for every x86-64, and return where it is."""
    folder = ROOT / "target" / ("portable" if portable else "native")
    command = ("build", "--release", "--locked", "--quiet", "-p", "seismass-judge", "--bin", "timings")
    environment = os.environ | {"RUSTFLAGS": "" if portable else FLAGS, "CARGO_TARGET_DIR": str(folder)}
    subprocess.run([os.environ.get("CARGO", "cargo"), *command], cwd=ROOT, env=environment, check=True)
    return folder / "release" / "timings"


def timings(work: str, bench: BenchmarkScene, seconds: float, *, portable: bool = False) -> dict[str, FloatArray]:
    """Return what the program measures of a scene, in so many seconds: by name, a value of each of its processes.

    `portable`: compiled for every x86-64, the kernel on its path for that.
    """
    found = [_timings(work, bench, seconds / PROCESSES, portable=portable) for _ in range(PROCESSES)]
    return {name: np.array([one[name] for one in found]) for name in found[0]}


def _timings(work: str, bench: BenchmarkScene, seconds: float, *, portable: bool) -> dict[str, float]:
    environment = os.environ | ({"SEISMASS_INSTRUCTIONS": BASELINE} if portable else {})
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene"
        file.write_text(scene_text(bench))
        command = [str(_built(portable=portable)), work, str(file), repr(seconds)]
        ran = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    found = dict(line.split() for line in ran.stdout.splitlines())
    used = found.pop("instructions")
    if portable and used != BASELINE:
        raise RuntimeError(f"instructions of the timings must be {BASELINE}; got {used}")
    return {name: float(value) for name, value in found.items()}
