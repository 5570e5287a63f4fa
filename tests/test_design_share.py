"""The share for W of an assessment where designed buildings collapse: a share, or none with the reason."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.assessment.answer import design_share, fractions_by_friction
from seismass.effective_mass.models import DEFAULT_FRACTIONS

TWO_STOREYS = Path(__file__).with_name("data") / "two_storeys.json"
"""A building file: two storeys with goods on the first, that slide under the built-in suite."""


def building(collapse: float | None) -> sm.assessment.OwnBuilding:
    tables: dict[str, Any] = json.loads(TWO_STOREYS.read_text(encoding="utf-8"))
    if collapse is not None:
        tables["building"]["collapse_drift_ratio"] = collapse
    return sm.read_building(tables)


@pytest.fixture(scope="module")
def motions() -> list[sm.Record]:
    return [record.scaled(1.5) for record in sm.builtin_suite("eleven")]


@pytest.fixture(scope="module")
def largest(motions: list[sm.Record]) -> np.ndarray:
    """Largest drift ratio by design share and motion, each by a run of its own."""
    own = building(None)
    rows = []
    for share in DEFAULT_FRACTIONS:
        scene = sm.Scene(own.structure(None, share * own.goods_mass), own.scene().blocks)
        rows.append([(sm.simulate(scene, motion).peak_drift / 4.0).max() for motion in motions])
    return np.array(rows)


def test_without_a_collapse_it_is_that_of_the_public_function(motions: list[sm.Record]) -> None:
    own = building(None)
    alone = sm.effective_mass_of_design(
        lambda share: own.structure(None, share * own.goods_mass),
        own.scene().blocks,
        motions,
        fractions=DEFAULT_FRACTIONS,
        resamples=1,
    )
    found = design_share(own, None, 1.0, motions, None, None)
    assert found.reason == ""
    assert found.effective is not None
    assert found.effective.value == alone.value
    assert found.effective.statistic == "mean"


def test_few_collapses_leave_a_share(motions: list[sm.Record], largest: np.ndarray) -> None:
    """A collapse ratio between the two largest drifts of the weakest design: one of eleven falls there."""
    worst = np.sort(largest, axis=1)
    ratio = 0.5 * (worst[:, -1].max() + worst[:, -2].max())
    assert ((largest > ratio).sum(axis=1) <= 1).all()
    found = design_share(building(ratio), None, 1.0, motions, None, None)
    assert found.effective is not None
    assert found.effective.statistic == "mean"
    assert 0.0 <= found.effective.value <= 1.0


def test_many_collapses_leave_none_and_say_which(motions: list[sm.Record], largest: np.ndarray) -> None:
    """The designs with two and more of eleven runs above the ratio, as those runs say."""
    second = np.sort(largest, axis=1)[:, -2]
    ratio = float(np.median(second))
    fallen = (largest > ratio).sum(axis=1)
    many = DEFAULT_FRACTIONS[fallen > 1]
    found = design_share(building(ratio), None, 1.0, motions, None, None)
    assert found.effective is None
    assert found.reason == (
        f"the building designed with shares of {many[0]:.2f} to {many[-1]:.2f} of the goods present collapses under up "
        f"to {fallen.max()} of 11 motions"
    )


def test_frictions_have_their_models_in_common(motions: list[sm.Record]) -> None:
    """The runs: three frictions and 21 shares, and what roots take beside; values as each friction alone gives."""
    own, calls = building(None), []
    frictions = {"real": 1.0, "real_mu_low": 0.67, "real_mu_high": 1.5}
    bootstrap = {"confidence": 0.9, "resamples": 20, "seed": 0}
    found = fractions_by_friction(
        own, None, frictions, motions, bootstrap, None, lambda done, total: calls.append((done, total))
    )
    assert calls[-1] == ((3 + 21) * 11, (3 + 21) * 11)
    for name, factor in frictions.items():
        alone = sm.effective_mass(own.scene(mu_factor=factor), motions, resamples=20)
        assert found[name].to_dict() == alone.to_dict()
