"""Two horizontal directions: motion and response."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np

from seismass import _kernel
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, brief, frozen, refusal
from seismass.base.views import Card, view
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene
from seismass.motions.motion import Motion, MotionLike, as_motion
from seismass.runs.response import EVENT_KINDS

if TYPE_CHECKING:
    import polars as pl

    from seismass.motions.records import Pair

_PEAKS: Final = (
    "peak_drift",
    "peak_slip",
    "peak_floor_acceleration",
    "peak_storey_shear",
    "peak_base_shear",
    "peak_rack_drift",
    "peak_rack_acceleration",
    "peak_rack_shear",
)
_PAIRS: Final = (
    "residual_drift",
    "residual_slip",
    "residual_rack_drift",
    "peak_contact_force",
    "peak_contact_velocity",
)


class PlaneResponse(Card):
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

    @property
    def peak_drift(self) -> FloatArray:
        """Peak drift of each storey (m), shape (storeys, 3)."""
        return self._peak("peak_drift")

    @property
    def peak_slip(self) -> FloatArray:
        """Peak slip of each block (m), shape (blocks, 3)."""
        return self._peak("peak_slip")

    @property
    def peak_floor_acceleration(self) -> FloatArray:
        """Peak absolute acceleration of each floor (m/s2), shape (storeys, 3)."""
        return self._peak("peak_floor_acceleration")

    @property
    def peak_storey_shear(self) -> FloatArray:
        """Peak spring force of each storey (N), shape (storeys, 3)."""
        return self._peak("peak_storey_shear")

    @property
    def peak_base_shear(self) -> FloatArray:
        """Peak base shear with the share of stiffness matrices (N), shape (3,); NaN without a building."""
        return self._peak("peak_base_shear")

    @property
    def peak_rack_drift(self) -> FloatArray:
        """Peak drift of the levels of all racks, rack by rack (m), shape (levels, 3)."""
        return self._peak("peak_rack_drift")

    @property
    def peak_rack_acceleration(self) -> FloatArray:
        """Peak absolute acceleration of rack levels (m/s2), shape (levels, 3)."""
        return self._peak("peak_rack_acceleration")

    @property
    def peak_rack_shear(self) -> FloatArray:
        """Peak spring force of rack levels (N), shape (levels, 3)."""
        return self._peak("peak_rack_shear")

    @property
    def peak_contact_force(self) -> FloatArray:
        """Peak force of each block on its stops across x and across y (N), shape (blocks, 2)."""
        return self._pair("peak_contact_force")

    @property
    def peak_contact_velocity(self) -> FloatArray:
        """Peak relative velocity at which each block comes to its stops (m/s), shape (blocks, 2)."""
        return self._pair("peak_contact_velocity")

    @property
    def residual_drift(self) -> FloatArray:
        """Drift of each storey at the end (m), shape (storeys, 2)."""
        return self._pair("residual_drift")

    @property
    def residual_slip(self) -> FloatArray:
        """Slip of each block at the end (m), shape (blocks, 2)."""
        return self._pair("residual_slip")

    @property
    def residual_rack_drift(self) -> FloatArray:
        """Drift of rack levels at the end (m), shape (levels, 2)."""
        return self._pair("residual_rack_drift")

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
    def drift(self) -> FloatArray:
        """Storey drift (m), shape (rows, storeys, 2); NaN after a collapse, as in every history."""
        return self._pair("drift")

    @property
    def slip(self) -> FloatArray:
        """Slip (m), shape (rows, blocks, 2)."""
        return self._pair("slip")

    @property
    def floor_velocity(self) -> FloatArray:
        """Floor velocity relative to the ground (m/s), shape (rows, storeys, 2)."""
        return self._pair("floor_velocity")

    @property
    def block_velocity(self) -> FloatArray:
        """Block velocity relative to the ground (m/s), shape (rows, blocks, 2)."""
        return self._pair("block_velocity")

    @property
    def floor_acceleration(self) -> FloatArray:
        """Absolute floor acceleration (m/s2), shape (rows, storeys, 2)."""
        return self._pair("floor_acceleration")

    @property
    def storey_force(self) -> FloatArray:
        """Spring force of each storey (N), shape (rows, storeys, 2)."""
        return self._pair("storey_force")

    @property
    def rack_drift(self) -> FloatArray:
        """Drift of rack levels (m), shape (rows, levels, 2)."""
        return self._pair("rack_drift")

    @property
    def rack_velocity(self) -> FloatArray:
        """Velocity of rack levels relative to the ground (m/s), shape (rows, levels, 2)."""
        return self._pair("rack_velocity")

    @property
    def rack_acceleration(self) -> FloatArray:
        """Absolute acceleration of rack levels (m/s2), shape (rows, levels, 2)."""
        return self._pair("rack_acceleration")

    @property
    def events(self) -> pl.DataFrame:
        """Event log in order of time.

        Columns: `time` (s), `kind`, `number` and `element` as in `Response.events`; `direction`, "x" or "y" for springs
        and stops, null for what is of the circle; `sign` of those, otherwise null; `angle` (rad, from x towards y) of
        what is of the circle: slip and reverse, of the relative velocity that follows; stick, of the one before; wear,
        lift and land, of the one then; null where there is none.
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
            **{name: self._peak(name).tolist() for name in _PEAKS},
            **{name: self._pair(name).tolist() for name in _PAIRS},
            "slip_path": self.slip_path.tolist(),
            "counts": {kind: count for kind, count in self.counts.items() if count},
        }
        if self._run.event_time is not None:
            result["events"] = [
                {key: value for key, value in event.items() if value is not None}
                for event in self.events.iter_rows(named=True)
            ]
        if self._run.energy is not None:
            result |= {"energy": self.energy, "energy_by_direction": list(self.energy_by_direction)}
        result["statistics"] = self.statistics
        from seismass.media.result import finite_values

        finite: dict[str, Any] = finite_values(result)
        return finite

    def to_json(self) -> str:
        """Return `to_dict` as JSON."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False)

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
