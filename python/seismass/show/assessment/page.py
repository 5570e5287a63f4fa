"""The page of an assessment, for the calculation folder: answer, input, checks, result, advice, limits, provenance."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import polars as pl
from markupsafe import Markup

from seismass.assessment.models import ADVISED, BARE, NAMES, REAL, REAL_HIGH, REAL_LOW
from seismass.base.units import STANDARD_GRAVITY
from seismass.effective_mass.estimate import RULE, RULE_IN_WORDS, SAFE_RULE
from seismass.effective_mass.result import KIND_TEXTS
from seismass.effective_mass.rules import BY_HAND
from seismass.media.page import Section, facts_html, figure_html, page_html, table_html, text_html
from seismass.media.svg import short_svg
from seismass.media.text_table import number_text
from seismass.model.codes import AS_STATED, NOT_CHECKED, VERIFIED
from seismass.show.assessment.box import answer_lines, box_class
from seismass.show.assessment.tables import AssessmentTables, Fraction
from seismass.show.study.page import bullets_html, long_html

LIMITS: Final = (
    "Shear buildings, in each direction by themselves: no torsion, no flexible floors, no foundation.",
    "Rigid goods that slide by Coulomb friction; goods that rock, topple, strike or deform are not covered.",
    "Trilinear storeys without loss of strength but by P-Delta; Omega, r2 and r3 decide about large drifts.",
    "The interval of a fraction resamples these motions, and is 0.05 wider at each end for another suite.",
    "This page checks drift and stability of a model. It replaces neither the design of members nor the judgement of "
    "the engineer who signs it.",
)
"""What the page does not cover."""


def building_page(result: AssessmentTables, drawings: Mapping[str, str]) -> str:
    """Return the page as HTML.

    Parameters
    ----------
    result : AssessmentTables
        The assessment, as its folder holds it.
    drawings : mapping of str to str
        SVG texts of its figures, by name.

    Returns
    -------
    str
        A page that needs nothing but itself; equal tables give equal pages.
    """
    document = result.document
    sections = [
        Section("Input as understood", _input(result)),
        Section("Checks", [_checks(result)]),
        Section("Effective fraction", _fractions(result, drawings)),
        Section("Drifts", _drifts(result, drawings)),
        *([Section("Slip of the goods", _slip(result, drawings))] if result.slip.height else []),
        Section("In an analysis", [bullets_html(document["advice"]), *_masses(result)]),
        Section("Remarks", [bullets_html(document["remarks"] or ["None."])]),
        Section("Assumptions", [bullets_html(document["assumptions"])]),
        Section("Limits of this page", [bullets_html(list(LIMITS))]),
        Section("Provenance", _provenance(result)),
    ]
    lead = [Markup('<div class="{}">{}</div>').format(box_class(result), text_html(*answer_lines(result)))]
    version = f"seismass {document['metadata']['package_version']}"
    subtitle = "; ".join(part for part in (document["note"], version) if part)
    return page_html(document["name"] or "Building", sections, subtitle=subtitle, lead=lead)


def _number(value: float | None, digits: int = 2) -> str:
    return number_text(value, f".{digits}f", missing="\N{EN DASH}", infinite="\N{EN DASH}")


def _interval(fraction: Fraction) -> str:
    if fraction.interval is None:
        return "\N{EN DASH}"
    return f"{_number(fraction.interval[0])} to {_number(fraction.interval[1])}"


def _input(result: AssessmentTables) -> list[Markup]:
    given, code, document = result.document["input"], result.code, result.document
    rule = given["design"]
    facts = {
        "Weight of the building": f"{1e-3 * given['weight']:.0f} kN",
        "Weight of the goods present": f"{1e-3 * given['weight_of_goods']:.0f} kN, "
        f"{100.0 * result.present_share:.0f} % of the design live load",
        "First period": f"{given['period_bare']:.3f} s without goods, {given['period_attached']:.3f} s with all "
        "attached",
        "Damping": f"{100.0 * given['damping']:g} % in the modes of the building without goods",
        "Strength": "as stated"
        if rule is None
        else f"V_y = V_e/R, R = {rule['R']:g}, {rule['combination'].upper()}, with {rule['fraction']:g} of the design "
        "live load",
        "P-Delta": "with the weight of building and goods" if given["p_delta"] else "none",
        "Bounds of friction": "{:g} and {:g} times mu".format(*given["mu_factors"]),
        "Code": f"{code['code']}, {code['use']}: {code['share_of_design_live_load']:.3g} of the design live load"
        + "".join(f"; {code[name]}" for name in ("clause", "status", "note") if code[name])
        + ("" if code["status"] in (VERIFIED, AS_STATED) else f"; {NOT_CHECKED}"),
        "Site spectrum": "none" if document["target"] is None else document["target"]["label"],
        "Motions": f"{document['suite']['name']}: {', '.join(document['suite']['motions'])}",
    }
    if given["file"]:
        facts = {"File": given["file"], **facts}
    storeys = pl.DataFrame(given["storeys"], infer_schema_length=None).drop("live_load", "bolted", "goods")
    names = {
        "height": "height (m)",
        "mass": "mass (t)",
        "stiffness": "stiffness (kN/mm)",
        "yield_shear": "V_y (kN)",
        "overstrength": "Omega",
        "second_slope": "r2",
        "third_slope": "r3",
        "code_fraction": "code's fraction",
        "code_exception": "why",
    }
    thousandth = dict.fromkeys(("mass", "yield_shear"), _thousandth)
    formats: dict[str, Any] = {**thousandth, "stiffness": lambda value: f"{1e-6 * value:.1f}"}
    unused = [name for name in ("name", "code_exception") if not any(storeys[name])]
    caption = "Storeys, from the ground up; the code's fraction is that of the design live load of the floor."
    return [
        facts_html(facts),
        table_html(
            storeys.drop(unused),
            caption,
            headers={name: header for name, header in names.items() if name not in unused},
            formats=formats,
        ),
        *_goods(given["goods"]),
    ]


def _goods(rows: list[dict[str, Any]]) -> list[Markup]:
    """Goods of each kind on each floor."""
    if not rows:
        return []
    goods = pl.DataFrame(rows, infer_schema_length=None).select(
        "floor",
        "name",
        pl.col("live_load") * STANDARD_GRAVITY,
        "occupied",
        "presence",
        pl.when("attached").then(pl.lit("bolted")).otherwise("contact").alias("contact"),
        "mu_s",
        "mu_k",
    )
    unused = [name for name in ("name", "contact") if not any(goods[name])]
    return [
        table_html(
            goods.drop(unused).rename({} if "name" in unused else {"name": "goods"}),
            "Goods, kind by kind. Bolted ones are part of the mass of their floor.",
            headers={
                "live_load": "design live load (kN)",
                "occupied": "present",
                "presence": "how that is known",
            },
            formats={"live_load": _thousandth, "occupied": ".2f", "presence": long_html, "mu_s": ".3g", "mu_k": ".3g"},
        )
    ]


def _thousandth(value: float) -> str:
    return f"{1e-3 * value:.0f}"


def _checks(result: AssessmentTables) -> Markup:
    table = result.checks.with_columns(
        model=pl.col("model").replace_strict(NAMES, default=pl.col("model"), return_dtype=pl.String),
        met=pl.col("met").cast(pl.String).replace_strict({"true": "met", "false": "not met"}, default="no value"),
    )
    return table_html(
        table.select("check", "model", "storey", "value", "limit", "met", "source"),
        "Largest value over the storeys beside its limit. Drift and stability are those of the means over the motions.",
        headers={"met": "verdict", "source": "limit by"},
        formats={"met": _verdict, "value": ".4g", "limit": ".4g", "source": long_html},
    )


def _verdict(text: str) -> Markup:
    looks = {"met": "good", "not met": "warn"}
    return Markup('<span class="{}">{}</span>').format(looks.get(text, ""), text)


def _figure(drawings: Mapping[str, str], name: str, caption: str, alt: str) -> Markup:
    return figure_html(short_svg(drawings[name]), caption, alt) if name in drawings else Markup("")


def _fractions(result: AssessmentTables, drawings: Mapping[str, str]) -> list[Markup]:
    if not result.effective:
        return [text_html("There are no goods on the floors.")]
    low, high = result.mu_factors
    words = {REAL: "as stated", REAL_HIGH: f"{high:g} times", REAL_LOW: f"{low:g} times"}
    rows = [
        {
            "friction": words[model],
            "value": "no value" if math.isnan(one.value) else f"{one.value:.2f}",
            "interval": _interval(one) + ("" if one.statistic == "mean" else f", by the {one.statistic}"),
            "kind": f"{one.kind}: {KIND_TEXTS[one.kind]}",
            "eta": one.eta,
            "estimate": one.estimate,
            "conservative": one.conservative,
            "by_hand": one.by_hand.estimate,
        }
        for model, one in result.effective.items()
    ]
    real = result.effective[REAL]
    rule = real.by_hand
    return [
        _figure(
            drawings,
            "effective_fraction",
            "Mean largest drift with sliding goods over that of the model, against the share of the goods attached.",
            f"The curve for friction as stated crosses one at a share of {_number(real.value)}."
            if math.isfinite(real.value)
            else "For friction as stated there is no share.",
        ),
        table_html(
            pl.DataFrame(rows),
            f"Effective fraction of the goods present by friction; C1 = {real.base_shear_coefficient:.4f} is the mean "
            f"peak base shear of the runs with all goods attached over the weight of all, eta = mu_k/C1; without a run "
            f"C1 = {rule.base_shear_coefficient:.4f} and eta = {rule.eta:.3f}. {RULE_IN_WORDS}: here p = "
            f"{rule.exponent:.2f}, T = {rule.period:.3g} s, T_c = {rule.corner_period:.3g} s, h_g/h_m = "
            f"{rule.height_ratio:.2f}.",
            headers={
                "value": "effective fraction",
                "interval": f"{100.0 * real.confidence:g} % interval",
                "estimate": RULE,
                "conservative": f"{SAFE_RULE}, conservative",
                "by_hand": BY_HAND,
            },
            formats={
                "kind": long_html,
                **dict.fromkeys(("eta", "estimate", "conservative", "by_hand"), ".2f"),
            },
        ),
    ]


def _drifts(result: AssessmentTables, drawings: Mapping[str, str]) -> list[Markup]:
    ratio = result.drift_limit is not None
    scale, unit = (1e2, "%") if ratio else (1e3, "mm")
    names = {name: f"{name} ({unit})" for name in ("mean", "p16", "median", "p84", "max")}
    names["p16"], names["p84"] = f"16 % ({unit})", f"84 % ({unit})"
    further = ["motions_above_limit", "theta"] if ratio else []
    table = result.storeys.with_columns(
        model=pl.col("model").replace_strict(NAMES, default=pl.col("model"), return_dtype=pl.String)
    ).select("model", "storey", "name", *names, *further, "collapsed")
    if not any(table["name"]):
        table = table.drop("name")
    headers = {**names, "collapsed": "collapsed runs"}
    if ratio:
        headers |= {"motions_above_limit": "motions above the limit", "theta": "stability coefficient"}
    worst = result.storeys.drop_nulls("mean").sort("mean", descending=True)
    said = "No model has a mean."
    if worst.height:
        row = worst.row(0, named=True)
        said = f"The largest mean is {scale * row['mean']:.2f} {unit}, storey {row['storey']}, {NAMES[row['model']]}."
    return [
        *([_governing(result, scale, unit)] if result.answer is not None else []),
        _figure(
            drawings,
            "drift",
            "Mean peak drift of each storey by model, with 16 to 84 % of the motions"
            + (", beside the limit." if ratio else "."),
            said,
        ),
        table_html(
            table,
            f"Peak drift of each storey ({'% of the height' if ratio else 'mm'}) by model over the motions.",
            headers=headers,
            formats={
                **dict.fromkeys(names, lambda value: f"{scale * value:.2f}"),
                **({"theta": ".3f"} if ratio else {}),
            },
        ),
    ]


def _governing(result: AssessmentTables, scale: float, unit: str) -> Markup:
    """Both analyses and all frictions, storey by storey."""
    low, high = result.mu_factors
    headers = {
        ADVISED: f"analysis 1 ({unit})",
        BARE: f"analysis 2 ({unit})",
        REAL: f"goods slide, mu as stated ({unit})",
        REAL_HIGH: f"mu x {high:g} ({unit})",
        REAL_LOW: f"mu x {low:g} ({unit})",
        "governing": f"governs ({unit})",
        "limit": f"limit ({unit})",
        "governed_by": "governed by",
    }
    shown = [name for name in headers if result.governing[name].null_count() < result.governing.height]
    table = result.governing.select("storey", "name", *shown)
    if not any(table["name"]):
        table = table.drop("name")
    drifts = [name for name in shown if name != "governed_by"]
    return table_html(
        table,
        "Mean peak drift of each storey in both analyses and with goods that slide; the largest governs.",
        headers={name: headers[name] for name in shown},
        formats=dict.fromkeys(drifts, lambda value: f"{scale * value:.2f}"),
    )


def _masses(result: AssessmentTables) -> list[Markup]:
    """What to type into another program."""
    if result.answer is None:
        return []
    table = result.masses
    if not any(table["name"]):
        table = table.drop("name")
    return [
        table_html(
            table,
            "Mass of each floor in both analyses, for another program, and the multiplier of the design live load in "
            "its mass source.",
            headers={
                "mass_1": "analysis 1: mass (t)",
                "weight_1": "weight (kN)",
                "multiplier_1": "multiplier of the live load",
                "mass_2": "analysis 2: mass (t)",
                "weight_2": "weight (kN)",
                "multiplier_2": "multiplier",
            },
            formats={
                **dict.fromkeys(("mass_1", "mass_2"), lambda value: f"{1e-3 * value:.1f}"),
                **dict.fromkeys(("weight_1", "weight_2"), _thousandth),
                "multiplier_1": ".2f",
                "multiplier_2": ".2f",
            },
        )
    ]


def _slip(result: AssessmentTables, drawings: Mapping[str, str]) -> list[Markup]:
    names = {
        "peak_mean": "peak, mean (mm)",
        "peak_median": "median (mm)",
        "peak_p84": "84 % (mm)",
        "peak_max": "largest (mm)",
        "residual_mean": "residual, mean (mm)",
        "residual_p84": "84 % (mm)",
    }
    largest = result.slip["peak_max"].drop_nulls().to_numpy()
    table = result.slip.select("friction", "floor", "name", "goods", "mu_s", "mu_k", "motions_that_slide", *names)
    table = table.drop([name for name in ("name", "goods") if not any(table[name])])
    return [
        _figure(
            drawings,
            "slip",
            "Slip of the goods of each floor by friction: what aisles and edges must allow for.",
            f"The largest slip of any motion is {1e3 * float(largest.max()) if largest.size else 0.0:.0f} mm.",
        ),
        table_html(
            table,
            "Peak and residual slip over the motions.",
            headers={**names, "motions_that_slide": "motions in which goods slide"},
            formats={**dict.fromkeys(names, lambda value: f"{1e3 * value:.1f}"), "mu_s": ".3g", "mu_k": ".3g"},
        ),
    ]


def _provenance(result: AssessmentTables) -> list[Markup]:
    about = result.document["metadata"]
    facts = {
        "Program": f"seismass {about['package_version']}",
        "Instruction set": str(about["instructions"]),
        "Version of the tables": str(about["schema_version"]),
        "Inputs (SHA-256)": about["inputs_sha256"],
        "Bootstrap": f"{about['resamples']} resamples, seed {about['seed']}",
        "Runs": f"{result.runs.filter(storey=1).height} of {len(result.document['collapses'])} models under "
        f"{about['motions']} motions",
    }
    parts = [facts_html(facts)]
    if result.scaling is not None:
        parts.append(
            table_html(
                result.scaling,
                "Scaling factors.",
                headers={
                    "motion": "number",
                    "record": "motion",
                    "individual_factor": "own factor",
                    "common_factor": "common factor",
                },
                formats=dict.fromkeys(("individual_factor", "common_factor", "factor"), ".4f"),
            )
        )
    return parts
