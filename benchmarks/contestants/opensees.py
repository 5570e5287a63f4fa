"""OpenSees through openseespy, modelled as its users would, and with the damping matrix of the scene.

Storeys are elastic-perfectly-plastic springs in parallel; linear dashpots between every pair of floors and to the
ground reproduce the damping matrix. Friction is a stiff elastic-plastic spring or the material CoulombDamper. Peaks are
the envelopes of the elements over all steps.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import Any, Final

import numpy as np

from contestants.base import EVERYWHERE, MAIN, Absent, Failed, FloatArray, Outcome, Setting
from scenes import DAMPING, BenchmarkScene, System, system

try:
    import openseespy.opensees as ops_module

    ops: Any = ops_module
except (ImportError, RuntimeError):
    ops = None

GRAVITY: Final = 9.80665
GROUND: Final = 1000
BLOCKS: Final = 100
"""Node and element numbers of blocks are those of their floors plus this."""
RETRIES: Final = (("Newton",), ("ModifiedNewton",), ("NewtonLineSearch",))
HALVINGS: Final = 8
TOLERANCE: Final = 1e-8
"""Largest norm of the residual forces over the weight of a floor; tighter ones meet the rounding of stiff springs."""
CENTRAL_DIFFERENCE: Final = ("CentralDifference",)


@dataclass(frozen=True)
class Recipe:
    """How the scene is modelled and integrated.

    `friction` is the stiffness of a friction spring over that of storey 1, or None for CoulombDamper.
    """

    friction: float | None
    substeps: int
    algorithm: tuple[Any, ...] = ("KrylovNewton",)
    integrator: tuple[Any, ...] = ("Newmark", 0.5, 0.25)
    modal_damping: bool = False
    ladder: bool = False


def check_stability(plain: System, recipe: Recipe) -> None:
    """Refuse steps that the central difference method does not bear: it needs h w < 2 for the highest frequency w."""
    springs = np.full(len(plain.floors), (recipe.friction or 0.0) * plain.stiffness[0])
    stiffness = np.concatenate((plain.stiffness, springs))
    mass = np.concatenate((plain.mass, plain.block_mass[list(plain.floors)]))
    lengthening = np.eye(len(mass)) - np.eye(len(mass), k=-1)
    for place, floor in enumerate(plain.floors, start=plain.storeys):
        lengthening[place, place - 1] = 0.0
        lengthening[place, floor] = -1.0
    # K = B' k B for the lengthenings B u of the springs, so that w is a singular value.
    highest = float(np.linalg.norm(np.sqrt(stiffness)[:, None] * lengthening / np.sqrt(mass), 2))
    least = 0.5 * plain.dt * highest
    if recipe.substeps <= least:
        raise Failed(
            f"substeps must be above {least:.1f}, for steps below 2 / {highest:.0f} rad/s; got {recipe.substeps}"
        )


def _springs(plain: System) -> None:
    for i in range(plain.storeys):
        tags = []
        for e, (stiffness, strength) in enumerate(plain.elements[i]):
            if stiffness > 0.0:
                tags.append(10 * (i + 1) + e)
                if np.isfinite(strength):
                    ops.uniaxialMaterial("ElasticPP", tags[-1], float(stiffness), float(strength / stiffness))
                else:
                    ops.uniaxialMaterial("Elastic", tags[-1], float(stiffness))
        if plain.hardening[i] > 0.0:
            tags.append(10 * (i + 1) + 2)
            ops.uniaxialMaterial("Elastic", tags[-1], float(plain.hardening[i]))
        ops.uniaxialMaterial("Parallel", 10 * (i + 1) + 9, *tags)
        below = i if i > 0 else GROUND
        ops.element("zeroLength", i + 1, below, i + 1, "-mat", 10 * (i + 1) + 9, "-dir", 1)


def _dashpots(plain: System) -> None:
    n = plain.storeys
    pairs = [(i + 1, j + 1, -plain.damping[i, j]) for i, j in combinations(range(n), 2)]
    pairs += [(GROUND, i + 1, plain.damping[i].sum()) for i in range(n)]
    for number, (one, other, coefficient) in enumerate(pairs, start=500):
        ops.uniaxialMaterial("Viscous", number, float(coefficient), 1.0)
        ops.element("zeroLength", number, one, other, "-mat", number, "-dir", 1)


def _blocks(plain: System, friction: float | None) -> None:
    for i in plain.floors:
        limit = float(plain.mu[i] * plain.block_mass[i] * GRAVITY)
        tag = BLOCKS + i + 1
        stiffness = float((1e3 if friction is None else friction) * plain.stiffness[0])
        if friction is None:
            ops.uniaxialMaterial("CoulombDamper", tag, 0.0, limit)
        else:
            ops.uniaxialMaterial("ElasticPP", tag, stiffness, limit / stiffness)
        ops.element("zeroLength", tag, i + 1, tag, "-mat", tag, "-dir", 1)


def _model(plain: System, recipe: Recipe) -> None:
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(GROUND, 0.0)
    ops.fix(GROUND, 1)
    for i in range(plain.storeys):
        ops.node(i + 1, 0.0)
        ops.mass(i + 1, float(plain.mass[i]))
    for i in plain.floors:
        ops.node(BLOCKS + i + 1, 0.0)
        ops.mass(BLOCKS + i + 1, float(plain.block_mass[i]))
    _springs(plain)
    if not recipe.modal_damping:
        _dashpots(plain)
    _blocks(plain, recipe.friction)
    ops.timeSeries("Path", 1, "-dt", plain.dt, "-values", *plain.acceleration.tolist())
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    if recipe.modal_damping:
        ops.eigen("-fullGenLapack", plain.storeys + len(plain.floors))
        ops.modalDamping(DAMPING)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", TOLERANCE * float(plain.mass.max() * GRAVITY), 50)
    ops.algorithm(*recipe.algorithm)
    ops.integrator(*recipe.integrator)
    ops.analysis("Transient")


def _advance(recipe: Recipe, h: float) -> None:
    """One sample interval."""
    if not recipe.ladder:
        if ops.analyze(recipe.substeps, h) != 0:
            raise Failed(f"did not converge at t = {ops.getTime():.3f} s")
        return
    for _ in range(recipe.substeps):
        _climb(recipe, h, HALVINGS)


def _climb(recipe: Recipe, h: float, halvings: int) -> None:
    """One step; where it does not converge other algorithms are tried, then two steps of half the length."""
    if ops.analyze(1, h) == 0:
        return
    for algorithm in RETRIES:
        ops.algorithm(*algorithm)
        converged = ops.analyze(1, h) == 0
        ops.algorithm(*recipe.algorithm)
        if converged:
            return
    if halvings == 0:
        raise Failed(f"did not converge at t = {ops.getTime():.3f} s with any algorithm, nor in shorter steps")
    for _ in range(2):
        _climb(recipe, 0.5 * h, halvings - 1)


def _envelopes(folder: Path) -> tuple[Path, Path]:
    return folder / "storeys.txt", folder / "blocks.txt"


def run(bench: BenchmarkScene, recipe: Recipe) -> Outcome:
    """Build the model, run it and collect displacements at the samples and the envelopes."""
    if ops is None:
        raise Absent("openseespy")
    plain = system(bench)
    if recipe.integrator == CENTRAL_DIFFERENCE:
        check_stability(plain, recipe)
    with tempfile.TemporaryDirectory() as folder:
        storeys, blocks = _envelopes(Path(folder))
        try:
            ops.logFile(str(Path(folder) / "log.txt"), "-noEcho")
            return _run(plain, recipe, storeys, blocks)
        finally:
            ops.wipe()


def _run(plain: System, recipe: Recipe, storeys: Path, blocks: Path) -> Outcome:
    _model(plain, recipe)
    floors = list(range(1, plain.storeys + 1))
    carried = [BLOCKS + i + 1 for i in plain.floors]
    for path, numbers in ((storeys, floors), (blocks, carried)):
        if numbers:
            options = ("-file", str(path), "-precision", 16, "-ele", *numbers)
            ops.recorder("EnvelopeElement", *options, "deformation")
    samples, nodes = len(plain.acceleration), floors + carried
    displacement = np.zeros((samples, len(nodes)))
    h, node_disp = plain.dt / recipe.substeps, ops.nodeDisp
    for i in range(1, samples):
        _advance(recipe, h)
        displacement[i] = [node_disp(node, 1) for node in nodes]
    ops.wipe()
    u = displacement[:, : plain.storeys]
    drift = np.diff(u, axis=1, prepend=0.0)
    slip = displacement[:, plain.storeys :] - u[:, list(plain.floors)]
    if not np.isfinite(displacement).all():
        raise Failed("the response is not finite")

    def peaks(path: Path, count: int) -> FloatArray:
        if not count:
            return np.zeros(0)
        table: FloatArray = np.atleast_2d(np.loadtxt(path))[-1]
        return table[-count:]

    return Outcome(drift, slip, peaks(storeys, len(floors)), peaks(blocks, len(carried)), slip[-1])


def _setting(
    family: str, label: str, recipe: Recipe, scenes: Sequence[str] = EVERYWHERE, *, quick: bool = False
) -> Setting:
    work: Callable[[BenchmarkScene], Outcome] = partial(run, recipe=recipe)
    return Setting(family, label, work, scenes=scenes, quick=quick)


def settings() -> list[Setting]:
    """Return springs of several stiffnesses, CoulombDamper, central difference, and modal damping for what it does."""
    spring, coulomb = "OpenSees, friction spring", "OpenSees, CoulombDamper"
    central, modal = "OpenSees, central difference", "OpenSees, modalDamping"
    newton: dict[str, Any] = {"algorithm": ("Newton",)}
    # The matrix of the method, of masses and dashpots, is the same in every step.
    explicit: dict[str, Any] = {"algorithm": ("Linear", "-factorOnce"), "integrator": CENTRAL_DIFFERENCE}
    return [
        _setting(spring, "1e2 k, dt", Recipe(1e2, 1), quick=True),
        _setting(spring, "1e2 k, dt / 5", Recipe(1e2, 5)),
        _setting(spring, "1e3 k, dt", Recipe(1e3, 1)),
        _setting(spring, "1e4 k, dt", Recipe(1e4, 1), quick=True),
        _setting(spring, "1e4 k, dt, retries", Recipe(1e4, 1, ladder=True)),
        _setting(spring, "1e4 k, dt / 5", Recipe(1e4, 5)),
        _setting(spring, "1e5 k, dt / 50", Recipe(1e5, 50), MAIN),
        _setting(coulomb, "dt", Recipe(None, 1, **newton), quick=True),
        _setting(coulomb, "dt / 5", Recipe(None, 5, **newton)),
        _setting(coulomb, "dt / 20", Recipe(None, 20, **newton)),
        _setting(coulomb, "dt / 100", Recipe(None, 100, **newton), MAIN),
        _setting(central, "1e4 k, dt / 25", Recipe(1e4, 25, **explicit), quick=True),
        _setting(central, "1e5 k, dt / 80", Recipe(1e5, 80, **explicit)),
        _setting(central, "4e5 k, dt / 160", Recipe(4e5, 160, **explicit)),
        _setting(modal, "1e4 k, dt / 10", Recipe(1e4, 10, modal_damping=True, ladder=True), MAIN),
    ]
