"""Scene as users meet it: a building and its blocks with their initial state."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.errors import InvalidScene
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, Value, as_array, as_name, brief, frozen, refusal
from seismass.base.views import view
from seismass.model.block import Block, SlidingBase, block_mass
from seismass.model.building import Building
from seismass.model.plausibility import model_remarks
from seismass.model.rack import Rack

_ChainScene: TypeAlias = _kernel.Scene
_GeneralScene: TypeAlias = _kernel.GeneralScene
_PlaneScene: TypeAlias = _kernel.PlaneScene


class Scene(Value):
    """A building and its blocks, or blocks on the ground alone, with their initial state.

    Parameters
    ----------
    building : Building or None
        None: there are blocks on the ground only.
    blocks : iterable of Block, optional
        Any number, in any order; several may share a floor. They are counted from 1 as listed.
    racks : iterable of Rack, optional
        Racks on floors or on the ground. Their goods that may slide are counted on from the blocks, rack by rack.
    other_direction : Building or True, optional
        There are two horizontal directions: the building in y, of the same masses; True: the same building, or the
        ground alone. Friction is of the circle. Blocks, racks and initial states may then differ in y.
    base : SlidingBase, optional
        A slab that carries all of it and slides on the ground; floor 0 is the slab then. None: all stands on the
        ground.
    fixed_goods : array_like, optional
        Mass of goods on each floor that move with it (kg): bolted ones, or a part of goods that rock. They are live
        load, so that shares and P-Delta count them, and are not in the damping of the building.
    initial_drift : array_like, optional
        Storey drifts at the start (m), within the elastic range. It and the next two need a building.
    initial_velocity : array_like, optional
        Floor velocities relative to the ground at the start (m/s). In two directions both have a pair [x, y] for each.
    collapse_drift : array_like, optional
        Drift (m) at which a storey counts as collapsed and the run ends, beside the limit that P-Delta sets.
    name, note : str, optional
        Labels; they do not take part in comparison.

    Attributes
    ----------
    building, blocks, racks, base, other_direction, initial_drift, initial_velocity, collapse_drift, name, note
        As given; `blocks` and `racks` are tuples, arrays are read-only.
    fixed_goods : ndarray, shape (storeys,), or None
        As given; None where there are none.

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
        "_chain_scene",
        "_general_scene",
        "_plane_scene",
        "base",
        "blocks",
        "building",
        "collapse_drift",
        "fixed_goods",
        "initial_drift",
        "initial_velocity",
        "name",
        "note",
        "other_direction",
        "racks",
    )
    _chain_scene: _ChainScene | None
    _general_scene: _GeneralScene | None
    _plane_scene: _PlaneScene | None
    building: Building | None
    blocks: tuple[Block, ...]
    racks: tuple[Rack, ...]
    base: SlidingBase | None
    other_direction: Building | bool
    fixed_goods: FloatArray | None
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
        racks: Iterable[Rack] = (),
        base: SlidingBase | None = None,
        other_direction: Building | bool = False,
        fixed_goods: ArrayLike | None = None,
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

        standing = _racks(racks)
        other = _other_direction(other_direction, building)
        if base is not None and not isinstance(base, SlidingBase):
            raise refusal(InvalidScene, "base", "scene", "a SlidingBase or None", brief(base))
        if base is not None and other is not False:
            raise refusal(InvalidScene, "base", "scene", "left out where there are two directions", brief(base))

        def per_storey(name: str, value: ArrayLike | None, *, pairs: bool = False) -> FloatArray | None:
            if value is None:
                return None
            if building is None:
                raise refusal(InvalidScene, name, "scene", "left out where there is no building", brief(value))
            if pairs and other is not False:
                return as_array(value, name, "scene", InvalidScene, dimensions=2)
            array = as_array(value, name, "scene", InvalidScene, or_number=True)
            return frozen(np.full(building.storeys, array)) if array.ndim == 0 else array

        self._set(
            building=building,
            blocks=placed,
            racks=standing,
            base=base,
            other_direction=other,
            fixed_goods=_fixed(per_storey("fixed_goods", fixed_goods), building),
            initial_drift=per_storey("initial_drift", initial_drift, pairs=True),
            initial_velocity=per_storey("initial_velocity", initial_velocity, pairs=True),
            collapse_drift=per_storey("collapse_drift", collapse_drift),
            name=as_name(name, "name", "scene", InvalidScene),
            note=as_name(note, "note", "scene", InvalidScene, lines=True),
        )
        masses = [block_mass(block, number, building) for number, block in enumerate(placed, start=1)]
        state: dict[str, Any] = {
            "initial_drift": self.initial_drift,
            "initial_velocity": self.initial_velocity,
            "collapse_drift": self.collapse_drift,
        }
        self._set(_chain_scene=None, _general_scene=None, _plane_scene=None)
        if other is not False:
            self._set(_plane_scene=_kernel.PlaneScene(*(one._of_general() for one in self._directions())))
            return
        self._refuse_plane_alone()
        kernel: Any = self._loaded_kernel()
        goods = [(block.floor, mass, *block.contact) for block, mass in zip(placed, masses, strict=True)]
        if self.engine == "chain":
            self._set(_chain_scene=_kernel.Scene(kernel, goods, **state))
            return
        self._set(_general_scene=self._of_general())

    def _loaded_kernel(self) -> Any:
        """The building as the kernel takes it, with the goods that are fixed to its floors."""
        building, fixed = self.building, self.fixed_goods
        if building is None or fixed is None:
            return None if building is None else building._kernel
        changes: dict[str, Any] = {"mass": building.mass + fixed, "damping": building.damping_matrix}
        if building.gravity_load is not None:
            changes["gravity_load"] = building.gravity_load + STANDARD_GRAVITY * fixed
        return building.replace(**changes)._kernel

    def _of_general(self) -> _GeneralScene:
        """What the general engine takes of a scene in one direction."""
        kernel: Any = self._loaded_kernel()
        goods = [
            (block.floor, block_mass(block, number, self.building), *block.contact, block.stop_numbers)
            for number, block in enumerate(self.blocks, start=1)
        ]
        racks = [rack.of_kernel(number, self.building) for number, rack in enumerate(self.racks, start=1)]
        sliding = None if self.base is None else self.base.of_kernel(self.building)
        state: dict[str, Any] = {
            "initial_drift": self.initial_drift,
            "initial_velocity": self.initial_velocity,
            "collapse_drift": self.collapse_drift,
        }
        return _kernel.GeneralScene(kernel, goods, racks, base=sliding, **state)

    def _directions(self) -> tuple[Scene, Scene]:
        """The scene in x and in y, each in one direction."""
        values: dict[str, Any] = {name: getattr(self, name) for name in ("initial_drift", "initial_velocity")}

        def of(axis: int) -> dict[str, Any]:
            for name, array in values.items():
                if array is not None and array.shape[1] != 2:
                    raise refusal(
                        InvalidScene, name, "scene", "a pair [x, y] for each storey", f"{array.shape[1]} numbers"
                    )
            return {name: None if array is None else array[:, axis] for name, array in values.items()}

        in_x = [block.replace(velocity=block.contact[2], stops_y=None) for block in self.blocks]
        of_x = [
            rack.replace(
                other_direction=None,
                blocks=[
                    each if each.fixed else each.replace(velocity=each.block.contact[2], stops_y=None)
                    for each in rack.blocks
                ],
            )
            for rack in self.racks
        ]
        in_y, of_y = [block.in_y() for block in self.blocks], [rack.in_y() for rack in self.racks]
        other: Any = self.building if self.other_direction is True else self.other_direction
        shared: dict[str, Any] = {"collapse_drift": self.collapse_drift, "fixed_goods": self.fixed_goods}
        x = Scene(self.building, in_x, racks=of_x, **of(0), **shared)
        return x, Scene(other, in_y, racks=of_y, **of(1), **shared)

    def _refuse_plane_alone(self) -> None:
        """Refuse what only two directions give a meaning."""
        requirement = "left out where there is one direction"
        for number, block in enumerate(self.goods, start=1):
            if block.of_plane is not None:
                raise refusal(InvalidScene, block.of_plane, f"block {number}", requirement, "one of two directions")
        for number, rack in enumerate(self.racks, start=1):
            if rack.other_direction is not None:
                raise refusal(InvalidScene, "other_direction", f"rack {number}", requirement, "one")

    @property
    def engine(self) -> Literal["chain", "general", "plane"]:
        """Which engine solves it: "chain" for shear buildings; "general" with racks, stops, a matrix or a
        base; "plane" in two directions.
        """
        if self.other_direction is not False:
            return "plane"
        return "general" if self._feature_outside_chain() is not None else "chain"

    @property
    def _engine_names(self) -> tuple[str, ...]:
        """Which engines solve its directions each by itself: the same one in one direction."""
        if self.other_direction is False:
            return (self.engine,)
        return tuple(each.engine for each in self._directions())

    def _feature_outside_chain(self) -> tuple[str, str, str] | None:
        """What the chain engine does not take: its parameter, whose it is, and what it is; None where it takes all."""
        if self.other_direction is not False:
            return "other_direction", "scene", "two directions"
        if self.building is not None and self.building.stiffness_matrix is not None:
            return "stiffness_matrix", "building", "a matrix"
        if self.base is not None:
            return "base", "scene", "a sliding base"
        if self.racks:
            return "racks", "scene", f"{len(self.racks)}"
        stopped = [number for number, block in enumerate(self.blocks, start=1) if block.stops is not None]
        return ("stops", f"block {stopped[0]}", "stops") if stopped else None

    def require_chain(self, owner: str) -> Scene:
        """Return the scene itself, for what takes scenes of the chain engine alone.

        Parameters
        ----------
        owner : str
            What takes it, as errors name it.

        Raises
        ------
        InvalidScene
            It has racks, stops, a stiffness matrix or a sliding base.
        """
        feature = self._feature_outside_chain()
        if feature is not None:
            parameter, owner_of_it, value = feature
            raise refusal(InvalidScene, parameter, owner_of_it, f"left out in {owner}; simulate takes it", value)
        return self

    @property
    def _kernel(self) -> _ChainScene:
        scene: Any = self.require_chain("this function")._chain_scene
        chain: _ChainScene = scene
        return chain

    @property
    def storeys(self) -> int:
        """Number of storeys; 0 without a building."""
        return 0 if self.building is None else self.building.storeys

    @property
    def block_mass(self) -> FloatArray:
        """Mass of each block (kg), shape (blocks,)."""
        return frozen([block_mass(block, number, self.building) for number, block in enumerate(self.blocks, start=1)])

    @property
    def goods(self) -> tuple[Block, ...]:
        """All blocks that may slide, in the order of results: those on floors, then those of racks, rack by rack.

        The floor of a block of a rack is its level.
        """
        of_racks = (block.block for rack in self.racks for block in rack.blocks if not block.fixed)
        return (*self.blocks, *of_racks)

    @property
    def goods_floor(self) -> tuple[int, ...]:
        """Floor under each of `goods`, for those of a rack the floor that it stands on; 0 is the ground."""
        of_racks = (rack.floor for rack in self.racks for block in rack.blocks if not block.fixed)
        return (*self.block_floor, *of_racks)

    @property
    def block_floor(self) -> tuple[int, ...]:
        """Floor of each block; 0 is the ground."""
        return tuple(block.floor for block in self.blocks)

    @property
    def geometric_stiffness(self) -> FloatArray:
        """P/h of each storey (N/m), the weight of the blocks included, shape (storeys,); zero without P-Delta."""
        if self.other_direction is not False:
            return self._directions()[0].geometric_stiffness
        kernel: Any = self._chain_scene if self._chain_scene is not None else self._general_scene
        values: FloatArray = kernel.geometric_stiffness
        return values

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is unlikely about building, goods, racks and base, as sentences; found when asked for."""
        return model_remarks(self.building, self.goods, self.racks, self.base)

    def _arguments(self) -> dict[str, Any]:
        return {
            "building": self.building,
            "blocks": self.blocks,
            "racks": self.racks,
            "base": self.base,
            "other_direction": self.other_direction,
            "fixed_goods": self.fixed_goods,
            "initial_drift": self.initial_drift,
            "initial_velocity": self.initial_velocity,
            "collapse_drift": self.collapse_drift,
            "name": self.name,
            "note": self.note,
        }

    def _content(self) -> tuple[Any, ...]:
        arrays = (self.fixed_goods, self.initial_drift, self.initial_velocity, self.collapse_drift)
        return (
            self.building,
            self.blocks,
            self.racks,
            self.base,
            self.other_direction,
            *(None if array is None else (array + 0.0).tobytes() for array in arrays),
        )

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        blocks = {0: "no block", 1: "1 block"}.get(len(self.blocks), f"{len(self.blocks)} blocks")
        racks = {0: "", 1: ", 1 rack"}.get(len(self.racks), f", {len(self.racks)} racks")
        racks += ", two directions" if self.other_direction is not False else ""
        racks += "" if self.base is None else ", sliding base"
        if self.building is None:
            return f"Scene({name}{'ground' if self.base is None else 'slab'} only, {blocks}{racks})"
        noun = "storey" if self.storeys == 1 else "storeys"
        return f"Scene({name}{self.storeys} {noun}, T1 = {self.building.periods[0]:.4g} s, {blocks}{racks})"


def _fixed(mass: FloatArray | None, building: Building | None) -> FloatArray | None:
    """Masses of fixed goods (kg) on the floors of a building."""
    if mass is None or building is None:
        return None
    if mass.shape != (building.storeys,) or not np.all(mass >= 0.0):
        requirement = f"{building.storeys} masses, one per floor, not negative"
        raise refusal(InvalidScene, "fixed_goods", "scene", requirement, brief(mass))
    if not building.mass_is_stated:
        raise refusal(
            InvalidScene, "fixed_goods", "scene", "left out where the building's mass is not stated", brief(mass)
        )
    return mass if mass.any() else None


def _other_direction(other: Building | bool, building: Building | None) -> Building | bool:
    """The building in y; False: there is one direction."""
    if isinstance(other, bool):
        return other
    if not isinstance(other, Building):
        raise refusal(InvalidScene, "other_direction", "scene", "a Building, True or False", brief(other))
    if building is None:
        raise refusal(
            InvalidScene, "other_direction", "scene", "True or False where there is no building", "a Building"
        )
    return other


def _racks(racks: Iterable[Rack]) -> tuple[Rack, ...]:
    try:
        standing = tuple(racks)
    except TypeError:
        raise refusal(InvalidScene, "racks", "scene", "a list of Racks", brief(racks)) from None
    for number, rack in enumerate(standing, start=1):
        if not isinstance(rack, Rack):
            raise refusal(InvalidScene, f"rack {number}", "scene", "a Rack", brief(rack))
    return standing


def floor_name(floor: int) -> str:
    """Return what a figure calls a floor."""
    return f"floor {floor}" if floor else "ground"


def spring_names(scene: Scene) -> tuple[str, ...]:
    """Return the names of storeys and of the levels of racks, in the order in which events number them."""
    storeys = (f"storey {number}" for number in range(1, scene.storeys + 1))
    return (*storeys, *(f"rack {rack} level {level}" for rack, level in rack_levels(scene)))


def rack_levels(scene: Scene) -> tuple[tuple[int, int], ...]:
    """Return rack and level of every level of every rack, both counted from 1, in the order of results."""
    racks = enumerate(scene.racks, start=1)
    return tuple((number, level) for number, rack in racks for level in range(1, rack.levels + 1))


def goods_names(scene: Scene) -> tuple[str, ...]:
    """Return where each block that may slide stands, in the order of results."""
    ground = floor_name(0) if scene.base is None else "slab"
    floors = (floor_name(block.floor) if block.floor else ground for block in scene.blocks)
    racks = enumerate(scene.racks, start=1)
    levels = (
        f"rack {number} level {block.level}" for number, rack in racks for block in rack.blocks if not block.fixed
    )
    return (*floors, *levels)


def goods_levels(scene: Scene) -> tuple[tuple[int, int], ...]:
    """Return rack and level of each block that may slide, in the order of results; rack 0 is the building."""
    floors = ((0, block.floor) for block in scene.blocks)
    racks = enumerate(scene.racks, start=1)
    levels = ((number, block.level) for number, rack in racks for block in rack.blocks if not block.fixed)
    return (*floors, *levels)
