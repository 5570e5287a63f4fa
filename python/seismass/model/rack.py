"""Racks as users meet them: a chain of levels on a floor, with goods that may slide or are fixed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Unpack

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.arguments import known_id
from seismass.base.errors import InvalidScene
from seismass.base.limits import MOST_LEVELS
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, Value, as_array, as_count, as_number, brief, frozen, refusal
from seismass.base.views import Card
from seismass.model.block import Block, Stops
from seismass.model.building import Building, kernel_springs
from seismass.model.codes import FROM_MEMORY
from seismass.model.springs import SHAPE_FIELDS, Hysteresis, SpringShape, checked_names, documented, takes_springs

DEFAULT_RACK_DAMPING: Final = 0.03
"""Damping ratio of a rack in every mode, fixed at its base, with frame and goods attached."""


class RackBlock(Value):
    """Goods on a level of a rack.

    Parameters
    ----------
    level : int
        Level, counted from 1, the lowest.
    mass, mass_ratio, mu, mu_s, mu_k, velocity, wear, stops, stops_y
        As for `Block`; `mass_ratio` is over the mass of the floor on which the rack stands.
    fixed : bool, default False
        Attached to the level for good. Friction and stops are then left out.

    Raises
    ------
    InvalidScene
        As for `Block`, or something is given that fixed goods do not have.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.RackBlock(2, mass=400.0, mu=0.37)
    RackBlock(level=2, mass=400, mu=0.37)
    """

    __slots__ = ("block", "fixed", "level")
    level: int
    fixed: bool
    block: Block
    """The goods as a block whose floor is the level."""

    def __init__(
        self,
        level: int,
        *,
        mass: float | None = None,
        mass_ratio: float | None = None,
        mu: float | None = None,
        mu_s: float | None = None,
        mu_k: float | None = None,
        velocity: float | Sequence[float] | None = None,
        wear: Sequence[tuple[float, float, float]] = (),
        stops: Stops | None = None,
        stops_y: Stops | None = None,
        fixed: bool = False,
    ) -> None:
        number = as_count(level, "level", "block of a rack", InvalidScene, least=1)
        if fixed:
            others = {"mu": mu, "mu_s": mu_s, "mu_k": mu_k, "velocity": velocity, "wear": wear or None, "stops": stops}
            others["stops_y"] = stops_y
            for name, value in others.items():
                if value is not None:
                    requirement = "left out where the goods are fixed"
                    raise refusal(InvalidScene, name, "block of a rack", requirement, brief(value))
            mu = 0.0
        block = Block(
            number,
            mass=mass,
            mass_ratio=mass_ratio,
            mu=mu,
            mu_s=mu_s,
            mu_k=mu_k,
            velocity=velocity,
            wear=wear,
            stops=stops,
            stops_y=stops_y,
        )
        self._set(level=number, fixed=bool(fixed), block=block)

    def _arguments(self) -> dict[str, Any]:
        block = self.block._arguments()
        masses = {name: block[name] for name in ("mass", "mass_ratio")}
        if self.fixed:
            return {"level": self.level, **masses, "fixed": True}
        return {"level": self.level, **{name: value for name, value in block.items() if name != "floor"}}

    def in_y(self) -> RackBlock:
        """Return what the goods are in y."""
        if self.fixed:
            return self
        return self.replace(velocity=self.block.in_y().velocity, stops=self.block.stops_y, stops_y=None)

    def __repr__(self) -> str:
        if self.fixed:
            mass = self.block.mass
            size = f"mass={mass:g}" if mass is not None else f"mass_ratio={self.block.mass_ratio:g}"
            return f"RackBlock(level={self.level}, {size}, fixed=True)"
        return repr(self.block).replace("Block(floor=", "RackBlock(level=", 1)


class Rack(Value, Card):
    """A rack: a chain of levels that stands on a floor of the building or on the ground.

    Every argument that has a value per level takes one number, which then stands for all levels, or a list with the
    lowest level first.

    Parameters
    ----------
    floor : int
        Floor that it stands on, counted from 1; 0 is the ground.
    levels : int
        Number of levels.
    level_mass : array_like, optional
        Mass of the frame at each level (kg). Either it or `level_mass_ratio` is needed.
    level_mass_ratio : array_like, optional
        The same over the mass of the floor on which it stands; not on the ground.
    period : float, optional
        First period (s) of the rack alone on rigid ground with its frame and all its goods attached, all levels equally
        stiff. Either it or `stiffness` is needed.
    stiffness : array_like, optional
        Stiffness of each level (N/m).
    yield_shear, yield_shear_over_weight : array_like, optional
        First yield shear of each level (N), or over the weight of the rack's frame and goods; elastic without either.
    hysteresis, and what shapes the springs
        As for `Building`.
    damping : float, default 0.03
        Ratio in every mode of the rack alone, fixed at its base, with frame and goods attached.
    geometric_stiffness : array_like, optional
        P/h of each level (N/m).
    blocks : iterable of RackBlock, optional
        Goods on its levels.
    other_direction : dict, optional
        Arguments of springs and damping that differ in y, in scenes in two directions.

    Raises
    ------
    InvalidScene
        Something is missing, contradicts, or is not what it must be. Ranges are judged with the scene.

    Examples
    --------
    >>> import seismass as sm
    >>> goods = [sm.RackBlock(level, mass=400.0, mu=0.37) for level in (1, 2, 3)]
    >>> sm.Rack(2, levels=3, level_mass=40.0, period=0.5, blocks=goods)
    Rack(floor=2, 3 levels, period = 0.5 s, 3 blocks)
    """

    __slots__ = (
        "blocks",
        "damping",
        "floor",
        "geometric_stiffness",
        "hysteresis",
        "level_mass",
        "level_mass_ratio",
        "levels",
        "other_direction",
        "period",
        "shape",
        "stiffness",
        "yield_shear",
        "yield_shear_over_weight",
    )
    floor: int
    levels: int
    level_mass: FloatArray | None
    level_mass_ratio: FloatArray | None
    period: float | None
    stiffness: FloatArray | None
    yield_shear: FloatArray | None
    yield_shear_over_weight: FloatArray | None
    hysteresis: Hysteresis | Sequence[Hysteresis]
    shape: dict[str, Any]
    damping: float
    geometric_stiffness: FloatArray | None
    blocks: tuple[RackBlock, ...]
    other_direction: dict[str, Any] | None

    @takes_springs(SHAPE_FIELDS)
    def __init__(
        self,
        floor: int,
        levels: int,
        *,
        level_mass: ArrayLike | None = None,
        level_mass_ratio: ArrayLike | None = None,
        period: float | None = None,
        stiffness: ArrayLike | None = None,
        yield_shear: ArrayLike | None = None,
        yield_shear_over_weight: ArrayLike | None = None,
        hysteresis: Hysteresis | Sequence[Hysteresis] = "masing",
        damping: float = DEFAULT_RACK_DAMPING,
        geometric_stiffness: ArrayLike | None = None,
        blocks: Iterable[RackBlock] = (),
        other_direction: Mapping[str, Any] | None = None,
        **shape: Unpack[SpringShape],
    ) -> None:
        parameters: dict[str, Any] = dict(shape)
        checked_names(parameters, SHAPE_FIELDS, "Rack")
        _check_choice(("level_mass", level_mass), ("level_mass_ratio", level_mass_ratio), is_needed=True)
        _check_choice(("period", period), ("stiffness", stiffness), is_needed=True)
        _check_choice(("yield_shear", yield_shear), ("yield_shear_over_weight", yield_shear_over_weight))
        count = as_count(levels, "levels", "rack", InvalidScene, least=1)
        if count > MOST_LEVELS:
            raise refusal(InvalidScene, "levels", "rack", f"at most {MOST_LEVELS}", f"{count}")

        def per_level(name: str, value: ArrayLike | None) -> FloatArray | None:
            if value is None:
                return None
            array = as_array(value, name, "rack", InvalidScene, or_number=True)
            if array.ndim and len(array) != count:
                requirement = f"one number or a list of {count} values, one per level"
                raise refusal(InvalidScene, name, "rack", requirement, f"{len(array)} values")
            return frozen(np.full(count, array)) if array.ndim == 0 else array

        goods = tuple(blocks)
        for number, block in enumerate(goods, start=1):
            if not isinstance(block, RackBlock):
                raise refusal(InvalidScene, f"block {number}", "rack", "a RackBlock", brief(block))
            if block.level > count:
                requirement = f"between 1 and {count}"
                raise refusal(InvalidScene, "level", f"block {number} of rack", requirement, str(block.level))
        over_weight = per_level("yield_shear_over_weight", yield_shear_over_weight)
        if over_weight is not None and not (over_weight > 0.0).all():
            raise refusal(InvalidScene, "yield_shear_over_weight", "rack", "positive", brief(over_weight))
        self._set(
            floor=as_count(floor, "floor", "rack", InvalidScene),
            levels=count,
            level_mass=per_level("level_mass", level_mass),
            level_mass_ratio=per_level("level_mass_ratio", level_mass_ratio),
            period=None if period is None else as_number(period, "period", "rack", InvalidScene),
            stiffness=per_level("stiffness", stiffness),
            yield_shear=per_level("yield_shear", yield_shear),
            yield_shear_over_weight=over_weight,
            hysteresis=hysteresis,
            shape={name: per_level(name, value) for name, value in parameters.items()},
            damping=as_number(damping, "damping", "rack", InvalidScene),
            geometric_stiffness=per_level("geometric_stiffness", geometric_stiffness),
            blocks=goods,
            other_direction=None,
        )
        if other_direction is not None:
            self._set(other_direction=_of_other_direction(other_direction))
            self.in_y()

    def in_y(self) -> Rack:
        """Return what the rack is in y."""
        changes: dict[str, Any] = {"blocks": [block.in_y() for block in self.blocks], "other_direction": None}
        overrides = self.other_direction or {}
        for one, other in (("period", "stiffness"), ("yield_shear", "yield_shear_over_weight")):
            changes |= {one: None} if other in overrides else {other: None} if one in overrides else {}
        return self.replace(**(changes | overrides))

    def alone(self, floor_mass: float = np.nan) -> Building:
        """Return the rack alone, fixed at its base, with its goods attached, as a building whose floors are its levels.

        Parameters
        ----------
        floor_mass : float, optional
            Mass of the floor that it stands on (kg), of which ratios are.

        Returns
        -------
        Building
            Its masses are those of frame and goods.
        """
        mass = self._frame(floor_mass)
        for block in self.blocks:
            mass[block.level - 1] += _mass(block, floor_mass)
        stiffness: Any = self.stiffness
        if self.period is not None:
            stiffness = np.full(self.levels, _kernel.Rack.uniform_stiffness(mass, self.period))
        strength: Any = np.inf if self.yield_shear is None else self.yield_shear
        if self.yield_shear_over_weight is not None:
            strength = self.yield_shear_over_weight * STANDARD_GRAVITY * mass.sum()
        return Building(
            mass, stiffness, yield_shear=strength, hysteresis=self.hysteresis, damping=self.damping, **self.shape
        )

    def of_kernel(self, number: int, building: Building | None) -> _kernel.Rack:
        """Return what the kernel takes of the rack with this number on a floor of a building."""
        floor_mass = np.nan
        stated = building is None or building.mass_is_stated or self.floor == 0
        in_kg = self.level_mass is not None or any(block.block.mass is not None for block in self.blocks)
        if not stated and in_kg:
            requirement = "given as ratios where the mass of the building is not stated"
            raise refusal(InvalidScene, "masses", f"rack {number}", requirement, "in kg")
        if building is not None and 0 < self.floor <= building.storeys:
            floor_mass = float(building.mass[self.floor - 1])
        elif self.level_mass_ratio is not None or any(block.block.mass_ratio is not None for block in self.blocks):
            requirement = "given in kg where the rack does not stand on a floor of the building"
            raise refusal(InvalidScene, "masses", f"rack {number}", requirement, "ratios")
        mass, goods = self._frame(floor_mass), []
        try:
            alone = self.alone(floor_mass)
        except InvalidScene as error:
            raise InvalidScene(_of_levels(str(error), number)) from None
        for block in self.blocks:
            if block.fixed:
                mass[block.level - 1] += _mass(block, floor_mass)
            else:
                goods.append((block.level, _mass(block, floor_mass), *block.block.contact, block.block.stop_numbers))
        return _kernel.Rack(
            self.floor,
            mass,
            *kernel_springs(alone)[0],
            **kernel_springs(alone)[1],
            damping_ratio=self.damping,
            geometric_stiffness=self.geometric_stiffness,
            blocks=goods,
        )

    def masses(self, building: Building | None) -> list[float]:
        """Return the masses of its goods in their order (kg), where the rack stands on a floor of a building."""
        floor_mass = self._floor_mass(building)
        return [_mass(block, floor_mass) for block in self.blocks]

    def sliding_masses(self, building: Building | None) -> list[float]:
        """Return the masses of the blocks that may slide (kg), where the rack stands on a floor of a building."""
        floor_mass = self._floor_mass(building)
        return [_mass(block, floor_mass) for block in self.blocks if not block.fixed]

    def goods_mass(self, building: Building | None) -> float:
        """Return the mass of all its goods, fixed ones too (kg), where it stands on a floor of a building."""
        floor_mass = self._floor_mass(building)
        return sum(_mass(block, floor_mass) for block in self.blocks)

    def frame_mass(self, building: Building | None) -> float:
        """Return the mass of its frame (kg), where it stands on a floor of a building."""
        return float(self._frame(self._floor_mass(building)).sum())

    def _floor_mass(self, building: Building | None) -> float:
        return float(building.mass[self.floor - 1]) if building is not None and self.floor else np.nan

    def _frame(self, floor_mass: float) -> FloatArray:
        """Mass of the frame at each level (kg), a new array."""
        if self.level_mass is not None:
            return self.level_mass.copy()
        ratio: Any = self.level_mass_ratio
        return np.asarray(ratio * floor_mass)

    def _arguments(self) -> dict[str, Any]:
        names = (name for name in self.__slots__ if name != "shape")
        return {**{name: getattr(self, name) for name in names}, **self.shape}

    def __repr__(self) -> str:
        levels = "1 level" if self.levels == 1 else f"{self.levels} levels"
        stiffness: Any = self.stiffness
        period = f"period = {self.period:g} s" if self.period is not None else f"k = {brief(stiffness)} N/m"
        blocks = {0: "no block", 1: "1 block"}.get(len(self.blocks), f"{len(self.blocks)} blocks")
        return f"Rack(floor={self.floor}, {levels}, {period}, {blocks})"


def _of_levels(refused: str, number: int) -> str:
    """What a building refused whose floors are the levels of the rack with this number, in words of the rack."""
    in_levels = refused.replace("storey", "level").replace(" of building must", f" of rack {number} must", 1)
    return re.sub(r" of (level \d+) must", rf" of \1 of rack {number} must", in_levels, count=1)


def _check_choice(one: tuple[str, Any], other: tuple[str, Any], *, is_needed: bool = False) -> None:
    """Refuse both of two arguments that say the same, and neither where one is needed."""
    stated = [name for name, value in (one, other) if value is not None]
    if len(stated) == 2 or (is_needed and not stated):
        requirement = f"given either as {one[0]} or as {other[0]}"
        raise refusal(InvalidScene, one[0], "rack", requirement, "both" if stated else "neither")


def _of_other_direction(changes: Mapping[str, Any]) -> dict[str, Any]:
    known = ("period", "stiffness", "yield_shear", "yield_shear_over_weight", "hysteresis", "damping", *SHAPE_FIELDS)
    if not isinstance(changes, Mapping):
        raise refusal(InvalidScene, "other_direction", "rack", "a dict of what differs in y", brief(changes))
    for key in changes:
        if key not in known:
            raise refusal(InvalidScene, f"other_direction.{key}", "rack", f"one of {', '.join(known)}", "another")
    return dict(changes)


def _mass(block: RackBlock, floor_mass: float) -> float:
    """Mass of goods (kg)."""
    if block.block.mass is not None:
        return block.block.mass
    ratio: Any = block.block.mass_ratio
    return float(ratio * floor_mass)


Rack.__doc__ = documented(Rack.__doc__, SHAPE_FIELDS)


@dataclass(frozen=True)
class RackDirection:
    """A direction of pallet racks, "down-aisle" (along the beams) or "cross-aisle" (along the braced frames), with its
    default first period, frame and goods (s), range, source and how the source was checked.
    """

    name: str
    period: float
    low: float
    high: float
    source: str
    status: str


RACK_DIRECTIONS: Final = (
    RackDirection(
        "down-aisle", 1.5, 1.0, 2.5, "unbraced frames, FEMA 460 (2005) and tests that it quotes", FROM_MEMORY
    ),
    RackDirection("cross-aisle", 0.7, 0.4, 1.0, "braced frames, FEMA 460 (2005) and tests that it quotes", FROM_MEMORY),
)
"""Periods of racks by direction. The range is wide: state the period of the racks that stand there."""


def rack_direction(name: str) -> RackDirection:
    """Return a direction of racks by its name."""
    names = tuple(each.name for each in RACK_DIRECTIONS)
    direction = known_id(name, names, "direction of racks")
    return RACK_DIRECTIONS[names.index(direction)]
