"""What the two methods share: velocities of two components, the scales searched, the pulse of ten wavelets, and the db4
wavelet with its continuous transform.

The algorithm is that of Shahi and Baker (2014), Bulletin of the Seismological Society of America 104:2456. PyWavelets
gives the wavelet and is imported on first use. Its own continuous transform takes no db4, so that this one is built
from the integral of the wavelet, as MATLAB's `cwt` is, by convolution through FFT.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import InvalidMotion, MissingPackage
from seismass.base.values import FloatArray, brief, frozen, refusal
from seismass.motions.pulses.result import BAKER, PERIOD_OF_SCALE, SHAHI_BAKER
from seismass.motions.records.pair import Pair
from seismass.motions.records.record import Record
from seismass.motions.records.rotd import drift_remarks

WAVELET: Final = "db4"
SUPPORT: Final = 7
"""Width of the wavelet in units of its scale."""
_LEVEL: Final = 4
"""Level of the wavelet that is subtracted (Shahi and Baker, 2014): sixteen points per unit, linear between them."""
_FINE_LEVEL: Final = 10
SHORTEST_PERIOD: Final = 0.25
"""Shortest pulse period that is looked for (s)."""
LONGEST_PERIOD: Final = 15.0
"""Longest pulse period that is looked for (s)."""
STEPS_OF_SCALE: Final = 50
"""Scales searched are this many and one more."""
WAVELETS: Final = 10
"""Wavelets of one scale whose sum is the pulse."""
REFINEMENTS: Final = 201
"""Scales at most that are tried between two of the search: every one for steps above 2 ms, as in the papers' code."""
NEIGHBOURHOOD: Final = 0.4
"""Further wavelets of a pulse, and no other candidate, are within this many scales of its first wavelet."""
SMALLEST_PEAK: Final = 1e-100
LARGEST_PEAK: Final = 1e100
LONGEST_SHARE: Final = 0.5
"""Pulse periods above this share of the duration are remarked on."""
CENTIMETRES: Final = 100.0
"""Velocities in cm/s, the unit of both methods' constants, over those in m/s."""


@dataclass(frozen=True, eq=False)
class Horizontals:
    """Two perpendicular horizontal velocities (m/s) of one length: the first component and the one at right angles,
    towards the second. `turn` is 1 where the second is clockwise from the first, else -1.
    """

    names: tuple[str, str]
    velocities: tuple[FloatArray, FloatArray]
    dt: float
    azimuth_of_first: float | None
    turn: float
    remarks: tuple[str, ...]

    def towards(self, angle: float) -> FloatArray:
        """Return the velocity (m/s) along a direction `angle` radians from the first component to the second."""
        first, second = self.velocities
        return np.asarray(first * math.cos(angle) + second * math.sin(angle))

    def azimuth(self, angle: float) -> float | None:
        """Return the direction of an angle in degrees from north, 0 to 180, or None where it is not known."""
        if self.azimuth_of_first is None:
            return None
        return (self.azimuth_of_first + self.turn * math.degrees(angle)) % 180.0


def single_velocity(record: Any, owner: str) -> FloatArray:
    """Return the velocity (m/s) of one record, whose step must not be longer than the shortest pulse allows."""
    if not isinstance(record, Record):
        raise refusal(InvalidMotion, "record", owner, "a Record", brief(record))
    scale_range(record.dt, owner)
    what, peak = f"record {record.name}".rstrip(), float(np.max(np.abs(record.velocity)))
    if peak == 0.0:
        raise refusal(InvalidMotion, "acceleration", what, "other than zero somewhere", "zero throughout")
    if not SMALLEST_PEAK < peak < LARGEST_PEAK:
        requirement = f"between {SMALLEST_PEAK:g} and {LARGEST_PEAK:g} m/s, whose squares are numbers"
        raise refusal(InvalidMotion, "peak velocity", what, requirement, f"{peak:g} m/s")
    return record.velocity


def horizontals(first: Any, second: Any, owner: str) -> Horizontals:
    """Return the velocities of a pair, or of two records, which are brought together as in `Pair.from_records`."""
    if isinstance(first, Pair) and second is None:
        pair = first
    elif isinstance(first, Record) and isinstance(second, Record):
        pair = Pair.from_records(first, second)
    else:
        got = brief(first) if second is None else f"{brief(first)} and {brief(second)}"
        raise refusal(InvalidMotion, "records", owner, "a Pair, or two Records", got)
    for record in (pair.first, pair.second):
        single_velocity(record, owner)
    return Horizontals(
        names=(pair.first.name, pair.second.name),
        velocities=(pair.first.velocity, pair.component(90.0).velocity),
        dt=pair.dt,
        azimuth_of_first=None if pair.azimuths is None else pair.azimuths[0],
        turn=math.copysign(1.0, pair.apart),
        remarks=_of_horizontals(pair) + drift_of((pair.first, pair.second)),
    )


def _of_horizontals(pair: Pair) -> tuple[str, ...]:
    """Remarks of a pair but those on its vertical component, which has no part in this."""
    vertical = "" if pair.vertical is None else pair.vertical.name
    return tuple(remark for remark in pair.remarks if not (vertical and remark.startswith(f"{vertical} ")))


def drift_of(records: Iterable[Record]) -> tuple[str, ...]:
    """Return remarks on records whose velocity does not end near zero: a drift of the baseline may pass for a pulse."""
    return tuple(
        f"{record.name or 'record'} {remark}"
        for record in records
        for remark in drift_remarks(record)
        if remark.startswith("ends with a velocity")
    )


def doubtful_period(period: float, duration: float) -> tuple[str, ...]:
    """Return a remark on a wavelet whose period is above half the duration of the record (both s)."""
    if period <= LONGEST_SHARE * duration:
        return ()
    return (
        f"the period of the wavelet, {period:.2f} s, is above half the record, {duration:.2f} s: cut off or no pulse",
    )


def scale_range(dt: float, owner: str) -> range:
    """Return the 51 scales searched, in samples: from the shortest to just above the longest pulse period."""
    smallest = math.floor(SHORTEST_PERIOD / PERIOD_OF_SCALE / dt)
    if smallest < 1:
        most = SHORTEST_PERIOD / PERIOD_OF_SCALE
        raise refusal(InvalidMotion, "dt", owner, f"at most {most:.4g} s, to show pulses of 0.25 s", f"{dt:g} s")
    step = math.ceil((LONGEST_PERIOD / PERIOD_OF_SCALE / dt - smallest) / STEPS_OF_SCALE)
    return range(smallest, smallest + STEPS_OF_SCALE * step + 1, step)


@dataclass(frozen=True, eq=False)
class Extraction:
    """A pulse that was taken out of a velocity: scale of its wavelets in samples, centres and coefficients of the ten
    wavelets in order of extraction, their sum and the residual, shape (samples,).
    """

    scale: int
    samples: tuple[int, ...]
    coefficients: tuple[float, ...]
    pulse: FloatArray
    residual: FloatArray


def extract(velocity: FloatArray, scales: range, row: int, sample: int) -> Extraction:
    """Take ten wavelets of one scale out of a velocity: the whole scale near `scales[row]` with the largest coefficient
    at `sample`; each wavelet is the largest of the residual within 0.4 scales of the sample.
    """
    low, high = scales[max(0, row - 1)], scales[min(len(scales) - 1, row + 1)]
    samples_between = range(low, high + 1, math.ceil((high + 1 - low) / REFINEMENTS))
    scale = max(samples_between, key=lambda one: abs(coefficient(velocity, one, sample)))
    reach = math.ceil(NEIGHBOURHOOD * scale)
    lowest, highest = max(0, sample - reach), min(len(velocity) - 1, sample + reach)
    residual, pulse = velocity.copy(), np.zeros(len(velocity))
    centres, coefficients = [], []
    for _ in range(WAVELETS):
        near = transform_near(residual, scale, lowest, highest)
        place = int(np.argmax(np.abs(near)))
        centres.append(lowest + place)
        coefficients.append(float(near[place]))
        pulse += coefficients[-1] * wavelet_history(len(velocity), scale, centres[-1])
        residual = velocity - pulse
    return Extraction(scale, tuple(centres), tuple(coefficients), pulse, residual)


def cumulative_share(velocity: FloatArray) -> FloatArray:
    """Return the running sum of squares over the whole, at each sample; zero where the whole is."""
    running = np.cumsum(np.square(velocity))
    return np.asarray(running / running[-1] if running[-1] > 0.0 else running)


PULSE_ABOVE: Final = 0.85
"""Baker (2007): a pulse has an indicator above this."""
NO_PULSE_BELOW: Final = 0.15
"""Baker (2007): no pulse where the indicator is below this; between the two it is ambiguous."""
LEAST_PGV: Final = 0.30
"""Baker (2007): peak velocity (m/s) that a pulse-like record is above."""
ARRIVAL: Final = {BAKER: (0.10, 0.20), SHAHI_BAKER: (0.05, 0.17)}
"""Early arrival, by method: when the pulse has the first share of its energy, the record has less than the second."""


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
