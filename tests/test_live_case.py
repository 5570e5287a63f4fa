"""The link from a calculation page into the live page: its address, and what is said where it cannot be opened."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.media.page import DIFFERENCES, LIMITS, MOST_STOREYS
from seismass.show import explore
from seismass.show.assessment.page_input import Outcome, live_case

SCRIPT = (Path(explore.__file__).parent / "templates" / "case.js").read_text(encoding="utf-8")


def case_of(**changes: Any) -> Outcome:
    """What the live page opens of the example, its tables changed as told; the motions do not enter."""
    tables = tomllib.loads(example_file().read_text(encoding="utf-8"))
    for table, values in changes.items():
        tables[table] = values if table == "storeys" else {**tables[table], **values}
    motions = [record.with_duration(4.0) for record in sm.builtin_suite("forty")[:3]]
    return live_case(sm.assess(tables, motions, mu_factors=(1.0, 1.0), resamples=2))


def test_ranges_are_those_of_the_page() -> None:
    table = SCRIPT.partition("const LIMITS = {")[2].partition("};")[0]
    rows = re.findall(r"\w+: \[([-\d.]+|MOST_STOREYS), ([\d.]+|MOST_STOREYS), \"(\w+)\"", table)
    page = {letters: (low, high) for low, high, letters in rows}
    assert {key: tuple(map(float, page[key])) for key in LIMITS} == LIMITS
    assert f"const MOST_STOREYS = {MOST_STOREYS};" in SCRIPT


def numbers(said: dict[str, str], key: str) -> list[float]:
    return [float(value) for value in said[key].split(",")]


def test_the_example_is_opened_with_its_floors_and_its_site() -> None:
    case, reasons, differences = case_of()
    assert reasons == ()
    assert case is not None
    said = dict(part.split("=") for part in case.address.split("&"))
    # Dead loads of 6, 6, 6 and 4 kPa, goods of 0.8 times 7.2 kPa on three floors, over the mean floor.
    assert numbers(said, "a") == pytest.approx([0.8 * 7.2 / 5.5] * 3 + [0.0], rel=1e-9)
    assert numbers(said, "M") == pytest.approx([6.0 / 5.5] * 3 + [4.0 / 5.5], rel=1e-9)
    assert (said["n"], said["by"], said["T"], said["z"], said["h"]) == ("4", "hand", "0.57", "0.05", "4.5,4.5,4.5,4.5")
    assert (said["P"], said["o"]) == ("1", "0.8")
    assert said["c"] == "0.3125"  # 0.25 of the design live load, of which 0.8 is present
    # Three motions of the forty: the page has seven of its own, scaled to the site of the file for its period.
    assert differences == (DIFFERENCES["motions"],)
    assert said["W"] == "motions"
    scaled = sm.assess(example_file(), sm.builtin_suite("seven"), mu_factors=(1.0, 1.0), resamples=2).scaling
    assert scaled is not None
    assert numbers(said, "g") == pytest.approx(list(scaled.factors), rel=5e-3)  # between periods too


def test_under_the_motions_of_the_page_nothing_is_different_and_the_answer_goes_along() -> None:
    result = sm.assess(example_file(), sm.builtin_suite("seven"), mu_factors=(1.0, 1.0), resamples=2)
    case, _, differences = live_case(result)
    assert case is not None
    assert differences == ()
    said = dict(part.split("=") for part in case.address.split("&"))
    found = result.effective["real"]
    assert found.suite_interval is not None
    assert numbers(said, "F") == pytest.approx([found.value, *found.suite_interval, 7], rel=1e-9)
    assert result.scaling is not None
    assert numbers(said, "g") == pytest.approx(list(result.scaling.factors), rel=1e-9)
    assert "W" not in said


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"storeys": [{}] * 5}, "it has 5 storeys, and the live page solves up to 4"),
        ({"goods": {"stops": {"clearance_m": 0.05}}}, "its goods have stops"),
        ({"building": {"damping_from_storey": 2}}, "its lowest storeys are not damped"),
    ],
)
def test_what_cannot_be_expressed_is_said(changes: dict[str, Any], reason: str) -> None:
    assert case_of(**changes) == Outcome(None, (reason,), ())
