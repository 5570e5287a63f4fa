"""Inelastic oscillators: one storey of the kernel without blocks, run for its peak displacement alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.errors import InvalidScene, SimulationError
from seismass.base.values import FloatArray, as_number
from seismass.spectra.motions import GroundMotion, held

IndexArray: TypeAlias = NDArray[np.int64]

_LONGEST_FLOW: Final = 60.0
"""Longest time of plastic flow after a motion that is followed (s)."""


@dataclass(frozen=True)
class Oscillator:
    """An oscillator of 1 kg with a trilinear spring: period (s), first yield A_y (m/s2), damping ratio, shape."""

    period: float
    yield_acceleration: float
    damping: float
    overstrength: float
    second_slope: float
    third_slope: float

    def of_kernel(self) -> _kernel.Building:
        """Return the oscillator as the kernel takes it; InvalidScene where there is none of these numbers."""
        shape = {name: getattr(self, name) for name in ("overstrength", "second_slope", "third_slope")}
        numbers = {name: as_number(value, name, "oscillator", InvalidScene) for name, value in shape.items()}
        springs = {
            "stiffness": _kernel.uniform_stiffness(1, self.period, 1.0),
            "yield_shear": self.yield_acceleration,
            **numbers,
        }
        return _kernel.Building(
            np.ones(1), {name: np.full(1, value) for name, value in springs.items()}, damping_ratio=self.damping
        )

    def rest(self, motion: GroundMotion, largest: float) -> float:
        """Return the time (s) after the last sample of a motion in which a peak can still be reached."""
        yields = self.yield_acceleration * self.overstrength
        if not np.isfinite(yields):
            return 2.0 * self.period
        velocity = np.cumsum(np.asarray(motion.acceleration, dtype=np.float64)) * float(motion.dt)
        speed = 2.0 * largest * float(np.abs(velocity).max())
        rate = 4.0 * np.pi * self.damping / self.period
        # v' = -rate v - A_y comes to rest after ln(1 + rate v/A_y)/rate.
        flow = np.log1p(rate * speed / yields) / rate if rate > 0.0 else speed / yields
        return 2.0 * self.period + min(float(flow), _LONGEST_FLOW)


class Oscillators:
    """Oscillators run with factors of motions, continued at zero until free vibration and flow end. A factor s is a
    strength of 1/s: displacement of an oscillator s times weaker is that of this one over s.
    """

    def __init__(
        self, oscillators: Sequence[Oscillator], motions: Sequence[GroundMotion], largest: float, threads: int | None
    ) -> None:
        none = np.zeros((len(oscillators), 0))
        kernels = [oscillator.of_kernel() for oscillator in oscillators]
        self._columns = _kernel.Columns(kernels, [], np.arange(len(oscillators)), none, none, none)
        self._motions = []
        self._threads = threads
        for number, motion in enumerate(motions, start=1):
            rest = max(oscillator.rest(motion, largest) for oscillator in oscillators)
            given = held(motion, number)
            self._motions.append(given.with_duration((len(given.acceleration) - 1) * given.dt + rest))

    def peaks(self, oscillator: IndexArray, motion: IndexArray, factor: FloatArray) -> FloatArray:
        """Return the peak displacement (m) of each run, by indices of oscillator and motion (from 0) and the factor of
        the motion.
        """
        runs = np.stack([oscillator, motion], axis=1).astype(np.int64)
        scale = np.ascontiguousarray(factor, dtype=np.float64)
        batch = _kernel.simulate_columns(
            self._columns, self._motions, runs, scale, peaks_only=True, threads=self._threads
        )
        if batch.failures:
            run, reason = batch.failures[0]
            raise SimulationError(
                f"oscillator of period {oscillator[run] + 1} under motion {motion[run] + 1}: {reason}"
            )
        return np.asarray(batch.peak_drift)
