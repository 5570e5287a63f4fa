"""Building files with goods on racks, walls and stops: what is read, what is refused, and what an assessment says."""

from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.assessment.file_keys import KEYS

SUITE = sm.builtin_suite("seven")[:3]


def file(**changes: Any) -> dict[str, Any]:
    given: dict[str, Any] = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.47, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 4},
        "goods": {"live_load_kpa": 6, "friction": "pallet-on-steel-beam"},
        "storeys": [{}, {}, {"live_load_kpa": 0}],
    }
    for key, value in changes.items():
        given[key] = {**given.get(key, {}), **value} if isinstance(value, dict) else value
    return given


def test_racks_of_a_file() -> None:
    """A rack for each loaded floor, the goods evenly on its levels, with the period, frame and strength stated."""
    rack = {"period_s": 0.8, "levels": 4, "frame": 0.1, "damping": 0.02, "yield_shear_over_weight": 0.2}
    scene = sm.read_building(file(goods={"on_racks": rack})).scene()
    assert not scene.blocks
    assert [each.floor for each in scene.racks] == [1, 2]
    goods = 6e3 * 500 / 9.80665
    first = scene.racks[0]
    np.testing.assert_allclose(first.alone().mass, 1.1 * goods / 4, rtol=1e-14)
    assert first.alone().periods[0] == pytest.approx(0.8, rel=1e-12)
    assert first.alone().yield_shear[0] == pytest.approx(0.2 * 1.1 * goods * 9.80665, rel=1e-14)
    assert first.damping == 0.02
    assert [block.block.mu_s for block in first.blocks] == [0.37] * 4


def test_a_direction_stands_for_a_period() -> None:
    """1.5 s down-aisle and 0.7 s cross-aisle, from memory, as the assumptions say; a floor may say otherwise."""
    given = file(goods={"on_racks": {"direction": "down-aisle"}})
    given["storeys"] = [{"on_racks": {"direction": "cross-aisle"}}, {"on_racks": False}, {}]
    building = sm.read_building(given)
    found = [None if kind.rack is None else kind.rack.period for kind in building.kinds]
    assert found == [0.7, None, 1.5]
    assert building.kinds[0].rack is not None
    assert building.kinds[0].rack.levels == KEYS["on_racks"]["levels"].number
    assert "from memory" in building.kinds[0].rack.how
    np.testing.assert_allclose(
        building.frames, KEYS["on_racks"]["frame"].number * building.goods_mass * [1, 0, 1], rtol=1e-14
    )
    assert building.sliding() == ((1, 0), (0, 1), (0, 2), (0, 3), (2, 1), (2, 2), (2, 3))


def test_kinds_of_goods_stand_differently() -> None:
    given = file()
    given["storeys"][0] = {
        "goods": [
            {"name": "tyres", "share": 0.5, "on_racks": {"period_s": 1.0}},
            {"name": "rolls", "share": 0.5, "stops": {"clearance_m": 0.05, "stiffness_kn_per_m": 2000}},
        ]
    }
    scene = sm.read_building(given).scene()
    assert len(scene.racks) == 1
    assert scene.blocks[0].stops == sm.Stops(0.05, 2e6)
    assert scene.blocks[1].stops is None


def test_stops_without_a_stiffness() -> None:
    """The goods on their stop have a period of 0.1 s."""
    block = sm.read_building(file(goods={"stops": {"clearance_m": 0.1}})).scene().blocks[0]
    assert block.stops is not None
    assert block.mass is not None
    assert 2.0 * np.pi * np.sqrt(block.mass / block.stops.stiffness) == pytest.approx(0.1, rel=1e-14)


def test_walls_of_a_file() -> None:
    """The stated period is that of storeys and walls together; alpha H is that of both."""
    building = sm.read_building(file(walls={"alpha_h": 2.0}))
    assert building.walls is not None
    assert building.period() == pytest.approx(0.47, rel=1e-12)
    frame = sm.Building(building.mass, building.stiffness, heights=building.heights)
    wall = sm.design.Wall.of_alpha_h(frame, 2.0)
    np.testing.assert_allclose(building.walls, wall.stiffness_matrix, rtol=1e-12)
    analysis = building.analysis()
    # The base shear of the modes is below 85 % of that of lateral forces (ASCE/SEI 7-10, 12.9.4.1).
    scale = building.code_design().scale
    assert scale > 1.0
    np.testing.assert_allclose(building.structure().yield_shear, scale * analysis.spring_shear / 4.0, rtol=1e-14)
    assert building.structure().periods[0] == pytest.approx(0.47, rel=1e-12)


def test_a_matrix_of_a_file() -> None:
    stated = [[300.0, -100.0, 0.0], [-100.0, 200.0, -50.0], [0.0, -50.0, 60.0]]
    given = file(walls={"stiffness_matrix_kn_per_m": stated})
    del given["building"]["period_s"]
    given["building"]["stiffness_kn_per_m"] = 5e4
    building = sm.read_building(given)
    np.testing.assert_array_equal(building.walls, 1e3 * np.array(stated))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"goods": {"on_racks": True}},
            "goods.on_racks of building must be a table with direction or period_s, or false",
        ),
        ({"goods": {"on_racks": {}}}, "on_racks.direction of building must be given, or goods.on_racks.period_s"),
        (
            {"goods": {"on_racks": {"direction": "across"}}},
            "direction of building must be one of down-aisle, cross-aisle",
        ),
        ({"goods": {"on_racks": {"period_s": 1.0, "direction": "down-aisle"}}}, "must be left out where"),
        ({"goods": {"on_racks": {"period": 1.0}}}, "did you mean goods.on_racks.period_s"),
        ({"goods": {"on_racks": {"period_s": 0.0}}}, "period_s of building must be a positive number; got 0"),
        ({"goods": {"stops": {"stiffness_kn_per_m": 1.0}}}, "clearance_m of building must be given"),
        (
            {"walls": {"alpha_h": 2.0, "base_shear_share": 0.5}},
            "must be left out where walls.base_shear_share is given",
        ),
        ({"walls": {"period_s": 0.3}}, "walls.period_s of building must be left out where building.period_s"),
        ({"walls": {"alpha_h": -1.0}}, "walls.alpha_h of building must be a positive number; got -1"),
        ({"walls": {"alpha": 2.0}}, "walls.alpha of building must be one of the keys"),
        (
            {"walls": {"alpha_h": 2.0}, "building": {"damping_from_storey": 2}},
            "damping_from_storey of building must be",
        ),
        ({"walls": {"base_shear_share": 1.5}}, "walls.base_shear_share of building must be above 0 and below 1"),
    ],
)
def test_wrong_files(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(file(**changes))


def test_an_assessment_with_racks() -> None:
    """The share, slip by level and masses are those of the runs with racks; the rule is named beside them."""
    given = file(goods={"on_racks": {"period_s": 1.5, "levels": 2}})
    building = sm.read_building(given)
    result = sm.assess(given, SUITE, mu_factors=(1.0, 1.0), resamples=20)
    effective = result.effective["real"]
    assert effective.value < 0.9
    advised = result.answer.analyses[0]
    assert effective.value <= advised.share_of_goods_present < effective.value + 0.05 + 1e-9
    masses = building.mass + building.frames + advised.share_of_goods_present * building.goods_mass
    np.testing.assert_allclose(advised.mass, masses, rtol=1e-14)
    assert result.slip["goods"].to_list() == ["level 1", "level 2"] * 2
    assert result.slips["level"].to_list()[:4] == [1, 2, 1, 2]
    advice = [line for line in result.advice if line.startswith("The rule by hand is not applied")]
    assert f"the runs with them give {effective.value:.2f}, at most what it says" in advice[0]
    assert any(line.startswith("Racks: goods on floor 1 evenly on 2 levels") for line in result.assumptions)
    assert "not applied: the rule by hand knows no racks" in result.text.replace("\n          ", " ")


def test_an_assessment_with_stiff_racks_may_ask_for_more_than_all() -> None:
    """The advised share is rounded up beyond 1, and its model drifts at least as the real building does."""
    result = sm.assess(file(goods={"on_racks": {"period_s": 0.3}}), SUITE, mu_factors=(1.0, 1.0), resamples=20)
    effective = result.effective["real"]
    if effective.kind == "beyond":
        assert result.answer.analyses[0].share_of_goods_present > 1.0
    one, real = (result.storeys.filter(model=name)["mean"].max() for name in ("advised", "real"))
    assert one >= real * (1.0 - 1e-9)
