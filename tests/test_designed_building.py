"""Buildings that a code designs from loads, system and site: by hand, and as building files have them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass import design

G = sm.STANDARD_GRAVITY
SITE = sm.TargetSpectrum.asce7(0.9, 0.5)


def test_one_storey_by_hand() -> None:
    """T = 1.4 x 0.0488 x 4.5^0.75, V = W S_DS/R, k = (2 pi/T)^2 W/g, drift C_d V/k/h, theta (D + L)/(k h)."""
    found = design.designed_building(
        [4.7e3], [5.6e3], SITE, 3.25, heights=4.5, fraction=0.25, area=800.0, deflection=3.0, overstrength=1.7
    )
    period = 1.4 * 0.0488 * 4.5**0.75
    weight = 800.0 * (4.7e3 + 0.25 * 5.6e3)
    shear = weight * 0.9 / 3.25
    k = (2.0 * np.pi / period) ** 2 * weight / G
    building = found.building
    assert found.design.period == pytest.approx(period, rel=1e-12)
    assert found.approximate_period == pytest.approx(period / 1.4, rel=1e-12)
    assert building.mass[0] == pytest.approx(800.0 * 4.7e3 / G, rel=1e-14)
    assert building.stiffness[0] == pytest.approx(k, rel=1e-10)
    assert building.yield_shear[0] == pytest.approx(shear, rel=1e-14)
    assert building.overstrength.tolist() == [1.7]
    assert building.gravity_load is not None
    assert building.gravity_load[0] == pytest.approx(800.0 * 4.7e3, rel=1e-14)
    assert found.checks["design_drift"][0] == pytest.approx(3.0 * shear / k, rel=1e-10)
    assert found.checks["theta"][0] == pytest.approx(800.0 * (4.7e3 + 5.6e3) / k / 4.5, rel=1e-10)
    assert (found.floors, found.load_ratio.tolist()) == ((1,), [5.6 / 4.7])


LOADS: dict[str, Any] = {"heights": [4.1, 3.6, 3.3], "fraction": 0.25, "area": 700.0}
DEAD, LIVE = [5.1e3, 4.4e3, 2.3e3], [6.3e3, 5.2e3, 0.0]


def test_lateral_forces_and_period_of_three_storeys() -> None:
    found = design.designed_building(DEAD, LIVE, SITE, 6.0, system="steel-moment-frame", **LOADS)
    weight = 700.0 * (np.array(DEAD) + 0.25 * np.array(LIVE))
    period = 1.4 * 0.0724 * 11.0**0.8
    assert found.design.period == pytest.approx(period, rel=1e-10)
    modes = design.vibration_modes(weight / G, found.building.stiffness)
    assert modes.periods[0] == pytest.approx(period, rel=1e-12)
    forces = weight * np.cumsum([4.1, 3.6, 3.3]) ** (1.0 + (period - 0.5) / 2.0)
    shear = np.cumsum((forces / forces.sum())[::-1])[::-1] * weight.sum() * 0.5 / period / 6.0
    np.testing.assert_allclose(found.building.yield_shear, shear, rtol=1e-10)
    np.testing.assert_allclose(
        found.building.stiffness / (shear + shear[0]), found.building.stiffness[0] / shear[0] / 2.0
    )
    assert found.floors == (1, 2)


def test_a_drift_limit_makes_a_building_stiffer() -> None:
    options = LOADS | {"system": "steel-moment-frame", "deflection": 5.5}
    loose, tight = (design.designed_building(DEAD, LIVE, SITE, 8.0, drift_limit=x, **options) for x in (0.03, 0.004))
    assert tight.design.period < loose.design.period
    ratio = float((tight.checks["design_drift"] / np.array([4.1, 3.6, 3.3])).max())  # type: ignore[arg-type]
    assert 0.8 * 0.004 < ratio <= 0.004 * 1.001


def test_strengths_are_those_of_building_files() -> None:
    """The same function designs the building of a file: here its modal procedure, given the same stiffnesses."""
    found = design.designed_building(DEAD, LIVE, SITE, 6.0, procedure="modal", **LOADS)
    file = {
        "name": "twin",
        "site": {"sds_g": 0.9, "sd1_g": 0.5},
        "code": {"id": "asce7-10"},
        "building": {"area_m2": 700.0, "design": True, "R": 6.0},
        "goods": {"use": "storage", "mu": 0.4},
        "storeys": [
            {"height_m": h, "stiffness_kn_per_m": 1e-3 * k, "dead_load_kpa": 1e-3 * dead, "live_load_kpa": 1e-3 * live}
            for h, k, dead, live in zip(LOADS["heights"], found.building.stiffness, DEAD, LIVE, strict=True)
        ],
    }
    twin = sm.read_building(file)
    np.testing.assert_allclose(twin.code_design().yield_shear, found.building.yield_shear, rtol=1e-10)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"live_load": [6e3, 5e3]}, "live_load of designed building must be 3 numbers"),
        ({"fraction": 1.2}, "fraction of designed building must be between 0 and 1"),
        ({"code_id": "ec9"}, "id of code must be"),
        ({"procedure": "static"}, "procedure of design must be modal or lateral-force"),
        ({"system": "tent"}, "system"),
    ],
)
def test_wrong_designs(arguments: dict[str, Any], said: str) -> None:
    options = {"dead_load": DEAD, "live_load": LIVE, "target": SITE, "reduction": 6.0} | LOADS | arguments
    with pytest.raises(sm.errors.InvalidOption, match=said):
        design.designed_building(**options)


def test_lateral_forces_need_heights() -> None:
    with pytest.raises(sm.errors.InvalidOption, match="heights of design by lateral forces must be known"):
        design.design_by_code(np.full(2, 1e5), np.full(2, 4e7), SITE, 4.0, procedure="lateral-force")
