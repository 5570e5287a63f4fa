"""Input of an assessment as it was understood: each quantity in the units of offices, and where it comes from."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, Final, NamedTuple

import numpy as np
import polars as pl
from markupsafe import Markup

from seismass.assessment.models import median_of
from seismass.assessment.result import Assessment
from seismass.base.errors import MissingPackage
from seismass.base.units import STANDARD_GRAVITY, UNITS, Units
from seismass.media.page import (
    DIFFERENCES,
    MOST_STOREYS,
    LiveCase,
    bullets_html,
    described_html,
    facts_html,
    figure_html,
    long_html,
    text_html,
    whole_html,
)
from seismass.media.page import PAGE as LIVE_PAGE
from seismass.media.roles import MU, OMEGA, isolated, lettered, sentence_html
from seismass.media.svg import short_svg
from seismass.model.codes import NOT_CHECKED
from seismass.motions.records.builtin import builtin_suite
from seismass.show.animation.html import element_html
from seismass.show.explore import kernel_file
from seismass.show.explore.page import site_factors

SPRINGS: Final = f"Springs: {OMEGA}, r2, r3"
LEFT_OUT: Final = ("pgv", "pgd", "fraction", "governing")
"""Columns of the table `left_out` that stand beside factors."""
MOST_MOTIONS: Final = 12
"""Motions that are named here."""


def input_html(result: Assessment) -> list[Markup]:
    """Return facts of the whole building, the table of its storeys and that of its goods."""
    return [facts_html(facts(result)), _storeys(result), *_goods(result)]


def facts(result: Assessment) -> dict[str, str]:
    """Return facts of the whole building by their names."""
    data, code, target, units = result.input, result.code, result.content["target"], result.units
    known: dict[str, str] = {}
    if data["file"]:
        known["File"] = isolated(data["file"])
    known |= {
        "Weight without loose goods": units.both("force", data["weight"]),
        "Weight of the goods present": f"{units.both('force', data['weight_of_goods'])}, "
        f"{100.0 * result.present_share:.0f} % of the design live load",
        "First period": f"{data['period_bare']:.3f} s without goods, {data['period_attached']:.3f} s with all",
        "Stiffness": _with_source(_stiffness_words(data), data, "stiffness", "period"),
        "Strength": _with_source(_strength_words(data), data, "strength", "design", "reduction"),
        SPRINGS: _with_source(
            "; ".join(_values(data["storeys"], name) for name in ("overstrength", "second_slope", "third_slope"))
            + " (second yield over the first, slopes after both over the initial one)",
            data,
            "overstrength",
            "second_slope",
            "third_slope",
        ),
        "Damping": _with_source(
            f"{100.0 * data['damping']:g} % of critical in the modes of the building without goods", data, "damping"
        ),
        **_further(data),
        "P-Delta": _with_source(
            "with the weight of building and goods" if data["p_delta"] else "none", data, "p_delta"
        ),
        "Bounds of friction": _with_source(
            f"{result.mu_factors[0]:g} and {result.mu_factors[1]:g} times {MU}", data, "mu_factors"
        ),
        "Limits": _with_source(_limits(data), data, "drift_limit", "theta_limit"),
        "Code": _with_source(
            f"{code.code}, {result.content['code']['uses']}: {result.code_share:.3g} of the design live load"
            + "".join(f"; {part}" for part in (code.clause, code.status, code.note) if part)
            + ("" if code.checked else f"; {NOT_CHECKED}"),
            data,
            "code",
        ),
        "Site spectrum": _with_source("none" if target is None else target["label"], data, "site"),
        "Motions": _motions(result.suite),
    }
    return known


def _motions(suite: dict[str, Any]) -> Markup:
    names = suite["motions"]
    if len(names) > MOST_MOTIONS:
        return Markup("{}: {} motions, listed below with their factors").format(isolated(suite["name"]), len(names))
    return Markup("{}: {}").format(isolated(suite["name"]), whole_html(map(isolated, names)))


def _further(data: dict[str, Any]) -> dict[str, str]:
    """What few buildings have: another direction, a sliding base."""
    facts: dict[str, str] = {}
    other, base, units = data["other_direction"], data["base"], UNITS[data["units"]]
    if other is not None:
        rule = "as stated" if other["R"] is None else f"by design with R = {other['R']:g}"
        strength = [value for value in other["yield_shear"] if value is not None]
        ends = [units.text("force", end) for end in (min(strength), max(strength))] if strength else []
        tail = f", V_y {' to '.join(ends)}" if strength else ", elastic"
        stiffness = " to ".join(
            units.text("stiffness", end) for end in (min(other["stiffness"]), max(other["stiffness"]))
        )
        facts["Other direction, y"] = (
            f"first period {other['period_bare']:.3f} s without goods, {other['period_attached']:.3f} s with all; "
            f"stiffness {stiffness}; strengths {rule}{tail}; the table of "
            "storeys is that of x"
        )
    if base is not None:
        pendulum = "" if base["radius"] is None else f", pendulum of radius {units.text('height', base['radius'])}"
        facts["Sliding base"] = f"{MU}_s {base['mu_s']:g}, {MU}_k {base['mu_k']:g}{pendulum}"
    return facts


def _with_source(text: str, data: dict[str, Any], *names: str) -> Markup:
    """A value, and in small letters below it the keys of the file that state it."""
    sources = [data["sources"][name] for name in names if name in data["sources"]]
    stated = [source for source in sources if source != "default"]
    words = "; ".join(dict.fromkeys(stated)) if stated else "default" if sources else ""
    small = Markup('<small class="source">{}</small>').format(words) if words else ""
    return Markup("{}{}").format(sentence_html(text), small)


def _stiffness_words(data: dict[str, Any]) -> str:
    if data["period_stated"] is None:
        return "as stated, storey by storey"
    mass = {"bare": "no goods", "code share": "the code's share of the goods", "all": "all goods"}[data["period_mass"]]
    return f"from a first period of {data['period_stated']:.3g} s with {mass} as mass"


def _strength_words(data: dict[str, Any]) -> str:
    rule = data["design"]
    if rule is None:
        return "as stated"
    return (
        f"by {data['code_of_design']}: V_y = V_e I/R, R = {rule['R']:g}, response spectrum analysis "
        f"({rule['combination'].upper()}), with "
        f"{rule['fraction']:.3g} of the design live load as mass"
    )


def _limits(data: dict[str, Any]) -> str:
    if data["drift_limit"] is None:
        return "none, since heights are not known"
    return f"drift {100.0 * data['drift_limit']:g} % of the height; stability coefficient {data['theta_limit']:g}"


def _values(storeys: list[dict[str, Any]], name: str) -> str:
    """One number, or the least and the largest."""
    values = [row[name] for row in storeys]
    return f"{values[0]:g}" if min(values) == max(values) else f"{min(values):g} to {max(values):g}"


def _storeys(result: Assessment) -> Markup:
    data = result.input
    rows, sources, units = data["storeys"], data["sources"], result.units
    table = pl.DataFrame(rows, infer_schema_length=None).with_columns(
        dead_load=STANDARD_GRAVITY * (pl.col("mass") - pl.col("bolted")) / pl.col("area").cast(pl.Float64),
        load=STANDARD_GRAVITY
        * (pl.col("live_load") + pl.Series([_bolted_load(result, row["storey"]) for row in rows], dtype=pl.Float64))
        / pl.col("area").cast(pl.Float64),
    )
    names = {
        "height": f"height ({units.unit('height')})",
        "area": f"area ({units.unit('area')})",
        "dead_load": f"dead load ({units.unit('load')})",
        "load": f"design live load ({units.unit('load')})",
        "mass": f"mass ({units.unit('mass')})",
        "stiffness": f"stiffness ({units.unit('stiffness')})",
        "yield_shear": f"V_y ({units.unit('force')})",
        "use": "use",
        "code_fraction": "code's fraction",
        "code_exception": "why",
    }
    quantities = {name: name for name in ("height", "area", "mass", "stiffness")}
    quantities |= {"dead_load": "load", "load": "load", "yield_shear": "force"}
    formats = {name: partial(units.number, quantity) for name, quantity in quantities.items()}
    known = {"height": "height", "area": "area", "dead_load": "dead load", "live_load": "live load"}
    notes = "; ".join(f"{words}: {sources[name]}" for name, words in known.items() if name in sources)
    caption = (
        "Storeys, from the ground up. The mass is that of the floor without loose goods; the code's fraction is that "
        f"of the design live load of the floor. From {notes}."
        if notes
        else "Storeys, from the ground up."
    )
    shown = table.select("storey", "name", *names)
    return described_html("assessment: storeys", shown, caption, headers=names, formats=formats)


def _bolted_load(result: Assessment, storey: int) -> float:
    """Design live load of the bolted goods of a floor (kg)."""
    kinds = result.input["goods"]
    return sum(float(kind["live_load"]) for kind in kinds if kind["attached"] and kind["floor"] == storey)


def _goods(result: Assessment) -> list[Markup]:
    """Goods of each kind on each floor."""
    rows, units = result.input["goods"], result.units
    if not rows:
        return []
    area = {row["storey"]: row["area"] for row in result.input["storeys"]}
    sources = result.input["sources"]
    table = pl.DataFrame(rows, infer_schema_length=None).with_columns(
        pl.Series("area", [np.nan if area[row["floor"]] is None else area[row["floor"]] for row in rows]),
        contact=pl.when("attached").then(pl.lit("bolted")).otherwise("contact"),
        size=pl.Series([_size(units, row.get("size")) for row in rows], dtype=pl.String),
    )
    shown = table.select(
        "floor",
        goods="name",
        load=STANDARD_GRAVITY * pl.col("live_load") / pl.col("area"),
        weight=STANDARD_GRAVITY * pl.col("live_load"),
        occupied="occupied",
        presence="presence",
        contact="contact",
        mu_s="mu_s",
        mu_k="mu_k",
        size="size",
    ).with_columns(pl.col("load").fill_nan(None))
    headers = {
        "load": f"design live load ({units.unit('load')})",
        "weight": f"of the floor ({units.unit('force')})",
        "occupied": "present",
        "presence": "how that is known",
        "contact": "contact",
        "size": f"size of one ({units.unit('height')})",
    }
    parts = "".join(
        f" {words}: {sources[name]}."
        for name, words in (("present", "Present"), ("friction", "Friction"))
        if name in sources
    )
    return [
        described_html(
            "assessment: slip",
            shown,
            f"Goods, kind by kind. Bolted ones are part of the mass of their floor.{parts}",
            headers=headers,
            formats={
                "load": partial(units.number, "load"),
                "weight": partial(units.number, "force"),
                "occupied": ".2f",
                "presence": long_html,
            },
        )
    ]


def _size(units: Units, size: dict[str, float] | None) -> str:
    return "" if size is None else " x ".join(units.number("height", size[name]) for name in ("width", "height"))


class Outcome(NamedTuple):
    """What the live page opens: the building (None where it cannot be shown, with `reasons`), and what is different
    there, each a sentence without its stop.
    """

    case: LiveCase | None
    reasons: tuple[str, ...]
    differences: tuple[str, ...]


def live_case(result: Assessment) -> Outcome:
    """Return the case of an assessed building."""
    data = result.input
    storeys, loose = data["storeys"], [kind for kind in data["goods"] if not kind["attached"] and kind["mass"] > 0.0]
    reasons = []
    if len(storeys) > MOST_STOREYS:
        reasons.append(f"it has {len(storeys)} storeys, and the live page solves up to {MOST_STOREYS}")
    if data["other_direction"] is not None:
        reasons.append("it moves in two directions")
    if data["base"] is not None:
        reasons.append("it stands on a sliding base")
    if data["walls"]:
        reasons.append("it has walls")
    if any(kind["rack"] is not None for kind in loose):
        reasons.append("its goods stand on racks")
    if any(kind["stops"] is not None for kind in loose):
        reasons.append("its goods have stops")
    if result.content.get("tipping"):
        reasons.append("some of its goods tip before they slide")
    if data["damping_from_storey"] > 1:
        reasons.append("its lowest storeys are not damped")
    strength = [row["yield_shear"] for row in storeys]
    if any(value is None for value in strength) and any(value is not None for value in strength):
        reasons.append("some of its storeys yield and others stay elastic")
    if reasons:
        return Outcome(None, tuple(reasons), ())
    case = _case(result, storeys, loose)
    if case.out_of_range:
        return Outcome(
            None, (f"its numbers are out of the range of the live page ({', '.join(case.out_of_range)})",), ()
        )
    return Outcome(case, (), tuple(DIFFERENCES[key] for key in case.differs))


def _case(result: Assessment, storeys: list[dict[str, Any]], loose: list[dict[str, Any]]) -> LiveCase:
    data = result.input
    mass = np.array([row["mass"] for row in storeys])
    stiffness = np.array([row["stiffness"] for row in storeys])
    weight = STANDARD_GRAVITY * float(mass.sum())
    ratio, static, kinetic = np.zeros(len(storeys)), np.zeros(len(storeys)), np.zeros(len(storeys))
    for kind in loose:
        floor = kind["floor"] - 1
        ratio[floor] += kind["mass"] / mass.mean()
        # Several kinds become one with their mean friction.
        static[floor] += kind["mass"] / mass.mean() * kind["mu_s"]
        kinetic[floor] += kind["mass"] / mass.mean() * kind["mu_k"]
    loaded = ratio > 0.0
    least = [float(one["mu_s"]) for one in loose[:1]] or [0.2]
    mu_s = np.where(loaded, static / np.where(loaded, ratio, 1.0), least[0])
    mu_k = np.where(loaded, kinetic / np.where(loaded, ratio, 1.0), least[0])
    elastic = any(row["yield_shear"] is None for row in storeys)
    counted = result.code_share / result.present_share if result.present_share > 0.0 else 0.0
    suite, fraction = result.suite, result.effective.get("real")
    is_built_in = suite["motions"] == [record.name for record in builtin_suite("seven")]
    site = None if is_built_in else site_factors(result.content["target"], data["period_attached"])
    factors = (result.content["factors"] or [1.0] * len(suite["motions"])) if is_built_in else site
    known = {key: [row[key] for row in storeys] for key in ("overstrength", "second_slope", "third_slope")}
    cap = data["drift_cap"]
    differs = {
        "motions": site is not None,
        "scale": not is_built_in and site is None,
        "kinds": len({kind["floor"] for kind in loose}) < len(loose),
        "bolted": any(kind["attached"] for kind in data["goods"]),
        "height": any(row["height"] is None for row in storeys),
        "gravity": data["p_delta"] and data["sources"].get("gravity_load", "default") != "default",
        "capped": cap is not None and bool((result.storeys["max"] > cap).any()),
        "median": fraction is not None and fraction.statistic != "mean",
        "collapse": data["collapse_drift_ratio"] is not None,
        "counted": counted > 1.0,
    }
    answer = (
        ()
        if fraction is None or fraction.suite_interval is None
        else (fraction.value, *fraction.suite_interval, len(suite["motions"]))
    )
    return LiveCase(
        period=data["period_bare"],
        damping=data["damping"],
        p_delta=data["p_delta"],
        height=[3.5 if row["height"] is None else row["height"] for row in storeys],
        strength=() if elastic else [row["yield_shear"] / weight for row in storeys],
        mass_ratio=ratio.tolist(),
        mu_s=mu_s.tolist(),
        mu_k=mu_k.tolist(),
        mass=(mass / mass.mean()).tolist(),
        stiffness=(stiffness / stiffness[0]).tolist(),
        counted=min(1.0, counted),
        present=result.present_share or 1.0,
        factors=factors or (),
        answer=answer,
        differs=[key for key, holds in differs.items() if holds],
        **known,
    )


class Pictures:
    """Drawings by name, as figures of the page, each with the one for phones."""

    def __init__(self, drawings: Mapping[str, str], for_phones: Mapping[str, str]) -> None:
        self._drawings, self._for_phones = drawings, for_phones

    @property
    def sheet(self) -> Markup:
        """The figure of drifts and slips of the first sheet."""
        words = "What each storey uses of its drift limit, and the slip of its floor; the table below has the numbers."
        drawn = self._for_phones.get("sheet")
        if drawn is None:
            return Markup("")
        return figure_html(short_svg(drawn), "", words, narrow=short_svg(self._for_phones["drift"]))

    def figure(self, name: str, caption: str, alt: str) -> Markup:
        """Return one figure; nothing where there is no such drawing."""
        if name not in self._drawings:
            return Markup("")
        narrow = short_svg(self._for_phones[name]) if name in self._for_phones else None
        return figure_html(short_svg(self._drawings[name]), caption, alt, narrow=narrow)


def names_of(result: Assessment) -> list[str]:
    """Return the names of the user's that sentences may contain."""
    kinds = [kind["name"] for kind in result.input["goods"]]
    return [result.name, result.suite["name"], *result.storey_names, *kinds, *result.suite["motions"]]


def motions_html(result: Assessment, pictures: Pictures) -> list[Markup]:
    """Return on which motions the answer stands, their spectra, and their factors."""
    data, target, units = result.input, result.content["target"], result.units
    site = "" if target is None else " beside the site spectrum"
    parts = [
        text_html(sentence_html(f"The answer stands {result.answer.motions}.")),
        pictures.figure(
            "spectrum",
            f"Spectra of the motions as they load the building{site}; first periods without goods and with all.",
            f"Mean and scatter of the spectra of the motions{site}; first periods {data['period_bare']:.3g} and "
            f"{data['period_attached']:.3g} s.",
        ),
    ]
    if "scaling" in result.tables:
        left_out = pl.DataFrame(result.content["left_out"], schema=dict.fromkeys(LEFT_OUT, pl.Float64))
        parts.append(
            described_html(
                "assessment: left_out scaling",
                result.tables["scaling"].hstack(left_out),
                "Scaling factors: that of each motion is its own times the common one. PGV and PGD when scaled; "
                "largest effective fraction and governing drift without the motion.",
                units={
                    "m/s": (units.unit("velocity"), partial(units.number, "velocity")),
                    "m": (units.unit("displacement"), partial(units.number, "displacement")),
                },
                headers={"motion": "number", "record": "motion"},
            )
        )
    return parts


def in_motion_html(result: Assessment) -> list[Markup]:
    """Return the building under one motion, and the way to the live page."""
    parts = []
    if result.animation is not None:
        facts = result.animation["about"]
        slides = bool((result.runs["peak_slip"] > 0.0).any())
        model_words = (
            f", beside a model with {100.0 * facts['fraction']:.0f} % of the goods present attached, the code's share"
        )
        parts += [
            text_html(
                sentence_html(
                    f"Under {facts['motion']}, motion {facts['number']}, scaled by {facts['factor']:.3g} to a peak of "
                    f"{facts['peak_g']:.2f} g: the motion with the {median_of(slides)}"
                    f"{model_words if result.effective else ''}.",
                    names_of(result),
                )
            ),
            element_html(result.animation["element"]),
        ]
    return [*parts, *_live(result)]


def _live(result: Assessment) -> list[Markup]:
    case, reasons, differences = live_case(result)
    if case is None:
        return [text_html(f"The live page cannot show this building: {'; '.join(reasons)}.")]
    try:
        kernel_file()
    except MissingPackage:
        return [text_html("There is no live page beside this one: the package has no kernel for browsers.")]
    link = Markup(
        'The live page, {page} in the folder of this page, <a href="{page}#{address}">shows this building</a>{differs}'
    ).format(page=LIVE_PAGE, address=case.address, differs=". What differs there:" if differences else ".")
    return [text_html(link), *([bullets_html(f"{lettered(line)}." for line in differences)] if differences else [])]
