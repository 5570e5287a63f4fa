"""The runs of an archetype: real buildings with goods that slide, the same goods fixed, models, and other designs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.distributions import lognormal
from seismass.base.errors import SimulationError
from seismass.base.statistics import capped
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, refusal
from seismass.design import DesignedBuilding
from seismass.model.rack import Rack, RackBlock
from seismass.model.scene import Scene
from seismass.motions.motion import Motion, scaled_motions
from seismass.motions.records import Pair, Record, Suite
from seismass.motions.scaling.suite import scale_sa_t1
from seismass.runs.batch import solve_many
from seismass.runs.grid.columns import IndexArray
from seismass.runs.grid.grid import Grid
from seismass.studies.evidence.archetypes import Archetype, Setting

Motions: TypeAlias = Suite | Sequence[Record | Pair]
"""Records, or pairs of them for scenes in two directions."""
DESIGN_FRACTIONS: Final = (0.0, 0.25, 0.5, 0.8)
"""Fractions of the live load with which archetypes are designed again, for the fraction in the design."""
_QUANTITIES: Final = ("drift", "collapsed", "base_shear", "floor_force", "acceleration", "slides")


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
    models = len(setting.shares) + goods
    if redesign:
        models += 1 + _fewer(goods, 4) + len(DESIGN_FRACTIONS) * _fewer(goods, 8)
    return len(setting.levels) * motions * buildings * models


def _fewer(goods: int, part: int) -> int:
    return max(goods // part, 1)


def present_share(archetype: Archetype, setting: Setting, motions: int) -> float:
    """Mean share of the design live load that is present in the samples."""
    design = setting.designed(archetype)
    return _mean_presence(_sampled(archetype, setting, design, motions, setting.samples[1], {"scale": [1.0]}))


def solved_archetype(
    archetype: Archetype,
    setting: Setting,
    suite: Motions,
    *,
    redesign: bool = True,
    threads: int | None = None,
    report: Callable[[int], object] | None = None,
) -> pl.DataFrame:
    """Return peaks of all runs of an archetype: `model` (real, model; if asked for, fixed, design, reference), `share`
    of the live load in the model or in the design, `motion`, `building`, `goods`, `level`, and the quantities.
    """
    design = setting.designed(archetype)
    motions = scaled(suite, setting, design.design.period)
    levels, goods = {"scale": setting.levels}, setting.samples[1]
    sliding = _sampled(archetype, setting, design, len(motions), goods, levels)
    present = _mean_presence(sliding)
    shares = {"attached": setting.shares} | levels
    models = _attached(archetype, setting, design, len(motions), present, shares)
    change = None if setting.altered is None else ALTERATIONS[setting.altered]
    batches: list[tuple[str, Sequence[float], int, Grid]] = [
        ("real", (np.nan,), goods, sliding),
        ("model", setting.shares, 1, models),
    ]
    if redesign:
        fewer = _fewer(goods, 4)
        fixed = _sampled(archetype, setting, design, len(motions), fewer, levels, attached=1.0, sliding=0.0)
        batches.append(("fixed", (np.nan,), fewer, fixed))
        fewer = _fewer(goods, 8)
        for fraction in DESIGN_FRACTIONS:
            other = setting.designed(archetype, fraction)
            grid = _sampled(archetype, setting, other, len(motions), fewer, levels)
            batches.append(("design", (fraction,), fewer, grid))
        known = setting.designed(archetype, 0.0)
        bare = _attached(archetype, setting, known, len(motions), 0.0, {"attached": [0.0]} | levels)
        batches.append(("reference", (0.0,), 1, bare))
    frames, done = [], 0
    for model, of_model, per_building, grid in batches:
        first = done
        tell = None if report is None else lambda ran, _, first=first: report(first + ran)
        how: dict[str, Any] = {"peaks_only": True, "threads": threads, "progress": tell}
        how["floor_force"] = redesign and model in ("real", "model")
        if change is None:
            table = solve_many(grid, motions, **how)
        else:
            scenes = [change(grid.scene(number)) for number in range(1, len(grid) + 1)]
            factor, motion = (grid.table()[name].to_list() for name in ("scale", "motion"))
            shaken = [motions[number - 1].scaled(factor) for factor, number in zip(factor, motion, strict=True)]
            table = solve_many(scenes, shaken, pairs=np.arange(1, len(grid) + 1).repeat(2).reshape(-1, 2), **how)
        done += len(table)
        forces = np.array(design.floors) - 1 if how["floor_force"] else None
        frames.append(_peaks(table, archetype.system.collapse, setting, (model, of_model, per_building), forces))
    return pl.concat(frames)


def scaled(suite: Motions, setting: Setting, period: float) -> list[Motion | Pair]:
    """Return motions, each at the design spectrum at a period (s), pairs with their first component."""
    factors = scale_sa_t1(first_components(suite), setting.target, period).factors
    return [each if isinstance(each, Pair) else each.motion for each in scaled_motions(suite, factors)]


def first_components(suite: Motions) -> list[Record]:
    """Return records, of pairs the first ones."""
    return [each.first if isinstance(each, Pair) else each for each in suite]


def half_on_racks(period: float) -> Callable[[Scene], Scene]:
    """Return the change that puts half of the goods of each floor on a rack of three levels, of a first period (s)."""

    def change(scene: Scene) -> Scene:
        on_floors, racks = [], []
        for block in scene.blocks:
            ratio: Any = block.mass_ratio
            on_floors.append(block.replace(mass_ratio=0.5 * ratio))
            part = 0.5 * ratio / 3.0
            goods = [RackBlock(n, mass_ratio=0.95 * part, mu_s=block.mu_s, mu_k=block.mu_k) for n in (1, 2, 3)]
            racks.append(Rack(block.floor, 3, level_mass_ratio=0.05 * part, period=period, blocks=goods))
        return scene.replace(blocks=on_floors, racks=racks)

    return change


def with_columns_that_continue(scene: Scene) -> Scene:
    """Return a scene with a column over all storeys, pinned at its base, of EI/h^3 = k_1 / 3; damping stays."""
    building: Any = scene.building
    storeys = scene.storeys
    beam = np.array([[12.0, 6.0, -12.0, 6.0], [6.0, 4.0, -6.0, 2.0], [-12.0, -6.0, 12.0, -6.0], [6.0, 2.0, -6.0, 4.0]])
    whole = np.zeros((2 * storeys + 2, 2 * storeys + 2))
    for storey in range(storeys):
        places = slice(2 * storey, 2 * storey + 4)
        whole[places, places] += building.stiffness[0] / 3.0 * beam
    moved, turned = np.arange(2, len(whole), 2), np.arange(1, len(whole), 2)
    turns = np.linalg.solve(whole[np.ix_(turned, turned)], whole[np.ix_(turned, moved)])
    matrix = whole[np.ix_(moved, moved)] - whole[np.ix_(moved, turned)] @ turns
    changed = building.replace(stiffness_matrix=0.5 * (matrix + matrix.T), damping=building.damping_matrix)
    return scene.replace(building=changed)


COLUMNS: Final = "columns that continue"
PLANE: Final = "two directions"
ALTERATIONS: Final[dict[str, Callable[[Scene], Scene]]] = {
    "half of the goods on racks of 0.5 s": half_on_racks(0.5),
    "half of the goods on racks of 1.5 s": half_on_racks(1.5),
    COLUMNS: with_columns_that_continue,
    PLANE: lambda scene: scene.replace(other_direction=True),
}
"""Changes of the scenes of an archetype, real ones, and models where they differ, for the general engines."""


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
    table: pl.DataFrame,
    collapse: float,
    setting: Setting,
    batch: tuple[str, Sequence[float], int],
    loaded: IndexArray | None,
) -> pl.DataFrame:
    """Rows of runs as they are kept; runs are in the order motion, building, goods, share, level. Forces are the mean
    of those of loaded floors.
    """
    model, shares, goods = batch
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
            "floor_force": np.full(len(table), np.nan)
            if loaded is None
            else table.select(pl.col("peak_floor_force").list.gather(loaded.tolist()).list.mean()).to_series(),
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
