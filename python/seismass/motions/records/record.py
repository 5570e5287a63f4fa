"""One component of ground motion: accelerations in m/s2 at a fixed step, and what its source says about them.

What is computed from the samples stands in intensity.py, what changes them in processing.py.
"""

from __future__ import annotations

import math
from dataclasses import InitVar, dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.errors import InvalidMotion
from seismass.base.units import STANDARD_GRAVITY, acceleration_factor
from seismass.base.values import Value, as_array, as_name, as_number, brief, frozen, printable, refusal
from seismass.base.views import view
from seismass.motions.records import intensity, processing

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

    from seismass.motions.motion import Motion


KNOWN = ("magnitude", "distance_km", "vs30", "mechanism", "lowest_hz", "highest_hz")
"""Fields that say what is known of a record beside its samples."""


@dataclass(frozen=True, eq=False, repr=False)
class Record(Value):
    """Accelerations at a fixed time step, never changed in place: scaling makes a new record.

    Two records are equal when all that they hold is, labels included.

    Parameters
    ----------
    acceleration : array_like, shape (samples,)
        Ground acceleration in `unit`, first sample at t = 0; kept as a read-only copy in m/s2.
    dt : float
        Time step (s).
    name : str, optional
        Short name, for a file its name without the suffix.
    event, station, component : str, optional
        What the source calls them; empty where it does not say.
    source : Path, optional
        The file it was read from.
    unit : {"m/s2", "g", "cm/s2", "gal"}, default "m/s2"
        Unit of the accelerations that are given, also of `vertical`; those of the record are in m/s2 whatever it is.
    synthetic : bool, default False
        True for a made motion that no instrument recorded.
    vertical : array_like, shape (samples,), optional
        Vertical ground acceleration (in `unit`, up positive) at the same instants.
    remarks : tuple of str, optional
        What a reader had to interpret or leave out.
    azimuth : float, optional
        Direction of positive acceleration, degrees clockwise from north; None where the source does not say.
    network : str, optional
        Network or agency that recorded it; empty where the source does not say.
    sha256 : str, optional
        Digest of the bytes of the source file; empty for a record that no file holds.
    place : str, optional
        Where the sensor stands, as the source says: "Roof", "borehole"; empty for the surface of the ground, or where
        the source does not say.
    history : tuple of str, optional
        What was done to the samples after reading, in order.
    file_unit : str, default "m/s2"
        Unit of the accelerations in the source file, as a label: "g", "m/s2" or "cm/s2".
    magnitude, distance_km, vs30, mechanism
        Of the earthquake, to it (km) and of the site (m/s), as the source or a table beside it says; None or empty.
    lowest_hz, highest_hz : float, optional
        Usable band (Hz), as it is stated, or from the corners of the filter: 1.25 times the lower one, and the upper.

    Raises
    ------
    InvalidMotion
        No sample, a value that is not finite, an unknown unit, a step that is not positive, components of
        different length, remarks or history that are not a tuple of strings.
    """

    acceleration: NDArray[np.float64]
    dt: float
    name: str = ""
    event: str = ""
    station: str = ""
    component: str = ""
    source: Path | None = None
    unit: InitVar[str] = "m/s2"
    synthetic: bool = False
    vertical: NDArray[np.float64] | None = None
    remarks: tuple[str, ...] = ()
    azimuth: float | None = None
    network: str = ""
    sha256: str = ""
    history: tuple[str, ...] = ()
    place: str = ""
    file_unit: str = "m/s2"
    magnitude: float | None = None
    distance_km: float | None = None
    vs30: float | None = None
    mechanism: str = ""
    lowest_hz: float | None = None
    highest_hz: float | None = None

    def __post_init__(self, unit: str) -> None:
        for label in ("name", "event", "station", "component", "network", "mechanism"):
            object.__setattr__(self, label, as_name(getattr(self, label), label, "record", InvalidMotion))
        what = f"record {self.name}" if self.name else "record"
        factor = acceleration_factor(unit, what, InvalidMotion)
        object.__setattr__(self, "dt", _number("dt", self.dt, what, positive=True))
        object.__setattr__(self, "acceleration", _samples("acceleration", self.acceleration, what, factor))
        if self.vertical is not None:
            vertical = _samples("vertical", self.vertical, what, factor)
            if len(vertical) != self.samples:
                raise InvalidMotion(
                    f"vertical of {what} must be as long as the horizontal, {self.samples} samples; "
                    f"got {len(vertical)} samples"
                )
            object.__setattr__(self, "vertical", vertical)
        if self.azimuth is not None:
            object.__setattr__(self, "azimuth", _number("azimuth", self.azimuth, what, positive=False))
        for name in ("magnitude", "distance_km", "vs30", "lowest_hz", "highest_hz"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, _number(name, getattr(self, name), what, positive=False))
        for parameter in ("remarks", "history"):
            sentences: Any = getattr(self, parameter)
            if not isinstance(sentences, tuple | list) or not all(isinstance(one, str) for one in sentences):
                raise refusal(InvalidMotion, parameter, what, "a tuple of strings", brief(sentences))
            object.__setattr__(self, parameter, tuple(printable(one) for one in sentences))

    def _arguments(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def __repr__(self) -> str:
        made = ", synthetic" if self.synthetic else ""
        return f"<Record {self.name or '(unnamed)'}: {self.samples} x {self.dt:g} s, PGA {self.pga_g:.4f} g{made}>"

    @property
    def samples(self) -> int:
        """Number of samples."""
        return len(self.acceleration)

    @property
    def duration(self) -> float:
        """Time of the last sample (s); the first is at zero."""
        return (self.samples - 1) * self.dt

    @property
    def time(self) -> NDArray[np.float64]:
        """Time of each sample (s), shape (samples,)."""
        return frozen(np.arange(self.samples) * self.dt)

    @cached_property
    def _integrals(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        velocity, displacement = intensity.integrals(self.acceleration, self.dt)
        return frozen(velocity), frozen(displacement)

    @property
    def velocity(self) -> NDArray[np.float64]:
        """Ground velocity at the samples (m/s), from rest, shape (samples,): the exact integral of linear pieces."""
        return self._integrals[0]

    @property
    def displacement(self) -> NDArray[np.float64]:
        """Ground displacement at the samples (m), from rest, shape (samples,): the exact integral of the velocity."""
        return self._integrals[1]

    @property
    def pga(self) -> float:
        """Largest absolute ground acceleration (m/s2)."""
        return float(np.max(np.abs(self.acceleration)))

    @property
    def pga_g(self) -> float:
        """Largest absolute ground acceleration, as a fraction of g."""
        return self.pga / STANDARD_GRAVITY

    @cached_property
    def pgv(self) -> float:
        """Largest absolute ground velocity (m/s) in continuous time: it is quadratic between samples."""
        return float(intensity.peak_velocity(self.acceleration, self.dt, self.velocity))

    @cached_property
    def pgd(self) -> float:
        """Largest absolute ground displacement (m) in continuous time: it is cubic between samples."""
        return float(intensity.peak_displacement(self.acceleration, self.dt, self.velocity, self.displacement))

    @property
    def arias(self) -> float:
        """Arias intensity (m/s): pi/(2 g) times the integral of a^2, exact for linear pieces; Arias (1970)."""
        return float(intensity.build_up(self.acceleration, self.dt)[-1])

    @property
    def cav(self) -> float:
        """Cumulative absolute velocity (m/s): the integral of abs(a), exact where a changes sign within a step."""
        return intensity.cumulative_absolute_velocity(self.acceleration, self.dt)

    @property
    def d5_75(self) -> float:
        """Time (s) from 5 to 75 % of the Arias intensity."""
        return self.significant_duration(0.05, 0.75)

    @property
    def d5_95(self) -> float:
        """Time (s) from 5 to 95 % of the Arias intensity; Trifunac and Brady (1975)."""
        return self.significant_duration(0.05, 0.95)

    def significant_duration(self, start: float = 0.05, end: float = 0.95) -> float:
        """Return the time (s) between two shares of the Arias intensity, with exact crossings within steps.

        Parameters
        ----------
        start, end : float, optional
            Shares from 0 to 1, in order.

        Raises
        ------
        InvalidOption
            The shares are not in order between 0 and 1.
        """
        return intensity.significant_duration(self.acceleration, self.dt, start, end)

    def bracketed_duration(self, threshold_g: float = intensity.BRACKET_G) -> float:
        """Return the time (s) from the first to the last crossing of a threshold of abs(a); 0 where it is not reached.

        Parameters
        ----------
        threshold_g : float, optional
            The threshold (g), positive.

        Raises
        ------
        InvalidOption
            The threshold is not a positive number.
        """
        return intensity.bracketed_duration(self.acceleration, self.dt, threshold_g)

    def measures(self) -> dict[str, float]:
        """Return peaks, intensities, durations and ends by name; `intensity_table` says their units."""
        return {
            "pga_g": self.pga_g,
            "pgv": self.pgv,
            "pgd": self.pgd,
            "arias": self.arias,
            "d5_75": self.d5_75,
            "d5_95": self.d5_95,
            "cav": self.cav,
            "bracketed": self.bracketed_duration(),
            "end_velocity": float(self.velocity[-1]),
            "end_displacement": float(self.displacement[-1]),
        }

    @property
    def motion(self) -> Motion:
        """The samples as the kernel takes them."""
        from seismass.motions.motion import Motion  # reading records needs no kernel

        return Motion(self.acceleration, self.dt, self.vertical)

    def scaled(self, factor: float) -> Record:
        """Return the record with both components multiplied by `factor`, a finite number."""
        number = _number("factor", factor, "scaled record", positive=False)
        with np.errstate(over="ignore"):  # the new record refuses what overflows
            acceleration = self.acceleration * number
            vertical = None if self.vertical is None else self.vertical * number
        return self._changed(f"scaled by {number:.6g}", acceleration=acceleration, vertical=vertical)

    def time_scaled(self, factor: float) -> Record:
        """Return the record with its time step multiplied by `factor` > 0; accelerations stay as they are."""
        number = _number("factor", factor, "time-scaled record", positive=True)
        return self._changed(f"time step multiplied by {number:.6g}", dt=self.dt * number)

    def similitude(self, length_ratio: float = 15.0) -> Record:
        """Return the record for a model at reduced scale under the same gravity and accelerations (Froude similitude).

        Lengths of the model are those of the prototype over `length_ratio`, and times over its root. Accelerations are
        unchanged, so that friction, which compares them with g, is modelled at full scale; velocities become those of
        the prototype over the root of the ratio, displacements those over the ratio.

        Parameters
        ----------
        length_ratio : float, default 15
            Length of the prototype over that of the model; 15 is the shaking table of the paper.

        Raises
        ------
        InvalidMotion
            The ratio is not a positive number.
        """
        ratio = _number("length_ratio", length_ratio, "similitude", positive=True)
        note = f"time step over sqrt({ratio:g}) for a model at 1:{ratio:g}, accelerations unchanged"
        return self._changed(note, dt=self.dt / math.sqrt(ratio))

    def with_duration(self, duration: float) -> Record:
        """Return the record up to the sample nearest to `duration` (s), as `Motion.with_duration` does.

        Raises
        ------
        InvalidMotion
            The duration is negative or not finite.
        """
        changed = self.motion.with_duration(duration)
        what = "cut" if changed.samples < self.samples else "continued at zero"
        note = f"{what} to {changed.duration:g} s"
        return self._changed(note, acceleration=changed.acceleration, vertical=changed.vertical)

    def resampled(self, dt: float) -> Record:
        """Return the record at another time step; see `seismass.motions.records.processing.resampled`."""
        return processing.resampled(self, dt)

    def baseline_corrected(self, order: int = 1, fit: Literal["velocity", "acceleration"] = "velocity") -> Record:
        """Return the record less a polynomial; see `seismass.motions.records.processing.baseline_corrected`."""
        return processing.baseline_corrected(self, order, fit)

    def band_passed(
        self,
        low_hz: float | None,
        high_hz: float | None,
        order: int = 4,
        *,
        taper: float = 0.01,
        keep_pads: bool = False,
    ) -> Record:
        """Return the record within a band of frequencies; see `seismass.motions.records.processing.band_passed`."""
        return processing.band_passed(self, low_hz, high_hz, order, taper=taper, keep_pads=keep_pads)

    def with_vertical(self, vertical: Record) -> Record:
        """Return the record with the accelerations of `vertical` beside its own, both cut to the shorter.

        Raises
        ------
        InvalidMotion
            The two have different time steps, or `vertical` is not a record.
        """
        if not isinstance(vertical, Record):
            raise refusal(InvalidMotion, "vertical", f"record {self.name}".rstrip(), "a Record", brief(vertical))
        if not math.isclose(vertical.dt, self.dt, rel_tol=1e-9):
            raise InvalidMotion(
                f"dt of vertical record {vertical.name} must be that of the horizontal, {self.dt:g} s; "
                f"got {vertical.dt:g} s"
            )
        samples = min(self.samples, vertical.samples)
        record = self
        if self.samples != vertical.samples:
            cut = f"cut to {samples} samples: {self.samples} horizontal, {vertical.samples} vertical"
            record = self.replace(remarks=(*self.remarks, cut))
        note = f"vertical accelerations of {vertical.name or 'another record'} set beside it"
        return record._changed(note, acceleration=self.acceleration[:samples], vertical=vertical.acceleration[:samples])

    def _changed(self, note: str, **changes: Any) -> Record:
        """Return another record, with a step added to its history."""
        return self.replace(history=(*self.history, note), **changes)

    @view
    def plot(self, *, figure: Figure | SubFigure | None = None, axes: Sequence[Axes] | None = None) -> Figure:
        """Draw acceleration, velocity, displacement and the Arias build-up with D5-95; nothing is shown on a screen.

        Parameters
        ----------
        figure : Figure or SubFigure, optional
            What to draw into; by default a new figure.
        axes : sequence of four Axes, optional
            Axes to draw into instead, top to bottom.

        Returns
        -------
        Figure
            The whole figure that was drawn into; `figure.savefig(path)` writes it, and a notebook shows it.
        """
        raise NotImplementedError

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError


def _number(parameter: str, value: Any, what: str, *, positive: bool) -> float:
    number = as_number(value, parameter, what, InvalidMotion)
    if not math.isfinite(number) or (positive and number <= 0.0):
        requirement = "a positive number" if positive else "a finite number"
        raise refusal(InvalidMotion, parameter, what, requirement, brief(value))
    return number


def _samples(parameter: str, values: ArrayLike, what: str, factor: float) -> NDArray[np.float64]:
    samples = as_array(values, parameter, what, InvalidMotion)
    if len(samples) == 0:
        raise refusal(InvalidMotion, parameter, what, "a list of at least one sample", "none")
    wrong = np.flatnonzero(~np.isfinite(samples))
    if len(wrong):
        got = f"{samples[wrong[0]]} at sample {wrong[0]}"
        raise refusal(InvalidMotion, parameter, what, "finite at every sample", got)
    return samples if factor == 1.0 else frozen(samples * factor)
