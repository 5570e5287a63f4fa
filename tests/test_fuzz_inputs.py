"""A small run of tools/fuzz_inputs.py: mutated input files end in a result or in one line of error."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import pytest


@pytest.mark.skipif(sys.platform != "linux", reason="counts memory as Linux does")
def test_mutated_inputs_end_in_a_result_or_one_error() -> None:
    fuzz = runpy.run_path(str(Path(__file__).parents[1] / "tools" / "fuzz_inputs.py"))["fuzz"]
    tally = fuzz(1400, 7)
    assert tally.defects == []
    assert sum(tally.counts.values()) == 1400
