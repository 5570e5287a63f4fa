"""The answer in plain words: every number and every "if" of its sentences against the tables, over made-up results and
over assessments of random buildings; and the answer with other amounts of goods against an assessment of them.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.checks import friction_words, governing_table
from seismass.assessment.statement import PresentGoods, collapsing, other_amounts, present_goods, statement_of
from seismass.base.statistics import bootstrap_counts, quantile_interval
from seismass.media.roles import sentence_html
from seismass.show.assessment.page import building_page

TWO_STOREYS = Path(__file__).with_name("data") / "two_storeys.json"
"""A building file: two storeys with goods on the first, that slide under the built-in suite."""
SLIDING_ALL = ("real", "real_mu_high", "real_mu_low")
SURVEYED = 3.5 + np.sqrt(2.5**2 + 6.9**2 * 100.0 / 500.0)
FEW = list(sm.builtin_suite("forty"))[:3]
SUPPORTS: tuple[dict[str, Any], ...] = (
    {},
    {"goods": {"stops": {"clearance_m": 0.05}}},
    {"goods": {"on_racks": {"period_s": 0.8}}},
    {"base": {"mu": 0.2}},
    {"walls": {"alpha_h": 2.0}},
)


def tables(**changes: Any) -> dict[str, Any]:
    """Two storeys with goods on the first; values of tables added."""
    found: dict[str, Any] = json.loads(TWO_STOREYS.read_text(encoding="utf-8"))
    for table, values in changes.items():
        found[table] = {**found.get(table, {}), **values} if isinstance(values, dict) else values
    return found


BUILDINGS = [sm.read_building(tables(**support)) for support in SUPPORTS]


def made_up(seed: int) -> SimpleNamespace:
    """A result of random drifts, slips, collapses and amounts, of every kind."""
    draw = np.random.default_rng(seed)
    building = BUILDINGS[int(draw.integers(len(BUILDINGS)))]
    reals = SLIDING_ALL if draw.random() < 0.8 else SLIDING_ALL[:1]
    motions = int(draw.integers(3, 45))
    spread = draw.choice([0.0, 0.002, 0.05, 0.5])  # by which models differ
    attached = 0.04 * draw.random(2) + 0.001
    means = {name: attached * (1.0 - spread * (draw.random(2) - 0.2 * (draw.random() < 0.3))) for name in reals}
    means |= {"advised": attached * (1.0 - spread * draw.random(2)), "attached": attached}
    means |= {"bare": attached * (1.0 - 2.0 * spread * draw.random(2) * (draw.random() < 0.8))}
    rows = [
        {"model": model, "storey": storey, "name": "", "unit": "ratio", "limit": 0.02, "mean": float(mean[storey - 1])}
        for model, mean in means.items()
        for storey in (1, 2)
    ]
    storeys = pl.DataFrame(rows, schema_overrides={"storey": pl.UInt32})
    governing = governing_table(building, storeys)
    slides = int(draw.integers(motions + 1)) * int(draw.random() < 0.8)
    most = float(draw.choice([0.002, 0.05, 0.8])) * draw.random() * bool(slides)
    slip = pl.DataFrame(
        [
            {"model": name, "motions_that_slide": slides, "peak_p84": most * draw.random(), "peak_max": most}
            for name in reals
        ]
    )
    collapses = {name: int(draw.integers(3)) * int(draw.random() < 0.3) for name in means}
    beyond = [1.3] * 4 * (building in BUILDINGS[1:3])
    advised = float(draw.choice([0.0, 0.05, 0.45, 0.8, 1.0, 1.0, *beyond]))
    first = present_goods("floors as expected", building, advised, governing["governing"].to_numpy())
    further = [
        PresentGoods("full floors", 1.0, 0.9, 1, float(first.drift or 0.0) * draw.uniform(0.5, 2.0), 0.02),
        PresentGoods("full floors", 1.0, reason="runs collapse"),
    ]
    amounts = (first, *further[int(draw.integers(2)) :][: int(draw.integers(2))])
    friction = str(draw.choice(reals))
    statement = statement_of(
        building, friction, (storeys, governing, slip), collapses, motions, amounts, tipping=pl.DataFrame()
    )
    return SimpleNamespace(**{name: value for name, value in locals().items() if name not in ("draw", "rows")})


def of_assessment(result: sm.Assessment) -> SimpleNamespace:
    """What is checked, of an assessment with an answer."""
    assert result.advised is not None
    return SimpleNamespace(
        building=result.building,
        reals=[name for name in SLIDING_ALL if name in result.collapses],
        motions=len(result.suite["motions"]),
        storeys=result.storeys,
        governing=result.governing,
        slip=result.slip,
        collapses=result.collapses,
        advised=result.advised,
        amounts=result.answer.amounts,
        friction=max(result.effective, key=lambda name: result.effective[name].value),
        statement=result.answer.statement,
    )


def supports_of(building: Any) -> set[str]:
    """What a building has that may keep a pair of analyses from covering it."""
    has = {
        "racks": any(kind.rack is not None for kind in building.kinds),
        "stops": any(kind.stops is not None for kind in building.kinds),
        "walls": building.walls is not None,
        "a sliding base": building.base is not None,
    }
    return {name for name, there in has.items() if there}


def check(of: SimpleNamespace) -> str:
    """Compare a statement with its numbers, each computed again here; return the kind of its second sentence."""
    said, words = of.statement, friction_words(of.building.mu_factors)
    assert said.endswith(".")
    mean = {model: rows["mean"].to_numpy() for (model,), rows in of.storeys.group_by("model", maintain_order=True)}
    # No pair covers: first, and with what the building has.
    ratios = {name: mean[name] / np.maximum(mean["advised"], mean["bare"]) for name in of.reals}
    worst = max(float(ratio.max()) for ratio in ratios.values())
    what = "analysis" if of.advised == 0.0 else "pair of analyses"
    assert said.startswith(f"No {what} covers this building") == (worst > 1.05)
    if worst > 1.05:
        name, storey, ratio = re.search(r"\((mu[^)]*)\) storey (\d+) drifts ([\d.]+) times", said).groups()  # type: ignore[union-attr]
        model = next(model for model, text in words.items() if text == name)
        assert f"{ratios[model][int(storey) - 1]:.2f}" == ratio == f"{worst:.2f}"
        has = {"stops": "stops", "racks": "racks", "walls": "walls", "a sliding base": "base"}
        found = re.search(r"building with (.*?):", said)
        assert (found is not None) == (
            of.building not in (BUILDINGS[0],) if of.building in BUILDINGS else found is not None
        )
        assert found is None or set(found[1].split(" and ")) <= set(has)
    # The share: whether it matters, what sliding does, what to count.
    spread = [mean[name] for name in (*of.reals, "attached", "bare")]
    change = float((np.max(spread, axis=0) / np.min(spread, axis=0) - 1.0).max())
    assert ("The share does not matter" in said) == (change <= 0.01)
    kind = "no matter"
    if change <= 0.01:
        assert float(re.search(r"by more than ([\d.e-]+) %", said)[1]) == pytest.approx(  # type: ignore[index]
            100.0 * max(change, 1e-4), rel=0.05
        )
    else:
        kind = _count(of, said, mean, words)
    # The limit, here and with other amounts of goods.
    first, *others = of.amounts
    largest = of.governing["governing"].to_numpy()
    assert first.drift == pytest.approx(largest.max(), rel=1e-12)
    if first.limit is not None:
        met = re.search(r"The drift limit is (not met|met): storey (\d+), ([\d.]+) % of ([\d.]+) %", said)
        assert met is not None
        assert (met[1] == "met") == (largest.max() <= of.building.drift_limit)
        assert int(met[2]) == int(np.argmax(largest)) + 1
        assert met[3] == f"{100.0 * largest.max():.2f}"
        for other in others:
            differs = other.drift is None or (other.drift <= other.limit) != (first.drift <= first.limit)
            assert (f"with {other.floors} " in said) == differs
            if differs:
                told = "there is no answer"
                if other.drift is not None:
                    told = f"it is {'not ' * (other.drift > other.limit)}met: {100.0 * other.drift:.2f} % of"
                assert f"with {other.floors} {told}" in said
    # Collapses: each model that collapses, and no other.
    _collapses(of, said, words)
    return kind


def _count(of: SimpleNamespace, said: str, mean: dict[str, Any], words: dict[str, str]) -> str:
    """What sliding does to the storey that governs, and how much to count."""
    storey = int(np.argmax(of.governing["governing"].to_numpy()))
    at = f" with {words[of.friction]}" if len(of.reals) > 1 else ""
    own = of.slip.filter(model=of.friction)
    slides, p84, most = (float(own[name].max()) for name in ("motions_that_slide", "peak_p84", "peak_max"))
    share = {0.0: "none of the goods as mass", 1.0: "all goods that are there as mass"}
    wanted = share.get(of.advised, f"{of.advised:.2f} of the goods that are there as mass")
    assert f"count {wanted}." in said
    effects = []
    for name in (of.friction, "real"):
        part = mean[name][storey] / mean["attached"][storey] - 1.0
        drift = f"the drift that storey {storey + 1} has with all goods attached"
        word = f"takes {-100.0 * part:.0f} % off {drift}" if part < 0.0 else f"adds {100.0 * part:.0f} % to {drift}"
        effects.append((part, word if abs(part) >= 0.005 else f"changes {drift} by less than 0.5 %"))
    if of.advised > 1.0:
        assert f"Goods load this building more{at} than all of them attached would: " in said
        return "beyond"
    if of.advised < 1.0:
        assert f"Sliding{at} {effects[0][1]}" in said
        assert ("with mu as stated it" in said) == (round(100.0 * effects[0][0]) != round(100.0 * effects[1][0]))
        return "none" if of.advised == 0.0 else "part"
    assert ("friction gives nothing" in said) == (effects[0][0] >= -0.05)
    assert ("no smaller share is enough" in said) == (effects[0][0] < -0.05)
    slid = f"(in {slides:.0f} of {of.motions} motions{at}, {1e3 * p84:.1f} mm at 84 %, {1e3 * most:.1f} mm at most)"
    if slides == 0.0:
        assert f"No goods slide under any of the {of.motions} motions{at}: " in said
        return "stuck"
    if p84 <= 0.010:
        assert f"Goods hardly slide {slid}: " in said
        return "hardly"
    assert f"Goods slide {slid}, which {effects[0][1]}: " in said
    return "slide"


def _collapses(of: SimpleNamespace, said: str, words: dict[str, str]) -> None:
    worst = max(of.collapses[name] for name in of.reals)
    assert f"{of.motions} runs each some collapse" in said or not worst
    told = re.search(r"goods that slide \((mu[^)]*)\) under (\d+)", said)
    assert (told is not None) == (worst > 0)
    if told is not None:
        assert int(told[2]) == worst == of.collapses[next(name for name, text in words.items() if text == told[1])]
    pair = {"analysis 1": "advised", "analysis 2": "bare"} if of.advised else {"the analysis": "bare"}
    for name, model in pair.items():
        count = of.collapses[model]
        assert (f"{name} under {count}" in said) == (count > 0)


KINDS = {"no matter", "beyond", "none", "part", "stuck", "hardly", "slide"}


def test_sentences_are_true_of_their_numbers() -> None:
    assert {check(made_up(seed)) for seed in range(60)} == KINDS


def test_sentences_are_true_of_their_numbers_in_hundreds_of_results() -> None:
    """The slow tier."""
    assert {check(made_up(seed)) for seed in range(60, 800)} == KINDS


def random_building(seed: int) -> dict[str, Any]:
    """A building of one to three storeys with random strength, period, friction and load."""
    draw = np.random.default_rng(seed)
    storeys: list[dict[str, Any]] = [{} for _ in range(int(draw.integers(1, 4)))]
    if len(storeys) > 1:
        storeys[-1] = {"live_load_kpa": 0.0}
    goods = {"live_load_kpa": float(draw.uniform(2.0, 12.0)), "mu": float(draw.choice([0.03, 0.1, 0.2, 0.4, 5.0]))}
    goods["occupied"] = float(draw.choice([0.3, 0.7, 1.0]))
    building = {"period_s": float(draw.uniform(0.15, 1.2)), "R": float(draw.choice([1.0, 2.0, 4.0, 6.0]))}
    support = SUPPORTS[int(draw.integers(3))] if draw.random() < 0.3 else {}
    return tables(building=building, goods={**goods, **support.get("goods", {})}, storeys=storeys)


def check_assessment(result: sm.Assessment) -> str:
    """Text, JSON, page and card have the statement; it is true of the tables, or says why there is no answer."""
    answer = result.answer
    document = json.loads(result.to_json())
    assert document["statement"] == answer.statement
    assert answer.statement in " ".join(result.text.split())
    if answer.reason is not None:
        assert answer.statement.startswith(f"No answer, because {answer.reason}.")
        assert answer.remedy in answer.statement
        return "no answer"
    assert document["answer"]["goods"] == list(answer.goods)
    assert all(" ".join(line.split()) in " ".join(result.text.split()) for line in answer.goods)
    return check(of_assessment(result))


def test_statements_of_assessments() -> None:
    for seed in range(6):
        check_assessment(sm.assess(random_building(seed), FEW, resamples=2))


def test_statements_of_a_hundred_assessments() -> None:
    """The slow tier."""
    kinds = {check_assessment(sm.assess(random_building(seed), FEW, resamples=2)) for seed in range(6, 106)}
    assert kinds >= {"no answer", "none", "part", "stuck", "slide"}


def test_no_answer_says_why_and_which_model_collapses() -> None:
    none = sm.assess(tables(goods={"live_load_kpa": 0.0}), FEW)
    assert none.answer.statement == (
        "No answer, because there are no goods on the floors, and no live load could act as mass."
    )
    weak = sm.assess(tables(building={"collapse_drift_ratio": 0.001}), FEW, resamples=2)
    assert weak.answer.statement.startswith("No answer, because the building with goods that slide (mu as stated) coll")
    building = BUILDINGS[0]
    assert collapsing(building, {"bare": 2}, 40) == "Of 40 runs each some collapse: the building under 2"
    assert collapsing(building, {"real": 0, "real_mu_high": 0, "real_mu_low": 0, "advised": 0, "bare": 0}, 40) == ""
    some = {"real": 1, "real_mu_high": 3, "real_mu_low": 0, "advised": 2, "bare": 0, "code": 4}
    assert collapsing(building, some, 40) == (
        "Of 40 runs each some collapse: the building with goods that slide (mu x 1.5) under 3, analysis 1 under 2"
    )


def test_amounts_are_those_of_assessments_of_so_much() -> None:
    """Share, storey and drift of the second row are what the file with that share present gives."""
    for goods, floors, share in (
        ({"occupied": 0.6}, "full floors", 1.0),
        # Mean 3.5 kPa of 12, and one standard deviation of a floor of 500 m2 more.
        ({"occupied": None, "occupancy": "storage, sustained", "live_load_kpa": 12.0}, "full floors", SURVEYED / 12.0),
        ({"occupied": None}, "floors as expected", 3.5 / 6.0),
    ):
        given = tables(goods=goods)
        given["goods"] = {key: value for key, value in given["goods"].items() if value is not None}
        result = sm.assess(given, FEW, resamples=2)
        first, other = result.answer.amounts
        assert first.advised == result.advised
        assert first.present == pytest.approx(result.building.present_share, rel=1e-12)
        assert other.floors == floors
        assert other.present == pytest.approx(share, rel=1e-12)
        given["goods"] = {**given["goods"], "occupied": other.present}
        given["goods"].pop("occupancy", None)
        again = sm.assess(given, FEW, resamples=2)
        assert again.answer.amounts[0].advised == other.advised
        assert again.answer.amounts[0].storey == other.storey
        # Drifts of equal digits are one; that of the first analysis is interpolated between shares 0.05 apart.
        assert again.answer.amounts[0].drift == pytest.approx(other.drift, rel=0.01)


def test_amounts_of_kinds_of_goods() -> None:
    """Bolted goods stay, and so does what is stated as away; a kind as expected and one taken as full are a mixture."""
    kinds = [
        {"name": "machines", "share": 0.3, "attached": True},
        {"name": "pallets", "share": 0.4, "occupied": 0.5},
        {"name": "crates", "share": 0.3, "occupied": 0.0},
    ]
    floors, others = other_amounts(sm.read_building(tables(storeys=[{"goods": kinds}, {"live_load_kpa": 0.0}])))
    assert floors == "floors as expected"
    assert [kind.occupied for kind in others["full floors"].kinds] == [1.0, 1.0, 0.0, 0.8]  # none on the roof
    goods = {"live_load_kpa": 6.0, "mu": 0.2}
    mixed = {**tables(), "goods": goods, "storeys": [{"occupied": 0.5}, {}]}
    floors, others = other_amounts(sm.read_building(mixed))
    assert floors == "floors as taken"
    assert [kind.occupied for kind in others["floors as expected"].kinds] == [0.5, pytest.approx(3.5 / 6.0)]
    assert [kind.occupied for kind in others["full floors"].kinds] == [1.0, 1.0]
    full = sm.read_building(tables(goods={"occupied": 1.0}))
    assert other_amounts(full) == ("full floors", {})


def test_an_amount_that_cannot_be_assessed_says_why() -> None:
    """The site spectrum ends where motions of the building with full floors would be compared."""
    building = sm.read_building(tables(goods={"occupied": 0.2, "live_load_kpa": 12.0}))
    longest = 1.5 * building.period(building.goods_mass) * 1.01
    periods = np.linspace(0.02, longest, 30)
    target = sm.TargetSpectrum.asce7_multi_period(periods, sm.TargetSpectrum.asce7(1.0, 0.6)(periods) / 9.80665)
    result = sm.assess(building, FEW, target, resamples=2)
    _, full = result.answer.amounts
    assert full.advised is None
    assert "full floors, 1.00 of the design live load: no answer, because" in result.text.replace("\n          ", " ")


def test_the_page_says_the_same() -> None:
    result = sm.assess(tables(), FEW, resamples=2)
    page = building_page(result, {})
    plain = re.sub(r"<[^>]*>", "", page)
    assert str(sentence_html(result.answer.statement)) in page
    opening = result.answer.opening
    assert f"{opening[0].upper()}{opening[1:]}." in plain
    assert "Full floors, 1.00 of the design live load: " in plain


def test_interval_of_a_quantile_is_that_of_drawn_samples() -> None:
    """Each resample written out, its quantile by NumPy; clusters are drawn together."""
    values = np.random.default_rng(1).lognormal(size=20)
    cluster_of = np.repeat(np.arange(10), 2)
    counts = bootstrap_counts(cluster_of, 300, 0)
    drawn = [np.quantile(np.repeat(values, row.astype(int)), 0.84) for row in counts]
    low, high = quantile_interval(values, 0.84, counts, 0.9)
    assert (low, high) == pytest.approx(tuple(np.percentile(drawn, [5.0, 95.0])), rel=1e-12)


def test_slips_have_intervals() -> None:
    result = sm.assess(tables(), list(sm.builtin_suite("forty"))[:8], mu_factors=(1, 1), resamples=100)
    row = result.slip.row(0, named=True)
    assert row["peak_p84_low"] <= row["peak_p84"] <= row["peak_p84_high"]
    ends = f"[{1e3 * row['peak_p84_low']:.0f}, {1e3 * row['peak_p84_high']:.0f}]"
    assert f"Allow for {1e3 * row['peak_p84']:.0f} {ends} mm of slip each way" in result.text.replace("\n    ", " ")
