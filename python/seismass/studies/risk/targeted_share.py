"""The risk-targeted share: which share of the live load, attached as mass, gives the annual rate of exceeding a drift
limit that the building with sliding goods has.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from numbers import Real
from typing import TYPE_CHECKING, Any, ClassVar, Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import Progress, ProgressLike, as_bootstrap, as_share, as_threads
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.stored_results import metadata_head, motion_contents
from seismass.base.values import FieldValue, FloatArray, as_array, as_number, brief, refusal
from seismass.base.views import view
from seismass.effective_mass.answer import effective_mass
from seismass.effective_mass.models import (
    SAME_DAMPING,
    ModelDamping,
    attached,
    building_of,
    check_damping,
    check_fractions,
    check_loaded,
)
from seismass.effective_mass.result import EffectiveMass
from seismass.effective_mass.share import Kind
from seismass.media.result import Result, finite_values
from seismass.model.scene import Scene
from seismass.motions.motion import HasMotion, Motion, MotionLike
from seismass.studies.fragility.hunt import exact_capacities
from seismass.studies.fragility.limits import IntensityMeasure, LimitState, MeasureName, parse_limit
from seismass.studies.fragility.run import DEFAULT_CODE_SHARE, SLIDING, Setting, setting_of
from seismass.studies.risk.hazard import DESIGN_RATE, HazardCurve, check_hazard
from seismass.studies.risk.tables import (
    OWNER,
    Estimator,
    RiskOptions,
    RiskSearch,
    capacity_table,
    check_estimator,
    curve_table,
    fragility_table,
    interval,
    rate_table,
    risk_remarks,
    sensitivity_table,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure


SCHEMA_VERSION: Final = 2
"""Version of the tables and of the JSON of a risk-targeted share."""


@dataclass(frozen=True, eq=False, repr=False)
class RiskTargetedShare(FieldValue, Result):
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
        real / model - 1; zero except for rounding where the value is a root.
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
        """Return everything but the curve and the capacities as plain values; null for non-finite values."""
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
        return finite_values(document)

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


OTHER_LIMITS: Final = (0.25, 0.5, 1.5)
"""Other limits of which the share is given, over the limit asked for."""


def risk_targeted_share(
    scene: Scene,
    motions: MotionLike | Iterable[MotionLike],
    hazard: HazardCurve,
    limit: LimitState | str | float,
    *,
    measure: MeasureName | IntensityMeasure = "sa_t1",
    period: float | None = None,
    damping: ModelDamping = SAME_DAMPING,
    code_share: float = DEFAULT_CODE_SHARE,
    shares: ArrayLike | None = None,
    estimator: Estimator = "lognormal",
    extrapolate: bool = False,
    other_limits: ArrayLike | None = None,
    design_rate: float = DESIGN_RATE,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> RiskTargetedShare:
    """Return the share of the live load whose attached model exceeds a drift limit as often as the real building.

    Parameters
    ----------
    scene : Scene
        The building with its goods as blocks.
    motions : Motion, Record or iterable of them
        The suite; every motion is scaled to its capacity. Records of one event are resampled together.
    hazard : HazardCurve
        Annual rate of exceedance of the intensity.
    limit : LimitState, str or float
        Limit of the largest drift ratio or drift, or its name ("drift_ratio=0.02"). A number is a drift ratio where the
        building has heights, else a drift in m.
    measure, period
        Intensity measure in g, the one that the hazard curve is of; see `seismass.fragility.IntensityMeasure`. By
        default Sa at the period of the hazard curve, or else at the first period of the building without goods. All
        models have the same.
    damping : {"same", "ratio"}, default "same"
        Damping of the models, see `attached_scene`.
    code_share : float, default 0.25
        Share whose rate is reported as the code's.
    shares : array_like, optional
        Shares at which models are solved before roots are refined, from 0 to 1; by default 0, 0.05, ..., 1.
    estimator : {"lognormal", "empirical"}, default "lognormal"
        Fragility of each model: lognormal through the capacities of the motions by maximum likelihood, or a step at
        each of them.
    extrapolate : bool, default False
        Continue the hazard curve beyond its ends by its end slopes, instead of leaving out what lies there.
    other_limits : array_like, optional
        Values of the limit for which the share is given beside; by default 1/4, 1/2 and 3/2 of it.
    design_rate : float, default 1/475
        Annual rate of the intensity at which `effective_mass` is set beside.
    confidence, resamples, seed
        Bootstrap over the motions, real and models drawn together: probability of intervals, number, seed.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.
    progress : callable, optional
        Called with (stages done, stages in all).

    Returns
    -------
    RiskTargetedShare
        The share, annual rates, and what they depend on.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be, the building has no goods, the measure is not an acceleration, or the limit
        is never exceeded within the hazard curve.
    SimulationError
        A run could not be carried to its end.
    KeyboardInterrupt
        Ctrl-C was pressed.

    Notes
    -----
    The smallest share whose attached model has an annual rate not below that of the real building, there and at every
    larger share up to 1: the definition of `effective_mass`, with the rate in place of the mean drift. The rate is the
    integral of the fragility over the hazard curve (`annual_rate`). Capacities are the intensities at which the drift
    first exceeds the limit, found on the exact model.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2], heights=3.0)
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], mu=50.0))
    >>> hazard = sm.risk.HazardCurve([0.05, 0.5, 5.0], [1e-2, 4e-4, 4e-6])
    >>> found = sm.risk.risk_targeted_share(scene, sm.builtin_suite("seven"), hazard, 0.01, shares=[0.0, 0.5, 1.0])
    >>> found.kind, found.value
    ('stuck', 1.0)
    """
    checked = _at_rest(check_loaded(scene, OWNER))
    curve = check_hazard(hazard, OWNER)
    probability, count, start = as_bootstrap(confidence, resamples, seed, OWNER)
    options = RiskOptions(
        limit=_limit(limit, checked),
        damping=check_damping(damping, OWNER),
        code_share=as_share(code_share, "code_share", OWNER),
        estimator=check_estimator(estimator, OWNER),
        extrapolate=bool(extrapolate),
        confidence=probability,
        resamples=count,
        seed=start,
        threads=as_threads(threads, OWNER),
    )
    grid = np.unique(np.append(check_fractions(shares, OWNER), options.code_share))
    limits = _limits(options.limit, other_limits)
    design = as_number(design_rate, "design_rate", OWNER, InvalidOption)
    listed = _listed(motions)
    period_used = curve.period if period is None and not isinstance(measure, IntensityMeasure) else period
    models = {SLIDING: checked} | {f"{share:.12g}": attached(checked, float(share), options.damping) for share in grid}
    slip = LimitState("slip", 0.0)
    setting = setting_of(models, listed, (*limits, slip), measure, period_used, OWNER, threads=options.threads)
    _check_measure(setting.measure, curve)
    whole = Progress(progress, len(limits) + 2, OWNER)
    capacities = {}
    for each in limits:
        capacities[each.value] = exact_capacities(setting, each, threads=options.threads)
        whole.tell()
    search = RiskSearch(checked, setting, curve, options, grid, capacities[options.limit.value])
    answer = search.answer()
    whole.tell()
    effective, reason = _effective(checked, listed, setting, curve, design, options, grid)
    whole.tell()
    rates, several = search.rates, setting.motions.clusters > 1
    model = search.rate_at(answer.value) if answer.roots else rates.at(answer.value)[0]
    draws = np.full(1, answer.value) if answer.by_friction else rates.value_draws
    code, full = (rates.at(share)[0] for share in (options.code_share, 1.0))
    settings = _settings_of(options, grid, setting.measure, curve, design)
    return RiskTargetedShare(
        value=answer.value,
        kind=answer.kind,
        roots=answer.roots,
        interval=interval(draws, options.confidence) if several else None,
        confidence=options.confidence,
        limit=options.limit,
        estimator=options.estimator,
        real=rates.sliding,
        code=code,
        attached=full,
        model=model,
        excess=rates.sliding / model - 1.0,
        code_share=options.code_share,
        rates=rate_table(search, several),
        curve=curve_table(rates, options.confidence, several),
        fragilities=fragility_table(search),
        capacities=capacity_table(search),
        sensitivity=sensitivity_table(search, capacities, answer, several),
        hazard=curve,
        measure=setting.measure,
        effective=effective,
        remarks=risk_remarks(search, answer, reason),
        metadata={
            **metadata_head(SCHEMA_VERSION, checked, motion_contents(setting.motions.components), settings),
            **settings,
            "motions": len(setting.motions),
            "clusters": setting.motions.clusters,
        },
    )


def _effective(
    scene: Scene,
    motions: list[Any],
    setting: Setting,
    hazard: HazardCurve,
    rate: float,
    options: RiskOptions,
    grid: FloatArray,
) -> tuple[EffectiveMass | None, str]:
    """The effective fraction at the design intensity, or None with the reason."""
    if not hazard.annual_rate[-1] <= rate <= hazard.annual_rate[0]:
        return (
            None,
            f"the hazard curve does not reach the design rate of {rate:.3g} a year: no effective fraction there",
        )
    level = hazard.intensity(rate)
    scaled = [
        (each if hasattr(each, "scaled") else each.motion).scaled(level / unit)
        for each, unit in zip(motions, setting.unit.tolist(), strict=True)
    ]
    effective = effective_mass(
        scene,
        scaled,
        damping=options.damping,
        fractions=grid,
        confidence=options.confidence,
        resamples=options.resamples,
        seed=options.seed,
        threads=options.threads,
    )
    return effective, ""


def _settings_of(
    options: RiskOptions, grid: FloatArray, measure: IntensityMeasure, hazard: HazardCurve, design: float
) -> dict[str, Any]:
    """Everything that the numbers depend on beside scene and motions, as plain values."""
    return {
        "question": "risk",
        "limit": options.limit.to_dict(),
        "measure": measure.to_dict(),
        "hazard": hazard.parameters,
        "damping": options.damping,
        "code_share": options.code_share,
        "shares": grid.tolist(),
        "estimator": options.estimator,
        "extrapolate": options.extrapolate,
        "design_rate": design,
        "confidence": options.confidence,
        "resamples": options.resamples,
        "seed": options.seed,
    }


def _at_rest(scene: Scene) -> Scene:
    """A scene that has no drift and no velocity at the start, so that no demand comes with intensity zero."""
    states = (scene.initial_drift, scene.initial_velocity)
    if any(state is not None and state.any() for state in states) or any(block.velocity for block in scene.blocks):
        raise refusal(InvalidScene, "initial state", OWNER, "at rest", "drifts or velocities")
    return scene


def _listed(motions: Any) -> list[Any]:
    if isinstance(motions, Motion | HasMotion):
        return [motions]
    return list(motions) if isinstance(motions, Iterable) else motions


def _limit(limit: Any, scene: Scene) -> LimitState:
    """A limit of peak drift; a number counts as one of drift ratio, or of drift where there are no heights."""
    if isinstance(limit, Real) and not isinstance(limit, bool):
        return LimitState("drift" if building_of(scene).heights is None else "drift_ratio", float(limit))
    limit = parse_limit(limit) if isinstance(limit, str) else limit
    if not isinstance(limit, LimitState) or limit.quantity not in ("drift", "drift_ratio"):
        raise refusal(InvalidOption, "limit", OWNER, "a number, or a LimitState of drift or drift_ratio", brief(limit))
    return limit


def _limits(limit: LimitState, others: Any) -> tuple[LimitState, ...]:
    """The limit, and others of the same quantity and storey in increasing order."""
    values = (
        np.array(OTHER_LIMITS) * limit.value
        if others is None
        else as_array(others, "other_limits", OWNER, InvalidOption)
    )
    if not (np.isfinite(values) & (values > 0.0)).all():
        raise refusal(InvalidOption, "other_limits", OWNER, "positive", brief(values.tolist()))
    more = sorted(set(values.tolist()) - {limit.value})
    return (limit, *(LimitState(limit.quantity, value, storey=limit.storey) for value in more))


def _check_measure(measure: IntensityMeasure, hazard: HazardCurve) -> None:
    """Refuse a measure that the hazard curve cannot be of."""
    if measure.unit != "g":
        raise refusal(InvalidOption, "measure", OWNER, "an acceleration in g, as the hazard curve is", measure.name)
    if measure.name == "sa_t1" and hazard.period is not None and measure.period != hazard.period:
        requirement = f"the period of the hazard curve, {hazard.period:g} s"
        raise refusal(InvalidOption, "period", OWNER, requirement, f"{measure.period:g} s")
