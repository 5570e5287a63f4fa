"""What a folder of a study holds: tables and documents that its page is made of, written, and read again."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Final

import polars as pl
from markupsafe import Markup

from seismass.base.errors import InvalidOption
from seismass.base.folders import ReadFolder
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import brief, refusal
from seismass.effective_mass.rule import RULE, RULE_IN_WORDS
from seismass.media.page import table_html
from seismass.media.roles import ATTACHED, CODE, EFFECTIVE, ETA, MU, SLIDE, lettered
from seismass.show.animation import animate
from seismass.show.animation.html import element_content
from seismass.show.study.answer import percent
from seismass.studies.study import SCHEMA_VERSION, Sensitivity, StudyResult
from seismass.studies.study.run import Example
from seismass.studies.validation import Platform, Section4, Validation
from seismass.studies.validation.paper_claims import claims_table
from seismass.studies.validation.three_storeys import platform_of, platform_tables, section4_of, section4_tables

DOCUMENT: Final = "study.json"
"""File by which a folder is known as that of a study."""
ANIMATION: Final = "animation.json"
"""File of what the animation of the example shows."""
_OWN: Final = ("responses", "summary", "fractions", "designs", "spectrum", "scaling")
_SECTION4: Final = ("section4_runs", "section4_differences", "section4_histories")
_PLATFORM: Final = ("platform_runs", "platform_bands")
OPTIONAL_TABLES: Final = ("sensitivity", "claims", *_SECTION4, *_PLATFORM)
"""Tables that a study has only where it was asked for them."""
READ: Final = (DOCUMENT, ANIMATION, *(f"{name}.parquet" for name in (*_OWN, *OPTIONAL_TABLES)))
"""Files of which the page is made."""


@dataclass(frozen=True, eq=False)
class StudyTables:
    """What the page of a study is made of: study.json and the tables of docs/study_schema.md, and sensitivity, claims,
    validations and animation where they were made.
    """

    metadata: dict[str, Any]
    responses: pl.DataFrame = field(repr=False)
    summary: pl.DataFrame = field(repr=False)
    fractions: pl.DataFrame = field(repr=False)
    designs: pl.DataFrame = field(repr=False)
    spectrum: pl.DataFrame = field(repr=False)
    scaling: pl.DataFrame = field(repr=False)
    sensitivity: pl.DataFrame | None = field(repr=False)
    claims: pl.DataFrame | None = field(repr=False)
    section4: Section4 | None = field(repr=False)
    platform: Platform | None = field(repr=False)
    animation: dict[str, Any] | None = field(repr=False)

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """All tables by name, as they are written."""
        optional = {"sensitivity": self.sensitivity, "claims": self.claims}
        return {
            **{name: getattr(self, name) for name in _OWN},
            **{name: table for name, table in optional.items() if table is not None},
            **({} if self.section4 is None else section4_tables(self.section4)),
            **({} if self.platform is None else platform_tables(self.platform)),
        }


def study_tables(
    result: StudyResult,
    *,
    sensitivity: Sensitivity | None = None,
    validation: Validation | None = None,
    example: Example | None = None,
) -> StudyTables:
    """Return what a folder of the study holds, with sensitivity, validation and example where they were made."""
    metadata = result.to_dict()
    if validation is not None:
        metadata["validation"] = {
            **validation.metadata(),
            "section4_synthetic": validation.section4.synthetic,
            "platform_synthetic": validation.platform.synthetic,
        }
    tables = {name: getattr(result, name) for name in _OWN if name != "scaling"} | {"scaling": result.scaling.table()}
    if sensitivity is not None:
        tables["sensitivity"] = sensitivity.table
    if validation is not None:
        tables |= {"claims": claims_table(validation.claims)}
        tables |= section4_tables(validation.section4) | platform_tables(validation.platform)
    return _made(metadata, tables, None if example is None else _animation(example, metadata["code"]["name"]))


def read_study_tables(files: ReadFolder) -> StudyTables:
    """Read the files of the folder of a study."""
    metadata = files.document(DOCUMENT)
    version = metadata.get("schema_version")
    if version != SCHEMA_VERSION:
        raise refusal(InvalidOption, "schema_version", DOCUMENT, f"{SCHEMA_VERSION}", brief(version))
    tables = {name: files.table(name) for name in _OWN}
    tables |= {name: files.table(name) for name in OPTIONAL_TABLES if f"{name}.parquet" in files}
    return _made(metadata, tables, files.document(ANIMATION) if ANIMATION in files else None)


def _made(metadata: dict[str, Any], tables: dict[str, pl.DataFrame], animation: dict[str, Any] | None) -> StudyTables:
    """What tables say, whether they are those of a study or were read: a page of either is the same."""
    section4 = platform = None
    if set(_SECTION4 + _PLATFORM) <= set(tables) and (validation := metadata.get("validation")) is not None:
        section4 = section4_of(tables, synthetic=validation["section4_synthetic"])
        platform = platform_of(tables, synthetic=validation["platform_synthetic"])
    return StudyTables(
        metadata,
        **{name: tables[name] for name in _OWN},
        sensitivity=tables.get("sensitivity"),
        claims=tables.get("claims"),
        section4=section4,
        platform=platform,
        animation=animation,
    )


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


_KEYS: Final = ("occupancy", "storeys", "R", "alpha", "mu")


def shown_keys(table: pl.DataFrame) -> list[str]:
    """Key columns, without a friction coefficient that is the same throughout."""
    return [name for name in _KEYS if name != "mu" or table["mu"].n_unique() > 1]


def storeys_table(result: StudyTables) -> Markup:
    """Return mean drifts of every storey by the three models, and the underestimation."""
    names = {
        "storey": "storey",
        "mean_peak_drift_real": f"{SLIDE.name} (mm)",
        "mean_peak_drift_code": f"{CODE.name} (mm)",
        "mean_peak_drift_attached": f"{ATTACHED.name} (mm)",
        "underestimation_percent": "under-estimation",
        "p16_underestimation_percent": "16 %",
        "median_underestimation_percent": "median",
        "p84_underestimation_percent": "84 %",
        "ratio_mass": f"{ATTACHED.name} / {CODE.name}",
        "ratio_sliding": f"{SLIDE.name} / {ATTACHED.name}",
    }
    table = result.summary.select(*shown_keys(result.summary), *names)
    millimetres = [name for name in names if name.startswith("mean_peak")]
    percents = [name for name in names if name.endswith("percent")]
    return table_html(
        table,
        f"Capped mean drift of every storey, and ({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name}: of the means, "
        "and motion by motion.",
        headers=names,
        formats={
            **dict.fromkeys(millimetres, lambda drift: f"{1e3 * drift:.1f}"),
            **dict.fromkeys(percents, percent),
            **dict.fromkeys(("ratio_mass", "ratio_sliding"), ".2f"),
        },
    )


def fractions_table(fractions: pl.DataFrame) -> Markup:
    """Return base shear, eta, the rule by hand and the effective fraction of every building."""
    names = {
        "base_shear_coefficient": "V/W",
        "eta": ETA,
        "coefficient": "C1",
        "estimate": lettered(RULE),
        "effective": EFFECTIVE,
        "low": "5 %",
        "high": "95 %",
        "kind": "kind",
    }
    known = [name for name in names if fractions[name].null_count() < fractions.height]
    return table_html(
        fractions.select(*shown_keys(fractions), *known),
        f"Every building: mean peak base shear V of the runs with all attached over the weight W of all, {ETA} = {MU} "
        f"W/V, and the rule by hand, {lettered(RULE_IN_WORDS)}"
        + (", and the effective fraction with its interval." if "effective" in known else "."),
        headers={name: names[name] for name in known},
        formats={name: ".3f" if name.startswith("base") else ".2f" for name in known if name != "kind"},
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
    return table_html(
        demand.select(*shown_keys(demand), "slides", *names),
        "Slip demand of each building: of the floor on which goods slide farthest, under each motion.",
        headers={**names, "slides": "motions in which goods slide"},
        formats=dict.fromkeys(names, lambda slip: f"{1e3 * slip:.1f}"),
    )
