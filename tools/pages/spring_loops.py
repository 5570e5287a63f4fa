"""The spring laws of the kernel beside the loops of OpenSees that benchmarks/spring_loops.py keeps."""

from __future__ import annotations

import sys
from typing import Final

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.figure import Figure

from pages.parts import ROOT, Page, table
from seismass.media.roles import GREY, KINDS, SLIDE
from seismass.media.style import STYLE

sys.path.append(str(ROOT / "benchmarks"))

from spring_loops import CASES, DATA, FULL, PARTIAL, YIELD, YIELD_DRIFT, Case, FloatArray, drifts, kept

NOT_DRAWN: Final = ("bilinear-bilin", "bilinear-imk", "multilinear-iwan", "gap-elastic", "cyclic-hardening-imk")
"""Cases of a law that is drawn already."""
ROUNDING: Final = 1e-12


def fill(page: Page) -> None:
    """Put in the table of differences and what is said of them."""
    found = {case.name: differences(case, kept()[case.name]) for case in CASES}
    rows = []
    for case in CASES:
        material = case.material.replace(", ", "`, `")
        rows.append([case.title, f"`{material}`", *(f"{most:.1e}" for most in found[case.name]), case.reason])
    page.tables(table("law | material of OpenSees | full cycles | partial cycles | explanation", rows))
    version = pl.read_parquet(DATA).row(0, named=True)
    turns = [", ".join(f"{turn:g}" for turn in part) for part in (FULL, PARTIAL)]
    of_imk = [partial for name, (_, partial) in found.items() if name.endswith("imk") and "bilinear" not in name]
    page.words("full cycles: {} partial cycles: {} The partial", *turns)
    page.words("every 0.1 d_y, {} drifts", drifts()[0].size)
    versions = (version[key] for key in ("version", "openseespy", "platform"))
    page.words("versions: OpenSees {} (openseespy {}, {}).", *versions)
    whole = sum(max(pair) < ROUNDING for pair in found.values())
    full = sum(most < ROUNDING for most, _ in found.values())
    said = "rounding. {} of the {} cases agree to rounding on the whole path, and {} in the full cycles."
    page.words(said, whole, len(CASES), full)
    page.words("After a cycle to {} d_y within", f"{min(turn for turn in PARTIAL[:5] if turn < 0.0):g}")
    page.words("changes the force by up to {} V_y.", f"{max(of_imk):.2f}")
    page.words("they differ by up to {} V_y in the full", f"{found['cyclic-hardening-imk'][0]:.4f}")
    page.figure("spring_loops", figure)


def differences(case: Case, theirs: FloatArray) -> tuple[float, float]:
    """Return the largest difference of forces over V_y in the full and in the partial cycles."""
    path, parts = drifts()
    difference = np.abs(case.forces(path) - theirs) / YIELD
    return float(difference[parts == "full"].max()), float(difference[parts == "partial"].max())


def figure() -> Figure:
    """Return the figure of loops of the cases that are drawn."""
    with mpl.rc_context(STYLE):
        path, theirs = drifts()[0], kept()
        drawn = [case for case in CASES if case.name not in NOT_DRAWN]
        made = Figure(figsize=(9.0, 10.2), layout="constrained")
        panels = made.subplots(4, 3, sharex=True).ravel()
        for panel, case in zip(panels, drawn, strict=True):
            x = np.concatenate(([0.0], path)) / YIELD_DRIFT
            ours, other = (np.concatenate(([0.0], force)) / YIELD for force in (case.forces(path), theirs[case.name]))
            panel.plot(x, ours, color=SLIDE.colour, linewidth=2.4, alpha=0.45, label="seismass")
            panel.plot(x, other, color=KINDS[0], linewidth=0.8, label="OpenSees")
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
