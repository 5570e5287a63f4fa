"""What the rule by period cannot know of a building: racks, walls, stops and a base that slides."""

from __future__ import annotations

from typing import Final

from seismass.model.scene import Scene

RULE_UNKNOWN: Final = "the rule by period knows no"
"""How a remark begins that the rule does not hold."""


def remarks_of_structure(scene: Scene) -> tuple[str, ...]:
    """Return where the rule does not hold for a scene, as sentences; none for goods on floors of a shear building."""
    remarks = []
    if any(rack.floor > 0 for rack in scene.racks):
        remarks.append(
            f"{RULE_UNKNOWN} racks: under a yielding building stiff ones give up to 1.1 with pallets (mu 0.37) and up "
            "to 1.3 with fixed goods, those of 1 to 2 s 0 to 0.4, where pallets on the floor give 0.8 to 1"
        )
    if scene.building is not None and scene.building.stiffness_matrix is not None:
        remarks.append(
            f"{RULE_UNKNOWN} walls: an elastic wall beside a frame with R = 4 gives 0.5 at eta = 0.5, where its "
            "estimate says 0.24 and its conservative form 0.55"
        )
    if any(block.stops is not None for block in scene.goods):
        remarks.append(
            f"{RULE_UNKNOWN} stops: at 5 cm they raise the share of slippery goods (mu 0.1) by 0.2 to 0.3, and single "
            "records reach 3 times the drift without them"
        )
    if scene.base is not None:
        remarks.append(
            f"{RULE_UNKNOWN} sliding base: it takes C1 of the building on the ground, and a base that slides limits "
            "what the floors feel to about its friction"
        )
    return tuple(remarks)
