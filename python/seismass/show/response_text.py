"""A run as lines to read: building, motion, peaks of storeys and blocks, events, energy, status."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from seismass.base.units import STANDARD_GRAVITY
from seismass.media.text_table import numbers_text, text_table
from seismass.model.block import Block
from seismass.model.building import Building, Rayleigh
from seismass.model.scene import Scene, goods_names, spring_names
from seismass.runs.plane import PlaneResponse
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


def response_text(response: Response) -> str:
    """Return a run as lines, under the names of its scene and record."""
    return run_text(response)


def run_text(
    response: Response,
    *,
    title: str | None = None,
    note: str | None = None,
    source: str | None = None,
    remarks: Sequence[str] = (),
) -> str:
    """Return building, motion, peaks of storeys and blocks, events, energy and status as lines below a heading, by
    default the name of the scene and of its record. `remarks` tell what is to be known of the input.
    """
    scene, motion = response.scene, response.motion
    lines = [(scene.name if title is None else title) or "Response"]
    words = scene.note if note is None else note
    if words:
        lines.append(f"  {words}")
    lines += [f"  {line}" for line in ([] if scene.building is None else _building_lines(scene.building, scene))]
    vertical = "" if motion.vertical is None else f", vertical {max(abs(motion.vertical)) / STANDARD_GRAVITY:.3f} g"
    name = (response.record.name if response.record else "") if source is None else source
    named = f"{name}, " if name else ""
    lines.append(
        f"  motion    {named}{motion.samples} samples at {motion.dt:g} s ({motion.duration:g} s), "
        f"PGA {motion.pga_g:.3f} g{vertical}"
    )
    lines += [f"            {remark}" for remark in remarks or response.remarks]
    if scene.building is not None:
        lines += ["", *text_table(_storey_table(scene.building, response), left=0)]
        if scene.building.stiffness_matrix is not None:
            lines.append(
                f"  peak base shear {_force(response.peak_base_shear, scene.building)}, springs and walls together"
            )
    if scene.base is not None:
        lines += ["", base_line(scene, response)]
    if scene.racks:
        lines += ["", *text_table(rack_table(scene, response), left=0)]
    if scene.goods:
        lines += ["", *text_table(_block_table(scene, response), left=0)]
    if any(block.stops is not None for block in scene.goods):
        lines += ["", *text_table(stop_table(scene, response), left=0)]
    counts = ", ".join(f"{count} {kind}" for kind, count in response.counts.items() if count) or "none"
    end = f"{response.status} at {response.end_time:g} s"
    if response.collapsed_storey is not None:
        fell = spring_names(scene)[response.collapsed_storey - 1]
        end += f": {fell} reached its collapse drift; peaks are those until then"
    known = response.has_energy
    energy = [f"  energy    residual {response.energy['relative_residual']:.1e} of the input"] if known else []
    return "\n".join(
        [
            *lines,
            "",
            f"  events    {counts}",
            *energy,
            f"  status    {end}",
        ]
    )


def _building_lines(building: Building, scene: Scene) -> list[str]:
    noun = "storey" if building.storeys == 1 else "storeys"
    periods = ", ".join(f"{period:.3f}" for period in building.periods[:3])
    more = ", ..." if building.storeys > 3 else ""
    lines = [
        f"building  {building.storeys} {noun}, periods {periods}{more} s, {_weight_text(building)}, "
        f"damping {_damping_text(building)}"
    ]
    parameters = ", ".join(f"{symbol} {numbers_text(values)}" for symbol, values in building.spring_summary().items())
    elastic = math.isinf(building.yield_shear.min()) and not building.laws
    lines.append(f"springs   {'elastic' if elastic else ', '.join([parameters, *building.laws])}")
    if building.stiffness_matrix is not None:
        lines.append("walls     elastic stiffness matrix over the floors")
    if scene.geometric_stiffness.any() and building.stiffness.all():
        lines.append(f"P-Delta   P/(h k) {numbers_text(scene.geometric_stiffness / building.stiffness)}")
    return lines


def _weight_text(building: Building) -> str:
    """The weight; where no mass is stated, that forces are fractions of it."""
    if building.mass_is_stated:
        return f"weight {building.weight / 1000.0:.5g} kN"
    return "no mass stated (forces over the weight W)"


def _damping_text(building: Building) -> str:
    damping = building.damping
    if isinstance(damping, Rayleigh):
        return f"{100.0 * damping.ratio:g} % in modes {damping.modes[0]} and {damping.modes[1]} (Rayleigh)"
    return f"{100.0 * damping:g} % in every mode" if isinstance(damping, float) else "by a given matrix"


def _force(value: float, building: Building) -> str:
    return f"{value / 1000.0:.4g} kN" if building.mass_is_stated else f"{value / building.weight:.4g} W"


def _storey_table(building: Building, response: Response) -> list[list[str]]:
    stated = building.mass_is_stated
    unit, force = ("kN", 1000.0) if stated else ("/ W", building.weight)
    header = ["storey", "peak drift mm", "at s", "residual mm", f"peak shear {unit}", "floor acceleration g"]
    ratios = response.peak_drift_ratio
    if ratios is not None:
        header.insert(2, "of height %")
    rows = []
    for i in range(len(response.peak_drift)):
        row = [
            str(i + 1),
            f"{1000.0 * response.peak_drift[i]:.3f}",
            f"{response.peak_drift_time[i]:.3f}",
            f"{1000.0 * response.residual_drift[i]:.3f}",
            f"{response.peak_storey_shear[i] / force:.4g}",
            f"{response.peak_floor_acceleration[i] / STANDARD_GRAVITY:.4f}",
        ]
        if ratios is not None:
            row.insert(2, f"{100.0 * ratios[i]:.3f}")
        rows.append(row)
    return [header, *rows]


def _block_table(scene: Scene, response: Response) -> list[list[str]]:
    stated = scene.building is None or scene.building.mass_is_stated
    header = [
        "block",
        "floor",
        "mass kg" if stated else "of floor mass",
        "mu",
        "peak slip mm",
        "at s",
        "residual mm",
        "slip path mm",
    ]
    places, masses = goods_places(scene), goods_masses(scene)
    rows = [
        [
            str(j + 1),
            places[j],
            _mass_text(block, masses[j], stated),
            f"{block.mu_s:g}" if block.mu_s == block.mu_k else f"{block.mu_s:g}/{block.mu_k:g}",
            f"{1000.0 * response.peak_slip[j]:.3f}",
            f"{response.peak_slip_time[j]:.3f}",
            f"{1000.0 * response.residual_slip[j]:.3f}",
            f"{1000.0 * response.slip_path[j]:.3f}",
        ]
        for j, block in enumerate(scene.goods)
    ]
    return [header, *rows]


def _mass_text(block: Block, mass: float, stated: bool) -> str:
    """The mass of a block; over that of its floor where that is not stated, except for blocks on the ground."""
    if stated:
        return f"{mass:.5g}"
    return f"{mass:.5g} kg" if block.mass_ratio is None else f"{block.mass_ratio:.5g}"


def plane_text(response: PlaneResponse) -> str:
    """Return a run in two directions as lines, under the name of its scene."""
    return plane_run_text(response)


def plane_run_text(response: PlaneResponse, *, title: str | None = None, remarks: Sequence[str] = ()) -> str:
    """Return peaks of storeys and blocks by direction and of the vector, events, energy and status as lines."""
    x, y = response.motions
    lines = [(response.scene.name if title is None else title) or "Response in two directions", f"  {response.scene!r}"]
    lines.append(
        f"  motion    {x.samples} samples at {x.dt:g} s ({x.duration:g} s), "
        f"PGA {x.pga_g:.3f} g in x, {y.pga_g:.3f} g in y"
    )
    lines += [f"            {remark}" for remark in remarks or response.remarks]
    for title_of, noun, values, unit, factor in (
        ("peak drift", "storey", response.peak_drift, "mm", 1e3),
        ("peak drift of rack levels", "level", response.peak_rack_drift, "mm", 1e3),
        ("peak acceleration", "floor", response.peak_floor_acceleration, "m/s2", 1.0),
        ("peak slip", "block", response.peak_slip, "mm", 1e3),
    ):
        if len(values):
            rows = [
                [str(number), *(f"{factor * value:.3f}" for value in peaks)]
                for number, peaks in enumerate(values.tolist(), start=1)
            ]
            lines += ["", f"{title_of} ({unit})", *text_table([[noun, "x", "y", "vector"], *rows], left=0)]
    counts = ", ".join(f"{count} {kind}" for kind, count in response.counts.items() if count) or "none"
    lines += ["", f"events    {counts}"]
    if response.status == "collapsed":
        lines.append(f"collapsed: storey {response.collapsed_storey} at {response.end_time:.6g} s")
    else:
        lines.append(f"completed at {response.end_time:g} s")
    return "\n".join(lines)
