"""Motions of an assessment's page: their spectra and factors, the building in motion, and the way to the live page."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup

from seismass.media.isolate import sentence_html
from seismass.media.live_address import PAGE as LIVE_PAGE
from seismass.media.page import figure_html, table_html, text_html
from seismass.media.page_lists import bullets_html
from seismass.media.roles import lettered
from seismass.media.svg import short_svg
from seismass.show.animation.html import element_html
from seismass.show.assessment.live import own_case
from seismass.show.assessment.tables import AssessmentTables


class Pictures:
    """Drawings by name, as figures of the page, each with the one for phones."""

    def __init__(self, drawings: Mapping[str, str], for_phones: Mapping[str, str]) -> None:
        self._drawings, self._for_phones = drawings, for_phones

    def figure(self, name: str, caption: str, alt: str) -> Markup:
        """Return one figure; nothing where there is no such drawing."""
        if name not in self._drawings:
            return Markup("")
        narrow = short_svg(self._for_phones[name]) if name in self._for_phones else None
        return figure_html(short_svg(self._drawings[name]), caption, alt, narrow=narrow)


def names_of(result: AssessmentTables) -> list[str]:
    """Return the names of the user's that sentences may contain."""
    document = result.document
    goods = [kind["name"] for kind in document["input"]["goods"]]
    return [document["name"], document["suite"]["name"], *result.storey_names, *goods, *document["suite"]["motions"]]


def motions_html(result: AssessmentTables, pictures: Pictures) -> list[Markup]:
    """Return on which motions the answer stands, their spectra, and their factors."""
    given, target = result.document["input"], result.document["target"]
    site = "" if target is None else " beside the site spectrum"
    parts = [
        text_html(sentence_html(f"The answer stands {result.document['on_motions']}.")),
        pictures.figure(
            "spectrum",
            f"Spectra of the motions as they load the building{site}; first periods without goods and with all.",
            f"Mean and scatter of the spectra of the motions{site}; first periods {given['period_bare']:.3g} and "
            f"{given['period_attached']:.3g} s.",
        ),
    ]
    if result.scaling is not None:
        parts.append(
            table_html(
                result.scaling,
                "Scaling factors: that of each motion is its own times the common one.",
                headers={
                    "motion": "number",
                    "record": "motion",
                    "individual_factor": "own factor",
                    "common_factor": "common factor",
                },
                formats=dict.fromkeys(("individual_factor", "common_factor", "factor"), ".4f"),
            )
        )
    return parts


def in_motion_html(result: AssessmentTables) -> list[Markup]:
    """Return the building under one motion, and the way to the live page."""
    parts = []
    if result.animation is not None:
        about = result.animation["about"]
        beside = (
            f", beside a model with {100.0 * about['fraction']:.0f} % of the goods present attached, the code's share"
        )
        parts += [
            text_html(
                sentence_html(
                    f"Under {about['motion']}, motion {about['number']}, scaled by {about['factor']:.3g} to a peak of "
                    f"{about['peak_g']:.2f} g: the motion with the median drift of those under which goods slide"
                    f"{beside if result.effective else ''}.",
                    names_of(result),
                )
            ),
            element_html(result.animation["element"]),
        ]
    return [*parts, *_live(result)]


def _live(result: AssessmentTables) -> list[Markup]:
    case, reasons, differences = own_case(result)
    if case is None:
        return [text_html(f"The live page cannot show this building: {'; '.join(reasons)}.")]
    link = Markup(
        '<a class="live" href="{page}#{address}">Open it in the live page</a> ({page} in the folder of this page, '
        "which <code>seismass building</code> writes where the package carries the kernel for browsers). There:"
    ).format(page=LIVE_PAGE, address=case.address)
    return [text_html(link), bullets_html(f"{lettered(line)}." for line in differences)]
