"""What an assessment gives back: the share to attach, tables by storey and floor, advice, and every assumption."""

from __future__ import annotations

import math
import os
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final

import polars as pl

from seismass.assessment.answer import ANALYSIS, Answer, analysis_table
from seismass.assessment.building import OwnBuilding
from seismass.assessment.checks import checks_table, input_document
from seismass.assessment.models import Shown
from seismass.assessment.structure import design_table
from seismass.base.values import FieldValue
from seismass.base.views import view
from seismass.design.scaling import ScalingResult
from seismass.effective_mass import EffectiveMass
from seismass.media.result import Result, finite_values
from seismass.motions.spectra import TargetSpectrum

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA_VERSION: Final = 10
"""Version of the tables and of the JSON of an assessment."""


def shown_figures(fractions: bool) -> tuple[str, ...]:
    """Return the names of the figures with content; `fractions`: whether there is an answer with a fraction."""
    return ("drift", *(("effective_fraction",) if fractions else ()), "spectrum")


@dataclass(frozen=True, eq=False)
class Assessment(FieldValue, Result):
    """How much of a building's live load acts as mass, and how the building and its goods move.

    Attributes
    ----------
    building : OwnBuilding
        What was assessed.
    target : TargetSpectrum or None
        Site spectrum; None where motions were taken as they are and strengths were stated.
    answer : Answer
        The pair of analyses, what governs which storey, why this share, on which motions; or why there is none.
    effective : dict of str to EffectiveMass
        Effective fractions of the goods present, by friction: "real" as stated, "real_mu_low" and "real_mu_high" at its
        bounds. Empty without goods.
    design : EffectiveMass or None
        Share that a design of the strengths and the analysis have in common, at the friction that decides; see
        `seismass.effective_mass_of_design`. None where strengths are stated, and without an answer.
    storeys : polars.DataFrame
        Drift, limit and stability coefficient by model and storey; see `seismass.assessment.checks.checked_storeys`.
    governing : polars.DataFrame
        Drifts of both analyses and of goods that slide by storey; see `seismass.assessment.checks.governing_table`.
    slip : polars.DataFrame
        Slip demand by friction and floor; see `seismass.assessment.checks.slip_table`.
    tipping : polars.DataFrame
        Goods that tip before they slide, and what stands for them; see `seismass.assessment.checks.tipping_table`.
    runs : polars.DataFrame
        Peaks of every run by storey; see `seismass.assessment.models.solve_models`.
    left_out : polars.DataFrame
        Share and governing drift without each motion; see `seismass.assessment.checks.left_out_table`.
    slips : polars.DataFrame
        Slips of every run by kind of goods; see there.
    collapses : dict of str to int
        Collapsed runs of each model.
    spectra : polars.DataFrame
        Spectra of the scaled motions; see `seismass.assessment.file_parts.spectra_table`.
    example : Shown
        The building under the motion with the median drift of those under which goods slide.
    scaling : ScalingResult or None
        Factors of the motions; None where they were taken as they are.
    suite : dict
        Name of the suite and names of its motions; how many are synthetic.
    advice : tuple of str
        What to use in an analysis.
    remarks : tuple of str
        What is unlikely about the input, and what to know about the numbers.
    assumptions : tuple of str
        Everything that was assumed.
    metadata : dict
        Schema and package version, digest of the inputs, seed, conventions.
    """

    document: ClassVar[str] = "assessment"

    building: OwnBuilding
    target: TargetSpectrum | None
    answer: Answer
    effective: dict[str, EffectiveMass]
    design: EffectiveMass | None = field(repr=False)
    storeys: pl.DataFrame = field(repr=False)
    governing: pl.DataFrame = field(repr=False)
    slip: pl.DataFrame = field(repr=False)
    tipping: pl.DataFrame = field(repr=False)
    slips: pl.DataFrame = field(repr=False)
    runs: pl.DataFrame = field(repr=False)
    left_out: pl.DataFrame = field(repr=False)
    collapses: dict[str, int]
    spectra: pl.DataFrame = field(repr=False)
    example: Shown = field(repr=False)
    scaling: ScalingResult | None = field(repr=False)
    suite: dict[str, Any] = field(repr=False)
    advice: tuple[str, ...] = field(repr=False)
    remarks: tuple[str, ...] = field(repr=False)
    assumptions: tuple[str, ...] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)

    def __repr__(self) -> str:
        return f"<Assessment of {self.building.name}: {self.answer.headline}>"

    @property
    def advised(self) -> float | None:
        """Share of the goods present to attach in analysis 1; None where there is no answer.

        The largest of the effective fractions for friction as stated and at its bounds, rounded up to 0.01.
        """
        return self.answer.analyses[0].share_of_goods_present if self.answer.analyses else None

    @property
    def advised_of_live_load(self) -> float | None:
        """The advised mass over the design live load of the whole building, to compare with the fraction of a code."""
        return None if self.advised is None else self.advised * self.building.present_share

    @property
    @view
    def text(self) -> str:
        """What `seismass building` prints, the answer first."""
        raise NotImplementedError

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """Tables by name: storeys, governing, analysis, slip, runs, left_out, slips, checks, spectra, design; curve,
        tipping, scaling if known.
        """
        tables = {
            "storeys": self.storeys,
            "governing": self.governing,
            ANALYSIS: analysis_table(self.answer, self.building),
            "slip": self.slip,
            "runs": self.runs,
            "left_out": self.left_out,
            "slips": self.slips,
            "checks": checks_table(self.building, self.storeys, self.collapses, len(self.suite["motions"])),
            "spectra": self.spectra,
            "design": design_table(self.building, self.target),
        }
        curves = [
            result.curve.select(pl.lit(model).alias("model"), pl.all()) for model, result in self.effective.items()
        ]
        if curves:
            tables["curve"] = pl.concat(curves)
        if self.tipping.height:
            tables["tipping"] = self.tipping
        if self.scaling is not None:
            tables["scaling"] = self.scaling.table()
        return tables

    @property
    def figure_names(self) -> tuple[str, ...]:
        """drift, effective_fraction, spectrum: those that have something to show."""
        return shown_figures(
            bool(self.answer.analyses) and any(math.isfinite(one.value) for one in self.effective.values())
        )

    @view
    def plot(self, name: str | None = None) -> Figure:
        """Return a figure of `figure_names`, by default the first.

        Parameters
        ----------
        name : str, optional
            "drift": what each storey uses of its drift limit in both analyses and with goods that slide, and the slip
            of its floor; "effective_fraction": drift with goods that slide over that of the model against the share,
            by friction; "spectrum": spectra of the motions beside that of the site.

        Raises
        ------
        InvalidOption
            There is no such figure.
        """
        raise NotImplementedError

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the runs as plain values in SI units; null for non-finite values."""
        building, code = self.building, self.building.code
        document = {
            "schema_version": SCHEMA_VERSION,
            "name": building.name,
            "note": building.note,
            "project": asdict(building.project),
            "input": input_document(building, self.target),
            "headline": self.answer.headline,
            "statement": self.answer.statement,
            "doubts": list(self.answer.doubts),
            "doubt_lines": list(self.answer.doubt_lines),
            "reason": self.answer.reason,
            "remedy": self.answer.remedy,
            "on_motions": self.answer.motions,
            "answer": self._answer_document(),
            "code": asdict(code)
            | {"id": code.code_id, "uses": building.uses, "share_of_design_live_load": building.code_share},
            "effective": {model: result.to_dict() for model, result in self.effective.items()},
            "storeys": self.storeys.to_dicts(),
            "governing": self.governing.to_dicts(),
            "left_out": self.left_out.to_dicts(),
            "slip": self.slip.to_dicts(),
            "tipping": self.tipping.to_dicts(),
            "collapses": self.collapses,
            "suite": self.suite,
            "target": None if self.target is None else {"label": self.target.label, **self.target.parameters},
            "scaling": None
            if self.scaling is None
            else {"period": self.scaling.period, "periods": [self.scaling.periods[0], self.scaling.periods[-1]]},
            "factors": None if self.scaling is None else self.scaling.factors.tolist(),
            "advice": list(self.advice),
            "remarks": list(self.remarks),
            "assumptions": list(self.assumptions),
            "metadata": self.metadata,
        }
        finite: dict[str, Any] = finite_values(document)
        return finite

    def _answer_document(self) -> dict[str, Any] | None:
        """The answer as plain values; None where there is none."""
        answer = self.answer
        if not answer.analyses:
            return None
        share = None if self.design is None else self.design.value
        return {
            "advised_share_of_goods_present": self.advised,
            "advised_share_of_design_live_load": self.advised_of_live_load,
            "share_for_strengths_of_goods_present": share,
            "analyses": [asdict(one) for one in answer.analyses],
            "opening": answer.opening,
            "pair": list(answer.pair),
            "governs": list(answer.governs),
            "goods": list(answer.goods),
            "tipping": [asdict(one) | {"verdict": one.verdict} for one in answer.tipping],
            "amounts": [asdict(one) | {"verdict": one.verdict} for one in answer.amounts],
            "why": answer.why,
            "sensitivity": list(answer.sensitivity),
            "design": answer.design,
            "share_matters": answer.matters,
        }

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError

    @view
    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        """Write text, tables (Parquet and CSV), assessment.json, figures (PNG and SVG) and the page to a folder.

        Returns
        -------
        list of Path
            The files, in the order written.

        Raises
        ------
        InvalidOption
            The folder cannot be one.
        OSError
            A file cannot be written; then none is changed.
        """
        raise NotImplementedError
