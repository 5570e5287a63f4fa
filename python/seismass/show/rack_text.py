"""Racks with their goods, and a sliding base, in the text of a run."""

from __future__ import annotations

from typing import Any

from seismass.base.units import STANDARD_GRAVITY
from seismass.model.scene import Scene
from seismass.runs.response import Response


def base_line(scene: Scene, response: Response) -> str:
    """Return what a sliding base is and did, as a line."""
    base: Any = scene.base
    friction = f"mu {base.mu_s:g}" if base.mu_s == base.mu_k else f"mu {base.mu_s:g}/{base.mu_k:g}"
    surface = "flat" if base.radius is None else f"radius {base.radius:g} m"
    return (
        f"base      {friction}, {surface}: peak slip {1000.0 * response.peak_base_slip:.3f} mm at "
        f"{response.peak_base_slip_time:.3f} s, residual {1000.0 * response.residual_base_slip:.3f} mm, "
        f"path {1000.0 * response.base_slip_path:.3f} mm"
    )


def goods_places(scene: Scene) -> list[str]:
    """Return where each block stands: its floor, or its rack and level."""
    ground = "ground" if scene.base is None else "slab"
    floors = [str(block.floor) if block.floor else ground for block in scene.blocks]
    levels = [
        f"rack {number} level {block.level}"
        for number, rack in enumerate(scene.racks, start=1)
        for block in rack.blocks
        if not block.fixed
    ]
    return floors + levels


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
            str(rack.floor) if rack.floor else ("ground" if scene.base is None else "slab"),
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
