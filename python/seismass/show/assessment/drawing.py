"""Drawing of your own building: storeys by their heights, goods on floors, loads and friction beside them."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from markupsafe import Markup, escape

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import counted
from seismass.media.isolate import apart
from seismass.media.roles import BARE as BARE_ROLE
from seismass.media.roles import MU, SLIDE
from seismass.media.style import shortened
from seismass.show.assessment.tables import AssessmentTables

WIDTH: Final = 430.0
LEFT: Final = 118.0
BAY: Final = 132.0
"""Left edge and width of the building (px)."""
LEAST_PITCH: Final = 15.0
"""Least distance between lines of words (px)."""
NAME: Final = 15
"""Characters of the name of a storey."""


def building_drawing(result: AssessmentTables) -> Markup:
    """Return the drawing as SVG in the colour of the text; goods are as large as their mass over that of a floor."""
    given = result.document["input"]
    storeys: list[dict[str, Any]] = given["storeys"]
    heights = np.array([1.0 if row["height"] is None else row["height"] for row in storeys])
    tall = float(np.clip(58.0 * len(storeys), 90.0, 330.0))
    levels = 34.0 + tall * (1.0 - np.append(0.0, np.cumsum(heights)) / heights.sum())
    every = max(1, int(np.ceil(LEAST_PITCH * len(storeys) / tall)))
    parts = [_line(LEFT - 22.0, levels[0], LEFT + BAY + 22.0, levels[0], 2.5)]
    hatching = np.arange(LEFT - 16.0, LEFT + BAY + 24.0, 10.0)
    parts += [_line(x, levels[0] + 5.0, x - 5.0, levels[0] + 10.0, 1.0) for x in hatching]
    for number, row in enumerate(storeys):
        bottom, top = levels[number], levels[number + 1]
        parts += [_line(x, bottom, x, top, 1.6) for x in (LEFT + 6.0, LEFT + BAY - 6.0)]
        parts.append(_line(LEFT, top, LEFT + BAY, top, min(4.0, 0.25 * (bottom - top))))
        if number % every:
            continue
        name = apart(shortened(row["name"], NAME))
        parts.append(_text(LEFT - 8.0, top + 4.0, f"{row['storey']} {name}".rstrip(), "end"))
        if row["height"] is not None and every == 1:
            parts.append(_text(LEFT + BAY + 10.0, 0.5 * (bottom + top) + 4.0, f"{row['height']:.3g} m", soft=True))
    parts += _goods(result, levels, every)
    if given["walls"]:
        x = LEFT + BAY - 20.0
        parts.append(
            Markup(
                '<rect x="{}" y="{:.1f}" width="7" height="{:.1f}" fill="currentColor" fill-opacity="0.35"/>'
            ).format(x, levels[-1], levels[0] - levels[-1])
        )
    said = f"{counted(len(storeys), 'storey')}; {_said(result)}"
    return Markup(
        '<svg class="adapts" viewBox="0 0 {:g} {:.0f}" width="{:g}" role="img"><title>{}</title>{}</svg>'
    ).format(WIDTH, levels[0] + 14.0, WIDTH, said, Markup("").join(parts))


def floor_words(result: AssessmentTables) -> dict[int, str]:
    """Return the goods of each loaded floor in a few words: what is present of the design live load, and friction."""
    rows = {row["storey"]: row for row in result.document["input"]["storeys"]}
    found: dict[int, list[str]] = {}
    for kind in result.document["input"]["goods"]:
        area = rows[kind["floor"]]["area"]
        present, load = (STANDARD_GRAVITY * kind[name] for name in ("mass", "live_load"))
        amount = (
            f"{1e-3 * present:.0f} of {1e-3 * load:.0f} kN"
            if area is None
            else (f"{1e-3 * present / area:.3g} of {1e-3 * load / area:.3g} kPa")
        )
        friction = f"{kind['mu_s']:.3g}" + (f"/{kind['mu_k']:.3g}" if kind["mu_k"] != kind["mu_s"] else "")
        how = "bolted" if kind["attached"] else f"{MU} {friction}" if kind["mass"] > 0.0 else "none present"
        found.setdefault(kind["floor"], []).append(f"{amount}, {how}")
    return {floor: words[0] if len(words) == 1 else f"{words[0]} +{len(words) - 1}" for floor, words in found.items()}


def _said(result: AssessmentTables) -> str:
    words = floor_words(result)
    return "; ".join(f"floor {floor}: goods {said}" for floor, said in words.items()) or "no goods"


def _goods(result: AssessmentTables, levels: np.ndarray[Any, np.dtype[np.float64]], every: int) -> list[Markup]:
    """Goods of each floor as boxes, and their words beside the floor."""
    given = result.document["input"]
    mass = {row["storey"]: row["mass"] for row in given["storeys"]}
    parts = []
    for floor in sorted({kind["floor"] for kind in given["goods"]}):
        kinds = [kind for kind in given["goods"] if kind["floor"] == floor and kind["mass"] > 0.0]
        above = levels[floor] - levels[floor + 1] if floor + 1 < len(levels) else 34.0
        room = BAY - 34.0
        for place, kind in enumerate(kinds):
            side = float(np.sqrt(min(kind["mass"] / mass[floor], 2.0) / 2.0))
            high, wide = max(0.7 * above * side, 2.0), max(room / len(kinds) * side - 5.0, 4.0)
            middle = LEFT + 17.0 + room * (place + 0.5) / len(kinds)
            role = BARE_ROLE if kind["attached"] else SLIDE
            parts.append(
                Markup(
                    '<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}" fill-opacity="0.5" '
                    'stroke="{}"/>'
                ).format(middle - 0.5 * wide, levels[floor] - high - 2.0, wide, high, role.colour, role.colour)
            )
    for floor, said in floor_words(result).items():
        if (floor - 1) % every == 0:
            parts.append(_text(LEFT + BAY + 10.0, levels[floor] + 4.0, said))
    return parts


def _line(x1: float, y1: float, x2: float, y2: float, width: float) -> Markup:
    return Markup('<path d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke="currentColor" stroke-width="{:.3g}"/>').format(
        x1, y1, x2, y2, width
    )


def _text(x: float, y: float, said: str, anchor: str = "start", *, soft: bool = False) -> Markup:
    return Markup(
        '<text x="{:.1f}" y="{:.1f}" text-anchor="{}" font-size="11.5" fill="currentColor"{}>{}</text>'
    ).format(x, y, anchor, Markup(' fill-opacity="0.75"') if soft else "", escape(said))
