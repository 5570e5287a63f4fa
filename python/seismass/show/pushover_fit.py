"""Springs fitted to pushover curves: as a table with their misfit, and drawn over the curves."""

from __future__ import annotations

from typing import Final

import numpy as np
from matplotlib.figure import Figure

from seismass.design import PushoverFit
from seismass.media.result import named_figure
from seismass.media.roles import INK, SLIDE, YIELDS
from seismass.media.style import columns, drawing, grid_lines
from seismass.media.text_table import text_table

_ROW: Final = 4
"""Most curves beside one another."""


def pushover_fit_text(fit: PushoverFit) -> str:
    """Return the springs and the misfit, and what was assumed."""
    curves = "a curve of the whole building" if fit.of_roof else "curves of storeys"
    lines = 3 if (fit.overstrength > 1.0).any() else 2
    head = ["storey", "k kN/m", "V_y kN", "yields at mm", *(["Omega", "r2", "r3"] if lines == 3 else ["r2"])]
    rows = [head]
    for i in reversed(range(len(fit.stiffness))):
        of_lines = (fit.overstrength, fit.second_slope, fit.third_slope) if lines == 3 else (fit.second_slope,)
        rows.append(
            [
                str(i + 1),
                f"{1e-3 * fit.stiffness[i]:.6g}",
                f"{1e-3 * fit.yield_shear[i]:.5g}",
                f"{1e3 * fit.corner_drift[i]:.2f}",
                *(f"{values[i]:.4f}" for values in of_lines),
            ]
        )
    misfit = [["curve", "samples", "peak shear kN", "largest misfit", "rms misfit"]]
    for number in reversed(range(len(fit.drift))):
        misfit.append(
            [
                "roof" if fit.of_roof else f"storey {number + 1}",
                str(len(fit.drift[number]) - 1),
                f"{1e-3 * fit.shear[number].max():.5g}",
                f"{100.0 * fit.largest_misfit[number]:.2f} %",
                f"{100.0 * fit.rms_misfit[number]:.2f} %",
            ]
        )
    return "\n".join(
        [
            f"Springs of {lines} lines fitted to {curves}",
            *text_table(rows),
            "Misfit of the shear, over the largest shear of the curve",
            *text_table(misfit),
            "Assumptions",
            *(f"  - {sentence}" for sentence in fit.assumptions),
        ]
    )


@drawing()
def pushover_fit_figure(fit: PushoverFit, name: str | None = None) -> Figure:
    """Draw each curve, the springs fitted to it, and their corners."""
    named_figure(fit, name)
    count = len(fit.drift)
    width, height = (5.6, 4.0) if count == 1 else (2.9, 2.7)
    place = columns(None, count, "figure of pushover_fit", width=width, height=height, most=_ROW)
    for number, axes in enumerate(place.axes):
        drift, shear, fitted = (1e3 * fit.drift[number], 1e-3 * fit.shear[number], 1e-3 * fit.fitted[number])
        every = max(1, len(drift) // 40)
        handle = axes.plot(drift, shear, "o", markersize=3.0, color=INK, markevery=every, label="curve")[0]
        corner_drifts, force = ([], []) if fit.of_roof else _corners(fit, number)
        along = np.argsort([*drift, *corner_drifts], kind="stable")
        bent = np.array([*drift, *corner_drifts])[along], np.array([*fitted, *force])[along]
        line = axes.plot(*bent, color=SLIDE.colour, linewidth=1.5, label="springs")[0]
        corner = None
        if corner_drifts:
            corner = axes.plot(
                corner_drifts, force, "o", markersize=7.0, markerfacecolor="none", color=YIELDS.colour, label="corner"
            )[0]
        axes.set_ylim(bottom=0.0)
        axes.set_xlim(left=0.0)
        label = "roof" if fit.of_roof else f"storey {number + 1}"
        axes.set_title(
            f"{label}: misfit {100 * fit.largest_misfit[number]:.2g} %, rms {100 * fit.rms_misfit[number]:.2g} %"
        )
        axes.set_xlabel("displacement of the roof (mm)" if fit.of_roof else "drift (mm)")
        grid_lines(axes)
    for axes in place.left:
        axes.set_ylabel("base shear (kN)" if fit.of_roof else "shear (kN)")
    place.legend([handle, line] if corner is None else [handle, line, corner])
    return place.figure


def _corners(fit: PushoverFit, storey: int) -> tuple[list[float], list[float]]:
    """Corners of a storey's spring within its curve, mm and kN."""
    first, strength = fit.corner_drift[storey], fit.yield_shear[storey]
    corner_drifts, force = [first], [strength]
    overstrength, second = fit.overstrength[storey], fit.second_slope[storey]
    if overstrength > 1.0 and second > 0.0:
        corner_drifts.append(first * (1.0 + (overstrength - 1.0) / second))
        force.append(overstrength * strength)
    is_drawn = np.array(corner_drifts) <= fit.drift[storey][-1]
    return [1e3 * x for x, known in zip(corner_drifts, is_drawn, strict=True) if known], [
        1e-3 * y for y, known in zip(force, is_drawn, strict=True) if known
    ]
