"""One's own building in the live page: its case there, and what that page cannot express of it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.media.live_address import MOST_STOREYS, LiveCase
from seismass.show.assessment.tables import AssessmentTables

ALIKE = 1e-6
"""By how much numbers may differ, relatively, that the live page has as one."""


class OwnCase(NamedTuple):
    """What the live page opens: the building (None where it cannot be shown, with `reasons`), and what is different
    there, each a sentence without its stop.
    """

    case: LiveCase | None
    reasons: tuple[str, ...]
    differences: tuple[str, ...]


def own_case(result: AssessmentTables) -> OwnCase:
    """Return the case of an assessed building."""
    given = result.document["input"]
    storeys, goods = given["storeys"], [kind for kind in given["goods"] if not kind["attached"] and kind["mass"] > 0.0]
    reasons = []
    if len(storeys) > MOST_STOREYS:
        reasons.append(f"it has {len(storeys)} storeys, and the live page solves up to {MOST_STOREYS}")
    if given["other_direction"] is not None:
        reasons.append("it moves in two directions")
    if given["base"] is not None:
        reasons.append("it stands on a sliding base")
    if given["walls"]:
        reasons.append("it has walls")
    if any(kind["rack"] is not None for kind in goods):
        reasons.append("its goods stand on racks")
    if any(kind["stops"] is not None for kind in goods):
        reasons.append("its goods have stops")
    if given["damping_from_storey"] > 1:
        reasons.append("its lowest storeys are not damped")
    strength = [row["yield_shear"] for row in storeys]
    if any(value is None for value in strength) and any(value is not None for value in strength):
        reasons.append("some of its storeys yield and others stay elastic")
    if reasons:
        return OwnCase(None, tuple(reasons), ())
    case, differences = _case(result, storeys, goods), _differences(result, storeys, goods)
    if case.beyond:
        return OwnCase(None, (f"its numbers are out of the range of the live page ({', '.join(case.beyond)})",), ())
    return OwnCase(case, (), differences)


def _case(result: AssessmentTables, storeys: list[dict[str, Any]], goods: list[dict[str, Any]]) -> LiveCase:
    given = result.document["input"]
    mass = np.array([row["mass"] for row in storeys])
    heights = [row["height"] for row in storeys if row["height"] is not None]
    weight = STANDARD_GRAVITY * float(mass.sum())
    ratio, static, kinetic = np.zeros(len(storeys)), np.zeros(len(storeys)), np.zeros(len(storeys))
    for kind in goods:
        floor = kind["floor"] - 1
        ratio[floor] += kind["mass"] / mass.mean()
        # Several kinds become one with their mean friction.
        static[floor] += kind["mass"] / mass.mean() * kind["mu_s"]
        kinetic[floor] += kind["mass"] / mass.mean() * kind["mu_k"]
    loaded = ratio > 0.0
    least = [float(one["mu_s"]) for one in goods[:1]] or [0.2]
    mu_s = np.where(loaded, static / np.where(loaded, ratio, 1.0), least[0])
    mu_k = np.where(loaded, kinetic / np.where(loaded, ratio, 1.0), least[0])
    elastic = any(row["yield_shear"] is None for row in storeys)
    counted = result.code["share_of_design_live_load"] / result.present_share if result.present_share > 0.0 else 0.0
    return LiveCase(
        period=given["period_bare"],
        damping=given["damping"],
        overstrength=float(np.mean([row["overstrength"] for row in storeys])),
        second_slope=float(np.mean([row["second_slope"] for row in storeys])),
        height=float(np.mean(heights)) if heights else 3.5,
        strength=() if elastic else [row["yield_shear"] / weight for row in storeys],
        mass_ratio=ratio.tolist(),
        mu_s=mu_s.tolist(),
        mu_k=mu_k.tolist(),
        counted=min(1.0, counted),
    )


def _differences(
    result: AssessmentTables, storeys: list[dict[str, Any]], goods: list[dict[str, Any]]
) -> tuple[str, ...]:
    given = result.document["input"]
    found = ["motions are the seven built-in ones, scaled to their own target, not those of this page"]
    for name, words in (
        ("mass", "floor masses are equal: their mean"),
        ("stiffness", "storey stiffnesses are equal: those of the same first period"),
        ("height", "storey heights are equal: their mean"),
        ("overstrength", "Omega is one number: the mean"),
        ("second_slope", "r2 is one number: the mean"),
    ):
        if not _alike([row[name] for row in storeys]):
            found.append(words)
    if any(row["height"] is None for row in storeys):
        found.append("storeys are 3.5 m high, since heights are not known here")
    if any(row["third_slope"] for row in storeys):
        found.append("the slope after the second yield, r3, is 0")
    if given["p_delta"]:
        found.append("there is no P-Delta")
    floors = [kind["floor"] for kind in goods]
    if len(set(floors)) < len(floors):
        found.append("kinds of goods on a floor are one, with their mean friction")
    if given["collapse_drift_ratio"] is not None:
        found.append("no storey counts as collapsed")
    if result.present_share > 0.0 and result.code["share_of_design_live_load"] > result.present_share:
        found.append("the model of the code has all goods present attached, no more")
    return tuple(found)


def _alike(values: list[float | None]) -> bool:
    known = [value for value in values if value is not None]
    return not known or max(known) - min(known) <= ALIKE * abs(max(known))
