"""Writes docs/design.md and its figure; the words are in tools/pages/design.md, the tables those of the package.

Usage: python tools/design_page.py
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import polars as pl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from seismass import design
from seismass.media.figure_file import save_figure
from seismass.media.style import STYLE

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "design.md"
FIGURE: Final = ROOT / "docs" / "figures" / "pushover.png"
WORDS: Final = Path(__file__).parent / "pages" / "design.md"

EXAMPLE: Final = """\
import seismass as sm
from seismass import design

heights, stiffness = [4.5, 4.0, 4.0], [1.9e8, 1.5e8, 1.0e8]  # m, N/m
weight = design.effective_seismic_weight(
    dead=[4.0e6, 4.0e6, 2.5e6],
    live=[6.0e6, 6.0e6, 0.6e6],
    use=["storage", "storage", "ordinary"],
)
modes = design.vibration_modes(weight.mass, stiffness)
period = design.code_period("asce7-10", "steel-moment-frame", height=12.5, s_d1=0.6)
T = period.design_period(modes.periods[0])

frame = design.system_factors("C3")  # steel intermediate moment frames
C_s = design.seismic_response_coefficient(1.0, 0.6, T, frame.R)
forces = design.equivalent_lateral_forces(weight.weight, heights, C_s * weight.total, T)
target = sm.TargetSpectrum.asce7(1.0, 0.6)
analysis = design.response_spectrum_analysis(weight.mass, stiffness, target, combination="cqc", heights=heights)

load = [2.31e7, 1.31e7, 3.1e6]  # N, at and above each storey
checks = design.storey_checks(
    forces.shear,
    forces.drift(stiffness),
    heights,
    c_d=frame.C_d,
    limit=design.drift_limit("asce7-10", "II").ratio,
    load=load,
)
building = sm.Building(
    weight.mass, stiffness, yield_shear=1.5 * forces.shear, overstrength=1.2, second_slope=0.05, heights=heights
)
path = design.pushover(building, "code")
"""
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


def example() -> dict[str, Any]:
    """Run the example and return its names."""
    names: dict[str, Any] = {}
    exec(compile(EXAMPLE, "docs/design.md", "exec"), names)
    return names


def page(names: dict[str, Any]) -> str:
    """The page."""
    words = WORDS.read_text(encoding="utf-8")
    printed = "\n".join(f"| `{code}` | {form.format(eval(code, names))} |" for code, form in PRINTED)
    periods = design.period_table().select(
        "code_id", "system", pl.col("coefficient").alias("C_t"), pl.col("exponent").alias("x"),
        pl.col("upper").alias("limit / T_a"), "clause", "status", "note",
    )  # fmt: skip
    limits = design.drift_limit_table().pivot(
        "risk_category",
        index=["code_id", "structure", "of", "clause", "status", "note"],
        values="ratio",
        maintain_order=True,
    )
    texts = {
        "example": EXAMPLE.rstrip(),
        "printed": printed,
        "checks": analysis_text(names["checks"]),
        "periods": table_of(periods),
        "distributions": table_of(
            design.distribution_table().select("code_id", pl.col("exponent").alias("k"), "top", "clause", "status")
        ),
        "limits": table_of(
            limits.select("code_id", "structure", "I", "II", "III", "IV", "of", "clause", "status", "note")
        ),
        "systems": table_of(design.system_table().select("system_id", "system", "R", "omega_0", "C_d")),
    }
    for name, text in texts.items():
        words = words.replace("{" + name + "}", text)
    return words


def table_of(frame: pl.DataFrame) -> str:
    """A table in Markdown."""
    rows = [frame.columns, ["---"] * frame.width, *(map(_cell, row) for row in frame.iter_rows())]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def analysis_text(frame: pl.DataFrame) -> str:
    """A table in plain text, in columns."""
    rows = [frame.columns, *([_cell(value) for value in row] for row in frame.iter_rows())]
    widths = [max(len(row[i]) for row in rows) for i in range(frame.width)]
    lines = ("  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)


def _cell(value: Any) -> str:
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


def main() -> int:
    """Write the page and its figure."""
    names = example()
    PAGE.write_text(page(names), encoding="utf-8")
    save_figure(figure(names), "png", FIGURE)
    return 0


if __name__ == "__main__":
    sys.exit(main())
