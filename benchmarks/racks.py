"""The effective fraction with racks, walls and stops: buildings of three storeys under one suite of motions.

    benchmarks/racks.py [--suite far_field|seven|forty] [--studies racks friction walls stops]

solves the cases and keeps them in benchmarks/results/racks.csv, those of each suite and study in place of earlier ones.
tools/pages/racks.py makes docs/racks.md and its figures of them. Recordings are read from the folder `records` of
SEISMASS_SHARED. A study of the far-field suite takes one to five minutes of two cores.

The building has three storeys and a period of 0.47 s without goods, 5 % damping, goods of once the floor mass on
floors 1 and 2 and a bare roof; V_y is that of a spectrum analysis with a quarter of the goods over R, elastic for
R = 1. Motions are scaled as in `seismass study`.
"""

from __future__ import annotations

import argparse
import runpy
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

import seismass as sm
from seismass.base.values import FloatArray
from seismass.motions.spectra import mean_spectrum

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "benchmarks" / "results" / "racks.csv"
PERIOD, RATIO, LEVELS, FRAME, MASS = 0.47, 1.0, 3, 0.04, 1e5
REDUCTIONS = (1.0, 2.0, 4.0)
RACK_PERIODS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0)
PALLETS = 0.37
RACK_STRENGTH = 0.15
ETAS = (0.25, 0.5, 0.75, 1.0)
ALPHA_H = (1.0, 2.0, 4.0)
CLEARANCES = (0.02, 0.05, 0.1)
SLIPPERY = (0.05, 0.1, 0.2, 0.3)
CONTACT_PERIOD = 0.1
SHARES = {"racks": 51, "friction": 21, "walls": 11, "stops": 51}
"""Shares at which models are solved before the root is refined: few where the models have walls, which take longer."""


class Suite:
    """Motions of a suite, scaled, and their mean spectrum."""

    def __init__(self, name: str) -> None:
        records = runpy.run_path(str(ROOT / "benchmarks" / "rules.py"))["suite_of"](name)
        factors = sm.scaling.scale_asce7_10(records, sm.TargetSpectrum.asce7()).factors
        self.motions = [record.scaled(factor) for record, factor in zip(records, factors, strict=True)]
        self._records, self._factors = records, factors

    def spectrum(self, periods: FloatArray) -> FloatArray:
        """Mean pseudo-acceleration at periods (m/s2)."""
        return mean_spectrum(self._records, self._factors, periods)


def frame(suite: Suite, reduction: float) -> sm.Building:
    """Return the shear building with the strengths of the design."""
    bare = sm.Building.uniform(3, PERIOD, mass=MASS)
    if reduction == 1.0:
        return bare
    goods = MASS * RATIO * np.array([1.0, 1.0, 0.0])
    shear = sm.design.response_spectrum_analysis(bare.mass + 0.25 * goods, bare.stiffness, suite.spectrum).storey_shear
    return bare.replace(yield_shear=shear / reduction)


def walled(suite: Suite, reduction: float, alpha_h: float) -> sm.Building:
    """Return a frame beside a wall, of the same period together; alpha_h 0: the wall alone."""
    if alpha_h == 0.0:
        wall = sm.design.Wall.of_period([MASS] * 3, 3.5, PERIOD)
        return sm.Building([MASS] * 3, 0.0, heights=3.5, stiffness_matrix=wall.stiffness_matrix)
    unit = sm.Building([MASS] * 3, 1e8, heights=3.5)
    found = sm.design.Wall.of_alpha_h(unit, alpha_h).beside(unit).periods[0]
    bare = sm.Building([MASS] * 3, 1e8 * (found / PERIOD) ** 2, heights=3.5)
    both = sm.design.Wall.of_alpha_h(bare, alpha_h).beside(bare)
    if reduction == 1.0:
        return both
    goods = MASS * RATIO * np.array([1.0, 1.0, 0.0])
    analysis = sm.design.response_spectrum_analysis(
        both.mass + 0.25 * goods, both.stiffness, suite.spectrum, stiffness_matrix=both.stiffness_matrix
    )
    return both.replace(yield_shear=analysis.spring_shear / reduction)


def on_floors(building: sm.Building, mu: float, stops: sm.Stops | None = None) -> sm.Scene:
    """Return goods on the floors."""
    return sm.Scene(building, [sm.Block(floor, mass_ratio=RATIO, mu=mu, stops=stops) for floor in (1, 2)])


def on_racks(building: sm.Building, period: float, mu: float | None, strength: float | None = None) -> sm.Scene:
    """Return goods on racks of both floors, fixed where there is no mu."""
    goods: dict[str, Any] = {"fixed": True} if mu is None else {"mu": mu}
    blocks = [sm.RackBlock(level, mass_ratio=RATIO / LEVELS, **goods) for level in range(1, LEVELS + 1)]
    racks = [
        sm.Rack(
            floor,
            levels=LEVELS,
            level_mass_ratio=FRAME * RATIO / LEVELS,
            period=period,
            yield_shear_over_weight=strength,
            blocks=blocks,
        )
        for floor in (1, 2)
    ]
    return sm.Scene(building, racks=racks)


def answer(suite: Suite, scene: sm.Scene, **case: Any) -> dict[str, Any]:
    """Return a row of results, with what the case is."""
    shares = np.linspace(0.0, 1.0, SHARES[case["study"]])
    target = sm.TargetSpectrum.asce7()
    result = sm.effective_mass(scene, suite.motions, fractions=shares, target=target, resamples=1000)
    largest = result.curve.filter(storey=0)
    full = largest.filter(pl.col("fraction") == 1.0)["ratio"].item()
    low, high = result.interval or (None, None)
    row = {
        **case,
        "eta": result.eta,
        "value": result.value,
        "kind": result.kind,
        "low": low,
        "high": high,
        "over_attached": full,
        "by_hand": result.by_hand.estimate,
    }
    print(" ".join(f"{name}={value:.3g}" if isinstance(value, float) else f"{value}" for name, value in row.items()))
    return row


def friction_at(suite: Suite, scene: sm.Scene, eta: float) -> float:
    """Return mu of a ratio to the mean peak base shear coefficient with all goods attached."""
    model = sm.attached_scene(scene, 1.0)
    table = sm.simulate_many([model], suite.motions)
    assert model.building is not None
    weight = float(model.building.mass.sum()) * 9.80665
    return eta * float(np.mean(table["peak_base_shear"].to_numpy())) / weight


def racks(suite: Suite) -> Iterator[dict[str, Any]]:
    """The fraction against the period of the rack, its goods and its strength; period 0: on the floor."""
    for reduction in REDUCTIONS:
        building = frame(suite, reduction)
        yield answer(suite, on_floors(building, PALLETS), study="racks", R=reduction, goods="sliding", rack_period=0.0)
        for period in RACK_PERIODS:
            case = {"study": "racks", "R": reduction, "rack_period": period}
            yield answer(suite, on_racks(building, period, PALLETS), **case, goods="sliding")
            yield answer(suite, on_racks(building, period, None), **case, goods="fixed")
            yield answer(suite, on_racks(building, period, PALLETS, RACK_STRENGTH), **case, goods="yielding")


def friction(suite: Suite) -> Iterator[dict[str, Any]]:
    """The fraction against eta, on the floor and on racks of three periods."""
    for reduction in (1.0, 4.0):
        building = frame(suite, reduction)
        for eta in ETAS:
            for period in (0.0, 0.2, 0.5, 1.0):
                probe = on_racks(building, period, 0.1) if period else on_floors(building, 0.1)
                mu = friction_at(suite, probe, eta)
                scene = on_racks(building, period, mu) if period else on_floors(building, mu)
                yield answer(suite, scene, study="friction", R=reduction, goods="sliding", rack_period=period, mu=mu)


def walls(suite: Suite) -> Iterator[dict[str, Any]]:
    """The fraction against eta with a wall alone, and beside elastic and yielding frames."""
    for reduction, alpha_h in ((1.0, 0.0), (1.0, 2.0), *((4.0, alpha_h) for alpha_h in ALPHA_H)):
        building = walled(suite, reduction, alpha_h)
        for eta in ETAS:
            mu = friction_at(suite, on_floors(building, 0.1), eta)
            yield answer(suite, on_floors(building, mu), study="walls", R=reduction, alpha_h=alpha_h, mu=mu)


def stops(suite: Suite) -> Iterator[dict[str, Any]]:
    """The fraction with and without stops, and the largest drift of a record over that without."""
    mass = MASS * RATIO
    for reduction in REDUCTIONS:
        building = frame(suite, reduction)
        for mu in SLIPPERY:
            free = on_floors(building, mu)
            case: dict[str, Any] = {"study": "stops", "R": reduction, "mu": mu}
            yield answer(suite, free, **case, clearance=None, worst_record=1.0)
            for clearance in CLEARANCES:
                rail = sm.Stops(clearance, mass * (2.0 * np.pi / CONTACT_PERIOD) ** 2)
                scene = on_floors(building, mu, rail)
                table = sm.simulate_many([scene, free], suite.motions)
                drift = table["peak_drift"].list.max().to_numpy().reshape(2, -1)
                worst = float((drift[0] / drift[1]).max())
                yield answer(suite, scene, **case, clearance=clearance, worst_record=worst)


STUDIES = {"racks": racks, "friction": friction, "walls": walls, "stops": stops}
COLUMNS = {
    "suite": pl.String,
    "study": pl.String,
    "R": pl.Float64,
    "goods": pl.String,
    "rack_period": pl.Float64,
    "alpha_h": pl.Float64,
    "clearance": pl.Float64,
    "mu": pl.Float64,
    "eta": pl.Float64,
    "value": pl.Float64,
    "kind": pl.String,
    "low": pl.Float64,
    "high": pl.Float64,
    "over_attached": pl.Float64,
    "by_hand": pl.Float64,
    "worst_record": pl.Float64,
}


def kept() -> pl.DataFrame:
    """Return the stored rows, none where nothing is stored."""
    return pl.read_csv(RESULTS, schema=COLUMNS) if RESULTS.exists() else pl.DataFrame(schema=COLUMNS)


def main() -> int:
    """Solve what is asked for and keep it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suite", choices=("far_field", "seven", "forty"), default="far_field")
    parser.add_argument("--studies", nargs="+", choices=tuple(STUDIES), default=list(STUDIES))
    options = parser.parse_args()
    suite = Suite(options.suite)
    for name in options.studies:
        rows = pl.DataFrame([{"suite": options.suite, **row} for row in STUDIES[name](suite)], schema=COLUMNS)
        others = kept().filter(~((pl.col("suite") == options.suite) & (pl.col("study") == name)))
        pl.concat([others, rows]).write_csv(RESULTS, float_precision=9)
    return 0


if __name__ == "__main__":
    sys.exit(main())
