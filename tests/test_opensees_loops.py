"""The kernel's spring laws against loops of OpenSees that are kept as data."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def loops() -> Any:
    """benchmarks/spring_loops.py, which is in no package."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    try:
        return importlib.import_module("spring_loops")
    finally:
        sys.path.pop(0)


def differences(loops: Any, name: str) -> np.ndarray:
    """Kernel less OpenSees along the path, over V_y."""
    (case,) = (case for case in loops.CASES if case.name == name)
    found: np.ndarray = (case.forces(loops.drifts()[0]) - loops.kept()[name]) / loops.YIELD
    return found


def test_loops_differ_by_no_more_than_the_laws_do(loops: Any) -> None:
    """Tolerances and their reasons are those of the cases: rounding where the laws are the same."""
    parts = loops.drifts()[1]
    assert len(loops.CASES) == 17
    assert sum(max(case.full, case.partial) <= 1e-12 for case in loops.CASES) == 11
    for case in loops.CASES:
        difference = np.abs(differences(loops, case.name))
        assert difference[parts == "full"].max() <= case.full, case.name
        assert difference[parts == "partial"].max() <= case.partial, case.name


@pytest.mark.parametrize("name", ["clough-imk", "softening-imk"])
def test_aim_at_the_last_peak_is_the_only_other_rule_of_imk(loops: Any, name: str) -> None:
    """Equal until a storey reloads after its first small cycle, to -1 d_y, and again from the largest drift on."""
    turns = np.concatenate((loops.FULL, loops.PARTIAL))
    after_small = len(loops.FULL) + loops.PARTIAL.index(0.5)
    ends = np.cumsum(np.rint(np.abs(np.diff(turns, prepend=0.0)) / loops.STEP).astype(int))
    difference = np.abs(differences(loops, name))
    assert difference[: ends[after_small]].max() < 1e-12
    assert difference[ends[after_small] : ends[after_small + 1]].max() > 0.1
    largest = len(loops.FULL) + loops.PARTIAL.index(5.0)
    assert difference[ends[largest] - 1 :].max() < 1e-9  # at 5 d_y, beyond 4.5 d_y, and for the rest of the path


def test_yield_drift_of_imk_falls_with_its_strength(loops: Any) -> None:
    """At the first reloading with a loss beta: r2 beta (1 - beta), for a yield drift of 1 - beta in place of 1."""
    r2, capacity, peak = 0.05, 100.0, 1.0 + 0.05 * 0.5
    # To 1.5 d_y and back to zero force: work 1/2 + (1 + 1.025)/2 0.5 less 1.025^2/2, over V_y d_y.
    energy = 0.5 + 0.5 * (1.0 + peak) * 0.5 - 0.5 * peak**2
    beta = energy / (capacity - energy)
    path = loops.drifts()[0] / loops.YIELD_DRIFT
    at_yield = int(np.argmin(np.abs(path[:45] + 1.0)))  # on the first way to -1.5 d_y, before the second yield
    # Both aim at the yield point: the kernel at -(1 - beta), `IMKPeakOriented` at the force there of its backbone.
    expected = r2 * beta * (1.0 - beta)
    found = abs(differences(loops, "cyclic-hardening-imk")[at_yield])
    # `IMKPeakOriented` leaves the energy of the increment that passes zero out, 0.01^2/2 at most, over the capacity.
    assert found == pytest.approx(expected, abs=0.5 * 0.01**2 / capacity)
