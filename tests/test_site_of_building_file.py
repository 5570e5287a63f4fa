"""Every command that takes a building file runs it at its site: the numbers that it shares with `seismass building`."""

from __future__ import annotations

import argparse
import ast
import importlib
import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
import seismass.assessment
import seismass.studies.risk.targeted_share
from seismass.cli import main
from seismass.commands.parser import COMMANDS, FAILED
from seismass.studies.fragility.hunt import exact_capacities
from seismass.studies.fragility.run import setting_of

READERS = {"read_building", "read_scene_or_building"}
CASES = {
    "weak": {"site": {"sds_g": 0.3, "sd1_g": 0.18}},
    "usual": {},
    "strong": {"site": {"sds_g": 2.2, "sd1_g": 1.32}},
    "stated period": {"building": {"scaling_period_s": 0.8}},
    "two directions": {"other_direction": {"period_s": 0.65}},
    "class III of Eurocode 8": {
        "site": {"sds_g": None, "sd1_g": None, "target": "ec8:1:B:0.3"},
        "code": {"id": "ec8"},
        "building": {"risk_category": "III"},
    },
    "level 4 of New Zealand in two directions": {
        "site": {"sds_g": None, "sd1_g": None, "target": "nzs1170:C:0.3"},
        "code": {"id": "nzs1170.5"},
        "building": {"risk_category": "IV"},
        "other_direction": {"period_s": 0.65},
    },
    "category IV at MCE_R": {"code": {"id": "asce7-16"}, "building": {"risk_category": "IV"}},
}
RULES = {
    "ec8": ("Eurocode 8", "Eurocode 8 elastic, type 1, ground B, a_gR = 0.3 g, gamma_I = 1.2"),
    "nzs1170.5": ("NZS 1170.5", "NZS 1170.5 site class C, Z = 0.3, R = 1.8"),
    "asce7-16": ("ASCE 7-16", "1.5 times ASCE 7 shape"),
    "asce7-10": ("ASCE 7-10", "ASCE 7 shape"),
}
"""Rule of scaling of each code, and how the label of its spectrum begins or goes on."""


@dataclass(frozen=True)
class Case:
    """A building file, its motions, and what `seismass building` makes of them."""

    file: Path
    records: Path
    motions: list[Any]
    own: sm.OwnBuilding
    answer: sm.Assessment
    folder: Path

    @property
    def plane(self) -> bool:
        return self.own.other is not None

    @property
    def scaled(self) -> list[Any]:
        return [motion.scaled(float(f)) for motion, f in zip(self.motions, self.answer.scaling.factors, strict=True)]


@pytest.fixture(scope="module", params=CASES)
def case(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Case:
    folder = tmp_path_factory.mktemp("site")
    tables: dict[str, Any] = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.5, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 3},
        "goods": {"live_load_kpa": 6, "mu": 0.05, "mu_factors": [1.0, 1.0]},
        "storeys": [{}, {"live_load_kpa": 0}],
    }
    for name, changes in CASES[request.param].items():
        merged = tables.get(name, {}) | changes
        tables[name] = {key: value for key, value in merged.items() if value is not None}
    file, records = folder / "shed.json", folder / "records"
    file.write_text(json.dumps(tables))
    records.mkdir()
    own = sm.read_building(file)
    count = 11 if request.param == "category IV at MCE_R" else 3
    for number, pair in enumerate(sm.records.builtin_pairs()[:count], start=1):
        for angle, record in list(zip(("000", "090"), pair, strict=False))[: 1 if own.other is None else 2]:
            peak = int(np.argmax(np.abs(pair.first.acceleration)))
            strong = record.acceleration[max(0, peak - round(2.0 / record.dt)) : peak + round(3.0 / record.dt)]
            rows = " ".join(f"{a:.9e}" for a in strong / sm.STANDARD_GRAVITY)
            head = f"PEER\nEvent {number}, Station {number}, {angle}\nACCELERATION TIME SERIES IN UNITS OF G\n"
            size = f"NPTS= {strong.size}, DT= {record.dt:.4f} SEC\n"
            (records / f"RSN{number}_EVENT{number}_{angle}.AT2").write_text(f"{head}{size}{rows}\n")
    motions: Any = sm.read_suite(records) if own.other is None else sm.records.find_pairs(records)
    found: list[sm.Assessment] = []
    assess = sm.assess

    def kept(*given: Any, **options: Any) -> sm.Assessment:
        found.append(assess(*given, **options))
        return found[0]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(seismass.assessment, "assess", kept)
        words = ["building", str(file), "--records", str(records), "--out", str(folder / "out"), "--no-figures"]
        assert main(words) == 0
    return Case(file, records, list(motions), own, found[0], folder)


def printed(capsys: pytest.CaptureFixture[str], *words: object) -> str:
    capsys.readouterr()
    assert main([str(word) for word in words]) == 0
    return capsys.readouterr().out


def in_words(case: Case) -> str:
    """How motions are scaled, as every command says it."""
    scaling = case.answer.scaling
    return f"{RULES[case.own.code.code_id][0]} to {scaling.target_label}, for T = {scaling.period:.3g} s"


def shared_by_building(case: Case, *_: Any) -> None:
    """ASCE 7-10 for T with the goods attached: the method by itself, in two directions over both ranges."""
    periods = [each.period(case.own.goods_mass) for each in (case.own, case.own.other) if each is not None]
    periods = [0.8] if case.own.scaling_period else periods
    target = case.own.site_spectrum()
    code = case.own.code.code_id
    assert RULES[code][1] in case.answer.scaling.target_label
    assert case.answer.scaling.method == RULES[code][0]
    if code == "asce7-10":
        within = (0.2 * min(periods) / max(periods), 1.5)
        found = sm.scaling.scale_asce7_10(case.motions, target, max(periods), period_range=within, between=False)
    else:
        lowest = [each.modes(case.own.goods_mass) for each in (case.own, case.own.other) if each is not None]
        found = sm.scaling.scale_by_code(
            case.motions,
            target.times(1.5) if code == "asce7-16" else target,
            max(periods),
            code_id=code,
            shortest_period=min(periods),
            lowest_period=min(float(modes.periods[modes.modes_needed(0.9) - 1]) for modes in lowest),
            ductility=3.0,
            between=False,
        )
    # 0.2 a/b in another order of its operations moves the ends of the range by rounding.
    np.testing.assert_allclose(case.answer.scaling.factors, found.factors, rtol=1e-12)
    # The strengths are those of the code, with the importance factor of the category.
    design = case.own.code_design()
    direction = "x" if case.plane else ""
    strengths = case.answer.tables["design"].filter(quantity="V_y", direction=direction)["value"]
    assert strengths.to_list() == design.yield_shear.tolist()


def shared_by_slip(case: Case, capsys: pytest.CaptureFixture[str], _: Any) -> None:
    out = case.folder / "slip"
    said = printed(capsys, "slip", case.file, "--records", case.records, "--out", out, "--no-figures")
    assert f"scaling     {in_words(case)}\n" in said
    ours = case.answer.slips.filter(model="real")["peak_slip"].to_list()
    assert max(ours) > 0.0
    # The same runs, written with the digits of a double.
    assert pl.read_csv(out / "slip_runs.csv")["peak_slip"].to_list() == ours
    bare = json.loads(printed(capsys, "slip", case.file, "--records", case.records, "--factor", "1", "--json"))
    unscaled = sm.slip.slip_demand(case.own.scene(), case.motions)
    assert bare["metadata"]["inputs_sha256"] == unscaled.metadata["inputs_sha256"]


def shared_by_animate(case: Case, capsys: pytest.CaptureFixture[str], _: Any) -> None:
    out = case.folder / ("shed.gif" if case.plane else "shed.html")
    words = ("animate", case.file, "--records", case.records, "--out", out, *(("--fps", "0.5") if case.plane else ()))
    shown = case.answer.example
    said = printed(capsys, *words)
    place = f"motion {shown.number} of {len(case.motions)}, that with the med"
    assert f"Motion: {shown.motion.name} x {shown.factor:.3g}, {place}" in said
    assert f"Scaling: {in_words(case)}." in said
    slip = 1e3 * sm.simulate(shown.scene, shown.motion).peak_slip
    largest = f"largest slip {slip[:, 2].max() if case.plane else slip.max():.3g} mm"
    assert largest in said
    assert re.search(r" x 2, motion \d+ of \d+.*\nScaling: motions x 2\.", printed(capsys, *words, "--factor", "2"))


def shared_by_fragility(case: Case, capsys: pytest.CaptureFixture[str], _: Any) -> None:
    words = ["fragility", str(case.file), "--records", str(case.records), "--limit", "drift=0.05"]
    by_factor = ["--measure", "scale", "--method", "stripes", "--intensity", "0.5,1"]
    if case.plane:
        for each in (words, [*words, *by_factor]):
            assert main(each) == 2
            assert "other_direction of scene must be left out" in capsys.readouterr().err
        return
    out = case.folder / "fragility"
    said = printed(capsys, *words, *by_factor, "--out", out, "--no-figures")
    assert f"scaling   {in_words(case)}; then by each intensity\n" in said
    runs = pl.read_csv(out / "runs.csv").filter(pl.col("intensity") == 1.0)
    for model in ("real", "code", "attached"):
        ours = (
            case.answer.runs.filter(model=model).group_by("motion", maintain_order=True).agg(pl.col("peak_drift").max())
        )
        # The same runs, written with the digits of a double.
        assert runs.filter(model=model)["drift"].to_list() == ours["peak_drift"].to_list(), model
    # By another measure the scaling of motions is without effect.
    stripes = ["--method", "stripes", "--intensity", "0.2,0.5"]
    said = printed(capsys, *words, *stripes, "--out", out, "--no-figures")
    assert "scaling   each motion to each intensity\n" in said
    found = sm.fragility.incremental_dynamic_analysis(
        case.own.scene(), case.scaled, sm.fragility.LimitState("drift", 0.05), method="stripes", intensities=[0.2, 0.5]
    )
    ours = pl.read_csv(out / "runs.csv").filter(model="real")["drift"].to_numpy()
    # Factors of factors: accelerations that differ by rounding.
    np.testing.assert_allclose(ours, found.runs.filter(model="real")["drift"].to_numpy(), rtol=1e-9)


def shared_by_risk(case: Case, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """The site designs strengths; motions are as they are read, as a capacity in Sa does not depend on their scale."""
    hazard = case.folder / "hazard.csv"
    hazard.write_text("Sa,rate\n0.01,1\n100,1e-7\n")
    taken: list[Any] = []

    def stop(*given: Any, **options: Any) -> None:
        taken.extend([*given, options["code_share"]])
        raise sm.errors.SimulationError("stopped")

    monkeypatch.setattr(seismass.studies.risk.targeted_share, "risk_targeted_share", stop)
    assert main(["risk", str(case.file), "--records", str(case.records), "--hazard", str(hazard)]) == FAILED
    scene, motions, _, limit, share = taken
    capsys.readouterr()
    assert scene == case.own.scene()
    assert limit.value == case.own.drift_limit
    assert share == case.own.code_share / case.own.present_share
    if case.plane:
        return
    assert list(motions) == case.motions
    capacities = [
        exact_capacities(setting_of({"real": scene}, each, [limit], "sa_t1", None, "test"), limit)
        for each in (motions, case.scaled)
    ]
    # Each is found to 1e-9 of itself.
    np.testing.assert_allclose(*capacities, rtol=1e-8)


def shared_by_scale(case: Case, capsys: pytest.CaptureFixture[str], _: Any) -> None:
    words = ("scale", "--building", case.file, "--records", case.records, "--json")
    document = json.loads(printed(capsys, *words, "--method", "mps"))
    assert document["period"] == pytest.approx(case.own.period(case.own.goods_mass), rel=1e-12)
    target = case.own.site_spectrum()
    assert document["target"] == target.label
    document = json.loads(printed(capsys, *words, *(["--pairs"] if case.plane else [])))
    assert [row["factor"] for row in document["motions"]] == case.answer.scaling.factors.tolist()
    assert document["method"] == case.answer.scaling.method


def shared_by_target(case: Case, capsys: pytest.CaptureFixture[str], _: Any) -> None:
    period = case.answer.scaling.period
    row = printed(capsys, "target", "--building", case.file, "--period", repr(period)).splitlines()[1]
    ours = case.own.site_spectrum()(period) / sm.STANDARD_GRAVITY
    assert float(row.split(",")[1]) == pytest.approx(float(ours), rel=1e-12)


SHARED: dict[str, Callable[[Case, pytest.CaptureFixture[str], pytest.MonkeyPatch], None]] = {
    "building": shared_by_building,
    "slip": shared_by_slip,
    "animate": shared_by_animate,
    "fragility": shared_by_fragility,
    "risk": shared_by_risk,
    "scale": shared_by_scale,
    "target": shared_by_target,
}
WRITES = {"new"}
"""A command that reads the building file that it wrote."""


def actions_of(name: str) -> list[argparse.Action]:
    parser = argparse.ArgumentParser()
    importlib.import_module(f"seismass.commands.{COMMANDS[name][0]}").COMMAND.options(parser)
    return parser._actions


def reads_building_files(name: str) -> bool:
    source = Path(importlib.import_module(f"seismass.commands.{COMMANDS[name][0]}").__file__ or "")
    nodes = ast.walk(ast.parse(source.read_text(encoding="utf-8")))
    return any(isinstance(node, ast.ImportFrom) and READERS & {each.name for each in node.names} for node in nodes)


def test_every_command_that_takes_a_building_file_is_among_them() -> None:
    by_source = {name for name in COMMANDS if reads_building_files(name)}
    by_help = {
        name
        for name in COMMANDS
        for action in actions_of(name)
        if action.type is Path and "building file" in (action.help or "") and action.dest != "records"
    }
    assert by_source == set(SHARED) | WRITES
    assert by_help == set(SHARED) | WRITES


@pytest.mark.parametrize("name", SHARED)
def test_numbers_are_those_of_building(
    name: str, case: Case, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    SHARED[name](case, capsys, monkeypatch)


@pytest.mark.parametrize("name", ["slip", "animate", "fragility"])
def test_a_target_stands_in_place_of_the_site(name: str, case: Case, capsys: pytest.CaptureFixture[str]) -> None:
    if case.plane and name == "fragility":
        return
    words = [name, str(case.file), "--records", str(case.records), "--target", "ec8:1:C:0.3", "--period", "0.4"]
    words += ["--measure", "scale", "--method", "stripes", "--intensity", "1"] if name == "fragility" else []
    out = "t.gif" if case.plane else "t.html"
    words += ["--out", str(case.folder / out), *(["--fps", "0.5"] * case.plane)] if name == "animate" else []
    own = case.own.motion_target(sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3))
    method = RULES[case.own.code.code_id][0]
    said = printed(capsys, *words)
    assert own.label.removesuffix(", gamma_I = 1.2") in said
    assert re.search(rf"{method} to .*, for T = 0\.4 s", said)
    assert main([*words, "--factor", "1"]) == 2
    assert f"--factor of {name} must be left out where a target is given; got 1" in capsys.readouterr().err
