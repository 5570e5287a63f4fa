"""Periods of storage racks by direction, for racks of which nothing better is known, with their sources."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from seismass.base.values import known_id
from seismass.model.codes import FROM_MEMORY


@dataclass(frozen=True)
class RackDirection:
    """A direction of pallet racks.

    Attributes
    ----------
    name : str
        "down-aisle", along the beams, or "cross-aisle", along the braced frames.
    period : float
        First period (s) with frame and goods, taken where none is stated.
    low, high : float
        Range of it (s).
    source : str
        Where it is from.
    status : str
        How the source was checked.
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
    """Return a direction of racks by its name.

    Raises
    ------
    InvalidOption
        There is none of that name.

    Examples
    --------
    >>> from seismass.model.rack_periods import rack_direction
    >>> rack_direction("down-aisle").period
    1.5
    """
    names = tuple(each.name for each in RACK_DIRECTIONS)
    chosen = known_id(name, names, "direction of racks")
    return RACK_DIRECTIONS[names.index(chosen)]
