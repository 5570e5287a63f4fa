"""The scenes of the work-precision benchmark and their motions, and each scene as plain numbers for the peers.

Motions are recordings where SEISMASS_SHARED names a folder with records/paper_seven.csv, otherwise built in.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

import seismass as sm
from seismass.studies.study import StudyParameters, study_buildings

FloatArray = NDArray[np.float64]

DAMPING: Final = 0.05
PEAK_G: Final = 0.7
"""Peak of the motion of the scenes outside the study (g)."""
STUDY: Final = (("storage", 2, 2.0, 0.5), ("commercial", 3, 4.0, 1.0), ("storage", 4, 6.0, 1.5))
"""Occupancy, storeys, R, alpha of the three scenes of the study, and their motions' numbers:"""
STUDY_MOTIONS: Final = (5, 6, 3)


@dataclass(frozen=True)
class BenchmarkScene:
    """A scene, its motion, and what the page says of them."""

    name: str
    title: str
    scene: sm.Scene
    motion: sm.Motion
    motion_name: str

    @property
    def building(self) -> sm.Building:
        """The building, which every scene here has."""
        if self.scene.building is None:
            raise ValueError(f"building of {self.name} must be given; got None")
        return self.scene.building


@dataclass(frozen=True)
class System:
    """A scene as plain numbers. One block per floor at most; `alpha` is block mass over floor mass, 0 where bare.

    `elements` has, per storey, the two elastic-perfectly-plastic springs as (stiffness, strength), an infinite strength
    where the storey stays elastic; `hardening` is the stiffness that never yields.
    """

    mass: FloatArray
    damping: FloatArray
    elements: FloatArray
    hardening: FloatArray
    block_mass: FloatArray
    mu: FloatArray
    floors: tuple[int, ...]
    acceleration: FloatArray
    dt: float

    @property
    def storeys(self) -> int:
        """Number of storeys."""
        return len(self.mass)

    @property
    def stiffness(self) -> FloatArray:
        """Initial stiffness of each storey (N/m)."""
        total: FloatArray = self.elements[:, :, 0].sum(axis=1) + self.hardening
        return total


def system(bench: BenchmarkScene) -> System:
    """Return a scene as plain numbers."""
    building = bench.building
    k, r2, r3 = building.stiffness, building.second_slope, building.third_slope
    with np.errstate(divide="ignore", invalid="ignore"):
        first = building.yield_shear / k
        second = first + (building.overstrength - 1.0) * building.yield_shear / (r2 * k)
    elements = np.empty((building.storeys, 2, 2))
    for place, (stiffness, drift) in enumerate((((1.0 - r2) * k, first), ((r2 - r3) * k, second))):
        elements[:, place, 0] = stiffness
        elements[:, place, 1] = np.where(stiffness > 0.0, stiffness * drift, np.inf)
    block_mass, mu = np.zeros(building.storeys), np.zeros(building.storeys)
    for block in bench.scene.blocks:
        ratio = block.mass_ratio
        if ratio is None or block.floor == 0 or block_mass[block.floor - 1] or block.mu_s != block.mu_k:
            raise ValueError(f"blocks of {bench.name} must be one per floor, by mass ratio, with one mu")
        block_mass[block.floor - 1] = ratio * building.mass[block.floor - 1]
        mu[block.floor - 1] = block.mu_s
    return System(
        mass=np.array(building.mass),
        damping=np.array(building.damping_matrix),
        elements=elements,
        hardening=np.array(r3 * k),
        block_mass=block_mass,
        mu=mu,
        floors=tuple(block.floor - 1 for block in bench.scene.blocks),
        acceleration=np.array(bench.motion.acceleration),
        dt=bench.motion.dt,
    )


def suite() -> sm.records.Suite:
    """Return the recordings named by SEISMASS_SHARED, or the built-in motions."""
    shared = os.environ.get("SEISMASS_SHARED")
    if shared:
        return sm.read_suite(Path(shared) / "records" / "paper_seven.csv")
    return sm.builtin_suite("seven")


def _name(record: sm.Record) -> str:
    return f"{record.name} (synthetic)" if record.synthetic else record.name


def section4(second_slope: float, mu: float = 0.3) -> sm.Scene:
    """Return the three-storey building of the paper's section 4 with a block of the floor's mass on each floor."""
    building = sm.Building.uniform(
        3, 0.60, yield_shear_over_weight=[0.24, 0.20, 0.12], second_slope=second_slope, damping=DAMPING
    )
    return sm.Scene(building, sm.blocks_on_floors([1.0] * 3, mu=mu))


def at_half_step(bench: BenchmarkScene) -> BenchmarkScene:
    """Return the scene under the same motion at half its time step."""
    acceleration = bench.motion.acceleration
    twice = np.empty(2 * acceleration.size - 1)
    twice[::2] = acceleration
    twice[1::2] = 0.5 * (acceleration[:-1] + acceleration[1:])
    motion = sm.Motion(twice, 0.5 * bench.motion.dt)
    return replace(bench, motion=motion, motion_name=f"{bench.motion_name} at {motion.dt:g} s")


def _study_scenes(motions: sm.records.Suite) -> Iterator[BenchmarkScene]:
    scaling = sm.scaling.scale_asce7_10(motions, sm.TargetSpectrum.asce7(1.07, 0.61, 8.0), 1.0, between=False)

    def spectrum(periods: FloatArray) -> FloatArray:
        spectra = sm.response_spectrum([record.scaled(f) for record, f in pairs], periods)
        mean: FloatArray = np.asarray(spectra).mean(axis=0)
        return mean

    pairs = list(zip(motions, scaling.factors, strict=True))
    buildings: dict[tuple[Any, ...], sm.Scene] = {}
    for building in study_buildings(StudyParameters(), spectrum):
        labels = building.labels
        key = (labels["occupancy"], labels["storeys"], labels["R"], labels["alpha"])
        buildings[key] = building.scenes["real"]
    for key, number in zip(STUDY, STUDY_MOTIONS, strict=True):
        occupancy, storeys, reduction, alpha = key
        record, factor = pairs[number - 1]
        yield BenchmarkScene(
            name=f"study-{storeys}",
            title=f"Study: {storeys} storeys, {occupancy}, R = {reduction:g}, alpha = {alpha:g}",
            scene=buildings[key],
            motion=record.scaled(factor).motion,
            motion_name=f"{_name(record)}, x {factor:.3f}",
        )


def scenes() -> list[BenchmarkScene]:
    """Return all scenes of the benchmark."""
    motions = suite()
    record = motions[2]
    motion = record.scaled(PEAK_G / record.pga_g).motion
    name = f"{_name(record)}, {PEAK_G} g"
    elastic = sm.Scene(sm.Building.uniform(4, 0.57, damping=DAMPING))
    soft, stiff = (
        BenchmarkScene(f"section4-{slope:g}", f"Section 4, r2 = {slope:g}", section4(slope), motion, name)
        for slope in (0.05, 0.5)
    )
    return [
        soft,
        stiff,
        *(
            replace(at_half_step(bench), name=f"{bench.name}-fine", title=f"{bench.title}, half the step")
            for bench in (soft, stiff)
        ),
        *_study_scenes(motions),
        BenchmarkScene("sliding", "All sliding: section 4, mu = 0.05", section4(0.05, mu=0.05), motion, name),
        BenchmarkScene("elastic", "Elastic: 4 storeys, no block", elastic, motion, name),
    ]
