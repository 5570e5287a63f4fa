"""The table of a committee: shares against other time stepping, tables, sheet, resuming, and the command."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass.base.stored_results import result_store
from seismass.cli import main
from seismass.studies.evidence import definitions, example_file, read_archetypes, runs
from seismass.studies.evidence import table as table_module
from seismass.studies.evidence import variants as variants_module
from seismass.studies.evidence.table import stations, typical_archetypes
from seismass.studies.evidence.variants import CHANGES, variants

ARCHETYPES, SETTING = read_archetypes()
TINY = replace(SETTING, samples=(2, 2), levels=(0.5, 1.0, 1.5, 3.0), shares=(0.0, 0.25, 0.6, 1.0))
TWO = (ARCHETYPES[1], ARCHETYPES[19])
"""Light storage, one storey, R 3.25, and retail, two storeys, R 3.25."""
FORTY = sm.builtin_suite("forty")
FEW = replace(FORTY, records=FORTY.records[:4])
TABLES = {"archetypes", "shares", "codes", "fragility", "convergence", "summary", "rules", "full"}


@pytest.fixture(scope="module")
def found() -> sm.evidence.Evidence:
    return sm.evidence.evidence(TWO, FEW, setting=TINY, other=replace(FEW, name="others"), resamples=40)


def stepped(
    motions: list[sm.Motion], case: dict[str, np.ndarray], k: float, damping: float, ultimate: float, height: float
) -> np.ndarray:
    """Peak drift ratio of one storey by time stepping of its own, all cases side by side: velocities and the contact's
    impulse, bounded by friction, at the end of each step (Moreau), springs as two elasto-plastic ones in parallel.
    """
    step, longest = 2.5e-4, max(motion.duration for motion in motions)
    time = np.arange(0.0, longest, step)
    grounds = np.array(
        [np.interp(time, motion.dt * np.arange(motion.samples), motion.acceleration) for motion in motions]
    )
    mass, goods, slope = case["mass"], case["goods"], case["slope"]
    first, second = case["strength"] / k, case["strength"] * (1.0 + (ultimate - 1.0) / slope) / k
    u, v, w, peak, p1, p2 = (np.zeros(len(mass)) for _ in range(6))
    up = np.ones(len(mass), dtype=bool)
    for ground in grounds[case["motion"]].T:
        p1 = u - np.clip(u - p1, -first, first)
        p2 = u - np.clip(u - p2, -second, second)
        spring = k * (1.0 - slope) * (u - p1) + k * slope * (u - p2)
        force = case["weight"] / height * u - spring - damping * v
        stick = ((w - v) / step - force / mass) / (1.0 / mass + 1.0 / goods)
        contact = np.clip(stick, -case["mu"] * goods * sm.STANDARD_GRAVITY, case["mu"] * goods * sm.STANDARD_GRAVITY)
        v = np.where(up, v + step * ((force + contact) / mass - ground), 0.0)
        w = w + step * (-contact / goods - ground)
        u = u + step * v
        peak = np.maximum(peak, np.abs(u))
        up &= peak < case["collapse"]
    return np.minimum(peak, case["collapse"]) / height


def test_shares_are_those_of_another_time_stepping() -> None:
    """One storey of light storage under three motions: drifts to 2 %, the share of mean drift to 0.01."""
    archetype = ARCHETYPES[1]
    suite = replace(FORTY, records=tuple(FORTY.records[i] for i in (0, 4, 9)))
    setting = replace(SETTING, samples=(2, 4), levels=(1.0, 1.5), shares=(0.0, 0.3, 0.6, 1.0), kinetic=1.0)
    table = runs.solved_archetype(archetype, setting, suite, redesign=False)
    models, real = runs.gathered(table, "model"), runs.gathered(table, "real")
    own = setting.designed(archetype)
    building = own.building
    motions = runs.scaled(suite, setting, own.design.period)
    sampled = runs._sampled(archetype, setting, own, 3, 4, {"scale": [1.0]})
    drawn, present = sampled.table(), runs._mean_presence(sampled)
    of_models = runs._attached(archetype, setting, own, 3, present, {"attached": setting.shares}).table()
    dead, ratio = float(building.mass[0]), float(own.load_ratio[0])
    fixed = dead * (1.0 + ratio * of_models["attached"].to_numpy())
    goods = dead * ratio * drawn["occupancy"].to_numpy()
    many = len(fixed)
    g = sm.STANDARD_GRAVITY
    case = {
        "mass": np.concatenate([np.full(len(goods), dead), fixed]),
        "goods": np.concatenate([goods, np.full(many, 1e-9)]),
        "mu": np.concatenate([drawn["mu_s"].to_numpy(), np.ones(many)]),
        "weight": np.concatenate([dead * g + goods * g, np.full(many, dead * g * (1.0 + ratio * present))]),
        "motion": np.concatenate([drawn["motion"].to_numpy(), of_models["motion"].to_numpy()]).astype(int) - 1,
        "slope": np.concatenate([drawn["second_slope"].to_numpy(), of_models["second_slope"].to_numpy()]),
    }
    factor = np.concatenate([drawn["strength"].to_numpy(), of_models["strength"].to_numpy()])
    case |= {"strength": factor * float(building.yield_shear[0]), "collapse": np.array(0.03 * 4.5)}
    damping = 2.0 * 0.05 * np.sqrt(float(building.stiffness[0]) * dead)
    peaks = stepped(motions, case, float(building.stiffness[0]), damping, setting.overstrength, 4.5)
    own_real = peaks[: len(goods)].reshape(3, 2, 4)
    own_models = np.moveaxis(peaks[len(goods) :].reshape(3, 2, 4), 2, 0)
    np.testing.assert_allclose(real.at(0)[0], own_real, rtol=0.02)
    np.testing.assert_allclose(models.at(0)[..., 0], own_models, rtol=0.02)
    shares = [
        sm.evidence.equal_share(setting.shares, *both).value
        for both in ((models.at(0)[..., 0], real.at(0)[0]), (own_models, own_real))
    ]
    assert 0.05 < shares[0] < 0.95
    assert shares[0] == pytest.approx(shares[1], abs=0.01)
    assert real.at(0, "slides").any()


def test_other_models_of_an_archetype() -> None:
    """Fixed goods, other designs, and the building of no live load without goods: as many runs as are told, and of the
    last the drifts of that building alone.
    """
    archetype, suite = ARCHETYPES[1], replace(FORTY, records=FORTY.records[:3])
    setting = replace(SETTING, samples=(2, 16), levels=(1.0, 1.5), shares=(0.0, 0.6, 1.0))
    told: list[int] = []
    table = runs.solved_archetype(archetype, setting, suite, report=told.append)
    assert len(table) == told[-1] == runs.runs_of(archetype, setting, 3, True)
    counts = {model: rows.height // (3 * 2 * 2) for (model,), rows in table.group_by("model")}
    assert counts == {"real": 16, "model": 3, "fixed": 4, "design": 2 * len(runs.DESIGN_FRACTIONS), "reference": 1}
    bare, rows = setting.designed(archetype, 0.0), table.filter(model="reference")
    grid = runs._attached(archetype, setting, bare, 3, 0.0, {"attached": [0.0], "scale": setting.levels})
    motions = runs.scaled(suite, setting, setting.designed(archetype).design.period)
    alone = []
    for number, (scale, motion) in enumerate(grid.table()["scale", "motion"].iter_rows(), start=1):
        scene = grid.scene(number)
        np.testing.assert_allclose(scene.building.mass, bare.building.mass, rtol=1e-12)
        building = sm.Scene(scene.building, collapse_drift=scene.collapse_drift)
        run = sm.simulate(building, motions[motion - 1].scaled(scale))
        alone.append(float(run.peak_drift_ratio.max()))
    most = archetype.system.collapse
    np.testing.assert_allclose(rows["drift"], np.where(rows["collapsed"], most, np.minimum(alone, most)), rtol=1e-9)
    assert set(rows["share"]) == {0.0}


def test_tables(found: sm.evidence.Evidence) -> None:
    tables = found.tables
    assert set(tables) == TABLES
    shares = tables["shares"]
    assert set(shares["definition"]) == set(definitions.DEFINITIONS)
    assert shares.filter(suite="other", definition="e_d").height == 0  # designs again on the first suite alone
    known = shares.drop_nulls("share")
    assert ((known["low"] <= known["share"] + 1e-12) & (known["share"] <= known["high"] + 1e-12)).mean() > 0.8
    rare = shares.filter(kind="rare")
    assert rare["share"].null_count() == rare.height > 0  # P(2 %) and P(collapse) of so few runs
    row = found.table.row(0, named=True)
    of_row = known.filter(suite="first", archetype=TWO[0].name)
    both = [of_row.filter(definition=name)["share"][0] for name in ("a_mean", "d")]
    assert row["round"] == pytest.approx(round(np.mean(both) / 0.05) * 0.05)
    assert row["code_fraction"] == 0.25
    assert found.table["rate_round_numbers"][0] == pytest.approx(
        tables["codes"].filter(suite="first", archetype=TWO[0].name, code_id="round numbers", quantity="rate")[
            "real_over_model"
        ][0]
    )
    design = tables["archetypes"].row(0, named=True)
    assert design["T_design_s"] == pytest.approx(1.4 * 0.0488 * 4.5**0.75, rel=1e-9)
    assert design["V_design_kn"] == pytest.approx((4500.0 + 0.25 * 6000.0) / 3.25, rel=1e-9)
    assert {"first", "other"} == set(tables["rules"]["suite"])
    assert found.metadata["runs"] == 2 * 4 * 4 * 2 * (4 + 2 + 1 + 1 + 4) + 2 * (2 * 4 * 4 * 1 * (4 + 2))


def test_ratios_follow_from_the_fragilities(found: sm.evidence.Evidence) -> None:
    """Mean drift of the real buildings over that of the models, linear between shares."""
    levels = found.tables["fragility"].filter(suite="first", archetype=TWO[1].name, level=1.0)
    models = levels.filter(model="share").sort("share")
    real = levels.filter(model="real")["mean_drift"][0]
    ratio = found.tables["codes"].filter(
        suite="first", archetype=TWO[1].name, code_id="0.3 everywhere", quantity="drift"
    )["real_over_model"][0]
    assert ratio == pytest.approx(real / np.interp(0.3, models["share"], models["mean_drift"]), rel=1e-5)


def test_text_sheet_and_files(found: sm.evidence.Evidence, tmp_path: Path) -> None:
    assert "EVIDENCE OF SYNTHETIC MOTIONS" in found.text.splitlines()[0]
    assert "light storage (6 kPa), stiff" in found.text
    written = {path.name for path in found.write(tmp_path)}
    assert {"summary.parquet", "shares.csv", "evidence.json", "evidence.svg", "evidence.png", "report.html"} <= written
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    for words in ("EVIDENCE OF SYNTHETIC MOTIONS", "Sliding alone leaves", "Not known", "T_design_s"):
        assert words in page
    assert_frame_equal(pl.read_parquet(tmp_path / "shares.parquet"), found.tables["shares"])
    recorded = replace(found, metadata=found.metadata | {"synthetic": False})
    assert "SYNTHETIC" not in recorded.text


def test_an_interrupted_table_goes_on(
    found: sm.evidence.Evidence, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The third archetype is interrupted: the next call solves it and what is left, and ends with the same numbers."""
    solved, whole = [], runs.solved_archetype

    def counted(*args: Any, **options: Any) -> pl.DataFrame:
        solved.append(args)
        if len(solved) == 3:
            raise KeyboardInterrupt
        return whole(*args, **options)

    monkeypatch.setattr(table_module, "solved_archetype", counted)
    arguments: dict[str, Any] = {"setting": TINY, "other": replace(FEW, name="others"), "resamples": 40}
    with pytest.raises(KeyboardInterrupt), result_store(tmp_path, "evidence", "same inputs") as store:
        sm.evidence.evidence(TWO, FEW, **arguments, store=store)
    told: list[tuple[int, int]] = []
    with result_store(tmp_path, "evidence", "same inputs") as store:
        tell = {"progress": lambda done, total: told.append((done, total))}
        again = sm.evidence.evidence(TWO, FEW, **arguments, **tell, store=store)
    assert len(solved) == 3 + 6 - 2
    for name, table in found.tables.items():
        assert_frame_equal(again.tables[name], table)
    assert told[-1] == (again.metadata["runs"],) * 2


def test_archetypes_of_the_example_and_of_wrong_files(tmp_path: Path) -> None:
    assert (len(ARCHETYPES), len({each.name for each in ARCHETYPES})) == (29, 29)
    assert {each.kind for each in typical_archetypes(ARCHETYPES)} == {"stiff", "ductile"}
    text = example_file().read_text(encoding="utf-8")
    for old, new, said in (
        ('"R 2"]', '"R 9"]', "buildings .* must be of the systems"),
        ("kinetic = 0.75", "kinetic = 1.75", "random.kinetic .* must be from 0 to 1"),
        ("first_yield = 1.5", "first_yeild = 1.5", "did you mean random.first_yield"),
        ("felt-pad-on-metal", "felt-pad-on-mud", "friction pair must be"),
        ("[[1, ", "[[0, ", "buildings .* must be a list of"),
        ("library, sustained", "archive", "occupancy must be"),
    ):
        assert old in text
        path = tmp_path / "archetypes.toml"
        path.write_text(text.replace(old, new), encoding="utf-8")
        with pytest.raises(sm.errors.InvalidOption, match=said):
            read_archetypes(path)


def test_stations_of_recordings_are_resampled_together() -> None:
    records = [
        replace(record, synthetic=False, event="e", station=f"s{i // 2}") for i, record in enumerate(FEW.records)
    ]
    assert stations(replace(FEW, records=tuple(records))).tolist() == [0, 0, 1, 1]
    assert stations(FEW).tolist() == [0, 1, 2, 3]


def test_variants_change_one_input() -> None:
    rows = variants(TINY, [FEW, FORTY], TWO[:1])
    assert {row.name for row in rows} >= set(CHANGES)
    for row in rows:
        changed = [name for name, value in vars(row.setting).items() if value != getattr(TINY, name)]
        few = replace(TINY, **variants_module.FEW, altered=row.setting.altered)
        assert len(changed) <= 2 or row.setting == few  # S_DS and S_D1
    ends = {(row.name, row.end) for row in rows}
    assert len(ends) == len(rows)


def test_varied_inputs_make_a_tornado() -> None:
    least = replace(TINY, samples=(1, 1), levels=(1.0, 1.5))
    found = sm.evidence.evidence(TWO[:1], replace(FEW, records=FEW.records[:2]), setting=least, vary=True, resamples=2)
    table = found.tables["vary"]
    assert set(table["end"]) == {"low", "high"}
    assert found.figure_names == ("evidence", "tornado")
    assert found.plot("tornado").axes
    low, high = (
        table.filter(input="friction of all goods 0.2 to 0.6", end=end)["a_mean"][0] for end in ("low", "high")
    )
    assert low <= high


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evidence", "--example"]) == 0
    assert capsys.readouterr().out == example_file().read_text(encoding="utf-8")
    out = str(tmp_path / "out")
    options = [
        "--occupancies",
        "office",
        "--quick",
        "--samples",
        "1x1",
        "--suite",
        "seven",
        "--out",
        out,
        "--no-figures",
    ]
    assert main(["evidence", *options, "--site", "0.6:0.3", "--first-yield", "1.2:0.1"]) == 0
    printed = capsys.readouterr().out
    assert "S_DS 0.6 g, S_D1 0.3 g" in printed
    assert "first yield 1.2 V_y" in printed
    assert not list((tmp_path / "out").glob(".seismass*"))
    hazard = tmp_path / "hazard.csv"
    hazard.write_text("0.05,0.02\n0.5,0.001\n5.0,0.000001\n", encoding="utf-8")
    for wrong, said in (
        (["--occupancies", "church"], "occupancy of evidence must be one of light storage"),
        (["--codes", "asce7-10,nocode"], "id of code must be"),
        (["--hazard", str(hazard)], "--hazard-period of evidence must be given"),
        (["--hazard-period", "0.5"], "--hazard-period of evidence must be left out"),
    ):
        assert main(["evidence", "--quick", "--out", out, *wrong]) == 2
        assert said in capsys.readouterr().err


def test_a_recorded_table_agrees_with_an_independent_study(shared: Path) -> None:
    """36 recorded components, light storage, one storey, R 3.25. Another study of the question, with own samples:
    share of mean drift 0.37 in [0.33, 0.42], of the rate of 2 % 0.33 in [0.26, 0.42] (90 % over stations).
    """
    suite = sm.read_suite(shared / "records" / "fema_p695_far_field")
    setting = replace(SETTING, levels=(0.3, 0.5, 0.75, 1.0, 1.5, 2.25, 3.3), samples=(4, 4))
    table = runs.solved_archetype(ARCHETYPES[1], setting, suite, redesign=False)
    hazard = sm.evidence.default_hazard()
    answer = definitions.answer_of(
        table, definitions.Question(setting, hazard, stations(suite), 200), convergence=False
    )
    assert 0.33 <= answer.shares["a_mean"].value <= 0.42
    assert 0.26 <= answer.shares["d"].value <= 0.42
