"""Figure of a share under uncertain live load: its distribution, and what moves it most."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from seismass.effective_mass.live_load import LiveLoadUncertainty
from seismass.media.result import named_figure
from seismass.media.roles import ADVISED, GREY, INK, MU, SLIDE, SLIDE_HIGH, lettered
from seismass.media.style import STYLE
from seismass.show.effective_mass.figures import STORAGE_CODES, marked_legend


def uncertainty_figure(result: LiveLoadUncertainty, name: str | None = None) -> Figure:
    """Cumulative distribution of the share with codes' fractions, above the tornado of friction and occupancy."""
    named_figure(result, name)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 5.6), layout="constrained")
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 1.2))
        share = np.sort(result.samples["share"].to_numpy())
        level = (np.arange(len(share)) + 0.5) / len(share)
        upper.plot(share, level, color=SLIDE.colour, linewidth=2.0, label="samples of friction and occupancy")
        upper.axvline(
            result.share, color=ADVISED.colour, linewidth=1.8, label=f"equal expected drift {result.share:.2f}"
        )
        if result.interval is not None:
            label = f"its 90 % interval over the records, {result.interval[0]:.2f} to {result.interval[1]:.2f}"
            upper.axvspan(*result.interval, color=ADVISED.colour, alpha=0.15, linewidth=0.0, label=label)
        upper.axvline(
            result.share_84,
            color=SLIDE_HIGH.colour,
            linewidth=1.6,
            linestyle=(0, (5, 2)),
            label=f"84 % of samples {result.share_84:.2f}",
        )
        for name, fraction in STORAGE_CODES.items():
            upper.axvline(fraction, ymin=0.94, ymax=1.0, color=INK, linewidth=1.4)
            upper.annotate(
                f"{name} ",
                (fraction, 0.93),
                xycoords=("data", "axes fraction"),
                rotation=90.0,
                ha="center",
                va="top",
                fontsize=7.0,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.85},
            )
        upper.set_ylim(0.0, 1.0)
        upper.set_xlim(-0.01, 1.01)
        upper.set_ylabel("probability of a smaller share")
        upper.grid(color=GREY, alpha=0.25, linewidth=0.5)
        rows = list(result.tornado.iter_rows(named=True))[::-1]
        for place, row in enumerate(rows):
            ends = (row["share_low"], row["share_high"])
            lower.barh(place, ends[1] - ends[0], left=ends[0], height=0.5, color=SLIDE.colour, alpha=0.5)
            for end, value, side in ((ends[0], row["low"], "right"), (ends[1], row["high"], "left")):
                outward = side if ends[0] <= ends[1] else {"right": "left", "left": "right"}[side]
                text = f" {value:.2g} "
                lower.annotate(text, (min(max(end, 0.04), 0.96), place), ha=outward, va="center", fontsize=8.0)
        lower.axvline(rows[0]["share_median"], color=INK, linewidth=0.9)
        lower.set_yticks(range(len(rows)), [lettered(row["variable"]) for row in rows])
        lower.set_ylim(-0.6, len(rows) - 0.4)
        lower.set_xlabel(
            "share of the design live load to attach as mass\n"
            "(bars: one variable at 5 and 95 %, the other at its median)"
        )
        lower.grid(axis="x", color=GREY, alpha=0.25, linewidth=0.5)
        figure.legend(*upper.get_legend_handles_labels(), loc="outside upper center", ncols=2, frameon=False)
        about = result.metadata
        figure.supxlabel(
            f"{about['samples']} samples, {about['motions']} motions; "
            f"{MU} {about['mu']}, occupancy {about['occupancy']}"
            f"{marked_legend(STORAGE_CODES)}",
            fontsize=7.5,
        )
    return figure
