"""Writes the figures of docs/plots.md: those that the code of the page makes.

Usage: python tools/plots_page.py
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Final

from seismass.media.figure_file import save_figure

ROOT: Final = Path(__file__).parents[1]
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


def made() -> dict[str, Any]:
    """Run the code of the page, in order, and return what it defines."""
    page = (ROOT / "docs" / "plots.md").read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    for block in re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        exec(compile(block, "docs/plots.md", "exec"), names)
    return names


def main() -> None:
    """Write the figures."""
    names = made()
    for name, file in FIGURES.items():
        save_figure(names[name], "png", ROOT / "docs" / "figures" / f"{file}.png")


if __name__ == "__main__":
    main()
