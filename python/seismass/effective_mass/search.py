"""From drifts at shares on a grid to the effective fraction: kind, refined roots, interval, and the tables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from seismass.base.arguments import ProgressLike, as_bootstrap, as_progress, as_threads
from seismass.base.statistics import (
    DRIFT_CAP,
    Statistic,
    bootstrap_counts,
    check_statistic,
    few_collapses,
    interval_of,
    over_records,
    weighted,
)
from seismass.base.stored_results import metadata_head, motion_contents
from seismass.base.values import FloatArray
from seismass.effective_mass.models import (
    FROM_ONE,
    LARGEST_SHARE,
    SHARES_BEYOND,
    ModelDamping,
    attached,
    building_of,
    check_cap,
    check_damping,
    check_fractions,
    friction,
    full_weight,
    goes_beyond,
    joined,
)
from seismass.effective_mass.result import (
    SCHEMA_VERSION,
    EffectiveMass,
    curve_table,
    record_table,
    remarks_of,
    storey_drifts,
)
from seismass.effective_mass.rule import by_hand, remarks_of_structure
from seismass.effective_mass.share import (
    Kind,
    crossings,
    extended,
    first_bracket,
    interpolated,
    is_below,
    kind_of,
    refined_root,
)
from seismass.model.plausibility import usage_remarks
from seismass.model.scene import Scene
from seismass.model.springs import SHAPE_FIELDS
from seismass.motions.scaling.suite import as_target
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.peaks import LARGER, DriftMeasure, NamedMotions, Peaks, check_drift, solve

OWNER: Final = "effective mass"
"""What error messages call it."""


@dataclass(frozen=True, slots=True)
class Options:
    """How a fraction is sought, checked once."""

    statistic: Statistic
    drift: DriftMeasure
    drift_cap: float
    damping: ModelDamping
    fractions: FloatArray
    confidence: float
    resamples: int
    seed: int
    threads: int | None
    progress: ProgressLike
    target: TargetSpectrum | None = None


def checked_options(
    statistic: Any,
    damping: Any,
    fractions: Any,
    confidence: Any,
    resamples: Any,
    seed: Any,
    threads: Any,
    progress: Any,
    drift: Any = LARGER,
    drift_cap: Any = DRIFT_CAP,
    target: Any = None,
) -> Options:
    """Return the arguments of `effective_mass`; one that is not what it must be is refused."""
    probability, draws, start = as_bootstrap(confidence, resamples, seed, OWNER)
    return Options(
        statistic=check_statistic(statistic, OWNER),
        drift=check_drift(drift, OWNER),
        drift_cap=check_cap(drift_cap, OWNER),
        damping=check_damping(damping, OWNER),
        fractions=check_fractions(fractions, OWNER),
        confidence=probability,
        resamples=draws,
        seed=start,
        threads=as_threads(threads, OWNER),
        progress=as_progress(progress, OWNER),
        target=None if target is None else as_target(target, OWNER),
    )


@dataclass(frozen=True, slots=True)
class Search:
    """What leads from drifts at the shares of a grid to the answer. `at` gives the peaks of real building and model at
    a share, `scene_at` the scene with sliding goods; `beyond` is None where no share above 1 is sought.
    """

    motions: NamedMotions
    options: Options
    peaks_at: Callable[[float], tuple[Peaks, Peaks]]
    scene_at: Callable[[float], Scene]
    above_one: Peaks | None = None

    def answer(self, sliding: Peaks, model: Peaks, details: dict[str, Any]) -> EffectiveMass:
        """Return the effective fraction; `real` has one scene, or one per share."""
        options, shares = self.options, self.options.fractions
        kind = self._kind(sliding, model)
        brackets = [] if kind in ("collapsed", "stuck") else crossings(shares, *self._statistics(model, sliding))
        larger = self._larger_bracket(sliding, model) if kind == "one" else None
        if larger is not None:
            kind = "beyond"
            brackets.append(larger)
        difference = _Difference(self, sliding, model)
        roots = [refined_root(difference, bracket) for bracket in brackets]
        value = {"collapsed": float("nan"), "zero": 0.0}.get(kind, 1.0)
        if kind in ("root", "multiple", "beyond"):
            value = roots[-1]
        place = 1.0 if np.isnan(value) else value
        sliding_at_value, model_at_value = self._peaks_at(place, sliding, model)
        scene = self.scene_at(place)
        full = self._fully_attached(scene, sliding, model)
        coefficient = float(full.base_shear.mean()) / full_weight(scene)
        sliding_drift, model_drift = (
            float(over_records(peaks.largest[0], options.statistic)) for peaks in (sliding_at_value, model_at_value)
        )
        with np.errstate(invalid="ignore"):
            excess = float(np.float64(sliding_drift) / model_drift - 1.0)
        storeys = storey_drifts(sliding_at_value, model_at_value, model, options.statistic)
        collapses = {
            "real": int(sliding_at_value.collapsed.sum()),
            "model": int(model_at_value.collapsed.sum()),
            "model_at_0": int(model.collapsed[0].sum()),
            "model_at_1": int(model.collapsed[-1].sum()),
        }
        interval, band = self._scatter(kind, sliding, model)
        without = None
        if kind != "collapsed" and len(self.motions) > 1:
            without = self._shares(kind, *self._weighted(sliding, model, 1.0 - np.eye(len(self.motions))))
        return EffectiveMass(
            value=value,
            kind=kind,
            roots=tuple(roots),
            interval=interval,
            confidence=options.confidence,
            statistic=options.statistic,
            real=sliding_drift,
            model=model_drift,
            unit="m" if building_of(scene).heights is None else "ratio",
            excess=excess,
            eta=friction(scene) / coefficient,
            base_shear_coefficient=coefficient,
            by_hand=by_hand(scene, self.motions, options.target, options.drift),
            curve=curve_table(*self._with_larger(model), sliding, band, options.statistic),
            storeys=storeys,
            records=record_table(self.motions, shares, sliding, model, without),
            collapses=collapses,
            remarks=(
                *usage_remarks(scene.remarks, self.motions.components),
                *remarks_of(kind, roots, value, excess, interval, storeys, collapses, len(self.motions)),
                *remarks_of_structure(scene),
            ),
            metadata=self._metadata(scene, details, difference.evaluations)
            | {"share_at_drift_cap": self._at_other_caps(kind, sliding, model)},
        )

    def _statistics(self, model: Peaks, sliding: Peaks) -> tuple[FloatArray, FloatArray]:
        """Statistic of the largest drift of the model and of the real building at every share."""
        model_drift, sliding_drift = (over_records(peaks.largest, self.options.statistic) for peaks in (model, sliding))
        return model_drift, np.broadcast_to(sliding_drift, model_drift.shape)

    def _with_larger(self, model: Peaks) -> tuple[FloatArray, Peaks]:
        """All shares at which models were solved, and their peaks."""
        if self.above_one is None:
            return self.options.fractions, model
        return np.concatenate([self.options.fractions, SHARES_BEYOND]), joined(model, self.above_one)

    def _larger_bracket(self, sliding: Peaks, model: Peaks) -> tuple[float, float] | None:
        """Shares from 1 on between which the model first reaches the real drift."""
        if self.above_one is None:
            return None
        drift, sliding_drift = self._statistics(joined(model.one(-1), self.above_one), sliding)
        return first_bracket(FROM_ONE, drift, float(sliding_drift[0]))

    def _kind(self, sliding: Peaks, model: Peaks) -> Kind:
        model_drift, sliding_drift = self._statistics(model, sliding)
        if not few_collapses(int(sliding.collapsed.sum(axis=1).max()), len(self.motions), self.options.statistic):
            return "collapsed"
        # Goods that do not slide on a rack that sways are not attached to the floor.
        if not sliding.slides[-1].any() and not self._on_racks():
            return "stuck"
        if without_friction(self.scene_at(1.0)):  # the real building is the bare one, whatever the curve does
            return "zero"
        return kind_of(is_below(model_drift, sliding_drift))

    def _on_racks(self) -> bool:
        return any(rack.floor > 0 for rack in self.scene_at(1.0).racks)

    def _peaks_at(self, share: float, sliding: Peaks, model: Peaks) -> tuple[Peaks, Peaks]:
        """Peaks of the real building and of the model at a share, from the grid where it is one of its shares."""
        on_grid = np.flatnonzero(self.options.fractions == share)
        if not len(on_grid):
            return self.peaks_at(share)
        index = int(on_grid[0])
        return sliding.one(index if sliding.scenes > 1 else 0), model.one(index)

    def _fully_attached(self, scene: Scene, sliding: Peaks, model: Peaks) -> Peaks:
        """Peaks of the building of `scene` with all goods attached."""
        if sliding.scenes > 1:  # the strength depends on the share
            options = self.options
            full = attached(scene, 1.0, options.damping)
            how: dict[str, Any] = {"drift": options.drift, "drift_cap": options.drift_cap, "threads": options.threads}
            return solve([full], self.motions, **how)
        return model.one(-1)

    def _scatter(
        self, kind: Kind, sliding: Peaks, model: Peaks
    ) -> tuple[tuple[float, float] | None, FloatArray | None]:
        """Bootstrap interval of the fraction, and of real over model drift at every share, shape (2, shares)."""
        options = self.options
        if kind == "collapsed" or self.motions.clusters < 2:
            return None, None
        counts = bootstrap_counts(self.motions.cluster_of, options.resamples, options.seed)
        model_drift, sliding_drift = self._weighted(sliding, model, counts)
        low, high = interval_of(self._shares(kind, model_drift, sliding_drift), options.confidence)
        return (float(low), float(high)), np.array(interval_of(sliding_drift / model_drift, options.confidence))

    def _shares(self, kind: Kind, model: FloatArray, sliding: FloatArray) -> FloatArray:
        """Effective fraction of each row of drifts of model and real building, by interpolation on the grid."""
        if kind == "stuck" or without_friction(self.scene_at(1.0)):
            return np.full(len(model), 1.0 if kind == "stuck" else 0.0)
        count = len(self.options.fractions)
        values = interpolated(self.options.fractions, model[:, :count], sliding[:, :count])
        if self.above_one is None:
            return values
        return extended(values, FROM_ONE, model[:, count - 1 :], sliding[:, 0])

    def _weighted(self, sliding: Peaks, model: Peaks, weights: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Statistic of model and sliding drifts at every share under each row of whole weights of the motions."""
        both = (peaks.largest for peaks in (self._with_larger(model)[1], sliding))
        model_drift, sliding_drift = (weighted(values, weights, self.options.statistic) for values in both)
        return model_drift, np.broadcast_to(sliding_drift, model_drift.shape)

    def _at_other_caps(self, kind: Kind, sliding: Peaks, model: Peaks) -> dict[str, float]:
        """Effective fraction at half and twice the drift cap, by interpolation on the grid."""
        by_cap, once = {}, np.ones((1, len(self.motions)))
        for times in (0.5, 2.0):
            cap = times * sliding.cap
            search = replace(self, above_one=None if self.above_one is None else replace(self.above_one, cap=cap))
            drifts = search._weighted(replace(sliding, cap=cap), replace(model, cap=cap), once)
            by_cap[f"{times * self.options.drift_cap:g}"] = float(self._shares(kind, *drifts)[0])
        return by_cap

    def _metadata(self, scene: Scene, details: dict[str, Any], evaluations: int) -> dict[str, Any]:
        options, building = self.options, building_of(scene)
        settings = {
            **details,
            "statistic": options.statistic,
            "drift_cap": options.drift_cap,
            **({} if self.motions.others is None else {"drift": options.drift}),
            "damping": options.damping,
            "shares": options.fractions.tolist(),
            "confidence": options.confidence,
            "resamples": options.resamples,
            "seed": options.seed,
        }
        return {
            **metadata_head(SCHEMA_VERSION, scene, motion_contents(self.motions.components), settings),
            **settings,
            **{name: values.tolist() for name, values in building.springs_in_use().items() if name in SHAPE_FIELDS},
            "p_delta": bool(scene.geometric_stiffness.any()),
            "motions": len(self.motions),
            "clusters": self.motions.clusters,
            "shares_beside_the_grid": evaluations,
            **({} if self.above_one is None else {"largest_share": LARGEST_SHARE}),
        }


def without_friction(scene: Scene) -> bool:
    """Whether no goods on the floors are held by friction or stops; goods with mu_s alone stick until they slide."""
    if goes_beyond(scene):
        return False
    coefficients = ((block.mu_s, *(mu_s for _, mu_s, _ in block.wear)) for block in scene.blocks if block.floor > 0)
    return not any(any(each) for each in coefficients)


class _Difference:
    """(model - real) / real at a share, solved exactly; shares of the grid are known already."""

    def __init__(self, search: Search, sliding: Peaks, model: Peaks) -> None:
        self._search = search
        self._known: dict[float, float] = {}
        model_drift, sliding_drift = search._statistics(model, sliding)
        if np.isfinite(sliding_drift).all() and (sliding_drift > 0.0).all():
            differences = (model_drift - sliding_drift) / sliding_drift
            self._known = dict(zip(search.options.fractions.tolist(), differences.tolist(), strict=True))
        self._on_grid = len(self._known)

    @property
    def evaluations(self) -> int:
        """Number of shares that were solved beside those of the grid."""
        return len(self._known) - self._on_grid

    def __call__(self, share: float) -> float:
        if share not in self._known:
            statistic, both = self._search.options.statistic, self._search.peaks_at(share)
            sliding, model = (float(over_records(peaks.largest[0], statistic)) for peaks in both)
            self._known[share] = (model - sliding) / sliding
        return self._known[share]
