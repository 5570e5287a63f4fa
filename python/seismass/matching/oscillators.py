"""Damped oscillators under acceleration that is linear between samples: response, extrema, and what one sample adds.

The recurrence is exact (Nigam and Jennings 1969, Bull. Seism. Soc. Am. 59:909-922), here as a digital filter of second
order. By linearity the displacement at an instant is a sum over samples; its weights are the rows of `influence`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.elementary import (
    complex_exp,
    complex_series,
    complex_sinh,
    exp,
    joined,
    scaled,
    series_imaginary,
    series_real,
    times,
)
from seismass.base.values import FloatArray
from seismass.matching.stopping import end_if_stopped

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
    """Oscillators of one damping ratio (from 0, below 1) at one time step (s); natural periods (s) are at least four
    time steps.
    """

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
        at = self._ramp(np.arange(len(periods)), np.full(len(periods), dt)) / dt
        once = times(self.weight, pole)
        after, later = once.real, times(once, pole).real
        self.numerator = np.array([at, after + back * at, later + back * after + further * at]).T
        self.denominator = np.array([np.ones(len(periods)), back, further]).T
        # Displacement at the end of a step: by what is there at its start, and by the acceleration at both ends.
        # By a constant acceleration of 1 m/s2.
        step = -1.0 / omega**2 - times(times(self.free, rate), pole).real
        self.from_displacement = pole.real - rate.real / rate.imag * pole.imag
        self.from_velocity = pole.imag / rate.imag
        self.from_start, self.from_end = step - at, at

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
            end_if_stopped()
            end = len(acceleration) + int(np.ceil(period / self.dt)) + 3
            moved = self.response(number, samples[:end])
            size = np.abs(moved)
            peak = (size[1:-2] >= size[:-3]) & (size[1:-2] > size[2:-1])
            at = np.flatnonzero(peak & (size[1:-2] >= UNDERSHOOT * share * size.max())) + 1
            rows.append((np.full(len(at), number), at, moved[at - 1], moved[at], moved[at + 1]))
        index, at, before, here, after = (np.concatenate(part) for part in zip(*rows, strict=True))
        # In the step after the sample where |u| still grows at it, else in the one before it.
        velocity = self._velocity(index, samples[at], samples[at + 1], here, after)
        earlier = velocity * here < 0.0
        step, start = at - earlier, np.where(earlier, before, here)
        end_of_step = np.where(earlier, here, after)
        fraction, value = self._turn(index, samples[step], samples[step + 1], start, end_of_step)
        order = np.lexsort((-np.abs(value), index))
        index, step, fraction, value = index[order], step[order], fraction[order], value[order]
        firsts = np.flatnonzero(np.diff(index, prepend=-1))
        counts = np.diff(firsts, append=len(index))
        rank = np.arange(len(index)) - np.repeat(firsts, counts)
        kept = (rank < most) & (np.abs(value) >= share * np.repeat(np.abs(value[firsts]), counts))
        return Extrema(index[kept], step[kept], fraction[kept], value[kept], (rank == 0)[kept])

    def influence(self, extrema: Extrema, first: int, last: int) -> FloatArray:
        """Return what samples `first` to `last` (not included) add to the displacement at each extremum (m per m/s2),
        shape (extrema, samples). Sample 0 counts as having a step before it, which a motion has not.
        """
        rows = np.zeros((len(extrema.value), last - first))
        within = extrema.fraction * self.dt
        after = self._ramp(extrema.oscillator, within) / self.dt
        here = self._ramp(extrema.oscillator, within + self.dt) / self.dt - 2.0 * after
        rate = self.rate[extrema.oscillator]
        turn = complex_exp(scaled(rate, within))
        # What a sample k + 1 steps before leaves, as an amplitude of the free vibration.
        per_step = scaled(self.rate, self.dt)
        far, near = complex_series(per_step, per_step, max(int(extrema.step.max()) - first, 1))
        far = times(self.weight[:, None], far)
        known, real, imag = -1, np.empty(0), np.empty(0)
        for number, (row, index, step) in enumerate(zip(rows, extrema.oscillator, extrema.step, strict=True)):
            if index != known:
                known = int(index)
                real, imag = series_real(far[index], near[index]), series_imaginary(far[index], near[index])
            end = min(int(step), last)  # samples before the step are one step or more before the extremum
            if end > first:
                before = slice(step - end, step - first)
                row[: end - first] = (real[before] * turn[number].real - imag[before] * turn[number].imag)[::-1]
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
        real = here - level
        velocity = self._velocity(index, start, end, here, after)
        swing = joined(real, -(velocity - drift - rate.real * real) / rate.imag)
        swung = times(swing, rate)
        time = np.full(len(index), 0.5 * self.dt)
        for _ in range(6):  # Newton; a step is at most a quarter of a period
            turning = times(swung, complex_exp(scaled(rate, time)))
            curvature = times(turning, rate).real
            curvature = np.where(curvature == 0.0, 1.0, curvature)
            time = np.clip(time - (drift + turning.real) / curvature, 0.0, self.dt)
        vibration = times(swing, complex_exp(scaled(rate, time)))
        return time / self.dt, level + drift * time + vibration.real
