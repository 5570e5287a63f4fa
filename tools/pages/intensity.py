"""Medians, dispersions and probabilities by measure, method and rule."""

from __future__ import annotations

from typing import Final

import polars as pl

import seismass as sm
from pages.effective_mass import far_field_components
from pages.parts import Page
from seismass.studies.fragility import FragilityAnalysis, LimitState, cloud_analysis, incremental_dynamic_analysis

LIMIT: Final = LimitState("drift_ratio", 0.02)
RULES: Final = {"none": 0.0, "ASCE 7 storage": 0.25, "NBC, NZS 1170.5": 0.6, "Eurocode 8": 0.8, "all": 1.0}
"""Shares of the live load attached by rules."""


def fill(page: Page) -> dict[str, list[str]]:
    """Put in the blocks of numbers, and return them by key."""
    names = page.example()
    scene, suite = names["scene"], names["suite"]
    blocks = {
        "answer": names["answer"].text.splitlines(),
        "choices": choices(scene, suite),
        "rules": rules(scene, suite),
    }
    if page.shared:
        blocks["far_field"] = rules(scene, far_field_components(page.records))
    for key, lines in blocks.items():
        page.block(key, lines)
    page.figure("fragility", names.get, "figure")
    page.figure("ida_models", names["answer"].plot, "demand_drift_ratio")
    return blocks


def choices(scene: sm.Scene, suite: sm.Suite) -> list[str]:
    """Return rows of median and dispersion by measure and by method, with what the code's model has to the real one."""
    lines = [f"{'':40}{'median, real':>22}{'dispersion':>20}{'code / real':>22}"]
    for measure in ("scale", "pga", "sa_t1", "sa_avg"):
        found = incremental_dynamic_analysis(scene, suite, LIMIT, measure=measure)
        lines.append(choice(f"hunt and fill, {found.measure.label}", found))
    levels = [0.3 * number for number in range(1, 11)]
    stripes = incremental_dynamic_analysis(scene, suite, LIMIT, method="stripes", intensities=levels)
    lines.append(choice(f"stripes, {stripes.measure.label}", stripes))
    factors = [1.0 + 0.3 * number for number in range(len(suite))]
    motions = [record.scaled(factor) for record, factor in zip(suite, factors, strict=True)]
    cloud = cloud_analysis(scene, motions, LIMIT)
    return [*lines, choice(f"cloud, {cloud.measure.label}", cloud)]


def choice(name: str, found: FragilityAnalysis) -> str:
    """Return one row of `choices`."""
    real = found.fragilities.row(by_predicate=pl.col("model") == "real", named=True)
    code = found.comparison.row(by_predicate=pl.col("model") == "code", named=True)
    cells = (
        interval(real["median"], real["median_low"], real["median_high"]),
        interval(real["dispersion"], real["dispersion_low"], real["dispersion_high"]),
        interval(code["median_ratio"], code["median_ratio_low"], code["median_ratio_high"]),
    )
    return f"{name:40}{cells[0]:>22}{cells[1]:>20}{cells[2]:>22}"


def rules(scene: sm.Scene, suite: sm.Suite) -> list[str]:
    """Return rows of what the real building has where the model of a rule says 10 %."""
    models = {"real": scene, **{name: sm.attached_scene(scene, share) for name, share in RULES.items()}}
    found = incremental_dynamic_analysis(models, suite, LIMIT)
    lines = [
        f"Drift ratio above 2 %: {len(suite)} motions; median of the real building "
        f"{found.fragility(LIMIT, 'real').median:.2f} g, dispersion {found.fragility(LIMIT, 'real').dispersion:.2f}",
        f"{'rule':20}{'share':>6}{'capacity, model/real':>24}{'10 % at':>10}{'there the real building has':>30}",
    ]
    for name, share in RULES.items():
        ratio = found.comparison.row(by_predicate=pl.col("model") == name, named=True)
        row = found.exceedance.row(by_predicate=pl.col("given") == f"{name} at 10 %", named=True)
        capacity = interval(ratio["median_ratio"], ratio["median_ratio_low"], ratio["median_ratio_high"])
        real = interval(*(100.0 * row[key] for key in ("reference", "reference_low", "reference_high")), digits=".0f")
        lines.append(f"{name:20}{share:>6.2f}{capacity:>24}{row['intensity']:>8.2f} g{real + ' %':>30}")
    return lines


def interval(value: float | None, low: float | None, high: float | None, digits: str = ".2f") -> str:
    """Return a number with its interval, or that there is none."""
    if value is None or low is None or high is None:
        return "not known"
    return f"{value:{digits}} [{low:{digits}}, {high:{digits}}]"
