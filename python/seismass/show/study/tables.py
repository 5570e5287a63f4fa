"""A study with its sensitivity, validations and example, and the tables of its page."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any, Final

import polars as pl
from markupsafe import Markup

from seismass.base.units import STANDARD_GRAVITY
from seismass.effective_mass.rule import RULE, RULE_IN_WORDS
from seismass.media.page import described_html
from seismass.media.roles import CODE, ETA, MU, SLIDE, lettered
from seismass.show.animation import animate
from seismass.show.animation.html import element_content
from seismass.show.study.answer import percent
from seismass.studies.study import Sensitivity, StudyResult
from seismass.studies.study.run import Example
from seismass.studies.validation import Platform, Section4, Validation
from seismass.studies.validation.paper_claims import claims_table
from seismass.studies.validation.three_storeys import platform_of, platform_tables, section4_of, section4_tables

_SECTION4: Final = ("section4_runs", "section4_differences", "section4_histories")
_PLATFORM: Final = ("platform_runs", "platform_bands")


def completed(
    result: StudyResult,
    *,
    sensitivity: Sensitivity | None = None,
    validation: Validation | None = None,
    example: Example | None = None,
) -> StudyResult:
    """Return a study with what else its folder may hold: sensitivity, validation and example, where they were made."""
    frames, facts = dict(result.frames), result.validation
    if sensitivity is not None:
        frames["sensitivity"] = sensitivity.table
    if validation is not None:
        synthetic = {name: getattr(validation, name).synthetic for name in ("section4", "platform")}
        facts = {**validation.metadata(), **{f"{name}_synthetic": value for name, value in synthetic.items()}}
        frames["claims"] = claims_table(validation.claims)
        frames |= section4_tables(validation.section4) | platform_tables(validation.platform)
    animation = None if example is None else _animation(example, result.metadata["code"]["name"])
    return replace(result, frames=frames, validation=facts, animation=animation)


def validations(result: StudyResult) -> tuple[Section4, Platform] | None:
    """Return section 4 of the paper and its shaking table, where they were made."""
    facts = result.validation
    if facts is None or not set(_SECTION4 + _PLATFORM) <= set(result.tables):
        return None
    section4 = section4_of(result.tables, synthetic=facts["section4_synthetic"])
    return section4, platform_of(result.tables, synthetic=facts["platform_synthetic"])


def _animation(example: Example, code: str) -> dict[str, Any]:
    labels, name = example.labels, example.name
    animation = animate(
        example.scene,
        example.record.motion,
        fraction=labels["lambda_analysis"],
        code_name=code,
        title=f"{labels['storeys']} storeys, R = {labels['R']:g}",
    )
    facts = {
        "labels": labels,
        "motion": name,
        "peak_g": float(abs(example.record.acceleration).max()) / STANDARD_GRAVITY,
    }
    content: dict[str, Any] = json.loads(json.dumps({"about": facts, "element": element_content(animation)}))
    return content


def without_one_friction(table: pl.DataFrame) -> pl.DataFrame:
    """Return a table without a friction coefficient that is the same throughout."""
    return table if table["mu"].n_unique() > 1 else table.drop("mu")


def storeys_table(result: StudyResult) -> Markup:
    """Return mean drifts of every storey by the three models, and the underestimation."""
    return described_html(
        "study: summary",
        without_one_friction(result.summary),
        f"Capped mean drift of every storey, and ({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name}: of the means, "
        "and motion by motion.",
        units={"m": ("mm", lambda drift: f"{1e3 * drift:.1f}"), "%": ("", percent)},
    )


def fractions_table(fractions: pl.DataFrame) -> Markup:
    """Return base shear, eta, the rule by hand and the effective fraction of every building."""
    return described_html(
        "study: fractions",
        without_one_friction(fractions).select(pl.exclude("kind"), "kind"),  # beside the fraction its interval
        f"Every building: mean peak base shear V of the runs with all attached over the weight W of all, {ETA} = {MU} "
        f"W/V, and the rule by hand, {lettered(RULE_IN_WORDS)}"
        + (", and the effective fraction with its interval." if fractions["effective"].count() else "."),
        headers={"estimate": RULE},
    )


def slip_table(demand: pl.DataFrame) -> Markup:
    """Return the slip demand of every building."""
    names = {
        "mean": "mean (mm)",
        "p16": "16 % (mm)",
        "p84": "84 % (mm)",
        "largest": "largest (mm)",
        "residual": "residual, mean (mm)",
    }
    return described_html(
        "study: summary",
        without_one_friction(demand),
        "Slip demand of each building: of the floor on which goods slide farthest, under each motion.",
        headers={**names, "slides": "motions with slip"},
        formats=dict.fromkeys(names, lambda slip: f"{1e3 * slip:.1f}"),
    )
