"""Distributions of unknown quantities: any frozen one of scipy.stats, and two by the numbers that people state."""

from __future__ import annotations

from typing import Any, Final, Protocol, runtime_checkable

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import as_number, refusal

__all__ = [
    "Distribution",
    "beta",
    "lognormal",
]

_SMALLEST: Final = 1e-150
"""Smallest standard deviation whose square is not zero."""


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)


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


def _pair(first: Any, second: Any) -> tuple[tuple[str, Any], tuple[str, Any]]:
    return ("first argument", first), ("second argument", second)
