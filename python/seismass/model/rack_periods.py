"""Periods of storage racks by direction, for racks of which nothing better is known, with their sources."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from seismass.base.values import known_id
from seismass.model.codes import FROM_MEMORY


@dataclass(frozen=True)
class RackDirection:
    """A direction of pallet racks, "down-aisle" (along the beams) or "cross-aisle" (along the braced frames), with its
    default first period, frame and goods (s), range, source and how the source was checked.
    """

    name: str
    period: float
    low: float
    high: float
    source: str
    status: str


RACK_DIRECTIONS: Final = (
    RackDirection(
        "down-aisle", 1.5, 1.0, 2.5, "unbraced frames, FEMA 460 (2005) and tests that it quotes", FROM_MEMORY
    ),
    RackDirection("cross-aisle", 0.7, 0.4, 1.0, "braced frames, FEMA 460 (2005) and tests that it quotes", FROM_MEMORY),
)
"""Periods of racks by direction. The range is wide: state the period of the racks that stand there."""


def rack_direction(name: str) -> RackDirection:
    """Return a direction of racks by its name."""
    names = tuple(each.name for each in RACK_DIRECTIONS)
    chosen = known_id(name, names, "direction of racks")
    return RACK_DIRECTIONS[names.index(chosen)]
