"""One component of ground motion: accelerations in m/s2 at a fixed step, and what its source says about them."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass._values import Value, as_array, as_number, brief, frozen, refusal
from seismass.errors import InvalidMotion
from seismass.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from seismass.simulate import Motion


@dataclass(frozen=True, eq=False, repr=False)
class Record(Value):
    """Accelerations at a fixed time step, never changed in place: scaling makes a new record.

    Two records are equal when all that they hold is, labels included.

    Parameters
    ----------
    acceleration : array_like, shape (samples,)
        Ground acceleration (m/s2), first sample at t = 0; kept as a read-only copy.
    dt : float
        Time step (s).
    name : str
        Short name, for a file its name without the suffix.
    event, station, component : str
        What the source calls them; empty where it does not say.
    source : Path, optional
        The file it was read from.
    unit : str
        Unit of the accelerations in that file: "g", "m/s2" or "cm/s2". The samples here are in m/s2 whatever it is.
    synthetic : bool
        True for a made motion that no instrument recorded.
    vertical : array_like, shape (samples,), optional
        Vertical ground acceleration (m/s2, up positive) at the same instants.
    remarks : tuple of str
        What a reader had to interpret or leave out.
    azimuth : float, optional
        Direction of positive acceleration, degrees clockwise from north; None where the source does not say.
    network : str
        Network or agency that recorded it; empty where the source does not say.
    sha256 : str
        Digest of the bytes of the source file; empty for a record that no file holds.
    history : tuple of str
        What was done to the samples after reading, in order.

    Raises
    ------
    InvalidMotion
        No sample, a value that is not finite, a step that is not positive, components of different length, remarks or
        history that are no tuple of strings.
    """

    acceleration: NDArray[np.float64]
    dt: float
    name: str = ""
    event: str = ""
    station: str = ""
    component: str = ""
    source: Path | None = None
    unit: str = "m/s2"
    synthetic: bool = False
    vertical: NDArray[np.float64] | None = None
    remarks: tuple[str, ...] = ()
    azimuth: float | None = None
    network: str = ""
    sha256: str = ""
    history: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        what = f"record {self.name}" if self.name else "record"
        object.__setattr__(self, "dt", _number("dt", self.dt, what, positive=True))
        object.__setattr__(self, "acceleration", _samples("acceleration", self.acceleration, what))
        if self.vertical is not None:
            vertical = _samples("vertical", self.vertical, what)
            if len(vertical) != self.samples:
                raise InvalidMotion(
                    f"vertical of {what} must be as long as the horizontal, {self.samples} samples; "
                    f"got {len(vertical)} samples"
                )
            object.__setattr__(self, "vertical", vertical)
        if self.azimuth is not None:
            object.__setattr__(self, "azimuth", _number("azimuth", self.azimuth, what, positive=False))
        for parameter in ("remarks", "history"):
            sentences: Any = getattr(self, parameter)
            if not isinstance(sentences, tuple | list) or not all(isinstance(one, str) for one in sentences):
                raise refusal(InvalidMotion, parameter, what, "a tuple of strings", brief(sentences))
            object.__setattr__(self, parameter, tuple(sentences))

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

    @property
    def pga(self) -> float:
        """Largest absolute ground acceleration (m/s2)."""
        return float(np.max(np.abs(self.acceleration)))

    @property
    def pga_g(self) -> float:
        """Largest absolute ground acceleration, as a fraction of g."""
        return self.pga / STANDARD_GRAVITY

    @property
    def motion(self) -> Motion:
        """The samples as the kernel takes them."""
        from seismass.simulate import Motion  # reading records needs no kernel

        return Motion(self.acceleration, self.dt, self.vertical)

    def scaled(self, factor: float) -> Record:
        """Return the record with both components multiplied by `factor`, a finite number."""
        number = _number("factor", factor, "scaled record", positive=False)
        with np.errstate(over="ignore"):  # the new record refuses what overflows
            acceleration = self.acceleration * number
            vertical = None if self.vertical is None else self.vertical * number
        return self.replace(acceleration=acceleration, vertical=vertical)

    def time_scaled(self, factor: float) -> Record:
        """Return the record with its time step multiplied by `factor` > 0, as for a model at reduced scale."""
        return self.replace(dt=self.dt * _number("factor", factor, "time-scaled record", positive=True))

    def with_duration(self, duration: float) -> Record:
        """Return the record up to the sample nearest to `duration` (s), as `Motion.with_duration` does.

        Raises
        ------
        InvalidMotion
            The duration is negative or not finite.
        """
        changed = self.motion.with_duration(duration)
        return self.replace(acceleration=changed.acceleration, vertical=changed.vertical)

    def with_vertical(self, vertical: Record) -> Record:
        """Return the record with the accelerations of `vertical` beside its own, both cut to the shorter.

        Raises
        ------
        InvalidMotion
            The two have different time steps, or `vertical` is no record.
        """
        if not isinstance(vertical, Record):
            raise refusal(InvalidMotion, "vertical", f"record {self.name}".rstrip(), "a Record", brief(vertical))
        if not math.isclose(vertical.dt, self.dt, rel_tol=1e-9):
            raise InvalidMotion(
                f"dt of vertical record {vertical.name} must be that of the horizontal, {self.dt:g} s; "
                f"got {vertical.dt:g} s"
            )
        samples = min(self.samples, vertical.samples)
        remarks = self.remarks
        if self.samples != vertical.samples:
            remarks += (f"cut to {samples} samples: {self.samples} horizontal, {vertical.samples} vertical",)
        return self.replace(
            acceleration=self.acceleration[:samples],
            vertical=vertical.acceleration[:samples],
            remarks=remarks,
        )


def _number(parameter: str, value: Any, what: str, *, positive: bool) -> float:
    number = as_number(value, parameter, what, InvalidMotion)
    if not math.isfinite(number) or (positive and number <= 0.0):
        requirement = "a positive number" if positive else "a finite number"
        raise refusal(InvalidMotion, parameter, what, requirement, brief(value))
    return number


def _samples(parameter: str, values: ArrayLike, what: str) -> NDArray[np.float64]:
    samples = as_array(values, parameter, what, InvalidMotion)
    if len(samples) == 0:
        raise refusal(InvalidMotion, parameter, what, "a list of at least one sample", "none")
    wrong = np.flatnonzero(~np.isfinite(samples))
    if len(wrong):
        got = f"{samples[wrong[0]]} at sample {wrong[0]}"
        raise refusal(InvalidMotion, parameter, what, "finite at every sample", got)
    return samples
