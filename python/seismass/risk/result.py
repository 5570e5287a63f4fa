"""What `risk_targeted_share` gives back: the share, annual rates, what they depend on, and the tables behind them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Final

import polars as pl

from seismass.base.values import content_hash, same_content, short_repr
from seismass.base.views import view
from seismass.effective_mass.curve import Kind
from seismass.effective_mass.result import EffectiveMass
from seismass.fragility.limits import LimitState
from seismass.fragility.measures import IntensityMeasure
from seismass.media.result import Result, finite_values
from seismass.risk.hazard import HazardCurve
from seismass.risk.rates import Estimator

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

SCHEMA_VERSION: Final = 2
"""Version of the tables and of the JSON of a risk-targeted share."""


@dataclass(frozen=True, eq=False)
class RiskTargetedShare(Result):
    """The share of the live load whose attached model exceeds a drift limit as often as the real building.

    Attributes
    ----------
    value : float
        The smallest share of the live load which, attached as mass, gives an annual rate of exceeding the limit not
        below that of the building with sliding goods, there and at every larger share up to 1.
    kind : {"stuck", "root", "multiple", "zero", "one"}
        As for `EffectiveMass`, with the rate in place of the drift. "stuck": no goods slide under any motion that
        brings the building to the limit; the value is exactly 1.
    roots : tuple of float
        All crossings on [0, 1].
    interval : tuple of float or None
        Percentile bootstrap interval over the motions, real building and models drawn together, by interpolation on
        the grid of shares; None with one earthquake alone.
    confidence : float
        Probability that intervals are made for.
    limit : LimitState
        The limit.
    estimator : {"lognormal", "empirical"}
        Fragility that the capacities were taken as.
    real, code, attached, model : float
        Annual rate (1/year) of the real building, and of the models with `code_share`, all goods, and `value` attached.
    excess : float
        real / model - 1; zero but for rounding where the value is a root.
    code_share : float
        Share of the code's model.
    rates : polars.DataFrame
        One row per model ("real", "code", "attached", "none"): model, share, rate with rate_low and rate_high (1/year),
        probability_50_years, real_over_model (rate of the real building over that of the model) with its interval.
    curve : polars.DataFrame
        One row per share: fraction, rate, rate_low, rate_high, real_rate, real_over_model, real_over_model_low,
        real_over_model_high.
    fragilities : polars.DataFrame
        Lognormal fit of the capacities of each model: model, share, median (g), dispersion.
    capacities : polars.DataFrame
        One row per model and motion: model, share, motion, record, capacity (g).
    sensitivity : polars.DataFrame
        One row per changed assumption: parameter, setting, value with low and high, kind, real_rate, code_rate,
        attached_rate, real_over_code; by interpolation on the grid of shares.
    hazard : HazardCurve
        The hazard curve.
    measure : IntensityMeasure
        The intensity measure.
    effective : EffectiveMass or None
        Effective fraction of the live load at the design intensity; None where the hazard curve does not reach it.
    remarks : tuple of str
        Assumptions, and what a user must know beside the numbers.
    metadata : dict
        Versions, digest of the inputs, seed, conventions, counts.
    """

    document: ClassVar[str] = "risk"

    value: float
    kind: Kind
    roots: tuple[float, ...]
    interval: tuple[float, float] | None
    confidence: float
    limit: LimitState
    estimator: Estimator
    real: float
    code: float
    attached: float
    model: float
    excess: float
    code_share: float
    rates: pl.DataFrame = field(repr=False)
    curve: pl.DataFrame = field(repr=False)
    fragilities: pl.DataFrame = field(repr=False)
    capacities: pl.DataFrame = field(repr=False)
    sensitivity: pl.DataFrame = field(repr=False)
    hazard: HazardCurve = field(repr=False)
    measure: IntensityMeasure = field(repr=False)
    effective: EffectiveMass | None = field(repr=False)
    remarks: tuple[str, ...] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)

    __repr__ = short_repr
    __eq__ = same_content
    __hash__ = content_hash

    @property
    @view
    def text(self) -> str:
        """The answer in lines: the share, annual rates, the effective fraction beside it, and what it depends on."""
        raise NotImplementedError

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name."""
        return {
            "risk_rates": self.rates,
            "risk_curve": self.curve,
            "risk_fragilities": self.fragilities,
            "risk_capacities": self.capacities,
            "risk_sensitivity": self.sensitivity,
            "hazard": self.hazard.table(),
        }

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the curve and the capacities as plain values; null for what is not finite."""
        names = ["value", "kind", "roots", "interval", "confidence", "estimator", "real", "code", "attached", "model"]
        names += ["excess", "code_share", "remarks", "metadata"]
        document: dict[str, Any] = {"schema_version": SCHEMA_VERSION}
        document |= {name: getattr(self, name) for name in names}
        effective = self.effective
        document |= {
            "limit": self.limit.to_dict(),
            "rates": self.rates.to_dicts(),
            "sensitivity": self.sensitivity.to_dicts(),
            "fragilities": self.fragilities.to_dicts(),
            "effective": None
            if effective is None
            else {"value": effective.value, "kind": effective.kind, "interval": effective.interval},
        }
        finite: dict[str, Any] = finite_values(document)
        return finite

    @property
    def figure_names(self) -> tuple[str, ...]:
        """risk: hazard and fragilities, and the rate of the real building over that of models."""
        return ("risk",)

    @view
    def plot(self, name: str | None = None, *, codes: Mapping[str, float] | None = None) -> Figure:
        """Return the figure of hazard and fragilities, and of the rate of the real building over that of models.

        Parameters
        ----------
        name : str, optional
            "risk".
        codes : mapping of str to float, optional
            Shares of codes to mark, by name; by default those of eight codes for storage.

        Raises
        ------
        InvalidOption
            There is no such figure.
        """
        raise NotImplementedError
