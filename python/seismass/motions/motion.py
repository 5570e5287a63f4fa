"""Motion as the kernel takes it, and what may stand in its place."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.errors import InvalidMotion
from seismass.base.limits import MOST_SAMPLES, MOST_SECONDS
from seismass.base.units import STANDARD_GRAVITY, acceleration_factor
from seismass.base.values import FloatArray, Value, as_array, as_number, brief, frozen, refusal
from seismass.base.views import Card


class Motion(Value, Card):
    """Ground motion as the kernel takes it: acceleration, linear between samples, the first sample at t = 0.

    Parameters
    ----------
    acceleration : array_like, shape (samples,)
        Horizontal ground acceleration (in `unit`); kept in m/s2.
    dt : float
        Time step (s).
    vertical : array_like, shape (samples,), optional
        Vertical ground acceleration (in `unit`), up positive.
    unit : {"m/s2", "g", "cm/s2", "gal"}, default "m/s2"
        Unit of the accelerations that are given.

    Raises
    ------
    InvalidMotion
        No sample, a value that is not a finite number, an unknown unit, a step that is not positive,
        unequal lengths.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.Motion([0.0, 1.0, -2.0, 0.0], dt=0.01)
    Motion(4 samples x 0.01 s, PGA = 0.2039 g)
    """

    __slots__ = ("_kernel", "acceleration", "dt", "vertical")
    _kernel: _kernel.Motion
    acceleration: FloatArray
    dt: float
    vertical: FloatArray | None

    def __init__(
        self, acceleration: ArrayLike, dt: float, vertical: ArrayLike | None = None, *, unit: str = "m/s2"
    ) -> None:
        factor = acceleration_factor(unit, "motion", InvalidMotion)

        def checked(values: ArrayLike, name: str) -> FloatArray:
            samples = as_array(values, name, "motion", InvalidMotion)
            return samples if factor == 1.0 else frozen(samples * factor)

        self._set(
            acceleration=checked(acceleration, "acceleration"),
            dt=as_number(dt, "dt", "motion", InvalidMotion),
            vertical=None if vertical is None else checked(vertical, "vertical acceleration"),
        )
        self._set(_kernel=_kernel.Motion(self.acceleration, self.dt, self.vertical))

    @property
    def samples(self) -> int:
        """Number of samples."""
        return len(self.acceleration)

    @property
    def duration(self) -> float:
        """Time of the last sample (s)."""
        return (self.samples - 1) * self.dt

    @property
    def time(self) -> FloatArray:
        """Time of each sample (s), shape (samples,)."""
        return frozen(np.arange(self.samples) * self.dt)

    @property
    def pga(self) -> float:
        """Peak ground acceleration, horizontal (m/s2)."""
        return float(np.abs(self.acceleration).max())

    @property
    def pga_g(self) -> float:
        """Peak ground acceleration over g."""
        return self.pga / STANDARD_GRAVITY

    def with_duration(self, duration: float) -> Motion:
        """Return the motion up to the sample nearest to `duration`.

        Parameters
        ----------
        duration : float
            Time (s). Beyond the last sample the motion goes to zero over one step and stays there.

        Raises
        ------
        InvalidMotion
            The duration is negative or not finite, or after the last sample and more than 10^4 s or 10^7 steps.
        """
        end = as_number(duration, "duration", "motion", InvalidMotion)
        most = max(min(MOST_SECONDS, MOST_SAMPLES * self.dt), self.duration)
        if most < end < math.inf:  # what is not finite is refused by the kernel
            got = f"{end:g} s at a step of {self.dt:g} s"
            raise refusal(InvalidMotion, "duration", "motion", f"at most {most:g} s", got)
        changed = self._kernel.with_duration(end)
        return Motion(changed.acceleration, self.dt, changed.vertical)

    def scaled(self, factor: float) -> Motion:
        """Return the motion with both components multiplied by `factor`.

        Raises
        ------
        InvalidMotion
            The factor, or a sample times it, is not a finite number.
        """
        changed = self._kernel.scaled(as_number(factor, "factor", "scaled motion", InvalidMotion))
        return Motion(changed.acceleration, self.dt, changed.vertical)

    def _arguments(self) -> dict[str, Any]:
        return {"acceleration": self.acceleration, "dt": self.dt, "vertical": self.vertical}

    def __repr__(self) -> str:
        vertical = "" if self.vertical is None else ", with vertical"
        return f"Motion({self.samples} samples x {self.dt:g} s, PGA = {self.pga_g:.4g} g{vertical})"


def check_size(samples: int, dt: float, owner: str) -> None:
    """Refuse a motion of a file with more than `MOST_SAMPLES` samples or longer than `MOST_SECONDS`, whose runs would
    take minutes or all memory.
    """
    if samples > MOST_SAMPLES:
        raise refusal(InvalidMotion, "samples", owner, f"at most {MOST_SAMPLES}", str(samples))
    if (samples - 1) * dt > MOST_SECONDS:
        requirement = f"a step in seconds by which the motion ends before {MOST_SECONDS:g} s"
        raise refusal(InvalidMotion, "dt", owner, requirement, f"{dt:g} for {samples} samples")


@runtime_checkable
class HasMotion(Protocol):
    """What can be used in place of a motion, such as a Record."""

    @property
    def motion(self) -> Motion:
        """Its samples as the kernel takes them."""


MotionLike: TypeAlias = Motion | HasMotion
"""A Motion, or a Record as it is."""


def as_motion(motion: Any, parameter: str, owner: str) -> Motion:
    """Return a motion, or that of a record."""
    converted = motion if isinstance(motion, Motion) else getattr(motion, "motion", None)
    if not isinstance(converted, Motion):
        raise refusal(InvalidMotion, parameter, owner, "a Motion or a Record", brief(motion))
    return converted


def scaled_motions(motions: Iterable[Any], factors: Iterable[float]) -> list[Any]:
    """Return motions, records or pairs times a factor each."""
    return [motion.scaled(float(factor)) for motion, factor in zip(motions, factors, strict=True)]


def motion_names(motions: Iterable[Any]) -> list[str]:
    """Return the names of motions; one without a name is called by its number, from 1."""
    return [str(getattr(motion, "name", "")) or f"motion {n}" for n, motion in enumerate(motions, start=1)]
