"""Loops of the spring laws by OpenSees: every case's material driven along one list of drifts, kept as Parquet.

The table is read by tests and by tools/pages/spring_loops.py, which run without OpenSees. Only `main` needs it.
"""

from __future__ import annotations

import json
import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

import seismass as sm

FloatArray = NDArray[np.float64]

DATA: Final = Path(__file__).parent / "results" / "spring_loops.parquet"
STIFFNESS: Final = 1e8
YIELD: Final = 1e6
"""Initial stiffness (N/m) and yield shear (N) of every case: the yield drift is 0.01 m."""
YIELD_DRIFT: Final = YIELD / STIFFNESS
STEP: Final = 0.1
"""Increment of the drift that OpenSees takes, over the yield drift."""
FULL: Final = (1.5, -1.5, 2.5, -2.5, 4.0, -4.0)
"""Turning points of full cycles of growing amplitude, over the yield drift."""
PARTIAL: Final = (4.0, 3.4, 4.5, -1.0, 0.5, -3.0, 2.0, -0.5, 5.0, 4.4, -6.0, 6.0, 0.0)
"""Turning points of the cycles that follow: partial unloading, reversals within the loop, and again full cycles."""
_NEVER: Final = 1e12
"""Energy over the yield force (m) that is never dissipated: no deterioration. Zero would not switch it off."""
PARTS: Final = ("full", "partial")
FAR: Final = 1e4
"""Where a backbone that never ends has its last point, over the yield drift."""
POINTS: Final = ((1.0, 1.0), (2.0, 1.6), (3.5, 2.05), (5.0, 2.2))
"""Backbone of the multilinear cases, over yield drift and yield shear; its slopes are 1, 0.6, 0.3 and 0.1."""


@dataclass(frozen=True)
class Case:
    """A law of the kernel and the material of OpenSees that is to do the same.

    Attributes
    ----------
    name, title : str
        Its name in the table, and what the page calls it.
    law : dict
        Arguments of `Building` beside mass, stiffness and yield shear.
    materials : tuple
        Arguments of `uniaxialMaterial`; the last one is driven.
    full, partial : float
        Largest difference of the two forces over V_y that the two parts of the path are known to have.
    reason : str
        Why the forces differ, or why they do not.
    substeps : int
        Increments that OpenSees takes per drift.
    """

    name: str
    title: str
    law: dict[str, Any]
    materials: tuple[tuple[Any, ...], ...]
    full: float
    partial: float
    reason: str = field(repr=False)
    substeps: int = 1

    @property
    def material(self) -> str:
        """Names of the materials, each once, the last one first."""
        return ", ".join(dict.fromkeys(str(arguments[0]) for arguments in reversed(self.materials)))

    def building(self) -> sm.Building:
        """Return a building of one storey with the law."""
        return sm.Building(1e5, **({"stiffness": STIFFNESS, "yield_shear": YIELD} | self.law))

    def forces(self, drifts: FloatArray) -> FloatArray:
        """Return the kernel's forces along a list of drifts (N)."""
        return sm.runs.spring_forces(self.building(), 1, drifts).force


def path(turns: Sequence[float], start: float = 0.0) -> FloatArray:
    """Return the drifts from turning point to turning point (m), each turning point once, without the start."""
    legs = []
    for turn in turns:
        count = round(abs(turn - start) / STEP)
        legs.append(np.linspace(start, turn, count + 1)[1:])
        start = turn
    return YIELD_DRIFT * np.concatenate(legs)


def drifts() -> tuple[FloatArray, NDArray[np.str_]]:
    """Return all drifts of the path (m), and the part that each belongs to."""
    full, partial = path(FULL), path(PARTIAL, FULL[-1])
    return np.concatenate((full, partial)), np.repeat(PARTS, (full.size, partial.size))


def _masing(*elements: tuple[float, float], hardening: float = 0.0) -> tuple[tuple[Any, ...], ...]:
    """Parallel elastoplastic elements of (stiffness, yield drift) and a linear one, over those of the case."""
    made: list[tuple[Any, ...]] = [
        ("ElasticPP", tag, stiffness * STIFFNESS, drift * YIELD_DRIFT)
        for tag, (stiffness, drift) in enumerate(elements, start=1)
    ]
    if hardening:
        made.append(("Elastic", len(made) + 1, hardening * STIFFNESS))
    return (*made, ("Parallel", 99, *range(1, len(made) + 1)))


def _stops(clearance: float, stiffness: float) -> tuple[tuple[Any, ...], ...]:
    """Gaps to both sides, which stay elastic."""
    modulus, gap, never = stiffness * STIFFNESS, clearance * YIELD_DRIFT, 1e6 * YIELD
    return (("ElasticPPGap", 10, modulus, never, gap, 0.0), ("ElasticPPGap", 11, modulus, -never, -gap, 0.0))


def _peaks(*points: tuple[float, float], exponent: float = 0.0) -> tuple[tuple[Any, ...], ...]:
    """`Hysteretic` without pinching and damage, through three points of drift and force on each side."""
    flat = [value for drift, force in points for value in (force * YIELD, drift * YIELD_DRIFT)]
    return (("Hysteretic", 1, *flat, *(-value for value in flat), 1.0, 1.0, 0.0, 0.0, exponent),)


def _bilin(second_slope: float) -> tuple[Any, ...]:
    """`Bilin` with a cap that is never reached, without deterioration."""
    far, rates = FAR * YIELD_DRIFT, (1.0,) * 4
    never = (_NEVER,) * 4
    plastic, falling, residual, ultimate = (far, far), (far, far), (0.0, 0.0), (far, far)
    slopes = (second_slope, second_slope, YIELD, -YIELD)
    return ("Bilin", 1, STIFFNESS, *slopes, *never, *rates, *plastic, *falling, *residual, *ultimate, 1.0, 1.0)


def _imk_bilin(second_slope: float) -> tuple[Any, ...]:
    """`IMKBilin` with a cap that is never reached, without deterioration."""
    far = FAR * YIELD_DRIFT
    side = (far, far, 10.0 * far, YIELD, 1.0 + second_slope * FAR, 0.0)
    return ("IMKBilin", 1, STIFFNESS, *side, *side, *(_NEVER,) * 3, *(1.0,) * 3, 1.0, 1.0)


def _imk(
    second_slope: float, cap: float, post_capping: float, residual: float = 0.0, capacity: float | None = None
) -> tuple[tuple[Any, ...], ...]:
    """`IMKPeakOriented` with a cap at a strength over V_y and a fall to zero over a drift, over the yield drift.

    Its lambda is an energy over the yield force, a drift.
    """
    to_cap = (cap - 1.0) / second_slope  # from the yield point
    side = (to_cap * YIELD_DRIFT, post_capping * YIELD_DRIFT, FAR * YIELD_DRIFT, YIELD, cap, residual)
    strength = _NEVER if capacity is None else capacity * YIELD_DRIFT
    rates = (strength, *(_NEVER,) * 3)
    return (("IMKPeakOriented", 1, STIFFNESS, *side, *side, *rates, *(1.0,) * 4, 1.0, 1.0),)


_TRILINEAR: Final[dict[str, Any]] = {"overstrength": 1.2, "second_slope": 0.1, "third_slope": 0.02}
"""Second yield at 3 d_y."""
_BILINEAR: Final[dict[str, Any]] = {"overstrength": 1e3, "second_slope": 0.1}
_ELEMENTS: Final = ((0.9, 1.0), (0.08, 3.0))
_POINTS: Final = [(drift * YIELD_DRIFT, force * YIELD) for drift, force in POINTS]
_BACKBONE: Final[dict[str, Any]] = {"stiffness": None, "yield_shear": np.inf, "backbone": _POINTS}
_CLOUGH: Final[dict[str, Any]] = {"hysteresis": "peak-oriented", "overstrength": 1.0, "second_slope": 0.0}
_HARDENING: Final[dict[str, Any]] = _CLOUGH | {"overstrength": 1.3, "second_slope": 0.1, "third_slope": 0.02}
_SOFTENING: Final[dict[str, Any]] = _CLOUGH | {
    "overstrength": 1.2,
    "second_slope": 0.1,
    "third_slope": -0.2,
    "residual_strength": 0.4,
}
_ROUNDING: Final = 1e-12
"""Difference of forces over V_y that rounding makes: some tens of operations per drift, each to 1e-16."""

_MISSED: Final = 6 * 0.5 * 0.01**2 / 100.0
"""Loss of strength over V_y by the energy that six half cycles leave out: that of one increment, 0.01 d_y, in each."""

_LOCAL: Final = (
    "Equal to rounding until a storey reloads after a cycle smaller than the largest. `IMKPeakOriented` then aims at "
    "the peak of the last cycle first where the line to it is steeper; the kernel aims at the largest drift, as Clough "
    "does."
)
_ENERGY: Final = (
    "`IMKPeakOriented` sums energy by increments and leaves out the one in which the force passes zero. A tenth of the "
    "increment (0.01 d_y) is used here. The partial cycles differ by the peak that is aimed at, as above."
)

CASES: Final = (
    Case(
        "elastoplastic",
        "Elastoplastic",
        {"overstrength": 1.0, "second_slope": 0.0},
        _masing((1.0, 1.0))[:1],
        _ROUNDING,
        _ROUNDING,
        "The same law.",
    ),
    Case(
        "bilinear-steel01",
        "Bilinear",
        _BILINEAR,
        (("Steel01", 1, YIELD, STIFFNESS, 0.1),),
        _ROUNDING,
        _ROUNDING,
        "The same law: kinematic hardening.",
    ),
    Case(
        "bilinear-bilin",
        "Bilinear",
        _BILINEAR,
        (_bilin(0.1),),
        _ROUNDING,
        1.0,
        "The same law, with the deterioration of `Bilin` switched off, but for the way from 2 d_y to -0.5 d_y. There "
        "`Bilin` returns along the backbone to the origin instead of unloading. OpenSees warns against this material; "
        "`IMKBilin` replaces it.",
    ),
    Case(
        "bilinear-imk",
        "Bilinear",
        _BILINEAR,
        (_imk_bilin(0.1),),
        _ROUNDING,
        _ROUNDING,
        "The same law, with the deterioration of `IMKBilin` switched off.",
    ),
    Case(
        "trilinear",
        "Trilinear",
        _TRILINEAR,
        _masing(*_ELEMENTS, hardening=0.02),
        _ROUNDING,
        _ROUNDING,
        "The same law: Iwan's elements in parallel.",
    ),
    Case(
        "multilinear",
        "Multilinear",
        _BACKBONE,
        (("MultiLinear", 1, *(value for point in _POINTS for value in point)),),
        _ROUNDING,
        _ROUNDING,
        "The same law: `MultiLinear` keeps the limits of every segment, which is Iwan's model.",
    ),
    Case(
        "multilinear-iwan",
        "Multilinear",
        _BACKBONE,
        _masing((0.4, 1.0), (0.3, 2.0), (0.2, 3.5), hardening=0.1),
        _ROUNDING,
        _ROUNDING,
        "The same law: Iwan's elements in parallel.",
    ),
    Case(
        "gap-elastic",
        "Elastic, with a gap",
        {"yield_shear": np.inf, "clearance": 2.0 * YIELD_DRIFT, "stop_stiffness": 0.5 * STIFFNESS},
        (("Elastic", 1, STIFFNESS), *_stops(2.0, 0.5), ("Parallel", 99, 1, 10, 11)),
        _ROUNDING,
        _ROUNDING,
        "The same law: the gap does not yield.",
    ),
    Case(
        "gap-trilinear",
        "Trilinear, with a gap",
        _TRILINEAR | {"clearance": 3.0 * YIELD_DRIFT, "stop_stiffness": 0.5 * STIFFNESS},
        (*_masing(*_ELEMENTS, hardening=0.02)[:-1], *_stops(3.0, 0.5), ("Parallel", 99, 1, 2, 3, 10, 11)),
        _ROUNDING,
        _ROUNDING,
        "The same law: spring and gaps in parallel.",
    ),
    Case(
        "clough",
        "Peak-oriented, elastoplastic",
        _CLOUGH,
        _peaks((1.0, 1.0), (2.0, 1.0), (FAR, 1.0)),
        _ROUNDING,
        _ROUNDING,
        "The same law: Clough's.",
    ),
    Case(
        "clough-hardening",
        "Peak-oriented, trilinear",
        _HARDENING,
        _peaks((1.0, 1.0), (4.0, 1.3), (104.0, 3.3)),
        _ROUNDING,
        _ROUNDING,
        "The same law.",
    ),
    Case(
        "takeda",
        "Peak-oriented, unloading exponent 0.5",
        _HARDENING | {"unloading_exponent": 0.5},
        _peaks((1.0, 1.0), (4.0, 1.3), (104.0, 3.3), exponent=0.5),
        _ROUNDING,
        5e-3,
        "The same law at all drifts but one. In the increment that passes zero force `Hysteretic` may unload with the "
        "stiffness of the other direction; the next increment is right again.",
    ),
    Case(
        "softening",
        "Peak-oriented, softening to 0.4 V_y",
        _SOFTENING,
        _peaks((1.0, 1.0), (3.0, 1.2), (7.0, 0.4)),
        _ROUNDING,
        _ROUNDING,
        "The same law.",
    ),
    Case(
        "clough-imk",
        "Peak-oriented, bilinear",
        _CLOUGH | {"overstrength": 10.0, "second_slope": 0.1},
        _imk(0.1, 10.0, 1e3),
        _ROUNDING,
        0.5,
        _LOCAL,
    ),
    Case(
        "softening-imk",
        "Peak-oriented, softening to 0.4 V_y",
        _SOFTENING,
        _imk(0.1, 1.2, 6.0, residual=0.4),
        _ROUNDING,
        0.4,
        _LOCAL,
    ),
    Case(
        "cyclic-imk",
        "Peak-oriented, cyclic loss of strength, flat",
        _CLOUGH | {"energy_capacity": 100.0},
        _imk(1e-9, 1.0 + 1e-6, 1e9, capacity=100.0),
        _MISSED,
        0.4,
        _ENERGY,
        substeps=10,
    ),
    Case(
        "cyclic-hardening-imk",
        "Peak-oriented, cyclic loss of strength, hardening",
        _CLOUGH | {"overstrength": 1e3, "second_slope": 0.05, "energy_capacity": 100.0},
        _imk(0.05, 50.0, 1e9, capacity=100.0),
        5e-3,
        0.4,
        "`IMKPeakOriented` lowers the whole backbone, so that its yield drift falls too; the kernel lowers the force "
        "of the point that is aimed at. " + _ENERGY,
        substeps=10,
    ),
)
"""The cases, in the order of the page."""


def driven(case: Case, ops: Any) -> FloatArray:
    """Return the forces of the case's material along the drifts (N)."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for arguments in case.materials:
        ops.uniaxialMaterial(*arguments)
    ops.testUniaxialMaterial(case.materials[-1][1])
    forces, before = [], 0.0
    for drift in drifts()[0].tolist():
        for part in np.linspace(before, drift, case.substeps + 1)[1:].tolist():
            ops.setStrain(part)
        forces.append(ops.getStress())
        before = drift
    ops.wipe()
    return np.array(forces)


def table(ops: Any) -> pl.DataFrame:
    """Return a row per case: what was driven, by which version and where, the drifts (m) and the forces (N)."""
    path_drifts = drifts()[0].tolist()
    return pl.DataFrame(
        [
            {
                "case": case.name,
                "program": "OpenSees",
                "version": str(ops.version()),
                "openseespy": version("openseespy"),
                "platform": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
                "materials": json.dumps(case.materials),
                "increment": STEP * YIELD_DRIFT / case.substeps,
                "drift": path_drifts,
                "force": driven(case, ops).tolist(),
            }
            for case in CASES
        ]
    )


def kept() -> dict[str, FloatArray]:
    """Return the forces of OpenSees in the table, by case.

    Raises
    ------
    ValueError
        The table is of other cases, materials or drifts than these.
    """
    found = pl.read_parquet(DATA)
    here = drifts()[0]
    expected = [(case.name, json.dumps(case.materials)) for case in CASES]
    if found.select("case", "materials").rows() != expected:
        raise ValueError(f"cases of {DATA.name} must be those of {Path(__file__).name}; run make bench")
    if not all(np.array_equal(row, here) for row in found["drift"].to_list()):
        raise ValueError(f"drifts of {DATA.name} must be those of {Path(__file__).name}; run make bench")
    return {row["case"]: np.array(row["force"]) for row in found.select("case", "force").rows(named=True)}


def main() -> int:
    """Drive all materials and write the table; without OpenSees, say so and keep it."""
    try:
        import openseespy.opensees as ops
    except (ImportError, RuntimeError):
        print(f"openseespy cannot be loaded: {DATA.name} is kept as it is", file=sys.stderr)
        return 0
    table(ops).write_parquet(DATA)
    print(f"wrote {DATA}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
