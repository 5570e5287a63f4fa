"""What blocks on a moving base do by estimates: the demand in g, and sliding distances of Newmark and ASCE 43."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, as_one_of
from seismass.base.views import Card
from seismass.motions.motion import Motion
from seismass.motions.spectra import response_spectrum

BOUND_LIMIT: Final = 6.0
"""Largest A/N of the bound of Newmark (1965); beyond it the bound is 6 V^2/(2 g N)."""
ASCE43_DAMPING: Final = 0.10
"""Damping ratio of the spectrum of ASCE/SEI 43-05, A.1."""
_PERIODS: Final = np.geomspace(0.02, 20.0, 401)
"""Periods (s) among which the frequency of ASCE/SEI 43-05 is sought: 1/20 to 50 Hz, steps of 1.7 %."""


@dataclass(frozen=True, slots=True)
class Base(Card):
    """The motion of what a block stands on.

    Attributes
    ----------
    motion : Motion
        Its absolute acceleration.
    acceleration, velocity, vertical : float
        Peaks of the absolute acceleration (m/s2), of the absolute velocity (m/s) and of the vertical acceleration
        (m/s2; zero without one).
    """

    motion: Motion
    acceleration: float
    velocity: float
    vertical: float


def _friction(base: Base, mu_k: float) -> float:
    """The friction coefficient of a bound, as a number."""
    as_one_of(base, Base, "base", "sliding distance", InvalidOption)
    return as_number(mu_k, "mu_k", "sliding distance", InvalidOption)


def newmark_pulse(base: Base, mu_k: float) -> float:
    """Return V^2/(2 mu g) (1 - mu g/A): the slip under a rectangular pulse with peaks A and V (m).

    Newmark (1965), Géotechnique 15:139-160; exact for one pulse of constant acceleration A that lasts V/A. No slip
    where A <= mu g.
    """
    limit = _friction(base, mu_k) * STANDARD_GRAVITY
    if not base.acceleration > limit:
        return 0.0
    return np.inf if limit == 0.0 else base.velocity**2 / (2.0 * limit) * (1.0 - limit / base.acceleration)


def newmark_bound(base: Base, mu_k: float) -> float:
    """Return V^2/(2 mu g) min(A/(mu g), 6): an upper bound for earthquakes (m).

    Newmark (1965), for a block that slides to one side only, and so of several pulses that add up; a block on a level
    floor slides back as well. From memory, not checked in a source.
    """
    limit = _friction(base, mu_k) * STANDARD_GRAVITY
    if not base.acceleration > limit:
        return 0.0
    if limit == 0.0:
        return np.inf
    return base.velocity**2 / (2.0 * limit) * min(base.acceleration / limit, BOUND_LIMIT)


def asce43(base: Base, mu_k: float) -> float:
    """Return the sliding distance of ASCE/SEI 43-05, Appendix A.1 (m).

    mu_e = mu (1 - 0.4 A_v/g), c_s = 2 mu_e g, and c_s/(2 pi f_es)^2, where f_es is the lowest frequency at which the
    spectral acceleration at 10 % damping equals c_s: the spectral displacement there. mu_e, c_s and f_es were read in a
    copy of the appendix; the last expression is from memory, as it was illegible there. The standard calls it a
    conservatively biased best estimate and combines two horizontal directions, of which the model has one. Zero where
    the spectrum is below c_s everywhere; infinite where c_s is zero, or exceeded at 0.05 Hz still.
    """
    effective = _friction(base, mu_k) * max(1.0 - 0.4 * base.vertical / STANDARD_GRAVITY, 0.0)
    coefficient = 2.0 * effective * STANDARD_GRAVITY
    spectrum = response_spectrum(base.motion, _PERIODS, ASCE43_DAMPING)[0]
    above = np.flatnonzero(spectrum >= coefficient)
    if not len(above):
        return 0.0
    last = int(above[-1])
    if last == len(_PERIODS) - 1 or coefficient == 0.0:
        return np.inf
    falling = np.log(spectrum[last : last + 2])
    weight = (falling[0] - np.log(coefficient)) / (falling[0] - falling[1])
    log_period = (1.0 - weight) * np.log(_PERIODS[last]) + weight * np.log(_PERIODS[last + 1])
    return float(coefficient * (np.exp(log_period) / (2.0 * np.pi)) ** 2)


ESTIMATES: Final[dict[str, Callable[[Base, float], float]]] = {
    "newmark_pulse": newmark_pulse,
    "newmark_bound": newmark_bound,
    "asce43": asce43,
}
"""Estimates by name; each takes the motion of the base and the kinetic friction coefficient."""

TITLES: Final[dict[str, str]] = {
    "newmark_pulse": "Newmark (1965), one pulse",
    "newmark_bound": "Newmark (1965), bound for one side",
    "asce43": "ASCE/SEI 43-05, A.1",
    "rigid_block": "rigid block, exact",
}
"""What texts and figures call estimates; the last is the kernel's block on that base."""


def estimates(base: Base, mu_k: float) -> dict[str, float]:
    """Return all estimates by name (m)."""
    return {name: float(function(base, mu_k)) for name, function in ESTIMATES.items()}


def log_ratio(estimate: FloatArray, exact: FloatArray) -> FloatArray:
    """Return ln(estimate/exact) of the pairs in which both are positive and finite."""
    both = (estimate > 0.0) & (exact > 0.0) & np.isfinite(estimate) & np.isfinite(exact)
    return np.asarray(np.log(estimate[both] / exact[both]), dtype=np.float64)
