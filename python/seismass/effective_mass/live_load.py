"""The share of the design live load to attach where occupancy and friction are random.

A model with a share phi of the design live load attached does not depend on what is really there, so that its drifts
are solved once; the real building is solved for every sample of occupancy and friction.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from numbers import Real
from typing import Any, ClassVar, Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import Progress, ProgressLike
from seismass.base.distributions import Distribution
from seismass.base.errors import InvalidOption
from seismass.base.statistics import DRIFT_CAP, few_collapses, over_records, quantile
from seismass.base.stored_results import metadata_head
from seismass.base.values import FieldValue, FloatArray, as_count, as_number, brief, refusal
from seismass.effective_mass.models import (
    SAME_DAMPING,
    ModelDamping,
    attached,
    check_cap,
    check_damping,
    check_fractions,
    check_loaded,
)
from seismass.effective_mass.share import equal_share, interpolated
from seismass.media.result import Result, finite_values
from seismass.model.plausibility import usage_remarks
from seismass.model.scene import Scene
from seismass.motions.motion import MotionLike
from seismass.runs.peaks import NamedMotions, Peaks, named_motions, solve

SCHEMA_VERSION: Final = 1
"""Version of the tables and of the JSON of an uncertainty."""
LEVELS: Final = (0.05, 0.16, 0.50, 0.84, 0.95)
"""Probabilities at which the share is tabulated."""
TORNADO_LEVELS: Final = (0.05, 0.95)
"""Probabilities to which one variable at a time is moved, the others at their medians."""
SHARES: Final = np.linspace(0.0, 1.0, 101)
"""Shares of the models; those of the samples are linear between them, and not refined."""
RESAMPLES: Final = 2000
"""Bootstrap resamples over the records."""


@dataclass(frozen=True, eq=False, repr=False)
class LiveLoadUncertainty(FieldValue, Result):
    """The share phi of the design live load to attach as mass, with what is known of occupancy and friction.

    Attributes
    ----------
    share : float
        The share whose model has the expected largest drift of the real building, over samples and motions: the
        value to report.
    interval : tuple of float or None
        90 % bootstrap interval of `share` over the records; None with one earthquake alone.
    share_84 : float
        Share that is enough in 84 % of the samples.
    quantiles : polars.DataFrame
        probability, share.
    tornado : polars.DataFrame
        One row per variable: variable, low, high (values at 5 and 95 %), share_low, share_median, share_high, span.
    samples : polars.DataFrame
        One row per sample: sample (from 1), mu, occupancy, real_drift, slides (share of the motions under which goods
        slide), share.
    curve : polars.DataFrame
        fraction, model_drift: capped mean of the largest drift of the model by share of the design live load.
    unit : {"m", "ratio"}
        Unit of drifts.
    remarks : tuple of str
        Assumptions, and what a user must know beside the numbers.
    metadata : dict
        Versions, seed, conventions, counts.
    """

    document: ClassVar[str] = "live_load"

    share: float
    interval: tuple[float, float] | None
    share_84: float
    quantiles: pl.DataFrame = field(repr=False)
    tornado: pl.DataFrame = field(repr=False)
    samples: pl.DataFrame = field(repr=False)
    curve: pl.DataFrame = field(repr=False)
    unit: str
    remarks: tuple[str, ...] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)

    def exceedance(self, fraction: float) -> float:
        """Return the probability that the share to attach is above a code's fraction of the design live load."""
        limit = as_number(fraction, "fraction", "exceedance", InvalidOption)
        return float(np.mean(self.samples["share"].to_numpy() > limit))

    @property
    def text(self) -> str:
        """The answer in a few lines."""
        low_high = "" if self.interval is None else f" (90 % interval {self.interval[0]:.2f} to {self.interval[1]:.2f})"
        levels = ", ".join(f"{100 * row[0]:g} % {row[1]:.2f}" for row in self.quantiles.iter_rows())
        value = f"{self.share:.3f}{low_high}: equal expected drift"
        if not math.isfinite(self.share):
            value = "no value: the building collapses in more than a tenth of all runs"
        lines = [
            f"share of the design live load   {value}",
            f"enough in 84 % of samples       {self.share_84:.3f}",
            f"quantiles                       {levels}",
            f"above 0.25 (ASCE 7 storage)     in {100.0 * self.exceedance(0.25):.0f} % of samples",
        ]
        for row in self.tornado.iter_rows(named=True):
            lines.append(
                f"{row['variable']:<32}{row['low']:.3g} to {row['high']:.3g}: share {row['share_low']:.2f} to "
                f"{row['share_high']:.2f}"
            )
        return "\n".join([*lines, *(f"remark                          {remark}" for remark in self.remarks)])

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name."""
        return {"quantiles": self.quantiles, "tornado": self.tornado, "samples": self.samples, "curve": self.curve}

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the samples and the curve as plain values; null for non-finite values."""
        names = ("share", "interval", "share_84", "unit", "remarks", "metadata")
        document = {"schema_version": SCHEMA_VERSION, **{name: getattr(self, name) for name in names}}
        document |= {"quantiles": self.quantiles.to_dicts(), "tornado": self.tornado.to_dicts()}
        return finite_values(document)

    @property
    def figure_names(self) -> tuple[str, ...]:
        """live_load: the distribution of the share, with the tornado below it."""
        return ("live_load",)


def live_load_uncertainty(
    scene: Scene,
    motions: MotionLike | Iterable[MotionLike],
    *,
    mu: Distribution | float,
    occupancy: Distribution | float,
    samples: int = 200,
    seed: int = 0,
    drift_cap: float = DRIFT_CAP,
    damping: ModelDamping = SAME_DAMPING,
    fractions: ArrayLike | None = None,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> LiveLoadUncertainty:
    """Return the share of the design live load to attach where occupancy and friction are random.

    Parameters
    ----------
    scene : Scene
        The building with the whole design live load as blocks.
    motions : Motion, Record or iterable of them
        The suite, scaled as it is to act.
    mu : frozen distribution of scipy.stats, or float
        Static friction coefficient of all goods; each block keeps its ratio of kinetic to static.
    occupancy : frozen distribution of scipy.stats, or float
        Share of the design live load that is present, from 0 to 1, the same on every floor.
    samples : int, default 200
        Latin hypercube samples; mu and occupancy are independent.
    seed : int, default 0
        Seed of the samples and of the bootstrap.
    drift_cap, damping, fractions, threads, progress
        As for `effective_mass`.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError, KeyboardInterrupt
        As for `effective_mass`; or a sample of a distribution is out of range.

    Notes
    -----
    The model has phi of the mass of the design live load, and its whole weight in P-Delta; the real building has the
    mass and the weight of the goods present.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.4))
    >>> suite = [record.scaled(2.0) for record in sm.builtin_suite()]
    >>> mu, occupancy = sm.distributions.lognormal(0.4, 0.25), sm.distributions.beta(0.7, 0.15)
    >>> found = sm.live_load_uncertainty(scene, suite, mu=mu, occupancy=occupancy, samples=20)
    >>> 0.0 <= found.share <= found.share_84 <= 1.0
    True
    """
    owner = "live load uncertainty"
    checked = check_loaded(scene, owner)
    named = named_motions(motions, owner)
    shares = SHARES if fractions is None else check_fractions(fractions, owner)
    convention = check_damping(damping, owner)
    count = as_count(samples, "samples", owner, InvalidOption, least=2)
    start = as_count(seed, "seed", owner, InvalidOption)
    levels = _latin_hypercube(count, 2, start)
    one_at_a_time = np.full((1 + 2 * len(TORNADO_LEVELS), 2), 0.5)
    one_at_a_time[1:3, 0] = one_at_a_time[3:5, 1] = TORNADO_LEVELS
    both = np.concatenate([levels, one_at_a_time])
    frictions = _sampled(mu, both[:, 0], "mu", np.inf)
    present = _sampled(occupancy, both[:, 1], "occupancy", 1.0)
    stages = Progress(progress, (len(shares) + len(both)) * len(named), owner)
    models = [attached(checked, share, convention) for share in shares]
    how: dict[str, Any] = {"drift_cap": check_cap(drift_cap, owner), "threads": threads}
    model = solve(models, named, **how, progress=stages.part(len(models) * len(named)))
    scenes = [_with_goods(checked, friction, share) for friction, share in zip(frictions, present, strict=True)]
    sliding = solve(scenes, named, **how, progress=stages.part(len(scenes) * len(named)))
    model_drift, sliding_drift = over_records(model.largest, "mean"), over_records(sliding.largest, "mean")
    shares_of_runs = interpolated(
        shares,
        np.broadcast_to(model_drift, (len(both), len(shares))),
        np.repeat(sliding_drift[:, None], len(shares), 1),
    )
    sampled = sliding.part(0, count)
    share, interval = _equal_expected(shares, model, sampled, named, start)
    values = shares_of_runs[:count]
    heights = None if checked.building is None else checked.building.heights
    return LiveLoadUncertainty(
        share=share,
        interval=interval,
        share_84=float(quantile(values, 0.84)),
        quantiles=pl.DataFrame({"probability": LEVELS, "share": [float(quantile(values, level)) for level in LEVELS]}),
        tornado=_tornado(frictions[count:], present[count:], shares_of_runs[count:]),
        samples=pl.DataFrame(
            {
                "sample": np.arange(1, count + 1, dtype=np.uint32),
                "mu": frictions[:count],
                "occupancy": present[:count],
                "real_drift": sliding_drift[:count],
                "slides": sampled.slides.mean(axis=1),
                "share": values,
            }
        ),
        curve=pl.DataFrame({"fraction": shares, "model_drift": model_drift}),
        unit="m" if heights is None else "ratio",
        remarks=_remarks(checked, named, sampled, values, model_drift),
        metadata={
            **metadata_head(SCHEMA_VERSION),
            "samples": count,
            "seed": start,
            "damping": convention,
            "drift_cap": how["drift_cap"],
            "motions": len(named),
            "mu": _described(mu),
            "occupancy": _described(occupancy),
        },
    )


def _latin_hypercube(count: int, dimensions: int, seed: int) -> FloatArray:
    """Probabilities, one in each of `count` equal ranges of every dimension, shape (count, dimensions)."""
    generator = np.random.default_rng(seed)
    ranks = np.stack([generator.permutation(count) for _ in range(dimensions)], axis=1)
    levels: FloatArray = (ranks + generator.random((count, dimensions))) / count
    return levels


def _sampled(distribution: Any, levels: FloatArray, name: str, most: float) -> FloatArray:
    owner = "live load uncertainty"
    if isinstance(distribution, Distribution):
        values = np.asarray(distribution.ppf(levels), dtype=np.float64)
    elif isinstance(distribution, Real) and not isinstance(distribution, bool):
        values = np.full(len(levels), as_number(distribution, name, owner, InvalidOption))
    else:
        requirement = "a frozen distribution of scipy.stats, or a number"
        raise refusal(InvalidOption, name, owner, requirement, brief(distribution))
    wrong = ~((values >= 0.0) & (values <= most) & np.isfinite(values))
    if wrong.any():
        requirement = "zero or positive" if np.isinf(most) else f"from 0 to {most:g}"
        raise refusal(InvalidOption, name, owner, f"a distribution of values {requirement}", f"{values[wrong][0]:g}")
    return values


def _with_goods(scene: Scene, friction: float, present: float) -> Scene:
    """The scene with a share of its goods and another friction coefficient; goods on the ground are left out."""
    blocks = []
    for block, mass in zip(scene.blocks, scene.block_mass, strict=True):
        if block.floor > 0 and present > 0.0:
            # The ratio first, at most 1 as rounded: a factor that is rounded may lift mu_k above the friction.
            worn = [(path, mu_s / block.mu_s, mu_k / block.mu_s) for path, mu_s, mu_k in block.wear if block.mu_s > 0.0]
            wear = [(path, friction * static, friction * kinetic) for path, static, kinetic in worn] or block.wear
            kinetic = friction * (block.mu_k / block.mu_s) if block.mu_s > 0.0 else friction
            amount = {"mass": None, "mass_ratio": block.mass_ratio * present} if block.mass_ratio else {}
            changes = {"mass": mass * present} | amount
            blocks.append(block.replace(**changes, mu_s=friction, mu_k=kinetic, mu=None, wear=wear))
    return scene.replace(blocks=blocks)


def _equal_expected(
    shares: FloatArray, model: Peaks, sliding: Peaks, motions: NamedMotions, seed: int
) -> tuple[float, tuple[float, float] | None]:
    """Share whose model has the expected drift over samples and motions, and its bootstrap interval."""
    if not few_collapses(int(sliding.collapsed.sum()), sliding.collapsed.size):
        return float("nan"), None
    how: dict[str, Any] = {"cluster_of": motions.cluster_of, "resamples": RESAMPLES, "seed": seed}
    equal = equal_share(shares, model.largest, sliding.largest.T, **how)
    return equal.value, equal.interval


def _tornado(frictions: FloatArray, present: FloatArray, effective: FloatArray) -> pl.DataFrame:
    rows = []
    for variable, values, first in (("friction mu", frictions, 1), ("occupancy", present, 3)):
        low, high = float(effective[first]), float(effective[first + 1])
        rows.append(
            {
                "variable": variable,
                "low": float(values[first]),
                "high": float(values[first + 1]),
                "share_low": low,
                "share_median": float(effective[0]),
                "share_high": high,
                "span": abs(high - low),
            }
        )
    return pl.DataFrame(rows).sort("span", descending=True)


def _remarks(
    scene: Scene, motions: NamedMotions, sliding: Peaks, values: FloatArray, model_drift: FloatArray
) -> tuple[str, ...]:
    remarks = usage_remarks(scene.remarks, motions.motions)
    remarks += ["mu and occupancy are independent, and the same on every floor"]
    if scene.geometric_stiffness.any():
        remarks.append("P-Delta of the models has the weight of the whole design live load")
    collapsed = int(sliding.collapsed.any(axis=1).sum())
    if collapsed:
        remarks.append(f"the building with sliding goods collapses under some motion in {collapsed} samples")
    highest = float((over_records(sliding.largest, "mean") > model_drift[-1] * (1.0 + 1e-12)).mean())
    if highest > 0.0:
        remarks.append(f"in {100.0 * highest:.0f} % of samples it drifts more than with the whole design load attached")
    return tuple(remarks)


def _described(distribution: Any) -> str:
    """A frozen distribution, or a number, as text."""
    if isinstance(distribution, Real):
        return f"{float(distribution):g}"
    name = getattr(getattr(distribution, "dist", None), "name", type(distribution).__name__)
    arguments = [f"{value:g}" for value in getattr(distribution, "args", ())]
    arguments += [f"{key}={value:g}" for key, value in getattr(distribution, "kwds", {}).items()]
    return f"{name}({', '.join(arguments)})"
