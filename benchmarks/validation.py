"""The section-4 building by OpenSees, kept as Parquet in the package for `seismass validate` and its page.

Usage: SEISMASS_SHARED=... python benchmarks/validation.py
It needs both components of the Brawley record, which are not part of this project, and OpenSees.
"""

from __future__ import annotations

import os
import platform
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl

import seismass as sm
from contestants import opensees
from contestants.opensees import Recipe
from scenes import BenchmarkScene
from seismass.studies.validation.shaking_table import components, label
from seismass.studies.validation.three_storeys import COMPARED_SLOPES, KEPT, PEAK_G, samples_digest, section4_scene

SUITE: Final = Path("records/paper_seven.csv")
RECIPES: Final = (Recipe(1e4, 5, ladder=True), Recipe(1e5, 50, ladder=True))
"""Stiffness of friction springs over that of storey 1, and steps per sample interval: Newmark with KrylovNewton, and
with other algorithms and shorter steps where it does not converge."""
EVERY: Final = 4
"""Sample intervals between the instants that are kept."""


def row(record: sm.Record, second_slope: float, recipe: Recipe) -> dict[str, Any]:
    """Solve one run and return its row of the table."""
    motion = record.scaled(PEAK_G / record.pga_g).motion
    name = f"{label(record)}, r2 = {second_slope:g}"
    outcome = opensees.run(BenchmarkScene(name, name, section4_scene(second_slope), motion, label(record)), recipe)
    assert outcome.drift is not None and outcome.slip is not None
    return {
        "component": label(record),
        "samples": samples_digest(record),
        "peak_g": PEAK_G,
        "second_slope": second_slope,
        "stiffness_ratio": recipe.friction,
        "substeps": recipe.substeps,
        "every": EVERY,
        "dt": motion.dt,
        "version": str(opensees.ops.version()),
        "openseespy": version("openseespy"),
        "platform": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
        "drift": outcome.drift[::EVERY].astype(np.float32).ravel(),
        "slip": outcome.slip[::EVERY].astype(np.float32).ravel(),
        "peak_drift": outcome.peak_drift.tolist(),
        "peak_slip": outcome.peak_slip.tolist(),
    }


def main() -> int:
    """Solve all runs and write the table; without OpenSees or recordings, say so and keep it."""
    shared = os.environ.get("SEISMASS_SHARED")
    if opensees.ops is None or not shared:
        missing = "openseespy cannot be loaded" if shared else "SEISMASS_SHARED is not set"
        print(f"{missing}: {KEPT.name} is kept as it is", file=sys.stderr)
        return 0
    records = [*components("Brawley Airport", sm.read_suite(Path(shared) / SUITE)), *components("Brawley Airport")]
    rows = [row(record, slope, recipe) for record in records for slope in COMPARED_SLOPES for recipe in RECIPES]
    schema = {name: pl.List(pl.Float32) for name in ("drift", "slip")}
    pl.DataFrame(rows, schema_overrides=schema).write_parquet(KEPT, compression="zstd", compression_level=19)
    print(f"wrote {KEPT}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
