"""Wavelets that are added to a record: cosines in a window that closes, which leave no velocity and no displacement.

Each is the second difference of a displacement that is zero at its ends, so that it is free of drift to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.elementary import complex_series, joined, power, series_real
from seismass.base.values import FloatArray

WINDOW_POWER: Final = 6
"""The window is (1 - x^2) to this power: close to a Gaussian exp(-6 x^2), with five derivatives that close."""
LEAST_HALF_WIDTH: Final = 0.75
"""Half-width of a window, in periods, below which its centre is moved away from the end of the record instead."""
WIDE: Final = 2.5
"""Half-width of a wide window over that of another."""
EARLY: Final = 0.4
"""Time by which a wide window is centred before its crest, over its half-width: what comes later has no effect."""


def half_width(periods: FloatArray) -> FloatArray:
    """Return the half-width (s) of the window (1 - x^2)^n of a wavelet of each period, gamma sqrt(n): close to the
    Gaussian exp(-(t/gamma)^2), gamma = 1.178 f^-0.93, of Al Atik and Abrahamson (2010), eq. 16.
    """
    return np.asarray(1.178 * power(periods, 0.93) * np.sqrt(WINDOW_POWER))


@dataclass(frozen=True)
class Placed:
    """Wavelets at their places in a record: acceleration per unit of amplitude, zero outside the samples from `first`
    up to, not including, `last`; `shortened` where an end of the record narrowed or moved the window.
    """

    samples: FloatArray
    first: int
    last: int
    starts: NDArray[np.int64]
    ends: NDArray[np.int64]
    shortened: NDArray[np.bool_]


def place(
    crest: FloatArray, periods: FloatArray, damping: float, dt: float, samples: int, wide: NDArray[np.bool_]
) -> Placed:
    """Return wavelets as second differences of -cos(w (t - crest)) (1 - x^2)^6 / w^2: w damped frequency, x = (t -
    centre) over the half-width. With sum(a) = sum(a t) = 0 final velocity and displacement are zero.
    """
    inner = (samples - 3) * dt  # from the second sample to the last but one
    least = np.minimum(LEAST_HALF_WIDTH * periods, 0.5 * inner)
    full = np.where(wide, WIDE, 1.0) * half_width(periods)
    wanted = crest - np.where(wide, EARLY, 0.0) * full
    centre = np.clip(wanted, dt + least, dt + inner - least)
    half = np.minimum(full, np.minimum(centre - dt, dt + inner - centre))
    frequency = 2.0 * np.pi / periods * np.sqrt(1.0 - damping * damping)
    # One sample more on each side of the window, on which the second difference may differ from zero.
    starts = np.maximum(np.ceil((centre - half) / dt).astype(int) - 1, 0)
    ends = np.minimum(np.floor((centre + half) / dt).astype(int) + 2, samples)
    first, last = int(starts.min()), int(ends.max())
    placed = np.zeros((len(periods), last - first))
    angles = frequency * (dt * (starts - 1) - crest)
    far, near = complex_series(joined(0.0, angles), joined(0.0, frequency * dt), int((ends - starts).max()) + 2)
    for number, (row, start, end, middle, width, omega) in enumerate(
        zip(placed, starts, ends, centre, half, frequency, strict=True)
    ):
        time = dt * np.arange(start - 1, end + 1)
        window = np.maximum(1.0 - ((time - middle) / width) ** 2, 0.0)
        cosine = series_real(far[number], near[number])[: len(time)]
        displacement = (window * window * window) ** 2 * cosine
        row[start - first : end - first] = -np.diff(displacement, n=2) / (omega * dt) ** 2
    moved = (half < full * (1.0 - 1e-9)) | (centre != wanted)
    return Placed(placed, first, last, starts, ends, moved & ~wide)
