"""Blocks on floors, and the stops that hold them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidScene
from seismass.base.values import FloatArray, Value, as_array, as_count, as_number, brief, frozen, is_list, refusal
from seismass.base.views import Card
from seismass.model.building import Building


class Stops(Value):
    """Stops on either side of a block, fixed to what carries it: rails, walls of a bay, edges of a pallet place.

    Parameters
    ----------
    clearance : float or pair of float
        Slip (m) at which a stop touches, from the block's first place: one number for both sides, or towards minus and
        towards plus; infinite: no stop on that side.
    stiffness : float
        Stiffness k of the contact (N/m).
    damping : float, default 0.0
        Viscous damper c of the contact (N s/m).

    Raises
    ------
    InvalidScene
        A value is not a number. Ranges are judged with the scene.

    Notes
    -----
    The contact force is k e + c e' for a penetration e > 0 while that is not negative: a contact does not pull. Touch
    and leave are events (`touch_stop`, `leave_stop`).

    Examples
    --------
    >>> import seismass as sm
    >>> sm.Block(2, mass_ratio=0.5, mu=0.1, stops=sm.Stops(0.05, stiffness=2e6))
    Block(floor=2, mass_ratio=0.5, mu=0.1, stops=Stops(clearance=0.05, stiffness=2e+06))
    """

    __slots__ = ("clearance", "damping", "stiffness")
    clearance: tuple[float, float]
    stiffness: float
    damping: float

    def __init__(self, clearance: float | Sequence[float], stiffness: float, damping: float = 0.0) -> None:
        sides: Any = clearance
        if not is_list(sides):
            sides = (clearance, clearance)
        if len(sides) != 2:
            requirement = "one number, or two: towards minus and towards plus"
            raise refusal(InvalidScene, "clearance", "stops", requirement, brief(clearance))
        minus, plus = (as_number(side, "clearance", "stops", InvalidScene) for side in sides)
        self._set(
            clearance=(minus, plus),
            stiffness=as_number(stiffness, "stiffness", "stops", InvalidScene),
            damping=as_number(damping, "damping", "stops", InvalidScene),
        )

    @property
    def numbers(self) -> tuple[float, float, float, float]:
        """What the kernel takes: clearances towards minus and plus (m), stiffness (N/m), damper (N s/m)."""
        return (*self.clearance, self.stiffness, self.damping)

    def _arguments(self) -> dict[str, Any]:
        return {"clearance": self.clearance, "stiffness": self.stiffness, "damping": self.damping}

    def __repr__(self) -> str:
        minus, plus = self.clearance
        clearance = f"{plus:g}" if minus == plus else f"({minus:g}, {plus:g})"
        damping = f", damping={self.damping:g}" if self.damping else ""
        return f"Stops(clearance={clearance}, stiffness={self.stiffness:g}{damping})"


class Block(Value):
    """A rigid block that sticks to its floor or slides on it by Coulomb friction.

    Parameters
    ----------
    floor : int
        Floor that carries it, counted from 1; 0 is the ground slab, whose blocks do not load the building.
    mass : float, optional
        Mass (kg). Either it or `mass_ratio` is needed; on a floor of a building whose mass is not stated, the latter.
    mass_ratio : float, optional
        Mass over that of the floor (alpha of the paper); not on the ground.
    mu : float, optional
        Friction coefficient, static and kinetic. Either it or `mu_s` is needed.
    mu_s, mu_k : float, optional
        Static and kinetic coefficients, mu_s >= mu_k >= 0; mu_k is mu_s by default.
    velocity : float or pair of float, optional
        Initial velocity relative to the ground (m/s); by default that of its floor. In two directions a pair.
    wear : list of (path, mu_s, mu_k), optional
        Coefficients that hold from a path slipped (m) on, in order of the path; those above hold until the first.
    stops : Stops, optional
        What limits its slip. Scenes with stops are solved by the general engine: `simulate` takes them. In two
        directions they stand across x.
    stops_y : Stops, optional
        Stops across y, in scenes in two directions.

    Raises
    ------
    InvalidScene
        Something is missing, contradicts, or is not a number. Ranges are judged with the scene.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.Block(1, mass_ratio=0.5, mu=0.3)
    Block(floor=1, mass_ratio=0.5, mu=0.3)
    """

    __slots__ = ("floor", "mass", "mass_ratio", "mu_k", "mu_s", "stops", "stops_y", "velocity", "wear")
    floor: int
    mass: float | None
    mass_ratio: float | None
    mu_s: float
    mu_k: float
    velocity: float | tuple[float, float] | None
    wear: tuple[tuple[float, float, float], ...]
    stops: Stops | None
    stops_y: Stops | None

    def __init__(
        self,
        floor: int,
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
    ) -> None:
        for key, value in (("stops", stops), ("stops_y", stops_y)):
            if value is not None and not isinstance(value, Stops):
                raise refusal(InvalidScene, key, "block", "Stops or None", brief(value))

        def number(name: str, value: float | None) -> float | None:
            return None if value is None else as_number(value, name, "block", InvalidScene)

        if (mass is None) == (mass_ratio is None):
            got = "neither" if mass is None else "both"
            raise refusal(InvalidScene, "mass", "block", "given either as mass or as mass_ratio", got)
        if mu is not None and (mu_s is not None or mu_k is not None):
            raise refusal(InvalidScene, "mu", "block", "left out where mu_s or mu_k is given", brief(mu))
        static = mu if mu_s is None else mu_s
        if static is None:
            raise refusal(InvalidScene, "mu", "block", "given, or mu_s", "neither")
        self._set(
            floor=as_count(floor, "floor", "block", InvalidScene),
            mass=number("mass", mass),
            mass_ratio=number("mass_ratio", mass_ratio),
            mu_s=number("mu" if mu_s is None else "mu_s", static),
            mu_k=number("mu_k", static if mu_k is None else mu_k),
            velocity=_velocity(velocity),
            wear=_stages(wear),
            stops=stops,
            stops_y=stops_y,
        )

    @property
    def contact(self) -> tuple[float, float, float | None, list[tuple[float, float, float]]]:
        """What the kernel takes beside floor and mass: mu_s, mu_k, velocity (in x), and the stages of wear."""
        velocity = self.velocity[0] if isinstance(self.velocity, tuple) else self.velocity
        return self.mu_s, self.mu_k, velocity, list(self.wear)

    @property
    def stop_numbers(self) -> tuple[float, float, float, float] | None:
        """What the kernel takes of the stops; None without."""
        return None if self.stops is None else self.stops.numbers

    def in_y(self) -> Block:
        """Return what the block is in y: with the second velocity of a pair, and the stops across y."""
        velocity = self.velocity[1] if isinstance(self.velocity, tuple) else None
        return self.replace(velocity=velocity, stops=self.stops_y, stops_y=None)

    @property
    def of_plane(self) -> str | None:
        """Name of what it has that only two directions give a meaning; None: nothing."""
        if self.stops_y is not None:
            return "stops_y"
        return "velocity" if isinstance(self.velocity, tuple) else None

    def _arguments(self) -> dict[str, Any]:
        return {
            "floor": self.floor,
            "mass": self.mass,
            "mass_ratio": self.mass_ratio,
            "mu_s": self.mu_s,
            "mu_k": self.mu_k,
            "velocity": self.velocity,
            "wear": self.wear,
            "stops": self.stops,
            "stops_y": self.stops_y,
        }

    def __repr__(self) -> str:
        mass = f"mass={self.mass:g}" if self.mass is not None else f"mass_ratio={self.mass_ratio:g}"
        equal = self.mu_s == self.mu_k
        friction = f"mu={self.mu_s:g}" if equal else f"mu_s={self.mu_s:g}, mu_k={self.mu_k:g}"
        pair = self.velocity if isinstance(self.velocity, tuple) else (self.velocity,)
        shown = ", ".join(f"{each:g}" for each in pair if each is not None)
        velocity = "" if self.velocity is None else f", velocity=({shown})" if len(pair) == 2 else f", velocity={shown}"
        wear = f", wear={list(self.wear)}" if self.wear else ""
        stops = "" if self.stops is None else f", stops={self.stops}"
        stops += "" if self.stops_y is None else f", stops_y={self.stops_y}"
        return f"Block(floor={self.floor}, {mass}, {friction}{velocity}{wear}{stops})"


def _velocity(velocity: float | Sequence[float] | None) -> float | tuple[float, float] | None:
    if velocity is None:
        return None
    if not is_list(velocity):
        return as_number(velocity, "velocity", "block", InvalidScene)
    two: Any = velocity
    if len(two) != 2:
        raise refusal(InvalidScene, "velocity", "block", "one number, or two: in x and in y", brief(velocity))
    x, y = (as_number(each, "velocity", "block", InvalidScene) for each in two)
    return x, y


def _stages(wear: Any) -> tuple[tuple[float, float, float], ...]:
    requirement = "a list of (path, mu_s, mu_k)"
    if not is_list(wear):
        raise refusal(InvalidScene, "wear", "block", requirement, brief(wear))
    if len(wear) == 0:
        return ()
    stages = as_array(wear, "wear", "block", InvalidScene, dimensions=2)
    if stages.shape[1] != 3:
        raise refusal(InvalidScene, "wear", "block", requirement, f"{stages.shape[1]} numbers in each")
    return tuple((path, mu_s, mu_k) for path, mu_s, mu_k in stages.tolist())


def blocks_on_floors(mass_ratio: ArrayLike, mu: ArrayLike, *, mu_k: ArrayLike | None = None) -> list[Block]:
    """Return one block per floor, from floor 1 upwards.

    Parameters
    ----------
    mass_ratio : array_like
        Block mass over floor mass (alpha of the paper) of each floor; 0: no block there.
    mu : array_like
        Friction coefficient, one number for all or one per floor; the static one where `mu_k` is given.
    mu_k : array_like, optional
        Kinetic coefficient, in the same form.

    Raises
    ------
    InvalidScene
        The lists differ in length, or hold a value that is not a number.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.blocks_on_floors(mass_ratio=[1, 0.5, 0], mu=0.4)
    [Block(floor=1, mass_ratio=1, mu=0.4), Block(floor=2, mass_ratio=0.5, mu=0.4)]
    """
    ratios = as_array(mass_ratio, "mass_ratio", "blocks", InvalidScene)
    static = _on_floors("mu", mu, len(ratios))
    kinetic = static if mu_k is None else _on_floors("mu_k", mu_k, len(ratios))
    return [
        Block(floor, mass_ratio=float(ratio), mu_s=float(mu_static), mu_k=float(mu_kinetic))
        for floor, (ratio, mu_static, mu_kinetic) in enumerate(zip(ratios, static, kinetic, strict=True), start=1)
        if ratio != 0.0
    ]


def block_mass(block: Block, number: int, building: Building | None) -> float:
    """Mass in kg; a ratio needs a floor that exists."""
    owner = f"block {number}"
    if block.mass_ratio is None:
        if building is not None and not building.mass_is_stated and block.floor > 0:
            requirement = "given as mass_ratio where the mass of the building is not stated"
            raise refusal(InvalidScene, "mass", owner, requirement, f"{block.mass:g} kg")
        return block.mass if block.mass is not None else 0.0
    floors = 0 if building is None else building.storeys
    if block.floor == 0:
        raise refusal(InvalidScene, "mass_ratio", owner, "left out on the ground", f"{block.mass_ratio:g}")
    if building is None or block.floor > floors:
        requirement = f"a floor of the building, 1 to {floors}" if floors else "0, as there is no building"
        raise refusal(InvalidScene, "floor", owner, requirement, str(block.floor))
    if not (np.isfinite(block.mass_ratio) and block.mass_ratio > 0.0):
        raise refusal(InvalidScene, "mass_ratio", owner, "a positive number", f"{block.mass_ratio:g}")
    return block.mass_ratio * float(building.mass[block.floor - 1])


def _on_floors(name: str, value: ArrayLike, floors: int) -> FloatArray:
    array = as_array(value, name, "blocks", InvalidScene, or_number=True)
    if array.ndim == 0:
        return frozen(np.full(floors, array))
    if len(array) != floors:
        requirement = f"one number or a list of {floors} values, one per floor"
        raise refusal(InvalidScene, name, "blocks", requirement, f"{len(array)} values")
    return array


DEFAULT_SLAB_MASS_RATIO: Final = 1.0
"""Mass of the slab over that of floor 1, where neither `mass` nor `mass_ratio` is given: a mat like a floor."""


class SlidingBase(Value, Card):
    """A slab that carries the whole scene and slides on the ground: a mat, a flat slider, a friction pendulum.

    Parameters
    ----------
    mu : float, optional
        Friction coefficient between slab and ground, static and kinetic. Either it or `mu_s` is needed.
    mu_s, mu_k : float, optional
        Static and kinetic friction coefficient; `mu_k` defaults to `mu_s`.
    radius : float, optional
        Effective radius R of a friction pendulum (m): W/R is the restoring stiffness, 2 pi sqrt(R/g) the period. None:
        a flat slider.
    mass : float, optional
        Mass of the slab (kg).
    mass_ratio : float, optional
        The same over the mass of floor 1. Default 1, where there is a building.

    Raises
    ------
    InvalidScene
        What is given contradicts itself or is not a number. Ranges are judged with the scene.

    Notes
    -----
    The contact force N is the weight of slab, building, racks and goods, times 1 + a_v/g with a vertical motion; the
    restoring force is N u/R for a slip u. While the slab sticks it is the ground, exactly: no spring stands for stick.
    Floor
    0 of the scene is the slab: goods and racks on it slide and stand there. Damping is that of the structure fixed at
    its base.

    Examples
    --------
    >>> import seismass as sm
    >>> base = sm.SlidingBase(mu=0.06, radius=2.0)
    >>> sm.Scene(sm.Building.uniform(2, 0.4), base=base)
    Scene(2 storeys, T1 = 0.4 s, no block, sliding base)
    """

    __slots__ = ("mass", "mass_ratio", "mu_k", "mu_s", "radius")
    mass: float | None
    mass_ratio: float | None
    mu_s: float
    mu_k: float
    radius: float | None

    def __init__(
        self,
        mu: float | None = None,
        *,
        mu_s: float | None = None,
        mu_k: float | None = None,
        radius: float | None = None,
        mass: float | None = None,
        mass_ratio: float | None = None,
    ) -> None:
        def number(name: str, value: float) -> float:
            return as_number(value, name, "base", InvalidScene)

        if mass is not None and mass_ratio is not None:
            raise refusal(InvalidScene, "mass", "base", "given either as mass or as mass_ratio", "both")
        if mu is not None and (mu_s is not None or mu_k is not None):
            raise refusal(InvalidScene, "mu", "base", "left out where mu_s or mu_k is given", brief(mu))
        static = mu if mu_s is None else mu_s
        if static is None:
            raise refusal(InvalidScene, "mu", "base", "given, or mu_s", "neither")
        self._set(
            mass=None if mass is None else number("mass", mass),
            mass_ratio=None if mass_ratio is None else number("mass_ratio", mass_ratio),
            mu_s=number("mu" if mu_s is None else "mu_s", static),
            mu_k=number("mu_k", static if mu_k is None else mu_k),
            radius=None if radius is None else number("radius", radius),
        )

    def slab_mass(self, building: Building | None) -> float:
        """Return the mass of the slab below a building (kg).

        Raises
        ------
        InvalidScene
            It is a ratio without a building, or in kg where the mass of the building is not stated.
        """
        if self.mass is not None:
            if building is not None and not building.mass_is_stated:
                requirement = "given as mass_ratio where the mass of the building is not stated"
                raise refusal(InvalidScene, "mass", "base", requirement, f"{self.mass:g} kg")
            return self.mass
        if building is None:
            got = "neither" if self.mass_ratio is None else f"mass_ratio {self.mass_ratio:g}"
            raise refusal(InvalidScene, "mass", "base", "given in kg where there is no building", got)
        ratio = DEFAULT_SLAB_MASS_RATIO if self.mass_ratio is None else self.mass_ratio
        return ratio * float(building.mass[0])

    def of_kernel(self, building: Building | None) -> tuple[float, float, float, float]:
        """Return what the kernel takes: mass of the slab (kg), mu_s, mu_k, radius (m, infinite: flat)."""
        radius = np.inf if self.radius is None else self.radius
        return self.slab_mass(building), self.mu_s, self.mu_k, radius

    def _arguments(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in self.__slots__}

    def __repr__(self) -> str:
        equal = self.mu_s == self.mu_k
        parts = [f"mu={self.mu_s:g}"] if equal else [f"mu_s={self.mu_s:g}", f"mu_k={self.mu_k:g}"]
        others = (("radius", self.radius), ("mass", self.mass), ("mass_ratio", self.mass_ratio))
        parts += [f"{name}={value:g}" for name, value in others if value is not None]
        return f"SlidingBase({', '.join(parts)})"
