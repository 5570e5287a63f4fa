"""Runs of a scene, of its goods on the ground, of the building alone and with all goods attached, and
published estimates beside them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import InvalidOption
from seismass.base.statistics import or_infinite
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, as_one_of
from seismass.base.views import Card
from seismass.effective_mass.models import ModelDamping, attached
from seismass.model.block import Block
from seismass.model.scene import Scene
from seismass.model.tipping import demand_in_g
from seismass.motions.motion import Motion
from seismass.motions.records.intensity import integrals, peak_velocity
from seismass.motions.spectra import response_spectrum
from seismass.runs.plane import PlaneMotion, PlaneResponse
from seismass.runs.response import Response
from seismass.runs.simulate import simulate
from seismass.studies.slip.clearance import (
    accelerations_at_nodes,
    histories_at_nodes,
    places_of,
    signed_peaks,
    without_loose_goods,
)

BOUND_LIMIT: Final = 6.0
"""Largest A/N of the bound of Newmark (1965); beyond it the bound is 6 V^2/(2 g N)."""
ASCE43_DAMPING: Final = 0.10
"""Damping ratio of the spectrum of ASCE/SEI 43-05, A.1."""
_PERIODS: Final = np.geomspace(0.02, 20.0, 401)
"""Periods (s) among which the frequency of ASCE/SEI 43-05 is sought: 1/20 to 50 Hz, steps of 1.7 %."""


@dataclass(frozen=True, slots=True)
class Base(Card):
    """The motion of what a block stands on.

    Attributes
    ----------
    motion : Motion
        Its absolute acceleration.
    acceleration, velocity, vertical : float
        Peaks of the absolute acceleration (m/s2), of the absolute velocity (m/s) and of the vertical acceleration
        (m/s2; zero without one).
    """

    motion: Motion
    acceleration: float
    velocity: float
    vertical: float


def _friction(base: Base, mu_k: float) -> float:
    """The friction coefficient of a bound, as a number."""
    as_one_of(base, Base, "base", "sliding distance", InvalidOption)
    return as_number(mu_k, "mu_k", "sliding distance", InvalidOption)


def newmark_pulse(base: Base, mu_k: float) -> float:
    """Return V^2/(2 mu g) (1 - mu g/A): the slip under a rectangular pulse with peaks A and V (m).

    Newmark (1965), Géotechnique 15:139-160; exact for one pulse of constant acceleration A that lasts V/A. No slip
    where A <= mu g.
    """
    limit = _friction(base, mu_k) * STANDARD_GRAVITY
    if not base.acceleration > limit:
        return 0.0
    return np.inf if limit == 0.0 else base.velocity**2 / (2.0 * limit) * (1.0 - limit / base.acceleration)


def newmark_bound(base: Base, mu_k: float) -> float:
    """Return V^2/(2 mu g) min(A/(mu g), 6): an upper bound for earthquakes (m).

    Newmark (1965), for a block that slides to one side only, and so of several pulses that add up; a block on a level
    floor slides back as well. From memory, not checked in a source.
    """
    limit = _friction(base, mu_k) * STANDARD_GRAVITY
    if not base.acceleration > limit:
        return 0.0
    if limit == 0.0:
        return np.inf
    return base.velocity**2 / (2.0 * limit) * min(base.acceleration / limit, BOUND_LIMIT)


def asce43(base: Base, mu_k: float) -> float:
    """Return the sliding distance of ASCE/SEI 43-05, Appendix A.1 (m).

    mu_e = mu (1 - 0.4 A_v/g), c_s = 2 mu_e g, and c_s/(2 pi f_es)^2, where f_es is the lowest frequency at which the
    spectral acceleration at 10 % damping equals c_s: the spectral displacement there. mu_e, c_s and f_es were read in a
    copy of the appendix; the last expression is from memory, as it was illegible there. The standard calls it a
    conservatively biased best estimate and combines two horizontal directions, of which the model has one. Zero where
    the spectrum is below c_s everywhere; infinite where c_s is zero, or exceeded at 0.05 Hz still.
    """
    effective = _friction(base, mu_k) * max(1.0 - 0.4 * base.vertical / STANDARD_GRAVITY, 0.0)
    coefficient = 2.0 * effective * STANDARD_GRAVITY
    spectrum = response_spectrum(base.motion, _PERIODS, ASCE43_DAMPING)[0]
    above = np.flatnonzero(spectrum >= coefficient)
    if not len(above):
        return 0.0
    last = int(above[-1])
    if last == len(_PERIODS) - 1 or coefficient == 0.0:
        return np.inf
    falling = np.log(spectrum[last : last + 2])
    weight = (falling[0] - np.log(coefficient)) / (falling[0] - falling[1])
    log_period = (1.0 - weight) * np.log(_PERIODS[last]) + weight * np.log(_PERIODS[last + 1])
    return float(coefficient * (np.exp(log_period) / (2.0 * np.pi)) ** 2)


ESTIMATES: Final[dict[str, Callable[[Base, float], float]]] = {
    "newmark_pulse": newmark_pulse,
    "newmark_bound": newmark_bound,
    "asce43": asce43,
}
"""Estimates by name; each takes the motion of the base and the kinetic friction coefficient."""

TITLES: Final[dict[str, str]] = {
    "newmark_pulse": "Newmark (1965), one pulse",
    "newmark_bound": "Newmark (1965), bound for one side",
    "asce43": "ASCE/SEI 43-05, A.1",
    "rigid_block": "rigid block, exact",
}
"""What texts and figures call estimates; the last is the kernel's block on that base."""


def estimates(base: Base, mu_k: float) -> dict[str, float]:
    """Return all estimates by name (m)."""
    return {name: float(function(base, mu_k)) for name, function in ESTIMATES.items()}


def log_ratio(estimate: FloatArray, exact: FloatArray) -> FloatArray:
    """Return ln(estimate/exact) of the pairs in which both are positive and finite."""
    both = (estimate > 0.0) & (exact > 0.0) & np.isfinite(estimate) & np.isfinite(exact)
    return np.asarray(np.log(estimate[both] / exact[both]), dtype=np.float64)


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


def _peaks_at_nodes(response: Response | PlaneResponse, ground: float) -> FloatArray:
    """Peak acceleration, or its length, of the ground, the floors and the rack levels (m/s2)."""
    if isinstance(response, Response):
        return accelerations_at_nodes(response, ground)
    of_floors, of_levels = (response.peak_floor_acceleration, response.peak_rack_acceleration)
    return np.concatenate([[ground], of_floors[:, VECTOR], of_levels[:, VECTOR]])


def _peaks(response: Response | PlaneResponse | None, nodes: NDArray[np.int64], ground: float) -> FloatArray:
    """Peak acceleration under each block in a model without sliding goods; NaN after a collapse."""
    if response is None:
        return np.full(len(nodes), ground)
    if response.status == "collapsed":
        return np.where((nodes > 0) | (response.scene.base is not None), np.nan, ground)
    return _peaks_at_nodes(response, ground)[nodes]


def _demands_plane_runs(response: PlaneResponse, motions: PlaneMotion, peaks: FloatArray) -> FloatArray:
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
    demand: FloatArray = np.nanmax(share, axis=0)
    return demand


@dataclass(frozen=True, slots=True)
class SlipModels:
    """The scene, its goods on the ground, and the building alone and with all goods attached (None without goods).
    Racks stand in the latter two, empty or with all goods attached to their levels, and both on the base of the scene.
    """

    scene: Scene
    ground: Scene
    alone: Scene | None
    full: Scene | None

    @classmethod
    def of(cls, scene: Scene, damping: ModelDamping) -> SlipModels:
        """Return the models of a scene."""
        goods = [on_ground(block) for block in scene.goods]
        ground = Scene(None, goods, other_direction=scene.other_direction is not False)
        if scene.racks or scene.base is not None:
            alone, full = (without_loose_goods(scene, attached=share) for share in (False, True))
            return cls(scene, ground, alone, full)
        if not any(floor > 0 for floor in scene.block_floor):
            return cls(scene, ground, None, None)
        return cls(scene, ground, attached(scene, 0.0, damping), attached(scene, 1.0, damping))


def on_ground(block: Block) -> Block:
    """Return a block with the same friction on the ground, without stops, where its mass does not matter."""
    return block.replace(floor=0, mass=1.0, mass_ratio=None, velocity=None, stops=None, stops_y=None)


@dataclass(frozen=True, slots=True)
class EstimateRow:
    """Estimates of the slip (m) by name of one block (from 0) under one motion, that of the ground or of the block's
    floor (or rack level) in the building alone; "rigid_block" is exact for that motion.
    """

    block: int
    base: str
    values: dict[str, float]


@dataclass(frozen=True, slots=True)
class SlipRuns:
    """Runs under one motion, arrays of shape (blocks,), or under all, (motions, blocks), in SI; `collapsed` has no
    blocks, `demand` is abs(a)/(g + a_v). In `plane` they are lengths, `plus` and `minus` in x, without estimates.
    """

    peak: FloatArray
    plus: FloatArray
    minus: FloatArray
    residual: FloatArray
    path: FloatArray
    contact_force: FloatArray
    contact_velocity: FloatArray
    moving: NDArray[np.bool_]
    collapsed: NDArray[np.bool_]
    ground_peak: FloatArray
    ground_residual: FloatArray
    acceleration: FloatArray
    velocity: FloatArray
    demand: FloatArray
    alone_acceleration: FloatArray
    full_acceleration: FloatArray
    plane: PlaneSlip | None = None
    estimates: tuple[EstimateRow, ...] = ()

    @classmethod
    def of(cls, solved: list[SlipRuns]) -> SlipRuns:
        """Return the runs under all motions, without estimates."""
        names = [field.name for field in fields(cls) if field.name not in ("plane", "estimates")]
        in_plane = [each.plane for each in solved if each.plane is not None]
        arrays: dict[str, Any] = {name: np.array([getattr(each, name) for each in solved]) for name in names}
        return cls(**arrays, plane=PlaneSlip.of_all(in_plane) if in_plane else None)

    def or_infinite(self, values: FloatArray) -> FloatArray:
        """Return values (motions, blocks) with infinity in runs that collapsed: goods of a fallen building are lost."""
        return or_infinite(values, self.collapsed[:, None])


def solve_motion(models: SlipModels, motion: Motion, other: Motion | None = None) -> SlipRuns:
    """Solve the models under one motion, or in two directions under that in x and the other one in y."""
    if other is not None:
        return _solve_pair(models, (motion, other))
    scene = models.scene
    nodes = np.array([place.node for place in places_of(scene)], dtype=np.int64)
    sliding = simulate(scene, motion, histories=True, events=False)
    ground = simulate(models.ground, motion, events=False)
    ground_velocity, _ = integrals(motion.acceleration, motion.dt)
    velocity = float(peak_velocity(motion.acceleration, motion.dt, ground_velocity))
    base = Base(motion, motion.pga, velocity, _peak_vertical(motion))
    standing = histories_at_nodes(sliding, "velocity", 0.0 * ground_velocity)
    rate = sliding.block_velocity - standing[:, nodes]
    plus, minus = signed_peaks(sliding.slip, rate, motion.dt, sliding.peak_slip)
    alone = None if models.alone is None else simulate(models.alone, motion, histories=True, events=False)
    full = None if models.full is None else simulate(models.full, motion, events=False)
    rows = [
        EstimateRow(number, "ground", {**estimates(base, block.mu_k), "rigid_block": float(ground.peak_slip[number])})
        for number, block in enumerate(scene.goods)
    ]
    if alone is not None and alone.status == "completed":
        rows += _floor_estimates(scene, alone, motion, ground_velocity)
    accelerations = _peaks_at_nodes(sliding, base.acceleration)
    velocities = np.nanmax(np.abs(standing + ground_velocity[:, None]), axis=0)
    if scene.base is None:
        velocities[0] = base.velocity
    return SlipRuns(
        peak=sliding.peak_slip,
        plus=plus,
        minus=minus,
        residual=sliding.residual_slip,
        path=sliding.slip_path,
        contact_force=sliding.peak_contact_force,
        contact_velocity=sliding.peak_contact_velocity,
        moving=np.abs(rate[-1]) > 0.0,
        collapsed=np.array(sliding.status == "collapsed"),
        ground_peak=ground.peak_slip,
        ground_residual=ground.residual_slip,
        acceleration=accelerations[nodes],
        velocity=velocities[nodes],
        demand=_demands(sliding, motion, accelerations)[nodes],
        alone_acceleration=_peaks(alone, nodes, base.acceleration),
        full_acceleration=_peaks(full, nodes, base.acceleration),
        estimates=tuple(rows),
    )


def _solve_pair(models: SlipModels, motions: PlaneMotion) -> SlipRuns:
    """Solve the models in two directions, and each direction by itself."""
    x, y = motions
    scene = models.scene
    nodes = np.array([place.node for place in places_of(scene)], dtype=np.int64)
    sliding = simulate(scene, motions, histories=True, events=False)
    ground = simulate(models.ground, motions, events=False)
    ground_velocity = np.stack([integrals(each.acceleration, each.dt)[0] for each in motions], axis=1)
    standing = np.concatenate(
        [0.0 * ground_velocity[:, None, :], sliding.floor_velocity, sliding.rack_velocity], axis=1
    )
    rate = sliding.block_velocity - standing[:, nodes]
    sides = [
        signed_peaks(sliding.slip[:, :, axis], rate[:, :, axis], x.dt, sliding.peak_slip[:, axis])
        for axis in range(VECTOR)
    ]
    each_alone = [
        simulate(one, motion, events=False).peak_slip for one, motion in zip(scene._directions(), motions, strict=True)
    ]
    alone, full = (
        None if model is None else simulate(model, motions, events=False) for model in (models.alone, models.full)
    )
    ground_peak = float(np.hypot(x.acceleration, y.acceleration).max())
    accelerations = _peaks_at_nodes(sliding, ground_peak)
    speeds = np.nanmax(np.hypot(*np.moveaxis(standing + ground_velocity[:, None, :], -1, 0)), axis=0)
    slip = PlaneSlip(
        peak=sliding.peak_slip[:, :VECTOR],
        plus=np.stack([plus for plus, _ in sides], axis=1),
        minus=np.stack([minus for _, minus in sides], axis=1),
        residual=sliding.residual_slip,
        alone=np.stack(each_alone, axis=1),
    )
    return SlipRuns(
        peak=sliding.peak_slip[:, VECTOR],
        plus=slip.plus[:, 0],
        minus=slip.minus[:, 0],
        residual=np.hypot(*sliding.residual_slip.T),
        path=sliding.slip_path,
        contact_force=sliding.peak_contact_force.max(axis=1),
        contact_velocity=sliding.peak_contact_velocity.max(axis=1),
        moving=np.hypot(*np.moveaxis(rate[-1], -1, 0)) > 0.0,
        collapsed=np.array(sliding.status == "collapsed"),
        ground_peak=ground.peak_slip[:, VECTOR],
        ground_residual=np.hypot(*ground.residual_slip.T),
        acceleration=accelerations[nodes],
        velocity=speeds[nodes],
        demand=_demands_plane_runs(sliding, motions, accelerations)[nodes],
        alone_acceleration=_peaks(alone, nodes, ground_peak),
        full_acceleration=_peaks(full, nodes, ground_peak),
        plane=slip,
    )


def _peak_vertical(motion: Motion) -> float:
    return 0.0 if motion.vertical is None else float(np.abs(motion.vertical).max())


def _demands(response: Response, motion: Motion, peaks: FloatArray) -> FloatArray:
    """Largest abs(a)/(g + a_v) of all nodes: in continuous time without vertical motion, of the samples with it."""
    if motion.vertical is None:
        demands: FloatArray = peaks / STANDARD_GRAVITY
        return demands
    vertical = motion.vertical
    every = histories_at_nodes(response, "acceleration", motion.acceleration)
    return np.array([demand_in_g(history, vertical) for history in every.T])


def _floor_estimates(scene: Scene, alone: Response, motion: Motion, ground_velocity: FloatArray) -> list[EstimateRow]:
    """Estimates of the motion under goods in the building alone, and the exact slip of each block on it."""
    rows = []
    bases: dict[int, Base] = {}
    peaks = _peaks_at_nodes(alone, motion.pga)
    accelerations = histories_at_nodes(alone, "acceleration", motion.acceleration)
    velocities = histories_at_nodes(alone, "velocity", 0.0 * ground_velocity)
    for number, (block, place) in enumerate(zip(scene.goods, places_of(scene), strict=True)):
        node = place.node
        if node == 0 and scene.base is None:
            continue
        if node not in bases:
            bases[node] = Base(
                Motion(accelerations[:, node], motion.dt, motion.vertical),
                float(peaks[node]),
                float(np.abs(velocities[:, node] + ground_velocity).max()),
                _peak_vertical(motion),
            )
        base = bases[node]
        exact = simulate(Scene(None, [on_ground(block)]), base.motion, events=False)
        values = {**estimates(base, block.mu_k), "rigid_block": float(exact.peak_slip[0])}
        rows.append(EstimateRow(number, "floor", values))
    return rows
