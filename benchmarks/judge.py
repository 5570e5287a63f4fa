"""The reference of all errors: the second, plain implementation of the model, run in double-double precision."""

from __future__ import annotations

import hashlib
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from contestants.base import FloatArray, Outcome
from scenes import DAMPING, BenchmarkScene

ROOT: Final = Path(__file__).resolve().parent.parent
FOLDER: Final = ROOT / "out" / "bench" / "reference"
COMMAND: Final = ("run", "--release", "--locked", "--quiet", "-p", "seismass-judge", "--bin", "judge_reference", "--")


@dataclass(frozen=True)
class Reference:
    """The solution of a scene, rounded to doubles, and its number of events."""

    outcome: Outcome
    drift: FloatArray
    slip: FloatArray
    events: int


def scene_text(bench: BenchmarkScene) -> str:
    """Return a scene and its motion as the programs of the crate seismass-judge read them."""
    building = bench.building
    springs = ("mass", "stiffness", "yield_shear", "overstrength", "second_slope", "third_slope")
    lines = [(name, [float(value) for value in getattr(building, name)]) for name in springs]
    lines.append(("damping", [DAMPING]))
    for block in bench.scene.blocks:
        if block.mass_ratio is None or block.mu_s != block.mu_k:
            raise ValueError(f"blocks of {bench.name} must be given by mass ratio, with one mu")
        lines.append(("block", [float(block.floor), block.mass_ratio * building.mass[block.floor - 1], block.mu_s]))
    lines.append(("dt", [bench.motion.dt]))
    lines.append(("acceleration", [float(value) for value in bench.motion.acceleration]))
    return "".join(f"{name} {' '.join(repr(float(value)) for value in values)}\n" for name, values in lines)


def reference(bench: BenchmarkScene) -> Reference:
    """Return the reference solution, kept under out/ by the digest of its input and of the sources of the judge."""
    text = scene_text(bench)
    sources = sorted((ROOT / "crates").glob("seismass*/src/**/*.rs"))
    digest = hashlib.sha256(text.encode() + b"".join(path.read_bytes() for path in sources)).hexdigest()[:20]
    FOLDER.mkdir(parents=True, exist_ok=True)
    given, found = FOLDER / f"{digest}.in", FOLDER / f"{digest}.out"
    if not found.exists():
        given.write_text(text)
        unfinished = found.with_suffix(".part")
        subprocess.run([os.environ.get("CARGO", "cargo"), *COMMAND, given, unfinished], cwd=ROOT, check=True)
        unfinished.rename(found)
    values = {
        name: np.array(words, dtype=np.float64)
        for name, *words in (line.split() for line in found.read_text().splitlines())
    }
    samples = bench.motion.samples
    drift, slip = values["drift"].reshape(samples, -1), values["slip"].reshape(samples, -1)
    return Reference(
        outcome=Outcome(drift, slip, values["peak_drift"], values["peak_slip"], values["residual_slip"]),
        drift=drift,
        slip=slip,
        events=int(values["events"][0]),
    )
