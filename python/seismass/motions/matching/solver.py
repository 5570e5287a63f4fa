"""The iteration of spectral matching: wavelets whose sum brings every oscillator of a list to its target.

Al Atik and Abrahamson (2010), Earthquake Spectra 26:601-617, after Lilhanand and Tseng (1988), with these changes: all
periods at once and closely spaced, more closely where the misfit is the largest; wide wavelets beside the usual ones,
which tell neighbouring periods apart; exact peaks in continuous time; extrema that would grow past the target, or
outside the range past a limit, are held there; and in each pass the sum of all wavelets is sought again, of the least
size, so that none is left behind.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.values import FloatArray
from seismass.motions.elementary import power
from seismass.motions.matching.linear import (
    Extrema,
    Oscillators,
    Placed,
    coarse,
    end_if_cancelled,
    exact_product,
    half_width,
    halves,
    place,
    product,
    solved,
)

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
REGULARISATION: Final = (0.1, 0.01, 0.5)
"""Weight of the size of the wavelets against the misfit: in the first pass, the least, the largest."""
WEIGHTS: Final = (4.0, 1.0, 0.25)
"""Factors of that weight that are tried in each pass; that of the best is kept (Levenberg 1944, Marquardt 1963)."""
STEPS: Final = (0.3, 1.0)
"""Shares of the step that are tried in each pass."""
SHORTER: Final = 2.0
"""Factor of the weight after a pass whose short step was the best."""
FORGET: Final = (0.5, 0.8)
"""Share of the sum of all earlier wavelets that a pass takes back and seeks again: in the first pass, and its factor
from pass to pass."""
EMPHASIS: Final = 50.0
"""A period off by 1/50 counts twice, by 2/50 five times in the sum of squares, so that no period stays behind."""
LARGEST_EMPHASIS: Final = 10.0
"""A period counts no more than so many times."""
PERSISTENT: Final = 1.5
"""It counts by this factor more in each pass in which it is still off, and less in others."""
MOST_PERSISTENT: Final = 10.0
"""Up to this factor."""
STILL_OFF: Final = 0.7
"""Share of the tolerance beyond which a period is still off."""
PATIENCE: Final = 15
"""Passes without a better misfit after which the iteration ends."""
GROUP: Final = 16
"""Wavelets whose effect is found together, over the samples that any of them covers."""
WAVELET_BITS: Final = 30
"""Bits of a wavelet in its effect; the influence of a sample has twice what 52 leaves."""


@dataclass(frozen=True)
class Adjusted:
    """Result of the iteration: the motion (m/s2) of the `best` pass (0: as given), where the misfit is smallest, and
    whether an end of the record made a wavelet up to that pass narrower or moved it.
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


def adjust(
    original: FloatArray,
    dt: float,
    periods: FloatArray,
    target: FloatArray,
    guards: tuple[FloatArray, FloatArray],
    fitted_ratios: Ratios,
    final: Ratios,
    *,
    damping: float,
    tolerance: float,
    max_iterations: int,
) -> Adjusted:
    """Return the motion plus wavelets that bring its spectrum to the target (periods in s, pseudo-acceleration in
    m/s2). `guards` hold it outside the range; `between` chooses the best pass, `final` judges the misfit.
    """
    grid = _Grid(np.concatenate([periods, guards[0]]), np.concatenate([target, guards[1]]), len(periods), damping, dt)
    acceleration, best = original, original
    least, _ = _score(fitted_ratios([original])[0])
    reached = _score(final([original])[0])[1] <= tolerance
    passes = best_pass = 0
    shortened = False
    span = (len(original), 0)  # of all wavelets so far
    weight = REGULARISATION[0]
    while passes < max_iterations and not reached and passes - best_pass < PATIENCE:
        end_if_cancelled()
        extrema = grid.oscillators.extrema(acceleration, SHARE, MOST)
        sought = extrema.largest & (extrema.oscillator < grid.matched)
        # Those of the guards have no wavelets; the largest of the others have a wide one, too.
        usual = np.flatnonzero(extrema.oscillator < grid.matched)
        selected = np.concatenate([usual, np.flatnonzero(sought)])
        oscillator, time = extrema.oscillator[selected], dt * (extrema.step + extrema.fraction)[selected]
        wide = np.arange(len(selected)) >= len(usual)
        wavelets = place(time - grid.delay[oscillator], grid.periods[oscillator], damping, dt, len(original), wide)
        first, last = min(span[0], wavelets.first), max(span[1], wavelets.last)
        end_if_cancelled()
        influence = grid.oscillators.influence(extrema, first, last)
        scale = np.sign(extrema.value) / grid.displacement[extrema.oscillator]
        ratio = scale * extrema.value
        added = (acceleration - original)[first:last]
        forget = FORGET[0] * float(power(FORGET[1], passes))
        taken_back = forget * scale * np.einsum("es,s->e", influence, added)
        window = slice(wavelets.first - first, wavelets.last - first)
        effect = _effect(influence[:, window], extrema.step, wavelets) * scale[:, None]
        end_if_cancelled()
        ease = min(SECONDARY[0] * float(power(SECONDARY[1], passes)), 1.0)
        emphasis = np.ones(len(ratio))
        emphasis[sought] = grid.emphasis(ratio[sought], extrema.oscillator[sought], tolerance)
        candidates = []
        for amplitudes in _amplitudes(effect, selected, ratio, taken_back, sought, weight, ease, emphasis):
            change = -forget * added
            change[window] += np.einsum("w,ws->s", amplitudes, wavelets.samples)
            for step in STEPS:
                motion = acceleration.copy()
                motion[first:last] += step * change
                candidates.append(motion)
        end_if_cancelled()
        scores = [_score(ratios) for ratios in fitted_ratios(candidates)]
        number = min(range(len(scores)), key=lambda which: scores[which][0])
        acceleration = candidates[number]
        span = (first, last)
        passes += 1
        shortened = shortened or bool(wavelets.shortened.any())
        weight *= WEIGHTS[number // len(STEPS)] * (SHORTER if number % len(STEPS) == 0 else 1.0)
        weight = min(max(weight, REGULARISATION[1]), REGULARISATION[2])
        judged = np.abs(final([acceleration])[0] - 1.0)
        worst = int(np.argmax(judged))
        reached = bool(judged[worst] <= tolerance)
        if not reached:
            grid.insert(float(final.periods[worst]), 1.0 / float(final.over[worst]))
        if scores[number][0] < least or reached:
            least, best, best_pass = scores[number][0], acceleration, passes
    return Adjusted(best, passes, best_pass, shortened)


class _Grid:
    """Periods that are matched, and those outside that are held; a period between, once it is the worst, joins them."""

    def __init__(self, periods: FloatArray, target: FloatArray, matched: int, damping: float, dt: float) -> None:
        self.periods, self.matched, self.damping, self.dt = periods, matched, damping, dt
        self.displacement = target * (periods / (2.0 * np.pi)) ** 2
        self.oscillators = Oscillators(periods, damping, dt)
        self.delay = _delays(self.oscillators)
        self.persistence = np.ones(matched)

    def emphasis(self, ratio: FloatArray, oscillator: NDArray[np.integer], tolerance: float) -> FloatArray:
        """Return how much each extremum counts in the sum of squares, up to 1, and note which periods are still off. An
        oscillator has several where equal responses are its largest.
        """
        off = np.zeros(self.matched)
        np.maximum.at(off, oscillator, np.abs(1.0 - ratio))
        factor = np.where(off > STILL_OFF * tolerance, PERSISTENT, 1.0 / PERSISTENT)
        self.persistence = np.clip(self.persistence * factor, 1.0, MOST_PERSISTENT)
        weight = np.minimum(1.0 + (EMPHASIS * off) ** 2, LARGEST_EMPHASIS) * self.persistence
        return np.asarray((weight / weight.max())[oscillator])

    def insert(self, period: float, displacement: float) -> None:
        """Match a period (s) more, to a displacement (m)."""
        if np.any(self.periods[: self.matched] == period):
            return
        index = int(np.searchsorted(self.periods[: self.matched], period))
        self.periods = np.insert(self.periods, index, period)
        self.displacement = np.insert(self.displacement, index, displacement)
        one = Oscillators(np.array([period]), self.damping, self.dt)
        self.delay = np.insert(self.delay, index, _delays(one))
        self.persistence = np.insert(self.persistence, index, MOST_PERSISTENT)
        self.matched += 1
        self.oscillators = Oscillators(self.periods, self.damping, self.dt)


def _score(ratios: FloatArray) -> tuple[float, float]:
    """What is made small, and the largest misfit: the score is the root mean square and half the largest."""
    off = np.abs(ratios - 1.0)
    largest = float(off.max())
    return float(np.sqrt(np.mean(off * off))) + 0.5 * largest, largest


def _delays(oscillators: Oscillators) -> FloatArray:
    """Time (s) from the crest of a wavelet to the largest response of its own oscillator."""
    delays = []
    for period, width in zip(oscillators.periods, half_width(oscillators.periods), strict=True):
        end_if_cancelled()
        dt = oscillators.dt
        crest = np.array([width + 2.0 * dt])
        samples = int(np.ceil(2.0 * (width + period) / dt)) + 8
        placed: Placed = place(crest, np.array([period]), oscillators.damping, dt, samples, np.array([False]))
        motion = np.zeros(samples)
        motion[placed.first : placed.last] = placed.samples[0]
        extrema: Extrema = Oscillators(np.array([period]), oscillators.damping, dt).extrema(motion, 1.0, 1)
        delays.append(dt * float(extrema.step[0] + extrema.fraction[0]) - crest[0])
    return np.array(delays)


def _effect(influence: FloatArray, steps: NDArray[np.int64], wavelets: Placed) -> FloatArray:
    """Displacement at each extremum by each wavelet of unit amplitude (m), shape (extrema, wavelets), to nine digits.
    `influence` begins at the first sample of the wavelets; samples later than `steps` + 1 have none.
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
    index: NDArray[np.int64],
    ratio: FloatArray,
    taken_back: FloatArray,
    largest: NDArray[np.bool_],
    weight: float,
    ease: float,
    emphasis: FloatArray,
) -> list[FloatArray]:
    """Amplitudes of the wavelets (m/s2) for each factor of `WEIGHTS`, by regularised least squares over the largest
    extremum of each matched oscillator, brought to the target, and others that would grow past it.
    """
    # An end of the record may leave a wavelet with hardly any effect on its own extremum.
    size = np.maximum(np.abs(effect[index, np.arange(len(index))]), 0.1 * np.max(np.abs(effect), axis=0))
    is_largest = largest[index]
    size = np.where(size > 0.0, size, 1.0)
    size = np.where(is_largest, size, size / ease)
    effect = effect / size
    upper, lower = halves(effect)
    products, known = np.zeros((len(effect), len(effect))), np.zeros(len(effect), dtype=bool)
    miss = 1.0 - ratio + taken_back
    steps = []
    for share in WEIGHTS:
        regular = (share * weight) ** 2 / emphasis
        end_if_cancelled()
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
        steps.append(amplitudes / size)
    return steps
