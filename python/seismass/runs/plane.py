"""Two horizontal directions: motion and response."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from seismass import _kernel
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, brief, frozen, refusal
from seismass.base.views import Card, view
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene
from seismass.motions.motion import Motion, MotionLike, as_motion
from seismass.runs.quantities import (
    QUANTITIES,
    Numbers,
    Values,
    events_of,
    floor_displacement,
    ground_motion,
    names_read_by,
)
from seismass.runs.response import EVENT_KINDS

if TYPE_CHECKING:
    import polars as pl

    from seismass.motions.records import Pair


class PlaneResponse(Numbers, Card):
    """What a run in two horizontal directions gives back. SI units; index 0 is storey 1, or block 1.

    Peaks are true extremes over continuous time, by direction and of the length of the vector: their last axis is
    [x, y, vector]. What is known at an instant has pairs [x, y] on its last axis. Arrays are read-only. Histories,
    events and energies are known where `simulate` was asked for them.
    """

    __slots__ = ("_directions", "_known", "_run", "motions", "scene")
    scene: Scene
    """The scene that was solved."""
    motions: tuple[Motion, Motion]
    """The motions in x, with the vertical one, and in y."""

    def __init__(self, run: _kernel.PlaneResponse, scene: Scene, motions: tuple[Motion, Motion]) -> None:
        self._run = run
        self._directions = run.directions
        self._known: dict[str, FloatArray] = {}
        self.scene = scene
        self.motions = motions

    def _peak(self, name: str) -> FloatArray:
        if name not in self._known:
            parts: list[Any] = [*(getattr(each, name) for each in self._directions), getattr(self._run, name)]
            self._known[name] = frozen(np.stack(parts, axis=-1))
        return self._known[name]

    def _pair(self, name: str) -> FloatArray:
        if name not in self._known:
            parts: list[Any] = [getattr(each, name) for each in self._directions]
            if any(part is None for part in parts):
                requirement = f"asked for, if {name} is wanted, and not of displacements alone"
                raise refusal(InvalidOption, "histories", "simulate", requirement, "not")
            self._known[name] = frozen(np.stack(parts, axis=-1))
        return self._known[name]

    def _history(self, name: str) -> FloatArray:
        return self._pair(QUANTITIES[name].stored or name)

    def _displacement(self, name: str) -> FloatArray:
        return floor_displacement(self.drift, None)

    def _ground(self, name: str) -> FloatArray:
        rows, every = len(self.drift), self._directions[0].every or 1
        return frozen(np.stack([ground_motion(each, name, rows, every) for each in self.motions], axis=-1))

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is unlikely about scene and motions, in sentences."""
        return (*self.scene.remarks, *dict.fromkeys(line for each in self.motions for line in motion_remarks(each)))

    @property
    def status(self) -> str:
        """How the run ended: "completed" or "collapsed"."""
        return self._run.status

    @property
    def end_time(self) -> float:
        """Time reached (s): the last sample, or the collapse."""
        return self._directions[0].end_time

    @property
    def collapsed_storey(self) -> int | None:
        """Storey whose drift vector reached the collapse drift, counted from 1; None if none did."""
        return self._directions[0].collapsed_storey

    peak_drift = Values[FloatArray]("_peak", after="3")
    peak_slip = Values[FloatArray]("_peak", after="3")
    peak_floor_acceleration = Values[FloatArray]("_peak", after="3")
    peak_storey_shear = Values[FloatArray]("_peak", after="3")
    peak_base_shear = Values[FloatArray]("_peak", after="3")
    peak_rack_drift = Values[FloatArray]("_peak", after="3")
    peak_rack_acceleration = Values[FloatArray]("_peak", after="3")
    peak_rack_shear = Values[FloatArray]("_peak", after="3")
    residual_drift = Values[FloatArray]("_pair", after="2")
    residual_slip = Values[FloatArray]("_pair", after="2")
    residual_rack_drift = Values[FloatArray]("_pair", after="2")
    peak_contact_force = Values[FloatArray]("_pair", after="2")
    peak_contact_velocity = Values[FloatArray]("_pair", after="2")
    drift = Values[FloatArray]("_history", "rows", "2")
    slip = Values[FloatArray]("_history", "rows", "2")
    floor_velocity = Values[FloatArray]("_history", "rows", "2")
    floor_acceleration = Values[FloatArray]("_history", "rows", "2")
    storey_shear = Values[FloatArray]("_history", "rows", "2")
    block_velocity = Values[FloatArray]("_history", "rows", "2")
    rack_drift = Values[FloatArray]("_history", "rows", "2")
    rack_velocity = Values[FloatArray]("_history", "rows", "2")
    rack_acceleration = Values[FloatArray]("_history", "rows", "2")
    floor_displacement = Values[FloatArray]("_displacement", "rows", "2")
    ground_acceleration = Values[FloatArray]("_ground", "rows", "2")
    ground_velocity = Values[FloatArray]("_ground", "rows", "2")
    ground_displacement = Values[FloatArray]("_ground", "rows", "2")

    @property
    def slip_path(self) -> FloatArray:
        """Path slipped by each block in contact with what carries it (m), shape (blocks,)."""
        return self._run.slip_path

    @property
    def time(self) -> FloatArray:
        """Times of the rows of the histories (s), shape (rows,)."""
        rows, every = len(self.drift), self._directions[0].every or 1
        return frozen(np.arange(rows) * every * self.motions[0].dt)

    @property
    def events(self) -> pl.DataFrame:
        """Event log in order of time.

        Columns: `time` (s), `kind`, `number` and `element` as in `Response.events`; `direction`, "x" or "y" for springs
        and stops, null for what is of the circle; `sign` of those, otherwise null; `angle` (rad, from x towards y) of
        what is of the circle: slip and reverse, of the relative velocity that follows; wear, lift and land, of the one
        then; null where there is none, as at a stick.
        """
        run = self._run
        if run.event_time is None:
            raise refusal(InvalidOption, "events", "simulate", "asked for, if events are wanted", "False")
        import polars as pl

        kind, direction, angle = (np.asarray(each) for each in (run.event_kind, run.event_direction, run.event_angle))
        return pl.DataFrame(
            {
                "time": pl.Series(run.event_time, dtype=pl.Float64),
                "kind": pl.Series(np.array(EVENT_KINDS)[kind].tolist(), dtype=pl.String),
                "number": pl.Series(run.event_number, dtype=pl.UInt32),
                "direction": pl.Series([(None, "x", "y")[each] for each in direction], dtype=pl.String),
                "sign": pl.Series(run.event_sign, dtype=pl.Int8).replace(0, None),
                "angle": pl.Series(angle, dtype=pl.Float64).fill_nan(None),
                "element": pl.Series(run.event_element, dtype=pl.UInt8).replace(0, None),
            }
        )

    @property
    def counts(self) -> dict[str, int]:
        """Number of events of each kind."""
        return dict(zip(EVENT_KINDS, self._directions[0].event_counts, strict=True))

    @property
    def energy(self) -> dict[str, float]:
        """Energies of both directions together at the end (J); keys as of `Response.energy`."""
        return self._energy(self._run.energy)

    @property
    def energy_by_direction(self) -> tuple[dict[str, float], dict[str, float]]:
        """Energies in x and in y (J), each of which balances by itself."""
        x, y = (self._energy(each.energy) for each in self._directions)
        return x, y

    def _energy(self, energy: dict[str, float] | None) -> dict[str, float]:
        if energy is None:
            raise refusal(InvalidOption, "energy", "simulate", "asked for, if energy is wanted", "False")
        return dict(energy)

    @property
    def statistics(self) -> dict[str, Any]:
        """Work done by the kernel."""
        return {**self._directions[0].statistics, "instructions": self._directions[0].instructions}

    def to_dict(self) -> dict[str, Any]:
        """Return peaks, residuals, counts, events, energy and work in SI units, null for non-finite values."""
        result: dict[str, Any] = {
            "name": self.scene.name,
            "status": self.status,
            "collapsed_storey": self.collapsed_storey,
            "end_time": self.end_time,
            "dt": self.motions[0].dt,
            "remarks": list(self.remarks),
            **{name: self._peak(name).tolist() for name in names_read_by(PlaneResponse, "_peak")},
            **{name: self._pair(name).tolist() for name in names_read_by(PlaneResponse, "_pair")},
            "slip_path": self.slip_path.tolist(),
            "counts": {kind: count for kind, count in self.counts.items() if count},
        }
        if self._run.event_time is not None:
            result["events"] = events_of(self)
        if self._run.energy is not None:
            result |= {"energy": self.energy, "energy_by_direction": list(self.energy_by_direction)}
        result["statistics"] = self.statistics
        from seismass.media.result import finite_values

        return finite_values(result)

    @property
    @view
    def text(self) -> str:
        """The run as lines: peaks of storeys and blocks by direction and of the vector, events, energy, status."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"PlaneResponse({self.scene!r}, {self.status} at {self.end_time:g} s)"


MotionPair: TypeAlias = "Pair | tuple[MotionLike, MotionLike]"
"""Motions in two directions: a pair of records, or two motions of one step."""
PlaneMotion: TypeAlias = tuple[Motion, Motion]
"""The motions in x, with the vertical one, and in y, equally long."""


def is_motion_pair(motion: Any) -> bool:
    """Whether something is a Pair, or stands for one: a tuple of two."""
    from seismass.motions.records import Pair

    return isinstance(motion, Pair) or (isinstance(motion, tuple) and len(motion) == 2)


def motions_in_plane(pair: Any, parameter: str = "motion", owner: str = "simulate") -> PlaneMotion:
    """Return the motions in x (with the vertical one, of the pair or of the first) and in y, equally long; `parameter`
    and `owner` name them in errors.
    """
    from seismass.motions.records import Pair

    vertical = None
    if isinstance(pair, Pair):
        x, y = pair.first.motion, pair.second.motion
        vertical = None if pair.vertical is None else pair.vertical.acceleration
    elif isinstance(pair, tuple | list) and len(pair) == 2:
        x, y = (as_motion(each, parameter, owner) for each in pair)
        vertical = x.vertical
    else:
        requirement = "a Pair, or two motions, for a scene in two directions"
        raise refusal(InvalidMotion, parameter, owner, requirement, brief(pair))
    if y.vertical is not None:
        raise refusal(InvalidMotion, "vertical", "motion in y", "left out: it is that of the motion in x", "a motion")
    if not np.isclose(y.dt, x.dt, rtol=1e-9, atol=0.0):
        raise refusal(InvalidMotion, "dt", "motion in y", f"that of the motion in x, {x.dt:g} s", f"{y.dt:g} s")
    count = max(x.samples, y.samples) if vertical is None else len(vertical)
    of_x, of_y = (np.pad(each.acceleration, (0, max(0, count - each.samples)))[:count] for each in (x, y))
    return Motion(of_x, x.dt, vertical), Motion(of_y, x.dt)
