"""Scenes with racks and walls for the benchmark of the general engine, and each as plain numbers for OpenSees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import seismass as sm

FloatArray = NDArray[np.float64]
FLOOR_MASS = 2.0e5
"""Mass of every floor (kg)."""


@dataclass(frozen=True)
class Tree:
    """A scene as plain numbers: nodes from 1, each with a spring to its parent (0: the ground), and dampers and elastic
    springs between pairs of nodes.

    Attributes
    ----------
    mass : ndarray, shape (nodes,)
        Masses (kg).
    parent : list of int
        Parent of each node.
    springs : list of list of (float, float)
        Of each node, parallel elastic-perfectly-plastic springs: stiffness (N/m) and yield force (N; infinite:
        elastic). damping, elastic : ndarray, shape (nodes, nodes)
        Matrices over displacements relative to the ground (N s/m and N/m).
    blocks : list of (int, float, float)
        Node, mass (kg) and friction coefficient of each block.
    """

    mass: FloatArray
    parent: list[int]
    springs: list[list[tuple[float, float]]]
    damping: FloatArray
    elastic: FloatArray
    blocks: list[tuple[int, float, float]]


def _springs(building: sm.Building) -> list[list[tuple[float, float]]]:
    """Parallel springs of each storey, whose third slope must be zero."""
    parts = []
    for k, r2, vy, omega in zip(
        building.stiffness, building.second_slope, building.yield_shear, building.overstrength, strict=True
    ):
        if np.isinf(vy) or k == 0.0:
            parts.append([(float(k), np.inf)] if k else [])
            continue
        second = vy / k + (omega - 1.0) * vy / (r2 * k)
        parts.append([(float((1.0 - r2) * k), float((1.0 - r2) * vy)), (float(r2 * k), float(r2 * k * second))])
    return parts


def tree(scene: sm.Scene) -> Tree:
    """Return a scene of a building with racks as plain numbers."""
    building: Any = scene.building
    mass, parent = list(building.mass), list(range(building.storeys))
    springs, blocks = (
        _springs(building),
        [(block.floor, float(m), block.mu_s) for block, m in zip(scene.blocks, scene.block_mass, strict=True)],
    )
    alone = [(rack, rack.alone(float(building.mass[rack.floor - 1]))) for rack in scene.racks]
    nodes = building.storeys + sum(rack.levels for rack in scene.racks)
    damping, elastic = np.zeros((nodes, nodes)), np.zeros((nodes, nodes))
    damping[: building.storeys, : building.storeys] = building.damping_matrix
    if building.stiffness_matrix is not None:
        elastic[: building.storeys, : building.storeys] = building.stiffness_matrix
    for rack, frame in alone:
        first, here = len(mass), rack.floor - 1
        parent += [rack.floor, *range(first + 1, first + rack.levels)]
        springs += _springs(frame)
        # Velocities relative to the floor.
        relative = np.zeros((rack.levels, nodes))
        relative[:, first : first + rack.levels] = np.eye(rack.levels)
        relative[:, here] = -1.0
        damping += relative.T @ frame.damping_matrix @ relative
        levels = np.array(frame.mass)
        for block, goods in zip((b for b in rack.blocks if not b.fixed), rack.sliding_masses(building), strict=True):
            levels[block.level - 1] -= goods
            blocks.append((first + block.level, goods, block.block.mu_s))
        mass += levels.tolist()
    return Tree(np.array(mass), parent, springs, damping, elastic, blocks)


def cantilever(storeys: int, height: float, stiffness: float) -> FloatArray:
    """Return the matrix over the floors (N/m) of a flexural cantilever of uniform EI (N m2), by its flexibility."""
    z = height * np.arange(1, storeys + 1)
    low, high = np.minimum.outer(z, z), np.maximum.outer(z, z)
    matrix = np.linalg.inv(low**2 * (3.0 * high - low) / (6.0 * stiffness))
    symmetric: FloatArray = 0.5 * (matrix + matrix.T)
    return symmetric


def frame(storeys: int, period: float, strength: float | None, **options: Any) -> sm.Building:
    """Return a shear frame of equal storeys, whose strengths over the weight fall linearly to half at the roof."""
    strengths = None if strength is None else strength * np.linspace(1.0, 0.5, storeys)
    return sm.Building.uniform(storeys, period, mass=FLOOR_MASS, yield_shear_over_weight=strengths, **options)


def rack(floor: int, levels: int, *, fixed: bool, period: float = 0.4) -> sm.Rack:
    """Return a rack whose goods are half a floor's mass, and slide with mu = 0.2, or are fixed."""
    friction: dict[str, Any] = {"fixed": True} if fixed else {"mu": 0.2}
    goods = [sm.RackBlock(level, mass_ratio=0.5 / levels, **friction) for level in range(1, levels + 1)]
    return sm.Rack(floor, levels, period=period, level_mass_ratio=0.05 / levels, blocks=goods)


def of_nodes(nodes: int, *, events: bool) -> sm.Scene:
    """Return a building whose floors and rack levels are so many, with yielding and sliding or with neither."""
    storeys = max(2, nodes // 4)
    racks, left, floor = [], nodes - storeys, 1
    while left:
        levels = min(left, -(-(nodes - storeys) // storeys))
        racks.append(rack(floor, levels, fixed=not events))
        left, floor = left - levels, floor + 1
    return sm.Scene(frame(storeys, 0.12 * storeys, 0.15 if events else None), racks=racks)


def chain_of_nodes(nodes: int, *, events: bool) -> sm.Scene:
    """Return a shear building of so many storeys for the chain engine, with goods on a quarter of the floors."""
    blocks = [sm.Block(floor, mass_ratio=0.5, mu=0.2) for floor in range(1, 1 + (nodes // 4 if events else 0))]
    return sm.Scene(frame(nodes, 0.12 * nodes, 0.15 if events else None), blocks)


def rack_scene() -> sm.Scene:
    """Return a yielding two-storey building with a rack of three levels on floor 1 and goods on both."""
    building = frame(2, 0.4, 0.15, damping=0.05)
    return sm.Scene(building, [sm.Block(2, mass_ratio=0.3, mu=0.25)], racks=[rack(1, 3, fixed=False)])


def wall_scene() -> sm.Scene:
    """Return a wall beside a yielding frame of four storeys, with goods on every floor."""
    building = frame(4, 0.8, 0.08)
    together = sm.Building(
        building.mass,
        building.stiffness,
        yield_shear=building.yield_shear,
        stiffness_matrix=cantilever(4, 3.0, 2.0e10),
        damping=0.05,
    )
    return sm.Scene(together, sm.blocks_on_floors([0.5] * 4, mu=0.15))


def plane_scene() -> sm.Scene:
    """Return a yielding two-storey building in two directions, with goods on both floors."""
    blocks = [sm.Block(1, mass_ratio=0.4, mu=0.2), sm.Block(2, mass_ratio=0.5, mu=0.25)]
    return sm.Scene(frame(2, 0.4, 0.15, damping=0.05), blocks, other_direction=True)


def in_plane(storeys: int, *, events: bool) -> sm.Scene:
    """Return a building in two directions with goods on every floor, that yields and slides or does neither."""
    building = frame(storeys, 0.12 * storeys, 0.15 if events else None)
    return sm.Scene(building, sm.blocks_on_floors([0.5] * storeys, mu=0.2 if events else 50.0), other_direction=True)


def stiff_plane_scene() -> sm.Scene:
    """Return a building in two directions with a rack whose levels have a twentieth of the mass of their goods."""
    goods = [sm.RackBlock(level, mass=1000.0, mu=0.2) for level in (1, 2, 3)]
    levels = sm.Rack(1, 3, period=0.5, level_mass=50.0, blocks=goods)
    building = sm.Building.uniform(2, 0.4, mass=2e4, yield_shear_over_weight=0.3)
    return sm.Scene(building, racks=[levels], other_direction=True)
