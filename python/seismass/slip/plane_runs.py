"""Runs in two directions: slip as a vector with its path, by side, and beside that of one direction alone."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.model.scene import Scene
from seismass.records.intensity import integrals
from seismass.runs.plane_motion import PlaneMotion
from seismass.runs.plane_response import PlaneResponse
from seismass.runs.simulate import simulate
from seismass.slip.clearance import signed_peaks
from seismass.slip.places import places_of

VECTOR = 2
"""Place of the length of the vector among peaks of `PlaneResponse`."""


@dataclass(frozen=True, slots=True)
class PlaneSlip:
    """Slip of the blocks in x and y (m), shape (blocks, 2), or (motions, blocks, 2): largest absolute, to each side, at
    the end, and `alone`, the largest under the motion in that direction alone.
    """

    peak: FloatArray
    plus: FloatArray
    minus: FloatArray
    residual: FloatArray
    alone: FloatArray

    @classmethod
    def of_all(cls, solved: list[PlaneSlip]) -> PlaneSlip:
        """Return the slips under all motions."""
        return cls(*(np.array([getattr(each, field.name) for each in solved]) for field in fields(cls)))


@dataclass(frozen=True, slots=True)
class PlaneSolved:
    """Runs of a scene under one pair. Acceleration (m/s2), velocity (m/s) and demand (acceleration over g + a_v) are
    peak lengths of what a block stands on; in the building alone or with goods attached NaN on collapse.
    """

    slip: PlaneSlip
    real: PlaneResponse
    ground: PlaneResponse
    moving: NDArray[np.bool_]
    acceleration: FloatArray
    velocity: FloatArray
    demand: FloatArray
    alone_acceleration: FloatArray
    full_acceleration: FloatArray


def solve_pair(
    scene: Scene, on_the_ground: Scene, alone: Scene | None, full: Scene | None, motions: PlaneMotion
) -> PlaneSolved:
    """Solve a scene in two directions, its goods on the ground, and each direction by itself; `alone` and `full` (all
    goods attached) are None where no goods stand on the building.
    """
    x, y = motions
    nodes = np.array([place.node for place in places_of(scene)], dtype=np.int64)
    real = simulate(scene, motions, histories=True, events=False)
    ground_velocity = np.stack([integrals(each.acceleration, each.dt)[0] for each in motions], axis=1)
    standing = np.concatenate([0.0 * ground_velocity[:, None, :], real.floor_velocity, real.rack_velocity], axis=1)
    rate = real.block_velocity - standing[:, nodes]
    sides = [
        signed_peaks(real.slip[:, :, axis], rate[:, :, axis], x.dt, real.peak_slip[:, axis]) for axis in range(VECTOR)
    ]
    each_alone = [
        simulate(one, motion, events=False).peak_slip for one, motion in zip(scene._directions(), motions, strict=True)
    ]
    ground_peak = float(np.hypot(x.acceleration, y.acceleration).max())
    accelerations = _peaks_at_nodes(real, ground_peak)
    speeds = np.nanmax(np.hypot(*np.moveaxis(standing + ground_velocity[:, None, :], -1, 0)), axis=0)
    return PlaneSolved(
        slip=PlaneSlip(
            peak=real.peak_slip[:, :VECTOR],
            plus=np.stack([plus for plus, _ in sides], axis=1),
            minus=np.stack([minus for _, minus in sides], axis=1),
            residual=real.residual_slip,
            alone=np.stack(each_alone, axis=1),
        ),
        real=real,
        ground=simulate(on_the_ground, motions, events=False),
        moving=np.hypot(*np.moveaxis(rate[-1], -1, 0)) > 0.0,
        acceleration=accelerations[nodes],
        velocity=speeds[nodes],
        demand=_demands(real, motions, accelerations)[nodes],
        alone_acceleration=_without_goods(alone, motions, nodes, ground_peak),
        full_acceleration=_without_goods(full, motions, nodes, ground_peak),
    )


def _peaks_at_nodes(response: PlaneResponse, ground: float) -> FloatArray:
    """Peak length of the acceleration of the ground, the floors and the rack levels (m/s2)."""
    of_floors, of_levels = (response.peak_floor_acceleration, response.peak_rack_acceleration)
    return np.concatenate([[ground], of_floors[:, VECTOR], of_levels[:, VECTOR]])


def _without_goods(scene: Scene | None, motions: PlaneMotion, nodes: NDArray[np.int64], ground: float) -> FloatArray:
    """Peak acceleration under each block in a model without sliding goods; NaN after a collapse."""
    if scene is None:
        return np.full(len(nodes), ground)
    response = simulate(scene, motions, events=False)
    if response.status == "collapsed":
        return np.where(nodes > 0, np.nan, ground)
    return _peaks_at_nodes(response, ground)[nodes]


def _demands(response: PlaneResponse, motions: PlaneMotion, peaks: FloatArray) -> FloatArray:
    """Largest abs(a)/(g + a_v) of all nodes: in continuous time without vertical motion, of the samples with it."""
    x, y = motions
    if x.vertical is None:
        demands: FloatArray = peaks / STANDARD_GRAVITY
        return demands
    ground = np.stack([x.acceleration, y.acceleration], axis=1)[:, None, :]
    every = np.concatenate([ground, response.floor_acceleration, response.rack_acceleration], axis=1)
    weight = STANDARD_GRAVITY + x.vertical
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(weight[:, None] > 0.0, np.hypot(every[..., 0], every[..., 1]) / weight[:, None], np.inf)
    found: FloatArray = np.nanmax(share, axis=0)
    return found
