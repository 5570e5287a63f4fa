"""Grids that vary buildings: each axis against the building made by hand, and the paper's own study as one grid."""

from __future__ import annotations

from itertools import product

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.design import response_spectrum_analysis
from seismass.motions.spectra import mean_spectrum
from seismass.studies.study import StudyParameters, run_study

BASE = sm.Building.uniform(
    3, 0.47, mass=2e5, yield_shear_over_weight=[0.3, 0.25, 0.12], heights=[3.7, 3.1, 2.9], gravity_load=2e6
)
MOTION = sm.builtin_suite("seven")[0]


def test_each_column_changes_its_own() -> None:
    grid = sm.Grid(
        BASE,
        period=[0.47, 0.94, 0.47],
        strength=[1.0, 1.0, 0.25],
        overstrength=[2.0, 1.5, 1.0],
        second_slope=[0.05, 0.0, 0.1],
    )
    # T is proportional to 1/sqrt(k).
    assert grid.scene(2).building.periods[0] == pytest.approx(0.94, rel=1e-14)
    np.testing.assert_allclose(grid.scene(2).building.stiffness, BASE.stiffness / 4.0, rtol=1e-14)
    third = grid.scene(3).building
    np.testing.assert_array_equal(third.yield_shear, BASE.yield_shear / 4.0)
    assert (third.overstrength[0], third.second_slope[0]) == (1.0, 0.1)
    np.testing.assert_allclose(grid.scene(1).building.stiffness, BASE.stiffness, rtol=1e-14)
    table = grid.table()
    assert table.columns == ["scene", "building", "storeys", "period", "strength", "overstrength", "second_slope"]
    assert table["period"].to_list() == [0.47, 0.94, 0.47]


def test_a_damping_matrix_keeps_its_ratios_when_the_period_changes() -> None:
    matrix = BASE.replace(damping=BASE.damping_matrix)
    one = sm.Grid(matrix, period=0.94).scene(1).building
    other = sm.Grid(BASE, period=0.94).scene(1).building  # 5 % in its own modes
    np.testing.assert_allclose(one.damping_matrix, other.damping_matrix, rtol=1e-9, atol=1e-9 * matrix.damping.max())


def test_rows_are_the_runs_of_their_scenes() -> None:
    grid = sm.Grid.product(
        [BASE, BASE.replace(heights=None, gravity_load=None)],
        period=[0.3, 0.6],
        strength=[0.5, 1.0],
        overstrength=[1.5, 2.0],
        second_slope=[0.0, 0.05],
        roof="bare",
        mass_ratio=[0.5, 1.5],
        attached=[0.0, 0.4],
        mu=[0.1, 0.4],
        scale=1.5,
    )
    assert len(grid) == 2**8
    results = sm.simulate_many(grid, MOTION)
    for frame in (sm.simulate_many(grid, MOTION, threads=1), pl.concat(sm.stream_many(grid, MOTION, chunk=37))):
        assert frame.equals(results)
    slid = 0
    for row in results.gather_every(7).iter_rows(named=True):
        alone = sm.simulate(grid.scene(row["scene"]), MOTION.scaled(1.5))
        assert row["peak_drift"] == alone.peak_drift.tolist()
        assert row["peak_slip"] == alone.peak_slip.tolist()
        slid += row["slips"]
    assert slid > 0
    last = grid.table(256)
    assert last.drop("building", "storeys").rows() == [(256, 0.6, 1.0, 2.0, 0.05, 1.5, 0.4, 0.4, 0.4, 1.5)]


def test_attached_load_is_mass_and_keeps_its_weight() -> None:
    shares = {"attached": [0.0, 0.25, 1.0, 0.25], "sliding": [1.0, 0.0, 0.0, 0.75]}
    grid = sm.Grid(BASE, roof="bare", mass_ratio=1.5, mu=0.4, **shares)
    load = np.array([1.5, 1.5, 0.0])
    for number, (attached, sliding) in enumerate(zip(*shares.values(), strict=True), start=1):
        scene = grid.scene(number)
        np.testing.assert_allclose(scene.building.mass, BASE.mass * (1.0 + attached * load), rtol=1e-15)
        np.testing.assert_allclose(scene.building.damping_matrix, BASE.damping_matrix, rtol=1e-12)  # "same"
        np.testing.assert_allclose(scene.block_mass, (sliding * load * BASE.mass)[:2] if sliding else [], rtol=1e-14)
        # P/h of all storeys is that of the whole live load, wherever it is counted.
        np.testing.assert_allclose(scene.geometric_stiffness, grid.scene(1).geometric_stiffness, rtol=1e-14)
    ratio = sm.Grid(BASE, roof="bare", mass_ratio=1.5, mu=0.4, attached=0.25, sliding=0.0, damping="ratio")
    heavier = BASE.replace(mass=BASE.mass * (1.0 + 0.25 * load), gravity_load=None)
    np.testing.assert_array_equal(ratio.scene(1).building.damping_matrix, heavier.damping_matrix)


def test_goods_that_never_slide_are_attached_mass() -> None:
    """With the damping matrix and the weight unchanged: the same equations of motion, to rounding."""
    grid = sm.Grid(BASE, mass_ratio=1.0, mu=50.0, attached=[0.0, 0.3, 1.0], scale=2.0)
    drifts = np.array(sm.simulate_many(grid, MOTION)["peak_drift"].to_list())
    np.testing.assert_allclose(drifts[1:], np.broadcast_to(drifts[0], (2, 3)), rtol=1e-9)


def test_bare_roofs_of_several_storeys_are_one_grid() -> None:
    grid = sm.Grid.product(storeys=[2, 3, 4], period=[0.38, 0.47, 0.57], roof="bare", mass_ratio=[0.5, 1.0], mu=0.4)
    assert len(grid) == 6
    for number, (storeys, ratio) in enumerate(product((2, 3, 4), (0.5, 1.0)), start=1):
        building = sm.Building.uniform(storeys, {2: 0.38, 3: 0.47, 4: 0.57}[storeys])
        blocks = sm.blocks_on_floors([ratio] * (storeys - 1) + [0.0], 0.4)
        assert grid.scene(number) == sm.Scene(building, blocks)
    assert grid.table().select("building", "storeys", "period").unique(maintain_order=True).rows() == [
        (1, 2, 0.38),
        (2, 3, 0.47),
        (3, 4, 0.57),
    ]
    loaded = sm.Grid(storeys=[4, 2, 4], period=0.5, mass_ratio=1.0, mu=0.4)
    assert loaded.table()["building"].to_list() == [1, 2, 1]
    assert [len(loaded.scene(number).blocks) for number in (1, 2, 3)] == [4, 2, 4]
    # The roof of one storey is all it has.
    assert sm.Grid(storeys=1, period=0.2, roof="bare", mass_ratio=1.0, mu=0.4).scene(1).blocks == ()


def test_the_study_of_the_paper_is_a_grid() -> None:
    """All three storeys, three models, four R and three alpha, with the strengths of the design: the study's drifts."""
    suite, target, parameters = sm.builtin_suite("seven"), sm.TargetSpectrum.asce7(), StudyParameters()
    study = run_study(suite, target, parameters)
    factors = study.scaling.factors
    periods = dict(parameters.buildings)
    columns: dict[str, list[object]] = {
        name: [] for name in ("storeys", "period", "strength", "mass_ratio", "attached", "sliding")
    }
    keys = []
    for (occupancy, share), storeys, reduction, ratio in product(
        (("storage", 0.25), ("commercial", 0.0)), periods, parameters.response_modification, parameters.mass_ratios
    ):
        bare = sm.Building.uniform(storeys, periods[storeys])
        mass = bare.mass + share * np.append(np.full(storeys - 1, ratio), 0.0)
        spectrum = lambda at: mean_spectrum(suite, factors, at)  # noqa: E731
        demand = response_spectrum_analysis(mass, bare.stiffness, spectrum).storey_shear / bare.weight
        for model, attached, sliding in (("real", 0.0, 1.0), ("code", share, 0.0), ("attached", 1.0, 0.0)):
            strength = np.full(storeys, np.inf) if reduction == 1.0 else demand / reduction
            row = (storeys, periods[storeys], strength, ratio, attached, sliding)
            for column, value in zip(columns.values(), row, strict=True):
                column.append(value)
            keys.append((occupancy, storeys, reduction, ratio, model))
    grid = sm.Grid(
        storeys=columns["storeys"],
        period=columns["period"],
        yield_shear_over_weight=columns["strength"],
        roof="bare",
        mass_ratio=columns["mass_ratio"],
        attached=columns["attached"],
        sliding=columns["sliding"],
        damping="same",  # as the study has it: the matrix of the bare building
        mu=parameters.mu[0],
    )
    motions = [record.scaled(factor) for record, factor in zip(suite, factors, strict=True)]
    table = sm.long_table(sm.simulate_many(grid, motions), grid)
    labels = pl.DataFrame(keys, schema=["occupancy", "storeys", "R", "alpha", "model"], orient="row")
    labels = labels.with_row_index("scene", offset=1).with_columns(pl.col("storeys").cast(pl.UInt32))
    joined = table.join(labels, on=["scene", "storeys"]).join(
        study.responses.select(
            "occupancy", "storeys", "R", "alpha", "model", "motion", "storey", "peak_drift", "peak_slip"
        ),
        on=["occupancy", "storeys", "R", "alpha", "model", "motion", "storey"],
        suffix="_of_study",
    )
    assert len(joined) == len(table) == study.responses.height
    for name in ("peak_drift", "peak_slip"):
        mine, theirs = joined[name], joined[f"{name}_of_study"]
        assert mine.is_null().to_list() == theirs.is_null().to_list()
        # Strengths are divided by the weight and multiplied by it again: an ulp, which yielding magnifies.
        np.testing.assert_allclose(mine.drop_nulls(), theirs.drop_nulls(), rtol=1e-12, atol=1e-15)


REFUSED = [
    ({"overstrength": [2.0, 0.9]}, r"overstrength of grid must be finite and at least 1; got 0\.9 as value 2"),
    ({"second_slope": 1.1}, r"second_slope of grid must be between 0 and 1; got 1\.1 as value 1"),
    ({"strength": [1.0, 0.0]}, "strength of grid must be a positive number; got 0 as value 2"),
    ({"period": -1.0}, "period of grid must be a positive number; got -1 as value 1"),
    ({"strength": 1.0, "yield_shear_over_weight": 0.2}, "strength of grid must be left out where yield_shear_over"),
    ({"yield_shear_over_weight": [[0.3, 0.2, 0.1], [0.3, 0.2]]},
     "yield_shear_over_weight of building of scene 2 must be one number or 3 values, one per storey; got 2 values"),
    ({"yield_shear_over_weight": [0.3, -0.2]}, "yield_shear_over_weight of grid must be positive"),
    ({"attached": 0.5}, "attached of grid must be left out where mass_ratio is; got 0.5"),
    ({"mass_ratio": 1.0, "mu": 0.3, "attached": 1.5}, r"attached of grid must be between 0 and 1; got 1\.5 as value 1"),
    ({"mass_ratio": 1.0, "mu": 0.3, "attached": 0.5, "sliding": [0.5, 0.6]},
     r"attached and sliding of grid must be shares of at most 1 together; got 1\.1 together as value 2"),
    ({"mass_ratio": 1.0, "mu": 0.3, "roof": "flat"}, "roof of grid must be loaded or bare; got 'flat'"),
    ({"mass_ratio": 1.0, "mu": 0.3, "roof": "bare", "floors": [1]}, "roof of grid must be left out where floors is"),
    ({"damping": "none"}, "damping of grid must be same or ratio"),
    ({"storeys": 2}, "building of grid must be given either as building or as storeys; got both"),
    ({"mass_ratio": 1.0, "mu": 0.3, "floors": [4], "attached": 0.5},
     "floor of live load of scene 1 must be a floor of the building, 1 to 3; got 4"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "message"), REFUSED)
@pytest.mark.parametrize("make", [sm.Grid, sm.Grid.product])
def test_wrong_values_are_refused_by_name(make: type[sm.Grid], given: dict[str, object], message: str) -> None:
    with pytest.raises(sm.errors.InvalidScene, match=f"^{message}"):
        make(BASE, **given)


def test_storeys_need_a_period_and_strength_needs_a_yield() -> None:
    with pytest.raises(sm.errors.InvalidScene, match="period of grid must be given where storeys is; got none"):
        sm.Grid(storeys=2)
    with pytest.raises(
        sm.errors.InvalidScene, match="period of grid must be one value, or as many as storeys has, 2; got 3"
    ):
        sm.Grid.product(storeys=[2, 3], period=[0.1, 0.2, 0.3])
    with pytest.raises(sm.errors.InvalidScene, match="strength of grid must be left out where buildings are elastic"):
        sm.Grid(sm.Building.uniform(2, 0.3), strength=0.5)
    with pytest.raises(sm.errors.InvalidScene, match="storeys of grid must be a whole number counted from 1"):
        sm.Grid(storeys=[0, 2], period=0.3)
