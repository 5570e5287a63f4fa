"""Building files: units, defaults, designs, and what is refused with which words."""

from __future__ import annotations

import copy
import datetime
import json
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.assessment.building import DEFAULT_THETA_LIMIT, DesignRule
from seismass.assessment.building_file import example_file
from seismass.assessment.file_keys import KEYS, NEEDS, ROWS
from seismass.base.files import stored_rows
from seismass.base.statistics import DRIFT_CAP
from seismass.model.building import DEFAULT_DAMPING
from seismass.model.rack import DEFAULT_RACK_DAMPING
from seismass.model.springs import SHAPE_FIELDS
from seismass.motions.spectra import DEFAULT_TL

G = 9.80665


def given(**changes: dict[str, Any]) -> dict[str, Any]:
    """Two storeys with goods on the first; tables changed as told, a key with the value None left out."""
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
        "storeys": [{}, {"live_load_kpa": 0.0}],
    }
    for table, values in changes.items():
        if isinstance(values, dict):
            tables[table] = {k: v for k, v in {**tables.get(table, {}), **values}.items() if v is not None}
        else:
            tables[table] = values
    return tables


def test_units_are_those_of_the_keys() -> None:
    """5 kPa on 500 m2 are 2500 kN, by hand; kN/m and kN are thousands of N/m and N."""
    building = sm.read_building(given(goods={"occupied": 0.7}))
    np.testing.assert_allclose(building.mass, [2.5e6 / G, 2.5e6 / G], rtol=1e-15)
    np.testing.assert_allclose(building.live_load, [3.0e6 / G, 0.0], rtol=1e-15)
    np.testing.assert_allclose(building.goods_mass, [2.1e6 / G, 0.0], rtol=1e-15)
    np.testing.assert_array_equal(building.stiffness, [2.0e8, 2.0e8])
    assert building.yield_shear is not None
    np.testing.assert_array_equal(building.yield_shear, [9.0e5, 9.0e5])
    assert building.gravity_load is not None
    np.testing.assert_allclose(building.gravity_load, [2.5e6, 2.5e6], rtol=1e-15)
    # The contact of the table; none on the bare roof.
    assert [(kind.mu_s, kind.mu_k) for kind in building.kinds] == [(0.4, 0.3), (0.0, 0.0)]
    scene = building.scene()
    # P of storey 1: both floors and the goods present; of storey 2: the roof.
    np.testing.assert_allclose(scene.geometric_stiffness * 4.0, [5.0e6 + 2.1e6, 2.5e6], rtol=1e-12)


def test_unequal_storeys_and_goods(unequal_file: dict[str, Any]) -> None:
    """Each storey and kind has its own numbers: kPa over m2 are kN, of which g m/s2 is a t."""
    building = sm.read_building(unequal_file)
    loads = np.array([6.1 * 530.0, 4.3 * 470.0, 1.9 * 410.0])
    present = np.array([0.59 * 0.88 + 0.41 * 0.55, 0.71, 0.43])
    for name, expected in {
        "mass": 1e3 * np.array([5.3 * 530.0, 4.7 * 470.0, 3.7 * 410.0]) / G,
        "live_load": 1e3 * loads / G,
        "goods_mass": 1e3 * present * loads / G,
        "code_mass": 0.25 * 1e3 * loads / G,
        "gravity_load": [3.07e6, 2.39e6, 1.64e6],
        "stiffness": [1.93e8, 1.57e8, 1.13e8],
        "yield_shear": [1.87e6, 1.51e6, 0.83e6],
        "overstrength": [1.87, 2.11, 1.61],
        "second_slope": [0.067, 0.053, 0.043],
        "third_slope": [0.013, 0.0103, 0.0083],
        "heights": [4.3, 3.7, 3.1],
        "area": [530.0, 470.0, 410.0],
    }.items():
        np.testing.assert_allclose(getattr(building, name), expected, rtol=1e-14, err_msg=name)
    assert building.storey_names == ("hall", "loft", "roof")
    assert building.present_share == pytest.approx((present @ loads) / loads.sum(), rel=1e-14)
    assert (building.code_share, building.damping, building.mu_factors) == (0.25, 0.037, (0.71, 1.37))
    assert (building.drift_limit, building.theta_limit) == (0.017, 0.23)
    scene = building.scene(mu_factor=1.37)
    kinds = [(0.298, 0.214), (0.253, 0.154), (0.349, 0.184), (0.291, 0.24)]
    assert [(block.floor, block.mu_s, block.mu_k) for block in scene.blocks] == [
        (floor, 1.37 * mu_s, 1.37 * mu_k) for floor, (mu_s, mu_k) in zip([1, 1, 2, 3], kinds, strict=True)
    ]
    shares = np.array([0.59 * 0.88, 0.41 * 0.55, 0.71, 0.43])
    np.testing.assert_allclose(scene.block_mass, 1e3 * shares * loads[[0, 0, 1, 2]] / G, rtol=1e-14)
    # P of a storey: the gravity loads and the goods present above it.
    own = np.array([3.07e6, 2.39e6, 1.64e6]) + 1e3 * present * loads
    load = np.array([own.sum(), own[1:].sum(), own[2]])
    np.testing.assert_allclose(scene.geometric_stiffness, load / [4.3, 3.7, 3.1], rtol=1e-13)
    # A design counts its fraction of the design live load, not of what is present.
    for storey in unequal_file["storeys"]:
        del storey["yield_shear_kn"]
    unequal_file["building"] |= {"design": True, "R": 3.7, "design_fraction": 0.37}
    designed = sm.read_building(unequal_file)
    np.testing.assert_allclose(designed.design_mass, 0.37 * 1e3 * loads / G, rtol=1e-14)
    assert designed.design_fraction == 0.37
    analysis = sm.design.response_spectrum_analysis(
        building.mass + 0.37 * 1e3 * loads / G,
        building.stiffness,
        sm.TargetSpectrum.asce7(1.13, 0.71, 6.7),
        damping=0.037,
    )
    np.testing.assert_allclose(designed.structure().yield_shear, analysis.storey_shear / 3.7, rtol=1e-12)


def test_the_same_building_in_other_units_is_the_same_scene() -> None:
    weight = 2 * 2.5e6
    other = given(
        building={
            "stiffness_kn_per_m": None,
            "stiffness_n_per_m": 2.0e8,
            "dead_load_kpa": None,
            "mass_kg": 2.5e6 / G,
            "yield_shear_kn": None,
            "yield_shear_over_weight": 9.0e5 / weight,
        },
        goods={"live_load_kpa": None, "live_load_kg": 3.0e6 / G, "friction": None, "mu_s": 0.4, "mu_k": 0.3},
    )
    one, two = sm.read_building(given()).scene(), sm.read_building(other).scene()
    assert one.building is not None
    assert two.building is not None
    for name in ("mass", "stiffness", "yield_shear", "heights", "gravity_load"):
        np.testing.assert_allclose(getattr(one.building, name), getattr(two.building, name), rtol=1e-14)
    np.testing.assert_allclose(one.block_mass, two.block_mass, rtol=1e-14)


def test_a_storey_replaces_the_default_in_any_of_its_units() -> None:
    building = sm.read_building(
        given(storeys=[{"mass_kg": 1000.0, "yield_shear_n": 5.0}, {"live_load_kg": 7.0, "mu": 0.9, "occupied": 0.5}])
    )
    assert building.mass[0] == 1000.0
    assert building.yield_shear is not None
    assert building.yield_shear.tolist() == [5.0, 9.0e5]
    assert building.goods_mass[1] == 3.5
    assert [(kind.contact, kind.mu_s) for kind in building.kinds] == [("timber-on-steel", 0.4), ("", 0.9)]


def test_a_period_scales_relative_stiffnesses() -> None:
    building = sm.read_building(
        given(
            building={"stiffness_kn_per_m": None, "period_s": 0.5}, storeys=[{"relative_stiffness": 2.0}, {"mu": 0.3}]
        )
    )
    assert building.stiffness[0] == pytest.approx(2.0 * building.stiffness[1], rel=1e-14)
    # The kernel finds the periods of the building in its own way.
    assert building.structure().periods[0] == pytest.approx(0.5, rel=1e-12)


def test_a_design_divides_the_elastic_shears_by_r() -> None:
    """One storey: V_e = m A, with m the floor and the code's share, and A of the plateau, S_DS g."""
    tables = given(
        building={"yield_shear_kn": None, "design": True, "R": 4.0, "stiffness_kn_per_m": None, "period_s": 0.3},
        storeys=[{}],
    )
    building = sm.read_building(tables)
    assert building.design == DesignRule(4.0, None, "srss")
    assert building.design_fraction == 0.25
    mass = 2.5e6 / G + 0.25 * 3.0e6 / G
    # 0.3 s times the root of 1.3 lies between 0.2 S_D1/S_DS = 0.12 s and 0.6 s.
    assert building.structure().yield_shear[0] == pytest.approx(mass * G / 4.0, rel=1e-12)
    tables["building"]["design_fraction"] = 0.0
    assert sm.read_building(tables).structure().yield_shear[0] == pytest.approx(2.5e6 / 4.0, rel=1e-12)
    tables["building"] |= {"design_fraction": 1.0}
    tables["code"] = {"id": "nbc"}
    assert sm.read_building(tables).structure().yield_shear[0] == pytest.approx(5.5e6 / 4.0, rel=1e-12)


def test_without_heights_there_is_no_p_delta_and_no_limit() -> None:
    building = sm.read_building(given(building={"height_m": None}))
    assert building.heights is None
    assert building.gravity_load is None
    assert not building.scene().geometric_stiffness.any()
    assert sm.read_building(given(building={"p_delta": False})).gravity_load is None
    stated = sm.read_building(given(building={"gravity_load_kn": 4000.0})).gravity_load
    assert stated is not None
    np.testing.assert_allclose(stated, 4.0e6, rtol=1e-15)


def test_floors_without_goods_need_no_friction() -> None:
    building = sm.read_building(given(goods={"friction": None}, storeys=[{"live_load_kpa": 0}, {"occupied": 0.0}]))
    assert not building.goods_mass.any()
    assert building.scene().blocks == ()
    assert building.present_share == 0.0


def test_the_example_is_read_and_names_every_key() -> None:
    """A user who starts from it finds each key, in a line or in a comment."""
    text = example_file().read_text(encoding="utf-8")
    building = sm.read_building(example_file())
    assert building.storeys == 4
    assert building.period() == pytest.approx(0.57, rel=1e-12)
    assert building.goods_mass[3] == 0.0
    for table in KEYS.values():
        for key in table:
            assert re.search(rf"\b{key}\b", text), key


def test_the_head_of_the_page_is_as_the_file_says() -> None:
    project = {"name": "harbour", "number": "2026-114", "author": "A", "checker": "B", "date": "2026-11-25"}
    found = sm.read_building(given(project=project)).project
    assert (found.name, found.number, found.author, found.checker, found.date) == tuple(project.values())
    # A date of TOML is one, too.
    assert sm.read_building(given(project={"date": datetime.date(2026, 11, 25)})).project.date == "2026-11-25"
    nothing = sm.read_building(given()).project
    assert {nothing.name, nothing.number, nothing.author, nothing.checker, nothing.date} == {""}


@pytest.mark.parametrize(
    ("project", "message"),
    [
        ({"customer": "x"}, r"project.customer of building must be one of the keys name, number"),
        ({"number": 114}, r"project.number of building must be text; got 114"),
        ({"date": "25.11.2026"}, r"project.date of building must be a date, such as 2026-11-25; got '25.11.2026'"),
        ({"date": 2026}, r"project.date of building must be a date, such as 2026-11-25; got 2026"),
    ],
)
def test_a_wrong_head_is_refused(project: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(given(project=project))


def test_every_quantity_names_the_key_that_states_it() -> None:
    sources = dict(sm.read_building(given(storeys=[{"height_ft": 14.0}, {"live_load_kpa": 0.0}])).sources)
    assert sources["height"] == "building.height_m; storeys[1].height_ft"
    goods = [{"name": "tall", "share": 1.0, "width_m": 0.7, "height_m": 2.0}]
    tall = dict(sm.read_building(given(storeys=[{"goods": goods}, {"live_load_kpa": 0.0}])).sources)
    assert tall["height"] == "building.height_m"
    assert sources["dead_load"] == "building.dead_load_kpa"
    assert sources["live_load"] == "goods.live_load_kpa; storeys[2].live_load_kpa"
    assert sources["friction"] == "goods.friction"
    assert sources["damping"] == "default"
    assert sources["site"] == "site.sds_g, site.sd1_g"
    kinds = [{"share": 0.5, "mu": 0.2}, {"share": 0.5}]
    mixed = dict(sm.read_building(given(storeys=[{"goods": kinds}, {"live_load_kpa": 0.0}])).sources)
    assert mixed["friction"] == "goods.friction; storeys[1].goods.mu"


def test_json_and_toml_are_the_same_file(tmp_path: Path) -> None:
    tables = tomllib.loads(example_file().read_text(encoding="utf-8"))
    (tmp_path / "warehouse.json").write_text(json.dumps(tables), encoding="utf-8")
    one, two = sm.read_building(example_file()), sm.read_building(tmp_path / "warehouse.json")
    assert one.scene() == two.scene()


def test_the_spectrum_of_a_file_is_beside_it(tmp_path: Path) -> None:
    tables = given()
    tables["site"] = {"spectrum_csv": "site.csv"}
    (tmp_path / "site.csv").write_text("period,Sa (g)\n0.05,0.5\n5,0.5\n")
    (tmp_path / "b.json").write_text(json.dumps(tables))
    target = sm.read_building(tmp_path / "b.json").site_spectrum()
    assert target([1.0])[0] == pytest.approx(0.5 * G, rel=1e-12)


def test_tables_given_are_not_changed() -> None:
    tables = given()
    before = copy.deepcopy(tables)
    sm.read_building(tables)
    assert tables == before


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"building": {"stiffness": 2e5}}, r"building.stiffness of building must be one of the keys .* \(did you mean "),
    ({"building": {"yield_shear": 9e5}}, r"\(did you mean building.yield_shear_"),
    ({"building": {"height": 4}}, r"\(did you mean building.height_m\?\); got an unknown key"),
    ({"building": {"area": 4}}, r"\(did you mean building.area_m2\?\)"),
    ({"building": {"dead_load": 4}}, r"\(did you mean building.dead_load_kpa\?\)"),
    ({"building": {"live_load_kpa": 4}}, "building.live_load_kpa of building must be one of the keys"),
    ({"goods": {"live_load": 4}}, r"\(did you mean goods.live_load_k"),
    ({"site": {"sds": 1.0}}, r"\(did you mean site.sds_g\?\)"),
    ({"Building": {}}, r"\(did you mean building\?\)"),
    ({"storeys": []}, "storeys of building must be a table per storey, storey 1 first; got none"),
    ({"storeys": 4}, "storeys of building must be a list of tables; got 4"),
    ({"storeys": [{"periods": 1}, {}]}, r"storeys\[1\].periods of building must be one of the keys"),
    ({"building": {"dead_load_kpa": -5}}, "building.dead_load_kpa of building must be a positive number; got -5"),
    ({"building": {"dead_load_kpa": "5"}}, "building.dead_load_kpa of building must be a number; got '5'"),
    ({"building": {"dead_load_kpa": None}}, r"storeys\[1\].dead_load_kpa of building must be given, or mass_kg, here"),
    ({"building": {"area_m2": None}}, r"storeys\[1\].area_m2 of building must be given, or building.area_m2 for all"),
    ({"building": {"mass_kg": 5}}, "building.dead_load_kpa of building must be left out where building.mass_kg is"),
    ({"building": {"height_m": 0}}, "building.height_m of building must be a positive number; got 0"),
    (
        {"building": {"height_m": None}, "storeys": [{"height_m": 4}, {}]},
        r"storeys\[2\].height_m of building must be given",
    ),
    ({"building": {"height_m": None, "p_delta": True}}, "height_m of building must be given where building.p_delta is"),
    ({"building": {"p_delta": "yes"}}, "building.p_delta of building must be true or false; got 'yes'"),
    ({"building": {"period_s": 0.5}}, "stiffness_kn_per_m of building must be left out where building.period_s is"),
    (
        {"building": {"stiffness_kn_per_m": None}},
        "stiffness_n_per_m, or building.period_s or building.system for the",
    ),
    (
        {"building": {"relative_stiffness": 2}},
        "relative_stiffness of building must be left out where building.period_s",
    ),
    ({"building": {"yield_shear_kn": None}}, "given, or yield_shear_n, or yield_shear_over_weight, or building.design"),
    ({"building": {"yield_shear_kn": -9}}, r"building.yield_shear_kn of building must be positive \(inf"),
    ({"building": {"design": True}}, "building.yield_shear_kn of building must be left out where building.design is"),
    ({"building": {"design": True, "yield_shear_kn": None}}, "building.R of building must be given; got nothing"),
    (
        {"building": {"design": True, "yield_shear_kn": None, "R": 0.5}},
        "building.R of building must be finite and at least 1; got 0.5",
    ),
    ({"building": {"R": 4}}, "building.R of building must be left out where building.design is not true; got given"),
    (
        {"building": {"design": True, "yield_shear_kn": None, "R": 4, "combination": "abs"}},
        "building.combination of building must be one of srss, cqc; got 'abs'",
    ),
    ({"building": {"damping": 5}}, "building.damping of building must be from 0 to 1; got 5"),
    ({"building": {"overstrength": 0.5}}, "overstrength of building must be finite and at least 1; got 0.5"),
    ({"building": {"drift_limit": -1}}, "building.drift_limit of building must be a positive number; got -1"),
    (
        {"goods": {"friction": "wood-on-steel"}},
        r"goods.friction of building must be one of .*did you mean timber-on-st",
    ),
    (
        {"goods": {"friction": None}},
        r"storeys\[1\].friction of building must be given, or mu, or mu_s, here or in goods",
    ),
    ({"goods": {"mu": 0.3}}, "goods.friction of building must be left out where goods.mu is given; got both"),
    ({"goods": {"friction": None, "mu": -0.3}}, "goods.mu of building must be finite and not negative; got -0.3"),
    (
        {"goods": {"friction": None, "mu_s": 0.3, "mu_k": 0.4}},
        "goods.mu_k of building must be from 0 to goods.mu_s = 0.3; got 0.4",
    ),
    ({"goods": {"mu_k": 0.4}}, "goods.mu_k of building must be left out where goods.friction is given; got both"),
    ({"goods": {"occupied": 70}}, "goods.occupied of building must be from 0 to 1; got 70"),
    ({"goods": {"live_load_kpa": -1}}, "goods.live_load_kpa of building must be finite and not negative; got -1"),
    ({"goods": {"live_load_kg": 1}}, "goods.live_load_kpa of building must be left out where goods.live_load_kg is"),
    (
        {"goods": {"mu_factors": [1.5, 0.67]}},
        r"goods.mu_factors of building must be two factors, .*; got \[1.5, 0.67\]",
    ),
    ({"site": {"sd1_g": None}}, "site.sd1_g of building must be given, or site.spectrum_csv or site.target for the"),
    ({"site": {"sds_g": -1}}, "site.sds_g of building must be a positive number; got -1"),
    ({"site": {"tl_s": 0.1}}, "site.tl_s of building must be at least T_S = S_D1/S_DS = 0.6 s; got 0.1"),
    ({"site": {"spectrum_csv": "a.csv"}}, "site.sds_g of building must be left out where site.spectrum_csv is given"),
    ({"code": {"id": "asce"}}, "code.id of building must be one of asce7-10, .*; got 'asce'"),
    ({"code": {"id": "aashto", "use": "ordinary"}}, "code.use of building must be storage; got 'ordinary'"),
    ({"code": {"fraction": 25}}, "code.fraction of building must be from 0 to 1; got 25"),
    ({"code": {"fraction": 0.3, "id": "ec8"}}, "code.id of building must be left out where code.fraction is given"),
    ({"building": {"collapse_drift_ratio": 0}}, "collapse_drift_ratio of building must be a positive number; got 0"),
]


@pytest.mark.parametrize(("changes", "message"), WRONG, ids=range(len(WRONG)))
def test_wrong_files_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(given(**changes))


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(
        sm.errors.InvalidBuildingFile, match=r"building file must be a file that can be read; got .*none.toml"
    ):
        sm.read_building(tmp_path / "none.toml")
    with pytest.raises(
        sm.errors.InvalidBuildingFile, match=r"suffix of building file a.txt must be .toml or .json; got '.txt'"
    ):
        sm.read_building(tmp_path / "a.txt")
    (tmp_path / "a.toml").write_text("[building\n")
    with pytest.raises(sm.errors.InvalidBuildingFile, match=r"content of a.toml must be valid TOML; got"):
        sm.read_building(tmp_path / "a.toml")


def test_a_design_without_a_site_asks_for_one() -> None:
    tables = given(building={"yield_shear_kn": None, "design": True, "R": 4.0})
    del tables["site"]
    with pytest.raises(
        sm.errors.InvalidOption, match=r"target of building building must be given: \[site\] in the file"
    ):
        sm.read_building(tables).scene()


PAGE = (Path(__file__).parents[1] / "docs" / "building_file.md").read_text(encoding="utf-8")


def test_the_page_names_every_key() -> None:
    for table, keys in KEYS.items():
        for key in keys:
            assert re.search(rf"`(?:{table}\.)?{key}`", PAGE), (table, key)


def test_the_file_of_the_page_is_read(tmp_path: Path) -> None:
    (text,) = re.findall(r"^```toml\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    (tmp_path / "warehouse.toml").write_text(text)
    building = sm.read_building(tmp_path / "warehouse.toml")
    assert building.storeys == 2
    assert building.goods_mass[0] == pytest.approx(0.8 * 7.2 * 1200.0 * 1e3 / G, rel=1e-14)


def test_us_units_are_the_same_building() -> None:
    """NIST SP 811: 1 ft is 0.3048 m, 1 psf 47.88026 Pa, 1 kip 4448.222 N, 1 kip/in 175126.8 N/m."""
    us = given(
        building={
            "stiffness_kn_per_m": None,
            "stiffness_kip_per_in": 2.0e8 / 175126.8,
            "height_m": None,
            "height_ft": 4.0 / 0.3048,
            "area_m2": None,
            "area_ft2": 500.0 / 0.3048**2,
            "dead_load_kpa": None,
            "dead_load_psf": 5000.0 / 47.88026,
            "yield_shear_kn": None,
            "yield_shear_kip": 9.0e5 / 4448.222,
        },
        goods={"live_load_kpa": None, "live_load_psf": 6000.0 / 47.88026},
        storeys=[{}, {"live_load_psf": 0.0}],
    )
    one, two = sm.read_building(given()), sm.read_building(us)
    for name in ("mass", "stiffness", "yield_shear", "heights", "gravity_load", "live_load", "area"):
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), rtol=1e-6, err_msg=name)
    weights = given(building={"dead_load_kpa": None, "weight_kip": 2.5e6 / 4448.222, "gravity_load_kip": 10.0})
    np.testing.assert_allclose(sm.read_building(weights).mass, one.mass, rtol=1e-6)
    gravity = sm.read_building(weights).gravity_load
    assert gravity is not None
    np.testing.assert_allclose(gravity, 44482.22, rtol=1e-6)
    loads = given(goods={"live_load_kpa": None, "live_load_kip": 3.0e6 / 4448.222})
    np.testing.assert_allclose(sm.read_building(loads).live_load[0], one.live_load[0], rtol=1e-6)
    # A storey's own value in one unit stands for the default in another.
    mixed = sm.read_building(given(storeys=[{"height_ft": 10.0, "live_load_psf": 50.0}, {}]))
    assert mixed.heights is not None
    assert mixed.heights[0] == pytest.approx(3.048, rel=1e-12)
    assert mixed.live_load[0] * G / 500.0 == pytest.approx(50.0 * 47.88026, rel=1e-6)


@pytest.mark.parametrize("period_mass", ["bare", "code share", "all"])
def test_the_mass_of_a_period_is_what_the_file_says(period_mass: str) -> None:
    """The kernel's periods of the building with that mass attached."""
    building = sm.read_building(
        given(building={"stiffness_kn_per_m": None, "period_s": 0.6, "period_mass": period_mass})
    )
    attached = {"bare": 0.0, "code share": 0.25, "all": 1.0}[period_mass] * np.array([3.0e6 / G, 0.0])
    bare = building.structure()
    with_goods = sm.Building(bare.mass + attached, bare.stiffness, yield_shear=np.inf)
    assert with_goods.periods[0] == pytest.approx(0.6, rel=1e-12)


def test_each_floor_has_its_use_its_fraction_or_none() -> None:
    """GB 50011: storage 0.8, ordinary 0.5; a floor of its own fraction, and one that is exempt."""
    storeys = [{}, {"use": "ordinary"}, {"fraction": 0.3}, {"exempt": True}]
    building = sm.read_building(given(storeys=storeys, code={"id": "gb50011"}))
    load = 3.0e6 / G
    np.testing.assert_allclose(building.code_mass, [0.8 * load, 0.5 * load, 0.3 * load, 0.0], rtol=1e-15)
    assert building.code_share == pytest.approx((0.8 + 0.5 + 0.3) / 4.0, rel=1e-15)
    tables = given(storeys=storeys, building={"yield_shear_kn": None, "design": True, "R": 4.0})
    designed = sm.read_building(tables)
    expected = designed.mass + designed.code_mass
    np.testing.assert_allclose(
        designed.analysis().storey_shear, designed.analysis(None, designed.code_mass).storey_shear
    )
    assert expected[3] == designed.mass[3]
    assert sm.read_building(given(code={"fraction": 0.4})).code_share == 0.4


def test_damping_above_a_storey_leaves_those_below_without() -> None:
    """Sum of forces on a rigid motion of all that is above is zero, and the modes above have the ratio."""
    building = sm.read_building(given(building={"damping_from_storey": 2}, storeys=[{}, {}, {"live_load_kpa": 0.0}]))
    structure = building.structure()
    matrix = structure.damping_matrix
    np.testing.assert_allclose(matrix @ np.ones(3), 0.0, atol=1e-6 * np.abs(matrix).max())
    above = sm.Building(structure.mass[1:], structure.stiffness[1:], yield_shear=np.inf, damping=0.05)
    np.testing.assert_allclose(matrix[1:, 1:], above.damping_matrix, rtol=1e-12)


MORE_WRONG: list[tuple[dict[str, Any], str]] = [
    ({"building": {"height_ft": 13.0}}, "building.height_ft of building must be left out where building.height_m is"),
    (
        {"building": {"height_m": None, "height_ft": -1.0}},
        "building.height_ft of building must be a positive number; got",
    ),
    (
        {"goods": {"height_ft": 13.0}},
        "goods.width_m of building must be given: width_m and height_m are the size of one of the goods",
    ),
    (
        {"building": {"period_mass": "all"}},
        "period_s of building must be given, or building.system; got nothing",
    ),
    (
        {"building": {"stiffness_kn_per_m": None, "period_s": 0.5, "period_mass": "half"}},
        "building.period_mass of building must be one of bare, code share, all; got 'half'",
    ),
    (
        {"storeys": [{"use": "ordinary", "fraction": 0.1}, {}]},
        r"storeys\[1\].use of building must be left out where storeys\[1\].fraction is given",
    ),
    (
        {"storeys": [{"use": "office"}, {}]},
        r"storeys\[1\].use of building must be one of storage, archive, .*; got 'offi",
    ),
    (
        {"storeys": [{"use": "ordinary"}, {}], "code": {"fraction": 0.1}},
        r"storeys\[1\].use of building must be left out where code.fraction is given",
    ),
    (
        {"building": {"damping_from_storey": 3}},
        "building.damping_from_storey of building must be a whole number from 1 to 2; got 3",
    ),
]


@pytest.mark.parametrize(("changes", "message"), MORE_WRONG, ids=range(len(MORE_WRONG)))
def test_wrong_units_masses_uses_and_damping_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(given(**changes))


def test_the_page_and_the_example_name_the_keys_in_us_units() -> None:
    text = example_file().read_text(encoding="utf-8")
    in_us = {row.us for row in ROWS if row.us}
    assert len(in_us) == 10
    for key in in_us:
        assert f"`{key}`" in PAGE, key
        assert re.search(rf"\b{key}\b", text), key


def test_defaults_of_the_table_of_keys_are_those_of_the_package() -> None:
    """A file that leaves a number out is read as the rest of the package has it."""
    defaults = {(table, key): row.number for table, rows in KEYS.items() for key, row in rows.items()}
    assert defaults["site", "tl_s"] == DEFAULT_TL
    assert defaults["building", "damping"] == DEFAULT_DAMPING
    assert defaults["building", "theta_limit"] == DEFAULT_THETA_LIMIT
    assert defaults["building", "drift_cap"] == DRIFT_CAP
    assert defaults["on_racks", "damping"] == DEFAULT_RACK_DAMPING
    shapes = {name: defaults["storeys", name] for name in SHAPE_FIELDS if name in KEYS["storeys"]}
    assert shapes == {name: SHAPE_FIELDS[name].default for name in shapes}
    assert shapes.keys() == {"overstrength", "second_slope", "third_slope"}


def test_every_word_of_the_table_of_keys_is_known() -> None:
    """A range that is not known would admit every number, and a table that is not known would be refused."""
    assert {row["need"] for row in stored_rows("building_keys")} - {""} <= set(NEEDS)
    assert set(KEYS) - {"", "on_racks", "stops", "storeys.goods", "other_direction.storeys"} <= set(KEYS[""])
