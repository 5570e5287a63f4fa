"""The pages of a study and of a building in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The page of the study of the paper, with all that it may have but the sensitivity, which matches motions."""
    out = tmp_path_factory.mktemp("study")
    assert main(["study", "--effective", "--out", str(out)]) == 0
    return Path(out, "report.html").read_text(encoding="utf-8")


def test_page_of_a_study_is_as_every_page_must_be(study: str, look: Any) -> None:
    look(study, "study")


def test_claims_are_filtered_and_storeys_sorted(study: str, open_page: Any) -> None:
    with open_page(study, "study") as page:
        claims = page.locator(".table", has_text="Each claim")
        claims.locator("input").fill("section 4")
        shown = claims.locator("tbody tr:visible")
        assert 0 < shown.count() < claims.locator("tbody tr").count()
        storeys = page.locator(".table", has_text="Mean peak drift of every storey")
        header = storeys.locator("th button", has_text="under-estimation")
        header.click()
        header.click()
        first = storeys.locator("tbody tr").first.inner_text()
        # The largest underestimation of the built-in suite, as the page says first.
        assert "commercial" in first
        assert "+102" in first
        assert sm.__version__ in page.locator(".subtitle").inner_text()


def test_page_of_a_building_is_as_every_page_must_be(tmp_path: Path, look: Any) -> None:
    assert main(["building", str(example_file()), "--out", str(tmp_path)]) == 0
    look(Path(tmp_path, "report.html").read_text(encoding="utf-8"), "building")
