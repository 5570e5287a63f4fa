"""What text, figures and pages of an assessment have in common: drifts and slips by storey, and the animation."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any, NamedTuple

import polars as pl

from seismass.assessment.models import ADVISED, BARE, CODE, SLIDING, SLIDING_ALL
from seismass.assessment.result import Assessment
from seismass.base.units import STANDARD_GRAVITY, Units
from seismass.media.result import Format, stored_tables


class StoreyDrifts(NamedTuple):
    """Drifts of a storey as figure and terminal draw them, over the limit or (without heights) in m: of analyses by
    their numbers, range of goods that slide over the frictions, 16 and 84 % of the motions at the worst of these.
    """

    storey: int
    name: str
    analyses: dict[str, float]
    sliding: tuple[float, float] | None
    scatter: tuple[float, float] | None
    code: float | None
    largest: float
    model: str


def storey_drifts(storeys: pl.DataFrame, governing: pl.DataFrame) -> list[StoreyDrifts]:
    """Return the drifts of each storey, storey 1 first."""
    rows = []
    first, second = (storeys.filter(model=name)["mean"] for name in (ADVISED, BARE))
    numbers = {"1": ADVISED, "2": BARE} if first.len() and not first.equals(second) else {"1": BARE}
    if first.len() == 0 and (storeys["model"] == SLIDING).any():
        numbers = {"0": BARE}  # there is no answer
    for row in governing.iter_rows(named=True):
        of_storey = storeys.filter(storey=row["storey"])
        unit = row["limit"] or 1.0
        means = {name: mean / unit for name, mean in of_storey.select("model", "mean").iter_rows()}
        slides = {name: means[name] for name in SLIDING_ALL if name in means}
        worst = max(slides, key=lambda name: slides[name]) if slides else BARE
        ends = [of_storey.filter(model=worst)[name][0] for name in ("p16", "p84")]
        rows.append(
            StoreyDrifts(
                storey=row["storey"],
                name=row["name"],
                analyses={number: means[name] for number, name in numbers.items()},
                sliding=(min(slides.values()), max(slides.values())) if slides else None,
                scatter=None if None in ends else (ends[0] / unit, ends[1] / unit),
                code=means.get(CODE),
                largest=row["governing"] / unit,
                model=short_words(row["governed_by"]),
            )
        )
    return rows


def short_words(model: str | None) -> str:
    """Return what governs a storey as a column or the edge of a row has room for it: "slide, mu x 1.5"."""
    return (model or "").replace("goods slide", "slide").replace("mu as stated", "mu").removeprefix("the analysis")


def most_slip(slip: pl.DataFrame) -> dict[int, dict[str, Any]]:
    """Return of each floor the row of slips with the largest at 84 % of the motions, over kinds and frictions."""
    known = slip.drop_nulls("peak_p84").sort("peak_p84", descending=True)
    return {row["floor"]: row for row in reversed(known.to_dicts())}


def slip_units(result: Assessment) -> dict[str, tuple[str, Format]]:
    """Return the unit of slips in tables, and how they are written."""
    return {"m": (result.units.unit("slip"), lambda value: result.units.number("slip", value, ".1f"))}


def analysis_table(result: Assessment) -> tuple[pl.DataFrame, dict[str, Any]]:
    """Return masses, weights and multipliers of the analyses, one or both, and what `described` takes with them."""
    table, units, rows = result.analysis.clone(), result.units, stored_tables("assessment")["analysis"][1]
    table.columns = list(rows)  # those of files in US units are called by other units
    called = dict(zip((2,) if len(result.called) == 1 else (1, 2), result.called.values(), strict=True))
    in_units = {"t": (units.unit("mass"), units.of("mass")[2]), "kN": (units.unit("force"), ".0f")}
    headers = {f"mass_{number}_t": f"{words}: {rows['mass_1_t']['header']}" for number, words in called.items()}
    names = [name for name in rows if 1 in called or "_1" not in name]
    return table.select(names), {"units": in_units, "headers": headers}


def animated(result: Assessment) -> Assessment:
    """Return an assessment with what the animation of its page shows, the building under the motion in the middle,
    beside the model with the code's share; as it is in two directions, and where it was read.
    """
    if result.solved is None:
        return result
    shown, building = result.example, result.building
    if shown.scene.other_direction is not False:
        return result
    from seismass.show.animation import animate
    from seismass.show.animation.html import element_content

    fraction = building.present_code_share
    name = building.code.code
    animation = animate(shown.scene, shown.motion, fraction=fraction, code_name=name, title=building.name)
    facts = {
        "motion": result.suite["motions"][shown.number - 1],
        "number": shown.number,
        "factor": shown.factor,
        "peak_g": float(abs(shown.motion.acceleration).max()) / STANDARD_GRAVITY,
        "fraction": fraction,
    }
    element = element_content(animation)
    return replace(result, animation=json.loads(json.dumps({"about": facts, "element": element})))


def quantity_text(value: float, unit: str, units: Units) -> str:
    """Return a quantity of a design as offices write it."""
    if unit == "N":
        return units.text("force", value)
    return f"{value:.3f} s" if unit == "s" else f"{value:.4g}"
