"""A base that slides, beside the same as a stiff weak storey whose damping is that of all modes.

Usage: python benchmarks/sliding_base.py [--write FOLDER]. It prints the page docs/sliding_base.md or writes it into a
folder. It needs the recordings in the folder that the environment variable SEISMASS_SHARED names.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any, Final

import numpy as np

import seismass as sm

RECORD: Final = "records/06_Imperial_Valley_1940_El_Centro_Array_9/RSN6_IMPVALL.I_I-ELC180-hor1.AT2"
MAT: Final = 300e3
FLOORS: Final = (250e3, 250e3, 250e3)
STIFFNESS: Final = 4.0e8
MU: Final = 0.08


def on_base(damping: float, radius: float | None = None) -> sm.Scene:
    """Return the building on a base that sticks exactly."""
    building = sm.Building(FLOORS, [STIFFNESS] * 3, damping=damping)
    return sm.Scene(building, base=sm.SlidingBase(MU, mass=MAT, radius=radius))


def on_stiff_storey(damping: Any, stiffness: float) -> sm.Scene:
    """Return the same with the friction of the mat as a rigid-plastic storey 1."""
    mass = np.array([MAT, *FLOORS])
    building = sm.Building(
        mass,
        [stiffness, *[STIFFNESS] * 3],
        yield_shear=[MU * sm.STANDARD_GRAVITY * mass.sum(), np.inf, np.inf, np.inf],
        overstrength=1.0,
        second_slope=0.0,
        third_slope=0.0,
        damping=damping,
    )
    return sm.Scene(building)


def rows(record: sm.Record) -> list[tuple[str, float, float, float]]:
    """Name of the model, slip of the mat, largest drift of the storeys above it (mm), acceleration of the roof (g)."""
    found = []
    for name, scene in (
        ("sliding base, no damping", on_base(0.0)),
        ("sliding base, 2 % in the modes of the structure fixed at its base", on_base(0.02)),
        ("the same, pendulum of 2 m", on_base(0.02, 2.0)),
        ("stiff storey, no damping", on_stiff_storey(0.0, 8.24e11)),
        ("stiff storey, 2 % in every mode", on_stiff_storey(0.02, 8.24e11)),
        ("softer storey (8.24e9 N/m), 2 % in every mode", on_stiff_storey(0.02, 8.24e9)),
        ("stiff storey, Rayleigh 2 % in modes 1 and 2", on_stiff_storey(sm.Rayleigh(0.02, (1, 2)), 8.24e11)),
    ):
        run = sm.simulate(scene, record)
        slip, above = (
            (run.peak_base_slip, run.peak_drift) if scene.base is not None else (run.peak_drift[0], run.peak_drift[1:])
        )
        roof = run.peak_floor_acceleration[-1] / sm.STANDARD_GRAVITY
        found.append((name, 1e3 * float(slip), 1e3 * float(above.max()), float(roof)))
    return found


def page(table: list[tuple[str, float, float, float]]) -> str:
    """Return the page."""
    return "\n".join(
        [
            "# A base that slides",
            "",
            "Made by `python benchmarks/sliding_base.py --write .`.",
            "",
            "`sm.Scene(building, base=sm.SlidingBase(mu))`, or `[base]` in a [scene file](scene_file.md), puts a",
            "slab between",
            "the ground and all that stands in the scene: a mat, a flat slider, or a friction pendulum with its",
            "`radius`",
            "([method](numerics.md), 9.6). Three storeys of 250 t (4e8 N/m each) on a mat of 300 t with mu =",
            "0.08, under El",
            "Centro 1940, 180:",
            "",
            "| model | slip of the mat mm | largest storey drift mm | roof acceleration g |",
            "| --- | --- | --- | --- |",
            *(f"| {name} | {slip:.2f} | {drift:.2f} | {roof:.3f} |" for name, slip, drift, roof in table),
            "",
            "A storey with a high first stiffness and a low strength is no substitute. Damping in every mode, or",
            "Rayleigh",
            "damping, is formed with that stiffness and stays when the storey slides: its dampers carry what its",
            "spring cannot,",
            "the mat hardly slides, and the structure above takes the force. Which slip comes out is then decided",
            "by a stiffness",
            "that has no meaning. Without any damping the two agree. With a base the damping is that of the",
            "structure fixed at",
            "its base.",
            "",
        ]
    )


def main() -> int:
    """Print or write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--write", type=Path, help="folder of the project: docs/sliding_base.md in it is written")
    given = parser.parse_args()
    shared = os.environ.get("SEISMASS_SHARED")
    if not shared:
        print("SEISMASS_SHARED must name the folder of the recordings; got none", file=sys.stderr)
        return 2
    text = page(rows(sm.read_record(Path(shared) / RECORD)))
    if given.write is None:
        print(text)
    else:
        (given.write / "docs" / "sliding_base.md").write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
