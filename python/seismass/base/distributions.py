"""Distributions of unknown quantities: any frozen one of scipy.stats, some by numbers that people state, mixtures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol, runtime_checkable

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_array, as_number, brief, refusal

__all__ = [
    "Distribution",
    "beta",
    "bounded",
    "gamma",
    "lognormal",
    "mixture",
]

_SMALLEST: Final = 1e-150
"""Smallest standard deviation whose square is not zero."""

__dir__ = __all__.copy  # for completion


@runtime_checkable
class Distribution(Protocol):
    """A distribution as scipy.stats freezes it."""

    def ppf(self, q: Any) -> Any:
        """Return quantiles."""
        ...


def lognormal(median: float, sigma: float) -> Distribution:
    """Return a lognormal distribution by its median and the standard deviation of its logarithm."""
    centre, spread = (as_number(value, name, "lognormal", InvalidOption) for name, value in _pair(median, sigma))
    if not (centre > 0.0 and spread > 0.0 and np.isfinite([centre, spread]).all()):
        raise refusal(InvalidOption, "median and sigma", "lognormal", "positive", f"{centre:g} and {spread:g}")
    from scipy import stats  # slow to import

    frozen: Distribution = stats.lognorm(s=spread, scale=centre)
    return frozen


def beta(mean: float, deviation: float) -> Distribution:
    """Return a beta distribution on [0, 1] by its mean and standard deviation."""
    centre, spread = (as_number(value, name, "beta", InvalidOption) for name, value in _pair(mean, deviation))
    if not (0.0 < centre < 1.0 and _SMALLEST < spread < np.sqrt(centre * (1.0 - centre))):
        requirement = "between 0 and 1, and a standard deviation above 0 and below sqrt(mean (1 - mean))"
        raise refusal(InvalidOption, "mean", "beta", requirement, f"{centre:g} and {spread:g}")
    total = centre * (1.0 - centre) / spread**2 - 1.0
    from scipy import stats  # slow to import

    frozen: Distribution = stats.beta(centre * total, (1.0 - centre) * total)
    return frozen


def gamma(mean: float, deviation: float) -> Distribution:
    """Return a gamma distribution by its mean and standard deviation."""
    centre, spread = (as_number(value, name, "gamma", InvalidOption) for name, value in _pair(mean, deviation))
    if not (centre > 0.0 and spread > 0.0 and np.isfinite([centre, spread]).all()):
        raise refusal(InvalidOption, "mean and deviation", "gamma", "positive", f"{centre:g} and {spread:g}")
    from scipy import stats  # slow to import

    frozen: Distribution = stats.gamma((centre / spread) ** 2, scale=spread**2 / centre)
    return frozen


@dataclass(frozen=True)
class _Bounded:
    distribution: Distribution
    most: float

    def ppf(self, q: Any) -> Any:
        return np.minimum(self.distribution.ppf(q), self.most)


def bounded(distribution: Distribution, most: float) -> Distribution:
    """Return a distribution whose values above `most` are `most`."""
    if not isinstance(distribution, Distribution):
        raise refusal(InvalidOption, "distribution", "bounded", "one with quantiles", brief(distribution))
    return _Bounded(distribution, as_number(most, "most", "bounded", InvalidOption))


@dataclass(frozen=True)
class _Mixture:
    parts: tuple[Any, ...]
    weights: tuple[float, ...]

    def ppf(self, q: Any) -> Any:  # by bisection between the least and the largest of the parts
        level = np.asarray(q, dtype=np.float64)
        ends = np.array([np.broadcast_to(p if _is_number(p) else p.ppf(level), level.shape) for p in self.parts])
        low, high = ends.min(axis=0), ends.max(axis=0)
        for _ in range(60):
            middle = 0.5 * (low + high)
            is_above = self._below(middle) >= level
            low, high = np.where(is_above, low, middle), np.where(is_above, middle, high)
        return high

    def _below(self, value: FloatArray) -> FloatArray:
        parts = zip(self.parts, self.weights, strict=True)
        return np.asarray(sum(w * np.asarray(value >= p if _is_number(p) else p.cdf(value)) for p, w in parts))


def mixture(parts: Sequence[Any], weights: Sequence[float]) -> Distribution:
    """Return a mixture of frozen distributions of scipy.stats or numbers: the friction of one of several contacts.

    Parameters
    ----------
    parts, weights
        The distributions or numbers, and their probabilities, which are divided by their sum.

    Examples
    --------
    >>> import seismass as sm
    >>> wooden, plastic = sm.distributions.lognormal(0.45, 0.25), sm.distributions.lognormal(0.2, 0.25)
    >>> friction = sm.distributions.mixture([wooden, plastic], [0.8, 0.2])
    >>> friction.ppf([0.1, 0.5, 0.9]).round(3).tolist()
    [0.2, 0.416, 0.6]
    """
    shares = as_array(weights, "weights", "mixture", InvalidOption)
    stated: Any = parts
    listed = tuple(stated) if isinstance(stated, Sequence) else ()
    known = all(_is_number(part) or (hasattr(part, "ppf") and hasattr(part, "cdf")) for part in listed)
    if not listed or not known:
        requirement = "frozen distributions of scipy.stats, or numbers"
        raise refusal(InvalidOption, "parts", "mixture", requirement, brief(parts))
    if len(shares) != len(listed) or not (shares >= 0.0).all() or not shares.sum() > 0.0:
        requirement = f"{len(listed)} probabilities, one for each part"
        raise refusal(InvalidOption, "weights", "mixture", requirement, brief(shares.tolist()))
    return _Mixture(listed, tuple((shares / shares.sum()).tolist()))


def _is_number(part: Any) -> bool:
    return isinstance(part, float) or (isinstance(part, int) and abs(part) < 1e15)


def _pair(first: Any, second: Any) -> tuple[tuple[str, Any], tuple[str, Any]]:
    return ("first argument", first), ("second argument", second)
