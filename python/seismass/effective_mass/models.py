"""The model of a code: a share of the live load attached to its floors as mass, and no goods that slide."""

from __future__ import annotations

from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, brief, is_one_of, refusal
from seismass.model.building import Building
from seismass.model.scene import Scene

ModelDamping: TypeAlias = Literal["same", "ratio"]
"""Damping of a model with attached mass: the matrix C of the real building, or its ratio in the model's own modes."""


def attached_scene(scene: Scene, fraction: float, damping: ModelDamping = "same") -> Scene:
    """Return the building of a scene with a share of its live load attached to the floors as mass, without blocks.

    Stiffness and strength stay as they are, and so does P/h: the whole weight of the goods acts in P-Delta whatever
    share of their mass is attached.

    Parameters
    ----------
    scene : Scene
        Building and goods. Goods on the ground slab do not load the building and are left out.
    fraction : float
        Share of the mass of each block that is attached to its floor, from 0 to 1.
    damping : {"same", "ratio"}
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
    checked = check_loaded(scene)
    share = as_number(fraction, "fraction", "attached scene", InvalidOption)
    if not 0.0 <= share <= 1.0:
        raise refusal(InvalidOption, "fraction", "attached scene", "between 0 and 1", f"{share:g}")
    return attached(checked, share, check_damping(damping, "attached scene"))


def attached(scene: Scene, fraction: float, damping: ModelDamping) -> Scene:
    """Return the model of `attached_scene` for arguments that are known to be valid."""
    building = building_of(scene)
    changes: dict[str, Any] = {"mass": building.mass + fraction * goods_mass(scene)}
    if damping == "same":
        changes["damping"] = building.damping_matrix
    if scene.geometric_stiffness.any():
        changes |= {"gravity_load": None, "geometric_stiffness": scene.geometric_stiffness}
    return Scene(
        building.replace(**changes),
        initial_drift=scene.initial_drift,
        initial_velocity=scene.initial_velocity,
        collapse_drift=scene.collapse_drift,
        name=scene.name,
    )


def building_of(scene: Scene) -> Building:
    """Return the building of a scene that has one."""
    building = scene.on_ground("effective mass").building
    if building is None:
        raise refusal(InvalidScene, "building", "effective mass", "given", "None")
    return building


def goods_mass(scene: Scene) -> FloatArray:
    """Return the mass of the goods on each floor (kg), shape (storeys,)."""
    mass = np.zeros(scene.storeys)
    for floor, block_mass in zip(scene.block_floor, scene.block_mass, strict=True):
        if floor > 0:
            mass[floor - 1] += block_mass
    return mass


def full_weight(scene: Scene) -> float:
    """Return the weight of building and goods (N)."""
    return STANDARD_GRAVITY * float(building_of(scene).mass.sum() + goods_mass(scene).sum())


def friction(scene: Scene) -> float:
    """Return the kinetic friction coefficient of the goods on the floors, averaged by mass."""
    on_floor = np.array(scene.block_floor) > 0
    mass = scene.block_mass[on_floor]
    return float(mass @ np.array([block.mu_k for block in scene.blocks])[on_floor] / mass.sum())


def check_loaded(scene: Any) -> Scene:
    """Return a scene whose building carries at least one block."""
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", "effective mass", "a Scene", brief(scene))
    scene.of_chain("effective mass")
    building_of(scene)
    if not any(floor > 0 for floor in scene.block_floor):
        requirement = "at least one on a floor of the building, as there is no live load otherwise"
        raise refusal(InvalidScene, "blocks", "effective mass", requirement, "none")
    return scene


def check_damping(damping: Any, owner: str) -> ModelDamping:
    """Return a convention of damping."""
    if not is_one_of(damping, get_args(ModelDamping)):
        raise refusal(InvalidOption, "damping", owner, "same or ratio", brief(damping))
    checked: ModelDamping = damping
    return checked


SAME_DAMPING: Final[ModelDamping] = "same"
"""Default: with it goods that never slide have an effective fraction of exactly 1."""
