"""Input of an assessment as it was understood: each quantity in the units of offices, and where it comes from."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl
from markupsafe import Markup

from seismass.base.units import STANDARD_GRAVITY
from seismass.media.isolate import isolated, sentence_html
from seismass.media.page import facts_html, table_html
from seismass.media.page_lists import long_html, whole_html
from seismass.media.roles import MU, OMEGA
from seismass.model.codes import AS_STATED, NOT_CHECKED, VERIFIED
from seismass.show.assessment.tables import AssessmentTables

MOST_MOTIONS: Final = 12
"""Motions that are named here."""


def input_html(result: AssessmentTables) -> list[Markup]:
    """Return facts of the whole building, the table of its storeys and that of its goods."""
    return [facts_html(_facts(result)), _storeys(result), *_goods(result)]


def _facts(result: AssessmentTables) -> dict[str, str]:
    given, code, document = result.document["input"], result.code, result.document
    facts: dict[str, str] = {}
    if given["file"]:
        facts["File"] = isolated(given["file"])
    facts |= {
        "Weight without loose goods": f"{1e-3 * given['weight']:.0f} kN",
        "Weight of the goods present": f"{1e-3 * given['weight_of_goods']:.0f} kN, "
        f"{100.0 * result.present_share:.0f} % of the design live load",
        "First period": f"{given['period_bare']:.3f} s without goods, {given['period_attached']:.3f} s with all",
        "Stiffness": _with_source(_stiffness_words(given), given, "stiffness", "period"),
        "Strength": _with_source(_strength_words(given), given, "strength", "design", "reduction"),
        f"Springs: {OMEGA}, r2, r3": _with_source(
            "; ".join(_values(given["storeys"], name) for name in ("overstrength", "second_slope", "third_slope"))
            + " (second yield over the first, slopes after both over the initial one)",
            given,
            "overstrength",
            "second_slope",
            "third_slope",
        ),
        "Damping": _with_source(
            f"{100.0 * given['damping']:g} % of critical in the modes of the building without goods", given, "damping"
        ),
        **_further(given),
        "P-Delta": _with_source(
            "with the weight of building and goods" if given["p_delta"] else "none", given, "p_delta"
        ),
        "Bounds of friction": _with_source(
            f"{result.mu_factors[0]:g} and {result.mu_factors[1]:g} times {MU}", given, "mu_factors"
        ),
        "Limits": _with_source(_limits(given), given, "drift_limit", "theta_limit"),
        "Code": _with_source(
            f"{code['code']}, {code['use']}: {code['share_of_design_live_load']:.3g} of the design live load"
            + "".join(f"; {code[name]}" for name in ("clause", "status", "note") if code[name])
            + ("" if code["status"] in (VERIFIED, AS_STATED) else f"; {NOT_CHECKED}"),
            given,
            "code",
        ),
        "Site spectrum": _with_source(
            "none" if document["target"] is None else document["target"]["label"], given, "site"
        ),
        "Motions": _motions(document["suite"]),
    }
    return facts


def _motions(suite: dict[str, Any]) -> Markup:
    names = suite["motions"]
    if len(names) > MOST_MOTIONS:
        return Markup("{}: {} motions, listed below with their factors").format(isolated(suite["name"]), len(names))
    return Markup("{}: {}").format(isolated(suite["name"]), whole_html(map(isolated, names)))


def _further(given: dict[str, Any]) -> dict[str, str]:
    """What few buildings have: another direction, a sliding base."""
    facts: dict[str, str] = {}
    other, base = given["other_direction"], given["base"]
    if other is not None:
        rule = "as stated" if other["R"] is None else f"by design with R = {other['R']:g}"
        strength = [1e-3 * value for value in other["yield_shear"] if value is not None]
        said = f", V_y {min(strength):.0f} to {max(strength):.0f} kN" if strength else ", elastic"
        stiffness = [1e-6 * value for value in other["stiffness"]]
        facts["Other direction, y"] = (
            f"first period {other['period_bare']:.3f} s without goods, {other['period_attached']:.3f} s with all; "
            f"stiffness {min(stiffness):.1f} to {max(stiffness):.1f} kN/mm; strengths {rule}{said}; the table of "
            "storeys is that of x"
        )
    if base is not None:
        pendulum = "" if base["radius"] is None else f", pendulum of radius {base['radius']:g} m"
        facts["Sliding base"] = f"{MU}_s {base['mu_s']:g}, {MU}_k {base['mu_k']:g}{pendulum}"
    return facts


def _with_source(text: str, given: dict[str, Any], *names: str) -> Markup:
    """A value, and in small letters below it the keys of the file that state it."""
    found = [given["sources"][name] for name in names if name in given["sources"]]
    stated = [source for source in found if source != "default"]
    said = "; ".join(dict.fromkeys(stated)) if stated else "default" if found else ""
    small = Markup('<small class="source">{}</small>').format(said) if said else ""
    return Markup("{}{}").format(sentence_html(text), small)


def _stiffness_words(given: dict[str, Any]) -> str:
    if given["period_stated"] is None:
        return "as stated, storey by storey"
    mass = {"bare": "no goods", "code share": "the code's share of the goods", "all": "all goods"}[given["period_mass"]]
    return f"from a first period of {given['period_stated']:.3g} s with {mass} as mass"


def _strength_words(given: dict[str, Any]) -> str:
    rule = given["design"]
    if rule is None:
        return "as stated"
    return (
        f"by design: V_y = V_e/R, R = {rule['R']:g}, response spectrum analysis ({rule['combination'].upper()}), with "
        f"{rule['fraction']:.3g} of the design live load as mass"
    )


def _limits(given: dict[str, Any]) -> str:
    if given["drift_limit"] is None:
        return "none, since heights are not known"
    return f"drift {100.0 * given['drift_limit']:g} % of the height; stability coefficient {given['theta_limit']:g}"


def _values(storeys: list[dict[str, Any]], name: str) -> str:
    """One number, or the least and the largest."""
    values = [row[name] for row in storeys]
    return f"{values[0]:g}" if min(values) == max(values) else f"{min(values):g} to {max(values):g}"


def _storeys(result: AssessmentTables) -> Markup:
    given = result.document["input"]
    rows, sources = given["storeys"], given["sources"]
    table = pl.DataFrame(rows, infer_schema_length=None).with_columns(
        dead_load=1e-3 * STANDARD_GRAVITY * (pl.col("mass") - pl.col("bolted")) / pl.col("area").cast(pl.Float64),
        load=1e-3
        * STANDARD_GRAVITY
        * (pl.col("live_load") + pl.Series([_bolted_load(result, row["storey"]) for row in rows], dtype=pl.Float64))
        / pl.col("area").cast(pl.Float64),
    )
    names = {
        "storey": "storey",
        "name": "name",
        "height": "height (m)",
        "area": "area (m\N{SUPERSCRIPT TWO})",
        "dead_load": "dead load (kPa)",
        "load": "design live load (kPa)",
        "mass": "mass (t)",
        "stiffness": "stiffness (kN/mm)",
        "yield_shear": "V_y (kN)",
        "use": "use",
        "code_fraction": "code's fraction",
        "code_exception": "why",
    }
    unused = [name for name in ("name", "code_exception") if not any(table[name])]
    unused += [name for name in ("height", "area", "dead_load", "load") if table[name].null_count() == table.height]
    shown = [name for name in names if name not in unused]
    thousandth = dict.fromkeys(("mass", "yield_shear"), thousandth_text)
    formats: dict[str, Any] = {
        **thousandth,
        "stiffness": lambda value: f"{1e-6 * value:.1f}",
        "area": lambda value: f"{value:g}",
        **dict.fromkeys(("dead_load", "load"), ".3g"),
    }
    known = {"height": "height", "area": "area", "dead_load": "dead load", "live_load": "live load"}
    said = "; ".join(f"{words}: {sources[name]}" for name, words in known.items() if name in sources)
    caption = (
        "Storeys, from the ground up. The mass is that of the floor without loose goods; the code's fraction is that "
        f"of the design live load of the floor. From {said}."
        if said
        else "Storeys, from the ground up."
    )
    return table_html(
        table.select(shown),
        caption,
        headers={name: names[name] for name in shown},
        formats={name: form for name, form in formats.items() if name in shown},
    )


def _bolted_load(result: AssessmentTables, storey: int) -> float:
    """Design live load of the bolted goods of a floor (kg)."""
    kinds = result.document["input"]["goods"]
    return sum(float(kind["live_load"]) for kind in kinds if kind["attached"] and kind["floor"] == storey)


def _goods(result: AssessmentTables) -> list[Markup]:
    """Goods of each kind on each floor."""
    rows = result.document["input"]["goods"]
    if not rows:
        return []
    area = {row["storey"]: row["area"] for row in result.document["input"]["storeys"]}
    sources = result.document["input"]["sources"]
    table = pl.DataFrame(rows, infer_schema_length=None).with_columns(
        pl.Series("area", [np.nan if area[row["floor"]] is None else area[row["floor"]] for row in rows]),
        contact=pl.when("attached").then(pl.lit("bolted")).otherwise("contact"),
    )
    goods = table.select(
        "floor",
        "name",
        load=1e-3 * STANDARD_GRAVITY * pl.col("live_load") / pl.col("area"),
        weight=1e-3 * STANDARD_GRAVITY * pl.col("live_load"),
        occupied="occupied",
        presence="presence",
        contact="contact",
        mu_s="mu_s",
        mu_k="mu_k",
    ).with_columns(pl.col("load").fill_nan(None))
    unused = [name for name in ("name", "contact") if not any(goods[name])]
    unused += ["load"] if goods["load"].null_count() == goods.height else []
    headers = {
        "name": "goods",
        "load": "design live load (kPa)",
        "weight": "of the floor (kN)",
        "occupied": "present",
        "presence": "how that is known",
        "mu_s": f"{MU}_s",
        "mu_k": f"{MU}_k",
    }
    said = "".join(
        f" {words}: {sources[name]}."
        for name, words in (("present", "Present"), ("friction", "Friction"))
        if name in sources
    )
    return [
        table_html(
            goods.drop(unused),
            f"Goods, kind by kind. Bolted ones are part of the mass of their floor.{said}",
            headers={name: words for name, words in headers.items() if name not in unused},
            formats={
                **({} if "load" in unused else {"load": ".3g"}),
                "weight": ".0f",
                "occupied": ".2f",
                "presence": long_html,
                "mu_s": ".3g",
                "mu_k": ".3g",
            },
        )
    ]


def thousandth_text(value: float) -> str:
    """Return a value in SI units as thousands of them: kN, t."""
    return f"{1e-3 * value:.0f}"
