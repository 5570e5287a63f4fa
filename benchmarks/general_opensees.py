"""OpenSees on scenes with racks and walls, modelled as its users would, with the dampers and matrices of the scene.

A matrix between nodes is a set of springs or dashpots between every pair of them and to the ground: -K_ij between i
and j, the sum of row i to the ground; some are negative. Friction is a stiff elastic-perfectly-plastic spring.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Final

import numpy as np

import seismass as sm
from general_scenes import FloatArray, Tree, tree

try:
    import openseespy.opensees as ops_module

    ops: Any = ops_module
except (ImportError, RuntimeError):
    ops = None

GRAVITY: Final = 9.80665
GROUND: Final = 5000
BLOCKS: Final = 1000
RETRIES: Final = ("Newton", "ModifiedNewton", "NewtonLineSearch")
HALVINGS: Final = 8


@dataclass(frozen=True)
class Outcome:
    """Largest drifts of the nodes' springs and slips of the blocks at the steps (m)."""

    drift: FloatArray
    slip: FloatArray


def _model(plain: Tree, friction: float, motion: sm.Motion) -> None:
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(GROUND, 0.0)
    ops.fix(GROUND, 1)
    for node, mass in enumerate(plain.mass, start=1):
        ops.node(node, 0.0)
        ops.mass(node, float(mass))
    tag = 0

    def element(one: int, other: int, material: str, *numbers: float) -> None:
        nonlocal tag
        tag += 1
        ops.uniaxialMaterial(material, tag, *map(float, numbers))
        ops.element("zeroLength", tag, one, other, "-mat", tag, "-dir", 1)

    connect(plain, element)
    stiffness = friction * max(k for parts in plain.springs for k, _ in parts)
    for number, (node, mass, mu) in enumerate(plain.blocks, start=BLOCKS):
        ops.node(number, 0.0)
        ops.mass(number, mass)
        element(node, number, "ElasticPP", stiffness, mu * mass * GRAVITY / stiffness)
    ops.timeSeries("Path", 1, "-dt", motion.dt, "-values", *motion.acceleration.tolist())
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    prepare(plain)


def connect(plain: Tree, element: Callable[..., None]) -> None:
    """Connect nodes by springs, matrix and dampers; `element` makes one of two nodes, a material and its numbers."""

    def matrix(values: FloatArray, material: str, *more: float) -> None:
        for i, j in combinations(range(len(values)), 2):
            if values[i, j]:
                element(i + 1, j + 1, material, -values[i, j], *more)
        for i, total in enumerate(values.sum(axis=1), start=1):
            if abs(total) > 1e-12 * abs(values).max():
                element(GROUND, i, material, total, *more)

    for node, (below, parts) in enumerate(zip(plain.parent, plain.springs, strict=True), start=1):
        for stiffness, strength in parts:
            if np.isinf(strength):
                element(below or GROUND, node, "Elastic", stiffness)
            else:
                element(below or GROUND, node, "ElasticPP", stiffness, strength / stiffness)
    matrix(plain.elastic, "Elastic")
    matrix(plain.damping, "Viscous", 1.0)


def prepare(plain: Tree) -> None:
    """Prepare the analysis in time."""
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", 1e-8 * float(plain.mass.max() * GRAVITY), 50)
    ops.algorithm("KrylovNewton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def advance(step: float, halvings: int) -> None:
    """One step; where it does not converge other algorithms are tried, then two steps of half the length."""
    if ops.analyze(1, step) == 0:
        return
    for algorithm in RETRIES:
        ops.algorithm(algorithm)
        converged = ops.analyze(1, step) == 0
        ops.algorithm("KrylovNewton")
        if converged:
            return
    if halvings == 0:
        raise RuntimeError(f"did not converge at t = {ops.getTime():.3f} s with any algorithm, nor in shorter steps")
    for _ in range(2):
        advance(0.5 * step, halvings - 1)


def run(scene: sm.Scene, motion: sm.Motion, friction: float, substeps: int) -> Outcome:
    """Return the peaks at the steps, with friction springs of this stiffness over that of the stiffest spring.

    Raises
    ------
    RuntimeError
        A step does not converge.
    """
    plain = tree(scene)
    ops.logFile("/dev/null", "-noEcho")
    _model(plain, friction, motion)
    nodes = [*range(1, len(plain.mass) + 1), *range(BLOCKS, BLOCKS + len(plain.blocks))]
    parent, carried = np.array(plain.parent), np.array([node for node, _, _ in plain.blocks], dtype=int)
    displacements = np.zeros(((motion.samples - 1) * substeps + 1, len(nodes)))
    step, displacement = motion.dt / substeps, ops.nodeDisp
    for i in range(1, len(displacements)):
        advance(step, HALVINGS)
        displacements[i] = [displacement(node, 1) for node in nodes]
    ops.wipe()
    count = len(plain.mass)
    u = np.column_stack([np.zeros(len(displacements)), displacements[:, :count]])
    drift, slip = u[:, 1:] - u[:, parent], displacements[:, count:] - u[:, carried]
    return Outcome(np.abs(drift).max(axis=0), np.abs(slip).max(axis=0, initial=0.0))
