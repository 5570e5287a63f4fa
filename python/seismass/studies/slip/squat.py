"""Whether a block slides or rocks: its size, the static rule, uplift by the floor's acceleration, and a limit of
velocity below which overturning is not expected. The model of the kernel slides and does not rock.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, as_positive, brief, refusal
from seismass.base.views import Card
from seismass.motions.motion import Motion
from seismass.motions.spectra import response_spectrum

OWNER: Final = "block size"


@dataclass(frozen=True)
class BlockSize:
    """Size of a block in the vertical plane of the motion.

    Attributes
    ----------
    width : float
        Full width b of the base in the direction of the motion (m).
    height : float
        Full height h (m).
    centre : float or None
        Height of the centre of gravity above the floor (m); by default h/2, as in a uniform block.

    Raises
    ------
    InvalidOption
        A length is not positive, or the centre is above the top.

    Notes
    -----
    Floor acceleration a and vertical acceleration a_v (up positive) act on a block of mass m that moves with its
    floor: the force m a at the height h_c of its centre and its weight m (g + a_v), which is centred over the base.

    - It slides where m abs(a) > mu_s m (g + a_v), so where abs(a) > mu_s (g + a_v).
    - It lifts off one edge where m abs(a) h_c > m (g + a_v) b/2, so where abs(a) > (g + a_v) b/(2 h_c).

    Both limits have the factor g + a_v, so that vertical motion does not change which of them is reached first: the
    block rocks before it slides if mu_s > b/(2 h_c), which is mu_s > b/h for a uniform block (Shenton 1996, J. Eng.
    Mech. 122:690-693, for the limits of sliding and rocking from rest). A block with mu_s below that limit never
    rocks, however strong the motion: while it slides its acceleration is mu_k (g + a_v), and mu_k <= mu_s.

    Uplift is not overturning. Whether a rocking block falls depends on the motion and on its size; the kernel does
    not compute it.

    Examples
    --------
    >>> from seismass.studies.slip import BlockSize
    >>> pallet = BlockSize(1.0, 1.2)
    >>> round(pallet.uplift_g, 3), pallet.rocks_first(0.5), pallet.rocks_first(0.9)
    (0.833, False, True)
    """

    width: float
    height: float
    centre: float | None = None

    def __post_init__(self) -> None:
        width = as_positive(self.width, "width", OWNER, InvalidOption)
        height = as_positive(self.height, "height", OWNER, InvalidOption)
        object.__setattr__(self, "width", width)
        object.__setattr__(self, "height", height)
        if self.centre is not None:
            centre = as_positive(self.centre, "centre", OWNER, InvalidOption)
            if centre > height:
                raise refusal(InvalidOption, "centre", OWNER, f"at most the height, {height:g} m", f"{centre:g}")
            object.__setattr__(self, "centre", centre)

    @property
    def centre_height(self) -> float:
        """Height of the centre of gravity (m)."""
        return 0.5 * self.height if self.centre is None else self.centre

    @property
    def uplift_g(self) -> float:
        """Floor acceleration that lifts one edge without vertical motion, over g: b/(2 h_c), b/h if uniform."""
        return 0.5 * self.width / self.centre_height

    def uplift_acceleration(self, vertical: float = 0.0) -> float:
        """Return the floor acceleration (m/s2) that lifts one edge, under a vertical acceleration (m/s2, up positive).

        Zero where g + a_v is negative: the block has no contact.
        """
        return max(STANDARD_GRAVITY + float(vertical), 0.0) * self.uplift_g

    def rocks_first(self, mu_s: float) -> bool:
        """Whether the block rocks before it slides: mu_s > b/(2 h_c)."""
        return as_number(mu_s, "mu_s", "block size", InvalidOption) > self.uplift_g

    @property
    def overturning_velocity(self) -> float | None:
        """Peak floor velocity (m/s) below which a uniform block is not expected to overturn; None for others.

        Ishiyama (1982), Earthquake Eng. Struct. Dyn. 10:635-650, gives as lower limits of overturning a peak
        acceleration of g B/H together with a peak velocity of 10 B/sqrt(H) (cm and s), which is B/sqrt(H) in m and s.
        The form is from memory and was not checked in a source. It is 2 % below 0.4 times the velocity by which an
        impulse overturns a slender uniform block, sqrt(8 g R (1 - cos a)/(3 cos^2 a)) with tan a = B/H and
        2 R = sqrt(B^2 + H^2). Both limits must be exceeded, on a rigid floor; it is not a sufficient condition.
        """
        return None if self.centre is not None else float(self.width / np.sqrt(self.height))


def parse_size(text: str) -> BlockSize:
    """Return a size from its text: ``1.0x1.2``, width by height (m), or ``1.0x1.2@0.4`` with the height of its centre.

    Raises
    ------
    InvalidOption
        It cannot be read.

    Examples
    --------
    >>> from seismass.studies.slip import parse_size
    >>> parse_size("1.0x1.2@0.4")
    BlockSize(width=1.0, height=1.2, centre=0.4)
    """
    parts = re.fullmatch(r"([^x@]+)x([^x@]+)(?:@([^x@]+))?", text.strip().lower())
    try:
        if parts is None:
            raise ValueError
        width, height, centre = (None if part is None else float(part) for part in parts.groups())
    except ValueError:
        raise refusal(InvalidOption, "size", "block", "WIDTHxHEIGHT or WIDTHxHEIGHT@CENTRE (m)", brief(text)) from None
    assert width is not None
    assert height is not None
    return BlockSize(width, height, centre)


def as_sizes(sizes: Any, blocks: int) -> tuple[BlockSize | None, ...]:
    """Return one size per block: one for all, or a list with None where a size is not known."""
    if sizes is None or isinstance(sizes, BlockSize):
        return (sizes,) * blocks
    requirement = f"a BlockSize, or a list of {blocks}, one per block or None"
    listed = list(sizes) if isinstance(sizes, Iterable) and not isinstance(sizes, str) else [sizes]
    if len(listed) != blocks or not all(size is None or isinstance(size, BlockSize) for size in listed):
        raise refusal(InvalidOption, "sizes", "slip demand", requirement, brief(sizes))
    return tuple(listed)


def demand_in_g(acceleration: FloatArray, vertical: FloatArray | None) -> float:
    """Return the largest abs(a)/(g + a_v) of a history (m/s2, up positive, NaN after a collapse), by which friction and
    uplift are limited. Samples at which g + a_v is not positive have no contact and are left out.
    """
    weight = STANDARD_GRAVITY + (np.zeros(1) if vertical is None else vertical)
    ratio = np.where(weight > 0.0, np.abs(acceleration) / np.where(weight > 0.0, weight, 1.0), 0.0)
    return float(np.nanmax(ratio, initial=0.0))


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


def newmark_pulse(base: Base, mu_k: float) -> float:
    """Return V^2/(2 mu g) (1 - mu g/A): the slip under a rectangular pulse with peaks A and V (m).

    Newmark (1965), Géotechnique 15:139-160; exact for one pulse of constant acceleration A that lasts V/A. No slip
    where A <= mu g.
    """
    limit = mu_k * STANDARD_GRAVITY
    if not base.acceleration > limit:
        return 0.0
    return np.inf if limit == 0.0 else base.velocity**2 / (2.0 * limit) * (1.0 - limit / base.acceleration)


def newmark_bound(base: Base, mu_k: float) -> float:
    """Return V^2/(2 mu g) min(A/(mu g), 6): an upper bound for earthquakes (m).

    Newmark (1965), for a block that slides to one side only, and so of several pulses that add up; a block on a level
    floor slides back as well. From memory, not checked in a source.
    """
    limit = mu_k * STANDARD_GRAVITY
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
    effective = mu_k * max(1.0 - 0.4 * base.vertical / STANDARD_GRAVITY, 0.0)
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
