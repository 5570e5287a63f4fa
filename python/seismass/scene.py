"""Building, Block and Scene as users meet them: they convert, name things, and leave every judgement to the kernel."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass._values import FloatArray, Value, as_array, as_count, as_number, brief, frozen, refusal
from seismass.errors import InvalidScene
from seismass.plausibility import scene_remarks
from seismass.units import STANDARD_GRAVITY

MAX_STOREYS: Final = 1000
"""Most storeys of a building, as the kernel has it."""
DEFAULT_DAMPING: Final = 0.05
"""Ratio of critical damping in every vibration mode."""
DEFAULT_OVERSTRENGTH: Final = 2.0
"""Overstrength Omega, of the paper's section 4."""
DEFAULT_SECOND_SLOPE: Final = 0.05
"""Second slope r2 over the first: an inference from what the paper says of its results, not its number."""
DEFAULT_THIRD_SLOPE: Final = 0.0
"""Third slope r3 over the first: an inference, as r2."""


@dataclass(frozen=True)
class Rayleigh:
    """Rayleigh damping C = a M + b K with the same ratio in two modes of the bare building.

    Parameters
    ----------
    ratio : float
        Ratio of critical damping in both modes, from 0 to 1: 0.05 for 5 %.
    modes : tuple of int
        The two modes, counted from 1.

    Raises
    ------
    InvalidScene
        The modes are not two whole numbers from 1, or the ratio is not a number of at most 1.
    """

    ratio: float
    modes: tuple[int, int] = (1, 2)

    def __post_init__(self) -> None:
        modes: Any = self.modes
        if not (isinstance(modes, Sequence) and len(modes) == 2) or isinstance(modes, str):
            raise refusal(InvalidScene, "modes", "Rayleigh damping", "two mode numbers", brief(modes))
        checked = tuple(as_count(mode, "modes", "Rayleigh damping", InvalidScene, least=1) for mode in modes)
        object.__setattr__(self, "modes", checked)
        object.__setattr__(self, "ratio", _damping_ratio(self.ratio, "ratio", "Rayleigh damping"))


Damping: TypeAlias = float | Rayleigh | ArrayLike
"""A ratio in every mode, Rayleigh damping, or the matrix C itself (N s/m, floor coordinates, symmetric)."""


class Building(Value):
    """A shear building: lumped floor masses, trilinear storey springs with Masing unloading, damping.

    Every argument that has a value per storey takes one number, which then stands for all storeys, or a list with
    storey 1 (on the ground) first. The number of storeys is the length of the first list given.

    Parameters
    ----------
    mass : array_like
        Floor masses m_i (kg).
    stiffness : array_like
        Initial storey stiffnesses k_i (N/m).
    yield_shear : array_like, default inf
        First yield shear V_y of each storey (N); infinite: the storey stays elastic.
    overstrength : array_like, default 2
        Omega >= 1: the second yield is at Omega V_y.
    second_slope, third_slope : array_like, default 0.05 and 0
        Slopes r2 and r3 after the first and second yield over the initial one, 0 <= r3 <= r2 <= 1.
    damping : float, Rayleigh or array_like of shape (storeys, storeys), default 0.05
        A ratio in every vibration mode of the bare building, from 0 to 1 (0.05 for 5 %), Rayleigh damping, or the
        matrix C (N s/m).
    heights : array_like, optional
        Storey heights (m). Alone they only make drift ratios known.
    gravity_load : array_like, optional
        Gravity load of each floor without blocks (N). With the heights it gives P-Delta, to which the weight of the
        blocks is added: P_i/h_i is subtracted from the tangent stiffness of storey i.
    geometric_stiffness : array_like, optional
        Finished P/h of each storey (N/m), instead of `gravity_load`.
    mass_is_stated : bool, default True
        False where the masses are only a convention, as `uniform` makes them where it is given none: then blocks have
        to be given by `mass_ratio`, and forces mean something as fractions of the weight alone.

    Attributes
    ----------
    mass, stiffness, yield_shear, overstrength, second_slope, third_slope : ndarray, shape (storeys,)
        As given, read-only.
    heights, gravity_load, geometric_stiffness : ndarray, shape (storeys,), or None
        As given, read-only.
    damping : float, Rayleigh or ndarray
        As given.
    mass_is_stated : bool
        As given.

    Raises
    ------
    InvalidScene
        A number is out of its range, a list has another length, or arguments contradict each other.

    Notes
    -----
    Springs as in Fig. 3 of the 16WCEE paper; the damping matrix is M Phi diag(2 zeta w) Phi^T M, constant through
    yielding and sliding and made without P-Delta.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building(mass=[1000, 1000, 1000], stiffness=5.5e5, yield_shear=[7000, 6000, 3500])
    >>> building.storeys
    3
    >>> building.periods.round(3)
    array([0.602, 0.215, 0.149])
    """

    __slots__ = (
        "_kernel",
        "damping",
        "geometric_stiffness",
        "gravity_load",
        "heights",
        "mass",
        "mass_is_stated",
        "overstrength",
        "second_slope",
        "stiffness",
        "third_slope",
        "yield_shear",
    )
    _kernel: _kernel.Building
    mass: FloatArray
    stiffness: FloatArray
    yield_shear: FloatArray
    overstrength: FloatArray
    second_slope: FloatArray
    third_slope: FloatArray
    damping: float | Rayleigh | FloatArray
    heights: FloatArray | None
    gravity_load: FloatArray | None
    geometric_stiffness: FloatArray | None
    mass_is_stated: bool

    def __init__(
        self,
        mass: ArrayLike,
        stiffness: ArrayLike,
        *,
        yield_shear: ArrayLike = np.inf,
        overstrength: ArrayLike = DEFAULT_OVERSTRENGTH,
        second_slope: ArrayLike = DEFAULT_SECOND_SLOPE,
        third_slope: ArrayLike = DEFAULT_THIRD_SLOPE,
        damping: Damping = DEFAULT_DAMPING,
        heights: ArrayLike | None = None,
        gravity_load: ArrayLike | None = None,
        geometric_stiffness: ArrayLike | None = None,
        mass_is_stated: bool = True,
    ) -> None:
        if gravity_load is not None and geometric_stiffness is not None:
            raise refusal(
                InvalidScene, "geometric_stiffness", "building", "left out where gravity_load is given", "both"
            )
        if gravity_load is not None and heights is None:
            raise refusal(InvalidScene, "heights", "building", "given where gravity_load is", "none")
        springs = _per_storey(
            mass=mass,
            stiffness=stiffness,
            yield_shear=yield_shear,
            overstrength=overstrength,
            second_slope=second_slope,
            third_slope=third_slope,
            heights=heights,
            gravity_load=gravity_load,
            geometric_stiffness=geometric_stiffness,
        )
        self._set(**springs, damping=_damping(damping), mass_is_stated=bool(mass_is_stated))
        heights_only = gravity_load is None
        if heights_only and self.heights is not None:
            _check_heights(self.heights, len(self.mass))
        self._set(
            _kernel=_kernel.Building(
                self.mass,
                self.stiffness,
                self.yield_shear,
                self.overstrength,
                self.second_slope,
                self.third_slope,
                **_damping_arguments(self.damping),
                heights=None if heights_only else self.heights,
                gravity_load=self.gravity_load,
                geometric_stiffness=self.geometric_stiffness,
            )
        )

    @classmethod
    def uniform(
        cls,
        storeys: int,
        period: float,
        *,
        mass: float | None = None,
        yield_shear: ArrayLike | None = None,
        yield_shear_over_weight: ArrayLike | None = None,
        overstrength: ArrayLike = DEFAULT_OVERSTRENGTH,
        second_slope: ArrayLike = DEFAULT_SECOND_SLOPE,
        third_slope: ArrayLike = DEFAULT_THIRD_SLOPE,
        damping: Damping = DEFAULT_DAMPING,
        heights: ArrayLike | None = None,
        gravity_load: ArrayLike | None = None,
        geometric_stiffness: ArrayLike | None = None,
    ) -> Building:
        """Return a building of equal floor masses and storey stiffnesses with the given first period.

        Parameters
        ----------
        storeys : int
            Number of storeys n.
        period : float
            First period T of the bare building (s).
        mass : float, optional
            Mass of each floor (kg). Drifts and slips do not depend on it where all else is given as ratios (Notes). By
            default it is 1 kg and not stated: blocks are then ratios of it.
        yield_shear : array_like, optional
            V_y of each storey (N); elastic where neither it nor the next is given.
        yield_shear_over_weight : array_like, optional
            V_y as a fraction of the weight g sum(m) of the building without blocks.
        overstrength, second_slope, third_slope, damping, heights, gravity_load, geometric_stiffness
            As for `Building`.

        Raises
        ------
        InvalidScene
            As for `Building`, or both forms of yield shear are given.

        Notes
        -----
        w_1 = 2 sqrt(k/m) sin(pi / (2 (2 n + 1))) gives the stiffness.

        Stiffness follows the mass, and so does everything given as a ratio. Drifts and slips therefore do not depend on
        the mass where the building is elastic or has its strengths over the weight, its damping is a ratio, there is no
        P-Delta, and blocks are given by `mass_ratio`; forces and energies are then proportional to it. What is given
        in other units is for floor masses of 1 kg where no mass is stated: `yield_shear`, `gravity_load`,
        `geometric_stiffness`, a damping matrix. The `mass` of blocks is refused there, and `mass=1.0` states it.

        Examples
        --------
        >>> import seismass as sm
        >>> sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.24, 0.20, 0.12])
        Building(3 storeys, T1 = 0.6 s, V_y/W = [0.24, 0.2, 0.12], Omega = 2, r2 = 0.05, r3 = 0, damping = 0.05)
        """
        count = as_count(storeys, "storeys", "building", InvalidScene, least=1)
        if yield_shear_over_weight is not None and yield_shear is not None:
            raise refusal(
                InvalidScene, "yield_shear_over_weight", "building", "left out where yield_shear is given", "both"
            )
        floor_mass = 1.0 if mass is None else as_number(mass, "mass", "building", InvalidScene)
        stiffness = _kernel.uniform_stiffness(count, as_number(period, "period", "building", InvalidScene), floor_mass)
        if yield_shear_over_weight is not None:
            weight = STANDARD_GRAVITY * floor_mass * count
            yield_shear = as_fraction_of_weight(yield_shear_over_weight, count) * weight
        return cls(
            np.full(count, floor_mass),
            stiffness,
            yield_shear=np.inf if yield_shear is None else yield_shear,
            overstrength=overstrength,
            second_slope=second_slope,
            third_slope=third_slope,
            damping=damping,
            heights=heights,
            gravity_load=gravity_load,
            geometric_stiffness=geometric_stiffness,
            mass_is_stated=mass is not None,
        )

    def replace(self, **changes: Any) -> Building:
        """Return another building, with these arguments changed.

        Parameters
        ----------
        **changes
            Arguments of `Building`, or `yield_shear_over_weight`, V_y as fractions of the weight of the new building.
            Masses given here are stated.

        Raises
        ------
        InvalidScene
            As for `Building` and `uniform`.

        Examples
        --------
        >>> import seismass as sm
        >>> sm.Building.uniform(3, 0.6).replace(yield_shear_over_weight=[0.24, 0.20, 0.12])
        Building(3 storeys, T1 = 0.6 s, V_y/W = [0.24, 0.2, 0.12], Omega = 2, r2 = 0.05, r3 = 0, damping = 0.05)
        """
        over_weight = changes.pop("yield_shear_over_weight", None)
        if over_weight is not None and "yield_shear" in changes:
            raise refusal(
                InvalidScene, "yield_shear_over_weight", "building", "left out where yield_shear is given", "both"
            )
        if "mass" in changes:
            changes = {"mass_is_stated": True} | changes
        if over_weight is None:
            return super().replace(**changes)
        changed = super().replace(**changes, yield_shear=np.inf)
        strength = as_fraction_of_weight(over_weight, changed.storeys) * changed.weight
        return changed.replace(yield_shear=strength)

    @property
    def storeys(self) -> int:
        """Number of storeys."""
        return len(self.mass)

    @property
    def weight(self) -> float:
        """Weight W = g sum(m) of the building without blocks (N)."""
        return STANDARD_GRAVITY * float(self.mass.sum())

    @property
    def periods(self) -> FloatArray:
        """Natural periods of the bare building without P-Delta (s), longest first, shape (storeys,)."""
        return self._kernel.periods

    @property
    def damping_matrix(self) -> FloatArray:
        """Damping matrix C in floor coordinates (N s/m), shape (storeys, storeys)."""
        return self._kernel.damping_matrix

    def _arguments(self) -> dict[str, Any]:
        return {
            "mass": self.mass,
            "stiffness": self.stiffness,
            "yield_shear": self.yield_shear,
            "overstrength": self.overstrength,
            "second_slope": self.second_slope,
            "third_slope": self.third_slope,
            "damping": self.damping,
            "heights": self.heights,
            "gravity_load": self.gravity_load,
            "geometric_stiffness": self.geometric_stiffness,
            "mass_is_stated": self.mass_is_stated,
        }

    def __repr__(self) -> str:
        elastic = bool(np.isinf(self.yield_shear).all())
        springs = (
            "elastic"
            if elastic
            else f"V_y/W = {_listed(self.yield_shear / self.weight)}, Omega = {_listed(self.overstrength)}, "
            f"r2 = {_listed(self.second_slope)}, r3 = {_listed(self.third_slope)}"
        )
        damping = "matrix" if isinstance(self.damping, np.ndarray) else self.damping
        p_delta = ", P-Delta" if self.gravity_load is not None or self.geometric_stiffness is not None else ""
        noun = "storey" if self.storeys == 1 else "storeys"
        return f"Building({self.storeys} {noun}, T1 = {self.periods[0]:.4g} s, {springs}, damping = {damping}{p_delta})"


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
    velocity : float, optional
        Initial velocity relative to the ground (m/s); by default that of its floor.

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

    __slots__ = ("floor", "mass", "mass_ratio", "mu_k", "mu_s", "velocity")
    floor: int
    mass: float | None
    mass_ratio: float | None
    mu_s: float
    mu_k: float
    velocity: float | None

    def __init__(
        self,
        floor: int,
        *,
        mass: float | None = None,
        mass_ratio: float | None = None,
        mu: float | None = None,
        mu_s: float | None = None,
        mu_k: float | None = None,
        velocity: float | None = None,
    ) -> None:
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
            velocity=number("velocity", velocity),
        )

    def _arguments(self) -> dict[str, Any]:
        return {
            "floor": self.floor,
            "mass": self.mass,
            "mass_ratio": self.mass_ratio,
            "mu_s": self.mu_s,
            "mu_k": self.mu_k,
            "velocity": self.velocity,
        }

    def __repr__(self) -> str:
        mass = f"mass={self.mass:g}" if self.mass is not None else f"mass_ratio={self.mass_ratio:g}"
        equal = self.mu_s == self.mu_k
        friction = f"mu={self.mu_s:g}" if equal else f"mu_s={self.mu_s:g}, mu_k={self.mu_k:g}"
        velocity = "" if self.velocity is None else f", velocity={self.velocity:g}"
        return f"Block(floor={self.floor}, {mass}, {friction}{velocity})"


def blocks_on_floors(mass_ratio: ArrayLike, mu: ArrayLike, *, mu_k: ArrayLike | None = None) -> list[Block]:
    """Return one block per floor, from floor 1 upwards.

    Parameters
    ----------
    mass_ratio : array_like
        Block mass over floor mass (alpha of the paper) of each floor; 0: no block there.
    mu : array_like
        Friction coefficient, one number for all or one per floor; the static one where `mu_k` is given.
    mu_k : array_like, optional
        Kinetic coefficient, likewise.

    Raises
    ------
    InvalidScene
        The lists differ in length, or hold what is not a number.

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


class Scene(Value):
    """A building and its blocks, or blocks on the ground alone, with their initial state.

    Parameters
    ----------
    building : Building or None
        None: there are blocks on the ground only.
    blocks : iterable of Block
        Any number, in any order; several may share a floor. They are counted from 1 as listed.
    initial_drift : array_like, optional
        Storey drifts at the start (m), within the elastic range. It and the next two need a building.
    initial_velocity : array_like, optional
        Floor velocities relative to the ground at the start (m/s).
    collapse_drift : array_like, optional
        Drift (m) at which a storey counts as collapsed and the run ends, beside the limit that P-Delta sets.
    name, note : str
        Labels; they do not take part in comparison.

    Attributes
    ----------
    building, blocks, initial_drift, initial_velocity, collapse_drift, name, note
        As given; `blocks` is a tuple, arrays are read-only.

    Raises
    ------
    InvalidScene
        A block is invalid, stands on a missing floor or has a mass where the building's is not stated, P/h reaches a
        stiffness, a list has another length, or there are storey values without a building.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(3, 0.6)
    >>> sm.Scene(building, sm.blocks_on_floors([1, 1, 0], mu=0.3))
    Scene(3 storeys, T1 = 0.6 s, 2 blocks)
    """

    __slots__ = (
        "_kernel",
        "blocks",
        "building",
        "collapse_drift",
        "initial_drift",
        "initial_velocity",
        "name",
        "note",
    )
    _kernel: _kernel.Scene
    building: Building | None
    blocks: tuple[Block, ...]
    initial_drift: FloatArray | None
    initial_velocity: FloatArray | None
    collapse_drift: FloatArray | None
    name: str
    note: str

    def __init__(
        self,
        building: Building | None,
        blocks: Iterable[Block] = (),
        *,
        initial_drift: ArrayLike | None = None,
        initial_velocity: ArrayLike | None = None,
        collapse_drift: ArrayLike | None = None,
        name: str = "",
        note: str = "",
    ) -> None:
        if building is not None and not isinstance(building, Building):
            raise refusal(InvalidScene, "building", "scene", "a Building or None", brief(building))
        try:
            placed = tuple(blocks)
        except TypeError:
            raise refusal(InvalidScene, "blocks", "scene", "a list of Blocks", brief(blocks)) from None
        for number, block in enumerate(placed, start=1):
            if not isinstance(block, Block):
                raise refusal(InvalidScene, f"block {number}", "scene", "a Block", brief(block))

        def per_storey(name: str, value: ArrayLike | None) -> FloatArray | None:
            if value is None:
                return None
            if building is None:
                raise refusal(InvalidScene, name, "scene", "left out where there is no building", brief(value))
            array = as_array(value, name, "scene", InvalidScene, or_number=True)
            return frozen(np.full(building.storeys, array)) if array.ndim == 0 else array

        self._set(
            building=building,
            blocks=placed,
            initial_drift=per_storey("initial_drift", initial_drift),
            initial_velocity=per_storey("initial_velocity", initial_velocity),
            collapse_drift=per_storey("collapse_drift", collapse_drift),
            name=str(name),
            note=str(note),
        )
        self._set(
            _kernel=_kernel.Scene(
                None if building is None else building._kernel,
                [
                    (block.floor, _block_mass(block, number, building), block.mu_s, block.mu_k, block.velocity)
                    for number, block in enumerate(placed, start=1)
                ],
                initial_drift=self.initial_drift,
                initial_velocity=self.initial_velocity,
                collapse_drift=self.collapse_drift,
            )
        )

    @property
    def storeys(self) -> int:
        """Number of storeys; 0 without a building."""
        return 0 if self.building is None else self.building.storeys

    @property
    def block_mass(self) -> FloatArray:
        """Mass of each block (kg), shape (blocks,)."""
        return frozen([_block_mass(block, number, self.building) for number, block in enumerate(self.blocks, start=1)])

    @property
    def block_floor(self) -> tuple[int, ...]:
        """Floor of each block; 0 is the ground."""
        return tuple(block.floor for block in self.blocks)

    @property
    def geometric_stiffness(self) -> FloatArray:
        """P/h of each storey (N/m), the weight of the blocks included, shape (storeys,); zero without P-Delta."""
        return self._kernel.geometric_stiffness

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is unlikely about the building and its blocks, as sentences; found when asked for, empty as a rule."""
        return scene_remarks(self)

    def _arguments(self) -> dict[str, Any]:
        return {
            "building": self.building,
            "blocks": self.blocks,
            "initial_drift": self.initial_drift,
            "initial_velocity": self.initial_velocity,
            "collapse_drift": self.collapse_drift,
            "name": self.name,
            "note": self.note,
        }

    def _content(self) -> tuple[Any, ...]:
        arrays = (self.initial_drift, self.initial_velocity, self.collapse_drift)
        return (
            self.building,
            self.blocks,
            *(None if array is None else (array + 0.0).tobytes() for array in arrays),
        )

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        blocks = {0: "no block", 1: "1 block"}.get(len(self.blocks), f"{len(self.blocks)} blocks")
        if self.building is None:
            return f"Scene({name}ground only, {blocks})"
        noun = "storey" if self.storeys == 1 else "storeys"
        return f"Scene({name}{self.storeys} {noun}, T1 = {self.building.periods[0]:.4g} s, {blocks})"


def changed_building(building: Building, **changes: Any) -> Building:
    """Return a building with arguments changed as they are: unlike in `replace`, a changed mass is not a stated one."""
    return Building(**(building._arguments() | changes))


def as_fraction_of_weight(value: Any, storeys: int) -> FloatArray:
    """Return yield shears over the weight, positive: one number (shape ()) or one per storey."""
    name = "yield_shear_over_weight"
    fraction = as_array(value, name, "building", InvalidScene, or_number=True)
    if not np.all(fraction > 0.0):
        raise refusal(InvalidScene, name, "building", "positive", brief(value))
    if fraction.shape not in ((), (storeys,)):
        requirement = f"one number or a list of {storeys} values, one per storey"
        raise refusal(InvalidScene, name, "building", requirement, f"{fraction.size} values")
    return fraction


def _per_storey(**given: ArrayLike | None) -> dict[str, FloatArray | None]:
    """One array per argument, all with as many values as the first list among them has."""
    arrays = {
        name: None if value is None else as_array(value, name, "building", InvalidScene, or_number=True)
        for name, value in given.items()
    }
    storeys = next((len(array) for array in arrays.values() if array is not None and array.ndim), 1)
    return {
        name: frozen(np.full(storeys, array)) if array is not None and array.ndim == 0 else array
        for name, array in arrays.items()
    }


def _check_heights(heights: FloatArray, storeys: int) -> None:
    """Heights that the kernel does not see, because they only make drift ratios."""
    if len(heights) != storeys:
        requirement = f"one number or a list of {storeys} values, one per storey"
        raise refusal(InvalidScene, "heights", "building", requirement, f"{len(heights)} values")
    for number, height in enumerate(heights, start=1):
        if not (np.isfinite(height) and height > 0.0):
            raise refusal(InvalidScene, "heights", f"storey {number}", "a positive number", f"{height:g}")


def _damping(damping: Any) -> float | Rayleigh | FloatArray:
    if isinstance(damping, Rayleigh):
        return damping
    if isinstance(damping, Real) or (isinstance(damping, np.ndarray) and damping.ndim == 0):
        return _damping_ratio(damping, "damping", "building")
    if damping is None or isinstance(damping, str | bytes):
        raise refusal(InvalidScene, "damping", "building", "a ratio, Rayleigh damping or a matrix", brief(damping))
    return as_array(damping, "damping", "building", InvalidScene, dimensions=2)


def _damping_ratio(value: Any, parameter: str, owner: str) -> float:
    """Return a ratio of critical damping; what is above 1 was meant in per cent, and the kernel refuses the rest."""
    ratio = as_number(value, parameter, owner, InvalidScene)
    if ratio > 1.0:
        raise refusal(InvalidScene, parameter, owner, "a ratio of at most 1 (0.05 for 5 %)", f"{ratio:g}")
    return ratio


def _damping_arguments(damping: float | Rayleigh | FloatArray) -> dict[str, Any]:
    if isinstance(damping, Rayleigh):
        return {"damping_ratio": damping.ratio, "rayleigh_modes": damping.modes}
    if isinstance(damping, np.ndarray):
        return {"damping_matrix": damping}
    return {"damping_ratio": damping}


def _block_mass(block: Block, number: int, building: Building | None) -> float:
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


def _listed(values: FloatArray) -> str:
    """One number where all are equal, else a list."""
    if (values == values[0]).all():
        return f"{values[0]:.4g}"
    return "[" + ", ".join(f"{value:.4g}" for value in values) + "]"
