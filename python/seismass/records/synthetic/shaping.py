"""Synthetic motions brought near a response spectrum: Fourier amplitudes are corrected, phases are kept.

The iteration of SIMQKE (Gasparini & Vanmarcke 1976): gain over frequency is target over response spectrum at the period
1 / frequency. Each motion has a target of its own, so that motions differ as records do.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.units import STANDARD_GRAVITY
from seismass.records.synthetic.ends import ramp

Array = NDArray[np.float64]

DAMPING: Final = 0.05

SDS_G, SD1_G, LONG_PERIOD = 1.07, 0.61, 8.0
"""The ASCE 7 shape aimed at (11.4.5): S_DS, S_D1 in g, T_L in s."""

LEVEL, LEVEL_SPREAD, SHAPE_SPREAD, SHAPE_CORRELATION = 0.85, 0.12, 0.25, 0.6
"""Median level of a motion against the shape, as of records before scaling; lognormal spread of that level and of the
wander over period; correlation length of the wander in ln T."""

MATCHED_PERIODS: Final = np.geomspace(0.05, 5.0, 90)
HIGH_PASS: Final = (0.08, 0.20)
LOW_PASS: Final = (12.0, 25.0)
"""Frequencies (Hz) between which the content rises from zero at its low end and falls to zero at its high end."""


def asce7_shape(period: Array) -> Array:
    """Return the ASCE 7 design spectrum (11.4.5) of this suite (m/s2)."""
    corner = SD1_G / SDS_G
    rising = SDS_G * (0.4 + 0.6 * period / (0.2 * corner))
    falling = np.where(period <= LONG_PERIOD, SD1_G / period, SD1_G * LONG_PERIOD / period**2)
    return STANDARD_GRAVITY * np.minimum(np.minimum(rising, SDS_G), falling)


def spectrum(acceleration: Array, dt: float, periods: Array) -> Array:
    """Return the pseudo-acceleration (m/s2) by Fourier transform, peaks at samples: good enough to shape a motion."""
    length = 2 ** math.ceil(math.log2(len(acceleration) + 30.0 / dt))
    transform = np.fft.rfft(acceleration, length)
    frequency = 2.0 * np.pi * frequencies(length, dt)
    values = np.empty(len(periods))
    for i, natural in enumerate(2.0 * np.pi / periods):
        transfer = natural**2 / (natural**2 - frequency**2 + 2j * DAMPING * natural * frequency)
        values[i] = np.max(np.abs(np.fft.irfft(transform * transfer, length)))
    return values


def frequencies(length: int, dt: float) -> Array:
    """Return the frequencies (Hz) of a real Fourier transform."""
    return np.fft.rfftfreq(length, dt).astype(np.float64)


def gain_over_frequency(log_ratio: Array, frequency: Array) -> Array:
    """Return exp(log_ratio), given at the matched periods, at frequencies (Hz); constant beyond its ends."""
    log_frequency = np.log(np.maximum(frequency, 1e-3))
    return np.exp(np.interp(log_frequency, -np.log(MATCHED_PERIODS[::-1]), log_ratio[::-1]))


def shaped(process: Array, dt: float, log_ratio: Array) -> Array:
    """Multiply the Fourier amplitudes by the ratio at the period 1 / frequency, and take off the highest."""
    length = 2 * len(process)  # zeros beside the motion keep it from wrapping round
    frequency = frequencies(length, dt)
    gain = gain_over_frequency(log_ratio, frequency) * (1.0 - ramp(frequency, *LOW_PASS))
    return np.fft.irfft(np.fft.rfft(process, length) * gain, length)[: len(process)]
