"""Products and systems of the size of a spectral matching, with the same bits from any linear algebra library.

The sums in a matrix product may be taken in any order, with and without fused multiply-add, and by any number of
threads: the factors have so few bits that no sum is rounded (the splitting of Ozaki, Ogita, Oishi and Rump 2012, Numer.
Algor. 59:95-118). The rest is elementwise.

Products are taken in pieces for which the library beneath has one thread; its threads wait for each other on a busy
machine, a hundred times as long as the work takes.
"""

from __future__ import annotations

import math
from contextvars import ContextVar
from dataclasses import dataclass
from threading import Event
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from seismass.base.values import FloatArray
from seismass.motions.elementary import (
    complex_exp,
    complex_series,
    complex_sinh,
    exp,
    joined,
    power,
    scaled,
    series_imaginary,
    series_real,
    times,
)


class Stopped(Exception):
    """The suite that a motion belongs to is given up."""


CANCELLED: Final[ContextVar[Event | None]] = ContextVar("STOP", default=None)
"""Set where the threads of a suite are to end, as on Ctrl-C; none in a thread that matches one motion alone."""


def end_if_cancelled() -> None:
    """Raise `Stopped` where the event of this thread is set."""
    cancelled = CANCELLED.get()
    if cancelled is not None and cancelled.is_set():
        raise Stopped


Halves: TypeAlias = tuple[FloatArray, FloatArray]

SINGLE_THREAD: Final = 64**3
"""Multiplications of a product up to which OpenBLAS has one thread: 4 times its least, 65536."""
TILE: Final = 64
"""Rows and columns of a piece of a product."""
LARGEST_RIDGE: Final = 1e-3
"""Share of the largest diagonal element that is added to an indefinite matrix at most."""
LEAST_RIDGE: Final = 1e-14
"""The same, at first."""
BLOCK: Final = 32
"""Rows of a block of a factorisation."""
REFINED: Final = 2
"""Times that the factors are used, again on what is left: they have 48 bits."""
HALVED: Final = 16
"""Rows of a matrix that are split at a time."""
BITS: Final = 53
"""Bits of a double."""
UPPER: Final = 1.5 * 2.0 ** (BITS - 1 - 24)
"""Added to a number up to 1 and subtracted, it leaves 24 bits, of which 32 products have an exact sum."""
LOWER: Final = 1.5 * 2.0 ** (BITS - 1 - 48)
"""The same for the next 24 bits."""


def coarse(matrix: FloatArray, bits: int = BITS // 2) -> FloatArray:
    """Return a matrix whose rows are rounded to `bits` bits, whole multiples of 2^-bits of a power of two above the
    norm. By Cauchy-Schwarz sums of products of such rows are exact if their bits are 52 together.
    """
    _, exponent = np.frexp(np.sqrt(np.einsum("ij,ij->i", matrix, matrix)))
    large = np.ldexp(1.5, exponent + (BITS - 1 - bits))[:, None]  # its last bit is that multiple
    rounded = matrix + large
    rounded -= large
    return np.asarray(rounded)


def halves(matrix: FloatArray, bits: int = BITS // 2) -> Halves:
    """Return two `coarse` matrices whose sum has twice as many bits of a matrix."""
    upper, lower = np.empty_like(matrix), np.empty_like(matrix)
    for start in range(0, len(matrix), HALVED):  # as many rows as a cache holds
        rows = slice(start, start + HALVED)
        upper[rows] = coarse(matrix[rows], bits)
        lower[rows] = coarse(matrix[rows] - upper[rows], bits)
    return upper, lower


def exact_product(left: FloatArray, right: FloatArray) -> FloatArray:
    """Return the product of `coarse` matrices of shapes (rows, inner) and (inner, columns), without rounding. The right
    one is coarse by column.
    """
    (rows, inner), columns = left.shape, right.shape[1]
    height, depth = max(min(rows, TILE), 1), max(min(inner, SINGLE_THREAD // TILE // min(max(columns, 1), TILE)), 1)
    width = SINGLE_THREAD // (height * depth)
    result = np.zeros((rows, columns))
    for top in range(0, rows, height):
        end_if_cancelled()
        for start in range(0, columns, width):
            tile = result[top : top + height, start : start + width]
            for first in range(0, inner, depth):
                tile += (
                    left[top : top + height, first : first + depth]
                    @ right[first : first + depth, start : start + width]
                )
    return result


def product(left: Halves, right: Halves) -> FloatArray:
    """Return the product, shape (rows, columns), of a matrix of shape (rows, inner) and a transposed one of shape
    (columns, inner), whose `halves` are given.
    """
    (upper, lower), (above, below) = left, right
    small = exact_product(upper, below.T) + exact_product(lower, above.T)
    return np.asarray(small + exact_product(upper, above.T))


def solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return the solution of a symmetric positive definite system, by Cholesky's factors block by block. Where rounding
    has made it indefinite, as little as it takes is added to the diagonal.
    """
    largest = float(np.max(np.abs(np.diag(matrix))))
    ridge = 0.0
    while True:
        try:
            return _by_cholesky(matrix + ridge * np.eye(len(right)) if ridge > 0.0 else matrix, right)
        except np.linalg.LinAlgError:
            ridge = max(10.0 * ridge, LEAST_RIDGE * largest)
            if not ridge < LARGEST_RIDGE * largest:
                raise


def _by_cholesky(matrix: FloatArray, right: FloatArray) -> FloatArray:
    diagonal = np.diag(matrix)
    if not ((diagonal > 0.0) & np.isfinite(diagonal)).all():
        raise np.linalg.LinAlgError("matrix must be positive definite")
    # By powers of two, so that the diagonal is from 1/4 to 1. No element of the factor, nor of what is left of the
    # matrix, is larger than 1 then.
    scale = np.ldexp(1.0, -np.frexp(np.sqrt(diagonal))[1])
    rest = matrix * scale * scale[:, None]
    factors = []
    for start in range(0, len(right), BLOCK):
        block, below = slice(start, start + BLOCK), slice(start + BLOCK, None)
        inverse = _inverse_factor(rest[block, block])
        panel = product(_halves_below_1(rest[below, block]), halves(inverse))
        _subtract_square(rest[below, below], _halves_below_1(panel))
        factors.append((block, below, inverse, panel))
    solution = np.zeros(len(right))
    for _ in range(REFINED):
        change = (right - np.einsum("ij,j->i", matrix, solution)) * scale
        for block, below, inverse, panel in factors:
            change[block] = np.einsum("ij,j->i", inverse, change[block])
            change[below] -= np.einsum("ij,j->i", panel, change[block])
        for block, below, inverse, panel in reversed(factors):
            moved = change[block] - np.einsum("ij,i->j", panel, change[below])
            change[block] = np.einsum("ij,i->j", inverse, moved)
        solution += change * scale
    return solution


def _halves_below_1(matrix: FloatArray) -> Halves:
    """The `halves` of a matrix of up to `BLOCK` columns and of numbers up to 1."""
    upper = (matrix + UPPER) - UPPER
    return upper, ((matrix - upper) + LOWER) - LOWER


def _subtract_square(matrix: FloatArray, parts: Halves) -> None:
    """Subtract from a symmetric matrix, on and below its diagonal, the product of another with its transpose."""
    upper, lower = parts
    for top in range(0, len(matrix), TILE):
        rows, columns = slice(top, top + TILE), slice(0, top + TILE)
        matrix[rows, columns] -= product((upper[rows], lower[rows]), (upper[columns], lower[columns]))


def _inverse_factor(matrix: FloatArray) -> FloatArray:
    """The inverse of Cholesky's lower factor of a small matrix, of which the part on and below the diagonal is read."""
    size = len(matrix)
    rows = np.zeros((size, 2 * size))
    lower = np.tri(size, dtype=bool)
    rows[:, :size] = np.where(lower, matrix, matrix.T)
    rows[:, size:].flat[:: size + 1] = 1.0
    for number in range(size):
        pivot = float(rows[number, number])
        if not 0.0 < pivot < math.inf:
            raise np.linalg.LinAlgError("matrix must be positive definite")
        row = rows[number] / math.sqrt(pivot)
        rows[number + 1 :] -= row[number + 1 : size, None] * row
        rows[number] = row
    return np.ascontiguousarray(rows[:, size:])


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


UNDERSHOOT: Final = 0.6
"""Share of an extremum that the samples beside it reach at least, with four samples or more in a period."""


@dataclass(frozen=True)
class Extrema:
    """Local extrema of the relative displacement (m, signed) of oscillators, one oscillator after another: at time
    (step + fraction) dt; `largest` marks the largest of its oscillator.
    """

    oscillator: NDArray[np.int64]
    step: NDArray[np.int64]
    fraction: FloatArray
    value: FloatArray
    largest: NDArray[np.bool_]


class Oscillators:
    """Oscillators of a damping ratio (from 0, below 1) at a time step (s), of periods (s) of at least four steps."""

    def __init__(self, periods: FloatArray, damping: float, dt: float) -> None:
        self.periods, self.damping, self.dt = periods, damping, dt
        self.omega = omega = 2.0 * np.pi / periods
        self.rate = rate = joined(-damping * omega, np.sqrt(1.0 - damping * damping) * omega)
        # Displacement under a ramp of acceleration t from rest: -(t/w^2 - 2 z/w^3) - Re(free exp(rate t)).
        self.free = joined(
            2.0 * damping / (omega * omega * omega), (1.0 - 2.0 * damping * damping) / (omega**2 * rate.imag)
        )
        # Amplitude of the free vibration after a sample of 1 m/s2: a second difference of exponentials in closed form.
        root = complex_sinh(scaled(rate, 0.5 * dt))
        self.weight = times(scaled(self.free, -4.0 / dt), times(root, root))
        pole = complex_exp(scaled(rate, dt))
        back, further = -2.0 * pole.real, exp(2.0 * dt * rate.real)
        # Displacement at the instant of such a sample and at the two after it.
        ramp = self._ramp(np.arange(len(periods)), np.full(len(periods), dt)) / dt
        once = times(self.weight, pole)
        after, later = once.real, times(once, pole).real
        self.numerator = np.array([ramp, after + back * ramp, later + back * after + further * ramp]).T
        self.denominator = np.array([np.ones(len(periods)), back, further]).T
        # Displacement at the end of a step: by what is there at its start, and by the acceleration at both ends.
        # By a constant acceleration of 1 m/s2.
        step = -1.0 / omega**2 - times(times(self.free, rate), pole).real
        self.from_displacement = pole.real - rate.real / rate.imag * pole.imag
        self.from_velocity = pole.imag / rate.imag
        self.from_start, self.from_end = step - ramp, ramp

    def response(self, index: int, acceleration: FloatArray) -> FloatArray:
        """Return the relative displacement (m) of one oscillator at the samples, from rest at the first."""
        from scipy.signal import lfilter  # slow to import

        numerator = self.numerator[index]
        # There is no ramp before the first sample, as the filter has it.
        start = acceleration[0] * np.array([-numerator[0], self.from_start[index] - numerator[1]])
        moved, _ = lfilter(numerator, self.denominator[index], acceleration, zi=start)
        return np.asarray(moved)

    def extrema(self, acceleration: FloatArray, share: float, most: int) -> Extrema:
        """Return the extrema of each oscillator under acceleration (m/s2), in continuous time with one period of free
        vibration at the end: those above `share` of its largest, and the `most` largest.
        """
        longest = int(np.ceil(self.periods.max() / self.dt)) + 3
        samples = np.concatenate([acceleration, np.zeros(longest)])
        rows: list[Any] = []
        for number, period in enumerate(self.periods):
            end_if_cancelled()
            end = len(acceleration) + int(np.ceil(period / self.dt)) + 3
            moved = self.response(number, samples[:end])
            size = np.abs(moved)
            peak = (size[1:-2] >= size[:-3]) & (size[1:-2] > size[2:-1])
            tops = np.flatnonzero(peak & (size[1:-2] >= UNDERSHOOT * share * size.max())) + 1
            rows.append((np.full(len(tops), number), tops, moved[tops - 1], moved[tops], moved[tops + 1]))
        index, tops, before, here, after = (np.concatenate(part) for part in zip(*rows, strict=True))
        # In the step after the sample where |u| still grows at it, else in the one before it.
        velocity = self._velocity(index, samples[tops], samples[tops + 1], here, after)
        earlier = velocity * here < 0.0
        step, start = tops - earlier, np.where(earlier, before, here)
        end_of_step = np.where(earlier, here, after)
        fraction, value = self._turn(index, samples[step], samples[step + 1], start, end_of_step)
        order = np.lexsort((-np.abs(value), index))
        index, step, fraction, value = index[order], step[order], fraction[order], value[order]
        firsts = np.flatnonzero(np.diff(index, prepend=-1))
        counts = np.diff(firsts, append=len(index))
        rank = np.arange(len(index)) - np.repeat(firsts, counts)
        is_large = (rank < most) & (np.abs(value) >= share * np.repeat(np.abs(value[firsts]), counts))
        return Extrema(index[is_large], step[is_large], fraction[is_large], value[is_large], (rank == 0)[is_large])

    def influence(self, extrema: Extrema, first: int, last: int) -> FloatArray:
        """Return what samples `first` to `last` (not included) add to the displacement at each extremum (m per m/s2),
        shape (extrema, samples). Sample 0 counts as having a step before it, which a motion has not.
        """
        rows = np.zeros((len(extrema.value), last - first))
        time_in_step = extrema.fraction * self.dt
        after = self._ramp(extrema.oscillator, time_in_step) / self.dt
        here = self._ramp(extrema.oscillator, time_in_step + self.dt) / self.dt - 2.0 * after
        rate = self.rate[extrema.oscillator]
        turn = complex_exp(scaled(rate, time_in_step))
        # What a sample k + 1 steps before leaves, as an amplitude of the free vibration.
        per_step = scaled(self.rate, self.dt)
        far, near = complex_series(per_step, per_step, max(int(extrema.step.max()) - first, 1))
        far = times(self.weight[:, None], far)
        known, real_part, imag = -1, np.empty(0), np.empty(0)
        for number, (row, index, step) in enumerate(zip(rows, extrema.oscillator, extrema.step, strict=True)):
            if index != known:
                known = int(index)
                real_part, imag = series_real(far[index], near[index]), series_imaginary(far[index], near[index])
            end = min(int(step), last)  # samples before the step are one step or more before the extremum
            if end > first:
                before = slice(step - end, step - first)
                row[: end - first] = (real_part[before] * turn[number].real - imag[before] * turn[number].imag)[::-1]
            if first <= step < last:
                row[step - first] = here[number]
            if first <= step + 1 < last:
                row[step + 1 - first] = after[number]
        return rows

    def _ramp(self, index: NDArray[np.int64], time: FloatArray) -> FloatArray:
        """Displacement at times from 0 on under an acceleration of 1 m/s3 times the time."""
        omega = self.omega[index]
        linear = time / omega**2 - 2.0 * self.damping / (omega * omega * omega)
        rate = self.rate[index]
        return np.asarray(-linear - times(self.free[index], complex_exp(scaled(rate, time))).real)

    def _velocity(
        self, index: NDArray[np.int64], start: FloatArray, end: FloatArray, here: FloatArray, after: FloatArray
    ) -> FloatArray:
        """Velocity at the start of a step, from the accelerations and the displacements at its two ends."""
        forced = self.from_start[index] * start + self.from_end[index] * end
        return np.asarray((after - self.from_displacement[index] * here - forced) / self.from_velocity[index])

    def _turn(
        self, index: NDArray[np.int64], start: FloatArray, end: FloatArray, here: FloatArray, after: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Where within a step the velocity is zero, as a fraction of the step, and the displacement there."""
        omega, rate = self.omega[index], self.rate[index]
        # u = level + drift t + Re(swing exp(rate t)): static displacement under the linear acceleration, and the rest.
        drift = -(end - start) / self.dt / omega**2
        level = -start / omega**2 - 2.0 * self.damping / omega * drift
        distance = here - level
        velocity = self._velocity(index, start, end, here, after)
        swing = joined(distance, -(velocity - drift - rate.real * distance) / rate.imag)
        swung = times(swing, rate)
        time = np.full(len(index), 0.5 * self.dt)
        for _ in range(6):  # Newton; a step is at most a quarter of a period
            turning = times(swung, complex_exp(scaled(rate, time)))
            curvature = times(turning, rate).real
            curvature = np.where(curvature == 0.0, 1.0, curvature)
            time = np.clip(time - (drift + turning.real) / curvature, 0.0, self.dt)
        vibration = times(swing, complex_exp(scaled(rate, time)))
        return time / self.dt, level + drift * time + vibration.real
