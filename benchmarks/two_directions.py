"""What a second horizontal direction does to drift, to the effective fraction of live load, and to slip.

    benchmarks/two_directions.py [--suites far_field other forty] [--assess] [--write]

solves the cases under the pairs of a suite, keeps them in benchmarks/results/two_directions.json, those of each suite
in place of earlier ones, and prints the page that tools/pages/two_directions.py makes of them; `--write` writes it.
`--assess` times `assess` in two directions under 42 pairs and keeps the time too. Recordings are read from the folder
`records` of SEISMASS_SHARED. A suite takes some minutes of two cores.

Buildings have 5 % damping, goods of once the floor mass on all floors but the roof, and V_y of a spectrum analysis with
a quarter of the goods over R, elastic for R = 1; they are equal in x and y. One factor scales both components of a
pair, so that the geometric mean of their spectra stands where that of a motion does. One direction is every component
by itself. Of the built-in pairs the first sixteen are taken.
"""

from __future__ import annotations

import argparse
import json
import os
import time
import tomllib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl

import seismass as sm
from environment import page_module
from seismass.base.values import FloatArray
from seismass.effective_mass.models import attached, full_weight
from seismass.effective_mass.rule import by_hand
from seismass.effective_mass.share import interpolated
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.motions.records import Pair
from seismass.motions.spectra import mean_spectrum
from seismass.runs.batch import solve_many
from seismass.runs.peaks import named_motions, solve

ROOT: Final = Path(__file__).parents[1]
RESULTS: Final = ROOT / "benchmarks" / "results" / "two_directions.json"
BUILDINGS: Final = ((2, 0.2), (3, 0.3), (3, 0.47), (3, 0.8), (4, 1.2))
"""Number of storeys and first period (s) without goods, one in each class of period."""
REDUCTIONS: Final = (1.0, 4.0)
ETAS: Final = (0.3, 0.6, 1.0)
RATIO: Final = 1.0
SHARES: Final = np.linspace(0.0, 1.0, 21)
SUITES: Final = ("far_field", "other", "forty")
PAIRS_TIMED: Final = 42
SYNTHETIC: Final = 16
"""Pairs of the built-in forty that are taken: two of each class of event, distance and site."""


def pairs_of(suite: str) -> list[Pair]:
    """Return the pairs of a suite, as recorded."""
    if suite == "forty":
        return list(sm.records.builtin_pairs())[:SYNTHETIC]
    records = Path(os.environ["SEISMASS_SHARED"]) / "records"
    if suite == "far_field":
        return list(sm.records.find_pairs(records / "fema_p695_far_field"))
    folders = sorted(folder for folder in records.iterdir() if folder.name[:2].isdigit())
    return [pair for folder in folders for pair in sm.records.find_pairs(folder)]


def scaled_pairs(suite: str) -> list[Pair]:
    """Return the pairs of a suite scaled to the default target for 1 s, as maps of the effective fraction are."""
    pairs = pairs_of(suite)
    factors = sm.scaling.scale_asce7_10(pairs, sm.TargetSpectrum.asce7(), between=False).factors
    return [pair.scaled(float(factor)) for pair, factor in zip(pairs, factors, strict=True)]


def cases_of(suite: str) -> list[dict[str, Any]]:
    """Solve every case under the pairs of a suite."""
    pairs = scaled_pairs(suite)
    components = [record for pair in pairs for record in (pair.first, pair.second)]
    motions = [record.motion for record in components]

    def spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(motions, np.ones(len(motions)), periods)

    found = []
    for storeys, period in BUILDINGS:
        bare = Building.uniform(storeys, period, mass=1e5)
        ratios = np.full(storeys, RATIO)
        ratios[-1] = 0.0
        for reduction in REDUCTIONS:
            design = sm.design.response_spectrum_analysis(bare.mass * (1.0 + 0.25 * ratios), bare.stiffness, spectrum)
            strength = np.inf if reduction == 1.0 else design.storey_shear / reduction
            building = bare.replace(yield_shear=strength)
            found += _cases(suite, building, ratios, reduction, pairs, components)
    return found


def _cases(
    suite: str,
    building: Building,
    ratios: FloatArray,
    reduction: float,
    pairs: Sequence[Pair],
    components: Sequence[Any],
) -> list[dict[str, Any]]:
    """The cases of one building, by eta."""
    stuck = Scene(building, sm.blocks_on_floors(ratios, mu=1.0))
    named = named_motions(components, "study")
    model = solve([attached(stuck, float(share), "same") for share in SHARES], named)
    coefficient = float(model.base_shear[-1].mean()) / full_weight(stuck)
    period = float(building.periods[0])
    of_rule = by_hand(stuck, None, sm.TargetSpectrum.asce7())
    rows = []
    for eta in ETAS:
        blocks = sm.blocks_on_floors(ratios, mu=eta * coefficient)
        in_plane = solve_many(Scene(building, blocks, other_direction=True), pairs)
        alone = solve_many(Scene(building, blocks), list(components))
        known = (in_plane["status"] == "completed").to_numpy()
        of_components = np.repeat(known, 2)
        # Components of a pair follow each other: shape (pairs, 2, storeys or blocks).
        drift, slip = (_in_directions(in_plane.filter(known), name) for name in ("peak_drift", "peak_slip"))
        own_drift, own_slip = (
            np.array(alone.filter(of_components)[name].to_list()).reshape(drift_shape)
            for name, drift_shape in (("peak_drift", drift.shape), ("peak_slip", slip.shape))
        )
        length = np.array(in_plane.filter(known)["peak_slip"].to_list())
        path = np.array(in_plane.filter(known)["slip_path"].to_list())
        models = model.largest[:, of_components]
        curve = models.mean(axis=1)
        larger = models.reshape(len(SHARES), -1, 2).max(axis=2).mean(axis=1)
        one, two = (each.max(axis=2) for each in (own_drift, drift))
        slides = bool(own_slip.max() > 0.0)
        rows.append(
            {
                "suite": suite,
                "storeys": building.storeys,
                "period": round(period, 6),
                "R": reduction,
                "eta": eta,
                "mu": eta * coefficient,
                "coefficient": of_rule.coefficient,
                "slides": slides,
                "pairs": int(known.sum()),
                "failed": int((~known).sum()),
                "drift_ratio": float(two.mean() / one.mean()),
                "drift_ratios": np.quantile(two.mean(axis=1) / one.mean(axis=1), [0.0, 0.16, 0.5, 0.84, 1.0]).tolist(),
                "value_one": _value(curve, one.mean()),
                "value_two": _value(curve, two.mean()),
                "value_larger": _value(larger, two.max(axis=1).mean()),
                "slip_one": float(own_slip.mean()),
                "slip_ratio": float(slip.sum() / own_slip.sum()) if own_slip.any() else None,
                "slip_ratios": _slip_ratios(slip, own_slip),
                "length_ratio": float(2.0 * length.sum() / own_slip.sum()) if own_slip.any() else None,
                "path": float(path.mean()),
                "real_one": float(one.mean()),
                "real_two": float(two.mean()),
                "curve": curve.tolist(),
            }
        )
        print(f"{suite}: T = {period:g} s, R = {reduction:g}, eta = {eta:g}: {rows[-1]['drift_ratio']:.3f}", flush=True)
    return rows


def _in_directions(table: pl.DataFrame, name: str) -> FloatArray:
    """A list of a table in x and in y, shape (pairs, 2, length of the list)."""
    return np.stack([np.array(table[f"{name}_{axis}"].to_list()) for axis in "xy"], axis=1)


def _value(curve: FloatArray, real: float) -> float:
    return float(interpolated(SHARES, curve[None, :], np.full((1, len(SHARES)), real))[0])


def _slip_ratios(slip: FloatArray, alone: FloatArray) -> list[float] | None:
    """Quantiles over pairs of the sum of peak slips per direction over that of one direction, where goods slide."""
    own = alone.sum(axis=(1, 2))
    slides = own > 1e-3
    if not slides.any():
        return None
    ratios = slip.sum(axis=(1, 2))[slides] / own[slides]
    return [float(value) for value in np.quantile(ratios, [0.0, 0.16, 0.5, 0.84, 1.0])]


def timed_assessment() -> dict[str, Any]:
    """Time `assess` in two directions under 42 pairs of a building with stated strengths."""
    recorded = [pair for suite in ("far_field", "other") for pair in pairs_of(suite)]
    turned = [pair.rotated(45.0) for pair in recorded]
    tables = tomllib.loads((ROOT / "data" / "examples" / "warehouse.toml").read_text(encoding="utf-8"))
    designed = sm.read_building({**tables, "other_direction": {"period_s": 0.7}})
    building = _with_its_strengths(designed)
    pairs = [*recorded, *turned][:PAIRS_TIMED]
    began, spent = time.perf_counter(), time.process_time()
    result = sm.assess(building, pairs)
    return {
        "pairs": len(pairs),
        "turned": sum(any("component at" in said for said in pair.first.history) for pair in pairs),
        "storeys": building.storeys,
        "seconds": time.perf_counter() - began,
        "processor_seconds": time.process_time() - spent,
        "cores": len(os.sched_getaffinity(0)),
        "runs": result.runs.filter(storey=1).height,
        "share": {name: found.value for name, found in result.effective.items()},
    }


def _with_its_strengths(building: sm.OwnBuilding) -> sm.OwnBuilding:
    """A building whose designed strengths are stated in both directions, so that none are designed for every share."""
    other = None if building.other is None else _with_its_strengths(building.other)
    return replace(building, yield_shear=building.structure().yield_shear, design=None, other=other)


def main() -> None:
    """Solve, keep, print and write as the options say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suites", nargs="*", choices=SUITES, default=[])
    parser.add_argument("--assess", action="store_true", help="time assess under 42 pairs")
    parser.add_argument("--write", action="store_true", help="write docs/two_directions.md")
    options = parser.parse_args()
    kept: dict[str, Any] = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {"cases": []}
    for suite in options.suites:
        began = time.perf_counter()
        cases = cases_of(suite)
        kept["cases"] = [case for case in kept["cases"] if case["suite"] != suite] + cases
        kept.setdefault("seconds", {})[suite] = time.perf_counter() - began
    if options.assess:
        kept["assess"] = timed_assessment()
    if options.suites or options.assess:
        RESULTS.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
    page, _ = page_module("parts").made("two_directions")
    print(page.text)
    if options.write:
        page.write()


if __name__ == "__main__":
    main()
