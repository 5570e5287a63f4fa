"""The answer of an assessment: a pair of analyses, what governs, why this share, on which motions; or why none.

Text, page and JSON say what stands here, and nothing else beside it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.assessment.building import OwnBuilding
from seismass.assessment.checks import ANALYSES, few_collapses, friction_words, largest_change
from seismass.assessment.floors import by_floor
from seismass.assessment.models import ADVISED, ATTACHED, BARE, SLIDING_ALL
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.design.scaling import ScalingResult
from seismass.effective_mass import EffectiveMass
from seismass.effective_mass.answer import Designed, solved_designs, solved_frictions
from seismass.effective_mass.models import SAME_DAMPING
from seismass.effective_mass.runs import named_motions
from seismass.effective_mass.search import OWNER, checked_options
from seismass.motions.spectra import TargetSpectrum

ROUNDING_STEP: Final = 0.05
"""An advised share is the next multiple of it."""
MOST_DOUBTS: Final = 3
"""Doubts that stand in the headline; the others are among the remarks."""
ANALYSIS: Final = "analysis"
"""Name of the table of what to type into another program."""
NO_MATTER: Final = 0.01
"""Change of a drift below which the share does not matter."""


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
        The answer in one line; "no answer: ..." where there is none.
    reason : str or None
        Why there is no answer.
    doubts : tuple of str
        What makes the input doubtful; it stands before the statement.
    analyses : tuple of Analysis
        The pair; empty where there is no answer.
    governs : tuple of str
        Which analysis governs which storeys, and what goods that slide drift beside it.
    goods : str
        What of the design live load is taken as present, and how that is known.
    why : str
        The friction that decides, the fraction at it, and the rounding.
    design : str
        Which share goes into the weight W of a design of strengths.
    motions : str
        On which motions the answer stands.
    matters : bool or None
        Whether the share changes the drift of any storey by more than 1 %; None where there is no answer.
    """

    statement: str
    reason: str | None
    doubts: tuple[str, ...]
    analyses: tuple[Analysis, ...] = ()
    governs: tuple[str, ...] = ()
    goods: str = ""
    why: str = ""
    design: str = ""
    motions: str = ""
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
        """The two analyses in words, the base of shares in the first."""
        return tuple(
            f"lambda = {one.share_of_goods_present:.2f} of the goods present ({one.share_of_design_live_load:.2f} of "
            f"the design live load) as mass: {one.mass_source}"
            if one.model == ADVISED
            else f"no {'loose ' * any(one.multipliers)}goods: {one.mass_source}"
            for one in self.analyses
        )


def doubt_lines(doubts: tuple[str, ...]) -> tuple[str, ...]:
    """Return what stands before an answer whose input is doubtful, the first few of the doubts."""
    shown = [f"DOUBTFUL INPUT: {doubt}" for doubt in doubts[:MOST_DOUBTS]]
    further = len(doubts) - len(shown)
    return (*shown, *([f"and {further} more doubts, among the remarks"] if further else []))


@dataclass(frozen=True, eq=False)
class DesignShare:
    """Share that goes into the design of the strengths: `found`, None where many runs collapse, and the `reason` why
    there is none. Where few runs of a designed building collapse it is that of the median.
    """

    effective: EffectiveMass | None
    reason: str


def answer_of(
    building: OwnBuilding,
    advised: float | None,
    effective: dict[str, EffectiveMass],
    design: DesignShare | None,
    storeys: pl.DataFrame,
    governing: pl.DataFrame,
    collapses: dict[str, int],
    suite: dict[str, Any],
    scaling: ScalingResult | None,
    doubts: tuple[str, ...],
) -> Answer:
    """Return the answer of an assessment of its parts, as `Assessment` has them."""
    on = motions_sentence(suite, scaling)
    reason = _reason(building, effective, collapses, len(suite["motions"]))
    if reason is not None or advised is None:
        why = reason or "there are no goods on the floors, and no live load could act as mass"
        few = "" if reason is not None else _collapsing(collapses, {}, len(suite["motions"]))
        return Answer(f"{few}no answer: {why}", why, doubts, motions=on)
    words = friction_words(building)
    change = largest_change(storeys, (*(name for name in SLIDING_ALL if name in effective), ATTACHED, BARE))
    matters = change is None or change > NO_MATTER
    statement = "two analyses; the larger drift of each storey counts"
    if not matters:
        assert change is not None
        statement = (
            f"the share does not matter: no storey's drift changes by more than {100.0 * max(change, 1e-4):.2g} %, "
            "whether none or all of the goods act as mass"
        )
    return Answer(
        f"{_collapsing(collapses, words, len(suite['motions']))}{statement}",
        None,
        doubts,
        analyses=(_analysis(building, 1, ADVISED, advised), _analysis(building, 2, BARE, 0.0)),
        governs=_governs(governing),
        goods=presence_sentence(building),
        why=_why(advised, effective, words),
        design=_design(building, advised, design),
        motions=on,
        matters=matters,
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


def deciding(effective: dict[str, EffectiveMass]) -> str:
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
        how = f"scaled by {low:.2f} to {high:.2f} so that their mean is not below the site spectrum (ASCE/SEI 7-10)"
    advice = "; use recordings of the site's hazard for a decision" if synthetic else ""
    return f"on {kind}, {how}{advice}"


def _reason(
    building: OwnBuilding, effective: dict[str, EffectiveMass], collapses: dict[str, int], motions: int
) -> str | None:
    """Why there is no answer: what collapses, the building first, then the analyses."""
    words = friction_words(building)
    fallen = {name: collapses[name] for name in SLIDING_ALL if not few_collapses(collapses.get(name, 0), motions)}
    if fallen:
        worst = max(fallen, key=lambda name: fallen[name])
        friction_text = "" if len(effective) == 1 else f" ({words[worst]})"
        return f"the building collapses under {fallen[worst]} of {motions} motions{friction_text}"
    if not effective:
        count = collapses.get(BARE, 0)
        many = not few_collapses(count, motions)
        return f"the building collapses under {count} of {motions} motions" if many else None
    for name, called in ANALYSES.items():
        if not few_collapses(collapses.get(name, 0), motions):
            return f"{called} collapses under {collapses[name]} of {motions} motions"
    return None


def _collapsing(collapses: dict[str, int], words: dict[str, str], motions: int) -> str:
    """Return how the statement begins where few runs collapse, and the statistic: the building first, then the
    analyses. `words` are those of the frictions; empty for a building without goods.
    """
    mean = "mean drifts are 1.2 times the median or the mean of the others; "
    fallen = {name: collapses[name] for name in SLIDING_ALL if collapses.get(name)}
    if fallen:
        worst = max(fallen, key=lambda name: fallen[name])
        return (
            f"THE BUILDING COLLAPSES under {fallen[worst]} of {motions} motions ({words[worst]}): lambda is by the "
            f"median, {mean}"
        )
    if not words:
        count = collapses.get(BARE, 0)
        return f"THE BUILDING COLLAPSES under {count} of {motions} motions: {mean}" if count else ""
    sentences = [
        f"{called.upper()} COLLAPSES under {collapses[name]} of {motions} motions: its {mean}"
        for name, called in ANALYSES.items()
        if collapses.get(name)
    ]
    return "".join(sentences)


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


def _governs(governing: pl.DataFrame) -> tuple[str, ...]:
    """One sentence per analysis that governs a storey, and one about the goods that slide."""
    scale, unit = (1e2, "%") if governing["unit"][0] == "ratio" else (1e3, "mm")
    lines = []
    for model in dict.fromkeys(governing["governed_by"].to_list()):
        rows = governing.filter(pl.col("governed_by") == model).sort("governing", descending=True)
        row = rows.row(0, named=True)
        if model.startswith("goods slide"):
            times = max(one["governing"] / max(one[ADVISED], one[BARE]) for one in rows.iter_rows(named=True))
            model = f"{model}, {times:.2f} times the larger analysis"
        limit = "" if row["limit"] is None else f" of {scale * row['limit']:g} %"
        ending = "" if row["limit"] is None or row["governing_over_limit"] <= 1.0 else ", above the limit"
        where = _storeys(rows["storey"].to_list())
        largest = "" if rows.height == 1 else f"storey {row['storey']}, "
        named = f" {row['name']}" if row["name"] else ""
        called = f"storey {row['storey']}{named}" if rows.height == 1 else where
        lines.append(f"{called}: {model}, {largest}{scale * row['governing']:.2f} {unit}{limit}{ending}")
    ratio, storey, mu = max(
        (row["sliding"] / max(row[ADVISED], row[BARE]), row["storey"], row["sliding_at"])
        for row in governing.iter_rows(named=True)
    )
    lines.append(f"with sliding goods no storey drifts more than {ratio:.2f} times the larger (storey {storey}, {mu})")
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
    if result.suite_interval is None:
        return f"{result.value:.2f}"
    return f"{result.value:.2f} [{result.suite_interval[0]:.2f}, {result.suite_interval[1]:.2f}]"


def _design(building: OwnBuilding, advised: float, design: DesignShare | None) -> str:
    """Which share goes into W."""
    if building.design is None or design is None:
        return "strengths are as stated: lambda is for the analysis, not for W of a design"
    here = f"W here has {building.design_fraction:.3g} of the design live load"
    if design.effective is None:
        return f"{here}: keep it; there is no share for W, since {design.reason}"
    share = rounded_up(design.effective.value)
    median = "" if design.effective.statistic == "mean" else ", by the median since some designs collapse"
    return (
        f"for a design of strengths {share:.2f} of the goods present ({share * building.present_share:.2f} of the "
        f"design live load) go into W{median}; {here}, and lambda = {advised:.2f} is for the analysis of that building"
    )


def analysis_table(answer: Answer, building: OwnBuilding) -> pl.DataFrame:
    """Return what to type into another program, one row per floor: masses (t), weights (kN) and the multiplier of the
    design live load in both analyses. It is empty where there is no answer.
    """
    columns: dict[str, Any] = {"floor": [], "name": []}
    if answer.analyses:
        columns = {"floor": list(range(1, building.storeys + 1)), "name": list(building.storey_names)}
    schema: dict[str, Any] = {"floor": pl.UInt32, "name": pl.String}
    for number in (1, 2):
        row = next((one for one in answer.analyses if one.number == number), None)
        columns[f"mass_{number}_t"] = [] if row is None else [1e-3 * mass for mass in row.mass]
        columns[f"weight_{number}_kn"] = [] if row is None else [1e-3 * STANDARD_GRAVITY * mass for mass in row.mass]
        columns[f"multiplier_{number}"] = [] if row is None else list(row.multipliers)
    schema |= dict.fromkeys(list(columns)[2:], pl.Float64)
    return pl.DataFrame(columns, schema=schema)


DESIGN_SHARES: Final = np.linspace(0.0, 1.0, 21)
"""Shares at which that of a design of strengths is looked for before its root is refined; each takes two models."""
DESIGN_SHARES_IN_PLANE: Final = np.linspace(0.0, 1.0, 6)
"""The same in two directions, where a building with goods that slide takes a hundred times as long."""
SHARES: Final = 101
"""Shares at which each effective fraction is looked for; the models of all frictions are the same."""

Progress = Callable[[int, int], object]


def fractions_by_friction(
    building: OwnBuilding,
    target: TargetSpectrum | None,
    frictions: dict[str, float],
    motions: list[Any],
    bootstrap: dict[str, Any],
    threads: int | None,
    progress: Progress | None,
) -> dict[str, EffectiveMass]:
    """Return the effective fraction by factor of friction: by the mean, or the median where the building collapses."""
    if not frictions:
        return {}
    scenes = [building.scene(target, mu_factor=factor) for factor in frictions.values()]
    drawn = (bootstrap["confidence"], bootstrap["resamples"], bootstrap["seed"])
    options = checked_options("mean", SAME_DAMPING, None, *drawn, threads, progress)
    fractions = {}
    named = named_motions(motions, OWNER, scenes[0])
    for name, solved in zip(frictions, solved_frictions(scenes, named, options), strict=True):
        fractions[name] = solved.answer("median" if solved.sliding.collapsed.any() else "mean")
    return fractions


def advised_share(effective: dict[str, EffectiveMass]) -> float | None:
    """Return the largest effective fraction, rounded up to 0.05; None without goods, or where many runs collapse."""
    many = (not few_collapses(each.collapses["real"], each.records.height) for each in effective.values())
    if not effective or any(many):
        return None
    return rounded_up(effective[deciding(effective)].value)


def design_shares(building: OwnBuilding) -> FloatArray:
    """Return the shares at which that of a design of strengths is looked for."""
    return DESIGN_SHARES if building.other is None else DESIGN_SHARES_IN_PLANE


def design_share(
    building: OwnBuilding,
    target: TargetSpectrum | None,
    factor: float,
    motions: list[Any],
    threads: int | None,
    progress: Progress | None,
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
    options = checked_options("mean", SAME_DAMPING, shares, 0.9, 1, 0, threads, progress)
    named = named_motions(motions, OWNER, scene)
    solved = solved_designs(designed, scene.blocks, named, options, scene.racks, scene.collapse_drift, scene.base)
    fallen = solved.sliding.collapsed.sum(axis=1)
    if not few_collapses(int(fallen.max()), len(motions)):
        return DesignShare(None, _collapsing_shares(shares, fallen, len(motions)))
    return DesignShare(solved.answer("median" if fallen.any() else "mean"), "")


def _collapsing_shares(shares: FloatArray, fallen: NDArray[np.int64], motions: int) -> str:
    """Which designs collapse under how many motions."""
    many = shares[[not few_collapses(int(count), motions) for count in fallen]]
    shares_text = f"{many[0]:.2f}" if len(many) == 1 else f"{many[0]:.2f} to {many[-1]:.2f}"
    whole = "every share" if len(many) == len(shares) else f"shares of {shares_text} of the goods present"
    return f"the building designed with {whole} collapses under up to {int(fallen.max())} of {motions} motions"
