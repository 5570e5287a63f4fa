"""Maximum likelihood of lognormal curves for many samples at once: by counts at levels, and by capacities.

Both likelihoods are concave in their parameters, so that damped Newton steps find the maximum. Where there is none, as
data of one kind are parted from the other by an intensity, the answer is the limit of the likelihood, and says so.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from seismass.base.values import FloatArray

FITTED: Final = 0
STEP: Final = 1
NEVER: Final = 2
ALWAYS: Final = 3
FALLING: Final = 4
NONE: Final = 5
"""How a fit ended: with a maximum; a step at one intensity; never or always exceeded; falling with the intensity; too
few data."""

Loss: TypeAlias = Callable[[FloatArray], FloatArray]
"""Loss of each row of two parameters."""
Derivatives: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Gradient, shape (rows, 2), and curvature, shape (rows, 2, 2), of a loss."""

_ITERATIONS: Final = 100
_HALVINGS: Final = 40
_SAME: Final = 1e-12
"""Logarithms of intensities that differ by less are the same."""
_FLAT: Final = 1e-9
"""Slope (per standard deviation of the logarithms, or of logarithms on one another) below which a curve does not rise:
rounding of sums decides the sign of a slope that is zero."""
_ROUNDING: Final = 1e-13
"""By how much a loss may grow relative to itself in a step that helps."""
_CONVERGED: Final = 1e-20
"""Square of the Newton decrement below which a likelihood is at its maximum; rounding of a sum is far larger."""


class Fits(NamedTuple):
    """Median, dispersion and kind of each sample, shape (samples,)."""

    median: FloatArray
    dispersion: FloatArray
    kind: NDArray[np.int8]


def probit_fits(intensity: FloatArray, exceeding: FloatArray, total: FloatArray) -> Fits:
    """Return the most likely lognormal curve for each sample of counts, shape (samples, levels): Baker (2015), Earthq.
    Spectra 31:579-599, eq. 11. With b = 1/beta and a = -ln(theta)/beta the likelihood is concave.
    """
    log = np.log(intensity)
    safe = total - exceeding
    kind = np.full(len(total), FITTED, dtype=np.int8)
    median, dispersion = np.full(len(total), np.nan), np.full(len(total), np.nan)
    hit, missed = exceeding > 0.0, safe > 0.0
    never, always = ~hit.any(axis=1), ~missed.any(axis=1)
    kind[never], kind[always], kind[never & always] = NEVER, ALWAYS, NONE
    median[never], median[always], median[never & always] = np.inf, 0.0, np.nan
    lowest_hit = np.where(hit, log, np.inf).min(axis=1)
    highest_missed = np.where(missed, log, -np.inf).max(axis=1)
    both = ~never & ~always
    runs = total > 0.0
    lowest, highest = np.where(runs, log, np.inf).min(axis=1), np.where(runs, log, -np.inf).max(axis=1)
    alone = both & (highest - lowest < _SAME)
    kind[alone] = NONE
    step = both & ~alone & (lowest_hit >= highest_missed)
    kind[step] = STEP
    median[step] = np.exp(0.5 * (lowest_hit[step] + highest_missed[step]))
    dispersion[step] = 0.0
    rest = both & ~alone & ~step
    with np.errstate(invalid="ignore", divide="ignore"):
        # The likelihood rises with the slope at slope zero where the mean of ln(x) over the exceeding runs is larger.
        means = exceeding @ log / exceeding.sum(axis=1) - safe @ log / safe.sum(axis=1)
        rises = means > _FLAT * (highest - lowest)
    kind[rest & ~rises] = FALLING
    fitted = np.flatnonzero(rest & rises)
    if len(fitted):
        centre, spread = float(log.mean()), float(log.std())
        a, b = _probit((log - centre) / spread, exceeding[fitted], safe[fitted])
        with np.errstate(over="ignore"):
            median[fitted] = np.exp(centre - spread * a / b)
        dispersion[fitted] = spread / b
    return Fits(median, dispersion, kind)


def capacity_fits(capacity: FloatArray, exceeded: NDArray[np.bool_], weight: FloatArray) -> Fits:
    """Return the most likely lognormal distribution for each sample of capacities, those not exceeded being censored:
    Baker (2015), eq. 7. Concave in 1/beta and ln(theta)/beta (Olsen 1978, Econometrica 46:1211-1215).
    """
    log = np.log(capacity)
    samples = len(weight)
    seen = weight * exceeded
    kind = np.full(samples, FITTED, dtype=np.int8)
    median, dispersion = np.full(samples, np.nan), np.full(samples, np.nan)
    empty, never = weight.sum(axis=1) == 0.0, seen.sum(axis=1) == 0.0
    kind[never], kind[empty] = NEVER, NONE
    median[never], median[empty] = np.inf, np.nan
    drawn = weight > 0.0
    least = np.where(drawn & exceeded, log, np.inf).min(axis=1)
    most = np.where(drawn, log, -np.inf).max(axis=1)
    # All capacities are equal, and no motion is known to have a larger one.
    step = ~never & (most <= least + _SAME)
    kind[step], median[step], dispersion[step] = STEP, np.exp(least[step]), 0.0
    full = ~never & ~step & ~(drawn & ~exceeded).any(axis=1)
    mean = weight[full] @ log / weight[full].sum(axis=1)
    variance = (weight[full] * (log - mean[:, None]) ** 2).sum(axis=1) / weight[full].sum(axis=1)
    median[full], dispersion[full] = np.exp(mean), np.sqrt(variance)
    censored = np.flatnonzero(~never & ~step & ~full)
    if len(censored):
        centre = float(log.mean())
        inverse, shift = _tobit(log - centre, seen[censored], (weight * ~exceeded)[censored])
        median[censored] = np.exp(centre + shift / inverse)
        dispersion[censored] = 1.0 / inverse
    return Fits(median, dispersion, kind)


def logistic_fits(x: FloatArray, occurred: NDArray[np.bool_], weight: FloatArray) -> Fits:
    """Return the most likely logistic curve expit((x - centre)/width) for each sample; `weight` has shape (samples,
    runs). The centre (`median`) is infinite where it never occurred, minus infinite where always.
    """
    drawn = weight > 0.0
    hit, missed = drawn & occurred, drawn & ~occurred
    kind = np.full(len(weight), FITTED, dtype=np.int8)
    centre, width = np.full(len(weight), np.nan), np.zeros(len(weight))
    never, always = ~hit.any(axis=1), ~missed.any(axis=1)
    kind[never], kind[always], kind[never & always] = NEVER, ALWAYS, NONE
    centre[never], centre[always], centre[never & always] = np.inf, -np.inf, np.nan
    both = ~never & ~always
    lowest_hit, highest_hit = np.where(hit, x, np.inf).min(axis=1), np.where(hit, x, -np.inf).max(axis=1)
    lowest_missed, highest_missed = np.where(missed, x, np.inf).min(axis=1), np.where(missed, x, -np.inf).max(axis=1)
    alone = both & (np.maximum(highest_hit, highest_missed) - np.minimum(lowest_hit, lowest_missed) < _SAME)
    kind[alone] = NONE
    both &= ~alone
    step = both & (lowest_hit >= highest_missed)
    kind[step], centre[step] = STEP, 0.5 * (lowest_hit + highest_missed)[step]
    falling = both & ~step & (highest_hit <= lowest_missed)
    rest = np.flatnonzero(both & ~step & ~falling)
    if len(rest):
        middle, spread = float(x.mean()), float(x.std())
        a, b = _logistic((x - middle) / spread, occurred, weight[rest])
        rises = b > _FLAT
        centre[rest[rises]] = middle - spread * a[rises] / b[rises]
        width[rest[rises]] = spread / b[rises]
        falling[rest[~rises]] = True
    kind[falling] = FALLING
    return Fits(centre, width, kind)


def cloud_fits(
    intensities: FloatArray, demand: FloatArray, collapsed: NDArray[np.bool_], limit: float, weight: FloatArray
) -> tuple[FloatArray, NDArray[np.int8]]:
    """Return the curve of a cloud for each sample, in the columns of `probabilities`, and its kind: least squares of
    ln(demand) on ln(x) over runs with a demand that do not collapse.
    """
    log = np.log(intensities)
    moves = ~collapsed & (demand > 0.0)
    collapse = logistic_fits(log, collapsed, weight)
    curves: FloatArray = np.full((len(weight), 4), np.nan)
    curves[:, 2], curves[:, 3] = np.exp(collapse.median), collapse.dispersion
    counts, x, y = weight[:, moves], log[moves], np.log(demand[moves])
    number = counts.sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        middle_x, middle_y = counts @ x / number, counts @ y / number
        off = x - middle_x[:, None]
        across = (counts * off * off).sum(axis=1)
        slope = (counts * off * (y - middle_y[:, None])).sum(axis=1) / across
        error = y - middle_y[:, None] - slope[:, None] * off
        scatter = np.sqrt((counts * error * error).sum(axis=1) / (number - 2.0))
        median = np.exp(middle_x + (np.log(limit) - middle_y) / slope)
    spread = np.where(counts > 0.0, np.abs(off), 0.0).max(axis=1, initial=0.0)
    kind = np.where(slope > _FLAT, FITTED, FALLING).astype(np.int8)
    kind[(number <= 2.0) | (spread < _SAME)] = NONE
    kind[collapse.kind == FALLING] = FALLING
    fitted = kind == FITTED
    curves[fitted, 0], curves[fitted, 1] = median[fitted], scatter[fitted] / slope[fitted]
    # All runs on one line within rounding: no scatter, so no dispersion.
    exact = fitted & (scatter < _SAME)
    kind[exact], curves[exact, 1] = STEP, 0.0
    nothing = number == 0.0
    kind[nothing & (collapse.kind == NEVER)], kind[nothing & (collapse.kind == ALWAYS)] = NEVER, ALWAYS
    curves[kind == NEVER, 0], curves[kind == ALWAYS, 0] = np.inf, 0.0
    return curves, kind


def _logistic(z: FloatArray, occurred: NDArray[np.bool_], weight: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Intercept and slope of the logistic regression on z, one of each sample."""
    from scipy.special import expit  # slow to import

    sign = np.where(occurred, 1.0, -1.0)

    def loss(ab: FloatArray) -> FloatArray:
        return np.asarray((weight * np.logaddexp(0.0, -sign * (ab[:, :1] + ab[:, 1:] * z))).sum(axis=1))

    def derivatives(ab: FloatArray) -> tuple[FloatArray, FloatArray]:
        p = expit(ab[:, :1] + ab[:, 1:] * z)
        first, second = weight * (p - occurred), weight * p * (1.0 - p)
        gradient = np.stack([first.sum(axis=1), first @ z], axis=1)
        cross = second @ z
        curvature = np.stack([second.sum(axis=1), cross, cross, second @ (z * z)], axis=1)
        return gradient, curvature.reshape(-1, 2, 2)

    ab = _newton(np.zeros((len(weight), 2)), loss, derivatives)
    return ab[:, 0], ab[:, 1]


def _probit(z: FloatArray, hit: FloatArray, missed: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Intercept and slope of the probit regression of counts on z, one of each sample."""
    from scipy.special import log_ndtr  # slow to import

    def loss(ab: FloatArray) -> FloatArray:
        eta = ab[:, :1] + ab[:, 1:] * z
        return -np.asarray((hit * log_ndtr(eta) + missed * log_ndtr(-eta)).sum(axis=1))

    def derivatives(ab: FloatArray) -> tuple[FloatArray, FloatArray]:
        eta = ab[:, :1] + ab[:, 1:] * z
        above, below = _mills(eta), _mills(-eta)
        first = -hit * above + missed * below
        second = hit * above * (above + eta) + missed * below * (below - eta)
        gradient = np.stack([first.sum(axis=1), first @ z], axis=1)
        cross = second @ z
        curvature = np.stack([second.sum(axis=1), cross, cross, second @ (z * z)], axis=1)
        return gradient, curvature.reshape(-1, 2, 2)

    ab = _newton(np.zeros((len(hit), 2)), loss, derivatives)
    return ab[:, 0], ab[:, 1]


def _tobit(t: FloatArray, seen: FloatArray, censored: FloatArray) -> tuple[FloatArray, FloatArray]:
    """1/beta and ln(theta)/beta of censored logarithms t, one of each sample."""
    from scipy.special import log_ndtr  # slow to import

    number = seen.sum(axis=1)

    def loss(p: FloatArray) -> FloatArray:
        residual = p[:, :1] * t - p[:, 1:]
        with np.errstate(invalid="ignore", divide="ignore"):
            inner = number * np.log(p[:, 0]) - 0.5 * (seen * residual**2).sum(axis=1)
        inner += (censored * log_ndtr(-residual)).sum(axis=1)
        return np.where(p[:, 0] > 0.0, -inner, np.inf)

    def derivatives(p: FloatArray) -> tuple[FloatArray, FloatArray]:
        residual = p[:, :1] * t - p[:, 1:]
        hazard = _mills(-residual)
        first = seen * residual + censored * hazard
        second = seen + censored * hazard * (hazard - residual)
        gradient = np.stack([first @ t - number / p[:, 0], -first.sum(axis=1)], axis=1)
        cross = -(second @ t)
        curvature = np.stack([second @ (t * t) + number / p[:, 0] ** 2, cross, cross, second.sum(axis=1)], axis=1)
        return gradient, curvature.reshape(-1, 2, 2)

    spread = float(t.std()) or 1.0
    start = np.tile([1.0 / spread, 0.0], (len(seen), 1))
    parameters = _newton(start, loss, derivatives)
    return parameters[:, 0], parameters[:, 1]


def _mills(x: FloatArray) -> FloatArray:
    """phi(x) / Phi(x), without underflow."""
    from scipy.special import log_ndtr  # slow to import

    return np.asarray(np.exp(-0.5 * x * x - 0.5 * np.log(2.0 * np.pi) - log_ndtr(x)))


def _newton(start: FloatArray, loss: Loss, derivatives: Derivatives) -> FloatArray:
    """Minimise convex losses of two parameters, one of each row, by Newton steps that are halved until they help."""
    parameters = start.copy()
    value = loss(parameters)
    for _ in range(_ITERATIONS):
        gradient, curvature = derivatives(parameters)
        step = -_solved(curvature, gradient)
        decrement = -(gradient * step).sum(axis=1)
        if not (decrement > _CONVERGED * np.maximum(1.0, np.abs(value))).any():
            break
        factor = np.ones(len(parameters))
        for _ in range(_HALVINGS):
            worse = ~(loss(parameters + factor[:, None] * step) <= value + _ROUNDING * np.abs(value))
            if not worse.any():
                break
            factor[worse] *= 0.5
        factor[worse] = 0.0
        parameters = parameters + factor[:, None] * step
        value = loss(parameters)
    return parameters


def _solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Solve symmetric systems of two equations, shape (rows, 2, 2) and (rows, 2); zero where one is singular."""
    (a, b), (_, d) = np.moveaxis(matrix, 0, -1)
    determinant = a * d - b * b
    inverse = np.divide(1.0, determinant, out=np.zeros_like(determinant), where=determinant > 0.0)
    solved: FloatArray = (
        np.stack([d * right[:, 0] - b * right[:, 1], a * right[:, 1] - b * right[:, 0]], axis=1) * inverse[:, None]
    )
    return solved
