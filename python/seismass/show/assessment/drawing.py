"""The building of an assessment, drawn from its file: storeys, goods, racks, stops, walls, base, second direction."""

from __future__ import annotations

import textwrap
from itertools import pairwise
from typing import Any, Final

import numpy as np
from markupsafe import Markup, escape

from seismass.assessment.result import Assessment
from seismass.base.units import STANDARD_GRAVITY, UNITS
from seismass.base.values import FloatArray, counted
from seismass.media.roles import BARE as BARE_ROLE
from seismass.media.roles import MU, SLIDE, apart

WIDTH: Final = 340.0
LEFT: Final = 12.0
BAY: Final = 112.0
"""Left edge and width of the building (px)."""
WORDS: Final = LEFT + BAY + 14.0
"""Where words begin."""
LINE: Final = 12.5
"""Distance between lines of words (px)."""
LETTERS: Final = 36
"""Letters of a line of words."""
LEAST: Final = 90.0
MOST: Final = 420.0
"""Height of a building (px)."""
ROOM: Final = 6
"""Storeys up to which each has its stiffness and strength in the drawing, below the words of the floor above it."""


def building_drawing(result: Assessment) -> Markup:
    """Return the drawing as SVG in the colour of the text; goods are as large as their mass over that of a floor."""
    data = result.input
    storeys: list[dict[str, Any]] = data["storeys"]
    heights = np.array([1.0 if row["height"] is None else row["height"] for row in storeys])
    lines = [_words(result, row) for row in storeys]
    needed = np.array([LINE * len(one) + 6.0 for one in lines])
    tall = float(np.clip((needed * heights.sum() / heights).max(), LEAST, max(MOST, needed.sum())))
    levels = 34.0 + tall * (1.0 - np.append(0.0, np.cumsum(heights)) / heights.sum())
    parts = _ground(data, levels[0])
    for bottom, top in pairwise(levels):
        parts += [_line(x, bottom, x, top, 1.6) for x in (LEFT + 6.0, LEFT + BAY - 6.0)]
        parts.append(_line(LEFT, top, LEFT + BAY, top, min(4.0, 0.25 * (bottom - top))))
    parts += _goods(result, levels)
    if data["walls"]:
        parts.append(_box(LEFT + BAY - 24.0, levels[-1], 9.0, levels[0] - levels[-1], "currentColor", 0.35))
        middle = 0.5 * (levels[0] + levels[1])
        turned = Markup('<g transform="rotate(-90 {:.1f} {:.1f})">{}</g>')
        parts.append(turned.format(LEFT + BAY - 28.0, middle, _text(LEFT + BAY - 28.0, middle, "wall", "middle")))
    # Words of a floor begin beside it, or below those of the floor above.
    last = 0.0
    for level, of_floor in zip(levels[:0:-1], reversed(lines), strict=True):
        start = max(level + 4.0, last + LINE + 3.0)
        parts += [_text(WORDS, start + number * LINE, line) for number, line in enumerate(of_floor)]
        last = start + (len(of_floor) - 1) * LINE
    text = f"{counted(len(storeys), 'storey')}; {_goods_text(result)}{_support(data)}"
    high = max(levels[0] + (42.0 if data["base"] or data["other_direction"] else 16.0), last + 8.0)
    return Markup(
        '<svg class="adapts" viewBox="0 0 {:g} {:.0f}" width="{:g}" role="img"><title>{}</title>{}</svg>'
    ).format(WIDTH, high, WIDTH, text, Markup("").join(parts))


def _support(data: dict[str, Any]) -> str:
    parts = {"walls": data["walls"], "sliding base": data["base"], "two directions": data["other_direction"]}
    return "".join(f"; {words}" for words, there in parts.items() if there)


def _words(result: Assessment, row: dict[str, Any]) -> list[str]:
    """Number and name of a storey with its height and the weight of its floor; the goods on the floor."""
    units = result.units
    differ = len({one["height"] for one in result.input["storeys"]}) > 1
    height = f", h {units.text('height', row['height'], '.3g')}" if differ and row["height"] is not None else ""
    name = f"{row['storey']} {apart(row['name'])}".rstrip()
    weight = units.text("force", STANDARD_GRAVITY * row["mass"])
    lines = textwrap.wrap(f"{name}: W {weight}{height}", LETTERS)
    lines += textwrap.wrap(floor_words(result).get(row["storey"], ""), LETTERS)
    strength = row["yield_shear"]
    strong = "elastic" if strength is None else f"V_y {units.text('force', strength)}"
    springs = f"k {units.text('stiffness', row['stiffness'])}, {strong}"
    return [*lines, *[springs] * (len(result.storey_names) <= ROOM)]


def _ground(data: dict[str, Any], level: float) -> list[Markup]:
    """Ground; a base on rollers, in a bowl where it is a pendulum; and the axes of two directions."""
    base, other, ground = data["base"], data["other_direction"], level
    units = UNITS[data["units"]]
    parts = []
    if base is not None:
        ground = level + 13.0
        parts.append(_line(LEFT - 4.0, level + 2.0, LEFT + BAY + 4.0, level + 2.0, 4.0))
        parts += [
            Markup('<circle cx="{:.1f}" cy="{:.1f}" r="3.6" fill="none" stroke="currentColor"/>').format(x, level + 8.2)
            for x in (LEFT + 14.0, LEFT + 0.5 * BAY, LEFT + BAY - 14.0)
        ]
        pendulum = "" if base["radius"] is None else f", pendulum R {units.text('height', base['radius'])}"
        parts.append(_text(LEFT, ground + 22.0, f"base slides, {MU} {_pair(base)}{pendulum}"))
    parts.append(_line(LEFT - 10.0, ground, LEFT + BAY + 10.0, ground, 2.5))
    parts += [_line(x, ground + 5.0, x - 5.0, ground + 10.0, 1.0) for x in np.arange(LEFT - 4.0, LEFT + BAY + 12, 10.0)]
    if other is not None:
        foot = ground + 27.0
        parts += [_line(LEFT, foot, LEFT + 22.0, foot, 1.2), _text(LEFT + 25.0, foot + 4.0, "x")]
        parts += [_line(LEFT, foot, LEFT + 12.0, foot - 9.0, 1.2), _text(LEFT + 14.0, foot - 6.0, "y")]
        words = f"first period {data['period_bare']:.3g} s in x, {other['period_bare']:.3g} s in y"
        parts.append(_text(LEFT + 40.0, foot + 4.0, words))
    return parts


def _pair(one: dict[str, Any]) -> str:
    """Static and kinetic friction."""
    return f"{one['mu_s']:.3g}" + (f"/{one['mu_k']:.3g}" if one["mu_k"] != one["mu_s"] else "")


def floor_words(result: Assessment) -> dict[int, str]:
    """Return the goods of each loaded floor in words: what is present of the design live load, and what holds them."""
    rows = {row["storey"]: row for row in result.input["storeys"]}
    kinds: dict[int, list[str]] = {}
    for kind in result.input["goods"]:
        area, units = rows[kind["floor"]]["area"], result.units
        present, load = (STANDARD_GRAVITY * kind[name] / (area or 1.0) for name in ("mass", "live_load"))
        quantity = "force" if area is None else "load"
        amount = f"{units.number(quantity, present)} of {units.text(quantity, load)}"
        size = kind.get("size")
        ratio = np.inf if size is None else size["width"] / size["height"]
        how = f"b/h {ratio:.3g}" if ratio < kind["mu_s"] else f"{MU} {_pair(kind)}"
        how = "bolted" if kind["attached"] else how if kind["mass"] > 0.0 else "none present"
        rack = "" if kind["rack"] is None else f", racks of {kind['rack']['levels']} levels"
        stops = "" if kind["stops"] is None else f", stops at {units.text('slip', kind['stops']['clearance'], '.3g')}"
        stays = _staying(result, kind)
        part = f", {stays:.2f} stays" if stays > 0.0 else ""
        kinds.setdefault(kind["floor"], []).append(f"{amount}, {how}{part}{rack}{stops}")
    return {floor: "; ".join(words) for floor, words in kinds.items()}


def _staying(result: Assessment, kind: dict[str, Any]) -> float:
    """Part of goods that tip which moves with their floor, at the friction as stated."""
    rows = result.content.get("tipping") or []
    return next((one["staying"] for one in rows if (one["floor"], one["goods"]) == (kind["floor"], kind["name"])), 0.0)


def _goods_text(result: Assessment) -> str:
    words = floor_words(result)
    return "; ".join(f"floor {floor}: goods {what}" for floor, what in words.items()) or "no goods"


def _goods(result: Assessment, levels: FloatArray) -> list[Markup]:
    """Goods of each floor as boxes on the floor or on racks, grey where they move with it, between their stops."""
    data = result.input
    mass = {row["storey"]: row["mass"] for row in data["storeys"]}
    parts = []
    for floor in sorted({kind["floor"] for kind in data["goods"]}):
        kinds = [kind for kind in data["goods"] if kind["floor"] == floor and kind["mass"] > 0.0]
        above = levels[floor] - levels[floor + 1] if floor + 1 < len(levels) else 34.0
        room = BAY - (46.0 if data["walls"] else 28.0)
        for place, kind in enumerate(kinds):
            side = float(np.sqrt(min(kind["mass"] / mass[floor], 2.0) / 2.0))
            high, wide = max(0.7 * above * side, 2.0), max(room / len(kinds) * side - 5.0, 4.0)
            left = LEFT + 14.0 + room * (place + 0.5) / len(kinds) - 0.5 * wide
            count = 1 if kind["rack"] is None else int(kind["rack"]["levels"])
            stays = 1.0 if kind["attached"] else _staying(result, kind)
            pitch = high if count == 1 else 0.85 * above / count
            for level in range(count):
                foot, box = levels[floor] - 2.0 - level * pitch, min(high, 0.7 * pitch) if count > 1 else high
                parts += [_box(left, foot - box, wide, box * (1.0 - stays), SLIDE.colour)] * (stays < 1.0)
                parts += [_box(left, foot - box * stays, wide, box * stays, BARE_ROLE.colour)] * (stays > 0.0)
                parts += [_line(left - 3.0, foot, left + wide + 3.0, foot, 1.0)] * (count > 1)
            ends = (left - 3.0, left + wide + 3.0)
            if count > 1:
                parts += [_line(x, levels[floor], x, levels[floor] - 2.0 - (count - 0.2) * pitch, 1.0) for x in ends]
            if kind["stops"] is not None:
                parts += [_line(x, levels[floor], x, levels[floor] - 9.0, 3.0) for x in (ends[0] - 3.0, ends[1] + 3.0)]
    return parts


def _box(x: float, y: float, width: float, height: float, colour: str, opacity: float = 0.5) -> Markup:
    return Markup(
        '<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}" fill-opacity="{}" stroke="{}"/>'
    ).format(x, y, width, height, colour, opacity, colour)


def _line(x1: float, y1: float, x2: float, y2: float, width: float) -> Markup:
    return Markup('<path d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke="currentColor" stroke-width="{:.3g}"/>').format(
        x1, y1, x2, y2, width
    )


def _text(x: float, y: float, words: str, anchor: str = "start") -> Markup:
    return Markup('<text x="{:.1f}" y="{:.1f}" text-anchor="{}" font-size="10.5" fill="currentColor">{}</text>').format(
        x, y, anchor, escape(words)
    )
