"""Where the parts of a scene are: names of what its events and results number, and where its goods stand."""

from __future__ import annotations

from seismass.model.scene import Scene


def floor_name(floor: int) -> str:
    """Return what a figure calls a floor."""
    return f"floor {floor}" if floor else "ground"


def spring_names(scene: Scene) -> tuple[str, ...]:
    """Return the names of storeys and of the levels of racks, in the order in which events number them."""
    storeys = (f"storey {number}" for number in range(1, scene.storeys + 1))
    return (*storeys, *(f"rack {rack} level {level}" for rack, level in rack_levels(scene)))


def rack_levels(scene: Scene) -> tuple[tuple[int, int], ...]:
    """Return rack and level of every level of every rack, both counted from 1, in the order of results."""
    racks = enumerate(scene.racks, start=1)
    return tuple((number, level) for number, rack in racks for level in range(1, rack.levels + 1))


def goods_names(scene: Scene) -> tuple[str, ...]:
    """Return where each block that may slide stands, in the order of results."""
    ground = floor_name(0) if scene.base is None else "slab"
    floors = (floor_name(block.floor) if block.floor else ground for block in scene.blocks)
    racks = enumerate(scene.racks, start=1)
    levels = (
        f"rack {number} level {block.level}" for number, rack in racks for block in rack.blocks if not block.fixed
    )
    return (*floors, *levels)


def goods_levels(scene: Scene) -> tuple[tuple[int, int], ...]:
    """Return rack and level of each block that may slide, in the order of results; rack 0 is the building."""
    floors = ((0, block.floor) for block in scene.blocks)
    racks = enumerate(scene.racks, start=1)
    levels = ((number, block.level) for number, rack in racks for block in rack.blocks if not block.fixed)
    return (*floors, *levels)
