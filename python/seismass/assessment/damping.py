"""Damping forces beside spring forces: a storey whose damping carries what its spring cannot is a doubt.

Damping in every mode is made with the first stiffness and stays through yielding. In a stiff, weak storey (a sliding
mat, a slider, a friction damper) it then carries several times the strength of the spring.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from seismass.base.values import FloatArray
from seismass.model.scene import Scene
from seismass.runs.simulate import simulate

MAX_RATIO: Final = 1.5
"""Peak of spring and damping force of a storey over that of its spring force: 1.15 to 1.2 in ordinary frames."""


def force_ratios(scene: Scene, motions: list[Any]) -> FloatArray:
    """Return the mean over the motions of each storey's peak of spring plus damping force (the inertia force of all
    above) over the peak of its spring force, shape (storeys,); 1 for a storey without a force.
    """
    building = scene.building
    assert building is not None
    matrix = building.damping_matrix
    found = []
    for motion in motions:
        response = simulate(scene, getattr(motion, "motion", motion), histories=True, events=False)
        forces = response.floor_velocity @ matrix.T
        damping = np.cumsum(forces[:, ::-1], axis=1)[:, ::-1]
        springs = response.storey_force
        spring = np.abs(springs).max(axis=0)
        both = np.abs(springs + damping).max(axis=0)
        found.append(np.divide(both, spring, out=np.ones(len(spring)), where=spring > 0.0))
    mean: FloatArray = np.mean(found, axis=0)
    return mean


def damping_doubts(scene: Scene, motions: list[Any]) -> tuple[str, ...]:
    """Return a sentence about the storey whose damping carries most, where it carries too much."""
    ratios = force_ratios(scene, motions)
    storey = int(np.argmax(ratios))
    if ratios[storey] <= MAX_RATIO:
        return ()
    return (
        f"spring and damping of storey {storey + 1} carry {ratios[storey]:.2g} times the peak force of its spring (1.2 "
        "in ordinary frames): damping carries what the yielding storey cannot; is it a slider, a mat or far stiffer "
        "than the others?",
    )
