"""The sentences of an assessment: what to use in an analysis, what is unlikely, and everything that was assumed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.assessment.answer import Answer, presence_sentence
from seismass.assessment.building import DEFAULT_RULES, DEFAULT_THETA_LIMIT, OwnBuilding
from seismass.assessment.checks import drift_source, friction_words
from seismass.assessment.floors import BY_RULE, LARGER, NOTHING_STATED, FloorGoods
from seismass.assessment.models import ADVISED, BARE, CODE, NAMES, SLIDING, SLIDING_ALL
from seismass.assessment.statement import SHORT, collapsing
from seismass.assessment.structure import base_advice, rule_advice, support_remarks
from seismass.base.statistics import CAPPED_MEAN
from seismass.base.units import STANDARD_GRAVITY, Units
from seismass.design import THETA_THRESHOLD
from seismass.design.rules import rule_of, weakest
from seismass.design.scaling import GEOMETRIC_MEAN, ScalingResult
from seismass.effective_mass import EffectiveMass
from seismass.effective_mass.rule import RULE_UNKNOWN, one_direction_of_slip
from seismass.media.text_table import numbers_text
from seismass.model.codes import AS_STATED, CODE_NAMES, NOT_CHECKED, STORED, VERIFIED
from seismass.model.friction import BOUND_FACTORS, BOUNDS_SOURCE, friction_pair
from seismass.model.occupancy import USUAL, surveyed_load
from seismass.motions.spectra import TargetSpectrum

SCALING: Final = "Scaling: "
"""How the sentence on the rule of scaling begins."""


def code_mass_remarks(building: OwnBuilding) -> list[str]:
    """Return remarks on floors that the code exempts, and those of ordinary use that are taken as full."""
    remarks = [
        f"floor {floor} is {one.exception} ({building.code.clause}): nothing of its live load counts for the code; "
        "exempt = false in its table counts it"
        for floor, one in enumerate(building.counted, start=1)
        if one.exception.startswith(BY_RULE)
    ]
    remarks += [
        f"floor {floor}: {one.fraction:g} of its live load is {one.exception}, more than the use that is stated has; "
        "fraction in its table states another"
        for floor, one in enumerate(building.counted, start=1)
        if one.exception.startswith(LARGER)
    ]
    code = building.code
    if code.low < code.high:
        remarks.append(
            f"{code.code} has {code.low:g} to {code.high:g} for the use {code.use}, and {code.fraction:g} is taken: "
            f"{code.note} (another use, or fraction)"
        )
    if any(
        kind.presence.endswith(NOTHING_STATED) and kind.mass and (kind.use or code.use) in STORED
        for kind in building.loose
    ):
        remarks.append(f"floors of storage are taken as full, {NOTHING_STATED} (occupied, or occupancy)")
    full = [
        str(kind.floor)
        for kind in building.loose
        if (kind.use or code.use) == "ordinary" and kind.occupied == 1.0 and kind.mass
    ]
    if full:
        usual = surveyed_load(USUAL)
        remarks.append(
            f"all of the ordinary live load of floor {', '.join(dict.fromkeys(full))} is taken as rigid goods that are "
            f"there: surveys find {usual.share:.2f} of it in offices (occupied, or occupancy)"
        )
    return remarks


def goods_remarks(building: OwnBuilding) -> list[str]:
    """Return what is assumed of the goods, sentence by sentence."""
    there = [kind for kind in building.loose if kind.mass > 0.0]
    fixed = _bolted_remarks(building)
    if not there:
        return fixed
    low, high = building.mu_factors
    pairs = [friction_pair(name) for name in dict.fromkeys(kind.contact for kind in there) if name]
    contacts = ", ".join(f"{pair.pair_id} ({pair.source}; {pair.kind})" for pair in pairs) or "as stated"
    several = len({kind.floor for kind in there}) < len(there)
    lines = [
        *fixed,
        f"Goods: rigid blocks that slide by Coulomb friction, one per {'kind and ' * several}floor; they do not rock, "
        "topple or strike.",
        f"Friction: {contacts}; mu {numbers_text(np.array([kind.mu_s for kind in there]))} static, "
        f"{numbers_text(np.array([kind.mu_k for kind in there]))} kinetic.",
    ]
    if (low, high) != (1.0, 1.0):
        source = BOUNDS_SOURCE if (low, high) == BOUND_FACTORS else "as stated"
        lines.append(f"Bounds of friction: {low:g} and {high:g} times mu ({source}); high for mass, low for slip.")
    return [
        *lines,
        _presence_remark(building, there),
        "Effective fraction: smallest share with a capped mean of the largest drift not below that with sliding goods, "
        "there and at every larger share. Its interval resamples the motions, and is 0.05 wider for another suite.",
    ]


def _bolted_remarks(building: OwnBuilding) -> list[str]:
    """Goods that are part of the mass of their floors."""
    items = [
        f"{kind.name or 'goods'} on floor {kind.floor}, {building.shown.text('force', STANDARD_GRAVITY * kind.mass)}"
        for kind in building.kinds
        if kind.attached and kind.mass > 0.0
    ]
    if not items:
        return []
    return [
        f"Bolted: {'; '.join(items)}. They are mass in every model, in both analyses and, as permanent equipment, for "
        "the code; shares are of the loose goods."
    ]


def _presence_remark(building: OwnBuilding, there: list[FloorGoods]) -> str:
    """How much of the goods is present, and how that is known."""
    how = presence_sentence(building)
    surveyed = any("sustained" in kind.presence for kind in there)
    source = f" Surveys: {surveyed_load(USUAL).source}." if surveyed else ""
    source += (
        " Full floors have the mean of the survey and one standard deviation of a floor of that area, at most the "
        "design live load."
        if surveyed
        else " Full floors have all of the design live load."
    )
    return f"Goods present: {building.present_share:.3g} of the design live load of the whole building; {how}.{source}"


def code_remark(building: OwnBuilding) -> str:
    """Return what the code counts, floor by floor where they differ."""
    code = building.code
    parts = [f"{code.code}, {building.uses}" + " (none was stated)" * (not building.code_stated)]
    parts[0] += f", {code.fraction:g} of the design live load"
    if any(one != (code.fraction, "") for one in building.counted):
        parts[0] += (
            f" where a floor states no other; by floor {_by_floor(building)}, together {building.code_share:.3g}"
        )
    if code.low < code.high:
        parts[0] += f", the upper end of {code.low:g} to {code.high:g}"
    parts += [part for part in (code.clause, code.status, code.note) if part]
    return f"Code: {'; '.join(parts)}."


def _by_floor(building: OwnBuilding) -> str:
    """Fraction, use and exception of each floor."""
    parts = []
    for floor, (one, code_of_floor) in enumerate(zip(building.counted, building.floor_codes, strict=True), start=1):
        what = ", ".join(part for part in (code_of_floor.use, one.exception) if part)
        parts.append(f"{floor}: {one.fraction:g}{f' ({what})' * bool(what)}")
    return ", ".join(parts)


def advice_of(
    building: OwnBuilding,
    answer: Answer,
    storeys: pl.DataFrame,
    slip: pl.DataFrame,
    collapses: dict[str, int],
    motions: int,
    effective: EffectiveMass | None,
    runs: pl.DataFrame,
) -> tuple[str, ...]:
    """Return what to use in an analysis, and what the checks say, sentence by sentence."""
    sliding = [name for name in SLIDING_ALL if name in collapses]
    if not sliding:
        return (
            "There are no goods on the floors: the effective fraction has no meaning, and there is no live load to "
            "attach.",
            *_checks(building, storeys, (BARE,)),
        )
    lines = []
    if answer.reason is not None:
        lines.append(f"{collapsing(building, collapses, motions)}.")
        lines += [f"{answer.remedy}."] * bool(answer.remedy)
        lines.append("A share that fits drifts says nothing of collapse: strengthen the building before it is used.")
    else:
        one, _ = answer.analyses
        what = (
            f"Analysis 1: attach {one.share_of_goods_present:.2f} of the goods present "
            f"({one.share_of_design_live_load:.2f} of the design live load) as mass. Analysis 2: attach none. In both "
            "keep"
        )
        if one.share_of_goods_present == 0.0:
            what = "One analysis: attach none of the loose goods as mass. Keep"
        lines.append(
            f"{what} the whole weight of the goods in P-Delta, and the damping of the building without goods."
            + " Take the larger drift of each storey." * (one.share_of_goods_present > 0.0)
        )
        lines += [*([_envelope(building, storeys, sliding)] if one.share_of_goods_present else []), answer.design]
        lines += rule_advice(building, effective)
    lines += _checks(building, storeys, (*sliding, ADVISED, BARE))
    lines.append(_against_code(building, storeys, sliding))
    lines += _slip_advice(slip, building.shown, in_plane=building.other is not None)
    return (*lines, *base_advice(runs, building.shown))


def _largest_ratio(storeys: pl.DataFrame, sliding: Sequence[str], model: str) -> tuple[float, int, str]:
    """Largest real mean over that of a model, over storeys and frictions, with its storey and friction."""
    mean = {name: storeys.filter(model=name)["mean"].to_numpy() for name in (*sliding, model)}
    ratios = {name: mean[name] / mean[model] for name in sliding}
    return max((float(others.max()), int(others.argmax()) + 1, name) for name, others in ratios.items())


def _envelope(building: OwnBuilding, storeys: pl.DataFrame, sliding: Sequence[str]) -> str:
    """Whether the first analysis alone would do."""
    ratio, storey, case = _largest_ratio(storeys, sliding, ADVISED)
    covers = "covers every storey here" if ratio <= SHORT else "does not cover every storey"
    return (
        f"Analysis 1 alone {covers}: with sliding goods storey {storey} drifts {ratio:.2f} times its own "
        f"({friction_words(building.mu_factors)[case]})."
    )


def _checks(building: OwnBuilding, storeys: pl.DataFrame, models: Any) -> list[str]:
    """Drift and stability of the models beside their limits."""
    if building.heights is None:
        unit = building.shown.unit("drift")
        return [f"Heights are not known: drifts are in {unit}, without P-Delta and without a limit."]
    rows, called = storeys.filter(pl.col("model").is_in(list(models))), {**NAMES, BARE: "no goods"}
    lines = []
    limit = 100.0 * building.drift_limit
    row = rows.sort("mean", descending=True).row(0, named=True)
    verdict = "above" if row["mean_over_limit"] > 1.0 else "within"
    lines.append(
        f"The capped mean drift ratio is {verdict} the limit of {limit:g} %: largest {100.0 * row['mean']:.2f} % "
        f"(storey {row['storey']}, {called[row['model']]}; motions above the limit: {row['motions_above_limit']})."
    )
    stable = rows.drop_nulls("theta").sort("theta", descending=True)
    if stable.height:
        row = stable.row(0, named=True)
        verdict = "above" if row["theta"] > building.theta_limit else "within"
        elastic = float(rows["theta_elastic"].max())  # type: ignore[arg-type]
        needed = "above" if elastic > THETA_THRESHOLD else "up to"
        lines.append(
            f"The stability coefficient P d/(V h) is {verdict} its limit of {building.theta_limit:g}: largest "
            f"{row['theta']:.3f} (storey {row['storey']}, {called[row['model']]}); its elastic value P/(k h) is at "
            f"most {elastic:.3f}, {needed} the {THETA_THRESHOLD:g} below which ASCE 7-10 neglects P-Delta."
        )
    return lines


def _against_code(building: OwnBuilding, storeys: pl.DataFrame, sliding: Sequence[str]) -> str:
    ratio, storey, case = _largest_ratio(storeys, sliding, CODE)
    return (
        f"With sliding goods ({friction_words(building.mu_factors)[case]}) storey {storey} drifts {ratio:.2f} times "
        f"the model with the code's {building.code_share:.3g} of the design live load, more than any other storey does."
    )


def _slip_advice(slip: pl.DataFrame, units: Units, *, in_plane: bool) -> list[str]:
    known = slip.drop_nulls("peak_p84").sort("peak_p84", descending=True)
    if not known.height:
        return []
    row = known.row(0, named=True)
    if not row["peak_max"]:
        return ["No goods slide under any motion."]
    sentence = one_direction_of_slip()
    sentences = [] if in_plane else [f"{sentence[:1].upper()}{sentence[1:]}."]
    way = "in any direction" if in_plane else "each way"
    return [
        f"Allow for {units.number('slip', row['peak_p84'])}{slip_ends(row, units)} {units.unit('slip')} of slip {way} "
        f"on floor {row['floor']} (84 % of the motions, mu = {row['mu_s']:.3g}; largest "
        f"{units.text('slip', row['peak_max'])}): edges, aisles and neighbours.",
        *sentences,
    ]


def slip_ends(row: dict[str, Any], units: Units) -> str:
    """Return the interval of a slip at 84 % behind it; empty where there is none."""
    low, high = row["peak_p84_low"], row["peak_p84_high"]
    return "" if low is None else f" [{units.number('slip', low)}, {units.number('slip', high)}]"


def remarks_of(
    building: OwnBuilding,
    doubts: tuple[str, ...],
    scaling: ScalingResult | None,
    effective: dict[str, EffectiveMass],
    suite: dict[str, Any],
) -> tuple[str, ...]:
    """Return the doubts, and what to know about the numbers, each sentence once."""
    remarks = list(doubts)
    if scaling is not None:
        remarks += scaling.doubts
    if suite["synthetic"] == len(suite["motions"]):
        remarks.append("all motions are synthetic: give recordings of the site's hazard (--records) for a decision")
    for name, result in effective.items():
        label = "" if name == SLIDING else f"{NAMES[name]}: "
        # What storeys the share does not cover is advice, of the share that is advised.
        once = [
            text
            for text in result.remarks
            if not text.startswith(("storey ", "the building with sliding goods collapses"))
        ]
        once = [text for text in once if text not in doubts and not _of_friction(text)]
        everywhere = (" motions are few", RULE_UNKNOWN)
        remarks += [
            label + remark for remark in once if name == SLIDING or not any(part in remark for part in everywhere)
        ]
    remarks += code_mass_remarks(building)
    if building.code.status not in (VERIFIED, AS_STATED):
        remarks.append(f"the fraction of {building.code.code} was {NOT_CHECKED} ({building.code.status})")
    return tuple(dict.fromkeys(remarks))


def _of_friction(text: str) -> bool:
    """Whether a sentence doubts the friction of a block, which at its bounds is the stated one with a factor."""
    return text.startswith("mu_s of block")


def assumptions_of(
    building: OwnBuilding,
    target: TargetSpectrum | None,
    scaling: ScalingResult | None,
    suite: dict[str, Any],
    period: tuple[str, ...],
) -> tuple[str, ...]:
    """Return everything that was assumed, sentence by sentence; `period` is the sentence on the first period."""
    return (
        *_motion_remarks(building, target, scaling, suite),
        *_structure_remarks(building, target),
        *period,
        *_limit_remarks(building),
        *goods_remarks(building),
        *support_remarks(building),
        code_remark(building),
    )


def _motion_remarks(
    building: OwnBuilding, target: TargetSpectrum | None, scaling: ScalingResult | None, suite: dict[str, Any]
) -> list[str]:
    motions, synthetic = len(suite["motions"]), suite["synthetic"]
    kind = "all synthetic" if synthetic == motions else f"{synthetic} synthetic" if synthetic else "recorded"
    lines = [f"Motions: {suite['name']}, {motions}, {kind}; one direction, vertical where a motion has it."]
    if suite["pairs"]:
        lines = [
            f"Motions: {suite['name']}, {motions} pairs, {kind}; two directions, vertical where a pair has it.",
            "Two directions: friction of goods is of the circle, springs act in x and y by themselves. The drift of a "
            "storey is the larger of its peaks in x and in y, of the building and of models; slip is the length of its "
            "vector. Models have the same share attached in both directions.",
        ]
    if target is not None:
        lines.append(f"Site spectrum: {target.label}.")
    if scaling is None:
        return [*lines, "Motions are taken as they are."]
    shortest, longest = scaling.periods[0], scaling.periods[-1]
    period = scaling.period
    longest_period = max(each.period(building.goods_mass) for each in (building, building.other) if each is not None)
    fits = abs(period / longest_period - 1.0) < 1e-9
    direction = " of the more flexible direction" if building.other is not None else ""
    which = f"first period{direction} with the goods present attached" if fits else "as asked for"
    return [
        *lines,
        f"{SCALING}{_rule_of_scaling(building, pairs=suite['pairs'])} from {shortest:.3g} to {longest:.3g} s, for T = "
        f"{period:.3g} s ({which}).",
        *(f"Scaling, note: {note}." for note in scaling.notes),
    ]


def _rule_of_scaling(building: OwnBuilding, *, pairs: bool) -> str:
    """The rule by which motions are scaled, with its clauses and how they were checked."""
    name = building.scaling_code
    base = DEFAULT_RULES if name == GEOMETRIC_MEAN else name
    parts = [rule_of(base, "pairs")] if pairs else []
    parts += [rule_of(base, "share of target", "pairs")] if pairs else []
    parts += [rule_of(base, "k2" if name == "nzs1170.5" else "share of target")]
    rules = [rule for rule in parts if rule is not None]
    clauses, status = ", ".join(dict.fromkeys(rule.clause for rule in rules)), weakest([rule.status for rule in rules])
    words = [f"{rules[0].code}, {clauses}" + (f" ({status})" if status != VERIFIED else "")]
    if building.code.code_id != name and not building.scaling:
        words.append(f"as no rule of {building.code.code} is known here")
    if pairs:
        value = "geometric mean" if name == GEOMETRIC_MEAN else rules[0].value
        words.append(f"one factor for both components, {value} of a pair")
    if name == "nzs1170.5":
        return ", ".join([*words, "k_1 of each record and k_2 of the family"])
    least = (rules[1:] or rules)[0].number if pairs else rules[0].number
    return ", ".join([*words, f"mean not below {'' if least == 1.0 else f'{least:g} of '}the target"])


def _structure_remarks(building: OwnBuilding, target: TargetSpectrum | None) -> list[str]:
    lines = [
        "Shear building: rigid floors, one degree of freedom per floor, trilinear storeys with Masing unloading, no "
        "loss of strength but by P-Delta.",
        f"Springs: Omega {numbers_text(building.overstrength)}, r2 {numbers_text(building.second_slope)}, "
        f"r3 {numbers_text(building.third_slope)}.",
    ]
    if building.design is None:
        lines.append("Strength: as stated.")
    else:
        rule = building.design
        lines.append(
            f"Strength: V_y = V_e I/R with R = {rule.R:g}, response spectrum analysis ({rule.combination.upper()}) "
            f"under the site spectrum, with {building.design_fraction:g} of the design live load as mass, by the rules "
            f"of {CODE_NAMES[building.rules_code]} for category {building.risk_category}"
            f"{' (none was stated)' * (not building.category_stated)}; the table of the design has the numbers."
        )
        lines += [f"Not applied: {sentence}." for sentence in building.code_design(target).not_applied]
        if building.rules_code != building.code.code_id:
            lines.append(f"Not applied: no rule of design of {building.code.code} is known here.")
    first = building.damping_from_storey
    place = "" if first == 1 else f" above floor {first - 1}; the storeys below are not damped"
    lines.append(
        f"Damping: {100.0 * building.damping:g} % in every mode of the building without goods{place}; every model has "
        "that matrix."
    )
    if building.gravity_load is not None:
        return [*lines, "P-Delta: weight of floors and of all goods present, whatever share of their mass is attached."]
    why = "heights are not known" if building.heights is None else "switched off"
    return [*lines, f"P-Delta: none ({why})."]


def _limit_remarks(building: OwnBuilding) -> list[str]:
    if building.heights is None:
        return []
    drift, theta = drift_source(building), "as stated"
    if building.theta_limit == DEFAULT_THETA_LIMIT:
        theta = "ASCE/SEI 7-10, 12.8.7, 0.5/(beta C_d) and at most 0.25"
    return [
        f"Limits: drift ratio {building.drift_limit:g} ({drift}), stability coefficient {building.theta_limit:g} "
        f"({theta}). Drifts are nonlinear: no C_d is applied; V is the spring force.",
        f"Capped mean drift: {CAPPED_MEAN}; the cap is {building.drift_cap:g} of the height, as assumed (drift_cap). "
        "No run ends there; one that collapses counts its peaks until then. There is no answer where more than a tenth "
        "of the runs of a model collapse.",
    ]
