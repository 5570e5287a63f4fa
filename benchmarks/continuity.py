"""How far share and governing drift of an assessment move between neighbouring buildings, and what the cap does there.

    python benchmarks/continuity.py FILE... [--suite forty] [--records DIR] [--walk R,mu,T,load]

Buildings walk in R from 3.5 to 5.0 by 0.05, and in friction, period and live load in steps of 2 %. The share is the
largest effective fraction over the frictions, unrounded; the governing drift the largest of any storey. A walk of the
period holds what drift itself does with the period. "half step" is the largest move over half of the step that has the
largest: without a jump it is about half of that.
"""

from __future__ import annotations

import argparse
import copy
import tomllib
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import seismass as sm
from seismass.assessment.answer import rounded_up
from seismass.assessment.checks import checked_storeys, collapses_of, governing_table
from seismass.assessment.models import compared_models, friction_factors, scaled_to_site, solve_models
from seismass.effective_mass.answer import solved_frictions
from seismass.effective_mass.search import checked_options
from seismass.runs.peaks import named_motions

SHARES = np.linspace(0.0, 1.0, 21)
STEP = 0.02
PLACES = range(-5, 6)
STRENGTHS = np.arange(3.5, 5.0 + 1e-9, 0.05)


class Point(NamedTuple):
    """What is compared between neighbours."""

    share: float
    governing: float
    storeys: np.ndarray
    collapses: int


def answered(tables: dict[str, Any], suite: sm.records.Suite) -> Point:
    """Return share and governing drifts as `assess` has them, without a bootstrap and the share of a design."""
    building = sm.read_building(tables)
    scaling = scaled_to_site(building, suite)
    motions = [record.scaled(float(factor)) for record, factor in zip(suite, scaling.factors, strict=True)]
    scenes = [building.scene(mu_factor=factor) for factor in friction_factors(building.mu_factors).values()]
    options = checked_options("mean", "same", SHARES, 0.9, 1, 0, None, None, drift_cap=building.drift_cap)
    found = [one.answer() for one in solved_frictions(scenes, named_motions(motions, "continuity"), options)]
    share = max(one.value for one in found)
    runs, _ = solve_models(building, compared_models(building, None, rounded_up(share)), motions, scaling.names)
    governing = governing_table(building, checked_storeys(building, scenes[0], runs))["governing"].to_numpy()
    return Point(share, float(governing.max()), governing, max(collapses_of(runs).values()))


def changed(tables: dict[str, Any], walk: str, place: float) -> dict[str, Any]:
    """Return the tables of a building moved along a walk: to an R, or by a power of the step."""
    found, factor = copy.deepcopy(tables), (1.0 + STEP) ** place
    building, goods = found["building"], found.setdefault("goods", {})
    if walk == "R":
        building |= {"R": float(place), "design": True}
    elif walk == "T":
        building["period_s"] *= factor
    elif walk == "mu":
        kind = sm.read_building(tables).loose[0]
        for key in ("friction", "mu"):
            goods.pop(key, None)
        goods |= {"mu_s": kind.mu_s * factor, "mu_k": kind.mu_k * factor}
    else:
        for table in (goods, *found["storeys"]):
            table |= {key: table[key] * factor for key in ("live_load_kpa", "live_load") if key in table}
    return found


def moves(points: list[Point]) -> tuple[float, float, float]:
    """Return the largest move of the share, and relative ones of the governing drift and of that of any storey."""
    pairs = list(pairwise(points))
    share = max(abs(one.share - other.share) for one, other in pairs)
    governing = max(abs(other.governing / one.governing - 1.0) for one, other in pairs)
    return share, governing, max(float(np.abs(other.storeys / one.storeys - 1.0).max()) for one, other in pairs)


def rows(tables: dict[str, Any], suite: sm.records.Suite, walks: list[str]) -> Iterator[str]:
    """Yield a row of the table for each walk of a building."""
    for walk in walks:
        places = STRENGTHS if walk == "R" else PLACES
        points = [answered(changed(tables, walk, float(place)), suite) for place in places]
        share, governing, storeys = moves(points)
        middle = max(range(len(points) - 1), key=lambda at: abs(points[at + 1].governing / points[at].governing - 1.0))
        between = changed(tables, walk, 0.5 * float(places[middle] + places[middle + 1]))
        half = moves([points[middle], answered(between, suite), points[middle + 1]])[1]
        shares, drifts = [point.share for point in points], [100.0 * point.governing for point in points]
        fallen = [point.collapses for point in points]
        yield (
            f"| {tables.get('name', 'building')} | {suite.name} | {walk} | {share:.3f} | {100.0 * governing:.2f} | "
            f"{100.0 * half:.2f} | {100.0 * storeys:.1f} | {min(shares):.2f} to {max(shares):.2f} | "
            f"{min(drifts):.2f} to {max(drifts):.2f} | {min(fallen)} to {max(fallen)} of {len(suite)} |"
        )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("files", type=Path, nargs="+", metavar="FILE", help="building files with period_s and design")
    parser.add_argument("--suite", default="forty", help="built-in suite (forty)")
    parser.add_argument("--records", type=Path, metavar="DIR", help="folder of recordings, in place of a suite")
    parser.add_argument("--walk", default="R,mu,T,load", help="walks, with commas between them")
    args = parser.parse_args()
    suite = sm.builtin_suite(args.suite) if args.records is None else sm.records.read_suite(args.records)
    heads = "building | suite | walk | share moves by | governing drift, % | half step, % | any storey, % | share | "
    print(f"| {heads}governing drift, % of height | collapses |\n|{' --- |' * 10}", flush=True)
    for file in args.files:
        for row in rows(tomllib.loads(file.read_text(encoding="utf-8")), suite, args.walk.split(",")):
            print(row, flush=True)


if __name__ == "__main__":
    main()
