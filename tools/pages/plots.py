"""The figures that the code of the page makes."""

from __future__ import annotations

from typing import Any, Final

from pages.parts import Page

FIGURES: Final = {
    "figure": "plot_drift",
    "loops": "plot_loops",
    "profile": "plot_profile",
    "energy": "plot_energy",
    "events": "plot_events",
    "levels": "plot_rack_profile",
    "contacts": "plot_contacts",
    "ida": "plot_ida",
    "fragility": "plot_fragility",
}
"""Names in the code of the page, and the files in docs/figures."""


def fill(page: Page) -> dict[str, Any]:
    """Run the code of the page, in order, and return what it defines."""
    names = page.example()
    for name, file in FIGURES.items():
        page.figure(file, names.get, name)
    return names
