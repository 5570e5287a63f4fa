"""The effective fraction of many buildings in one table, against that of each alone."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass.base.stored_results import result_store

SUITE = [record.scaled(1.3) for record in sm.builtin_suite("seven")]
BUILDINGS = [sm.Building.uniform(n, 0.3 + 0.1 * n, yield_shear_over_weight=0.25, heights=3.4) for n in (2, 3)]
SCENES = [
    sm.Scene(building, sm.blocks_on_floors([ratio] * (building.storeys - 1) + [0.0], mu=mu))
    for building in BUILDINGS
    for ratio, mu in ((0.6, 0.15), (1.1, 0.3), (0.8, 40.0), (0.7, 0.0))
]
table = sm.evidence.effective_mass_table


def test_every_row_is_that_of_the_building_alone() -> None:
    rows = table(SCENES, SUITE)
    assert rows["scene"].to_list() == list(range(1, 9))
    for row, scene in zip(rows.iter_rows(named=True), SCENES, strict=True):
        alone = sm.effective_mass(scene, SUITE)
        assert row["kind"] == alone.kind
        assert row["value"] == pytest.approx(alone.value, abs=0.004)  # linear between shares 0.05 apart
        assert row["real"] == pytest.approx(sm.effective_mass(scene, SUITE).real, rel=1e-12)
    finer = table(SCENES[:2], SUITE, fractions=np.linspace(0.0, 1.0, 101))
    for value, scene in zip(finer["value"], SCENES, strict=False):
        assert value == pytest.approx(sm.effective_mass(scene, SUITE).value, abs=2e-4)


def test_a_grid_and_its_scenes_have_one_table() -> None:
    grid = sm.Grid.product(BUILDINGS[0], roof="bare", mass_ratio=[0.5, 1.0], mu=[0.1, 0.3])
    assert_frame_equal(table(grid, SUITE), table([grid.scene(i) for i in range(1, 5)], SUITE))
    scaled = sm.Grid.product(BUILDINGS[0], roof="bare", mass_ratio=0.5, mu=0.1, scale=[1.0, 2.0])
    with pytest.raises(sm.errors.InvalidOption, match="scenes of effective mass table must be a grid without scale"):
        table(scaled, SUITE)


def test_collapses_leave_no_fraction() -> None:
    weak = SCENES[0].replace(collapse_drift=1e-3)
    row = table([weak], SUITE).row(0, named=True)
    assert (row["kind"], row["value"], row["collapsed"]) == ("collapsed", None, 1.0)


def test_parts_that_are_there_are_not_solved_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    many = import_module("seismass.effective_mass.answer")

    monkeypatch.setattr(many, "_AT_ONCE", 2)
    told: list[tuple[int, int]] = []
    whole = table(SCENES, SUITE, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (8 * 22 * 7, 8 * 22 * 7)
    solved, solve = [], many.solve

    def counted(*args: Any, **options: Any) -> Any:
        solved.append(args)
        if len(solved) == 4:
            raise KeyboardInterrupt
        return solve(*args, **options)

    monkeypatch.setattr(many, "solve", counted)
    with pytest.raises(KeyboardInterrupt), result_store(tmp_path, "shares", "same") as store:
        table(SCENES, SUITE, store=store)
    with result_store(tmp_path, "shares", "same") as store:
        assert_frame_equal(table(SCENES, SUITE, store=store), whole)
    assert len(solved) == 4 + 6
