"""The page of a study: its figure and one line first, then findings, figures and tables, validation, provenance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

import polars as pl
from markupsafe import Markup

from seismass.media.isolate import sentence_html
from seismass.media.page import Section, edited_html, facts_html, page_html, table_html, text_html
from seismass.media.page_lists import bullets_html, long_html
from seismass.media.roles import ALPHA, ATTACHED, CODE, ETA, MU, SLIDE, lettered
from seismass.show.study.answer import SHORT, answer, compared_rules, one_line, percent, span
from seismass.show.study.captions import labels_of
from seismass.show.study.page_sections import (
    Pictures,
    claims_section,
    example_section,
    sensitivity_section,
    validation_section,
)
from seismass.show.study.page_tables import fractions_table, slip_table, storeys_table
from seismass.show.study.slip import slip_demand
from seismass.show.study.tables import StudyTables
from seismass.show.study.words import assumptions, provenance
from seismass.study import motions_text

_PAPER_FIGURES: Final = {
    factor: f" (the paper's Fig. {number})" for factor, number in ((1.0, 6), (2.0, 7), (4.0, 8), (6.0, 9))
}


def study_page(
    result: StudyTables,
    drawings: Mapping[str, str],
    for_phones: Mapping[str, str] | None = None,
    edited: Sequence[str] = (),
) -> str:
    """Return the page of a study as HTML, from SVG texts of `study_drawings` by name and those for narrow screens. It
    needs no other file; equal tables give equal pages. `edited` are files that were edited, which the page says first.
    """
    metadata = result.metadata
    page = Pictures(drawings, for_phones or {})
    first, *others = page.named("underestimation")
    sections = [
        Section("Findings", [text_html(*(Markup(lettered(paragraph)) for paragraph in answer(result)))]),
        Section("Underestimation", _underestimation(result, page, others)),
        Section("Drift demands", [text_html(_MODELS)], list(_drifts(result, page))),
        Section("Effective fraction", _fraction(result, page)),
        *([Section("Slip of the goods", _slip(result, page))] if page.named("slip") else []),
        *sensitivity_section(result, page),
        *example_section(result),
        *claims_section(result),
        Section("Ground motions", _motions(result, page)),
        Section(
            "Tables",
            [],
            [
                Section("Drift of every storey", [storeys_table(result)]),
                Section("Fractions of every building", [fractions_table(result.fractions)]),
                Section("Slip of every building", [slip_table(slip_demand(result.responses))]),
            ],
        ),
        *validation_section(result, page),
        Section("Assumptions", [bullets_html(map(sentence_html, assumptions(metadata))), *_remarks(metadata)]),
        Section("Provenance", [facts_html(provenance(metadata))]),
    ]
    line = one_line(result)
    lead = [
        *edited_html(edited),
        Markup('<p class="answer"><strong>{}</strong></p>').format(line),
        page.figure(first, _UNDERESTIMATION, f"{line} Rings: what the model with all goods attached gives."),
    ]
    subtitle = (
        f"{metadata['code']['name']} on {motions_text(metadata['suite'])} ({metadata['suite']['name']}); "
        f"seismass {metadata['package_version']}"
    )
    title = "How much of the live load acts as mass: a study"
    return page_html(title, sections, subtitle=subtitle, description=line, lead=lead)


_MODELS: Final = (
    f"Each building is solved three times under each motion: with goods that may slide ({SLIDE.name}), with the code's "
    f"share of their mass attached to the floors ({CODE.name}), and with all of it ({ATTACHED.name}). The numbers at "
    f"the right are ({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name} of the mean peak drifts."
)
_UNDERESTIMATION: Final = (
    "Underestimation of drift against R: the storey with the largest, and the range over the storeys of each building. "
    "Rings: what the model with all goods attached gives over that of the code, where none of it is due to sliding."
)


def _remarks(metadata: dict[str, Any]) -> Iterator[Markup]:
    if metadata["remarks"]:
        yield Markup('<div class="note"><p>Remarks on the inputs</p>{}</div>').format(bullets_html(metadata["remarks"]))


def _motions(result: StudyTables, page: Pictures) -> list[Markup]:
    metadata = result.metadata
    factors = result.scaling.with_columns(
        pl.Series("name", [motion["record"] for motion in metadata["suite"]["motions"]]),
        pl.Series("pga", [motion["pga_g"] for motion in metadata["suite"]["motions"]], dtype=pl.Float64),
        pl.Series("remarks", ["; ".join(motion["remarks"]) for motion in metadata["suite"]["motions"]]),
    ).select("motion", "name", "record", "pga", "individual_factor", "common_factor", "factor", "remarks")
    if not factors["remarks"].str.len_chars().sum():
        factors = factors.drop("remarks")
    if factors["name"].equals(factors["record"]):
        factors = factors.drop("record")
    least = metadata["scaling"]["governing_period"]
    return [
        page.figure(
            "spectrum",
            "Spectra of the scaled motions, their mean, and the target (the paper's Fig. 1).",
            f"The mean spectrum of the scaled motions is not below the target in the range of scaling; they touch at "
            f"{least:.2g} s.",
        ),
        table_html(
            factors,
            "Scaling factors: the factor of each motion is its own times the common one.",
            headers={
                "name": "motion",
                "motion": "number",
                "pga": "PGA unscaled (g)",
                "individual_factor": "own factor",
                "common_factor": "common factor",
            },
            formats={
                "motion": "d",
                **({"remarks": long_html} if "remarks" in factors.columns else {}),
                "pga": ".3f",
                **dict.fromkeys(("individual_factor", "common_factor", "factor"), ".4f"),
            },
        ),
    ]


def _drifts(result: StudyTables, page: Pictures) -> Iterator[Section]:
    frictions, factors = labels_of(result.summary["mu"]), labels_of(result.summary["R"])
    for factor, label in factors.items():
        figures = []
        for mu, name in frictions.items():
            rows = result.summary.filter(R=factor, mu=mu)
            missed = rows["underestimation_percent"].drop_nulls()
            span = f"{percent(float(missed.min()))} to {percent(float(missed.max()))}" if missed.len() else "none"  # type: ignore[arg-type]
            behind = f"_mu{name}" if len(frictions) > 1 else ""
            figures.append(
                page.figure(
                    f"drift_R{label}{behind}",
                    f"Mean peak drift of each storey, R = {label}, {MU} = {mu:g}{_PAPER_FIGURES.get(factor, '')}.",
                    f"Drift by storey with sliding goods and of both models at R = {label}: underestimation {span}.",
                )
            )
        yield Section(f"R = {label}", figures)


def _underestimation(result: StudyTables, page: Pictures, others: list[str]) -> list[Markup]:
    """What is not ahead of the contents: of further frictions, and the maps."""
    parts = [
        page.figure(
            name,
            _UNDERESTIMATION,
            f"The largest underestimation of a storey is {_extremes(result.summary)[1]}, the smallest "
            f"{_extremes(result.summary)[0]}; rings of the model with all goods attached are beside the markers.",
        )
        for name in others
    ]
    parts += [
        page.figure(
            name,
            "Underestimation of every storey (%): orange, the code model drifts less than the building; blue, it "
            "drifts more. Colours end at 100 %.",
            f"A number for every storey of every building, from {_extremes(result.summary)[0]} to "
            f"{_extremes(result.summary)[1]}; the table of all storeys has them too.",
        )
        for name in page.named("heat")
    ]
    return parts


def _fraction(result: StudyTables, page: Pictures) -> list[Markup]:
    fractions = result.fractions
    parts = []
    if "effective" in page.named("effective"):
        parts.append(
            page.figure(
                "effective",
                "Effective fraction of each building with its 90 % interval over the motions, the two estimates in "
                "closed form, and the fractions of the code.",
                f"Effective fractions against {ETA}, {span(fractions['effective'])}, beside both estimates.",
            )
        )
        rules = compared_rules(fractions)
        frame = pl.DataFrame([vars(rule) for rule in rules])
        parts.append(
            table_html(
                frame,
                f"Rules for the share to attach beside the effective fractions: short, by more than {SHORT:g}.",
                headers={
                    "name": "rule",
                    "mean": "mean share",
                    "short": "buildings short",
                    "most": "most that is missing",
                    "buildings": "of",
                },
                formats={"mean": ".2f", "most": ".2f"},
            )
        )
    return parts


def _slip(result: StudyTables, page: Pictures) -> list[Markup]:
    demand = slip_demand(result.responses)
    parts = [
        page.figure(
            name,
            "Largest peak slip of the goods on any floor: mean over the motions, and from 16 to 84 % of them.",
            f"Mean largest slip of a building against R by {ALPHA}, at most {1e3 * _largest_slip(demand):.0f} mm.",
        )
        for name in page.named("slip")
    ]
    return parts


def _extremes(summary: pl.DataFrame) -> tuple[str, str]:
    """Smallest and largest underestimation as texts."""
    missed = summary["underestimation_percent"].drop_nulls().to_numpy()
    return (percent(float(missed.min())), percent(float(missed.max()))) if missed.size else ("none", "none")


def _largest_slip(demand: pl.DataFrame) -> float:
    known = demand["mean"].drop_nulls().to_numpy()
    return float(known.max()) if known.size else 0.0
