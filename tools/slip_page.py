"""Writes the numbers and the figure of docs/slip_demand.md.

Usage: tools/slip_page.py
"""

from __future__ import annotations

import runpy
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import seismass as sm
from seismass.media.figure_file import save_figure

ROOT: Final = Path(__file__).parents[1]
PARTS: Final = runpy.run_path(str(ROOT / "tools" / "page_parts.py"))
PAGE: Final = ROOT / "docs" / "slip_demand.md"
FIGURE: Final = ROOT / "docs" / "figures" / "slip_demand.png"
FRICTIONS: Final = (0.1, 0.2, 0.4)
STRENGTHS: Final[dict[str, list[float] | None]] = {"elastic": None, "yielding": [0.30, 0.26, 0.20, 0.12]}
"""Yield shears over the weight of the building."""

example, with_block = PARTS["example"], PARTS["with_block"]


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


def blocks(names: Mapping[str, Any]) -> dict[str, list[str]]:
    """Return the blocks of numbers by key."""
    return {"answer": names["answer"].text.splitlines(), "floors": floors(names["motions"])}


def main() -> None:
    """Write the page and its figure."""
    page = PAGE.read_text(encoding="utf-8")
    names = example(page)
    for key, lines in blocks(names).items():
        page = with_block(page, key, lines)
    PAGE.write_text(page, encoding="utf-8")
    save_figure(names["figure"], "png", FIGURE)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        sys.exit(__doc__)
    main()
