"""Tables and remarks of a risk-targeted share: rates, the curve over shares, capacities, and what it depends on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.statistics import bootstrap_counts, interval_of
from seismass.base.values import FloatArray, counted, refusal
from seismass.effective_mass.models import ModelDamping, attached
from seismass.effective_mass.search import without_friction
from seismass.effective_mass.share import Kind, crossings, interpolated, is_below, kind_of, refined_root
from seismass.model.plausibility import usage_remarks
from seismass.model.scene import Scene
from seismass.studies.fragility.hunt import HIGHEST, exact_capacities
from seismass.studies.fragility.likelihood import capacity_fits
from seismass.studies.fragility.limits import LimitState
from seismass.studies.fragility.run import Setting, solve_runs
from seismass.studies.risk.annual_rate import RateParts, capacity_rates, lognormal_rates, truncation_remarks
from seismass.studies.risk.hazard import HazardCurve

Estimator: TypeAlias = Literal["lognormal", "empirical"]
"""Fragility that the capacities of the motions are taken as: a lognormal fit, or a step at each of them."""


def check_estimator(estimator: Any, owner: str) -> Estimator:
    """Return the name of an estimator."""
    checked: Estimator = as_word(estimator, get_args(Estimator), "estimator", owner)
    return checked


def fitted(capacities: FloatArray, weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return median and dispersion, each of shape (draws, models), of the finite capacities of each model under each
    row of weights: maximum likelihood, as in `fit_capacities`.
    """
    exceeded = np.ones(capacities.shape[1], dtype=np.bool_)
    fits = [capacity_fits(values, exceeded, weights) for values in capacities]
    return np.stack([fit.median for fit in fits], axis=1), np.stack([fit.dispersion for fit in fits], axis=1)


def rate_parts(capacities: FloatArray, hazard: HazardCurve, estimator: Estimator, weights: FloatArray) -> RateParts:
    """Return the annual rates of models under weighted motions, shape (draws, models)."""
    if estimator == "lognormal":
        return lognormal_rates(*fitted(capacities, weights), hazard)
    single = capacity_rates(capacities[:, :, None], hazard)  # of each model and motion alone
    share = weights / weights.sum(axis=1, keepdims=True)
    return RateParts(*(share @ part.T for part in single))


@dataclass(frozen=True, slots=True)
class RateCurve:
    """Annual rates (1/year) of the real building and of models by share of the live load attached, of all motions and
    of each resample: `model` has shape (shares,), `model_draws` (resamples, shares).
    """

    shares: FloatArray
    sliding: float
    model: FloatArray
    sliding_draws: FloatArray
    model_draws: FloatArray

    @property
    def kind(self) -> Kind:
        """How often the curve of models crosses the rate of the real building."""
        return kind_of(is_below(self.model, np.full(self.model.shape, self.sliding)))

    @property
    def brackets(self) -> list[tuple[float, float]]:
        """Neighbouring shares between which the curve of models crosses the rate of the real building."""
        return crossings(self.shares, self.model, np.array(self.sliding))

    @property
    def value(self) -> float:
        """The share by interpolation on the grid."""
        return float(interpolated(self.shares, self.model[None], np.full((1, len(self.shares)), self.sliding))[0])

    @property
    def value_draws(self) -> FloatArray:
        """The share in each resample, by interpolation on the grid, shape (resamples,)."""
        sliding = np.broadcast_to(self.sliding_draws[:, None], self.model_draws.shape)
        return interpolated(self.shares, self.model_draws, sliding)

    def at(self, share: float) -> tuple[float, FloatArray]:
        """Return the rate of the model at a share of the grid, and that of each resample."""
        index = int(np.flatnonzero(self.shares == share)[0])
        return float(self.model[index]), self.model_draws[:, index]


def interval(draws: FloatArray, confidence: float) -> tuple[float, float]:
    """Return the percentile interval of resamples."""
    low, high = interval_of(draws, confidence)
    return float(low), float(high)


OWNER: Final = "risk-targeted share"


@dataclass(frozen=True, slots=True)
class RiskOptions:
    """How a share is sought, checked once; see `risk_targeted_share`."""

    limit: LimitState
    damping: ModelDamping
    code_share: float
    estimator: Estimator
    extrapolate: bool
    confidence: float
    resamples: int
    seed: int
    threads: int | None


@dataclass(frozen=True, slots=True)
class FoundShare:
    """A share, how it was found, and its roots. `by_friction`: friction alone decides, as goods never slide up to the
    capacities or have no friction.
    """

    value: float
    kind: Kind
    roots: tuple[float, ...]
    by_friction: bool


@dataclass(frozen=True)
class RiskSearch:
    """What leads from capacities, shape (1 + shares, motions), to the share: the scene, the setting (the real building
    and models of the grid; a slip is asked for), the hazard curve and the options.
    """

    scene: Scene
    setting: Setting
    hazard: HazardCurve
    options: RiskOptions
    grid: FloatArray
    capacities: FloatArray

    @cached_property
    def weights(self) -> FloatArray:
        """How often each motion is in each resample, those of one earthquake together, shape (resamples, motions)."""
        return bootstrap_counts(self.setting.motions.cluster_of, self.options.resamples, self.options.seed)

    @cached_property
    def rates(self) -> RateCurve:
        """Rates by share."""
        return self.rates_of(self.capacities)

    def rates_of(
        self, capacities: FloatArray, hazard: HazardCurve | None = None, estimator: Estimator | None = None
    ) -> RateCurve:
        """Return rates by share for capacities, and where given for another hazard curve or estimator."""
        curve, how = hazard or self.hazard, estimator or self.options.estimator
        parts = [rate_parts(capacities, curve, how, each) for each in (np.ones((1, capacities.shape[1])), self.weights)]
        whole, drawn = (part.total(self.options.extrapolate) for part in parts)
        return RateCurve(self.grid, float(whole[0, 0]), whole[0, 1:], drawn[:, 0], drawn[:, 1:])

    def answer(self) -> FoundShare:
        """Return the share, its roots refined on the exact models; every motion must bring each model to the limit."""
        missing = int((~np.isfinite(self.capacities)).sum(axis=1).max())
        if missing:
            requirement = f"reached by all models under all motions, below {HIGHEST:g} times the elastic intensity"
            raise refusal(InvalidOption, "limit", OWNER, requirement, f"{missing} motions that do not reach it")
        if not self.rates.sliding > 0.0:
            requirement = "exceeded within the hazard curve"
            raise refusal(InvalidOption, "limit", OWNER, requirement, f"a rate of {self.rates.sliding:g} a year")
        if without_friction(self.scene):  # the real building is the bare one, whatever the curve does
            return FoundShare(0.0, "zero", (), True)
        if not self._slides():
            return FoundShare(1.0, "stuck", (), True)
        ratios: list[float] = (self.rates.model / self.rates.sliding - 1.0).tolist()
        known: dict[float, float] = dict(zip(self.grid.tolist(), ratios, strict=True))

        def difference(share: float) -> float:
            if share not in known:
                known[share] = self.rate_at(share) / self.rates.sliding - 1.0
            return known[share]

        kind = self.rates.kind
        roots = tuple(refined_root(difference, bracket) for bracket in self.rates.brackets)
        value = roots[-1] if kind in ("root", "multiple") else 0.0 if kind == "zero" else 1.0
        return FoundShare(value, kind, roots, False)

    def rate_at(self, share: float) -> float:
        """Return the annual rate of the model at any share, solved exactly."""
        model = attached(self.scene, share, self.options.damping)
        single = replace(self.setting, models={"model": model}, limits=(self.options.limit,))
        capacities = exact_capacities(single, self.options.limit, threads=self.options.threads)
        ones = np.ones((1, capacities.shape[1]))
        parts = rate_parts(capacities, self.hazard, self.options.estimator, ones)
        return float(parts.total(self.options.extrapolate)[0, 0])

    def _slides(self) -> bool:
        """Whether goods slide under any motion that brings the real building to the limit."""
        motion = np.arange(len(self.setting.motions))
        capacities = self.capacities[0]
        table = solve_runs(self.setting, np.zeros_like(motion), motion, capacities, threads=self.options.threads)
        return bool(np.any(table["slip"].to_numpy() > 0.0))


SLOPE_FACTORS: Final = (0.75, 1.25)
"""Factors of the slopes of the hazard curve at which the share is given."""


def rate_table(search: RiskSearch, several: bool) -> pl.DataFrame:
    """Return one row per model with its annual rate; see `RiskTargetedShare.rates`."""
    rates, options = search.rates, search.options
    models = (
        ("real", None, rates.sliding, rates.sliding_draws),
        ("code", options.code_share, *rates.at(options.code_share)),
        ("attached", 1.0, *rates.at(1.0)),
        ("none", 0.0, *rates.at(0.0)),
    )
    rows = [
        {
            "model": name,
            "share": share,
            **_interval("rate", rate, draws, options.confidence, several),
            "probability_50_years": float(-np.expm1(-50.0 * rate)),
            **_over_model(rates, rate, draws, options.confidence, several),
        }
        for name, share, rate, draws in models
    ]
    return pl.DataFrame(rows, schema_overrides=dict.fromkeys(("share", *_ENDS), pl.Float64))


_ENDS: Final = ("rate_low", "rate_high", "real_over_model", "real_over_model_low", "real_over_model_high")


def _interval(
    name: str, value: float | None, draws: FloatArray | None, confidence: float, several: bool
) -> dict[str, float | None]:
    """A value by its name, with the ends of its interval; None without draws or with one earthquake alone."""
    low, high = interval(draws, confidence) if several and draws is not None else (None, None)
    return {name: value, f"{name}_low": low, f"{name}_high": high}


def _over_model(
    rates: RateCurve, rate: float, draws: FloatArray, confidence: float, several: bool
) -> dict[str, float | None]:
    """The rate of the real building over that of a model, in the same resamples; None where one is zero."""
    ratios = rates.sliding_draws / draws if (draws > 0.0).all() else None
    return _interval("real_over_model", rates.sliding / rate if rate > 0.0 else None, ratios, confidence, several)


def curve_table(rates: RateCurve, confidence: float, several: bool) -> pl.DataFrame:
    """Return one row per share of the grid; see `RiskTargetedShare.curve`."""
    rows = []
    for share in rates.shares.tolist():
        rate, draws = rates.at(share)
        rows.append(
            {
                "fraction": share,
                **_interval("rate", rate, draws, confidence, several),
                "real_rate": rates.sliding,
                **_over_model(rates, rate, draws, confidence, several),
            }
        )
    return pl.DataFrame(rows, schema_overrides=dict.fromkeys(_ENDS, pl.Float64))


def fragility_table(search: RiskSearch) -> pl.DataFrame:
    """Return median (g) and dispersion of the capacities of each model: model, share, median, dispersion."""
    median, dispersion = fitted(search.capacities, np.ones((1, search.capacities.shape[1])))
    shares = [None, *search.grid.tolist()]
    return pl.DataFrame(
        {
            "model": ["real", *("attached" for _ in search.grid)],
            "share": pl.Series(shares, dtype=pl.Float64),
            "median": median[0],
            "dispersion": dispersion[0],
        }
    )


def capacity_table(search: RiskSearch) -> pl.DataFrame:
    """Return one row per model and motion: model, share, motion, record, capacity (g)."""
    motions = len(search.setting.motions)
    shares = [None, *search.grid.tolist()]
    return pl.DataFrame(
        {
            "model": [name for name in ("real", *("attached" for _ in search.grid)) for _ in range(motions)],
            "share": pl.Series([share for share in shares for _ in range(motions)], dtype=pl.Float64),
            "motion": np.tile(np.arange(1, motions + 1, dtype=np.uint32), len(shares)),
            "record": search.setting.motions.names * len(shares),
            "capacity": search.capacities.ravel(),
        }
    )


def sensitivity_table(
    search: RiskSearch, capacities: dict[float, FloatArray], answer: FoundShare, several: bool
) -> pl.DataFrame:
    """Return one row per changed assumption with its share and rates; see `RiskTargetedShare.sensitivity`. There are
    intervals where `several` earthquakes are there.
    """
    rows = []

    def add(parameter: str, setting: str, rates: RateCurve) -> None:
        draws = np.full(1, answer.value) if answer.by_friction else rates.value_draws
        low, high = interval(draws, search.options.confidence) if several else (None, None)
        code, full = (rates.at(share)[0] for share in (search.options.code_share, 1.0))
        positive = rates.sliding > 0.0
        rows.append(
            {
                "parameter": parameter,
                "setting": setting,
                "value": None if not positive else answer.value if answer.by_friction else rates.value,
                "low": low if positive else None,
                "high": high if positive else None,
                "kind": answer.kind if answer.by_friction else rates.kind,
                "real_rate": rates.sliding,
                "code_rate": code,
                "attached_rate": full,
                "real_over_code": rates.sliding / code if code > 0.0 else None,
            }
        )

    add("as asked for", "", search.rates)
    limit = search.options.limit
    for value, capacities_at in sorted(capacities.items()):
        if value != limit.value and np.isfinite(capacities_at).all():
            shown = f"{limit.shown_scale * value:.4g} {'%' if limit.quantity == 'drift_ratio' else 'mm'}"
            add("limit", shown, search.rates_of(capacities_at))
    for factor in SLOPE_FACTORS:
        add("hazard slope", f"x {factor:g}", search.rates_of(search.capacities, hazard=search.hazard.tilted(factor)))
    for other in get_args(Estimator):
        if other != search.options.estimator:
            add("fragility", other, search.rates_of(search.capacities, estimator=other))
    kinds = dict.fromkeys(("value", "low", "high", "real_over_code"), pl.Float64)
    return pl.DataFrame(rows, schema_overrides=kinds, infer_schema_length=None)


def risk_remarks(search: RiskSearch, answer: FoundShare, reason: str) -> tuple[str, ...]:
    """Return assumptions, and what a user must know beside the numbers."""
    rates, motions = search.rates, len(search.setting.motions)
    asked = ((limit.quantity, limit.value) for limit in (search.options.limit,))
    remarks = [
        *usage_remarks(search.scene.remarks, (), asked),
        "the same motions are scaled to all intensities, whereas those that a site has change their spectra with the "
        "intensity",
    ]
    if answer.kind == "multiple":
        listed = ", ".join(f"{root:.3f}" for root in answer.roots)
        remarks.append(f"{len(answer.roots)} shares give the same rate ({listed}); the largest counts")
    if answer.kind == "one":
        remarks.append(
            f"with sliding goods the limit is exceeded {rates.sliding / float(rates.model[-1]):.3g} times as often as "
            f"with all goods attached"
        )
    parts = rate_parts(search.capacities[:1], search.hazard, search.options.estimator, np.ones((1, motions)))
    if not search.options.extrapolate:
        inside_rate, below, above = (float(part[0, 0]) for part in (parts.within, parts.below, parts.above))
        remarks += truncation_remarks(inside_rate, below, above, search.hazard)
    outside = int((search.capacities[0] > search.hazard.sa_g[-1]).sum())
    if outside:
        remarks.append(
            f"under {counted(outside, 'motion')} of {motions} the building reaches the limit only where the "
            f"hazard curve has ended"
        )
    if motions < 7:
        remarks.append(f"{counted(motions, 'motion')}: few for a fragility")
    if reason:
        remarks.append(reason)
    return tuple(remarks)
