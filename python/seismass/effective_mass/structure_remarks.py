"""What the rule by period cannot know of a building: racks, walls and stops, with what they were found to do."""

from __future__ import annotations

from seismass.model.scene import Scene


def remarks_of_structure(scene: Scene) -> tuple[str, ...]:
    """Return where the rule does not hold for a scene, as sentences; none for goods on floors of a shear building."""
    remarks = []
    if any(rack.floor > 0 for rack in scene.racks):
        remarks.append(
            "the rule by period knows no racks: stiff ones may give more than 1, those of 1 to 2 s or that yield may "
            "give 0 to 0.5 where it says 0.8 and more"
        )
    if scene.building is not None and scene.building.stiffness_matrix is not None:
        remarks.append(
            "the rule by period knows no walls: beside a frame that yields the share may be above the estimate"
        )
    if any(block.stops is not None for block in scene.goods):
        remarks.append("the rule by period knows no stops: with slippery goods they raise the share by 0.1 to 0.3")
    return tuple(remarks)
