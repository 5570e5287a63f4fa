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
from seismass.studies.fragility.run import REAL

MODEL_LEVELS: Final = (0.10, 0.50)
"""Probabilities of the compared models at whose intensities the reference is looked at: 10 % as the collapse goal of
ASCE 7 for risk category II at the maximum considered earthquake, and the median."""

Fragilities = Mapping[tuple[str, str], Fragility]
"""Fragilities by name of the model and name of the limit."""


def reference_of(models: Sequence[str]) -> str:
    """Return the model with which others are compared: "real", else the first."""
    return REAL if REAL in models else models[0]


def fragility_table(found: Fragilities) -> pl.DataFrame:
    """Return one row per model and limit; see `FragilityAnalysis.fragilities`."""
    rows = []
    for (model, limit), fit in found.items():
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


def comparison_table(found: Fragilities, limits: Sequence[LimitState], models: Sequence[str]) -> pl.DataFrame:
    """Return one row per limit and model beside the reference; see `FragilityAnalysis.comparison`."""
    reference = reference_of(models)
    rows = []
    for limit in limits:
        real = found.get((reference, limit.name))
        for model in models:
            fit = found.get((model, limit.name))
            if model == reference or fit is None or real is None:
                continue
            fitted = {fit.kind, real.kind} == {"fitted"}
            low = high = np.nan
            if fitted and len(fit.samples) and len(real.samples):
                with np.errstate(invalid="ignore", divide="ignore"):
                    drawn = medians_and_dispersions(fit.samples)[0] / medians_and_dispersions(real.samples)[0]
                low, high = (float(end) for end in interval_of(drawn, fit.confidence))
            rows.append(
                {
                    "limit": limit.name,
                    "model": model,
                    "median_ratio": _ratio(fit.median, real.median) if fitted else np.nan,
                    "median_ratio_low": low,
                    "median_ratio_high": high,
                    "median": fit.median,
                    "reference_median": real.median,
                }
            )
    floats = ("median_ratio", "median_ratio_low", "median_ratio_high", "median", "reference_median")
    return _frame(rows, floats)


def exceedance_table(
    found: Fragilities, limits: Sequence[LimitState], models: Sequence[str], at: FloatArray
) -> pl.DataFrame:
    """Return one row per limit, intensity and model beside the reference; see `FragilityAnalysis.exceedance`."""
    reference = reference_of(models)
    rows = []
    for limit in limits:
        real = found.get((reference, limit.name))
        if real is None:
            continue
        others = [model for model in models if model != reference and (model, limit.name) in found]
        for model in others or [reference]:
            fit = found[model, limit.name]
            chosen = [("chosen", float(level)) for level in at]
            if model != reference and fit.kind == "fitted":
                chosen += [(f"{model} at {100.0 * level:g} %", fit.quantile(level)) for level in MODEL_LEVELS]
            rows += [{"limit": limit.name, "model": model, "given": given, **_at(fit, real, x)} for given, x in chosen]
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


def _at(fit: Fragility, real: Fragility, intensity: float) -> dict[str, float]:
    """Probabilities of a model and of the reference at one intensity, their difference and their ratio."""
    x = np.array([intensity])
    own, other = (_known(each, x) for each in (fit, real))
    values = [own, *_interval(fit, x), other, *_interval(real, x), other - own]
    ends = [np.nan] * 4
    if not np.isnan(other - own) and len(fit.samples) and len(real.samples):
        drawn, of_real = (probabilities(each.samples, x)[:, 0] for each in (fit, real))
        with np.errstate(invalid="ignore", divide="ignore"):
            ends = [
                float(end) for each in (of_real - drawn, of_real / drawn) for end in interval_of(each, fit.confidence)
            ]
    values += [*ends[:2], _ratio(other, own), *ends[2:]]
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


def curve_table(found: Fragilities, limits: Sequence[LimitState], points: int = 100) -> pl.DataFrame:
    """Return fragility curves with their bands; see `FragilityAnalysis.curves`."""
    frames = []
    for limit in limits:
        own = {model: fit for (model, name), fit in found.items() if name == limit.name}
        known = [fit.quantile(0.98) for fit in own.values() if fit.kind == "fitted"]
        seen = [fit.highest for fit in own.values() if np.isfinite(fit.highest)]
        finite = [value for value in known if np.isfinite(value)] or seen
        grid = np.linspace(0.0, max(finite, default=1.0), points + 1)[1:]
        for model, fit in own.items():
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
    """Rows as a frame in which what is not known is null; with its columns also where there are none."""
    schema = {**dict.fromkeys(texts, pl.String), **dict.fromkeys(floats, pl.Float64)}
    if not rows:
        return pl.DataFrame(schema=schema)
    frame = pl.DataFrame(rows, schema_overrides=schema)
    return frame.with_columns(pl.col(pl.Float64).fill_nan(None))
