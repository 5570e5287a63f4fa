"""Tables and remarks of a risk-targeted share: rates, the curve over shares, capacities, and what it depends on."""

from __future__ import annotations

from typing import Any, Final, get_args

import numpy as np
import polars as pl

from seismass.base.values import FloatArray, counted
from seismass.model.plausibility import usage_remarks
from seismass.risk.annual_rate import truncation_remarks
from seismass.risk.rates import Estimator, RateCurve, fitted, interval, rate_parts
from seismass.risk.search import FoundShare, RiskSearch

SLOPE_FACTORS: Final = (0.75, 1.25)
"""Factors of the slopes of the hazard curve at which the share is given."""


def rate_table(search: RiskSearch, several: bool) -> pl.DataFrame:
    """Return one row per model with its annual rate; see `RiskTargetedShare.rates`."""
    rates, options = search.rates, search.options
    rows = []
    models = (
        ("real", None, rates.real, rates.real_draws),
        ("code", options.code_share, *rates.at(options.code_share)),
        ("attached", 1.0, *rates.at(1.0)),
        ("none", 0.0, *rates.at(0.0)),
    )
    for name, share, rate, draws in models:
        low, high = interval(draws, options.confidence) if several else (None, None)
        ratio = _ratio(rates.real_draws, draws, options.confidence) if several else (None, None)
        rows.append(
            {
                "model": name,
                "share": share,
                "rate": rate,
                "rate_low": low,
                "rate_high": high,
                "probability_50_years": float(-np.expm1(-50.0 * rate)),
                "real_over_model": rates.real / rate if rate > 0.0 else None,
                "real_over_model_low": ratio[0],
                "real_over_model_high": ratio[1],
            }
        )
    return pl.DataFrame(rows, schema_overrides=dict.fromkeys(("share", *_ENDS), pl.Float64))


_ENDS: Final = ("rate_low", "rate_high", "real_over_model", "real_over_model_low", "real_over_model_high")


def curve_table(rates: RateCurve, confidence: float, several: bool) -> pl.DataFrame:
    """Return one row per share of the grid; see `RiskTargetedShare.curve`."""
    rows = []
    for index, share in enumerate(rates.shares.tolist()):
        rate, draws = float(rates.model[index]), rates.model_draws[:, index]
        low, high = interval(draws, confidence) if several else (None, None)
        ratio = _ratio(rates.real_draws, draws, confidence) if several else (None, None)
        rows.append(
            {
                "fraction": share,
                "rate": rate,
                "rate_low": low,
                "rate_high": high,
                "real_rate": rates.real,
                "real_over_model": rates.real / rate if rate > 0.0 else None,
                "real_over_model_low": ratio[0],
                "real_over_model_high": ratio[1],
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
    search: RiskSearch, capacities: dict[float, FloatArray], found: FoundShare, several: bool
) -> pl.DataFrame:
    """Return one row per changed assumption with its share and rates; see `RiskTargetedShare.sensitivity`. There are
    intervals where `several` earthquakes are there.
    """
    rows = []

    def add(parameter: str, setting: str, rates: RateCurve) -> None:
        draws = np.full(1, found.value) if found.by_friction else rates.value_draws
        low, high = interval(draws, search.options.confidence) if several else (None, None)
        code, full = (rates.at(share)[0] for share in (search.options.code_share, 1.0))
        positive = rates.real > 0.0
        rows.append(
            {
                "parameter": parameter,
                "setting": setting,
                "value": None if not positive else found.value if found.by_friction else rates.value,
                "low": low if positive else None,
                "high": high if positive else None,
                "kind": found.kind if found.by_friction else rates.kind,
                "real_rate": rates.real,
                "code_rate": code,
                "attached_rate": full,
                "real_over_code": rates.real / code if code > 0.0 else None,
            }
        )

    add("as asked for", "", search.rates)
    limit = search.options.limit
    for value, own in sorted(capacities.items()):
        if value != limit.value and np.isfinite(own).all():
            shown = f"{limit.shown_scale * value:.4g} {'%' if limit.quantity == 'drift_ratio' else 'mm'}"
            add("limit", shown, search.rates_of(own))
    for factor in SLOPE_FACTORS:
        add("hazard slope", f"x {factor:g}", search.rates_of(search.capacities, hazard=search.hazard.tilted(factor)))
    for other in get_args(Estimator):
        if other != search.options.estimator:
            add("fragility", other, search.rates_of(search.capacities, estimator=other))
    kinds = dict.fromkeys(("value", "low", "high", "real_over_code"), pl.Float64)
    return pl.DataFrame(rows, schema_overrides=kinds, infer_schema_length=None)


def risk_remarks(search: RiskSearch, found: FoundShare, reason: str) -> tuple[str, ...]:
    """Return assumptions, and what a user must know beside the numbers."""
    rates, motions = search.rates, len(search.setting.motions)
    asked = ((limit.quantity, limit.value) for limit in (search.options.limit,))
    remarks = [
        *usage_remarks(search.scene.remarks, (), asked),
        "the same motions are scaled to all intensities, whereas those that a site has change their spectra with the "
        "intensity",
    ]
    if found.kind == "multiple":
        listed = ", ".join(f"{root:.3f}" for root in found.roots)
        remarks.append(f"{len(found.roots)} shares give the same rate ({listed}); the largest counts")
    if found.kind == "one":
        remarks.append(
            f"with sliding goods the limit is exceeded {rates.real / float(rates.model[-1]):.3g} times as often as "
            f"with all goods attached"
        )
    parts = rate_parts(search.capacities[:1], search.hazard, search.options.estimator, np.ones((1, motions)))
    if not search.options.extrapolate:
        within, below, above = (float(part[0, 0]) for part in (parts.within, parts.below, parts.above))
        remarks += truncation_remarks(within, below, above, search.hazard)
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


def _ratio(real: FloatArray, model: FloatArray, confidence: float) -> tuple[Any, Any]:
    """Interval of the rate of the real building over that of a model, in the same resamples; None where one is zero."""
    if not (model > 0.0).all():
        return None, None
    return interval(real / model, confidence)
