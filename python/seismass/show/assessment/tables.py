"""What a folder of an assessment holds, as its page and figures need it: from an assessment, or read again."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from typing import Any, Final, NamedTuple

import polars as pl

from seismass.assessment.checks import ANALYSES, ONE_ANALYSIS
from seismass.assessment.models import ADVISED, BARE, CODE, SLIDING, SLIDING_ALL
from seismass.assessment.result import SCHEMA_VERSION, Assessment
from seismass.base.errors import InvalidOption
from seismass.base.folders import ReadFolder
from seismass.base.units import STANDARD_GRAVITY, UNITS, Units
from seismass.base.values import brief, refusal
from seismass.effective_mass import ByHand
from seismass.effective_mass.share import Kind
from seismass.model.scene import Scene

DOCUMENT: Final = "assessment.json"
"""File by which a folder is known as that of an assessment."""
NEEDED: Final = ("storeys", "governing", "analysis", "slip", "runs", "checks", "spectra")
ANIMATION: Final = "animation.json"
"""File of what the animation shows."""
FIGURES: Final = ("drift", "effective_fraction", "slip", "spectrum")
"""Names of all figures, those of earlier versions too; what is not written again is removed."""
TABLES: Final = ("storeys", "governing", "analysis", "slip", "runs", "checks", "spectra", "curve", "scaling")
"""Names of all tables, likewise."""


@dataclass(frozen=True)
class Fraction:
    """Effective fraction at one friction, as figures draw it; the names are those of `EffectiveMass`, `interval` is its
    `suite_interval`.
    """

    value: float
    kind: Kind
    interval: tuple[float, float] | None
    confidence: float
    statistic: str
    real: float
    model: float
    eta: float
    base_shear_coefficient: float
    by_hand: ByHand
    curve: pl.DataFrame = field(repr=False)


@dataclass(frozen=True, eq=False)
class AssessmentTables:
    """What the page of an assessment is made of: assessment.json and the tables, effective fractions by friction, and
    the animation where it was made.
    """

    document: dict[str, Any]
    storeys: pl.DataFrame = field(repr=False)
    governing: pl.DataFrame = field(repr=False)
    analysis: pl.DataFrame = field(repr=False)
    slip: pl.DataFrame = field(repr=False)
    runs: pl.DataFrame = field(repr=False)
    checks: pl.DataFrame = field(repr=False)
    spectra: pl.DataFrame = field(repr=False)
    scaling: pl.DataFrame | None = field(repr=False)
    effective: dict[str, Fraction] = field(repr=False)
    animation: dict[str, Any] | None = field(repr=False)

    @property
    def answer(self) -> dict[str, Any] | None:
        """The answer, as assessment.json has it; None where there is none."""
        answer: dict[str, Any] | None = self.document["answer"]
        return answer

    @property
    def units(self) -> Units:
        """Units in which the page is."""
        return UNITS[self.document["input"]["units"]]

    @property
    def advised(self) -> float | None:
        """Share of the goods present to attach in analysis 1; None where there is no answer."""
        return None if self.answer is None else float(self.answer["advised_share_of_goods_present"])

    @property
    def called(self) -> dict[str, str]:
        """What the analyses are called by their models: a pair, or one where both are the same."""
        single = self.answer is not None and len(self.answer["pair"]) == 1
        return {BARE: ONE_ANALYSIS[BARE]} if single or not self.effective else ANALYSES

    @property
    def present_share(self) -> float:
        """Goods present over the design live load."""
        return float(self.document["input"]["goods_present_over_design_live_load"])

    @property
    def code(self) -> dict[str, Any]:
        """The code: its name, use, fraction, range, clause, status and note."""
        code: dict[str, Any] = self.document["code"]
        return code

    @property
    def clearances(self) -> dict[int, float]:
        """Clearance of the stops of goods (m) by floor, where there are some."""
        goods = self.document["input"]["goods"]
        return {kind["floor"]: kind["stops"]["clearance"] for kind in goods if kind["stops"]}

    @property
    def mu_factors(self) -> tuple[float, float]:
        """Factors of friction for its bounds."""
        low, high = self.document["input"]["mu_factors"]
        return low, high

    @property
    def drift_limit(self) -> float | None:
        """Limit of the drift ratio; None without heights."""
        limit: float | None = self.document["input"]["drift_limit"]
        return limit

    @property
    def storey_names(self) -> list[str]:
        """A name per storey, or empty texts."""
        return [row["name"] for row in self.document["input"]["storeys"]]


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


def assessment_tables(result: Assessment, *, animated: bool = False) -> AssessmentTables:
    """Return what a folder of the assessment holds, with the animation, which needs a run, only where it is asked for;
    in two directions a page has none.
    """
    shown = _animation(result) if animated and result.example.scene.other_direction is False else None
    return _made(json.loads(result.to_json()), result.tables, shown)


def _is_animated(scene: Scene) -> bool:
    """Whether an animation can show a scene: one direction, on firm ground."""
    return scene.base is None and scene.other_direction is False


def read_assessment_tables(files: ReadFolder) -> AssessmentTables:
    """Read the files of the folder of an assessment."""
    document = files.document(DOCUMENT)
    if document.get("schema_version") != SCHEMA_VERSION:
        got = brief(document.get("schema_version"))
        raise refusal(InvalidOption, "schema_version", DOCUMENT, f"{SCHEMA_VERSION}", got)
    optional = (["curve"] if document["effective"] else []) + (["scaling"] if document["factors"] else [])
    tables = {name: files.table(name) for name in (*NEEDED, *optional)}
    return _made(document, tables, files.document(ANIMATION) if ANIMATION in files else None)


def _animation(result: Assessment) -> dict[str, Any] | None:
    """The building under the motion in the middle, beside the model with the code's share, as values of JSON."""
    shown, building = result.example, result.building
    if not _is_animated(shown.scene):
        return None
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
    content: dict[str, Any] = json.loads(json.dumps({"about": facts, "element": element_content(animation)}))
    return content


def _made(
    document: dict[str, Any], tables: dict[str, pl.DataFrame], animation: dict[str, Any] | None
) -> AssessmentTables:
    effective = {
        model: _fraction(values, tables["curve"].filter(model=model)) for model, values in document["effective"].items()
    }
    needed, scaling = {name: tables[name] for name in NEEDED}, tables.get("scaling")
    return AssessmentTables(document, **needed, scaling=scaling, effective=effective, animation=animation)


def _fraction(values: dict[str, Any], curve: pl.DataFrame) -> Fraction:
    """A fraction of its JSON, in which non-finite values are null."""

    def number(value: float | None) -> float:
        return math.nan if value is None else float(value)

    names = ("value", "real", "model", "eta", "base_shear_coefficient", "confidence")
    ends, rule = values["suite_interval"], values["by_hand"]
    rule = rule | {"friction": number(rule["friction"]), "exceptions": tuple(rule["exceptions"])}
    return Fraction(
        **{name: number(values[name]) for name in names},
        kind=values["kind"],
        statistic=values["statistic"],
        by_hand=ByHand(**rule),
        interval=None if ends is None else (number(ends[0]), number(ends[1])),
        curve=curve,
    )


def quantity_text(value: float, unit: str, units: Units) -> str:
    """Return a quantity of a design as offices write it."""
    if unit == "N":
        return units.text("force", value)
    return f"{value:.3f} s" if unit == "s" else f"{value:.4g}"
