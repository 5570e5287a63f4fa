"""Every sentence of page, sheet, terminal and figure against the result that it speaks of: results of every kind, and
made of solved ones with other drifts and other collapses. What the statement says is in test_statement.py.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.advice import advice_of
from seismass.assessment.answer import answer_of
from seismass.assessment.checks import checked_storeys, collapses_of, governing_table, left_out_table
from seismass.assessment.result import assessment_of
from seismass.assessment.statement import present_goods
from seismass.base.statistics import few_collapses
from seismass.base.units import FOOT, INCH, KIP
from seismass.media.roles import lettered
from seismass.show.assessment.figures import assessment_figure
from seismass.show.assessment.page import building_page
from seismass.show.assessment.sheet import sheet_html

TWO_STOREYS: dict[str, Any] = json.loads(
    Path(__file__).with_name("data").joinpath("two_storeys.json").read_text("utf-8")
)
FEW = list(sm.builtin_suite("forty"))[:3]
SLIDING_ALL = ("real", "real_mu_low", "real_mu_high")
US = {
    "building": {
        **{key: TWO_STOREYS["building"][key] for key in TWO_STOREYS["building"] if key[:4] in ("peri", "desi", "R")},
        "height": 13.0,
        "area": 5400.0,
        "dead_load": 104.0,
    },
    "goods": {"live_load": 125.0, "mu": 0.2},
}
KINDS: dict[str, dict[str, Any]] = {
    "plain": {},
    "walls": {"walls": {"alpha_h": 2.0}},
    "racks": {"goods": {"on_racks": {"period_s": 0.8}}},
    "stops": {"goods": {"stops": {"clearance_m": 0.03}}},
    "base": {"base": {"mu": 0.1, "radius_m": 2.0}},
    "two directions": {"other_direction": {"period_s": 0.5}},
    "collapse": {"building": {"collapse_drift_ratio": 0.004}},
    "no goods": {"goods": {"live_load_kpa": 0.0}},
    "slippery": {"goods": {"mu": 0.005}},
    "rough": {"goods": {"mu": 1.4}},
    "US units": US,
    "one storey": {"storeys": [{}]},
    "twelve storeys": {"building": {"period_s": 1.6}, "storeys": [{"name": f"deck {n}"} for n in range(12)]},
    "tipping": {"goods": {"width_m": 0.5, "height_m": 1.2, "mu": 0.6}},
    "bolted": {"storeys": [{"goods": [{"share": 0.4, "attached": True}, {"share": 0.6}]}, {"live_load_kpa": 0.0}]},
    "no heights": {"building": {"height_m": None}},
    "no bounds": {"goods": {"mu_factors": [1.0, 1.0]}},
}


@cache
def solved(kind: str) -> sm.Assessment:
    """A result of a kind, under four motions."""
    given = {name: dict(value) if isinstance(value, dict) else value for name, value in TWO_STOREYS.items()}
    for name, value in KINDS[kind].items():
        given[name] = {**given.get(name, {}), **value} if isinstance(value, dict) and kind != "US units" else value
    if kind == "US units":
        given["units"] = "us"
    for name in ("building", "goods"):
        given[name] = {key: value for key, value in given[name].items() if value is not None}
    if "mu" in given["goods"]:
        given["goods"].pop("friction", None)
    motions: Any = list(sm.records.builtin_pairs())[:3] if kind == "two directions" else FEW
    return sm.assess(given, motions, resamples=2)


def changed(result: sm.Assessment, seed: int) -> sm.Assessment:
    """A result with other drifts and collapses: all that is made of its runs is made again of the changed ones."""
    draw, building = np.random.default_rng(seed), result.building
    models = result.runs["model"].unique(maintain_order=True).to_list()
    factors = {model: float(draw.choice([0.2, 0.9, 1.0, 1.02, 1.6, 3.0])) for model in models}
    share = draw.choice([0.0, 0.0, 0.1, 0.5])
    fallen = {
        (model, n) for model in models for n in range(1, len(result.suite["motions"]) + 1) if draw.random() < share
    }
    if result.advised is None:
        fallen |= {("real", n) for n in range(1, 3)}
    keys = zip(result.runs["model"], result.runs["motion"], strict=True)
    factor = pl.Series([factors[model] for model in result.runs["model"]])
    runs = result.runs.with_columns(
        pl.Series("collapsed", [key in fallen for key in keys]),
        *(pl.col(name) * factor for name in ("peak_drift", "peak_drift_ratio")),
    )
    scene = building.scene(result.target)
    storeys, collapses = checked_storeys(building, scene, runs), collapses_of(runs)
    governing = governing_table(building, storeys)
    left_out = left_out_table(building, runs, result.effective, {"record": result.suite["motions"]})
    advised = result.advised
    amounts = ()
    if advised is not None:
        amounts = (present_goods("floors as taken", building, advised, governing["governing"].to_numpy()),)
    answer = answer_of(
        building,
        advised,
        result.effective,
        None,
        storeys,
        governing,
        runs,
        left_out,
        collapses,
        result.slip,
        amounts,
        (result.tipping, ()),
        result.suite,
        result.scaling,
        (),
        lambda: "With strengths 2 times as large there is an answer: models collapse under none of the motions",
    )
    motions = len(result.suite["motions"])
    effective = result.effective.get("real")
    parts = (building, answer, storeys, result.slip, collapses, motions, effective, runs)
    tables = {name: getattr(result, name) for name in ("slip", "tipping", "slips", "spectra")}
    tables |= {"storeys": storeys, "governing": governing, "runs": runs, "left_out": left_out}
    facts = {name: getattr(result, name) for name in ("suite", "remarks", "assumptions", "metadata")}
    assert result.solved is not None
    return assessment_of(
        result.solved, answer, result.effective, tables, collapses=collapses, advice=advice_of(*parts), **facts
    )


def plain(html: str) -> str:
    """The words of a page."""
    return " ".join(re.sub(r"<[^>]*>", " ", re.sub(r"(?s)<(style|script|title)\b.*?</\1>", " ", html)).split())


def check(result: sm.Assessment) -> set[str]:
    """Compare what is said with the numbers, each computed again here; return what was said, by its kind."""
    page, sheet = plain(building_page(result, {})), plain(str(sheet_html(result)))
    text = " ".join(result.text.split())
    kinds = {*_checks(result, sheet, page), *_analyses(result, sheet, page, text), *_storeys(result, text)}
    kinds |= _answer(result, sheet, page, text)
    _units(result, page, text)
    body, _, listed = sheet.partition("References.")
    numbers = re.findall(r"\[\d\]", listed)
    assert sorted(set(numbers)) == numbers == sorted(set(re.findall(r"\[\d\]", body)))
    assert set(re.findall(r"\d(?: of the design live load)? (\[\d\])", body)) == set(numbers), "beside its number"
    assert not re.search(r"\bnan\b|\bNone\b|\binf\b", f"{page} {text}".replace("None.", ""))
    return kinds


def _checks(result: sm.Assessment, sheet: str, page: str) -> set[str]:
    """Uses of limits, collapses, and why a value is missing."""
    building, kinds = result.building, set()
    means = result.storeys.filter(pl.col("model").is_in([*SLIDING_ALL, "advised", "bare"]))
    motions, walls = len(result.suite["motions"]), building.walls is not None
    fallen = max(count for model, count in result.collapses.items() if model not in ("code", "attached"))
    collapse = f"uns collapse under up to {fallen} of {motions} motions" if fallen else "no run collapses"
    assert collapse in sheet or collapse.capitalize() in sheet
    assert ("no run collapses" in sheet.lower()) == (fallen == 0)
    if building.heights is not None:
        use = float(means["mean"].max()) / building.drift_limit  # type: ignore[arg-type]
        assert f"torey drift uses {100.0 * use:.0f} % of its limit" in sheet
        assert ("not defined beside walls" in sheet) == ("not defined beside walls" in page) == walls
        assert ("a drift is above the limit" in sheet) == bool(result.storeys["motions_above_limit"].max())
        if not walls:
            theta = float(means["theta"].max())  # type: ignore[arg-type]
            assert f"stability P d/(V h) uses {100.0 * theta / building.theta_limit:.0f} % of its limit" in sheet
        kinds.add("above" if use > 1.0 else "within")
    half = any(result.storeys.filter(model=model)["mean_by_code"].null_count() for model in means["model"].unique())
    assert ("half of the runs collapse, or more" in page) == (half and building.heights is not None)
    return kinds | ({"walls"} if walls else set())


def _analyses(result: sm.Assessment, sheet: str, page: str, text: str) -> set[str]:
    """One analysis or two, and the drift with goods that slide beside them."""
    advised = result.advised
    if advised is None:
        assert "two analyses; " not in text
        return set()
    single = advised == 0.0
    assert ("one analysis, since" in text) == single
    assert ("two analyses; " in text) == (not single)
    governing = result.governing
    larger = governing.select(pl.max_horizontal("advised", "bare")).to_series()
    excess = float((governing["sliding"] / larger).max())  # type: ignore[arg-type]
    slides = governing["governed_by"].str.starts_with("goods slide").any()
    what = "its own" if single else "the larger of both"
    assert (f"goods that slide drift up to {excess:.2f} times {what}, and that drift counts" in text) == slides
    for said in (sheet, page, text):
        assert (re.search(r"(?<!the )analysis 2", said.lower()) is not None) == (not single), said
    if single:
        assert "the analysis" in sheet.lower()
    return {"single" if single else "pair", "sliding counts" if slides else "covered"}


def _storeys(result: sm.Assessment, text: str) -> set[str]:
    """Rows of storeys of the terminal: use of the limit, slip, what governs, marks in the order of their drifts."""
    building, units = result.building, result.building.shown
    for row in result.governing.iter_rows(named=True):
        label = re.escape(f"{row['storey']} {row['name']}".strip())
        found = re.search(rf"(?:^| ){label} \|([^ ]+)\| ([\d.]+) (%|mm|in)( slip [\d.]+)?", text)
        assert found is not None, label
        if building.heights is None:
            assert found[2] == units.number("drift", row["governing"])
            continue
        assert found[2] == f"{100.0 * row['governing'] / building.drift_limit:.0f}"
        limit = found[1].find("|")
        if limit >= 0:  # no mark stands on it
            beyond, cell = set(found[1][limit + 1 :]) - {".", "-"}, building.drift_limit / (limit + 0.5)
            assert row["governing"] < building.drift_limit + 1.5 * cell or beyond
            assert row["governing"] > building.drift_limit or beyond <= {"c"}
    return set()


def _answer(result: sm.Assessment, sheet: str, page: str, text: str) -> set[str]:
    """An answer, or why there is none and what would give one; no fraction without one."""
    motions = len(result.suite["motions"])
    models = [*SLIDING_ALL, "advised", "bare"]
    many = any(not few_collapses(result.collapses.get(model, 0), motions) for model in models)
    assert (result.answer.reason is not None) == (many or not result.effective)
    if result.answer.reason is None:
        assert "Analysis 1: λ" in sheet or "The analysis: λ" in sheet
        assert "effective_fraction" in result.figure_names
        return {"answer"}
    assert f"No answer, because {lettered(result.answer.reason)}." in sheet
    assert f"No answer, because {result.answer.reason}." in text
    assert lettered(result.answer.remedy) in sheet
    assert "effective_fraction" not in result.figure_names
    if not result.effective:
        assert "There are no goods on the floors." in page
        return {"no goods"}
    assert f"There is none, because {lettered(result.answer.reason)}." in page
    for (model,), runs in result.runs.group_by("model"):
        fallen = sorted(set(runs.filter("collapsed")["motion"]))
        if fallen:
            row = f"{len(fallen)} of {motions} {', '.join(map(str, fallen))}"
            assert row in sheet, model
    return {"collapse"}


def _units(result: sm.Assessment, page: str, text: str) -> None:
    """The units of the file alone, but for weights, which have both once."""
    own, other = r"\d (?:kN|mm|kPa|t|m/s)\b", r"\d (?:kip|psf|in|ft|in/s)\b"
    if result.building.units == "us":
        own, other = other, own
    assert not re.search(other, text.replace("in a ", ""))
    told = re.sub(r"\([\d.]+ (?:kN|kip)\)|1 psf is 0.0479 kPa|\d in (?:the|all|a|both|[xy])\b", "", page)
    assert not re.search(other, told), re.search(rf".{{60}}{other}", told)
    weight = result.building.weight
    both = f"{weight / KIP:.0f} kip ({1e-3 * weight:.0f} kN)"
    assert (both in page) == (result.building.units == "us")


EXPECTED = {"above", "within", "walls", "single", "pair", "sliding counts", "covered", "answer", "no goods", "collapse"}


def test_sentences_of_results_of_every_kind() -> None:
    found = {kind: check(solved(kind)) for kind in KINDS}
    assert set().union(*found.values()) >= EXPECTED - {"sliding counts"}
    assert "walls" in found["walls"]
    assert "single" in found["slippery"]
    assert found["collapse"] >= {"collapse"}
    assert found["no goods"] >= {"no goods"}


def test_sentences_of_changed_results() -> None:
    kinds = [kind for kind in KINDS if kind != "no goods"]
    found = [check(changed(solved(kind), seed)) for seed, kind in enumerate(2 * kinds)]
    assert set().union(*found) >= EXPECTED - {"no goods"}


def test_sentences_of_hundreds_of_changed_results() -> None:
    """The slow tier."""
    found = [check(changed(solved(kind), seed)) for kind in KINDS for seed in range(100, 124)]
    assert set().union(*found) == EXPECTED


@pytest.mark.parametrize("kind", ["plain", "stops", "base", "collapse", "no heights", "US units", "no goods"])
def test_titles_of_the_figure_are_of_its_numbers(kind: str) -> None:
    """The storey that uses most of its limit, and the floor whose goods slip most; allowance and clearance as drawn."""
    result = solved(kind)
    units, panels = result.building.shown, assessment_figure(result, "drift").axes
    row = result.governing.sort("governing").row(-1, named=True)
    title = " ".join(panels[0].get_title(loc="left").split())
    used = f"drifts most, {units.text('drift', row['governing'])}"
    if result.building.heights is not None:
        used = f"uses {100.0 * row['governing'] / result.building.drift_limit:.0f} % of its drift limit"
    assert title.startswith(f"Storey {row['storey']} {used}")
    assert title.endswith("; no answer") == (result.answer.reason is not None and kind != "no goods")
    assert len(panels) == 1 + (kind != "no goods")
    if kind != "no goods":
        slip = result.slip.sort("peak_p84").row(-1, named=True)
        said = " ".join(panels[1].get_title(loc="left").split())
        assert said == f"Allow for {units.text('slip', slip['peak_p84'])} of slip on floor {slip['floor']}"
        texts = [text.get_text() for text in panels[1].texts]
        assert any("clearance 30" in text for text in texts) == (kind == "stops")


def test_units_are_those_of_the_file_or_as_asked_for() -> None:
    """Feet and inches of the definition: 13 ft, 104 psf; forces by 4448.2 N."""
    result = solved("US units")
    building = result.building
    assert building.units == "us"
    assert building.heights == pytest.approx([13.0 * FOOT] * building.storeys, rel=1e-12)
    assert sm.read_building(TWO_STOREYS).units == "si"
    keys = {**TWO_STOREYS, "building": {**TWO_STOREYS["building"], "height_ft": 13.0}}
    keys["building"].pop("height_m")
    assert sm.read_building(keys).units == "us"
    table = result.tables["analysis"]
    assert table["weight_2_kip"].to_numpy() * KIP == pytest.approx(9.80665 * building.mass, rel=1e-12)
    assert table["mass_2_kip_s2_per_ft"].to_numpy() * KIP / FOOT == pytest.approx(building.mass, rel=1e-12)
    floor, row = next((row["floor"], row) for row in result.slip.sort("peak_p84").to_dicts()[::-1])
    assert f"{row['peak_p84'] / INCH:.1f} in" in result.text
    assert f"on floor {floor}" in result.text
    others = replace(result, content=result.content | {"input": result.input | {"units": "si"}})
    assert f"slip {1e3 * row['peak_p84']:.0f} mm" in " ".join(others.text.split())


def test_order_of_places_is_that_of_drifts() -> None:
    """Marks of the terminal stand in the order of what they stand for."""
    result = solved("twelve storeys")
    rows = [line for line in result.text.splitlines() if re.match(r" +\d+ deck \d+ +\|", line)]
    numbers = [int(line.split()[0]) for line in rows]
    assert numbers == sorted(numbers, reverse=True)
    assert len(numbers) == 12
    assert all(one > other for one, other in pairwise(numbers))


@pytest.mark.parametrize("rule", ["asce7-10", "asce7-16", "ec8", "nzs1170.5"])
def test_the_sheet_names_the_rule_that_scaled_the_motions(rule: str) -> None:
    """Not one rule's words for all: Eurocode 8 asks for 0.9 of the target, NZS for two factors."""
    tables = {**TWO_STOREYS, "code": {**TWO_STOREYS.get("code", {}), "scaling": rule}}
    result = sm.assess(tables, sm.builtin_suite("eleven"), resamples=2)
    (line,) = (line for line in result.assumptions if line.startswith("Scaling: "))
    text = plain(str(sheet_html(result)))
    assert plain(lettered(f"2 Motions: {line.removeprefix('Scaling: ')}")) in text
    words = {"ec8": "0.9 of the target", "nzs1170.5": "k_1 of each record and k_2 of the family"}
    assert words.get(rule, "mean not below") in text
