"""Writes the numbers and the figure of docs/risk.md.

Usage: tools/risk_page.py [SHARED], a folder with `records`, without which the table of recordings stays as it is.
"""

from __future__ import annotations

import runpy
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

import seismass as sm
from seismass.media.figure_file import save_figure

ROOT: Final = Path(__file__).parents[1]
PARTS: Final = runpy.run_path(str(ROOT / "tools" / "page_parts.py"))
PAGE: Final = ROOT / "docs" / "risk.md"
FIGURE: Final = ROOT / "docs" / "figures" / "risk.png"
FRICTIONS: Final = (0.1, 0.2, 0.3)
LIMITS: Final = (0.005, 0.01, 0.02, 0.03)
SHARES: Final = np.linspace(0.0, 1.0, 11)

example, with_block = PARTS["example"], PARTS["with_block"]


def limits(building: sm.Building, motions: Any, hazard: sm.risk.HazardCurve, frictions: tuple[float, ...]) -> list[str]:
    """Return rows of the share and of rates by friction and limit."""
    lines = [
        f"{'mu':>4}{'drift ratio':>13}{'share':>20}{'kind':>10}{'rate, goods slide':>20}{'slide / code, 0.25':>23}"
    ]
    for mu in frictions:
        scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=mu))
        for limit in LIMITS:
            found = sm.risk.risk_targeted_share(scene, motions, hazard, limit, shares=SHARES, other_limits=[])
            low, high = found.interval or (np.nan, np.nan)
            code = found.rates.row(1, named=True)
            share = f"{found.value:.2f} [{low:.2f}, {high:.2f}]"
            ends = code["real_over_model_low"], code["real_over_model_high"]
            ratio = f"{code['real_over_model']:.2f} [{ends[0]:.2f}, {ends[1]:.2f}]"
            lines.append(f"{mu:>4g}{100.0 * limit:>11g} %{share:>20}{found.kind:>10}{found.real:>20.2g}{ratio:>23}")
    return lines


def blocks(names: Mapping[str, Any]) -> dict[str, list[str]]:
    """Return the blocks of numbers that need no recordings, by key."""
    building, hazard = names["building"], names["hazard"]
    return {
        "answer": names["answer"].text.splitlines(),
        "limits": limits(building, sm.builtin_suite("seven"), hazard, FRICTIONS),
    }


def far_field(names: Mapping[str, Any], shared: Path) -> list[str]:
    """Return the table of shares under 42 recorded components."""
    suite = runpy.run_path(str(ROOT / "tools" / "effective_mass_page.py"))["far_field_components"]
    return limits(names["building"], suite(shared), names["hazard"], (0.2,))


def main(shared: Path | None) -> None:
    """Write the page and its figure."""
    page = PAGE.read_text(encoding="utf-8")
    names = example(page)
    for key, lines in blocks(names).items():
        page = with_block(page, key, lines)
    if shared is not None:
        page = with_block(page, "far_field", far_field(names, shared))
    PAGE.write_text(page, encoding="utf-8")
    save_figure(names["figure"], "png", FIGURE)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]) if len(sys.argv) == 2 else None)
