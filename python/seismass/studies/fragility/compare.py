"""Fragilities of several models side by side: capacities, and probabilities at intensities, each with its interval."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.statistics import interval_of
from seismass.base.values import FloatArray
from seismass.studies.fragility.fragility import Fragility, medians_and_dispersions, probabilities
from seismass.studies.fragility.limits import LimitState
from seismass.studies.fragility.run import SLIDING

MODEL_LEVELS: Final = (0.10, 0.50)
"""Probabilities of the compared models at which the reference is evaluated: 10 % as the collapse goal of
ASCE 7 for risk category II at the maximum considered earthquake, and the median."""

Fragilities = Mapping[tuple[str, str], Fragility]
"""Fragilities by name of the model and name of the limit."""


def reference_of(models: Sequence[str]) -> str:
    """Return the model with which others are compared: "real", else the first."""
    return SLIDING if SLIDING in models else models[0]


def fragility_table(fits: Fragilities) -> pl.DataFrame:
    """Return one row per model and limit; see `FragilityAnalysis.fragilities`."""
    rows = []
    for (model, limit), fit in fits.items():
        median, dispersion = (
            (None, None) if interval is None else interval
            for interval in (fit.median_interval, fit.dispersion_interval)
        )
        rows.append(
            {
                "limit": limit,
                "model": model,
                "kind": fit.kind,
                "method": fit.method,
                "median": fit.median,
                "median_low": median[0],
                "median_high": median[1],
                "dispersion": fit.dispersion,
                "dispersion_low": dispersion[0],
                "dispersion_high": dispersion[1],
                "runs": fit.runs,
                "exceeding": fit.exceeding,
                "lowest": fit.lowest,
                "highest": fit.highest,
            }
        )
    floats = ("median", "median_low", "median_high", "dispersion", "dispersion_low", "dispersion_high")
    return _frame(rows, floats)


def comparison_table(fits: Fragilities, limits: Sequence[LimitState], models: Sequence[str]) -> pl.DataFrame:
    """Return one row per limit and model beside the reference; see `FragilityAnalysis.comparison`."""
    reference = reference_of(models)
    rows = []
    for limit in limits:
        sliding = fits.get((reference, limit.name))
        for model in models:
            fit = fits.get((model, limit.name))
            if model == reference or fit is None or sliding is None:
                continue
            fitted = {fit.kind, sliding.kind} == {"fitted"}
            low = high = np.nan
            if fitted and len(fit.samples) and len(sliding.samples):
                with np.errstate(invalid="ignore", divide="ignore"):
                    drawn = medians_and_dispersions(fit.samples)[0] / medians_and_dispersions(sliding.samples)[0]
                low, high = (float(end) for end in interval_of(drawn, fit.confidence))
            rows.append(
                {
                    "limit": limit.name,
                    "model": model,
                    "median_ratio": _ratio(fit.median, sliding.median) if fitted else np.nan,
                    "median_ratio_low": low,
                    "median_ratio_high": high,
                    "median": fit.median,
                    "reference_median": sliding.median,
                }
            )
    floats = ("median_ratio", "median_ratio_low", "median_ratio_high", "median", "reference_median")
    return _frame(rows, floats)


def exceedance_table(
    fits: Fragilities, limits: Sequence[LimitState], models: Sequence[str], intensities: FloatArray
) -> pl.DataFrame:
    """Return one row per limit, intensity and model beside the reference; see `FragilityAnalysis.exceedance`."""
    reference = reference_of(models)
    rows = []
    for limit in limits:
        sliding = fits.get((reference, limit.name))
        if sliding is None:
            continue
        others = [model for model in models if model != reference and (model, limit.name) in fits]
        for model in others or [reference]:
            fit = fits[model, limit.name]
            points = [("chosen", float(level)) for level in intensities]
            if model != reference and fit.kind == "fitted":
                points += [(f"{model} at {100.0 * level:g} %", fit.quantile(level)) for level in MODEL_LEVELS]
            rows += [{"limit": limit.name, "model": model, "given": kind, **_at(fit, sliding, x)} for kind, x in points]
    floats = tuple(name for name in _AT if name != "intensity")
    return _frame(rows, ("intensity", *floats), ("limit", "model", "given"))


_AT: Final = (
    "intensity",
    "probability",
    "probability_low",
    "probability_high",
    "reference",
    "reference_low",
    "reference_high",
    "difference",
    "difference_low",
    "difference_high",
    "ratio",
    "ratio_low",
    "ratio_high",
)


def _at(fit: Fragility, sliding: Fragility, intensity: float) -> dict[str, float]:
    """Probabilities of a model and of the reference at one intensity, their difference and their ratio."""
    x = np.array([intensity])
    value, other = (_known(each, x) for each in (fit, sliding))
    values = [value, *_interval(fit, x), other, *_interval(sliding, x), other - value]
    ends = [np.nan] * 4
    if not np.isnan(other - value) and len(fit.samples) and len(sliding.samples):
        drawn, of_sliding = (probabilities(each.samples, x)[:, 0] for each in (fit, sliding))
        with np.errstate(invalid="ignore", divide="ignore"):
            ends = [
                float(end)
                for each in (of_sliding - drawn, of_sliding / drawn)
                for end in interval_of(each, fit.confidence)
            ]
    values += [*ends[:2], _ratio(other, value), *ends[2:]]
    return dict(zip(_AT, [intensity, *values], strict=True))


def _known(fit: Fragility, x: FloatArray) -> float:
    """Probability at an intensity; NaN where a step says nothing of it, as stripes may be far apart."""
    return float(np.nan if fit.kind == "step" else fit.probability(x)[0])


def _interval(fit: Fragility, x: FloatArray) -> tuple[float, float]:
    if np.isnan(_known(fit, x)):
        return np.nan, np.nan
    low, high = fit.band(x)
    return float(low[0]), float(high[0])


def _ratio(above: float, below: float) -> float:
    """Ratio of two values; NaN where both are zero, both infinite, or one is not known."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return float(np.float64(above) / np.float64(below))


def curve_table(fits: Fragilities, limits: Sequence[LimitState], points: int = 100) -> pl.DataFrame:
    """Return fragility curves with their bands; see `FragilityAnalysis.curves`."""
    frames = []
    for limit in limits:
        fits_of_limit = {model: fit for (model, name), fit in fits.items() if name == limit.name}
        known = [fit.quantile(0.98) for fit in fits_of_limit.values() if fit.kind == "fitted"]
        seen = [fit.highest for fit in fits_of_limit.values() if np.isfinite(fit.highest)]
        finite = [value for value in known if np.isfinite(value)] or seen
        grid = np.linspace(0.0, max(finite, default=1.0), points + 1)[1:]
        for model, fit in fits_of_limit.items():
            low, high = fit.band(grid)
            frames.append(
                pl.DataFrame(
                    {
                        "limit": np.repeat(limit.name, points),
                        "model": np.repeat(model, points),
                        "intensity": grid,
                        "probability": pl.Series(fit.probability(grid), nan_to_null=True),
                        "probability_low": pl.Series(low, nan_to_null=True),
                        "probability_high": pl.Series(high, nan_to_null=True),
                    }
                )
            )
    return pl.concat(frames)


def _frame(
    rows: list[dict[str, Any]], floats: Sequence[str], texts: Sequence[str] = ("limit", "model")
) -> pl.DataFrame:
    """Rows as a frame in which unknown values are null; with its columns also where there are none."""
    schema = {**dict.fromkeys(texts, pl.String), **dict.fromkeys(floats, pl.Float64)}
    if not rows:
        return pl.DataFrame(schema=schema)
    frame = pl.DataFrame(rows, schema_overrides=schema)
    return frame.with_columns(pl.col(pl.Float64).fill_nan(None))
