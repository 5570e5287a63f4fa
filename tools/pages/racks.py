"""Racks, walls and stops: numbers of benchmarks/racks.py."""

from __future__ import annotations

import runpy
from typing import Any, Final

import matplotlib as mpl
import polars as pl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pages.parts import ROOT, Page, table
from seismass.media.roles import GREY, INK
from seismass.media.style import SERIES, STYLE, grid_lines

SUITE: Final = "far_field"
GOODS: Final = ("sliding", "fixed", "yielding")
SHARE: Final = "effective fraction"


def fill(page: Page) -> pl.DataFrame:
    """Put in tables and numbers, and return the stored cases."""
    rows = solved()
    friction, walls = rows.filter(study="friction"), rows.filter(study="walls")
    page.tables(
        racks_table(rows),
        by_eta_table(friction, "rack_period", "goods"),
        by_eta_table(walls, "alpha_h", "building"),
        stops_table(rows),
    )
    numbers(page, rows)
    page.figure("racks_period", against_period, rows)
    page.figure("racks_eta", against_eta, friction, "rack_period", (1.0, 4.0))
    page.figure("walls", against_eta, walls, "alpha_h", (1.0, 4.0))
    page.figure("stops", against_friction, rows)
    return rows


def solved() -> pl.DataFrame:
    """Return the stored cases of the suite of the page."""
    rows: pl.DataFrame = runpy.run_path(str(ROOT / "benchmarks" / "racks.py"))["kept"]()
    return rows.filter(suite=SUITE)


def share_text(row: dict[str, Any]) -> str:
    """Return the figure of the fraction with its interval, and real over fully attached drift."""
    return f"{row['value']:.2f} [{row['low']:.2f}, {row['high']:.2f}], {row['over_attached']:.2f}"


def racks_table(rows: pl.DataFrame) -> str:
    """Return rows by R and rack period, columns by what the goods and the rack do."""
    found = rows.filter(study="racks")
    lines = []
    for reduction, period in found.select("R", "rack_period").unique(maintain_order=True).rows():
        at = found.filter(R=reduction, rack_period=period)
        cells = [of.row(0, named=True) for goods in GOODS if (of := at.filter(goods=goods)).height]
        texts = [share_text(cell) for cell in cells] + ["-"] * (len(GOODS) - len(cells))
        where = f"{period:g} s" if period else "on the floor"
        lines.append([f"{reduction:g}", where, *texts])
    return table(["R", "rack", "sliding, mu = 0.37", "fixed", "sliding, rack yields"], lines)


def by_eta_table(rows: pl.DataFrame, key: str, name: str) -> str:
    """Return rows by R and a property, columns by eta; the rule by hand below."""
    etas = sorted(round(value, 6) for value in rows["eta"].unique())
    lines = []
    for reduction, value in rows.select("R", key).unique(maintain_order=True).rows():
        at = rows.filter(R=reduction, **{key: value}).sort("eta")
        lines.append([f"{reduction:g}", named(key, value), *(f"{share:.2f}" for share in at["value"])])
    for reduction in rows["R"].unique(maintain_order=True):
        at = rows.filter(R=reduction).group_by(pl.col("eta").round(6)).agg(pl.col("by_hand").median()).sort("eta")
        lines.append([f"{reduction:g}", "the rule by hand", *(f"{share:.2f}" for share in at["by_hand"])])
    return table(["R", name, *(f"eta = {eta:g}" for eta in etas)], lines)


def named(key: str, value: float) -> str:
    """Return what a row is of."""
    if key == "rack_period":
        return f"{value:g} s" if value else "on the floor"
    return f"wall and frame, alpha H = {value:g}" if value else "wall alone"


def stops_table(rows: pl.DataFrame) -> str:
    """Return rows by R and mu, columns by clearance, with the worst record at 5 cm."""
    found = rows.filter(study="stops")
    clearances = sorted(found["clearance"].drop_nulls().unique(), reverse=True)
    lines = []
    for reduction, mu in found.select("R", "mu").unique(maintain_order=True).rows():
        at = found.filter(R=reduction, mu=mu)
        free = at.filter(pl.col("clearance").is_null()).row(0, named=True)
        of = [at.filter(clearance=clearance).row(0, named=True) for clearance in clearances]
        worst = max(of, key=lambda row: row["worst_record"])
        shares = [f"{row['value']:.2f}" for row in (free, *of)]
        lines.append([f"{reduction:g}", f"{mu:g}", *shares, f"{worst['worst_record']:.2f}"])
    names = [f"{1e2 * clearance:g} cm" for clearance in clearances]
    return table(["R", "mu", "no stops", *names, "one record, at most"], lines)


def between(values: pl.Series) -> str:
    """Return the least and largest value, once where they are the same to two digits."""
    low, high = (f"{value:.2f}" for value in (values.min(), values.max()))
    return low if low == high else f"{low} to {high}"


def numbers(page: Page, rows: pl.DataFrame) -> None:
    """Put in numbers that stand in sentences."""
    racks, stops, walls = (rows.filter(study=name) for name in ("racks", "stops", "walls"))
    stiff = racks.filter(pl.col("rack_period").is_between(0.05, 0.5), pl.col("R") > 1.0)
    soft = racks.filter(pl.col("rack_period") >= 1.0, pl.col("goods") != "fixed", pl.col("R") > 1.0)
    floor = racks.filter(pl.col("rack_period") == 0.0, pl.col("R") > 1.0)
    free = stops.filter(pl.col("clearance").is_null()).select("R", "mu", free="value")
    near = stops.filter(clearance=0.05).join(free, on=["R", "mu"]).with_columns(rise=pl.col("value") - pl.col("free"))
    rise, rough = near.filter(mu=0.1)["rise"], near.filter(mu=0.3)["rise"].abs().max()
    half = walls.filter((pl.col("eta") - 0.5).abs() < 1e-6, R=4.0)
    sliding, fixed = (stiff.filter(goods=goods) for goods in ("sliding", "fixed"))
    pallets, goods = between(sliding["value"]), f"{fixed['value'].max():.2f}"
    more = [f"{100.0 * (of['over_attached'].max() - 1.0):.0f} %" for of in (sliding, fixed)]
    on_racks, on_floor, at_half = between(soft["value"]), between(floor["value"]), between(half["value"])
    raised, worst = f"{rise.min():.2f} to {rise.max():.2f}", f"{stops['worst_record'].max():.2f}"
    said = "racks up to 0.5 s give {} with sliding pallets and up to {} with fixed goods: up to {} and {} more drift"
    page.words(said, pallets, goods, *more)
    page.words("with sliding pallets give {}, where the same pallets on the floor give {}: what", on_racks, on_floor)
    page.words("at eta = 0.5 the fraction is {}, the largest", at_half)
    page.words("strength of the frame, R_y = 1, and says {} there", between(half["by_hand"]))
    said = "With mu = 0.1 stops at 5 cm raise the fraction by {}; with mu = 0.3 by at most {}. -"
    page.words(said, raised, f"{rough:.2f}")
    page.words("Single records reach {} times the drift", worst)
    page.words("up to 8 % more drift | {}, up to {} |", pallets, more[0])
    page.words("up to 1.34, 18 % | up to {}, {} |", goods, more[1])
    page.words("on the floor 0.8 to 0.95 | {}, on the floor {} |", on_racks, on_floor)
    page.words("R = 4, eta = 0.5 | 0.54 | {} |", at_half)
    page.words("+0.12 to +0.25 | {} |", raised)
    page.words("without | 4.3 | {} |", worst)


def against_period(rows: pl.DataFrame) -> Figure:
    """Return the figure of the fraction against the period of the rack, one panel for each R."""
    found = rows.filter(study="racks")
    labels = {"sliding": "pallets that slide", "fixed": "goods fixed", "yielding": "pallets slide, rack yields"}
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(9.0, 3.4), layout="constrained")
        panels = figure.subplots(1, 3, sharey=True)
        for axes, reduction in zip(panels, (1.0, 2.0, 4.0), strict=True):
            of = found.filter(R=reduction)
            for look, goods in zip(SERIES, GOODS, strict=False):
                line = of.filter(pl.col("rack_period") > 0.0, goods=goods).sort("rack_period")
                axes.plot(line["rack_period"], line["value"], marker="o", markersize=3.0, label=labels[goods], **look)
            floor = of.filter(rack_period=0.0).row(0, named=True)
            axes.axhline(floor["value"], color=GREY, linewidth=1.0, label="pallets on the floor")
            axes.axhline(1.0, color=INK, linewidth=0.6, linestyle=(0, (1, 2)))
            axes.set_xscale("log")
            axes.set_xticks([0.1, 0.2, 0.5, 1.0, 2.0], ["0.1", "0.2", "0.5", "1", "2"])
            axes.minorticks_off()
            axes.set_title(f"R = {reduction:g}")
            axes.set_xlabel("period of the rack (s)")
            grid_lines(axes)
        panels[0].set_ylabel(SHARE)
        panels[0].set_ylim(-0.03, None)
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False)
    return figure


def against_eta(rows: pl.DataFrame, key: str, panels_of: tuple[float, ...]) -> Figure:
    """Return the figure of the fraction against eta: lines by the values of a key, panels by R, and the rule."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.2, 3.4), layout="constrained")
        panels: Any = figure.subplots(1, 2, sharey=True)
        values = sorted(rows[key].unique())
        looks = dict(zip(values, SERIES, strict=False))
        for axes, reduction in zip(panels, panels_of, strict=True):
            of = rows.filter(R=reduction)
            for value in of[key].unique(maintain_order=True):
                line = of.filter(**{key: value}).sort("eta")
                label = named(key, value) if key == "alpha_h" or not value else f"rack of {value:g} s"
                axes.plot(line["eta"], line["value"], marker="o", markersize=3.0, label=label, **looks[value])
            _rule(axes, of)
            axes.set_title(f"R = {reduction:g}")
            axes.set_xlabel("eta = mu / mean peak base shear coefficient")
            grid_lines(axes)
        panels[0].set_ylabel(SHARE)
        handles = {
            label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
        }
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3, frameon=False)
    return figure


def _rule(axes: Axes, rows: pl.DataFrame) -> None:
    """Draw the rule by hand, at the same eta."""
    by = rows.group_by(pl.col("eta").round(6)).agg(pl.col("by_hand").median()).sort("eta")
    axes.plot(by["eta"], by["by_hand"], color=GREY, linestyle=(0, (1, 1)), linewidth=1.2, label="rule by hand")


def against_friction(rows: pl.DataFrame) -> Figure:
    """Return the figure of the fraction against friction with stops at some clearances, one panel for each R."""
    found = rows.filter(study="stops")
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(9.0, 3.2), layout="constrained")
        panels = figure.subplots(1, 3, sharey=True)
        for axes, reduction in zip(panels, (1.0, 2.0, 4.0), strict=True):
            of = found.filter(R=reduction)
            for look, clearance in zip(SERIES, (None, 0.1, 0.05, 0.02), strict=False):
                is_it = pl.col("clearance").is_null() if clearance is None else pl.col("clearance") == clearance
                line = of.filter(is_it).sort("mu")
                label = "no stops" if clearance is None else f"stops at {1e2 * clearance:g} cm"
                axes.plot(line["mu"], line["value"], marker="o", markersize=3.0, label=label, **look)
            axes.set_title(f"R = {reduction:g}")
            axes.set_xlabel("mu")
            grid_lines(axes)
        panels[0].set_ylabel(SHARE)
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False)
    return figure
