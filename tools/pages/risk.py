"""Risk-targeted shares and annual rates by friction and limit."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

import seismass as sm
from pages.effective_mass import far_field_components
from pages.parts import Page

FRICTIONS: Final = (0.1, 0.2, 0.3)
LIMITS: Final = (0.005, 0.01, 0.02, 0.03)
SHARES: Final = np.linspace(0.0, 1.0, 11)


def fill(page: Page) -> dict[str, Any]:
    """Put in the answer to the example and the shares, and return what the example defines."""
    names = page.example()
    building, hazard = names["building"], names["hazard"]
    page.block("answer", names["answer"].text.splitlines())
    page.block("limits", limits(building, sm.builtin_suite("seven"), hazard, FRICTIONS))
    if page.shared:
        page.block("far_field", limits(building, far_field_components(page.records), hazard, (0.2,)))
    page.figure("risk", names.get, "figure")
    return names


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
