"""Risk-targeted shares and annual rates by friction and limit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import product
from typing import Any, Final

import numpy as np

import seismass as sm
from pages.effective_mass import far_field_components
from pages.parts import Page

CASES: Final = tuple(product((0.1, 0.2, 0.3), (0.005, 0.01, 0.02, 0.03)))
"""Frictions and limits of the drift ratio."""
SHARES: Final = np.linspace(0.0, 1.0, 11)


def fill(page: Page) -> dict[str, Any]:
    """Put in the answer to the example, the shares that are asked for, and return what the example defines."""
    names = page.example()
    page.block("answer", names["answer"].text.splitlines())
    if page.wants("limits"):
        page.block("limits", limits(names, sm.builtin_suite("seven"), CASES))
    if page.wants("far_field"):
        page.block("far_field", limits(names, far_field_components(page.records), CASES[4:8]))
    page.figure("risk", names.get, "figure")
    return names


def limits(names: Mapping[str, Any], motions: Any, cases: Iterable[tuple[float, float]]) -> list[str]:
    """Return rows of the share and of rates of the building of the example, each of a friction and a limit."""
    lines = [
        f"{'mu':>4}{'drift ratio':>13}{'share':>20}{'kind':>10}{'rate, goods slide':>20}{'slide / code, 0.25':>23}"
    ]
    for mu, limit in cases:
        scene = sm.Scene(names["building"], sm.blocks_on_floors([1.0, 1.0, 0.0], mu=mu))
        found = sm.risk.risk_targeted_share(scene, motions, names["hazard"], limit, shares=SHARES, other_limits=[])
        low, high = found.interval or (np.nan, np.nan)
        code = found.rates.row(1, named=True)
        share = f"{found.value:.2f} [{low:.2f}, {high:.2f}]"
        ends = code["real_over_model_low"], code["real_over_model_high"]
        ratio = f"{code['real_over_model']:.2f} [{ends[0]:.2f}, {ends[1]:.2f}]"
        lines.append(f"{mu:>4g}{100.0 * limit:>11g} %{share:>20}{found.kind:>10}{found.real:>20.2g}{ratio:>23}")
    return lines
