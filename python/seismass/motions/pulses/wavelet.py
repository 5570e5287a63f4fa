"""The db4 wavelet of pulse identification: its continuous transform and one scaled wavelet as a history.

PyWavelets gives the wavelet and is imported on first use. Its own continuous transform takes no db4, so that this one
is built from the integral of the wavelet, as MATLAB's `cwt` is, by convolution through FFT.
"""

from __future__ import annotations

import functools
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import MissingPackage
from seismass.base.values import FloatArray, frozen

WAVELET: Final = "db4"
SUPPORT: Final = 7
"""Width of the wavelet in units of its scale."""
PERIOD_OF_SCALE: Final = 1.4
"""Period of the wavelet over scale times step: one over its centre frequency, 5/7."""
_LEVEL: Final = 4
"""Level of the wavelet that is subtracted (Shahi and Baker, 2014): sixteen points per unit, linear between them."""
_FINE_LEVEL: Final = 10


def _pywt() -> Any:
    try:
        import pywt
    except ImportError as error:
        raise MissingPackage(
            "PyWavelets of pulse identification must be installed (pip install PyWavelets); "
            f"got {str(error) or 'no such package'}"
        ) from error
    return pywt


@functools.cache
def _wavelet(level: int) -> tuple[FloatArray, FloatArray]:
    """Places from 0 to 7 and values of the wavelet of unit energy there."""
    _, psi, places = _pywt().Wavelet(WAVELET).wavefun(level)
    return frozen(places), frozen(psi)


@functools.cache
def _integral() -> FloatArray:
    """Integral of the wavelet from 0 to each of 1024 points per unit."""
    places, psi = _wavelet(_FINE_LEVEL)
    return frozen(np.cumsum(psi) * (places[1] - places[0]))


@functools.lru_cache(maxsize=128)
def _filter(scale: int) -> FloatArray:
    """Weights of a transform at one scale, shape (7 scale,): the integral of the wavelet over each sample. As in
    MATLAB's `cwt` the integral is taken at the point before, to meet published periods to the sample.
    """
    points = np.arange(SUPPORT * scale + 1) * 2**_FINE_LEVEL // scale
    return frozen(np.diff(_integral()[points]) * np.sqrt(scale))


def _before(scale: int) -> int:
    """Weights before the one that is centred on a sample."""
    return SUPPORT * scale // 2


@functools.lru_cache(maxsize=64)
def _spectrum(scale: int, size: int) -> NDArray[np.complex128]:
    """Conjugate Fourier transform of the weights: products with it are correlations."""
    from scipy.fft import rfft  # slow to import

    return np.asarray(np.conj(rfft(_filter(scale), size)))


def transform(velocity: FloatArray, scale: int) -> FloatArray:
    """Return the wavelet coefficient of unit energy centred on each sample, at one scale (samples), in the unit of the
    velocity times the root of a sample. The history is zero before and after.
    """
    return transform_near(velocity, scale, 0, len(velocity) - 1)


def transform_near(velocity: FloatArray, scale: int, first: int, last: int) -> FloatArray:
    """Return the coefficients of `transform` at one scale centred on the samples `first` to `last`, both included,
    computed only from the samples that these wavelets touch.
    """
    from scipy.fft import irfft, next_fast_len, rfft  # slow to import

    start = first - _before(scale)
    end = last - _before(scale) + SUPPORT * scale
    touched = velocity[max(0, start) : end]
    padded = np.zeros(next_fast_len(end - start, real=True))  # so long that nothing that is returned wraps around
    padded[max(0, -start) : max(0, -start) + len(touched)] = touched
    correlated = irfft(rfft(padded) * _spectrum(scale, len(padded)), len(padded))
    return np.asarray(correlated[: last - first + 1])


def coefficient(velocity: FloatArray, scale: int, sample: int) -> float:
    """Return the one coefficient at a scale that is centred on a sample."""
    start = sample - _before(scale)
    first, last = max(0, start), min(len(velocity), start + SUPPORT * scale)
    return float(velocity[first:last] @ _filter(scale)[first - start : last - start])


def wavelet_history(samples: int, scale: int, sample: int) -> FloatArray:
    """Return the wavelet of unit energy centred on a sample, as a history: level 4, linear between its points, divided
    by the root of the scale (samples).
    """
    places, psi = _wavelet(_LEVEL)
    phase = (np.arange(samples) - sample) / scale + 0.5 * SUPPORT
    return np.asarray(np.interp(phase, places, psi, left=0.0, right=0.0) / np.sqrt(scale))


def approximation_energy(velocity: FloatArray) -> float:
    """Return the energy of the approximation coefficients of one level of the discrete transform: half the frequencies,
    and nearly all the energy of a velocity.
    """
    approximation, _ = _pywt().dwt(velocity, WAVELET)
    return float(np.sum(np.square(approximation)))
