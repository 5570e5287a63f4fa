"""Writes docs/validation.md and its figures: the paper's validations and claims, from the recordings.

Usage: SEISMASS_SHARED=... python tools/validation_page.py
The recordings are not part of this project: SEISMASS_SHARED names the folder that holds them. The words are in
tools/pages/validation.md.
"""

from __future__ import annotations

import math
import os
import re
import sys
import textwrap
from itertools import product
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl

import seismass as sm
from seismass import _kernel
from seismass.media.figure_file import save_figure
from seismass.show.validation.figures import platform_figure, section4_figure, sliding_figure
from seismass.show.validation.views import claims_markdown
from seismass.validation import Platform, Section4, Validation, components, section4_scene, validate
from seismass.validation.paper_claims import MOST
from seismass.validation.shaking_table import AMPLITUDES, DAMPINGS, FRICTIONS, LENGTH_RATIO, PERIODS
from seismass.validation.three_storeys import COMPARED_SLOPES, FRICTION_SPRINGS, MU, PEAK_G, SPRINGS, kept

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "validation.md"
FIGURES: Final = ROOT / "docs" / "figures"
WORDS: Final = Path(__file__).parent / "pages" / "validation.md"
SUITE: Final = Path("records/paper_seven.csv")
FINER_STEPS: Final = 50
"""Steps per sample interval of the softest friction springs, beside those of the table."""
DRAWN_SLOPE: Final = 0.05
DRAWN_PLATFORM: Final = "NS"
"""Second slope, and component of Erzincan, of the figures."""


def recorded(shared: Path) -> sm.records.Suite:
    """The recordings of the paper that are at hand."""
    return sm.read_suite(shared / SUITE)


def markdown(header: list[str], rows: list[list[str]]) -> str:
    """A table of text."""
    return "\n".join(f"| {' | '.join(line)} |" for line in [header, ["---"] * len(header), *rows])


def listed(values: tuple[float, ...]) -> str:
    """Numbers with commas between them."""
    return ", ".join(f"{value:g}" for value in values)


def of_shorter_steps(records: tuple[sm.Record, ...]) -> list[float]:
    """Differences of drift (mm) with the softest friction springs and shorter steps, for each component and slope."""
    found = []
    for record, slope in product(records, COMPARED_SLOPES):
        scene, motion = section4_scene(slope), record.scaled(PEAK_G / record.pga_g).motion
        exact = sm.simulate(scene, motion, histories=True).drift
        springs = _kernel.integrate_reference(
            scene._kernel, motion._kernel, "friction_springs", FINER_STEPS, stiffness_ratio=SPRINGS[0][0]
        )
        found.append(1e3 * float(np.abs(springs.drift - exact).max()))
    return found


def of_section4(result: Section4, finer: list[float]) -> dict[str, Any]:
    """Values of the section on the comparison of programs."""
    table, runs = result.differences, result.runs
    rows = [
        [
            row["component"],
            f"{row['second_slope']:g}",
            row["program"],
            row["setting"],
            *(f"{row[f'{name}_mm']:.2g} ({row[f'{name}_percent']:.2g} %)" for name in ("drift", "slip")),
        ]
        for row in table.rows(named=True)
    ]
    springs = table.filter(program=FRICTION_SPRINGS)
    steps = springs.select(
        (pl.col("drift_mm") / pl.col("drift_mm").shift()).over("component", "second_slope").alias("rate")
    )["rate"].drop_nulls()
    finest = table.group_by("component", "second_slope", "program", maintain_order=True).last()
    sliding = runs.filter(pl.col("slides_most").is_not_null())
    components, slopes = runs["component"].unique(maintain_order=True), runs["second_slope"].unique().sort()
    counts = [
        [
            name,
            *(
                f"{of.filter(slides_most=1).height} of {of.height}"
                for slope in slopes
                for of in [sliding.filter(component=name, second_slope=slope)]
            ),
        ]
        for name in components
    ]
    first = kept().row(0, named=True)
    building = section4_scene(DRAWN_SLOPE).building
    assert building is not None
    weight = MU * building.mass[0] * sm.STANDARD_GRAVITY
    return {
        "peak": PEAK_G,
        "slopes": " or ".join(f"{slope:g}" for slope in COMPARED_SLOPES),
        "versions": f"OpenSees {first['version']} (openseespy {first['openseespy']}, {first['platform']})",
        "differences": markdown(["component", "r2", "program", "setting", "drift, mm", "slip, mm"], rows),
        "every": first["every"],
        "elastic": f"{1e3 * weight / (SPRINGS[0][0] * building.stiffness[0]):.3f}",
        "finer_steps": FINER_STEPS,
        "finer": f"{min(finer):.2f} to {max(finer):.2f}",
        "rates": f"{steps.min():.2f} to {steps.max():.2f} times",
        **{name: finest[name].max() for name in ("drift_mm", "drift_percent", "slip_mm", "slip_percent")},
        "soft": springs["slip_percent"].max(),
        "section4_figures": "\n\n".join(
            f"![Drift and slip of component {name} by all programs](figures/validation_section4_{name}.png)"
            for name in components
        ),
        "yielding": int(runs["all_yield"].sum()),
        "runs": runs.height,
        "first": sliding.filter(slides_most=1).height,
        "sliding": sliding.height,
        "peaks": runs["peak_g"].n_unique(),
        "r2_least": f"{slopes[0]:g}",
        "r2_most": f"{slopes[-1]:g}",
        "peak_least": f"{runs['peak_g'].min():g}",
        "peak_most": f"{runs['peak_g'].max():g}",
        "first_table": markdown(["component", *(f"r2 = {slope:g}" for slope in slopes)], counts),
    }


def of_platform(result: Platform) -> dict[str, Any]:
    """Values of the section on the shaking table."""
    found = result.robust
    low, median, high = found["over_attached"]
    lighter, middle, heavier = found["heavier"]
    scale = math.sqrt(LENGTH_RATIO)
    return {
        "period_least": f"{PERIODS[0]:g}",
        "period_most": f"{PERIODS[-1]:g}",
        "periods": len(PERIODS) - 1,
        "full_least": f"{scale * PERIODS[0]:.2f}",
        "full_most": f"{scale * PERIODS[-1]:.2f}",
        "frictions": listed(FRICTIONS),
        "dampings": listed(DAMPINGS),
        "amplitudes": listed(AMPLITUDES),
        "components": ", ".join(result.runs["component"].unique(maintain_order=True)),
        "platform_runs": found["runs"],
        "slides": found["slides"],
        "below": found["below_attached"],
        "over_low": low,
        "over_median": median,
        "over_high": high,
        "heavier_low": lighter,
        "heavier_median": middle,
        "heavier_high": heavier,
        "attached_low": found["heavier_attached"][0],
        "attached_high": found["heavier_attached"][2],
        **{name: value for name, value in found.items() if name.startswith("by_")},
    }


def reflowed(text: str) -> str:
    """A page with paragraphs and items of lists in lines of equal length; headings, figures and tables stay."""
    parts = []
    for part in text.strip().split("\n\n"):
        if part.startswith(("#", "!", "|")):
            parts.append(part)
            continue
        items = re.split(r"\n(?=- )", part)
        hanging = "  " if part.startswith("- ") else ""
        wrapped = (
            textwrap.fill(item, 118, subsequent_indent=hanging, break_on_hyphens=False, break_long_words=False)
            for item in (" ".join(item.split()) for item in items)
        )
        parts.append("\n".join(wrapped))
    return "\n\n".join(parts) + "\n"


def page(suite: sm.records.Suite, result: Validation) -> str:
    """The page."""
    values: dict[str, Any] = {"most": round(100 * MOST), "claims": claims_markdown(result.claims)}
    values |= of_section4(result.section4, of_shorter_steps(components("Brawley Airport", suite))) | of_platform(
        result.platform
    )
    return reflowed(WORDS.read_text(encoding="utf-8").format_map(values))


def write_figures(result: Validation) -> None:
    """Write the figures of the page."""
    for component in result.section4.runs["component"].unique(maintain_order=True):
        figure = section4_figure(result.section4, component, DRAWN_SLOPE)
        save_figure(figure, "png", FIGURES / f"validation_section4_{component}.png")
    save_figure(sliding_figure(result.section4), "png", FIGURES / "validation_sliding.png")
    save_figure(platform_figure(result.platform, DRAWN_PLATFORM), "png", FIGURES / "validation_platform.png")


def main() -> int:
    """Writes page and figures; 0 if the recordings were there."""
    shared = os.environ.get("SEISMASS_SHARED")
    if not shared:
        print("SEISMASS_SHARED is not set: it names the folder with the recordings", file=sys.stderr)
        return 2
    suite = recorded(Path(shared))
    result = validate(suite)
    PAGE.write_text(page(suite, result), encoding="utf-8")
    write_figures(result)
    print(f"wrote {PAGE} and its figures")
    return 0


if __name__ == "__main__":
    sys.exit(main())
