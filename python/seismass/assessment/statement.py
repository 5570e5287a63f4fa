"""The answer in plain words: what sliding does, how much to count, whether the drift limit is met, what collapses; and
what it is with other amounts of goods.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import polars as pl

from seismass.assessment.building import OwnBuilding
from seismass.assessment.checks import ANALYSES, ONE_ANALYSIS, friction_words, largest_change, largest_excess
from seismass.assessment.floors import NOTHING_STATED, FloorGoods
from seismass.assessment.models import ADVISED, ATTACHED, BARE, SLIDING
from seismass.assessment.structure import beyond_rule
from seismass.base.units import STANDARD_GRAVITY, UNITS
from seismass.base.values import FloatArray
from seismass.effective_mass import EffectiveMass
from seismass.model.occupancy import SURVEYED, surveyed_load

SHORT: Final = 1.05
"""A storey whose goods-slide drift is more than so many times the model's is not covered by it."""
HARDLY: Final = 0.010
"""Slip (m) at 84 % of the motions up to which goods hardly slide."""
LITTLE: Final = 0.05
"""Part of a drift that sliding takes off, up to which friction gives nothing."""
MOVING: Final = {(False, True): "Sliding", (True, True): "Sliding and rocking", (True, False): "Rocking"}
"""What goods do, by whether some tip and whether some slide."""
NO_MATTER: Final = 0.01
"""Change of a drift below which the share does not matter."""


@dataclass(frozen=True)
class PresentGoods:
    """The answer for an amount of goods, `floors` in words: share `present` of the design live load, share of them
    `advised` as mass, storey that governs, its drift (ratio, or m without heights) and limit; or the `reason` for none.
    `units` are those of its words.
    """

    floors: str
    present: float
    advised: float | None = None
    storey: int | None = None
    drift: float | None = None
    limit: float | None = None
    reason: str | None = None
    units: str = "si"

    @property
    def verdict(self) -> str:
        """Whether the drift limit is met; empty without a limit or an answer."""
        return "" if self.drift is None or self.limit is None else "met" if self.drift <= self.limit else "not met"

    @property
    def drifts(self) -> str:
        """The drift beside its limit."""
        drift, units = self.drift or 0.0, UNITS[self.units]
        return (
            units.text("drift", drift) if self.limit is None else f"{100.0 * drift:.2f} % of {100.0 * self.limit:g} %"
        )

    @property
    def words(self) -> str:
        """Presence, share, drift and verdict in one line."""
        there = f"{self.floors}, {self.present:.2f} of the design live load"
        if self.advised is None:
            return f"{there}: no answer, because {self.reason}"
        load = f"lambda = {self.advised:.2f} ({self.present * self.advised:.2f} of the design live load as mass)"
        return f"{there}: {load}, storey {self.storey} drifts {', '.join(filter(None, (self.drifts, self.verdict)))}"


def other_amounts(building: OwnBuilding) -> tuple[str, dict[str, OwnBuilding]]:
    """Return what the floors of a building are called, and it with the other amounts of goods."""
    cases = {}
    for place, name in enumerate(("floors as expected", "full floors")):
        kinds = tuple(replace(kind, occupied=_occupied(building, kind)[place]) for kind in building.kinds)
        cases[name] = building.with_kinds(kinds)
    same = [name for name, case in cases.items() if np.allclose(case.goods_mass, building.goods_mass, rtol=1e-12)]
    return (same or ["floors as taken"])[-1], {name: case for name, case in cases.items() if name not in same}


def _occupied(building: OwnBuilding, kind: FloorGoods) -> tuple[float, float]:
    """Share of the design live load on floors as expected and on full ones: mean of the survey, and one standard
    deviation more, at most 1; where the share is stated that share, and 1.
    """
    use, area = building.floor_codes[kind.floor - 1].use or building.code.use, float(building.area[kind.floor - 1])
    survey = kind.occupancy or (SURVEYED.get(use, "") if kind.presence.endswith("nothing is stated") else "")
    if kind.attached or kind.mass == 0.0:
        return kind.occupied, kind.occupied
    if not survey:
        return kind.occupied, 1.0
    load_survey = surveyed_load(survey)
    if kind.presence.endswith(NOTHING_STATED):  # taken as full
        load = 1e-3 * STANDARD_GRAVITY * float(building.live_load[kind.floor - 1]) / area
        return min(1.0, load_survey.mean / load) if load > 0.0 else load_survey.share, 1.0
    spread = load_survey.deviation(np.inf if np.isnan(area) else area)
    return kind.occupied, min(1.0, kind.occupied * (1.0 + spread / load_survey.mean))


def governing_drifts(effective: dict[str, EffectiveMass], advised: float) -> FloatArray:
    """Return the largest mean drift of each storey in both analyses and with goods that slide, of effective fractions;
    that of the first analysis is interpolated between the shares of their curves.
    """
    curve = effective[SLIDING].curve.filter(pl.col("storey") > 0).sort("storey", "fraction")
    model = [table.select("fraction", "model_drift").to_numpy().T for table in curve.partition_by("storey")]
    pair = [[np.interp(share, *table) for table in model] for share in (advised, 0.0)]
    sliding = [each.storeys["real"].to_list() for each in effective.values()]
    largest: FloatArray = np.max([*pair, *sliding], axis=0)
    return largest


def present_goods(floors: str, building: OwnBuilding, advised: float, drifts: FloatArray) -> PresentGoods:
    """Return the answer for an amount of goods, of the drift that governs each storey."""
    storey, limit = int(np.argmax(drifts)), None if building.heights is None else building.drift_limit
    drift = float(drifts[storey])
    return PresentGoods(floors, building.present_share, advised, storey + 1, drift, limit, units=building.units)


def statement_of(
    building: OwnBuilding,
    friction: str,
    tables: tuple[pl.DataFrame, pl.DataFrame, pl.DataFrame],
    collapses: dict[str, int],
    motions: int,
    amounts: tuple[PresentGoods, ...],
    *,
    tipping: pl.DataFrame,
) -> str:
    """Return the answer in plain sentences. `friction` is the model that decides the share; `tables` are of storeys, of
    what governs, and of slips; the first of `amounts` is that of the assessment; `tipping` is that of goods that tip.
    """
    (storeys, governing, slip), (first, *others) = tables, amounts
    words = {name: text for name, text in friction_words(building.mu_factors).items() if name in collapses}
    change = largest_change(storeys, (*words, ATTACHED, BARE))
    if change is not None and change <= NO_MATTER:
        most = f"{100.0 * max(change, 1e-4):.2g} %, whether none or all of the goods act as mass"
        sliding = f"The share does not matter: no storey's drift changes by more than {most}"
    else:
        drifts = dict(storeys.filter(storey=first.storey).select("model", "mean").iter_rows())
        sliding = _sliding(first, drifts, friction, words, slip.filter(model=friction), motions, tipping)
    verdict = f"The drift limit is {first.verdict}: storey {first.storey}, {first.drifts}" if first.verdict else ""
    for other in others if verdict else ():
        if other.verdict != first.verdict:
            changed = f"it is {other.verdict}: {other.drifts}" if other.verdict else "there is no answer"
            verdict += f"; with {other.floors} {changed}"
    single = first.advised == 0.0
    fallen = collapsing(building, collapses, motions, single=single)
    sentences = (_uncovered(building, governing, single=single), sliding, verdict, fallen)
    return " ".join(f"{sentence}." for sentence in sentences if sentence)


def collapsing(building: OwnBuilding, collapses: dict[str, int], motions: int, *, single: bool = False) -> str:
    """Return which models collapse under how many motions: goods that slide, at their worst friction, and the pair, or
    the `single` analysis.
    """
    called = {BARE: "the building"}
    words = {name: where for name, where in friction_words(building.mu_factors).items() if name in collapses}
    if words:
        worst = max(words, key=lambda name: collapses[name])
        called = {worst: f"the building with goods that slide ({words[worst]})", **ANALYSES}
        called = {**called, BARE: ONE_ANALYSIS[BARE], ADVISED: ""} if single else called
    sentences = [f"{name} under {collapses[key]}" for key, name in called.items() if name and collapses.get(key)]
    return f"Of {motions} runs each some collapse: {', '.join(sentences)}" if sentences else ""


def _uncovered(building: OwnBuilding, governing: pl.DataFrame, *, single: bool) -> str:
    (ratio, storey, where), parts = largest_excess(governing), " and ".join(beyond_rule(building))
    if ratio <= SHORT:
        return ""
    analyses, of_what = (
        ("No analysis covers", "its drift") if single else ("No pair of analyses covers", "the larger of both")
    )
    return (
        f"{analyses} this building{f' with {parts}' * bool(parts)}: with goods that slide ({where}) storey {storey} "
        f"drifts {ratio:.2f} times {of_what}, and that drift counts"
    )


def _sliding(
    first: PresentGoods,
    drifts: dict[str, float],
    friction: str,
    words: dict[str, str],
    slip: pl.DataFrame,
    runs: int,
    tipping: pl.DataFrame,
) -> str:
    """What sliding does to the storey that governs, and how much to count; `slip` is at that friction."""
    where, advised = f" with {words[friction]}" * (len(words) > 1), first.advised or 0.0
    count = f"count {advised:.2f} of the goods that are there as mass" if advised else "count none of the goods as mass"
    change, as_stated = (drifts[name] / drifts[ATTACHED] - 1.0 for name in (friction, SLIDING))
    effect = _effect(change, f"the drift that storey {first.storey} has with all goods attached")
    if advised > 1.0:
        return f"Goods load this building more{where} than all of them attached would: {count}"
    if advised < 1.0:
        same = round(100.0 * change) == round(100.0 * as_stated)
        stated = "" if same else f"; with {words[SLIDING]} it {_effect(as_stated, 'that drift')}"
        return f"{MOVING[tipping.height > 0, slip.height > 0]}{where} {effect}{stated}: {count}"
    if not slip.height:
        may_fall = "; they may fall and are taken as attached" if (tipping["staying"] == 1.0).all() else ""
        return f"Goods tip before they slide{where}{may_fall}: count all goods that are there as mass"
    slides, p84, most = (slip[name].to_numpy().max() for name in ("motions_that_slide", "peak_p84", "peak_max"))
    nothing = "no smaller share is enough" if change < -LITTLE else "friction gives nothing"
    nothing += "; count all goods that are there as mass"
    if not slides:
        return f"No goods slide under any of the {runs} motions{where}: {nothing}"
    slips = [UNITS[first.units].text("slip", value, ".1f") for value in (p84, most)]
    slid = f"in {slides} of {runs} motions{where}, {slips[0]} at 84 %, {slips[1]} at most"
    hardly = bool(p84 <= HARDLY)
    return f"Goods {'hardly ' * hardly}slide ({slid}){f', which {effect}' * (not hardly)}: {nothing}"


def _effect(change: float, drift: str) -> str:
    if abs(change) < 0.005:
        return f"changes {drift} by less than 0.5 %"
    return f"takes {-100.0 * change:.0f} % off {drift}" if change < 0.0 else f"adds {100.0 * change:.0f} % to {drift}"
