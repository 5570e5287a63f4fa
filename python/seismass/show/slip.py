"""Figure and text of slip demand."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass.base.values import counted
from seismass.media.result import named_figure
from seismass.media.roles import GREY, INK, LIMIT, MU, PAPER, SLIDE
from seismass.media.style import SERIES, drawing, grid_lines, plain, say
from seismass.media.svg import CAPTION_CHARACTERS
from seismass.media.text_table import interval_text, number_text, text_line
from seismass.studies.slip.runs import TITLES

if TYPE_CHECKING:
    from seismass.studies.slip.demand import SlipDemand


_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_HEIGHT = 4.6


@drawing()
def slip_demand_figure(result: SlipDemand, name: str | None = None) -> Figure:
    """Return `SlipDemand.plot`."""
    named_figure(result, name)
    width = 8.4
    panels: list[Any] = [["blocks", "acceleration"], *([["fragilities"] * 2] if result.fragilities else [])]
    figure = Figure(figsize=(width, _HEIGHT * (0.85 * len(panels) + 0.15)), layout="constrained")
    axes = list(figure.subplot_mosaic(panels).values())
    _by_block(axes[0], result)
    _against_acceleration(axes[1], result)
    if result.fragilities:
        _fragilities(axes[2], result)
    handles = [
        Line2D(
            [],
            [],
            color=SLIDE.colour,
            marker=SLIDE.marker,
            linestyle="",
            markersize=5.0,
            label="in the building, each motion",
        ),
        Line2D(
            [],
            [],
            color=GREY,
            marker="o",
            markerfacecolor=PAPER,
            linestyle="",
            markersize=5.0,
            label="the same block on the ground",
        ),
        Line2D([], [], color=INK, marker="D", linewidth=1.6, markersize=5.0, label="mean, 16 to 84 % of the motions"),
    ]
    if result.exceedance.height:
        handles.append(Line2D([], [], color=LIMIT.colour, linestyle=LIMIT.line, linewidth=1.2, label="clearance"))
    figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False)
    worst = result.blocks.sort("p84", nulls_last=True, descending=True).row(0, named=True)
    place = ("" if worst["floor"] else "the ") + _floor(result, worst)
    known = worst["p84"] is not None and math.isfinite(worst["p84"])
    words = f"{1e3 * worst['p84']:.0f} mm of slip at 84 % of the motions" if known else "runs that collapse"
    axes[0].set_title(f"Block {worst['block']} on {place}: {words}", loc="left")
    figure.supxlabel(textwrap.fill(_caption(result), int(CAPTION_CHARACTERS * width)), fontsize=7.5)
    return figure


def _by_block(axes: Axes, result: SlipDemand) -> None:
    """Slip of every motion by block, in the building and beside it on the ground."""
    labels = []
    for place, row in enumerate(result.blocks.iter_rows(named=True)):
        runs = result.runs.filter(block=row["block"], collapsed=False)
        lost = result.runs.filter(block=row["block"], collapsed=True).height
        for column, offset, colour, fill in (
            ("peak_slip", 0.14, SLIDE.colour, SLIDE.colour),
            ("ground_slip", -0.14, GREY, PAPER),
        ):
            values = 1e3 * runs[column].to_numpy()
            axes.plot(
                values,
                np.full(len(values), place + offset),
                color=colour,
                marker="o",
                markerfacecolor=fill,
                markersize=4.5,
                linestyle="",
                alpha=0.8,
            )
        for prefix, offset in (("", 0.14), ("ground_", -0.14)):
            low, mean, high = (row[prefix + name] for name in ("p16", "mean", "p84"))
            if np.isfinite([low, mean, high]).all():
                axes.hlines(place + offset, 1e3 * low, 1e3 * high, color=INK, linewidth=1.6)
                axes.plot([1e3 * mean], [place + offset], color=INK, marker="D", markersize=5.0)
        for limit in result.exceedance.filter(block=row["block"], side="any")["clearance"]:
            axes.vlines(1e3 * limit, place - 0.4, place + 0.4, color=LIMIT.colour, linestyle=LIMIT.line, linewidth=1.2)
        name = _floor(result, row)
        if row.get("rack"):
            name = f"rack {row['rack']}, level {row['level']}"
        collapses = f"\n{lost} collapsed" if lost else ""
        labels.append(f"block {row['block']}, {name}\n{MU} = {row['mu_s']:g}{collapses}")
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(-0.6, len(labels) - 0.4)
    slides = bool((result.runs["peak_slip"] > 0.0).any())
    axes.set_xlim(0.0, None if slides or axes.dataLim.x1 > 0.0 else 1.0)
    if not slides:
        say(axes, "nothing slides in the building")
    axes.set_xlabel("peak slip (mm)")
    grid_lines(axes)


def _against_acceleration(axes: Axes, result: SlipDemand) -> None:
    """Slip against friction over the peak acceleration of the floor with all goods attached."""
    handles = []
    for place, row in enumerate(result.blocks.iter_rows(named=True)):
        runs = result.runs.filter(block=row["block"], collapsed=False).drop_nulls("mu_over_attached")
        look = {**SERIES[place % len(SERIES)], "linestyle": "", "marker": _MARKERS[place % len(_MARKERS)]}
        axes.plot(runs["mu_over_attached"], 1e3 * runs["peak_slip"].to_numpy(), **look, markersize=4.5, alpha=0.8)
        handles.append(Line2D([], [], **look, markersize=5.0, label=f"block {row['block']}"))
    axes.axvline(1.0, color=INK, linewidth=0.8)
    values = result.runs.filter(collapsed=False)["mu_over_attached"].drop_nulls().to_numpy()
    axes.set_xlim(0.8 * float(np.min(values, initial=1.0)), 1.1 * float(np.max(values, initial=1.0)))
    slides = bool((result.runs["peak_slip"] > 0.0).any())
    axes.set_ylim(0.0, None if slides else 1.0)
    if not slides:
        say(axes, "nothing slides")
    axes.set_xlabel(f"{MU} g / peak floor acceleration, all goods attached")
    axes.set_ylabel("peak slip (mm)")
    axes.legend(handles=handles, fontsize=8.0, frameon=False)
    grid_lines(axes)


def _fragilities(axes: Axes, result: SlipDemand) -> None:
    """Probability of reaching the clearance of each block by intensity, with its interval."""
    fits = result.fragilities.items()
    finite = [fit.median for _, fit in fits if np.isfinite(fit.median) and fit.median > 0.0]
    highest = 3.0 * max(finite, default=1.0)
    intensities = np.linspace(0.0, highest, 301)
    for place, (block, fit) in enumerate(fits):
        look = SERIES[place % len(SERIES)]
        low, high = fit.band(intensities)
        axes.fill_between(intensities, low, high, color=look["color"], alpha=0.15, linewidth=0.0)
        axes.plot(intensities, fit.probability(intensities), **look, linewidth=1.8, label=f"block {block}")
    axes.set_xlim(0.0, highest)
    axes.set_ylim(0.0, 1.0)
    measure = result.metadata["measure"]
    axes.set_xlabel(f"{measure['label']} (g)" if measure["name"] != "scale" else measure["label"])
    axes.set_ylabel("probability that the clearance is reached")
    axes.legend(fontsize=8.0, frameon=False)
    grid_lines(axes)


def _caption(result: SlipDemand) -> str:
    metadata = result.metadata
    rocking = result.squat.filter(result.squat["rocks_first"])["block"].to_list()
    notes = [f"{metadata['motions']} motions", "slip of rigid blocks that do not rock and meet no obstacle"]
    if rocking:
        notes.append(f"block {', '.join(map(str, rocking))} would rock before it slides")
    return plain("; ".join(notes))


_LABEL: Final = 12
_SLIPS: Final = (-16, 30, 9, 8, 30, 8)
_RATIOS: Final = (-16, 24, 26, 24, 12)
_DIRECTIONS: Final = (-16, 14, 14, 9, 9, 9)
_ESTIMATES: Final = (-8, -16, -34, 8, 9, 8)


def slip_demand_text(result: SlipDemand) -> str:
    """Return `SlipDemand.text`."""
    lines = _blocks(result)
    for part in (_directions(result), _contacts(result), _exceedance(result), _squat(result), _estimates(result)):
        if part:
            lines += ["", *part]
    return "\n".join([*lines, "", *remark_lines(result.remarks, _LABEL)])


def remark_lines(remarks: Iterable[str], indent: int) -> list[str]:
    """Return remarks as lines of at most 120 characters, indented by their label."""
    lines = []
    for remark in remarks:
        first = f"{'remark':{indent}}"
        lines += textwrap.wrap(remark, 120, initial_indent=first, subsequent_indent=" " * indent)
    return lines


def _blocks(result: SlipDemand) -> list[str]:
    motions = counted(result.metadata["motions"], "motion")
    what = "Length of the peak slip" if "x_mean" in result.blocks.columns else "Peak slip"
    lines = [
        f"{what} (mm): mean of {motions} [16 %, 84 % of them], largest; share of motions that slide",
        text_line(("block", "in the building", "largest", "slides", "on the ground", "slides"), _SLIPS),
    ]
    for row in result.blocks.iter_rows(named=True):
        name = f"{row['block']}, {_place(result, row)}"
        here = f"{_mm(row['mean'])} [{_mm(row['p16'])}, {_mm(row['p84'])}]"
        ground = f"{_mm(row['ground_mean'])} [{_mm(row['ground_p16'])}, {_mm(row['ground_p84'])}]"
        slides, ground_slides = _percent(row["slides"]), _percent(row["ground_slides"])
        lines.append(text_line((name, here, _mm(row["largest"]), slides, ground, ground_slides), _SLIPS))
    lines += ["", "Slip that remains (mm), slip over that on the ground, friction over floor acceleration"]
    lines.append(text_line(("block", "remains", "building/ground", "motion by motion", "mu_s g/PFA"), _RATIOS))
    for row in result.blocks.iter_rows(named=True):
        name = f"{row['block']}, {_place(result, row)}"
        remains = f"{_mm(row['residual_mean'])} [{_mm(row['residual_p16'])}, {_mm(row['residual_p84'])}]"
        pooled = interval_text(row["amplification"], row["amplification_low"], row["amplification_high"])
        each = interval_text(row["amplification_median"], row["amplification_p16"], row["amplification_p84"])
        lines.append(text_line((name, remains, pooled, each, number_text(row["mu_over_attached"])), _RATIOS))
        if row["slides_on_floor_only"]:
            lines.append(
                f"  {'':16}slides in the building alone under {counted(row['slides_on_floor_only'], 'motion')}"
            )
    lines.append(
        f"  building/ground: ratio of means with its {100 * result.confidence:g} % interval; motion by motion: median "
        f"[16 %, 84 %];"
    )
    lines.append("  PFA: peak floor acceleration with all goods attached, mean of the ratio")
    return lines


def _directions(result: SlipDemand) -> list[str]:
    """Slip by direction, beside that of one direction alone; nothing in one direction."""
    if "x_mean" not in result.blocks.columns:
        return []
    lines = [
        "Peak slip by direction (mm): mean and largest in x and in y; mean path; over that of one direction alone",
        text_line(("block", "x", "y", "path", "in each", "length"), _DIRECTIONS),
    ]
    for row in result.blocks.iter_rows(named=True):
        of_axes = (f"{_mm(row[f'{axis}_mean'])}, {_mm(row[f'{axis}_largest'])}" for axis in "xy")
        rest = (number_text(row[name]) for name in ("over_one_direction", "length_over_one_direction"))
        lines.append(
            text_line((f"{row['block']}, {_place(result, row)}", *of_axes, _mm(row["path_mean"]), *rest), _DIRECTIONS)
        )
    return [*lines, "  in each: means of the peaks in x and in y over those of each direction under its motion alone"]


def _contacts(result: SlipDemand) -> list[str]:
    """What goods do to their stops; nothing without them."""
    if "touches" not in result.blocks.columns:
        return []
    lines = ["Stops: share of motions that touch, velocity at contact (m/s) and contact force (kN), 84 % and largest"]
    for row in result.blocks.filter(pl.col("touches") > 0.0).iter_rows(named=True):
        velocity = f"{number_text(row['contact_velocity_p84'])}, {number_text(row['contact_velocity_largest'])} m/s"
        force = ", ".join(number_text(row[f"contact_force_{end}"], scale=1e-3) for end in ("p84", "largest"))
        name = f"{row['block']}, {_place(result, row)}"
        lines.append(f"  {name:16}{_percent(row['touches']):>8}   {velocity:24}{force} kN")
    return lines if len(lines) > 1 else [f"{lines[0][:5]}: no goods touch any"]


def _exceedance(result: SlipDemand) -> list[str]:
    if not result.exceedance.height:
        return []
    lines = [f"Clearance reached: share of motions, {100 * result.confidence:g} % interval (Wilson)"]
    for row in result.exceedance.iter_rows(named=True):
        lines.append(
            f"  block {row['block']}, side {row['side']:4}{1e3 * row['clearance']:6.0f} mm   {row['exceeding']} of "
            f"{row['motions']}: {_percent(row['probability'])} [{_percent(row['low'])}, {_percent(row['high'])}]"
        )
    for block, fit in result.fragilities.items():
        first, *rest = fit.text.splitlines()
        lines.append(f"  block {block}, by {result.metadata['measure']['label']}: {first}")
        lines += [f"    {line}" for line in rest]
    return lines


def _squat(result: SlipDemand) -> list[str]:
    lines = []
    for row in result.squat.iter_rows(named=True):
        rule = (
            f"{'rocks' if row['rocks_first'] else 'slides'} first: mu_s = {row['mu_s']:g}, b/(2 h_c) = "
            f"{row['uplift_g']:.3g}"
        )
        lines.append(f"  block {row['block']}, {row['width']:g} x {row['height']:g} m: {rule}")
        if row["rocks_first"]:
            lines.append(
                f"    lifts off above {row['uplift_g']:.3g} g: under {row['uplift']} of {row['motions']} motions"
            )
            if row["overturning_limits_exceeded"] is not None:
                exceeded = counted(row["overturning_limits_exceeded"], "motion")
                lines.append(
                    f"    above both of Ishiyama's lower limits of overturning, as to velocity "
                    f"{row['overturning_velocity']:.2g} m/s: under {exceeded}"
                )
    return ["Slide or rock", *lines] if lines else []


def _estimates(result: SlipDemand) -> list[str]:
    if not result.estimates.height:
        return []
    lines = [
        "Estimates over the exact slip: geometric mean, log scatter, share of sliding cases that they fall short of",
        text_line(("block", "motion of", "estimate", "mean", "scatter", "short"), _ESTIMATES),
    ]
    for row in result.estimates.iter_rows(named=True):
        if row["base"] == "ground" and row["estimate"] == "rigid_block":
            continue  # the exact slip itself
        base = "the ground" if row["base"] == "ground" else f"{_place(result, row)} alone"
        numbers = (number_text(row[name]) for name in ("ratio", "log_scatter"))
        short = "-" if row["below"] is None else _percent(row["below"])
        lines.append(text_line((str(row["block"]), base, TITLES[row["estimate"]], *numbers, short), _ESTIMATES))
    return [
        *lines,
        "  on the ground beside the slip there; on a floor of the building alone beside that in the building",
    ]


def _place(result: SlipDemand, row: dict[str, Any]) -> str:
    """What a block stands on."""
    if row.get("rack"):
        return f"rack {row['rack']}.{row['level']}"
    return _floor(result, row)


def _floor(result: SlipDemand, row: dict[str, Any]) -> str:
    """The floor of a block; of a sliding base floor 0 is the slab."""
    return f"floor {row['floor']}" if row["floor"] else str(result.metadata.get("floor_0", "ground"))


def _mm(value: float | None) -> str:
    return number_text(value, ".0f", scale=1e3)


def _percent(value: float) -> str:
    return f"{100.0 * value:.0f} %"
