"""What moves the share of the design live load that acts as mass: how much is there, or the mechanics.

    benchmarks/occupancy.py [--write]

solves the warehouse of the example file under the forty built-in motions and prints the share of its *design* live load
to attach, one cause at a time away from the middle: goods present (surveys of storage, mean and one standard deviation
of floors that area), friction at its bounds, R, period, motions. `--write` puts the table into docs/effective_mass.md.
"""

from __future__ import annotations

import argparse
import math
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import seismass as sm
from environment import page_module
from seismass.assessment.building_file import example_file
from seismass.media.text_table import text_table
from seismass.model.occupancy import STORAGE, surveyed_load

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "effective_mass.md"


def share_of_design_load(tables: dict[str, Any], mu_factor: float = 1.0) -> tuple[float, tuple[float, float]]:
    """Return the share of the design live load to attach, and the same at the ends of its interval over suites."""
    building = sm.read_building(tables)
    suite = sm.builtin_suite("forty")
    scaling = sm.scaling.scale_asce7_10(suite, building.site_spectrum(), building.period(building.goods_mass))
    motions = [record.scaled(float(factor)) for record, factor in zip(suite, scaling.factors, strict=True)]
    found = sm.effective_mass(building.scene(mu_factor=mu_factor), motions, resamples=500)
    low, high = found.suite_interval or (math.nan, math.nan)
    present = building.present_share
    return present * found.value, (present * low, present * high)


def changed(**values: Any) -> dict[str, Any]:
    """Return the tables of the example file with values of [building] and [goods] in place of its own."""
    tables = tomllib.loads(example_file().read_text(encoding="utf-8"))
    for name, value in values.items():
        tables["goods" if name == "occupied" else "building"][name] = value
    return tables


def rows() -> Iterator[tuple[str, str, float, float]]:
    """Yield what is moved, from what to what, and both shares; the middle first."""
    tables = changed()
    load, area = tables["goods"]["live_load_kpa"], tables["building"]["area_m2"]
    survey = surveyed_load(STORAGE)
    mean, spread = survey.mean / load, survey.deviation(area) / load
    low, high = mean - spread, min(1.0, mean + spread)
    middle, interval = share_of_design_load(changed(occupied=mean))
    yield f"middle: {mean:.2f} present", "", middle, middle
    least, most = (share_of_design_load(changed(occupied=part))[0] for part in (low, high))
    yield "goods present", f"{low:.2f} to {high:.2f}", least, most
    full, _ = share_of_design_load(changed(occupied=1.0))
    yield "floors full", "1.00", full, full
    factors = tables["goods"]["mu_factors"]
    least, most = (share_of_design_load(changed(occupied=mean), factor)[0] for factor in factors)
    yield "friction", f"x {factors[0]:g} to {factors[1]:g}", least, most
    for name, what, values in (("R", "R", (2.0, 4.0)), ("period_s", "period, s", (0.45, 0.70))):
        least, most = (share_of_design_load(changed(occupied=mean, **{name: value}))[0] for value in values)
        yield what, f"{values[0]:g} to {values[1]:g}", least, most
    yield "motions", "90 % interval", interval[0], interval[1]


def table() -> list[str]:
    """Return the lines of the table."""
    lines = [["moved", "from - to", "share of the design live load", "span"]]
    for what, values, low, high in rows():
        shares = f"{low:.2f}" if low == high else f"{low:.2f} to {high:.2f}"
        lines.append([what, values, shares, "" if low == high else f"{abs(high - low):.2f}"])
    return text_table(lines, left=3, indent=0)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="write docs/effective_mass.md")
    options = parser.parse_args()
    found = table()
    print("\n".join(found))
    if options.write:
        page = page_module("parts").Page(PAGE)
        page.block("occupancy", found)
        page.write()
