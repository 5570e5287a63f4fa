"""Words and constants of the page of two directions are true of the stored cases, and its code runs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import seismass as sm
from pages import two_directions as page
from pages.parts import ROOT, Page
from seismass.effective_mass.rule import REDUCED_FRICTION, SLIP_IN_EACH, SLIP_LENGTH

CASES: list[dict[str, Any]] = page.kept()["cases"]
FAR_FIELD = page.sliding(CASES, "far_field")


def test_what_one_direction_misses_is_that_of_the_cases() -> None:
    slid = [case for case in FAR_FIELD if case["slip_one"] > 1e-3]
    ratio = [case["slip_ratio"] for case in slid]
    # The constants have one decimal, or are rounded to 0.05.
    found = [page.in_sum(slid, "slip_ratio"), min(ratio), max(ratio)]
    assert found == pytest.approx(list(SLIP_IN_EACH), abs=0.051)
    assert page.in_sum(slid, "length_ratio") == pytest.approx(SLIP_LENGTH, abs=0.051)


def test_words_of_the_page() -> None:
    one, two = (np.array([case[f"value_{name}"] for case in FAR_FIELD]) for name in ("one", "two"))
    assert np.mean(two - one) < -0.05  # a smaller share acts on average
    assert np.mean([case["drift_ratio"] for case in FAR_FIELD]) < 1.0
    bias = [page.bias_of_factor(FAR_FIELD, factor) for factor in (REDUCED_FRICTION, 1.0)]
    # The factor is nearer to the real drift than none.
    assert abs(np.log(bias[0])) < abs(np.log(bias[1]))


def test_the_code_of_the_page_runs() -> None:
    found = Page(ROOT / "docs" / "two_directions.md").example()
    assert isinstance(found["answer"], sm.EffectiveMass)
    assert found["table"].height == 3
