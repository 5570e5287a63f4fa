"""Elastic response spectra: exact for acceleration that is linear between samples, at the periods asked for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final, Literal, Protocol, TypeAlias, cast, get_args

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.arguments import as_threads, as_word
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, as_array, as_number, as_positive, brief, refusal


class GroundMotion(Protocol):
    """What a spectrum needs of a motion: a `Record` and a `Motion` both have it."""

    @property
    def acceleration(self) -> FloatArray:
        """Horizontal samples (m/s2)."""
        ...

    @property
    def dt(self) -> float:
        """Time step (s)."""
        ...


def as_motions(motions: Any, owner: str) -> list[GroundMotion]:
    """Return motions as a list; one motion is a list of one."""
    try:
        listed = [motions] if hasattr(motions, "acceleration") else list(motions)
    except TypeError:
        raise refusal(InvalidMotion, "motions", owner, "Records or Motions", brief(motions)) from None
    if not listed:
        raise refusal(InvalidMotion, "motions", owner, "at least one Record or Motion", "none")
    for number, motion in enumerate(listed, start=1):
        if not (hasattr(motion, "acceleration") and hasattr(motion, "dt")):
            raise refusal(InvalidMotion, f"motion {number}", owner, "a Record or Motion", brief(motion))
    return listed


def held(motion: GroundMotion, number: int) -> _kernel.Motion:
    """Return a motion as the kernel takes it, from samples of any kind; `number` names it in errors."""
    owner = f"motion {number} of spectrum"
    samples = as_array(motion.acceleration, "acceleration", owner, InvalidMotion)
    return _kernel.Motion(samples, as_number(motion.dt, "dt", owner, InvalidMotion))


def check_not_zero(spectra: FloatArray) -> None:
    """Refuse motions without any acceleration, by their spectra: motions x periods."""
    for number, row in enumerate(spectra, start=1):
        if not (row > 0.0).all():
            raise refusal(
                InvalidMotion, "acceleration", f"motion {number}", "other than zero somewhere", "zero throughout"
            )


Kind: TypeAlias = Literal["pseudo_acceleration", "displacement", "pseudo_velocity", "acceleration"]
"""Ordinate of a spectrum: w^2 D (m/s2), D (m) or w D (m/s) of the peak relative displacement D, or the peak of the
absolute acceleration (m/s2)."""

_POWER_OF_FREQUENCY: Final = {"displacement": 0, "pseudo_velocity": 1, "pseudo_acceleration": 2}


def response_spectrum(
    motions: GroundMotion | Iterable[GroundMotion],
    periods: ArrayLike,
    damping: float | Sequence[float] = 0.05,
    kind: Kind = "pseudo_acceleration",
    *,
    threads: int | None = None,
) -> FloatArray:
    """Return elastic response spectra, exact for acceleration that is linear between samples.

    Peaks are taken in continuous time, from rest at the first sample to the end of the free vibration that follows the
    motion, which goes to zero over one step after its last sample.

    Parameters
    ----------
    motions : Record, Motion or iterable of them
        One motion counts as a suite of one.
    periods : array_like, shape (periods,)
        Natural periods (s), from a thousandth of the time step; each is solved for, none is interpolated.
    damping : float or sequence of float, default 0.05
        Ratios of critical damping, at least 0 and below 1.
    kind : {"pseudo_acceleration", "displacement", "pseudo_velocity", "acceleration"}, default "pseudo_acceleration"
        Ordinate, in m/s2, m, m/s or m/s2. The last is the largest absolute acceleration of the mass, spring and damper
        together; without damping it is the pseudo-acceleration.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.

    Returns
    -------
    ndarray, shape (motions, periods), or (motions, damping, periods) for a sequence of ratios
        Spectral ordinates.

    Raises
    ------
    InvalidOption
        A period, ratio, kind or number of threads out of its range.
    InvalidMotion
        No motion, or something else.

    Notes
    -----
    Nigam and Jennings (1969), Bull. Seism. Soc. Am. 59:909-922.

    Examples
    --------
    A step of 1 m/s2 on an undamped oscillator: twice the static displacement.

    >>> import seismass as sm
    >>> step = sm.Motion([1.0] * 200, dt=0.01)
    >>> sm.response_spectrum(step, [0.5, 1.0], damping=0.0)
    array([[2., 2.]])
    """
    as_word(kind, get_args(Kind), "kind", "spectrum")
    values = as_array(periods, "periods", "spectrum", InvalidOption)
    if len(values) == 0:
        raise refusal(InvalidOption, "periods", "spectrum", "a list of at least one period", "none")
    ratios = as_array(damping, "damping", "spectrum", InvalidOption, or_number=True)
    if ratios.size == 0:
        raise refusal(InvalidOption, "damping", "spectrum", "a number or a list of at least one ratio", "none")
    workers = as_threads(threads, "spectrum")
    listed = [held(motion, number) for number, motion in enumerate(as_motions(motions, "spectrum"), start=1)]
    if kind == "acceleration":
        ordinates = np.asarray(_kernel.oscillator_peaks(listed, values, np.atleast_1d(ratios), workers)[2])
    else:
        peaks = np.asarray(_kernel.response_spectra(listed, values, np.atleast_1d(ratios), workers))
        ordinates = peaks * (2.0 * np.pi / values) ** _POWER_OF_FREQUENCY[kind]
    return ordinates[:, 0, :] if ratios.ndim == 0 else ordinates


def mean_spectrum(
    motions: Iterable[GroundMotion],
    factors: ArrayLike,
    periods: ArrayLike,
    damping: float = 0.05,
    *,
    threads: int | None = None,
) -> FloatArray:
    """Return the mean pseudo-acceleration spectrum of motions times their factors.

    Parameters
    ----------
    motions : iterable of Record or Motion
        The suite.
    factors : array_like, shape (motions,)
        Factor of each motion.
    periods : array_like, shape (periods,)
        Natural periods (s).
    damping : float, default 0.05
        Ratio of critical damping.
    threads : int, optional
        As in `response_spectrum`.

    Returns
    -------
    ndarray, shape (periods,)
        Mean pseudo-acceleration (m/s2).

    Raises
    ------
    InvalidOption, InvalidMotion
        As for `response_spectrum`, or another number of factors than of motions.
    """
    ratio = as_number(damping, "damping", "mean spectrum", InvalidOption)
    spectra = response_spectrum(motions, periods, ratio, threads=threads)
    scale = as_array(factors, "factors", "mean spectrum", InvalidOption)
    if len(scale) != len(spectra):
        raise refusal(
            InvalidOption,
            "factors",
            "mean spectrum",
            f"a list of {len(spectra)} values, one per motion",
            f"{len(scale)}",
        )
    return cast(FloatArray, np.mean(scale[:, None] * spectra, axis=0))


OWNER = "target spectrum"


def positive(value: Any, name: str) -> float:
    """Return a positive number."""
    return as_positive(value, name, OWNER, InvalidOption)


def one_of(value: Any, name: str, choices: tuple[Any, ...]) -> Any:
    """Return a value that is among the choices."""
    if isinstance(value, bool) or not isinstance(value, str | int) or value not in choices:
        raise refusal(InvalidOption, name, OWNER, "one of " + ", ".join(map(str, choices)), brief(value))
    return value
