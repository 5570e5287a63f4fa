"""From capacities at the shares of a grid to the risk-targeted share: kind and refined roots."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, refusal
from seismass.effective_mass.curve import Kind, refined_root
from seismass.effective_mass.models import ModelDamping, attached
from seismass.effective_mass.search import without_friction
from seismass.fragility.exact_capacities import HIGHEST, exact_capacities
from seismass.fragility.limits import LimitState
from seismass.fragility.run import Setting, solve_runs
from seismass.model.scene import Scene
from seismass.risk.hazard import HazardCurve
from seismass.risk.rates import Estimator, RateCurve, rate_parts

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
        count = self.setting.motions.clusters
        equal = np.full(count, 1.0 / count)
        draws = np.random.default_rng(self.options.seed).multinomial(count, equal, size=self.options.resamples)
        return draws[:, self.setting.motions.cluster_of].astype(np.float64)

    @cached_property
    def rates(self) -> RateCurve:
        """Rates by share."""
        return self.rates_of(self.capacities)

    def rates_of(
        self, capacities: FloatArray, hazard: HazardCurve | None = None, estimator: Estimator | None = None
    ) -> RateCurve:
        """Return rates by share for capacities, and where given for another hazard curve or estimator."""
        return RateCurve.of(
            self.grid,
            capacities[0],
            capacities[1:],
            hazard or self.hazard,
            estimator or self.options.estimator,
            self.options.extrapolate,
            self.weights,
        )

    def found(self) -> FoundShare:
        """Return the share, its roots refined on the exact models; every motion must bring each model to the limit."""
        missing = int((~np.isfinite(self.capacities)).sum(axis=1).max())
        if missing:
            requirement = f"reached by all models under all motions, below {HIGHEST:g} times the elastic intensity"
            raise refusal(InvalidOption, "limit", OWNER, requirement, f"{missing} motions that do not reach it")
        if not self.rates.real > 0.0:
            requirement = "exceeded within the hazard curve"
            raise refusal(InvalidOption, "limit", OWNER, requirement, f"a rate of {self.rates.real:g} a year")
        if without_friction(self.scene):  # the real building is the bare one, whatever the curve does
            return FoundShare(0.0, "zero", (), True)
        if not self._slides():
            return FoundShare(1.0, "stuck", (), True)
        ratios: list[float] = (self.rates.model / self.rates.real - 1.0).tolist()
        known: dict[float, float] = dict(zip(self.grid.tolist(), ratios, strict=True))

        def difference(share: float) -> float:
            if share not in known:
                known[share] = self.rate_at(share) / self.rates.real - 1.0
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
        at = self.capacities[0]
        table = solve_runs(self.setting, np.zeros_like(motion), motion, at, threads=self.options.threads)
        return bool(np.any(table["slip"].to_numpy() > 0.0))
