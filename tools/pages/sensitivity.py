"""What the choices of the study do, under recorded motions and under the built-in ones."""

from __future__ import annotations

from pages.parts import Page
from seismass.motions.records import Suite, builtin_suite, read_suite
from seismass.motions.spectra import TargetSpectrum
from seismass.show.study.write import sensitivity_markdown
from seismass.studies.study import StudyResult, study_sensitivity
from seismass.studies.study.run import motions_text


def fill(page: Page) -> None:
    """Put in the tables of the built-in suite, and those of the recordings where they are asked for."""
    page.section("## Built-in synthetic motions", part(builtin_suite("seven")))
    if page.wants("recorded"):
        page.section("## Recorded motions", part(read_suite(page.records / "paper_seven.csv")))


def part(suite: Suite, as_is: StudyResult | None = None) -> str:
    """Return the tables of one suite."""
    found = study_sensitivity(suite, TargetSpectrum.asce7(), as_is=as_is)
    return f"{motions_text(found.metadata['suite'])} ({suite.name}).\n\n{sensitivity_markdown(found.table)}"
