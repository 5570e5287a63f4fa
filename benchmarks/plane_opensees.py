"""OpenSees on a scene in two horizontal directions: goods on flat sliders, whose friction is coupled on a circle.

The model is that of general_opensees.py in both directions. A slider carries the weight of its goods, so the vertical
is a third direction, without mass; before it slides it is a spring.
"""

from __future__ import annotations

from typing import Final

import numpy as np

import seismass as sm
from general_opensees import BLOCKS, GRAVITY, GROUND, HALVINGS, Outcome, advance, connect, ops, prepare
from general_scenes import FloatArray, tree

VERTICAL: Final = 1e4
"""Vertical stiffness of a slider over the weight of its goods (1/m)."""


def _model(scene: sm.Scene, motions: tuple[sm.Motion, sm.Motion], friction: float) -> None:
    directions = [tree(scene), tree(scene if scene.other_direction is True else _other(scene))]
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(GROUND, 0.0, 0.0, 0.0)
    ops.fix(GROUND, *[1] * 6)
    for node, mass in enumerate(map(float, directions[0].mass), start=1):
        ops.node(node, 0.0, 0.0, 0.0)
        ops.mass(node, mass, mass, 0.0, 0.0, 0.0, 0.0)
        ops.fix(node, 0, 0, 1, 1, 1, 1)
    tag = 0

    def material(name: str, *numbers: float) -> int:
        nonlocal tag
        tag += 1
        ops.uniaxialMaterial(name, tag, *map(float, numbers))
        return tag

    for axis, plain in enumerate(directions, start=1):

        def element(one: int, other: int, name: str, *numbers: float, axis: int = axis) -> None:
            made = material(name, *numbers)
            ops.element("zeroLength", made, one, other, "-mat", made, "-dir", axis)

        connect(plain, element)
    stiffest = max(k for plain in directions for parts in plain.springs for k, _ in parts)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    for number, (node, mass, mu) in enumerate(directions[0].blocks, start=BLOCKS):
        ops.node(number, 0.0, 0.0, 0.0)
        ops.mass(number, mass, mass, 0.0, 0.0, 0.0, 0.0)
        ops.fix(number, 0, 0, 0, 1, 1, 1)
        ops.load(number, 0.0, 0.0, -mass * GRAVITY, 0.0, 0.0, 0.0)
        ops.frictionModel("Coulomb", number, mu)
        bearing, free = material("Elastic", VERTICAL * mass * GRAVITY), material("Elastic", 1.0)
        others = ("-T", free, "-My", free, "-Mz", free, "-orient", 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
        ops.element("flatSliderBearing", number, node, number, number, friction * stiffest, "-P", bearing, *others)
    for axis, motion in enumerate(motions, start=1):
        ops.timeSeries("Path", axis + 1, "-dt", motion.dt, "-values", *motion.acceleration.tolist())
        ops.pattern("UniformExcitation", axis + 1, axis, "-accel", axis + 1)
    prepare(directions[0])


def _other(scene: sm.Scene) -> sm.Scene:
    """The scene in y as one in one direction."""
    building = scene.building if scene.other_direction is True else scene.other_direction
    assert isinstance(building, sm.Building)
    return sm.Scene(building, scene.blocks, racks=scene.racks)


def run(scene: sm.Scene, motions: tuple[sm.Motion, sm.Motion], friction: float, substeps: int) -> Outcome:
    """Return the largest lengths of drift and slip vectors at the steps. Before they slide, sliders have this stiffness
    over that of the stiffest spring.

    Raises
    ------
    RuntimeError
        A step does not converge.
    """
    ops.logFile("/dev/null", "-noEcho")
    _model(scene, motions, friction)
    plain = tree(scene)
    nodes = [*range(1, len(plain.mass) + 1), *range(BLOCKS, BLOCKS + len(plain.blocks))]
    parent, carried = np.array(plain.parent), np.array([node for node, _, _ in plain.blocks], dtype=int)
    count, dt = len(plain.mass), motions[0].dt
    displacements: FloatArray = np.zeros(((motions[0].samples - 1) * substeps + 1, len(nodes), 2))
    for i in range(1, len(displacements)):
        advance(dt / substeps, HALVINGS)
        displacements[i] = [[ops.nodeDisp(node, axis) for axis in (1, 2)] for node in nodes]
    ops.wipe()
    u = np.concatenate([np.zeros((len(displacements), 1, 2)), displacements[:, :count]], axis=1)
    drift, slip = u[:, 1:] - u[:, parent], displacements[:, count:] - u[:, carried]
    return Outcome(np.hypot(*np.moveaxis(drift, 2, 0)).max(axis=0), np.hypot(*np.moveaxis(slip, 2, 0)).max(axis=0))
