"""Batches that several sections time: the study's, and random scenes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

import seismass as sm
from scenes import suite
from seismass import _kernel
from study import distinct_runs


@dataclass(frozen=True)
class Batch:
    """Scenes, motions, and pairs of their numbers."""

    scenes: list[sm.Scene]
    motions: list[sm.Motion]
    pairs: Any

    def on(self, threads: int) -> Callable[[], _kernel.Batch]:
        """Return the work of the kernel on so many threads: no table is made of it."""
        scenes = [scene._kernel for scene in self.scenes]
        motions = [motion._kernel for motion in self.motions]
        pairs = np.ascontiguousarray(self.pairs, dtype=np.int64)
        return lambda: _kernel.simulate_many(scenes, motions, pairs, threads=threads)


def study_batch(every: int = 1) -> Batch:
    """Return the distinct runs of the study, or every so-manieth of them."""
    runs = distinct_runs(suite())[::every]
    scenes = {scene: number for number, scene in enumerate(dict.fromkeys(scene for scene, _ in runs))}
    motions = {motion: number for number, motion in enumerate(dict.fromkeys(motion for _, motion in runs))}
    return Batch(list(scenes), list(motions), [(scenes[scene], motions[motion]) for scene, motion in runs])


def random_batch(count: int) -> Batch:
    """Return so many random scenes of 1 to 8 storeys, each under a motion of the suite scaled at random."""
    random = np.random.default_rng(20)
    scenes = []
    for _ in range(count):
        n = int(random.integers(1, 9))
        strength = random.uniform(0.05, 0.4) * np.linspace(1.0, 0.5, n)
        building = sm.Building.uniform(
            n,
            float(random.uniform(0.08, 0.2) * n),
            yield_shear_over_weight=strength,
            second_slope=float(random.uniform(0.0, 0.5)),
        )
        carries = random.random(n) < 0.8
        blocks = [
            sm.Block(floor + 1, mass_ratio=float(random.uniform(0.2, 2.0)), mu=float(random.uniform(0.05, 0.6)))
            for floor in np.flatnonzero(carries).tolist()
        ]
        scenes.append(sm.Scene(building, blocks))
    records = list(suite())
    motions = [record.scaled(float(random.uniform(0.2, 1.0)) / record.pga_g).motion for record in records]
    return Batch(scenes, motions, [(number, number % len(motions)) for number in range(count)])
