"""The effective fraction over a grid of buildings, loads, strengths and friction, and how simple rules do there."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from itertools import pairwise
from typing import Any, ClassVar, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.arguments import Progress, ProgressLike
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.statistics import QUANTILES, over_records, quantile
from seismass.base.stored_results import metadata_head
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_count, as_number, brief, refusal
from seismass.design import Combination, response_spectrum_analysis, vibration_modes
from seismass.design.scaling import ScalingResult, scale_asce7_10
from seismass.effective_mass.models import SAME_DAMPING, ModelDamping, attached, building_of, check_damping, full_weight
from seismass.effective_mass.rule import (
    OFFSET,
    RULES,
    SMALL_OFFSET,
    Rule,
    by_period,
    compared,
    exceptions,
    floor_coefficient,
    share_by_hand,
)
from seismass.effective_mass.share import Kind, equal_share, interpolated, is_below, kind_of
from seismass.media.result import Result
from seismass.model.block import blocks_on_floors
from seismass.model.building import DEFAULT_DAMPING, Building
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene
from seismass.model.springs import DEFAULT_OVERSTRENGTH, DEFAULT_SECOND_SLOPE, DEFAULT_THIRD_SLOPE
from seismass.motions.motion import motion_names, scaled_motions
from seismass.motions.records import Suite
from seismass.motions.spectra import TargetSpectrum, mean_spectrum
from seismass.motions.spectra.target import target_remarks
from seismass.runs.peaks import NamedMotions, Peaks, named_motions, solve

Roof: TypeAlias = Literal["bare", "loaded"]
"""Whether the roof carries goods as the other floors do."""
MapBuilding: TypeAlias = tuple[int, float, Roof]
"""Number of storeys, first period of the bare building (s), and roof."""

DEFAULT_BUILDINGS: Final[tuple[MapBuilding, ...]] = (
    (1, 0.2, "loaded"),
    (1, 0.4, "loaded"),
    (1, 0.8, "loaded"),
    (1, 1.6, "loaded"),
    (2, 0.2, "bare"),
    (2, 0.38, "bare"),
    (2, 0.8, "bare"),
    (3, 0.25, "bare"),
    (3, 0.47, "bare"),
    (3, 1.0, "bare"),
    (3, 0.6, "loaded"),
    (4, 0.3, "bare"),
    (4, 0.57, "bare"),
    (4, 1.2, "bare"),
    (6, 0.6, "bare"),
    (6, 1.2, "bare"),
)


@dataclass(frozen=True)
class EffectiveMassParameters:
    """What a map varies and what it holds fixed.

    Attributes
    ----------
    buildings : tuple of (int, float, {"bare", "loaded"})
        Number of storeys, first period of the bare building (s), roof.
    mass_ratios : tuple of float
        Mass of the goods over that of their floor, alpha, the same on every loaded floor.
    response_modification : tuple of float
        R; V_y = V_e/R of the building designed with `design_fraction`. R = 1 is elastic unless `yield_at_r1`.
    mus : tuple of float
        Friction coefficients, static and kinetic.
    intensities : tuple of float
        Factors of the scaled motions, strengths unchanged. Intensity s with V_y and mu is exactly intensity 1 with
        V_y/s and mu/s.
    design_fraction : float
        Share of the live load in the design of the strengths.
    overstrength, second_slope, third_slope, damping
        Of all buildings; the slopes are inferences.
    scaling_period : float or None
        Period (s) for which motions are scaled; None: the first of each building with its goods attached.
    combination : {"srss", "cqc"}
        Modal combination of the design.
    yield_at_r1 : bool
        Let R = 1 yield at V_e.
    model_damping : {"same", "ratio"}
        Damping of the models, see `attached_scene`.
    confidence, resamples, seed
        Of the bootstrap intervals.
    shares : int
        Number of shares from 0 to 1 at which models are solved; crossings are interpolated between them.

    Raises
    ------
    InvalidOption
        A parameter is out of its range or of another kind.
    """

    buildings: tuple[MapBuilding, ...] = DEFAULT_BUILDINGS
    mass_ratios: tuple[float, ...] = (0.25, 0.5, 1.0, 1.5)
    response_modification: tuple[float, ...] = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)
    mus: tuple[float, ...] = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.2)
    intensities: tuple[float, ...] = (1.0,)
    design_fraction: float = 0.25
    overstrength: float = DEFAULT_OVERSTRENGTH
    second_slope: float = DEFAULT_SECOND_SLOPE
    third_slope: float = DEFAULT_THIRD_SLOPE
    damping: float = DEFAULT_DAMPING
    scaling_period: float | None = None
    combination: Combination = "srss"
    yield_at_r1: bool = False
    model_damping: ModelDamping = SAME_DAMPING
    confidence: float = 0.90
    resamples: int = 500
    seed: int = 0
    shares: int = 101

    def __post_init__(self) -> None:
        """Judge the axes and keep numbers as Python's own; building, design and scaling judge the rest."""
        owner = "effective mass map"
        buildings = []
        for building in _listed(self.buildings, "buildings"):
            if not isinstance(building, tuple) or len(building) != 3 or building[2] not in get_args(Roof):
                requirement = 'a tuple of (storeys, period, "bare" or "loaded")'
                raise refusal(InvalidOption, "buildings", owner, requirement, f"{brief(building)} in it")
            storeys = as_count(building[0], "storeys", owner, InvalidOption, least=1)
            if storeys == 1 and building[2] == "bare":
                raise refusal(InvalidOption, "roof", owner, "loaded where it is the only floor", "bare")
            buildings.append((storeys, _number(building[1], "period", above=0.0), building[2]))
        checked: dict[str, Any] = {"buildings": tuple(buildings)}
        above, least = {"mass_ratios": 0.0, "intensities": 0.0}, {"response_modification": 1.0, "mus": 0.0}
        for name in (*above, *least):
            values = _listed(getattr(self, name), name)
            checked[name] = tuple(
                _number(value, name, above=above.get(name), least=least.get(name)) for value in values
            )
        for name, values in checked.items():
            if len(set(values)) != len(values):
                raise refusal(InvalidOption, name, owner, "a tuple of values, none twice", brief(values))
        for name in ("design_fraction", "confidence"):
            checked[name] = _number(getattr(self, name), name, least=0.0)
            if checked[name] > 1.0:
                raise refusal(InvalidOption, name, owner, "between 0 and 1", f"{checked[name]:g}")
        if not 0.0 < checked["confidence"] < 1.0:
            raise refusal(InvalidOption, "confidence", owner, "above 0 and below 1", f"{checked['confidence']:g}")
        for name in ("overstrength", "second_slope", "third_slope", "damping"):
            checked[name] = _number(getattr(self, name), name, least=0.0)
        if self.scaling_period is not None:
            checked["scaling_period"] = _number(self.scaling_period, "scaling_period", above=0.0)
        checked["resamples"] = as_count(self.resamples, "resamples", owner, InvalidOption, least=1)
        checked["shares"] = as_count(self.shares, "shares", owner, InvalidOption, least=2)
        checked["seed"] = as_count(self.seed, "seed", owner, InvalidOption)
        check_damping(self.model_damping, owner)
        for name, value in checked.items():
            object.__setattr__(self, name, value)


def _listed(values: Any, name: str) -> tuple[Any, ...]:
    if not isinstance(values, tuple) or not values:
        raise refusal(InvalidOption, name, "effective mass map", "a tuple of at least one value", brief(values))
    return values


def _number(value: Any, name: str, *, above: float | None = None, least: float | None = None) -> float:
    number = as_number(value, name, "effective mass map", InvalidOption)
    if not np.isfinite(number) or (above is not None and number <= above) or (least is not None and number < least):
        requirement = f"above {above:g}" if above is not None else f"at least {least:g}"
        raise refusal(InvalidOption, name, "effective mass map", requirement, f"{number:g}")
    return number


SCHEMA_VERSION: Final = 4
"""Version of the tables and of the metadata of a map; see docs/effective_mass.md."""

MOST_DOUBTS: Final = 3
ETA_EDGES: Final = (0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.2, 1.5, 2.0, np.inf)
"""Edges of the bins of eta for which the scatter of the fraction is tabulated."""


@dataclass(frozen=True, eq=False, repr=False)
class EffectiveMassMap(FieldValue, Result):
    """The effective fraction at every point of a grid.

    Attributes
    ----------
    table : polars.DataFrame
        One row per case: building (from 1), storeys, period, roof, R, alpha, intensity, mu; eta,
        base_shear_coefficient (of the runs); coefficient (C1 of the rule, with S_a of the target) and by_hand, its
        share; `slides` (under any motion); value, kind, low, high (bootstrap interval); real (mean largest drift,
        m); ratio_at_0, ratio_at_0_25, ratio_at_1 (real over model); worst_storey_ratio, worst_storey_ratio_at_1 and
        worst_storey_envelope_ratio, the largest over the storeys of real over model at the value, at 1, and over the
        larger of the models at the value and at 0.
    curve_of : ndarray of int, shape (cases,)
        Row of `curves` of each case.
    curves : ndarray, shape (curves, shares)
        Mean largest drift of the model (m) at the shares of `fractions`; friction does not enter.
    fractions : ndarray, shape (shares,)
        Shares attached.
    scaling : dict of (int, float) to ScalingResult
        Factors of the motions, by the number of the building and alpha.
    metadata : dict
        Versions, parameters, target, motions.
    """

    document: ClassVar[str] = "map"

    table: pl.DataFrame
    curve_of: NDArray[np.int64]
    curves: FloatArray
    fractions: FloatArray
    scaling: dict[tuple[int, float], ScalingResult]
    metadata: dict[str, Any] = field(repr=False)

    def model_drift(self, shares: FloatArray) -> FloatArray:
        """Return the capped mean of the largest drift of the model (m) of each case at its own share, interpolated."""
        place = np.clip(np.searchsorted(self.fractions, shares, side="right") - 1, 0, len(self.fractions) - 2)
        low, high = self.fractions[place], self.fractions[place + 1]
        weight = (shares - low) / (high - low)
        rows = self.curves[self.curve_of]
        case = np.arange(len(rows))
        drift: FloatArray = (1.0 - weight) * rows[case, place] + weight * rows[case, place + 1]
        return drift

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name: map, rules, rules_by_period, by_eta, scaling."""
        scalings = [
            table.table().select(pl.lit(number, pl.UInt32).alias("building"), pl.lit(alpha).alias("alpha"), pl.all())
            for (number, alpha), table in self.scaling.items()
        ]
        return {"map": self.table, **self._named(), "scaling": pl.concat(scalings)}

    def _named(self) -> dict[str, pl.DataFrame]:
        return {"rules": self.rules(), "rules_by_period": self.rules_by_period(), "by_eta": self.by_eta()}

    def to_dict(self) -> dict[str, Any]:
        """Return the metadata with the rules, over all and by period, and the scatter by eta as plain values."""
        return {**self.metadata, **{name: table.to_dicts() for name, table in self._named().items()}}

    def _table_metadata(self) -> dict[str, str]:
        return {f"seismass.{key}": json.dumps(value) for key, value in self.metadata.items()}

    @property
    def figure_names(self) -> tuple[str, ...]:
        """collapse: the fraction of each case against eta, with its scatter, rules and codes; rules: how
        rules do; intensity, where there are several intensities.
        """
        several = self.table["intensity"].n_unique() > 1
        return ("collapse", "rules", "intensity") if several else ("collapse", "rules")

    def rules(self, rules: Mapping[str, Rule] | None = None) -> pl.DataFrame:
        """Return how the models of simple rules compare with the real drift, over all cases in which goods slide.

        Parameters
        ----------
        rules : mapping of str to callable, optional
            Each takes `table` and returns the share of the live load, shape (cases,). By default the rule by hand and
            the fractions of codes.

        Returns
        -------
        polars.DataFrame
            One row per rule: rule; cases; bias, the geometric mean of model over real drift; log_scatter, the standard
            deviation of its logarithm; unsafe, the share of cases in which the real building drifts more than 1.05
            times the model; low, high: 5 and 95 % of model over real; worst, its least value.
        """
        return pl.DataFrame([{"rule": name, **compared(ratio)} for name, ratio, _ in self._ratios(rules)])

    def rules_by_period(self, rules: Mapping[str, Rule] | None = None) -> pl.DataFrame:
        """Return the table of `rules` for each class of the bare building's period, class by class.

        Returns
        -------
        polars.DataFrame
            One row per class and rule: period_from, period_to (s; null: open), and the columns of `rules`.
        """
        rows = [row for name, ratio, period in self._ratios(rules) for row in by_period(name, ratio, period)]
        return pl.DataFrame(rows, schema_overrides={"period_to": pl.Float64}).sort("period_from", maintain_order=True)

    def _ratios(self, rules: Mapping[str, Rule] | None) -> Iterator[tuple[str, FloatArray, FloatArray]]:
        """Yield each rule's name with model over real drift and the period of the cases in which goods slide."""
        slides = self.table["slides"].to_numpy()
        drift, period = self.table["real"].to_numpy()[slides], self.table["period"].to_numpy()[slides]
        for name, rule in (RULES if rules is None else rules).items():
            shares = np.asarray(rule(self.table), dtype=np.float64)
            yield name, self.model_drift(shares)[slides] / drift, period

    def by_eta(self) -> pl.DataFrame:
        """Return the scatter of the fraction in bins of eta, over all cases in which goods slide.

        Returns
        -------
        polars.DataFrame
            One row per bin: eta_from, eta_to (null: open), cases, p16, median, p84 of the fraction.
        """
        sliding = self.table.filter(pl.col("slides"))
        eta, value = sliding["eta"].to_numpy(), sliding["value"].to_numpy()
        rows = []
        for low, high in pairwise(ETA_EDGES):
            inside = value[(low <= eta) & (eta < high)]
            if len(inside):
                quantiles = {name: float(quantile(inside, share)) for name, share in QUANTILES.items()}
                upper = None if np.isinf(high) else high
                rows.append({"eta_from": low, "eta_to": upper, "cases": len(inside), **quantiles})
        return pl.DataFrame(rows, schema_overrides={"eta_to": pl.Float64})


@dataclass(frozen=True, slots=True)
class _Loaded:
    """One building with one load and one strength: its scenes differ in friction alone. `acceleration` is S_a of the
    target (g) at intensity 1 and the period without goods.
    """

    labels: dict[str, Any]
    scenes: list[Scene]
    acceleration: float
    scaling: ScalingResult


def effective_mass_map(
    suite: Suite,
    target: TargetSpectrum,
    parameters: EffectiveMassParameters | None = None,
    *,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> EffectiveMassMap:
    """Return the effective fraction of live load over a grid of buildings, loads, strengths, friction and intensity.

    Parameters
    ----------
    suite : Suite
        Motions, unscaled; they are scaled to the target by `scale_asce7_10`, for each building with each load.
    target : TargetSpectrum
        Design spectrum.
    parameters : EffectiveMassParameters, optional
        The grid; default 16 buildings x 4 loads x 7 strengths x 11 friction coefficients.
    threads : int, optional
        Number of threads; default all cores. The map does not depend on it.
    progress : callable, optional
        Called with (runs done, runs in all).

    Raises
    ------
    InvalidOption, InvalidMotion, InvalidScene
        A parameter is out of its range, or the suite cannot be scaled.
    KeyboardInterrupt
        Ctrl-C was pressed.

    Notes
    -----
    Definition as for `effective_mass`, with crossings by linear interpolation between shares, 0.01 apart by default, in
    place of refined roots. Runs of models do not depend on friction and are shared.
    """
    options = EffectiveMassParameters() if parameters is None else parameters
    if not isinstance(suite, Suite):
        raise refusal(InvalidMotion, "suite", "effective mass map", "a Suite of records", brief(suite))
    designs = [
        list(_designs(options, number, alpha, suite, target, threads))
        for number in range(1, len(options.buildings) + 1)
        for alpha in options.mass_ratios
    ]
    fractions = np.linspace(0.0, 1.0, options.shares)
    total = len(options.intensities) * sum(map(len, designs)) * (len(fractions) + len(options.mus)) * len(suite)
    stages, rows = Progress(progress, total, "effective mass map"), list[dict[str, Any]]()
    curves: list[FloatArray] = []
    curve_of: list[int] = []
    for intensity in options.intensities:
        for loads in designs:
            motions = named_motions(scaled_motions(suite, intensity * loads[0].scaling.factors), "effective mass map")
            models = [attached(load.scenes[0], share, options.model_damping) for load in loads for share in fractions]
            model = solve(models, motions, threads=threads, progress=stages.part(len(models) * len(motions)))
            scenes = [scene for load in loads for scene in load.scenes]
            all_sliding = solve(scenes, motions, threads=threads, progress=stages.part(len(scenes) * len(motions)))
            for number, load in enumerate(loads):
                model_part = model.part(number * len(fractions), len(fractions))
                sliding = all_sliding.part(number * len(options.mus), len(options.mus))
                rows += _cases(load, {"intensity": intensity}, model_part, sliding, motions, options)
                curve_of += [len(curves)] * len(options.mus)
                curves.append(over_records(model_part.largest, "mean"))
    scaling = {(loads[0].labels["building"], loads[0].labels["alpha"]): loads[0].scaling for loads in designs}
    return EffectiveMassMap(
        table=pl.DataFrame(rows, schema_overrides={"building": pl.UInt32, "storeys": pl.UInt32}),
        curve_of=np.array(curve_of, dtype=np.int64),
        curves=np.array(curves),
        fractions=fractions,
        scaling=scaling,
        metadata={
            **metadata_head(SCHEMA_VERSION),
            "parameters": asdict(options),
            "target": {"label": target.label, **target.parameters},
            "suite": {"name": suite.name, "motions": motion_names(suite)},
            "runs": total,
            "remarks": [*target_remarks(target), *_remarks(scaling, suite)],
        },
    )


def _remarks(scaling: dict[tuple[int, float], ScalingResult], suite: Suite) -> list[str]:
    """Doubts about factors, the first few, and about motions at their largest factors."""
    doubts = [(*key, doubt) for key, result in scaling.items() for doubt in result.doubts]
    remarks = [f"building {number}, alpha = {alpha:g}: {doubt}" for number, alpha, doubt in doubts]
    more = [f"and {len(remarks) - MOST_DOUBTS} more doubts about factors"] * (len(remarks) > MOST_DOUBTS)
    largest = np.max([result.factors for result in scaling.values()], axis=0)
    return [*remarks[:MOST_DOUBTS], *more, *motion_remarks(scaled_motions(suite, largest))]


def _designs(
    parameters: EffectiveMassParameters,
    number: int,
    alpha: float,
    suite: Suite,
    target: TargetSpectrum,
    threads: int | None,
) -> Iterator[_Loaded]:
    """Yield building `number`, counted from 1, with one load and every strength."""
    storeys, period, roof = parameters.buildings[number - 1]
    slopes = {name: getattr(parameters, name) for name in ("overstrength", "second_slope", "third_slope")}
    bare = Building.uniform(storeys, period, mass=1.0, damping=parameters.damping, **slopes)
    ratios = np.full(storeys, alpha)
    if roof == "bare":
        ratios[-1] = 0.0
    attached_period = float(vibration_modes(bare.mass + ratios, bare.stiffness).periods[0])
    scaling_period = parameters.scaling_period or attached_period
    scaling = scale_asce7_10(suite, target, scaling_period, damping=parameters.damping, between=False, threads=threads)

    def spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(suite, scaling.factors, periods, parameters.damping, threads=threads)

    how: dict[str, Any] = {"combination": parameters.combination, "damping": parameters.damping}
    mass = bare.mass + parameters.design_fraction * ratios
    analysis = response_spectrum_analysis(mass, bare.stiffness, spectrum, **how)
    columns = {"building": number, "storeys": storeys, "period": period, "roof": roof}
    acceleration = float(np.asarray(target([period]))[0]) / STANDARD_GRAVITY
    for reduction in parameters.response_modification:
        elastic = reduction == 1.0 and not parameters.yield_at_r1
        strength = np.full(storeys, np.inf) if elastic else analysis.storey_shear / reduction
        scenes = [Scene(bare.replace(yield_shear=strength), blocks_on_floors(ratios, mu)) for mu in parameters.mus]
        yield _Loaded(
            {**columns, "R": reduction, "alpha": alpha},
            scenes,
            acceleration,
            scaling,
        )


def _cases(
    load: _Loaded,
    more: dict[str, Any],
    model: Peaks,
    sliding: Peaks,
    motions: NamedMotions,
    options: EffectiveMassParameters,
) -> list[dict[str, Any]]:
    """One row per friction coefficient."""
    shares, mus = np.linspace(0.0, 1.0, options.shares), np.array(options.mus)
    model_drift, sliding_drift = over_records(model.largest, "mean"), over_records(sliding.largest, "mean")
    curves = np.broadcast_to(model_drift, (len(mus), len(shares)))
    slides: NDArray[np.bool_] = np.asarray(sliding.slides.any(axis=1))
    values = np.where(slides, interpolated(shares, curves, np.repeat(sliding_drift[:, None], len(shares), axis=1)), 1.0)
    values[mus == 0.0] = 0.0
    low, high = _intervals(model, sliding, slides, motions, options)
    weight, building = full_weight(load.scenes[0]), building_of(load.scenes[0])
    coefficient = float(model.base_shear[-1].mean()) / weight
    of_rule = float(floor_coefficient(load.acceleration * more["intensity"], building.yield_shear[0] / weight))
    offset = SMALL_OFFSET if exceptions(building, load.labels["alpha"]) else OFFSET
    by_hand = share_by_hand(mus, of_rule, offset)
    storeys_model, storeys_sliding = (
        over_records(np.moveaxis(peaks.capped, 1, -1), "mean") for peaks in (model, sliding)
    )
    rows = []
    for case, mu in enumerate(options.mus):
        below = is_below(model_drift, np.full_like(model_drift, sliding_drift[case]))
        kind: Kind = "stuck" if not slides[case] else "zero" if mu == 0.0 else kind_of(below)
        at_value = np.array([np.interp(values[case], shares, drifts) for drifts in storeys_model.T])
        sliding_drifts = storeys_sliding[case]
        rows.append(
            {
                **load.labels,
                **more,
                "mu": mu,
                "eta": mu / coefficient,
                "base_shear_coefficient": coefficient,
                "coefficient": of_rule,
                "by_hand": float(by_hand[case]),
                "slides": bool(slides[case]),
                "value": float(values[case]),
                "kind": kind,
                "low": None if low is None else float(low[case]),
                "high": None if high is None else float(high[case]),
                "real": float(sliding_drift[case]),
                "ratio_at_0": float(sliding_drift[case] / model_drift[0]),
                "ratio_at_0_25": float(sliding_drift[case] / np.interp(0.25, shares, model_drift)),
                "ratio_at_1": float(sliding_drift[case] / model_drift[-1]),
                "worst_storey_ratio": float((sliding_drifts / at_value).max()),
                "worst_storey_ratio_at_1": float((sliding_drifts / storeys_model[-1]).max()),
                "worst_storey_envelope_ratio": float((sliding_drifts / np.maximum(at_value, storeys_model[0])).max()),
            }
        )
    return rows


def _intervals(
    model: Peaks, sliding: Peaks, slides: NDArray[np.bool_], motions: NamedMotions, options: EffectiveMassParameters
) -> tuple[FloatArray | None, FloatArray | None]:
    """Bootstrap interval of each friction coefficient; the resampled models are shared."""
    if motions.clusters < 2:
        return None, None
    how: dict[str, Any] = {"cluster_of": motions.cluster_of, "resamples": options.resamples, "seed": options.seed}
    how |= {"confidence": options.confidence}
    fractions, ends = np.linspace(0.0, 1.0, options.shares), np.ones((2, sliding.scenes))
    for case in np.flatnonzero(slides):
        ends[:, case] = equal_share(fractions, model.largest, sliding.largest[case], **how).interval
    ends[:, np.array(options.mus) == 0.0] = 0.0
    return ends[0], ends[1]
