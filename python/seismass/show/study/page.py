"""The page of a study: its figure and one line first, then findings, figures and tables, validation, provenance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

import polars as pl
from markupsafe import Markup, escape

from seismass.media.page import (
    Section,
    bullets_html,
    described_html,
    edited_html,
    facts_html,
    figure_html,
    long_html,
    page_html,
    table_html,
    text_html,
)
from seismass.media.roles import ALPHA, ATTACHED, CODE, MU, SLIDE, lettered, sentence_html
from seismass.media.svg import short_svg
from seismass.show.animation.html import element_html
from seismass.show.study.answer import (
    SHORT,
    answer,
    assumptions,
    compared_rules,
    labels_of,
    one_line,
    percent,
    provenance,
    span,
)
from seismass.show.study.figures import slip_demand
from seismass.show.study.tables import fractions_table, slip_table, storeys_table, validations, without_one_friction
from seismass.studies.study.run import StudyResult, motions_text
from seismass.studies.validation.three_storeys import PEAK_G

VERDICT_CLASSES: Final = {"reproduced": "good", "not reproduced": "warn"}
"""How verdicts on claims stand out."""


class Pictures:
    """Drawings by name, as figures of the page."""

    def __init__(self, drawings: Mapping[str, str], for_phones: Mapping[str, str]) -> None:
        self._drawings, self._for_phones = drawings, for_phones

    def named(self, stem: str) -> list[str]:
        """Return the names of the drawings of one kind, in their order."""
        return [name for name in self._drawings if name == stem or name.startswith(f"{stem}_")]

    def figure(self, name: str, caption: str, alt: str) -> Markup:
        """Return one figure; nothing where there is no such drawing."""
        if name not in self._drawings:
            return Markup("")
        narrow = short_svg(self._for_phones[name]) if name in self._for_phones else None
        return figure_html(short_svg(self._drawings[name]), caption, alt, narrow=narrow)


def validation_section(result: StudyResult, page: Pictures) -> Iterator[Section]:
    """Section 4 of the paper by several programs, and its shaking table; nothing where they were not made."""
    facts, made = result.validation, validations(result)
    if facts is None or made is None:
        return
    section4, platform = made
    parts = [
        text_html(
            f"The three-storey building of the paper's section 4, its record scaled to {PEAK_G:g} g; motion: "
            f"{facts['section4_motion']}. The exact kernel stands beside OpenSees, whose results are kept with the "
            "package, and beside stiff springs in the place of friction."
        )
    ]
    for name in page.named("section4"):
        if name == "section4_sliding":
            continue
        component = name.removeprefix("section4_")
        parts.append(
            page.figure(
                name,
                f"Drift of the storeys and slip of the blocks by several programs, component {component} (the paper's "
                "Fig. 5).",
                f"Histories of drift and slip under component {component}: the programs lie on one another.",
            )
        )
    parts += [
        described_html(
            "study: section4_differences",
            section4.differences,
            "Largest difference of histories from those of the exact kernel, and that over the largest drift or slip.",
            units={unit: (unit, ".2g") for unit in ("mm", "%")},
        ),
        page.figure(
            "section4_sliding",
            "Peak slip of each block against the second slope r2, which the paper does not state.",
            "Where goods slide most depends on the second slope, the component and the peak of the record.",
        ),
    ]
    robust = platform.robust
    table = [
        text_html(
            f"The platform at 1:15 of the paper's Fig. 4; motion: {facts['platform_motion']}, compressed in time. The "
            "paper gives neither its period nor friction and damping: bands are over the ranges stated in the figure. "
            f"The block slides in {robust['slides']} of {robust['runs']} runs and lowers the drift in "
            f"{robust['below_attached']} of these."
        )
    ]
    for name in page.named("platform"):
        component = name.removeprefix("platform_")
        table.append(
            page.figure(
                name,
                f"Drift of the platform with two blocks, component {component} (the paper's Fig. 4): bands over "
                "friction and damping, and peaks over the period.",
                "Bands of drift histories of the platform for both mass ratios, with the central values and with the "
                "block attached.",
            )
        )
    yield Section("Validation", [], [Section("Three storeys", parts), Section("Shaking table", table)])


def sensitivity_section(result: StudyResult, page: Pictures) -> Iterator[Section]:
    """What each choice changes, where that was asked for."""
    table = result.sensitivity
    if not table.height:
        return
    as_is = table.filter(choice=table["choice"][0])["largest_percent"].drop_nulls()
    low, high = (table["largest_percent"].drop_nulls().to_numpy() for _ in range(2))
    change = f"from {percent(low.min())} to {percent(high.max())}" if as_is.len() else "without a number"
    yield Section(
        "Sensitivity",
        [
            text_html("The study again with each choice that the paper leaves open changed alone."),
            page.figure(
                "sensitivity",
                "Largest underestimation of a first storey under each choice.",
                f"The largest underestimation of a first storey goes {change} over the choices.",
            ),
            described_html(
                "study: sensitivity",
                without_one_friction(table),
                f"Underestimation of first storeys under each choice. Means are over those with the largest {ALPHA}; "
                "that at the largest R is made of the mass that the code leaves out and of sliding.",
                units={"%": ("", percent)},
            ),
        ],
    )


def example_section(result: StudyResult) -> Iterator[Section]:
    """One building in motion, beside the model of the code."""
    if result.animation is None:
        return
    facts = result.animation["about"]
    labels = facts["labels"]
    yield Section(
        "Example",
        [
            text_html(
                f"A building of the study with goods that slide, beside the model of the code: {labels['occupancy']}, "
                f"{labels['storeys']} storeys, R = {labels['R']:g}, {ALPHA} = {labels['alpha']:g}, {MU} = "
                f"{labels['mu']:g}, under {facts['motion']} scaled to {facts['peak_g']:.2f} g. It is the building with "
                "the largest underestimation of a first storey among those whose goods slide, under the motion whose "
                "underestimation is closest to that of the means."
            ),
            element_html(result.animation["element"]),
        ],
    )


def claims_section(result: StudyResult) -> Iterator[Section]:
    """Claims of the paper with verdicts, where validations were made."""
    table = result.claims
    if not table.height:
        return
    counts = table["verdict"].value_counts(sort=True).rows()
    words = ", ".join(f"{count} {verdict}" for verdict, count in counts)
    yield Section(
        "Claims of the paper",
        [
            text_html(
                "Claims of the paper's abstract, sections 4 and 5 and conclusions, with the numbers of this study: "
                f"{words}. Verdicts follow from rules on the tables."
            ),
            described_html(
                "study: claims",
                table,
                "Each claim: whether it holds here, our numbers, and what the verdict depends on.",
                formats={
                    "verdict": _verdict,
                    **dict.fromkeys(("claim", "numbers", "depends_on"), lambda text: long_html(lettered(text))),
                },
            ),
        ],
    )


def _verdict(verdict: str) -> Markup:
    kind = VERDICT_CLASSES.get(verdict)
    return Markup('<span class="{}">{}</span>').format(kind, verdict) if kind else escape(verdict)


_PAPER_FIGURES: Final = {
    factor: f" (the paper's Fig. {number})" for factor, number in ((1.0, 6), (2.0, 7), (4.0, 8), (6.0, 9))
}


def study_page(
    result: StudyResult,
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
    fraction = _fraction(result, page)
    sections = [
        Section("Findings", [text_html(*(Markup(lettered(paragraph)) for paragraph in answer(result)))]),
        Section("Underestimation", _underestimation(result, page, others)),
        Section("Drift demands", [text_html(_MODELS)], list(_drifts(result, page))),
        *([Section("Effective fraction", fraction)] if fraction else []),
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
    if not result.fractions["effective"].drop_nulls().len():
        title = "Drifts that the code's share of the live load underestimates: a study"
    return page_html(title, sections, subtitle=subtitle, description=line, lead=lead)


_MODELS: Final = (
    f"Each building is solved three times under each motion: with goods that may slide ({SLIDE.name}), with the code's "
    f"share of their mass attached to the floors ({CODE.name}), and with all of it ({ATTACHED.name}). The numbers at "
    f"the right are ({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name} of the capped mean drifts."
)
_UNDERESTIMATION: Final = (
    "Underestimation of drift against R: the storey with the largest, and the range over the storeys of each building. "
    "Rings: what the model with all goods attached gives over that of the code, where none of it is due to sliding."
)


def _remarks(metadata: dict[str, Any]) -> Iterator[Markup]:
    if metadata["remarks"]:
        yield Markup('<div class="note"><p>Remarks on the inputs</p>{}</div>').format(bullets_html(metadata["remarks"]))


def _motions(result: StudyResult, page: Pictures) -> list[Markup]:
    metadata = result.metadata
    factors = (
        result.tables["scaling"]
        .with_columns(
            pl.Series("name", [motion["record"] for motion in metadata["suite"]["motions"]]),
            pl.Series("pga", [motion["pga_g"] for motion in metadata["suite"]["motions"]], dtype=pl.Float64),
            pl.Series("remarks", ["; ".join(motion["remarks"]) for motion in metadata["suite"]["motions"]]),
        )
        .select("motion", "name", "record", "pga", "individual_factor", "common_factor", "factor", "remarks")
    )
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
        described_html(
            "study: scaling",
            factors,
            "Scaling factors: the factor of each motion is its own times the common one.",
            headers={"name": "motion", "pga": "PGA unscaled (g)"},
            formats={"pga": ".3f", **({"remarks": long_html} if "remarks" in factors.columns else {})},
        ),
    ]


def _drifts(result: StudyResult, page: Pictures) -> Iterator[Section]:
    frictions, factors = labels_of(result.summary["mu"]), labels_of(result.summary["R"])
    for factor, label in factors.items():
        figures = []
        for mu, name in frictions.items():
            rows = result.summary.filter(R=factor, mu=mu)
            missed = rows["underestimation_percent"].drop_nulls()
            span = f"{percent(float(missed.min()))} to {percent(float(missed.max()))}" if missed.len() else "none"  # type: ignore[arg-type]
            suffix = f"_mu{name}" if len(frictions) > 1 else ""
            figures.append(
                page.figure(
                    f"drift_R{label}{suffix}",
                    f"Capped mean drift of each storey, R = {label}, {MU} = {mu:g}{_PAPER_FIGURES.get(factor, '')}.",
                    f"Drift by storey with sliding goods and of both models at R = {label}: underestimation {span}.",
                )
            )
        yield Section(f"R = {label}", figures)


def _underestimation(result: StudyResult, page: Pictures, others: list[str]) -> list[Markup]:
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


def _fraction(result: StudyResult, page: Pictures) -> list[Markup]:
    fractions = result.fractions
    parts = []
    if "effective" in page.named("effective"):
        parts.append(
            page.figure(
                "effective",
                "Effective fraction of each building with its 90 % interval over the motions, the rule by hand, and "
                "the fractions of the code.",
                f"Effective fractions against {MU}/C1, {span(fractions['effective'])}, beside the rule by hand.",
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


def _slip(result: StudyResult, page: Pictures) -> list[Markup]:
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
