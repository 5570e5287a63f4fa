"""The model of a code: a share of the live load attached to its floors as mass, and no goods that slide."""

from __future__ import annotations

from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_array, as_number, brief, refusal
from seismass.model.block import SlidingBase
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.runs.peaks import Peaks

DEFAULT_FRACTIONS: Final = np.linspace(0.0, 1.0, 21)
"""Shares at which models are solved before roots are refined; intervals are linear between them."""


def check_cap(drift_cap: Any, owner: str) -> float:
    """Return a drift cap over the storey height; an infinite one leaves drifts as they are."""
    cap = as_number(drift_cap, "drift_cap", owner, InvalidOption)
    if not cap > 0.0:
        raise refusal(InvalidOption, "drift_cap", owner, "a positive number", f"{cap:g}")
    return cap


def check_fractions(fractions: Any, owner: str) -> FloatArray:
    """Return shares in increasing order from 0 to 1, by default in steps of 0.05."""
    if fractions is None:
        return DEFAULT_FRACTIONS
    shares = as_array(fractions, "fractions", owner, InvalidOption)
    requirement = "a list in increasing order that begins with 0 and ends with 1"
    if len(shares) < 2 or shares[0] != 0.0 or shares[-1] != 1.0 or not (np.diff(shares) > 0.0).all():
        raise refusal(InvalidOption, "fractions", owner, requirement, brief(shares.tolist()))
    return shares


LARGEST_SHARE: Final = 2.0
"""Up to which share models are solved where the real building may drift more than the fully attached one."""
SHARES_BEYOND: Final = np.linspace(1.0, LARGEST_SHARE, 41)[1:]
"""Shares above 1 at which models are solved before the first crossing is refined."""
FROM_ONE: Final = np.concatenate([[1.0], SHARES_BEYOND])
"""The same with 1 before them."""


def goes_beyond(scene: Scene) -> bool:
    """Whether shares above 1 are sought: there are racks on floors, or goods with stops."""
    return any(rack.floor > 0 for rack in scene.racks) or any(
        (block.stops is not None or block.stops_y is not None) and block.floor > 0 for block in scene.blocks
    )


def joined(first: Peaks, second: Peaks) -> Peaks:
    """Return the peaks of the scenes of both, one after the other."""
    return Peaks(
        np.concatenate([first.drift, second.drift]),
        np.concatenate([first.base_shear, second.base_shear]),
        np.concatenate([first.slides, second.slides]),
        np.concatenate([first.collapsed, second.collapsed]),
        first.cap,
    )


ModelDamping: TypeAlias = Literal["same", "ratio"]
"""Damping of a model with attached mass: the matrix C of the real building, or its ratio in the model's own modes."""


def attached_scene(scene: Scene, fraction: float, damping: ModelDamping = "same") -> Scene:
    """Return the building of a scene with a share of its live load attached to the floors as mass, without blocks.

    In two directions it has two as well. Stiffness and strength stay as they are, walls too, and so does P/h: the whole
    weight of the goods acts in P-Delta whatever share of their mass is attached. Racks are lumped: the share of all
    their goods, fixed ones too, and the whole mass of their frames on the floor on which they stand. A sliding base
    keeps the friction and the restoring force of the whole weight: its coefficients, and 1/R, grow by the real weight
    over that of the model.

    Parameters
    ----------
    scene : Scene
        Building and goods. Goods and racks on the ground slab do not load the building and are left out.
    fraction : float
        Share of the mass of each block that is attached to its floor, from 0 to 1; to 2 where there are racks or stops,
        whose goods may act more than attached ones.
    damping : {"same", "ratio"}, default "same"
        "same": the damping matrix of the real building. "ratio": its damping made again for the model, as a ratio in
        the model's own modes; goods that never slide then have no share that gives the same drift.

    Raises
    ------
    InvalidScene
        The scene has no building, or no block on one of its floors.
    InvalidOption
        The fraction is not between 0 and 1, or the damping is another word.

    Examples
    --------
    >>> import seismass as sm
    >>> scene = sm.Scene(sm.Building.uniform(2, 0.4), sm.blocks_on_floors([1.0, 0.0], mu=0.3))
    >>> sm.attached_scene(scene, 0.25).building.mass.tolist()
    [1.25, 1.0]
    """
    checked = check_any_load(scene)
    share = as_number(fraction, "fraction", "attached scene", InvalidOption)
    largest = LARGEST_SHARE if goes_beyond(checked) else 1.0
    if not 0.0 <= share <= largest:
        raise refusal(InvalidOption, "fraction", "attached scene", f"between 0 and {largest:g}", f"{share:g}")
    return attached(checked, share, check_damping(damping, "attached scene"))


def attached(scene: Scene, fraction: float, damping: ModelDamping) -> Scene:
    """Return the model of `attached_scene` for arguments that are known to be valid."""
    if scene.other_direction is not False:
        x, y = (attached(each, fraction, damping) for each in scene._directions())
        return Scene(
            x.building,
            other_direction=building_of(y),
            initial_drift=scene.initial_drift,
            initial_velocity=scene.initial_velocity,
            collapse_drift=scene.collapse_drift,
            name=scene.name,
        )
    building = building_of(scene)
    changes: dict[str, Any] = {"mass": building.mass + frame_mass(scene) + fraction * goods_mass(scene)}
    if damping == "same":
        changes["damping"] = building.damping_matrix
    if scene.geometric_stiffness.any():
        changes |= {"gravity_load": None, "geometric_stiffness": scene.geometric_stiffness}
    return Scene(
        building.replace(**changes),
        initial_drift=scene.initial_drift,
        initial_velocity=scene.initial_velocity,
        collapse_drift=scene.collapse_drift,
        base=base_of_model(scene, changes["mass"]),
        name=scene.name,
    )


def base_of_model(scene: Scene, mass: FloatArray) -> SlidingBase | None:
    """Return the sliding base under a model of the building of a scene; None where the scene has none. Friction and
    restoring force stay those of the weight of the scene, whatever the floor masses (kg) of the model.
    """
    if scene.base is None:
        return None
    building, base = building_of(scene), scene.base
    slab = base.slab_mass(building)
    on_slab = sum(m for floor, m in zip(scene.block_floor, scene.block_mass, strict=True) if floor == 0)
    on_slab += sum(rack.goods_mass(building) + rack.frame_mass(building) for rack in scene.racks if rack.floor == 0)
    whole = slab + on_slab + float((building.mass + goods_mass(scene) + frame_mass(scene)).sum())
    more = whole / (slab + float(mass.sum()))
    return SlidingBase(
        mu_s=more * base.mu_s,
        mu_k=more * base.mu_k,
        radius=None if base.radius is None else base.radius / more,
        mass_ratio=slab / float(mass[0]),
    )


def building_of(scene: Scene, owner: str = "effective mass") -> Building:
    """Return the building of a scene that has one."""
    building = scene.building
    if building is None:
        raise refusal(InvalidScene, "building", owner, "given", "None")
    return building


def goods_mass(scene: Scene) -> FloatArray:
    """Return the mass of the goods on each floor, fixed ones and those on its racks included (kg), shape (storeys,)."""
    mass = np.zeros(scene.storeys) if scene.fixed_goods is None else scene.fixed_goods.copy()
    for floor, block_mass in zip(scene.block_floor, scene.block_mass, strict=True):
        if floor > 0:
            mass[floor - 1] += block_mass
    for rack in scene.racks:
        if rack.floor > 0:
            mass[rack.floor - 1] += rack.goods_mass(scene.building)
    return mass


def frame_mass(scene: Scene) -> FloatArray:
    """Return the mass of the frames of the racks on each floor (kg), shape (storeys,)."""
    mass = np.zeros(scene.storeys)
    for rack in scene.racks:
        if rack.floor > 0:
            mass[rack.floor - 1] += rack.frame_mass(scene.building)
    return mass


def full_weight(scene: Scene) -> float:
    """Return the weight of building, racks and goods (N)."""
    mass = building_of(scene).mass.sum() + goods_mass(scene).sum() + frame_mass(scene).sum()
    return STANDARD_GRAVITY * float(mass)


def friction(scene: Scene, *, with_static: bool = False) -> float:
    """Return the mass-weighted mean kinetic friction of the goods that may slide above the ground, or the mean of
    static and kinetic friction; infinite where all goods are fixed.
    """
    on_floor = np.array(scene.goods_floor, dtype=np.int64) > 0
    of_racks = (mass for rack in scene.racks for mass in rack.sliding_masses(scene.building))
    mass = np.array([*scene.block_mass, *of_racks])[on_floor]
    if not len(mass):
        return float("inf")
    static = [block.mu_s if with_static else block.mu_k for block in scene.goods]
    both = 0.5 * (np.array(static) + np.array([block.mu_k for block in scene.goods]))
    return float(mass @ both[on_floor] / mass.sum())


def check_any_load(scene: Any, owner: str = "effective mass") -> Scene:
    """Return a scene whose building carries at least one block, on a floor or on a rack."""
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", owner, "a Scene", brief(scene))
    building_of(scene, owner)
    if not goods_mass(scene).any():
        requirement = "at least one on a floor of the building, as there is no live load otherwise"
        raise refusal(InvalidScene, "blocks", owner, requirement, "none")
    return scene


def check_loaded(scene: Any, owner: str) -> Scene:
    """Return a scene of the chain engine whose building carries at least one block."""
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", owner, "a Scene", brief(scene))
    return check_any_load(scene.require_chain(owner), owner)


def check_damping(damping: Any, owner: str) -> ModelDamping:
    """Return a convention of damping."""
    checked: ModelDamping = as_word(damping, get_args(ModelDamping), "damping", owner)
    return checked


SAME_DAMPING: Final[ModelDamping] = "same"
"""Default: with it goods that never slide have an effective fraction of exactly 1."""
