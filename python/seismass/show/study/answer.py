"""What a study says, in sentences computed from its tables: the answer that its page begins with."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl
from markupsafe import Markup
from matplotlib.figure import Figure

from seismass.base.statistics import CAPPED_MEAN
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import signed
from seismass.effective_mass.rule import RULE
from seismass.media.roles import EFFECTIVE, GREY, LAMBDA, MU, OMEGA, SPECTRUM, TARGET, lettered
from seismass.media.style import PERIOD_TICKS, plain
from seismass.media.svg import CAPTION_CHARACTERS
from seismass.media.text_table import change_text, number_text, text_line
from seismass.studies.study.run import StudyResult, motions_text

LEAST_WIDTH: Final = 7.0
"""Least width of a figure with a legend of two columns (inches)."""


def suite_caption(result: StudyResult, mu: float | None = None, *, inches: float = 9.0) -> str:
    """Return a few lines, for a figure so many inches wide, on the motions, the parameters that decide the result (all
    frictions unless `mu`), and the target spectrum.
    """
    suite, inputs = result.metadata["suite"], result.metadata["parameters"]
    frictions = inputs["mu"] if mu is None else [mu]
    damped = {
        "bare": "modes of the bare building, one C for all models",
        "loaded": "modes of the building with all its goods, one C for all models",
        "own": "modes of each model",
    }[inputs["damping_base"]]
    springs = (
        f"{OMEGA} = {inputs['overstrength']:g}, r2 = {inputs['second_slope']:g}, r3 = {inputs['third_slope']:g}, "
        f"{'P-Delta' if inputs['p_delta'] else 'no P-Delta'}"
    )
    text = (
        f"{motions_text(suite)} ({plain(suite['name'])}), scaled for T = {inputs['scaling_period']:g} s; "
        f"{MU} = {', '.join(f'{value:g}' for value in frictions)}; {springs}; "
        f"damping {100.0 * inputs['damping']:g} % in the {damped}; target: {plain(result.metadata['target']['label'])}"
    )
    return textwrap.fill(text, int(CAPTION_CHARACTERS * inches))


def labels_of(values: pl.Series) -> dict[float, str]:
    """Return what each value is called, in order: as short as they differ."""
    ordered = values.unique().sort().to_list()
    labels = ([f"{value:.{digits}g}" for value in ordered] for digits in range(6, 18))
    return dict(zip(ordered, next(names for names in labels if len(set(names)) == len(names)), strict=True))


def occupancy_title(occupancy: str, design: float, analysis: float) -> str:
    """Return what a figure calls an occupancy: its name with lambda, or with that of the design and of the analysis."""
    shares = f"{design:g}" if design == analysis else f"{design:g}, {analysis:g}"
    return f"{plain(occupancy)}, {LAMBDA} = {shares}"


def spectrum_figure(result: StudyResult) -> Figure:
    """Target, mean scaled and scaled spectra, with the range in which the mean must not be below the target."""
    table = result.spectrum
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    axes = figure.add_subplot()
    periods = table["period"].to_numpy()
    motions = [name for name in table.columns if name.startswith("motion_")]
    mean = f"mean of {motions_text(result.metadata['suite'])}, scaled"
    axes.plot(periods, table["mean"] / STANDARD_GRAVITY, **SPECTRUM.look, linewidth=2.0, label=mean)
    axes.plot(periods, table["target"] / STANDARD_GRAVITY, **TARGET.look, linewidth=1.8, label=TARGET.name)
    lines = axes.plot(periods, table[motions] / STANDARD_GRAVITY, color=GREY, linewidth=0.7, alpha=0.7, zorder=1)
    lines[0].set_label("each motion, scaled")
    shortest, longest, _ = result.metadata["scaling"]["periods"]
    words = f"range of scaling, {shortest:g} to {longest:g} s"
    axes.axvspan(shortest, longest, color=SPECTRUM.colour, alpha=0.07, linewidth=0.0, label=words)
    axes.set_xscale("log")
    axes.set_xlim(periods[0], periods[-1])
    axes.set_ylim(0.0, None)
    ticks = [tick for tick in PERIOD_TICKS if periods[0] <= tick <= periods[-1] * 1.0001]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("period (s)")
    damping = 100.0 * result.metadata["parameters"]["damping"]
    axes.set_ylabel(f"pseudo-acceleration, {damping:g} % damping (g)")
    axes.grid(color=GREY, alpha=0.25, linewidth=0.5)
    figure.legend(loc="outside upper center", ncols=2, frameon=False)
    label = textwrap.fill(f"Target: {plain(result.metadata['target']['label'])}", 90)
    figure.supxlabel(label, fontsize=7.5)
    return figure


SHORT: Final = 0.1
"""By how much a rule's share may fall short of the effective fraction; the interval of a fraction is wider."""
SELDOM: Final = 0.05
"""Share of the buildings in which it may fall short by more."""
GROWS: Final = 1.05
"""Real drift over that of the attached model from which on sliding is said to add to it."""
RULES: Final = {RULE: "estimate", "all, 1": None}
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


def percent(value: float | None, digits: int = 0, sign: str = "+") -> str:
    """Return a signed percentage with a true minus, or a dash; `sign` "-" leaves a plus away."""
    if value is None or not np.isfinite(value):
        return "\N{EN DASH}"
    return lettered(signed(value, f"{sign}.{digits}f")) + "\N{NO-BREAK SPACE}%"


def _by(value: Any) -> str:
    """What stands behind "underestimated by"."""
    return percent(_number(value), sign="-")


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


def one_line(result: StudyResult) -> str:
    """Return what the study found in one sentence."""
    summary = result.summary.filter(pl.col("underestimation_percent").is_finite())
    yielding = summary.filter(pl.col("R") > 1.0)
    shown = yielding if yielding.height else summary
    if not shown.height:
        return "No storey of the study has a result: runs failed."
    kind = "yielding" if yielding.height else "elastic"
    first = shown.filter(storey=1)
    means = ", ".join(
        f"{_by(missed.mean())} ({occupancy}: {_by(missed.min())} to {_by(missed.max())} in {missed.len()} buildings)"
        for (occupancy,), rows in first.group_by("occupancy", maintain_order=True)
        for missed in (rows["underestimation_percent"],)
    )
    worst = _by(shown["underestimation_percent"].max())
    return (
        f"With the share of the live load that {result.metadata['code']['name']} counts as mass, drifts of first "
        f"storeys of {kind} buildings are underestimated by {means} on average, and by up to {worst} in one storey."
    )


def answer(result: StudyResult) -> list[Markup]:
    """Return the sentences, a paragraph for each thing that a reader wants to know."""
    summary = result.summary.filter(pl.col("underestimation_percent").is_finite())
    yielding = summary.filter(pl.col("R") > 1.0)
    shown = yielding if yielding.height else summary
    if not shown.height:
        return [Markup("No storey of the study has a result: runs failed.")]
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
        mean=_by(missed.mean()),
        least=_by(missed.min()),
        most=_by(missed.max()),
        more=int((missed > 0.0).sum()),
        count=missed.len(),
        worst=_by(worst["underestimation_percent"]),
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
            "eta, the friction over the mean peak base shear coefficient with all goods attached, is {eta}; by hand, "
            "{rule}, {estimate} of the live load acts as mass. The effective fractions themselves were not computed."
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
    partial = known.filter(pl.col("eta") < 1.0)
    misses = ""
    if partial.height:
        missed = _number((partial["estimate"] - partial["effective"]).mean())
        words = lettered(signed(missed, "+.2f"))
        misses = f" In the {partial.height} buildings with eta below 1 the rule {RULE} misses it by {words} on average."
    return head + Markup(
        "The share of the live load that acts as mass is {parts}; eta is the friction coefficient over the base shear "
        "coefficient of the building with all goods attached.{misses}"
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
            "Attach {rule} of the live load as mass; run the study with "
            "<code>--effective</code> to see how far it holds for these motions."
        )
        return head + Markup(text).format(rule=RULE) + second
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


def findings_text(entries: list[dict[str, Any]]) -> str:
    """Return the findings as a few lines to read."""
    lines = []
    several = len({entry["mu"] for entry in entries}) > 1
    for entry in entries:
        design, analysis = (100.0 * entry[f"lambda_{use}"] for use in ("design", "analysis"))
        shares = f"{design:g} % of the live load"
        if design != analysis:
            shares += f" in the design, {analysis:g} % in the analysis"
        friction = f", mu = {entry['mu']:g}" if several else ""
        lines.append(f"{entry['occupancy']}{friction} ({entry['code']}: {shares})")
        if any(entry["collapses"].values()):
            counts = ", ".join(f"{model} {count}" for model, count in entry["collapses"].items())
            lines.append(f"  collapsed runs            {counts}")
        if entry["largest"] is None:
            lines.append("  no storey has a result")
            continue
        count, more, top = (entry[key] for key in ("storeys_compared", "code_gives_more", "code_gives_more_top"))
        growth = entry["growth"]
        lines += [
            f"  largest underestimation   {_place(entry['largest'])}",
            *_scatter(entry["largest"]),
            f"  smallest                  {_place(entry['smallest'])}",
            f"  code model gives more     in {more} of {count} storeys, {top} of them top storeys",
            f"  grows with alpha          {_growth_text(growth, 'alpha')}",
            f"  grows with R              {_growth_text(growth, 'R')}",
            *_first_storey_tables(entry["first_storey"]),
        ]
        if entry["storeys_without_result"]:
            lines.append(f"  without a mean            {entry['storeys_without_result']} storeys: a run failed")
    return "\n".join(lines)


def _place(row: dict[str, Any]) -> str:
    return (
        f"{change_text(row['underestimation_percent'])} (storey {row['storey']} of {row['storeys']}, R = {row['R']:g}, "
        f"alpha = {row['alpha']:g})"
    )


def _scatter(row: dict[str, Any]) -> list[str]:
    """What the largest is made of, and how it scatters."""
    median, low, high = (row[f"{name}_underestimation_percent"] for name in ("median", "p16", "p84"))
    lines = [
        f"    by mass, by sliding     {change_text(row['mass_percent'])} (all attached over code), "
        f"{change_text(row['sliding_percent'])} (goods slide over all attached)",
        f"    motion by motion        median {change_text(median)}, 16 to 84 %: {change_text(low)} to "
        f"{change_text(high)}",
    ]
    if row["leave_one_out_record"] is not None:
        lines.append(
            f"    without one motion      {change_text(row['leave_one_out_percent'])} ({row['leave_one_out_record']})"
        )
    return lines


def _growth_text(growth: dict[str, dict[str, int]], varied: str) -> str:
    every, first = growth[varied], growth[f"{varied}_first_storey"]
    return f"in {every['grows']} of {every['pairs']} steps, first storeys {first['grows']} of {first['pairs']}"


def _first_storey_tables(rows: list[dict[str, Any]]) -> list[str]:
    """Underestimation, what sliding does, and estimate of lambda side by side, a row for each R."""
    alphas = sorted({row["alpha"] for row in rows})
    row_of = {(row["R"], row["alpha"]): row for row in rows}
    effective = any(row["effective"] is not None for row in rows)
    shown: list[tuple[str, str, Callable[[float | None], str]]] = [
        ("goods slide / code", "underestimation_percent", change_text),
        ("goods slide / all", "sliding_percent", change_text),
        ("lambda, estimate", "estimate", number_text),
        *([(EFFECTIVE, "effective", number_text)] if effective else []),
    ]
    widths = (-20, *(max(7 * len(alphas), 19) + 2 for _ in shown))
    lines = [
        text_line(["first storeys, mean", *(title for title, *_ in shown)], widths),
        text_line(["  alpha", *("".join(f"{alpha:>7g}" for alpha in alphas) for _ in shown)], widths),
    ]
    for factor in sorted({row["R"] for row in rows}):
        cells = []
        for _, name, form in shown:
            values = [row_of.get((factor, alpha), {}).get(name) for alpha in alphas]
            cells.append("".join(f"{form(value):>7}" for value in values))
        lines.append(text_line([f"  R = {factor:g}", *cells], widths))
    return lines


DAMPING_TEXTS: Final = {
    "bare": "in the modes of the bare building, one matrix for all models",
    "loaded": "in the modes of the building with all its goods, one matrix for all models",
    "own": "in the modes of each model's own masses",
}
"""Damping bases as they are printed."""


def assumptions(metadata: dict[str, Any]) -> list[str]:
    """Return everything that a study assumes, sentence by sentence, from `StudyResult.metadata`."""
    inputs, suite, scaling = metadata["parameters"], metadata["suite"], metadata["scaling"]
    shortest, longest, _ = scaling["periods"]
    at_r1 = "yield at V_e" if inputs["yield_at_r1"] else "stay elastic"
    lines = [
        "Shear buildings: rigid floors of equal mass, storeys of equal stiffness, one direction, no loss of strength.",
        f"Springs: trilinear with Masing unloading, Omega = {inputs['overstrength']:g}, r2 = "
        f"{inputs['second_slope']:g}, r3 = {inputs['third_slope']:g}. The paper states Omega = 2 for its section 4 "
        "only, and neither slope.",
        f"Strength: V_y = V_e/R by response spectrum analysis ({inputs['combination'].upper()}) under the mean scaled "
        f"spectrum, with the design's share of the live load as mass. Buildings of R = 1 {at_r1}.",
        f"Damping: {100.0 * inputs['damping']:g} % {DAMPING_TEXTS[inputs['damping_base']]}.",
        "Goods: one rigid block on every floor but the roof, Coulomb friction with mu_s = mu_k; no rocking, no impact.",
        f"Motions: {motions_text(suite)} ({suite['name']}); one component each, all of equal weight in the means.",
        f"Scaling: {scaling['method']}, for T = {inputs['scaling_period']:g} s: mean not below the target from "
        f"{shortest:.3g} to {longest:.3g} s.",
        f"Target: {metadata['target']['label']}.",
        "P-Delta: the whole weight of building and goods, in every model alike."
        if inputs["p_delta"]
        else "P-Delta: none.",
        f"Capped mean drift: {CAPPED_MEAN}. The cap is {inputs['drift_cap']:g} of the height, and ends no run.",
    ]
    if inputs["collapse_drift_ratio"] is not None:
        lines.append(f"Collapse: a storey whose drift reaches {inputs['collapse_drift_ratio']:g} of its height.")
    for name, row in metadata["code"]["fractions"].items():
        source = "; ".join(part for part in (row["clause"], row["status"]) if part)
        lines.append(f"Code: {metadata['code']['name']}, {name}: {row['fraction']:g} of the live load ({source}).")
    return lines


def provenance(metadata: dict[str, Any]) -> dict[str, str]:
    """Return from what the numbers of a study were made, by name."""
    counts = metadata["counts"]
    return {
        "Program": f"seismass {metadata['package_version']}",
        "Processor instructions": f"{metadata['instructions']}; the same bits wherever they are used",
        "Format of the tables": f"version {metadata['schema_version']}",
        "Inputs, SHA-256": metadata["inputs_sha256"],
        "Analyses": f"{counts['analyses']} of {counts['buildings']} buildings, {counts['distinct']} distinct: "
        f"{counts['completed']} completed, {counts['collapsed']} collapsed, {counts['failed']} failed",
        **dict(_option(name, value) for name, value in metadata["parameters"].items()),
    }


_PARAMETERS: Final = {
    "buildings": "Buildings",
    "response_modification": "Response modification factors R",
    "mass_ratios": "Goods over floor mass, \N{GREEK SMALL LETTER ALPHA}",
    "occupancies": "Share of the goods that the code counts",
    "code": "Code",
    "mu": "Friction, \N{GREEK SMALL LETTER MU}",
    "overstrength": "Overstrength, \N{GREEK CAPITAL LETTER OMEGA}",
    "second_slope": "Slope after the first yield over the initial one, r2",
    "third_slope": "Slope after the second yield over the initial one, r3",
    "damping": "Damping ratio",
    "damping_base": "Damping",
    "scaling_period": "Period for which motions are scaled",
    "combination": "Combination of modes",
    "yield_at_r1": "Buildings of R = 1",
    "height": "Storey height",
    "p_delta": "P-Delta",
    "collapse_drift_ratio": "Collapse",
    "drift_cap": "Drift cap",
}
"""Parameters in words."""


def _option(name: str, value: Any) -> tuple[str, str]:
    """A parameter in words, its value with its unit."""
    if name == "buildings":
        text = ", ".join(f"{storeys} storeys, {period:g} s" for storeys, period in value)
    elif name == "occupancies":
        text = ", ".join(
            f"{use} {design:g}" + ("" if design == analysis else f" in the design, {analysis:g} in the analysis")
            for use, design, analysis in value
        )
    elif name == "damping_base":
        text = DAMPING_TEXTS[value]
    elif name == "yield_at_r1":
        text = "yield at V_e" if value else "stay elastic"
    elif name == "collapse_drift_ratio":
        text = "only where P-Delta says so" if value is None else f"at a drift of {value:g} of the height"
    elif name == "combination":
        text = value.upper()
    else:
        text = _plain_option(value)
    unit = {"scaling_period": " s", "height": " m", "drift_cap": " of the height"}.get(name, "")
    return _PARAMETERS[name], f"{text}{unit}"


def _plain_option(value: Any) -> str:
    """Numbers with commas, yes or no, a text."""
    if isinstance(value, list | tuple):
        return ", ".join(_plain_option(item) for item in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:g}" if isinstance(value, float) else str(value)
