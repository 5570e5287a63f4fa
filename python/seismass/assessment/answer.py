"""The answer of an assessment: a pair of analyses, what governs, why this share, on which motions; or why none.

Text, page and JSON say what stands here, and nothing else beside it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.assessment.building import OwnBuilding
from seismass.assessment.checks import (
    ANALYSES,
    drifts_of,
    friction_words,
    largest_change,
    largest_excess,
    tipping_sentences,
)
from seismass.assessment.floors import by_floor
from seismass.assessment.models import ADVISED, ATTACHED, BARE, SLIDING_ALL
from seismass.assessment.statement import NO_MATTER, PresentGoods, collapsing, statement_of
from seismass.base.arguments import ProgressLike
from seismass.base.statistics import capped, few_collapses
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.design.scaling import ScalingResult
from seismass.effective_mass import EffectiveMass
from seismass.effective_mass.answer import Designed, solved_designs, solved_frictions
from seismass.effective_mass.models import DEFAULT_FRACTIONS, SAME_DAMPING
from seismass.effective_mass.search import OWNER, checked_options
from seismass.motions.spectra import TargetSpectrum
from seismass.runs.batch import EngineRuns
from seismass.runs.peaks import named_motions

ROUNDING_STEP: Final = 0.01
"""An advised share is the next multiple of it; with a coarse one the drift of analysis 1 would jump."""
CHANGED_SHARE: Final = 0.05
"""Change of the share by another drift cap that is told."""
MOST_DOUBTS: Final = 3
"""Doubts that stand in the headline; the others are among the remarks."""
ANALYSIS: Final = "analysis"
"""Name of the table of what to type into another program."""
ANALYSIS_UNITS: Final = {"si": ("t", "kn"), "us": ("kip_s2_per_ft", "kip")}
"""Units of mass and weight in the names of its columns."""
MANY: Final = ", more than a tenth"
"""The bound above which there is no answer, `few_collapses` in words."""


@dataclass(frozen=True)
class Analysis:
    """One of the two analyses: what is attached to the floors as mass.

    Attributes
    ----------
    number : int
        1: with the share; 2: without goods.
    model : str
        Its name in the tables.
    share_of_goods_present, share_of_design_live_load : float
        What is attached, over the goods present and over the design live load of the whole building.
    mass, goods_mass : tuple of float
        Mass of each floor in the analysis, and what of it is loose goods (kg).
    multipliers : tuple of float
        Goods in the analysis, bolted ones among them, over the design live load of each floor: multiplier of the live
        load in a mass source.
    mass_source : str
        The mass in words, where all floors with a live load have one multiplier.
    """

    number: int
    model: str
    share_of_goods_present: float
    share_of_design_live_load: float
    mass: tuple[float, ...]
    goods_mass: tuple[float, ...]
    multipliers: tuple[float, ...]
    mass_source: str


@dataclass(frozen=True)
class Answer:
    """What an assessment answers.

    Attributes
    ----------
    statement : str
        The answer in plain sentences, or why there is none.
    reason : str or None
        Why there is no answer.
    doubts : tuple of str
        What makes the input doubtful; it stands before the statement.
    analyses : tuple of Analysis
        The pair; empty where there is no answer.
    governs : tuple of str
        Which analysis governs which storeys, and what goods that slide drift beside it.
    goods : tuple of str
        How the goods present are known; then share, drift and verdict with them, and with other amounts of goods;
        which goods tip, and share, drift and verdict under the other models of them.
    tipping : tuple of PresentGoods
        The answer under the other models of goods that tip.
    amounts : tuple of PresentGoods
        The same in numbers, that of the assessment first.
    why : str
        The friction that decides, the fraction at it, and the rounding.
    sensitivity : tuple of str
        Share and governing drift with each motion left out; and with half and twice the drift cap, where the share or
        the verdict is another one.
    design : str
        Which share goes into the weight W of a design of strengths.
    motions : str
        On which motions the answer stands.
    remedy : str
        Which strengths give an answer where runs collapse; empty where that was not tried.
    opening : str
        How many analyses there are, and which drift counts.
    matters : bool or None
        Whether the share changes the drift of any storey by more than 1 %; None where there is no answer.
    """

    statement: str
    reason: str | None
    doubts: tuple[str, ...]
    analyses: tuple[Analysis, ...] = ()
    governs: tuple[str, ...] = ()
    goods: tuple[str, ...] = ()
    tipping: tuple[PresentGoods, ...] = ()
    amounts: tuple[PresentGoods, ...] = ()
    why: str = ""
    sensitivity: tuple[str, ...] = ()
    design: str = ""
    motions: str = ""
    remedy: str = ""
    opening: str = ""
    matters: bool | None = None

    @property
    def headline(self) -> str:
        """The statement, after the first doubt where the input is doubtful."""
        return "; ".join([*self.doubt_lines[:1], self.statement])

    @property
    def doubt_lines(self) -> tuple[str, ...]:
        """What stands before the statement where the input is doubtful."""
        return doubt_lines(self.doubts)

    @property
    def pair(self) -> tuple[str, ...]:
        """The analyses in words, the base of shares in the first; one where the share is 0 and both are the same."""
        if self.analyses and self.analyses[0].share_of_goods_present == 0.0:
            loose = "loose " * any(self.analyses[1].multipliers)
            return (f"lambda = 0.00, no {loose}goods as mass: {self.analyses[1].mass_source}",)
        return tuple(
            f"lambda = {one.share_of_goods_present:.2f} of the goods present ({one.share_of_design_live_load:.2f} of "
            f"the design live load) as mass: {one.mass_source}"
            if one.model == ADVISED
            else f"no {'loose ' * any(one.multipliers)}goods: {one.mass_source}"
            for one in self.analyses
        )


def stored_answer(document: dict[str, Any]) -> Answer:
    """Return the answer of an assessment of its `to_dict`."""
    known: dict[str, Any] = {name: document[name] for name in ("statement", "reason", "remedy")}
    known |= {"doubts": tuple(document["doubts"]), "motions": document["on_motions"]}
    answer = document["answer"]
    if answer is None:
        return Answer(**known)
    known |= {name: answer[name] for name in ("opening", "why", "design")}
    known |= {name: tuple(answer[name]) for name in ("governs", "goods", "sensitivity")}
    for name in ("amounts", "tipping"):
        cases = ({key: value for key, value in case.items() if key != "verdict"} for case in answer[name])
        known[name] = tuple(PresentGoods(**case) for case in cases)
    lists = ("mass", "goods_mass", "multipliers")
    analyses = (Analysis(**one | {name: tuple(one[name]) for name in lists}) for one in answer["analyses"])
    return Answer(**known, analyses=tuple(analyses), matters=answer["share_matters"])


def doubt_lines(doubts: tuple[str, ...]) -> tuple[str, ...]:
    """Return what stands before an answer whose input is doubtful, the first few of the doubts."""
    shown = [f"DOUBTFUL INPUT: {doubt}" for doubt in doubts[:MOST_DOUBTS]]
    further = len(doubts) - len(shown)
    return (*shown, *([f"and {further} more doubts, among the remarks"] if further else []))


@dataclass(frozen=True, eq=False)
class DesignShare:
    """Share for the design of the strengths: `effective`, None where many runs collapse, and the `reason` for none."""

    effective: EffectiveMass | None
    reason: str


def answer_of(
    building: OwnBuilding,
    advised: float | None,
    effective: dict[str, EffectiveMass],
    design: DesignShare | None,
    storeys: pl.DataFrame,
    governing: pl.DataFrame,
    runs: pl.DataFrame,
    left_out: pl.DataFrame,
    collapses: dict[str, int],
    slip: pl.DataFrame,
    amounts: tuple[PresentGoods, ...],
    tipping: tuple[pl.DataFrame, tuple[PresentGoods, ...]],
    suite: dict[str, Any],
    scaling: ScalingResult | None,
    doubts: tuple[str, ...],
    remedy: Callable[[], str],
) -> Answer:
    """Return the answer of an assessment of its parts, as `Assessment` has them; `remedy` finds strengths that give
    one where runs collapse.
    """
    on = motions_sentence(suite, scaling)
    reason = _reason(building, effective, collapses, len(suite["motions"]))
    if reason is not None or advised is None:
        why = reason or "there are no goods on the floors, and no live load could act as mass"
        few = "" if reason is not None else collapsing(building, collapses, len(suite["motions"]))
        stronger = "" if reason is None else remedy()
        sentences = (f"No answer, because {why}", few, stronger)
        return Answer(" ".join(f"{one}." for one in sentences if one), why, doubts, motions=on, remedy=stronger)
    tables, motions = (storeys, governing, slip), len(suite["motions"])
    of_tipping = (*tipping_sentences(building, tipping[0]), *(case.words for case in tipping[1]))
    change = largest_change(storeys, (*effective, ATTACHED, BARE))
    return Answer(
        statement_of(building, deciding(effective), tables, collapses, motions, amounts, tipping=tipping[0]),
        None,
        doubts,
        opening=_opening(advised, governing),
        analyses=(_analysis(building, 1, ADVISED, advised), _analysis(building, 2, BARE, 0.0)),
        governs=_governs(building, governing),
        goods=(presence_sentence(building), *(amount.words for amount in amounts), *of_tipping),
        tipping=tipping[1],
        amounts=amounts,
        why=_why(advised, effective, friction_words(building.mu_factors)),
        sensitivity=(*_left_out(building, left_out), *_at_other_caps(building, advised, effective, runs)),
        design=_design(building, advised, design),
        motions=on,
        matters=change is None or change > NO_MATTER,
    )


def presence_sentence(building: OwnBuilding) -> str:
    """Return how much of the design live load is taken as present, and how that is known, floor by floor."""
    by_share: dict[str, list[str]] = {}
    for kind in building.loose:
        if kind.mass > 0.0:
            by_share.setdefault(f"{kind.occupied:.2f} {kind.presence}", []).append(f"{kind.floor} {kind.name}".rstrip())
    if len(by_share) == 1:
        (how,) = by_share
        return how
    return "; ".join(f"floor {', '.join(floors)}: {how}" for how, floors in by_share.items())


def rounded_up(value: float) -> float:
    """Return a share rounded up to `ROUNDING_STEP`; at most 1, unless it is above."""
    # Roots are located to 1e-12, so that one at a multiple is not lifted to the next.
    rounded = round(ROUNDING_STEP * math.ceil(value / ROUNDING_STEP - 1e-9), 2)
    return rounded if value > 1.0 else min(1.0, rounded)


def deciding(effective: Mapping[str, Any]) -> str:
    """Return the friction whose fraction is the largest; the stated one, where several are."""
    return max(effective, key=lambda name: effective[name].value)


def motions_sentence(suite: dict[str, Any], scaling: ScalingResult | None) -> str:
    """Return on how many motions of which kind an answer stands, and how they were scaled."""
    count, synthetic = len(suite["motions"]), suite["synthetic"]
    pairs_of = "pairs of " * suite["pairs"]
    if synthetic == count:
        kind = f"{count} {pairs_of}synthetic motions, none recorded"
    elif synthetic:
        kind = f"{count} {pairs_of}motions, {synthetic} of them synthetic"
    else:
        kind = f"{count} {pairs_of}recorded motions"
    if scaling is None:
        how = "taken as they are"
    else:
        low, high = float(np.min(scaling.factors)), float(np.max(scaling.factors))
        how = f"scaled by {low:.2f} to {high:.2f} to {scaling.target_label} by the rule of {scaling.method}"
        if scaling.method == "ASCE 7-10":
            how = f"scaled by {low:.2f} to {high:.2f} so that their mean is not below the site spectrum (ASCE/SEI 7-10)"
    advice = "; use recordings of the site's hazard for a decision" if synthetic else ""
    return f"on {kind}, {how}{advice}"


def _reason(
    building: OwnBuilding, effective: dict[str, EffectiveMass], collapses: dict[str, int], motions: int
) -> str | None:
    """Why there is no answer: what collapses, the building first, then the analyses."""
    words = friction_words(building.mu_factors)
    fallen = {name: collapses[name] for name in SLIDING_ALL if not few_collapses(collapses.get(name, 0), motions)}
    if fallen:
        worst = max(fallen, key=lambda name: fallen[name])
        friction_text = "" if len(effective) == 1 else f" ({words[worst]})"
        how_many = f"{fallen[worst]} of {motions} motions{MANY}"
        return f"the building with goods that slide{friction_text} collapses under {how_many}"
    if not effective:
        count = collapses.get(BARE, 0)
        many = not few_collapses(count, motions)
        return f"the building collapses under {count} of {motions} motions{MANY}" if many else None
    for name, called in ANALYSES.items():
        if not few_collapses(collapses.get(name, 0), motions):
            return f"{called} collapses under {collapses[name]} of {motions} motions{MANY}"
    return None


def _analysis(building: OwnBuilding, number: int, model: str, share: float) -> Analysis:
    goods_mass = share * building.goods_mass
    load = by_floor(building.kinds, [kind.live_load for kind in building.kinds], building.storeys)
    multipliers = np.divide(goods_mass + building.bolted, load, out=np.zeros(len(load)), where=load > 0.0)
    return Analysis(
        number,
        model,
        share,
        share * building.present_share,
        tuple((building.mass + building.frames + goods_mass).tolist()),
        tuple(goods_mass.tolist()),
        tuple(multipliers.tolist()),
        _mass_source(multipliers[load > 0.0]),
    )


def _mass_source(multipliers: FloatArray) -> str:
    """Mass in words, of the multipliers of floors with a live load."""
    if not multipliers.any():
        return "dead load alone"
    if np.ptp(multipliers) > 1e-9:
        return "by floor, below"
    return f"dead + {multipliers[0]:.2f} live"


def _opening(advised: float, governing: pl.DataFrame) -> str:
    """How many analyses there are, and whether they cover the goods that slide."""
    what, times = "two analyses", largest_excess(governing)[0]
    of_what, alone = "the larger of both", "the larger drift of each storey counts"
    if advised == 0.0:
        what, of_what, alone = "one analysis, since no share of the goods acts as mass", "its own", "its drifts count"
    if not governing["governed_by"].str.starts_with("goods slide").any():
        return f"{what}; {alone}"
    return f"{what}; goods that slide drift up to {times:.2f} times {of_what}, and that drift counts"


def _governs(building: OwnBuilding, governing: pl.DataFrame) -> tuple[str, ...]:
    """One sentence per analysis that governs a storey, and one about the goods that slide."""
    scale, unit = building.shown.drifts(ratio=governing["unit"][0] == "ratio")
    single = governing[ADVISED].equals(governing[BARE], check_names=False)
    larger, both = ("the analysis", "that of the analysis") if single else ("the larger analysis", "the larger")
    lines = []
    for model in dict.fromkeys(governing["governed_by"].to_list()):
        rows = governing.filter(pl.col("governed_by") == model).sort("governing", descending=True)
        row = rows.row(0, named=True)
        if model.startswith("goods slide"):
            times = max(one["governing"] / max(one[ADVISED], one[BARE]) for one in rows.iter_rows(named=True))
            model = f"{model}, {times:.2f} times {larger}"
        limit = "" if row["limit"] is None else f" of {scale * row['limit']:g} %"
        ending = "" if row["limit"] is None or row["governing_over_limit"] <= 1.0 else ", above the limit"
        where = _storeys(rows["storey"].to_list())
        largest = "" if rows.height == 1 else f"storey {row['storey']}, "
        named = f" {row['name']}" if row["name"] else ""
        called = f"storey {row['storey']}{named}" if rows.height == 1 else where
        lines.append(f"{called}: {model}, {largest}{scale * row['governing']:.2f} {unit}{limit}{ending}")
    ratio, storey, mu = largest_excess(governing)
    lines.append(f"with sliding goods no storey drifts more than {ratio:.2f} times {both} (storey {storey}, {mu})")
    return tuple(lines)


def _storeys(numbers: list[int]) -> str:
    ordered = sorted(numbers)
    if ordered == list(range(ordered[0], ordered[-1] + 1)):
        return f"storeys {ordered[0]} to {ordered[-1]}"
    return f"storeys {', '.join(str(number) for number in ordered)}"


def _why(advised: float, effective: dict[str, EffectiveMass], words: dict[str, str]) -> str:
    decides = deciding(effective)
    parts = []
    for name in sorted(effective, key=lambda name: name != decides):
        parts.append(f"{words[name]} gives {_value(effective[name])}")
    confidence = 100.0 * effective[decides].confidence
    interval = f" ({confidence:g} % interval)" if effective[decides].suite_interval is not None else ""
    rounded = f", rounded up to a multiple of {ROUNDING_STEP:g}" if advised - effective[decides].value > 1e-9 else ""
    others = f"; {', '.join(parts[1:])}" if len(parts) > 1 else ""
    return f"{advised:.2f} since {parts[0]}{interval}{rounded}{others}"


def _value(result: EffectiveMass) -> str:
    several = f", the largest of {len(result.roots)} shares from {result.roots[0]:.2f}" if len(result.roots) > 1 else ""
    if result.suite_interval is None:
        return f"{result.value:.2f}{several}"
    return f"{result.value:.2f} [{result.suite_interval[0]:.2f}, {result.suite_interval[1]:.2f}]{several}"


def _at_other_caps(
    building: OwnBuilding, advised: float, effective: dict[str, EffectiveMass], runs: pl.DataFrame
) -> list[str]:
    """Share and governing drift at half and twice the drift cap where the share or the verdict is another one. The
    second analysis, analysis 1 and the goods that slide are those of the answer.
    """
    drifts, at_cap = drifts_of(building, runs), building.drift_cap
    values = []
    for cap in (at_cap, 0.5 * at_cap, 2.0 * at_cap):
        fractions = (one.metadata["share_at_drift_cap"].get(f"{cap:g}", advised) for one in effective.values())
        values.append((rounded_up(max(fractions)), float(capped(drifts, cap).mean(axis=1).max())))
    verdicts = {drift <= building.drift_limit for _, drift in values}
    if len(verdicts) == 1 and max(abs(share - advised) for share, _ in values) < CHANGED_SHARE:
        return []
    texts = [f"{share:.2f} and {100.0 * drift:.2f} %" for share, drift in values]
    return [
        f"the drift cap of {100.0 * at_cap:g} % of the height decides: lambda and the governing drift are {texts[0]}, "
        f"{texts[1]} at half and {texts[2]} at twice the cap"
    ]


def _left_out(building: OwnBuilding, left_out: pl.DataFrame) -> list[str]:
    """The range of the fraction that decides and of the governing drift over the motions left out."""
    if left_out["governing"].null_count():
        return []
    scale, unit = building.shown.drifts(ratio=building.heights is not None)
    share, drift = (left_out[name].to_numpy() for name in ("fraction", "governing"))
    return [
        f"with one motion left out the fraction is {share.min():.2f} to {share.max():.2f}, the governing drift "
        f"{scale * drift.min():.2f} to {scale * drift.max():.2f} {unit}"
    ]


def _design(building: OwnBuilding, advised: float, design: DesignShare | None) -> str:
    """Which share goes into W."""
    if building.design is None or design is None:
        return f"Strengths are as stated. lambda = {advised:.2f} is for the analysis, not for the weight W of a design."
    here = f"Strengths are designed with a weight W that counts {building.design_fraction:.3g} of the design live load."
    if design.effective is None:
        return f"{here} Keep it: no other share is found, since {design.reason}."
    share = rounded_up(design.effective.value)
    return (
        f"{here} If W and the analysis are to count one share, it is {share * building.present_share:.2f} "
        f"({share:.2f} of the goods present). lambda = {advised:.2f} is for the analysis of this building."
    )


def analysis_table(answer: Answer, building: OwnBuilding) -> pl.DataFrame:
    """Return what to type into another program, one row per floor: masses (t, or kip s2/ft), weights (kN, or kip) and
    the multiplier of the design live load in both analyses. It is empty where there is no answer.
    """
    columns: dict[str, Any] = {"floor": [], "name": []}
    mass, force = (building.shown.of(quantity)[1] for quantity in ("mass", "force"))
    mass_unit, force_unit = ANALYSIS_UNITS[building.units]
    if answer.analyses:
        columns = {"floor": list(range(1, building.storeys + 1)), "name": list(building.storey_names)}
    schema: dict[str, Any] = {"floor": pl.UInt32, "name": pl.String}
    for number in (1, 2):
        row = next((one for one in answer.analyses if one.number == number), None)
        masses = np.array(() if row is None else row.mass)
        columns[f"mass_{number}_{mass_unit}"] = masses / mass
        columns[f"weight_{number}_{force_unit}"] = STANDARD_GRAVITY * masses / force
        columns[f"multiplier_{number}"] = [] if row is None else list(row.multipliers)
    schema |= dict.fromkeys(list(columns)[2:], pl.Float64)
    return pl.DataFrame(columns, schema=schema)


DESIGN_SHARES_IN_PLANE: Final = np.linspace(0.0, 1.0, 6)
"""Shares of a design of strengths in two directions, where goods that slide take a hundred times as long."""


def fractions_by_friction(
    building: OwnBuilding,
    target: TargetSpectrum | None,
    frictions: dict[str, float],
    motions: list[Any],
    bootstrap: dict[str, Any],
    threads: int | None,
    progress: ProgressLike,
    keep: list[EngineRuns] | None = None,
) -> dict[str, EffectiveMass]:
    """Return the effective fraction at each friction, by model; whole runs of goods that slide are added to `keep`."""
    if not frictions:
        return {}
    scenes = [building.scene(target, mu_factor=factor) for factor in frictions.values()]
    drawn = (bootstrap["confidence"], bootstrap["resamples"], bootstrap["seed"])
    values = ("mean", SAME_DAMPING, None, *drawn, threads, progress)
    level = None if target is None else building.motion_target(target)  # of the rule by hand
    options = checked_options(*values, drift_cap=building.drift_cap, target=level)
    named = named_motions(motions, OWNER, scenes[0])
    solved = solved_frictions(scenes, named, options, keep)
    return {name: one.answer() for name, one in zip(frictions, solved, strict=True)}


def advised_share(effective: dict[str, EffectiveMass]) -> float | None:
    """Return the largest effective fraction, rounded up to 0.01; None without goods, or where many runs collapse."""
    if not effective or any(each.kind == "collapsed" for each in effective.values()):
        return None
    return rounded_up(effective[deciding(effective)].value)


def design_shares(building: OwnBuilding) -> FloatArray:
    """Return the shares at which that of a design of strengths is looked for."""
    return DEFAULT_FRACTIONS if building.other is None else DESIGN_SHARES_IN_PLANE


def design_share(
    building: OwnBuilding,
    target: TargetSpectrum | None,
    factor: float,
    motions: list[Any],
    threads: int | None,
    progress: ProgressLike,
) -> DesignShare:
    """Return the share that goes into the design of the strengths and is attached, at one factor of friction, without a
    bootstrap.
    """

    def designed(share: float) -> Designed:
        attached, other = share * building.goods_mass, building.other
        in_x = building.structure(target, attached)
        return in_x if other is None else (in_x, other.structure(target, attached))

    scene = building.scene(target, mu_factor=factor)
    shares = design_shares(building)
    values = ("mean", SAME_DAMPING, shares, 0.9, 1, 0, threads, progress)
    options = checked_options(*values, drift_cap=building.drift_cap)
    named = named_motions(motions, OWNER, scene)
    others = (scene.racks, scene.collapse_drift, scene.base, scene.fixed_goods)
    solved = solved_designs(designed, scene.blocks, named, options, *others)
    fallen = solved.sliding.collapsed.sum(axis=1)
    if not few_collapses(int(fallen.max()), len(motions)):
        return DesignShare(None, _collapsing_shares(shares, fallen, len(motions)))
    return DesignShare(solved.answer(), "")


def _collapsing_shares(shares: FloatArray, fallen: NDArray[np.int64], motions: int) -> str:
    """Which designs collapse under how many motions."""
    many = shares[[not few_collapses(int(count), motions) for count in fallen]]
    shares_text = f"{many[0]:.2f}" if len(many) == 1 else f"{many[0]:.2f} to {many[-1]:.2f}"
    whole = "every share" if len(many) == len(shares) else f"shares of {shares_text} of the goods present"
    return f"the building designed with {whole} collapses under up to {int(fallen.max())} of {motions} motions"
