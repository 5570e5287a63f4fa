"""What a contestant is: settings that turn a scene into the same outcome, from the scene to the arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenes import BenchmarkScene

FloatArray = NDArray[np.float64]
EVERYWHERE = (
    "section4-0.05",
    "section4-0.5",
    "section4-0.05-fine",
    "section4-0.5-fine",
    "study-2",
    "study-3",
    "study-4",
    "sliding",
    "elastic",
)
MAIN = ("section4-0.05",)
"""The scene of the figure at the head of the page; what is too slow for the others runs here."""


class Failed(Exception):
    """A contestant did not finish; the message says why and goes into the table."""


class Absent(Exception):
    """A package that a contestant needs is not installed."""


@dataclass(frozen=True)
class Outcome:
    """What every contestant hands back; None where it does not give that at all.

    Attributes
    ----------
    drift, slip : ndarray, shape (samples, storeys) and (samples, blocks), or None
        Histories at the samples of the motion (m).
    peak_drift, peak_slip : ndarray
        Largest absolute values over the run, as finely as the contestant knows them (m).
    residual_slip : ndarray, shape (blocks,)
        Slip at the last sample (m).
    """

    drift: FloatArray | None
    slip: FloatArray | None
    peak_drift: FloatArray
    peak_slip: FloatArray
    residual_slip: FloatArray


@dataclass(frozen=True)
class Setting:
    """One way to run a contestant: a point of the figure on each of its scenes.

    `work` gets the scene and its step or tolerance; the whole of it is timed. `quick`: also part of the quick mode.
    """

    family: str
    label: str
    work: Callable[[BenchmarkScene], Outcome]
    scenes: Sequence[str] = EVERYWHERE
    quick: bool = True


def from_histories(
    drift: FloatArray, slip: FloatArray, drift_rate: FloatArray, slip_rate: FloatArray, dt: float
) -> Outcome:
    """Return the outcome of a contestant that knows its response and its rates at the samples only."""
    if not (np.isfinite(drift).all() and np.isfinite(slip).all()):
        raise Failed("the response is not finite")
    return Outcome(drift, slip, hermite_peaks(drift, drift_rate, dt), hermite_peaks(slip, slip_rate, dt), slip[-1])


def hermite_peaks(value: FloatArray, rate: FloatArray, dt: float | FloatArray) -> FloatArray:
    """Return the largest absolute values of the cubics through values and rates, per column; dt or one per interval."""
    peaks: FloatArray = np.abs(value).max(axis=0)
    y0, y1, m0, m1 = value[:-1], value[1:], dt * rate[:-1], dt * rate[1:]
    a, b = 3.0 * (2.0 * (y0 - y1) + m0 + m1), 3.0 * (y1 - y0) - 2.0 * m0 - m1
    with np.errstate(divide="ignore", invalid="ignore"):
        # The stable root of a s^2 + 2 b s + m0: the other is beyond the interval, or the response turns twice in it.
        s = -m0 / (b + np.copysign(np.sqrt(b * b - a * m0), b))
        inside = y0 + s * (m0 + s * (b + s * a / 3.0))
    inside = np.where((s > 0.0) & (s < 1.0), np.abs(inside), 0.0)
    larger: FloatArray = np.maximum(peaks, inside.max(axis=0))
    return larger
