"""Racks with their goods, and a sliding base, in the text of a run."""

from __future__ import annotations

import math
from typing import Any

from seismass.base.units import STANDARD_GRAVITY
from seismass.model.places import goods_names
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


def stop_table(scene: Scene, response: Response) -> list[list[str]]:
    """Return what came to its stops as rows of a table, its head first: how often, how fast, and how hard."""
    counts: dict[int, int] = {}
    if response.has_events:
        log = response.event_log
        for number in log["number"][log["kind"] == "touch_stop"].tolist():
            counts[number] = counts.get(number, 0) + 1
    weight = None if scene.building is None or scene.building.mass_is_stated else scene.building.weight
    unit = "kN" if weight is None else "/ W"
    header = ["block", "stands on", "clearance mm", "contacts", "largest velocity m/s", f"largest force {unit}"]
    rows = [
        [
            str(number),
            place,
            _clearance(stops.clearance),
            str(counts.get(number, 0)) if response.has_events else "",
            f"{response.peak_contact_velocity[number - 1]:.4g}",
            f"{response.peak_contact_force[number - 1] / (1000.0 if weight is None else weight):.4g}",
        ]
        for number, (place, stops) in enumerate(
            zip(goods_names(scene), (block.stops for block in scene.goods), strict=True), start=1
        )
        if stops is not None
    ]
    return [header, *rows]


def _clearance(sides: tuple[float, float]) -> str:
    """Clearances towards minus and plus; one number where they are equal, none where there is no stop."""
    words = ["none" if math.isinf(side) else f"{1000.0 * side:g}" for side in sides]
    return words[0] if words[0] == words[1] else " / ".join(words)
