"""What a study says, in sentences computed from its tables: the answer that its page begins with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl
from markupsafe import Markup

from seismass.effective_mass.estimate import RULE, SAFE_RULE
from seismass.show.study.captions import StudyFrames

SHORT: Final = 0.1
"""By how much a rule's share may fall short of the effective fraction; the interval of a fraction is wider."""
SELDOM: Final = 0.05
"""Share of the buildings in which it may fall short by more."""
GROWS: Final = 1.05
"""Real drift over that of the attached model from which on sliding is said to add to it."""
RULES: Final = {RULE: "estimate", SAFE_RULE: "conservative", "all, 1": None}
"""Rules for the share to attach, by the mass that they attach, and their columns of the table of fractions."""


@dataclass(frozen=True)
class Rule:
    """A rule for the share to attach beside the effective fractions of `buildings`: `short` counts those where its
    share is less by more than `SHORT`, `most` is the largest difference by which it is less (0: never).
    """

    name: str
    mean: float
    short: int
    most: float
    buildings: int

    @property
    def serves(self) -> bool:
        """Whether it seldom falls short."""
        return self.buildings > 0 and self.short <= SELDOM * self.buildings


def percent(value: float | None, digits: int = 0) -> str:
    """Return a signed percentage with a true minus, or a dash."""
    if value is None or not np.isfinite(value):
        return "\N{EN DASH}"
    text = f"{value:+.{digits}f}"
    if float(text) == 0.0:
        text = text[1:]
    return text.replace("-", "\N{MINUS SIGN}") + "\N{NO-BREAK SPACE}%"


def compared_rules(fractions: pl.DataFrame) -> list[Rule]:
    """Return the rules beside the effective fractions, that of the code by its share in the analysis among them."""
    known = fractions.drop_nulls("effective")
    effective = known["effective"].to_numpy()
    shares = {"code": known["lambda_analysis"].to_numpy()}
    for name, column in RULES.items():
        shares[name] = np.ones(known.height) if column is None else known[column].to_numpy()
    rules = []
    for name, share in shares.items():
        missing = np.where(np.isfinite(share), effective - share, np.inf)
        most = float(max(0.0, missing.max())) if known.height else 0.0
        mean = float(share.mean()) if known.height else np.nan
        rules.append(Rule(name, mean, int((missing > SHORT).sum()), most, known.height))
    return rules


def one_line(result: StudyFrames) -> str:
    """Return what the study found in one sentence."""
    summary = result.summary.filter(pl.col("underestimation_percent").is_finite())
    yielding = summary.filter(pl.col("R") > 1.0)
    shown = yielding if yielding.height else summary
    if not shown.height:
        return "No storey of the study has a result: runs collapsed or failed."
    kind = "yielding" if yielding.height else "elastic"
    first = shown.filter(storey=1)
    means = ", ".join(
        f"{percent(_number(rows['underestimation_percent'].mean()))} ({occupancy})"
        for (occupancy,), rows in first.group_by("occupancy", maintain_order=True)
    )
    worst = percent(_number(shown["underestimation_percent"].max()))
    return (
        f"With the share of the live load that {result.metadata['code']['name']} counts as mass, drifts of first "
        f"storeys of {kind} buildings are underestimated by {means} on average, and by up to {worst} in one storey."
    )


def answer(result: StudyFrames) -> list[Markup]:
    """Return the sentences, a paragraph for each thing that a reader wants to know."""
    summary = result.summary.filter(pl.col("underestimation_percent").is_finite())
    yielding = summary.filter(pl.col("R") > 1.0)
    shown = yielding if yielding.height else summary
    if not shown.height:
        return [Markup("No storey of the study has a result: runs collapsed or failed.")]
    code = result.metadata["code"]["name"]
    several = shown["mu"].n_unique() > 1
    kind = "yielding" if yielding.height else "elastic"
    paragraphs = []
    for (occupancy, mu), rows in shown.group_by("occupancy", "mu", maintain_order=True):
        name = f"{occupancy}, mu = {mu:g}" if several else str(occupancy)
        paragraphs.append(_underestimation(name, rows, code, kind))
    paragraphs.append(_causes(shown, kind))
    paragraphs.append(_fraction_against_eta(result.fractions))
    paragraphs.append(_what_to_use(result.fractions, shown))
    return paragraphs


def _underestimation(name: str, rows: pl.DataFrame, code: str, kind: str) -> Markup:
    first = rows.filter(storey=1)
    missed = first["underestimation_percent"]
    share = 100.0 * rows["lambda_analysis"][0]
    worst = rows.sort("underestimation_percent", descending=True).row(0, named=True)
    place = (
        f"storey {worst['storey']} of {worst['storeys']}, R = {worst['R']:g}, alpha = {worst['alpha']:g}: over the "
        f"motions median {percent(worst['median_underestimation_percent'])}, 16 to 84 % of them "
        f"{percent(worst['p16_underestimation_percent'])} to {percent(worst['p84_underestimation_percent'])}"
    )
    if worst["leave_one_out_record"] is not None:
        place += f"; {percent(worst['leave_one_out_percent'])} without {worst['leave_one_out_record']}"
    return Markup(
        "<strong>{name}.</strong> With {share:g} % of the live load as mass ({code}), the drift of first storeys of "
        "{kind} buildings is underestimated in {more} of {count}: by {mean} on average, {least} to {most} in single "
        "buildings. The largest underestimation of any storey is {worst} ({place})."
    ).format(
        name=name[:1].upper() + name[1:],
        share=share,
        code=code,
        kind=kind,
        mean=percent(_number(missed.mean())),
        least=percent(_number(missed.min())),
        most=percent(_number(missed.max())),
        more=int((missed > 0.0).sum()),
        count=missed.len(),
        worst=percent(worst["underestimation_percent"]),
        place=place,
    )


def _causes(rows: pl.DataFrame, kind: str) -> Markup:
    first = rows.filter(storey=1)
    top = rows.filter(pl.col("storey") == pl.col("storeys"))
    mass, sliding = (100.0 * (first[f"ratio_{name}"] - 1.0) for name in ("mass", "sliding"))
    less = top.filter(pl.col("underestimation_percent") < 0.0)
    return Markup(
        "<strong>Why.</strong> In these first storeys the mass that the code leaves out changes the drift by {mass} on "
        "average, sliding by {sliding} ({least} to {most}). Top storeys of {kind} buildings are different: "
        "{less} of {count} drift less than in the code model."
    ).format(
        mass=percent(_number(mass.mean())),
        sliding=percent(_number(sliding.mean()), 1),
        least=percent(_number(sliding.min())),
        most=percent(_number(sliding.max())),
        kind=kind,
        less=less.height,
        count=top.height,
    )


def _fraction_against_eta(fractions: pl.DataFrame) -> Markup:
    known = fractions.drop_nulls("effective")
    head = Markup("<strong>Effective fraction against eta.</strong> ")
    if not known.height:
        finite = fractions.drop_nulls("eta")
        if not finite.height:
            return head + "No fully attached model has a result."
        return head + Markup(
            "eta = mu<sub>k</sub>/C<sub>1</sub> is {eta}, for which {rule} estimates that {estimate} of the live load "
            "acts as mass. The effective fractions themselves were not computed."
        ).format(eta=span(finite["eta"]), estimate=span(finite["estimate"]), rule=RULE)
    parts = []
    for name, rows in (
        ("elastic buildings (R = 1)", known.filter(R=1.0)),
        ("yielding buildings", known.filter(pl.col("R") > 1.0)),
    ):
        if rows.height:
            parts.append(
                f"{span(rows['effective'])} (mean {_number(rows['effective'].mean()):.2f}) in {name}, where eta is "
                f"{span(rows['eta'])}"
            )
    between = known.filter(pl.col("eta") < 1.0)
    misses = ""
    if between.height:
        closed = {RULE: "estimate", SAFE_RULE: "conservative"}
        said = " and ".join(
            f"{name} by {_number((between[column] - between['effective']).mean()):+.2f}".replace("-", "\N{MINUS SIGN}")
            for name, column in closed.items()
        )
        misses = f" In the {between.height} buildings with eta below 1 it is missed on average: {said}."
    return head + Markup(
        "The share of the live load that acts as mass is {parts}; eta is the friction coefficient over the base shear "
        "coefficient C<sub>1</sub> of the building with all goods attached.{misses}"
    ).format(parts=", and ".join(parts), misses=misses)


def _what_to_use(fractions: pl.DataFrame, rows: pl.DataFrame) -> Markup:
    top = rows.filter(pl.col("storey") == pl.col("storeys"))
    more = top.filter(pl.col("ratio_sliding") > GROWS)
    second = ""
    if more.height:
        second = (
            f" One share does not serve all storeys: sliding raises the drift of {more.height} of {top.height} top "
            f"storeys by more than {100.0 * (GROWS - 1.0):.0f} % over the attached model. Run a second analysis "
            "without goods, and take the larger drift of each storey."
        )
    rules = [rule for rule in compared_rules(fractions) if rule.name in RULES]
    serving = next((rule for rule in rules if rule.serves), None)
    head = Markup("<strong>What to use.</strong> ")
    if serving is None:
        text = (
            "Attach {rule} of the live load as mass, the conservative estimate; run the study with "
            "<code>--effective</code> to see how far it holds for these motions."
        )
        return head + Markup(text).format(rule=SAFE_RULE) + second
    others = "; ".join(
        f"{rule.name}: {rule.short} of {rule.buildings}" for rule in compared_rules(fractions) if rule != serving
    )
    return head + Markup(
        "Attach <strong>{name}</strong> of the live load as mass: the least of the rules that falls short of the "
        "effective fraction by more than {short:g} in no more than {seldom:.0f} % of the buildings ({count} of {all}; "
        "{others}).{second}"
    ).format(
        name=serving.name,
        short=SHORT,
        seldom=100.0 * SELDOM,
        count=serving.short,
        all=serving.buildings,
        others=others,
        second=second,
    )


def span(values: pl.Series) -> str:
    """Return least and largest value of a column as a text."""
    return f"{_number(values.min()):.2f} to {_number(values.max()):.2f}"


def _number(value: Any) -> float:
    return float("nan") if value is None else float(value)
