"""The figures: time against error, log-log; one panel for the head of the page, all scenes for the page."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import polars as pl
from matplotlib.figure import Figure

from front import points
from scenes import BenchmarkScene
from seismass.media.roles import GREY, INK, KINDS, SLIDE

mpl.use("Agg")

STYLES: Final[tuple[tuple[str, str, str, str], ...]] = (
    ("seismass, exact", SLIDE.colour, "*", "-"),
    ("leapfrog, Rust", KINDS[3], "o", "-"),
    ("leapfrog, numba", KINDS[3], "s", "--"),
    ("Gauss-Legendre 4, located", INK, "^", "-"),
    ("Gauss-Legendre 4", INK, "v", ":"),
    ("Newmark, located", KINDS[1], "^", "-"),
    ("Newmark", KINDS[1], "v", ":"),
    ("Newmark, friction spring", KINDS[1], "x", ""),
    ("OpenSees, friction spring", KINDS[0], "o", "-"),
    ("OpenSees, CoulombDamper", KINDS[0], "s", "--"),
    ("OpenSees, central difference", KINDS[0], "^", ":"),
    ("OpenSees, modalDamping", KINDS[0], "x", ""),
    ("SciPy DOP853, events and samples", KINDS[2], "o", "-"),
    ("SciPy DOP853, events", KINDS[2], "s", "--"),
    ("SciPy DOP853, tanh friction", KINDS[2], "o", ":"),
    ("SciPy Radau, tanh friction", KINDS[2], "s", ":"),
    ("SciPy LSODA, tanh friction", KINDS[2], "^", ":"),
    ("heyoka, events and samples", GREY, "D", "-"),
    ("diffsol, events and samples", GREY, "v", "--"),
)
"""Family, colour, marker, line."""
LABEL: Final = "largest error of the drift history / peak drift"


def _panel(axes: Any, table: pl.DataFrame, scene: str) -> None:
    for family, colour, marker, line in STYLES:
        found = points(table, scene, "drift_error", [family])
        if found:
            errors, times = zip(*found, strict=True)
            axes.loglog(
                times,
                errors,
                color=colour,
                marker=marker,
                linestyle=line or "none",
                markersize=13 if marker == "*" else 5,
                markerfacecolor="none" if line in ("--", ":") else colour,
                linewidth=1.2,
                zorder=5 if marker == "*" else 2,
                label=family,
            )
    axes.grid(visible=True, which="major", color=GREY, linewidth=0.4, alpha=0.5)
    axes.spines[["top", "right"]].set_visible(False)


def main_figure(table: pl.DataFrame, bench: BenchmarkScene, path: Path) -> None:
    """Draw the scene of the head of the page."""
    figure = Figure(figsize=(8.6, 5.2), layout="constrained")
    axes = figure.subplots()
    _panel(axes, table, bench.name)
    axes.set_xlabel("time of one run (s)")
    axes.set_ylabel(LABEL)
    axes.set_title(f"{bench.title}; {bench.motion_name}, {bench.motion.duration:.0f} s", fontsize=10, loc="left")
    figure.legend(loc="outside right center", fontsize=7.5, frameon=False)
    figure.savefig(path, dpi=160)


def scenes_figure(table: pl.DataFrame, benches: list[BenchmarkScene], path: Path) -> None:
    """Draw every scene."""
    columns = 2
    rows = -(-(len(benches) + 1) // columns)
    figure = Figure(figsize=(9.5, 3.1 * rows), layout="constrained")
    grid = figure.subplots(rows, columns, sharex=True, sharey=True).ravel()
    for axes, bench in zip(grid, benches, strict=False):
        _panel(axes, table, bench.name)
        axes.set_title(bench.title, fontsize=9, loc="left")
    handles = {label: handle for axes in grid for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)}
    for axes in grid[len(benches) :]:
        axes.axis("off")
    grid[-1].legend(handles.values(), handles.keys(), loc="center", fontsize=7, frameon=False, ncols=2)
    figure.supxlabel("time of one run (s)", fontsize=10)
    figure.supylabel(LABEL, fontsize=10)
    figure.savefig(path, dpi=130)
