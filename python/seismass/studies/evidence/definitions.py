"""Shares by several definitions from the runs of an archetype, and what code fractions do."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.values import FloatArray
from seismass.effective_mass.share import RARE, EqualShare, equal_share
from seismass.studies.evidence.archetypes import Setting
from seismass.studies.evidence.runs import Runs, gathered
from seismass.studies.risk.annual_rate import run_rates, stripe_rates
from seismass.studies.risk.hazard import HazardCurve

MCE: Final = 1.5
"""Level of the maximum considered earthquake, over the design spectrum."""
DEFINITIONS: Final = {
    "a_mean": "capped mean drift at the design level",
    "a_ln": "mean of ln drift at the design level",
    "b": "P(drift above the limit) at the design level",
    "c": "P(collapse) at the MCE",
    "d": "annual rate of drift above the limit",
    "rate_collapse": "annual rate of collapse",
    "base_shear": "mean base shear at the design level",
    "floor_force": "mean force of loaded floors on their diaphragms at the design level",
    "q84": "84 % quantile of drift at the design level",
    "e_d": "fraction in the design for the rate of (d) of a building whose mass is known",
    "e_c": "fraction in the design for the rate of collapse of a building whose mass is known",
}
"""Definitions of a share of the design live load."""
QUANTITIES: Final = {
    "drift": "a_mean",
    "rate": "d",
    "P_collapse": "c",
    "base_shear": "base_shear",
    "floor_force": "floor_force",
}
"""Quantities that are compared at the fractions of codes, with the definition of each."""


@dataclass(frozen=True)
class Question:
    """What is asked of runs: setting, hazard over the design level, station of each motion, bootstrap."""

    setting: Setting
    hazard: HazardCurve
    cluster_of: NDArray[np.int64]
    resamples: int

    def level(self, value: float) -> int:
        """Number of a level, from 0."""
        return int(np.argmin(np.abs(np.array(self.setting.levels) - value)))


@dataclass(frozen=True, eq=False)
class Answer:
    """What the runs of an archetype say: shares by definition, of goods as they are and where none slide; that of floor
    acceleration, for its ratios; the part of real runs at the design level in which goods slide; rows of two tables.
    """

    shares: dict[str, EqualShare]
    fixed: dict[str, EqualShare]
    acceleration: EqualShare
    slides: float
    fragility: list[dict[str, Any]]
    convergence: list[dict[str, Any]]

    def ratio(self, quantity: str, fraction: float) -> dict[str, float | None]:
        """Return real over model of a quantity with a fraction in the model, with its interval; None where rare."""
        known = self.acceleration if quantity == "floor_acceleration" else self.shares.get(QUANTITIES[quantity])
        values = (np.nan,) * 3 if known is None or known.kind == "rare" else known.over_model(fraction)
        names = ("real_over_model", "low", "high")
        return {name: value if np.isfinite(value) else None for name, value in zip(names, values, strict=True)}

    def share_rows(self) -> Iterator[dict[str, Any]]:
        """Yield one row per definition."""
        for name, share in self.shares.items():
            fixed = self.fixed.get(name)
            without = None if fixed is None or fixed.kind == "rare" else fixed.value
            value, (low, high) = None if share.kind == "rare" else share.value, share.interval or (None, None)
            row = {"definition": name, "share": value, "low": low, "high": high, "kind": share.kind}
            row |= {"real_value": abs(share.sliding), "without_friction": without}
            yield row | {"lambda": value / without if value is not None and without else None}


PARTS: Final = {
    "a quarter of the loads": (1.0, 0.25),
    "half of the loads": (1.0, 0.5),
    "a quarter of the buildings": (0.25, 1.0),
    "half of the buildings": (0.5, 1.0),
}
"""Parts of the sample whose shares are compared with those of the whole: of buildings, and of loads of each."""


def answer_of(table: pl.DataFrame, question: Question, *, convergence: bool = True) -> Answer:
    """Return what the table of the runs of an archetype says."""
    models, sliding = gathered(table, "model"), gathered(table, "real")
    shares = _shares(models, sliding, question) | dict(_of_designs(table, question))
    design = question.level(1.0)
    acceleration = models.at(design, "acceleration"), sliding.at(design, "acceleration")
    rows = []
    for name, (of_buildings, of_goods) in PARTS.items() if convergence else ():
        sizes = of_buildings * question.setting.samples[0], of_goods * question.setting.samples[1]
        if all(size.is_integer() for size in sizes):
            buildings, goods = map(int, sizes)
            once = replace(question, resamples=1)
            part = _shares(models.part(buildings, 1), sliding.part(buildings, goods), once)
            changes = {each: share.value - shares[each].value for each, share in part.items()}
            rows += [{"sample": name, "definition": each, "change": value} for each, value in changes.items()]
    return Answer(
        shares,
        _shares(models, gathered(table, "fixed"), question) if (table["model"] == "fixed").any() else {},
        _share(question, *acceleration),
        float(sliding.at(design, "slides").mean()),
        list(_fragility_rows(models, sliding, question)),
        rows,
    )


def _shares(models: Runs, sliding: Runs, question: Question) -> dict[str, EqualShare]:
    """Shares by definition, of real buildings and models."""
    design, mce, limit = question.level(1.0), question.level(MCE), question.setting.limit
    drifts = models.at(design), sliding.at(design)
    exceeds = (drifts[0] > limit).astype(np.float64), (drifts[1] > limit).astype(np.float64)
    collapses = models.at(mce, "collapsed"), sliding.at(mce, "collapsed")
    shears, forces = ((models.at(design, name), sliding.at(design, name)) for name in ("base_shear", "floor_force"))
    shares = {
        "a_mean": _share(question, *drifts),
        "a_ln": _share(question, *drifts, statistic="ln mean"),
        "b": _share(question, *exceeds, least=RARE),
        "c": _share(question, *collapses, least=RARE),
        "base_shear": _share(question, *shears),
        "q84": _share(question, *drifts, statistic="quantile"),
    }
    if np.isfinite(forces[0]).all() and np.isfinite(forces[1]).all():
        shares["floor_force"] = _share(question, *forces)
    for name, quantity, most in (("d", "drift", limit), ("rate_collapse", "collapsed", 0.5)):
        rates = _rates(models, quantity, most, question), _rates(sliding, quantity, most, question)
        is_rare = (sliding.at(-1, quantity) > most).mean() < RARE
        shares[name] = _share(question, *rates, least=np.inf if is_rare else -np.inf)
    return shares


def _share(question: Question, models: FloatArray, sliding: FloatArray, **options: Any) -> EqualShare:
    """Share of values of models and of real buildings, shape (shares, motions, ...); real ones have one share."""
    how: dict[str, Any] = {
        "cluster_of": question.cluster_of,
        "resamples": question.resamples,
        "seed": question.setting.seed,
    }
    return equal_share(question.setting.shares, models, sliding[0], **how, **options)


def _rates(runs: Runs, quantity: str, most: float, question: Question) -> FloatArray:
    """Part of each run in the annual rate of a drift above a value, or of a collapse."""
    values, levels = np.moveaxis(runs.peaks[quantity], 1, 0), question.setting.levels
    if quantity == "drift":
        return run_rates(levels, values, most, question.hazard)
    return stripe_rates(levels, values > most, question.hazard)


def _of_designs(table: pl.DataFrame, question: Question) -> Iterator[tuple[str, EqualShare]]:
    """Fractions in the design with which real buildings have the rates of one whose mass is known."""
    if not (table["model"] == "design").any():
        return
    designs, reference = gathered(table, "design"), gathered(table, "reference")
    how: dict[str, Any] = {"cluster_of": question.cluster_of, "resamples": question.resamples}
    for name, quantity, most in (("e_d", "drift", question.setting.limit), ("e_c", "collapsed", 0.5)):
        # Rates fall with the fraction.
        rates, known = (-_rates(runs, quantity, most, question) for runs in (designs, reference))
        yield name, equal_share(designs.shares, rates, known[0], **how)


def _fragility_rows(models: Runs, sliding: Runs, question: Question) -> Iterator[dict[str, Any]]:
    """Yield one row per model and level: exceedances, collapses, mean drift."""
    for model, runs in (("real", sliding), ("share", models)):
        for place, share in enumerate(runs.shares):
            for number, level in enumerate(question.setting.levels):
                drift = runs.at(number)[place]
                row = {"model": model, "share": None if model == "real" else float(share), "level": level}
                row |= {"runs": drift.size, "exceeds": float((drift > question.setting.limit).mean())}
                row |= {"collapsed": float(runs.at(number, "collapsed")[place].mean())}
                yield row | {"mean_drift": float(drift.mean()), "ln_mean_drift": float(np.log(drift).mean())}
