"""Sliding bases in batches, effective fractions and building files."""

from typing import Any

import numpy as np
import pytest

import seismass as sm

SUITE = [record.scaled(2.0) for record in sm.builtin_suite("seven")[:3]]
COARSE: dict[str, Any] = {"fractions": np.linspace(0.0, 1.0, 11), "resamples": 100}


def scene(base: sm.SlidingBase | None, mu: float = 0.1) -> sm.Scene:
    building = sm.Building([2e5, 2e5], 1e8, yield_shear=2e6)
    return sm.Scene(building, [sm.Block(1, mass=1e5, mu=mu), sm.Block(2, mass=5e4, mu=mu)], base=base)


def test_a_batch_tells_of_bases() -> None:
    """The numbers of single runs; null where there is none."""
    sliding = scene(sm.SlidingBase(0.08, radius=2.0, mass=3e5))
    table = sm.simulate_many([sliding, scene(None)], SUITE[:2])
    for row in table.head(2).iter_rows(named=True):
        run = sm.simulate(sliding, SUITE[row["motion"] - 1])
        assert row["peak_base_slip"] == run.peak_base_slip > 0.0
        assert row["residual_base_slip"] == run.residual_base_slip
        assert row["base_slip_path"] == run.base_slip_path
        assert row["peak_base_acceleration"] == run.peak_base_acceleration
    assert table["peak_base_slip"].null_count() == 2


def test_a_model_keeps_the_base_of_the_real_weight() -> None:
    """mu W and W/R are those of slab, floors and goods: 300 + 400 + 150 t over 300 + 400 + 150 f t."""
    model = sm.attached_scene(scene(sm.SlidingBase(mu_s=0.1, mu_k=0.08, radius=2.0, mass=3e5)), 0.2)
    assert model.base is not None
    assert model.building is not None
    more = 850.0 / 730.0
    assert model.base.mu_s == pytest.approx(0.1 * more, rel=1e-14)
    assert model.base.mu_k == pytest.approx(0.08 * more, rel=1e-14)
    assert model.base.radius == pytest.approx(2.0 / more, rel=1e-14)
    assert model.base.slab_mass(model.building) == pytest.approx(3e5, rel=1e-14)


def test_a_model_of_unequal_goods_and_storeys_keeps_the_base(unequal_scene: sm.Scene) -> None:
    """Slab 53.3 t, floors 102.2 t, goods 51.9 t above; 6.7 t of goods and a slab of 53.3 t below."""
    below = sm.Block(0, mass=6.7e3, mu_s=0.23, mu_k=0.19)
    base = sm.SlidingBase(mu_s=0.11, mu_k=0.073, radius=2.3, mass=53.3e3)
    real = unequal_scene.replace(base=base, blocks=[*unequal_scene.blocks, below])
    for share in (0.0, 0.37, 1.0):
        model = sm.attached_scene(real, share)
        assert model.base is not None
        assert model.building is not None
        more = (53.3 + 6.7 + 102.2 + 51.9) / (53.3 + 102.2 + share * 51.9)
        found = (model.base.mu_s, model.base.mu_k, model.base.radius, model.base.slab_mass(model.building))
        assert found == pytest.approx((0.11 * more, 0.073 * more, 2.3 / more, 53.3e3), rel=1e-13)
        np.testing.assert_allclose(
            model.building.mass, 1e3 * (np.array([44.1, 35.7, 22.4]) + share * np.array([30.4, 13.7, 7.8])), rtol=1e-14
        )


def test_goods_that_stick_are_attached() -> None:
    """With a base that slides and goods that do not the model with all of them is the real building, to rounding."""
    sticking = scene(sm.SlidingBase(0.06, mass=3e5), mu=5.0)
    attached = sm.attached_scene(sticking, 1.0)
    for motion in SUITE:
        real, model = sm.simulate(sticking, motion), sm.simulate(attached, motion)
        np.testing.assert_allclose(real.peak_drift, model.peak_drift, rtol=1e-11)
        assert real.peak_base_slip == pytest.approx(model.peak_base_slip, rel=1e-11)
    result = sm.effective_mass(sticking, SUITE, **COARSE)
    assert (result.kind, result.value) == ("stuck", 1.0)
    assert any("sliding base" in remark for remark in result.remarks)


def test_a_base_that_never_slides_is_the_ground() -> None:
    firm, stuck = (sm.effective_mass(scene(base), SUITE, **COARSE) for base in (None, sm.SlidingBase(9.0, mass=3e5)))
    assert firm.kind == "root"
    assert stuck.value == pytest.approx(firm.value, abs=1e-9)


def test_a_base_makes_goods_stick() -> None:
    """Sliders of mu = 0.05 leave goods of mu = 0.3 where they stand; on firm ground they slide."""
    above = sm.Building([2e5, 2e5], 1e9, yield_shear=np.inf, damping=0.05)
    goods = [sm.Block(2, mass=1e5, mu=0.3)]
    firm, isolated = (
        sm.effective_mass(sm.Scene(above, goods, base=base), SUITE, **COARSE)
        for base in (None, sm.SlidingBase(0.05, mass=3e5))
    )
    assert (firm.kind, firm.value) == ("zero", 0.0)
    assert (isolated.kind, isolated.value) == ("stuck", 1.0)


def file(**base: Any) -> dict[str, Any]:
    return {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.3, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 2},
        "goods": {"live_load_kpa": 6, "mu": 0.3},
        "storeys": [{}, {"live_load_kpa": 0}],
    } | ({"base": base} if base else {})


def test_a_base_of_a_file() -> None:
    building = sm.read_building(file(mu_s=0.08, mu_k=0.06, radius_m=2.5, mass_kg=2e5))
    assert building.base == sm.SlidingBase(mu_s=0.08, mu_k=0.06, radius=2.5, mass=2e5)
    motions = [record.with_duration(10.0) for record in SUITE]
    found = sm.assess(building, motions, scale=False, mu_factors=(1, 1), resamples=2)
    told = " ".join(found.advice)
    assert "The base slips" in told
    assert "does not know a sliding base" in told
    assert any(line.startswith("Base: slides") and "slab of 200 t" in line for line in found.assumptions)
    assert found.runs["peak_base_slip"].null_count() == 0
    firm = sm.assess(file(), motions, scale=False, mu_factors=(1, 1), resamples=2)
    assert firm.runs["peak_base_slip"].null_count() == firm.runs.height
    assert found.metadata["inputs_sha256"] != firm.metadata["inputs_sha256"]


@pytest.mark.parametrize(
    ("base", "message"),
    [
        ({"radius_m": 2.0}, "base.mu of building must be given, or base.mu_s"),
        ({"mu": 0.1, "mu_s": 0.1}, "base.mu"),
        ({"mu": -0.1}, "base.mu"),
        ({"mu_s": 0.1, "mu_k": 0.2}, "base.mu_k"),
        ({"mu": 0.1, "radius": 2.0}, "radius_m"),
        ({"mu": 0.1, "mass_kg": 1.0, "mass_ratio": 1.0}, "mass"),
    ],
)
def test_bases_that_are_refused(base: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(file(**base))


@pytest.mark.parametrize("table", ["base", "walls"])
def test_a_table_without_keys_is_not_as_if_it_were_left_out(table: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=rf"{table}\..* of building must be given"):
        sm.read_building(file() | {table: {}})
