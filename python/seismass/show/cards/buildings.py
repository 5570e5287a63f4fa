"""A building and a scene as a notebook shows them: storeys with their goods, and what they are made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from seismass.base.values import FloatArray, counted
from seismass.media.card import COLOUR, card, rows, stroke, svg, text

if TYPE_CHECKING:
    from seismass.model.block import Block
    from seismass.model.building import Building
    from seismass.model.scene import Scene

BUILDING_WIDTH: Final = 420.0
BAY: Final = 150.0
"""Width of the building (px)."""
LEFT: Final = 40.0
MOST_ROWS: Final = 12
"""Most rows of a table, and most storeys that are labelled."""


def building_html(building: Building) -> str:
    """Return a card of a building."""
    return card("Building", _about(building), building_sketch(building, ()), facts=_facts(building))


def scene_html(scene: Scene) -> str:
    """Return a card of a scene: its building, its blocks, and what is unlikely about them."""
    building = scene.building
    about = "on the ground alone" if building is None else _about(building)
    goods = counted(len(scene.blocks), "block") if scene.blocks else "no blocks"
    return card(
        scene.name or "Scene",
        f"{about}, {goods}",
        building_sketch(building, scene.blocks),
        _blocks(scene),
        facts=() if building is None else _facts(building),
        notes=([scene.note] if scene.note else []) + list(scene.remarks),
    )


def building_sketch(building: Building | None, blocks: tuple[Block, ...]) -> str:
    """Return storeys by their heights, and goods whose areas are as their mass over that of their floor."""
    storeys = 0 if building is None else building.storeys
    heights = np.ones(storeys) if building is None or building.heights is None else building.heights
    tall = float(min(max(46.0 * storeys, 60.0), 300.0))
    up = np.append(0.0, np.cumsum(heights)) / (heights.sum() if storeys else 1.0)
    head = 34.0 if any(block.floor == storeys for block in blocks) else 12.0
    levels = tall * (1.0 - up) + head if storeys else np.array([head])
    parts = [stroke(LEFT - 25.0, levels[0], LEFT + BAY + 25.0, levels[0], width=2.5)]
    for storey in range(storeys):
        bottom, top = levels[storey], levels[storey + 1]
        parts += [stroke(x, bottom, x, top, width=1.6) for x in (LEFT + 6.0, LEFT + BAY - 6.0)]
        parts.append(stroke(LEFT, top, LEFT + BAY, top, width=min(4.0, 0.25 * (bottom - top))))
    if building is not None and storeys <= MOST_ROWS:
        parts += _labels(building, levels)
    parts += _goods(building, blocks, levels)
    said = "ground" if building is None else counted(storeys, "storey")
    return svg(BUILDING_WIDTH, levels[0] + 6.0, f"{said} with {counted(len(blocks), 'block')}" if blocks else said, *parts)


def _labels(building: Building, levels: FloatArray) -> list[str]:
    """What stands beside each storey: its height and its strength over the weight."""
    parts = []
    strength = building.yield_shear / building.weight
    for storey in range(building.storeys):
        middle = 0.5 * (levels[storey] + levels[storey + 1]) + 4.0
        words = [] if building.heights is None else [f"{building.heights[storey]:.3g} m"]
        words.append("elastic" if np.isinf(strength[storey]) else f"V_y/W = {strength[storey]:.3g}")
        parts.append(text(LEFT + BAY + 32.0, middle, ", ".join(words)))
        parts.append(text(LEFT - 8.0, levels[storey + 1] + 4.0, str(storey + 1), anchor="end"))
    return parts


def _goods(building: Building | None, blocks: tuple[Block, ...], levels: FloatArray) -> list[str]:
    parts = []
    for floor in sorted({block.floor for block in blocks}):
        here = [block for block in blocks if block.floor == floor]
        above = levels[floor] - levels[floor + 1] if floor + 1 < len(levels) else 46.0
        most = min((BAY - 30.0) / len(here) - 4.0, 60.0)
        for place, block in enumerate(here):
            side = np.sqrt(min(_ratio(building, block), 3.0) / 3.0)
            width, height = max(most * side, 3.0), max(min(0.62 * above, 30.0) * side, 2.0)
            x = LEFT + BAY * (place + 1) / (len(here) + 1) - 0.5 * width
            parts.append(
                f'<rect x="{x:.1f}" y="{levels[floor] - height - 2.0:.1f}" width="{width:.1f}" height="{height:.1f}" '
                f'fill="{COLOUR}" fill-opacity="0.55" stroke="{COLOUR}"/>'
            )
    return parts


def _ratio(building: Building | None, block: Block) -> float:
    """Mass of a block over that of its floor; 1 on the ground."""
    if block.mass_ratio is not None:
        return block.mass_ratio
    if building is None or block.floor == 0 or block.mass is None:
        return 1.0
    return float(block.mass / building.mass[block.floor - 1])


def _blocks(scene: Scene) -> str:
    if not scene.blocks:
        return ""
    body = []
    for number, block in enumerate(scene.blocks[:MOST_ROWS], start=1):
        mass = f"{block.mass:g} kg" if block.mass is not None else f"{block.mass_ratio:g} of the floor's"
        friction = f"{block.mu_s:g}" if block.mu_s == block.mu_k else f"{block.mu_s:g}, kinetic {block.mu_k:g}"
        body.append((f"block {number}", str(block.floor) if block.floor else "ground", mass, friction))
    if len(scene.blocks) > MOST_ROWS:
        body.append((f"and {len(scene.blocks) - MOST_ROWS} more", "", "", ""))
    return rows(("", "floor", "mass", "friction"), body)


def _about(building: Building) -> str:
    return f"{counted(building.storeys, 'storey')}, T1 = {building.periods[0]:.4g} s"


def _facts(building: Building) -> list[tuple[str, str]]:
    found = []
    if building.mass_is_stated:
        found.append(("mass", f"{1e-3 * building.mass.sum():.4g} t"))
    for symbol, values in building.spring_summary().items():
        if not np.isinf(values).all():
            found.append((symbol, _span(values)))
    if np.isinf(building.yield_shear).all() and not building.laws:
        found = [fact for fact in found if fact[0] == "mass"] + [("springs", "elastic")]
    found += [("springs", law) for law in building.laws]
    damping = building.damping
    found.append(("damping", f"{100.0 * damping:g} %" if isinstance(damping, float) else type(damping).__name__))
    if building.gravity_load is not None or building.geometric_stiffness is not None:
        found.append(("P-Delta", "yes"))
    return found


def _span(values: FloatArray) -> str:
    """One number, or the least and the largest."""
    low, high = float(values.min()), float(values.max())
    return f"{low:.3g}" if low == high else f"{low:.3g} to {high:.3g}"
