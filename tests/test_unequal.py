"""No two quantities of a kind in the scene, motions and building file of conftest.py can be taken for each other."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

import seismass as sm

# Ratios of whole numbers up to 4: 1, 1/2, 3/4, ...; to 1 %, below which a rough tolerance hides an exchange.
ROUND = sorted({p / q for p, q in itertools.product(range(1, 5), repeat=2)})


def alike(values: list[float]) -> list[tuple[float, float]]:
    """Pairs that are equal or in a round ratio."""
    return [
        (a, b) for a, b in itertools.combinations(values, 2) if any(a / b == pytest.approx(r, rel=0.01) for r in ROUND)
    ]


def kinds_of_scene(scene: sm.Scene, motions: tuple[sm.Record, ...]) -> dict[str, list[float]]:
    building, blocks = scene.building, scene.blocks
    assert building is not None
    assert building.heights is not None
    assert building.gravity_load is not None
    storeys: dict[str, Any] = {
        name: getattr(building, name)
        for name in ("stiffness", "yield_shear", "overstrength", "second_slope", "third_slope", "heights")
    }
    return {
        **{name: list(values) for name, values in storeys.items()},
        "mass": [*building.mass, *(block.mass for block in blocks)],
        "weight": [*(9.80665 * building.mass), *building.gravity_load],
        "friction": [mu for block in blocks for mu in (block.mu_s, block.mu_k)],
        "mu_k over mu_s": [1.0, *(block.mu_k / block.mu_s for block in blocks)],
        "slopes and damping": [*building.second_slope, *building.third_slope, building.damping],
        "time step": [motion.dt for motion in motions],
        "duration": [motion.duration for motion in motions],
        "peak": [abs(motion.acceleration).max() for motion in motions],
    }


def kinds_of_file(tables: dict[str, Any]) -> dict[str, list[float]]:
    storeys = tables["storeys"]
    goods = [kind for storey in storeys for kind in storey.get("goods", [storey])]
    found = {
        key: [storey[key] for storey in storeys]
        for key in ("height_m", "area_m2", "stiffness_kn_per_m", "yield_shear_kn", "overstrength")
    }
    weights = [storey["dead_load_kpa"] * storey["area_m2"] for storey in storeys]
    present = sum(
        kind.get("share", 1.0) * storey["live_load_kpa"] * storey["area_m2"] * kind["occupied"]
        for storey in storeys
        for kind in storey.get("goods", [storey])
    ) / sum(storey["live_load_kpa"] * storey["area_m2"] for storey in storeys)
    loads = [storey[key] for storey in storeys for key in ("dead_load_kpa", "live_load_kpa")]
    return {
        **found,
        "loads": loads,
        "weights": [*weights, *(storey["gravity_load_kn"] for storey in storeys)],
        "friction": [mu for kind in goods for mu in (kind["mu_s"], kind["mu_k"])],
        "mu_k over mu_s": [1.0, *(kind["mu_k"] / kind["mu_s"] for kind in goods)],
        # 0.25 is the share of the code; all of it, 1, is four times that.
        "shares": [0.25, present, *(kind["occupied"] for kind in goods)],
        "ratios": [
            *(storey[key] for storey in storeys for key in ("second_slope", "third_slope")),
            *(tables["building"][key] for key in ("damping", "drift_limit", "theta_limit")),
        ],
        "factors": [1.0, *tables["goods"]["mu_factors"]],
        "site": [1.0, *tables["site"].values()],
    }


def test_no_two_quantities_of_a_kind_are_alike(
    unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...], unequal_file: dict[str, Any]
) -> None:
    kinds = {f"scene: {name}": values for name, values in kinds_of_scene(unequal_scene, unequal_motions).items()}
    kinds |= {f"file: {name}": values for name, values in kinds_of_file(unequal_file).items()}
    assert {name: found for name, values in kinds.items() if (found := alike(values))} == {}


def test_the_goods_slide_and_the_storeys_yield(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]) -> None:
    """Else static friction, kinetic friction and slopes would not matter."""
    assert unequal_scene.building is not None
    yields = unequal_scene.building.yield_shear / unequal_scene.building.stiffness
    for motion in unequal_motions:
        run = sm.simulate(unequal_scene, motion)
        assert run.status == "completed"
        assert (run.peak_slip > 1e-3).all()
        assert (run.peak_drift > yields).all()
