"""The paper's section-4 building under the Brawley record, by second slope."""

from __future__ import annotations

from typing import Final

import seismass as sm
from pages.parts import Page, table

COMPONENTS: Final = ("225", "315")
SECOND_SLOPES: Final = (0.02, 0.05, 0.1, 0.5)
PEAK_G: Final = 0.7
STOREYS: Final = 3


def run(record: sm.Record, second_slope: float) -> tuple[list[str], bool, int]:
    """Return the numbers of a row, whether all storeys yield, and the floor that slides most (from 1)."""
    building = sm.Building.uniform(
        STOREYS, 0.60, yield_shear_over_weight=[0.24, 0.20, 0.12], overstrength=2.0, second_slope=second_slope
    )
    scene = sm.Scene(building, sm.blocks_on_floors([1.0] * STOREYS, mu=0.3))
    response = sm.simulate(scene, record.scaled(PEAK_G / record.pga_g))
    yields = response.events.filter(kind="yield")["number"].to_list()
    counts = [yields.count(storey) for storey in range(1, STOREYS + 1)]
    most = int(response.peak_slip.argmax()) + 1
    drift, slip = (" / ".join(f"{1e3 * value:.1f}" for value in of) for of in (response.peak_drift, response.peak_slip))
    said = "yes" if all(counts) else "no"
    yielded = " / ".join(map(str, counts))
    return [drift, yielded, said, slip, f"floor {most}", str(response.events.height)], all(counts), most


def fill(page: Page) -> None:
    """Put in the table, and what it shows."""
    folder = page.records / "03_Imperial_Valley_1979_Brawley_Airport"
    rows, all_yield, first = [], True, dict.fromkeys(SECOND_SLOPES, 0)
    for component in COMPONENTS:
        record = sm.read_record(folder / f"RSN161_IMPVALL.H_H-BRA{component}.AT2")
        for second_slope in SECOND_SLOPES:
            cells, yields, most = run(record, second_slope)
            rows.append([component, f"{second_slope:g}", *cells])
            all_yield &= yields
            first[second_slope] += most == 1
    page.tables(table("component | r2 | peak drift | yields | all yield | peak slip | slides most | events", rows))
    counts = ",\n".join(f"{count} of {len(COMPONENTS)} runs with r2 = {r2:g}" for r2, count in first.items())
    page.words("scaled to a peak of {} g.", PEAK_G)
    yielding = "every run" if all_yield else "not every run"
    page.words("All storeys yield in {}. The first floor slides most in {}. The floor", yielding, counts)
