"""Response of one run: peaks, histories, events, and how they are shown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass import _kernel
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.fork_check import require_polars
from seismass.base.values import FloatArray, frozen, read_only, refusal
from seismass.base.views import Views, view
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene, goods_names
from seismass.motions.motion import Motion
from seismass.runs.quantities import (
    QUANTITIES,
    Numbers,
    Statistics,
    Values,
    events_of,
    floor_displacement,
    ground_motion,
    names_read_by,
    of_chains_alone,
)

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from seismass.model.codes import Use
    from seismass.motions.records import Record


DEFAULT_POINTS: Final = 200
"""Number of times at which a run is solved again for figures of what grows along it."""


class ResponsePlots(Views):
    """Figures of a response: each method is the function of `seismass.plots` with its name."""

    __slots__ = ()

    @view
    def drift(
        self,
        *,
        storeys: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the drift of storeys over time, with their peaks in continuous time and their events."""
        raise NotImplementedError

    @view
    def slip(
        self,
        *,
        blocks: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the slip of blocks over time, with their peaks in continuous time, their events and their stops."""
        raise NotImplementedError

    @view
    def rack_drift(
        self,
        *,
        racks: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the drift of the levels of racks over time, with their peaks in continuous time and their events."""
        raise NotImplementedError

    @view
    def rack_profile(self, *, racks: int | Sequence[int] | None = None, ax: Sequence[Axes] | None = None) -> Figure:
        """Draw the peaks of racks over their levels: drift, acceleration, spring force, and slip of their goods."""
        raise NotImplementedError

    @view
    def contacts(self, *, blocks: int | Sequence[int] | None = None, ax: Axes | Sequence[Axes] | None = None) -> Figure:
        """Draw the velocity with which blocks come to their stops, up where the stop is on the side of plus."""
        raise NotImplementedError

    @view
    def acceleration(
        self,
        *,
        floors: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the absolute acceleration of floors over time, with their peaks and the yielding of the storey below."""
        raise NotImplementedError

    @view
    def loops(
        self,
        *,
        storeys: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = False,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw spring force against drift of storeys, over the backbone of each."""
        raise NotImplementedError

    @view
    def slip_path(
        self, *, blocks: int | Sequence[int] | None = None, points: int = DEFAULT_POINTS, ax: Axes | None = None
    ) -> Figure:
        """Draw the path that blocks have slipped over time, which only grows."""
        raise NotImplementedError

    @view
    def energy(self, *, points: int = DEFAULT_POINTS, ax: Axes | None = None) -> Figure:
        """Draw the energies of a run over time, relative to the moving ground, stacked; their sum is what came in."""
        raise NotImplementedError

    @view
    def profile(
        self,
        *,
        quantities: Sequence[str] = ("drift", "acceleration", "shear", "slip"),
        limits: Mapping[str, float] | None = None,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the peaks of a run over the height of the building, in continuous time, with limits."""
        raise NotImplementedError

    @view
    def floor_spectra(
        self,
        *,
        floors: int | Sequence[int] | None = None,
        periods: ArrayLike | None = None,
        damping: float = 0.05,
        ax: Axes | None = None,
    ) -> Figure:
        """Draw the pseudo-acceleration spectrum of the ground and of floors, for what stands on them."""
        raise NotImplementedError

    @view
    def events(self, *, ax: Axes | None = None) -> Figure:
        """Draw when each storey, level of a rack and block had its events: a row for each, a marker for each kind."""
        raise NotImplementedError


class ResponseAnimation(Protocol):
    """The animation of a run: `seismass.Animation`."""

    def html(self) -> str:
        """Return a page that needs no other file."""

    def write(self, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0) -> None:
        """Write a page (.html), a GIF (.gif) or a film (.mp4)."""


EVENT_KINDS: Final = tuple(_kernel.Response.event_kinds())
"""Kinds of events: to a storey (yield, unload, reload, close, open), to a block, or to all blocks (lift, land)."""

_WITH_VELOCITY: Final = ("touch_stop", "leave_stop", "wear", "lift", "land")
"""Kinds of events whose relative velocity is kept in scenes of the general engine."""

_EVENT: Final = np.dtype(
    [
        ("time", np.float64),
        ("kind", f"U{max(map(len, EVENT_KINDS))}"),
        ("number", np.uint32),
        ("sign", np.int8),
        ("element", np.uint8),
    ]
)


class Response(Numbers):
    """What a run gives back. Index 0 is storey 1 (or block 1); drifts and slips are in m, times in s.

    Peaks are true extremes over continuous time, not over samples. Arrays are read-only. Histories are known where
    `simulate` was asked for them, energies and events likewise. Responses pickle with their scene and motion, and are
    equal where their numbers are, whatever scene and motion these came from.
    """

    __slots__ = ("_known", "_run", "motion", "record", "scene")
    _run: _kernel.Response | _kernel.GeneralResponse | None
    _known: dict[str, Any]
    scene: Scene
    """The scene that was solved."""
    motion: Motion
    """The motion that it was solved under, with the duration of the run."""
    record: Record | None
    """The record that was given as the motion, whole; None where it was a `Motion`."""

    def __init__(
        self, run: _kernel.Response | _kernel.GeneralResponse, scene: Scene, motion: Motion, record: Record | None
    ) -> None:
        self._run = run
        self._known = {}
        self.scene = scene
        self.motion = motion
        self.record = record

    @property
    def plot(self) -> ResponsePlots:
        """Figures of the response: `response.plot.drift()` and the other functions of `seismass.plots`."""
        return ResponsePlots(self)

    @property
    def _heights(self) -> FloatArray | None:
        return None if self.scene.building is None else self.scene.building.heights

    def _get(self, name: str) -> Any:
        """Return what the kernel holds under a name, converted once."""
        if name not in self._known:
            self._known[name] = getattr(self._run, name)
        return self._known[name]

    def _asked(self, name: str, option: str, stored: str | None = None) -> Any:
        """Return what an option keeps; `stored` is its name in the kernel, where that is another."""
        value = self._get(stored or name)
        if value is None:
            raise refusal(InvalidOption, option, "simulate", f"asked for, if {name} is wanted", "False")
        return value

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is unlikely about scene and motion, in sentences: wrong units above all."""
        return (*self.scene.remarks, *motion_remarks(self.motion))

    @property
    def status(self) -> str:
        """How the run ended: "completed" or "collapsed"."""
        return str(self._get("status"))

    @property
    def end_time(self) -> float:
        """Time reached: the last sample, or the collapse."""
        return float(self._get("end_time"))

    @property
    def collapsed_storey(self) -> int | None:
        """Storey that reached its collapse drift, counted from 1; None if none did."""
        storey: int | None = self._get("collapsed_storey")
        return storey

    peak_drift = Values[FloatArray]("_array")
    peak_drift_time = Values[FloatArray]("_array")
    peak_slip = Values[FloatArray]("_array")
    peak_slip_time = Values[FloatArray]("_array")
    peak_floor_acceleration = Values[FloatArray]("_array")
    peak_floor_acceleration_time = Values[FloatArray]("_array")
    peak_storey_shear = Values[FloatArray]("_array")
    peak_storey_shear_time = Values[FloatArray]("_array")
    residual_drift = Values[FloatArray]("_array")
    residual_slip = Values[FloatArray]("_array")
    slip_path = Values[FloatArray]("_array")
    peak_floor_force = Values[FloatArray]("_forces")
    peak_floor_force_time = Values[FloatArray]("_forces")
    peak_contact_force = Values[FloatArray]("_of_stops")
    peak_contact_velocity = Values[FloatArray]("_of_stops")
    peak_rack_drift = Values[tuple[FloatArray, ...]]("_of_racks")
    peak_rack_drift_time = Values[tuple[FloatArray, ...]]("_of_racks")
    peak_rack_acceleration = Values[tuple[FloatArray, ...]]("_of_racks")
    peak_rack_shear = Values[tuple[FloatArray, ...]]("_of_racks")
    residual_rack_drift = Values[tuple[FloatArray, ...]]("_of_racks")
    peak_base_slip = Values[float]("_of_base")
    peak_base_slip_time = Values[float]("_of_base")
    residual_base_slip = Values[float]("_of_base")
    base_slip_path = Values[float]("_of_base")
    peak_base_acceleration = Values[float]("_of_base")
    drift = Values[FloatArray]("_history", "rows")
    slip = Values[FloatArray]("_history", "rows")
    floor_velocity = Values[FloatArray]("_history", "rows")
    floor_acceleration = Values[FloatArray]("_history", "rows")
    storey_shear = Values[FloatArray]("_history", "rows")
    block_velocity = Values[FloatArray]("_history", "rows")
    base_slip = Values[FloatArray]("_history_of_base", "rows")
    base_velocity = Values[FloatArray]("_history_of_base", "rows")
    base_acceleration = Values[FloatArray]("_history_of_base", "rows")
    rack_drift = Values[tuple[FloatArray, ...]]("_histories_of_racks", "rows")
    rack_velocity = Values[tuple[FloatArray, ...]]("_histories_of_racks", "rows")
    rack_acceleration = Values[tuple[FloatArray, ...]]("_histories_of_racks", "rows")
    rack_shear = Values[tuple[FloatArray, ...]]("_histories_of_racks", "rows")
    floor_displacement = Values[FloatArray]("_displacement", "rows")
    ground_acceleration = Values[FloatArray]("_ground", "rows")
    ground_velocity = Values[FloatArray]("_ground", "rows")
    ground_displacement = Values[FloatArray]("_ground", "rows")

    @property
    def peak_drift_ratio(self) -> FloatArray | None:
        """Peak drift over storey height, shape (storeys,); None where heights are not known."""
        return None if self._heights is None else frozen(self.peak_drift / self._heights)

    @property
    def residual_drift_ratio(self) -> FloatArray | None:
        """Residual drift over storey height, shape (storeys,); None where heights are not known."""
        return None if self._heights is None else frozen(self.residual_drift / self._heights)

    @property
    def peak_base_shear(self) -> float:
        """Peak shear of storey 1 (N), with the share of a stiffness matrix; NaN without a building."""
        if self.scene.engine == "general":
            return float(self._get("peak_base_shear"))
        shear = self.peak_storey_shear
        return float(shear[0]) if len(shear) else float("nan")

    @property
    def time(self) -> FloatArray:
        """Times of the rows of the histories, shape (rows,)."""
        if "time" not in self._known:
            every = self._asked("time", "histories", stored="every")
            self._known["time"] = frozen(np.arange(len(self.drift)) * every * self.motion.dt)
        return self._array("time")

    @property
    def drift_ratio(self) -> FloatArray | None:
        """Storey drift over storey height, shape (rows, storeys); None where heights are not known."""
        return None if self._heights is None else frozen(self.drift / self._heights)

    @property
    def events(self) -> pl.DataFrame:
        """Event log in order of time.

        Columns: `time` (s); `kind` (one of `EVENT_KINDS`); `number`, the storey for yield, unload, reload, close and
        open, otherwise the block, counted from 1; `sign` (yield: of the force; unload: of the force before; reload: of
        the force that follows; close, open: of the drift; slip, reverse: of the relative velocity that follows; stick:
        of the one before; touch, lift, land, wear: of the one then, 0: none; touch_stop, leave_stop: of the side of the
        stop); `element` (yield: number of segments of the backbone that have been left, 1 at the first yield; wear: the
        stage that begins, from 1; otherwise null).

        Levels of racks are counted on from the storeys, rack by rack, and their blocks on from those of the floors. In
        scenes of the general engine there is also `velocity`, the relative velocity (m/s) at which a block comes to its
        stop or leaves it, wears, lifts or lands; otherwise null. A sliding base has number 0 where blocks have theirs.

        In a process that was forked from one in which Polars had been used, it is a SimulationError: `event_log` is the
        same without Polars.
        """
        if "events" not in self._known:
            self._asked("events", "events", stored="event_time")
            listed = self.event_log
            require_polars("events", "event_log")
            import polars as pl

            columns = {
                "time": pl.Series(listed["time"], dtype=pl.Float64),
                "kind": pl.Series(listed["kind"].tolist(), dtype=pl.String),
                "number": pl.Series(listed["number"]),
                "sign": pl.Series(listed["sign"]),
                "element": pl.Series(listed["element"]).replace(0, None),
            }
            if self.scene.engine == "general":
                known = np.isin(listed["kind"], _WITH_VELOCITY)
                velocity = np.where(known, self._get("event_velocity"), np.nan)
                columns["velocity"] = pl.Series(velocity, dtype=pl.Float64).fill_nan(None)
            self._known["events"] = pl.DataFrame(columns)
        log: pl.DataFrame = self._known["events"]
        return log

    @property
    def event_log(self) -> NDArray[np.void]:
        """Event log as a structured array, made without Polars; it also serves in a forked process.

        Fields as the columns of `events`; `element` is 0 where that is null.
        """
        if "event_log" not in self._known:
            time = self._asked("event_log", "events", stored="event_time")
            log = np.empty(len(time), dtype=_EVENT)
            log["time"] = time
            log["kind"] = np.array(EVENT_KINDS)[self._get("event_kind")]
            for name in ("number", "sign", "element"):
                log[name] = self._get(f"event_{name}")
            self._known["event_log"] = read_only(log)
        listed: NDArray[np.void] = self._known["event_log"]
        return listed

    @property
    def counts(self) -> dict[str, int]:
        """Number of events of each kind."""
        return dict(zip(EVENT_KINDS, self._get("event_counts"), strict=True))

    @property
    def energy(self) -> dict[str, float]:
        """Energies at the end, relative to the moving ground (J).

        Keys: `initial`, `input`, `kinetic`, `viscous`, `elastic` (the work of P-Delta, which is negative, included),
        `hysteretic`, `friction`; in scenes of the general engine `contact`, what stops have dissipated; and
        `relative_residual`, what is missing in the balance over the initial energy plus the largest input.
        """
        return dict(self._asked("energy", "energy"))

    @property
    def statistics(self) -> Statistics:
        """Work done by the kernel (intervals, steps, events, regimes), what was skipped, and the instructions used."""
        return cast(Statistics, {**self._get("statistics"), "instructions": self._get("instructions")})

    @property
    def has_events(self) -> bool:
        """Whether the event log was asked for."""
        return self._get("event_time") is not None

    @property
    def has_energy(self) -> bool:
        """Whether energies were asked for."""
        return self._get("energy") is not None

    @property
    @view
    def text(self) -> str:
        """The run as lines: building, motion, peaks of storeys and blocks, events, energy, status."""
        raise NotImplementedError

    @view
    def animate(
        self, *, code: str = "asce7-10", use: Use = "storage", fraction: float | None = None, title: str | None = None
    ) -> ResponseAnimation:
        """Return the animation of this run beside the model of a code, as `animate` makes it of scene and motion.

        Parameters
        ----------
        code, use, fraction, title
            As for `animate`.

        Returns
        -------
        Animation
            To be shown in a notebook, or written as a page, a GIF or a film. No histories need to have been kept.
        """
        raise NotImplementedError

    def _array(self, name: str) -> FloatArray:
        return cast(FloatArray, self._get(name))

    def to_dict(self) -> dict[str, Any]:
        """Return peaks, residuals, counts, events, energy and work in SI units, null for non-finite values.

        Events and energies are there where `simulate` was asked for them. Histories are left out. In scenes of the
        general engine `goods` says where each block stands, in the order of slips; racks have a list for each, of its
        levels; and events of stops have the velocity at the contact.
        """
        scene, building = self.scene, self.scene.building
        result: dict[str, Any] = {
            "name": scene.name,
            "status": self.status,
            "collapsed_storey": self.collapsed_storey,
            "end_time": self.end_time,
            "dt": self.motion.dt,
            "remarks": list(self.remarks),
            **{name: getattr(self, name).tolist() for name in names_read_by(Response, "_array")},
            "peak_base_shear": self.peak_base_shear,
        }
        if scene.engine == "general":
            result["goods"] = list(goods_names(scene))
            for name in names_read_by(Response, "_of_racks"):
                result[name] = [levels.tolist() for levels in getattr(self, name)]
            result |= {name: getattr(self, name).tolist() for name in names_read_by(Response, "_of_stops")}
            if scene.base is not None:
                result |= {name: getattr(self, name) for name in names_read_by(Response, "_of_base")}
        for name in ("peak_drift_ratio", "residual_drift_ratio"):
            if getattr(self, name) is not None:
                result[name] = getattr(self, name).tolist()
        if building is not None:
            result["mass_stated"] = building.mass_is_stated
            result["peak_shear_over_weight"] = (self.peak_storey_shear / building.weight).tolist()
        result["counts"] = {kind: count for kind, count in self.counts.items() if count}
        if self.has_events:
            result["events"] = events_of(self)
        if self.has_energy:
            result["energy"] = self.energy
        if building is not None:
            result["damping_matrix"] = building.damping_matrix.tolist()
        result["statistics"] = self.statistics
        from seismass.media.result import finite_values

        return finite_values(result)

    def _forces(self, name: str) -> FloatArray:
        if self.scene.engine != "chain":
            raise of_chains_alone(got="a run that was asked for it")
        return cast(FloatArray, self._asked(name, "floor_force"))

    def _history(self, name: str) -> FloatArray:
        stored = QUANTITIES[name].stored or name
        displacement = name in ("drift", "slip", "rack_drift", "base_slip")
        if not displacement and self._get(stored) is None and self._get("drift") is not None:
            raise refusal(InvalidOption, "displacements_only", "simulate", f"False, if {name} is wanted", "True")
        return cast(FloatArray, self._asked(name, "histories", stored))

    def _history_of_base(self, name: str) -> FloatArray:
        self._needed(name)
        return self._history(name)

    def _of_racks(self, name: str, axis: int = 0) -> tuple[FloatArray, ...]:
        """Values of all levels, one array for each rack; none without racks."""
        if self.scene.engine != "general" or not self.scene.racks:
            return ()
        ends = np.cumsum(self._get("rack_levels"))[:-1]
        values = self._array(name) if axis == 0 else self._history(name)
        return tuple(frozen(part) for part in np.split(values, ends, axis=axis))

    def _histories_of_racks(self, name: str) -> tuple[FloatArray, ...]:
        return self._of_racks(name, axis=1)

    def _of_stops(self, name: str) -> FloatArray:
        return self._array(name) if self.scene.engine == "general" else frozen(np.zeros(len(self.peak_slip)))

    def _needed(self, name: str) -> None:
        if self.scene.base is None:
            raise refusal(InvalidScene, "base", "scene", f"given, if {name} is wanted", "none")

    def _of_base(self, name: str) -> float:
        self._needed(name)
        return float(self._get(name))

    def _displacement(self, name: str) -> FloatArray:
        return floor_displacement(self.drift, None if self.scene.base is None else self.base_slip)

    def _ground(self, name: str) -> FloatArray:
        return ground_motion(self.motion, name, len(self.drift), self._get("every"))

    def _everything(self) -> dict[str, Any]:
        return {name: self._get(name) for name in _KERNEL_VALUES[self.scene.engine]}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Response):
            return NotImplemented
        if self.motion.dt != other.motion.dt or not _same(self._heights, other._heights):
            return False
        if self.scene.engine != other.scene.engine:
            return False
        mine, theirs = self._everything(), other._everything()
        return all(_same(mine[name], theirs[name]) for name in mine)

    __hash__ = None  # type: ignore[assignment]

    def __getstate__(self) -> dict[str, Any]:
        return {"known": self._everything(), "scene": self.scene, "motion": self.motion, "record": self.record}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._run = None
        self._known = {
            name: read_only(value) if isinstance(value, np.ndarray) else value for name, value in state["known"].items()
        }
        self.scene = state["scene"]
        self.motion = state["motion"]
        self.record = state["record"]

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError

    def __repr__(self) -> str:
        collapsed = f", storey {self.collapsed_storey}" if self.collapsed_storey is not None else ""
        drift = f", peak drift {_in_mm(self.peak_drift)} mm" if len(self.peak_drift) else ""
        slip = f", peak slip {_in_mm(self.peak_slip)} mm" if len(self.peak_slip) else ""
        return f"Response({self.status}{collapsed} at {self.end_time:g} s{drift}{slip})"


def _values(kind: type) -> tuple[str, ...]:
    """Names of the values of a response of the kernel."""
    return tuple(
        name
        for name, member in vars(kind).items()
        if not name.startswith("_") and not callable(member) and not isinstance(member, staticmethod)
    )


_KERNEL_VALUES: Final = {"chain": _values(_kernel.Response), "general": _values(_kernel.GeneralResponse)}


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if one is None or other is None:
        return one is other
    return bool(one == other)


def _in_mm(values: FloatArray) -> str:
    return " ".join(f"{1000.0 * value:.4g}" for value in values)
