"""Racks and their goods in the text of a run."""

from __future__ import annotations

from seismass.base.units import STANDARD_GRAVITY
from seismass.model.places import goods_names
from seismass.model.scene import Scene
from seismass.runs.response import Response


def goods_places(scene: Scene) -> list[str]:
    """Return where each block stands: the number of its floor, or its rack and level."""
    return [name.removeprefix("floor ") for name in goods_names(scene)]


def goods_masses(scene: Scene) -> list[float]:
    """Return the mass of each block (kg)."""
    of_racks = [mass for rack in scene.racks for mass in rack.sliding_masses(scene.building)]
    return [*scene.block_mass.tolist(), *of_racks]


def rack_table(scene: Scene, response: Response) -> list[list[str]]:
    """Return the peaks of every level as rows of a table, its head first."""
    building = scene.building
    stated = building is None or building.mass_is_stated
    unit, force = ("kN", 1000.0) if building is None or stated else ("/ W", building.weight)
    header = ["rack", "floor", "level", "peak drift mm", "residual mm", f"peak shear {unit}", "acceleration g"]
    rows = [
        [
            str(number + 1),
            str(rack.floor) if rack.floor else "ground",
            str(level + 1),
            f"{1000.0 * response.peak_rack_drift[number][level]:.3f}",
            f"{1000.0 * response.residual_rack_drift[number][level]:.3f}",
            f"{response.peak_rack_shear[number][level] / force:.4g}",
            f"{response.peak_rack_acceleration[number][level] / STANDARD_GRAVITY:.4f}",
        ]
        for number, rack in enumerate(scene.racks)
        for level in range(rack.levels)
    ]
    return [header, *rows]
