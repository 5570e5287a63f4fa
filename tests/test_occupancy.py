"""Goods present by surveys, in the table and in a building file; kinds of goods on a floor; units without suffixes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.cli import main
from seismass.model.occupancy import OCCUPANCY_IDS

G = 9.80665


def given(**changes: Any) -> dict[str, Any]:
    """One storey of 500 m2 with 6 kPa of goods; tables changed as told, a key with the value None left out."""
    tables: dict[str, Any] = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {
            "stiffness_kn_per_m": 2.0e5,
            "height_m": 4.0,
            "area_m2": 500.0,
            "dead_load_kpa": 5.0,
            "yield_shear_kn": 900.0,
        },
        "goods": {"live_load_kpa": 6.0, "friction": "timber-on-steel"},
        "storeys": [{}],
    }
    for table, values in changes.items():
        if isinstance(values, dict):
            tables[table] = {k: v for k, v in {**tables.get(table, {}), **values}.items() if v is not None}
        else:
            tables[table] = values
    return tables


@pytest.mark.parametrize(
    ("occupancy", "mean", "floor", "point", "area", "design"),
    [
        # JCSS Probabilistic Model Code, part 2.2, table of live load parameters: m_q, sigma_V, sigma_U, A_0; ASCE 7:
        # 125, 250, 150, 100 and 50 psf, from memory.
        ("storage, sustained", 3.5, 2.5, 6.9, 100.0, 6.00),
        ("heavy storage, sustained", 3.5, 2.5, 6.9, 100.0, 11.97),
        ("light industry, sustained", 1.0, 1.0, 2.8, 100.0, 6.00),
        ("heavy industry, sustained", 3.0, 1.5, 4.1, 100.0, 11.97),
        ("library, sustained", 1.7, 0.5, 1.0, 20.0, 7.18),
        ("retail, sustained", 0.9, 0.6, 1.6, 100.0, 4.79),
        ("office, sustained", 0.5, 0.3, 0.6, 20.0, 2.40),
    ],
)
def test_surveys_as_the_model_code_has_them(
    occupancy: str, mean: float, floor: float, point: float, area: float, design: float
) -> None:
    row = sm.occupancy.surveyed_load(occupancy)
    assert (row.mean, row.floor_deviation, row.point_deviation, row.reference_area) == (mean, floor, point, area)
    assert row.design_load == design
    assert row.share == mean / design
    assert row.design_status == "from memory, unverified"
    # Equation of the same part: Var[q] = sigma_V^2 + sigma_U^2 A_0/A; A_0/A is 1 below A_0.
    assert row.deviation() == floor
    assert row.deviation(4.0 * area) ** 2 == pytest.approx(floor**2 + point**2 / 4.0, rel=1e-14)
    assert row.deviation(0.5 * area) ** 2 == pytest.approx(floor**2 + point**2, rel=1e-14)


def test_the_table_has_every_occupancy_and_others_are_refused() -> None:
    assert sm.occupancy.occupancy_table()["occupancy_id"].to_list() == list(OCCUPANCY_IDS)
    with pytest.raises(sm.errors.InvalidOption, match=r"did you mean office, sustained\?\); got 'offices'"):
        sm.occupancy.surveyed_load("offices")
    with pytest.raises(sm.errors.InvalidOption, match=r"area of surveyed load must be positive \(m2\); got 0"):
        sm.occupancy.surveyed_load("office, sustained").deviation(0.0)
    with pytest.raises(sm.errors.InvalidOption, match="fraction of code must be from 0 to 1; got 25"):
        sm.occupancy.on_surveyed_goods(25.0)
    with pytest.raises(
        sm.errors.InvalidOption, match="use of code must be one of storage, ordinary, archive, shop; got 'office'"
    ):
        sm.occupancy.on_surveyed_goods(0.25, "office")  # type: ignore[arg-type]
    # 25 % of ASCE 7 over 3.5/6.0, and over 0.5/2.4.
    assert sm.occupancy.on_surveyed_goods(0.25) == pytest.approx(0.25 * 6.0 / 3.5, rel=1e-14)
    assert sm.occupancy.on_surveyed_goods(0.3, "ordinary") == pytest.approx(0.3 * 2.4 / 0.5, rel=1e-14)


def test_the_tables_are_printed_and_stand_in_the_docs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["building", "--occupancies"]) == 0
    printed = capsys.readouterr().out
    page = (Path(__file__).parents[1] / "docs" / "codes.md").read_text(encoding="utf-8")
    for row in sm.occupancy.occupancy_table().iter_rows(named=True):
        assert row["occupancy_id"] in printed
        numbers = (f"{row['mean']:g}", f"{row['floor_deviation']:g}", f"{row['design_load']:g}", f"{row['share']:.2f}")
        assert f"| `{row['occupancy_id']}` | {' | '.join(numbers)} | {row['renewed']} |" in page
    assert main(["building", "--codes"]) == 0
    line = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("asce7-10  "))
    assert line.split()[1:4] == ["storage", "0.25", "0.43"]


def test_a_floor_is_occupied_as_surveys_say() -> None:
    """3.5 kPa whatever the design load; the share of the table where no area is known; never above the design load."""
    building = sm.read_building(given(goods={"occupancy": "storage, sustained"}))
    assert building.goods_mass[0] == pytest.approx(3.5e3 * 500.0 / G, rel=1e-14)
    assert building.kinds[0].presence == "of the design live load, the mean of storage, sustained (3.5 kPa)"
    loads = given(
        goods={"occupancy": "storage, sustained", "live_load_kpa": None, "live_load_kg": 1000.0},
        building={"area_m2": None, "dead_load_kpa": None, "mass_kg": 1000.0},
    )
    assert sm.read_building(loads).goods_mass[0] == pytest.approx(1000.0 * 3.5 / 6.0, rel=1e-14)
    small = sm.read_building(given(goods={"occupancy": "storage, sustained", "live_load_kpa": 2.0}))
    assert small.kinds[0].occupied == 1.0
    assert small.kinds[0].presence.endswith("which is more than all of it")


def test_a_storey_has_its_own_occupancy() -> None:
    storeys = [{}, {"occupancy": "library, sustained"}, {"occupied": 0.9}]
    building = sm.read_building(given(goods={"occupancy": "storage, sustained"}, storeys=storeys))
    np.testing.assert_allclose([kind.occupied for kind in building.kinds], [3.5 / 6.0, 1.7 / 6.0, 0.9], rtol=1e-14)


def test_floors_of_ordinary_use_are_not_full() -> None:
    """0.5 kPa over 2.4 kPa: offices by surveys; storage is full unless stated."""
    storeys: list[dict[str, Any]] = [{}, {"use": "ordinary"}, {"use": "ordinary", "occupied": 0.4}]
    building = sm.read_building(given(storeys=storeys))
    np.testing.assert_allclose([kind.occupied for kind in building.kinds], [1.0, 0.5 / 2.4, 0.4], rtol=1e-14)
    assert [kind.presence for kind in building.kinds] == [
        "of the design live load, since nothing is stated",
        "of the design live load, as office, sustained, since the use is ordinary and nothing is stated",
        "of the design live load, as stated",
    ]
    ordinary = sm.read_building(given(code={"use": "ordinary"}))
    assert ordinary.kinds[0].occupied == 0.5 / 2.4


def test_storage_of_little_weight_is_exempt_by_asce7_alone() -> None:
    """12.7.2, exception a: 0.25 q at most 5 % of 5 kPa, so q up to 1 kPa; in other codes it counts."""
    storeys = [{"live_load_kpa": 0.99}, {"live_load_kpa": 1.01}, {"live_load_kpa": 0.99, "exempt": False}]
    building = sm.read_building(given(storeys=storeys))
    assert [one.fraction for one in building.counted] == [0.0, 0.25, 0.25]
    assert building.counted[0].exception == "exempt: at most 5 % of the weight of the level"
    other = sm.read_building(given(storeys=storeys, code={"id": "nbc"}))
    assert [one.fraction for one in other.counted] == [0.6, 0.6, 0.6]


KINDS = [
    {"name": "machines", "share": 0.3, "attached": True},
    {"name": "pallets", "share": 0.4, "occupied": 0.5},
    {"name": "crates", "share": 0.3, "mu": 0.2},
]


def test_bolted_goods_are_mass_and_loose_ones_slide_each_by_its_friction() -> None:
    """3000 kN of design live load on a floor of 2500 kN: by hand."""
    building = sm.read_building(given(storeys=[{"goods": KINDS}]))
    load = 3.0e6 / G
    np.testing.assert_allclose(building.mass, 2.5e6 / G + 0.3 * load, rtol=1e-14)
    np.testing.assert_allclose(building.live_load, 0.7 * load, rtol=1e-14)
    np.testing.assert_allclose(building.goods_mass, (0.2 + 0.3) * load, rtol=1e-14)
    np.testing.assert_allclose(building.bolted, 0.3 * load, rtol=1e-14)
    scene = building.scene(mu_factor=1.5)
    np.testing.assert_allclose(scene.block_mass, [0.2 * load, 0.3 * load], rtol=1e-14)
    np.testing.assert_allclose([(block.mu_s, block.mu_k) for block in scene.blocks], [(0.6, 0.45), (0.3, 0.3)])
    # P is the weight of floor and all goods; the code's share is of the loose live load.
    np.testing.assert_allclose(scene.geometric_stiffness * 4.0, 2.5e6 + 0.8 * 3.0e6, rtol=1e-12)
    np.testing.assert_allclose(building.code_mass, 0.25 * 0.7 * load, rtol=1e-14)


@pytest.mark.parametrize(("period_mass", "present"), [("bare", 0.0), ("code share", 0.3 + 0.175), ("all", 0.8)])
def test_a_period_is_that_of_what_it_names(period_mass: str, present: float) -> None:
    """Shares of the design live load that act as mass in the period: bolted goods act in all but the bare one."""
    changes = {"stiffness_kn_per_m": None, "period_s": 0.6, "period_mass": period_mass}
    building = sm.read_building(given(building=changes, storeys=[{"goods": KINDS}]))
    mass = 2.5e6 / G + present * 3.0e6 / G
    assert 2.0 * np.pi * np.sqrt(mass / building.stiffness[0]) == pytest.approx(0.6, rel=1e-12)


def test_equal_kinds_are_one_kind(tmp_path: Path) -> None:
    """Two halves that slide alike are the whole: equal drifts, and slips of each kind equal to those of the floor."""
    halves = [{"name": name, "share": 0.5} for name in ("left", "right")]
    suite = sm.builtin_suite("seven")
    whole, split = (
        sm.assess(given(storeys=storeys), suite, mu_factors=(1, 1), resamples=2)
        for storeys in ([{}], [{"goods": halves}])
    )
    np.testing.assert_allclose(whole.storeys["mean"].to_numpy(), split.storeys["mean"].to_numpy(), rtol=1e-8)
    assert split.slip["goods"].to_list() == ["left", "right"]
    for row in split.slip.iter_rows(named=True):
        assert row["peak_max"] == pytest.approx(whole.slip["peak_max"][0], rel=1e-6)
    assert "1 left" in split.text
    split.write(tmp_path, figures=True)
    assert "Goods, kind by kind" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_bolted_goods_are_in_both_analyses() -> None:
    bolted = [{"name": "machines", "share": 0.4, "attached": True}, {"share": 0.6}]
    result = sm.assess(given(storeys=[{"goods": bolted}]), sm.builtin_suite("seven"), mu_factors=(1, 1), resamples=2)
    load, floor = 3.0e6 / G, 2.5e6 / G
    one, two = result.answer.analyses
    np.testing.assert_allclose(two.mass, floor + 0.4 * load, rtol=1e-14)
    np.testing.assert_allclose(one.mass, floor + (0.4 + 0.6 * one.share_of_goods_present) * load, rtol=1e-14)
    # Multipliers of the whole design live load of the floor give those masses.
    np.testing.assert_allclose(floor + np.array(one.multipliers) * load, one.mass, rtol=1e-14)
    np.testing.assert_allclose(two.multipliers, 0.4, rtol=1e-14)
    assert two.mass_source == "dead + 0.40 live"
    assert any(line.startswith("Bolted: machines on floor 1, 1200 kN.") for line in result.assumptions)


@pytest.mark.parametrize("units", ["si", "us"])
def test_a_line_of_units_stands_for_suffixes(units: str) -> None:
    """NIST SP 811: 1 ft is 0.3048 m, 1 psf 47.88026 Pa, 1 kip 4448.222 N, 1 kip/in 175126.8 N/m."""
    foot, psf, kip, stiffness = (0.3048, 0.04788026, 4.448222, 175.1268) if units == "us" else (1.0, 1.0, 1.0, 1.0)
    building = {
        "height": 4.0 / foot,
        "area": 500.0 / foot**2,
        "dead_load": 5.0 / psf,
        "gravity_load": 3000.0 / kip,
        "stiffness": 2.0e5 / stiffness,
        "yield_shear": 900.0 / kip,
    }
    plain = {"units": units, "building": building, "goods": {"live_load": 6.0 / psf, "mu": 0.3}}
    stated = given(building={"gravity_load_kn": 3000.0}, goods={"friction": None, "mu": 0.3})
    one, two = sm.read_building(stated), sm.read_building({**stated, **plain})
    for name in ("mass", "stiffness", "yield_shear", "heights", "gravity_load", "live_load", "area"):
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), rtol=1e-6, err_msg=name)
    weighed = {"mass": 2.5e6 / G} if units == "si" else {"weight": 2.5e3 / kip}
    other = {**plain, "building": {**building, "dead_load": None, **weighed}}
    np.testing.assert_allclose(sm.read_building({**stated, **other}).mass, one.mass, rtol=1e-6)


WRONG: list[tuple[dict[str, Any], str]] = [
    (
        {"goods": {"occupancy": "storage"}},
        r"goods.occupancy of building must be one of .*mean .*storage, sust.*'storage'",
    ),
    (
        {"goods": {"occupied": 0.5, "occupancy": "storage, sustained"}},
        "goods.occupied of building must be left out where",
    ),
    ({"units": "metric"}, "units of building must be one of si, us; got 'metric'"),
    ({"units": "us", "building": {"height": 13.0, "height_ft": 13.0}}, "building.height of building must be left out"),
    ({"units": "us", "building": {"height": 13.0}}, "building.height_ft of building must be left out where"),
    ({"units": "us", "building": {"mass": 13.0}}, "building.mass of building must be one of the keys"),
    ({"building": {"height": 13.0}}, r"building.height of building must be one of .*did you mean building.height_m"),
    ({"storeys": [{"goods": [{"share": 0.5}]}]}, r"storeys\[1\].goods of building must be kinds .*; got a sum of 0.5"),
    ({"storeys": [{"goods": [{}]}]}, r"storeys\[1\].goods of building must be kinds .*; got a kind without one"),
    (
        {"storeys": [{"goods": [{"share": 1.0, "attached": True, "mu": 0.2}]}]},
        r"storeys\[1\].goods\[1\].mu of building must be left out where storeys\[1\].goods\[1\].attached is true",
    ),
    ({"storeys": [{"goods": [{"part": 1.0}]}]}, r"storeys\[1\].goods\[1\].part of building must be one of the keys"),
    ({"storeys": [{"goods": 4}]}, r"storeys\[1\].goods of building must be a list of tables; got 4"),
    ({"storeys": [{"exempt": True, "use": "ordinary"}]}, r"storeys\[1\].use of building must be left out where"),
]


@pytest.mark.parametrize(("changes", "message"), WRONG, ids=range(len(WRONG)))
def test_wrong_occupancies_kinds_and_units_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(given(**changes))


def test_weights_typed_as_masses_are_a_doubt() -> None:
    """2500 kN as 2.5e6 kg is 49 kPa on 500 m2; 2500 as kg is 0.05 kPa."""
    for mass in (2.5e6, 2500.0):
        changes = given(building={"dead_load_kpa": None, "mass_kg": mass, "yield_shear_kn": 1e-3 * mass})
        doubts = sm.assess(changes, sm.builtin_suite("seven"), mu_factors=(1, 1), resamples=2).answer.doubts
        assert any("weight over the area of floor 1" in doubt for doubt in doubts), mass


def test_the_answer_says_what_to_type_and_what_is_taken_as_there() -> None:
    """One storey with 3000 kN of design live load, nothing stated: all of it, and a row with what surveys find."""
    result = sm.assess(given(), sm.builtin_suite("seven"), mu_factors=(1, 1), resamples=2)
    assert result.answer.goods[0] == "1.00 of the design live load, since nothing is stated"
    one, two = result.answer.analyses
    assert one.mass_source == f"dead + {one.multipliers[0]:.2f} live"
    assert two.mass_source == "dead load alone"
    taken, surveyed = result.answer.goods[1:]
    assert taken.startswith("full floors, 1.00 of the design live load: lambda = ")
    assert surveyed.startswith("floors as expected, 0.58 of the design live load: lambda = ")
    assert any("floors of storage are taken as full, since nothing is stated" in remark for remark in result.remarks)
    stated = sm.assess(given(goods={"occupied": 1.0}), sm.builtin_suite("seven"), mu_factors=(1, 1), resamples=2)
    assert [words[:11] for words in stated.answer.goods[1:]] == ["full floors"]
    assert not any("nothing is stated" in remark for remark in stated.remarks)
    mixed = given(storeys=[{}, {"occupied": 0.5}, {"live_load_kpa": 0.0}])
    other = sm.assess(mixed, sm.builtin_suite("seven"), mu_factors=(1, 1), resamples=2)
    assert other.answer.analyses[0].mass_source == "by floor, below"
