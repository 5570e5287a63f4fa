"""The example of design, its results, and the tables of codes."""

from __future__ import annotations

from typing import Any, Final

import matplotlib as mpl
import polars as pl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from pages.parts import Page, fenced, table
from seismass import design
from seismass.media.style import STYLE

PRINTED: Final = (
    ("weight.total / 1e6", "{:.2f}"),
    ("modes.periods[0]", "{:.3f}"),
    ("period.approximate, period.limit", "{0[0]:.3f}, {0[1]:.3f}"),
    ("C_s", "{:.4f}"),
    ("forces.shear[0] / 1e6", "{:.3f}"),
    ("analysis.for_design(frame.R, base_shear=forces.base_shear).shear[0] / 1e6", "{:.3f}"),
    ("path.capacity / forces.base_shear", "{:.2f}"),
    ("path.mechanism", "{}"),
)


def fill(page: Page) -> None:
    """Put in what the example gives, and the tables."""
    names = page.example(1)
    page.tables(table("result | prints", ([f"`{code}`", form.format(eval(code, names))] for code, form in PRINTED)))
    page.after("`storey_checks` gives for each storey:", fenced(columns(names["checks"])))
    periods = design.period_table().select(
        "code_id", "system", pl.col("coefficient").alias("C_t"), pl.col("exponent").alias("x"),
        pl.col("upper").alias("limit / T_a"), "clause", "status", "note",
    )  # fmt: skip
    index = ["code_id", "structure", "of", "clause", "status", "note"]
    limits = design.drift_limit_table().pivot("risk_category", index=index, values="ratio", maintain_order=True)
    for frame in (
        periods,
        design.distribution_table().select("code_id", pl.col("exponent").alias("k"), "top", "clause", "status"),
        limits.select("code_id", "structure", "I", "II", "III", "IV", *index[2:]),
        design.rules_table().drop("code").rename({"code_id": "code"}),
        design.system_table().select("system_id", "system", "R", "omega_0", "C_d"),
    ):
        page.tables(table(" | ".join(frame.columns), (map(cell, row) for row in frame.iter_rows())))
    page.figure("pushover", figure, names)


def columns(frame: pl.DataFrame) -> list[str]:
    """Return the lines of a table in plain text."""
    rows = [frame.columns, *([cell(value) for value in row] for row in frame.iter_rows())]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(map(str.rjust, row, widths)).rstrip() for row in rows]


def cell(value: Any) -> str:
    """Return a value as the tables write it."""
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def figure(names: dict[str, Any]) -> Figure:
    """Pushover of the example, and with P-Delta and softening."""
    building, weight = names["building"], names["weight"]
    soft = building.replace(
        gravity_load=weight.weight + 0.75 * 6.0e6,
        hysteresis="peak-oriented",
        third_slope=-0.05,
        residual_strength=0.2,
        overstrength=1.3,
    )
    with mpl.rc_context(STYLE):
        drawn = Figure(figsize=(9.0, 3.8), layout="constrained")
        left, right = drawn.subplots(1, 2, sharey=True)
        names["path"].plot(ax=left)
        design.pushover(soft, "code").plot(ax=right)
        left.set_title("hardening storeys, no P-Delta")
        right.set_title("softening storeys with P-Delta")
        right.set_ylabel("")
        entries: dict[str, Line2D] = {}
        for axes in (left, right):
            own = axes.get_legend()
            assert own is not None
            entries |= {
                text.get_text(): handle for text, handle in zip(own.get_texts(), own.legend_handles, strict=True)
            }
            own.remove()
        drawn.legend(entries.values(), entries, loc="outside upper center", ncols=len(entries), frameon=False)
    return drawn
