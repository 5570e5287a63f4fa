"""Building files and assessments in two directions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import seismass as sm

TABLES: dict[str, Any] = {
    "site": {"sds_g": 1.0, "sd1_g": 0.6},
    "building": {"period_s": 0.4, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 3},
    "goods": {"live_load_kpa": 6, "friction": "timber-on-steel", "mu_factors": [1.0, 1.0]},
    "storeys": [{}, {"live_load_kpa": 0}],
}
PAIRS = list(sm.records.builtin_pairs())[:3]


def with_other(**other: Any) -> sm.OwnBuilding:
    return sm.read_building(TABLES | {"other_direction": other})


def test_an_empty_table_is_the_same_building() -> None:
    building = with_other()
    alone = sm.read_building(TABLES)
    assert building.other == alone
    assert building.scene().other_direction == building.scene().building


def test_what_is_given_replaces_what_stands_in_x() -> None:
    building = with_other(period_s=0.5, R=5, damping=0.03)
    other = building.other
    assert other is not None
    assert other.period() == pytest.approx(0.5, rel=1e-12)
    assert other.design is not None
    assert (other.design.R, other.damping) == (5.0, 0.03)
    scene = building.scene()
    assert isinstance(scene.other_direction, sm.Building)
    # Sa = S_DS from 0.2 T_S to T_S = 0.6 s for both (0.42 and 0.52 s with the mass of the design), and equal shapes:
    # the strengths are as 1/R.
    assert scene.building is not None
    np.testing.assert_allclose(scene.other_direction.yield_shear, scene.building.yield_shear * 3.0 / 5.0, rtol=1e-9)
    stated = with_other(yield_shear_over_weight=0.2, storeys=[{"stiffness_kn_per_m": 5e4}, {"stiffness_kn_per_m": 4e4}])
    assert stated.other is not None
    assert stated.other.design is None
    np.testing.assert_allclose(stated.other.stiffness, [5e7, 4e7])


def test_unknown_keys_and_numbers_of_storeys_are_refused() -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match="other_direction"):
        with_other(height_m=3.0)
    with pytest.raises(sm.errors.InvalidBuildingFile, match="as many tables as the building has storeys, 2"):
        with_other(storeys=[{}])


@pytest.mark.parametrize("table", [1, [], "x", [{}], True])
def test_what_is_not_a_table_is_refused(table: Any) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=r"other_direction of .* must be a table of keys"):
        sm.read_building(TABLES | {"other_direction": table})


STRENGTHS = [{"yield_shear_kn": 900.0}, {"yield_shear_kn": 500.0}]


def test_strengths_of_single_storeys_stand_in_place_of_the_design() -> None:
    """Of a designed building and of one of stated strengths; what y states itself beside them is refused."""
    other = with_other(period_s=0.7, storeys=STRENGTHS).other
    assert other is not None
    assert other.design is None
    np.testing.assert_allclose(other.yield_shear, [9e5, 5e5])
    assert other.period() == pytest.approx(0.7, rel=1e-12)
    building = {key: value for key, value in TABLES["building"].items() if key not in ("design", "R")}
    stated = TABLES | {"building": building | {"yield_shear_over_weight": 0.3}}
    both = sm.read_building(stated | {"other_direction": {"storeys": STRENGTHS}})
    assert both.other is not None
    np.testing.assert_allclose(both.other.yield_shear, [9e5, 5e5])
    for beside in ({"R": 4}, {"design": True, "R": 4}):
        with pytest.raises(sm.errors.InvalidBuildingFile, match="must be left out where"):
            with_other(storeys=STRENGTHS, **beside)
    with pytest.raises(sm.errors.InvalidBuildingFile, match="must be left out where"):
        with_other(period_s=0.7, storeys=[{"stiffness_kn_per_m": 5e4}, {"stiffness_kn_per_m": 4e4}])


def test_an_assessment_takes_pairs_for_two_directions_and_records_for_one() -> None:
    with pytest.raises(sm.errors.InvalidMotion, match="motion 1 of assessment must be a Pair"):
        sm.assess(with_other(), [pair.first for pair in PAIRS])
    with pytest.raises(sm.errors.InvalidMotion, match="motion 1 of assessment must be a Record or Motion"):
        sm.assess(TABLES, PAIRS)


def test_an_assessment_in_two_directions() -> None:
    building = with_other(period_s=0.5)
    result = sm.assess(building, PAIRS, resamples=20, threads=2)
    real = result.runs.filter(model="real", storey=1)
    scaled = [pair.scaled(float(factor)) for pair, factor in zip(PAIRS, result.scaling.factors, strict=True)]
    peaks = np.array([sm.simulate(building.scene(), pair).peak_drift[0] for pair in scaled])
    # The same runs of the kernel: equal to the bit.
    assert real["peak_drift"].to_list() == peaks[:, :2].max(axis=1).tolist()
    assert real["peak_drift_y"].to_list() == peaks[:, 1].tolist()
    assert result.effective["real"].metadata["drift"] == "larger"
    assert "on 3 pairs of synthetic motions, none recorded" in result.text
    assert "friction of goods is of the circle" in " ".join(result.text.split())
    # From 0.2 of the shorter first period to 1.5 of the longer, both with the goods attached.
    assert building.other is not None
    ends = [0.2 * building.period(building.goods_mass), 1.5 * building.other.period(building.goods_mass)]
    np.testing.assert_allclose(result.scaling.periods[[0, -1]], ends, rtol=1e-12)
    # One factor: the mean of the SRSS of both components' spectra is the target where it governs (16.1.3.2).
    spectra = [sm.response_spectrum([pair.first, pair.second], result.scaling.periods) for pair in scaled]
    mean = np.mean([np.sqrt(first**2 + second**2) for first, second in spectra], axis=0)
    assert np.min(mean / result.scaling.target) == pytest.approx(1.0, rel=1e-12)
