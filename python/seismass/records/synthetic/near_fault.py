"""The near-fault velocity pulse of Mavroeidis and Papageorgiou (2003, BSSA 93:1099, eq. 3) that ends where it began."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import InvalidMotion
from seismass.base.values import as_number, brief, refusal

Array = NDArray[np.float64]


def pulse(time: Array, centre: float, period: float, velocity: float) -> Array:
    """Return the ground acceleration of a Mavroeidis-Papageorgiou pulse with gamma = 2 and a phase of 90 degrees: odd
    about its centre, so that its displacement ends where it began.
    """
    gamma, phase = 2.0, 0.5 * math.pi
    circular = 2.0 * math.pi / period
    since = time - centre
    inside = np.abs(since) <= 0.5 * gamma * period
    carrier = circular * since + phase
    bell = circular * since / gamma
    rate = -circular * (np.sin(carrier) * (1.0 + np.cos(bell)) + np.cos(carrier) * np.sin(bell) / gamma)
    return np.where(inside, 0.5 * velocity * rate, 0.0)


@dataclass(frozen=True)
class NearFaultPulse:
    """A velocity pulse v(t) = -A/2 (1 + cos(2 pi s / (gamma T))) sin(2 pi s / T), s = t - centre, gamma = 2.

    It lasts two periods. Velocity and displacement are zero before and after it: of the phases of the published form
    only this one, 90 degrees, leaves no displacement.

    Parameters
    ----------
    period : float
        T (s).
    velocity : float
        A (m/s); the largest velocity is 0.87 A.
    centre : float
        Time of its middle (s), at least one period after the start of the motion.

    Raises
    ------
    InvalidMotion
        Period or velocity are not positive and finite, or the pulse begins before the motion.
    """

    period: float
    velocity: float
    centre: float

    def __post_init__(self) -> None:
        for name in ("period", "velocity", "centre"):
            value = as_number(getattr(self, name), name, "near-fault pulse", InvalidMotion)
            if not (math.isfinite(value) and value > 0.0):
                raise refusal(InvalidMotion, name, "near-fault pulse", "a positive number", brief(value))
            object.__setattr__(self, name, value)
        if self.centre < self.period:
            raise refusal(
                InvalidMotion,
                "centre",
                "near-fault pulse",
                f"at least its period, {self.period:g} s, so that the pulse begins after the motion",
                f"{self.centre:g} s",
            )

    @property
    def end(self) -> float:
        """Time (s) at which the pulse is over."""
        return self.centre + self.period

    def acceleration(self, time: Array) -> Array:
        """Return the ground acceleration of the pulse (m/s2) at times (s), of the shape of `time`."""
        return pulse(time, self.centre, self.period, self.velocity)
