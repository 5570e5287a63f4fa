"""How far a block may slide to either side, its slip by side, and the share of motions under which it goes further."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Real
from typing import Any, Final, Literal

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import (
    FloatArray,
    as_array,
    as_count,
    as_list,
    as_number,
    as_one_of,
    as_positive,
    brief,
    refusal,
)
from seismass.model.rack import Rack, RackBlock
from seismass.model.scene import Scene
from seismass.runs.response import Response

OWNER: Final = "clearance"
SIDES: Final = {"plus": "+", "minus": "-", "plus_y": "+y", "minus_y": "-y", "reach": "reach"}
"""Distances of a clearance, and what tables call their sides; "+" and "-" are of x."""


@dataclass(frozen=True)
class Clearance:
    """How far a block may slide in the positive and in the negative direction, and in two directions to four sides.

    Attributes
    ----------
    plus, minus : float or None
        Distance (m) to a wall or a neighbour, or from the block's centre of gravity to the edge over which it falls,
        in the direction in which displacements are positive and in the other; None: no limit there.
    plus_y, minus_y : float or None
        The same in y, of scenes in two directions.
    reach : float or None
        Distance (m) in any direction, of scenes in two directions: that of the length of the slip.

    Raises
    ------
    InvalidOption
        A distance is not positive, or none is given.

    Notes
    -----
    The kernel has no walls and no edges. Slip up to the first time that a clearance is reached is that of the model;
    what happens after an impact or a fall is not.
    """

    plus: float | None = None
    minus: float | None = None
    plus_y: float | None = None
    minus_y: float | None = None
    reach: float | None = None

    def __post_init__(self) -> None:
        if all(getattr(self, name) is None for name in SIDES):
            raise refusal(InvalidOption, "plus", OWNER, "given, or minus", "neither")
        for name in SIDES:
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, as_positive(value, name, OWNER, InvalidOption))

    @property
    def smallest(self) -> float:
        """The smaller of the distances (m): the limit of an absolute slip."""
        return min(value for value in self.distances if value is not None)

    @property
    def distances(self) -> tuple[float | None, ...]:
        """The distances (m): plus, minus, plus_y, minus_y, reach."""
        return tuple(getattr(self, name) for name in SIDES)

    @property
    def of_plane(self) -> bool:
        """Whether a distance is given that only two directions give a meaning."""
        return any(value is not None for value in self.distances[2:])

    @property
    def one_sided(self) -> bool:
        """Whether the two sides differ, so that an absolute slip is not enough to judge."""
        return self.plus != self.minus


def as_clearances(clearance: Any, blocks: int, *, plane: bool = False) -> tuple[Clearance | None, ...]:
    """Return one clearance per block: a distance (all sides, with `plane` those of y too) or a Clearance for all, or a
    list with None for none.
    """
    listed = _clearances(clearance, blocks, 4 if plane else 2)
    for number, each in enumerate(listed, start=1):
        if not plane and each is not None and each.of_plane:
            requirement = "of plus and minus alone where there is one direction"
            raise refusal(InvalidOption, f"clearance of block {number}", "slip demand", requirement, brief(each))
    return listed


def _clearances(clearance: Any, blocks: int, sides: int) -> tuple[Clearance | None, ...]:
    if clearance is None or _single(clearance):
        return (_clearance(clearance, sides),) * blocks
    requirement = f"a distance in m, a Clearance, or a list of {blocks}, one per block or None"
    listed = as_list(clearance, "clearance", "slip demand", InvalidOption, requirement)
    if len(listed) != blocks or not all(each is None or _single(each) for each in listed):
        raise refusal(InvalidOption, "clearance", "slip demand", requirement, brief(clearance))
    return tuple(_clearance(each, sides) for each in listed)


def _single(value: Any) -> bool:
    return isinstance(value, Clearance) or (isinstance(value, Real) and not isinstance(value, bool))


def _clearance(value: Any, sides: int) -> Clearance | None:
    return value if value is None or isinstance(value, Clearance) else Clearance(*[value] * sides)


def signed_peaks(slip: FloatArray, rate: FloatArray, dt: float, peak: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the largest slip of each block in the positive and in the negative direction (m), both zero or positive.

    Parameters
    ----------
    slip, rate : ndarray, shape (samples, blocks)
        Slip (m) and its velocity (m/s) at every sample; NaN after a collapse.
    dt : float
        Time step (s).
    peak : ndarray, shape (blocks,)
        Largest absolute slip in continuous time (m).

    Notes
    -----
    `peak` is exact and belongs to the side that goes further. The other side is taken from the samples and from the
    cubic through slip and velocity at the ends of each step; only where the block reverses within a step is that not
    exact, by less than 0.02 dt^2 times the jump of the relative acceleration.
    """
    slip, rate = (
        as_array(values, name, "signed peaks", InvalidOption, dimensions=2)
        for values, name in ((slip, "slip"), (rate, "rate"))
    )
    dt, peak = as_number(dt, "dt", "signed peaks", InvalidOption), as_array(peak, "peak", "signed peaks", InvalidOption)
    if slip.shape != rate.shape or len(peak) != slip.shape[1]:
        raise refusal(InvalidOption, "rate", "signed peaks", f"a table as slip, {slip.shape}", f"{rate.shape}")
    start, end = slip[:-1], slip[1:]
    first, last = dt * rate[:-1], dt * rate[1:]
    moved = end - start
    square, cube = 3.0 * moved - 2.0 * first - last, first + last - 2.0 * moved
    # The cubic start + first s + square s^2 + cube s^3 turns where first + 2 square s + 3 cube s^2 = 0.
    with np.errstate(invalid="ignore", divide="ignore"):
        root = np.sqrt(square * square - 3.0 * cube * first)
        w = -(square + np.copysign(root, square))
        turns = [slip]
        for s in (w / (3.0 * cube), first / w):
            inside = (s > 0.0) & (s < 1.0)
            turns.append(np.where(inside, start + s * (first + s * (square + s * cube)), start))
    values = np.concatenate(turns)
    plus = np.nanmax(values, axis=0, initial=0.0)
    minus = np.nanmax(-values, axis=0, initial=0.0)
    further = plus >= minus
    return np.where(further, peak, np.minimum(plus, peak)), np.where(further, np.minimum(minus, peak), peak)


def exceedance_table(
    plus: FloatArray,
    minus: FloatArray,
    clearances: tuple[Clearance | None, ...],
    confidence: float,
    plane: tuple[FloatArray, FloatArray, FloatArray] | None = None,
) -> pl.DataFrame:
    """Return how many motions bring each block to its clearance, by side and on any side.

    Parameters
    ----------
    plus, minus : ndarray, shape (motions, blocks)
        Largest slip to each side (m); infinite in a run that collapsed.
    clearances : tuple of Clearance or None
        One per block.
    confidence : float
        Probability of the interval.
    plane : tuple of ndarray, optional
        In two directions, the same to each side of y, and the largest length of the slip vector.

    Returns
    -------
    polars.DataFrame
        block, side ("+", "-", "+y", "-y", "reach", "any"), clearance (m; of "any" the smaller), motions, exceeding,
        probability, low, high. The interval is that of Wilson (1927), J. Am. Stat. Assoc. 22:209-212, for independent
        motions.
    """
    owner, rows = "exceedances", []
    in_plane = [] if plane is None else as_list(plane, "plane", owner, InvalidOption, "three tables")
    for values, name in ((plus, "plus"), (minus, "minus"), *((each, "plane") for each in in_plane)):
        as_array(values, name, owner, InvalidOption, dimensions=2)
    as_number(confidence, "confidence", owner, InvalidOption)
    for number, clearance in enumerate(as_list(clearances, "clearances", owner, InvalidOption, "Clearances or None")):
        if clearance is None:
            continue
        as_one_of(clearance, Clearance, "clearance", owner, InvalidOption)
        limits = {**dict(zip(SIDES.values(), clearance.distances, strict=True)), "any": clearance.smallest}
        exceeded = {
            side: values[:, number] > limit
            for side, values in zip(SIDES.values(), (plus, minus, *(plane or ())), strict=False)
            if (limit := limits[side]) is not None
        }
        exceeded["any"] = np.logical_or.reduce(list(exceeded.values()))
        for side, each in exceeded.items():
            count = int(each.sum())
            low, high = wilson_interval(count, len(each), confidence)
            rows.append(
                {
                    "block": number + 1,
                    "side": side,
                    "clearance": limits[side],
                    "motions": len(each),
                    "exceeding": count,
                    "probability": count / len(each),
                    "low": low,
                    "high": high,
                }
            )
    schema = {
        "block": pl.UInt32,
        "side": pl.String,
        "clearance": pl.Float64,
        "motions": pl.UInt32,
        "exceeding": pl.UInt32,
        "probability": pl.Float64,
        "low": pl.Float64,
        "high": pl.Float64,
    }
    return pl.DataFrame(rows, schema=schema)


def wilson_interval(count: int, total: int, confidence: float) -> tuple[float, float]:
    """Return the interval of Wilson (1927) of a probability of which `count` of `total` trials are known.

    Examples
    --------
    >>> from seismass.studies.slip import wilson_interval
    >>> [round(end, 3) for end in wilson_interval(1, 10, 0.95)]
    [0.018, 0.404]
    """
    from scipy.stats import binomtest  # slow to import

    owner = "Wilson's interval"
    trials = as_count(total, "total", owner, InvalidOption, least=1)
    known, share = (
        as_count(count, "count", owner, InvalidOption),
        as_number(confidence, "confidence", owner, InvalidOption),
    )
    if not (known <= trials and 0.0 <= share <= 1.0):
        raise refusal(
            InvalidOption, "count", owner, f"at most {trials}, and confidence from 0 to 1", f"{known}, {share:g}"
        )
    interval = binomtest(known, trials).proportion_ci(share, method="wilson")
    return float(interval.low), float(interval.high)


@dataclass(frozen=True, slots=True)
class Place:
    """Where a block stands: floor (0 is the ground; of a rack that under it), rack and level (from 1; 0: on the floor
    itself), and index `node` among the ground, the floors and the levels of all racks.
    """

    floor: int
    rack: int
    level: int
    node: int

    @property
    def columns(self) -> dict[str, int]:
        """The columns of tables of scenes with racks: floor, rack and level."""
        return {"floor": self.floor, "rack": self.rack, "level": self.level}


def places_of(scene: Scene) -> tuple[Place, ...]:
    """Return the place of each of `Scene.goods`."""
    places = [Place(floor, 0, 0, floor) for floor in scene.block_floor]
    first = scene.storeys
    for number, rack in enumerate(scene.racks, start=1):
        levels = (block.level for block in rack.blocks if not block.fixed)
        places += [Place(rack.floor, number, level, first + level) for level in levels]
        first += rack.levels
    return tuple(places)


def place_names(scene: Scene) -> tuple[str, ...]:
    """Return the columns that tell places apart: the floor, and with racks rack and level (0: on the floor itself)."""
    return ("floor", "rack", "level") if scene.racks else ("floor",)


def place_columns(scene: Scene, times: int) -> dict[str, Any]:
    """Return the columns of places of all goods, so many times over."""
    places = places_of(scene)
    return {
        name: pl.Series(np.tile([getattr(place, name) for place in places], times), dtype=pl.UInt32)
        for name in place_names(scene)
    }


def accelerations_at_nodes(response: Response, ground: float) -> FloatArray:
    """Return peak accelerations of the ground, or the slab of a sliding base, of floors and of rack levels (m/s2)."""
    first = ground if response.scene.base is None else response.peak_base_acceleration
    return np.concatenate([[first], response.peak_floor_acceleration, *response.peak_rack_acceleration])


def histories_at_nodes(response: Response, what: Literal["velocity", "acceleration"], ground: FloatArray) -> FloatArray:
    """Return histories of the ground, or the slab of a sliding base, of floors and of levels, shape (rows, nodes)."""
    first = ground if response.scene.base is None else getattr(response, f"base_{what}")
    return np.column_stack([first, getattr(response, f"floor_{what}"), *getattr(response, f"rack_{what}")])


def without_loose_goods(scene: Scene, *, attached: bool) -> Scene:
    """Return building, racks and base without loose goods, or with all attached for good, those on a slab to the slab.
    Springs of racks stay the same; their damping is the ratio in their modes with what is attached.
    """
    if scene.other_direction is not False:
        x, y = (without_loose_goods(each, attached=attached) for each in scene._directions())
        of_both = zip(x.racks, y.racks, scene.racks, strict=True)
        return Scene(
            x.building,
            racks=[_with_springs_in_y(*each) for each in of_both],
            other_direction=True if y.building is None else y.building,
            initial_drift=scene.initial_drift,
            initial_velocity=scene.initial_velocity,
            collapse_drift=scene.collapse_drift,
            name=scene.name,
        )
    building, base = scene.building, scene.base
    scale = np.ones(scene.storeys + 1)
    on_floors = np.zeros(scene.storeys + 1)
    if attached:
        np.add.at(on_floors, list(scene.block_floor), scene.block_mass)
        on_floors[1:] += 0.0 if scene.fixed_goods is None else scene.fixed_goods
    slab = 0.0 if base is None else base.slab_mass(building) + float(on_floors[0])
    if building is not None:
        mass = building.mass + on_floors[1:]
        base = None if base is None else base.replace(mass=None, mass_ratio=slab / float(mass[0]))
        # Masses that are given over that of their floor stay what they are.
        scale[1:] = building.mass / mass
        changes: dict[str, Any] = {"mass": mass, "damping": building.damping_matrix}
        if scene.geometric_stiffness.any():
            changes |= {"gravity_load": None, "geometric_stiffness": scene.geometric_stiffness}
        racks = [_emptied(rack, building.mass, float(scale[rack.floor]), attached=attached) for rack in scene.racks]
        building = building.replace(**changes)
    else:
        base = None if base is None else base.replace(mass=slab)
        racks = [_emptied(rack, np.empty(0), 1.0, attached=attached) for rack in scene.racks]
    return Scene(
        building,
        racks=racks,
        base=base,
        initial_drift=scene.initial_drift,
        initial_velocity=scene.initial_velocity,
        collapse_drift=scene.collapse_drift,
        name=scene.name,
    )


def _with_springs_in_y(rack: Rack, in_y: Rack, stated: Rack) -> Rack:
    """A rack with the springs of another in y; what else differs there stays as it was given."""
    other = {key: value for key, value in (stated.other_direction or {}).items() if key not in _MADE_ANEW}
    other["stiffness"] = in_y.stiffness
    if in_y.yield_shear is not None:
        other["yield_shear"] = in_y.yield_shear
    return rack.replace(other_direction=other)


_MADE_ANEW: Final = ("period", "stiffness", "yield_shear", "yield_shear_over_weight")
"""What a rack without goods has as numbers of its own."""


def _emptied(rack: Rack, floor_masses: FloatArray, scale: float, *, attached: bool) -> Rack:
    """Return a rack with its loose goods removed or fixed, and ratios of masses times `scale`; springs as they are."""
    alone = rack.alone(float(floor_masses[rack.floor - 1]) if rack.floor else np.nan)
    blocks = []
    for each in rack.blocks:
        if each.fixed or attached:
            mass, ratio = each.block.mass, each.block.mass_ratio
            scaled = None if ratio is None else scale * ratio
            blocks.append(RackBlock(each.level, mass=mass, mass_ratio=scaled, fixed=True))
    changes: dict[str, Any] = {"period": None, "stiffness": alone.stiffness, "blocks": blocks}
    if rack.level_mass_ratio is not None:
        changes["level_mass_ratio"] = scale * rack.level_mass_ratio
    if rack.yield_shear_over_weight is not None:
        changes |= {"yield_shear_over_weight": None, "yield_shear": alone.yield_shear}
    return rack.replace(**changes)
