"""Inelastic oscillators: one-storey buildings without blocks, run by the kernel for their peak displacement alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.errors import SimulationError
from seismass.base.values import FloatArray
from seismass.model.building import Building, chain_kernel
from seismass.spectra.motions import GroundMotion, held

IndexArray: TypeAlias = NDArray[np.int64]

_LONGEST_FLOW: Final = 60.0
"""Longest time of plastic flow after a motion that is followed (s)."""


class Oscillators:
    """Oscillators run with factors of motions, continued at zero until free vibration and flow end. A factor s is a
    strength of 1/s: displacement of an oscillator s times weaker is that of this one over s.
    """

    def __init__(
        self, buildings: Sequence[Building], motions: Sequence[GroundMotion], largest: float, threads: int | None
    ) -> None:
        none = np.zeros((len(buildings), 0))
        kernels = [chain_kernel(building, "inelastic spectra") for building in buildings]
        self._columns = _kernel.Columns(kernels, [], np.arange(len(buildings)), none, none, none)
        self._motions = []
        self._threads = threads
        for number, motion in enumerate(motions, start=1):
            rest = max(_rest(building, motion, largest) for building in buildings)
            given = held(motion, number)
            self._motions.append(given.with_duration((len(given.acceleration) - 1) * given.dt + rest))

    def peaks(self, building: IndexArray, motion: IndexArray, factor: FloatArray) -> FloatArray:
        """Return the peak displacement (m) of each run, by indices of building and motion (from 0) and the factor of
        the motion.
        """
        runs = np.stack([building, motion], axis=1).astype(np.int64)
        scale = np.ascontiguousarray(factor, dtype=np.float64)
        batch = _kernel.simulate_columns(
            self._columns, self._motions, runs, scale, peaks_only=True, threads=self._threads
        )
        if batch.failures:
            run, reason = batch.failures[0]
            raise SimulationError(f"oscillator of period {building[run] + 1} under motion {motion[run] + 1}: {reason}")
        return np.asarray(batch.peak_drift)


def _rest(building: Building, motion: GroundMotion, largest: float) -> float:
    """Time (s) after the last sample in which a peak can still be reached."""
    period = float(building.periods[0])
    yield_acceleration = float(building.yield_shear[0] * building.overstrength[0] / building.mass[0])
    if not np.isfinite(yield_acceleration):
        return 2.0 * period
    velocity = np.cumsum(np.asarray(motion.acceleration, dtype=np.float64)) * float(motion.dt)
    speed = 2.0 * largest * float(np.abs(velocity).max())
    rate = float(building.damping_matrix[0, 0] / building.mass[0])
    # v' = -rate v - A_y comes to rest after ln(1 + rate v/A_y)/rate.
    flow = np.log1p(rate * speed / yield_acceleration) / rate if rate > 0.0 else speed / yield_acceleration
    return 2.0 * period + min(float(flow), _LONGEST_FLOW)
