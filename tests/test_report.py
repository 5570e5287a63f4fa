"""The pages of a study and of a building: of the tables alone, without anything from outside, and true to them."""

from __future__ import annotations

import html
import json
import re
import shutil
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.cli import main
from seismass.commands.report import write_page
from seismass.effective_mass.rule import RULE
from seismass.media.roles import LAMBDA, lettered
from seismass.show.assessment.page import building_page
from seismass.show.study.answer import answer, assumptions, compared_rules, one_line, percent
from seismass.show.study.figures import slip_demand
from seismass.show.study.tables import completed
from seismass.show.study.write import write_study
from seismass.studies.study import StudyParameters, StudyResult, run_study
from seismass.studies.study.run import study_example
from seismass.studies.validation import validate

CHOSEN = StudyParameters(
    buildings=((2, 0.38), (3, 0.47)), response_modification=(1.0, 2.0, 6.0), mass_ratios=(0.5, 1.5)
)
SUITE = sm.builtin_suite("seven")


@pytest.fixture(scope="module")
def result() -> StudyResult:
    return run_study(SUITE, sm.TargetSpectrum.asce7(), CHOSEN, effective=True)


@pytest.fixture(scope="module")
def tables(result: StudyResult) -> StudyResult:
    return completed(result, validation=validate(SUITE, study=result), example=study_example(SUITE, CHOSEN, result))


@pytest.fixture(scope="module")
def folder(tables: StudyResult, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("study")
    write_study(tables, out)
    return out


def analysis_text(page: str) -> str:
    """What a reader sees, on one line."""
    body = re.sub(r"<(style|script|svg)\b.*?</\1>", " ", page, flags=re.DOTALL)
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", body)).split())


def test_page_is_made_again_from_the_tables_alone(folder: Path, tmp_path: Path) -> None:
    """A folder that holds only Parquet and JSON gives the same bytes."""
    for file in folder.iterdir():
        if file.suffix in (".parquet", ".json"):
            shutil.copy(file, tmp_path / file.name)
    assert main(["report", str(tmp_path)]) == 0
    assert (tmp_path / "report.html").read_bytes() == (folder / "report.html").read_bytes()


def test_page_needs_nothing_but_itself(folder: Path) -> None:
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert len(page.encode()) < 3_000_000
    assert "default-src 'none'" in page
    references = re.findall(r"""(?:src|href)\s*=\s*["']([^"']*)["']""", page)
    assert references
    assert all(reference.startswith(("#", "data:")) for reference in references)


def test_page_has_every_part(folder: Path) -> None:
    page = (folder / "report.html").read_text(encoding="utf-8")
    titles = re.findall(r"<h[23][^>]*>([^<]*)</h[23]>", page)
    assert titles == [
        "Contents",
        "Findings",
        "Underestimation",
        "Drift demands",
        "R = 1",
        "R = 2",
        "R = 6",
        "Effective fraction",
        "Slip of the goods",
        "Example",
        "Claims of the paper",
        "Ground motions",
        "Tables",
        "Drift of every storey",
        "Fractions of every building",
        "Slip of every building",
        "Validation",
        "Three storeys",
        "Shaking table",
        "Assumptions",
        "Provenance",
    ]
    # Fig. 1; Fig. 5 and the sliding by slope, Fig. 4; drifts; underestimation and heat map; fractions; slip.
    assert page.count("<figure") - page.count('class="animation') == 1 + 2 + 1 + 3 + 2 + 1 + 1
    assert page.count("<figure") == len(list(folder.glob("*.svg"))) + 1


def test_page_says_what_the_tables_say(folder: Path, result: StudyResult) -> None:
    text = analysis_text((folder / "report.html").read_text(encoding="utf-8"))
    worst = (
        result.summary.filter(pl.col("R") > 1.0, occupancy="storage")
        .sort("underestimation_percent")
        .row(-1, named=True)
    )
    largest = percent(worst["underestimation_percent"], sign="-").replace("\N{NO-BREAK SPACE}", " ")
    assert f"The largest underestimation of any storey is {largest}" in text
    assert result.metadata["inputs_sha256"] in text
    for sentence in assumptions(result.metadata):
        assert lettered(sentence) in text
    assert " ".join(one_line(result).split()) in text
    for motion in result.metadata["suite"]["motions"]:
        assert f"{motion['factor']:.4f}" in text


def test_answer_counts_first_storeys(result: StudyResult) -> None:
    first = result.summary.filter(pl.col("R") > 1.0, storey=1, occupancy="commercial")
    missed = first["underestimation_percent"].to_numpy()
    said = str(answer(result)[1])
    mean, least, most = (percent(float(each), sign="-") for each in (missed.mean(), missed.min(), missed.max()))
    assert f"in {int((missed > 0.0).sum())} of {len(missed)}: by {mean} on average" in said
    assert f"{least} to {most} in single buildings" in said


def frame(**columns: list[float]) -> pl.DataFrame:
    return pl.DataFrame({"lambda_analysis": [0.25] * len(columns["effective"]), **columns})


def test_rules_are_counted_by_hand() -> None:
    rules = {
        rule.name: rule
        for rule in compared_rules(frame(effective=[0.2, 0.5, 0.9, 1.0], estimate=[0.25, 0.36, 0.64, 1.0]))
    }
    # Short by more than 0.1: of the code 0.25, 0.65, 0.75; of the rule 0.14 and 0.26.
    assert [rules[name].short for name in ("code", RULE, "all, 1")] == [3, 2, 0]
    assert rules[RULE].most == pytest.approx(0.26, abs=1e-12)
    assert rules["all, 1"].mean == 1.0
    assert [rule.serves for rule in rules.values()] == [False, False, True]


def test_advice_is_the_least_rule_that_seldom_falls_short(result: StudyResult) -> None:
    fractions = result.fractions.with_columns(effective=pl.lit(0.0))
    said = str(answer(replace(result, frames=result.frames | {"fractions": fractions}))[-1])
    assert f"Attach <strong>{RULE}</strong>" in said
    fractions = result.fractions.with_columns(effective=pl.lit(1.0), estimate=pl.lit(0.1))
    said = str(answer(replace(result, frames=result.frames | {"fractions": fractions}))[-1])
    assert "Attach <strong>all, 1</strong>" in said
    count = result.fractions.height
    assert f"{RULE}: {count} of {count}" in said


def test_slip_of_a_building_is_that_of_its_worst_floor(result: StudyResult) -> None:
    demand = slip_demand(result.responses)
    assert demand.height == result.metadata["counts"]["buildings"]
    row = demand.filter(occupancy="storage", storeys=3, R=1.0, alpha=1.5).row(0, named=True)
    rows = result.responses.filter(
        pl.col("storey") < 3, model="real", occupancy="storage", storeys=3, R=1.0, alpha=1.5
    ).sort("motion", "storey")
    slip = rows["peak_slip"].to_numpy().reshape(7, 2)
    left = np.abs(rows["residual_slip"].to_numpy().reshape(7, 2))
    worst = slip.argmax(axis=1)
    assert row["mean"] == pytest.approx(slip.max(axis=1).mean(), rel=1e-14)
    assert row["largest"] == slip.max()
    assert row["residual"] == pytest.approx(left[np.arange(7), worst].mean(), rel=1e-14)
    assert (row["p16"], row["p84"]) == pytest.approx(np.quantile(slip.max(axis=1), (0.16, 0.84)), rel=1e-12)
    assert row["slides"] == 7


def test_example_is_the_building_of_the_table_under_its_motion(result: StudyResult) -> None:
    example = study_example(SUITE, CHOSEN, result)
    assert example is not None
    number = example.labels["building"]
    rows = result.responses.filter(building=number, model="real", record=example.name).sort("storey")
    run = sm.simulate(example.scene, example.record)
    np.testing.assert_array_equal(run.peak_drift, rows["peak_drift"].to_numpy())
    row = result.summary.filter(building=number, storey=1).row(0, named=True)
    assert row["R"] > 1.0
    assert row["mean_peak_slip"] >= 0.01


def test_tables_of_a_folder_are_those_of_the_study(folder: Path, tables: StudyResult) -> None:
    read = StudyResult.read(folder)
    assert read.to_dict() == json.loads(tables.to_json())
    assert read.text == tables.text
    assert read.figure_names == tables.figure_names
    assert read.animation == tables.animation
    for name, table in tables.tables.items():
        assert read.tables[name].equals(table), name


def test_page_of_a_study_of_several_frictions_without_validation(tmp_path: Path) -> None:
    chosen = StudyParameters(buildings=((1, 0.3),), response_modification=(1.0,), mass_ratios=(1.0,), mu=(0.2, 0.4))
    made = run_study(SUITE, sm.TargetSpectrum.asce7(), chosen)
    write_study(made, tmp_path)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Claims of the paper" not in page
    told: list[tuple[int, int]] = []
    write_page(tmp_path, tmp_path / "again.html", progress=lambda done, total: told.append((done, total)))
    assert told == [(number, told[0][1]) for number in range(told[0][1] + 1)]
    assert (tmp_path / "again.html").read_text(encoding="utf-8") == page


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda out: (out / "summary.parquet").unlink(),
            r"summary.parquet of folder .* must be there beside study.json",
        ),
        (lambda out: (out / "summary.parquet").write_bytes(b"x"), "content of summary.parquet must be a Parquet table"),
        (lambda out: (out / "study.json").write_text("{"), "content of study.json must be JSON"),
        (lambda out: (out / "study.json").write_text("[]"), "content of study.json must be a JSON object; got list"),
        (lambda out: (out / "study.json").write_text("{}"), "schema_version of study.json must be 5; got None"),
        (lambda out: (out / "study.json").unlink(), "No such file"),
    ],
)
def test_folder_that_is_no_study_is_refused(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], change: object, message: str
) -> None:
    out = tmp_path / "copy"
    shutil.copytree(folder, out)
    (out / "report.html").unlink()
    change(out)  # type: ignore[operator]
    assert main(["report", str(out), "--force"]) == 2
    assert re.search(message, capsys.readouterr().err)
    assert not (out / "report.html").exists()


@pytest.fixture(scope="module")
def building(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("building")
    assert main(["building", str(example_file()), "--out", str(out)]) == 0
    return out


def test_page_of_a_building_is_made_again_from_the_tables_alone(building: Path, tmp_path: Path) -> None:
    for file in building.iterdir():
        if file.suffix in (".parquet", ".json"):
            shutil.copy(file, tmp_path / file.name)
    assert main(["report", str(tmp_path)]) == 0
    page = (tmp_path / "report.html").read_bytes()
    assert page == (building / "report.html").read_bytes()
    assert len(page) < 3_000_000


def test_an_assessment_read_from_its_folder_is_the_one_that_was_written(building: Path, tmp_path: Path) -> None:
    read, solved = sm.Assessment.read(building), sm.assess(example_file())
    assert read.content == json.loads(solved.to_json())
    assert read.answer == solved.answer
    assert {name: one.equals(read.tables[name]) for name, one in solved.tables.items()} == dict.fromkeys(
        read.tables, True
    )
    for name, one in solved.effective.items():
        assert read.effective[name].to_dict() == one.to_dict()
        assert read.effective[name].curve.equals(one.curve)
        assert read.effective[name].records.equals(one.records)
        assert read.effective[name].text == one.text
    assert read.text == solved.text == (building / "assessment.txt").read_text(encoding="utf-8").removesuffix("\n")
    assert read._repr_html_() == solved._repr_html_()
    files = read.write(tmp_path / "again")
    kinds, of_the_command = (".html", ".json", ".csv"), ("explorer.html", "files.json")
    assert {file.name: file.read_bytes() for file in files if file.suffix in kinds and file.name != "files.json"} == {
        file.name: file.read_bytes()
        for file in building.iterdir()
        if file.suffix in kinds and file.name not in of_the_command
    }
    with pytest.raises(sm.errors.InvalidOption, match="must be one that was not read from a folder"):
        _ = read.building


def test_page_of_a_building_has_every_part_and_the_numbers_of_the_assessment(building: Path) -> None:
    page = (building / "report.html").read_text(encoding="utf-8")
    assert re.findall(r"<h2[^>]*>([^<]*)</h2>", page) == [
        "Contents",
        "Input as understood",
        "Effective fraction",
        "Drifts",
        "Slip of the goods",
        "In an analysis",
        "Checks",
        "Motions",
        "The building in motion",
        "Remarks",
        "Assumptions",
        "Limits of this page",
        "Provenance",
    ]
    text = analysis_text(page)
    document = json.loads((building / "assessment.json").read_text())
    # Symbols are letters on the page.
    for part in (*document["advice"], *document["assumptions"], document["metadata"]["inputs_sha256"]):
        assert lettered(part) in text
    # The answer that the README has for this building.
    readme = " ".join((Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8").split())
    pair = re.search(
        r"1 lambda = (\S+ of the goods present \(\S+ of the design live load\) as mass: .*?) 2 no goods", readme
    )
    as_stated = re.search(r"mu as stated gives [\d.]+ \[[\d.]+, [\d.]+\]", readme)
    assert pair is not None
    assert as_stated is not None
    assert f"Analysis 1: {LAMBDA} = {pair[1]}. Analysis 2: no goods: dead load alone." in text
    assert lettered(as_stated[0]) in text
    assert '<div class="answer">' in page


def test_checks_are_those_of_the_storeys(building: Path) -> None:
    checks = pl.read_parquet(building / "checks.parquet")
    storeys = pl.read_parquet(building / "storeys.parquet")
    for check, column in (("capped mean drift ratio", "mean"), ("stability coefficient", "theta")):
        for row in checks.filter(check=check).iter_rows(named=True):
            of = storeys.filter(model=row["model"])
            assert row["value"] == of[column].max()
            assert row["met"] == (row["value"] <= row["limit"])
    assert set(checks["model"]) == {"real", "real_mu_low", "real_mu_high", "advised", "bare"}
    assert "table 12.12-1" in checks.filter(check="capped mean drift ratio")["source"][0]


def test_checks_that_fail_are_said_first() -> None:
    given = tomllib.loads(example_file().read_text(encoding="utf-8"))
    given["building"]["drift_limit"] = 0.005
    result = sm.assess(given, list(SUITE)[:3], mu_factors=(1.0, 1.0), resamples=2)
    page, failed = building_page(result, {}), result.checks.filter(met=False)
    assert failed.height > 0
    use = result.checks.filter(check="capped mean drift ratio")["value"].max() / 0.005
    assert use > 1.0
    assert f"Storey drift uses {100.0 * use:.0f} % of its limit" in analysis_text(page)
    assert '<div class="answer bad">' in page


def test_page_of_a_building_without_heights_and_goods(tmp_path: Path) -> None:
    given = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.4, "area_m2": 500.0, "dead_load_kpa": 5.0, "design": True, "R": 3.0},
        "goods": {"live_load_kpa": 0.0},
        "storeys": [{}, {}],
    }
    sm.assess(given, resamples=100).write(tmp_path)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "no live load could act as mass" in page
    assert "Slip of the goods" not in page
    again = tmp_path / "again.html"
    assert main(["report", str(tmp_path), "--out", str(again)]) == 0
    assert again.read_text(encoding="utf-8") == page


@pytest.mark.parametrize(
    ("further", "words", "animated"),
    [
        (
            {"base": {"mu_s": 0.08, "mu_k": 0.06, "radius_m": 2.5}},
            ["Sliding base", "it stands on a sliding base"],
            True,
        ),
        ({"other_direction": {"period_s": 0.7}}, ["Other direction, y", "it moves in two directions"], False),
    ],
)
def test_page_of_a_building_that_the_live_page_does_not_show(
    tmp_path: Path, further: dict[str, object], words: list[str], animated: bool
) -> None:
    given = {
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.4, "area_m2": 500.0, "dead_load_kpa": 5.0, "design": True, "R": 3.0},
        "goods": {"live_load_kpa": 6.0, "mu_s": 0.2, "mu_k": 0.15},
        "storeys": [{}, {"live_load_kpa": 0.0}],
        **further,
    }
    pairs = [
        sm.records.Pair(*(one.with_duration(10.0) for one in pair)) for pair in list(sm.records.builtin_pairs())[:3]
    ]
    few = pairs if "other_direction" in further else [pair.first for pair in pairs]
    sm.assess(given, few, mu_factors=(1.0, 1.0), resamples=2).write(tmp_path)
    text = analysis_text((tmp_path / "report.html").read_text(encoding="utf-8"))
    for said in (*words, "The live page cannot show this building", "Spectra of the motions"):
        assert said in text
    assert (tmp_path / "animation.json").exists() == animated
    assert ("the slab slides by up to" in text) == animated
