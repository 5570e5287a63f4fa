"""Goods on a floor from above: their paths at scale between edges and aisles, and the orbit of the floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_positive, brief, refusal
from seismass.media.roles import GREY, INK, KINDS, PAPER, SLIDE, YIELDS
from seismass.media.style import drawing, grid_lines
from seismass.runs.plane import PlaneResponse

OWNER: Final = "floor plan"
PALLET: Final = (1.2, 0.8)
"""Sides (m) of goods whose footprint is not given: a pallet of ISO 6780."""
GAP: Final = 0.6
"""Distance (m) between goods, and from goods to the edge, where no places are given."""

Box = tuple[float, float, float, float]
"""Left, lower, right and upper end (m)."""


@dataclass(frozen=True)
class Footprint:
    """Where goods stand on a floor before the motion, and how large they are.

    Attributes
    ----------
    x, y : float
        Their centre (m).
    width, depth : float
        Sides along x and along y (m).
    """

    x: float
    y: float
    width: float = PALLET[0]
    depth: float = PALLET[1]

    def __post_init__(self) -> None:
        for name in ("width", "depth"):
            object.__setattr__(self, name, as_positive(getattr(self, name), name, "footprint", InvalidOption))

    def moved(self, shift: FloatArray) -> Box:
        """Return its ends after a slip (m)."""
        x, y = self.x + float(shift[0]), self.y + float(shift[1])
        return (x - 0.5 * self.width, y - 0.5 * self.depth, x + 0.5 * self.width, y + 0.5 * self.depth)


@dataclass(frozen=True)
class FloorPlan:
    """A floor from above.

    Attributes
    ----------
    edges : tuple of float
        Left, lower, right and upper end of the floor (m): edges over which goods fall, or walls.
    goods : dict of int to Footprint
        Goods on it, by the number of their block.
    aisles : tuple of tuple of float
        Ways that must stay free, as `edges`.
    """

    edges: Box
    goods: Mapping[int, Footprint]
    aisles: tuple[Box, ...] = field(default=())

    @classmethod
    def in_a_row(cls, blocks: Sequence[int]) -> FloorPlan:
        """Return pallets in a row along x, 0.6 m apart and from the edges, with an aisle of 1.2 m along them."""
        step = PALLET[0] + GAP
        goods = {number: Footprint(step * place, 0.0) for place, number in enumerate(blocks)}
        left, right = -0.5 * PALLET[0] - GAP, step * (len(blocks) - 1) + 0.5 * PALLET[0] + GAP
        lower, upper = -0.5 * PALLET[1] - GAP, 0.5 * PALLET[1] + GAP
        return cls((left, lower - 1.2, right, upper), goods, ((left, lower - 1.2, right, lower),))


@drawing()
def floor_paths(
    response: PlaneResponse,
    *,
    floor: int = 1,
    plan: FloorPlan | None = None,
    ax: Sequence[Axes] | None = None,
) -> Figure:
    """Draw the paths of goods on a floor at scale, between its edges and aisles, and the orbit of the floor.

    Parameters
    ----------
    response : PlaneResponse
        A run with histories.
    floor : int, default 1
        Number of the floor; 0 is the ground.
    plan : FloorPlan, optional
        Edges, footprints and aisles; by default pallets in a row.
    ax : sequence of two Axes, optional
        For the floor and for its orbit; by default a new figure.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no histories, the floor has no goods, or the plan has goods that are not on it.
    """
    if not isinstance(response, PlaneResponse):
        raise refusal(InvalidOption, "response", OWNER, "a PlaneResponse", brief(response))
    standing = [number for number, place in enumerate(response.scene.block_floor, start=1) if place == floor]
    if not standing:
        raise refusal(InvalidOption, "floor", OWNER, "one with goods on it", brief(floor))
    floor_plan = FloorPlan.in_a_row(standing) if plan is None else plan
    strange = sorted(set(floor_plan.goods) - set(standing))
    if strange:
        raise refusal(InvalidOption, "goods", OWNER, f"blocks of floor {floor}", f"block {strange[0]}")
    if ax is None:
        figure = Figure(figsize=(9.0, 4.4), layout="constrained")
        places = list(figure.subplots(1, 2, width_ratios=(2.1, 1.0)))
    else:
        places = list(ax)
        if len(places) != 2:
            raise refusal(InvalidOption, "ax", OWNER, "two Axes", str(len(places)))
        figure = places[0].get_figure(root=True) or Figure()
    reached = _floor(places[0], response, floor_plan)
    places[0].set_title("the ground from above" if floor == 0 else f"floor {floor} from above, at scale")
    _orbit(places[1], response, floor)
    if ax is None:
        figure.legend(handles=_handles(reached), loc="outside upper center", ncols=5, frameon=False)
    return figure


def _floor(axes: Axes, response: PlaneResponse, plan: FloorPlan) -> bool:
    """Edges, aisles and goods; whether any go beyond an edge or into an aisle."""
    left, lower, right, upper = plan.edges
    axes.add_patch(Rectangle((left, lower), right - left, upper - lower, fill=False, edgecolor=INK, linewidth=2.0))
    for aisle in plan.aisles:
        axes.add_patch(_rectangle(aisle, facecolor=KINDS[1], alpha=0.18, linewidth=0.0))
        middle = (0.5 * (aisle[0] + aisle[2]), 0.5 * (aisle[1] + aisle[3]))
        axes.annotate("aisle", middle, ha="center", va="center", fontsize=8.0)
    passes = False
    for number, place in plan.goods.items():
        slip = response.slip[:, number - 1]
        slip = slip[np.isfinite(slip).all(axis=1)]
        boxes = np.array([place.moved(each) for each in slip])
        passed = _passed(boxes, plan)
        passes |= passed
        axes.add_patch(_rectangle(place.moved(np.zeros(2)), fill=False, edgecolor=GREY, linestyle="--", linewidth=1.0))
        axes.add_patch(_rectangle(place.moved(slip[-1]), fc=SLIDE.colour, alpha=0.18, ec=SLIDE.colour, lw=1.2))
        swept = (*boxes[:, :2].min(axis=0), *boxes[:, 2:].max(axis=0))
        edge = YIELDS.colour if passed else SLIDE.colour
        axes.add_patch(_rectangle(swept, fill=False, edgecolor=edge, linestyle=":", linewidth=1.0))
        axes.plot(place.x + slip[:, 0], place.y + slip[:, 1], color=SLIDE.colour, linewidth=1.0)
        farthest = slip[int(np.argmax(np.hypot(*slip.T)))]
        axes.plot(*(np.array([place.x, place.y]) + farthest), marker="o", markersize=4.0, color=edge)
        length, path = response.peak_slip[number - 1, 2], response.slip_path[number - 1]
        axes.annotate(
            f"block {number}\n{1e3 * length:.0f} mm, path {path:.2f} m",
            (place.x, swept[3]),
            xytext=(0.0, 3.0),
            textcoords="offset points",
            ha="center",
            fontsize=7.5,
            bbox={"facecolor": PAPER, "alpha": 0.75, "linewidth": 0.0, "pad": 1.0},
        )
    axes.set_aspect("equal")
    margin = 0.25
    axes.set_xlim(left - margin, right + margin)
    axes.set_ylim(lower - margin, upper + margin)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    return passes


def _passed(boxes: FloatArray, plan: FloorPlan) -> bool:
    """Whether goods go beyond an edge, or into an aisle they do not stand in."""
    left, lower, right, upper = plan.edges
    past_edge = (boxes[:, 0] < left) | (boxes[:, 1] < lower) | (boxes[:, 2] > right) | (boxes[:, 3] > upper)
    for x0, y0, x1, y1 in plan.aisles:
        past_edge |= (boxes[:, 0] < x1) & (boxes[:, 2] > x0) & (boxes[:, 1] < y1) & (boxes[:, 3] > y0)
    return bool(past_edge.any())


def _orbit(axes: Axes, response: PlaneResponse, floor: int) -> None:
    """Displacement of the floor over the ground, in x and in y at one scale."""
    drift = response.drift
    moved = 1e3 * drift[:, :floor].sum(axis=1) if floor else np.zeros((len(drift), 2))
    moved = moved[np.isfinite(moved).all(axis=1)]
    axes.plot(moved[:, 0], moved[:, 1], color=INK, linewidth=0.9)
    axes.plot(*moved[0], marker="s", markersize=4.0, color=GREY)
    axes.plot(*moved[-1], marker="o", markersize=4.0, color=SLIDE.colour)
    largest = 1.08 * max(float(np.abs(moved).max()), 1e-3)
    axes.set_xlim(-largest, largest)
    axes.set_ylim(-largest, largest)
    axes.set_aspect("equal")
    axes.set_title("orbit of the floor over the ground" if floor else "the ground itself")
    axes.set_xlabel("x (mm)")
    axes.set_ylabel("y (mm)")
    grid_lines(axes)


def _rectangle(box: Any, **look: Any) -> Rectangle:
    left, lower, right, upper = box
    return Rectangle((left, lower), right - left, upper - lower, **look)


def _handles(passes: bool) -> list[Any]:
    handles: list[Any] = [
        Rectangle((0, 0), 1, 1, fill=False, edgecolor=GREY, linestyle="--", label="goods before"),
        Rectangle((0, 0), 1, 1, facecolor=SLIDE.colour, alpha=0.3, edgecolor=SLIDE.colour, label="and after"),
        Line2D([], [], color=SLIDE.colour, linewidth=1.0, marker="o", markersize=4.0, label="path, farthest point"),
        Rectangle((0, 0), 1, 1, fill=False, edgecolor=SLIDE.colour, linestyle=":", label="room they take"),
    ]
    if passes:
        handles[-1].set(edgecolor=YIELDS.colour, label="room they take (magenta: beyond an edge or in an aisle)")
    return handles
