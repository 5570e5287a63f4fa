"""The page of two directions is what its tool makes of the stored cases; its words and constants are true of them."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.effective_mass.two_directions import REDUCED_FRICTION, SLIP_IN_EACH, SLIP_LENGTH

ROOT = Path(__file__).parents[1]
TOOL = runpy.run_path(str(ROOT / "tools" / "two_directions_page.py"))
CASES: list[dict[str, Any]] = TOOL["kept"]()["cases"]
FAR_FIELD = TOOL["sliding"](CASES, "far_field")


def test_the_page_is_current() -> None:
    page = TOOL["page"]()
    assert (ROOT / "docs" / "two_directions.md").read_text(encoding="utf-8") == page
    assert not any(f"{{{name}}}" in page for name in ("DRIFTS", "SLIPS", "RULES", "CODES", "FACTOR", "TIME"))


def test_what_one_direction_misses_is_that_of_the_cases() -> None:
    slid = [case for case in FAR_FIELD if case["slip_one"] > 1e-3]
    ratio = [case["slip_ratio"] for case in slid]
    # The constants have one decimal, or are rounded to 0.05.
    found = [TOOL["in_sum"](slid, "slip_ratio"), min(ratio), max(ratio)]
    assert found == pytest.approx(list(SLIP_IN_EACH), abs=0.051)
    assert TOOL["in_sum"](slid, "length_ratio") == pytest.approx(SLIP_LENGTH, abs=0.051)


def test_words_of_the_page() -> None:
    one, two = (np.array([case[f"value_{name}"] for case in FAR_FIELD]) for name in ("one", "two"))
    assert np.mean(two - one) < -0.05  # a smaller share acts on average
    assert np.mean([case["drift_ratio"] for case in FAR_FIELD]) < 1.0
    bias = [TOOL["bias_of_factor"](FAR_FIELD, factor) for factor in (REDUCED_FRICTION, 1.0)]
    # The factor is nearer to the real drift than none.
    assert abs(np.log(bias[0])) < abs(np.log(bias[1]))


def test_the_code_of_the_page_runs() -> None:
    parts = runpy.run_path(str(ROOT / "tools" / "page_parts.py"))
    found = parts["example"]((ROOT / "docs" / "two_directions.md").read_text(encoding="utf-8"))
    assert isinstance(found["answer"], sm.EffectiveMass)
    assert found["table"].height == 3
