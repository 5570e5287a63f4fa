"""Parts of the page of a study beside its own figures: validation, sensitivity, the example, claims of the paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from markupsafe import Markup, escape

from seismass.media.page import Section, figure_html, table_html, text_html
from seismass.media.page_lists import long_html
from seismass.media.roles import ALPHA, MU, lettered
from seismass.media.svg import short_svg
from seismass.show.animation.html import element_html
from seismass.show.study.answer import percent
from seismass.show.study.tables import StudyTables
from seismass.validation.three_storeys import PEAK_G

VERDICT_CLASSES: Final = {"reproduced": "good", "not reproduced": "warn", "depends": "warn"}
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


def validation_section(result: StudyTables, page: Pictures) -> Iterator[Section]:
    """Section 4 of the paper by several programs, and its shaking table; nothing where they were not made."""
    if result.section4 is None or result.platform is None:
        return
    about = result.metadata["validation"]
    differences = result.section4.differences.rename({"second_slope": "r2"})
    parts = [
        text_html(
            f"The three-storey building of the paper's section 4, its record scaled to {PEAK_G:g} g; motion: "
            f"{about['section4_motion']}. The exact kernel stands beside OpenSees, whose results are kept with the "
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
        table_html(
            differences,
            "Largest difference of histories from those of the exact kernel, and that over the largest drift or slip.",
            headers={
                "drift_mm": "drift (mm)",
                "drift_percent": "drift (%)",
                "slip_mm": "slip (mm)",
                "slip_percent": "slip (%)",
            },
            formats=dict.fromkeys(("drift_mm", "drift_percent", "slip_mm", "slip_percent"), ".2g"),
        ),
        page.figure(
            "section4_sliding",
            "Peak slip of each block against the second slope r2, which the paper does not state.",
            "Where goods slide most depends on the second slope, the component and the peak of the record.",
        ),
    ]
    robust = result.platform.robust
    table = [
        text_html(
            f"The platform at 1:15 of the paper's Fig. 4; motion: {about['platform_motion']}, compressed in time. The "
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


def sensitivity_section(result: StudyTables, page: Pictures) -> Iterator[Section]:
    """What each choice changes, where that was asked for."""
    table = result.sensitivity
    if table is None:
        return
    keys = ["choice", "setting", "occupancy", *(["mu"] if table["mu"].n_unique() > 1 else [])]
    names = {
        "largest_percent": "largest",
        "least_R_percent": "mean at the smallest R",
        "most_R_percent": "mean at the largest R",
        "mass_percent": "of that: left-out mass",
        "sliding_percent": "of that: sliding",
        "collapses": "collapsed runs",
    }
    as_is = table.filter(choice=table["choice"][0])["largest_percent"].drop_nulls()
    low, high = (table["largest_percent"].drop_nulls().to_numpy() for _ in range(2))
    said = f"from {low.min():+.0f} to {high.max():+.0f} %" if as_is.len() else "without a number"
    yield Section(
        "Sensitivity",
        [
            text_html("The study again with each choice that the paper leaves open changed alone."),
            page.figure(
                "sensitivity",
                "Largest underestimation of a first storey under each choice.",
                f"The largest underestimation of a first storey goes {said} over the choices.",
            ),
            table_html(
                table.select(*keys, *names),
                f"Underestimation of first storeys under each choice. Means are over those with the largest {ALPHA}; "
                "that at the largest R is made of the mass that the code leaves out and of sliding.",
                headers=names,
                formats={name: percent for name in names if name.endswith("percent")},
            ),
        ],
    )


def example_section(result: StudyTables) -> Iterator[Section]:
    """One building in motion, beside the model of the code."""
    if result.animation is None:
        return
    about = result.animation["about"]
    labels = about["labels"]
    yield Section(
        "Example",
        [
            text_html(
                f"A building of the study with goods that slide, beside the model of the code: {labels['occupancy']}, "
                f"{labels['storeys']} storeys, R = {labels['R']:g}, {ALPHA} = {labels['alpha']:g}, {MU} = "
                f"{labels['mu']:g}, under {about['motion']} scaled to {about['peak_g']:.2f} g. It is the building with "
                "the largest underestimation of a first storey among those whose goods slide, under the motion whose "
                "underestimation is closest to that of the means."
            ),
            element_html(result.animation["element"]),
        ],
    )


def claims_section(result: StudyTables) -> Iterator[Section]:
    """Claims of the paper with verdicts, where validations were made."""
    table = result.claims
    if table is None:
        return
    counts = table["verdict"].value_counts(sort=True).rows()
    said = ", ".join(f"{count} {verdict}" for verdict, count in counts)
    yield Section(
        "Claims of the paper",
        [
            text_html(
                "Claims of the paper's abstract, sections 4 and 5 and conclusions, with the numbers of this study: "
                f"{said}. Verdicts follow from rules on the tables."
            ),
            table_html(
                table.select("number", "claim", "verdict", "numbers", "depends_on", "source"),
                "Each claim: whether it holds here, our numbers, and what the verdict depends on.",
                headers={"number": "no.", "numbers": "our numbers", "depends_on": "depends on"},
                formats={
                    "verdict": _verdict,
                    "number": "d",
                    **dict.fromkeys(("claim", "numbers", "depends_on"), lambda text: long_html(lettered(text))),
                },
            ),
        ],
    )


def _verdict(verdict: str) -> Markup:
    kind = VERDICT_CLASSES.get(verdict)
    return Markup('<span class="{}">{}</span>').format(kind, verdict) if kind else escape(verdict)
