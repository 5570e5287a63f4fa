"""Site, period and drift limit of a building file by a code with its numbers, and the commands that take a site."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main
from seismass.model.codes import FROM_MEMORY, SECOND_HAND, VERIFIED
from seismass.runs.scene_file import example_scene

G = 9.80665


def tables(**changes: dict[str, Any]) -> dict[str, Any]:
    """A cold store of two storeys under Eurocode 8; tables changed as told, None removes a key."""
    building: dict[str, Any] = {
        "site": {"target": "ec8:1:C:0.3"},
        "code": {"id": "ec8"},
        "building": {
            "period_s": 0.5,
            "height_m": 6.0,
            "area_m2": 2000.0,
            "dead_load_kpa": 6.0,
            "design": True,
            "R": 3.0,
        },
        "goods": {"live_load_kpa": 15.0, "occupied": 0.8, "friction": "timber-on-stainless"},
        "storeys": [{}, {"dead_load_kpa": 1.5, "live_load_kpa": 0.0}],
    }
    for table, values in changes.items():
        merged = {**building.get(table, {}), **values}
        building[table] = {key: value for key, value in merged.items() if value is not None}
    return building


def written(path: Path, **changes: dict[str, Any]) -> Path:
    path.write_text(json.dumps(tables(**changes)), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ec8:1:C:0.3", sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3)),
        ("nzs:D:0.4:1.3", sm.TargetSpectrum.nzs1170("D", z=0.4, r=1.3)),
        ("asce7:1.0:0.6", sm.TargetSpectrum.asce7(1.0, 0.6)),
    ],
)
def test_a_site_is_a_code_with_its_numbers(text: str, expected: sm.TargetSpectrum) -> None:
    assert sm.read_building(tables(site={"target": text})).site_spectrum() == expected


def test_a_file_of_the_site_is_beside_the_building(tmp_path: Path) -> None:
    (tmp_path / "site.csv").write_text("T,Sa (g)\n0.05,0.5\n5,0.5\n")
    file = written(tmp_path / "b.json", site={"target": "site.csv"})
    assert sm.read_building(file).site_spectrum()(1.0) == pytest.approx(0.5 * G, rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"site": {"target": "ec9:1"}}, "site.target of building must be a CSV that is there or one of asce7:SDS"),
        ({"site": {"target": "ec8:1:Q:0.3"}}, "site.target of building must be .*ground .* must be one of A, B"),
        ({"site": {"sds_g": 1.0}}, "site.sds_g of building must be left out where site.target is given; got both"),
        ({"site": {"target": 8}}, "site.target of building must be text; got 8"),
        (
            {"building": {"system": "mud"}},
            "building.system of building must be one of steel-moment-frame, .*; got 'mud'",
        ),
        (
            {"building": {"system": "other", "period_code": "ec8"}},
            "building.period_code of building must be left out where building.period_s is given; got both",
        ),
        ({"building": {"period_s": None, "system": "mud"}}, "building.system of building must be one of steel-moment"),
        (
            {"building": {"period_s": None, "system": "other", "period_code": "ansi-rmi"}},
            "building.period_code of building must be one of the codes whose approximate period is known here: asce7",
        ),
        (
            {"building": {"period_s": None, "system": "other", "height_m": None}},
            "building.height_m of building must be given where building.system is; got nothing",
        ),
        ({"building": {"period_code": "ec8"}}, "period_code of building must be left out where building.system is not"),
        (
            {"building": {"drift_limit": 0.01, "drift_class": "other"}},
            "building.drift_class of building must be left out where building.drift_limit is given; got both",
        ),
        ({"building": {"risk_category": "V"}}, "building.risk_category of building must be one of I, II, III, IV"),
        ({"building": {"drift_class": "glass"}}, "drift_class of building must be one of brittle-partitions, ductile-"),
        (
            {"building": {"drift_class": "other"}, "code": {"id": "e030"}},
            "drift_limit_code of building must be one of the codes whose drift limits are known here: asce7-10",
        ),
    ],
)
def test_wrong_sites_periods_and_limits_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(tables(**changes))


@pytest.mark.parametrize(
    ("code", "system", "period", "status"),
    [
        ("ec8", "concrete-moment-frame", 0.075 * 12.0**0.75, FROM_MEMORY),  # EN 1998-1, 4.3.3.2.2(3)
        ("asce7-10", "steel-moment-frame", 0.0724 * 12.0**0.8, VERIFIED),  # table 12.8-2
        ("nzs1170.5", "other", 1.25 * 0.05 * 12.0**0.75, FROM_MEMORY),  # commentary C4.1.2.2
    ],
)
def test_a_system_gives_the_period_with_the_codes_share(code: str, system: str, period: float, status: str) -> None:
    """Two storeys of 6 m; the period is that of the building with the code's share of the live load."""
    building = sm.read_building(tables(building={"period_s": None, "system": system}, code={"id": code}))
    assert building.stated_period == pytest.approx(period, rel=1e-14)
    assert building.period_mass == "code share"
    assert building.period(building.code_mass) == pytest.approx(period, rel=1e-12)
    assert building.period() < period < building.period(building.live_load)
    assert building.period_rule is not None
    assert building.period_rule.status == status


def test_a_system_beside_a_period_limits_that_of_the_design_alone() -> None:
    """ASCE/SEI 7-10, 12.8.2: C_u T_a, with C_u = 1.4 for S_D1 >= 0.4 and T_a = 0.0488 h^0.75 of all other systems."""
    code = {"site": {"target": "asce7:1:0.6"}, "code": {"id": "asce7-10"}}
    building = sm.read_building(tables(building={"system": "other"}, **code))
    assert (building.stated_period, building.period_mass, building.period_rule) == (0.5, "bare", None)
    assert building.period() == pytest.approx(0.5, rel=1e-12)
    assert building.code_design().period == pytest.approx(1.4 * 0.0488 * 12.0**0.75, rel=1e-12)
    without = sm.read_building(tables(**code)).code_design().period
    assert without == pytest.approx(building.period(building.design_mass), rel=1e-12)


def test_another_code_and_another_mass_may_be_stated() -> None:
    changes = {"period_s": None, "system": "moment-frame-by-storeys", "period_code": "asce7-10", "period_mass": "all"}
    building = sm.read_building(tables(building=changes))
    assert building.period(building.goods_mass) == pytest.approx(0.1 * 2, rel=1e-12)  # ASCE/SEI 7-10, equation 12.8-8


@pytest.mark.parametrize(
    ("keys", "code", "ratio", "status"),
    [
        ({"risk_category": "II", "drift_class": "brittle-partitions"}, "ec8", 0.005 / 0.5, SECOND_HAND),
        ({"risk_category": "III", "drift_class": "ductile-partitions"}, "ec8", 0.0075 / 0.4, SECOND_HAND),
        ({"drift_class": "other"}, "ec8", 0.010 / 0.5, SECOND_HAND),
        ({"risk_category": "IV"}, "nzs1170.5", 0.025, FROM_MEMORY),  # 7.5.1
        ({"risk_category": "IV", "drift_limit_code": "asce7-10"}, "ec8", 0.010, VERIFIED),  # table 12.12-1
    ],
)
def test_limits_of_codes(keys: dict[str, str], code: str, ratio: float, status: str) -> None:
    building = sm.read_building(tables(building=keys, code={"id": code}))
    assert building.drift_limit == pytest.approx(ratio, rel=1e-14)
    assert building.drift_limit_rule is not None
    assert building.drift_limit_rule.status == status


@pytest.mark.parametrize(("category", "ratio"), [(None, 0.020), ("III", 0.015), ("IV", 0.010)])
def test_a_code_without_drift_limits_has_those_of_asce_7(category: str | None, ratio: float) -> None:
    """ASCE/SEI 7-10, table 12.12-1, all other structures: 0.020, 0.015 and 0.010 of the height."""
    building = sm.read_building(tables(building={"risk_category": category}, code={"id": "e030"}))
    assert building.drift_limit == pytest.approx(ratio, rel=1e-14)
    assert building.drift_limit_rule is not None
    assert building.drift_limit_rule.code_id == "asce7-10"


def test_a_limit_may_be_stated_beside_the_category_of_the_design() -> None:
    building = sm.read_building(tables(building={"drift_limit": 0.013, "risk_category": "III"}))
    assert (building.drift_limit, building.drift_limit_rule, building.risk_category) == (0.013, None, "III")


@pytest.fixture(scope="module")
def cold_store() -> sm.Assessment:
    changes = {"period_s": None, "system": "concrete-moment-frame", "drift_class": "ductile-partitions"}
    return sm.assess(tables(building=changes), resamples=20)


def test_an_assessment_under_eurocode_8_says_what_it_took(cold_store: sm.Assessment, tmp_path: Path) -> None:
    said = " ".join(cold_store.assumptions)
    assert "Site spectrum: Eurocode 8 elastic, type 1, ground C, a_gR = 0.3 g." in said
    assert "0.075 h^0.75 with h the height in m, Eurocode 8" in said
    assert "taken with the code's share of the live load as mass" in said
    assert "unverified; not checked against the code" in said
    assert "Limits: drift ratio 0.015 (Eurocode 8, EN 1998-1, 4.4.3.2(1), ductile-partitions" in said
    assert not cold_store.answer.doubts
    # The rule takes S_a of the site spectrum at the period without goods, in g: 1.15 x 0.3 x 2.5 on the plateau.
    assert cold_store.effective["real"].by_hand.spectral_acceleration_g == pytest.approx(1.15 * 0.3 * 2.5, rel=1e-3)
    document = json.loads(cold_store.to_json())
    assert document["target"]["shape"] == "eurocode8"
    assert document["input"]["period_rule"]["clause"] == "4.3.3.2.2(3)"
    assert document["input"]["drift_limit_rule"]["structure"] == "ductile-partitions"
    cold_store.write(tmp_path, figures=False)
    checks = pl.read_csv(tmp_path / "checks.csv").filter(check="capped mean drift ratio")
    assert checks["limit"].unique().to_list() == [0.015]
    assert checks["source"][0].startswith("Eurocode 8, EN 1998-1, 4.4.3.2(1)")


def test_what_the_period_means_for_the_share(cold_store: sm.Assessment) -> None:
    """The rule for the period with another mass: 0.48 s without goods, or with all of them."""
    (sentence,) = [line for line in cold_store.assumptions if line.startswith("The rule by hand gives a share of")]
    own, bare, full = (float(piece) for piece in sentence.replace(",", "").split() if piece.startswith("0."))
    assert own == pytest.approx(cold_store.effective["real"].by_hand.estimate, abs=0.005)
    assert bare > own == full  # the code counts 0.8 of the live load, and 0.8 is present


def test_a_period_that_gravity_does_not_allow_is_named() -> None:
    """k goes with 1/T^2, and P/h of storey 1 is 39 000 kN over 6 m: the longest period is where both are equal."""
    stiffness = sm.read_building(tables()).stiffness[0]
    longest = 0.5 * np.sqrt(stiffness / ((15.0 * 0.8 + 6.0 + 1.5) * 2.0e6 / 6.0))
    message = rf"building.period_s of building must be below {longest:.3g} s, where the gravity load P/h of storey 1"
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        sm.read_building(tables(building={"period_s": 1.01 * longest}))
    assert sm.read_building(tables(building={"period_s": 0.99 * longest})).storeys == 2


def test_a_table_of_a_target_is_read_again(tmp_path: Path) -> None:
    """Between 200 periods and the corners a rising branch is straight, its table log-log: within a thousandth."""
    target = sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3)
    target.table().write_csv(tmp_path / "site.csv")
    again, periods = sm.TargetSpectrum.from_csv(tmp_path / "site.csv"), np.geomspace(0.01, 4.0, 1000)
    np.testing.assert_allclose(again(periods), target(periods), rtol=1e-3)
    np.testing.assert_allclose(again([0.2, 0.6, 2.0]), target([0.2, 0.6, 2.0]), rtol=1e-14)
    with pytest.raises(sm.errors.InvalidOption, match="periods of target spectrum must be positive; got 0"):
        target.table([0.0, 1.0])


def test_the_command_writes_a_target(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """S_e at T_B to T_C is 2.5 S a_g = 2.5 x 1.15 x 0.3, EN 1998-1, equation (3.3)."""
    assert main(["target", "ec8:1:C:0.3", "--period", "0.2,0.4"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "period (s),Sa (g)"
    assert [float(line.split(",")[1]) for line in lines[1:]] == pytest.approx([0.8625, 0.8625], rel=1e-12)
    file = written(tmp_path / "b.json")
    assert main(["target", "--building", str(file), "--out", str(tmp_path / "site.csv")]) == 0
    assert "Eurocode 8 elastic, type 1, ground C, a_gR = 0.3 g" in capsys.readouterr().out
    assert sm.TargetSpectrum.from_csv(tmp_path / "site.csv")(0.4) == pytest.approx(0.8625 * G, rel=1e-9)


def test_scale_takes_the_site_of_the_building(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = str(written(tmp_path / "b.json"))
    assert main(["scale", "--building", file, "--method", "asce7-16"]) == 0
    # ASCE 7-16, 16.2.1: MCE_R, which is 1.5 times the design spectrum (11.4.5); Eurocode 8 scales to its own.
    assert "target  1.5 times Eurocode 8 elastic, type 1, ground C, a_gR = 0.3 g" in capsys.readouterr().out
    assert main(["scale", "--building", file, "--method", "asce7-16", "--target", "asce7:1:0.6"]) == 0
    assert "target  1.5 times ASCE 7 shape, S_DS = 1 g" in capsys.readouterr().out
    assert main(["scale", "--building", file]) == 0
    said = capsys.readouterr().out
    assert "target  Eurocode 8 elastic, type 1, ground C, a_gR = 0.3 g" in said
    assert "method  Eurocode 8, T = " in said
    assert main(["scale", "--building", file, "--method", "asce7-16", "--sds", "1"]) == 2
    assert "site spectrum of scale must be given by --sds and --sd1 together" in capsys.readouterr().err


def test_a_site_may_be_given_with_every_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = str(written(tmp_path / "b.json", site={"target": None}))
    hazard = tmp_path / "hazard.csv"
    intensity = np.array([0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0])
    rows = [f"{level:g},{rate:.6g}" for level, rate in zip(intensity, 0.01 * (intensity / 0.1) ** -2.5, strict=True)]
    hazard.write_text("\n".join(["Sa,rate", *rows, ""]))
    site = ["--target", "ec8:1:C:0.3"]
    cloud = ["--method", "cloud", "--suite", "seven"]
    for words in (
        ["slip", file, "--suite", "seven"],
        ["fragility", file, *cloud],
        ["risk", file, "--hazard", str(hazard), "--suite", "seven", "--share", "0,0.5,1"],
        ["animate", file, "--suite", "seven", "--out", str(tmp_path / "b.html")],
    ):
        assert main(words) == 2, words
        assert "must be given: [site] in the file" in capsys.readouterr().err
        assert main([*words, *site]) == 0, words
        capsys.readouterr()
    scene = str(example_scene())
    assert main(["fragility", scene, *cloud, *site]) == 2
    assert "--target of fragility must be left out with a scene file" in capsys.readouterr().err
    assert main(["animate", scene, *site]) == 2
    assert "--target of animate must be left out with a scene file" in capsys.readouterr().err


def test_slip_scales_a_building_for_its_period(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = written(tmp_path / "b.json")
    building = sm.read_building(file)
    assert main(["slip", str(file), "--suite", "seven", "--target", "ec8:1:C:0.3"]) == 0
    assert f"for T = {building.period(building.goods_mass):.3g} s" in capsys.readouterr().out


def test_a_file_of_another_kind_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    building, scene = str(written(tmp_path / "b.json")), str(example_scene())
    assert main(["run", building]) == 2
    assert "kind of b.json must be a scene file; got a building file, which `seismass building`" in (
        capsys.readouterr().err
    )
    assert main(["building", scene, "--out", str(tmp_path / "a")]) == 2
    assert "must be a building file; got a scene file, which `seismass run`" in capsys.readouterr().err
    assert main(["campaign", building, "--out", str(tmp_path / "c")]) == 2
    assert "must be a campaign file; got a building file" in capsys.readouterr().err
    from seismass.studies.campaign.folder import example_description

    assert main(["run", str(example_description())]) == 2
    assert "must be a scene file; got a campaign file, which `seismass campaign` takes" in capsys.readouterr().err


def test_a_building_is_animated_where_goods_slide(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Beside the code's share: a quarter of the design live load of which 0.8 is present."""
    out = tmp_path / "w.html"
    assert main(["animate", str(example_file()), "--suite", "seven", "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert "largest slip 0 mm" not in said
    assert "ASCE/SEI 7-10 model (31.25 % of the goods attached)" in said
    assert "that with the median drift of those under which goods slide" in out.read_text(encoding="utf-8")


def test_the_example_has_a_file_of_each_kind_of_limit() -> None:
    """The commented lines of the example, without their #, are read."""
    text = example_file().read_text(encoding="utf-8")
    swaps = (
        ("sds_g = 1.0 ", "# sds_g = 1.0 "),
        ("sd1_g = 0.6 ", "# sd1_g = 0.6 "),
        ("tl_s = 8.0 ", "# tl_s = 8.0 "),
        ("# target =", "target ="),
        ("period_s = 0.57 ", "# period_s = 0.57 "),
        ("# system =", "system ="),
        ("# period_code =", "period_code ="),
        ("# drift_class =", "drift_class ="),
        ("# drift_limit_code =", "drift_limit_code ="),
    )
    for old, new in swaps:
        assert old in text
        text = text.replace(old, new, 1)
    building = sm.read_building(tomllib.loads(text))
    # EN 1998-1, 4.4.3.2(1): brittle partitions 0.005, nu 0.5 in the importance class II that the example states.
    assert building.drift_limit == pytest.approx(0.005 / 0.5, rel=1e-14)
    assert building.stated_period == pytest.approx(0.0724 * 18.0**0.8, rel=1e-14)
