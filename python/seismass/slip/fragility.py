"""Fragility of slip: the probability that a block reaches its clearance, by intensity."""

from __future__ import annotations

from typing import Any, Final

from seismass.fragility.analysis import incremental_dynamic_analysis
from seismass.fragility.fragility import Fragility
from seismass.fragility.hunt import HuntAndFill
from seismass.fragility.limits import LimitState
from seismass.fragility.measures import IntensityMeasure
from seismass.fragility.models import REAL
from seismass.model.scene import Scene
from seismass.slip.clearance import Clearance

TOLERANCE: Final = 1e-3
"""Relative width to which the intensity is located at which a block reaches its clearance."""


def slip_fragilities(
    scene: Scene,
    motions: Any,
    clearances: tuple[Clearance | None, ...],
    measure: IntensityMeasure,
    *,
    confidence: float,
    resamples: int,
    seed: int,
    threads: int | None,
) -> tuple[dict[int, Fragility], tuple[str, ...]]:
    """Return the fragility of each block with a clearance, by its number, and remarks of the analysis. The limit of the
    largest absolute slip is the smaller clearance, as if both sides had it.
    """
    limits = {
        number: LimitState("slip", each.smallest, block=number)
        for number, each in enumerate(clearances, start=1)
        if each is not None
    }
    found = incremental_dynamic_analysis(
        {REAL: scene},
        motions,
        list(limits.values()),
        measure=measure,
        hunt=HuntAndFill(tolerance=TOLERANCE),
        confidence=confidence,
        resamples=resamples,
        seed=seed,
        threads=threads,
    )
    return {number: found.fragility(limit, REAL) for number, limit in limits.items()}, found.remarks
