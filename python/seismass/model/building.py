"""Building as users meet it: masses, storey springs, damping and gravity; the kernel judges the values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any, Final, TypeAlias, Unpack

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.errors import InvalidScene
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, Value, as_array, as_count, as_flag, as_number, brief, frozen, refusal
from seismass.base.views import view
from seismass.model.springs import (
    SHAPE_FIELDS,
    SPRING_FIELDS,
    Backbone,
    BackboneLike,
    Hysteresis,
    SpringArguments,
    SpringShape,
    check_parts,
    checked_names,
    default_values,
    documented,
    is_default,
    listed_storeys,
    of_first_segment,
    parts,
    read_backbones,
    read_hysteresis,
    takes_springs,
    without_implied,
)

DEFAULT_DAMPING: Final = 0.05
"""Ratio of critical damping in every vibration mode."""


@dataclass(frozen=True)
class Rayleigh:
    """Rayleigh damping C = a M + b K with the same ratio in two modes of the bare building.

    Parameters
    ----------
    ratio : float
        Ratio of critical damping in both modes, from 0 to 1: 0.05 for 5 %.
    modes : tuple of int, optional
        The two modes, counted from 1.

    Raises
    ------
    InvalidScene
        The modes are not two whole numbers from 1, or the ratio is not a number. A building refuses a ratio
        that is not from 0 to 1, and modes that it does not have.
    """

    ratio: float
    modes: tuple[int, int] = (1, 2)

    def __post_init__(self) -> None:
        modes: Any = self.modes
        if not (isinstance(modes, Sequence) and len(modes) == 2) or isinstance(modes, str):
            raise refusal(InvalidScene, "modes", "Rayleigh damping", "two mode numbers", brief(modes))
        checked = tuple(as_count(mode, "modes", "Rayleigh damping", InvalidScene, least=1) for mode in modes)
        object.__setattr__(self, "modes", checked)
        object.__setattr__(self, "ratio", as_number(self.ratio, "ratio", "Rayleigh damping", InvalidScene))


Damping: TypeAlias = float | Rayleigh | ArrayLike
"""A ratio in every mode, Rayleigh damping, or the matrix C itself (N s/m, floor coordinates, symmetric)."""


def read_damping(damping: Any) -> float | Rayleigh | FloatArray:
    """Return damping as a building holds it; the kernel refuses a ratio out of range, such as 5 for 5 %."""
    if isinstance(damping, Rayleigh):
        return damping
    if isinstance(damping, Real) or (isinstance(damping, np.ndarray) and damping.ndim == 0):
        return as_number(damping, "damping", "building", InvalidScene)
    if damping is None or isinstance(damping, str | bytes):
        raise refusal(InvalidScene, "damping", "building", "a ratio, Rayleigh damping or a matrix", brief(damping))
    return as_array(damping, "damping", "building", InvalidScene, dimensions=2)


def kernel_damping(damping: float | Rayleigh | FloatArray) -> dict[str, Any]:
    """Return damping as the kernel takes it."""
    if isinstance(damping, Rayleigh):
        return {"damping_ratio": damping.ratio, "rayleigh_modes": damping.modes}
    if isinstance(damping, np.ndarray):
        return {"damping_matrix": damping}
    return {"damping_ratio": damping}


class Building(Value):
    """A shear building: lumped floor masses, storey springs and damping.

    Springs are trilinear with Masing unloading unless a backbone, a hysteresis or a clearance says otherwise.

    Every argument that has a value per storey takes one number, which then stands for all storeys, or a list with
    storey 1 (on the ground) first. The number of storeys is the length of the first list given.

    Parameters
    ----------
    mass : array_like
        Floor masses m_i (kg).
    stiffness : array_like, optional
        Initial storey stiffnesses k_i (N/m). Left out only where every storey has a backbone.
    {springs}
    backbone : array_like of shape (points, 2), or a list of those, optional
        Drifts (m) and forces (N) of a polygon from the origin, of slopes that do not increase, with Masing unloading; a
        list has one per storey, None where a storey is trilinear. The stiffness and the yield shear of a storey with a
        backbone are those of its first segment; one number for either of them is for the other storeys.
    hysteresis : {"masing", "peak-oriented", "flag-shaped"} or list of them, default "masing"
        How storeys unload and reload. Peak-oriented ones reload straight to their largest drift so far. Flag-shaped
        ones, of slopes k and r2 k, come back to zero drift at zero force.
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
    stiffness_matrix : array_like of shape (storeys, storeys), optional
        Elastic stiffness (N/m) over the floors beside the storey springs: walls, braces over several storeys, a
        condensed model. Symmetric, positive semi-definite; a storey's own spring may then have stiffness 0. Damping is
        formed with springs and matrix together. Such buildings are solved by the general engine: `simulate` takes them.
    mass_is_stated : bool, default True
        False where the masses are only a convention, as `uniform` makes them where it is given none: then blocks have
        to be given by `mass_ratio`, and forces mean something as fractions of the weight alone.

    Attributes
    ----------
    mass, stiffness, and what a spring has beside it : ndarray, shape (storeys,)
        As given, read-only.
    backbone : tuple, or None
        Points of each storey, or None; None where no storey has a backbone.
    hysteresis : tuple of str
        That of each storey.
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
        "backbone",
        "damping",
        "geometric_stiffness",
        "gravity_load",
        "heights",
        "hysteresis",
        "mass",
        "mass_is_stated",
        "stiffness",
        "stiffness_matrix",
        *SPRING_FIELDS,
    )
    _kernel: _kernel.Building | _kernel.GeneralBuilding
    mass: FloatArray
    stiffness: FloatArray
    yield_shear: FloatArray
    overstrength: FloatArray
    second_slope: FloatArray
    third_slope: FloatArray
    clearance: FloatArray
    stop_stiffness: FloatArray
    unloading_exponent: FloatArray
    energy_capacity: FloatArray
    residual_strength: FloatArray
    flag_height: FloatArray
    backbone: tuple[Backbone | None, ...] | None
    hysteresis: tuple[Hysteresis, ...]
    damping: float | Rayleigh | FloatArray
    heights: FloatArray | None
    gravity_load: FloatArray | None
    geometric_stiffness: FloatArray | None
    stiffness_matrix: FloatArray | None
    mass_is_stated: bool

    @takes_springs(SPRING_FIELDS)
    def __init__(
        self,
        mass: ArrayLike,
        stiffness: ArrayLike | None = None,
        *,
        backbone: BackboneLike | None = None,
        hysteresis: Hysteresis | Sequence[Hysteresis] = "masing",
        damping: Damping = DEFAULT_DAMPING,
        heights: ArrayLike | None = None,
        gravity_load: ArrayLike | None = None,
        geometric_stiffness: ArrayLike | None = None,
        stiffness_matrix: ArrayLike | None = None,
        mass_is_stated: bool = True,
        **springs: Unpack[SpringArguments],
    ) -> None:
        parameters: dict[str, Any] = dict(springs)
        checked_names(parameters, SPRING_FIELDS, "Building")
        if gravity_load is not None and geometric_stiffness is not None:
            raise refusal(
                InvalidScene, "geometric_stiffness", "building", "left out where gravity_load is given", "both"
            )
        if gravity_load is not None and heights is None:
            raise refusal(InvalidScene, "heights", "building", "given where gravity_load is", "none")
        arguments = {
            "mass": mass,
            "stiffness": np.nan if stiffness is None else stiffness,
            **{name: parameters[name] for name in SPRING_FIELDS if name in parameters},
            "heights": heights,
            "gravity_load": gravity_load,
            "geometric_stiffness": geometric_stiffness,
        }
        arrays = {name: _array(name, value) for name, value in arguments.items()}
        lengths = [len(array) for array in arrays.values() if array is not None and array.ndim]
        storeys = next(iter((*lengths, *listed_storeys(backbone, hysteresis))), 1)
        backbones = read_backbones(backbone, storeys)
        if stiffness is None and (backbones is None or None in backbones):
            raise refusal(InvalidScene, "stiffness", "building", "given where a storey has no backbone", "none")
        filled = {name: default_values(name, storeys) for name in SPRING_FIELDS if name not in arrays}
        if backbones is not None:
            for name in ("stiffness", "yield_shear"):
                value_of_springs = arrays.get(name, np.array(np.inf))
                if value_of_springs is not None and value_of_springs.shape in ((), (storeys,)):
                    filled[name] = of_first_segment(value_of_springs, name, backbones)
        self._set(
            **({name: _filled(array, storeys) for name, array in arrays.items()} | filled),
            backbone=backbones,
            hysteresis=read_hysteresis(hysteresis, storeys),
            damping=read_damping(damping),
            stiffness_matrix=_matrix(stiffness_matrix),
            mass_is_stated=as_flag(mass_is_stated, "mass_is_stated", "building", InvalidScene),
        )
        stated = {name: values for name, values in self.springs.items() if not is_default(values, name)}
        check_parts(stated, self.backbone, self.hysteresis)
        heights_only = gravity_load is None
        if heights_only and self.heights is not None:
            _check_heights(self.heights, len(self.mass))
        (positional, laws) = kernel_springs(self)
        arguments_of_kernel: dict[str, Any] = {
            **laws,
            **kernel_damping(self.damping),
            "heights": None if heights_only else self.heights,
            "gravity_load": self.gravity_load,
            "geometric_stiffness": self.geometric_stiffness,
        }
        if self.stiffness_matrix is None:
            self._set(_kernel=_kernel.Building(self.mass, *positional, **arguments_of_kernel))
        else:
            matrix = self.stiffness_matrix
            kernel = _kernel.GeneralBuilding(self.mass, *positional, stiffness_matrix=matrix, **arguments_of_kernel)
            self._set(_kernel=kernel)

    @classmethod
    @takes_springs(SHAPE_FIELDS)
    def uniform(
        cls,
        storeys: int,
        period: float,
        *,
        mass: float | None = None,
        yield_shear: ArrayLike | None = None,
        yield_shear_over_weight: ArrayLike | None = None,
        hysteresis: Hysteresis | Sequence[Hysteresis] = "masing",
        damping: Damping = DEFAULT_DAMPING,
        heights: ArrayLike | None = None,
        gravity_load: ArrayLike | None = None,
        geometric_stiffness: ArrayLike | None = None,
        **shape: Unpack[SpringShape],
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
        hysteresis, damping, heights, gravity_load, geometric_stiffness
            As for `Building`.
        **shape
            Overstrength, slopes and what else shapes the springs, as for `Building`.

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
            hysteresis=hysteresis,
            damping=damping,
            heights=heights,
            gravity_load=gravity_load,
            geometric_stiffness=geometric_stiffness,
            mass_is_stated=mass is not None,
            **shape,
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
        backbones = read_backbones(changes.get("backbone"), self.storeys)
        if backbones is not None:
            values = {name: without_implied(getattr(self, name), backbones) for name in ("stiffness", "yield_shear")}
            changes = values | changes
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
    def springs(self) -> dict[str, FloatArray]:
        """Numbers of the storey springs by the name of their argument, each of shape (storeys,), stiffness first."""
        return {name: getattr(self, name) for name in ("stiffness", *SPRING_FIELDS)}

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

    def spring_summary(self) -> dict[str, FloatArray]:
        """Return what summaries list of the springs, by symbol: the strength over the weight, and what shapes them."""
        shape = self.springs_in_use()
        listed = {SHAPE_FIELDS[name].symbol: values for name, values in shape.items() if name in SHAPE_FIELDS}
        return {"V_y/W": self.yield_shear / self.weight, **listed}

    def springs_in_use(self) -> dict[str, FloatArray]:
        """Return `springs` without the numbers that do not matter, such as those of stops where no storey has one."""
        has = parts(self.springs, self.backbone, self.hysteresis)
        unused = {name for name, field in SPRING_FIELDS.items() if not field.matters(has)}
        if "stop" not in has:
            unused.add("clearance")
        return {name: values for name, values in self.springs.items() if name not in unused}

    @property
    def laws(self) -> tuple[str, ...]:
        """What springs have beside trilinear backbones with Masing unloading: "backbone", "stop", or a hysteresis."""
        backbones = () if self.backbone is None else ("backbone",)
        return (*backbones, *sorted(parts(self.springs, self.backbone, self.hysteresis) - {"trilinear"}, reverse=True))

    def _arguments(self) -> dict[str, Any]:
        return {
            "mass": self.mass,
            **self.springs,
            "backbone": self.backbone,
            "hysteresis": self.hysteresis,
            "damping": self.damping,
            "heights": self.heights,
            "gravity_load": self.gravity_load,
            "geometric_stiffness": self.geometric_stiffness,
            "stiffness_matrix": self.stiffness_matrix,
            "mass_is_stated": self.mass_is_stated,
        }

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError

    def __repr__(self) -> str:
        elastic = bool(np.isinf(self.yield_shear).all()) and not self.laws
        springs = (
            "elastic"
            if elastic
            else ", ".join(f"{symbol} = {_listed(values)}" for symbol, values in self.spring_summary().items())
        )
        laws = "".join(f", {law}" for law in self.laws)
        damping = "matrix" if isinstance(self.damping, np.ndarray) else self.damping
        damping = f"{damping}" if self.stiffness_matrix is None else f"{damping}, stiffness matrix"
        p_delta = ", P-Delta" if self.gravity_load is not None or self.geometric_stiffness is not None else ""
        noun = "storey" if self.storeys == 1 else "storeys"
        springs += laws
        return f"Building({self.storeys} {noun}, T1 = {self.periods[0]:.4g} s, {springs}, damping = {damping}{p_delta})"


Building.__doc__ = documented(Building.__doc__, SPRING_FIELDS)


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


_MAY_BE_NONE: Final = ("heights", "gravity_load", "geometric_stiffness")


def _array(name: str, value: ArrayLike | None) -> FloatArray | None:
    """An argument as an array, of shape () where it is one number."""
    if value is None and name in _MAY_BE_NONE:
        return None
    if is_default(value, name):
        return value
    return as_array(value, name, "building", InvalidScene, or_number=True)


def _filled(array: FloatArray | None, storeys: int) -> FloatArray | None:
    """An array with a value per storey where it is one number."""
    return frozen(np.full(storeys, array)) if array is not None and array.ndim == 0 else array


def kernel_springs(building: Building) -> tuple[tuple[dict[str, FloatArray]], dict[str, Any]]:
    """What the kernel takes of springs: numbers that are not the defaults, and laws where they are not Masing's."""
    stated = {name: values for name, values in building.springs.items() if not is_default(values, name)}
    laws: dict[str, Any] = {}
    if building.backbone is not None:
        laws["backbones"] = [None if points is None else np.array(points) for points in building.backbone]
    if any(name != "masing" for name in building.hysteresis):
        laws["hysteresis"] = list(building.hysteresis)
    return (stated,), laws


def of_storeys_alone(building: Building, owner: str) -> None:
    """Refuse a building with an elastic matrix where only shear buildings are taken."""
    if building.stiffness_matrix is not None:
        requirement = f"left out in {owner}; simulate takes it"
        raise refusal(InvalidScene, "stiffness_matrix", "building", requirement, "a matrix")


def chain_kernel(building: Building, owner: str) -> _kernel.Building:
    """Return what the kernel's chain engine takes of a building without an elastic matrix."""
    of_storeys_alone(building, owner)
    kernel: Any = building._kernel
    shear_building: _kernel.Building = kernel
    return shear_building


def _matrix(value: ArrayLike | None) -> FloatArray | None:
    if value is None:
        return None
    return as_array(value, "stiffness_matrix", "building", InvalidScene, dimensions=2)


def _check_heights(heights: FloatArray, storeys: int) -> None:
    """Heights that the kernel does not see, because they only make drift ratios."""
    if len(heights) != storeys:
        requirement = f"one number or a list of {storeys} values, one per storey"
        raise refusal(InvalidScene, "heights", "building", requirement, f"{len(heights)} values")
    for number, height in enumerate(heights, start=1):
        if not (np.isfinite(height) and height > 0.0):
            raise refusal(InvalidScene, "heights", f"storey {number}", "a positive number", f"{height:g}")


def _listed(values: FloatArray) -> str:
    """One number where all are equal, else a list."""
    if (values == values[0]).all():
        return f"{values[0]:.4g}"
    return "[" + ", ".join(f"{value:.4g}" for value in values) + "]"
