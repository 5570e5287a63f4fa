"""The iteration of spectral matching: wavelets whose sum brings every oscillator of a list to its target.

Al Atik and Abrahamson (2010), Earthquake Spectra 26:601-617, after Lilhanand and Tseng (1988), with these changes: all
periods at once and closely spaced; exact peaks in continuous time; extrema that would grow past the target, or outside
the range past a limit, are held there; and in each pass the sum of all wavelets is sought again, of the least size, so
that none is left behind.
"""

from __future__ import annotations

from contextvars import ContextVar
from dataclasses import dataclass
from threading import Event
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.elementary import power
from seismass.base.values import FloatArray
from seismass.matching.linear import coarse, exact_product, halves, product, solved
from seismass.matching.oscillators import Extrema, Oscillators
from seismass.matching.wavelets import Placed, half_width, place

SHARE: Final = 0.8
"""Extrema of at least this share of the largest of their oscillator are watched."""
MOST: Final = 5
"""Largest number of extrema of one oscillator that are watched."""
OVERSHOOT: Final = 1.005
"""Predicted ratio to the target above which a watched extremum is held at the target."""
SECONDARY: Final = (0.3, 1.2)
"""Ease with which a wavelet is used that belongs to another extremum than the largest of its oscillator: in the first
pass, and its factor from pass to pass, up to 1."""
HOLDS: Final = 5
"""Times that extrema are added to those held, in one pass."""
REGULARISATION: Final = (0.4, 0.65, 0.02)
"""Weight of the size of the wavelets against the misfit: in the first pass, its factor from pass to pass, the least."""
WEAKER: Final = (1.0, 0.2)
"""Shares of that weight that are tried in each pass."""
STEPS: Final = (0.1, 0.35, 0.7, 1.0)
"""Shares of the step that are tried in each pass."""
FORGET: Final = (0.5, 0.8)
"""Share of the sum of all earlier wavelets that a pass takes back and seeks again: in the first pass, and its factor
from pass to pass."""
EMPHASIS: Final = 50.0
"""A period off by 1/50 counts twice, by 2/50 five times in the sum of squares, so that no period stays behind."""
PATIENCE: Final = 15
"""Passes without a better misfit after which the iteration ends."""
GROUP: Final = 16
"""Wavelets whose effect is found together, over the samples that any of them covers."""
WAVELET_BITS: Final = 30
"""Bits of a wavelet in its effect; the influence of a sample has twice what 52 leaves."""


@dataclass(frozen=True)
class Adjusted:
    """What the iteration found.

    Attributes
    ----------
    acceleration : ndarray, shape (samples,)
        The adjusted motion (m/s2).
    iterations : int
        Passes made.
    best : int
        The pass after which the misfit was the smallest, which is the one returned; 0 for the motion as given.
    shortened : bool
        Whether an end of the record made a wavelet of that pass or an earlier one narrower, or moved it.
    """

    acceleration: FloatArray
    iterations: int
    best: int
    shortened: bool


class Ratios:
    """Ratios of pseudo-acceleration spectra to the target at fixed periods, by the kernel."""

    def __init__(self, periods: FloatArray, target: FloatArray, damping: float, dt: float, threads: int | None) -> None:
        self.periods, self.damping, self.dt, self.threads = periods, np.array([damping]), dt, threads
        self.over = (2.0 * np.pi / periods) ** 2 / target

    def __call__(self, motions: list[FloatArray]) -> FloatArray:
        """Return the ratios, shape (motions, periods)."""
        held = [_kernel.Motion(motion, self.dt) for motion in motions]
        peaks = _kernel.response_spectra(held, self.periods, self.damping, self.threads)
        return np.asarray(peaks)[:, 0, :] * self.over


class Stopped(Exception):
    """The suite that a motion belongs to is given up."""


STOP: Final[ContextVar[Event | None]] = ContextVar("STOP", default=None)
"""Set where the threads of a suite are to end before they are done, as on Ctrl-C."""


def _end_if_stopped() -> None:
    stop = STOP.get()
    if stop is not None and stop.is_set():
        raise Stopped


def adjust(
    given: FloatArray,
    dt: float,
    periods: FloatArray,
    target: FloatArray,
    guards: tuple[FloatArray, FloatArray],
    between: Ratios,
    final: Ratios,
    *,
    damping: float,
    tolerance: float,
    max_iterations: int,
) -> Adjusted:
    """Return the motion plus wavelets that bring its spectrum to the target.

    Parameters
    ----------
    given : ndarray, shape (samples,)
        Acceleration (m/s2).
    dt : float
        Time step (s).
    periods, target : ndarray, shape (periods,)
        Where it is matched (s), and the pseudo-acceleration there (m/s2).
    guards : tuple of ndarray, each of shape (guards,)
        Periods outside the range (s), and the pseudo-acceleration there (m/s2) past which it is held.
    between : Ratios
        Chooses the best of each pass, at the same periods and at others between them.
    final : Ratios
        Judges the misfit, at still others.
    damping : float
        Ratio of critical damping of the target.
    tolerance : float
        Largest misfit |ratio - 1| at which the iteration ends.
    max_iterations : int
        Largest number of passes.

    Raises
    ------
    Stopped
        `STOP` is set.
    """
    matched = len(periods)
    periods, target = np.concatenate([periods, guards[0]]), np.concatenate([target, guards[1]])
    oscillators = Oscillators(periods, damping, dt)
    displacement = target * (periods / (2.0 * np.pi)) ** 2
    delay = _delays(oscillators)
    acceleration, best = given, given
    least, _ = _score(between([given])[0])
    reached = _score(final([given])[0])[1] <= tolerance
    passes = chosen = 0
    shortened = False
    span = (len(given), 0)  # of all wavelets so far
    while passes < max_iterations and not reached and passes - chosen < PATIENCE:
        _end_if_stopped()
        extrema = oscillators.extrema(acceleration, SHARE, MOST)
        sought = extrema.largest & (extrema.oscillator < matched)
        # Those of the guards come last; they have no wavelets.
        own = extrema.oscillator[extrema.oscillator < matched]
        time = dt * (extrema.step + extrema.fraction)[: len(own)]
        wavelets = place(time - delay[own], periods[own], damping, dt, len(given))
        first, last = min(span[0], wavelets.first), max(span[1], wavelets.last)
        _end_if_stopped()
        influence = oscillators.influence(extrema, first, last)
        scale = np.sign(extrema.value) / displacement[extrema.oscillator]
        added = (acceleration - given)[first:last]
        forget = FORGET[0] * float(power(FORGET[1], passes))
        taken_back = forget * scale * np.einsum("es,s->e", influence, added)
        within = slice(wavelets.first - first, wavelets.last - first)
        effect = _effect(influence[:, within], extrema.step, wavelets) * scale[:, None]
        _end_if_stopped()
        weight = max(REGULARISATION[0] * float(power(REGULARISATION[1], passes)), REGULARISATION[2])
        ease = min(SECONDARY[0] * float(power(SECONDARY[1], passes)), 1.0)
        candidates = []
        for amplitudes in _amplitudes(effect, scale * extrema.value, taken_back, sought, weight, ease):
            change = -forget * added
            change[within] += np.einsum("w,ws->s", amplitudes, wavelets.samples)
            for step in STEPS:
                motion = acceleration.copy()
                motion[first:last] += step * change
                candidates.append(motion)
        _end_if_stopped()
        scores = [_score(ratios) for ratios in between(candidates)]
        number = min(range(len(scores)), key=lambda which: scores[which][0])
        acceleration = candidates[number]
        span = (first, last)
        passes += 1
        shortened = shortened or bool(wavelets.shortened.any())
        score, largest = scores[number]
        reached = largest <= tolerance and _score(final([acceleration])[0])[1] <= tolerance
        if score < least or reached:
            least, best, chosen = score, acceleration, passes
    return Adjusted(best, passes, chosen, shortened)


def _score(ratios: FloatArray) -> tuple[float, float]:
    """What is made small, and the largest misfit: the score is the root mean square and half the largest."""
    off = np.abs(ratios - 1.0)
    largest = float(off.max())
    return float(np.sqrt(np.mean(off * off))) + 0.5 * largest, largest


def _delays(oscillators: Oscillators) -> FloatArray:
    """Time (s) from the crest of a wavelet to the largest response of its own oscillator."""
    delays = []
    for period, width in zip(oscillators.periods, half_width(oscillators.periods), strict=True):
        dt = oscillators.dt
        crest = np.array([width + 2.0 * dt])
        samples = int(np.ceil(2.0 * (width + period) / dt)) + 8
        placed: Placed = place(crest, np.array([period]), oscillators.damping, dt, samples)
        motion = np.zeros(samples)
        motion[placed.first : placed.last] = placed.samples[0]
        found: Extrema = Oscillators(np.array([period]), oscillators.damping, dt).extrema(motion, 1.0, 1)
        delays.append(dt * float(found.step[0] + found.fraction[0]) - crest[0])
    return np.array(delays)


def _effect(influence: FloatArray, steps: NDArray[np.int64], wavelets: Placed) -> FloatArray:
    """Displacement at each extremum by each wavelet of unit amplitude (m), shape (extrema, wavelets), to nine digits.

    The influence is that of the samples from the first of the wavelets on; those later than `steps` + 1 have none.
    """
    latest, centred = np.argsort(-steps, kind="stable"), np.argsort(wavelets.starts + wavelets.ends, kind="stable")
    upper, lower = halves(influence[latest], 52 - WAVELET_BITS)
    samples = coarse(wavelets.samples, WAVELET_BITS)
    effect = np.zeros((len(influence), len(samples)))
    for start in range(0, len(samples), GROUP):
        some = centred[start : start + GROUP]
        first, last = int(wavelets.starts[some].min()), int(wavelets.ends[some].max())
        reached = int(np.count_nonzero(steps + 1 >= first))
        rows, span = slice(0, reached), slice(first - wavelets.first, last - wavelets.first)
        right = samples[some, span].T
        effect[np.ix_(latest[rows], some)] = exact_product(lower[rows, span], right) + exact_product(
            upper[rows, span], right
        )
    return effect


def _amplitudes(
    effect: FloatArray,
    ratio: FloatArray,
    taken_back: FloatArray,
    largest: NDArray[np.bool_],
    weight: float,
    ease: float,
) -> list[FloatArray]:
    """Amplitudes of the wavelets (m/s2), for each weight of `WEAKER`: regularised least squares.

    Held are the largest extremum of each matched oscillator, which is brought to the target, and every other that would
    grow past it. An amplitude counts by what it does to its own extremum.

    Parameters
    ----------
    effect : ndarray, shape (extrema, wavelets)
        Change of each extremum over the target by a wavelet of unit amplitude; wavelet i is that of extremum i. There
        may be fewer wavelets than extrema.
    ratio, taken_back : ndarray, shape (extrema,)
        Extrema over the target, and what is taken from them in this pass.
    largest : ndarray of bool, shape (extrema,)
        Whether an extremum is the largest of an oscillator that is matched.
    weight : float
        Of the amplitudes against the misfit.
    ease : float
        Above 0 and up to 1: with which wavelets of other extrema than the largest are used.
    """
    # An end of the record may leave a wavelet with hardly any effect on its own extremum.
    size = np.maximum(np.abs(np.diag(effect)), 0.1 * np.max(np.abs(effect), axis=0))
    own = largest[: len(size)]
    size = np.where(size > 0.0, size, 1.0)
    size = np.where(own, size, size / ease)
    effect = effect / size
    upper, lower = halves(effect)
    products, known = np.zeros((len(effect), len(effect))), np.zeros(len(effect), dtype=bool)
    miss = 1.0 - ratio + taken_back
    emphasis = np.minimum(1.0 + (EMPHASIS * (1.0 - ratio)) ** 2, 1e4)
    found = []
    for share in WEAKER:
        regular = (share * weight) ** 2 / emphasis
        _end_if_stopped()
        held = largest.copy()
        for _ in range(HOLDS):
            added = held & ~known
            if added.any():
                known |= added
                some = product((upper[added], lower[added]), (upper[known], lower[known]))
                products[np.ix_(added, known)] = some
                products[np.ix_(known, added)] = some.T
            forces = solved(products[np.ix_(held, held)] + np.diag(regular[held]), miss[held])
            amplitudes = np.einsum("h,hw->w", forces, effect[held])
            grown = ~held & (ratio - taken_back + np.einsum("ew,w->e", effect, amplitudes) > OVERSHOOT)
            if not grown.any():
                break
            held |= grown
        found.append(amplitudes / size)
    return found
