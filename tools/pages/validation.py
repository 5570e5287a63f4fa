"""The paper's validations and claims, from the recordings."""

from __future__ import annotations

import math
from itertools import product
from typing import Final

import numpy as np
import polars as pl

import seismass as sm
from pages.parts import Page, table
from seismass import _kernel
from seismass.show.validation import claims_markdown, platform_figure, section4_figure, sliding_figure
from seismass.studies.validation import Platform, Section4, components, section4_scene, validate
from seismass.studies.validation.paper_claims import MOST
from seismass.studies.validation.shaking_table import AMPLITUDES, DAMPINGS, FRICTIONS, LENGTH_RATIO, PERIODS
from seismass.studies.validation.three_storeys import (
    COMPARED_SLOPES,
    FRICTION_SPRINGS,
    MU,
    PEAK_G,
    SPRINGS,
    opensees_results,
)

FINER_STEPS: Final = 50
"""Steps per sample interval of the softest friction springs, beside those of the table."""
DRAWN_SLOPE: Final = 0.05
DRAWN_PLATFORM: Final = "NS"
"""Second slope, and component of Erzincan, of the figures."""


def fill(page: Page) -> None:
    """Put in tables and numbers."""
    suite = sm.read_suite(page.records / "paper_seven.csv")
    result = validate(suite)
    page.words("the claim holds in at least {} % of the cases", round(100 * MOST))
    page.tables(claims_markdown(result.claims))
    of_programs(page, result.section4, of_shorter_steps(components("Brawley Airport", suite)))
    of_floors(page, result.section4.runs)
    of_platform(page, result.platform)
    for name in result.section4.runs["component"].unique():
        page.figure(f"validation_section4_{name}", section4_figure, result.section4, name, DRAWN_SLOPE)
    page.figure("validation_sliding", sliding_figure, result.section4)
    page.figure("validation_platform", platform_figure, result.platform, DRAWN_PLATFORM)


def of_shorter_steps(records: tuple[sm.Record, ...]) -> list[float]:
    """Return differences of drift (mm) of the softest friction springs with shorter steps, by component and slope."""
    found = []
    for record, slope in product(records, COMPARED_SLOPES):
        scene, motion = section4_scene(slope), record.scaled(PEAK_G / record.pga_g).motion
        exact = sm.simulate(scene, motion, histories=True).drift
        springs = _kernel.integrate_reference(
            scene._kernel, motion._kernel, "friction_springs", FINER_STEPS, stiffness_ratio=SPRINGS[0][0]
        )
        found.append(1e3 * float(np.abs(springs.drift - exact).max()))
    return found


def of_programs(page: Page, result: Section4, finer: list[float]) -> None:
    """Put in the comparison of programs."""
    differences = result.differences
    rows = [
        [
            *(row["component"], f"{row['second_slope']:g}", row["program"], row["setting"]),
            *(f"{row[f'{name}_mm']:.2g} ({row[f'{name}_percent']:.2g} %)" for name in ("drift", "slip")),
        ]
        for row in differences.rows(named=True)
    ]
    page.tables(table("component | r2 | program | setting | drift, mm | slip, mm", rows))
    first = opensees_results().row(0, named=True)
    page.words(
        "scaled to a peak of {} g, and r2 is {}.", PEAK_G, " or ".join(f"{slope:g}" for slope in COMPARED_SLOPES)
    )
    versions = (first[key] for key in ("version", "openseespy", "platform"))
    page.words("versions: OpenSees {} (openseespy {}, {}).", *versions)
    page.words("OpenSees is compared at every {}th sample.", first["every"])
    building = section4_scene(DRAWN_SLOPE).building
    assert building is not None
    weight = MU * building.mass[0] * sm.STANDARD_GRAVITY
    page.words("slides, which is {} mm for n = 100.", f"{1e3 * weight / (SPRINGS[0][0] * building.stiffness[0]):.3f}")
    shorter = FINER_STEPS, f"{min(finer):.2f} to {max(finer):.2f}"
    page.words("with 1e2 k and dt / {} in place of dt / 5, drifts still differ by {} mm.", *shorter)
    springs = differences.filter(program=FRICTION_SPRINGS)
    drift = pl.col("drift_mm")
    rates = springs.select((drift / drift.shift()).over("component", "second_slope"))["drift_mm"].drop_nulls()
    page.words("drifts then differ by {} to {} times as much.", f"{rates.min():.2f}", f"{rates.max():.2f}")
    finest = differences.group_by("component", "second_slope", "program").last()
    most = (f"{finest[name].max():.1g}" for name in ("drift_mm", "drift_percent", "slip_mm", "slip_percent"))
    page.words("all programs agree within {} mm ({} %) of drift and {} mm ({} %) of slip.", *most)
    page.words("have errors of up to {} %: a friction spring", f"{springs['slip_percent'].max():.0f}")


def of_floors(page: Page, runs: pl.DataFrame) -> None:
    """Put in which floor slides most."""
    sliding = runs.filter(pl.col("slides_most").is_not_null())
    slopes = runs["second_slope"].unique().sort()
    rows = []
    for name in runs["component"].unique(maintain_order=True):
        of = [sliding.filter(component=name, second_slope=slope)["slides_most"] for slope in slopes]
        rows.append([name, *(f"{(most == 1).sum()} of {most.len()}" for most in of)])
    page.tables(table(["component", *(f"r2 = {slope:g}" for slope in slopes)], rows))
    yielding = int(runs["all_yield"].sum()), runs.height
    ends = (f"{value:g}" for value in (slopes[0], slopes[-1], runs["peak_g"].min(), runs["peak_g"].max()))
    least, most, *peaks = ends
    said = "All storeys yield in {} of {} runs: both components, r2 from {} to {}, {} peaks from {} to {} g."
    page.words(said, *yielding, least, most, runs["peak_g"].n_unique(), *peaks)
    first = (sliding["slides_most"] == 1).sum()
    page.words("block slides most in {} of the {} runs in which any block slides.", first, sliding.height)


def of_platform(page: Page, result: Platform) -> None:
    """Put in the section on the shaking table."""
    found, scale = result.robust, math.sqrt(LENGTH_RATIO)
    ends = f"{PERIODS[0]:g}", f"{PERIODS[-1]:g}", len(PERIODS) - 1
    full = (f"{scale * period:.2f}" for period in (PERIODS[0], PERIODS[-1]))
    page.words("without block | {} to {} s in {} steps ({} to {} s at full scale) |", *ends, *full)
    for name, values in (
        ("friction coefficient", FRICTIONS),
        ("damping ratio", DAMPINGS),
        ("factor of the accelerations", AMPLITUDES),
    ):
        page.words(f"\n| {name} | {{}} |\n", ", ".join(f"{value:g}" for value in values))
    shaken = ", ".join(result.runs["component"].unique(maintain_order=True))
    page.words("\n| component | {} | with {} runs in all.", shaken, found["runs"])
    page.words("The block slides in {} runs. In {} of these, the drift", found["slides"], found["below_attached"])
    low, median, high = (f"{value:.2f}" for value in found["over_attached"])
    page.words("median of the ratio is {}, 5 to 95 % of the runs lie between {} and {}.", median, low, high)
    lighter, middle, heavier = (f"{value:.2f}" for value in found["heavier"])
    page.words("one: {} to {} times as much (5 to 95 %, median {}). With", lighter, heavier, middle)
    attached = (f"{found['heavier_attached'][place]:.2f}" for place in (0, 2))
    page.words("With both blocks attached, the ratio is {} to {}.", *attached)
    page.words("decides the size of the drift (a factor of {} over its range).", f"{found['by_period']:.0f}")
    said = "changes it by a factor of {} on average over its range, the amplitude of 1.5 by {}, damping by {}."
    by = (f"{found[f'by_{name}']:.1f}" for name in ("mu", "amplitude", "damping"))
    page.words(said, *by)
