"""Writes docs/spring_loops.md and its figure: the spring laws of the kernel beside the loops of OpenSees that are kept.

The words are in tools/pages/spring_loops.md, the cases in benchmarks/spring_loops.py.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.figure import Figure

ROOT: Final = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "benchmarks"))

from seismass.media.figure_file import save_figure  # noqa: E402
from seismass.media.roles import BLUE, GREY, VERMILION  # noqa: E402
from seismass.media.style import STYLE  # noqa: E402
from spring_loops import CASES, DATA, FULL, PARTIAL, YIELD, YIELD_DRIFT, Case, FloatArray, drifts, kept  # noqa: E402

PAGE: Final = ROOT / "docs" / "spring_loops.md"
FIGURE: Final = ROOT / "docs" / "figures" / "spring_loops.png"
WORDS: Final = Path(__file__).parent / "pages" / "spring_loops.md"
NOT_DRAWN: Final = ("bilinear-bilin", "bilinear-imk", "multilinear-iwan", "gap-elastic", "cyclic-hardening-imk")
"""Cases of a law that is drawn already."""
ROUNDING: Final = 1e-12


def differences(case: Case, theirs: FloatArray) -> tuple[float, float]:
    """Largest difference of forces over V_y in the full and in the partial cycles."""
    path, parts = drifts()
    difference = np.abs(case.forces(path) - theirs) / YIELD
    return float(difference[parts == "full"].max()), float(difference[parts == "partial"].max())


def figure() -> Figure:
    """Loops of the cases that are drawn."""
    with mpl.rc_context(STYLE):
        path, theirs = drifts()[0], kept()
        drawn = [case for case in CASES if case.name not in NOT_DRAWN]
        made = Figure(figsize=(9.0, 10.2), layout="constrained")
        panels = made.subplots(4, 3, sharex=True).ravel()
        for panel, case in zip(panels, drawn, strict=True):
            x = np.concatenate(([0.0], path)) / YIELD_DRIFT
            ours, other = (np.concatenate(([0.0], force)) / YIELD for force in (case.forces(path), theirs[case.name]))
            panel.plot(x, ours, color=BLUE, linewidth=2.4, alpha=0.45, label="seismass")
            panel.plot(x, other, color=VERMILION, linewidth=0.8, label="OpenSees")
            panel.axhline(0.0, color=GREY, linewidth=0.5)
            panel.axvline(0.0, color=GREY, linewidth=0.5)
            panel.set_title(case.title, fontsize=8.0)
            panel.margins(y=0.16)
            panel.text(0.02, 0.97, case.material, transform=panel.transAxes, va="top", fontsize=7.0)
        for panel in panels[-3:]:
            panel.set_xlabel("drift / yield drift")
        for panel in panels[::3]:
            panel.set_ylabel("force / yield shear")
        handles, labels = panels[0].get_legend_handles_labels()
        made.legend(handles, labels, loc="outside upper center", ncols=2, frameon=False)
    return made


def page() -> str:
    """The page, from the loops that are kept."""
    theirs = kept()
    found = {case.name: differences(case, theirs[case.name]) for case in CASES}
    rows = []
    for case in CASES:
        full, partial = found[case.name]
        material = case.material.replace(", ", "`, `")
        rows.append(f"| {case.title} | `{material}` | {full:.1e} | {partial:.1e} | {case.reason} |")
    version = pl.read_parquet(DATA).row(0, named=True)
    text = WORDS.read_text(encoding="utf-8").format(
        full=", ".join(f"{turn:g}" for turn in FULL),
        partial=", ".join(f"{turn:g}" for turn in PARTIAL),
        points=drifts()[0].size,
        versions=f"OpenSees {version['version']} (openseespy {version['openseespy']}, {version['platform']})",
        rows="\n".join(rows),
        cases=len(CASES),
        same=sum(max(pair) < ROUNDING for pair in found.values()),
        same_full=sum(full < ROUNDING for full, _ in found.values()),
        figure=FIGURE.relative_to(PAGE.parent),
        local=min(turn for turn in PARTIAL[:5] if turn < 0.0),
        worst=max(partial for name, (_, partial) in found.items() if name.endswith("imk") and "bilinear" not in name),
        hardening=found["cyclic-hardening-imk"][0],
    )
    return text


def main() -> int:
    """Write the page and its figure."""
    PAGE.write_text(page(), encoding="utf-8")
    save_figure(figure(), "png", FIGURE)
    print(f"wrote {PAGE} and {FIGURE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
