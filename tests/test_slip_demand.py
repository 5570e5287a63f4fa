"""Slip demand: closed forms on the ground, sides, clearances, sizes, estimates, and what is said and refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl
import pytest
from scipy import stats

import seismass as sm
from seismass.model.tipping import demand_in_g
from seismass.studies.slip import (
    Base,
    BlockSize,
    Clearance,
    asce43,
    newmark_bound,
    newmark_pulse,
    parse_size,
    signed_peaks,
    slip_demand,
    wilson_interval,
)
from seismass.studies.slip.clearance import exceedance_table

G = sm.STANDARD_GRAVITY


def block(mu: float, **options: float) -> sm.Scene:
    return sm.Scene(None, [sm.Block(0, mass=1.0, mu=mu, **options)])


def building(**options: object) -> sm.Building:
    return sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13], **options)  # type: ignore[arg-type]


def storage(mu: float = 0.2, **options: object) -> sm.Scene:
    return sm.Scene(building(**options), sm.blocks_on_floors([1.0, 1.0, 0.0], mu=mu))


@pytest.fixture(scope="module")
def suite() -> list[sm.Record]:
    return [record.scaled(2.0) for record in sm.builtin_suite("seven")]


def test_rectangular_pulse_on_the_ground() -> None:
    """A = 0.5 g for 0.4 s, then down to zero over one step: the closed form of the sampled motion."""
    dt, acceleration, mu = 0.01, 0.5 * G, 0.2
    motion = sm.Motion([acceleration] * 41 + [0.0] * 100, dt)
    friction = mu * G
    before = (acceleration - friction) * 0.4
    after = before + acceleration * dt / 2.0 - friction * dt
    slip = 0.5 * (acceleration - friction) * 0.4**2 + before * dt + acceleration * dt**2 / 3.0 - friction * dt**2 / 2.0
    slip += after**2 / (2.0 * friction)
    found = slip_demand(block(mu), motion).runs.row(0, named=True)
    assert found["peak_slip"] == pytest.approx(slip, rel=1e-13)
    assert found["ground_slip"] == found["peak_slip"]
    assert found["amplification"] == 1.0
    # The ground runs away under the block, which falls behind.
    assert found["slip_minus"] == found["peak_slip"]
    assert found["slip_plus"] == 0.0
    assert found["residual_slip"] == pytest.approx(-slip, rel=1e-13)


def test_newmark_estimate_is_exact_for_its_pulse() -> None:
    """V^2/(2 mu g) (1 - mu g/A): 0.5886 m with g = 9.81 for A = 0.5 g, 0.4 s, mu = 0.2; the pulse ends in one step."""
    motion = sm.Motion([0.5 * 9.81] * 40001 + [0.0] * 60000, 1e-5)
    found = slip_demand(block(0.2 * 9.81 / G), motion)
    assert found.blocks["mean"][0] == pytest.approx(0.5886, abs=2e-5)  # the last step adds a part of 2.5e-5
    pulse = found.estimates.filter(base="ground", estimate="newmark_pulse").row(0, named=True)
    assert pulse["ratio"] == pytest.approx(1.0, abs=1e-5)
    assert pulse["log_scatter"] == 0.0


@pytest.mark.parametrize(("mu", "slip"), [(0.20, 0.1798045), (0.30, 0.0637652), (0.40, 0.0149328), (0.45, 0.0036526)])
def test_half_sine_pulse(mu: float, slip: float) -> None:
    """Closed form of a block under A sin(pi t/td), A = 0.5 g, td = 0.4 s, g = 9.81; second order in dt."""
    time = np.arange(0.0, 1.0, 1e-4)
    motion = sm.Motion(np.where(time <= 0.4, 0.5 * 9.81 * np.sin(np.pi * time / 0.4), 0.0), 1e-4)
    assert slip_demand(block(mu * 9.81 / G), motion).blocks["mean"][0] == pytest.approx(slip, abs=2e-7)


def test_goods_with_more_friction_than_acceleration_do_not_slide(suite: list[sm.Record]) -> None:
    found = slip_demand(storage(50.0), suite, clearance=0.01)
    for column in ("mean", "largest", "slides", "residual_largest", "path_mean", "ground_mean"):
        assert found.blocks[column].to_list() == [0.0, 0.0]
    assert found.blocks["amplification"].null_count() == 2
    assert found.exceedance["exceeding"].sum() == 0
    assert found.blocks["mu_over_attached"].min() > 1.0
    assert "no block slides under any motion" in found.remarks


def test_goods_slide_exactly_where_friction_is_below_the_attached_floor_acceleration(suite: list[sm.Record]) -> None:
    for mu in (0.4, 0.6, 0.8):
        rows = slip_demand(storage(mu), suite).runs.filter(pl.col("collapsed").not_())
        slides = rows.group_by("motion").agg(
            (pl.col("peak_slip") > 0.0).any(), (pl.col("mu_over_attached") < 1.0).any()
        )
        assert slides["peak_slip"].to_list() == slides["mu_over_attached"].to_list()


def test_sides_follow_the_sign_of_the_motion(suite: list[sm.Record]) -> None:
    motion = suite[0].motion
    mirrored = sm.Motion(-motion.acceleration, motion.dt)
    one, other = slip_demand(storage(), motion).runs, slip_demand(storage(), mirrored).runs
    assert one["slip_plus"].to_list() == other["slip_minus"].to_list()
    assert one["slip_minus"].to_list() == other["slip_plus"].to_list()
    assert one.select(pl.max_horizontal("slip_plus", "slip_minus")).to_series().to_list() == one["peak_slip"].to_list()
    assert (one.select(pl.min_horizontal("slip_plus", "slip_minus")).to_series() > 0.0).any()


def test_the_side_that_goes_less_far_agrees_with_finer_samples(suite: list[sm.Record]) -> None:
    """The same motion, linear between its samples, sampled sixty times as often."""
    for record in suite[:3]:
        motion = record.motion
        fine_time = np.arange((motion.samples - 1) * 60 + 1) * (motion.dt / 60.0)
        fine = sm.Motion(np.interp(fine_time, motion.time, motion.acceleration), motion.dt / 60.0)
        runs = slip_demand(storage(), record).runs
        history = sm.simulate(storage(), fine, histories=True, displacements_only=True).slip
        for row in runs.iter_rows(named=True):
            slip = history[:, row["block"] - 1]
            assert row["slip_plus"] == pytest.approx(max(slip.max(), 0.0), abs=2e-5)
            assert row["slip_minus"] == pytest.approx(max(-slip.min(), 0.0), abs=2e-5)


def test_turns_of_a_cubic_are_exact() -> None:
    # Slip t^3 - t on steps of 1/2: extrema of 2/(3 sqrt 3) at -+1/sqrt 3 inside steps.
    time = np.arange(-1.2, 1.31, 0.5)[:, None]
    plus, minus = signed_peaks(time**3 - time, 3.0 * time**2 - 1.0, 0.5, np.array([10.0]))
    assert plus.tolist() == [10.0]  # the further side is the exact peak
    assert minus[0] == pytest.approx(1.2**3 - 1.2, rel=1e-12)
    plus, minus = signed_peaks(-(time**3 - time)[1:5], -(3.0 * time**2 - 1.0)[1:5], 0.5, np.array([0.6]))
    assert plus[0] == pytest.approx(2.0 / 3.0**1.5, rel=1e-12) or minus[0] == pytest.approx(2.0 / 3.0**1.5, rel=1e-12)


def test_no_side_goes_further_than_the_exact_peak() -> None:
    """Cubics that overshoot to both sides: the further side is the exact peak, the other one at most that."""
    rate = np.array([[2.0, -2.0], [2.0, -2.0], [2.3, -2.3]])
    plus, minus = signed_peaks(np.zeros((3, 2)), rate, 0.5, np.array([0.05, 0.07]))
    # 0.5 x 2 s (1 - s)(1 - 2 s) has its extrema of 0.096 at s = 1/2 -+ 1/sqrt(12).
    assert 0.5 * 2.0 * 3.0**-0.5 / 6.0 > 0.07
    assert plus.tolist() == minus.tolist() == [0.05, 0.07]


def test_stiff_building_is_the_ground(suite: list[sm.Record]) -> None:
    """An elastic storey of 0.004 s moves with the ground, so that goods slide as there; to (w dt)^-2 or so."""
    scene = sm.Scene(sm.Building.uniform(1, 0.004), [sm.Block(1, mass_ratio=0.5, mu=0.15)])
    found = slip_demand(scene, suite[:2])
    assert found.blocks["amplification"][0] == pytest.approx(1.0, abs=2e-3)
    floor = found.estimates.filter(base="floor", estimate="rigid_block")
    assert floor["ratio"][0] == pytest.approx(1.0, abs=5e-3)


def test_statistics_are_those_of_the_rows(suite: list[sm.Record]) -> None:
    found = slip_demand(storage(), suite)
    for row in found.blocks.iter_rows(named=True):
        own = found.runs.filter(block=row["block"])
        slip, ground = own["peak_slip"].to_numpy(), own["ground_slip"].to_numpy()
        assert row["mean"] == pytest.approx(slip.mean(), rel=1e-14)
        assert row["p84"] == pytest.approx(np.quantile(slip, 0.84), rel=1e-14)
        assert row["amplification"] == pytest.approx(slip.mean() / ground.mean(), rel=1e-14)
        assert row["amplification_median"] == pytest.approx(np.median(slip / ground), rel=1e-14)
        assert row["amplification_low"] < row["amplification"] < row["amplification_high"]
    table = sm.simulate_many(storage(), suite)
    assert found.runs.filter(block=2)["peak_slip"].to_list() == [row[1] for row in table["peak_slip"].to_list()]
    assert found.runs.filter(block=1)["floor_acceleration_g"].to_list() == pytest.approx(
        [row[0] / G for row in table["peak_floor_acceleration"].to_list()], rel=1e-15
    )


def test_unequal_goods_have_their_own_numbers(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]) -> None:
    """Slips, floors, frictions and estimates of four blocks, two of them on floor 1, each by runs of its own."""
    frictions = [(0.298, 0.214), (0.253, 0.154), (0.349, 0.184), (0.291, 0.24)]
    floors = [1, 1, 2, 3]
    found = slip_demand(unequal_scene, unequal_motions, clearance=0.03)
    assert found.blocks.select("floor", "mu_s", "mu_k").rows() == [
        (floor, *pair) for floor, pair in zip(floors, frictions, strict=True)
    ]
    alone, full = (sm.attached_scene(unequal_scene, share) for share in (0.0, 1.0))
    for number, record in enumerate(unequal_motions, start=1):
        real = sm.simulate(unequal_scene, record, histories=True)
        bare, attached = (sm.simulate(scene, record) for scene in (alone, full))
        rows = found.runs.filter(motion=number)
        for column, values in {
            "peak_slip": real.peak_slip,
            "residual_slip": real.residual_slip,
            "slip_path": real.slip_path,
            "floor_acceleration_g": real.peak_floor_acceleration[[0, 0, 1, 2]] / G,
            "alone_acceleration_g": bare.peak_floor_acceleration[[0, 0, 1, 2]] / G,
            "attached_acceleration_g": attached.peak_floor_acceleration[[0, 0, 1, 2]] / G,
        }.items():
            np.testing.assert_allclose(rows[column], values, rtol=1e-12, err_msg=column)
        static = np.array([mu_s for mu_s, _ in frictions])
        over = static * G / attached.peak_floor_acceleration[[0, 0, 1, 2]]
        np.testing.assert_allclose(rows["mu_over_attached"], over, rtol=1e-12)
        # The larger of both sides is the peak; each side is at least what samples show.
        np.testing.assert_array_equal(np.maximum(rows["slip_plus"], rows["slip_minus"]), real.peak_slip)
        assert (rows["slip_plus"].to_numpy() >= real.slip.max(axis=0)).all()
        assert (rows["slip_minus"].to_numpy() >= -real.slip.min(axis=0)).all()
        base = Base(record.motion, record.pga, record.pgv, 0.0)
        estimated = found.estimate_runs.filter(motion=number, base="ground")
        for place, (mu_s, mu_k) in enumerate(frictions, start=1):
            own = dict(estimated.filter(block=place).select("estimate", "slip").iter_rows())
            on_ground = sm.Scene(None, [sm.Block(0, mass=1.0, mu_s=mu_s, mu_k=mu_k)])
            assert own["rigid_block"] == pytest.approx(sm.simulate(on_ground, record).peak_slip[0], rel=1e-12)
            assert own["newmark_pulse"] == pytest.approx(newmark_pulse(base, mu_k), rel=1e-9)
            assert own["newmark_bound"] == pytest.approx(newmark_bound(base, mu_k), rel=1e-9)
        # Under a floor: the absolute velocity of the floor in the building alone, and the kinetic friction.
        under = sm.simulate(alone, record, histories=True)
        velocity = np.abs(under.floor_velocity + record.velocity[:, None]).max(axis=0)
        of_floor = found.estimate_runs.filter(motion=number, base="floor", estimate="newmark_pulse")["slip"]
        for slip, floor, (_, mu_k) in zip(of_floor, floors, frictions, strict=True):
            peak = under.peak_floor_acceleration[floor - 1]
            limit = mu_k * G
            expected = velocity[floor - 1] ** 2 / (2.0 * limit) * (1.0 - limit / peak) if peak > limit else 0.0
            assert slip == pytest.approx(expected, rel=1e-9)


def test_a_clearance_is_exceeded_beyond_it() -> None:
    """Slips of 0.1 and 0.2 m to one side, 0.3 and 0.05 m to the other one, against 0.1 and 0.05 m."""
    plus, minus = np.array([[0.1], [0.2]]), np.array([[0.3], [0.05]])
    table = exceedance_table(plus, minus, (Clearance(plus=0.1, minus=0.05),), 0.9)
    assert table.select("side", "exceeding", "clearance").rows() == [("+", 1, 0.1), ("-", 1, 0.05), ("any", 2, 0.05)]
    lost = exceedance_table(np.array([[np.inf]]), np.array([[np.inf]]), (Clearance(plus=0.1),), 0.9)
    assert lost.select("side", "exceeding").rows() == [("+", 1), ("any", 1)]


def test_clearances_by_side(suite: list[sm.Record]) -> None:
    found = slip_demand(storage(), suite, clearance=[Clearance(plus=0.1), Clearance(0.2, 0.05)], confidence=0.95)
    rows = {(row["block"], row["side"]): row for row in found.exceedance.iter_rows(named=True)}
    assert set(rows) == {(1, "+"), (1, "any"), (2, "+"), (2, "-"), (2, "any")}
    own = found.runs.filter(block=2)
    any_side = int(((own["slip_plus"] > 0.2) | (own["slip_minus"] > 0.05)).sum())
    assert rows[2, "any"]["exceeding"] == any_side
    assert rows[2, "-"]["exceeding"] == int((own["slip_minus"] > 0.05).sum())
    # scipy computes the interval of Wilson independently.
    for row in rows.values():
        expected = stats.binomtest(row["exceeding"], row["motions"]).proportion_ci(0.95, method="wilson")
        assert (row["low"], row["high"]) == pytest.approx((expected.low, expected.high), abs=1e-12)
    assert wilson_interval(0, 7, 0.9)[0] == 0.0
    assert wilson_interval(7, 7, 0.9)[1] == 1.0


def test_collapse_counts_as_lost_goods(suite: list[sm.Record]) -> None:
    scene = sm.Scene(building(heights=3.0), sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2), collapse_drift=0.11)
    found = slip_demand(scene, suite, clearance=10.0)
    lost = found.runs.filter(block=1, collapsed=True).height
    assert 0 < lost < 7
    assert found.exceedance.filter(block=1, side="any")["exceeding"][0] == lost
    assert np.isinf(found.blocks["largest"][0])
    assert found.blocks["amplification"][0] is None
    assert np.isfinite(found.blocks["median"][0])
    assert any("collapses under" in remark for remark in found.remarks)
    assert json.loads(found.to_json())["blocks"][0]["largest"] is None
    assert "inf" in found.text
    found.plot()


def test_after_a_collapse_the_ground_alone_has_its_acceleration(suite: list[sm.Record]) -> None:
    """Goods on the ground stand on what is known; under those on a floor nothing is known any more."""
    blocks = [sm.Block(0, mass=1e3, mu=0.2), *sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2)]
    scene = sm.Scene(building(heights=3.0), blocks, collapse_drift=0.001)
    runs = slip_demand(scene, suite[:1]).runs
    assert runs["collapsed"].to_list() == [True] * 3
    for column in ("attached_acceleration_g", "alone_acceleration_g"):
        values = runs[column].to_list()
        assert values[0] == pytest.approx(suite[0].pga / G, rel=1e-12), column
        assert all(value is None or np.isnan(value) for value in values[1:]), column


@pytest.mark.parametrize(
    ("mu", "collapse", "said"), [(0.2, None, False), (50.0, None, True), (50.0, 0.001, False), (0.2, 0.001, False)]
)
def test_that_no_block_slides_is_said_where_it_is_known(
    suite: list[sm.Record], mu: float, collapse: float | None, said: bool
) -> None:
    """Slips are some centimetres; after a collapse nothing is known of them."""
    found = slip_demand(storage(mu, heights=3.0).replace(collapse_drift=collapse), suite[:2])
    assert ("no block slides under any motion" in found.remarks) is said
    assert any("collapses under" in remark for remark in found.remarks) is (collapse is not None)


def test_squat_rule() -> None:
    low, tall = BlockSize(1.0, 1.2), BlockSize(0.3, 1.2)
    assert low.uplift_g == pytest.approx(1.0 / 1.2)
    assert tall.uplift_g == 0.25
    assert not low.rocks_first(0.8)
    assert tall.rocks_first(0.26)
    assert not tall.rocks_first(0.25)
    # b/(2 h_c) for a centre at a third of the height.
    assert BlockSize(0.6, 1.2, 0.4).uplift_g == pytest.approx(0.75)
    # Equilibrium of moments about an edge: m a h_c = m (g + a_v) b/2.
    for vertical in (-3.0, 0.0, 4.0):
        limit = tall.uplift_acceleration(vertical)
        assert limit * tall.centre_height == pytest.approx((G + vertical) * tall.width / 2.0, rel=1e-14)
    assert tall.uplift_acceleration(-20.0) == 0.0
    assert parse_size(" 0.3x1.2 ") == tall
    assert parse_size("1.0X1.2@0.5") == BlockSize(1.0, 1.2, 0.5)


def test_overturning_velocity_is_near_that_of_an_impulse() -> None:
    """0.4 sqrt(8 g R (1 - cos a)/(3 cos^2 a)) tends to 0.4 sqrt(2 g/3) = 1.0228 times B/sqrt(H) for slender blocks."""
    width, height = 0.01, 2.0
    angle, radius = np.arctan(width / height), 0.5 * np.hypot(width, height)
    energy = 0.4 * np.sqrt(8.0 * G * radius * (1.0 - np.cos(angle)) / (3.0 * np.cos(angle) ** 2))
    assert energy == pytest.approx(1.0228 * BlockSize(width, height).overturning_velocity, rel=1e-4)
    # 10 B/sqrt(H) in cm and s.
    assert BlockSize(0.3, 1.2).overturning_velocity == pytest.approx(0.01 * 10.0 * 30.0 / np.sqrt(120.0), rel=1e-14)
    assert BlockSize(0.3, 1.2, 0.4).overturning_velocity is None


def test_squat_table_flags_what_the_model_leaves_out() -> None:
    time = np.arange(0.0, 4.0, 0.005)
    motions = [sm.Motion(peak * G * np.sin(2.0 * np.pi * time), 0.005) for peak in (0.1, 0.2, 0.3, 0.6)]
    scene = sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.5), sm.Block(0, mass=1.0, mu=0.2)])
    found = slip_demand(scene, motions, sizes=BlockSize(0.3, 1.2))
    first, second = found.squat.iter_rows(named=True)
    assert (first["rocks_first"], first["uplift"]) == (True, 2)  # peaks above 0.25 g
    assert (second["rocks_first"], second["uplift"]) == (False, 0)  # slides at 0.2 g before it lifts off at 0.25 g
    # 0.3 g sin(2 pi t) from rest reaches A/pi w = 0.94 m/s, above 0.3/sqrt(1.2) = 0.27 m/s.
    assert first["overturning_limits_exceeded"] == 2
    assert any(remark.startswith("block 1 rocks before it slides") for remark in found.remarks)
    assert found.runs.filter(block=2)["uplift"].to_list() == [False] * 4
    none = slip_demand(scene, motions, sizes=[None, BlockSize(0.3, 1.2)])
    assert none.squat["block"].to_list() == [2]
    assert none.runs.filter(block=1)["uplift"].null_count() == 4


def test_vertical_motion_changes_the_weight() -> None:
    time = np.arange(0.0, 2.0, 0.01)
    horizontal, vertical = 0.2 * G * np.sin(np.pi * time), -0.5 * G * np.ones(len(time))
    motion = sm.Motion(horizontal, 0.01, vertical)
    found = slip_demand(block(0.5), motion, sizes=BlockSize(0.3, 1.0)).runs.row(0, named=True)
    assert found["acceleration_over_weight"] == pytest.approx(0.4, rel=1e-12)  # 0.2 g over half the weight, at a sample
    assert found["uplift"] is True
    assert demand_in_g(np.array([1.0, np.nan, 30.0]), np.array([0.0, 0.0, -G])) == pytest.approx(1.0 / G)


def test_estimates_by_hand() -> None:
    base = Base(sm.Motion([0.0, 1.0, 0.0], 0.1), 4.0, 0.8, 0.0)
    limit = 0.1 * G
    assert newmark_pulse(base, 0.1) == pytest.approx(0.8**2 / (2.0 * limit) * (1.0 - limit / 4.0), rel=1e-14)
    assert newmark_bound(base, 0.1) == pytest.approx(0.8**2 / (2.0 * limit) * 4.0 / limit, rel=1e-14)
    assert newmark_bound(base, 0.05) == pytest.approx(6.0 * 0.8**2 / limit, rel=1e-14)  # A/N above 6
    assert newmark_pulse(base, 0.5) == newmark_bound(base, 0.5) == 0.0
    assert newmark_pulse(base, 0.0) == newmark_bound(base, 0.0) == asce43(base, 0.0) == np.inf


def test_asce43_is_the_spectral_displacement_at_its_frequency(suite: list[sm.Record]) -> None:
    for record in suite:
        base = Base(record.motion, record.pga, record.pgv, 0.25 * G)
        mu = 0.1
        coefficient = 2.0 * mu * (1.0 - 0.4 * 0.25) * G
        slip = asce43(base, mu)
        period = 2.0 * np.pi * np.sqrt(slip / coefficient)
        found = sm.response_spectrum(record, [period, 1.02 * period, 1.2 * period, 2.0 * period], 0.10)[0]
        assert found[0] == pytest.approx(coefficient, rel=5e-3)  # by interpolation over 1.7 % of the period
        assert (found[2:] < coefficient).all()
    assert asce43(Base(suite[0].motion, 1.0, 1.0, 0.0), 5.0) == 0.0


def test_fragility_of_slip_on_the_ground_by_pga() -> None:
    """Slip under s a(t) with mu is s times that with mu/s: capacities of one motion by its own closed form."""
    motion = sm.Motion([0.5 * G] * 41 + [0.0] * 200, 0.01)
    # The clearance is the slip at 0.5 g: a capacity of exactly that PGA.
    clearance = float(slip_demand(block(0.2), motion).blocks["mean"][0])
    found = slip_demand(block(0.2), [motion, motion.scaled(2.0)], clearance=clearance, fragility=True, measure="pga")
    fit = found.fragilities[1]
    assert fit.median == pytest.approx(0.5, rel=2e-3)  # located to 1e-3
    assert found.metadata["measure"]["name"] == "pga"
    assert "by PGA" in found.text
    found.plot()


def test_one_sided_fragility_says_so(suite: list[sm.Record]) -> None:
    found = slip_demand(storage(), suite[:3], clearance=[None, Clearance(plus=0.2)], fragility=True, resamples=50)
    assert list(found.fragilities) == [2]
    assert any("as if both sides had it" in remark for remark in found.remarks)


def test_result_is_written_whole(tmp_path: Path, suite: list[sm.Record]) -> None:
    found = slip_demand(storage(), suite, clearance=0.1, sizes=BlockSize(1.0, 1.2))
    files = found.write(tmp_path / "out")
    assert {"slip_blocks.csv", "slip_runs.parquet", "slip_demand.json", "slip_demand.png"} <= {
        each.name for each in files
    }
    document = json.loads((tmp_path / "out" / "slip_demand.json").read_text(encoding="utf-8"))
    assert document["metadata"]["clearances"] == [[0.1, 0.1]] * 2
    again = slip_demand(storage(), suite, clearance=0.1, sizes=BlockSize(1.0, 1.2))
    assert again.to_json() == found.to_json()
    for words in ("in the building", "on the ground", "Clearance reached", "slides first", "ASCE/SEI 43-05"):
        assert words in found.text


def test_progress_and_recordings(shared: Path) -> None:
    records = sm.read_suite(shared / "records" / "paper_seven.csv")
    seen: list[tuple[int, int]] = []
    found = slip_demand(storage(), records, progress=lambda done, total: seen.append((done, total)))
    assert seen == [(number, 7) for number in range(1, 8)]
    assert (found.blocks["slides"] > 0.0).all()
    assert found.metadata["clusters"] == len({record.event or number for number, record in enumerate(records)})


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"clearance": 0.0}, "plus of clearance must be a positive number; got 0"),
        ({"clearance": [0.1]}, "clearance of slip demand must be a distance in m, a Clearance, or a list of 2"),
        ({"sizes": "1x1"}, "sizes of slip demand must be a BlockSize, or a list of 2"),
        ({"fragility": True}, "clearance of slip demand must be given for a fragility; got None"),
        ({"confidence": 1.0}, "confidence of slip demand must be above 0 and below 1; got 1"),
        ({"damping": "none"}, "damping of slip demand must be same or ratio; got 'none'"),
    ],
)
def test_what_is_refused(options: dict[str, object], message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption) as error:
        slip_demand(storage(), sm.builtin_suite("seven"), **options)  # type: ignore[arg-type]
    assert message in str(error.value)


def test_scenes_and_sizes_that_are_refused() -> None:
    with pytest.raises(sm.errors.InvalidScene, match="blocks of slip demand must be at least one; got none"):
        slip_demand(sm.Scene(building()), sm.builtin_suite("seven"))
    with pytest.raises(sm.errors.InvalidOption, match="plus of clearance must be given, or minus; got neither"):
        Clearance()
    with pytest.raises(sm.errors.InvalidOption, match="centre of block size must be at most the height, 1 m; got 2"):
        BlockSize(1.0, 1.0, 2.0)
    for text in ("1x", "axb", "1x2x3", ""):
        with pytest.raises(sm.errors.InvalidOption, match=r"size of block must be WIDTHxHEIGHT"):
            parse_size(text)
