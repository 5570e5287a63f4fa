"""Peaks of one run over the height of its building, and response spectra of its floors."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import matplotlib as mpl
import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from seismass.base.arguments import is_one_of
from seismass.base.errors import InvalidOption
from seismass.base.statistics import quantile
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_array, as_list, as_number, as_one_of, brief, refusal
from seismass.media.roles import GREY, INK, LIMIT, SLIDE
from seismass.media.style import PERIOD_TICKS, SERIES, columns, drawing, grid_lines, say, single
from seismass.motions.motion import Motion
from seismass.motions.spectra import response_spectrum
from seismass.runs.response import Response
from seismass.show.plots.batches import FRACTILES, checked_table, in_unit, label_of
from seismass.show.plots.histories import numbers

SPECTRUM_PERIODS: Final = np.geomspace(0.03, 4.0, 160)
"""Periods of floor spectra (s)."""


@dataclass(frozen=True)
class _Quantity:
    """What a panel shows: where it lies over the height, its unit, and its values."""

    label: str
    per_storey: bool
    nothing: str
    values: NDArray[Any]
    levels: NDArray[Any]


@drawing()
def profile(
    response: Response,
    *,
    quantities: Sequence[str] = ("drift", "acceleration", "shear", "slip"),
    limits: Mapping[str, float] | None = None,
    ax: Axes | Sequence[Axes] | None = None,
) -> Figure:
    """Draw the peaks of a run over the height of the building, in continuous time, with limits.

    Parameters
    ----------
    response : Response
        A run.
    quantities : sequence of str, optional
        Panels: "drift" (over the storey height in % where heights are known, otherwise mm), "acceleration" of the
        ground and of floors (g), "shear" of storeys (kN, or over the weight where the mass is not stated), "slip" of
        blocks (mm; left out where there are none on floors; those on racks are in `rack_profile`).
    limits : mapping of str to float, optional
        Limit of a quantity, in the unit of its panel.
    ax : Axes or sequence of Axes, optional
        One Axes for each quantity.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        There is no building or no such quantity, a limit is not a number or has no panel, or `ax` does not fit them.
    """
    as_one_of(response, Response, "response", "figure", InvalidOption)
    owner = "profile"
    what = "some of drift, acceleration, shear, slip"
    names = (
        [quantities] if isinstance(quantities, str) else as_list(quantities, "quantities", owner, InvalidOption, what)
    )
    known = _quantities(response)
    for name in names:
        if not is_one_of(name, ("drift", "acceleration", "shear", "slip")):
            raise refusal(InvalidOption, "quantities", owner, what, brief(name))
    shown = [name for name in names if name in known]
    if not shown:
        raise refusal(InvalidOption, "quantities", owner, f"some of {', '.join(known)}", brief(quantities))
    stated = {} if limits is None else as_one_of(limits, Mapping, "limits", owner, InvalidOption)
    bounds = {name: as_number(value, "limit", owner, InvalidOption) for name, value in stated.items()}
    for name in bounds:
        if name not in shown:
            raise refusal(InvalidOption, "limits", owner, f"for some of {', '.join(shown)}", brief(name))
    storeys = response.scene.storeys
    place = columns(ax, len(shown), owner, width=2.1, height=1.3 + 0.35 * min(max(storeys, 4), 16))
    for name, axes in zip(shown, place.axes, strict=True):
        _panel(axes, known[name], bounds.get(name))
        axes.set_ylim(0.0, storeys + 0.25)
        axes.set_yticks(range(storeys + 1) if storeys <= 12 else range(0, storeys + 1, storeys // 6))
    for axes in place.axes if not place.is_new else place.axes[:1]:
        axes.set_ylabel("floor (0: ground)")
    handles = [
        Line2D([], [], color=SLIDE.colour, linewidth=1.6, label="of storeys"),
        Line2D([], [], color=SLIDE.colour, marker="o", markersize=4.0, linewidth=1.2, label="of floors and blocks"),
    ]
    if bounds:
        handles.append(Line2D([], [], **_LIMIT, label="limit"))
    if place.is_new:
        place.legend(handles, columns=3)
    return place.figure


_LIMIT: Final[dict[str, Any]] = {**LIMIT.look, "linewidth": 1.4}


def _quantities(response: Response) -> dict[str, _Quantity]:
    """What can be shown of a run by name."""
    building, floors = response.scene.building, response.scene.block_floor
    if building is None:
        raise refusal(InvalidOption, "scene", "profile", "one with a building", "none")
    storey = np.arange(building.storeys) + 0.5
    ratio = response.peak_drift_ratio
    drift = 1e3 * response.peak_drift if ratio is None else 100.0 * ratio
    label = "peak drift (mm)" if ratio is None else "peak drift / height (%)"
    shear = response.peak_storey_shear
    quantities = {
        "drift": _Quantity(label, True, "no drift", drift, storey),
        "acceleration": _Quantity(
            "peak acceleration (g)",
            False,
            "no acceleration",
            np.append(response.motion.pga, response.peak_floor_acceleration) / STANDARD_GRAVITY,
            np.arange(building.storeys + 1.0),
        ),
        "shear": _Quantity("peak storey shear (kN)", True, "no shear", 1e-3 * shear, storey)
        if building.mass_is_stated
        else _Quantity("peak storey shear / weight", True, "no shear", shear / building.weight, storey),
    }
    if any(floors):
        slip, levels = 1e3 * response.peak_slip[: len(floors)], np.array(floors, dtype=float)
        quantities["slip"] = _Quantity("peak slip (mm)", False, "nothing slides", slip, levels)
    return quantities


def _panel(axes: Axes, quantity: _Quantity, limit: float | None) -> None:
    values, levels = quantity.values, quantity.levels
    if quantity.per_storey:
        edges = np.arange(len(values) + 1.0)
        axes.stairs(values, edges, orientation="horizontal", color=SLIDE.colour, linewidth=1.6, baseline=None)
    else:
        order = np.argsort(levels, kind="stable")
        line = "-" if len(set(levels)) == len(levels) else ""
        look: Any = {"color": SLIDE.colour, "linestyle": line, "marker": "o", "markersize": 4.0, "linewidth": 1.2}
        axes.plot(values[order], levels[order], **look)
    largest = max(float(np.max(values, initial=0.0)), 0.0 if limit is None else limit)
    axes.set_xlim(0.0, 1.12 * largest or 1.0)
    if not np.any(values > 0.0):
        say(axes, quantity.nothing)
    if limit is not None:
        axes.axvline(limit, **_LIMIT)
    axes.set_xlabel(quantity.label)
    axes.locator_params(axis="x", nbins=4)
    grid_lines(axes)


@drawing()
def floor_spectra(
    response: Response,
    *,
    floors: int | Sequence[int] | None = None,
    periods: ArrayLike | None = None,
    damping: float = 0.05,
    ax: Axes | None = None,
) -> Figure:
    """Draw the pseudo-acceleration spectrum of the ground and of floors, for what stands on them.

    The absolute acceleration of a floor counts as linear between the rows of its history.

    Parameters
    ----------
    response : Response
        A run with histories at every sample, not of displacements only, that did not collapse.
    floors : int or sequence of int, optional
        Numbers of floors, from 1; all by default.
    periods : array_like, optional
        Periods (s); by default 160 from 0.03 to 4 s.
    damping : float, default 0.05
        Ratio of critical damping.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure that was drawn into.

    Raises
    ------
    InvalidOption
        The run has no such histories or collapsed, there is no such floor, a period or the damping is out of its range,
        or `ax` is not an Axes.
    """
    as_one_of(response, Response, "response", "figure", InvalidOption)
    owner = "floor spectra"
    numbers_drawn = numbers(floors, response.scene.storeys, "floors", owner)
    every = response._asked("floor spectra", "histories", stored="every")
    if every != 1:
        raise refusal(InvalidOption, "histories", owner, "True, a row at every sample", str(every))
    if response.status != "completed":
        raise refusal(InvalidOption, "response", owner, "that of a completed run", response.status)
    period_values = SPECTRUM_PERIODS if periods is None else as_array(periods, "periods", owner, InvalidOption)
    ground = response.motion
    motions = [Motion(response.floor_acceleration[:, number - 1], ground.dt) for number in numbers_drawn]
    spectra = response_spectrum([ground, *motions], period_values, damping) / STANDARD_GRAVITY
    groups = _in_groups(len(numbers_drawn)) if ax is None else [range(len(numbers_drawn))]
    place = columns(ax, len(groups), owner, width=5.6, height=4.2 if len(groups) == 1 else 3.4, most=1)
    building = response.scene.building
    assert building is not None
    for group, axes in zip(groups, place.axes, strict=True):
        axes.plot(period_values, spectra[0], color=GREY, linewidth=2.2, label="ground")
        for position, look in zip(group, _looks(len(group)), strict=True):
            label = f"floor {numbers_drawn[position]}"
            axes.plot(period_values, spectra[1 + position], **look, linewidth=1.4, label=label)
        axes.set_xscale("log")
        axes.set_xlim(period_values[0], period_values[-1])
        ticks = [tick for tick in PERIOD_TICKS if period_values[0] <= tick <= period_values[-1] * 1.0001]
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.minorticks_off()
        axes.set_ylim(0.0, 1.1 * float(spectra.max()) or 1.0)
        axes.axvline(building.periods[0], color=INK, linewidth=0.8, linestyle=(0, (1, 2)))
        place_of_text: Any = {
            "xycoords": ("data", "axes fraction"),
            "textcoords": "offset points",
            "xytext": (2, -9),
        }
        axes.annotate("T1", (building.periods[0], 1.0), **place_of_text, fontsize=7.5)
        axes.set_ylabel(f"pseudo-acceleration, {100.0 * damping:g} % damping (g)")
        grid_lines(axes)
        if len(groups) > 1:
            axes.legend(fontsize=8.0, frameon=False, loc="upper right")
    place.axes[-1].set_xlabel("period (s)")
    if len(groups) == 1:
        place.legend(place.axes[0].get_legend_handles_labels()[0], columns=5)
    return place.figure


def _in_groups(count: int) -> list[range]:
    """Floors of each panel: few enough that lines can be distinguished, the highest above."""
    rows = -(-count // len(SERIES))
    ends = [round(count * row / rows) for row in range(rows + 1)]
    return [range(first, end) for first, end in itertools.pairwise(ends)][::-1]


def _looks(count: int) -> list[dict[str, Any]]:
    """Looks of lines of floors: those of series where they suffice, else from dark to light up the building."""
    if count <= len(SERIES):
        return list(SERIES[:count])
    shades = mpl.colormaps["viridis"](np.linspace(0.0, 0.9, count))
    dashes: list[Any] = ["-", (0, (6, 2)), (0, (1.2, 1.2))]
    return [{"color": tuple(shade), "linestyle": dashes[i % len(dashes)]} for i, shade in enumerate(shades)]


@drawing()
def drift_profiles(table: pl.DataFrame, demand: str = "peak_drift", *, ax: Axes | None = None) -> Figure:
    """Draw a demand of many runs over the storeys: each run, the median, 16 % and 84 %.

    Parameters
    ----------
    table : polars.DataFrame
        Rows of `simulate_many`, or of `long_table`; all of buildings with equally many storeys. Runs that failed are
        left out. A run that collapsed counts as infinite in the fractiles, and is drawn to where it came.
    demand : str, default "peak_drift"
        Column with a value per storey.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure.

    Raises
    ------
    InvalidOption
        The column is missing or has no value per storey, buildings differ in height, all runs failed, or `ax` is no
        Axes.
    """
    owner = "drift profiles"
    rows = checked_table(table, (demand,), owner)
    listed = isinstance(rows.schema[demand], pl.List)
    if not listed:
        rows = checked_table(rows, ("run", "storey", demand), owner).sort("run", "storey", maintain_order=True)
        rows = rows.group_by("run", maintain_order=True).agg(pl.col(demand), pl.col("status").first())
    heights = rows[demand].list.len().unique().to_list()
    if len(heights) != 1 or not heights[0]:
        raise refusal(InvalidOption, "table", owner, "runs of buildings with equally many storeys", f"{heights}")
    values = in_unit(demand, np.array(rows[demand].to_list(), dtype=float))
    if np.isnan(values).any():
        raise refusal(InvalidOption, "demand", owner, "known for every storey of every run", demand)
    fell = (rows["status"] == "collapsed").to_numpy()
    counted = np.where(fell[:, None], np.inf, values)
    level = np.arange(1, heights[0] + 1)
    place = single(ax, owner, size=(4.6, 1.6 + 0.4 * min(max(heights[0], 5), 14)))
    axes = place.axes[0]
    for run in values:
        axes.plot(run, level, color=GREY, linewidth=0.7, alpha=0.7, gid="run")
    curves: list[FloatArray] = []
    for share, name, look in FRACTILES:
        curves.append(quantile(counted.T, share))
        axes.plot(curves[-1], level, **look, marker="o", markersize=3.5, label=name, gid=name)
    finite = values[np.isfinite(values)]
    axes.set_xlim(0.0, 1.08 * float(np.max(finite, initial=0.0)) or 1.0)
    axes.set_ylim(0.6, heights[0] + 0.4)
    axes.set_yticks(level if heights[0] <= 14 else level[:: heights[0] // 7])
    axes.set_xlabel(label_of(demand))
    axes.set_ylabel("storey")
    grid_lines(axes)
    handles = [Line2D([], [], color=GREY, linewidth=0.7, label=f"each of {len(values)} runs")]
    handles += [Line2D([], [], **look, label=name) for _, name, look in FRACTILES]
    place.legend(handles, columns=2)
    return place.figure
