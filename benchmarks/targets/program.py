"""The program that times the kernel in Rust, crates/seismass-judge/src/bin/timings.rs: built for this processor."""

from __future__ import annotations

import os
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import Final

from judge import ROOT, scene_text
from scenes import BenchmarkScene

FLAGS: Final = "-C target-cpu=native"
"""With these, everything in the program may use the same instructions: the leapfrog has no paths to choose from."""


@cache
def _built() -> Path:
    """Compile it, and return where it is."""
    folder = ROOT / "target" / "native"
    command = ("build", "--release", "--locked", "--quiet", "-p", "seismass-judge", "--bin", "timings")
    environment = os.environ | {"RUSTFLAGS": FLAGS, "CARGO_TARGET_DIR": str(folder)}
    subprocess.run([os.environ.get("CARGO", "cargo"), *command], cwd=ROOT, env=environment, check=True)
    return folder / "release" / "timings"


def timings(work: str, bench: BenchmarkScene, seconds: float, instructions: str = "") -> dict[str, float]:
    """Return what the program measures of a scene, taking so many seconds; `instructions` chooses the kernel's path."""
    environment = os.environ | ({"SEISMASS_INSTRUCTIONS": instructions} if instructions else {})
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene"
        file.write_text(scene_text(bench))
        command = [str(_built()), work, str(file), repr(seconds)]
        ran = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    found = dict(line.split() for line in ran.stdout.splitlines())
    used = found.pop("instructions")
    if instructions and used != instructions:
        raise RuntimeError(f"instructions of the timings must be {instructions}; got {used}")
    return {name: float(value) for name, value in found.items()}
