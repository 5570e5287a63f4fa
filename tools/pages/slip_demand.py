"""Slip by floor of an elastic and of a yielding building."""

from __future__ import annotations

from typing import Final

import seismass as sm
from pages.parts import Page

FRICTIONS: Final = (0.1, 0.2, 0.4)
STRENGTHS: Final[dict[str, list[float] | None]] = {"elastic": None, "yielding": [0.30, 0.26, 0.20, 0.12]}
"""Yield shears over the weight of the building."""


def fill(page: Page) -> list[str]:
    """Put in the answer to the example and the slip by floor, and return the latter."""
    names = page.example()
    found = floors(names["motions"])
    page.block("answer", names["answer"].text.splitlines())
    page.block("floors", found)
    page.figure("slip_demand", names.get, "figure")
    return found


def floors(motions: list[sm.Record]) -> list[str]:
    """Return rows of slip by floor of an elastic and of a yielding building."""
    lines = [f"{'building':10}{'mu':>5}  {'floor':8}{'mean slip (mm)':>16}{'remains':>9}{'over the ground':>24}"]
    for name, strength in STRENGTHS.items():
        building = sm.Building.uniform(4, 0.57, yield_shear_over_weight=strength)
        for mu in FRICTIONS:
            goods = [sm.Block(0, mass=1.0, mu=mu), *sm.blocks_on_floors([0.5] * 4, mu=mu)]
            found = sm.slip.slip_demand(sm.Scene(building, goods), motions)
            for row in found.blocks.iter_rows(named=True):
                place = f"floor {row['floor']}" if row["floor"] else "ground"
                ends = row["amplification_low"], row["amplification_high"]
                ratio = f"{row['amplification']:.2f} [{ends[0]:.2f}, {ends[1]:.2f}]" if row["floor"] else ""
                slip, remains = (f"{1e3 * row[key]:.0f}" for key in ("mean", "residual_mean"))
                lines.append(f"{name:10}{mu:>5g}  {place:8}{slip:>16}{remains:>9}{ratio:>24}".rstrip())
    return lines
