"""The mean spectrum of a suite as a target: solved for at the periods asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.digest import inputs_digest
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, as_array, as_number, counted, frozen, refusal
from seismass.spectra.checks import OWNER
from seismass.spectra.elastic import mean_spectrum
from seismass.spectra.motions import GroundMotion, as_motions

CORNER_PERIODS: Final = np.geomspace(0.05, 4.0, 60)
"""Periods (s) among which `corner_period` looks for the peaks of a spectrum."""


def corner_period(spectrum: Callable[[FloatArray], ArrayLike]) -> float:
    """Return T_c, where constant acceleration and constant velocity at the peaks of a spectrum would meet.

    T_c = 2 pi max(Sv)/max(Sa) with Sv = Sa T/(2 pi), over periods from 0.05 to 4 s. Of the two-period shape of ASCE 7
    it is T_S = S_D1/S_DS.

    Parameters
    ----------
    spectrum : callable
        Takes periods (s), returns pseudo-accelerations; their unit does not matter. A `TargetSpectrum` is one, and
        `TargetSpectrum.mean_of` makes one of motions.

    Examples
    --------
    >>> import seismass as sm
    >>> from seismass.spectra import corner_period
    >>> round(corner_period(sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.6)), 6)
    0.6
    """
    accelerations = np.asarray(spectrum(CORNER_PERIODS), dtype=np.float64)
    return float(np.max(accelerations * CORNER_PERIODS) / np.max(accelerations))


@dataclass(frozen=True, eq=False)
class HeldMotion:
    """Samples (m/s2) and time step (s) of a motion, without its labels."""

    acceleration: FloatArray
    dt: float


@dataclass(frozen=True, eq=False)
class SuiteMean:
    """Motions, their names and factors, and the damping ratio."""

    motions: tuple[HeldMotion, ...]
    names: tuple[str, ...]
    factors: FloatArray
    damping: float
    given_label: str
    longest: float = np.inf

    @property
    def label(self) -> str:
        """Name with the number of motions."""
        return (
            self.given_label
            or f"mean spectrum of {counted(len(self.motions), 'motion')}, {100.0 * self.damping:g} % damping"
        )

    @property
    def parameters(self) -> dict[str, Any]:
        """Names, factors, damping, and a digest of the samples."""
        return {
            "shape": "suite_mean",
            "records": list(self.names),
            "factors": self.factors.tolist(),
            "damping": self.damping,
            "samples_sha256": inputs_digest(self.motions),
        }

    @property
    def shortest(self) -> float:
        """A thousandth of the largest time step, as far as spectra of it go (s)."""
        return _kernel.SHORTEST_PERIOD_OVER_STEP * max(motion.dt for motion in self.motions)

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return the mean Sa (m/s2)."""
        flat = mean_spectrum(self.motions, self.factors, np.atleast_1d(periods), self.damping)
        return flat.reshape(np.shape(periods))


def mean_shape(
    records: GroundMotion | Iterable[GroundMotion], factors: ArrayLike | None, damping: float, label: str
) -> SuiteMean:
    """Return the shape; there is a finite factor for each motion."""
    suite = as_motions(records, OWNER)
    scale = frozen(np.ones(len(suite))) if factors is None else as_array(factors, "factors", OWNER, InvalidOption)
    if len(scale) != len(suite):
        requirement = f"a list of {len(suite)} values, one per motion"
        raise refusal(InvalidOption, "factors", OWNER, requirement, str(len(scale)))
    if not (np.isfinite(scale) & (scale > 0.0)).all():
        wrong = scale[~(np.isfinite(scale) & (scale > 0.0))][0]
        raise refusal(InvalidOption, "factors", OWNER, "positive numbers", f"{wrong:g}")
    ratio = as_number(damping, "damping", OWNER, InvalidOption)
    if not 0.0 <= ratio < 1.0:
        raise refusal(InvalidOption, "damping", OWNER, "at least 0 and below 1", f"{ratio:g}")
    motions = []
    for number, motion in enumerate(suite, start=1):
        owner = f"motion {number} of {OWNER}"
        samples = as_array(motion.acceleration, "acceleration", owner, InvalidMotion)
        motions.append(HeldMotion(samples, as_number(motion.dt, "dt", owner, InvalidMotion)))
    names = tuple(getattr(motion, "name", "") or f"motion {number}" for number, motion in enumerate(suite, start=1))
    return SuiteMean(tuple(motions), names, scale, ratio, label)
