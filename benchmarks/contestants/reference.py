"""The reference integrators of the kernel: the same state machines, or friction springs, in fixed steps."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

from contestants.base import EVERYWHERE, Failed, Outcome, Setting
from scenes import BenchmarkScene
from seismass import _kernel

SMOOTH_AND_STICK_SLIP: Final = ("section4-0.05", "study-3", "sliding", "elastic")
"""Scenes of the methods that are here for what event location is worth, not for speed."""
EVENT_TOLERANCE: Final = 1e-12
"""Of the root of a guard, over the step."""


def run(
    bench: BenchmarkScene,
    method: str,
    substeps: int,
    event_tolerance: float | None = None,
    stiffness_ratio: float | None = None,
) -> Outcome:
    """Integrate with so many steps per sample interval."""
    result = _kernel.integrate_reference(
        bench.scene._kernel,
        bench.motion._kernel,
        method,
        substeps,
        event_tolerance=event_tolerance,
        stiffness_ratio=stiffness_ratio,
    )
    if not result.completed:
        raise Failed("a storey collapsed")
    slip = result.slip
    return Outcome(result.drift, slip, result.peak_drift, result.peak_slip, slip[-1])


def _family(
    name: str,
    method: str,
    substeps: Sequence[int],
    scenes: Sequence[str] = SMOOTH_AND_STICK_SLIP,
    *,
    quick: int,
    located: bool = False,
    ratio: float | None = None,
) -> list[Setting]:
    return [
        Setting(
            name,
            f"dt / {count}" if ratio is None else f"{ratio:g} k, dt / {count}",
            partial(
                run,
                method=method,
                substeps=count,
                event_tolerance=EVENT_TOLERANCE if located else None,
                stiffness_ratio=ratio,
            ),
            scenes=scenes,
            quick=count <= quick,
        )
        for count in substeps
    ]


def settings() -> list[Setting]:
    """Return every method with shorter and shorter steps; `quick` is the finest of the quick mode."""
    coarse_to_fine = (1, 2, 5, 20, 50, 200, 500, 2000)
    return [
        *_family("leapfrog, Rust", "leapfrog", coarse_to_fine, EVERYWHERE, quick=200),
        *_family("Gauss-Legendre 4", "gauss", (1, 5, 20, 100), quick=5),
        *_family("Gauss-Legendre 4, located", "gauss", (1, 2, 5, 20), quick=5, located=True),
        *_family("Newmark", "newmark", (1, 5, 20, 100), quick=5),
        *_family("Newmark, located", "newmark", (1, 5, 20, 100), quick=5, located=True),
        *_family("Newmark, friction spring", "friction_springs", (1, 5), quick=1, ratio=1e2),
        *_family("Newmark, friction spring", "friction_springs", (1, 5), quick=1, ratio=1e4),
        *_family("Newmark, friction spring", "friction_springs", (50,), quick=5, ratio=1e5),
    ]
