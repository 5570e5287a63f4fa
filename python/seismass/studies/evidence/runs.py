"""The runs of an archetype: real buildings with goods that slide, the same goods fixed, models, and other designs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.distributions import lognormal
from seismass.base.errors import SimulationError
from seismass.base.statistics import capped
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, refusal
from seismass.design import DesignedBuilding
from seismass.motions.motion import Motion, scaled_motions
from seismass.motions.records import Record, Suite
from seismass.motions.scaling.suite import scale_sa_t1
from seismass.runs.batch import solve_many
from seismass.runs.grid.grid import Grid
from seismass.studies.evidence.archetypes import Archetype, Setting

DESIGN_FRACTIONS: Final = (0.0, 0.25, 0.5, 0.8)
"""Fractions of the live load with which archetypes are designed again, for the fraction in the design."""
_QUANTITIES: Final = ("drift", "collapsed", "base_shear", "acceleration", "slides")


@dataclass(frozen=True, eq=False)
class Runs:
    """Peaks of runs, arrays of shape (shares, levels, motions, buildings, goods) by quantity, and their shares."""

    shares: FloatArray
    peaks: dict[str, FloatArray]

    def at(self, level: int, quantity: str = "drift") -> FloatArray:
        """Return a quantity at a level, shape (shares, motions, buildings, goods)."""
        return self.peaks[quantity][:, level]

    def part(self, buildings: int, goods: int) -> Runs:
        """Return the runs of the first buildings of each motion and of the first goods of each."""
        return Runs(self.shares, {name: peaks[..., :buildings, :goods] for name, peaks in self.peaks.items()})


def runs_of(archetype: Archetype, setting: Setting, motions: int, redesign: bool) -> int:
    """Number of runs of an archetype."""
    buildings, goods = setting.samples
    models = len(setting.shares) + 2 * goods
    if redesign:
        models += 1 + len(DESIGN_FRACTIONS) * _fewer(goods)
    return len(setting.levels) * motions * buildings * models


def _fewer(goods: int) -> int:
    return max(goods // 4, 1)


def present_share(archetype: Archetype, setting: Setting, motions: int) -> float:
    """Mean share of the design live load that is present in the samples."""
    design = setting.designed(archetype)
    return _mean_presence(_sampled(archetype, setting, design, motions, setting.samples[1], {"scale": [1.0]}))


def solved_archetype(
    archetype: Archetype,
    setting: Setting,
    suite: Suite | Sequence[Record],
    *,
    redesign: bool = True,
    threads: int | None = None,
    report: Callable[[int], object] | None = None,
) -> pl.DataFrame:
    """Return peaks of all runs of an archetype: `model` (real, fixed, model, design, reference), `share` of the live
    load in the model or in the design, `motion`, `building`, `goods`, `level`, and the quantities.
    """
    design = setting.designed(archetype)
    motions = scaled(suite, setting, design.design.period)
    levels, goods = {"scale": setting.levels}, setting.samples[1]
    sliding = _sampled(archetype, setting, design, len(motions), goods, levels)
    present = _mean_presence(sliding)
    fixed = _sampled(archetype, setting, design, len(motions), goods, levels, attached=1.0, sliding=0.0)
    shares = {"attached": setting.shares} | levels
    models = _attached(archetype, setting, design, len(motions), present, shares)
    batches: list[tuple[str, Sequence[float], int, Grid]] = [
        ("real", (np.nan,), goods, sliding),
        ("fixed", (np.nan,), goods, fixed),
        ("model", setting.shares, 1, models),
    ]
    if redesign:
        for fraction in DESIGN_FRACTIONS:
            other = setting.designed(archetype, fraction)
            grid = _sampled(archetype, setting, other, len(motions), _fewer(goods), levels)
            batches.append(("design", (fraction,), _fewer(goods), grid))
        known = setting.designed(archetype, 0.0)
        bare = _attached(archetype, setting, known, len(motions), 0.0, {"attached": [0.0]} | levels)
        batches.append(("reference", (0.0,), 1, bare))
    frames, done = [], 0
    for model, of_model, per_building, grid in batches:
        first = done
        tell = None if report is None else lambda ran, _, first=first: report(first + ran)
        table = solve_many(grid, motions, peaks_only=True, threads=threads, progress=tell)
        done += len(table)
        frames.append(_peaks(table, archetype.system.collapse, setting, model, of_model, per_building))
    return pl.concat(frames)


def scaled(suite: Suite | Sequence[Record], setting: Setting, period: float) -> list[Motion]:
    """Return motions, each at the design spectrum at a period (s)."""
    factors = scale_sa_t1(suite, setting.target, period).factors
    return [record.motion for record in scaled_motions(suite, factors)]


def _sample(
    archetype: Archetype, setting: Setting, design: DesignedBuilding, samples: tuple[int, int, int], **options: Any
) -> Grid:
    return Grid.sample(
        design.building,
        samples=samples,
        seed=setting.seed,
        strength=lognormal(setting.first_yield, setting.first_yield_sigma),
        second_slope=lognormal(setting.second_slope, setting.second_slope_sigma),
        floors=list(design.floors),
        mass_ratio=[design.load_ratio.tolist()],
        collapse_drift=archetype.system.collapse * archetype.occupancy.height,
        **options,
    )


def _sampled(
    archetype: Archetype,
    setting: Setting,
    design: DesignedBuilding,
    motions: int,
    goods: int,
    crossed: dict[str, Any],
    **shares: Any,
) -> Grid:
    """Buildings with goods as they are: strengths of every building, friction and loads of every draw of goods."""
    presence = [setting.presence(archetype.occupancy)] * len(design.floors)
    how = {"occupancy": presence, "correlation": setting.correlation, "mu": setting.friction_of(archetype.occupancy)}
    how |= {"mu_k_over_mu_s": setting.kinetic, "crossed": crossed}
    return _sample(archetype, setting, design, (motions, setting.samples[0], goods), **how, **shares)


def _attached(
    archetype: Archetype,
    setting: Setting,
    design: DesignedBuilding,
    motions: int,
    present: float,
    crossed: dict[str, Any],
) -> Grid:
    """Models of the same buildings: shares of the design live load as mass, the weight of what is present."""
    how: dict[str, Any] = {"occupancy": present, "mu": 1.0, "sliding": 0.0, "attached_of": "design", "crossed": crossed}
    return _sample(archetype, setting, design, (motions, setting.samples[0], 1), **how)


def _mean_presence(grid: Grid) -> float:
    return float(np.mean([axis.columns["occupancy"].mean() for axis in grid.axes() if "occupancy" in axis.columns]))


def _peaks(
    table: pl.DataFrame, collapse: float, setting: Setting, model: str, shares: Sequence[float], goods: int
) -> pl.DataFrame:
    """Rows of runs as they are kept; runs are in the order motion, building, goods, share, level."""
    failed = table.filter(pl.col("status") == "failed")
    if failed.height:
        raise refusal(SimulationError, "runs", "evidence", "carried to their ends", str(failed["reason"][0]))
    drift = capped(table["peak_drift_ratio"].list.max().to_numpy(), collapse)
    fell = (table["status"] == "collapsed").to_numpy()
    number = np.arange(len(table))
    sizes = {"level": len(setting.levels), "share": len(shares), "goods": goods, "building": setting.samples[0]}
    places: dict[str, NDArray[np.int64]] = {}
    for name, size in sizes.items():
        places[name], number = number % size, number // size
    return pl.DataFrame(
        {
            "model": [model] * len(table),
            "share": np.asarray(shares)[places["share"]],
            "motion": (number + 1).astype(np.uint16),
            **{name: (places[name] + 1).astype(np.uint16) for name in ("building", "goods", "level")},
            "drift": np.where(fell, collapse, drift),
            "collapsed": fell,
            "base_shear": table["peak_base_shear"],
            "acceleration": table["peak_floor_acceleration"].list.max() / STANDARD_GRAVITY,
            "slides": (table["slips"] > 0).fill_null(False),
        }
    )


def gathered(table: pl.DataFrame, model: str) -> Runs:
    """Return the runs of a model as arrays."""
    rows = table.filter(pl.col("model") == model).sort("share", "level", "motion", "building", "goods")
    shares = rows["share"].unique().sort().to_numpy()
    counts = [int(rows[name].max()) for name in ("level", "motion", "building", "goods")]  # type: ignore[arg-type]
    shape = (len(shares), *counts)
    return Runs(shares, {name: rows[name].cast(pl.Float64).to_numpy().reshape(shape) for name in _QUANTITIES})
