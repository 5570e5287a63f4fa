"""The figure of docs/performance.md: time per sample against storeys, log-log."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
from matplotlib.figure import Figure

from seismass.media.roles import GREY, KINDS, SLIDE

mpl.use("Agg")

STYLES: Final = (
    ("Rayleigh, calm", SLIDE.colour, "o", "-"),
    ("Rayleigh, strong", SLIDE.colour, "s", "--"),
    ("modal, calm", KINDS[0], "o", "-"),
    ("modal, strong", KINDS[0], "s", "--"),
)
"""Curve, colour, marker, line."""
SLOPES: Final = ((1.0, "n"), (2.0, "n$^2$"))
"""Exponents drawn for comparison."""


def storeys_figure(data: Mapping[str, Any], path: Path) -> None:
    """Draw the growth in storeys."""
    found, exponents = data["storeys"], data["exponents"]
    storeys = found["storeys"]
    figure = Figure(figsize=(7.2, 4.4), layout="constrained")
    axes = figure.subplots()
    for name, colour, marker, line in STYLES:
        axes.loglog(
            storeys,
            [1e6 * time for time in found[name]],
            color=colour,
            marker=marker,
            linestyle=line,
            markersize=5,
            markerfacecolor="none" if line == "--" else colour,
            linewidth=1.2,
            label=f"{name} (n$^{{{exponents[name]:.2f}}}$)",
        )
    start = 1e6 * min(found[name][0] for name, *_ in STYLES)
    for power, label in SLOPES:
        ends = (storeys[0], storeys[-1])
        reference = [0.6 * start * (n / storeys[0]) ** power for n in ends]
        axes.loglog(ends, reference, color=GREY, linewidth=0.8, linestyle=":")
        axes.annotate(label, (ends[1], reference[1]), fontsize=8, color=GREY)
    axes.set_xlabel("storeys")
    axes.set_ylabel("time per sample (us)")
    axes.set_title("Single runs, peaks only; calm: without events", fontsize=10, loc="left")
    axes.grid(visible=True, which="major", color=GREY, linewidth=0.4, alpha=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside right center", fontsize=8, frameon=False)
    figure.savefig(path, dpi=140)
