"""Figures of many runs: demand against intensity, fragility, any column against any other."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.statistics import quantile
from seismass.base.values import FloatArray, as_number, brief, refusal
from seismass.media.roles import ALPHA, BLOCK_COLOURS, GREY, INK, LIMIT, MU, PAPER, SLIDE, SLIDE_LOW
from seismass.media.style import drawing, grid_lines, plain, say, single
from seismass.runs.quantities import SHOWN, unit_of
from seismass.studies.fragility.estimate import fit_counts

_LABELS: Final[dict[str, tuple[str, float]]] = {
    "peak_drift_ratio": ("peak drift / height (%)", 1e2),
    "residual_drift_ratio": ("residual drift / height (%)", 1e2),
    "slip_path": ("path slipped (mm)", 1e3),
    "end_time": ("end (s)", 1.0),
    "period": ("period (s)", 1.0),
    "scale": ("scale factor of the motion", 1.0),
    "mass_ratio": (f"mass ratio {ALPHA}", 1.0),
    "mu": (f"friction coefficient {MU}", 1.0),
    "mu_s": (f"static friction coefficient {MU}", 1.0),
    "mu_k": (f"kinetic friction coefficient {MU}", 1.0),
}


def _shown(name: str) -> tuple[str, float]:
    """What an axis calls a column, with its unit where it is known, and the factor to that."""
    unit, factor = SHOWN.get(unit_of(name), (unit_of(name), 1.0))
    words = name.removesuffix("_time").replace("_", " ")
    words = f"time of the {words}" if name.endswith("_time") else words
    return _LABELS.get(name) or ((f"{words} ({unit})", factor) if unit else (plain(name), 1.0))


def label_of(name: str) -> str:
    """Return what an axis calls a column: with its unit where it is known, else by its name."""
    return _shown(name)[0]


def in_unit(name: str, values: NDArray[Any]) -> FloatArray:
    """Return values of a column in the unit of its label."""
    return np.asarray(_shown(name)[1] * np.asarray(values, dtype=np.float64))


def checked_table(table: Any, columns: tuple[str, ...], owner: str) -> pl.DataFrame:
    """Return a table of runs, which must have the columns needed, without those that failed."""
    if not isinstance(table, pl.DataFrame):
        raise refusal(InvalidOption, "table", owner, "a polars.DataFrame of runs", brief(table))
    for name in columns:
        as_word(name, table.columns, "column", owner)
    rows = table.filter(pl.col("status") != "failed") if "status" in table.columns else table
    if rows.is_empty():
        raise refusal(InvalidOption, "table", owner, "one with runs that did not fail", f"{table.height} rows")
    return rows


def one_value(table: pl.DataFrame, name: str) -> pl.Expr:
    """Return a column with one value per row: of a list, such as that of storeys, the largest."""
    column = pl.col(name)
    return column.list.max() if isinstance(table.schema[name], pl.List | pl.Array) else column


def demand_of(table: pl.DataFrame, name: str) -> pl.Expr:
    """Return a demand with one value per row, infinite where the run collapsed."""
    value = one_value(table, name).cast(pl.Float64)
    if "status" not in table.columns:
        return value
    return pl.when(pl.col("status") == "collapsed").then(float("inf")).otherwise(value)


FRACTILES: Final[tuple[tuple[float, str, dict[str, Any]], ...]] = (
    (0.16, "16 %", {"color": SLIDE.colour, "linestyle": (0, (1.2, 1.2)), "linewidth": 1.6}),
    (0.50, "median", {"color": SLIDE.colour, "linestyle": "-", "linewidth": 2.2}),
    (0.84, "84 %", {"color": SLIDE.colour, "linestyle": (0, (5, 2)), "linewidth": 1.6}),
)
"""Shares of the motions, and how their curves are drawn."""

_POINTS: Final = tuple(zip((*BLOCK_COLOURS, SLIDE_LOW.colour), "os^DvPX", strict=True))
"""Colour and marker of points by a column."""

_CROSS: Final[dict[str, Any]] = {"color": INK, "linestyle": "", "marker": "x"}
_LIMIT: Final[dict[str, Any]] = {**LIMIT.look, "linewidth": 1.2}


@drawing()
def ida(
    table: pl.DataFrame,
    intensity: str = "scale",
    demand: str = "peak_drift_ratio",
    *,
    limit: float | None = None,
    ax: Axes | None = None,
) -> Figure:
    """Draw curves of incremental dynamic analysis: demand against intensity of each motion, and their fractiles.

    Parameters
    ----------
    table : polars.DataFrame
        Rows of `simulate_many` or `long_table` with a column of intensities: of a `Grid` with several `scale`, say,
        `long_table` has it. Of several rows with the same motion and intensity, such as storeys, the largest demand
        counts. A collapse counts as infinite demand.
    intensity, demand : str, optional
        Columns.
    limit : float, optional
        Demand (in the unit of the axis) that is marked.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure. The last point of a curve before a collapse has a cross.

    Raises
    ------
    InvalidOption
        A column is missing, all runs failed, or `ax` is not an Axes.

    Notes
    -----
    Vamvatsikos and Cornell (2002), Earthquake Eng. Struct. Dyn. 31:491-514: fractiles of the demand at each intensity,
    a collapse being larger than all.
    """
    levels, demands = _by_motion(table, intensity, demand, "IDA figure")
    values = in_unit(demand, demands)
    place = single(ax, "IDA figure", size=(6.4, 4.6))
    axes = place.axes[0]
    for curve in values:
        axes.plot(np.append(0.0, curve), np.append(0.0, levels), color=GREY, linewidth=0.8, alpha=0.8, gid="motion")
        fell = np.flatnonzero(np.isinf(curve))
        if len(fell) and fell[0] > 0:
            last = fell[0] - 1
            axes.plot(curve[last], levels[last], color=INK, linestyle="", marker="x", markersize=5.0, gid="collapse")
    for share, name, look in FRACTILES:
        of_level = quantile(values.T, share)
        axes.plot(np.append(0.0, of_level), np.append(0.0, levels), **look, label=name, gid=name)
    if limit is not None:
        axes.axvline(as_number(limit, "limit", "IDA figure", InvalidOption), **_LIMIT)
    axes.set_xlim(0.0, 1.1 * float(np.max(values[np.isfinite(values)], initial=0.0)) or 1.0)
    axes.set_ylim(0.0, 1.04 * levels[-1])
    axes.set_xlabel(label_of(demand))
    axes.set_ylabel(label_of(intensity))
    grid_lines(axes)
    handles = [Line2D([], [], color=GREY, linewidth=0.8, label="each motion")]
    handles += [Line2D([], [], **look, label=name) for _, name, look in FRACTILES]
    if limit is not None:
        handles.append(Line2D([], [], **_LIMIT, label="limit"))
    if np.isinf(values).any():
        handles.append(Line2D([], [], **_CROSS, markersize=5.0, label="last before collapse"))
    place.legend(handles, columns=3)
    return place.figure


@drawing()
def fragility(
    table: pl.DataFrame,
    limit: float,
    intensity: str = "scale",
    demand: str = "peak_drift_ratio",
    *,
    ax: Axes | None = None,
) -> Figure:
    """Draw the share of motions by which a limit is exceeded against intensity, and the lognormal curve through it.

    Parameters
    ----------
    table : polars.DataFrame
        Rows as for `ida`.
    limit : float
        Demand that must not be exceeded, in the unit of the column (SI); a collapse exceeds it.
    intensity, demand : str, optional
        Columns.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure; without a curve where `fragility_fit` has none.

    Raises
    ------
    InvalidOption
        A column is missing, all runs failed, the limit is not a number, or `ax` is not an Axes.
    """
    from scipy.stats import norm  # slow to import

    bound = as_number(limit, "limit", "fragility", InvalidOption)
    levels, demands = _by_motion(table, intensity, demand, "fragility")
    exceeded = (demands > bound).sum(axis=0)
    fit = fragility_fit(levels, exceeded, np.full(len(levels), len(demands)))
    place = single(ax, "fragility", size=(6.4, 4.2))
    axes = place.axes[0]
    axes.plot(
        levels,
        exceeded / len(demands),
        color=INK,
        linestyle="",
        marker="o",
        markersize=5.0,
        markerfacecolor=PAPER,
        label=f"share of {len(demands)} motions",
        gid="shares",
    )
    end = 1.05 * levels[-1]
    if fit is not None:
        median, beta = fit
        way = np.linspace(0.0, end, 301)[1:]
        curve = norm.cdf(np.log(way / median) / beta)
        label = f"lognormal, median {median:.3g}, dispersion {beta:.2f}"
        axes.plot(way, curve, color=SLIDE.colour, linewidth=1.8, label=label, gid="curve")
    elif not exceeded.any():
        say(axes, "never exceeded")
    elif (exceeded == len(demands)).all():
        say(axes, "always exceeded")
    axes.set_xlim(0.0, end)
    axes.set_ylim(-0.02, 1.02)
    axes.set_xlabel(label_of(intensity))
    shown = float(in_unit(demand, np.array(bound)))
    name, _, unit = label_of(demand).partition(" (")
    axes.set_ylabel(f"probability that {name} > {shown:g} {unit.rstrip(')')}".rstrip())
    grid_lines(axes)
    place.legend(axes.get_legend_handles_labels()[0], columns=2)
    return place.figure


def fragility_fit(intensity: ArrayLike, exceeded: ArrayLike, number: ArrayLike) -> tuple[float, float] | None:
    """Return median and dispersion of the lognormal fragility of the greatest likelihood.

    Parameters
    ----------
    intensity : array_like, shape (levels,)
        Intensities, positive.
    exceeded, number : array_like of int, shape (levels,)
        How many motions exceeded the limit there, of how many.

    Returns
    -------
    (float, float) or None
        Median, and standard deviation of the logarithm. None where the likelihood has no maximum: the limit is always
        or never exceeded, there is an intensity that parts one from the other, or more of it does not mean more
        exceedance.

    Raises
    ------
    InvalidOption
        Lists differ in length, an intensity is not positive, or more motions exceed the limit than there are.

    Notes
    -----
    It is `seismass.fragility.fit_counts` without its interval.
    """
    fit = fit_counts(intensity, exceeded, number, resamples=0)
    return (fit.median, fit.dispersion) if fit.kind == "fitted" else None


@drawing()
def scatter(table: pl.DataFrame, x: str, y: str, *, by: str | None = None, ax: Axes | None = None) -> Figure:
    """Draw one column of a table against another, a point for each row.

    Parameters
    ----------
    table : polars.DataFrame
        Any table. Of a column of lists, such as one value per storey, the largest is taken. Rows of failed runs and
        of nulls are left out; those of collapsed runs have a cross.
    x, y : str
        Columns of numbers.
    by : str, optional
        Column by whose values points differ in colour and marker; at most seven values.
    ax : Axes, optional
        Axes to draw into.

    Returns
    -------
    Figure
        The whole figure.

    Raises
    ------
    InvalidOption
        A column is missing or `by` has too many values, all runs failed, or `ax` is not an Axes.
    """
    rows = checked_table(table, (x, y) if by is None else (x, y, by), "scatter figure")
    fell = pl.col("status") == "collapsed" if "status" in rows.columns else pl.lit(False)
    points = rows.select(x=one_value(rows, x), y=one_value(rows, y), by=pl.lit("") if by is None else by, fell=fell)
    points = points.drop_nulls(["x", "y"])
    groups = points["by"].unique().sort().to_list()
    if len(groups) > len(_POINTS):
        raise refusal(
            InvalidOption, "by", "scatter figure", f"a column of at most {len(_POINTS)} values", f"{len(groups)}"
        )
    place = single(ax, "scatter figure")
    axes = place.axes[0]
    for place_of, (group, (colour, marker)) in enumerate(zip(groups, _POINTS, strict=False)):
        here = points.filter(pl.col("by").eq_missing(group))
        # Open, and smaller from one series to the next, so that points at one place are seen within one another.
        size = 4.0 if len(groups) == 1 else 7.5 - 4.0 * place_of / (len(groups) - 1)
        look: Any = {"color": colour, "linestyle": "", "marker": marker, "markersize": size}
        look |= {"markerfacecolor": "none", "markeredgewidth": 0.9} if len(groups) > 1 else {"alpha": 0.75}
        name = "" if by is None else f"{plain(by)} = {plain(f'{group:g}' if isinstance(group, float) else str(group))}"
        axes.plot(in_unit(x, here["x"].to_numpy()), in_unit(y, here["y"].to_numpy()), **look, label=name, gid="points")
    collapsed = points.filter("fell")
    if collapsed.height:
        point = in_unit(x, collapsed["x"].to_numpy()), in_unit(y, collapsed["y"].to_numpy())
        axes.plot(*point, **_CROSS, markersize=7.0, label="collapsed", gid="collapse")
    axes.set_xlabel(label_of(x))
    axes.set_ylabel(label_of(y))
    grid_lines(axes)
    place.legend([handle for handle in axes.get_legend_handles_labels()[0] if handle.get_label()])
    return place.figure


def _by_motion(table: pl.DataFrame, intensity: str, demand: str, owner: str) -> tuple[FloatArray, FloatArray]:
    """Return intensities in order, and demands of shape (motions, intensities)."""
    rows = checked_table(table, ("motion", intensity, demand), owner)
    largest = (
        rows.select("motion", level=one_value(rows, intensity), demand=demand_of(rows, demand))
        .group_by("motion", "level")
        .agg(pl.col("demand").max())
        .pivot("level", index="motion", values="demand", sort_columns=False)
        .sort("motion")
    )
    levels = rows.select(one_value(rows, intensity)).to_series().unique().sort().to_numpy().astype(float)
    names = {float(name): name for name in largest.columns[1:]}
    demands = largest.select(names[level] for level in levels).to_numpy().astype(float)
    if np.isnan(demands).any():
        raise refusal(
            InvalidOption, "table", owner, "one with every motion at every intensity, and their demands", "gaps"
        )
    return levels, demands
