"""What an assessment gives back: the share to attach, tables by storey and floor, advice, and every assumption."""

from __future__ import annotations

import copy
import math
from collections.abc import Collection
from dataclasses import asdict, dataclass, field
from typing import Any, ClassVar, Final, NamedTuple

import polars as pl

from seismass.assessment.answer import ANALYSIS, Answer, analysis_table, stored_answer
from seismass.assessment.building import OwnBuilding
from seismass.assessment.checks import ANALYSES, ONE_ANALYSIS, checks_table, input_document
from seismass.assessment.models import BARE, Shown
from seismass.assessment.structure import design_table
from seismass.base.errors import InvalidOption
from seismass.base.folders import ReadFolder
from seismass.base.units import UNITS, Units
from seismass.base.values import FieldValue, brief, refusal
from seismass.design.scaling import ScalingResult
from seismass.effective_mass import EffectiveMass
from seismass.effective_mass.result import stored_fraction
from seismass.media.result import StoredResult, StoredTable, finite_values
from seismass.model.codes import CodeFraction
from seismass.motions.spectra import TargetSpectrum

SCHEMA_VERSION: Final = 10
"""Version of the tables and of the JSON of an assessment."""


class Solved(NamedTuple):
    """What a folder of an assessment does not hold: the building, its target, the share for a design, factors of the
    motions, and the run that is shown.
    """

    building: OwnBuilding
    target: TargetSpectrum | None
    design: EffectiveMass | None
    scaling: ScalingResult | None
    example: Shown


@dataclass(frozen=True, eq=False)
class Assessment(FieldValue, StoredResult):
    """How much of a building's live load acts as mass, and how the building and its goods move.

    Its tables are attributes by their names, without rows where there is none: `storeys`, `governing`, `slip`,
    `tipping`, `runs` and others. Columns are listed in docs/building_file.md.

    Attributes
    ----------
    content : dict
        What `assessment.json` holds, in SI units.
    answer : Answer
        The pair of analyses, what governs which storey, why this share, on which motions; or why there is none.
    effective : dict of str to EffectiveMass
        Effective fractions of the goods present, by friction: "real" as stated, "real_mu_low" and "real_mu_high" at its
        bounds. Empty without goods.
    frames : dict of str to polars.DataFrame
        What `tables` gives: storeys, governing, analysis, slip, runs, left_out, slips, checks, spectra, design; curve,
        tipping, scaling if known.
    solved : Solved or None
        What only an assessment has that was not read from a folder.
    animation : dict or None
        What the animation of a page shows, where it was made.
    """

    document: ClassVar[str] = "assessment"
    schema_version: ClassVar[int] = SCHEMA_VERSION

    content: dict[str, Any] = field(repr=False)
    answer: Answer
    effective: dict[str, EffectiveMass]
    frames: dict[str, pl.DataFrame] = field(repr=False)
    solved: Solved | None = field(default=None, repr=False)
    animation: dict[str, Any] | None = field(default=None, repr=False)

    storeys = StoredTable()
    governing = StoredTable()
    analysis = StoredTable()
    slip = StoredTable()
    tipping = StoredTable()
    runs = StoredTable()
    left_out = StoredTable()
    slips = StoredTable()
    checks = StoredTable()
    spectra = StoredTable()

    @classmethod
    def _without(cls, document: dict[str, Any], files: ReadFolder) -> Collection[str]:
        there = {"curve": document["effective"], "tipping": document["tipping"], "scaling": document["factors"]}
        return [name for name, rows in there.items() if not rows]

    @classmethod
    def _stored(
        cls, document: dict[str, Any], frames: dict[str, pl.DataFrame], animation: dict[str, Any] | None
    ) -> Assessment:
        effective = {
            model: stored_fraction(values, frames["curve"].filter(model=model).drop("model"))
            for model, values in document["effective"].items()
        }
        return cls(document, stored_answer(document), effective, frames, animation=animation)

    def __repr__(self) -> str:
        return f"<Assessment of {self.name}: {self.answer.headline}>"

    def _solved(self) -> Solved:
        if self.solved is None:
            need = "one that was not read from a folder, which does not hold building, target, scaling and runs"
            raise refusal(InvalidOption, "assessment", "call", need, brief(self.name))
        return self.solved

    @property
    def building(self) -> OwnBuilding:
        """What was assessed."""
        return self._solved().building

    @property
    def target(self) -> TargetSpectrum | None:
        """Site spectrum; None where motions were taken as they are and strengths were stated."""
        return self._solved().target

    @property
    def design(self) -> EffectiveMass | None:
        """Share that a design of the strengths and the analysis have in common, at the friction that decides; see
        `seismass.effective_mass_of_design`. None where strengths are stated, and without an answer.
        """
        return self._solved().design

    @property
    def scaling(self) -> ScalingResult | None:
        """Factors of the motions; None where they were taken as they are."""
        return self._solved().scaling

    @property
    def example(self) -> Shown:
        """The building under the motion with the median drift of those under which goods slide."""
        return self._solved().example

    @property
    def name(self) -> str:
        """Name of the building."""
        return str(self.content["name"])

    @property
    def input(self) -> dict[str, Any]:
        """The input as it was understood, in SI units."""
        inputs: dict[str, Any] = self.content["input"]
        return inputs

    @property
    def suite(self) -> dict[str, Any]:
        """Name of the suite and names of its motions; how many are synthetic."""
        suite: dict[str, Any] = self.content["suite"]
        return suite

    @property
    def collapses(self) -> dict[str, int]:
        """Collapsed runs of each model."""
        collapses: dict[str, int] = self.content["collapses"]
        return collapses

    @property
    def advice(self) -> tuple[str, ...]:
        """What to use in an analysis."""
        return tuple(self.content["advice"])

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is unlikely about the input, and what to know about the numbers."""
        return tuple(self.content["remarks"])

    @property
    def assumptions(self) -> tuple[str, ...]:
        """Everything that was assumed."""
        return tuple(self.content["assumptions"])

    @property
    def metadata(self) -> dict[str, Any]:
        """Schema and package version, digest of the inputs, seed, conventions."""
        metadata: dict[str, Any] = self.content["metadata"]
        return metadata

    @property
    def advised(self) -> float | None:
        """Share of the goods present to attach in analysis 1; None where there is no answer.

        The largest of the effective fractions for friction as stated and at its bounds, rounded up to 0.01.
        """
        return self.answer.analyses[0].share_of_goods_present if self.answer.analyses else None

    @property
    def advised_of_live_load(self) -> float | None:
        """The advised mass over the design live load of the whole building, to compare with the fraction of a code."""
        return None if self.advised is None else self.advised * self.present_share

    @property
    def called(self) -> dict[str, str]:
        """What the analyses are called by their models: a pair, or one where both are the same."""
        return {BARE: ONE_ANALYSIS[BARE]} if len(self.answer.pair) == 1 or not self.effective else ANALYSES

    @property
    def units(self) -> Units:
        """Units in which the assessment is shown."""
        return UNITS[self.input["units"]]

    @property
    def present_share(self) -> float:
        """Goods present over the design live load."""
        return float(self.input["goods_present_over_design_live_load"])

    @property
    def code(self) -> CodeFraction:
        """The code whose fraction stands beside the answer."""
        code = self.content["code"]
        return CodeFraction(**{name: code[name] for name in CodeFraction.__dataclass_fields__})

    @property
    def code_share(self) -> float:
        """Share of the design live load of the whole building that the code counts."""
        return float(self.content["code"]["share_of_design_live_load"])

    @property
    def clearances(self) -> dict[int, float]:
        """Clearance of the stops of goods (m) by floor, where there are some."""
        return {kind["floor"]: kind["stops"]["clearance"] for kind in self.input["goods"] if kind["stops"]}

    @property
    def mu_factors(self) -> tuple[float, float]:
        """Factors of friction for its bounds."""
        low, high = self.input["mu_factors"]
        return low, high

    @property
    def drift_limit(self) -> float | None:
        """Limit of the drift ratio; None without heights."""
        limit: float | None = self.input["drift_limit"]
        return limit

    @property
    def storey_names(self) -> list[str]:
        """A name per storey, or empty texts."""
        return [row["name"] for row in self.input["storeys"]]

    @property
    def figure_names(self) -> tuple[str, ...]:
        """drift: what each storey uses of its drift limit in both analyses and with goods that slide, and the slip of
        its floor; effective_fraction: drift with goods that slide over that of the model against the share;
        spectrum: spectra of the motions beside that of the site. Those that have something to show.
        """
        fractions = self.answer.analyses and any(math.isfinite(one.value) for one in self.effective.values())
        return ("drift", *(("effective_fraction",) if fractions else ()), "spectrum")

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the runs as plain values in SI units; null for non-finite values."""
        document: dict[str, Any] = copy.deepcopy(self.content)
        return document


def assessment_of(
    solved: Solved,
    answer: Answer,
    effective: dict[str, EffectiveMass],
    tables: dict[str, pl.DataFrame],
    **facts: Any,
) -> Assessment:
    """Return an assessment of what was solved; `facts` are suite, collapses, advice, remarks, assumptions, metadata."""
    building, scaling = solved.building, solved.scaling
    collapses, motions = facts["collapses"], len(facts["suite"]["motions"])
    curves = [result.curve.select(pl.lit(model).alias("model"), pl.all()) for model, result in effective.items()]
    known = {
        "storeys": tables["storeys"],
        "governing": tables["governing"],
        ANALYSIS: analysis_table(answer, building),
        **{name: tables[name] for name in ("slip", "runs", "left_out", "slips")},
        "checks": checks_table(building, tables["storeys"], collapses, motions),
        "spectra": tables["spectra"],
        "design": design_table(building, solved.target),
        **({"curve": pl.concat(curves)} if curves else {}),
        **({"tipping": tables["tipping"]} if tables["tipping"].height else {}),
        **({} if scaling is None else {"scaling": scaling.table()}),
    }
    return Assessment(_content(solved, answer, effective, tables, facts), answer, effective, known, solved)


def _content(
    solved: Solved,
    answer: Answer,
    effective: dict[str, EffectiveMass],
    tables: dict[str, pl.DataFrame],
    facts: dict[str, Any],
) -> dict[str, Any]:
    """Everything but the runs as plain values in SI units; null for non-finite values."""
    building, target, scaling = solved.building, solved.target, solved.scaling
    document = {
        "schema_version": SCHEMA_VERSION,
        "name": building.name,
        "note": building.note,
        "project": asdict(building.project),
        "input": input_document(building, target),
        "headline": answer.headline,
        "statement": answer.statement,
        "doubts": answer.doubts,
        "doubt_lines": answer.doubt_lines,
        "reason": answer.reason,
        "remedy": answer.remedy,
        "on_motions": answer.motions,
        "answer": _answer_content(answer, solved) if answer.analyses else None,
        "code": asdict(building.code)
        | {
            "id": building.code.code_id,
            "uses": building.uses,
            "share_of_design_live_load": building.code_share,
        },
        "effective": {model: result.to_dict() for model, result in effective.items()},
        **{name: tables[name].to_dicts() for name in ("storeys", "governing", "left_out", "slip", "tipping")},
        "collapses": facts["collapses"],
        "suite": facts["suite"],
        "target": None if target is None else {"label": target.label, **target.parameters},
        "scaling": None
        if scaling is None
        else {"period": scaling.period, "periods": [scaling.periods[0], scaling.periods[-1]]},
        "factors": None if scaling is None else scaling.factors.tolist(),
        **{name: facts[name] for name in ("advice", "remarks", "assumptions", "metadata")},
    }
    return finite_values(document)


def _answer_content(answer: Answer, solved: Solved) -> dict[str, Any]:
    """The answer as plain values."""
    advised = answer.analyses[0].share_of_goods_present
    return {
        "advised_share_of_goods_present": advised,
        "advised_share_of_design_live_load": advised * solved.building.present_share,
        "share_for_strengths_of_goods_present": None if solved.design is None else solved.design.value,
        "analyses": [asdict(one) for one in answer.analyses],
        "opening": answer.opening,
        "pair": answer.pair,
        "governs": answer.governs,
        "goods": answer.goods,
        "tipping": [asdict(one) | {"verdict": one.verdict} for one in answer.tipping],
        "amounts": [asdict(one) | {"verdict": one.verdict} for one in answer.amounts],
        "why": answer.why,
        "sensitivity": answer.sensitivity,
        "design": answer.design,
        "share_matters": answer.matters,
    }
