"""The page of an assessment, for the calculation folder: the sheet for the file, input, method, results, provenance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final

import polars as pl
from markupsafe import Markup

from seismass.assessment.models import NAMES, SLIDING, SLIDING_HIGH, SLIDING_LOW
from seismass.assessment.result import Assessment
from seismass.base.arguments import ProgressLike
from seismass.effective_mass.result import KIND_TEXTS, EffectiveMass
from seismass.effective_mass.rule import RULE_IN_WORDS
from seismass.media.page import (
    Section,
    bullets_html,
    described_html,
    edited_html,
    facts_html,
    long_html,
    page_html,
    table_html,
    text_html,
)
from seismass.media.roles import EFFECTIVE, LAMBDA, OMEGA, OVER_MODEL, lettered, sentence_html
from seismass.media.text_table import number_text
from seismass.show.assessment.page_input import Pictures, in_motion_html, input_html, motions_html, names_of
from seismass.show.assessment.sheet import MOST_STOREYS, NOT_COVERED, running, sheet_html, storeys_html, use_html
from seismass.show.assessment.tables import analysis_table, slip_units

if TYPE_CHECKING:
    from matplotlib.figure import Figure


LIMITS: Final = (
    "Shear buildings, in each direction by themselves: no torsion, no flexible floors, no foundation.",
    NOT_COVERED,
    f"Trilinear storeys without loss of strength but by P-Delta; {OMEGA}, r2 and r3 decide about large drifts.",
    "The interval of a fraction resamples these motions, and is 0.05 wider at each end for another suite.",
    "This page checks drift and stability of a model. It replaces neither the design of members nor the judgement of "
    "the engineer who signs it.",
)
"""What the page does not cover."""


def building_page(
    result: Assessment,
    drawings: Mapping[str, str],
    for_phones: Mapping[str, str] | None = None,
    edited: Sequence[str] = (),
) -> str:
    """Return the page of an assessment as HTML, from SVG texts of its figures by name. It needs no other file; equal
    tables give equal pages. `edited` are files that were edited since they were written, which the page says first.
    """
    pictures = Pictures(drawings, for_phones or {})
    names = names_of(result)

    def listed(lines: Sequence[str]) -> Markup:
        return bullets_html(sentence_html(line, names) for line in lines)

    sections = [
        Section("Input as understood", input_html(result)),
        Section("Effective fraction", _fractions(result, pictures)),
        Section("Drifts", _drifts(result, pictures)),
        *([Section("Slip of the goods", _slip(result))] if result.slip.height else []),
        Section("In an analysis", [listed([*result.advice, *_further(result)]), *_analysis(result)]),
        Section("Checks", [_checks(result)]),
        Section("Motions", motions_html(result, pictures)),
        Section("The building in motion", in_motion_html(result)),
        Section("Remarks", [listed(result.remarks or ["None."])]),
        Section("Assumptions", [listed(result.assumptions)]),
        Section("Limits of this page", [bullets_html(LIMITS)]),
        Section("Provenance", _provenance(result)),
    ]
    version = f"seismass {result.metadata['package_version']}"
    subtitle = "; ".join(part for part in (result.content["note"], version) if part)
    title = result.name or "Building"
    description = f"{title}: how much of its live load acts as mass in an earthquake, drifts, stability and slips."
    lead = [*edited_html(edited), sheet_html(result, pictures.sheet)]
    return page_html(title, sections, subtitle=subtitle, description=description, lead=lead, running=running(result))


def _number(value: float | None, digits: int = 2) -> str:
    return number_text(value, f".{digits}f", missing="\N{EN DASH}", infinite="\N{EN DASH}")


def _interval(fraction: EffectiveMass) -> str:
    ends = fraction.suite_interval
    return "\N{EN DASH}" if ends is None else f"{_number(ends[0])} to {_number(ends[1])}"


def _further(result: Assessment) -> list[str]:
    """What governs which storeys, and by how much single motions and the drift cap change the answer."""
    return [f"{text[0].upper()}{text[1:]}." for text in (*result.answer.governs, *result.answer.sensitivity)]


def _checks(result: Assessment) -> Markup:
    rows = []
    for row in result.checks.iter_rows(named=True):
        in_percent = "drift ratio" in row["check"]
        scale, form, unit = (1e2, ".2f", " %") if in_percent else (1.0, ".3g", "")
        known = row["value"] is not None and row["limit"]
        rows.append(
            {
                "check": row["check"],
                "model": NAMES.get(row["model"], row["model"]),
                "storey": row["storey"],
                "value": None if row["value"] is None else f"{scale * row['value']:{form}}{unit}",
                "limit": f"{scale * row['limit']:g}{unit}",
                "use": row["value"] / row["limit"] if known else None,
                "met": {True: "met", False: "not met", None: f"no value: {row['reason']}"}[row["met"]],
                "source": row["source"],
            }
        )
    table = pl.DataFrame(rows, schema_overrides={"storey": pl.UInt32, "value": pl.String, "use": pl.Float64})
    return described_html(
        "assessment: checks",
        table,
        "Largest value over the storeys beside its limit. Drift and stability are those of the means over the motions.",
        formats={"use": use_html, "met": _verdict, "source": long_html},
    )


def _verdict(text: str) -> Markup:
    looks = {"met": "good", "not met": "warn"}
    return Markup('<span class="{}">{}</span>').format(looks.get(text, ""), text)


def _fractions(result: Assessment, pictures: Pictures) -> list[Markup]:
    if not result.effective:
        return [text_html("There are no goods on the floors.")]
    if not result.answer.analyses:
        return [text_html(f"There is none, because {lettered(result.answer.reason or '')}.")]
    low, high = result.mu_factors
    words = {SLIDING: "as stated", SLIDING_HIGH: f"{high:g} times", SLIDING_LOW: f"{low:g} times"}
    rows = [
        {
            "friction": words[model],
            "value": "no value" if math.isnan(one.value) else f"{one.value:.2f}",
            "interval": _interval(one) + ("" if one.statistic == "mean" else f", by the {one.statistic}"),
            "kind": KIND_TEXTS[one.kind],
            "by_hand": one.by_hand.estimate,
        }
        for model, one in result.effective.items()
    ]
    share = result.effective[SLIDING]
    rule = share.by_hand
    return [
        pictures.figure(
            "effective_fraction",
            f"Mean largest drift, {OVER_MODEL}, against the share {LAMBDA} of the goods attached.",
            f"The curve for friction as stated crosses one at a share of {_number(share.value)}."
            if math.isfinite(share.value)
            else "For friction as stated there is no share.",
        ),
        table_html(
            pl.DataFrame(rows),
            "Effective fraction of the goods present by friction, and the rule by hand, without a run: "
            f"{lettered(f'{rule.words_in(result.units)}. {RULE_IN_WORDS}')}. In the runs the mean peak base shear with "
            f"all goods attached is {share.base_shear_coefficient:.4f} of the weight.",
            headers={
                "value": EFFECTIVE,
                "kind": "what that is",
                "interval": f"{100.0 * share.confidence:g} % interval",
                "by_hand": f"by hand, {lettered(rule.formula)}",
            },
            formats={"kind": long_html, "by_hand": ".2f"},
        ),
    ]


def _drifts(result: Assessment, pictures: Pictures) -> list[Markup]:
    ratio = result.drift_limit is not None
    scale, unit = result.units.drifts(ratio=ratio)
    called = pl.col("model").replace_strict(NAMES, default=pl.col("model"), return_dtype=pl.String)
    row = result.governing.sort("governing", descending=True).row(0, named=True)
    note = f"The largest is {scale * row['governing']:.2f} {unit}, storey {row['storey']}, {row['governed_by']}."
    is_tall = len(result.storey_names) > MOST_STOREYS  # the first sheet has not all of them
    return [
        *(storeys_html(result, len(result.storey_names)) if is_tall and result.answer.analyses else []),
        pictures.figure(
            "drift",
            "What each storey uses of its drift limit, ground at the bottom: analyses by their numbers, goods that "
            "slide over the three frictions as a band; and the slip of its floor at the friction with the most."
            if ratio
            else "Drift of each storey, and the slip of its floor.",
            note,
        ),
        described_html(
            "assessment: storeys",
            result.storeys.with_columns(model=called),
            f"Peak drift of each storey ({'% of the height' if ratio else unit}) by model over the motions.",
            units={"drift": (unit, lambda value: f"{scale * value:.2f}")},
        ),
    ]


def _analysis(result: Assessment) -> list[Markup]:
    """What to type into another program."""
    if not result.answer.analyses:
        return []
    table, options = analysis_table(result)
    caption = "Mass of each floor for another program, and the multiplier of the design live load in its mass source."
    return [described_html("assessment: analysis", table, caption, **options)]


def _slip(result: Assessment) -> list[Markup]:
    confidence = 100.0 * result.metadata["confidence"]
    caption = f"Peak and residual slip over the motions; the interval is that of {confidence:g} % of the peak at 84 %."
    return [described_html("assessment: slip", result.slip, caption, units=slip_units(result))]


def _provenance(result: Assessment) -> list[Markup]:
    facts = result.metadata
    runs, models = result.runs.filter(storey=1).height, len(result.collapses)
    return [
        facts_html(
            {
                "Program": f"seismass {facts['package_version']}",
                "Runs": f"{runs}: {models} models under {facts['motions']} motions each, beside those of the fractions",
                "Intervals": f"{100.0 * facts['confidence']:g} %, by {facts['resamples']} resamples of the motions "
                f"(bootstrap, random seed {facts['seed']})",
                "Damping of the models": str(facts["damping"]),
                "Inputs, SHA-256": facts["inputs_sha256"],
                "Processor instructions": f"{facts['instructions']}; with the same ones numbers are the same bits on "
                "every machine",
                "Format of the tables": f"version {facts['schema_version']}",
            }
        )
    ]


def whole_page(result: Assessment, edited: tuple[str, ...] = (), progress: ProgressLike = None) -> str:
    """Return the page with its figures; `edited` are files that were edited, `progress` is told of figures drawn."""
    return page_with(result, drawn_figures(result, progress)[1], edited)


def drawn_figures(result: Assessment, progress: ProgressLike = None) -> tuple[dict[str, Figure], dict[str, str]]:
    """Figures and their SVG texts, each drawn once for its file and for the page."""
    from seismass.media.svg import figure_svgs
    from seismass.show.assessment.figures import assessment_figures

    figures = assessment_figures(result)
    return figures, figure_svgs(figures, progress)


def page_with(result: Assessment, drawings: dict[str, str], edited: tuple[str, ...] = ()) -> str:
    """Return the page with the SVG texts of its figures; those for phones are drawn."""
    from seismass.media.svg import figure_svgs
    from seismass.show.assessment.figures import PHONE_SIZE, assessment_figures, sheet_figure

    for_phones = figure_svgs(assessment_figures(result, PHONE_SIZE) | {"sheet": sheet_figure(result)})
    return building_page(result, drawings, for_phones, edited)
