"""Annual rates of models by share attached, from the capacities of the motions, with bootstrap resamples of both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, brief, is_one_of, refusal
from seismass.effective_mass.curve import Kind, crossings, interpolated, is_below, kind_of
from seismass.fragility.likelihood import capacity_fits
from seismass.risk.annual_rate import RateParts, capacity_rates, lognormal_rates
from seismass.risk.hazard import HazardCurve

Estimator: TypeAlias = Literal["lognormal", "empirical"]
"""Fragility that the capacities of the motions are taken as: a lognormal fit, or a step at each of them."""


def check_estimator(estimator: Any, owner: str) -> Estimator:
    """Return the name of an estimator."""
    if not is_one_of(estimator, get_args(Estimator)):
        raise refusal(InvalidOption, "estimator", owner, "lognormal or empirical", brief(estimator))
    checked: Estimator = estimator
    return checked


def fitted(capacities: FloatArray, weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return median and dispersion, each of shape (draws, models), of the finite capacities of each model under each
    row of weights: maximum likelihood, as in `fit_capacities`.
    """
    exceeded = np.ones(capacities.shape[1], dtype=np.bool_)
    fits = [capacity_fits(own, exceeded, weights) for own in capacities]
    return np.stack([fit.median for fit in fits], axis=1), np.stack([fit.dispersion for fit in fits], axis=1)


def rate_parts(capacities: FloatArray, hazard: HazardCurve, estimator: Estimator, weights: FloatArray) -> RateParts:
    """Return the annual rates of models under weighted motions, shape (draws, models)."""
    if estimator == "lognormal":
        return lognormal_rates(*fitted(capacities, weights), hazard)
    single = capacity_rates(capacities[:, :, None], hazard)  # of each model and motion alone
    share = weights / weights.sum(axis=1, keepdims=True)
    return RateParts(*(share @ part.T for part in (single.within, single.below, single.above, single.above_least)))


@dataclass(frozen=True, slots=True)
class RateCurve:
    """Annual rates (1/year) of the real building and of models by share of the live load attached, of all motions and
    of each resample: `model` has shape (shares,), `model_draws` (resamples, shares).
    """

    shares: FloatArray
    real: float
    model: FloatArray
    real_draws: FloatArray
    model_draws: FloatArray

    @classmethod
    def of(
        cls,
        shares: FloatArray,
        real: FloatArray,
        model: FloatArray,
        hazard: HazardCurve,
        estimator: Estimator,
        extrapolate: bool,
        weights: FloatArray,
    ) -> RateCurve:
        """Return the rates for capacities of the real building, shape (motions,), and of models, (shares, motions)."""
        both = np.concatenate([real[None], model])
        whole = rate_parts(both, hazard, estimator, np.ones((1, len(real)))).total(extrapolate)[0]
        drawn = rate_parts(both, hazard, estimator, weights).total(extrapolate)
        return cls(shares, float(whole[0]), whole[1:], drawn[:, 0], drawn[:, 1:])

    @property
    def kind(self) -> Kind:
        """How often the curve of models crosses the rate of the real building."""
        return kind_of(is_below(self.model, np.full(self.model.shape, self.real)))

    @property
    def brackets(self) -> list[tuple[float, float]]:
        """Neighbouring shares between which the curve of models crosses the rate of the real building."""
        return crossings(self.shares, self.model, np.array(self.real))

    @property
    def value(self) -> float:
        """The share by interpolation on the grid."""
        return float(interpolated(self.shares, self.model[None], np.full((1, len(self.shares)), self.real))[0])

    @property
    def value_draws(self) -> FloatArray:
        """The share in each resample, by interpolation on the grid, shape (resamples,)."""
        real = np.broadcast_to(self.real_draws[:, None], self.model_draws.shape)
        return interpolated(self.shares, self.model_draws, real)

    def at(self, share: float) -> tuple[float, FloatArray]:
        """Return the rate of the model at a share of the grid, and that of each resample."""
        index = int(np.flatnonzero(self.shares == share)[0])
        return float(self.model[index]), self.model_draws[:, index]


def interval(draws: FloatArray, confidence: float) -> tuple[float, float]:
    """Return the percentile interval of resamples."""
    tail = 50.0 * (1.0 - confidence)
    low, high = np.percentile(draws, [tail, 100.0 - tail])
    return float(low), float(high)
