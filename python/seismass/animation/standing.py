"""What stands on floors and on levels of racks, as an animation draws it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seismass.model.scene import Scene


@dataclass(frozen=True)
class Good:
    """Goods as drawn: rack (from 1; 0 is the building) and level (0 is the ground), size over the largest (square root
    of the masses), whether they are attached, and clearances of stops towards minus and plus (m).
    """

    rack: int
    level: int
    size: float
    fixed: bool
    stops: tuple[float, float] | None


def standing_goods(scene: Scene) -> tuple[Good, ...]:
    """Return all goods: those that may slide in the order of results, and fixed ones among those of their rack."""
    found = []
    for block, mass in zip(scene.blocks, scene.block_mass.tolist(), strict=True):
        stops = None if block.stops is None else block.stops.clearance
        found.append((0, block.floor, mass, False, stops))
    for number, rack in enumerate(scene.racks, start=1):
        for good, mass in zip(rack.blocks, rack.masses(scene.building), strict=True):
            stops = None if good.fixed or good.block.stops is None else good.block.stops.clearance
            found.append((number, good.level, mass, good.fixed, stops))
    largest = max((mass for _, _, mass, _, _ in found), default=1.0)
    return tuple(
        Good(rack, level, float(np.sqrt(mass / largest)), fixed, stops) for rack, level, mass, fixed, stops in found
    )
